"""A square baler: flywheel crank, connecting rod and plunger against the bale; a rail pressed on the bale by a gas-fed cylinder.

Crank OA, rod AB, plunger B E F on its guide; the rail RT turns about R, the cylinder KX presses it. All figures illustrative.
"""

from math import pi

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Accumulator, AccumulatorBlock, Cylinder, FloatCircuit, isothermal
from linkage import (
    RIGHT,
    Between,
    Crank,
    Damper,
    Ground,
    Guide,
    GuideFriction,
    LinkMass,
    Mechanism,
    OnLink,
    PinFriction,
    SliderDyad,
    Stroke,
    Support,
    Weight,
    deg,
    driving_force,
    pin_forces,
    reaction,
)
from linkage.units import bar, mm
from tests.machines import plane
from tests.mechanisms.free_bodies import FreeBodies

OA, AB, BE, LINE, WALL = 0.36, 1.05, 0.70, -0.06, 2.75  # m
RAIL, RX, R, K = 1.40, 0.85, (1.70, 0.60), (2.20, 1.35)
BALE, FREE = 90e3, 0.95  # N/m, m
CHARGE = 120 * bar
VESSELS = [(2.0e-3, 60 * bar), (1.0e-3, 110 * bar)]


def bale(length, rate):
    """Return what the bale pushes back with: stiffly, harder the faster it is struck, and never a pull."""
    return np.where(length < FREE, BALE * (FREE - length) - 6e3 * np.minimum(rate, 0.0), 0.0)


class Baler(Mechanism):
    """Two strokes: the flywheel's angle, and the rail's."""

    phi = Stroke(0.0, 2 * pi)
    rail = Stroke(-4 * deg, 4 * deg)

    O = Ground(0.0, 0.0)
    line = Guide((0.0, LINE), angle=0.0)
    A = Crank(O, OA=OA, angle=phi)
    B = SliderDyad(A, line, AB=AB, side=RIGHT)
    E = SliderDyad(B, line, BE=BE, side=RIGHT)
    W = Ground(WALL, LINE)

    R = Ground(*R)
    K = Ground(*K)
    T = Crank(R, RT=RAIL, angle=rail)
    X = OnLink(R, T, RX=RX)

    rod_mass = LinkMass("A B", mass=48.0)
    plunger_mass = LinkMass("B E", mass=260.0)
    rail_mass = LinkMass("R T", mass=170.0)
    straw = Between(E, W, bale)
    brush = Damper(O, B, coefficient=400.0)
    squeeze = Support(T, (0, 1))

    press = Cylinder(K, X, bore=63 * mm, rod=40 * mm, closed=0.70, stroke=0.20)
    gas = FloatCircuit(
        press, AccumulatorBlock([Accumulator(volume, charge) for volume, charge in VESSELS], isothermal),
        charge_pressure=CHARGE, at=0.0, seal_friction=3 * bar,
    )  # fmt: skip


# -- by hand -----------------------------------------------------------------------------------------------

POSES = np.array([(0.3, -0.05), (1.2, 0.02), (2.5, 0.06), (3.6, 0.0), (4.9, -0.03), (5.9, 0.05)])
FAST = 8.0  # flywheel, rad/s


def places(q):
    """Return every place by the two angles, and the two angles."""
    A = OA * plane.point(np.cos(q[0]), np.sin(q[0]))
    B = plane.point(A[0] + np.sqrt(AB**2 - (A[1] - LINE) ** 2), LINE + 0 * A[0])
    T = plane.point(*R) + plane.turned((RAIL, 0.0), q[1])
    return {
        "O": plane.point(0.0, 0.0), "A": A, "B": B, "E": B + plane.point(BE, 0.0), "W": plane.point(WALL, LINE), "R": plane.point(*R),
        "K": plane.point(*K), "T": T, "X": plane.point(*R) + plane.turned((RX, 0.0), q[1]), "phi": q[0], "rail": q[1],
    }  # fmt: skip


def forces_along(q, speed):
    """Return the thrust of the bale and of the brush at a speed of the flywheel."""
    gap = plane.length(*(places(q)[name] for name in "EW"))
    closing = plane.stretch(places, q, "E", "W") * speed
    straw = BALE * (FREE - gap) - 6e3 * min(closing, 0.0) if gap < FREE else 0.0
    return straw, -400.0 * plane.stretch(places, q, "O", "B") * speed


