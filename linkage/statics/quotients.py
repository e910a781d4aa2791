"""Quotients of forces and ratios: refused where the divisor vanishes, by the same conditions as ratios at a dead point."""

from __future__ import annotations

import warnings

import numpy as np

from ..errors import SingularError, SingularWarning
from ..motion.conditions import REFUSE, WARN, be, condition
from ..motion.reach import where_words
from ..program import FloatArray
from .poses import Poses


def quotient(poses: Poses, divisor: FloatArray, size: FloatArray, what: str, reason: str) -> FloatArray:
    """Return a divisor (n,), NaN where it is lost beside the `size` (n,) of what it is the part of.

    SingularError where the condition, size over divisor, is above that at which ratios are refused, unless the motion was asked for
    with `unreachable="nan"`; a warning with the error to expect near it. `what` opens the sentence, `reason` ends it.
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        cond = condition(np.where(size > 0.0, divisor / np.where(size > 0.0, size, 1.0), 0.0))
    return refused_where(poses, divisor, cond, what, reason)


def refused_where(poses: Poses, values: FloatArray, cond: FloatArray, what: str, reason: str) -> FloatArray:
    """Return values (..., n) with NaN where a condition (n,) is refused; raise or warn as for ratios."""
    lost = ~(cond <= REFUSE)
    motion = poses.motion
    if lost.any():
        mask = poses.full(lost.astype(float)) == 1.0
        if motion.unreachable == "raise":
            where = where_words(motion.plan, mask, motion.strokes)
            worst = float(np.max(np.nan_to_num(cond[lost], nan=np.inf)))
            size = "infinite" if np.isinf(worst) else f"{worst:.1e}"
            text = f"{what} {be(what)} refused {where}: {reason} (condition {size}, refused above {REFUSE:.0e})."
            raise SingularError(text, mask=mask, motion=motion)
    near = (cond > WARN) & ~lost
    if near.any():
        worst = float(cond[near].max())
        where = where_words(motion.plan, poses.full(near.astype(float)) == 1.0, motion.strokes)
        # one division by a difference that is lost: the error goes with the condition, not its square
        error = f"expect a relative error of about {np.finfo(float).eps * worst:.0e}"
        text = f"{what} {be(what)} nearly refused {where}, for close by {reason} (condition {worst:.1e}); {error}."
        warnings.warn(text, SingularWarning, stacklevel=5)
    return np.where(lost, np.nan, values)
