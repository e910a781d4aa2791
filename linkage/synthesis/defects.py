"""Defects of a machine for a task, in words: where it cannot be assembled, and the circuit, the branch and the order of points."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..language import said
from ..mechanism import Mechanism
from ..mobility import FourBar
from ..motion import stroke_display_unit
from ..steps import Step
from ..study.variants import ENDING, on_sides
from ..units import deg, show
from ..vectors import FloatArray, Mask, Side
from .fit import Fit, goes_one_way

RUN = 721
"""Poses of a stroke at which is looked where a machine that does not run can be assembled."""
FAR_OFF, NEARER = 0.05, 0.1
"""Of a task's size: points that are missed by more are looked for on other branches; they lie there where that misses by this part."""
TOLD = 3
"""Answers that a sentence lists, and machines that do not run."""
NEAR_CHANGE_POINT = 1.0 * deg
"""A machine whose least transmission angle is less passes near a change point."""
NEAR_GRASHOF = 0.01
"""Of the longest link: a margin that is less is told."""


def in_order(fit: Fit, at: FloatArray, base: FloatArray) -> bool:
    """Return whether a design comes to the points one after the other, to either side, within one turn or the stroke."""
    return goes_one_way(fit.timing.one_way(fit.strokes(at[None], base[None]))[0], abs(fit.timing.span))


def order_words(fit: Fit, at: FloatArray, base: FloatArray) -> str:
    """Return in which order a design comes to the points, within one turn or the stroke from the first one on: `1, 3, 2, 4-6`."""
    strokes = fit.timing.one_way(fit.strokes(at[None], base[None]))[0]
    along = (strokes - strokes[0]) * (1.0 if strokes[-1] >= strokes[0] else -1.0)
    along = np.mod(along + 1e-9, fit.timing.turn) if fit.timing.turn else along
    return point_ranges((np.argsort(along, kind="stable") + 1).tolist())


def circuit_words(fit: Fit, at: FloatArray, base: FloatArray) -> str:
    """Return where a design cannot be assembled over its stroke, and which points lie on which part of it; "" for one that can.

    Parts of the stroke are circuits where one step alone closes the machine; where several do they may hang together by other branches.
    """
    _, reached = fit.swept(at[None], RUN)
    mask = reached[0]
    if mask.all():
        return ""
    timing, last = fit.timing, RUN if fit.timing.turn else RUN - 1
    number = connected_parts(mask, closed=bool(timing.turn))
    strokes = timing.within(fit.strokes(at[None], base[None])[0])
    places = np.round((strokes - timing.start) / timing.span * last).astype(int) % RUN
    groups: dict[int, list[int]] = {}
    for point, place in enumerate(places.tolist(), 1):
        near = place if mask[place] or not mask.any() else int(np.argmin(np.where(mask, np.abs(np.arange(RUN) - place), RUN)))
        groups.setdefault(int(number[near]), []).append(point)
    unit = stroke_display_unit(fit.plan, timing.stroke, "mm")
    gaps = lost_stretches(mask, closed=bool(timing.turn))
    ends = [[show(float(timing.start + timing.span * each / last), unit, 4) for each in gap] for gap in gaps]
    where = said(" and ").join(
        said("at {stroke} = {value}", stroke=timing.stroke, value=low)
        if low == high
        else said("between {stroke} = {low} and {high}", stroke=timing.stroke, low=low, high=high)
        for low, high in ends
    )
    lost = said("it cannot be assembled {where}", where=where)
    if len(groups) < 2:
        return lost
    closing = [each for each in fit.plan.of_kind(Step).values() if each.closes and each.modes()]
    if len(closing) == 1 and not fit.plan.groups:  # both of its branches meet at the ends of each part of the stroke
        return f"{lost}; {points_on_circuits([*groups.values()])}"
    parts = [points_lie(each) for each in groups.values()]
    told = ", ".join(said("{points} on part {number} of its motion", points=each, number=k) for k, each in enumerate(parts, 1))
    return f"{lost}; {told}"


def points_on_circuits(groups: Sequence[Sequence[int]]) -> str:
    """Return which points lie on which circuit, in words."""
    if len(groups) == 2:
        return said("{points} on the one circuit, {others} on the other", points=points_lie(groups[0]), others=point_ranges(groups[1]))
    return ", ".join(said("{points} on circuit {number}", points=points_lie(each), number=k) for k, each in enumerate(groups, 1))


