"""The sheet a mechanism is drawn on: equal scales, a light grid, lengths in m or mm; and the paper around it, with title and legend."""

from __future__ import annotations

import os
from collections.abc import Sequence
from io import BytesIO
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
from matplotlib import rcParams
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patheffects import withStroke
from matplotlib.text import Annotation, Text
from matplotlib.ticker import FuncFormatter, MaxNLocator, ScalarFormatter

from ..disk import check_place, replacing
from ..errors import DefinitionError
from ..language import translated
from ..program import FloatArray
from ..quantities import is_number
from ..units import factor, shown_in
from . import style
from .layout import joined_box
from .scene import Bounds
from .style import Look

Keywords: TypeAlias = dict[str, Any]
"""How something is drawn, as matplotlib's functions take it by name."""
MOST_TICKS, EACH_TICK = 11, 0.36
"""Ticks of an axis at the most, and the room of each along it [inch]."""


def sheet(ax: Axes, box: Bounds) -> None:
    """Set up axes for a mechanism within a box [m]; they show more of the plane where their shape is another."""
    left, right, bottom, top = fitted_to(ax, box)
    unit = shown_in("mm")
    if unit == "mm" and max(right - left, top - bottom) > 1.0:
        unit = "m"
    ax.set(xlim=(left, right), ylim=(bottom, top))
    ax.set_aspect("equal", adjustable="box")
    for axis, name in ((ax.xaxis, "x"), (ax.yaxis, "y")):
        axis.set_major_locator(RoundValues(factor(unit)))
        axis.set_major_formatter(ScalarFormatter(useOffset=False) if unit == "m" else ticks_of_length(factor(unit)))
        axis.set_label_text(f"{name}, {translated(unit)}", fontsize=style.TEXT, color=style.MUTED)
    quiet(ax)
    for side in ("top", "right"):
        ax.spines[side].set_visible(True)


def panels(size: tuple[float, float], across: int, down: int = 1, count: int | None = None, **room: object) -> tuple[Figure, list[Axes]]:
    """Return an empty figure of a size [inch] and its axes, row by row: as many as there is room for, or the first so many.

    `room` is matplotlib's for its constrained layout: w_pad, h_pad, rect.
    """
    figure = empty_figure(*size)
    figure.set_layout_engine("constrained", **room)
    axes = [figure.add_subplot(down, across, place + 1) for place in range(across * down if count is None else count)]
    for ax in axes:
        quiet(ax)
    return figure, axes


class RoundValues(MaxNLocator):
    """Ticks at round values of a unit that is so much of SI, no more of them than have room along their axis."""

    def __init__(self, unit: float) -> None:
        super().__init__(MOST_TICKS, steps=[1, 2, 5, 10])
        self.unit = unit

    def __call__(self) -> Any:
        """Return the ticks of the axis [SI]."""
        axis: Any = self.axis  # matplotlib declares other things here, too
        box = axis.axes.get_window_extent()
        long = (box.width if axis is axis.axes.xaxis else box.height) / axis.axes.figure.dpi
        self.set_params(nbins=int(np.clip(long / EACH_TICK, 2, MOST_TICKS)))
        return super().__call__()

    def tick_values(self, vmin: float, vmax: float) -> Any:
        """Return the ticks between two values [SI]."""
        return np.asarray(super().tick_values(vmin / self.unit, vmax / self.unit)) * self.unit


def ticks_of_length(unit: float) -> FuncFormatter:
    """Return the formatter of a length [m] in a unit of so much SI."""
    return FuncFormatter(lambda value, _: f"{value / unit:.6g}".replace("-", "\N{MINUS SIGN}"))


def fitted_to(ax: Axes, box: Bounds) -> Bounds:
    """Return a box [m] made wider or higher until it has the shape of the axes."""
    place, figure = ax.get_position(original=True), figure_of(ax)
    shape = place.width * figure.get_figwidth() / (place.height * figure.get_figheight())
    left, right, bottom, top = box
    wide, high = max(right - left, shape * (top - bottom)), max(top - bottom, (right - left) / shape)
    x, y = 0.5 * (left + right), 0.5 * (bottom + top)
    return x - 0.5 * wide, x + 0.5 * wide, y - 0.5 * high, y + 0.5 * high


def quiet(ax: Axes) -> None:
    """Give axes the house's light frame, grid and ticks."""
    ax.set_facecolor(style.PAPER)
    ax.grid(True, color=style.GRID, linewidth=style.THIN)
    ax.set_axisbelow(True)
    ax.tick_params(colors=style.MUTED, labelsize=style.SMALL, length=0, pad=5)
    for side, spine in ax.spines.items():
        spine.set_color(style.RULE)
        spine.set_linewidth(style.THIN)
        spine.set_visible(side in ("left", "bottom"))


def points_a_metre(ax: Axes) -> float:
    """Return the drawing's scale, printer's points a metre, once its limits and place stand."""
    ax.apply_aspect()
    ends = ax.transData.transform([(0.0, 0.0), (1.0, 0.0)])
    return float(np.hypot(*(ends[1] - ends[0]))) * 72.0 / figure_of(ax).dpi


