"""The drives: a cylinder from the column lifts the boom; one on the boom turns the arm, over a lever and a coupler or straight away.

Source: Syunyov, Seliverstov, Gerasimov, Sokolov, "Lesosechnye mashiny v fokuse bioenergetiki", (2.19) to (2.66).
"""

from __future__ import annotations

from typing import Any, ClassVar

import numpy as np

from hydraulics import Cylinder, LiftCircuit
from linkage import LEFT, RIGHT, Column, CosineAngle, Crank, Dyad, Featured, Ground, Mechanism, Motion, MPa, OnLink, Over, Verdict, deg, mm
from linkage.loads import LoadCase, Moment
from linkage.quantities import Dimension, Function, Quantity, Stroke, angle, distance, ref
from linkage.steps import Point

from .drive_report import drive_columns, drive_verdicts, featured_drive
from .duty import clipped


class Drive(Mechanism):
    """The base of drives: their cylinder, its pressure and its efficiency."""

    joint: ClassVar[str]
    """The stroke that its joint turns by."""

    D = Dimension(125 * mm, unit="mm")  # bore
    d = Dimension(70 * mm, unit="mm")  # rod
    S = Dimension(0.8850545905614509, unit="mm")  # stroke of the cylinder
    p = Dimension(22 * MPa, unit="bar")  # gauge
    n = Dimension(0.95)  # efficiency
    f_0 = Dimension(200 * mm, unit="mm")  # closed length less stroke, for a bore of zero
    f_1 = Dimension(1.6)  # and by how much of the bore it grows
    l = S + f_0 + f_1 * D  # length of the closed cylinder

    def working(self, count: int = 101) -> Motion:
        """Return the motion over the range that it works in, at `count` poses.

        Parameters
        ----------
        count : int, optional
            The number of poses.

        Returns
        -------
        Motion
            The motion.
        """
        strokes: dict[str, Any] = {self.joint: np.linspace(self[f"{self.joint}_0"], self[f"{self.joint}_k"], count)}
        return self.at(**strokes)

    def columns(self, motion: Motion) -> list[Column]:
        """Return angle, length, lever, and the moments asked for and given; of a drive by its cylinder all it has."""
        return drive_columns(motion) if self.joint in motion.strokes else super().columns(motion)

    def featured(self) -> Featured:
        """Return the drive's surplus of moment in each movement, which may not fall below zero; else its angle."""
        return featured_drive(self.joint) if self.joint in self.strokes else Featured(self.joint, ["T"])

    def rules(self, motion: Motion) -> list[Verdict]:
        """Return whether the drive carries what turns over a motion that its angle drives."""
        return drive_verdicts(motion) if self.joint in motion.strokes else []


class BoomDrive(Drive):
    """Cylinder AB from the column's pin A = (r_1, -r_2) to the boom's pin B, r_3 along the boom and r_4 below its axis.

    O is the boom's hinge. phi is the boom's angle from the upward vertical, as in the source: 0 up, 90 deg level; the cylinder grows
    while phi falls. M_l is the bound of moments (2.19) to (2.21) by its coefficients: K_B of sin(phi) for the boom itself, K_A of the
    arm, which lies level while phi is below psi_k - 90 deg and cannot rise so far beyond. What the cylinder balances is
    M_g = F p n h (2.29), h = -d(AB)/d(phi) its lever. The cylinder is S + f_0 + f_1 D long closed, (2.36).
    """

    joint: ClassVar[str] = "phi"
    phi = Stroke(15 * deg, 99.9262455066517 * deg)
    lifts = 0.25 * np.pi * ref("p") * ref("n") * ref("D") ** 2  # what it gives, F p n, N

    r_1 = Dimension(0.2618294, unit="mm")
    r_2 = Dimension(1.6706883884436237, unit="mm")
    r_3 = Dimension(0.5925163333637224, unit="mm")
    r_4 = Dimension(0.31633579788198307, unit="mm")
    l_c = Dimension(4.454601406907623, unit="mm")  # length of the boom

    O = Ground(0.0, 0.0)
    A = Ground(r_1, -r_2)
    P = Crank(O, OP=l_c, angle=90 * deg - phi)  # the arm's hinge
    N = OnLink(O, P, ON=r_3)  # foot of the lug
    B = OnLink(N, O, NB=r_4, ONB=90 * deg)

    length = distance(A, B)

    K_B = Dimension(85260.01232735414, unit="Nm")
    K_A = Dimension(71905.17119002105, unit="Nm")
    phi_0 = Dimension(15 * deg, unit="deg")  # the range it works in
    phi_k = Dimension(99.9262455066517 * deg, unit="deg")
    psi_k = Dimension(180 * deg, unit="deg")  # greatest angle between boom and arm
    M_l = K_B * np.sin(phi) + K_A * np.sin(psi_k - clipped(phi, psi_k - 90 * deg))

    load = Moment("O P", M=-M_l)  # it turns the boom down, clockwise
    lift = Cylinder(A, B, bore="D", rod="d", closed="l", stroke="S")
    circuit = LiftCircuit(lift, pressure="p", mechanical_efficiency="n")
    raising = Over(phi=("phi_0", "phi_k"))

    def columns(self, motion: Motion) -> list[Column]:
        """Return angle, length, lever, and the moments asked for and given; what its cylinder has is among them."""
        return drive_columns(motion)


