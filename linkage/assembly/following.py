"""Angles followed from the sketch to the poses asked for, along straight lines in stroke space.

The arc tangent tells a direction but for whole turns. These are counted from the sketch, where it is read between -180 and 180 deg:
each way is cut into pieces so short that the vector changes by less than half of itself and goes where its derivatives say. The
places on a way do not depend on the poses asked for, so that a pose is the same whatever else is asked.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import pi
from typing import Any, Self

import numpy as np
import numpy.typing as npt

from ..plan import Plan
from ..program import FloatArray, Kernel
from .groups import Solved, solve_groups
from .newton import Mask

Index = npt.NDArray[np.intp]
PIECES = 128
"""The pieces of a stroke's range, or of a turn where its range is more, that a way consists of before any is halved."""
LEAST = 2.0**-30
"""A piece is not halved below this part of one; what is not settled there is where the vector vanishes, or the end of the reach."""
SHORT = 2.0**-12
"""From pieces so short on, derivatives are not asked: they grow without bound towards a dead point."""
STRAIGHT = 1e-9
"""At the sketch, what is so near to -180 deg [rad] is 180 deg: rounding must not choose."""
MANY = 1 << 17
"""Places that are worked out at a time."""
NONE_SOLVED = Solved({}, np.zeros((1, 1), bool))
"""What is solved where there are no groups."""


def with_angles(found: Solved, plan: Plan, designs: Mapping[str, Any], strokes: Mapping[str, FloatArray]) -> Solved:
    """Return what is solved with the references of followed angles [rad], shape (designs, poses); NaN where one cannot be followed.

    Designs are floats or (m,), strokes (n,) or (m, n).
    """
    if not plan.followed:
        return found
    single = {name: float(np.ravel(value)[0]) if np.size(value) == 1 else np.asarray(value, float) for name, value in designs.items()}
    m = max((np.size(value) for value in single.values()), default=1)
    m = max([m, *(len(value) for value in strokes.values() if np.ndim(value) == 2)])
    n = max((np.shape(value)[-1] for value in strokes.values()), default=1)
    ways = Ways.of(plan, {name: np.broadcast_to(value, (m, n)) for name, value in strokes.items()})
    references: dict[str, FloatArray] = {name: np.full((m, n), np.nan) for name in plan.followed}
    for part in ways.parts():
        here = np.isin(part.target, part.lines)
        for name, track in part.tracks(plan, single).items():
            references[name][here] = np.rint(track.at(part.target[here], part.place[here]))
    return replace(found, inputs={**found.inputs, **references})


@dataclass(frozen=True)
class Ways:
    """Lines in stroke space that begin at the sketch, each with its design, its stroke per unit of place, and its whole length.

    `target` and `place`, shape (m, n), tell on which line a pose stands, and where.
    """

    sketch: Mapping[str, float]
    design: Index
    along: Mapping[str, FloatArray]
    length: Index
    target: Index
    place: FloatArray
    lines: Index

    @classmethod
    def of(cls, plan: Plan, strokes: Mapping[str, FloatArray]) -> Self:
        """Return the ways to some strokes (m, n); along a single stroke one each way for all poses of a design, else one a pose."""
        sketch = plan.sketch_strokes
        units = {name: min(abs(stroke.end - stroke.start), 2.0 * pi) / PIECES for name, stroke in plan.strokes.items()}
        m, n = next(iter(strokes.values())).shape
        rows = np.broadcast_to(np.arange(m)[:, None], (m, n))
        if len(strokes) == 1:
            ((name, values),) = strokes.items()
            place = np.abs(values - sketch[name]) / units[name]
            target = 2 * rows + (values < sketch[name])
            length = np.ones(2 * m, np.intp)
            np.maximum.at(length, target.ravel(), np.ceil(place).astype(np.intp).ravel())
            along = {name: np.tile([units[name], -units[name]], m)}
            return cls(sketch, np.repeat(np.arange(m), 2), along, length, target, place, np.arange(2 * m))
        apart = {name: (value - sketch[name]).ravel() for name, value in strokes.items()}
        length = np.maximum(1, np.max([np.ceil(np.abs(each) / units[name]) for name, each in apart.items()], axis=0)).astype(np.intp)
        along = {name: each / length for name, each in apart.items()}
        lines = np.arange(m * n)
        return cls(sketch, rows.ravel(), along, length, lines.reshape(m, n), length.reshape(m, n).astype(float), lines)

    def parts(self) -> list[Ways]:
        """Return these ways some at a time; those with no pose are left out."""
        used = self.lines[np.isin(self.lines, self.target)]
        ends = np.cumsum(self.length[used] + 1) // MANY
        return [replace(self, lines=used[ends == each]) for each in np.unique(ends)]

    def tracks(self, plan: Plan, designs: Mapping[str, Any]) -> dict[str, Track]:
        """Return every followed angle along these ways."""
        found: dict[str, Track] = {}
        for name in plan.followed:
            found[name] = self._track(Vectors(plan, designs, self, name, dict(found)))
        return found

    def _track(self, vectors: Vectors) -> Track:
        counts = self.length[self.lines] + 1
        line = np.repeat(self.lines, counts)
        place = np.arange(len(line)) - np.repeat(np.cumsum(counts) - counts, counts).astype(float)
        points = Points(line, place, *vectors.at(line, place))
        inner = np.flatnonzero(line[1:] == line[:-1])
        left, right = points.taken(inner), points.taken(inner + 1)
        done: list[tuple[Points, Points, Mask]] = []
        while len(left.line):
            good, tiny = fits(left, right), right.place - left.place <= LEAST
            hopeless = ~np.isfinite(left.value).all(axis=0)  # what lies behind the end of the reach is lost in any case
            settled = good | tiny | hopeless
            done.append((left.taken(settled), right.taken(settled), good[settled]))
            left, right = left.taken(~settled), right.taken(~settled)
            place = 0.5 * (left.place + right.place)
            middle = Points(left.line, place, *vectors.at(left.line, place)) if len(place) else left
            left, right = left.joined(middle), middle.joined(right)
        return Track.of(done, points.taken(points.place == 0.0))


