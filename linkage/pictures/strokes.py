"""Strokes as a picture shows them: which one moves, in mm or degrees."""

from __future__ import annotations

from collections.abc import Iterable
from math import ceil

import numpy as np

from ..errors import DefinitionError, require_whole
from ..frozen import immutable
from ..language import said, translated
from ..loads import PLAIN_CASE
from ..mechanism import Mechanism
from ..motion import Column, Motion, check_any, last_holding, require_motion, stroke_display_unit
from ..plan import Plan
from ..program import FloatArray
from ..reports import NOTHING, At, Run, column_among, in_case_words, motion_over, reached_motion, results, run_of
from ..units import factor, show, shown_in


@immutable
class StrokeAxis:
    """The stroke that a motion runs along, as a picture shows it: its name, its unit, and its values in that unit, shape (n,).

    Over a path in time it is the time [s].
    `held` are the other strokes in words, at their values or, where several run together, from one to another. Where each of these
    turns back, the axis is the share of the `way`.
    """

    name: str
    unit: str
    values: FloatArray
    held: str

    @classmethod
    def of(cls, motion: Motion) -> StrokeAxis:
        """Return the axis of a motion's curves; DefinitionError for a grid of strokes or a batch of designs."""
        require_motion(motion)
        check_any(motion.strokes, motion.plan)
        plan = motion.plan
        if motion._design_shape or len(motion._stroke_shape) != 1:
            needed = f"{plan.title}: curves over a stroke need one design and one row of poses, this motion has the shape {motion.shape}"
            raise DefinitionError(f"{needed}; sweep one stroke and give every other a value: {', '.join(plan.strokes)}.")
        if motion.time is not None:
            return cls(said("time"), "s", motion.time, others_in_words(motion, ""))
        moving = {name: values for name, values in motion.strokes.items() if np.ptp(values) > 0.0}
        travels = {name: abs(stroke.end - stroke.start) or 1.0 for name, stroke in plan.strokes.items()}
        shares = {name: float(np.ptp(values)) / travels[name] for name, values in moving.items()}
        onward = [name for name, values in moving.items() if (np.diff(values) > 0.0).all() or (np.diff(values) < 0.0).all()]
        if len(moving) > 1 and not onward:
            steps = np.array([np.abs(np.diff(values)) * (shares[name] / np.ptp(values)) for name, values in moving.items()]).max(axis=0)
            return cls(said("way"), "%", 100.0 * np.append(0.0, np.cumsum(steps) / steps.sum()), others_in_words(motion, ""))
        name = max(onward or moving or plan.strokes, key=lambda name: shares.get(name, 0.0))
        unit = shown_in(stroke_display_unit(plan, name, "mm"))
        return cls(name, unit, np.asarray(motion.strokes[name] / factor(unit)), others_in_words(motion, name))

    @property
    def heading(self) -> str:
        """Its name with its unit, in the language that is spoken: `S, mm`."""
        return f"{self.name}, {translated(self.unit)}" if self.unit else self.name

    @property
    def is_turning(self) -> bool:
        """Whether it goes through so many degrees that its axis has ticks at thirds of a right angle."""
        return self.unit == "deg" and float(np.ptp(self.values)) >= 90.0


def stroke_words(plan: Plan, name: str, value: float, *, fixed: bool = False) -> str:
    """Return a stroke's value [SI] as text: `S = 550 mm`, `phi = 90°`; fixed, with whole units."""
    unit = shown_in(stroke_display_unit(plan, name, "mm"))
    shown = round(value / factor(unit), 9)  # 0 where a turn of the drawing ends near 0
    text = f"{name} = {shown:{('z.0f' if unit else 'z.2f') if fixed else '.4g'}}".replace("-", "\N{MINUS SIGN}")
    return text + ("°" if unit == "deg" else f" {translated(unit)}" if unit else "")


def pose_words(motion: Motion, pose: int, names: Iterable[str] | None = None) -> str:
    """Return the strokes of a motion at a pose, a flat index, as text, over time with the instant; some of them where they are named."""
    shown = motion.strokes if names is None else names
    values = {name: float(np.broadcast_to(motion.strokes[name], motion._stroke_shape).ravel()[pose]) for name in shown}
    time = [] if motion.time is None or names is not None else [f"{said('time')} = {show(float(np.ravel(motion.time)[pose]), 's', 4)}"]
    return ", ".join([*time, *(stroke_words(motion.plan, name, value) for name, value in values.items())])


def others_in_words(motion: Motion, moving: str) -> str:
    """Return the strokes beside the one that moves, as text; those that move too from where to where and where they turn back."""
    found = []
    for name in [each for each in motion.strokes if each != moving]:
        values = np.ravel(motion.strokes[name])
        steps = np.flatnonzero(np.diff(values))
        ways = np.sign(np.diff(values)[steps])
        stops = [0, *(steps[:-1][ways[1:] != ways[:-1]] + 1).tolist(), *([len(values) - 1] if steps.size else [])]
        text, *others = (stroke_words(motion.plan, name, float(values[index])) for index in stops)
        for other in others:
            text = said("{low} to {high}", low=text, high=other.removeprefix(f"{name} = "))
        found.append(text)
    return ", ".join(found)


