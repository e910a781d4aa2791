"""Thrusts and pin forces as requests: the numbers and refusals of driving_force and pin_forces, in every back end."""

import gc
import warnings
import weakref
from dataclasses import dataclass

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from linkage import (
    LEFT,
    AssemblyError,
    Crank,
    DefinitionError,
    Dyad,
    Force,
    ForceElement,
    Ground,
    Link,
    LinkMass,
    LoadCase,
    Mechanism,
    OnLink,
    PinFriction,
    Rope,
    SingularError,
    SingularWarning,
    Spring,
    Stroke,
    Weight,
    deg,
    drive_force,
    driving_force,
    pin_force,
    pin_forces,
    ratio,
)
from linkage.loads import Load
from linkage.motion.requests import bound
from linkage.statics import force_requests
from mechanisms.classics.four_bar import FourBar
from mechanisms.classics.stephenson_three import StephensonThreeFar
from mechanisms.three_point_hitch import ThreePointHitch
from tests.for_all import for_all
from tests.laws.test_statics_laws import daily, moved, random_machines, shipped, weights
from tests.linkage.assembly.test_groups import Platform

STROKE = np.linspace(0.0, 0.25, 41)


class Hitch(ThreePointHitch):
    """The hitch with loads of its own."""

    load = Weight("G", mass=1200.0)
    lower = LinkMass("E D F", mass=30.0)
    relief = Spring("M", "F", stiffness=2e4, free_length=0.4)
    transport = LoadCase("transport", scale={"load": 2.0}, slope=10 * deg)


@pytest.fixture(autouse=True)
def _near_dead_points():
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SingularWarning)
        yield


def agree(found, wanted, room):
    """Compare two results and where they have none."""
    assert np.isfinite(wanted).any()
    assert_array_equal(np.isnan(found), np.isnan(wanted))
    assert_allclose(found, wanted, rtol=0, atol=room * np.nanmax(np.abs(wanted)))


def half():
    """Return half of the machines of every day."""
    return [*daily()[::2], Platform]


@for_all("machine", half, slow=lambda: [each for each in [*shipped(), *random_machines()] if each not in half()])
def test_requests_are_the_forces_of_every_machine(machine):
    motion, loads = moved(machine, 9, 3), weights(machine)
    for drive in machine.plan.strokes:
        (found,) = machine().evaluate([drive_force(drive, loads)], unreachable="nan", **motion.strokes)
        agree(found, driving_force(motion, loads, drive), 1e-12)
    if any(rope.against for rope in machine.plan.of_kind(Rope).values()):
        return  # which of two ropes pulls is told pose by pose: there is no program of the joints
    forces = pin_forces(motion, loads)
    size = max(np.nanmax(each.size) for each in forces.joints)
    bodies = [(each.point, body) for each in forces.joints if each.has_force for body in (each.on, each.by)]
    joints = [each for each in forces.joints if each.has_force and bodies.count((each.point, each.on)) == 1]
    axes = [("x", "y", "size")[place % 3] for place in range(len(joints))]
    asked = [pin_force(each.point, each.on, axis, loads) for each, axis in zip(joints, axes, strict=True)]
    wanted = [{"x": each.force[0], "y": each.force[1], "size": each.size}[axis] for each, axis in zip(joints, axes, strict=True)]
    found = machine().evaluate(asked, unreachable="nan", **motion.strokes)
    assert_array_equal(np.isnan(found), np.isnan(wanted))
    assert_allclose(found, wanted, rtol=0, atol=1e-11 * size)


def in_back_ends():
    """Return machines with the back ends that work them out daily; compiling takes long."""
    return [(each, way) for each in (Hitch, random_machines()[0], StephensonThreeFar) for way in ("numpy", "floats")] + [(FourBar, "numba")]


@for_all(("machine", "backend"), in_back_ends, slow=lambda: [(each, "numba") for each in (Hitch, random_machines()[0], StephensonThreeFar)])
def test_every_back_end_has_the_same_forces(machine, backend):
    (name, stroke), *_ = machine.plan.strokes.items()
    at = {name: np.linspace(stroke.start, stroke.end, 61)[20:40]}
    loads = [Weight(point, mass=40.0) for point in machine.plan.moving]
    motion = machine().at(**at)
    joint = next(each for each in pin_forces(motion, loads).joints if each.has_force and len(pin_forces(motion, loads).at(each.point)) == 1)
    found = machine().evaluate([drive_force(loads=loads), pin_force(joint.point, loads=loads)], backend=backend, **at)
    agree(found[0], driving_force(motion, loads), 1e-12)
    agree(found[1], joint.size, 1e-11)


def test_requests_stand_beside_others_and_in_a_place_given():
    out = np.empty((4, 41))
    G, force, pin = Hitch().evaluate([ratio("G"), drive_force(), pin_force("C", "CD", "y")], S=STROKE, out=out)
    motion = Hitch().at(S=STROKE)
    assert np.shares_memory(force, out)
    assert_allclose(G, motion.ratio("G"), rtol=1e-12)
    assert_allclose(force, driving_force(motion), rtol=1e-12)
    assert_allclose(pin, pin_forces(motion).force("C", on="CD")[1], rtol=1e-11)


