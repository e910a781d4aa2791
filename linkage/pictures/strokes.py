"""Strokes as a picture shows them: which one moves, in mm or degrees."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, final

import numpy as np

from ..errors import DefinitionError, cited, known_name
from ..mechanism import Mechanism
from ..motion import Column, Motion, check_any, last_holding, require_motion, stroke_display_unit
from ..plan import Plan
from ..program import FloatArray
from ..reports import NOTHING, At, Run, results, run_of
from ..units import factor


@final
@dataclass(frozen=True, eq=False)
class StrokeAxis:
    """The stroke that a motion runs along, as a picture shows it: its name, its unit, and its values in that unit, shape (n,).

    `held` are the values of the other strokes in words.
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
            raise DefinitionError(
                f"{plan.title}: curves over a stroke need one design and one row of poses, this motion has the shape {motion.shape}; "
                f"sweep one stroke and give every other a value: {', '.join(plan.strokes)}."
            )
        name = max(motion.strokes, key=lambda name: float(np.ptp(motion.strokes[name])))
        unit = stroke_display_unit(plan, name, "mm")
        return cls(name, unit, np.asarray(motion.strokes[name] / factor(unit)), others_in_words(motion, name))

    @property
    def is_turning(self) -> bool:
        """Whether it goes through so many degrees that these are told in thirds of a right angle."""
        return self.unit == "deg" and float(np.ptp(self.values)) >= 90.0


def stroke_words(plan: Plan, name: str, value: float, *, fixed: bool = False) -> str:
    """Return a stroke's value [SI] as text: `S = 550 mm`, `phi = 90°`; fixed, with whole units."""
    unit = stroke_display_unit(plan, name, "mm")
    text = f"{name} = {value / factor(unit):{'.0f' if fixed else '.4g'}}".replace("-", "\N{MINUS SIGN}")
    return text + ("°" if unit == "deg" else f" {unit}")


def others_in_words(motion: Motion, moving: str) -> str:
    """Return the values of the strokes beside the one that moves, as text; empty where there is one stroke."""
    others = {name: float(np.ravel(value)[0]) for name, value in motion.strokes.items() if name != moving}
    return ", ".join(stroke_words(motion.plan, name, value) for name, value in others.items())


def unreached_words(motion: Motion, moving: str) -> str:
    """Return which parts of a stroke a motion along it does not reach, in words; empty where it reaches all."""
    values, reached = motion.strokes[moving].ravel(), motion.reached.ravel()
    if reached.all() or not reached.any():
        return ""
    said = []
    for edge in np.flatnonzero(reached[1:] != reached[:-1]).tolist():
        inside, outside = (edge, edge + 1) if reached[edge] else (edge + 1, edge)
        last = _last_reached(motion, moving, values[inside], values[outside])
        said.append(f"{'beyond' if outside > inside else 'before'} {stroke_words(motion.plan, moving, last)}")
    return "not reached " + " and ".join(said)


def _last_reached(motion: Motion, moving: str, inside: float, outside: float) -> float:
    """Return the last value of a stroke in reach between one that is and one that is not [SI]."""
    others = {name: float(np.ravel(value)[0]) for name, value in motion.strokes.items()}
    return float(last_holding(lambda at: np.array(motion.moved(others | {moving: at}).reached), inside, outside)[0])


# What an animation plays: which poses of a stroke, in which order, smoothly there and back.

MANY = 1_000_000
"""Poses of an animation: more are no film."""

RATE = 25
"""Frames a second."""

CLOSED = 1e-6
"""Points that end so near to where they began, compared with the linkage, have gone round."""


@final
@dataclass(frozen=True, eq=False)
class Playback:
    """A motion along one stroke, the poses in reach in the order they are shown, the column to follow."""

    motion: Motion
    order: tuple[int, ...]
    column: Column
    is_turn: bool


def playback(machine: Mechanism, count: int, column: str | None = None, *, at: At = NOTHING, eased: bool = True) -> Playback:
    """Return what is played over one stroke, the others held: `count` poses, there and back.

    `at` holds strokes at a value, or says between which two values the one that moves runs [m or rad]; without it the
    first stroke runs over its range and the others stand in their middle. A full turn that ends where it began goes
    round. Eased, the poses stand closer at the ends, so that even frames start and stop softly. Poses out of reach are
    left out; raises AssemblyError where none is in reach.
    """
    run = run_of(machine, at)
    turn = is_turn(machine, run)
    values = run.over(eased_values(run, frame_count(count), eased and not turn))
    motion = machine.at(unreachable="nan", **values)
    if not motion.reached.any():
        machine.at(**values)
    turn = turn and ends_where_begun(motion)
    there = [int(pose) for pose in np.flatnonzero(motion.reached)]
    return Playback(motion, tuple(there if turn else there + there[-2:0:-1]), column_shown(machine, motion, column), turn)


def is_turn(machine: Mechanism, run: Run) -> bool:
    """Return whether a run goes full turns, so that a crank ends where it began."""
    turns = abs(run.end - run.start) / (2 * np.pi)
    return stroke_display_unit(machine.plan, run.stroke, "mm") == "deg" and round(turns) >= 1 and abs(turns - round(turns)) < 1e-9


def frame_count(count: Any) -> int:
    """Return a number of poses; DefinitionError unless it is a whole number of at least 2."""
    if isinstance(count, bool) or not isinstance(count, (int, np.integer)) or not 2 <= count <= MANY:
        raise DefinitionError(f"count={cited(count)}: an animation has at least 2 poses; give a whole number such as 60.")
    return int(count)


def eased_values(run: Run, count: int, eased: bool) -> FloatArray:
    """Return the values of a stroke from end to end [m or rad]."""
    share = np.linspace(0.0, 1.0, count)
    share = 0.5 - 0.5 * np.cos(np.pi * share) if eased else share
    return np.asarray(run.start + (run.end - run.start) * share)


def ends_where_begun(motion: Motion) -> bool:
    """Return whether a motion ends where it began; a group may take two turns."""
    places = np.array([motion[name] for name in motion.plan.points])
    return not np.abs(places[..., -1] - places[..., 0]).max() > CLOSED * np.nanmax(np.ptp(places, axis=0))


def is_changing(values: FloatArray) -> bool:
    """Return whether values differ by more than rounding."""
    finite = values[np.isfinite(values)]
    return finite.size > 0 and bool(np.ptp(finite) > CLOSED * np.abs(finite).max())


def column_shown(machine: Mechanism, motion: Motion, name: str | None) -> Column:
    """Return a column of results by name; without one, what the machine is about, else the last that is no stroke and changes."""
    columns = {column.name: column for column in results(machine, motion) if column.name not in motion.strokes}
    if name is None:
        name = machine.featured().column or None
    if name is None and columns:
        moving = [each for each, column in columns.items() if is_changing(column.drawn)]
        return columns[(moving or list(columns))[-1]]
    return columns[known_name("Column", name, columns, where=machine.plan.title)]