def connected_parts(mask: Mask, *, closed: bool) -> FloatArray:
    """Return the number of the connected part of a stroke that each pose (n,) lies in; a turn's last part goes on with its first."""
    number = np.cumsum(np.concatenate([[0], (mask[1:] & ~mask[:-1]).astype(int)]))
    if closed and mask[0] and mask[-1]:
        number[number == number[-1]] = number[0]
    return np.asarray(number, float)


def lost_stretches(mask: Mask, *, closed: bool) -> list[tuple[int, int]]:
    """Return the first and the last pose of every stretch that is not in a mask; of a turn one may go over its end."""
    lost = np.flatnonzero(~mask)
    runs = [(int(run[0]), int(run[-1])) for run in np.split(lost, np.flatnonzero(np.diff(lost) > 1) + 1)]
    if closed and len(runs) > 1 and runs[0][0] == 0 and runs[-1][1] == len(mask) - 1:
        runs = [*runs[1:-1], (runs[-1][0], runs[0][1])]
    return runs


def branch_words(fit: Fit, machine: Mechanism, at: FloatArray, base: FloatArray, far: FloatArray) -> str:
    """Return which points that a machine misses by far lie on another branch of it, "" of none: timed ones at their strokes."""
    away = np.flatnonzero(far > FAR_OFF * fit.rows.size)
    if not len(away):
        return ""
    timing = fit.timing
    sought = {name for each in fit.requests for name in each.names(fit.plan)}
    reaches = fit.plan.reaches(*sought)
    steps = {name: step for name, step in fit.plan.of_kind(Step).items() if step.closes and step.modes() and name in reaches}
    strokes = timing.within(fit.strokes(at[None], base[None])[0])
    if timing.width:
        strokes = timing.start + timing.span * np.linspace(0.0, 1.0, RUN)
    for name, step in steps.items():
        other = Side(-step.settled_side)
        every: dict[str, Any] = {each: np.full(strokes.shape, value) for each, value in fit.held.items()} | {timing.stroke: strokes}
        found = on_sides(machine, {name: other}).evaluate([*fit.rows.quantities], unreachable="nan", **every)
        values = np.array(found).reshape(1, len(found), -1)
        if timing.width:
            poses = np.moveaxis(values[0], 1, 0)[:, :, None]
            off = fit.rows.off(np.broadcast_to(poses, (len(poses), *fit.rows.wanted.shape)))
            with np.errstate(invalid="ignore"):
                there = np.fmin.reduce(np.linalg.norm(off, axis=1), axis=0)
        else:
            there = np.linalg.norm(fit.rows.off(values)[0], axis=0)
        lie = [int(k) + 1 for k in away if there[k] < NEARER * far[k]]
        if lie:
            words = {"points": points_lie(lie), "name": f"{name}{ENDING}", "side": other}
            return said("{points} on the other branch, {name} = {side}", **words)
    return ""


def change_point_words(angle: float, four_bars: Sequence[FourBar]) -> list[str]:
    """Return by how much a machine passes near a change point; none for one that keeps away."""
    words = []
    if angle < NEAR_CHANGE_POINT:
        words.append(said("it passes within {angle} of a change point", angle=show(angle, "deg", 3)))
    for each in four_bars:
        if abs(each.margin) < NEAR_GRASHOF * max(each.lengths):
            words.append(said("its Grashof margin is {margin}", margin=show(each.margin, "mm", 3)))
    return words


def points_lie(points: Sequence[int]) -> str:
    """Return which points lie somewhere, the beginning of a sentence: `points 1-4, 7 lie`."""
    numbers = point_ranges(points)
    return said("point {number} lies", number=numbers) if len(points) == 1 else said("points {numbers} lie", numbers=numbers)


def point_ranges(points: Sequence[int]) -> str:
    """Return numbers as text, those in a row as ranges: `1-4, 7`."""
    rows: list[list[int]] = []
    for each in points:
        if rows and rows[-1][-1] == each - 1:
            rows[-1].append(each)
        else:
            rows.append([each])
    return ", ".join(str(row[0]) if len(row) == 1 else f"{row[0]}-{row[-1]}" for row in rows)
