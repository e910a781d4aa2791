"""Laws of the forces, over every shipped machine, with a weight at every moving point and its own loads."""

import warnings
from copy import copy
from functools import cache, singledispatch
from importlib import import_module
from inspect import isclass
from pkgutil import walk_packages

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

import mechanisms
from linkage import (
    LEFT,
    RIGHT,
    Crank,
    Dyad,
    Force,
    Ground,
    Guide,
    GuideFriction,
    Mechanism,
    Moment,
    OnLink,
    PinFriction,
    SingularWarning,
    Spring,
    Support,
    Weight,
    angle,
    driving_force,
    pin_forces,
)
from linkage.loads import ForceElement, TwoPoint
from linkage.mechanism import declared
from mechanisms.crane import ChainCrane
from mechanisms.three_point_hitch import ThreePointHitch
from tests.for_all import for_all
from tests.linkage.random_mechanisms import random_mechanism
from tests.shipped import AT_WORK, DAILY, MACHINES

G0 = 9.80665


@cache
def shipped():
    """Return every machine of the package, but for those of one class in two modules."""
    modules = [import_module(info.name) for info in walk_packages(mechanisms.__path__, "mechanisms.") if not info.name.endswith("demo")]
    return [
        found
        for module in modules
        for found in vars(module).values()
        if isclass(found) and issubclass(found, Mechanism) and found.__module__ == module.__name__ and found.plan.strokes
    ]


@cache
def random_machines():
    """Return machines that were drawn by seeds, of one stroke and of two."""
    return [random_mechanism(seed) for seed in range(4)] + [random_mechanism(seed, strokes=2) for seed in (10, 11)]


@cache
def daily():
    """Return machines that have every kind of member: those of every day but three that add none, and some at work and with a rope."""
    own = (name for name in DAILY if name not in ("crane_skeleton", "mower_lift", "stephenson_three_far"))
    at_work = (AT_WORK[f"at_work.{name}"] for name in ("hoist_tipper", "levelled_telehandler", "tail_lift"))
    return [*map(MACHINES.get, own), *at_work, ChainCrane]


def over_all(more=lambda: random_machines()[::4], later=lambda: [*random_machines()[1:4], *random_machines()[5:]], among=None):
    """Run a law of a `machine` over `daily` and what `more()` gives, and over all others of the package and `later()` under `slow`."""

    def chosen(machines):
        return [machine for machine in machines if among is None or among(machine)]

    def others():
        return [machine for machine in shipped() if machine not in daily()]

    return for_all("machine", lambda: chosen([*daily(), *more()]), slow=lambda: chosen([*others(), *later()]))


ALL = over_all()
ONE = over_all(tuple, tuple, among=lambda machine: len(machine.plan.strokes) == 1)


def weights(machine):
    """Return a weight at every moving point, each of another mass, and the machine's own loads."""
    return [*machine.plan.of_kind(ForceElement).values(), *added(machine)]


def added(machine):
    """Return a weight at every moving point, each of another mass."""
    return [Weight(point, mass=50.0 + 17.0 * k) for k, point in enumerate(machine.plan.moving)]


def moved(machine, count=13, few=4, **options):
    """Return the motion over all strokes."""
    strokes = machine.plan.strokes
    return machine().sweep(**dict.fromkeys(strokes, count if len(strokes) == 1 else few), unreachable="nan", **options)


