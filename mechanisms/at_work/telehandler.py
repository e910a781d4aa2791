"""A telehandler: a boom that is lifted and drawn out, with forks that are tilted on its head; or a bucket. All figures are illustrative."""

from __future__ import annotations

from math import atan2, hypot

from hydraulics import Cylinder, LiftCircuit
from linkage import LEFT, RIGHT, Dyad, Featured, Ground, Link, Mechanism, OnLink, Outline, Over, Part, Stroke, angle, bar, deg, mm, ramp
from linkage.loads import LinkMass, LoadCase, Support, Weight

FORK = [(0.0, 0.0), (1.2, 0.0), (1.2, -0.04), (-0.06, -0.06), (-0.08, 0.75), (0.0, 0.75)]
"""The section of the forks, from their heel along them [m]."""


class Forks(Mechanism):
    """Cylinder QW tilts the carriage about N; in the axes of the boom, drawn in."""

    S = Stroke(0.0, 0.39)  # m
    Q = Ground(3.30, 0.0)
    N = Ground(4.25, -0.50)
    W = Dyad(Q, N, QW=0.86 + S, NW=0.28, side=LEFT)
    F = OnLink(N, W, NF=hypot(0.10, -0.25), WNF=atan2(-0.25, 0.10) - 92 * deg)  # the heel of the forks
    X = OnLink(N, W, NX=hypot(1.30, 0.25), WNX=atan2(-0.25, 1.30) - 92 * deg)  # their tips
    G = OnLink(N, W, NG=hypot(0.70, 0.25), WNG=atan2(0.25, 0.70) - 92 * deg)  # of the load, 600 mm before the heel
    tilt = angle(F, X)
    carriage = Link(N, W, F)

    steel = LinkMass((F, X), mass=260.0, at=(0.20, 0.15))
    load = Weight(G, mass=3000.0)
    ram = Cylinder(Q, W, bore=125 * mm, rod=70 * mm, works="both", closed=0.86, stroke=0.39)
    line = LiftCircuit(ram, pressure=240 * bar, relief=260 * bar)
    shape = Outline(FORK, on=(F, X))


class Telehandler(Mechanism):
    """Cylinder AB lifts the boom OB, RT draws its inner section out, forks.ram tilts the carriage on its head.

    `stacking` lifts the whole load, drawn in, with level forks; `reaching` draws out, and carries 1.1 t instead of 3 t there.
    """

    lift = Stroke(0.0, 0.86)  # m
    extend = Stroke(0.0, 3.0)
    tilt = Stroke(0.0, 0.39)

    O = Ground(-2.600, 1.550)
    A = Ground(-2.098, 0.993)
    B = Dyad(A, O, AB=1.190 + lift, OB=1.70, side=RIGHT)
    R = OnLink(O, B, OR=0.80)
    T = OnLink(O, B, OT=4.0 + extend)  # inner section: its head, the tilt cylinder's pin, the carriage's pin
    Q = OnLink(O, B, OQ=3.3 + extend)
    N = OnLink(T, Q, TN=hypot(0.25, 0.50), QTN=atan2(-0.50, 0.25) + 180 * deg)

    forks = Part(Forks, S=tilt, on=(O, T), Q=Q, N=N)
    level = angle(forks.F, forks.X)  # of the forks to the ground

    outer = LinkMass((O, B), mass=700.0, at=(2.0, 0.0))
    inner = LinkMass((Q, T), mass=450.0, at=(-0.7, 0.0))
    ram = Cylinder(A, B, bore=140 * mm, rod=90 * mm, works="both", closed=1.19, stroke=0.86)
    push = Cylinder(R, T, bore=80 * mm, rod=56 * mm, works="both", closed=3.2, stroke=3.0)
    lift_line = LiftCircuit(ram, pressure=240 * bar, relief=260 * bar)
    push_line = LiftCircuit(push, pressure=240 * bar, relief=260 * bar)

    far = LoadCase("far", scale={"forks.load": 1.1 / 3.0})
    stacking = Over.path(lift=[0.0, 0.2, 0.4, 0.6], extend=0.0, tilt=[0.056, 0.131, 0.206, 0.281], cases=["plain"])
    reaching = Over.path(lift=0.3, extend=[0.0, 3.0], tilt=0.169, cases=["far"])

    front_axle, rear_axle, M = Ground(0.0, 0.0), Ground(-2.85, 0.0), Ground(-1.75, 0.85)  # M of the chassis
    body = Weight(M, mass=6100.0)
    front = Support(front_axle, (0, 1))
    rear = Support(rear_axle, (0, 1))

    ground = Outline.line((-4.2, 0.0), (7.0, 0.0))
    front_wheel = Outline.circle(at=(0.0, 0.58), radius=0.58)
    rear_wheel = Outline.circle(at=(-2.85, 0.58), radius=0.58)
    outer_tube = Outline([(-0.12, -0.12), (3.9, -0.14), (3.9, 0.14), (-0.12, 0.14)], on=(O, B))
    inner_tube = Outline([(-2.6, -0.10), (0.6, -0.10), (0.85, -0.58), (1.05, -0.58), (0.8, 0.10), (-2.6, 0.10)], on=(Q, T))
    chassis = Outline([(-3.3, 0.55), (0.45, 0.55), (0.45, 0.95), (-2.3, 0.95), (-2.3, 1.75), (-2.9, 1.75), (-3.3, 1.2)])

    about = Featured("forks.F_y", ["forks.F", "T"])


class BrakingTelehandler(Telehandler):
    """The telehandler lifts its load in seconds, waits, and lets it down: as it brakes, it tips forward the most."""

    stacking, reaching = None, None  # type: ignore[assignment]
    cycle = Over.path(
        lift=ramp(0.0, 0.6, speed=0.15, acceleration=0.25).hold(1.0).then(ramp(0.6, 0.2, speed=0.15, acceleration=0.25)),
        tilt=ramp(0.056, 0.281, speed=0.05625, acceleration=0.09375)
        .hold(1.0)
        .then(ramp(0.281, 0.131, speed=0.05625, acceleration=0.09375)),
        extend=0.0, cases=["plain"],
    )  # fmt: skip
