"""A forestry crane: boom cylinder, arm cylinder on a lever and a link, a telescope with its own cylinder; three strokes, one path."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Cylinder, LiftCircuit, lift_verdicts
from linkage import (
    LEFT,
    RIGHT,
    Dyad,
    Ground,
    LinkMass,
    Mechanism,
    OnLink,
    PinFriction,
    Stroke,
    Weight,
    bar,
    deg,
    driving_force,
    mm,
    pin_forces,
)
from tests.machines.machines_b_truth import (
    beside,
    between,
    critical,
    cross,
    meet,
    over,
    power,
    said_of,
    size,
    slopes,
    stretch,
    unit,
    weight,
)
from tests.mechanisms.free_bodies import FreeBodies

STROKES = ("S1", "S2", "S3")


class Crane(Mechanism):
    """Boom O-P on the column, arm P-N with the telescope's end T; the cylinder CL turns the lever QL, the link LN the arm."""

    S1 = Stroke(0.0, 0.90)                                        # boom cylinder
    S2 = Stroke(0.0, 0.55)                                        # arm cylinder: it folds the arm
    S3 = Stroke(0.0, 1.50)                                        # telescope

    O = Ground(0.0, 3.0)
    A = Ground(0.30, 1.75)

    B = Dyad(A, O, AB=1.13 + S1, OB=1.05, side=RIGHT)
    P = OnLink(O, B, OP=3.6, BOP=10 * deg)
    C = OnLink(O, P, OC=1.55, POC=9 * deg)
    Q = OnLink(O, P, OQ=3.28, POQ=2.5 * deg)
    L = Dyad(C, Q, CL=1.45 + S2, QL=0.42, side=LEFT)
    N = Dyad(L, P, LN=0.58, PN=0.24, side=LEFT)
    U = OnLink(P, N, PU=0.35, NPU=-110 * deg)                     # foot of the telescope's cylinder, above the arm
    H = OnLink(P, N, PH=0.80, NPH=-123 * deg)                     # the arm's centre of gravity
    T = OnLink(P, N, PT=2.0 + S3, NPT=-125 * deg)                 # the telescope's end

    boom = LinkMass("O P", mass=420, at=(1.7, 0.10))
    arm = Weight(H, mass=260)
    lever = LinkMass("Q L", mass=40)
    head = Weight(T, mass=1100)                                   # telescope, rotator, grapple and log

    raise_ = Cylinder(A, B, bore=125 * mm, rod=70 * mm, closed=1.13, stroke=0.90)
    fold = Cylinder(C, L, bore=110 * mm, rod=63 * mm, works="both", closed=1.45, stroke=0.55)
    extend = Cylinder(U, T, bore=63 * mm, rod=36 * mm, works="both", safety=2.5)
    boom_line = LiftCircuit(raise_, pressure=210 * bar, relief=235 * bar)
    arm_line = LiftCircuit(fold, pressure=210 * bar, relief=235 * bar)


def place(S1, S2, S3):
    O, A = np.array([0.0, 3.0]), np.array([0.30, 1.75])
    B = meet(A, 1.13 + S1, O, 1.05, left=False)
    P = beside(O, B, 3.6, 10 * deg)
    C, Q = beside(O, P, 1.55, 9 * deg), beside(O, P, 3.28, 2.5 * deg)
    L = meet(C, 1.45 + S2, Q, 0.42, left=True)
    N = meet(L, 0.58, P, 0.24, left=True)
    U, H, T = (beside(P, N, long, turn * deg) for long, turn in ((0.35, -110), (0.80, -123), (2.0 + S3, -125)))
    boom = O + 1.7 * unit(O, P) + 0.10 * np.array([-unit(O, P)[1], unit(O, P)[0]])
    return {"O": O, "A": A, "B": B, "P": P, "C": C, "Q": Q, "L": L, "N": N, "U": U, "H": H, "T": T, "boom": boom, "mid": (Q + L) / 2}


WEIGHTS = [("boom", weight(420)), ("H", weight(260)), ("mid", weight(40)), ("T", weight(1100))]
CYLINDERS = {"raise_": ("A", "B", "S1"), "fold": ("C", "L", "S2"), "extend": ("U", "T", "S3")}


