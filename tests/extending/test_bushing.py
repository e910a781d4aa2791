"""A rubber bushing whose stiffness grows, with damping in a unit of its own: a force element that knows speeds, in every reading."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import (
    Crank,
    DefinitionError,
    Dimension,
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
    pin_forces,
)
from linkage.files import load, to_toml
from linkage.quantities import Reference, name_of
from linkage.units import add_unit, parse, show, unit_system
from tests.extending.readings import READINGS, Case

add_unit("N s/m", 1.0, "damping")
kNs_m = add_unit("kN s/m", 1e3, "damping")


@dataclass(frozen=True, eq=False)
class Bushing(ForceElement):
    """A bushing between A and B: `mount = Bushing(A, B, stiffness=4e5, growth=2e3, damping=900)`.

    It draws B back to A with the stiffness [N/m] times how far they are apart, more by `growth` [1/m2] times the square of that, and with
    the damping [N s/m] times how fast they come apart.
    """

    A: Reference
    B: Reference
    stiffness: float | Dimension
    growth: float | Dimension = 0.0
    damping: float | Dimension = 0.0
    places: ClassVar[tuple[str, ...]] = ("A", "B")
    parameters: ClassVar[Mapping[str, str]] = {"stiffness": "N/mm", "growth": "", "damping": "kN s/m"}
    not_negative: ClassVar[frozenset[str]] = frozenset({"stiffness", "growth", "damping"})

    def pulled(self, motion, speed):
        apart = self.position(motion, "B") - self.position(motion, "A")
        square = apart[0] ** 2 + apart[1] ** 2
        stiff = self.number(motion, "stiffness") * (1.0 + self.number(motion, "growth") * square)
        force = -stiff * apart - (0.0 if speed is None else self.number(motion, "damping") * speed)
        return [Load(name_of(self.A), -force), Load(name_of(self.B), force)]

    def loads(self, motion):
        return self.pulled(motion, None)

    def moving(self, motion, rates):
        if not rates.is_timed:
            return self.loads(motion)
        A, B = name_of(self.A), name_of(self.B)
        parts = [(motion.ratio(B, wrt=name) - motion.ratio(A, wrt=name)) * rate for name, rate in rates.items()]
        return self.pulled(motion, sum(parts[1:], parts[0]))


class Cradle(Mechanism):
    """An engine's cradle on a pin, its far end in a bushing that the frame holds."""

    phi = Stroke(-0.05, 0.06)
    O, F = Ground(0.0, 0.0), Ground(0.9, 0.01)
    A = Crank(O, OA=0.9, angle=phi)
    G = OnLink(O, A, OG=0.55, AOG=0.2)
    load = Weight(G, mass=180)
    mount = Bushing(F, A, stiffness=9e4, growth=300.0, damping=0.9 * kNs_m)


PHI = np.linspace(-0.05, 0.06, 7)
MOTION = Cradle().at(phi=PHI)


def apart(phi):
    return np.array([0.9 * np.cos(phi) - 0.9, 0.9 * np.sin(phi) - 0.01])


def test_the_drive_carries_what_energy_says():
    def energy(phi):
        square = (apart(phi) ** 2).sum(axis=0)
        return 9e4 * (0.5 * square + 300.0 * square**2 / 4.0) + 180 * 9.80665 * 0.55 * np.sin(phi + 0.2)

    wanted = (energy(PHI + 1e-6) - energy(PHI - 1e-6)) / 2e-6
    assert_allclose(driving_force(MOTION), wanted, rtol=1e-6, atol=1e-4)


def test_the_damping_takes_what_speed_says():
    moving, still = (pin_forces(MOTION, rates=rates) for rates in ({"phi": 2.0}, None))
    speed = 0.9 * 2.0 * np.array([-np.sin(PHI), np.cos(PHI)])
    lost = 900.0 * (speed**2).sum(axis=0) / 2.0  # its power over the rate
    assert_allclose(moving.drives["phi"] - still.drives["phi"], lost, rtol=1e-9)
    assert moving.gap < 1e-12
    assert any("mount" in each for each in still.remarks) or still.remarks == ()


def test_its_unit_is_read_shown_and_checked():
    assert parse("1.2 kN s/m") == 1200.0
    assert show(900.0, "kN s/m") == "0.9 kN s/m"
    text = to_toml(Cradle())
    assert load(text.replace("0.9 kN s/m", "1.5 kN s/m"))()["mount.damping"] == 1500.0
    with unit_system("kgf"):
        assert show(900.0, "kN s/m") == "0.9 kN s/m"  # the system does not say how damping is shown
    with pytest.raises(DefinitionError, match="damping where a value of kind length is wanted"):
        parse("3 N s/m", "length")


def test_a_unit_that_is_not_there_is_refused_where_the_element_is_declared():
    @dataclass(frozen=True, eq=False)
    class Wrong(Bushing):
        parameters: ClassVar[Mapping[str, str]] = {"stiffness": "N/mm", "growth": "", "damping": "N sec/m"}

    with pytest.raises(DefinitionError, match="'N sec/m' is unknown"):

        class Rig(Cradle):
            mount = Wrong("F", "A", stiffness=9e4)


CASE = Case(
    Cradle(), {"phi": PHI}, points=["G"], forces=[drive_force(), pin_force("O")],
    variables=["mount.stiffness", "mount.growth", "OA"], drives=["phi"], kinds=[Bushing],
)  # fmt: skip


@pytest.mark.parametrize("read", READINGS)
def test_readings_agree(read, tmp_path):
    read(CASE, tmp_path)
