"""The search for better dimensions: many starts, one local search with exact gradients from each, over every combination of choices."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from itertools import islice
from typing import TYPE_CHECKING, Any, TypeAlias, TypedDict, Unpack, cast, overload

import numpy as np

from ..errors import (
    AssemblyError,
    DefinitionError,
    LinkageError,
    StudyError,
    ensure,
    is_listed,
    known_name,
    one_word,
    require,
    require_whole,
)
from ..loads import PLAIN_CASE, Case, LoadCase
from ..mechanism import Mechanism
from ..motion import Judge, Over, Request, measures
from ..motion.measures import At, CombinedMeasure, Constraint, FixedNumber, Leaf, Measure, Sided, Worst, in_case, strokes_behind, words_of
from ..motion.requests import Combined
from ..numeric.descent import without_repeats
from ..program import FloatArray, fixed_backend
from ..quantities import Quantity
from ..statics.applied import case_of
from ..statics.law_requests import LawRequest
from ..units import require_number, show
from .checkpoint import Checkpoint, digest, how_far
from .designs import Batch
from .infeasible import infeasible_error
from .optimum import EvaluatedDesigns, Optimum, described, in_units, on_steps, unit_of_constraint, unit_of_measure
from .problem import COARSE, SAMPLES, LimitReachedError, Problem, ranges_of
from .solver import Local, SearchEnd, grows, local_search
from .space import Space, check_one_design, unit_points
from .survey import Progress, check_progress, progress_told
from .tolerances import ToleranceLike, sigma
from .variants import Range, fitted_rows

if TYPE_CHECKING:
    from .pareto import Front

METHODS = ("auto", "local", "multistart")
SCREENED = 256
"""Designs looked at for each combination before the local searches begin; fewer each where there are many combinations."""
SCREENED_IN_ALL = 1 << 14
STARTS = 6
LOCAL_DESIGNS, POSES_AS_ONE = 40_000, 70
"""Designs of local searches where no limit is given, of few poses; poses that take as long as a design without any."""
FRONT_DESIGNS = 6000
"""Designs that the genetic search of a front looks at, of each combination."""
SEARCHED = 64
"""Combinations searched from at the most, the most promising ones of more."""
NEARLY = 1e-3
"""Designs that miss no more may yet be brought to keep all."""
HOPES = 2
"""Starts, and combinations, from which is looked for a design that keeps all where none of those spread over the box does."""
KEPT = 4
"""Combinations, and designs of each, that are judged beside the ends of local searches where the limit is reached."""
MOVED, SAME_TO_DIGITS = 16, 1e-13
"""Designs, and combinations, at which an objective is looked at that may follow nothing that varies; how near its values are then."""
NEAR = 0.1
"""Starts are not nearer to one another than this part of the box's diagonal."""


class SearchKeywords(TypedDict, total=False):
    """The keywords of a search besides its objective and `vary`; `optimise` explains each."""

    subject_to: object
    regions: Mapping[str, object] | None
    case: object
    over: Mapping[str, object] | None
    robust: Mapping[str, object] | None
    sigmas: float
    method: str
    starts: int | None
    seed: int
    limit: int | None
    folder: str | os.PathLike[str] | None
    progress: object


One: TypeAlias = Measure | Quantity | str | None
"""A single objective."""
Several: TypeAlias = Sequence[Measure | Quantity]


