"""The lift circuit: capacity, pressure, oil, time, holding, lowering; friction as an efficiency."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Cylinder, LiftCircuit, Telescope, lift_verdicts
from linkage import RIGHT, Actuator, Crank, DefinitionError, Dyad, Ground, Mechanism, OnLink, Stroke
from linkage.loads import PinFriction, Weight
from linkage.statics import driving_force
from linkage.units import bar, cm2, deg, g0, kN, litre, minute, mm
from tests.for_all import first_daily
from tests.members import told_by


class Lift(Mechanism):
    """An arm with a load at G, lifted by two cylinders."""

    S = Stroke(0.00, 0.25)
    A = Ground(0.20, 0.55)
    O = Ground(0.30, 1.15)
    B = Dyad(A, O, AB=0.50 + S, OB=0.30, side=RIGHT)
    G = OnLink(O, B, OG=0.9, BOG=-40 * deg)
    arm = Weight(B, mass=40)
    load = Weight(G, mass=3000)
    lift = Cylinder(A, B, bore=110 * mm, rod=63 * mm, count=2)
    circuit = LiftCircuit(lift, pressure=180 * bar, flow=60 * litre / minute, mechanical_efficiency=0.9, hydraulic_efficiency=0.95)


class Hoist(Lift):
    """The same arm, the load on the other side: the cylinder's rod side holds it."""

    G = OnLink("O", "B", OG=0.9, BOG=140 * deg)
    lift = Cylinder("A", "B", bore=110 * mm, rod=63 * mm, works="rod")


circuit, LIFT = Lift.circuit, Lift()


def pushing(thrust):
    """Return the load under which the cylinder carries a thrust [N]: another one between its pins, the other way."""
    return [Actuator("A", "B", force=-np.asarray(thrust, float))]


def test_the_capacity_takes_all_of_the_pump():
    motion = LIFT.sweep(11)
    capacity = circuit.capacity(motion, "G", ["arm"])
    for index in range(11):
        pose = LIFT.replaced(**{"load.mass": capacity[index] / g0}).at(S=motion.strokes["S"][index])
        assert_allclose(circuit.pressure_for(pose), 180 * bar, rtol=1e-9)
        assert_allclose(circuit.reserve(pose), 1.0, rtol=1e-9)


def test_the_capacity_counts_the_loads_declared_unless_others_are_given():
    motion = LIFT.sweep(5)
    spare = circuit.capacity(motion, "G", [])
    assert_allclose(circuit.capacity(motion, "G"), spare - 3000 * g0 - driving_force(motion, ["arm"]) / motion.ratio("G")[1], rtol=1e-12)


def test_capacity_with_declared_friction_is_what_the_pump_just_moves():
    class Rubbing(Lift):
        pins = PinFriction("O", radius=40 * mm, coefficient=0.2)
        end = PinFriction("B", radius=30 * mm, coefficient=0.15)

    motion = Rubbing().sweep(5)
    capacity = circuit.capacity(motion, "G", ["arm", "pins", "end"])
    assert (capacity < 0.99 * circuit.capacity(motion, "G", ["arm"])).all()
    for S, mass in zip(motion.strokes["S"], capacity / g0, strict=True):
        pose = Rubbing(**{"load.mass": mass}).at(S=S)
        up = driving_force(pose, direction="extending")
        assert_allclose(up, 180 * bar * Lift.lift.size.area * 0.95 * 0.9, rtol=1e-9)
        assert_allclose(circuit.pressure_for(pose), 180 * bar, rtol=1e-9)


def test_capacity_is_the_papers_formula():
    motion = LIFT.sweep(11)
    area = Lift.lift.size.area
    assert_allclose(circuit.capacity(motion, "G", []), 180 * bar * area * 0.9 * 0.95 / motion.ratio("G")[1])
    assert_allclose(circuit.capacity(motion, "G", [], share=0.9), 0.9 * circuit.capacity(motion, "G", []))


