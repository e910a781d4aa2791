"""Synthesis: published tasks by an evaluator of its own, tasks that a known machine does, conditions, and what is no answer."""

import csv
from functools import cache

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import (
    LEFT,
    Crank,
    DefinitionError,
    Dimension,
    Dyad,
    FunctionTask,
    Ground,
    Mechanism,
    OnLink,
    PathTask,
    PoseTask,
    Stroke,
    StudyError,
    around,
    deg,
    distance,
    least,
    mm,
    synthesise,
    transmission,
    y,
)
from linkage.motion.measures import FixedNumber
from linkage.study.problem import Problem
from linkage.study.solver import Local
from linkage.study.space import Space
from linkage.synthesis.fit import Fit, Timing, fit_squares
from mechanisms.classics.four_bar import FourBar
from mechanisms.classics.klann import Klann
from mechanisms.three_point_hitch import ThreePointHitch
from tests.benchmarks import bench_synthesis
from tests.for_all import first_daily, for_all
from tests.linkage.synthesis import synthesis_tasks as papers
from tests.linkage.synthesis.synthesis_tasks import Bar, box, places

SQUARE_MM = mm**2


def runs_by_its_own_circles(machine):
    """Return whether a bar closes at 5,001 angles of a whole turn."""
    return bool(np.isfinite(places(machine, np.linspace(0.0, 2 * np.pi, 5001))).all())


def judged(answer, points):
    """Check an answer by the evaluator of its own, and return its error [mm^2]."""
    assert runs_by_its_own_circles(answer.machine)
    off = places(answer.machine, answer.strokes) - np.transpose(points) * mm
    assert_allclose(np.sum(off**2), answer.error, rtol=1e-6, atol=1e-24)
    assert_allclose(np.hypot(*off).max(), answer.most, rtol=1e-6, atol=1e-12)
    return answer.error / SQUARE_MM


@cache
def eighteen_points():
    return synthesise(Bar(), path=PathTask(np.array(papers.EIGHTEEN) * mm, of="P"), vary=box(50 * mm), timed="steps", starts=16)


def test_eighteen_points_at_equal_steps_are_met_better_than_any_design_read():
    found = eighteen_points()
    assert judged(found.best, papers.EIGHTEEN) <= 0.00902889
    steps = np.diff(np.unwrap(found.best.strokes))
    assert_allclose(np.abs(steps), 20 * deg, atol=1e-12)
    assert np.all(np.sign(steps) == np.sign(steps[0]))
    errors = [judged(each, papers.EIGHTEEN) for each in found.solutions]
    assert errors == sorted(errors) and len(errors) > 5
    assert "all 18 points in order, on one circuit and one branch; least transmission angle" in str(found)


class PolarBar(Mechanism):
    """The bar of the papers in their own variables: the frame's length and angle, the place of its first pivot. Its crank is 1 mm long."""

    phi = Stroke(0.0, 2 * np.pi)
    x0, y0, r1 = Dimension(0.0, unit="mm"), Dimension(0.0, unit="mm"), Dimension(2 * mm, unit="mm")
    theta0 = Dimension(0.0, unit="deg")

    O = Ground(x0, y0)
    C = Crank(O, OC=r1, angle=theta0)

    A = OnLink(O, C, OA=1 * mm, COA=phi)
    B = Dyad(A, C, AB=2 * mm, CB=2.5 * mm, side=LEFT)
    P = OnLink(A, B, AP=1 * mm, BAP=30 * deg)


class PolarFrame(PolarBar):
    """Its first pivot by coordinates, the crank's angle counted from the x axis."""

    O = Ground(0.0, 0.0)
    C = Crank(O, OC=2 * mm, angle="theta0")
    A = Crank(O, OA=1 * mm, angle="phi")


