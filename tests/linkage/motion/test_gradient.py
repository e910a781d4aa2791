"""Derivatives by dimensions: reverse mode, against tangents and against differences of designs."""

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from linkage import AssemblyError, DefinitionError, SingularError, angle, distance, ratio, x, y
from linkage.program import Graph, Level, Tangent, gradient, interpret
from mechanisms.three_point_hitch import ThreePointHitch
from tests.for_all import for_all
from tests.linkage.program.test_backends import GROUPED, MACHINES, SHIPPED
from tests.linkage.random_mechanisms import random_mechanism

LENGTHS = ["OB", "OC", "BC", "ED", "CD", "EF", "MK", "FK", "FG", "L0"]


def mid(machine):
    """Return strokes well inside their ranges, a few of each."""
    return {name: stroke.start + (stroke.end - stroke.start) * np.array([0.4, 0.45, 0.5]) for name, stroke in machine.plan.strokes.items()}


def difference(machine, name, read, strokes, h=1e-5):
    """Return the derivative of a reading by a dimension: central differences of one batch of designs, extrapolated once."""
    design = machine()
    design._values = dict(design._values) | {name: design._values[name] + h * np.array([1.0, -1.0, 2.0, -2.0])}
    one, back, two, far_back = np.moveaxis(read(design.at(**strokes)), -2, 0)
    near, wide = (one - back) / (2 * h), (two - far_back) / (4 * h)
    return (4 * near - wide) / 3


@pytest.mark.slow
@MACHINES
def test_gradient_of_a_position_is_the_difference_of_designs(machine):
    strokes, names = mid(machine), list(machine.plan.table.entries)
    point = machine.plan.moving[-1]
    motion = machine().at(**strokes)
    found = motion.gradient(point, names)
    assert found.shape == (len(names), 2, 3)
    for each, name in zip(found, names, strict=True):
        step = 1e-5 * max(1.0, abs(machine.plan.defaults[name]))
        wanted = difference(machine, name, lambda moved: moved[point], strokes, step)
        assert_allclose(each, wanted, rtol=2e-6, atol=2e-6 * max(1.0, np.abs(wanted).max()) / max(1.0, step * 1e5))


@MACHINES
def test_gradient_of_a_ratio_is_the_tangent_of_the_ratio(machine):
    plan, strokes = machine.plan, mid(machine)
    motion, point, first = machine().at(**strokes), plan.moving[-1], next(iter(plan.strokes))
    names = list(plan.table.entries)
    found = motion.gradient(ratio(point, wrt=first), names)
    nodes = plan.derived(plan.nodes(point), (first,))
    for each, name in zip(found, names, strict=True):
        tangent = Tangent(plan.trace.graph, {plan.trace.inputs[name]: 1.0})
        for part, node in zip(each, nodes, strict=True):
            (wanted,) = interpret([tangent.derivative(node)], motion._grid.flat)
            assert_allclose(part, np.broadcast_to(np.ravel(wanted), (3,)), rtol=1e-8, atol=1e-8 * (1.0 + np.abs(each).max()))


@for_all("seed", range(1), slow=range(1, 8))
def test_gradients_of_random_mechanisms(seed):
    machine = random_mechanism(seed, strokes=1 + seed % 2, joints=6)
    plan = machine.plan
    first = next(iter(plan.strokes))
    nodes = [node for name in plan.moving for node in plan.derived(plan.nodes(name), (first,))]
    inputs = [plan.trace.inputs[name] for name in plan.table.entries]
    flat = machine().at(**{name: stroke.start + 0.3 * (stroke.end - stroke.start) for name, stroke in plan.strokes.items()})._grid.flat
    tangents = [[Tangent(plan.trace.graph, {each: 1.0}).derivative(node) for node in nodes] for each in inputs]
    wanted = np.array([[np.ravel(value)[0] for value in interpret(row, flat)] for row in tangents])
    found = np.array([[np.ravel(value)[0] for value in interpret(gradient(node, inputs), flat)] for node in nodes]).T
    assert np.abs(wanted).max() > 0.1
    assert_allclose(found, wanted, rtol=1e-9, atol=1e-9 * np.abs(wanted).max())


@pytest.mark.parametrize("name", GROUPED)
def test_gradients_go_through_groups(name):
    machine, strokes = SHIPPED[name], mid(SHIPPED[name])
    motion, point = machine().at(**strokes), machine.plan.groups[next(iter(machine.plan.groups))].pins[0]
    names = [each for each, entry in machine.plan.table.entries.items() if entry.kind == "length"]
    found = motion.gradient(ratio(point), names)
    assert np.abs(found).max() > 0.1
    for each, dimension in zip(found, names, strict=True):
        wanted = difference(machine, dimension, lambda moved: moved.ratio(point), strokes, 1e-5)
        assert_allclose(each, wanted, rtol=1e-5, atol=1e-6 * max(1.0, np.abs(wanted).max()))