def test_where_the_load_drives_it_is_not_limited():
    motion = LIFT.sweep(11)
    assert np.isnan(circuit.lifted(motion, "G", along=(0.0, -1.0))).all()
    with pytest.raises(DefinitionError, match=r"drives lift at every pose.*write along=\(0, 1\) for the other way"):
        circuit.capacity(motion, "G", along=(0.0, -1.0))
    drives = pushing(-driving_force(motion))
    assert np.isnan(circuit.reserve(motion, drives)).all()
    assert_allclose(circuit.pressure_for(motion, drives), 0.0)


def test_a_machine_too_heavy_for_itself_lifts_nothing():
    motion = LIFT.sweep(5)
    assert_allclose(circuit.capacity(motion, "G", pushing(1e7)), 0.0)


def test_efficiencies_act_with_and_against_the_load():
    motion = LIFT.sweep(3)
    area = Lift.lift.size.area
    assert_allclose(circuit.rod_force(motion, pushing([10.0, -10.0, 0.0])), [10 / 0.9, -9.0, 0.0])
    assert_allclose(circuit.pressure_for(motion, pushing(10 * kN)), 10 * kN / 0.9 / 0.95 / area)
    assert_allclose(circuit.largest(motion), 180 * bar * area * 0.95)


def test_going_back_the_load_makes_the_pressure_without_the_pump():
    motion, area = LIFT.sweep(3), Lift.lift.size.area
    assert_allclose(circuit.pressure_for(motion, pushing(10 * kN), direction="retracting"), 10 * kN * 0.9 / area)
    assert_allclose(Lift.lift.pressure(motion, pushing(10 * kN)), 10 * kN / 0.9 / 0.95 / area)


def test_the_rod_side_pulls():
    motion, hoist = Hoist().sweep(11), Hoist.circuit
    thrust = Hoist.lift.thrust(motion, ["load"])
    assert np.all(thrust < 0.0)
    area = np.pi / 4 * (0.110**2 - 0.063**2)
    assert_allclose(hoist.pressure_for(motion, ["load"]), -thrust / 0.9 / 0.95 / area)
    assert_allclose(hoist.capacity(motion, "G", []) * hoist.pressure_for(motion, ["load"]), 3000 * g0 * 180 * bar, rtol=1e-9)
    assert_allclose(hoist.oil(motion), area * 0.25)


def test_oil_and_time():
    motion = LIFT.sweep(11)
    assert_allclose(circuit.oil(motion), 2 * np.pi / 4 * 0.110**2 * 0.25)
    assert_allclose(circuit.time(motion), circuit.oil(motion) / (1e-3))
    batch = Lift(**{"lift.bore": np.array([0.10, 0.11]), "circuit.flow": np.array([1e-3, 2e-3])}).sweep(5)
    assert_allclose(circuit.time(batch), [2 * np.pi / 4 * 0.10**2 * 250, 2 * np.pi / 4 * 0.11**2 * 125])
    with pytest.raises(DefinitionError, match="Flow of the pump"):
        LiftCircuit(Lift.lift, pressure=180 * bar).time(motion)


def test_back_pressure_is_paid_for():
    motion = LIFT.sweep(3)
    free, held = (LiftCircuit("lift", pressure=180 * bar, back_pressure=back * bar) for back in (0, 10))
    size, load = Lift.lift.size, pushing(50 * kN)
    assert_allclose(held.pressure_for(motion, load) - free.pressure_for(motion, load), 10 * bar * size.back_area / size.area)
    assert_allclose(free.largest(motion) - held.largest(motion), 10 * bar * size.back_area)
    with pytest.raises(DefinitionError, match="eats up the pump's"):
        LiftCircuit("lift", pressure=10 * bar, back_pressure=100 * bar).largest(motion)


def test_holding_uses_the_side_the_load_presses_on():
    motion, size = LIFT.sweep(2), Lift.lift.size
    held = circuit.holding(motion, pushing([30 * kN, -30 * kN]))
    assert_allclose(held.working, [30 * kN / size.area, 0.0])
    assert_allclose(held.other, [0.0, 30 * kN / size.back_area])


