"""A tipper with a scissor hoist (Marrel's): one cylinder AB opens the scissor of the rod DE and the lever CEB under the body.

As a parts list it is a class III group, for no two circles give its pins; by the body's angle every place follows in turn.
All figures are illustrative, of a 6 t tipper.
"""

from functools import cache
from math import atan2, dist, hypot

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Cylinder, LiftCircuit, lift_verdicts
from linkage import (
    LEFT,
    RIGHT,
    Crank,
    Damper,
    Dyad,
    Ground,
    Link,
    Mechanism,
    OnLink,
    Pin,
    PinFriction,
    Spring,
    Stroke,
    Weight,
    deg,
    driving_force,
    pin_forces,
)
from linkage.units import bar, litre, minute, mm
from tests.for_all import for_all
from tests.machines import plane
from tests.machines.words import number
from tests.mechanisms.free_bodies import FreeBodies

CHASSIS = {"A": (0.45, -0.45), "D": (0.90, -0.40), "K": (1.90, -0.50)}  # from the body's hinge O [m]
BODY = {"C": (1.60, -0.10), "G": (1.70, 0.55), "X": (2.60, -0.05)}  # where it lies flat
OC, OG, OX = (hypot(*BODY[name]) for name in "CGX")
TO_C, TO_G, TO_X = (atan2(BODY[name][1], BODY[name][0]) for name in "CGX")
CG = dist(BODY["C"], BODY["G"])
DE, CE, EB, CB = 1.70, 1.03, 0.5278, 0.5921
MASS = 6000.0
L0 = 1.7900  # the cylinder's length at S = 0


class Tipper(Mechanism):
    """The parts list."""

    S = Stroke(0.0, 0.265)

    O = Ground(0.0, 0.0)
    A = Ground(*CHASSIS["A"])
    D = Ground(*CHASSIS["D"])
    C = Pin(near=(1.60, -0.10))
    E = Pin(near=(2.60, -0.35))
    B = Pin(near=(2.18, -0.02))
    G = Pin(near=(1.70, 0.55))

    body = Link("O C G", OC=OC, OG=OG, CG=CG)
    lever = Link("C E B", CE=CE, EB=EB, CB=CB)
    rod = Link("D E", DE=DE)
    ram = Link("A B", AB=L0 + S)

    load = Weight(G, mass=MASS)
    lift = Cylinder(A, B, bore=140 * mm, rod=80 * mm, closed=1.780, stroke=0.280)
    line = LiftCircuit(lift, pressure=160 * bar, flow=60 * litre / minute, mechanical_efficiency=0.9, hydraulic_efficiency=0.96)


class ByAngle(Mechanism):
    """The body's angle drives; the cylinder hangs beside it."""

    tip = Stroke(0.0, 50 * deg)

    O = Ground(0.0, 0.0)
    A = Ground(*CHASSIS["A"])
    D = Ground(*CHASSIS["D"])
    C = Crank(O, OC=OC, angle=tip + TO_C)
    G = OnLink(O, C, OG=OG, COG=TO_G - TO_C)
    E = Dyad(D, C, DE=DE, CE=CE, side=RIGHT)
    B = OnLink(C, E, CB=CB, EB=EB, side=LEFT)

    load = Weight(G, mass=MASS)
    lift = Cylinder(A, B, bore=140 * mm, rod=80 * mm, closed=1.780, stroke=0.280)
    line = LiftCircuit(lift, pressure=160 * bar, flow=60 * litre / minute, mechanical_efficiency=0.9, hydraulic_efficiency=0.96)


# -- by hand -----------------------------------------------------------------------------------------------

TIPS = np.array([0.02, 0.15, 0.30, 0.50, 0.70, 0.84])


def places(q):
    """Return every place by the body's angle."""
    found = {"O": plane.point(0.0, 0.0)} | {name: plane.point(*place) for name, place in CHASSIS.items()}
    found |= {name: plane.turned(place, q[0]) for name, place in BODY.items()}
    found["E"] = plane.meet(found["D"], DE, found["C"], CE, plane.RIGHT)
    found["B"] = plane.meet(found["C"], CB, found["E"], EB, plane.LEFT)
    return found


def opened(tip):
    """Return the cylinder's length."""
    p = places([tip])
    return plane.length(p["A"], p["B"])


