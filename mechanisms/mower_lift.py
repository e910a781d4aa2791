"""The lift of a mower-conditioner's left section: one cylinder, one turning lever.

Source: worksheet "Mathematical modelling of the lift of the left section of the rotary mower-conditioner KPR-6"
(closed vector loop method). Symbols and data are the worksheet's.
"""

from __future__ import annotations

from math import atan2, hypot, pi
from typing import Any

from hydraulics import Cylinder, CylinderSize, LiftCircuit, pressure, reserve, thrust
from hydraulics.inputs import efficient, in_pascals, positive
from linkage import RIGHT, Column, CosineAngle, Dyad, Featured, Ground, Mechanism, Motion, OnLink, Outline, Over, ramp, ratio
from linkage.loads import ForceElement, Weight
from linkage.loads.element import Formulas
from linkage.quantities import Coordinate, Dimension, Stroke, angle, distance, y
from linkage.units import cm, deg, g0, kgf, kgf_cm2, mm, show

G_FROM_O = (1.07, -0.37)  # centre of gravity from O at S = 0.55 m, as the input says, m
BELOW = atan2(G_FROM_O[1], G_FROM_O[0])  # its direction from O, rad
DELFI = 129.5 * deg  # lever and x axis at S = 0.55 m: what the printed tables are computed with
DELFI_OF_INPUT = 126.665 * deg  # the same angle as the input data give it


class MowerLift(Mechanism):
    """Cylinder AB turns the lever OB; the section, with its centre of gravity G, is rigid with the lever.

    S is the distance of the cylinder's pins. Results are the worksheet's: FIS = angle AOB, FI = angle OAB, FI3 the
    direction of OB, FIS1 that of AB below the x axis, I = dG_y/dS the transfer ratio. The rod carries P I without
    friction and P I / k_m while it lifts (k_m: mechanical efficiency). The worksheet's F = P I / (k_m k_g) is a
    *reduced* load: it gives the supply pressure pd = F / area, the rod never carries it. The largest rod force,
    F_max = k_g p_max area, compares with P I / k_m, never with F: that would count the hydraulic efficiency k_g twice.
    With other loads beside the section's weight (a subclass with `ballast = Weight(G, mass=500)`) all of them count, in
    the place of P I stands what the rod carries. The rod's diameter is not printed, 45 mm is illustrative.

    The source contradicts itself about G at S = 0.55 m. The input says (1.07, -0.37) m from O. A remark says that the x axis passes through
    G (G_y = 0). The printed table says G = (1.739, 0.013) m, which is (1.087, -0.317) m from O. The input agrees with a lever angle DELFI =
    126.665 deg, the tables are computed with 129.5 deg. Here are the tables: BOG = 129.5 deg + atan(-0.37 / 1.07). The other reading is
    MowerLift(BOG=DELFI_OF_INPUT + BELOW). The verdict stands either way: kz = 0.963 at S = 0.55 m, short up to S = 0.5660 m, as printed;
    0.978, short up to 0.5604 m, else.
    """

    S = Stroke(0.55, 0.80)  # distance of the cylinder's pins, m

    A = Ground(0.0, 0.242)
    O = Ground(0.652, 0.330)

    B = Dyad(A, O, AB=S, OB=0.175, side=RIGHT)  # cylinder and turning lever
    G = OnLink(O, B, OG=hypot(*G_FROM_O), BOG=DELFI + BELOW)  # centre of gravity; BOG is the worksheet's FIS3

    ground = Outline.line((-1.5, -0.35), (3.5, -0.35))  # drawn only, illustrative

    FI0 = angle(A, O)
    FIS = CosineAngle(distance(A, O), distance(O, B), S)
    FI3 = pi + FI0 + FIS
    FI = CosineAngle(distance(A, O), S, distance(O, B))
    FIS1 = FI - FI0

    weight = Dimension(900 * kgf, unit="kgf")  # P
    p_max = Dimension(155 * kgf_cm2, unit="kgf/cm2")  # gauge
    bore = Dimension(8 * cm, unit="mm")  # D
    k_m = Dimension(0.85)  # mechanical efficiency
    k_g = Dimension(0.95)  # hydraulic efficiency

    load = Weight(G, mass=weight / g0)
    lift = Cylinder(A, B, bore=bore, rod=45 * mm)  # of the rods that ISO 3320 has for this bore
    circuit = LiftCircuit(lift, pressure=p_max, mechanical_efficiency=k_m, hydraulic_efficiency=k_g)

    def __init__(self, **dimensions: Any) -> None:
        """Set the design [SI]; DefinitionError also for a load, pressure or bore not above zero, an efficiency not in (0, 1]."""
        super().__init__(**dimensions)
        for name, held in {"weight": positive, "p_max": positive, "bore": positive, "k_m": efficient, "k_g": efficient}.items():
            held(self[name], name)
        in_pascals(self["p_max"], "p_max")
        CylinderSize(self["bore"], self["lift.rod"])

    def columns(self, motion: Motion) -> list[Column]:
        """Return the worksheet's table, and the rod's forces."""
        circuit, size = self.circuit, self.lift.sized(motion)
        supplied = circuit.pressure_for(motion)
        return [
            Column("S", motion.strokes["S"], "m", request="S"),
            *(Column(name, motion[name], "deg", 3, name) for name in ("FIS", "FI3", "FI", "FIS1")),
            *(Column(f"{point}_{axis}", getattr(motion, axis)(point), "m", 3, Coordinate(point, axis)) for point in "BG" for axis in "xy"),
            Column("DFI3", motion.ratio("FI3"), "rad/m", 3, ratio("FI3")),
            Column("I", motion.ratio("G")[1], "", 3, ratio(y("G"))),
            Column("PI", self.lift.thrust(motion), "kgf", 0, thrust("lift")),
            Column("PI/k_m", circuit.rod_force(motion), "kgf", 0),
            Column("F", supplied * size.area, "kgf", 0),
            Column("pd", supplied, "kgf/cm2", 3, pressure("lift")),
            Column("kz", circuit.reserve(motion), "", 3, reserve("lift")),
        ]

    def formulas(self, written: Formulas) -> None:
        """Write the worksheet's forces and pressures: P I is the rod's force without friction."""
        (thrust, k_m, k_g), p_max = (written.thrust("lift"), written.inputs["k_m"], written.inputs["k_g"]), written.inputs["p_max"]
        if thrust is not None:
            area = written.line("SS", written.pi * written.inputs["bore"] ** 2 / 4.0, "cm2")
            written.line("F_max", k_g * p_max * area, "kgf")
            force = written.line("F", thrust / (k_g * k_m), "kgf")
            needed = written.line("pd", force / area, "kgf/cm2")
            written.line("kz", p_max / needed)
        for name, element in self.plan.of_kind(ForceElement).items():
            if name not in ("lift", "circuit"):
                element.formulas(written)

    def featured(self) -> Featured:
        """Return the reserve kz with the 1 that it needs, the supply's pressure with the pump's limit, and the path of G."""
        most = float(self["p_max"])
        limits = {"kz": (1.0, "kz = 1", "below"), "pd": (most, f"p_max = {show(most, 'kgf/cm2', 4)}", "above")}
        return Featured("kz", ["G"], limits)


class LoweredMowerLift(MowerLift):
    """The mower's section let down in five seconds: where it is braked, its mass presses on the cylinder."""

    lowering = Over.path(S=ramp(0.80, 0.55, speed=0.08, acceleration=0.04))
