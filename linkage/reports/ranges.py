"""The stroke range of a motion of one design and one stroke, and a closer look over it."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np

from .. import motion as between
from ..errors import ensure
from ..motion import Motion, out_of_reach, require_motion
from ..program import FloatArray

Range: TypeAlias = tuple[float, float]


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
