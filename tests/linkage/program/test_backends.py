"""Every way to run a program gives the same numbers: NumPy blocks, floats, the fused loop, C, node by node, the steps themselves."""

import ctypes
import json
import math
import shutil
import subprocess
import sys
import tracemalloc
import warnings
from functools import cache

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from linkage import LEFT, Crank, DefinitionError, Dyad, Ground, LinkageError, Mechanism, Stroke
from linkage.plan.trace import NEAR
from linkage.program import LANGUAGES, Graph, Kernel, Level, RunOptions, interpret, jacobian, solve_arrays
from linkage.program import kernel as kernel_module
from linkage.program.cache import CompiledFile, compiled
from linkage.program.elimination import expanded
from linkage.program.interpret import noise
from linkage.program.numpy_backend import aligned, cache_size, with_half_angles
from linkage.program.schedule import ancestors, lowered, schedule
from linkage.program.text import numba_text
from mechanisms.three_point_hitch import ThreePointHitch
from tests import shipped
from tests.for_all import first_daily, for_all
from tests.linkage.random_mechanisms import random_mechanism

SHIPPED = shipped.MACHINES
MACHINES = shipped.over_machines()
GROUPED = [name for name, machine in SHIPPED.items() if machine.plan.groups]


@cache
def everything(machine, guarded=False):
    """Return the kernel of all positions and their ratios."""
    plan = machine.plan
    places = [node for name in plan.moving for node in plan.nodes(name)]
    ratios = [node for stroke in plan.strokes for node in plan.derived(places, (stroke,))]
    return Kernel([*places, *ratios], plan.trace.watched(plan.members) if guarded else ())


def given(machine, poses, beyond=0.3, seed=3):
    """Return the inputs of the default design at strokes that go beyond the declared range."""
    random = np.random.default_rng(seed)
    ends = {name: (stroke.start, stroke.end - stroke.start) for name, stroke in machine.plan.strokes.items()}
    strokes = {name: start + span * random.uniform(-beyond, 1.0 + beyond, poses) for name, (start, span) in ends.items()}
    return machine().at(unreachable="nan", **strokes)._grid.flat


def firm(machine, inputs):
    """Return the poses where no loop stands near a dead point, no direction near nothing, and rounding is not magnified."""
    with np.errstate(all="ignore"):
        sines = [np.ravel(sine) for sine in machine.plan.read(inputs).sines.values()]
    nearness = Kernel([machine.plan.trace.nearness(machine.plan.members)])(inputs).values[0, 0]
    return ~(abs(math.prod(sines, start=np.ones(1))) < 0.05) & ~(nearness < NEAR**2)


def agree(found, wanted, firm=True):
    """Assert that two results agree to 1e-12 of their size at firm poses, some of which have a value, and in where they have none."""
    assert (firm & np.isfinite(wanted)).any()
    found, wanted = (np.where(firm, np.asarray(values, float), 0.0) for values in (found, wanted))
    assert_array_equal(np.isnan(found), np.isnan(wanted))
    size = np.abs(wanted) + np.nanmax(np.abs(wanted), axis=-1, keepdims=True, initial=1.0)
    assert np.nanmax(np.abs(found - wanted) / size, initial=0.0) < 1e-12


def uncompiled(plan, turned=False):
    """Return the fused loop as plain Python over NumPy's numbers: what Numba is given, without Numba."""
    text = numba_text(plan, turned).replace("from numba import njit", "def njit(**options):\n    return lambda function: function\n")
    space = compiled(text, {})
    space.update({name: getattr(np, name) for name in ("sqrt", "tan", "exp", "log", "floor")}, atan2=np.arctan2)
    return space["poses"]


def as_loop(kernel, inputs):
    """Return a kernel's values by the fused loop, uncompiled."""
    fused = kernel.fused
    fused._ready[False] = uncompiled(fused.plan)
    return kernel(inputs, way=RunOptions("numba"))


def by_nodes(kernel, inputs):
    """Return a kernel's values node by node, shape (outputs, poses)."""
    values = interpret(kernel.outputs, inputs)
    shape = np.broadcast_shapes(*(np.shape(value) for value in values))[-1:]
    return np.array([np.broadcast_to(np.ravel(value), shape) for value in values])


# -- agreement ---------------------------------------------------------------------------------------------


@MACHINES
def test_all_ways_agree_over_the_shipped_machines(machine):
    kernel, inputs = everything(machine), given(machine, 60)
    wanted, good = by_nodes(kernel, inputs), firm(machine, inputs)
    agree(kernel(inputs, way=RunOptions("numpy")).values[:, 0], wanted, good)
    agree(kernel(inputs, way=RunOptions("floats")).values[:, 0], wanted, good)
    with np.errstate(all="ignore"):
        agree(as_loop(kernel, inputs).values[:, 0], wanted, good)