@pytest.mark.slow
@pytest.mark.parametrize("kind", [PolarBar, PolarFrame])
def test_eighteen_points_are_met_where_the_frame_is_a_length_and_an_angle(kind):
    """In the papers' box, 75 times as wide as the machine that is drawn."""
    names = {PolarBar: ("x0", "y0", "r1"), PolarFrame: ("O.x", "O.y", "OC")}[kind]
    vary = {name: ends for name, ends in box(50 * mm).items() if "." not in name} | {"theta0": (-np.pi, np.pi)}
    vary |= dict.fromkeys(names[:2], (-50 * mm, 50 * mm)) | {names[2]: (0.01 * mm, 50 * mm)}
    found = synthesise(kind(), path=PathTask(np.array(papers.EIGHTEEN) * mm, of="P"), vary=vary, timed="steps", starts=4).best
    x, y, far = (found.machine[name] for name in names)
    ends = {"O.x": x, "O.y": y, "C.x": x + far * np.cos(found.machine["theta0"]), "C.y": y + far * np.sin(found.machine["theta0"])}
    bar = Bar(**ends, **{name: found.machine[name] for name in ("OA", "AB", "CB", "AP", "BAP")})
    phi = found.strokes - (found.machine["theta0"] if kind is PolarFrame else 0.0)
    assert runs_by_its_own_circles(bar)
    assert np.sum((places(bar, phi) - np.transpose(papers.EIGHTEEN) * mm) ** 2) <= 0.00902889 * SQUARE_MM


@pytest.mark.slow
def test_five_timed_points():
    task = PathTask(np.array(papers.FIVE) * mm, of="P", at=papers.FIVE_AT)
    found = synthesise(Bar(), path=task, vary=box(50 * mm, held=True))
    assert judged(found.best, papers.FIVE) <= 7.4158e-7
    assert_allclose(found.best.strokes, papers.FIVE_AT, atol=1e-15)


@pytest.mark.slow
@pytest.mark.parametrize(("name", "error"), [("P1", 1e-20), ("P4", 2.58037), ("P5", 4.02e-4), ("P6", 7.61e-5), ("P7", 0.0387)])
def test_published_tasks(name, error):
    found, _ = bench_synthesis.solved(name)
    assert judged(found.best, bench_synthesis.TASKS[name][0]) <= error
    order = np.unwrap(found.best.strokes)
    assert np.all(np.diff(order) * np.sign(order[-1] - order[0]) >= -1e-8)


@for_all("kind", ["path", "function", "poses"])
@for_all("timed", [True, False])
def test_derivatives_are_those_of_the_misses(kind, timed):
    """Central differences, by dimensions and by the points' own strokes."""
    bar, at = FourBar(), np.array([0.4, 1.0, 1.9, 3.0])
    pose = bar.at(phi=at)
    task = {
        "path": PathTask(pose["P"].T, of="P"),
        "function": FunctionTask(at, pose["psi"], of="psi"),
        "poses": PoseTask(*pose["A"], pose.angle("A", "B"), of="A B"),
    }[kind]
    space = Space.of(bar, {"OA": (0.03, 0.05), "C": around(20 * mm), "BAP": (0.2, 0.8), "AB": (0.1, 0.14)})
    problem = Problem(bar, [FixedNumber(0.0)], [], space)
    fit = Fit(problem, task.rows(bar), Timing.of(problem, "phi", timed, 4), (), at)
    random = np.random.default_rng(3)
    unit = random.uniform(0.2, 0.8, (5, fit.n + fit.width))
    base = np.tile(at if timed else np.zeros(4), (5, 1))
    found, step = fit.slopes(unit, base), 1e-6
    for place in range(unit.shape[1]):
        moved = np.eye(unit.shape[1])[place] * step
        change = (fit.misses(unit + moved, base) - fit.misses(unit - moved, base)) / (2 * step)
        assert_allclose(found[:, :, place], change, rtol=0, atol=1e-6 * np.abs(found).max())
    assert np.abs(found).max() > 0.0


def test_strokes_are_polished_of_a_design_without_variables():
    """Choices alone: the points' own strokes are still to miss least, in order, among conditions."""
    bar, at = FourBar(), np.array([0.4, 1.0, 1.9, 3.0])
    space = Space.of(bar, {"OA": [0.04, 0.05]})
    problem = Problem(bar, [FixedNumber(0.0)], [], space)
    rows = PathTask(bar.at(phi=at)["P"].T, of="P").rows(bar)
    fit, base = Fit(problem, rows, Timing.of(problem, "phi", False, 4), (0,)), np.zeros(4)
    start = fit.timing.unknowns_at(at + np.array([0.1, -0.1, 0.05, 0.0]))
    local = Local(problem, (0,), start[: fit.n], squares=fit_squares(fit, start, base, in_order=True))
    end = local.run()
    assert fit.n == 0 and end.is_assembled
    assert_allclose(fit.misses(local.own[None], base[None]), 0.0, rtol=0, atol=1e-9)


