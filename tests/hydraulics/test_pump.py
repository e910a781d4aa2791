"""One pump for several lines, by hand: blocks on springs, lifts, a press, and what is refused."""

import pickle
import re

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Cylinder, HoldingValve, LiftCircuit, OilLine, Pump, Relief, Tank, pressure
from linkage import Course, DefinitionError, Force, Ground, Guide, Mechanism, OnGuide, Over, Part, Stroke, ramp
from linkage.files import from_dict, to_dict
from linkage.loads import Acting, Damper, GuideFriction, Spring, Weight
from linkage.units import bar, litre, minute

AREA, ANNULUS = np.pi / 4 * 0.08**2, np.pi / 4 * (0.08**2 - 0.045**2)
FLOW, POWER = 30 * litre / minute, 2000.0


class Block(Mechanism):
    """A cylinder along x pushes a block against a spring that is free where the cylinder is in."""

    S = Stroke(0.0, 0.4)
    O, X, W = Ground(0, 0), Ground(1, 0), Ground(2.0, 0)
    way = Guide(O, X)
    B = OnGuide(way, at=S + 0.5)
    ram = Cylinder(O, B, bore=0.08, rod=0.045, works="both")
    spring = Spring(B, W, stiffness=400e3, free_length=1.5)


class OneBlock(Mechanism):
    S = Stroke(0.0, 0.4)
    supply = Pump(300 * bar, flow=FLOW, power=POWER)
    one = Part(Block, S=S)
    line = LiftCircuit("one.ram", supply, relief=200 * bar)


class TwoBlocks(Mechanism):
    S, T = Stroke(0.0, 0.4), Stroke(0.0, 0.4)
    supply = Pump(300 * bar, flow=FLOW)
    one, two = Part(Block, S=S), Part(Block, S=T, at=(0, 1))
    first_line, second_line = LiftCircuit("one.ram", supply, relief=200 * bar), LiftCircuit("two.ram", supply, relief=200 * bar)


def pump_of(machine):
    return machine.plan.members["supply"]


def test_a_block_on_a_spring_goes_by_the_flow_then_by_the_power_then_stands_at_the_relief_valve():
    machine, c = OneBlock(), 400e3
    run = pump_of(machine).run(machine, demands={"one.ram": np.inf}, start={"S": 0.01}, until=8.0)
    bend, most = POWER * AREA / (FLOW * c), 200 * bar * AREA / c
    first = (bend - 0.01) * AREA / FLOW
    last = first + (most**2 - bend**2) * c / (2 * POWER)
    kinds = {event.kind: event for event in run.events}
    assert_allclose([kinds["power"].time, kinds["relief"].time], [first, last], rtol=0, atol=1e-9)
    assert "200 bar" in kinds["relief"].sentence and str(kinds["relief"]).startswith(f"at {last:.7g} s: one.ram is blocked")
    time = run.time
    wanted = np.where(time < first, 0.01 + FLOW / AREA * time, np.sqrt(bend**2 + 2 * POWER / c * np.maximum(time - first, 0)))
    assert_allclose(run.strokes["S"], np.minimum(wanted, most), rtol=0, atol=5e-12)
    inside = (time > first + 1e-6) & (time < last - 1e-6)
    assert_allclose(run.rates["S"][inside], POWER / (c * wanted[inside]), rtol=1e-10)
    cycle = run.cycle
    assert_allclose(cycle.energy.useful, c * (most**2 - 0.01**2) / 2, rtol=3e-11)
    assert_allclose([cycle.litres["line"], cycle.litres["supply"]], 1e3 * AREA * (run.strokes["S"][-1] - 0.01), rtol=1e-12)
    assert cycle.pressure["supply"][-1] == 200 * bar and cycle.flow["supply"][-1] == 0.0 and cycle.energy.braked == 0.0


