"""Oil lines: published and hand-worked pressures, and what one line shares."""

from itertools import product

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import (
    Accumulator,
    AccumulatorBlock,
    Cylinder,
    FloatCircuit,
    LiftCircuit,
    OilLine,
    Pump,
    Tank,
    capacity,
    pressure,
    reserve,
    thrust,
)
from linkage import (
    LEFT,
    RIGHT,
    Acting,
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
    Stroke,
    Weight,
    most,
    pin_forces,
)
from linkage.statics import work
from linkage.units import bar, deg, kN, litre, minute, mm
from tests.for_all import for_all
from tests.members import told_by


class Press(Mechanism):
    """A ram that pushes straight up against 40 kN."""

    S = Stroke(0.0, 0.5)
    O = Ground(0.0, 0.0)
    rail = Guide(O, angle=90 * deg)
    P = OnGuide(rail, at=1.0 + S)
    ram = Cylinder(O, P, bore=120 * mm, rod=85 * mm)
    load = Force(P, (0.0, -40 * kN))
    supply = Pump(200 * bar, flow=100 * litre / minute)


class Regenerative(Press):
    line = OilLine("ram.piston_side", "ram.rod_side", "supply")


class PistonAlone(Press):
    line = OilLine("ram.piston_side", "supply")


def test_a_regenerative_line_works_with_the_area_of_the_rod():
    both, one = Regenerative().sweep(5), PistonAlone().sweep(5)
    assert Regenerative.line.pressure(both) / bar == pytest.approx(np.full(5, 70.49), abs=5e-3)
    assert PistonAlone.line.pressure(one) / bar == pytest.approx(np.full(5, 35.37), abs=5e-3)
    assert 0.5 / Regenerative.line.time(both) == pytest.approx(0.2937, abs=5e-5)
    assert 0.5 / PistonAlone.line.time(one) == pytest.approx(0.1474, abs=5e-5)
    flow, speed = 100 * litre / minute, 0.5 / Regenerative.line.time(both)
    assert Regenerative.line.pressure(both)[0] * flow == pytest.approx(40 * kN * speed)


class Axle(Mechanism):
    """Two wheels on struts."""

    S1, S2 = Stroke(-0.1, 0.1), Stroke(-0.1, 0.1)
    L, R = Ground(-1.0, 0.0), Ground(1.0, 0.0)
    on_left, on_right = Guide(L, angle=90 * deg), Guide(R, angle=90 * deg)
    A, B = OnGuide(on_left, at=0.6 + S1), OnGuide(on_right, at=0.6 + S2)
    left, right = Cylinder(L, A, bore=80 * mm, rod=60 * mm), Cylinder(R, B, bore=80 * mm, rod=60 * mm)


def vessel():
    return AccumulatorBlock([Accumulator(volume=4 * litre, charge=40 * bar)])


class OnOneBlock(Axle):
    line = OilLine("left", "right", vessel(), charge_pressure=90 * bar, at=dict(S1=0.0, S2=0.0))


class OnTwoBlocks(Axle):
    one = OilLine("left", vessel(), charge_pressure=90 * bar, at=dict(S1=0.0))
    two = OilLine("right", vessel(), charge_pressure=90 * bar, at=dict(S2=0.0))


class Crossed(Axle):
    one = OilLine("left.piston_side", "right.rod_side", vessel(), charge_pressure=90 * bar, at=dict(S1=0.0, S2=0.0))
    two = OilLine("right.piston_side", "left.rod_side", vessel(), charge_pressure=90 * bar, at=dict(S1=0.0, S2=0.0))


