"""One line of oil, however it is written: its pressure, the drive's force, where it was filled, how it goes down, what counts on it."""

import math
import re
from random import Random

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import (
    Accumulator,
    AccumulatorBlock,
    Cylinder,
    HoldingValve,
    LiftCircuit,
    OilLine,
    Pump,
    Relief,
    Tank,
    Telescope,
    flow,
    lift_verdicts,
    pressure,
    reserve,
    thrust,
)
from hydraulics.lifting_line import LiftLine
from linkage import (
    LEFT,
    RIGHT,
    Acting,
    Crank,
    DefinitionError,
    Dyad,
    Force,
    Ground,
    Guide,
    Link,
    LoadCase,
    Mechanism,
    OnGuide,
    OnLink,
    Over,
    Pin,
    PinFriction,
    Rope,
    SingularError,
    Spring,
    Stroke,
    Weight,
    angle,
    distance,
    drawn,
    drive_force,
    driving_force,
    mm,
    pin_force,
    pin_forces,
    ref,
)
from linkage.documents.forces import Stop
from linkage.formulas import equations
from linkage.loads import ForceElement
from linkage.motion import least, most
from linkage.quantities import label
from linkage.reports.results import drive_columns
from linkage.statics import pulling
from linkage.statics.carried import LoadAt
from linkage.units import bar, deg, g0, kN, litre, minute
from tests.for_all import for_all

AREA = math.pi / 4 * 0.08**2
ANNULUS = math.pi / 4 * (0.08**2 - 0.045**2)


class Lever(Mechanism):
    """A lever on a cylinder."""

    S = Stroke(0.0, 0.2)
    O, A = Ground(0.0, 0.0), Ground(0.45, -0.55)
    B = Dyad(A, O, AB=0.62 + S, OB=0.75, side=LEFT)
    G = OnLink(O, B, OG=1.3)
    load = Force(G, (0.0, -20 * kN))
    heavy = LoadCase("heavy", scale={"load": 1.2})
    ram = Cylinder(A, B, bore=80 * mm, rod=45 * mm)


def made(name="Made", base=Lever, **members):
    return type(name, (base,), members)


def spelled(seed):
    """Return one lever twice: with the return line's pressure as a number of its circuit, and as a tank on a line of its own."""
    draw = Random(seed)
    side, other = draw.choice((("piston", "rod"), ("rod", "piston")))
    given, back = draw.uniform(150, 250) * bar, draw.uniform(1, 9) * bar
    losses = dict(mechanical_efficiency=draw.choice((1.0, 0.9)), hydraulic_efficiency=draw.choice((1.0, 0.95)))
    common = dict(ram=Cylinder("A", "B", bore=80 * mm, rod=45 * mm, count=draw.choice((1, 2)), works=draw.choice((side, side))))
    common |= dict(load=Force("G", (draw.uniform(-5, 5) * kN, (-20 if side == "piston" else 20) * kN)))
    common |= dict(rub=PinFriction("O", radius=30 * mm, coefficient=0.15)) if seed % 3 == 2 else {}
    common |= dict(back_given=back)
    first = made("Number", line=LiftCircuit("ram", pressure=given, relief=1.1 * given, back_pressure=back, **losses), **common)
    lines = dict(line=OilLine(f"ram.{side}_side", "supply", "valve"), back=OilLine(f"ram.{other}_side", Tank(back)))
    return first, made("Tank", supply=Pump(given, **losses), valve=Relief(1.1 * given), **lines, **common)


@for_all("seed", range(2), slow=range(2, 15))
def test_a_back_pressure_and_a_tank_give_the_same_forces(seed):
    numbers = []
    for structure in spelled(seed):
        machine, ram, line = structure(), structure.ram, structure.line
        motion, way = machine.at(S=np.array([0.02, 0.11, 0.19])), "extending" if ram.works == "piston" else "retracting"
        asked = [most(drive_force()), least(drive_force()), least(reserve("ram")), most(pressure("ram", direction=way))]
        found = [driving_force(motion), driving_force(motion, case="heavy"), driving_force(motion, direction="extending")]
        found += [pin_forces(motion).drives["S"], np.ravel(machine.evaluate([drive_force()], S=0.1)[0])]
        found += [ram.thrust(motion), ram.pressure(motion, direction=way)]
        found += [line.rod_force(motion), line.reserve(motion), line.largest(motion), np.ravel(ram.bounds(motion, True))]
        if way == "extending":  # against a stop the other side presses back
            (stop,) = (str(each) for each in machine.verdicts() if "Against a stop" in str(each))
            size, relief = ram.sized(machine.at(S=0.1)), line.relief_pressure(motion)
            pushed = relief * size.push_area - structure.back_given * size.pull_area
            assert f"{pushed / ram.count / kN:.4g} kN at {relief / bar:.4g} bar" in stop
        numbers.append(np.concatenate([*map(np.ravel, found), [each.value for each in machine.answers(asked)]]))
    assert_allclose(*numbers, rtol=1e-11)


def test_the_drive_of_a_cylinder_beside_a_tank_is_its_thrust_in_the_equations_too():
    structure = spelled(1)[1]
    machine, values = structure(), equations(structure(), forces=True).values(at=dict(S=0.1))
    motion = machine.at(S=0.1)
    assert_allclose(driving_force(motion), structure.ram.thrust(motion), rtol=1e-12)
    assert_allclose(values["Q_S"], driving_force(motion), rtol=1e-9)
    assert_allclose(values["T_ram"], structure.ram.thrust(motion), rtol=1e-9)
    assert "T_ram" not in next(text for text in str(equations(structure, forces=True)).splitlines() if "Q_S =" in text)


def test_the_thrust_of_a_line_on_gas_is_that_of_its_equations():
    gas = AccumulatorBlock([Accumulator(volume=20 * litre, charge=60 * bar)])
    machine = made(line=OilLine("ram.piston_side", gas, charge_pressure=90 * bar, at=0.0))()
    motion, values = machine.at(S=0.1), equations(machine, forces=True).values(at=dict(S=0.1))
    assert_allclose(values["p_ram"], motion[pressure("line")], rtol=1e-9)
    assert_allclose(values["T_ram"], machine.plan.members["ram"].thrust(motion), rtol=1e-9)
    assert_allclose(values["Q_S"], driving_force(motion), rtol=1e-9)


class Upright(Mechanism):
    """A force that pushes a guided ram in, and pulls it out."""

    S = Stroke(0.0, 0.5)
    O = Ground(0.0, 0.0)
    rail = Guide(O, angle=90 * deg)
    P = OnGuide(rail, at=1.0 + S)
    ram = Cylinder(O, P, bore=120 * mm, rod=85 * mm)
    push = Force(P, (0.0, -40 * kN))
    pull = LoadCase("pull", scale={"push": -1.0})


