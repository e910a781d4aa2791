"""Entries of loads and of load cases."""

from __future__ import annotations

from typing import Any, ClassVar

from pydantic import Field

from ..loads import Actuator, Damper, Force, GuideFriction, LinkMass, LoadCase, Moment, PinFriction, Spring, Support, Weight
from ..quantities import Member, name_of
from .amounts import (
    Amount,
    BodyName,
    FixedAngle,
    FixedNumber,
    ForceVector,
    Gravity,
    LoadName,
    Mass,
    Metres,
    NewtonMetres,
    Newtons,
    Pair,
    Word,
    word_of,
)
from .design import Design, in_degrees, option
from .element import ElementEntry
from .entry import Entry
from .fields import GuideName, PointName, TwoPoints


class WeightEntry(ElementEntry):
    """`load = { Weight = "G", mass = 1200 }`"""

    describes: ClassVar[type[Member]] = Weight
    parents: PointName = Field(alias="Weight")
    mass: Mass
    gravity: Gravity | None = None


class ForceEntry(ElementEntry):
    """`pull = { Force = "F", vector = ["-5 kN", 0] }`"""

    describes: ClassVar[type[Member]] = Force
    parents: PointName = Field(alias="Force")
    vector: ForceVector

    @classmethod
    def written_numbers(cls, member: Any, design: Design) -> dict[str, Any]:
        return {"vector": [design.amount(getattr(member, axis), "N", f"{member.name}.{axis}") for axis in "xy"]}


class SupportEntry(ElementEntry):
    """`shoe = { Support = "R", direction = [0, 1] }`"""

    describes: ClassVar[type[Member]] = Support
    parents: PointName = Field(alias="Support")
    direction: Pair
    force: Newtons = None

    @classmethod
    def written_numbers(cls, member: Any, design: Design) -> dict[str, Any]:
        return {"direction": option(member.direction)} | super().written_numbers(member, design)


class PinFrictionEntry(ElementEntry):
    """`pin_O = { PinFriction = "O", radius = "70 mm", coefficient = 0.15 }`"""

    describes: ClassVar[type[Member]] = PinFriction
    parents: PointName = Field(alias="PinFriction")
    radius: Metres
    coefficient: Amount


class GuideFrictionEntry(ElementEntry):
    """`shoe = { GuideFriction = "C", coefficient = 0.1, guide = "rail" }`"""

    describes: ClassVar[type[Member]] = GuideFriction
    parents: PointName = Field(alias="GuideFriction")
    coefficient: Amount
    guide: GuideName = ""


class SpringEntry(ElementEntry):
    """`relief = { Spring = ["A", "B"], stiffness = 20e3, free_length = "400 mm" }`, or with `preload = "2 kN"` for its free length"""

    describes: ClassVar[type[Member]] = Spring
    parents: TwoPoints = Field(alias="Spring")
    stiffness: Amount
    free_length: Metres = None
    preload: Newtons = None


class DamperEntry(ElementEntry):
    """`strut = { Damper = ["A", "B"], coefficient = 2000 }`"""

    describes: ClassVar[type[Member]] = Damper
    parents: TwoPoints = Field(alias="Damper")
    coefficient: Amount


class ActuatorEntry(ElementEntry):
    """`push = { Actuator = ["A", "B"], force = "12 kN" }`"""

    describes: ClassVar[type[Member]] = Actuator
    parents: TwoPoints = Field(alias="Actuator")
    force: Newtons


class BodyEntry(ElementEntry):
    """The base of entries of what acts on a body: a link, or points of it."""

    @classmethod
    def written_parents(cls, member: Any) -> Any:
        return " ".join(map(name_of, member.named()))


class MomentEntry(BodyEntry):
    """`drag = { Moment = "O B", M = "-250 Nm" }`"""

    describes: ClassVar[type[Member]] = Moment
    parents: BodyName = Field(alias="Moment")
    M: NewtonMetres


class LinkMassEntry(BodyEntry):
    """`own = { LinkMass = "E D F", mass = 30, at = [0.45, 0.02] }`"""

    describes: ClassVar[type[Member]] = LinkMass
    parents: BodyName = Field(alias="LinkMass")
    mass: Mass
    at: Pair | None = None
    gravity: Gravity | None = None


class CaseEntry(Entry):
    """`transport = { title = "transport", scale = { load = 2.0 }, only = ["load"], slope = "10 deg", gravity = [0, -9.81] }`"""

    section: ClassVar[str] = "cases"
    describes: ClassVar[type[Member]] = LoadCase
    title: Word = ""
    scale: dict[LoadName, FixedNumber] = Field(default={})
    only: tuple[LoadName, ...] = ()
    slope: FixedAngle = None
    gravity: Gravity | None = None

    def member(self) -> Member:
        given = {name: getattr(self, name) for name in self.model_fields_set}
        return LoadCase(**given)

    @classmethod
    def written(cls, member: Any, design: Design) -> Any:
        usual = LoadCase()
        said: dict[str, Any] = {"title": word_of(member.title), "scale": {name: option(value) for name, value in member.scale.items()}}
        said |= {"only": None if member.only is None else [name_of(each) for each in member.only]}
        said |= {"slope": in_degrees(float(member.slope)), "gravity": None if member.gravity is None else option(member.gravity)}
        return {name: value for name, value in said.items() if repr(value) != repr(getattr(usual, name))}
