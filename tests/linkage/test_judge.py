"""The judge: every case, movement and side over all that a machine runs; what has no value; and the laws between answers."""

import re

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Cylinder, LiftCircuit, buckling, fits, pressure, reserve, thrust
from linkage import (
    LEFT,
    RIGHT,
    Acting,
    Column,
    Course,
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
    Weight,
    angle,
    at,
    distance,
    drive_force,
    driving_force,
    integral,
    least,
    most,
    optimise,
    pin_force,
    pin_forces,
    ramp,
    ratio,
    reachable,
    ref,
    speed,
    worst,
    x,
    y,
)
from linkage.program import Kernel
from linkage.statics.law_requests import LawRequest
from linkage.units import bar, deg, kN, mm
from tests.for_all import first_daily, for_all


class Loader(Mechanism):
    """An arm that a cylinder lifts and a bucket that another one tilts; loads from below in one case, with friction in the arm's pin."""

    S, T = Stroke(0.0, 0.30), Stroke(0.0, 0.20)
    A, O = Ground(0.0, 0.0), Ground(0.1, 0.6)
    B = Dyad(A, O, AB=0.5 + S, OB=0.35, side=LEFT)
    C = OnLink(O, B, OC=0.9)
    D = Dyad(O, C, OD=0.62 + T, CD=0.45, side=RIGHT)
    load = Weight(D, mass=500)
    pushed = Force(D, (0.0, 9 * kN))
    lift = Cylinder(A, B, bore=63 * mm, rod=36 * mm, works="both", closed=0.5, stroke=0.3)
    tilt = Cylinder(O, D, bore=50 * mm, rod=28 * mm, works="both")
    lines = LiftCircuit(lift, pressure=180 * bar, mechanical_efficiency=0.9)
    tilts = LiftCircuit(tilt, pressure=180 * bar)
    carry = LoadCase("carrying", scale={"pushed": 0.0, "load": 2.0})
    dig = LoadCase("digging", scale={"load": 0.2})


class Rubbing(Loader):
    """The same with friction in a pin."""

    rub = PinFriction("O", radius=0.03, coefficient=0.2)


def brute(machine, request, cases=(None, "carry", "dig"), count=61, **strokes):
    """Return a quantity over a grid in each of the cases, shape (cases, ...)."""
    motion = machine.sweep(S=count, T=count) if not strokes else machine.at(**strokes)
    return np.array([motion[request(case)] for case in cases])


def test_the_worst_load_case_is_found_and_named():
    (answer,) = Loader().answers([most(pressure("tilt"))])
    every = brute(Loader(), lambda case: thrust("tilt", case=case))
    size = Loader.plan.members["tilt"].size
    standing = np.maximum(every, 0.0) / size.push_area, np.maximum(-every, 0.0) / size.pull_area
    expected = max(each.max() for each in standing)
    assert answer.value >= expected * (1 - 1e-12) and answer.value <= expected * 1.01
    side, case, *_ = np.unravel_index(int(np.argmax(standing)), np.shape(standing))
    assert (answer.side, answer.case) == (("piston", "rod")[side], ("plain", "carry", "dig")[case])
    assert f"in the case {answer.case}" in str(answer) and "S = " in answer.where


def test_a_case_alone_is_asked_by_acting_and_refused_where_it_is_said_twice():
    machine = Loader()
    whole, alone = (machine.answers([least(reserve("lift"))], acting=acting)[0] for acting in (None, Acting(case="dig")))
    assert alone.value >= whole.value * (1 - 1e-12) and alone.case == "dig" and "case" not in alone.named
    with pytest.raises(DefinitionError, match=r"case='dig' stands in it, and acting= says case='carry'"):
        machine.answers([least(reserve("lift", case="dig"))], acting=Acting(case="carry"))
    with pytest.raises(DefinitionError, match="the load case carry does not occur over"):
        machine.answers([least(reserve("lift"))], over=Over(cases=("dig",)), acting=Acting(case="carry"))
    with pytest.raises(DefinitionError, match="Load case 'full' is unknown"):
        machine.answers([least(reserve("lift"))], acting=Acting(case="full"))


