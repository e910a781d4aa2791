"""Members that cannot be placed, in words: the point, its triangle, the missing millimetres, the remedy."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from ..quantities import joined_names, needs, source_text
from ..steps import Guide, Point, Step
from ..units import mm
from ..vectors import FloatArray, Mask
from .members import Members, plan_measure
from .reading import ArrayReading

#: A side so many times longer than the others was given in another unit.
MISTAKEN = 90.0
WIDE = 200.0
"""A machine of more metres across has millimetres that were taken for metres."""


def failures(plan: Members, reading: ArrayReading, shape: tuple[int, ...]) -> Iterator[tuple[str, Mask]]:
    """Yield the members that cannot be placed at some poses of a reading, in the order of construction, with those poses."""
    for name in plan.members:
        mask = negative(plan, reading, shape, name) | np.isnan(reading.sines.get(name, 0.0))
        if name in plan.points:
            place = reading.at(name)
            mask |= ~(np.isfinite(place.x) & np.isfinite(place.y))
        if mask.any():
            yield name, mask


def negative(plan: Members, reading: ArrayReading, shape: tuple[int, ...], point: str = "") -> Mask:
    """Return the poses where a length that follows others is negative: of one point, or any."""
    mask = np.zeros(shape, bool)
    for owner, length in plan.following:
        if point in (owner, ""):
            mask |= np.asarray(reading.value(length)) < 0.0
    return mask


def opening(plan: Members, name: str) -> str:
    """Return how a sentence about a member begins: `B = Dyad(A, O)`; a pin of a group goes by the group."""
    member = plan.members[name]
    if member.companions:
        return next(f"{each} = {found}" for each, found in plan.groups.items() if found.pins == member.companions)
    return member.sentence() if isinstance(member, Step) else f"{name} = {member}"


def name_or_pins(plan: Members, name: str) -> str:
    """Return a member's name; a pin of a group goes by the names of all its pins."""
    group = plan.members[name].companions
    return f"the group {' '.join(group)}" if group else name


def missing_words(plan: Members, name: str, reading: ArrayReading, lost: Mask) -> tuple[str, float]:
    """Return why a member cannot be placed at the poses `lost` of a reading, at the worst of them, and the missing length [m]."""
    for owner, length in plan.following:
        least = float(np.min(reading.value(length)))
        if owner == name and least < 0.0:
            return f"the length {source_text(length)} = {least:.4g} m is negative. Keep the stroke where it is positive.", -least
    step = plan.members[name]
    parents = [getattr(step, letter) for letter in step.parent_letters] if isinstance(step, Step) else [*needs(step)]
    guides = plan.of_kind(Guide)
    for names in (parents, *(guides[each].points for each in parents if each in guides)):
        if len(names) != 2 or not set(names) <= set(plan.points):
            continue
        base = reading.at(names[1]) - reading.at(names[0])
        if np.any((base.x == 0.0) & (base.y == 0.0)):
            told = f"{names[0]} and {names[1]} coincide there, so that no direction goes from one to the other. Move one of them."
            return told, float("nan")
    angles = [angle for angle in reading.directions if np.any(np.isnan(reading.inputs.get(angle, 0.0)))]
    used = {str(part) for each in plan.reaches(name) for part in plan.with_parts(each)} if angles else set[str]()
    for angle in angles:
        if angle in used:
            why = "on the way its ends meet, or a pose is out of reach"
            other = "Take a whole multiple of it, which need not be followed, or drive the angle by a Stroke"
            return f"{angle}, whose whole turns count here, cannot be followed there from the sketch: {why}. {other}.", float("nan")
    tables = [reading.outside[each] for each in (name, *sorted(plan.reaches(name))) if each in reading.outside]
    if tables:
        return f"{tables[0]}. Shorten the stroke or give the table more rows.", float("nan")
    return triangle_words(plan, name, reading, lost)


