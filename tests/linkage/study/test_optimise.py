"""The search for better dimensions: against closed forms, brute force, the multipliers' meaning, and what must be refused."""

import json
from dataclasses import replace
from itertools import cycle

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Cylinder, LiftCircuit, buckling, fits, pressure, reserve, thrust
from linkage import (
    LEFT,
    RIGHT,
    Crank,
    DefinitionError,
    Dimension,
    Dyad,
    Force,
    Ground,
    LoadCase,
    Mechanism,
    OnLink,
    Over,
    PinFriction,
    Stroke,
    StudyError,
    Weight,
    around,
    at,
    deg,
    distance,
    drive_force,
    integral,
    least,
    mm,
    most,
    optimise,
    pin_force,
    ratio,
    reachable,
    ref,
    transmission,
    worst,
    x,
    y,
)
from linkage.motion.measures import conditions_of
from linkage.study import InfeasibleError
from linkage.study.problem import Problem
from linkage.study.solver import Local, graded, graded_leaf
from linkage.study.space import Space
from linkage.units import bar, kN
from mechanisms.classics.four_bar import FourBar
from mechanisms.classics.stephenson_three import StephensonThreeFar
from tests.for_all import for_all
from tests.laws.random_machines import random_machine
from tests.linkage.known_machines import BoomArm


class Boom(BoomArm):
    """A boom lifted by one cylinder below it."""

    lift = Cylinder("A", "B", bore=80 * mm, rod=45 * mm, closed=0.5, stroke=0.25)
    circuit = LiftCircuit(lift, pressure=180 * bar)


class Loaded(Boom):
    """The same with load cases, all of which count where none is named."""

    full = LoadCase(scale={"load": 2.0})
    empty = LoadCase(scale={"load": 0.1})


TRAVEL = at(y("G"), S=0.25) - at(y("G"), S=0.0)
VARY = {"A": around(60 * mm), "O": around(60 * mm), "OB": (0.25, 0.35)}


class Lever(Mechanism):
    """A cylinder between (a, 0) on the frame and the end of a lever of length r about the origin: h = a r sin(q) / AB."""

    q = Stroke(60 * deg, 120 * deg)
    a = Dimension(0.5)
    O = Ground(0.0, 0.0)
    A = Ground(0.8, 0.0)
    B = Crank(O, OB=0.4, angle=q)
    lever = ratio(distance(A, B))


def arm(A, r, q):
    return A * r * np.sin(q) / np.sqrt(A * A + r * r - 2.0 * A * r * np.cos(q))


# -- against closed forms and brute force -------------------------------------------------------------------


def test_the_best_least_lever_is_that_of_the_closed_form():
    best = optimise(Lever(), maximise=least(ratio(distance("A", "B"))), vary={"A.x": (0.3, 1.2), "OB": (0.1, 0.4)}, starts=2, subject_to=[
        most(distance("A", "B")) - least(distance("A", "B")) <= 0.3,
    ])  # fmt: skip
    # by hand: a fine grid of the two lengths
    A, r = np.meshgrid(np.linspace(0.3, 1.2, 901), np.linspace(0.1, 0.4, 601), indexing="ij")
    q = np.linspace(60, 120, 13)[:, None, None] * deg
    low, high = (np.sqrt(A * A + r * r - 2.0 * A * r * np.cos(end * deg)) for end in (60, 120))
    worth = np.where(high - low <= 0.3, arm(A, r, q).min(axis=0), 0.0)
    assert best.value >= worth.max() - 1e-9
    assert best.value <= worth.max() * 1.002
    at_best = arm(best.machine["A.x"], best.machine["OB"], np.linspace(60, 120, 100001) * deg)
    assert_allclose(best.value, at_best.min(), rtol=1e-9)
    assert best.active
    assert best.active[0].spare == pytest.approx(0.0, abs=1e-9)
    assert str(replace(best.conditions[0], left=np.nan, gain=0.0)).endswith(": not limited")


def test_an_optimum_is_not_beaten_by_random_designs_and_holds_between_the_poses():
    limits = [TRAVEL >= 0.65, most(buckling("lift")) <= 0.5, most(pin_force("O")) <= 15 * kN, least(transmission("B")) >= 20 * deg]
    best = optimise(Boom(), minimise=most(pressure("lift")), vary=VARY, subject_to=limits, starts=2)
    problem = best.problem
    unit = np.random.default_rng(1).random((1500, 5))
    value, missing, reached = problem.merits((), unit)
    kept = (reached == 1.0) & (missing <= 0.0)
    assert kept.sum() > 15
    assert best.value <= value[kept].min() * (1.0 + 1e-9)
    fine = best.machine.sweep(4001)
    assert_allclose(np.max(fine[pressure("lift")]), best.value, rtol=1e-6)
    assert np.max(fine[pin_force("O")]) <= 15 * kN * (1.0 + 1e-6)


def test_an_unknown_method_names_those_there_are():
    with pytest.raises(DefinitionError, match='say "auto" or "local" or "multistart"'):
        optimise(Boom(), maximise=least(reserve("lift")), vary={"OB": (0.27, 0.33)}, method="evolution")