@for_all("side, other, sense", (), slow=[("piston", "rod", 1.0), ("rod", "piston", -1.0)])
def test_a_side_that_another_line_keeps_has_its_pressure_and_holds_no_more(side, other, sense):
    areas = {"piston": np.pi / 4 * 0.12**2, "rod": np.pi / 4 * (0.12**2 - 0.085**2)}
    gas = AccumulatorBlock([Accumulator(volume=5 * litre, charge=20 * bar)])
    for beside, charge in ((Tank(6 * bar), {}), (gas, {"charge_pressure": 30 * bar})):
        back = OilLine(f"ram.{other}_side", beside, **charge)
        shut = LoadCase("shut", scale={"push": -1.0}, shut=["back"])
        machine = made(base=Upright, line=OilLine(f"ram.{side}_side", Pump(400 * bar)), back=back, shut=shut)
        motion, left = machine().sweep(3), []
        for case, force in ((None, 40 * kN), ("pull", -40 * kN)):
            kept = machine.back.pressure(motion, case=case) + np.zeros(3)
            assert_allclose(motion[pressure("ram", side=other, case=case)], kept)
            left.append(sense * force + kept * areas[other])
            holding = machine.line.holding(motion, case=case)
            assert_allclose([holding.working, holding.other], [np.maximum(left[-1], 0.0) / areas[side], kept], atol=1e-6)
        assert_allclose(machine.line.holding(motion, case="shut").other, [40 * kN / areas[other] if sense > 0.0 else 0.0] * 3)
        (found,) = [each for each in machine().verdicts() if each.rule == "holding"]
        assert not found.ok and found.answer.case != "shut"
        assert_allclose(found.answer.value, np.min(left), rtol=1e-9)
        low, high = sorted((sense * each + np.zeros(3) for each in machine.ram.bounds(motion, False)), key=np.min)
        kept = (machine.back.pressure(motion) + np.zeros(3)) * areas[other]
        assert_allclose([low, high], [-kept, 400 * bar * areas[side] - kept], atol=1e-6)


def test_each_of_two_lines_has_its_own_pressure_whoever_says_that_both_sides_work():
    for works in (None, "both"):
        for load, sign in ((-20 * kN, 1.0), (20 * kN, -1.0)):
            members = dict(ram=Cylinder("A", "B", bore=80 * mm, rod=45 * mm, works=works), load=Force("G", (0.0, load)))
            structure = made(out=OilLine("ram.piston_side", Pump(200 * bar)), back=OilLine("ram.rod_side", Pump(200 * bar)), **members)
            motion = structure().at(S=np.array([0.05, 0.15]))
            thrust = structure.ram.thrust(motion)
            assert np.all(np.sign(thrust) == sign)
            assert_allclose(structure.out.pressure(motion), np.maximum(thrust, 0.0) / AREA, rtol=1e-12)
            assert_allclose(structure.back.pressure(motion), np.maximum(-thrust, 0.0) / ANNULUS, rtol=1e-12)


@for_all("seed", range(3), slow=range(3, 12))
def test_both_sides_know_the_valve_over_which_they_go_down_at_every_door(seed):
    draw = Random(seed)
    setting, ratio, k_m = draw.uniform(190, 240) * bar, draw.uniform(2, 6), draw.choice((1.0, 0.9))
    supply = Pump(250 * bar, flow=1e-3, mechanical_efficiency=k_m)
    on = ("supply", Tank(draw.uniform(0, 4) * bar), Pump(200 * bar))[seed % 3]
    lines = dict(line=OilLine("ram.piston_side", "supply"), back=OilLine("ram.rod_side", on))
    valve = HoldingValve("line", pilot="back", setting=setting, ratio=ratio)
    structure = made(supply=supply, load=Force("G", (0.0, -draw.uniform(8, 20) * kN)), **lines, valve=valve)
    machine, poses = structure(), np.array([0.03, 0.17])
    motion = machine.at(S=poses)
    thrust = structure.ram.thrust(motion) * k_m  # p A - q a = T and p + ratio q = setting
    pilot = (AREA * setting - thrust) / (AREA * ratio + ANNULUS)
    down = setting - ratio * pilot
    assert_allclose([structure.valve.line_pressure(motion), structure.valve.pilot_pressure(motion)], [down, pilot], rtol=1e-12)
    back = machine.sweep(2, over=Over.path(S=[0.17, 0.03], time=[0.0, 2.0]))
    for side, name, wanted in (("piston", "line", down), ("rod", "back", pilot)):
        line, way = machine.plan.members[name], {"direction": "retracting"}
        asked = [pressure("ram", side=side, **way), pressure(name, **way), pressure("ram", circuit=name, **way)]
        found = [line.pressure(motion, **way), *(motion[each] for each in asked), *machine.evaluate(asked, S=poses)]
        assert_allclose(found, np.tile(wanted, (len(found), 1)), rtol=1e-12)
        timed = [line.pressure(back), *(back[each] for each in (pressure("ram", side=side), pressure(name)))]
        assert_allclose(timed, np.tile(wanted[::-1], (3, 1)), rtol=1e-9)
        answers = machine.answers([most(pressure("ram", side=side)), most(pressure(name))], over=Over(S=(0.03, 0.17)))
        loaded = structure.ram.thrust(motion, case="heavy") * k_m
        heavy = (AREA * setting - loaded) / (AREA * ratio + ANNULUS)
        worst = max(*wanted, *(setting - ratio * heavy if side == "piston" else heavy))
        assert_allclose([each.value for each in answers], worst, rtol=1e-9)
        assert all(each.direction == "retracting" for each in answers)
    assert_allclose(structure.ram.pressure(motion, direction="retracting"), np.maximum(down, pilot), rtol=1e-12)
    assert np.all(structure.line.pressure(motion, direction="extending") < down)


def test_a_number_that_counts_for_nothing_on_a_line_is_refused_there():
    block = AccumulatorBlock([Accumulator(volume=4 * litre, charge=40 * bar)])
    for on in ((Pump(200 * bar),), (Tank(2 * bar),), (Pump(200 * bar), block)):
        for name, value in dict(make_up=3 * bar, oil=1e-3, charge_pressure=90 * bar, seal_friction=1 * bar, exponent=1.2).items():
            with pytest.raises(DefinitionError, match=f"{name}= counts for nothing there"):
                made(line=OilLine("ram.piston_side", *on, **{name: value}))
    with pytest.raises(DefinitionError, match="make_up= counts for nothing there, as its pressure is given"):
        made(line=OilLine("ram.piston_side", block, charge_pressure=90 * bar, make_up=3 * bar))
    with pytest.raises(DefinitionError, match="exponent= counts for nothing there, as it is closed"):
        made(line=OilLine("ram.piston_side", exponent=1.2))
    back = OilLine("ram.rod_side", Tank(150 * bar), Relief(50 * bar))
    weak = made(base=Upright, line=OilLine("ram.piston_side", Pump(400 * bar)), back=back)
    (found,) = [each for each in weak().verdicts() if each.rule == "line back"]
    assert not found.ok and "comes to 150 bar at S = 0.0 mm, and its relief valve opens at 50 bar" in found.sentence


