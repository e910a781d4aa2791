"""Telescopes: laws over their stages, a hoist by hand, one stage against a cylinder, and every door that a cylinder goes through."""


import pickle

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from hydraulics import (
    Accumulator,
    AccumulatorBlock,
    Cylinder,
    FloatCircuit,
    LiftCircuit,
    OilLine,
    Pump,
    Telescope,
    buckling,
    capacity,
    fits,
    pressure,
    reserve,
    thrust,
)  # fmt: skip
from linkage import (
    RIGHT,
    DefinitionError,
    Dimension,
    Dyad,
    Force,
    Ground,
    Guide,
    Link,
    Mechanism,
    OnGuide,
    OnLink,
    Part,
    Stroke,
    Weight,
    equations,
    least,
    most,
    pin_forces,
)  # fmt: skip
from linkage.files import load, to_toml
from linkage.units import bar, deg, kN, litre, minute, mm
from tests.for_all import first_daily
from tests.hydraulics.test_oil import Levelled
from tests.members import told_by

BORES, STROKES, CLOSED = [149 * mm, 129 * mm, 110 * mm, 91 * mm], [1.0, 1.1, 0.9, 1.05], 1.48
ENDS = CLOSED + np.cumsum(STROKES)


class Hoist(Mechanism):
    """A telescope of four stages that pushes straight up."""

    S = Stroke(0.0, 4.0)
    W = Dimension(40e3, unit="N")
    O = Ground(0.0, 0.0)
    rail = Guide(O, angle=90 * deg)
    P = OnGuide(rail, at=1.5 + S)
    hoist = Telescope(O, P, bores=BORES, strokes=STROKES, closed=CLOSED)
    load = Force(P, (0.0, -40 * kN))
    line = LiftCircuit(hoist, pressure=160 * bar, flow=70 * litre / minute, mechanical_efficiency=0.9, hydraulic_efficiency=0.95)


def random_bores(seed):
    rng = np.random.default_rng(seed)
    stages = int(rng.integers(2, 6))
    return list(0.2 * np.cumprod(rng.uniform(0.75, 0.93, stages))), list(rng.uniform(0.4, 0.9, stages))


def tilting(bores, strokes, count=1, cylinder=None, **line):
    """Return a body on a hinge that a telescope, or a cylinder, lifts at its front; its length is 1.2 m and the stroke."""
    way, reach = sum(strokes), max(sum(strokes), 2.0)

    class Tilting(Mechanism):
        S = Stroke(0.0, way - 0.04)
        O, A = Ground(0.0, 0.0), Ground(1.3 * reach, -0.3)
        B = Dyad(A, O, AB=1.2 + S, OB=1.35 * reach, side=RIGHT)
        G = OnLink(O, B, OG=0.6 * reach, BOG=8 * deg)
        body = Link(O, B, G)
        load = Weight(G, mass=4000.0)
        hoist = cylinder(A, B) if cylinder else Telescope(A, B, bores=bores, strokes=strokes, closed=1.18, count=count)
        lift = LiftCircuit(hoist, **({"pressure": 400 * bar, "flow": 60 * litre / minute} | line))

    return Tilting


SEEDS = first_daily(1, "seed", range(3))


@SEEDS
def test_pressure_jumps_by_the_ratio_of_areas_at_each_border_and_only_there(seed):
    bores, strokes = random_bores(seed)
    machine = tilting(bores, strokes)()
    borders = 1.18 + np.cumsum(strokes)[:-1] - 1.2
    for stage, border in enumerate(borders):
        before, after = machine.hoist.pressure(machine.at(S=[border - 1e-8, border + 1e-8]))
        assert after / before == pytest.approx((bores[stage] / bores[stage + 1]) ** 2, rel=1e-6)
    fine = np.linspace(0.0, sum(strokes) - 0.04, 4001)
    jumps = np.abs(np.diff(np.log(machine.hoist.pressure(machine.at(S=fine))))) > 2e-2
    assert jumps.sum() == len(borders)


