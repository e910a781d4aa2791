"""Lines that a load case shuts: worked by hand, against holding, and by the balance of each cylinder."""

import numpy as np
import pytest

from hydraulics import Accumulator, AccumulatorBlock, Cylinder, FloatCircuit, LiftCircuit, OilLine, Pump, Relief, Tank, pressure
from linkage import (
    LEFT,
    DefinitionError,
    Dyad,
    Force,
    Ground,
    Guide,
    LoadCase,
    Mechanism,
    OnGuide,
    OnLink,
    Over,
    Part,
    Stroke,
    Weight,
    pin_forces,
)  # fmt: skip
from linkage.files import load, to_toml
from linkage.units import bar, deg, kN, litre, minute, mm
from tests.for_all import for_all
from tests.members import told_by


class Press(Mechanism):
    """A ram that pushes straight up, its rod side on a tank that can be shut."""

    S = Stroke(0.0, 0.5)
    O = Ground(0.0, 0.0)
    rail = Guide(O, angle=90 * deg)
    P = OnGuide(rail, at=1.0 + S)
    ram = Cylinder(O, P, bore=100 * mm, rod=70 * mm)
    push = Force(P, (0.0, -40 * kN))
    supply = Pump(200 * bar, flow=100 * litre / minute)
    line = OilLine("ram.piston_side", "supply")
    tank = Tank(5 * bar)
    back = OilLine("ram.rod_side", tank)
    empty = LoadCase("empty", only=[], shut=["back"])
    parked = LoadCase("parked", shut=["back", line])


PISTON, ANNULUS = np.pi / 4 * 0.1**2, np.pi / 4 * (0.1**2 - 0.07**2)


def verdict(machine, rule):
    (found,) = [each for each in told_by(machine(), *machine.plan.of_kind(OilLine)) if each.rule.split()[0] == rule]
    return found


@pytest.mark.slow
def test_a_pump_against_a_shut_rod_side():
    motion = Press().sweep(3)
    assert Press.back.intensified(motion, case="empty") / bar == pytest.approx(np.full(3, 392.2), abs=0.05)
    loaded = Press.back.intensified(motion, case=LoadCase("own", shut=["back"]))
    assert loaded == pytest.approx(np.full(3, (200 * bar * PISTON - 40 * kN) / ANNULUS), rel=1e-12)
    found = verdict(Press, "shut")
    assert found.ok is False and "up to 392.2 bar" in found.sentence and "put a Relief on back" in found.sentence

    class Strong(Press):
        back = OilLine("ram.rod_side", Tank(5 * bar), Relief(400 * bar))

    class Weak(Press):
        back = OilLine("ram.rod_side", Tank(5 * bar), Relief(390 * bar))

    assert verdict(Strong, "shut").ok is True
    assert verdict(Weak, "shut").ok is False and "its relief valve opens at 390 bar" in verdict(Weak, "shut").sentence
    told = told_by(Press(), "line")  # of what moves
    assert [each.ok for each in told if each.rule in ("lifting", "lowering")] == [True, True]


def test_shut_sides_carry_what_the_load_asks_with_the_least_that_balances():
    motion = Press().sweep(3)
    assert Press.line.pressure(motion, case="parked") == pytest.approx(np.full(3, 40 * kN / PISTON), rel=1e-12)
    assert np.all(Press.back.pressure(motion, case="parked") == 0.0)
    assert Press.line.pressure(motion) == pytest.approx(np.full(3, (40 * kN + 5 * bar * ANNULUS) / PISTON), rel=1e-12)
    pulled = LoadCase("pulled", scale={"push": -1.0}, shut=["back", "line"])
    assert np.all(Press.line.pressure(motion, case=pulled) == 0.0)
    assert Press.back.pressure(motion, case=pulled) == pytest.approx(np.full(3, 40 * kN / ANNULUS), rel=1e-12)


