"""The three redesigns by `optimise` and by SciPy's differential evolution without gradients: what each finds, and of how many designs.

`python -m tests.benchmarks.bench_redesigns [--designs N] [lift hitch balancer]`. Both look at the same poses and conditions; the evolution
adds what is missing to its objective. It gets N designs; beside its end stands what it has after five times the designs of `optimise`.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.optimize import differential_evolution

from linkage import optimise
from linkage.motion.measures import conditions_of
from linkage.study.problem import Problem
from linkage.study.space import Space
from mechanisms.redesigns import flat_hitch, steady_reaction, strong_lift

SEARCHES: Mapping[str, Callable[[], dict[str, Any]]] = {"lift": strong_lift, "hitch": flat_hitch, "balancer": steady_reaction}
KEPT = 1e-6


@dataclass(frozen=True)
class Compared:
    """What was found of how many designs, and what the evolution had after five times as many and at its end; NaN: nothing allowed."""

    value: float
    designs: int
    evolved_by_then: float
    evolved: float
    evolved_designs: int

    def __str__(self) -> str:
        by_then = f"evolution has {self.evolved_by_then:.5g} after {5 * self.designs}"
        return f"{self.value:.5g} of {self.designs} designs; {by_then} and {self.evolved:.5g} after {self.evolved_designs}"


def problem_of(given: Mapping[str, Any]) -> Problem:
    """Return a search's problem as `optimise` has it."""
    machine, sense = given["machine"], -1.0 if "maximise" in given else 1.0
    objective = given.get("maximise", given.get("minimise"))
    return Problem(machine, [objective], conditions_of(given["subject_to"], machine), Space.of(machine, given["vary"]), sense)


def evolved(problem: Problem, most: int, seed: int = 0) -> list[tuple[int, float]]:
    """Return the best allowed objective that a differential evolution has, after each generation: (designs, value)."""
    n, course, best, seen = len(problem.space.variables), [], [np.inf], [0]

    def merit(population: Any) -> Any:
        value, missing, reached = problem.merits((), np.ascontiguousarray(population.T))
        seen[0] += population.shape[1]
        worth = np.where(np.isfinite(value), problem.sense * value, 0.0)
        allowed = worth[np.isfinite(value) & (missing <= KEPT)]
        best[0] = min([best[0], *allowed.tolist()])
        course.append((seen[0], problem.sense * best[0] if np.isfinite(best[0]) else np.nan))
        return worth + 10.0 * size * np.where(np.isfinite(missing), missing, 10.0) + 100.0 * size * (1.0 - reached)

    first = problem.merits((), problem.space.unit(problem.space.present(problem.machine))[None])[0][0]
    size = abs(float(first)) if np.isfinite(first) else 1.0
    rounds = max(most // (15 * n) - 1, 1)
    differential_evolution(merit, [(0.0, 1.0)] * n, vectorized=True, updating="deferred", polish=False, seed=seed, maxiter=rounds, tol=0.0)
    return course


def compared(name: str, most: int) -> Compared:
    """Return both searches of one redesign."""
    found = optimise(**SEARCHES[name](), method="local")
    course = evolved(problem_of(SEARCHES[name]()), most)
    then = [value for designs, value in course if designs <= 5 * found.evaluations]
    return Compared(found.value, found.evaluations, then[-1] if then else float("nan"), course[-1][1], course[-1][0])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--designs", type=int, default=20_000)
    parser.add_argument("names", nargs="*", default=list(SEARCHES))
    given = parser.parse_args()
    for name in given.names:
        print(f"  {name:10s} {compared(name, given.designs)}", flush=True)


if __name__ == "__main__":
    main()