def test_friction_is_judged_in_both_directions_of_every_stroke():
    machine = Rubbing()
    (answer,) = machine.answers([most(pin_force("A"))])
    found = [
        float(np.max(np.hypot(*pin_forces(machine.sweep(S=9, T=9), case=case, direction=way, drive=drive).force("A"))))
        for case in (None, "carry", "dig")
        for way, drive in (("frictionless", None), *((way, name) for way in ("extending", "retracting") for name in ("S", "T")))
    ]
    assert answer.value >= max(found) * (1 - 1e-12) and answer.direction in ("extending", "retracting") and answer.drive in ("S", "T")


def test_a_path_rubs_along_its_tangent_and_a_held_stroke_moves_nothing():
    machine = Rubbing()
    path = Over.path(S=[0.0, 0.3], T=[0.0, 0.2])
    along = machine.answers([most(pin_force("A"))], over=path)[0]
    motion = machine.at(S=np.linspace(0, 0.3, 41), T=np.linspace(0, 0.2, 41))
    ways = ("frictionless", "extending", "retracting")
    expected = max(
        float(np.max(np.hypot(*pin_forces(motion, case=case, direction=way).force("A")))) for case in (None, "carry", "dig") for way in ways
    )
    assert expected * (1 - 1e-12) <= along.value <= expected * (1 + 1e-4)
    assert along.drive == ""
    held = machine.answers([most(pin_force("A"))], over=Over(T=0.1))[0]
    assert held.drive in ("", "S") and held.strokes["T"] == 0.1


# Laws.


QUESTIONS = [
    least(reserve("lift")), most(pressure("lift")), most(pressure("tilt")), most(buckling("tilt")), most(pin_force("O", "OBC")),
    most(y("D")), least(distance("A", "D")), most(thrust("tilt")),
]  # fmt: skip
BADLY = [1, -1, -1, -1, -1, -1, 1, -1]  # 1 where less is worse


@for_all("seed", range(1), slow=range(1, 4))
def test_a_larger_over_more_cases_and_a_union_never_make_an_answer_better(seed):
    rng = np.random.default_rng(seed)
    machine = Loader()
    low, high = np.sort(rng.uniform(0.0, 0.3, 2)), np.sort(rng.uniform(0.0, 0.2, 2))
    small = Over(S=tuple(low), T=tuple(high), cases=("plain",))
    large = Over(S=(low[0] * 0.5, 0.5 * (low[1] + 0.3)), T=tuple(high), cases=("plain", "carry", "dig"))
    path = Over.path(S=[low[0], low[1]], T=[high[1], high[0]], cases=("plain",))
    pose = Over.poses(S=[low[0]], T=[high[1]], cases=("plain",))
    values = {name: machine.answers(QUESTIONS, over=each) for name, each in dict(small=small, large=large, path=path, pose=pose).items()}
    union = machine.answers(QUESTIONS, over=[small, path])
    for k, sense in enumerate(BADLY):
        of = {name: sense * each[k].value for name, each in values.items()}
        tolerance = 1e-9 * max(map(abs, of.values()))
        assert of["large"] <= of["small"] + tolerance and of["small"] <= of["path"] + tolerance and of["path"] <= of["pose"] + tolerance
        assert_allclose(sense * union[k].value, min(of["small"], of["path"]), rtol=1e-12)


def test_a_held_stroke_is_the_box_with_one_value_and_the_number_of_poses_changes_nothing():
    machine = Loader()
    held = machine.answers(QUESTIONS, over=Over(S=(0.05, 0.2), T=0.1))
    one = machine.answers(QUESTIONS, over=Over(S=(0.05, 0.2), T=(0.1, 0.1)))
    few, many = (machine.judge(machine.sweep(S=count, T=count)).answers(QUESTIONS) for count in (2, 7))
    box = machine.answers(QUESTIONS, over=dict(S=(0.0, 0.3)))
    for a, b, c, d, e in zip(held, one, few, many, box, strict=True):
        assert a.value == b.value and c.value == d.value == e.value


