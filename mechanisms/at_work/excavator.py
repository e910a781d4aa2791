"""A small excavator of three linkages one on the other: boom, arm, and bucket; or a hook in the bucket's place.

Source: geometry, masses and the cylinders' lengths are those of a published planar model of a small machine
(github.com/yitingHH-bit/eXactMPC_v1, excavatorConstants.py). Bores, pressures, what is dug and all outlines are illustrative.
"""

from __future__ import annotations

from math import atan2, hypot

import numpy as np

from hydraulics import Cylinder, LiftCircuit
from linkage import LEFT, RIGHT, Carried, Dyad, Featured, Ground, Link, Mechanism, OnLink, Outline, Over, Part, Stroke, angle, bar, mm, ramp
from linkage.loads import Force, LinkMass, LoadCase, Support, Weight


class Boom(Mechanism):
    """Cylinder CD lifts the boom BDEA about B; the arm's cylinder stands on it in E."""

    S = Stroke(0.0, 0.400)  # m
    B = Ground(0.0, 0.0)
    C = Ground(0.135, -0.264)
    D = Dyad(C, B, CD=0.905 + S, BD=hypot(1.025, 0.278), side=RIGHT)
    A = OnLink(B, D, BA=2.050, DBA=-atan2(0.278, 1.025))  # the boom's end
    E = Carried(B, A, 0.977, 0.737)
    up = angle(B, A)
    beam = Link(B, D, A, E)

    steel = LinkMass((B, A), mass=227.343, at=(1.025, 0.384), inertia=67.768)
    ram = Cylinder(C, D, bore=80 * mm, rod=45 * mm, works="both", closed=0.905, stroke=0.400)
    line = LiftCircuit(ram, pressure=200 * bar, relief=230 * bar)
    shape = Outline([(-0.10, -0.05), (0.05, -0.10), (1.02, 0.24), (2.08, -0.08), (2.10, 0.06), (1.10, 0.76), (0.86, 0.76)], on=(B, A))


class Arm(Mechanism):
    """Cylinder EF swings the arm FGAL about A; in the axes of the boom."""

    S = Stroke(0.0, 0.510)  # m
    A = Ground(2.050, 0.0)
    E = Ground(0.977, 0.737)
    F = Dyad(E, A, EF=1.046 + S, AF=hypot(0.251, 0.158), side=LEFT)
    L = OnLink(A, F, AL=1.050, FAL=-atan2(0.158, -0.251))  # the arm's end
    G = Carried(A, L, -0.134, 0.320)
    J = Carried(A, L, 0.880, 0.0)
    fold = angle(A, L)
    stick = Link(A, F, L, G, J)

    steel = LinkMass((A, L), mass=130.123, at=(0.225, 0.227), inertia=30.258)
    ram = Cylinder(E, F, bore=80 * mm, rod=56 * mm, works="both", closed=1.046, stroke=0.510)
    line = LiftCircuit(ram, pressure=200 * bar, relief=230 * bar)
    shape = Outline([(-0.30, 0.16), (-0.14, 0.38), (0.25, 0.20), (1.08, 0.05), (1.08, -0.05), (0.0, -0.09)], on=(A, L))


class Bucket(Mechanism):
    """Cylinder GH turns the bucket LKM by the rocker JH and the link HK; in the axes of the arm."""

    S = Stroke(0.0, 0.420)  # m
    G = Ground(-0.134, 0.320)
    J = Ground(0.880, 0.0)
    L = Ground(1.050, 0.0)
    H = Dyad(G, J, GH=0.840 + S, HJ=0.240, side=LEFT)
    K = Dyad(H, L, HK=0.240, LK=hypot(0.014, 0.164), side=LEFT)
    M = OnLink(L, K, LM=0.567, KLM=-atan2(0.164, -0.014))  # the teeth
    turn = angle(L, M)
    bucket = Link(L, K, M)

    steel = LinkMass((L, M), mass=53.0, at=(0.289, 0.166), inertia=3.021)
    soil = LinkMass((L, M), mass=100.0, at=(0.280, 0.180))
    dig = Force(M, (-10e3 * np.sin(turn), 10e3 * np.cos(turn)))  # N, across LM, against the curl
    ram = Cylinder(G, H, bore=63 * mm, rod=45 * mm, works="both", closed=0.840, stroke=0.420)
    line = LiftCircuit(ram, pressure=200 * bar, relief=230 * bar)
    shape = Outline([(-0.05, -0.04), (0.567, 0.0), (0.50, 0.12), (0.44, 0.30), (0.28, 0.40), (0.06, 0.36), (-0.06, 0.19)], on=(L, M))


