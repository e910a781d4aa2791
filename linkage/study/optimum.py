"""Results of a search: the design, its limits, the worth of relaxing each, and how certain it is."""

from __future__ import annotations

import csv
import json
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from itertools import islice, product
from math import prod
from operator import itemgetter
from types import MappingProxyType
from typing import Any

import numpy as np

from ..disk import Place, replacing_text
from ..errors import AssemblyError, DefinitionError, LinkageError, ensure
from ..frozen import immutable, record
from ..mechanism import Mechanism
from ..motion import Over
from ..motion.measures import Constraint, FixedNumber, Integral, Leaf, Measure, measure_of, measure_unit
from ..motion.motion_verdicts import domain_words
from ..plan import Plan
from ..shown import HasSentence, Shown, text_columns
from ..units import deg, display_unit, factor, mm, require_number, show, shown_in
from ..vectors import FloatArray, Index, Mask
from .measured import no_value
from .poles import check_bounded
from .problem import LeafNumbers, Problem
from .solver import MET, SAME, Local, SearchEnd, local_search, missing_of, scales_of, true_worth, worth_in_order
from .space import Space, Varied, size_of_machine, unit_of, unit_points

ACTIVE = 1e-6
"""A condition with no more than this part of its size to spare is active."""
SHOWN = 1e-6
"""A gain of less than this part of the objective is none."""
COARSEST = 0.25
"""Of the largest length of a machine: steps that are coarser were given in another unit."""
STILL = 1e-12
"""A condition that changes less than this with everything limits nothing."""
MARGINS = "reach"
EDGE, STEPS_BEYOND = 0.01, (1e-7, 1e-6, 1e-5, 1e-4, 1e-3)
"""Of a range: a gain on so much is worth naming what stands against it; steps beyond a design on which that is looked for."""
SAID_STEPS: Mapping[str, float] = MappingProxyType({"mm": 10.0 * mm, "deg": 1.0 * deg})
"""By how much a variable is said to change, by its unit; others by a hundredth of their range."""
NOISE = 1e-9
"""A number [SI] that is smaller is shown as zero."""
MOST_ROUNDINGS = 4096
SPREAD, PROMISING = 1024, 4
"""Designs spread over the box to see which steps are promising, so many of which are searched from."""
MOST_STEPS, JUDGED, NEAR_KEPT = 1 << 14, 24, 1e-3
"""So many designs on steps are all looked at, so many of the best judged; what misses by no more at few poses may be kept."""


@immutable
class ConditionSpare:
    """A condition of a design: its two sides [SI], the spare (below zero: missing), and whether it is active.

    `gain` is by what part the objective would be better if the condition gave way `by` so much [SI]: by 1 % of its limit, of a limit
    of zero by 1 % of the size of what is compared.
    """

    constraint: Constraint
    left: float
    right: float
    spare: float
    by: float
    gain: float
    units: str

    @property
    def active(self) -> bool:
        """Whether nothing is to spare."""
        return self.gain > 0.0

    def __str__(self) -> str:
        sides = [0.0 if abs(each) < NOISE else each for each in (self.left, self.right)]
        value, limit = ("not limited" if np.isnan(each) else show(each, self.units) for each in sides)
        said = f"{in_units(self.constraint, self.units)}: {value}"
        if not isinstance(self.constraint.right, FixedNumber):
            said += f" against {limit}"
        if not self.active:
            return said
        of_limit = abs(max(abs(self.left), abs(self.right)) - 100.0 * self.by) <= self.by
        way = "1 % less strict" if of_limit else f"giving way by {show(self.by, self.units, 3)}"
        return f"{said}, active: {way} gains {100.0 * self.gain:.2g} %"


@immutable
class AtBound:
    """A variable at an end of its range, and the gain of the objective, as a part, `by` so much farther [SI]."""

    variable: Varied
    value: float
    is_upper: bool
    by: float
    gain: float

    @property
    def change(self) -> str:
        """How much farther that is, in words: `10 mm more`."""
        return f"{self.variable.show(self.by)} {'more' if self.is_upper else 'less'}"

    def __str__(self) -> str:
        end = "upper" if self.is_upper else "lower"
        return f"{self.variable.name} = {self.variable.show(self.value)} is at its {end} end: {self.change} gains {100.0 * self.gain:.2g} %"


