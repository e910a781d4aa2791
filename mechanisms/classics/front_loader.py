"""A front loader whose bucket keeps its angle: mechanical self-levelling by two parallelograms. Illustrative dimensions."""

from __future__ import annotations

from hydraulics import Cylinder, LiftCircuit
from linkage import LEFT, RIGHT, Dimension, Dyad, Featured, Ground, Link, Mechanism, OnLink, Outline, Pin, Stroke, angle, deg, drawn
from linkage.loads import LinkMass
from linkage.units import bar, mm


class FrontLoader(Mechanism):
    """Cylinder KL lifts the boom OHB; cylinder MT turns the tilt lever TOE on the boom's pivot.

    The parallelogram EOHF carries the lever's direction to the plate HFG on the boom, the parallelogram GHBJ carries it
    on to the bucket BJ with its edge N. Known for: the bucket keeps its angle while the boom is lifted, exactly and at
    every tilt; the tilt cylinder alone changes it. Two strokes.
    """

    lift = Stroke(0.0, 0.600)  # lift cylinder, m
    tilt = Stroke(0.0, 0.350)  # bucket cylinder, m
    sketch = drawn(lift=0.30, tilt=0.15)

    L1, L2 = Dimension(1.000), Dimension(0.700)  # pin-to-pin lengths at stroke 0, m
    rear, front, lever = Dimension(1.300), Dimension(1.400), Dimension(0.300)  # the parallelograms' sides, m

    O = Ground(0.0, 1.600)  # boom and tilt lever
    K = Ground(0.200, 0.700)
    M = Ground(-0.750, 1.400)

    L = Dyad(K, O, KL=L1 + lift, OL=1.200, side=RIGHT)
    H = OnLink(O, L, OH=rear, LOH=8 * deg)  # the boom's knee
    B = OnLink(H, O, HB=front, OHB=160 * deg)  # the boom's end
    T = Dyad(M, O, MT=L2 + tilt, OT=0.350, side=LEFT)
    E = OnLink(O, T, OE=lever, TOE=-30 * deg)

    first = Link("E F", EF=rear)
    plate = Link("H F G", HF=lever, HG=lever, FHG=20 * deg)
    second = Link("G J", GJ=front)
    bucket = Link("B J N", BJ=lever, BN=0.900, JBN=-120 * deg)
    F = Pin(near=(1.3, 1.9))
    G = Pin(near=(1.2, 1.9))
    J = Pin(near=(2.6, 1.4))
    N = Pin(near=(3.3, 0.6))
    boom = angle(O, B)
    attitude = angle(B, N)

    boom_mass = LinkMass(("O", "B"), mass=180.0, at=(1.3, 0.1))
    bucket_mass = LinkMass(("B", "N"), mass=160.0, at=(0.35, 0.15))
    load = LinkMass(("B", "N"), mass=800.0, at=(0.45, 0.25))
    rams = Cylinder("K", "L", bore=80 * mm, rod=45 * mm, count=2, closed=1.0, stroke=0.6)
    tilt_rams = Cylinder("M", "T", bore=63 * mm, rod=36 * mm, count=2, works="both", closed=0.7, stroke=0.35)
    lift_line = LiftCircuit(rams, pressure=180 * bar, relief=200 * bar)
    tilt_line = LiftCircuit(tilt_rams, pressure=180 * bar, relief=200 * bar)

    ground = Outline.line((-4.0, -0.05), (7.0, -0.05))  # what stands around is drawn only; its figures are illustrative
    wheel = Outline.circle(at=(0.05, 0.45), radius=0.5)  # the front wheel
    shell = Outline([(0.0, -0.06), (0.9, 0.0), (0.62, 0.16), (0.3, 0.5), (0.1, 0.55), (-0.06, 0.4), (-0.08, 0.1)], on=(B, N))

    about = Featured("boom", ["B", "N"])
