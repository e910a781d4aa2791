"""The boom's drive: a cylinder from the column lifts the boom.

Source: Syunyov, Seliverstov, Gerasimov, Sokolov, "Lesosechnye mashiny v fokuse bioenergetiki", (2.19) to (2.37).
"""

from __future__ import annotations

import numpy as np

from hydraulics import Cylinder, LiftCircuit
from linkage import Column, Crank, Dimension, Featured, Ground, Mechanism, Moment, Motion, MPa, OnLink, Over, Stroke, deg, distance, mm
from linkage.verdict import Verdict

from .drive_duty import clipped
from .drive_report import drive_columns, drive_verdicts, featured_drive


class BoomDrive(Mechanism):
    """Cylinder AB from the column's pin A = (r_1, -r_2) to the boom's pin B, r_3 along the boom and r_4 below its axis.

    O is the boom's hinge. phi is the boom's angle from the upward vertical, as in the source: 0 up, 90 deg level; the cylinder grows
    while phi falls. M_l is the bound of moments (2.19) to (2.21) by its coefficients: K_B of sin(phi) for the boom itself, K_A of the
    arm, which lies level while phi is below psi_k - 90 deg and cannot rise so far beyond. What the cylinder balances is
    M_g = F p n h (2.29), h = -d(AB)/d(phi) its lever. The cylinder is S + f_0 + f_1 D long closed, (2.36).
    """

    phi = Stroke(15 * deg, 99.9262455066517 * deg)

    D = Dimension(125 * mm, unit="mm")  # bore
    d = Dimension(70 * mm, unit="mm")  # rod
    S = Dimension(0.8850545905614509, unit="mm")  # stroke of the cylinder
    p = Dimension(22 * MPa, unit="bar")  # gauge
    n = Dimension(0.95)  # efficiency
    f_0 = Dimension(200 * mm, unit="mm")  # closed length less stroke, for a bore of zero
    f_1 = Dimension(1.6)  # and by how much of the bore it grows
    l = S + f_0 + f_1 * D  # length of the closed cylinder
    lifts = 0.25 * np.pi * p * n * D**2  # what it gives, F p n, N

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
    lift = Cylinder(A, B, bore=D, rod=d, closed=l, stroke=S)
    circuit = LiftCircuit(lift, pressure=p, mechanical_efficiency=n)
    raising = Over(phi=("phi_0", "phi_k"))

    def working(self, count: int = 101) -> Motion:
        """Return the motion from phi_0 to phi_k, at `count` poses."""
        return self.at(phi=np.linspace(self["phi_0"], self["phi_k"], count))

    def columns(self, motion: Motion) -> list[Column]:
        """Return angle, length, lever, and the moments asked for and given."""
        return drive_columns(motion)

    def featured(self) -> Featured:
        """Return what the drive has over the moment asked for, which may not fall below zero."""
        return featured_drive("lifting")

    def rules(self, motion: Motion) -> list[Verdict]:
        """Return whether the drive carries the boom over a motion."""
        return drive_verdicts(motion)