@SEEDS
def test_oil_is_continuous_strictly_rising_and_the_integral_of_the_area(seed):
    bores, strokes = random_bores(seed)
    machine = tilting(bores, strokes, count=2)()
    S = np.linspace(0.0, sum(strokes) - 0.04, 20001)
    motion = machine.at(S=S)
    length = motion.distance("A", "B")
    oil = machine.hoist.taken(motion, length[0], length)
    area = machine.hoist.sized(motion).area
    assert np.all(np.diff(oil) > 0.0)
    assert np.all(np.diff(oil) <= 2 * np.pi / 4 * bores[0] ** 2 * np.diff(length) * (1 + 1e-9))
    assert oil[-1] == pytest.approx(np.trapezoid(area, length), rel=1e-4)
    assert machine.lift.oil(motion) == pytest.approx(oil[-1], rel=1e-12)
    assert machine.lift.time(motion) == pytest.approx(oil[-1] / (60 * litre / minute))


@SEEDS
def test_work_of_the_thrust_is_pressure_times_oil(seed):
    bores, strokes = random_bores(seed)
    machine = tilting(bores, strokes)()
    S = np.random.default_rng(seed).uniform(0.0, sum(strokes) - 0.05, 9)
    near = [machine.at(S=S + step) for step in (-1e-6, 1e-6)]
    motion = machine.at(S=S)
    lengths = [each.distance("A", "B") for each in near]
    grown = lengths[1] - lengths[0]
    filled = machine.hoist.taken(motion, *lengths)
    inside = machine.hoist.stage(near[0]) == machine.hoist.stage(near[1])
    T, p = machine.hoist.thrust(motion), machine.hoist.pressure(motion)
    assert_allclose((T * grown)[inside], (p * filled)[inside], rtol=1e-9)


@pytest.mark.parametrize("direction, stages", [(None, [2, 3, 4]), ("extending", [2, 3, 4]), ("retracting", [1, 2, 3])])
def test_at_a_border_the_direction_says_which_stage_moves(direction, stages):
    machine = Hoist()
    at_borders = machine.at(S=ENDS[:-1] - 1.5)
    assert_array_equal(machine.hoist.stage(at_borders, direction), stages)
    area = np.pi / 4 * np.array(BORES)[np.array(stages) - 1] ** 2
    free = 0.9 if direction == "retracting" else 1 / 0.9 / 0.95
    expected = 40 * kN / area * (1.0 if direction is None else free)
    found = machine.line.holding(at_borders).working if direction is None else machine.line.pressure_for(at_borders, direction=direction)
    assert_allclose(found, expected, rtol=1e-9)


def test_all_on_one_line_have_its_pressure_at_a_border_too():
    """Whichever way it moves: the telescope, the cylinder beside it, and the line."""

    class Beside(Hoist):
        helper = Cylinder("O", "P", bore=50 * mm, rod=36 * mm)
        line = LiftCircuit(["hoist", helper], pressure=160 * bar, mechanical_efficiency=0.9)

    machine = Beside()
    at_borders = machine.at(S=np.concatenate([ENDS[:-1] - 1.5 + way for way in (-1e-9, 0.0, 1e-9, 0.1)]))
    for direction in (None, "extending", "retracting"):
        one, other = (at_borders[pressure(each, direction=direction)] for each in ("hoist", "helper"))
        assert_allclose(one, other, rtol=1e-9)
        area = at_borders[thrust("hoist", direction=direction)] / at_borders[thrust("helper", direction=direction)] * np.pi / 4 * 0.05**2
        assert_allclose(machine.hoist.sized(at_borders, direction).area, area, rtol=1e-9)
    low = [str(each).split("makes")[1] for each in told_by(machine, "line") if each.rule.startswith("lowering")]
    assert len(low) == 2 and low[0] == low[1]


