"""Monte Carlo of tolerances: the band of a quantity at every stroke, its worst case, and the share of machines that are good."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial, reduce
from typing import Any, TypeVar

import numpy as np

from ..errors import DefinitionError, cited, ensure, is_listed, known_name, one_word, require, unwarned
from ..frozen import FrozenDict, immutable
from ..loads import PLAIN_CASE, Acting
from ..mechanism import Mechanism
from ..motion import Judge, Request
from ..motion.measures import At, Condition, Constraint, Integral, Leaf, Measure, Worst, conditions_of, in_situation, measure_of
from ..motion.requests import is_of_force, may_be_unlimited
from ..program import RunOptions
from ..quantities import is_number
from ..units import display_unit
from ..vectors import FloatArray, Index, Mask, Numbers
from .measured import Measured, StudyPoses, check_no_worst, extreme_of, measured_title, nothing_limits, number_bound
from .optimum import constraint_words
from .space import check_in_count
from .tolerances import Tolerance, ToleranceLike, sampled_designs, tolerance_words, tolerances_of, values_shifted

Task = TypeVar("Task")
Found = TypeVar("Found")

DESIGNS = 1 << 14
POSES = 21
BLOCK = 1 << 17
"""Poses that are worked out at a time: their results fit a processor's cache."""
MEMORY = 1 << 28
"""Bytes of results that are kept at a time: of so many strokes as fit all designs are looked at together."""


@immutable
class Band:
    """A quantity over the strokes, of machines with tolerances; arrays have the shape (...) of the strokes.

    Attributes
    ----------
    quantity, unit : str
        Its name, and the unit in which it is shown.
    nominal : array
        That of the machine as it is set [SI].
    mean, sigma : array
        Mean and standard deviation over the designs that have a value there [SI].
    percentiles : mapping of float to array
        By their percentage [SI].
    share : array
        The share of all designs that have a value there.
    low, high : array
        The worst case with every deviation within its limits [SI].
    """

    quantity: str
    unit: str
    nominal: FloatArray
    mean: FloatArray
    sigma: FloatArray
    percentiles: Mapping[float, FloatArray]
    share: FloatArray
    low: FloatArray
    high: FloatArray


@immutable
class MonteCarlo:
    """Machines with tolerances: a `Band` of each quantity, and the share of machines that are good.

    `yield_rate` is the share of the designs that can be assembled and keep every condition.

    Attributes
    ----------
    machine : Mechanism
        The machine as it is set.
    tolerances : mapping of str to Tolerance
        By dimension.
    strokes : mapping of str to array
        The poses looked at [m or rad].
    of : mapping of str to Measured
        What is measured, by name.
    bands : mapping of str to Band
        The bands, by name.
    conditions : tuple of Constraint
        What a good machine keeps.
    designs : mapping of str to array (count,)
        The dimensions of the designs [SI].
    good : array of bool (count,)
        The good designs.
    assembled : float
        The share of the designs that have a value of every quantity at every stroke.
    kept : mapping of str to float
        The share of the designs that keep each condition, by its words.
    at : str
        The poses in words.
    """

    machine: Mechanism
    tolerances: Mapping[str, Tolerance]
    strokes: Mapping[str, FloatArray]
    of: Mapping[str, Measured]
    bands: Mapping[str, Band]
    conditions: tuple[Constraint, ...]
    designs: Mapping[str, FloatArray]
    good: Mask
    assembled: float
    kept: Mapping[str, float]
    at: str

    @property
    def count(self) -> int:
        """The number of designs."""
        return self.good.size

    @property
    def yield_rate(self) -> float:
        """The share of the designs that are good."""
        return float(np.mean(self.good))

    def __getitem__(self, quantity: Measured) -> Band:
        """Return the band of a quantity, by its words or as it was asked for."""
        name = quantity if isinstance(quantity, str) else measured_title(self.machine.plan, quantity)
        known_name("Quantity", name, self.bands, where=f"the study of {self.machine.plan.title}")
        return self.bands[name]

    def design(self, place: int) -> Mechanism:
        """Return the machine of one of the designs, by its number.

        Parameters
        ----------
        place : int
            The number of the design.

        Returns
        -------
        Mechanism
            The machine.
        """
        check_in_count(self.machine.plan.title, "design", place, self.count)
        return self.machine.replaced(**{name: float(value[place]) for name, value in self.designs.items()})

    def __str__(self) -> str:
        plan = self.machine.plan
        tolerances = ", ".join(tolerance_words(plan, name, each) for name, each in self.tolerances.items())
        lines = [f"{plan.title}, {self.count} machines with {tolerances}; {self.at}."]
        alone = [each for each in self.of.values() if not isinstance(each, Measure)]
        if any(map(is_of_force, alone + [leaf.quantity for leaf in leaves_measured(self.of, ()) if not leaf.sense])):
            lines.append("Forces at a pose for which no case or direction is asked are at rest, under the machine's own loads.")
        if self.assembled < 1.0:
            lines.append(f"{share_words(1.0 - self.assembled)} cannot be assembled everywhere and count as lost.")
        shown = {str(each): constraint_words(plan, each) for each in self.conditions}
        lines += [f"{share_words(share)} keep {shown[words]}." for words, share in self.kept.items()]
        return "\n".join([*lines, f"{share_words(self.yield_rate)} are good."] if self.kept else lines)