def test_two_blocks_by_demand_go_together_and_least_pressure_first_to_one_pressure():
    machine = TwoBlocks()
    asked = {"one.ram": 0.1, "two.ram": 0.2}
    run = pump_of(machine).run(machine, demands=asked, until=1.0)
    share = FLOW / (AREA * 0.3)
    assert_allclose(run.strokes["T"], 0.2 * share * run.time, atol=1e-13)
    assert_allclose(run.cycle.share["one.ram"], share, rtol=1e-13)

    class Least(TwoBlocks):
        supply = Pump(300 * bar, flow=FLOW, sharing="least pressure first")
        two = Part(Block, S=TwoBlocks.T, at=(0, 1), **{"spring.stiffness": 800e3})

    run = pump_of(Least()).run(Least(), demands=asked, start={"S": 0.0, "T": 0.02}, until=3.0)
    level = (0.04 - 0.0) / 0.1  # until then the first has all it asks for; the second gets the rest and so goes ahead of it
    S, T, time = run.strokes["S"], run.strokes["T"], run.time
    assert_allclose(AREA * (S + T - 0.02), np.minimum(FLOW, AREA * 0.3) * time, atol=1e-13)
    later = time > level
    assert np.all(400e3 * S <= 800e3 * T + 1e-3) and run.rates["S"][later].max() <= 0.1 + 1e-12


def test_needs_that_come_together_stay_level():
    class Least(TwoBlocks):
        supply = Pump(300 * bar, flow=0.3 * FLOW, sharing="least pressure first")
        two = Part(Block, S=TwoBlocks.T, at=(0, 1), **{"spring.stiffness": 800e3})

    run = pump_of(Least()).run(Least(), demands={"one.ram": 0.1, "two.ram": 0.1}, start={"S": 0.0, "T": 0.02}, until=4.0)
    S, T, time = run.strokes["S"], run.strokes["T"], run.time
    met = 0.04 * AREA / (0.3 * FLOW)
    assert_allclose(run.events[1].time, met, atol=1e-9)
    level = time > met + 1e-3
    assert_allclose(400e3 * S[level], 800e3 * T[level], rtol=1e-9)
    assert_allclose(AREA * (S + T - 0.02), 0.3 * FLOW * time, atol=1e-12)


class Lift(Mechanism):
    S = Stroke(0.0, 0.4)
    O, X = Ground(0, 0), Ground(0, 1)
    way = Guide(O, X)
    B = OnGuide(way, at=S + 0.5)
    ram = Cylinder(O, B, bore=0.08, rod=0.045, works="both")
    load = Weight(B, mass=3000.0)


class TwoLifts(TwoBlocks):
    supply = Pump(250 * bar, flow=FLOW, margin=15 * bar)
    one, two = Part(Lift, S=TwoBlocks.S), Part(Lift, S=TwoBlocks.T, at=(1, 0))


def test_two_equal_lifts_share_a_tie_and_one_of_them_comes_to_its_end():
    for sharing in ("by demand", "least pressure first"):

        class Lifts(TwoLifts):
            supply = Pump(250 * bar, flow=FLOW, margin=15 * bar, sharing=sharing)

        machine = Lifts()
        run = pump_of(machine).run(machine, demands={"one.ram": 0.1, "two.ram": 0.1}, start={"S": 0.3}, until=3.0)
        v, end = FLOW / (2 * AREA), 0.1 * 2 * AREA / FLOW
        stop = next(event for event in run.events if event.kind == "stop")
        assert stop.of == "one.ram" and abs(stop.time - end) < 1e-9
        assert_allclose(run.strokes["T"], np.where(run.time < end, v * run.time, v * end + (run.time - end) * min(0.1, 2 * v)), atol=1e-11)
        need, cycle = 3000 * 9.80665 / AREA, run.cycle
        before = cycle.time < end - 1e-6
        assert_allclose(cycle.pressure["supply"][before], need + 15 * bar, rtol=1e-12)
        assert np.all(cycle.pressure["supply"][cycle.time > end + 1e-6] == 200 * bar)  # its relief valve
        assert_allclose(cycle.energy.useful, need * AREA * (run.strokes["S"][-1] + run.strokes["T"][-1] - 0.3), rtol=1e-11)
        assert_allclose(cycle.energy.margin, 15 * bar * cycle.litres["supply"] / 1e3, rtol=1e-12)


def test_a_load_that_drives_is_braked_and_a_tier_is_served_first():
    class Tiered(TwoLifts):
        supply = Pump(250 * bar, flow=0.5 * FLOW, first=["two.ram"])

    machine = Tiered()
    run = pump_of(machine).run(machine, demands={"one.ram": 0.1, "two.ram": -0.06}, start={"T": 0.35}, until=2.0)
    assert_allclose(run.rates["T"], -0.06, rtol=1e-12)
    assert_allclose(run.rates["S"], (0.5 * FLOW - 0.06 * ANNULUS) / AREA, rtol=1e-12)
    assert_allclose(run.cycle.energy.braked, 3000 * 9.80665 * 0.12, rtol=1e-11)
    closed = run.cycle.energy.useful - run.cycle.energy.braked - 3000 * 9.80665 * (run.strokes["S"][-1] + run.strokes["T"][-1] - 0.35)
    assert abs(closed) < 1e-9 * run.cycle.energy.useful


