"""Published positions, velocities and accelerations, and the loops closed by hand.

Norton: R. L. Norton, Design of Machinery. Meriam: J. L. Meriam, L. G. Kraige, Engineering Mechanics, Dynamics.
"""

import numpy as np
from numpy.testing import assert_allclose

from linkage import (
    LEFT,
    RIGHT,
    Crank,
    Dyad,
    Ground,
    Guide,
    GuideCross,
    Link,
    Mechanism,
    OnGuide,
    OnLink,
    Pin,
    PinSlotDyad,
    Slide,
    SliderDyad,
    Stroke,
    angle,
    deg,
    drawn,
)
from tests.for_all import for_all
from tests.mechanisms.free_bodies import closed, slope

TURN = 2 * np.pi


def principal(turned):
    return (np.degrees(turned) + 180.0) % 360.0 - 180.0


class FourBar(Mechanism):
    """Norton's letters: a = OA, b = AB, c = CB."""

    phi = Stroke(0, TURN)
    O, C = Ground(0, 0), Ground(100, 0)
    A = Crank(O, OA=40, angle=phi)
    B = Dyad(A, C, AB=120, CB=80, side=LEFT)
    theta3, theta4 = angle(A, B), angle(C, B)


class Crossed(FourBar):
    """The crossed circuit."""

    B = Dyad("A", "C", AB=120, CB=80, side=RIGHT)


# -- four-bars ------------------------------------------------------------------------------------------------


@for_all(
    ("d", "a", "b", "c", "theta2", "opened", "crossed"),
    [
        (6, 2, 7, 9, 30, (88.8, 117.3), (-115.2, -143.7)),
        (8, 5, 8, 6, 75, (7.5, 78.2), (-79.0, -149.7)),
        (4, 5, 2, 5, 80, (-1.5, 103.1), (-113.5, 141.8)),
        (4, 6, 10, 7, 88, (-13.3, 31.9), (-102.1, -147.3)),
        (9, 7, 11, 8, 50, (-3.5, 35.9), (-96.5, -135.9)),
    ],
)
def test_nortons_table(d, a, b, c, theta2, opened, crossed):
    """Problems 4-6 and 4-7, rows a, e, i, k, m, to the tenth of a degree printed in the answers."""
    for kind, printed in ((FourBar, opened), (Crossed, crossed)):
        pose = kind(C=(d, 0), OA=a, AB=b, CB=c).at(phi=theta2 * deg)
        assert_allclose(principal([pose["theta3"], pose["theta4"]]), printed, rtol=0, atol=0.06)
        u, v = float(pose["theta3"]), float(pose["theta4"])
        assert_allclose(a * np.exp(1j * theta2 * deg) + b * np.exp(1j * u), d + c * np.exp(1j * v), rtol=0, atol=1e-12)


def test_nortons_velocities_and_accelerations():
    """Examples 6-7 and 7-1: crank at 40 deg, 25 rad/s and 15 rad/s2; printed to three decimals."""
    pose = FourBar().at(phi=40 * deg)
    rates, turned = dict(phi=25.0), ("theta3", "theta4")
    assert_allclose([pose.velocity(name, rates) for name in turned], [-4.121, 6.998], atol=5e-4)
    assert_allclose([pose.acceleration(name, rates, dict(phi=15.0)) for name in turned], [296.089, 470.134], atol=6e-4)
    loop = lambda t: closed(  # noqa: E731
        lambda x: [40 * np.cos(t) + 120 * np.cos(x[0]) - 100 - 80 * np.cos(x[1]), 40 * np.sin(t) + 120 * np.sin(x[0]) - 80 * np.sin(x[1])],
        (0.35, 1.0),
    )
    assert_allclose([pose.ratio(name) for name in turned], slope(loop, 40 * deg), rtol=1e-10)