def line_pressure(rail):
    """Return the line's pressure: what the pressed-in rod pushes into the vessels squeezes their gas."""
    p, start = places([0.0, rail]), places([0.0, 0.0])
    drawn_out = (plane.length(p["K"], p["X"]) - plane.length(start["K"], start["X"])) * plane.disc(0.063)
    return plane.isothermal_pressure(VESSELS, plane.gas_of(VESSELS, CHARGE) + drawn_out)


def own_loads(q, speed=0.0):
    """Return all loads of the flywheel's side, and of the rail's."""
    p, (straw, brush) = places(q), forces_along(q, speed)
    toward, away = plane.toward(p["E"], p["W"]), plane.toward(p["O"], p["B"])
    crank = [("A", (0.0, -24.0 * plane.G)), ("B", (0.0, -24.0 * plane.G)), ("B", (0.0, -130.0 * plane.G)), ("E", (0.0, -130.0 * plane.G))]
    crank += [("E", -straw * toward), ("B", brush * away)]
    push = line_pressure(q[1]) * plane.disc(0.063) * plane.toward(p["K"], p["X"])
    return crank, [("T", (0.0, -85.0 * plane.G)), ("X", push)]


def cut(q, speed=0.0, rub=lambda joint: 0.0, sense=0):
    """Return the free bodies' forces of crank, rod and plunger."""
    p, (straw, brush), bodies = places(q), forces_along(q, speed), FreeBodies()
    moved = plane.rate(places, q)
    bodies.pin("O", "crank", "frame", p["O"])
    bodies.torque("M", "crank", "frame")
    bodies.pin("A", "rod", "crank", p["A"])
    bodies.pin("B", "plunger", "rod", p["B"])
    bodies.along("NB", "plunger", "frame", p["B"], (0.0, 1.0))
    bodies.along("NE", "plunger", "frame", p["E"], (0.0, 1.0))
    for body, ends, mass in (("rod", "AB", 48.0), ("plunger", "BE", 260.0)):
        for end in ends:
            bodies.load(body, p[end], (0.0, -mass / 2 * plane.G))
    bodies.load("plunger", p["E"], -straw * plane.toward(p["E"], p["W"]))
    bodies.load("rod", p["B"], brush * plane.toward(p["O"], p["B"]))
    AB_, slip = p["B"] - p["A"], moved["B"] - moved["A"]
    rod = (AB_[0] * slip[1] - AB_[1] * slip[0]) / (AB_ @ AB_)
    turning = (("O", "crank", "frame", 1.0), ("A", "rod", "crank", rod - 1.0), ("B", "plunger", "rod", -rod))
    for pin, outer, inner, turns in turning:
        bodies.load(outer, p[pin], (0.0, 0.0), -sense * np.sign(turns) * rub(pin))
        bodies.load(inner, p[pin], (0.0, 0.0), sense * np.sign(turns) * rub(pin))
    for end in "BE":
        bodies.load("plunger", p[end], (-sense * np.sign(moved["B"][0]) * abs(rub("N" + end)), 0.0))
    return bodies.solve()


def at(poses=POSES):
    """Return the strokes of poses."""
    return {"phi": poses[:, 0], "rail": poses[:, 1]}


def test_positions():
    motion = Baler().at(**at())
    for k, q in enumerate(POSES):
        p = places(q)
        for name in "ABETX":
            assert_allclose(motion[name][:, k], p[name], atol=1e-13)


@pytest.mark.parametrize("speed", [0.0, FAST])
def test_torque_of_the_flywheel(speed):
    """Nothing moves at rest: neither the brush nor the bale's damping counts."""
    motion = Baler().at(**at())
    rates = {"phi": speed, "rail": 0.0} if speed else None
    want = [-plane.work(places, q, own_loads(q, speed)[0]) for q in POSES]
    assert_allclose(driving_force(motion, drive="phi", rates=rates), want, rtol=1e-11)
    forces = pin_forces(motion, rates=rates)
    assert_allclose(forces.drives["phi"], want, rtol=1e-10)
    straw, brush = np.array([forces_along(q, speed) for q in POSES]).T
    assert_allclose(forces.thrusts["straw"], straw, rtol=1e-11, atol=1e-9)
    assert_allclose(forces.thrusts["brush"], brush, rtol=1e-11, atol=1e-9)
    assert straw.max() > 10e3 and straw.min() == 0.0