# -- the arm's -------------------------------------------------------------------------------------------------

class DrivenArm(Drive):
    """An arm PT on the boom, the required moments about its hinge P, and the cylinder of its drive.

    Drawn on the boom: x leads towards its end, y away from the side that the arm folds to. psi is the angle between boom and arm. It is
    0 folded back and 180 deg straight, as in the source. M_l1, M_l2 are the bounds of moments (2.39) to (2.43), positive where a moment
    is asked for that opens the arm. M_l1 is with the telescope in, while the arm folds; M_l2 with it out, while it opens. `folds` and
    `opens` are the forces that the cylinder then gives, F p n, positive where it pushes.
    """

    joint: ClassVar[str] = "psi"
    opens_by_piston: ClassVar[bool] = False  # the side of its cylinder that opens the arm
    psi: Quantity = Stroke(0.0, 180 * deg)

    D = Dimension(140 * mm, unit="mm")  # bore
    d = Dimension(80 * mm, unit="mm")  # rod
    S = Dimension(0.926744269401061, unit="mm")  # stroke of the cylinder
    push = 0.25 * np.pi * ref("p") * ref("n") * D**2  # what its sides give, N
    pull = 0.25 * np.pi * ref("p") * ref("n") * (D**2 - d**2)

    wall = Dimension(5 * mm, unit="mm")  # of the barrel
    head = Dimension(20 * mm, unit="mm")  # thickness of its end
    eye_width = Dimension(0.50)  # B, l_2 and d_1 of an eye, over the bore
    eye_radius = Dimension(0.50)
    eye_hole = Dimension(0.45)
    eyes = Dimension(1.0)  # as many as (2.60) counts; a cylinder has two
    eye = eye_width * (4.0 * eye_radius**2 - eye_hole**2) * D**3
    barrel = S * (d**2 + 4.0 * wall * (D + wall)) + head * D**2
    cylinder_steel = 0.25 * np.pi * (barrel + eyes * eye)  # m3
    steel: Quantity = cylinder_steel + 0.0  # of all that is the drive's own, m3 (2.60)
    mass = 7800.0 * steel  # kg

    psi_0 = Dimension(0.0, unit="deg")  # psi of the folded arm
    psi_k = Dimension(180 * deg, unit="deg")  # and of the straight one
    l_p = Dimension(3.165204914008807, unit="mm")  # length of the arm

    P = Ground(0.0, 0.0)
    T: Point = Crank(P, PT=l_p, angle=psi - 180 * deg)  # the arm's end

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
    unfolding = Over(psi=("psi_0", "psi_k"), cases=["case_1", "case_2"])  # one moment at a time, (2.39)


