"""A tractor's three-point hitch: kinematics, lifting capacity, zones, the upper link, the mast, the tractor's balance.

Source: Dyuzhev, Kotov, Chuprynin, "Universality of the hitch of the power vehicle UES-2-250A" (Minsk, 2008).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from linkage.star import declare_public

from .. import paper
from .capacity import Weakest, at_hitch_points, behind, capacity, capacity_zone, tilt_zone, vertical_mast, weakest, zone_columns
from .machine import CATEGORIES, Category, HitchCategory1, HitchCategory2, ThreePointHitch
from .report import capacity_columns, front_axle, largest_mass, tipping_mass, tipping_slope, upper_link_force

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FIGURES = ("zones", "capacity", "lift")


def figure(name: str, hitch: ThreePointHitch | None = None) -> Figure:
    """Return a figure of a hitch as a matplotlib figure.

    Parameters
    ----------
    name : {"zones", "capacity", "lift"}
        "zones" is figure 2 of the paper, over the admissible settings. "capacity" is the capacity curve with its weakest point and the
        tractor's limits, "lift" the hitch at the ends of its lift range.
    hitch : ThreePointHitch, optional
        The hitch, by default the shipped one.

    Returns
    -------
    Figure
        The figure.

    Raises
    ------
    DefinitionError
        The name is not known, or it is a batch of designs.
    """
    from .figures import DRAWN

    return paper.named_figure(DRAWN, name, hitch if hitch is not None else ThreePointHitch())


declare_public(globals())
