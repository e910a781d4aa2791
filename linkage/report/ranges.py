"""Stroke ranges of a motion of one design and one stroke: where something is below zero, in numbers and in words."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeAlias

import numpy as np

from .. import motion as between
from ..motion import Motion
from ..program import FloatArray

Range: TypeAlias = tuple[float, float]
Spare: TypeAlias = Callable[[Motion], FloatArray]


def reached_span(motion: Motion) -> Range:
    """Return the least and the largest stroke reached [SI] over the range of a motion, whatever its number of poses.

    Raises AssemblyError where none is.
    """
    found = below_zero(motion, lambda each: -np.ones(each.shape))
    if not found:
        raise motion.refusal()
    return found[0][0], found[-1][1]


def closely(motion: Motion, values: FloatArray | None = None) -> Motion:
    """Return the same design at chosen strokes [SI], else at 513 poses over the reached range; NaN where out of reach."""
    (name,) = motion.strokes
    return Motion(motion.plan, motion.designs, {name: np.linspace(*reached_span(motion), 513) if values is None else values}, "nan")


def below_zero(motion: Motion, spare: Spare) -> list[Range]:
    """Return the stroke ranges [SI] where `spare` of a motion, shape (poses,), is below zero; their ends are roots."""
    (name,) = motion.strokes
    return [(each.start[name], each.end[name]) for each in between.below_zero(motion, spare)]


def spans_in_words(spans: Sequence[Range], stroke: str, unit: str = "m") -> str:
    """Return stroke ranges as text: `from S = 0.5500 to 0.5660 m and at S = 0.7000 m`."""
    return " and ".join(
        f"from {stroke} = {low:.4f} to {high:.4f} {unit}" if low < high else f"at {stroke} = {low:.4f} {unit}" for low, high in spans
    )
