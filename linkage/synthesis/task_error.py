"""The error of a task as measures of a machine, for searches, tolerances and bands."""

from __future__ import annotations

import operator
from collections.abc import Mapping, Sequence
from functools import reduce
from itertools import combinations
from typing import Any, TypeAlias

import numpy as np

from ..errors import DefinitionError, ensure
from ..mechanism import Mechanism
from ..motion import ratio
from ..motion.measures import Measure, at, least
from ..plan import Plan
from ..program import FloatArray
from ..quantities import ref
from ..study.checks import check_one_design
from ..study.cylinder_rows import Range
from ..study.problem import is_still, ranges_of
from .tasks import Task, TaskRows, table_of

Squares: TypeAlias = tuple[Measure, ...]
"""The square of how far each point is missed [SI^2]."""


def task_error(
    machine: Mechanism, task: Task, strokes: object = None, *, timed: bool | None = None, over: Mapping[str, object] | None = None
) -> Measure:
    """Return the sum of the squares of what a machine misses of a task, as a measure [SI^2]: what `synthesise` makes least.

    `optimise(machine, minimise=task_error(machine, task), vary=...)`. Timed points count at their strokes. An untimed one counts where the
    machine comes nearest to it in the whole stroke. `strokes` (n,) are those at which a machine comes to the points: an untimed point then
    counts by its distance from the path there, as studies of tolerances take it. `timed=True`: it counts at these strokes. `over` holds
    other strokes. Raises DefinitionError where several strokes move.
    """
    total: Measure = sum_of_parts(point_errors(machine, task, strokes, timed=timed, over=over))
    return total


def point_errors(
    machine: Mechanism, task: Task, strokes: object = None, *, timed: bool | None = None, over: Mapping[str, object] | None = None
) -> Squares:
    """Return the squares of what a machine misses at each point of a task, as measures [SI^2]; see `task_error`.

    `[each**0.5 <= 0.5 * mm for each in point_errors(...)]` are conditions: no point is missed by more.
    """
    check_one_design(machine)
    rows, ranges = task.rows(machine), ranges_of(machine, over)
    stroke = moving_stroke(machine.plan, ranges)
    held = {name: float(one.low) for name, one in ranges.items() if name != stroke}
    if strokes is not None:
        given = table_of(f"{machine.plan.title}: the error of a task", "strokes", strokes, 0)
        ensure(len(given) == rows.count, f"{machine.plan.title}: {len(given)} strokes for {rows.count} points; give the stroke of each.")
        slides = task.at is None if timed is None else not timed
        return squares_near(machine, rows, stroke, held, given, slides=slides)
    if task.at is not None:
        return squares_near(machine, rows, stroke, held, task.at, slides=False)
    return tuple(least(squared_sum(misses_at(machine, rows, place))) for place in range(rows.count))


def moving_stroke(plan: Plan, ranges: Mapping[str, Range]) -> str:
    """Return the one stroke that moves, of the ranges of all; DefinitionError where several move."""
    moving = [name for name, one in ranges.items() if not is_still(one)]
    if not moving:
        known = ", ".join(ranges)
        raise DefinitionError(f"{plan.title}: a task runs along one stroke, and over={{...}} holds all of them; leave one of {known} out.")
    held = ", ".join(f'"{name}": value' for name in moving[1:])
    ensure(len(moving) == 1, f"{plan.title}: a task runs along one stroke; hold the others, over={{{held}}}.")
    return moving[0]


def misses_at(machine: Mechanism, rows: TaskRows, place: int) -> list[Any]:
    """Return how far each wanted quantity is off at a point, weighed, as quantities of a pose."""
    found = []
    for quantity, values, weight, turns in zip(rows.quantities, rows.wanted, rows.weights, rows.turns, strict=True):
        if np.isnan(values[place]):
            continue
        off = (ref(quantity) if isinstance(quantity, str) else quantity) - float(values[place])
        found.append(float(weight) * (np.arctan2(np.sin(off), np.cos(off)) if turns else off))
    return found


def sum_of_parts(parts: Sequence[Any]) -> Any:
    """Return the sum of quantities or measures, of one at least."""
    return reduce(operator.add, parts)


def squared_sum(parts: Sequence[Any]) -> Any:
    """Return the sum of the squares of quantities."""
    return sum_of_parts([each * each for each in parts])


def squares_near(
    machine: Mechanism, rows: TaskRows, stroke: str, held: Mapping[str, float], strokes: FloatArray, *, slides: bool
) -> Squares:
    """Return the squared misses at strokes (n,). Where a point `slides`, what lies along its path there does not count.

    Of a miss v where the path goes along t, that leaves v^2 - (v t)^2 / t^2, the sum of the squares of their minors over t^2. It is the
    squared distance from the path, with its first derivatives, where v is across the path. A point whose v is not, as at the end of a
    stroke, does not slide.
    """
    speeds = [float(weight) * ratio(quantity, stroke) for quantity, weight in zip(rows.quantities, rows.weights, strict=True)]
    found = []
    for place, value in enumerate(strokes.tolist()):
        where: dict[str, Any] = {**held, stroke: value}
        off = misses_at(machine, rows, place)
        if slides and is_across(machine, off, speeds, where):
            minors = [one * fast - other * slow for (one, slow), (other, fast) in combinations(zip(off, speeds, strict=True), 2)]
            found.append(at(squared_sum(minors) / squared_sum(speeds), **where))
        else:
            found.append(at(squared_sum(off), **where))
    return tuple(found)


ACROSS = 1e-4
"""The cosine below which a miss counts as across the path, which the search for the nearest stroke has left."""
EXACT = 1e-9
"""A miss that is smaller [SI] has no direction."""


def is_across(machine: Mechanism, off: list[Any], speeds: list[Any], where: Mapping[str, Any]) -> bool:
    """Return whether a miss stands across the path at a pose, and the point moves there."""
    values = np.array([np.ravel(each)[0] for each in machine.evaluate([*off, *speeds], **where)])
    missed, speed = values[: len(off)], values[len(off) :]
    along = abs(float(missed @ speed))
    fast, far = float(np.linalg.norm(speed)), float(np.linalg.norm(missed))
    return fast > 0.0 and (far < EXACT or along <= ACROSS * far * fast)
