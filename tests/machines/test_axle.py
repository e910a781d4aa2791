"""A hydropneumatic axle: the wishbone OBW swings on a cylinder AB that a gas block feeds; the ground pushes the wheel.

The wishbone's angle is the coordinate, the ground's reaction W the support. All figures are illustrative, of a trailer's axle side.
"""

from math import pi

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Accumulator, AccumulatorBlock, Cylinder, FloatCircuit, isothermal
from linkage import (
    Between,
    Crank,
    Damper,
    DefinitionError,
    Ground,
    LoadCase,
    Mechanism,
    OnLink,
    PinFriction,
    Stroke,
    Support,
    Weight,
    deg,
    driving_force,
    pin_forces,
    reaction,
)
from linkage.units import bar, litre, mm
from tests.machines import plane
from tests.machines.words import number
from tests.mechanisms.free_bodies import FreeBodies

FRAME_O, FRAME_A = (0.35, 0.45), (0.47, 0.98)  # m
OW, OB, WOB = 0.62, 0.40, 8 * deg
HUB, ARM = 95.0, 38.0  # kg
CHARGE, SEALS = 95 * bar, 2.5 * bar
VESSELS = [(1.0e-3, 40 * bar), (0.75e-3, 85 * bar)]
BORE, ROD = 0.080, 0.050
AREA = pi / 4 * BORE**2
C_DAMPER, STOP, STOP_LENGTH = 9000.0, 250e3, 0.480


def stop(length, rate):
    """Return what a bump stop pushes with: nothing before it is touched."""
    return STOP * np.maximum(STOP_LENGTH - length, 0.0)


class Axle(Mechanism):
    """The wishbone, its cylinder, a damper and a bump stop, all between A and B."""

    psi = Stroke(-14 * deg, 14 * deg)

    O = Ground(*FRAME_O)
    A = Ground(*FRAME_A)
    W = Crank(O, OW=OW, angle=psi)
    B = OnLink(O, W, OB=OB, WOB=WOB)

    wheel = Weight(W, mass=HUB)
    wishbone = Weight(B, mass=ARM)
    ground = Support(W, (0, 1))
    strut = Cylinder(A, B, bore=80 * mm, rod=50 * mm, closed=0.440, stroke=0.200)
    gas = FloatCircuit(
        strut, AccumulatorBlock([Accumulator(volume, charge) for volume, charge in VESSELS], isothermal),
        charge_pressure=CHARGE, at=0.0, seal_friction=SEALS,
    )  # fmt: skip
    damper = Damper(A, B, coefficient=C_DAMPER)
    bump = Between(A, B, stop)

    uphill = LoadCase("uphill", slope=15 * deg)


# -- by hand -----------------------------------------------------------------------------------------------

ANGLES = np.array([-13.0, -6.0, 0.0, 4.0, 9.0, 13.5]) * deg
SPEED = 0.8  # of the wishbone, rad/s


def places(q):
    """Return every place by the wishbone's angle."""
    hinge, arm = plane.point(*FRAME_O), plane.point(np.cos(q[0]), np.sin(q[0]))
    return {"O": hinge, "A": plane.point(*FRAME_A), "W": hinge + OW * arm, "B": hinge + OB * plane.turned(arm, WOB)}


LOADS = [("W", (0.0, -HUB * plane.G)), ("B", (0.0, -ARM * plane.G))]


def long(psi):
    """Return the cylinder's length."""
    p = places([psi])
    return plane.length(p["A"], p["B"])


def line_pressure(psi):
    """Return the line's pressure: the rod that comes out draws oil from the vessels, whose gas grows by as much."""
    return plane.isothermal_pressure(VESSELS, plane.gas_of(VESSELS, CHARGE) + (long(psi) - long(0.0)) * AREA)


def pushes(psi, speed=0.0, seals=0):
    """Return the thrusts of cylinder, damper and bump stop; `seals` 1 where the angle grows, -1 where it falls."""
    lever = plane.stretch(places, [psi], "A", "B")
    cylinder = (line_pressure(psi) - seals * np.sign(lever) * SEALS) * AREA
    return cylinder, -C_DAMPER * lever * speed, STOP * max(STOP_LENGTH - long(psi), 0.0)


def at_B(psi, push):
    """Return a thrust as a load on the wishbone."""
    p = places([psi])
    return ("B", push * plane.toward(p["A"], p["B"]))


