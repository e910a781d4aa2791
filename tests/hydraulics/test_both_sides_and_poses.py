"""Several cylinders that work both ways on one circuit, oil at one pose, conditions that are compared, gas beside a pump."""

import numpy as np
import pytest

from hydraulics import Accumulator, AccumulatorBlock, Cylinder, FloatCircuit, LiftCircuit, fits
from linkage import LEFT, RIGHT, Dyad, Ground, Mechanism, OnLink, Stroke, Weight, report
from linkage.errors import DefinitionError
from linkage.motion import least, most, reachable
from linkage.units import bar, litre, minute, mm


class Turned(Mechanism):
    """A lever that its load turns on over the top: two cylinders side by side push first and pull later."""

    S = Stroke(0.0, 0.75)
    O, A = Ground(0.0, 0.0), Ground(0.9, -0.2)
    B = Dyad(A, O, AB=0.45 + S, OB=0.5, side=LEFT)
    G = OnLink(O, B, OG=1.4)
    load = Weight(G, mass=100)
    a = Cylinder(A, B, bore=63 * mm, rod=36 * mm, works="both")
    b = Cylinder(A, B, bore=50 * mm, rod=28 * mm, works="both")
    pump = LiftCircuit([a, b], pressure=160 * bar, flow=20 * litre / minute)


def test_two_that_work_both_ways_share_by_the_area_that_works():
    for made in (Turned, type("Idle", (Turned,), {"load": None})):
        motion = made().sweep(9, unreachable="nan")
        for line in (made.a.thrust, made.pump.reserve, made.pump.pressure_for):
            found = line(motion)
            assert found.dtype == float and np.allclose(found[4], line(made().at(S=motion.strokes["S"][4])), equal_nan=True)
        assert made.pump.capacity(motion, "G").dtype == float and made.a.columns(motion)
        first, second = (each.thrust(motion) for each in (made.a, made.b))
        areas = [np.where(first < 0.0, each.size.pull_area, each.size.push_area) for each in (made.a, made.b)]
        assert np.allclose(first * areas[1], second * areas[0], rtol=1e-12)


def test_at_one_pose_no_oil_is_taken():
    machine, batch = Turned(), Turned(OB=np.array([0.50, 0.51]))
    assert Turned.pump.oil(machine.at(S=0.1)) == 0.0 and Turned.pump.time(machine.at(S=0.1)) == 0.0
    assert Turned.pump.oil(batch.at(S=0.1)).shape == (2,)
    whole = 0.75 * (Turned.a.size.push_area + Turned.b.size.push_area)
    assert np.isclose(Turned.pump.oil(machine.sweep(3)), whole, rtol=1e-12)


def test_a_condition_is_not_compared():
    for condition in (fits("a"), reachable, least("x") >= 1.0, most("x") <= 2.0):
        for compared in (lambda each: each <= 3, lambda each: each >= 3, lambda each: each < 3, lambda each: each < 3):
            with pytest.raises(DefinitionError, match="write it alone"):
                compared(condition)


class Helped(Mechanism):
    """A boom on a pump's cylinder, helped by one on gas."""

    S = Stroke(0.0, 0.35)
    O, A, C = Ground(0.0, 0.6), Ground(0.35, 0.0), Ground(0.9, 0.0)
    B = Dyad(A, O, AB=0.60 + S, OB=0.55, side=RIGHT)
    T = OnLink(O, B, OT=1.5)
    load = Weight(T, mass=700)
    lift = Cylinder(A, B, bore=63 * mm, rod=36 * mm)
    pump = LiftCircuit(lift, pressure=160 * bar, relief=180 * bar)
    help = Cylinder(C, T, bore=40 * mm, rod=25 * mm)
    gas = FloatCircuit(help, AccumulatorBlock([Accumulator(volume=1 * litre, charge=20 * bar)]), charge_pressure=30 * bar)


@pytest.mark.slow
def test_a_report_of_gas_beside_a_pump_tells_pin_forces_against_a_stop(tmp_path):
    report(Helped(), str(tmp_path / "helped.md"), count=3)
    text = (tmp_path / "helped.md").read_text(encoding="utf-8")
    assert "Largest pin forces at the relief pressure" in text and "not calculated" not in text
