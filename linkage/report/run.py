"""What a picture of the whole runs over: one stroke from end to end, the others held."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, TypeAlias

import numpy as np

from ..errors import DefinitionError, cited, unknown
from ..mechanism import Mechanism
from ..quantities import real

At: TypeAlias = Mapping[str, Any]
NOTHING: At = MappingProxyType({})


@dataclass(frozen=True)
class Run:
    """The stroke that moves, its two ends, and the values of the others [m or rad]."""

    stroke: str
    start: float
    end: float
    held: Mapping[str, float]

    def over(self, values: Any) -> dict[str, Any]:
        """Return all strokes, the moving one at some values: what `at` takes."""
        return {**self.held, self.stroke: values}


def run_of(machine: Mechanism, at: At = NOTHING) -> Run:
    """Return what moves: the stroke that `at` gives two values, else the first that it does not hold, over its range.

    Strokes that are not given stand in their middle. DefinitionError where nothing is left to move.
    """
    one = first(machine)
    title = machine.plan.title
    if not isinstance(at, Mapping):
        raise DefinitionError(f"{title}: at={cited(at)}: values of strokes by name are expected, such as at=dict({one}=0.1).")
    given = {name: values_of(machine, name, value) for name, value in at.items()}
    runs = [name for name in machine.strokes if len(given.get(name, ())) == 2]
    free = [name for name in machine.strokes if name not in given]
    if len(runs) > 1:
        raise DefinitionError(f"{title}: {' and '.join(runs)} have two values each; one stroke runs, hold the others at one value.")
    if not (runs or free):
        raise DefinitionError(f"{title}: every stroke is held, so that nothing moves; give {one} two values, its run.")
    moving = (runs or free)[0]
    start, end = given.get(moving, (machine.strokes[moving].start, machine.strokes[moving].end))
    held = middle(machine) | {name: values[0] for name, values in given.items()}
    return Run(moving, start, end, {name: value for name, value in held.items() if name != moving})


def values_of(machine: Mechanism, name: str, value: Any) -> tuple[float, ...]:
    """Return what a stroke is given: one value, or the two ends of its run; DefinitionError for anything else."""
    title = machine.plan.title
    if name not in machine.strokes:
        raise unknown("Stroke", name, machine.strokes, where=title)
    try:
        values = tuple(np.ravel(real(value)).tolist())
    except ValueError:
        values = ()
    if len(values) not in (1, 2) or len(set(values)) < len(values) or not np.all(np.isfinite(values)):
        raise DefinitionError(f"{title}: {name}={value!r}: one number holds a stroke, two different ones are the ends of its run.")
    return values


def first(machine: Mechanism) -> str:
    """Return the first stroke; DefinitionError for a structure without one, and for what is no mechanism."""
    if not isinstance(machine, Mechanism):
        raise DefinitionError(f"{machine!r:.60} is no mechanism; give a design such as Boom(), and its strokes by at=.")
    if not machine.strokes:
        raise DefinitionError(f"{machine.plan.title} has no stroke, so there is nothing to move; declare one, S = Stroke(0, 0.25).")
    return next(iter(machine.strokes))


def middle(machine: Mechanism) -> dict[str, float]:
    """Return the middle of every stroke [m or rad]."""
    return {name: 0.5 * (stroke.start + stroke.end) for name, stroke in machine.strokes.items()}
