"""Columns of results as curves over the stroke, one panel each, on one page."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import ceil, sqrt
from typing import Any

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from ..errors import DefinitionError, cited, unknown
from ..motion import Column, Motion, columns_of
from . import strokes, style
from .panel import panel
from .picture import Picture

PANEL = (4.6, 3.0)
"""The size of a panel with its share of the margins [inch]."""


def curves(motion: Motion, columns: Sequence[Column | str], *, limits: Mapping[str, Sequence[Any]] | None = None) -> Figure:
    """Return a figure of columns over the stroke, a panel each; a column that is the stroke itself is left out.

    A column may go by its name: a named output, or a point's coordinate such as "G_y".
    `limits` are, by the column's name, `(value [SI], text)` or `(value, text, "below")`: the line is drawn and the
    side that fails, above unless said, is shaded. Raises DefinitionError for a batch, a grid, or an unknown name.
    """
    moving, columns = strokes.driven(motion), named(motion, columns)
    if limits is not None and not isinstance(limits, Mapping):
        raise DefinitionError(f"limits={cited(limits)}: a limit for each column by its name is expected, dict(tilt=(0.1, 'max')).")
    given = dict(limits or {})
    wanted = [column for column in columns if column.name not in motion.strokes]
    for name in given:
        if name not in [column.name for column in columns]:
            raise unknown("Column", name, [column.name for column in columns], where="limits")
    if not wanted:
        raise DefinitionError(f"{motion.plan.title}: there is no column to draw over {moving}; name a result, not a stroke.")
    figure, cells = grid(len(wanted))
    held = strokes.held(motion.plan, motion.strokes, moving)
    title = motion.plan.heading + (f" at {held}" if held else "")
    figure.suptitle(title, fontsize=style.TITLE + 2, fontweight="bold", color=style.INK, x=0.012, ha="left")
    for ax, column in zip(cells, wanted, strict=True):
        panel(ax, motion, column, given.get(column.name))
    return figure


def named(motion: Motion, columns: Sequence[Column | str]) -> list[Column]:
    """Return columns, those that go by their names from the motion's own table; DefinitionError for an unknown name."""
    if not isinstance(columns, (list, tuple)) or not all(isinstance(each, (str, Column)) for each in columns):
        raise DefinitionError(f'{motion.plan.title}: {cited(columns)}: a list of columns or their names is expected, such as ["tilt"].')
    names = [each for each in columns if isinstance(each, str)]
    own = {column.name: column for column in columns_of(motion)} if names else {}
    for name in names:
        if name not in own:
            raise unknown("Column", name, own, where=motion.plan.title)
    return [own[each] if isinstance(each, str) else each for each in columns]


def grid(count: int) -> tuple[Figure, list[Any]]:
    """Return a figure and the axes of so many panels, as near to a square as they go."""
    across = min(ceil(sqrt(count)), 4)
    down = ceil(count / across)
    size = max(PANEL[0] * across, 6.0), PANEL[1] * down + 0.6
    figure = Picture(figsize=size, dpi=style.DPI, facecolor=style.PAPER, layout="constrained")
    FigureCanvasAgg(figure)
    figure.get_layout_engine().set(w_pad=0.12, h_pad=0.12)  # type: ignore[union-attr,call-arg]
    return figure, [figure.add_subplot(down, across, index + 1) for index in range(count)]
