"""What a search found: the design, what limits it, what more of it would give, and how sure it is."""

from __future__ import annotations

import csv
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import islice, product
from typing import Any, final

import numpy as np

from ..disk import Place, replacing_text
from ..errors import AssemblyError, DefinitionError, cited
from ..mechanism import Mechanism
from ..plan import Plan
from ..program import FloatArray
from ..quantities import is_number
from ..units import deg, display_unit, mm, show
from .checks import unit_of
from .measured import measure_of
from .measures import Constraint, Given, Integral, Leaf, Measure, Worst
from .problem import Problem
from .result_rows import ResultRow, result_text, write_result
from .solver import MET, Found, Local, missing_of, scale_of, scales_of
from .space import Space, Varied
from .tried import Tried, tried_header, tried_names, tried_rows

ACTIVE = 1e-6
"""A condition with no more than this part of its size to spare is active."""
SAME = 1e-6
"""Objectives that differ by less than this part of their size are the same."""
SHOWN = 1e-6
"""A gain of less than this part of the objective is none."""
NOISE = 1e-9
"""A number [SI] that is smaller is shown as zero."""
MOST_ROUNDINGS = 4096


@final
@dataclass(frozen=True, eq=False)
class Kept:
    """A condition of a design: its two sides [SI], what is to spare (below zero: missing), and whether it is active.

    `gain` is by what part the objective would be better if the condition gave way by 1 % of its size.
    """

    constraint: Constraint
    left: float
    right: float
    spare: float
    gain: float
    units: str

    @property
    def active(self) -> bool:
        """Whether nothing is to spare."""
        return self.gain > 0.0

    def __str__(self) -> str:
        value, limit = (show(without_noise(each), self.units) for each in (self.left, self.right))
        said = f"{in_units(self.constraint, self.units)}: {value}"
        if not isinstance(self.constraint.right, Given):
            said += f" against {limit}"
        if not self.active or self.constraint.symbol == "==" or max(abs(self.left), abs(self.right)) < NOISE:
            return f"{said}, active" if self.active else said
        return f"{said}, active: 1 % less strict gives {100.0 * self.gain:.2g} % more"


@final
@dataclass(frozen=True, eq=False)
class AtBound:
    """A variable that stands at an end of its range, and by what part the objective would be better `by` so much farther [SI]."""

    variable: Varied
    value: float
    is_upper: bool
    by: float
    gain: float

    def __str__(self) -> str:
        end = "upper" if self.is_upper else "lower"
        change = f"{self.variable.show(self.by)} {'more' if self.is_upper else 'less'}"
        return f"{self.variable.name} = {self.variable.show(self.value)} is at its {end} end: {change} gives {100.0 * self.gain:.2g} % more"


