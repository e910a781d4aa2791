"""Every reading of the program agrees: floats, blocks in both orientations, node by node, and the steps on arrays."""

import math
from functools import cache

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from linkage import RIGHT, Dyad, Ground, Mechanism, Stroke
from linkage.errors import AssemblyError
from linkage.plan import REGULAR
from linkage.program import Kernel, interpret
from linkage.program.kernel import FEW
from linkage.program.numpy_backend import LARGEST
from mechanisms.three_point_hitch import ThreePointHitch
from tests.for_all import for_all
from tests.linkage.random_mechanisms import random_mechanism
from tests.shipped import DAILY, MACHINES, over_machines


@cache
def random_machines():
    """Return machines that were drawn by seeds; the last three are of three strokes, of one and of two."""
    return [random_mechanism(seed, strokes=1 + seed % 3, joints=7) for seed in range(20, 29)]


def is_closed(machine):
    """Return whether the program has all places: a group's pins come from Newton's method, before it."""
    return not machine.plan.groups


ALL = over_machines(
    lambda: random_machines()[::4], is_closed, lambda: [machine for place, machine in enumerate(random_machines()) if place % 4]
)


@cache
def everything(machine):
    """Return all positions, and their first derivatives by every stroke, as nodes."""
    plan = machine.plan
    places = [node for name in plan.moving for node in plan.nodes(name)]
    return places + [node for stroke in plan.strokes for node in plan.derived(places, (stroke,))]


@cache
def kernel(machine):
    """Return the kernel of everything."""
    return Kernel(everything(machine))


def inputs(machine, designs, poses, seed=1):
    """Return designs near the default and strokes that leave the reachable range after the first, flat."""
    random = np.random.default_rng(seed)
    vary = (lambda value: value * random.uniform(0.98, 1.02, designs)) if designs > 1 else float
    design = {name: vary(entry.default) for name, entry in machine.plan.table.entries.items()}
    reach = {name: (each.start, each.end - each.start) for name, each in machine.plan.strokes.items()}
    shares = {name: np.append(0.4, max(0.8 / span, 3.0) * random.uniform(-1.0, 1.0, poses - 1)) for name, (_, span) in reach.items()}
    return design | {name: start + span * shares[name] for name, (start, span) in reach.items()}


def firm(machine, given, shape):
    """Return the poses that are not near a dead point: each loop magnifies the rounding of those before it by the inverse of its sine."""
    with np.errstate(all="ignore"):
        sines = machine.plan.read(given).sines.values()
        (nearness,) = table(interpret([machine.plan.trace.nearness(machine.plan.members)], given), shape)
    return ~(abs(math.prod(sines, start=np.float64(1.0))) < 0.03) & ~(nearness < 0.03**2)


def agree(found, wanted, firm=True):
    """Assert that two results agree to 1e-12 of their size at firm poses, some of which have a value, and in where they have none."""
    assert (firm & np.isfinite(wanted)).any()
    found, wanted = (np.where(firm, values, 0.0) for values in (found, wanted))
    assert_array_equal(np.isnan(found), np.isnan(wanted))
    size = np.abs(wanted) + np.nanmax(np.abs(wanted), axis=tuple(range(1, wanted.ndim)), keepdims=True, initial=1.0)
    near = np.abs(found - wanted) / size
    assert np.nanmax(near, initial=0.0) < 1e-12


def table(parts, shape):
    return np.array([np.broadcast_to(part, shape) for part in parts], float)


@ALL
def test_places_by_the_program_and_by_the_steps(machine):
    plan, given = machine.plan, inputs(machine, 1, 400)
    nodes = [node for name in plan.moving for node in plan.nodes(name)]
    with np.errstate(all="ignore"):
        reading = plan.read(given)
    steps = table([part for name in plan.moving for part in (reading.at(name).x, reading.at(name).y)], (400,))
    agree(table(interpret(nodes, given), (400,)), steps, firm(machine, given, (400,)))
    agree(Kernel(nodes)(given).values[:, 0], steps, firm(machine, given, (400,)))


@ALL
def test_a_loop_is_never_told_nearer_to_a_singular_pose_by_its_square_than_by_its_bound(machine):
    """Squared sines over REGULAR's are at most 1; what links of constant lengths allow to be told cheaper is no more than these."""
    given, measures = inputs(machine, 1, 400), [*machine.plan.trace.measures]
    with np.errstate(all="ignore"):
        found = table(interpret([node for each in measures for node in (each.node, each.exact, *each.above)], given), (400,))
    for bound, exact, above, size in found.reshape(-1, 4, 400)[:, :, np.isfinite(found).all(axis=0)]:
        assert_allclose(bound, np.maximum(above, 0.0) / size, rtol=1e-12)
        assert np.all(bound <= exact * (1 + 1e-12)) and np.all(exact * REGULAR**2 <= 1 + 1e-12) and exact.max(initial=1.0) > 1e-3


