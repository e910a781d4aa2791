"""Where something is looked at: the box of the strokes, a path through places, or some poses; and which load cases occur there."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from difflib import get_close_matches
from typing import Any, ClassVar, Self

import numpy as np
import numpy.typing as npt

from ..errors import DefinitionError, FormerName, cited, ensure, is_listed, known_name, require, unknown
from ..frozen import FrozenDict, record
from ..language import said
from ..loads import PLAIN_CASE, Case, LoadCase
from ..plan import Mask, Plan, require_kind
from ..program import FloatArray
from ..quantities import Curve, Member, PoseCondition, Quantity, Stroke, is_number, keywords, name_of, needs, numbers_in, quantity, real
from ..quantities.course import Course, check_rising, course_of
from ..quantities.member import of_kind
from ..units import Amount, amount_or_float, amounts_in, require_measure, show
from .grid import MotionLike
from .instants import Instants
from .limits import span_text, stroke_unit, way_text
from .requests import is_of_force
from .strokes import check_magnitude, strokes_over_axes

OPTIONS = ("only", "cases", "lost", "time")
"""What an `Over` takes beside strokes: no stroke of a machine may be called so."""
ALLOWED = "allowed"


class Over(Member):
    """The domain of a machine. Declared in the class it is where the machine really runs: `loading = Over.path(phi=[...], t=[...])`.

    `Over(phi=(15 * deg, 80 * deg), t=0.0)` is a box. `Over.path(phi=[...], psi=[...])` are straight legs through places in this order, and
    `Over.poses(...)` these poses and nothing between. `Over.path(time=[0, 2, 4], phi=[...])` is a path in time [s], and so is one with a
    `Course`, a `ramp` or a `Curve` over time for a stroke: then rates and accelerations are known, and the machine moves as it runs.
    `machine.sweep(101, over="loading")` is the motion along it.

    Parameters
    ----------
    only : condition or sequence of conditions, optional
        Conditions on poses, `only=[x("T") <= 4]`: poses outside of them are not looked at.
    cases : sequence of LoadCase or str, optional
        The load cases that occur there, "plain" for the machine's own loads; by default all declared and the plain one.
    lost : str, optional
        With "allowed", places that cannot be assembled are part of the machine.
    **strokes : float, quantity, str or pair of them
        Strokes by name [SI]: a pair runs, a number is held. Strokes that are not named run over their range. Ends may be quantities of the
        design, or their names.

    Raises
    ------
    DefinitionError
        A range, a condition, a case or a word is not what it can be.
    """

    kind: ClassVar[str] = "over"
    shape: str
    strokes: Mapping[str, Any]
    only: tuple[PoseCondition, ...]
    _cases: tuple[str | LoadCase, ...] | None
    lost: str
    time: tuple[float, ...] | None
    """The instants of a path in time [s]: of each place, or those at which it begins and ends; None of any other."""
    found_in_run: Mapping[str, Any] = FrozenDict()
    """What a run that made this path found on its way, by the member that ran it; nothing of a path that is given."""

    def __init__(
        self,
        *,
        only: Sequence[PoseCondition] | PoseCondition = (),
        cases: Sequence[object] | None = None,
        lost: str = "",
        **strokes: object,
    ) -> None:
        self._hold("box", strokes, only, cases, lost)

    @classmethod
    def path(
        cls,
        *,
        only: Sequence[PoseCondition] | PoseCondition = (),
        cases: Sequence[object] | None = None,
        lost: str = "",
        time: npt.ArrayLike | None = None,
        **strokes: object,
    ) -> Self:
        """Return straight legs through places in this order, or a path in time.

        Parameters
        ----------
        only, cases, lost : optional
            As of `Over`.
        time : array_like, optional
            The instants of the places [s], rising; or a pair `(begin, end)`, where strokes have courses. Without it the longest course
            decides.
        **strokes : array_like, Course or Curve
            An array of values for each stroke [m or rad], as many each; a number is held. Over time also a `Course`, such as `ramp(...)`,
            or a `Curve` of seconds. One that ends before the others holds its last value.

        Returns
        -------
        Over
            The path.

        Raises
        ------
        DefinitionError
            Instants that do not rise, values without instants, a periodic curve that does not fit the time of the path.
        """
        return cls._of_places("path", strokes, only, cases, lost, time)

    @classmethod
    def poses(
        cls, *, only: Sequence[PoseCondition] | PoseCondition = (), cases: Sequence[object] | None = None, lost: str = "", **strokes: object
    ) -> Self:
        """Return these poses and nothing between them: an array of values for each stroke, as many each; a number is held.

        Parameters
        ----------
        only : PoseCondition or sequence, optional
            Conditions on the poses.
        cases : sequence, optional
            The load cases that occur there.
        lost : str
            "allowed" where poses may be out of reach.
        **strokes : array_like
            Values for each stroke [m or rad], as many each; a number is held.

        Returns
        -------
        Over
            The poses.
        """
        return cls._of_places("poses", strokes, only, cases, lost)

    @classmethod
    def _of_places(cls, shape: str, strokes: Mapping[str, object], only: object, cases: object, lost: object, time: object = None) -> Self:
        found = cls()
        object.__setattr__(found, "_name", "")
        found._hold(shape, strokes, only, cases, lost, time)
        return found

    def _hold(self, shape: str, strokes: Mapping[str, object], only: object, cases: object, lost: object, time: object = None) -> None:
        """Store the arguments; DefinitionError for a wrong stroke, condition, case or word."""
        if "time" in strokes:
            what = f"Over{'' if shape == 'box' else f'.{shape}'}(time={cited(strokes['time'])})"
            raise DefinitionError(f"{what}: time is that of a path; write Over.path(time=..., ...), no box and no poses.")
        values = {name: box_ends(name, value) if shape == "box" else place_values(shape, name, value) for name, value in strokes.items()}
        counts = {name: len(value) for name, value in values.items() if isinstance(value, tuple)}
        if shape != "box" and len({*counts.values()}) > 1:
            each = ", ".join(f"{name} has {count}" for name, count in counts.items())
            raise DefinitionError(f"Over.{shape}: {each} values; give each stroke as many, or one number where it is held.")
        instants = instants_given(time, values)
        listed = only if is_listed(only) else (only,)
        for condition in listed:
            if not isinstance(condition, PoseCondition):
                what = f"Over(only=...): {cited(condition)} is no condition on poses"
                raise DefinitionError(f'{what}; write comparisons, only=[x("T") <= 4].')
        if isinstance(cases, (str, LoadCase)):
            raise DefinitionError(f"Over(cases={cited(cases)}): a list of load cases is expected, cases=({cited(cases)},).")
        named = is_listed(cases) and all(isinstance(each, (str, LoadCase)) for each in cases)
        if cases is not None and not (named and cases):
            raise DefinitionError(f'Over(cases={cited(cases)}): names of load cases are expected, cases=("full",); leave it out for all.')
        require(lost in ("", ALLOWED), "Over(lost", lost, '"allowed" is expected, or nothing: places that are lost are then a fault')
        occurring = tuple(cases) if is_listed(cases) else None  # those of its own class have no names yet
        held = {"shape": shape, "strokes": FrozenDict(values), "only": tuple(listed), "_cases": occurring, "lost": lost, "time": instants}
        for name, value in held.items():
            object.__setattr__(self, name, value)

    @property
    def cases(self) -> tuple[str, ...] | None:
        """The names of the load cases that occur there; None for all."""
        return None if self._cases is None else tuple(map(name_of, self._cases))

    def parts(self) -> tuple[Any, ...]:
        return ()

    def among(self, members: Mapping[str, Member]) -> Over:
        """Return it with load cases that are called by their titles under their names in the class."""
        if self._cases is None:
            return self
        declared = of_kind(members, LoadCase)
        named = {each.title: name for name, each in declared.items()} | {name: name for name in (PLAIN_CASE, *declared)}
        cases = [named.get(each, each) if isinstance(each, str) else each for each in self._cases]
        return self if cases == [*self._cases] else self.renewed(_cases=(*cases,))

    def examine(self, members: Mapping[str, Member], title: str) -> None:
        """Raise DefinitionError for unknown strokes and load cases, and for conditions on unknown members.

        Parameters
        ----------
        members : mapping of str to Member
            The members of the class by name.
        title : str
            The name of the class, for messages.

        Raises
        ------
        DefinitionError
            An unknown stroke or load case, or a condition on an unknown member.
        """
        strokes = [name for name, each in members.items() if isinstance(each, Stroke)]
        self.check(title, strokes, [name for name, each in members.items() if isinstance(each, LoadCase)])
        for each in self.only:
            for name in (name for side in (each.left, each.right) if isinstance(side, (str, Quantity)) for name in needs(quantity(side))):
                known_name("Name", name, members, where=f"{title}.{self.name}: only={each}")

    def check(self, title: str, strokes: Iterable[str], cases: Iterable[str]) -> None:
        """Raise DefinitionError for strokes and load cases that there are not, and for a path that leaves a stroke open.

        Parameters
        ----------
        title : str
            The name of the class, for messages.
        strokes : iterable of str
            The strokes of the class.
        cases : iterable of str
            Its load cases.

        Raises
        ------
        DefinitionError
            An unknown stroke or load case, or a path that leaves a stroke open.
        """
        known = list(strokes)
        if set(self.strokes) == set(known) and not self.cases:
            return
        where = f"{title}.{self.name}" if self.name else f"{title}: {self}"
        for name in self.strokes:
            if name not in known:
                error = unknown("Stroke", name, known, where=where)
                near = get_close_matches(name, OPTIONS, 1)
                remedy = f"Beside strokes an Over takes {near[0]}=." if near else "Designs are varied by vary=, not by over=."
                raise DefinitionError(f"{error} {remedy}")
        missing = [name for name in known if name not in self.strokes] if self.shape != "box" else []
        what = f"{where}: it does not say where {', '.join(missing)} stand"
        ensure(not missing, f"{what}; give {keywords(dict.fromkeys(missing, '...'))}, one number where it is held.")
        for name in self.cases or ():
            known_name("Load case", name, (PLAIN_CASE, *cases), where=where)

    # -- of a machine ------------------------------------------------------------------------------------

    def instants(self, plan: Plan, number: Callable[[str | Quantity], float]) -> Instants | None:
        """Return a path in time at all breaks of its courses; None for any other. `number` gives the value of a quantity of the design.

        Parameters
        ----------
        plan : Plan
            The plan of the machine's class.
        number : callable
            Returns the value of a quantity of the design.

        Returns
        -------
        Instants or None
            The instants at all breaks.
        """
        if self.time is None:
            return None
        courses, (begin, end) = dict[str, Course](), (self.time[0], self.time[-1])
        for name in plan.strokes:
            given = self.strokes[name]
            is_course = isinstance(given, (Course, Curve))
            amount = Amount(float(given(given.breaks[0])), given.measures) if is_course and given.measures else 0.0
            require_kind(plan, name, amount if is_course else given, f"{plan.title}: {self}: {name}")
            known = given if is_course else self.numbers(given, plan, number)
            courses[name] = Course(self.time, known, "straight") if isinstance(known, list) else course_of(known, begin, end)
        found = Instants.over(courses, begin, end)
        for name, value in found.strokes.items():
            check_magnitude(name, (float(np.min(value)), float(np.max(value))), plan)
        return found

    def places(self, plan: Plan, number: Callable[[str | Quantity], float]) -> dict[str, FloatArray]:
        """Return strokes [m or rad] that span it, arrays of one shape; `number` gives the value of a quantity of the design.

        Of a box its corners, an axis for each stroke that runs; of a path the places in an array of one axis; poses in one of two.

        Parameters
        ----------
        plan : Plan
            The plan of the machine's class.
        number : callable
            Returns the value of a quantity of the design.

        Returns
        -------
        dict of str to ndarray
            The strokes [m or rad].
        """
        instants = self.instants(plan, number)
        if instants is not None:
            return instants.strokes
        for name, value in self.strokes.items():
            if next(amounts_in(value), None) is not None:
                require_kind(plan, name, value, f"{plan.title}: {self}: {name}")
        if self.shape != "box":
            known = [self.numbers(self.strokes[name], plan, number) for name in plan.strokes]
            values = dict(zip(plan.strokes, np.broadcast_arrays(*map(real, known)), strict=True))
            for name, value in values.items():
                check_magnitude(name, (float(np.min(value)), float(np.max(value))), plan)
            apart = self.shape == "poses" and len(values) > 1
            return {name: np.array(value.reshape(-1, 1) if apart else np.atleast_1d(value)) for name, value in values.items()}
        ends = {name: self.ends(name, plan, number) for name in plan.strokes}
        moving = [name for name, (low, high) in ends.items() if high > low]
        values, shape = strokes_over_axes({name: np.array(ends[name]) for name in moving}), (2,) * len(moving)
        whole = (*shape, 1) if len(shape) == 1 and len(ends) > 1 else shape  # with an axis more these poses are no path
        return {name: np.array(np.broadcast_to(values.get(name, low), shape)).reshape(whole) for name, (low, _) in ends.items()}

    def ends(self, name: str, plan: Plan, number: Callable[[str | Quantity], float]) -> tuple[float, float]:
        """Return the least and the greatest value of a stroke in a box [m or rad]; DefinitionError for an end that follows a stroke.

        Parameters
        ----------
        name : str
            The stroke's name.
        plan : Plan
            The plan of the machine's class.
        number : callable
            Returns the value of a quantity of the design.

        Returns
        -------
        tuple of float
            The least and the greatest value [m or rad].
        """
        stroke = plan.strokes[name]
        given = self.strokes.get(name, (stroke.start, stroke.end))
        found = self.numbers(given if isinstance(given, tuple) else (given, given), plan, number)
        check_magnitude(name, (found[0], found[1]), plan)
        return min(found), max(found)

    def numbers(self, given: Any, plan: Plan, number: Callable[[str | Quantity], float]) -> Any:
        """Return a stroke's value as numbers [m or rad], a list of several; DefinitionError for a quantity that follows a stroke.

        Parameters
        ----------
        given : object
            The value as it was given.
        plan : Plan
            The plan of the machine's class.
        number : callable
            Returns the value of a quantity of the design.

        Returns
        -------
        float or list of float
            The numbers [m or rad].
        """
        if isinstance(given, tuple):
            return [each if type(each) is float else self.numbers(each, plan, number) for each in given]
        if is_number(given):
            return float(given)
        if isinstance(given, str) and given in plan.table.spellings:
            return number(given)
        followed = quantity(given)
        behind = next((one for one in plan.strokes if one == followed.name or one in plan.reaches(followed)), "")
        if behind:
            what = f"{plan.title}: {self}: {followed.name or followed} depends on the stroke {behind} itself"
            raise DefinitionError(f"{what}; give a quantity of the design.")
        return number(followed)

    kept = FormerName("condition_mask")

    def condition_mask(self, motion: MotionLike) -> Mask:
        """Return the mask of poses that are asked for: those that keep all conditions, and those of which nothing says that they do not.

        A condition without a value is not kept where the machine stands; where it cannot be assembled, it leaves nothing out.

        Parameters
        ----------
        motion : Motion
            The poses; designs first, strokes last.

        Returns
        -------
        ndarray of bool
            The mask, shape (...).
        """
        found = np.ones(motion.shape, bool)
        for each in self.only:
            margin = each.margin
            with np.errstate(all="ignore"):
                at_pose = isinstance(margin, Quantity) and not margin.name
                value = motion._reading.value(margin) if at_pose else motion[margin]
                value = np.broadcast_to(value, motion.shape)
                found &= np.where(motion.reached, value >= 0.0, ~(value < 0.0))
        return found

    # -- in words ----------------------------------------------------------------------------------------

    def words(self, motion: MotionLike) -> str:
        """Return its strokes in words: `phi = 15 to 80 deg, t = 0 mm`; of a path those that each passes.

        Parameters
        ----------
        motion : Motion
            The poses; designs first, strokes last.

        Returns
        -------
        str
            The strokes in words.
        """
        plan = motion.plan
        spans_of = way_text if self.shape == "path" else span_text
        text = ", ".join(f"{name} = {spans_of(values, stroke_unit(plan, name))}" for name, values in motion.strokes.items())
        if self.shape == "path" and len(motion.strokes) > 1:
            text = said("the path {spans}", spans=text)
        elif self.shape == "poses":
            text = said("{count} poses, {spans}", count=motion.reached.size, spans=text)
        if self.time is not None:
            text = said("{spans} in {time}", spans=text, time=show(self.time[-1] - self.time[0], "s", 4))
        if not self.only:
            return text
        conditions = ", ".join(each.words() for each in self.only)
        if plan.of_kind(LoadCase) and any(is_of_force(each.margin) for each in self.only):
            conditions = said("{conditions} under the machine's own loads", conditions=conditions)
        return said("{spans}, where {conditions}", spans=text, conditions=conditions)

    def __str__(self) -> str:
        word = "Over" if self.shape == "box" else f"Over.{self.shape}"
        of_places = any(isinstance(value, tuple) for value in self.strokes.values())
        given = [f"time={[*self.time] if of_places else self.time}"] if self.time is not None else []
        given += [keywords({name: ends_text(value) for name, value in self.strokes.items()})] if self.strokes else []
        given += [f"only=[{', '.join(map(str, self.only))}]"] if self.only else []
        named = (name_of(each, is_needed=False) or str(each) for each in self._cases or ())
        given += [f"cases={(*named,)!r}"] if self._cases is not None else []
        return f"{word}({', '.join([*given, *([f'lost={self.lost!r}'] if self.lost else [])])})"

    def __repr__(self) -> str:
        return str(self)


@record
class Run:
    """The values that each moving stroke passes, as many each, and the values of those held [m or rad].

    `title` names the `Over` that it is of, `case` is the load case in which it is shown, None the machine's own loads. `apart` are poses
    with nothing between them. `worst` names the column at whose worst place strokes are held. Over a path in time, `declared`, the way is
    passed as its `instants` say.
    """

    ways: Mapping[str, tuple[float, ...]]
    held: Mapping[str, float]
    title: str = ""
    case: Case = None
    apart: bool = False
    worst: str = ""
    declared: Over | None = None
    instants: Instants | None = None

    @property
    def stroke(self) -> str:
        """The stroke that moves; of several the first, without any ""."""
        return next(iter(self.ways), "")

    @property
    def is_curve(self) -> bool:
        """Whether something moves along it; else it is poses."""
        return bool(self.ways) and not self.apart

    @property
    def poses(self) -> dict[str, FloatArray]:
        """All strokes at the values that are passed, shape (n,)."""
        count = len(self.ways.get(self.stroke, (0.0,)))
        return {name: np.broadcast_to(np.asarray(value, float), count) for name, value in {**self.held, **self.ways}.items()}

    @property
    def marks(self) -> FloatArray:
        """The share of the way at which each value is passed, 0 to 1; of several strokes the one that moves most of its travel counts."""
        steps = np.array([np.abs(np.diff(way)) / (np.ptp(way) or 1.0) for way in self.ways.values()]).max(axis=0)
        lengths = np.cumsum(steps)
        return np.concatenate([[0.0], lengths / lengths[-1]])

    def strokes_and_slopes(self, shares: FloatArray) -> tuple[dict[str, Any], dict[str, FloatArray]]:
        """Return all strokes at shares of the way (n,), 0 to 1, and how those that run go on: as on the leg that begins there."""
        marks = self.marks
        legs = np.flatnonzero(np.diff(marks) > 0.0)  # on a hold nothing moves
        leg = legs[np.clip(np.searchsorted(marks[legs], shares, side="right") - 1, 0, None)]
        strokes = {name: np.interp(shares, marks, way) for name, way in self.ways.items()}
        return {**self.held, **strokes}, {name: np.diff(way)[leg] for name, way in self.ways.items()}

    def over(self, shares: FloatArray) -> dict[str, Any]:
        """Return all strokes at shares of the way, shape (n,), 0 to 1, as `at` takes them; the given values are among them.

        Of poses apart these are the poses.
        """
        if self.instants is not None:
            return self.instants.shares(shares).strokes
        if not self.is_curve:
            return dict(self.poses)
        passed = np.array(shares, float)
        for mark in self.marks[1:-1]:
            passed[np.argmin(np.abs(passed - mark))] = mark
        return self.strokes_and_slopes(passed)[0]

    @property
    def is_path(self) -> bool:
        """Whether it is more than one stroke from end to end: several together, or one that passes other values on its way."""
        return self.instants is not None or len(self.ways) > 1 or len(self.ways[self.stroke]) != 2

    def divided(self, count: int) -> dict[str, Any]:
        """Return all strokes at so many poses or a few more: the given values, and equally many poses between any two of them."""
        if self.instants is not None:
            return self.instants.shares(np.linspace(0.0, 1.0, count)).strokes
        legs = len(self.ways[self.stroke]) - 1
        place = np.linspace(0.0, legs, legs * max(1, -(-(count - 1) // legs)) + 1)
        return {**self.held, **{name: np.interp(place, np.arange(legs + 1), way) for name, way in self.ways.items()}}


def ends_text(value: object) -> str:
    """Return the value of a stroke as it is written."""
    if isinstance(value, tuple):
        return f"({', '.join(map(ends_text, value))})"
    name = value.name if isinstance(value, Member) else ""
    return repr(float(value)) if is_number(value) else name or str(value)


def is_end(value: object) -> bool:
    """Return whether a value is a number, a quantity or a name, that of a part's with dots in it."""
    return is_number(value) or isinstance(value, Quantity) or (isinstance(value, str) and all(map(str.isidentifier, value.split("."))))


