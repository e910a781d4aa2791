"""Dry friction of pins and guides: it acts against the motion, in proportion to the force it helps to make."""

from __future__ import annotations

from collections.abc import Hashable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import ClassVar, final

from ..checks import require_type
from ..errors import DefinitionError
from ..frozen import refuses_changes
from ..quantities import Member, Reference, is_number, label, name_of
from .element import ForceElement, Friction, Load, Parameter, Poses

ONE_COEFFICIENT = "One joint has one coefficient: take one of them out, and scale the other in the load cases where it differs."
THICKEST = 3.0
"""m; the radius of a larger pin was given in millimetres."""


@final
@refuses_changes
@dataclass(frozen=True, eq=False)
class PinFriction(ForceElement):
    """Friction in a pin of a radius [m]: the moment coefficient * radius * pin force, against the relative turning.

    A pin of more than two bodies sits fast in the first of them (the frame, if it is one): the others turn on it.
    """

    point: Reference
    radius: Parameter
    coefficient: Parameter
    parameters: ClassVar[Mapping[str, str]] = MappingProxyType({"radius": "mm", "coefficient": ""})
    not_negative: ClassVar[frozenset[str]] = frozenset({"radius", "coefficient"})

    def __post_init__(self) -> None:
        super().__post_init__()
        if is_number(self.radius) and self.radius > THICKEST:
            large = f"{self.radius:.6g}"
            raise DefinitionError(f"PinFriction: radius={large} m is more than any pin has; write {large} * mm if these are millimetres.")

    def loads(self, motion: Poses) -> list[Load]:
        return []

    def frictions(self, motion: Poses) -> list[Friction]:
        return [Friction(name_of(self.point), self.number(motion, "coefficient"), self.number(motion, "radius"))]

    def claims(self, members: Mapping[str, Member]) -> Mapping[Hashable, str]:
        return {("pin", name_of(self.point)): f"are the friction of the pin {name_of(self.point)}. {ONE_COEFFICIENT}"}


@final
@refuses_changes
@dataclass(frozen=True, eq=False)
class GuideFriction(ForceElement):
    """Friction of a point on the guides and slots it runs on: coefficient * normal force, against the relative sliding.

    `guide` names one of them, where the point runs on several.
    """

    point: Reference
    coefficient: Parameter
    guide: Reference = ""
    parameters: ClassVar[Mapping[str, str]] = MappingProxyType({"coefficient": ""})
    argument_kinds: ClassVar[Mapping[str, object]] = MappingProxyType({"guide": "guide"})
    not_negative: ClassVar[frozenset[str]] = frozenset({"coefficient"})

    def __post_init__(self) -> None:
        super().__post_init__()
        require_type("GuideFriction: guide", self.guide, (str, Member), "is neither a guide nor the name of one")

    def parts(self) -> tuple[Reference, ...]:
        return (*super().parts(), *([self.guide] if self.guide != "" else []))

    def words(self) -> list[str]:
        return [f"guide={label(self.guide)}" if word.startswith("guide=") else word for word in super().words()]

    def loads(self, motion: Poses) -> list[Load]:
        return []

    def frictions(self, motion: Poses) -> list[Friction]:
        return [Friction(name_of(self.point), self.number(motion, "coefficient"), guide=name_of(self.guide))]

    def claims(self, members: Mapping[str, Member]) -> Mapping[Hashable, str]:
        point, guide = name_of(self.point), name_of(self.guide)
        words = f"are the friction of {point} on {guide or 'its guides'}. {ONE_COEFFICIENT}"
        return {("guide", point, each): words for each in ([guide] if guide else ["", *members])}  # without a guide: on all there are
