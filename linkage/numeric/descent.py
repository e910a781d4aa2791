"""Steps of Levenberg and Marquardt from many starts at once: where the misses of some targets are least, in a box of unit coordinates."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple, TypeAlias

import numpy as np

from ..vectors import FloatArray, Mask
from .line import Index

BEGIN = 1e-3
"""The damping of a first step."""
LEAST = 1e-14
"""The damping of a step, at least: with it a singular system of equations has a solution."""
EASED, GROWTH = 0.5, 2.0
"""What the damping is multiplied with after a step that is taken, and after one that is refused, twice as much after each more in a row."""
PROBE = 0.1
"""The part of a step at which is looked how the misses bend."""
MOST_BENT = 0.75
"""A bend counts where twice its length is at most this part of the step's."""

MOST_POSES = 1 << 19
"""Places of a grid at the most that is looked at first."""
NEAR = 1e-2
"""Of a side of the box: solutions that are so near are one where what lies between them is a solution too, as at a double root."""

Look: TypeAlias = Callable[[FloatArray, Index], FloatArray]
"""What is seen at unit coordinates (m, k) of the starts with these numbers (m,): misses (m, targets), or their slopes (m, targets, k)."""


def descended(
    misses: Look,
    slopes: Look,
    unit: FloatArray,
    steps: int,
    *,
    enough: float = 0.0,
    begin: float = BEGIN,
    settled: float = -1.0,
    ahead: Look | None = None,
) -> tuple[FloatArray, FloatArray]:
    """Return where the misses are least near each start, unit coordinates (m, k), and the misses there (m, targets).

    A start ends where its steps do, where all its misses are at most `enough`, or where a step changes the sum of their squares by no more
    than the part `settled` of it. `begin` is the damping of the first step. With `ahead`, the misses at a part of a step, steps bend as
    the misses do, so that narrow valleys are followed by long ones.
    Sources: Nocedal, Wright, Numerical Optimization, 2nd ed., 10.3; a coordinate that a step would take out of the box is held.
    H. B. Nielsen, Damping parameter in Marquardt's method (1999): the damping grows faster with every step in a row that is refused.
    M. K. Transtrum, J. P. Sethna, Improvements to the Levenberg-Marquardt algorithm (2012): the bend, or geodesic acceleration.
    """
    unit = unit.copy()
    off = misses(unit, np.arange(len(unit)))
    damping, growth = np.full(len(unit), begin), np.full(len(unit), GROWTH)
    going = np.arange(len(unit)) if unit.shape[1] else np.arange(0)
    for _ in range(steps):
        if not len(going):
            break
        now, missed = unit[going], off[going]
        system = DampedSystem.from_slopes(now, missed, slopes(now, going), damping[going])
        bend = 0.0 if ahead is None else system.bend(missed, ahead(now + PROBE * system.step, going))
        new = np.clip(now + system.step + bend, 0.0, 1.0)
        found = misses(new, going)
        new_size, size = np.sum(found**2, axis=1), np.sum(missed**2, axis=1)
        better, still = new_size < size, np.abs(new_size - size) <= settled * size
        moved = np.abs(new - now).max(axis=1)
        unit[going[better]], off[going[better]] = new[better], found[better]
        damping[going] = np.where(better, np.maximum(damping[going] * EASED, LEAST), damping[going] * growth[going])
        growth[going] = np.where(better, GROWTH, growth[going] * GROWTH)
        going = going[~still & (better | (moved > 1e-14)) & (damping[going] < 1e12) & (np.abs(off[going]).max(axis=1) > enough)]
    return unit, off


class DampedSystem(NamedTuple):
    """The linear equations of a step of Levenberg and Marquardt from unit coordinates (m, k), and their solution, the `step` (m, k).

    `slopes` (m, targets, k) are those of the misses. In the `matrix` each coordinate counts in parts of its own effect `size` (m, k);
    `free` (m, k) are the coordinates that move.
    """

    slopes: FloatArray
    size: FloatArray
    free: Mask
    matrix: FloatArray
    step: FloatArray

    @classmethod
    def from_slopes(cls, unit: FloatArray, off: FloatArray, slopes: FloatArray, damping: FloatArray) -> DampedSystem:
        """Return the equations at misses (m, targets); a coordinate that the step would take out of the box is held."""
        finite = np.isfinite(slopes)
        if not finite.all():
            slopes = np.where(finite, slopes, 0.0)
        turned = slopes.transpose(0, 2, 1)
        squares = turned @ slopes
        length = np.sqrt(np.diagonal(squares, axis1=1, axis2=2))
        free = length > 0.0
        size = np.where(free, length, 1.0)
        squares /= size[:, :, None] * size[:, None, :]
        pull = (turned @ off[:, :, None])[:, :, 0] / size
        diagonal = np.arange(unit.shape[1])
        while True:  # coordinates that would leave the box are held, one round after the other
            matrix, right = squares.copy(), -pull
            if not free.all():
                matrix[~(free[:, :, None] & free[:, None, :])] = 0.0
                right[~free] = 0.0
            matrix[:, diagonal, diagonal] += np.where(free, damping[:, None], 1.0)
            step = damped_solution(matrix, right) / size
            leaving = free & (((unit <= 0.0) & (step < 0.0)) | ((unit >= 1.0) & (step > 0.0)))
            if not leaving.any():
                return cls(slopes, size, free, matrix, step)
            free &= ~leaving

    def bend(self, off: FloatArray, ahead: FloatArray) -> FloatArray:
        """Return the addition of the misses' curvature to the step (m, k), from the misses at a part of it; zero where that is large."""
        along = (self.slopes @ self.step[:, :, None])[:, :, 0]
        curved = (2.0 / PROBE) * ((ahead - off) / PROBE - along)
        curved[~np.isfinite(curved).all(axis=1)] = 0.0
        pull = (self.slopes.transpose(0, 2, 1) @ curved[:, :, None])[:, :, 0] / self.size
        bend = 0.5 * damped_solution(self.matrix, np.where(self.free, -pull, 0.0)) / self.size
        far, straight = (np.linalg.norm(each * self.size, axis=1) for each in (bend, self.step))
        return np.where(np.asarray(4.0 * far <= MOST_BENT * straight)[:, None], bend, 0.0)


