"""Where things are in the sketch: it chooses assembly modes and supplies lengths that are not given."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from math import acos, atan2, cos, pi, remainder, sin
from typing import Any, NamedTuple

import numpy as np

from ..errors import AssemblyError, DefinitionError
from ..language import said
from ..plan import WIDE, ArrayReading, Part, Plan, has_no_axes, missing_words, strokes_text
from ..quantities import FRAME_SIDE, Axes, Member, Operand, Quantity, Reference, joined_names, name_of, quantity
from ..quantities.member import needed_behind, needs, of_kind
from ..steps import Drawn, Group, Guide, GuideCross, Pin, Step
from ..units import show
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
        reading, where = plan.read(inputs), f"at {strokes_text(plan, strokes)}"
    return {name: finite_place(plan, name, reading, where) for name in plan.points}


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
    sides = Plan({**settled, name: step}, title).points[name].modes()
    sketches = {side: Sketch({**settled, name: step.renewed(side=side, drawn_at=None)}, title) for side in sides}
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
    return step.renewed(side=side, near=None)


def with_measured_labels(name: str, step: Step, sketch: Callable[[], Sketch]) -> Step:
    """Return a step drawn `at=(x, y)` with the lengths and angles that it does not give measured from there [m, rad]."""
    if step.drawn_at is None:
        return step
    drawing, X = sketch(), np.array(step.drawn_at)
    parents = [name_of(parent) for parent in step.parents]
    found = step.renewed(labels=step.labels | missing_labels(name, step, parents, X, drawing.at))
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
            across, along = base[0] * away[first][1] - base[1] * away[first][0], base @ away[first]
            is_straight = abs(across) <= ONE_LINE * np.hypot(*base) * np.hypot(*away[first])
            found[joined_names(second, first, name)] = float(np.arctan2(0.0 if is_straight else across, along))
    return found


ONE_LINE = 1e-13
"""Three points are drawn on one line where the sine of their angle is so small: it is rounding, and the angle 0 or half a turn."""
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
        # as near as can be: the part's points are laid on those of the whole
        sense, whole = -1.0 if part.mirrored else 1.0, [sketch.at(dotted) for _, dotted in pairs]
        start = np.array([complex(sense * x, y) for x, y in (own[each] for each, _ in pairs)])
        goal = np.array([complex(x, y) for x, y in whole])
        turn = np.sum((goal - goal.mean()) * (start - start.mean()).conj())
        turn = turn / abs(turn) if abs(turn) > 0.0 else 1.0
        for pin in group.pins:
            member, place = members[f"{name}.{pin}"], goal.mean() + turn * (complex(sense * own[pin][0], own[pin][1]) - start.mean())
            if isinstance(member, Pin):
                members[f"{name}.{pin}"] = member.renewed(near=(float(place.real), float(place.imag)), drawn_at=None)


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


def all_behind(members: Mapping[str, Member], names: Iterable[str]) -> dict[str, Member]:
    """Return some members with all that they are built from."""
    found = needed_behind(names, members)
    return {name: member for name, member in members.items() if name in found}


# Where a class says otherwise than its own drawing: a length or an angle that is given, and is not as it is drawn.

AGREES = 1e-3
"""A given length is that of the drawing to this part of it, an angle to so many rad: a drawing is read off to a millimetre in a metre."""
DIGITS = 3
"""Digits of the stroke that is named as a remedy."""


class Difference(NamedTuple):
    """A length [m] or an angle [rad] that is given otherwise than it is drawn, and which of its points stands off its place [m]."""

    label: str
    quantity: Quantity
    drawn: float
    given: float
    point: str
    off: float
    unit: str


def sketch_words(plan: Plan, designs: Mapping[str, Numbers]) -> list[str]:
    """Return where a class differs from its drawing, and fitting values; dimensions that a design has set anew are left out."""
    found = [f"{name}: {words}" for name, part in plan.of_kind(Part).items() for words in sketch_words(part.plan, part.plan.defaults)]
    if all(point.drawn_at is None for point in plan.points.values()):
        return found
    try:
        inputs = inputs_at(plan, plan.sketch_strokes)
    except AssemblyError:
        return found
    known = list(sketch_differences(plan, inputs))
    remedy = fitting_strokes(plan, inputs, known) or said("Correct it, or move the point in the drawing.")
    set_otherwise = plan.reading({**inputs, **designs})
    for each in known:
        if np.all(set_otherwise.value(each.quantity) == each.given):
            unit = "mm" if each.unit == "m" else each.unit
            words = said(
                "The sketch has {label} = {drawn} at {strokes}, the class says {given}: {point} stands {off} from its at=. {remedy}",
                label=each.label, drawn=show(each.drawn, unit, 4), strokes=strokes_text(plan, plan.sketch_strokes),
                given=show(each.given, unit, 4), point=each.point, off=show(each.off, "mm", 2), remedy=remedy,
            )  # fmt: skip
            found.append(words)
    return found


def guide_points(plan: Plan) -> set[str]:
    """Return the points that only give a guide its direction, and those where guides cross."""
    used = {name for member in plan.members.values() if not isinstance(member, Guide) for name in needs(member)}
    return {name for guide in plan.of_kind(Guide).values() for name in needs(guide)} - used | plan.of_kind(GuideCross).keys()


@np.errstate(all="ignore")
def width_words(plan: Plan, designs: Mapping[str, Numbers]) -> str:
    """Return the width of a machine at its sketch where it is too large for one, and a remedy; else nothing.

    Points that only give a guide its direction, and those where guides cross, may be as far as they like.
    """
    far = plan.made("points of guides alone", lambda _: guide_points(plan))
    try:
        inputs = {**inputs_at(plan, plan.sketch_strokes), **designs}
        reading = plan.read({name: np.asarray(value) for name, value in inputs.items()})  # of arrays, so that nothing is divided by zero
    except AssemblyError:
        return ""
    places = [reading.at(name) for name in plan.points if name not in far]
    if not places:
        return ""
    parts = np.array(np.broadcast_arrays(*(part for each in places for part in (each.x, each.y))), float)
    spans = [np.fmax.reduce(one) - np.fmin.reduce(one) for one in (parts[0::2], parts[1::2])]  # of the points that have a place
    width = float(np.nan_to_num(spans).max())
    if width <= WIDE:
        return ""
    return said(
        "At the pose of its sketch it is {width} wide: a plain number is in metres. Write millimetres with their unit, such as 300 * mm.",
        width=show(width, "m", 4),
    )


@np.errstate(all="ignore")
def sketch_differences(plan: Plan, inputs: Mapping[str, Numbers]) -> Iterator[Difference]:
    """Yield the lengths and angles that are given otherwise than they are drawn."""
    drawing, real = sketch_reading(plan, inputs), plan.read(inputs)
    away = {name: real.at(name) - drawing.at(name) for name, point in plan.points.items() if point.drawn_at is not None}
    off = {name: float(np.hypot(each.x, each.y)) for name, each in away.items()}
    labels: dict[tuple[str, ...], Quantity] = {tuple(sorted(ends)): length for ends, length in plan.table.lengths.items()}
    labels |= {(ends[0], corner, ends[1]): turn for (corner, both), turn in plan.table.angles.items() for ends in [sorted(both)]}
    for points, given in labels.items():
        drawn_points = sorted((name for name in points if name in off), key=lambda name: -off[name])
        if not drawn_points:
            continue
        spelled = {joined_names(*points), joined_names(*reversed(points))}
        label = next((each for each in (*plan.table.entries, *plan.table.following) if each in spelled), min(spelled))
        has = float(drawing.value(given))
        P, Q, *R = (complex(drawing.at(name).x, drawing.at(name).y) for name in points)
        if R:
            turn = (P - Q).conjugate() * (R[0] - Q)
            drawn = acos(min(1.0, max(-1.0, turn.real / abs(turn)))) if turn else abs(has)
            differs, drawn = abs(abs(remainder(has, 2.0 * pi)) - drawn) > AGREES, drawn if has >= 0.0 else -drawn
        else:
            drawn = abs(P - Q)
            differs = abs(has - drawn) > AGREES * drawn
        if differs:
            yield Difference(label, given, drawn, has, drawn_points[0], off[drawn_points[0]], "deg" if R else "m")


@np.errstate(all="ignore")
def fitting_strokes(plan: Plan, inputs: Mapping[str, Numbers], known: list[Difference]) -> str:
    """Return the strokes at which all lengths are as they are drawn, in words; "" where there are none within the ends of the strokes."""
    strokes = dict(plan.sketch_strokes)
    for each in known:
        own = [name for name in plan.strokes if name in plan.reaches(each.quantity)]
        if each.unit != "m" or len(own) != 1:
            return ""
        (name,) = own
        span = plan.strokes[name].end - plan.strokes[name].start
        ends = [float(plan.reading({**inputs, **strokes, name: strokes[name] + step}).value(each.quantity)) for step in (0.0, span)]
        if ends[0] == ends[1]:
            return ""
        strokes[name] = float(f"{strokes[name] + span * (each.drawn - ends[0]) / (ends[1] - ends[0]):.{DIGITS}g}")
    there = plan.reading({**inputs, **strokes})
    inside = all(min(each.start, each.end) <= strokes[name] <= max(each.start, each.end) for name, each in plan.strokes.items())
    if not known or not inside or any(abs(float(there.value(each.quantity)) - each.drawn) > AGREES * each.drawn for each in known):
        return ""
    changed = {name: value for name, value in strokes.items() if value != plan.sketch_strokes[name]}
    return said("drawn({strokes}) fits.", strokes=", ".join(f"{name}={value!r}" for name, value in changed.items()))