@overload
def optimise(
    machine: Mechanism, *, minimise: One = ..., maximise: One = ..., vary: Mapping[object, object], **more: Unpack[SearchKeywords]
) -> Optimum: ...
@overload
def optimise(
    machine: Mechanism, *, minimise: Several = ..., maximise: Several = ..., vary: Mapping[object, object], **more: Unpack[SearchKeywords]
) -> Front: ...
def optimise(
    machine: Mechanism,
    *,
    minimise: object = None,
    maximise: object = None,
    vary: Mapping[object, object],
    subject_to: object = (),
    regions: Mapping[str, object] | None = None,
    case: object = None,
    over: Mapping[str, object] | None = None,
    robust: Mapping[str, Any] | None = None,
    sigmas: float = 3.0,
    method: str = "auto",
    starts: int | None = None,
    seed: int = 0,
    limit: int | None = None,
    folder: str | os.PathLike[str] | None = None,
    progress: Any = False,
) -> Optimum | Front:
    """Return the best design of a machine: `optimise(hitch, maximise=least(capacity("lift", "G")), vary={"OB": (0.27, 0.33)})`.

    What is to be least or greatest is one number of a design: `least(q)`, `most(q)`, `integral(q)`, `at(q, S=...)` of a quantity q (an
    output, `drive_force()`, `pin_force("O")`, ...) and arithmetic of them. `subject_to` are comparisons of such,
    `most(abs(ref("tilt"))) <=
    8 * deg`. They hold over the whole stroke, between the poses too; that every pose is assembled is always
    kept.

    `vary` says what may change: `"OB": (low, high)` [SI], with a third number in steps; `"M": around(60 * mm)`, of a point both
    coordinates; a list of choices; and for several names at once rows of a catalogue, `("lift.bore", "lift.rod"): [(0.1, 0.056), ...]`.
    A cylinder by its name takes rows of `hydraulics.catalogue(...)`: its sizes, and as its whole way the range of the stroke that drives
    it. The machine that comes back has that stroke.
    `regions={"M": [(0.1, 0.9), (0.4, 0.9), (0.4, 1.2)]}` keeps a point in a polygon [m], `around(radius=60 * mm)` in a circle; a list of
    shapes allows any of them, `outside(...)` none, and an outline of the frame goes by its name, `["plate", outside("wheel")]`.
    `over={"S": (0.0, 0.2)}` looks at a part of the stroke; an end may be a quantity that follows the design. `case` names a load case or
    several, all of which are kept and the worst of which counts. With their hours, `case={"empty": 700, "full": 300}`, the mean of the
    objective counts, by hours or shares alike, as they are divided by their sum.

    Of several objectives, given as lists, the front comes back: designs of which none is better in all (extra `pareto`). With
    `robust={"OB": 0.2 * mm}` every number counts as bad as `sigmas` standard deviations make it, by tolerances as in `tolerance`.

    From the best of some hundred designs spread over the box, `starts` of them for each combination of choices, SciPy's SLSQP goes on
    with exact derivatives. `method="local"` begins with the machine as it is. The same seed gives the same result. `limit` is how many
    designs are looked at before the best so far comes back, with a word that it is that. By default as many as take about a minute. With
    `folder` finished searches are kept there, and the same call goes on where another one stopped; `progress=True` shows a bar.

    A design that has no value of a condition at some pose does not keep it, and a quotient whose divisor passes zero within the stroke has
    no value. Lengths, angles, forces and pressures neither add nor compare. What limits the result is said: conditions, ends of ranges,
    and where the machine itself allows no more.

    Raises DefinitionError for what cannot be asked, and StudyError if no design can be assembled over the whole stroke. Its
    InfeasibleError, if none keeps all, has the conflict, the least relaxation and what one condition alone would have to give.

    Parameters
    ----------
    machine : Mechanism
        The design.
    minimise : Measure or list, optional
        The objective, or several for a front.
    maximise : Measure or list, optional
        The objective to maximise.
    vary : mapping
        Ranges, choices or rows by the names of dimensions.
    subject_to : Condition or sequence
        The conditions.
    regions : mapping, optional
        Regions of points by their names.
    case : LoadCase, str, sequence or mapping, optional
        The load cases, or their hours.
    over : mapping, optional
        The ranges of the strokes [m or rad], an `Over` or its name; by default the one `Over` that the class declares, else all strokes.
    robust : mapping, optional
        Tolerances of dimensions by name [SI].
    sigmas : float
        The number of standard deviations.
    method : str
        "auto" or "local".
    starts : int, optional
        The number of local searches.
    seed : int
        The seed of the designs spread over the box.
    limit : int, optional
        The number of designs after which it ends.
    folder : str or Path, optional
        Where finished searches are kept.
    progress : callable or bool, optional
        Called with (done, total); True shows a bar.

    Returns
    -------
    Optimum or Front
        The best design; of several objectives the front.

    Raises
    ------
    DefinitionError
        A wrong argument.
    StudyError
        No design can be assembled.
    InfeasibleError
        No design keeps all conditions.
    """
    check_one_design(machine)
    title = machine.plan.title
    one_word("method", method, METHODS)
    check_counts(title, starts, seed, limit)
    check_progress(progress)
    machine, vary, travels = fitted_rows(machine, vary)
    objectives, sense = objectives_of(machine, minimise, maximise)
    space = Space.of(machine, vary, regions)
    sides = space.sides([0] * len(space.choices))
    if sides:
        text = f"the side of {next(iter(sides))} is varied by synthesise alone; for optimise write a class for each side"
        raise DefinitionError(f"{title}: {text}, class Other({type(machine).__name__}).")
    constraints = [*measures.conditions_of(subject_to, machine), *space.conditions]
    over, occurring = where_searched(machine, over, travels)
    cases, shares = cases_searched(machine, case, occurring)
    judge = machine.judge(over)
    held = pieces_in_cases(constraints, cases, judge)
    how = method, starts or STARTS, seed
    if len(objectives) > 1:
        if (len(cases) > 1 and not shares) or robust is not None or folder is not None:
            raise DefinitionError(f"{title}: several objectives are sought in one load case, without robust= and without folder=.")
        from .pareto import front

        goals = [measures.mean_in_cases(each, shares) if shares else in_case(each, cases[0]) for each in objectives]
        problem = Problem(machine, goals, held, space, 1.0, over)
        problem.count.limit = limit or default_limit(problem, FRONT_DESIGNS)
        check_objectives_move(problem)
        with progress_told(progress, machine.plan.heading) as tell:
            return front(problem, seed, tell)
    sought = [measures.mean_in_cases(objectives[0], shares)] if shares else [in_case(objectives[0], each) for each in cases]
    if all(each is objectives[0] for each in sought):
        sought = [objectives[0]]  # it names its load cases itself
    best: Optimum | None = None
    kept: Checkpoint | None = None
    with progress_told(progress, machine.plan.heading) as tell, fixed_backend("numpy"):  # the same to the last bit whatever ran before
        while True:
            worse = [] if shares else worse_pieces(objectives[0], sense, cases, judge)
            known = set(map(str, sought))
            added = [each for each in worse if str(each) not in known]
            if best is not None and not added:
                return best
            sought += added  # what a winner's movements need and no design before it needed is sought as well
            problem = Problem(machine, sought, held, space, sense, over)
            if robust is not None:
                problem = with_spread(problem, robust, sigmas)
            check_objectives_move(problem)
            problem.count.limit = limit or default_limit(problem)
            if folder is not None:
                facts = digest(f"{problem.facts} {problem.function_texts()} {how}")
                kept = kept.stage(f"search_{len(sought)}", facts.encode()) if kept else Checkpoint.of(folder, {"search": facts}, "search")
            best = DesignSearch(problem, *how, kept, tell).run()
            judge = best.machine.judge(over)


