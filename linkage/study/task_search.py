"""Synthesis: machines whose point goes along a path, whose output follows a function, or whose body takes poses, by exact derivatives."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Any, final

import numpy as np

from ..errors import DefinitionError, LinkageError, cited
from ..mechanism import Mechanism
from ..motion.measures import Constraint, Given, Measure, conditions_of, in_case, mean_in_cases, reachable
from ..plan import Mask
from ..program import FloatArray, fixed_backend
from .checks import check_one_design
from .fit import Fit, FitSquares, Timing
from .optimise import cases_searched, check_counts, constraint_in_case, each_in_cases, pieces_in_cases, where_searched
from .problem import LimitReachedError, Problem, is_still
from .solver import MET, Local
from .space import Space
from .starts import POPULATION, Starts, starts_for
from .survey import Progress, check_progress, progress_told
from .synthesis import (
    Miss,
    Synthesis,
    SynthesisedMachine,
    circuit_words,
    frozen,
    in_order,
    machine_words,
    misses_of,
    poorest_transmission,
)
from .tasks import FunctionTask, PathTask, PoseTask, Task, TaskRows, task_of, timed_as

STARTS = 64
STEPS, TURNS = 60, 5
"""Steps of a local search between two looks at the limit, and how many times so many."""
POLISHED, FEW = 8, 3
"""Ends that do not keep a condition, or that stand where a machine just runs, from which is searched on with all conditions: after a few
of them, only from those that may come to less."""
SAME, NEAR = 1e-5, 1e-2
"""Of a side of the box: ends nearer than the first are one, nearer than the second where their errors are the same."""
ALIKE = 1e-6
"""Errors that differ by less than this part are the same."""
EXACT = 1e-9
"""Of a task's size: a fit that misses by no more is exact."""
ANSWERS = 24
"""Answers that are judged at the most."""
MISSES = 8


def synthesise(
    machine: Mechanism,
    *,
    path: PathTask | None = None,
    function: FunctionTask | None = None,
    motion: PoseTask | None = None,
    vary: Mapping[Any, Any],
    subject_to: Any = (),
    timed: Any = None,
    rank: Measure | None = None,
    case: Any = None,
    over: Mapping[str, Any] | None = None,
    starts: int = STARTS,
    seed: int = 0,
    limit: int | None = None,
    progress: Any = False,
) -> Synthesis:
    """Return the machines that do a task, the best first: `synthesise(bar, path=PathTask(points, of="P"), vary={"OA": (0.02, 0.06), ...})`.

    The task is a `path` of a point, a `function` of the stroke, or poses of a body, its `motion`; `vary`, `subject_to` and `case` are
    those of `optimise`. `timed=True`: the task says the stroke of every point; `timed=False`: each point's stroke is an unknown of its
    own; "steps": the points lie at equal steps of the stroke, of a crank over one turn from an unknown first one on, to either side. By
    default points with strokes are timed. `over` holds other strokes, or looks at a part of this one.

    From some thousand designs spread over the box, those that run over the whole stroke are laid onto the task, shifted, turned and scaled
    in closed form where the dimensions allow. From the best `starts` of them all go on at once by the method of Levenberg and Marquardt
    with exact derivatives, then with all conditions where one is missed. Every answer is assembled over its whole stroke or turn and keeps
    the conditions, by the judge, and comes to its points in order. `rank`, such as `-least(transmission("B"))`, orders answers of the same
    error, the least first; where `case` gives load cases with their hours, its mean over them. The same seed gives the same result;
    `limit` is how many designs are looked at before the best so far comes back.

    Raises DefinitionError for what cannot be asked. Where no machine that runs was found, `solutions` are none and `misses` say why.
    """
    check_one_design(machine)
    title = machine.plan.title
    check_counts(title, starts, seed, limit)
    check_progress(progress)
    task = task_of(title, [("path", path, PathTask), ("function", function, FunctionTask), ("motion", motion, PoseTask)])
    timed = timed_as(title, task, timed)
    rows, space = task.rows(machine), Space.of(machine, vary)
    if rank is not None and not isinstance(rank, Measure):
        raise DefinitionError(f'{title}: rank={cited(rank)}: one number of a design is expected, such as -least(transmission("B")).')
    over, occurring = where_searched(machine, over)
    cases, shares = cases_searched(machine, case, occurring)
    asked = conditions_of(subject_to, machine)
    ranks = () if rank is None else (mean_in_cases(rank, shares),) if shares else each_in_cases([rank], cases, machine, in_case)
    held = each_in_cases(asked, cases, machine, constraint_in_case)
    constraints = pieces_in_cases(asked, cases, machine.judge(over))
    problem = Problem(machine, [Given(0.0)], constraints, space, 1.0, over)
    problem.count.limit = limit
    timing = Timing.of(problem, moving_stroke(problem), timed, rows.count)
    search = TaskSearch(problem, task, rows, timing, timed, ranks, held, over, starts, seed)
    with progress_told(progress, machine.plan.heading) as tell, fixed_backend("numpy"):
        return search.run(tell)


