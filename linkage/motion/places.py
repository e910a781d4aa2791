"""Strokes from places: all that give some targets, on the exact slopes from a grid of strokes; where none does, how far off the nearest is.

A grid of the strokes is looked at first. Steps of Levenberg and Marquardt start in every cell in which all targets may be met, by their
values at its corners and how these bend. Where two branches come close to each other, they start from the other side of each as well.
"""

from __future__ import annotations

from collections.abc import ItemsView, Iterable, Mapping, Sequence, ValuesView
from dataclasses import replace
from functools import cached_property
from itertools import combinations, product
from typing import Any, NoReturn, TypeAlias

import numpy as np

from ..errors import DefinitionError, SingularWarning, cited, ensure, known_name, require, require_one_design, require_type, unwarned, warn
from ..frozen import FrozenDict, immutable, read_only
from ..language import said
from ..numeric.box import widened
from ..numeric.descent import all_known, along, corners_all, descended, extremes_of_cells, grid_axes, is_one_solution, without_repeats
from ..numeric.line import Index, last_holding
from ..plan import Mask, Plan, require_kind
from ..program import QUICKEST, FloatArray, Kernel, RunOptions, is_zero
from ..quantities import Quantity, is_number, numbers_in
from ..units import amount_or_float, deg, display_unit, mm, require_measure, require_number, show, unit_or_none
from .dead_points import WARN
from .grid import Grid
from .limits import stroke_display_unit
from .measures import measure_of, traced, words_of
from .motion import Motion
from .requests import Request, RequestLike
from .stroke_search import ON_ARRAYS
from .strokes import TURN, check_magnitude, checked_name

StrokeRanges: TypeAlias = Mapping[str, tuple[float, float]]
"""The ends of strokes, by name [m or rad]."""
DECLARED: StrokeRanges = FrozenDict()
"""All strokes as they are declared."""

SIDE = {1: 129, 2: 33, 3: 13, 4: 8, 5: 6}
"""Values of each stroke of the grid, by how many strokes are looked for; 5 of more of them."""
A_TURN = {1: 128, 2: 32, 3: 16, 4: 9, 5: 7}
"""Values of a crank for each turn of it, at the least."""
STARTS = 96
"""Starts on the grid, those where most seems to be met first."""
BORDER_STARTS = 48
"""Starts at the border of what can be assembled."""
FAR_OFF = 0.35
"""Of what a target changes by over the strokes: what misses it by more at a border is not met within a cell of it."""
NEXT_TO, PARTS = 1e-3, 32
"""Of a cell: how near to its border they lie; and in how many parts it is cut to find that."""
STEPS, MORE_STEPS = 8, 60
"""Steps from every start, and from those that have come near; a branch that ends there is come to by halves."""
DAMPING = 1e-6
"""The damping of the first step: the starts are near."""
ROUNDING = 1e-14
"""Of the size of what it measures: a miss that is no larger is rounding."""
CLOSE = 0.05
"""Of what a target changes by over the strokes: what misses it by less has come near it."""
MET = 1e-10
"""Of the size of what it measures: a target that is missed by no more is met."""
SAME = 1e-7
"""Of the range of a stroke: branches that are nearer to each other are one."""
BESIDE = 0.01
"""Of a cell of the grid: how far aside it is looked how the slopes change."""
CELLS = 3.0
"""Cells of the grid within which another branch is looked for beside each that is found."""
SCATTERED = 0.5 + 0.4 * np.sin(np.arange(1, 17)[:, None] * np.sqrt(np.arange(2, 34)))
"""Some poses in unit coordinates."""
MOST = 64
"""Branches that are told, where infinitely many meet the targets."""


@immutable
class PlaceProgram:
    """Some targets by the strokes that are looked for: kernels of their values, of their slopes, of both, and of the squared size [m2].

    `follows` are the targets (t, k) that a stroke has an effect on.
    """

    values: Kernel
    slopes: Kernel
    values_and_slopes: Kernel
    size: Kernel
    follows: Mask

    @classmethod
    def for_requests(cls, plan: Plan, requests: Sequence[Request], free: Sequence[str]) -> PlaceProgram:
        """Return the program of requests that are bound to a plan, made once."""

        def make(fork: Plan) -> PlaceProgram:
            nodes = [node for each in requests for node in each.nodes(fork)]
            rates = np.array([[*fork.derived([node], (name,))] for node in nodes for name in free], object).reshape(len(nodes), -1)
            follows = np.array([[not is_zero(node) for node in row] for row in rates])
            size = fork.trace.graph.node(fork.trace.extent)
            slopes = list(rates.ravel())
            return cls(Kernel(nodes), Kernel(slopes), Kernel([*nodes, *slopes]), Kernel([size]), follows)

        return plan.made(("places", tuple(each.key for each in requests), tuple(free)), make)


FEW = 4
"""Poses that are worked out in plain floats: the programs of places are small, and more are quicker as arrays."""


def way_of(count: int) -> RunOptions:
    """Return how so many poses are worked out."""
    return QUICKEST if count <= FEW else ON_ARRAYS


