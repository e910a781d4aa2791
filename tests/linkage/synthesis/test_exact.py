"""Exact synthesis: all solutions of the printed problem, machines that must be found again, and a search of its own beside the algebra."""

import pickle
from functools import cache

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.optimize import root

from linkage import RIGHT, DefinitionError, StudyError, burmester, deg, five_point, freudenstein
from linkage.synthesis.exact_paths import general_task, solutions_of, solved_each
from mechanisms.classics.four_bar import FourBar
from tests.for_all import first_daily, for_all
from tests.linkage.synthesis.exact_tasks import as_rows, bar_at, lengths

LINE = [(0.5, 1.06), (-0.83, -0.27), (-0.34, 0.22), (-0.13, 0.43), (0.22, 0.78)]
"""Morgan and Wampler's problem 7."""


@cache
def printed_problem():
    return five_point([(0, 0), (1, 0)], LINE)


# -- five points of a path ------------------------------------------------------------------------------------


def by_two_circles(each, points):
    """Check by lengths alone that a machine's places at its strokes are the points, and its links keep their lengths."""
    motion = each.machine.at(phi=each.strokes)
    assert_allclose(motion["P"], np.transpose(points), rtol=0, atol=1e-12)
    for pair, name in (("OA", "OA"), ("AB", "AB"), ("CB", "CB"), ("AP", "AP")):
        assert_allclose(motion.distance(*pair), abs(each.machine[name]), rtol=1e-12)


def test_the_printed_problem_has_fifteen_real_solutions_of_thirty_three():
    found = printed_problem()
    assert (found.complex_count, len(found.all)) == (33, 15)
    assert max(each.error for each in found.all) < 1e-12
    assert not found.solutions and "15 real solutions of 33" in str(found)
    with pytest.raises(StudyError, match="0 of them run"):
        found.machine  # noqa: B018
    for each in found.misses:
        here = np.isfinite(each.strokes)
        motion = each.machine.at(phi=each.strokes[here])
        assert_allclose(motion["P"], np.transpose(LINE)[:, here], rtol=0, atol=1e-12)
        assert isinstance(each.machine, FourBar) and each.machine.sweep(31).reached.all()


def test_equations_without_a_solution_leave_the_others_alone():
    found = solved_each(np.array([np.diag([2.0, 4.0]), np.ones((2, 2)), np.eye(2)], complex), np.full((3, 2), 4.0 + 0.0j))
    assert_allclose(found, [[2.0, 1.0], [np.nan, np.nan], [4.0, 4.0]])


def test_a_general_task_has_thirty_six_solutions():
    assert len(general_task()[0]) == 36


def found_again(seed):
    """Check that a bar is found from five points of its curve, and that what is not real comes in pairs."""
    bar, phi = bar_at(seed, 5)
    points = bar.places(phi)[2]
    found = five_point([(0, 0), (1, 0)], as_rows(points), in_order=False)
    own = [each for each in found.all if np.allclose(sorted(lengths(each.machine)), sorted([bar.a, bar.b, bar.c]), rtol=1e-8)]
    assert own and own[0].error < 1e-11
    assert (found.complex_count - len(found.all)) % 2 == 0 and found.complex_count <= 36
    for each in found.solutions:
        by_two_circles(each, as_rows(points))
    return found


@for_all("seed", range(1), slow=range(1, 3))
def test_a_bar_is_found_from_five_of_its_points(seed):
    found = found_again(seed)
    for each in found.solutions:
        assert each.machine.sweep(31).reached.all()


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(50))
def test_any_bar_is_found_from_five_of_its_points(seed):
    found_again(seed)


@pytest.mark.slow
def test_no_solution_is_missed_that_a_search_finds():
    """Newton's method on the lengths from places at random: each four-bar that it comes to is among those of the continuation."""
    bar, phi = bar_at(8, 5)
    points = bar.places(phi)[2]
    known = np.array([[z[0], z[2]] for z in solutions_of(points, points.conj())])
    random = np.random.default_rng(1)

    def off(state):
        x, y, turned = complex(*state[:2]), complex(*state[2:4]), np.exp(1j * np.array([0.0, *state[4:]]))
        a, b = abs(points + turned * x) ** 2, abs(points + turned * y - 1.0) ** 2
        return np.concatenate([np.diff(a), np.diff(b)])

    hits = set()
    for _ in range(25):
        end = root(off, np.concatenate([random.normal(size=4), random.uniform(-3, 3, 4)]), method="lm")
        state = end.x
        x, y = complex(*state[:2]), complex(*state[2:4])
        if np.abs(end.fun).max() < 1e-11 and abs(x - y) > 1e-3 and np.abs(state[:4]).max() < 50.0:
            off_by = abs(known - np.array([x, y])).max(axis=1)
            assert off_by.min() < 1e-5
            hits.add(int(off_by.argmin()))
    assert len(hits) > 3


