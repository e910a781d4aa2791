"""A six-bar of the Stephenson I kind. The dimensions are illustrative."""

from __future__ import annotations

from math import pi

from linkage import LEFT, RIGHT, Crank, Dyad, Featured, Ground, Mechanism, OnLink, Stroke, angle, deg


class StephensonOne(Mechanism):
    """Both ternary links hang from the frame: crank AOD and rocker BCE, joined by the coupler AB and by the rods DF, EF.

    Known for: F is the joint of a second chain that both ternary links drive; its curve encloses more shapes than a
    four-bar's coupler curve.
    """

    phi = Stroke(0.0, 2 * pi)  # crank angle, rad

    O = Ground(0.0, 0.0)
    C = Ground(0.100, 0.0)

    A = Crank(O, OA=0.040, angle=phi)
    D = OnLink(O, A, OD=0.030, AOD=90 * deg)
    B = Dyad(A, C, AB=0.120, CB=0.080, side=LEFT)
    E = OnLink(C, B, CE=0.060, BE=0.050, side=RIGHT)
    F = Dyad(D, E, DF=0.140, EF=0.090, side=RIGHT)
    P = OnLink(D, F, DP=0.070, FDP=30 * deg)  # a point of the rod DF
    reach = angle(O, F)

    about = Featured("reach", ["F"], coupler="P")
