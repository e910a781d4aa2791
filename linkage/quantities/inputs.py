"""What is given from outside: strokes, which move the mechanism, and dimensions, which make the design."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..errors import DefinitionError
from ..vectors import Scalar
from .quantity import Quantity, Where


@dataclass(frozen=True, eq=False)
class Stroke(Quantity):
    """A driven coordinate with its range: a cylinder's stroke [m] or a crank's angle [rad]."""

    start: float
    end: float

    def __post_init__(self) -> None:
        for value in (self.start, self.end):
            if not isinstance(value, (int, float)) or not math.isfinite(value):
                raise DefinitionError(f"Stroke({self.start}, {self.end}): both ends must be finite numbers.")
        if self.start == self.end:
            raise DefinitionError(f"Stroke({self.start}, {self.end}) has no length: give two different ends.")

    def rule(self, where: Where) -> Scalar:
        return where.input(self.name)

    def __str__(self) -> str:
        return f"Stroke({self.start!r}, {self.end!r})"


@dataclass(frozen=True, eq=False)
class Dimension(Quantity):
    """A number of the design that has a name of its own [SI]."""

    default: float

    def __post_init__(self) -> None:
        if isinstance(self.default, bool) or not isinstance(self.default, (int, float)) or not math.isfinite(self.default):
            raise DefinitionError(f"Dimension({self.default!r}): a finite number is expected.")

    def rule(self, where: Where) -> Scalar:
        return where.input(self.name)

    def __str__(self) -> str:
        return f"Dimension({self.default!r})"