@pytest.mark.slow
def test_pivots_anywhere_and_the_branch_that_each_begins_on():
    bar, phi = bar_at(12, 5)
    moved = 0.2 * np.exp(0.7j)
    points = 0.1 - 0.3j + moved * bar.places(phi)[2]
    pivots = 0.1 - 0.3j + moved * np.array([0.0, 1.0])
    found = five_point(as_rows(pivots), as_rows(points), in_order=False)
    own = next(each for each in found.all if np.allclose(lengths(each.machine), 0.2 * np.array([bar.a, bar.b, bar.c]), rtol=1e-8))
    turned = np.mod(own.strokes - phi - 0.7 + np.pi, 2 * np.pi) - np.pi
    assert_allclose(turned, 0.0, atol=1e-9)
    assert own.runs and own.machine.plan.points["B"].settled_side == bar.side


def test_a_found_machine_goes_through_pickle():
    poses = [(0.0, 0.0, 0.0), (0.1, 0.0, 0.4), (0.25, 0.0, 1.1)]
    body = burmester(poses)
    slides = body.four_bar(body.link(centre=(0.1, -0.3)), body.link(point=(0.0, 0.0)))
    bar = next(each for each in printed_problem().all if each.side is RIGHT)
    for each in (slides, bar):
        machine = each.machine
        again = pickle.loads(pickle.dumps(machine))
        assert again.dimensions == machine.dimensions and str(again.strokes) == str(machine.strokes)
        assert_allclose(again.sweep(7)["P"], machine.sweep(7)["P"], rtol=0, atol=0)


@for_all(
    ("pivots", "points", "message"),
    [
        ([(0, 0), (0, 0)], LINE, "two of the pivots are at one place"),
        ([(0, 0), (1, 0)], LINE[:4], "5 places"),
        ([(0, 0), (1, 0)], [*LINE[:4], LINE[0]], "two of the points"),
        ([(0, 0), (1, 0)], [*LINE[:4], (np.nan, 0)], "finite pairs"),
        ([(0, 0), (2, 0)], [(3, 0), (1, 0), (2, 1), (2, -1), (2.6, 0.8)], "circle about the pivot .2, 0.: one crank does it"),
    ],
)
def test_five_points_that_cannot_be_asked(pivots, points, message):
    with pytest.raises(DefinitionError, match=message):
        five_point(pivots, points)


# -- Freudenstein -----------------------------------------------------------------------------------------------


def pairs_of(bar, phi, zeros):
    """Return the pairs (phi, psi) of a bar at angles of its crank, measured from zeros of their own."""
    psi = np.unwrap(np.angle(bar.places(phi)[1] - 1.0))
    return np.stack([phi, psi], axis=1) - np.asarray(zeros)


CASES = [(3, "follower", (0.0, 0.0)), (4, "follower", (0.0, 0.8)), (4, "crank", (-1.3, 0.0)), (5, "follower", (0.4, -2.2))]


@for_all("seed", range(1), slow=range(1, 5))
@for_all(("count", "free", "zeros"), CASES)
def test_a_bar_is_found_from_pairs_of_its_angles(count, free, zeros, seed):
    bar, phi = bar_at(100 * count + seed, count, 2.0)
    pairs = pairs_of(bar, phi, zeros)
    found = freudenstein(pairs, free=free, ground=0.4)
    own = [each for each in found.all if np.allclose(lengths(each.machine), 0.4 * np.array([bar.a, bar.b, bar.c]), rtol=1e-7)]
    assert len(own) == 1 and own[0].error < 1e-12
    assert len(found.all) <= count - 2 + (count == 3)
    for each in found.all:
        machine = each.machine
        a, b, c, d = *lengths(machine), 0.4
        frame = np.arctan2(*machine["C"][::-1])
        phi_at, psi_at = pairs[:, 0] - frame, pairs[:, 1] + machine["psi0"] - frame
        k1, k2, k3 = d / a, d / c, (a**2 - b**2 + c**2 + d**2) / (2 * a * c)
        off = k1 * np.cos(psi_at) - k2 * np.cos(phi_at) + k3 - np.cos(phi_at - psi_at)
        assert_allclose(off / max(k1, k2, k3, 1.0), 0.0, atol=1e-12)
    for each in found.solutions:
        assert each.machine.sweep(31).reached.all()
        assert_allclose(each.machine.at(phi=pairs[:, 0])["psi"], pairs[:, 1], rtol=0, atol=1e-8)


