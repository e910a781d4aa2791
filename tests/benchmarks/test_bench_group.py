"""The benchmark of groups measures the same thing three times."""

import pytest

from tests.benchmarks.bench_group import measured

pytestmark = pytest.mark.slow


def test_all_find_the_same_pins():
    times, apart = measured(rounds=1, poses=300, sample=60)
    assert apart < 1e-8  # what fsolve promises
    assert len(times) == 3 and all(each > 0.0 for each in times)