def triangle_words(plan: Members, name: str, reading: ArrayReading, lost: Mask) -> tuple[str, float]:
    """Return how a triangle misses, at its worst pose, and by how much [m]."""
    member = plan.members[name]
    sides = member.sides(reading)
    if not sides:
        words, gaps = member.shortage(reading) if isinstance(member, Point) else ("it has no value", float("nan"))
        gap = float(np.max(gaps))
        amount = "" if np.isnan(gap) else f": {length_text(gap)} are missing"
        return f"{words}{amount}. {'Shorten the stroke or change' if plan.moves(member) else 'Change'} a dimension.", gap
    labels = [label for label, _ in sides]
    values = np.array(np.broadcast_arrays(*(value for _, value in sides), lost)[:-1], float).reshape(len(sides), -1)[:, lost]
    for label, value in zip(labels, values, strict=True):
        if not np.all(np.isfinite(value)):
            return f"{label} has no finite value there. Change the strokes or what it follows.", float("nan")
    with np.errstate(all="ignore"):
        missing = 2 * values.max(axis=0) - values.sum(axis=0)
    if not np.any(np.isfinite(missing)):
        return f"{', '.join(labels)} are beyond all measure, up to {values.max():.4g} m. Look for extreme numbers.", float("nan")
    worst = int(np.nanargmax(missing))
    longest = int(values[:, worst].argmax())
    others = [index for index in range(3) if index != longest]
    gap, whole = float(missing[worst]), f"{labels[longest]} = {values[longest, worst]:.4g} m"
    short = f"{' + '.join(labels[index] for index in others)} = {values[others, worst].sum():.4g} m is {length_text(gap)} short of {whole}"
    return f"{short}. {remedy(plan, name, labels, longest, values[:, worst], reading)}", gap


def length_text(length: float) -> str:
    """Return a length [m] in millimetres, in metres from 1 m on."""
    return f"{length / mm:.3g} mm" if length < 1.0 else f"{length:.3g} m"


def remedy(plan: Members, name: str, labels: Sequence[str], longest: int, values: FloatArray, reading: ArrayReading) -> str:
    """Return the remedy: the stroke that a side follows, a dimension that closes the gap, or a unit that looks mistaken."""
    others = [index for index in range(len(labels)) if index != longest]
    for given, usual in plan.defaults.items():  # a dimension that is given in millimetres is the cause, whatever it makes too long
        value = float(np.max(np.abs(reading.inputs.get(given, 0.0))))
        if value > MISTAKEN * abs(usual) > 0.0 and plan_measure(plan, given) == "length":
            return f"Are all lengths in m? {given} = {value:.6g} m, {usual:.4g} m in the class, would be {value:.6g} * mm."
    short, middle = sorted(values[others])
    is_short = values[longest] > WIDE / 10.0 and middle > MISTAKEN * short and values[longest] - middle > 10.0 * short
    if is_short or values[longest] > min(WIDE, MISTAKEN * middle):
        return f"Are all lengths in m? {values[longest]:.6g} m would be {values[longest]:.6g} * mm."
    free = [labels[index] for index in others if labels[index] in plan.table.spellings]
    other = f"shorten {labels[longest]}" if labels[longest] in plan.table.spellings else "move its points closer"
    change = f"lengthen {free[-1]}" if free else other
    if not plan.moves(plan.members[name]):
        return f"{change[0].upper()}{change[1:]}."
    growth = [(1.0 if index == longest else -1.0) * growth_of(plan, label, reading) for index, label in enumerate(labels)]
    start = "Start the stroke later" if sum(growth) < 0.0 else "Shorten the stroke"
    return f"{start} or {change}."


def growth_of(plan: Members, label: str, reading: ArrayReading) -> float:
    """Return how the length of a label that follows a stroke grows with it; 0 for one that follows none."""
    named = [each for ends, each in plan.table.lengths.items() if label in (joined_names(*sorted(ends)), joined_names(*sorted(ends)[::-1]))]
    if not named:
        return 0.0
    length, total = named[0], 0.0
    reached = plan.reaches(length)
    for name in (name for name in plan.strokes if name == length.name or name in reached):
        step = 1e-6 * (abs(plan.strokes[name].end - plan.strokes[name].start) or 1.0)
        there = ArrayReading(plan.members, plan.table.lengths, {**reading.inputs, name: np.asarray(reading.inputs[name]) + step})
        total += float(np.sum(np.asarray(there.value(length)) - np.asarray(reading.value(length))) / step)
    return total
