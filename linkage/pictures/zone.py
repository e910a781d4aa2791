"""A zone as a picture: between which values a quantity lies over the stroke, over a box of settings."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from ..checks import require_type
from ..mechanism import Mechanism
from ..motion import Column
from ..study import Zone
from . import style
from .curves import axis_range, panel_grid, stroke_panel
from .strokes import StrokeAxis


def plot_zone(machine: Mechanism, found: Zone, unit: str = "") -> Figure:
    """Return a figure of a zone of a machine over the stroke, with the curve of the machine as it is set in it where it is an output.

    `unit` is the one that the quantity is shown in. Raises DefinitionError for strokes that are no row.
    """
    require_type("", found, Zone, "is no zone; give the result of zone(...)")
    motion = machine.at(unreachable="nan", **found.strokes)
    along = StrokeAxis.of(motion)
    figure, (ax,) = panel_grid(1, machine.plan.heading, along.held)
    low, high = (Column(found.quantity, each, unit) for each in (found.low, found.high))
    ax.fill_between(along.values, low.drawn, high.drawn, color=style.CURVE, alpha=0.22, linewidth=0, zorder=3.0)
    for each in (low, high):
        ax.plot(along.values, each.drawn, color=style.CURVE, linewidth=style.BOLD, zorder=5.0)
    if found.quantity in machine.plan.members:
        now = Column(found.quantity, motion[found.quantity], unit)
        ax.plot(along.values, now.drawn, color=style.INK, linewidth=1.0, linestyle=(0, (4, 3)), zorder=5.5, label="as it is set")
        ax.legend(loc="best", frameon=False, fontsize=style.SMALL, labelcolor=style.INK)
    stroke_panel(ax, along, low.heading, axis_range(Column(found.quantity, np.concatenate([found.low, found.high]), unit)))
    return figure
