"""Frames and machines of the textbooks: cylinder forces and pin reactions against free bodies cut by hand, and printed results."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import (
    LEFT,
    RIGHT,
    Crank,
    Dyad,
    Force,
    Ground,
    Guide,
    Link,
    LinkMass,
    Mechanism,
    Moment,
    OnGuide,
    OnLink,
    Pin,
    Slide,
    SliderDyad,
    Spring,
    Stroke,
    Weight,
    deg,
    drawn,
    driving_force,
    pin_forces,
)
from tests.mechanisms.free_bodies import FreeBodies, G, places


class LiftTable(Mechanism):
    """Two cranks of length 2 a carry the platform; the cylinder pushes the middle of one, H lies L beside its pivot."""

    S = Stroke(0, 0.5)
    E, H, C = Ground(0, 0), Ground(3.20, 0), Ground(1.5, 0)
    D = Dyad(H, E, HD=2.6 + S, ED=0.70, side=RIGHT)
    B = OnLink(E, D, EB=1.40)
    K = Dyad(B, C, BK=1.5, CK=1.40, side=LEFT)
    W = OnLink(B, K, BW=0.9)
    crate = Force(W, (0, -500 * 9.81))


def test_beers_hydraulic_lift_table():
    """Beer, Johnston, Vector Mechanics, method of virtual work: F = W s cot(theta) / L; 1000 kg, 60 deg: 5.15 kN."""
    s = np.sqrt(0.70**2 + 3.20**2 - 2 * 0.70 * 3.20 * np.cos(60 * deg))
    force = float(driving_force(LiftTable().at(S=s - 2.6)))
    assert_allclose(force, 9810 * s / 3.20 / np.tan(60 * deg), rtol=1e-12)
    assert_allclose(force, 5150, rtol=2e-3)


class Toggle(Mechanism):
    """A pull of 200 N against a spring of 2 kN/m."""

    theta = Stroke(20 * deg, 60 * deg)
    A, line = Ground(0, 0), Guide((0, 0), angle=90 * deg)
    B = Crank(A, AB=0.30, angle=theta)
    C = SliderDyad(B, line, BC=0.30, side=RIGHT)
    pull, spring = Force(C, (0, 200)), Spring(A, C, stiffness=2000, free_length=0.10)


def test_beers_toggle_on_a_spring():
    """Beer, Johnston: two links l, a spring of free length h along the line: sin(theta) = (P + k h) / 2 k l in equilibrium."""
    balanced = np.arcsin((200 + 2000 * 0.10) / (2 * 2000 * 0.30))
    assert_allclose(driving_force(Toggle().at(theta=balanced)), 0.0, atol=1e-12)


def scissors(stages):
    """Return a table of crossed arms, 2 m long, pushed together at the floor, 10 kN on its top."""
    body = {"S": Stroke(0.2, 0.9), "A0": Ground(0, 0), "floor": Guide((0, 0), angle=0)}
    body["B0"] = OnGuide("floor", at=1.9 - body["S"])
    for k in range(stages):
        A, B, M = f"A{k}", f"B{k}", f"M{k}"
        body[M] = Dyad(A, B, **{A + M: 1.0, B + M: 1.0}, side=LEFT)
        body[f"B{k + 1}"], body[f"A{k + 1}"] = OnLink(A, M, **{f"{A}B{k + 1}": 2.0}), OnLink(B, M, **{f"{B}A{k + 1}": 2.0})
    body["left"], body["right"] = Force(f"A{stages}", (0, -5000)), Force(f"B{stages}", (0, -5000))
    return type("Scissors", (Mechanism,), body)


@pytest.mark.parametrize("stages", [1, 2, 3])
def test_scissor_tables_thrust_grows_with_its_stages(stages):
    """n W cot(alpha), whatever the pantograph above does."""
    motion = scissors(stages)().sweep(9)
    alpha = np.arccos((1.9 - motion.strokes["S"]) / 2)
    assert_allclose(motion.y(f"A{stages}"), stages * 2 * np.sin(alpha), rtol=1e-13)
    assert_allclose(driving_force(motion), stages * 10e3 / np.tan(alpha), rtol=1e-12)
    assert pin_forces(motion).gap < 1e-13


def test_scissor_table_with_its_cylinder_between_the_arms():
    class ArmToArm(Mechanism):
        """A scissor table whose cylinder stands between the two arms: one group. Its straight arms are given by distances alone."""

        S = Stroke(0, 0.5)
        sketch = drawn(S=0.5)
        A, floor = Ground(0, 0), Guide((0, 0), angle=0)
        B, M, C, D = Pin(near=(1.8, 0)), Pin(near=(0.9, 0.45)), Pin(near=(1.8, 0.9)), Pin(near=(0, 0.9))
        P, Q, T = Pin(near=(0.4, 0.2)), Pin(near=(1.3, 0.25)), Pin(near=(2.0, 0.9))
        rising = Link("A P M C", AM=1, AC=2, MC=1, AP=0.45, PM=0.55)
        falling = Link("B M D Q", BM=1, BD=2, MD=1, BQ=0.6, QM=0.4)
        deck, top = Guide(D, T), Link("D T", DT=2.0)
        lift = Link("P Q", PQ=0.35 + S)
        wheel, roller = Slide(B, floor), Slide(C, deck)
        load, own = Force(T, (0, -3000)), LinkMass("A P M C", mass=40)

    motion = ArmToArm().sweep(5)
    p, cut, forces = places(motion, 2), FreeBodies(), pin_forces(motion)
    assert_allclose([p["B"][1], p["D"][0], p["C"][1] - p["D"][1]], 0.0, atol=1e-9)
    cut.pin("A", "rising", "frame", p["A"])
    cut.along("B", "falling", "frame", p["B"], (0, 1))
    cut.pin("M", "falling", "rising", p["M"])
    cut.pin("D", "top", "falling", p["D"])
    cut.across("C", "rising", "top", p["C"], p["T"] - p["D"])
    cut.thrust("S", "rising", p["P"], "falling", p["Q"])
    cut.load("top", p["T"], (0, -3000))
    cut.load("rising", np.mean([p[point] for point in "APMC"], axis=0), (0, -40 * G))
    want = cut.solve()
    assert_allclose(forces.drives["S"][2], want["S"], rtol=1e-9)
    assert_allclose(forces.force("M", on="falling")[:, 2], [want["Mx"], want["My"]], rtol=1e-9)


class Excavator(Mechanism):
    """Boom, stick and bucket with rocker and link, three cylinders."""

    S1, S2, S3 = Stroke(0, 0.6), Stroke(0, 0.7), Stroke(0, 0.4)
    O, K = Ground(0, 1.5), Ground(0.5, 1.0)
    B = Dyad(K, O, KB=1.6 + S1, OB=2.2, side=LEFT)
    E = OnLink(O, B, OE=4.0, BOE=-8 * deg)
    U = OnLink(O, B, OU=2.4, BOU=15 * deg)
    V = Dyad(U, E, UV=1.7 + S2, EV=0.6, side=LEFT)
    W = OnLink(E, V, EW=2.0, VEW=165 * deg)
    N = OnLink(E, V, EN=1.6, VEN=165 * deg)
    G = OnLink(E, V, EG=0.5, VEG=100 * deg)
    H = Dyad(G, N, GH=1.4 + S3, NH=0.4, side=LEFT)
    J = Dyad(H, W, HJ=0.45, WJ=0.35, side=LEFT)
    T = OnLink(W, J, WT=1.0, JWT=100 * deg)
    dig, boom, stick = Force(T, (-20e3, -30e3)), Weight(U, mass=900), LinkMass("E V W N G", mass=400)


def test_excavator_digs():
    motion, at = Excavator().sweep(S1=3, S2=3, S3=3), (1, 2, 1)
    p, cut, forces = places(motion, at), FreeBodies(), pin_forces(motion)
    for name, on, by in (("O", "boom", "frame"), ("E", "stick", "boom"), ("W", "bucket", "stick"), ("N", "rocker", "stick")):
        cut.pin(name, on, by, p[name])
    cut.pin("J", "bucket", "link", p["J"])
    cut.pin("H", "link", "rocker", p["H"])
    cut.thrust("S1", "frame", p["K"], "boom", p["B"])
    cut.thrust("S2", "boom", p["U"], "stick", p["V"])
    cut.thrust("S3", "stick", p["G"], "rocker", p["H"])
    cut.load("bucket", p["T"], (-20e3, -30e3))
    cut.load("boom", p["U"], (0, -900 * G))
    cut.load("stick", np.mean([p[point] for point in "EVWNG"], axis=0), (0, -400 * G))
    want = cut.solve()
    assert_allclose([forces.drives[name][at] for name in ("S1", "S2", "S3")], [want[name] for name in ("S1", "S2", "S3")], rtol=1e-11)
    for point, body in (("O", "O B"), ("E", "E V"), ("W", "W J"), ("N", "N H")):
        assert_allclose(np.abs(forces.force(point, on=body)[:, *at]), np.abs([want[point + "x"], want[point + "y"]]), rtol=1e-10)


class Press(Mechanism):
    """A ram B E on its guide, a tool beside the line, a connecting rod."""

    phi = Stroke(20 * deg, 160 * deg)
    O, line = Ground(0, 0), Guide((0, 0), angle=-90 * deg)
    A = Crank(O, OA=0.05, angle=phi)
    B = SliderDyad(A, line, AB=0.25, side=RIGHT)
    E = SliderDyad(B, line, BE=0.20, side=RIGHT)
    T = OnLink(B, E, BT=0.25, EBT=30 * deg)
    blow = Force(T, (0, 20e3))


def test_guide_holds_the_ram_and_not_its_rod():
    """At B meet ram and rod: the guide's force is on the ram, so that the rod is a two-force member."""
    motion = Press().sweep(5)
    forces = pin_forces(motion)
    for k in range(5):
        p, cut = places(motion, k), FreeBodies()
        cut.pin("O", "crank", "frame", p["O"])
        cut.torque("M", "crank", "frame")
        cut.pin("A", "rod", "crank", p["A"])
        cut.pin("B", "ram", "rod", p["B"])
        cut.along("N", "ram", "frame", p["B"], (1, 0))
        cut.along("F", "ram", "frame", p["E"], (1, 0))
        cut.load("ram", p["T"], (0, 20e3))
        want, (pin,) = cut.solve(), [each for each in forces.at("B") if each.kind == "pin"]
        assert_allclose(pin.force[:, k] * (1 if pin.on == "BET" else -1), [want["Bx"], want["By"]], rtol=1e-10, atol=1e-9)
        assert_allclose(forces.at("E")[0].force[0, k], want["F"], rtol=1e-10)