@immutable
class Places:
    """Targets of one design, bound to its plan, by the strokes that are looked for; the others are held.

    Unit coordinates are shares of the range of each stroke, from its least value on, and may lie beyond 0 to 1. `ranges` are the ends of
    strokes that do not run as far as they are declared [m or rad].
    """

    plan: Plan
    designs: Mapping[str, Any]
    targets: tuple[Target, ...]
    bound: tuple[Request, ...]
    free: tuple[str, ...]
    held: Mapping[str, float]
    ranges: StrokeRanges

    @classmethod
    def for_targets(
        cls, plan: Plan, designs: Mapping[str, Any], targets: Any, hold: Any, *, where: str, ranges: StrokeRanges = DECLARED
    ) -> Places:
        """Return targets bound to one design; DefinitionError for anything else, and where they do not ask for the strokes there are."""
        title = f"{plan.title}: {where}"
        require_one_design(designs, f"{title} is of one design")
        listed, held = targets_given(targets, title, 'such as [Target(x("G"), 2.5), Target(y("G"), 0.5)]'), held_strokes(plan, hold, title)
        for each in listed:
            names = ", ".join(f'hold={{"{name}": {value!r}}}' for name, value in each.strokes.items())
            ensure(not each.strokes, f"{title}: {each!r}: strokes are what is looked for here; one that stands still is held, {names}.")
        free = tuple(name for name in plan.strokes if name not in held)
        bound = tuple(traced_target(plan, each, title) for each in targets)
        found = cls(plan, {name: float(value) for name, value in designs.items()}, tuple(targets), bound, free, held, ranges)
        check_targets(found, title)
        return found

    def reordered(self, free: tuple[str, ...]) -> Places:
        """Return the same with the strokes that are looked for in another order."""
        return replace(self, free=free)

    @cached_property
    def program(self) -> PlaceProgram:
        """The kernels."""
        return PlaceProgram.for_requests(self.plan, self.bound, self.free)

    @cached_property
    def free_ends(self) -> FloatArray:
        """The ends of the strokes that are looked for [m or rad], as they are declared unless `ranges` say, shape (k, 2)."""
        declared = {name: (each.start, each.end) for name, each in self.plan.strokes.items()}
        return np.array([self.ranges.get(name, declared[name]) for name in self.free], float).reshape(-1, 2)

    @cached_property
    def low(self) -> FloatArray:
        """The least values of these strokes [m or rad], shape (k,)."""
        return np.asarray(self.free_ends.min(axis=1))

    @cached_property
    def span(self) -> FloatArray:
        """The ranges of these strokes [m or rad], shape (k,)."""
        return np.abs(self.free_ends[:, 1] - self.free_ends[:, 0])

    @cached_property
    def turning(self) -> Mask:
        """Which of these strokes are angles, shape (k,)."""
        return np.array([name in self.plan.turning for name in self.free])

    @cached_property
    def angles(self) -> Mask:
        """Which targets count modulo a turn, shape (t,)."""
        return np.array([measure_of(self.plan, each.quantity) == "angle" for each in self.targets])

    @cached_property
    def size(self) -> float:
        """The size of the machine [m]."""
        middle = self.low + 0.5 * self.span
        return float(np.sqrt(self.program.size(self.kernel_inputs(middle[:, None]), size=(1, 1)).values[0, 0, 0]))

    @cached_property
    def sizes(self) -> FloatArray:
        """The natural size of each target's quantity [SI], shape (t,): of a length that of the machine, of an angle 1."""
        kinds = [measure_of(self.plan, each.quantity) for each in self.targets]
        other = [max(float(np.max(np.abs(each.value))), each.miss(self.plan, 0.0)) for each in self.targets]
        known = {"length": self.size, "angle": 1.0}
        return np.array([known.get(kind, size) for kind, size in zip(kinds, other, strict=True)])

    @cached_property
    def tolerances(self) -> FloatArray:
        """How far off each target may be [SI], shape (t,), by which misses are weighed where nothing meets all of them."""
        return np.array([each.miss(self.plan, float(np.max(np.abs(each.value)))) for each in self.targets])

    # -- what is seen ------------------------------------------------------------------------------------

    def every(self, strokes: FloatArray) -> dict[str, FloatArray]:
        """Return all strokes by name [m or rad], shape (n,), from those that are looked for (k, n)."""
        found = dict(zip(self.free, strokes, strict=True)) | {name: np.full(strokes.shape[1], value) for name, value in self.held.items()}
        return {name: found[name] for name in self.plan.strokes}

    def kernel_inputs(self, strokes: FloatArray) -> Mapping[str, Any]:
        """Return the inputs of the program at strokes (k, n) [m or rad]."""
        every = self.every(strokes)
        return Grid(self.plan, self.designs, every).flat if self.plan.solved else {**self.designs, **every}

    def strokes_at(self, unit: FloatArray) -> dict[str, FloatArray]:
        """Return all strokes by name [m or rad], shape (n,), at unit coordinates (n, k)."""
        return self.every((self.low + unit * self.span).T)

    def kernel_values(self, kernel: Kernel, unit: FloatArray) -> FloatArray:
        """Return a kernel's values at unit coordinates (n, k), shape (outputs, n); NaN out of reach."""
        return kernel(self.kernel_inputs((self.low + unit * self.span).T), way=way_of(len(unit)), size=(1, len(unit))).values[:, 0]

    def target_values(self, unit: FloatArray) -> FloatArray:
        """Return the values of the targets [SI], shape (n, t), at unit coordinates (n, k); NaN out of reach."""
        return self.kernel_values(self.program.values, unit).T

    def slopes(self, unit: FloatArray) -> FloatArray:
        """Return their derivatives by unit coordinates, shape (n, t, k)."""
        return self.by_unit(self.kernel_values(self.program.slopes, unit))

    def by_unit(self, slopes: FloatArray) -> FloatArray:
        """Return derivatives by the strokes, shape (t k, n), as those by unit coordinates, shape (n, t, k)."""
        return slopes.reshape(len(self.targets), len(self.free), -1).transpose(2, 0, 1) * self.span

    def looked_at(self, out: FloatArray, side: float, turn: float) -> FloatArray:
        """Return how many values of each stroke are looked at from -out to 1 + out: `side` over its range, of a crank `turn` a turn."""
        wide = 1.0 + 2.0 * out
        return np.maximum(side * wide, turn * np.where(self.turning, wide * self.span / TURN, 0.0))

    def off(self, values: FloatArray, wanted: FloatArray) -> FloatArray:
        """Return by how much values (n, t) exceed the wanted ones (t,) [SI], angles the shorter way round."""
        miss = values - wanted
        if self.angles.any():
            miss[:, self.angles] -= TURN * np.round(miss[:, self.angles] / TURN)
        return miss

    def condition(self, unit: FloatArray) -> FloatArray:
        """Return how badly strokes are known from places, shape (n,): the largest slope anywhere over the least here, in natural sizes.

        It is infinite where some way of the strokes moves no target.
        """
        slopes = self.slopes(np.concatenate([unit, SCATTERED[:, : len(self.free)]])) / self.sizes[:, None]
        known = all_known(slopes)
        sizes = np.full((len(slopes), 2), np.nan)
        sizes[known] = np.linalg.svd(slopes[known], compute_uv=False)[:, [0, -1]]
        with np.errstate(divide="ignore"):
            found = np.fmax.reduce(sizes[:, 0], initial=0.0) / sizes[: len(unit), 1]
        return np.where(np.isnan(found), np.inf, found)

    def is_assembled(self, unit: FloatArray) -> Mask:
        """Return where the whole machine can be assembled, shape (n,)."""
        with unwarned():
            return Motion(self.plan, self.designs, self.strokes_at(unit), "nan").reached

    # -- words -------------------------------------------------------------------------------------------

    def shown(self, wanted: FloatArray) -> str:
        """Return the wanted values (t,) in words: `x(M) = 2500 mm, tilt = 5 deg`."""
        each = zip(self.bound, wanted.tolist(), self.targets, strict=True)
        return ", ".join(f"{name} = {show(value, target.shown_in(self.plan))}" for name, value, target in each)

    def stroke_words(self, strokes: FloatArray) -> str:
        """Return values of the free strokes (k,) in words: `boom = 1100 mm, arm = 1300 mm`."""
        return ", ".join(f"{name} = {self.stroke_value(name, value)}" for name, value in zip(self.free, strokes.tolist(), strict=True))

    def stroke_value(self, name: str, value: float, digits: int = 6) -> str:
        """Return a value of a stroke [m or rad] in words, lengths in millimetres."""
        return show(value, stroke_display_unit(self.plan, name, "mm"), digits)

    def past_words(self, strokes: FloatArray, out: Mask) -> str:
        """Return which of the free strokes (k,) are past which end, and by how much; `out` says which are."""
        words = []
        for place in np.flatnonzero(out).tolist():
            name, value, low = self.free[place], float(strokes[place]), float(self.low[place])
            end = low if value < low else low + float(self.span[place])
            away = {"value": self.stroke_value(name, value), "end": self.stroke_value(name, end)}
            past = self.stroke_value(name, abs(value - end), 4)
            words.append(said("{stroke} = {value} is {past} past its end at {end}", stroke=name, past=past, **away))
        return ", ".join(words)