def test_accumulators_beside_a_pump_count_in_the_oil_of_its_line():
    block = AccumulatorBlock([Accumulator(volume=5 * litre, charge=20 * bar)])
    spring = Spring("O", "P", stiffness=50e3, free_length=1.0)
    made_so = made(base=Upright, line=OilLine("ram.piston_side", Pump(400 * bar, flow=1e-3), block), spring=spring)
    machine = made_so()
    motion, area, line, air = machine.sweep(3), np.pi / 4 * 0.12**2, machine.plan.members["line"], 101325.0
    pressures = (40 * kN + 50e3 * motion["S"]) / area
    fluid = 5e-3 * (1.0 - (20 * bar + air) / (pressures + air))
    oil = area * motion["S"] + fluid - fluid[0]
    assert_allclose(line.oil(motion), oil, rtol=1e-9, atol=1e-12)
    assert_allclose([line.taken(motion), line.time(motion) * 1e-3], oil[-1], rtol=1e-9)
    (found,) = [each for each in machine.verdicts() if each.rule == "oil"]
    assert f"{oil[-1] / litre:.2f} l from end to end, {oil[-1] / 1e-3:.1f} s" in found.sentence
    with pytest.raises(DefinitionError, match="leaves out what the accumulators"):
        machine.evaluate([flow("line")], S=0.1)


class Chain(Mechanism):
    """Three platforms in series: a rod side fills the next piston side."""

    S = Stroke(0.0, 0.2)
    O, Q, R = Ground(0.0, 0.0), Ground(1.0, 0.0), Ground(2.0, 0.0)
    a, b, c = (Guide(each, angle=90 * deg) for each in (O, Q, R))
    P = OnGuide(a, at=0.8 + S)
    first = Cylinder(O, P, bore=100 * mm, rod=60 * mm)
    second = Cylinder(Q, "T", bore=80 * mm, rod=40 * mm)
    third = Cylinder(R, "U", bore=80 * mm, rod=40 * mm)
    one = OilLine(first.rod_side, second.piston_side, filled=dict(second=0.8), oil=1e-4)
    two = OilLine(second.rod_side, third.piston_side, filled=dict(third=0.8), oil=-2e-5)
    T, U = OnGuide(b, at=second.length), OnGuide(c, at=third.length)
    w1, w2, w3 = Force(P, (0.0, -1e4)), Force(T, (0.0, -1e4)), Force(U, (0.0, -1e4))
    lifts = OilLine(first.piston_side, Pump(200 * bar))


def test_a_line_behind_another_one_starts_where_it_was_filled():
    """Lengths by hand: what leaves a rod side and what was put in, over the next piston."""
    annulus = [math.pi / 4 * (bore**2 - rod**2) for bore, rod in ((0.1, 0.06), (0.08, 0.04))]
    for at in ({}, dict(at=dict(S=0.05))):
        lines = dict(one=OilLine("first.rod_side", "second.piston_side", filled=dict(second=0.8), oil=1e-4, **at))
        lines |= dict(two=OilLine("second.rod_side", "third.piston_side", filled=dict(third=0.8), oil=-2e-5, **at))
        structure = made(base=Chain, **lines)
        motion, start = structure().at(S=np.array([0.0, 0.05, 0.2])), at.get("at", {}).get("S", 0.0)
        second = 0.8 + (1e-4 + annulus[0] * (motion.strokes["S"] - start)) / AREA
        third = 0.8 + (-2e-5 + annulus[1] * (second - 0.8)) / AREA
        assert_allclose(motion["second.length"], second, rtol=1e-12)
        assert_allclose(motion["third.length"], third, rtol=1e-12)
        for line, put_in in ((structure.one, 1e-4), (structure.two, -2e-5)):
            assert_allclose(line.oil(motion), put_in, atol=1e-15)
            assert_allclose(line.oil(structure().at(S=0.1)), put_in, atol=1e-15)
    with pytest.raises(DefinitionError, match="both say where all its cylinders are"):
        OilLine("a", "b", at=0.1, filled="closed")
    assert OilLine("a", "b", at=0.1).strokes_filled(("S",)) == {"S": 0.1}
    with pytest.raises(DefinitionError, match=r"2 strokes; say at=dict\(S, T=\.\.\.\)"):
        OilLine("a", "b", at=0.1).strokes_filled(("S", "T"))


def test_a_side_that_is_written_works_against_a_tank_on_the_other_one():
    for works, other, area, across in (("piston", "rod", AREA, ANNULUS), ("rod", "piston", ANNULUS, AREA)):
        ram = Cylinder("A", "B", bore=80 * mm, rod=45 * mm, works=works)
        load = Force("G", (0.0, (-20 if works == "piston" else 20) * kN))
        back = OilLine(f"ram.{other}_side", Tank(4 * bar))
        for more in ({}, dict(line=LiftCircuit("ram", pressure=200 * bar)), dict(line=OilLine(f"ram.{works}_side", Pump(200 * bar)))):
            structure = made(ram=ram, load=load, back=back, **more)
            motion = structure().at(S=np.array([0.05, 0.15]))
            wanted = (np.abs(structure.ram.thrust(motion)) + 4 * bar * across) / area
            assert_allclose(structure.ram.pressure(motion), wanted, rtol=1e-12)
            alone = made(ram=ram, load=load)
            assert_allclose(structure.ram.thrust(motion), alone.ram.thrust(alone().at(S=motion.strokes["S"])), rtol=1e-12)


def test_the_verdict_on_lowering_looks_both_ways_whatever_the_number_of_poses():
    class Over(Mechanism):
        S = Stroke(0.0, 0.4)
        O, A = Ground(0.0, 0.0), Ground(-1.0, -0.3)
        B = Dyad(A, O, AB=1.05 + S, OB=0.5, side=LEFT)
        G = OnLink(O, B, OG=1.0)
        load = Weight(G, mass=1000)
        ram = Cylinder(A, B, bore=80 * mm, rod=45 * mm, works="both")
        line = LiftCircuit(ram, pressure=200 * bar)

    thrust = Over.ram.thrust(Over().sweep(201))
    assert thrust.min() < 0.0 < thrust.max()
    wanted = max(thrust.max() / AREA, -thrust.min() / ANNULUS)
    for poses in (2, 3, 10, 100):
        motion = Over().sweep(poses)
        (found,) = (str(each) for each in lift_verdicts("line", motion) if each.rule == "lowering")
        assert f"{wanted / bar:.4g} bar" in found, (poses, found)
        back, forces = Over.line.lowering(motion), Over.ram.thrust(motion)  # at each pose the way that the load drives it
        assert back.by_itself.all() and not back.push.any()
        assert_allclose(back.working, np.where(forces > 0.0, forces / AREA, -forces / ANNULUS), rtol=1e-9)
    (told,) = (str(each) for each in Over().verdicts() if each.rule == "lowering")
    assert f"{wanted / bar:.4g} bar" in told


