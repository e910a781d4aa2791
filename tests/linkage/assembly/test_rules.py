"""The rules by which groups are followed, each by what it does to known numbers: lines, parabolas, branches, ends."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage.assembly.rules import goes_on, interpolated, newton_ended, predicted, step_judged


@pytest.fixture(autouse=True)
def as_while_following():
    """Divide by zero without a word, as the rules are run: a choice follows."""
    with np.errstate(all="ignore"):
        yield


def parabola(t):
    return 0.3 - 1.1 * t + 0.7 * t**2


def test_a_prediction_is_the_line_and_newton_begins_on_the_parabola():
    places = (0.5, 0.3, 0.2)
    pins = [[parabola(t)] for t in places]
    t, line, start = predicted(0.25, 9.0, places, pins)
    slope = (parabola(0.5) - parabola(0.3)) / 0.2
    assert_allclose([t, *line], [0.75, parabola(0.5) + 0.25 * slope])
    assert_allclose(start, [parabola(0.75)], rtol=1e-14)


def test_a_prediction_stops_at_its_limit_and_begins_with_what_is_known():
    t, line, start = predicted(0.25, 0.6, (0.5, 0.3, 0.2), [[parabola(t)] for t in (0.5, 0.3, 0.2)])
    assert t == 0.6
    assert_allclose(start, [parabola(0.6)], rtol=1e-14)
    t, line, start = predicted(0.1, 9.0, (0.0, 0.0, 0.0), [[2.0], [2.0], [2.0]])  # at the sketch alone
    assert (t, line, start) == (0.1, [2.0], [2.0])
    t, line, start = predicted(0.1, 9.0, (0.2, 0.0, 0.0), [[2.2], [2.0], [2.0]])  # two places: the line
    assert_allclose([t, *line, *start], [0.3, 2.3, 2.3])


@pytest.mark.parametrize("place", [0.5, 0.53, 0.6, 0.7])
def test_between_two_places_a_parabola_is_exact(place):
    places = (0.3, 0.5, 0.7)
    found, most = interpolated(place, places, [[parabola(t)] for t in places], (0.4, 0.2), (2.0, 3.0))
    assert_allclose(found, [parabola(place)], rtol=1e-14)
    assert_allclose(most, (0.1 * 0.2 + 1e-13) * 2.0)
    found, _ = interpolated(0.6, (0.5, 0.5, 0.7), [[1.0], [1.0], [3.0]], (1.0, 1.0), (1.0, 1.0))  # nothing before: a line
    assert_allclose(found, [2.0])


def test_a_step_is_taken_near_its_prediction_and_grows():
    good, step = step_judged(0.1, 0.5, 1.0, 1.0, 0.0, 0.5, 1.0)
    assert (good, step) == (1.0, 0.2)  # twice as long at most
    good, step = step_judged(0.1, 0.5, 0.15, 1.0, 0.0, 0.5, 1.0)
    assert (good, step) == (1.0, 0.15)  # nor longer than the largest
    miss = 0.1 * 0.5 / 1.44  # excess 1.2: what is taken next is 0.84 of this one
    good, step = step_judged(0.1, 0.5, 1.0, 1.0, miss, 0.5, 1.0)
    assert good == 1.0
    assert_allclose(step, 0.1 * 0.7 * 1.2, rtol=1e-9)
    good, step = step_judged(0.1, 0.5, 1.0, 1.0, 4.0 * 0.1 * 0.5, 0.5, 1.0)  # twice too far: again, with a third of it
    assert good == 0.0
    assert_allclose(step, 0.1 * 0.35, rtol=1e-9)


def test_a_step_shrinks_before_a_singular_pose():
    good, step = step_judged(0.1, 0.5, 1.0, 1.0, 0.0, 0.4, 1.0)
    assert good == 1.0
    assert_allclose(step, 0.45 * 0.4 / ((0.5 - 0.4) / 0.1))
    good, step = step_judged(0.1, 0.5, 1.0, 1.0, 0.0, 0.24, 1.0)  # the clearance more than halved
    assert (good, step) == (0.0, 0.05)


def test_another_branch_and_no_solution_are_tried_again_with_shorter_steps():
    assert step_judged(0.1, 0.5, 1.0, 1.0, 0.0, -0.5, 1.0) == (0.0, pytest.approx(0.03))
    assert step_judged(0.1, 0.5, 1.0, 0.0, 0.0, 0.5, 1.0) == (0.0, pytest.approx(0.03))


def test_a_way_goes_on_while_it_is_clear_and_leads_somewhere():
    assert goes_on(0.5, 0.2, 0.1, 1.0) == 1.0
    assert goes_on(0.5, -0.2, 0.1, 1.0) == 1.0
    assert goes_on(0.5, 0.9e-6, 0.1, 1.0) == 0.0  # touches
    assert goes_on(0.5, 1e-6, 0.1, 1.0) == 1.0
    assert goes_on(0.5, 0.2, 1e-12, 1.0) == 0.0  # no step left
    assert goes_on(1e6, 0.2, 1e-11, 1.0) == 0.0  # one that rounding swallows


def test_newton_has_ended_where_the_next_step_would_be_rounding():
    assert newton_ended(1e-9, 1e-5, 1.0) == (1.0, 1.0)  # the next is 1e-9 * (1e-4)^2
    assert newton_ended(1e-6, 1e-3, 1.0)[0] == 0.0
    assert newton_ended(1e-9, 1e-5, 1e-4) == (0.0, 0.0)  # of a smaller group
    assert newton_ended(1e-8, 2e-7, 1.0) == (0.0, 1.0)  # near, and slowly
    assert newton_ended(5e-12, 1e300, 1.0) == (1.0, 1.0)  # the first step: nothing is known of the last
    assert newton_ended(np.nan, 1.0, 1.0) == (1.0, 0.0)  # ended, at no solution
    assert newton_ended(np.inf, 1.0, 1.0) == (0.0, 0.0)
