"""Dry friction in pins, slots and guides against Coulomb's law written out for each body."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.optimize import root

from linkage import (
    LEFT,
    RIGHT,
    Crank,
    DefinitionError,
    Dyad,
    Force,
    Ground,
    Guide,
    GuideFriction,
    LinkMass,
    Mechanism,
    Moment,
    OnGuide,
    OnLink,
    PinFriction,
    PinSlotDyad,
    SingularError,
    SliderDyad,
    Stroke,
    Support,
    deg,
    driving_force,
    pin_forces,
    reaction,
)
from tests.for_all import for_all
from tests.mechanisms.free_bodies import G

WAYS = pytest.mark.parametrize(("direction", "s"), [("extending", 1), ("retracting", -1)])


def cross(a, b):
    return a[0] * b[1] - a[1] * b[0]


def solved(equations, guess):
    found = root(equations, guess, tol=1e-13)
    assert np.abs(equations(found.x)).max() < 1e-6
    return found.x


class Ladder(Mechanism):
    """Foot on the floor, head at the wall."""

    S = Stroke(0.5, 2.5)
    floor, wall = Guide((0, 0), angle=0), Guide((0, 0), angle=90 * deg)
    A = OnGuide(floor, at=S)
    B = SliderDyad(A, wall, AB=3, side=RIGHT)
    own = LinkMass("A B", mass=20)
    foot, head = GuideFriction(A, 0.2, guide=floor), GuideFriction(B, 0.3, guide=wall)


@WAYS
def test_ladder_rough_at_both_ends(direction, s):
    motion = Ladder().sweep(7)
    x, W = motion.strokes["S"], 20 * G
    wall = W * x / 2 / (np.sqrt(9 - x**2) + s * 0.3 * x)
    assert_allclose(driving_force(motion, direction=direction), s * 0.2 * (W - s * 0.3 * wall) - wall, rtol=1e-12)


class Bracket(Mechanism):
    """A sliding bracket on a post, held by two rollers 0.2 m apart, its load 0.5 m beside them: jams itself from 0.2 on."""

    S = Stroke(0, 1)
    post = Guide((0, 0), angle=90 * deg)
    P = OnGuide(post, at=S)
    Q = SliderDyad(P, post, PQ=0.2, side=RIGHT)
    T = OnLink(P, Q, PT=0.5, QPT=-90 * deg)
    load = Force(T, (0, -1000))


@for_all("coefficient", [0.1, 0.19, 0.21])
@WAYS
def test_bracket_on_its_post(coefficient, direction, s):
    """2 mu a / b against 1 (Meriam, Kraige, Statics, chapter 6): at 0.2 it stays where it is."""
    motion, loads = Bracket().sweep(3), ["load", GuideFriction("P", coefficient), GuideFriction("Q", coefficient)]
    assert_allclose(driving_force(motion, loads, direction=direction), 1000 * (1 + s * 2 * coefficient * 0.5 / 0.2), rtol=1e-11)
    held = any("friction holds the load" in words for words in pin_forces(motion, loads, direction=direction).remarks)
    assert held is (coefficient > 0.2 and s < 0)


class BellCrank(Mechanism):
    """A bell crank in a plain bearing."""

    S = Stroke(0, 0.001)
    O, K = Ground(0, 0), Ground(-0.1, -0.4)
    A = Dyad(K, O, KA=0.4 + S, OA=0.1, side=LEFT)
    B = OnLink(O, A, OB=0.3, AOB=90 * deg)
    pull, bearing = Force(B, (-500, 0)), PinFriction(O, radius=0.03, coefficient=0.15)


@WAYS
def test_friction_circle_of_a_bell_crank(direction, s):
    """The bearing's force passes at mu r from the centre: 0.1 T = 150 -+ mu r sqrt(T2 + 500 2)."""
    force = float(driving_force(BellCrank().at(S=0.0), direction=direction))
    assert_allclose(-0.1 * force - 0.3 * 500 + s * 0.15 * 0.03 * np.hypot(force, 500), 0.0, atol=1e-10)


class Piston(Mechanism):
    """A slider-crank that rubs in all its pins and on its guide; the gas pushes at the piston."""

    phi = Stroke(20 * deg, 160 * deg)
    O, line = Ground(0, 0), Guide((0, 0), angle=0)
    A = Crank(O, OA=0.05, angle=phi)
    B = SliderDyad(A, line, AB=0.20, side=RIGHT)
    gas, guide = Force(B, (-10e3, 0)), GuideFriction(B, 0.1)
    main, crank, gudgeon = (PinFriction(pin, radius=0.02, coefficient=0.1) for pin in (O, A, B))


