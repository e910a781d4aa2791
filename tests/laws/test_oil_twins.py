"""One thing in the place of another: joined lines, halves of a cylinder, both sides, double lines, parts lists; what is refused."""

import pickle

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Accumulator, AccumulatorBlock, Cylinder, LiftCircuit, OilLine, Pump, Relief, pressure
from linkage import (
    LEFT,
    RIGHT,
    DefinitionError,
    Dimension,
    Dyad,
    Ground,
    Guide,
    Link,
    Mechanism,
    OnGuide,
    OnLink,
    Part,
    Pin,
    PinFriction,
    Stroke,
    Weight,
    deg,
    drawn,
    driving_force,
    mm,
    pin_forces,
    ref,
)
from linkage.statics import held_verdict
from linkage.units import bar, litre
from tests.for_all import first_daily, for_all
from tests.hydraulics.test_oil import Axle, Levelled
from tests.members import told_by

VALVE = 200 * bar


def vessel(count=1):
    return AccumulatorBlock([Accumulator(volume=4 * litre, charge=40 * bar) for _ in range(count)])


class OnOne(Axle):
    line = OilLine("left", "right", vessel(2), charge_pressure=90 * bar, at=dict(S1=0.0, S2=0.0))


class OnTwo(Axle):
    one = OilLine("left", vessel(), charge_pressure=90 * bar, at=dict(S1=0.0, S2=0.0))
    two = OilLine("right", vessel(), charge_pressure=90 * bar, at=dict(S1=0.0, S2=0.0))


class Crossed(Axle):
    one = OilLine("left.piston_side", "right.rod_side", vessel(), charge_pressure=90 * bar, at=dict(S1=0.0, S2=0.0))
    two = OilLine("right.piston_side", "left.rod_side", vessel(), charge_pressure=90 * bar, at=dict(S1=0.0, S2=0.0))


def test_lines_of_one_pressure_may_be_joined_and_rolling_shifts_oil_alone():
    bump = np.array([-0.06, -0.02, 0.05])
    joined, apart = OnOne().at(S1=bump, S2=bump), OnTwo().at(S1=bump, S2=bump)
    for name in ("left", "right"):
        assert_allclose(joined.plan.members[name].thrust(joined), apart.plan.members[name].thrust(apart), rtol=1e-13)
    rolled = OnOne().at(S1=bump, S2=-bump)
    assert_allclose(OnOne.line.pressure(rolled), 90 * bar, rtol=1e-12)
    crossed = Crossed.one.pressure(Crossed().at(S1=bump, S2=-bump))
    assert np.all(np.abs(crossed / bar - 90.0) > 5.0) and np.all((crossed > 90 * bar) == (bump < 0.0))


class Halves(Levelled):
    """The slave as two on the same pins, of half the area each."""

    slave = None
    a, b = (Cylinder("U", "W", bore=100 / 2**0.5 * mm, rod=56 / 2**0.5 * mm) for _ in range(2))
    level = OilLine("master.piston_side", a.piston_side, b.piston_side, filled=dict(a=0.72))
    W = Dyad("U", "T", UW=a.length, TW=0.35, side=RIGHT)


def test_a_cylinder_may_be_two_of_half_its_area():
    whole, halves = Levelled().sweep(7), Halves().sweep(7)
    assert_allclose(halves["F"], whole["F"], rtol=0, atol=1e-13)
    assert_allclose(Halves.level.pressure(halves), Levelled.level.pressure(whole), rtol=1e-11)
    thrusts = pin_forces(halves).thrusts
    for name in "ab":
        assert_allclose(2.0 * thrusts[name], pin_forces(whole).thrusts["slave"], rtol=1e-11)
    assert_allclose(thrusts["lift"], pin_forces(whole).thrusts["lift"], rtol=1e-11)


class Arm(Mechanism):
    """A load that goes over the centre: its cylinder pulls, then pushes."""

    S = Stroke(0.75, 1.25)
    O, A = Ground(0.0, 0.0), Ground(-0.8, 0.1)
    B = Dyad(A, O, AB=S, OB=0.5, side=RIGHT)
    G = OnLink(O, B, OG=1.5)
    arm = Link(O, B, G)
    load = Weight(G, mass=800)
    lift = Cylinder(A, B, bore=100 * mm, rod=56 * mm)


