"""The way that the poses of a motion cover, as legs: straight lines in stroke space."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ..program import FloatArray
from .peaks import SAMPLES, Index

STRAIGHT = 1e-9  # of the range of each stroke: poses as near as this to a straight line stand on it
LONGEST = 16  # times the samples of one leg: of any way, however often it turns back


@dataclass(frozen=True, eq=False)
class Route:
    """Legs from corner to corner: the strokes [SI] at the corners (legs + 1,), and in how many intervals each leg is looked at."""

    corners: Mapping[str, FloatArray]
    counts: tuple[int, ...]

    @classmethod
    def of(cls, strokes: Mapping[str, FloatArray]) -> Route:
        """Return the way that poses cover, whatever their number.

        A single stroke, and a grid in which a single one moves, goes from its least to its greatest value. Several strokes in arrays
        of one axis go from pose to pose, where poses on a straight line are no corners. From one sample to the next no stroke moves
        more than 1/4096 of its range.
        """
        values = np.array([np.ravel(value) for value in strokes.values()])
        if len(values) == 1 or next(iter(strokes.values())).ndim > 1:
            values = np.stack([values.min(axis=1), values.max(axis=1)], axis=1)
        ranges = np.ptp(values, axis=1, keepdims=True)
        scaled = values / np.where(ranges > 0.0, ranges, 1.0)
        places = corners(scaled)
        lengths = np.abs(np.diff(scaled[:, places], axis=1)).max(axis=0)
        share = SAMPLES * min(1.0, LONGEST / max(float(lengths.sum()), 1e-300))
        counts = tuple(int(count) for count in np.maximum(np.ceil(share * lengths - 1e-6), 2.0))
        return cls({name: value[places] for name, value in zip(strokes, values, strict=True)}, counts)

    @property
    def is_path(self) -> bool:
        """Whether it is a path, on which several strokes go on together."""
        return len(self.corners) > 1

    def strokes(self, leg: Index, t: FloatArray) -> dict[str, FloatArray]:
        """Return the strokes [SI] at places, shape as these; exact at the corners."""
        return {name: np.where(t == 1.0, at[leg + 1], at[leg] + (at[leg + 1] - at[leg]) * t) for name, at in self.corners.items()}

    def tangent(self, leg: Index) -> dict[str, FloatArray] | None:
        """Return how the strokes go on in legs, shape as these; None where it is no path."""
        return {name: at[leg + 1] - at[leg] for name, at in self.corners.items()} if self.is_path else None


def corners(values: FloatArray) -> Sequence[int]:
    """Return the poses (n,) at which a way through scaled strokes (k, n) begins, ends, turns or turns back."""
    n = values.shape[1]
    if n == 1:
        return [0, 0]
    moves = np.diff(values, axis=1)
    going = np.flatnonzero(np.abs(moves).max(axis=0) > 0.0)  # poses that are given twice say nothing
    back = going[1:][(moves[:, going[1:]] * moves[:, going[:-1]]).sum(axis=0) <= 0.0]
    ends = [0, *back.tolist(), n - 1]
    found = [0]
    parts = [(first, last) for first, last in pairwise(ends) if last > first][::-1]
    while parts:
        first, last = parts.pop()
        way, steps = values[:, last] - values[:, first], values[:, first : last + 1] - values[:, [first]]
        along = np.clip(way @ steps / max(float(way @ way), 1e-300), 0.0, 1.0)
        off = np.abs(steps - way[:, None] * along).max(axis=0)
        place = first + int(np.argmax(off))
        if off.max() <= STRAIGHT or not first < place < last:
            found.append(last)
        else:
            parts += [(place, last), (first, place)]
    return found
