"""The improved mechanism of figure 6: an arm that grows while the header rises matches needed and given pressure."""

from __future__ import annotations

from hydraulics import Cylinder
from linkage import Dimension, Ground, OnLink, Stroke
from linkage.units import deg, kg, kgf_cm2, mm

from .machine import HeaderBalancer


class ImprovedBalancer(HeaderBalancer):
    """Header 1 on a linkage whose arm H grows while the header rises, charged to just below its limit.

    Illustrative as all dimensions here: found by a search for the least spread of the reaction over the following range, such that it
    rises with the header, the pump keeps its reserve, and the cylinder's closed length suits its stroke.
    """

    h = Stroke(0.0, 0.25)                                       # m
    L_min = Dimension(0.56, unit="mm")
    L_OB = Dimension(1.20, unit="mm")
    L_OR = Dimension(2.665521, unit="mm")
    BOR = Dimension(13.055247 * deg, unit="deg")
    A = Ground(0.338, 0.433)
    G2 = OnLink("O", "B", OG2=2.137161, BOG2=28.184398 * deg)
    m2 = Dimension(2000 * kg, unit="kg")
    charge = Dimension(133.5 * kgf_cm2, unit="kgf/cm2")
    lift = Cylinder("A", "B", bore=63 * mm, rod=40 * mm, count=2, closed=0.56, stroke=0.25)
