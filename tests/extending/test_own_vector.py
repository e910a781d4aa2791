"""A step whose `place` adds a vector of its own: what no primitive says is written out, with its numbers."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import LEFT, Crank, Dimension, Dyad, Ground, Mechanism, Stroke, Weight, drive_force, equations, pin_force, pin_forces
from linkage.quantities import Joint, JointSide, label, name_of, quantity, source_text
from linkage.steps import Point
from linkage.vectors import Vec
from tests.extending.readings import OF_NUMBERS, Case


class Level(Point):
    """A point beside P on a platform that never turns: `G = Level(P, dx=0.2, dy=h)`.

    The platform stands `dx` to the right of P and `dy` above it [m], and a little more by what it is bolted down with, (0.004, -0.01) m;
    a leveller that is not drawn keeps it from turning against the frame.
    """

    expects = (("P", "point"),)

    def __init__(self, P, *, dx, dy):
        self.P, self.dx, self.dy = P, quantity(dx), quantity(dy)

    def parts(self):
        return self.P, self.dx, self.dy

    def place(self, where):
        return where.at(self.P) + Vec(where.value(self.dx), where.value(self.dy)) + Vec(0.004, -0.01)

    def bodies(self):
        return ((name_of(self.P), self.name),)

    def joints(self):
        """Return the leveller: a couple by the frame."""
        return (Joint("leveller", self.name, JointSide((name_of(self.P), self.name)), JointSide(), "c"),)

    def __str__(self):
        return f"Level({label(self.P)}, dx={source_text(self.dx)}, dy={source_text(self.dy)})"


class Lift(Mechanism):
    """A crank carries a level platform with a load, and a rod hangs from it."""

    phi = Stroke(0.2, 1.3)
    h = Dimension(0.15)
    O, C = Ground(0.0, 0.0), Ground(1.1, -0.1)
    A = Crank(O, OA=0.7, angle=phi)
    G = Level(A, dx=0.2, dy=h)
    K = Dyad(G, C, GK=0.8, CK=0.5, side=LEFT)
    load = Weight(G, mass=70)
    rod = Weight(K, mass=8)


PHI = np.linspace(0.2, 1.3, 7)
MOTION = Lift().at(phi=PHI)


def test_places_and_forces_by_hand():
    A = 0.7 * np.array([np.cos(PHI), np.sin(PHI)])
    assert_allclose(MOTION["G"], A + np.array([[0.204], [0.14]]), atol=1e-15)
    forces = pin_forces(MOTION)
    # the rod and the rocker at K: two-force members, so that K's own balance gives what the rod pulls
    rod, rocker = MOTION["K"] - MOTION["G"], MOTION["K"] - np.array([[1.1], [-0.1]])
    rod, rocker = rod / 0.8, rocker / 0.5
    pull = 8 * 9.80665 / (rod[1] - rocker[1] * rod[0] / rocker[0])  # thrust of the rod
    on_platform = -pull * rod + np.array([[0.0], [-70 * 9.80665]])
    (couple,) = [each for each in forces.joints if each.kind == "leveller"]
    arm = np.array([0.204, 0.14])
    assert_allclose(couple.couple, -(arm[0] * on_platform[1] - arm[1] * on_platform[0]), rtol=1e-10)
    wanted = -(0.7 * np.cos(PHI) * on_platform[1] - 0.7 * np.sin(PHI) * on_platform[0])
    assert_allclose(forces.drives["phi"], wanted, rtol=1e-10)


def test_the_equation_of_the_vector_has_its_numbers():
    written = equations(Lift)
    assert "h" in str(written["G"]) and "0.004" in str(written["G"])
    filled = str(equations(Lift, numbers=True, at={"phi": 0.5}))
    assert "0.15" in filled
    assert_allclose(written.values({"phi": 0.5})["G"], [0.7 * np.cos(0.5) + 0.204, 0.7 * np.sin(0.5) + 0.14], rtol=1e-14)


CASE = Case(
    Lift(), {"phi": PHI}, points=["G", "K"], forces=[drive_force(), pin_force("A"), pin_force("K")],
    variables=["load.mass", "h", "OA", "GK"], drives=["phi"], kinds=[Level],
)  # fmt: skip


@pytest.mark.parametrize("read", OF_NUMBERS)
def test_readings_agree(read, tmp_path):
    read(CASE, tmp_path)
