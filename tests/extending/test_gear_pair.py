"""A gear pair whose tooth force acts along its line of action: a step from outside, in every reading."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import (
    Crank,
    DefinitionError,
    Dimension,
    Force,
    Ground,
    Mechanism,
    Stroke,
    Weight,
    deg,
    drive_force,
    equations,
    pin_force,
    pin_forces,
)
from linkage.quantities import Joint, JointSide, label, name_of, quantity, source_text
from linkage.steps import Bar, Point
from linkage.vectors import Line, Vec
from tests.extending.readings import OF_NUMBERS, Case


class GearPair(Point):
    """A point on the second of two gears: `B = GearPair(O, A, M, angle=phi, first=r1, second=r2, reach=0.16)`.

    The first turns about O with the body OA by `angle` [rad], the second about M; `first` and `second` are their pitch radii [m], `reach`
    is how far the point stands from M [m]. The teeth push along the line of action, which is tilted by `pressure` [rad] from the
    common tangent. Source: Dubbel, "Taschenbuch fuer den Maschinenbau", G8.
    """

    expects = (("O", "point"), ("A", "point"), ("M", "point"), ("angle", "quantity"), ("first", "quantity"), ("second", "quantity"))

    def __init__(self, O, A, M, *, angle, first, second, reach, pressure: float = 20 * deg):
        self.O, self.A, self.M = O, A, M
        self.angle, self.first, self.second, self.reach = map(quantity, (angle, first, second, reach))
        self.pressure = pressure

    def parts(self):
        return self.O, self.A, self.M, self.angle, self.first, self.second, self.reach

    def lengths(self):
        return self.first, self.second, self.reach

    def in_radians(self):
        return (self.angle,)

    def place(self, where):
        turn = where.value(self.angle) * (-1.0 * where.value(self.first) / where.value(self.second))
        return where.at(self.M) + Vec(np.cos(turn), np.sin(turn)) * where.value(self.reach)

    def bars(self):
        return (Bar(name_of(self.M), self.name, self.reach),)

    def action(self, where):
        """Return the line from the pitch point across the line of action: the teeth push to its left or its right."""
        along = where.at(self.M) - where.at(self.O)
        u = along * (1.0 / along.length())
        return Line(where.at(self.O) + u * where.value(self.first), u.turned(np.cos(self.pressure), np.sin(self.pressure)))

    def joints(self):
        second, first = JointSide((name_of(self.M), self.name)), JointSide((name_of(self.O), name_of(self.A)))
        return (Joint("mesh", self.name, second, first, "n", self.action),)

    def __str__(self):
        given = ", ".join(f"{name}={source_text(getattr(self, name))}" for name in ("angle", "first", "second", "reach"))
        return f"GearPair({label(self.O)}, {label(self.A)}, {label(self.M)}, {given}, pressure={self.pressure!r})"


class Winch(Mechanism):
    """A crank turns a larger gear, on whose arm a load hangs."""

    phi = Stroke(0.2, 2.9)
    r1, r2 = Dimension(0.1), Dimension(0.2)
    O, M = Ground(0.0, 0.0), Ground(0.3, 0.0)
    A = Crank(O, OA=0.08, angle=phi)
    B = GearPair(O, A, M, angle=phi, first=r1, second=r2, reach=0.16)
    load = Weight(B, mass=40)
    side = Force(B, (120.0, 0.0))


PHI = np.linspace(0.2, 2.9, 7)
MOTION = Winch().at(phi=PHI)


def test_places_and_forces_by_hand():
    turn = -0.5 * PHI
    B = np.array([0.3 + 0.16 * np.cos(turn), 0.16 * np.sin(turn)])
    assert_allclose(MOTION["B"], B, atol=1e-15)
    weight = 40 * 9.80665
    moment = -(B[0] - 0.3) * weight - B[1] * 120.0  # of the loads about M
    tooth = moment / (0.2 * np.cos(20 * deg))  # along the line of action, across u tilted by the pressure angle
    n = np.array([-np.sin(20 * deg), np.cos(20 * deg)])
    forces = pin_forces(MOTION)
    (mesh,) = [each for each in forces.joints if each.kind == "mesh"]
    assert_allclose(mesh.force, n[:, None] * tooth, rtol=1e-12, atol=1e-10)
    assert_allclose(mesh.place, np.broadcast_to([[0.1], [0.0]], (2, 7)), atol=1e-15)
    assert_allclose(forces.drives["phi"], tooth * np.cos(20 * deg) * 0.1, rtol=1e-12, atol=1e-11)
    (pin,) = [each for each in forces.at("M") if each.kind == "pin"]
    sign = 1.0 if pin.on == forces.body_named("M B") else -1.0
    assert_allclose(sign * pin.force, -n[:, None] * tooth - np.array([120.0, -weight])[:, None], rtol=1e-12, atol=1e-9)


CASE = Case(
    Winch(), {"phi": PHI}, points=["B"], forces=[drive_force(), pin_force("M")], variables=["load.mass", "r1", "OA"], drives=["phi"],
    kinds=[GearPair],
)  # fmt: skip


@pytest.mark.parametrize("read", OF_NUMBERS)
def test_readings_agree(read, tmp_path):
    read(CASE, tmp_path)


def test_equations_name_the_radii():
    assert "r1" in str(equations(Winch)["B"])


def test_gears_whose_centres_stand_too_far_apart_are_refused_wherever_forces_are_asked():
    apart = Winch(M=(0.31, 0.0))
    words = "B.joints.*: the joint 'mesh' at B holds 'n' between"
    for ask in (
        lambda: pin_forces(apart.at(phi=PHI)),
        lambda: apart.evaluate([pin_force("M")], phi=PHI),
        lambda: apart.at(phi=PHI).gradient(pin_force("M"), wrt=["load.mass"]),
        lambda: apart.function([pin_force("M")])(0.5),
    ):
        with pytest.raises(DefinitionError, match=words):
            ask()
