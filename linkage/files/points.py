"""Entries of points: fixed ones and construction steps, each with its class's name as the key of its parents."""

from __future__ import annotations

from typing import Any, ClassVar

from pydantic import Field

from ..plan import Table
from ..quantities import Member, label, name_of
from ..steps import Crank, Dyad, Ground, GuideCross, Offset, OnGuide, OnLink, Pin, PinSlotDyad, Point, SliderDyad, YokeDyad
from .design import Design, in_degrees
from .entry import Entry, Labelled, Worded
from .fields import Coordinates, GuideName, Place, PointAndArrow, PointAndGuide, PointName, SideWord, TwoGuides, TwoPoints, Value


class PointEntry(Worded):
    """The base of entries in [points]."""

    section: ClassVar[str] = "points"

    @classmethod
    def checked(cls, name: str, member: Member, title: str) -> None:
        assert isinstance(member, Point)
        member.bind(name, Table(title))


class StepEntry(PointEntry):
    """The base of entries of steps."""

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


class SidedStep(LabelledStep):
    """The base of entries of steps with two assembly modes: a side, or a position in a sketch, chooses one."""

    side: SideWord | None = None
    near: Place | None = None


class DrawnStep(SidedStep):
    """The base of entries of steps that may be measured from a drawing."""

    at: Place | None = None


class DyadEntry(DrawnStep):
    """`B = { Dyad = ["A", "O"], AB = "L0 + S", OB = 0.30, side = "RIGHT" }`"""

    describes: ClassVar[type[Member]] = Dyad
    parents: TwoPoints = Field(alias="Dyad")


class OnLinkEntry(DrawnStep):
    """`C = { OnLink = ["O", "B"], OC = 0.36, BC = 0.16, side = "LEFT" }`"""

    describes: ClassVar[type[Member]] = OnLink
    parents: TwoPoints = Field(alias="OnLink")


class SliderDyadEntry(SidedStep):
    """`C = { SliderDyad = ["A", "rail"], AC = 0.4, side = "RIGHT" }`"""

    describes: ClassVar[type[Member]] = SliderDyad
    parents: PointAndGuide = Field(alias="SliderDyad")


class PinSlotDyadEntry(SidedStep):
    """`R = { PinSlotDyad = ["O", "A"], OR = 0.5, offset = 0.02, side = "RIGHT" }`"""

    describes: ClassVar[type[Member]] = PinSlotDyad
    parents: TwoPoints = Field(alias="PinSlotDyad")
    offset: Value | None = None

    @classmethod
    def written(cls, member: Any, design: Design) -> Any:
        offset = design.scalar(member.offset)
        return super().written(member, design) | ({} if offset == 0.0 else {"offset": offset})


class GuideCrossEntry(StepEntry):
    """`C = { GuideCross = ["rail", "post"] }`"""

    describes: ClassVar[type[Member]] = GuideCross
    parents: TwoGuides = Field(alias="GuideCross")


class YokeDyadEntry(StepEntry):
    """`X = { YokeDyad = ["A", "rail"], angle = "90 deg" }`"""

    describes: ClassVar[type[Member]] = YokeDyad
    parents: PointAndGuide = Field(alias="YokeDyad")
    angle: Value | None = None

    @classmethod
    def written(cls, member: Any, design: Design) -> Any:
        angle = design.scalar(member.angle)
        return super().written(member, design) | {"angle": angle if isinstance(angle, str) else in_degrees(angle)}


class CrankEntry(LabelledStep):
    """`A = { Crank = "O", OA = 0.1, angle = "phi" }`"""

    describes: ClassVar[type[Member]] = Crank
    parents: PointName = Field(alias="Crank")
    angle: Value

    @classmethod
    def written(cls, member: Any, design: Design) -> Any:
        (parent,) = member.parents
        return super().written(member, design) | {cls.word: name_of(parent), "angle": design.scalar(member.angle)}


class OffsetEntry(PointEntry):
    """`B = { Offset = ["A", "AB"] }`"""

    describes: ClassVar[type[Member]] = Offset
    parents: PointAndArrow = Field(alias="Offset")

    @classmethod
    def written(cls, member: Any, design: Design) -> Any:
        return {cls.word: [name_of(member.P), design.arrow(member.by)]}


class OnGuideEntry(PointEntry):
    """`C = { OnGuide = "rail", at = "S" }`"""

    describes: ClassVar[type[Member]] = OnGuide
    parents: GuideName = Field(alias="OnGuide")
    at: Value

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
