"""The plan: ordered, printable, and the dimensions it keeps."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Cylinder, LiftCircuit
from linkage import (
    LEFT,
    RIGHT,
    Crank,
    Curve,
    DefinitionError,
    Dimension,
    Dyad,
    Ground,
    Guide,
    Link,
    Mechanism,
    OnGuide,
    OnLink,
    Outline,
    Stroke,
    Weight,
    angle,
    deg,
    distance,
    pin_force,
    ratio,
    ref,
    x,
    y,
)
from linkage.plan import Trace
from linkage.program.schedule import schedule
from linkage.quantities import Quantity
from mechanisms.three_point_hitch import ThreePointHitch
from tests.for_all import first_daily, for_all
from tests.linkage.random_mechanisms import random_mechanism

WORDS = dict(
    LEFT=LEFT,
    RIGHT=RIGHT,
    Crank=Crank,
    Dimension=Dimension,
    Dyad=Dyad,
    Ground=Ground,
    Guide=Guide,
    Link=Link,
    OnGuide=OnGuide,
    OnLink=OnLink,
    Outline=Outline,
    Stroke=Stroke,
    angle=angle,
    distance=distance,
    x=x,
    y=y,
    deg=deg,
    Weight=Weight,
    Cylinder=Cylinder,
    LiftCircuit=LiftCircuit,
)


@first_daily(2, "machine", [ThreePointHitch, *(random_mechanism(seed) for seed in (1, 3, 5))], ids=lambda machine: machine.__name__
)
def test_a_printed_plan_can_be_pasted_back(machine):
    members = {}
    for line in str(machine.plan).splitlines():
        name, _, text = line.partition(" = ")
        known = {each: ref(each) if isinstance(member, Quantity) else each for each, member in machine.plan.members.items()}
        members[name] = eval(text, WORDS, known)
    again = type("Again", (Mechanism,), members)
    strokes = {name: (each.start + each.end) / 2 for name, each in machine.plan.strokes.items()}
    for name in machine.plan.points:
        assert_allclose(again().at(**strokes)[name], machine().at(**strokes)[name], rtol=1e-12)


def test_what_a_thing_is_built_from():
    assert ThreePointHitch.plan.reaches("B") == {"B", "A", "O", "S", "L0"}
    assert ThreePointHitch.plan.reaches("E") == {"E"}


def test_what_has_no_value_is_refused():
    class Rail(Mechanism):
        """A point on a rail."""

        S, rail = Stroke(0.0, 1.0), Guide((0.0, 0.0), angle=0.3)
        P = OnGuide(rail, at=S)

    motion = Rail().sweep(3)
    for ask in (
        lambda: motion["rail"],
        lambda: motion.ratio("rail"),
        lambda: motion.ratio("rail", method="central"),
        lambda: Rail.plan.nodes("rail"),
        lambda: Rail.plan.nodes("Q"),
    ):
        with pytest.raises(DefinitionError):
            ask()


def test_program_is_traced_once_and_kernels_are_kept():
    plan = ThreePointHitch.plan
    assert plan.trace is plan.trace
    assert plan.kernel(("G",), ("S",)) is plan.kernel(("G",), ("S",))


def test_points_are_placed_once_a_class_whatever_is_asked(monkeypatch):
    class Own(ThreePointHitch):
        """The hitch, of which nothing has been asked."""

    Own.plan.nodes("G")
    placed, place = [], Dyad.place
    monkeypatch.setattr(Dyad, "place", lambda step, where: placed.append(type(where)) or place(step, where))
    hitch, sizes = Own(), len(Own.plan._placed.graph.nodes)
    hitch.evaluate(["K", ratio("G"), pin_force("O")], S=[0.05, 0.1])
    hitch.sweep(5).gradient("G", wrt=["OB"])
    hitch.source([ratio("tilt")])
    assert Trace not in placed
    assert len(Own.plan._placed.graph.nodes) == sizes


@for_all("seed", range(1, 40, 12), slow=[*range(5, 40, 12), *range(9, 40, 12)])
def test_a_fork_goes_on_as_what_it_was_forked_from(seed):
    plan = random_mechanism(seed).plan
    placed, names = plan._placed, [*plan.moving]
    fork, again = placed.fork(), placed.fork().fork()
    for trace in (fork, again):
        assert [repr(node) for node in trace.graph.nodes] == [repr(node) for node in placed.graph.nodes]
        assert all(node.graph is trace.graph for node in trace.graph.nodes)
        assert all(arg is trace.graph.nodes[arg.number] for node in trace.graph.nodes for arg in node.args)
    places = [(trace, trace.graph.node(trace.at(names[-1]).x)) for trace in (fork, again)]
    tangents = [[trace.tangent(stroke).derivative(place) for stroke in plan.strokes] for trace, place in places]
    assert repr(tangents[0]) == repr(tangents[1])
    assert [repr(node) for node in fork.graph.nodes] == [repr(node) for node in again.graph.nodes]
    watched = [[*map(repr, trace.watched(plan.members))] for trace in (fork, again)]
    assert watched[0] == watched[1] and len(fork.graph.nodes) > len(placed.graph.nodes)


def test_what_is_built_of_the_same_parts_is_the_same():
    made = [(x("G"), distance("A", "G") - 2 * ref("tilt"), np.minimum(y("G"), 0.5) / 3, -angle("F", "K") + 90 * deg) for _ in range(2)]
    assert [each.identity for each in made[0]] == [each.identity for each in made[1]]
    others = (y("G"), distance("A", "G") - 3 * ref("tilt"), np.maximum(y("G"), 0.5) / 3, angle("F", "K") + 90 * deg)
    assert not {each.identity for each in made[0]} & {each.identity for each in others}
    assert x("G").identity != x("K").identity and (x("G") / 2).identity != (x("G") * 2).identity
    curve = Curve([0.0, 1.0, 2.0], [0.0, 1.0, 4.0])
    whole = x("G") + curve(x("G"))
    assert whole.identity is whole


def test_trigonometry_is_not_needed_where_a_root_will_do():
    nodes = [*ThreePointHitch.plan.nodes("G"), *ThreePointHitch.plan.derived(ThreePointHitch.plan.nodes("G"), ("S",))]
    assert {node.op for node in schedule(nodes).pose}.isdisjoint({"sin", "cos", "tan", "arctan2"})
    assert len(schedule(nodes).pose) < 220
