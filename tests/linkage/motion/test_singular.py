"""Next to dead points: what the exact and the numerical ratio promise, against 50 digits."""

import math
import warnings

import mpmath
import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal

from linkage import (
    LEFT,
    AssemblyError,
    Crank,
    Dyad,
    Ground,
    Guide,
    GuideCross,
    Mechanism,
    OnLink,
    SingularError,
    SingularWarning,
    Stroke,
    distance,
    least,
    most,
    x,
    y,
)
from linkage.motion import dead_points
from linkage.numeric import differences as numeric
from tests.for_all import first_daily


class Lever(Mechanism):
    """A cylinder AB on a lever OB."""

    S, A, O = Stroke(0.1, 3.0), Ground(0, 0), Ground(1.0, 0)
    B = Dyad(A, O, AB=S, OB=0.3, side=LEFT)


def exact(O, AB, OB):
    """Return dB/dS and d2B/dS2 from the circles' intersection in 50 digits."""
    with mpmath.workdps(50):
        x, y, p, q = map(mpmath.mpf, (*O, AB, OB))
        base = x * x + y * y
        along = (base + p * p - q * q) / 2
        square = p * p * base - along * along
        if square <= 0:
            return None
        height = mpmath.sqrt(square)
        rise = (p * base - along * p) / height
        bend = (base - p * p - along - rise * rise) / height
        return [np.array([float((x * a - y * h) / base), float((y * a + x * h) / base)]) for a, h in ((p, rise), (1, bend))]


@settings(max_examples=25, deadline=None)
@given(st.floats(-1, 1), st.floats(-1, 1), st.floats(0.1, 2.0), st.floats(-12.5, -3.0), st.booleans())
@example(1.0, -8.6e-17, 1.125, -11.3125, True)
def test_exact_ratio_keeps_to_its_estimate_next_to_a_dead_point(x, y, OB, away, folded):
    base = math.hypot(x, y)
    AB = abs(base - OB) + 10**away if folded else base + OB - 10**away
    assume(base > 0.1 and AB > 0.05)
    motion = Lever(O=(x, y), OB=OB).at(S=AB, unreachable="nan")
    wanted = exact((x, y), AB, OB)
    assume(wanted is not None and motion.reached)
    found = dead_points.loop_conditions(motion.plan, motion._reading, {"B"})["B"]
    for order in (1, 2):
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            ratio = motion.ratio("B", order=order)
        refused = np.isnan(ratio).all()
        assert refused or found <= dead_points.REFUSE
        assert not refused or found > 0.1 * dead_points.REFUSE  # the second ratio may lose its digits a little before
        assert (len(told) == 1) == (found > dead_points.WARN and not refused)
        if not refused:
            error = np.linalg.norm(ratio - wanted[order - 1]) / np.linalg.norm(wanted[order - 1])
            assert error < (3.0 * told[0].message.estimate if told else dead_points.DOUBTFUL)


@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize("away", np.geomspace(1e-11, 1e-1, 21))
def test_numerical_ratio_keeps_to_its_estimate_or_is_refused(order, away, monkeypatch):
    estimates = []
    derivative = numeric.derivative
    monkeypatch.setattr(numeric, "derivative", lambda *given: estimates.append(derivative(*given)) or estimates[-1])
    motion = Lever().at(S=0.7 + away, unreachable="nan")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SingularWarning)
        found = motion.ratio("B", order=order, method="central")
    wanted = exact((1.0, 0.0), 0.7 + away, 0.3)[order - 1]
    if np.isnan(found).any():
        assert away < 1e-5
        with pytest.raises(SingularError), warnings.catch_warnings():
            warnings.simplefilter("ignore", SingularWarning)
            Lever().at(S=0.7 + away).ratio("B", order=order, method="central")
    else:
        assert np.linalg.norm(found - wanted) < 5 * np.linalg.norm(estimates[0][1]) + 1e-12 * np.linalg.norm(wanted)


@pytest.mark.parametrize("method", ["exact", "central"])
def test_at_the_dead_point_the_position_holds_and_the_ratio_is_refused_by_name(method):
    motion = Lever().at(S=[0.7, 1.0, 1.3])
    assert_allclose(motion["B"][:, [0, 2]], [[0.7, 1.3], [0.0, 0.0]], atol=1e-7)
    with pytest.raises(SingularError, match=r"B = Dyad\(A, O\)") as caught:
        motion.ratio("B", method=method)
    assert caught.value.mask.tolist() == [True, False, True]
    assert caught.value.motion is motion
    found = Lever().at(S=[0.7, 1.0, 1.3], unreachable="nan").ratio("B", method=method)
    assert_array_equal(np.isnan(found), [[True, False, True]] * 2)
    assert_allclose(found[:, 1], Lever().at(S=1.0).ratio("B"), rtol=1e-8)


@pytest.mark.parametrize("part", [0.0, 1e-6, 1e-4, 1e-2])
def test_one_sided_where_the_other_side_cannot_be_reached(part):
    """A cylinder whose stroke ends just before the dead point: the geometry refuses beyond it, not the stroke's ends."""
    S = 0.71 + part
    assert_allclose(Lever().at(S=S).ratio("B", method="central"), exact((1.0, 0.0), S, 0.3)[0], rtol=1e-8)


