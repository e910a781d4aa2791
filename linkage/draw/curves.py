"""Columns of results as curves over the stroke, one panel each, on one page."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import ceil, sqrt
from typing import Any

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from ..errors import DefinitionError, unknown
from ..motion import Column, Motion
from . import strokes, style
from .panel import panel

PANEL = (4.6, 3.0)
"""The size of a panel with its share of the margins [inch]."""


def curves(motion: Motion, columns: Sequence[Column], *, limits: Mapping[str, Sequence[Any]] | None = None) -> Figure:
    """Return a figure of columns over the stroke, a panel each; a column that is the stroke itself is left out.

    `limits` are, by the column's name, `(value [SI], text)` or `(value, text, "below")`: the line is drawn and the
    side that fails, above unless said, is shaded. Raises DefinitionError for a batch, a grid, or an unknown name.
    """
    moving = strokes.driven(motion)
    given = dict(limits or {})
    wanted = [column for column in columns if column.name not in motion.strokes]
    for name in given:
        if name not in [column.name for column in columns]:
            raise unknown("Column", name, [column.name for column in columns], where="limits")
    if not wanted:
        raise DefinitionError(f"{motion.plan.title}: there is no column to draw over {moving}.")
    figure, cells = grid(len(wanted))
    held = strokes.held(motion.plan, motion.strokes, moving)
    title = motion.plan.heading + (f" at {held}" if held else "")
    figure.suptitle(title, fontsize=style.TITLE + 2, fontweight="bold", color=style.INK, x=0.012, ha="left")
    for ax, column in zip(cells, wanted, strict=True):
        panel(ax, motion, column, given.get(column.name))
    return figure


def grid(count: int) -> tuple[Figure, list[Any]]:
    """Return a figure and the axes of so many panels, as near to a square as they go."""
    across = min(ceil(sqrt(count)), 4)
    down = ceil(count / across)
    size = max(PANEL[0] * across, 6.0), PANEL[1] * down + 0.6
    figure = Figure(figsize=size, dpi=style.DPI, facecolor=style.PAPER, layout="constrained")
    FigureCanvasAgg(figure)
    figure.get_layout_engine().set(w_pad=0.12, h_pad=0.12)  # type: ignore[union-attr,call-arg]
    return figure, [figure.add_subplot(down, across, index + 1) for index in range(count)]