class Both(Arm):
    lift = Cylinder("A", "B", bore=100 * mm, rod=56 * mm, works="both")
    circuit = LiftCircuit("lift", pressure=180 * bar, relief=VALVE)


class Sides(Arm):
    first, second, valve, other = Pump(180 * bar), Pump(60 * bar), Relief(VALVE), Relief(70 * bar)
    out, back = OilLine("lift.piston_side", first, valve), OilLine("lift.rod_side", second, other)


def test_both_is_both_sides_on_lines_of_their_own():
    one, two = Both().sweep(9), Sides().sweep(9)
    area, annulus = np.pi / 4.0 * 0.1**2, np.pi / 4.0 * (0.1**2 - 0.056**2)
    for way in ("frictionless", "extending", "retracting"):
        thrust = Both.lift.thrust(one, direction=way)
        assert np.array_equal(Sides.lift.thrust(two, direction=way), thrust)
        assert_allclose(Sides.out.pressure(two, direction=way), np.maximum(thrust, 0.0) / area, rtol=1e-12)
        assert_allclose(Sides.back.pressure(two, direction=way), np.maximum(-thrust, 0.0) / annulus, rtol=1e-12)
    assert_allclose(pin_forces(two).thrusts["lift"], pin_forces(one).thrusts["lift"], rtol=1e-12)
    said = [str(each) for each in Sides().verdicts()]
    assert not [each for each in said if each.startswith("FAIL")], said
    assert any("lifting back: at 60 bar the least reserve is 2.541" in each for each in said), said
    weak = Sides(**{"second.pressure": 20 * bar}).verdicts()
    assert any(str(each).startswith("FAIL lifting back") for each in weak)


class Single(Levelled):
    slave = Cylinder("U", "W", bore=100 * mm, rod=50 / 90 * 100 * mm)
    level = OilLine("master.piston_side", "slave.piston_side", filled=dict(slave=0.72), make_up=2 * bar)


class Double(Single):
    other = OilLine("master.rod_side", "slave.rod_side", make_up=1 * bar)


class Unequal(Double):
    slave = Cylinder("U", "W", bore=100 * mm, rod=56 * mm)


@pytest.mark.slow
def test_a_double_line_of_one_ratio_carries_as_a_single_one_and_of_two_locks():
    one, two = Single().sweep(9), Double().sweep(9)
    for name in ("lift", "master", "slave"):
        assert_allclose(Double.plan.members[name].thrust(two), Single.plan.members[name].thrust(one), rtol=1e-12)
        assert_allclose(pin_forces(two).thrusts[name], pin_forces(one).thrusts[name], rtol=1e-11)
    level, other = Double.level.pressure(two), Double.other.pressure(two)
    least = (level - 2 * bar) * (other - 1 * bar)
    assert np.all(level > 2 * bar - 1e-3) and np.all(other > 1 * bar - 1e-3) and np.all(np.abs(least) < 1e-6 * (level + other) ** 2)
    share = 1.0 - (50 / 90) ** 2
    assert_allclose(level - share * other, Single.level.pressure(one), rtol=0, atol=1e-8 * np.max(level + other))
    for side, of_line in (("piston", level), ("rod", other)):
        assert_allclose(two[pressure("master", side=side)], of_line, rtol=1e-9)
    with pytest.raises(DefinitionError, match=r"name one: level.pressure\(motion\)"):
        Double.master.pressure(two)
    assert [each.ok for each in told_by(Double(), "level", "other")].count(False) == 0
    motion = Unequal().sweep(3)
    for ask in (Unequal.lift.thrust, Unequal.slave.thrust, pin_forces, Unequal.level.pressure):
        with pytest.raises(DefinitionError, match=r"other locks the machine.*master to slave is 0.81 on level and 0.8159 on other"):
            ask(motion)
    assert "locks the machine" in held_verdict(Unequal().judge())


class Listed(Levelled):
    """The same as a parts list: the slave's pins, a link as long as it, and the fork by its pins."""

    W, F = Pin(near=(2.2, -1.8)), Pin(near=(1.5, -2.0))
    fork = Link("T W F", TW=0.35, TF=1.0, FTW=70 * deg)
    rod = Link("U W", UW=ref("slave.length"))


class Near(Levelled):
    W = Dyad("U", "T", UW=ref("slave.length"), TW=0.35, near=(1.6, -1.9))


