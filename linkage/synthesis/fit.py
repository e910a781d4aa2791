"""How far designs are off a task: all its points in one pose set of one kernel, with exact derivatives of a whole population."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import replace
from typing import Any, TypeAlias

import numpy as np

from ..errors import unwarned
from ..frozen import immutable
from ..motion import Grid, Request, stroke_display_unit
from ..motion.requests import slope
from ..numeric.descent import BEGIN, descended
from ..numeric.line import Index
from ..plan import Mask, Plan
from ..program import FloatArray, Kernel, RunOptions
from ..study.designs import DesignValues
from ..study.measured import all_placed, traced_number
from ..study.problem import Problem, is_still
from ..study.solver import MET, LeastSquares
from .tasks import TaskRows

TURN = 2.0 * np.pi
WHOLE = 96
"""Poses of a stroke at which a population is looked at, whether it is assembled over all of it."""
PIECE = 1 << 20
"""Poses of a population that are looked at at a time."""
SMALL = 1e-3
"""Of a task's size: what misses are measured with at the least, where a search with conditions starts from a fit that is nearly exact."""
ENOUGH = 1e-15
"""Of a task's size: a miss that is smaller is rounding."""
SETTLED = 1e-12
"""Of the sum of the squares of misses: a step that changes no more is at an end."""
SEAM, ROUNDING = 1e-10, 1e-6
"""Of a turn: an angle so near to where the turn begins stands there; an angle that is so little before another may be so by rounding."""
WAY = RunOptions("numpy")
Through: TypeAlias = Callable[[FloatArray], Mask] | None
"""Which designs (m, n + w) a search may come through; None for all."""


def one_way_round(angles: FloatArray, turn: float = TURN) -> FloatArray:
    """Return angles (..., n), each by whole turns after the one before it, the way round that is shorter in all."""
    steps, back = np.diff(angles), ROUNDING * turn
    forward, backward = (sense * (np.mod(sense * steps + back, turn) - back) for sense in (1.0, -1.0))
    shorter = (forward.sum(axis=-1) <= -backward.sum(axis=-1))[..., None]
    ahead = np.cumsum(np.where(shorter, forward, backward) - steps, axis=-1)
    return np.concatenate([angles[..., :1], angles[..., 1:] + turn * np.round(ahead / turn)], axis=-1)


def within_turn(angles: FloatArray, start: float, turn: float = TURN) -> FloatArray:
    """Return angles (n,) by whole turns within one from `start` on, backward where `turn` is below zero.

    All of them go by the same turns where they fit into one so; else each by itself.
    """
    along = (angles - start) / turn
    turns = np.floor(along.min() + SEAM)
    if along.max() - turns > 1.0 + SEAM:
        turns = np.floor(along + SEAM)
    low, high = sorted((start, start + turn))
    return np.asarray(np.clip(angles - turns * turn, low, high))


def goes_one_way(strokes: FloatArray, wide: float) -> bool:
    """Return whether strokes (n,) follow one another to either side, the last no farther than `wide` from the first."""
    steps = np.diff(strokes) * (1.0 if strokes[-1] >= strokes[0] else -1.0)
    return bool((steps >= -1e-9 * wide).all() and abs(strokes[-1] - strokes[0]) <= (1.0 + 1e-9) * wide)