def test_an_objective_that_nothing_moves_is_refused_in_words():
    fixed = [at("lift.bore"), at("O.x"), most(x("O")), at("lift.bore") * 2.0 + at("lift.rod"), most(lambda motion: 0.0 * motion.x("B"))]
    varied = [{"OB": (0.25, 0.35)}, {"OB": [0.27, 0.3], "A": around(60 * mm)}, {"OB": [0.27, 0.3]}]
    for objective, way, vary in zip(fixed, cycle(("minimise", "maximise")), cycle(varied), strict=False):
        with pytest.raises(StudyError, match=r"nothing that varies moves .* whatever .*OB; vary what it depends on"):
            optimise(Boom(), **{way: objective}, vary=vary, method="local")
    with pytest.raises(StudyError, match=r"nothing that varies moves at\(OB\), which is 300 mm whatever A.x, A.y"):
        optimise(Boom(), minimise="OB", vary={"A": around(60 * mm)}, subject_to=[least(reserve("lift")) >= 1.0])
    assert optimise(Boom(), minimise=at("OB"), vary={"OB": [0.27, 0.3]}).value == 0.27


def test_the_same_seed_gives_the_same_to_the_last_bit():
    first, second = (optimise(Boom(), maximise=least(reserve("lift")), vary={"A": around(60 * mm)}, starts=2, seed=3) for _ in range(2))
    assert first.machine.dimensions == second.machine.dimensions
    assert str(first) == str(second)


def test_a_worst_pose_between_the_samples_is_found_and_kept():
    """A narrow hump: 1/80 of the stroke wide, between two of the samples that the search begins with."""

    class Humped(Mechanism):
        S = Stroke(0.0, 1.0)
        A = Ground(0.0, 0.0)
        B = Ground(1.0, 0.0)
        C = Dyad(A, B, AC=0.8, BC=0.5 + 0.2 * S, side=LEFT)
        height = Dimension(1.0)
        hump = ref("height") * np.exp(-(((S - 0.4895) / 0.006) ** 2)) + 0.01 * S

    best = optimise(Humped(), maximise=at("height"), vary={"height": (0.1, 3.0)}, subject_to=[most("hump") <= 0.5], starts=1)
    S = np.linspace(0.48, 0.5, 200001)
    assert_allclose(best.machine["height"], 0.5 / np.max(np.exp(-(((S - 0.4895) / 0.006) ** 2)) + 0.01 * S / 0.49), rtol=1e-3)
    assert np.max(best.machine.sweep(100001)["hump"]) <= 0.5 * (1.0 + 1e-6)


def test_an_integral_is_a_work():
    best = optimise(Boom(), minimise=integral(drive_force()), vary={"OB": (0.25, 0.35)}, starts=1)
    motion = best.machine.sweep(2001)
    gained = 500 * 9.80665 * (motion.y("G")[-1] - motion.y("G")[0])
    assert_allclose(best.value, gained, rtol=1e-9)


def test_the_worst_over_another_stroke():
    class Crane(Mechanism):
        phi = Stroke(20 * deg, 100 * deg)
        psi = Stroke(-60 * deg, 120 * deg)
        O = Ground(0.0, 0.0)
        J = Crank(O, OJ=3.0, angle=phi)
        T = OnLink(O, J, OT=4.0, angle=0.2) if False else Crank(J, JT=2.0, angle=psi)
        load = Weight(T, mass=100)

    moment = worst(drive_force("phi") + drive_force("psi"), over="psi")
    best = optimise(Crane(), minimise=integral(moment, by="phi"), vary={"JT": (1.0, 2.5)}, starts=1)
    phi = np.linspace(20, 100, 4001) * deg
    by_hand = 100 * 9.80665 * np.trapezoid(3.0 * np.cos(phi) + 1.0, phi)
    assert_allclose(best.value, by_hand, rtol=1e-6)
    assert best.machine["JT"] == pytest.approx(1.0)


def test_the_stroke_may_follow_the_design():
    """The cylinder's stroke is a variable: as long as the lift asks for, no longer."""
    best = optimise(
        Boom(), minimise=at("lift.stroke"), vary={"lift.stroke": (0.1, 0.28)}, over={"S": (0.0, "lift.stroke")},
        subject_to=[most(y("G")) - least(y("G")) >= 0.6], starts=2,
    )  # fmt: skip
    motion = best.machine.at(S=np.linspace(0.0, best.machine["lift.stroke"], 1001))
    assert_allclose(np.ptp(motion.y("G")), 0.6, rtol=1e-6)


# -- load cases, spread, several objectives -----------------------------------------------------------------