def box_ends(name: str, value: object) -> object:
    """Return the value of a stroke of a box: a number, a quantity or its name, or two of these; DefinitionError for anything else."""
    if isinstance(value, (list, tuple, np.ndarray)):
        if len(value) == 2 and all(map(is_end, value)):
            return tuple(amount_or_float(each) if is_number(each) else each for each in value)
        expected = "(low, high) or one value is expected; places in an order are Over.path(...)"
        require(not (len(value) > 2 and all(map(is_number, value))), f"Over({name}", value, expected)
    elif is_end(value):
        return amount_or_float(value) if is_number(value) else value
    ensure(not isinstance(value, PoseCondition), f"Over({name}={value}): conditions on poses go into a list, only=[{value}].")
    raise DefinitionError(f"Over({name}={cited(value)}): (low, high) or one value is expected, in SI.")


def place_values(shape: str, name: str, value: object) -> object:
    """Return the values of a stroke of a path: numbers or quantities in their order, or one where it is constant."""
    if is_end(value) and not is_number(value):
        return value
    if isinstance(value, (Course, Curve)):
        require(shape == "path", f"Over.{shape}({name}", value, "a course is of a path; write Over.path(...)")
        return value
    if is_listed(value) and any(isinstance(each, (str, Quantity, Amount)) for each in value) and all(map(is_end, value)):
        return tuple(amount_or_float(each) if is_number(each) else each for each in value)
    found = numbers_in(value)
    if found.ndim > 1 or not found.size or not np.all(np.isfinite(found)):
        raise DefinitionError(f"Over.{shape}({name}={cited(value)}): finite numbers in their order are expected, or one, in SI.")
    return tuple(found.tolist()) if found.ndim else amount_or_float(value) if is_number(value) else float(found)