@immutable
class Optimum(Shown):
    """The best design found, assembled over the whole stroke.

    Attributes
    ----------
    machine, start : Mechanism
        The design, and that which the search began with.
    value, start_value : float
        Their objectives [SI]; NaN where the first one cannot be assembled.
    start_missing : float
        By how much the first one misses the conditions, scaled; 0 where it keeps them.
    conditions : tuple of Kept
        What each condition has to spare, and which are active.
    bounds : tuple of AtBound
        The variables at their ends.
    variables : mapping of str to float
        The values found [SI].
    agreed, tries : int
        How many of the local searches came to this value.
    searched : int
        How many combinations of choices were searched.
    cut : tuple of str
        Which combinations of choices cannot keep a condition, whatever the variables.
    evaluations : int
        How many designs were looked at.
    problem : Problem
        The objective and the conditions over their samples.
    unit : array
        The variables in parts of their ranges.
    combination : tuple of int
        The choices taken, by number.
    tried : tuple of EvaluatedDesigns
        The designs looked at, stage by stage.
    limit : int, optional
        That of the designs where it was reached, so that this is the best so far; None where the search came to its end.
    edges : tuple of str
        Where the machine itself stops it: links that no longer meet, a bore that must be above its rod.
    """

    machine: Mechanism
    start: Mechanism
    value: float
    start_value: float
    start_missing: float
    conditions: tuple[ConditionSpare, ...]
    bounds: tuple[AtBound, ...]
    variables: Mapping[str, float]
    agreed: int
    tries: int
    searched: int
    cut: tuple[str, ...]
    evaluations: int
    problem: Problem
    unit: FloatArray
    combination: tuple[int, ...]
    tried: tuple[EvaluatedDesigns, ...] = ()
    limit: int | None = None
    edges: tuple[str, ...] = ()

    @property
    def gain(self) -> float:
        """The gain over the start's objective, as a part; NaN where the start cannot be assembled."""
        if not np.isfinite(self.start_value) or self.start_value == 0.0:
            return float("nan")
        return float(-self.problem.sense * (self.value - self.start_value) / abs(self.start_value))

    @property
    def active(self) -> tuple[ConditionSpare, ...]:
        """The conditions that limit it."""
        return tuple(each for each in self.conditions if each.active)

    def __str__(self) -> str:
        problem, units = self.problem, unit_of_measure(self.machine.plan, self.problem.objectives[0])
        word = "least" if problem.sense > 0.0 else "greatest"
        start, gained = show(self.start_value, units), ""
        if np.isfinite(self.start_value) and (self.start_missing > MET or not np.isfinite(self.gain)):
            gained = f"; {start} to begin with{', which misses the conditions' if self.start_missing > MET else ''}"
        elif np.isfinite(self.start_value):
            gained = ", as to begin with" if abs(self.gain) < SAME else f", {100.0 * self.gain:.3g} % better than {start} to begin with"
        lines = [f"{problem.plan.title}: the {word} {problem.objectives[0]} found is {show(self.value, units)}{gained}."]
        lines += [f"  {each.name} = {each.show(self.variables[each.name])}" for each in problem.space.variables]
        lines += [f"  {each}" for each in problem.space.words(self.combination, problem.plan).split(", ") if each]
        lines += [f"  {each}." for each in (*self.conditions, *self.bounds, *self.edges)]
        tries = f"{self.agreed} of {self.tries} searches came to it" if self.tries > 1 else "one search"
        rows = f" over {self.searched} of {problem.space.count} combinations" if problem.space.count > 1 else ""
        lines += [f"  {each}." for each in self.cut]
        spans = domain_words(self.machine.judge(problem.over)) if problem.over else "the whole stroke"
        lines.append(f"  {tries}{rows}; {self.evaluations} designs looked at. Assembled over {spans}.")
        declared = problem.plan.of_kind(Over)
        if declared and not problem.over:
            lines.append(f"  A search does not run along {', '.join(declared)}: ask the design found, machine.answers([...]).")
        if self.limit is not None:
            lines.append(f"  The limit of {self.limit} designs was reached: this is the best so far. A larger limit= looks at more.")
        return "\n".join(lines)

    __repr__ = __str__

    def rounded(self, to: float = 1.0 * mm, angle: float = 0.1 * deg) -> Rounded:
        """Return the design with its dimensions on steps, as a drawing gives them.

        Of the steps about each value those are taken that keep every condition and cost least; where none does, the one that misses least,
        and it says so.

        Parameters
        ----------
        to : float, optional
            The step of lengths [m], 1 mm by default.
        angle : float, optional
            The step of angles [rad], 0.1 deg by default.

        Returns
        -------
        Rounded
            The rounded design.
        """
        problem, judged = self.problem, []
        units = problem.space.unit(rounded_values(self.machine, problem.space, self.unit, to, angle, MOST_ROUNDINGS))
        with problem.count.without_limit():
            for place in EvaluatedDesigns.looked_at(problem, self.combination, units).order(MET)[:8] if problem.space.variables else [0]:
                machine = problem.machine_of(units[place], self.combination)
                value, missing = worth_of(problem, machine)
                if np.isfinite(value):
                    judged.append(((missing if missing > MET else 0.0, problem.sense * value), value, missing, machine))
        if not judged:
            raise AssemblyError(f"{problem.plan.title}: no design on these steps can be assembled over the whole stroke; take finer ones.")
        _, value, missing, machine = min(judged, key=itemgetter(0))
        cost = problem.sense * (value - self.value) / (abs(self.value) or 1.0)
        unit, variables = unit_of_measure(problem.plan, problem.objectives[0]), problem.space.variables
        settings = ", ".join(f"{each.name} = {each.show(each.sign * float(machine.dimensions[each.owner]))}" for each in variables)
        change = f"{100.0 * abs(cost):.2g} % {'worse' if cost >= 0.0 else 'better'} than" if abs(cost) > NOISE else "as good as"
        text = f"{settings}: {problem.objectives[0]} = {show(value, unit)}, {change} unrounded."
        if missing > MET:
            remedy = "take finer steps, or tighten the condition before"
            text += f" No design on these steps keeps every condition; this one misses by {100.0 * missing:.2g} %: {remedy}."
        return Rounded(machine, value, cost, missing, text)

    def rows(self, rounded: Rounded | None = None) -> tuple[ResultRow, ...]:
        """Return the variables, the objective and the conditions, before and after, and of a rounded design too.

        Parameters
        ----------
        rounded : Rounded, optional
            The rounded design, as another column.

        Returns
        -------
        tuple of ResultRow
            The rows.
        """
        problem, plan = self.problem, self.problem.plan
        machines = [self.start, self.machine, *([rounded.machine] if rounded else [])]
        at_end = {each.variable.name: each for each in self.bounds}
        nan, rows = float("nan"), []
        for name in tried_names(problem.space):
            owner, sign = plan.table.spellings[name]
            before, after, last = [*(sign * float(each.dimensions[owner]) for each in machines), nan][:3]
            end = at_end.get(name)
            by, gain = (end.change, end.gain) if end else ("", 0.0)
            rows.append(ResultRow("variable", name, unit_of(plan, name), before, after, last, gain=gain, by=by))
        last, unit = rounded.value if rounded else nan, unit_of_measure(plan, problem.objectives[0])
        rows.append(ResultRow("objective", str(problem.objectives[0]), unit, self.start_value, self.value, last))
        with problem.count.without_limit():
            known = [numbers_judged(problem, each)[0] for each in machines]
        for kept in self.conditions:
            side = kept.constraint.left
            before, after, last = [*(nan if each is None else float(side.from_leaves(each.__getitem__)) for each in known), nan][:3]
            name, gain = f"{side} {kept.constraint.symbol}", kept.gain
            rows.append(ResultRow("condition", name, kept.units, before, after, last, kept.right, kept.spare, gain, "1 % less strict"))
        return tuple(rows)

    def table(self, rounded: Rounded | None = None) -> str:
        """Return the rows as aligned text.

        Parameters
        ----------
        rounded : Rounded, optional
            The rounded design, as another column.

        Returns
        -------
        str
            The lines of the table.
        """
        # columns that hold nothing are left out
        cells = result_cells(self.rows(rounded), ".6g", ".2g")
        kept = [place for place in range(len(RESULT_HEADINGS)) if any(line[place] for line in cells[1:])]
        words = {number for number, place in enumerate(kept) if RESULT_HEADINGS[place] in ("what", "name", "unit", "for")}
        return text_columns([[line[place] for place in kept] for line in cells], words)

    def csv(self, path: Place, rounded: Rounded | None = None) -> None:
        """Write the rows into a CSV file, in full precision.

        Parameters
        ----------
        path : str or Path
            The file.
        rounded : Rounded, optional
            The rounded design, as another column.

        Raises
        ------
        FileError
            The file cannot be written.
        """
        with replacing_text(path) as stream:
            csv.writer(stream).writerows(result_cells(self.rows(rounded)))

    def designs_csv(self, path: Place) -> None:
        """Write every design that was looked at into a CSV file: its dimensions, its objective, and the part missing of a condition.

        Parameters
        ----------
        path : str or Path
            The file.

        Raises
        ------
        FileError
            The file cannot be written.
        """
        plan, objective = self.problem.plan, self.problem.objectives[0]
        units = [(name, unit_of(plan, name)) for name in tried_names(self.tried[0].space)]
        units += [(str(objective), unit_of_measure(plan, objective)), ("missing", "")]
        sizes = [factor(shown_in(unit)) for _, unit in units]
        with replacing_text(path) as stream:
            writer = csv.writer(stream)
            writer.writerow(["stage", *(heading_with_unit(*each) for each in units)])
            for stage, *row in tried_rows(self.tried):
                writer.writerow([stage, *("" if each != each else repr(each / size) for each, size in zip(row, sizes, strict=True))])

    def designs_jsonl(self, path: Place) -> None:
        """Write every design that was looked at into a file of JSON lines, in SI; null where there is no value.

        Parameters
        ----------
        path : str or Path
            The file.

        Raises
        ------
        FileError
            The file cannot be written.
        """
        names = [*tried_names(self.tried[0].space), "value", "missing"]
        with replacing_text(path) as stream:
            for stage, *row in tried_rows(self.tried):
                numbers = (each if np.isfinite(each) else None for each in row)
                stream.write(json.dumps({"stage": stage, **dict(zip(names, numbers, strict=True))}) + "\n")