def test_pins_of_the_press():
    forces = pin_forces(Baler().at(**at()), rates={"phi": FAST, "rail": 0.0})
    for k, q in enumerate(POSES):
        want = cut(q, FAST)
        size = max(map(abs, want.values()))
        assert_allclose(forces.drives["phi"][k], want["M"], atol=1e-11 * size)
        for name, body in (("O", "O A"), ("A", "A B")):
            assert_allclose(forces.force(name, on=body)[:, k], [want[name + "x"], want[name + "y"]], atol=1e-11 * size)
        straw = forces.force("E", on="straw")[:, k]  # the plunger pushes the straw to the wall
        assert_allclose(straw, [forces_along(q, FAST)[0], 0.0], atol=1e-9)
        assert_allclose(forces.force("W", on="straw")[:, k], -straw, atol=1e-9)


def test_flywheel_gets_back_what_the_bale_stores():
    """At rest the bale is a spring: the torque's work from one angle to another is what the loads gain."""
    first, last = 0.25, 1.05
    nodes, weights = np.polynomial.legendre.leggauss(24)
    phi = first + (nodes + 1) / 2 * (last - first)
    torque = driving_force(Baler().at(phi=phi, rail=np.zeros(24)), drive="phi")
    gaps = [FREE - float(plane.length(*(places((each, 0.0))[name] for name in "EW"))) for each in (first, last)]
    stored = [BALE / 2 * max(gap, 0.0) ** 2 for gap in gaps]
    height = [48.0 / 2 * places((each, 0.0))["A"][1] * plane.G for each in (first, last)]
    assert min(gaps) > 0.0
    assert_allclose(np.sum(weights / 2 * (last - first) * torque), stored[1] - stored[0] + height[1] - height[0], rtol=1e-10)


# -- the rail's gas-fed cylinder ---------------------------------------------------------------------------


def test_gas_pressure_and_thrust():
    motion = Baler().at(**at())
    want = np.array([line_pressure(q[1]) for q in POSES])
    assert_allclose(Baler.press.pressure(motion), want, rtol=1e-11)
    assert_allclose(Baler.gas.pressure(motion), want, rtol=1e-11)
    assert_allclose(Baler.press.thrust(motion), want * plane.disc(0.063), rtol=1e-11)
    assert_allclose(pin_forces(motion).thrusts["press"], want * plane.disc(0.063), rtol=1e-11)
    assert np.ptp(want) > 5 * bar


@pytest.mark.parametrize(("direction", "sense"), [("frictionless", 0), ("extending", 1), ("retracting", -1)])
def test_squeeze_on_the_bale(direction, sense):
    """The rail rises, the flywheel stands: the rod goes in, and its seals add to what the gas presses with."""
    rails = POSES[:, 1]
    found = reaction(Baler().at(phi=0.3, rail=rails), support="squeeze", drive="rail", direction=direction)
    for k, q in enumerate((0.3, rail) for rail in rails):
        p, (_, loads) = places(q), own_loads(q)
        seals = -sense * np.sign(plane.stretch(places, q, "K", "X", 1)) * 3 * bar * plane.disc(0.063)
        loads = [*loads, ("X", seals * plane.toward(p["K"], p["X"]))]
        want = -plane.work(places, q, loads, 1) / plane.rate(places, q, 1)["T"][1]
        assert_allclose(found[k], want, rtol=1e-10)


