"""The inputs of a machine: strokes, which move the mechanism, and dimensions and labels, which make the design."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from ..errors import DefinitionError, cited, ensure
from ..frozen import immutable
from ..units import UNITS, require_measure, unit_or_none
from ..vectors import Scalar
from .member import Where
from .quantity import Quantity, in_degrees, is_number, plain, with_unit


@immutable
class Stroke(Quantity):
    """A driven coordinate with its range: `S = Stroke(0.0, 0.2)`.

    Parameters
    ----------
    start, end : float or quantity
        The range of a cylinder's stroke [m] or a crank's angle [rad].
    """

    start: float
    end: float
    needs_name: ClassVar[bool] = True

    def __post_init__(self) -> None:
        if not (is_number(self.start) and is_number(self.end)):
            raise DefinitionError(f"Stroke({cited(self.start)}, {cited(self.end)}): both ends must be finite numbers.")
        object.__setattr__(self, "start", plain(self.start))
        object.__setattr__(self, "end", plain(self.end))
        for value in (self.start, self.end):
            if getattr(value, "measures", "") not in ("angle", "volume"):  # a volume of oil may be a stroke
                require_measure(value, "length", "Stroke: end")
        ensure(self.start != self.end, f"Stroke({self.start}, {self.end}) has no length: give two different ends.")

    def rule(self, where: Where) -> Scalar:
        return where.input(self.name)

    def text(self, measures: str = "") -> str:
        kind = measures or getattr(self.end, "measures", "") or getattr(self.start, "measures", "")
        ends = [with_unit(each, kind) if kind in ("angle", "volume") else repr(each) for each in (self.start, self.end)]
        return f"Stroke({', '.join(ends)})"

    def __str__(self) -> str:
        return self.text()


@immutable
class Variable(Quantity):
    """A design variable that a label or a coordinate made: `OB`, `M.x`."""

    variable: str

    def rule(self, where: Where) -> Scalar:
        return where.input(self.variable)

    def __str__(self) -> str:
        return self.variable


@immutable
class Dimension(Quantity):
    """A number of the design that has a name of its own: `reach = Dimension(0.4)`.

    Parameters
    ----------
    default : float
        Its value [SI] where a design says no other.
    unit : str, optional
        The unit in which it is shown and checked, such as "kgf".
    """

    default: float
    unit: str = ""
    needs_name: ClassVar[bool] = True

    def __post_init__(self) -> None:
        ensure(is_number(self.default), f"Dimension({cited(self.default)}): a finite number is expected.")
        object.__setattr__(self, "default", plain(self.default))
        unit_or_none(self.unit, where=f"Dimension({self.default!r}, unit=...)")

    def variables(self) -> tuple[tuple[str, float, str, str], ...]:
        return ((self.name, self.default, "number", self.unit),)

    def rule(self, where: Where) -> Scalar:
        return where.input(self.name)

    def having(self, values: Mapping[str, float]) -> Dimension:
        return self.renewed(default=values.get(self.name, self.default))

    def text(self, measures: str = "") -> str:
        unit = f', unit="{self.unit}"' if self.unit else ""
        is_angle = "angle" in (measures, UNITS.get(self.unit, (1.0, ""))[1])
        return f"Dimension({in_degrees(self.default) if is_angle else repr(self.default)}{unit})"

    def __str__(self) -> str:
        return self.text()