def test_a_four_stage_hoist_by_hand():
    motion = Hoist().at(S=[0.4, 1.5, 2.5, 3.5])
    areas = np.pi / 4 * np.square(BORES)
    assert_array_equal(Hoist.hoist.stage(motion), [1, 2, 3, 4])
    assert_allclose(Hoist.hoist.thrust(motion), 40 * kN)
    assert_allclose(Hoist.hoist.pressure(motion), 40 * kN / areas / 0.9 / 0.95)
    assert_allclose(Hoist.line.reserve(motion), 160 * bar * 0.95 * areas * 0.9 / (40 * kN))
    assert_allclose(Hoist.hoist.bounds(motion, lifting=True)[1], 160 * bar * 0.95 * 0.9 * areas)
    assert_allclose(Hoist.hoist.bounds(motion, lifting=False)[1], 160 * bar * areas)
    assert_array_equal(Hoist.hoist.bounds(motion, lifting=False)[0], np.zeros(4))
    assert_allclose(Hoist.line.capacity(motion, "P"), 160 * bar * 0.95 * 0.9 * areas - 40 * kN, rtol=1e-9)
    assert_allclose(Hoist.line.lowering(motion).working, 40 * kN * 0.9 / areas)
    taken = areas[0] * (ENDS[0] - 1.5) + areas[1] * 1.1 + areas[2] * 0.9 + areas[3] * (5.5 - ENDS[2])
    assert Hoist.line.oil(Hoist().sweep(7)) == pytest.approx(taken)
    assert Hoist.line.time(Hoist().sweep(7)) == pytest.approx(taken / (70 * litre / minute))


def test_verdicts_stand_at_the_borders_from_their_worse_side():
    said = {each.heading.split()[0]: str(each) for each in Hoist.line.verdicts(Hoist().judge())}
    need = 40 * kN / (np.pi / 4 * BORES[3] ** 2)
    assert f"{160 * bar * 0.95 * 0.9 / need:.3f}" in said["lifting"] and float(said["lifting"].split("S = ")[1][:6]) >= 2.98
    assert f"holds up to {need / bar:.4g} bar" in said["holding"]
    own = {each.heading: str(each) for each in Hoist.hoist.verdicts(Hoist().judge())}
    assert "stage 4 of 91 mm, the slenderest that is out, 5500 mm long" in own["buckling"]
    assert "in stages of 1000 + 1100 + 900 + 1050" in own["length"]
    answer = Hoist().judge().answer(most(pressure("hoist", direction="frictionless")))
    assert answer.value == pytest.approx(need, rel=1e-9)


@pytest.mark.parametrize("count", [1, 2])
def test_one_stage_is_a_cylinder_to_the_last_bit(count):
    made = tilting([110 * mm], [0.9], count)
    size = dict(bore=110 * mm, rod=70 * mm, count=count, closed=1.18, stroke=0.9)
    twin = tilting([110 * mm], [0.9], cylinder=lambda A, B: Cylinder(A, B, **size))
    a, b = made().sweep(17), twin().sweep(17)
    assert_array_equal(made.hoist.thrust(a), twin.hoist.thrust(b))
    assert_array_equal(made.hoist.bounds(a, True)[1], twin.hoist.bounds(b, True)[1])
    for name in ("pressure_for", "reserve", "oil", "time"):
        assert_array_equal(getattr(made.lift, name)(a), getattr(twin.lift, name)(b))
    assert_array_equal(made.lift.capacity(a, "G"), twin.lift.capacity(b, "G"))
    assert_array_equal(made.lift.holding(a).working, twin.lift.holding(b).working)
    assert_array_equal(made.lift.lowering(a).working, twin.lift.lowering(b).working)
    of_lines = [[str(each) for each in machine.lift.verdicts(machine().judge())] for machine in (made, twin)]
    assert of_lines[0] == of_lines[1]


