"""A wheel loader with Z-bar linkage, written as a parts list from a drawing: lift cylinders CD, tilt cylinder TU over the lever UPV.

All figures are illustrative, of the size of a 10 t machine.
"""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Cylinder, LiftCircuit, lift_verdicts
from linkage import Ground, Link, LoadCase, Mechanism, Pin, Stroke, Weight, deg, drawn, driving_force, pin_forces
from linkage.units import bar, litre, minute, mm
from tests.machines import plane
from tests.machines.words import number
from tests.mechanisms.free_bodies import FreeBodies

DRAWING = {
    "A": (0.000, 2.050), "C": (-0.350, 1.000), "T": (0.200, 2.300),                         # frame
    "D": (1.091, 0.880), "P": (1.600, 1.210), "N": (2.192, 0.150), "G1": (1.200, 1.150),    # arm
    "U": (1.450, 1.950), "V": (1.780, 0.520),                                               # lever
    "W": (2.230, 0.550), "Z": (3.350, 0.050), "G3": (2.650, 0.350), "Q": (2.750, 0.550),    # bucket
}  # fmt: skip
AT = {name: np.array(place) for name, place in DRAWING.items()}
CD, TU = (float(plane.length(AT[P], AT[Q])) for P, Q in ("CD", "TU"))
DRAWN = {"S1": 0.0, "S2": 0.200}
MASS = {"G1": 900.0, "G3": 700.0, "Q": 3000.0}


class WheelLoader(Mechanism):
    """The arm A D P N lifts, the lever U P V tilts the bucket N W Z over the rod VW."""

    S1 = Stroke(0.0, 1.100)
    S2 = Stroke(0.0, 0.400)
    sketch = drawn(**DRAWN)

    A, C, T = (Ground(*DRAWING[name]) for name in "ACT")
    D, P, N, G1, U, V, W, Z, G3, Q = (Pin(at=DRAWING[name]) for name in ("D", "P", "N", "G1", "U", "V", "W", "Z", "G3", "Q"))

    arm = Link("A D P N G1")
    lever = Link("U P V")
    rod = Link("V W")
    shovel = Link("N W Z G3 Q")
    lifting = Link("C D", CD=CD + S1)
    tilting = Link("T U", TU=TU - DRAWN["S2"] + S2)

    arm_mass = Weight(G1, mass=MASS["G1"])
    shovel_mass = Weight(G3, mass=MASS["G3"])
    load = Weight(Q, mass=MASS["Q"])

    lift = Cylinder(C, D, bore=90 * mm, rod=50 * mm, count=2, closed=1.440, stroke=1.110)
    tilt = Cylinder(T, U, bore=110 * mm, rod=63 * mm, closed=1.090, stroke=0.420)
    lift_line = LiftCircuit(
        lift, pressure=190 * bar, relief=200 * bar, flow=120 * litre / minute, mechanical_efficiency=0.95, hydraulic_efficiency=0.97,
    )  # fmt: skip
    tilt_line = LiftCircuit(tilt, pressure=190 * bar, relief=230 * bar, back_pressure=4 * bar)

    empty = LoadCase("empty", scale={"load": 0.0})
    uphill = LoadCase("uphill", slope=12 * deg)
    braking = LoadCase("braking", gravity=(2.5, -9.81))


# -- by hand: the arm's and the lever's angle from the drawing ---------------------------------------------

RAMS = {"lift": ("C", "D"), "tilt": ("T", "U")}
POSES = np.array([(0.05, -0.05), (0.45, 0.10), (0.80, -0.12), (1.15, 0.02), (0.30, 0.15)])


def places(q):
    """Return every place where arm and lever have turned by q from the drawing (the lever as seen from the arm)."""
    found = {name: AT[name] for name in "ACT"}
    found |= {name: AT["A"] + plane.turned(AT[name] - AT["A"], q[0]) for name in ("D", "P", "N", "G1")}
    found |= {name: found["P"] + plane.turned(AT[name] - AT["P"], q[0] + q[1]) for name in "UV"}
    found["W"] = plane.meet(found["V"], plane.length(AT["V"], AT["W"]), found["N"], plane.length(AT["N"], AT["W"]), plane.LEFT)
    base = AT["W"] - AT["N"]
    for name in ("Z", "G3", "Q"):
        arm = AT[name] - AT["N"]
        along, across = (arm @ base) / np.hypot(*base), (base[0] * arm[1] - base[1] * arm[0]) / np.hypot(*base)
        found[name] = plane.on(found["N"], found["W"], along, across)
    return found


def weights(gravity=(0.0, -plane.G), **changed):
    """Return the weights of a case."""
    return [(name, np.array(gravity) * changed.get(name, mass)) for name, mass in MASS.items()]


