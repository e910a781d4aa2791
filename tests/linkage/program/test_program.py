"""The traced program: its nodes simplify without changing a value, its derivatives are exact, its kernels agree."""

import math
import operator
import sys
import threading

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal

from linkage import DefinitionError
from linkage.program import Graph, Kernel, Level, Tangent, interpret
from linkage.program.elimination import solution
from linkage.program.operations import ARRAYS, FLOATS, OPERATIONS
from linkage.program.schedule import schedule
from tests.for_all import for_all

VALUES = {"a": 0.7133, "b": -1.3071, "s": 0.4217, "t": 2.1749}  # no sum of them is another
BINARY = {"+": operator.add, "-": operator.sub, "*": operator.mul, "/": operator.truediv}


def trees():
    """Return random expressions as nested tuples over two design inputs, two pose inputs and constants."""
    leaf = st.sampled_from([*VALUES, 0.0, 1.0, -1.0, 2.0, -0.5])
    grow = lambda part: st.tuples(st.sampled_from([*BINARY, "neg", "sq", "min", "max"]), part, part)  # noqa: E731
    return st.recursive(leaf, grow, max_leaves=14)


def worked(tree, leaf):
    """Return the value of a tree over what its leaves stand for."""
    if not isinstance(tree, tuple):
        return leaf(tree)
    op, a, b = tree[0], worked(tree[1], leaf), worked(tree[2], leaf)
    if op in BINARY:
        return BINARY[op](a, b)
    return {"neg": lambda: -a, "sq": lambda: a**2, "min": lambda: np.minimum(a, b), "max": lambda: np.maximum(a, b)}[op]()


def traced(tree):
    graph = Graph()
    inputs = {name: graph.input(name, Level.DESIGN if name in "ab" else Level.POSE) for name in VALUES}
    return graph, inputs, graph.node(worked(tree, lambda leaf: inputs[leaf] if isinstance(leaf, str) else graph.constant(leaf)))


def plainly(tree, **changed):
    """Return a tree's value in floats; NaN where something in it divides by zero, whose sign is nobody's."""
    at = VALUES | changed
    with np.errstate(all="raise", under="ignore"):
        try:
            return float(worked(tree, lambda leaf: np.float64(at[leaf] if isinstance(leaf, str) else leaf)))
        except FloatingPointError:
            return math.nan


@given(trees())
def test_a_simplified_program_keeps_its_value(tree):
    wanted = plainly(tree)
    if not math.isfinite(wanted) or abs(wanted) > 1e6:
        return
    _, _, node = traced(tree)
    many = {name: np.full(50, value) if name in "st" else value for name, value in VALUES.items()}
    assert float(interpret([node], VALUES)[0]) == pytest.approx(wanted, rel=1e-9, abs=1e-9)
    assert_allclose(Kernel([node])(VALUES).values.ravel(), wanted, rtol=1e-9, atol=1e-9)
    assert_allclose(Kernel([node])(many).values.ravel(), wanted, rtol=1e-9, atol=1e-9)


@given(trees(), st.sampled_from(sorted(VALUES)))
def test_a_tangent_is_the_slope(tree, name):
    h = 1e-6
    around = [plainly(tree, **{name: VALUES[name] + k * h}) for k in (-2, -1, 1, 2)]
    if not all(math.isfinite(each) and abs(each) < 1e3 for each in around):
        return
    slope, wider = (around[2] - around[1]) / (2 * h), (around[3] - around[0]) / (4 * h)
    if abs(slope - wider) > 1e-6 * (1 + abs(slope)):  # a pole or a kink nearby
        return
    graph, inputs, node = traced(tree)
    found = Tangent(graph, {inputs[name]: 1.0}).derivative(node)
    assert float(interpret([found], VALUES)[0]) == pytest.approx(slope, rel=1e-5, abs=1e-5)


def test_what_is_written_twice_is_worked_out_once():
    graph = Graph()
    a, s = graph.input("a", Level.DESIGN), graph.input("s", Level.POSE)
    assert (a + s) * (s + a) is (s + a) ** 2
    assert a / s is a * (1.0 / s)
    assert (a - a).value == 0.0
    opposite = -a
    assert -opposite is a
    assert -(a - s) is s - a
    assert 2.0 * (3.0 * a) is 6.0 * a
    assert graph.node(3.0) * graph.node(4.0) is graph.constant(12.0)


def test_threads_in_one_graph_give_every_node_a_number_of_its_own():
    interval = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    try:
        for _ in range(10):
            graph, start = Graph(), threading.Barrier(4)
            s = graph.input("s", Level.POSE)

            def grow(k, s=s, start=start):
                start.wait()
                for i in range(200):
                    s = s * float(i + k) + s

            threads = [threading.Thread(target=grow, args=(k,)) for k in range(4)]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
            assert [node.number for node in graph.nodes] == list(range(len(graph.nodes)))
    finally:
        sys.setswitchinterval(interval)


def test_what_depends_on_the_design_only_is_kept_apart():
    graph = Graph()
    a, b, s = graph.input("a", Level.DESIGN), graph.input("b", Level.DESIGN), graph.input("s", Level.POSE)
    plan = schedule([np.sqrt(a * b + 1.0) * s + a])
    assert [node.op for node in plan.design] == ["multiply", "add", "sqrt"]
    assert [node.op for node in plan.pose] == ["multiply", "add"]
    assert {node.op for node in plan.passed} == {"sqrt", "input"}


