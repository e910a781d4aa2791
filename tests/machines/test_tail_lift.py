"""A tail-lift: lift arms AB, tilt cylinders DC as the upper side of the parallelogram, lift cylinders EF, the platform BCZ.

The tilt cylinders' stroke counts how far they are drawn in, `DC = 0.92 - S2`, and they pull. All figures are illustrative.
"""

from math import atan2, hypot

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Cylinder, LiftCircuit, lift_verdicts
from linkage import (
    LEFT,
    RIGHT,
    Crank,
    Dyad,
    Ground,
    LinkMass,
    Mechanism,
    OnLink,
    PinFriction,
    Spring,
    Stroke,
    Weight,
    driving_force,
    pin_forces,
)
from linkage.units import bar, deg, litre, minute, mm
from tests.machines import plane
from tests.machines.words import number
from tests.mechanisms.free_bodies import FreeBodies

FRAME = {"A": (0.0, 0.55), "D": (0.02, 0.85), "E": (-0.35, 0.00)}
AB, BC, AF, BAF, BZ, BG = 0.80, 0.30, 0.45, -6 * deg, 1.60, 0.72
CBZ = -95 * deg  # the platform stands off the upright
MASS, OWN, ARM = 1500.0, 140.0, 60.0
EF0, DC0 = 0.620, 0.920  # the lengths at S1 = 0 and at S2 = 0


class TailLift(Mechanism):
    """Driven lengths; the lift's stroke is what one of its two stages does, so that the length grows twice as fast."""

    S1 = Stroke(0.0, 0.225)
    S2 = Stroke(0.0, 0.260)

    A = Ground(*FRAME["A"])
    D = Ground(*FRAME["D"])
    E = Ground(*FRAME["E"])
    F = Dyad(E, A, EF=EF0 + 2 * S1, AF=AF, side=RIGHT)
    B = OnLink(A, F, AB=AB, FAB=-BAF)
    C = Dyad(D, B, DC=DC0 - S2, BC=BC, side=LEFT)
    Z = OnLink(B, C, BZ=BZ, CBZ=CBZ)
    G = OnLink(B, C, BG=BG, CBG=CBZ)

    load = Weight(G, mass=MASS)
    platform = LinkMass("B Z", mass=OWN)
    arms = LinkMass("A B", mass=ARM)
    lift = Cylinder(E, F, bore=70 * mm, rod=40 * mm, count=2, closed=0.615, stroke=0.460)
    tilt = Cylinder(D, C, bore=60 * mm, rod=36 * mm, count=2, works="rod", closed=0.640, stroke=0.300)
    lift_line = LiftCircuit(lift, pressure=170 * bar, relief=185 * bar, flow=12 * litre / minute, mechanical_efficiency=0.93)
    tilt_line = LiftCircuit(tilt, pressure=170 * bar, relief=185 * bar, back_pressure=2 * bar, mechanical_efficiency=0.93)


class ByAngles(Mechanism):
    """The arm's and the platform's angle drive, the cylinders hang beside them."""

    arm = Stroke(-45 * deg, 45 * deg)
    level = Stroke(-10 * deg, 60 * deg)

    A = Ground(*FRAME["A"])
    D = Ground(*FRAME["D"])
    E = Ground(*FRAME["E"])
    B = Crank(A, AB=AB, angle=arm)
    F = OnLink(A, B, AF=AF, BAF=BAF)
    Z = Crank(B, BZ=BZ, angle=level)
    C = OnLink(B, Z, BC=BC, ZBC=-CBZ)
    G = OnLink(B, Z, BG=BG)

    load = Weight(G, mass=MASS)
    platform = LinkMass("B Z", mass=OWN)
    arms = LinkMass("A B", mass=ARM)
    lift = Cylinder(E, F, bore=70 * mm, rod=40 * mm, count=2, closed=0.615, stroke=0.460)
    tilt = Cylinder(D, C, bore=60 * mm, rod=36 * mm, count=2, works="rod", closed=0.640, stroke=0.300)
    lift_line = LiftCircuit(lift, pressure=170 * bar, relief=185 * bar, flow=12 * litre / minute, mechanical_efficiency=0.93)
    tilt_line = LiftCircuit(tilt, pressure=170 * bar, relief=185 * bar, back_pressure=2 * bar, mechanical_efficiency=0.93)


# -- by hand: by the arm's angle and the platform's --------------------------------------------------------