def test_two_struts_on_one_vessel():
    bump, roll = Axle.S1, dict(S1=[-0.05, 0.05], S2=[0.05, -0.05])
    assert bump.start == -0.1
    assert OnOneBlock.line.pressure(OnOneBlock().at(S1=-0.05, S2=-0.05)) / bar == pytest.approx(125.19, abs=5e-3)
    assert OnTwoBlocks.one.pressure(OnTwoBlocks().at(S1=-0.05, S2=-0.05)) / bar == pytest.approx(104.7, abs=5e-2)
    assert OnOneBlock.line.pressure(OnOneBlock().at(**roll)) / bar == pytest.approx([90.0, 90.0])
    rolled = Crossed.one.pressure(Crossed().at(**roll)) / bar
    assert rolled[0] > 100.0 > 80.0 > rolled[1]
    motion = OnOneBlock().at(S1=-0.05, S2=-0.03)
    thrusts = pin_forces(motion).thrusts
    assert thrusts["left"] == pytest.approx(float(OnOneBlock.left.thrust(motion)), rel=1e-12)


class Levelled(Mechanism):
    """A boom whose forks are kept level by oil that its own movement pushes across."""

    S = Stroke(1.2, 1.9)
    A, C, M = Ground(0.0, 0.0), Ground(0.9, -0.4), Ground(0.3, -0.5)
    B = Dyad(C, A, CB=S, AB=1.6, side=LEFT)
    T, N, U = OnLink(A, B, AT=3.2), OnLink(A, B, AN=0.5), OnLink(A, B, AU=2.6)
    boom = Link(A, B, T, N, U)
    master, slave = Cylinder(M, N, bore=90 * mm, rod=50 * mm), Cylinder(U, "W", bore=100 * mm, rod=56 * mm)
    level = OilLine(master.piston_side, slave.piston_side, filled=dict(slave=0.72))
    W = Dyad(U, T, UW=slave.length, TW=0.35, side=RIGHT)
    F = OnLink(T, W, TF=1.0, FTW=70 * deg)
    fork = Link(T, W, F)
    lift = Cylinder(C, B, bore=140 * mm, rod=80 * mm)
    load = Weight(F, mass=2000)


def test_a_closed_line_keeps_its_oil_and_its_pressure_is_the_work_on_it():
    motion = Levelled().sweep(9)
    level, size = Levelled.level, 0.7 * np.pi / 4 * 0.1**2
    assert np.abs(level.oil(motion)).max() < 1e-12 * size
    forces = pin_forces(motion)
    for name in ("lift", "master", "slave"):
        assert forces.thrusts[name] == pytest.approx(getattr(Levelled, name).thrust(motion), rel=1e-11)
    step = 1e-6
    energy = [2000 * 9.80665 * Levelled(**{"level.oil": k * step}).sweep(9)["F"][1] for k in (-2, -1, 1, 2)]
    slope = (energy[0] - 8 * energy[1] + 8 * energy[2] - energy[3]) / (12 * step)
    assert level.pressure(motion) == pytest.approx(slope, rel=1e-8)
    hung = Acting(loads=[Force("F", (0.0, 20 * kN))])  # where it would have to suck, no side that no line has holds it
    pressed = level.pressure(motion, acting=hung)
    assert pressed.min() < -10 * bar
    for each, (side, held) in product(("master", "slave"), {"piston": np.maximum(pressed, 0.0), "rod": 0.0 * pressed}.items()):
        assert_allclose(motion[pressure(each, side=side, acting=hung)], held, rtol=1e-9)


class Unloaded(Levelled):
    load = None
    level = OilLine(Levelled.master.piston_side, Levelled.slave.piston_side, filled=dict(slave=0.72), make_up=5 * bar)


def test_a_closed_line_without_a_load_is_below_what_fills_it_up():
    (found,) = [each for each in told_by(Unloaded(), "level") if each.rule == "line"]
    assert found.ok is False and "below 5 bar it runs empty there" in found.sentence
    assert not [each for each in told_by(Unloaded(**{"level.make_up": 0.0}), "level")]


