"""The least transmission angles along a stroke: of every dyad whose angle changes with it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from ..program import FloatArray
from .limits import Extreme, Interval
from .peaks import SAMPLES, Index, Mask, highest, samples

if TYPE_CHECKING:
    from .motion import Motion

STILL = 1e-9
"""A transmission angle that changes by less [rad] does not follow the stroke."""


def transmission(motion: Motion, name: str, held: Mapping[str, float], found: Sequence[Interval]) -> tuple[Extreme, ...]:
    """Return the least transmission angle of every dyad that moves with a stroke, over its declared and reachable part."""
    ends = sorted((motion.plan.strokes[name].start, motion.plan.strokes[name].end))
    parts = np.array([(max(each.low, ends[0]), min(each.high, ends[1])) for each in found if each.low < ends[1] and each.high > ends[0]])
    if not parts.size:
        return ()
    low, high, long = parts[:, 0], parts[:, 1], np.ptp(parts, axis=1)
    counts = [max(int(np.ceil(SAMPLES * each)), 2) for each in long / (ends[1] - ends[0])]

    def stroke(leg: Index, t: FloatArray) -> FloatArray:
        return np.where(t == 1.0, high[leg], low[leg] + long[leg] * t)

    def look(leg: Index, t: FloatArray) -> tuple[FloatArray, Mask]:
        wide = motion.moved({**held, name: stroke(leg, t).ravel()})
        return -np.array([[folded(wide, joint)] for joint in moving]), wide.reached[None]

    wide = motion.moved({**held, name: stroke(*samples(counts))})
    moving = [joint for joint in wide.joints if changes(wide.transmission_angle(joint))]
    if not moving:
        return ()
    least = highest(look, counts)
    strokes = stroke(least.leg, least.t)
    return tuple(Extreme(joint, -float(least.value[row, 0]), float(strokes[row, 0])) for row, joint in enumerate(moving))


def changes(angle: FloatArray) -> bool:
    """Return whether an angle [rad] changes along a motion."""
    return bool(np.nanmax(angle) - np.nanmin(angle) > STILL)


def folded(motion: Motion, joint: str) -> FloatArray:
    """Return a joint's transmission angle folded to 0 ... pi/2 [rad]; NaN where it is not reached."""
    angle = motion.transmission_angle(joint)
    return np.minimum(angle, np.pi - angle)
