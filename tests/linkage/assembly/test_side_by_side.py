"""Two machines in one class do not see each other: what holds, rubs, moves and limits one of them is as if it stood alone."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Cylinder, LiftCircuit
from linkage import RIGHT, Dyad, Force, Ground, Mechanism, OnLink, PinFriction, Stroke, Weight
from linkage.quantities import Member
from linkage.statics import pin_forces
from linkage.units import bar, kN, mm

S, T = np.linspace(0.02, 0.22, 6), np.linspace(0.05, 0.20, 6)


class Pair(Mechanism):
    """An arm on two cylinders of one line, the first of which works with both sides."""

    S = Stroke(0.00, 0.25)
    A, O, K = Ground(0.20, 0.55), Ground(0.30, 1.15), Ground(0.55, 0.40)
    B = Dyad(A, O, AB=0.50 + S, OB=0.30, side=RIGHT)
    G = OnLink(O, B, OG=0.9)
    one = Cylinder(A, B, bore=63 * mm, rod=40 * mm, works="both")
    two = Cylinder(K, B, bore=50 * mm, rod=28 * mm, works="both")
    pump = LiftCircuit([one, two], pressure=180 * bar)
    load = Force(G, (0.0, -3 * kN))
    rub = PinFriction(O, radius=0.03, coefficient=0.1)


class Single(Mechanism):
    """Another arm, on one cylinder."""

    T = Stroke(0.00, 0.25)
    A2, O2 = Ground(3.20, 0.55), Ground(3.35, 1.10)
    B2 = Dyad(A2, O2, A2B2=0.48 + T, O2B2=0.28, side=RIGHT)
    G2 = OnLink(O2, B2, O2G2=0.7)
    lift = Cylinder(A2, B2, bore=80 * mm, rod=45 * mm)
    load2 = Weight(G2, mass=400.0)
    rub2 = PinFriction(O2, radius=0.02, coefficient=0.15)


def side_by_side(first, second):
    """Return the class of the members of both."""
    members = {name: value for each in (first, second) for name, value in vars(each).items() if isinstance(value, Member)}
    return type("Both", (Mechanism,), members)


BOTH = side_by_side(Pair, Single)
PULLED = type("Pulled", (Pair,), {"load": Force("G", (0.0, 3 * kN))})


@pytest.mark.parametrize("pair", [Pair, PULLED])
def test_forces_are_those_of_each_alone(pair):
    """Thrusts shared by area while it pushes and while it pulls; the other machine's cylinder is bound to none of it."""
    both = pin_forces((BOTH if pair is Pair else type("Both2", (BOTH,), {"load": PULLED.load}))().at(S=S, T=T))
    alone = pin_forces(pair().at(S=S)), pin_forces(Single().at(T=T))
    for each in alone:
        for name, thrust in each.thrusts.items():
            assert_allclose(both.thrusts[name], thrust, rtol=1e-11, err_msg=name)
        for joint in each.joints:
            (same,) = (other for other in both.joints if (other.point, other.on, other.by) == (joint.point, joint.on, joint.by))
            assert_allclose(same.force, joint.force, rtol=0, atol=1e-11 * np.abs(joint.force).max())
    area = {name: np.pi / 4 * bore**2 for name, bore in (("one", 0.063), ("two", 0.050))}
    rod = {name: np.pi / 4 * (bore**2 - rod**2) for name, bore, rod in (("one", 0.063, 0.040), ("two", 0.050, 0.028))}
    sides = area if np.all(both.thrusts["one"] > 0.0) else rod
    assert_allclose(both.thrusts["one"] / both.thrusts["two"], sides["one"] / sides["two"], rtol=1e-12)
    assert np.all(np.sign(both.thrusts["one"]) == (1.0 if pair is Pair else -1.0))


def test_limits_are_those_of_each_alone():
    both = BOTH().at(S=0.1, T=0.1).limits()
    for machine, name in ((Pair, "S"), (Single, "T")):
        alone, found = machine().at(**{name: 0.1}).limits()[name], both[name]
        ends = [[end for each in limits.intervals for end in (each.low, each.high)] for limits in (found, alone)]
        assert_allclose(*ends, rtol=1e-9)
        assert found.change_points == alone.change_points
        own = [each.joint for each in found.transmission if each.joint in machine.plan.points]
        assert [each.joint for each in alone.transmission] == own


@pytest.mark.parametrize("direction", [{"S": 0.02, "T": 0.01}, {"S": -0.02, "T": 0.01}])
def test_friction_takes_each_ones_own_sense(direction):
    """With rates of both strokes, each arm's pin rubs against its own turning."""
    both = pin_forces(BOTH().at(S=S, T=T), rates=direction)
    for machine, at in ((Pair, {"S": S}), (Single, {"T": T})):
        alone = pin_forces(machine().at(**at), rates={name: direction[name] for name in at})
        for name, thrust in alone.thrusts.items():
            assert_allclose(both.thrusts[name], thrust, rtol=1e-10, err_msg=name)
