"""Entries of points: fixed ones and construction steps, each with its class's name as the key of its parents."""

from __future__ import annotations

from typing import Any, ClassVar

from pydantic import Field

from ..plan import Table
from ..quantities import Member, label, name_of
from ..steps import Crank, Dyad, Ground, GuideCross, Offset, OnGuide, OnLink, Pin, PinSlotDyad, Point, SliderDyad, YokeDyad
from .design import Design, in_degrees
from .entry import Entry, Labelled
from .fields import Coordinates, GuideName, Place, PointAndArrow, PointAndGuide, PointName, SideWord, TwoGuides, TwoPoints, Value


class PointEntry(Entry):
    """The base of entries in [points]."""

    section: ClassVar[str] = "points"

    @classmethod
    def checked(cls, name: str, member: Member, title: str) -> None:
        assert isinstance(member, Point)
        member.bind(name, Table(title))


class StepEntry(PointEntry):
    """The base of entries of steps."""

    parents: Any

    def given(self) -> dict[str, Any]:
        """Return the keywords of the step."""
        return {name: getattr(self, name) for name in type(self).model_fields if name not in ("parents", "labels")}

    def member(self) -> Member:
        parents = self.parents if isinstance(self.parents, tuple) else (self.parents,)
        made: Member = self.describes(*parents, **self.given())
        return made

    @classmethod
    def written(cls, member: Any, design: Design) -> Any:
        return {cls.word: [name_of(each) for each in member.parents]}


class LabelledStep(Labelled, StepEntry):
    """The base of entries of steps with labels, and with what chooses the assembly mode."""

    def given(self) -> dict[str, Any]:
        return super().given() | self.labels

    @classmethod
    def written(cls, member: Any, design: Design) -> Any:
        own = {"near": member.near, "at": member.drawn_at, "side": member.side and str(member.side)}
        chosen = {key: list(value) if isinstance(value, tuple) else value for key, value in own.items() if value is not None}
        return super().written(member, design) | cls.written_labels(member.labels, design) | chosen


class DyadEntry(LabelledStep):
    """`B = { Dyad = ["A", "O"], AB = "L0 + S", OB = 0.30, side = "RIGHT" }`"""

    describes: ClassVar[type[Member]] = Dyad
    word: ClassVar[str] = "Dyad"
    parents: TwoPoints = Field(alias="Dyad")
    side: SideWord | None = None
    near: Place | None = None
    at: Place | None = None


class OnLinkEntry(LabelledStep):
    """`C = { OnLink = ["O", "B"], OC = 0.36, BC = 0.16, side = "LEFT" }`"""

    describes: ClassVar[type[Member]] = OnLink
    word: ClassVar[str] = "OnLink"
    parents: TwoPoints = Field(alias="OnLink")
    side: SideWord | None = None
    near: Place | None = None
    at: Place | None = None


class SliderDyadEntry(LabelledStep):
    """`C = { SliderDyad = ["A", "rail"], AC = 0.4, side = "RIGHT" }`"""

    describes: ClassVar[type[Member]] = SliderDyad
    word: ClassVar[str] = "SliderDyad"
    parents: PointAndGuide = Field(alias="SliderDyad")
    side: SideWord | None = None
    near: Place | None = None


class PinSlotDyadEntry(LabelledStep):
    """`R = { PinSlotDyad = ["O", "A"], OR = 0.5, offset = 0.02, side = "RIGHT" }`"""

    describes: ClassVar[type[Member]] = PinSlotDyad
    word: ClassVar[str] = "PinSlotDyad"
    parents: TwoPoints = Field(alias="PinSlotDyad")
    offset: Value = Field(default=0.0, validate_default=True)
    side: SideWord | None = None
    near: Place | None = None

    @classmethod
    def written(cls, member: Any, design: Design) -> Any:
        offset = design.scalar(member.offset)
        return super().written(member, design) | ({} if offset == 0.0 else {"offset": offset})


class GuideCrossEntry(StepEntry):
    """`C = { GuideCross = ["rail", "post"] }`"""

    describes: ClassVar[type[Member]] = GuideCross
    word: ClassVar[str] = "GuideCross"
    parents: TwoGuides = Field(alias="GuideCross")


class YokeDyadEntry(StepEntry):
    """`X = { YokeDyad = ["A", "rail"], angle = "90 deg" }`"""

    describes: ClassVar[type[Member]] = YokeDyad
    word: ClassVar[str] = "YokeDyad"
    parents: PointAndGuide = Field(alias="YokeDyad")
    angle: Value = Field(default="90 deg", validate_default=True)

    @classmethod
    def written(cls, member: Any, design: Design) -> Any:
        angle = design.scalar(member.angle)
        return super().written(member, design) | {"angle": angle if isinstance(angle, str) else in_degrees(angle)}


class CrankEntry(LabelledStep):
    """`A = { Crank = "O", OA = 0.1, angle = "phi" }`"""

    describes: ClassVar[type[Member]] = Crank
    word: ClassVar[str] = "Crank"
    parents: PointName = Field(alias="Crank")
    angle: Value

    @classmethod
    def written(cls, member: Any, design: Design) -> Any:
        (parent,) = member.parents
        return super().written(member, design) | {cls.word: name_of(parent), "angle": design.scalar(member.angle)}


class OffsetEntry(PointEntry):
    """`B = { Offset = ["A", "AB"] }`"""

    describes: ClassVar[type[Member]] = Offset
    word: ClassVar[str] = "Offset"
    parents: PointAndArrow = Field(alias="Offset")

    def member(self) -> Member:
        return Offset(*self.parents)

    @classmethod
    def written(cls, member: Any, design: Design) -> Any:
        return {cls.word: [name_of(member.P), design.arrow(member.by)]}


class OnGuideEntry(PointEntry):
    """`C = { OnGuide = "rail", at = "S" }`"""

    describes: ClassVar[type[Member]] = OnGuide
    word: ClassVar[str] = "OnGuide"
    guide: GuideName = Field(alias="OnGuide")
    at: Value

    def member(self) -> Member:
        return OnGuide(self.guide, at=self.at)

    @classmethod
    def written(cls, member: Any, design: Design) -> Any:
        return {cls.word: label(member.guide), "at": design.scalar(member.along)}


class GroundEntry(Entry):
    """`A = [0.20, 0.55]`"""

    section: ClassVar[str] = "ground"
    describes: ClassVar[type[Member]] = Ground
    bare: Coordinates

    def member(self) -> Member:
        return Ground(*self.bare)

    @classmethod
    def written(cls, member: Any, design: Design) -> Any:
        return [design.variable(name, value) for name, value in member.coordinates()]


class PinEntry(Entry):
    """`B = { near = [0.51, 0.94] }` or `B = { at = [0.514, 0.939] }`"""

    section: ClassVar[str] = "pins"
    describes: ClassVar[type[Member]] = Pin
    near: Place | None = None
    at: Place | None = None

    def member(self) -> Member:
        return Pin(near=self.near, at=self.at)

    @classmethod
    def written(cls, member: Any, design: Design) -> Any:
        return {"near": list(member.near)} if member.near else {"at": list(member.drawn_at)}
