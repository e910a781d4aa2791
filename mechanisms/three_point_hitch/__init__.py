"""A tractor's three-point hitch: kinematics, lifting capacity, zones, the upper link, the mast, the tractor's balance.

Source: Dyuzhev, Kotov, Chuprynin, "Universality of the hitch of the power vehicle UES-2-250A" (Minsk, 2008).
"""

from .capacity import at_hitch_points as at_hitch_points
from .capacity import behind as behind
from .capacity import capacity as capacity
from .categories import CATEGORIES as CATEGORIES
from .categories import Category as Category
from .categories import HitchCategory1 as HitchCategory1
from .categories import HitchCategory2 as HitchCategory2
from .figures import figure as figure
from .machine import ThreePointHitch as ThreePointHitch
from .report import capacity_columns as capacity_columns
from .report import upper_link_force as upper_link_force
from .tractor import front_axle as front_axle
from .tractor import largest_mass as largest_mass
from .tractor import tipping_mass as tipping_mass
from .tractor import tipping_slope as tipping_slope
from .weakest import Weakest as Weakest
from .weakest import weakest as weakest
from .zones import capacity_zone as capacity_zone
from .zones import tilt_zone as tilt_zone
from .zones import vertical_mast as vertical_mast
from .zones import zone_columns as zone_columns
