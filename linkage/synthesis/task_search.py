"""Synthesis: machines whose point goes along a path, whose output follows a function, or whose body takes poses, by exact derivatives."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import cached_property, partial
from typing import Any

import numpy as np

from ..errors import DefinitionError, LinkageError, cited, require_type, unwarned
from ..frozen import frozen, immutable
from ..language import said
from ..mechanism import Mechanism
from ..motion import stroke_display_unit
from ..motion.measures import Constraint, FixedNumber, Measure, conditions_of, mean_in_cases, measure_of, reachable, words_of
from ..numeric.descent import without_repeats
from ..plan import Mask
from ..program import FloatArray, fixed_backend
from ..study.checkpoint import Checkpoint, digest, facts_as_json, facts_of_machine
from ..study.designs import Array
from ..study.measured import traced_number
from ..study.optimise import cases_searched, check_counts, each_in_cases, pieces_in_cases, where_searched
from ..study.problem import Problem, end_words
from ..study.space import FAR, Space, check_one_design, size_of_machine, unit_points
from ..study.survey import Executor, LocalExecutor, check_executor, check_progress, progress_told
from ..study.variants import fitted_rows
from ..units import show
from . import synthesis, task_work
from .curve_catalogue import NEIGHBOURS, CurveCatalogue, curve_catalogue
from .defects import NEAR_CHANGE_POINT, branch_words, circuit_words, in_order, order_words
from .fit import Fit, Timing
from .starts import POPULATION, WHOLE_ENOUGH, Likeness, Starts, standing_apart
from .synthesis import ALIKE, MISSES, NEAR, Miss, Synthesis, SynthesisedMachine, exact_error, is_one_design, misses_of, told_error
from .task_work import LONG, NUMBERS, RACE, Combination, FitWork, Stages, Through
from .tasks import FunctionTask, PathTask, PoseTask, Task, TaskRows, check_radians, moving_stroke, task_named_in, task_of, timed_as

STARTS = 64
POLISHED, FEW = 8, 3
"""Ends that do not keep a condition, or that stand where a machine just runs, from which is searched on with all conditions: a few at a
time, then only from those that may come to less."""
CLOSE, KEEPING, HOPE = 512, 16, 1.2
"""Designs that lie best on the task, of which those are started from that keep the conditions, and how many of these; such an end is
searched on from where its error is at most so many times the best."""
ENOUGH_GOOD = 6
"""Ends that are answers: with so many no others are looked for that are worse than the best of them."""
RACING = 6
"""Times as many starts as are asked for make their first steps; the best of them go on."""
NEARLY, HOPS, HOPPED, EACH_HOP = 1e-4, 6, 8, 8
"""Of a task's size: where the best answer misses by no more, yet is not exact, searches begin again about the best few answers, so many
about each, and so many times while that helps: near an exact design there are many that come close to the task."""
HOP = 0.02
"""How far from an answer they begin, of a side of the box, as a standard deviation."""
ANSWERS = 24
"""Answers that are judged at the most."""


def synthesise(
    machine: Mechanism | list[Any] | tuple[Any, ...] | None = None,
    *,
    path: PathTask | None = None,
    function: FunctionTask | None = None,
    motion: PoseTask | None = None,
    vary: Mapping[object, object] | None = None,
    subject_to: object = (),
    regions: Mapping[str, object] | None = None,
    timed: Any = None,
    rank: Any = None,
    case: object = None,
    over: Mapping[str, Any] | None = None,
    starts: int | str | CurveCatalogue = STARTS,
    seed: int = 0,
    limit: int | None = None,
    executor: Executor | None = None,
    folder: str | os.PathLike[str] | None = None,
    progress: Any = False,
) -> Synthesis:
    """Return the machines that do a task, the best first: `synthesise(bar, path=PathTask(points, of="P"), vary={"OA": (0.02, 0.06), ...})`.

    The task is a `path` of a point, a `function` of the stroke, or poses of a body, its `motion`; `vary`, `subject_to`, `regions` and
    `case` are those of `optimise`. With `timed=True` the task says the stroke of every point. With `timed=False` each point's stroke is an
    unknown of its own. With "steps" the points lie at equal steps of the stroke, of a crank over one turn from an unknown first one on, to
    either side. By default points with strokes are timed. `over` holds other strokes, or looks at a part of this one.

    From some thousand designs spread over the box, those that run over the whole stroke are laid onto the task, shifted, turned and scaled
    in closed form where the dimensions allow. From the best `starts` of them all go on at once by the method of Levenberg and Marquardt
    with exact derivatives, then with all conditions where one is missed. Every answer is assembled over its whole stroke or turn and keeps
    the conditions, by the judge, and comes to its points in order. `rank`, such as `-least(transmission("B"))`, orders answers of the same
    error, the least first; where `case` gives load cases with their hours, its mean over them. The same seed gives the same result;
    `limit` is how many designs are looked at before the best so far comes back. `executor` and `folder` are those of `survey`:
    populations and local searches go through any executor, to the same bits as in this process, and with a folder the same call goes on
    where another one stopped. `progress=True` shows a bar. `starts="catalogue"`, for a closed path that is not timed: from the nearest
    curves of `curve_catalogue(machine, of)`, or of one that is given, in place of a population.

    Instead of one machine there may be a list of classes or designs, `synthesise([FourBar, SliderCrank], ...)`, or none: then it is all
    installed ones that name a point of a coupler, `Featured(coupler="P")`, and need no iteration. Each is searched from all `starts`, one
    after the other, and has an equal part of a `limit`. `solutions` are ranked over all classes, of the same error those of fewer links
    first; `table` compares the classes. `vary`, `subject_to`, `regions`, `rank`, `over` and the task's `of` may be dictionaries by class,
    `vary={FourBar: {...}}`. If `vary` leaves a class out, the machine is brought to the task's size s, and all varies that moves its point.
    Lengths go from 0.05 to 5 s, angles by a turn, fixed points by 5 s to either side of the task's middle. For a function s is the
    machine's longest length.

    Raises DefinitionError for what cannot be asked, or a folder of another task. Where no machine that runs was found, `solutions` are
    none and `misses` say why.

    Parameters
    ----------
    machine : Mechanism or sequence, optional
        The design, or classes; by default all installed four-bars with a coupler.
    path : PathTask, optional
        The path of a point.
    function : FunctionTask, optional
        A function of the stroke.
    motion : PoseTask, optional
        Poses of a body.
    vary : mapping, optional
        Ranges or choices by the names of dimensions.
    subject_to : Condition or sequence
        The conditions.
    regions : mapping, optional
        Regions of points by their names.
    timed : bool or str, optional
        Whether points count at their strokes; or "steps".
    rank : Measure, optional
        Orders answers of the same error.
    case : LoadCase, str, sequence or mapping, optional
        The load cases, or their hours.
    over : mapping, optional
        The ranges of the strokes [m or rad].
    starts : int, str or CurveCatalogue
        The number of local searches; or "catalogue".
    seed : int
        The seed of the designs spread over the box.
    limit : int, optional
        The number of designs after which it ends.
    executor : Executor, optional
        Runs the work elsewhere.
    folder : str or Path, optional
        Where finished work is kept.
    progress : callable or bool, optional
        Called with (done, total); True shows a bar.

    Returns
    -------
    Synthesis
        The machines and the misses.

    Raises
    ------
    DefinitionError
        A wrong argument, or a folder of another task.
    """
    wanted = [("path", path, PathTask), ("function", function, FunctionTask), ("motion", motion, PoseTask)]
    if machine is None or isinstance(machine, (list, tuple)):
        by_class = {"vary": vary, "subject_to": subject_to, "regions": regions, "rank": rank, "over": over}
        options = dict(timed=timed, case=case, starts=starts, seed=seed, limit=limit, executor=executor, folder=folder)
        return synthesis.synthesised_classes(synthesise, machine, wanted, by_class, progress, options)
    check_one_design(machine)
    title = machine.plan.title
    catalogued = starts == "catalogue" or isinstance(starts, CurveCatalogue)
    check_counts(title, STARTS if catalogued else starts, seed, limit)
    check_progress(progress)
    check_executor(executor)
    task = task_named_in(machine, task_of(title, wanted))
    timed = timed_as(title, task, timed)
    machine, vary, travels = fitted_rows(machine, vary)
    rows, space = task.rows(machine), Space.of(machine, vary, regions)
    if rank is not None:
        require_type(f"{title}: rank", rank, Measure, 'one number of a design is expected, such as -least(transmission("B"))')
    over, occurring = where_searched(machine, over, travels)
    cases, shares = cases_searched(machine, case, occurring)
    asked = [*conditions_of(subject_to, machine), *space.conditions]
    ranks = () if rank is None else (mean_in_cases(rank, shares),) if shares else each_in_cases([rank], cases, machine)
    held = each_in_cases(asked, cases, machine)
    constraints = pieces_in_cases(asked, cases, machine.judge(over))
    problem = Problem(machine, [FixedNumber(0.0)], constraints, space, 1.0, over)
    problem.count.limit = limit
    timing = Timing.of(problem, searched_stroke(problem, rows), timed, rows.count)
    if timing.stroke not in travels and timed is True and task.at is not None:  # rows of cylinders have ranges of their own
        check_timed(problem, timing, task.at)
    catalogue = catalogue_for(problem, task, timing, timed, starts, executor, progress) if catalogued else None
    many = starts if isinstance(starts, int) else STARTS
    search = TaskSearch(problem, task, rows, timing, timed, ranks, held, over, many, seed, catalogue)
    checkpoint = None if folder is None else Checkpoint.of(folder, facts_of_search(search))
    with progress_told(progress, machine.plan.heading) as tell, fixed_backend("numpy"), unwarned():  # an answer says how near it passes
        total = len(search.combinations) * (search.population + search.many)
        return search.run(Stages(executor or LocalExecutor(), checkpoint, tell, total))


def facts_of_search(search: TaskSearch) -> dict[str, object]:
    """Return the facts that identify a search; DefinitionError for a function that a folder cannot tell from another one."""
    problem, task = search.problem, search.task
    functions, held = problem.function_texts(), problem.constraints
    wanted = [array if array is None else array.tolist() for array in (search.rows.wanted, search.rows.weights, task.at)]
    return facts_as_json({
        **facts_of_machine(problem.machine, ()),
        "task": f"{type(task).__name__} of {words_of(task.of)}",
        "points": search.rows.count,
        "their values": digest(repr([wanted, [words_of(each) for each in search.rows.quantities]])),
        "in order": task.in_order,
        "timed": search.timed,
        "vary": digest(repr([problem.space.variables, problem.space.choices])),
        "subject_to": digest(repr([[str(each), [repr(number) for number in each.margin.numbers]] for each in held]) + repr(functions)),
        "over": digest(repr([(name, *map(end_words, (one.low, one.high))) for name, one in problem.ranges.items()])),
        "starts": search.starts if search.catalogue is None else search.catalogue.digest,
        "seed": search.seed,
    })  # fmt: skip


def catalogue_for(
    problem: Problem, task: Task, timing: Timing, timed: object, starts: object, executor: Executor | None, progress: Any
) -> CurveCatalogue:
    """Return the catalogue from which a search begins; DefinitionError for anything but a closed path, or a catalogue of another class."""
    machine, title = problem.machine, problem.plan.title
    if not (isinstance(task, PathTask) and task.closed and timed is False and timing.turn):
        closed = 'path=PathTask(points, of="P", closed=True), timed=False, over the whole turn of a crank'
        raise DefinitionError(f"{title}: starts={cited(starts)}: a catalogue holds closed curves; say {closed}, or a number of starts.")
    if isinstance(starts, CurveCatalogue):
        if type(starts.kind.machine) is not type(machine) or starts.kind.of != task.of:
            raise DefinitionError(f"{title}: starts={cited(starts)}: this is a catalogue of {starts.kind.class_title}, not of {task.of}.")
        return starts
    varied = {each.owner for each in problem.space.variables} | {owner for owners, _ in problem.space.choices for owner, _ in owners}
    hold = [name for name, entry in machine.plan.table.entries.items() if entry.kind == "angle" and name not in varied]
    return curve_catalogue(machine, task.of, hold=hold, executor=executor, progress=progress)


def searched_stroke(problem: Problem, rows: TaskRows) -> str:
    """Return the one stroke along which a task runs; DefinitionError where several move, or its ends follow the design.

    Points so far away that they are of another unit are refused as well, and a quantity that stands still.
    """
    plan, stroke = problem.plan, moving_stroke(problem.plan, problem.ranges)
    if problem.ranges[stroke].follows and not problem.ranges[stroke].is_travel:
        raise DefinitionError(f"{plan.title}: over={{{stroke!r}: ...}}: a synthesis looks at a range of numbers.")
    lengths = [measure_of(plan, each) == "length" for each in rows.quantities]
    ends = [abs(end) for each in problem.space.variables if each.unit == "mm" for end in (each.low, each.high)]
    far, size = float(np.nanmax(np.abs(rows.wanted[lengths]), initial=0.0)), max([size_of_machine(problem.machine), *ends])
    if far > 5.0 * FAR * size:  # a path may be out of reach, and is told so
        told = f"lengths as far as {far:.6g} m from zero, where no length is above {size:.6g} m"
        raise DefinitionError(f"{plan.title}: {told}; they are in m, write np.array(...) * mm if these are millimetres.")
    for each in rows.quantities:
        if stroke not in plan.reaches(*traced_number(plan, each).names(plan)):
            told = f"{words_of(each)} does not move with {stroke}, the stroke of this task"
            raise DefinitionError(f"{plan.title}: {told}; ask for what moves, or let another stroke run, over={{...}}.")
    return stroke


def check_timed(problem: Problem, timing: Timing, at: FloatArray) -> None:
    """Raise DefinitionError for timed points outside the part of the stroke that is looked at; a crank goes round."""
    if timing.turn:
        check_radians(problem.plan.title, f"the strokes of {timing.stroke}", at)
        return
    low, high = sorted((timing.start, timing.start + timing.span))
    outside = np.flatnonzero((at < low - 1e-9 * (high - low)) | (at > high + 1e-9 * (high - low)))
    if len(outside):
        unit = stroke_display_unit(problem.plan, timing.stroke, "mm")
        told, least, most = (show(float(each), unit, 4) for each in (at[outside[0]], low, high))
        where = f"point {outside[0] + 1} is timed at {timing.stroke} = {told}, outside the stroke from {least} to {most}"
        raise DefinitionError(f"{problem.plan.title}: {where}; give a stroke within it, or another over={{...}}.")


@immutable
class Ends:
    """The results of local searches of one combination of choices: designs (m, n + w), bases (m, n), errors, and which are good."""

    fit: Fit
    at: FloatArray
    base: FloatArray
    error: FloatArray
    good: Mask


@immutable
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
    catalogue: CurveCatalogue | None

    def run(self, stages: Stages) -> Synthesis:
        """Return all that was found."""
        problem = self.problem
        first = self.started(stages)
        ends = self.searched(stages, first)
        spent = problem.count.limit if problem.count.is_spent else None
        with problem.count.without_limit():
            solutions, misses = self.judged(ends)
        begun, running = (sum(counts) for counts in zip(*((len(each.at), each.running) for each in first), strict=True))
        fits = tuple(each.fit for each in first)
        return Synthesis(
            problem.machine, self.task, solutions, misses, self.population * len(self.combinations), running, begun,
            problem.count.designs, spent, problem, fits,
        )  # fmt: skip

    @cached_property
    def combinations(self) -> list[Combination]:
        """The combinations of choices."""
        return [*self.problem.space.combinations()]

    @property
    def population(self) -> int:
        """How many designs of each combination are looked at first, beside that of today: of a limit at most half in all."""
        if not self.problem.space.variables:
            return 0
        limit = self.problem.count.limit
        if self.catalogue is not None:
            return min(NEIGHBOURS, len(self.catalogue), NEIGHBOURS if limit is None else max(limit // 2 // len(self.combinations), 1))
        many = POPULATION if limit is None else min(POPULATION, limit // 2)
        least = 6 if limit is None else 3
        return 1 << max(least, (many // len(self.combinations)).bit_length() - 1)

    @property
    def many(self) -> int:
        """How many searches are begun of each combination."""
        return max(self.starts // len(self.combinations), min(self.starts, 4))

    def work(self, piece: int, measure: Callable[..., dict[str, Array]], **options: Any) -> FitWork:
        """Return a stage's work on designs, a piece at a time, by a function of a fit and the rows."""
        shared, facts = (self.problem, self.rows, self.timing, self.task.at), f"{measure.__name__} {piece} {options}"
        call, what = partial(measure, **options), "a condition or the mechanism's class"
        return FitWork(self.problem.machine, call, piece, "numpy", what, *shared, facts)

    def fit(self, combination: Combination) -> Fit:
        """Return the fit of a combination of choices."""
        return Fit(self.problem.on_branch(combination), self.rows, self.timing, combination, self.task.at)

    def most(self, searches: int) -> float:
        """Return how many designs each of some searches may look at."""
        limit = self.problem.count.limit
        return np.inf if limit is None else max((limit - self.problem.count.designs) // max(searches, 1), 1)

    # -- starts --------------------------------------------------------------------------------------------

    def started(self, stages: Stages) -> list[Starts]:
        """Return where to start, of each combination: the best that stand apart of those that run, laid onto the task."""
        space, chosen = self.problem.space, self.combinations
        unit = space.unit(space.present(self.problem.machine))[None]
        if self.population and self.catalogue is not None:
            unit = self.catalogue.population(self.fit(chosen[0]), self.population)
        elif self.population:
            unit = np.concatenate([unit, unit_points(self.population, len(space.variables), "sobol", self.seed)])
        unit = space.drawn(unit, self.problem.plan.title, self.seed)
        every = [(each, {"unit": unit}) for each in chosen]
        look = self.work(1024, task_work.look_results, timed=self.timed)
        seen = stages.carried_out("look", look, every, told=self.population * len(chosen))
        fits = [self.fit(each) for each in chosen]
        likeness: dict[Combination, Likeness] = {}
        parts = []
        whole, somewhere = ([each[name] for each in seen] for name in ("whole", "somewhere"))
        with self.problem.count.without_limit():
            for fit, runs, reached in zip(fits, whole, somewhere, strict=True):
                kept = runs if int(runs.sum()) >= WHOLE_ENOUGH else reached
                likeness[fit.combination] = Likeness.of(fit, unit[runs][:3], timed=self.timed is True)
                parts.append((fit.combination, {"unit": unit[kept]}))
        running = frozenset(each for each, runs in zip(chosen, whole, strict=True) if int(runs.sum()) >= WHOLE_ENOUGH)
        work = self.work(256, task_work.laying_results, timed=self.timed, likeness=likeness, running=running)
        laid = stages.carried_out("lay", work, parts)
        found = []
        for (_, own), each, fit, runs in zip(parts, laid, fits, whole, strict=True):
            places = standing_apart(own["unit"], each["error"], RACING * self.many)
            drawn = runs[len(runs) - self.population :]  # without the machine itself
            close = np.argsort(each["error"], kind="stable")[: CLOSE if self.problem.constraints else 0]  # the best that keep all
            at, base, error = (each[name][close] for name in ("at", "base", "error"))
            if len(at):
                with self.problem.count.without_limit():
                    error = np.where(fit.keeping(at), error, np.inf)
            apart = standing_apart(at[:, : fit.n], error, min(KEEPING, self.many))
            keeping = Starts(fit, at[apart], base[apart])
            found.append(Starts(fit, each["at"][places], each["base"][places], int(drawn.sum()), keeping))
        return self.raced(stages, found)

    def raced(self, stages: Stages, first: Sequence[Starts]) -> list[Starts]:
        """Return as many of the starts as are asked for, the best after their first steps."""
        if self.most(sum(len(each.at) for each in first)) < 4 * 3 * RACE:  # a limit is better spent on the best
            return [replace(each, at=each.at[: self.many], base=each.base[: self.many]) for each in first]
        numbers, found = self.rows.wanted.size * (len(self.problem.space.variables) + self.timing.width), []
        work = self.work(int(np.clip(NUMBERS // max(numbers, 1), 64, 256)), task_work.race_results, steps=RACE)
        for each, own in zip(first, stages.carried_out("race", work, [each.part for each in first]), strict=True):
            places = standing_apart(own["at"][:, : each.fit.n], own["error"], self.many)
            found.append(replace(each, at=own["at"][places], base=each.base[places]))
        return found

    # -- local searches ------------------------------------------------------------------------------------

    def searched(self, stages: Stages, first: Sequence[Starts]) -> list[Ends]:
        """Return the results of the local searches, then those that continue with the conditions."""
        free = self.descended(stages, "free", first, self.many * len(first))
        found = [[each] for each in free]
        if not self.problem.count.is_spent:  # again, through machines that run
            again = [self.that_run_first(each, ends) for each, ends in zip(first, free, strict=True)]
            for each, ends in zip(found, self.descended(stages, "running", again), strict=True):
                each.append(ends)
        keeping = [each.keeping for each in first if each.keeping is not None and len(each.keeping.at)]
        kept = dict[Fit, Ends]()
        if keeping and not self.problem.count.is_spent:  # and through machines that keep the conditions
            kept = {ends.fit: ends for ends in self.descended(stages, "keeping", keeping)}
            for each in found:
                each += [kept[each[0].fit]] if each[0].fit in kept else []
        exact, best, before = exact_error(self.rows), self.best_of(found), np.inf
        for wave in range(HOPS):  # again about the best answers, where these are nearly exact
            if not exact < best <= self.rows.count * (NEARLY * self.rows.size) ** 2 or best > 0.5 * before or self.problem.count.is_spent:
                break
            about = [self.about_best(own, wave) for own in found]
            for own, ends in zip(found, self.descended(stages, "free", about, name=f"hop {wave}"), strict=True):
                own.append(ends)
            best, before = self.best_of(found), best
        stepped = [place for place, each in enumerate(self.problem.space.variables) if each.step is not None]
        if stepped:
            return [self.on_steps(each, stepped) for own in found for each in own]
        ways = [Polishing(self, starts, own, kept.get(starts.fit)) for starts, own in zip(first, found, strict=True)]
        wave = 0
        while not self.problem.count.is_spent and min(way.best for way in ways) > exact and any([way.next() for way in ways]):
            work = self.work(1, task_work.polish_results, in_order=self.ordered, most=self.most(sum(len(way.now) for way in ways)))
            reached = stages.carried_out(f"conditions {wave}", work, [(way.fit.combination, way.rows) for way in ways])
            for way, end in zip(ways, reached, strict=True):
                way.enter(end["at"][end["ended"]], way.rows["base"][end["ended"]])
            wave += 1
        return [each for own, way in zip(found, ways, strict=True) for each in [*own, *way.ends]]

    def best_of(self, found: Sequence[Sequence[Ends]]) -> float:
        """Return the least error of answers that run, keep the conditions and come to the points in order [SI^2]."""
        return min([np.inf, *(float(one) for own in found for each in own for one in each.error[self.good_in_order(each)])])

    def about_best(self, own: Sequence[Ends], wave: int) -> Starts:
        """Return starts about the best answers of a combination that stand apart."""
        fit, random = own[0].fit, np.random.default_rng([self.seed, wave])
        good = [self.good_in_order(each) for each in own]
        at, base, error = (
            np.concatenate([getattr(each, name)[mask] for each, mask in zip(own, good, strict=True)]) for name in ("at", "base", "error")
        )

        def is_near(known: int, other: int) -> bool:
            return bool(np.abs(at[other, : fit.n] - at[known, : fit.n]).max(initial=0.0) < NEAR)

        rows = np.repeat(np.array(without_repeats(np.argsort(error, kind="stable"), is_near, HOPPED), int), EACH_HOP)
        begin = at[rows]
        begin[:, : fit.n] = np.clip(begin[:, : fit.n] + HOP * random.standard_normal((len(rows), fit.n)), 0.0, 1.0)
        return Starts(fit, begin, base[rows])

    def that_run_first(self, first: Starts, ends: Ends) -> Starts:
        """Return the starts that run over the whole stroke, in place of searches whose results do not run.

        Where there are enough ends that do, only of those that came to less than the best of them.
        """
        good = self.good_in_order(ends)
        with self.problem.count.without_limit():
            away = np.flatnonzero(~first.fit.assembled(ends.at)) if len(ends.at) else np.zeros(0, int)
            if int(good.sum()) >= ENOUGH_GOOD:
                away = away[ends.error[away] < ends.error[good].min()]
            away = away[first.fit.assembled(first.at[away])] if len(away) else away
        return Starts(first.fit, first.at[away], first.base[away])

    def descended(self, stages: Stages, through: Through, first: Sequence[Starts], told: int = 0, *, name: str = "") -> list[Ends]:
        """Return where local searches end, or where they stand when the limit is reached; `name` is the stage's where it is another."""
        reached = [each.at for each in first]
        if not self.problem.count.is_spent:
            work = self.work(64, task_work.descent_results, through=through, most=self.most(sum(map(len, reached))))
            reached = [each["at"] for each in stages.carried_out(name or through, work, [each.part for each in first], told=told)]
        return [self.ends_of(each.fit, at, each.base) for each, at in zip(first, reached, strict=True)]

    def ends_of(self, fit: Fit, at: FloatArray, base: FloatArray) -> Ends:
        """Return ends, with their errors and with which of them run over the whole stroke and keep the conditions."""
        with self.problem.count.without_limit():
            error = fit.errors(at, base)
            if self.ordered and len(at):  # what rounding put out of order
                ordered = fit.put_in_order(at, base)
                after = fit.errors(ordered, base)
                same = after <= (1.0 + ALIKE) * np.maximum(error, exact_error(self.rows))
                at, error = np.where(same[:, None], ordered, at), np.where(same, after, error)
            good = fit.keeping(at) & np.isfinite(error) if len(at) else np.zeros(0, bool)
        return Ends(fit, at, base, error, good)

    def on_steps(self, ends: Ends, stepped: Sequence[int]) -> Ends:
        """Return ends with the variables that have steps on the nearest ones, the others searched for anew."""
        at, fit = np.array(ends.at), ends.fit
        for place in stepped:
            variable = fit.space.variables[place]
            rows = np.arange(variable.steps) * float(variable.step or 1.0) / variable.span
            at[:, place] = rows[np.abs(rows - at[:, [place]]).argmin(axis=1)]
        with self.problem.count.without_limit():
            at, _ = fit.descend(at, ends.base, LONG, held=stepped)
        return self.ends_of(fit, at, ends.base)

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

    # -- the judge -----------------------------------------------------------------------------------------

    def judged(self, ends: Sequence[Ends]) -> tuple[tuple[SynthesisedMachine, ...], tuple[Miss, ...]]:
        """Return the distinct answers, the best first, and the best designs that are no answers."""
        every = [(float(each.error[k]), each, k) for each in ends for k in range(len(each.at)) if np.isfinite(each.error[k])]
        every.sort(key=lambda one: one[0])
        solutions: list[SynthesisedMachine] = []
        misses: list[Miss] = []
        seen: list[tuple[float, Ends, int]] = []
        asked = bool(self.problem.constraints or self.ranks)
        moving = np.full(len(self.problem.space.variables), asked)  # which variables move anything of the task; all where more is asked
        for each in ends if not asked else ():
            if len(each.at):
                moving |= np.any(each.fit.slopes(each.at, each.base)[:, :, : each.fit.n] != 0.0, axis=(0, 1))
        for one in every:
            error, each, k = one
            if len(solutions) == ANSWERS:
                break
            full = len(misses) >= MISSES
            if (full and not each.good[k]) or any(self.is_same(one, other, moving) for other in seen):
                continue
            seen.append(one)
            machine = self.problem.machine_of(each.at[k, : each.fit.n], each.fit.combination)
            why = self.why_not(machine, each, k)
            if why and not full:
                misses.append(Miss(machine, error, f"error {error:.6g}: {why}."))
            elif not why:
                solutions.append(self.answer(machine, each, k))
        solutions.sort(key=self.order)
        for best in solutions[:1]:  # with the points that lie on another branch where it misses some by far
            fit = self.fit(best.combination)
            words = branch_words(fit, best.machine, best.at, best.base, misses_of(fit, best.at, best.base)[2])
            if words:
                solutions[0] = replace(best, sentence=f"{best.sentence.removesuffix('.')}; {words}.")
        return tuple(solutions), tuple(misses)

    def is_same(self, one: tuple[float, Ends, int], other: tuple[float, Ends, int], moving: Mask) -> bool:
        """Return whether two ends are one design, by the variables (n,) that move anything."""
        (error, ends, k), (known, others, j) = one, other
        if ends.fit.combination != others.fit.combination:
            return False
        n = ends.fit.n
        return bool(is_one_design(ends.at[k, :n][moving], others.at[j, :n][moving], error, known, exact_error(self.rows)))

    def order(self, each: SynthesisedMachine) -> tuple[float, bool, float]:
        """Return the sort key of answers: the error to three digits, or exact, then the ranking measure, then the error.

        Where nothing is asked, an exact answer that passes near a change point comes after those that do not.
        """
        error = told_error(each.error, exact_error(self.rows))
        if not np.isnan(each.ranked):
            return error, False, each.ranked
        return error, error == 0.0 and bool(each.transmission < NEAR_CHANGE_POINT), each.error

    def why_not(self, machine: Mechanism, ends: Ends, k: int) -> str:
        """Return why a design is no answer, in words; "" for one that is, by the judge."""
        fit, at, base = ends.fit, ends.at[k], ends.base[k]
        told = circuit_words(fit, at, base) or synthesis.beyond_travel_words(fit, at, base)
        if told:
            return told
        if self.ordered and not in_order(fit, at, base):
            return said("it comes to the points in the order {order}", order=order_words(fit, at, base))
        try:
            answers = machine.judge(self.over).answers([reachable, *self.held])
        except LinkageError as error:
            return " ".join(str(error).split()).rstrip(".")
        lost = [answer for answer in answers if answer.ok is False]
        if not lost:
            return ""
        told = str(lost[0]).rstrip(".")
        return told if lost[0].question is reachable else f"{lost[0].question} is missed: {told}"

    def answer(self, machine: Mechanism, ends: Ends, k: int) -> SynthesisedMachine:
        """Return a design with all that is said of it."""
        fit, at, base = ends.fit, ends.at[k], ends.base[k]
        strokes, reached, far = misses_of(fit, at, base)
        angle, joint = synthesis.poorest_transmission(machine, self.over)
        ranked = max((float(each.value) for each in machine.judge(self.over).answers([*self.ranks])), default=float("nan"))
        words = synthesis.machine_words(fit, machine, at, base, far, angle, joint)
        error, worst = float(np.sum(far**2)), int(np.argmax(far))
        return SynthesisedMachine(
            machine, error, float(np.sqrt(np.mean(far**2))), float(far[worst]), worst + 1, frozen(strokes), frozen(reached), angle, ranked,
            words, frozen(at), frozen(base), fit.combination,
        )  # fmt: skip


class Polishing:
    """Which ends of one combination are searched on from with all conditions: those that miss one or the order, the best first.

    Only those of which the error leaves hope to better what is good already; where one does not run, from its start. Then a few of those
    that came through designs which keep the conditions.
    """

    def __init__(self, search: TaskSearch, first: Starts, found: Sequence[Ends], kept: Ends | None) -> None:
        self.search, self.fit, free = search, first.fit, found[0]
        good = [search.good_in_order(each) for each in found]
        self.best = min([np.inf, *(float(one) for each, mask in zip(found, good, strict=True) for one in each.error[mask])])
        every = [free, *([] if kept is None else [kept])]
        self.at, self.base, self.error = (np.concatenate([getattr(each, name) for each in every]) for name in ("at", "base", "error"))
        self.first = np.concatenate([first.at, *(each.at for each in every[1:])])
        self.left = [int(k) for k in np.argsort(free.error, kind="stable") if not good[0][k]]
        self.kept = [len(free.at) + int(k) for each in every[1:] for k in np.argsort(each.error, kind="stable")[:FEW]]
        self.tried: list[FloatArray] = []
        self.ends: list[Ends] = []
        self.now: list[int] = []

    def next(self) -> bool:
        """Choose the next designs; return whether there are any."""
        self.now = []
        while self.left and len(self.tried) < POLISHED and len(self.now) < FEW and self.error[self.left[0]] < self.best:
            self.choose(self.left.pop(0))
        while not self.now and self.kept:
            k = self.kept.pop(0)
            if self.error[k] <= HOPE * self.best:
                self.choose(k)
        return bool(self.now)

    def choose(self, k: int) -> None:
        """Take a design next, unless one beside it was searched from before."""
        if not any(np.abs(self.at[k] - other).max() < NEAR for other in self.tried):
            self.tried.append(self.at[k])
            self.now.append(k)

    @property
    def rows(self) -> dict[str, FloatArray]:
        """The next designs, each with its start and the strokes' base."""
        return {"at": self.at[self.now], "first": self.first[self.now], "base": self.base[self.now]}

    def enter(self, at: FloatArray, base: FloatArray) -> None:
        """Add the results of searches."""
        ends = self.search.ends_of(self.fit, at, base)
        self.ends.append(ends)
        self.best = min([self.best, *ends.error[self.search.good_in_order(ends)].tolist()])
