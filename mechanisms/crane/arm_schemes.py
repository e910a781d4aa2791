"""Cranes with the other drives of the arm: by a bell crank, figure 2.13 b, or straight on the arm, figures 2.13 c and d."""

from __future__ import annotations

import numpy as np

from hydraulics import Cylinder
from linkage import LEFT, Dimension, OnLink, Over, Stroke, deg, mm
from linkage.quantities import Function

from .machine import Crane


class BellCrankCrane(Crane):
    """The arm's cylinder turns a bell crank, figure 2.13 b: it ends at Z, arm_r8 from V, the crank's third side NZ is arm_r7.

    Its arm drive is that of least weight for the crane's duty, `design_crane(scheme="b")`. Four of its rules fail as they do for `Crane`:
    the source leaves buckling out, and the boom's cylinder, of its series, is chosen for level ground.
    """

    arm_r1, arm_r2 = Dimension(0.32124871436223784, unit="m"), Dimension(0.31552816662713545, unit="m")
    arm_r3, arm_r4 = Dimension(0.14499320871947716, unit="m"), Dimension(0.15071375645457907, unit="m")
    arm_r5 = Dimension(1.8608284013518728, unit="m")
    arm_r7, arm_r8 = Dimension(0.3940597365867733, unit="m"), Dimension(0.6689540165284301, unit="m")
    lug = Dimension(97.27716826015583 * deg, unit="deg")
    Z = OnLink("V", "N", VZ=arm_r8, NZ=arm_r7, side=LEFT)
    fold = Cylinder("C", Z, bore=140 * mm, rod=80 * mm, works="both", closed=1.36815290, stroke=0.94415301)


class DirectCrane(Crane):
    """The arm's cylinder CE works straight on the arm from under the boom, figure 2.13 c, and opens it while it grows.

    C lies arm_r2 from J towards O and arm_r1 under the boom, E arm_r3 along the arm and arm_r4 on its inner side. It folds to psi_0
    alone: the tip stays outside the guard (2.13), and the arm does not hang upright over the stakes (2.11).
    """

    reading = ">="
    psi = Stroke(60 * deg, 180 * deg)
    psi_0 = Dimension(60 * deg, unit="deg")
    arm_r1, arm_r2 = Dimension(0.4492148181122634, unit="m"), Dimension(1.6781651004411702, unit="m")
    arm_r3, arm_r4 = Dimension(0.4416710513890326, unit="m"), Dimension(0.2376687576625114, unit="m")
    arm_r5 = arm_r6 = lug = bend = V = N = None  # type: ignore[assignment]
    U = OnLink("J", "O", JU=arm_r2)
    C = OnLink(U, "J", UC=arm_r1, JUC=-90 * deg)
    E = OnLink("J", "K", JE=np.sqrt(arm_r3**2 + arm_r4**2), KJE=-Function("arctan2", arm_r4, arm_r3))
    fold = Cylinder(C, E, bore=125 * mm, rod=70 * mm, works="both", closed=1.26518273, stroke=0.86518275)
    loading = Over.path(
        phi=["phi_k", "phi_0", "phi_0", "phi_0"], psi=["psi_k", "psi_k", "psi_k", psi_0], t=["l_t", "l_t", 0.0, 0.0],
        cases=["lifting", "side_slope"],
    )  # fmt: skip


class DirectCraneAbove(DirectCrane):
    """The same from above the boom, figure 2.13 d: the cylinder folds the arm while it grows.

    arm_r1 is above the boom, arm_r4 on the arm's outer side; E may lie behind J, arm_r3 below zero.
    """

    arm_r1, arm_r2 = Dimension(0.2750521935589255, unit="m"), Dimension(2.1023482347921223, unit="m")
    arm_r3, arm_r4 = Dimension(-0.5539127439490062, unit="m"), Dimension(0.37390717774539667, unit="m")
    C = OnLink("U", "J", UC=arm_r1, JUC=90 * deg)
    E = OnLink("J", "K", JE=np.sqrt(arm_r3**2 + arm_r4**2), KJE=Function("arctan2", arm_r4, arm_r3))
    fold = Cylinder(C, E, bore=125 * mm, rod=70 * mm, works="both", closed=1.55158782, stroke=1.15158784)