@final
@dataclass(frozen=True, eq=False)
class Optimum:
    """The best design found, assembled over the whole stroke.

    `machine` is the design, `value` its objective [SI], `start_value` that of the design it began with (NaN where that cannot be
    assembled). `conditions` say what each condition has to spare and which are active, `bounds` which variables stand at their ends.
    `agreed` of `tries` local searches came to this value; `cut` says which combinations of choices cannot keep a condition, whatever the
    variables.
    """

    machine: Mechanism
    start: Mechanism
    value: float
    start_value: float
    start_missing: float
    conditions: tuple[Kept, ...]
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
    tried: tuple[Tried, ...] = ()

    @property
    def gain(self) -> float:
        """By what part of the start's objective it is better; NaN where the start cannot be assembled."""
        if not np.isfinite(self.start_value) or self.start_value == 0.0:
            return float("nan")
        return float(-self.problem.sense * (self.value - self.start_value) / abs(self.start_value))

    @property
    def active(self) -> tuple[Kept, ...]:
        """The conditions that limit it."""
        return tuple(each for each in self.conditions if each.active)

    def __str__(self) -> str:
        problem, units = self.problem, unit_of_measure(self.machine.plan, self.problem.objectives[0])
        word = "least" if problem.sense > 0.0 else "greatest"
        lines = [f"{problem.plan.title}: the {word} {problem.objectives[0]} found is {show(self.value, units)}{self._gained(units)}."]
        lines += [f"  {name} = {text}" for name, text in self._settings()]
        lines += [f"  {each}." for each in (*self.conditions, *self.bounds)]
        tries = f"{self.agreed} of {self.tries} searches came to it" if self.tries > 1 else "one search"
        rows = f" over {self.searched} of {problem.space.count} combinations" if problem.space.count > 1 else ""
        lines += [f"  {each}." for each in self.cut]
        lines.append(f"  {tries}{rows}; {self.evaluations} designs looked at. Assembled over the whole stroke.")
        return "\n".join(lines)

    __repr__ = __str__

    def _gained(self, units: str) -> str:
        if not np.isfinite(self.start_value):
            return ""
        if self.start_missing > MET or not np.isfinite(self.gain):
            return f"; {show(self.start_value, units)} to begin with{', which misses the conditions' if self.start_missing > MET else ''}"
        if abs(self.gain) < SAME:
            return ", as to begin with"
        return f", {100.0 * self.gain:.3g} % better than {show(self.start_value, units)} to begin with"

    def _settings(self) -> list[tuple[str, str]]:
        found = [(each.name, each.show(self.variables[each.name])) for each in self.problem.space.variables]
        words = self.problem.space.words(self.combination, self.problem.plan)
        return [*found, *(tuple(part.split(" = ", 1)) for part in words.split(", ") if part)]  # type: ignore[list-item]

    def rounded(self, to: float = 1.0 * mm, angle: float = 0.1 * deg) -> Rounded:
        """Return the design with its lengths on steps of `to` [m] and its angles on steps of `angle` [rad], as a drawing gives them.

        Of the steps about each value those are taken that keep every condition and cost least; where none does, the one that misses
        least, and it says so.
        """
        return rounded_design(self, to, angle)

    def rows(self, rounded: Rounded | None = None) -> tuple[ResultRow, ...]:
        """Return what varied, the objective and the conditions, before and after, and of a rounded design too."""
        return result_rows(self, rounded)

    def table(self, rounded: Rounded | None = None) -> str:
        """Return the rows as aligned text."""
        return result_text(self.rows(rounded))

    def csv(self, path: Place, rounded: Rounded | None = None) -> None:
        """Write the rows into a CSV file, in full precision; FileError where it cannot be written."""
        with replacing_text(path) as stream:
            write_result(self.rows(rounded), stream)

    def designs_csv(self, path: Place) -> None:
        """Write every design that was looked at into a CSV file: its dimensions, its objective, and the part missing of a condition."""
        units = unit_of_measure(self.problem.plan, self.problem.objectives[0])
        with replacing_text(path) as stream:
            writer = csv.writer(stream)
            writer.writerow(tried_header(self.problem.space, self.problem.plan, str(self.problem.objectives[0]), units))
            for row in tried_rows(self.problem.space, self.problem.plan, units, self.tried):
                writer.writerow("" if each != each else each if isinstance(each, str) else repr(each) for each in row)

    def designs_jsonl(self, path: Place) -> None:
        """Write every design that was looked at into a file of JSON lines, in SI; null stands for what has no value."""
        names = [*tried_names(self.problem.space), "value", "missing"]
        with replacing_text(path) as stream:
            for stage, *row in tried_rows(self.problem.space, None, "", self.tried):
                numbers = (each if isinstance(each, float) and np.isfinite(each) else None for each in row)
                stream.write(json.dumps({"stage": stage, **dict(zip(names, numbers, strict=True))}) + "\n")


# The winner, on its steps and judged.


def polished(
    problem: Problem,
    combination: Sequence[int],
    found: Found,
    ended: Sequence[Found],
    searched: int,
    solver: str,
    cut: Sequence[str],
) -> Optimum:
    """Return an optimum; AssemblyError where it cannot be assembled over the whole stroke."""
    if any(each.step is not None for each in problem.space.variables):
        problem, combination, found = on_steps(problem, combination, found, solver)
    machine = problem.machine_of(found.unit, combination)
    problem.assembled(machine)
    if not found.feasible:
        raise AssemblyError(f"{problem.plan.title}: the design on its steps misses the conditions.")
    now = true_values(problem, machine)
    local = Local(problem, combination, found.unit)
    local.refine(found.unit)
    prices, ends = multipliers(local, found.unit)
    value = float(problem.value(lambda leaf: now[leaf]))
    part = local.size / (abs(value) or 1.0)
    conditions = tuple(
        as_kept(problem, each, now, part * price / scale)
        for each, price, scale in zip(problem.constraints, prices, local.scales, strict=True)
    )
    values = problem.space.values(found.unit)
    bounds = []
    for variable, at, price in zip(problem.space.variables, values, ends, strict=True):
        by = step_of(variable)
        if part * price * by / variable.span > SHOWN:
            upper = bool(at - variable.low > 0.5 * variable.span)
            bounds.append(AtBound(variable, float(at), upper, by, part * price * by / variable.span))
    start_value, start_missing = worth_of(problem, problem.machine)
    good = [each for each in ended if each.feasible]
    agreed = sum(abs(each.value - found.value) <= SAME * max(abs(found.value), 1e-300) for each in good)
    return Optimum(
        machine, problem.machine, value, start_value, start_missing, conditions, tuple(bounds),
        {each.name: float(at) for each, at in zip(problem.space.variables, values, strict=True)},
        max(agreed, 1), len(ended), searched, tuple(cut), problem.looked_at, problem, found.unit, tuple(combination),
    )  # fmt: skip