@immutable
class Timing:
    """The strokes of the points: `base` + `moves` @ (low + width * own), own unknowns (w,) from 0 to 1; `turn` that of a crank, else 0.

    Of a crank the unknowns go over three turns, so that no end is in the way.
    """

    stroke: str
    start: float
    span: float
    turn: float
    moves: FloatArray

    @classmethod
    def of(cls, problem: Problem, stroke: str, timed: object, count: int) -> Timing:
        """Return how the points of a task are timed on the one stroke of a machine that moves."""
        low, high = ends_of_stroke(problem, stroke, [0] * len(problem.space.choices))
        is_turn = stroke_display_unit(problem.plan, stroke, "mm") == "deg" and abs(abs(high - low) - TURN) < 1e-9
        if timed is True:
            moves = np.zeros((count, 0))
        elif timed == "steps" and is_turn:
            moves = np.ones((count, 1))
        elif timed == "steps":
            moves = np.stack([np.linspace(1.0, 0.0, count), np.linspace(0.0, 1.0, count)], axis=1)
        else:
            moves = np.eye(count)
        return cls(stroke, low, high - low, TURN if is_turn else 0.0, moves)

    @property
    def width(self) -> int:
        """How many unknowns there are."""
        return int(self.moves.shape[1])

    @property
    def unknowns_range(self) -> tuple[float, float]:
        """Where the unknowns' range begins, and how long it is [SI]."""
        return (self.start - self.span, 3.0 * self.span) if self.turn else (self.start, self.span)

    def strokes(self, base: FloatArray, own: FloatArray) -> FloatArray:
        """Return the strokes (m, n) [SI] of unknowns (m, w)."""
        low, wide = self.unknowns_range
        return np.asarray(base + (low + wide * own) @ self.moves.T)

    def unknowns_at(self, strokes: FloatArray) -> FloatArray:
        """Return the unknowns (m, w) of strokes (m, w) [SI]."""
        low, wide = self.unknowns_range
        return np.asarray((strokes - low) / wide)

    def within(self, strokes: FloatArray) -> FloatArray:
        """Return strokes (n,) [SI] within the range, of a crank by whole turns."""
        return within_turn(strokes, self.start, self.span) if self.turn else strokes

    def one_way(self, strokes: FloatArray) -> FloatArray:
        """Return strokes (m, n) [SI], of a crank by whole turns, so that they follow one another where they can."""
        return one_way_round(strokes, self.turn) if self.turn else strokes

    def centred(self, own: FloatArray) -> FloatArray:
        """Return unknowns (m, w), of a crank by whole turns, so that no end is near."""
        if not (self.turn and self.width):
            return own
        turn = self.turn / abs(self.unknowns_range[1])
        return np.asarray(own - turn * np.round((own.mean(axis=1, keepdims=True) - 0.5) / turn))


def fit_kernels(plan: Plan, requests: Sequence[Request], owners: tuple[str, ...]) -> tuple[Kernel, Kernel]:
    """Return a kernel of whether every point has a place and of a task's quantities; and another with their derivatives."""
    values = [*all_placed().nodes(plan), *(node for each in requests for node in each.nodes(plan))]
    shares = [node for each in requests for node in slope(each, owners).nodes(plan)] if owners else []
    return Kernel(values), Kernel([*values, *shares])


