"""The hitch's figures, one call each: `figure("zones")`. They load matplotlib, and are loaded when one is drawn.

"zones" is figure 2 of the paper, over the admissible settings. "capacity" is the capacity curve with its weakest point and
the tractor's limits, "lift" the hitch at the ends of its lift range.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from linkage import draw
from linkage.pictures import style
from linkage.reports import closely
from linkage.units import deg, g0, kN, mm

from ..sheets import CURVES, WORDS, axis_words, beside, curve, headed, marked_place, titled
from .capacity import admissible, at_hitch_points, behind, capacity, capacity_zone, tilt_zone, weakest
from .machine import ThreePointHitch
from .report import largest_mass, tipping_mass

COUNT = 101


# -- figure 2 ----------------------------------------------------------------------------------------------


def zones(hitch: ThreePointHitch) -> Figure:
    """Return the zones of capacity and tilt over the stroke, one band for each mounting hole, with the nominal curves."""
    sheet, (left, right) = _sheet(2, "Zones over all admissible settings")
    motion = hitch.at(S=np.linspace(hitch.strokes["S"].start, hitch.strokes["S"].end, COUNT), unreachable="nan")
    over = admissible(hitch)
    holes = over.get("M", [tuple(hitch["M"])])
    for place, hole in enumerate(holes):
        text = f"hole M{place + 1} at ({hole[0] / mm:.0f}, {hole[1] / mm:.0f}) mm"
        for ax, band, unit in ((left, capacity_zone, kN), (right, tilt_zone, deg)):
            found, colour = band(hitch, {**over, "M": [hole]}, S=motion.strokes["S"]), (style.CURVE, style.ACCENT, *style.BODIES)[place % 8]
            S, low, high = found.strokes["S"] / mm, found.low / unit, found.high / unit
            ax.fill_between(S, low, high, color=colour, alpha=0.22, linewidth=0, zorder=3.0 + place, label=text)
            for edge in (low, high):
                ax.plot(S, edge, color=colour, linewidth=1.3, zorder=4.0 + place)
    ranges = {name: value for name, value in over.items() if isinstance(value, tuple)}
    set_to = ", ".join(f"{name} {hitch[name] / mm:.0f}" for name in ranges)
    curve(left, motion.strokes["S"] / mm, capacity(motion) / kN, style.INK, f"set to {set_to} mm")
    curve(right, motion.strokes["S"] / mm, motion["tilt"] / deg, style.INK, f"set to {set_to} mm")
    _named(left, "Lifting capacity", "stroke S, mm", "capacity at G, kN")
    _named(right, "Tilt of the upright", "stroke S, mm", "tilt, deg; + leans towards the tractor")
    words = ", ".join(f"{name} {low / mm:.0f} to {high / mm:.0f}" for name, (low, high) in ranges.items())
    words = f"settings, mm: {words}; extremes over the whole box, not only its corners"
    sheet.text(0.012, 0.012, words, fontsize=style.SMALL, color=style.MUTED, ha="left")
    right.axhline(0.0, color=style.MUTED, linewidth=0.8, zorder=2.0)
    return sheet


# -- the capacity curve ------------------------------------------------------------------------------------


def curves(hitch: ThreePointHitch) -> Figure:
    """Return the capacity over the stroke with its weakest point, the test curves, and the tractor's limits."""
    sheet, (ax,) = _sheet(1, "Lifting capacity")
    start, end = hitch.strokes["S"].start, hitch.strokes["S"].end
    motion = closely(hitch.at(S=np.linspace(start, end, COUNT), unreachable="nan"))
    S = motion.strokes["S"] / mm
    curve(ax, S, capacity(motion) / kN, style.CURVE, "at G, full pressure")
    curve(ax, S, at_hitch_points(motion) / kN, style.PISTON, "at the hitch points F, 90 % of the pressure", "--")
    curve(ax, S, behind(motion) / kN, style.PISTON, "610 mm behind F, 90 % of the pressure", ":")
    curve(ax, S, tipping_mass(motion) * g0 / kN, style.ACCENT, "at G, where the tractor tips")
    share = 100 * float(hitch["least_front"])
    curve(ax, S, largest_mass(motion) * g0 / kN, style.ACCENT, f"at G, with {share:.0f} % of its weight left on the front axle", "--")
    weight = float(hitch["load.mass"])
    curve(ax, S, np.full(S.shape, weight * g0 / kN), style.INK, f"the implement, {weight:.0f} kg", "-", 1.2)
    found = weakest(motion)
    if found is not None:
        text = f"weakest: {found.capacity / kN:.1f} kN at S = {found.stroke / mm:.0f} mm,\nG rises {found.ratio:.2f} mm for 1 mm of stroke"
        marked_place(ax, found.stroke / mm, found.capacity / kN, text, style.CURVE)
    _named(ax, "", "stroke S, mm", "load that can be lifted, kN")
    ax.set_ylim(0.0, None)
    height = motion.y("F") / mm
    if np.all(np.diff(height) > 0.0):  # an upper axis with the height of the hitch points where it follows the stroke
        there_and_back = (lambda s: np.interp(np.asarray(s), S, height), lambda h: np.interp(np.asarray(h), height, S))
        upper = ax.secondary_xaxis("top", functions=there_and_back)
        upper.set_xticks(np.arange(np.ceil(height[0] / 100.0), np.floor(height[-1] / 100.0) + 1.0) * 100.0)
        upper.set_xlabel("height of the hitch points F, mm", **WORDS)
        upper.tick_params(colors=style.MUTED, labelsize=style.SMALL, length=3)
        upper.spines["top"].set_color(style.RULE)
    ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.14), ncols=2, **CURVES)
    return sheet


