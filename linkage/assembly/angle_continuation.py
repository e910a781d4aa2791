"""Angles followed from the sketch to the poses asked for, along straight lines in stroke space.

The arc tangent tells a direction but for whole turns. These are counted from the sketch, where it is read between -180 and 180 deg:
each way is cut into pieces so short that the vector changes by less than half of itself and goes where its derivatives say. The
places on a way do not depend on the poses asked for, so that a pose is the same whatever else is asked.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import pi
from types import MappingProxyType
from typing import NamedTuple, Self
from weakref import WeakKeyDictionary

import numpy as np

from ..frozen import record
from ..plan import Plan
from ..program import FloatArray, Kernel, Node
from ..vectors import Index, Mask, Numbers
from .groups import GroupSolution, singled, solve_groups

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
APART = 3.0
"""References [rad] that differ by more are looked at: the angles may differ by a turn."""
NOWHERE: Mapping[str, FloatArray] = MappingProxyType({})
KEPT: WeakKeyDictionary[Plan, tuple[tuple[float, ...], Index, Mapping[str, AnglePath]]] = WeakKeyDictionary()
"""The last single design of a plan, how far its angles are followed each way, and these."""
NONE_SOLVED = GroupSolution({}, np.zeros((1, 1), bool))
"""What is solved where there are no groups."""


def with_angles(found: GroupSolution, plan: Plan, designs: Mapping[str, Numbers], strokes: Mapping[str, FloatArray]) -> GroupSolution:
    """Return a solution with the references of followed angles [rad], shape (designs, poses); NaN where one cannot be followed.

    Designs are floats or (m,), strokes (n,) or (m, n).
    """
    if not plan.followed:
        return found
    single = singled(designs)
    m = max((np.size(value) for value in single.values()), default=1)
    m = max([m, *(len(value) for value in strokes.values() if np.ndim(value) == 2)])
    n = max((np.shape(value)[-1] for value in strokes.values()), default=1)
    ways = StrokeLines.for_strokes(plan, {name: np.broadcast_to(value, (m, n)) for name, value in strokes.items()})
    if m == 1 and len(strokes) == 1:  # along both ways of the one stroke; those of the last design are kept
        key, known = tuple(map(float, single.values())), KEPT.get(plan)
        if known is None or known[0] != key or not np.all(known[1] >= ways.length):
            ((name, stroke),) = plan.strokes.items()
            ends = np.array([stroke.start, stroke.end]) - plan.sketch_strokes[name]
            declared = np.ceil(np.array([ends.max(), -ends.min()]) / piece_length(plan, name)).astype(np.intp)
            whole = ways._replace(length=np.maximum(ways.length, declared))
            known = KEPT[plan] = key, whole.length, whole.tracks(plan, single)
        turns = {name: np.rint(each.angle_at(ways.target, ways.place)) for name, each in known[2].items()}
        return found._replace(inputs={**found.inputs, **turns})
    references: dict[str, FloatArray] = {name: np.full((m, n), np.nan) for name in plan.followed}
    for part in ways.parts():
        here = np.isin(part.target, part.lines)
        for name, track in part.tracks(plan, single).items():
            references[name][here] = np.rint(track.angle_at(part.target[here], part.place[here]))
    return found._replace(inputs={**found.inputs, **references})


def ambiguous_angle(
    plan: Plan, designs: Mapping[str, Numbers], strokes: Mapping[str, FloatArray], references: Mapping[str, FloatArray]
) -> str:
    """Return an angle that does not change from each pose (m, *shape) to the next as it does on the straight line between them; "" if none.

    With several strokes the ways from the sketch to two poses may pass a pose where the ends of the angle meet on either side.
    """
    shape = next(iter(references.values())).shape
    cells = np.arange(np.prod(shape)).reshape(shape)
    axes = range(1, len(shape))
    one, other = (np.concatenate([cells[:0].ravel(), *(np.delete(cells, end, axis).ravel() for axis in axes)]) for end in (-1, 0))
    for name, values in references.items():
        flat = np.ravel(values)
        far = np.abs(flat[one] - flat[other]) > APART
        if not far.any():
            continue
        a, b = one[far], other[far]
        full = {each: np.broadcast_to(value, shape).ravel() for each, value in strokes.items()}
        first, last = ({each: value[ends] for each, value in full.items()} for ends in (a, b))
        ways = StrokeLines.between(plan, a // (len(flat) // shape[0]), first, last, a.shape)
        begin = {each: np.ravel(found)[a] for each, found in references.items()}
        for part in ways.parts():
            ends = part.tracks(plan, singled(designs), begin)[name].angle_at(part.lines, ways.place[part.lines])
            if not np.all(np.abs(ends - flat[b][part.lines]) < APART):
                return name
    return ""


def piece_length(plan: Plan, name: str) -> float:
    """Return the length of a piece of a stroke."""
    stroke = plan.strokes[name]
    return min(abs(stroke.end - stroke.start), 2.0 * pi) / PIECES


class StrokeLines(NamedTuple):
    """Lines in stroke space, each with its design, its first strokes, the strokes per unit of place, and its whole length.

    `target` and `place`, shape (m, n), tell on which line a pose stands, and where.
    """

    first: Mapping[str, FloatArray]
    design: Index
    along: Mapping[str, FloatArray]
    length: Index
    target: Index
    place: FloatArray
    lines: Index

    @classmethod
    def for_strokes(cls, plan: Plan, strokes: Mapping[str, FloatArray]) -> Self:
        """Return the ways from the sketch to strokes (m, n): one a pose; of a single stroke one each way for all poses of a design."""
        sketch = plan.sketch_strokes
        m, n = next(iter(strokes.values())).shape
        rows = np.broadcast_to(np.arange(m)[:, None], (m, n))
        if len(strokes) > 1:
            first = {name: np.full(m * n, sketch[name]) for name in strokes}
            return cls.between(plan, rows.ravel(), first, {name: value.ravel() for name, value in strokes.items()}, (m, n))
        ((name, values),) = strokes.items()
        unit = piece_length(plan, name)
        place, target = np.abs(values - sketch[name]) / unit, 2 * rows + (values < sketch[name])
        length = np.ones(2 * m, np.intp)
        np.maximum.at(length, target.ravel(), np.ceil(place).astype(np.intp).ravel())
        along = {name: np.tile([unit, -unit], m)}
        return cls({name: np.full(2 * m, sketch[name])}, np.repeat(np.arange(m), 2), along, length, target, place, np.arange(2 * m))

    @classmethod
    def between(
        cls, plan: Plan, design: Index, first: Mapping[str, FloatArray], last: Mapping[str, FloatArray], shape: tuple[int, ...]
    ) -> Self:
        """Return the ways of designs (k,) from some strokes to others, (k,) each."""
        apart = {name: last[name] - first[name] for name in first}
        pieces = [np.ceil(np.abs(each) / piece_length(plan, name)) for name, each in apart.items()]
        length = np.maximum(1, np.max(pieces, axis=0)).astype(np.intp)
        lines = np.arange(len(length))
        along = {name: each / length for name, each in apart.items()}
        return cls(first, design, along, length, lines.reshape(shape), length.reshape(shape).astype(float), lines)

    def parts(self) -> list[StrokeLines]:
        """Return these ways some at a time; those with no pose are left out."""
        used = self.lines[np.isin(self.lines, self.target)]
        ends = np.cumsum(self.length[used] + 1) // MANY
        return [self._replace(lines=used[ends == each]) for each in np.unique(ends)]

    def tracks(self, plan: Plan, designs: Mapping[str, Numbers], begin: Mapping[str, FloatArray] = NOWHERE) -> dict[str, AnglePath]:
        """Return every followed angle along these ways, which begin at the sketch, or where the angles are about `begin` [rad]."""
        found: dict[str, AnglePath] = {}
        for name in plan.followed:
            found[name] = self._track(Vectors(plan, designs, self, name, dict(found)), begin.get(name))
        return found

    def _track(self, vectors: Vectors, begin: FloatArray | None) -> AnglePath:
        counts = self.length[self.lines] + 1
        firsts = np.cumsum(counts) - counts
        line = np.repeat(self.lines, counts)
        place = np.arange(len(line)) - np.repeat(firsts, counts).astype(float)
        points = Points(line, place, *vectors.at(line, place))
        left, right, among = points.subset(slice(-1)), points.subset(slice(1, None)), line[1:] == line[:-1]
        done: list[Pieces] = []
        while among.any():
            pieces = Pieces.between(left, right)
            settled = pieces.good | (pieces.width <= LEAST)
            settled |= ~np.isfinite(left.value[0] + left.value[1])  # what lies behind the end of the reach is lost in any case
            done.append(pieces.subset(settled & among))
            rest = np.flatnonzero(~settled & among)
            left, right = left.subset(rest), right.subset(rest)
            place = 0.5 * (left.place + right.place)
            middle = Points(left.line, place, *vectors.at(left.line, place)) if len(place) else left
            left, right = left.merged_with(middle), middle.merged_with(right)
            among = np.ones(len(left.line), bool)
        return AnglePath.from_pieces(done, self.lines, counts, points.value[:, firsts], begin)


class Points(NamedTuple):
    """Places on ways with a vector there, shape (2, k), and its derivative by the place."""

    line: Index
    place: FloatArray
    value: FloatArray
    rate: FloatArray

    def subset(self, which: Index | slice) -> Points:
        """Return some of them."""
        return Points._make(each[..., which] for each in self)

    def merged_with(self, other: Points) -> Points:
        """Return these and others after them."""
        return Points._make(np.concatenate(pair, axis=-1) for pair in zip(self, other, strict=True))


class Pieces(NamedTuple):
    """Pieces of ways: the turn of the vector over each [rad], whether it is sure, and whether the end of the reach lies in it."""

    line: Index
    place: FloatArray
    width: FloatArray
    turn: FloatArray
    good: Mask
    edge: Mask

    @classmethod
    def between(cls, left: Points, right: Points) -> Self:
        """Return the pieces between places; sure are those in which the vector changes by less than half, and as its derivatives say."""
        (ax, ay), (bx, by), width = left.value, right.value, right.place - left.place
        with np.errstate(all="ignore"):
            cx, cy, dot = bx - ax, by - ay, ax * bx + ay * by
            size = np.minimum(ax * ax + ay * ay, bx * bx + by * by)  # squares of lengths, as are what changes and what is off
            off = [(width * each.rate[0] - cx) ** 2 + (width * each.rate[1] - cy) ** 2 for each in (left, right)]
            good = (cx * cx + cy * cy <= 0.25 * size) & (size > 0.0) & ((np.maximum(*off) <= 0.0625 * size) | (width <= SHORT))
            turn = np.arctan2(ax * by - ay * bx, dot)
        return cls(left.line, left.place, width, np.where(good, turn, 0.0), good, ~good & ~np.isfinite(bx + by))

    def subset(self, which: Mask) -> Pieces:
        """Return some of them."""
        return Pieces._make(each[which] for each in self)


class AnglePath(NamedTuple):
    """An angle along ways: pieces in order, with the angle at their start [rad], NaN behind where it is lost, and its change over each."""

    starts: FloatArray
    begins: FloatArray
    width: FloatArray
    angle: FloatArray
    change: FloatArray
    lines: Index
    offsets: FloatArray

    @classmethod
    def from_pieces(
        cls, done: Sequence[Pieces], lines: Index, counts: Index, start: FloatArray, near: FloatArray | None
    ) -> AnglePath:
        """Return the track of settled pieces; the directions at its start lie near some angles, or between -180 and 180 deg."""
        offsets = np.cumsum(counts + 1.0) - (counts + 1.0)
        pieces = Pieces._make(map(np.concatenate, zip(*done, strict=True)))
        own = np.searchsorted(lines, pieces.line)
        starts = offsets[own] + pieces.place
        if len(done) > 1:
            order = np.argsort(starts, kind="stable")
            pieces, own, starts = Pieces._make(each[order] for each in pieces), own[order], starts[order]
        with np.errstate(all="ignore"):
            first = np.arctan2(start[1], start[0])
        if near is None:
            first = np.where(first < STRAIGHT - pi, first + 2.0 * pi, first)
        else:
            first = first + 2.0 * pi * np.rint((near[lines] - first) / (2.0 * pi))
        begin = np.flatnonzero(pieces.place == 0.0)
        gone = np.cumsum(pieces.turn) - pieces.turn
        missed: Index = np.cumsum(~pieces.good) - ~pieces.good
        angle = np.where(missed > missed[begin][own], np.nan, (first - gone[begin])[own] + gone)
        # next to the end of the reach the angle is that before it; where the vector vanishes there is none
        change = np.where(pieces.good | pieces.edge, pieces.turn, np.nan)
        return cls(starts, pieces.place, pieces.width, angle, change, lines, offsets)

    def angle_at(self, line: Index, place: FloatArray) -> FloatArray:
        """Return the angle at places of ways [rad]; NaN where it is lost."""
        offset = self.offsets[np.searchsorted(self.lines, line)]
        index = np.searchsorted(self.starts, offset + place, side="right") - 1
        share = (place - self.begins[index]) / self.width[index]
        return np.asarray(self.angle[index] + np.where(share > 0.0, share * self.change[index], 0.0))


def followed_nodes(plan: Plan, name: str) -> list[Node]:
    """Return the nodes of the vector whose direction is followed, then of its derivatives by the strokes."""
    nodes = plan.trace.components(plan.trace.directions[name])
    return [*nodes, *(each for stroke in plan.strokes for each in plan.derived(nodes, (stroke,)))]


@record
class Vectors:
    """The vector whose direction is followed, anywhere on ways; `known` are the angles that it may hang on."""

    plan: Plan
    designs: Mapping[str, Numbers]
    ways: StrokeLines
    name: str
    known: Mapping[str, AnglePath]

    def at(self, line: Index, place: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the vector and its derivative by the place, shape (2, k); NaN out of reach."""
        inputs, rows = self._inputs(line, place)
        kernel: Kernel = self.plan.made(("followed", self.name), lambda plan: Kernel(followed_nodes(plan, self.name)))
        found = kernel(inputs, size=(len(line), 1) if rows else (1, len(line))).values.reshape(-1, len(line))
        rate = sum((found[2 * k + 2 : 2 * k + 4] * slope[line] for k, slope in enumerate(self.ways.along.values())), np.zeros((2, 1)))
        value, missing = found[:2], ~np.isfinite(found[:2]).all(axis=0)
        if missing.any():  # places that stand at a dead point are filled in to rounding
            many = {name for name, each in inputs.items() if np.size(each) == missing.size and np.ndim(each)}
            there = {name: np.ravel(each)[missing] if name in many else each for name, each in inputs.items()}
            there |= {name: np.full(int(missing.sum()), np.nan) for name in self.plan.followed if name not in there}
            with np.errstate(all="ignore"):
                vector = self.plan.read(there).directions[self.name]
            value = np.array(value)
            value[:, missing] = np.broadcast_to(np.array(np.broadcast_arrays(vector.x, vector.y)), (2, int(missing.sum())))
        return value, rate

    def _inputs(self, line: Index, place: FloatArray) -> tuple[dict[str, Numbers], bool]:
        """Return the inputs at places, and whether designs differ: then these are (k,) and strokes (k, 1)."""
        design = self.ways.design[line]
        rows = any(np.ndim(value) for value in self.designs.values())
        inputs = {name: value[design] if isinstance(value, np.ndarray) and value.ndim else value for name, value in self.designs.items()}
        moved = {name: self.ways.first[name][line] + slope[line] * place for name, slope in self.ways.along.items()}
        moved |= {name: np.rint(track.angle_at(line, place)) for name, track in self.known.items()}
        pins = {name: np.full(len(design), np.nan) for name in self.plan.grouped}
        for each in np.unique(design) if pins else ():
            here = design == each
            own = {name: value if np.ndim(value) == 0 else float(np.asarray(value)[each]) for name, value in self.designs.items()}
            solved = solve_groups(self.plan, own, {name: moved[name][here] for name in self.plan.strokes})
            for name in pins:
                pins[name][here] = np.broadcast_to(solved.inputs[name], (1, int(here.sum())))[0]
        return inputs | {name: value[:, None] if rows else value for name, value in (moved | pins).items()}, rows