def traced_target(plan: Plan, target: Target, title: str) -> Request:
    """Return a target's quantity, bound to a plan; DefinitionError for one without slopes in the program, and for other units."""
    target.check(plan)
    found = traced(plan, target.quantity)
    if found is None:
        what = f"{title}: {words_of(target.quantity)} is no part of the program, so that no slopes of it are known"
        raise DefinitionError(f'{what}; give an output, a quantity or a request, such as x("G") or "tilt".')
    return found


def held_strokes(plan: Plan, hold: object, title: str) -> dict[str, float]:
    """Return the strokes that are held, by name; DefinitionError for a name that is no stroke, and for a value that is no number."""
    if hold is None:
        return {}
    example = f'hold={{"{next(iter(plan.strokes))}": 0.1}}'
    held = stroke_numbers(plan, require_type(f"{title}: hold", hold, Mapping, f"strokes by name are expected, {example}"), f"{title}: hold")
    for name, value in held.items():
        check_magnitude(name, (value,), plan)
    return held


def stroke_numbers(plan: Plan, given: Mapping[str, Any], where: str) -> dict[str, float]:
    """Return strokes by name, a number each; DefinitionError for a name that is no stroke, and for a value that is no number."""
    for name, value in given.items():
        checked_name("Stroke", name, plan.strokes, plan.title)
        require(is_one(value), f"{where}: {name}", value, "one number is expected, in SI")
        require_kind(plan, name, value, f"{where}: {name}")
    return {name: float(value) for name, value in given.items()}


