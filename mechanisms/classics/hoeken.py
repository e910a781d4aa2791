"""The Hoeken (Hoecken) straight-line linkage.

Source: Hoecken (1926); the proportions 1 : 2 : 2.5 are the classical ones, see Norton, "Design of Machinery", chapter 3.
"""

from __future__ import annotations

from math import pi

from linkage import LEFT, Crank, Dyad, Featured, Ground, Mechanism, OnLink, Stroke


class Hoeken(Mechanism):
    """Crank OA, frame OC twice as long, coupler AB = rocker CB = BP 2.5 times as long: P is the coupler's far end.

    Known for: over half a turn of the crank P runs along a nearly straight line at nearly constant speed, straight to
    within 0.25 % of its length. It is a cognate of Chebyshev's linkage.
    """

    phi = Stroke(0.0, 2 * pi)  # crank angle, rad

    O = Ground(0.0, 0.0)
    C = Ground(0.200, 0.0)

    A = Crank(O, OA=0.100, angle=phi)
    B = Dyad(A, C, AB=0.250, CB=0.250, side=LEFT)
    P = OnLink(A, B, AP=0.500)

    about = Featured("P_y", ["P"])
