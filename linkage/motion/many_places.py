"""Strokes of many places at once: all branches of each, from one grid of the strokes, by steps of Newton in all rows together.

`places.py` answers for one place. Here the places are a grid of x and y. So a cell of strokes is laid over the places that it may give, by
looking up its bounds in rows and columns. Strokes that are left over are spare: they stand at some values each.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property
from itertools import combinations, product
from typing import Any

import numpy as np

from ..errors import DefinitionError
from ..frozen import immutable
from ..numeric.descent import all_known, corners_all, descended, extremes_of_cells, grid_axes
from ..numeric.line import Index
from ..numeric.linear import solved_systems
from ..plan import Mask, Plan
from ..program import FloatArray
from .places import MET, SCATTERED, Places, StrokeRanges, Target, held_strokes, traced_target
from .strokes import TURN

MOST_SPARE = 2
SIDE = {0: {1: 129, 2: 33, 3: 13}, 1: {1: 65, 2: 17, 3: 9}, 2: {1: 33, 2: 13, 3: 7}}
"""Values of each stroke that is solved for, by how many are spare and how many are solved for; 6 of more."""
A_TURN = {1: 96, 2: 24, 3: 12}
"""Values of a crank for each turn of it, at the least."""
SPARE = {0: 1, 1: 17, 2: 9}
"""Values of each spare stroke of the first look."""
ITERATIONS = 9
"""Steps of Newton, after which those that are not settled are looked for with damping."""
TOLERANCE = 1e-13
"""Of the size of what it measures: a target that is missed by no more is met."""
FAR = 0.6
"""How far outside the ranges, in shares of them, steps of Newton are followed."""
SURE = 1e-8
"""A step, in shares of the ranges, after which a target is met without another look: its error is this one's square."""
LEAP = 0.35
"""The longest step, in shares of the ranges."""
EDGE = 1e-10
"""How far outside the range of a stroke, in shares of it, a pose counts as at its end."""


@immutable
class PlacePoses:
    """Poses that give places: of which place (n,), unit coordinates of all strokes looked for (n, k), those solved for first."""

    place: Index
    unit: FloatArray

    def concatenated(self, *others: PlacePoses) -> PlacePoses:
        """Return these and others behind them."""
        every = (self, *others)
        return PlacePoses(np.concatenate([each.place for each in every]), np.concatenate([each.unit for each in every]))

    def select(self, rows: Any) -> PlacePoses:
        """Return some of them."""
        return PlacePoses(self.place[rows], self.unit[rows])


