"""A fork-lift's mast: two equal tilt cylinders in parallel and an assist cylinder on the same line, a carriage that runs on the mast."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Cylinder, LiftCircuit, lift_verdicts
from linkage import (
    LEFT,
    RIGHT,
    Dyad,
    Force,
    Ground,
    Guide,
    LinkMass,
    Mechanism,
    OnGuide,
    OnLink,
    PinFriction,
    SliderDyad,
    Stroke,
    Weight,
    bar,
    deg,
    driving_force,
    kN,
    mm,
    pin_forces,
)
from tests.machines.machines_b_truth import beside, cross, meet, over, power, size, slopes, stretch, unit, weight
from tests.mechanisms.free_bodies import FreeBodies


class Mast(Mechanism):
    """Mast OBD on the truck's axle; both kinds of cylinder hold it back. The carriage PQG climbs by h on the line OB."""

    S = Stroke(0.0, 0.20)                                       # tilt cylinders: out is forward
    h = Stroke(0.3, 2.6)                                        # height of the carriage's lower rollers along the mast

    O = Ground(0.0, 0.35)
    A = Ground(-0.85, 0.75)
    C = Ground(-0.80, 0.42)

    B = Dyad(A, O, AB=0.95 + S, OB=1.0, side=LEFT)
    D = OnLink(O, B, OD=0.62, BOD=6 * deg)
    line = Guide(O, B)
    P = OnGuide(line, at=h)
    Q = SliderDyad(P, line, PQ=0.45, side=RIGHT)
    G = OnLink(P, Q, PG=0.80, QPG=-62 * deg)                    # carriage, forks and load

    mast = LinkMass("O B", mass=520, at=(1.1, 0.0))
    load = Weight(G, mass=2600)
    push = Force(G, (1.5 * kN, 0))                              # braking: the load goes on

    tilt = Cylinder(A, B, bore=63 * mm, rod=36 * mm, count=2, works="rod")
    aux = Cylinder(C, D, bore=50 * mm, rod=28 * mm, works="rod")
    circuit = LiftCircuit([tilt, aux], pressure=160 * bar, relief=175 * bar, mechanical_efficiency=0.93)


def place(S, h):
    O, A, C = np.array([0.0, 0.35]), np.array([-0.85, 0.75]), np.array([-0.80, 0.42])
    B = meet(A, 0.95 + S, O, 1.0, left=True)
    D, P = beside(O, B, 0.62, 6 * deg), O + h * unit(O, B)
    Q = P + 0.45 * unit(O, B)
    return {"O": O, "A": A, "C": C, "B": B, "D": D, "P": P, "Q": Q, "G": beside(P, Q, 0.80, -62 * deg), "mast": O + 1.1 * unit(O, B)}


LOADS = [("mast", weight(520)), ("G", weight(2600) + np.array([1500.0, 0.0]))]
AREAS = {"tilt": 2 * np.pi / 4 * (0.063**2 - 0.036**2), "aux": np.pi / 4 * (0.050**2 - 0.028**2)}


def line(S, h):
    """Return the line's pressure [Pa], both thrusts [N] and the force that lifts the carriage [N], by virtual work."""
    at, tilting, lifting = place(S, h), slopes(place, "S", S=S, h=h), slopes(place, "h", S=S, h=h)
    takes = sum(area * stretch(at, tilting, *ends) for area, ends in zip(AREAS.values(), ("AB", "CD"), strict=True))
    pressure = power(tilting, LOADS) / takes                    # the rod side pulls: -p area along the slope of the length
    ratio = stretch(at, tilting, "C", "D")
    return {"p": pressure, "tilt": -pressure * AREAS["tilt"], "aux": -pressure * AREAS["aux"], "chain": -power(lifting, LOADS), "CD": ratio}