@for_all("seed", range(2), slow=range(2, 4))
def test_both_sides_shut_are_holding(seed):
    rng = np.random.default_rng(seed)
    x, y, bore = rng.uniform(-0.6, 0.2), rng.uniform(0.2, 0.5), rng.uniform(0.05, 0.1)

    class Arm(Mechanism):
        S = Stroke(0.0, 0.3)
        O, A = Ground(0.0, 0.0), Ground(0.9, -0.5)
        B = Dyad(A, O, AB=0.9 + S, OB=0.7, side=LEFT)
        G = OnLink(O, B, OG=2.0)
        ram = Cylinder(A, B, bore=bore, rod=0.6 * bore)
        weight, pull = Weight(G, mass=300), Force(G, (3000 * x, 9000 * y))
        line = LiftCircuit(ram, pressure=200 * bar)
        back = OilLine("ram.rod_side", Tank())
        shut = LoadCase("shut", shut=["line", "back"])

    motion = Arm().sweep(5)
    held = Arm.line.holding(motion, case="shut")
    assert Arm.ram.pressure(motion, case="shut") == pytest.approx(held.working, abs=1e-6)
    assert Arm.back.pressure(motion, case="shut") == pytest.approx(held.other, abs=1e-6)
    assert pin_forces(motion, case="shut").thrusts["ram"] == pytest.approx(Arm.ram.thrust(motion), rel=1e-9)
    found = Arm().at(S=[0.0, 0.1])[pressure("ram", side="rod", circuit="line", case="shut")]
    assert found == pytest.approx(Arm.line.holding(Arm().at(S=[0.0, 0.1]), case="shut").other, abs=1e-6)


def block():
    return AccumulatorBlock([Accumulator(volume=4 * litre, charge=40 * bar)])


class Axle(Mechanism):
    """Two wheels on struts, crossed."""

    S1, S2 = Stroke(-0.1, 0.1), Stroke(-0.1, 0.1)
    L, R = Ground(-1.0, 0.0), Ground(1.0, 0.0)
    on_left, on_right = Guide(L, angle=90 * deg), Guide(R, angle=90 * deg)
    A, B = OnGuide(on_left, at=0.6 + S1), OnGuide(on_right, at=0.6 + S2)
    left, right = Cylinder(L, A, bore=80 * mm, rod=50 * mm), Cylinder(R, B, bore=80 * mm, rod=50 * mm)
    one = OilLine("left.piston_side", "right.rod_side", block(), charge_pressure=90 * bar)
    two = OilLine("left.rod_side", "right.piston_side", block(), charge_pressure=90 * bar)
    on_a, on_b = Weight(A, mass=400), Weight(B, mass=900)
    locked = LoadCase("locked", shut=["one", "two"])
    half = LoadCase("half", shut=["one"])


def test_gas_that_is_shut_is_rigid_and_holds():
    motion = Axle().at(S1=[-0.05, 0.02], S2=0.01)
    piston, annulus = np.pi / 4 * 0.08**2, np.pi / 4 * (0.08**2 - 0.05**2)
    expected = np.linalg.solve([[piston, -annulus], [-annulus, piston]], [400 * 9.80665, 900 * 9.80665])
    for line, found in zip((Axle.one, Axle.two), expected, strict=True):
        assert line.pressure(motion, case="locked") == pytest.approx(np.full(2, found), rel=1e-12)
    assert pin_forces(motion, case="locked").thrusts["right"] == pytest.approx(np.full(2, 900 * 9.80665))
    assert np.ptp(Axle.one.pressure(motion)) > 1 * bar  # open, the pose tells it
    with pytest.raises(DefinitionError, match="one pressure cannot hold several strokes"):
        Axle.one.pressure(motion, case="half")

    class Lone(Axle):
        one, two = FloatCircuit("left", block(), charge_pressure=90 * bar), None
        locked, half = LoadCase("locked", shut=["one"]), LoadCase("lifted", scale={"on_a": -1.0}, shut=["one"])

    motion = Lone().at(S1=[-0.05, 0.02], S2=0.01)
    assert Lone.left.thrust(motion, case="locked") == pytest.approx(np.full(2, 400 * 9.80665))
    assert Lone.left.pressure(motion, case="locked") == pytest.approx(np.full(2, 400 * 9.80665 / piston))
    found = verdict(Lone, "shut")
    assert found.ok is False and "it runs empty there" in found.sentence


