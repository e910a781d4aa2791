"""Several cylinders that work both ways on one circuit, oil at one pose, conditions that are compared, gas beside a pump."""

import numpy as np
import pytest

from hydraulics import (
    Accumulator,
    AccumulatorBlock,
    Cylinder,
    FloatCircuit,
    LiftCircuit,
    OilLine,
    Pump,
    Relief,
    Tank,
    fits,
    pressure,
    reserve,
)
from linkage import LEFT, RIGHT, Dyad, Force, Ground, Guide, Mechanism, OnGuide, OnLink, Over, Stroke, Weight, ramp, report
from linkage.errors import DefinitionError
from linkage.motion import least, most, pose_sentence, reachable
from linkage.motion.motion_verdicts import told_apart
from linkage.units import bar, deg, litre, minute, mm
from tests.members import told_by


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


def hung(force, works, efficiency, way, top=None):
    """Return a post that a force acts on along it, on a cylinder below and, where said, on one above that is on the same line."""

    class Hung(Mechanism):
        S = Stroke(0.0, 0.4)
        O, Q = Ground(0, 0), Ground(0, 3.0)
        rail = Guide(O, angle=90 * deg)
        P = OnGuide(rail, at=1.0 + S)
        load = Force(P, (0.0, force))
        ram = Cylinder(O, P, bore=100 * mm, rod=60 * mm, works=works)
        over = top and Cylinder(Q, P, bore=80 * mm, rod=50 * mm, works=top)
        line = LiftCircuit([ram, over] if top else ram, 180 * bar, mechanical_efficiency=efficiency)
        runs = Over.path(S=ramp(*way, speed=0.1, acceleration=0.5))

    return Hung()


@pytest.mark.parametrize("seed", range(4))
def test_the_way_back_of_both_sides_is_that_of_the_one_that_the_load_asks_for(seed):
    random = np.random.default_rng(seed)
    force, k_m = random.choice([-1.0, 1.0]) * random.uniform(10e3, 50e3), random.uniform(0.7, 0.95)
    down, one, other = ((0.38, 0.02), "piston", "rod") if force < 0.0 else ((0.02, 0.38), "rod", "piston")
    areas = [np.pi / 4.0 * (bore**2 - (works == "rod") * rod**2) for works, bore, rod in ((one, 0.1, 0.06), (other, 0.08, 0.05))]
    for top, area in ((None, areas[0]), ("other", sum(areas))):  # the one above goes in as the one below comes out
        right = abs(force) / area * k_m  # the load drives: of its force friction leaves so much
        for works, above in ((one, other), ("both", "both")):
            machine = hung(force, works, k_m, down, top and above)
            found = machine.line.lowering(machine.sweep(3))
            assert np.allclose(found.working, right, rtol=1e-9) and found.by_itself.all()
            assert not machine.line.lowering(machine.sweep(3), resistance=1.01 * right).by_itself.any()
            assert all(each.ok for each in machine.verdicts() if each.rule.startswith("lowering"))
            back = hung(force, works, k_m, down[::-1], top and above).verdicts()
            assert {each.ok for each in back if each.rule.startswith("lowering")} == {None}  # it is lifted all the way
    mixed = hung(force, "both", k_m, down, one)  # the one above carries nothing, and goes along
    for ram in ("ram", "over"):
        found = mixed.line.lowering(mixed.sweep(3), cylinder=ram)
        assert np.allclose(found.working, abs(force) / areas[0] * k_m, rtol=1e-9) and found.by_itself.all()
    (told,) = (each for each in mixed.verdicts() if each.rule.startswith("lowering"))
    assert told.ok and told.rule == "lowering ram"


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


class Hung(Mechanism):
    """A load that a cylinder holds from above, by its annulus."""

    S = Stroke(0.0, 0.3)
    O, A = Ground(0.0, 1.0), Ground(0.1, 1.8)
    B = Dyad(A, O, AB=0.6 + S, OB=0.5, side=LEFT)
    G = OnLink(O, B, OG=1.0)
    load = Weight(G, mass=2000)
    ram = Cylinder(A, B, bore=63 * mm, rod=36 * mm, works="both")
    supply = Pump(160 * bar, flow=40 * litre / minute)


class OnTwoLines(Hung):
    out, back = OilLine("ram.piston_side", "supply"), OilLine("ram.rod_side", "supply")


class OnOneCircuit(Hung):
    back = LiftCircuit("ram", "supply")


def test_a_line_for_each_side_works_one_way_at_every_door():
    two, one = OnTwoLines(), OnOneCircuit()
    poses = [each.at(S=0.3) for each in (two, one)]
    assert np.isnan(OnTwoLines.out.reserve(poses[0])) and np.isnan(poses[0][reserve("ram", circuit="out")])
    asked = [least(reserve("ram", circuit="out")), most(pressure("ram", circuit="out")), least(reserve("ram", circuit="back"))]
    idle, none, low = two.answers(asked)
    assert np.isnan(idle.value) and none.value == 0.0
    found = one.answers([least(reserve("ram")), most(pressure("ram"))])
    assert low.value == pytest.approx(found[0].value, rel=1e-12)
    assert two.answers([most(pressure("ram"))])[0].value == pytest.approx(found[1].value, rel=1e-12)
    sentence = pose_sentence(poses[0])
    assert "out" not in sentence and sentence.replace(" back", "") == pose_sentence(poses[1])
    out, back = ({each.rule: each for each in told_by(two, name)} for name in ("out", "back"))
    assert out["lifting"].ok is None and back["lifting"].ok is False
    assert out["holding"].sentence == "with the pump off, the piston side holds no pressure."


def test_a_table_has_the_pressure_and_the_reserve_of_a_cylinder_with_a_line_for_each_side():
    columns = [machine.ram.columns(machine().sweep(5)) for machine in (OnTwoLines, OnOneCircuit)]
    assert [each.name for each in columns[0]] == ["thrust", "pressure", "reserve"]
    for two, one in zip(*columns, strict=True):
        assert two.values == pytest.approx(one.values, rel=1e-14)
    gauges = OnTwoLines.ram.gauges(OnTwoLines().plan)
    assert OnTwoLines().sweep(5)[gauges["most"]] == pytest.approx(np.full(5, 160 * bar))


def test_a_pump_a_valve_or_a_tank_on_no_line_is_remarked():
    class Spare(OnTwoLines):
        valve, spare, tank, other = Relief(200 * bar), Pump(180 * bar), Tank(), Relief(150 * bar)
        out = OilLine("ram.piston_side", "supply", "other")

    judge, members = Spare().judge(), Spare().plan.members
    told = {name: members[name].verdicts(judge) for name in ("valve", "spare", "tank", "other", "supply")}
    assert [name for name, found in told.items() if found] == ["valve", "spare", "tank"]
    assert told["valve"][0] == "valve is on no line and does nothing; put it on one: OilLine(ram.piston_side, valve)."


def test_who_shares_one_rule_is_named_in_all_of_its_rules():
    rules = [("lifts", "lifting"), ("lifts", "lowering"), ("out", "lifting"), ("valve", "setting"), ("ram", "length")]
    members = {**dict.fromkeys(["lifts", "out"], OnTwoLines.out), "valve": Relief(200 * bar), "ram": OnTwoLines.ram}
    assert told_apart(rules, members) == {*rules[:3]} == told_apart(rules[:2], members) | {rules[2]}  # also where the other says nothing