@pytest.mark.slow
def test_several_load_cases_are_all_kept_and_the_worst_counts():
    asked = dict(maximise=least(reserve("lift")), vary={"OB": (0.25, 0.35)}, starts=1)
    both, full, plain = (optimise(Loaded(), **asked, case=case) for case in (["full", "empty"], "full", "plain"))
    assert_allclose(both.value, full.value, rtol=1e-6)
    assert_allclose(optimise(Loaded(), **asked).value, full.value, rtol=1e-6)  # all that occur
    assert_allclose(optimise(Loaded(), **asked, over=Over(cases=("plain", "empty"))).value, plain.value, rtol=1e-6)
    assert_allclose(full.value, plain.value / 2.0, rtol=1e-6)


def test_robust_counts_each_number_as_bad_as_tolerances_make_it():
    tolerances = {"OB": 1 * mm, "A": 1 * mm}
    kept = {"subject_to": [at("lift.bore") >= 40 * mm], "robust": tolerances, "sigmas": 2.0}  # a size by its name has no spread
    best = optimise(Boom(), maximise=least(reserve("lift")), vary={"OB": (0.25, 0.35)}, starts=1, **kept)
    motion = best.machine.sweep(401)
    slopes = motion.gradient(reserve("lift"), wrt=["OB", "A.x", "A.y"])
    sigma = np.sqrt(((slopes * 1 * mm / 3.0) ** 2).sum(axis=0))
    assert_allclose(best.value, np.min(motion[reserve("lift")] - 2.0 * sigma), rtol=1e-6)


def test_a_front_holds_designs_of_which_none_is_better_in_both(monkeypatch):
    pytest.importorskip("pymoo")
    monkeypatch.setattr("linkage.study.pareto.POINTS", 4)
    front = optimise(Boom(), minimise=[most(pressure("lift"))], maximise=[TRAVEL], vary={"A": around(60 * mm), "OB": (0.25, 0.35)})
    values = front.values * [1.0, -1.0]
    for one in values:
        assert not ((values <= one) & (values < one - 1e-9 * abs(one))).all(axis=1).any()
    lightest = optimise(Boom(), minimise=most(pressure("lift")), vary={"A": around(60 * mm), "OB": (0.25, 0.35)}, starts=2)
    assert_allclose(front.values[0, 0], lightest.value, rtol=1e-5)
    for point in (front.points[0], front.points[-1]):
        assert_allclose(np.max(point.machine.sweep(1001)[pressure("lift")]), point.values[0], rtol=1e-6)


# -- choices, steps, catalogues -------------------------------------------------------------------------------

ROWS = [(0.063, 0.036, 0.25, 0.48), (0.08, 0.045, 0.2, 0.45), (0.08, 0.045, 0.25, 0.5), (0.1, 0.056, 0.3, 0.55)]
NAMES = ("lift.bore", "lift.rod", "lift.stroke", "lift.closed")


def test_a_catalogue_row_is_one_variable_and_a_row_that_cannot_is_cut_in_words():
    limits = [least(reserve("lift")) >= 5.0, fits("lift"), at("lift.stroke") >= 0.22]
    best = optimise(Boom(), minimise=at("lift.bore"), vary={"OB": (0.25, 0.35), NAMES: ROWS}, subject_to=limits, starts=2)
    assert best.machine["lift.bore"] == 0.08
    assert best.machine["lift.closed"] == 0.5
    assert len(best.cut) == 1
    assert "lift.stroke = 200 mm" in best.cut[0]
    assert "20 mm" in best.cut[0]


def test_choices_that_all_cannot_are_told_so_with_variables_and_without():
    for vary in ({NAMES: ROWS}, {NAMES: ROWS, "OB": (0.25, 0.35)}):
        with pytest.raises(StudyError, match=r"no combination of choices can keep the conditions: .* is missed by"):
            optimise(Boom(), minimise=at("lift.bore"), vary=vary, subject_to=[at("lift.stroke") >= 0.5])


def test_choices_alone_are_all_looked_at():
    holes = [(0.0, 0.0), (0.03, -0.02), (-0.04, 0.02), (0.01, 0.05)]
    kept = [TRAVEL <= 2.0]
    best = optimise(Boom(), maximise=least(reserve("lift")), vary={"A": holes, "OB": [0.28, 0.3, 0.32]}, subject_to=kept)
    every = [np.min(Boom(A=A, OB=OB).sweep(501)[reserve("lift")]) for A in holes for OB in (0.28, 0.3, 0.32)]
    assert_allclose(best.value, max(every), rtol=1e-6)


@pytest.mark.slow
def test_steps_are_kept_and_no_design_on_steps_beats_it(tmp_path):
    vary = {"OB": (0.25, 0.35, 0.01), "A.y": (-0.06, 0.06)}
    best = optimise(Boom(), minimise=most(pressure("lift")), vary=vary, subject_to=[TRAVEL <= 0.64], starts=2)
    best.designs_csv(tmp_path / "designs.csv")
    best.designs_jsonl(tmp_path / "designs.jsonl")
    lines = (tmp_path / "designs.csv").read_text().splitlines()
    assert lines[0].split(",")[0] == "stage" and len(lines) == 1 + sum(len(each.unit) for each in best.tried)
    looked = [json.loads(line) for line in (tmp_path / "designs.jsonl").read_text().splitlines()]
    assert {"OB", "A.y", "value"} <= looked[0].keys() and all(0.25 <= each["OB"] <= 0.35 for each in looked)
    steps = best.machine["OB"] / 0.01
    assert steps == pytest.approx(round(steps), abs=1e-9)
    every = [
        optimise(Boom(OB=OB), minimise=most(pressure("lift")), vary={"A.y": (-0.06, 0.06)}, subject_to=[TRAVEL <= 0.64], starts=1).value
        for OB in (best.machine["OB"] - 0.01, best.machine["OB"] + 0.01)
        if OB <= 0.35
    ]
    assert all(best.value <= each * (1.0 + 1e-7) for each in every)