RAMS = {"lift": ("E", "F"), "tilt": ("D", "C")}
POSES = np.array([(-0.80, 0.02), (-0.35, 0.00), (0.05, 0.01), (0.40, 0.12), (0.55, 0.25)])


def places(q):
    """Return every place by the two angles."""
    found = {name: plane.point(*place) for name, place in FRAME.items()}
    found["B"] = found["A"] + plane.turned((AB, 0.0), q[0])
    found["F"] = found["A"] + plane.turned((AF, 0.0), q[0] + BAF)
    found |= {name: found["B"] + plane.turned((far, 0.0), q[1]) for name, far in (("Z", BZ), ("G", BG))}
    return found | {"C": found["B"] + plane.turned((BC, 0.0), q[1] - CBZ)}


LOADS = [
    ("G", (0.0, -MASS * plane.G)),
    *((name, (0.0, -mass / 2 * plane.G)) for name, mass in (("B", OWN), ("Z", OWN), ("A", ARM), ("B", ARM))),
]


def span(q, name):
    """Return a cylinder's length."""
    p = places(q)
    return plane.length(*(p[end] for end in RAMS[name]))


def strokes(poses=POSES):
    """Return the strokes of the driven lengths."""
    return {"S1": np.array([(span(q, "lift") - EF0) / 2 for q in poses]), "S2": np.array([DC0 - span(q, "tilt") for q in poses])}


def angles(poses=POSES):
    """Return the strokes of the driven angles."""
    return {"arm": poses[:, 0], "level": poses[:, 1]}


def thrusts(q, loads=LOADS):
    """Return the thrusts of the lift and of the tilt cylinders."""
    return plane.balance(places, q, loads, list(RAMS.values()))


def cut(q, extra=(), turning=(0, 0), rub=lambda pin: 0.0):
    """Return the free bodies' forces; `turning` are the senses of the arm's and of the platform's turning on it."""
    p, bodies = places(q), FreeBodies()
    bodies.pin("A", "arm", "frame", p["A"])
    bodies.pin("B", "platform", "arm", p["B"])
    bodies.thrust("lift", "frame", p["E"], "arm", p["F"])
    bodies.thrust("tilt", "frame", p["D"], "platform", p["C"])
    for body, (name, force) in zip(("platform", "platform", "platform", "frame", "arm"), LOADS, strict=True):
        bodies.load(body, p[name], force)
    bodies.load("arm", p["A"], LOADS[3][1])
    for body, name, force in extra:
        bodies.load(body, p[name], force)
    for pin, turns, outer, inner in zip("AB", turning, ("arm", "platform"), ("frame", "arm"), strict=True):
        bodies.load(outer, p[pin], (0.0, 0.0), -turns * rub(pin))
        bodies.load(inner, p[pin], (0.0, 0.0), turns * rub(pin))
    return bodies.solve()


BOTH = [(TailLift, strokes), (ByAngles, angles)]


@pytest.mark.parametrize(("machine", "at"), BOTH)
def test_positions(machine, at):
    motion = machine().at(**at())
    for k, q in enumerate(POSES):
        for name, place in places(q).items():
            assert_allclose(motion[name][:, min(k, motion[name].shape[1] - 1)], place, atol=1e-12)


@pytest.mark.parametrize(("machine", "at"), BOTH)
def test_thrust_is_of_the_cylinder_and_not_of_its_stroke(machine, at):
    motion = machine().at(**at())
    lift, tilt = np.array([thrusts(q) for q in POSES]).T
    assert np.all(lift > 0) and np.all(tilt < 0)
    assert_allclose(machine.lift.thrust(motion), lift, rtol=1e-11)
    assert_allclose(machine.tilt.thrust(motion), tilt, rtol=1e-11)
    forces = pin_forces(motion)
    assert_allclose(forces.thrusts["lift"], lift, rtol=1e-11)
    assert_allclose(forces.thrusts["tilt"], tilt, rtol=1e-11)


def test_stroke_forces_of_twice_the_length_and_of_the_falling_one():
    motion = TailLift().at(**strokes())
    lift, tilt = np.array([thrusts(q) for q in POSES]).T
    assert_allclose(driving_force(motion, drive="S1"), 2 * lift, rtol=1e-11)
    assert_allclose(driving_force(motion, drive="S2"), -tilt, rtol=1e-11)
    drives = pin_forces(motion).drives
    assert_allclose(drives["S1"], 2 * lift, rtol=1e-11)
    assert_allclose(drives["S2"], -tilt, rtol=1e-11)