def damped_solution(matrix: FloatArray, right: FloatArray) -> FloatArray:
    """Return the solutions (m, k) of linear equations, matrices (m, k, k) that are damped."""
    return np.asarray(np.linalg.solve(matrix, right[:, :, None])[:, :, 0], float)


def refined(state: FloatArray, step: Callable[[FloatArray], FloatArray]) -> FloatArray | None:
    """Return a state made exact by Newton's method, of which `step` is the next change; None where it has none."""
    for _ in range(12):
        try:
            change = step(state)
        except np.linalg.LinAlgError:
            return None
        state = state + change
        if abs(change).max() < 1e-15 * max(abs(state).max(), 1.0):
            break
    return state


# What searches for all solutions in a box share: the grid that is looked at first, and which solutions are one.


def grid_axes(out: FloatArray, counts: FloatArray) -> list[FloatArray]:
    """Return values of each coordinate from -out to 1 + out (k,), about so many (k,), fewer where the grid would have too many places."""
    shrink = max(1.0, float((np.prod(counts) / MOST_POSES) ** (1.0 / len(counts))))
    return [np.linspace(-each, 1.0 + each, max(int(count / shrink), 4)) for each, count in zip(out, counts, strict=True)]


def without_repeats(order: Index, is_same: Callable[[int, int], bool], most: int) -> list[int]:
    """Return the solutions of an order (n,) by their numbers, without those that are the same as one before; so many at the most."""
    kept: list[int] = []
    for each in order.tolist():
        if len(kept) < most and not any(is_same(known, each) for known in kept):
            kept.append(each)
    return kept


def is_one_solution(apart: FloatArray, same: float, is_between: Callable[[], bool]) -> bool:
    """Return whether two solutions so far apart (k,) are one: to rounding, or near a double one with solutions between them."""
    far = float(np.abs(apart).max(initial=0.0))
    return far <= same or (far <= NEAR and is_between())


# Values on a grid of places: what they may be within its cells, and where all of them are known.


def extremes_of_cells(values: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return the least and the greatest of the corners of every cell of a grid, (t, *counts), and how far values may bend beyond them."""
    low = high = values
    bend = np.zeros(values.shape)
    for axis in range(1, values.ndim):
        curve = np.zeros(values.shape)
        curve[along(axis, values.ndim, slice(1, -1))] = np.abs(np.diff(values, 2, axis=axis))
        for end, inner in ((slice(0, 1), slice(1, 2)), (slice(-1, None), slice(-2, -1))):
            curve[along(axis, values.ndim, end)] = curve[along(axis, values.ndim, inner)]
        bend += 0.25 * np.where(np.isfinite(curve), curve, 0.0)
    for axis in range(1, values.ndim):
        before, behind = (along(axis, values.ndim, part) for part in (slice(None, -1), slice(1, None)))
        low, high = np.fmin(low[before], low[behind]), np.fmax(high[before], high[behind])
        bend = np.maximum(bend[before], bend[behind])
    return low, high, bend


def along(axis: int, axes: int, part: slice) -> tuple[slice, ...]:
    """Return the index of a part of an array along one of its axes."""
    return tuple(part if each == axis else slice(None) for each in range(axes))


def all_known(values: FloatArray) -> Mask:
    """Return in which rows of an array all values are finite, shape (n,) of (n, ...)."""
    return np.asarray(np.isfinite(values).all(axis=tuple(range(1, values.ndim))))


def corners_all(mask: Mask) -> Mask:
    """Return of which cells of a grid all corners are in a mask."""
    for axis in range(mask.ndim):
        mask = np.asarray(mask[along(axis, mask.ndim, slice(None, -1))] & mask[along(axis, mask.ndim, slice(1, None))])
    return mask
