"""Steps of Levenberg and Marquardt from many starts at once: where the misses of some targets are least, in a box of unit coordinates."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import numpy as np

from ..program import FloatArray
from .line import Index

LEAST = 1e-13
"""The damping of a step, at least: with it a singular system of equations has a solution."""

Look: TypeAlias = Callable[[FloatArray, Index], FloatArray]
"""What is seen at unit coordinates (m, k) of the starts with these numbers (m,): misses (m, targets), or their slopes (m, targets, k)."""


def descended(
    misses: Look, slopes: Look, unit: FloatArray, steps: int, *, enough: float = 0.0, begin: float = 1e-3, settled: float = -1.0
) -> tuple[FloatArray, FloatArray]:
    """Return where the misses are least near each start, unit coordinates (m, k), and the misses there (m, targets).

    A start ends where its steps do, where all its misses are at most `enough`, or where a step changes the sum of their squares by no more
    than the part `settled` of it. `begin` is the damping of the first step.
    Source: Nocedal, Wright, Numerical Optimization, 2nd ed., 10.3; a coordinate that a step would take out of the box is held.
    """
    unit = unit.copy()
    off = misses(unit, np.arange(len(unit)))
    damping, going = np.full(len(unit), begin), np.arange(len(unit)) if unit.shape[1] else np.arange(0)
    for _ in range(steps):
        if not len(going):
            break
        new = damped_steps(unit[going], off[going], slopes(unit[going], going), damping[going])
        found = misses(new, going)
        new_size, size = np.sum(found**2, axis=1), np.sum(off[going] ** 2, axis=1)
        better, still = new_size < size, np.abs(new_size - size) <= settled * size
        moved = np.abs(new - unit[going]).max(axis=1)
        unit[going[better]], off[going[better]] = new[better], found[better]
        damping[going] = np.where(better, np.maximum(damping[going] * 0.1, LEAST), damping[going] * 5.0)
        going = going[~still & (moved > 1e-14) & (damping[going] < 1e12) & (np.abs(off[going]).max(axis=1) > enough)]
    return unit, off


def damped_steps(unit: FloatArray, off: FloatArray, slopes: FloatArray, damping: FloatArray) -> FloatArray:
    """Return where a step of Levenberg and Marquardt leads from unit coordinates (m, k), within the box."""
    m, k = unit.shape
    slopes = np.where(np.isfinite(slopes), slopes, 0.0)
    size = np.sqrt(np.sum(slopes**2, axis=1))
    slopes = slopes / np.where(size > 0.0, size, 1.0)[:, None]  # every coordinate by its own effect
    turned = slopes.transpose(0, 2, 1)
    pull, matrix = (turned @ off[:, :, None])[:, :, 0], turned @ slopes
    free = np.ones((m, k), bool)
    step: FloatArray = np.zeros((m, k))
    for _ in range(k + 1):  # coordinates that would leave the box are held, one round after the other
        both = free[:, :, None] & free[:, None, :]
        system = np.where(both, matrix, 0.0) + np.eye(k) * np.where(free & (size > 0.0), damping[:, None], 1.0)[:, :, None]
        step = np.asarray(-np.linalg.solve(system, np.where(free, pull, 0.0)[:, :, None])[:, :, 0], float)
        leaving = free & (((unit <= 0.0) & (step < 0.0)) | ((unit >= 1.0) & (step > 0.0)))
        if not leaving.any():
            break
        free &= ~leaving
    return np.clip(unit + np.where(free & (size > 0.0), step / np.where(size > 0.0, size, 1.0), 0.0), 0.0, 1.0)
