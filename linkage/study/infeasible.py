"""Why no design keeps all conditions: which conflict, by how much, and the least relaxation that frees them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType

import numpy as np

from ..errors import LinkageError, StudyError
from ..frozen import immutable, record
from ..mechanism import Mechanism
from ..motion.measures import Constraint
from ..program import FloatArray
from ..units import show
from .measured import no_value
from .optimum import constraint_words, in_units, multipliers, unit_of_constraint
from .problem import COARSE, Problem, is_still
from .solver import Local, SearchEnd, scales_of

NOTHING: Mapping[tuple[int, ...], FloatArray] = MappingProxyType({})
MISSED = 1e-6
TRIED = 2
"""Ends of local searches from which is looked for the least that has to give way."""
ROUNDS, DESIGNS, POSES_AS_ONE = 3, 300, 70
"""How often poses are added to what a condition alone has to give way by, designs looked at for each, and poses that count as one."""
ALTERNATIVES = 6
"""Conditions that are looked at each for itself."""


@record
class Relaxation:
    """A condition that has to give way, by how much [SI], and the sentence that says so; `machine` is the design that it gives."""

    condition: Constraint
    by: float
    sentence: str
    machine: Mechanism


class InfeasibleError(StudyError):
    """No design in the box keeps all conditions.

    Parameters
    ----------
    message : str
        What is missing, and what would help.
    nearest : Mechanism
        The machine that misses the conditions least.
    relaxations : sequence of Relaxation
        What has to give way for it, all of them together.
    conflict : sequence of Constraint
        The conditions that pull against one another there.
    alternatives : sequence of Relaxation, optional
        Conditions of which one alone may give way, with all others met.
    """

    def __init__(
        self,
        message: str,
        nearest: Mechanism,
        relaxations: Sequence[Relaxation],
        conflict: Sequence[Constraint],
        alternatives: Sequence[Relaxation] = (),
    ) -> None:
        super().__init__(message)
        self.nearest, self.relaxations, self.conflict = nearest, tuple(relaxations), tuple(conflict)
        self.alternatives = tuple(alternatives)


def infeasible_error(problem: Problem, ended: Sequence[SearchEnd], looked: Mapping[tuple[int, ...], FloatArray] = NOTHING) -> StudyError:
    """Return the error of a search that found no design which keeps everything.

    `ended` are the ends of local searches, `looked` the unit coordinates (m, n) of designs of each combination that were looked at.
    """
    reached = sorted((each for each in ended if each.is_assembled), key=lambda each: each.missing)
    title = problem.plan.title
    if not reached:
        return StudyError(f"{title}: no search came to a design that can be assembled over the whole stroke; widen vary=.")
    nowhere = list(problem.constraints)  # those that have no value of any
    for end in reached:
        if not nowhere:
            break
        look = problem.evaluated(problem.dimensions_at(end.unit, end.combination))
        nowhere = [each for each in nowhere if look.lost_of(each.margin)[0]]
    if nowhere:
        why = " and ".join(no_value(problem.plan, leaf) for leaf in nowhere[0].margin.leaves)
        what = f"{constraint_words(problem.plan, nowhere[0])} is kept by no design that was found, for {why}"
        return StudyError(f"{title}: {what}. Ask for what has a value there, or widen vary=.")
    tried = [each for found in reached[:TRIED] if (each := given_way(problem, found, problem.constraints))]
    if not tried:
        return StudyError(f"{title}: no design in the box keeps all conditions.")
    best = min(tried, key=lambda each: each.total)
    relaxations = best.relaxations
    pulling = [each for each in best.pulling if each not in [one.condition for one in relaxations]]
    said = "; ".join(each.sentence for each in relaxations)
    if not said:
        why = " and ".join(no_value(problem.plan, leaf) for each in problem.objectives for leaf in each.leaves)
        return StudyError(f"{title}: of all designs that were found {why}. Ask for what has a value there, or take vary= narrower.")
    limits = ", ".join(constraint_words(problem.plan, each) for each in pulling)
    against = f" It pulls against {limits}." if pulling else ""
    alternatives = alternatives_to(problem, best, looked.get(best.found.combination))
    instead = "; or ".join(each.sentence for each in alternatives)
    alone = f" Or one condition gives way alone: {instead}." if instead else ""
    text = f"{title}: no design found in the box keeps all conditions. The one that misses least: {said}.{against}{alone}"
    return InfeasibleError(
        f"{text} Give way there by so much, or widen vary=.", best.machine, relaxations,
        [*(each.condition for each in relaxations), *pulling], alternatives,
    )  # fmt: skip


@immutable
class GivenWay:
    """A design whose conditions give way as little as possible: by how much in parts of their sizes, and their values then."""

    found: SearchEnd
    machine: Mechanism
    total: float
    relaxations: tuple[Relaxation, ...]
    pulling: tuple[Constraint, ...]


def given_way(problem: Problem, start: SearchEnd, elastic: Sequence[Constraint]) -> GivenWay | None:
    """Return the design near a start of which the conditions that are `elastic` give way least; None where there is none.

    Over a box of several strokes it is judged by its samples: to look between them for each takes longer than all the rest.
    """
    is_line = len([one for one in problem.ranges.values() if not is_still(one)]) < 2
    try:
        local = Local(problem, start.combination, start.unit, elastic=elastic)
        with problem.count.without_limit(int(DESIGNS / (1.0 + problem.poses / POSES_AS_ONE))):
            found = local.run(rounds=ROUNDS) if is_line or not local.n else local.least()
        if found is None:
            return None
        machine = problem.machine_of(found.unit, found.combination)
        problem.assembled(machine)
    except LinkageError:
        return None
    values = problem.truths(machine.dimensions) if is_line else local.evaluated_at(found.unit).of_one
    prices = multipliers(local, found.unit)[0] if problem.space.variables else np.zeros(len(problem.constraints))
    relaxations, pulling, total = [], [], 0.0
    scales = scales_of(problem, problem.evaluated(machine.dimensions, slopes=True))
    for each, price, scale in zip(problem.constraints, prices, scales, strict=True):
        left, right = (float(side.from_leaves(lambda leaf: values[leaf])) for side in each.compared)
        short = each.short(left, right)
        if values.lost.intersection(each.margin.leaves):
            return None
        units = unit_of_constraint(problem.plan, each)
        if short > MISSED * scale:
            way = "off" if each.symbol == "==" else "too much" if each.symbol == "<=" else "short"
            text = f"{in_units(each, units)} gets {show(left, units, 4)}, {show(short, units, 4)} {way}"
            relaxations.append(Relaxation(each, short, text, machine))
            total += short / scale
        elif price > 0.0:
            pulling.append(each)
    return GivenWay(found, machine, total, tuple(relaxations), tuple(pulling))


def alternatives_to(problem: Problem, best: GivenWay, looked: FloatArray | None) -> list[Relaxation]:
    """Return the conditions of which one alone can give way, with all others kept, the one that gives way least first.

    Each is looked for from the best design found, and from that of those looked at which comes nearest to it.
    """
    many = len(problem.constraints)
    if not problem.space.variables or many < 2:
        return []
    coarse = problem.sampled_apart(COARSE)
    missing = None if looked is None or not len(looked) else coarse.missing_of_each(best.found.combination, looked)
    found: list[tuple[float, Relaxation]] = []
    for row, each in list(enumerate(problem.constraints))[:ALTERNATIVES]:
        if len(best.relaxations) == 1 and best.relaxations[0].condition is each:
            continue  # it is that already
        starts = [best.found]
        if missing is not None and looked is not None:
            others = np.delete(missing, row, axis=0).max(axis=0)
            near = int(np.lexsort((missing[row], others))[0])
            short, is_whole = float(missing[:, near].max()), bool(np.isfinite(others[near]))
            starts.insert(0, SearchEnd(best.found.combination, looked[near], np.nan, short, is_whole))
        ends = [given_way(problem, start, [each]) for start in starts if start.is_assembled]
        alone = [end for end in ends if end is not None and [one.condition for one in end.relaxations] == [each]]
        if alone:
            least = min(alone, key=lambda end: end.total)
            found.append((least.total, least.relaxations[0]))
    return [each for _, each in sorted(found, key=lambda one: one[0])]
