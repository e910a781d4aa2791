"""Hitch categories 1 to 3: the dimensions that ISO 730 fixes, and hitches of such proportions.

From ISO 730 (Agricultural wheeled tractors, rear-mounted three-point linkage, categories 1 to 4) are only the figures of
`Category`: mast height, lower hitch point span and pin diameters, as implement makers' manuals reproduce them; tolerances are left out,
the standard itself decides. Every other dimension of the hitches is illustrative: the shipped set of category 3,
reduced to the mast height and rounded.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, ClassVar

from hydraulics import Cylinder, LiftCircuit
from linkage import LEFT, RIGHT, Dimension, Dyad, Ground, OnLink, Stroke, Weight
from linkage.units import MPa, deg, kg, litre, minute, mm

from .machine import ThreePointHitch


class HitchCategory2(ThreePointHitch):
    """A hitch of the proportions of category 2; from ISO 730 is the mast height FK = 610 mm, all else is illustrative."""

    S = Stroke(0.00, 0.22)
    L0 = Dimension(0.445)
    A, O, E, M = Ground(0.18, 0.49), Ground(0.265, 1.025), Ground(0.22, 0.535), Ground(0.195, 0.935)
    B = Dyad(A, O, AB=L0 + S, OB=0.265, side=RIGHT)
    C = OnLink(O, B, OC=0.32, BC=0.14, side=LEFT)
    D = Dyad(E, C, ED=0.425, CD=0.55, side=RIGHT)
    F = OnLink(E, D, EF=0.845)
    K = Dyad(M, F, MK=0.785, FK=0.610, side=LEFT)
    G = OnLink(F, K, FG=0.80, KFG=75 * deg, side=RIGHT)
    load = Weight(G, mass=1300)
    lift = Cylinder(A, B, bore=90 * mm, rod=50 * mm, count=2, closed=0.445, stroke=0.22)
    circuit = LiftCircuit(lift, pressure=18 * MPa, flow=45 * litre / minute, mechanical_efficiency=0.85)
    vehicle_mass, vehicle_x, vehicle_y = Dimension(5500 * kg, unit="kg"), Dimension(-1.0, unit="mm"), Dimension(1.0, unit="mm")
    wheelbase = Dimension(2.5, unit="mm")
    admissible: ClassVar[Mapping[str, Any]] = MappingProxyType(
        {"MK": (0.71, 0.855), "CD": (0.50, 0.605), "M": [(0.195, 0.935), (0.195, 0.845)]}
    )


class HitchCategory1(ThreePointHitch):
    """A hitch of the proportions of category 1; from ISO 730 is the mast height FK = 460 mm, all else is illustrative."""

    S = Stroke(0.00, 0.165)
    L0 = Dimension(0.335)
    A, O, E, M = Ground(0.135, 0.37), Ground(0.20, 0.77), Ground(0.165, 0.40), Ground(0.145, 0.705)
    B = Dyad(A, O, AB=L0 + S, OB=0.20, side=RIGHT)
    C = OnLink(O, B, OC=0.24, BC=0.105, side=LEFT)
    D = Dyad(E, C, ED=0.32, CD=0.415, side=RIGHT)
    F = OnLink(E, D, EF=0.635)
    K = Dyad(M, F, MK=0.59, FK=0.460, side=LEFT)
    G = OnLink(F, K, FG=0.60, KFG=75 * deg, side=RIGHT)
    load = Weight(G, mass=450)
    lift = Cylinder(A, B, bore=63 * mm, rod=36 * mm, count=2, closed=0.335, stroke=0.165)
    circuit = LiftCircuit(lift, pressure=16 * MPa, flow=25 * litre / minute, mechanical_efficiency=0.85)
    vehicle_mass, vehicle_x, vehicle_y = Dimension(2500 * kg, unit="kg"), Dimension(-0.80, unit="mm"), Dimension(0.80, unit="mm")
    wheelbase = Dimension(2.0, unit="mm")
    admissible: ClassVar[Mapping[str, Any]] = MappingProxyType(
        {"MK": (0.535, 0.645), "CD": (0.375, 0.455), "M": [(0.145, 0.705), (0.145, 0.64)]}
    )


@dataclass(frozen=True)
class Category:
    """What ISO 730 fixes of a category [m], and a machine of such proportions, whose other dimensions are illustrative."""

    number: int
    mast_height: float
    lower_span: float
    upper_pin: float
    lower_pin: float
    machine: type[ThreePointHitch]
    source: ClassVar[str] = "ISO 730, nominal, as implement makers' manuals reproduce it"

    def __str__(self) -> str:
        return (
            f"category {self.number} ({self.source}): mast height {self.mast_height / mm:.0f} mm, span of the lower hitch points "
            f"{self.lower_span / mm:.0f} mm, pins {self.upper_pin / mm:.4g} mm above and {self.lower_pin / mm:.4g} mm below; "
            "all other dimensions of the hitch are illustrative"
        )


CATEGORIES: Mapping[int, Category] = MappingProxyType(
    {
        1: Category(1, 460 * mm, 683 * mm, 19 * mm, 22 * mm, HitchCategory1),
        2: Category(2, 610 * mm, 825 * mm, 25.5 * mm, 28 * mm, HitchCategory2),
        3: Category(3, 685 * mm, 965 * mm, 31.75 * mm, 36.6 * mm, ThreePointHitch),
    }
)
