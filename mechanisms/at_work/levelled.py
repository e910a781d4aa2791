"""A telehandler whose forks oil keeps level: a master cylinder turns them back as far as the boom turns. All figures are illustrative."""

from __future__ import annotations

from math import atan2, hypot, pi

from hydraulics import Cylinder, OilLine
from linkage import LEFT, Dyad, Featured, Ground, LinkMass, LoadCase, OnLink, Outline, Over, Stroke, Weight, angle, deg, mm

from .telehandler import FORK, Telehandler


class LevelledTelehandler(Telehandler):
    """The telehandler with a master cylinder DK behind its boom, both sides of which are joined with those of the forks' cylinder QW.

    As the boom rises it presses the master in, and QW comes out as far and turns the forks back; drawn out they stay as they are.
    """

    tilt = Stroke(-0.05, 0.05)  # m, by which a valve moves the forks' cylinder beside that
    forks = None  # type: ignore[assignment]
    D = Ground(-3.20, 0.75)
    K = OnLink("O", "B", OK=0.28, BOK=141 * deg)
    W = Dyad("Q", "N", QW="slave.length", NW=0.28, side=LEFT)
    F = OnLink("N", W, NF=hypot(0.10, -0.25), WNF=atan2(-0.25, 0.10) - 92 * deg)  # the heel of the forks
    X = OnLink("N", W, NX=hypot(1.30, 0.25), WNX=atan2(-0.25, 1.30) - 92 * deg)  # their tips
    G = OnLink("N", W, NG=hypot(0.70, 0.25), WNG=atan2(0.25, 0.70) - 92 * deg)  # of the load, 600 mm before the heel
    level = angle(F, X)  # of the forks to the ground

    master = Cylinder(D, K, bore=125 * mm, rod=70 * mm, closed=0.75, stroke=0.36)
    slave = Cylinder("Q", W, bore=125 * mm, rod=70 * mm, closed=0.85, stroke=0.44)
    outward = OilLine(master.piston_side, slave.piston_side, filled=dict(slave=0.916), oil=pi / 4 * 0.125**2 * tilt)
    inward = OilLine(master.rod_side, slave.rod_side, filled=dict(slave=0.916), oil=-pi / 4 * (0.125**2 - 0.070**2) * tilt)

    steel = LinkMass((F, X), mass=260.0, at=(0.20, 0.15))
    load = Weight(G, mass=3000.0)
    shape = Outline(FORK, on=(F, X))
    far = LoadCase("far", scale=dict(load=1.1 / 3.0))
    stacking = Over.path(lift=[0.0, 0.7], extend=0.0, tilt=0.0, cases=["plain"])
    reaching = Over.path(lift=0.3, extend=[0.0, 3.0], tilt=0.0, cases=["far"])

    about = Featured("level", ["F", "T"])
