"""A mower on parallel links: a shoe on the ground, a relief spring and a lift cylinder on one pin of the lower link."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Cylinder, LiftCircuit, lift_verdicts
from linkage import (
    RIGHT,
    Damper,
    Dyad,
    Force,
    Ground,
    LinkMass,
    Mechanism,
    OnLink,
    PinFriction,
    Spring,
    Stroke,
    Support,
    Weight,
    bar,
    deg,
    driving_force,
    mm,
    pin_forces,
    reaction,
)
from tests.machines.machines_b_truth import beside, critical, meet, on_pin, over, power, said_of, size, slopes, stretch, unit, weight
from tests.mechanisms.free_bodies import FreeBodies


class Mower(Mechanism):
    """Lower link AFB, upper link CD, header BDGR with its shoe R; the cylinder EF pushes the lower link up, the spring KF relieves."""

    S = Stroke(0.0, 0.26)

    A = Ground(0.00, 0.55)
    C = Ground(0.05, 1.00)
    E = Ground(0.10, 0.15)                                  # foot of the cylinder
    K = Ground(0.30, 1.45)                                  # top of the spring

    F = Dyad(E, A, EF=0.46 + S, AF=0.45, side=RIGHT)
    B = OnLink(A, F, AB=0.85, FAB=-4 * deg)
    D = Dyad(B, C, BD=np.hypot(0.05, 0.45), CD=0.85, side=RIGHT)
    G = OnLink(B, D, BG=0.55, DBG=-80 * deg)
    R = OnLink(B, D, BR=0.60, DBR=-118 * deg)               # the shoe

    lower = LinkMass("A B", mass=24)
    upper = LinkMass("C D", mass=16)
    header = Weight(G, mass=330)
    crop = Force(R, (-420, 0))                              # drag of the shoe on the stubble, the mower goes to +x
    relief = Spring(K, F, stiffness=13e3, free_length=0.66)
    calm = Damper(K, F, coefficient=4000)
    shoe = Support(R, (0, 1))

    lift = Cylinder(E, F, bore=50 * mm, rod=28 * mm, closed=0.46, stroke=0.26)
    circuit = LiftCircuit(lift, pressure=175 * bar, relief=190 * bar, mechanical_efficiency=0.9)


def place(S):
    A, C, E, K = (np.array(each) for each in ([0.0, 0.55], [0.05, 1.00], [0.10, 0.15], [0.30, 1.45]))
    F = meet(E, 0.46 + S, A, 0.45, left=False)
    B = beside(A, F, 0.85, -4 * deg)
    D = C + B - A                                           # what a parallelogram is
    G, R = beside(B, D, 0.55, -80 * deg), beside(B, D, 0.60, -118 * deg)
    return {"A": A, "C": C, "E": E, "K": K, "F": F, "B": B, "D": D, "G": G, "R": R, "lower": (A + B) / 2, "upper": (C + D) / 2}


WEIGHTS = [("lower", weight(24)), ("upper", weight(16)), ("G", weight(330))]
DRAG = [("R", np.array([-420.0, 0.0]))]
AREA = np.pi / 4 * 0.050**2


def spring(at):
    return 13e3 * (0.66 - size(at["F"] - at["K"]))


def on_the_ground(S, thrust, speed=0.0):
    """Return the shoe's load [N] with a thrust of the cylinder, by virtual work; the stroke is the cylinder's own."""
    at, slope = place(S), slopes(place, "S", S=S)
    along = stretch(at, slope, "K", "F")
    push = spring(at) - 4000 * along * speed
    return {"R": -(power(slope, WEIGHTS + DRAG) + push * along + thrust) / slope["R"][1], "push": push, "rise": slope["G"][1]}


def lifted(S):
    """Return the thrust that carries the mower clear of the ground [N]: no drag, no shoe."""
    at, slope = place(S), slopes(place, "S", S=S)
    return {"lift": -power(slope, WEIGHTS) - spring(at) * stretch(at, slope, "K", "F"), "rise": slope["G"][1]}


def truth(S, thrust, push, couples=(0.0, 0.0, 0.0, 0.0)):
    """Return shoe and pins by free bodies; `couples` [Nm] rub at A and C on the links, at B and D on the header."""
    at, free = place(S), FreeBodies()
    free.pin("A", "lower", "frame", at["A"])
    free.pin("B", "header", "lower", at["B"])
    free.pin("C", "upper", "frame", at["C"])
    free.pin("D", "header", "upper", at["D"])
    free.along("R", "header", "frame", at["R"], (0, 1))
    free.load("lower", at["F"], thrust * unit(at["E"], at["F"]) + push * unit(at["K"], at["F"]))
    for body, (point, force) in zip(("lower", "upper", "header"), WEIGHTS, strict=True):
        free.load(body, at[point], force)
    free.load("header", at["R"], DRAG[0][1])
    on, by = ("lower", "upper", "header", "header"), ("frame", "frame", "lower", "upper")
    for first, second, pin, couple in zip(on, by, "ACBD", couples, strict=True):
        free.load(first, at[pin], (0, 0), couple)
        free.load(second, at[pin], (0, 0), -couple)
    found = free.solve()
    pins = {name: np.array([found[f"{name}x"], found[f"{name}y"]]) for name in "ABCD"}
    return {**pins, "R": found["R"], "EF": unit(at["E"], at["F"]), "KF": unit(at["K"], at["F"])}


def test_where_everything_is():
    motion = Mower().sweep(9)
    own = over(motion.strokes, place)
    for name in "FBDGR":
        assert_allclose(motion[name], own[name], rtol=0, atol=1e-13)
    assert_allclose(motion.angle("B", "D"), motion.angle("B", "D")[0], rtol=0, atol=1e-13)      # the header never turns


@pytest.mark.parametrize("pressure", [0.0, 4 * bar])
def test_the_shoe_carries_what_spring_and_cylinder_leave(pressure):
    motion = Mower().sweep(9)
    own = over(motion.strokes, lambda S: on_the_ground(S, pressure * AREA))
    assert own["R"].min() > 0
    assert_allclose(reaction(motion, drive_force=pressure * AREA), own["R"], rtol=1e-11)


def test_the_damper_in_the_shoes_load():
    motion = Mower().sweep(9)
    for speed in (0.15, -0.15):
        own = over(motion.strokes, lambda S, speed=speed: on_the_ground(S, 0.0, speed))
        assert_allclose(reaction(motion, rates=dict(S=speed)), own["R"], rtol=1e-11)


def test_every_pin_on_the_ground():
    """The shoe's load given, the cylinder keeps its return line's 4 bar and nothing else; three elements and a link meet at F."""
    motion, thrust = Mower().sweep(9), 4 * bar * AREA
    ground = over(motion.strokes, lambda S: on_the_ground(S, thrust))
    own = over(motion.strokes, lambda S: truth(S, thrust, on_the_ground(S, thrust)["push"]))
    assert_allclose(own["R"], ground["R"], rtol=1e-11)
    loads = ["lower", "upper", "header", "crop", "relief", "calm", Support("R", (0, 1), force=ground["R"])]
    forces = pin_forces(motion, loads)
    largest = np.abs(own["A"]).max()
    assert_allclose(forces.thrusts["lift"], thrust, rtol=1e-9)
    assert_allclose(forces.thrusts["relief"], ground["push"], rtol=1e-12)
    assert_allclose(forces.thrusts["calm"], 0.0, atol=1e-12)
    for pin, on in (("A", "AFB"), ("B", "BDGR"), ("C", "CD"), ("D", "BDGR")):
        assert_allclose(forces.force(pin, on=on), own[pin], rtol=0, atol=1e-10 * largest)
    assert_allclose(forces.force("F", on="lift"), -thrust * own["EF"], rtol=0, atol=1e-9 * thrust)
    assert_allclose(forces.force("F", on="relief"), -ground["push"] * own["KF"], rtol=1e-11, atol=1e-8)
    assert_allclose(on_pin(forces, "F", "AFB"), thrust * own["EF"] + ground["push"] * own["KF"], rtol=0, atol=1e-9 * largest)
    assert_allclose(on_pin(forces, "K", "frame"), -ground["push"] * own["KF"], rtol=1e-11, atol=1e-8)
    assert forces.residual < 1e-12


def test_pins_that_rub_under_the_shoe():
    """While the links turn up, friction takes from the spring's help: the shoe carries more; while they turn down, less."""
    motion, r, mu = Mower().sweep(6), 0.022, 0.18
    rough = [PinFriction(pin, radius=r, coefficient=mu) for pin in "ABCD"]
    loads = ["lower", "upper", "header", "crop", "relief", "calm", *rough]
    found = {}
    for direction, way in (("extending", 1.0), ("retracting", -1.0)):

        def rubbing(S, way=way):
            couples, push = (0.0,) * 4, on_the_ground(S, 500.0)["push"]
            for _ in range(60):
                own = truth(S, 500.0, push, couples)
                at_pins = [mu * r * np.hypot(*own[pin]) for pin in "ACBD"]
                couples = tuple(way * sense * one for sense, one in zip((-1, -1, 1, 1), at_pins, strict=True))   # the header does not turn
            return own

        found[direction] = over(motion.strokes, rubbing)["R"]
        assert_allclose(reaction(motion, loads, "shoe", drive_force=500.0, direction=direction), found[direction], rtol=1e-9)
    still = over(motion.strokes, lambda S: on_the_ground(S, 500.0))["R"]
    assert np.all(found["extending"] > still) and np.all(still > found["retracting"])