class ArmDrive(DrivenArm):
    """Cylinder CL turns the lever OL (r_1), the coupler LN (r_2) the arm's lug PN (r_3): fig. 2.13 a.

    O is the lever's pivot and the origin, P lies r_4 from it. C lies r_5 towards the boom's root and r_6 above it, on the part that is
    bent by delta. The cylinder's growth folds the arm. The drive gives M_g = F p n h I (2.44), (2.52), h the cylinder's lever about O
    and I = d(alpha_1)/d(alpha_2): h I = -d(CL)/d(psi). `steel` is the volume of (2.60), `mass` its mass.
    """

    r_1 = Dimension(0.5634824610356947, unit="mm")
    r_2 = Dimension(0.5056991910045654, unit="mm")
    r_3 = Dimension(0.20803265972531704, unit="mm")
    r_4 = Dimension(0.13215746111972135, unit="mm")
    r_5 = Dimension(1.7535661783335663, unit="mm")
    r_6 = Dimension(150 * mm, unit="mm")
    delta = Dimension(0.0, unit="deg")  # bend of the boom, its front part down
    alpha_20 = Dimension(-66.73074343448614 * deg, unit="deg")  # direction of the lug of the folded arm
    alpha_2: Quantity = alpha_20 + ref("psi") - ref("psi_0")

    O = Ground(0.0, 0.0)
    P = Ground(r_4, 0.0)
    C = Ground(-r_5 * np.cos(delta) - r_6 * np.sin(delta), r_6 * np.cos(delta) - r_5 * np.sin(delta))
    N: Point = OnLink(P, "T", PN=r_3, TPN=alpha_20 - ref("psi_0") + 180 * deg)
    L: Point = Dyad(O, N, OL=r_1, NL=r_2, side=LEFT)

    alpha_1 = angle(O, L)
    mu = CosineAngle(r_2, r_3, distance(L, P))  # transmission angle of coupler and lug
    length = distance(C, L)
    gamma = CosineAngle(distance(O, C), r_1, length)

    section = Dimension(2700 * mm**2)  # of lever and coupler, m2
    steel = section * (r_1 + r_2) + ref("cylinder_steel")

    folds, opens = ref("push"), -ref("pull")
    fold = Cylinder(C, L, bore="D", rod="d", works="both", closed="l", stroke="S")
    circuit = LiftCircuit(fold, pressure="p", mechanical_efficiency="n")


class ArmDriveByCylinder(ArmDrive):
    """The same drive, driven by its cylinder: k from 1, out, to 0, drawn in; psi follows."""

    k = Stroke(1.0, 0.0)
    L: Point = Dyad("C", "O", CL=ref("l") + k * ref("S"), OL="r_1", side=LEFT)
    N = Dyad(L, "P", NL="r_2", PN="r_3", side=LEFT)
    T = OnLink("P", N, PT="l_p", NPT=ref("psi_0") - ref("alpha_20") - 180 * deg)
    alpha_2 = angle("P", N)
    psi = alpha_2 - ref("alpha_20") + ref("psi_0")
    unfolding = Over(cases=["case_1", "case_2"])


class BellCrankArmDrive(ArmDrive):
    """The cylinder CZ turns a bell crank OLZ with the sides r_1, r_8 and the third side r_7: fig. 2.13 b; the source's example.

    (2.60) counts no bell crank. Here its three sides are bars of half the section of a lever: it weighs what a lever of half its perimeter
    does, which is the lever of fig. 2.13 a where Z falls on L.
    """

    psi: Quantity = Stroke(0.0, 170.93262957316685 * deg)
    psi_k = Dimension(170.93262957316685 * deg, unit="deg")
    S = Dimension(0.900, unit="mm")
    r_1 = Dimension(0.50, unit="mm")
    r_2 = Dimension(0.50, unit="mm")
    r_3 = Dimension(0.23, unit="mm")
    r_4 = Dimension(0.15, unit="mm")
    r_5 = Dimension(1.75, unit="mm")
    r_6 = Dimension(0.20, unit="mm")
    r_7: Quantity = Dimension(0.22, unit="mm")
    r_8 = Dimension(0.56, unit="mm")
    delta = Dimension(12 * deg, unit="deg")
    alpha_20 = Dimension(-82.2365727085356 * deg, unit="deg")

    steel = ref("section") * (0.5 * (r_1 + r_7 + r_8) + r_2) + ref("cylinder_steel")

    Z: Point = OnLink("O", "L", OZ=r_8, LZ=r_7, side=LEFT)
    length = distance("C", Z)
    gamma = CosineAngle(distance("O", "C"), r_8, length)
    fold = Cylinder("C", Z, bore="D", rod="d", works="both", closed="l", stroke="S")