LOADS = [("G", (0.0, -MASS * plane.G))]


def thrust(tip, loads=LOADS):
    """Return the cylinder's thrust by virtual work."""
    return plane.balance(places, [tip], loads, [("A", "B")])[0]


def cut(tip, rub=lambda pin: 0.0, sense=0):
    """Return the free bodies' forces, the cylinder a body of its own; `rub(pin)` are moments of friction at A, B and O."""
    p, moved, bodies = places([tip]), plane.rate(places, [tip]), FreeBodies()
    bodies.pin("O", "body", "frame", p["O"])
    bodies.pin("C", "lever", "body", p["C"])
    bodies.pin("E", "lever", "rod", p["E"])
    bodies.pin("D", "rod", "frame", p["D"])
    bodies.pin("A", "ram", "frame", p["A"])
    bodies.pin("B", "lever", "ram", p["B"])
    bodies.load("body", p["G"], LOADS[0][1])
    AB, CE_ = p["B"] - p["A"], p["E"] - p["C"]
    ram = (AB[0] * moved["B"][1] - AB[1] * moved["B"][0]) / (AB @ AB)
    lever = (CE_[0] * (moved["E"] - moved["C"])[1] - CE_[1] * (moved["E"] - moved["C"])[0]) / (CE_ @ CE_)
    for pin, outer, inner, turns in (("A", "ram", "frame", ram), ("B", "lever", "ram", lever - ram), ("O", "body", "frame", 1.0)):
        bodies.load(outer, p[pin], (0.0, 0.0), -sense * np.sign(turns) * rub(pin))
        bodies.load(inner, p[pin], (0.0, 0.0), sense * np.sign(turns) * rub(pin))
    return bodies.solve()


def axial(tip, want):
    """Return the thrust that free bodies give."""
    p = places([tip])
    return np.array([want["Bx"], want["By"]]) @ plane.toward(p["A"], p["B"])


BOTH = [(Tipper, lambda: {"S": np.array([opened(tip) - L0 for tip in TIPS])}), (ByAngle, lambda: {"tip": TIPS})]


@pytest.mark.parametrize(("machine", "at"), BOTH)
def test_positions(machine, at):
    motion = machine().at(**at())
    for k, tip in enumerate(TIPS):
        p = places([tip])
        for name in "CEBG":
            assert_allclose(motion[name][:, k], p[name], atol=1e-10)
    assert machine().mobility == 1


@pytest.mark.parametrize(("machine", "at"), BOTH)
def test_thrust_pressure_and_reserve(machine, at):
    motion = machine().at(**at())
    want = np.array([thrust(tip) for tip in TIPS])
    assert_allclose(machine.lift.thrust(motion), want, rtol=1e-9)
    area = plane.disc(0.140)
    assert_allclose(machine.lift.pressure(motion), want / 0.9 / area / 0.96, rtol=1e-9)
    assert_allclose(machine.line.reserve(motion), 0.96 * 160e5 * area * 0.9 / want, rtol=1e-9)
    assert_allclose(machine.line.holding(motion).working, want / area, rtol=1e-9)
    assert_allclose(machine.lift.size.pressure_for(want), want / area, rtol=1e-14)


def test_torque_of_the_angle_is_no_thrust():
    motion = ByAngle().at(tip=TIPS)
    p = [places([tip]) for tip in TIPS]
    assert_allclose(driving_force(motion), [each["G"][0] * MASS * plane.G for each in p], rtol=1e-12)


@pytest.mark.parametrize(("machine", "at"), BOTH)
def test_pins(machine, at):
    forces = pin_forces(machine().at(**at()))
    for k, tip in enumerate(TIPS):
        want = cut(tip)
        size = max(map(abs, want.values()))
        for name, body in (("O", "O C"), ("C", "C E"), ("E", "C E"), ("D", "D E"), ("A", "lift")):
            assert_allclose(forces.force(name, on=body)[:, k], [want[name + "x"], want[name + "y"]], atol=1e-9 * size)
        assert_allclose(forces.thrusts["lift"][k], axial(tip, want), rtol=1e-9)
        assert_allclose(forces.force("B", on="lift")[:, k], [-want["Bx"], -want["By"]], atol=1e-9 * size)


# -- a spring and a damper on the cylinder's own pins ------------------------------------------------------