def test_a_known_bar_is_found_again_from_its_untimed_path():
    known = FourBar(OA=0.036, AB=0.11, CB=0.085, AP=0.05)
    points = known.at(phi=np.linspace(0.3, 5.5, 14))["P"].T
    vary = {"OA": (0.01, 0.08), "AB": (0.05, 0.2), "CB": (0.05, 0.2), "AP": (0.01, 0.12), "BAP": (-1.5, 1.5), "C": around(30 * mm)}
    found = synthesise(FourBar(), path=PathTask(points, of="P"), vary=vary, timed=False, starts=16)
    assert found.best.most <= 1e-9
    assert_allclose(found.machine.at(phi=found.best.strokes)["P"].T, points, rtol=0, atol=2e-9)
    found.machine.sweep(721)


@pytest.mark.slow
def test_a_known_hitch_is_found_again_along_its_stroke():
    known = ThreePointHitch(MK=0.83, CD=0.60, OB=0.31)
    strokes = np.linspace(0.0, 0.25, 6)
    vary = {"MK": (0.75, 1.0), "CD": (0.55, 0.65), "OB": (0.28, 0.33)}
    poses = known.at(S=strokes)
    for task in (
        dict(path=PathTask(poses["G"].T, of="G", at=strokes)),
        dict(path=PathTask(poses["G"].T, of="G")),
        dict(motion=PoseTask(*poses["F"], poses.angle("F", "K"), of="F K", at=strokes)),
    ):
        found = synthesise(ThreePointHitch(), vary=vary, starts=4, **task)
        assert found.best.most <= 1e-9
        timed = next(iter(task.values())).at is not None
        for name, value in (("MK", 0.83), ("CD", 0.60), ("OB", 0.31)) if timed else ():
            assert_allclose(found.machine[name], value, rtol=0, atol=1e-8)
            assert_allclose(found.best.strokes, strokes, rtol=0, atol=1e-8)


def test_a_function_is_that_of_freudenstein():
    """Three pairs of angles: K1 cos(psi) - K2 cos(phi) + K3 = cos(phi - psi) is linear in three ratios."""
    phi = np.array([30, 70, 120]) * deg
    psi = FourBar(OA=0.035, AB=0.11, CB=0.07).at(phi=phi)["psi"] + np.array([0.02, -0.01, 0.015])
    table = np.stack([np.cos(psi), -np.cos(phi), np.ones(3)], axis=1)
    K1, K2, K3 = np.linalg.solve(table, np.cos(phi - psi))
    a, c = 0.1 / K1, 0.1 / K2
    b = np.sqrt(a**2 + c**2 + 0.1**2 - 2.0 * a * c * K3)
    assert min(a, b, c) > 0.0
    vary = {name: (0.3 * size, 3.0 * size) for name, size in (("OA", a), ("AB", b), ("CB", c))}
    found = synthesise(FourBar(), function=FunctionTask(phi, psi, of="psi"), vary=vary, over={"phi": (30 * deg, 120 * deg)})
    exact = [each for each in found.solutions if each.most <= 1e-11]
    assert exact
    assert min(np.abs([each.machine["OA"] - a, each.machine["AB"] - b, each.machine["CB"] - c]).max() for each in exact) <= 1e-10


@pytest.mark.slow
def test_conditions_are_kept_and_cost_something():
    task = PathTask(np.array(papers.EIGHTEEN) * mm, of="P")
    held = [least(transmission("B")) >= 35 * deg, least(distance("O", "C")) <= 1.2 * mm]
    found = synthesise(Bar(), path=task, vary=box(50 * mm), timed="steps", subject_to=held, starts=16)
    assert 0.00902889 * SQUARE_MM < found.best.error <= 0.0092415 * SQUARE_MM
    for each in found.solutions:
        judged(each, papers.EIGHTEEN)
        turn = each.machine.sweep(721)
        sines = np.sin(turn.transmission_angle("B"))
        assert sines.min() >= np.sin(35 * deg) - 1e-7
        assert float(turn.distance("O", "C")[0]) <= 1.2 * mm * (1 + 1e-6)


