"""Cranks, sliders and slots against their closed forms."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from mechanisms.classics.inverted_slider_crank import InvertedSliderCrank
from mechanisms.classics.scotch_yoke import ScotchYoke
from mechanisms.classics.slider_crank import SliderCrank
from mechanisms.classics.toggle_press import TogglePress
from mechanisms.classics.trammel import Trammel


def slider(phi, a=0.040, b=0.120, c=-0.020):
    """Return the slider [m], its first and its second derivative by the crank angle, by hand."""
    h = a * np.sin(phi) - c
    root = np.sqrt(b**2 - h**2)
    first, second = a * np.cos(phi), -a * np.sin(phi)
    d2 = -a * np.cos(phi) - (first**2 + h * second) / root - (h * first) ** 2 / root**3
    return a * np.cos(phi) + root, -a * np.sin(phi) - h * first / root, d2


def test_slider_crank_is_its_formula():
    motion = SliderCrank().sweep(181)
    place, first, second = slider(motion.strokes["phi"])
    assert_allclose(motion["d"], place, rtol=1e-14)
    assert_allclose(motion.ratio("d"), first, rtol=1e-12, atol=1e-15)
    assert_allclose(motion.ratio("d", order=2), second, rtol=1e-11, atol=1e-14)
    assert_allclose(motion.y("B"), -0.020, rtol=1e-14)


def test_nortons_example():
    """Example 4-2: at 60 degrees the open pose has d = 126.84 mm."""
    assert f"{float(SliderCrank().at(phi=np.radians(60.0))['d']) * 1e3:.2f}" == "126.84"


@pytest.mark.parametrize("offset", [-0.03, -0.01, 0.0, 0.02])
def test_slider_cranks_travel(offset):
    design = SliderCrank(**{"rail.y": offset})
    b, a = design["AB"], design["OA"]
    ends = [np.arcsin(offset / (b + a)), np.pi + np.arcsin(offset / (b - a))]
    travel = np.sqrt((b + a) ** 2 - offset**2) - np.sqrt((b - a) ** 2 - offset**2)
    motion = design.at(phi=ends)
    assert_allclose(motion["d"][0] - motion["d"][1], travel, rtol=1e-14)
    assert_allclose(motion.ratio("d"), 0.0, atol=1e-15)


def test_batch_of_slider_cranks():
    offsets = np.linspace(-0.03, 0.03, 7)
    motion = SliderCrank(**{"rail.y": offsets}).sweep(37)
    assert motion["d"].shape == (7, 37)
    for row, c in zip(motion["d"], offsets, strict=True):
        assert_allclose(row, slider(motion.strokes["phi"], c=c)[0], rtol=1e-13)


def test_quick_return():
    """The lever's swing is 2 arcsin(a / d); cutting takes pi + swing of the crank, the return pi - swing."""
    design = InvertedSliderCrank()
    a, d = design["OA"], 0.300
    swing = 2 * np.arcsin(a / d)
    motion = design.at(phi=[-swing / 2, np.pi + swing / 2])
    assert_allclose(motion.ratio("psi"), 0.0, atol=1e-14)
    assert_allclose(motion["psi"][1] - motion["psi"][0], swing, rtol=1e-13)
    cutting = design.at(phi=np.linspace(-swing / 2, np.pi + swing / 2, 101)[1:-1])
    back = design.at(phi=np.linspace(np.pi + swing / 2, 2 * np.pi - swing / 2, 101)[1:-1])
    assert (cutting.ratio("psi") > 0.0).all() and (back.ratio("psi") < 0.0).all()
    assert (cutting.ratio("ram") < 0.0).all() and (back.ratio("ram") > 0.0).all()


def test_lever_is_its_formula():
    motion = InvertedSliderCrank().sweep(181)
    phi, a, d = motion.strokes["phi"], 0.120, 0.300
    psi = np.arctan2(d + a * np.sin(phi), a * np.cos(phi))
    assert_allclose(motion["psi"], psi, rtol=1e-13)
    R = 0.480 * np.array([np.cos(psi), np.sin(psi)]) + [[0.0], [-0.300]]
    assert_allclose(motion["ram"], R[0] - np.sqrt(0.180**2 - (0.200 - R[1]) ** 2), rtol=1e-12)
    ratio = a * (a + d * np.sin(phi)) / (a**2 + d**2 + 2 * a * d * np.sin(phi))
    assert_allclose(motion.ratio("psi"), ratio, rtol=1e-12, atol=1e-15)