def test_a_damper_takes_power_and_a_holding_valve_its_pilot():
    class Damped(TwoLifts):
        supply = Pump(250 * bar, flow=FLOW, power=2500.0)
        damper = Damper("one.O", "one.B", coefficient=5e4)

    machine = Damped()
    run = pump_of(machine).run(machine, demands={"one.ram": 0.12}, until=1.0)
    weight = 3000 * 9.80665
    v = (np.sqrt(weight**2 + 4 * 5e4 * 2500.0) - weight) / (2 * 5e4)  # (weight + c v) v is the power
    assert_allclose(run.rates["S"], v, rtol=1e-11)

    class Valved(Mechanism):
        S = Stroke(0.0, 0.4)
        supply = Pump(250 * bar, flow=FLOW)
        one = Part(Lift, S=S, ram=None)
        ram = Cylinder("one.O", "one.B", bore=0.08, rod=0.045)
        up, down = OilLine("ram.piston_side", supply, Relief(200 * bar)), OilLine("ram.rod_side", supply)
        valve = HoldingValve("up", pilot="down", setting=120 * bar, ratio=4.0)

    class OnTank(Valved):
        down = OilLine("ram.rod_side", Tank())  # on the tank while it lifts, on the pump while it lowers

    pilot = (AREA * 120 * bar - weight) / (4 * AREA + ANNULUS)
    for machine in (Valved(), OnTank()):
        run = pump_of(machine).run(machine, demands={"ram": -0.1}, start={"S": 0.35}, until=1.0)
        assert_allclose(run.cycle.pressure["supply"], pilot, rtol=1e-12)
        energy, given = run.cycle.energy, pilot * ANNULUS * 0.1
        assert_allclose([energy.useful, energy.braked], [given, given + weight * 0.1], rtol=1e-11)
        assert_allclose([run.cycle.litres[each] for each in ("up", "down", "supply")], [0.0, 100 * ANNULUS, 100 * ANNULUS], atol=1e-12)


class Press(Mechanism):
    """A press whose ram comes down fast with both sides on one line."""

    S = Stroke(0.0, 0.4)
    supply = Pump(250 * bar, flow=FLOW)
    one = Part(Block, S=S, ram=None)
    ram = Cylinder("one.O", "one.B", bore=0.08, rod=0.056)
    line = OilLine("ram.piston_side", "ram.rod_side", supply, Relief(200 * bar))


def test_a_regenerative_press_takes_the_oil_of_its_rod():
    machine = Press()
    run = pump_of(machine).run(machine, demands={"ram": np.inf}, until=1.0)
    rod = np.pi / 4 * 0.056**2
    moving = run.time < 200 * bar * rod / 400e3 * rod / FLOW
    assert_allclose(run.rates["S"][moving], FLOW / rod, rtol=1e-12)
    assert_allclose(run.strokes["S"][-1], 200 * bar * rod / 400e3, rtol=2e-11)
    back = pump_of(machine).run(machine, demands={"ram": -0.1}, start=run, until=2.0)  # the spring drives it, and it needs no oil
    given = 200e3 * (run.strokes["S"][-1] ** 2 - back.strokes["S"][-1] ** 2)
    assert_allclose([back.cycle.energy.braked, back.cycle.litres["supply"]], [given, 0.0], rtol=1e-11)
    pulled = Press(**{"one.spring.free_length": 1.0})
    with pytest.raises(DefinitionError, match="no pump fills its rod side"):
        pump_of(pulled).run(pulled, demands={"ram": -0.1}, start={"S": 0.1}, until=1.0)


class Timed(TwoLifts):
    supply = Pump(150 * bar, flow=FLOW, power=4000.0)
    cycle = Over.path(S=ramp(0.0, 0.3, speed=0.15, acceleration=0.5), T=ramp(0.0, 0.3, speed=0.1, acceleration=0.5))


