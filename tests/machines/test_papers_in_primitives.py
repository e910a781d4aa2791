"""The three papers' machines in the vector method's own primitives, line by line as printed, and the links that hold them.

A driven link of two points, `Link("A B", AB=L0 + S)`, is the cylinder, as it is in the composite spelling.
"""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Accumulator, AccumulatorBlock, Cylinder, FloatCircuit, isothermal
from linkage import (
    CosineAngle,
    Dimension,
    Ground,
    Link,
    Mechanism,
    Offset,
    Stroke,
    Support,
    Turn,
    Vector,
    Weight,
    deg,
    driving_force,
    kgf,
    kgf_cm2,
    litre,
    mm,
    pin_forces,
    reaction,
)
from linkage.units import g0
from mechanisms.header_balancer import HeaderBalancer
from mechanisms.mower_lift import MowerLift
from mechanisms.three_point_hitch import ThreePointHitch
from tests.machines.machines_b_truth import beside, meet, on_pin, over, power, slopes, unit, weight
from tests.mechanisms.free_bodies import FreeBodies


class PrintedHitch(Mechanism):
    """Dyuzhev, Kotov, Chuprynin (2008), (4) to (26); in (14) EC, which (15) uses."""

    S = Stroke(0.00, 0.25)
    L0_AB, L_OB, L_OC, L_BC = Dimension(0.50), Dimension(0.30), Dimension(0.36), Dimension(0.16)
    L_ED, L_CD, L_EF = Dimension(0.48), Dimension(0.62), Dimension(0.95)
    L_MK, L_KF, L_FG, KFG = Dimension(0.88), Dimension(0.685), Dimension(0.90), Dimension(75 * deg, unit="deg")

    A, O, E, M = Ground(0.20, 0.55), Ground(0.30, 1.15), Ground(0.25, 0.60), Ground(0.22, 1.05)

    L_AB = L0_AB + S                                    # (4)
    AO = Vector(A, O)                                   # (5)
    OAB = CosineAngle(abs(AO), L_AB, L_OB)              # (6)
    AB = Turn(AO, -OAB, length=L_AB)                    # (7)
    B = Offset(A, AB)                                   # (8)
    OB = Vector(O, B)                                   # (9)
    COB = CosineAngle(L_OB, L_OC, L_BC)                 # (10)
    OC = Turn(OB, COB, length=L_OC)                     # (11)
    C = Offset(O, OC)                                   # (12)
    EC = Vector(E, C)                                   # (14)
    CED = CosineAngle(abs(EC), L_ED, L_CD)              # (15)
    ED = Turn(EC, -CED, length=L_ED)                    # (16)
    D = Offset(E, ED)                                   # (17)
    EF = Turn(ED, 0, length=L_EF)                       # (18)
    F = Offset(E, EF)                                   # (19)
    MF = Vector(M, F)                                   # (20)
    FMK = CosineAngle(abs(MF), L_MK, L_KF)              # (21)
    MK = Turn(MF, FMK, length=L_MK)                     # (22)
    K = Offset(M, MK)                                   # (23)
    FK = Vector(F, K)                                   # (24)
    FG = Turn(FK, -KFG, length=L_FG)                    # (25)
    G = Offset(F, FG)                                   # (26)

    cylinder = Link("A B", AB=L0_AB + S)
    arm, rod, lower = Link(O, B, C), Link(C, D), Link(E, D, F)
    upper, implement = Link(M, K), Link(F, K, G)
    load = Weight(G, mass=2000)


