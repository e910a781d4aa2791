"""Where a class says otherwise than its own drawing: a length or an angle that is given, and is not as it is drawn."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from math import acos, pi, remainder
from typing import final

import numpy as np

from ..errors import AssemblyError
from ..language import said
from ..plan import Part, Plan, strokes_text
from ..quantities import Quantity, joined_names, needs
from ..steps import Guide, GuideCross
from ..units import show
from ..vectors import Numbers
from .sketch import inputs_at, sketch_reading

AGREES = 1e-3
"""A given length is that of the drawing to this part of it, an angle to so many rad: a drawing is read off to a millimetre in a metre."""
WIDE = 200.0
"""A machine of more metres across has millimetres that were taken for metres."""
DIGITS = 3
"""Digits of the stroke that is named as a remedy."""


@final
@dataclass(frozen=True)
class Difference:
    """A length [m] or an angle [rad] that is given otherwise than it is drawn, and which of its points stands off its place [m]."""

    label: str
    quantity: Quantity
    drawn: float
    given: float
    point: str
    off: float
    unit: str


def sketch_words(plan: Plan, designs: Mapping[str, Numbers]) -> list[str]:
    """Return where a class says otherwise than its drawing, and what fits; not of what a design has set otherwise than its class."""
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


@np.errstate(all="ignore")
def width_words(plan: Plan, designs: Mapping[str, Numbers]) -> str:
    """Return how wide a machine is at the pose of its sketch, and what to write, where no machine is; else nothing.

    Points that only give a guide its direction, and those where guides cross, may be as far as they like.
    """
    used = {name for member in plan.members.values() if not isinstance(member, Guide) for name in needs(member)}
    far = {name for guide in plan.of_kind(Guide).values() for name in needs(guide)} - used | plan.of_kind(GuideCross).keys()
    try:
        reading = plan.read({**inputs_at(plan, plan.sketch_strokes), **designs})
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
    )  # fmt: skip


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
