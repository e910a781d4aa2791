"""Theo Jansen's leg.

Source: Theo Jansen, "The Great Pretender" (2007): the eleven "holy numbers" of the Strandbeest and its crank, here in m
for Jansen's units of 10 mm. His letters a to m stand beside the links.
"""

from __future__ import annotations

from math import pi

from linkage import LEFT, RIGHT, Crank, Dyad, Featured, Ground, Mechanism, Stroke


class Jansen(Mechanism):
    """Crank OX moves the leg of two triangles BCD and EFG, with foot F, through the rods XC and XE.

    Known for: a foot path that is flat while the foot stands and lifts it for the way back; the body rides level.
    """

    phi = Stroke(0.0, 2 * pi)  # crank angle, rad

    O = Ground(0.0, 0.0)
    B = Ground(-0.380, -0.078)  # a, l

    X = Crank(O, OX=0.150, angle=phi)  # m
    C = Dyad(X, B, XC=0.500, BC=0.415, side=RIGHT)  # j, b
    D = Dyad(B, C, BD=0.401, CD=0.558, side=LEFT)  # d, e
    E = Dyad(X, B, XE=0.619, BE=0.393, side=LEFT)  # k, c
    G = Dyad(D, E, DG=0.394, EG=0.367, side=RIGHT)  # f, g
    F = Dyad(G, E, GF=0.657, EF=0.490, side=RIGHT)  # h, i

    about = Featured("F_y", ["F"])
