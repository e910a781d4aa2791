"""The parts of a survey: how designs are dealt out, how a measure is told from another, how a box is sampled."""

import functools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_array_equal

from linkage import DefinitionError
from linkage.study import Box, survey
from linkage.study.batching import Left, Pace
from linkage.study.checkpoint import fingerprint
from mechanisms.three_point_hitch import ThreePointHitch
from tests.linkage.survey_measures import far_points, travel

# -- dealing out --------------------------------------------------------------------------------------------


@given(st.integers(1, 500), st.integers(1, 70), st.data())
def test_every_design_is_dealt_out_once_on_the_borders_of_pieces(count, piece, data):
    left = Left(count, piece)
    given_out = np.zeros(count, int)
    while left.ranges:
        assert left.pieces == sum(-(-(stop - start) // piece) for start, stop in left.ranges)
        start, stop = left.take(data.draw(st.integers(1, 9)))
        assert start % piece == 0 and (stop % piece == 0 or stop == count) and start < stop
        if data.draw(st.booleans()) and given_out.sum() < 3 * count:
            left.give_back(start, stop)
            assert left.remove(start, stop) and not left.remove(start, stop)
        given_out[start:stop] += 1
    assert (given_out == 1).all()


def test_batches_grow_to_their_time_and_shrink_towards_the_end():
    pace = Pace(1000)
    assert (pace.pieces(10_000), pace.ahead) == (1, 1)
    pace.heard(1, 0.01, waited=0.0)
    assert (pace.pieces(10_000), pace.ahead) == (40, 2)
    assert pace.pieces(60) == 30
    assert pace.pieces(30) == 30, "what is left over is no batch of its own"
    pace.heard(40, 0.04, waited=1.0)
    assert (pace.pieces(10_000), pace.pieces(100_000), pace.ahead) == (400, 400, 2)
    assert Pace(7).pieces(100) == 1


def test_batches_at_the_bound_of_memory_are_equal():
    pace = Pace(71)
    pace.heard(1, 0.002, waited=0.0)
    left, dealt = 977, []
    while left:
        dealt.append(pace.pieces(left))
        left -= dealt[-1]
    assert len(dealt) == 14 and set(dealt) == {69, 70}


def test_more_batches_go_out_while_workers_wait():
    pace = Pace(100)
    for _ in range(5):
        pace.heard(1, 0.4, waited=0.01)
    assert pace.ahead == 6
    pace.heard(1, 0.4, waited=0.3)
    assert pace.ahead == 6


# -- what a measure is --------------------------------------------------------------------------------------


def made(constant, name="G", extra=None):
    scale = constant

    def measure(machine):
        return {name: scale * machine["OB"] if extra is None else extra(machine)}

    return measure


def test_fingerprint_tells_measures_apart():
    several = [
        travel, far_points, made(2.0), made(3.0), made(2.0, "K"), made(np.arange(3)), made(np.arange(4)), made(ThreePointHitch()),
        made(ThreePointHitch(OB=0.31)), made(2.0, extra=lambda machine: machine["OB"]), made(2.0, extra=lambda machine: machine["CD"]),
        functools.partial(made, 2.0), functools.partial(made, 3.0), made({"a": [1, (2, None)]}), made({"a": [1, (2, True)]}),
        made({"a", "b"}), Callable(1.0), Callable(2.0), Callable(2.0).method, len,
    ]  # fmt: skip
    words = [fingerprint(measure) for measure in several]
    assert len(set(words)) == len(several)
    assert words[2] == fingerprint(made(2.0)) and words[16] == fingerprint(Callable(1.0)) and words[15] == fingerprint(made({"b", "a"}))


class Callable:
    def __init__(self, factor):
        self.factor = factor

    def __call__(self, machine):
        return self.method(machine)

    def method(self, machine):
        return {"OB": self.factor * machine["OB"]}


# -- samples ------------------------------------------------------------------------------------------------

HOLES = [(0.22, 1.05), (0.22, 0.95), (0.20, 1.00)]
BOX = Box.of(ThreePointHitch(), {"OB": (0.28, 0.34), "CD": (0.60, 0.64), "M": HOLES})


@pytest.mark.parametrize("method", ["sobol", "latin"])
@pytest.mark.parametrize("count", [1, 96, 128])
def test_sample_fills_the_box_evenly(method, count):
    sample = BOX.sample(count, method=method)
    assert sample.keys() == {"OB", "CD", "M"} and all(np.shape(value)[-1] == count for value in sample.values())
    assert set(zip(*sample["M"], strict=True)) <= set(HOLES)
    for name, (low, high) in BOX.ranges.items():
        counts, _ = np.histogram(sample[name], 32, (low, high))
        assert counts.sum() == count
        assert count == 1 or (counts.min() >= count // 32 - (method == "sobol" and count == 96) and counts.max() <= -(-count // 32) + 1)
    for hole in HOLES:
        assert count == 1 or abs(np.sum(sample["M"][1] == hole[1]) - count / 3) <= 1.5


def test_sample_is_that_of_its_seed():
    one, two, other = BOX.sample(64), BOX.sample(64), BOX.sample(64, seed=1)
    assert_array_equal(one["OB"], two["OB"])
    assert not np.any(one["OB"] == other["OB"])
    assert_array_equal(BOX.sample(50)["OB"], one["OB"][:50])


def test_sample_of_choices_alone_and_of_ranges_alone():
    assert set(Box.of(ThreePointHitch(), {"M": HOLES}).sample(12)["M"][1]) == {1.05, 0.95, 1.00}
    assert Box.of(ThreePointHitch(), {"OB": (0.28, 0.34)}).sample(4).keys() == {"OB"}


@pytest.mark.parametrize(("count", "method"), [(0, "sobol"), (2.0, "sobol"), (True, "latin"), (8, "halton")])
def test_sample_that_cannot_be(count, method):
    with pytest.raises(DefinitionError, match=f"method={method!r}" if method == "halton" else f"count={count!r}"):
        BOX.sample(count, method=method)


@pytest.mark.parametrize("seed", [-1, "x", 1.5, None])
def test_seed_that_cannot_be(seed):
    with pytest.raises(DefinitionError, match="a whole number is expected, at least 0"):
        BOX.sample(8, seed=seed)


def test_counts_of_numpy_are_counts():
    assert_array_equal(BOX.sample(np.int64(50))["OB"], BOX.sample(50)["OB"])


def test_sample_is_surveyed():
    found = survey(ThreePointHitch(), BOX.sample(256), travel)
    assert np.isfinite(found["travel"]).all() and np.ptp(found["travel"]) > 0.1
