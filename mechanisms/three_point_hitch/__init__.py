"""A tractor's three-point hitch: kinematics, lifting capacity, zones, the upper link, the mast, the tractor's balance.

Source: Dyuzhev, Kotov, Chuprynin, "Universality of the hitch of the power vehicle UES-2-250A" (Minsk, 2008).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from linkage.star import declare_public

from .capacity import Weakest as Weakest
from .capacity import at_hitch_points as at_hitch_points
from .capacity import behind as behind
from .capacity import capacity as capacity
from .capacity import weakest as weakest
from .machine import CATEGORIES as CATEGORIES
from .machine import Category as Category
from .machine import HitchCategory1 as HitchCategory1
from .machine import HitchCategory2 as HitchCategory2
from .machine import ThreePointHitch as ThreePointHitch
from .report import capacity_columns as capacity_columns
from .report import upper_link_force as upper_link_force
from .tractor import front_axle as front_axle
from .tractor import largest_mass as largest_mass
from .tractor import tipping_mass as tipping_mass
from .tractor import tipping_slope as tipping_slope
from .zones import capacity_zone as capacity_zone
from .zones import tilt_zone as tilt_zone
from .zones import vertical_mast as vertical_mast
from .zones import zone_columns as zone_columns

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FIGURES = ("zones", "capacity", "lift")


def figure(name: str, hitch: ThreePointHitch | None = None) -> Figure:
    """Return a figure of a hitch, by default the shipped one, as a matplotlib figure; DefinitionError for an unknown name, a batch.

    "zones" is figure 2 of the paper, over the admissible settings. "capacity" is the capacity curve with its weakest point and
    the tractor's limits, "lift" the hitch at the ends of its lift range.
    """
    from .figures import figure

    return figure(name, hitch)


declare_public(globals())