class Listed(Mechanism):
    """A parts list in which a pin hangs on a boom and on what is given a length."""

    S = Stroke(0.0, 0.15)
    sketch = drawn(S=0.0)
    O, A, C, M = Ground(0.0, 0.0), Ground(0.3, -0.4), Ground(0.0, 2.0), Ground(-0.3, -0.3)
    B = Dyad(A, O, AB=math.hypot(0.5, 0.8) + S, OB=math.hypot(0.8, 0.4), side=LEFT)
    T, K = OnLink(O, B, OT=2.0), OnLink(O, B, OK=0.3, BOK=90 * deg)


def test_a_parts_list_names_the_link_that_a_rope_or_a_line_gives_its_length():
    pin = dict(W=Pin(at=(1.6, 0.2)), lug=Link("T W"), load=Force("W", (0.0, -5 * kN)))
    rams = dict(master=Cylinder("M", "K", bore=80 * mm, rod=40 * mm), slave=Cylinder("C", "W", bore=80 * mm, rod=40 * mm))
    level = OilLine("master.piston_side", "slave.piston_side", filled=dict(slave=2.3))
    given = {
        'Link("C W", CW=ref("rope.last"))': pin | dict(rope=Rope("C", "W", length=2.3)),
        'Link("C W", CW=ref("slave.length"))': pin | rams | dict(level=level),
    }
    for remedy, members in given.items():
        with pytest.raises(DefinitionError) as refused:
            made(base=Listed, **members)
        assert remedy in str(refused.value)
        motion = made(base=Listed, hung=eval(remedy, {"Link": Link, "ref": ref}), **members)().at(S=0.0)
        assert_allclose(motion.distance("C", "W"), 2.3, rtol=1e-12)


@for_all("seed", range(3), slow=range(3, 20))
def test_the_oil_that_a_spool_gives_does_the_work_of_its_rams(seed):
    draw, rams = Random(seed), ["ram0", "ram1", "ram2"][: 2 + seed % 2]
    members = dict(S=Stroke(-0.3, 0.3), O=Ground(0.0, 0.0), B=Crank("O", OB=0.5, angle="S"), line=LiftCircuit(rams, pressure=200 * bar))
    for k, ram in enumerate(rams):
        works = draw.choice(("piston", "rod", "both")) if k else "both"
        members[f"A{ram}"] = Ground(draw.uniform(-0.3, 0.3), draw.choice((-1, 1)) * draw.uniform(0.4, 0.7))
        members[ram] = Cylinder(f"A{ram}", "B", bore=draw.uniform(60, 120) * mm, rod=draw.uniform(25, 55) * mm, works=works)
    machine = made(base=Mechanism, load=Force("B", (0.0, -40 * kN)), **members)()
    motion = machine.sweep(5, over=Over.path(S=[-0.2, 0.2], time=[0.0, 2.0]))
    moved = [machine.plan.members[ram] for ram in rams]
    work = sum(ram.thrust(motion) * ram.growth(motion, motion.rates) for ram in moved)
    assert np.all(work > 0.0)
    assert_allclose(motion[flow("line")] * machine.plan.members["line"].pressure_for(motion, cylinder="ram0"), work, rtol=1e-9)


def test_a_stroke_that_is_a_lines_oil_is_a_volume_that_a_pressure_drives():
    for oil in (ref("oil"), ref("oil") + 1e-4):
        line = OilLine("ram.piston_side", filled=dict(ram=0.8), oil=oil)
        lifted = dict(O=Ground(0.0, 0.0), rail=Guide("O", angle=90 * deg), P=OnGuide("rail", at=ref("ram.length")))
        ram = Cylinder("O", "P", bore=80 * mm, rod=45 * mm)
        machine = made(base=Mechanism, oil=Stroke(0.0, 1e-3), ram=ram, line=line, load=Force("P", (0.0, -10 * kN)), **lifted)()
        told = f"{10 * kN / AREA / bar:.6g} bar"
        assert f"oil: {told}\n" in str(pin_forces(machine.sweep(3)))
        assert [each.unit for each in drive_columns(machine.sweep(3))] == ["bar"]
        assert str(machine.answers([most(drive_force("oil"))])[0]) == f"{told} at oil = 0.000 l"
        assert_allclose(machine.answers([most(pressure("line"))])[0].value, 10 * kN / AREA)
        assert str(machine.verdicts()[0]) == "ok   assembly: it is assembled over oil = 0 to 1 l."


def crushed():
    block = AccumulatorBlock([Accumulator(volume=0.3 * litre, charge=60 * bar)])
    return made(line=OilLine("ram.piston_side", block, charge_pressure=90 * bar, at=0.2))


@for_all("machine, says", [
    (crushed(), "leaves no gas; take larger accumulators"),
    (made(line=LiftCircuit("ram", pressure=200 * bar, back_pressure=900 * bar)), "the back pressure eats up the pump's; lower it"),
])  # fmt: skip
def test_forces_that_are_refused_are_a_verdict_that_is_not_kept(machine, says):
    found = machine().verdicts()
    assert found[0].rule == "forces" and found[0].ok is False and says in found[0].sentence
    assert [each.rule for each in found if says in each.sentence] == ["forces"] and any(each.rule == "assembly" for each in found)


