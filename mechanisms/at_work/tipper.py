"""A tipper with a scissor hoist (Marrel's) under its body: a class III group, solved by iteration. Figures: illustrative."""

from __future__ import annotations

from math import dist, hypot

from hydraulics import Cylinder, LiftCircuit
from linkage import Featured, Ground, Link, LoadCase, Mechanism, Outline, Over, Pin, Stroke, Weight, angle, bar, deg, litre, minute, mm

PIN, LOAD = (1.60, -0.10), (1.70, 0.55)
"""Where the scissor's pin and the load stand in the body that lies flat, from its hinge [m]."""


class Tipper(Mechanism):
    """One cylinder AB opens the scissor of the rod DE and the lever CEB, which pushes the body OCG up.

    `tipping` raises the loaded body, also where the ground falls away by 3 deg to the rear.
    """

    S = Stroke(0.0, 0.265)  # m

    O = Ground(0.0, 0.0)
    A = Ground(0.45, -0.45)
    D = Ground(0.90, -0.40)
    C = Pin(near=PIN)
    E = Pin(near=(2.60, -0.35))
    B = Pin(near=(2.18, -0.02))
    G = Pin(near=LOAD)
    body = Link("O C G", OC=hypot(*PIN), OG=hypot(*LOAD), CG=dist(PIN, LOAD))
    lever = Link("C E B", CE=1.03, EB=0.5278, CB=0.5921)
    rod = Link("D E", DE=1.70)
    ram = Link("A B", AB=1.790 + S)
    tip = angle(O, C)

    load = Weight(G, mass=6000.0)
    lift = Cylinder(A, B, bore=160 * mm, rod=90 * mm, closed=1.780, stroke=0.280)
    line = LiftCircuit(lift, pressure=180 * bar, relief=200 * bar, flow=60 * litre / minute, mechanical_efficiency=0.9)

    downhill = LoadCase("downhill", slope=3 * deg)
    tipping = Over(cases=["plain", "downhill"])

    ground = Outline.line((-2.0, -1.25), (5.5, -1.25))
    wheel = Outline.circle(at=(0.75, -0.80), radius=0.45)
    frame = Outline([(-0.25, -0.08), (3.9, -0.08), (3.9, -0.26), (-0.25, -0.26)])
    skip = Outline([(-0.3, 0.10), (3.5, -0.02), (3.5, 0.75), (-0.35, 0.90)], on=(O, C))

    about = Featured("tip", ["G", "B"])