class PrintedBalancer(Mechanism):
    """Rekhlitski, Chuprynin (2013), (4) to (16): from O to B, and the constant angles from there."""

    h = Stroke(0.0, 0.45)
    L_min, L_OB, L_OR, BOR = Dimension(0.70), Dimension(0.930054), Dimension(2.040833), Dimension(5.290081 * deg, unit="deg")
    L_OG1, BOG1, L_OG2, BOG2 = Dimension(0.488774), Dimension(5.491118 * deg), Dimension(1.436851), Dimension(18.840343 * deg)

    O, A = Ground(0.0, 1.05), Ground(-0.05, 0.30)

    L_AB = L_min + h                                    # (4)
    OA = Vector(O, A)                                   # (5)
    AOB = CosineAngle(abs(OA), L_OB, L_AB)              # (6)
    OB = Turn(OA, AOB, length=L_OB)                     # (7)
    OR = Turn(OB, BOR, length=L_OR)                     # (8)
    OG1 = Turn(OB, BOG1, length=L_OG1)
    OG2 = Turn(OB, BOG2, length=L_OG2)
    B, R, G1, G2 = Offset(O, OB), Offset(O, OR), Offset(O, OG1), Offset(O, OG2)
    AB = Vector(A, B)                                   # (16)

    cylinder = Link("A B", AB=L_min + h)
    swing = Link(O, B, R, G1, G2)
    feeder, header = Weight(G1, mass=1500), Weight(G2, mass=1000)
    shoe = Support(R, (0, 1))


class PrintedMowerLift(Mechanism):
    """The KPR-6 worksheet: FIS at O between AO and the lever, FI3 = pi + FI0 + FIS, G under FIS3 from the lever."""

    S = Stroke(0.55, 0.80)
    L3, LS3, FIS3 = Dimension(0.175), Dimension(np.hypot(1.07, 0.37)), Dimension(129.5 * deg + np.arctan2(-0.37, 1.07), unit="deg")

    A, O = Ground(0.0, 0.242), Ground(0.652, 0.330)
    OA = Vector(O, A)                                   # under pi + FI0
    FIS = CosineAngle(abs(OA), L3, S)
    OB = Turn(OA, FIS, length=L3)
    B = Offset(O, OB)
    OG = Turn(OB, FIS3, length=LS3)
    G = Offset(O, OG)

    cylinder = Link("A B", AB=0.0 + S)
    lever = Link(O, B, G)
    load = Weight(G, mass=900 * kgf / g0)


TWINS = {
    "hitch": (PrintedHitch, ThreePointHitch, ["load"]),
    "balancer": (PrintedBalancer, HeaderBalancer, ["feeder", "header"]),
    "mower lift": (PrintedMowerLift, MowerLift, ["load"]),
}
BODIES = {"hitch": ("OBC", "CD", "EDF", "MK", "FKG"), "balancer": ("OBRG1G2",), "mower lift": ("OBG",)}
twins = pytest.mark.parametrize("which", list(TWINS))


def declared(machine):
    """Return the sets of points that move as one."""
    return {frozenset(each.points) for each in machine.links}


@twins
def test_the_same_machine_in_both_spellings(which):
    printed, composite, _ = TWINS[which]
    one, other = printed(), composite()
    assert one.mobility == other.mobility == 1
    assert one.gruebler == other.gruebler
    assert declared(one) == declared(other)
    mine, theirs = one.sweep(11), other.sweep(11)
    for name in other.plan.points:
        assert_allclose(mine[name], theirs[name], rtol=0, atol=1e-14)
        assert_allclose(mine.ratio(name), theirs.ratio(name), rtol=0, atol=1e-11)


@twins
def test_the_same_forces_in_both_spellings(which):
    printed, composite, loads = TWINS[which]
    mine, theirs = (pin_forces(machine().sweep(11), loads) for machine in (printed, composite))
    for body in BODIES[which]:
        one, other = mine.on_body(body), theirs.on_body(body)
        largest = max(np.abs(force).max() for force in other.values())
        assert set(one) == set(other)
        for point in one:
            assert_allclose(one[point], other[point], rtol=0, atol=1e-11 * largest)
    (drive,) = mine.drives
    assert_allclose(mine.drives[drive], theirs.drives[drive], rtol=1e-10)
    assert_allclose(driving_force(mine.motion), driving_force(theirs.motion, loads), rtol=1e-11)
    assert mine.residual < 1e-12


# -- each by hand ------------------------------------------------------------------------------------------