def test_nothing_is_held_where_no_pose_is_reached():
    """Neither side has a pressure there, the side that holds nothing included."""
    held = circuit.holding(LIFT.at(S=np.array([0.1, 5.0]), unreachable="nan"))
    assert held.working[0] > 0.0 == held.other[0]
    assert np.isnan(held.working[1]) and np.isnan(held.other[1])


def test_it_sinks_by_itself_where_the_load_beats_friction_and_the_return_line():
    motion, size = LIFT.sweep(3), Lift.lift.size
    limit = 5 * bar * size.area / 0.9
    sinks = circuit.lowering(motion, pushing([1.001 * limit, 0.999 * limit, -10 * kN]), resistance=5 * bar)
    assert sinks.by_itself.tolist() == [True, False, False]
    assert sinks.push[0] == 0.0
    assert_allclose(sinks.push[2] * size.back_area, 10 * kN / 0.9 + 5 * bar * size.area)
    assert_allclose(sinks.working[0], 5 * bar * 1.001)


@first_daily(2, "count", [2, 500, 5, 50])
def test_verdicts_with_their_remedy(count):
    strong, weak = Lift(), Lift(**{"load.mass": 40e3})
    good = {verdict.rule: verdict for verdict in lift_verdicts(circuit, strong.sweep(count), ["load"], resistance=0.1 * bar)}
    assert all(good.values())
    assert "4.8 s at 60 l/min" in good["oil"].sentence
    bad = {verdict.rule: verdict for verdict in lift_verdicts(circuit, weak.sweep(count), ["load"], resistance=60 * bar)}
    assert not bad["lifting"] and not bad["lowering"] and not bad["holding"]
    motion, size = weak.sweep(5001), Lift.lift.size
    needed = driving_force(motion, ["load"]).max() / size.area / 0.9 / 0.95 / bar
    gained = 180 / needed * (250 / 110) ** 2
    assert f"It needs {needed:.4g} bar, or a bore of 250 mm, with a reserve of {gained:.2f}" in bad["lifting"].sentence
    start = float(bad["lifting"].sentence.split("from S = ")[1].split()[0])
    assert_allclose(driving_force(weak.at(S=start * mm), ["load"]) / 0.9, 180 * bar * size.area * 0.95, rtol=2e-3)
    stuck = float(bad["lowering"].sentence.split("to ")[1].split()[0])
    assert_allclose(driving_force(weak.at(S=stuck * mm), ["load"]) * 0.9, 60 * bar * size.area, rtol=2e-3)


def test_a_load_that_drives_is_said_so():
    said = lift_verdicts(circuit, LIFT.sweep(5), [Weight("G", mass=3000, gravity=(0.0, g0))])
    assert "not limited by this cylinder" in said[0].sentence and 'works="both"' in said[0].sentence
    with pytest.raises(DefinitionError, match="one design"):
        lift_verdicts(circuit, Lift(OB=np.array([0.30, 0.31])).sweep(5))


@pytest.mark.parametrize(
    ("machine", "word"), [(Lift(**{"load.mass": 0.0, "arm.mass": 0.0}), "is a mass zero"), (LIFT, "no load is declared")]
)  # fmt: skip
def test_a_lift_without_a_load_is_not_called_good(machine, word):
    said = lift_verdicts(circuit, machine.sweep(5), [] if machine is LIFT else None)
    assert not said[0] and "nothing to lift" in said[0].sentence and word in said[0].sentence


