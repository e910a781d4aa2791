"""Results of a synthesis: the machines that do a task, the best first, and near misses with their reasons."""

from __future__ import annotations

import csv
import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from ..disk import Place, replacing_text
from ..errors import StudyError, cited, ensure, is_class_of, is_whole
from ..frozen import immutable
from ..language import said, said_of
from ..mechanism import Mechanism
from ..motion import stroke_display_unit
from ..motion.measures import Measure, measure_of
from ..motion.motion_verdicts import transmissions
from ..shown import HasSentence, Shown, text_columns
from ..study.optimise import check_counts
from ..study.optimum import heading_with_unit, rounded_values, tried_names
from ..study.problem import Problem
from ..study.space import check_one_design, size_of_machine, unit_of
from ..study.survey import check_progress, progress_told
from ..study.variants import ENDING, is_side
from ..units import deg, display_unit, factor, mm, show, shown_in
from ..vectors import FloatArray, Mask, Side
from .defects import TOLD, change_point_words, in_order, order_words
from .exact import REGISTERED, FoundMachines
from .fit import Fit
from .tasks import AskedTasks, PathTask, PoseTask, Task, TaskRows, of_class, squares_near, sum_of_parts, task_named_in, task_of

MOST_ROUNDINGS = 1024
CLOSEST_CHANGE_POINT = 1e-6
SAME, NEAR = 1e-5, 1e-2
"""Of a side of the box: designs nearer than the first are one, nearer than the second where their errors are the same."""
ALIKE = 1e-6
"""Errors that differ by less than this part are the same."""
EXACT = 1e-9
"""Of a task's size: a fit that misses by no more is exact."""
END = 1e-9
"""Of a side of the box: a dimension so near to its end stands there."""
MISSES = 8
"""Machines that are no answers but come near, that are told at the most."""
ROUND = 97
"""Poses over which a machine's size, and what it does, is looked at."""
SHORTEST, LONGEST, ASIDE = 0.05, 5.0, 5.0
"""Of a task's size: between which lengths vary where nothing is said, and how far fixed points from its middle."""
CHANGE = 1e-3
"""Of a dimension: a change that shows whether a task depends on it."""


@immutable
class SynthesisedMachine(HasSentence, Shown):
    """A machine that does a task over its whole stroke.

    Attributes
    ----------
    machine : Mechanism
        The machine.
    error, rms : float
        The sum of the squares of its misses [SI^2], and their root mean square a point [SI].
    most, worst
        The largest miss [SI], and at which point, counted from 1.
    strokes : array (n,)
        The strokes at which it comes to the points [m or rad].
    reached : array (r, n)
        What it has there [SI].
    transmission : float
        The least transmission angle of its joints [rad], NaN without one.
    ranked : float
        What it was ranked by, NaN where that is the error.
    sentence : str
        How well it does the task.
    at : array
        The strokes in parts of their range.
    base : array
        The variables in parts of their ranges.
    combination : tuple of int
        The choices taken, by number.
    """

    machine: Mechanism
    error: float
    rms: float
    most: float
    worst: int
    strokes: FloatArray
    reached: FloatArray
    transmission: float
    ranked: float
    sentence: str
    at: FloatArray = field(repr=False)
    base: FloatArray = field(repr=False)
    combination: tuple[int, ...] = field(repr=False)


@immutable
class Miss:
    """A machine near a task that is no answer: its `error` [SI^2], and `why`, where it is not assembled or misses a condition."""

    machine: Mechanism
    error: float
    why: str

    def __str__(self) -> str:
        return self.why


@immutable
class RoundedMachine(HasSentence):
    """A machine on drawing dimensions, its `error` [SI^2], its largest miss [SI], and the cost of rounding in words."""

    machine: Mechanism
    error: float
    most: float
    sentence: str