def thrusts(**strokes):
    """Return the three thrusts by virtual work [N]."""
    at, found = place(**strokes), {}
    for name, (P, Q, stroke) in CYLINDERS.items():
        slope = slopes(place, stroke, **strokes)
        others = [abs(stretch(at, slope, *ends[:2])) for ends in CYLINDERS.values() if ends[2] != stroke]
        assert max(others) < 1e-13        # each stroke moves one cylinder only
        found[name] = -power(slope, WEIGHTS) / stretch(at, slope, P, Q)
    return found


def bodies(strokes, turning=(0.0, 0.0)):
    """Return the unknowns of one pose by free bodies; `turning` are couples [Nm] that rub on the boom at O and on the arm at P."""
    at = place(**strokes)
    free = FreeBodies()
    free.pin("O", "boom", "frame", at["O"])
    free.thrust("raise_", "frame", at["A"], "boom", at["B"])
    free.pin("P", "arm", "boom", at["P"])
    free.pin("Q", "lever", "boom", at["Q"])
    free.thrust("fold", "boom", at["C"], "lever", at["L"])
    free.thrust("link", "lever", at["L"], "arm", at["N"])
    free.across("slide", "tip", "arm", at["T"], at["T"] - at["P"])
    free.torque("clamp", "tip", "arm")
    free.thrust("extend", "arm", at["U"], "tip", at["T"])
    for body, (point, force) in zip(("boom", "arm", "lever", "tip"), WEIGHTS, strict=True):
        free.load(body, at[point], force)
    free.load("boom", at["O"], (0, 0), turning[0] - turning[1])
    free.load("arm", at["P"], (0, 0), turning[1])
    found = free.solve()
    pins = {name: np.array([found[f"{name}x"], found[f"{name}y"]]) for name in "OPQ"}
    return {**pins, **{name: found[name] for name in ("raise_", "fold", "extend", "link", "slide", "clamp")}, "LN": unit(at["L"], at["N"])}


s = np.linspace(0.0, 1.0, 9)
PATH = {"S1": 0.10 + 0.55 * s, "S2": 0.50 - 0.45 * s**2, "S3": 1.4 * s}        # from a folded crane to one that reaches out and up


def test_where_everything_is():
    motion = Crane().at(**PATH)
    own = over(PATH, place)
    for name in "BPCQLNUHT":
        assert_allclose(motion[name], own[name], rtol=0, atol=1e-13)
    assert Crane().mobility == 3


def test_each_cylinder_carries_its_own_thrust_along_the_path():
    motion = Crane().at(**PATH)
    own = over(PATH, thrusts)
    assert own["fold"].min() < -5e3 and own["fold"].max() > 5e3           # it reverses: this cylinder works with both sides
    assert own["extend"].min() < -1e3 and own["extend"].max() > 1e3
    for name, scale in (("raise_", 1e5), ("fold", 1e5), ("extend", 1e4)):
        assert_allclose(getattr(Crane, name).thrust(motion), own[name], rtol=1e-11, atol=1e-12 * scale)
    for stroke, name in (("S1", "raise_"), ("S2", "fold")):
        assert_allclose(driving_force(motion, drive=stroke), own[name], rtol=1e-11, atol=1e-7)
    lever = over(PATH, lambda **q: {"d": stretch(place(**q), slopes(place, "S3", **q), "U", "T")})["d"]
    assert_allclose(driving_force(motion, drive="S3"), own["extend"] * lever, rtol=1e-11, atol=1e-7)
    assert lever.min() < 0.999                                             # the cylinder lies askew to the telescope


def test_the_pins_of_boom_lever_and_arm():
    motion = Crane().at(**PATH)
    own, work = over(PATH, lambda **q: bodies(q)), over(PATH, thrusts)
    forces = pin_forces(motion)
    for name in CYLINDERS:
        assert_allclose(own[name], work[name], rtol=1e-11, atol=1e-7)
        assert_allclose(forces.thrusts[name], own[name], rtol=1e-11, atol=1e-7)
    largest = np.abs(own["O"]).max()
    for pin, on, by in (("O", "OBPCQ", "frame"), ("P", "PNUH", "OBPCQ"), ("Q", "QL", "OBPCQ")):
        assert_allclose(between(forces, pin, on, by), own[pin], rtol=0, atol=1e-11 * largest)
    assert_allclose(forces.force("N", on="PNUH"), own["link"] * own["LN"], rtol=0, atol=1e-11 * largest)
    ends = over(PATH, lambda **q: {"A": unit(place(**q)["A"], place(**q)["B"])})["A"]
    assert_allclose(forces.force("A", on="frame"), -own["raise_"] * ends, rtol=0, atol=1e-11 * largest)
    assert_allclose(forces.force("B", on="raise_"), -own["raise_"] * ends, rtol=0, atol=1e-11 * largest)
    assert forces.residual < 1e-12