@pytest.mark.parametrize(("machine", "at"), BOTH)
def test_pins(machine, at):
    forces = pin_forces(machine().at(**at()))
    for k, q in enumerate(POSES):
        want, p = cut(q), places(q)
        size = max(map(abs, want.values()))
        for name, body in (("A", "A B"), ("B", "B Z")):
            assert_allclose(forces.force(name, on=body)[:, k], [want[name + "x"], want[name + "y"]], atol=1e-11 * size)
        pull = want["tilt"] * plane.toward(p["D"], p["C"])
        assert_allclose(forces.force("C", on="B Z")[:, k], pull, atol=1e-11 * size)
        assert_allclose(forces.force("C", on="tilt")[:, k], -pull, atol=1e-11 * size)


@pytest.mark.parametrize(("machine", "at"), BOTH)
def test_pressures(machine, at):
    """The tilt cylinders pull with their rod sides against 2 bar on their pistons."""
    motion = machine().at(**at())
    lift, tilt = np.array([thrusts(q) for q in POSES]).T
    assert_allclose(machine.lift.pressure(motion), lift / 0.93 / (2 * plane.disc(0.070)), rtol=1e-10)
    ring, disc = 2 * plane.annulus(0.060, 0.036), 2 * plane.disc(0.060)
    assert_allclose(machine.tilt.pressure(motion), (-tilt / 0.93 + 2e5 * disc) / ring, rtol=1e-10)
    assert_allclose(machine.tilt_line.reserve(motion), (170e5 * ring - 2e5 * disc) / (-tilt / 0.93), rtol=1e-10)
    assert_allclose(machine.tilt_line.holding(motion).working, -tilt / ring, rtol=1e-10)
    assert_allclose(machine.tilt_line.lowering(motion).working, -tilt * 0.93 / ring, rtol=1e-10)


def test_tilt_verdicts():
    """The arm locked: the platform is tilted up by drawing the rods in."""
    lift = float(strokes()["S1"][2])
    ring, disc = 2 * plane.annulus(0.060, 0.036), 2 * plane.disc(0.060)
    motion = TailLift().sweep(S1=lift, S2=3)
    arm = POSES[2, 0]
    ends = [level_at(arm, DC0 - out) for out in (0.0, 0.260)]
    most, _ = plane.peak(lambda level: -thrusts((arm, level))[1], *ends)
    lifting, oil, holding, lowering = lift_verdicts(TailLift.tilt_line, motion)
    reserve = (170e5 * ring - 2e5 * disc) / (most / 0.93)
    assert bool(lifting) == (reserve >= 1.0)
    assert_allclose(number("least reserve is", lifting), reserve, rtol=1e-3)
    assert_allclose(number("up to", holding), most / ring / bar, rtol=1e-3)
    assert bool(holding) == (most / ring <= 185e5)
    assert_allclose(number("", oil), 0.260 * ring / 1e-3, rtol=1e-2)
    assert "load drives" not in str(lifting)
    assert bool(lowering)
    checks = {each.rule: each for each in TailLift.tilt.checks(motion)}
    assert checks["buckling"] and "never pushed" in str(checks["buckling"])


def level_at(arm, DC_):
    """Return the platform's angle where the tilt cylinder has a length: the cosine rule at B."""
    p = places((arm, 0.0))
    BD = p["D"] - p["B"]
    far = np.hypot(*BD)
    corner = np.arccos((far**2 + BC**2 - DC_**2) / (2 * far * BC))
    return (atan2(BD[1], BD[0]) - corner + CBZ + np.pi) % (2 * np.pi) - np.pi


def test_lift_verdicts_and_buckling():
    """Tilt locked: the platform follows the arm as the side of a parallelogram that is nearly one."""
    tilt = float(strokes()["S2"][2])
    motion = TailLift().sweep(S1=3, S2=tilt)

    def pushes(arm):
        return thrusts((arm, level_at(arm, DC0 - tilt)))[0]

    low, high = (arm_at(EF0 + 2 * out) for out in (0.0, 0.225))
    most, _ = plane.peak(pushes, low, high)
    lifting, oil, *_ = lift_verdicts(TailLift.lift_line, motion)
    area = 2 * plane.disc(0.070)
    assert_allclose(number("least reserve is", lifting), 170e5 * area * 0.93 / most, rtol=1e-3)
    assert_allclose(number("", oil), 0.450 * area / 1e-3, rtol=1e-2)
    assert_allclose(number("end to end,", oil), 0.450 * area / (12e-3 / 60), rtol=2e-2)
    use, _ = plane.peak(lambda arm: pushes(arm) / 0.93 / 2 / plane.critical(0.040, span((arm, 0.0), "lift")), low, high)
    checks = {each.rule: each for each in TailLift.lift.checks(motion)}
    assert bool(checks["buckling"]) == (use * 3.5 <= 1.0)
    assert_allclose(number("safety", checks["buckling"]), 1 / use, rtol=6e-3)
    assert checks["length"]


