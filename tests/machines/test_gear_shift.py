"""A gear-shift lever: rods to a selector arm and a shift rail, and two springs on one pin that pull the lever back."""

import numpy as np
from numpy.testing import assert_allclose

from linkage import (
    LEFT,
    RIGHT,
    Actuator,
    Crank,
    Dyad,
    Force,
    Ground,
    Guide,
    LinkMass,
    Mechanism,
    OnLink,
    SliderDyad,
    Spring,
    Stroke,
    Weight,
    deg,
    drawn,
    driving_force,
    pin_forces,
)
from tests.machines.machines_b_truth import beside, meet, on_pin, over, polar, power, size, slopes, stretch, unit, weight
from tests.mechanisms.free_bodies import FreeBodies


class GearShift(Mechanism):
    """Lever HOB; rod BC turns the arm CDE; from C another rod goes to the rail's pin Q. The springs EF and EJ sit on one pin."""

    phi = Stroke(72 * deg, 108 * deg)                       # the lever's hand, from the x axis
    sketch = drawn(phi=90 * deg)

    O = Ground(0.0, 0.0)
    D = Ground(0.25, -0.20)                                 # the selector arm's pivot
    F = Ground(0.345, -0.36)
    J = Ground(0.155, -0.37)
    rail = Guide((0.25, -0.13), angle=-4 * deg)

    H = Crank(O, OH=0.32, angle=phi)
    B = OnLink(O, H, OB=0.09, HOB=180 * deg)
    C = Dyad(B, D, BC=0.26, DC=0.10, side=LEFT)
    E = OnLink(D, C, DE=0.07, CDE=176 * deg)
    Q = SliderDyad(C, rail, CQ=0.18, side=RIGHT)            # the shift rail's pin

    lever = LinkMass("H O B", mass=0.9, at=(0.18, 0.0))
    knob = Weight(H, mass=0.25)
    rod = LinkMass("B C", mass=0.4)
    arm = LinkMass("C D", mass=0.5)
    far = LinkMass("C Q", mass=0.3)
    gear = Force(Q, (-260, 18))                             # what the synchroniser resists with
    right = Spring(E, F, stiffness=4200, free_length=0.118)
    left = Spring(J, E, stiffness=3600, preload=95)         # pulls with 95 N while the lever is upright


def place(phi):
    O, D, F, J = (np.array(each) for each in ([0.0, 0.0], [0.25, -0.20], [0.345, -0.36], [0.155, -0.37]))
    H, B = polar(0.32, phi), -polar(0.09, phi)
    C = meet(B, 0.26, D, 0.10, left=True)
    E = beside(D, C, 0.07, 176 * deg)
    start, e = np.array([0.25, -0.13]), polar(1.0, -4 * deg)
    away = C - start
    off = e[0] * away[1] - e[1] * away[0]
    Q = start + (e @ away + np.sqrt(0.18**2 - off * off)) * e
    lever = O + 0.14 * unit(O, H)                           # 0.18 m from H towards O
    return {"O": O, "D": D, "F": F, "J": J, "H": H, "B": B, "C": C, "E": E, "Q": Q, "lever": lever,
            "rod": (B + C) / 2, "arm": (C + D) / 2, "far": (C + Q) / 2}  # fmt: skip


GEAR = np.array([-260.0, 18.0])
LOADS = [("lever", weight(0.9)), ("H", weight(0.25)), ("rod", weight(0.4)), ("arm", weight(0.5)), ("far", weight(0.3)), ("Q", GEAR)]
DRAWN = float(size(place(90 * deg)["E"] - place(90 * deg)["J"]))


def springs(at):
    """Return the thrusts [N]: negative while they pull."""
    return {"right": 4200 * (0.118 - size(at["F"] - at["E"])), "left": -95.0 - 3600 * (size(at["E"] - at["J"]) - DRAWN)}


def torque(phi):
    """Return what the hand must give [Nm]."""
    at, slope = place(phi), slopes(place, "phi", phi=phi)
    given = springs(at)
    done = power(slope, LOADS) + given["right"] * stretch(at, slope, "E", "F") + given["left"] * stretch(at, slope, "J", "E")
    return {"M": -done, **given}


