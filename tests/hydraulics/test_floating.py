"""The closed line of cylinder and accumulators as a force element."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Accumulator, AccumulatorBlock, Cylinder, FloatCircuit, isothermal, pressure
from linkage import RIGHT, Crank, DefinitionError, Dimension, Dyad, Ground, Mechanism, OnLink, Stroke, distance, drawn
from linkage.loads import LoadCase, Weight
from linkage.reports.values import dimension_unit
from linkage.statics import driving_force
from linkage.units import bar, deg, kN, litre, mm
from mechanisms.classics.stephenson_three import StephensonThreeFar
from tests.for_all import for_all
from tests.members import told_by

BLOCK = AccumulatorBlock([Accumulator(4 * litre, 50 * bar), Accumulator(4 * litre, 25 * bar)], isothermal)


class Carried(Mechanism):
    """An arm carried by a cylinder on accumulators."""

    S = Stroke(0.00, 0.25)
    S0 = Dimension(0.10)
    A = Ground(0.20, 0.55)
    O = Ground(0.30, 1.15)
    B = Dyad(A, O, AB=0.50 + S, OB=0.30, side=RIGHT)
    G = OnLink(O, B, OG=0.9)
    load = Weight(G, mass=600)
    ram = Cylinder(A, B, bore=63 * mm, rod=40 * mm, count=2)
    line = FloatCircuit(ram, BLOCK, charge_pressure=60 * bar, at=S0, seal_friction=3 * bar)


class Pulled(Carried):
    """The rod side on the accumulators."""

    ram = Cylinder("A", "B", bore=63 * mm, rod=40 * mm, works="rod")


class Turned(Mechanism):
    """A crank whose cylinder no step declares: it comes out and goes in."""

    phi = Stroke(-80 * deg, 80 * deg)
    A = Ground(-1.0, 0.0)
    O = Ground(0.0, 0.0)
    P = Crank(O, OP=0.2, angle=phi)
    ram = Cylinder(A, P, bore=63 * mm, rod=40 * mm)
    line = FloatCircuit(ram, BLOCK, charge_pressure=60 * bar, at=30 * deg, seal_friction=3 * bar)


def test_the_pressure_follows_the_travel():
    motion, area = Carried().sweep(11), Carried.ram.size.area
    withdrawn = (motion.strokes["S"] - 0.10) * area
    assert_allclose(Carried.line.withdrawn(motion), withdrawn, atol=1e-15)
    assert_allclose(Carried.line.pressure(motion), BLOCK.pressure(60 * bar, withdrawn))
    assert_allclose(Carried.line.pressure(Carried(S0=0.2).at(S=0.2)), 60 * bar)
    assert_allclose(Carried.line.oil(motion), withdrawn, atol=1e-15)


def test_a_load_case_that_shuts_the_line_has_the_pressure_under_its_load():
    shut = type("Shut", (Carried,), {"parked": LoadCase("parked", scale={"load": 2.0}, shut=["line"])})
    motion = shut().at(S=[0.05, 0.2])
    held = shut.line.pressure(motion, case="parked")
    assert_allclose(held, motion[pressure("ram", case="parked")], rtol=1e-12)
    assert_allclose(held * Carried.ram.size.area, shut.ram.thrust(motion, case="parked"), rtol=1e-12)
    assert_allclose(shut.line.pressure(motion), shut.line.line_pressure(motion), rtol=1e-15)


def test_the_rod_side_fills_as_the_cylinder_comes_out():
    motion = Pulled().sweep(11)
    pressure = Pulled.line.pressure(motion)
    assert np.all(np.diff(pressure) > 0.0)
    assert_allclose(Pulled.line.thrust(motion), -pressure * Pulled.ram.size.area)


def test_seals_take_their_pressure_against_the_motion():
    for machine in (Carried, Pulled):
        motion, size = machine().sweep(5), machine.ram.size
        free, up, down = (machine.line.thrust(motion, rates) for rates in ({}, {"S": 1.0}, {"S": -1.0}))
        assert_allclose(free - up, 3 * bar * size.area)
        assert_allclose(down - free, 3 * bar * size.area)


def test_as_a_load_it_stands_for_the_drive():
    motion = Carried().sweep(11)
    for direction, rates in (("frictionless", {}), ("extending", {"S": 1.0}), ("retracting", {"S": -1.0})):
        left = driving_force(motion, direction=direction)
        assert_allclose(left + Carried.line.thrust(motion, rates), driving_force(motion, ["load"]), rtol=1e-9)


def test_work_round_a_cycle_is_what_the_seals_take():
    motion = Carried().sweep(201)
    S, size = motion.strokes["S"], Carried.ram.size
    up, down = (Carried.line.thrust(motion, {"S": sense}) for sense in (1.0, -1.0))
    lost = np.sum(0.5 * ((down - up)[1:] + (down - up)[:-1]) * np.diff(S))
    assert_allclose(lost, 2 * 3 * bar * size.area * 0.25, rtol=1e-9)


def test_work_without_friction_is_what_the_gas_gives():
    motion = Carried().sweep(2001)
    S, area = motion.strokes["S"], Carried.ram.size.area
    thrust = Carried.line.thrust(motion)
    work = np.sum(0.5 * (thrust[1:] + thrust[:-1]) * np.diff(S))
    volume = BLOCK.gas_volume(60 * bar) + (S[[0, -1]] - 0.10) * area
    fine = np.linspace(*volume, 20001)
    pressure = BLOCK.pressure(60 * bar, fine - BLOCK.gas_volume(60 * bar))
    assert_allclose(work, np.sum(0.5 * (pressure[1:] + pressure[:-1]) * np.diff(fine)), rtol=1e-6)


def test_a_cylinder_that_no_step_declares():
    motion = Turned().sweep(9)
    length = motion.distance("A", "P")
    charged = Turned().at(phi=30 * deg).distance("A", "P")
    assert_allclose(Turned.line.pressure(motion), BLOCK.pressure(60 * bar, (length - charged) * Turned.ram.size.area))
    friction = (Turned.line.thrust(motion) - Turned.line.thrust(motion, {"phi": 1.0})) / (3 * bar * Turned.ram.size.area)
    assert_allclose(friction[:4], 1.0)
    assert_allclose(friction[5:], -1.0)


def test_many_charges_at_once():
    batch = Carried(**{"line.charge_pressure": np.array([40.0, 60.0, 80.0]) * bar}).sweep(5)
    pressure = Carried.line.pressure(batch)
    assert pressure.shape == (3, 5)
    for row, charge in enumerate((40.0, 60.0, 80.0)):
        assert_allclose(pressure[row], Carried.line.pressure(Carried(**{"line.charge_pressure": charge * bar}).sweep(5)))


def test_a_block_may_follow_the_design():
    def block(motion):
        return AccumulatorBlock([Accumulator(motion.inputs["V"], 25 * bar)])

    soft = type("Soft", (Carried,), {"V": Dimension(0.004), "line": FloatCircuit("ram", block, charge_pressure=60 * bar, at=0.1)})
    small, large = (soft.line.pressure(soft(V=V).sweep(5)) for V in (0.004, 0.02))
    assert np.ptp(large) < np.ptp(small)


class Followed(Carried):
    """The same line, its accumulators and its movement as dimensions."""

    V, p, q = Dimension(4 * litre, unit="l"), Dimension(50 * bar, unit="bar"), Dimension(25 * bar, unit="bar")
    n, air = Dimension(1.0), Dimension(101325.0)
    block = AccumulatorBlock([Accumulator(V, p), Accumulator("V", charge=q)], isothermal, air)
    line = FloatCircuit("ram", block, charge_pressure=60 * bar, at=Carried.S0, seal_friction=3 * bar, exponent=n)


def test_charges_and_volumes_may_follow_dimensions():
    assert np.array_equal(Followed.line.pressure(Followed().sweep(9)), Carried.line.pressure(Carried().sweep(9)))
    larger = AccumulatorBlock([Accumulator(5 * litre, 40 * bar), Accumulator(5 * litre, 25 * bar)], isothermal, 0.0)
    motion = Followed(V=5 * litre, p=40 * bar, air=0.0).sweep(9)
    assert_allclose(Followed.line.pressure(motion), larger.pressure(60 * bar, Followed.line.withdrawn(motion)), rtol=1e-15)


def test_fast_movement_starts_from_the_settled_charge():
    motion = Followed(n=1.4).sweep(9)
    assert_allclose(Followed.line.pressure(motion), BLOCK.fast_pressure(60 * bar, Followed.line.withdrawn(motion)), rtol=1e-14)


def test_slow_and_fast_designs_at_once_are_each_their_own():
    batch = Followed(n=np.array([1.0, 1.2, 1.4]), V=np.array([3.0, 4.0, 5.0]) * litre)
    pressure = Followed.line.pressure(batch.sweep(5))
    for row, (n, V) in enumerate(((1.0, 3.0), (1.2, 4.0), (1.4, 5.0))):
        assert_allclose(pressure[row], Followed.line.pressure(Followed(n=n, V=V * litre).sweep(5)), rtol=1e-14)


def test_block_that_follows_is_written_as_it_is_said():
    assert str(Followed.line) == (
        "FloatCircuit(ram, AccumulatorBlock([Accumulator(volume=V, charge=p), Accumulator(volume=V, charge=q)], gas=isothermal, "
        "atmosphere=air), charge_pressure=6000000.0, at=S0, seal_friction=300000.0, exponent=n)"
    )
    assert Followed.block.sized(Followed(V=3 * litre).sweep(3)).accumulators[0].volume == 3 * litre
    assert BLOCK.sized(Followed().sweep(3)) is BLOCK


@for_all(
    ("ask", "words"),
    [
        (lambda: Followed.block.pressure(60 * bar), "it follows air, V, p, V, q; ask sized"),
        (lambda: Followed.block.gas_volume(60 * bar), "ask sized"),
        (lambda: Followed.block.checks(20 * bar, 80 * bar, 90 * bar), "ask sized"),
        (lambda: Followed.line.pressure(Followed(air=np.array([0.0, 1e5])).sweep(3)), "atmosphere is one number for all designs"),
        (lambda: Followed.line.pressure(Followed(V=0.0).sweep(3)), "Every accumulator of the block has the volume 0"),
        (lambda: Followed.line.pressure(Followed(n=0.5).sweep(3)), "outside 1..10"),
        (lambda: type("Gone", (Followed,), {"V": None}), "'V'"),
    ],
)
def test_block_that_follows_says_what_it_needs(ask, words):
    with pytest.raises(DefinitionError, match=words):
        ask()


def test_cylinder_that_follows_a_dimension_is_judged_for_one_design():
    machine = type("Thick", (Carried,), {"thick": Dimension(36 * mm), "ram": Cylinder("A", "B", bore=63 * mm, rod="thick")})
    assert machine.ram.standard(machine().sweep(3))
    assert machine.ram.standard(machine(thick=40.1 * mm).sweep(3)).ok is None


def test_unreached_poses_stay_nan():
    motion = Carried().at(S=np.array([0.0, 0.1, 1.0]), unreachable="nan")
    assert np.isnan(Carried.line.pressure(motion)).tolist() == [False, False, True]


@for_all(
    ("make", "words"),
    [
        (lambda: FloatCircuit(Carried.ram, "block", charge_pressure=60 * bar), "no AccumulatorBlock"),
        (lambda: FloatCircuit(Carried.ram, BLOCK, charge_pressure=60 * bar, seal_friction=-1.0), "negative"),
        (lambda: FloatCircuit(Carried.ram, BLOCK, charge_pressure=float("inf")), "finite"),
        (lambda: type("Wrong", (Carried,), {"line": FloatCircuit("B", BLOCK, charge_pressure=60 * bar)}), "no Cylinder"),
        (lambda: Carried.line.pressure(Carried(**{"line.charge_pressure": 10 * bar}).sweep(3)), "rigid"),
        (lambda: Carried.line.pressure(Carried(**{"ram.bore": 300 * mm, "ram.rod": 40 * mm}).sweep(3)), "leaves no gas"),
    ],
)
def test_what_cannot_be_is_refused(make, words):
    with pytest.raises(DefinitionError, match=words):
        make()


def test_it_carries_about_half_of_the_load():
    motion = Carried().at(S=0.1)
    assert 5 * kN < Carried.line.thrust(motion) < 50 * kN


# -- the charging stroke -------------------------------------------------------------------------------------


class TwoStrokes(Mechanism):
    """An arm that S lifts, a crank on it that phi turns; one ram by a driven length, one by points alone, one across both."""

    S, phi = Stroke(0.05, 0.20), Stroke(0.2, 1.4)
    sketch = drawn(S=0.08, phi=0.9)
    A, O, H = Ground(0.20, 0.55), Ground(0.30, 1.15), Ground(-0.4, 0.6)
    B = Dyad(A, O, AB=0.50 + S, OB=0.30, side=RIGHT)
    G = OnLink(O, B, OG=0.9)
    P = Crank(G, GP=0.2, angle=phi)
    driven, apart, across = (Cylinder(*ends, bore=63 * mm, rod=40 * mm) for ends in ((A, B), (H, G), (H, P)))
    line_driven, line_apart, line_across = (
        FloatCircuit(ram, replace(BLOCK), charge_pressure=60 * bar, at=0.12, seal_friction=3 * bar) for ram in ("driven", "apart", "across")
    )


@pytest.mark.parametrize("name", ["driven", "apart", "across"])
def test_line_has_its_charge_where_its_stroke_is_at_and_others_at_the_sketch(name):
    """Charged at S = 0.12 with phi as sketched, wherever the motion is: what has left is the change of length since then."""
    line, ram = getattr(TwoStrokes, f"line_{name}"), getattr(TwoStrokes, name)
    charged = TwoStrokes().at(S=0.12, phi=0.9).distance(ram.A.name, ram.B.name)
    motion = TwoStrokes().sweep(S=4, phi=3)
    withdrawn = (motion.distance(ram.A.name, ram.B.name) - charged) * ram.size.area
    assert_allclose(line.withdrawn(motion), withdrawn, rtol=0, atol=1e-16)
    assert_allclose(line.pressure(motion), BLOCK.pressure(60 * bar, withdrawn), rtol=1e-12)
    assert_allclose(line.pressure(TwoStrokes().at(S=0.12, phi=0.9)), 60 * bar, rtol=1e-13)


def test_each_design_is_charged_with_its_own_lengths():
    batch = TwoStrokes(GP=np.array([0.1, 0.2, 0.3]), OG=np.array([0.8, 0.9, 1.0])).at(S=np.array([0.06, 0.15]), phi=1.0)
    for row, (GP, OG) in enumerate(((0.1, 0.8), (0.2, 0.9), (0.3, 1.0))):
        alone = TwoStrokes(GP=GP, OG=OG).at(S=np.array([0.06, 0.15]), phi=1.0)
        assert_allclose(TwoStrokes.line_across.pressure(batch)[row], TwoStrokes.line_across.pressure(alone), rtol=1e-14)


class OnGroup(StephensonThreeFar):
    """A ram between the frame and a pin that only a group of links places."""

    ram = Cylinder("O", "B", bore=25 * mm, rod=16 * mm)
    line = FloatCircuit(ram, BLOCK, charge_pressure=60 * bar, at=1.3, seal_friction=3 * bar)


def test_line_on_a_group_of_links():
    motion, charged = OnGroup().sweep(7), OnGroup().at(psi=1.3).distance("O", "B")
    withdrawn = (motion.distance("O", "B") - charged) * OnGroup.ram.size.area
    assert np.ptp(withdrawn) > 1e-6
    assert_allclose(OnGroup.line.withdrawn(motion), withdrawn, rtol=0, atol=1e-16)
    batch = OnGroup(DF=np.array([0.1006, 0.1010])).sweep(5)
    for row, DF in enumerate((0.1006, 0.1010)):
        assert_allclose(OnGroup.line.withdrawn(batch)[row], OnGroup.line.withdrawn(OnGroup(DF=DF).sweep(5)), rtol=0, atol=1e-15)


def test_a_charging_stroke_that_is_an_angle_is_shown_and_taken_as_one():
    assert dimension_unit(OnGroup(), "line.at") == "deg" and OnGroup(**{"line.at": 70 * deg})["line.at"] == 70 * deg
    with pytest.raises(DefinitionError, match=r"line\.at=0\.07 was given as a length; expected is a value of angle"):
        OnGroup(**{"line.at": 70 * mm})
    with pytest.raises(DefinitionError, match=r"Wrong: line\.at=0\.07 was given as a length; expected is a value of angle"):
        type("Wrong", (OnGroup,), {"line": FloatCircuit(OnGroup.ram, BLOCK, charge_pressure=60 * bar, at=70 * mm)})


@pytest.mark.parametrize(
    ("machine", "settings", "words"),
    [
        (TwoStrokes, {"line_apart.at": 0.9}, r"cannot be assembled at the charging stroke S = 0\.9\."),
        (OnGroup, {"line.at": 3.0}, r"cannot be assembled at the charging stroke psi = 3\."),
        (OnGroup, {"line.at": np.array([1.2, 1.3])}, "one charging stroke for all designs"),
    ],
)
def test_charging_stroke_out_of_reach_is_refused(machine, settings, words):
    line = machine.line if machine is OnGroup else machine.line_apart
    with pytest.raises(DefinitionError, match=words):
        line.withdrawn(machine(**settings).at(**dict(machine.plan.sketch_strokes)))


def test_seals_act_against_the_growth_of_the_length():
    """Whichever stroke moves it, and not at all at rest: with rates of both strokes the sign is that of the length's rate."""
    motion = TwoStrokes().sweep(S=3, phi=3)
    size, line = TwoStrokes.across.size, TwoStrokes.line_across
    free = line.thrust(motion)
    assert_allclose(free, line.pressure(motion) * size.area, rtol=1e-14)
    for rates in ({"S": 0.02, "phi": -0.3}, {"S": -0.02, "phi": 0.1}, {"phi": 1.0}):
        grows = sum(motion.ratio(distance("H", "P"), wrt=name) * rate for name, rate in rates.items())
        assert np.ptp(np.sign(grows)) == 2.0 or len(rates) == 2
        assert_allclose(free - line.thrust(motion, rates), np.sign(grows) * 3 * bar * size.area, rtol=1e-9)


@pytest.mark.slow
def test_a_load_case_may_leave_a_gas_line_out():
    """In such a case its cylinder carries nothing: it is judged in the others, and a value in that case is refused in words."""
    from mechanisms.header_balancer import ThreeHeaders

    found = [each.sentence for each in told_by(ThreeHeaders(), "lift1", "lift2", "lift3") if each.rule == "buckling"]
    assert len(found) == 3 and all("case plain" in each for each in found)
    motion = ThreeHeaders().sweep(3)
    assert np.all(ThreeHeaders.lift1.thrust(motion, case="first") == ThreeHeaders.lift1.thrust(motion))
    with pytest.raises(DefinitionError, match="lift1 carries nothing here"):
        ThreeHeaders.lift1.thrust(motion, case="second")