@pytest.mark.slow
def test_a_given_motion_is_checked_with_its_stretch_in_the_machines_verdicts_too():
    machine = Timed()
    cycle = pump_of(machine).check(machine.sweep(11, over="cycle"))
    asked = AREA * 0.25
    power = asked * 3000 * 9.80665 / AREA
    assert_allclose(cycle.peak(cycle.flow["supply"]), [asked, 0.3], rtol=1e-9)
    assert_allclose(cycle.stretch, max(asked / FLOW, power / 4000.0), rtol=1e-12)
    assert_allclose(cycle.litres["first_line"], 1e3 * AREA * 0.3, rtol=1e-12)
    text = str(cycle.verdict)
    assert text.startswith("FAIL pump: needs 75.4 l/min at 0.3 s of 30 l/min; 7.355 kW at 0.3 s of 4 kW; it can be done in 8.042 s"), text
    told = {verdict.rule: str(verdict) for verdict in machine.verdicts()}
    assert told["pump"] == text and not [rule for rule in told if rule.startswith("lowering")]
    slower = Over.path(S=ramp(0.0, 0.3, speed=0.05, acceleration=0.5), T=ramp(0.0, 0.3, speed=0.04, acceleration=0.5))
    assert pump_of(machine).check(machine.sweep(11, over=slower)).verdict.ok
    weak = Timed(**{"supply.pressure": 50 * bar})
    assert "58.53 bar at" in pump_of(weak).check(weak.sweep(11, over="cycle")).verdict


@pytest.mark.parametrize("force", [-40e3, 40e3])
def test_losses_of_the_pump_count_on_the_load_and_not_on_a_tanks_push(force):
    class Upright(Mechanism):
        S = Stroke(0.0, 0.5)
        O = Ground(0, 0)
        way = Guide(O, angle=np.pi / 2)
        P = OnGuide(way, at=0.8 + S)
        ram = Cylinder(O, P, bore=80e-3, rod=45e-3)
        load = Force(P, (0.0, force))
        supply = Pump(200 * bar, flow=FLOW, mechanical_efficiency=0.85)
        line = OilLine(ram.piston_side if force < 0.0 else ram.rod_side, supply)
        back = OilLine(ram.rod_side if force < 0.0 else ram.piston_side, Tank(20 * bar))

    machine, (fills, empties) = Upright(), (AREA, ANNULUS) if force < 0.0 else (ANNULUS, AREA)
    needed = (40e3 / 0.85 + 20 * bar * empties) / fills
    cycle = Upright.supply.run(machine, demands={"ram": np.copysign(0.05, -force)}, start={"S": 0.25}, until=1.0).cycle
    assert cycle.pressure["line"][0] == pytest.approx(needed, rel=1e-9)
    assert machine.evaluate([pressure("ram")], S=0.25)[0] == pytest.approx(needed, rel=1e-9)
    assert cycle.energy.pump == pytest.approx(needed * fills * 0.05, rel=1e-9)


def test_a_run_is_a_motion_in_time_that_goes_on_and_is_checked():
    machine = TwoLifts()
    supply, asked = pump_of(machine), {"one.ram": 0.1, "two.ram": Course([0.0, 1.0, 2.0], [0.0, 0.1, -0.1], "straight")}
    whole = supply.run(machine, demands=asked, until=2.0)
    half = supply.run(machine, demands=asked, until=0.7)
    rest = supply.run(machine, demands=asked, until=2.0, start=half)
    assert_allclose([rest.strokes[name][-1] for name in "ST"], [whole.strokes[name][-1] for name in "ST"], atol=1e-13)
    assert_allclose(half.cycle.energy.pump + rest.cycle.energy.pump, whole.cycle.energy.pump, rtol=1e-11)
    again = supply.check(whole)
    assert_allclose([again.energy.useful, again.energy.braked], [whole.cycle.energy.useful, whole.cycle.energy.braked], rtol=1e-9)
    kept = pickle.loads(pickle.dumps(whole))
    assert kept.cycle.energy == whole.cycle.energy and [*map(str, kept.events)] == [*map(str, whole.events)]
    assert [event.time for event in whole.events] == sorted(event.time for event in whole.events)