def shared(seed):
    """Return a boom and a jib, each on two or three rams of one spool or on joined chambers; its rams and their lines, arm by arm."""
    draw, members, arms = Random(seed), dict(S=Stroke(-0.3, 0.3), R=Stroke(-0.3, 0.3)), []
    members |= dict(O=Ground(0.0, 0.0), B=Crank("O", OB=0.5, angle="S"), K=OnLink("O", "B", OK=2.0, BOK=10 * deg))
    jib = ref("R") + ref("turned") if draw.random() < 0.6 else "R"  # where it is "R" the lines of both move with S
    members |= dict(turned=angle("O", "B"), J=Crank("K", KJ=0.4, angle=jib), T=OnLink("K", "J", KT=draw.uniform(0.8, 1.5)))
    members |= dict(
        load=Force("T", (draw.uniform(-9, 9) * kN, draw.uniform(-9, 9) * kN)), pull=Force("B", (0.0, draw.uniform(-60, 60) * kN))
    )
    for arm, (base, end) in enumerate((("frame", "B"), ("boom", "J"))):
        rams, kind = [f"ram{arm}{k}" for k in range(draw.choice((2, 2, 3)))], draw.choice(("spool", "crossed", "alike", "part", "tank"))
        for k, ram in enumerate(rams):
            x, y = draw.uniform(-0.3, 0.3), draw.choice((-1, 1)) * draw.uniform(0.4, 0.7)
            members[f"A{ram}"] = Ground(x, y) if base == "frame" else OnLink("O", "K", **{f"OA{ram}": 2.0 + x, f"KOA{ram}": 0.4 * y})
            works = "both" if k == len(rams) - 1 else draw.choice(("piston", "rod", "both"))
            given = dict(works=works) if kind == "spool" else {}
            members[ram] = Cylinder(f"A{ram}", end, bore=draw.uniform(60, 120) * mm, rod=draw.uniform(25, 55) * mm, **given)
        if kind == "spool":
            members[f"line{arm}"] = LiftCircuit(rams, pressure=200 * bar)
        else:
            ways = [("piston", "rod") if kind in ("alike", "tank") or k % 2 == 0 else ("rod", "piston") for k, _ in enumerate(rams)]
            joined = [[f"{ram}.{way[side]}_side" for ram, way in zip(rams, ways, strict=True)] for side in (0, 1)]
            joined[1] = joined[1][:1] if kind == "part" else joined[1]
            ends = Pump(200 * bar), Tank(draw.uniform(5, 30) * bar) if kind == "tank" else Pump(200 * bar)
            members |= {f"line{arm}{side}": OilLine(*on, ends[side]) for side, on in enumerate(joined)}
        arms.append((kind, rams))
    lines = [name for name, each in members.items() if isinstance(each, OilLine)]
    parked = dict(parked=LoadCase("parked", shut=lines)) if lines else {}
    return made(base=Mechanism, **members, **parked), arms


def growth_of(machine, poses, stroke, rams):
    """Return how lengths of rams follow a stroke, by differences."""
    lengths = []
    for step in (-2e-4, -1e-4, 1e-4, 2e-4):
        near = machine.at(unreachable="nan", **{**poses, stroke: poses[stroke] + step})
        lengths.append(np.array([near.distance(*machine.plan.members[ram].ends) for ram in rams]))
    return dict(zip(rams, (lengths[0] - 8 * lengths[1] + 8 * lengths[2] - lengths[3]) / 12e-4, strict=True))


def areas_of(machine, ram):
    """Return the signed areas of both sides of a ram, by name."""
    bore, rod = machine.plan.members[ram].bore, machine.plan.members[ram].rod
    return {"piston": math.pi / 4 * bore**2, "rod": -math.pi / 4 * (bore**2 - rod**2)}


def volume_rate(machine, line, growth):
    return sum(growth[label(each.cylinder)] * areas_of(machine, label(each.cylinder))[each.side] for each in line.chambers)


def check_lowering(machine, poses, stroke, kind, rams, lines, resistance=60 * bar):
    """All rams of a line go back by one pressure of the other side, by the work of both on a small step."""
    motion, growth = machine.at(unreachable="nan", **poses), growth_of(machine, poses, stroke, rams)
    thrusts = {ram: machine.plan.members[ram].thrust(motion) for ram in rams}
    work = sum(thrusts[ram] * growth[ram] for ram in rams)
    for own, other in (lines, lines[::-1]) if lines else ():
        if own.is_drained:
            continue
        push = (work - resistance * volume_rate(machine, own, growth)) / volume_rate(machine, other, growth)
        push = np.where(push > (other.line_pressure(motion) if other.is_drained else 0.0), push, 0.0)
        for ram in {label(each.cylinder) for each in own.chambers}:
            assert_allclose(own.lowering(motion, resistance=resistance, cylinder=ram).push, push, rtol=1e-7, atol=10.0, err_msg=kind)
    for k in range(len(poses["S"])) if not lines else ():
        spool, spread = machine.plan.members[f"line{stroke == 'R':d}"], {"both": ("piston", "rod")}
        there = machine.at(unreachable="nan", **{name: each[k] for name, each in poses.items()})
        for ram in (each for each in rams if machine.plan.members[each].works == "both" and np.isfinite(thrusts[each][k])):
            way = -np.sign(thrusts[ram][k] * growth[ram][k])
            sums = {True: 0.0, False: 0.0}
            for each in rams:
                for side in spread.get(machine.plan.members[each].works, (machine.plan.members[each].works,)):
                    sums[(way * growth[each][k] < 0.0) == (side == "piston")] += way * growth[each][k] * areas_of(machine, each)[side]
            push = max((way * work[k] - resistance * sums[True]) / sums[False], 0.0)
            assert_allclose(spool.lowering(there, resistance=resistance, cylinder=ram).push, push, rtol=1e-7, atol=10.0)