class Platform(Mechanism):
    """3-RPR: a plate on three cylinders."""

    s1, s2, s3 = Stroke(0, 0.4), Stroke(0, 0.4), Stroke(0, 0.4)
    sketch = drawn(s1=0.2, s2=0.2, s3=0.2)
    A, B, C = Ground(0, 0), Ground(3, 0), Ground(1.5, 2.6)
    D, E, F = Pin(near=(0.9, 0.6)), Pin(near=(1.9, 0.5)), Pin(near=(1.4, 1.5))
    plate = Link("D E F", DE=1, DF=1, EF=1)
    one, two, three = Link("A D", AD=1.0 + s1), Link("B E", BE=1.0 + s2), Link("C F", CF=1.0 + s3)
    push, turn = Force(D, (100, -900)), Moment("D E F", M=250)


def test_plate_on_three_cylinders():
    motion = Platform().at(s1=0.2, s2=0.1, s3=0.25)
    p, cut = places(motion), FreeBodies()
    for stroke, foot, pin in (("s1", "A", "D"), ("s2", "B", "E"), ("s3", "C", "F")):
        cut.thrust(stroke, "frame", p[foot], "plate", p[pin])
    cut.load("plate", p["D"], (100, -900), 250)
    for stroke, want in cut.solve().items():
        assert_allclose(driving_force(motion, drive=stroke), want, rtol=1e-12)
