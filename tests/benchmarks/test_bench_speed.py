"""The speed benchmark runs, its cases agree, and it states something for each expectation."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from tests.benchmarks import bench_speed
from tests.benchmarks.bench_speed import Cases, add_calls, add_hitch, add_points, statements
from tests.benchmarks.c_reference import has_compiler


@pytest.fixture
def cases(tmp_path, monkeypatch):
    """Every case but the peer's and Numba's, on few poses."""
    monkeypatch.setattr(bench_speed, "is_there", lambda: False)
    monkeypatch.setattr(bench_speed, "SHORT", 100)
    found = Cases()
    add_hitch(found, tmp_path, 1000)
    add_points(found, None, 1000, 20)
    add_calls(found, 1000)
    return found


def test_every_case_is_timed_and_every_expectation_looked_at(cases):
    cases.measure(1)
    assert cases.times.keys() == {*cases.runs, *cases.asked} and all(map(math.isfinite, cases.times.values()))
    said = statements(cases, 20, 1000)
    expected = [bound for _, bound, _ in said if bound]
    assert len(expected) == 19
    measured = {what for what, _, ratio in said if math.isfinite(ratio)}
    assert "NumPy: gradient over dG_y/dS" in measured
    assert ("G, dG_y/dS: NumPy over C" in measured) == has_compiler()


@pytest.mark.skipif(not has_compiler(), reason="no C compiler")
def test_c_and_numpy_do_the_same_work(cases):
    by_c = cases.runs["C: G, dG_y/dS"][0]()
    by_numpy = cases.runs["NumPy: G, dG_y/dS"][0]().values[:, 0]
    assert_allclose(by_c, by_numpy, rtol=1e-11, atol=1e-12)
    assert np.isfinite(by_c).all()
