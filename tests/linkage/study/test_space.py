"""The range of a dimension that is varied, in steps."""

import pytest

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