def check_targets(places: Places, title: str) -> None:
    """Raise DefinitionError unless there are as many targets as strokes to look for, each with some of its own."""
    free, targets, names = places.free, places.targets, [str(each) for each in places.bound]
    missing = len(free) - len(targets)
    strokes = f"{len(free)} free stroke{'s' * (len(free) != 1)}{', ' * bool(free)}{', '.join(free)}"
    counted = f"{len(targets)} target{'s' * (len(targets) != 1)} and {strokes}"
    if missing > 0:
        some = "it" if len(free) == 1 else "one of them" if missing == 1 else f"{missing} of them"
        example = f'hold={{"{free[-1]}": {places.low[-1] + 0.5 * places.span[-1]:.4g}}}'
        more = f"give {'one target' if missing == 1 else f'{missing} targets'} more"
        raise DefinitionError(f"{title}: {counted}: hold {some}, {example}, or {more}.")
    what = "one target" if missing == -1 else f"{-missing} targets"
    release = f", or do not hold {', '.join(places.held)}" if places.held else ""
    ensure(missing >= 0, f"{title}: {counted}: leave out {what}{release}.")
    follows = places.program.follows
    for place, name in enumerate(names):
        if not follows[place].any():
            all_free = Places(places.plan, places.designs, places.targets, places.bound, tuple(places.plan.strokes), {}, places.ranges)
            moving = [each for each, moves in zip(all_free.free, all_free.program.follows[place], strict=True) if moves]
            ensure(moving, f"{title}: {targets[place]!r}: no stroke moves {name}; give a target on what moves.")
            held = " and ".join(moving)
            raise DefinitionError(f"{title}: {targets[place]!r}: {name} follows {held} alone, which is held; hold another stroke.")
    for count in range(2, len(targets) + 1):
        for some_of in combinations(range(len(targets)), count):
            moving = [name for name, column in zip(free, follows[[*some_of]].T, strict=True) if column.any()]
            if len(moving) < count:
                what = f"{' and '.join(names[place] for place in some_of)} follow {' and '.join(moving)} alone"
                raise DefinitionError(f"{title}: {what}, which cannot give {count} targets; hold another stroke, or aim at something else.")


LOST = 1e10
"""A condition above which the slopes have lost a rank; where they have at every pose, the targets hang together."""


# -- the search ----------------------------------------------------------------------------------------------


@immutable
class FoundPlaces:
    """Unit coordinates (n, k) that were found, and by how much the targets are missed there (n, t) [SI]."""

    unit: FloatArray
    off: FloatArray

    def select(self, rows: Any) -> FoundPlaces:
        """Return some of them."""
        return FoundPlaces(self.unit[rows], self.off[rows])


def unmet_words(places: Places, wanted: FloatArray, near: FoundPlaces) -> str:
    """Return why no strokes in their ranges meet the targets: the pose beyond them, and how far off the nearest one is."""
    out = np.where(places.turning, np.maximum(0.5 * TURN / places.span - 0.5, 0.0), 1.0)  # a range beyond each end, a turn of a crank
    past = FoundPlaces(np.empty((0, len(out))), np.empty((0, len(places.targets))))
    if out.any():
        past = BranchSearch(places, wanted, out).branches()
        away = np.maximum(np.maximum(-past.unit, past.unit - 1.0), 0.0).max(axis=1)
        past = past.select(np.argsort(away, kind="stable"))
    if not len(near.unit) and not len(past.unit):
        return said("no strokes that were looked at can be assembled.")
    text = said("no strokes within their ends give {wanted}.", wanted=places.shown(wanted))
    if len(past.unit):
        unit = past.unit[0]
        strokes = places.low + unit * places.span
        text += " " + said("The nearest pose that does: {words}.", words=places.past_words(strokes, (unit < 0.0) | (unit > 1.0)))
    if len(near.unit):
        strokes, off = places.low + near.unit[0] * places.span, near.off[0]
        missing = ", ".join(
            said("{name} is off by {amount}", name=name, amount=show(abs(float(miss)), target.shown_in(places.plan), 4))
            for name, miss, target, size in zip(places.bound, off, places.targets, places.sizes, strict=True)
            if abs(miss) > MET * size
        )
        text += " " + said("The nearest within them is {strokes}, where {missing}.", strokes=places.stroke_words(strokes), missing=missing)
    return text