@for_all("seed", (4, 5), slow=(*range(4), *range(6, 20)))
def test_rams_of_one_line_have_its_pressure_on_the_side_that_it_fills(seed):
    structure, arms = shared(seed)
    machine, poses = structure(), dict(S=np.array([-0.25, 0.0, 0.1, 0.28]), R=np.array([0.2, -0.28, 0.0, 0.26]))
    motion = machine.at(unreachable="nan", **poses)
    forces, members = pin_forces(motion), machine.plan.members
    every = [members[ram] for _, each in arms for ram in each]
    pins = [pin_force(f"A{ram.name}") for ram in every]
    evaluated = machine.evaluate([*map(thrust, every), *pins], unreachable="nan", **poses)
    for ram, value, pin in zip(every, evaluated, evaluated[len(every) :], strict=False):
        assert_allclose(forces.thrusts[ram.name], ram.thrust(motion), rtol=1e-9, atol=1e-6)
        assert_allclose(value, ram.thrust(motion), rtol=1e-9, atol=1e-6)
        assert_allclose(pin, np.abs(ram.thrust(motion)), rtol=1e-9, atol=1e-6)
    for (kind, rams), stroke in zip(arms, ("S", "R"), strict=True):
        thrusts = [members[ram].thrust(motion) for ram in rams]
        needed = sum(ram.thrust(motion) * ram.growth(motion, {stroke: 1.0}) for ram in every)
        assert_allclose(needed, np.where(np.isnan(needed), np.nan, driving_force(motion, drive=stroke)), rtol=1e-9)
        sizes = [members[ram].sized(motion) for ram in rams]
        lines = [each for each in members.values() if isinstance(each, OilLine) and each.name.startswith(f"line{stroke == 'R':d}")]
        check_lowering(machine, poses, stroke, kind, rams, lines)
        if kind == "spool":
            sides = [np.where(each > 0.0, size.push_area, size.pull_area) for each, size in zip(thrusts, sizes, strict=True)]
            found = [abs(each) / side for each, side in zip(thrusts, sides, strict=True)]
            assert all(np.all((each < 1e-6) | (abs(each - np.max(found, axis=0)) < 1e-6 * each) | np.isnan(each)) for each in found)
            continue
        given = [line.line_pressure(motion) for line in lines]
        if kind == "tank":  # a line says that it has no pressure where the load pulls
            pumped = (thrusts[0] + given[1] * sizes[0].pull_area) / sizes[0].push_area
            assert_allclose(np.maximum(pumped, 0.0), given[0], rtol=1e-9, atol=1e-3)
            given[0] = pumped
        for ram, each, size in zip(rams, thrusts, sizes, strict=True):
            sides = [(line, chamber.side) for line in lines for chamber in line.chambers if label(chamber.cylinder) == ram]
            parts = [given[lines.index(line)] * (size.push_area if side == "piston" else -size.pull_area) for line, side in sides]
            assert_allclose(sum(parts), each, rtol=1e-9, atol=1e-3)
        shut = [line.line_pressure(motion, Acting(case="parked")) for line in lines]
        for ram, size in zip(rams, sizes, strict=True):  # whatever the pumps and tanks, it is held by the side that the load presses on
            sides = [(line, chamber.side) for line in lines for chamber in line.chambers if label(chamber.cylinder) == ram]
            parts = [shut[lines.index(line)] * (size.push_area if side == "piston" else -size.pull_area) for line, side in sides]
            assert_allclose(sum(parts), members[ram].thrust(motion, case="parked"), rtol=1e-9, atol=1e-3)
        assert np.all((np.min(shut, axis=0) > -1e-3) | np.isnan(shut[0]))
        if kind == "tank":
            twin = made(base=structure, **{lines[0].name: LiftCircuit(rams, pressure=200 * bar)})().at(unreachable="nan", **poses)
            for ram in rams:
                found = twin.plan.members[ram].thrust(twin, case="parked")
                assert_allclose(found, members[ram].thrust(motion, case="parked"), rtol=1e-9, atol=1e-6)
        assert kind == "tank" or np.all((np.min(given, axis=0) > -1e-3) | np.isnan(given[0]))
        way = machine.sweep(S=101, R=0.1) if stroke == "S" else machine.sweep(S=0.1, R=101)
        oil = np.ptp(lines[0].oil(way))
        assert oil * (1 - 1e-9) <= lines[0].taken(way) <= oil * 1.01


@for_all("seed", (), slow=range(6))
def test_what_a_line_and_a_chart_lift_brings_a_line_to_its_pumps_pressure(seed):
    structure, _ = shared(seed)
    machine, poses, way = structure(), dict(S=np.array([-0.25, 0.1]), R=np.array([0.2, 0.0])), (0.0, 1.0 - 2.0 * (seed % 2))
    motion, own = machine.at(unreachable="nan", **poses), [*machine.plan.of_kind(ForceElement)]
    lines = [each for each in machine.plan.of_kind(LiftLine).values() if not each.is_drained]
    found = [each.lifted(motion, "T", along=way) for each in lines]
    for line, load in zip(lines, found, strict=True):
        loaded = line.pressure_for(motion, [*own, pulling("T", way, np.nan_to_num(load), motion)])
        assert_allclose(loaded[load > 0.0], 200 * bar, rtol=1e-8)
    least_lifted = np.nan_to_num(found, nan=np.inf).min(axis=0)
    charted = LoadAt(machine.plan, machine.plan.defaults, "T", way).at(poses).min(axis=0)
    compared = (charted > 0.0) & (least_lifted < np.inf)  # a chart's load may be the one that drives a side that no pump fills
    assert_allclose(charted[compared], least_lifted[compared], rtol=1e-8)


@for_all("seed", (0,), slow=range(1, 12))
def test_losses_and_a_returning_pressure_leave_one_pressure_on_a_line(seed):
    draw, kind = Random(seed), ("crossed", "alike", "number", "bare")[seed % 4]
    members, rams = dict(S=Stroke(-0.3, 0.3), O=Ground(0.0, 0.0), B=Crank("O", OB=0.5, angle="S")), ["ram0", "ram1"]
    for k, ram in enumerate(rams):
        up = -1 if k and kind == "crossed" else 1
        members[f"A{ram}"] = Ground(draw.uniform(-0.3, 0.3), -up * draw.uniform(0.4, 0.7))
        members[ram] = Cylinder(f"A{ram}", "B", bore=draw.uniform(60, 120) * mm, rod=draw.uniform(25, 55) * mm)
    members |= dict(load=Force("B", (0.0, -40 * kN)), rub=PinFriction("O", radius=60 * mm, coefficient=0.2))
    losses, back = dict(mechanical_efficiency=0.85, hydraulic_efficiency=0.9), draw.uniform(5, 30) * bar
    sides = [("piston", "rod"), ("rod", "piston") if kind == "crossed" else ("piston", "rod")]
    joined = [[f"{ram}.{side[k]}_side" for ram, side in zip(rams, sides, strict=True)] for k in (0, 1)]
    members |= dict(line=OilLine(*joined[0], Pump(250 * bar, **losses)), drain=OilLine(*joined[1], Tank(back)))
    if kind == "number":
        members = {**members, "line": LiftCircuit(rams, pressure=250 * bar, back_pressure=back, **losses)}
    if kind in ("number", "bare"):
        del members["drain"]
    machine, poses = made(base=Mechanism, **members)(), dict(S=np.array([-0.25, 0.05, 0.28]))
    motion, growth, line = machine.at(**poses), growth_of(machine, poses, "S", rams), machine.plan.members["line"]
    ways = {"ram0": "extending", "ram1": "retracting" if kind == "crossed" else "extending"}
    work = sum(machine.plan.members[ram].thrust(motion, direction=ways[ram]) * growth[ram] for ram in rams)
    rates = [sum(growth[ram] * areas_of(machine, ram)[side[k]] for ram, side in zip(rams, sides, strict=True)) for k in (0, 1)]
    assert np.all(work > 0.0)
    pressed = (work / 0.85 - (0.0 if kind == "bare" else back) * rates[1]) / rates[0] / 0.9
    used = (250 * bar * 0.9 * rates[0] + (0.0 if kind == "bare" else back) * rates[1]) / (work / 0.85)
    for ram in rams:
        assert_allclose(line.pressure_for(motion, cylinder=ram, direction=ways[ram]), pressed, rtol=1e-8)
        assert_allclose(line.reserve(motion, cylinder=ram, direction=ways[ram]), used, rtol=1e-8)
        assert_allclose(np.ravel(machine.evaluate([reserve(ram, direction=ways[ram])], **poses)), used, rtol=1e-8)
    own = [*machine.plan.of_kind(ForceElement)]
    added = pulling("B", (0.0, 1.0), line.capacity(motion, "B"), motion)  # what it lifts brings it to its pump's pressure
    assert_allclose(line.pressure_for(motion, [*own, added], cylinder="ram0", direction="extending"), 250 * bar, rtol=1e-7)
    charted = LoadAt(machine.plan, machine.plan.defaults, "B", (0.0, 1.0)).at(poses).min(axis=0)
    assert_allclose(charted, line.capacity(motion, "B"), rtol=1e-7)
    told = [str(each) for each in machine.verdicts()]
    for rule in ("lifting", "holding", "lowering"):
        numbers = [re.findall(r"[\d.]+ bar|reserve is [\d.]+", each) for each in told if f" {rule} " in each]
        assert len(numbers) == 2 and numbers[0] == numbers[1], (rule, told)