def share_words(share: float) -> str:
    """Return a share in per cent; one of less than a tenth of a per cent, or nearly all, with its digits."""
    return f"{100.0 * share:.4g} %" if 0.0 < share < 1e-3 or 0.999 < share < 1.0 else f"{100.0 * share:.1f} %"


def monte_carlo(
    machine: Mechanism,
    of: Sequence[Measured] | Mapping[str, Measured],
    tolerances: Mapping[str, ToleranceLike],
    *,
    subject_to: Sequence[Condition] = (),
    count: int = DESIGNS,
    percentiles: Sequence[float] = (5.0, 50.0, 95.0),
    method: str = "sobol",
    seed: int = 0,
    backend: str = "numpy",
    threads: int = 1,
    **strokes: object,
) -> MonteCarlo:
    """Return the bands of quantities over machines with tolerances, and how many of them keep conditions.

    `monte_carlo(hitch, ["tilt", drive_force()], {"OB": 0.1 * mm, "M": 0.5 * mm}, subject_to=[most("tilt") <= 18 * deg])`. A design that
    cannot be assembled at one of the strokes is lost, and no good machine; percentiles are of the others there. The worst case begins at
    the corner of the tolerances where each dimension's own effect is the worst. Neighbouring corners and middles are evaluated until none
    is worse. Beside the results it needs the dimensions of all designs, and 256 MB.

    Parameters
    ----------
    machine : Mechanism
        The machine as it is set, one design.
    of : sequence or mapping of str
        Quantities, in a list or by names of your own: outputs, requests, measures, or functions of a motion of many designs, which give a
        number for each pose or for each design.
    tolerances : mapping of str to Tolerance or float
        By dimension [SI]; the dimensions are independent of each other. A number is the limit of a normal law at three sigmas.
    subject_to : sequence of conditions, optional
        What a good machine keeps. Measures and conditions look at the strokes alone; an integral looks between them, too. Conditions and
        `most` and `least` count the load cases and directions of motion that `machine.answers` counts. Else forces are at rest under
        the machine's own loads, unless a request says `case=` or `direction=`.
    count : int, optional
        The number of designs, 16384 by default.
    percentiles : sequence of float, optional
        Which percentiles, 5, 50 and 95 by default.
    method : {"sobol", "latin", "random"}, optional
        How designs are spread.
    seed : int, optional
        The seed, 0 by default. The results are the same for the same seed, whatever the number of threads.
    backend : {"numpy", "numba"}, optional
        Which back end works it out.
    threads : int, optional
        How many threads.
    **strokes : float or array
        As in `machine.at`, by default 21 over a single stroke.

    Returns
    -------
    MonteCarlo
        The bands, and the good machines.
    """
    poses, plan = StudyPoses.of(machine, strokes, POSES), machine.plan
    named = tolerances_of(plan, tolerances)
    if isinstance(of, Mapping) and of and all(isinstance(name, str) for name in of):
        titles, asked = [measured_title(plan, each) for each in of.values()], dict(of)
    elif is_listed(of) and of:
        titles = [measured_title(plan, each) for each in of]
        asked = dict(zip(titles, of, strict=True))
    else:
        raise DefinitionError(f'{plan.title}: {cited(of)}: a list of quantities is expected, such as ["tilt"], or a dictionary by name.')
    both = f"{plan.title}: {', '.join(titles)}: two of them go by one name"
    ensure(len(asked) == len(titles), f'{both}; give names of your own, {{"full": ..., "empty": ...}}.')
    conditions = limits_listed(machine, subject_to)
    fits = is_listed(percentiles) and all(is_number(each) and 0.0 <= each <= 100.0 for each in percentiles)
    require(fits, "percentiles", percentiles, "percentages from 0 to 100 are expected, such as (5, 50, 95)")
    order = tuple(sorted({float(each) for each in percentiles}))
    way = RunOptions(one_word("backend", backend, ("numpy", "numba")), threads)
    designs = sampled_designs(machine, named, count, method, seed)
    counted = partial(situations, machine.judge(poses.base), machine.judge().cases)
    judged = {title: worst_of(each, counted) for title, each in asked.items()}
    split = [(condition, each) for condition in conditions for each in in_situations(condition, counted)]
    with unwarned(), np.errstate(all="ignore"):
        run = MonteCarloRun(poses, machine.replaced(**designs), count, way, order)
        run.measure(judged, [each for _, each in split])
        bands = {}
        for title, quantity in judged.items():
            share, mean, sigma, *cuts = map(poses.shaped, run.moments[title])
            own = poses.shaped(poses.values(machine, quantity, RunOptions())[0])
            low, high = map(poses.shaped, worst_case(machine, poses, quantity, named))
            unit = display_unit(measure_of(plan, asked[title]), "mm")
            bands[title] = Band(title, unit, own, mean, sigma, FrozenDict(zip(order, cuts, strict=True)), share, low, high)
    each_kept = {id(condition): np.ones(count, bool) for condition in conditions}
    for (condition, _), keeps in zip(split, run.kept, strict=True):
        each_kept[id(condition)] &= keeps
    kept = {str(each): float(np.mean(each_kept[id(each)])) for each in conditions}
    good = ~run.lost & np.all([np.ones(count, bool), *run.kept], axis=0)
    assembled = float(np.mean(~run.lost))
    return MonteCarlo(
        machine, FrozenDict(named), FrozenDict(poses.base.strokes), FrozenDict(asked), FrozenDict(bands), conditions, FrozenDict(designs),
        good, assembled, FrozenDict(kept), poses.words(),
    )  # fmt: skip