# The winner, on its steps and judged.


def described(problem: Problem, found: SearchEnd, ended: Sequence[SearchEnd], searched: int, cut: Sequence[str]) -> Optimum:
    """Return an optimum with all that is said of it; AssemblyError where it cannot be assembled over the whole stroke."""
    machine = problem.machine_of(found.unit, found.combination)
    problem.assembled(machine)
    if not found.feasible:
        raise AssemblyError(f"{problem.plan.title}: the design on its steps misses the conditions.")
    now = problem.truths(machine.dimensions)
    value = true_worth(problem, now)
    if not np.isfinite(value):
        raise AssemblyError(f"{problem.plan.title}: {', '.join(map(str, problem.objectives))} has no value of the best design.")
    check_bounded(problem, now, found)
    local = Local(problem, found.combination, found.unit)
    local.refine(found.unit)
    of_constraints, of_bounds, ways = multipliers(local, found.unit)
    part = local.size / (abs(value) or 1.0)
    values = problem.space.values(found.unit)
    conditions, bounds = [], []
    for each, price, scale in zip(problem.constraints, of_constraints, local.scales, strict=True):
        left, right = (float(side.from_leaves(lambda leaf: now[leaf])) for side in each.compared)
        size = max((abs(side) for side in (left, right) if np.isfinite(side)), default=0.0)
        by = 0.01 * (size if size > 1e-6 * scale else scale)  # the scale is the size of what is compared
        gain = part * price / scale * by
        spare, units = -each.short(left, right), unit_of_constraint(problem.plan, each)
        conditions.append(ConditionSpare(each, left, right, spare, by, gain if gain > SHOWN else 0.0, units))
    for variable, at, price in zip(problem.space.variables, values, of_bounds, strict=True):
        by = SAID_STEPS.get(variable.unit, 0.01 * variable.span)
        if part * price * by / variable.span > SHOWN:
            upper = bool(at - variable.low > 0.5 * variable.span)
            bounds.append(AtBound(variable, float(at), upper, by, part * price * by / variable.span))
    start_value, start_missing = worth_of(problem, problem.machine)
    good = [each for each in ended if each.feasible]
    agreed = sum(abs(each.value - found.value) <= SAME * max(abs(found.value), 1e-300) for each in good)
    variables = {each.name: float(at) for each, at in zip(problem.space.variables, values, strict=True)}
    best = Optimum(
        machine, problem.machine, value, start_value, start_missing, tuple(conditions), tuple(bounds), variables, max(agreed, 1),
        len(ended), searched, tuple(cut), problem.count.designs, problem, found.unit, found.combination,
    )  # fmt: skip
    return replace(best, edges=tuple(edges(problem, found, ways, part)))