def test_a_case_scaled_to_zero_answers_as_without_that_load():
    class Less(Loader):
        pushed = None
        carry = None
        dig = None

    class Scaled(Loader):
        none = LoadCase("none", scale={"pushed": 0.0})

    without = Less().answers([least(reserve("lift")), most(pin_force("O", "OBC"))])
    scaled = Scaled().answers([least(reserve("lift")), most(pin_force("O", "OBC"))], acting=Acting(case="none"))
    for a, b in zip(without, scaled, strict=True):
        assert_allclose(a.value, b.value, rtol=1e-12)


def test_mirrored_and_turned_machines_answer_alike():
    class Mirrored(Loader):
        A, O = Ground(0.0, 0.0), Ground(-0.1, 0.6)
        B = Dyad(A, O, AB=0.5 + ref("S"), OB=0.35, side=RIGHT)
        C = OnLink(O, B, OC=0.9)
        D = Dyad(O, C, OD=0.62 + ref("T"), CD=0.45, side=LEFT)

    for a, b in zip(Loader().answers(QUESTIONS[2:5]), Mirrored().answers(QUESTIONS[2:5]), strict=True):
        assert_allclose(a.value, b.value, rtol=1e-9)


def test_random_poses_never_beat_an_answer():
    machine, rng = Loader(), np.random.default_rng(7)
    answers = machine.answers(QUESTIONS)
    motion = machine.at(S=rng.uniform(0.0, 0.3, 10_000), T=rng.uniform(0.0, 0.2, 10_000))
    asked = {
        0: lambda case: reserve("lift", case=case), 3: lambda case: buckling("tilt", case=case),
        4: lambda case: pin_force("O", "OBC", case=case), 7: lambda case: thrust("tilt", case=case),
    }  # fmt: skip
    for k, of in asked.items():
        seen = np.array([motion[of(case)] for case in (None, "carry", "dig")])
        best = np.nanmin(seen) if BADLY[k] > 0 else np.nanmax(seen)
        assert BADLY[k] * answers[k].value <= BADLY[k] * best + 1e-6 * (np.nanmax(seen) - np.nanmin(seen))


# What has no value.


class Rocker(Mechanism):
    """One stroke, of which the last part cannot be assembled."""

    S = Stroke(0.0, 0.40)
    L0 = Dimension(0.5)
    A, O = Ground(0.20, 0.55), Ground(0.30, 1.15)
    B = Dyad(A, O, AB=L0 + S, OB=0.30, side=RIGHT)
    load = Weight(B, mass=100)
    lift = Cylinder(A, B, bore=63 * mm, rod=36 * mm)
    pump = LiftCircuit(lift, pressure=100 * bar)


def test_many_questions_over_a_box_are_each_answered_at_their_own_place():
    """How near D comes to places where it has been: there, and nowhere else of the box, nothing is left."""
    rng = np.random.default_rng(5)
    poses = {"S": rng.uniform(0.02, 0.28, 12), "T": rng.uniform(0.02, 0.18, 12)}
    been = Loader().at(**poses)["D"].T
    found = Loader().answers([least(abs(x("D") - float(a)) + abs(y("D") - float(b))) for a, b in been])
    assert_allclose([float(each.value) for each in found], 0.0, atol=1e-8)
    for name, values in poses.items():
        assert_allclose([float(each.strokes[name]) for each in found], values, atol=1e-8)


def test_lost_places_are_not_kept_unless_their_over_allows_them():
    long = Rocker(L0=0.6)
    kept, bare, whole = long.answers([most(y("B")) <= 10.0, most(y("B")), reachable])
    assert kept.ok is False and kept.status == "lost" and bare.ok is None and np.isfinite(bare.value)
    assert not whole.ok and whole.lost.surely
    far = np.hypot(0.1, 0.6) + 0.3 - 0.6
    assert_allclose(whole.lost.share, (0.4 - far) / 0.4, atol=1e-3)
    assert "B = Dyad(A, O) cannot be assembled" in whole.lost.sentence
    short = long.answers([most(y("B")) <= 10.0, reachable], over=Over(S=(0.0, 0.30)))
    assert all(each.ok for each in short)
    allowed = long.answers([most(y("B")) <= 10.0, reachable], over=Over(lost="allowed"))
    assert all(each.ok for each in allowed) and allowed[0].lost


