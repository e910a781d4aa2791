"""What is asked of cylinders: their own methods' values by every way of asking, exact derivatives, and refusals in words."""

import pickle

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Cylinder, LiftCircuit, buckling, capacity, pressure, reserve, thrust
from linkage import DefinitionError, LoadCase, SingularError, bar, drive_force, least, mm, plot, ratio, y
from linkage.errors import UntracedError
from linkage.motion.requests import Trait
from linkage.study import settings_for, zone
from mechanisms.at_work.levelled import LevelledTelehandler
from mechanisms.header_balancer.machine import HeaderBalancer
from mechanisms.mower_lift import MowerLift
from mechanisms.three_point_hitch.machine import ThreePointHitch
from tests.for_all import for_all
from tests.machines.test_axle import Axle
from tests.machines.test_baler import Baler
from tests.machines.test_excavator import ByAngles, Excavator
from tests.machines.test_forestry_crane import Crane
from tests.machines.test_lifting_arm import OnePressureTurned, Pulled
from tests.machines.test_mast_tilt import Mast
from tests.machines.test_plough import Dry, Plough
from tests.machines.test_scissor_table import table_of_links
from tests.machines.test_sprayer_fold import Fold
from tests.machines.test_tipper import assisted_list

POSES = 5
CASES = [
    (HeaderBalancer, "lift", "", ["charge", "L_OB"]),
    (OnePressureTurned, "aux", "", ["aux.bore", "lift.rod"]),
    (Plough, "turn", "G", ["turn.bore", "line.back_pressure"]),
    (Axle, "strut", "", []),
]


def slow_cases():
    """Return more machines, each with a cylinder, a point that it lifts and dimensions."""
    return [
        (ThreePointHitch, "lift", "G", ["OB", "M.x", "lift.bore", "circuit.mechanical_efficiency", "load.mass"]),
        (MowerLift, "lift", "G", ["k_m", "bore"]),
        (Excavator, "arm", "H", ["arm.bore", "boom.rod"]),
        (ByAngles, "boom", "H", ["boom.bore", "bucket.rod"]),
        (Crane, "fold", "T", ["QL", "fold.bore"]),
        (Crane, "raise_", "T", ["OB", "raise_.rod"]),
        (Crane, "extend", "T", ["OP", "extend.rod"]),
        (table_of_links(), "lift", "H", ["lift.bore"]),
        (Fold, "lift", "", ["lift.bore"]),
        (Mast, "tilt", "", ["aux.bore"]),
        (assisted_list(), "aux", "G", ["aux.bore"]),
    ]


def asked_of_circuit(circuit, name, point):
    """Return requests of a cylinder on a circuit with what the circuit's methods give of a motion."""
    found = [
        (reserve(name), lambda motion: circuit.reserve(motion, cylinder=name)),
        (pressure(name, circuit=circuit.name), lambda motion: circuit.pressure_for(motion, cylinder=name)),
        (capacity(name, point, share=0.9), lambda motion: circuit.capacity(motion, point, cylinder=name, share=0.9)),
    ]
    return found if point else found[:2]


def name_of_case(value):
    """Return what a case is called: its class and its cylinder."""
    return value.__name__ if isinstance(value, type) else value if isinstance(value, str) else ""


def some_poses(machine, seed):
    """Return strokes of poses that are reached, apart from each other."""
    rng = np.random.default_rng(seed)
    strokes = {name: each.start + (each.end - each.start) * rng.uniform(0.05, 0.95, 40) for name, each in machine.strokes.items()}
    found = np.flatnonzero(machine.at(unreachable="nan", **strokes).reached)[:POSES]
    return {name: value[found] for name, value in strokes.items()}


def asked_of(machine, name, point):
    """Return requests of a cylinder with what its methods give of a motion."""
    ram = machine.plan.members[name]
    circuits = [each for each in machine.plan.of_kind(LiftCircuit).values() if ram in each.members(machine.plan.members)]
    found = [
        (thrust(name), ram.thrust),
        (thrust(ram, direction="extending"), lambda motion: ram.thrust(motion, direction="extending")),
        (pressure(name), ram.pressure),
        (buckling(name), ram.buckling_use),
    ]
    for each in circuits:
        found += asked_of_circuit(each, name, point)
    return found


