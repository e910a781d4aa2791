"""The arm's drive: a cylinder on the boom turns a lever, a coupler turns the arm.

Source: Syunyov, Seliverstov, Gerasimov, Sokolov, "Lesosechnye mashiny v fokuse bioenergetiki", (2.38) to (2.66).
"""

from __future__ import annotations

import numpy as np

from hydraulics import Cylinder, LiftCircuit
from linkage import (
    LEFT,
    Column,
    CosineAngle,
    Crank,
    Dimension,
    Dyad,
    Ground,
    LoadCase,
    Mechanism,
    Moment,
    Motion,
    MPa,
    OnLink,
    Stroke,
    angle,
    deg,
    distance,
    mm,
)

from .drive_duty import clipped
from .drive_report import drive_columns, drive_verdicts


class ArmDrive(Mechanism):
    """Cylinder CL turns the lever OL (r_1), the coupler LN (r_2) the arm's lug PN (r_3): fig. 2.13 a.

    Drawn on the boom: O is the lever's pivot, x leads from it to the arm's hinge P, y away from the arm. C lies r_5 towards the boom's
    root and r_6 above it, on the part that is bent by delta. psi is the angle between boom and arm, as in the source: 0 folded back,
    180 deg straight. The cylinder's growth folds the arm.

    M_l1, M_l2 are the bounds of moments about P (2.39) to (2.43), positive where a moment is asked for that opens the arm: M_l1 with
    the telescope in, against the piston side; M_l2 with the telescope out, against the rod side. The drive gives M_g = F p n h I
    (2.44), (2.52), h the cylinder's lever about O and I = d(alpha_1)/d(alpha_2): h I = -d(CL)/d(psi). `steel` is the volume (2.60).
    """

    psi = Stroke(0.0, 180 * deg)

    D = Dimension(140 * mm, unit="mm")  # bore
    d = Dimension(80 * mm, unit="mm")  # rod
    S = Dimension(0.926744269401061, unit="mm")  # stroke of the cylinder
    p = Dimension(22 * MPa, unit="bar")  # gauge
    n = Dimension(0.95)  # efficiency
    f_0 = Dimension(200 * mm, unit="mm")  # closed length less stroke, of a bore of none
    f_1 = Dimension(1.6)  # and by how much of the bore it grows
    l = S + f_0 + f_1 * D  # length of the closed cylinder

    r_1 = Dimension(0.5634824610356947, unit="mm")
    r_2 = Dimension(0.5056991910045654, unit="mm")
    r_3 = Dimension(0.20803265972531704, unit="mm")
    r_4 = Dimension(0.13215746111972135, unit="mm")
    r_5 = Dimension(1.7535661783335663, unit="mm")
    r_6 = Dimension(150 * mm, unit="mm")
    delta = Dimension(0.0, unit="deg")  # bend of the boom, its front part down
    psi_0 = Dimension(0.0, unit="deg")  # psi of the folded arm
    psi_k = Dimension(180 * deg, unit="deg")  # and of the straight one
    alpha_20 = Dimension(-66.73074343448614 * deg, unit="deg")  # direction of the lug there
    l_p = Dimension(3.165204914008807, unit="mm")  # length of the arm

    O = Ground(0.0, 0.0)
    P = Ground(r_4, 0.0)
    C = Ground(-r_5 * np.cos(delta) - r_6 * np.sin(delta), r_6 * np.cos(delta) - r_5 * np.sin(delta))
    T = Crank(P, PT=l_p, angle=psi - 180 * deg)  # the arm's end
    N = OnLink(P, T, PN=r_3, TPN=alpha_20 - psi_0 + 180 * deg)
    L = Dyad(O, N, OL=r_1, NL=r_2, side=LEFT)

    alpha_1 = angle(O, L)
    alpha_2 = alpha_20 + psi - psi_0
    length = distance(C, L)
    gamma = CosineAngle(distance(O, C), r_1, length)

    section = Dimension(2700 * mm**2)  # of lever and coupler, m2
    wall = Dimension(5 * mm, unit="mm")  # of the barrel
    head = Dimension(20 * mm, unit="mm")  # thickness of its end
    eye_width = Dimension(0.50)  # B, l_2 and d_1 of an eye, over the bore
    eye_radius = Dimension(0.50)
    eye_hole = Dimension(0.45)
    eyes = Dimension(1.0)  # as many as (2.60) counts; a cylinder has two
    barrel = S * (d**2 + 4.0 * wall * (D + wall)) + head * D**2 + eyes * eye_width * D * (4.0 * eye_radius**2 - eye_hole**2) * D**2
    steel = section * (r_1 + r_2) + 0.25 * np.pi * barrel  # volume, m3
    mass = 7800.0 * steel  # kg
    mu = CosineAngle(r_2, r_3, distance(L, P))  # transmission angle of coupler and lug

    K_A = Dimension(71905.17119002105, unit="Nm")
    K_A1 = Dimension(39947.317327789475, unit="Nm")
    phi_0 = Dimension(15 * deg, unit="deg")
    phi_k = Dimension(99.9262455066517 * deg, unit="deg")
    M_l1 = -K_A1 * np.sin(clipped(phi_k - psi, 0.0, 90 * deg))
    M_l2 = K_A * np.sin(clipped(psi - phi_0, 0.0, 90 * deg))

    outward = Moment("P T", M=-M_l1)
    inward = Moment("P T", M=-M_l2)
    case_1 = LoadCase("telescope in", only=[outward])
    case_2 = LoadCase("telescope out", only=[inward])
    fold = Cylinder(C, L, bore=D, rod=d, works="both")
    circuit = LiftCircuit(fold, pressure=p, mechanical_efficiency=n)

    def working(self, count: int = 101) -> Motion:
        """Return the motion from psi_0 to psi_k, at `count` poses."""
        return self.at(psi=np.linspace(self["psi_0"], self["psi_k"], count))

    def columns(self, motion: Motion) -> list[Column]:
        """Return angle, length, lever, and the moments asked for and given: folding by the piston side, opening by the rod side."""
        return drive_columns(motion)

    def verdicts(self, motion: Motion) -> list[str]:
        """Return whether the drive carries the arm over a motion, and whether the cylinder is as long as that takes."""
        return drive_verdicts(motion)


class BellCrankArmDrive(ArmDrive):
    """The cylinder CZ turns a bell crank OLZ with the sides r_1, r_8 and the third side r_7: fig. 2.13 b; the source's example."""

    psi = Stroke(0.0, 170.93262957316685 * deg)
    psi_k = Dimension(170.93262957316685 * deg, unit="deg")
    S = Dimension(0.900, unit="mm")
    r_1 = Dimension(0.50, unit="mm")
    r_2 = Dimension(0.50, unit="mm")
    r_3 = Dimension(0.23, unit="mm")
    r_4 = Dimension(0.15, unit="mm")
    r_5 = Dimension(1.75, unit="mm")
    r_6 = Dimension(0.20, unit="mm")
    r_7 = Dimension(0.22, unit="mm")
    r_8 = Dimension(0.56, unit="mm")
    delta = Dimension(12 * deg, unit="deg")
    alpha_20 = Dimension(-82.2365727085356 * deg, unit="deg")

    Z = OnLink("O", "L", OZ=r_8, LZ=r_7, side=LEFT)
    length = distance("C", Z)
    gamma = CosineAngle(distance("O", "C"), r_8, length)
    fold = Cylinder("C", Z, bore="D", rod="d", works="both")