def lift_range(hitch: ThreePointHitch) -> Figure:
    """Return the hitch lowered (faint) and lifted, with the lift range of the hitch points."""
    sheet = draw(hitch, path=["F", "G"])
    (ax,) = sheet.axes
    ends = hitch.at(S=[hitch.strokes["S"].start, hitch.strokes["S"].end])
    low, high = ends.y("F")
    at = float(np.max(ends.x("F"))) + 0.10
    for x, y in zip(ends.x("F"), (low, high), strict=True):
        ax.plot([x, at + 0.02], [y, y], color=style.INK, linewidth=0.8, zorder=19.0)
    arrow = {"arrowstyle": "<->", "color": style.INK, "linewidth": 1.0, "shrinkA": 0, "shrinkB": 0}
    ax.annotate("", (at, high), xytext=(at, low), arrowprops=arrow, zorder=19.0)
    box = {"boxstyle": "square,pad=0.15", "facecolor": style.PAPER, "edgecolor": "none"}
    text = f"{(high - low) / mm:.0f} mm"
    beside(ax, text, (at, 0.5 * (low + high)), (5, 0), va="center", fontsize=style.TEXT, color=style.INK, zorder=20.0, bbox=box)
    return sheet


DRAWN: Mapping[str, Callable[[ThreePointHitch], Figure]] = MappingProxyType({"zones": zones, "capacity": curves, "lift": lift_range})


# -- the sheet ---------------------------------------------------------------------------------------------


def _sheet(count: int, title: str) -> tuple[Figure, list[Axes]]:
    """Return an empty figure with a title and so many axes."""
    size, below = ((10.6, 5.2), 0.05) if count == 2 else ((8.4, 6.2), 0.01)
    return titled(title, size, count, rect=(0.005, below, 0.98, 0.985 - below), w_pad=0.08, h_pad=0.08)


def _named(ax: Axes, title: str, along: str, value: str) -> None:
    ax.margins(x=0.0)
    if title:
        headed(ax, title, fontsize=style.TITLE, fontweight="bold", pad=9)
        ax.legend(loc="best", **CURVES)
    axis_words(ax, along, value)
