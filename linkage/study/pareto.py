"""Several objectives: the front of designs of which none is better in all, by NSGA-II (extra `pareto`), each then made exact.

The genetic search finds where the front is. A local search with exact derivatives then improves the first objective as far as it goes, with
the others held. So its points are on the front and not near it. Source: K. Deb et al., A fast and elitist multiobjective genetic algorithm:
NSGA-II, IEEE Trans. Evol. Comp. 6 (2002) 182-197.
"""

from __future__ import annotations

from collections.abc import Sequence
from importlib.util import find_spec

import numpy as np

from ..errors import LinkageError, ensure
from ..frozen import immutable
from ..mechanism import Mechanism
from ..motion.measures import CombinedMeasure, Constraint, FixedNumber, Measure
from ..program import FloatArray
from ..shown import Shown
from ..units import show
from .infeasible import infeasible_error
from .optimum import numbers_judged, unit_of_measure
from .problem import COARSE, Problem
from .solver import MET, Local, SearchEnd
from .survey import Progress

POPULATION, GENERATIONS = 64, 60
POINTS = 15
"""Designs of a front."""


@immutable
class FrontPoint:
    """A design of a front: the machine, assembled over the whole stroke, and its objectives [SI]."""

    machine: Mechanism
    values: tuple[float, ...]


@immutable
class Front(Shown):
    """The designs of which none is better in all objectives, in the order of the first: `front.points[0].machine`.

    Attributes
    ----------
    title : str
        The machine's title.
    objectives : tuple of Measure
        What is made least or greatest.
    units : tuple of str
        The units in which they are shown.
    points : tuple of FrontPoint
        The designs with their values.
    evaluations : int
        How many designs were looked at.
    limit : int, optional
        That of the designs where it was reached; None where the search came to its end.
    """

    title: str
    objectives: tuple[Measure, ...]
    units: tuple[str, ...]
    points: tuple[FrontPoint, ...]
    evaluations: int
    limit: int | None = None

    @property
    def values(self) -> FloatArray:
        """The objectives [SI], shape (points, objectives)."""
        return np.array([each.values for each in self.points])

    def __str__(self) -> str:
        lines = [f"{self.title}: {len(self.points)} designs of which none is better in all of {', '.join(map(str, self.objectives))}"]
        for each in self.points:
            lines.append("  " + ", ".join(show(value, unit) for value, unit in zip(each.values, self.units, strict=True)))
        lines.append(f"  {self.evaluations} designs looked at.")
        if self.limit is not None:
            lines.append(f"  The limit of {self.limit} designs was reached: these are the best so far. A larger limit= looks at more.")
        return "\n".join(lines)

    __repr__ = __str__


def front(problem: Problem, seed: int, tell: Progress) -> Front:
    """Return the front of a problem's objectives, each to be least; those whose sign was changed are shown with their own."""
    ensure(find_spec("pymoo") is not None, 'Several objectives need pymoo: pip install "hydrolinkage[pareto]".')
    coarse, found = problem.changed(counts=COARSE), []
    combinations = [*problem.space.combinations()]
    tell(0, len(combinations))
    for done, combination in enumerate(combinations):
        if done and problem.count.is_spent:
            break
        evolved = evolved_front(coarse, combination, seed, len(combinations) - done)
        if len(evolved):  # each objective's best, and others spread between
            with problem.count.without_limit():
                values, _, _ = problem.merits_of_each(combination, evolved)
            ends = [on_front(problem, combination, evolved[int(np.argmin(values[place]))], place, None) for place in range(len(values))]
            order = np.argsort(values[0])
            for place in order[np.unique(np.linspace(0, len(order) - 1, POINTS).astype(int))]:
                ends.append(on_front(problem, combination, evolved[place], 0, values[:, place]))
            found += [each for each in ends if each is not None]
        tell(done + 1, len(combinations))
    limit = problem.count.limit if problem.count.is_spent else None
    if not found:
        present = problem.space.unit(problem.space.present(problem.machine))
        with problem.count.without_limit():
            raise infeasible_error(problem, [SearchEnd(each, present, np.nan, np.inf, True) for each in combinations])
    best = not_dominated(np.array([values for values, _ in found]))
    measures, signs = [], []
    for each in problem.objectives:
        parts = (each.left, each.right) if isinstance(each, CombinedMeasure) and each.symbol == "*" else (None, each)
        is_turned = isinstance(parts[0], FixedNumber) and parts[0].value == -1.0
        measures.append(parts[1] if is_turned else each)
        signs.append(-1.0 if is_turned else 1.0)
    points = [FrontPoint(found[at][1], tuple(sign * value for sign, value in zip(signs, found[at][0], strict=True))) for at in best]
    units = tuple(unit_of_measure(problem.plan, each) for each in measures)
    return Front(problem.plan.title, tuple(measures), units, tuple(points), problem.count.designs, limit)


