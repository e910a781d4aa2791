"""What is no answer, and why: order, circuit, branch and what cannot be assembled, told in words; angles that wrap and closed curves."""

import re
from math import pi

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import FunctionTask, PathTask, PoseTask, Stroke, deg, mm, synthesise
from linkage.motion.measures import FixedNumber
from linkage.study.problem import Problem
from linkage.study.space import Space
from linkage.synthesis.defects import connected_parts, in_order, lost_stretches, point_ranges, points_on_circuits
from linkage.synthesis.fit import Fit, Timing
from mechanisms.classics.four_bar import FourBar
from tests.for_all import for_all
from tests.linkage.synthesis.known_machines import runs, task_without_answer
from tests.linkage.synthesis.synthesis_tasks import Bar, OtherBar, places

TURN = 2.0 * np.pi


def near(machine, part=1e-4):
    """Return ranges about a machine's own lengths."""
    return {name: (machine[name] * (1 - part), machine[name] * (1 + part)) for name in ("OA", "AB", "CB", "AP")}


@pytest.mark.slow
def test_points_in_another_order_are_told_with_the_order():
    known = Bar()
    at = np.array([0.5, 1.5, 2.5, 3.5, 4.5, 5.5])
    order = [0, 1, 3, 2, 4, 5]
    task = PathTask(places(known, at[order]).T, of="P")
    found = synthesise(known, path=task, vary=near(known), starts=4)
    assert any("it comes to the points in the order 1-2, 4, 3, 5-6" in each.why for each in found.misses)
    for each in found.solutions:
        assert each.most > 1 * mm and "in order, on one circuit" in each.sentence
    free = synthesise(known, path=PathTask(task.points, of="P", in_order=False), vary=near(known), starts=4)
    assert free.best.most <= 1e-9 and "in the order 1-2, 4, 3, 5-6" in free.best.sentence


def test_points_on_two_circuits_are_told():
    """A double rocker: the crank swings within two ranges, one above and one below the frame, that no motion joins."""
    known = Bar(OA=0.060, AB=0.020, CB=0.050, **{"C.x": 0.080})
    turn = np.linspace(0.0, TURN, 720, endpoint=False)
    runs = np.isfinite(places(known, turn)[0])
    number = connected_parts(runs, closed=True)
    groups = [turn[runs & (number == each)] for each in np.unique(number[runs])]
    assert len(groups) == 2
    at = np.concatenate([groups[0][[10, 30, 50, 70]], groups[1][[10, 20, 40, 60, 70]]])
    task = PathTask(places(known, at).T, of="P", at=at)
    found = synthesise(known, path=task, vary=near(known))
    assert not found.solutions
    assert "points 1-4 lie on the one circuit, 5-9 on the other" in found.misses[0].why
    told = [tuple(map(float, each)) for each in re.findall(r"phi = ([\d.]+) deg and ([\d.]+) deg", found.misses[0].why)]
    gaps = np.array(lost_stretches(runs, closed=True)) * 0.5
    assert_allclose(sorted(told), sorted(map(tuple, gaps)), rtol=0, atol=1.0)


def test_one_point_lies_and_several_lie():
    assert points_on_circuits([[1], [2, 3, 4]]) == "point 1 lies on the one circuit, 2-4 on the other"
    assert points_on_circuits([[1, 3], [2], [4]]) == "points 1, 3 lie on circuit 1, point 2 lies on circuit 2, point 4 lies on circuit 3"


def test_points_on_two_branches_are_told():
    known, other = Bar(), OtherBar()
    at = np.linspace(0.3, 5.5, 9)
    points = np.concatenate([places(known, at[:5]).T, places(other, at[5:]).T])
    timed = synthesise(known, path=PathTask(points, of="P", at=at), vary=near(known), starts=4)
    assert "points 6-9 lie on the other branch, B.side = RIGHT" in timed.best.sentence
    untimed = synthesise(known, path=PathTask(points, of="P", in_order=False), vary=near(known), starts=4)
    assert "lie on the other branch, B.side = RIGHT" in untimed.best.sentence
    whole = synthesise(known, path=PathTask(places(known, at).T, of="P", at=at), vary=near(known), starts=4)
    assert "branch, B.side" not in whole.best.sentence