CASES = {
    "uphill": weights((-plane.G * np.sin(12 * deg), -plane.G * np.cos(12 * deg))),
    "braking": weights((2.5, -9.81)),
    "empty": weights(Q=0.0),
    None: weights(),
}


def strokes(poses=POSES):
    """Return the strokes at angles."""
    at = [places(q) for q in poses]
    first = np.array([plane.length(p["C"], p["D"]) - CD for p in at])
    return {"S1": first, "S2": np.array([plane.length(p["T"], p["U"]) - TU + DRAWN["S2"] for p in at])}


def thrusts(q, loads=CASES[None]):
    """Return the thrusts of the lift cylinders and of the tilt cylinder."""
    return plane.balance(places, q, loads, list(RAMS.values()))


def cut(q, loads):
    """Return the free bodies' forces."""
    p, bodies = places(q), FreeBodies()
    bodies.pin("A", "arm", "frame", p["A"])
    bodies.pin("P", "lever", "arm", p["P"])
    bodies.pin("N", "shovel", "arm", p["N"])
    bodies.pin("V", "rod", "lever", p["V"])
    bodies.pin("W", "shovel", "rod", p["W"])
    bodies.thrust("lift", "frame", p["C"], "arm", p["D"])
    bodies.thrust("tilt", "frame", p["T"], "lever", p["U"])
    bodies.load("rod", p["V"], (0.0, 0.0))
    for (name, force), body in zip(loads, ("arm", "shovel", "shovel"), strict=True):
        bodies.load(body, p[name], force)
    return bodies.solve()


def test_positions():
    motion = WheelLoader().at(**strokes())
    for k, q in enumerate(POSES):
        for name, place in places(q).items():
            assert_allclose(motion[name][:, min(k, motion[name].shape[1] - 1)], place, atol=1e-11)
    assert WheelLoader().mobility == 2


@pytest.mark.parametrize("case", CASES)
def test_thrusts_in_every_case(case):
    """Gravity of a slope and of a brake acts on every mass."""
    motion = WheelLoader().at(**strokes())
    want = np.array([thrusts(q, CASES[case]) for q in POSES]).T
    assert_allclose(WheelLoader.lift.thrust(motion, case=case), want[0], rtol=1e-10)
    assert_allclose(WheelLoader.tilt.thrust(motion, case=case), want[1], rtol=1e-10)


def test_stroke_forces_are_the_thrusts_where_lengths_are_the_strokes():
    motion = WheelLoader().at(**strokes())
    for k, name in enumerate(RAMS):
        assert_allclose(driving_force(motion, drive=f"S{k + 1}"), getattr(WheelLoader, name).thrust(motion), rtol=1e-11)


@pytest.mark.parametrize("case", ["uphill", None])
def test_pins(case):
    forces = pin_forces(WheelLoader().at(**strokes()), case=case)
    for k, q in enumerate(POSES):
        want, p = cut(q, CASES[case]), places(q)
        size = max(map(abs, want.values()))
        for name, body in (("A", "arm"), ("P", "lever"), ("N", "shovel"), ("W", "shovel"), ("V", "rod")):
            assert_allclose(forces.force(name, on=body)[:, k], [want[name + "x"], want[name + "y"]], atol=1e-10 * size)
        for name, (P, Q) in RAMS.items():
            push = want[name] * plane.toward(p[P], p[Q])
            assert_allclose(forces.force(P, on=name)[:, k], push, atol=1e-10 * size)
        rod = forces.force("V", on="rod")[:, k]
        assert_allclose(rod + forces.force("W", on="rod")[:, k], 0.0, atol=1e-11 * size)
        assert abs(np.linalg.det([rod, p["W"] - p["V"]])) < 1e-10 * size


def test_pressures():
    """Two lift cylinders share their line; the tilt cylinder pushes the oil behind its piston out against 4 bar."""
    motion = WheelLoader().at(**strokes())
    lift, tilt = np.array([thrusts(q) for q in POSES]).T
    assert np.all(lift > 0) and np.any(tilt > 0)
    assert_allclose(WheelLoader.lift.pressure(motion), lift / 0.95 / (2 * plane.disc(0.090)) / 0.97, rtol=1e-10)
    assert_allclose(WheelLoader.lift_line.reserve(motion), 0.97 * 190e5 * 2 * plane.disc(0.090) / (lift / 0.95), rtol=1e-10)
    back = 4e5 * plane.annulus(0.110, 0.063)
    assert_allclose(WheelLoader.tilt_line.pressure_for(motion), np.maximum(tilt + back, 0.0) / plane.disc(0.110), rtol=1e-10)
    held = WheelLoader.tilt_line.holding(motion)
    assert_allclose(held.working, np.maximum(tilt, 0.0) / plane.disc(0.110), rtol=1e-10)
    assert_allclose(held.other, np.maximum(-tilt, 0.0) / plane.annulus(0.110, 0.063), rtol=1e-10, atol=1e-6)
    down = WheelLoader.lift_line.lowering(motion)
    assert_allclose(down.working, lift * 0.95 / (2 * plane.disc(0.090)), rtol=1e-10)
    assert down.by_itself.all()