def test_toggles_of_a_triple_rocker():
    """Norton (4.37): cos theta2 = (a2 + d2 - b2 - c2) / 2ad +- bc / ad at the toggle; here only one sign gives a real angle."""
    a, b, c, d = 0.30, 0.35, 0.25, 0.70
    limits = FourBar(OA=a, AB=b, CB=c, C=(d, 0)).at(phi=20 * deg).limits()
    toggle = np.arccos((a**2 + d**2 - b**2 - c**2) / (2 * a * d) - b * c / (a * d))
    assert f"{np.degrees(toggle):.6f}" == "58.411864"
    assert_allclose([value for value, step in limits["phi"].dead_points if step == "B"], [toggle, 2.0 * np.pi - toggle], atol=1e-9)
    assert "58.4119: dead point of B" in str(limits)


class GearedFiveBar(Mechanism):
    """Both cranks on gears: theta5 = 2 theta2 + 30 deg."""

    phi = Stroke(0, TURN)
    O, Q = Ground(0, 0), Ground(6, 0)
    A = Crank(O, OA=1, angle=phi)
    C = Crank(Q, QC=4, angle=2 * phi + 30 * deg)
    B = Dyad(A, C, AB=7, CB=9, side=LEFT)
    theta3, theta4 = angle(A, B), angle(C, B)


def test_nortons_geared_five_bar():
    """Norton's example of chapter 4: theta2 = 60 deg, gear ratio 2, phase 30 deg; both circuits printed."""
    pose = GearedFiveBar().at(phi=60 * deg)
    assert_allclose(principal([pose["theta3"], pose["theta4"]]), [173.642, -177.715], atol=6e-4)
    other = next(mode for mode in GearedFiveBar().assemblies(phi=60 * deg) if mode.sides["B"] is RIGHT).places
    turned = [np.arctan2(*np.subtract(other["B"], other[end])[::-1]) for end in "AC"]
    assert_allclose(np.degrees(turned), [-115.407, -124.050], atol=6e-4)


# -- slots and sliders ----------------------------------------------------------------------------------------


class Inverted(Mechanism):
    """Norton's inverted slider-crank: the block's line keeps the distance 4 from O4."""

    phi = Stroke(0, TURN)
    O, C = Ground(0, 0), Ground(6, 0)
    A = Crank(O, OA=2, angle=phi)
    X = PinSlotDyad(C, A, CX=10, offset=4, side=LEFT)


class InvertedCrossed(Inverted):
    """The crossed circuit."""

    X = PinSlotDyad("C", "A", CX=10, offset=4, side=RIGHT)


class InvertedParts(Mechanism):
    """The same as links and pins: a bent lever with a slot through B and E."""

    phi = Stroke(0, TURN)
    sketch = drawn(phi=30 * deg)
    O, C = Ground(0, 0), Ground(6, 0)
    A = Crank(O, OA=2, angle=phi)
    B, E = Pin(near=(2.8, 2.4)), Pin(near=(1.0, 0.2))
    lever = Link("C B E", CB=4, BE=3, CBE=90 * deg)
    slot = Guide(B, E)
    block = Slide(A, slot)


def test_nortons_inverted_slider_crank():
    """Example 4-3: gamma 90 deg, theta2 30 deg: theta4 = 142.667 deg, R_B = 1.793; crossed -169.041 deg."""
    steps, parts = Inverted().at(phi=30 * deg), InvertedParts().at(phi=30 * deg)
    theta4 = float(parts.angle("C", "B"))
    assert f"{np.degrees(theta4):.3f}" == "142.667"
    assert f"{float(parts.distance('A', 'B')):.3f}" == "1.793"
    assert_allclose(principal(steps.angle("C", "X") + np.pi / 2), np.degrees(theta4), rtol=1e-13)
    assert_allclose(parts.ratio(angle("C", "B")), steps.ratio(angle("C", "X")), rtol=1e-12)
    crossed = InvertedCrossed().at(phi=30 * deg)
    assert f"{float(principal(crossed.angle('C', 'X') + np.pi / 2)):.3f}" == "-169.041"


