"""Where things are in the sketch: it chooses assembly modes and supplies lengths that are not given."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from copy import copy
from math import atan2, pi, remainder
from typing import Any

import numpy as np

from ..errors import AssemblyError, DefinitionError
from ..plan import ArrayReading, Plan, missing_words, strokes_text
from ..quantities import Member, Operand, Quantity, joined_names, name_of, quantity
from ..steps import Pin, Step
from ..vectors import Numbers, Vec
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

    def counted_from_drawing(self, angle: Quantity, x: float, y: float) -> Quantity:
        """Return an angle [rad] that is counted from where the drawing has a crank, whose vector is (x, y)."""
        beside = remainder(atan2(y, x) - float(self.reading.value(angle)), 2.0 * pi)
        return angle if abs(beside) <= SAME_TURN else beside + angle


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
        driven.angle = drawing.counted_from_drawing(driven.angle, *(X - drawing.at(parents[0])))
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
