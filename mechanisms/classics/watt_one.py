"""James Watt's parallel motion: a six-bar of the Watt I kind.

Source: Watt's patent of 1784; Kennedy, "The Mechanics of Machinery" (1886). The dimensions are illustrative, in the
proportion CF = OM^2 / (OE - OM) that the design asks for.
"""

from __future__ import annotations

from linkage import LEFT, RIGHT, Crank, Dyad, Featured, Ground, Mechanism, OnLink, Stroke, deg


class WattOne(Mechanism):
    """Beam OME, radius rod CF and link MF guide P; the parallelogram MEGF magnifies P's path into the piston's G.

    Known for: G is P enlarged from O by OE / OM, exactly. Both run up and down a nearly straight line. G leaves it by
    less than 1 / 150 of its travel, and by less than 1 / 2000 while the beam swings 10 degrees to either side.
    """

    phi = Stroke(-20 * deg, 20 * deg)  # beam angle, rad

    O = Ground(0.0, 0.0)
    C = Ground(0.900, -0.200)

    M = Crank(O, OM=0.400, angle=phi)  # the beam's middle pin
    E = OnLink(O, M, OE=0.720)  # the beam's end
    F = Dyad(M, C, MF=0.200, CF=0.500, side=RIGHT)  # link and radius rod
    P = OnLink(M, F, MP=0.200 * 0.400 / 0.720)  # the air pump's rod
    G = Dyad(E, F, EG=0.200, FG=0.320, side=LEFT)  # the piston's rod

    about = Featured("G_x", ["P", "G"], coupler="G")
