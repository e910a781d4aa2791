"""Laws of parts: a machine in a machine moves and carries as it does alone, and as the same typed flat does."""

import pickle
import warnings
from functools import cache

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Cylinder, LiftCircuit
from linkage import RIGHT, Crank, Dyad, Ground, Mechanism, Outline, Over, Part, SingularWarning, Stroke, Weight, deg, pin_forces
from linkage.files import load, to_toml
from linkage.loads import ForceElement, LoadCase
from linkage.quantities import Dimension, Quantity
from tests.for_all import for_all
from tests.laws.test_laws import few_random, other_random
from tests.machines.test_tipper import Tipper
from tests.shipped import over_machines

SOME = {"more": lambda: [*few_random(), Tipper], "later": other_random}
ALL = over_machines(**SOME)
TURN, AT = 35 * deg, (1.5, -0.7)


@cache
def whole(machine, **how):
    """Return a class that has a machine as its one part."""
    name = f"Whole{len(globals())}"
    globals()[name] = made = type(name, (Mechanism,), {"p": Part(machine, **how), "__module__": __name__})
    return made


def moved(machine, prefix=""):
    """Return strokes inside their ranges, by their names in the whole."""
    shares = np.linspace(0.15, 0.8, 4)
    return {f"{prefix}{name}": stroke.start + shares * (stroke.end - stroke.start) for name, stroke in machine.plan.strokes.items()}


