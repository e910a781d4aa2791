"""A document's pictures as files of their own: SVG, the same bytes for the same picture."""

from __future__ import annotations

from io import BytesIO
from typing import Any

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.ticker import ScalarFormatter

from ..language import translated, with_decimals
from ..pictures.scene import Scene
from ..pictures.sheet import ticks_of_length
from ..units import factor, shown_in
from .content import Illustration

REPRODUCIBLE: Any = {"svg.hashsalt": "hydrolinkage", "svg.fonttype": "none", "font.family": ["DejaVu Sans"], "axes.titley": 1.0}
"""Identifiers that do not change from run to run; letters stay letters; no room is looked for below a heading."""
FONT = "'DejaVu Sans', Verdana, sans-serif"
"""Where the first font is missing, one with the same widths."""


WIDE = 6.6
"""The width of a picture across the page [inch]."""
ROOM = (0.72, 0.22, 0.5, 0.1)
"""The room beside the axes of a drawing [inch: left, right, bottom, top]."""
HIGHEST = 3.4
"""The height of a drawing's axes at the most [inch]."""


def height_of(scene: Scene, air: float = 0.0) -> float:
    """Return the height of a drawing across the page [inch]."""
    left, right, bottom, top = scene.box()
    pad = air * max(right - left, top - bottom)
    wide = WIDE - ROOM[0] - ROOM[1]
    return float(np.clip(wide * (top - bottom + pad) / (right - left + pad), 2.2, HIGHEST)) + ROOM[2] + ROOM[3]


def in_one_unit(ax: Axes) -> None:
    """Show the lengths along a drawing's axes in the unit of all lengths of the document, where that is one."""
    unit = shown_in("mm") if shown_in("m") != "m" else "m"
    for axis, name in ((ax.xaxis, "x"), (ax.yaxis, "y")):
        if unit != "m":
            axis.set_major_formatter(ticks_of_length(factor(unit)))
            axis.set_label_text(f"{name}, {translated(unit)}")


def picture_svg(picture: Illustration) -> str:
    """Return a picture as SVG."""
    with rc_context(REPRODUCIBLE):
        figure = Figure(figsize=picture.size, dpi=100)
        FigureCanvasAgg(figure)
        painted(figure, picture)
        stream = BytesIO()
        figure.savefig(stream, format="svg", metadata={"Date": None, "Creator": None})
    return stream.getvalue().decode().replace("'DejaVu Sans'", FONT)


def painted(figure: Figure, picture: Illustration) -> Axes:
    """Return the axes of a picture, painted on a figure of its size."""
    (wide, high), (left, right, bottom, top) = picture.size, picture.room
    ax = figure.add_axes((left / wide, bottom / high, 1.0 - (left + right) / wide, 1.0 - (bottom + top) / high))
    picture.paint(ax)
    if with_decimals("0.5") != "0.5":
        for words in ax.texts:
            words.set_text(with_decimals(words.get_text()))
        for axis in (ax.xaxis, ax.yaxis):
            if isinstance(own := axis.get_major_formatter(), ScalarFormatter):
                axis.set_major_formatter(SpokenTicks(useOffset=own.get_useOffset()))
    return ax


class SpokenTicks(ScalarFormatter):
    """Numbers along an axis with the decimal sign of the language that is spoken."""

    def __call__(self, x: float, pos: int | None = None) -> str:
        return with_decimals(super().__call__(x, pos))
