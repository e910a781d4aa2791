"""A zone as a picture: between which values a quantity lies over the stroke, over a box of settings."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from ..errors import DefinitionError, cited
from ..mechanism import Mechanism
from ..motion import Column
from ..study import Zone
from . import style
from .curves import axis_range, locator, panel_grid, typeset
from .sheet import quiet
from .strokes import StrokeAxis


def plot_zone(machine: Mechanism, found: Zone, unit: str = "") -> Figure:
    """Return a figure of a zone of a machine over the stroke, with the curve of the machine as it is set in it where it is an output.

    `unit` is the one that the quantity is shown in. Raises DefinitionError for strokes that are no row.
    """
    if not isinstance(found, Zone):
        raise DefinitionError(f"{cited(found)} is no zone; give the result of zone(...).")
    motion = machine.at(unreachable="nan", **found.strokes)
    along = StrokeAxis.of(motion)
    figure, (ax,) = panel_grid(1)
    title = machine.plan.heading + (f" at {along.held}" if along.held else "")
    figure.suptitle(title, fontsize=style.TITLE + 2, fontweight="bold", color=style.INK, x=0.012, ha="left")
    low, high = (Column(found.quantity, each, unit) for each in (found.low, found.high))
    quiet(ax)
    ax.fill_between(along.values, low.drawn, high.drawn, color=style.CURVE, alpha=0.22, linewidth=0, zorder=3.0)
    for each in (low, high):
        ax.plot(along.values, each.drawn, color=style.CURVE, linewidth=style.BOLD, zorder=5.0)
    if found.quantity in machine.plan.members:
        now = Column(found.quantity, motion[found.quantity], unit)
        ax.plot(along.values, now.drawn, color=style.INK, linewidth=1.0, linestyle=(0, (4, 3)), zorder=5.5, label="as it is set")
        ax.legend(loc="best", frameon=False, fontsize=style.SMALL, labelcolor=style.INK)
    ax.set_title(typeset(low.heading), loc="left", fontsize=style.TITLE, fontweight="bold", color=style.INK, pad=9)
    ax.set_xlabel(along.heading, fontsize=style.TEXT, color=style.MUTED)
    ax.set_xlim(float(along.values.min()), float(along.values.max()))
    ax.set_ylim(*axis_range(Column(found.quantity, np.concatenate([found.low, found.high]), unit)))
    ax.xaxis.set_major_locator(locator(along.is_turning))
    ax.yaxis.set_major_locator(locator())
    return figure