def numbers_judged(problem: Problem, machine: Mechanism) -> tuple[LeafNumbers | None, float]:
    """Return the leaves' numbers of a machine, between the poses too, and its misses in parts of the conditions' sizes.

    None, and infinite, where it cannot be assembled over the whole stroke.
    """
    try:
        problem.assembled(machine)
    except AssemblyError:
        return None, float("inf")
    values = problem.truths(machine.dimensions)
    scales = scales_of(problem, problem.evaluated(machine.dimensions, slopes=True))
    return values, missing_of(problem.constraints, scales, values)


def worth_of(problem: Problem, machine: Mechanism) -> tuple[float, float]:
    """Return the objective of a machine and its misses; NaN where it cannot be assembled."""
    values, missing = numbers_judged(problem, machine)
    return float("nan") if values is None else true_worth(problem, values), missing


def multipliers(local: Local, unit: FloatArray) -> tuple[FloatArray, FloatArray, tuple[FloatArray, FloatArray]]:
    """Return the limits of a design in scaled numbers: the prices of constraints and of variables' bounds, zero or above, and two ways on.

    The prices are the Lagrange multipliers that leave least of the objective's derivatives unexplained; zero where a derivative is
    infinite, at a dead point. On the ways, by the unit coordinates (n,), the objective gets better: what of its derivatives nothing of
    these explains, and the sum of the slopes of loops that can just be assembled, by their prices.
    """
    from scipy.optimize import nnls

    z, n = local.first(unit), local.n
    _, slope = local.objective(z)
    columns, owners = [], []
    for row in local.solver_lines(z):
        for value, line in zip(row.values, row.slopes, strict=True):
            if (row.equation or value <= ACTIVE) and np.abs(line).max() > STILL:
                for sign in (1.0, -1.0) if row.equation else (1.0,):
                    columns.append(sign * line)
                    owners.append(MARGINS if row.is_reach else row.constraint)
    count, at_bounds = len(columns), []
    for place in range(n):
        for at_end, sign in ((unit[place] <= ACTIVE, 1.0), (unit[place] >= 1.0 - ACTIVE, -1.0)):
            if at_end:
                columns.append(sign * np.eye(local.width)[place])
                at_bounds.append(place)
    known = bool(np.isfinite(slope).all()) and all(bool(np.isfinite(line).all()) for line in columns)
    lines = np.array(columns).reshape(len(columns), local.width)
    prices = nnls(lines.T, np.asarray(slope, float))[0] if columns and known else np.zeros(len(columns))
    of_constraint, reach, of_bound = np.zeros(len(local.problem.constraints)), np.zeros(n), np.zeros(n)
    for price, owner, line in zip(prices, owners, lines, strict=False):
        if isinstance(owner, Constraint):
            of_constraint[[each is owner for each in local.problem.constraints]] += price
        elif owner == MARGINS:
            reach += price * line[:n]
    of_bound[at_bounds] = prices[count:]
    left = slope - prices @ lines if known else np.zeros(local.width)
    return np.where(of_constraint > 1e-9, of_constraint, 0.0), np.where(of_bound > 1e-9, of_bound, 0.0), (np.asarray(-left[:n]), -reach)