OUTPUTS = ["tilt", distance("A", "G"), y("G") * np.sin(angle("F", "K")) + x("K") ** 2, ratio("tilt"), ratio("tilt", order=2)]


@for_all("of", OUTPUTS, ids=str)
def test_outputs_and_expressions_have_gradients(of):
    strokes = {"S": np.linspace(0.02, 0.2, 4)}
    found = ThreePointHitch().at(**strokes).gradient(of, [*LENGTHS, "M.x", "KFG"])
    target, order = (of.target, of.order) if hasattr(of, "order") else (of, 0)

    def read(motion):
        if order:
            return motion.ratio(target, order=order)
        return motion[target] if isinstance(target, str) else motion.value(target)

    assert found.shape == (12, 4)
    for each, name in zip(found, [*LENGTHS, "M.x", "KFG"], strict=True):
        assert_allclose(each, difference(ThreePointHitch, name, read, strokes), rtol=1e-6, atol=1e-6)


def test_batches_of_designs_have_gradients_each():
    sizes = np.linspace(0.28, 0.32, 4)
    batch = ThreePointHitch(OB=sizes[:, None], CD=np.array([0.6, 0.62])).sweep(5)
    found = batch.gradient(ratio("G"), ["OB", "M.y"])
    assert found.shape == (2, 2, 4, 2, 5)
    for row, OB in enumerate(sizes):
        one = ThreePointHitch(OB=OB).sweep(5).gradient(ratio("G"), ["OB", "M.y"])
        assert_allclose(found[:, :, row, 1], one, rtol=1e-11, atol=1e-11)


def test_a_dimension_may_be_spelled_backwards_and_an_angle_changes_sign():
    motion = ThreePointHitch().sweep(3)
    forth, back, turned, turned_back = motion.gradient("G", ["OB", "BO", "KFG", "GFK"])
    assert_array_equal(forth, back)
    assert_array_equal(turned, -turned_back)


def test_a_dimension_behind_the_point_changes_nothing():
    assert_array_equal(ThreePointHitch().sweep(3).gradient("C", ["FG", "M.x"]), np.zeros((2, 2, 3)))


@for_all(
    ("wrt", "words"),
    [
        (["OX"], "OX"),
        ("OB", "a list of dimensions"),
        (["M"], "M.x"),
        (["AB"], "AB follows L0"),
        (["S"], "S"),
        (None, "wrt=None: a list of dimensions"),
    ],
)
def test_what_is_no_dimension_is_told(wrt, words):
    with pytest.raises(DefinitionError, match=words):
        ThreePointHitch().sweep(3).gradient("G", wrt)


def test_out_of_reach_there_is_no_gradient_and_at_a_dead_point_it_is_refused():
    hitch = ThreePointHitch()
    dead = float(np.hypot(*(hitch["O"] - hitch["A"])) + hitch["OB"] - hitch["L0"])
    with pytest.raises(AssemblyError):
        hitch.at(S=0.6)
    with pytest.raises(SingularError, match="gradient of B"):
        hitch.at(S=[0.1, dead]).gradient("B", ["OB"])
    found = hitch.at(S=[0.1, dead, 0.6], unreachable="nan").gradient("B", ["OB", "A.x"])
    assert_array_equal(np.isnan(found), np.broadcast_to([False, True, True], (2, 2, 3)))


def test_every_operation_passes_its_share_on():
    graph = Graph()
    names = {"a": 0.7133, "b": 1.3071, "s": 0.4217}
    a, b, s = (graph.input(name, Level.POSE) for name in names)
    node = np.sqrt(a * b) / (s + np.exp(a)) - np.arctan2(b, s) * np.tan(a) + np.minimum(a, s) ** 2 * np.maximum(b, a)
    node = node - np.log(b) ** 1.7 / np.abs(s - 3.0) + graph.pick(a, b, a * s, b) * np.cos(np.sin(b))
    wanted = [interpret([Tangent(graph, {each: 1.0}).derivative(node)], names)[0] for each in (a, b, s)]
    assert_allclose(interpret(gradient(node, [a, b, s]), names), wanted, rtol=1e-12)


def test_a_system_passes_its_shares_on():
    graph = Graph()
    names = {"a": 0.7, "b": 1.3, "s": 0.4}
    a, b, s = (graph.input(name, Level.POSE) for name in names)
    system = graph.apply("solve", a + 2.0, b, s, s * s, b + 3.0, a, a * b, s, 4.0 + a, 1.0 + s, a, b * b)
    node = sum((graph.apply("component", system, float(k)) * (k + 1.0) for k in range(3)), graph.constant(0.0))
    wanted = [interpret([Tangent(graph, {each: 1.0}).derivative(node)], names)[0] for each in (a, b, s)]
    assert_allclose(np.ravel(interpret(gradient(node, [a, b, s]), names)), np.ravel(wanted), rtol=1e-12)