def moving_stroke(problem: Problem) -> str:
    """Return the one stroke along which a task runs; DefinitionError where several move, or its ends follow the design."""
    moving = [name for name, one in problem.ranges.items() if not is_still(one)]
    if len(moving) != 1:
        held = ", ".join(f'"{name}": value' for name in moving[1:]) or "..."
        raise DefinitionError(f"{problem.plan.title}: a task runs along one stroke; hold the others, over={{{held}}}.")
    if problem.ranges[moving[0]].follows:
        raise DefinitionError(f"{problem.plan.title}: over={{{moving[0]!r}: ...}}: a synthesis looks at a range of numbers.")
    return moving[0]


@final
@dataclass(frozen=True, eq=False)
class Ends:
    """What local searches of one combination of choices came to: designs (m, n + w), bases (m, n), errors, and which are good."""

    fit: Fit
    at: FloatArray
    base: FloatArray
    error: FloatArray
    good: Mask


@final
@dataclass(frozen=True, eq=False)
class TaskSearch:
    """A task, and how machines for it are searched."""

    problem: Problem
    task: Task
    rows: TaskRows
    timing: Timing
    timed: Any
    ranks: tuple[Measure, ...]
    held: tuple[Constraint, ...]
    over: Any
    starts: int
    seed: int

    def run(self, tell: Progress) -> Synthesis:
        """Return all that was found."""
        problem = self.problem
        combinations = [*problem.space.combinations()]
        population = 1 << max(6, (POPULATION // len(combinations)).bit_length() - 1)
        many = max(self.starts // len(combinations), min(self.starts, 4))
        present = problem.space.unit(problem.space.present(problem.machine))
        ends: list[Ends] = []
        begun = running = 0
        tell(0, len(combinations))
        for done, combination in enumerate(combinations):
            fit = Fit(problem, self.rows, self.timing, combination, self.task.at)
            with suppress(LimitReachedError):
                first = starts_for(fit, many, self.seed, self.timed, population, present)
                begun, running = begun + len(first.at), running + first.running
                ends += self.searched(fit, first)
            tell(done + 1, len(combinations))
        spent = problem.count.limit if problem.count.is_spent else None
        with problem.count.without_limit():
            solutions, misses = self.judged(ends)
        fits = tuple(dict.fromkeys(each.fit for each in ends)) or (Fit(problem, self.rows, self.timing, combinations[0], self.task.at),)
        return Synthesis(
            problem.machine, self.task, solutions, misses, population * len(combinations), running, begun, problem.count.designs, spent,
            problem, fits,
        )  # fmt: skip

    # -- local searches ------------------------------------------------------------------------------------

    def searched(self, fit: Fit, first: Starts) -> list[Ends]:
        """Return what the local searches of a combination come to, then those that go on with the conditions."""
        free = self.descended(fit, first.at, first.base, whole=False)
        with self.problem.count.without_limit():
            runs = fit.whole(free) if len(free) else np.zeros(0, bool)
        ends = self.ends_of(fit, free, first.base)
        found = [ends]
        away = np.flatnonzero(~runs)
        if len(away) and not self.problem.count.is_spent:  # again, through machines that run
            again = away[fit.whole(first.at[away])]
            at = self.descended(fit, first.at[again], first.base[again], whole=True)
            found.append(self.ends_of(fit, at, first.base[again]))
        stepped = [place for place, each in enumerate(self.problem.space.variables) if each.step is not None]
        if stepped:
            found = [self.on_steps(each, stepped) for each in found]
        polished = self.polished(found, ends, first)
        return [*found, *([polished] if polished is not None else [])]

    def descended(self, fit: Fit, at: FloatArray, base: FloatArray, *, whole: bool) -> FloatArray:
        """Return where local searches end, or where they stand when the limit is reached."""
        at = np.array(at)
        with self.problem.count.without_limit():
            error = fit.errors(at, base)
        going = np.arange(len(at))
        for _ in range(TURNS):
            if not len(going) or self.problem.count.is_spent:
                break
            before = error[going]
            with self.problem.count.without_limit():
                at[going], error[going] = fit.descend(at[going], base[going], STEPS, whole=whole)
            going = going[error[going] < (1.0 - 1e-9) * before]
        return at

    def ends_of(self, fit: Fit, at: FloatArray, base: FloatArray) -> Ends:
        """Return ends, with their errors and with which of them run over the whole stroke and keep the conditions."""
        good = np.zeros(len(at), bool)
        with self.problem.count.without_limit():
            error = fit.errors(at, base)
        if len(at):
            with self.problem.count.without_limit():
                good = fit.whole(at) & np.isfinite(error)
                if self.problem.constraints and good.any():
                    short = self.problem.missing_of_each(fit.combination, at[good][:, : fit.n]).max(axis=0, initial=0.0)
                    good[good] = short <= MET
        return Ends(fit, at, base, error, good)

    def on_steps(self, ends: Ends, stepped: Sequence[int]) -> Ends:
        """Return ends with the variables that have steps on the nearest ones, the others searched for anew."""
        at, fit = np.array(ends.at), ends.fit
        for place in stepped:
            variable = fit.space.variables[place]
            rows = np.arange(variable.steps) * float(variable.step or 1.0) / variable.span
            at[:, place] = rows[np.abs(rows - at[:, [place]]).argmin(axis=1)]
        with self.problem.count.without_limit():
            at, _ = fit.descend(at, ends.base, STEPS, held=stepped)
        return self.ends_of(fit, at, ends.base)

    def polished(self, found: Sequence[Ends], free: Ends, first: Starts) -> Ends | None:
        """Return ends of searches with all conditions, of those that miss one or the order; where they do not run, from their starts.

        Only of those of which the error leaves hope to better what is good already; None of none.
        """
        fit, fixed = free.fit, [place for place, each in enumerate(self.problem.space.variables) if each.step is not None]
        good = [self.good_in_order(each) for each in found]
        best = min((float(each.error[k]) for each, mask in zip(found, good, strict=True) for k in np.flatnonzero(mask)), default=np.inf)
        ended: list[tuple[FloatArray, FloatArray]] = []
        tried: list[FloatArray] = []
        for k in np.argsort(free.error, kind="stable"):
            if len(tried) == POLISHED or self.problem.count.is_spent or not free.error[k] < best or fixed:
                break
            if good[0][k] or any(np.abs(free.at[k] - other).max() < NEAR for other in tried):
                continue
            tried.append(free.at[k])
            for start in (free.at[k], first.at[k]):
                with suppress(LinkageError):
                    ended.append((self.with_conditions(fit, start, first.base[k]), first.base[k]))
                    break
            if len(ended) >= FEW:  # then only what may be better than these
                one = self.ends_of(fit, *(np.array(column) for column in zip(*ended, strict=True)))
                best = min([best, *one.error[self.good_in_order(one)].tolist()])
        if not ended:
            return None
        return self.ends_of(fit, *(np.array(column) for column in zip(*ended, strict=True)))

    def good_in_order(self, ends: Ends) -> Mask:
        """Return which ends run, keep the conditions and come to the points in order."""
        if not self.ordered:
            return ends.good
        order = [in_order(ends.fit, at, base) for at, base in zip(ends.at, ends.base, strict=True)]
        return np.asarray(ends.good & np.array(order, bool))

    @property
    def ordered(self) -> bool:
        """Whether untimed points are to be passed in order."""
        return self.timed is False and self.task.in_order

    def with_conditions(self, fit: Fit, at: FloatArray, base: FloatArray) -> FloatArray:
        """Return what a design and its points' unknowns (n + w,) come to by a search that keeps all conditions."""
        squares = FitSquares(fit, at, base, in_order=self.ordered)
        local = Local(self.problem, fit.combination, at[: fit.n], squares=squares)
        end = local.run()
        return np.concatenate([end.unit, local.own])

    # -- the judge -----------------------------------------------------------------------------------------

    def judged(self, ends: Sequence[Ends]) -> tuple[tuple[SynthesisedMachine, ...], tuple[Miss, ...]]:
        """Return the distinct answers, the best first, and the best of what is none."""
        every = [(float(each.error[k]), each, k) for each in ends for k in range(len(each.at)) if np.isfinite(each.error[k])]
        every.sort(key=lambda one: one[0])
        solutions: list[SynthesisedMachine] = []
        misses: list[Miss] = []
        seen: list[tuple[float, Ends, int]] = []
        for one in every:
            error, each, k = one
            if len(solutions) == ANSWERS:
                break
            full = len(misses) >= MISSES
            if (full and not each.good[k]) or any(self.is_same(one, other) for other in seen):
                continue
            seen.append(one)
            machine = self.problem.machine_of(each.at[k, : each.fit.n], each.fit.combination)
            why = self.why_not(machine, each, k)
            if why and not full:
                misses.append(Miss(machine, error, f"error {error:.6g}: {why}."))
            elif not why:
                solutions.append(self.answer(machine, each, k))
        return tuple(sorted(solutions, key=self.order)), tuple(misses)

    def is_same(self, one: tuple[float, Ends, int], other: tuple[float, Ends, int]) -> bool:
        """Return whether two ends are one design."""
        (error, ends, k), (known, others, j) = one, other
        if ends.fit.combination != others.fit.combination:
            return False
        n = ends.fit.n
        far = float(np.abs(ends.at[k, :n] - others.at[j, :n]).max(initial=0.0))
        floor = self.floor
        alike = abs(error - known) <= ALIKE * max(error, known, floor) and max(error, known) > floor
        return far < SAME or (far < NEAR and alike)

    @property
    def floor(self) -> float:
        """The error up to which a fit is exact [SI^2]."""
        return self.rows.count * (EXACT * self.rows.size) ** 2

    def order(self, each: SynthesisedMachine) -> tuple[float, float]:
        """Return by what answers are ordered: by the error to three digits, or exact, then by what is asked, then by the error."""
        told = 0.0 if each.error <= self.floor else float(f"{each.error:.2e}")
        return told, each.error if np.isnan(each.ranked) else each.ranked

    def why_not(self, machine: Mechanism, ends: Ends, k: int) -> str:
        """Return why a design is no answer, in words; "" of one that is, by the judge."""
        fit, at, base = ends.fit, ends.at[k], ends.base[k]
        circuits = circuit_words(fit, at, base)
        if circuits:
            return circuits
        if self.ordered and not in_order(fit, at, base):
            return "it comes to the points in another order"
        try:
            answers = machine.judge(self.over).answers([reachable, *self.held])
        except LinkageError as error:
            return " ".join(str(error).split()).rstrip(".")
        lost = [answer for answer in answers if answer.ok is False]
        return f"{lost[0].question} is missed: {lost[0]}".rstrip(".") if lost else ""

    def answer(self, machine: Mechanism, ends: Ends, k: int) -> SynthesisedMachine:
        """Return a design with all that is said of it."""
        fit, at, base = ends.fit, ends.at[k], ends.base[k]
        strokes, reached, far = misses_of(fit, at, base)
        angle, joint = poorest_transmission(machine, self.over)
        ranked = max((float(each.value) for each in machine.judge(self.over).answers([*self.ranks])), default=float("nan"))
        words = machine_words(fit, machine, far, angle, joint, ordered=in_order(fit, at, base))
        error, worst = float(np.sum(far**2)), int(np.argmax(far))
        return SynthesisedMachine(
            machine, error, float(np.sqrt(np.mean(far**2))), float(far[worst]), worst + 1, frozen(strokes), frozen(reached), angle, ranked,
            words, frozen(at), frozen(base), fit.combination,
        )  # fmt: skip
