"""The course of an animation: which strokes, in which order, smoothly there and back."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ..draw import strokes
from ..errors import DefinitionError, cited, known_name
from ..mechanism import Mechanism
from ..motion import Column, Motion
from ..program import FloatArray
from ..report import NOTHING, At, Run, results, run_of

MANY = 1_000_000
"""Poses of an animation: more are no film."""

RATE = 25
"""Frames a second."""

CLOSED = 1e-6
"""Points that end so near to where they began, compared with the linkage, have gone round."""


@dataclass(frozen=True, eq=False)
class Course:
    """A motion along one stroke, the poses in reach in the order they are shown, the column to follow."""

    motion: Motion
    order: tuple[int, ...]
    column: Column
    is_turn: bool


def course(machine: Mechanism, count: int, column: str | None = None, *, at: At = NOTHING, eased: bool = True) -> Course:
    """Return the course over one stroke, the others held: `count` poses, there and back.

    `at` holds strokes at a value, or says between which two values the one that moves runs [m or rad]; without it the
    first stroke runs over its range and the others stand in their middle. A full turn that ends where it began goes
    round. Eased, the poses stand closer at the ends, so that even frames start and stop softly. Poses out of reach are
    left out; raises AssemblyError where none is in reach.
    """
    run = run_of(machine, at)
    turn = strokes.is_turn(machine, run)
    values = run.over(along(run, whole(count), eased and not turn))
    motion = machine.at(unreachable="nan", **values)
    if not motion.reached.any():
        machine.at(**values)
    turn = turn and closes(motion)
    there = [int(pose) for pose in np.flatnonzero(motion.reached)]
    return Course(motion, tuple(there if turn else there + there[-2:0:-1]), followed(machine, motion, column), turn)


def whole(count: Any) -> int:
    """Return a number of poses; DefinitionError unless it is a whole number of at least 2."""
    if isinstance(count, bool) or not isinstance(count, (int, np.integer)) or not 2 <= count <= MANY:
        raise DefinitionError(f"count={cited(count)}: an animation has at least 2 poses; give a whole number such as 60.")
    return int(count)


def along(run: Run, count: int, eased: bool) -> FloatArray:
    """Return the values of a stroke from end to end [m or rad]."""
    share = np.linspace(0.0, 1.0, count)
    share = 0.5 - 0.5 * np.cos(np.pi * share) if eased else share
    return np.asarray(run.start + (run.end - run.start) * share)


def closes(motion: Motion) -> bool:
    """Return whether a motion ends where it began; a group may take two turns."""
    places = np.array([motion[name] for name in motion.plan.points])
    return not np.abs(places[..., -1] - places[..., 0]).max() > CLOSED * np.nanmax(np.ptp(places, axis=0))


def changes(values: FloatArray) -> bool:
    """Return whether values differ by more than rounding."""
    finite = values[np.isfinite(values)]
    return finite.size > 0 and bool(np.ptp(finite) > CLOSED * np.abs(finite).max())


def followed(machine: Mechanism, motion: Motion, name: str | None) -> Column:
    """Return a column of results by name; without one, the last that is not a stroke and changes."""
    columns = {column.name: column for column in results(machine, motion) if column.name not in motion.strokes}
    if name is None and columns:
        moving = [each for each, column in columns.items() if changes(column.drawn)]
        return columns[(moving or list(columns))[-1]]
    return columns[known_name("Column", name, columns, where=machine.plan.title)]
