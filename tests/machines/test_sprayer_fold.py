"""A sprayer's boom that folds: a cylinder beside the hinge passes its dead centre; a gas strut, a chain that only pulls, a bump stop."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Cylinder, LiftCircuit, lift_verdicts
from linkage import (
    LEFT,
    Actuator,
    Between,
    Crank,
    Dyad,
    Ground,
    LinkMass,
    Mechanism,
    OnLink,
    SingularError,
    Stroke,
    Weight,
    bar,
    deg,
    driving_force,
    mm,
    pin_forces,
)
from tests.machines.machines_b_truth import beside, meet, over, polar, power, said_of, size, slopes, stretch, unit, weight
from tests.mechanisms.free_bodies import FreeBodies


def gas(length, rate):
    """Return the push of the gas strut [N], isothermal, with the oil's damping."""
    return 1900.0 / (1.0 - (1.40 - length) / 2.5) - 350.0 * rate


def chain(length, rate):
    """Return the pull of a chain of 4.03 m [N]: none while it hangs."""
    return -2e5 * np.maximum(length - 4.03, 0.0)


def rubber(length, rate):
    """Return the push of the stop [N] under the folded boom."""
    return 6e4 * np.maximum(0.55 - length, 0.0)


class Boom(Mechanism):
    """Inner section OH on the frame, outer section HVT that the rod RV folds; phi is the inner section's angle from the x axis."""

    phi = Stroke(-2 * deg, 150 * deg)

    O = Ground(0.0, 0.0)
    A = Ground(-0.55, -0.35)                                # foot of the cylinder
    R = Ground(0.10, 0.33)
    M = Ground(-0.20, 2.20)                                 # mast, where the chain hangs
    F = Ground(-0.40, 0.50)                                 # foot of the gas strut
    X = Ground(-2.20, 0.90)                                 # rest of the folded boom

    H = Crank(O, OH=4.0, angle=phi)
    C = OnLink(O, H, OC=0.38, HOC=-20 * deg)                # the cylinder's lug
    K = OnLink(O, H, OK=3.2)
    J = OnLink(O, H, OJ=0.90, HOJ=5 * deg)
    Y = OnLink(O, H, OY=2.0)
    V = Dyad(R, H, RV=3.98, HV=0.46, side=LEFT)
    T = OnLink(H, V, HT=1.6, VHT=-80 * deg)                 # the outer section's centre of gravity

    inner = LinkMass("O H", mass=150, at=(1.9, 0.05))
    rod = LinkMass("R V", mass=14)
    outer = Weight(T, mass=70)
    strut = Between(F, J, gas)
    hanger = Between(M, K, chain)
    stop = Between(X, Y, rubber)


class Fold(Boom):
    """The boom with its cylinder."""

    lift = Cylinder("A", "C", bore=125 * mm, rod=70 * mm, works="both")
    circuit = LiftCircuit(lift, pressure=210 * bar, relief=230 * bar)


def place(phi):
    O, A, R, M, F, X = (np.array(p) for p in ([0.0, 0.0], [-0.55, -0.35], [0.10, 0.33], [-0.20, 2.20], [-0.40, 0.50], [-2.20, 0.90]))
    H = polar(4.0, phi)
    V = meet(R, 3.98, H, 0.46, left=True)
    return {
        "O": O, "A": A, "R": R, "M": M, "F": F, "X": X, "H": H, "V": V, "C": polar(0.38, phi - 20 * deg), "K": polar(3.2, phi),
        "J": polar(0.90, phi + 5 * deg), "Y": polar(2.0, phi), "T": beside(H, V, 1.6, -80 * deg),
        "inner": polar(1.9, phi) + polar(0.05, phi + np.pi / 2), "rod": (R + V) / 2,
    }  # fmt: skip


