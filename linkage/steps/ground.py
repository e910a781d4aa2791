"""A point of the frame, and one of a body that is given by coordinates."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ..errors import DefinitionError, cited
from ..quantities import FRAME_AXES, Axes, Operand, Quantity, Reference, Where, label, quantity, source_text
from ..vectors import Vec
from .step import Point


class Ground(Point):
    """A fixed point: `O = Ground(0.0, 0.0)`.

    Parameters
    ----------
    x, y : float or quantity
        Its coordinates [m], or the pair as one argument. They are design variables: `O.x`, `O.y`, or `O=(x, y)` at once.
    """

    is_fixed = True
    axes = FRAME_AXES
    """The axes that its coordinates are counted in."""

    def __init__(self, x: Operand, y: Operand | None = None) -> None:
        if y is None:
            raise DefinitionError(f"Ground({cited(x)}): say both coordinates one after the other [m], Ground(0.7, 0.0).")
        self.x, self.y = quantity(x), quantity(y)
        for value in (self.x, self.y):
            if value.constant is not None and not abs(value.constant) < float("inf"):
                raise DefinitionError(f"Ground({self.x}, {self.y}): both coordinates must be finite numbers.")

    def parts(self) -> tuple[Reference, ...]:
        return (*(part for part in (self.x, self.y) if not part.is_constant), *self.axes.parts())

    def coordinates(self) -> tuple[tuple[str, Quantity], ...]:
        return (f"{self.name}.x", self.x), (f"{self.name}.y", self.y)

    def variables(self) -> tuple[tuple[str, float, str, str], ...]:
        return tuple((name, value.constant, "coordinate", "") for name, value in self.coordinates() if value.constant is not None)

    def having(self, values: Mapping[str, float]) -> Ground:
        x, y = (quantity(values.get(name, value)) for name, value in self.coordinates())
        return self.renewed(x=x, y=y)

    def place(self, where: Where) -> Vec:
        own = [where.input(name) if value.is_constant else where.value(value) for name, value in self.coordinates()]
        return self.axes.place(where, Vec(*own))

    def in_axes(self, axes: Axes) -> Any:
        stands = axes.composed(self.axes)
        if not stands.carrier:
            return self.renewed(axes=stands)
        P, Q = stands.carrier
        return Carried(P, Q, self.x, self.y).renewed(_name=self.name, axes=stands)

    def __str__(self) -> str:
        return f"Ground({source_text(self.x)}, {source_text(self.y)})"


class Carried(Ground):
    """A point of the body of P and Q by its coordinates in the body's axes: `N = Carried(B, C, 0.4, 0.1)`.

    Parameters
    ----------
    P, Q : Point or str
        The origin of the axes, and the point that x goes to; y goes to its left.
    x, y : float or quantity
        The coordinates [m]. They are design variables: `N.x`, `N.y`, or `N=(x, y)` at once.
    """

    is_fixed = False
    expects = (("P", "point"), ("Q", "point"))

    def __init__(self, P: Reference, Q: Reference, x: Operand, y: Operand) -> None:
        super().__init__(x, y)
        if P is Q or (isinstance(P, str) and P == Q):
            raise DefinitionError(f"Carried({label(P)}, {label(Q)}): name two different points of the body.")
        self.axes = Axes(P, Q)

    @property
    def P(self) -> Reference:
        """The point of the body that its axes begin in."""
        return self.axes.carrier[0]

    @property
    def Q(self) -> Reference:
        """The point of the body that its x axis goes to."""
        return self.axes.carrier[1]

    def bodies(self) -> tuple[tuple[str, ...], ...]:
        return ((*self.axes.carrier, self.name),)

    def __str__(self) -> str:
        return f"Carried({', '.join(self.axes.carrier)}, {source_text(self.x)}, {source_text(self.y)})"
