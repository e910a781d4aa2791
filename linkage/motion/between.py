"""A function looked at anywhere on the way that a motion covers."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, TypeAlias, final

import numpy as np

from ..errors import DefinitionError, cited, told, unwarned
from ..plan import Mask
from ..program import FloatArray
from .grid import JoinedTo, joined_in_order
from .motion import Motion, require_motion
from .peaks import SAMPLES, Index, samples
from .strokes import check_any

# The way that the poses of a motion cover, as legs: straight lines in stroke space.

STRAIGHT = 1e-9  # of the range of each stroke: poses as near as this to a straight line stand on it
LONGEST = 16  # times the samples of one leg: of any way, however often it turns back


@final
@dataclass(frozen=True, eq=False)
class Legs:
    """Legs from corner to corner: the strokes [SI] at the corners (legs + 1,), and in how many intervals each leg is looked at."""

    corners: Mapping[str, FloatArray]
    counts: tuple[int, ...]

    @classmethod
    def of(cls, strokes: Mapping[str, FloatArray]) -> Legs:
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


Function: TypeAlias = Callable[[Motion], Any]
"""A function of a motion: a number for each pose, shape (...), or several, shape (k, ...); NaN where it has none."""


def require_function(motion: Any, f: Any) -> None:
    """Raise DefinitionError for what is no motion, and for what is no function of one."""
    require_motion(motion)
    check_any(motion.strokes, motion.plan)
    if not callable(f) or isinstance(f, type):
        raise DefinitionError(f"{motion.plan.title}: {cited(f)} is no function of a motion; give one, such as lambda each: each.y('G').")


def values_of(f: Function, motion: Motion, *, everywhere: bool = False) -> FloatArray:
    """Return what a function gives at every pose, shape (..., *motion.shape); NaN out of reach, unless it is asked for `everywhere`.

    Nearness to a dead point is not told.
    """
    with unwarned(), np.errstate(all="ignore"), told(f"{motion.plan.title}: a function of a motion"):
        found = np.asarray(f(motion), float)
    axes = len(motion.shape)
    if found.ndim < axes or found.shape[found.ndim - axes :] != motion.shape:
        try:
            found = np.broadcast_to(found, motion.shape)
        except ValueError:
            what = f"a function of a motion gives the shape {found.shape} where {motion.shape} or (k, *{motion.shape}) is expected"
            raise DefinitionError(f"{motion.plan.title}: {what}; return a number for each pose.") from None
    return found if everywhere else np.where(motion.reached, found, np.nan)


@final
class OnLegs:
    """A function of the poses on a motion's way, of K quantities and D designs; `look` is what a search asks.

    The samples are worked out once, at the same strokes for all designs; poses between them take their angles from these.
    """

    def __init__(self, motion: Motion, f: Function, sense: float = 1.0, *, everywhere: bool = False) -> None:
        self.motion, self.f, self.sense, self.everywhere = motion, f, sense, everywhere
        self.route = Legs.of(motion.strokes)
        self.leg, self.t = leg, t = samples(self.route.counts)
        self.first = Motion(
            motion.plan, motion.designs, self.route.strokes(leg, t), "nan", joining=joined_in_order, tangent=self.route.tangent(leg)
        )
        self.seen = sense * values_of(f, self.first, everywhere=everywhere)
        self.front = self.seen.shape[: self.seen.ndim - len(self.first.shape)]
        self._starts = np.cumsum([0, *(count + 1 for count in self.route.counts[:-1])])
        self._reached = nearest_reached(self.first.reached.reshape(-1, leg.size))

    def look(self, leg: Index, t: FloatArray) -> tuple[FloatArray, Mask]:
        """Return the values (K, D, n) at places (n,) of all designs or (D, n) of each its own, and which poses (D, n) are reached.

        Places (n,) are the samples.
        """
        motion, seen = (self.first, self.seen) if t.ndim == 1 else self._own(leg, t)
        D, n = self._reached.shape[0], t.shape[-1]
        return seen.reshape(-1, D, n), motion.reached.reshape(D, n)

    def _own(self, leg: Index, t: FloatArray) -> tuple[Motion, FloatArray]:
        """Return the poses at places (D, n), each design at its own, and the values there."""
        first, tangent = self.first, self.route.tangent(leg)
        places = self._starts[leg] + np.rint(t * np.asarray(self.route.counts)[leg]).astype(int)
        near = np.take_along_axis(self._reached, places, axis=-1)

        def shaped(values: Any) -> Any:
            return values.reshape(*first._design_shape, t.shape[-1])

        strokes = {name: shaped(value) for name, value in self.route.strokes(leg, t).items()}
        motion = Motion(
            first.plan, first.designs, strokes, "nan", per_design=True, joining=JoinedTo(first._grid, shaped(near)),
            tangent=tangent and {name: shaped(value) for name, value in tangent.items()},
        )  # fmt: skip
        return motion, self.sense * values_of(self.f, motion, everywhere=self.everywhere)


def nearest_reached(reached: Mask) -> Index:
    """Return for every sample (D, n) the nearest that is reached; itself where none is."""
    n = reached.shape[-1]
    here = np.broadcast_to(np.arange(n), reached.shape)
    before = np.maximum.accumulate(np.where(reached, here, -1), axis=-1)
    after = np.minimum.accumulate(np.where(reached, here, 2 * n)[..., ::-1], axis=-1)[..., ::-1]
    first, last = np.where(before < 0, after, before), np.where(after >= n, before, after)
    found = np.where(here - first <= last - here, first, last)
    return np.where((found >= 0) & (found < n), found, here)