@immutable
class BranchSearch:
    """A search of solutions in a box of unit coordinates, from -out to 1 + out."""

    places: Places
    wanted: FloatArray
    out: FloatArray | float = 0.0

    @cached_property
    def axes(self) -> list[FloatArray]:
        """The values of each unit coordinate on the grid."""
        k = len(self.places.free)
        outs = np.broadcast_to(self.out, (k,))
        return grid_axes(outs, np.floor(self.places.looked_at(outs, SIDE.get(k, 5), A_TURN.get(k, 6))))

    @cached_property
    def grid(self) -> FloatArray:
        """The places of the grid, shape (n, k)."""
        return np.stack([each.ravel() for each in np.meshgrid(*self.axes, indexing="ij")], axis=1)

    @cached_property
    def misses_seen(self) -> FloatArray:
        """By how much the targets are missed on the grid, shape (t, *counts)."""
        return self.places.off(self.places.target_values(self.grid), self.wanted).T.reshape(-1, *map(len, self.axes))

    @cached_property
    def changes(self) -> FloatArray:
        """By how much each target changes over the grid [SI], shape (t,)."""
        known = [each[np.isfinite(each)] for each in self.misses_seen]
        return np.array([max(float(np.ptp(each)), 1e-300) if each.size else 1.0 for each in known])

    # in coordinates of the box, 0 to 1

    def _to_unit(self, box: FloatArray) -> FloatArray:
        return np.asarray(box * (1.0 + 2.0 * self.out) - self.out)

    def descend(self, unit: FloatArray, steps: int, scale: FloatArray) -> FoundPlaces:
        """Return where misses over a scale (t,) are least near each start (n, k)."""
        places, sides = self.places, 1.0 + 2.0 * self.out

        def misses(box: FloatArray, _: Index) -> FloatArray:
            return places.off(places.target_values(self._to_unit(box)), self.wanted) / scale

        def slopes(box: FloatArray, _: Index) -> FloatArray:
            return np.asarray(places.slopes(self._to_unit(box)) * sides / scale[:, None])

        enough = ROUNDING * float(np.min(places.sizes / scale))
        box, off = descended(misses, slopes, (unit + self.out) / sides, steps, enough=enough, begin=DAMPING)
        return FoundPlaces(self._to_unit(box), off * scale)

    # -- where it begins ---------------------------------------------------------------------------------

    def starts(self) -> FloatArray:
        """Return where to start, unit coordinates (n, k): in the cells where every target may be met, the nearest first."""
        k = len(self.axes)
        cells = tuple(len(axis) - 1 for axis in self.axes)
        low, high, bend = extremes_of_cells(self.misses_seen)
        wide, whole = high - low, corners_all(np.asarray(np.isfinite(self.misses_seen).all(axis=0)))
        room = np.where(whole, 0.1, 1.0) * wide + 0.5 * bend
        angles = self.places.angles.reshape(-1, *[1] * k)
        with np.errstate(invalid="ignore", divide="ignore"):
            may_be = ((low <= room) & (high >= -room) & ((wide < 0.5 * TURN) | ~angles)).all(axis=0)
            score = (np.abs(0.5 * (low + high)) / (0.5 * wide + room)).max(axis=0)
        place = np.flatnonzero(may_be)
        place = place[np.argsort(score.ravel()[place], kind="stable")][:STARTS]
        index = np.stack(np.unravel_index(place, cells), axis=1)
        starts = np.stack([0.5 * (axis[at] + axis[at + 1]) for axis, at in zip(self.axes, index.T, strict=True)], axis=1)
        whole = whole.ravel()[place]
        if not whole.all():  # at the border of what is assembled from the best corner
            size = np.max(np.abs(self.misses_seen) / self.places.sizes.reshape(-1, *[1] * k), axis=0)
            size = np.where(np.isfinite(size), size, np.inf)
            for row in np.flatnonzero(~whole):
                corners = [tuple(index[row] + step) for step in product((0, 1), repeat=k)]
                best = min(corners, key=lambda corner: size[corner])
                starts[row] = [axis[at] for axis, at in zip(self.axes, best, strict=True)]
        return starts

    def border_starts(self) -> FloatArray:
        """Return starts next to unassembled places, unit coordinates (n, k), the nearest first: where lines of the grid end.

        There values change as roots do, and steps go well from the border inwards, not towards it.
        """
        known, places = np.asarray(np.isfinite(self.misses_seen).all(axis=0)), self.places
        inside, outside = [np.empty((0, known.ndim))], [np.empty((0, known.ndim))]
        for axis in range(known.ndim):
            before, behind = (along(axis, known.ndim, part) for part in (slice(None, -1), slice(1, None)))
            low = np.argwhere(known[before] != known[behind])
            high = low + (np.arange(known.ndim) == axis)
            low, high = (np.stack([line[at] for line, at in zip(self.axes, each.T, strict=True)], axis=1) for each in (low, high))
            ends_above = known[before][known[before] != known[behind]][:, None]
            inside.append(np.where(ends_above, low, high))
            outside.append(np.where(ends_above, high, low))
        first, last = np.concatenate(inside), np.concatenate(outside)
        if not len(first):
            return first

        def holds(share: FloatArray) -> Mask:
            at = first[:, None] + share[..., None] * (last - first)[:, None]
            return all_known(places.target_values(at.reshape(-1, at.shape[-1]))).reshape(share.shape)

        share, _ = last_holding(holds, np.zeros(len(first)), np.ones(len(first)), NEXT_TO, PARTS)
        starts = first + share[:, None] * (last - first)
        off = (np.abs(places.off(places.target_values(starts), self.wanted)) / self.changes).max(axis=1)
        order = np.argsort(off, kind="stable")[:BORDER_STARTS]
        return np.asarray(starts[order[off[order] < FAR_OFF]])

    # -- what is found -----------------------------------------------------------------------------------

    @np.errstate(all="ignore")
    def branches(self) -> FoundPlaces:
        """Return all that meets the targets, ascending; of infinitely many some."""
        places = self.places
        scale = self.changes
        starts = np.concatenate([self.starts(), self.border_starts()])
        none = FoundPlaces(np.empty((0, len(self.axes))), np.empty((0, len(scale))))
        if not len(starts):
            return none
        found = self.descend(starts, STEPS, scale)
        met = self._met(found)
        near = found.unit[~met & (np.abs(found.off) < CLOSE * scale).all(axis=1)]
        again = none
        if len(near):
            _, first = np.unique(np.round(near, 3), axis=0, return_index=True)
            again = self.descend(near[first], MORE_STEPS, scale)
            again = again.select(self._met(again))
        found = self._joined(found.select(met), again)
        found = self._joined(found, self._beside(found, scale))
        return found.select(places.is_assembled(found.unit)) if len(found.unit) else none

    def _met(self, found: FoundPlaces) -> Mask:
        """Return which meet all targets."""
        return np.asarray((np.abs(found.off) <= MET * self.places.sizes).all(axis=1))

    def _beside(self, found: FoundPlaces, scale: FloatArray) -> FoundPlaces:
        """Return the twins of branches that have another one close by, where the slopes lose a rank between them.

        It is as far beyond the place where the least singular value would be zero, by how it changes along its own direction.
        """
        if not len(found.unit) or len(found.unit) >= MOST:
            return found.select(slice(0))
        slopes = self.places.slopes(found.unit) / scale[:, None]
        known = all_known(slopes)
        left, sizes, right = np.linalg.svd(np.where(known[:, None, None], slopes, 0.0))
        way, cell = right[:, -1], np.array([axis[1] - axis[0] for axis in self.axes])
        aside = self.places.slopes(found.unit + BESIDE * way * cell) / scale[:, None]
        twin = -2.0 * BESIDE * sizes[:, -1] / np.einsum("nt,ntk,nk->n", left[:, :, -1], aside - slopes, way)
        close = known & (np.abs(twin) < CELLS)
        if not close.any():
            return found.select(slice(0))
        starts = found.unit[close] + (twin[:, None] * way * cell)[close]
        starts = np.clip(starts, self._to_unit(np.zeros(len(cell))), self._to_unit(np.ones(len(cell))))
        again = self.descend(starts, STEPS, scale)
        return again.select(self._met(again))

    def _joined(self, one: FoundPlaces, other: FoundPlaces) -> FoundPlaces:
        """Return the places of two lots, each once, ascending by the first coordinate, then by the next ones."""
        unit, off = np.concatenate([one.unit, other.unit]), np.concatenate([one.off, other.off])
        order = np.argsort(np.abs(off / self.places.sizes).max(axis=1), kind="stable")
        kept = without_repeats(order, lambda known, each: self._is_same(unit[known], unit[each]), MOST)
        kept.sort(key=lambda each: tuple(np.round(unit[each], 9)))
        return FoundPlaces(unit[kept], off[kept])

    def _is_same(self, one: FloatArray, other: FloatArray) -> bool:
        """Return whether two places are one: to rounding, a whole turn apart, or one solution that is met twice."""
        apart = one - other
        whole = self.places.turning & (self.places.span <= TURN * (1.0 + 1e-9))
        turn = TURN / self.places.span
        apart = np.where(whole, apart - turn * np.round(apart / turn), apart)
        middle = (other + 0.5 * apart)[None]
        return is_one_solution(
            apart, SAME, lambda: bool(self._met(FoundPlaces(middle, self.places.off(self.places.target_values(middle), self.wanted)))[0])
        )

    @np.errstate(all="ignore")
    def nearest(self) -> FoundPlaces:
        """Return the place with the least difference, in units of the targets' tolerances; none where nothing can be assembled.

        It starts where least is missed on the grid: from the best, and those that no neighbour improves on.
        """
        size = np.sum((self.misses_seen / self.places.tolerances.reshape(-1, *[1] * len(self.axes))) ** 2, axis=0)
        size = np.where(np.isfinite(size), size, np.inf)
        place = np.flatnonzero((size <= -widened(-size)) & np.isfinite(size))
        starts = self.grid[place[np.argsort(size.ravel()[place], kind="stable")][:16]]
        found = self.descend(starts, MORE_STEPS, self.places.tolerances)
        found = found.select(self.places.is_assembled(found.unit)) if len(starts) else found
        size = np.sum((found.off / self.places.tolerances) ** 2, axis=1)
        return found.select(np.argsort(size, kind="stable")[:1])


