"""Machines that several files of tests build on: each adds the cylinders, circuits and load cases that it asks about."""

from linkage import LEFT, RIGHT, Dyad, Ground, Mechanism, OnLink, Stroke, Weight, angle, deg


class BoomArm(Mechanism):
    """A boom lifted from below, with a weight at its tip."""

    S = Stroke(0.0, 0.25)
    A = Ground(0.0, 0.0)
    O = Ground(0.6, 0.1)
    B = Dyad(A, O, AB=0.5 + S, OB=0.3, side=RIGHT)
    G = OnLink(O, B, OG=0.8, BOG=100 * deg, side=LEFT)
    tilt = angle(O, G)
    load = Weight(G, mass=500)


class GrabArms(Mechanism):
    """A boom and a jib, each with a stroke of its own, and a weight at the tip."""

    S, T = Stroke(0.0, 0.25), Stroke(0.0, 0.3)
    A, O = Ground(0.2, -0.4), Ground(0.0, 0.0)
    B = Dyad(A, O, AB=0.65 + S, OB=0.6, side=RIGHT)
    C = OnLink(O, B, OC=1.5)
    D = OnLink(O, B, OD=0.9, BOD=20 * deg)
    H = Dyad(D, C, DH=0.5 + T, CH=0.3, side=LEFT)
    P = OnLink(C, H, CP=1.2, HCP=-150 * deg)
    load = Weight(P, mass=300.0)
