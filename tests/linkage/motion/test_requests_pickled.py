"""Requests go through pickle: what comes out gives the same, functions that stand in other functions too."""

import pickle
from functools import partial

import numpy as np
import pytest

from hydraulics import capacity, reserve, thrust
from linkage import clearance, condition, drive_force, gap, pin_force, ratio, transmission, y
from linkage.pickling import function_again, picklable
from linkage.study.tolerances import sigma
from mechanisms.three_point_hitch import ThreePointHitch
from tests.for_all import for_all

REQUESTS = [
    ratio("G"), transmission("K"), condition(), pin_force("K"), drive_force("S"), thrust("lift"), reserve("lift"), capacity("lift", "G"),
    transmission("K") + 0.1, sigma(y("G"), {"MK": 0.001}),
]  # fmt: skip


@for_all("request_", REQUESTS, ids=str)
def test_what_comes_out_gives_the_same(request_):
    other = pickle.loads(pickle.dumps(request_))
    assert type(other) is type(request_) and str(other) == str(request_)
    motion = ThreePointHitch().sweep(5)
    np.testing.assert_array_equal(motion.of(other) if hasattr(motion, "of") else other.of(motion), request_.of(motion))


@pytest.mark.parametrize("request_", [gap("A", "B"), clearance()], ids=str)
def test_what_is_of_outlines_comes_out_as_it_is_written(request_):
    assert str(pickle.loads(pickle.dumps(request_))) == str(request_)


def outer(factor):
    """Return a function in a function in a function, with defaults and what it reads around it."""

    def middle(shift):
        def inner(value, *, times=2):
            return factor * value * times + shift

        return inner

    return middle


def test_a_function_deep_inside_is_made_again():
    function = outer(3)(4)
    again = pickle.loads(pickle.dumps(picklable(function)))
    assert again(5) == function(5) == 34 and again(5, times=1) == 19
    both = pickle.loads(pickle.dumps(picklable(partial(outer(2)(1), 7, times=1))))
    assert both() == 15
    assert picklable(len) is len and picklable(5) == 5
    assert function_again.__module__ == "linkage.pickling"


def test_a_function_that_nobody_finds_again_stays_as_it_is():
    function = eval("lambda: 1")
    assert picklable(function) is function