def test_a_shut_line_in_files_and_parts_and_derivatives():
    again = load(to_toml(Press))
    assert again.parked.shut_names == ("back", "line") and 'shut = ["back", "line"]' in to_toml(Press)
    assert np.array_equal(again.line.pressure(again().sweep(3), case="parked"), Press.line.pressure(Press().sweep(3), case="parked"))
    slope = Press().sweep(2).gradient(pressure("ram", case="parked"), wrt=["ram.bore"])
    assert slope[0] == pytest.approx(np.full(2, -2 * 40 * kN / PISTON / 0.1), rel=1e-9)

    class Two(Mechanism):
        S = Stroke(0.0, 0.5)
        lower = Part(Press, S=S)
        parked = LoadCase("parked", shut=["lower.back", "lower.line"])

    motion = Two().sweep(2)
    assert motion.plan.members["lower.line"].pressure(motion, case="parked") == pytest.approx(np.full(2, 40 * kN / PISTON))


def test_what_cannot_be_shut_is_said_with_what_can():
    with pytest.raises(DefinitionError, match=r"push is a Force and cannot be shut; what can be shut is line, back"):

        class Wrong(Press):
            empty = LoadCase("empty", shut=["push"])

    with pytest.raises(DefinitionError, match=r"'bakc' is unknown in Press, x, shut\. Did you mean back"):
        Press.line.pressure(Press().sweep(2), case=LoadCase("x", shut=["bakc"]))
    with pytest.raises(DefinitionError, match=r'write their names, shut=\["line"\]'):
        LoadCase("x", shut="line")
    with pytest.raises(DefinitionError, match="no pump is on the other side"):
        Press.back.intensified(Press().sweep(2), case="parked")


class Hung(Mechanism):
    """A ram upright that a load pulls out; its rod side is on a tank."""

    S = Stroke(0.0, 0.5)
    O = Ground(0.0, 0.0)
    rail = Guide(O, angle=90 * deg)
    P = OnGuide(rail, at=1.0 + S)
    ram = Cylinder(O, P, bore=120 * mm, rod=85 * mm)
    load = Force(P, (0.0, 30 * kN))
    line, back = OilLine(ram.piston_side, Pump(200 * bar)), OilLine(ram.rod_side, Tank(5 * bar))


class Pressed(Hung):
    """The same with a load that presses, the rod side on the pump."""

    load = Force("P", (0.0, -30 * kN))
    line, back = OilLine("ram.rod_side", Pump(200 * bar)), OilLine("ram.piston_side", Tank(5 * bar))


@for_all("kind, bears, acts, other", [(Hung, "53.24 bar", "pulls at", "press on"), (Pressed, "26.53 bar", "presses on", "pull at")])
def test_the_remedy_for_a_load_that_no_oil_holds_leads_to_no_other_failure(kind, bears, acts, other):
    told = next(each for each in kind().verdicts() if each.rule == "holding line")
    assert told.ok is False and f"the load {acts} it with up to" in told.sentence
    assert f"shut this line and that side's, which then has to bear {bears}, or let the load {other} it." in told.sentence
    shut = {"parked": LoadCase("parked", shut=["line", "back"]), "stands": Over(cases=["parked"])}
    found = {each.rule: each for each in type("Shut", (kind,), shut)().verdicts()}
    assert found["holding line"].ok and found["shut back"].ok and bears in found["shut back"].sentence


def test_lifting_says_in_which_load_cases_nothing_limits_it():
    cases = {"load": Force("P", (0.0, -30 * kN)), "up": LoadCase("up", scale={"load": -1.0}), "less": LoadCase("less", scale={"load": 0.5})}
    found = {each.rule: each.sentence for each in type("Turned", (Hung,), cases)().verdicts()}
    assert "the load drives all the way in the case up, there it is not limited by this cylinder" in found["lifting line"]
    assert "in the case less" not in found["lifting line"]