@WAYS
def test_slider_crank_rubs_everywhere(direction, s):
    motion, want = Piston().sweep(8), []
    for phi, A, B in zip(motion.strokes["phi"], motion["A"].T, motion["B"].T, strict=True):
        rod = -s * A[0] / (B[0] - A[0])  # its turning
        slides = np.sign(-s * A[1] + rod * A[1])

        def equations(u, A=A, B=B, rod=rod, slides=slides):
            Q, P, N, O, T = u[0:2], u[2:4], u[4], u[5:7], u[7]  # on the rod from crank and piston, guide, bearing, torque
            crank, gudgeon, main = (-0.002 * np.hypot(*F) * np.sign(w) for F, w in ((Q, rod - s), (P, rod), (O, s)))
            return [*(Q + P), cross(B - A, P) + crank + gudgeon, -P[0] - 10e3 - 0.1 * abs(N) * slides, N - P[1],
                    *(O - Q), T - cross(A, Q) - crank + main]  # fmt: skip

        want.append(solved(equations, [10e3, 100, -10e3, -100, -100, 10e3, 100, 0.05 * np.sin(phi) * -10e3])[7])
    assert_allclose(driving_force(motion, direction=direction), want, rtol=1e-8)
    assert {(each.on, each.by) for each in pin_forces(motion).at("B")} == {("AB", "B (slider)"), ("B (slider)", "frame")}


class Shaper(Mechanism):
    """A crank whose block slides in a lever, rubbing in the slot and on the crank's pin."""

    phi = Stroke(10 * deg, 170 * deg)
    O, Q = Ground(0, 0), Ground(0, -0.3)
    A = Crank(O, OA=0.1, angle=phi)
    X = PinSlotDyad(Q, A, QX=0.55)
    cut, slot, pin = Moment("Q X", M=-150), GuideFriction(A, 0.12), PinFriction(A, radius=0.015, coefficient=0.12)


@WAYS
def test_block_of_a_shaper_turns_with_its_lever(direction, s):
    motion, want = Shaper().sweep(8), []
    for A in motion["A"].T:
        q = A - (0, -0.3)
        t = q / np.hypot(*q)
        n, v = np.array([-t[1], t[0]]), s * np.array([-A[1], A[0]])

        def equations(u, A=A, q=q, t=t, n=n, v=v):
            N, T = u  # on the block from the lever, on the crank
            F = N * n - 0.12 * abs(N) * np.sign(v @ t) * t
            pin = -0.0018 * np.hypot(*F) * np.sign(s - cross(q, v) / (q @ q))
            return [cross(A, F) + pin + T, -cross(q, F) - pin - 150]

        want.append(solved(equations, [-150 / np.hypot(*q), 0.0])[1])
    assert_allclose(driving_force(motion, direction=direction), want, rtol=1e-9)


def test_pin_of_a_driven_slide_names_the_remedy():
    with pytest.raises(DefinitionError, match=r"no pin joint at A.*declare the block that slides there as a body"):
        pin_forces(Ladder().sweep(3), [PinFriction("A", 0.01, 0.1)], direction="extending")


class Floating(Mechanism):
    """A header's arm on a cylinder of known thrust, its shoe on the ground."""

    S = Stroke(0, 0.3)
    O, K = Ground(0, 1), Ground(0.2, 0.4)
    B = Dyad(K, O, KB=0.6 + S, OB=0.9, side=RIGHT)
    R = OnLink(O, B, OR=1.8, BOR=-20 * deg)
    own, shoe = LinkMass("O B R", mass=300), Support(R, (0, 1))
    bearing = PinFriction(O, radius=0.05, coefficient=0.2)


@WAYS
def test_shoe_feels_the_bearings_friction(direction, s):
    motion, want = Floating().sweep(4), []
    for B, R in zip(motion["B"].T, motion["R"].T, strict=True):
        push = 2000 * (B - (0.2, 0.4)) / np.hypot(*(B - (0.2, 0.4)))
        arms, weight = (B - (0, 1), R - (0, 1)), np.array([0, -300 * G])

        def moment(u, push=push, arms=arms, weight=weight):
            bearing = np.hypot(*(push + weight + (0, u[0])))
            return [cross(arms[0], push) + cross((arms[0] + arms[1]) / 3, weight) + arms[1][0] * u[0] - s * 0.01 * bearing]

        want.append(solved(moment, [700.0])[0])
    assert_allclose(reaction(motion, drive_force=2000, direction=direction), want, rtol=1e-10)


def test_steep_ladder_that_rubs_too_much_locks():
    """Pulled in, with 1.5 at its head alone, it jams where its height is under 1.5 times its reach."""
    loads = ["own", GuideFriction("B", 1.5)]
    motion = Ladder().sweep(5, unreachable="nan")
    forces = pin_forces(motion, loads, direction="retracting")
    x = motion.strokes["S"]
    assert np.array_equal(forces.locked, np.sqrt(9 - x**2) < 1.5 * x)
    with pytest.raises(SingularError, match="locks itself while retracting at 2 of 5"):
        pin_forces(Ladder().sweep(5), loads, direction="retracting")