def held(psi, loads=LOADS, **moving):
    """Return the ground's reaction by virtual work."""
    loads = [*loads, at_B(psi, sum(pushes(psi, **moving)))]
    return -plane.work(places, [psi], loads) / plane.rate(places, [psi])["W"][1]


def cut(psi, ground, sense=0, rub=lambda pin: 0.0, speed=0.0, seals=0):
    """Return the free bodies' forces with a known ground reaction; the cylinder's thrust known, its friction's moments at A and B."""
    p, moved, bodies = places([psi]), plane.rate(places, [psi]), FreeBodies()
    bodies.pin("O", "arm", "frame", p["O"])
    bodies.torque("M", "arm", "frame")
    cylinder, damper, bump = pushes(psi, speed, seals)
    away = plane.toward(p["A"], p["B"])
    AB = p["B"] - p["A"]
    strut = (AB[0] * moved["B"][1] - AB[1] * moved["B"][0]) / (AB @ AB)
    moments = {"O": -sense * rub("O"), "A": -sense * np.sign(strut) * rub("A"), "B": -sense * np.sign(1.0 - strut) * rub("B")}
    across = (moments["A"] - moments["B"]) / plane.length(p["A"], p["B"])  # what keeps the rubbing cylinder from turning
    bodies.load("arm", p["B"], cylinder * away + across * plane.left(away), moments["B"])
    bodies.load("arm", p["B"], (damper + bump) * away)
    bodies.load("arm", p["O"], (0.0, 0.0), moments["O"])
    for name, force in (*LOADS, ("W", (0.0, ground))):
        bodies.load("arm", p[name], force)
    found = bodies.solve()
    end = cylinder * away + across * plane.left(away)
    return found | {"Ax": end[0], "Ay": end[1], "Bx": end[0], "By": end[1]}


def test_positions_and_gas():
    motion = Axle().at(psi=ANGLES)
    want = np.array([line_pressure(psi) for psi in ANGLES])
    for k, psi in enumerate(ANGLES):
        assert_allclose(motion["B"][:, k], places([psi])["B"], atol=1e-14)
        assert_allclose(motion["W"][:, k], places([psi])["W"], atol=1e-14)
    assert_allclose(Axle.gas.pressure(motion), want, rtol=1e-11)
    assert_allclose(Axle.strut.pressure(motion), want, rtol=1e-11)
    assert_allclose(Axle.strut.thrust(motion), want * AREA, rtol=1e-11)
    assert want[0] < 85 * bar < want[2]  # the second vessel is empty where the wheel hangs


def test_thrusts_of_three_elements_on_two_points():
    motion = Axle().at(psi=ANGLES)
    for speed, rates in ((0.0, None), (SPEED, {"psi": SPEED})):
        forces = pin_forces(motion, rates=rates)
        want = np.array([pushes(psi, speed) for psi in ANGLES]).T
        for name, values in zip(("strut", "damper", "bump"), want, strict=True):
            assert_allclose(forces.thrusts[name], values, rtol=1e-10, atol=1e-9)
            for k, psi in enumerate(ANGLES):
                p = places([psi])
                away = plane.toward(p["A"], p["B"])
                assert_allclose(forces.force("A", on=name)[:, k], values[k] * away, rtol=1e-9, atol=1e-8)
                assert_allclose(forces.force("B", on=name)[:, k], -values[k] * away, rtol=1e-9, atol=1e-8)
    assert want[2].max() > 0.0


@pytest.mark.parametrize("case", [None, "uphill"])
def test_wheel_load(case):
    """The ground carries what gas, bump stop and weights leave."""
    motion = Axle().at(psi=ANGLES)
    turn = 15 * deg if case else 0.0
    loads = [(name, -force[1] * np.array([-np.sin(turn), -np.cos(turn)])) for name, force in LOADS]
    assert_allclose(reaction(motion, support="ground", case=case), [held(psi, loads) for psi in ANGLES], rtol=1e-10)


def test_wheel_load_on_a_moving_axle():
    """The damper adds to the wheel's load as it rises; the given drive force takes off."""
    motion = Axle().at(psi=ANGLES)
    found = reaction(motion, support="ground", rates={"psi": SPEED})
    assert_allclose(found, [held(psi, speed=SPEED) for psi in ANGLES], rtol=1e-10)
    lifted = reaction(motion, support="ground", drive_force=700.0)
    lever = np.array([plane.rate(places, [psi])["W"][1] for psi in ANGLES])
    assert_allclose(lifted, np.array([held(psi) for psi in ANGLES]) - 700.0 / lever, rtol=1e-9)