def test_three_pairs_are_three_linear_equations():
    """Freudenstein's K1, K2, K3 by elimination in fractions of the cosines."""
    pairs = np.radians([(40, 70), (65, 80), (95, 100)])
    found = freudenstein(pairs).best
    phi, psi = pairs.T
    k1, k2, k3 = np.linalg.solve(np.stack([np.cos(psi), -np.cos(phi), np.ones(3)], axis=1), np.cos(phi - psi))
    a, c = 1.0 / k1, 1.0 / k2
    b = np.sqrt(a * a + c * c + 1.0 - 2.0 * a * c * k3)
    assert_allclose(lengths(found.machine), np.abs([a, b, c]), rtol=1e-12)


@first_daily(1, ("count", "free", "zeros"), CASES[1:])
def test_no_function_machine_is_missed_that_a_search_finds(count, free, zeros):
    bar, phi = bar_at(40 + count, count, 2.0)
    pairs = pairs_of(bar, phi, zeros)
    p, s = np.exp(1j * pairs.T)
    found = freudenstein(pairs, free=free)
    known = np.array([sorted(lengths(each.machine)) for each in found.all])
    random = np.random.default_rng(2)

    def crank_and_follower(state):
        if count == 5:
            return complex(*state[:2]), complex(*state[2:4])
        return (complex(*state[:2]), state[2]) if free == "crank" else (state[0], complex(*state[1:3]))

    def off(state):
        u, v = crank_and_follower(state)
        return np.diff(abs(1.0 + v * s - u * p) ** 2)

    hits = 0
    for _ in range(150):
        end = root(off, random.normal(size=count - 1))
        u, v = crank_and_follower(end.x)
        if np.abs(end.fun).max() < 1e-12 and min(abs(u), abs(v)) > 1e-4 and max(abs(u), abs(v)) < 1e3:
            hits += 1
            mine = sorted([abs(u), abs(v), abs(1.0 + v * s[0] - u * p[0])])
            assert abs(known / mine - 1.0).max(axis=1).min() < 1e-6
    assert hits > 1


@for_all(
    ("pairs", "options", "message"),
    [
        ([(0.1, 0.2), (0.3, 0.4)], {}, "three to five"),
        ([(0.1, 0.2)] * 3, {}, "two values of phi are the same"),
        ([(0.1, 0.2), (0.3, 0.2), (0.5, 0.2)], {}, "two values of psi are the same"),
        ([(0.1, 0.2), (0.3, 0.4), (0.5, 0.7)], {"free": "coupler"}, '"crank" or "follower"'),
        ([(0.1, 0.2), (0.3, 0.4), (0.5, 0.7)], {"ground": 0.0}, "above zero"),
        ([0.1, 0.2, 0.3], {}, "finite pairs .phi, psi."),
        ([(20, 35), (35, 45), (50, 60)], {}, "phi: 20 is an angle in radians, 3.18 turns; write 20 . deg"),
    ],
)
def test_pairs_that_cannot_be_asked(pairs, options, message):
    with pytest.raises(DefinitionError, match=message):
        freudenstein(pairs, **options)


@pytest.mark.parametrize("zero", [0.0, 0.4])
@pytest.mark.parametrize("count", [4, 5])
def test_pairs_of_every_parallelogram_are_told(count, zero):
    with pytest.raises(StudyError, match="as in every parallelogram"):
        freudenstein([(phi, phi + zero) for phi in (0.1, 0.2, 0.4, 0.6, 0.9)[:count]])


def test_points_on_two_circuits_are_told():
    """A crank rocker whose follower changes its side between two pairs cannot be driven from the one to the other."""
    bar = FourBar(C=(1.0, 0.0), OA=0.3, AB=0.9, CB=0.8)
    phi = np.radians([20.0, 60.0, 110.0])
    mirrored = [each if k < 2 else -bar.at(phi=-phi[k])["psi"] for k, each in enumerate(bar.at(phi=phi)["psi"])]
    found = freudenstein(np.stack([phi, mirrored], axis=1))
    assert not found.solutions and found.misses[0].why == "points 1-2 lie on the one circuit, 3 on the other"
    assert_allclose(lengths(found.misses[0].machine), [0.3, 0.9, 0.8], rtol=1e-9)
    assert found.misses[0].machine.strokes["phi"].end == pytest.approx(60 * deg)