def test_holding_is_judged_against_the_relief_valve_and_lifting_against_the_pump():
    weak = Lift(**{"load.mass": 8000.0})
    most = float(weak.plan.members["lift"].thrust(weak.sweep(2001)).max()) / Lift.lift.size.area
    low, high = (LiftCircuit("lift", pressure=0.8 * most, relief=share * most) for share in (0.9, 1.1))
    for each, holds in ((low, False), (high, True)):
        said = {verdict.rule: verdict for verdict in lift_verdicts(each, weak.sweep(5))}
        assert not said["lifting"] and bool(said["holding"]) is holds and "relief valve" in said["holding"].sentence
    alone = {verdict.rule: verdict for verdict in lift_verdicts(LiftCircuit("lift", pressure=1.1 * most), weak.sweep(5))}
    assert alone["holding"] and "no relief valve is on this line" in alone["holding"].sentence


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"pressure": -1.0}, "pressure"), ({"pressure": 0.0}, "pressure"), ({"mechanical_efficiency": 1.1}, "lies between 0 and 1"),
        ({"mechanical_efficiency": 0.0}, "lies between 0 and 1"), ({"hydraulic_efficiency": -0.5}, "lies between 0 and 1"),
    ],
    ids=str,
)  # fmt: skip
def test_bad_numbers_are_refused_in_words(given, words):
    with pytest.raises(DefinitionError, match=words):
        circuit.reserve(Lift(**{f"circuit.{name}": value for name, value in given.items()}).sweep(3), pushing(10 * kN))
    with pytest.raises(DefinitionError, match=f"(?i){words}"):
        LiftCircuit("lift", **({"pressure": 1e7} | given))


@pytest.mark.parametrize("given", [{"flow": -1.0}, {"back_pressure": -1.0}, {"pressure": float("nan")}], ids=str)
def test_numbers_that_cannot_be_are_refused_at_once(given):
    with pytest.raises(DefinitionError):
        LiftCircuit("lift", **({"pressure": 1e7} | given))


def test_a_circuit_needs_a_cylinder():
    with pytest.raises(DefinitionError, match="is no Cylinder"):
        type("Wrong", (Lift,), {"circuit": LiftCircuit("load", pressure=1e7)})
    with pytest.raises(DefinitionError, match="share"):
        circuit.capacity(LIFT.sweep(3), "G", share=1.5)
    with pytest.raises(DefinitionError, match="no length"):
        circuit.capacity(LIFT.sweep(3), "G", along=(0.0, 0.0))


def test_a_replaced_cylinder_is_the_one_that_counts():
    wide = type("Wide", (Lift,), {"lift": Cylinder("A", "B", bore=220 * mm, rod=63 * mm, count=2)})
    assert_allclose(circuit.largest(wide().sweep(3)), 4.0 * circuit.largest(LIFT.sweep(3)))
    assert Lift.lift.size.area > 100 * cm2


class Upright(Mechanism):
    """An arm whose load stands above its pivot where the range begins: nothing to hold there but a rounded cosine, 6e-17 the wrong way."""

    phi = Stroke(90 * deg, 160 * deg)
    O, A = Ground(0, 0), Ground(-1.0, -0.3)
    B = Crank(O, OB=0.5, angle=phi)
    G = OnLink(O, B, OG=1.5)
    load = Weight(G, mass=400)
    lift = Cylinder(A, B, bore=0.08, rod=0.045)
    line = LiftCircuit(lift, pressure=200 * bar, flow=40 * litre / minute)


@pytest.mark.slow
def test_a_load_that_is_nothing_but_rounding_is_told_as_nothing():
    """Whichever side works, alone, on a line or as a telescope: nothing is pushed, held or stuck where the load passes its zero."""
    both, pulling = (Cylinder("A", "B", bore=0.08, rod=0.045, works=works) for works in ("both", "rod"))
    stages = Telescope("A", "B", bores=[0.1, 0.08], strokes=[0.4, 0.4], closed=0.6)
    for A, lift in [((-1.0, -0.3), both), ((-1.0, -0.3), stages), ((1.0, -0.3), pulling)]:
        found = {each.rule: each for each in told_by(type("Own", (Upright,), {"A": Ground(*A), "lift": lift})())}
        assert not any("e-" in each.sentence for each in found.values()), found
        assert found["lowering"].ok and "presses on neither side" in found["lowering"].sentence
        assert ("never pushed" in found["buckling"].sentence) == (A[0] > 0.0) and " holds up to" in found["holding"].sentence
        assert " where the load drives" not in found["holding"].sentence
    assert "side" not in {each.rule for each in told_by(type("Bare", (Upright,), {"line": None})())}