def test_a_design_whose_steps_all_miss_a_condition_is_none():
    between = [at("OB") >= 0.302, at("OB") <= 0.308]
    with pytest.raises(StudyError, match=r"no design that was found can be kept.*on its steps misses the conditions"):
        optimise(Boom(), minimise=at("OB"), vary={"OB": (0.25, 0.35, 0.01)}, subject_to=between, starts=1)


def test_rounding_says_what_it_costs_and_keeps_the_conditions():
    best = optimise(Boom(), minimise=most(pressure("lift")), vary=VARY, subject_to=[TRAVEL >= 0.6], starts=2)
    drawn = best.rounded(1 * mm)
    assert drawn.feasible
    for name in ("A.x", "A.y", "O.x", "O.y", "OB"):
        assert drawn.machine[name] / mm == pytest.approx(round(drawn.machine[name] / mm), abs=1e-6)
    assert drawn.cost >= -1e-9
    assert_allclose(np.max(drawn.machine.sweep(1001)[pressure("lift")]), best.value * (1.0 + drawn.cost), rtol=1e-6)
    assert "worse than unrounded" in str(drawn)


# -- what limits it ---------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_a_multiplier_is_what_giving_way_gains():
    def search(travel, high):
        vary, limits = {"A": around(60 * mm), "OB": (0.25, high)}, [at(y("G"), S=0.25) - at(y("G"), S=0.0) >= travel]
        return optimise(Boom(), minimise=most(pressure("lift")), vary=vary, subject_to=limits, starts=1)

    best = search(0.73, 0.28)
    (kept,) = best.conditions
    assert kept.active
    weaker = search(0.73 * 0.999, 0.28)
    assert_allclose(kept.gain * 0.1, (best.value - weaker.value) / best.value, rtol=0.02)
    for end in best.bounds:
        if end.variable.name == "OB" and end.is_upper:
            longer = search(0.73, 0.281)
            assert_allclose(end.gain * 0.1, (best.value - longer.value) / best.value, rtol=0.05)


def test_infeasible_says_which_conflict_by_how_much_and_the_least_relaxation():
    with pytest.raises(InfeasibleError, match="no design found in the box keeps all conditions") as caught:
        optimise(Boom(), minimise=most(pressure("lift")), vary={"OB": (0.25, 0.35)}, subject_to=[TRAVEL >= 0.7, TRAVEL <= 0.65], starts=2)
    (one,) = caught.value.relaxations if len(caught.value.relaxations) == 1 else caught.value.relaxations[:1]
    total = sum(each.by for each in caught.value.relaxations)
    assert_allclose(total, 0.05, rtol=1e-3)
    assert len(caught.value.conflict) == 2
    assert "short" in one.sentence
    assert isinstance(caught.value.nearest, Boom)


def test_nothing_that_cannot_be_assembled_is_ever_returned():
    """The box holds designs that do not reach the stroke's end; the best one would."""

    class Reaching(Mechanism):
        S = Stroke(0.0, 0.3)
        A = Ground(0.0, 0.0)
        O = Ground(0.5, 0.0)
        B = Dyad(A, O, AB=0.4 + S, OB=0.2, side=LEFT)

    best = optimise(Reaching(OB=0.22), minimise=at("OB"), vary={"OB": (0.05, 0.4)}, subject_to=[reachable], starts=4)
    assert_allclose(best.machine["OB"], 0.2, atol=1e-6)
    best.machine.sweep(1001)
    with pytest.raises(StudyError, match=r"none of .* designs looked at can be assembled over the whole stroke(?s:.*)mm short"):
        optimise(Reaching(), minimise=at("OB"), vary={"OB": (0.05, 0.15)})


@pytest.mark.slow
@pytest.mark.parametrize("also", [{}, {"OB": (0.25, 0.35)}], ids=["alone", "with a length"])
def test_a_design_that_is_refused_counts_as_one_that_cannot_be(also):
    """Beyond some back pressure nothing is left of the pump's: that is refused of a motion, and no reason to stop a search."""
    vary, limits = {"circuit.back_pressure": (0.0, 900 * bar), **also}, [least(reserve("lift")) >= 1.5]
    best = optimise(Boom(), maximise=at("circuit.back_pressure"), vary=vary, subject_to=limits, starts=2)
    fine = best.machine.sweep(1001)[reserve("lift")]
    assert_allclose(np.min(fine), 1.5, rtol=1e-5)
    with pytest.raises(DefinitionError, match="eats up the pump"):  # of the machine as it is set
        optimise(best.machine.replaced(**{"circuit.back_pressure": 890 * bar}), minimise=most(reserve("lift")), vary={"OB": (0.25, 0.35)})