def test_a_batch_is_told_in_units_and_by_its_designs():
    many = Rocker(L0=[0.45, 0.6])
    high, whole = many.answers([most(y("B")), reachable])
    assert re.fullmatch(r"[0-9.]+ mm to [0-9.]+ mm at S = .*", str(high))
    some = Rocker(L0=[0.45, 5.0]).answers([most(y("B"))])[0]  # the second is assembled nowhere, and has no place
    assert str(some) == str(Rocker(L0=0.45).answers([most(y("B"))])[0])
    assert str(whole) == "1 of 2 designs cannot be assembled over the whole motion"
    assert str(Rocker(L0=[0.45, 0.46]).answers([reachable])[0]) == "every place is assembled"


def test_the_drive_of_a_crank_is_a_moment_whatever_is_worked_out_with_it():
    class Jib(Mechanism):
        phi, out = Stroke(0.0, 1.0), Stroke(0.0, 0.5)
        O = Ground(0.0, 0.0)
        B = Crank(O, OB=1.0, angle=phi)
        T = OnLink(O, B, OT=1.5 + out)
        load = Weight(T, mass=10)

    turns, pulls = drive_force("phi"), drive_force("out")
    found = Jib().answers([most(turns), most(abs(turns)), most(1.5 * turns), least(pulls), most(np.minimum(turns, 100.0))])
    assert [str(each).split(" at ")[0] for each in found] == ["196.133 Nm", "196.133 Nm", "294.2 Nm", "0 kN", "100 Nm"]
    motion = Jib().sweep(phi=3, out=0.5)
    assert [Column.of(motion, each).unit for each in (turns, -turns, pulls)] == ["Nm", "Nm", "kN"]


def test_no_value_has_one_meaning():
    machine = Rocker()
    over = Over(S=(0.0, 0.25))

    def law_without(motion):
        return np.sqrt(motion.y("B") - 10.0)

    def endless(motion):
        return np.where(motion.strokes["S"] > 0.2, np.inf, motion.y("B"))

    lawless, above, below, drives = machine.answers(
        [least(law_without) >= 5.0, most(endless) <= 1e9, least(endless) >= 0.0, least(reserve("lift")) >= 1.0], over=over
    )
    assert lawless.ok is False and lawless.status == "lost" and np.isnan(lawless.value)
    assert above.ok is False and above.status == "unbounded" and np.isinf(above.value)
    assert below.ok is True
    assert drives.ok is not None

    class Hanging(Rocker):
        load = Force("B", (0.0, 9e3))

    answer = Hanging().answers([least(reserve("lift")) >= 1.0], over=over)[0]
    assert answer.ok is None and answer.status == "nothing left" and not bool(Hanging().judge(over).plan.of_kind(Over))
    verdict = next(each for each in Hanging().verdicts(over=over) if getattr(each, "rule", "") == "lifting")
    assert verdict.ok is None and not verdict and verdict.startswith("--   lifting: ")


def test_only_leaves_out_and_its_border_is_found():
    machine = Loader()
    inside = machine.answers([most(y("D")), most(x("D"))], over=Over(only=[y("D") <= 0.8]))
    assert_allclose(inside[0].value, 0.8, atol=1e-5)
    assert 0.0 < inside[0].outside < 1.0
    with pytest.raises(DefinitionError, match="no condition on poses"):
        Over(only=[True])
    words = Over(only=[y("D") >= 0.25, angle("A", "B") <= 90 * deg]).words(machine.at(S=0.0, T=0.0))
    assert "where y(D) >= 250 mm, angle(A, B) <= 90 deg" in words
    nowhere = machine.answers([most(y("D")) <= 1.0], over=Over(only=[y("D") >= 50.0]))[0]
    assert nowhere.ok is None and nowhere.status == "nothing left"
    (before,) = Rocker(L0=0.6).answers([most(y("B")) <= 1.4], over=Over(S=(0.0, 0.38), only=[ref("S") <= 0.2]))
    assert before.ok and before.lost.share == 0.0  # what cannot be assembled is left out as well


# Measures.


