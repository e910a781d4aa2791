"""The benchmark of tolerances runs, and its machines are what they should be."""

import pytest

from tests.benchmarks.bench_tolerances import TASKS, timed

pytestmark = pytest.mark.slow


@pytest.mark.parametrize("task", TASKS)
def test_every_task_is_timed(task):
    found, clock, processor = timed(task, 2000, 2, "numpy")
    assert clock > 0.0 and processor > 0.0 and found.count == 2000 and found.assembled == 1.0
    assert not found.conditions or 0.9 < found.yield_rate < 1.0