def truth(phi):
    """Return the pin forces and the hand's torque by free bodies."""
    at = place(phi)
    given, free = springs(at), FreeBodies()
    free.pin("O", "lever", "frame", at["O"])
    free.torque("M", "lever", "frame")
    free.pin("B", "rod", "lever", at["B"])
    free.pin("C", "arm", "rod", at["C"])                    # the pin at C sits in the arm: both rods push it there
    free.pin("far", "far", "arm", at["C"])
    free.pin("D", "arm", "frame", at["D"])
    free.across("Q", "far", "frame", at["Q"], polar(1.0, -4 * deg))
    for body, (point, force) in zip(("lever", "lever", "rod", "arm", "far", "far"), LOADS, strict=True):
        free.load(body, at[point], force)
    free.load("arm", at["E"], given["right"] * unit(at["F"], at["E"]) + given["left"] * unit(at["J"], at["E"]))
    found = free.solve()
    pins = {name: np.array([found[f"{name}x"], found[f"{name}y"]]) for name in ("O", "B", "C", "D", "far")}
    return {**pins, "M": found["M"], "Q": found["Q"], "to F": unit(at["E"], at["F"]), "to J": unit(at["E"], at["J"]), **given}


def test_where_everything_is():
    motion = GearShift().sweep(11)
    own = over(motion.strokes, place)
    for name in "HBCEQ":
        assert_allclose(motion[name], own[name], rtol=0, atol=1e-14)
    assert GearShift().mobility == 1


def test_the_hands_torque():
    motion = GearShift().sweep(11)
    work, own = over(motion.strokes, torque), over(motion.strokes, truth)
    assert_allclose(work["M"], own["M"], rtol=1e-11)
    assert_allclose(driving_force(motion), own["M"], rtol=1e-11)
    assert_allclose(pin_forces(motion).drives["phi"], own["M"], rtol=1e-11)


def test_the_preload_is_the_pull_where_the_sketch_is_drawn():
    forces = pin_forces(GearShift().at(phi=90 * deg))
    assert_allclose(forces.thrusts["left"], -95.0, rtol=1e-12)
    assert_allclose(pin_forces(GearShift().sweep(11)).thrusts["left"], over(GearShift().sweep(11).strokes, torque)["left"], rtol=1e-12)


def test_every_pin():
    motion = GearShift().sweep(11)
    own, forces = over(motion.strokes, truth), pin_forces(motion)
    for pin, on, name in (("O", "OHB", "O"), ("B", "BC", "B"), ("D", "DCE", "D")):
        assert_allclose(forces.force(pin, on=on), own[name], rtol=1e-10, atol=1e-9)
    for on, force in (("BC", -own["C"]), ("CQ", own["far"]), ("DCE", own["C"] - own["far"])):      # three bodies at one pin
        assert_allclose(on_pin(forces, "C", on), force, rtol=1e-10, atol=1e-9)
    assert_allclose(np.hypot(*forces.force("Q")), np.abs(own["Q"]), rtol=1e-10)
    for name, direction in (("right", own["to F"]), ("left", own["to J"])):
        assert_allclose(forces.force("E", on=name), own[name] * direction, rtol=1e-11, atol=1e-10)       # on the spring: it is pulled back
    assert_allclose(forces.force("F", on="frame"), own["right"] * own["to F"], rtol=1e-11, atol=1e-10)
    assert forces.residual < 1e-12


def test_two_given_forces_in_place_of_the_springs():
    motion = GearShift().sweep(11)
    given = over(motion.strokes, torque)
    rest = ["lever", "knob", "rod", "arm", "far", "gear"]
    whole = pin_forces(motion)
    same = pin_forces(motion, [*rest, Actuator("E", "F", force=given["right"]), Actuator("J", "E", force=given["left"])])
    for pin, on in (("O", "OHB"), ("B", "BC"), ("D", "DCE")):
        assert_allclose(same.force(pin, on=on), whole.force(pin, on=on), rtol=1e-11, atol=1e-9)
    assert_allclose(on_pin(same, "C", "CQ"), on_pin(whole, "C", "CQ"), rtol=1e-11, atol=1e-9)
    assert_allclose(same.drives["phi"], whole.drives["phi"], rtol=1e-11)


def test_the_springs_pull_the_lever_back():
    """The torque of the springs alone is the slope of what they store, and over the middle it changes its sense."""
    motion = GearShift().sweep(11)
    alone = driving_force(motion, ["right", "left"])

    def stored(phi):
        at = place(phi)
        x, y = size(at["F"] - at["E"]) - 0.118, size(at["E"] - at["J"]) - (DRAWN - 95 / 3600)
        return 0.5 * 4200 * x**2 + 0.5 * 3600 * y**2

    slope = [np.imag(stored(phi + 1j * 1e-30)) / 1e-30 for phi in motion.strokes["phi"]]
    assert alone.min() < 0 < alone.max()
    assert_allclose(alone, slope, rtol=1e-11, atol=1e-12)
