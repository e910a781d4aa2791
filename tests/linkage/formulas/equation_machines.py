"""Machines for the tests of the equations, and the comparison with the motion."""

import numpy as np
from numpy.testing import assert_allclose

from linkage import (
    LEFT,
    RIGHT,
    CosineAngle,
    Crank,
    Dimension,
    Dyad,
    Ground,
    Guide,
    Link,
    Mechanism,
    Offset,
    OnGuide,
    PinSlotDyad,
    SliderDyad,
    Stroke,
    Turn,
    Vector,
    YokeDyad,
    angle,
    deg,
    distance,
    x,
    y,
)
from linkage.formulas import equations
from linkage.quantities import Quantity
from mechanisms.mower_lift import BELOW, DELFI, G_FROM_O, MowerLift
from mechanisms.three_point_hitch import ThreePointHitch


class HitchInPrimitives(Mechanism):
    """The three-point hitch in the vector method's own primitives."""

    S = Stroke(0.00, 0.25)
    L0 = Dimension(0.50)
    A = Ground(0.20, 0.55)
    O = Ground(0.30, 1.15)
    E = Ground(0.25, 0.60)
    M = Ground(0.22, 1.05)
    LOB, LOC, LBC = Dimension(0.30), Dimension(0.36), Dimension(0.16)
    LED, LCD, LEF = Dimension(0.48), Dimension(0.62), Dimension(0.95)
    LMK, LFK, LFG = Dimension(0.88), Dimension(0.685), Dimension(0.90)
    KFG = Dimension(75 * deg)

    AO = Vector(A, O)
    OAB = CosineAngle(abs(AO), L0 + S, LOB)
    AB = Turn(AO, -OAB, length=L0 + S)
    B = Offset(A, AB)
    OB = Vector(O, B)
    COB = CosineAngle(LOB, LOC, LBC)
    OC = Turn(OB, COB, length=LOC)
    C = Offset(O, OC)
    BC = Vector(B, C)
    EC = Vector(E, C)
    CED = CosineAngle(abs(EC), LED, LCD)
    ED = Turn(EC, -CED, length=LED)
    D = Offset(E, ED)
    EF = Turn(ED, 0.0, length=LEF)
    F = Offset(E, EF)
    MF = Vector(M, F)
    FMK = CosineAngle(abs(MF), LMK, LFK)
    MK = Turn(MF, FMK, length=LMK)
    K = Offset(M, MK)
    FK = Vector(F, K)
    FG = Turn(FK, -KFG, length=LFG)
    G = Offset(F, FG)
    tilt = angle(F, K) - 90 * deg
    arm = Link(O, B, C)


class MowerInPrimitives(Mechanism):
    """The mower lift in primitives; FI3 is read off the lever, not summed from the worksheet's angles."""

    S = Stroke(0.55, 0.80)
    A = Ground(0.0, 0.242)
    O = Ground(0.652, 0.330)
    LOB, LOG = Dimension(0.175), Dimension(float(np.hypot(*G_FROM_O)))
    BOG = Dimension(DELFI + BELOW)
    AO = Vector(A, O)
    OAB = CosineAngle(abs(AO), S, LOB)
    AB = Turn(AO, -OAB, length=S)
    B = Offset(A, AB)
    OB = Vector(O, B)
    OG = Turn(OB, BOG, length=LOG)
    G = Offset(O, OG)
    FI3 = angle(O, B)


class Slider(Mechanism):
    """A slider crank, a point on the guide, a yoke and a rocking slot."""

    phi = Stroke(0.1, 2.0)
    O = Ground(0.0, 0.0)
    Q = Ground(-0.3, 0.1)
    rail = Guide((0.0, -0.2), angle=0.1)
    A = Crank(O, OA=0.1, angle=phi + 20 * deg)
    C = SliderDyad(A, rail, AC=0.4, side=RIGHT)
    H = OnGuide(rail, at=0.2)
    Y = YokeDyad(A, rail)
    R = PinSlotDyad(Q, A, QR=0.7, offset=0.02)
    w = x(C) / 2 + np.sqrt(y(A) ** 2) * 3


class Outputs(Mechanism):
    """Every kind of output, and a fixed point at a formula."""

    S = Stroke(0.42, 0.5)
    c = Dimension(0.4)
    A = Ground(0.0, 0.0)
    O = Ground(c / 2, c**2)
    B = Dyad(O, A, OB=0.3, AB=S, side=LEFT)
    half = (S - c) / 2
    power = distance(A, B) ** 2 / x(B)
    root = np.sqrt(S**2 + c**2) - abs(Vector(O, B))
    turned = angle(O, B) - 30 * deg
    wave = np.sin(2 * angle(A, B)) + np.exp(-S) - np.log(c)
    least = np.minimum(S, c) + np.maximum(x(B), y(B)) - np.absolute(y(B) - 1)
    slope = np.arctan2(y(B), x(B)) / 2


HITCHES = [ThreePointHitch, HitchInPrimitives]
ALL = [*HITCHES, MowerLift, MowerInPrimitives, Slider, Outputs]


def modulo(a, b):
    """Return the difference of two angles [rad], between -pi and pi."""
    return np.angle(np.exp(1j * (np.asarray(a, float) - np.asarray(b, float))))


def poses(machine):
    """Return strokes over the whole range."""
    return {name: np.linspace(stroke.start, stroke.end, 11) for name, stroke in machine.strokes.items()}


def check_values(machine, at):
    """Hold every point, vector and quantity among the equations against the motion; return how many were compared."""
    found, motion = equations(machine).values(at=at), machine.at(**at)
    for name, value in found.items():
        if name in machine.plan.points or (name in machine.plan.members and not isinstance(machine.plan.members[name], Quantity)):
            assert_allclose(np.broadcast_arrays(*value, motion[name][0])[:2], motion[name], rtol=0, atol=1e-12, err_msg=name)
        elif name in machine.plan.members:
            assert_allclose(modulo(value, motion[name]), 0.0, atol=1e-12, err_msg=name)
        elif len(name) == 2:
            assert_allclose(np.broadcast_arrays(*value, motion[name[0]][0])[:2], motion[name[1]] - motion[name[0]], rtol=0, atol=1e-12)
        elif name.startswith("L_"):
            assert_allclose(value, motion.distance(name[2], name[3]), rtol=0, atol=1e-12)
        elif len(name) == 3:
            (p, q, r) = (motion[each] for each in name)
            u, v = p - q, r - q
            assert_allclose(value, np.arctan2(np.abs(u[0] * v[1] - u[1] * v[0]), (u * v).sum(axis=0)), rtol=0, atol=1e-12, err_msg=name)
        else:
            assert name.startswith("u_"), f"{name} was not compared"
    return len(found)
