"""Machines given by their angles, counterbalanced, on gas: the same statics from the other side; printed hydraulic numbers."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Accumulator, AccumulatorBlock, Cylinder, CylinderSize, FloatCircuit, adiabatic, isothermal
from linkage import (
    LEFT,
    RIGHT,
    Crank,
    Dyad,
    Ground,
    LinkMass,
    Mechanism,
    OnLink,
    Spring,
    Stroke,
    Weight,
    angle,
    bar,
    deg,
    distance,
    driving_force,
    litre,
    mm,
    pin_forces,
)
from linkage.units import inch
from tests.mechanisms.free_bodies import FreeBodies, G, places, slope


class Arm(Mechanism):
    """Boom and stick given by their angles, the stick's measured from the boom; two cylinders hold them."""

    q1, q2 = Stroke(10 * deg, 50 * deg), Stroke(70 * deg, 120 * deg)
    O, K = Ground(0, 1), Ground(0.5, 0.2)
    B = Crank(O, OB=1.0, angle=q1)
    E, U = OnLink(O, B, OE=3.0), OnLink(O, B, OU=1.6, BOU=15 * deg)
    V = Crank(E, EV=0.5, angle=angle(O, B) + q2)
    T = OnLink(E, V, ET=1.8, VET=180 * deg)
    load, own = Weight(T, mass=300), LinkMass("E V T", mass=120)
    lift, reach = Cylinder(K, B, bore=80 * mm, rod=45 * mm), Cylinder(U, V, bore=80 * mm, rod=45 * mm)


def test_declared_cylinders_hold_what_angles_describe():
    motion, at = Arm().sweep(q1=3, q2=3), (1, 2)
    p, cut, forces = places(motion, at), FreeBodies(), pin_forces(motion)
    cut.pin("O", "boom", "frame", p["O"])
    cut.pin("E", "stick", "boom", p["E"])
    cut.thrust("lift", "frame", p["K"], "boom", p["B"])
    cut.thrust("reach", "boom", p["U"], "stick", p["V"])
    cut.load("stick", p["T"], (0, -300 * G))
    cut.load("stick", np.mean([p[point] for point in "EVT"], axis=0), (0, -120 * G))
    want = cut.solve()
    assert_allclose([forces.at("K")[0].size[at], forces.at("V")[0].size[at]], np.abs([want["lift"], want["reach"]]), rtol=1e-11)
    assert_allclose(driving_force(motion, drive="q2")[at], want["reach"] * motion.ratio(distance("U", "V"), wrt="q2")[at], rtol=1e-11)
    assert not any(each.kind == "crank" for each in forces.joints) and forces.gap < 1e-13


class Tailgate(Mechanism):
    """A lid given by its angle, a gas spring fed by its own gas: the crank's torque is what the hand must do."""

    theta = Stroke(-70 * deg, 10 * deg)
    O, K = Ground(0, 0), Ground(0.05, -0.45)
    A = Crank(O, OA=0.35, angle=theta)
    M = OnLink(O, A, OM=0.55)
    lid, strut = Weight(M, mass=18), Cylinder(K, A, bore=10 * mm, rod=4 * mm)
    block = AccumulatorBlock([Accumulator(volume=0.08 * litre, charge=80 * bar)])
    gas = FloatCircuit(strut, block, charge_pressure=80 * bar, at=10 * deg)


def test_gas_spring_is_a_load_where_the_hand_drives():
    motion = Tailgate().sweep(7)
    theta, rod = motion.strokes["theta"], np.pi / 4 * 0.010**2
    A, K = 0.35 * np.array([np.cos(theta), np.sin(theta)]), np.array([[0.05], [-0.45]])
    length = np.hypot(*(A - K))
    gauge = (80e5 + 101325) * 80e-6 / (80e-6 - (length[-1] - length) * rod) - 101325
    u = (A - K) / length
    hand = 18 * G * 0.55 * np.cos(theta) - gauge * rod * (A[0] * u[1] - A[1] * u[0])
    assert_allclose(driving_force(motion), hand, rtol=1e-10, atol=1e-9)
    assert_allclose(pin_forces(motion).drives["theta"], hand, rtol=1e-10, atol=1e-9)