# What a machine itself allows, beside the conditions and the ranges.


def edges(problem: Problem, found: SearchEnd, ways: Sequence[FloatArray], part: float) -> list[str]:
    """Return the reasons why the machine itself stops a better design: links that no longer meet, a refusal.

    `ways` are those on which it would, `part` is what a scaled number of the objective is of it.
    """
    unit, variables, values = found.unit, problem.space.variables, problem.space.values(found.unit)
    sizes = [(way, float(np.abs(way).max(initial=0.0))) for way in ways]
    for way, step in product([way / size for way, size in sizes if part * size * EDGE > SHOWN], STEPS_BEYOND):
        beyond = np.clip(unit + step * way, 0.0, 1.0)
        try:
            machine = problem.machine_of(beyond, found.combination)
            problem.assembled(machine)
            look = problem.evaluated(machine.dimensions)
        except LinkageError as error:
            reason = what_of(str(error))
        else:
            lost = next((no_value(problem.plan, leaf) for leaf in problem.leaves if look.lost_of(leaf)[0]), "")
            reason = lost if look.is_assembled[0] else what_of(problem.refusal or "it cannot be assembled over the whole stroke")
        if reason:
            moved = [(each, at) for each, at, by in zip(variables, values, beyond - unit, strict=True) if abs(by) >= 0.3 * step]
            where = ", ".join(f"{each.name} = {each.show(float(at))}" for each, at in moved) or "The design"
            return [f"{where} {'stands' if len(moved) < 2 else 'stand'} at an edge of what the machine allows; beyond it: {reason}"]
    return []


def what_of(message: str) -> str:
    """Return the fault in a message, without the figures and the remedy, which belong to an intermediate design."""
    text = " ".join(message.split())
    return text.partition(": " if " cannot be assembled" in text else "; ")[0].rstrip(".")


