"""Pin forces of a step from outside the package, a pin driven along a curve, from what it says in its joints alone."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Cylinder
from linkage import RIGHT, DefinitionError, Dyad, Force, Ground, Mechanism, Stroke, Weight, driving_force, pin_force, pin_forces
from linkage.quantities import FRAME_SIDE, Driven, Joint, JointSide, quantity
from linkage.steps import Point
from linkage.vectors import Line, Vec
from tests.for_all import for_all


class OnParabola(Point):
    """A pin driven along y = 0.5 + 0.8 x2 [m]; its stroke is x, not the way along the curve."""

    def __init__(self, x, **changes):
        self.x, self.changes = quantity(x), changes

    def parts(self):
        return (self.x,)

    def place(self, where):
        x = where.value(self.x)
        return Vec(x, 0.5 + 0.8 * x * x)

    def tangent(self, where):
        x = where.value(self.x)
        return Line(where.at(self.name), Vec(1.0 + 0.0 * x, 1.6 * x))

    def joints(self):
        said = {"point": self.name, "holds": "nt", "line": self.tangent, "drives": (Driven(self.x, "t"),)}
        return (Joint("curve", on=JointSide((self.name,), "runner"), by=FRAME_SIDE, **(said | self.changes)),)

    def __str__(self):
        return "OnParabola(S)"


class Rocker(Mechanism):
    """A rod from the pin on the curve turns a rocker."""

    S = Stroke(0.1, 0.4)
    X = OnParabola(S)
    O = Ground(0.8, 0.0)
    B = Dyad(X, O, XB=0.5, OB=0.6, side=RIGHT)
    load = Weight(B, mass=100)
    pull = Force(X, (30.0, 10.0))


class Silent(OnParabola):
    """One that says nothing of its joints."""

    def joints(self):
        return ()


BOTH = {"holds": "xy", "line": None, "drives": (Driven(Rocker.plan.strokes["S"], "x"), Driven(Rocker.plan.strokes["S"], "y"))}


@pytest.mark.parametrize("changes", [{}, BOTH], ids=["nt", "xy"])
@pytest.mark.parametrize("poses", [11, 301])
def test_equilibrium_is_virtual_work(changes, poses):
    """By equations and by the program, whatever the way along the curve is to the stroke."""
    machine = type("Other", (Rocker,), {"X": OnParabola(Rocker.plan.members["S"], **changes)})
    motion = machine().sweep(poses)
    found = pin_forces(motion)
    assert_allclose(found.drives["S"], driving_force(motion), rtol=1e-12)
    assert found.gap < 1e-14
    assert_allclose(sum(found.on_body("frame").values()), np.broadcast_to([[30.0], [10.0 - 100 * 9.80665]], (2, poses)), atol=1e-9)


def test_a_request_says_the_same():
    (size,) = Rocker().evaluate([pin_force("B")], S=[0.2, 0.3])
    assert_allclose(size, np.hypot(*pin_forces(Rocker().at(S=[0.2, 0.3])).force("B")), rtol=1e-12)


def test_a_cylinder_holds_in_its_place():
    """The curve still holds across; the cylinder carries what its stroke needs over its lever."""

    class Held(Rocker):
        A = Ground(0.0, 0.2)
        lift = Cylinder(A, "X", bore=0.1, rod=0.05)

    motion = Held().sweep(5)
    found = pin_forces(motion)
    assert [joint.kind for joint in found.at("X")] == ["pin", "guide"]
    assert_allclose(found.thrusts["lift"], Held.plan.members["lift"].thrust(motion), rtol=1e-12)
    with pytest.raises(DefinitionError, match=r"x and y are driven by S, which a cylinder takes over; let one letter follow it"):
        pin_forces(type("Both", (Held,), {"X": OnParabola(Rocker.plan.members["S"], **BOTH)})().sweep(5))


@for_all(
    ("changes", "says"),
    [
        ({"line": None}, "holds 'nt', across .n. or along .t. a line, but says none; give line="),
        ({"holds": "nq"}, "letters of x, y, n, t, c are expected"),
        ({"holds": "n"}, "drives t, which it does not hold"),
        ({"holds": "xy", "drives": ()}, r"know no drive of S.*drives in the joints\(\)"),
        ({"point": "Y"}, "Point 'Y' is unknown"),
    ],
)
def test_what_is_missing_is_said(changes, says):
    machine = type("Other", (Rocker,), {"X": OnParabola(Rocker.plan.members["S"], **changes)})
    with pytest.raises(DefinitionError, match=says):
        pin_forces(machine().sweep(5))


def test_a_step_that_says_nothing_of_its_joints():
    machine = type("Other", (Rocker,), {"X": Silent(Rocker.plan.members["S"])})
    with pytest.raises(DefinitionError, match=r"XB and OB are held by nothing.*joints\(\) of a step of one's own"):
        pin_forces(machine().sweep(5))