WEIGHTS = [("inner", weight(150)), ("rod", weight(14)), ("T", weight(70))]
ENDS = {"strut": ("F", "J"), "hanger": ("M", "K"), "stop": ("X", "Y")}
DEAD = np.arctan2(0.35, 0.55) + 20 * deg                    # A, O and C in one line: the cylinder is at its longest


def elements(phi, speed=0.0):
    """Return the thrusts of strut, chain and stop [N] while phi grows with a speed [rad/s]."""
    at, slope = place(phi), slopes(place, "phi", phi=phi)
    long = {name: size(at[Q] - at[P]) for name, (P, Q) in ENDS.items()}
    out = stretch(at, slope, "F", "J") * speed
    return {
        "strut": 1900.0 / (1.0 - (1.40 - long["strut"]) / 2.5) - 350.0 * out,
        "hanger": -2e5 * max(long["hanger"] - 4.03, 0.0),
        "stop": 6e4 * max(0.55 - long["stop"], 0.0),
    }


def work(phi, speed=0.0):
    """Return the torque that the hinge needs [Nm] and how the cylinder's length follows the hinge [m/rad]."""
    at, slope, given = place(phi), slopes(place, "phi", phi=phi), elements(phi, speed)
    done = power(slope, WEIGHTS) + sum(given[name] * stretch(at, slope, *ends) for name, ends in ENDS.items())
    return {"M": -done, "arm": stretch(at, slope, "A", "C"), **given}


def truth(phi):
    """Return the cylinder's thrust and the pin forces by free bodies."""
    at, given, free = place(phi), elements(phi), FreeBodies()
    free.pin("O", "inner", "frame", at["O"])
    free.pin("H", "outer", "inner", at["H"])
    free.pin("V", "rod", "outer", at["V"])
    free.pin("R", "rod", "frame", at["R"])
    free.thrust("lift", "frame", at["A"], "inner", at["C"])
    for name, (P, Q) in ENDS.items():
        free.load("inner", at[Q], given[name] * unit(at[P], at[Q]))
    for body, (point, force) in zip(("inner", "rod", "outer"), WEIGHTS, strict=True):
        free.load(body, at[point], force)
    found = free.solve()
    pins = {name: np.array([found[f"{name}x"], found[f"{name}y"]]) for name in "OHVR"}
    return {**pins, "lift": found["lift"], "AC": unit(at["A"], at["C"]), "FJ": unit(at["F"], at["J"]), "MK": unit(at["M"], at["K"])}


ANGLES = np.array([-2.0, 0.0, 20.0, 40.0, 65.0, 90.0, 120.0, 145.0, 150.0]) * deg


def test_where_everything_is_and_at_the_dead_centre():
    machine = Fold()
    assert machine.mobility == 1
    angles = np.sort(np.append(ANGLES, DEAD))
    motion, own = machine.at(phi=angles), over({"phi": angles}, place)
    for name in "HCKJYVT":
        assert_allclose(motion[name], own[name], rtol=0, atol=1e-13)
    assert_allclose(motion.distance("A", "C").max(), 0.38 + np.hypot(0.55, 0.35), rtol=1e-14)


def test_the_torque_at_the_hinge_is_finite_everywhere():
    angles = np.sort(np.append(ANGLES, DEAD))
    own = over({"phi": angles}, work)
    assert_allclose(driving_force(Fold().at(phi=angles)), own["M"], rtol=1e-11)
    assert (own["hanger"] < 0).any() and (own["hanger"] == 0).any() and (own["stop"] > 0).any()
    fast = over({"phi": angles}, lambda phi: work(phi, 0.3))
    assert_allclose(driving_force(Fold().at(phi=angles), rates=dict(phi=0.3)), fast["M"], rtol=1e-11)


