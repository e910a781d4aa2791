"""Numbers of a traced law: NumPy's arithmetic on them is that on arrays, and what would need their value is refused."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from linkage import DefinitionError
from linkage.program import Graph, Level, Tangent, interpret
from linkage.program.traced import Notes, Traced
from tests.for_all import for_all

VALUES = {"a": np.array([-1.3, -0.2, 0.0, 0.4, 0.4, 2.5]), "b": np.array([0.7, 0.7, 0.0, 0.4, 1.9, -0.6])}


def numbers():
    """Return two traced numbers that share their notes."""
    graph, notes = Graph(), Notes("law")
    return [Traced(graph.input(name, Level.POSE), notes) for name in "ab"]


def value(number):
    """Return what a number is, traced or not, for the values."""
    found = interpret([number.node], VALUES)[0] if isinstance(number, Traced) else number
    return np.broadcast_to(found, np.shape(VALUES["a"]))


SMOOTH = {
    "arithmetic": lambda a, b: 2.0 * a - b / (3.0 + a * a) + (+a) ** 3 - 1.0 / (b * b + 1.0) + (-b) ** 2,
    "roots and powers": lambda a, b: np.sqrt(a * a + 1.0) + np.hypot(a, b + 4.0) + (b + 2.0) ** 1.7 + np.power(a, 2) + np.square(b),
    "functions": lambda a, b: np.sin(a) * np.cos(b) + np.tan(0.3 * a) + np.exp(-b) + np.log(a + 3.0) + np.arctan2(b, a + 4.0),
    "inverse functions": lambda a, b: np.arctan(a) + np.arcsin(0.2 * b) - np.arccos(0.3 * a) + np.deg2rad(a) + np.rad2deg(b),
    "tanh": lambda a, b: np.tanh(3.0 * a) + np.tanh(b),
    "scalars of numpy": lambda a, b: np.float64(2.0) * a + np.array(3.0) * b - np.float64(1.0) / (a + 9.0),
    "sums of lists": lambda a, b: np.mean([a, b], axis=0) + np.sum([a, 2.0 * b], axis=0) + sum([a, b]),
}
KINKED = {
    "tanh far out": lambda a, b: np.tanh(1e5 * (a + 0.1)) + np.tanh(-1e3 * (b - 0.2)),
    "choices": lambda a, b: np.minimum(a, b) + 2.0 * np.maximum(a, 0.1) + abs(b) + np.sign(a) + np.clip(a, -0.5, 0.5),
    "where": lambda a, b: np.where(a > 0.3, a * b, a - b) + np.where(a <= b, 1.0, b),
    "where at the edge": lambda a, b: np.where(a < 0.4, b, 2.0) + np.where(b >= 0.4, 5.0, a),
    "equal": lambda a, b: np.where(a == b, 7.0, a) + np.where(a != 0.4, b, 3.0),
    "and, or, not": lambda a, b: np.where((a > 0.0) & (b > 0.5), 1.0, a) + np.where((a > 2.0) | ~(b > 0.5), 1.0, b),
    "with what is known": lambda a, b: np.where((a > 0.0) & np.True_, 1.0, a) + np.where(False | (a > 0.0), 1.0, b),
    "beside NaN": lambda a, b: np.where(np.log(a) < b, 1.0, 2.0) + np.where(np.log(a) > b, a, b) + np.where(~(np.log(a) >= b), 3.0, b),
    "NaN is no number": lambda a, b: np.where(np.log(a) == b, 1.0, 2.0) + np.where(np.log(a) != b, a, b) + np.where(True, a, b),
    "isnan": lambda a, b: np.where(np.isnan(np.log(a)), -1.0, 1.0) * b,
}


@for_all("law", [*SMOOTH.values(), *KINKED.values()], ids=[*SMOOTH, *KINKED])
def test_a_law_of_traced_numbers_is_the_law_of_arrays(law):
    with np.errstate(invalid="ignore", divide="ignore"):
        assert_allclose(value(law(*numbers())), law(*VALUES.values()), rtol=1e-14, atol=1e-14)


@for_all("law", SMOOTH.values(), ids=SMOOTH)
def test_its_derivatives_are_its_differences(law):
    a, b = numbers()
    traced, h = law(a, b), 1e-5
    for name, each in (("a", a), ("b", b)):
        slope = value(Traced(Tangent(a.node.graph, {each.node: 1.0}).derivative(traced.node), a.notes))
        near, wide = (
            (law(**VALUES | {name: VALUES[name] + k * h}) - law(**VALUES | {name: VALUES[name] - k * h})) / (2 * k * h) for k in (1, 2)
        )
        assert_allclose(slope, (4 * near - wide) / 3, rtol=1e-8, atol=1e-8)


VECTORS = {
    "turned": lambda v, a: np.stack([-v[1], v[0]]) * a,
    "direction": lambda v, a: v / np.hypot(v[0], v[1] + 3.0),
    "norm": lambda v, a: v / np.linalg.norm(v + 3.0, axis=0),
    "functions": lambda v, a: np.sqrt(np.abs(v)) + np.exp(-v) + np.arctan2(v, 3.0 + a),
    "beside zeros": lambda v, a: np.stack([a, np.zeros_like(a)]) - np.stack([np.ones_like(a), np.full_like(a, 2.0)]),
    "in place": lambda v, a: in_place(v * 1.0, a),
    "dot": lambda v, a: (v * v).sum(axis=0) * v,
    "chosen": lambda v, a: np.where(a > 0.2, v, -2.0 * v),
}


def in_place(v, a):
    """Return a vector after changes where it stands."""
    v *= a
    v += 1.0
    return v


@for_all("law", VECTORS.values(), ids=VECTORS)
def test_vectors_are_arrays_of_two_numbers(law):
    a, b = numbers()
    found = law(np.array([a, b]), a)
    assert found.shape == (2,)
    wanted = law(np.array([VALUES["a"], VALUES["b"]]), VALUES["a"])
    assert_allclose([value(each) for each in found], wanted, rtol=1e-14, atol=1e-14)


REFUSED = {
    "if": lambda a, b: 1.0 if a > b else 2.0,
    "if it is": lambda a, b: 1.0 if a else 2.0,
    "if equal": lambda a, b: 1.0 if a == 0.0 else 2.0,
    "max": lambda a, b: max(a, b),
    "in": lambda a, b: a in [b, 1.0],
    "float": lambda a, b: float(a),
    "math": lambda a, b: math.sqrt(a),
    "int": lambda a, b: int(a),
    "index": lambda a, b: [1.0, 2.0][a],
    "part": lambda a, b: a[0],
    "into floats": lambda a, b: np.asarray(a, float),
    "over poses": lambda a, b: np.min(a),
    "mean over poses": lambda a, b: a - np.mean(a),
    "running sum": lambda a, b: np.cumsum(a),
    "reduced": lambda a, b: np.add.reduce(a),
    "with out": lambda a, b: np.add(a, b, where=True),
    "no function of a program": lambda a, b: np.sinh(a),
    "array of comparisons": lambda a, b: np.array([a, b]) > 0.0,
    "choices of arrays": lambda a, b: np.maximum(np.array([a, b]), 0.0),
    "counted": lambda a, b: np.count_nonzero(a > 0.0),
    "looked up": lambda a, b: {a: 1.0},
    "an endless loop": lambda a, b: [None for _ in iter(lambda: np.any(a > b), True)],
}


@for_all("law", REFUSED.values(), ids=REFUSED)
def test_what_needs_a_value_is_refused(law):
    with pytest.raises((DefinitionError, TypeError, ValueError)):
        law(*numbers())


def test_tests_are_taken_to_be_in_order_and_noted():
    a, b = numbers()
    assert not np.any(a > b) and np.all(b <= 2.0) and not (a == 3.0).any() and np.all(np.isfinite(b) | (a > b)) and (b != a).all()
    assert set(a.notes.assumed.values()) == {"law"}
    expected = [VALUES["a"] <= VALUES["b"], VALUES["b"] <= 2.0, VALUES["a"] != 3.0, np.full(6, True), VALUES["a"] != VALUES["b"]]
    assert_array_equal([value(Traced(node, a.notes)) > 0.0 for node in a.notes.assumed], expected)
    assert not a.notes.switches  # next to where numbers differ they differ too


def test_what_is_known_is_not_noted():
    a, _ = numbers()
    assert np.any(0.0 * a == 0.0) and not np.all(0.0 * a > 0.0)
    assert not a.notes.assumed


def test_a_law_that_is_another_at_equal_numbers_is_noted():
    a, b = numbers()
    np.where(a == 0.4, 1.0, a), np.where((b != a) | (a > 9.0), 1.0, a), np.where((a == 0.0) & (b == 0.0), 1.0, a)
    here = [value(Traced(node, a.notes)) > 0.0 for node in a.notes.switches]
    x, y = VALUES.values()
    assert_array_equal(here, [x == 0.4, x == y, (x == 0.0) & (y == 0.0)])
