"""All joint forces from one kernel: the same as the equations solved on arrays, which know nothing of it."""

import warnings

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from hydraulics import Accumulator, AccumulatorBlock, Cylinder, FloatCircuit, LiftCircuit
from linkage import (
    LEFT,
    RIGHT,
    Acting,
    Between,
    Crank,
    Damper,
    Dimension,
    Dyad,
    Force,
    Ground,
    GuideFriction,
    LinkMass,
    LoadCase,
    Mechanism,
    OnGuide,
    OnLink,
    PinFriction,
    SingularError,
    SingularWarning,
    SliderDyad,
    Spring,
    Stroke,
    Weight,
    deg,
    pin_forces,
    ref,
)
from linkage.statics import max_table
from linkage.statics.applied import applied_loads, rates_in
from linkage.statics.force_program import ForceProgram
from linkage.statics.joint_forces import joints_of
from linkage.statics.solution import by_equations
from linkage.statics.work import poses_held
from linkage.steps import Guide
from linkage.units import bar, kN, litre, mm
from mechanisms.three_point_hitch import ThreePointHitch
from tests.for_all import first_daily


class Rubbing(ThreePointHitch):
    """The hitch with friction in its pins, an own mass, a spring and a damper on the cylinder's pins."""

    own = LinkMass("E D F", mass=30)
    relief = Spring("A", "B", stiffness=20e3, preload=2e3)
    damper = Damper("A", "B", coefficient=5e3)


PINS = [PinFriction(point, radius=0.02, coefficient=0.1) for point in "AOEMBCDFK"]


class Press(Mechanism):
    """A slider-crank that rubs on its rail, with a law of one's own on the slider."""

    phi = Stroke(20 * deg, 160 * deg)
    O = Ground(0.0, 0.0)
    A = Crank(O, OA=0.1, angle=phi)
    rail = Guide((0.0, 0.02), angle=0.0)
    C = SliderDyad(A, rail, AC=0.4, side=RIGHT)
    Z = Ground(0.8, 0.02)
    bale = Between(C, Z, lambda length, rate: 1e3 * np.exp(1.0 - length))
    slide = GuideFriction(C, coefficient=0.2)
    pin = PinFriction(A, radius=0.015, coefficient=0.15)


class Crane(Mechanism):
    """A boom by its angle and an arm by its own, two cylinders beside, gas beside the boom's."""

    u, v = Stroke(0 * deg, 60 * deg), Stroke(-100 * deg, -30 * deg)
    O, K = Ground(0.0, 0.0), Ground(0.4, -0.6)
    B = Crank(O, OB=2.0, angle=u)
    M = OnLink(O, B, OM=0.9, BOM=5 * deg)
    N = OnLink(O, B, ON=1.4, BON=12 * deg)
    T = Crank(B, BT=1.5, angle=u + v)
    H = OnLink(B, T, BH=0.3, TBH=170 * deg)
    boom = Cylinder(K, M, bore=90 * mm, rod=50 * mm)
    arm = Cylinder(N, H, bore=80 * mm, rod=45 * mm, works="both")
    help = Cylinder(K, M, bore=50 * mm, rod=30 * mm)
    gas = FloatCircuit(help, AccumulatorBlock([Accumulator(4 * litre, 30 * bar)]), charge_pressure=60 * bar, at=0.5, seal_friction=2 * bar)
    pump = LiftCircuit(boom, pressure=200 * bar)
    load = Weight(T, mass=300)
    own = LinkMass("O B M", mass=150)
    pins = PinFriction(B, radius=0.03, coefficient=0.12)
    root = PinFriction(O, radius=0.04, coefficient=0.12)


def both(motion, loads=None, **choice):
    """Return the forces by the kernel, and by the equations on arrays."""
    acting = Acting(loads, **choice)
    applied = applied_loads(motion, acting, rates_in(motion, acting))
    return pin_forces(motion, loads, **choice), by_equations(poses_held(motion, applied, "The joint forces"), applied, "refuse")


