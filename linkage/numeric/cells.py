"""Values on a grid of places: what they may be within its cells, and where all of them are known."""

from __future__ import annotations

import numpy as np

from ..vectors import FloatArray, Mask


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
