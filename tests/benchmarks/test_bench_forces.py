"""The benchmark of forces measures the same thing in every way."""

import pytest

from tests.benchmarks.bench_forces import answered, answers, measured, table

pytestmark = pytest.mark.slow


def test_all_find_the_same_forces():
    found, apart = measured(rounds=1, poses=400)
    assert len(apart) == 4 and len(found) == 12
    assert apart["drive force"] < 1e-12 and apart["pin force"] < 1e-10
    assert max(apart.values()) < 1e-6  # differences of designs
    assert all(each > 0.0 for _, each in found) and "gradient, numba" in table(found)


def test_every_question_is_answered():
    found = answered(rounds=1, poses=40)
    assert len(found) == 10 and all(each > 0.0 for _, each in found)
    text = answers(found)
    for name in ("Excavator", "friction at every pin", "cylinder.thrust", "lift_verdicts"):
        assert name in text
