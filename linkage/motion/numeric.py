"""Numerical differentiation, as in the papers: differences of positions at shifted strokes.

Two-sided differences where both neighbours can be reached, one-sided ones where not; the step is chosen at
every pose by comparing extrapolated estimates (Richardson), and what is lost is told.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from ..program import FloatArray

RATIO = 4.0
STEPS = 10
FIRST = 1e-2


def derivative(values: Callable[[FloatArray], FloatArray], span: float, order: int, step: float | None) -> tuple[FloatArray, FloatArray]:
    """Return a derivative and the estimate of its error.

    `values(offsets)` returns the function at strokes shifted by each offset, along a new last axis; NaN where
    unreachable. `span` is the length of the stroke [m or rad]. With `step` a plain difference of that step is taken.
    """
    steps = np.array([step]) if step is not None else FIRST * span * RATIO ** -np.arange(float(STEPS))
    at = values(np.concatenate([[0.0], steps, -steps, 2 * steps, -2 * steps, 3 * steps, -3 * steps]))
    zero, (ahead, back, ahead2, back2, ahead3, back3) = at[..., :1], np.split(at[..., 1:], 6, axis=-1)
    if order == 1:
        two = (ahead - back) / (2 * steps)
        one = np.where(np.isfinite(ahead2), (-3 * zero + 4 * ahead - ahead2) / (2 * steps), (3 * zero - 4 * back + back2) / (2 * steps))
    else:
        two = (ahead - 2 * zero + back) / steps**2
        one = np.where(np.isfinite(ahead3), 2 * zero - 5 * ahead + 4 * ahead2 - ahead3, 2 * zero - 5 * back + 4 * back2 - back3) / steps**2
    if step is not None:
        best = np.where(np.isfinite(two), two, one)[..., 0]
        return best, np.zeros_like(best)
    return _best(np.concatenate([_extrapolated(two), _extrapolated(one)], axis=-1))


def _extrapolated(estimate: FloatArray) -> Any:
    """Return estimates of second order, extrapolated to the fourth (two-sided) or third (one-sided), with a spread."""
    better = (RATIO**2 * estimate[..., 1:] - estimate[..., :-1]) / (RATIO**2 - 1)
    return np.stack([better[..., 1:], np.abs(np.diff(better, axis=-1))])


def _best(table: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return, at every pose, the estimate that agrees best with its neighbour."""
    values, spread = table
    spread = np.where(np.isfinite(spread), spread, np.inf)
    place = np.argmin(spread, axis=-1)[..., None]
    error = np.take_along_axis(spread, place, axis=-1)[..., 0]
    return np.where(np.isfinite(error), np.take_along_axis(values, place, axis=-1)[..., 0], np.nan), error
