"""Tasks of a synthesis, as values that quantities are to have: paths of a point, functions of the stroke, poses of a body; their error."""

from __future__ import annotations

import operator
from collections.abc import Mapping, Sequence
from copy import copy
from dataclasses import dataclass
from functools import cached_property, reduce
from itertools import combinations
from typing import Any, TypeAlias, TypeGuard

import numpy as np

from ..errors import DefinitionError, cited, ensure, is_class_of, is_listed, is_yes, require, require_type
from ..frozen import frozen, immutable, read_only, refuses_changes
from ..mechanism import Mechanism
from ..motion import ratio
from ..motion.measures import Measure, at, least, measure_of
from ..motion.strokes import TURN, is_in_degrees
from ..plan import Mask, Plan
from ..program import FloatArray
from ..quantities import angle, numbers_in, ref, x, y
from ..study.problem import is_still, ranges_of
from ..study.space import check_one_design
from ..study.variants import Range
from ..units import require_measure, require_number

SAME_PLACE = 1e-9
"""Of a task's size: the last point is the first one again where it is so near to it."""


@immutable
class TaskRows:
    """The values wanted by a task: quantities, their values (r, n) [SI], NaN where none, the weight of each, and which count modulo a turn.

    `is_path` says that the first two are the coordinates of one point, and no other; `is_closed` that this path is a closed curve.
    """

    quantities: tuple[Any, ...]
    wanted: FloatArray
    weights: FloatArray
    turns: FloatArray
    is_path: bool
    is_closed: bool = False

    @property
    def count(self) -> int:
        """How many points the task has."""
        return int(self.wanted.shape[1])

    @property
    def steps_round(self) -> int:
        """How many equal steps go round: one for each point, but for the last where it is the first one again."""
        back = self.off(np.repeat(self.wanted[None, :, -1:], self.count, axis=2))[0, :, 0]
        return self.count - int(self.count > 3 and bool(np.abs(back).max() <= SAME_PLACE * self.size))

    @cached_property
    def size(self) -> float:
        """The size of the task [SI]: the largest weighed span of its values, or the largest value."""
        spans = (np.nanmax(self.wanted, axis=1) - np.nanmin(self.wanted, axis=1)) * self.weights
        return float(spans.max()) or float(np.nanmax(np.abs(self.wanted))) or 1.0

    @cached_property
    def is_wanted(self) -> Mask:
        """Which values are wanted (r, n)."""
        return np.isfinite(self.wanted)

    def off(self, values: FloatArray) -> FloatArray:
        """Return how far values (m, r, n) are off, weighed, shape (m, r, n): angles modulo a turn."""
        found = values - self.wanted
        if self.turns.any():
            turn = 2.0 * np.pi * self.turns[:, None]
            found -= turn * np.round(found / np.where(turn > 0.0, turn, 1.0))
        if not self.is_wanted.all():
            found[:, ~self.is_wanted] = 0.0
        return np.asarray(found * self.weights[:, None])


@refuses_changes
@dataclass(frozen=True, eq=False, init=False)
class PathTask:
    """A path that a point is to go along: `PathTask([(0.1, 0.2), (0.1, 0.3)], of="P")`.

    Parameters
    ----------
    points : array (n, 2)
        The points of the path [m].
    of : str or mapping, optional
        The point that goes along it; for several classes `{FourBar: "P", Jansen: "F"}`. By default that which the machine names as that of
        its coupler, `Featured(coupler="P")`.
    at : array (n,), optional
        The strokes of timed points [SI].
    in_order : bool, optional
        Whether points that are not timed are passed in their order, to either side, within one turn. This is the default.
    closed : bool, optional
        Whether the path is a closed curve, along all of which the machine goes in one turn of its crank. By default it is where its last
        point is its first one.
    """

    points: FloatArray
    of: Any
    at: FloatArray | None
    in_order: bool
    closed: bool

    def __init__(self, points: object, of: object = None, at: object = None, *, in_order: bool = True, closed: bool | None = None) -> None:
        what = f"PathTask(of={cited(of)})"
        require_measure(points, "length", f"{what}: points")
        found = table_of(what, "points", points, 2)
        different = len(np.unique(found, axis=0))
        if closed is None:
            closed = different >= 3 and bool(np.abs(found[0] - found[-1]).max() <= SAME_PLACE * np.ptp(found, axis=0).max())
        elif closed and different < 3:
            raise DefinitionError(f"{what}: closed=True: a closed curve has at least three different points; give more of it.")
        timed = timed_strokes("PathTask", at, len(found))
        ordered, shut = is_yes(f"{what}: in_order", in_order), is_yes(f"{what}: closed", closed)
        vars(self).update(points=found, of=of, at=timed, in_order=ordered, closed=shut)

    def rows(self, machine: Mechanism) -> TaskRows:
        """Return the values wanted of a machine.

        Parameters
        ----------
        machine : Mechanism
            The design.

        Returns
        -------
        TaskRows
            The values.
        """
        of = task_named_in(machine, self).of
        check_point(machine, of)
        return TaskRows((x(of), y(of)), read_only(self.points.T), np.ones(2), np.zeros(2), True, self.closed)