@dataclass(frozen=True, eq=False, repr=False)
class Synthesis(FoundMachines[SynthesisedMachine]):
    """All distinct machines that were found for a task, the best first, each assembled over its whole stroke.

    Where several classes were searched, `table` compares them; `start`, `task` and `problem` are then those of the best class.

    Attributes
    ----------
    start : Mechanism
        The machine that was varied.
    task : PathTask, FunctionTask or PoseTask
        The task.
    solutions : tuple of SynthesisedMachine
        The machines, none where nothing runs.
    misses : tuple of Miss
        The best of those that are no answers.
    population, running : int
        How many designs were spread over the box, and how many of them are assembled over the whole stroke.
    starts : int
        How many local searches began.
    evaluations : int
        How many designs were looked at.
    limit : int, optional
        That of the designs where it was reached; None where the search came to its end.
    problem : Problem
        The task and the conditions over their samples.
    fits : tuple of Fit
        How each combination of choices was fitted.
    classes : tuple of Synthesis
        What was found of each of several classes, the best first.
    """

    start: Mechanism
    task: Task
    solutions: tuple[SynthesisedMachine, ...]
    misses: tuple[Miss, ...]
    population: int
    running: int
    starts: int
    evaluations: int
    limit: int | None
    problem: Problem
    fits: tuple[Fit, ...]
    classes: tuple[Synthesis, ...] = ()

    @property
    def error(self) -> float:
        """The error of the best machine [SI^2]; infinite where there is none."""
        return self.solutions[0].error if self.solutions else float("inf")

    @property
    def sentence(self) -> str:
        """The answers in words, the best of them and the count; or the nearest miss, and why."""
        title, found, searched = self.problem.plan.title, self.solutions, self.searched
        if self.classes:
            title = said_of(len(self.classes), "{n} class", "{n} classes")
        if found:
            opening = said_of(
                len(found), "{title}: {n} machine that runs; {searched}",
                "{title}: {n} different machines that run, the best first; {searched}", title=title, searched=searched,
            )  # fmt: skip
        else:
            opening = said("{title}: no machine that runs was found for it; {searched}", title=title, searched=searched)
        if self.classes:
            best = [f"  {place}. {each.machine.plan.title}: {each}" for place, each in enumerate(found[:TOLD], 1)]
            without = [f"  {each.problem.plan.title}: {each.misses[0]}" for each in self.classes if each.misses and not each.solutions]
            return "\n".join([opening, *best, *without, "", self.table])
        misses = [] if found else [f"  {each}" for each in self.misses[:TOLD]]
        return "\n".join([opening, *(f"  {place}. {each}" for place, each in enumerate(found[:TOLD], 1)), *misses])

    @property
    def searched(self) -> str:
        """How much was looked at, in words."""
        text = said(
            "{population} designs, of which {running} run, {starts} searches, {evaluations} designs looked at.",
            population=self.population, running=self.running, starts=self.starts, evaluations=self.evaluations,
        )  # fmt: skip
        if self.limit is not None:
            text += " " + said("The limit of {limit} designs was reached: this is the best so far.", limit=self.limit)
        return text

    @property
    def table(self) -> str:
        """A table of the classes, a line each: the links, the error, the size and the least transmission angle of the best machine."""
        classes = self.classes or (self,)
        unit = miss_unit(classes[0].fits[0])
        headings = [
            said("class"), said("links"), said("error"), heading_with_unit(said("rms"), unit), heading_with_unit(said("size"), "mm"),
            heading_with_unit(said("least transmission angle"), "deg"), said("machines"), said("searches"),
        ]  # fmt: skip
        cells = [headings]
        for each in classes:
            numbers = ["-"] * 4
            for best in each.solutions[:1]:
                size = swept_size(each.fit_of(best), best.machine)
                by = factor(shown_in(unit)) if unit else 1.0
                numbers = [f"{best.error:.3g}", f"{best.rms / by:.4g}", f"{size / mm:.4g}", f"{best.transmission / deg:.3g}"]
            cells.append([each.problem.plan.title, str(links_of(each.start)), *numbers, str(len(each.solutions)), str(each.starts)])
        return text_columns(cells, {0})

    @property
    def exact(self) -> float:
        """The error up to which a fit is exact [SI^2]."""
        return exact_error(self.fits[0].rows)

    def rounded(self, to: float = 1.0 * mm, angle: float = 0.1 * deg, *, place: int = 0) -> RoundedMachine:
        """Return an answer with its dimensions on steps, as a drawing gives them.

        Of the steps about each value those are taken that run, keep the conditions and miss the task least; untimed strokes are found anew.

        Parameters
        ----------
        to : float, optional
            The step of lengths [m], 1 mm by default.
        angle : float, optional
            The step of angles [rad], 0.1 deg by default.
        place : int, optional
            Which answer, from 0 on; the best by default.

        Returns
        -------
        RoundedMachine
            The rounded machine.
        """
        return rounded_machine(self, self.answer_at(place, "rounded"), to, angle)

    def measure(self, place: int = 0) -> Measure:
        """Return the error of an answer as a measure [SI^2]: `monte_carlo(found.machine, {"error": found.measure()}, ...)`.

        It is that of this answer and of machines near it: an untimed point counts by its distance from the path there.

        Parameters
        ----------
        place : int, optional
            Which answer, from 0 on; the best by default.

        Returns
        -------
        Measure
            The measure.
        """
        total: Measure = sum_of_parts(self.point_measures(place))
        return total

    def point_measures(self, place: int = 0) -> tuple[Measure, ...]:
        """Return the squared miss of an answer at each point as a measure [SI^2]; `each**0.5 <= 0.5 * mm` is a condition.

        Parameters
        ----------
        place : int, optional
            Which answer, from 0 on; the best by default.

        Returns
        -------
        tuple of Measure
            One for each point.
        """
        answer = self.answer_at(place, "measure")
        fit = self.fit_of(answer)
        slides = fit.timing.width == fit.rows.count
        return squares_near(answer.machine, fit.rows, fit.timing.stroke, fit.held, answer.strokes, slides=slides)

    def fit_of(self, answer: SynthesisedMachine) -> Fit:
        """Return the fit that an answer is of.

        Parameters
        ----------
        answer : SynthesisedMachine
            One of the machines found.

        Returns
        -------
        Fit
            The fit.
        """
        return next(each for each in self.own(answer).fits if each.combination == answer.combination)

    def own(self, answer: SynthesisedMachine) -> Synthesis:
        """Return the results of the class of an answer: itself where one class was searched.

        Parameters
        ----------
        answer : SynthesisedMachine
            One of the machines found.

        Returns
        -------
        Synthesis
            The results of the class.
        """
        return next((each for each in self.classes if any(answer is one for one in each.solutions)), self)

    def answer_at(self, place: int, asked: str) -> SynthesisedMachine:
        """Return the answer of a place, from 0 on.

        Parameters
        ----------
        place : int
            The place.
        asked : str
            What it is for, in the words of an error.

        Returns
        -------
        SynthesisedMachine
            The answer.

        Raises
        ------
        StudyError
            There are no answers.
        DefinitionError
            The place is not there.
        """
        if not self.solutions:
            raise StudyError(str(self))
        fits = is_whole(place) and 0 <= place < len(self.solutions)
        ensure(fits, f"{asked}(place={cited(place)}): there are {len(self.solutions)} answers, from 0 on.")
        return self.solutions[place]

    def csv(self, path: Place) -> None:
        """Write a row for each answer into a CSV file: its rank, errors, dimensions and strokes.

        Parameters
        ----------
        path : str or Path
            The file.

        Raises
        ------
        FileError
            The file cannot be written.
        """
        with replacing_text(path) as stream:
            writer = csv.writer(stream)
            writer.writerow(self.header())
            writer.writerows(self.table_rows())

    def header(self) -> list[str]:
        """Return the headings of the answers' table, with units.

        Returns
        -------
        list of str
            The headings.
        """
        if self.classes:  # a column for every name that one of them has
            return ["rank", "class", "links", "size, mm", *dict.fromkeys(name for each in self.classes for name in each.header()[1:])]
        plan, fit = self.problem.plan, self.fits[0]
        names = [heading_with_unit(name, unit_of(plan, name)) for name in tried_names(self.problem.space)]
        stroke = fit.timing.stroke
        unit = stroke_display_unit(plan, stroke, "mm")
        strokes = [heading_with_unit(f"{stroke} {place}", unit) for place in range(1, fit.rows.count + 1)]
        missed = [heading_with_unit(each, miss_unit(fit)) for each in ("rms", "most")]
        return ["rank", "error", *missed, "worst", heading_with_unit("transmission", "deg"), *names, *strokes]

    def table_rows(self) -> list[list[str]]:
        """Return the rows of the answers' table, `error` in SI, full precision; of several classes empty where one has no such column.

        Returns
        -------
        list of list of str
            The rows.
        """
        if self.classes:
            cells: dict[int, dict[str, str]] = {}
            for own in self.classes:
                for each, row in zip(own.solutions, own.table_rows(), strict=True):
                    head = {"class": own.problem.plan.title, "links": str(links_of(each.machine))}
                    size = {"size, mm": repr(swept_size(own.fit_of(each), each.machine) / mm)}
                    cells[id(each)] = dict(zip(own.header(), row, strict=True)) | head | size
            ranked = [cells[id(each)] | {"rank": str(rank)} for rank, each in enumerate(self.solutions, 1)]
            return [[row.get(name, "") for name in self.header()] for row in ranked]
        plan, space = self.problem.plan, self.problem.space
        by, unit = factor(shown_in(stroke_display_unit(plan, self.fits[0].timing.stroke, "mm"))), miss_unit(self.fits[0])
        missed = factor(shown_in(unit)) if unit else 1.0
        rows = []
        for rank, each in enumerate(self.solutions, 1):
            sides = space.sides(each.combination)
            values = [
                sides[name.removesuffix(ENDING)] if is_side(name) else each.machine[name] / factor(shown_in(unit_of(plan, name)))
                for name in tried_names(space)
            ]
            off = [each.error, each.rms / missed, each.most / missed, each.worst]
            row = [str(rank)]
            for value in (*off, each.transmission / deg, *values, *(each.strokes / by)):  # a number to its last digit, a side by its word
                text = str(value) if isinstance(value, (Side, int)) else repr(float(value))
                row.append(text if value == value else "")
            rows.append(row)
        return rows


