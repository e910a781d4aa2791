"""Stroke ranges of a motion of one design and one stroke: where something is below zero, in numbers and in words."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeAlias

import numpy as np

from ..motion import Motion
from ..program import FloatArray

Range: TypeAlias = tuple[float, float]
Spare: TypeAlias = Callable[[Motion], FloatArray]

CLOSE = 1e-12  # how exactly an end of a range is found, m or rad


def reached_span(motion: Motion) -> Range:
    """Return the least and the largest stroke reached [SI]."""
    (values,) = motion.strokes.values()
    reached = values[motion.reached]
    return float(reached.min()), float(reached.max())


def closely(motion: Motion, values: FloatArray | None = None) -> Motion:
    """Return the same design at chosen strokes [SI], else at 513 poses over the reached range; NaN where out of reach."""
    (name,) = motion.strokes
    return Motion(motion.plan, motion.designs, {name: np.linspace(*reached_span(motion), 513) if values is None else values}, "nan")


def below_zero(motion: Motion, spare: Spare) -> list[Range]:
    """Return the stroke ranges [SI] where `spare` of a motion, shape (poses,), is below zero; their ends are roots."""
    fine = closely(motion)
    (S,) = fine.strokes.values()
    value = spare(fine)
    below = np.concatenate([[False], value < 0.0, [False]])
    firsts, lasts = np.flatnonzero(below[1:] & ~below[:-1]).tolist(), (np.flatnonzero(below[:-1] & ~below[1:]) - 1).tolist()

    def end(inside: int, outside: int) -> float:
        if not 0 <= outside < len(S) or np.isnan(value[outside]):
            return float(S[inside])
        return _root(lambda at: spare(closely(motion, at)), float(S[inside]), float(S[outside]))

    return [(end(first, first - 1), end(last, last + 1)) for first, last in zip(firsts, lasts, strict=True)]


def _root(value: Callable[[FloatArray], FloatArray], inside: float, outside: float) -> float:
    """Return where a function leaves the negative, between a stroke where it is below zero and one where it is not."""
    while abs(outside - inside) > CLOSE:
        S = np.linspace(inside, outside, 33)
        first = int(np.argmax(~(value(S) < 0.0)))
        if first == 0:  # zero to rounding at `inside`
            return inside
        inside, outside = float(S[first - 1]), float(S[first])
    return outside


def spans_in_words(spans: Sequence[Range], stroke: str, unit: str = "m") -> str:
    """Return stroke ranges as text: `from S = 0.5500 to 0.5660 m and at S = 0.7000 m`."""
    return " and ".join(
        f"from {stroke} = {low:.4f} to {high:.4f} {unit}" if low < high else f"at {stroke} = {low:.4f} {unit}" for low, high in spans
    )