@refuses_changes
@dataclass(frozen=True, eq=False, init=False)
class FunctionTask:
    """Values that an output or a quantity is to have at strokes: `FunctionTask([0.0, 0.1], [0.0, 5 * deg], of="tilt")`.

    Parameters
    ----------
    strokes : array (n,)
        The strokes [SI].
    values : array (n,) or (k, n)
        The values [SI], a row for each quantity, NaN where one is not wanted. The first quantity has a value at every stroke. Angles count
        modulo a turn.
    of : str, quantity, list or mapping
        The quantity, or a list of several, `of=["tilt", ratio("tilt")]`. For several classes a dictionary of one quantity, class by class.
    within : float or sequence of float, optional
        The size of a miss that counts as 1, for each quantity [SI], 1 by default.
    """

    at: FloatArray | None
    values: FloatArray
    of: Any
    others: tuple[tuple[Any, FloatArray], ...]
    within: FloatArray
    in_order: bool

    def __init__(self, strokes: object, values: object, of: object, *, within: object = None) -> None:
        several = is_listed(of)
        quantities = list(of) if is_listed(of) else [of]
        what = f"FunctionTask(of={cited(of)})"
        rows = list(values) if isinstance(values, (list, tuple, np.ndarray)) else []
        if several:
            text = f"{what}: {len(rows)} rows of values for {len(quantities)} quantities; give a row for each."
            ensure(quantities and len(rows) == len(quantities), text)
        rows = [table_of(what, "values", rows[0] if several else values, 0), *(rows[1:] if several else [])]
        for place, each in enumerate(rows[1:], 1):  # those after the first may have NaN
            row = np.array(each, float) if isinstance(each, (list, tuple, np.ndarray)) else np.empty(())
            missing = np.isnan(row) if row.shape == rows[0].shape else np.ones(1, bool)
            require(not missing.all(), f"{what}: values", each, f"{len(rows[0])} numbers are expected, NaN where nothing is wanted")
            table_of(what, "values", row[~missing], 0)
            rows[place] = read_only(row)
        if within is None:
            scale: FloatArray = np.ones(len(quantities))
        else:
            scale = table_of(what, "within", within if several else [within], 0)
        if len(scale) != len(quantities) or not (scale > 0.0).all():
            raise DefinitionError(f"{what}: within={cited(within)}: a number above zero for each quantity is expected, in SI.")
        others = tuple(zip(quantities[1:], rows[1:], strict=True))
        at = timed_strokes("FunctionTask", strokes, len(rows[0]))
        vars(self).update(values=rows[0], of=quantities[0], others=others, within=read_only(scale), at=at, in_order=True)

    def rows(self, machine: Mechanism) -> TaskRows:
        """Return the values wanted of a machine.

        Parameters
        ----------
        machine : Mechanism
            The design.

        Returns
        -------
        TaskRows
            The values.
        """
        quantities = (task_named_in(machine, self).of, *(each for each, _ in self.others))
        turns = np.array([float(measure_of(machine.plan, each) == "angle") for each in quantities])
        wanted = np.stack([self.values, *(row for _, row in self.others)])
        check_radians(f"FunctionTask(of={cited(self.of)})", "values", wanted[turns > 0.0].ravel())
        return TaskRows(quantities, read_only(wanted), 1.0 / self.within, turns, False)