def test_measures_of_one_number():
    machine = Loader()
    over = Over(T=0.1)
    work, here, travel, spread = machine.answers(
        [integral(y("D")), at(y("D"), S=0.1, T=0.05), most(distance("A", "B")) - least(distance("A", "B")), fits("lift")], over=over
    )
    fine = machine.sweep(S=4001, T=0.1)
    assert_allclose(work.value, np.trapezoid(fine.y("D"), fine.strokes["S"]) if hasattr(np, "trapezoid") else work.value, rtol=1e-7)
    assert_allclose(here.value, machine.at(S=0.1, T=0.05).y("D"))
    assert_allclose(travel.value, 0.3, atol=1e-12)
    assert spread.ok
    assert str(travel).startswith("300 mm at ") and travel.measures == "length"
    assert " Nm in the case " in str(machine.answers([integral(drive_force("S"), by="S")], over=over)[0])  # a work
    with pytest.raises(DefinitionError, match=r"one stroke that runs, here run S, T; say over=Over\(S=\(\.\.\.\), T=0\.0\)"):
        machine.answers([integral(y("D"))])
    with pytest.raises(DefinitionError, match=r"one stroke that runs, not along a path; say over=Over\(S="):
        machine.answers([integral(y("D"))], over=Over.path(S=[0.0, 0.2], T=0.1))
    with pytest.raises(DefinitionError, match=r"say the pose, T=\.\.\."):
        machine.answers([at(y("D"), S=0.1)])


class Cranks(Mechanism):
    """A crank on a crank, whose farthest places stand between the ends of its strokes and between samples, and a narrow top."""

    phi, psi = Stroke(0.0, 90 * deg), Stroke(0.05, 2 * np.pi + 0.05)
    O, C = Ground(0.0, 0.0), Ground(0.0, 3.0)
    P = Crank(O, OP=1.0, angle=phi)
    Q = Crank(P, PQ=0.7, angle=psi)
    narrow = 1 / (1e-4 + (x("Q") - x("P") - 0.35) ** 2)
    load = Weight(Q, mass=100)
    twice = LoadCase("twice", scale={"load": 2.0})
    turning = Over.path(phi=ramp(0.2, 1.0, speed=0.4, acceleration=1.0), psi=Course([0.0, 3.0], [1.0, 2.0]))


INSIDE = {
    "the box": (Over(), (0.0, 90 * deg), (0.05, 2 * np.pi + 0.05)),
    "a part": (Over(phi=(0.2, 1.1), psi=(100 * deg, 200 * deg)), (0.2, 1.1), (100 * deg, 200 * deg)),
    "held": (Over(psi=0.6), (0.0, 90 * deg), (0.6, 0.6)),
    "left out": (Over(only=[x("Q") <= 1.2]), (0.0, 90 * deg), (0.05, 2 * np.pi + 0.05)),
    "a path": (Over.path(phi=[0.1, 0.5, 1.0], psi=[1.0, 1.5, 1.2]), (0.1, 1.0), (1.0, 1.5)),
    "in time": (Cranks.turning, (0.2, 1.0), (1.0, 2.0)),
    "poses": (Over.poses(phi=[0.0, 0.5, 1.0], psi=[1.0, 1.5, 1.2]), (0.0, 0.5, 1.0), (1.0, 1.2, 1.5)),
}
"""Where it is looked at, and what each stroke runs there."""


@pytest.mark.parametrize("where", INSIDE)
def test_the_worst_over_another_stroke_is_that_of_a_fine_grid_of_where_it_runs(where):
    over, *spans = INSIDE[where]
    machine, counts = Cranks(), (201, 4001)
    values = [np.array(span) if len(span) > 2 else np.linspace(*span, count) for span, count in zip(spans, counts, strict=True)]
    phi, psi = np.meshgrid(*values, indexing="ij")
    at_x, at_y = np.cos(phi) + 0.7 * np.cos(psi), np.sin(phi) + 0.7 * np.sin(psi)
    quantity, grid = distance("Q", "C"), np.hypot(at_x, at_y - 3.0)
    grid = np.where(at_x <= 1.2, grid, np.nan) if over.only else grid
    for by, inner in ((most, np.nanmax), (least, np.nanmin)):
        for measure, outer in ((most, np.nanmax), (least, np.nanmin)):
            found = machine.answers([measure(worst(quantity, over="psi", by=by))], over=over)[0]
            assert_allclose(found.value, outer(inner(grid, axis=1)), atol=1e-3 if over.only else 3e-5, err_msg=f"{found.question}")
            assert str(found).partition(" at ")[0].endswith(" mm"), str(found)
            there = machine.at(**{name: float(value) for name, value in found.strokes.items()})
            assert_allclose(there[quantity], found.value, atol=1e-6)  # it stands where the answer says


