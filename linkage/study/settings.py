"""The settings that give wanted values: all roots of one in a range, all of several in a box, or why there are none; and zones."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping, Sequence
from itertools import product
from types import MappingProxyType
from typing import Any, TypeAlias, overload

import numpy as np

from ..errors import DefinitionError, SingularWarning, cited, ensure, known_name, require, require_whole, unwarned
from ..frozen import FrozenDict, immutable
from ..language import said
from ..mechanism import Mechanism
from ..motion import Motion, Target, at_values, highest, last_holding, out_of_reach, places_text, stroke_display_unit, stroke_unit
from ..motion.evaluation import BulkProgram
from ..motion.grid import recalled
from ..motion.measures import least, measure_unit, words_of
from ..motion.places import is_one, targets_given
from ..motion.requests import dimensions_of, identity_of, slope
from ..numeric.box import highest_in
from ..numeric.descent import NEAR, descended, is_one_solution, without_repeats
from ..numeric.line import Curve, Index, highest_between, sign_changes
from ..plan import Mask, require_kind
from ..program import QUICKEST, FloatArray, RunOptions
from ..shown import HasSentence
from ..units import show, unit_or_none
from .measured import QuantityLike, StudyPoses, divisors_of, function_value, quantity_values, traced_number
from .poles import FAR, TINY, boundless_error
from .space import Box, check_one_design, check_vary, range_of, setting_words, unit_of, unit_points, why_not_assembled

SAMPLES = 1025
TOUCH, USUAL, POLES = 1e-9, (5.0, 95.0), 10.0
"""Of the values' span: what comes so near to the target touches it. Beside a pole values are as large as numbers go: the span is at most so
many times that of the usual ones [%]."""


@immutable
class Settings(HasSentence):
    """All values of a dimension that give a target.

    Attributes
    ----------
    name : str
        The dimension.
    values : tuple of float
        The values [SI], ascending.
    sentence : str
        What was found, or why there is none.
    """

    name: str
    values: tuple[float, ...]
    sentence: str


@overload
def settings_for(
    machine: Mechanism,
    name: str,
    quantity: QuantityLike,
    target: float = ...,
    *,
    between: tuple[float, float],
    unit: str = ...,
    **strokes: float,
) -> Settings: ...
@overload
def settings_for(
    machine: Mechanism, name: Mapping[str, object], quantity: Sequence[Target], /, *, points: int | None = ...
) -> Solutions: ...
def settings_for(
    machine: Mechanism,
    name: str | Mapping[str, Any],
    quantity: Any,
    target: float = 0.0,
    *,
    between: tuple[float, float] | None = None,
    unit: str = "",
    points: Any = None,
    **strokes: float,
) -> Settings | Solutions:
    """Return every value of dimensions in a range at which quantities have target values, of one design.

    `settings_for(hitch, "MK", "tilt", 0.0, between=(0.5, 1.3), S=0.1)`; with several targets
    `settings_for(hitch, {"MK": (0.5, 1.3), "M": [(0.22, 1.05), (0.22, 0.95)]}, [Target("tilt", 0.0, S=0.1), ...])`. Settings that cannot be
    assembled over the whole stroke are no answer. Roots of one dimension are found to rounding; two that lie closer than a thousandth of
    the range may be missed. For a path, a function or poses of a body `synthesise` is quicker, and finds their strokes too.

    Parameters
    ----------
    machine : Mechanism
        The machine, one design.
    name : str or mapping of str to object
        The dimension, or several with their ranges and choices, as in `Box.of`.
    quantity : str, quantity, request or list of Target
        The quantity, or the targets of several dimensions: at least as many as there are ranges.
    target : float, optional
        The value of the quantity [SI], 0 by default.
    between : tuple of float, optional
        The range of one dimension [SI].
    unit : str, optional
        The quantity's unit in the sentence; by default that of what it measures.
    points : int, optional
        From how many points of the box the search of several dimensions begins; it goes on from the best of at most 16,384, by exact
        derivatives.
    **strokes : float
        The pose of one quantity [m or rad].

    Returns
    -------
    Settings or Solutions
        The values of one dimension, or all settings of several that were found. Without one the nearest setting, with what is missing of
        each target.

    Raises
    ------
    DefinitionError
        There are fewer targets than ranges, or a name or a range cannot be.
    """
    if isinstance(name, Mapping):
        single = [*(["between"] if between is not None else []), *(["unit"] if unit else []), *strokes]
        if single or target:
            given = ", ".join(f"{each}=..." for each in single) or f"target={cited(target)}"
            remedy = "of several settings every target says it itself, Target(quantity, value, S=0.1)"
            raise DefinitionError(f"settings_for(..., {given}): {remedy}.")
        return solutions_for(machine, name, quantity, points)
    require(points is None, "settings_for(..., points", points, "points are those of a box of several settings; leave it out")
    check_one_design(machine)
    known_name("Dimension", name, machine.plan.table.spellings, where=machine.plan.title)
    unit_or_none(unit, where="settings_for(unit=...)")
    low, high = range_of("between", between)
    if set(strokes) != set(machine.strokes):
        raise DefinitionError(f"{machine.plan.title}: say the pose, {', '.join(f'{each}=...' for each in machine.strokes)}.")
    given = ", ".join(f"{each}={cited(value)}" for each, value in {"target": target, **strokes}.items())
    ensure(is_one(target) and all(map(is_one, strokes.values())), f"{machine.plan.title}: {given}: one number is expected for each, in SI.")
    require_kind(machine.plan, name, between, f"{machine.plan.title}: between")
    Target(quantity, target).check(machine.plan)

    pose = StudyPoses(machine.at(unreachable="nan", **{each: [value] for each, value in strokes.items()}))

    def curve(at: FloatArray) -> FloatArray:
        return pose.values(machine.replaced(**{name: at}), quantity, QUICKEST)[:, 0] - target if at.size else at

    identity = None if callable(quantity) else identity_of(machine.plan, quantity)
    known = ("settings", name, identity, target, low, high)
    at, off, spans = roots_of(curve, low, high) if identity is None else recalled(pose.base, known, lambda: roots_of(curve, low, high))
    ends = dict.fromkeys(end for span in spans for end in span)
    lost = {root: why for root in ends if (why := why_not_assembled(machine.replaced(**{name: root})))}
    kept = [span for span in spans if lost.keys().isdisjoint(span)]
    unit = unit or ("" if callable(quantity) else measure_unit(machine.plan, least(quantity)))
    words = {"name": name, "what": words_of(quantity), "target": show(target, unit)}
    own = unit_of(machine.plan, name)
    if not spans:
        return Settings(name, (), no_setting_words(words, own, unit, at, off + target))
    shown = {end: show(end, own) for end in ends}
    found = said(" or ").join(
        shown[first] if first == last else said("{low} to {high}", low=shown[first], high=shown[last]) for first, last in kept or spans
    )
    if kept:
        values = tuple(end for end in ends if any(end in span for span in kept))
        return Settings(name, values, said("{what} = {target} with {name} = {found}.", found=found, **words))
    why = said(
        "{what} = {target} with {name} = {found}, which cannot be assembled over the whole stroke: {why}",
        found=found, why=next(iter(lost.values())), **words,
    )  # fmt: skip
    return Settings(name, (), why)


def roots_of(curve: Curve, low: float, high: float) -> tuple[FloatArray, FloatArray, list[tuple[float, float]]]:
    """Return samples of a curve (n,), its values there (n,), and where it is zero: from where to where, mostly from one value to itself."""
    at = np.linspace(low, high, SAMPLES)
    off = curve(at)
    known = np.isfinite(off)
    edges = np.flatnonzero(known[1:] != known[:-1])
    if edges.size:  # the ends of every reachable range are samples too

        def reached(places: FloatArray) -> Mask:
            return np.asarray(np.isfinite(curve(places.ravel())).reshape(places.shape))

        inside, outside = (at[np.where(known[edges] == is_inside, edges, edges + 1)] for is_inside in (True, False))
        ends = last_holding(reached, inside, outside)[0]
        at, off = np.concatenate([at, ends]), np.concatenate([off, curve(ends)])
        order = np.argsort(at, kind="stable")
        at, off = at[order], off[order]
    size = np.abs(off)
    with np.errstate(invalid="ignore"):
        signs = np.sign(off)
        passed = np.flatnonzero(signs[1:] * signs[:-1] < 0.0)
        dips = (size[1:-1] <= size[:-2]) & (size[1:-1] <= size[2:]) & (signs[2:] == signs[:-2])
        dips &= (size[1:-1] < size[:-2]) | (size[1:-1] < size[2:])  # along a level stretch it comes no nearer
    near = np.array(sign_changes(curve, at[passed], at[passed + 1]))
    beside = np.abs(curve(near.ravel())).reshape(near.shape)
    zeros = np.where(beside[1] < beside[0], near[1], near[0])[np.isfinite(beside).all(axis=0)]  # without those that have a gap before them
    touched = np.flatnonzero(dips)
    lowest = highest_between(lambda places: -np.abs(curve(places)), at[touched], at[touched + 2])
    found = np.sort(np.concatenate([at[off == 0.0], zeros, lowest]))
    found = found[np.isfinite(found)]
    known = off[np.isfinite(off)]
    span, most = (float(np.ptp(each)) for each in (known, np.percentile(known, USUAL))) if known.size else (0.0, 0.0)
    span = min(span, POLES * most) or span
    touches = max(TOUCH * span, 1e-13)
    found = found[np.abs(curve(found)) <= touches]  # where it does not jump over zero
    found = found[np.diff(found, prepend=-np.inf) > 1e-9 * (high - low)]
    apart = np.abs(curve(0.5 * (found[1:] + found[:-1]))) > touches  # else it is zero all the way from one to the next
    starts, ends = (found[np.insert(apart, place, True)[: len(found)]] for place in (0, len(apart)))
    return at, off, [*zip(starts.tolist(), ends.tolist(), strict=True)]


def no_setting_words(words: Mapping[str, str], own: str, unit: str, at: FloatArray, value: FloatArray) -> str:
    """Return why no setting gives the target, from samples `at` (n,) shown in their `own` unit, and the values there in theirs."""
    known = np.isfinite(value)
    names = {**words, "low": show(at[0], own), "high": show(at[-1], own)}
    if not known.any():
        return said(
            "No {name} between {low} and {high} can be assembled there, so that {what} has no value. Look farther, or change the stroke.",
            **names,
        )
    ends, size = [float(value[known].min()), float(value[known].max())], np.where(known, np.abs(value), 0.0)
    top = int(np.argmax(size))
    if size[top] >= FAR * max(float(np.median(size[known])), TINY):  # a pole, with the signs that it has on either side
        beside = value[max(top - 1, 0) : top + 2]
        ends = [end if not np.any(beside * sign > 0.0) else sign * np.inf for end, sign in zip(ends, (-1.0, 1.0), strict=True)]
    least, most = (show(end, unit) for end in ends)
    first, last = (show(float(end), own) for end in (at[known].min(), at[known].max()))
    return said(
        "No {name} between {low} and {high} gives {what} = {target}: it can be assembled from {first} to {last}, "
        "where {what} goes from {least} to {most}.",
        first=first, last=last, least=least, most=most, **names,
    )  # fmt: skip


@immutable
class Solutions(HasSentence):
    """All settings of several dimensions that give the targets, or the nearest one.

    Attributes
    ----------
    machine : Mechanism
        The machine that was set.
    settings : tuple of mapping
        Values [SI] by name.
    met : bool
        Whether they give every target, with a machine that is assembled over its whole stroke.
    misses : tuple of tuple of float
        By settings, how far each target is missed [SI], zero to rounding where they are met.
    is_family : bool
        Whether they are some of infinitely many.
    sentence : str
        What was found, or why there is none.
    """

    machine: Mechanism
    settings: tuple[Mapping[str, Any], ...]
    met: bool
    misses: tuple[tuple[float, ...], ...]
    is_family: bool
    sentence: str

    @property
    def machines(self) -> tuple[Mechanism, ...]:
        """The machines with these settings."""
        return tuple(self.machine.replaced(**each) for each in self.settings)


def solutions_for(machine: Mechanism, vary: Mapping[str, object], targets: Sequence[Target], points: int | None) -> Solutions:
    """Return the settings of a box that give all targets; see `settings_for`."""
    check_one_design(machine)
    search = Search(machine, vary, targets)
    box, k, plan = search.box, len(search.box.ranges), machine.plan
    ensure(k or len(box.choices) >= 2, f'{plan.title}: nothing may vary; give a range such as {{"MK": (0.5, 1.3)}} or a list of choices.')
    what = f"{len(targets)} target{'s' * (len(targets) > 1)} leave{'s' * (len(targets) == 1)} {k} ranges a family of settings"
    ensure(k <= len(targets), f"{plan.title}: {what}; hold {k - len(targets)} of {', '.join(box.ranges)}, or give as many targets more.")
    with unwarned(), np.errstate(all="ignore"):
        size = (1 << min(8 + 2 * k, 14) if k else 1) if points is None else points
        require_whole("points", size, "a whole number of points of the box is expected, such as 4096", least=1, most=1 << 20)
        start, choice = search.best_starts(size if k else 1)
        if not len(start):
            where = ", ".join(dict.fromkeys(search.words(place).partition(" at ")[2] for place in range(len(search.targets))))
            names = ", ".join([*box.ranges, *box.choices[0]])
            nowhere = f"No setting of {names} that was looked at can be assembled at {where}. Look farther."
            return Solutions(machine, (), False, (), False, nowhere)
        unit, off = search.descend(start, choice)
        return search.solutions(unit, choice, off)


# The search: a grid of the box at once, then steps of Levenberg and Marquardt from all good starts together.

STARTS = 64
"""Starts of each choice: the best points of the grid, and those that no neighbour betters."""
STEPS = 80
MET = 1e-7
"""Of a target's own units: a miss that is smaller is rounding."""
SAME = 1e-6
"""Of a side of the box: solutions that are nearer to each other are one."""
FLAT = 1e-5
"""Of the largest singular value: where the least one is smaller, settings may change together without effect on any target."""
TOLD = 1e-3
"""Of a target's own units: a miss that is smaller is not told."""


