"""The turnover of a reversible plough: one cylinder swings the beam by half a turn and passes its dead centre on the way.

Seen along the furrow: the beam turns about O, the cylinder hangs between A above it and B on the beam's arm. It draws in up to
90 degrees and comes out again beyond. All figures are illustrative, of a four-furrow plough.
"""

from math import pi

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Cylinder, LiftCircuit, lift_verdicts
from linkage import (
    Actuator,
    Crank,
    Ground,
    Mechanism,
    Moment,
    OnLink,
    PinFriction,
    SingularError,
    Stroke,
    Weight,
    deg,
    driving_force,
    pin_forces,
)
from linkage.units import bar, litre, minute, mm
from tests.for_all import first_daily, for_all
from tests.machines import plane
from tests.machines.words import number
from tests.mechanisms.free_bodies import FreeBodies

ABOVE, OB, OG, BOG = 0.75, 0.22, 0.35, 25 * deg
MASS = 900.0


class Plough(Mechanism):
    """The beam OBG, its angle, and the cylinder beside it."""

    phi = Stroke(0.0, pi)

    O = Ground(0.0, 0.0)
    A = Ground(0.0, ABOVE)
    B = Crank(O, OB=OB, angle=phi)
    G = OnLink(O, B, OG=OG, BOG=BOG)

    beam = Weight(G, mass=MASS)
    turn = Cylinder(A, B, bore=80 * mm, rod=40 * mm, works="both", closed=0.525, stroke=0.260)
    line = LiftCircuit(turn, pressure=170 * bar, relief=190 * bar, back_pressure=5 * bar, flow=30 * litre / minute)


# -- by hand -----------------------------------------------------------------------------------------------

ANGLES = np.array([0.0, 0.4, 1.0, 1.4, 1.8, 2.4, pi])


def places(q):
    """Return every place by the beam's angle."""
    arm = plane.point(np.cos(q[0]), np.sin(q[0]))
    return {"O": plane.point(0.0, 0.0), "A": plane.point(0.0, ABOVE), "B": OB * arm, "G": OG * plane.turned(arm, BOG)}


LOADS = [("G", (0.0, -MASS * plane.G))]


def thrust(phi, loads=LOADS):
    """Return the cylinder's thrust: the beam's moment over the lever of AB about O."""
    return plane.balance(places, [phi], loads, [("A", "B")])[0]


def long(phi):
    """Return the cylinder's length."""
    p = places([phi])
    return plane.length(p["A"], p["B"])


def cut(phi, rub=lambda pin: 0.0, sense=0):
    """Return the free bodies' forces."""
    p, moved, bodies = places([phi]), plane.rate(places, [phi]), FreeBodies()
    bodies.pin("O", "beam", "frame", p["O"])
    bodies.pin("A", "ram", "frame", p["A"])
    bodies.pin("B", "beam", "ram", p["B"])
    bodies.load("beam", p["G"], LOADS[0][1])
    AB = p["B"] - p["A"]
    ram = (AB[0] * moved["B"][1] - AB[1] * moved["B"][0]) / (AB @ AB)
    for pin, outer, inner, turns in (("O", "beam", "frame", 1.0), ("A", "ram", "frame", ram), ("B", "beam", "ram", 1.0 - ram)):
        bodies.load(outer, p[pin], (0.0, 0.0), -sense * np.sign(turns) * rub(pin))
        bodies.load(inner, p[pin], (0.0, 0.0), sense * np.sign(turns) * rub(pin))
    return bodies.solve()


def test_thrust_on_both_sides_of_the_dead_centre():
    """By the lever: OB * |A| * cos(phi) / AB, which vanishes at 90 degrees and changes its sign there."""
    motion = Plough().at(phi=ANGLES)
    lever = np.array([-OB * ABOVE * np.cos(phi) / long(phi) for phi in ANGLES])
    want = MASS * plane.G * OG * np.cos(ANGLES + BOG) / lever
    assert_allclose([thrust(phi) for phi in ANGLES], want, rtol=1e-12)
    assert_allclose(Plough.turn.thrust(motion), want, rtol=1e-11)
    assert_allclose(pin_forces(motion).thrusts["turn"], want, rtol=1e-11)
    assert_allclose(driving_force(motion), MASS * plane.G * OG * np.cos(ANGLES + BOG), rtol=1e-12)
    assert want[0] < 0 < want[3] and want[5] < 0  # it draws, holds back, and holds back while it comes out


