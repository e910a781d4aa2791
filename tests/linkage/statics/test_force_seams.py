"""Where forces meet designs, cases, circuits and several strokes: numbers that were wrong without a word."""

from itertools import pairwise

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Accumulator, AccumulatorBlock, Cylinder, FloatCircuit, LiftCircuit, lift_verdicts
from linkage import (
    RIGHT,
    Crank,
    DefinitionError,
    Dimension,
    Dyad,
    Ground,
    Load,
    LoadCase,
    Mechanism,
    OnLink,
    PinFriction,
    Stroke,
    Weight,
    angle,
    deg,
    driving_force,
    max_table,
    pin_forces,
)
from linkage.units import bar, g0, kN, litre, mm


class Base(Mechanism):
    S = Stroke(0.0, 0.25)
    k = Dimension(1.0)
    A, O = Ground(0.2, 0.55), Ground(0.3, 1.15)
    B = Dyad(A, O, AB=0.5 + k * S, OB=0.30, side=RIGHT)
    G = OnLink(O, B, OG=0.9, BOG=-40 * deg)
    load = Weight(G, mass=1000)
    lift = Cylinder(A, B, bore=80 * mm, rod=45 * mm)
    pump = LiftCircuit(lift, pressure=180 * bar)


@pytest.mark.parametrize("k", [2.0, 0.5, np.array([1.0, 2.0, 0.7])])
def test_how_a_length_follows_its_stroke_is_the_designs_own(k):
    motion = Base(k=k).at(S=np.array([0.02, 0.05]))
    levers = np.asarray(k)[..., None] if np.ndim(k) else k
    assert_allclose(Base.lift.thrust(motion), driving_force(motion) / levers, rtol=1e-12)
    assert_allclose(Base.lift.thrust(motion), pin_forces(motion).thrusts["lift"], rtol=1e-12)


def test_a_law_that_bends_at_the_end_is_seen():
    class Bent(Base):
        B = Dyad("A", "O", AB=0.5 + Base.S + 2.0 * np.maximum(Base.S - 0.235, 0.0), OB=0.30, side=RIGHT)

    motion = Bent().at(S=np.array([0.2, 0.245]))
    assert_allclose(Bent.lift.thrust(motion), pin_forces(motion).thrusts["lift"], rtol=1e-12)
    assert_allclose(Bent.lift.thrust(motion), driving_force(motion) / [1.0, 3.0], rtol=1e-12)


class Swung(Mechanism):
    """A gas-fed cylinder from the frame to the second of two arms."""

    p1, p2 = Stroke(0.0, 0.5), Stroke(0.0, 0.5)
    O, N = Ground(0.0, 0.0), Ground(0.3, 1.5)
    P = Crank(O, OP=1.0, angle=p1)
    Q = Crank(P, PQ=0.8, angle=angle(O, P) + p2)
    gs = Cylinder(N, Q, bore=50 * mm, rod=28 * mm, works="rod")
    line = FloatCircuit(gs, AccumulatorBlock([Accumulator(6 * litre, 20 * bar)]), charge_pressure=60 * bar, at=0.1)


def test_gas_knows_the_length_of_its_cylinder_alone():
    motion = Swung().sweep(p1=21, p2=21)
    length, pressure = motion.distance("N", "Q").ravel(), Swung.line.pressure(motion).ravel()
    order = np.argsort(length)
    assert (np.diff(pressure[order]) >= -1e-9 * bar).all()  # of the rod side it grows with the length
    u = np.linspace(0.0, 1.0, 4001)
    corners = np.array([[0.1, 0.1], [0.1, 0.4], [0.4, 0.4], [0.4, 0.1], [0.1, 0.1]])
    path = np.concatenate([a + (b - a) * u[:, None] for a, b in pairwise(corners)])
    round_trip = Swung().at(p1=path[:, 0], p2=path[:, 1])
    thrust, along = Swung.gs.thrust(round_trip), round_trip.distance("N", "Q")
    work = 0.5 * (thrust[1:] + thrust[:-1]) * np.diff(along)
    assert abs(work.sum()) < 1e-6 * np.abs(work).sum()