def limits_listed(machine: Mechanism, given: object) -> tuple[Constraint, ...]:
    """Return conditions as constraints; DefinitionError for anything else, and for an equation, which no machine keeps."""
    found = tuple(conditions_of(given, machine))
    for each in found:
        ensure(each.symbol != "==", f"{machine.plan.title}: {each}: no machine keeps an equation to the last digit; write two limits.")
    return found


@dataclass(frozen=True, eq=False, repr=False)
class WorstOf(Measure):
    """The worst of one measure in several situations; where nothing limits it in one, that of the others."""

    each: tuple[Leaf, ...]

    @property
    def leaves(self) -> tuple[Leaf, ...]:
        return self.each

    def from_leaves(self, value: Callable[[Leaf], Any]) -> Any:
        return reduce(np.fmin if self.each[0].sense < 0.0 else np.fmax, map(value, self.each))


def situations(judge: Judge, cases: Sequence[str], leaves: Sequence[Leaf]) -> list[Acting]:
    """Return the situations in which a judge looks at requests, each once, in the load cases that occur: as `machine.answers` counts."""
    requests = [leaf.quantity for leaf in leaves if isinstance(leaf.quantity, Request)]
    found = dict.fromkeys(acting for request in requests for acting in judge.actings(request))
    return [each for each in found if (each.case or PLAIN_CASE) in cases]


def worst_of(quantity: Measured, counted: Callable[[Sequence[Leaf]], list[Acting]]) -> Measured:
    """Return a greatest or least value over all situations that count; anything else as it is."""
    if not (isinstance(quantity, Leaf) and quantity.sense):
        return quantity
    found = [in_situation(quantity, acting) for acting in counted([quantity])]
    return WorstOf(tuple(leaf for each in found for leaf in each.leaves)) if found else quantity


def in_situations(condition: Constraint, counted: Callable[[Sequence[Leaf]], list[Acting]]) -> list[Constraint]:
    """Return a condition in every situation that counts: what is asked at rest alone goes with all that moves."""
    known = counted(condition.margin.leaves)
    among = [each for each in known if each.direction is not None] or known or [Acting()]
    return [in_situation(condition, each) for each in among]


def leaves_measured(asked: Mapping[str, Measured], conditions: Sequence[Constraint]) -> list[Leaf]:
    """Return the leaves of all measures and conditions that are asked for, each once; DefinitionError for one over another stroke."""
    measures = [each for each in asked.values() if isinstance(each, Measure)] + [each.margin for each in conditions]
    found = list(dict.fromkeys(leaf for measure in measures for leaf in measure.leaves))
    for leaf in found:
        check_no_worst(leaf)
    return found


# The designs, block by block, and what is kept of them: of the results themselves nothing.