def test_pins():
    forces = pin_forces(Plough().at(phi=ANGLES))
    for k, phi in enumerate(ANGLES):
        want, p = cut(phi), places([phi])
        size = max(map(abs, want.values()))
        assert_allclose(forces.force("O", on="O B")[:, k], [want["Ox"], want["Oy"]], atol=1e-11 * size)
        assert_allclose(forces.force("A", on="turn")[:, k], [want["Ax"], want["Ay"]], atol=1e-11 * size)
        assert_allclose(forces.force("B", on="O B")[:, k], [want["Bx"], want["By"]], atol=1e-11 * size)
        assert_allclose(forces.force("A", on="turn")[:, k], thrust(phi) * plane.toward(p["A"], p["B"]), atol=1e-11 * size)


@for_all("ask", [Plough.turn.thrust, Plough.turn.pressure, Plough.line.pressure_for, Plough.line.reserve, pin_forces])
def test_dead_centre_is_refused(ask):
    """No thrust of this cylinder balances the beam at 90 degrees."""
    with pytest.raises(SingularError, match=r"turn|A B|AB"):
        ask(Plough().at(phi=pi / 2))


def test_capacity_at_the_dead_centre_is_refused():
    with pytest.raises(SingularError, match="turn"):
        Plough.line.capacity(Plough().at(phi=pi / 2), "G", along=(0, 1))


def test_moment_at_the_dead_centre_is_a_number():
    assert_allclose(driving_force(Plough().at(phi=pi / 2)), -MASS * plane.G * OG * np.sin(BOG), rtol=1e-12)


def test_limits_name_the_dead_centre():
    told = str(Plough().sweep(7).limits())
    assert "turn" in told and "90 deg" in told, told


def test_closely_beside_the_dead_centre_it_is_still_right():
    off = np.array([-1e-3, 1e-3, -0.02, 0.02])
    motion = Plough().at(phi=pi / 2 + off)
    want = [thrust(pi / 2 + each) for each in off]
    assert_allclose(Plough.turn.thrust(motion), want, rtol=1e-10)
    assert want[0] > 1e6 and want[1] < -1e6


def test_pressures_of_both_sides():
    motion = Plough().at(phi=ANGLES)
    disc, ring = plane.disc(0.080), plane.annulus(0.080, 0.040)
    push = np.array([thrust(phi) for phi in ANGLES])
    works, other = np.where(push > 0, disc, ring), np.where(push > 0, ring, disc)
    assert_allclose(Plough.turn.pressure(motion), (abs(push) + 5e5 * other) / works, rtol=1e-10)
    assert_allclose(Plough.line.reserve(motion), (170e5 * works - 5e5 * other) / abs(push), rtol=1e-10)


@pytest.mark.parametrize("count", [2, 50])
def test_verdicts_short_of_the_dead_centre(count):
    """Up to 60 degrees it draws in; the greatest pull lies at the start."""
    motion = Plough().at(phi=np.linspace(0.0, 60 * deg, count))
    ring, disc = plane.annulus(0.080, 0.040), plane.disc(0.080)
    most, _ = plane.peak(lambda phi: -thrust(phi), 0.0, 60 * deg)
    lifting, _, holding, _ = lift_verdicts(Plough.line, motion)
    assert lifting
    assert_allclose(number("least reserve is", lifting), (170e5 * ring - 5e5 * disc) / most, rtol=1e-3)
    assert holding
    assert_allclose(number("holds up to", holding), most / ring / bar, rtol=1e-3)


@first_daily(1, "count", [50, 2, 3])
def test_verdict_over_the_dead_centre_is_no(count):
    """Whether a pose meets it, as that of three does, or not: no pump turns the beam through it."""
    lifting, *_ = lift_verdicts(Plough.line, Plough().sweep(count))
    assert not lifting, str(lifting)