def test_a_demand_may_change_its_sense_at_any_instant():
    machine = TwoLifts()
    for middle in (1.0, 1.1, 0.7 + 0.0123):  # 1.0 s is one of the instants that are looked at first
        demand = Course([0.0, 2.0 * middle], [0.1, -0.1], "straight")
        run = pump_of(machine).run(machine, demands={"one.ram": demand, "two.ram": 0.01}, until=2.0 * middle)
        assert [event.time for event in run.events if event.kind == "demand"] == [pytest.approx(middle, abs=1e-9)]


@pytest.mark.filterwarnings("error")
def test_a_ram_without_oil_on_its_rod_goes_back_as_far_as_its_load_drives_it():
    class Plunger(Mechanism):
        S = Stroke(0.0, 0.4)
        supply = Pump(250 * bar, flow=FLOW)
        one = Part(Block, S=S, ram=None)
        ram = Cylinder("one.O", "one.B", bore=0.08, rod=0.045, works="piston")
        line = OilLine("ram.piston_side", supply, Relief(200 * bar))

    there_and_back = Course.of_phases([0.0, 1.0, 2.0], [[0.1, -0.1]])
    for speed in (0.1, 0.3, 0.7):  # its spring is free where it comes to its end
        machine = Plunger()
        run = pump_of(machine).run(machine, demands={"ram": Course.of_phases([0.0, 1.0, 2.0], [[speed, -speed]])}, until=2.0)
        stop = next(event for event in run.events if event.kind == "stop")
        assert_allclose([stop.time, run.strokes["S"][-1]], [1.0 + FLOW / AREA / speed, 0.0], atol=1e-9)
        assert_allclose(run.cycle.energy.useful, run.cycle.energy.braked, rtol=1e-9)
    pulled = Plunger(**{"one.spring.free_length": 1.45})  # free at 50 mm
    with pytest.raises(DefinitionError, match=r"retracting at 1\.49\d* s: its load resists"):
        pump_of(pulled).run(pulled, demands={"ram": there_and_back}, until=2.0)


def test_a_stop_is_found_as_well_in_a_run_that_goes_on_for_days():
    machine = TwoLifts()
    run = pump_of(machine).run(machine, demands={"one.ram": 0.1}, until=1e6)
    assert_allclose(run.events[-1].time, 0.4 * AREA / FLOW, atol=1e-9)
    assert_allclose(run.strokes["S"][-1], 0.4, atol=1e-10)


def test_friction_of_a_guide_is_what_the_cylinder_feels_by_hand():
    class Rubbing(Mechanism):
        S = Stroke(0.0, 0.4)
        supply = Pump(250 * bar, flow=FLOW, power=2000.0)
        one = Part(Lift, S=S, ram=None)
        foot = Ground(0.3, 0.0)
        ram = Cylinder("foot", "one.B", bore=0.08, rod=0.045)
        friction = GuideFriction("one.B", coefficient=0.2)
        line = LiftCircuit("ram", supply, relief=200 * bar)

    machine = Rubbing()
    run = pump_of(machine).run(machine, demands={"ram": 0.1}, until=0.5)
    S = np.array([float(run.over.strokes["S"](time)) for time in run.cycle.time])
    length = np.hypot(0.5 + S, 0.3)
    need = 3000 * 9.80665 / ((0.5 + S - 0.2 * 0.3) / length) / AREA  # it is pressed to its guide by F 0.3 / length
    assert_allclose(run.cycle.pressure["line"], need, rtol=1e-12)
    assert_allclose(run.cycle.power["supply"], np.minimum(2000.0, need * AREA * 0.1), rtol=1e-10)


def test_dampers_that_decide_by_the_speed_who_moves_are_refused_in_words():
    class Stiff(TwoLifts):
        supply = Pump(100 * bar, flow=FLOW)  # it cannot give what the damper asks for at the whole speed
        damper = Damper("one.O", "one.B", coefficient=6e5)

    class Least(TwoLifts):
        supply = Pump(250 * bar, flow=0.7 * FLOW, sharing="least pressure first")
        one_damper, two_damper = Damper("one.O", "one.B", coefficient=5e4), Damper("two.O", "two.B", coefficient=2e5)

    for machine in (Stiff(), Least()):
        with pytest.raises(DefinitionError, match=r"at 0 s dampers or friction decide.*ask for less"):
            pump_of(machine).run(machine, demands={"one.ram": 0.12, "two.ram": 0.12}, until=1.0)


