"""Entries of strokes, dimensions, outputs, vectors, and of the strokes at which a sketch holds."""

from __future__ import annotations

from collections.abc import Mapping
from math import isfinite
from typing import Annotated, Any, ClassVar

from pydantic import PlainValidator, ValidationInfo

from ..errors import DefinitionError, unknown
from ..motion import stroke_unit
from ..quantities import Dimension, Member, Quantity, Stroke, ref
from ..quantities.quantity import plain
from ..steps import Arrow, Drawn
from ..units import UNITS, parse
from .design import Design, in_degrees
from .entry import Entry
from .fields import AnArrow, Ends, Value, names_of, number_of
from .names import shortened
from .tokens import one_unit

LONGER = 4  # characters that a dimension may be longer in its unit than in SI


class StrokeEntry(Entry):
    """`S = [0.0, 0.25]`"""

    section: ClassVar[str] = "strokes"
    describes: ClassVar[type[Member]] = Stroke
    bare: Ends

    def member(self) -> Member:
        return Stroke(*self.bare)

    @classmethod
    def written(cls, member: Any, design: Design) -> Any:
        turns = stroke_unit(design.plan, member.name) == "rad"
        return [in_degrees(end) if turns else end for end in (member.start, member.end)]


def dimension_of(given: Any, info: ValidationInfo) -> tuple[float, str]:
    """Return a dimension's value [SI] and the unit it is shown in: a number, `500 mm`, or { value = 0.5, unit = "mm" }."""
    if isinstance(given, Mapping):
        if not {"value"} <= set(given) <= {"value", "unit"} or not isinstance(given.get("unit", ""), str):
            raise DefinitionError(f'{shortened(dict(given))}: a dimension is a number, "500 mm", or {{ value = 0.5, unit = "mm" }}.')
        return number_of(given["value"], info), given.get("unit", "")
    return number_of(given, info), one_unit(given) if isinstance(given, str) else ""


class DimensionEntry(Entry):
    """`L0 = 0.5`, `L0 = "500 mm"` or `L0 = { value = 0.5, unit = "mm" }`"""

    section: ClassVar[str] = "dimensions"
    describes: ClassVar[type[Member]] = Dimension
    bare: Annotated[tuple[float, str], PlainValidator(dimension_of)]

    def member(self) -> Member:
        return Dimension(*self.bare)

    @classmethod
    def written(cls, member: Any, design: Design) -> Any:
        value = design.set.get(member.name, member.default)
        design.written.add(member.name)
        if not member.unit:
            return value
        shown = value / UNITS[member.unit][0]
        texts = [f"{shown:.12g}", *([repr(shown)] if len(repr(shown)) <= len(repr(value)) + LONGER else [])]
        found = (f"{text} {member.unit}" for text in texts if isfinite(shown) and parse(f"{text} {member.unit}") == value)
        return next(found, {"value": value, "unit": member.unit})


class OutputEntry(Entry):
    """`tilt = "angle(F, K) - 90 deg"`"""

    section: ClassVar[str] = "outputs"
    describes: ClassVar[type[Member]] = Quantity
    family: ClassVar[bool] = True
    bare: Value

    def member(self) -> Member:
        return ref(self.bare.name) if self.bare.name else self.bare

    @classmethod
    def written(cls, member: Any, design: Design) -> Any:
        return member.number if member.is_constant else design.own(member)


class VectorEntry(Entry):
    """`AB = "Turn(AO, -OAB, length=L0 + S)"`"""

    section: ClassVar[str] = "vectors"
    describes: ClassVar[type[Member]] = Arrow
    family: ClassVar[bool] = True
    bare: AnArrow

    def member(self) -> Member:
        if isinstance(self.bare, str):
            raise DefinitionError(f"{self.bare} is a vector already; use that name.")
        found: Member = self.bare
        return found

    @classmethod
    def written(cls, member: Any, design: Design) -> Any:
        return design.own_arrow(member)


def strokes_of(given: Any, info: ValidationInfo) -> dict[str, float]:
    """Return values of strokes by name [SI]."""
    sections = names_of(info).sections
    strokes = [name for name, section in sections.items() if section == "strokes"]
    if not isinstance(given, Mapping):
        raise DefinitionError(f"{shortened(given)} is not a table of strokes, such as {{ S = 0.0 }}.")
    for name in given:
        if name not in strokes:
            raise unknown("Stroke", shortened(name, quote=False), strokes)
    return {name: number_of(value, info) for name, value in given.items()}


class DrawnEntry(Entry):
    """`sketch = { S = 0.0 }`"""

    section: ClassVar[str] = "drawn"
    describes: ClassVar[type[Member]] = Drawn
    bare: Annotated[dict[str, float], PlainValidator(strokes_of)]

    def member(self) -> Member:
        return Drawn(self.bare)

    @classmethod
    def written(cls, member: Any, design: Design) -> Any:
        turning = [name for name in design.plan.strokes if stroke_unit(design.plan, name) == "rad"]
        return {name: in_degrees(plain(value)) if name in turning else plain(value) for name, value in member.strokes.items()}
