"""The plan: ordered, printable, and the dimensions it keeps."""

import pytest
from numpy.testing import assert_allclose

from hydraulics import Cylinder, LiftCircuit
from linkage import (
    LEFT,
    RIGHT,
    Crank,
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
    ref,
    x,
    y,
)
from linkage.program.schedule import schedule
from linkage.quantities import Quantity
from mechanisms.three_point_hitch import ThreePointHitch
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


@pytest.mark.parametrize(
    "machine", [ThreePointHitch, *(random_mechanism(seed) for seed in (1, 3, 5))], ids=lambda machine: machine.__name__
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


def test_trigonometry_is_not_needed_where_a_root_will_do():
    nodes = [*ThreePointHitch.plan.nodes("G"), *ThreePointHitch.plan.derived(ThreePointHitch.plan.nodes("G"), ("S",))]
    assert {node.op for node in schedule(nodes).pose}.isdisjoint({"sin", "cos", "tan", "arctan2"})
    assert len(schedule(nodes).pose) < 220
