"""The crane's figures, one call each: `crane_figure("map")`. They load matplotlib, and are loaded when one is drawn."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from linkage import draw, plot
from linkage.pictures import style
from linkage.pictures.sheet import panels, sheet
from linkage.units import kN

from ..paper import named_figure
from .drive_figures import drive_figure as drive_figure
from .drive_figures import one_movement
from .drive_report import worst_movements
from .flow import arm_drive_of, boom_drive_of
from .load_map import envelope, load_map
from .machine import Crane
from .skeleton import POSITIONS, CraneSkeleton

COUNT = 361
REACHED = "#dbe8f4"


def crane_figure(name: str, crane: Crane | None = None) -> Figure:
    """Return a figure of a crane, by default the shipped one; DefinitionError for an unknown name, a batch of designs.

    "positions" are those that its skeleton is laid out by, "moments" what boom and arm are given and asked for, "map" the load map,
    "reach" all that the tip reaches.
    """
    return named_figure(DRAWN, name, crane if crane is not None else Crane())


# -- positions ---------------------------------------------------------------------------------------------


def positions(crane: CraneSkeleton) -> Figure:
    """Return the crane in the positions that its skeleton is laid out by, with the heights that it has to keep."""
    bare = CraneSkeleton(**{name: crane[name] for name in CraneSkeleton.plan.defaults})
    page, axes = panels((13.4, 9.6), 2, 2, rect=(0.005, 0.01, 0.99, 0.96), w_pad=0.06, h_pad=0.06)
    lengths = ", ".join(f"{words} {float(crane[name]):.3f} m" for name, words in LENGTHS.items())
    title = f"Crane {float(crane['L']):.4g} m, {float(crane['M']) / kN:.4g} kNm: {lengths}"
    page.suptitle(title, fontsize=style.TITLE + 2, fontweight="bold", color=style.INK, x=0.012, ha="left")
    most = float(crane["L"])
    top = float(crane["H_p"] + crane["h_0"] + crane["l_c"])
    for ax, (number, words) in zip(axes, POSITIONS.items(), strict=True):
        sheet(ax, (-0.24 * most, 1.06 * most, -0.3, top + 0.5))
        surroundings(ax, crane)
        motion = bare.position(number)
        (start, end) = motion["K"], motion["T"]
        ax.plot(*zip(start, end, strict=True), color=style.BODIES[2], linewidth=5.0, solid_capstyle="round", zorder=8.0)
        draw(motion, ax=ax)
        ax.set_title(f"{number}: {words}", loc="left", fontsize=style.TEXT, color=style.INK, pad=6)
    return page


LENGTHS: Mapping[str, str] = MappingProxyType({"l_c": "boom", "l_p": "arm", "l_t": "telescope", "h_0": "column"})
HEIGHTS: Mapping[str, str] = MappingProxyType({"H_p": "platform", "h_s": "stakes", "H_k": "cab", "H_max": "legal height"})


def surroundings(ax: Axes, crane: CraneSkeleton) -> None:
    """Draw the ground, the column, the guard and the heights that the crane has to keep."""
    left, _ = ax.get_xlim()
    ax.axhspan(ax.get_ylim()[0], 0.0, color=style.GRID, zorder=1.0)
    ax.axhline(0.0, color=style.PISTON, linewidth=1.2, zorder=2.0)
    for name, words in HEIGHTS.items():
        height = float(crane[name])
        ax.axhline(height, color=style.ACCENT if name == "H_max" else style.MUTED, linewidth=0.8, linestyle=(0, (5, 4)), zorder=2.0)
        below = name == "h_s"  # stakes and cab are often nearly as high
        ax.annotate(
            words, (left, height), xytext=(4, -2 if below else 2), textcoords="offset points",
            va="top" if below else "bottom", fontsize=style.SMALL, color=style.MUTED, zorder=12.0,
        )  # fmt: skip
    platform, top = float(crane["H_p"]), float(crane["H_p"] + crane["h_0"])
    ax.add_patch(Rectangle((-0.12, platform), 0.24, top - platform, facecolor=style.BARREL, edgecolor=style.INK, linewidth=0.9, zorder=3.0))
    guard, stakes = float(crane["c"]), float(crane["h_s"])
    ax.plot([guard, guard], [platform, stakes], color=style.PISTON, linewidth=2.2, solid_capstyle="butt", zorder=3.0)
    ax.annotate(
        "guard", (guard, 0.5 * (platform + stakes)), xytext=(4, 0), textcoords="offset points",
        fontsize=style.SMALL, color=style.MUTED, va="center", zorder=12.0,
    )  # fmt: skip


# -- moments -----------------------------------------------------------------------------------------------


def crane_moments(crane: Crane) -> Figure:
    """Return what boom and arm are given by their cylinders and asked for at worst, over their angles."""
    page, axes = panels((17.0, 5.4), 3, rect=(0.005, 0.01, 0.985, 0.98), w_pad=0.12, h_pad=0.08)
    title = "Moments of boom and arm: given by the cylinder, asked for at worst"
    page.suptitle(title, fontsize=style.TITLE + 2, fontweight="bold", color=style.INK, x=0.012, ha="left")
    motions = [drive.working(COUNT) for drive in (boom_drive_of(crane), arm_drive_of(crane))]
    worst = [(motion, each) for motion in motions for each in worst_movements(motion)]
    for ax, (motion, each) in zip(axes, worst, strict=True):
        one_movement(ax, motion, each)
    return page


# -- the load map ------------------------------------------------------------------------------------------

CELLS = 14, 15


def shipped_map(crane: Crane) -> Figure:
    """Return the load map over all that the tip reaches above -0.2 of the reach, 14 radii by 15 heights."""
    far, top = envelope(crane).border.max(axis=(0, 1))
    across, down = CELLS
    return plot(load_map(crane, np.linspace(-0.2 * far, top - 0.3, down), np.linspace(0.05 * far, far - 0.02, across)))


# -- the reach ---------------------------------------------------------------------------------------------


def reach_figure(crane: Crane) -> Figure:
    """Return all that the tip reaches, the crane at its longest and folded in it."""
    found = envelope(crane)
    edges = found.border.reshape(-1, 2)
    page, (ax,) = panels((10.4, 9.6), 1, rect=(0.005, 0.01, 0.985, 0.96))
    title = f"Reach of the tip: {found.area:.1f} m²"
    page.suptitle(title, fontsize=style.TITLE + 2, fontweight="bold", color=style.INK, x=0.012, ha="left")
    (left, low), (right, high) = edges.min(axis=0), edges.max(axis=0)
    sheet(ax, (left - 0.4, right + 0.4, low - 0.4, high + 0.4))
    middle = 0.5 * (found.heights[1:] + found.heights[:-1])
    below, above = np.append(found.heights[0], middle), np.append(middle, found.heights[-1])
    strips = [[(a, below[k]), (b, below[k]), (b, above[k]), (a, above[k])] for k, a, b in found.spans]
    ax.add_collection(PolyCollection(strips, facecolors=REACHED, edgecolors=REACHED, linewidths=0.8, zorder=1.5), autolim=False)
    border = LineCollection(list(found.border), colors=style.INK, linewidths=1.4, capstyle="round", zorder=5.5)
    ax.add_collection(border, autolim=False)
    surroundings(ax, crane)
    draw(crane.position(3), ax=ax, faint=True)
    draw(crane.position(1), ax=ax)
    return page


DRAWN: Mapping[str, Callable[[Crane], Figure]] = MappingProxyType(
    {"positions": positions, "moments": crane_moments, "map": shipped_map, "reach": reach_figure}
)