def test_load_cases_and_chosen_loads_count():
    motion = Hitch().at(S=STROKE)
    for loads, case in ((None, "transport"), (["load"], None), (None, LoadCase(only=["lower"])), ([Force("K", (1e3, 2e3)), "load"], None)):
        found = Hitch().evaluate([drive_force(loads=loads, case=case), pin_force("E", component="y", loads=loads, case=case)], S=STROKE)
        assert_allclose(found[0], driving_force(motion, loads, case=case), rtol=1e-12)
        assert_allclose(found[1], pin_forces(motion, loads, case=case).force("E")[1], rtol=1e-10)


def test_what_acts_is_looked_up_once_for_all_joints_and_anew_for_given_loads(monkeypatch):
    known, look = [], force_requests.applied_loads
    monkeypatch.setattr(force_requests, "applied_loads", lambda motion, acting, rates: known.append(acting) or look(motion, acting, rates))
    plan = type("Own", (Hitch,), {}).plan
    first = [bound(plan, pin_force(point)) for point in "BDE"]
    assert len(known) == 1 and len({each.key for each in first}) == 3
    given = [bound(plan, pin_force(point, loads=[Weight("G", mass=80.0)])) for point in "BD"]
    assert len(known) == 3 and given[0].traced_with == given[1].traced_with != first[0].traced_with


def test_without_loads_there_is_no_force_and_no_slope():
    motion = ThreePointHitch().at(S=STROKE)
    for asked in (drive_force(loads=[]), pin_force("C", "CD", "x", loads=[])):
        assert_array_equal(ThreePointHitch().evaluate([asked], S=STROKE), np.zeros((1, 41)))
        assert_array_equal(motion.gradient(asked, ["OB"]), np.zeros((1, 41)))


def test_friction_does_not_count_as_in_the_frictionless_thrust():
    loads = ["load", PinFriction("C", radius=0.03, coefficient=0.2)]
    motion = Hitch().at(S=STROKE)
    assert_allclose(Hitch().evaluate([drive_force(loads=loads)], S=STROKE)[0], driving_force(motion, loads), rtol=1e-12)


def test_a_load_at_no_point_is_refused_as_such():
    with pytest.raises(DefinitionError, match=r"^Point 'Q' is unknown in Hitch"):
        Hitch().evaluate([drive_force(loads=[Weight("Q", mass=1)])], S=0.1)


def test_batches_of_designs():
    hitch = Hitch(OB=np.linspace(0.28, 0.32, 3)[:, None], **{"load.mass": np.array([900.0, 1500.0])})
    force, pin = hitch.evaluate([drive_force(), pin_force("C", "CD")], S=STROKE)
    motion = hitch.at(S=STROKE)
    assert force.shape == pin.shape == (3, 2, 41)
    assert_allclose(force, driving_force(motion), rtol=1e-12)
    assert_allclose(pin, np.hypot(*pin_forces(motion).force("C", on="CD")), rtol=1e-11)
    assert pin_force("C", on="D C").bound(motion.plan).key == pin_force("C", on="CD").bound(motion.plan).key


def test_a_function_of_floats():
    force = Hitch(OB=0.31).function([drive_force(), pin_force("C", "CD", "x")])
    motion = Hitch(OB=0.31).at(S=0.1)
    assert_allclose(force(0.1), [driving_force(motion), pin_forces(motion).force("C", on="CD")[0]], rtol=1e-12)
    with pytest.raises(AssemblyError):
        force(0.6)


# -- refusals ------------------------------------------------------------------------------------------------------


def dead_point():
    hitch = Hitch()
    return float(np.hypot(*(hitch["O"] - hitch["A"])) + hitch["OB"] - hitch["L0"])


@pytest.mark.parametrize("asked", [drive_force(), pin_force("B", "AB")])
def test_at_a_dead_point_and_out_of_reach(asked):
    hitch, stroke = Hitch(), [0.1, dead_point(), 0.6]
    with pytest.raises(SingularError, match=r"B = Dyad\(A, O\)"):
        hitch.evaluate([asked], S=stroke[:2])
    with pytest.raises(AssemblyError):
        hitch.evaluate([asked], S=stroke)
    (found,) = hitch.evaluate([asked], S=stroke, unreachable="nan")
    assert_array_equal(np.isnan(found), [False, True, True])


def test_a_thrust_that_does_not_feel_a_dead_point_has_a_value_there():
    """Only the loops that carry a load matter, as in driving_force."""
    loads = [Force("O", (1.0, 0.0))]
    assert_array_equal(Hitch().evaluate([drive_force(loads=loads)], S=[0.1, dead_point()]), [[0.0, 0.0]])


@pytest.mark.parametrize(
    ("asked", "words"),
    [
        (drive_force("T"), "T"),
        (drive_force(loads="lost"), "Load 'lost'"),
        (drive_force(case="sea"), "Load case 'sea'"),
        (drive_force(loads=[Weight("Q", mass=1.0)]), "Q"),
        (pin_force("G"), "Joint 'G'"),
        (pin_force("C", "EDF"), "Body 'EDF'"),
        (pin_force("C", component="z"), "Component 'z'"),
    ],
)
def test_what_there_is_not_is_told(asked, words):
    with pytest.raises(DefinitionError, match=words):
        Hitch().evaluate([asked], S=STROKE)


