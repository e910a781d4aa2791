"""Between which two forces elements stand: cylinders by their circuits, supports, all others."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from hydraulics import Accumulator, AccumulatorBlock, Cylinder, FloatCircuit, LiftCircuit
from linkage import RIGHT, DefinitionError, Dyad, Ground, Mechanism, OnLink, Stroke
from linkage.loads import Force, PinFriction, Spring, Support, Weight
from linkage.units import bar, deg, litre, mm
from tests.for_all import for_all

PISTON, ROD_SIDE = math.pi / 4 * 0.110**2 * 2, math.pi / 4 * (0.110**2 - 0.063**2) * 2


class Lift(Mechanism):
    """An arm with a load at G, lifted by two cylinders on one pump."""

    S = Stroke(0.00, 0.25)
    A = Ground(0.20, 0.55)
    O = Ground(0.30, 1.15)
    B = Dyad(A, O, AB=0.50 + S, OB=0.30, side=RIGHT)
    G = OnLink(O, B, OG=0.9, BOG=-40 * deg)
    load = Weight(G, mass=3000)
    shoe = Support(G, (0, 1))
    spring = Spring(O, G, stiffness=1000.0, free_length=0.5)
    lift = Cylinder(A, B, bore=110 * mm, rod=63 * mm, count=2)
    circuit = LiftCircuit(
        lift, pressure=180 * bar, relief=210 * bar, mechanical_efficiency=0.9, hydraulic_efficiency=0.95, back_pressure=6 * bar
    )


class Both(Lift):
    """The same with cylinders that work on both sides."""

    lift = Cylinder("A", "B", bore=110 * mm, rod=63 * mm, count=2, works="both")


class Pulling(Lift):
    """The same with cylinders that pull, the load on the other side."""

    G = OnLink("O", "B", OG=0.9, BOG=140 * deg)
    lift = Cylinder("A", "B", bore=110 * mm, rod=63 * mm, count=2, works="rod")


PUSH = 0.9 * (0.95 * 180e5 * PISTON - 6e5 * ROD_SIDE)
PULL = 0.9 * (0.95 * 180e5 * ROD_SIDE - 6e5 * PISTON)


@pytest.mark.parametrize(("machine", "low", "high"), [(Lift, 0.0, PUSH), (Both, -PULL, PUSH), (Pulling, -PULL, 0.0)])
def test_a_cylinder_lifts_with_the_sides_that_work_and_holds_with_both(machine, low, high):
    motion, lift = machine().sweep(5), machine.lift
    assert_allclose(lift.bounds(motion, True), (low, high), rtol=1e-14)
    assert_allclose(lift.bounds(motion, False), (-210e5 * ROD_SIDE, 210e5 * PISTON), rtol=1e-14)
    assert_array_equal(machine.circuit.bounds_of("lift", motion, True), lift.bounds(motion, True))
    half = 0.9 * (0.5 * 0.95 * 180e5 * PISTON - 6e5 * ROD_SIDE)
    assert_allclose(lift.bounds(motion, True, share=0.5)[1], 0.0 if machine is Pulling else half, rtol=1e-14)
    assert_array_equal(lift.bounds(motion, False, share=0.5), lift.bounds(motion, False))  # the relief valve is none of the pump's


def test_bounds_follow_the_designs_of_a_batch():
    bores = np.array([0.09, 0.11, 0.125])
    motion = Lift(**{"lift.bore": bores, "circuit.pressure": np.array([100.0, 150.0, 200.0]) * bar}).sweep(4)
    low, high = Lift.lift.bounds(motion, True)
    push, pull = math.pi / 2 * bores**2, math.pi / 2 * (bores**2 - 0.063**2)
    expected = 0.9 * (0.95 * np.array([100e5, 150e5, 200e5]) * push - 6e5 * pull)
    assert_allclose(np.broadcast_to(high, motion.shape), np.broadcast_to(expected[:, None], motion.shape), rtol=1e-14)
    assert low == 0.0


@for_all("machine", [Lift, Both, Pulling])
@for_all("share", [0.9], slow=[1.0])
@for_all("rubs", [False, True])
def test_at_its_capacity_the_cylinder_stands_at_its_bound(machine, share, rubs):
    own = [Weight("B", mass=200), *([PinFriction("O", radius=40 * mm, coefficient=0.2)] if rubs else [])]
    for S in (0.03, 0.21):
        pose = machine().at(S=S)
        most = machine.circuit.capacity(pose, "G", own, share=share)
        assert most > 0.0
        way = "retracting" if machine is Pulling else "extending"
        thrust = machine.lift.thrust(pose, [*own, Force("G", (0.0, -most))], direction=way)
        low, high = machine.lift.bounds(pose, True, share=share)
        assert_allclose(thrust, low if machine is Pulling else high, rtol=1e-9)


def test_a_charged_line_gives_one_force():
    class Charged(Lift):
        circuit = FloatCircuit("lift", AccumulatorBlock([Accumulator(volume=2 * litre, charge=60 * bar)]), charge_pressure=90 * bar)

    motion = Charged().sweep(5)
    for lifting in (True, False):
        low, high = Charged.lift.bounds(motion, lifting)
        assert_array_equal(low, Charged.lift.thrust(motion))
        assert_array_equal(high, low)


def test_a_support_only_pushes_and_what_says_nothing_is_unbounded():
    class Bare(Lift):
        circuit = None

    motion = Bare().sweep(3)
    for lifting in (True, False):
        assert tuple(Bare.shoe.bounds(motion, lifting)) == (0.0, math.inf)
        for each in (Bare.lift, Bare.load, Bare.spring):
            assert tuple(each.bounds(motion, lifting)) == (-math.inf, math.inf)


def test_one_of_several_circuits_is_named():
    class Two(Lift):
        weak = LiftCircuit("lift", pressure=90 * bar)

    pose = Two().at(S=0.1)
    with pytest.raises(DefinitionError, match="is on 2 circuits, circuit, weak"):
        Two.lift.bounds(pose, True)
    assert_allclose(Two.weak.bounds_of("lift", pose, True), (0.0, 90e5 * PISTON))
    assert_allclose(Two.weak.bounds_of("lift", pose, False), (-90e5 * ROD_SIDE, 90e5 * PISTON))  # held at the pump's without a valve
    with pytest.raises(DefinitionError, match="share"):
        Two.weak.bounds_of("lift", pose, True, share=1.5)
