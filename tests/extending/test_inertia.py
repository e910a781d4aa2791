"""Inertia by d'Alembert: a force element that asks for second ratios; how fast the strokes move are numbers given to it."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import (
    LEFT,
    Crank,
    Dimension,
    Dyad,
    ForceElement,
    Ground,
    Load,
    Mechanism,
    OnLink,
    Stroke,
    Weight,
    drive_force,
    driving_force,
    pin_force,
)
from linkage.quantities import Reference, name_of
from tests.extending.readings import OF_NUMBERS, Case


@dataclass(frozen=True, eq=False)
class Inertia(ForceElement):
    """The inertia of a mass at a point: `swing = Inertia(G, mass=12, drive="phi", rate=3.0, acceleration=5.0)`.

    The stroke `drive` moves at `rate` [1/s] and grows at `acceleration` [1/s2] of it, the others stand still; the force is what
    d'Alembert says, -mass times the point's acceleration.
    """

    point: Reference
    mass: float | Dimension
    rate: float | Dimension
    acceleration: float | Dimension = 0.0
    drive: str = ""
    parameters: ClassVar[Mapping[str, str]] = {"mass": "kg", "rate": "", "acceleration": ""}
    not_negative: ClassVar[frozenset[str]] = frozenset({"mass"})

    def loads(self, motion):
        mass, rate, growth = (self.number(motion, name) for name in self.parameters)
        point, drive = name_of(self.point), self.drive or None
        moved = motion.ratio(point, wrt=drive, order=2) * rate**2 + motion.ratio(point, wrt=drive) * growth
        return [Load(point, -mass * moved)]


class Shaker(Mechanism):
    """A four-bar whose coupler carries a heavy point, at speed."""

    phi = Stroke(0.3, 2.6)
    O, C = Ground(0.0, 0.0), Ground(0.8, 0.0)
    A = Crank(O, OA=0.2, angle=phi)
    B = Dyad(A, C, AB=0.75, CB=0.5, side=LEFT)
    G = OnLink(A, B, AG=0.5, BAG=0.3, side=LEFT)
    load = Weight(G, mass=6)
    swing = Inertia(G, mass=6, rate=12.0, acceleration=30.0)


class Arms(Mechanism):
    """Two arms, each with a stroke of its own; the second one moves."""

    phi, psi = Stroke(0.2, 1.2), Stroke(0.3, 1.3)
    O = Ground(0.0, 0.0)
    A = Crank(O, OA=0.5, angle=phi)
    B = Crank(A, AB=0.4, angle=psi)
    swing = Inertia(B, mass=4, rate=5.0, drive="psi")


PHI = np.linspace(0.3, 2.6, 7)
MOTION = Shaker().at(phi=PHI)


def test_the_drive_gives_the_power_that_energy_takes():
    """By kinetic and potential energy along the motion in time, differenced: Q = d(E)/dt over the rate."""

    def energy(time, at):
        phi = at + 12.0 * time + 15.0 * time**2
        rate = 12.0 + 30.0 * time
        motion = Shaker().at(phi=phi)
        v = motion.ratio("G") * rate
        return 3.0 * (v**2).sum(axis=0) + 6 * 9.80665 * motion["G"][1]

    wanted = (energy(1e-6, PHI) - energy(-1e-6, PHI)) / 2e-6 / 12.0
    assert_allclose(driving_force(MOTION), wanted, rtol=1e-6, atol=1e-4)


def test_a_crank_pulls_towards_its_centre():
    motion = Arms().at(phi=[0.4, 0.9], psi=[0.7, 1.1])
    found = Arms.plan.members["swing"].loads(motion)[0].force
    u = np.array([np.cos([0.7, 1.1]), np.sin([0.7, 1.1])])
    assert_allclose(found, 4 * 0.4 * 25.0 * u, rtol=1e-13)


CASE = Case(
    Shaker(), {"phi": PHI}, points=["G"], forces=[drive_force(), pin_force("C")],
    variables=["swing.mass", "swing.rate", "swing.acceleration", "OA", "CB"], drives=["phi"], kinds=[Inertia],
)  # fmt: skip
TWO = Case(
    Arms(), {"phi": np.linspace(0.3, 1.1, 5), "psi": np.linspace(0.4, 1.2, 5)}, points=["B"],
    forces=[drive_force("phi"), drive_force("psi"), pin_force("A")], variables=["swing.mass", "AB"], drives=["phi", "psi"], kinds=[Inertia],
)  # fmt: skip


@pytest.mark.parametrize("case", [pytest.param(CASE, marks=pytest.mark.slow), TWO], ids=["one stroke", "two strokes"])
@pytest.mark.parametrize("read", OF_NUMBERS)
def test_readings_agree(read, case, tmp_path):
    read(case, tmp_path)
