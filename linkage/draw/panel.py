"""One curve over a stroke: its line, its limit with the failing side shaded, its axes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import MaxNLocator

from ..motion import Column, Motion
from ..program import FloatArray
from ..units import UNITS
from . import strokes, style
from .limits import Limit, crossings, limit
from .sheet import quiet


def panel(ax: Axes, motion: Motion, column: Column, bound: Sequence[Any] | None = None, colour: str = style.CURVE) -> None:
    """Draw a column over the stroke that a motion runs along, with its limit `(value [SI], text, fails)`."""
    stroke = strokes.driven(motion)
    along = strokes.shown(motion.plan, stroke, motion.strokes[stroke])
    ax.plot(along, column.drawn, color=colour, linewidth=style.BOLD, zorder=5.0, marker="o" if len(along) == 1 else None)
    axes(ax, motion, column, along)
    if bound is not None:
        bar(ax, along, column, limit(bound), strokes.unit(motion.plan, stroke))


def axes(ax: Axes, motion: Motion, column: Column, along: FloatArray) -> None:
    """Name the axes and choose their range."""
    stroke = strokes.driven(motion)
    quiet(ax)
    ax.set_title(typeset(column.heading), loc="left", fontsize=style.TITLE, fontweight="bold", color=style.INK, pad=9)
    ax.set_xlabel(f"{stroke}, {strokes.unit(motion.plan, stroke)}", fontsize=style.TEXT, color=style.MUTED)
    if np.ptp(along) > 0.0:
        ax.set_xlim(float(along.min()), float(along.max()))
    turning = strokes.unit(motion.plan, stroke) == "deg" and np.ptp(along) >= 90.0
    ax.xaxis.set_major_locator(MaxNLocator(6, steps=[1, 3, 4.5, 6, 9, 10] if turning else [1, 2, 2.5, 5, 10]))
    ax.yaxis.set_major_locator(MaxNLocator(6, steps=[1, 2, 2.5, 5, 10]))
    ax.set_ylim(*span(column.drawn))


def span(values: FloatArray) -> tuple[float, float]:
    """Return the range of an axis for some values, with air at both ends."""
    finite = values[np.isfinite(values)]
    low, high = (float(finite.min()), float(finite.max())) if finite.size else (0.0, 1.0)
    air = 0.09 * (high - low)
    if air <= 1e-9 * max(abs(low), abs(high)):
        air = 0.1 * max(abs(low), abs(high)) or 1.0
    return low - air, high + air


def bar(ax: Axes, along: FloatArray, column: Column, bound: Limit, unit: str) -> None:
    """Draw a limit, shade the side that fails, and mark where the curve crosses it."""
    value = bound.value / (UNITS[column.unit][0] if column.unit else 1.0)
    low, high = ax.get_ylim()
    low, high = min(low, value - 0.06 * (high - low)), max(high, value + 0.06 * (high - low))
    bottom, top = (value, high) if bound.fails == "above" else (low, value)
    ax.set_ylim(low, high)
    ax.axhspan(bottom, top, color=style.ACCENT, alpha=0.10, linewidth=0, zorder=1.0)
    ax.axhline(value, color=style.ACCENT, linewidth=1.3, linestyle=(0, (5, 2.5)), zorder=4.0)
    short = np.where(bound.failing(column.values), column.drawn, np.nan)
    ax.plot(along, short, color=style.ACCENT, linewidth=style.BOLD + 0.6, zorder=5.1)
    for place in crossings(along, column.drawn, value):
        ax.plot([place], [value], marker="o", markersize=6, color=style.ACCENT, markeredgecolor=style.PAPER, zorder=6.0)
        _note(ax, f"{place:.4g} {unit}", place, value, along, bound)
    _name(ax, bound, value, along, column.drawn)


def _note(ax: Axes, text: str, place: float, value: float, along: FloatArray, bound: Limit) -> None:
    """Write the stroke at a crossing, on the failing side of the line."""
    right = place < 0.5 * (along.min() + along.max())
    down = bound.fails == "below"
    ax.annotate(
        text, (place, value), xytext=(7 if right else -7, -4 if down else 4), textcoords="offset points", ha="left" if right else "right",
        va="top" if down else "bottom", fontsize=style.SMALL, color=style.ACCENT, zorder=6.0,
    )  # fmt: skip


def _name(ax: Axes, bound: Limit, value: float, along: FloatArray, shown: FloatArray) -> None:
    """Write what the limit is, at the end of the line that is further from the curve."""
    gaps = np.abs(np.nan_to_num(shown, nan=value) - value)
    right, up = gaps[np.argmax(along)] >= gaps[np.argmin(along)], bound.fails == "above"
    ax.annotate(
        bound.text, (1.0 if right else 0.0, value), xycoords=("axes fraction", "data"), xytext=(-5 if right else 5, 3 if up else -3),
        textcoords="offset points", ha="right" if right else "left", va="bottom" if up else "top",
        fontsize=style.SMALL, color=style.ACCENT, zorder=6.0,
    )  # fmt: skip


def typeset(text: str) -> str:
    """Return a heading with its squares and cubes raised: kgf/cm² for kgf/cm2."""
    for plain, raised in (("cm2", "cm²"), ("m2", "m²"), ("cm3", "cm³"), ("m3", "m³"), ("kgf_cm", "kgf/cm")):
        text = text.replace(plain, raised)
    return text
