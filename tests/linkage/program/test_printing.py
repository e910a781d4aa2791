"""Printed plans: angles in degrees, dimensions as they are set, and all of it exact when it is pasted back."""

from importlib.metadata import entry_points
from math import pi

import numpy as np
from hypothesis import example, given
from hypothesis import strategies as st

import linkage
from hydraulics import Cylinder, LiftCircuit
from linkage import (
    LEFT,
    RIGHT,
    Crank,
    Dimension,
    Dyad,
    Force,
    Ground,
    Guide,
    Link,
    Mechanism,
    OnLink,
    Pin,
    SliderDyad,
    Stroke,
    Weight,
    YokeDyad,
    angle,
    deg,
    drawn,
)
from linkage.plan import printed
from linkage.quantities import in_degrees
from tests.for_all import for_all

FUNCTIONS = {name: getattr(np, name) for name in ("sqrt", "cos", "sin", "tan", "arctan2")}
NAMES = {name: getattr(linkage, name) for name in linkage.__all__} | {"Cylinder": Cylinder, "LiftCircuit": LiftCircuit} | FUNCTIONS
MACHINES = {each.name: each.load() for each in entry_points(group="hydrolinkage.machines") if ".classics." in each.value}


def pasted(lines):
    """Return the class that printed lines make when they are pasted back."""
    names = dict(NAMES)
    exec("class Pasted(Mechanism):\n" + "\n".join(f"    {name} = {text}" for name, text in lines.items()), names)
    return names["Pasted"]


class Kinds(Mechanism):
    """An angle in every place that takes one."""

    phi = Stroke(0, 2 * pi)
    lag = Dimension(15 * deg)
    tilt = Dimension(5 * deg, unit="deg")
    L0 = Dimension(0.5)
    S = Stroke(0.0, 0.1)
    turn = Stroke(0.0, 20 * deg)
    psi = phi - lag - 30 * deg
    O = Ground(0, 0)
    rail = Guide((0.0, -0.5), angle=12 * deg)
    post = Guide((0.0, -0.9), angle=0)
    A = Crank(O, OA=0.1, angle=psi)
    C = SliderDyad(A, rail, AC=L0 + S, side=RIGHT)
    X = YokeDyad(A, post, angle=80 * deg)
    G = OnLink(A, C, AG=0.2, CAG=turn)
    load = Weight(G, mass=20)
    pull = Force(G, (1.0, 2.0))
    ram = Cylinder(A, C, bore=0.1, rod=0.06)
    out = angle(A, C) - 90 * deg


@given(st.floats(-10.0, 10.0))
@example(75 * deg)
@example(0.0)
def test_an_angle_in_degrees_is_the_same_to_the_last_digit(value):
    assert eval(in_degrees(value), {"deg": deg}) == value


@for_all("value", [75, -30, 22.5, 110.425, 360, 1, 179.99])
def test_an_angle_given_in_degrees_is_written_as_it_was(value):
    assert in_degrees(value * deg) == f"{value} * deg"


@for_all("value", [0.5, 1, 0.0, float("nan"), float("inf")])
def test_an_angle_given_in_radians_stays_what_it_was(value):
    assert in_degrees(value) == repr(value)


def test_every_angle_is_in_degrees_and_nothing_else_is():
    assert {name: text for name, text in printed(Kinds.plan).items() if "deg" in text} == {
        "phi": "Stroke(0, 360 * deg)",
        "lag": "Dimension(15 * deg)",
        "tilt": 'Dimension(5 * deg, unit="deg")',
        "turn": "Stroke(0.0, 20 * deg)",
        "psi": "phi - lag - 30 * deg",
        "rail": "Guide((0.0, -0.5), angle=12 * deg)",
        "X": "YokeDyad(A, post, angle=80 * deg)",
        "out": "angle(A, C) - 90 * deg",
    }


def test_parts_and_their_drawing_are_in_degrees():
    class Drawn(Mechanism):
        phi = Stroke(60 * deg, 120 * deg)
        sketch = drawn(phi=90 * deg)
        O, C = Ground(0.0, 0.0), Ground(0.40, 0.0)
        A = Crank(O, OA=0.10, angle=phi)
        B, D = Pin(at=(0.40, 0.25)), Pin(near=(0.30, 0.30))
        coupler = Link("A B D", AD=0.2, BAD=35 * deg)
        rocker = Link("C B")

    lines = printed(Drawn.plan)
    assert (lines["phi"], lines["sketch"]) == ("Stroke(60 * deg, 120 * deg)", "drawn(phi=90 * deg)")
    assert lines["D"] == "OnLink(A, B, AD=0.2, BAD=35 * deg)"
    assert lines["coupler"] == 'Link("A B D", AD=0.2, BAD=35 * deg)'


@for_all("name", [*MACHINES, "Kinds"])
def test_a_printed_plan_is_exact_when_it_is_pasted_back(name):
    machine = MACHINES.get(name, Kinds)
    again = pasted(printed(machine.plan))
    assert again.plan.defaults == machine.plan.defaults
    assert again.plan.sketch_strokes == machine.plan.sketch_strokes
    assert {key: (each.start, each.end) for key, each in again.plan.strokes.items()} == {
        key: (each.start, each.end) for key, each in machine.plan.strokes.items()
    }
    assert str(again.plan) == str(machine.plan)


def test_a_design_is_printed_with_its_own_dimensions():
    values = {name: value * 1.01 + 0.001 for name, value in Kinds.plan.defaults.items()}
    again = pasted(printed(Kinds.plan, values))
    assert again.plan.defaults == values
    assert str(Kinds.plan) == "\n".join(f"{name} = {text}" for name, text in printed(Kinds.plan).items())


def test_a_dimension_is_printed_anew_wherever_it_stands():
    class Repeated(Mechanism):
        S = Stroke(0.0, 0.1)
        A, O = Ground(0.0, 0.0), Ground(0.4, 0.0)
        B = Dyad(A, O, AB=0.4 + S, OB=0.3, side=LEFT)
        C = OnLink(O, B, OC=0.2, BOC=20 * deg)
        arm = Link("B O C", BO=0.3, COB=-20 * deg)

    lines = printed(Repeated.plan, {"OB": 0.35, "BOC": 25 * deg})
    assert "OB=0.35" in lines["B"] and "BOC=25 * deg" in lines["C"]
    assert lines["arm"] == 'Link("B O C", BO=0.35, COB=-25 * deg)'
    assert lines["A"] == "Ground(0.0, 0.0)"