@dataclass(frozen=True)
class Points:
    """Places on ways with a vector there, shape (2, k), and its derivative by the place."""

    line: Index
    place: FloatArray
    value: FloatArray
    rate: FloatArray

    def taken(self, which: Any) -> Points:
        """Return some of them."""
        return Points(self.line[which], self.place[which], self.value[:, which], self.rate[:, which])

    def joined(self, other: Points) -> Points:
        """Return these and others after them."""
        pairs = ((self.value, other.value), (self.rate, other.rate))
        value, rate = (np.concatenate(pair, axis=1) for pair in pairs)
        return Points(np.concatenate([self.line, other.line]), np.concatenate([self.place, other.place]), value, rate)


def fits(left: Points, right: Points) -> Mask:
    """Return between which places a vector goes no other way than it seems: by less than half of itself, and as its derivatives say."""
    with np.errstate(all="ignore"):
        change, width = right.value - left.value, right.place - left.place
        size = np.minimum(np.hypot(*left.value), np.hypot(*right.value))
        off = np.maximum(np.hypot(*(width * left.rate - change)), np.hypot(*(width * right.rate - change)))
        return np.asarray((np.hypot(*change) <= 0.5 * size) & (size > 0.0) & ((off <= 0.25 * size) | (width <= SHORT)))


@dataclass(frozen=True)
class Track:
    """An angle along ways: pieces in order, with the angle at their start [rad], NaN behind where it is lost, and its change over each."""

    starts: FloatArray
    begins: FloatArray
    width: FloatArray
    angle: FloatArray
    change: FloatArray
    lines: Index
    offsets: FloatArray

    @classmethod
    def of(cls, done: Sequence[tuple[Points, Points, Mask]], sketch: Points) -> Track:
        """Return the track of settled pieces, from the directions at the sketch."""
        left, right, good = done[0]
        for more_left, more_right, more_good in done[1:]:
            left, right, good = left.joined(more_left), right.joined(more_right), np.concatenate([good, more_good])
        (order,) = (np.lexsort((left.place, left.line)),)
        left, right, good = left.taken(order), right.taken(order), good[order]
        with np.errstate(all="ignore"):
            (ax, ay), (bx, by) = left.value, right.value
            turn = np.arctan2(ax * by - ay * bx, ax * bx + ay * by)
            first = np.arctan2(sketch.value[1], sketch.value[0])
        first = np.where(first < STRAIGHT - pi, first + 2.0 * pi, first)
        begin = np.flatnonzero(left.place == 0.0)
        piece = np.cumsum(left.place == 0.0) - 1
        gone = np.cumsum(np.where(good, turn, 0.0))
        missed = np.cumsum(~good)
        angle = first[piece] + (gone - np.where(good, turn, 0.0)) - (gone - np.where(good, turn, 0.0))[begin][piece]
        lost = (missed - ~good) - (missed - ~good)[begin][piece] > 0
        angle = np.where(lost, np.nan, angle)
        # next to the end of the reach the angle is that before it; where the vector vanishes there is none
        edge = ~good & ~np.isfinite(right.value).all(axis=0)
        change = np.where(good, turn, np.where(edge, 0.0, np.nan))
        lengths = np.array([right.place[last] for last in [*(begin[1:] - 1), len(piece) - 1]])
        offsets = np.cumsum(lengths + 2.0) - (lengths + 2.0)
        starts = offsets[piece] + left.place
        return cls(starts, left.place, right.place - left.place, angle, change, left.line[begin], offsets)

    def at(self, line: Index, place: FloatArray) -> FloatArray:
        """Return the angle at places of ways [rad]; NaN where it is lost."""
        offset = self.offsets[np.searchsorted(self.lines, line)]
        index = np.searchsorted(self.starts, offset + place, side="right") - 1
        share = (place - self.begins[index]) / self.width[index]
        return np.asarray(self.angle[index] + np.where(share > 0.0, share * self.change[index], 0.0))