@first_daily(2, "count", [2, 50, 3])
def test_length_is_looked_for_between_the_ends(count):
    """At both ends AB is longest; 5 mm are missing in the middle, where the cylinder would be too long closed."""
    long_closed = Cylinder("A", "B", bore=80 * mm, rod=40 * mm, works="both", closed=0.535, stroke=0.260)
    machine = type("Long", (Plough,), {"turn": long_closed})
    (length,) = long_closed.fits(machine().sweep(count))
    assert not length
    assert "5.0 mm too long closed" in str(length)
    (length,) = Plough.turn.fits(Plough().sweep(count))
    assert length


def test_actuator_turns_it_through():
    """A given force has no dead centre: the crank's couple is what it leaves."""
    pushed = type("Pushed", (Mechanism,), {**plain(Plough, {"turn", "line"}), "turn": Actuator("A", "B", force=-9000.0)})
    motion = pushed().at(phi=np.array([0.4, pi / 2, 2.0]))
    forces = pin_forces(motion)
    for k, phi in enumerate((0.4, pi / 2, 2.0)):
        p = places([phi])
        pull = ("B", -9000.0 * plane.toward(p["A"], p["B"]))
        assert_allclose(forces.drives["phi"][k], -plane.work(places, [phi], [*LOADS, pull]), atol=1e-9)
        assert_allclose(forces.force("A", on="turn")[:, k], -9000.0 * plane.toward(p["A"], p["B"]), atol=1e-9)
    assert_allclose(forces.thrusts["turn"], -9000.0, rtol=1e-14)
    held = Plough().at(phi=0.4)
    same = type("Same", (pushed,), {"turn": Actuator("A", "B", force=float(Plough.turn.thrust(held)))})
    balanced = pin_forces(same().at(phi=0.4))
    assert_allclose(balanced.drives["phi"], 0.0, atol=1e-11 * MASS * plane.G * OG)
    assert_allclose(balanced.force("O", on="O B"), pin_forces(held).force("O", on="O B"), rtol=1e-11)


def plain(machine, without):
    """Return a class's own members but some."""
    return {name: member for name, member in vars(machine).items() if name not in without and not name.startswith("_")}


# -- friction, and what a user adds ------------------------------------------------------------------------


class Dry(Plough):
    """Plain bearings."""

    shaft = PinFriction("O", radius=60 * mm, coefficient=0.12)
    eye_A = PinFriction("A", radius=20 * mm, coefficient=0.15)
    eye_B = PinFriction("B", radius=20 * mm, coefficient=0.15)


RUB = {"O": 0.060 * 0.12, "A": 0.020 * 0.15, "B": 0.020 * 0.15}


def test_friction_follows_the_beam_and_the_cylinder_its_own_growth():
    """`extending` of the forces is the angle's growth; of the cylinder its own, which runs backwards before the dead centre."""
    angles = np.array([0.2, 0.7, 2.2, 2.8])
    motion = Dry().at(phi=angles)
    for direction, sense in (("extending", 1), ("retracting", -1)):
        forces = pin_forces(motion, direction=direction)
        own = Dry.turn.thrust(motion, direction=direction)
        for k, phi in enumerate(angles):
            grows = np.sign(plane.stretch(places, [phi], "A", "B"))
            for found, turns in ((forces.thrusts["turn"], sense), (own, sense * grows)):
                want = plane.rubbed(lambda size, phi=phi, turns=turns: cut(phi, lambda pin: RUB[pin] * size(pin), turns), "OAB")
                p = places([phi])
                assert_allclose(found[k], np.array([want["Bx"], want["By"]]) @ plane.toward(p["A"], p["B"]), rtol=1e-9)


class Loaded(Plough):
    """A user's own: wet soil on the mouldboards, and the hose reel's drag."""

    soil = Weight("G", mass=250.0)
    drag = Moment("O B", M=-180.0)


def test_what_a_user_adds_counts():
    motion = Loaded().at(phi=ANGLES)
    lever = np.array([plane.stretch(places, [phi], "A", "B") for phi in ANGLES])
    want = ((MASS + 250.0) * plane.G * OG * np.cos(ANGLES + BOG) + 180.0) / lever
    assert_allclose(Loaded.turn.thrust(motion), want, rtol=1e-11)
    holding = Loaded.line.holding(motion)
    ring, disc = plane.annulus(0.080, 0.040), plane.disc(0.080)
    assert_allclose(holding.working + holding.other, np.where(want > 0, want / disc, -want / ring), rtol=1e-10)
