"""A function's values, slopes and curvatures wanted together: against Freudenstein's equation and its derivatives, which are linear."""

import pickle

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import DefinitionError, FunctionTask, draw, ratio, synthesise
from linkage.study.problem import Problem
from linkage.study.space import Space
from linkage.synthesis.fit import Fit, Timing
from mechanisms.classics.four_bar import FourBar
from tests.for_all import for_all

LENGTHS = {"OA": (0.01, 0.08), "AB": (0.05, 0.2), "CB": (0.05, 0.2)}
AS_FAR_AS = ("psi", ratio("psi"), ratio("psi", order=2))
START = FourBar(OA=0.03, AB=0.11, CB=0.09)


def by_freudenstein(phi, psi, slope, curvature):
    """Return OA, AB and CB of a frame of 0.1 m from the equation K1 cos psi - K2 cos phi + K3 = cos(phi - psi) and its two derivatives."""
    c, s = np.cos(phi - psi), np.sin(phi - psi)
    rows = [
        [np.cos(psi), -np.cos(phi), 1.0],
        [-np.sin(psi) * slope, np.sin(phi), 0.0],
        [-np.cos(psi) * slope**2 - np.sin(psi) * curvature, np.cos(phi), 0.0],
    ]
    k1, k2, k3 = np.linalg.solve(rows, [c, -s * (1.0 - slope), -c * (1.0 - slope) ** 2 + s * curvature])
    a, b = 0.1 / k1, 0.1 / k2
    return a, np.sqrt(a * a + b * b + 0.01 - 2.0 * a * b * k3), b


@for_all("phi", [2.2], slow=[0.6, 4.0])
def test_slope_and_curvature_at_a_stroke_decide_the_four_bar(phi):
    pose = FourBar().at(phi=[phi])
    wanted = [pose["psi"], pose.ratio("psi"), pose.ratio("psi", order=2)]
    truth = by_freudenstein(phi, *(float(each[0]) for each in wanted))
    assert_allclose(truth, (0.04, 0.12, 0.08), rtol=1e-10)
    found = synthesise(START, function=FunctionTask([phi], wanted, of=AS_FAR_AS), vary=LENGTHS, starts=16)
    got = [[each.machine[name] for name in LENGTHS] for each in found.solutions]
    assert min(np.abs(np.array(each) / truth - 1.0).max() for each in got) < 1e-9
    assert_allclose(found.best.reached[:, 0], np.ravel(wanted), rtol=1e-9)


def test_what_is_not_wanted_at_a_stroke_counts_nothing():
    """Two values and one slope: three lengths that meet them, whatever the slope at the other stroke is."""
    phi = np.array([0.5, 1.5])
    motion = FourBar().at(phi=phi)
    task = FunctionTask(phi, [motion["psi"], [np.nan, motion.ratio("psi")[1]]], of=["psi", ratio("psi")])
    found = synthesise(START, function=task, vary=LENGTHS, starts=16)
    assert found.error < 1e-20
    reached = found.machine.at(phi=phi)
    assert_allclose(reached["psi"], motion["psi"], rtol=1e-9)
    assert_allclose(reached.ratio("psi")[1], motion.ratio("psi")[1], rtol=1e-9)
    assert float(found.machine.answers([found.measure()])[0].value) == pytest.approx(found.error, abs=1e-20)
    assert draw(found).axes


def test_derivatives_of_all_rows_are_exact():
    phi = np.array([0.5, 1.5, 2.5])
    motion = FourBar().at(phi=phi)
    rows = [motion["psi"], [np.nan, 0.3, np.nan], [0.1, np.nan, 0.2]]
    task = FunctionTask(phi, rows, of=AS_FAR_AS, within=[0.01, 0.1, 2.0])
    problem = Problem(START, [], [], Space.of(START, LENGTHS), 1.0, None)
    fit = Fit(problem, task.rows(START), Timing.of(problem, "phi", True, 3), (), task.at)
    at, base = np.array([[0.4, 0.5, 0.3]]), np.array(phi)[None]
    slopes, step = fit.slopes(at, base)[0], 1e-6
    for k in range(3):
        there, back = (fit.misses(at + sign * step * np.eye(3)[k], base)[0] for sign in (1.0, -1.0))
        assert_allclose(slopes[:, k], (there - back) / (2.0 * step), rtol=1e-6, atol=1e-6)
    assert (slopes[[3, 5, 7]] == 0.0).all()


def test_within_weighs_what_cannot_all_be_met():
    phi = np.linspace(0.5, 3.0, 6)
    motion = FourBar().at(phi=phi)
    wanted = [motion["psi"], motion.ratio("psi") + 0.05]
    off = []
    for within in ([1.0, 0.01], [0.01, 1.0]):
        task = FunctionTask(phi, wanted, of=["psi", ratio("psi")], within=within)
        best = pickle.loads(pickle.dumps(synthesise(START, function=task, vary=LENGTHS, starts=16).best.reached))
        off.append(np.abs(best - np.array(wanted)).max(axis=1))
    assert off[0][1] < 0.6 * off[1][1] and off[1][0] < 0.1 * off[0][0]


@for_all(
    ("values", "of", "within", "message"),
    [
        ([[0.1], [0.2]], ["psi"], None, "2 rows of values for 1 quantities"),
        ([[np.nan], [0.2]], AS_FAR_AS[:2], None, "finite numbers"),
        ([[0.1], [np.nan]], AS_FAR_AS[:2], None, "NaN where nothing is wanted"),
        ([[0.1], [0.2, 0.3]], AS_FAR_AS[:2], None, "1 numbers are expected"),
        ([[0.1], [np.inf]], AS_FAR_AS[:2], None, "finite numbers"),
        ([[0.1], [0.2]], AS_FAR_AS[:2], [1.0], "above zero for each"),
        ([0.1], "psi", 0.0, "above zero for each"),
        ([], [], None, "a row for each"),
    ],
)
def test_rows_that_cannot_be_asked(values, of, within, message):
    with pytest.raises(DefinitionError, match=message):
        FunctionTask([0.5], values, of=of, within=within)
