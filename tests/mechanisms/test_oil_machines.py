"""The machines whose cylinders oil joins, through every door of the machines at work and by hand."""

from inspect import unwrap

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import pin_forces, reaction
from mechanisms.at_work.axle import Axle, CrossedAxle
from mechanisms.at_work.levelled import LevelledTelehandler
from tests.for_all import for_all
from tests.machines import plane
from tests.mechanisms import test_at_work as at_work
from tests.mechanisms.test_at_work import DRAWN, A, O, telehandler

DOORS = (
    at_work.test_no_verdict_fails, at_work.test_files_and_pickles_hold_it_whole, at_work.test_a_part_is_read_in_its_own_names,
    at_work.test_forces_are_in_equilibrium_and_equations_are_there,
)  # fmt: skip


@for_all("door", DOORS[1:], slow=DOORS[:1], ids=lambda door: door.__name__)
@for_all("machine", [Axle], slow=[LevelledTelehandler, CrossedAxle])
def test_they_go_through_every_door(machine, door):
    unwrap(door)(machine)


# -- the telehandler that oil levels -------------------------------------------------------------------------


def levelled(q):
    """Return every place by the boom's angle, how far it is drawn out and what a valve adds to the forks' cylinder.

    What the master loses in length that cylinder gains.
    """
    up, out, added = q

    def K(up):
        return O + 0.28 * plane.turned((1.0, 0.0), up + np.radians(141))

    D, found = np.array([-3.20, 0.75]), telehandler((up, out, 0.0))
    begun = boom_angle(1.19)
    slave = 0.916 + added + plane.length(D, K(begun)) - plane.length(D, K(up))
    found |= {"D": D, "K": K(up), "W": plane.meet(found["Q"], slave, found["N"], 0.28, plane.LEFT)}
    tilt = np.radians(-92.0)
    for name, (x, y, _) in DRAWN.items():
        found[name] = found["N"] + plane.turned(plane.toward(found["N"], found["W"]) * np.hypot(x, y), tilt + np.arctan2(y, x))
    return found


def boom_angle(ram):
    """Return the boom's angle by the length of its cylinder AB, by the cosine rule in AOB."""
    fixed = plane.length(O, A)
    return np.arctan2(A[1] - O[1], A[0] - O[0]) + np.arccos((fixed**2 + 1.70**2 - ram**2) / (2 * fixed * 1.70))


@pytest.mark.parametrize(("lift", "out", "added"), [(0.1, 0.0, 0.0), (0.45, 1.2, 0.04), (0.8, 2.7, -0.03)])
def test_the_levelled_forks_and_what_holds_them_by_hand(lift, out, added):
    q = np.array([boom_angle(1.19 + lift), out, added])
    p, motion = levelled(q), LevelledTelehandler().at(lift=lift, extend=out, tilt=added)
    for name in "BTQNKW":
        assert_allclose(motion[name], p[name], atol=1e-12)
    masses = {"outer": 700.0, "inner": 450.0} | {name: mass for name, (_, _, mass) in DRAWN.items()}
    loads = [(name, (0.0, -mass * plane.G)) for name, mass in masses.items()]
    found = [LevelledTelehandler.plan.members[name].thrust(motion) for name in ("ram", "push")]
    want = plane.balance(lambda two: levelled((*two, added)), q[:2], loads, [("A", "B"), ("R", "T")])
    assert_allclose(found, want, rtol=1e-8)
    pull, arm = plane.toward(p["Q"], p["W"]), p["W"] - p["N"]
    moment = -plane.G * sum(mass * (p[name] - p["N"])[0] for name, (_, _, mass) in DRAWN.items())
    slave = -moment / (arm[0] * pull[1] - arm[1] * pull[0])
    thrusts = [LevelledTelehandler.plan.members[name].thrust(motion) for name in ("slave", "master")]
    assert_allclose(thrusts, [slave, slave], rtol=1e-9)  # one ratio, of areas that are equal
    assert slave < 0.0 and LevelledTelehandler.outward.pressure(motion) == 0.0
    assert_allclose(LevelledTelehandler.inward.pressure(motion), -slave / (np.pi / 4 * (0.125**2 - 0.070**2)), rtol=1e-9)
    forces = pin_forces(motion)  # lines of oil give the other length, so that the ram alone holds the boom and no gears do
    assert forces.remarks == () and not [each for each in forces.joints if "AB" in (each.on, each.by)]