def unreached_words(motion: Motion, moving: str) -> str:
    """Return which parts of a stroke a motion along it does not reach, in words; empty where it reaches all."""
    reached = motion.reached.ravel()
    if reached.all() or not reached.any():
        return ""
    if moving not in motion.strokes:
        return said("not reached over {share} % of the way", share=f"{100.0 * (1.0 - reached.mean()):.2g}")
    found = []
    for edge in np.flatnonzero(reached[1:] != reached[:-1]).tolist():
        inside, outside = (edge, edge + 1) if reached[edge] else (edge + 1, edge)
        place = stroke_words(motion.plan, moving, _last_reached(motion, moving, inside, outside))
        beyond = outside > inside
        found.append(said("not reached beyond {place}", place=place) if beyond else said("not reached before {place}", place=place))
    return ", ".join(found)


def _last_reached(motion: Motion, moving: str, inside: int, outside: int) -> float:
    """Return the last value of a stroke in reach between a pose that is and one that is not [SI], on the straight way between them."""
    ends = {name: np.broadcast_to(np.ravel(values), motion.reached.size)[[inside, outside]] for name, values in motion.strokes.items()}

    def over(share: FloatArray) -> dict[str, FloatArray]:
        return {name: first + (last - first) * share for name, (first, last) in ends.items()}

    share, _ = last_holding(lambda at: np.array(motion.moved(over(at)).reached), 0.0, 1.0)
    return float(over(np.asarray(share))[moving])


# What an animation plays: which poses of a stroke, in which order, smoothly there and back.

MANY = 1_000_000
"""Poses of an animation: more are no film."""

RATE = 25
"""Frames a second."""

FRAMES = 300
"""Frames of a path in time, at the most: a longer one has fewer a second."""

CLOSED = 1e-6
"""Points that end so near to where they began, compared with the linkage, have gone round."""


@immutable
class Playback:
    """A motion along one stroke, the poses in reach in the order they are shown, the column to follow.

    Each is shown for `seconds`; over a path in time they are real. `case` is the load case in words.
    """

    motion: Motion
    order: tuple[int, ...]
    column: Column
    is_turn: bool
    seconds: float = 1.0 / RATE
    case: str = ""


def playback(machine: Mechanism, count: int, column: str | None = None, *, at: At | Motion = NOTHING, eased: bool = True) -> Playback:
    """Return the playback over one stroke or several together, the others held: `count` poses, there and back.

    `at` holds strokes at a value, or says which values those that move pass [m or rad]; without it that is `run_of`. A full
    turn that ends where it began goes round, and so does a path that ends where it began. Over a path in time `count` does not count: it
    is played once, in its own time, 25 poses a second or as many as are 300 in all. Eased, the poses stand closer at the
    ends, so that even frames start and stop softly. Poses out of reach are left out; raises AssemblyError where none is in reach.
    """
    run, count, seconds = run_of(machine, at), frame_count(count), 1.0 / RATE
    if run.instants is not None:
        lasting = float(np.ptp(run.instants.breaks))
        seconds = max(seconds, 0.01 * ceil(100.0 * lasting / FRAMES))  # what a .gif can show is hundredths
        count = max(round(lasting / seconds), 1) + 1
    turn = is_turn(machine, run)
    shares = np.linspace(0.0, 1.0, count)
    shares = 0.5 - 0.5 * np.cos(np.pi * shares) if eased and not turn and run.instants is None else shares
    motion = reached_motion(machine, motion_over(machine, run, shares))
    turn = ((turn or run.is_path) and bool(motion.reached.all()) and ends_where_begun(motion)) or run.instants is not None
    there = [int(pose) for pose in np.flatnonzero(motion.reached)]
    shown = column_among(machine, results(machine, motion, run.case or PLAIN_CASE), column)
    case = in_case_words(machine.plan, run.case)
    return Playback(motion, tuple(there if turn else there + there[-2:0:-1]), shown, turn, seconds, case)


def is_turn(machine: Mechanism, run: Run) -> bool:
    """Return whether a run goes full turns, so that a crank ends where it began."""
    way = run.ways[run.stroke]
    turns = abs(way[-1] - way[0]) / (2 * np.pi)
    straight = len(run.ways) == 1 and len(way) == 2
    is_angle = stroke_display_unit(machine.plan, run.stroke, "mm") == "deg"
    return straight and is_angle and round(turns) >= 1 and abs(turns - round(turns)) < 1e-9


def frame_count(count: object) -> int:
    """Return a number of poses; DefinitionError unless it is a whole number of at least 2."""
    return require_whole("count", count, "an animation has at least 2 poses; give a whole number such as 60", least=2, most=MANY)


def ends_where_begun(motion: Motion) -> bool:
    """Return whether a motion ends where it began; a group may take two turns."""
    places = np.array([motion[name] for name in motion.plan.points])
    return not np.abs(places[..., -1] - places[..., 0]).max() > CLOSED * np.nanmax(np.ptp(places, axis=0))
