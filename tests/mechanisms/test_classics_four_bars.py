"""Four-bars of every Grashof kind, and three that draw one curve, against Freudenstein's equation and complex numbers."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import AssemblyError
from mechanisms.classics.four_bar import DoubleRocker, DragLink, FourBar, Parallelogram, TripleRocker
from mechanisms.classics.roberts_cognates import RobertsCognates
from tests.for_all import for_all

KINDS = for_all("kind", [FourBar, DragLink, DoubleRocker, TripleRocker, Parallelogram])


def lengths(design):
    """Return crank a, coupler b, rocker c and frame d [m]."""
    return design["OA"], design["AB"], design["CB"], design["C"][0]


def complex_of(place):
    return place[0] + 1j * place[1]


@KINDS
def test_freudensteins_equation(kind):
    motion = kind().sweep(73)
    a, b, c, d = lengths(kind())
    phi, psi = motion.strokes["phi"], motion["psi"]
    k1, k2, k3 = d / a, d / c, (a**2 - b**2 + c**2 + d**2) / (2 * a * c)
    assert_allclose(k1 * np.cos(psi) - k2 * np.cos(phi) + k3, np.cos(phi - psi), rtol=0, atol=1e-13)


@KINDS
def test_ratio_is_the_angular_velocity_ratio(kind):
    """omega4 / omega2 = a sin(theta3 - theta2) / (c sin(theta3 - theta4)), Norton (6.18b)."""
    motion = kind().sweep(73)
    a, _, c, _ = lengths(kind())
    phi, psi, theta = motion.strokes["phi"], motion["psi"], motion["theta"]
    assert_allclose(motion.ratio("psi"), a * np.sin(theta - phi) / (c * np.sin(theta - psi)), rtol=1e-10, atol=1e-13)


@KINDS
def test_loop_closes_in_complex_numbers(kind):
    motion = kind().sweep(73)
    a, b, c, d = lengths(kind())
    turned = [np.exp(1j * angle) for angle in (motion.strokes["phi"], motion["theta"], motion["psi"])]
    assert_allclose(a * turned[0] + b * turned[1] - c * turned[2], d, rtol=0, atol=1e-15)
    P = a * turned[0] + kind()["AP"] * turned[1] * np.exp(1j * kind()["BAP"])
    assert_allclose(complex_of(motion["P"]), P, rtol=0, atol=1e-15)


def test_nortons_example():
    """Example 4-1, worked with rounded coefficients: at 40 degrees the open pose has theta4 = 57.33, theta3 = 20.30 degrees."""
    motion = FourBar().at(phi=np.radians(40.0))
    assert_allclose(np.degrees([motion["psi"], motion["theta"]]), [57.33, 20.30], rtol=0, atol=0.01)


def test_crank_rocker_turns_and_swings():
    """The rocker's extremes are where crank and coupler are in line: a triangle of sides b -+ a, c, d."""
    a, b, c, d = lengths(FourBar())
    motion = FourBar().sweep(7201)
    assert_allclose(motion["psi"][-1], motion["psi"][0], atol=1e-14)
    swing = [np.pi - np.arccos((c**2 + d**2 - side**2) / (2 * c * d)) for side in (b - a, b + a)]
    inner = np.pi - np.array(swing)
    assert_allclose([motion["psi"].min(), motion["psi"].max()], sorted(np.pi - inner), atol=1e-6)


def test_drag_link_turns_both_ways():
    motion = DragLink().sweep(73)
    assert_allclose(motion["psi"][-1] - motion["psi"][0], 2 * np.pi, rtol=1e-14)
    assert (motion.ratio("psi") > 0.0).all()
    assert_allclose(motion["B"][:, -1], motion["B"][:, 0], atol=1e-15)


@pytest.mark.parametrize("kind", [DoubleRocker, TripleRocker])
def test_rocker_stops_where_coupler_and_rocker_are_in_line(kind):
    a, b, c, d = lengths(kind())
    ends = [np.arccos((a**2 + d**2 - side**2) / (2 * a * d)) for side in (b + c, abs(b - c)) if abs(a - d) < side < a + d]
    assert len(ends) == (2 if kind is DoubleRocker else 1)
    for end in ends:
        inside = -1e-6 if end == max(ends) else 1e-6
        assert np.isfinite(kind().at(phi=end + inside)["B"]).all()
        with pytest.raises(AssemblyError, match="mm short"):
            kind().at(phi=end - inside)


def test_parallelogram_stays_parallel():
    motion = Parallelogram().sweep(73)
    assert_allclose(motion["psi"], motion.strokes["phi"], rtol=1e-14)
    assert_allclose(motion["theta"], 0.0, atol=1e-14)
    assert_allclose(motion.ratio("psi"), 1.0, rtol=1e-12)
    assert_allclose(motion.ratio("psi", order=2), 0.0, atol=1e-10)


# -- cognates -------------------------------------------------------------------------------------------------


def test_three_cognates_draw_one_curve():
    motion = RobertsCognates().sweep(181)
    assert np.ptp(motion["P"], axis=1).min() > 0.03
    assert_allclose(motion["Q"], motion["P"], rtol=0, atol=1e-12)
    assert_allclose(motion["R"], motion["P"], rtol=0, atol=1e-12)


def test_cognates_of_any_coupler_point():
    random = np.random.default_rng(3)
    design = RobertsCognates(k=random.uniform(0.2, 0.9, 40), delta=random.uniform(0.1, 1.2, 40), coupler=random.uniform(0.115, 0.13, 40))
    motion = design.sweep(31)
    assert_allclose(motion["Q"], motion["P"], rtol=0, atol=1e-9)
    assert_allclose(motion["R"], motion["P"], rtol=0, atol=1e-9)


def test_cognates_are_other_linkages():
    """The curve is one, the links are not: no two of the three have the same lengths."""
    found = RobertsCognates().sweep(3)
    frames = [float(found.distance(*pair)[0]) for pair in ("UV", "UW", "WV")]
    cranks = [float(found.distance(*pair)[0]) for pair in ("UA", "UC", "WE")]
    assert len({round(value, 6) for value in frames}) == len({round(value, 6) for value in cranks}) == 3


def test_cognates_share_angular_velocities():
    """Roberts: the second's coupler and the third's crank turn with the first crank, the third's other arm with the first coupler."""
    motion = RobertsCognates().sweep(31)
    one = np.ones(31)
    assert_allclose(np.gradient(motion.angle("C", "D"), motion.strokes["phi"]), one, rtol=1e-9)
    assert_allclose(motion.angle("V", "F") - motion.angle("A", "B"), (motion.angle("V", "F") - motion.angle("A", "B"))[0], rtol=1e-12)
    assert_allclose(motion.angle("W", "D") - motion.angle("V", "B"), (motion.angle("W", "D") - motion.angle("V", "B"))[0], rtol=1e-12)
