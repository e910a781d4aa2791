"""The error of a task as a measure: what a synthesis makes least, against distances found by brute force, and its derivatives."""

from functools import cache

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.optimize import minimize_scalar

from linkage import DefinitionError, FunctionTask, PathTask, PoseTask, deg, mm, optimise, point_errors, synthesise, task_error
from linkage.study import monte_carlo
from mechanisms.classics.four_bar import FourBar
from mechanisms.three_point_hitch import ThreePointHitch
from tests.for_all import first_daily

BOX = {"OA": (0.02, 0.06), "CB": (0.05, 0.2), "AP": (0.02, 0.15), "BAP": (0.0, 90 * deg)}
POINTS = np.array([(0.03, 0.06), (0.015, 0.07), (0.0, 0.072), (-0.015, 0.066), (-0.022, 0.05)])
TIMES = np.array([0.5, 1.0, 1.6, 2.3, 3.0])


def measured(machine, measure):
    """Return a measure of one machine."""
    return machine.answers([measure])[0].value


def task_of(kind):
    """Return a task that FourBar does nearly, and how it is given."""
    bar = FourBar(OA=0.041, CB=0.083)
    pose = bar.at(phi=TIMES)
    return {
        "path": ("path", PathTask(pose["P"].T + POINTS * 0.02, of="P", at=TIMES)),
        "untimed": ("path", PathTask(POINTS, of="P")),
        "function": ("function", FunctionTask(TIMES, pose["psi"] + np.array([0.0, 0.02, 0.0, -0.01, 2 * np.pi]), of="psi")),
        "poses": ("motion", PoseTask(*(pose["A"] * 1.03), pose.angle("A", "B") + 0.02, of="A B", at=TIMES)),
    }[kind]


@cache
def searched(kind):
    word, task = task_of(kind)
    return synthesise(FourBar(), vary=BOX, starts=4, **{word: task})


@first_daily(3, "kind", ["path", "function", "poses", "untimed"])
def test_the_measure_of_an_answer_is_its_error(kind):
    found = searched(kind)
    place = len(found.solutions) - 1
    for each in {0, place}:
        answer = found.solutions[each]
        assert_allclose(measured(answer.machine, found.measure(each)), answer.error, rtol=1e-6, atol=1e-20)
        parts = [measured(answer.machine, one) for one in found.point_measures(each)]
        assert_allclose(np.sqrt(max(parts)), answer.most, rtol=1e-5, atol=1e-10)


def nearest(machine, point):
    """Return the squared distance of a point from a bar's path, by a grid of the whole turn and a search about its best."""

    def far(phi):
        return float(np.sum((machine.at(phi=phi)["P"] - point) ** 2))

    grid = np.linspace(0.0, 2 * np.pi, 361)
    best = grid[np.argmin(np.sum((machine.at(phi=grid)["P"] - np.asarray(point)[:, None]) ** 2, axis=0))]
    return minimize_scalar(far, bounds=(max(best - 0.03, 0.0), min(best + 0.03, 2 * np.pi)), method="bounded", options={"xatol": 1e-12}).fun


def test_an_untimed_error_counts_by_the_distance_from_the_path_and_has_its_derivatives():
    found = searched("untimed")
    best, step = found.best.machine, 1e-5
    total = found.measure()
    for name in ("OA", "BAP", "AB", "C.y"):  # of the first two the error is least
        ends = [best.replaced(**{name: best[name] + sign * step}) for sign in (1, -1)]
        change = np.subtract(*[sum(nearest(each, point) for point in POINTS) for each in ends]) / (2 * step)
        slope = sum(float(best.at(**leaf.strokes).gradient(leaf.quantity, wrt=[name])[0]) for leaf in total.leaves)
        assert_allclose(slope, change, rtol=1e-4, atol=1e-8)
        assert (abs(slope) > 1e-5) == (name in ("AB", "C.y"))
    # away from the answer it stays the distance, but for the path's bend
    near = best.replaced(OA=best["OA"] + 0.3 * mm, BAP=best["BAP"] + 0.2 * deg)
    for one, point in zip(found.point_measures(), POINTS, strict=True):
        assert_allclose(np.sqrt(measured(near, one)), np.sqrt(nearest(near, point)), rtol=0, atol=0.01 * mm)


def test_bands_of_an_error_are_those_of_machines_one_by_one():
    found = searched("untimed")
    kept = [each**0.5 <= found.best.most + 0.02 * mm for each in found.point_measures()]
    study = monte_carlo(found.machine, {"rms": (found.measure() / 5) ** 0.5}, {"OA": 0.1 * mm, "CB": 0.1 * mm}, subject_to=kept, count=24)
    errors = [sum(nearest(study.design(place), point) for point in POINTS) for place in range(24)]
    assert_allclose(study["rms"].mean, np.mean(np.sqrt(np.array(errors) / 5)), rtol=1e-4)
    assert_allclose(study["rms"].nominal, found.best.rms, rtol=1e-6)
    most = [max(np.sqrt(nearest(study.design(place), point)) for point in POINTS) for place in range(24)]
    assert 0.1 < study.yield_rate < 0.95
    assert_allclose(study.good, np.array(most) <= found.best.most + 0.02 * mm)


def test_a_search_makes_the_error_least_that_a_synthesis_makes_least():
    _, task = task_of("path")
    vary = {"OA": (0.03, 0.05), "CB": (0.07, 0.09)}
    found = synthesise(FourBar(), path=task, vary=vary, starts=4)
    best = optimise(FourBar(), minimise=task_error(FourBar(), task), vary=vary, starts=1)
    assert_allclose(best.value, found.error, rtol=1e-6)
    assert [best.machine[name] for name in vary] == pytest.approx([found.machine[name] for name in vary], abs=1e-7)


def test_an_untimed_error_of_any_machine_is_over_its_whole_stroke():
    task = PathTask(POINTS, of="P")
    each = point_errors(FourBar(), task)
    assert_allclose([measured(FourBar(), one) for one in each], [nearest(FourBar(), point) for point in POINTS], rtol=1e-6)


def test_what_cannot_be_asked():
    with pytest.raises(DefinitionError, match="3 strokes for 5 points; give the stroke of each"):
        task_error(FourBar(), PathTask(POINTS, of="P"), [0.1, 0.2, 0.3])
    with pytest.raises(DefinitionError, match="Point"):
        task_error(ThreePointHitch(), PathTask(POINTS, of="Q"))