# -- derivatives, of any machine -----------------------------------------------------------------------------------


@for_all("seed", range(1), slow=range(1, 12))
def test_rows_have_the_derivatives_of_central_differences(seed):
    machine = random_machine(seed).machine()()
    plan = machine.plan
    rng = np.random.default_rng(seed)
    names = [name for name in machine.dimensions if plan.table.entries[name].kind in ("length", "coordinate")]
    if not names:
        pytest.skip("no length to vary")
    chosen = [str(each) for each in rng.choice(names, size=min(3, len(names)), replace=False)]
    vary = {name: (machine[name] - 0.01, machine[name] + 0.01) for name in chosen}
    point = plan.moving[-1]
    space = Space.of(machine, vary)
    goals = [most(y(point)) - least(x(point)), most(drive_force(next(iter(plan.strokes))))]
    problem = Problem(machine, goals, conditions_of([], machine), space)
    unit = space.unit(space.present(machine))
    look = problem.evaluated(problem.dimensions_at(unit, ()), slopes=True)
    if not look.is_assembled[0]:
        pytest.skip("not assembled over its whole stroke")
    for leaf, rows in look.rows.items():
        for place in range(len(unit)):
            ends = []
            for sign in (1.0, -1.0):
                moved = unit.copy()
                moved[place] += sign * 1e-6
                ends.append(problem.evaluated(problem.dimensions_at(moved, ())).rows[leaf].values[0])
            by_hand = (ends[0] - ends[1]) / 2e-6
            size = np.max(np.abs(by_hand)) + 1e-3
            assert np.max(np.abs(by_hand - rows.slopes[place])) < 2e-4 * size + 2e-9 * np.max(np.abs(rows.values))


def test_a_measure_raised_to_a_measure_has_both_derivatives():
    machine = Boom()
    space = Space.of(machine, {"OB": (0.28, 0.32)})
    problem = Problem(machine, [most(pressure("lift")) ** at("OB")], [], space)

    def graded(unit):
        local = Local(problem, (), np.array([unit]))
        return local.graded(problem.objectives[0], local.evaluated_at(np.array([unit])), local.first(np.array([unit])))

    def value(unit):
        machine_there = problem.machine_of(np.array([unit]), ())
        return float(np.max(machine_there.sweep(49)[pressure("lift")]) ** machine_there["OB"])

    by_hand = (value(0.5 + 1e-5) - value(0.5 - 1e-5)) / 2e-5
    found = graded(0.5)
    assert_allclose(found.value, value(0.5), rtol=1e-12)
    place = [column for column in range(1, len(found.slope)) if found.slope[column]]  # the leaf is a variable of its own
    through = sum(found.slope[column] * slope for column, slope in zip(place, leaf_slopes(problem), strict=True))
    assert_allclose(found.slope[0] + through, by_hand, rtol=1e-6)


def test_derivatives_of_a_sum_of_sums_leave_the_warnings_of_numpy_as_they_are():
    tilt = most("tilt")
    look = Problem(Boom(), [tilt], [], Space.of(Boom(), {"OB": (0.28, 0.32)})).evaluated(Boom().dimensions, slopes=True)
    with np.errstate(divide="raise", invalid="warn"):
        before = np.geterr()
        graded((tilt + 1.0) * tilt / (tilt - 2.0), lambda leaf: graded_leaf(leaf, look))
        assert np.geterr() == before


def leaf_slopes(problem):
    """Return how the scaled greatest pressure changes with the unit coordinate."""
    local = Local(problem, (), np.array([0.5]))
    look = local.evaluated_at(np.array([0.5]))
    (leaf,) = [each for _, each in local.aux]
    rows = look.rows[leaf]
    return [rows.slopes[0, int(np.argmax(rows.values[0]))] / local.leaf_scales[leaf]]


@pytest.mark.slow
def test_groups_solved_by_iteration_are_searched_too():
    machine = StephensonThreeFar()
    names = [name for name in ("AB", "CB", "OA") if name in machine]
    vary = {name: (machine[name] * 0.99, machine[name] * 1.01) for name in names}
    goal = most(y("D")) - least(y("D"))
    best = optimise(machine, minimise=goal, vary=vary, starts=1)
    assert best.value < best.start_value
    fine = best.machine.sweep(501).y("D")
    assert_allclose(np.ptp(fine), best.value, rtol=1e-5)