def haloed(ax: Axes, text: str, at: FloatArray, size: float, colour: str, halo: float = 2.2, **look: Any) -> Text:
    """Write a text at a place [m], shape (2,), with a rim of paper around its letters."""
    x, y = np.asarray(at, float).tolist()
    rim = [withStroke(linewidth=halo, foreground=style.PAPER)]
    return ax.text(x, y, text, fontsize=size, color=colour, path_effects=rim, **look)


def haloed_beside(
    ax: Axes, text: str, at: FloatArray, offset: FloatArray, size: float, colour: str, halo: float = 2.5, **look: Any
) -> Annotation:
    """Write a text at an offset [points] from a place [m], shape (2,) each, with a rim of paper around its letters."""
    (x, y), (across, up) = np.asarray(at, float).tolist(), np.asarray(offset, float).tolist()
    look |= {"fontsize": size, "color": colour, "path_effects": [withStroke(linewidth=halo, foreground=style.PAPER)]}
    return ax.annotate(text, (x, y), (across, up), textcoords="offset points", va="center_baseline", annotation_clip=False, **look)


def figure_of(ax: Axes) -> Figure:
    """Return the figure that axes stand in, those of a subfigure too."""
    figure = ax.figure.figure
    assert figure is not None
    return figure


def renderer_of(figure: Figure) -> Any:
    """Return the renderer that measures texts in a figure."""
    canvas: Any = FigureCanvasAgg(figure)  # matplotlib declares no types for its methods
    return canvas.get_renderer()


# The paper of a picture: a sheet with room around it, its title, a legend of lines, and a remark on omissions.

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


def at_right(figure: Figure, level: float, text: str, size: float, colour: str) -> Text:
    """Write a text that ends where a sheet does, at a share of the figure's height."""
    return figure.text(1.0 - RIGHT / float(figure.get_figwidth()), level, text, fontsize=size, color=colour, va="center", ha="right")


def remark(figure: Figure, ax: Axes, text: str) -> None:
    """Write in a warning colour, above the sheet's right end, the omissions of the picture; above a legend that reaches so far."""
    if text:
        top, height, legend = ax.get_position(original=True).y1, float(figure.get_figheight()), ax.get_legend()
        written = at_right(figure, top + 0.13 / height, text, style.TEXT, style.ACCENT)
        if legend is not None and legend.get_window_extent(renderer_of(figure)).x1 > written.get_window_extent(renderer_of(figure)).x0:
            written.set_y(top + 0.3 / height)


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


# A figure that is saved as every file here is: whole, or what stood there is left as it was.

SCREEN = 72
"""Pixels an inch of a picture takes in a notebook."""
VECTORS = ("svg", "svgz", "pdf", "ps", "eps", "pgf")
"""The formats that have no pixels."""
MOST_PIXELS = 150_000_000
"""The pixels of a picture that is written or laid under a machine: 0.6 GB while it is drawn."""


def pixels_text(wide: int, high: int) -> str:
    """Return how large a picture of so many pixels is, in words."""
    return f"{wide} x {high} pixels take {4e-9 * wide * high:.2g} GB to draw"


class Picture(Figure):
    """A matplotlib figure whose `savefig` replaces a file whole; FileError, in words, where it cannot be written. Notebooks show it."""

    def _repr_png_(self) -> tuple[bytes, dict[str, int]]:
        """Return the picture for a notebook, and the size it is shown in [pixels]: twice as fine as shown."""
        drawn = BytesIO()
        self.savefig(drawn, format="png", dpi=2 * SCREEN)
        wide, high = (round(SCREEN * inches) for inches in self.get_size_inches())
        return drawn.getvalue(), {"width": wide, "height": high}

    def savefig(self, fname: Any, **options: Any) -> None:
        """Write the picture into a file, in the format that its name's ending says, or into a stream."""
        if not isinstance(fname, (str, os.PathLike)):
            super().savefig(fname, **options)
            return
        path = Path(fname)
        kind = options.pop("format", None) or path.suffix[1:] or str(rcParams["savefig.format"])
        path = path if path.suffix else path.with_name(f"{path.name}.{kind}")
        check_place(path)
        dpi = options.get("dpi")
        fine = dpi if is_number(dpi) else self.dpi
        wide, high = (round(min(inches * fine, 1e9)) for inches in self.get_size_inches())
        if kind.lower() not in VECTORS and not 0 < wide * high <= MOST_PIXELS:
            most = int(fine * (MOST_PIXELS / (wide * high)) ** 0.5) if wide * high > 0 else int(self.dpi)
            raise DefinitionError(f"{path}: {pixels_text(wide, high)}; save it with dpi={most} at most, or as .svg or .pdf.")
        drawn = BytesIO()
        super().savefig(drawn, format=kind, **options)
        with replacing(path) as stream:
            stream.write(drawn.getvalue())


def empty_figure(width: float, height: float) -> Picture:
    """Return a picture of a size [inch] with nothing on it."""
    figure = Picture(figsize=(width, height), dpi=style.DPI, facecolor=style.PAPER)
    FigureCanvasAgg(figure)
    return figure