def test_scotch_yoke_is_harmonic():
    motion = ScotchYoke().sweep(181)
    phi, r = motion.strokes["phi"], 0.050
    assert_allclose(motion["travel"], r * np.cos(phi), rtol=0, atol=1e-16)
    assert_allclose(motion.ratio("travel"), -r * np.sin(phi), rtol=0, atol=1e-15)
    assert_allclose(motion.ratio("travel", order=2), -motion["travel"], rtol=0, atol=1e-15)
    assert_allclose(motion.y("X"), 0.0, atol=1e-16)


def test_trammel_draws_an_ellipse():
    motion = Trammel().sweep(101)
    (x, y), p = motion["P"], Trammel()["XP"]
    assert_allclose((x / (p - 0.100)) ** 2 + (y / p) ** 2, 1.0, rtol=1e-13)
    assert np.ptp(x) > 0.09 and np.ptp(y) > 0.06


# -- toggle press ---------------------------------------------------------------------------------------------


def press(S):
    """Return the ram's height and its derivative by the stroke, from the two triangles by hand."""
    c = np.array([-0.600, 0.500]) - np.array([0.0, 0.800])
    far, length, arm = np.hypot(*c), 0.450 + S, 0.300
    gamma = np.arccos((arm**2 + far**2 - length**2) / (2 * arm * far))      # angle A O C
    alpha = np.arctan2(c[1], c[0]) + gamma + np.pi / 2                     # of OA from the vertical
    height = 0.800 - 2 * arm * np.cos(alpha)
    return height, 2 * arm * np.sin(alpha) * length / (arm * far * np.sin(gamma)), alpha


def test_press_is_its_triangles():
    motion = TogglePress().sweep(101)
    height, slope, _ = press(motion.strokes["S"])
    assert_allclose(motion.y("B"), height, rtol=1e-12)
    assert_allclose(motion.ratio("B")[1], slope, rtol=1e-9)
    assert_allclose(motion["travel"], 0.200 - height, rtol=0, atol=1e-13)
    assert_allclose(motion.x("B"), 0.0, atol=1e-15)


def test_mechanical_advantage_at_the_toggle():
    """By virtual work the thrust is magnified by dS / d(travel): as 1 / (2 tan alpha) for the sideways part, without bound."""
    S = TogglePress().sweep(101).strokes["S"]
    motion = TogglePress().at(S=S)
    sideways = motion.ratio("A")[0]                        # of A by the stroke
    gain = sideways / motion.ratio("travel")
    assert_allclose(gain, 1.0 / (2 * np.tan(np.abs(press(S)[2]))), rtol=1e-8)
    assert (np.diff(gain) > 0.0).all() and gain[0] < 1.0 and gain[-1] > 25.0


def test_the_presss_cylinder_carries_what_the_toggle_leaves_of_the_load():
    """2 F tan(alpha) sideways, and a little more as the cylinder leans and loads one arm more than the other."""
    motion = TogglePress().sweep(101)
    alpha = np.abs(press(motion.strokes["S"])[2])
    lean = np.arctan2(motion.y("A") - 0.500, motion.x("A") + 0.600)
    found = TogglePress.push.thrust(motion)
    assert_allclose(found, 2 * 25e3 * np.tan(alpha) / (np.cos(lean) - np.tan(alpha) * np.sin(lean)), rtol=1e-10)
    assert found[0] > 30e3 and found[-1] < 1e3
    assert [verdict for verdict in TogglePress().verdicts() if verdict.startswith("FAIL")] == []


def test_press_plan_is_two_dyads():
    steps = [type(TogglePress.plan.members[name]).__name__ for name in "AB"]
    assert steps == ["Dyad", "SliderDyad"]
