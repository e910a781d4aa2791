"""Hart's inversor: an exact straight line with five moving links.

Source: Hart, "On certain conversions of motion" (1874); Kempe, "How to Draw a Straight Line" (1877). The dimensions are
illustrative.
"""

from __future__ import annotations

from linkage import LEFT, Crank, Dimension, Dyad, Featured, Ground, Mechanism, OnLink, Stroke, deg


class Hart(Mechanism):
    """Antiparallelogram ABCD: O, P and Q divide AB, AD and CB in one proportion m and stay in line, parallel to AC.

    Known for: OP * OQ = m (1 - m) (AD^2 - AB^2) at every pose. So Q moves along an exactly straight line where P runs on a
    circle through the fixed point O.
    """

    phi = Stroke(-55 * deg, 55 * deg)  # crank angle, rad
    short = Dimension(0.200)  # AB and CD
    long = Dimension(0.500)  # AD and CB
    m = Dimension(0.45)  # AO / AB

    O = Ground(0.0, 0.0)
    E = Ground(0.080, 0.0)

    P = Crank(E, EP=0.080, angle=phi)  # EP = OE: the circle passes through O
    A = Dyad(O, P, OA=m * short, AP=m * long, side=LEFT)
    B = OnLink(A, O, AB=short)
    D = OnLink(A, P, AD=long)
    C = Dyad(B, D, CB=long, CD=short, side=LEFT)  # crossed, not the parallelogram
    Q = OnLink(C, B, CQ=m * long)

    about = Featured("Q_y", ["P", "Q"])