@for_all(("structure", "name", "point", "wrt"), CASES, ids=name_of_case, slow=slow_cases)
def test_a_request_is_the_method_by_every_way_and_has_its_derivatives(structure, name, point, wrt):
    machine = structure()
    strokes = some_poses(machine, seed=len(name) + len(structure.__name__))
    motion = machine.at(unreachable="nan", **strokes)
    asked = asked_of(machine, name, point)
    requests, expected = [request for request, _ in asked], [method(motion) for _, method in asked]
    first = {each: float(value[0]) for each, value in strokes.items()}
    at_first = machine.function(requests)(**first)
    for request, values, found, alone in zip(
        requests, expected, machine.evaluate(requests, unreachable="nan", **strokes), at_first, strict=True
    ):
        assert values.shape == motion.shape
        assert_allclose(motion[request], values, rtol=0, err_msg=str(request))
        assert_allclose(found, values, rtol=1e-9, atol=1e-9 * np.nanmax(np.abs(values), initial=0.0), err_msg=str(request))
        assert_allclose(alone, found[0], rtol=1e-12, err_msg=str(request))
    has_derivatives(machine, strokes, [one for one in asked if is_traced(machine, one[0])], wrt)


def is_traced(machine, request):
    """Return whether a request has a program: what rubs on the balancer's pins and a spring set at a group's sketch have none."""
    try:
        request.bound(machine.plan)
    except UntracedError:
        assert isinstance(machine, (HeaderBalancer, assisted_list()))
        return False
    return True


def has_derivatives(machine, strokes, asked, wrt):
    """Check the gradient of the sum of all requests, each over its size, against central differences of the methods."""
    motion = machine.at(unreachable="nan", **strokes)
    each_of = [(request, method, np.nanmax(np.abs(method(motion)), initial=0.0)) for request, method in asked]
    known = [each for each in each_of if each[2] > 0.0]
    total = sum((request / float(size) for request, _, size in known[1:]), known[0][0] / float(known[0][2]))
    for row, dimension in zip(motion.gradient(total, wrt) if wrt else (), wrt, strict=True):
        value = float(np.reshape(machine.plan.defaults[dimension], ()))
        step = 3e-5 * max(abs(value), 0.01)
        moves = [machine.replaced(**moved(machine, dimension, value + k * step)).at(unreachable="nan", **strokes) for k in (1, -1, 2, -2)]
        near, back, far, behind = (sum(method(each) / size for _, method, size in known) for each in moves)
        central = (8.0 * (near - back) - (far - behind)) / (12.0 * step)
        assert np.array_equal(np.isnan(row), np.isnan(central)), dimension
        assert_allclose(row, central, rtol=1e-6, atol=1e-7 / max(abs(value), 0.01), err_msg=dimension)


def moved(machine, dimension, value):
    """Return a dimension, or the point whose coordinate it is, with another value."""
    if dimension.endswith((".x", ".y")) and dimension[:-2] in machine.plan.points:
        point, axis = dimension[:-2], dimension[-1]
        pair = {each: float(machine.plan.defaults[f"{point}.{each}"]) for each in "xy"} | {axis: value}
        return {point: (pair["x"], pair["y"])}
    return {dimension: value}


class Both(ThreePointHitch):
    """One pump on the cylinder, and another."""

    spare = LiftCircuit("lift", pressure=120 * bar, mechanical_efficiency=0.9)
    empty = LoadCase("empty", scale={"load": 0.25})


class Bare(ThreePointHitch):
    """No pump at all."""

    circuit = None


def test_circuits_and_cases_are_named():
    machine, S = Both(), [0.05, 0.2]
    motion = machine.at(S=S)
    for request in (reserve("lift"), capacity("lift", "G"), pressure("lift")):
        with pytest.raises(DefinitionError, match=r"lift is on 2 circuits.*(say which, circuit='circuit' or 'spare'|name one)"):
            machine.evaluate([request], S=S)
        with pytest.raises(DefinitionError, match="lift is on 2 circuits"):
            motion[request]
    found = motion[reserve(Both.lift, circuit=Both.spare, case="empty")]
    assert_allclose(found, Both.spare.reserve(motion, case=Both.empty), rtol=0)
    assert_allclose(found, machine.evaluate([reserve("lift", circuit="spare", case="empty")], S=S)[0], rtol=1e-12)
    assert_allclose(found, 4.0 * motion[reserve("lift", circuit="spare")], rtol=1e-12)
    with pytest.raises(DefinitionError, match=r"'other' is unknown.*circuit, spare"):
        motion[reserve("lift", circuit="other")]
    with pytest.raises(DefinitionError, match="Load case 'full' is unknown"):
        machine.evaluate([thrust("lift", case="full")], S=S)
    with pytest.raises(DefinitionError, match=r"no LiftCircuit has it.*declare one, circuit = LiftCircuit\(lift"):
        Bare().evaluate([reserve("lift")], S=S)


