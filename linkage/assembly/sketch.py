"""Where things are in the sketch: it chooses assembly modes and supplies lengths that are not given."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from copy import copy
from math import atan2, cos, pi, remainder, sin
from typing import Any, final

import numpy as np

from ..errors import AssemblyError, DefinitionError
from ..plan import ArrayReading, Part, Plan, has_no_axes, missing_words, strokes_text
from ..quantities import FRAME_SIDE, Axes, Member, Operand, Reference, joined_names, name_of, quantity
from ..quantities.member import needed_behind, needs, of_kind
from ..steps import Drawn, Group, Pin, Step
from ..vectors import Line, Numbers, Vec
from .angle_continuation import NONE_SOLVED, with_angles
from .groups import solve_groups
from .newton import at_sketch

Place = tuple[float, float]
ONE_PLACE = 1e-9
"""Points stand at one place where they are nearer to each other than so much of the size of what they are on."""
SAME_TURN = 1e-12
"""rad; a drawn angle that differs by less is the one that is given."""


def inputs_at(plan: Plan, strokes: Mapping[str, float]) -> dict[str, Numbers]:
    """Return all inputs at some strokes and default dimensions, the pins of groups included [SI]."""
    inputs: dict[str, Numbers] = {**plan.defaults, **strokes}
    if plan.groups:
        at_sketch(plan)
    if plan.solved:
        at = {name: np.array([value]) for name, value in strokes.items()}
        solved = with_angles(solve_groups(plan, plan.defaults, at) if plan.groups else NONE_SOLVED, plan, plan.defaults, at)
        inputs |= {name: float(value[0, 0]) for name, value in solved.inputs.items()}
    return inputs


def places_drawn(plan: Plan) -> tuple[dict[str, Place], dict[str, Numbers]]:
    """Return where all points are drawn [m], and the inputs, with the pins of groups at their rough places, which need not fit."""
    inputs: dict[str, Numbers] = {**plan.defaults, **plan.sketch_strokes}
    for group in plan.groups.values():
        rough = [part for pin in group.pins for part in plan.of_kind(Pin)[pin].sketched]
        inputs |= dict(zip(group.inputs, (*rough, 0.0), strict=True))
    return finite_places(plan, inputs, plan.sketch_strokes), inputs


def places_at(plan: Plan, strokes: Mapping[str, float]) -> tuple[dict[str, Place], dict[str, Numbers]]:
    """Return where all points are at some strokes [m], and the inputs; AssemblyError where they cannot be assembled."""
    inputs = inputs_at(plan, strokes)
    return finite_places(plan, inputs, strokes), inputs


def finite_places(plan: Plan, inputs: Mapping[str, Numbers], strokes: Mapping[str, float]) -> dict[str, Place]:
    """Return where all points are [m]; AssemblyError where they cannot be assembled."""
    with np.errstate(all="ignore"):
        reading = plan.read(inputs)
    return {name: finite_place(plan, name, reading, f"at {strokes_text(plan, strokes)}") for name in plan.points}


@np.errstate(all="ignore")
def finite_place(plan: Plan, name: str, reading: ArrayReading, where: str) -> Place:
    """Return a point's place [m]; AssemblyError where it cannot be assembled at the one pose of a reading, which `where` names."""
    place = float(reading.at(name).x), float(reading.at(name).y)
    if not np.isfinite(place).all():
        words, shortfall = missing_words(plan, name, reading, np.ones(1, bool))
        text = f"{plan.title}: {name} cannot be assembled {where}: {words.removesuffix('.')}, or say drawn(...) with other strokes."
        raise AssemblyError(text, point=name, mask=np.ones((), bool), shortfall=shortfall)
    return place


class Sketch:
    """The one measure of a sketch: where points are at its strokes, as far as it is settled.

    A point that is drawn `at=(x, y)` is there, whatever lengths are given; the others follow from these.
    """

    def __init__(self, settled: Mapping[str, Member], title: str) -> None:
        self.plan = Plan(settled, title)
        self.reading = sketch_reading(self.plan, inputs_at(self.plan, self.plan.sketch_strokes))

    def at(self, name: str) -> Place:
        """Return a point's place [m]; AssemblyError where it cannot be assembled in the sketch."""
        return finite_place(self.plan, name, self.reading, f"at the sketch ({strokes_text(self.plan, self.plan.sketch_strokes)})")

    def extended(self, given: Operand, drawn: float) -> Operand:
        """Return a length as it is given; a stroke alone that begins at zero is how far a cylinder is out of its drawn length [m]."""
        found = quantity(given)
        stroke = self.plan.strokes.get(found.known_as)
        if stroke is None or min(stroke.start, stroke.end) > 0.0:
            return given
        return drawn - self.plan.sketch_strokes[stroke.name] + found


