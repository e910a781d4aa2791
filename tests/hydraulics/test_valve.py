"""Lowering over a holding valve: against the two equations, over random machines, as requests, in files; and its verdicts."""

import numpy as np
import pytest

from hydraulics import Cylinder, HoldingValve, LiftCircuit, OilLine, Pump, Tank, load_pressure, pilot_pressure
from linkage import LEFT, DefinitionError, Dyad, Force, Ground, Guide, LoadCase, Mechanism, OnGuide, OnLink, Stroke, Weight
from linkage.files import load, to_toml
from linkage.units import bar, deg, kN, litre, minute, mm, show
from tests.for_all import for_all
from tests.members import told_by


class Press(Mechanism):
    """A ram that lowers 80 kN straight down."""

    S = Stroke(0.0, 0.5)
    O = Ground(0.0, 0.0)
    rail = Guide(O, angle=90 * deg)
    P = OnGuide(rail, at=1.0 + S)
    ram = Cylinder(O, P, bore=100 * mm, rod=70 * mm)
    weight = Force(P, (0.0, -80 * kN))
    supply, tank = Pump(200 * bar, flow=100 * litre / minute), Tank()
    lifting, lowering = OilLine("ram.piston_side", "supply"), OilLine("ram.rod_side", "tank")
    valve = HoldingValve("lifting", pilot="lowering", setting=140 * bar, ratio=3)


PISTON, ANNULUS = np.pi / 4 * 0.1**2, np.pi / 4 * (0.1**2 - 0.07**2)


def verdicts(machine, *rules):
    return [each for each in told_by(machine(), *machine.plan.of_kind((HoldingValve, OilLine))) if each.rule in rules]


def test_the_valve_opens_where_its_line_and_the_pilot_reach_the_setting():
    motion, valve = Press().sweep(3), Press.valve
    expected = np.linalg.solve([[1.0, 3.0], [PISTON, -ANNULUS]], [140 * bar, 80 * kN])
    assert valve.line_pressure(motion) == pytest.approx(np.full(3, expected[0]), rel=1e-12)
    assert valve.pilot_pressure(motion) == pytest.approx(np.full(3, expected[1]), rel=1e-12)
    assert valve.load_pressure(motion) == pytest.approx(np.full(3, 80 * kN / PISTON), rel=1e-12)
    setting, pilot = verdicts(Press, "setting", "pilot")
    assert setting.ok is True and "1.37 times" in setting.sentence
    assert pilot.ok is True and f"up to {expected[1] / bar:.4g} bar in lowering" in pilot.sentence
    assert not verdicts(Press, "lowering")  # it goes back over the valve, not by itself


def test_a_tank_with_pressure_presses_back_and_opens():
    """By hand: 12 bar on the annulus press more into the line, and count by the ratio on the valve; the line has one pressure."""

    class Loaded(Press):
        tank = Tank(12 * bar)

    motion, line = Loaded().sweep(2), (80 * kN + 12 * bar * ANNULUS) / PISTON
    assert Loaded.valve.load_pressure(motion) == pytest.approx(np.full(2, line + 3 * 12 * bar), rel=1e-12)
    assert f"holds up to {show(line, 'bar', 4)}" in str(*verdicts(Loaded, "holding"))
    (setting,) = verdicts(Loaded, "setting")
    assert setting.ok is False and "pressure in lowering act on the valve as up to 144 bar in lifting" in setting.sentence


@pytest.mark.slow
def test_where_the_load_opens_the_valve_and_where_the_pump_does_not():
    heavy = LoadCase("heavy", scale={"weight": 1.5})

    class Heavy(Press):
        full = heavy

    (setting,) = verdicts(Heavy, "setting")
    assert setting.ok is False and "in the case full" in setting.sentence and "Set it to 198.6 bar" in setting.sentence
    motion = Heavy().sweep(2)
    assert np.all(Heavy.valve.pilot_pressure(motion, case="full") == 0.0)
    assert Heavy.valve.line_pressure(motion, case="full") == pytest.approx(np.full(2, 120 * kN / PISTON))

    class Weak(Press):
        supply = Pump(5 * bar)

    (pilot,) = verdicts(Weak, "pilot")
    assert pilot.ok is False and "more than the pump's 5 bar. Take a valve of a larger ratio" in pilot.sentence

    class Pulled(Press):
        """The load drives upwards: nothing stands in the line, and the pilot side carries it wholly."""

        weight = Force("P", (0.0, 300 * kN))

    motion = Pulled().sweep(2)
    assert np.abs(Pulled.valve.line_pressure(motion)).max() < 1.0
    assert Pulled.valve.pilot_pressure(motion) == pytest.approx(np.full(2, 300 * kN / ANNULUS))


@for_all("seed", range(2), slow=range(2, 4))
def test_lowering_balances_on_random_arms(seed):
    rng = np.random.default_rng(seed)
    bore, way, count = rng.uniform(0.08, 0.12), [-1.0, 1.0][seed % 2], 1 + seed // 2

    class Arm(Mechanism):
        S = Stroke(0.0, 0.3)
        O, A = Ground(0.0, 0.0), Ground(0.9, -0.5)
        B = Dyad(A, O, AB=0.9 + S, OB=0.7, side=LEFT)
        G = OnLink(O, B, OG=2.0)
        ram = Cylinder(A, B, bore=bore, rod=0.6 * bore, count=count)
        pull = Force(G, (0.0, way * rng.uniform(8e3, 12e3)))
        out, back = OilLine("ram.piston_side", Pump(200 * bar)), OilLine("ram.rod_side", Pump(200 * bar))
        valve = HoldingValve(out if way < 0 else back, pilot=back if way < 0 else out, setting=250 * bar, ratio=rng.uniform(2, 8))

    motion, size = Arm().sweep(5), Arm.ram.size
    held, pilot = Arm.valve.line_pressure(motion), Arm.valve.pilot_pressure(motion)
    push, pull = (held, pilot) if way < 0 else (pilot, held)
    thrust = -Arm.pull.loads(motion)[0].force[1] * motion.ratio("G")[1]  # AB grows as S does
    assert push * size.push_area - pull * size.pull_area == pytest.approx(thrust, rel=1e-9)
    assert held + Arm.valve.ratio * pilot == pytest.approx(np.full(5, 250 * bar), rel=1e-12)
    assert np.all(held > 0.0) and np.all(pilot > 0.0)