@dataclass(frozen=True)
class Vectors:
    """The vector whose direction is followed, anywhere on ways; `known` are the angles that it may hang on."""

    plan: Plan
    designs: Mapping[str, Any]
    ways: Ways
    name: str
    known: Mapping[str, Track]

    def at(self, line: Index, place: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the vector and its derivative by the place, shape (2, k); NaN out of reach."""
        inputs, rows = self._inputs(line, place)
        kernel: Kernel = self.plan.made(("followed", self.name), self._kernel)
        found = kernel(inputs, size=(len(line), 1) if rows else (1, len(line))).values.reshape(-1, len(line))
        rate = sum((found[2 * k + 2 : 2 * k + 4] * slope[line] for k, slope in enumerate(self.ways.along.values())), np.zeros((2, 1)))
        return self._placed(found[:2], inputs), rate

    def _kernel(self, plan: Plan) -> Kernel:
        """Return the kernel of the vector, then of its derivatives by the strokes."""
        vector = plan.trace.directions[self.name]
        nodes = (plan.trace.graph.node(vector.x), plan.trace.graph.node(vector.y))
        return Kernel([*nodes, *(each for stroke in plan.strokes for each in plan.derived(nodes, (stroke,)))])

    def _inputs(self, line: Index, place: FloatArray) -> tuple[dict[str, Any], bool]:
        """Return the inputs at places, and whether designs differ: then these are (k,) and strokes (k, 1)."""
        design = self.ways.design[line]
        rows = any(np.ndim(value) for value in self.designs.values())
        inputs = {name: value[design] if np.ndim(value) else value for name, value in self.designs.items()}
        moved = {name: self.ways.sketch[name] + slope[line] * place for name, slope in self.ways.along.items()}
        moved |= {name: np.rint(track.at(line, place)) for name, track in self.known.items()}
        if self.plan.groups:
            moved |= self._groups(design, {name: moved[name] for name in self.plan.strokes})
        return inputs | {name: value[:, None] if rows else value for name, value in moved.items()}, rows

    def _groups(self, design: Index, strokes: Mapping[str, FloatArray]) -> dict[str, FloatArray]:
        """Return the pins of groups at strokes (k,), each of its design."""
        found = {name: np.full(len(design), np.nan) for name in self.plan.grouped}
        for each in np.unique(design):
            here = design == each
            own = {name: float(value[each]) if np.ndim(value) else value for name, value in self.designs.items()}
            solved = solve_groups(self.plan, own, {name: value[here] for name, value in strokes.items()})
            for name in found:
                found[name][here] = np.broadcast_to(solved.inputs[name], (1, int(here.sum())))[0]
        return found

    def _placed(self, value: FloatArray, inputs: Mapping[str, Any]) -> FloatArray:
        """Return the vector with the places filled in that stand at a dead point, to rounding."""
        missing = ~np.isfinite(value).all(axis=0)
        if not missing.any():
            return value
        size = missing.size
        there = {name: np.ravel(each)[missing] if np.size(each) == size and np.ndim(each) else each for name, each in inputs.items()}
        there |= {name: np.full(int(missing.sum()), np.nan) for name in self.plan.followed if name not in there}
        with np.errstate(all="ignore"):
            vector = self.plan.read(there).directions[self.name]
        filled = np.array(value)
        filled[:, missing] = np.broadcast_to(np.array(np.broadcast_arrays(vector.x, vector.y)), (2, int(missing.sum())))
        return filled