@np.errstate(all="ignore")
def sketch_reading(plan: Plan, inputs: Mapping[str, Numbers]) -> ArrayReading:
    """Return the reading of a plan's sketch, with the points that are drawn where the drawing has them."""
    reading = plan.reading(inputs)
    reading.positions = {name: Vec(*point.drawn_at) for name, point in plan.points.items() if point.drawn_at is not None}
    plan.work_out(reading)
    return reading


def sided(name: str, step: Step, settled: Mapping[str, Member], title: str) -> Step:
    """Return a step with the side its sketch position chooses; DefinitionError where both modes are equally near."""
    place = step.near or step.drawn_at
    if place is None or step.side is not None:
        return step
    sketches = {}
    for side in Plan({**settled, name: step}, title).points[name].modes():
        chosen = copy(step)
        chosen.side, chosen.drawn_at = side, None
        sketches[side] = Sketch({**settled, name: chosen}, title)
    if not sketches:
        return step
    distance = {side: float(np.hypot(*np.subtract(sketch.at(name), place))) for side, sketch in sketches.items()}
    side, other = sorted(distance, key=lambda each: distance[each])
    apart = float(np.hypot(*np.subtract(sketches[side].at(name), sketches[other].at(name))))
    flat = type(step).from_drawing == "angle"  # a straight link has no sides
    if flat:
        P, Q = (sketches[side].at(name_of(parent)) for parent in step.parents)
        flat = apart <= 1e-6 * float(np.hypot(*np.subtract(P, Q)))
    if not flat and distance[other] - distance[side] <= 1e-6 * max(apart, 1e-12):
        raise DefinitionError(
            f"{title}: {name} = {step} does not choose an assembly mode: both poses are equally near, the sketch lies on the dead line. "
            "Move near=(x, y) to the side that is meant, or say side=LEFT or side=RIGHT.",
            member=name,
        )
    chosen = copy(step)
    chosen.side, chosen.near = side, None
    return chosen


def with_measured_labels(name: str, step: Step, sketch: Callable[[], Sketch]) -> Step:
    """Return a step drawn `at=(x, y)` with the lengths and angles that it does not give measured from there [m, rad]."""
    if step.drawn_at is None:
        return step
    drawing, X = sketch(), np.array(step.drawn_at)
    parents = [name_of(parent) for parent in step.parents]
    found = copy(step)
    found.labels = dict(step.labels) | missing_labels(name, step, parents, X, drawing.at)
    for parent in parents:
        for label in {joined_names(parent, name), joined_names(name, parent)} & set(step.labels):
            found.labels[label] = drawing.extended(step.labels[label], float(np.hypot(*(X - drawing.at(parent)))))
    if type(step).from_drawing == "turn":
        driven: Any = found
        x, y = X - drawing.at(parents[0])
        beside = remainder(atan2(y, x) - float(drawing.reading.value(driven.angle)), 2.0 * pi)
        if abs(beside) > SAME_TURN:  # it is counted from where the drawing has the crank
            driven.angle = beside + driven.angle
    return found


def missing_labels(name: str, step: Step, parents: list[str], X: object, place: Callable[[str], Place]) -> dict[str, float]:
    """Return the labels a drawn step lacks, measured: every distance of a dyad, distance and angle on a link."""
    away = {parent: X - np.array(place(parent)) for parent in parents}
    given = set(step.labels)
    found: dict[str, float] = {}
    first = parents[0]
    wanted = parents if type(step).from_drawing == "distances" else parents[:1]
    for parent in wanted:
        if not {joined_names(parent, name), joined_names(name, parent)} & given:
            found[joined_names(parent, name)] = measured = float(np.hypot(*away[parent]))
            if measured <= ONE_PLACE * max(np.hypot(*each) for each in away.values()) and step.closes:
                raise DefinitionError(f"{name} = {step}: {parent} and {name} stand at one place in the sketch; use one point for both.")
    if type(step).from_drawing == "angle":
        second = parents[1]
        angles = {joined_names(*each) for each in ((second, first, name), (name, first, second), (second, name), (name, second))}
        if not angles & given:
            base = away[first] - away[second]
            turn = np.arctan2(base[0] * away[first][1] - base[1] * away[first][0], base @ away[first])
            found[joined_names(second, first, name)] = float(turn)
    return found


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
