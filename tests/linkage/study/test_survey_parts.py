"""The parts of a survey: how designs are dealt out, how a measure is told from another, how a box is sampled."""

import functools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_array_equal

from linkage import DefinitionError
from linkage.study import Box, survey
from linkage.study.checkpoint import measure_text
from linkage.study.survey import BatchSizes, OpenRanges
from mechanisms.three_point_hitch import ThreePointHitch
from tests.for_all import for_all
from tests.linkage.study.survey_measures import far_points, travel

# -- dealing out --------------------------------------------------------------------------------------------


@given(st.integers(1, 500), st.integers(1, 70), st.data())
def test_every_design_is_dealt_out_once_on_the_borders_of_pieces(count, piece, data):
    left = OpenRanges(count, piece)
    given_out = np.zeros(count, int)
    while left.ranges:
        assert left.pieces_left == sum(-(-(stop - start) // piece) for start, stop in left.ranges)
        start, stop = left.take(data.draw(st.integers(1, 9)))
        assert start % piece == 0 and (stop % piece == 0 or stop == count) and start < stop
        if data.draw(st.booleans()) and given_out.sum() < 3 * count:
            left.ranges.insert(0, (start, stop))
            assert left.remove(start, stop) and not left.remove(start, stop)
        given_out[start:stop] += 1
    assert (given_out == 1).all()


def test_batches_grow_to_their_time_and_shrink_towards_the_end():
    sizes = BatchSizes(1000)
    assert (sizes.next_pieces(10_000), sizes.ahead) == (1, 1)
    sizes.learn(1, 0.01, waited=0.0)
    assert (sizes.next_pieces(10_000), sizes.ahead) == (40, 2)
    assert sizes.next_pieces(60) == 30
    assert sizes.next_pieces(30) == 30, "what is left over is no batch of its own"
    sizes.learn(40, 0.04, waited=1.0)
    assert (sizes.next_pieces(10_000), sizes.next_pieces(100_000), sizes.ahead) == (400, 400, 2)
    assert BatchSizes(7).next_pieces(100) == 1


def test_batches_at_the_bound_of_memory_are_equal():
    sizes = BatchSizes(71)
    sizes.learn(1, 0.002, waited=0.0)
    left, dealt = 977, []
    while left:
        dealt.append(sizes.next_pieces(left))
        left -= dealt[-1]
    assert len(dealt) == 14 and set(dealt) == {69, 70}


def test_more_batches_go_out_while_workers_wait():
    sizes = BatchSizes(100)
    for _ in range(5):
        sizes.learn(1, 0.4, waited=0.01)
    assert sizes.ahead == 6
    sizes.learn(1, 0.4, waited=0.3)
    assert sizes.ahead == 6


# -- what a measure is --------------------------------------------------------------------------------------


def made(constant, name="G", extra=None):
    scale = constant

    def measure(machine):
        return {name: scale * machine["OB"] if extra is None else extra(machine)}

    return measure


def doubled(machine):
    return 2.0 * machine["OB"]


def length(machine):
    return machine["OB"]


def test_source_text_tells_measures_apart():
    several = [
        travel, far_points, made(2.0), made(3.0), made(2.0, "K"), made(np.arange(3)), made(np.arange(4)), made(ThreePointHitch()),
        made(ThreePointHitch(OB=0.31)), made(2.0, extra=doubled), made(2.0, extra=length),
        functools.partial(made, 2.0), functools.partial(made, 3.0), made({"a": [1, (2, None)]}), made({"a": [1, (2, True)]}),
        made({"a", "b"}), Callable(1.0), Callable(2.0), Callable(2.0).method, len,
    ]  # fmt: skip
    words = [measure_text(measure) for measure in several]
    assert len(set(words)) == len(several)
    assert words[2] == measure_text(made(2.0)) and words[16] == measure_text(Callable(1.0)) and words[15] == measure_text(made({"b", "a"}))


SCALE = 2.0


def scaled(machine):
    """Measures with a number of its module, and a function of it."""
    return {"OB": SCALE * doubled(machine)}


def test_values_and_functions_that_a_measure_reads_are_part_of_it(monkeypatch):
    before = measure_text(scaled)
    assert 'return 2.0 * machine["OB"]' in before and "['SCALE', 2.0]" in before
    monkeypatch.setitem(globals(), "SCALE", 3.0)
    assert measure_text(scaled) != before


def test_measure_text_does_not_depend_on_the_bytecode(monkeypatch):
    text, code = measure_text(scaled), scaled.__code__
    monkeypatch.setattr(scaled, "__code__", code.replace(co_consts=(*code.co_consts, "of another Python")))
    assert measure_text(scaled) == text


NEEDS_A_VERSION = r".* cannot tell it from another one; define it by `def` in a file, or say version=1"


def test_function_without_source_needs_a_version():
    space = {"__name__": __name__}
    exec("def other(machine):\n    return {'OB': machine['OB']}\n", space)
    assert measure_text(space["other"], has_version=True)
    with pytest.raises(DefinitionError, match=f"other has no source text that is found, {NEEDS_A_VERSION}"):
        measure_text(space["other"])


@pytest.mark.parametrize("measure", [lambda machine: {"OB": machine["OB"]}, made(2.0, extra=lambda machine: machine["OB"])])
def test_lambda_needs_a_version(measure, tmp_path):
    hitch, over = ThreePointHitch(), {"OB": np.linspace(0.29, 0.31, 5)}
    with pytest.raises(DefinitionError, match=f"is a lambda, without source text {NEEDS_A_VERSION}"):
        survey(hitch, over, measure, folder=tmp_path)
    assert survey(hitch, over, measure), "without a folder nobody has to know"
    survey(hitch, over, measure, folder=tmp_path, version=1)
    assert "5 designs from the folder" in repr(survey(hitch, over, measure, folder=tmp_path, version=1))
    with pytest.raises(DefinitionError, match=r"differs in version \(1 there, 2 here\)"):
        survey(hitch, over, measure, folder=tmp_path, version=2)


@pytest.mark.parametrize("version", [True, 1.5, None, ["a"]])
def test_version_that_cannot_be(version):
    with pytest.raises(DefinitionError, match="a text or a whole number is expected"):
        survey(ThreePointHitch(), {"OB": np.linspace(0.29, 0.31, 5)}, travel, version=version)


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


@for_all("method", ["sobol", "latin"])
@for_all("count", [1, 96, 128])
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