def test_lifting_the_mower_clear_of_the_ground():
    motion, loads = Mower().sweep(9), ["lower", "upper", "header", "relief"]
    own = over(motion.strokes, lifted)
    assert_allclose(Mower.lift.thrust(motion, loads), own["lift"], rtol=1e-11)
    assert_allclose(driving_force(motion, loads), own["lift"], rtol=1e-11)
    assert_allclose(Mower.lift.pressure(motion, loads), np.maximum(own["lift"], 0) / 0.9 / AREA, rtol=1e-10)
    assert_allclose(Mower.circuit.pressure_for(motion, loads), np.maximum(own["lift"], 0) / 0.9 / AREA, rtol=1e-10)
    assert_allclose(Mower.circuit.reserve(motion, loads), 175e5 * AREA * 0.9 / own["lift"], rtol=1e-10)
    most = (175e5 * AREA * 0.9 - own["lift"]) / own["rise"]
    assert_allclose(Mower.circuit.capacity(motion, "G", along=(0, 1), loads=loads), most, rtol=1e-10)
    assert_allclose(Mower.circuit.holding(motion, loads).working, own["lift"] / AREA, rtol=1e-10)
    down = Mower.circuit.lowering(motion, loads)
    assert_allclose(down.working, own["lift"] * 0.9 / AREA, rtol=1e-10)
    assert np.all(down.by_itself)


@pytest.mark.slow
def test_the_verdict_looks_between_the_poses():
    fine = np.linspace(0.0, 0.26, 2001)
    lift = over({"S": fine}, lifted)["lift"]
    least = (175e5 * AREA * 0.9 / lift).min()
    loads = ["lower", "upper", "header", "relief"]
    said = [str(said_of(lift_verdicts(Mower.circuit, Mower().sweep(n), loads), "lifting")) for n in (2, 50)]
    assert said[0] == said[1]
    assert f"{least:.3f}" in said[0]
    use = (3.5 * lift / 0.9 / critical(0.46 + fine, 0.028)).max()
    check = said_of(Mower.lift.checks(Mower().sweep(2), loads), "buckling")
    assert check.ok == (use <= 1.0)
    assert f"safety {3.5 / use:.3g}" in str(check)