class Returning(ByAngle):
    """A spring that draws the cylinder in and a damper, both between the cylinder's pins."""

    back = Spring("A", "B", stiffness=9000.0, preload=2500.0)
    slow = Damper("A", "B", coefficient=60e3)


@cache
def returning_list():
    """Return the same in the parts list."""

    class ReturningList(Tipper):
        """The same in the parts list."""

        back = Spring("A", "B", stiffness=9000.0, preload=2500.0)
        slow = Damper("A", "B", coefficient=60e3)

    return ReturningList


@pytest.mark.slow
@for_all("machine", lambda: [Returning, returning_list()])
def test_three_elements_on_two_points(machine):
    """The cylinder carries what the spring and the damper leave; each has its own thrust and its own end forces."""
    by_angle = machine is Returning
    motion = machine().at(tip=TIPS) if by_angle else machine().at(S=np.array([opened(tip) - L0 for tip in TIPS]))
    start = opened(0.0) if by_angle else L0
    rates = {"tip": 0.05} if by_angle else {"S": 0.03}
    forces, rest = pin_forces(motion, rates=rates), pin_forces(motion)
    for k, tip in enumerate(TIPS):
        pull = 2500.0 + 9000.0 * (opened(tip) - start)
        speed = 0.05 * plane.stretch(places, [tip], "A", "B") if by_angle else 0.03
        assert_allclose(forces.thrusts["back"][k], -pull, rtol=1e-8)
        assert_allclose(forces.thrusts["slow"][k], -60e3 * speed, rtol=1e-9)
        assert_allclose(forces.thrusts["lift"][k], thrust(tip) + pull + 60e3 * speed, rtol=1e-9)
        assert_allclose([rest.thrusts["lift"][k], rest.thrusts["slow"][k]], [thrust(tip) + pull, 0.0], rtol=1e-9)
        p, want = places([tip]), cut(tip)
        away = plane.toward(p["A"], p["B"])
        assert_allclose(forces.force("A", on="back")[:, k], -pull * away, rtol=1e-8)  # the frame holds the spring's end
        assert_allclose(forces.force("B", on="slow")[:, k], 60e3 * speed * away, rtol=1e-8)
        for name, body in (("O", "O C"), ("C", "C E"), ("E", "C E")):  # what is beyond the pins does not change
            assert_allclose(forces.force(name, on=body)[:, k], [want[name + "x"], want[name + "y"]], rtol=1e-8)
    assert_allclose(machine.lift.thrust(motion), rest.thrusts["lift"], rtol=1e-12)


# -- friction at the cylinder's own pins -------------------------------------------------------------------


class Dry(ByAngle):
    """Plain pins at the cylinder and the hinge."""

    pin_A = PinFriction("A", radius=35 * mm, coefficient=0.2)
    pin_B = PinFriction("B", radius=30 * mm, coefficient=0.2)
    pin_O = PinFriction("O", radius=40 * mm, coefficient=0.15)


@cache
def dry_list():
    """Return the same in the parts list."""

    class DryList(Tipper):
        """The same in the parts list."""

        pin_A = PinFriction("A", radius=35 * mm, coefficient=0.2)
        pin_B = PinFriction("B", radius=30 * mm, coefficient=0.2)
        pin_O = PinFriction("O", radius=40 * mm, coefficient=0.15)

    return DryList


ARMS = {"A": 0.035 * 0.2, "B": 0.030 * 0.2, "O": 0.040 * 0.15}


@for_all(("machine", "at"), lambda: [(Dry, BOTH[1][1]), (dry_list(), BOTH[0][1])])
@pytest.mark.parametrize(("direction", "sense"), [("extending", 1), ("retracting", -1)])
def test_friction_at_the_ends_of_the_cylinder(machine, at, direction, sense):
    """A cylinder with rubbing ends is a body like any other: the force at its pins leaves its line."""
    motion = machine().at(**at())
    forces, carried = pin_forces(motion, direction=direction), machine.lift.thrust(motion, direction=direction)
    for k, tip in enumerate(TIPS):
        want = plane.rubbed(lambda size, tip=tip: cut(tip, lambda pin: ARMS[pin] * size(pin), sense), "ABO")
        size = max(map(abs, want.values()))
        for name, body in (("O", "O C"), ("C", "C E"), ("E", "C E"), ("A", "lift")):
            assert_allclose(forces.force(name, on=body)[:, k], [want[name + "x"], want[name + "y"]], atol=1e-9 * size)
        assert_allclose(forces.thrusts["lift"][k], axial(tip, want), rtol=1e-9)
        assert_allclose(carried[k], axial(tip, want), rtol=1e-9)
        assert (axial(tip, want) - thrust(tip)) * sense > 0


