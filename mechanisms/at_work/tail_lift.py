"""A tail-lift whose arms rise by two cylinders over one holding valve, while the line of the tilt is shut. Figures: illustrative."""

from __future__ import annotations

from hydraulics import Cylinder, HoldingValve, OilLine, Pump, Tank
from linkage import RIGHT, Dyad, Featured, Ground, Link, LoadCase, Mechanism, OnLink, Outline, Stroke, Weight, angle
from linkage.units import bar, deg, litre, minute, mm


class TailLift(Mechanism):
    """The arm OCP and the tilt cylinder TQ are a parallelogram, which keeps the platform level while the lift cylinder AC raises it.

    `S` lifts, `tilt` tips the platform. In `full` and `empty` the tilt's line is shut, as one spool moves one line; `parked` shuts both.
    """

    S = Stroke(0.0, 0.26)  # m
    tilt = Stroke(-0.01, 0.03)

    O, T, A = Ground(0.0, -0.55), Ground(0.0, -0.80), Ground(-0.10, -0.98)
    C = Dyad(A, O, AC=0.42 + S, OC=0.35, side=RIGHT)
    P = OnLink(O, C, OP=0.75)
    Q = Dyad(T, P, TQ=0.75 + tilt, PQ=0.25, side=RIGHT)
    G = OnLink(P, Q, PG=0.75, QPG=90 * deg)
    arm, platform = Link(O, C, P), Link(P, Q, G)
    level = angle(P, G)

    own, goods = Weight(G, mass=180), Weight(G, mass=1500)
    lift = Cylinder(A, C, bore=63 * mm, rod=36 * mm, count=2)
    tipping = Cylinder(T, Q, bore=63 * mm, rod=36 * mm, count=2)

    supply, second, tank = Pump(180 * bar, flow=12 * litre / minute), Pump(180 * bar, flow=12 * litre / minute), Tank()
    lifting, back = OilLine(lift.piston_side, supply), OilLine(lift.rod_side, tank)
    tilting = OilLine(tipping.piston_side, second)
    valve = HoldingValve(lifting, pilot=back, setting=140 * bar, ratio=3)

    full = LoadCase("full", shut=["tilting"])
    empty = LoadCase("empty", only=["own"], shut=["tilting"])
    parked = LoadCase("parked", shut=["lifting", "tilting"])

    ground = Outline.line((-1.5, -1.30), (2.5, -1.30))
    deck = Outline([(-1.5, -0.35), (0.0, -0.35), (0.0, -0.50), (-1.5, -0.50)])
    plate = Outline([(0.0, 0.0), (0.05, 0.05), (1.5, 0.02), (1.5, 0.0)], on=(P, G))

    about = Featured("level", ["G", "P"])