def truth(S, h, couples=(0.0, 0.0)):
    """Return the line's pressure, rollers and pins by free bodies; `couples` [Nm] rub on the tilt cylinders at A and at B."""
    at, free = place(S, h), FreeBodies()
    free.pin("O", "mast", "frame", at["O"])
    free.pin("A", "tilt", "frame", at["A"])
    free.pin("B", "mast", "tilt", at["B"])
    pull = unit(at["D"], at["C"]) * AREAS["aux"]
    free._add("p", ("mast", at["D"], pull, 0.0), ("frame", at["C"], -pull, 0.0))
    free.across("P", "carriage", "mast", at["P"], at["B"] - at["O"])
    free.across("Q", "carriage", "mast", at["Q"], at["B"] - at["O"])
    free.along("chain", "carriage", "mast", at["P"], at["B"] - at["O"])
    free.load("mast", at["mast"], weight(520))
    free.load("carriage", at["G"], LOADS[1][1])
    free.load("tilt", at["A"], (0, 0), couples[0])
    free.load("tilt", at["B"], (0, 0), couples[1])
    free.load("mast", at["B"], (0, 0), -couples[1])
    # one more line: along the tilt cylinders' rods their end at B carries the line's pressure
    found = solve_with_axial(free, unit(at["A"], at["B"]))
    pins = {name: np.array([found[f"{name}x"], found[f"{name}y"]]) for name in "OAB"}
    return {**pins, **{name: found[name] for name in ("p", "P", "Q", "chain")}, "OB": unit(at["O"], at["B"]), "DC": unit(at["D"], at["C"])}


def solve_with_axial(free, u):
    """Return the unknowns where B's force on the mast, along the rods, is -p area beside the bodies' equations."""
    rows = 3 * len(free.bodies)
    M, b = np.zeros((rows + 1, len(free.columns))), np.zeros(rows + 1)
    for k, wrenches in enumerate(free.columns):
        for wrench in wrenches:
            free._put(M[:rows, k], wrench)
    for wrench in free.given:
        free._put(b[:rows], wrench)
    names = free.names
    M[rows, names.index("Bx")], M[rows, names.index("By")], M[rows, names.index("p")] = u[0], u[1], AREAS["tilt"]
    return dict(zip(names, np.linalg.solve(M, -b), strict=True))


PATH = {"S": np.linspace(0.02, 0.18, 7), "h": np.linspace(2.5, 0.4, 7)}         # tilted forward and let down at once


def test_where_everything_is():
    motion = Mast().at(**PATH)
    own = over(PATH, place)
    for name in "BDPQG":
        assert_allclose(motion[name], own[name], rtol=0, atol=1e-13)
    assert Mast().mobility == 2


def test_two_cylinders_share_one_pressure():
    motion, own = Mast().at(**PATH), over(PATH, line)
    assert own["p"].min() > 0
    for cylinder, name in ((Mast.tilt, "tilt"), (Mast.aux, "aux")):
        assert_allclose(cylinder.thrust(motion), own[name], rtol=1e-11)
        assert_allclose(cylinder.pressure(motion), own["p"] / 0.93, rtol=1e-10)        # the losses of its circuit count
    assert_allclose(driving_force(motion, drive="S"), own["tilt"] + own["aux"] * own["CD"], rtol=1e-11)
    assert_allclose(driving_force(motion, drive="h"), own["chain"], rtol=1e-11)
    forces = pin_forces(motion)
    assert_allclose(forces.thrusts["tilt"], own["tilt"], rtol=1e-11)
    assert_allclose(forces.thrusts["aux"], own["aux"], rtol=1e-11)
    assert_allclose(forces.drives["h"], own["chain"], rtol=1e-11)


def test_every_pin_and_the_rollers():
    own, forces = over(PATH, truth), pin_forces(Mast().at(**PATH))
    largest = np.abs(own["O"]).max()
    assert_allclose(own["p"], over(PATH, line)["p"], rtol=1e-10)
    assert_allclose(forces.force("O", on="OBD"), own["O"], rtol=0, atol=1e-11 * largest)
    assert_allclose(forces.force("B", on="OBD"), own["B"], rtol=0, atol=1e-11 * largest)
    assert_allclose(forces.force("A", on="tilt"), own["A"], rtol=0, atol=1e-11 * largest)
    assert_allclose(forces.force("D", on="OBD"), AREAS["aux"] * own["p"] * own["DC"], rtol=0, atol=1e-11 * largest)
    assert_allclose(forces.force("C", on="frame"), -AREAS["aux"] * own["p"] * own["DC"], rtol=0, atol=1e-11 * largest)
    along, across = own["OB"], np.stack([-own["OB"][1], own["OB"][0]])
    assert_allclose(forces.force("Q", on="PQG"), own["Q"] * across, rtol=0, atol=1e-11 * largest)
    assert_allclose(forces.force("P", on="PQG"), own["P"] * across + own["chain"] * along, rtol=0, atol=1e-11 * largest)
    assert forces.residual < 1e-12