def test_a_shared_pump_is_written_into_a_file_and_read():
    class Saved(TwoLifts):
        supply = Pump(250 * bar, flow=FLOW, margin=15 * bar, power=5e3, sharing="least pressure first", first="one.ram")

    read = from_dict(to_dict(Saved()))
    for name in ("supply", "first_line"):
        assert str(read.plan.members[name]) == str(Saved().plan.members[name])
    assert read.plan.members["first_line"].pump(read.plan.members) is read.plan.members["supply"]


def test_what_cannot_be_is_refused_in_words():
    machine = TwoLifts()
    supply = pump_of(machine)

    class Bare(TwoLifts):
        supply = Pump(250 * bar, flow=FLOW)
        first_line, second_line = LiftCircuit("one.ram", supply), LiftCircuit("two.ram", supply, back_pressure=1 * bar)

    class Alone(TwoBlocks):
        more = Pump(200 * bar, flow=FLOW)

    least = type("Least", (TwoLifts,), {"supply": Pump(250 * bar, flow=FLOW, sharing="least pressure first")})()
    bare = Bare()
    other = pump_of(OneBlock()).run(OneBlock(), demands={"one.ram": 0.1}, until=0.5)
    for ask, words in [
        (lambda: supply.run(machine, demands={"one.rm": 0.1}, until=1.0), "Cylinder 'one.rm' is unknown"),
        (lambda: supply.run(machine, demands={}, until=1.0), "nothing is asked for"),
        (lambda: supply.run(machine, demands={"one.ram": np.nan}, until=1.0), "a speed in m/s is expected"),
        (lambda: supply.run(machine, demands={"one.ram": "fast"}, until=1.0), "a speed in m/s is expected"),
        (lambda: supply.run(machine, demands={"one.ram": -np.inf}, start={"S": 0.3}, until=1.0), "its load drives it"),
        (lambda: pump_of(least).run(least, demands={"one.ram": np.inf}, until=1.0), "open centre"),
        (lambda: supply.run(machine, demands={"one.ram": 0.1}, until=0.0), "until"),
        (lambda: supply.run(machine, demands={"one.ram": 0.1}, start={"Q": 0.1}, until=1.0), "Stroke 'Q' is unknown"),
        (lambda: supply.run(machine, demands={"one.ram": 0.1}, start={"S": 0.5}, until=1.0), "0 to 0.4"),
        (lambda: pump_of(bare).run(bare, demands={"one.ram": 0.1}, until=9.0), "no relief valve is on the lines of supply"),
        (lambda: supply.check(machine.sweep(S=11, T=0.1)), "has no time of its own"),
        (lambda: supply.run(machine, demands={"one.ram": 0.1, machine.plan.members["one.ram"]: 0.2}, until=1.0), "asked for twice"),
        (lambda: supply.run(machine, demands={"one.ram": 0.1}, until=1.0, acting="plain"), "a situation is expected"),
        (lambda: supply.run(machine, demands={"one.ram": 0.1}, until=1.0, acting=Acting(case=["plain"])), "is unknown in TwoLifts"),
        (lambda: supply.run(machine, demands={"one.ram": 0.1}, until=9.0, start=other), "this one has no stroke T"),
        (lambda: Pump(200 * bar, flow=FLOW, first=3), "names of lines or cylinders are expected"),
        (lambda: type("Wrong", (TwoLifts,), {"supply": Pump(2e7, flow=FLOW, first=[3])}), "3 stands where"),
        (lambda: Alone().plan.members["more"].run(Alone(), demands={"one.ram": 0.1}, until=1.0), "no line is on more"),
        (lambda: Pump(200 * bar, flow=FLOW, power=0.0), "Power of the pump"),
        (lambda: Pump(200 * bar, sharing="first come"), "first come"),
        (lambda: type("Wrong", (TwoLifts,), {"supply": Pump(2e7, flow=FLOW, first=["boom"])})(), "'boom' is unknown"),
        (lambda: type("Wrong", (TwoLifts,), {"first_line": LiftCircuit("one.ram", "supply", flow=1e-3)})(), "supply says its flow"),
    ]:  # fmt: skip
        with pytest.raises(DefinitionError, match=re.escape(words)):
            ask()
    none = TwoLifts(**{"supply.flow": 0.0})
    with pytest.raises(DefinitionError, match="Flow of supply"):
        pump_of(none).run(none, demands={"one.ram": 0.1}, until=1.0)