def where_searched(machine: Mechanism, over: Any, travels: Mapping[str, Range]) -> tuple[Any, list[Case]]:
    """Return the part of each stroke that a search looks at, and the load cases that occur there, None for the plain loads.

    `over` is a dictionary, an `Over` or the name of one that the class declares. Without it that one which is all that the machine runs,
    if that is a box, else all strokes, and `travels`, the ways of cylinders by their rows. DefinitionError for a path, poses and conditions
    on poses, which a search does not run along.
    """
    plan, title = machine.plan, machine.plan.title
    declared = plan.of_kind(Over)
    if isinstance(over, str):
        over = declared[known_name("Over", over, declared, where=title)]
    elif over is None and len(declared) == 1:
        over = next((each for each in declared.values() if each.shape == "box" and not each.only), None)
    occurring: list[Case] = [None, *plan.of_kind(LoadCase)]
    if not isinstance(over, Over):
        ranges_of(machine, over)  # which refuses what is none
        return {**travels, **(over or {})} or over, occurring
    over = over.among(plan.members)
    over.check(title, plan.strokes, plan.of_kind(LoadCase))
    remedy = "give a box, over={...}, and ask the design that is found machine.answers([...], over=...)"
    ensure(over.shape == "box" and not over.only, f"{title}: over={over.name or over}: a search runs over a box of strokes; {remedy}.")
    if over.cases is not None:
        occurring = [None if name == PLAIN_CASE else name for name in over.cases]
    return {**travels, **over.strokes}, occurring


