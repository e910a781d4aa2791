"""The survey benchmark runs, and every executor gives the same results."""

import pytest

from linkage.study import Box
from mechanisms.three_point_hitch import ThreePointHitch
from tests.benchmarks import bench_survey
from tests.benchmarks.bench_survey import OVER, bare, executors, measure, results, timed

pytestmark = pytest.mark.slow


def test_every_executor_is_timed(monkeypatch):
    named = executors(2)
    assert {"one process", "2 processes"} <= set(named)
    monkeypatch.setattr(bench_survey, "executors", lambda workers: {name: named[name] for name in ("one process", "2 processes")})
    found = results(500, 2, 1)
    assert all(took.batches > 0.0 and took.clock > 0.0 and "ns a pose" in str(took) for took in found.values())


def test_the_plain_loop_does_the_same_work():
    over = Box.of(ThreePointHitch(), OVER).sample(256)
    found = timed(over, None, True).found
    whole = measure(ThreePointHitch(**over))
    assert all(abs(found[name] - whole[name]).max() < 1e-13 for name in found)
    assert bare(over, 100) > 0.0
