"""A curve as plain data for the browser: values, range, ticks and limit."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.ticker import MaxNLocator

from ..draw import strokes
from ..draw.limits import limit
from ..draw.panel import span, typeset
from ..motion import Column, Motion
from ..program import FloatArray
from ..units import UNITS


def chart(motion: Motion, column: Column, bound: Sequence[Any] | None) -> dict[str, Any]:
    """Return a column over the stroke that a motion runs along; None where it has no value."""
    moving = strokes.driven(motion)
    along = strokes.shown(motion.plan, moving, motion.strokes[moving])
    turning = strokes.unit(motion.plan, moving) == "deg" and float(np.ptp(along)) >= 90.0
    low, high = span(column.drawn)
    edge: dict[str, Any] | None = None
    if bound is not None:
        found = limit(bound)
        value = found.value / (UNITS[column.unit][0] if column.unit else 1.0)
        low, high = min(low, value - 0.06 * (high - low)), max(high, value + 0.06 * (high - low))
        edge = {"value": value, "text": found.text, "above": found.fails == "above"}
    unit = strokes.unit(motion.plan, moving)
    return {
        "stroke": {"name": moving, "unit": unit, "values": rounded(along), "ticks": ticks(float(along[0]), float(along[-1]), turning)},
        "column": {"heading": typeset(column.heading), "unit": typeset(column.unit), "values": rounded(column.drawn)},
        "range": [low, high],
        "ticks": ticks(low, high),
        "limit": edge,
    }


def rounded(values: FloatArray) -> list[float | None]:
    """Return values to seven digits; None for one that is not finite."""
    return [float(f"{value:.7g}") if np.isfinite(value) else None for value in values.tolist()]


def ticks(low: float, high: float, turning: bool = False) -> list[float]:
    """Return round values between two ends."""
    low, high = min(low, high), max(low, high)
    found = MaxNLocator(6, steps=[1, 3, 4.5, 6, 9, 10] if turning else [1, 2, 2.5, 5, 10]).tick_values(low, high)
    return [float(f"{value:.10g}") for value in found if low <= value <= high]