# -- an assist cylinder on the same line -------------------------------------------------------------------


class Assisted(ByAngle):
    """A second, smaller pair of cylinders KX lifts the body's front; both are on one line."""

    X = OnLink("O", "C", OX=OX, COX=TO_X - TO_C)
    K = Ground(*CHASSIS["K"])
    aux = Cylinder(K, X, bore=63 * mm, rod=40 * mm, count=2)
    line = LiftCircuit(["lift", aux], pressure=160 * bar, mechanical_efficiency=0.9)


@cache
def assisted_list():
    """Return the same in the parts list."""

    class AssistedList(Tipper):
        """The same in the parts list."""

        X = OnLink("O", "C", OX=OX, COX=TO_X - TO_C)
        K = Ground(*CHASSIS["K"])
        aux = Cylinder(K, X, bore=63 * mm, rod=40 * mm, count=2)
        line = LiftCircuit(["lift", aux], pressure=160 * bar, mechanical_efficiency=0.9)

    return AssistedList


@for_all(("machine", "at"), lambda: [(Assisted, BOTH[1][1]), (assisted_list(), BOTH[0][1])])
def test_cylinders_on_one_line_share_their_pressure(machine, at):
    """The oil's work p dV is the load's: thrusts by area."""
    motion = machine().at(**at())
    forces = pin_forces(motion)
    main, side = plane.disc(0.140), 2 * plane.disc(0.063)
    lift, aux, line = machine.lift.thrust(motion), machine.aux.thrust(motion), machine.line.pressure_for(motion)
    for k, tip in enumerate(TIPS):
        volume = main * plane.stretch(places, [tip], "A", "B") + side * plane.stretch(places, [tip], "K", "X")
        pressure = -plane.work(places, [tip], LOADS) / volume
        assert_allclose(lift[k], pressure * main, rtol=1e-9)
        assert_allclose(aux[k], pressure * side, rtol=1e-9)
        assert_allclose(line[k], pressure / 0.9, rtol=1e-9)
        p = places([tip])
        assert_allclose(forces.force("X", on="aux")[:, k], -pressure * side * plane.toward(p["K"], p["X"]), rtol=1e-8)
        assert_allclose(forces.force("B", on="lift")[:, k], -pressure * main * plane.toward(p["A"], p["B"]), rtol=1e-8)


# -- verdicts ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("count", [2, 50])
def test_verdicts_do_not_hang_on_the_poses(count):
    motion = ByAngle().sweep(count)
    most, _ = plane.peak(thrust, 0.0, 50 * deg)
    least = -plane.peak(lambda tip: -thrust(tip), 0.0, 50 * deg)[0]
    lifting, oil, holding, lowering = lift_verdicts(ByAngle.line, motion, resistance=5 * bar)
    area = plane.disc(0.140)
    reserve = 0.96 * 160e5 * area * 0.9 / most
    assert not lifting
    assert "a bore of 160 mm" in str(lifting)
    assert_allclose(number("least reserve is", lifting), reserve, rtol=1e-3)
    assert_allclose(number("up to", holding), most / area / bar, rtol=1e-3)
    assert bool(holding) == (most / area <= 160e5)
    assert_allclose(number("at least", lowering), least * 0.9 / area / bar, rtol=1e-3)
    assert lowering
    assert_allclose(number("end to end,", oil), (opened(50 * deg) - opened(0.0)) * area / 1e-3, rtol=2e-2)
    use, _ = plane.peak(lambda tip: thrust(tip) / 0.9 / plane.critical(0.080, opened(tip)), 0.0, 50 * deg)
    checks = {each.rule: each for each in ByAngle.lift.checks(motion)}
    assert bool(checks["buckling"]) == (use * 3.5 <= 1.0)
    assert_allclose(number("safety", checks["buckling"]), 1 / use, rtol=6e-3)
    assert bool(checks["length"]) == (opened(0.0) >= 1.780 and opened(50 * deg) <= 2.060)
