"""The search in a box: what is higher than all else is found where it holds a box of 1/4096, 1/128, 1/32 of each of 1, 2, 3 strokes."""

import numpy as np
import pytest

from linkage.motion import highest
from linkage.numeric.box import highest_in
from tests.for_all import first_daily, for_all
from tests.linkage.numeric.box_cases import InUnitBox, case, waves

ALL = range(10_200)
SLOW = pytest.mark.slow


def on_line(f):
    """Return the highest value of a function of places (..., 1), and the place, from 4097 samples of a single stroke."""

    def look(leg, t):
        t = np.atleast_2d(t)
        return f(t[..., None])[None], np.ones(t.shape, bool)

    found = highest(look, (4096,))
    return found.value.item(), found.t.reshape(1)


def found_by(k, f):
    """Return the highest value of a function of places (..., k) of the unit box, and the place."""
    if k == 1:
        return on_line(f)
    value, unit, _ = highest_in(InUnitBox(k, f))
    return value.item(), unit[0, 0]


def check_case(seed, k):
    """Check that a top is found, and that the place told has the value told."""
    one = case(seed, k)
    value, unit = found_by(k, one.f)
    assert value >= one.top - one.close * one.span, (one.kind, (one.top - value) / one.span)
    assert np.all((unit >= 0.0) & (unit <= 1.0)) and one.f(unit) == pytest.approx(value, abs=1e-12 * one.span)


@for_all("k", [1, 2], slow=[3])
def test_tops_that_are_known(k):
    """One of each kind among the first sixty."""
    found = {case(seed, k).kind: seed for seed in reversed(range(60))}
    assert len(found) == 11
    for seed in found.values():
        check_case(seed, k)


@SLOW
@pytest.mark.parametrize("k", [1, 2, 3])
def test_tops_that_are_known_at_length(k):
    for seed in ALL:
        check_case(seed, k)


TURNS = {1: 100.0, 2: 8.0, 3: 4.0}  # of a wave over each stroke, at most


def check_waves(seed, k, poses):
    """Check that no random pose betters what is found, of a sum of waves, of its lowest, and of a kink in it."""
    rng = np.random.default_rng([seed, k, 7])
    wave = waves(rng, k, TURNS[k])
    at = rng.uniform(size=(poses, k))
    values = wave(at)
    for sense in (1.0, -1.0):
        value, _ = found_by(k, lambda x, sense=sense: sense * wave(x))
        assert (sense * values).max() <= value + 1e-6 * np.ptp(values)


@for_all("seed", range(2), slow=range(2, 60))
@for_all("k", [1, 2, 3])
def test_no_random_pose_betters_a_sum_of_waves(k, seed):
    check_waves(seed, k, 10_000)


@SLOW
@pytest.mark.parametrize("k", [1, 2, 3])
def test_none_of_a_million_random_poses_betters_a_sum_of_waves(k):
    for seed in range(60):
        check_waves(seed, k, 1_000_000)


def bell(top, matrix):
    """Return a bell about a place, skewed by a matrix."""
    return lambda x: np.exp(-np.einsum("...i,ij,...j", x - top, matrix, x - top))


@pytest.mark.parametrize("k", [4, 5, 6])
def test_more_strokes(k):
    """A skewed bell, and a plane: its top is in a corner."""
    for seed in range(2):
        rng = np.random.default_rng([seed, k])
        top, turn = rng.uniform(size=k), np.linalg.qr(rng.normal(size=(k, k)))[0]
        matrix = turn @ np.diag(rng.uniform(0.5, 3.0, k)) @ turn.T
        value, unit = found_by(k, bell(top, matrix))
        assert value == pytest.approx(1.0, abs=1e-9)
        np.testing.assert_allclose(unit, top, atol=1e-4)
        slope = rng.normal(size=k)
        value, unit = found_by(k, lambda x, slope=slope: x @ slope)
        assert value == pytest.approx(np.maximum(slope, 0.0).sum(), abs=1e-12)
        np.testing.assert_array_equal(unit, slope > 0.0)


@first_daily(0, "first", [0, 10, 20, 30])
@first_daily(1, "k", [2, 3])
def test_an_answer_does_not_follow_from_what_else_is_asked(k, first):
    cases = [case(seed, k) for seed in range(first, first + 10)]
    together = highest_in(InUnitBox(k, *(each.f for each in cases)))[0][:, 0]
    alone = np.array([found_by(k, each.f)[0] for each in cases])
    close = np.array([min(each.close, 1e-7) * each.span for each in cases])
    assert np.all(np.abs(together - alone) <= close)


def test_functions_together_cost_few_poses():
    """Sixty sums of waves in three strokes: fewer poses than twice the grid; sixty planes ask next to nothing beyond it."""
    rng = np.random.default_rng(1)
    box = InUnitBox(3, *(waves(rng, 3, 0.5) for _ in range(60)))
    highest_in(box)
    assert box.count < 2 * box.side**3
    slopes = rng.normal(size=(60, 3))
    box = InUnitBox(3, *(lambda x, slope=slope: x @ slope for slope in slopes))
    highest_in(box)
    assert box.count < 1.05 * box.side**3


def test_what_is_the_same_everywhere_is_not_followed_along_the_border():
    """Where half of a box is missing, each such place costs as much as the way to it: what never changes asks for it once."""
    poses = {}
    for slope in (0.0, 1.0):
        box = InUnitBox(2, lambda x, slope=slope: np.where(x.sum(axis=-1) < 1.03, 2.0 + slope * x[..., 0], np.nan))
        value, _, _ = highest_in(box)
        assert value.item() == pytest.approx(2.0 + slope, abs=1e-9)
        poses[slope] = box.count - box.side**2
    assert poses[0.0] < 0.6 * poses[1.0]


@for_all("seed", range(1), slow=range(1, 30))
@for_all("k", [2, 3])
def test_a_box_turned_and_mirrored_is_the_same(k, seed):
    one = case(seed, k)
    value, _ = found_by(k, one.f)
    turned, _ = found_by(k, lambda x: one.f(x[..., ::-1]))
    mirrored, _ = found_by(k, lambda x: one.f(1.0 - x))
    assert turned == pytest.approx(value, abs=2.0 * one.close * one.span)
    assert mirrored == pytest.approx(value, abs=2.0 * one.close * one.span)