@pytest.mark.slow
def test_friction_and_functions_of_a_motion_are_searched_by_differences():
    class Worn(Boom):
        pin = PinFriction("O", radius=30 * mm, coefficient=0.2)

    rubbing = optimise(Worn(), maximise=least(reserve("lift")), vary={"OB": (0.25, 0.34)}, starts=1)
    assert_allclose(rubbing.value, np.min(rubbing.machine.sweep(501)[reserve("lift")]), rtol=1e-6)
    assert rubbing.machine["OB"] == pytest.approx(0.34, abs=1e-6)

    def height(motion):
        return motion.y("G")

    own, known = (optimise(Boom(), maximise=least(q), vary={"OB": (0.25, 0.35)}, starts=1) for q in (height, y("G")))
    assert_allclose(own.value, known.value, rtol=1e-6)


class Rubbing(Loaded):
    """With friction in both directions, which no load case takes away."""

    pin = PinFriction("O", radius=30 * mm, coefficient=0.2)


class Low(Rubbing):
    """It runs over a box, which a search takes."""

    run = Over(S=(0.0, 0.1), cases=["full"])


class Ways(Rubbing):
    """It runs over a path too, along which no search runs."""

    run, back = Over(S=(0.0, 0.1)), Over.path(S=[0.2, 0.1])


LEAST = [("minimise", most(pressure("lift"))), ("minimise", most(pin_force("O"))), ("maximise", least(reserve("lift")))]
WHERE = {Low: "Assembled over S = 0 to 100 mm.", Ways: "A search does not run along run, back: ask the design found"}


@for_all(
    "machine, aim, measure",
    [(Low, "minimise", most(abs(thrust("lift")))), (Low, "minimise", 2 * most(thrust("lift")) - least(thrust("lift")))],
    slow=[(machine, *each) for machine in (Loaded, Rubbing, Low, Ways) for each in LEAST],
)
def test_the_number_found_is_the_one_that_the_judge_gives(machine, aim, measure):
    found = optimise(machine(), vary={"OB": (0.29, 0.31)}, starts=1, limit=3, method="local", **{aim: measure})
    (judged,) = found.machine.answers([measure], over=Over() if machine is Ways else None)
    assert found.value == pytest.approx(float(judged.value), rel=1e-9)
    assert WHERE.get(machine, "Assembled over the whole stroke.") in str(found)


class Balanced(Mechanism):
    """A beam between two weights: its ram pushes, or pulls where the counterweight hangs farther out."""

    S = Stroke(0.0, 0.2)
    c = Dimension(0.3, unit="m")
    O = Ground(0.0, 0.0)
    A = Ground(0.35, -0.9)
    B = Dyad(A, O, AB=0.8 + S, OB=0.4, side=LEFT)
    G = OnLink(O, B, OG=1.5, BOG=0.0)
    H = OnLink(O, B, OH=c, BOH=180 * deg)
    load, counter = Weight(G, mass=400), Weight(H, mass=900)
    pin = PinFriction(O, radius=50 * mm, coefficient=0.3)
    ram = Cylinder(A, B, bore=80 * mm, rod=50 * mm, works="both")
    line = LiftCircuit(ram, pressure=200 * bar)


@pytest.mark.slow
def test_movements_that_no_design_needed_but_the_winner_are_sought_too():
    """Pulling in, the rod side has the smaller area: where both thrusts are nearly equal, its pressure is the greater one."""
    goal = most(pressure("ram"))
    best = optimise(Balanced(), minimise=goal, vary={"c": (0.6, 0.7)}, starts=1, limit=12, method="local")
    (judged,) = best.machine.answers([goal])
    assert best.value == pytest.approx(float(judged.value), rel=1e-9)
    assert len(best.problem.objectives) == 2


@pytest.mark.slow
def test_exact_rows_of_forces_hold_with_several_cylinders_and_strokes():
    class Two(Mechanism):
        S1 = Stroke(0.0, 0.2)
        S2 = Stroke(0.0, 0.15)
        A = Ground(0.0, 0.0)
        O = Ground(0.6, 0.1)
        B = Dyad(A, O, AB=0.5 + S1, OB=0.3, side=RIGHT)
        J = OnLink(O, B, OJ=1.5, BOJ=100 * deg, side=LEFT)
        C = OnLink(O, B, OC=1.0, BOC=80 * deg, side=LEFT)
        D = Dyad(C, J, CD=0.45 + S2, JD=0.25, side=LEFT)
        T = OnLink(J, D, JT=1.2, DJT=150 * deg, side=RIGHT)
        load = Force(T, (0, -2000))
        one = Cylinder(A, B, bore=80 * mm, rod=45 * mm)
        two = Cylinder(C, D, bore=63 * mm, rod=36 * mm, works="both")

    best = optimise(
        Two(), minimise=most(abs(thrust("one"))), vary={"OB": (0.28, 0.34), "JD": (0.24, 0.27)},
        subject_to=[most(abs(thrust("two"))) <= 40 * kN], starts=1,
    )  # fmt: skip
    motion = best.machine.sweep(S1=41, S2=41)
    assert np.max(np.abs(motion[thrust("one")])) <= best.value * (1.0 + 1e-6)
    assert np.max(np.abs(motion[thrust("two")])) <= 40 * kN * (1.0 + 1e-6)