def test_the_cylinder_holds_beside_the_hinge():
    motion = Fold().at(phi=ANGLES)
    own, by_work = over({"phi": ANGLES}, truth), over({"phi": ANGLES}, work)
    assert_allclose(own["lift"], by_work["M"] / by_work["arm"], rtol=1e-11)
    assert_allclose(Fold.lift.thrust(motion), own["lift"], rtol=1e-11)
    forces = pin_forces(motion)
    largest = np.abs(own["O"]).max()
    assert_allclose(forces.drives["phi"], by_work["M"], rtol=1e-10)           # what the stroke asks for, and the cylinder gives
    assert all(np.abs(each.couple).max() < 1e-9 * largest for each in forces.joints if each.kind == "crank")
    for pin, on in (("O", "OHCKJY"), ("H", "HVT"), ("V", "RV"), ("R", "RV")):
        assert_allclose(forces.force(pin, on=on), own[pin], rtol=0, atol=1e-11 * largest)
    assert_allclose(forces.force("C", on="lift"), -own["lift"] * own["AC"], rtol=0, atol=1e-11 * largest)
    assert_allclose(forces.force("A", on="lift"), own["lift"] * own["AC"], rtol=0, atol=1e-11 * largest)
    assert_allclose(forces.force("J", on="OHCKJY"), by_work["strut"] * own["FJ"], rtol=0, atol=1e-11 * largest)
    assert_allclose(forces.force("M", on="frame"), -by_work["hanger"] * own["MK"], rtol=0, atol=1e-11 * largest)
    for name in ENDS:
        assert_allclose(forces.thrusts[name], by_work[name], rtol=1e-12, atol=1e-9)
    assert forces.residual < 1e-12


def test_a_given_force_in_the_cylinders_place_leaves_nothing_to_the_hinge():
    own = over({"phi": ANGLES}, truth)
    motion = Boom().at(phi=ANGLES)
    forces = pin_forces(motion, ["inner", "rod", "outer", "strut", "hanger", "stop", Actuator("A", "C", force=own["lift"])])
    largest = np.abs(own["O"]).max()
    assert_allclose(forces.force("O", on="OHCKJY"), own["O"], rtol=0, atol=1e-11 * largest)
    assert_allclose(forces.force("H", on="HVT"), own["H"], rtol=0, atol=1e-11 * largest)
    assert_allclose(forces.drives["phi"], 0.0, atol=1e-10 * largest)


def test_the_dead_centre_is_refused_by_name_and_told():
    motion = Fold().at(phi=np.array([20 * deg, DEAD]))
    with pytest.raises(SingularError, match="lift") as caught:
        Fold.lift.thrust(motion)
    assert_allclose(caught.value.mask, [False, True])
    with pytest.raises(SingularError, match="lift"):
        pin_forces(motion)


def test_the_limits_tell_the_dead_centre():
    said = " ".join(str(Fold().sweep(7).limits()).split())
    assert "lift" in said
    assert f"{DEAD / deg:.2f}"[:4] in said


@pytest.mark.slow
def test_pressures_on_both_sides_and_the_fullest_between_the_poses():
    angles = np.linspace(90 * deg, 150 * deg, 5)
    motion, own = Fold().at(phi=angles), over({"phi": angles}, truth)
    piston, annulus = np.pi / 4 * 0.125**2, np.pi / 4 * (0.125**2 - 0.070**2)
    pressure = np.where(own["lift"] > 0, own["lift"] / piston, -own["lift"] / annulus)
    assert_allclose(Fold.lift.pressure(motion), pressure, rtol=1e-10)
    assert_allclose(Fold.circuit.reserve(motion), 210e5 / pressure, rtol=1e-10)
    said = [str(said_of(lift_verdicts(Fold.circuit, Fold().at(phi=np.linspace(90 * deg, 150 * deg, n))), "lifting")) for n in (2, 50)]
    assert said[0] == said[1]
    fine = over({"phi": np.linspace(90 * deg, 150 * deg, 2001)}, work)
    thrust = fine["M"] / fine["arm"]
    least = (210e5 / np.where(thrust > 0, thrust / piston, -thrust / annulus)).min()
    assert f"{least:.2f}" in said[0] or f"{least:.3f}" in said[0]
