"""A function of floats over several strokes: each value is its own stroke's, in order or by name, whatever was asked before."""

from itertools import combinations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import AssemblyError, Crank, DefinitionError, Dyad, Ground, Mechanism, OnGuide, SingularWarning, Stroke, ratio
from linkage.steps import Guide
from tests.for_all import for_all


class Three(Mechanism):
    """Three strokes in one order; points that hang on one, two and three of them in others."""

    u, v, w = Stroke(0.1, 0.6), Stroke(0.2, 0.5), Stroke(0.3, 1.0)
    O, C = Ground(0.0, 0.0), Ground(1.0, 0.1)
    A = Crank(O, OA=0.4, angle=w)
    D = Crank(C, CD=0.3, angle=1.5 + u)
    rail = Guide((0.2, -0.6), angle=0.1)
    E = OnGuide(rail, at=v)
    X = Dyad(A, D, AX=0.8, DX=0.9, side="left")
    Y = Dyad(E, A, EY=0.9, AY=0.7, side="right")
    Z = Dyad(X, Y, XZ=0.9, YZ=1.0, side="left")


POSES = [(0.15, 0.25, 0.9), (0.55, 0.45, 0.35), (0.3, 0.2, 0.6)]
POINTS = "DEAXYZ"


@for_all("asked", [*POINTS, *combinations(POINTS, 2), tuple(POINTS)], ids="".join)
def test_each_value_is_its_own_strokes(asked):
    """u, v, w in order, by name in any order, and the first in order with the rest by name."""
    f = Three().function(list(asked))
    for u, v, w in POSES:
        motion = Three().at(u=u, v=v, w=w)
        wanted = np.concatenate([motion[point] for point in asked])
        assert_allclose(f(u, v, w), wanted, rtol=0, atol=1e-14)
        assert f(w=w, u=u, v=v) == f(u, w=w, v=v) == f(u, v, w=w) == f(u, v, w)


@pytest.mark.parametrize("stroke", "uvw")
def test_ratios_by_each_stroke(stroke):
    f = Three().function(["Z", ratio("Z", wrt=stroke)])
    for u, v, w in POSES:
        motion = Three().at(u=u, v=v, w=w)
        assert_allclose(f(u, v, w), [*motion["Z"], *motion.ratio("Z", wrt=stroke)], rtol=1e-12)


def test_design_is_its_own():
    for settings in ({}, {"AX": 0.7}, {"OA": 0.45, "EY": 0.95}):
        f = Three(**settings).function(["Z"])
        assert_allclose(f(*POSES[0]), Three(**settings).at(u=0.15, v=0.25, w=0.9)["Z"], rtol=1e-14)


def test_refused_pose_leaves_no_trace():
    f = Three(AX=0.3).function(["X", "E"])
    good = f(*POSES[0])
    with pytest.raises(AssemblyError, match="X = Dyad"):
        f(3.0, 0.3, 4.0)
    assert f(*POSES[0]) == good
    assert_allclose(Three(AX=0.3).function(["E"])(3.0, 0.3, 4.0), Three().at(u=0.2, v=0.3, w=0.4)["E"]), "E asks nothing of X"


@pytest.mark.parametrize("asked", [["E"], ["D"], ["X", "E"], ["Z"]], ids=str)
def test_strokes_are_asked_whether_they_matter_or_not(asked):
    """E follows v alone, but a pose has three strokes: none is left out, added or no number, in silence."""
    f = Three().function(asked)
    for values in ((0.3,), (0.3, 0.3), (0.3,) * 4):
        with pytest.raises(DefinitionError, match=r"one value for each stroke is expected: u, v, w|is not given"):
            f(*values)
    for place in range(3):
        for wrong in (float("nan"), float("inf"), -float("inf"), "0.3", None, [0.3, 0.3], np.zeros(0)):
            values = [0.3, 0.3, 0.6]
            values[place] = wrong
            with pytest.raises(DefinitionError, match="one finite number is expected"):
                f(*values)


class Toggle(Mechanism):
    """Two links that come into line at phi = 0."""

    phi = Stroke(0.1, 1.0)
    O, C = Ground(0.0, 0.0), Ground(1.0, 0.0)
    A = Crank(C, CA=0.2, angle=phi)
    X = Dyad(O, A, OX=0.5, AX=0.7, side="left")


def test_near_a_dead_point_it_warns_as_a_motion_does():
    f, near = Toggle().function(["X", ratio("X")]), 2e-4
    with pytest.warns(SingularWarning) as told:
        found = f(near)
    with pytest.warns(SingularWarning) as by_motion:
        wanted = Toggle().at(phi=near).ratio("X")
    assert_allclose(found[2:], wanted, rtol=1e-6)
    assert len(told) == len(by_motion) == 1
