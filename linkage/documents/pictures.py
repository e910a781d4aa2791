"""A document's pictures as files of their own: SVG, the same bytes for the same picture."""

from __future__ import annotations

from io import BytesIO
from typing import Any

from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from .content import Illustration

REPRODUCIBLE: Any = {"svg.hashsalt": "hydrolinkage", "svg.fonttype": "none", "font.family": ["DejaVu Sans"]}
"""Identifiers that do not change from run to run; letters stay letters."""
FONT = "'DejaVu Sans', Verdana, sans-serif"
"""Where the first font is missing, one with the same widths."""


def picture_svg(picture: Illustration) -> str:
    """Return a picture as SVG."""
    with rc_context(REPRODUCIBLE):
        figure = Figure(figsize=picture.size, dpi=100)
        FigureCanvasAgg(figure)
        painted(figure, picture, (0.0, 0.0))
        stream = BytesIO()
        figure.savefig(stream, format="svg", metadata={"Date": None, "Creator": None})
    return stream.getvalue().decode().replace("'DejaVu Sans'", FONT)


def painted(figure: Figure, picture: Illustration, corner: tuple[float, float]) -> Axes:
    """Return the axes of a picture, painted on a figure with its lower left corner at a place [inch]."""
    (wide, high), (left, right, bottom, top) = picture.size, picture.room
    whole_wide, whole_high = figure.get_size_inches()
    x, y = corner[0] + left, corner[1] + bottom
    place = (x / whole_wide, y / whole_high, (wide - left - right) / whole_wide, (high - bottom - top) / whole_high)
    ax = figure.add_axes(place)
    picture.paint(ax)
    return ax