def as_kept(problem: Problem, constraint: Constraint, now: Mapping[Leaf, float], price: float) -> Kept:
    """Return how a design keeps a constraint, by its leaves' numbers and by what part the objective gains for one [SI] less of it."""
    left, right = (float(side.of(lambda leaf: now[leaf])) for side in (constraint.left, constraint.right))
    spare = -abs(right - left) if constraint.symbol == "==" else right - left if constraint.symbol == "<=" else left - right
    gain = 0.01 * price * (scale_of(constraint, lambda leaf: now[leaf]) or 1.0)
    return Kept(constraint, left, right, spare, gain if gain > SHOWN else 0.0, unit_of_constraint(problem.plan, constraint))


def true_values(problem: Problem, machine: Mechanism) -> dict[Leaf, float]:
    """Return the leaves' numbers of a machine, between the poses too."""
    return {leaf: problem.true(leaf, machine.dimensions)[0] for leaf in problem.leaves}


def worth_of(problem: Problem, machine: Mechanism) -> tuple[float, float]:
    """Return the objective of a machine and what it misses in parts of the conditions' sizes; NaN where it cannot be assembled."""
    try:
        problem.assembled(machine)
    except AssemblyError:
        return float("nan"), float("inf")
    values = true_values(problem, machine)
    scales = scales_of(problem, problem.look(machine.dimensions, slopes=True))
    return float(problem.value(lambda leaf: values[leaf])), missing_of(problem.constraints, scales, values)


def order_of_worth(problem: Problem, value: float, missing: float) -> tuple[float, float]:
    """Return by what designs are put in order, the best first: what is missing, then the objective."""
    return (missing if missing > MET else 0.0), problem.sense * value


def step_of(variable: Varied) -> float:
    """Return by how much a variable is said to change: 10 mm, 1 deg, or a hundredth of its range."""
    return {"mm": 10.0 * mm, "deg": 1.0 * deg}.get(variable.unit, 0.01 * variable.span)