def test_local_search_of_elastic_and_plain_agree_where_all_is_kept():
    machine = Boom()
    space = Space.of(machine, {"OB": (0.25, 0.35)})
    problem = Problem(machine, [most(pressure("lift"))], conditions_of([TRAVEL >= 0.5], machine), space)
    unit = space.unit(space.present(machine))
    assert Local(problem, (), unit, elastic=problem.constraints).run().missing == 0.0


def test_of_two_conditions_in_conflict_those_give_way_that_may():
    machine = Boom()
    space = Space.of(machine, {"OB": (0.25, 0.35)})
    problem = Problem(machine, [most(pressure("lift"))], conditions_of([TRAVEL >= 0.72, TRAVEL <= 0.66], machine), space)
    low, high = problem.constraints
    for may, travel in (([low], 0.66), ([high], 0.72), ([high, low], 0.66)):  # of both that which costs less of its size
        end = Local(problem, (), np.array([0.5]), elastic=may).run()
        assert_allclose(problem.evaluated(problem.dimensions_at(end.unit, ())).values_of(TRAVEL), travel, rtol=1e-6)


def test_of_several_designs_each_says_how_much_of_it_is_reached():
    machine = Boom()
    problem = Problem(machine, [most("tilt")], [], Space.of(machine, {"OB": (0.05, 0.35)}))
    look = problem.evaluated(problem.dimensions_at(np.array([[1.0], [0.2], [0.9]]), ()))
    assert look.is_assembled.tolist() == [True, False, True] and look.reached[[0, 2]].tolist() == [1.0, 1.0]
    alone = problem.machine_of(np.array([0.2]), ()).at(S=np.linspace(0.0, 0.25, 49), unreachable="nan").reached
    assert look.reached[1] == pytest.approx(np.mean(alone)) and 0.0 < np.mean(alone) < 1.0


# -- kept on the way ------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_searches_that_meet_are_judged_once_and_are_the_same_design(monkeypatch):
    """Where one search ended the next ones look at once; the first alone adds poses and is judged between them."""
    judged, truth = [], Local._truth

    def counted(local, unit):
        judged.append(unit)
        return truth(local, unit)

    monkeypatch.setattr(Local, "_truth", counted)
    limits = [TRAVEL >= 0.65, most(pin_force("O")) <= 15 * kN]
    best = optimise(Boom(), minimise=most(pressure("lift")), vary=VARY, subject_to=limits)
    assert (best.agreed, best.tries) == (6, 6)
    assert len(judged) == 1
    alone = optimise(Boom(), minimise=most(pressure("lift")), vary=VARY, subject_to=limits, starts=1)
    assert_allclose(best.value, alone.value, rtol=1e-8)


def test_a_search_goes_on_where_it_stopped(tmp_path):
    class StoppedError(Exception):
        pass

    done = []

    def stop(count, total):
        done.append(count)
        if count == 2:
            raise StoppedError

    ask = dict(maximise=least(reserve("lift")), vary=VARY, subject_to=[TRAVEL >= 0.5], starts=3)
    with pytest.raises(StoppedError):
        optimise(Boom(), **ask, folder=tmp_path, progress=stop)
    first, second = sorted(tmp_path.glob("designs-*.npy"))
    content = second.read_bytes()
    second.write_bytes(content[:-9])  # torn while it was written
    again, fresh = optimise(Boom(), **ask, folder=tmp_path), optimise(Boom(), **ask)
    assert again.machine.dimensions == fresh.machine.dimensions
    assert again.value == fresh.value
    assert second.read_bytes() == content and first.exists()
    kept = [str(np.load(path)["task"][0]) for path in tmp_path.glob("designs-*.npy")]
    assert {*kept} == {"[] 0", "[] 1", "[] 2"}
    with pytest.raises(DefinitionError, match="holds another search"):
        optimise(Boom(), maximise=least(reserve("lift")), vary=VARY, folder=tmp_path)


# -- what cannot be asked -------------------------------------------------------------------------------------------