def cases_searched(machine: Mechanism, case: Any, occurring: Sequence[Case]) -> tuple[list[Case], dict[str, float]]:
    """Return the load cases that a search looks at, None for the plain loads, and their shares where they are given with their hours.

    DefinitionError for one that is unknown, and for none.
    """
    shares = measures.shares_of(case, f"{machine.plan.title}: case") if isinstance(case, Mapping) else {}
    listed = list(case) if is_listed(case) else occurring if case is None else [case]
    given: Sequence[Case] = [*shares] if shares else listed
    cases = [None if isinstance(each, str) and each == PLAIN_CASE else each for each in given]
    require(cases, f"{machine.plan.title}: case", case, "a load case or several are expected; leave it out for the own loads")
    for each in cases:
        case_of(machine.plan, each)
    return cases, shares


def default_limit(problem: Problem, evolved: int = 0) -> int:
    """Return how many designs a search looks at where nothing is said: those spread over the box, and about a minute of local searches.

    Of each combination so many are `evolved`. A design with derivatives takes about 1.5 ms, and one more for some 70 poses of it.
    """
    count = problem.space.count
    spread = (max(min(SCREENED, SCREENED_IN_ALL // count), 16) + evolved) * count
    return spread + int(LOCAL_DESIGNS / (1.0 + problem.poses / POSES_AS_ONE))


def objectives_of(machine: Mechanism, minimise: object, maximise: object) -> tuple[list[Measure], float]:
    """Return the measures to minimise, or a single one to maximise (the sense is then -1.0).

    DefinitionError for none, and for what has a value at every pose.
    """
    title = machine.plan.title
    groups: tuple[list[Measure], list[Measure]] = ([], [])
    for given, group in zip((minimise, maximise), groups, strict=True):
        for each in [] if given is None else given if is_listed(given) else [given]:
            if isinstance(each, Measure):
                group.append(each)
                continue
            quantity = measures.require_quantity(each, "minimise")
            if isinstance(quantity, Worst) or strokes_behind(machine.plan, quantity):
                remedy = "say which is meant, least(...), most(...)"
                raise DefinitionError(f"{title}: {words_of(quantity)} has a value at every pose: {remedy}.")
            group.append(At(quantity, {}))
    least, most = groups
    ensure(least or most, f"{title}: say minimise= or maximise=, one measure such as least(...), or a list of several.")
    if len(least) + len(most) == 1:
        return least or most, 1.0 if least else -1.0
    return [*least, *(-each for each in most)], 1.0


def check_counts(title: str, starts: object, seed: object, limit: object) -> None:
    """Raise DefinitionError for numbers that are none."""
    for name, value, least in (("starts", starts, 1), ("seed", seed, 0), ("limit", limit, 1)):
        if value is not None:
            require_whole(f"{title}: {name}", value, f"a whole number is expected, at least {least}", least=least)


def check_objectives_move(problem: Problem) -> None:
    """Raise StudyError where no variable moves the objective: it is the same for designs spread over the box."""
    alone, space = problem.sampled_apart(counted=False), problem.space
    units = unit_points(MOVED, len(space.variables), "sobol", 0) if space.variables else np.zeros((1, 0))
    some = islice(space.combinations(), MOVED)
    seen = np.concatenate([alone.merits_of_each(each, units)[0] for each in some], axis=1)
    seen = seen[:, np.isfinite(seen).all(axis=0)]
    if seen.shape[1] > 1 and bool(np.all(np.ptp(seen, axis=1) <= SAME_TO_DIGITS * np.abs(seen).max(axis=1))):
        names = ", ".join([each.name for each in space.variables] + [name for group in space.names for name in group])
        fixed = zip(problem.objectives, seen[:, 0], strict=True)
        said = " and ".join(f"{each}, which is {show(float(value), unit_of_measure(problem.plan, each))}" for each, value in fixed)
        what = f"{problem.plan.title}: nothing that varies moves {said} whatever {names}"
        raise StudyError(f"{what}; vary what it depends on, or give another objective.")


# Load cases.

def each_in_cases(asked: Sequence[Sided], cases: Sequence[Case], machine: Mechanism) -> tuple[Sided, ...]:
    """Return measures or constraints as a judge is to look at them: in the load cases of a search, themselves where these are all."""
    if {*cases} == {None, *machine.plan.of_kind(LoadCase)}:
        return tuple(asked)
    return tuple(dict.fromkeys(in_case(one, PLAIN_CASE if each is None else each) for one in asked for each in cases))


def pieces_in_cases(constraints: Sequence[Constraint], cases: Sequence[Case], judge: Judge) -> list[Constraint]:
    """Return the smooth pieces of constraints that a judge looks at, each with the forces of the load cases where it names none itself."""
    found: list[Constraint] = []
    for one in constraints:
        own = [in_case(one, PLAIN_CASE if each is None else each) for each in cases]
        if all(each is one for each in own):
            found += judge.split(one)
            continue
        for case, situated in zip(cases, own, strict=True):
            pieces = judge.split(situated)
            found += [one] if case is None and len(pieces) == 1 else pieces
    return found


def in_motion(request: object) -> bool:
    """Return whether a request is of forces in a direction of motion, or computed from such."""
    if isinstance(request, Combined):
        return any(map(in_motion, request.requests))
    return isinstance(request, LawRequest) and request.situation.is_moving


def worse_pieces(objective: Measure, sense: float, cases: Sequence[Case], judge: Judge) -> list[Measure]:
    """Return the pieces of an objective, in a direction of motion, that are somewhere worse than at rest, as with friction."""
    asked = Constraint(objective, "<=" if sense > 0.0 else ">=", FixedNumber(0.0))
    pieces, motion = [each.left for each in pieces_in_cases([asked], cases, judge)], judge.motion._with_gaps()

    def values(measure: Measure) -> FloatArray:
        """Return its quantity over the poses, greater where it is worse, the least number where there is none."""
        return np.asarray(np.nan_to_num(sense * motion[cast(Request, cast(Leaf, measure).quantity)], nan=-np.inf))

    moving = [each for each in pieces if any(in_motion(leaf.quantity) for leaf in each.leaves)]
    if not moving or not isinstance(objective, Leaf):
        return moving
    rest = np.max([values(in_case(objective, each)) for each in cases], axis=0)
    return [each for each in moving if np.any(values(each) > rest + SAME_TO_DIGITS * np.abs(rest))]


# Spread: each number as bad as tolerances make it.


def with_spread(problem: Problem, tolerances: Mapping[str, ToleranceLike], sigmas: object) -> Problem:
    """Return a problem whose numbers are worse by so many standard deviations from the tolerances of dimensions."""
    title = problem.plan.title
    sigmas = require_number(f"{title}: sigmas", sigmas, "a number is expected, zero or more", least=0.0)
    present = problem.space.unit(problem.space.present(problem.machine))
    values = problem.evaluated(problem.dimensions_at(present, [0] * len(problem.space.choices))).of_one
    if not all(map(np.isfinite, values.values())):
        raise DefinitionError(f"{title}: robust= starts from a design that can be assembled over the whole stroke; set the machine so.")

    def spread(expression: Measure, sense: float) -> Measure:
        """Return an expression with its leaves moved the way in which it gets less (sense -1.0) or more, so many standard deviations."""
        found = expression
        for leaf in expression.leaves:
            quantity: Any = leaf.quantity
            what = f"{title}: robust= needs exact derivatives, and {words_of(quantity)} has none"
            ensure(isinstance(quantity, (str, Quantity, Request)), f"{what}; take a quantity or a request.")
            by = sense * float(np.sign(grows(expression, leaf, values))) * sigmas
            if by != 0.0:
                own = measures.bound_quantity(problem.plan, quantity) if isinstance(quantity, str) else quantity
                found = with_leaf(found, leaf, replace(leaf, quantity=own + by * sigma(own, tolerances)))
        return found

    objectives = [spread(each, problem.sense) for each in problem.objectives]
    constraints = list(problem.constraints)
    for place, each in enumerate(constraints):
        if each.symbol != "==":  # its sides are spread against it
            sense = -1.0 if each.symbol == ">=" else 1.0
            constraints[place] = Constraint(spread(each.left, sense), each.symbol, spread(each.right, -sense))
    return problem.changed(objectives=objectives, constraints=constraints, count=None)


def with_leaf(measure: Measure, leaf: Leaf, other: Leaf) -> Measure:
    """Return a measure with another leaf in the place of one."""
    if isinstance(measure, CombinedMeasure):
        return replace(measure, left=with_leaf(measure.left, leaf, other), right=with_leaf(measure.right, leaf, other))
    return other if measure is leaf else measure


# The search.


class DesignSearch:
    """One search under way."""

    def __init__(self, problem: Problem, method: str, starts: int, seed: int, checkpoint: Checkpoint | None, tell: Progress) -> None:
        self.problem, self.method, self.many, self.seed, self.checkpoint, self.tell = problem, method, starts, seed, checkpoint, tell
        self.kept = {str(values["task"][0]): values for each in (checkpoint.batches() if checkpoint else ()) if (values := each.values)}
        """What is kept of local searches that are done, by their tasks."""
        self.coarse = problem.sampled_apart(COARSE)
        self.cut: list[str] = []
        self.spread_words = ""
        self.looked: list[EvaluatedDesigns] = []
        self.present = problem.space.present(problem.machine)
        self._known: dict[tuple[int, ...], tuple[Problem, list[SearchEnd]]] = {}
        """Of each combination where searches ended, and the problem with the samples that these ask for."""

    def run(self) -> Optimum:
        """Return the best design."""
        space, plan, left = self.problem.space, self.problem.plan, []
        for combination in space.combinations():
            for condition in self.problem.constraints if space.count > 1 else ():
                margin = self.problem.certainly(condition.margin, combination)
                if margin is not None and (margin.high < 0.0 or (condition.symbol == "==" and margin.low > 0.0)):
                    units = unit_of_constraint(plan, condition)
                    short = show(-margin.high if margin.high < 0.0 else margin.low, units, 4)
                    self.cut.append(f"{space.words(combination, plan)}: {in_units(condition, units)} is missed by {short} at least")
                    break
            else:
                left.append(combination)
        if not left:
            raise StudyError(f"{self.problem.plan.title}: no combination of choices can keep the conditions: {self.cut[0]}.")
        if not space.variables:
            ended = self.ends([(each, 0, np.zeros((1, 0))) for each in left])
            return self.chosen(ended, searched=len(ended))
        screened = [self.screened(each) for each in left if not self.problem.count.is_spent]
        count = sum(int(np.sum(each.reached == 1.0)) for each in screened)
        if not count:
            raise self.unreachable(screened)
        if not any(np.any(each.begins) for each in screened):
            text = f"{', '.join(map(str, self.problem.objectives))} has no value at any of {count} designs that can be assembled"
            raise StudyError(f"{self.problem.plan.title}: {text}; say what has one there, or widen vary=.")
        screened = sorted((each for each in screened if np.any(each.begins)), key=lambda each: each.best)[:SEARCHED]
        hopeless = self.hopeless(screened)
        if hopeless:
            raise self.infeasible(hopeless)
        tasks = [(each.combination, number, unit) for each in screened for number, unit in enumerate(self.starts_in(each, len(screened)))]
        ended = self.ends(tasks)
        if self.problem.count.is_spent:  # the most promising designs that no local search began with, too
            problem = self.problem.sampled_apart(SAMPLES)
            with problem.count.without_limit():
                for each in screened[:KEPT]:
                    for unit in each.unit[[place for place in each.order()[:KEPT] if each.begins[place]]]:
                        with suppress(LinkageError):
                            ended.append(Local(problem, each.combination, unit).judged(unit))
        return self.chosen(ended, searched=len(screened))

    def ends(self, tasks: Sequence[tuple[tuple[int, ...], int, FloatArray]]) -> list[SearchEnd]:
        """Return the results of local searches, of a combination, a number and a start each: all, or those within the limit."""
        ended: list[SearchEnd] = []
        self.tell(0, len(tasks))
        for done, (combination, number, unit) in enumerate(tasks):
            try:
                ended.append(self.ended(combination, unit, number))
            except LimitReachedError:
                break
            except KeyboardInterrupt as stopped:
                stopped.add_note(how_far(done, len(tasks), "local searches", self.checkpoint.folder if self.checkpoint else None))
                raise
            self.tell(done + 1, len(tasks))
        return ended

    def hopeless(self, screened: Sequence[EvaluatedDesigns]) -> list[SearchEnd]:
        """Return designs that miss conditions least, by few poses, where nothing nearby keeps all; none where there is hope.

        That is looked for where none of the designs spread over the box keeps all: from some of them, letting conditions give way. At few
        poses they are missed by less than over the whole stroke.
        """
        problem, found = self.problem, []
        if not problem.space.variables or len(screened) > HOPES or any(each.best[0] == 0.0 for each in screened):
            return []
        if self.method == "local" or not problem.constraints:
            return []
        for each in screened:
            for unit in self.starts_in(each, len(screened))[:HOPES]:
                try:
                    local = Local(problem.sampled_apart(SAMPLES), each.combination, unit, elastic=problem.constraints)
                    least = local.least()
                except LimitReachedError:
                    return []
                except LinkageError:
                    continue
                if least is None or least.missing <= NEARLY or problem.count.is_spent:
                    return []
                found.append(least)
        return found

    def infeasible(self, ended: Sequence[SearchEnd]) -> StudyError:
        """Return the error of a search that came to designs none of which keeps everything."""
        with self.problem.count.without_limit():
            return infeasible_error(self.problem, ended, {each.combination: each.unit for each in reversed(self.looked)})

    # -- screening -----------------------------------------------------------------------------------------

    def screened(self, combination: tuple[int, ...]) -> EvaluatedDesigns:
        """Return designs spread over the box of one combination, looked at all at once, the present one among them."""
        space = self.problem.space
        count = 1 << max(4, (min(SCREENED, SCREENED_IN_ALL // space.count) or 1).bit_length() - 1)
        limit = self.problem.count.limit
        if limit is not None:  # half of what may be looked at is left for the local searches
            fewer = min(count, 1 << max(0, (limit // (2 * space.count) or 1).bit_length() - 1))
            self.spread_words = "" if fewer == count else f" of {fewer}"  # of other designs other searches begin
            count = fewer
        unit = unit_points(count, len(space.variables), "sobol", self.seed)
        present = space.unit(self.present)
        if self.method == "local":
            unit = present[None]
        elif np.allclose(space.values(present), self.present, rtol=0.0, atol=1e-9 * np.array([each.span for each in space.variables])):
            unit = np.concatenate([present[None], unit])
        if self.method != "local":
            unit = space.drawn(unit, self.problem.plan.title, self.seed)
        self.looked.append(EvaluatedDesigns.looked_at(self.coarse, combination, unit))
        return self.looked[-1]

    def starts_in(self, screened: EvaluatedDesigns, combinations: int) -> list[FloatArray]:
        """Return where the local searches of a combination begin: the best designs that stand apart, that of today always."""
        many = 1 if self.method == "local" else max(self.many if combinations == 1 else self.many // 2, 1)
        unit, order, apart = screened.unit, screened.order(), NEAR * np.sqrt(screened.unit.shape[1])

        def is_near(known: int, place: int) -> bool:
            return bool(np.linalg.norm(unit[place] - unit[known]) <= apart)

        chosen = [unit[place] for place in without_repeats(order[screened.begins[order]], is_near, many)]
        present = unit[0]
        if screened.begins[0] and not any(np.array_equal(each, present) for each in chosen):
            chosen = [*chosen[: max(many - 1, 0)], present]
        return chosen

    # -- local searches -------------------------------------------------------------------------------------

    def ended(self, combination: tuple[int, ...], unit: FloatArray, number: int) -> SearchEnd:
        """Return the result of the local search from a start, or the stored one."""
        task = f"{list(combination)} {number}{self.spread_words}"
        sampled, ends = self._known.setdefault(combination, (self.problem.sampled_apart(SAMPLES), []))
        known = self.kept.get(task)
        if known is not None:
            value, missing, whole, looked_at = (known[name][0] for name in ("value", "missing", "is_assembled", "looked_at"))
            found = SearchEnd(combination, known["unit"][0], float(value), float(missing), bool(whole))
            self.problem.count.designs += int(looked_at)
        else:
            problem, unit = sampled.sampled_apart(), np.ravel(unit)
            before = problem.count.designs
            try:
                found = local_search(Local(problem, combination, unit, known=ends), NEARLY)
            except LimitReachedError:
                raise
            except LinkageError:
                found = SearchEnd(combination, unit, np.nan, np.inf, False)
            if self.checkpoint is not None and not problem.count.is_spent:
                row = {**vars(found), "task": task, "looked_at": problem.count.designs - before}
                del row["combination"]  # the task says it
                self.checkpoint.keep(Batch(number, number + 1, values={name: np.array([each]) for name, each in row.items()}))
        if found.feasible and not any(np.array_equal(found.unit, each.unit) for each in ends):
            ends.append(found)
            sampled.refine(sampled.dimensions_at(found.unit, combination))
        return found

    # -- the winner -----------------------------------------------------------------------------------------

    def chosen(self, ended: Sequence[SearchEnd], searched: int) -> Optimum:
        """Return the best design that is assembled over the whole stroke and keeps everything; StudyError where there is none."""
        sense, count, lost = self.problem.sense, self.problem.count, []
        for found in sorted((one for one in ended if one.feasible), key=lambda one: sense * one.value):
            try:
                everyone = [end for end in ended if end.combination == found.combination]
                best = on_steps(self.problem, found)
                limit = count.limit if count.is_spent else None
                with count.without_limit():
                    tried = [EvaluatedDesigns.of_end(self.problem, end) for end in ended]
                    return replace(described(*best, everyone, searched, self.cut), limit=limit, tried=(*self.looked, *tried))
            except AssemblyError as error:
                lost.append(str(error))
        if lost:
            raise StudyError(f"{self.problem.plan.title}: no design that was found can be kept. {lost[0]}")
        raise self.infeasible(ended)

    def unreachable(self, screened: Sequence[EvaluatedDesigns]) -> StudyError:
        """Return the error for a box without a design that can be assembled over the whole stroke."""
        best = max(screened, key=lambda each: float(each.reached.max()))
        place, count = int(np.argmax(best.reached)), sum(len(each.unit) for each in screened)
        text = f"{self.problem.plan.title}: none of {count} designs looked at can be assembled over the whole stroke"
        try:
            self.problem.assembled(self.problem.machine_of(best.unit[place], best.combination))
        except (AssemblyError, DefinitionError) as error:
            text += f"; of the one that reaches farthest: {error}"
        else:
            text += f"; some are refused: {self.coarse.refusal}" if self.coarse.refusal else ""
        return StudyError(f"{text.rstrip('.')}. Widen vary=, or look at a part of the stroke, over={{...}}.")
