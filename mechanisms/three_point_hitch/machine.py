"""The hitch: equations (4) to (27), its implement, its cylinders, and the tractor it hangs on; hitches of categories 1 to 3."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, ClassVar

import numpy as np

from hydraulics import Cylinder, LiftCircuit
from hydraulics.inputs import positive
from linkage import LEFT, RIGHT, Column, Dimension, Dyad, Featured, Ground, Mechanism, Motion, OnLink, Outline, Stroke, angle, ratio, y
from linkage.errors import DefinitionError
from linkage.frozen import record
from linkage.language import noted, said
from linkage.loads import Weight
from linkage.loads.element import Formulas
from linkage.units import MPa, deg, g0, kg, litre, minute, mm
from linkage.verdict import Verdict

from .capacity import capacity, lifted, write_capacity
from .report import rules


class ThreePointHitch(Mechanism):
    """Cylinder AB turns the lift arm OBC; rod CD lifts the lower link EDF.

    MK is the adjustable upper link, KF the implement's upright, G its centre of gravity; the implement FKG is rigid.
    The origin is the driving wheels' axis projected on the ground, x away from the tractor, y up. tilt is the
    upright's angle from the vertical, positive when its top leans towards the tractor. Forces are those of both sides
    together; pressures are gauge; the circuit's mechanical efficiency is eta of (28), the full one.

    The dimensions are illustrative, of the proportions of category 3; they are not the UES-2-250A's own. So are the
    tractor, the implement and the cylinders. `admissible` are the settings of the zones of capacity and tilt.
    """

    S = Stroke(0.00, 0.25)  # cylinder stroke, m
    L0 = Dimension(0.50)  # pin-to-pin length at S = 0, m

    A = Ground(0.20, 0.55)
    O = Ground(0.30, 1.15)
    E = Ground(0.25, 0.60)
    M = Ground(0.22, 1.05)

    B = Dyad(A, O, AB=L0 + S, OB=0.30, side=RIGHT)  # cylinder and lift arm
    C = OnLink(O, B, OC=0.36, BC=0.16, side=LEFT)  # the arm's other end
    D = Dyad(E, C, ED=0.48, CD=0.62, side=RIGHT)  # lower link and lift rod
    F = OnLink(E, D, EF=0.95)  # EDF is straight
    K = Dyad(M, F, MK=0.88, FK=0.685, side=LEFT)  # upper link and upright
    G = OnLink(F, K, FG=0.90, KFG=75 * deg, side=RIGHT)  # centre of gravity
    tilt = angle(F, K) - 90 * deg  # a named output

    load = Weight(G, mass=2000)  # the implement, kg
    lift = Cylinder(A, B, bore=110 * mm, rod=63 * mm, count=2, closed=0.50, stroke=0.25)
    circuit = LiftCircuit(lift, pressure=18 * MPa, flow=60 * litre / minute, mechanical_efficiency=0.85)

    vehicle_mass = Dimension(8000 * kg, unit="kg")  # the tractor without the implement
    vehicle_x = Dimension(-1100 * mm, unit="mm")  # its centre of mass
    vehicle_y = Dimension(1100 * mm, unit="mm")
    wheelbase = Dimension(2750 * mm, unit="mm")  # the front axle stands at x = -wheelbase
    slope = Dimension(0 * deg, unit="deg")  # positive where the ground rises towards +x, behind the tractor
    least_front = Dimension(0.20)  # share of the tractor's weight that steering needs on the front axle

    ground = Outline.line((-3.0, 0.0), (5.0, 0.0))  # what stands around is drawn only; its figures are illustrative
    wheel = Outline.circle(at=(0.0, 0.85), radius=0.85)  # the rear wheel
    axle = Outline.circle(at=(0.0, 0.85), radius=0.09)

    admissible: ClassVar[Mapping[str, Any]] = MappingProxyType(
        {"MK": (0.80, 0.96), "CD": (0.56, 0.68), "FK": (0.61, 0.685), "M": [(0.22, 1.05), (0.22, 0.95)]}
    )

    def __init__(self, **dimensions: Any) -> None:
        """Set the design [SI]; DefinitionError also for a tractor that cannot be: no mass, no wheelbase, a slope of a wall."""
        super().__init__(**dimensions)
        for name in ("vehicle_mass", "wheelbase"):
            positive(self[name], name)
        if np.count_nonzero(abs(self["slope"]) >= 60 * deg):
            raise DefinitionError(f"slope = {np.max(np.abs(self['slope'])) / deg:.4g} deg; no tractor stands on 60 deg, give less.")
        if np.count_nonzero(self["least_front"] < 0.0) or np.count_nonzero(self["least_front"] >= 1.0):
            raise DefinitionError(f"least_front = {self['least_front']}: a share of the tractor's weight is expected, from 0 to below 1.")

    def columns(self, motion: Motion) -> list[Column]:
        """Return the stroke, the moving points, the ratio I = dG_y/dS (27), the lifting capacity (28) and the upright's tilt."""
        points = [each for each in super().columns(motion) if each.name != "tilt"]
        lifts = Column(noted("capacity"), capacity(motion), "kN", 3, lifted())
        growth = Column("I", motion.ratio("G")[1], "", 4, ratio(y("G")))
        return [*points, growth, lifts, Column(noted("tilt"), motion["tilt"], "deg", 3, "tilt")]

    def formulas(self, written: Formulas) -> None:
        """Write, after the lines of its elements, F_cyl = p_max area (29) and the lifting capacity G_g = F_cyl eta / I_G (28)."""
        super().formulas(written)
        write_capacity(written)

    def featured(self) -> Featured:
        """Return the lifting capacity with the implement's weight, which it may not fall below, and the path of G."""
        weight = float(self["load.mass"]) * g0
        limits = {"capacity": (weight, said("weight of the implement"), "below")} if weight > 0.0 else {}
        return Featured("capacity", ["G"], limits)

    def rules(self, motion: Motion) -> list[Verdict]:
        """Return the verdicts: capacity and its weakest point, pressure, oil, upper link, mast, front axle."""
        return rules(self, motion)


# Hitch categories 1 to 3: the dimensions that ISO 730 fixes, and hitches of such proportions.
#
# From ISO 730 (Agricultural wheeled tractors, rear-mounted three-point linkage, categories 1 to 4) are only the figures of
# `Category`: mast height, lower hitch point span and pin diameters, as implement makers' manuals reproduce them; tolerances are left out,
# the standard itself decides. Every other dimension of the hitches is illustrative: the shipped set of category 3,
# reduced to the mast height and rounded.


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


@record
class Category:
    """The dimensions of an ISO 730 category, and a machine of such proportions, whose other dimensions are illustrative.

    Attributes
    ----------
    number : int
        The category.
    mast_height, lower_span, upper_pin, lower_pin : float
        The mast's height, the span of the lower hitch points, and the diameters of the pins [m].
    machine : type of ThreePointHitch
        The machine.
    """

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