def test_a_part_of_the_turn_that_cannot_be_assembled_is_told():
    """A triple rocker; the gap goes over the end of the turn."""
    known = Bar(OA=0.040, AB=0.030, CB=0.035, **{"C.x": 0.050})
    turn = np.linspace(0.0, TURN, 721, endpoint=False)
    runs = np.isfinite(places(known, turn)[0])
    assert 0 < runs.sum() < 721
    at = turn[runs][[40, 80, 120, 160]]
    found = synthesise(known, path=PathTask(places(known, at).T, of="P", at=at), vary=near(known))
    assert not found.solutions and "points" not in found.misses[0].why
    low, high = map(float, re.search(r"between phi = ([\d.]+) deg and ([\d.]+) deg", found.misses[0].why).groups())
    gaps = lost_stretches(runs, closed=True)
    assert len(gaps) == 1
    assert_allclose([low, high], np.array(gaps[0]) * 360 / 721, rtol=0, atol=0.6)


@pytest.mark.parametrize("closed", [True, False])
def test_gaps_and_parts_of_masks(closed):
    mask = np.array([0, 1, 1, 0, 0, 1, 0, 0], bool)
    assert lost_stretches(mask, closed=closed) == ([(3, 4), (6, 0)] if closed else [(0, 0), (3, 4), (6, 7)])
    assert lost_stretches(~mask, closed=closed) == [(1, 2), (5, 5)]
    assert len(np.unique(connected_parts(~mask, closed=closed)[~mask])) == (2 if closed else 3)
    assert point_ranges([1, 2, 3, 5, 7, 8]) == "1-3, 5, 7-8"


@pytest.mark.slow
def test_an_answer_near_a_change_point_says_how_near():
    """Parallelogram lengths but for a few hundredths of a millimetre."""
    known = FourBar(OA=0.040, AB=0.10002, CB=0.03999 + 0.00004)
    at = np.linspace(0.4, 5.9, 8)
    pose = known.at(phi=at)
    found = synthesise(known, path=PathTask(pose["P"].T, of="P", at=at), vary={"AP": (0.03, 0.09), "BAP": (0.1, 1.0)})
    assert found.best.most <= 1e-9
    (bar,) = known.four_bars
    lengths = sorted(bar.lengths)
    assert_allclose(bar.margin, lengths[1] + lengths[2] - lengths[0] - lengths[3], rtol=0, atol=1e-15)
    words = found.best.sentence
    told = re.search(r"its Grashof margin is ([-\d.]+) mm", words)
    assert told and abs(float(told[1]) * mm - bar.margin) <= 1e-3 * abs(bar.margin) + 1e-9
    if found.best.transmission < 1 * deg:
        assert re.search(r"it passes within [\d.]+ deg of a change point", words)
    far = synthesise(FourBar(), path=PathTask(FourBar().at(phi=at)["P"].T, of="P", at=at), vary={"AP": (0.03, 0.09)})
    assert "margin" not in far.best.sentence and "change point" not in far.best.sentence


@pytest.mark.slow
@pytest.mark.parametrize("timed", [pytest.param(False, marks=pytest.mark.slow), "steps"])
def test_a_closed_curve_of_which_the_last_point_is_the_first(timed):
    known = FourBar(OA=0.036, AB=0.11, CB=0.085, AP=0.05)
    turn = np.linspace(0.8, 0.8 + TURN, 13)
    points = np.array(known.at(phi=turn)["P"].T)
    points[-1] = points[0]
    if timed == "steps":
        points = points[:-1]
    vary = {"OA": (0.02, 0.06), "AB": (0.08, 0.15), "CB": (0.06, 0.12), "AP": (0.03, 0.08), "BAP": (0.1, 1.0)}
    found = synthesise(FourBar(), path=PathTask(points, of="P"), vary=vary, timed=timed, starts=24)
    assert found.best.most <= 1e-9
    steps = np.abs(np.diff(np.unwrap(found.best.strokes)))
    assert_allclose(steps, 30 * deg, rtol=0, atol=1e-6)


class FromBehind(FourBar):
    """Its crank turns from -180 to 180 degrees."""

    phi = Stroke(-pi, pi)


class FromAThird(FourBar):
    """Its turn begins at 60 degrees."""

    phi = Stroke(pi / 3, pi / 3 + TURN)


class Backward(FourBar):
    """Its crank turns clockwise."""

    phi = Stroke(TURN, 0.0)


TURNING = (FourBar, FromBehind, FromAThird, Backward)
LENGTHS = {"OA": (0.015, 0.06), "AB": (0.05, 0.18), "CB": (0.05, 0.18), "AP": (0.01, 0.12), "BAP": (-pi, pi)}