@pytest.mark.parametrize(("direction", "seals"), [("extending", 1), ("retracting", -1)])
def test_seals_widen_the_wheel_load(direction, seals):
    motion = Axle().at(psi=ANGLES)
    want = np.array([held(psi, seals=seals) for psi in ANGLES])
    assert_allclose(reaction(motion, support="ground", direction=direction), want, rtol=1e-10)
    assert np.all((want - [held(psi) for psi in ANGLES]) * seals > 0)


def test_damper_and_seals_of_a_moving_axle():
    """With the rates the damper acts, with the direction the seals."""
    found = reaction(Axle().at(psi=ANGLES), support="ground", direction="extending", rates={"psi": SPEED})
    assert_allclose(found, [held(psi, speed=SPEED, seals=1) for psi in ANGLES], rtol=1e-10)


def test_hinge_with_and_without_the_ground():
    """The wishbone's own drive carries what no ground takes; with the ground's reaction it has nothing to do."""
    for psi in ANGLES:
        want = cut(psi, 0.0)
        motion = Axle().at(psi=psi)
        forces = pin_forces(motion)
        size = max(map(abs, want.values()))
        assert_allclose(forces.drives["psi"], want["M"], rtol=1e-9)
        assert_allclose(driving_force(motion), want["M"], rtol=1e-9)
        assert_allclose(forces.force("O", on="O W"), [want["Ox"], want["Oy"]], atol=1e-10 * size)
        ground = held(psi)
        standing = Axle(**{"ground.force": ground}).at(psi=psi)
        want, forces = cut(psi, ground), pin_forces(standing)
        assert_allclose(forces.force("O", on="O W"), [want["Ox"], want["Oy"]], atol=1e-10 * size)
        assert_allclose(forces.drives["psi"], 0.0, atol=1e-10 * size)
        frame = sum(force for force in forces.on_body("frame").values())
        assert_allclose(frame, [0.0, ground - (HUB + ARM) * plane.G], atol=1e-10 * size)


# -- friction at the pins of the gas-fed cylinder ----------------------------------------------------------


class DryEyes(Mechanism):
    """The wishbone with its gas-fed cylinder alone, the pins rubbing."""

    psi = Stroke(-14 * deg, 14 * deg)

    O = Ground(*FRAME_O)
    A = Ground(*FRAME_A)
    W = Crank(O, OW=OW, angle=psi)
    B = OnLink(O, W, OB=OB, WOB=WOB)

    wheel = Weight(W, mass=HUB)
    wishbone = Weight(B, mass=ARM)
    ground = Support(W, (0, 1))
    strut = Cylinder(A, B, bore=80 * mm, rod=50 * mm)
    gas = FloatCircuit(
        strut, AccumulatorBlock([Accumulator(volume, charge) for volume, charge in VESSELS], isothermal),
        charge_pressure=CHARGE, at=0.0, seal_friction=SEALS,
    )  # fmt: skip
    hinge = PinFriction(O, radius=25 * mm, coefficient=0.15)
    eye_A = PinFriction(A, radius=20 * mm, coefficient=0.20)
    eye_B = PinFriction(B, radius=20 * mm, coefficient=0.20)


RUB = {"O": 0.025 * 0.15, "A": 0.020 * 0.20, "B": 0.020 * 0.20}


@pytest.mark.parametrize(("direction", "sense"), [("extending", 1), ("retracting", -1)])
def test_friction_at_the_eyes_of_the_gas_fed_cylinder(direction, sense):
    motion = DryEyes().at(psi=ANGLES[:5])  # short of the bump stop
    forces = pin_forces(motion, direction=direction)
    for k, psi in enumerate(ANGLES[:5]):
        want = plane.rubbed(lambda size, psi=psi: cut(psi, 0.0, sense, lambda pin: RUB[pin] * size(pin), seals=sense), "OAB")
        size = max(map(abs, want.values()))
        assert_allclose(forces.drives["psi"][k], want["M"], rtol=1e-9)
        assert_allclose(forces.force("O", on="O W")[:, k], [want["Ox"], want["Oy"]], atol=1e-10 * size)
        assert_allclose(forces.force("A", on="strut")[:, k], [want["Ax"], want["Ay"]], atol=1e-10 * size)
        assert_allclose(forces.thrusts["strut"][k], pushes(psi, seals=sense)[0], rtol=1e-10)