class OnALine(Hoist):
    """The same on an oil line."""

    line = None
    supply = Pump(160 * bar, flow=70 * litre / minute, mechanical_efficiency=0.9, hydraulic_efficiency=0.95)
    oil = OilLine("hoist.piston_side", "supply")


def test_a_line_is_its_circuit_to_the_last_bit():
    a, b = Hoist().sweep(23), OnALine().sweep(23)
    assert_array_equal(Hoist.line.pressure_for(a), OnALine.oil.pressure(b))
    assert_array_equal(Hoist.line.reserve(a), OnALine.oil.reserve(b))
    verdicts = [[str(each).replace("oil", "line") for each in machine().verdicts()] for machine in (Hoist, OnALine)]
    assert [each for each in verdicts[0] if "line" not in each] == [each for each in verdicts[1] if "line" not in each]
    filled = OnALine.oil.oil(b)
    assert_allclose(filled, Hoist.hoist.taken(a, b.distance("O", "P")[0], b.distance("O", "P")), rtol=1e-12)


@SEEDS
def test_gradients_inside_stages_are_those_of_differences(seed):
    bores, strokes = random_bores(seed)
    made = tilting(bores, strokes)
    rng = np.random.default_rng(seed)
    names = ["hoist.bore_1", f"hoist.bore_{len(bores)}", "hoist.stroke_1", "load.mass", "A.y"]
    S = rng.uniform(0.0, sum(strokes) - 0.05, 3)
    motion = made().at(S=S)
    for request in (pressure("hoist"), reserve("hoist"), buckling("hoist"), thrust("hoist"), capacity("hoist", "G")):
        found = motion.gradient(request, names)
        for name, slope in zip(names, found, strict=True):
            step = 1e-5 * max(abs(float(made()[name])), 1e-2)
            ends = [made(**{name: float(made()[name]) + way * step}).at(S=S)[request] for way in (-1, 1)]
            assert_allclose(slope, (ends[1] - ends[0]) / (2 * step), rtol=1e-6, atol=1e-7 * float(np.max(np.abs(ends[0]))))


class Pulled(Hoist):
    """The load pulls at the telescope where it is far out."""

    load = Force("P", (0.0, 25 * kN))


class PulledAlone(Pulled):
    line = None


class OnItsOwn(Hoist):
    line = None


def test_no_oil_holds_a_load_that_pulls():
    for machine, owner in ((Pulled, Pulled.line), (PulledAlone, PulledAlone.hoist)):
        (said,) = [str(each) for each in owner.verdicts(machine().judge()) if each.heading.startswith("holding")]
        assert said.startswith("FAIL") and "pulls at it with up to 25 kN" in said and "no oil holds it" in said
    motion = Pulled().sweep(3)
    assert_array_equal(Pulled.hoist.pressure(motion), np.zeros(3))
    assert np.all(np.isinf(Pulled.line.holding(motion).other))
    assert not Pulled.line.lowering(motion).by_itself.any()
    (said,) = [str(each) for each in OnItsOwn.hoist.verdicts(OnItsOwn().judge()) if each.heading == "holding"]
    assert said.startswith("ok   holding: the load presses on it everywhere")


class Gassed(Hoist):
    line = None
    gas = FloatCircuit("hoist", AccumulatorBlock([Accumulator(volume=40 * litre, charge=30 * bar)]), charge_pressure=60 * bar, at=0.0)


def test_gas_on_a_telescope_draws_its_oil_and_pushes_with_the_stage_that_moves():
    motion = Gassed().at(S=[0.2, 1.4, 2.4])
    left = Hoist.hoist.taken(Hoist().sweep(2), np.asarray(1.5), motion.distance("O", "P"))
    assert_allclose(Gassed.gas.withdrawn(motion), left, rtol=1e-12)
    areas = np.pi / 4 * np.square(BORES[:3])
    assert_allclose(Gassed.hoist.thrust(motion), Gassed.gas.pressure(motion) * areas, rtol=1e-12)


