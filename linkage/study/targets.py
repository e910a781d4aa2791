"""Several settings for several wanted values: all that give them, or the nearest with what is missing."""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, final

import numpy as np

from ..checks import require_whole
from ..errors import DefinitionError, unwarned
from ..frozen import FrozenDict, refuses_changes
from ..mechanism import Mechanism
from ..motion import Motion, Request, Target, stroke_display_unit
from ..motion.evaluation import BulkProgram
from ..motion.places import targets_given
from ..motion.requests import dimensions_of, slope
from ..numeric.descent import NEAR, descended, is_one_solution, without_repeats
from ..numeric.line import Index
from ..plan import Mask
from ..program import FloatArray, RunOptions
from ..units import show
from .box import Box, setting_words, unit_points
from .checks import check_one_design, why_not_assembled
from .measured import StudyPoses, traced_number


@final
@refuses_changes
@dataclass(frozen=True, eq=False)
class Solutions:
    """All settings of several dimensions that give the targets, or the nearest one; `sentence` says so.

    `settings` are values [SI] by name. `met` is whether they give every target, with a machine that is assembled over its whole stroke.
    `misses` are, by settings, how far each target is missed [SI], zero to rounding where they are met. Where `is_family` they are some of
    infinitely many.
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

    def __str__(self) -> str:
        return self.sentence


def solutions_for(machine: Mechanism, vary: Mapping[str, object], targets: Sequence[Target], points: int | None) -> Solutions:
    """Return the settings of a box that give all targets; see `settings_for`."""
    check_one_design(machine)
    box, aim = Box.of(machine, vary), Aim.of(machine, targets)
    k, plan = len(box.ranges), machine.plan
    if not k and len(box.choices) < 2:
        raise DefinitionError(f'{plan.title}: nothing may vary; give a range such as {{"MK": (0.5, 1.3)}} or a list of choices.')
    if k > len(targets):
        what = f"{len(targets)} target{'s' * (len(targets) > 1)} leave{'s' * (len(targets) == 1)} {k} ranges a family of settings"
        raise DefinitionError(f"{plan.title}: {what}; hold {k - len(targets)} of {', '.join(box.ranges)}, or give as many targets more.")
    search = Search(machine, box, aim)
    with unwarned(), np.errstate(all="ignore"):
        size = (1 << min(8 + 2 * k, 14) if k else 1) if points is None else points
        require_whole("points", size, "a whole number of points of the box is expected, such as 4096", least=1, most=1 << 20)
        start, choice = search.starts(size if k else 1)
        if not len(start):
            where = ", ".join(dict.fromkeys(aim.words(place).partition(" at ")[2] for place in range(len(aim.targets))))
            names = ", ".join([*box.ranges, *box.choices[0]])
            nowhere = f"No setting of {names} that was looked at can be assembled at {where}. Look farther."
            return Solutions(machine, (), False, (), False, nowhere)
        unit, off = search.descend(start, choice)
        return search.settled(unit, choice, off)


# The targets, bound to a machine, and how far off settings are.


@final
@dataclass(frozen=True, eq=False)
class Aim:
    """Targets of a machine: their requests, the poses they are wanted at, and in how many units each is weighed."""

    machine: Mechanism
    targets: tuple[Target, ...]
    bound: tuple[Request, ...]
    poses: StudyPoses
    wanted: FloatArray
    scale: FloatArray

    @classmethod
    def of(cls, machine: Mechanism, targets: Any) -> Aim:
        """Return targets bound to a machine; DefinitionError for anything else, and for a pose that is not said."""
        plan = machine.plan
        for each in targets_given(targets, plan.title, 'such as [Target("tilt", 0.0, S=0.1)]'):
            if each.is_path:
                said = "one number is expected for the value, in SI. An array is a path, of follow(...)"
                raise DefinitionError(f"{plan.title}: {each!r}: {said}.")
            if set(each.strokes) != set(machine.strokes):
                raise DefinitionError(f"{plan.title}: {each!r}: say the pose, {', '.join(f'{name}=...' for name in machine.strokes)}.")
            each.check(plan)
        bound = tuple(traced_number(plan, each.quantity) for each in targets)
        strokes = {name: np.array([each.strokes[name] for each in targets]) for name in machine.strokes}
        scale = [each.miss(plan, float(each.value)) for each in targets]
        with unwarned():
            poses = StudyPoses(Motion(plan, machine.dimensions, strokes, "nan"))
        return cls(machine, tuple(targets), bound, poses, np.array([each.value for each in targets]), np.array(scale))

    def misses(self, machine: Mechanism) -> FloatArray:
        """Return how far m designs are off each target, in its units, shape (m, targets); NaN where they have no value."""
        unique = {request.key: each.quantity for request, each in zip(self.bound, self.targets, strict=True)}
        found = dict(zip(unique, self.poses.of_requests(machine, list(unique.values()), RunOptions("numpy")), strict=True))
        columns = [found[request.key][:, place] for place, request in enumerate(self.bound)]
        return np.asarray((np.stack(columns, axis=1) - self.wanted) / self.scale)

    def slopes(self, machine: Mechanism, names: Sequence[str]) -> FloatArray:
        """Return the derivatives of the misses of m designs by dimensions, shape (m, targets, dimensions)."""
        plan, dimensions = machine.plan, dimensions_of(machine.plan, names)
        owners, signs = tuple(owner for owner, _ in dimensions), np.array([float(sign) for _, sign in dimensions])
        grid = self.poses.grid_at(machine)
        found: dict[Hashable, FloatArray] = {}
        for request in self.bound:
            if request.key not in found:
                kernel = BulkProgram.of(plan, [slope(request, owners)]).kernel
                found[request.key] = kernel(grid.flat, way=RunOptions("numpy"), size=grid.size).values
        columns = [found[request.key][:, :, place] for place, request in enumerate(self.bound)]
        return np.asarray(np.stack(columns, axis=0).transpose(2, 0, 1) * signs / self.scale[:, None])

    def words(self, place: int, value: float | None = None) -> str:
        """Return a target in words, or a value of it: `tilt = 5 deg at S = 100 mm`."""
        each, request, plan = self.targets[place], self.bound[place], self.machine.plan
        at = ", ".join(f"{name} = {show(float(v), stroke_display_unit(plan, name, 'mm'))}" for name, v in each.strokes.items())
        return f"{request} = {show(float(each.value) if value is None else value, each.shown_in(plan))} at {at}"



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


@final
@dataclass(frozen=True, eq=False)
class Search:
    """A box of settings, and what is aimed at with them."""

    machine: Mechanism
    box: Box
    aim: Aim

    @property
    def sides(self) -> FloatArray:
        """The lengths of the ranges [SI], shape (k,)."""
        return np.array([high - low for low, high in self.box.ranges.values()])

    def at(self, unit: FloatArray, choice: Index) -> Mechanism:
        """Return the machines at unit coordinates (m, k) with choices (m,)."""
        return self.machine.replaced(**self.box.settings(unit, choice))

    def starts(self, points: int) -> tuple[FloatArray, Index]:
        """Return where to start: unit coordinates (m, k) and choices (m,), of every choice the best of a Sobol sequence."""
        k, choices = len(self.box.ranges), len(self.box.choices)
        grid = np.concatenate([unit_points(points, k, "sobol", 0), np.full((1, k), 0.5)]) if k else np.empty((1, 0))
        every, choice = np.tile(grid, (choices, 1)), np.repeat(np.arange(choices), len(grid))
        off = np.linalg.norm(self.aim.misses(self.at(every, choice)), axis=1).reshape(choices, -1)
        off[~np.isfinite(off)] = np.inf
        rows = [np.flatnonzero(best_points(grid, each)) for each in off]
        return np.concatenate([grid[row] for row in rows]), np.repeat(np.arange(choices), [len(row) for row in rows])

    def descend(self, unit: FloatArray, choice: Index) -> tuple[FloatArray, FloatArray]:
        """Return where the misses are least near each start, unit coordinates (m, k), and the misses there (m, targets)."""

        def misses(at: FloatArray, which: Index) -> FloatArray:
            return self.aim.misses(self.at(at, choice[which]))

        def slopes(at: FloatArray, which: Index) -> FloatArray:
            return self.aim.slopes(self.at(at, choice[which]), [*self.box.ranges]) * self.sides

        return descended(misses, slopes, unit, STEPS)

    def settled(self, unit: FloatArray, choice: Index, off: FloatArray) -> Solutions:
        """Return all solutions that a search found, or the nearest setting."""
        size = np.abs(off).max(axis=1)
        met = np.flatnonzero(size <= MET)
        order = met[np.argsort(size[met], kind="stable")] if len(met) else np.argsort(np.sum(off**2, axis=1), kind="stable")[:1]

        def is_same(one: int, other: int) -> bool:
            def is_between() -> bool:
                between = self.aim.misses(self.at(0.5 * (unit[one] + unit[other])[None], choice[[other]]))
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
        misses = tuple(tuple((off[each] * self.aim.scale).tolist()) for each in kept)
        words = [setting_words(self.machine.plan, values, each) for each in kept]
        if lost and not is_met:
            sentence = self._met_words(words, bool(family)) + f" It cannot be assembled over the whole stroke: {lost[kept[0]]}"
        else:
            sentence = self._met_words(words, bool(family)) if is_met else self._near_words(words[0], off[kept[0]])
        return Solutions(self.machine, settings, is_met, misses, bool(family), sentence)

    def _of_families(self, unit: FloatArray, choice: Index, kept: Sequence[int]) -> dict[int, int]:
        """Return the solutions from which settings can change together without effect, each with the first one of its choice."""
        found: dict[int, int] = {}
        for each in kept:
            way = self._way_aside(unit[each], choice[each])
            first = next((other for other in found if choice[other] == choice[each]), None)
            if way is not None and (first is not None or self._goes_on(unit[each], choice[each], way)):
                found[each] = each if first is None else first
        return found

    def _way_aside(self, unit: FloatArray, choice: int) -> FloatArray | None:
        """Return the direction in which settings have no effect to the first order, shape (k,); None where every one has."""
        if not len(unit):
            return None
        slopes = self.aim.slopes(self.at(unit[None], np.array([choice])), [*self.box.ranges])[0] * self.sides
        _, sizes, ways = np.linalg.svd(slopes)
        return None if sizes[-1] > FLAT * sizes[0] else ways[-1]

    def _goes_on(self, unit: FloatArray, choice: int, way: FloatArray) -> bool:
        """Return whether another solution stands a step aside, as far as those of a double root may lie apart."""
        aside = np.clip(unit + NEAR * np.array([[1.0], [-1.0]]) * way, 0.0, 1.0)
        found, off = self.descend(aside, np.array([choice, choice]))
        return bool(np.any((np.abs(off).max(axis=1) <= MET) & (np.abs(found - unit).max(axis=1) > 0.3 * NEAR)))

    def _met_words(self, words: Sequence[str], is_family: bool) -> str:
        """Return the settings that give the targets."""
        wanted = "; ".join(self.aim.words(place) for place in range(len(self.aim.targets)))
        more = " This is one of a family: settings can change together there without any effect." if is_family else ""
        return f"{wanted}: with {' or with '.join(words)}.{more}"

    def _near_words(self, words: str, off: FloatArray) -> str:
        """Return the nearest setting, and what is missing of each target."""
        said = []
        for place, miss in enumerate(off * self.aim.scale):
            name = self.aim.words(place, float(self.aim.targets[place].value) + float(miss))
            gap = show(abs(float(miss)), self.aim.targets[place].shown_in(self.machine.plan), 4)
            side = "more" if miss > 0.0 else "less"
            said.append(f"{name}, {gap} {side} than wanted" if abs(off[place]) > TOLD else f"{name} as wanted")
        return f"No setting that was found gives all of it. The nearest is {words}: {'; '.join(said)}."


def one_setting(values: Mapping[str, Any], place: int) -> Mapping[str, Any]:
    """Return one of some settings (m,) by name; a point's is a pair."""
    found: dict[str, Any] = {}
    for name, value in values.items():
        found[name] = tuple(float(part[place]) for part in value) if isinstance(value, tuple) else float(value[place])
    return FrozenDict(found)


def best_points(grid: FloatArray, off: FloatArray) -> Mask:
    """Return the mask of the points (m, k) of a grid to start from: the best, and those that none of their neighbours improves on."""
    chosen = np.zeros(len(grid), bool)
    order = np.argsort(off, kind="stable")
    chosen[order[: STARTS // 2]] = True
    if len(grid) > STARTS:
        from scipy.spatial import cKDTree

        _, near = cKDTree(grid).query(grid, 1 + 4 * grid.shape[1])
        lowest = np.flatnonzero(off <= off[near].min(axis=1))
        chosen[lowest[np.argsort(off[lowest], kind="stable")][:STARTS]] = True
    return chosen & np.isfinite(off)
