"""Poles of an objective: numbers that it is divided by and that come to zero in the box, so that it has no bound there."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..errors import StudyError
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
    named, combination, unit = f"{problem.plan.title}: {', '.join(map(str, problem.objectives))}", best.combination, best.unit
    asked, n, remedy = divisors(problem.objectives), len(problem.space.variables), "subject_to=[{} >= ...]"
    at_poses = {leaf for each in problem.objectives for leaf in each.leaves if isinstance(leaf, At)}
    inner = [At(each, leaf.strokes) for leaf in at_poses for each in divisors_of(problem.plan, leaf.quantity)]
    wider = problem.changed(objectives=[*problem.objectives, *asked, *inner], count=None)
    looks = [wider.evaluated(wider.dimensions_at(np.full(n, part), combination)).leaf_sizes for part in ((0.1, 0.5, 0.9) if asked else ())]
    for each in asked:
        small = abs(float(each.from_leaves(lambda leaf: now[leaf])))
        if small <= NEXT_TO_NOTHING * terms_size(each, {leaf: max(look[leaf] for look in looks) for leaf in each.leaves}, now):
            raise boundless_error(named, each, remedy)
    units = np.concatenate([unit[None], unit_points(SPREAD, n, "sobol", 0)])
    worth, seen = values_at(wider, units, combination, len(problem.objectives))
    known = np.abs(worth[np.isfinite(worth)])
    if known.size and abs(float(problem.value(lambda leaf: np.float64(now[leaf])))) > FAR * max(float(np.median(known)), TINY):
        raise boundless_error(named, None, "")
    for row, each in enumerate([*asked, *inner]):
        signs = np.sign(seen[row])
        other = np.flatnonzero(signs == -signs[0])
        if not other.size:
            continue
        ends = np.stack([unit, units[other[0]]])  # two designs between which it passes zero
        for _ in range(HALVINGS):
            middle = 0.5 * (ends[0] + ends[1])
            first, _, near = values_at(wider, np.stack([*ends, middle]), combination, len(problem.objectives))[1][row]
            if not np.isfinite(near):
                break
            ends[int(np.sign(near) != np.sign(first))] = middle
        else:
            found = problem.sense * values_at(wider, ends, combination, len(problem.objectives))[0]
            if np.any(found < -FAR * max(float(abs(worth[0])), TINY)):
                raise boundless_error(named, each, remedy)


def boundless_error(named: str, divisor: object, remedy: str) -> StudyError:
    """Return the error of a number without a bound, with its divisor where that is known."""
    if divisor is None:
        text = "grows without bounds in the box, as at a pole; keep what it is divided by away from zero"
    else:
        words = str(divisor) if isinstance(divisor, Measure) else words_of(divisor)
        text = f"has no bound in the box, for {words} comes to zero there; keep it away from zero, {remedy.format(words)}"
    return StudyError(f"{named} {text}, or take vary= narrower.")


def values_at(problem: Problem, units: FloatArray, combination: Sequence[int], many: int) -> tuple[FloatArray, FloatArray]:
    """Return the worst of the first `many` objectives of designs (m, n), (m,), and the others (k, m).

    NaN where one has no value, or a design cannot be assembled or misses much.
    """
    look = problem.evaluated(problem.dimensions_at(units, combination))
    with np.errstate(all="ignore"):
        spare = [each.margin.from_leaves(look.numbers.__getitem__) for each in problem.constraints]
    kept = np.all(np.broadcast_arrays(look.is_assembled, *(each >= -MET for each in spare)), axis=0)
    values = np.where(kept, [look.values_of(each) for each in problem.objectives], np.nan)
    return (values[:many].max(axis=0) if problem.sense > 0.0 else values[:many].min(axis=0)), values[many:]