def instants_given(time: object, values: Mapping[str, object]) -> tuple[float, ...] | None:
    """Return the instants of a path [s]: those given, else from where to where its courses go; None where it is none in time."""
    courses = {name: value for name, value in values.items() if isinstance(value, (Course, Curve))}
    lists = {name: value for name, value in values.items() if isinstance(value, tuple)}
    if time is None:
        if not courses:
            return None
        for name in lists:
            what = f"Over.path({name}={cited(lists[name])}): beside a course each value has an instant"
            raise DefinitionError(f"{what}; give time=[...], one for each, or a Course(times, values).")
        ends = [course.breaks[[0, -1]] for course in courses.values()]
        found = (float(min(low for low, _ in ends)), float(max(high for _, high in ends)))
    else:
        require_measure(time, "time", "Over.path: time")
        instants = numbers_in(time)
        fits = instants.ndim == 1 and instants.size > 1 and bool(np.isfinite(instants).all())
        require(fits, "Over.path(time", time, "instants in seconds are expected, one for each value, or a pair (begin, end)")
        check_rising("Over.path: time", instants)
        found = tuple(instants.tolist())
        for name, value in lists.items():
            if isinstance(time, tuple) and len(time) == 2:
                what = f"Over.path(time={cited(time)}, {name}={cited(value)}): {len(value)} values beside the begin and the end of a path"
                raise DefinitionError(f"{what}; give time=[...], an instant for each value, or a Course(times, values).")
            if len(value) != len(found):
                raise DefinitionError(f"Over.path: time has {len(found)} instants and {name} {len(value)} values; give as many of each.")
    for name, course in courses.items():
        turns = (found[-1] - found[0]) / course.period if isinstance(course, Curve) and course.period is not None else 1.0
        if round(turns) < 1 or abs(turns - round(turns)) > 1e-9 * turns:
            what = f"Over.path: {name} has a period of {course.duration:.6g} s, and the path lasts {found[-1] - found[0]:.6g} s"
            raise DefinitionError(f"{what}; give time=(begin, end) over whole periods of all its curves.")
    return found


def with_strokes(strokes: Mapping[str, FloatArray]) -> Mapping[str, FloatArray]:
    """Return the strokes of those poses that have some: a place of a path that is not reached has none, and is NaN."""
    known = np.all([np.isfinite(value) for value in strokes.values()], axis=0) if strokes else np.ones((), bool)
    return strokes if known.all() or not known.any() else {name: value[known] for name, value in strokes.items()}