WRONG = {
    "nothing to seek": (dict(vary=VARY), "say minimise= or maximise="),
    "a value at every pose": (dict(minimise=pressure("lift"), vary=VARY), "has a value at every pose: say which is meant"),
    "no vary": (dict(minimise=most("tilt"), vary={}), "vary={}: a dictionary is expected"),
    "an unknown dimension": (dict(minimise=most("tilt"), vary={"OX": (0, 1)}), "OX"),
    "a stroke": (dict(minimise=most("tilt"), vary={"S": (0, 0.1)}), "S is a stroke and no dimension"),
    "a range the wrong way": (dict(minimise=most("tilt"), vary={"OB": (0.3, 0.2)}), "is no range"),
    "a step that is a text": (dict(minimise=most("tilt"), vary={"OB": (0.2, 0.3, "")}), "is no range; write"),
    "a point as a range": (dict(minimise=most("tilt"), vary={"A": (0.1, 0.2)}), "A is a point; write around"),
    "twice the same": (dict(minimise=most("tilt"), vary={"A": around(0.01), "A.x": (0, 0.1)}), "both set"),
    "no condition": (dict(minimise=most("tilt"), vary=VARY, subject_to=[most("tilt")]), "says no limit"),
    "a truth value": (dict(minimise=most("tilt"), vary=VARY, subject_to=[True]), "is no condition"),
    "an unknown output": (dict(minimise=most("tilts"), vary=VARY), "tilts"),
    "an unknown stroke": (dict(minimise=at("tilt", T=0.1), vary=VARY), "Stroke 'T' is unknown"),
    "no pose": (dict(minimise=at("tilt"), vary=VARY), "say the pose, S="),
    "a range of no stroke": (dict(minimise=most("tilt"), vary=VARY, over={"T": (0, 1)}), "Stroke 'T' is unknown in Boom: over."),
    "no method": (dict(minimise=most("tilt"), vary=VARY, method="magic"), "magic"),
    "no cylinder": (dict(minimise=most(pressure("pump")), vary=VARY), "pump"),
    "no load case": (dict(minimise=most(pressure("lift")), vary=VARY, case="overload"), "overload"),
    "a short row": (dict(minimise=most("tilt"), vary={NAMES: [(0.1, 0.2)]}), "4 numbers are expected"),
}


@for_all("name", WRONG)
def test_what_cannot_be_asked_is_refused_in_words(name):
    asked, words = WRONG[name]
    with pytest.raises(DefinitionError) as caught:
        optimise(Boom(), **asked)
    assert words in str(caught.value)


def test_a_dimension_that_follows_another_is_told_so():
    class Following(Boom):
        dead = Dimension(0.2, unit="mm")
        lift = Cylinder("A", "B", bore=80 * mm, rod=45 * mm, closed=dead, stroke=0.25)

    with pytest.raises(DefinitionError, match=r"lift\.closed follows dead; vary what it follows"):
        optimise(Following(), minimise=most("tilt"), vary={"lift.closed": (0.2, 0.3)})


@pytest.mark.slow
def test_a_limit_of_zero_may_be_active_and_rounding_stays_in_the_range():
    vary = {"A": around(50 * mm), "OB": (0.25, 0.28)}
    by_limit, by_zero = (
        optimise(Boom(), minimise=most(pressure("lift")), vary=vary, subject_to=[limit], starts=2)
        for limit in (TRAVEL >= 0.73, TRAVEL - 0.73 >= 0.0)
    )
    assert_allclose(by_zero.value, by_limit.value, rtol=1e-6)
    (one,), (other,) = by_limit.active, by_zero.active
    assert_allclose(one.gain / one.by, other.gain / other.by, rtol=1e-3)
    coarse = by_limit.rounded(20 * mm)
    for name, low, high in (("A.x", -0.05, 0.05), ("A.y", -0.05, 0.05), ("OB", 0.25, 0.28)):
        assert low - 1e-9 <= coarse.machine[name] <= high + 1e-9
    with pytest.raises(DefinitionError, match="as coarse as the machine"):
        by_limit.rounded(1)


@pytest.mark.parametrize("far", [around(60), (0.0, 300.0)])
def test_a_range_in_millimetres_is_told(far):
    name = "A" if not isinstance(far, tuple) else "OB"
    with pytest.raises(DefinitionError, match="far more than the machine is large"):
        optimise(Boom(), minimise=most("tilt"), vary={name: far})


def test_a_range_is_measured_by_the_machine_and_by_the_other_ranges_of_lengths():
    """Ranges of several lengths that agree are of one unit. One that does not is of another, or that leaves today's machine far away."""
    small, lengths = FourBar(OA=0.4 * mm, AB=1.1 * mm, CB=0.9 * mm, AP=1 * mm, C=(1 * mm, 0.0)), ("OA", "AB", "CB")
    wide = dict.fromkeys(lengths, (0.1 * mm, 50 * mm))
    for vary in (wide, wide | {"C.x": (-50 * mm, 50 * mm)}):
        assert [each.high for each in Space.of(small, vary).variables] == [50 * mm] * len(vary)
    for machine, vary in (
        (small, {"OA": (0.1, 50)}),
        (small, wide | {"AB": (0.1, 50)}),
        (small, wide | {"C": around(2)}),
        (small, {f"{point}.{axis}": (-50 * mm, 50 * mm) for point in "OC" for axis in "xy"}),
        (FourBar(), dict(zip(lengths, ((20, 60), (80, 150), (50, 120)), strict=True))),
        (FourBar(), {"OA": (60, 60.5)}),
    ):
        with pytest.raises(DefinitionError, match="far more than the machine is large; lengths are in m"):
            Space.of(machine, vary)


def test_conditions_and_measures_have_no_truth_value():
    with pytest.raises(DefinitionError, match="write two"):
        assert 0.2 <= TRAVEL <= 0.3
    with pytest.raises(DefinitionError, match="write >= or <="):
        assert TRAVEL > 0.2
    with pytest.raises(DefinitionError, match="one number of a design already"):
        least(most("tilt"))