def hitch(S):
    """Return the hitch's points with compasses: (4) to (26) without an angle."""
    A, O, E, M = (np.array(each) for each in ([0.20, 0.55], [0.30, 1.15], [0.25, 0.60], [0.22, 1.05]))
    B = meet(A, 0.50 + S, O, 0.30, left=False)
    C = meet(O, 0.36, B, 0.16, left=True)
    D = meet(E, 0.48, C, 0.62, left=False)
    F = E + 0.95 * unit(E, D)
    K = meet(M, 0.88, F, 0.685, left=True)
    return {"A": A, "O": O, "E": E, "M": M, "B": B, "C": C, "D": D, "F": F, "K": K, "G": beside(F, K, 0.90, -75 * deg)}


def hitch_forces(S):
    """Return thrust and pins of the hitch by free bodies."""
    at, free = hitch(S), FreeBodies()
    free.thrust("AB", "frame", at["A"], "OBC", at["B"])
    for pin, on, by in (
        ("O", "OBC", "frame"), ("C", "CD", "OBC"), ("D", "EDF", "CD"), ("E", "EDF", "frame"), ("F", "FKG", "EDF"), ("K", "FKG", "MK"),
        ("M", "MK", "frame"),
    ):  # fmt: skip
        free.pin(pin, on, by, at[pin])
    free.load("FKG", at["G"], weight(2000))
    found = free.solve()
    pins = {name: np.array([found[f"{name}x"], found[f"{name}y"]]) for name in "OCDEFKM"}
    return {**pins, "AB": found["AB"], "u": unit(at["A"], at["B"]), "work": -power(slopes(hitch, "S", S=S), [("G", weight(2000))])}


def test_the_hitch_by_hand():
    motion = PrintedHitch().sweep(11)
    places, own, forces = over(motion.strokes, hitch), over(motion.strokes, hitch_forces), pin_forces(motion)
    for name in "BCDFKG":
        assert_allclose(motion[name], places[name], rtol=0, atol=1e-14)
    assert_allclose(own["AB"], own["work"], rtol=1e-11)
    assert_allclose(forces.thrusts["AB"], own["AB"], rtol=1e-11)
    largest = np.abs(own["O"]).max()
    for pin, on in (("O", "OBC"), ("C", "CD"), ("D", "EDF"), ("E", "EDF"), ("F", "FKG"), ("K", "FKG"), ("M", "MK")):
        assert_allclose(forces.force(pin, on=on), own[pin], rtol=0, atol=1e-11 * largest)
    assert_allclose(forces.force("B", on="OBC"), own["AB"] * own["u"], rtol=0, atol=1e-11 * largest)
    assert_allclose(forces.force("A", on="frame"), -own["AB"] * own["u"], rtol=0, atol=1e-11 * largest)


def lever(S):
    """Return the mower lift's points."""
    A, O = np.array([0.0, 0.242]), np.array([0.652, 0.330])
    B = meet(A, S, O, 0.175, left=False)
    return {"A": A, "O": O, "B": B, "G": beside(O, B, np.hypot(1.07, 0.37), 129.5 * deg + np.arctan2(-0.37, 1.07))}


def test_the_mower_lift_by_hand():
    motion = PrintedMowerLift().sweep(11)
    places, forces = over(motion.strokes, lever), pin_forces(motion)
    P = np.array([0.0, -900 * kgf])
    thrust = over(motion.strokes, lambda S: {"AB": -power(slopes(lever, "S", S=S), [("G", P)])})["AB"]
    for name in "BG":
        assert_allclose(motion[name], places[name], rtol=0, atol=1e-14)
    assert_allclose(forces.thrusts["AB"], thrust, rtol=1e-11)
    along = (places["B"] - places["A"]) / np.hypot(*(places["B"] - places["A"]))
    assert_allclose(forces.force("O", on="OBG"), -thrust * along - P[:, None], rtol=0, atol=1e-11 * thrust.max())
    assert_allclose(forces.force("B", on="OBG"), thrust * along, rtol=0, atol=1e-11 * thrust.max())


def swing(h):
    """Return the balancer's points, from O to B."""
    O, A = np.array([0.0, 1.05]), np.array([-0.05, 0.30])
    B = meet(O, 0.930054, A, 0.70 + h, left=True)
    R, G1, G2 = (beside(O, B, r, turn * deg) for r, turn in ((2.040833, 5.290081), (0.488774, 5.491118), (1.436851, 18.840343)))
    return {"O": O, "A": A, "B": B, "R": R, "G1": G1, "G2": G2}


