"""Which poses are among those that a judge looks at: in a box, or near a leg or a pose, and where its conditions hold."""

from __future__ import annotations

import numpy as np

from ..plan import Mask
from .judge import Domain, Judge
from .motion import Motion, require_motion

NEAR = 0.02
"""Of a stroke's travel: a pose that is no farther from a leg, a pose or a held value, in every stroke, is looked at with it."""
ROUNDING = 1e-9
"""Of a stroke's travel: a pose that is no farther outside a box stands at its border."""


def judged_poses(judge: Judge, motion: Motion) -> Mask:
    """Return which poses of a motion a judge looks at.

    Parameters
    ----------
    judge : Judge
        Who looks, over its `Over`s: `machine.judge()`.
    motion : Motion
        Poses of the same machine.

    Returns
    -------
    array of bool
        Of the motion's shape: True in a box of strokes, or where no stroke is farther than 2 % of its travel from a leg of a path, a pose
        or the value at which a box holds it; and where the conditions of that `Over` (`only`) are kept.
    """
    found = np.zeros(require_motion(motion).shape, bool)
    for place in judge.places:
        found |= covered(place, motion) & place.over.kept(motion)
    return found


def covered(place: Domain, motion: Motion) -> Mask:
    """Return which poses lie in the box, or near a leg or a pose, of an `Over`."""
    values, spans = (np.broadcast_arrays(*each.strokes.values()) for each in (motion, place.motion))
    inside, low, high = np.ones((1,), bool), np.zeros(1), np.ones(1)
    for stroke, of_poses, span in zip(motion.plan.strokes.values(), values, spans, strict=True):
        travel, value, ends = abs(stroke.end - stroke.start), of_poses[..., None], np.ravel(span)
        if place.over.shape == "box":
            near = (ROUNDING if np.ptp(ends) > 0.0 else NEAR) * travel
            inside = inside & (value >= ends.min() - near) & (value <= ends.max() + near)
            continue
        is_path = place.over.shape == "path" and ends.size > 1
        start, step = (ends[:-1], np.diff(ends)) if is_path else (ends, np.zeros(ends.size))
        # the shares of each leg at which this stroke is near enough: all strokes must be so at one of them
        with np.errstate(divide="ignore", invalid="ignore"):
            first, last = ((value - start + sign * NEAR * travel * np.sign(step)) / step for sign in (-1.0, 1.0))
        moves = step != 0.0
        inside = inside & (moves | (np.abs(value - start) <= NEAR * travel))
        low = np.maximum(low, np.where(moves, first, 0.0))
        high = np.minimum(high, np.where(moves, last, 1.0))
    return np.broadcast_to((inside & (low <= high)).any(axis=-1), motion.shape)