def test_what_cannot_be_is_said_with_the_remedy():
    def made(**given):
        return Telescope("A", "B", **({"bores": [0.145, 0.125], "strokes": [1.0, 0.9], "closed": 1.3} | given))

    for given, words in [
        (dict(bores=[0.125, 0.145]), "the bore of stage 2, 145 mm, is not smaller than that of stage 1, 125 mm"),
        (dict(bores=[0.125, 0.125]), "let bores= fall from the outermost"),
        (dict(bores=[0.145]), "1 bores and 2 strokes"),
        (dict(bores=0.145), "a list is expected"),
        (dict(bores=[145.0, 125.0]), "Bore of stage 1 = 145 m is more than any cylinder has"),
        (dict(strokes=[1.0, 0.0]), "Stroke of stage 2 = 0 is not above zero"),
        (dict(strokes=[1.0, np.nan]), "stroke_2"),
        (dict(closed=1300.0), "Closed length of the telescope"),
        (dict(count=0), "Count of telescopes"),
        (dict(mounting="loose"), "Mounting"),
    ]:
        with pytest.raises(DefinitionError, match=words):
            made(**given)
    with pytest.raises(DefinitionError, match="is not smaller than that of stage 1"):
        Hoist(**{"hoist.bore_2": 0.16}).hoist.pressure(Hoist(**{"hoist.bore_2": 0.16}).sweep(3))


class Sliding(Mechanism):
    """A body that a telescope lifts, on which the load slides: two strokes."""

    S, slide = Stroke(0.0, 4.0), Stroke(0.0, 1.5)
    O, A = Ground(0.0, 0.0), Ground(5.6, -0.35)
    B = Dyad(A, O, AB=1.5 + S, OB=5.82, side=RIGHT)
    G = OnLink(O, B, OG=2.2 + slide)
    body = Link(O, B)
    load = Weight(G, mass=15e3)
    hoist = Telescope(A, B, bores=BORES, strokes=STROKES, closed=CLOSED)
    line = LiftCircuit(hoist, pressure=160 * bar, mechanical_efficiency=0.9)


@pytest.mark.slow
def test_over_several_strokes_both_sides_of_each_border_are_looked_at():
    judge, borders = Sliding().judge(), ENDS[:-1] - 1.5
    S = np.sort(np.concatenate([np.linspace(0.0, 4.0, 101), borders]))
    motion = Sliding().at(S=S[:, None], slide=np.linspace(0.0, 1.5, 31)[None, :])
    extending, retracting = (Sliding.line.pressure_for(motion, direction=way) for way in ("extending", "retracting"))
    asked = {way: pressure("hoist", direction=way) for way in ("extending", "retracting")}
    highest, lowest, spare, use = judge.answers([
        most(asked["extending"]), least(asked["retracting"]), least(reserve("hoist")) >= 1.0, most(buckling("hoist")),
    ])  # fmt: skip
    assert highest.value == pytest.approx(extending.max(), rel=1e-7)
    assert highest.strokes["S"] == pytest.approx(borders[-1], abs=1e-6)
    assert lowest.value == pytest.approx(retracting.min(), rel=1e-7)
    assert spare.ok and spare.value == pytest.approx(Sliding.line.reserve(motion, direction="extending").min(), rel=1e-7)
    assert use.value == pytest.approx(motion[buckling("hoist")].max(), rel=1e-6)


class Following(Hoist):
    """Bores and a stroke that follow dimensions, two telescopes side by side."""

    D = Dimension(149 * mm, unit="mm")
    out = Dimension(1.0, unit="m")
    hoist = Telescope("O", "P", bores=[D, D - 20 * mm, "inner", 91 * mm], strokes=["out", 1.1, 0.9, 1.05], closed=CLOSED, count=2)
    inner = Dimension(110 * mm, unit="mm")


