"""Closed curves: their descriptors by quadrature, what leaves them as they are, how one is laid onto another, and closed paths as tasks."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import cumulative_simpson, simpson

from linkage import DefinitionError, PathTask, around, mm, synthesise
from linkage.synthesis.closed_curves import ClosedCurves, drawn_curve, laid_onto
from mechanisms.classics.four_bar import FourBar
from tests.for_all import for_all

FREE = np.array([[1e-3], [1e3]])
BAR = FourBar(OA=0.036, AB=0.11, CB=0.085, AP=0.05)


def curve(count, start=0.0, bar=BAR):
    """Return the path of P over one turn, complex (count,) [m]."""
    return bar.at(phi=start + np.arange(count) * 2 * np.pi / count)["P"].T @ [1.0, 1.0j]


def pairs(z):
    """Return complex numbers as points (n, 2)."""
    return np.stack([z.real, z.imag], axis=1)


def moved(z, factor, by, start, backward):
    """Return a curve of points moved, begun elsewhere, and passed the other way."""
    found = np.roll(factor * z + by, start)
    return found[::-1] if backward else found


def test_descriptors_are_the_integrals_along_the_way():
    """An ellipse, by Simpson's rule over its arc length."""
    u = np.linspace(0.0, 2 * np.pi, 200_001)
    z = 3.0 * np.cos(u) + 1j * np.sin(u) + (0.4 + 0.2j) * np.exp(2j * u)
    speed = np.abs(np.gradient(z, u, edge_order=2))
    way = cumulative_simpson(speed, x=u, initial=0)
    s = way / way[-1]
    found = ClosedCurves(z[:-1][::1000][None], 4)
    for place, k in enumerate((1, 2, 3, 4, -1, -2, -3, -4)):
        assert_allclose(found.descriptors[0, place], simpson(z * np.exp(-2j * np.pi * k * s) * speed / way[-1], x=u), rtol=0, atol=1e-8)
    assert_allclose(found.middle[0], simpson(z * speed / way[-1], x=u), rtol=0, atol=1e-8)
    assert_allclose(found.along[0], s[:-1][::1000], rtol=0, atol=1e-8)
    assert_allclose(found.size[0] ** 2, simpson(np.abs(z - found.middle[0]) ** 2 * speed / way[-1], x=u), rtol=1e-8)


@pytest.mark.parametrize("backward", [False, True])
def test_amplitudes_stay_whatever_place_turn_size_start_and_sense(backward):
    z = curve(128)
    first = ClosedCurves(z[None]).amplitudes[0]
    other = ClosedCurves(moved(z, 3.0 * np.exp(1.1j), 2.0 - 1.0j, 37, backward)[None]).amplitudes[0]
    swapped = np.concatenate(np.split(other, 2)[::-1])
    assert_allclose(swapped if backward else other, first, rtol=0, atol=1e-10)
    assert np.abs((other if backward else swapped) - first).max() > 1e-2


@pytest.mark.parametrize("backward", [False, True])
def test_a_curve_is_laid_onto_its_own_image(backward):
    factor, by = 2.5 * np.exp(-2.0j), 0.3 + 0.7j
    onto, along = drawn_curve(pairs(moved(curve(300, 0.7), factor, by, 77, backward)))
    curves = ClosedCurves(curve(96)[None])
    laid = laid_onto(curves, onto, FREE)
    assert laid.backward[0] == backward
    assert np.sqrt(laid.error[0]) / onto.size[0] < 1e-7
    assert_allclose([laid.factor[0], laid.by[0]], [factor, by], rtol=0, atol=1e-7)
    strokes = 2 * np.pi * curves.shares_of_turn(laid.along(along))[0]
    there = laid.factor * (BAR.at(phi=strokes)["P"].T @ [1.0, 1.0j]) + laid.by
    assert np.abs(there - moved(curve(300, 0.7), factor, by, 77, backward)).max() < 1e-3 * onto.size[0]


@pytest.mark.parametrize(("free", "factor", "by"), [("shift", 1.0, 0.2), ("turn", np.exp(0.5j), 0.0), ("scale", 1.7, 0.0)])
def test_what_is_not_free_is_not_used(free, factor, by):
    onto, _ = drawn_curve(pairs(factor * curve(300) + by))
    curves = ClosedCurves(curve(96)[None])
    only = {name: name == free for name in ("shift", "turn", "scale")}
    laid = laid_onto(curves, onto, FREE, **only)
    assert_allclose([laid.factor[0], laid.by[0]], [factor, by], rtol=0, atol=1e-6)
    none = laid_onto(curves, onto, FREE, shift=False, turn=False, scale=False)
    assert none.error[0] > 1e-4 * onto.size[0] ** 2 and none.factor[0] == 1.0 and none.by[0] == 0.0


def test_a_size_stays_within_its_limits():
    onto, _ = drawn_curve(pairs(3.0 * curve(300)))
    laid = laid_onto(ClosedCurves(curve(96)[None]), onto, np.array([[0.5], [2.0]]))
    assert_allclose(np.abs(laid.factor), 2.0, rtol=1e-12)


def test_a_path_is_closed_where_its_last_point_is_the_first_or_it_says_so():
    points = [(0.0, 0.0), (0.1, 0.0), (0.1, 0.1)]
    assert not PathTask(points, of="P").closed
    assert PathTask([*points, points[0]], of="P").closed
    assert PathTask(points, of="P", closed=True).closed
    assert not PathTask([*points, points[0]], of="P", closed=False).closed
    assert not PathTask([points[0], points[1], points[0]], of="P").closed  # to and fro
    with pytest.raises(DefinitionError, match="three different points"):
        PathTask([points[0], points[1], points[0]], of="P", closed=True)
    with pytest.raises(DefinitionError, match="three different points"):
        drawn_curve(np.array([(0.0, 0.0), (1.0, 0.0), (0.0, 0.0)]))


def known_bars(count, seed):
    """Return bars that run, and points of their closed paths: some backward, at strokes of their own."""
    random, found = np.random.default_rng(seed), []
    while len(found) < count:
        OA, AB, CB, AP = random.uniform([0.02, 0.06, 0.06, 0.02], [0.06, 0.16, 0.16, 0.12])
        bar = FourBar(OA=OA, AB=AB, CB=CB, AP=AP, BAP=random.uniform(-1.2, 1.2))
        if np.isfinite(bar.sweep(721, unreachable="nan")["P"]).all():
            points = bar.at(phi=np.sort(random.uniform(0.0, 2 * np.pi, 20)))["P"].T
            found.append((bar, points[:: -1 if len(found) % 2 else 1]))
    return found


@for_all(("bar", "points"), lambda: known_bars(4, seed=11)[:1], slow=lambda: known_bars(4, seed=11)[1:])
def test_a_known_closed_path_is_found_again(bar, points):
    vary = {"OA": (0.01, 0.08), "AB": (0.05, 0.2), "CB": (0.05, 0.2), "AP": (0.01, 0.15), "BAP": (-1.5, 1.5)}
    vary |= {"O": around(50 * mm), "C": around(60 * mm)}
    found = synthesise(FourBar(), path=PathTask(points, of="P", closed=True), vary=vary, starts=12)
    assert found.best.most <= 1e-9
    assert_allclose(found.machine.at(phi=found.best.strokes)["P"].T, points, rtol=0, atol=2e-9)
    found.machine.sweep(721)