@MACHINES
def test_places_are_those_of_the_steps(machine):
    inputs = given(machine, 60)
    with np.errstate(all="ignore"):
        reading = machine.plan.read(inputs)
    steps = [np.ravel(part) for name in machine.plan.moving for part in (reading.at(name).x, reading.at(name).y)]
    agree(everything(machine)(inputs, way=RunOptions("numpy")).values[: len(steps), 0], steps, firm(machine, inputs))


def check_random(seed, monkeypatch):
    machine = random_mechanism(seed, strokes=1 + seed % 2, joints=5)
    kernel, inputs = everything.__wrapped__(machine, guarded=True), given(machine, 40, seed=seed)
    wanted, good = by_nodes(kernel, inputs), firm(machine, inputs)
    first = kernel(inputs, way=RunOptions("numpy"))
    agree(first.values[:, 0], wanted, good)
    agree(kernel(inputs, way=RunOptions("floats")).values[:, 0], wanted, good)
    monkeypatch.setattr(kernel_module, "LARGE", 1)
    fresh, few = Kernel(kernel.outputs, kernel.guards), {name: each[:5] if np.ndim(each) else each for name, each in inputs.items()}
    read, *_, written = (fresh(few, way=RunOptions("floats")) for _ in range(3))  # the first are read from the nodes, bit for bit
    assert_array_equal(read.values, written.values)
    assert_array_equal(read.guards, written.guards)
    if seed % 10 == 0:
        with np.errstate(all="ignore"):
            second = as_loop(kernel, inputs)
        agree(second.values[:, 0], wanted, good)
        assert_array_equal(first.guards > 0.0, second.guards > 0.0)
    with np.errstate(all="ignore"):
        reading = machine.plan.read(inputs)
    steps = [np.ravel(part) for name in machine.plan.moving for part in (reading.at(name).x, reading.at(name).y)]
    agree(first.values[: len(steps), 0], steps, good)


@first_daily(1, "start", range(0, 200, 20))
def test_all_ways_agree_over_random_mechanisms(start, monkeypatch):
    for seed in range(start, start + 20):
        check_random(seed, monkeypatch)


@pytest.mark.slow
@pytest.mark.parametrize("start", range(1000, 2000, 50))
def test_all_ways_agree_over_a_thousand_random_mechanisms(start, monkeypatch):
    for seed in range(start, start + 50):
        check_random(seed, monkeypatch)


def hitch_designs(m, n):
    """Return inputs of m designs of the hitch at n strokes."""
    random = np.random.default_rng(5)
    designs = dict(ThreePointHitch().dimensions)
    if m > 1:
        designs |= {name: designs[name] * random.uniform(0.99, 1.01, m) for name in ("OB", "CD", "MK", "KFG")}
    return designs | {"S": np.linspace(0.0, 0.25, n)}


@for_all(("m", "n"), (), slow=[(1, 1), (1, 40000), (3, 50), (50, 3), (20000, 2), (9000, 20)])
def test_designs_and_poses_in_every_proportion(m, n):
    kernel, inputs = everything(ThreePointHitch), hitch_designs(m, n)
    tall = {name: value if name == "S" or np.ndim(value) == 0 else value[:, None] for name, value in inputs.items()}
    wanted = np.array([np.broadcast_to(part, (m, n)) for part in interpret(kernel.outputs, tall)])
    agree(kernel(inputs, way=RunOptions("numpy")).values, wanted)
    agree(kernel(inputs, way=RunOptions("numpy", threads=3)).values, wanted)
    out = np.full((24, m, n), 7.0)
    assert kernel(inputs, out, RunOptions("numpy")).values is out
    agree(out, wanted)


@pytest.mark.parametrize("turned", [False, True])
def test_the_loop_along_designs_is_the_loop_along_poses(turned):
    kernel, inputs = everything(ThreePointHitch, guarded=True), hitch_designs(300, 4)
    kernel.fused._ready = {False: uncompiled(kernel.fused.plan), True: uncompiled(kernel.fused.plan, turned=turned)}
    if not turned:
        kernel.fused._ready[True] = uncompiled(kernel.fused.plan, turned=True)
        inputs |= {"S": np.tile(inputs["S"], (300, 1))}  # a stroke for each design: the loop goes along the poses
    found = kernel(inputs, way=RunOptions("numba"))
    agree(found.values, kernel(inputs, way=RunOptions("numpy")).values)
    assert np.all(found.guards > 0.0)