def test_the_tilt_cylinders_rub_in_their_pins():
    """With couples at its ends the cylinder is a body: its ends push across as well, the pressure goes by the part along the rods."""
    r, mu = 0.020, 0.16
    rough = [PinFriction("A", radius=r, coefficient=mu), PinFriction("B", radius=r, coefficient=mu)]
    motion = Mast().at(**PATH)
    tangent = {name: (values[-1] - values[0]) for name, values in PATH.items()}
    for direction, way in (("extending", 1.0), ("retracting", -1.0)):

        def rubbing(S, h, way=way):
            at, slope = place(S, h), slopes(place, "S", S=S, h=h)
            turning = [cross(at[b] - at[a], slope[b] - slope[a]) / size(at[b] - at[a]) ** 2 * tangent["S"] for a, b in ("AB", "OB")]
            couples = (0.0, 0.0)
            for _ in range(60):
                found = truth(S, h, couples)
                couples = (
                    -way * np.sign(turning[0]) * mu * r * np.hypot(*found["A"]),
                    -way * np.sign(turning[0] - turning[1]) * mu * r * np.hypot(*found["B"]),
                )
            return found

        own = over(PATH, rubbing)
        forces = pin_forces(motion, ["mast", "load", "push", *rough], direction=direction)
        assert_allclose(forces.thrusts["aux"], -AREAS["aux"] * own["p"], rtol=1e-9)
        assert_allclose(forces.thrusts["tilt"], -AREAS["tilt"] * own["p"], rtol=1e-9)
        assert_allclose(forces.force("B", on="OBD"), own["B"], rtol=1e-9, atol=1e-5)
        assert_allclose(forces.force("O", on="OBD"), own["O"], rtol=1e-9, atol=1e-5)


def test_lifted_against_the_pump_and_held_against_the_relief_valve():
    motion, own = Mast().at(**PATH), over(PATH, line)
    assert_allclose(Mast.circuit.pressure_for(motion), own["p"] / 0.93, rtol=1e-10)
    assert_allclose(Mast.circuit.reserve(motion), 160e5 * 0.93 / own["p"], rtol=1e-10)
    for cylinder in ("tilt", "aux"):
        assert_allclose(Mast.circuit.holding(motion, cylinder=cylinder).working, own["p"], rtol=1e-10)
    assert_allclose(Mast.circuit.holding(motion).working, own["p"], rtol=1e-10)         # one line, one pressure


@pytest.mark.slow
def test_the_verdicts_of_the_line():
    motion = Mast().at(**PATH)
    t = np.linspace(0.0, 1.0, 301)
    fine = over({"S": 0.02 + 0.16 * t, "h": 2.5 - 2.1 * t}, line)
    said = {each.rule: each for each in lift_verdicts(Mast.circuit, motion)}
    for name in ("tilt", "aux"):
        assert said[f"lifting {name}"].ok == (fine["p"].max() / 0.93 <= 160e5)
        assert said[f"holding {name}"].ok == (fine["p"].max() <= 175e5)
        assert f"{(160e5 * 0.93 / fine['p']).min():.3f}" in str(said[f"lifting {name}"])
        assert f"{fine['p'].max() / 1e5:.4g} bar" in str(said[f"holding {name}"])
    ends = [place(0.02, 2.5), place(0.18, 0.4)]
    travel = [abs(size(b[q] - b[p]) - size(a[q] - a[p])) for p, q in ("AB", "CD") for a, b in [ends]]
    assert_allclose(Mast.circuit.oil(motion), travel @ np.array(list(AREAS.values())), rtol=1e-9)
    for cylinder in (Mast.tilt, Mast.aux):
        assert all(each.ok for each in cylinder.checks(motion) if each.rule == "buckling")         # they only pull