class Search:
    """A box of settings of a machine, and the goals: targets, their requests, and their poses.

    `scale` says in how many units each target is weighed. DefinitionError for a pose that is not said.
    """

    def __init__(self, machine: Mechanism, vary: Mapping[str, object], targets: Any) -> None:
        plan, self.machine, self.box = machine.plan, machine, Box.of(machine, vary)
        for each in targets_given(targets, plan.title, 'such as [Target("tilt", 0.0, S=0.1)]'):
            expected = "one number is expected for the value, in SI. An array is a path, of follow(...)"
            ensure(not each.is_path, f"{plan.title}: {each!r}: {expected}.")
            if set(each.strokes) != set(machine.strokes):
                raise DefinitionError(f"{plan.title}: {each!r}: say the pose, {', '.join(f'{name}=...' for name in machine.strokes)}.")
            each.check(plan)
        self.targets: tuple[Target, ...] = tuple(targets)
        self.bound = tuple(traced_number(plan, each.quantity) for each in targets)
        strokes = {name: np.array([each.strokes[name] for each in targets]) for name in machine.strokes}
        self.wanted = np.array([each.value for each in targets])
        self.scale = np.array([each.miss(plan, float(each.value)) for each in targets])
        with unwarned():
            self.poses = StudyPoses(Motion(plan, machine.dimensions, strokes, "nan"))

    def misses(self, unit: FloatArray, choice: Index) -> FloatArray:
        """Return how far settings are off each target, in its units, shape (m, targets); NaN where they have no value.

        The settings are unit coordinates (m, k) with choices (m,).
        """
        machine = self.machine.replaced(**self.box.settings(unit, choice))
        found = self.poses.of_requests(machine, [each.quantity for each in self.targets], RunOptions("numpy"))
        columns = [values[:, place] for place, values in enumerate(found)]  # each target at a pose of its own
        return np.asarray((np.stack(columns, axis=1) - self.wanted) / self.scale)

    def slopes(self, unit: FloatArray, choice: Index) -> FloatArray:
        """Return the derivatives of the misses by the unit coordinates, shape (m, targets, k)."""
        machine = self.machine.replaced(**self.box.settings(unit, choice))
        plan, dimensions = machine.plan, dimensions_of(machine.plan, [*self.box.ranges])
        owners, signs = tuple(owner for owner, _ in dimensions), np.array([float(sign) for _, sign in dimensions])
        grid = self.poses.grid_at(machine)
        kernel = BulkProgram.for_requests(plan, [slope(request, owners) for request in self.bound]).kernel
        found = grid.kernel_result(kernel, way=RunOptions("numpy")).values.reshape(len(self.bound), len(owners), *grid.size)
        columns = [values[..., place] for place, values in enumerate(found)]
        sides = np.array([high - low for low, high in self.box.ranges.values()])
        return np.asarray(np.stack(columns, axis=0).transpose(2, 0, 1) * signs / self.scale[:, None] * sides)

    def words(self, place: int, value: float | None = None) -> str:
        """Return a target in words, or a value of it: `tilt = 5 deg at S = 100 mm`."""
        each, request, plan = self.targets[place], self.bound[place], self.machine.plan
        at = ", ".join(f"{name} = {show(float(v), stroke_display_unit(plan, name, 'mm'))}" for name, v in each.strokes.items())
        return f"{request} = {show(float(each.value) if value is None else value, each.shown_in(plan))} at {at}"

    def best_starts(self, points: int) -> tuple[FloatArray, Index]:
        """Return where to start: unit coordinates (m, k) and choices (m,), of every choice the best of a Sobol sequence."""
        k, choices = len(self.box.ranges), len(self.box.choices)
        grid = np.concatenate([unit_points(points, k, "sobol", 0), np.full((1, k), 0.5)]) if k else np.empty((1, 0))
        every, choice = np.tile(grid, (choices, 1)), np.repeat(np.arange(choices), len(grid))
        off = np.linalg.norm(self.misses(every, choice), axis=1).reshape(choices, -1)
        off[~np.isfinite(off)] = np.inf
        if len(grid) > STARTS:
            from scipy.spatial import cKDTree

            _, near = cKDTree(grid).query(grid, 1 + 4 * grid.shape[1])
        rows = []
        for each in off:  # the best, and those that none of their neighbours improves on
            chosen = np.zeros(len(grid), bool)
            chosen[np.argsort(each, kind="stable")[: STARTS // 2]] = True
            if len(grid) > STARTS:
                lowest = np.flatnonzero(each <= each[near].min(axis=1))
                chosen[lowest[np.argsort(each[lowest], kind="stable")][:STARTS]] = True
            rows.append(np.flatnonzero(chosen & np.isfinite(each)))
        return np.concatenate([grid[row] for row in rows]), np.repeat(np.arange(choices), [len(row) for row in rows])

    def descend(self, unit: FloatArray, choice: Index) -> tuple[FloatArray, FloatArray]:
        """Return where the misses are least near each start, unit coordinates (m, k), and the misses there (m, targets)."""

        def misses(at: FloatArray, which: Index) -> FloatArray:
            return self.misses(at, choice[which])

        def slopes(at: FloatArray, which: Index) -> FloatArray:
            return self.slopes(at, choice[which])

        return descended(misses, slopes, unit, STEPS)

    def solutions(self, unit: FloatArray, choice: Index, off: FloatArray) -> Solutions:
        """Return all solutions that a search found, or the nearest setting."""
        size = np.abs(off).max(axis=1)
        met = np.flatnonzero(size <= MET)
        order = met[np.argsort(size[met], kind="stable")] if len(met) else np.argsort(np.sum(off**2, axis=1), kind="stable")[:1]

        def is_same(one: int, other: int) -> bool:
            def is_between() -> bool:
                between = self.misses(0.5 * (unit[one] + unit[other])[None], choice[[other]])
                return bool(np.abs(between).max() <= MET)

            return bool(choice[one] == choice[other]) and is_one_solution(unit[one] - unit[other], SAME, is_between)

        kept = without_repeats(order, is_same, len(order))
        family = self._of_families(unit, choice, kept) if len(met) else {}
        kept = [each for each in kept if family.get(each, each) == each]
        kept.sort(key=lambda each: (int(choice[each]), *unit[each]))
        values = self.box.settings(unit, choice)
        lost = {each: why for each in kept if len(met) and (why := why_not_assembled(self.machine.replaced(**one_setting(values, each))))}
        is_met = bool(len(met)) and len(lost) < len(kept)
        kept = [each for each in kept if each not in lost] if is_met else kept
        settings = tuple(one_setting(values, each) for each in kept)
        misses = tuple(tuple((off[each] * self.scale).tolist()) for each in kept)
        words = [setting_words(self.machine.plan, values, each) for each in kept]
        if is_met or lost:
            wanted = "; ".join(self.words(place) for place in range(len(self.targets)))
            more = " This is one of a family: settings can change together there without any effect." if family else ""
            sentence = f"{wanted}: with {' or with '.join(words)}.{more}"
            sentence += "" if is_met else f" It cannot be assembled over the whole stroke: {lost[kept[0]]}"
        else:
            parts = []
            for place, miss in enumerate(misses[0]):  # of the nearest setting
                own, unit_shown = self.targets[place], self.targets[place].shown_in(self.machine.plan)
                name, gap = self.words(place, float(own.value) + miss), show(abs(miss), unit_shown, 4)
                is_told = abs(off[kept[0], place]) > TOLD
                parts.append(f"{name}, {gap} {'more' if miss > 0.0 else 'less'} than wanted" if is_told else f"{name} as wanted")
            sentence = f"No setting that was found gives all of it. The nearest is {words[0]}: {'; '.join(parts)}."
        return Solutions(self.machine, settings, is_met, misses, bool(family), sentence)

    def _of_families(self, unit: FloatArray, choice: Index, kept: Sequence[int]) -> dict[int, int]:
        """Return the solutions from which settings can change together without effect, each with the first one of its choice."""
        found: dict[int, int] = {}
        for each in kept if unit.shape[1] else ():
            _, sizes, ways = np.linalg.svd(self.slopes(unit[[each]], choice[[each]])[0])
            if sizes[-1] > FLAT * sizes[0]:  # every direction has an effect to the first order
                continue
            first = next((other for other in found if choice[other] == choice[each]), None)
            if first is None:  # another solution a step aside, as far as those of a double root may lie apart
                aside = np.clip(unit[each] + NEAR * np.array([[1.0], [-1.0]]) * ways[-1], 0.0, 1.0)
                near, off = self.descend(aside, choice[[each, each]])
                if not np.any((np.abs(off).max(axis=1) <= MET) & (np.abs(near - unit[each]).max(axis=1) > 0.3 * NEAR)):
                    continue
            found[each] = each if first is None else first
        return found


def one_setting(values: Mapping[str, Any], place: int) -> Mapping[str, Any]:
    """Return one of some settings (m,) by name; a point's is a pair."""
    found: dict[str, Any] = {}
    for name, value in values.items():
        found[name] = tuple(float(part[place]) for part in value) if isinstance(value, tuple) else float(value[place])
    return FrozenDict(found)


# -- a zone: the least and the greatest value of a quantity at every stroke, over a box of settings ------------

POSES = 51
MOST_RANGES = 8
"""Ranges of a zone: its grid has 3 points a side of so many, 6,561."""


@immutable
class Zone:
    """The band of a quantity over the strokes, over all settings that can be assembled.

    `complete` is the mask of the strokes where all settings have a value.

    Attributes
    ----------
    quantity : str
        The quantity.
    strokes : mapping of str to array
        The poses [m or rad].
    low, high : array
        The least and the greatest value [SI], of the shape (...) of the strokes.
    low_at, high_at : mapping of str to object
        The settings that give them.
    reached : array
        The share of the settings looked at that have a value.
    looked_at : int
        How many settings were looked at.
    remarks : tuple of str
        What was left out, in sentences.
    """

    quantity: str
    strokes: Mapping[str, FloatArray]
    low: FloatArray
    high: FloatArray
    low_at: Mapping[str, Any]
    high_at: Mapping[str, Any]
    reached: FloatArray
    looked_at: int
    remarks: tuple[str, ...] = ()

    @property
    def complete(self) -> Mask:
        """The strokes at which every setting looked at has a value."""
        return np.asarray(self.reached == 1.0)


def zone(machine: Mechanism, quantity: QuantityLike, vary: Any = None, *, over: None = None, **strokes: Any) -> Zone:
    """Return the true extremes of a quantity at every stroke, over a box of settings and not only its corners.

    The search is deterministic. Settings that cannot be assembled, or where the quantity has no value, are left out, counted and reported
    in `remarks`. Angles are taken within 180 deg of those of the machine as it is set.

    Parameters
    ----------
    machine : Mechanism
        The machine, one design.
    quantity : str or callable
        A named output, or a function of a motion that gives a number for each pose.
    vary : mapping of str to object
        Ranges and choices, as in `Box.of`.
    over : None, optional
        Refused: elsewhere it says where strokes run.
    **strokes : float or array
        As in `machine.at`, by default 51 poses over a single stroke.

    Returns
    -------
    Zone
        The band of the quantity.
    """
    check_one_design(machine)
    check_vary(machine, "zone", over)
    box = Box.of(machine, vary)
    what = f"{len(box.ranges)} ranges are too many for a zone"
    ensure(len(box.ranges) <= MOST_RANGES, f"{machine.plan.title}: {what}; hold some, {MOST_RANGES} are the most.")
    given = strokes or {name: np.linspace(each.start, each.end, POSES) for name, each in machine.strokes.items()}
    poses = at_values(given, machine.plan)
    shape = next(iter(poses.values())).shape
    ensure(0 not in shape, f"{machine.plan.title}: there are no strokes to look at; give at least one value of {', '.join(poses)}.")
    flat = {name: value.ravel() for name, value in poses.items()}
    looked_at = StudyPoses(machine.at(unreachable="nan", **flat))

    def f(task: Index, unit: FloatArray, choice: Index) -> FloatArray:
        return quantity_values(looked_at.of_each(machine.replaced(**box.settings(unit, choice)), task), quantity)

    tasks = int(np.prod(shape, dtype=int))
    (low, high), unit, choice, seen = extremes(f, tasks, len(box.ranges), len(box.choices))
    known = np.abs(seen[np.isfinite(seen)])
    if known.size and bool(np.any(np.abs([low, high]) > FAR * max(float(np.median(known)), TINY))):  # as large as next to a pole
        divisors, named = () if callable(quantity) else divisors_of(machine.plan, quantity), f"{machine.plan.title}: {words_of(quantity)}"
        raise boundless_error(named, divisors[0] if len(divisors) == 1 else None, "look at other strokes")
    ends: list[dict[str, Any]] = [{}, {}]
    for row, found in enumerate(ends):
        for name, value in box.settings(unit[row], choice[row]).items():
            found[name] = tuple(part.reshape(shape) for part in value) if isinstance(value, tuple) else value.reshape(shape)
    share = np.mean(np.isfinite(seen), axis=1)
    return Zone(
        words_of(quantity), poses, low.reshape(shape), high.reshape(shape), ends[0], ends[1],
        share.reshape(shape), seen.shape[1], tuple(remarks(machine, quantity, box, flat, seen)),
    )  # fmt: skip


def remarks(machine: Mechanism, quantity: QuantityLike, box: Box, strokes: Mapping[str, FloatArray], seen: FloatArray) -> list[str]:
    """Return the omissions of a zone, and its settings near a dead point, in words."""
    grid = grid_of(len(box.ranges))
    count = len(box.choices)
    settings = box.settings(np.tile(grid, (count, 1)), np.repeat(np.arange(count), len(grid)))
    motion = machine.replaced(**settings).at(unreachable="nan", **strokes)
    lost = ~motion.reached
    said = []
    if lost.any():
        said.append(f"{settings_counted(lost, motion, settings)} cannot be assembled and are left out of the zone. {out_of_reach(motion)}")
    empty = np.isnan(seen.T) & motion.reached
    if empty.any():
        said.append(f"{settings_counted(empty, motion, settings)} have no value of {words_of(quantity)} and are left out of the zone.")
    with warnings.catch_warnings(record=True) as heard:
        warnings.simplefilter("always", SingularWarning)
        if callable(quantity):
            function_value(quantity, motion)
    return said + list(dict.fromkeys(str(each.message) for each in heard if issubclass(each.category, SingularWarning)))


def settings_counted(mask: Mask, motion: Motion, settings: Mapping[str, object]) -> str:
    """Return which settings (m) are meant at which strokes (n), mask (m, n), with an example."""
    some, when = mask.any(axis=1), mask.any(axis=0)
    units = {name: stroke_unit(motion.plan, name) for name in motion.strokes}
    spans = places_text({name: value[when] for name, value in motion.strokes.items()}, units)
    example = setting_words(motion.plan, settings, int(np.argmax(some)))
    return f"{int(some.sum())} of {some.size} settings looked at ({spans}), such as {example},"


# The least and the greatest value of functions over boxes, all of them at once: as strokes are searched, from a coarser grid.

Function: TypeAlias = Callable[[Index, FloatArray, Index], FloatArray]
"""`f(task, unit, choice)`: the value of task (m,) at unit coordinates (m, k), choice (m,)."""


SIDE: Mapping[int, int] = MappingProxyType({0: 1, 1: 33, 2: 13, 3: 7, 4: 5, 5: 3, 6: 3, 7: 3, 8: 3})
"""How many points a side of the grid has, for a box of so many dimensions."""


def grid_of(k: int) -> FloatArray:
    """Return the grid of a box of k dimensions, shape (points, k): corners, edges, faces and inside."""
    return np.array(list(product(np.linspace(0.0, 1.0, SIDE[k]), repeat=k))).reshape(SIDE[k] ** k, k)


class SettingsBox:
    """A function of settings in the unit box, as a search in boxes asks: less the function and the function, of each task and choice."""

    def __init__(self, f: Function, tasks: int, k: int, choices: int) -> None:
        self.f, self.k, self.side, self.choices, self.count = f, k, SIDE[k], choices, 0
        every, grid = np.arange(tasks * choices), grid_of(k)
        self.seen, self.kept = self.at(every, np.broadcast_to(grid, (len(every), *grid.shape)))

    def values(self, design: Index, places: FloatArray) -> FloatArray:
        """Return the function (u, n) at places (u, n, k) of a task and choice each (u,)."""
        task, choice = np.divmod(np.repeat(design, places.shape[1]), self.choices)
        self.count += task.size
        return self.f(task, places.reshape(task.size, self.k), choice).reshape(places.shape[:2])

    def at(self, design: Index, places: FloatArray) -> tuple[FloatArray, Mask]:
        """Return both (2, u, n), and which settings have a value (u, n)."""
        values = self.values(design, places)
        return np.stack([-values, values]), np.isfinite(values)

    def one_function(self, function: int, design: Index, places: FloatArray) -> FloatArray:
        """Return one of both (u, n), by its number."""
        return np.asarray((-1.0, 1.0)[function] * self.values(design, places))

    def is_kept(self, design: Index, places: FloatArray) -> Mask:
        """Return which settings have a value (u, n)."""
        return np.isfinite(self.values(design, places))

    def look(self, _: Index, t: FloatArray) -> tuple[FloatArray, Mask]:
        """Return both along the one dimension of a box, at the grid (n,) or places (tasks and choices, n)."""
        return (self.seen, self.kept) if t.ndim == 1 else self.at(np.arange(len(t)), t[..., None])

    def highest(self) -> tuple[FloatArray, FloatArray]:
        """Return the highest values (2, tasks and choices), NaN where there is none, and where (2, tasks and choices, k)."""
        if self.k == 1:
            found = highest(self.look, [self.side - 1])
            return found.value, found.t[..., None]
        if self.k:
            value, unit, _ = highest_in(self)
            return value, unit
        return self.seen[..., 0], np.zeros((*self.seen.shape[:2], 0))


def extremes(f: Function, tasks: int, k: int, choices: int) -> tuple[FloatArray, FloatArray, Index, FloatArray]:
    """Return the extremes of f over a unit box of k dimensions and some choices, for every task.

    The least and the greatest value, shape (2, t), where they are, at unit (2, t, k) and choice (2, t), NaN where there is none, and the
    values on the grid, shape (t, grid points).
    """
    box = SettingsBox(f, tasks, k, choices)
    value, unit = (each.reshape(2, tasks, choices, *each.shape[2:]) for each in box.highest())
    choice = np.argmax(np.where(np.isnan(value), -np.inf, value), axis=-1)
    best = np.take_along_axis(unit, choice[..., None, None], axis=2)[:, :, 0]
    found = f(np.tile(np.arange(tasks), 2), best.reshape(2 * tasks, k), choice.ravel()).reshape(2, tasks)
    return found, np.where(np.isnan(found)[..., None], np.nan, best), choice, box.seen[1].reshape(tasks, -1)