class Connected(Mechanism):
    """Crank CB, link BA, rocker OA."""

    turn = Stroke(150 * deg, 200 * deg)
    O, C = Ground(0, 0), Ground(0.250, 0.050)
    B = Crank(C, CB=0.075, angle=turn)
    A = Dyad(O, B, OA=0.100, BA=np.hypot(0.175, 0.050), side=LEFT)


def test_meriams_oscillating_crank():
    """Sample problems 5/8 and 5/14, CB at 2 rad/s: -6/7 and -3/7 rad/s; -0.1050 and -4.34 rad/s2."""
    pose, rates = Connected().at(turn=np.pi), dict(turn=2.0)
    AB, OA = angle("B", "A"), angle("O", "A")
    assert_allclose([pose.velocity(AB, rates), pose.velocity(OA, rates)], [-6 / 7, -3 / 7], rtol=1e-13)
    assert_allclose([pose.acceleration(AB, rates), pose.acceleration(OA, rates)], [-0.1050, -4.34], rtol=5e-4)


class Engine(Mechanism):
    """Piston A, connecting rod AB, crank OB."""

    phi = Stroke(0, TURN)
    O, line = Ground(0, 0), Guide((0, 0), angle=0)
    B = Crank(O, OB=0.125, angle=phi)
    A = SliderDyad(B, line, BA=0.350, side=LEFT)
    G = OnLink(B, A, BG=0.100)


def test_meriams_engine():
    """Sample problems 5/9 and 5/15 at 60 deg and 1500 rev/min: 20.2 m/s, 29.5 rad/s, 19.24 m/s; 994 m/s2, 7740 rad/s2."""
    pose, rates = Engine().at(phi=120 * deg), dict(phi=-1500 * TURN / 60)
    rod = angle("A", "B")
    found = [pose.velocity("A", rates)[0], pose.velocity(rod, rates), np.hypot(*pose.velocity("G", rates))]
    assert_allclose(found, [20.2, 29.5, 19.24], rtol=3e-4)
    assert_allclose([pose.acceleration("A", rates)[0], -pose.acceleration(rod, rates)], [994, 7740], rtol=5e-4)


class Oldham(Mechanism):
    """Two parallel shafts, 20 mm apart, each with a slot that the disc's two ribs slide in."""

    phi = Stroke(0.1, 3.0)
    O, Q = Ground(0, 0), Ground(0.020, 0)
    A, B = Crank(O, OA=0.1, angle=phi), Crank(Q, QB=0.1, angle=phi + 90 * deg)
    first, second = Guide(O, A), Guide(Q, B)
    X = GuideCross(first, second)


def test_oldham_disc_circles_twice():
    """Its centre runs twice a turn on the circle whose diameter is the offset (Reuleaux)."""
    motion = Oldham().sweep(31)
    twice = 2 * motion.strokes["phi"]
    assert_allclose(motion["X"], 0.010 * np.array([1 + np.cos(twice), np.sin(twice)]), rtol=0, atol=1e-16)
    assert_allclose(np.hypot(*motion.ratio("X")), 0.020, rtol=1e-13)


class Davis(Mechanism):
    """Davis's steering gear: a rack with two pins in the slots of the steering arms."""

    S = Stroke(-0.12, 0.1)
    L, M = Ground(-0.6, 0), Ground(0.6, 0)
    bar = Guide((0, -0.16), angle=0)
    P = OnGuide(bar, at=S - 0.68)
    Q = SliderDyad(P, bar, PQ=1.36, side=RIGHT)
    E, F = PinSlotDyad(L, P, LE=0.3), PinSlotDyad(M, Q, MF=0.3)


def test_davis_gear_steers_exactly():
    """cot(outer) - cot(inner) is the same at all locks, track over wheelbase: here 2 * 80 / 160 (Ackermann's condition)."""
    straight, motion = Davis().at(S=0.0), Davis().at(S=[-0.12, -0.05, 0.02, 0.1])
    left, right = (motion.angle(*pair) - straight.angle(*pair) for pair in (("L", "E"), ("M", "F")))
    assert_allclose(1 / np.tan(right) - 1 / np.tan(left), 1.0, rtol=1e-11)