def arm_at(EF_):
    """Return the arm's angle where the lift cylinder has a length: the cosine rule at A."""
    AE = np.subtract(FRAME["E"], FRAME["A"])
    far = hypot(*AE)
    corner = np.arccos((far**2 + AF**2 - EF_**2) / (2 * far * AF))
    return (atan2(AE[1], AE[0]) + corner - BAF + np.pi) % (2 * np.pi) - np.pi


# -- what a user adds, and friction along a path -----------------------------------------------------------


class Sprung(TailLift):
    """A user's own: a relief spring on the lift cylinder's own pins, and a roller cage beside the goods."""

    relief = Spring("E", "F", stiffness=8e3, free_length=1.15)
    cage = Weight("Z", mass=90.0)


@pytest.mark.slow
def test_what_a_user_adds_counts():
    """The spring, shorter than it would be, pushes with the cylinder and leaves it less."""
    motion = Sprung().at(**strokes())
    forces, pressure, drive = pin_forces(motion), Sprung.lift_line.pressure_for(motion), driving_force(motion, drive="S1")
    for k, q in enumerate(POSES):
        helps = 8e3 * (1.15 - span(q, "lift"))
        lift, tilt = thrusts(q, [*LOADS, ("Z", (0.0, -90.0 * plane.G))])
        assert helps > 0
        assert_allclose(forces.thrusts["relief"][k], helps, rtol=1e-11)
        assert_allclose([forces.thrusts["lift"][k], forces.thrusts["tilt"][k]], [lift - helps, tilt], rtol=1e-10)
        assert_allclose(pressure[k], (lift - helps) / 0.93 / (2 * plane.disc(0.070)), rtol=1e-10)
        p = places(q)
        assert_allclose(forces.force("E", on="relief")[:, k], helps * plane.toward(p["E"], p["F"]), rtol=1e-10)
        assert_allclose(drive[k], 2 * (lift - helps), rtol=1e-10)


class Dry(ByAngles):
    """Bushes without grease."""

    bush_A = PinFriction("A", radius=20 * mm, coefficient=0.15)
    bush_B = PinFriction("B", radius=18 * mm, coefficient=0.15)


class DryLengths(TailLift):
    """The same, driven by lengths."""

    bush_A = PinFriction("A", radius=20 * mm, coefficient=0.15)
    bush_B = PinFriction("B", radius=18 * mm, coefficient=0.15)


RUB = {"A": 0.020 * 0.15, "B": 0.018 * 0.15}


@pytest.mark.parametrize("machine", [Dry, DryLengths])
def test_friction_along_a_path_of_both_strokes(machine):
    """The arm rises while the platform tilts up: at B the platform turns back on the arm, though both cylinders move."""
    t = np.linspace(0.0, 1.0, 6)[:, None]
    path = np.array([-0.5, 0.02]) + t * np.array([0.9, 0.25])
    motion = machine().at(**(angles(path) if machine is Dry else strokes(path)))
    forces = pin_forces(motion, direction="extending")
    for k, q in enumerate(path):
        want = plane.rubbed(lambda size, q=q: cut(q, (), (1, -1), lambda pin: RUB[pin] * size(pin)), "AB")
        size = max(map(abs, want.values()))
        assert_allclose([forces.thrusts["lift"][k], forces.thrusts["tilt"][k]], [want["lift"], want["tilt"]], rtol=1e-10)
        assert_allclose(forces.force("B", on="B Z")[:, k], [want["Bx"], want["By"]], atol=1e-10 * size)


def test_mean_direction_of_the_angles_is_of_the_frame():
    """`Crank(B, BZ, angle=level)` is counted from the frame: the platform's couple does not load the arm."""
    motion = ByAngles().at(**angles())
    assert_allclose(motion.angle("B", "Z"), POSES[:, 1], atol=1e-13)
    assert_allclose(driving_force(motion, drive="level"), [-plane.work(places, q, LOADS, 1) for q in POSES], rtol=1e-11)