@refuses_changes
@dataclass(frozen=True, eq=False, init=False)
class PoseTask:
    """Poses that a body is to take: `PoseTask(x, y, angle, of="C D")`.

    Parameters
    ----------
    x, y : array (n,)
        The places of its first point [m].
    angle : array (n,)
        The directions from its first point to the second [rad].
    of : str or mapping
        The body, by two of its points.
    at : array (n,), optional
        The strokes of timed poses [SI].
    length : float, optional
        The length [m] with which an angle counts, by default the distance of the two points.
    in_order : bool, optional
        Whether poses that are not timed are passed in their order. This is the default.
    """

    x: FloatArray
    y: FloatArray
    angle: FloatArray
    of: Any
    at: FloatArray | None
    length: float | None
    in_order: bool

    def __init__(
        self, x: object, y: object, angle: object, of: object, at: object = None, *, length: float | None = None, in_order: bool = True
    ) -> None:
        what = f"PoseTask(of={cited(of)})"
        for name, each, measures in (("x", x, "length"), ("y", y, "length"), ("angle", angle, "angle")):
            require_measure(each, measures, f"{what}: {name}")
        parts = {name: table_of(what, name, each, 0) for name, each in (("x", x), ("y", y), ("angle", angle))}
        sizes = ", ".join(f"{name} {len(each)}" for name, each in parts.items())
        ensure(len({len(each) for each in parts.values()}) <= 1, f"{what}: x, y and angle are to have one length; theirs are {sizes}.")
        check_radians(what, "angle", parts["angle"])
        if length is not None:
            require_number(f"{what}: length", length, "a length above zero is expected, in m", above=0.0, kind="length")
        for each in of.values() if is_by_class(of) else [of]:
            ensure(isinstance(each, str) and len(each.split()) == 2, f'{what}: two points of the body are expected, such as of="C D".')
        timed, ordered = timed_strokes("PoseTask", at, len(parts["x"])), is_yes(f"{what}: in_order", in_order)
        vars(self).update(parts, of=of, at=timed, length=length, in_order=ordered)

    def rows(self, machine: Mechanism) -> TaskRows:
        """Return the values wanted of a machine.

        Parameters
        ----------
        machine : Mechanism
            The design.

        Returns
        -------
        TaskRows
            The values.
        """
        first, second = task_named_in(machine, self).of.split()
        for each in (first, second):
            check_point(machine, each)
        if not any({first, second} <= {*body.points} for body in machine.plan.chain.bodies):
            known = ", ".join(" ".join(body.points) for body in machine.plan.chain.bodies if body.kind == "body")
            raise DefinitionError(f"{machine.plan.title}: {first} and {second} are not of one body; the bodies that move are {known}.")
        length = self.length
        if length is None:
            pose = machine.at(unreachable="nan", **machine.plan.sketch_strokes)
            far = pose.distance(first, second)
            told = f"the distance of {first} and {second} is unknown where the machine is drawn, as it cannot be assembled there"
            ensure(not np.isnan(far).all(), f"{machine.plan.title}: {told}; say PoseTask(..., length=...), in m.")
            length = float(np.nanmax(far))
        weights = np.array([1.0, 1.0, length if length > 0.0 else 1.0])
        wanted = np.array([self.x, self.y, self.angle])
        return TaskRows((x(first), y(first), angle(first, second)), wanted, weights, np.array([0.0, 0.0, 1.0]), False)


Task: TypeAlias = PathTask | FunctionTask | PoseTask


def task_named_in(machine: Mechanism, task: Task) -> Task:
    """Return a task with its subject by one name of a machine; DefinitionError where neither tells it."""
    of, title = of_class(task.of, type(machine)), machine.plan.title
    if of is None and isinstance(task, PathTask):
        of = machine.featured().coupler or None
    known = f"one of {', '.join(machine.plan.moving)}" if isinstance(task, PathTask) else "such as {FourBar: ...}"
    ensure(of is not None, f"{title}: say what of this class the task is of, of=..., {known}.")
    if of is task.of:
        return task
    found = copy(task)
    vars(found).update(of=of)
    return found


