"""Transmission angles: of every kind of dyad against its geometry, and the least ones along each stroke."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import (
    LEFT,
    RIGHT,
    Crank,
    DefinitionError,
    Dyad,
    Ground,
    Guide,
    GuideCross,
    Link,
    Mechanism,
    OnLink,
    Pin,
    PinSlotDyad,
    SliderDyad,
    Stroke,
    YokeDyad,
    deg,
)
from mechanisms.classics.front_loader import FrontLoader
from mechanisms.classics.slider_crank import SliderCrank


class Sliders(Mechanism):
    """A crank with a dyad of every kind that has a sliding pair."""

    phi = Stroke(0, 2 * np.pi)
    O, C = Ground(0, 0), Ground(0, -0.3)
    rail, post = Guide((0.0, 0.02), angle=20 * deg), Guide((0.5, 0.6), angle=0)
    A = Crank(O, OA=0.1, angle=phi)
    B = SliderDyad(A, rail, AB=0.35, side=RIGHT)
    R = PinSlotDyad(C, A, CR=0.5, offset=0.05)
    X = YokeDyad(A, post, angle=70 * deg)
    bar = Guide(C, A)
    D = GuideCross(bar, post)


def between(u, w):
    """Return the angle between two vectors, shape (2, ...) each [rad]."""
    return np.arccos((u * w).sum(axis=0) / np.hypot(*u) / np.hypot(*w))


def test_a_slider_crank_is_measured_from_the_normal_to_its_guide():
    motion = SliderCrank().sweep(25)
    height = 0.04 * np.sin(motion.strokes["phi"]) + 0.02
    assert_allclose(np.cos(motion.transmission_angle("B")), height / 0.12, atol=1e-13)


def test_every_dyad_with_a_sliding_pair():
    motion = Sliders().sweep(25)
    A, C = motion["A"], motion["C"]
    rail, post = np.array([np.cos(20 * deg), np.sin(20 * deg)])[:, None], np.array([[1.0], [0.0]])
    expected = {
        "B": between(A - motion["B"], np.array([-rail[1], rail[0]])),
        "R": np.arccos(0.05 / motion.distance("C", "A")),  # the slot passes the pivot at 0.05 m
        "X": np.full(25, 70 * deg),
        "D": between(A - C, post),
    }
    assert motion._joints == tuple(name for name in Sliders.plan.points if name in expected)
    for name, angle in expected.items():
        assert_allclose(motion.transmission_angle(name), angle, atol=1e-12, err_msg=name)


@pytest.mark.parametrize("joint", ["B", "R", "X", "D"])
def test_its_sine_is_that_of_the_loop(joint):
    motion = Sliders().sweep(25)
    assert_allclose(np.sin(motion.transmission_angle(joint)), np.broadcast_to(np.abs(motion._loop_sines[joint]), 25), atol=1e-12)


def test_it_is_nan_where_the_pose_is_not_reached():
    motion = Sliders(OA=0.6).sweep(25, unreachable="nan")
    assert 0 < motion.reached.sum() < 25
    for joint in motion._joints:
        assert_allclose(np.isnan(motion.transmission_angle(joint)), ~motion.reached)


def test_points_without_one_are_refused_by_name():
    class Parts(Mechanism):
        phi = Stroke(0.0, 0.6)
        O, P, Q = Ground(0, 0), Ground(3, 0), Ground(1.5, 3)
        A = Crank(O, OA=0.5, angle=phi)
        body = Link("D E F", DE=1, DF=0.9, EF=0.8)
        r1, r2, r3 = Link("A D", AD=0.8), Link("P E", PE=1.0), Link("Q F", QF=1.9)
        D, E, F = Pin(near=(1.2, 0.5)), Pin(near=(2.2, 0.5)), Pin(near=(1.6, 1.3))
        M = OnLink("D", "E", DM=0.5)

    motion = Parts().sweep(3)
    with pytest.raises(DefinitionError, match=r'group1 = Group\("D E F"\) has no transmission angle, E is not.*those are: none'):
        motion.transmission_angle("E")
    with pytest.raises(DefinitionError, match=r"M = OnLink\(D, E\) has no transmission angle"):
        motion.transmission_angle("M")
    with pytest.raises(DefinitionError, match=r"A = Crank\(O\) has no transmission angle.*those are: B, R, X, D\."):
        Sliders().sweep(3).transmission_angle("A")


# -- along a stroke ------------------------------------------------------------------------------------------


def test_the_least_one_of_a_slider_crank():
    (extreme,) = SliderCrank().sweep(5).limits()["phi"].transmission
    assert extreme.joint == "B"
    assert_allclose([extreme.angle, extreme.stroke], [np.arccos(0.06 / 0.12), np.pi / 2], atol=1e-9)


def test_an_angle_that_does_not_change_is_not_listed():
    assert [each.joint for each in Sliders().sweep(5).limits()["phi"].transmission] == ["B", "R", "D"]


class Loader(Mechanism):
    """A boom, and a bucket whose cylinder stands on the boom."""

    S, S2 = Stroke(0.0, 0.60), Stroke(0.0, 0.30)
    O, A = Ground(0.0, 1.80), Ground(0.15, 0.90)
    B = Dyad(A, O, AB=0.95 + S, OB=1.10, side=RIGHT)
    T = OnLink(O, B, OT=2.60, BOT=8 * deg)
    C = OnLink(O, B, OC=1.60, BOC=15 * deg)
    D = Dyad(C, T, CD=0.70 + S2, TD=0.35, side=LEFT)


def test_each_stroke_lists_what_moves_with_it():
    limits = Loader().sweep(S=5, S2=0.1).limits()
    assert [each.joint for each in limits["S"].transmission] == ["B"]
    assert [each.joint for each in limits["S2"].transmission] == ["D"]
    loader = FrontLoader().sweep(lift=3, tilt=0.1).limits()
    assert [each.joint for each in loader["lift"].transmission] == ["L", "F", "J"]
    assert [each.joint for each in loader["tilt"].transmission] == ["T", "F", "J"]


def test_the_strokes_that_are_held_are_told():
    limits = Loader().sweep(S=5, S2=0.1).limits()
    assert str(limits).splitlines()[0] == "S: declared 0 to 600 mm, with S2 = 100 mm held"
    assert "S2: declared 0 to 300 mm, with S = 0 mm held" in str(limits)
    assert limits["S"].held == (("S2", 0.1, "m"),)


@pytest.mark.slow
def test_only_what_moves_with_a_stroke_can_cross_along_it():
    flat = Loader(TD=0.25).at(S=0.1, S2=float(Loader(TD=0.25).at(S=0.0, S2=0.1).distance("C", "T")) - 0.70 + 0.25)
    assert flat.limits()["S"].change_points == ()