class Tilted(Levelled):
    """Both sides joined, of one ratio; a valve puts oil into one and takes what the rods leave out of the other."""

    V = Stroke(-2 * litre, 2 * litre)
    master, slave = Cylinder("M", "N", bore=100 * mm, rod=56 * mm), Cylinder("U", "W", bore=125 * mm, rod=70 * mm)
    level = OilLine(master.piston_side, slave.piston_side, filled=dict(slave=0.72), oil=V)
    other = OilLine(master.rod_side, slave.rod_side, filled=dict(slave=0.72), oil=(0.56**2 - 1) * V)


def test_oil_that_is_put_into_both_sides_moves_the_slave_by_its_area():
    motion = Tilted().at(S=[1.3, 1.6], V=[-1 * litre, 0.5 * litre])
    kept = Tilted().at(S=[1.3, 1.6], V=0.0)
    moved = motion.distance("U", "W") - kept.distance("U", "W")
    assert moved == pytest.approx(np.array([-1.0, 0.5]) * litre / (np.pi / 4 * 0.125**2), rel=1e-12)
    assert Tilted.level.oil(motion) == pytest.approx([-1 * litre, 0.5 * litre])
    pushes = [
        np.pi / 4 * (Tilted.level.pressure(motion) * bore**2 - Tilted.other.pressure(motion) * (bore**2 - rod**2))
        for bore, rod in ((0.125, 0.070), (0.100, 0.056))
    ]
    assert Tilted.slave.thrust(motion) == pytest.approx(pushes[0], rel=1e-12)
    assert Tilted.master.thrust(motion) == pytest.approx(pushes[1], rel=1e-12)
    assert min(Tilted.level.pressure(motion).min(), Tilted.other.pressure(motion).min()) == 0.0


class LevelledByName(Levelled):
    level = OilLine("master", "slave", filled=dict(slave=0.72))


class GasBelow(Press):
    """The gas stands under the piston; the pump pulls on the rod side against it."""

    gas = OilLine("ram.piston_side", vessel(), charge_pressure=90 * bar)
    pull = OilLine("ram.rod_side", "supply")


class GasBelowByName(GasBelow):
    gas = OilLine("ram", vessel(), charge_pressure=90 * bar)


def test_a_cylinder_alone_stands_for_the_side_that_is_left():
    motion, named = Levelled().sweep(5), LevelledByName().sweep(5)
    assert np.array_equal(named["slave.length"], motion["slave.length"])
    assert np.array_equal(LevelledByName.level.pressure(named), Levelled.level.pressure(motion))
    piston, annulus = np.pi / 4 * 0.12**2, np.pi / 4 * (0.12**2 - 0.085**2)
    for machine in (GasBelow, GasBelowByName):
        motion = machine().at(S=0.0)
        assert machine.pull.pressure(motion) == pytest.approx((90 * bar * piston - 40 * kN) / annulus, rel=1e-12)
        assert pin_forces(machine().at(S=0.01)).thrusts["ram"] == pytest.approx(40 * kN, rel=1e-12)


class Charged(Axle):
    circuit = FloatCircuit("left", vessel(), charge_pressure=90 * bar, seal_friction=2 * bar)


class ChargedLine(Axle):
    circuit = OilLine("left", vessel(), charge_pressure=90 * bar, seal_friction=2 * bar, at=dict(S1=0.0, S2=0.0))


class Pumped(Press):
    supply, line = None, LiftCircuit("ram", pressure=200 * bar, flow=100 * litre / minute, mechanical_efficiency=0.9)


class PumpedLine(Press):
    supply = Pump(200 * bar, flow=100 * litre / minute, mechanical_efficiency=0.9)
    line = OilLine("ram", "supply")


def test_circuits_and_lines_are_spellings_of_one_thing():
    a, b = Charged().at(S1=[-0.05, 0.02], S2=0.0), ChargedLine().at(S1=[-0.05, 0.02], S2=0.0)
    for direction in ("frictionless", "extending", "retracting"):
        assert np.array_equal(Charged.left.thrust(a, direction=direction), ChargedLine.left.thrust(b, direction=direction))
    a, b = Pumped().sweep(5), PumpedLine().sweep(5)
    assert np.array_equal(Pumped.line.pressure_for(a), PumpedLine.line.pressure(b))
    assert np.array_equal(Pumped.line.reserve(a), PumpedLine.line.reserve(b))
    assert [str(each) for each in Pumped().verdicts()] == [str(each) for each in PumpedLine().verdicts()]