def test_the_worst_over_another_stroke_is_looked_for_between_samples_in_all_cases():
    machine, narrow = Cranks(), worst("narrow", over="psi")
    for question in (most(narrow), least(narrow), at(narrow, phi=0.3)):
        assert_allclose(machine.answers([question])[0].value, 1e4, rtol=1e-6)
    assert_allclose(machine.answers([integral(narrow, by="phi")], over=Over())[0].value, 1e4 * np.pi / 2, rtol=1e-6)
    assert machine.answers([most(worst(x("Q"), over="psi")) <= 1.6995], over=Over())[0].ok is False
    moment = machine.answers([most(worst(drive_force("phi"), over="psi"))], over=Over())[0]
    assert_allclose(moment.value, machine.answers([most(drive_force("phi"))], over=Over())[0].value)
    assert moment.case == "twice"
    batch = machine.replaced(OP=np.array([0.9, 1.0])).answers([least(worst(distance("Q", "C"), over="psi"))], over=Over())[0]
    assert_allclose(batch.value, [2.8, 2.7], rtol=1e-9)
    best = optimise(machine, maximise=at("PQ"), subject_to=[least(worst(x("Q"), over="psi")) <= 0.6], vary={"PQ": (0.3, 1.0)}, starts=1)
    assert_allclose(best.value, 0.6, rtol=1e-9)


def test_a_pose_is_asked_of_slow_motion_beside_a_path_in_time():
    machine, force = Cranks(), drive_force("phi")
    here = machine.at(phi=0.3, psi=0.7)[force]
    for over in ({}, {"over": "turning"}, {"over": Over()}):
        assert_allclose(machine.answers([at(force, phi=0.3, psi=0.7, case="plain")], **over)[0].value, here)
    for question, remedy in (
        (at(speed("Q"), phi=0.3, psi=0.7), "give rates= and accelerations= to evaluate, or sweep over a path in time"),
        (integral(speed("Q")), r"goes in time; over time take motion = machine\.sweep\("),
        (most(worst(force, over="psi")), r"known on the path in time alone; take most\(drive_force\(phi\)\) there"),
        (most(worst(speed("Q"), over="psi")), r"known on the path in time alone; take most\(speed\(Q\)\) there"),
    ):
        with pytest.raises(DefinitionError, match=remedy):
            machine.answers([question])


def test_batches_give_arrays_over_their_designs():
    loads = np.array([100.0, 500.0, 3000.0])
    machine = Loader(**{"load.mass": loads})
    answer = machine.answers([least(reserve("lift")) >= 1.0], acting=Acting(case="carry"))[0]
    singles = [Loader(**{"load.mass": each}).answers([least(reserve("lift")) >= 1.0], acting=Acting(case="carry"))[0] for each in loads]
    assert_allclose(answer.value, [each.value for each in singles], rtol=1e-9)
    assert answer.ok.tolist() == [each.ok for each in singles]


# How an Over is written.


def test_overs_of_a_class_replace_the_box_and_are_named():
    class Working(Loader):
        loading = Over.path(S=[0.0, 0.3], T=[0.0, 0.2], cases=("carry",))
        transport = Over(S=0.1, T=0.0)

    machine = Working()
    assert [each.name for each in machine.overs] == ["loading", "transport"] and Loader().overs[0].strokes == {}
    answer = machine.answers([least(reserve("lift"))])[0]
    assert answer.over in ("loading", "transport") and f"over {answer.over}" in str(answer)
    assert any("loading: the path S = 0 to 300 mm, T = 0 to 200 mm" in each and "transport: " in each for each in machine.verdicts()[:1])

    class Without(Working):
        loading = None

    assert [each.name for each in Without().overs] == ["transport"]
    whole = machine.answers([least(reserve("lift"))], over=Over())[0]
    assert whole.value <= answer.value


