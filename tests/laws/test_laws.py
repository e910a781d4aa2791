"""Laws of the geometry, over every shipped machine and some random ones."""

import warnings
from functools import cache
from itertools import combinations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import LEFT, RIGHT, Dyad, Ground, Mechanism, OnLink, Rope, SingularWarning
from linkage.motion import stroke_unit
from linkage.quantities import Dimension, Quantity, Stroke
from linkage.units import UNITS
from tests.for_all import for_all
from tests.linkage.random_mechanisms import random_mechanism
from tests.shipped import DAILY, MACHINES, over_machines


@cache
def random_machines():
    """Return machines that were drawn by seeds, of one stroke and of two."""
    return [random_mechanism(seed) for seed in range(6)] + [random_mechanism(seed, strokes=2) for seed in (10, 11, 12)]


def few_random():
    """Return the random machines of every day: one of one stroke, one of two."""
    return random_machines()[::8]


def other_random():
    return [machine for place, machine in enumerate(random_machines()) if place % 8]


SOME = {"more": few_random, "later": other_random}
ALL = over_machines(**SOME)


@cache
def whole(machine):
    """Return the motion over all strokes of a machine."""
    strokes = machine.plan.strokes
    return machine().sweep(**dict.fromkeys(strokes, 31 if len(strokes) == 1 else 7))


def outputs(machine):
    """Return the names of what a machine gives: its moving points and its named outputs."""
    found = machine.plan.of_kind(Quantity)
    return [
        *machine.plan.moving,
        *(name for name, each in found.items() if name not in machine.plan.strokes and not isinstance(each, Dimension)),
    ]


def inner(machine, part=0.9, count=13):
    """Return stroke values inside the ends, so that both neighbours of every pose can be reached."""
    middle = {name: ((each.start + each.end) / 2, part * (each.end - each.start) / 2) for name, each in machine.plan.strokes.items()}
    return {name: mean + half * np.linspace(-1.0, 1.0, count) for name, (mean, half) in middle.items()}


def test_machines_are_found_through_their_entry_points():
    assert {"MowerLift", "ThreePointHitch"} <= {machine.__name__ for machine in MACHINES.values()}


def test_every_kind_of_member_is_looked_at_daily():
    """But for ropes: the chain crane is among the machines of the laws of statics."""
    kinds = {name: {*map(type, machine.plan.members.values())} for name, machine in MACHINES.items()}
    assert set().union(*(kinds[name] for name in DAILY)) == set().union(*kinds.values()) - {Rope}


@ALL
def test_links_keep_their_length(machine):
    motion = whole(machine)
    for body in machine().links:
        for P, Q in combinations(body.points, 2):
            length = motion.distance(P, Q)
            assert np.ptp(length) <= 1e-12 * max(1.0, length.max()), f"{P}{Q}"


@ALL
def test_the_graph_counts_the_freedoms(machine):
    """The graph by itself, against 3 (n - 1) - 2 j1 - j2 of bodies, pins and pins on lines; rank tells what is special about a shape.

    A rope of a length takes one freedom more. Three headers go by one height.
    """
    design, graph = machine(), machine().graph
    n, j = graph.number_of_nodes(), graph.number_of_edges()
    ropes = sum(rope.length is not None for rope in machine.plan.of_kind(Rope).values())
    assert 3 * (n - 1) - 2 * j - ropes == design.gruebler
    lugs = [name for name in machine.plan.telescopes for body in machine.plan.links if name in body.points]
    assert lugs or design.gruebler == counted(machine.plan)
    assert design.gruebler == (3 if machine.__name__ in ("RobertsCognates", "ThreeHeaders") else design.mobility)
    nodes = graph.nodes(data=True)
    bodies = {name for name, data in nodes if data["kind"] in ("frame", "body") or (data["kind"] == "arm" and data["link"])}
    assert bodies == {body.name for body in design.links}
    for point in machine.plan.points:
        there = [name for name, data in graph.nodes(data=True) if point in data["points"]]
        pins = [key for _, _, key, data in graph.edges(keys=True, data=True) if key == point and data["kind"] == "pin"]
        assert len(pins) == max(len(there) - 1, 0), point
    assert {stroke for *_, strokes in graph.edges(data="strokes") for stroke in strokes} == set(machine.plan.strokes)


def counted(plan):
    """Return the Gruebler count by pins and by pins on lines, which take one freedom each; of machines whose arms have no lugs."""
    fixed_on = [name for name, point in plan.points.items() if any(not plan.is_there(joint) and joint.track for joint in point.joints())]
    halves = {name: sum(joint.is_half for joint in step.joints()) for name, step in plan.points.items() if name not in fixed_on}
    slides = sum(halves.values()) + sum(len(group.slides) for group in plan.groups.values())
    ends = [end for bar in plan.cylinders for end in (bar.P, bar.Q)]
    owners = [point for body in plan.links for point in body.points] + ends
    lone = [name for name in halves if name not in owners and (halves[name] or name in plan.telescopes)]
    pins = len(owners) - len(set(owners)) + len(plan.cylinders)
    bodies = len(plan.links) + 2 * len(plan.cylinders)
    return 3 * (bodies - 1) - 2 * pins - slides - len(plan.telescopes) + 2 * len(lone)


@ALL
def test_cylinders_are_as_long_as_they_say(machine):
    motion = whole(machine)
    for bar in machine.plan.cylinders:
        assert_allclose(motion.distance(bar.P, bar.Q), motion.value(bar.length), rtol=1e-12)