def known_bar(kind, random):
    """Return a random bar whose crank turns fully, by Grashof's rule with a margin."""
    while True:
        found = {name: random.uniform(0.02, 0.05) if name == "OA" else random.uniform(*ends) for name, ends in LENGTHS.items()}
        sides = sorted([found["OA"], found["AB"], found["CB"], 0.1])
        if sides[0] == found["OA"] and sides[0] + sides[3] < sides[1] + sides[2] - 0.004:
            return kind(**found)


def turn_of(machine, count):
    """Return crank angles at equal steps of a machine's turn, the first one where it begins, shape (count,)."""
    stroke = machine.plan.strokes["phi"]
    return stroke.start + (stroke.end - stroke.start) * np.arange(count) / count


def check_in_order(machine, strokes):
    """Check that strokes lie within a machine's own and go round once, one way; those from its beginning do not go over its end."""
    stroke = machine.plan.strokes["phi"]
    low, high = sorted((stroke.start, stroke.end))
    assert low <= strokes.min() and strokes.max() <= high
    steps = np.diff(np.unwrap(strokes))
    assert (steps > 0.0).all() or (steps < 0.0).all()
    assert abs(steps.sum()) <= TURN * (1 + 1e-9)


@pytest.mark.parametrize("seeds", [(4,), pytest.param(range(48), marks=pytest.mark.slow)], ids=["some", "all"])
def test_a_closed_curve_from_the_seam_of_the_turn_is_found_in_order(seeds):
    """In whatever sense, from whichever point on, with the first point once or again at the end."""
    for seed in seeds:
        random = np.random.default_rng(seed)
        known = known_bar(TURNING[seed % 4], random)
        points = np.array(known.at(phi=turn_of(known, int(random.integers(6, 16))))["P"].T)
        if seed % 2:
            points = points[::-1]
        points = np.roll(points, (0, 1, int(random.integers(len(points))))[seed % 3], axis=0)
        again = bool(random.integers(2))
        task = PathTask(np.concatenate([points, points[:1]]) if again else points, of="P", closed=None if again else True)
        found = synthesise(type(known)(), path=task, vary=LENGTHS, starts=16, seed=seed)
        assert found.best.most <= 1e-9, (seed, str(found))
        check_in_order(found.machine, found.best.strokes)
        assert "points in order, on one circuit" in found.best.sentence, seed


def test_strokes_that_differ_by_whole_turns_or_rounding_are_in_one_order():
    """An exact design's own unknowns, each moved by whole turns; two of them exchanged are no order."""
    for seed in range(40):
        random = np.random.default_rng(seed)
        known, count = known_bar(TURNING[seed % 4], random), int(random.integers(4, 14))
        at = turn_of(known, count)
        at = np.roll(at[:: 1 if seed % 3 else -1], int(random.integers(count)))
        at = np.append(at, at[0]) if seed % 2 else np.repeat(at, 2)
        space = Space.of(known, LENGTHS)
        problem = Problem(known, [FixedNumber(0.0)], [], space)
        rows = PathTask(known.at(phi=at)["P"].T, of="P").rows(known)
        fit = Fit(problem, rows, Timing.of(problem, "phi", False, len(at)))
        noise = 1e-11 * random.standard_normal(len(at))
        moved = at + noise + TURN * random.integers(-1, 2, len(at))
        unit, base = space.unit(space.present(known)), np.zeros((1, len(at)))
        start = np.concatenate([unit, fit.timing.unknowns_at(moved)])[None]
        ordered = fit.put_in_order(start, base)
        assert_allclose(fit.misses(ordered, base), 0.0, rtol=0, atol=1e-10)
        assert in_order(fit, ordered[0], base[0]), seed
        strokes = fit.timing.within(fit.timing.strokes(base, ordered[:, fit.n :])[0])
        assert_allclose(np.exp(1j * strokes), np.exp(1j * at), rtol=0, atol=1e-9)
        own = np.array(ordered[0])
        own[fit.n + 1], own[fit.n + 2] = own[fit.n + 2], own[fit.n + 1]
        assert not in_order(fit, own, base[0]), seed