def test_the_same_seed_gives_the_same_bits():
    task = PathTask(np.array(papers.FIVE) * mm, of="P", at=papers.FIVE_AT)
    one, two = (synthesise(Bar(), path=task, vary=box(50 * mm, held=True), seed=4, starts=4) for _ in range(2))
    assert [each.error for each in one.solutions] == [each.error for each in two.solutions]
    assert [dict(each.machine.dimensions) for each in one.solutions] == [dict(each.machine.dimensions) for each in two.solutions]
    assert one.solutions or one.misses


def test_what_cannot_run_is_no_answer():
    """A triple rocker: no length in the box lets anything turn fully."""
    vary = {"OA": (0.058, 0.062), "AB": (0.058, 0.062), "CB": (0.068, 0.072), "BAP": (-1.0, 1.0)}
    points = [(0.03, 0.06), (0.02, 0.07), (0.01, 0.075)]
    found = synthesise(FourBar(), path=PathTask(points, of="P"), vary=vary, starts=8)
    assert not found.solutions and not np.isfinite(found.error)
    assert found.misses and all("cannot be assembled between phi" in each.why for each in found.misses)
    assert "no machine that runs was found" in str(found)
    assert found.machines == ()
    with pytest.raises(StudyError, match="no machine that runs"):
        found.machine  # noqa: B018


def test_what_reaches_no_point_is_told():
    vary = {"OA": (0.5, 0.6), "AB": (0.01, 0.02), "CB": (0.01, 0.02)}
    found = synthesise(FourBar(OA=0.5, AB=0.01, CB=0.01), path=PathTask([(0.03, 0.06)], of="P"), vary=vary)
    assert not found.solutions and not found.misses and found.running == found.starts == 0
    assert "no machine that runs was found" in str(found)


def test_dimensions_at_an_end_of_the_box_are_named():
    points = FourBar(OA=0.04, AP=0.05).at(phi=np.linspace(0.3, 3.5, 6))["P"].T
    task = PathTask(points, of="P", at=np.linspace(0.3, 3.5, 6))
    short = synthesise(FourBar(), path=task, vary={"OA": (0.02, 0.038), "AP": (0.03, 0.06)}, starts=4)
    assert short.best.sentence.endswith("OA = 38 mm is at its end of the box.")
    both = synthesise(FourBar(), path=task, vary={"OA": (0.02, 0.038), "AP": (0.03, 0.04)}, starts=4)
    assert both.best.sentence.endswith("OA = 38 mm, AP = 40 mm are at their ends of the box.")


