"""A double wishbone suspension: coil, damper and bump stop between the chassis and the lower arm, a wheel on the ground."""

import numpy as np
from numpy.testing import assert_allclose

from linkage import (
    RIGHT,
    Between,
    Crank,
    Damper,
    Dyad,
    Force,
    Ground,
    LinkMass,
    Mechanism,
    OnLink,
    Spring,
    Stroke,
    Support,
    Weight,
    angle,
    deg,
    driving_force,
    kN,
    pin_forces,
    reaction,
)
from tests.machines.machines_b_truth import G, beside, cross, meet, over, polar, power, size, slopes, stretch, unit, weight
from tests.mechanisms.free_bodies import FreeBodies


def bump(length, rate):
    """Return the push of the rubber stop [N]: it touches from 0.41 m on and gets stiffer."""
    squeezed = np.maximum(0.41 - length, 0.0)
    return 90e3 * squeezed + 4e6 * squeezed**2


class Wishbone(Mechanism):
    """Lower arm ABM, upper arm DC, upright BCW with the tyre's contact P; x outwards, y up, the chassis is the frame."""

    phi = Stroke(-14 * deg, 18 * deg)                     # lower arm, from the horizontal

    A = Ground(0.30, 0.20)
    D = Ground(0.38, 0.46)
    T = Ground(0.44, 0.66)                                # the strut's top

    B = Crank(A, AB=0.38, angle=phi)
    M = OnLink(A, B, AM=0.262, BAM=6.5 * deg)             # the strut's foot
    C = Dyad(B, D, BC=0.279, DC=0.276, side=RIGHT)
    W = OnLink(B, C, BW=0.144, CBW=-38 * deg)             # the wheel's centre
    P = OnLink(B, C, BP=0.215, CBP=-157 * deg)            # where the tyre stands
    camber = angle(B, C) - 95 * deg

    lower = LinkMass("A B", mass=4.5, at=(0.17, 0.01))
    upper = LinkMass("D C", mass=2.6)
    wheel = Weight(W, mass=38)
    coil = Spring(T, M, stiffness=38e3, free_length=0.56)
    damper = Damper(T, M, coefficient=2200)
    stop = Between(T, M, bump)
    ground = Support(P, (0, 1))
    cornering = Force(P, (-1.8 * kN, 0))


def place(phi):
    A, D, T = np.array([0.30, 0.20]), np.array([0.38, 0.46]), np.array([0.44, 0.66])
    B = A + polar(0.38, phi)
    M = A + polar(0.262, phi + 6.5 * deg)
    C = meet(B, 0.279, D, 0.276, left=False)
    W, P = beside(B, C, 0.144, -38 * deg), beside(B, C, 0.215, -157 * deg)
    own = A + polar(0.17, phi) + polar(0.01, phi + np.pi / 2)
    return {"A": A, "D": D, "T": T, "B": B, "M": M, "C": C, "W": W, "P": P, "own": own, "mid": (D + C) / 2}


def strut(phi, speed):
    """Return the thrusts of coil, damper and stop [N]."""
    at, slope = place(phi), slopes(place, "phi", phi=phi)
    long, squeezed = size(at["M"] - at["T"]), max(0.41 - size(at["M"] - at["T"]), 0.0)
    damper = -2200 * stretch(at, slope, "T", "M") * speed
    return {"coil": 38e3 * (0.56 - long), "damper": damper, "stop": 90e3 * squeezed + 4e6 * squeezed**2}


def truth(phi, speed):
    """Return the wheel's load, the thrusts and the pin forces at one pose, by free bodies, and the load by virtual work."""
    at, slope, thrust = place(phi), slopes(place, "phi", phi=phi), strut(phi, speed)
    push = sum(thrust.values())
    free = FreeBodies()
    free.pin("A", "lower", "frame", at["A"])
    free.pin("B", "upright", "lower", at["B"])
    free.pin("C", "upper", "upright", at["C"])
    free.pin("D", "upper", "frame", at["D"])
    free.along("P", "upright", "frame", at["P"], (0, 1))
    free.load("lower", at["M"], push * unit(at["T"], at["M"]))
    free.load("lower", at["own"], weight(4.5))
    free.load("upper", at["mid"], weight(2.6))
    free.load("upright", at["W"], weight(38))
    free.load("upright", at["P"], (-1800.0, 0.0))
    found = free.solve()
    known = [("own", weight(4.5)), ("mid", weight(2.6)), ("W", weight(38)), ("P", (-1800.0, 0.0))]
    by_work = -(power(slope, known) + push * stretch(at, slope, "T", "M")) / slope["P"][1]
    pins = {name: np.array([found[f"{name}x"], found[f"{name}y"]]) for name in "ABCD"}
    return {**pins, **thrust, "load": found["P"], "by_work": by_work, "u": unit(at["T"], at["M"])}