@for_all(
    ("make", "words"),
    [
        (lambda: Over(S=[0.1, 0.2, 0.3]), "places in an order are Over.path"),
        (lambda: Over(S=True), r"\(low, high\) or one value is expected"),
        (lambda: Over(cases="full"), "a list of load cases is expected"),
        (lambda: Over(lost="maybe"), '"allowed" is expected'),
        (lambda: Over.path(S=[0.0, 0.1], T=[0.1, 0.2, 0.3]), "S has 2, T has 3 values"),
        (lambda: Over.path(S=[0.0, np.nan]), "finite numbers in their order"),
        (lambda: Over(S=x("B") <= 4), "conditions on poses go into a list"),
        (lambda: Loader().answers([least(reserve("lift"))], over=Over(U=0.1)), "Stroke 'U' is unknown"),
        (lambda: Loader().answers([least(reserve("lift"))], over=Over.path(S=[0.0, 0.1])), r"does not say where T stand; give T=\.\.\."),
        (lambda: Loader().answers([least(reserve("lift"))], over=Over(cases=("full",))), "Load case 'full' is unknown"),
        (lambda: Loader().answers([least(reserve("lift"))], over=3), "an Over is expected"),
        (lambda: Loader().answers([y("D")]), "has a value at every pose"),
        (lambda: Loader().answers(least), "a list of questions is expected"),
        (lambda: Loader().answers([most(y("D"))], acting="carry"), "a situation is expected"),
        (lambda: Loader().answers([most(y("D"))], over=Over(S=(0.0, ref("T")))), "depends on the stroke T itself"),
        (lambda: type("M", (Mechanism,), {"only": Stroke(0, 1)}), "a stroke cannot be named only"),
        (lambda: type("M", (Loader,), {"plain": LoadCase("plain")}), "a load case cannot be named plain"),
        (lambda: type("M", (Loader,), {"answers": Dimension(0.1)}), "answers is a word of the framework"),
    ],
)
def test_wrong_uses_are_answered_in_words(make, words):
    with pytest.raises(DefinitionError, match=words):
        make()


def test_an_over_may_follow_the_design():
    class Set(Loader):
        reach = Dimension(0.2)

    machine = Set(reach=0.15)
    answer = machine.answers([most(distance("A", "B"))], over=Over(S=(0.0, ref("reach"))))[0]
    assert_allclose(answer.value, 0.65)
    assert_allclose(answer.strokes["S"], 0.15)


def test_motions_say_where_they_are():
    machine = Loader()
    assert str(machine.at(S=[0.0, 0.1], T=[0.0, 0.2]).over).startswith("Over.path(S=(0.0, 0.1)")
    assert str(machine.sweep(S=3, T=0.1).over) == "Over(S=(0.0, 0.3), T=0.1)"
    assert str(Rocker().sweep(5, unreachable="nan").over) == "Over(S=(0.0, 0.4))"


def test_the_driving_force_goes_by_its_own_direction():
    machine = Rubbing()
    motion = machine.sweep(S=5, T=5)
    asked = drive_force("S", acting=Acting(case="carry", direction="retracting"))
    assert_allclose(motion[asked], driving_force(motion, drive="S", case="carry", direction="retracting"))


def test_a_machine_without_strokes_is_judged_as_it_stands():
    class Frame(Mechanism):
        A, B = Ground(0.0, 0.0), Ground(1.0, 0.0)
        C = Dyad(A, B, AC=0.8, BC=0.7, side=LEFT)
        load = Weight(C, mass=10)

    height, force, whole = Frame().answers([most(y("C")), most(pin_force("C")), reachable])
    assert_allclose([height.value, force.value], [Frame().at().y("C"), np.hypot(*pin_forces(Frame().at()).force("C"))])
    assert whole.ok and Frame().verdicts() == []


# -- what is known again -------------------------------------------------------------------------------------


def answered(machine, questions):
    """Return values and places of the answers of a machine."""
    return [(each.value, each.ok, dict(each.strokes), each.case, each.direction, each.side) for each in machine.answers(questions)]