# -- energy, a fast gas, an absent vessel ------------------------------------------------------------------


def test_gas_work_is_the_reactions_work():
    """The ground's work over a slow rise is what the gas takes up and the weights gain."""
    first, last = ANGLES[2], ANGLES[4]  # both vessels at work: smooth
    nodes, weights = np.polynomial.legendre.leggauss(30)
    psi = first + (nodes + 1) / 2 * (last - first)
    motion = Axle().at(psi=psi)
    rise = np.array([plane.rate(places, [each])["W"][1] for each in psi])
    work = np.sum(weights / 2 * (last - first) * reaction(motion, support="ground") * rise)
    volumes = [plane.gas_of(VESSELS, line_pressure(each)) for each in (first, last)]
    amount = (line_pressure(first) + 101325.0) * volumes[0]  # p V of the gas, both vessels at work
    gas = -amount * np.log(volumes[1] / volumes[0]) + 101325.0 * (volumes[1] - volumes[0])
    start, end = places([first]), places([last])
    lifted = -sum(np.dot(force, end[name] - start[name]) for name, force in LOADS)
    stop_work = STOP / 2 * (max(STOP_LENGTH - long(last), 0.0) ** 2 - max(STOP_LENGTH - long(first), 0.0) ** 2)
    assert_allclose(work, gas + lifted + stop_work, rtol=1e-10)


class Fast(DryEyes):
    """A pothole: the gas has no time to give off its heat."""

    gas = FloatCircuit(
        "strut", AccumulatorBlock([Accumulator(volume, charge) for volume, charge in VESSELS], isothermal),
        charge_pressure=CHARGE, at=0.0, exponent=1.35,
    )  # fmt: skip


def test_fast_gas():
    """Settled at the charge, both vessels then follow p V^n together."""
    psi = np.array([0.5, 2.0, 5.0]) * deg
    start = plane.gas_of(VESSELS, CHARGE)
    want = [(CHARGE + 101325.0) * (start / (start + (long(each) - long(0.0)) * AREA)) ** 1.35 - 101325.0 for each in psi]
    assert_allclose(Fast.strut.pressure(Fast().at(psi=psi)), want, rtol=1e-11)


class OneVessel(DryEyes):
    """The same block with the second vessel taken off: its volume is none."""

    gas = FloatCircuit(
        "strut", AccumulatorBlock([Accumulator(1.75e-3, 40 * bar), Accumulator(0.0, 85 * bar)], isothermal), charge_pressure=CHARGE, at=0.0,
    )  # fmt: skip


def test_absent_vessel():
    vessels = [(1.75e-3, 40 * bar)]
    want = [plane.isothermal_pressure(vessels, plane.gas_of(vessels, CHARGE) + (long(psi) - long(0.0)) * AREA) for psi in ANGLES]
    assert_allclose(OneVessel.strut.pressure(OneVessel().at(psi=ANGLES)), want, rtol=1e-11)


# -- verdicts ----------------------------------------------------------------------------------------------


def test_rod_under_the_gas():
    """The seals of a rod that goes in add to the gas."""
    motion = Axle().sweep(3)
    use, _ = plane.peak(lambda psi: (line_pressure(psi) + SEALS) * AREA / plane.critical(ROD, long(psi)), -14 * deg, 14 * deg)
    checks = {each.rule: each for each in Axle.strut.checks(motion)}
    assert bool(checks["buckling"]) == (use * 3.5 <= 1.0)
    assert_allclose(number("safety", checks["buckling"]), 1 / use, rtol=6e-3)
    assert bool(checks["length"]) == (long(14 * deg) >= 0.440 and long(-14 * deg) <= 0.640)


def test_both_sides_cannot_be_fed():
    """A gas block feeds one side: which one must be said."""
    with pytest.raises(DefinitionError, match="both"):

        class Wrong(DryEyes):
            strut = Cylinder("A", "B", bore=80 * mm, rod=50 * mm, works="both")

        Wrong.strut.pressure(Wrong().at(psi=0.0))


def test_oil_that_leaves_the_block():
    motion = Axle().at(psi=ANGLES)
    assert_allclose(Axle.gas.withdrawn(motion) / litre, [(long(psi) - long(0.0)) * AREA / litre for psi in ANGLES], atol=1e-14)
