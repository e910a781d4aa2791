"""The survey benchmark does the same work in every way."""

import pytest

from linkage.study import Box
from mechanisms.three_point_hitch import ThreePointHitch
from tests.benchmarks.bench_survey import OVER, bare, measure, timed

pytestmark = pytest.mark.slow


def test_the_plain_loop_does_the_same_work():
    over = Box.of(ThreePointHitch(), OVER).sample(256)
    found = timed(over, None, True).found
    whole = measure(ThreePointHitch(**over))
    assert all(abs(found[name] - whole[name]).max() < 1e-13 for name in found)
    assert bare(over, 100) > 0.0
