"""Courses: a stroke over time as a piecewise polynomial, so that rates and accelerations are exact."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise
from math import comb, sqrt
from typing import Any, Self, TypeAlias

import numpy as np
import numpy.typing as npt

from ..errors import DefinitionError, article, cited, ensure, one_word, require, require_whole
from ..frozen import FrozenDict, frozen_copy, read_only, refuses_changes
from ..units import Amount, amounts_in, display_unit, require_measure, require_number, show
from ..vectors import FloatArray
from .curve import Curve, column, derived
from .quantity import is_number, numbers_in

KINDS = ("smooth", "straight", "monotone")
"""How a course goes through the rows of a table: a cubic spline; straight legs; cubic, and between two rows never beyond both."""
JUMP = 1e-9
"""Of the size of a course: what jumps by no more goes on, to rounding."""
NOISE = 16.0 * float(np.finfo(float).eps)
"""Of the size of its terms: a derivative that is no larger is zero, to rounding."""

FAST = 10.0
"""A speed [m/s or rad/s] above this of which no more than one part in so many is reached was meant in another unit."""

Phases: TypeAlias = tuple[FloatArray, FloatArray, float]
"""Instants (n + 1,) [s], the polynomials between them by powers of the time since each begins (k, n), and the last value."""


@refuses_changes
class Course:
    """A stroke over time: `Course([0.0, 2.0, 4.0], [0.10, 0.30, 0.10])` gives the value and its exact derivatives at every instant.

    Parameters
    ----------
    times : array_like
        Instants [s], shape (n,), rising.
    values : array_like
        The values there [m or rad], shape (n,).
    kind : str
        "smooth" is a cubic spline, "straight" are straight legs, "monotone" never goes beyond the rows that it is between (PCHIP).

    Raises
    ------
    DefinitionError
        The instants do not rise, there are fewer than two, or not as many values; an unknown kind.

    Notes
    -----
    `course(x)` is the value at x seconds, `course(x, 1)` its rate, `course(x, 2)` its acceleration. At a break, where two phases meet, it
    is that of the phase that begins there. Before it begins and after it ends a course stands still. `breaks` are the instants where it
    begins, goes on by another polynomial, and ends; `duration` is from the first to the last [s].
    """

    breaks: FloatArray
    steps: tuple[Mapping[str, Any], ...]
    """What it is made of, in order: a table, a ramp, a hold, or phases; as a file writes it."""
    measures: str
    """What its values measure, where amounts were given: "length" or "angle"; else ""."""
    _phases: FloatArray
    _last: float

    def __init__(self, times: npt.ArrayLike, values: npt.ArrayLike, kind: str = "smooth") -> None:
        one_word("kind", kind, KINDS)
        require_measure(times, "time", "Course: times")
        measures = common_measure("Course: values", values)
        found, rows = column("times", times, "Course"), column("values", values, "Course")
        check_rising("Course: time", found)
        require(len(rows) == len(found) > 1, "Course: values", values, f"one for each of {len(found)} instants is expected, two at least")
        self._hold([{"times": tuple(found.tolist()), "values": tuple(rows.tolist()), "kind": kind}], measures)

    @classmethod
    def of_phases(cls, times: npt.ArrayLike, phases: npt.ArrayLike, end: float | None = None, measures: str = "") -> Self:
        """Return the course of given polynomials.

        Parameters
        ----------
        times : array_like
            The instants at which they meet [s], shape (n + 1,), rising.
        phases : array_like
            Their coefficients by powers of the time since each begins, shape (k, n).
        end : float, optional
            The value at the end, where it is known better than by the last of them.
        measures : str
            "length" or "angle", where that is known.

        Returns
        -------
        Course
            The course.
        """
        found, rows = column("times", times, "Course"), np.atleast_2d(np.array(phases, float))
        check_rising("Course: time", found)
        fits = rows.shape[1:] == (len(found) - 1,) and bool(np.isfinite(rows).all())
        require(fits, "Course: phases", phases, f"rows of {len(found) - 1} finite numbers are expected, one row for each power")
        step = {"times": tuple(found.tolist()), "phases": tuple(map(tuple, rows.tolist()))}
        return cls.of_steps([step | ({} if end is None else {"end": float(end)})], measures)

    @classmethod
    def of_steps(cls, steps: Sequence[Mapping[str, Any]], measures: str = "") -> Self:
        """Return a course made of steps in their order; DefinitionError where the value jumps from one to the next.

        Parameters
        ----------
        steps : sequence of mapping
            The steps, as `Course` prints them.
        measures : str
            "length" or "angle", where that is known.

        Returns
        -------
        Course
            The course.

        Raises
        ------
        DefinitionError
            The value jumps from one step to the next.
        """
        found = cls.__new__(cls)
        found._hold(steps, measures)
        return found

    def _hold(self, steps: Sequence[Mapping[str, Any]], measures: str) -> None:
        breaks, phases, last = np.zeros(0), list[FloatArray](), 0.0
        for step in steps:
            times, rows, end = phases_of(step, last)
            if breaks.size:
                after = float(rows[0, 0])
                if abs(after - last) > JUMP * max(map(abs, (last, *rows[0], end))):
                    unit, off = ("rad", display_unit("angle")) if measures == "angle" else ("m", "mm")
                    apart = show(Amount(abs(after - last), measures), off, 4)
                    words = f"ends at {last:.3f} {unit}, goes on at {after:.3f} {unit}: {apart} apart"
                    raise DefinitionError(
                        f"Course.then: {words}; let the next course begin where this one ends, or put a ramp between them."
                    )
                times = times - times[0] + breaks[-1]
            breaks = np.concatenate([breaks, times[1:] if breaks.size else times])
            phases.append(rows)
            last = end
        powers = max(map(len, phases))
        whole = np.concatenate([np.pad(rows, ((0, powers - len(rows)), (0, 0))) for rows in phases], axis=1)
        kept = tuple(FrozenDict({key: frozen_copy(value) for key, value in step.items()}) for step in steps)
        self.__dict__.update(breaks=read_only(breaks), _phases=read_only(whole), _last=last, steps=kept, measures=measures)

    @property
    def duration(self) -> float:
        """How long it takes [s]."""
        return float(self.breaks[-1] - self.breaks[0])

    @property
    def starts_at_once(self) -> bool:
        """Whether it begins or ends at a steady rate, as a ramp without an acceleration does: its start or stop takes no time."""
        rate, bend = (self(self.breaks[[0, -1]], order, phase=0.5 * (self.breaks[[0, -2]] + self.breaks[[1, -1]])) for order in (1, 2))
        return bool(np.any((rate != 0.0) & (bend == 0.0)))

    @property
    def content_key(self) -> bytes:
        """A key in bytes: equal for courses with equal breaks and phases."""
        return bytes(self.breaks.tobytes() + self._phases.tobytes())

    def __call__(self, x: npt.ArrayLike, order: int = 0, *, phase: npt.ArrayLike | None = None) -> Any:
        """Return the value at instants, or a derivative by time.

        Parameters
        ----------
        x : array_like
            Instants [s], of any shape.
        order : int
            0 is the value [m or rad], 1 the rate, 2 the acceleration, and so on.
        phase : array_like, optional
            An instant within the phase that counts at each x, where that is a break.

        Returns
        -------
        array of float
            Shaped as x; a float for one instant.
        """
        require_measure(x, "time", "course(x)")
        time, order = numbers_in(x), require_whole("order", order, "a whole number is expected, 0 for the value", least=0)
        require(time.size > 0 or np.size(x) == 0, "course(x", x, "instants in seconds are expected")
        within = time if phase is None else np.asarray(phase, float)
        begin, end = self.breaks[[0, -1]]
        number = np.clip(np.searchsorted(self.breaks, within, side="right") - 1, 0, len(self.breaks) - 2)
        away = np.clip(time, begin, end) - self.breaks[number]
        total, size = np.zeros(np.shape(away)), np.zeros(np.shape(away))
        for row in derived(self._phases, order)[::-1, number]:
            total, size = total * away + row, size * np.abs(away) + np.abs(row)
        if order:
            total = np.where((within < begin) | (within > end) | (np.abs(total) <= NOISE * size), 0.0, total)
        else:
            total = np.where(time >= end, self._last, total)
        return float(total) if total.ndim == 0 else total

    def jumps(self, order: int, *, ends: bool = False) -> tuple[float, ...]:
        """Return the instants [s] at which a derivative of that order jumps: 1 for the rate, 2 for the acceleration.

        They lie between its ends. With `ends` these count too, where it begins from a stand and stands afterwards.

        Parameters
        ----------
        order : int
            1 or 2.
        ends : bool
            Whether the ends count.

        Returns
        -------
        tuple of float
            The instants [s].
        """
        middle, stand = 0.5 * (self.breaks[1:] + self.breaks[:-1]), np.zeros(1)
        before = np.concatenate([stand, self(self.breaks[1:], order, phase=middle)])
        after = np.concatenate([self(self.breaks[:-1], order, phase=middle), stand])
        begin, end = self.breaks[[0, -1]].tolist()
        known = np.concatenate([before, after, self(np.linspace(begin, end, 4 * len(self.breaks)), order)])
        jumping = np.abs(after - before) > JUMP * float(np.max(np.abs(known)))
        return tuple(self.breaks[jumping].tolist() if ends else self.breaks[1:-1][jumping[1:-1]].tolist())

    # -- courses made of courses -------------------------------------------------------------------------

    def hold(self, seconds: float) -> Course:
        """Return this, and then its last value for so many seconds.

        Parameters
        ----------
        seconds : float
            The duration [s].

        Returns
        -------
        Course
            The longer course.
        """
        require_number("hold", seconds, "a number of seconds above zero is expected", above=0.0, kind="time")
        return Course.of_steps([*self.steps, {"hold": float(seconds)}], self.measures)

    def then(self, course: Course) -> Course:
        """Return this, and behind its end another; DefinitionError where the value jumps there, or an angle follows a length.

        Parameters
        ----------
        course : Course
            The course that follows.

        Returns
        -------
        Course
            Both, one after the other.

        Raises
        ------
        DefinitionError
            The value jumps, or an angle follows a length.
        """
        require(isinstance(course, Course), "then", course, "a course is expected, such as then(ramp(0.3, 0.1, speed=0.1))")
        ends = Amount(self._last, self.measures), Amount(course._phases[0, 0], course.measures)
        measures = common_measure("Course.then: the next course", *ends)
        return Course.of_steps([*self.steps, *course.steps], measures)

    def part(self, begin: float, end: float) -> Course:
        """Return the course between two instants [s], at the same times; DefinitionError beyond its ends.

        Parameters
        ----------
        begin : float
            The first instant [s].
        end : float
            The last instant [s].

        Returns
        -------
        Course
            The course between them.

        Raises
        ------
        DefinitionError
            An instant beyond the course.
        """
        first, last = self.breaks[[0, -1]].tolist()
        fits = is_number(begin) and is_number(end) and first <= begin < end <= last
        require_measure((begin, end), "time", "part")
        require(fits, "part", (begin, end), f"two instants from {first:.6g} to {last:.6g} s are expected, the earlier one first")
        number = int(np.clip(np.searchsorted(self.breaks, begin, side="right") - 1, 0, len(self.breaks) - 2))
        stop = int(np.searchsorted(self.breaks, end, side="left"))
        times = np.concatenate([[begin], self.breaks[number + 1 : stop], [end]])
        rows, away = np.array(self._phases[:, number:stop]), float(begin - self.breaks[number])
        known = rows[:, 0].copy()
        rows[:, 0] = [sum(comb(j, k) * known[j] * away ** (j - k) for j in range(k, len(known))) for k in range(len(known))]
        return Course.of_phases(times, rows, self(end), self.measures)

    def __neg__(self) -> Course:
        return self._turned(-1.0, 0.0, self.measures)

    def __add__(self, number: float) -> Course:
        require(is_number(number), "Course: number", number, "a number is expected, which is added to all values")
        measures = common_measure("Course: number", Amount(self._last, self.measures), number)
        return self._turned(1.0, float(number), measures)

    def _turned(self, sense: float, number: float, measures: str) -> Course:
        """Return its values times a sense, 1.0 or -1.0, with a number added. Ramps and holds stay such."""
        steps, last = list[Mapping[str, Any]](), 0.0
        for step in self.steps:
            times, rows, last = phases_of(step, last)
            if "ramp" in step:
                steps.append({**step, "ramp": tuple(sense * each + number for each in step["ramp"])})
            elif "hold" in step:
                steps.append(step)
            else:
                found = np.concatenate([[sense * rows[0] + number], sense * rows[1:]])
                steps.append({"times": tuple(times.tolist()), "phases": tuple(map(tuple, found.tolist())), "end": sense * last + number})
        return Course.of_steps(steps, measures)

    __radd__ = __add__

    def __sub__(self, number: float) -> Course:
        require(is_number(number), "Course: number", number, "a number is expected, which is taken from all values")
        return self + -number

    def __rsub__(self, number: float) -> Course:
        return -self + number

    def __str__(self) -> str:
        text = ""
        for number, step in enumerate(self.steps):
            if "hold" in step:
                text += f".hold({step['hold']!r})"
                continue
            if "ramp" in step:
                own_text = f"ramp({', '.join([*map(repr, step['ramp']), *(f'{key}={step[key]!r}' for key in step if key != 'ramp')])})"
            elif "phases" in step:
                end = f", {step['end']!r}" if "end" in step else ""
                own_text = f"Course.of_phases({[*step['times']]!r}, {[*map(list, step['phases'])]!r}{end})"
            else:
                kind = "" if step["kind"] == KINDS[0] else f", kind={step['kind']!r}"
                own_text = f"Course({[*step['times']]!r}, {[*step['values']]!r}{kind})"
            text += f".then({own_text})" if number else own_text
        return text

    __repr__ = __str__


def ramp(a: float, b: float, *, speed: float, acceleration: float | None = None, jerk: float | None = None) -> Course:
    """Return the quickest way from one value to another within limits, from rest to rest.

    Parameters
    ----------
    a, b : float
        From where to where [m or rad].
    speed : float
        The greatest rate [1/s of these]. Alone it holds all the way, and the rate jumps at both ends.
    acceleration : float, optional
        The greatest acceleration [1/s2]: it speeds up, goes on and brakes; where the way is too short it never reaches the speed.
    jerk : float, optional
        How quickly the acceleration may change [1/s3]: seven phases, of which those fall away for which the way is too short.

    Returns
    -------
    Course
        It begins at 0 s.

    Raises
    ------
    DefinitionError
        A limit that is no number above zero, a jerk without an acceleration, two ends that are one, lengths among angles; a speed above
        10 m/s that is not nearly reached, as 150 for 150 mm/s.
    """
    for name, end in (("ramp(a", a), ("ramp(b", b)):
        require_number(name, end, "a finite number is expected", kind=None)
    limits: Mapping[str, float | None] = {"speed": speed, "acceleration": acceleration, "jerk": jerk}
    for name, value in limits.items():
        if value is not None or name == "speed":
            require_number(f"ramp({name}", value, "a finite number above zero is expected", above=0.0, kind=None)
    ensure(a != b, f"ramp({cited(a)}, {cited(b)}): nothing moves; give the stroke that number, or hold(...) behind a course.")
    require(jerk is None or acceleration is not None, "ramp(jerk", jerk, "it limits an acceleration; give acceleration= too")
    kinds = {each.measures: name for name, value in {"a": a, "b": b, **limits}.items() for each in amounts_in(value)}
    if len(kinds) > 1:
        both = " and ".join(f"{name} is {article(kind)} {kind}" for kind, name in kinds.items())
        raise DefinitionError(f"ramp({cited(a)}, {cited(b)}): {both}; give ends and limits as one kind, speed=150 * mm for 0.15 m/s.")
    measures = common_measure("ramp: ends and limits", a, b, *limits.values())
    given = {name: float(value) for name, value in limits.items() if value is not None}
    found = Course.of_steps([{"ramp": (float(a), float(b)), **given}], measures)
    reached = float(np.max(np.abs(found(found.breaks, 1))))
    if speed > FAST and reached < speed / FAST:
        what, unit = f"it is never reached, the acceleration allows {reached:.3g} on this way", "deg" if measures == "angle" else "mm"
        remedy = f"write speed={speed:.6g} * {unit} for {speed:.6g} {unit}/s, or a speed that is nearly reached"
        raise DefinitionError(f"ramp(speed={cited(speed)}): {what}; {remedy}.")
    return found


def course_of(given: Course | Curve | float, begin: float, end: float) -> Course:
    """Return a stroke over a path in time as a course: a number is constant, a periodic curve is repeated over the path."""
    if isinstance(given, Course):
        return given
    if not isinstance(given, Curve):
        return Course.of_phases([begin, end], [[float(given)]])
    first, period, rows = float(given.xs[0]), given.period, given.pieces
    turns = np.zeros(1) if period is None else np.arange(np.floor((begin - first) / period), np.ceil((end - first) / period))
    starts = np.concatenate([given.xs[:-1] + turn * (period or 0.0) for turn in turns])
    last = float(given.xs[-1] + turns[-1] * (period or 0.0))
    return Course.of_phases([*starts, last], np.tile(rows, len(turns)), float(given.ys[-1]))


def common_measure(what: str, *given: object) -> str:
    """Return the kind of some amounts, "length" or "angle"; "" for plain numbers. DefinitionError where the kinds differ."""
    known = [each for each in amounts_in([*given]) if each.measures]
    found = known[0].measures if known else ""
    require_measure(known, "angle" if found == "angle" else "length", what)
    return found


# Steps as polynomials.


def phases_of(step: Mapping[str, Any], last: float) -> Phases:
    """Return the phases of a step; `last` is the value at which it begins where it does not say that itself."""
    if "hold" in step:
        return np.array([0.0, step["hold"]]), np.array([[last]]), last
    if "ramp" in step:
        return ramp_phases(*step["ramp"], *(step.get(key) for key in ("speed", "acceleration", "jerk")))
    times = np.array(step["times"])
    if "phases" in step:
        rows = np.array(step["phases"])
        return times, rows, step.get("end", float(np.polynomial.polynomial.polyval(times[-1] - times[-2], rows[:, -1])))
    values = np.array(step["values"])
    if step["kind"] == "monotone" and len(times) > 2:
        from scipy.interpolate import PchipInterpolator

        rows = PchipInterpolator(times, values).c[::-1]
    elif step["kind"] == "smooth" and len(times) > 2:
        rows = Curve(times, values).pieces
    else:
        rows = np.array([values[:-1], np.diff(values) / np.diff(times)])
    return times, rows, float(values[-1])


def ramp_phases(a: float, b: float, speed: float, most: float | None, jerk: float | None) -> Phases:
    """Return the phases of a ramp within a speed, an acceleration and a jerk."""
    way, sense = abs(b - a), 1.0 if b > a else -1.0
    if most is None:
        return np.array([0.0, way / speed]), np.array([[a], [sense * speed]]), b
    if jerk is None:
        speed = min(speed, sqrt(way * most))
        lengths, jerks = [speed / most, way / speed - speed / most, speed / most], [0.0, 0.0, 0.0]
        begins = [sense * most, 0.0, -sense * most]
    else:
        rise = most / jerk
        quickest = 0.5 * most * (sqrt(rise * rise + 4.0 * way / most) - rise)
        if quickest < most * rise:  # the way is too short for the acceleration
            quickest = (0.25 * way * way * jerk) ** (1.0 / 3.0)
        speed = min(speed, quickest)
        rise = min(rise, sqrt(speed / jerk))
        level = speed / (jerk * rise) - rise
        onward = way / speed - 2.0 * rise - level
        lengths, jerks = [rise, level, rise, onward, rise, level, rise], [jerk, 0.0, -jerk, 0.0, -jerk, 0.0, jerk]
        begins = [0.0, jerk * rise, jerk * rise, 0.0, 0.0, -jerk * rise, -jerk * rise]
        jerks, begins = [sense * each for each in jerks], [sense * each for each in begins]
    kept = [k for k, length in enumerate(lengths) if length > 1e-12 * sum(lengths)]
    times, rows, value, rate = [0.0], list[list[float]](), a, 0.0
    for k in kept:
        length, bend, third = lengths[k], begins[k], jerks[k]
        rows.append([value, rate, bend / 2.0, third / 6.0])
        value += length * (rate + length * (bend / 2.0 + length * third / 6.0))
        rate += length * (bend + length * third / 2.0)
        times.append(times[-1] + length)
    return np.array(times), np.array(rows).T, b


def check_rising(what: str, times: FloatArray) -> None:
    """Raise DefinitionError for instants that do not rise, with the row."""
    for row, (before, after) in enumerate(pairwise(times.tolist()), start=2):
        if after <= before:
            raise DefinitionError(f"{what} must rise from row to row: in row {row} {after:.6g} s follows {before:.6g} s.")