class Lamp(Mechanism):
    """Anglepoise (Carwardine): springs of no free length balance both arms, a parallelogram carries the upright."""

    a, b = Stroke(50 * deg, 130 * deg), Stroke(-60 * deg, 40 * deg)
    O, H, Q = Ground(0, 0), Ground(0, 0.1), Ground(-0.05, 0)
    A = Crank(O, OA=0.40, angle=a)
    R = Dyad(Q, A, QR=0.40, AR=0.05, side=LEFT)
    V = OnLink(A, R, AV=0.1, RAV=-90 * deg)
    B = Crank(A, AB=0.35, angle=b)
    P, T = OnLink(O, A, OP=0.12), OnLink(A, B, AT=0.1)
    lower, upper, head = LinkMass("O A", mass=0.5), LinkMass("A B", mass=0.4), Weight(B, mass=0.8)
    first = Spring(H, P, stiffness=(0.25 + 0.4 + 0.8) * 0.40 * G / (0.1 * 0.12), free_length=0)
    second = Spring(V, T, stiffness=(0.2 + 0.8) * 0.35 * G / (0.1 * 0.1), free_length=0)


def test_balanced_lamp_stays_where_it_is_put():
    motion = Lamp().sweep(a=7, b=6)
    for drive in ("a", "b"):
        assert_allclose(driving_force(motion, drive=drive), 0.0, atol=1e-12)
    forces = pin_forces(motion)
    assert forces.gap < 1e-13 and "virtual work" in str(forces)


class Held(Mechanism):
    """A cylinder that is heavy itself."""

    S = Stroke(0, 0.4)
    O, K = Ground(0, 1), Ground(0.2, 0.4)
    B = Dyad(K, O, KB=0.6 + S, OB=0.9, side=RIGHT)


@pytest.mark.parametrize(
    ("mass", "height"),
    [
        (LinkMass("K B", mass=100), lambda K, B, u: (K + B)[1] / 2),
        (LinkMass("K B", mass=100, at=(0.3, 0.0)), lambda K, B, u: (K + 0.3 * u)[1]),
        (LinkMass("B K", mass=100, at=(0.2, 0.0)), lambda K, B, u: (B - 0.2 * u)[1]),
    ],
    ids=["middle", "barrel", "rod"],
)
def test_cylinders_own_mass_does_the_work_of_its_height(mass, height):
    """As a bar in the middle, as a barrel at a distance from K, as a rod at a distance from B."""

    def energy(S):
        motion = Held().at(S=S)
        K, B = motion["K"], motion["B"]
        return 100 * G * height(K, B, (B - K) / (0.6 + S))

    motion = Held().at(S=0.2)
    assert_allclose(driving_force(motion, mass), slope(energy, 0.2), rtol=1e-9)
    assert pin_forces(motion, mass).gap < 1e-13


# -- printed numbers of cylinders and accumulators ------------------------------------------------------------


def test_espositos_cylinder():
    """Esposito, Fluid Power, chapter 6: 2 in bore, 1 in rod, 1000 lbf, 20 gpm: 318 psi, 2.04 ft/s out, 424 psi, 2.72 ft/s in."""
    psi, lbf, gpm, foot = 6894.757, 4.448222, 3.785412e-3 / 60, 0.3048
    out, back = (CylinderSize(bore=2 * inch, rod=1 * inch, works=side) for side in ("piston", "rod"))
    assert_allclose([out.pressure_for(1000 * lbf) / psi, back.pressure_for(-1000 * lbf) / psi], [318.3, 424.4], rtol=2e-4)
    assert_allclose([out.speed(20 * gpm) / foot, back.speed(20 * gpm) / foot], [2.04, 2.72], rtol=2e-3)


def test_accumulators_as_they_are_sized():
    """Blowout preventer, 10 gal, 1000 psi charge, 3000 to 1200 psi: 5 gal (the gauge pressures in Boyle's law); 1 litre in a fast change
    between 100 and 200 bar, 90 bar charge, n = 1.4, takes 2.77 litres (absolute pressures)."""
    psi, gallon = 6894.757, 3.785412e-3
    bottle = AccumulatorBlock([Accumulator(volume=10 * gallon, charge=1000 * psi)], gas=isothermal, atmosphere=0)
    assert_allclose((bottle.fluid(3000 * psi) - bottle.fluid(1200 * psi)) / gallon, 5.0, rtol=1e-12)
    fast = AccumulatorBlock([Accumulator(volume=1 * litre, charge=90 * bar)], gas=adiabatic)
    assert f"{1 * litre / (fast.fluid(200 * bar) - fast.fluid(100 * bar)):.2f}" == "2.77"
