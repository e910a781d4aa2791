"""A point of the frame, and one of a body that is given by coordinates."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ..errors import DefinitionError, cited
from ..quantities import Axes, Number, Operand, Quantity, Reference, Where, label, quantity, spelled
from ..vectors import Vec
from .step import Point


class Ground(Point):
    """A fixed point [m]. Its coordinates are design variables: `M.x`, `M.y`, or `M=(x, y)` at once."""

    axes: Axes | None = None
    """The axes that its coordinates are counted in; None for the frame's."""

    def __init__(self, x: Operand, y: Operand | None = None) -> None:
        if y is None:
            raise DefinitionError(f"Ground({cited(x)}): say both coordinates one after the other [m], Ground(0.7, 0.0).")
        self.x, self.y = quantity(x), quantity(y)
        for value in (self.x, self.y):
            if isinstance(value, Number) and not abs(value.number) < float("inf"):
                raise DefinitionError(f"Ground({self.x}, {self.y}): both coordinates must be finite numbers.")

    def parts(self) -> tuple[Reference, ...]:
        own = tuple(part for part in (self.x, self.y) if not part.is_constant)
        return own if self.axes is None else (*own, *self.axes.parts())

    @property
    def is_fixed(self) -> bool:
        return True

    def coordinates(self) -> tuple[tuple[str, Quantity], ...]:
        return (f"{self.name}.x", self.x), (f"{self.name}.y", self.y)

    def variables(self) -> tuple[tuple[str, float, str, str], ...]:
        return tuple((name, value.number, "coordinate", "") for name, value in self.coordinates() if isinstance(value, Number))

    def having(self, values: Mapping[str, float]) -> Ground:
        x, y = (quantity(values.get(name, value)) for name, value in self.coordinates())
        return self.renewed(x=x, y=y)

    def place(self, where: Where) -> Vec:
        own = Vec(*(where.input(name) if value.is_constant else where.value(value) for name, value in self.coordinates()))
        return own if self.axes is None else self.axes.place(where, own)

    def in_axes(self, axes: Axes) -> Any:
        stands = axes.within(self.axes)
        if not stands.carrier:
            return self.renewed(axes=stands)
        P, Q = stands.carrier
        carried = Carried(P, Q, self.x, self.y)
        return carried.renewed(_name=self.name, axes=stands)

    def __str__(self) -> str:
        return f"Ground({spelled(self.x)}, {spelled(self.y)})"


class Carried(Ground):
    """A point of the body of P and Q by its coordinates in the body's axes [m]: `N = Carried(B, C, 0.4, 0.1)`.

    The axes have their origin in P, x goes to Q, y to its left. The coordinates are design variables: `N.x`, `N.y`, or `N=(x, y)`.
    """

    expects = (("P", "point"), ("Q", "point"))

    def __init__(self, P: Reference, Q: Reference, x: Operand, y: Operand) -> None:
        super().__init__(x, y)
        if P is Q or (isinstance(P, str) and P == Q):
            raise DefinitionError(f"Carried({label(P)}, {label(Q)}): name two different points of the body.")
        self.axes = Axes(P, Q)

    @property
    def P(self) -> Reference:
        """The point of the body that its axes begin in."""
        return self.carrier[0]

    @property
    def Q(self) -> Reference:
        """The point of the body that its x axis goes to."""
        return self.carrier[1]

    @property
    def carrier(self) -> tuple[str, ...]:
        """The names of the two points of the body."""
        return () if self.axes is None else self.axes.carrier

    @property
    def is_fixed(self) -> bool:
        return False

    def bodies(self) -> tuple[tuple[str, ...], ...]:
        return ((*self.carrier, self.name),)

    def __str__(self) -> str:
        return f"Carried({', '.join(self.carrier)}, {spelled(self.x)}, {spelled(self.y)})"