def check(motion, loads=None, **choice):
    """Hold the two against each other, to 1e-12 of the largest force."""
    found, wanted = both(motion, loads, **choice)
    joints = joints_of(wanted.structure, wanted.contacts)
    size = max(float(np.nanmax(np.abs(joint.force))) for joint in joints)
    for one, other in zip(found.joints, joints, strict=True):
        assert (one.point, one.on, one.by, one.kind) == (other.point, other.on, other.by, other.kind)
        assert_allclose(one.force, other.force, rtol=0, atol=1e-12 * size)
        assert_allclose(one.couple, other.couple, rtol=0, atol=1e-12 * size)
    for name, value in wanted.drives.items():
        assert_allclose(found.drives[name], value, rtol=0, atol=1e-12 * size)
    assert found.thrusts.keys() == wanted.thrusts.keys()
    for name, value in wanted.thrusts.items():
        assert_allclose(found.thrusts[name], value, rtol=0, atol=1e-12 * size)
    assert found.residual < 1e-12
    return found


@first_daily(2, "direction", ["frictionless", "extending", "retracting"])
def test_the_hitch_with_friction_everywhere(direction):
    loads = ["load", "own", "relief", *PINS]
    check(Rubbing().sweep(301), loads, direction=direction)
    check(Rubbing(OB=np.linspace(0.29, 0.31, 3)).sweep(101), loads, direction=direction)


def test_speeds_go_into_the_kernel():
    slow, quick = (check(Rubbing().sweep(301), rates={"S": rate}) for rate in (0.05, 0.10))
    assert_allclose(quick.thrusts["damper"], 2.0 * slow.thrusts["damper"], rtol=1e-12)


@pytest.mark.parametrize("direction", ["frictionless", "extending", "retracting"])
def test_a_rail_that_rubs_and_a_law_of_ones_own(direction):
    check(Press().sweep(301), direction=direction)


@pytest.mark.parametrize("direction", ["frictionless", "extending"])
def test_cylinders_beside_angles_and_gas(direction):
    check(Crane().sweep(u=16, v=16), direction=direction, drive="u" if direction != "frictionless" else None)
    path = Crane().at(u=np.linspace(0.1, 0.9, 301), v=np.linspace(-1.6, -0.7, 301))
    check(path, direction=direction)


def test_poses_out_of_reach_and_refused_ones_are_nan():
    hitch = Rubbing()
    motion = hitch.at(S=np.linspace(-0.1, 0.5, 301), unreachable="nan")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SingularWarning)
        found, wanted = both(motion, ["load", "own", *PINS], direction="extending")
    assert 0 < np.isnan(wanted.drives["S"]).sum() < 301
    assert_array_equal(np.isnan(found.drives["S"]), np.isnan(wanted.drives["S"]))
    good = np.isfinite(wanted.drives["S"]) & (motion.strokes["S"] < 0.40)
    assert_allclose(found.drives["S"][good], wanted.drives["S"][good], rtol=1e-9)


def test_where_friction_jams_it_goes_on_by_newton():
    """Coefficients that do not contract: the same solution, the same locked poses."""
    wild = [PinFriction(point, radius=0.05, coefficient=0.9) for point in "AOEMBCDFK"]
    motion = Rubbing().at(S=np.linspace(0.0, 0.25, 301), unreachable="nan")
    found, wanted = both(motion, ["load", *wild], direction="extending")
    assert_array_equal(found.locked, wanted.poses.full(wanted.locked.astype(float)) == 1.0)
    good = ~found.locked
    assert good.any()
    assert_allclose(found.drives["S"][good], wanted.drives["S"][good], rtol=1e-9)


def test_arrays_over_the_poses_are_solved_on_arrays():
    motion = Rubbing().sweep(301)
    pull = Force("F", (np.linspace(0.0, 5.0, 301) * kN, 0.0))
    found = check(motion, ["load", pull])
    (row,) = [row for row in max_table(found) if row.point == "M"]
    assert row.strokes["S"] in motion.strokes["S"]


@pytest.mark.slow
def test_the_largest_force_is_found_between_the_poses():
    class Knot(ThreePointHitch):
        """A spring that stiffens in a knot of half a millimetre of its length."""

        bump = Between("O", "D", lambda length, rate: -5e5 * np.maximum(1.0 - np.abs(length - 0.700) / 0.0004, 0.0))

    for count in (2, 5, 50):
        rows = {row.point + row.on: row for row in max_table(pin_forces(Knot().sweep(count)))}
        assert rows["Obump"].force == pytest.approx(5e5, rel=1e-6)
        assert Knot().at(S=rows["Obump"].strokes["S"]).distance("O", "D") == pytest.approx(0.700, abs=1e-8)


