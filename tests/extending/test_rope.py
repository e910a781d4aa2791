"""A rope over a pulley: a force element on three points, with an arc that wraps the pulley, in every reading."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import (
    Crank,
    Dimension,
    ForceElement,
    Ground,
    Load,
    Mechanism,
    OnLink,
    Stroke,
    Weight,
    deg,
    drive_force,
    driving_force,
    equations,
    pin_force,
)
from linkage.quantities import Reference, name_of
from tests.extending.readings import OF_NUMBERS, Case


@dataclass(frozen=True, eq=False)
class Rope(ForceElement):
    """An elastic rope from A over a pulley about P to B: `rope = Rope(A, P, B, radius=0.05, length=0.9, stiffness=4e4)`.

    It runs over the top of the pulley from A on the right to B on the left, leaves it along its tangents, and only pulls: the tension is
    the stiffness [N/m] times what it is longer than its `length` [m]. The pulley turns freely on its pin.
    """

    A: Reference
    P: Reference
    B: Reference
    radius: float | Dimension
    length: float | Dimension
    stiffness: float | Dimension
    places: ClassVar[tuple[str, ...]] = ("A", "P", "B")
    parameters: ClassVar[Mapping[str, str]] = {"radius": "mm", "length": "mm", "stiffness": "N/m"}
    not_negative: ClassVar[frozenset[str]] = frozenset({"radius", "length", "stiffness"})

    def spans(self, motion):
        """Return the vectors from the pulley's pin to A and to B, their lengths, what of the rope is free there, and the radius [m]."""
        P, r = motion[name_of(self.P)], self.number(motion, "radius")
        arms = [motion[name_of(each)] - P for each in (self.A, self.B)]
        far = [np.sqrt(arm[0] ** 2 + arm[1] ** 2) for arm in arms]
        free = [np.sqrt(each**2 - r**2) for each in far]
        return arms, far, free, r

    def wrap(self, motion):
        """Return the angle over which the rope lies on the pulley [rad]."""
        (a, b), (far_a, far_b), _, r = self.spans(motion)
        below = np.arctan2(b[0] * a[1] - b[1] * a[0], a[0] * b[0] + a[1] * b[1])  # from B round to A, under the pulley
        return 2.0 * np.pi - below - np.arccos(r / far_a) - np.arccos(r / far_b)

    def tension(self, motion):
        """Return what it pulls with [N]."""
        _, _, (free_a, free_b), r = self.spans(motion)
        longer = free_a + free_b + r * self.wrap(motion) - self.number(motion, "length")
        return self.number(motion, "stiffness") * np.maximum(longer, 0.0)

    def loads(self, motion):
        (a, b), (far_a, far_b), (free_a, free_b), r = self.spans(motion)
        force = self.tension(motion)
        # from A to its tangent point: the arm turned by the angle whose sine is r / far, to the side on which the rope runs
        ways = [
            -(arm * free + side * r * np.stack([-arm[1], arm[0]])) / far**2
            for arm, far, free, side in ((a, far_a, free_a, -1.0), (b, far_b, free_b, 1.0))
        ]
        A, P, B = (name_of(each) for each in (self.A, self.P, self.B))
        return [Load(A, force * ways[0]), Load(B, force * ways[1]), Load(P, -force * (ways[0] + ways[1]))]


class Gate(Mechanism):
    """A gate whose counter-rope runs over a pulley on a post to a spring eye on its other end."""

    phi = Stroke(-20 * deg, 50 * deg)
    O, B = Ground(0.0, 0.0), Ground(-0.6, -0.2)
    P = Ground(-0.25, 0.9)
    A = Crank(O, OA=0.8, angle=phi)
    T = OnLink(O, A, OT=1.1)
    rope = Rope(A, P, B, radius=0.08, length=2.3, stiffness=4e3)
    load = Weight(T, mass=30)


PHI = np.linspace(-20 * deg, 50 * deg, 7)
MOTION = Gate().at(phi=PHI)


def longest(phi, r=0.08):
    """Return the length of the rope, walked along many points of the taut line around the pulley."""
    P, B = np.array([-0.25, 0.9]), np.array([-0.6, -0.2])
    A = np.array([0.8 * np.cos(phi), 0.8 * np.sin(phi)])

    def touching(point, side):
        arm = point - P
        far = np.hypot(*arm)
        return np.arctan2(arm[1], arm[0]) + side * np.arccos(r / far), np.sqrt(far**2 - r**2)

    (start, free_a), (end, free_b) = touching(A, 1.0), touching(B, -1.0)
    return free_a + free_b + r * np.mod(end - start, 2 * np.pi)


def test_the_tension_follows_the_length_of_the_taut_line():
    rope = Gate.plan.members["rope"]
    wanted = [4e3 * max(0.0, longest(phi) - 2.3) for phi in PHI]
    assert_allclose(rope.tension(MOTION), wanted, rtol=1e-12)
    assert 0.0 in wanted and max(wanted) > 100.0


def test_the_drive_carries_what_energy_says():
    """By the change of what the rope and the weight store, differenced."""

    def energy(phi):
        return 0.5 * 4e3 * max(0.0, longest(phi) - 2.3) ** 2 + 30 * 9.80665 * 1.1 * np.sin(phi)

    wanted = [(energy(phi + 1e-6) - energy(phi - 1e-6)) / 2e-6 for phi in PHI]
    assert_allclose(driving_force(MOTION), wanted, rtol=1e-7, atol=1e-4)


CASE = Case(
    Gate(), {"phi": PHI}, points=["T"], forces=[drive_force(), pin_force("O")],
    variables=["rope.stiffness", "rope.length", "rope.radius", "P.x", "OA"], drives=["phi"], kinds=[Rope],
)  # fmt: skip


@pytest.mark.parametrize("read", OF_NUMBERS)
def test_readings_agree(read, tmp_path):
    read(CASE, tmp_path)


def test_equations_say_what_it_pulls_with():
    assert "rope" in str(equations(Gate, forces=True))
