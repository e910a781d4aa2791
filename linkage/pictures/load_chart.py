"""A working field as dealers print it: heights down, radii across, in each cell the load and a letter for its limit."""

from __future__ import annotations

from textwrap import TextWrapper

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from ..study import WorkingField
from . import style
from .chart_text import ChartText
from .sheet import Keywords, panels

CELL = 0.62, 0.30
"""The size of a cell [inch]."""
LINE = 0.2
"""The height of a line of the legend [inch]."""
LEFT, TOP = 0.85, 0.95


def plot_field(field: WorkingField) -> Figure:
    """Return a working field as a chart: rows are heights, columns radii, the letter beside a load names its limit."""
    text = ChartText(field)
    across, down = text.across.tolist(), text.down.tolist()
    wide, tall = len(across) * CELL[0], len(down) * CELL[1]
    width = max(LEFT + wide + 0.2, 7.0)
    fold = TextWrapper(int((width - 0.3) * 13.5), subsequent_indent="    ", break_long_words=False, break_on_hyphens=False)
    lines = [part for line in text.legend() for part in fold.wrap(line)]
    height = TOP + tall + 0.25 + LINE * len(lines) + 0.15
    figure, (ax,) = panels((width, height), 1)
    figure.set_layout_engine("none")
    ax.set_position((0.0, 0.0, 1.0, 1.0))
    ax.set(xlim=(0.0, width), ylim=(height, 0.0))
    ax.axis("off")
    ax.text(0.12, 0.28, text.title, fontsize=style.TITLE, fontweight="bold", color=style.INK, va="center")
    radius, rise = text.axes
    ax.text(LEFT + 0.5 * wide, 0.56, radius, fontsize=style.SMALL, color=style.MUTED, ha="center", va="center")
    ax.text(LEFT - 0.1, 0.56, rise, fontsize=style.SMALL, color=style.MUTED, ha="right", va="center")
    colours = {name: style.mixed(style.BODIES[place % len(style.BODIES)], style.PAPER, 0.45) for place, name in enumerate(text.letters)}
    bold: Keywords = {"fontsize": style.SMALL, "fontweight": "bold", "color": style.INK, "va": "center"}
    for column, n in enumerate(across):
        ax.text(LEFT + (column + 0.5) * CELL[0], TOP - 0.14, text.length_text(float(field.x[n])), ha="center", **bold)
    for row, k in enumerate(down):
        level = TOP + (row + 0.5) * CELL[1]
        ax.text(LEFT - 0.1, level, text.length_text(float(field.y[k])), ha="right", **bold)
        for column, n in enumerate(across):
            load, limiter, left = float(field.load[k, n]), str(field.limiter[k, n]), LEFT + column * CELL[0]
            look: Keywords = {"facecolor": style.GRID if np.isnan(load) else colours.get(limiter, style.PAPER), "edgecolor": style.PAPER}
            ax.add_patch(Rectangle((left, TOP + row * CELL[1]), *CELL, linewidth=1.2, zorder=2.0, **look))
            letter, y = text.letters.get(limiter, ""), TOP + row * CELL[1] + 0.5 * CELL[1]
            ink: Keywords = {"color": style.INK, "va": "center", "zorder": 6.0}
            ax.text(left + (0.40 if letter else 0.5) * CELL[0], y, text.load_text(load), fontsize=style.SMALL, ha="center", **ink)
            ax.text(left + 0.93 * CELL[0], y - 0.02, letter, fontsize=style.SMALL - 1.5, ha="right", **ink)
    for row, line in enumerate(lines):
        ax.text(0.12, TOP + tall + 0.3 + LINE * row, line, fontsize=style.SMALL, color=style.INK, va="center")
    return figure
