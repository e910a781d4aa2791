"""The course of an animation: which strokes, in which order, smoothly there and back."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ..draw import strokes
from ..errors import DefinitionError, unknown
from ..mechanism import Mechanism
from ..motion import Column, Motion
from ..program import FloatArray

RATE = 25
"""Frames a second."""


@dataclass(frozen=True, eq=False)
class Course:
    """A motion along the first stroke, the poses in reach in the order they are shown, the column to follow."""

    motion: Motion
    order: tuple[int, ...]
    column: Column
    is_turn: bool


def course(machine: Mechanism, count: int, column: str | None = None, *, eased: bool = True) -> Course:
    """Return the course over the first stroke, the others in their middle: `count` poses, there and back.

    A full turn goes round instead. Eased, the poses stand closer at the ends, so that even frames start and stop
    softly. Poses out of reach are left out; raises AssemblyError where none is in reach.
    """
    if isinstance(count, bool) or not isinstance(count, (int, np.integer)) or count < 2:
        raise DefinitionError(f"count={count!r}: an animation has at least 2 poses; give a whole number such as 60.")
    moving = strokes.first(machine)
    turn = strokes.is_turn(machine, moving)
    held: dict[str, Any] = strokes.middle(machine) | {moving: along(machine, moving, int(count), eased and not turn)}
    motion = machine.at(unreachable="nan", **held)
    if not motion.reached.any():
        machine.at(**held)
    there = [int(pose) for pose in np.flatnonzero(motion.reached)]
    return Course(motion, tuple(there if turn else there + there[-2:0:-1]), followed(machine, motion, column), turn)


def along(machine: Mechanism, moving: str, count: int, eased: bool) -> FloatArray:
    """Return the values of a stroke from end to end [m or rad]."""
    stroke, share = machine.strokes[moving], np.linspace(0.0, 1.0, count)
    share = 0.5 - 0.5 * np.cos(np.pi * share) if eased else share
    return np.asarray(stroke.start + (stroke.end - stroke.start) * share)


def followed(machine: Mechanism, motion: Motion, name: str | None) -> Column:
    """Return a column of results by name; without one, the last that is not a stroke."""
    columns = {column.name: column for column in machine.columns(motion) if column.name not in motion.strokes}
    if name is None and columns:
        return columns[next(reversed(columns))]
    if name not in columns:
        raise unknown("Column", str(name), columns, where=machine.plan.title)
    return columns[name]
