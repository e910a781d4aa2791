"""Stroke ranges of a motion of one design and one stroke: where something is below zero, in numbers and in words."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeAlias

import numpy as np

from .. import motion as between
from ..checks import is_listed, require
from ..errors import ensure
from ..language import said, with_and
from ..motion import Motion, Request, out_of_reach, require_motion
from ..program import FloatArray
from ..quantities import is_number
from ..units import show, shown_number

Range: TypeAlias = tuple[float, float]
Spare: TypeAlias = Callable[[Motion], FloatArray] | Request


def one_stroke(motion: Motion) -> str:
    """Return the only stroke of a motion; DefinitionError for anything but a motion, and where there are several."""
    require_motion(motion)
    ensure(len(motion.strokes) == 1, f"{motion.plan.title}: ranges are told along one stroke, here are {len(motion.strokes)}.")
    return next(iter(motion.strokes))


def reached_span(motion: Motion) -> Range:
    """Return the least and the largest stroke reached [SI] over the range of a motion, whatever its number of poses.

    Raises AssemblyError where none is.
    """
    name = one_stroke(motion)
    found = [(each.start[name], each.end[name]) for each in between.reached_spans(motion)]
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
    for span in spans if is_listed(spans) else [spans]:
        is_range = is_listed(span) and len(span) == 2 and all(map(is_number, span))
        require(is_range, "", span, "is no range; give a list of (start, end) [m or rad]")
    words = []
    for low, high in spans:
        if low < high:
            ends = said("{low} to {high}", low=shown_number(low, unit, ".4f"), high=show(high, unit, ".4f"))
            words.append(said("from {name} = {range}", name=stroke, range=ends))
        else:
            words.append(said("at {place}", place=f"{stroke} = {show(low, unit, '.4f')}"))
    return with_and(words)