def on_steps(problem: Problem, found: SearchEnd) -> tuple[Problem, SearchEnd]:
    """Return the problem with its stepped variables held on steps, and the best design there; AssemblyError where none is assembled.

    Without such variables it is what was given.

    Where everything goes in steps and there are not too many, it is the best of all of them, by few poses. Else the steps about each value
    are looked at, and the most promising of others. From the best of these on it goes a step up or down at a time, as long as that is
    better. The variables that are left are searched from each.
    """
    search, count = StepSearch(problem, found), problem.count
    if not search.stepped:
        return problem, found
    is_small = not search.rest and prod(search.counts) <= MOST_STEPS  # everything goes in steps, and all of them can be looked at
    if count.is_spent:
        search.look(search.about())
    elif is_small:
        every = np.array([*product(*map(range, search.counts))])
        units = every * np.array([each.step / each.span for each in search.stepped if each.step is not None])
        order = EvaluatedDesigns.looked_at(problem, found.combination, units).order(NEAR_KEPT)
        search.look([tuple(map(int, every[place])) for place in order[:JUDGED]])
    else:
        search.look([*search.about(), *search.promising()])
    while not is_small and search.best is not None and not count.is_spent:
        before, beside = search.best, []
        for place, steps in enumerate(search.counts):
            for by in (-1, 1):
                if 0 <= before[place] + by < steps:
                    beside.append((*before[:place], before[place] + by, *before[place + 1 :]))
        search.look(beside)
        if search.best == before:
            break
    if search.best is None:
        raise AssemblyError(f"{problem.plan.title}: none of the steps about the design can be assembled.")
    best = search.seen[search.best]
    assert best is not None
    return best


class StepSearch:
    """Designs on steps, by the numbers of their steps: `seen`, and the `best` of them."""

    def __init__(self, problem: Problem, found: SearchEnd) -> None:
        self.problem, self.found = problem, found
        self.stepped = tuple(each for each in problem.space.variables if each.step is not None)
        self.rest = tuple(each for each in problem.space.variables if each.step is None)
        self.counts = tuple(each.steps for each in self.stepped)
        self.seen: dict[tuple[int, ...], tuple[Problem, SearchEnd] | None] = {}
        self.best: tuple[int, ...] | None = None
        self._starts: dict[tuple[int, ...], FloatArray] = {}

    def about(self) -> list[tuple[int, ...]]:
        """Return the steps about the design that was found without them."""
        values = dict(zip(self.problem.space.variables, self.problem.space.values(self.found.unit), strict=True))
        near = [
            sorted({round((step - each.low) / each.step) for step in each.stepped(float(values[each]))})
            for each in self.stepped
            if each.step is not None
        ]
        return list(islice(product(*near), 64))

    def promising(self) -> list[tuple[int, ...]]:
        """Return the steps of the most promising designs spread over the box, by few poses, which are then searched from."""
        variables = self.problem.space.variables
        units = unit_points(SPREAD, len(variables), "sobol", 0)
        steps = np.zeros((SPREAD, len(self.stepped)), int)
        for place, (each, count) in enumerate(zip(self.stepped, self.counts, strict=True)):
            column = variables.index(each)
            steps[:, place] = np.minimum((units[:, column] * count).astype(int), count - 1)
            units[:, column] = steps[:, place] * (each.step or 0.0) / each.span
        seen = EvaluatedDesigns.looked_at(self.problem, self.found.combination, units)
        free = [place for place, each in enumerate(variables) if each.step is None]
        found: dict[tuple[int, ...], FloatArray] = {}
        for place in seen.order(NEAR_KEPT):
            if np.isfinite(seen.value[place]):
                found.setdefault(tuple(map(int, steps[place])), units[place, free])
            if len(found) == PROMISING:
                break
        self._starts = {each: unit for each, unit in found.items() if each not in self.seen}
        return [*found]

    def look(self, steps: Sequence[tuple[int, ...]]) -> None:
        """Search the variables that are left at some steps, and keep the best of all that were seen."""
        for each in steps:
            if each not in self.seen and not (self.problem.count.is_spent and any(self.seen.values())):
                self.seen[each] = self._searched(each)
        worth = {step: worth_in_order(self.problem, result[1]) for step, result in self.seen.items() if result is not None}
        self.best = min(worth, key=worth.__getitem__, default=None)

    def _searched(self, steps: tuple[int, ...]) -> tuple[Problem, SearchEnd] | None:
        """Return the problem with its stepped variables held at some steps, and the best design there; None where it is not assembled."""
        space = self.problem.space
        values = [each.low + (each.step or 0.0) * step for each, step in zip(self.stepped, steps, strict=True)]
        held = tuple((((each.owner, each.sign),), ((value,),)) for each, value in zip(self.stepped, values, strict=True))
        smaller = Space(self.rest, (*space.choices, *held), (*space.names, *((each.name,) for each in self.stepped)))
        inner, whole = self.problem.changed(space=smaller), (*self.found.combination, *(0 for _ in self.stepped))
        near = np.array([at for at, each in zip(self.found.unit, space.variables, strict=True) if each.step is None])
        found = []
        for unit in (near, *([self._starts[steps]] if steps in self._starts else [])):
            with suppress(DefinitionError):
                with inner.count.without_limit():
                    local = Local(inner, whole, unit)
                    judged = None if self.rest else local.judged(unit)
                found.append(judged or local_search(local))
        return (inner, min(found, key=lambda each: worth_in_order(inner, each))) if found else None


