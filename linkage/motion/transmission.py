"""The least transmission angles along a stroke: of every dyad whose angle changes with it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from ..program import FloatArray
from .limits import Extreme, Interval

if TYPE_CHECKING:
    from .motion import Motion

COUNT, FINE, TIMES = 721, 17, 5
STILL = 1e-9
"""A transmission angle that changes by less [rad] does not follow the stroke."""


def transmission(motion: Motion, name: str, held: Mapping[str, float], found: Sequence[Interval]) -> tuple[Extreme, ...]:
    """Return the least transmission angle of every dyad that moves with a stroke, over its declared and reachable part."""
    ends = sorted((motion.plan.strokes[name].start, motion.plan.strokes[name].end))
    parts = [(max(each.low, ends[0]), min(each.high, ends[1])) for each in found]
    at = np.concatenate([np.empty(0), *(np.linspace(low, high, COUNT) for low, high in parts if low < high)])
    if not at.size:
        return ()
    wide = motion.moved({**held, name: at})
    return tuple(least(motion, name, held, joint, wide) for joint in wide.joints if changes(wide.transmission_angle(joint)))


def changes(angle: FloatArray) -> bool:
    """Return whether an angle [rad] changes along a motion."""
    return bool(np.nanmax(angle) - np.nanmin(angle) > STILL)


def least(motion: Motion, name: str, held: Mapping[str, float], joint: str, wide: Motion) -> Extreme:
    """Return a joint's least transmission angle near the least one of a motion."""
    at, angle = wide.strokes[name], folded(wide, joint)
    for _ in range(TIMES):
        place = int(np.argmin(angle))
        at = np.linspace(at[max(place - 1, 0)], at[min(place + 1, len(at) - 1)], FINE)
        angle = folded(motion.moved({**held, name: at}), joint)
    place = int(np.argmin(angle))
    return Extreme(joint, float(angle[place]), float(at[place]))


def folded(motion: Motion, joint: str) -> FloatArray:
    """Return a joint's transmission angle folded to 0 ... pi/2 [rad]; infinite where it is not reached."""
    angle = motion.transmission_angle(joint)
    return np.where(np.isnan(angle), np.inf, np.minimum(angle, np.pi - angle))