def test_ends_of_the_stroke_lose_nothing():
    class Short(Lever):
        """The whole stroke is well inside the reach."""

        S = Stroke(0.9, 1.1)

    motion = Short().sweep(21)
    assert_allclose(motion.ratio("B", method="central"), motion.ratio("B"), rtol=1e-9)


def test_a_step_of_ones_own_is_a_plain_difference():
    motion = Lever().at(S=[0.9, 1.1])
    h = 1e-3
    up, down = Lever().at(S=[0.9 + h, 1.1 + h]), Lever().at(S=[0.9 - h, 1.1 - h])
    with pytest.warns(SingularWarning, match="with step=0.001 is off by up to about 3e-06 of its greatest value"):
        assert_allclose(motion.ratio("B", method="central", step=h), (up["B"] - down["B"]) / (2 * h), rtol=1e-12)
    assert_allclose(motion.ratio("B", order=2, method="central", step=h), (up["B"] - 2 * motion["B"] + down["B"]) / h**2, rtol=1e-9)


def test_only_what_hangs_on_the_dead_point_is_refused():
    class Two(Lever):
        """A second lever, far from its dead points."""

        P = Ground(0.0, 1.0)
        C = Dyad(P, "A", PC=0.8, AC=0.5 + 0.1 * Lever.S, side=LEFT)

    motion = Two().at(S=0.7)
    assert np.isfinite(motion.ratio("C")).all()
    with pytest.raises(SingularError):
        motion.ratio("B")
    with pytest.raises(SingularError):
        motion.acceleration("B", dict(S=1.0))


def test_a_four_bar_crank_passes_its_stretched_positions():
    """The crank drives: its own stretched position is no dead point of the coupler."""

    class FourBar(Mechanism):
        """A crank-rocker."""

        phi = Stroke(0.0, 2 * np.pi)
        O, Q = Ground(0.0, 0.0), Ground(1.0, 0.0)
        A = Crank(O, OA=0.3, angle=phi)
        B = Dyad(A, Q, AB=0.9, QB=0.7, side=LEFT)

    motion = FourBar().sweep(361)
    assert_allclose(motion.ratio("B", method="central"), motion.ratio("B"), rtol=0, atol=1e-8)


def test_guides_that_get_parallel():
    class Cross(Mechanism):
        """A rail that falls parallel to another."""

        S, A = Stroke(-0.1, 0.1), Ground(0.0, 0.0)
        rail, high = Guide(A, angle=S), Guide((0.0, 1.0), angle=0.0)
        X = GuideCross(rail, high)

    with pytest.raises(AssemblyError) as caught:
        Cross().sweep(3)
    assert caught.value.mask.tolist() == [False, True, False]
    with pytest.warns(SingularWarning, match="X is near"):
        Cross().at(S=1e-5).ratio("X")


def test_a_rigid_triangle_without_height_moves_as_well_as_any():
    class Flat(Mechanism):
        """C lies on OB, given by its three sides: no loop that moves, so nothing is singular."""

        S, A, O = Stroke(0.8, 1.2), Ground(0, 0), Ground(1.0, 0)
        B = Dyad(A, O, AB=S, OB=0.5, side=LEFT)
        C = OnLink(O, B, OC=0.2, BC=0.3, side=LEFT)

    motion = Flat().sweep(5)
    assert_allclose(motion.ratio("C"), 0.4 * motion.ratio("B"), rtol=1e-6)


def test_a_derivative_of_nothing_is_nothing():
    motion = Lever().at(S=[0.9, 1.1])
    assert_allclose(motion.ratio(distance("A", "O") + 0 * Lever.S, method="central"), 0.0, atol=1e-9)
    assert_allclose(motion.ratio(distance("O", "B"), method="central"), 0.0, atol=1e-9)


@first_daily(1, "shift", [0.0937, 0.0, -0.2])
def test_a_singular_place_in_a_box_of_three_strokes_is_told_once(shift):
    """Two guides that turn are parallel along a whole surface of the box."""

    class Cross(Mechanism):
        a, b, c = Stroke(-0.5, 0.5), Stroke(-0.4, 0.5), Stroke(0.0, 0.3)
        O, A = Ground(0, 0), Ground(1, 0)
        P, Q = Crank(O, OP=0.5, angle=a + shift), Crank(A, AQ=0.5, angle=b)
        r, s = Guide(O, P), Guide(A, Q)
        X = GuideCross(r, s)
        E = Crank(X, XE=0.5, angle=c)

    verdicts = []
    for ask in (lambda m: verdicts.extend(m.verdicts()), lambda m: m.answers([most(y("E")), least(x("E"))])):
        with warnings.catch_warnings(record=True) as heard:
            warnings.simplefilter("always")
            ask(Cross())
        assert len(heard) <= 1
        assert all("X is near a dead point" in str(each.message) for each in heard)
    (told,) = [each for each in verdicts if "among what runs: no drive passes or starts there" in each.sentence]
    assert "X at a = " in told.sentence