def test_a_guard_tells_in_every_way():
    kernel, inputs = everything(ThreePointHitch, guarded=True), hitch_designs(1, 30) | {"S": np.linspace(0.2, 0.5, 30)}
    kernel.fused._ready = {False: uncompiled(kernel.fused.plan)}
    with np.errstate(all="ignore"):
        told = [kernel(inputs, way=RunOptions(name)).guards > 0.0 for name in ("numpy", "floats", "numba")]
    assert not told[0].all()
    assert_array_equal(told[0], told[1])
    assert_array_equal(told[0], told[2])


# -- Numba and C ---------------------------------------------------------------------------------------------


@pytest.fixture
def cache_folder(tmp_path, monkeypatch):
    monkeypatch.setenv("HYDROLINKAGE_CACHE", str(tmp_path / "kernels"))
    return tmp_path / "kernels"


COMPILED = [SHIPPED["four_bar"], *(pytest.param(each, marks=pytest.mark.slow) for each in (ThreePointHitch, SHIPPED[GROUPED[0]]))]


@pytest.mark.parametrize("machine", COMPILED)
def test_the_compiled_loop_agrees_and_is_cached(machine, cache_folder):
    pytest.importorskip("numba")
    inputs = given(machine, 300)
    first, second = everything.__wrapped__(machine, guarded=True), everything.__wrapped__(machine, guarded=True)
    wanted = first(inputs, way=RunOptions("numpy"))
    found = first(inputs, way=RunOptions("numba", threads=2))
    agree(found.values[:, 0], wanted.values[:, 0], firm(machine, inputs))
    assert_array_equal(found.guards > 0.0, wanted.guards > 0.0)
    kept = {file: file.stat().st_mtime_ns for file in cache_folder.rglob("*.nbc")}
    assert len(kept) == 1
    assert_array_equal(second(inputs, way=RunOptions("numba")).values, first(inputs, way=RunOptions("numba")).values)
    assert {file: file.stat().st_mtime_ns for file in cache_folder.rglob("*.nbc")} == kept


def test_a_program_is_written_once_and_mended(cache_folder):
    file = CompiledFile.for_text("x = 1\n").file
    date = file.stat().st_mtime_ns
    assert CompiledFile.for_text("x = 1\n").file == file
    assert file.stat().st_mtime_ns == date
    for wrong in (b"x = 2\n", b"\xff\n", b""):
        file.write_bytes(wrong)
        assert CompiledFile.for_text("x = 1\n").file.read_text(encoding="utf-8") == "x = 1\n"
    assert sorted(each.name for each in cache_folder.iterdir()) == ["__pycache__", file.name]


def test_without_numba_everything_works_and_asking_for_it_says_how(monkeypatch):
    monkeypatch.setitem(sys.modules, "numba", None)
    kernel = everything.__wrapped__(ThreePointHitch)
    kernel._spent = 10**12
    assert kernel(hitch_designs(1, 50)).values.shape == (24, 1, 50)
    with pytest.raises(LinkageError, match=r"hydrolinkage\[fast\]"):
        kernel(hitch_designs(1, 50), way=RunOptions("numba"))


@pytest.mark.parametrize("asked", [{"backend": "cuda"}, {"threads": 0}, {"threads": 1.5}])
def test_an_unknown_way_is_refused(asked):
    with pytest.raises(DefinitionError, match=next(iter(asked))):
        RunOptions(**asked)


@pytest.mark.skipif(shutil.which("gcc") is None, reason="no C compiler")
@first_daily(1, "machine", [ThreePointHitch, SHIPPED[GROUPED[0]]])
def test_the_text_in_c_agrees(machine, tmp_path):
    kernel, inputs = everything(machine), given(machine, 200)
    (tmp_path / "k.c").write_text(LANGUAGES["c"].text(kernel.outputs), encoding="utf-8")
    flags = ["-O2", "-std=c99", "-Wall", "-Werror", "-Wno-unused-variable", "-shared", "-fPIC"]
    subprocess.run(["gcc", *flags, "-o", tmp_path / "k.so", tmp_path / "k.c", "-lm"], check=True)
    pointer = ctypes.POINTER(ctypes.c_double)
    plan, out = kernel.fused.plan, np.empty((len(kernel.plan.outputs), 200))
    design = np.array([inputs[node.value] for node in plan.design_inputs])
    poses = [np.ascontiguousarray(np.ravel(inputs[node.value])) for node in plan.pose_inputs]
    arguments = [(pointer * len(rows))(*(row.ctypes.data_as(pointer) for row in rows)) for rows in (poses, out)]
    ctypes.CDLL(str(tmp_path / "k.so")).poses(ctypes.c_long(200), design.ctypes.data_as(pointer), *arguments)
    agree(out, kernel(inputs, way=RunOptions("numpy")).values[:, 0], firm(machine, inputs))