def test_the_forks_stay_level_over_the_whole_stroke():
    motion = LevelledTelehandler().at(lift=np.linspace(0.0, 0.86, 50)[:, None], extend=np.linspace(0.0, 3.0, 3), tilt=0.0)
    assert np.degrees(np.max(np.abs(motion["level"]))) < 0.5
    assert np.ptp(np.degrees(motion["level"]), axis=1).max() < 1e-9


# -- the axle ------------------------------------------------------------------------------------------------


def suspension(q):
    """Return the places of the right wheel by how far its strut is pressed in."""
    O, P, A = np.array([0.25, 0.55]), np.array([0.32, 0.85]), np.array([0.50, 1.15])
    B = plane.meet(A, 0.62 - q[0], O, 0.40, plane.LEFT)
    W = plane.on(O, B, 0.66)
    V = plane.meet(W, 0.30, P, 0.57, plane.RIGHT)
    T = W + plane.turned(plane.toward(W, V) * 0.572, np.radians(-164))
    return {"A": A, "B": B, "W": W, "V": V, "T": T, "hub": 0.5 * (W + V)}


def gas(vessel, charge, pressure, pushed_in):
    """Return the gauge pressure of isothermal gas after oil was pushed in."""
    air = 101325.0
    left = vessel * (charge + air) / (pressure + air)
    return (pressure + air) * left / (left - pushed_in) - air


PISTON, ANNULUS = np.pi / 4 * 0.080**2, np.pi / 4 * (0.080**2 - 0.063**2)


@for_all("machine", [Axle, CrossedAxle])
@for_all("way", [(0.06, 0.06), (-0.08, -0.08), (0.05, -0.05), (0.02, -0.07)])
def test_the_struts_and_the_wheels_by_hand(machine, way):
    right, left = way
    if machine is Axle:
        both = gas(4e-3, 35e5, 64e5, PISTON * (right + left))
        thrusts = [both * PISTON] * 2
    else:
        near, far = (gas(2e-3, 60e5, 103.2e5, PISTON * one - ANNULUS * other) for one, other in (way, way[::-1]))
        thrusts = [near * PISTON - far * ANNULUS, far * PISTON - near * ANNULUS]
    motion = machine().at(right_in=right, left_in=left)
    for name, q, thrust in zip(("right", "left"), way, thrusts, strict=True):
        assert_allclose(machine.plan.members[f"{name}.strut"].thrust(motion), thrust, rtol=1e-10)
        rates = plane.rate(suspension, [q])
        assert_allclose(motion[f"{name}.T"], suspension([q])["T"] * [1.0 if name == "right" else -1.0, 1.0], atol=1e-12)
        wheel = (thrust + 90.0 * plane.G * rates["hub"][1]) / rates["T"][1]
        assert_allclose(reaction(motion, support=f"{name}.wheel", drive=f"{name}_in"), wheel, rtol=1e-9)


def test_an_axle_on_one_block_does_not_resist_rolling_and_a_crossed_one_does():
    roll = dict(right_in=[-0.05, 0.05], left_in=[0.05, -0.05])
    assert_allclose(Axle.line.pressure(Axle().at(**roll)), [64e5, 64e5], rtol=1e-12)
    loads = [reaction(CrossedAxle().at(**roll), support=f"{side}.wheel", drive=f"{side}_in") for side in ("right", "left")]
    assert_allclose(loads[0], loads[1][::-1])
    assert loads[0][1] > 4.0 * loads[0][0]