def test_what_no_pump_moves_has_no_reserve_by_any_door():
    """A cylinder on a closed line, and one on a tank: its reserve and capacity are refused alike, its pressure is there."""
    levelled = LevelledTelehandler()
    motion, line, master = levelled.sweep(**dict.fromkeys(levelled.strokes, 2)), levelled.outward, "master"
    point = list(levelled.plan.moving)[-1]
    doors = [
        lambda: motion[reserve(master)], lambda: motion[capacity(master, point)], lambda: motion[reserve(master, circuit="outward")],
        lambda: levelled.answers([least(reserve(master))]), lambda: line.reserve(motion, cylinder=master),
        lambda: line.largest(motion, cylinder=master), lambda: line.capacity(motion, point), lambda: line.supply(motion),
    ]  # fmt: skip
    for door in doors:
        with pytest.raises(DefinitionError, match="outward: no pump is on it, and it lifts nothing; name a line that has one"):
            door()
    assert_allclose(motion[pressure(master, circuit="outward")], line.pressure(motion), rtol=1e-12)


@for_all(
    ("make", "words"),
    [
        (lambda: thrust("lift", direction="up"), "Direction 'up' is unknown"),
        (lambda: capacity("lift", "G", along=(0, 0)), "has no length"),
        (lambda: capacity("lift", "G", share=1.5), "share = 1.5"),
        (lambda: ThreePointHitch().evaluate([thrust("jack")], S=0.1), "Cylinder 'jack' is unknown.*lift"),
        (lambda: ThreePointHitch().at(S=0.1)[capacity("lift", "Z")], "'Z'"),
        (lambda: ThreePointHitch().evaluate([capacity("lift", "Z")], S=0.1), "Point 'Z' is unknown"),
        (lambda: bool(thrust("lift") > 3), r"least\(q\) >= "),
    ],
)
def test_what_there_is_not_is_refused(make, words):
    with pytest.raises(DefinitionError, match=words):
        make()


def test_where_the_load_drives_there_is_a_gap_and_no_error():
    machine, (stroke, S) = Plough(), next((name, np.linspace(each.start, each.end, 40)) for name, each in Plough().strokes.items())
    one_side = Cylinder("A", "B", bore=80 * mm, rod=40 * mm)
    pushing = type("Pushing", (Plough,), {"turn": one_side})()
    motion = pushing.at(**{stroke: S})
    line = pushing.plan.members["line"]
    values = line.reserve(motion)
    assert 0 < np.isnan(values).sum() < len(S)
    (found,) = pushing.evaluate([reserve("turn")], **{stroke: S})  # and no error
    assert_allclose(found, values, rtol=1e-9)
    twice = reserve("turn") * 2.0 - ratio(y("G"))
    assert_allclose(pushing.evaluate([twice], **{stroke: S})[0], 2.0 * values - motion.ratio(y("G")), rtol=1e-9)
    assert_allclose(motion[twice], 2.0 * values - motion.ratio(y("G")), rtol=1e-12)
    assert np.array_equal(np.isnan(motion.gradient(reserve("turn"), ["turn.bore"])[0]), np.isnan(values))
    out = np.empty((3, len(S)))
    pushing.evaluate(["G", reserve("turn")], out=out, **{stroke: S})
    assert np.array_equal(np.isnan(out[2]), np.isnan(values)) and np.isfinite(out[:2]).all()
    empty = float(S[np.isnan(values)][0])
    assert np.isnan(pushing.function([reserve("turn")])(empty)[0])
    assert np.isnan(pushing.evaluate([reserve("turn")], **{stroke: empty})[0])
    assert np.isfinite(machine.at(**{stroke: S})[reserve("turn")]).all()  # it works with both sides


def test_with_friction_there_are_values_and_no_derivatives():
    machine = Dry()
    strokes = {"phi": np.array([0.3, 0.6, 2.4])}
    motion = machine.at(**strokes)
    request = pressure("turn") / bar - 3.0 * drive_force() / drive_force()
    expected = machine.plan.members["turn"].pressure(motion) / bar - 3.0
    assert_allclose(motion[request], expected, rtol=1e-12)
    out = np.empty((4, 3))
    force, found, _ = machine.evaluate([thrust("turn"), request, "G"], out=out, **strokes)
    assert np.shares_memory(found, out)
    assert_allclose(found, expected, rtol=1e-12)
    assert_allclose(force, machine.plan.members["turn"].thrust(motion), rtol=1e-12)
    assert_allclose(machine.function([request])(float(strokes["phi"][0])), expected[:1], rtol=1e-12)
    with pytest.raises(
        DefinitionError, match=r"pressure\(turn\): Dry: the friction of shaft, eye_A, eye_B .* no derivatives.*frictionless"
    ):
        motion.gradient(request, ["turn.bore"])
    assert np.isfinite(motion.gradient(thrust("turn"), ["turn.bore"])).all()


