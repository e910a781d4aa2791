"""The paper of a picture: a sheet with room around it, its title, a legend of lines, and a remark on omissions."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from . import style
from .layout import joined_box
from .scene import Bounds
from .sheet import empty_figure, figure_of, renderer_of, sheet
from .style import Look

WIDTH = 9.0
LEAST, MOST = 3.0, 10.0
LEFT, RIGHT, BOTTOM, TOP = 0.75, 0.2, 0.6, 0.7
"""The figure's width, the range of its height, and the room around the sheet [inch]."""

EDGE = 0.03
"""What stays free at the paper's edges [inch]."""

LETTERS = (style.TEXT, 9.0, style.SMALL, 7.5, 6.5)
"""The sizes of a legend's letters, the usual one first."""
ROW = 0.215
"""The height of a further row of a legend [inch]."""


def empty_page(box: Bounds, rows: int = 1) -> tuple[Figure, Axes]:
    """Return a figure with a sheet that fits a box [m], with room above it for so many rows of a legend."""
    left, right, bottom, top = box
    wide = WIDTH - LEFT - RIGHT
    high = float(np.clip(wide * (top - bottom) / (right - left), LEAST - BOTTOM - TOP, MOST - BOTTOM - TOP))
    height = high + BOTTOM + TOP + ROW * (rows - 1)
    figure = empty_figure(WIDTH, height)
    ax = figure.add_axes((LEFT / WIDTH, BOTTOM / height, wide / WIDTH, high / height))
    sheet(ax, box)
    renderer, whole = renderer_of(figure), figure.get_figwidth()
    covered = [each for axis in (ax.xaxis, ax.yaxis) if (each := axis.get_tightbbox(renderer)) is not None]
    left = max(0.0, EDGE - min((each.x0 for each in covered), default=0.0) / figure.dpi)
    right = max(0.0, EDGE + max((each.x1 for each in covered), default=0.0) / figure.dpi - whole)
    if left + right > 0.0:  # the numbers at its axes would hang over its edges; the sheet keeps its size
        x, y, wide, high = ax.get_position(original=True).bounds
        figure.set_figwidth(whole + left + right)
        ax.set_position(((x * whole + left) / (whole + left + right), y, wide * whole / (whole + left + right), high))
    return figure, ax


def write_title(figure: Figure, text: str, beside: str = "") -> None:
    """Write the title, and a text at its right end."""
    top = 1.0 - 0.24 / float(figure.get_figheight())
    figure.text(LEFT / float(figure.get_figwidth()), top, text, fontsize=style.TITLE, fontweight="bold", color=style.INK, va="center")
    if beside:
        at_right(figure, top, beside, style.TEXT, style.MUTED)


def at_right(figure: Figure, level: float, text: str, size: float, colour: str) -> None:
    """Write a text that ends where a sheet does, at a share of the figure's height."""
    figure.text(1.0 - RIGHT / float(figure.get_figwidth()), level, text, fontsize=size, color=colour, va="center", ha="right")


def remark(figure: Figure, ax: Axes, text: str) -> None:
    """Write in a warning colour, above the sheet's right end, the omissions of the picture."""
    if text:
        at_right(figure, ax.get_position(original=True).y1 + 0.13 / float(figure.get_figheight()), text, style.TEXT, style.ACCENT)


def footnote(figure: Figure, text: str) -> None:
    """Write in small letters, below the sheet's right end, how to read the picture."""
    at_right(figure, 0.11 / float(figure.get_figheight()), text, style.SMALL, style.MUTED)


def look_keys(looks: Sequence[Look]) -> list[Line2D]:
    """Return a thick line for each look, for a legend."""
    return [Line2D([], [], color=look.colour(style.INK), linewidth=4.0, solid_capstyle="round") for look in looks]


def legend_row(ax: Axes, keys: Sequence[Any], texts: Sequence[str], columns: int = 6) -> None:
    """Write the legend of lines in a row above the sheet, in letters so small that it fits; further rows beyond so many columns."""
    figure = figure_of(ax)
    for size in LETTERS:
        legend = ax.legend(
            keys, texts, loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=columns, frameon=False,
            borderaxespad=0.0, borderpad=0.25, fontsize=size, labelcolor=style.INK,
            handlelength=1.6, columnspacing=1.8, handletextpad=0.6,
        )  # fmt: skip
        if legend.get_window_extent(renderer_of(figure)).x1 <= figure.bbox.width:
            break


# Sheets side by side.

ACROSS = 3
"""The sheets in one row."""
WIDE = {1: 8.6, 2: 12.0, 3: 15.0}
"""The width of a picture with so many sheets in a row [inch]."""
BETWEEN, ABOVE, HEAD, FOOT = 0.62, 0.62, 0.5, 0.55
"""Room between two sheets, above all, above each and below each [inch]."""
HEIGHTS, CURVE = (2.6, 6.2), 2.1
"""The range of a sheet's height, and the height of a curve above it [inch]."""
UNLIKE = 1.6
"""Machines whose sizes differ by more are drawn to scales of their own."""


def sheets_beside(boxes: Sequence[Bounds], *, has_curve: bool = False, head: float = HEAD) -> tuple[Figure, list[Axes], list[Axes]]:
    """Return a figure with a sheet for each box [m], in rows, and a curve above each where there are curves; `head` is above each [inch].

    All sheets show one box around all of these, to one scale, unless their sizes differ too much for that.
    """
    across = min(len(boxes), ACROSS)
    width = WIDE[across]
    wide = (width - LEFT - RIGHT - (across - 1) * BETWEEN) / across
    joined = joined_box(boxes)
    if box_side(joined) <= UNLIKE * min(map(box_side, boxes)):
        boxes = [joined] * len(boxes)
    shape = max((top - bottom) / (right - left) for left, right, bottom, top in boxes)
    high = float(np.clip(wide * shape, *HEIGHTS))
    above = CURVE + FOOT + 0.08 if has_curve else 0.0
    row = head + above + high + FOOT
    height = ABOVE + -(-len(boxes) // across) * row
    figure, sheets, curves = empty_figure(width, height), list[Axes](), list[Axes]()
    for place, box in enumerate(boxes):
        x, y = LEFT + (place % across) * (wide + BETWEEN), height - ABOVE - (place // across) * row - head
        if has_curve:
            curves.append(figure.add_axes((x / width, (y - CURVE) / height, wide / width, CURVE / height)))
        sheets.append(figure.add_axes((x / width, (y - above - high) / height, wide / width, high / height)))
        sheet(sheets[-1], box)
    return figure, sheets, curves


def box_side(box: Bounds) -> float:
    """Return a box's larger side."""
    return max(box[1] - box[0], box[3] - box[2])