def motions(machine, **how):
    """Return the motions of a machine alone and in a whole, at the same strokes, NaN where it cannot be assembled."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SingularWarning)
        alone = machine().at(unreachable="nan", **moved(machine))
        held = whole(machine, **how)().at(unreachable="nan", **moved(machine, "p."))
    return alone, held


def outputs(machine):
    """Return the named outputs of a machine."""
    found = machine.plan.of_kind(Quantity)
    return [name for name, each in found.items() if name not in machine.plan.strokes and not isinstance(each, Dimension)]


def in_the_whole(place, mirrored=False, angle=0.0, at=(0.0, 0.0)):
    """Return where a place of a part is in the whole."""
    x, y = (-place[0] if mirrored else place[0]), place[1]
    return np.array([at[0] + x * np.cos(angle) - y * np.sin(angle), at[1] + x * np.sin(angle) + y * np.cos(angle)])


@ALL
def test_a_part_moves_as_the_machine_alone_does(machine):
    alone, held = motions(machine)
    for name in machine.plan.points:
        np.testing.assert_array_equal(held[f"p.{name}"], alone[name])
    for name in outputs(machine):
        np.testing.assert_array_equal(held[f"p.{name}"], alone[name])
    stroke = next(iter(machine.plan.strokes))
    for name in list(machine.plan.moving)[:3]:
        np.testing.assert_array_equal(held.ratio(f"p.{name}", wrt=f"p.{stroke}"), alone.ratio(name, wrt=stroke))


@ALL
@for_all("how", [dict(mirrored=True, angle=TURN, at=AT)], ids=str, slow=[dict(angle=TURN, at=AT)])
def test_a_part_that_is_mirrored_or_turned_stands_there(machine, how):
    alone, held = motions(machine, **how)
    size = max(float(np.nanmax(np.abs(alone[name]))) for name in machine.plan.points)
    for name in machine.plan.points:
        assert_allclose(held[f"p.{name}"], in_the_whole(alone[name], **how), atol=1e-11 * max(size, 1.0), rtol=1e-11)
    for name in outputs(machine):
        scale = float(np.nanmax(np.abs(alone[name]), initial=1.0))
        difference = held[f"p.{name}"] - alone[name]
        if getattr(machine.plan.members[name], "measures", "") == "angle":
            difference = np.remainder(difference + np.pi, 2 * np.pi) - np.pi
        assert np.nanmax(np.abs(difference), initial=0.0) <= 1e-10 * scale


@pytest.mark.slow
@ALL
def test_mirrored_twice_is_not_mirrored(machine):
    once = whole(machine, mirrored=True)
    twice = type("Twice", (Mechanism,), {"q": Part(once, mirrored=True)})
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SingularWarning)
        alone = machine().at(unreachable="nan", **moved(machine))
        held = twice().at(unreachable="nan", **moved(machine, "q.p."))
    for name in machine.plan.points:
        assert_allclose(held[f"q.p.{name}"], alone[name], rtol=1e-14, atol=1e-14)


@ALL
@for_all("how", [dict(mirrored=True, at=(0.3, -0.2), angle=-40 * deg)], ids=str, slow=[dict()])
def test_a_part_on_a_moving_body_goes_with_it(machine, how):
    base = {"t": Stroke(-1, 1), "o": Ground(0.4, 0.1), "q": Crank("o", oq=0.7, angle="t")}
    outlines = machine.plan.of_kind(Outline).items()
    hanging = {name: None for name, each in outlines if len(each.carriers) == 1 and not hasattr(each, "radius")}  # keeps directions
    carrying = type("Carrying", (Mechanism,), {**base, "p": Part(machine, on=("o", "q"), **how, **hanging)})
    turn = np.linspace(-0.5, 0.6, 4)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SingularWarning)
        alone = machine().at(unreachable="nan", **moved(machine))
        held = carrying().at(unreachable="nan", t=turn, **moved(machine, "p."))
    size = max(1.0, *(float(np.nanmax(np.abs(alone[name]))) for name in machine.plan.points))
    for name in machine.plan.points:
        x, y = in_the_whole(alone[name], **how)
        expected = np.array([0.4 + x * np.cos(turn) - y * np.sin(turn), 0.1 + x * np.sin(turn) + y * np.cos(turn)])
        assert_allclose(held[f"p.{name}"], expected, atol=1e-10 * size, rtol=0.0)
    for name in outputs(machine):
        difference = held[f"p.{name}"] - alone[name]
        if getattr(machine.plan.members[name], "measures", "") == "angle":
            difference = np.remainder(difference + np.pi, 2 * np.pi) - np.pi
        assert np.nanmax(np.abs(difference), initial=0.0) <= 1e-9 * float(np.nanmax(np.abs(alone[name]), initial=1.0))


LOADED = over_machines(**SOME, among=lambda machine: machine.plan.of_kind(ForceElement))


@LOADED
def test_pin_forces_of_a_part_are_those_of_the_machine_alone(machine):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        alone, held = motions(machine)
        try:
            own = pin_forces(alone)
        except Exception as error:
            with pytest.raises(type(error)):
                pin_forces(held)
            return
        found = pin_forces(held)
    assert len(found.joints) == len(own.joints)
    scale = max(float(np.nanmax(np.abs(joint.force), initial=0.0)) for joint in own.joints) or 1.0
    for joint, other in zip(sorted(found.joints, key=place_of), sorted(own.joints, key=place_of), strict=True):
        assert np.nanmax(np.abs(np.abs(joint.force) - np.abs(other.force)), initial=0.0) <= 1e-9 * scale


@LOADED
def test_a_mirrored_part_has_mirrored_forces(machine):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        alone, held = motions(machine, mirrored=True)
        try:
            own = pin_forces(alone)
        except Exception as error:
            with pytest.raises(type(error)):
                pin_forces(held)
            return
        found = {place_of(joint): joint.force for joint in pin_forces(held).joints}
    scale = max(float(np.nanmax(np.abs(joint.force), initial=0.0)) for joint in own.joints) or 1.0
    assert len(found) == len(own.joints)
    for joint in own.joints:
        expected = joint.force * np.array([-1.0, 1.0]).reshape(2, *[1] * (joint.force.ndim - 1))
        assert np.nanmax(np.abs(found[place_of(joint)] - expected), initial=0.0) <= 1e-11 * scale


def place_of(joint):
    """Return what tells a joint, whatever the machine calls its points."""
    return tuple(text.replace("p.", "") for text in (joint.point, joint.kind, str(joint)))


@ALL
def test_a_machine_of_parts_is_saved_and_pickled(machine):
    design = whole(machine, mirrored=True, angle=TURN, at=AT)()
    again = pickle.loads(pickle.dumps(design))
    strokes = {name: float(value[1]) for name, value in moved(machine, "p.").items()}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SingularWarning)
        expected = design.at(unreachable="nan", **strokes)
        found = again.at(unreachable="nan", **strokes)
        try:
            read = load(to_toml(design))().at(unreachable="nan", **strokes)
        except Exception as error:
            with pytest.raises(type(error)):
                to_toml(machine())
            read = found
    for name in machine.plan.points:
        np.testing.assert_array_equal(found[f"p.{name}"], expected[f"p.{name}"])
        np.testing.assert_array_equal(read[f"p.{name}"], expected[f"p.{name}"])


@ALL
def test_cases_and_overs_stay_with_their_class(machine):
    members = whole(machine).plan.members.values()
    assert not any(isinstance(member, (Over, LoadCase)) for member in members)


@for_all("lines", [{"bore": "D"}, {"pressure": "p"}, {"bore": "D", "pressure": "p", "mechanical_efficiency": "n"}])
def test_sizes_of_a_part_may_follow_its_own_dimensions(lines):
    class Arm(Mechanism):
        S = Stroke(0.0, 0.25)
        A, O, D, p, n = Ground(0.2, 0.55), Ground(0.3, 1.15), Dimension(0.08), Dimension(20e6), Dimension(0.95)
        B = Dyad(A, O, AB=0.5 + S, OB=0.3, side=RIGHT)
        load = Weight(B, mass=600)
        ram = Cylinder(A, B, bore=lines.get("bore", 0.08), rod=0.045, stroke=0.26, closed=0.49)
        pump = LiftCircuit(ram, pressure=lines.get("pressure", 20e6), mechanical_efficiency=lines.get("mechanical_efficiency", 0.9))

    whole = type("Whole", (Mechanism,), {"arm": Part(Arm)})()
    flat = [str(each) for each in Arm().verdicts()]
    assert [str(each).replace("arm.", "") for each in whole.verdicts()] == flat and len(flat) > 8