def is_by_class(given: object) -> TypeGuard[Mapping[type[Mechanism], object]]:
    """Return whether something is said class by class: a dictionary by classes of mechanism."""
    return isinstance(given, Mapping) and bool(given) and all(is_class_of(each, Mechanism) for each in given)


def of_class(given: object, kind: type[Mechanism]) -> object:
    """Return the value for a class, its own or its nearest base's; a value that is not given class by class as it is."""
    return next((given[each] for each in kind.__mro__ if each in given), None) if is_by_class(given) else given


def table_of(what: str, name: str, given: object, width: int, row: str = "pairs (x, y)") -> FloatArray:
    """Return finite numbers (n,), or (n, width) where there is a width, a copy; DefinitionError for anything else."""
    found = numbers_in(given)
    shape = (found.shape[0] if found.ndim else 0, *((width,) if width else ()))
    if found.shape != shape or not found.size or not np.isfinite(found).all():
        rows, hint = f"{row}, shape (n, {width})" if width else "numbers in a row, shape (n,)", ""
        if found.ndim == (2 if width else 1) and found.size and not np.isfinite(found).all():
            hint = f"; number {int(np.argmin(np.isfinite(found.reshape(len(found), -1)).all(axis=1))) + 1} is not finite"
        elif width and found.ndim == 2 and found.shape[0] == width:
            hint = f"; these have shape {found.shape}, write np.transpose({name})"
        elif width and found.shape == (width,):
            hint = f"; write a single one as [{tuple(found.tolist())}]"
        raise DefinitionError(f"{what}: {name}={cited(given)}: finite {rows}, are expected, in SI{hint}.")
    return frozen(found)


def check_radians(what: str, name: str, angles: FloatArray) -> None:
    """Raise DefinitionError for an angle of so many turns that degrees were meant."""
    for value in angles.tolist():
        text = f"{what}: {name}: {value:.6g} is an angle in radians, {value / TURN:.3g} turns"
        ensure(not is_in_degrees(value, abs(value)), f"{text}; write {value:.6g} * deg if these are degrees, or take whole turns off.")


def timed_strokes(what: str, given: object, count: int) -> FloatArray | None:
    """Return the strokes of timed points (n,); DefinitionError where they are not as many as the points."""
    if given is None and what != "FunctionTask":
        return None
    found = table_of(what, "at" if what != "FunctionTask" else "strokes", given, 0)
    ensure(len(found) == count, f"{what}: {len(found)} strokes for {count} points; say the stroke of each.")
    return found


def check_point(machine: Mechanism, name: object) -> None:
    """Raise DefinitionError for anything but a point of a machine that moves."""
    expected = f"a point that moves is expected, one of {', '.join(machine.plan.moving)}"
    require(isinstance(name, str) and name in machine.plan.moving, f"{machine.plan.title}: of", name, expected)


AskedTasks: TypeAlias = Sequence[tuple[str, object, type]]
"""What stands under each keyword of a task, with its kind."""


def task_of(title: str, given: AskedTasks) -> Task:
    """Return the one task that is given by its keyword; DefinitionError for none, several, or another kind."""
    said = [(name, value, kind) for name, value, kind in given if value is not None]
    ensure(len(said) == 1, f"{title}: say one task, path=PathTask(...), function=FunctionTask(...) or motion=PoseTask(...).")
    ((name, value, kind),) = said
    return require_type(f"{title}: {name}", value, kind, f"a {kind.__name__}(...) is expected")


def timed_as(title: str, task: Task, timed: object) -> object:
    """Return how the points of a task are timed: True, False or "steps"; by default True where their strokes are said."""
    if timed is None:
        return task.at is not None
    require(timed is True or timed is False or timed == "steps", f"{title}: timed", timed, 'True, False or "steps" is expected')
    if timed is True and task.at is None:
        raise DefinitionError(f"{title}: timed=True: the points have no strokes; give them, at=[...], or say timed=False.")
    if isinstance(task, FunctionTask) and timed is not True:
        raise DefinitionError(f"{title}: timed={cited(timed)}: a function is of its strokes, which are said; leave it out.")
    return timed


Squares: TypeAlias = tuple[Measure, ...]
"""The square of how far each point is missed [SI^2]."""