# Drawing dimensions.


@immutable
class Rounded(HasSentence):
    """A design on drawing dimensions: the machine, its objective [SI], the cost as a part, and its misses of the conditions."""

    machine: Mechanism
    value: float
    cost: float
    missing: float
    sentence: str

    @property
    def feasible(self) -> bool:
        """Whether it keeps every condition."""
        return self.missing <= MET


def rounded_values(machine: Mechanism, space: Space, unit: FloatArray, to: float, angle: float, most: int) -> FloatArray:
    """Return values (m, n) of the variables on steps of `to` [m] and `angle` [rad] about unit coordinates (n,), so many at the most.

    A variable that has steps of its own stays on these. DefinitionError for anything but steps finer than the machine.
    """
    for name, value, kind in (("to", to, "length"), ("angle", angle, "angle")):
        require_number(f"rounded({name}", value, "a step above zero is expected, such as 1 * mm", above=0.0, kind=kind)
    if to > COARSEST * size_of_machine(machine):
        raise DefinitionError(f"rounded({to:.6g}): steps of {to:.6g} m are as coarse as the machine; write {to:.6g} * mm if that is meant.")
    near = []
    for variable, value in zip(space.variables, space.values(unit).tolist(), strict=True):
        step = None if variable.step is not None else {"mm": to, "deg": angle}.get(variable.unit)
        if not step:
            near.append([value])
            continue
        low, high = np.ceil(variable.low / step - 1e-6), np.floor(variable.high / step + 1e-6)
        ends = f"{variable.show(variable.low)} to {variable.show(variable.high)}"
        ensure(low <= high, f"rounded: no step of {variable.show(step)} lies in {variable.name}'s range, {ends}; take finer steps.")
        place = value / step
        if abs(place - round(place)) < 1e-6:  # it stands on one to rounding
            near.append([round(place) * step])
        else:
            found = {float(np.clip(each, low, high)) * step for each in (np.floor(place), np.ceil(place))}
            near.append(sorted(found, key=lambda each: abs(each - value)))
    return np.array([*islice(product(*near), most)])


# Units of measures, for sentences.


def unit_of_measure(plan: Plan, measure: Measure) -> str:
    """Return the unit that a measure is shown in; "" for SI."""
    units = {unit_of_leaf(plan, leaf) for leaf in measure.leaves}
    simple = isinstance(measure, Leaf) or getattr(measure, "symbol", "") in ("+", "-")
    return (units.pop() if len(units) == 1 and simple else "") or measure_unit(plan, measure)


def unit_of_constraint(plan: Plan, constraint: Constraint) -> str:
    """Return the unit that a constraint's sides are shown in."""
    sides = [side for side in constraint.compared if side.leaves]
    units = {unit_of_measure(plan, side) for side in sides}
    return units.pop() if len(units) == 1 else measure_unit(plan, constraint)


def unit_of_leaf(plan: Plan, leaf: Leaf) -> str:
    """Return the unit that a leaf is shown in."""
    quantity: Any = leaf.bare_quantity
    if isinstance(leaf, Integral):
        return ""
    if isinstance(quantity, str) and quantity not in plan.members and quantity in plan.table.spellings:
        return unit_of(plan, quantity)
    return display_unit(measure_of(plan, quantity), "mm")


def constraint_words(plan: Plan, constraint: Constraint) -> str:
    """Return a constraint as text, its number in its unit."""
    return in_units(constraint, unit_of_constraint(plan, constraint))


def in_units(constraint: Constraint, units: str) -> str:
    """Return a constraint as text, its number in a unit."""
    sides = [show(side.value, units) if isinstance(side, FixedNumber) else str(side) for side in constraint.compared]
    return f"{sides[0]} {constraint.symbol} {sides[1]}"