def test_what_cannot_be_is_said_with_the_remedy():
    with pytest.raises(DefinitionError, match="two pressures in left's piston side"):

        class Twice(Axle):
            one, two = OilLine("left.piston_side", "right"), OilLine("left.piston_side", Tank())

    with pytest.raises(DefinitionError, match="a pump and a tank are on one line"):

        class PumpAndTank(Press):
            line = OilLine("ram.piston_side", "supply", Tank())

    with pytest.raises(DefinitionError, match="no chamber is on it"):

        class Empty(Press):
            line = OilLine("supply")

    with pytest.raises(DefinitionError, match=r"nothing says how long slave is where the line is filled; add filled=dict\(slave="):

        class Unfilled(Levelled):
            level = OilLine("master.piston_side", "slave.piston_side")

    with pytest.raises(DefinitionError, match="no closed line gives it; declare one"):

        class Unkept(Levelled):
            level = OilLine("master.piston_side", Tank())

    with pytest.raises(DefinitionError, match="locks the machine"):

        class Locked(Levelled):
            other = OilLine("master.rod_side", "slave.rod_side")

        Locked.lift.thrust(Locked().sweep(3))


class OnTank(Press):
    supply = Pump(200 * bar, flow=100 * litre / minute, mechanical_efficiency=0.9, hydraulic_efficiency=0.95)
    line, back = OilLine("ram.piston_side", "supply"), OilLine("ram.rod_side", Tank(5 * bar))


class WithBackPressure(Press):
    line = LiftCircuit("ram", pressure=200 * bar, mechanical_efficiency=0.9, hydraulic_efficiency=0.95, back_pressure=5 * bar)


def test_a_tank_on_the_other_side_is_a_back_pressure_while_it_lifts():
    assert not [name for name in OnTank().dimensions if name.startswith("back.")]  # the tank says it all
    a, b = WithBackPressure().sweep(3), OnTank().sweep(3)
    for name in ("reserve", "pressure_for", "largest"):
        assert getattr(OnTank.line, name)(b) == pytest.approx(getattr(WithBackPressure.line, name)(a), rel=1e-14)
    assert b[reserve("ram")] == pytest.approx(a[reserve("ram")], rel=1e-14)
    assert b[capacity("ram", "P")] == pytest.approx(a[capacity("ram", "P")], rel=1e-12)
    lifting = [[str(each) for each in told_by(machine(), "line") if each.rule == "lifting"] for machine in (OnTank, WithBackPressure)]
    assert lifting[0] == lifting[1]
    size = OnTank.ram.size  # it always counts: at rest it presses on the load's side
    assert OnTank.line.holding(b).working == pytest.approx((40 * kN + 5 * bar * size.pull_area) / size.push_area)
    drained = type("Drained", (OnTank,), {"back": OilLine("ram.rod_side", Tank())})
    assert drained.line.holding(drained().sweep(3)).working == pytest.approx(40 * kN / size.push_area, rel=1e-12)


def test_a_regenerative_line_has_bounds_and_holds():
    motion, area = Regenerative().sweep(2), np.pi / 4 * 0.085**2
    assert Regenerative.ram.bounds(motion, True)[1] == pytest.approx(200 * bar * area)
    assert Regenerative.line.reserve(motion) == pytest.approx(200 * bar * area / (40 * kN))
    holding = Regenerative.line.holding(motion)
    assert_allclose([holding.working, motion[pressure("ram", side="rod")]], 40 * kN / area, rtol=1e-12)
    assert np.all(holding.other == 0.0)
    (oil,) = [each for each in told_by(Regenerative(), "line") if each.rule == "oil"]
    assert f"{0.5 * area / litre:.2f} l from end to end, {0.5 * area / (100 * litre / minute):.1f} s" in oil.sentence