class Hook(Mechanism):
    """A hook on the arm's end; bucket, link and their cylinder are taken off."""

    L = Ground(1.050, 0.0)
    load = Weight(L, mass=400.0)


class HookExcavator(Mechanism):
    """Boom and arm with a hook on the arm's end: two linkages, one on the other, whose cylinders are boom.ram and arm.ram."""

    lift = Stroke(0.0, 0.400)  # of the boom's cylinder, m
    swing = Stroke(0.0, 0.510)  # of the arm's

    boom = Part(Boom, S=lift)
    arm = Part(Arm, S=swing, on=(boom.B, boom.A), A=boom.A, E=boom.E)
    tool = Part(Hook, on=(arm.A, arm.L), L=arm.L)

    loading = Over.path(lift=[0.08, 0.30, 0.30], swing=[0.30, 0.30, 0.10])

    track_front, track_rear, M = Ground(0.02, -0.72), Ground(-1.52, -0.72), Ground(-0.90, 0.10)  # M of what slews and what stands
    body = Weight(M, mass=2300.0)
    front = Support(track_front, (0, 1), friction=0.7)
    rear = Support(track_rear, (0, 1), friction=0.7)

    ground = Outline.line((-2.2, -0.72), (4.0, -0.72))
    track = Outline([(-1.6, -0.72), (0.1, -0.72), (0.28, -0.56), (0.1, -0.34), (-1.6, -0.34), (-1.78, -0.53)])
    house = Outline([(-1.7, -0.30), (0.2, -0.30), (0.2, 0.05), (-0.1, 0.10), (-0.1, 1.05), (-0.9, 1.05), (-1.0, 0.35), (-1.7, 0.30)])

    about = Featured("arm.L_y", ["arm.L"])


class Excavator(HookExcavator):
    """The hook excavator with a bucket in place of the hook: one part is exchanged, which brings its cylinder tool.ram and its stroke.

    It runs from place to place of two ways, straight in its strokes. `grading` draws the teeth in along the ground, against the soil;
    `loading` curls the full bucket and lifts it over a truck's side.
    """

    curl = Stroke(0.0, 0.420)  # of the bucket's cylinder, m
    tool = Part(Bucket, S=curl, on=("arm.A", "arm.L"), G="arm.G", J="arm.J", L="arm.L")

    digging = LoadCase("digging", scale={"tool.soil": 0.0})
    carrying = LoadCase("carrying", scale={"tool.dig": 0.0})
    grading = Over.path(
        lift=[0.176, 0.231, 0.256, 0.263], swing=[0.010, 0.176, 0.309, 0.412], curl=[0.335, 0.274, 0.218, 0.155], cases=["digging"]
    )
    loading = Over.path(lift=[0.263, 0.263, 0.390], swing=[0.412, 0.412, 0.150], curl=[0.155, 0.400, 0.400], cases=["carrying"])


class DiggingExcavator(Excavator):
    """The excavator on a cycle in seconds with a full bucket, drawn in, curled and lifted: its masses are felt."""

    grading, loading = None, None  # type: ignore[assignment]
    cycle = Over.path(
        lift=ramp(0.176, 0.263, speed=0.05, acceleration=0.2).hold(1.5).then(ramp(0.263, 0.390, speed=0.12, acceleration=0.5)),
        swing=ramp(0.010, 0.412, speed=0.20, acceleration=0.6).hold(1.2).then(ramp(0.412, 0.150, speed=0.20, acceleration=0.6)),
        curl=ramp(0.335, 0.155, speed=0.10, acceleration=0.5).hold(0.4).then(ramp(0.155, 0.400, speed=0.20, acceleration=0.8)),
        cases=["carrying"],
    )