@immutable
class EvaluatedDesigns:
    """Designs of one combination of choices: unit coordinates (m, n), the objective (m,) [SI], and the part missing of a condition (m,).

    `stage` says how closely they were looked at: "looked at" at few poses, or "searched", by a local search; `space` is what varied.
    NaN stands where a design cannot be assembled over the whole stroke; `reached` (m,) is the part of it where it can. `sense` is 1.0 where
    the objective is to be least, else -1.0.
    """

    stage: str
    space: Space
    combination: tuple[int, ...]
    unit: FloatArray
    value: FloatArray
    missing: FloatArray
    reached: FloatArray
    sense: float

    @classmethod
    def looked_at(cls, problem: Problem, combination: tuple[int, ...], unit: FloatArray) -> EvaluatedDesigns:
        """Return designs of a problem at its poses."""
        return cls("looked at", problem.space, combination, unit, *problem.merits(combination, unit), problem.sense)

    @classmethod
    def of_end(cls, problem: Problem, end: SearchEnd) -> EvaluatedDesigns:
        """Return the one design that a local search came to."""
        value, missing, reached = (np.array([float(each)]) for each in (end.value, end.missing, end.is_assembled))
        return cls("searched", problem.space, end.combination, end.unit[None], value, missing, reached, problem.sense)

    @property
    def begins(self) -> Mask:
        """At which of them a local search may begin: they are reached, and the objective has a value."""
        return np.asarray((self.reached == 1.0) & np.isfinite(self.value))

    def ranks(self, near: float = 1e-9) -> tuple[FloatArray, FloatArray]:
        """Return their ranks, (m,): their misses, none up to `near` of a condition, then the objective, less where it is better."""
        short = np.where(np.isfinite(self.missing), self.missing, 1e9) + 1e9 * (1.0 - self.reached)
        return np.where(short <= near, 0.0, short), np.where(np.isfinite(self.value), self.sense * self.value, np.inf)

    def order(self, near: float = 1e-9) -> Index:
        """Return the designs, the best first; misses up to `near` are none."""
        return np.lexsort(self.ranks(near)[::-1])

    @property
    def best(self) -> tuple[float, float]:
        """The rank of the best one."""
        short, worth = self.ranks()
        first = self.order()[0]
        return float(short[first]), float(worth[first])


def tried_names(space: Space) -> list[str]:
    """Return the names of the variables, then of the choices' dimensions."""
    return [*(each.name for each in space.variables), *(name for names in space.names for name in names)]


def heading_with_unit(name: str, unit: str) -> str:
    """Return a heading: `OB, mm`."""
    return f"{name}, {shown_in(unit)}" if unit else name


def tried_rows(tried: Sequence[EvaluatedDesigns]) -> Iterator[tuple[Any, ...]]:
    """Yield a row for each design: its stage, its dimensions and its objective [SI], and the part missing of a condition."""
    for part in tried:
        chosen = [value for (_, rows), row in zip(part.space.choices, part.combination, strict=True) for value in rows[row]]
        for own, value, missing in zip(part.space.values(part.unit).tolist(), part.value.tolist(), part.missing.tolist(), strict=True):
            yield part.stage, *own, *chosen, value, missing


# What varied, what was sought and what must be kept, before and after.

RESULT_HEADINGS = ("what", "name", "unit", "before", "after", "rounded", "limit", "to spare", "gain, %", "for")

ROUNDED_TO_NOTHING = 1e-9
"""Of a condition's size: less to spare than this is nothing."""


@record
class ResultRow:
    """A number before and after a search [SI], and the worth of more of it: `gain` is a part of the objective, `by` for how much less.

    NaN stands where there is no such number. `unit` is that in which the numbers are shown.
    """

    what: str
    name: str
    unit: str
    before: float
    after: float
    rounded: float = float("nan")
    limit: float = float("nan")
    spare: float = float("nan")
    gain: float = 0.0
    by: str = ""


def result_cells(rows: Sequence[ResultRow], digits: str = "", of_gain: str = "") -> list[list[str]]:
    """Return headings and rows, their numbers with so many digits, ".6g", in full precision without; a number that is none is empty."""
    cells = [list(RESULT_HEADINGS)]
    for row in rows:
        is_met, size = abs(row.spare) <= ROUNDED_TO_NOTHING * max(abs(row.after), abs(row.limit)), factor(shown_in(row.unit))
        values = (row.before, row.after, row.rounded, row.limit, 0.0 if is_met else row.spare)
        numbers = ["" if np.isnan(value) else f"{float(value / size):{digits}}" for value in values]
        gain = [f"{100.0 * float(row.gain):{of_gain}}", row.by] if row.gain else ["", ""]
        cells.append([row.what, row.name, shown_in(row.unit), *numbers, *gain])
    return cells
