"""The range of a dimension that is varied, in steps; the points of a box."""

import subprocess
import sys

import numpy as np
import pytest
from scipy.stats import qmc

from linkage.study.box import POLYNOMIALS, unit_points
from linkage.study.space import Varied
from tests.for_all import for_all


@for_all(
    ("value", "about"),
    [
        (0.1, (0.1,)), (0.12, (0.12,)), (0.113, (0.11, 0.12)), (0.2, (0.2,)), (0.05, (0.1,)), (0.3, (0.2,)),
        (0.14 + 1e-14, (0.14,)), (0.14 - 1e-14, (0.14,)),
    ],
)  # fmt: skip
def test_a_value_is_between_two_steps_or_on_one(value, about):
    varied = Varied("OB", "", 1.0, 0.1, 0.2, 0.01, "mm")
    assert varied.steps == 11
    assert varied.stepped(value) == pytest.approx(about, abs=1e-12)
    assert len(varied.stepped(value)) == len(about)


def test_a_range_without_steps_leaves_a_value_alone():
    varied = Varied("OB", "", 1.0, 0.1, 0.2, None, "mm")
    assert (varied.steps, varied.stepped(0.1234)) == (1, (0.1234,))


def test_sobol_points_are_those_of_scipy():
    """Points of a box are bit by bit those of SciPy, whose room of statistics takes longer to load than a small search."""
    for k in (1, 2, 9, len(POLYNOMIALS), len(POLYNOMIALS) + 1):
        for count in (1, 2, 7, 64, 1000):
            engine, whole = qmc.Sobol(k, seed=np.random.default_rng(3)), 1 << (count.bit_length() - 1)
            expected = np.concatenate([engine.random(whole), engine.random(count - whole)])
            assert np.array_equal(unit_points(count, k, "sobol", 3), expected), (k, count)


def test_a_small_search_does_without_scipys_statistics():
    """A box with fewer ranges than are known here asks SciPy for nothing."""
    code = "import sys; from linkage.study.box import unit_points; unit_points(64, 5, 'sobol', 0); assert 'scipy' not in sys.modules"
    subprocess.run([sys.executable, "-c", code], check=True)