class Target:
    """A value that a quantity is to have at a pose: `Target(y("F"), 0.45, S=0.05)`, `Target("tilt", 0.0, unit="deg", S=0.05)`.

    Parameters
    ----------
    quantity : str, quantity or request
        An output's name, a quantity or a request.
    value : float or array
        The value [SI]; in `follow` also an array (places,).
    within : float, optional
        How far off it may be [SI], by default 1 mm, 0.1 deg, or a thousandth. Where nothing gives all targets, misses are weighed by it.
    unit : str, optional
        The unit in which sentences show it.
    **strokes : float
        The pose, strokes by name [m or rad]. Where strokes are looked for, in `strokes_for` and `follow`, there are none, and angles count
        modulo a turn.

    Raises
    ------
    DefinitionError
        The value is not finite, or `within` is not above zero.
    """

    def __init__(
        self, quantity: RequestLike, value: float | FloatArray, *, within: float | None = None, unit: str = "", **strokes: float
    ) -> None:
        what = f"Target({quantity_cited(quantity)}, {cited(value)})"
        if within is not None:
            require_number(f"{what}: within", within, "how far off it may be [SI], a number above zero, is expected", above=0.0, kind=None)
        ensure(all(map(is_one, strokes.values())), f"{what}: one number is expected for each stroke, in SI.")
        known: float | FloatArray
        if is_one(value):
            known = float(value)
        else:  # the values of a path, shape (places,)
            known = read_only(numbers_in(value))
            if known.ndim != 1 or not known.size or not np.isfinite(known).all():
                said = "one number is expected for the value, in SI. Along a path it is an array, a number a place"
                raise DefinitionError(f"{what}: {said}.")
        pose = FrozenDict({name: amount_or_float(each) for name, each in strokes.items()})
        parts = {"quantity": quantity, "value": known, "within": within, "strokes": pose}
        vars(self).update(parts, unit=unit_or_none(unit, where="Target(unit=...)"), given=value)

    quantity: RequestLike
    value: float | FloatArray
    within: float | None
    unit: str
    strokes: Mapping[str, float]
    given: object
    """Its value as it was given, with the unit where that was said."""

    def __setattr__(self, name: str, value: object) -> NoReturn:
        raise DefinitionError(f"Target.{name} = ...: it does not change; make a new one, Target(...).")

    def __repr__(self) -> str:
        value = cited(self.value.tolist()) if isinstance(self.value, np.ndarray) else repr(self.value)
        return f"Target({', '.join([quantity_cited(self.quantity), value, *(f'{k}={v!r}' for k, v in self.strokes.items())])})"

    @property
    def is_path(self) -> bool:
        """Whether its value is an array, one value a place along a path."""
        return isinstance(self.value, np.ndarray)

    def check(self, plan: Plan) -> None:
        """Raise DefinitionError for a value, `within` or a stroke in a unit of another kind than its quantity.

        Parameters
        ----------
        plan : Plan
            The plan of the machine's class.

        Raises
        ------
        DefinitionError
            A unit of another kind.
        """
        kind = measure_of(plan, self.quantity)
        for what, value in (("", self.given), (": within", self.within)):
            if kind:
                require_measure(value, kind, f"{plan.title}: Target({quantity_cited(self.quantity)}, ...){what}")
        for name, value in self.strokes.items():
            require_kind(plan, name, value, f"{plan.title}: Target({quantity_cited(self.quantity)}, ...): {name}")

    def miss(self, plan: Plan, value: float) -> float:
        """Return its tolerance [SI]: `within`, or the default of its kind.

        Parameters
        ----------
        plan : Plan
            The plan of the machine's class.
        value : float
            The value wanted [SI].

        Returns
        -------
        float
            The tolerance [SI].
        """
        kind = measure_of(plan, self.quantity)
        return self.within or {"length": 1.0 * mm, "angle": 0.1 * deg}.get(kind, 1e-3 * abs(value) or 1e-3)

    def shown_in(self, plan: Plan) -> str:
        """Return the unit that it is shown in.

        Parameters
        ----------
        plan : Plan
            The plan of the machine's class.

        Returns
        -------
        str
            The unit.
        """
        return self.unit or display_unit(measure_of(plan, self.quantity), "mm")