def test_a_table_and_a_drawing(tmp_path):
    found = eighteen_points()
    found.csv(tmp_path / "answers.csv")
    with open(tmp_path / "answers.csv", newline="", encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    assert len(rows) == len(found.solutions)
    assert float(rows[0]["error"]) == found.error and float(rows[0]["rms, mm"]) == found.best.rms / mm
    assert_allclose([float(rows[0][f"phi {k}, deg"]) for k in (1, 18)], found.best.strokes[[0, -1]] / deg)
    coarse = found.rounded(0.1 * mm, 1 * deg)
    assert coarse.error > found.error
    for name in ("OA", "AB", "CB"):
        assert abs(coarse.machine[name] / (0.1 * mm) - round(coarse.machine[name] / (0.1 * mm))) < 1e-6
    assert runs_by_its_own_circles(coarse.machine)
    assert "unrounded" in str(coarse)


@for_all(
    ("given", "words"),
    [
        ({}, "say one task"),
        ({"path": PathTask([(0, 1)], of="P"), "function": FunctionTask([0.1], [0.2], of="psi")}, "say one task"),
        ({"path": [(0, 1)]}, "a PathTask"),
        ({"path": PathTask([(0, 1)], of="X")}, "a point that moves is expected"),
        ({"path": PathTask([(0, 1)], of="P"), "timed": True}, "have no strokes"),
        ({"path": PathTask([(0, 1)], of="P"), "timed": "step"}, "is expected"),
        ({"path": PathTask([(0, 1)], of="P"), "rank": "OA"}, "one number of a design"),
        ({"function": FunctionTask([0.1], [0.2], of="psi"), "timed": False}, "leave it out"),
        ({"function": FunctionTask([30, 50, 70], [1, 1.2, 1.4], of="psi")}, r"strokes of phi: 30 is an angle in radians.*write 30 \* deg"),
        ({"path": PathTask(np.array([(30, 60), (15, 70)]) * mm, of="P", at=[30, 60])}, "strokes of phi: 30 is an angle in radians"),
        ({"function": FunctionTask([0.5, 1, 1.5], [60, 70, 80], of=y("P"))}, r"lengths as far as 80 m .* \* mm if these are millimetres"),
        ({"function": FunctionTask([0.1], [0.2], of=distance("O", "C"))}, r"distance\(O, C\) does not move with phi"),
        ({"motion": PoseTask([0.1], [0.2], [0.3], of="A O")}, "of='O': a point that moves is expected"),
        ({"path": PathTask([(0, 1)], of="P"), "over": {"phi": 0.3}}, "holds all of them; leave one of phi out"),
    ],
)
def test_what_cannot_be_asked_is_said(given, words):
    with pytest.raises(DefinitionError, match=words):
        synthesise(FourBar(), vary={"OA": (0.03, 0.05)}, **given)


@for_all(
    ("make", "words"),
    [
        (lambda: PathTask([1.0, 2.0], of="P"), "pairs"),
        (lambda: PathTask([(0.0, 1.0), (0.0, np.nan)], of="P"), "finite .* number 2 is not finite"),
        (lambda: PathTask(np.zeros((2, 5)), of="P"), r"these have shape \(2, 5\), write np.transpose\(points\)"),
        (lambda: PathTask((0.1, 0.2), of="P"), r"write a single one as \[\(0.1, 0.2\)\]"),
        (lambda: FunctionTask(None, [0.2], of="psi"), "strokes=None"),
        (lambda: PathTask([(0, 1), (0, 2)], of="P", at=[0.1]), "1 strokes for 2 points"),
        (lambda: PoseTask([0], [1], [1, 2], of="A B"), "one length"),
        (lambda: PoseTask([0], [1], [1], of="A"), "two points"),
        (lambda: PathTask([(0, 1), (0, 2)], of="P", in_order="no"), "in_order='no': True or False is expected"),
        (lambda: PathTask([(0, 1), (0, 2), (1, 2)], of="P", closed=1), "closed=1: True or False is expected"),
        (lambda: PoseTask([0, 0], [1, 1], [30, 1], of="A B"), "30 is an angle in radians"),
        (lambda: FunctionTask([0.1, 0.2], [30, 45], of="psi").rows(FourBar()), "30 is an angle in radians"),
        (lambda: FunctionTask([0.1, 0.2], [0.2], of="psi"), "2 strokes for 1 points"),
    ],
)
def test_a_task_that_is_none_is_refused(make, words):
    with pytest.raises(DefinitionError, match=words):
        make()


def test_poses_are_of_one_body_whose_length_is_known():
    klann = Klann()
    with pytest.raises(DefinitionError, match="B and H are not of one body; the bodies that move are O A, M B, A B K, N H, K H F"):
        synthesise(klann, motion=PoseTask([1.0], [1.0], [0.1], of="B H"), vary={"OA": (0.3, 0.5)})
    with pytest.raises(DefinitionError, match=r"the distance of A and P is unknown .* say PoseTask\(..., length=...\)"):
        PoseTask([0.0], [0.0], [0.0], of="A P").rows(FourBar(CB=0.01))


def bar_task(count, **task):
    """Return a synthesis of a known bar from some points of its path, each given once or twice."""
    points = FourBar(OA=0.036, AB=0.11, CB=0.085, AP=0.05).at(phi=np.linspace(0.3, 3.5, count))["P"].T
    vary = {"OA": (0.01, 0.08), "AB": (0.05, 0.2), "CB": (0.05, 0.2), "AP": (0.01, 0.12), "BAP": (-1.5, 1.5), "C": around(30 * mm)}
    path = PathTask(np.repeat(points, task.pop("each", 1), axis=0) * task.pop("unit", 1.0), of="P")
    return synthesise(FourBar(), path=path, vary=vary, starts=4, **task)


@for_all(("count", "each"), (), slow=[(5, 2), (1, 1), (1, 3), (2, 1)])
def test_few_points_and_points_given_twice(count, each):
    found = bar_task(count, each=each)
    assert found.best.most <= 1e-10
    assert np.ptp(found.best.strokes.reshape(count, each), axis=1).max() <= 1e-6


def test_one_point_at_equal_steps():
    assert bar_task(1, timed="steps").best.most <= 1e-10


def test_millimetres_for_metres_are_said():
    with pytest.raises(DefinitionError, match=r"lengths as far as .* write np.array\(...\) \* mm"):
        bar_task(4, unit=1e3)


def test_a_point_that_is_timed_outside_the_stroke_is_said():
    task = PathTask([(0.5, 0.5), (0.6, 0.5)], of="G", at=[0.1, 0.4])
    with pytest.raises(DefinitionError, match="point 2 is timed at S = 400 mm, outside the stroke from 0 mm to 250 mm"):
        synthesise(ThreePointHitch(), path=task, vary={"MK": (0.75, 1.0)})
    phi = np.array([0.5, 1.0])
    task = PathTask(FourBar(OA=0.03).at(phi=phi)["P"].T, of="P", at=phi + 4 * np.pi)  # a crank goes round
    assert synthesise(FourBar(), path=task, vary={"OA": (0.02, 0.05)}, starts=4).best.most <= 1e-12
    with pytest.raises(DefinitionError, match="outside the stroke from"):
        synthesise(FourBar(), path=task, vary={"OA": (0.02, 0.05)}, over={"phi": (0.7, 2.0)})


@for_all("turns", [2], slow=[0, -3])
def test_angles_count_modulo_a_turn(turns):
    phi, known = np.array([0.5, 1.0, 1.5]), FourBar(OA=0.03)
    pose = known.at(phi=phi)
    function = FunctionTask(phi, pose["psi"] + turns * 2 * np.pi, of="psi")
    motion = PoseTask(*pose["A"], pose.angle("A", "B") + turns * 2 * np.pi, of="A B", at=phi)
    for task in ({"function": function}, {"motion": motion}):
        found = synthesise(FourBar(), vary={"OA": (0.01, 0.06), "CB": (0.05, 0.12)}, starts=6, **task)
        assert_allclose([found.machine["OA"], found.machine["CB"]], [0.03, 0.08], rtol=0, atol=1e-9)


def test_a_dimension_that_moves_nothing_makes_no_other_machine():
    phi = np.array([0.5, 1.0, 1.5])
    function = FunctionTask(phi, FourBar(OA=0.03).at(phi=phi)["psi"], of="psi")
    found = synthesise(FourBar(), function=function, vary={"OA": (0.01, 0.06), "AP": (0.01, 0.1)}, starts=6)
    assert len(found.solutions) == 1
    assert_allclose(found.machine["OA"], 0.03, rtol=0, atol=1e-9)


@first_daily(0, "values", [[0.030, 0.036, 0.040], (0.030, 0.040, 0.002)])
def test_choices_and_steps_hold_the_known_bar(values):
    points = FourBar(OA=0.036, AB=0.11).at(phi=np.linspace(0.3, 3.5, 8))["P"].T
    found = synthesise(FourBar(), path=PathTask(points, of="P"), vary={"OA": values, "AB": (0.08, 0.14)}, starts=2)
    assert found.best.most <= 1e-10 and abs(found.machine["OA"] - 0.036) <= 1e-12


@for_all("limit", (), slow=[500, 2000])
def test_a_limit_counts_designs(limit):
    known = FourBar(OA=0.036, AB=0.11, CB=0.085, AP=0.05)
    points = known.at(phi=np.linspace(0.3, 5.7, 10))["P"].T
    vary = {"OA": (0.02, 0.06), "AB": (0.05, 0.2), "CB": (0.05, 0.2), "AP": (0.02, 0.1), "O": around(50 * mm), "C": around(50 * mm)}
    found = synthesise(FourBar(), path=PathTask(points, of="P"), vary=vary, limit=limit)
    assert found.limit == limit and limit <= found.evaluations <= limit + 400
    assert f"The limit of {limit} designs was reached" in found.sentence
