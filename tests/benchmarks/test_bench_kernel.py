"""The benchmark measures the same thing in every row."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from tests.benchmarks.bench_kernel import BASE, CASES, first_result, many_designs, measure, one_design, table


@pytest.mark.parametrize("work", [one_design(30), many_designs(5, 4)], ids=["one design", "designs"])
def test_all_cases_give_the_same_numbers(work):
    wanted = CASES["kernel: G, exact dG_y/dS"](work)()
    shape = (work.poses // len(work.stroke), len(work.stroke))
    for name, case in CASES.items():
        for part, right in zip(case(work)(), wanted, strict=False):
            assert_allclose(np.broadcast_to(part, shape), right, rtol=1e-8, err_msg=name)


def test_table_has_a_row_for_every_case():
    work = one_design(30)
    text = table(work, measure(work, 1))
    assert BASE in CASES
    assert text.count("\n") == len(CASES)


@pytest.mark.slow
def test_the_first_result_comes_without_heavy_modules():
    stages, heavy = first_result(1)
    assert heavy == []
    assert all(each > 0.0 for each in stages.values())
