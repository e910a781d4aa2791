"""Poles of an objective: numbers that it is divided by and that come to zero in the box, so that it has no bound there."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, cast

import numpy as np

from ..errors import StudyError, unwarned
from ..motion import Motion
from ..motion.judge import MET
from ..motion.measures import At, Measure, words_of
from ..program import FloatArray
from .measured import divisors_of
from .problem import LeafNumbers, Problem, terms_size
from .solver import SearchEnd, divisors
from .space import unit_points

NEXT_TO_NOTHING = 1e-4
"""A divisor that is smaller than this part of its usual size has come to zero."""
SPREAD, HALVINGS, FAR, TINY = 64, 40, 1e6, 1e-300
"""Designs over the box at which divisors are looked at, halvings towards a zero of one; a value that is so many times the usual
has no bound; the least number that is divided by."""


def check_bounded(problem: Problem, now: LeafNumbers, best: SearchEnd) -> None:
    """Raise StudyError where the objective has no bound: a number that it is divided by comes to zero in the box.

    `now` are the numbers of the best design. A pole at which the objective is worse than there is none.
    """
    problem, combination, unit = problem.sampled_apart(problem.counts, counted=False), best.combination, best.unit
    asked, named = divisors(problem.objectives), f"{problem.plan.title}: {', '.join(map(str, problem.objectives))}"
    n = len(problem.space.variables)
    parts = (0.1, 0.5, 0.9) if asked else ()
    looks = [problem.evaluated(problem.dimensions_at(np.full(n, part), combination)).leaf_sizes for part in parts]
    sizes = {leaf: max(look[leaf] for look in looks) for leaf in problem.leaves} if asked else {}
    for each in asked:
        small = abs(float(each.from_leaves(lambda leaf: now[leaf])))
        if small <= NEXT_TO_NOTHING * terms_size(each, sizes, now):
            raise boundless_error(named, each, "subject_to=[{} >= ...]")
    units = np.concatenate([unit[None], unit_points(SPREAD, n, "sobol", 0)])
    seen = values_at(problem, units, combination)
    known = np.abs(seen["objective"][np.isfinite(seen["objective"])])
    if known.size and abs(float(problem.value(lambda leaf: np.float64(now[leaf])))) > FAR * max(float(np.median(known)), TINY):
        raise boundless_error(named, None, "")
    for name, each in zip([key for key in seen if key != "objective"], divided_by(problem), strict=True):
        signs = np.sign(seen[name])
        other = np.flatnonzero(signs == -signs[0])
        if not other.size:
            continue
        ends = np.stack([unit, units[other[0]]])  # two designs between which it passes zero
        usual = abs(values_at(problem, unit[None], combination)["objective"][0])
        for _ in range(HALVINGS):
            middle = 0.5 * (ends[0] + ends[1])
            near = values_at(problem, np.stack([*ends, middle]), combination)[name]
            if not np.isfinite(near[2]):
                break
            ends[int(np.sign(near[2]) != np.sign(near[0]))] = middle
        else:
            found = problem.sense * values_at(problem, ends, combination)["objective"]
            if np.any(found < -FAR * max(float(usual), TINY)):
                raise boundless_error(named, each, "subject_to=[{} >= ...]")


def boundless_error(named: str, divisor: object, remedy: str) -> StudyError:
    """Return the error of a number without a bound, with its divisor where that is known."""
    if divisor is None:
        text = "grows without bounds in the box, as at a pole; keep what it is divided by away from zero"
    else:
        words = str(divisor) if isinstance(divisor, Measure) else words_of(divisor)
        text = f"has no bound in the box, for {words} comes to zero there; keep it away from zero, {remedy.format(words)}"
    return StudyError(f"{named} {text}, or take vary= narrower.")


def divided_by(problem: Problem) -> list[Measure]:
    """Return the measures that objectives are divided by, those within values at one pose too."""
    at_poses = {leaf for each in problem.objectives for leaf in each.leaves if isinstance(leaf, At)}
    inner = [At(each, leaf.strokes) for leaf in at_poses for each in divisors_of(problem.plan, leaf.quantity)]
    return [*divisors(problem.objectives), *inner]


def values_at(problem: Problem, units: FloatArray, combination: Sequence[int]) -> dict[str, FloatArray]:
    """Return the objective and its divisors at designs (m, n), each (m,); NaN where one cannot be assembled or misses much."""
    designs = problem.dimensions_at(units, combination)
    look = problem.evaluated(designs)
    numbers, found, nothing = dict(look.numbers), {}, np.zeros(len(units))
    with unwarned(), np.errstate(all="ignore"):
        found["objective"] = problem.value(numbers.__getitem__) + nothing
        for number, each in enumerate(divided_by(problem)):
            if isinstance(each, At) and each not in numbers:
                start = {name: stroke.start for name, stroke in problem.plan.strokes.items()} | dict(each.strokes)
                motion = Motion(problem.plan, designs, {name: np.asarray(value, float) for name, value in start.items()}, "nan")
                numbers[each] = np.ravel(np.asarray(motion.value(cast(Any, each.quantity)), float))
            found[f"divisor {number}"] = each.from_leaves(numbers.__getitem__) + nothing
        spare = [each.margin.from_leaves(numbers.__getitem__) + nothing for each in problem.constraints]
    kept = np.all([margin >= -MET for margin in spare], axis=0) if spare else np.ones(len(units), bool)
    whole = np.broadcast_to(np.asarray(look.is_assembled, bool), (len(units),))
    return {name: np.where(whole & kept, value, np.nan) for name, value in found.items()}
