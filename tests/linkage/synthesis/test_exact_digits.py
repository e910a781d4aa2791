"""Exact synthesis against forty digits: how far each answer in doubles stands off a true one."""

import mpmath
import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import burmester, cognates
from linkage.synthesis.exact import links
from linkage.synthesis.exact_paths import real_ones, solutions_of, turnings
from mechanisms.classics.four_bar import FourBar
from tests.for_all import for_all
from tests.linkage.synthesis.exact_tasks import lengths
from tests.linkage.synthesis.test_burmester import POSES, random_poses
from tests.linkage.synthesis.test_exact import LINE

STEP = mpmath.mpf(10) ** -20


def off_by(residuals, start):
    """Return how far a state (n,) is off the nearest one whose residuals vanish, in parts of its largest number, by Newton's steps."""
    with mpmath.workdps(40):
        state = [mpmath.mpf(float(each)) for each in start]
        for _ in range(2):
            values = residuals(state)
            J = mpmath.matrix(len(values), len(state))
            for k in range(len(state)):
                moved = [each + STEP * (k == place) for place, each in enumerate(state)]
                for row, (new, old) in enumerate(zip(residuals(moved), values, strict=True)):
                    J[row, k] = (new - old) / STEP
            change = J.T * mpmath.lu_solve(J * J.T, mpmath.matrix(values))
            state = [each - change[k] for k, each in enumerate(state)]
        assert max(abs(each) for each in residuals(state)) < 1e-24
        return float(max(abs(each - float(one)) for each, one in zip(state, start, strict=True)) / max(map(abs, state)))


def differences(places, centre):
    """Return by how much the squared distances of places from a centre differ from that of the first."""
    far = [abs(each - centre) ** 2 for each in places]
    return [each - far[0] for each in far[1:]]


def exact_complex(values):
    """Return complex doubles as they are."""
    return [mpmath.mpc(each.real, each.imag) for each in np.asarray(values, complex)]


def test_the_fifteen_solutions_of_the_printed_problem():
    own = np.array([complex(*each) for each in LINE])
    points, found = exact_complex(own), real_ones(solutions_of(own, own.conj()), own)
    assert len(found) == 15

    def residuals(state):
        ways = [mpmath.mpc(1), *(mpmath.expj(each) for each in state[4:])]
        A, B = ([p + way * mpmath.mpc(*z) for p, way in zip(points, ways, strict=True)] for z in (state[:2], state[2:4]))
        return [*differences(A, 0), *differences(B, 1)]

    for x, y in found[::5]:
        assert off_by(residuals, [x.real, x.imag, y.real, y.imag, *np.angle(turnings(x, y, own))]) < 1e-12


def chebyshev(function, ends, ranges, count):
    """Return pairs (phi, psi) at Chebyshev's points of a function y(x): x over `ends` turns phi, y turns psi, over the ranges [rad]."""
    low, high = ends
    x = 0.5 * (low + high) - 0.5 * (high - low) * np.cos(np.pi * (np.arange(count) + 0.5) / count)
    share = [(x - low) / (high - low), (function(x) - function(low)) / (function(high) - function(low))]
    return np.stack([first + (last - first) * each for each, (first, last) in zip(share, ranges, strict=True)], axis=1)


TEXTBOOK = [
    (np.log10, (1.0, 2.0), [(0.8, 1.85), (1.2, 2.77)]),
    (lambda x: x**1.5, (1.0, 4.0), [(0.52, 2.09), (1.57, 3.14)]),
    (lambda x: 1.0 / x, (1.0, 2.0), [(0.5, 2.07), (4.2, 5.77)]),
]


@for_all("count", [3, 4, 5])
@for_all(("function", "ends", "ranges"), TEXTBOOK, ids=["log10 x", "x^1.5", "1/x"])
def test_generators_of_the_textbooks_functions(function, ends, ranges, count):
    pairs = chebyshev(function, ends, ranges, count)
    p, s = (exact_complex(np.exp(1j * each)) for each in pairs.T)
    own = [0, *([1] if count == 5 else []), 2, *([3] if count > 3 else [])]
    found = links(*np.exp(1j * pairs.T), ("crank", "follower") if count == 5 else ("follower",) if count == 4 else ())
    assert found or (count, function) == (4, np.log10)  # whose two are complex
    for u, v in found:
        start = np.array([u.real, u.imag, v.real, v.imag])

        def residuals(state, start=start):
            every = [*map(float, start)]
            for place, value in zip(own, state, strict=True):
                every[place] = value
            u, v = mpmath.mpc(*every[:2]), mpmath.mpc(*every[2:])
            return differences([1 + v * one - u * other for one, other in zip(s, p, strict=True)], 0)

        assert off_by(residuals, start[own]) < 1e-12


@pytest.mark.parametrize("poses", [POSES, random_poses(2, 4), random_poses(0, 5), random_poses(2, 5)], ids=["4", "other 4", "5", "other 5"])
def test_links_of_poses(poses):
    rows = np.asarray(poses)
    places, turned = exact_complex(rows[:, 0] + 1j * rows[:, 1]), exact_complex(np.exp(1j * (rows[:, 2] - rows[0, 2])))
    guiding = [each for each in burmester(poses).links if each.length < 10.0]
    assert len(guiding) > 1

    def residuals(state):
        w, m = mpmath.mpc(*state[:2]), mpmath.mpc(*state[2:])
        return differences([z + way * (w - places[0]) for z, way in zip(places, turned, strict=True)], m)

    for link in guiding:
        assert off_by(residuals, [*link.point, *link.centre]) < 1e-12


def test_cognates_draw_the_curve():
    """The curve of a cognate is that of the machine: its links by the theorem in forty digits, on Roberts' triangle."""
    machine = FourBar()
    with mpmath.workdps(40):
        O, C = exact_complex([complex(*machine["O"]), complex(*machine["C"])])
        a, b, c, d = (mpmath.mpf(float(each)) for each in (*lengths(machine), abs(complex(*machine["C"]) - complex(*machine["O"]))))
        share = mpmath.mpf(float(machine["AP"])) / b * mpmath.expj(mpmath.mpf(float(machine["BAP"])))
        wanted = [
            [abs(share) * each for each in (b, c, d, a)],  # coupler AP of the first as a crank, and so on round the triangle
            [abs(1 - share) * each for each in (a, d, c, b)],
        ]
        third = O + share * (C - O)
    for each, known in zip(cognates(machine, of="P"), wanted, strict=True):
        found = each.machine
        assert_allclose(sorted([*lengths(found), np.hypot(*(found["C"] - found["O"]))]), sorted(map(float, known)), rtol=1e-12)
        pivots = [complex(*found["O"]), complex(*found["C"])]
        assert min(abs(one - complex(third)) for one in pivots) < 1e-12 * float(abs(third))