class Fit:
    """A task on the designs of a problem: misses and their derivatives by unit coordinates (m, n), then by the points' own unknowns."""

    def __init__(
        self, problem: Problem, rows: TaskRows, timing: Timing, combination: Sequence[int] = (), at: FloatArray | None = None
    ) -> None:
        if problem.ranges[timing.stroke].follows:  # a cylinder's whole way, by its row
            low, high = ends_of_stroke(problem, timing.stroke, combination)
            timing = replace(timing, start=low, span=high - low)
        self.problem, self.rows, self.timing, self.combination = problem, rows, timing, tuple(combination)
        self.known = np.zeros(rows.count) if at is None else at
        self.plan, self.space = problem.plan, problem.space
        self.requests = [traced_number(self.plan, each) for each in rows.quantities]
        self.owners = tuple(dict.fromkeys(each.owner for each in self.space.variables))
        inputs = (*self.owners, timing.stroke)
        key: Hashable = ("fit", tuple(each.key for each in self.requests), inputs)
        self.kernel, self.graded_kernel = self.plan.made(key, lambda twin: fit_kernels(twin, self.requests, inputs))
        self.held = {name: float(one.low) for name, one in problem.ranges.items() if is_still(one)}
        self.n, self.width = len(self.space.variables), timing.width
        self._fixed = problem.dimensions_at(np.zeros(self.n), self.combination)
        self._owner_of = np.array([self.owners.index(each.owner) for each in self.space.variables], int)
        self._by_unit = np.array([each.sign * each.span for each in self.space.variables])
        counted = rows.weights[:, None] * rows.is_wanted
        self._counted = None if (counted == 1.0).all() else counted

    def dimensions_of(self, unit: FloatArray) -> DesignValues:
        """Return the dimensions of designs (m, n)."""
        return self._fixed | self.space.dimensions_at(unit[..., : self.n])

    def strokes(self, at: FloatArray, base: FloatArray) -> FloatArray:
        """Return the strokes (m, n) [SI] at which designs with their own unknowns (m, n + w) come to the points."""
        return self.timing.strokes(base, at[:, self.n :])

    def grid_at(self, designs: Mapping[str, Any], strokes: FloatArray) -> Grid:
        """Return designs at strokes (n,), or (m, n) where each has its own."""
        own = strokes.ndim == 2
        every = {name: np.full(strokes.shape, value) for name, value in self.held.items()} | {self.timing.stroke: strokes}
        return Grid(self.plan, designs, every, per_design=own)

    def values(self, designs: Mapping[str, object], strokes: FloatArray, count: int) -> tuple[FloatArray, Mask]:
        """Return the task's quantities of m designs at strokes, (m, r, n), NaN out of reach, and where they are reached (m, n)."""
        found = self._run(self.kernel, designs, strokes, count)
        return found[1:].swapaxes(0, 1), np.isfinite(found[0])

    def _run(self, kernel: Kernel, designs: Mapping[str, Any], strokes: FloatArray, count: int) -> FloatArray:
        """Return a kernel's values (outputs, m, n), NaN where a point has no place."""
        self.problem.count.add(count)
        shape = count, strokes.shape[-1]
        if self.plan.solved or not self.n:
            grid = self.grid_at(designs, strokes)
            with unwarned(), np.errstate(all="ignore"):
                found = np.array(np.broadcast_to(grid.kernel_result(kernel, way=WAY).values, (len(kernel.outputs), *shape)))
        else:  # nothing is to be solved first: the inputs as they are
            found = kernel({**designs, **self.held, self.timing.stroke: strokes}, way=WAY, size=shape).values
        reached = np.isfinite(found[0])
        if not reached.all():
            found[:, ~reached] = np.nan
        return found

    def assembled(self, unit: FloatArray) -> Mask:
        """Return which designs (m, n) are assembled at all poses of the stroke that are looked at, (m,)."""
        return np.asarray(self.swept(unit)[1].all(axis=1))

    def keeping(self, unit: FloatArray) -> Mask:
        """Return which designs (m, n) are assembled over the whole stroke and keep the conditions at the poses that are looked at, (m,)."""
        found = self.assembled(unit)
        if self.problem.constraints and found.any():
            short = self.problem.missing_of_each(self.combination, unit[found][:, : self.n]).max(axis=0, initial=0.0)
            found[found] = short <= MET
        return found

    def swept(self, unit: FloatArray, count: int = WHOLE) -> tuple[FloatArray, Mask]:
        """Return the task's quantities over the whole stroke, (m, r, count), and where reached; of a crank without its last pose."""
        strokes = self.timing.start + self.timing.span * np.linspace(0.0, 1.0, count, endpoint=not self.timing.turn)
        size = max(PIECE // count, 1)
        parts = [self.values(self.dimensions_of(each), strokes, len(each)) for each in np.split(unit, range(size, len(unit), size))]
        return np.concatenate([part[0] for part in parts]), np.concatenate([part[1] for part in parts])

    def misses(self, at: FloatArray, base: FloatArray) -> FloatArray:
        """Return how far designs and their own unknowns (m, n + w) are off, (m, r * n)."""
        strokes = self.strokes(at, base)
        values, _ = self.values(self.dimensions_of(at), strokes, len(at))
        return self.rows.off(values).reshape(len(at), len(self.requests) * self.rows.count)

    def slopes(self, at: FloatArray, base: FloatArray) -> FloatArray:
        """Return the derivatives of the misses, (m, r * n, n + w)."""
        return self.graded(at, base)[1]

    def graded(self, at: FloatArray, base: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the misses (m, r * n) and their derivatives (m, r * n, n + w)."""
        strokes = self.strokes(at, base)
        found = self._run(self.graded_kernel, self.dimensions_of(at), strokes, len(at))
        r, points, p = len(self.requests), strokes.shape[1], len(self.owners) + 1
        off = self.rows.off(found[1 : 1 + r].swapaxes(0, 1)).reshape(len(at), r * points)
        shares = found[1 + r :].reshape(r, p, len(at), points)
        shares[~np.isfinite(shares)] = 0.0
        if self._counted is not None:
            shares *= self._counted[:, None, None, :]
        slopes = np.empty((len(at), r, points, self.n + self.width))
        slopes[..., : self.n] = shares[:, self._owner_of].transpose(2, 0, 3, 1) * self._by_unit
        slopes[..., self.n :] = shares[:, -1].swapaxes(0, 1)[..., None] * (self.timing.unknowns_range[1] * self.timing.moves)
        return off, slopes.reshape(len(at), r * points, -1)

    def descend(
        self, at: FloatArray, base: FloatArray, steps: int, *, through: Through = None, held: Sequence[int] = (), begin: float = BEGIN
    ) -> tuple[FloatArray, FloatArray]:
        """Return where the misses are least near starts (m, n + w), and the sums of their squares (m,), infinite out of reach.

        `through` says which designs (m, n + w) a search may come through, all by default. Coordinates that are `held` stay where they are.
        `begin` is the damping of the first step.
        """
        if not len(at):
            return at, np.zeros(0)

        rows = len(self.requests) * self.rows.count
        steep, new_steep, new_at = np.zeros((len(at), rows, at.shape[1])), np.zeros((len(at), rows, at.shape[1])), np.full(at.shape, np.nan)
        least = np.full(len(at), np.inf)

        def misses(unit: FloatArray, which: Index) -> FloatArray:
            found, new_steep[which] = self.graded(unit, base[which])
            new_at[which] = unit
            error = squared(found)
            if through is not None:  # only what would be a step forward is looked at over the whole stroke
                ahead = np.flatnonzero(error < least[which])
                found[ahead[~through(unit[ahead])] if len(ahead) else ahead] = np.nan
                error = squared(found)
            least[which] = np.minimum(least[which], error)
            return found

        def slopes(unit: FloatArray, which: Index) -> FloatArray:
            taken = (new_at[which] == unit).all(axis=1)
            steep[which[taken]] = new_steep[which[taken]]
            found = steep[which]
            if held:
                found[:, :, [*held]] = 0.0
            return found

        def ahead(unit: FloatArray, which: Index) -> FloatArray:
            return self.misses(unit, base[which])

        enough = ENOUGH * self.rows.size
        bent = ahead if through is None else None
        found, off = descended(misses, slopes, at, steps, enough=enough, begin=begin, settled=SETTLED, ahead=bent)
        return found, squared(off)

    def put_in_order(self, at: FloatArray, base: FloatArray) -> FloatArray:
        """Return designs and their own unknowns (m, n + w), each stroke put where the one before it is if it comes before that."""
        strokes, wide = self.timing.one_way(self.strokes(at, base)), abs(self.timing.span)
        first = strokes[:, :1]
        sense = np.where(strokes[:, -1:] >= first, 1.0, -1.0)
        ordered = first + np.minimum(np.maximum.accumulate(sense * (strokes - first), axis=1), wide) * sense
        moved = np.where(np.abs(ordered - strokes) > 1e-15 * wide, ordered, strokes)
        return np.concatenate([at[:, : self.n], np.clip(self.timing.centred(self.timing.unknowns_at(moved - base)), 0.0, 1.0)], axis=1)

    def errors(self, at: FloatArray, base: FloatArray) -> FloatArray:
        """Return the sums of the squares of the misses (m,), infinite out of reach."""
        return squared(self.misses(at, base)) if len(at) else np.zeros(0)


def ends_of_stroke(problem: Problem, stroke: str, combination: Sequence[int]) -> tuple[float, float]:
    """Return from where to where [SI] a stroke is looked at, of a combination of choices."""
    one = problem.ranges[stroke]
    if not one.follows:
        return float(one.low), float(one.high)
    return problem.ends(dict(problem.machine.dimensions) | dict(problem.space.chosen(combination)))[stroke]


def squared(off: FloatArray) -> FloatArray:
    """Return the sums of the squares of misses (m, k); infinite where one has no value."""
    error = np.sum(off**2, axis=1)
    return np.where(np.isfinite(error), error, np.inf)


def fit_squares(fit: Fit, at: FloatArray, base: FloatArray, *, in_order: bool) -> LeastSquares:
    """Return the misses of a fit as a solver with conditions takes them, in parts of those at a start; points `in_order` stay so."""
    base, own, lines = base[None], np.array(at[fit.n :]), (np.zeros((0, fit.width)), np.zeros(0))
    if in_order and fit.width > 1:
        own = fit.put_in_order(at[None], base)[0, fit.n :]
        sense, every = 1.0 if own[-1] >= own[0] else -1.0, np.eye(fit.width)
        turn = fit.timing.turn / abs(fit.timing.unknowns_range[1]) if fit.timing.turn else 1.0  # all within one turn
        ahead = sense * np.concatenate([np.diff(every, axis=0), every[[0]] - every[[-1]]])
        lines = ahead, np.append(np.zeros(fit.width - 1), turn)
    size = max(float(np.sqrt(fit.errors(at[None], base)[0])), SMALL * fit.rows.size)

    def misses(at: FloatArray) -> FloatArray:
        return np.asarray(fit.misses(at[None], base)[0] / size)

    def slopes(at: FloatArray) -> FloatArray:
        return np.asarray(fit.slopes(at[None], base)[0] / size)

    return LeastSquares(own, lines, misses, slopes)