def test_friction_and_efficiency_are_those_of_lowering():
    class Circuit(Press):
        supply = lifting = None
        line = LiftCircuit("ram", pressure=200 * bar, mechanical_efficiency=0.9)
        valve = HoldingValve("line", pilot="lowering", setting=140 * bar, ratio=3)

    motion = Circuit().sweep(2)
    expected = np.linalg.solve([[1.0, 3.0], [PISTON, -ANNULUS]], [140 * bar, 0.9 * 80 * kN])
    assert Circuit.valve.pilot_pressure(motion) == pytest.approx(np.full(2, expected[1]), rel=1e-12)


def test_two_cylinders_on_the_lines_are_one_of_both_areas():
    class Two(Press):
        twin = Cylinder("O", "P", bore=80 * mm, rod=50 * mm)
        lifting = OilLine("ram.piston_side", "twin.piston_side", "supply")
        lowering = OilLine("ram.rod_side", "twin.rod_side", "tank")

    piston, annulus = PISTON + np.pi / 4 * 0.08**2, ANNULUS + np.pi / 4 * (0.08**2 - 0.05**2)
    expected = np.linalg.solve([[1.0, 3.0], [piston, -annulus]], [140 * bar, 80 * kN])
    assert Two.valve.pilot_pressure(Two().sweep(2)) == pytest.approx(np.full(2, expected[1]), rel=1e-9)


class Boom(Mechanism):
    S = Stroke(0.0, 0.45)
    O, A = Ground(0.0, 0.0), Ground(0.45, -0.55)
    B = Dyad(A, O, AB=0.72 + S, OB=0.75, side=LEFT)
    G = OnLink(O, B, OG=2.4)
    ram = Cylinder(A, B, bore=80 * mm, rod=45 * mm)
    load = Weight(G, mass=900)
    supply, tank = Pump(210 * bar), Tank()
    lifting, lowering = OilLine("ram.piston_side", supply), OilLine("ram.rod_side", tank)
    valve = HoldingValve("lifting", pilot="lowering", setting=230 * bar, ratio=4)


def test_requests_have_derivatives_and_stand_in_files():
    motion, names = Boom().sweep(4), ["valve.setting", "valve.ratio", "ram.bore", "OB"]
    for request in (pilot_pressure("valve"), load_pressure("valve")):
        slopes = motion.gradient(request, wrt=names)
        for name, slope in zip(names, slopes, strict=True):
            value = {"valve.setting": 230 * bar, "valve.ratio": 4.0, "ram.bore": 0.08, "OB": 0.75}[name]
            step = 1e-5 * value
            up, down = (Boom(**{name: value + sign * step}).sweep(4)[request] for sign in (1, -1))
            assert slope == pytest.approx((up - down) / (2 * step), rel=1e-6, abs=1e-6 * np.abs(slope).max() + 1e-9)
    again = load(to_toml(Boom))
    assert np.array_equal(again.valve.pilot_pressure(again().sweep(4)), Boom.valve.pilot_pressure(motion))


def test_what_cannot_be_is_said_with_the_remedy():
    with pytest.raises(DefinitionError, match="Pilot ratio of the valve = 0 is not above zero; give the area of the pilot"):
        HoldingValve("a", pilot="b", setting=100 * bar, ratio=0)
    with pytest.raises(DefinitionError, match=r"Setting of the valve = -1e\+07 is not above zero; give the pressure"):
        HoldingValve("a", pilot="b", setting=-100 * bar, ratio=3)
    with pytest.raises(DefinitionError, match=r"write 100 \* bar if these are bar"):
        HoldingValve("a", pilot="b", setting=100, ratio=3)
    with pytest.raises(DefinitionError, match="lifting cannot be its own pilot"):

        class Own(Press):
            valve = HoldingValve("lifting", pilot="lifting", setting=140 * bar, ratio=3)

    with pytest.raises(DefinitionError, match="other has not the other side of ram, whose piston side lifting has"):

        class Elsewhere(Press):
            more = Cylinder("O", "P", bore=80 * mm, rod=50 * mm)
            other = OilLine("more.rod_side", Tank())
            valve = HoldingValve("lifting", pilot="other", setting=140 * bar, ratio=3)

    with pytest.raises(DefinitionError, match=r"no pump is on lifting or lowering.*put a Pump on lifting"):

        class Dead(Press):
            lifting = OilLine("ram.piston_side", Tank())

    with pytest.raises(DefinitionError, match="a line has one holding valve"):

        class Twice(Press):
            second = HoldingValve("lifting", pilot="lowering", setting=150 * bar, ratio=3)

    with pytest.raises(DefinitionError, match="HoldingValve 'valv' is unknown"):
        Press().sweep(2)[pilot_pressure("valv")]