def multipliers(local: Local, unit: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the price of each constraint and of each variable's bound, zero or above, in scaled numbers.

    They are the Lagrange multipliers that leave least of the objective's derivatives unexplained.
    """
    from scipy.optimize import nnls

    z = local.first(unit)
    _, slope = local.objective(z)
    columns, owners = [], []
    for row in local.rows(z):
        for value, line in zip(row.values, row.slopes, strict=True):
            if row.equation or value <= ACTIVE:
                for sign in (1.0, -1.0) if row.equation else (1.0,):
                    columns.append(sign * line)
                    owners.append(row.constraint)
    count = len(columns)
    for place in range(local.n):
        for at_end, sign in ((unit[place] <= ACTIVE, 1.0), (unit[place] >= 1.0 - ACTIVE, -1.0)):
            if at_end:
                line = np.zeros(local.width)
                line[place] = sign
                columns.append(line)
    prices = nnls(np.array(columns).T, np.asarray(slope, float))[0] if columns else np.zeros(0)
    of_constraint = np.zeros(len(local.problem.constraints))
    for price, owner in zip(prices[:count], owners, strict=True):
        of_constraint[[each is owner for each in local.problem.constraints]] += price
    of_bound, place = np.zeros(local.n), count
    for variable in range(local.n):
        for at_end in (unit[variable] <= ACTIVE, unit[variable] >= 1.0 - ACTIVE):
            if at_end:
                of_bound[variable] = prices[place]
                place += 1
    return np.where(of_constraint > 1e-9, of_constraint, 0.0), np.where(of_bound > 1e-9, of_bound, 0.0)


def on_steps(problem: Problem, combination: Sequence[int], found: Found, solver: str) -> tuple[Problem, tuple[int, ...], Found]:
    """Return the problem with its stepped variables held on steps, and the best design there: the steps about each value are tried.

    The variables that are left are searched again from each.
    """
    space = problem.space
    values = space.values(found.unit)
    stepped = [(place, each) for place, each in enumerate(space.variables) if each.step is not None]
    rest = tuple(each for each in space.variables if each.step is None)
    tried: list[tuple[Problem, tuple[int, ...], Found]] = []
    for steps in islice(product(*(each.stepped(float(values[place])) for place, each in stepped)), 64):
        held = tuple((((each.owner, each.sign),), ((step,),)) for (_, each), step in zip(stepped, steps, strict=True))
        smaller = Space(rest, (*space.choices, *held), (*space.names, *((each.name,) for _, each in stepped)))
        inner = problem.with_space(smaller)
        whole = (*combination, *(0 for _ in stepped))
        unit = np.array([found.unit[place] for place, each in enumerate(space.variables) if each.step is None])
        try:
            local = Local(inner, whole, unit)
        except DefinitionError:
            continue
        tried.append((inner, whole, local.run(solver) if rest else local.judged(unit)))
    if not tried:
        raise AssemblyError(f"{problem.plan.title}: none of the steps about the design can be assembled.")
    best = min(tried, key=lambda each: (not each[2].feasible, problem.sense * each[2].value))
    best[0].looked_at = problem.looked_at + sum(each[0].looked_at for each in tried)
    return best


# Drawing dimensions.


@final
@dataclass(frozen=True, eq=False)
class Rounded:
    """A design on drawing dimensions: the machine, its objective [SI], what that costs as a part, and what is missing of the conditions."""

    machine: Mechanism
    value: float
    cost: float
    missing: float
    sentence: str

    @property
    def feasible(self) -> bool:
        """Whether it keeps every condition."""
        return self.missing <= MET

    def __str__(self) -> str:
        return self.sentence


def rounded_design(optimum: Optimum, to: float, angle: float) -> Rounded:
    """Return an optimum on drawing dimensions; see `Optimum.rounded`."""
    for name, value in (("to", to), ("angle", angle)):
        if not is_number(value) or value <= 0.0:
            raise DefinitionError(f"rounded({name}={cited(value)}): a step above zero is expected, such as 1 * mm.")
    problem, space = optimum.problem, optimum.problem.space
    values = space.values(optimum.unit)
    near = []
    for variable, value in zip(space.variables, values, strict=True):
        step = {"mm": to, "deg": angle}.get(variable.unit)
        near.append(steps_about(float(value), step) if step else [float(value)])
    tried = list(islice(product(*near), MOST_ROUNDINGS))
    units = np.array([[(each - one.low) / (one.span or 1.0) for each, one in zip(row, space.variables, strict=True)] for row in tried])
    best: tuple[float, float, Mechanism] | None = None
    for place in most_promising(optimum, units)[:8]:
        machine = problem.machine_of(units[place], optimum.combination)
        worth = worth_of(problem, machine)
        if np.isfinite(worth[0]) and (best is None or order_of_worth(problem, *worth) < order_of_worth(problem, *best[:2])):
            best = *worth, machine
    if best is None:
        raise AssemblyError(f"{problem.plan.title}: no design on these steps can be assembled over the whole stroke; take finer ones.")
    now, short, machine = best
    cost = problem.sense * (now - optimum.value) / (abs(optimum.value) or 1.0)
    unit = unit_of_measure(problem.plan, problem.objectives[0])
    said = ", ".join(f"{each.name} = {each.show(each.sign * float(machine.dimensions[each.owner]))}" for each in space.variables)
    text = f"{said}: {problem.objectives[0]} = {show(now, unit)}, {100.0 * abs(cost):.2g} % {'worse' if cost >= 0.0 else 'better'}"
    text += " than unrounded."
    if short > MET:
        remedy = "take finer steps, or tighten the condition before"
        text += f" No design on these steps keeps every condition; this one misses by {100.0 * short:.2g} %: {remedy}."
    return Rounded(machine, now, cost, short, text)


def most_promising(optimum: Optimum, units: FloatArray) -> list[int]:
    """Return the numbers of designs (m, n) in the order of their worth at few poses."""
    problem = optimum.problem
    if not problem.space.variables:
        return [0]
    value, missing, _ = problem.merits(optimum.combination, units)
    short = np.nan_to_num(missing, nan=1e9, posinf=1e9)
    worth = np.where(np.isfinite(value), problem.sense * value, np.inf)
    return [int(place) for place in np.lexsort((worth, np.where(short <= MET, 0.0, short)))]


def steps_about(value: float, step: float) -> list[float]:
    """Return the two steps about a value, the nearer first; the one on which it stands to rounding alone."""
    place = value / step
    if abs(place - round(place)) < 1e-6:
        return [round(place) * step]
    return sorted((float(np.floor(place)) * step, float(np.ceil(place)) * step), key=lambda each: abs(each - value))


# Rows, for tables.


def result_rows(optimum: Optimum, rounded: Rounded | None) -> tuple[ResultRow, ...]:
    """Return an optimum as rows; see `Optimum.rows`."""
    problem, plan = optimum.problem, optimum.problem.plan
    machines = [optimum.start, optimum.machine, *([rounded.machine] if rounded else [])]
    at_end = {each.variable.name: each for each in optimum.bounds}
    nan, rows = float("nan"), []
    for name in tried_names(problem.space):
        owner, sign = plan.table.spellings[name]
        before, after, last = [*(sign * float(each.dimensions[owner]) for each in machines), nan][:3]
        end = at_end.get(name)
        by = f"{end.variable.show(end.by)} {'more' if end.is_upper else 'less'}" if end else ""
        gain = end.gain if end else 0.0
        rows.append(ResultRow("variable", name, unit_of(plan, name), before, after, last, gain=gain, by=by))
    last, unit = rounded.value if rounded else nan, unit_of_measure(plan, problem.objectives[0])
    rows.append(ResultRow("objective", str(problem.objectives[0]), unit, optimum.start_value, optimum.value, last))
    known = [true_values(problem, each) if is_assembled(problem, each) else None for each in machines]
    for kept in optimum.conditions:
        side = kept.constraint.left
        before, after, last = [*(nan if each is None else float(side.of(each.__getitem__)) for each in known), nan][:3]
        name, gain = f"{side} {kept.constraint.symbol}", kept.gain
        rows.append(ResultRow("condition", name, kept.units, before, after, last, kept.right, kept.spare, gain, "1 % less strict"))
    return tuple(rows)


def is_assembled(problem: Problem, machine: Mechanism) -> bool:
    """Return whether a machine can be assembled over the whole stroke."""
    try:
        problem.assembled(machine)
    except AssemblyError:
        return False
    return True


def without_noise(value: float) -> float:
    """Return a value to show: zero for what is rounding."""
    return 0.0 if abs(value) < NOISE else value


# Units of measures, for sentences.


def unit_of_measure(plan: Plan, measure: Measure) -> str:
    """Return the unit that a measure is shown in; "" for SI."""
    units = {unit_of_leaf(plan, leaf) for leaf in measure.leaves}
    simple = isinstance(measure, Leaf) or getattr(measure, "symbol", "") in ("+", "-")
    return units.pop() if len(units) == 1 and simple else ""


def unit_of_constraint(plan: Plan, constraint: Constraint) -> str:
    """Return the unit that a constraint's sides are shown in."""
    sides = [side for side in (constraint.left, constraint.right) if side.leaves]
    units = {unit_of_measure(plan, side) for side in sides}
    return units.pop() if len(units) == 1 else ""


def unit_of_leaf(plan: Plan, leaf: Leaf) -> str:
    """Return the unit that a leaf is shown in."""
    quantity: Any = leaf.quantity.quantity if isinstance(leaf.quantity, Worst) else leaf.quantity
    if isinstance(leaf, Integral):
        return ""
    if isinstance(quantity, str) and quantity not in plan.members and quantity in plan.table.spellings:
        return unit_of(plan, quantity)
    return display_unit(measure_of(plan, quantity), "mm")


def in_units(constraint: Constraint, units: str) -> str:
    """Return a constraint as text, its number in a unit."""
    sides = [show(side.value, units) if isinstance(side, Given) else str(side) for side in (constraint.left, constraint.right)]
    return f"{sides[0]} {constraint.symbol} {sides[1]}"
