"""Stroke ranges of a motion of one design and one stroke: where something is below zero, in numbers and in words."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from types import MappingProxyType
from typing import Any, TypeAlias

import numpy as np

from .. import motion as between
from ..checks import require, require_type
from ..errors import DefinitionError, known_name
from ..language import said, with_and
from ..mechanism import Mechanism
from ..motion import Judge, Motion, Request, Run, out_of_reach, require_motion
from ..plan import require_kind
from ..program import FloatArray
from ..quantities import as_mapping, is_number, numbers_in
from ..units import show, shown_number

Range: TypeAlias = tuple[float, float]
Spare: TypeAlias = Callable[[Motion], FloatArray] | Request


def one_stroke(motion: Motion) -> str:
    """Return the only stroke of a motion; DefinitionError for anything but a motion, and where there are several."""
    require_motion(motion)
    if len(motion.strokes) != 1:
        raise DefinitionError(f"{motion.plan.title}: ranges are told along one stroke, here are {len(motion.strokes)}.")
    return next(iter(motion.strokes))


def reached_span(motion: Motion) -> Range:
    """Return the least and the largest stroke reached [SI] over the range of a motion, whatever its number of poses.

    Raises AssemblyError where none is.
    """
    name = one_stroke(motion)
    found = [(each.start[name], each.end[name]) for each in between.reached(motion)]
    if not found:
        raise out_of_reach(motion)
    return found[0][0], found[-1][1]


def closely(motion: Motion, values: FloatArray | None = None) -> Motion:
    """Return the same design at chosen strokes [SI], else at 513 poses over the reached range; NaN where out of reach."""
    name = one_stroke(motion)
    return motion.moved({name: np.linspace(*reached_span(motion), 513) if values is None else values})


def ranges_below_zero(motion: Motion, spare: Spare) -> list[Range]:
    """Return the stroke ranges [SI] where `spare` of a motion, shape (poses,), is below zero; their ends are roots."""
    name = one_stroke(motion)
    return [(each.start[name], each.end[name]) for each in between.below_zero(motion, spare)]


def spans_in_words(spans: Sequence[Range], stroke: str, unit: str = "m") -> str:
    """Return stroke ranges as text: `from S = 0.5500 to 0.5660 m and at S = 0.7000 m`."""
    for span in spans if isinstance(spans, (list, tuple)) else [spans]:
        is_range = isinstance(span, (list, tuple)) and len(span) == 2 and all(map(is_number, span))
        require(is_range, "", span, "is no range; give a list of (start, end) [m or rad]")
    words = []
    for low, high in spans:
        if low < high:
            ends = said("{low} to {high}", low=shown_number(low, unit, ".4f"), high=show(high, unit, ".4f"))
            words.append(said("from {name} = {range}", name=stroke, range=ends))
        else:
            words.append(said("at {place}", place=f"{stroke} = {show(low, unit, '.4f')}"))
    return with_and(words)


# What a picture of the whole runs over: one stroke from end to end or several together, the others held.

At: TypeAlias = Mapping[str, Any]
NOTHING: At = MappingProxyType({})


def run_along(motion: Motion) -> tuple[Run, int]:
    """Return what moves along a motion of one axis, through all its places, and the number from 0 of the first of them.

    Of a sweep along an `Over.path` these are the places of the path. Of one that is not reached everywhere it is the longest part that is.
    DefinitionError for a grid, a batch, fewer than two places.
    """
    title, shape = require_motion(motion).plan.title, motion.shape
    if motion.is_swept and motion.over.shape == "path":
        motion = Judge(motion.plan, motion.designs, [motion]).places[0].motion  # the places that its `Over` names
    if len(shape) != 1 or motion._design_shape:
        said = f"one design along one path is expected, and this motion is of shape {shape}"
        raise DefinitionError(f"{title}: {said}; choose one path of it.")
    ends = np.flatnonzero(np.diff(np.concatenate([[False], motion.reached, [False]])))
    first, last = max(zip(ends[::2].tolist(), ends[1::2].tolist(), strict=True), key=lambda part: part[1] - part[0], default=(0, 0))
    ways = {name: tuple(values[first:last].tolist()) for name, values in motion.strokes.items()}
    moving = {name: way for name, way in ways.items() if len(set(way)) > 1}
    if not moving:
        raise DefinitionError(f"{title}: nothing moves along this motion; it has {last - first} places in reach.")
    return Run(moving, {name: way[0] for name, way in ways.items() if name not in moving}), first


def run_of(machine: Mechanism, at: At | Motion = NOTHING) -> Run:
    """Return what moves: the strokes that `at` gives two values or more, else the first that it does not hold, over its range.

    Of a motion it is its own way, as `run_along` has it.

    Several strokes run together, in straight lines from value to value. Strokes that are not given are at mid-stroke.
    DefinitionError where nothing is left to move, or where strokes that run together do not pass as many values each.
    """
    one = first_stroke(machine)
    title = machine.plan.title
    if isinstance(at, Motion):
        return run_along(at)[0]
    require_type(f"{title}: at", at, Mapping, f"values of strokes by name are expected, such as at={as_mapping({one: 0.1})}")
    given = {name: stroke_way(machine, name, value) for name, value in at.items()}
    ways = {name: given[name] for name in machine.strokes if len(given.get(name, ())) > 1}
    free = [name for name in machine.strokes if name not in given]
    if len({len(way) for way in ways.values()}) > 1:
        said = " and ".join(f"{name} passes {len(way)} values" for name, way in ways.items())
        raise DefinitionError(f"{title}: {said}; strokes that run together pass as many values each.")
    if not (ways or free):
        raise DefinitionError(f"{title}: every stroke is held, so that nothing moves; give {one} two values, its run.")
    moving = ways or {free[0]: (machine.strokes[free[0]].start, machine.strokes[free[0]].end)}
    held = stroke_middles(machine) | {name: values[0] for name, values in given.items()}
    return Run(moving, {name: value for name, value in held.items() if name not in moving})


def stroke_way(machine: Mechanism, name: str, value: object) -> tuple[float, ...]:
    """Return what a stroke is given: one value, or those that it passes; DefinitionError for anything else."""
    title = machine.plan.title
    known_name("Stroke", name, machine.strokes, where=title)
    require_kind(machine.plan, name, value, f"{title}: at: {name}")
    values = tuple(np.ravel(numbers_in(value)).tolist())
    if not values or (len(values) > 1 and len(set(values)) == 1) or not np.all(np.isfinite(values)):
        said = "one number holds a stroke, two different ones are the ends of its run, more are passed one after the other"
        raise DefinitionError(f"{title}: {name}={value!r}: {said}.")
    return values


def reached_motion(machine: Mechanism, strokes: At) -> Motion:
    """Return a machine at strokes [m or rad], NaN where it cannot be assembled; AssemblyError where it cannot anywhere."""
    motion = machine.at(unreachable="nan", **strokes)
    if not motion.reached.any():
        raise out_of_reach(motion)
    return motion


def first_stroke(machine: Mechanism) -> str:
    """Return the first stroke; DefinitionError for a structure without one, and for anything but a mechanism."""
    if not isinstance(machine, Mechanism):
        raise DefinitionError(f"{machine!r:.60} is no mechanism; give a design such as Boom(), and its strokes by at=.")
    if not machine.strokes:
        raise DefinitionError(f"{machine.plan.title} has no stroke, so there is nothing to move; declare one, S = Stroke(0, 0.25).")
    return next(iter(machine.strokes))


def stroke_middles(machine: Mechanism) -> dict[str, float]:
    """Return the middle of every stroke [m or rad]."""
    return {name: 0.5 * (stroke.start + stroke.end) for name, stroke in machine.strokes.items()}