def test_what_rubs_along_a_path_is_told_by_a_motion():
    machine = Baler()
    strokes = some_poses(machine, seed=3)
    motion = machine.at(**strokes)
    request = thrust("press", direction="extending")
    assert_allclose(machine.evaluate([request], **strokes)[0], motion[request], rtol=0)
    with pytest.raises(DefinitionError, match="along the path of several strokes"):
        motion.gradient(request, ["press.bore"])


def test_a_pose_at_which_the_cylinder_stands_still_is_refused_alike():
    machine = OnePressureTurned()
    stroke = next(iter(machine.strokes))
    lift = machine.plan.members["lift"]
    at = np.linspace(-np.pi, np.pi, 2001)
    wide = machine.at(unreachable="nan", **{stroke: at})
    growth = lift.growth(wide, {stroke: 1.0})
    places = np.flatnonzero(np.sign(growth[1:]) * np.sign(growth[:-1]) < 0.0)
    assert len(places)
    low, high = at[places[0]], at[places[0] + 1]
    for _ in range(60):
        middle = 0.5 * (low + high)
        sign = np.sign(lift.growth(machine.at(**{stroke: middle}), {stroke: 1.0}))
        low, high = (middle, high) if sign == np.sign(growth[places[0]]) else (low, middle)
    alone = type("Alone", (OnePressureTurned,), {"aux": None, "line": LiftCircuit("lift", pressure=160 * bar)})()
    with pytest.raises(SingularError, match="stands still against the drive"):
        alone.at(**{stroke: low})[thrust("lift")]
    with pytest.raises(SingularError, match="stands still against the drive"):
        alone.evaluate([thrust("lift")], **{stroke: low})
    near = low + np.array([-1e-3, 0.0, 1e-3])
    (found,) = alone.evaluate([thrust("lift")], unreachable="nan", **{stroke: near})
    assert np.isnan(found).tolist() == [False, True, False]


def test_zones_settings_and_plots_take_requests():
    hitch = ThreePointHitch()
    found = zone(hitch, reserve("lift"), {"OB": (0.29, 0.31)}, S=[0.2])
    ends = [ThreePointHitch(OB=value).at(S=[0.2])[reserve("lift")] for value in (0.29, 0.31)]
    assert found.quantity == "reserve(lift)"
    assert_allclose([found.low, found.high], [np.min(ends, axis=0), np.max(ends, axis=0)], rtol=1e-9)
    settings = settings_for(hitch, "OB", pressure("lift"), 40 * bar, between=(0.25, 0.4), S=0.1)
    assert len(settings.values)
    assert_allclose([ThreePointHitch(OB=value).at(S=0.1)[pressure("lift")] for value in settings.values], 40 * bar, rtol=1e-9)
    figure = plot(hitch.sweep(11), [pressure("lift"), thrust("lift") / 2.0, "tilt", ratio(y("G"))])
    assert [ax.get_title(loc="left") for ax in figure.axes] == ["pressure(lift), bar", "thrust(lift) / 2.0, kN", "tilt, deg", "ratio(y(G))"]
    with pytest.raises(DefinitionError, match=r"ratio\(G\) has two parts"):
        plot(hitch.sweep(11), [ratio("G")])


def test_a_pressure_is_written_as_text():
    text = ThreePointHitch().source([pressure("lift") / bar], language="javascript")
    assert "function poses" in text and "lift.bore" in text


def test_two_that_are_equal_share_one_kernel():
    hitch = ThreePointHitch()
    assert thrust("lift").bound(hitch.plan).key == thrust(ThreePointHitch.lift, direction="extending").bound(hitch.plan).key
    assert thrust("lift").bound(hitch.plan).key != thrust("lift", case=LoadCase("half", scale={"load": 0.5})).bound(hitch.plan).key
    assert Pulled().at(S=0.1)[thrust("lift")] < 0.0


def test_requests_go_to_other_processes():
    """What a worker of a study is sent asks for the same, and is known as the same."""
    motion, plan = ThreePointHitch().sweep(3), ThreePointHitch.plan
    asked = reserve("lift"), pressure("lift", side="rod"), capacity("lift", "G", share=0.9), buckling("lift"), thrust("lift"), drive_force()
    for request in asked:
        sent = pickle.loads(pickle.dumps(request))
        assert str(sent) == str(request) and sent.identity(plan) == request.identity(plan)
        assert_allclose(motion[sent], motion[request], rtol=0.0, atol=0.0)


def test_what_has_no_bound_in_places_says_so():
    """A reserve and a capacity have none where the load drives, and nor has a sum with one; a pressure and a thrust always have."""
    assert all(Trait.MAY_BE_UNLIMITED in each.traits for each in (reserve("lift"), capacity("lift", "G"), 2.0 * reserve("lift")))
    always = (pressure("lift"), thrust("lift"), thrust("lift") + drive_force(), ratio("G"))
    assert not any(Trait.MAY_BE_UNLIMITED in each.traits for each in always)