def test_ends_of_the_gas_fed_cylinder_are_its_pins():
    """The frame holds K, the rail X, with the gas's force; the rail's own drive carries the rest, the bale's push being none."""
    motion = Baler().at(**at())
    forces = pin_forces(motion)
    for k, q in enumerate(POSES):
        p, push = places(q), line_pressure(q[1]) * plane.disc(0.063)
        away = plane.toward(p["K"], p["X"])
        assert_allclose(forces.force("K", on="press")[:, k], push * away, rtol=1e-10)
        assert_allclose(forces.force("X", on="press")[:, k], -push * away, rtol=1e-10)
        _, loads = own_loads(q)
        assert_allclose(forces.drives["rail"][k], -plane.work(places, q, loads, 1), rtol=1e-9)
        assert_allclose(forces.force("R", on="R T")[:, k], -push * away + [0.0, 170.0 * plane.G], rtol=1e-9)


def test_bale_takes_the_rail():
    """With the bale's push for the support, the rail's drive has nothing to do."""
    q = POSES[1:2]
    push = float(reaction(Baler().at(**at(q)), support="squeeze", drive="rail")[0])
    held = type("Held", (Baler,), {"squeeze": Support("T", (0, 1), force=push)})
    forces = pin_forces(held().at(**at(q)))
    assert_allclose(forces.drives["rail"], 0.0, atol=1e-9)
    p, thrust = places(q[0]), line_pressure(q[0, 1]) * plane.disc(0.063)
    want = -thrust * plane.toward(p["K"], p["X"]) + [0.0, 170.0 * plane.G - push]
    assert_allclose(forces.force("R", on="R T")[:, 0], want, rtol=1e-10)


# -- friction ----------------------------------------------------------------------------------------------


class Dry(Baler):
    """Pins and guides that rub."""

    pin_O = PinFriction("O", radius=55 * mm, coefficient=0.05)
    pin_A = PinFriction("A", radius=45 * mm, coefficient=0.10)
    pin_B = PinFriction("B", radius=40 * mm, coefficient=0.12)
    shoe_B = GuideFriction("B", coefficient=0.15)
    shoe_E = GuideFriction("E", coefficient=0.15)


RUB = {"O": 0.055 * 0.05, "A": 0.045 * 0.10, "B": 0.040 * 0.12, "NB": 0.15, "NE": 0.15}


@pytest.mark.parametrize(("direction", "sense"), [("extending", 1), ("retracting", -1)])
def test_friction_of_pins_and_guides(direction, sense):
    """At B the connecting rod turns in the plunger, which its guide holds."""
    motion = Dry().at(**at())
    forces = pin_forces(motion, direction=direction, drive="phi")
    torque = driving_force(motion, drive="phi", direction=direction)
    for k, q in enumerate(POSES):
        want = plane.rubbed(lambda size, q=q: cut(q, 0.0, lambda joint: RUB[joint] * size(joint), sense), "OAB", ("NB", "NE"))
        size = max(map(abs, want.values()))
        assert_allclose(forces.drives["phi"][k], want["M"], atol=1e-10 * size)
        assert_allclose(torque[k], want["M"], atol=1e-10 * size)
        for name, body in (("O", "O A"), ("A", "A B")):
            assert_allclose(forces.force(name, on=body)[:, k], [want[name + "x"], want[name + "y"]], atol=1e-10 * size)


# -- verdicts ----------------------------------------------------------------------------------------------


def test_rod_of_the_press_does_not_buckle():
    motion = Baler().sweep(phi=2, rail=3)
    lengths = {}

    def use(rail):
        p = places([0.0, rail])
        lengths[rail] = plane.length(p["K"], p["X"])
        return (line_pressure(rail) + 3 * bar) * plane.disc(0.063) / plane.critical(0.040, lengths[rail])

    most, _ = plane.peak(use, -4 * deg, 4 * deg, 40)
    checks = {each.rule: each for each in Baler.press.checks(motion)}
    assert bool(checks["buckling"]) == (most * 3.5 <= 1.0)
    assert f"safety {1 / most:.3g}" in str(checks["buckling"])
    assert bool(checks["length"]) == (min(lengths.values()) >= 0.70 and max(lengths.values()) <= 0.90)


class Heavier(Baler):
    """A user's own: a twine box on the rail's end."""

    twine = Weight("T", mass=60.0)


def test_what_a_user_adds_presses_too():
    motion = Heavier().at(**at())
    found, plain = (reaction(m, support="squeeze", drive="rail") for m in (motion, Baler().at(**at())))
    assert_allclose(found - plain, 60.0 * plane.G, rtol=1e-9)