@ALL
@pytest.mark.filterwarnings("ignore:The numerical ratio")  # of what grows evenly, the second one is rounding
@for_all("order", [1], slow=[2])
def test_exact_ratio_is_the_numerical_one(machine, order):
    motion = whole(machine)
    for name in outputs(machine):
        for stroke in motion.strokes:
            exact, numerical = (motion.ratio(name, wrt=stroke, order=order, method=method) for method in ("exact", "central"))
            rounding = (1e-4 if order == 1 else 1e-2) * np.abs(motion[name]).max()  # of a value of 100 kN, or of 13 m
            size = max(1e-2 if order == 1 else 1e-1, np.abs(exact).max(), rounding)
            assert_allclose(numerical, exact, rtol=0, atol=(1e-8 if order == 1 else 3e-6) * size, err_msg=name)


@ALL
def test_error_of_the_plain_difference_falls_with_its_order(machine):
    motion = machine().at(**inner(machine, part=0.8))
    for stroke, declared in machine.plan.strokes.items():
        step = 0.01 * abs(declared.end - declared.start)
        sizes = []
        for each in (step, step / 2):
            with warnings.catch_warnings():
                warnings.filterwarnings("ignore", "The numerical ratio", SingularWarning)  # so coarse a step tells what it loses
                wrong = [
                    motion.ratio(name, wrt=stroke, method="central", step=each) - motion.ratio(name, wrt=stroke)
                    for name in machine.plan.moving
                ]
            sizes.append(np.sqrt(sum(np.sum(part**2, axis=0) for part in wrong)))
        clear = sizes[1] > 1e-9  # above rounding
        assert not clear.any() or 3.9 < np.median(sizes[0][clear] / sizes[1][clear]) < 4.1, stroke


NO_LENGTHS = {"k", "m", "delta", "f_1", "opening", "dead_bores"}  # numbers that are ratios and angles


def is_long(plan, name):
    """Return whether a design variable is a length or a coordinate, going by what it is made for."""
    entry = plan.table.entries[name]
    if entry.kind == "number" and entry.unit:
        return UNITS[entry.unit][1] == "length"
    if entry.kind == "number":
        return name not in NO_LENGTHS and any(name in plan.reaches(each) for each in plan.moving) and name not in plan.turning
    return entry.kind in ("length", "coordinate")


def has_its_lengths(machine):
    """Return whether all lengths of a machine are design variables: three headers stand at the heights of their report."""
    return machine.__name__ != "ThreeHeaders"


@over_machines(**SOME, among=has_its_lengths)
def test_scaling_all_lengths_scales_positions(machine):
    plan, factor = machine.plan, 2.5
    design = machine()
    larger = machine(**{name: factor * value for name, value in design.dimensions.items() if is_long(plan, name)})
    fractions = inner(machine, part=1.0)
    lengths = [name for name in plan.strokes if stroke_unit(plan, name) == "m"]
    scaled = {name: value * (factor if name in lengths else 1.0) for name, value in fractions.items()}
    small, large = design.at(**fractions), larger.at(**scaled)
    for name in plan.points:
        assert_allclose(large[name], factor * small[name], rtol=1e-12, atol=1e-12)


def mirrored(machine):
    """Return a machine mirrored in the x axis: LEFT and RIGHT swapped, angles the other way round."""
    members = {}
    for name, member in machine.plan.members.items():
        labels = getattr(member, "labels", {})
        side = {LEFT: RIGHT, RIGHT: LEFT}.get(getattr(member, "side", None))
        if isinstance(member, Ground):
            members[name] = Ground(member.x, -member.y)
        elif isinstance(member, Dyad):
            members[name] = Dyad(member.P, member.Q, side=side, **labels)
        elif isinstance(member, OnLink):
            kinds = {spelling: slot.kind for slot in member.slots() for spelling in slot.spellings}
            turned = {label: -value if kinds[label] == "angle" and side is None else value for label, value in labels.items()}
            members[name] = OnLink(member.P, member.Q, side=side, **turned)
        elif name in machine.plan.strokes or isinstance(member, Dimension):
            members[name] = member
    return type("Mirrored", (Mechanism,), members)


def is_plain(machine):
    """Return whether a machine is made of fixed points, dyads and links only, and of numbers and strokes that they name."""
    plan = machine.plan
    behind = [plan.members[name] for name in plan.reaches(*plan.points) if name in plan.members]
    return all(isinstance(each, (Ground, Dyad, OnLink, Stroke, Dimension)) for each in behind)


@over_machines(**SOME, among=is_plain)
def test_mirroring_swaps_left_and_right(machine):
    motion, image = whole(machine), whole(mirrored(machine))
    for name in machine.plan.points:
        assert_allclose(image.x(name), motion.x(name), atol=1e-12)
        assert_allclose(image.y(name), -motion.y(name), atol=1e-12)
    assert np.abs(motion[machine.plan.moving[0]][1]).max() > 1e-3, "the mirror would not be seen"


@ALL
def test_a_pose_does_not_depend_on_the_others(machine):
    motion = whole(machine)
    alone = machine().at(**{name: value.ravel()[5] for name, value in motion.strokes.items()})
    for name in machine.plan.moving:
        assert_allclose(alone[name], motion[name].reshape(2, -1)[:, 5], rtol=1e-12, atol=1e-12)
        for stroke in motion.strokes:
            together = motion.ratio(name, wrt=stroke).reshape(2, -1)[:, 5]
            assert_allclose(alone.ratio(name, wrt=stroke), together, rtol=1e-11, atol=1e-11)


@over_machines()
def test_units_of_the_table_are_known(machine):
    for column in machine().columns(whole(machine)):
        assert column.unit in ("", *UNITS)
