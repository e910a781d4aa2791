"""Buckling against textbook columns, Euler's cases solved anew, Tetmajer's line, and what is refused."""

from functools import partial
from math import cos, pi, sin, tan

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.optimize import brentq

from hydraulics import Buckling
from linkage.errors import DefinitionError
from linkage.units import MPa, kN, m, mm
from tests.for_all import for_all

STEEL = Buckling(rod=40 * mm, yield_strength=335 * MPa)


def test_textbook_slender_column():
    """Shigley, example on a pinned Euler column: 1.5 m, 22 kN, design factor 4, E = 207 GPa, Sy = 500 MPa: d = 37.48 mm."""
    column = Buckling(rod=37.48 * mm, safety=4.0, modulus=207e9, yield_strength=500e6)
    assert_allclose(column.transition, 90.4, atol=0.05)
    assert_allclose(column.allowed(1.5 * m) / kN, 22.0, rtol=1e-3)


def test_textbook_short_column():
    """The same with 375 mm: Johnson, d = 2 sqrt(P / (pi Sy) + Sy l^2 / (pi^2 E)) for P = 88 kN."""
    d = 2 * (88e3 / (pi * 500e6) + 500e6 * 0.375**2 / (pi**2 * 207e9)) ** 0.5
    column = Buckling(rod=d, safety=4.0, modulus=207e9, yield_strength=500e6)
    assert column.slenderness(375 * mm) < column.transition
    assert_allclose(column.critical(375 * mm) / kN, 88.0)


ROOTS = {  # k L of the first buckled shape, from the boundary conditions of the bent bar
    "pin-pin": brentq(sin, 3.0, 3.3),
    "fixed-pin": brentq(lambda x: tan(x) - x, 4.4, 4.6),
    "fixed-fixed": brentq(lambda x: sin(x / 2), 6.0, 6.5),
    "fixed-free": brentq(cos, 1.5, 1.6),
}


@pytest.mark.parametrize("mounting", ROOTS)
def test_mountings_are_eulers_cases(mounting):
    stiffness = 210e9 * pi * 0.04**4 / 64
    expected = ROOTS[mounting] ** 2 * stiffness / 4.0**2
    assert_allclose(Buckling(40 * mm, mounting).critical(4 * m), expected, rtol=1e-6)


def test_the_curves_meet_with_equal_slope():
    at = STEEL.transition * STEEL.rod / 4
    before, there, after = STEEL.critical(at * np.array([1 - 1e-4, 1, 1 + 1e-4]))
    assert_allclose(there, 0.5 * 335 * MPa * STEEL.area)
    assert_allclose((there - before) / (after - there), 1.0, rtol=1e-3)


def test_short_rods_reach_the_yield_strength():
    assert_allclose(STEEL.critical(1e-6), 335 * MPa * STEEL.area)


def test_longer_is_weaker():
    assert np.all(np.diff(STEEL.critical(np.linspace(0.01, 5, 500))) < 0)


def test_near_tetmajers_line():
    slender = np.linspace(10, 88, 50)
    tetmajer = (335 - 0.62 * slender) * MPa * STEEL.area
    ratio = STEEL.critical(slender * STEEL.rod / 4) / tetmajer
    assert 0.82 < ratio.min() < ratio.max() < 1.023


def test_verdict_at_the_worst_pose():
    length, thrust = np.array([0.8, 1.0, 1.2]), np.array([60.0, 60.0, -300.0]) * kN
    verdict = STEEL.check(length, thrust)
    assert verdict.ok
    assert "60 kN on a 40 mm rod 1000 mm long (pin-pin)" in verdict.sentence
    assert f"safety {STEEL.critical(1.0) / (60 * kN):.3g}, at least 3.5" in verdict.sentence


def test_failing_verdict_names_the_rod_that_holds():
    verdict = STEEL.check(1.2 * m, 60 * kN)
    assert not verdict.ok
    assert verdict.sentence.endswith("; a rod of 45 mm holds.")
    assert Buckling(45 * mm, yield_strength=335 * MPa).check(1.2 * m, 60 * kN).ok
    assert STEEL.check(50 * m, 1e4 * kN).sentence.endswith("; no standard rod holds: shorten the cylinder or use more of them.")


def test_a_rod_that_only_pulls_does_not_buckle():
    assert str(STEEL.check([1.0, 2.0], [-50 * kN, 0.0])) == "ok   buckling: the rod is never pushed."


def test_unreached_poses_are_left_out():
    assert np.array_equal(np.isnan(STEEL.critical([1.0, np.nan])), [False, True])
    assert not STEEL.check([np.nan, 1.0, 1.0], [np.nan, np.nan, 500 * kN]).ok
    assert STEEL.check([np.nan, 1.0], [500 * kN, np.nan]).ok


@for_all(
    ("call", "message"),
    [
        (partial(Buckling, -40 * mm), "Rod = -0.04 is not above zero"),
        (partial(Buckling, np.nan), "Rod = nan is not finite"),
        (partial(Buckling, 40 * mm, "pin-pined"), "Mounting 'pin-pined' is unknown. Did you mean pin-pin"),
        (partial(Buckling, 40 * mm, safety=0.5), "Buckling safety = 0.5 is below 1"),
        (partial(Buckling, 40 * mm, modulus=0.0), "Modulus = 0 is not above zero"),
        (partial(Buckling, 40 * mm, yield_strength=-1.0), "Yield strength = -1 is not above zero"),
        (partial(STEEL.critical, 0.0), "Length between the ends = 0 is not above zero"),
        (partial(STEEL.critical, [1.0, -1.0]), "Length between the ends = -1 is not above zero"),
        (partial(STEEL.critical, np.nan), "Length between the ends = nan is not finite"),
        (partial(STEEL.check, 1.0, np.nan), "Thrust = nan is not finite"),
    ],
)
def test_refusals(call, message):
    with pytest.raises(DefinitionError, match=message):
        call()