def test_a_kernel_computes_only_what_is_asked():
    graph = Graph()
    s = graph.input("s", Level.POSE)
    wanted, other = s * 2.0, np.sin(s)
    assert len(schedule([wanted]).pose) == 1
    assert len(schedule([wanted], [other]).pose) == 2


SPECIAL = [0.0, -0.0, 1.0, -1.0, 0.5, -2.5, 1e300, -1e300, 1e-300, math.inf, -math.inf, math.nan]
SMOOTH = [name for name in OPERATIONS if name in FLOATS and name not in ("solve", "component", "pick")]


@for_all("name", SMOOTH)
def test_floats_answer_as_arrays_do(name):
    count = OPERATIONS[name].array.nin
    for first in SPECIAL:
        for second in SPECIAL if count == 2 else [0.0]:
            given_ = (first, second)[:count]
            with np.errstate(all="ignore"):
                wanted = float(ARRAYS[name](*map(np.float64, given_)))
            assert_allclose(FLOATS[name](*given_), wanted, rtol=1e-14, err_msg=f"{name}{given_}") if name in FLOATS else None


@pytest.mark.parametrize("size", [1, 2, 3, 5])
def test_systems_inside_a_program(size):
    random = np.random.default_rng(size)
    values = random.uniform(-1, 1, (size, size + 1, 40)) + 2 * np.eye(size, size + 1)[..., None]
    graph = Graph()
    entries = [[graph.input(f"m{i}{j}", Level.POSE) for j in range(size + 1)] for i in range(size)]
    found = solution(graph, [row[:size] for row in entries], [row[size] for row in entries])
    tangent = Tangent(graph, {entries[0][0]: 1.0})
    slopes = [tangent.derivative(node) for node in found]
    given_ = {f"m{i}{j}": values[i, j] for i in range(size) for j in range(size + 1)}
    wanted = np.linalg.solve(np.moveaxis(values[:, :size], -1, 0), np.moveaxis(values[:, size:], -1, 0))[..., 0].T
    few = {name: value[:7] for name, value in given_.items()}
    assert_allclose(Kernel(found)(given_).values[:, 0], wanted, rtol=1e-10)
    assert_allclose(Kernel(found)(few).values[:, 0], wanted[:, :7], rtol=1e-10)
    up, down = (given_ | {"m00": given_["m00"] + sign * 1e-6} for sign in (1, -1))
    slope = (Kernel(found)(up).values - Kernel(found)(down).values) / 2e-6
    assert_allclose(Kernel(slopes)(given_).values, slope, rtol=1e-5, atol=1e-7)
    assert_allclose(Kernel(slopes)(few).values, slope[..., :7], rtol=1e-5, atol=1e-7)


def test_a_singular_system_is_nan_and_leaves_the_others():
    graph = Graph()
    entries = [graph.input(f"m{k}", Level.POSE) for k in range(12)]
    found = solution(graph, [entries[:3], entries[3:6], entries[6:9]], entries[9:])
    values = np.tile(np.concatenate([np.eye(3).ravel(), [1.0, 2.0, 3.0]]), (30, 1))
    values[4, :9] = 0.0
    result = Kernel(found)({f"m{k}": values[:, k] for k in range(12)}).values[:, 0]
    assert_array_equal(np.isnan(result).any(axis=0), np.arange(30) == 4)
    assert_allclose(result[:, 5], [1.0, 2.0, 3.0])


def test_a_guard_is_the_least_over_all_blocks_and_nan_where_one_is():
    graph = Graph()
    s = graph.input("s", Level.POSE)
    kernel = Kernel([s * 2.0], [s - 1.0, np.sqrt(s)])
    for count in (5, 100, 20000):
        values = np.linspace(3.0, 4.0, count)
        assert_allclose(kernel({"s": values}).guards, [2.0, math.sqrt(3.0)])
        values[count // 2] = -1.0
        least, root = kernel({"s": values}).guards
        assert least == -2.0
        assert math.isnan(root)


def test_an_array_cannot_be_traced():
    graph = Graph()
    s = graph.input("s", Level.POSE)
    with pytest.raises(DefinitionError):
        s + np.array([1.0, 2.0])
    with pytest.raises(DefinitionError, match="cannot be traced"):
        np.arccosh(s)


@for_all("exponent", [0, 1, 2, 3, -1, -2, 0.5, 2.5, 9, 1e3])
def test_powers(exponent):
    graph = Graph()
    s = graph.input("s", Level.POSE)
    node, slope = s**exponent, Tangent(graph, {s: 1.0}).derivative(s**exponent)
    given_ = {"s": np.linspace(0.5, 1.1, 30)}
    assert_allclose(Kernel([graph.node(node)])(given_).values.ravel() + 0 * given_["s"], given_["s"] ** exponent, rtol=1e-13)
    assert_allclose(Kernel([slope])(given_).values.ravel() + 0 * given_["s"], exponent * given_["s"] ** (exponent - 1.0), rtol=1e-12)