class Whole(Mechanism):
    """The hoist in a machine, and mirrored."""

    right, left = Part(Following, O=(1.0, 0.0)), Part(Following, O=(-1.0, 0.0), mirrored=True, S="S", D="wide")
    S, wide = Stroke(0.0, 4.0), Dimension(160 * mm, unit="mm")


def test_files_pickles_dimensions_parts_and_equations():
    design = Following(D=152 * mm, out=0.95, inner=108 * mm, **{"hoist.bore_4": 90 * mm, "hoist.stroke_2": 1.15})
    expected = design.hoist.pressure(design.sweep(9))
    areas = 2 * np.pi / 4 * np.square([152 * mm, 132 * mm, 108 * mm, 90 * mm])
    stages = Following.hoist.stage(design.sweep(9)).astype(int)
    assert_allclose(Following.line.holding(design.sweep(9)).working, 40 * kN / areas[stages - 1])
    text = to_toml(design)
    assert "Telescope" in text and '"inner", "90 mm"]' in text
    for other in (load(text)(), pickle.loads(pickle.dumps(design))):
        assert_array_equal(other.plan.members["hoist"].pressure(other.sweep(9)), expected)
        assert other.plan.members["hoist"].name == "hoist"
    changes = {"D": 152 * mm, "out": 0.95, "inner": 108 * mm, "hoist.bore_4": 90 * mm, "hoist.stroke_2": 1.15}
    whole = Whole(**{f"right.{name}": value for name, value in changes.items()})
    motion = whole.at(**{"S": 0.5, "right.S": np.linspace(0.0, 4.0, 9)})
    assert_allclose(whole.plan.members["right.hoist"].pressure(motion), expected, rtol=1e-12)
    assert_allclose(whole.plan.members["left.line"].holding(motion).working, 40 * kN / (2 * np.pi / 4 * 0.16**2))
    written = str(equations(Following, forces=True))
    for line in ("A_hoist_4", "A_hoist", "p_hoist"):
        assert line in written


def test_fits_is_a_condition_of_each_stage():
    inside, short = Hoist(), Hoist(**{"hoist.stroke_3": 0.8})
    assert inside.judge().answer(fits("hoist")).ok and not short.judge().answer(fits("hoist")).ok
    assert "70.0 mm are missing open" in str(Hoist.hoist.verdicts(short.judge())[0])
    assert not Hoist(**{"hoist.stroke_3": 1.5}).judge().answer(fits("hoist")).ok


class TelescopicMaster(Levelled):
    master = Telescope("M", "N", bores=[100 * mm, 80 * mm], strokes=[0.15, 0.25], closed=0.14)


class TelescopicSlave(Levelled):
    slave = Telescope("U", "W", bores=[110 * mm, 90 * mm], strokes=[0.18, 0.2], closed=0.40, count=2)


@pytest.mark.parametrize("machine, name", [(TelescopicMaster, "master"), (TelescopicSlave, "slave")])
def test_a_closed_line_keeps_the_oil_of_a_telescope_through_its_stages(machine, name):
    motion, level, ram = machine().sweep(9), machine.plan.members["level"], machine.plan.members[name]
    assert set(ram.stage(motion)) == {1.0, 2.0}
    assert np.abs(level.oil(motion)).max() < 1e-12 * 0.4 * np.pi / 4 * 0.1**2
    thrusts = pin_forces(motion).thrusts
    for each in ("lift", "master", "slave"):
        assert_allclose(thrusts[each], machine.plan.members[each].thrust(motion), rtol=1e-11)
    step, energy = 1e-6, {}
    for k in (-2, -1, 1, 2):
        energy[k] = 2000 * 9.80665 * machine(**{"level.oil": k * step}).sweep(9)["F"][1]
    assert_allclose(level.pressure(motion), (energy[-2] - 8 * energy[-1] + 8 * energy[1] - energy[2]) / (12 * step), rtol=1e-8)