def test_where_everything_is():
    motion = Wishbone().sweep(9)
    own = over(motion.strokes, place)
    for name in "BMCWP":
        assert_allclose(motion[name], own[name], rtol=0, atol=1e-14)
    assert Wishbone().mobility == 1


def test_the_wheel_carries_what_the_strut_gives():
    motion = Wishbone().sweep(9)
    own = over(motion.strokes, lambda phi: truth(phi, 0.0))
    assert (own["stop"] > 0).any() and (own["stop"] == 0).any()
    assert_allclose(own["load"], own["by_work"], rtol=1e-12)
    assert_allclose(reaction(motion), own["load"], rtol=1e-11)


def test_the_damper_acts_where_there_is_a_speed():
    motion = Wishbone().sweep(9)
    for speed in (2.5, -2.5):
        own = over(motion.strokes, lambda phi, speed=speed: truth(phi, speed))
        assert_allclose(reaction(motion, rates=dict(phi=speed)), own["load"], rtol=1e-11)
        moving = driving_force(motion, rates=dict(phi=speed)) - driving_force(motion)
        arm = over(motion.strokes, lambda phi: {"TM": stretch(place(phi), slopes(place, "phi", phi=phi), "T", "M")})["TM"]
        assert_allclose(moving, 2200 * arm**2 * speed, rtol=1e-10)      # what turns the arm works against the damper


def test_a_direction_alone_is_no_speed():
    motion = Wishbone().sweep(5)
    for direction in ("extending", "retracting"):
        assert_allclose(pin_forces(motion, direction=direction).thrusts["damper"], 0.0, atol=1e-12)
        assert_allclose(driving_force(motion, direction=direction), driving_force(motion), rtol=1e-13)


def test_every_pin_and_the_three_that_share_the_struts_two():
    motion = Wishbone().sweep(9)
    speed = 2.5
    own = over(motion.strokes, lambda phi: truth(phi, speed))
    loads = ["lower", "upper", "wheel", "coil", "damper", "stop", "cornering", Support("P", (0, 1), force=own["load"])]
    forces = pin_forces(motion, loads, rates=dict(phi=speed))
    largest = np.abs(own["B"]).max()
    assert_allclose(forces.force("B", on="BCWP"), own["B"], rtol=0, atol=1e-11 * largest)
    assert_allclose(forces.force("B", on="ABM"), -own["B"], rtol=0, atol=1e-11 * largest)
    assert_allclose(forces.force("C", on="DC"), own["C"], rtol=0, atol=1e-11 * largest)
    assert_allclose(forces.force("D", on="DC"), own["D"], rtol=0, atol=1e-11 * largest)
    assert_allclose(forces.force("A", on="ABM"), own["A"], rtol=0, atol=1e-11 * largest)
    assert_allclose(forces.drives["phi"], 0.0, atol=1e-11 * largest)      # the wheel's load holds the arm, nothing is left for the crank
    for name in ("coil", "damper", "stop"):
        assert_allclose(forces.thrusts[name], own[name], rtol=1e-11, atol=1e-9)
        assert_allclose(forces.force("M", on=name), -own[name] * own["u"], rtol=1e-11, atol=1e-9)     # from the arm, which it pushes down
        assert_allclose(forces.force("T", on=name), own[name] * own["u"], rtol=1e-11, atol=1e-9)
    assert {each.on for each in forces.at("M")} | {each.by for each in forces.at("M")} >= {"coil", "damper", "stop", "ABM"}
    assert forces.residual < 1e-12
    down = G * (4.5 + 2.6 + 38)
    frame = sum(forces.on_body("frame").values())                         # the frame's pins carry what the loads give
    assert_allclose(frame, np.stack([np.full(9, -1800.0), own["load"] - down]), rtol=0, atol=1e-11 * largest)


def test_a_spring_replaced_by_its_force_changes_no_pin():
    """Three elements on two points, or their sum as one: the arms cannot tell."""
    motion = Wishbone().sweep(9)
    own = over(motion.strokes, lambda phi: truth(phi, 0.0))
    together = Between("T", "M", lambda length, rate: 38e3 * (0.56 - length) + bump(length, rate))
    rest = ["lower", "upper", "wheel", "cornering"]
    apart, joined = pin_forces(motion, [*rest, "coil", "stop"]), pin_forces(motion, [*rest, together])
    for name, body in zip("ABCD", ("ABM", "BCWP", "DC", "DC"), strict=True):
        assert_allclose(joined.force(name, on=body), apart.force(name, on=body), rtol=1e-12, atol=1e-8)
    assert cross(own["u"][:, 0], own["u"][:, -1]) != 0.0