@ALL
def test_only_parts_that_build_on_one_another_multiply_what_is_lost(machine):
    """The least product of parts is not less than that of all, not more than the least of them, and smaller far from the origin."""
    given, trace, names = inputs(machine, 1, 400), machine.plan.trace, machine.plan.members
    nodes = [trace.nearness(names), trace.least_nearness(names), trace.far, *(each.node for each in trace.measures)]
    with np.errstate(all="ignore"):
        product, least, far, *parts = table(interpret(nodes, given), (400,))
    reached, far = np.isfinite(product), far if parts else np.ones(400)
    single = np.min(np.minimum(parts, 1.0), axis=0, initial=1.0)
    assert np.all(far >= 1.0) and np.all(((least * far >= product * (1 - 1e-12)) & (least * far <= single * (1 + 1e-12)))[reached])


def test_levers_side_by_side_lose_apart_and_in_a_row_together():
    class Levers(Mechanism):
        a, b = Stroke(0.5, 0.9), Stroke(0.5, 0.9)
        O, A, Q, C = Ground(0.0, 0.0), Ground(0.0, -0.8), Ground(2.0, 0.0), Ground(2.0, -0.8)
        B = Dyad(A, O, AB=a, OB=0.3, side=RIGHT)
        D = Dyad(C, Q, CD=b, QD=0.3, side=RIGHT)
        E = Dyad(B, O, BE=0.25, OE=0.4, side=RIGHT)

    trace, given = Levers.plan.trace, {**Levers.plan.defaults, "a": 0.53, "b": 0.52}
    b, d, e = (float(interpret([trace.least_nearness({name})], given)[0]) for name in "BDE")
    together = [float(interpret([trace.least_nearness(names)], given)[0]) for names in ("BD", "BE", "BDE")]
    assert max(b, d, e) < 1.0
    assert_allclose(together, [min(b, d), b * e, min(b * e, d)], rtol=1e-12)


@pytest.mark.slow
def test_some_of_these_poses_are_out_of_reach_and_some_are_not():
    machines = [*filter(is_closed, MACHINES.values()), *random_machines()]
    shares = [np.isnan(kernel(machine)(inputs(machine, 1, 400)).values).mean() for machine in machines]
    assert sum(0.0 < share < 1.0 for share in shares) > len(shares) / 2


SHAPES = [(1, 1), (1, FEW), (1, FEW + 1), (1, 2 * LARGEST + 3), (3, 40), (40, 3), (2, LARGEST + 1), (LARGEST + 1, 2), (7, 1)]
EACH_WAY = [(1, 1), (3, 40), (40, 3)]  # floats, blocks along the poses, blocks along the designs


def shapes(daily):
    """Return machines with numbers of designs and poses: daily a few machines each way and several in every shape, else the rest."""
    several = [ThreePointHitch, *random_machines()[-3:]]
    looked_at = [*map(MACHINES.get, DAILY), *several]
    for machine in filter(is_closed, [*MACHINES.values(), *random_machines()]):
        for shape in SHAPES:
            if daily == (machine in looked_at and (shape in EACH_WAY or machine in several)):
                yield machine, *shape


@for_all(("machine", "designs", "poses"), lambda: [*shapes(True)], slow=lambda: [*shapes(False)])
def test_kernel_is_the_program_node_by_node(machine, designs, poses):
    nodes, given = everything(machine), inputs(machine, designs, poses)
    tall = {name: value[:, None] if np.ndim(value) and name not in machine.plan.strokes else value for name, value in given.items()}
    wanted = table(interpret(nodes, tall), (designs, poses))
    found = kernel(machine)(given).values
    assert found.shape == (len(nodes), designs, poses)
    agree(found, wanted, firm(machine, tall, (designs, poses)))


@ALL
def test_guards_tell_whether_a_pose_is_out_of_reach(machine):
    """A root that a class itself takes has no guard: where it has no value, its point is named when it is asked for."""
    for seed in range(8):
        given = inputs(machine, 1, 5, seed)
        result = machine.plan.kernel(machine.plan.moving, guarded=True)(given)
        if np.isnan(result.values).any() and np.all(result.guards > 0.0):
            with pytest.raises(AssemblyError, match="its point lies nowhere"):
                machine().at(**{name: given[name] for name in machine.plan.strokes})


@ALL
def test_a_result_can_be_written_where_it_is_wanted(machine):
    nodes, given = everything(machine), inputs(machine, 1, 100)
    place = np.full((len(nodes), 1, 100), 7.0)
    assert kernel(machine)(given, out=place).values is place
    agree(place, kernel(machine)(given).values)


@ALL
@for_all(("designs", "poses"), [(1, 0), (0, 5), (0, 0)])
def test_nothing_asked_nothing_given(machine, designs, poses):
    nodes, given = everything(machine), inputs(machine, 1, 4)
    given = {
        name: np.empty(poses) if name in machine.plan.strokes else (np.empty(0) if designs == 0 else value) for name, value in given.items()
    }
    assert kernel(machine)(given).values.shape == (len(nodes), designs, poses)


def test_second_derivatives_of_a_kernel_are_those_of_a_difference():
    plan, h = ThreePointHitch.plan, 1e-5
    first, second = (Kernel(plan.derived(plan.nodes("G"), along)) for along in (("S",), ("S", "S")))
    design = {name: entry.default for name, entry in plan.table.entries.items()}
    stroke = np.linspace(0.05, 0.2, 30)
    slope = (first(design | {"S": stroke + h}).values - first(design | {"S": stroke - h}).values) / (2 * h)
    assert_allclose(second(design | {"S": stroke}).values, slope, rtol=1e-6, atol=1e-7)
