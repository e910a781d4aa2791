"""Chebyshev's straight-line linkage.

Source: Chebyshev (1850s); the proportions frame 4, rockers 5, coupler 2 are the classical ones, see Artobolevsky,
"Mechanisms in Modern Engineering Design", volume 1.
"""

from __future__ import annotations

from linkage import RIGHT, Crank, Dyad, Featured, Ground, Mechanism, OnLink, Stroke, deg


class Chebyshev(Mechanism):
    """Crossed rockers OA and CB carry the coupler AB, whose middle P draws the line.

    Known for: P stands exactly twice the coupler's length above the frame in the middle, and where a rocker is upright
    above its pivot. Between these it is hardly off that line. Hoeken's linkage is a cognate and draws the same curve.
    """

    phi = Stroke(39 * deg, 88 * deg)  # rocker angle, rad

    O = Ground(0.0, 0.0)
    C = Ground(0.400, 0.0)

    A = Crank(O, OA=0.500, angle=phi)
    B = Dyad(A, C, AB=0.200, CB=0.500, side=RIGHT)
    P = OnLink(A, B, AP=0.100)

    about = Featured("P_y", ["P"])