def quantity_cited(quantity: object) -> str:
    """Return a target's quantity as it is written in a message: `'tilt'`, `x(M)`."""
    return str(quantity) if isinstance(quantity, (Quantity, Request)) else cited(quantity)


def targets_given(given: object, title: str, example: str) -> Sequence[Target]:
    """Return a list of targets, one at least; DefinitionError for anything else."""
    what, expected = f"{title}: targets", f"a list of targets is expected, {example}"
    found: Sequence[Target] = require_type(what, given, (list, tuple), expected, Target)
    require(found, what, given, expected)
    return found


def is_one(value: object) -> bool:
    """Return whether a value is one finite number."""
    return is_number(value.item() if isinstance(value, np.ndarray) and value.ndim == 0 and not np.ma.is_masked(value) else value)


# What `strokes_for` returns: the strokes of all poses that give some targets, or of the nearest one, and a sentence.

TOLD = 4
"""Branches that are told in a sentence."""


class StrokeRows(np.ndarray[Any, np.dtype[np.float64]]):
    """Strokes [m or rad], one row a branch, one column a stroke: `rows[0]`, `rows["boom"]`, `rows[0]["boom"]`, `machine.at(**rows[0])`.

    The columns stand in the order of the machine's strokes; `keys()` are their names.
    """

    names: tuple[str, ...]

    def __new__(cls, rows: object, names: Iterable[str]) -> StrokeRows:
        found = np.array(rows, float).view(cls)
        found.names = tuple(names)
        found.flags.writeable = False
        return found

    def __array_finalize__(self, other: object) -> None:
        self.names = getattr(other, "names", ())

    def __getitem__(self, key: Any) -> Any:
        if isinstance(key, str):
            place = self.names.index(known_name("Stroke", key, self.names))
            return np.asarray(self)[:, place] if self.ndim > 1 else np.asarray(self)[place]
        found = np.asarray(self)[key]
        if self.ndim < 2 or not isinstance(key, (int, np.integer, slice)):
            return found
        rows = found.view(type(self))
        rows.names = self.names
        return rows

    def keys(self) -> tuple[str, ...]:
        """Return the names of the strokes."""
        return self.names

    def items(self) -> ItemsView[str, FloatArray]:
        """Return the strokes by name, arrays (branches,), of one row numbers."""
        return {name: self[name] for name in self.names}.items()

    def values(self) -> ValuesView[FloatArray]:
        """Return the same without the names."""
        return dict(self.items()).values()

    def __contains__(self, value: object) -> bool:
        return value in self.names if isinstance(value, str) else value in np.asarray(self)

    def __reduce__(self) -> tuple[Any, ...]:
        return StrokeRows, (np.array(self), self.names)