@pytest.mark.slow
def test_timed_points_functions_and_poses_over_the_seam():
    """In order, whatever the way round and wherever the turn begins; at equal steps the first point may stand again at the end."""
    for place, kind in enumerate(TURNING):
        known = kind(OA=0.036, CB=0.085)
        round_once = np.append(turn_of(known, 8), known.plan.strokes["phi"].end)
        ways = [round_once, round_once[::-1], np.roll(round_once[:-1], 3), np.roll(round_once[:-1], 3)[::-1]]
        at, steps = (ways[(place + k) % 4] for k in (0, 1))
        pose, stepped = known.at(phi=at), known.at(phi=steps)
        for task, strokes in (
            ({"path": PathTask(pose["P"].T, of="P", at=at)}, at),
            ({"function": FunctionTask(at, pose["psi"], of="psi")}, at),
            ({"motion": PoseTask(*pose["A"], pose.angle("A", "B"), of="A B", at=at)}, at),
            ({"motion": PoseTask(*stepped["A"], stepped.angle("A", "B"), of="A B"), "timed": "steps"}, steps),
            ({"path": PathTask(stepped["P"].T, of="P"), "timed": "steps"}, steps),
        ):
            found = synthesise(kind(), vary={"OA": (0.03, 0.04), "CB": (0.08, 0.09)}, starts=2, limit=500, **task)
            assert found.best.most <= 1e-9, (kind, task)
            assert "points in order, on one circuit" in found.best.sentence
            assert_allclose(np.exp(1j * found.best.strokes), np.exp(1j * strokes), rtol=0, atol=1e-6)
            check_in_order(found.machine, found.best.strokes)


@for_all("turns", [1], slow=[0, -2])
def test_angles_wrap_between_designs(turns):
    """The same poses with angles that are whole turns more, and designs whose own angle lies on the other side of 180 degrees."""
    known = FourBar(AP=0.06)
    at = np.linspace(0.3, 5.9, 7)
    pose = known.at(phi=at)
    wrapped = np.mod(pose.angle("B", "A") + np.pi, TURN) - np.pi + turns * TURN
    task = PoseTask(*pose["B"], wrapped, of="B A", at=at)
    vary = {"OA": (0.02, 0.06), "AB": (0.08, 0.15), "CB": (0.06, 0.12)}
    found = synthesise(FourBar(), motion=task, vary=vary, starts=16)
    assert found.best.most <= 1e-9 and abs(found.machine["AB"] - known["AB"]) <= 1e-8
    function = FunctionTask(at, np.mod(known.at(phi=at)["psi"], TURN) + turns * TURN, of="psi")
    again = synthesise(FourBar(), function=function, vary={"OA": (0.02, 0.06), "AB": (0.08, 0.15)}, starts=16)
    assert again.best.most <= 1e-9


@pytest.mark.parametrize("seeds", [(1,), pytest.param(range(40), marks=pytest.mark.slow)], ids=["some", "all"])
def test_tasks_without_an_answer_say_so(seeds):
    """Of seven classes, timed, untimed, closed, functions and poses; each machine of the box fails by the triangle's inequality."""
    for seed in seeds:
        stuck = task_without_answer(seed)
        assert stuck.short > 0.0 and not runs(stuck.known, stuck.machine)
        found = stuck.found(starts=8)
        assert not found.solutions and not np.isfinite(found.error)
        assert "no machine that runs was found" in str(found) and found.misses
        for each in found.misses:
            told = re.search(r"cannot be assembled between \w+ = (-?[\d.]+) (\w+) and (-?[\d.]+) ", each.why)
            middle = (float(told[1]) + float(told[3])) / 2 + (180 if float(told[1]) > float(told[3]) else 0)
            with np.errstate(invalid="ignore"):
                assert np.isnan(stuck.known.places(each.machine, np.array([middle * {"deg": deg, "mm": mm}[told[2]]]))).all()


@pytest.mark.parametrize(("short", "runs_over"), [(1e-9, False), (1e-11, False), (-1e-9, True)])
def test_a_gap_between_the_poses_that_are_looked_at_is_found(short, runs_over):
    """The crank passes a gap of a hundredth of a degree and less, where it points away from the far pivot, at no whole step of the turn."""
    far = 0.1 * np.exp(0.0123j)
    known = FourBar(OA=0.06, AB=0.09, CB=0.07 - short, **{"C.x": far.real, "C.y": far.imag})
    at = np.linspace(0.3, 2.9, 6)
    found = synthesise(known, path=PathTask(known.at(phi=at)["P"].T, of="P", at=at), vary={"AP": (0.06, 0.08)}, starts=2)
    assert bool(found.solutions) is runs_over
    if runs_over:
        assert "of a change point; its Grashof margin is 1e-06 mm" in found.best.sentence
    else:
        assert "lost at phi = 180.70 deg" in found.misses[0].why and "reachable" not in found.misses[0].why