def test_breakout_at_the_edge():
    """What the tilt cylinder lifts at the cutting edge Z: its largest force less what the bucket needs, over the edge's rise."""
    motion = WheelLoader().at(**strokes())
    found = WheelLoader.tilt_line.capacity(motion, "Z", case="empty", along=(0, 1))
    most = 190e5 * plane.disc(0.110) - 4e5 * plane.annulus(0.110, 0.063)
    for k, q in enumerate(POSES):
        spare = most - thrusts(q, CASES["empty"])[1]
        rise = plane.rate(places, q, 1)["Z"][1] / plane.stretch(places, q, "T", "U", 1)
        assert_allclose(found[k], spare / rise if rise > 0 else np.nan, rtol=1e-10)


@pytest.mark.slow
def test_verdicts_while_the_arm_lifts():
    """The tilt cylinder locked; the lever's angle follows the arm by the length TU."""
    motion = WheelLoader().sweep(S1=3, S2=0.200)

    def pushes(out, case=None):
        return thrusts(at_lengths(CD + out, TU), CASES[case])[0]

    def heaviest(out):  # of the load cases too, each of which counts
        return max(pushes(out, case) for case in CASES)

    most, _ = plane.peak(heaviest, 0.0, 1.100)
    least, _ = plane.peak(lambda out: -min(pushes(out, case) for case in CASES), 0.0, 1.100)
    lifting, oil, holding, lowering = lift_verdicts(WheelLoader.lift_line, motion, resistance=8 * bar)
    reserve = 0.97 * 190e5 * 2 * plane.disc(0.090) / (most / 0.95)
    assert bool(lifting) == (reserve >= 1.0)
    assert_allclose(number("least reserve is", lifting), reserve, rtol=1e-3)
    assert_allclose(number("up to", holding), most / (2 * plane.disc(0.090)) / bar, rtol=1e-3)
    assert bool(holding) == (most / (2 * plane.disc(0.090)) <= 200 * bar)
    assert_allclose(number("at least", lowering), -least * 0.95 / (2 * plane.disc(0.090)) / bar, rtol=1e-3)
    assert bool(lowering) == (-least * 0.95 / (2 * plane.disc(0.090)) > 8 * bar)
    seconds = 1.100 * 2 * plane.disc(0.090) / (120e-3 / 60)
    assert_allclose(number("end to end,", oil), seconds, rtol=2e-2)

    def use(out):  # in the worst case, which is not the one judged above
        p = places(at_lengths(CD + out, TU))
        return max(pushes(out, case) for case in CASES) / 2 / plane.critical(0.050, plane.length(p["C"], p["D"]))

    worst, _ = plane.peak(use, 0.0, 1.100)
    (buckling,) = [each for each in WheelLoader.lift.checks(motion) if each.rule == "buckling"]
    assert bool(buckling) == (worst * 3.5 <= 0.95)
    assert_allclose(number("safety", buckling), 0.95 / worst, rtol=6e-3)  # the rod carries T / k_m


def at_lengths(CD_, TU_):
    """Return the angles at two cylinder lengths: the arm by the cosine rule at A, the lever by that at P."""
    AC, AD = AT["C"] - AT["A"], AT["D"] - AT["A"]
    a, d = np.hypot(*AC), np.hypot(*AD)
    opened = np.arccos((a**2 + d**2 - CD_**2) / (2 * a * d)) - np.arccos((a**2 + d**2 - CD**2) / (2 * a * d))
    P = AT["A"] + plane.turned(AT["P"] - AT["A"], opened)
    PT, PU = AT["T"] - P, AT["U"] - AT["P"]
    t, u = np.hypot(*PT), np.hypot(*PU)
    U = np.arctan2(PT[1], PT[0]) - np.arccos((t**2 + u**2 - TU_**2) / (2 * t * u))
    lever = U - np.arctan2(PU[1], PU[0]) - opened
    return np.array([opened, (lever + np.pi) % (2 * np.pi) - np.pi])


class Counterweighted(WheelLoader):
    """A user's own: a quick coupler."""

    coupler = Weight("N", mass=260.0)


def test_what_a_subclass_adds_counts_in_pressure_and_verdict():
    motion = Counterweighted().at(**strokes())
    want = np.array([thrusts(q, [*CASES[None], ("N", (0.0, -260 * plane.G))]) for q in POSES]).T
    assert_allclose(Counterweighted.lift.thrust(motion), want[0], rtol=1e-10)
    assert_allclose(Counterweighted.lift_line.pressure_for(motion), want[0] / 0.95 / (2 * plane.disc(0.090)) / 0.97, rtol=1e-10)
