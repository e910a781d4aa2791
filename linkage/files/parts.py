"""Entries of a parts list: links, guides, slides and groups."""

from __future__ import annotations

from typing import Any, ClassVar

from pydantic import Field

from ..errors import DefinitionError
from ..quantities import Member, Number, label, quantity
from ..steps import Group, Guide, Link, Slide
from .design import Design, in_degrees
from .entry import Entry, Labelled
from .fields import GuideName, Origin, PointName, Points, Value
from .limits import LINK_POINTS


class LinkEntry(Labelled):
    """`arm = { points = "O B C", OB = 0.30, OC = 0.36, BC = 0.16 }`"""

    section: ClassVar[str] = "links"
    describes: ClassVar[type[Member]] = Link
    points: Points

    def member(self) -> Member:
        if len(self.points) > LINK_POINTS:
            raise DefinitionError(f"a link of {len(self.points)} points; up to {LINK_POINTS} are read.")
        if len(self.points) < 2:
            raise DefinitionError(f"a link joins at least two points, not {' '.join(self.points)} alone.")
        return Link(*self.points, **self.labels)

    @classmethod
    def written(cls, member: Any, design: Design) -> Any:
        return {"points": " ".join(map(label, member.points))} | cls.written_labels(member.labels, design)


class GuideEntry(Entry):
    """`rail = { from = [0.0, -0.2], angle = 0.0 }`, `slot = { from = "P", to = "Q" }`"""

    section: ClassVar[str] = "guides"
    describes: ClassVar[type[Member]] = Guide
    start: Origin = Field(alias="from")
    to: PointName | None = None
    angle: Value | None = None

    def member(self) -> Member:
        return Guide(self.start, self.to, angle=self.angle)

    @classmethod
    def written(cls, member: Any, design: Design) -> Any:
        return {"from": cls.origin(member, design)} | ({"to": label(member.Q)} if member.angle is None else cls.direction(member, design))

    @classmethod
    def origin(cls, member: Guide, design: Design) -> Any:
        """Return where the guide starts: a point's name, or two coordinates."""
        if member.P is not None:
            return label(member.P)
        return [design.variable(f"{member.name}.{axis}", Number(value)) for axis, value in zip("xy", member.fixed_at or (), strict=True)]

    @classmethod
    def direction(cls, member: Guide, design: Design) -> dict[str, Any]:
        """Return the guide's angle."""
        value = design.variable(f"{member.name}.angle", quantity(0.0 if member.angle is None else member.angle))
        return {"angle": value if isinstance(value, str) else in_degrees(value)}


class SlideEntry(Entry):
    """`shoe = { point = "C", guide = "rail" }`"""

    section: ClassVar[str] = "slides"
    describes: ClassVar[type[Member]] = Slide
    point: PointName
    guide: GuideName

    def member(self) -> Member:
        return Slide(self.point, self.guide)

    @classmethod
    def written(cls, member: Any, design: Design) -> Any:
        return {"point": label(member.point), "guide": label(member.guide)}


class GroupEntry(Entry):
    """`triad = "A B D"`"""

    section: ClassVar[str] = "groups"
    describes: ClassVar[type[Member]] = Group
    bare: Points

    def member(self) -> Member:
        return Group(" ".join(self.bare))

    @classmethod
    def written(cls, member: Any, design: Design) -> Any:
        return " ".join(member.pins)