class Swing(Mechanism):
    """A boom swung by two opposed cylinders, crossed on two lines, so far that both lines turn it back."""

    phi = Stroke(-70 * deg, 70 * deg)
    O, L, R = Ground(0.0, 0.0), Ground(-0.35, -0.25), Ground(-0.35, 0.25)
    T = Crank(O, OT=2.4, angle=phi)
    P, Q = OnLink(O, T, OP=0.22, TOP=100 * deg), OnLink(O, T, OQ=0.22, TOQ=-100 * deg)
    load = Weight(T, mass=900, gravity=(0.0, -1.4))
    left, right = Cylinder(L, Q, bore=90 * mm, rod=50 * mm), Cylinder(R, P, bore=90 * mm, rod=50 * mm)
    a = OilLine(left.piston_side, right.rod_side, Pump(200 * bar))
    b = OilLine(left.rod_side, right.piston_side, Pump(200 * bar))


def test_a_pose_where_both_of_two_crossed_lines_drive_one_way_is_refused_and_told():
    told = {str(each).split(":")[0]: each for each in Swing().verdicts()}
    assert "nan" not in "".join(told.values()) and told["FAIL lifting left b"].endswith("keep away from these.")
    assert "grows without bounds at phi = -61.03 deg" in told["FAIL lifting left a"]
    assert f"{np.ptp(Swing.a.oil(Swing().sweep(2001))) / litre:.2f} l from end to end" in told["ok   oil a"]
    motion, way = Swing().at(phi=20 * deg), (0.0, -1.0)  # the other line holds its own load
    most_lifted = pulling("T", way, Swing.b.capacity(motion, "T", along=way), motion)
    assert_allclose(Swing.b.pressure(motion, ["load", most_lifted]), 200 * bar, rtol=1e-9)
    with pytest.raises(DefinitionError, match="share otherwise"):  # which a stop's unit forces do not tell
        Stop.of(motion, "T", ["left", "right"], Acting())
    with pytest.raises(SingularError, match="condition infinite"):
        Swing.left.thrust(Swing().at(phi=-66 * deg))


class Jib(Mechanism):
    """A jib whose cylinder comes to its dead point."""

    phi = Stroke(0.0, 60 * deg)
    O, A = Ground(0.0, 1.0), Ground(0.5, 0.2)
    B = Crank(O, OB=0.8, angle=phi)
    T = OnLink(O, B, OT=2.0)


def past_its_dead_point(seed):
    """Return it with a load, its cylinder on a line of one of some kinds, with a tank, gas or a pump beside it."""
    draw, kind = Random(seed), ("tank", "telescope", "circuit", "gas", "pumps", "line", "bare")[seed % 7]
    works = draw.choice(("piston", "rod", "both"))
    side, other = ("rod", "piston") if works == "rod" else ("piston", "rod")
    ram = Cylinder("A", "B", bore=80 * mm, rod=45 * mm, works=works if kind in ("bare", "circuit") else None)
    if kind == "telescope":
        ram = Telescope("A", "B", bores=[80 * mm, 60 * mm], strokes=[0.7, 0.7], closed=0.1)
    gas = dict(charge_pressure=60 * bar) if kind == "gas" else {}
    block = AccumulatorBlock([Accumulator(volume=30 * litre, charge=50 * bar)])
    behind = dict(tank=Tank(5 * bar), gas=block, pumps=Pump(150 * bar)).get(kind)
    begin = math.atan2(-0.8, 0.5) if seed % 2 else -80 * deg  # its dead point, or before it
    across = draw.uniform(2, 5) * kN * (1 if side == "piston" else -1)  # against the side that works
    members = dict(phi=Stroke(begin, 60 * deg), ram=ram, load=Force("T", (draw.uniform(-5, 5) * kN, across)))
    if kind in ("circuit", "telescope"):
        members["line"] = LiftCircuit("ram", pressure=160 * bar)
    elif kind != "bare":
        members["line"] = OilLine(f"ram.{side}_side", Pump(160 * bar))
    return made(base=Jib, **members, **({} if behind is None else {"beside": OilLine(f"ram.{other}_side", behind, **gas)}))


class Tailgate(Mechanism):
    """A tailgate on a cylinder in series with the hoist's rod side, which comes to the dead point of its arm."""

    S = Stroke(0.0, 0.5)
    O, A = Ground(0.0, 0.0), Ground(0.9, -0.4)
    B = Dyad(A, O, AB=0.75 + S, OB=1.2, side=RIGHT)
    H, C = OnLink(O, B, OH=2.0, BOH=25 * deg), OnLink(O, B, OC=1.5, BOC=30 * deg)
    hoist, gate = Cylinder(A, B, bore=100 * mm, rod=90 * mm), Cylinder(C, "E", bore=50 * mm, rod=30 * mm)
    series = OilLine(hoist.rod_side, gate.piston_side, filled=dict(gate=0.45))
    E = Dyad(C, H, CE=gate.length, HE=0.3, side=LEFT)
    load = Weight(E, mass=150)
    up = OilLine(hoist.piston_side, Pump(200 * bar))


@for_all("seed", (1, 7), slow=(-1, 0, *range(2, 7), *range(8, 21)))
def test_no_verdict_tells_a_number_that_is_none(seed):
    machine = Tailgate if seed < 0 else past_its_dead_point(seed)
    told = [str(each) for each in machine().verdicts()]
    assert any("dead point" in each for each in told)
    assert not [each for each in told if re.search(r"\b(nan|inf)\b", each)]