@pytest.fixture(autouse=True)
def _near_dead_points():
    """Classics come close to their dead points: there both methods lose the same digits, and say so."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SingularWarning)
        yield


@ALL
def test_virtual_work_is_equilibrium(machine):
    motion = moved(machine)
    found = pin_forces(motion, weights(machine))
    assert found.residual < 1e-12
    for name in machine.plan.strokes:
        work = driving_force(motion, weights(machine), name)
        assert np.isfinite(work).sum() >= 0.5 * work.size
        assert_allclose(found.drives[name], work, rtol=1e-9, atol=1e-9 * np.nanmax(np.abs(work)))


@ALL
def test_every_body_is_in_equilibrium(machine):
    """The forces on each body, as handed over, add up to nothing."""
    found = pin_forces(moved(machine, 7, 3), weights(machine))
    size = max(np.nanmax(np.abs(each.force)) for each in found.joints)
    for body in set(found.on_bodies) - {"frame"}:
        forces = found.on_body(body)
        assert np.nanmax(np.abs(sum(forces.values()))) <= 1e-10 * size


def stands_on_the_ground(machine):
    """Return whether a machine is a vehicle: supports bear its frame."""
    return any(each.point.name not in machine.plan.moving for each in machine.plan.of_kind(Support).values())


@ALL
def test_the_frame_carries_all_weight(machine):
    found = pin_forces(moved(machine, 5, 3), [Weight(point, mass=10.0) for point in machine.plan.moving])
    total = sum(found.on_body("frame").values())
    good = np.isfinite(total[0])
    size = max(np.nanmax(np.abs(each.force)) for each in found.joints)
    carried = 0.0 if stands_on_the_ground(machine) else -10.0 * G0 * len(machine.plan.moving)  # a vehicle hands it on to the ground
    assert_allclose(total[1][good], carried, atol=1e-10 * size)
    assert_allclose(total[0][good], 0.0, atol=1e-10 * size)


@ALL
def test_reactions_scale_with_loads_and_add_up(machine):
    motion = moved(machine, 5, 3)
    point = machine.plan.moving[-1]
    pull, weight = Force(point, (300.0, 0.0)), Weight(point, mass=40.0)
    one, other = pin_forces(motion, [pull]), pin_forces(motion, [weight])
    both = pin_forces(motion, [Force(point, (-600.0, 0.0)), Weight(point, mass=120.0)])
    for a, b, c in zip(one.joints, other.joints, both.joints, strict=True):
        expected = -2.0 * a.force + 3.0 * b.force
        assert_allclose(c.force, expected, atol=1e-9 * (1.0 + np.nanmax(np.abs(expected))))


def gauss(machine, name, loads, edges):
    """Return the integral of the thrust over each piece of the stroke [J] and its size, by 24 points of Gauss-Legendre."""
    nodes, share = np.polynomial.legendre.leggauss(24)
    middle, half = (edges[1:] + edges[:-1])[:, None] / 2, np.diff(edges)[:, None] / 2
    motion = machine().at(**{name: (middle + half * nodes).ravel()})
    force = driving_force(motion, loads).reshape(len(middle), -1)
    return (force * share * half).sum(axis=1), np.abs(force * share * half).sum()


@ONE
def test_the_integral_of_thrust_is_the_potential_energy(machine):
    """Over the middle four fifths of the stroke, to 1e-9 of the work done on the way; the pieces are halved where thrust peaks."""
    ((name, stroke),) = machine.plan.strokes.items()
    loads = [Weight(point, mass=50.0 + 17.0 * k) for k, point in enumerate(machine.plan.moving)]
    ends = stroke.start + (stroke.end - stroke.start) * np.array([0.1, 0.9])
    coarse, edges = 0.0, np.linspace(*ends, 17)
    work, size = gauss(machine, name, loads, edges)
    while abs(work.sum() - coarse) > 1e-11 * size and len(edges) < 2000:
        coarse, edges = work.sum(), np.linspace(*ends, 2 * len(edges) - 1)
        work, size = gauss(machine, name, loads, edges)
    motion = machine().at(**{name: ends})
    energy = G0 * sum(load.mass * motion.y(load.point) for load in loads)
    assert_allclose(work.sum(), energy[1] - energy[0], rtol=0, atol=1e-9 * size)


def rubbing(machine, motion):
    """Return weights, and friction in every pin."""
    return [*added(machine), *(PinFriction(point, radius=1e-3, coefficient=0.05) for point in joined(motion, "pin"))]


def joined(motion, *kinds):
    """Return the points that have a joint of some kinds."""
    return dict.fromkeys(each.point for each in pin_forces(motion, []).joints if each.kind in kinds)


@ONE
def test_friction_takes_the_difference_of_work_up_and_down(machine):
    """Work up - work down = what all pins take: the couple each transmits, times the turning of its bodies against each other."""
    motion = moved(machine, 9)
    (name,) = machine.plan.strokes
    found = {way: pin_forces(motion, rubbing(machine, motion), direction=way) for way in ("extending", "retracting")}
    lost = sum(dissipated(motion, name, machine, each) for each in found.values())
    up, down = (each.drives[name] for each in found.values())
    good = np.isfinite(up) & np.isfinite(down)
    assert good.any() and (lost[good] > 0.0).any() == bool(joined(motion, "pin"))
    assert_allclose((up - down)[good], lost[good], atol=1e-9 * np.nanmax(np.abs(up)))


def dissipated(motion, name, machine, found):
    """Return the work [N or Nm] that the pins' couples take on a unit of the stroke."""
    bodies = {body.name: body.points[:2] for body in machine.plan.links} | {bar.P + bar.Q: (bar.P, bar.Q) for bar in machine.plan.cylinders}
    bodies |= {name: each.ends for name, each in machine.plan.of_kind(TwoPoint).items()}

    def spin(body):
        turns = body in bodies and body != "frame"
        return motion.ratio(angle(*bodies[body]), wrt=name) if turns else 0.0

    pins = [each for each in found.joints if each.kind == "pin"]
    return sum((np.abs(each.couple * (spin(each.on) - spin(each.by))) for each in pins), np.zeros(motion.shape))