def test_a_law_is_traced_where_it_is_bound_and_for_its_kernel_and_not_a_third_time(monkeypatch):
    known, trace = [], LawRequest.traced_law
    monkeypatch.setattr(LawRequest, "traced_law", lambda request, motion: known.append(str(request)) or trace(request, motion))
    Loader().answers([least(reserve("lift")) >= 1], over={"T": 0.1}, acting=Acting(case="carrying", direction="extending"))
    assert known and max(map(known.count, known)) <= 2


@first_daily(1, "kind", [Loader, Rubbing])
def test_an_equal_machine_is_not_searched_again(kind, monkeypatch):
    questions = [least(reserve("lift")) >= 1.0, most(pressure("tilt")), reachable]
    first = answered(kind(OB=0.36), questions)
    calls = []
    run = Kernel.__call__
    monkeypatch.setattr(Kernel, "__call__", lambda self, *given, **named: calls.append(self) or run(self, *given, **named))
    assert answered(kind(OB=0.36), questions) == first
    assert len(calls) <= 2
    other = answered(kind(OB=0.37), questions)
    assert len(calls) > 10 and other[0][0] != first[0][0]


@first_daily(1, "kind", [Loader, Rubbing])
def test_an_answer_does_not_hang_on_what_was_asked_before(kind):
    """Another design, other questions beside it; a class of its own has been asked nothing."""
    questions = [least(reserve("lift")) >= 1.0, most(pressure("tilt")), reachable]

    class Afresh(kind):
        pass

    kind(OB=0.37).answers(questions)
    alone = [answered(kind(OB=0.36), [each])[0] for each in questions]
    assert alone == [answered(Afresh(OB=0.36), [each])[0] for each in questions]


def test_functions_of_a_motion_are_asked_again():
    """Nobody knows what else they hang on."""
    level = [1.0]
    question = most(lambda motion: level[0] + 0.0 * motion["B"][0])
    machine = Loader()
    assert machine.answers([question])[0].value == 1.0
    level[0] = 2.0
    assert machine.answers([question])[0].value == 2.0


def test_what_is_reached_is_told_in_words():
    assert str(Loader().answers([reachable], over=Over(S=(0.0, 0.2)))[0]) == "every place is assembled"
    told = str(Loader(OB=0.05).answers([reachable])[0])
    assert "of the places is lost at S = " in told and "cannot be assembled" in told


@pytest.mark.parametrize(
    "question",
    [
        *(most(reserve("lift")) <= limit for limit in (2 * bar, 3 * mm, 1 * kN)),
        *(most(each) <= 3 * mm for each in (ratio(y("C"), wrt="S"), y("C") / y("B"))),
        least(y("C")) >= 3 * deg,
        most(reserve("lift")) * 0.0 + most(pin_force("O")) <= 1 * mm,
        least(angle("O", "C") + y("C")),
    ],
)
def test_what_neither_adds_nor_compares_is_refused(question):
    with pytest.raises(DefinitionError, match=r"neither add nor compare|a plain number does not compare with a"):
        Loader().answers([question])


def test_places_of_a_path_in_another_unit_are_refused():
    """As those of a box are, numbers and quantities alike."""

    class Long(Loader):
        far = Dimension(200.0, unit="m")

    for over in (Over.path(S=[0.0, 200.0], T=0.0), Over.path(S=[0.0, "far"], T=0.0), Over(S=(0.0, "far")), Over.poses(S=[200.0], T=[0.0])):
        with pytest.raises(DefinitionError, match="if these are millimetres"):
            Long().answers([reachable], over=over)


def test_what_is_answered_is_looked_for_once(monkeypatch):
    judge = Loader().judge()
    asked = [lambda: least(distance("O", "D")) >= 0.5, lambda: most(thrust("lift")) <= 80 * kN, lambda: reachable]
    first = judge.answers([each() for each in asked])
    monkeypatch.setattr(type(judge), "candidates", None)  # who judges anew asks for these
    again = [each() for each in asked]
    found = judge.answers(again)
    assert [str(each) for each in found] == [str(each) for each in first]
    assert all(answer.question is question for answer, question in zip(found, again, strict=True))
    monkeypatch.undo()
    other = judge.answer(least(distance("O", "D")) >= 5.0)
    assert first[0].ok and not other.ok  # another limit is another question
