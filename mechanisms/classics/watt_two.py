"""A six-bar of the Watt II kind: two four-bars in series. The dimensions are illustrative."""

from __future__ import annotations

from math import pi

from linkage import LEFT, Crank, Dyad, Featured, Ground, Mechanism, OnLink, Stroke, angle, deg


class WattTwo(Mechanism):
    """Crank OA swings rocker BCD, which is the input of a second four-bar and swings rocker EF.

    Known for: the rocker's ratio is the product of the two four-bars' ratios; its swing is wider than one alone gives.
    """

    phi = Stroke(0.0, 2 * pi)  # crank angle, rad

    O = Ground(0.0, 0.0)
    C = Ground(0.200, 0.0)
    E = Ground(0.400, 0.0)

    A = Crank(O, OA=0.050, angle=phi)
    B = Dyad(A, C, AB=0.180, CB=0.110, side=LEFT)  # first four-bar
    D = OnLink(C, B, CD=0.120, BCD=-30 * deg)  # the rocker's other arm
    F = Dyad(D, E, DF=0.180, EF=0.100, side=LEFT)  # second four-bar
    P = OnLink(D, F, DP=0.090, FDP=30 * deg)  # a point of the second coupler
    middle = angle(C, B)
    psi = angle(E, F)

    about = Featured("psi", ["D"], coupler="P")
