"""The paper's figure 1: the balanced header at its horizon with the circuit that fills its accumulators and is then shut off."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, Polygon, Rectangle

from linkage import draw, kgf_cm2, litre
from linkage.pictures import style
from linkage.pictures.scene import Scene
from linkage.pictures.sheet import haloed, sheet

from ..sheets import beside, headed, titled
from .machine import HeaderBalancer

BOX = (-4.05, 3.3, -0.5, 2.2)
"""m: what the sheet shows; the circuit stands behind the wheel, not to scale."""
MAIN, DRAIN, PUMP, RELIEF, VALVE, GAUGE = 1.35, 0.25, -3.25, -2.7, -2.15, -1.7
"""m: the heights of the main line and of the tank, and where along them pump, relief valve, valve and gauge stand."""
LOW = 0.1
"""m: the height at which the line passes under the wheel."""


def scheme(machine: HeaderBalancer, title: str) -> Figure:
    """Return the header at its horizon with tank, pump, relief valve, valve, gauge and accumulators."""
    page, (ax,) = titled(title, (13.0, 5.7), 1, rect=(0.01, 0.01, 0.98, 0.95))
    sheet(ax, BOX)
    headed(ax, "The circuit is not to scale. The valve fills the accumulators. Shut, it leaves them and the cylinders one closed volume.")
    motion = machine.at(h=float(machine.at(h=machine.strokes["h"].start)["h_horizon"]))
    A, B = motion["A"], motion["B"]
    port = A + 0.075 * (B - A) / np.hypot(*(B - A))
    oil_line(ax, (PUMP, DRAIN), (PUMP, MAIN), (GAUGE, MAIN), (GAUGE, LOW), (port[0], LOW), (port[0], port[1] - 0.05))
    oil_line(ax, (RELIEF, MAIN), (RELIEF, DRAIN))
    oil_line(ax, (GAUGE, MAIN), (GAUGE, MAIN + 0.25))
    draw(motion, ax=ax)
    pump, relief, charge = (f"{float(machine[name]) / kgf_cm2:.4g} kgf/cm²" for name in ("pump", "valve", "charge"))
    for x in (PUMP, RELIEF):
        tank(ax, x)
    ax.add_patch(Circle((PUMP, 0.8), 0.17, facecolor=style.PAPER, edgecolor=style.INK, zorder=12.0))
    ax.add_patch(Polygon([(PUMP, 0.97), (PUMP - 0.08, 0.84), (PUMP + 0.08, 0.84)], facecolor=style.INK, zorder=13.0))
    named(ax, (PUMP - 0.25, 0.8), f"pump\n{pump}", "right")
    valve(ax, RELIEF, 0.8, upright=True)
    named(ax, (RELIEF + 0.22, 0.72), f"relief valve\n{relief}", "left")
    valve(ax, VALVE, MAIN, upright=False)
    named(ax, (VALVE, MAIN - 0.27), "valve", "center")
    ax.add_patch(Circle((GAUGE, (MAIN + 0.4)), 0.15, facecolor=style.PAPER, edgecolor=style.INK, zorder=12.0))
    ax.add_line(Line2D([GAUGE - 0.07, GAUGE + 0.08], [MAIN + 0.33, MAIN + 0.48], color=style.INK, zorder=13.0))
    named(ax, (GAUGE - 0.22, MAIN + 0.4), f"gauge\n{charge}", "right")
    named(ax, (PUMP, DRAIN - 0.22), "tank", "center")
    pairs = [(float(machine[volume]) / litre, float(machine[gas]) / kgf_cm2) for volume, gas in (("V_I", "P_I"), ("V_II", "P_II"))]
    text = "\n".join(["accumulators", *(f"{size:.4g} l, gas at {gas:.4g} kgf/cm²" for size, gas in pairs if size > 0.0)])
    vessels = Scene(motion).accumulators[0]
    x, y = vessels.placed(vessels.corners, Scene(motion).at(0)).mean(axis=0).tolist()
    leader = {"arrowstyle": "-", "color": style.MUTED, "linewidth": 0.8}
    beside(ax, text, (x, y), (60, -52), color=style.INK, zorder=14.0, va="center", arrowprops=leader)
    return page


def oil_line(ax: Axes, *places: Sequence[float]) -> None:
    """Draw a line of oil through some places [m]."""
    ax.plot(*np.array(places).T, color=style.CURVE, linewidth=1.8, solid_joinstyle="round", zorder=9.0)


def tank(ax: Axes, x: float) -> None:
    """Draw the sign of the tank under the end of a line."""
    low, high = DRAIN - 0.08, DRAIN + 0.08
    ax.add_line(Line2D([x - 0.16, x - 0.16, x + 0.16, x + 0.16], [high, low, low, high], color=style.INK, zorder=12.0))


def valve(ax: Axes, x: float, y: float, *, upright: bool) -> None:
    """Draw a valve as a box with an arrow: along its line; beside it, with a spring, one that a pressure opens."""
    half = 0.15
    ax.add_patch(Rectangle((x - half, y - half), 2.0 * half, 2.0 * half, facecolor=style.PAPER, edgecolor=style.INK, zorder=12.0))
    start, end = ((x + 0.06, y + 0.12), (x + 0.06, y - 0.12)) if upright else ((x - 0.12, y), (x + 0.12, y))
    ax.annotate("", end, start, arrowprops={"arrowstyle": "-|>", "color": style.INK, "shrinkA": 0, "shrinkB": 0}, zorder=13.0)
    if upright:
        turns = np.arange(7)
        ax.add_line(Line2D(x - half - 0.03 * turns, y - 0.035 + 0.07 * (turns % 2), color=style.INK, linewidth=1.0, zorder=12.0))


def named(ax: Axes, place: tuple[float, float], text: str, ha: str) -> None:
    """Write a part's name beside it."""
    haloed(ax, text, np.array(place), style.SMALL, style.INK, ha=ha, va="center", zorder=14.0)