def test_several_strokes_ask_which_drives():
    with pytest.raises(DefinitionError, match="drive= one of S1, S2, S3"):
        Platform().evaluate([drive_force(loads=[])], S1=0.0, S2=0.0, S3=0.0)


def test_a_request_that_is_bound_to_no_plan_does_not_say_that_it_reads_nothing():
    request = drive_force("W")
    for read in (request.names, request.differentiated, request.nodes):
        with pytest.raises(AssertionError, match=r"drive_force\(W\) is not bound to"):
            read(FourBar.plan)


def test_a_mechanism_that_is_held_twice_is_refused_by_name():
    class Rails(Mechanism):
        phi = Stroke(30 * deg, 150 * deg)
        O, C, E = Ground(0.0, 0.0), Ground(0.10, 0.0), Ground(0.05, 0.0)
        A = Crank(O, OA=0.06, angle=phi)
        B = Dyad(A, C, AB=0.10, CB=0.06, side=LEFT)
        M = OnLink(A, B, AM=0.05)
        third = Link(E, M)
        load = Weight(M, mass=10)

    with pytest.raises(DefinitionError, match=r"overconstrained.*link CB, link EM"):
        Rails().evaluate([pin_force("B")], phi=1.0)
    assert_allclose(Rails().evaluate([drive_force()], phi=[1.0])[0], driving_force(Rails().at(phi=[1.0])), atol=1e-12)


def test_a_driven_cranks_pin_has_one_force_besides_the_drives_couple():
    machine = FourBar
    loads = [Weight("B", mass=10.0)]
    forces = pin_forces(machine().at(phi=[0.5, 1.0]), loads)
    assert {each.kind for each in forces.at("O")} == {"pin", "crank"}
    assert_allclose(machine().evaluate([pin_force("O", component="x", loads=loads)], phi=[0.5, 1.0])[0], forces.force("O")[0], rtol=1e-12)


CALLS = []


@dataclass(frozen=True, eq=False)
class Counted(ForceElement):
    """A weight whose law is counted."""

    point: str

    def loads(self, motion):
        CALLS.append(motion)
        return [Load(self.point, np.stack([0.0 * motion.x(self.point), -100.0 + 0.0 * motion.y(self.point)]))]


class Lever(Mechanism):
    """A cylinder AB on a lever OB."""

    S, A, O = Stroke(0.8, 1.2), Ground(0, 0), Ground(1.0, 0)
    B = Dyad(A, O, AB=S, OB=0.3, side=LEFT)
    load = Counted("B")


class Foreign:
    """Anything with loads, which may change at any time."""

    size = 100.0

    def loads(self, motion):
        return [Load("B", np.stack([0.0 * motion.x("B"), -self.size + 0.0 * motion.y("B")]))]


def test_loads_are_found_by_what_they_are_and_not_traced_again():
    lever = Lever()
    first = [lever.evaluate([drive_force(), pin_force("O", "frame")], S=0.9) for _ in range(3)]
    count = len(CALLS)
    again = [lever.evaluate([drive_force(), pin_force("O", "frame")], S=0.9) for _ in range(3)]
    assert len(CALLS) == count and len({tuple(each) for each in (*first, *again)}) == 1
    for given in ([Counted("B")], Counted("B")):
        at_once = lever.evaluate([drive_force(loads=given)], S=np.array([0.8, 0.9]))[0]
        one_by_one = [lever.evaluate([drive_force(loads=given)], S=S)[0] for S in (0.8, 0.9)]
        count = len(CALLS)
        assert [lever.evaluate([drive_force(loads=given)], S=S)[0] for S in (0.8, 0.9)] == one_by_one
        lever.evaluate([drive_force(loads=given)], S=np.array([0.8, 0.9]))
        assert len(CALLS) == count
        assert_allclose(one_by_one, at_once, rtol=1e-14)
    given = Weight("B", mass=10.0)
    one, other = (lever.evaluate([drive_force(loads=[load])], S=0.9)[0] for load in (given, Weight("B", mass=20.0)))
    assert_allclose(other, 2.0 * one, rtol=1e-14)


def test_loads_that_may_change_are_traced_again():
    lever, foreign = Lever(), Foreign()
    before = lever.evaluate([drive_force(loads=foreign)], S=0.9)[0]
    foreign.size = 200.0
    assert_allclose(lever.evaluate([drive_force(loads=foreign)], S=0.9)[0], 2.0 * before, rtol=1e-14)


def test_loads_that_were_given_are_not_kept_alive():
    lever, load = Lever(), Weight("B", mass=10.0)
    for S in (0.9, 0.9, np.array([0.8, 0.9]), np.array([0.8, 0.9])):
        lever.evaluate([drive_force(loads=[load])], S=S)
    there = weakref.ref(load)
    del load
    gc.collect()
    assert there() is None
