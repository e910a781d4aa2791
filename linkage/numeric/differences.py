"""Numerical differentiation, as in the papers: differences of positions at shifted strokes.

Two-sided differences where both neighbours can be reached, one-sided ones where not. The step is chosen at every pose by comparing
extrapolated estimates (Richardson), and what is lost is reported.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

from ..vectors import FloatArray

RATIO = 4.0
STEPS = 14
FIRST = 8e-2
WARN = {1: 1e-6, 2: 1e-5}
"""By order: the relative error above which a numerical derivative warns; a second difference loses twice the digits."""
USELESS, COARSE = 1e-3, 1e-1
"""The error, against the greatest value of all poses, above which a derivative as uncertain as it is large is refused; with a step
that was given, which may be meant to be coarse."""
STILL = {1: 1e-3, 2: 1e-1}
"""By order: a derivative this much smaller than value over span counts as none, only rounding is left of its differences."""
ROUNDING = 4 * np.finfo(float).eps


def derivative(
    values: Callable[[FloatArray], FloatArray], span: float, order: int, step: float | None, least: float = 0.0
) -> tuple[FloatArray, FloatArray, float]:
    """Return a derivative, the estimate of its error, and the size below which it counts as none.

    `values(offsets)` returns the function at strokes shifted by each offset, along a new last axis; NaN where
    unreachable. `span` is the length of the stroke [m or rad], `least` the size that its values have at least. With
    `step` a plain difference of that step is taken. Its error, of rounding and of the step's length, is what it differs by from
    the one whose steps are chosen, and the error of that.
    """
    steps = FIRST * span * RATIO ** -np.arange(float(STEPS))
    zero, two, one = differences(values, steps, order)
    still = STILL[order] * float(np.max(np.abs(zero), initial=least, where=np.isfinite(zero))) / span**order
    floor = ROUNDING * np.abs(zero) / steps[2:] ** order
    estimates, spread = np.concatenate([_extrapolated(two, floor), _extrapolated(one, floor)], axis=-1)
    spread = np.where(np.isfinite(spread), spread, np.inf)
    place = np.argmin(spread, axis=-1)[..., None]  # of least error
    error = np.take_along_axis(spread, place, axis=-1)[..., 0]
    found = np.where(np.isfinite(error), np.take_along_axis(estimates, place, axis=-1)[..., 0], np.nan)
    if step is None:
        return found, error, still
    _, two, one = differences(values, np.array([step]), order)
    plain = np.where(np.isfinite(two), two, one)[..., 0]
    with np.errstate(all="ignore"):
        off = np.abs(plain - found) + error
    return plain, np.where(np.isnan(off), np.inf, off), still


def differences(values: Callable[[FloatArray], FloatArray], steps: FloatArray, order: int) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return the function itself, and its two-sided and one-sided differences of some steps, along a last axis; NaN out of reach."""
    at = values(np.concatenate([[0.0], steps, -steps, 2 * steps, -2 * steps, 3 * steps, -3 * steps]))
    zero, (ahead, back, ahead2, back2, ahead3, back3) = at[..., :1], np.split(at[..., 1:], 6, axis=-1)
    with np.errstate(all="ignore"):  # a step may be so small that its square is none
        if order == 1:
            two, forth, rear = ahead - back, -3 * zero + 4 * ahead - ahead2, 3 * zero - 4 * back + back2
            return zero, two / (2 * steps), np.where(np.isfinite(ahead2), forth, rear) / (2 * steps)
        two = ahead - 2 * zero + back
        forth, rear = 2 * zero - 5 * ahead + 4 * ahead2 - ahead3, 2 * zero - 5 * back + 4 * back2 - back3
        return zero, two / steps**2, np.where(np.isfinite(ahead3), forth, rear) / steps**2


def _extrapolated(estimate: FloatArray, floor: FloatArray) -> FloatArray:
    """Return estimates of second order, extrapolated to the fourth (two-sided) or third (one-sided), each with its error.

    The error is the larger change to the steps on either side, one of which may be small by chance, and not below
    rounding. It counts only where the changes
    shrink with the step: next to a dead point coarse steps agree with each other and not with the derivative.
    """
    better = (RATIO**2 * estimate[..., 1:] - estimate[..., :-1]) / (RATIO**2 - 1)
    change = np.abs(np.diff(better, axis=-1))
    known = np.where(np.isfinite(change), change, np.inf)
    edge = np.full((*known.shape[:-1], 1), np.inf)
    before, after = np.concatenate([edge, known[..., :-1]], axis=-1), np.concatenate([known[..., 1:], edge], axis=-1)
    shrinks = (np.isfinite(before) & (known <= before)) | (after <= known) | (known <= 1e-3 * np.abs(better[..., 1:]))
    beside = np.where(np.isfinite(after), after, np.where(np.isfinite(before), before, 0.0))
    error = np.maximum(np.maximum(change, beside), floor)
    return np.stack([better[..., 1:], np.where(shrinks, error, np.maximum(error, np.abs(better[..., 1:])))])


def losses(found: FloatArray, error: FloatArray, still: float, axes: int, most: float = USELESS) -> tuple[npt.NDArray[np.bool_], float]:
    """Return the poses where a derivative is as uncertain as it is large, and the worst error of the others.

    The error is relative to the derivative's greatest value, of which only what is certain counts; poses are the last `axes` axes.
    """
    components = tuple(range(found.ndim - axes))
    local, off = np.max(np.abs(found), axis=components), np.max(error, axis=components)
    with np.errstate(invalid="ignore"):
        sure = local - off
    size = float(np.max(sure, initial=still, where=np.isfinite(sure)))
    useless = np.isfinite(local) & (off > 0.1 * local) & (off > most * size)
    kept = np.where(np.isfinite(local) & ~useless, off, 0.0)
    return useless, float(np.max(kept, initial=0.0)) / size if size else 0.0