def evolved_front(problem: Problem, combination: Sequence[int], seed: int, left: int = 1) -> FloatArray:
    """Return unit coordinates (m, n) of designs near the front of one combination, generations looked at all at once.

    Where a limit does not reach for all of them and as many local searches, of the combinations that are `left`, there are fewer.
    """
    from pymoo.algorithms.moo.nsga2 import NSGA2
    from pymoo.core.problem import Problem as Asked
    from pymoo.optimize import minimize

    n, many = len(problem.space.variables), len(problem.objectives)
    if not n:
        return np.zeros((1, 0))

    class Generation(Asked):  # type: ignore[misc]
        """A generation's objectives and misses, as pymoo asks for them."""

        def _evaluate(self, x: FloatArray, out: dict[str, object], *args: object, **options: object) -> None:
            values, missing, reached = problem.merits_of_each(combination, np.asarray(x, float))
            out["F"] = np.where(np.isfinite(values), values, 1e30).T
            out["G"] = np.stack([np.nan_to_num(missing, nan=1e6, posinf=1e6) - MET, 1e6 * (1.0 - reached)], axis=1)

    count, generations = problem.count, GENERATIONS
    if count.limit is not None:
        generations = min(GENERATIONS, max(3 * (count.limit - count.designs) // (4 * POPULATION * left), 1))
    with count.without_limit():
        found = minimize(
            Generation(n_var=n, n_obj=many, n_ieq_constr=2, xl=0.0, xu=1.0), NSGA2(pop_size=POPULATION), ("n_gen", generations), seed=seed
        )
    return np.empty((0, n)) if found.X is None else np.atleast_2d(np.asarray(found.X, float))


def on_front(
    problem: Problem, combination: Sequence[int], unit: FloatArray, place: int, held: FloatArray | None
) -> tuple[tuple[float, ...], Mechanism] | None:
    """Return a design with one objective as good as it can be, the others no worse than held; None where it cannot be built."""
    objectives = problem.objectives
    pairs = () if held is None else zip(objectives, held, strict=True)
    limits = [Constraint(each, "<=", FixedNumber(float(limit))) for each, limit in pairs]
    own = [*problem.constraints, *(each for number, each in enumerate(limits) if number != place)]
    one = problem.changed(objectives=[objectives[place]], constraints=own)
    try:
        with problem.count.without_limit():
            local = Local(one, combination, unit)
        result = local.run()
        machine = problem.machine_of(result.unit, combination)
        with problem.count.without_limit():
            values, missing = numbers_judged(problem, machine)
    except LinkageError:
        return None
    if values is None or missing > MET:
        return None
    found = tuple(float(each.from_leaves(values.__getitem__)) for each in objectives)
    return (found, machine) if np.isfinite(found).all() and not values.lost else None


def not_dominated(values: FloatArray) -> list[int]:
    """Return the numbers of points (m, k) that no other improves on in all, in the order of the first objective; equal ones once."""
    kept: list[int] = []
    size = np.abs(values).max(axis=0) + 1e-300
    for place in np.lexsort(values.T[::-1]):
        others = values / size
        better = (others <= others[place] + 1e-9).all(axis=1) & (others < others[place] - 1e-9).any(axis=1)
        same = any(np.abs(others[each] - others[place]).max() <= 1e-9 for each in kept)
        if not better.any() and not same:
            kept.append(int(place))
    return kept
