"""Roberts's straight-line linkage.

Source: Richard Roberts (19th century); Kempe, "How to Draw a Straight Line" (1877). The lengths of the arms are
illustrative, the proportions are Roberts's: coupler half the frame, four equal arms.
"""

from __future__ import annotations

from linkage import LEFT, RIGHT, Crank, Dimension, Dyad, Featured, Ground, Mechanism, OnLink, Stroke, deg


class Roberts(Mechanism):
    """Arms AC and BD swing the triangle CPD, whose point P runs along the frame line AB.

    Known for: P lies on AB exactly at A, at B and half-way, and within a hundredth of AB in between; longer arms make it straighter.
    """

    phi = Stroke(33.56 * deg, 82.80 * deg)  # arm AC, rad: P runs from B to A
    arm = Dimension(0.600)  # AC, BD, CP and DP

    A = Ground(0.0, 0.0)
    B = Ground(1.000, 0.0)

    C = Crank(A, AC=arm, angle=phi)
    D = Dyad(C, B, CD=0.500, BD=arm, side=LEFT)
    P = OnLink(C, D, CP=arm, DP=arm, side=RIGHT)

    about = Featured("P_y", ["P"])
