"""A two-stage scissor lift raised by a cylinder.

Source of the formulas: Spackman, "Mathematical Analysis of Scissor Lifts", NOSC technical report 1285 (1989). The
dimensions are illustrative.
"""

from __future__ import annotations

from hydraulics import Cylinder, LiftCircuit
from linkage import LEFT, RIGHT, Dimension, Dyad, Featured, Ground, Guide, Mechanism, OnLink, Outline, SliderDyad, Stroke, Weight, angle, y
from linkage.units import bar, litre, minute, mm


class ScissorLift(Mechanism):
    """Arms OB and AC cross in M, BE and CD in N; A rolls on the floor, E under the platform that is pinned at D.

    The cylinder KJ turns the lowest arm from a pin on the floor. Known for: the platform DE stays level. Its height is
    2 L sin(alpha) with arms L under alpha to the floor, and dh/dalpha = 2 L cos(alpha). The lower the lift, the
    greater the cylinder's force.
    """

    S = Stroke(0.0, 0.260)  # cylinder stroke, m
    L0 = Dimension(0.575)  # pin-to-pin length at S = 0, m
    half = Dimension(0.800)  # half an arm, m

    O = Ground(0.0, 0.0)  # fixed foot
    K = Ground(0.350, -0.050)  # cylinder's pin
    floor = Guide((0.0, 0.0), angle=0.0)

    J = Dyad(O, K, OJ=0.900, KJ=L0 + S, side=LEFT)  # cylinder's pin on the arm OB
    M = OnLink(O, J, OM=half)  # first crossing
    B = OnLink(O, J, OB=2.0 * half)
    A = SliderDyad(M, floor, MA=half, side=RIGHT)  # roller
    C = OnLink(A, M, AC=2.0 * half)
    N = Dyad(C, B, CN=half, BN=half, side=LEFT)  # second crossing
    D = OnLink(B, N, BD=2.0 * half)
    E = OnLink(C, N, CE=2.0 * half)
    h = y(D)  # platform, m
    level = angle(D, E)

    on_pin = Weight(D, mass=280.0)  # table and load, midway between pin and roller; illustrative, as cylinder and circuit are
    on_roller = Weight(E, mass=280.0)
    ram = Cylinder(K, J, bore=100 * mm, rod=56 * mm, closed=0.575, stroke=0.260)
    line = LiftCircuit(ram, pressure=160 * bar, flow=12 * litre / minute)

    ground = Outline.line((-3.0, -0.12), (5.0, -0.12))  # what stands around is drawn only; its figures are illustrative
    platform = Outline([(-0.1, 0.04), (1.7, 0.04), (1.7, 0.12), (-0.1, 0.12)], on=(D, E))

    about = Featured("h", ["A", "D"])