def test_a_capacity_in_a_case_counts_the_friction_of_its_own_load():
    class Rubbing(Base):
        fb = PinFriction("B", radius=60 * mm, coefficient=0.3)
        fo = PinFriction("O", radius=60 * mm, coefficient=0.3)
        only = LoadCase("only", only=["load", "fb", "fo"])

    motion = Rubbing().at(S=np.array([0.05, 0.1]))
    assert_allclose(Rubbing.pump.capacity(motion, "G", case="only"), Rubbing.pump.capacity(motion, "G"), rtol=1e-12)


def test_a_case_scales_friction():
    class Rubbing(Base):
        fo = PinFriction("O", radius=60 * mm, coefficient=0.1)
        worn = LoadCase("worn", scale={"fo": 2.0})

    class Worn(Base):
        fo = PinFriction("O", radius=60 * mm, coefficient=0.2)

    up = driving_force(Rubbing().sweep(5), case="worn", direction="extending")
    assert_allclose(up, driving_force(Worn().sweep(5), direction="extending"), rtol=1e-12)


def test_a_pump_on_a_charged_cylinder_is_not_called_good():
    class Charged(Base):
        line = FloatCircuit("lift", AccumulatorBlock([Accumulator(2 * litre, 40 * bar)]), charge_pressure=90 * bar, at=0.1)

    said = lift_verdicts(Charged.pump, Charged().sweep(5))
    assert not said[0] and "is fed by line" in said[0].sentence


def test_one_pressure_cannot_hold_two_strokes():
    class Two(Mechanism):
        S1, S2 = Stroke(0.0, 0.2), Stroke(0.0, 0.2)
        A, O = Ground(0.2, 0.55), Ground(0.3, 1.15)
        B = Dyad(A, O, AB=0.5 + S1, OB=0.30, side=RIGHT)
        C = OnLink(O, B, OC=0.9)
        D = Dyad(B, C, BD=0.4 + S2, CD=0.5, side=RIGHT)
        load = Weight(D, mass=200)
        one, two = Cylinder(A, B, bore=0.08, rod=0.045), Cylinder(B, D, bore=0.063, rod=0.036)
        pump = LiftCircuit([one, two], pressure=180 * bar)

    with pytest.raises(DefinitionError, match="does not move with S"):
        pin_forces(Two().at(S1=0.1, S2=0.1))


class Clamp:
    """An element that is no ForceElement: what it holds with while it moves."""

    def loads(self, motion):
        return []

    def moving(self, motion, rates):
        return [Load("G", np.array([0.0, -100.0 * np.sign(rates["S"])]))]


def test_plain_objects_move_as_well():
    motion = Base().sweep(5)
    up = driving_force(motion, ["load", Clamp()], direction="extending")
    assert_allclose(up - driving_force(motion), 100.0 * motion.ratio("G")[1], rtol=1e-12)


def test_a_load_may_name_the_element_it_is_on():
    class Hung:
        def loads(self, motion):
            return [Load("B", np.array([0.0, -50.0 * g0]), on=("lift",))]

    motion = Base().sweep(3)
    found = pin_forces(motion, ["load", "lift", Hung()])
    free = pin_forces(motion, ["load", "lift"])
    assert found.residual < 1e-12
    assert np.abs(found.force("B", on="lift") - free.force("B", on="lift")).max() > 50.0


def test_the_table_through_a_dead_centre_says_so_without_warnings():
    class Boom(Mechanism):
        phi = Stroke(-80 * deg, 80 * deg)
        O, K = Ground(0.0, 1.0), Ground(0.5, 0.2)
        B = Crank(O, OB=0.8, angle=phi)
        load = Weight(B, mass=100)
        lift = Cylinder(K, B, bore=80 * mm, rod=40 * mm)

    rows = {row.point: row for row in max_table(pin_forces(Boom().sweep(4)))}
    assert rows["K"].force == np.inf and rows["K"].strokes["phi"] == pytest.approx(np.arctan2(-0.8, 0.5), abs=1e-4)


def test_the_relief_valve_limits_the_pump():
    strong = LiftCircuit("lift", pressure=180 * bar)
    leaking = LiftCircuit("lift", pressure=180 * bar, relief=60 * bar)
    motion = Base().sweep(5)
    assert_allclose(leaking.reserve(motion) * 3.0, strong.reserve(motion), rtol=1e-12)
    assert_allclose(leaking.capacity(motion, "G", []) * 3.0, strong.capacity(motion, "G", []), rtol=1e-12)
    assert leaking.capacity(motion, "G", []).min() > kN