class MonteCarloRun:
    """The designs of a Monte Carlo: `moments` of each quantity, `lost` and `kept` designs."""

    def __init__(self, poses: StudyPoses, designs: Mechanism, count: int, way: RunOptions, order: Sequence[float]) -> None:
        self.poses, self.designs, self.count, self.order = poses, designs, count, order
        self.threads, self.options = way.threads, RunOptions(way.backend)
        self.moments: dict[str, FloatArray] = {}
        self.lost = np.zeros(count, bool)
        self.kept: list[Mask] = []
        self._leaves: dict[Leaf, Numbers] = {}
        self._asked: dict[Hashable, Measured | Worst] = {}
        self._unlimited: dict[Leaf, Index] = {}
        """At how many poses nothing limits a leaf's quantity, of each design."""

    def measure(self, asked: Mapping[str, Measured], conditions: Sequence[Constraint]) -> None:
        """Measure quantities and conditions of all designs."""
        leaves = leaves_measured(asked, conditions)
        self._leaves = {leaf: -leaf.sense * np.inf for leaf in leaves if leaf.sense}
        every = [each for each in asked.values() if not isinstance(each, Measure)] + [leaf.quantity for leaf in self._leaves]
        quantities = self._asked = {self._key(each): each for each in every}
        bound = [key for key, each in quantities.items() if number_bound(self.poses.base.plan, each) is not None]
        found: dict[Hashable, list[FloatArray]] = {key: [] for key in quantities}
        if bound:
            width = min(max(1, MEMORY // (8 * len(bound) * self.count)), self.poses.pose_count)
            for first in range(0, self.poses.pose_count, width):
                part = slice(first, min(first + width, self.poses.pose_count))
                self._take(bound, self._values_traced([quantities[key] for key in bound], part), first, found)
        for key, quantity in quantities.items():
            if key not in bound:
                parts = [self.poses.of_function(self._block(block), quantity).T for block in blocks(self.count, self.poses.pose_count)]
                self._take([key], np.concatenate(parts, axis=1)[None], 0, found)
        for leaf in leaves:
            if isinstance(leaf, (At, Integral)):  # at its own pose, or an integral over the row of strokes
                poses = self.poses.integral_poses(leaf)[0] if isinstance(leaf, Integral) else self.poses.at(leaf)
                parts = [self.poses.of_leaf(self._block(block), leaf, self.options) for block in blocks(self.count, poses.pose_count)]
                column = np.concatenate(parts)
                free = np.zeros(self.count, bool) if isinstance(leaf, Integral) else self._free(poses, leaf.quantity, column[None])[0]
                self._leaves[leaf], self._unlimited[leaf] = column, free.astype(int)
                self.lost |= np.isnan(column) & ~free
        for leaf, places in self._unlimited.items():
            self._leaves[leaf] = np.where(places == (self.poses.pose_count if leaf.sense else 1), np.nan, self._leaves[leaf])
        for condition in conditions:  # one says nothing of designs at which a quantity of it is limited nowhere
            kept = np.asarray(condition.margin.from_leaves(self._leaves.__getitem__) >= 0.0) & np.ones(self.count, bool)
            for leaf in condition.margin.leaves:
                if leaf in self._unlimited:
                    kept |= np.isnan(self._leaves[leaf]) & (self._unlimited[leaf] > 0)
            self.kept.append(kept)
        for title, each in asked.items():
            if isinstance(each, Measure):
                column = np.array(np.broadcast_to(each.from_leaves(self._leaves.__getitem__), (self.count,)), float)
                self.moments[title] = np.array([self._moments(column)]).T
            else:
                self.moments[title] = np.concatenate(found[self._key(each)], axis=1)

    def _key(self, quantity: Measured | Worst) -> Hashable:
        """Return a hashable key of a quantity."""
        found = number_bound(self.poses.base.plan, quantity)
        return id(quantity) if found is None else found.key

    def _values_traced(self, traced: Sequence[Measured | Worst], part: slice) -> FloatArray:
        """Return quantities at some of the poses, shape (quantities, poses, designs)."""
        place = np.empty((len(traced), part.stop - part.start, self.count))

        def fill(block: slice) -> None:
            with np.errstate(all="ignore"):
                for row, found in zip(place, self.poses.of_requests(self._block(block), traced, self.options, part), strict=True):
                    row[:, block] = found.T

        self._on_threads(fill, blocks(self.count, part.stop - part.start))
        return place

    def _free(self, poses: StudyPoses, quantity: Measured | Worst, values: FloatArray, part: slice = slice(None)) -> Mask:
        """Return at which of some poses nothing limits a quantity, so that it has no value there, shape (poses, designs)."""
        found: Mask = np.isnan(values) & may_be_unlimited(quantity)
        for block in blocks(self.count, poses.pose_count) if found.any() else ():
            if found[:, block].any():
                free = nothing_limits(poses.of_all(self._block(block)), quantity)
                found[:, block] &= free.reshape(-1, poses.pose_count).T[part]
        return found

    def _block(self, block: slice) -> Mechanism:
        return self.designs._part(block.start, block.stop)

    def _take(self, keys: Sequence[Hashable], store: FloatArray, first: int, found: Mapping[Hashable, list[FloatArray]]) -> None:
        """Take in the results of some quantities from a pose on, shape (quantities, poses, designs), which are used up."""
        for key, rows in zip(keys, store, strict=True):
            free = self._free(self.poses, self._asked[key], rows, slice(first, first + len(rows)))
            self.lost |= (np.isnan(rows) & ~free).any(axis=0)
            for leaf in [each for each in self._leaves if self._key(each.quantity) == key]:
                if free.any():
                    self._unlimited[leaf] = self._unlimited.get(leaf, 0) + free.sum(axis=0)
                    rows = np.where(free, -leaf.sense * np.inf, rows)
                self._leaves[leaf] = extreme_of(leaf)(self._leaves[leaf], extreme_of(leaf).reduce(rows, axis=0))
        columns = [column for row in store for column in row]
        moments = np.array(self._on_threads(self._moments, columns)).reshape(*store.shape[:2], -1)
        for key, each in zip(keys, moments, strict=True):
            found[key].append(each.T)

    def _moments(self, column: FloatArray) -> list[float]:
        """Return the share of designs that have a value, then their mean, sigma and percentiles; the column is put in order."""
        column.sort()
        known = column[: int(np.searchsorted(column, np.nan))]  # NaN stands behind all numbers
        if not known.size:
            return [0.0] + [np.nan] * (2 + len(self.order))
        cuts = np.percentile(known, self.order).tolist()
        return [known.size / self.count, float(known.mean()), float(known.std(ddof=min(known.size - 1, 1))), *cuts]

    def _on_threads(self, work: Callable[[Task], Found], tasks: Sequence[Task]) -> list[Found]:
        """Return a function's results for each task; the first is done alone, so that kernels are made once."""
        if self.threads == 1 or len(tasks) < 2:
            return [work(task) for task in tasks]
        first = work(tasks[0])
        with ThreadPoolExecutor(self.threads) as pool:
            return [first, *pool.map(work, tasks[1:])]


def blocks(count: int, poses: int) -> list[slice]:
    """Return parts of the designs, each of so many that their poses are a block."""
    size = max(1, BLOCK // poses)
    return [slice(first, min(first + size, count)) for first in range(0, count, size)]


# The worst case: corners of the tolerances, by true evaluation.

ROUNDS = 20


def worst_case(
    machine: Mechanism, poses: StudyPoses, quantity: Measured, tolerances: Mapping[str, Tolerance]
) -> tuple[FloatArray, FloatArray]:
    """Return the least and the greatest value at every pose, shapes (n,), with every deviation at a limit or in the middle of them."""
    k = len(tolerances)
    steps = np.concatenate([-np.eye(k), np.eye(k)])

    def at(levels: FloatArray) -> FloatArray:
        values = values_shifted(machine, poses, quantity, tolerances, levels)
        return np.broadcast_to(values, (len(levels), values.shape[1]))

    alone = at(steps)
    rise = np.nan_to_num(alone[k:] - alone[:k])  # (k, n)
    levels = np.unique(np.concatenate([np.sign(rise).T, -np.sign(rise).T, np.zeros((1, k))]), axis=0)
    values = at(levels)
    for _ in range(ROUNDS):
        known = ~np.isnan(values)
        ends = {*np.argmin(np.where(known, values, np.inf), axis=0), *np.argmax(np.where(known, values, -np.inf), axis=0)}
        others = [(row, place, level) for row in ends for place in range(k) for level in (-1.0, 0.0, 1.0) if level != levels[row, place]]
        near = levels[[row for row, *_ in others]] if k else levels
        for number, (_, place, level) in enumerate(others):  # another value of one deviation
            near[number, place] = level
        near = np.unique(near, axis=0)
        found = at(near)
        better = (least_by_column(found) < least_by_column(values)) | (-least_by_column(-found) > -least_by_column(-values))
        if not better.any():
            break
        levels, values = np.concatenate([levels, near]), np.concatenate([values, found])
    return least_by_column(values), -least_by_column(-values)


def least_by_column(values: FloatArray) -> FloatArray:
    """Return the least value of each column that has one, else NaN."""
    least = np.min(np.where(np.isnan(values), np.inf, values), axis=0)
    return np.where(np.isinf(least), np.nan, least)