class BellCrankArmDriveByCylinder(ArmDriveByCylinder, BellCrankArmDrive):
    """The same drive, driven by its cylinder: k from 1, out, to 0, drawn in; psi follows."""

    Z = Dyad("C", "O", CZ=ref("l") + ref("k") * ref("S"), OZ="r_8", side=LEFT)
    L = OnLink("O", Z, OL="r_1", ZL="r_7", side=RIGHT)


class AngledBellCrankArmDrive(BellCrankArmDrive):
    """The same with the crank's angle LOZ in the place of its third side r_7, which follows."""

    psi: Quantity = Stroke(0.0, 180 * deg)
    crank = Dimension(23.07391806563097 * deg, unit="deg")
    r_7: Quantity = np.sqrt(ref("r_1") ** 2 + ref("r_8") ** 2 - 2.0 * ref("r_1") * ref("r_8") * np.cos(crank))
    Z = OnLink("O", "L", OZ="r_8", LOZ=crank)


class DirectArmDrive(DrivenArm):
    """Cylinder AB under the boom turns the arm without a four-bar, its growth opens it: fig. 2.13 c, by the boom's formulas (2.30).

    A lies r_2 from P towards the boom's root and r_1 below it; B r_3 along the arm and r_4 on its inner side. With phi = 180 deg - psi it
    is the boom's drive, with column and boom instead of boom and arm.
    """

    opens_by_piston: ClassVar[bool] = True
    psi = Stroke(60 * deg, 180 * deg)
    psi_0 = Dimension(60 * deg, unit="deg")
    D = Dimension(125 * mm, unit="mm")
    d = Dimension(70 * mm, unit="mm")
    S = Dimension(0.8870639834735008, unit="mm")
    r_1 = Dimension(0.45, unit="mm")
    r_2 = Dimension(1.7124415946523257, unit="mm")
    r_3 = Dimension(0.452, unit="mm")
    r_4 = Dimension(0.245, unit="mm")

    A = Ground(-r_2, -r_1)
    B = OnLink("P", "T", PB=np.sqrt(r_3**2 + r_4**2), TPB=-Function("arctan2", r_4, r_3))

    length = distance("A", "B")

    folds, opens = -ref("pull"), ref("push")
    fold = Cylinder("A", "B", bore="D", rod="d", works="both", closed="l", stroke="S")
    circuit = LiftCircuit(fold, pressure="p", mechanical_efficiency="n")


class DirectArmDriveAbove(DirectArmDrive):
    """The same above the boom, its growth folds the arm: fig. 2.13 d. r_1 is above the boom, r_4 on the arm's outer side.

    B may lie behind the arm's hinge, r_3 below zero.
    """

    opens_by_piston: ClassVar[bool] = False
    D = Dimension(140 * mm, unit="mm")
    d = Dimension(80 * mm, unit="mm")
    S = Dimension(0.9639376633275721, unit="mm")
    r_1 = Dimension(0.284, unit="mm")
    r_2 = Dimension(1.8423319564124518, unit="mm")
    r_3 = Dimension(-0.455, unit="mm")
    r_4 = Dimension(0.325, unit="mm")

    A = Ground(-ref("r_2"), "r_1")
    B = OnLink("P", "T", PB=np.sqrt(ref("r_3") ** 2 + ref("r_4") ** 2), TPB=Function("arctan2", ref("r_4"), ref("r_3")))
    folds, opens = ref("push"), -ref("pull")