def areas(bore, rod):
    return np.pi / 4 * bore**2, np.pi / 4 * (bore**2 - rod**2)


def test_pressures_of_both_sides():
    motion = Crane().at(**PATH)
    own = over(PATH, thrusts)
    piston, annulus = areas(0.110, 0.063)
    fold = np.where(own["fold"] > 0, own["fold"] / piston, -own["fold"] / annulus)
    assert_allclose(Crane.fold.pressure(motion), fold, rtol=1e-10)
    assert_allclose(Crane.arm_line.reserve(motion), 210e5 / fold, rtol=1e-10)
    assert_allclose(Crane.raise_.pressure(motion), own["raise_"] / areas(0.125, 0.070)[0], rtol=1e-10)
    assert_allclose(Crane.boom_line.reserve(motion), 210e5 * areas(0.125, 0.070)[0] / own["raise_"], rtol=1e-10)


def test_friction_takes_its_senses_from_the_path():
    """Couples mu r F against the turning of boom and arm, found by going round until they stand still."""
    motion = Crane().at(**PATH)
    rough = [PinFriction("O", radius=60 * mm, coefficient=0.12), PinFriction("P", radius=50 * mm, coefficient=0.15)]
    loads = ["boom", "arm", "lever", "head", *rough]
    arms = (0.060 * 0.12, 0.050 * 0.15)
    tangent = {"S1": 0.55 + 0 * s, "S2": -0.90 * s, "S3": 1.4 + 0 * s}

    def sense(k, strokes):
        """The signs of the boom's turning, and of the arm's on the boom, along the path."""
        at, v = place(**strokes), {name: 0.0 for name in ("O", "P", "N")}
        for name in STROKES:
            slope = slopes(place, name, **strokes)
            v = {point: v[point] + tangent[name][k] * slope[point] for point in v}
        boom, arm = (cross(at[Q] - at[P], v[Q] - v[P]) / size(at[Q] - at[P]) ** 2 for P, Q in ("OP", "PN"))
        return np.sign(boom), np.sign(arm - boom)

    for direction, way in (("extending", 1.0), ("retracting", -1.0)):
        forces = pin_forces(motion, loads, direction=direction)
        for k in range(1, 9):                       # at the first pose the arm stands still on the boom
            strokes = {name: float(values[k]) for name, values in PATH.items()}
            senses, couples = sense(k, strokes), (0.0, 0.0)
            for _ in range(60):
                found = bodies(strokes, couples)
                couples = tuple(-way * sign * arm * np.hypot(*found[pin]) for sign, pin, arm in zip(senses, "OP", arms, strict=True))
            for name in CYLINDERS:
                assert_allclose(forces.thrusts[name][k], found[name], rtol=1e-9)
            assert_allclose(between(forces, "P", "PNUH", "OBPCQ")[:, k], found["P"], rtol=1e-9, atol=1e-6)


@pytest.mark.slow
def test_what_is_said_along_the_path():
    """The path goes straight from pose to pose; what is least or most lies anywhere on it."""
    t = np.linspace(0.0, 1.0, 321)
    own = over({name: np.interp(t, s, values) for name, values in PATH.items()}, thrusts)
    motion = Crane().at(**PATH)
    boom = 210e5 * areas(0.125, 0.070)[0] / own["raise_"]
    piston, annulus = areas(0.110, 0.063)
    arm = 210e5 / np.where(own["fold"] > 0, own["fold"] / piston, -own["fold"] / annulus)
    assert 0 < np.argmin(arm) < 320 and np.argmin(arm) % 40                # between the poses that were given
    for circuit, reserve in ((Crane.boom_line, boom), (Crane.arm_line, arm)):
        lifting = said_of(lift_verdicts(circuit, motion), "lifting")
        assert lifting.ok
        assert f"{reserve.min():.3f}" in str(lifting)
    for cylinder, name, least_length, stroke, rod in ((Crane.raise_, "raise_", 1.13, "S1", 0.070), (Crane.fold, "fold", 1.45, "S2", 0.063)):
        use = (3.5 * own[name] / critical(least_length + np.interp(t, s, PATH[stroke]), rod)).max()
        said = said_of(cylinder.checks(motion), "buckling")
        assert said.ok == (use <= 1.0)
        assert f"safety {3.5 / use:.3g}" in str(said)
