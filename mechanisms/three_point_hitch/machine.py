"""The hitch: equations (4) to (27), its implement, its cylinders, and the tractor it hangs on."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, ClassVar

import numpy as np

from hydraulics import Cylinder, LiftCircuit
from hydraulics.inputs import positive
from linkage import LEFT, RIGHT, Column, DefinitionError, Dimension, Dyad, Ground, Mechanism, Motion, OnLink, Stroke, Weight, angle
from linkage.units import MPa, deg, kg, litre, minute, mm

from .capacity import capacity
from .report import verdicts


class ThreePointHitch(Mechanism):
    """Cylinder AB turns the lift arm OBC; rod CD lifts the lower link EDF.

    MK is the adjustable upper link, KF the implement's upright, G its centre of gravity; the implement FKG is rigid.
    The origin is the driving wheels' axis projected on the ground, x away from the tractor, y up. tilt is the
    upright's angle from the vertical, positive when its top leans towards the tractor. Forces are those of both sides
    together; pressures are gauge; the circuit's mechanical efficiency is eta of (28), the full one.

    The dimensions are illustrative, of the proportions of category 3; they are not the UES-2-250A's own. So are the
    tractor, the implement and the cylinders. `admissible` are the settings of the zones of figure 2.
    """

    S = Stroke(0.00, 0.25)                                # cylinder stroke, m
    L0 = Dimension(0.50)                                  # pin-to-pin length at S = 0, m

    A = Ground(0.20, 0.55)
    O = Ground(0.30, 1.15)
    E = Ground(0.25, 0.60)
    M = Ground(0.22, 1.05)

    B = Dyad(A, O, AB=L0 + S, OB=0.30, side=RIGHT)        # cylinder and lift arm
    C = OnLink(O, B, OC=0.36, BC=0.16, side=LEFT)         # the arm's other end
    D = Dyad(E, C, ED=0.48, CD=0.62, side=RIGHT)          # lower link and lift rod
    F = OnLink(E, D, EF=0.95)                             # EDF is straight
    K = Dyad(M, F, MK=0.88, FK=0.685, side=LEFT)          # upper link and upright
    G = OnLink(F, K, FG=0.90, KFG=75 * deg, side=RIGHT)   # centre of gravity
    tilt = angle(F, K) - 90 * deg                         # a named output

    load = Weight(G, mass=2000)                           # the implement, kg
    lift = Cylinder(A, B, bore=110 * mm, rod=63 * mm, count=2, closed=0.50, stroke=0.25)
    circuit = LiftCircuit(lift, pressure=18 * MPa, flow=60 * litre / minute, mechanical_efficiency=0.85)

    vehicle_mass = Dimension(8000 * kg, unit="kg")        # the tractor without the implement
    vehicle_x = Dimension(-1100 * mm, unit="mm")          # its centre of mass
    vehicle_y = Dimension(1100 * mm, unit="mm")
    wheelbase = Dimension(2750 * mm, unit="mm")           # the front axle stands at x = -wheelbase
    slope = Dimension(0 * deg, unit="deg")                # positive where the ground rises towards +x, behind the tractor
    least_front = Dimension(0.20)                         # share of the tractor's weight that steering needs on the front axle

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
        lifted = Column("capacity", capacity(motion), "kN", 3)
        return [*points, Column("I", motion.ratio("G")[1], "", 4), lifted, Column("tilt", motion["tilt"], "deg", 3)]

    def verdicts(self, motion: Motion) -> list[str]:
        """Return what an engineer should know: capacity and its weakest point, pressure, oil, upper link, mast, front axle."""
        return verdicts(self, motion)