@pytest.mark.parametrize("name", ["sin", "cos"])
def test_sines_and_cosines_are_those_of_numpy(name):
    graph = Graph()
    node = graph.apply(name, graph.input("a", Level.POSE))
    quarters = np.arange(-9, 10) * (math.pi / 2)
    a = np.concatenate([np.linspace(-50.0, 50.0, 4001), quarters, quarters + 1e-9, [0.0, 1e5, -1e5, np.nan, np.inf]])
    (halfway,) = with_half_angles([node])
    assert [each.op for each in ancestors([halfway])].count("tan") == 1
    whole = uncompiled(schedule([node])).__globals__[{"sin": "sine", "cos": "cosine"}[name]]
    with np.errstate(invalid="ignore"):
        wanted = getattr(np, name)(a)
        for found in (interpret([halfway], {"a": a})[0], np.array([whole(each) for each in a])):
            assert_array_equal(np.isnan(found), np.isnan(wanted))
            assert np.nanmax(np.abs(found - wanted)) < 4e-16


@pytest.mark.skipif(shutil.which("node") is None, reason="no JavaScript")
@first_daily(2, "machine", [ThreePointHitch, SHIPPED["four_bar"], SHIPPED[GROUPED[0]]])
def test_the_text_in_javascript_agrees(machine):
    kernel, inputs = everything(machine), given(machine, 5)
    plan = kernel.fused.plan
    rows = np.array([np.ravel(inputs[node.value]) for node in plan.pose_inputs]).T.tolist()
    asked = json.dumps([[inputs[node.value] for node in plan.design_inputs], rows]).replace("NaN", "null")
    call = f"const [d, rows] = {asked}; console.log(JSON.stringify(rows.map(p => poses(d, p.map(v => v === null ? NaN : v)))))"
    text = LANGUAGES["javascript"].text(kernel.outputs)
    said = subprocess.run(["node", "-e", text + call], check=True, capture_output=True, text=True).stdout
    found = np.array([[np.nan if part is None else part for part in row] for row in json.loads(said)]).T
    agree(found, kernel(inputs, way=RunOptions("numpy")).values[:, 0], firm(machine, inputs))


# -- the program itself --------------------------------------------------------------------------------------


def test_the_hitch_needs_no_more_operations_than_by_hand():
    plan = ThreePointHitch.plan
    y = plan.nodes("G")[1:]
    kernel = plan.made("a program of its own", lambda twin: Kernel([*twin.nodes("G"), *twin.derived(twin.nodes("G")[1:], ("S",))]))
    assert len(y) == 1
    assert len(kernel.plan.pose) <= 99
    assert sum(node.op in ("divide", "reciprocal") for node in kernel.plan.pose) == 5
    assert sum(node.op == "sqrt" for node in kernel.plan.pose) == 3
    assert kernel.arrays._code[1] <= 12


@MACHINES
def test_the_determinant_of_a_loop_is_the_one_at_hand(machine):
    plan, inputs = machine.plan, given(machine, 30, beyond=0.0)
    closures = {root.closure for root in plan.trace.graph.nodes if root.closure is not None and root.closure.determinant is not None}
    for closure in closures:
        (a, b), (c, d) = jacobian(plan.trace.graph, closure)
        at_hand, wanted = interpret([closure.determinant, a * d - b * c], inputs)
        assert_allclose(np.broadcast_to(at_hand, np.shape(wanted)), wanted, rtol=1e-9, atol=1e-12)


def test_most_loops_have_a_determinant_at_hand():
    nodes = [node for machine in SHIPPED.values() for node in machine.plan.trace.graph.nodes if node.closure is not None]
    assert sum(node.closure.determinant is not None for node in nodes) > 0.9 * sum(len(node.closure.roots) == 2 for node in nodes)


def alive(order, outputs):
    """Return how many values besides the outputs are alive at once."""
    last = {arg.origin: place for place, node in enumerate(order) for arg in node.args}
    count = peak = 0
    for place, node in enumerate(order):
        ended = {arg.origin for arg in node.args if last[arg.origin] == place and arg.origin in order and arg.origin not in outputs}
        count += (node not in outputs) - len(ended)
        peak = max(peak, count)
    return peak