MASSES = [("G1", weight(1500)), ("G2", weight(1000))]
AREA = 2 * np.pi / 4 * 0.063**2
AIR = 101325.0


def horizon():
    """Return the stroke where the shoe stands at height 0 [m]: Newton with a complex step."""
    h = 0.12
    for _ in range(20):
        h -= swing(h)["R"][1] / slopes(swing, "h", h=h)["R"][1]
    return h


def gas(h):
    """Return the line's pressure [Pa gauge] at a stroke: p V = const of two pairs, each full of gas below its own charge; bisected."""
    charges = [(4e-3, 50 * kgf / 1e-4), (4e-3, 25 * kgf / 1e-4)]

    def volume(p):
        return sum(V * (P0 + AIR) / (max(p, P0) + AIR) for V, P0 in charges)

    wanted = volume(34 * kgf / 1e-4) + AREA * (h - horizon())
    low, high = 25 * kgf / 1e-4, 500 * kgf / 1e-4
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if volume(middle) > wanted else (low, middle)
    return 0.5 * (low + high)


class FloatingBalancer(PrintedBalancer):
    """The printed machine with its cylinders on gas: header 2, charged to 34 kgf/cm2 at the horizon."""

    lift = Cylinder("A", "B", bore=63 * mm, rod=40 * mm, count=2)
    block = AccumulatorBlock([Accumulator(4 * litre, 50 * kgf_cm2), Accumulator(4 * litre, 25 * kgf_cm2)], isothermal)
    floating = FloatCircuit(lift, block, charge_pressure=34 * kgf_cm2, at=horizon())


def test_the_balancer_by_hand_on_its_gas():
    """The gas pushes through A and B; what it leaves of the weights the shoe carries, or the drive where there is no ground."""
    motion = FloatingBalancer().at(h=np.linspace(0.06, 0.18, 7))
    places = over(motion.strokes, swing)
    push = over(motion.strokes, lambda h: {"F": AREA * gas(h)})["F"]
    needed = over(motion.strokes, lambda h: {"F": -power(slopes(swing, "h", h=h), MASSES)})["F"]
    rise = over(motion.strokes, lambda h: {"R": slopes(swing, "h", h=h)["R"][1]})["R"]
    for name in ("B", "R", "G1", "G2"):
        assert_allclose(motion[name], places[name], rtol=0, atol=1e-14)
    along = (places["B"] - places["A"]) / np.hypot(*(places["B"] - places["A"]))
    assert_allclose(FloatingBalancer.lift.thrust(motion), push, rtol=1e-9)
    assert_allclose(FloatingBalancer.lift.pressure(motion), push / AREA, rtol=1e-9)
    shoe = (needed - push) / rise
    assert_allclose(reaction(motion), shoe, rtol=1e-8)
    assert_allclose(driving_force(motion), needed - push, rtol=0, atol=1e-9 * push.max())

    hanging = pin_forces(motion)                            # no ground: the drive gives the rest through the same two pins
    assert_allclose(hanging.thrusts["lift"], push, rtol=1e-9)
    assert_allclose(hanging.drives["h"], needed - push, rtol=0, atol=1e-9 * push.max())
    assert_allclose(on_pin(hanging, "A", "frame"), -needed * along, rtol=0, atol=1e-9 * push.max())

    standing = pin_forces(motion, ["feeder", "header", "floating", Support("R", (0, 1), force=shoe)])
    down = weight(2500)[:, None]
    ground = np.stack([0 * shoe, shoe])
    assert_allclose(standing.drives["h"], 0.0, atol=1e-8 * push.max())
    assert_allclose(standing.force("A", on="lift"), push * along, rtol=0, atol=1e-8 * push.max())
    assert_allclose(on_pin(standing, "B", "OBRG1G2"), push * along, rtol=0, atol=1e-8 * push.max())
    assert_allclose(standing.force("O", on="OBRG1G2"), -push * along - down - ground, rtol=0, atol=1e-8 * push.max())