def task_error(
    machine: Mechanism, task: Task, strokes: object = None, *, timed: bool | None = None, over: Mapping[str, object] | None = None
) -> Measure:
    """Return the sum of a machine's squared misses of a task, as a measure [SI^2]; `synthesise` minimises it.

    `optimise(machine, minimise=task_error(machine, task), vary=...)`. Timed points count at their strokes. An untimed one counts where the
    machine comes nearest to it in the whole stroke. `strokes` (n,) are those at which a machine comes to the points: an untimed point then
    counts by its distance from the path there, as studies of tolerances take it. `timed=True`: it counts at these strokes. `over` holds
    other strokes. Raises DefinitionError where several strokes move.

    Parameters
    ----------
    machine : Mechanism
        The design.
    task : PathTask, FunctionTask or PoseTask
        The task.
    strokes : array_like, optional
        The strokes at which the machine comes to the points.
    timed : bool, optional
        Whether points count at their strokes; by default where the task has strokes.
    over : mapping, optional
        The ranges of the strokes [m or rad].

    Returns
    -------
    Measure
        The sum [SI^2].

    Raises
    ------
    DefinitionError
        Several strokes move.
    """
    total: Measure = sum_of_parts(point_errors(machine, task, strokes, timed=timed, over=over))
    return total


def point_errors(
    machine: Mechanism, task: Task, strokes: object = None, *, timed: bool | None = None, over: Mapping[str, object] | None = None
) -> Squares:
    """Return a machine's squared misses at each point of a task, as measures [SI^2]; see `task_error`.

    `[each**0.5 <= 0.5 * mm for each in point_errors(...)]` are conditions: no point is missed by more.

    Parameters
    ----------
    machine : Mechanism
        The design.
    task : PathTask, FunctionTask or PoseTask
        The task.
    strokes : array_like, optional
        The strokes at which the machine comes to the points.
    timed : bool, optional
        Whether points count at their strokes; by default where the task has strokes.
    over : mapping, optional
        The ranges of the strokes [m or rad].

    Returns
    -------
    tuple of Measure
        The squares [SI^2].
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
    known = ", ".join(ranges)
    ensure(moving, f"{plan.title}: a task runs along one stroke, and over={{...}} holds all of them; leave one of {known} out.")
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


def sum_of_parts(parts: Sequence[object]) -> Any:
    """Return the sum of quantities or measures, of one at least."""
    return reduce(operator.add, parts)


def squared_sum(parts: Sequence[Any]) -> Any:
    """Return the sum of the squares of quantities."""
    return sum_of_parts([each * each for each in parts])


ACROSS = 1e-4
"""The cosine below which a miss counts as across the path, which the search for the nearest stroke has left."""
EXACT = 1e-9
"""A miss that is smaller [SI] has no direction."""


def squares_near(
    machine: Mechanism, rows: TaskRows, stroke: str, held: Mapping[str, float], strokes: FloatArray, *, slides: bool
) -> Squares:
    """Return the squared misses at strokes (n,). Where a point `slides`, the miss along its path there does not count.

    Of a miss v where the path goes along t, that leaves v^2 - (v t)^2 / t^2, the sum of the squares of their minors over t^2. It is the
    squared distance from the path, with its first derivatives, where v is across the path. A point whose v is not, as at the end of a
    stroke, does not slide.
    """
    speeds = [float(weight) * ratio(quantity, stroke) for quantity, weight in zip(rows.quantities, rows.weights, strict=True)]
    found = []
    for place, value in enumerate(strokes.tolist()):
        where = {**held, stroke: value}
        off = misses_at(machine, rows, place)
        is_across = False
        if slides:  # and moves there, with the miss across its path
            values = np.array([np.ravel(each)[0] for each in machine.evaluate([*off, *speeds], **where)])
            missed, speed = values[: len(off)], values[len(off) :]
            fast, far = float(np.linalg.norm(speed)), float(np.linalg.norm(missed))
            is_across = fast > 0.0 and (far < EXACT or abs(float(missed @ speed)) <= ACROSS * far * fast)
        if is_across:
            minors = [one * fast - other * slow for (one, slow), (other, fast) in combinations(zip(off, speeds, strict=True), 2)]
            found.append(at(squared_sum(minors) / squared_sum(speeds), **where))
        else:
            found.append(at(squared_sum(off), **where))
    return tuple(found)