# Which answers are one, and which is the better one.


def exact_error(rows: TaskRows) -> float:
    """Return the error up to which a fit is exact [SI^2]."""
    return rows.count * (EXACT * rows.size) ** 2


def is_one_design(one: FloatArray, other: FloatArray, error: FloatArray | float, known: FloatArray | float, exact: float) -> Mask:
    """Return whether two designs (..., n) in unit coordinates, with their errors (...), are one."""
    far, worse = np.abs(one - other).max(axis=-1, initial=0.0), np.maximum(error, known)
    alike = (np.abs(error - known) <= ALIKE * np.maximum(worse, exact)) & (worse > exact)
    return np.asarray((far < SAME) | ((far < NEAR) & alike))


def told_error(error: float, exact: float) -> float:
    """Return an error to three digits, 0 for an exact fit."""
    return 0.0 if error <= exact else float(f"{error:.2e}")


# What several classes can.


def links_of(machine: Mechanism) -> int:
    """Return how many links a machine's chain has, the frame and sliding blocks included."""
    return len(machine.plan.chain.bodies)


def swept_size(fit: Fit, machine: Mechanism) -> float:
    """Return the longer side of the rectangle that all points of a machine stay in over the stroke of a task [m]."""
    strokes = fit.timing.start + fit.timing.span * np.linspace(0.0, 1.0, ROUND)
    motion = machine.at(unreachable="nan", **{**fit.held, fit.timing.stroke: strokes})
    places = np.concatenate([np.asarray(motion[name]).reshape(2, -1) for name in machine.plan.points], axis=1)
    return float(np.ptp(places, axis=1).max())