def test_parts_lists_and_sketches_know_the_length_that_a_line_gives():
    whole = Levelled().sweep(5)
    for structure in (Near, Listed):
        motion = structure().sweep(5)
        assert_allclose(motion.distance("U", "W"), whole.distance("U", "W"), rtol=1e-12)
        assert np.abs(structure.level.oil(motion)).max() < 1e-15
        assert structure.plan.gruebler == 1


class Triad(Mechanism):
    """A link on three rods, of which a slave is one."""

    S = Stroke(-0.05, 0.05)
    O, K, Q, Z = Ground(0.0, 0.0), Ground(1.5, -0.2), Ground(0.2, 1.6), Ground(-0.8, -0.3)
    rail = Guide(Z, angle=90 * deg)
    X = OnGuide(rail, at=0.5 + S)
    D, E, F = Pin(near=(0.3, 0.8)), Pin(near=(1.1, 0.5)), Pin(near=(0.7, 1.3))
    plate = Link("D E F", DE=0.85, EF=0.9, DF=0.65)
    low, right, top = Link("X D", XD=1.2), Link("K E", KE=0.8), Link("Q F", QF=ref("slave.length"))
    master, slave = Cylinder(O, X, bore=80 * mm, rod=40 * mm), Cylinder(Q, F, bore=80 * mm, rod=40 * mm)
    level = OilLine(master.piston_side, slave.rod_side, filled=dict(slave=0.6))
    load = Weight(E, mass=200)
    sketch = drawn(S=0.0)


@pytest.mark.slow
def test_a_slave_may_be_found_in_a_group():
    motion, step = Triad().sweep(5), 1e-6
    assert list(Triad.plan.groups) and np.abs(Triad.level.oil(motion)).max() < 1e-16
    forces = pin_forces(motion)
    assert forces.residual < 1e-12
    for name in ("master", "slave"):
        assert_allclose(Triad.plan.members[name].thrust(motion), forces.thrusts[name], rtol=1e-10)
    energy = [200 * 9.80665 * Triad(**{"level.oil": k * step}).sweep(5)["E"][1] for k in (-2, -1, 1, 2)]
    slope = (energy[0] - 8.0 * energy[1] + 8.0 * energy[2] - energy[3]) / (12.0 * step)
    assert_allclose(motion[pressure("level")], slope, rtol=1e-8)
    assert not [each for each in Triad().verdicts() if str(each).startswith("FAIL")]


def filled_by(oil, **members):
    """Return a levelled machine with oil that follows something, with the members that say it."""
    ends = dict(filled=dict(slave=0.72), oil=oil)
    return type("Filled", (Levelled,), members | {"level": OilLine("master.piston_side", "slave.piston_side", **ends)})


@first_daily(1, "factor", [-0.5, 1.0, 2.0])
def test_oil_may_be_a_stroke_a_dimension_or_what_follows_them(factor):
    S, put_in = np.array([1.3, 1.5, 1.7]), 1e-4
    plain = Levelled(**{"level.oil": factor * put_in}).at(S=S)
    driven = filled_by("V" if factor == 1.0 else factor * ref("V"), V=Stroke(0.0, 2e-4))
    given = filled_by("V" if factor == 1.0 else factor * ref("V"), V=Dimension(put_in))
    assert (driven.plan.gruebler, given.plan.gruebler, Levelled.plan.gruebler) == (2, 1, 1)
    for motion in (driven().at(S=S, V=put_in), given().at(S=S)):
        assert_allclose(motion["F"], plain["F"], rtol=0, atol=1e-14)
        assert_allclose(motion[pressure("level")], plain[pressure("level")], rtol=1e-11)
        assert_allclose(pin_forces(motion).thrusts["slave"], pin_forces(plain).thrusts["slave"], rtol=1e-11)
        assert_allclose(motion.plan.members["level"].oil(motion), factor * put_in, rtol=1e-9)
    motion = driven().at(S=S, V=put_in)
    assert_allclose(driving_force(motion, drive="V"), factor * motion[pressure("level")], rtol=1e-10)


class Rubbing(Levelled):
    low, high = PinFriction("U", radius=0.03, coefficient=0.2), PinFriction("T", radius=0.03, coefficient=0.2)


def test_friction_in_pins_counts_in_the_lines_pressure():
    motion = Rubbing().sweep(9)
    found = {way: Rubbing.level.pressure(motion, direction=way) for way in ("frictionless", "extending", "retracting")}
    assert np.all(np.abs(found["extending"] - found["retracting"]) > 0.2 * bar)
    for way in ("extending", "retracting"):
        assert_allclose(found[way], Rubbing.master.thrust(motion, direction=way) / (np.pi / 4.0 * 0.09**2), rtol=1e-12)