@MACHINES
def test_an_order_is_one_of_dependence(machine):
    plan = everything(machine).plan
    place = {node: k for k, node in enumerate(plan.economical)}
    assert place.keys() == set(plan.pose)
    assert all(place.get(arg, -1) < place[node] for node in plan.pose for arg in node.args)


def test_in_the_order_taken_few_values_are_alive():
    """In programs with something to gain; in small ones a value more is no matter."""
    plans = [everything(machine).plan for machine in SHIPPED.values()]
    counts = np.array([[alive(order, set(plan.outputs)) for order in (plan.economical, plan.pose)] for plan in plans])
    taken, written = counts[counts[:, 1] >= 20].T
    assert len(written) >= 3
    assert np.all(taken <= written)
    assert taken.sum() < 0.8 * written.sum()


def test_a_kernel_does_not_depend_on_what_was_asked_for_before():
    texts = []
    for before in ((), ("tilt", "C", "K")):

        class Twin(ThreePointHitch):
            pass

        for name in before:
            Twin.plan.kernel((name,), ("S",))
        texts.append(Twin.plan.kernel(("G",), ("S",)).arrays._code[0])
    assert texts[0] == texts[1]


def test_lowering_takes_a_division_for_a_reciprocal_used_once():
    graph = Graph()
    a, s, t = graph.input("a", Level.DESIGN), graph.input("s", Level.POSE), graph.input("t", Level.POSE)
    assert [node.op for node in lowered([a / s, s * s, -(s - t)])] == ["divide", "square", "subtract"]
    assert [node.op for node in schedule([a / s, t / s]).pose] == ["reciprocal", "multiply", "multiply"]


@pytest.mark.parametrize("n", [3, 4, 6])
def test_a_system_written_out_is_solved(n):
    graph, random = Graph(), np.random.default_rng(n)
    names = [f"e{k}" for k in range(n * n + n)]
    system = graph.apply("solve", *(graph.input(name, Level.POSE) for name in names))
    unknowns = expanded([graph.apply("component", system, float(k)) for k in range(n)])
    values = random.uniform(-1.0, 1.0, (n * n + n, 50))
    values[0] = 0.0  # the first pivot is none
    assert_allclose(interpret(unknowns, dict(zip(names, values, strict=True))), solve_arrays(*values), rtol=1e-9)


def test_registers_start_at_multiples_of_64_bytes():
    assert all(register.ctypes.data % 64 == 0 and register.size == 1001 for register in aligned(7, 1001))
    assert cache_size() >= 1 << 16


# -- the bulk call -------------------------------------------------------------------------------------------


def test_memory_beyond_the_results_does_not_grow_with_the_poses():
    from linkage import ratio

    hitch, peaks = ThreePointHitch(), []
    for count in (400_000, 1_600_000):
        stroke = np.linspace(0.0, 0.25, count)
        out = np.empty((4, stroke.size))
        hitch.evaluate(["G", ratio("G")], S=stroke[:100], out=out[:, :100].copy())
        tracemalloc.start()
        hitch.evaluate(["G", ratio("G")], S=stroke, out=out, backend="numpy")
        peaks.append(tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
    assert peaks[1] < peaks[0] + 2e5  # the registers; the strokes alone are 9.6 MB more


def test_poses_that_share_a_dead_point_do_not_spoil_each_other():
    class Rocker(Mechanism):
        phi = Stroke(0.0, 6.0)
        O, C = Ground(0.0, 0.0), Ground(1.0, 0.0)
        A = Crank(O, OA=0.4, angle=phi)
        B = Dyad(A, C, AB=0.5, BC=0.5, side=LEFT)

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        (B,) = Rocker().evaluate(["B"], phi=[0.1, math.pi, 0.2], unreachable="nan")
    assert_array_equal(np.isnan(B), [[False, True, False]] * 2)


@pytest.mark.parametrize("threads", [1, 2])
def test_threads_run_where_more_than_one_is_asked_for(monkeypatch, threads):
    ran = []
    run = kernel_module.run_threads
    monkeypatch.setattr(kernel_module, "run_threads", lambda *given: ran.append(given[-1]) or run(*given))
    ThreePointHitch().evaluate(["G"], S=np.linspace(0.0, 0.2, 11), backend="numpy", threads=threads)
    assert ran == [threads] * (threads > 1)


def test_an_operation_is_shaken_by_one_to_two_of_its_last_digits():
    """A digit is half an epsilon to one of a number's size: less than that measures nothing, more blames what is right."""
    changes = np.abs(noise())
    assert not changes[:, 0].any()
    assert 0.5 * np.finfo(float).eps < changes.max() < np.finfo(float).eps