@immutable
class Positions:
    """The strokes that give some targets: all branches within the ends of the strokes, ascending by the first stroke.

    Attributes
    ----------
    strokes : mapping of str to array (branches,)
        One value for each branch [m or rad], with the strokes that are held.
    condition : array (branches,)
        The condition number of the targets by the strokes in their natural sizes, infinite at a dead point.
    met : bool
        Whether there is a branch.
    misses : array (branches, targets)
        By how much each target is exceeded [SI]. Without a branch the one row is that of `nearest`.
    nearest : mapping of str to array, optional
        Without a branch, the pose within the ends at which least is missing; None if nothing can be assembled.
    sentence : str
        How many branches there are, or which stroke would be past which end, by how much.
    """

    strokes: StrokeRows
    condition: FloatArray
    met: bool
    misses: FloatArray
    nearest: StrokeRows | None
    sentence: str

    def __len__(self) -> int:
        return len(self.strokes)

    def __str__(self) -> str:
        return self.sentence


def positions_for(plan: Plan, designs: Mapping[str, object], targets: object, hold: object) -> Positions:
    """Return the strokes that give some targets; see `strokes_for`."""
    places = Places.for_targets(plan, designs, targets, hold, where="strokes_for")
    for each in places.targets:
        ensure(not each.is_path, f"{plan.title}: strokes_for: {each!r}: one number is expected; a path is followed, machine.follow(...).")
    wanted = np.array([float(each.value) for each in places.targets])
    search = BranchSearch(places, wanted)
    found = search.branches()
    condition, rows = places.condition(found.unit), rows_of_branches(places, found)
    if len(found.unit):
        looked = SCATTERED[:, : len(places.free)]
        known = all_known(places.slopes(looked)) if len(places.free) > 1 and (condition > LOST).all() else np.zeros(len(looked), bool)
        if known.any() and (places.condition(looked[known]) > LOST).all():  # infinitely many strokes give the targets, or none do
            names = said(" and ").join(map(str, places.bound))
            what = f"{names} hang together at every pose, so that they do not tell {' and '.join(places.free)} apart"
            raise DefinitionError(f"{plan.title}: {what}; hold a stroke for one of them, or aim at something else.")
        return Positions(rows, condition, True, found.off, None, met_words(places, found, condition, wanted))
    near = search.nearest()
    words = unmet_words(places, wanted, near)
    nearest_row = rows_of_branches(places, near)[0] if len(near.unit) else None
    return Positions(rows, condition, False, near.off, nearest_row, words[0].upper() + words[1:])


def rows_of_branches(places: Places, found: FoundPlaces) -> StrokeRows:
    """Return all strokes of some branches, those that are held included."""
    return StrokeRows(np.stack([*places.strokes_at(found.unit).values()], axis=1), places.plan.strokes)


def met_words(places: Places, found: FoundPlaces, condition: FloatArray, wanted: FloatArray) -> str:
    """Return the strokes that meet the targets, in words; warn of those next to a dead point."""
    strokes = [places.stroke_words(each) for each in places.low + found.unit * places.span]
    parts = {"wanted": places.shown(wanted), "strokes": said(" or with ").join(strokes[:TOLD])}
    text = said("{wanted}: with {strokes}.", **parts)
    if len(strokes) > TOLD:
        text = said("{wanted}: on {count} branches, with {strokes} and so on.", count=len(strokes), **parts)
    worst = int(np.argmax(condition))
    if condition[worst] > WARN:
        size = "" if np.isfinite(condition[worst]) else said("infinite")
        near = said(
            "At {strokes} it is at the border of what the strokes reach, next to a dead point of the drive (condition {condition}): "
            "the strokes are known only roughly there.",
            strokes=strokes[worst], condition=size or f"{condition[worst]:.1e}",
        )  # fmt: skip
        text += f" {near}"
        warn(SingularWarning(f"{places.plan.title}: strokes_for: {near}", estimate=float(np.finfo(float).eps * condition[worst])))
    return text