def synthesised_classes(
    one: Callable[..., Synthesis], machines: Any, asked: AskedTasks, by_class: Mapping[str, Any], progress: Any, options: Mapping[str, Any]
) -> Synthesis:
    """Return the results of several classes, each searched by `one`, the synthesis of one machine, one after the other; see `synthesise`.

    `by_class` are what may be said class by class; `options` go to each search, with its part of the limit and a folder of its own.
    """
    starts, limit, folder = options["starts"], options["limit"], options["folder"]
    given = shipped_machines() if machines is None else machines
    ensure(given, f"synthesise({cited(machines)}): a design or a list of classes is expected, such as [FourBar, SliderCrank].")
    designs: list[Any] = [each() if is_class_of(each, Mechanism) else each for each in given]
    for each in designs:
        check_one_design(each)
    check_counts("synthesise", 1 if starts == "catalogue" else starts, options["seed"], limit)
    check_progress(progress)
    searches = [search_of_class(each, asked, by_class) for each in designs]
    found: list[Synthesis] = []
    with progress_told(progress, said_of(len(searches), "{n} class", "{n} classes")) as tell:
        for number, (machine, own) in enumerate(searches):
            tell(number, len(searches))
            left = None if limit is None else max((limit - sum(each.evaluations for each in found)) // (len(searches) - number), 1)
            place = None if folder is None else os.path.join(folder, f"{machine.plan.title}-{number + 1}")
            found.append(one(machine, **{**options, **own, "limit": left, "folder": place}))
        tell(len(searches), len(searches))
    return compared(found, limit)


def search_of_class(machine: Mechanism, asked: AskedTasks, by_class: Mapping[str, object]) -> tuple[Mechanism, dict[str, object]]:
    """Return a machine, and the arguments of its search: the task in its own names, and the options of its class or of all."""
    task = task_named_in(machine, task_of(machine.plan.title, asked))
    task.rows(machine)  # refuses what is no point of it
    options = {name: of_class(value, type(machine)) for name, value in by_class.items()}
    if options["vary"] is None:
        machine = laid_machine(machine, task)
        options["vary"] = default_box(machine, task)
    if options["subject_to"] is None:
        options["subject_to"] = ()
    keyword = next(name for name, value, _ in asked if value is not None)
    return machine, {**options, keyword: task}


def shipped_machines() -> list[Mechanism]:
    """Return the designs of the installed machines that name a point of a coupler and need no iteration, those of few links first."""
    found: dict[type[Mechanism], Mechanism] = {}
    for kind in REGISTERED.loaded()[0].values():  # one that cannot be loaded hides no other
        if {"about", "featured"} & vars(kind).keys():  # of its own, so that a machine and what is built on it are not both there
            machine = kind()
            if machine.featured().coupler and not machine.plan.groups:
                found[kind] = machine
    ensure(found, "synthesise: no machine with a point of a coupler is installed; give a list, synthesise([FourBar, ...]).")
    return sorted(found.values(), key=lambda each: (links_of(each), each.plan.title))


def compared(found: list[Synthesis], limit: int | None) -> Synthesis:
    """Return the results of all classes, ranked together; of answers with the same error the one of fewer links first."""

    def rank(one: tuple[Synthesis, SynthesisedMachine]) -> tuple[float, ...]:
        """Return the sort key of an answer: the error to three digits, then the ranking measure."""
        own, answer = one
        ranked = 0.0 if np.isnan(answer.ranked) else answer.ranked
        return told_error(answer.error, own.exact), ranked, links_of(answer.machine), answer.error

    every = sorted(((own, answer) for own in found for answer in own.solutions), key=rank)
    order = {id(own): place for place, (own, _) in reversed([*enumerate(every)])}
    found.sort(key=lambda own: (order.get(id(own), len(every)), min([miss.error for miss in own.misses], default=np.inf)))
    misses = sorted((miss for own in found for miss in own.misses), key=lambda miss: miss.error)
    sums = {name: sum(getattr(own, name) for own in found) for name in ("population", "running", "starts", "evaluations")}
    spent = limit if limit is not None and sums["evaluations"] >= limit else None
    return replace(
        found[0], solutions=tuple(answer for _, answer in every), misses=tuple(misses[:MISSES]), limit=spent, classes=tuple(found), **sums
    )


# What varies where nothing is said.


def laid_machine(machine: Mechanism, task: Task) -> Mechanism:
    """Return a machine as large as the task, and where it is: lengths and fixed points scaled and shifted; as it is for a function."""
    extent = extent_of(task)
    if extent is None:
        return machine
    own = run_of_task(machine, task)[:2]
    own = own[:, np.isfinite(own).all(axis=0)]
    large = float(np.ptp(own, axis=1).max()) if own.size else 0.0
    if not large:
        return machine
    by, middle, aim = extent[0] / large, own.mean(axis=1), extent[1]
    values: dict[str, Any] = {}
    for name, entry in machine.plan.table.entries.items():
        now = float(machine.dimensions[name])
        if entry.kind == "length":
            values[name] = by * now
        elif entry.kind == "coordinate":
            axis = "xy".index(name[-1])
            values[name] = float(aim[axis] + by * (now - middle[axis]))
    return machine.replaced(**values)


def run_of_task(machine: Mechanism, task: Task) -> FloatArray:
    """Return a task's quantities of a machine over its first stroke, shape (r, poses), NaN out of reach."""
    (name, stroke), *others = machine.strokes.items()
    held = {other: each.start for other, each in others}
    strokes: dict[str, Any] = {**held, name: np.linspace(stroke.start, stroke.end, ROUND)}
    return np.array(machine.evaluate(task.rows(machine).quantities, unreachable="nan", **strokes))


def extent_of(task: Task) -> tuple[float, FloatArray] | None:
    """Return the size of a task's places [m] and their middle (2,); None for a function, which has none.

    The size is the longer side of the rectangle about them; how far they lie from the origin where they are one.
    """
    if isinstance(task, PathTask):
        where = np.asarray(task.points.T)
    elif isinstance(task, PoseTask):
        where = np.array([task.x, task.y])
    else:
        return None
    return float(np.ptp(where, axis=1).max()) or float(np.abs(where).max()) or 1.0, where.mean(axis=1)


def default_box(machine: Mechanism, task: Task) -> dict[str, tuple[float, float]]:
    """Return the ranges of all dimensions that a task depends on, by its size; see `synthesise`."""
    extent, entries = extent_of(task), machine.plan.table.entries
    if extent is None:
        lengths = [float(machine.dimensions[name]) for name, entry in entries.items() if entry.kind == "length"]
        large, middle = max(lengths, default=1.0), np.zeros(2)
    else:
        large, middle = extent
    before = run_of_task(machine, task)
    found: dict[str, tuple[float, float]] = {}
    for name, entry in entries.items():
        if entry.kind not in ("length", "coordinate", "angle"):
            continue
        now = float(machine.dimensions[name])
        step = CHANGE * (abs(now) or size_of_machine(machine))
        with np.errstate(all="ignore"):
            change = np.abs(run_of_task(machine.replaced(**{name: now + step}), task) - before)
        if not np.nanmax(change, initial=0.0) > 1e-9 * step:
            continue
        if entry.kind == "length":
            found[name] = (SHORTEST * large, LONGEST * large)
        elif entry.kind == "angle":
            found[name] = (-np.pi, np.pi)
        else:
            aim = float(middle["xy".index(name[-1])])
            found[name] = (aim - ASIDE * large, aim + ASIDE * large)
    ensure(found, f"{machine.plan.title}: no length, angle or fixed point of it moves what the task is of; say vary={{...}}.")
    return found


# What is said of a machine.


def misses_of(fit: Fit, at: FloatArray, base: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return the strokes (n,) at which a design comes to the points, its values there (r, n), and how far each is missed (n,)."""
    strokes = fit.strokes(at[None], base[None])
    values, _ = fit.values(fit.dimensions_of(at[None]), strokes, 1)
    far = np.linalg.norm(fit.rows.off(values)[0], axis=0)
    return fit.timing.within(strokes[0]), values[0], far


def poorest_transmission(machine: Mechanism, over: object) -> tuple[float, str]:
    """Return the least transmission angle of a machine's joints [rad], and of which; NaN without one."""
    judge = machine.judge(over)
    asked = transmissions(judge)
    if not asked:
        return float("nan"), ""
    answers = judge.answers([*asked.values()])
    value, name = min((float(each.value), name) for name, each in zip(asked, answers, strict=True))
    return value, name


def machine_words(fit: Fit, machine: Mechanism, at: FloatArray, base: FloatArray, far: FloatArray, angle: float, joint: str) -> str:
    """Return an answer in words: its misses, order, circuit, Grashof class, least transmission angle, and how near to a change point."""
    unit = miss_unit(fit)
    error, rms, worst = float(np.sum(far**2)), float(np.sqrt(np.mean(far**2))), int(np.argmax(far))
    parts = [
        said(
            "error {error}, rms {rms}, at most {most} at point {worst}",
            error=f"{error:.6g}", rms=show(rms, unit, 4), most=show(float(far[worst]), unit, 4), worst=worst + 1,
        )
        if error > exact_error(fit.rows)
        else said("exact, error {error}", error=f"{error:.2g}")
    ]  # fmt: skip
    parts.append(
        said("all {count} points in order, on one circuit and one branch", count=len(far))
        if in_order(fit, at, base)
        else said(
            "all {count} points on one circuit and one branch, in the order {order}", count=len(far), order=order_words(fit, at, base)
        )
    )
    parts += [f"{name}{ENDING} = {side}" for name, side in fit.space.sides(fit.combination).items()]
    four_bars = machine.four_bars
    parts += [str(each) for each in four_bars]
    if np.isfinite(angle):
        parts.append(said("least transmission angle {angle}, of {joint}", angle=show(angle, "deg", 3), joint=joint))
    parts += change_point_words(angle, four_bars)
    share = at[: fit.n]
    settings = zip(fit.space.variables, fit.space.values(share), np.minimum(share, 1.0 - share), strict=True)
    ends = [f"{each.name} = {each.show(value)}" for each, value, left in settings if left <= END]
    if ends and error > exact_error(fit.rows):
        named = ", ".join(ends)
        one = said("{setting} is at its end of the box", setting=named)
        parts.append(one if len(ends) == 1 else said("{settings} are at their ends of the box", settings=named))
    return "; ".join(parts) + "."


def miss_unit(fit: Fit) -> str:
    """Return the unit in which misses are shown."""
    measures = [measure_of(fit.plan, each) for each in fit.rows.quantities]
    if len(measures) == 1:
        return display_unit(measures[0], "mm")
    return "mm" if measures[:2] == ["length"] * 2 else ""  # the angle of a pose counts by what a length does with it


def beyond_travel_words(fit: Fit, at: FloatArray, base: FloatArray) -> str:
    """Return which point a design comes to beyond the way of the cylinder that drives it; "" where there is none."""
    timing = fit.timing
    if not fit.problem.ranges[timing.stroke].is_travel:
        return ""
    strokes = misses_of(fit, at, base)[0]
    far = np.abs(strokes - timing.start - 0.5 * timing.span) - 0.5 * abs(timing.span)
    worst = int(np.argmax(far))
    if far[worst] <= 1e-9 * abs(timing.span):
        return ""
    unit = stroke_display_unit(fit.plan, timing.stroke, "mm")
    ends = [show(float(each), unit, 4) for each in (strokes[worst], timing.start, timing.start + timing.span)]
    return said(
        "it comes to point {point} at {stroke} = {value}, and the cylinder goes from {low} to {high}",
        point=worst + 1, stroke=timing.stroke, value=ends[0], low=ends[1], high=ends[2],
    )  # fmt: skip


# Drawing dimensions.


def rounded_machine(found: Synthesis, answer: SynthesisedMachine, to: float, angle: float) -> RoundedMachine:
    """Return an answer on drawing dimensions; see `Synthesis.rounded`."""
    fit = found.fit_of(answer)
    problem = fit.problem
    rows = rounded_values(answer.machine, problem.space, answer.at[: fit.n], to, angle, MOST_ROUNDINGS)
    with problem.count.without_limit():
        at = np.concatenate([problem.space.unit(rows), np.tile(answer.at[fit.n :], (len(rows), 1))], axis=1)
        base = np.tile(answer.base, (len(rows), 1))
        at, error = fit.descend(at, base, 20, held=range(fit.n))
        short = fit.problem.missing_of_each(fit.combination, at[:, : fit.n]).max(axis=0, initial=0.0)
        error = np.where(fit.assembled(at) & (short <= 1e-7), error, np.inf)
        place = int(np.argmin(error))
        if not np.isfinite(error[place]):
            raise StudyError(f"{problem.plan.title}: no design on these steps runs and keeps all; take finer ones.")
        far = misses_of(fit, at[place], base[place])[2]
    machine = problem.machine_of(at[place, : fit.n], fit.combination)
    unit = miss_unit(fit)
    settings = ", ".join(f"{each.name} = {each.show(value)}" for each, value in zip(problem.space.variables, rows[place], strict=True))
    most, before = (show(each, unit, 4) for each in (float(far.max()), answer.most))
    sentence = said("{settings}: at most {most} off, unrounded {before}.", settings=settings, most=most, before=before)
    return RoundedMachine(machine, float(error[place]), float(far.max()), sentence)