@for_all("seed", range(2), slow=range(2, 3))
def test_halves_on_one_line_and_joined_lines_of_one_pressure_change_nothing(seed):
    rng = np.random.default_rng(seed)
    x, y, bore, pull = rng.uniform(0.7, 1.0), rng.uniform(-0.6, -0.4), rng.uniform(0.06, 0.1), rng.uniform(2e3, 9e3)
    half = bore / np.sqrt(2.0)

    class Arm(Mechanism):
        S = Stroke(0.0, 0.3)
        O, A = Ground(0.0, 0.0), Ground(x, y)
        B = Dyad(A, O, AB=0.9 + S, OB=0.7, side=LEFT)
        G = OnLink(O, B, OG=2.0)
        ram = Cylinder(A, B, bore=bore, rod=0.6 * bore)
        pulled = Force(G, (0.3 * pull, -pull))
        supply = Pump(200 * bar)
        line, back = OilLine("ram.piston_side", supply), OilLine("ram.rod_side", Tank(5 * bar))

    class Halves(Arm):
        ram, more = Cylinder("A", "B", bore=half, rod=0.6 * half), Cylinder("A", "B", bore=half, rod=0.6 * half)
        line = OilLine("ram.piston_side", "more.piston_side", "supply")
        back = OilLine("ram.rod_side", "more.rod_side", Tank(5 * bar))

    class Parted(Halves):
        back, other = OilLine("ram.rod_side", Tank(5 * bar)), OilLine("more.rod_side", Tank(5 * bar))

    motions = [each().sweep(5) for each in (Arm, Halves, Parted)]
    whole, halves, parted = (machine.line.pressure(motion) for machine, motion in zip((Arm, Halves, Parted), motions, strict=True))
    assert halves == pytest.approx(whole, rel=1e-12) and parted == pytest.approx(whole, rel=1e-12)
    thrusts = [pin_forces(motion).thrusts for motion in motions]
    assert thrusts[1]["ram"] + thrusts[1]["more"] == pytest.approx(thrusts[0]["ram"], rel=1e-9)
    assert thrusts[2]["ram"] == pytest.approx(0.5 * thrusts[0]["ram"], rel=1e-9)


def test_what_several_laws_read_of_a_closed_line_is_traced_once_and_counts_for_each(monkeypatch):
    """In either order, alone or together the values are the same, and each law keeps what it rests on."""
    counted = []
    known = work.shared_by_cylinders

    def counting(motion, acting, rates, what, make):
        def made():
            counted.append(type(motion).__name__ if what[0] == "needs" else "other")
            return make()

        return known(motion, acting, rates, what, made)

    monkeypatch.setattr(work, "shared_by_cylinders", counting)

    def asked(*names):
        class Fresh(Levelled):
            pass

        requests = [thrust(name) for name in names]
        found = Fresh().evaluate(requests, S=np.linspace(1.25, 1.85, 7))
        bound = [each.bound(Fresh.plan) for each in requests]
        rests = [(each.names(Fresh.plan), each.differentiated(Fresh.plan), list(each.notes(Fresh.plan).assumed.values())) for each in bound]
        return dict(zip(names, zip(found, rests, strict=True), strict=True))

    alone = {name: asked(name)[name] for name in ("lift", "master", "slave")}
    counted.clear()
    for names in (("lift", "master", "slave"), ("slave", "master", "lift")):
        together = asked(*names)
        for name, (values, rests) in alone.items():
            assert_allclose(together[name][0], values, rtol=1e-14)
            assert together[name][1] == rests
    assert 0 < counted.count("TracedMotion") <= 2 * 3  # the twin that knows laws apart, the program, and what is read here; not by cylinder