def test_what_no_cylinder_holds_is_refused():
    class Boom(Mechanism):
        phi = Stroke(-80 * deg, 80 * deg)
        O, K = Ground(0.0, 1.0), Ground(0.5, 0.2)
        B = Crank(O, OB=0.8, angle=phi)
        load = Weight(B, mass=100)
        lift = Cylinder(K, B, bore=80 * mm, rod=40 * mm)

    dead = float(np.arctan2(-0.8, 0.5))
    for poses in ([dead], [dead, 0.1], np.append(np.linspace(-0.9, 1.0, 300), dead)):
        with pytest.raises(SingularError, match="length of lift stands still"):
            pin_forces(Boom().at(phi=poses))
        with pytest.raises(SingularError, match="length of lift stands still"):
            Boom.lift.thrust(Boom().at(phi=poses))
    beside = Boom().at(phi=np.append(np.linspace(-0.9, 1.0, 300), dead), unreachable="nan")
    assert np.isnan(pin_forces(beside).thrusts["lift"]).tolist() == [False] * 300 + [True]


def test_driven_points_and_lone_pins():
    class Cart(Mechanism):
        S = Stroke(0.0, 0.5)
        rail = Guide((0.0, 0.0), angle=10 * deg)
        C = OnGuide(rail, at=S)
        O = Ground(0.2, 0.8)
        D = Dyad(O, C, OD=0.7, CD=0.6, side=RIGHT)
        load = Weight(D, mass=40)
        rub = GuideFriction(C, coefficient=0.1)

    for direction in ("frictionless", "extending"):
        check(Cart().sweep(301), direction=direction)


def chain(count):
    """Return a machine of so many dyads in a row, each on a ground point of its own."""
    members = {"S": Stroke(0.0, 0.3), "L": Dimension(0.7), "O0": Ground(0.0, 0.0), "Q0": Ground(1.0, 0.0)}
    members["P0"] = Dyad("O0", "Q0", O0P0=ref("L") + ref("S"), Q0P0=0.9, side=LEFT)
    for k in range(1, count):
        members[f"G{k}"] = Ground(1.0 + k, 0.0)
        members[f"P{k}"] = Dyad(f"P{k - 1}", f"G{k}", side=LEFT, **{f"P{k - 1}P{k}": 1.0 + 0.01 * (k % 3), f"G{k}P{k}": 0.9})
    members["load"] = Weight(f"P{count - 1}", mass=100.0)
    return type(f"Chain{count}", (Mechanism,), members)


@pytest.mark.slow
def test_the_program_of_a_long_chain_grows_with_its_length():
    sizes = []
    for count in (4, 8, 16):
        machine = chain(count)
        check(machine().sweep(11))
        kernels = [each for each in machine.plan._kernels.values() if isinstance(each, ForceProgram)]
        assert len(kernels) == 1
        sizes.append(len(kernels[0].kernel.plan.pose))
    assert sizes[2] - sizes[1] < 2.1 * (sizes[1] - sizes[0])


def test_a_few_poses_ask_the_same_program_as_many_in_every_case_and_direction(monkeypatch):
    hitch = Rubbing(OB=0.31)
    whole = pin_forces(hitch.sweep(301), ["load", "own", *PINS], direction="extending").force("E", on="frame")
    solved = []
    monkeypatch.setattr(np.linalg, "solve", lambda *given: solved.append(given))
    few = pin_forces(hitch.at(S=hitch.sweep(301).strokes["S"][::50]), ["load", "own", *PINS], direction="extending")
    assert_allclose(few.force("E", on="frame"), whole[:, ::50], rtol=1e-13)
    before = sum(isinstance(each, ForceProgram) for each in Rubbing.plan._kernels.values())
    for case in (None, LoadCase("heavy", scale={"load": 2.0}), LoadCase("uphill", slope=10 * deg)):
        pin_forces(hitch.sweep(5), ["load", "own", *PINS], case=case, direction="extending")
    assert sum(isinstance(each, ForceProgram) for each in Rubbing.plan._kernels.values()) == before
    assert not solved