def flap(seed):
    """Return a flap on two cylinders of one line, the second past its dead point from 26 deg on, and its friction's moment."""
    rng = Random(seed)
    rubbing = 0.2 * (seed % 2)

    class Flap(Mechanism):
        phi = Stroke(-10 * deg, 85 * deg)
        O, M, N = Ground(0.0, 0.0), Ground(0.72, -0.55), Ground(-0.50, -0.62)
        T = Crank(O, OT=2.3, angle=phi)
        P = OnLink(O, T, OP=0.62, TOP=-14 * deg)
        R = OnLink(O, T, OR=rng.uniform(0.38, 0.44), TOR=25 * deg)
        main = Cylinder(M, P, bore=100 * mm, rod=56 * mm)
        aux = Cylinder(N, R, bore=63 * mm, rod=36 * mm)
        load = Weight(T, mass=rng.uniform(900.0, 1300.0))
        rub = PinFriction(O, 40 * mm, rubbing)
        supply = Pump(210 * bar, mechanical_efficiency=0.88, hydraulic_efficiency=0.95)
        line = OilLine(main.piston_side, aux.piston_side, supply, Relief(190 * bar))
        back = OilLine(main.rod_side, aux.rod_side, Tank(8 * bar))

    return Flap()


@for_all("seed", (0,), slow=range(1, 10))
def test_a_cylinder_past_its_dead_point_has_the_pressure_of_its_line(seed):
    machine, angles = flap(seed), np.radians([-5.0, 40.0, 60.0, 80.0])
    motion = machine.at(phi=angles)
    first, second = (motion.ratio(distance(*ends)) for ends in ("MP", "NR"))
    assert first.min() > 0.0 and np.array_equal(second < 0.0, angles > 0.5)
    ways = {"main": (None, "extending", "retracting"), "aux": (None, "extending", "retracting")}
    told = {ram: [motion[pressure(ram, direction=way)] for way in each] for ram, each in ways.items()}
    lifting, lowering = told["main"][0], told["main"][2]
    assert_allclose(told["aux"][0], lifting, rtol=1e-9)
    for way, begins, goes_on in ((1, lifting, lowering), (2, lowering, lifting)):
        assert_allclose(told["aux"][way], np.where(second > 0.0, begins, goes_on), rtol=1e-9)
    assert_allclose(machine.evaluate([pressure("aux")], phi=angles)[0], lifting, rtol=1e-9)
    assert_allclose(motion[reserve("aux")], motion[reserve("main")], rtol=1e-9)
    ends = [machine.answers([least(reserve(ram))], over=Over(phi=(0.6, 1.0)))[0] for ram in ways]
    assert ends[0].value == pytest.approx(ends[1].value, rel=1e-9)
    verdicts = [str(each).replace("aux", "main") for each in machine.verdicts()]
    for rule in ("lifting", "lowering", "holding"):
        assert len({each for each in verdicts if f" {rule} main" in each}) == 1, rule
    with pytest.raises(DefinitionError, match="main and aux share their load by their areas beside what a tank pushes"):
        equations(machine, forces=True)
    if not machine["rub.coefficient"]:  # by virtual work
        (fills, empties), (small, ring) = ((np.pi / 4 * b**2, np.pi / 4 * (b**2 - r**2)) for b, r in ((0.1, 0.056), (0.063, 0.036)))
        needed = machine["load.mass"] * g0 * 2.3 * np.cos(angles)
        filled, back = fills * first + small * second, 8 * bar * (empties * first + ring * second)
        assert_allclose(lifting, (needed / 0.88 + back) / (0.95 * filled), rtol=1e-9)
        assert_allclose(lowering, (needed * 0.88 + back) / filled, rtol=1e-9)


@for_all("seed", (1,), slow=(0, *range(2, 6)))
def test_a_pump_gives_joined_cylinders_the_oil_and_the_work_of_their_line(seed):
    """Oil by differences of volumes, work by the pressure over these; on its way up aux passes its dead point and gives oil back."""
    machine = type(flap(seed))(**{"supply.flow": 300 * litre / minute})
    supply = machine.plan.members["supply"]
    run = supply.run(machine, demands={"main": 0.06}, start={"phi": 5 * deg}, until=9.0)
    fine = machine.at(phi=np.linspace(*run.strokes["phi"][[0, -1]], 401))
    small, large = (np.pi / 4 * bore**2 for bore in (0.063, 0.1))
    volume = large * fine.distance("M", "P") + small * fine.distance("N", "R")
    assert np.ptp(np.sign(np.diff(fine.distance("N", "R")))) == 2.0
    work = np.trapezoid(fine[pressure("main", direction="extending")], volume)
    for cycle in (run.cycle, supply.check(run)):
        assert_allclose([cycle.litres["line"], cycle.litres["supply"]], 1e3 * np.ptp(volume), rtol=1e-9)
        assert_allclose([cycle.energy.pump, cycle.energy.useful], work, rtol=1e-6)
        assert cycle.energy.braked == 0.0
    back = supply.run(machine, demands={"main": -0.06}, start=run, until=18.0)
    fine = machine.at(phi=np.linspace(*back.strokes["phi"][[-1, 0]], 401))
    volume = large * fine.distance("M", "P") + small * fine.distance("N", "R")
    freed = np.trapezoid(fine[pressure("main", direction="retracting")], volume)
    assert_allclose(back.cycle.energy.braked, freed, rtol=1e-6)
    assert back.cycle.litres["supply"] == 0.0


@for_all("seed", range(1), slow=range(1, 6))
def test_what_is_not_looked_at_shut_or_reached_is_told_by_name_and_number(seed):
    draw = Random(seed)
    given, opens, far = draw.uniform(150, 250) * bar, draw.uniform(60, 140) * bar, draw.uniform(2.0, 3.0)
    members = dict(supply=Pump(given), line=OilLine("ram.piston_side", "supply", Relief(opens)), back=OilLine("ram.rod_side", Tank()))
    ways = dict(near=Over(S=(0.0, 0.1), cases=["plain"]), never=Over(S=(0.0, 0.2), only=[distance("A", "B") >= far]))
    told = [str(each) for each in made(**members, **ways, parked=LoadCase("parked", shut=["line", "back"]))().verdicts()]
    assert told[0] == "ok   assembly: it is assembled over near: S = 0 to 100 mm."
    assert any(each.startswith("Over never: S = 0 to 200 mm") and "no place is left to look at" in each for each in told)
    says = f"The relief valve of line opens at {opens / bar:.4g} bar, below the pump's {given / bar:.4g} bar"
    assert any(each.startswith(says) for each in told)
    assert any("shut back:" in each for each in told)
    told = [str(each) for each in made(**members, near=ways["near"])().verdicts()]
    assert "The load case heavy occurs over no Over, so that nothing is judged in it." in told
    with pytest.raises(DefinitionError, match="2 pumps are on one line; leave one, with the flow of both"):
        made(line=OilLine("ram.piston_side", Pump(given), Pump(opens)))