@immutable
class ManyPlaces:
    """Targets of one design, the first two of which are x and y of a point, for many places.

    `places` has all strokes that are not held, those solved for first; the last `spare` of them stand at some values.
    """

    places: Places
    spare: int

    @classmethod
    def for_targets(
        cls, plan: Plan, designs: Mapping[str, Any], targets: Sequence[Target], hold: object, *, where: str, ranges: StrokeRanges
    ) -> ManyPlaces:
        """Return targets bound to one design; DefinitionError for anything else, and for more than two strokes to spare."""
        title = f"{plan.title}: {where}"
        held = held_strokes(plan, hold, title)
        free = [name for name in plan.strokes if name not in held]
        spare = len(free) - len(targets)
        if spare > MOST_SPARE:
            example = f'hold={{"{free[-1]}": {plan.sketch_strokes[free[-1]]:.4g}}}'
            what = f"{len(targets)} targets leave {spare} of the strokes {', '.join(free)} to spare"
            raise DefinitionError(f"{title}: {what}, up to {MOST_SPARE} are looked at; hold one, {example}, or keep= something.")
        if spare <= 0 or any(np.ndim(value) for value in designs.values()) or not all(isinstance(each, Target) for each in targets):
            return cls(Places.for_targets(plan, designs, targets, hold, where=where, ranges=ranges), 0)
        bound = tuple(traced_target(plan, each, title) for each in targets)
        every = Places(plan, {k: float(v) for k, v in designs.items()}, tuple(targets), bound, tuple(free), held, ranges)
        # spare are those without which the others move the targets most, the last ones where equal
        slopes = every.slopes(SCATTERED[:, : len(free)]) / every.sizes[:, None]
        slopes, best, loose = slopes[all_known(slopes)], -1.0, tuple(free[-spare:])
        for few in reversed([*combinations(range(len(free)), spare)]):
            kept = [at for at in range(len(free)) if at not in few]
            size = float(np.median(np.abs(np.linalg.det(slopes[:, :, kept])))) if len(slopes) else 0.0
            if size > best * (1.0 + 1e-9):
                best, loose = size, tuple(free[at] for at in few)
        Places.for_targets(plan, designs, targets, {**held, **{name: plan.sketch_strokes[name] for name in loose}}, where=where)
        return cls(every.reordered((*(name for name in free if name not in loose), *loose)), spare)

    @property
    def solved(self) -> int:
        """How many strokes are solved for, as many as there are targets."""
        return len(self.places.free) - self.spare

    @cached_property
    def tolerance(self) -> FloatArray:
        """By how much each target may be missed [SI], shape (t,)."""
        return TOLERANCE * self.places.sizes

    def seen(self, unit: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the values of the targets (n, t) and their derivatives (n, t, k) by unit coordinates (n, k); NaN out of reach."""
        found, t = self.places.kernel_values(self.places.program.values_and_slopes, unit), len(self.places.targets)
        return found[:t].T, self.places.by_unit(found[t:])

    # -- the first look ----------------------------------------------------------------------------------

    @property
    def spare_step(self) -> FloatArray:
        """How far the values of each spare stroke are apart in the first look, in shares of its range."""
        return np.full(self.spare, 1.0 / (SPARE[self.spare] - 1))

    def looked_at(self, out: FloatArray | float = 0.0, ends: Sequence[FloatArray] | None = None) -> PlaceGrid:
        """Return a grid of the strokes, which reach `out` of their ranges beyond either end; the spare ones at `ends` where given."""
        places, k = self.places, self.solved
        outs = np.broadcast_to(np.asarray(out, float), (len(places.free),))
        counts = places.looked_at(outs, SIDE[self.spare].get(k, 6), A_TURN.get(k, 6))
        counts[k:] = SPARE[self.spare] * (1.0 + 2.0 * outs[k:])
        axes = grid_axes(outs, counts)
        axes[k:] = axes[k:] if ends is None else ends
        order = [*range(k, len(axes)), *range(k)]
        grid = np.stack([each.ravel() for each in np.meshgrid(*(axes[at] for at in order), indexing="ij")], axis=1)
        unit = grid[:, [order.index(at) for at in range(len(axes))]]
        return PlaceGrid(self, axes[:k], axes[k:], unit, places.kernel_values(places.program.values, unit))

    # -- steps -------------------------------------------------------------------------------------------

    def seen_in(self, unit: FloatArray, order: Index | None) -> tuple[FloatArray, FloatArray]:
        """Return the same of poses that have their strokes in orders of their own (n, k), None for that of `places`."""
        if order is None:
            return self.seen(unit)
        usual = np.empty_like(unit)
        np.put_along_axis(usual, order, unit, axis=1)
        values, slopes = self.seen(usual)
        return values, np.take_along_axis(slopes, order[:, None, :], axis=2)

    def settled(
        self, start: PlacePoses, goals: FloatArray, outs: FloatArray, *, damped: bool | str = True, iterations: int = ITERATIONS,
        order: Index | None = None,
    ) -> tuple[PlacePoses, Mask]:  # fmt: skip
        """Return the poses to which Newton's steps lead from some poses towards their places' goals (places, t), and which have met them.

        The spare strokes stay. Those that do not settle go on with damped steps inside the ranges, where `damped`; "unsettled" are those
        alone that have not left the ranges. Without damping each may have its strokes in an `order` of its own (n, k).
        """
        k, places = self.solved, self.places
        unit, wanted = start.unit.copy(), goals[start.place]
        met, going, lost = np.zeros(len(unit), bool), np.arange(len(unit)), np.zeros(len(unit), bool)
        low, high = (-outs[:k] - FAR)[:, None], (1.0 + outs[:k] + FAR)[:, None]
        for _ in range(iterations):
            if not len(going):
                break
            values, slopes = self.seen_in(unit[going], None if order is None else order[going])
            off = places.off(values, wanted[going])
            here = (np.abs(off.T, order="C") <= self.tolerance[:, None]).all(axis=0)  # in rows of all poses, which NumPy runs along
            step = solved_systems(slopes[:, :, :k], off)
            size = np.abs(step.T, order="C").max(axis=0)
            good = np.isfinite(size)
            step *= np.minimum(1.0, LEAP / np.where(size > 0.0, size, 1.0))[:, None]
            near = here | (size <= SURE)
            lost[going[~good]] = True
            unit[going[good & ~here], :k] -= step[good & ~here]
            met[going[near]] = True
            going = going[good & ~near]
            at = unit[going].T[:k].copy()
            out = ((at < low) | (at > high)).any(axis=0)
            lost[going[out]] = True
            going = going[~out]
        left = ~met & ~lost if damped == "unsettled" else ~met & bool(damped)
        if left.any():
            self._damped(unit, np.flatnonzero(left), start.unit, wanted, outs, met)
        inside = ((unit[:, :k] >= -outs[:k] - EDGE) & (unit[:, :k] <= 1.0 + outs[:k] + EDGE)).all(axis=1)
        unit[:, :k] = np.clip(unit[:, :k], -outs[:k], 1.0 + outs[:k])
        return PlacePoses(start.place, unit), met & inside

    def _damped(self, unit: FloatArray, rows: Index, begun: FloatArray, wanted: FloatArray, outs: FloatArray, met: Mask) -> None:
        k, places = self.solved, self.places
        wide, sizes = 1.0 + 2.0 * outs[:k], places.sizes
        spare = begun[rows, k:]

        def whole(box: FloatArray, at: Index) -> FloatArray:
            return np.concatenate([box * wide - outs[:k], spare[at]], axis=1)

        def misses(box: FloatArray, at: Index) -> FloatArray:
            return places.off(self.seen(whole(box, at))[0], wanted[rows[at]]) / sizes

        def slopes(box: FloatArray, at: Index) -> FloatArray:
            return self.seen(whole(box, at))[1][:, :, :k] * wide / sizes[:, None]

        begin = np.clip((begun[rows, :k] + outs[:k]) / wide, 0.0, 1.0)
        box, off = descended(misses, slopes, begin, 12, enough=TOLERANCE, begin=1e-6)
        unit[rows, :k] = box * wide - outs[:k]
        met[rows] = (np.abs(off) <= MET).all(axis=1)


@immutable
class PlaceGrid:
    """A grid of strokes with the targets' values there (t, n): axes of the strokes that are solved for, and of those to spare.

    `unit` are its places (n, k), the spare strokes running slowest.
    """

    many: ManyPlaces
    axes: Sequence[FloatArray]
    spare: Sequence[FloatArray]
    unit: FloatArray
    values: FloatArray

    @cached_property
    def cells(self) -> tuple[FloatArray, FloatArray]:
        """The least and the greatest that each target may be in each cell of each lot (t, cells); NaN where nothing is assembled."""
        t, counts = len(self.values), tuple(map(len, self.axes))
        lots = int(np.prod([len(axis) for axis in self.spare], dtype=int))
        values = self.values.reshape(t * lots, *counts)
        low, high, bend = extremes_of_cells(values)
        known: Mask = np.asarray(np.isfinite(values).reshape(t, lots, *counts).all(axis=0))
        whole = np.stack([corners_all(each) for each in known])
        room = np.where(whole[None], 0.1, 1.0) * (high - low).reshape(t, lots, *whole.shape[1:])
        room = room.reshape(low.shape) + 0.5 * bend
        return (low - room).reshape(t, -1), (high + room).reshape(t, -1)

    def starts(self, x: FloatArray, y: FloatArray, rest: FloatArray) -> PlacePoses:
        """Return where to start for places x by y, ascending, numbered with x running fastest; `rest` (t - 2,) is kept."""
        low, high = self.cells
        ok = np.isfinite(low).all(axis=0) & np.isfinite(high).all(axis=0)
        for each, (a, b), is_angle in zip(rest, zip(low[2:], high[2:], strict=True), self.many.places.angles[2:], strict=True):
            miss = each - 0.5 * (a + b)
            miss = miss - TURN * np.round(miss / TURN) if is_angle else miss
            ok &= np.abs(miss) <= 0.5 * (b - a)
        cell = np.flatnonzero(ok)
        first = [np.searchsorted(axis, low[at, cell], "left") for at, axis in enumerate((x, y))]
        last = [np.searchsorted(axis, high[at, cell], "right") for at, axis in enumerate((x, y))]
        wide, tall = last[0] - first[0], last[1] - first[1]
        count = wide * tall
        row = np.repeat(np.arange(len(cell)), count)
        inner = np.arange(len(row)) - np.repeat(np.cumsum(count) - count, count)
        place = (first[1][row] + inner // np.maximum(wide[row], 1)) * len(x) + first[0][row] + inner % np.maximum(wide[row], 1)
        # each cell is begun in the middle of its corners that are assembled
        counts = [len(axis) for axis in (*self.spare, *self.axes)]
        index = np.stack(np.unravel_index(cell, (*counts[: len(self.spare)], *(len(axis) - 1 for axis in self.axes))), axis=1)
        known: Mask = np.asarray(np.isfinite(self.values).all(axis=0))
        total, weight = np.zeros((len(cell), self.unit.shape[1])), np.zeros(len(cell))
        for corner in product((0, 1), repeat=len(self.axes)):
            near = np.ravel_multi_index(tuple((index + np.array([*[0] * len(self.spare), *corner])).T), counts)
            total[known[near]] += self.unit[near[known[near]]]
            weight += known[near]
        return PlacePoses(place, (total / np.maximum(weight, 1.0)[:, None])[row])
