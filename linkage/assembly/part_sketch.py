"""Where the pins of a part's groups are to begin in the whole: as they stand in the part's own sketch, moved with the part."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from math import cos, sin
from typing import Any, final

import numpy as np

from ..errors import DefinitionError
from ..plan import ArrayReading, Part, has_no_axes
from ..quantities import FRAME_SIDE, Axes, Member, Reference, needed_behind, needs, of_kind
from ..steps import Drawn, Group, Pin
from ..vectors import Line, Vec
from .sketch import Place, Sketch, inputs_at, places_at

TURNED = 0.7
"""The angle [rad] at which steps of other packages are tried."""
ASIDE = 0.31, -0.17
"""The displacement at which they are tried, over the size of the machine."""
STAYS = 1e-9
"""A step comes to the place that its axes take it to, to so much of the machine's size."""


def with_begun_pins(members: Mapping[str, Member], title: str) -> dict[str, Member]:
    """Return the members of a class, the pins of its parts' groups near the places that they have in the parts' own sketches."""
    found = dict(members)
    for name, part in of_kind(members, Part).items():
        if "." not in name:  # what stands in a part was begun with its class
            check_foreign(part, part.axes(members))
            if part.plan.groups and not part.stands_as_alone:
                begin(name, part, found, title)
    return found


def begin(name: str, part: Part, members: dict[str, Member], title: str) -> None:
    """Let the pins of a part begin where its own sketch has them, turned and moved as the points are that its groups hang on."""
    own, _ = places_at(part.plan, part.plan.sketch_strokes)
    for group in part.plan.groups.values():
        bound = members.get(f"{name}.{group.name}")
        if not isinstance(bound, Group):
            continue
        outside = [(each, f"{name}.{each}") for each in part.plan.points if each not in group.pins]
        held = {each for each in needs(bound) if each in members}
        pairs = [(each, part.aliases.get(dotted, dotted)) for each, dotted in outside if part.aliases.get(dotted, dotted) in held]
        sketch = Sketch(all_behind(members, [*of_kind(members, Drawn), *(dotted for _, dotted in pairs)]), title)
        places = laid_on([own[each] for each, _ in pairs], [sketch.at(dotted) for _, dotted in pairs], part.mirrored, own, group.pins)
        for pin, place in places.items():
            member = members[f"{name}.{pin}"]
            if isinstance(member, Pin):
                members[f"{name}.{pin}"] = member.renewed(near=place, drawn_at=None)


def check_foreign(part: Part, axes: Axes | None) -> None:
    """Raise DefinitionError for a step of another package that does not move with the axes of a part, as its class's sketch has it."""
    steps = [step for step in part.plan.points.values() if has_no_axes(step)]
    if axes is None or not steps:
        return
    with np.errstate(all="ignore"):
        reading = part.plan.read(inputs_at(part.plan, part.plan.sketch_strokes))
        size = max(float(np.hypot(place.x, place.y)) for place in map(reading.at, part.plan.points)) or 1.0
        moved = MovedReading(reading, axes, size)
        for step in steps:
            found, expected = step.place(moved), moved.place(reading.at(step.name))
            miss = float(np.hypot(found.x - expected.x, found.y - expected.y))
            said = f"{part.name} = {part}: {step.name} = {step} speaks of the frame"
            remedy = f"let its place follow from points alone, or give {type(step).__name__} in_axes(axes), which says where it stands"
            if not miss <= STAYS * size:
                far = f"it comes {1000.0 * miss:.3g} mm beside the place that they take it to"
                raise DefinitionError(f"{said}: where the part's axes are moved, {far}; {remedy}.", member=part.name)
            if axes.carrier and any(FRAME_SIDE in (joint.on, joint.by) for joint in step.joints()):
                raise DefinitionError(f"{said}: a joint of it holds the frame, and the part is carried; {remedy}.", member=part.name)


@final
class MovedReading:
    """A machine's reading whose points have been moved as the axes of a part allow: shifted, turned, mirrored."""

    def __init__(self, reading: ArrayReading, axes: Axes, size: float) -> None:
        self.reading, self.mirrored = reading, axes.mirrored
        turned = TURNED if axes.carrier or not axes.is_level else 0.0
        self.cos, self.sin, self.aside = cos(turned), sin(turned), Vec(ASIDE[0] * size, ASIDE[1] * size)

    def __getattr__(self, name: str) -> Any:
        return getattr(self.reading, name)

    def _turned(self, given: Vec) -> Vec:
        return (Vec(-given.x, given.y) if self.mirrored else given).turned(self.cos, self.sin)

    def place(self, given: Vec) -> Vec:
        """Return where a place comes to."""
        return self._turned(given) + self.aside

    def at(self, point: Reference) -> Vec:
        """Return a point's place [m]."""
        return self.place(self.reading.at(point))

    def vector(self, vector: Reference) -> Vec:
        """Return a vector member [m]."""
        return self._turned(self.reading.vector(vector))

    def direction(self, P: str, Q: str) -> Vec:
        """Return the vector from one point to another [m]."""
        return self._turned(self.reading.direction(P, Q))

    def line(self, guide: Reference) -> Line:
        """Return a guide's line."""
        found = self.reading.line(guide)
        return Line(self.place(found.origin), self._turned(found.direction))


def laid_on(
    own: list[Place], whole: list[Place], mirrored: bool, places: Mapping[str, Place], pins: Iterable[str]
) -> dict[str, Place]:
    """Return where pins come to lie when their part's points are laid on those of the whole, as near as can be."""
    sense = -1.0 if mirrored else 1.0
    start, goal = (np.array([complex(sign * x, y) for x, y in given]) for sign, given in ((sense, own), (1.0, whole)))
    turn = np.sum((goal - goal.mean()) * (start - start.mean()).conj())
    turn = turn / abs(turn) if abs(turn) > 0.0 else 1.0
    moved = {pin: goal.mean() + turn * (complex(sense * places[pin][0], places[pin][1]) - start.mean()) for pin in pins}
    return {pin: (float(place.real), float(place.imag)) for pin, place in moved.items()}


def all_behind(members: Mapping[str, Member], names: Iterable[str]) -> dict[str, Member]:
    """Return some members with all that they are built from."""
    found = needed_behind(names, members)
    return {name: member for name, member in members.items() if name in found}