@ONE
@for_all("direction", ["extending", "retracting"])
def test_virtual_work_is_equilibrium_with_friction_in_pins_and_guides(machine, direction):
    motion = moved(machine, 7)
    loads = [*rubbing(machine, motion), *(GuideFriction(point, 0.05) for point in joined(motion, "guide", "driven", "slider", "slot"))]
    found, work = pin_forces(motion, loads, direction=direction), driving_force(motion, loads, direction=direction)
    (name,) = machine.plan.strokes
    assert np.isfinite(work).any()
    assert_allclose(found.drives[name], work, rtol=1e-9, atol=1e-9 * np.nanmax(np.abs(work)))


@ONE
def test_friction_works_against_the_motion(machine):
    motion = moved(machine, 7)
    loads = rubbing(machine, motion)
    up, free, down = (driving_force(motion, loads, direction=way) for way in ("extending", "frictionless", "retracting"))
    room = 1e-12 * np.nanmax(np.abs(free))
    good = np.isfinite(up) & np.isfinite(down)
    assert good.any()
    assert (up[good] >= free[good] - room).all() and (free[good] >= down[good] - room).all()


# -- mirrored ----------------------------------------------------------------------------------------------


@singledispatch
def mirrored(member):
    """Return a member seen in a mirror at the y axis; others keep."""
    return member


@mirrored.register
def _(member: Ground):
    return Ground(-member.x, member.y)


@mirrored.register(Dyad)
@mirrored.register(OnLink)
def _(member):
    other = copy(member)
    if member.side is not None:
        other.side = LEFT if member.side is RIGHT else RIGHT
    else:
        other.labels = {key: -value if len(key) == 3 else value for key, value in member.labels.items()}
    return other


@mirrored.register
def _(member: Crank):
    other = copy(member)
    other.angle = np.pi - member.angle
    return other


@mirrored.register
def _(member: Guide):
    place = member.P if member.fixed_at is None else (-member.fixed_at[0], member.fixed_at[1])
    return Guide(place, member.Q) if member.angle is None else Guide(place, angle=np.pi - member.angle)


KNOWN = ("mower_lift", "three_point_hitch", "four_bar", "drag_link", "chebyshev", "hart", "peaucellier")


def mirror(machine):
    """Return the machine's class seen in a mirror: points left become right, turning changes its sense."""
    members = {name: mirrored(member) for name, member in declared(machine).items() if not isinstance(member, ForceElement)}
    return type("Mirrored", (machine,), members)


@for_all("machine", lambda: [MACHINES[name] for name in KNOWN])
def test_a_mirrored_machine_has_mirrored_reactions(machine):
    motion, other = moved(machine), moved(mirror(machine))
    point = machine.plan.moving[-1]
    assert_allclose(other[point], motion[point] * [[-1.0], [1.0]], atol=1e-9)
    body = machine.plan.links[1].points[:2]
    here = pin_forces(motion, [Weight(point, 75.0), Force(point, (120.0, 0.0)), Moment(body, M=30.0)])
    there = pin_forces(other, [Weight(point, 75.0), Force(point, (-120.0, 0.0)), Moment(body, M=-30.0)])
    for a, b in zip(here.joints, there.joints, strict=True):
        assert_allclose(b.force, a.force * [[-1.0], [1.0]], atol=1e-8 * (1.0 + np.nanmax(np.abs(a.force))))
        assert_allclose(b.couple, -a.couple, atol=1e-8 * (1.0 + np.nanmax(np.abs(a.couple))))


# -- random loads ------------------------------------------------------------------------------------------

forces = st.floats(-1e4, 1e4)


@given(x=forces, y=forces, moment=forces, stiffness=st.floats(0.0, 1e5), free=st.floats(0.0, 2.0))
@settings(max_examples=25, deadline=None)
def test_any_loads_agree_by_both_methods(x, y, moment, stiffness, free):
    motion = ThreePointHitch().sweep(5)
    loads = [Force("G", (x, y)), Moment("E D", M=moment), Spring("M", "F", stiffness, free)]
    found, work = pin_forces(motion, loads).drives["S"], driving_force(motion, loads)
    assert_allclose(found, work, rtol=1e-9, atol=1e-9 * (1.0 + max(abs(x), abs(y), abs(moment), stiffness)))
