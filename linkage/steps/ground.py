"""A point of the frame."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ..errors import DefinitionError, cited
from ..quantities import Number, Quantity, Reference, Where, quantity, spelled
from ..vectors import Vec
from .labels import Claims
from .step import Point


class Ground(Point):
    """A fixed point [m]. Its coordinates are design variables: `M.x`, `M.y`, or `M=(x, y)` at once."""

    def __init__(self, x: Any, y: Any = None) -> None:
        if y is None:
            raise DefinitionError(f"Ground({cited(x)}): say both coordinates one after the other [m], Ground(0.7, 0.0).")
        self.x, self.y = quantity(x), quantity(y)
        for value in (self.x, self.y):
            if isinstance(value, Number) and not abs(value.number) < float("inf"):
                raise DefinitionError(f"Ground({self.x}, {self.y}): both coordinates must be finite numbers.")

    def parts(self) -> tuple[Reference, ...]:
        return tuple(part for part in (self.x, self.y) if not part.is_constant)

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

    def bind(self, X: str, claims: Claims) -> Ground:
        return self

    def place(self, where: Where) -> Vec:
        return Vec(*(where.input(name) if value.is_constant else where.value(value) for name, value in self.coordinates()))

    def __str__(self) -> str:
        return f"Ground({spelled(self.x)}, {spelled(self.y)})"
