"""The Peaucellier-Lipkin cell: the first planar linkage to draw an exact straight line.

Source: Peaucellier (1864), Lipkin (1871); Kempe, "How to Draw a Straight Line" (1877). The dimensions are illustrative.
"""

from __future__ import annotations

from linkage import LEFT, RIGHT, Crank, Dimension, Dyad, Featured, Ground, Mechanism, Stroke, deg


class Peaucellier(Mechanism):
    """Two arms OB, OD and the rhombus ABPD invert the circle of crank CA, which passes through O.

    Known for: OA * OP = arm^2 - side^2 at every pose. So P moves along an exactly straight line, at right angles to OC, at
    the distance (arm^2 - side^2) / (2 OC) from O.
    """

    phi = Stroke(-65 * deg, 65 * deg)  # crank angle, rad
    arm = Dimension(0.500)
    side = Dimension(0.200)

    O = Ground(0.0, 0.0)
    C = Ground(0.200, 0.0)

    A = Crank(C, CA=0.200, angle=phi)  # CA = OC: the circle passes through O
    B = Dyad(O, A, OB=arm, AB=side, side=LEFT)
    D = Dyad(O, A, OD=arm, AD=side, side=RIGHT)
    P = Dyad(B, D, BP=side, DP=side, side=LEFT)  # the rhombus's other corner

    about = Featured("P_y", ["A", "P"])