@pytest.mark.slow
def test_the_verdict_on_a_line_counts_friction():
    motion = Rubbing().sweep(9)
    least = min(np.min(Rubbing.level.pressure(motion, direction=way)) for way in ("frictionless", "extending", "retracting")) / bar
    assert any(f"from {least:.4g} bar" in str(each) for each in Rubbing().verdicts())


class Whole(Mechanism):
    one = Part(Levelled, at=(0.1, 0.2), angle=0.2, mirrored=True)


class Nested(Mechanism):
    two = Part(Whole, at=(-0.4, 0.3), angle=-0.2)


def test_in_parts_in_parts_and_pickled_it_is_the_same():
    motion, plain = Nested().sweep(5), Levelled().sweep(5)
    assert_allclose(motion.distance("two.one.U", "two.one.W"), plain.distance("U", "W"), rtol=1e-13)
    own = [motion[pressure("two.one.level")], pin_forces(motion).thrusts["two.one.slave"]]
    assert own[0].shape == (5,) and np.all(np.isfinite(own[0]))
    assert_allclose(own[1], own[0] * np.pi / 4.0 * 0.1**2, rtol=1e-11)
    again = pickle.loads(pickle.dumps(Levelled())).sweep(5)
    assert np.array_equal(again[pressure("level")], plain[pressure("level")])


class Still(Levelled):
    """The master stands still within the stroke."""

    M = Ground(-0.06, -1.14)
    level = OilLine("master.piston_side", "slave.piston_side", filled=dict(slave=0.72))


def test_where_the_master_stands_still_nothing_is_dead():
    motion = Still().sweep(41)
    rate = np.gradient(motion.distance("M", "N"))
    assert np.min(rate) < 0.0 < np.max(rate)
    assert pin_forces(motion).residual < 1e-12 and np.all(np.isfinite(motion[pressure("level")]))
    assert not [each for each in Still().verdicts() if str(each).startswith("FAIL dead")]


def bad(match, **members):
    return pytest.param(members, match, id=match[:30])


BLOCK = vessel()
FILLED = dict(slave=0.72)
WRONG = [
    bad("two pressures in master's piston side", more=OilLine("master.piston_side", "lift.piston_side")),
    bad("have the same accumulators", **{side: OilLine(f"lift.{side}_side", BLOCK, charge_pressure=9e6) for side in ("piston", "rod")}),
    bad("'Q' is unknown in .*filled", level=OilLine("master.piston_side", "slave.piston_side", filled=FILLED | {"Q": 1.0})),
    bad("'supplyy' is unknown", more=OilLine("lift.piston_side", "supplyy")),
    bad("'lft' is unknown", more=OilLine("lft.piston_side", Pump(2e7))),
    bad("master says no closed; declare it", level=OilLine("master.piston_side", "slave.piston_side", filled="closed")),
    bad("leave works= out", slave=Cylinder("U", "W", bore=0.1, rod=0.056, works="rod")),
    bad("slave.length and third.length are asked", third=Cylinder("U", "G", bore=0.1, rod=0.05),
        G=Dyad("U", "A", UG=ref("third.length"), AG=2.5, side=LEFT),
        level=OilLine("master.piston_side", "slave.piston_side", "third.piston_side", filled=dict(slave=0.72, third=1.0))),
]  # fmt: skip


@for_all(("members", "match"), WRONG)
def test_wrong_lines_are_refused_in_words(members, match):
    with pytest.raises(DefinitionError, match=match):
        type("Wrong", (Levelled,), members)


def test_a_line_alone_locks_its_cylinder():
    shut = type("Shut", (Levelled,), {"shut": OilLine("lift.piston_side")})
    with pytest.raises(DefinitionError, match=r"shut locks the machine.*open it by a Tank"):
        pin_forces(shut().sweep(3))
    assert any("FAIL held" in str(each) and "shut locks" in str(each) for each in shut().verdicts())


def test_a_line_is_filled_once_for_all_designs():
    with pytest.raises(DefinitionError, match=r"filled, slave = .*one number is expected"):
        OilLine("master.piston_side", "slave.piston_side", filled=dict(slave=np.array([0.72, 0.73])))
