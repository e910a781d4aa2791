"""Common parts of the papers' figures: sheets with a title, words along axes and beside a place. They load matplotlib."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from linkage.pictures import style
from linkage.pictures.sheet import panels
from linkage.program import FloatArray

WORDS: Mapping[str, Any] = {"fontsize": style.TEXT, "color": style.MUTED}
"""The look of what stands along an axis."""
CURVES: Mapping[str, Any] = {"fontsize": style.SMALL, "frameon": False, "labelcolor": style.INK}
"""The look of a legend."""


def titled(title: str, size: tuple[float, float], across: int, down: int = 1, **room: Any) -> tuple[Figure, list[Axes]]:
    """Return an empty figure with a title above its axes, as `panels` makes it."""
    figure, axes = panels(size, across, down, **room)
    figure.suptitle(title, fontsize=style.TITLE + 2, fontweight="bold", color=style.INK, x=0.012, ha="left")
    return figure, axes


def headed(ax: Axes, text: str, **look: Any) -> None:
    """Write a heading above axes, on the left."""
    ax.set_title(text, loc="left", **{"fontsize": style.TEXT, "color": style.INK, "pad": 6, **look})


def axis_words(ax: Axes, along: str, up: str) -> None:
    """Write the labels of both axes, with units."""
    ax.set_xlabel(along, **WORDS)
    ax.set_ylabel(up, **WORDS)


def curve(ax: Axes, along: FloatArray, values: FloatArray, colour: str, text: str = "", line: str = "-", width: float = 2.0) -> None:
    """Draw a curve, with its name in the legend where it has one."""
    ax.plot(along, values, color=colour, linewidth=width, linestyle=line, label=text or None, zorder=6.0)


def dot(ax: Axes, along: ArrayLike, values: ArrayLike, colour: str, size: float = 7.0) -> None:
    """Mark places by dots."""
    ax.plot(along, values, "o", color=colour, markersize=size, markeredgecolor=style.PAPER, zorder=8.0, clip_on=False)


def beside(ax: Axes, text: str, at: tuple[float, float], off: tuple[float, float], **look: Any) -> None:
    """Write a text so many points off a place."""
    ax.annotate(text, at, xytext=off, textcoords="offset points", **{"fontsize": style.SMALL, "color": style.MUTED, **look})


def marked_place(ax: Axes, along: float, value: float, text: str, colour: str = style.INK) -> None:
    """Mark a place of a curve by a dot, with words under it that stay within the axes."""
    low, high = ax.get_xlim()
    share = (along - low) / (high - low)
    side, aside = ("left", 9) if share < 0.2 else ("right", -9) if share > 0.8 else ("center", 0)
    dot(ax, along, value, colour)
    beside(ax, text, (along, value), (aside, -10), ha=side, va="top", color=colour, zorder=8.0)
