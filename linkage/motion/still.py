"""Where a cylinder's length stands still against a stroke: its dead points, at which its thrust moves nothing."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import unwarned
from ..loads import TwoPoint
from ..program import FloatArray
from ..quantities import Distance
from .peaks import SAMPLES, Index, Mask, bisected

if TYPE_CHECKING:
    from .motion import Motion

NEAR = 1e-8
"""How far beside a root it is looked whether the ratio really passes zero, and how far beyond a range's ends for roots on these, of the
range; at a pole the ratio grows instead."""
LOOKS = 65  # poses of each range at which it is looked whether a length follows the stroke
STILL = 1e-9
"""A length that changes by less than this part of its ends' way does not follow a stroke."""
AGAIN = 1e-6
"""Poses whose points are so near to each other, compared with the linkage, are one, as after a full turn."""


def dead_points(motion: Motion, stroke: str, held: Mapping[str, float], ranges: Sequence[tuple[float, float]]) -> list[tuple[float, str]]:
    """Return where along a stroke, in some ranges, lengths of elements that hold stand still: the stroke and the element's name.

    Those whose two points a stroke drives apart never do. The others are held.
    """
    plan = motion.plan
    ranges = [(low, high) for low, high in ranges if low < high]
    if not ranges:
        return []
    driven = {frozenset((bar.P, bar.Q)) for bar in plan.cylinders}
    found: list[tuple[float, str]] = []
    for name, element in plan.of_kind(TwoPoint).items():
        if not element.holds or frozenset(element.ends) in driven:
            continue
        if not any(stroke in plan.reaches(end) for end in element.ends):
            continue
        if not follows(motion, element, stroke, held, ranges):
            continue
        rate = rate_of(motion, element, stroke, held)
        at = np.array(sorted(root for low, high in ranges for root in roots(rate, low, high)))
        found += [(float(each), name) for each in at[first_times(motion, stroke, held, at)]]
    return sorted(found)


def follows(motion: Motion, element: TwoPoint, stroke: str, held: Mapping[str, float], ranges: Sequence[tuple[float, float]]) -> bool:
    """Return whether an element's length changes with a stroke beyond rounding, as that of one between two points of a body does not."""
    at = np.concatenate([np.linspace(low, high, LOOKS) for low, high in ranges])
    moved = motion.moved({**held, stroke: at})
    with unwarned(), np.errstate(all="ignore"):
        way = sum(np.hypot(*moved.ratio(end, wrt=stroke)) for end in element.ends)
        rate = np.abs(moved.ratio(Distance(*element.ends), wrt=stroke))
    return bool(np.any(rate > STILL * way))


def first_times(motion: Motion, stroke: str, held: Mapping[str, float], at: FloatArray) -> Mask:
    """Return which of some strokes (n,) give a pose that no one before gives."""
    if at.size < 2:
        return np.ones(at.shape, bool)
    poses = motion.moved({**held, stroke: at})
    places = np.array([poses[name] for name in motion.plan.points]).reshape(-1, at.size)
    apart = np.abs(places[:, :, None] - places[:, None, :]).max(axis=0)
    size = float(np.ptp(places.reshape(-1, 2, at.size), axis=0).max(initial=0.0))
    return np.asarray(~np.tril(apart <= AGAIN * size, -1).any(axis=1))


def rate_of(motion: Motion, element: TwoPoint, stroke: str, held: Mapping[str, float]) -> Callable[[FloatArray], FloatArray]:
    """Return the ratio of an element's length by a stroke, as a function of that stroke (n,); NaN where it has none."""
    length = Distance(*element.ends)

    def rate(at: FloatArray) -> FloatArray:
        with unwarned(), np.errstate(all="ignore"):
            return motion.moved({**held, stroke: at}).ratio(length, wrt=stroke)

    return rate


def roots(rate: Callable[[FloatArray], FloatArray], low: float, high: float) -> list[float]:
    """Return where a function passes zero between two strokes, or at one of them, to 1e-13 of the range between them."""
    ends, beyond = (low, high), 2.0 * NEAR * (high - low)
    low, span = low - beyond, high - low + 2.0 * beyond
    t = np.linspace(0.0, 1.0, SAMPLES + 1)
    values = rate(low + span * t)
    known = np.flatnonzero(np.isfinite(values) & (values != 0.0))  # a sample on a root lies between its neighbours
    before, after = known[:-1], known[1:]
    crossed = np.flatnonzero((values[before] < 0.0) != (values[after] < 0.0))
    found = []
    for place in crossed.tolist():
        first, last = before[place], after[place]
        sense = np.sign(values[first])

        def look(leg: Index, t: FloatArray, sense: Any = sense) -> tuple[FloatArray, Mask]:
            seen = rate(low + span * t.ravel()).reshape(t.shape)[None]
            return np.where(sense * seen > 0.0, seen, np.nan), np.isfinite(seen[0])

        root = float(bisected(look, np.zeros((1, 1, 1), int), t[first].reshape(1, 1, 1), t[last].reshape(1, 1, 1))[0, 0, 0])
        if passes(rate, low + span * root, NEAR * span, sense):
            found.append(float(np.clip(low + span * root, *ends)))
    return found


def passes(rate: Callable[[FloatArray], FloatArray], root: float, near: float, sense: float) -> bool:
    """Return whether a function passes zero at a place: of this sign before, of the other behind, and much less there than beside."""
    before, here, behind = (sense * rate(root + near * np.array([-1.0, 0.0, 1.0]))).tolist()
    return bool(before > 0.0 > behind and abs(here) < 0.5 * min(before, -behind))
