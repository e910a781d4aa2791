"""Exact and nearly straight lines."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from mechanisms.classics.chebyshev import Chebyshev
from mechanisms.classics.hart import Hart
from mechanisms.classics.hoeken import Hoeken
from mechanisms.classics.peaucellier import Peaucellier
from mechanisms.classics.roberts import Roberts
from mechanisms.classics.watt_one import WattOne


def four_bar(a, b, c, d, phi, mode):
    """Return crank pin and rocker pin as complex numbers; mode +1 or -1 is the rocker pin's side of crank pin -> fixed pivot."""
    A = a * np.exp(1j * phi)
    base = d - A
    size = abs(base)
    cos = (size**2 + b**2 - c**2) / (2 * size * b)
    return A, A + b * base / size * (cos + mode * 1j * np.sqrt(1.0 - cos**2))


def complex_of(place):
    return place[0] + 1j * place[1]


@pytest.mark.parametrize("setting", [{}, {"arm": 0.61, "side": 0.33}, {"C": (0.19, 0.06), "CA": float(np.hypot(0.19, 0.06))}])
def test_peaucellier_is_exactly_straight(setting):
    design = Peaucellier(**setting)
    motion = design.at(phi=np.radians(np.linspace(-50, 50, 101)))
    power, C = design["arm"] ** 2 - design["side"] ** 2, design["C"]
    assert_allclose(motion.distance("O", "A") * motion.distance("O", "P"), power, rtol=1e-12)
    assert_allclose(np.einsum("i,i...", C, motion["P"]), power / 2, rtol=1e-12)
    assert np.ptp(motion["P"], axis=1).max() > 0.3
    assert_allclose(np.einsum("i,i...", C, motion.ratio("P")), 0.0, atol=1e-12)


@pytest.mark.parametrize("setting", [{}, {"m": 0.35}, {"short": 0.22, "long": 0.48}])
def test_hart_is_exactly_straight(setting):
    design = Hart(**setting)
    motion = design.at(phi=np.radians(np.linspace(-45, 45, 91)))
    power = design["m"] * (1.0 - design["m"]) * (design["long"] ** 2 - design["short"] ** 2)
    assert_allclose(motion.distance("O", "P") * motion.distance("O", "Q"), power, rtol=1e-12)
    assert_allclose(motion.x("Q"), power / (2 * design["E"][0]), rtol=1e-12)
    assert np.ptp(motion.y("Q")) > 0.2
    O, P, Q, A, C = (complex_of(motion[name]) for name in "OPQAC")
    for one, other in ((P - O, Q - O), (P - O, C - A)):
        assert_allclose((one.conj() * other).imag, 0.0, atol=1e-15)


def straightness(P):
    """Return the spread across the chord of a path over its length along the chord."""
    along = (P[-1] - P[0]) / abs(P[-1] - P[0])
    turned = (P - P[0]) * along.conj()
    return np.ptp(turned.imag) / np.ptp(turned.real)


def test_hoeken_is_nearly_straight_over_half_a_turn():
    motion = Hoeken().at(phi=np.radians(np.linspace(90, 270, 181)))
    P = complex_of(motion["P"])
    assert straightness(P) < 0.25 / 100
    assert abs(P[-1] - P[0]) == pytest.approx(0.4, rel=0.02)
    assert np.ptp(motion.ratio("P")[0][45:-45]) < 0.05 * abs(motion.ratio("P")[0][90])


def test_hoeken_by_complex_numbers():
    motion = Hoeken().sweep(361)
    A, B = four_bar(0.1, 0.25, 0.25, 0.2, motion.strokes["phi"], 1)
    assert_allclose(complex_of(motion["P"]), 2 * B - A, rtol=0, atol=1e-14)
    assert_allclose(motion["P"][:, -1], motion["P"][:, 0], rtol=0, atol=1e-15)


def test_chebyshevs_known_points():
    """P stands at 0.4 m where the coupler is level in the middle and where rocker OA and the coupler are upright above O."""
    motion = Chebyshev().at(phi=[np.arctan2(0.4, 0.3), np.pi / 2])
    assert_allclose(motion["P"], [[0.2, 0.0], [0.4, 0.4]], rtol=0, atol=1e-14)
    assert np.abs(Chebyshev().sweep(181).y("P") - 0.4).max() < 1e-3


def test_chebyshev_by_complex_numbers():
    motion = Chebyshev().sweep(181)
    A, B = four_bar(0.5, 0.2, 0.5, 0.4, motion.strokes["phi"], -1)
    assert_allclose(complex_of(motion["P"]), (A + B) / 2, rtol=0, atol=1e-14)


def test_chebyshev_and_hoeken_draw_one_curve():
    """Roberts's theorem: the linkages are cognates, and Hoeken's crank turns with Chebyshev's coupler."""
    chebyshev = Chebyshev().sweep(181)
    hoeken = Hoeken().at(phi=chebyshev.angle("A", "B"))
    assert np.ptp(hoeken.x("P")) > 0.3
    assert_allclose(hoeken["P"], chebyshev["P"], rtol=0, atol=1e-9)


def test_roberts_lies_on_the_frame_line_exactly_at_three_points():
    arm, half = Roberts()["arm"], np.arcsin(0.25 / Roberts()["arm"])
    low = np.arccos(0.5 / arm)
    middle = np.arccos(0.25 / arm)
    motion = Roberts().at(phi=[low, middle, low + 2 * half])
    assert_allclose(motion["P"], [[1.0, 0.5, 0.0], [0.0, 0.0, 0.0]], rtol=0, atol=1e-12)


def test_roberts_is_nearly_straight():
    motion = Roberts().sweep(181)
    assert np.ptp(motion.x("P")) > 0.99
    assert np.abs(motion.y("P")).max() < 1.0 / 100
    C, D = four_bar(0.6, 0.5, 0.6, 1.0, motion.strokes["phi"], 1)
    apex = (C + D) / 2 - 1j * (D - C) / 0.5 * np.sqrt(0.6**2 - 0.25**2)
    assert_allclose(complex_of(motion["P"]), apex, rtol=0, atol=1e-12)


def test_watts_piston_is_the_guide_enlarged():
    motion = WattOne().sweep(81)
    assert_allclose(motion["G"], motion["P"] * (0.720 / 0.400), rtol=0, atol=1e-15)
    assert_allclose(motion.ratio("G"), motion.ratio("P") * (0.720 / 0.400), rtol=0, atol=1e-13)


def test_watts_lines_are_nearly_straight():
    motion = WattOne().sweep(81)
    assert np.ptp(motion.y("G")) > 0.48
    assert np.ptp(motion.x("G")) < 1 / 150 * np.ptp(motion.y("G"))
    inner = WattOne().at(phi=np.radians(np.linspace(-10, 10, 41)))
    assert np.ptp(inner.x("G")) < 1 / 2000 * np.ptp(inner.y("G"))


def test_watts_curve_by_complex_numbers():
    """M on the beam's circle, F on the radius rod's, P between them."""
    motion = WattOne().sweep(81)
    M = 0.4 * np.exp(1j * motion.strokes["phi"])
    base = complex(0.9, -0.2) - M
    cos = (abs(base) ** 2 + 0.2**2 - 0.5**2) / (2 * abs(base) * 0.2)
    F = M + 0.2 * base / abs(base) * (cos - 1j * np.sqrt(1.0 - cos**2))
    assert_allclose(complex_of(motion["P"]), M + (F - M) * (0.400 / 0.720), rtol=0, atol=1e-14)
