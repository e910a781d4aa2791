"""Draw the pictures of oil lines and of the machines with them: `python docs/pictures/oil.py`, into docs/images."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from linkage import Acting, draw, kN, mm, reaction
from linkage.pictures import style
from mechanisms.at_work.axle import Axle, CrossedAxle
from mechanisms.at_work.levelled import LevelledTelehandler
from mechanisms.at_work.one_pump import PumpedExcavator

IMAGES = Path(__file__).parents[1] / "images"


def levelled() -> Figure:
    """Return the levelled telehandler, its boom down and up."""
    figure = Figure(figsize=(9.0, 6.4), dpi=style.DPI, facecolor=style.PAPER, layout="constrained")
    FigureCanvasAgg(figure)
    ax, motion = figure.subplots(), LevelledTelehandler().at(lift=[0.12, 0.72], extend=0.4, tilt=0.0)
    draw(motion, ax=ax, pose=0, faint=True)
    draw(motion, ax=ax, pose=1)
    ax.set(xlim=(-3.7, 4.0), ylim=(-0.4, 5.2))
    return figure


def axle() -> Figure:
    """Return an axle while it rolls, and what its right wheel carries as both struts go in and as it rolls, on one block and crossed."""
    figure = Figure(figsize=(10.4, 3.6), dpi=style.DPI, facecolor=style.PAPER, layout="constrained")
    FigureCanvasAgg(figure)
    picture, bump, roll = figure.subplots(1, 3, width_ratios=[1.5, 1.0, 1.0])
    draw(Axle().at(right_in=[0.05], left_in=[-0.05]), ax=picture, pose=0)
    for each in picture.texts:
        each.set_visible(False)
    way = np.linspace(-1.0, 1.0, 81)
    for machine, colour, name in ((Axle(), style.CURVE, "one block"), (CrossedAxle(), style.ACCENT, "crossed")):
        for ax, reach, left in ((bump, 0.10, 1.0), (roll, 0.05, -1.0)):
            motion = machine.at(right_in=reach * way, left_in=left * reach * way)
            ax.plot(reach * way / mm, reaction(motion, support="right.wheel", drive="right_in") / kN, color=colour, label=name)
    dress(bump, "both struts in, mm", "right wheel, kN")
    dress(roll, "right strut in, left one out, mm", "right wheel, kN")
    for ax in (bump, roll):
        ax.set_ylim(0.0, 52.0)
    return figure


def one_pump() -> Figure:
    """Return the chart of a cycle: an excavator whose three cylinders share one pump."""
    start, acting = {"lift": 0.100, "swing": 0.400, "curl": 0.155}, Acting(case="carrying")
    return PumpedExcavator.supply.run(
        PumpedExcavator(), demands={"boom.ram": 0.15, "arm.ram": -0.15, "tool.ram": 0.15}, start=start, until=4.0, acting=acting
    ).cycle.plot()


def dress(ax: Axes, across: str, up: str) -> None:
    """Dress a panel of curves."""
    ax.set_xlabel(across, fontsize=style.LABEL, color=style.INK)
    ax.set_title(up, fontsize=style.LABEL, color=style.INK)
    ax.grid(color=style.GRID, linewidth=0.6)
    ax.tick_params(labelsize=style.TEXT, colors=style.MUTED)
    for spine in ax.spines.values():
        spine.set_color(style.RULE)
    ax.legend(fontsize=style.LABEL, frameon=False)


PICTURES: dict[str, Callable[[], Figure]] = {"at_work_axle": axle, "at_work_levelled": levelled, "one_pump_cycle": one_pump}

if __name__ == "__main__":
    for name, picture in PICTURES.items():
        picture().savefig(IMAGES / f"{name}.png", metadata={"Software": None})
