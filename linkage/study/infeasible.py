"""Why no design keeps all conditions: which conflict, by how much, and the least relaxation that frees them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import final

import numpy as np

from ..errors import LinkageError, StudyError
from ..mechanism import Mechanism
from ..motion.measures import Constraint
from ..units import show
from .optimum import in_units, multipliers, true_values, unit_of_constraint
from .problem import Problem
from .solver import Found, Local, scales_of

MISSED = 1e-6


@final
@dataclass(frozen=True)
class Relaxation:
    """A condition that has to give way, by how much [SI], and the sentence that says so."""

    condition: Constraint
    by: float
    sentence: str


class InfeasibleError(StudyError):
    """No design in the box keeps all conditions.

    `nearest` is the machine that misses them least, `relaxations` what has to give way for it, `conflict` the conditions that pull
    against one another there.
    """

    def __init__(self, message: str, nearest: Mechanism, relaxations: Sequence[Relaxation], conflict: Sequence[Constraint]) -> None:
        super().__init__(message)
        self.nearest, self.relaxations, self.conflict = nearest, tuple(relaxations), tuple(conflict)


def infeasible_error(problem: Problem, ended: Sequence[tuple[tuple[int, ...], Found]]) -> StudyError:
    """Return the error of a search that found no design which keeps everything."""
    reached = sorted((each for each in ended if each[1].whole), key=lambda each: each[1].missing)
    if not reached:
        return StudyError(f"{problem.plan.title}: no search came to a design that can be assembled over the whole stroke; widen vary=.")
    best: tuple[float, Local, Found, tuple[int, ...]] | None = None
    for combination, found in reached[:4]:
        try:
            local = Local(problem, combination, found.unit, elastic=True)
            soft = local.run() if problem.space.variables else local.judged(found.unit)
        except LinkageError:
            continue
        total = given_way(problem, combination, soft)
        if best is None or total < best[0]:
            best = total, local, soft, combination
    if best is None:
        return StudyError(f"{problem.plan.title}: no design in the box keeps all conditions.")
    _, local, soft, combination = best
    machine = problem.machine_of(soft.unit, combination)
    values = true_values(problem, machine)
    relaxations, pulling = [], []
    prices = multipliers(local, soft.unit)[0] if problem.space.variables else np.zeros(len(problem.constraints))
    scales = scales_of(problem, problem.look(machine.dimensions, slopes=True))
    for each, price, scale in zip(problem.constraints, prices, scales, strict=True):
        left, right = (float(side.of(lambda leaf: values[leaf])) for side in (each.left, each.right))
        short = abs(left - right) if each.symbol == "==" else (left - right if each.symbol == "<=" else right - left)
        units = unit_of_constraint(problem.plan, each)
        if short > MISSED * scale:
            text = f"{in_units(each, units)} gets {show(left, units, 4)}, {show(short, units, 3)} short"
            relaxations.append(Relaxation(each, short, text))
        elif price > 0.0:
            pulling.append(each)
    said = "; ".join(each.sentence for each in relaxations)
    limits = ", ".join(in_units(each, unit_of_constraint(problem.plan, each)) for each in pulling)
    against = f" It pulls against {limits}." if pulling else ""
    text = (
        f"{problem.plan.title}: no design found in the box keeps all conditions. The one that misses least: {said}.{against} "
        "Give way there by so much, or widen vary=."
    )
    return InfeasibleError(text, machine, relaxations, [*(each.condition for each in relaxations), *pulling])


def given_way(problem: Problem, combination: Sequence[int], found: Found) -> float:
    """Return by how much all conditions together are missed, in parts of their sizes."""
    machine = problem.machine_of(found.unit, combination)
    values, total = true_values(problem, machine), 0.0
    for each, scale in zip(problem.constraints, scales_of(problem, problem.look(machine.dimensions, slopes=True)), strict=True):
        margin = float(each.margin.of(lambda leaf: values[leaf])) / scale
        total += abs(margin) if each.symbol == "==" else max(-margin, 0.0)
    return total if np.isfinite(total) else np.inf