def test_a_circuit_and_a_line_never_share_a_chamber_nor_drive_a_cylinder_by_two_pumps():
    pumps = {"lift": LiftCircuit("ram", pressure=200 * bar), "shared": LiftCircuit("ram", Pump(200 * bar))}
    singles = pumps | {"gas": FloatCircuit("ram", vessel(), charge_pressure=90 * bar)}
    put = {"pump": Pump(160 * bar), "tank": Tank(5 * bar), "nothing": None}
    for works, single, (what, on), order in product((None, "piston", "rod"), singles, put.items(), (1, -1)):
        ram = Cylinder("O", "P", bore=80 * mm, rod=50 * mm, works=works)
        own, other = ("rod", "piston") if works == "rod" else ("piston", "rod")
        for side in (own, other):
            line = OilLine(f"ram.{side}_side", *([] if on is None else [on]))
            members = {"ram": ram} | dict([("one", singles[single]), ("two", line)][::order])
            structure = ("Doubled", (Press,), {"line": None, "supply": None} | members)
            if side == own or what == "pump":
                match = "two pressures in ram's .* side: .*the side that ram works with" if side == own else "both drive ram"
                with pytest.raises(DefinitionError, match=match):
                    type(*structure)
            elif what == "tank":
                assert type(*structure)().plan.members["ram"].side == own


@for_all("seed", range(3), slow=range(3, 30))
def test_joined_sides_have_the_pressure_of_their_line_and_hold_no_pull(seed):
    draw = np.random.default_rng(seed)
    bore, rod, force, kind = draw.uniform(0.06, 0.12), draw.uniform(0.03, 0.05), draw.uniform(10, 60) * kN, seed % 3
    own = {"ram": Cylinder("O", "P", bore=bore, rod=rod), "load": Force("P", (0.0, -force)), "pull": LoadCase(scale={"load": -1.0})}
    if kind == 1:
        own |= {"Q": Ground(0.0, 4.0), "top": Cylinder("Q", "P", bore=80 * mm, rod=50 * mm)}
    on = [("supply",), ("top.rod_side", "supply"), (vessel(),)][kind]
    charged = {"charge_pressure": draw.uniform(60, 90) * bar, "at": 0.0} if kind == 2 else {}
    machine = type("Ram", (Press,), {**own, "line": OilLine("ram.piston_side", "ram.rod_side", *on, **charged)})()
    line, ram = machine.plan.members["line"], machine.plan.members["ram"]
    motion, area = machine.sweep(3), np.pi / 4 * rod**2
    joined = area + (np.pi / 4 * (0.08**2 - 0.05**2) if kind == 1 else 0.0)
    whole = line.pressure(motion) if kind == 2 else np.full(3, force / joined)
    assert_allclose(ram.thrust(motion), whole * area, rtol=1e-9)
    for side in ("piston", "rod"):
        assert_allclose(motion[pressure("ram", side=side)], whole, rtol=1e-9)
        assert_allclose(machine.answers([most(pressure("ram", side=side))])[0].value, np.max(whole), rtol=1e-9)
    if kind == 2:
        return
    rules = [f"{rule}{' ram' * (kind == 1)}" for rule in ("holding", "lowering")]
    asked = [line.conditions(machine.judge())[rule] for rule in rules]
    none = most(pressure("ram", side="rod", case="pull")) <= 0.0
    assert [each.ok for each in machine.answers([none, *asked])] == [True, False, False]
    told = {each.rule: each for each in machine.verdicts()}
    pulls = f"pulls at it with up to {force * area / joined / kN:.4g} kN, in the case pull, at S = 0.0 mm: both of its sides"
    assert pulls in told[rules[0]].sentence and [told[rule].ok for rule in rules] == [False, False]
    if kind == 0:
        with pytest.raises(DefinitionError, match="no oil brakes it"):
            Press.supply.run(machine, demands={"ram": 0.1}, start={"S": 0.1}, until=1.0, acting=Acting(case="pull"))
