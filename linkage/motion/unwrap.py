"""Angles made continuous along the stroke."""

from __future__ import annotations

import numpy as np

from ..program import FloatArray


def unwrapped(angle: FloatArray, strokes: list[FloatArray]) -> FloatArray:
    """Return an angle [rad] without jumps of 2 pi along its last axes, one an independent stroke array axis.

    Poses are joined in the order of the stroke, whatever the order they stand in; NaN is passed over.
    """
    axes = strokes[0].ndim if strokes else 0
    result = np.array(angle, float)
    for axis in range(axes):
        result = _along(result, axis - axes, strokes)
    return result


def _along(angle: FloatArray, axis: int, strokes: list[FloatArray]) -> FloatArray:
    moved = np.moveaxis(angle, axis, -1)
    if moved.shape[-1] < 2:
        return angle
    order = slice(None)
    if len(strokes) == 1 and strokes[0].ndim == 1:
        sort = np.argsort(strokes[0], kind="stable")
        moved = moved[..., sort]
        order = np.argsort(sort, kind="stable")  # type: ignore[assignment]
    return np.moveaxis(_joined(moved)[..., order], -1, axis)


def _joined(angle: FloatArray) -> FloatArray:
    """Return the angle continued from each finite value to the next."""
    finite = np.isfinite(angle)
    places = np.where(finite, np.arange(angle.shape[-1]), 0)
    filled = np.take_along_axis(angle, np.maximum.accumulate(places, axis=-1), axis=-1)
    filled = np.where(np.isfinite(filled), filled, np.take_along_axis(angle, np.argmax(finite, axis=-1)[..., None], axis=-1))
    steps = np.diff(filled, axis=-1)
    turns = np.cumsum(np.round(np.where(np.isfinite(steps), steps, 0.0) / (2 * np.pi)), axis=-1)
    result = np.array(angle)
    result[..., 1:] -= 2 * np.pi * turns
    return result
