"""A knuckle-boom loader: a ram lifts the boom, another folds the jib by a rocker on the boom and a link; the jib's weight pulls at it."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Cylinder, LiftCircuit
from linkage import LEFT, RIGHT, Dyad, Ground, Mechanism, OnLink, Stroke, Weight, bar, deg, kN, mm, pin_forces
from tests.machines.machines_b_truth import beside, meet, over, power, slopes, weight
from tests.mechanisms.free_bodies import FreeBodies
from tests.members import told_by


class KnuckleBoom(Mechanism):
    """The boom O-B-J turns about O, the rocker E-D about E on the boom, the jib J-F-T about J at its end."""

    lift, fold = Stroke(0.0, 0.40), Stroke(0.0, 0.30)

    O, A = Ground(0.0, 2.0), Ground(0.35, 0.90)
    B = Dyad(A, O, AB=1.02 + lift, OB=0.90, side=RIGHT)
    J = OnLink(O, B, OJ=2.60, BOJ=10 * deg)
    C = OnLink(O, B, OC=1.10, BOC=28 * deg)             # the jib's ram on the boom
    E = OnLink(O, B, OE=2.20, BOE=12 * deg)             # the rocker on the boom
    D = Dyad(C, E, CD=0.85 + fold, ED=0.35, side=LEFT)
    F = Dyad(D, J, DF=0.45, JF=0.38, side=LEFT)
    T = OnLink(J, F, JT=1.90, FJT=-130 * deg)           # the hook

    boom = Weight(B, mass=180)
    load = Weight(T, mass=600)

    ram = Cylinder(A, B, bore=110 * mm, rod=60 * mm)
    jib = Cylinder(C, D, bore=100 * mm, rod=60 * mm)


def place(lift, fold):
    O, A = np.array([0.0, 2.0]), np.array([0.35, 0.90])
    B = meet(A, 1.02 + lift, O, 0.90, left=False)
    J, C, E = beside(O, B, 2.60, np.deg2rad(10)), beside(O, B, 1.10, np.deg2rad(28)), beside(O, B, 2.20, np.deg2rad(12))
    D = meet(C, 0.85 + fold, E, 0.35, left=True)
    F = meet(D, 0.45, J, 0.38, left=True)
    return {"O": O, "A": A, "B": B, "J": J, "C": C, "E": E, "D": D, "F": F, "T": beside(J, F, 1.90, np.deg2rad(-130))}


LOADS = [("B", weight(180)), ("T", weight(600))]


def work(lift, fold):
    """Return the rams' thrusts by virtual work."""
    return {
        "ram": -power(slopes(place, "lift", lift=lift, fold=fold), LOADS),
        "jib": -power(slopes(place, "fold", lift=lift, fold=fold), LOADS),
    }  # fmt: skip


def cut(lift, fold):
    """Return the forces by free bodies: boom, rocker, jib; rams and link carry along their lines."""
    at, free = place(lift, fold), FreeBodies()
    free.pin("O", "boom", "frame", at["O"])
    free.thrust("ram", "frame", at["A"], "boom", at["B"])
    free.pin("E", "rocker", "boom", at["E"])
    free.thrust("jib", "boom", at["C"], "rocker", at["D"])
    free.thrust("link", "rocker", at["D"], "arm", at["F"])
    free.pin("J", "arm", "boom", at["J"])
    for point, force in LOADS:
        free.load({"B": "boom", "T": "arm"}[point], at[point], force)
    found = free.solve()
    return {"ram": found["ram"], "jib": found["jib"]} | {pin: np.hypot(found[pin + "x"], found[pin + "y"]) for pin in "OEJ"}


POSES = {"lift": np.array([0.0, 0.1, 0.2, 0.3, 0.4]), "fold": np.array([0.3, 0.2, 0.1, 0.0, 0.15])}


def test_places_thrusts_and_pins():
    motion = KnuckleBoom().at(**POSES)
    own, worked, forces = over(POSES, cut), over(POSES, work), pin_forces(motion)
    for name, values in over(POSES, place).items():
        assert_allclose(motion[name], np.broadcast_to(values, motion[name].shape) if values.ndim == motion[name].ndim else values[:, :1],
                        rtol=0, atol=1e-13)  # fmt: skip
    for name in ("ram", "jib"):
        assert_allclose(own[name], worked[name], rtol=1e-11)
        assert_allclose(forces.thrusts[name], own[name], rtol=1e-10)
    for pin, on in (("O", "O B"), ("E", "E D"), ("J", "J F")):
        assert_allclose(np.hypot(*forces.force(pin, on=on)), own[pin], rtol=1e-10)


def sides(machine):
    """Return what is said of the side that works."""
    return [each for each in told_by(machine, "ram", "jib") if each.rule.startswith("side")]


@pytest.mark.slow
def test_a_ram_whose_side_holds_no_such_load_is_told():
    (told,) = sides(KnuckleBoom())
    least = min(work(lift, fold)["jib"] for lift in np.linspace(0.0, 0.4, 41) for fold in np.linspace(0.0, 0.3, 31))
    assert told.ok is None
    assert f"pulls jib with up to {-least / kN:.4g} kN" in told
    assert told.answer.value <= least * (1 - 1e-12)


@pytest.mark.slow
def test_it_is_not_told_where_a_side_holds_it_or_a_line_judges():
    both = type("Both", (KnuckleBoom,), {"jib": Cylinder("C", "D", bore=100 * mm, rod=60 * mm, works="both")})
    on_pump = type("Pumped", (KnuckleBoom,), {"pump": LiftCircuit("jib", pressure=180 * bar)})
    pulling = type("Pulling", (KnuckleBoom,), {
        "ram": Cylinder("A", "B", bore=110 * mm, rod=60 * mm, works="rod"),
        "jib": Cylinder("C", "D", bore=100 * mm, rod=60 * mm, works="rod"),
    })  # fmt: skip
    assert sides(both()) == sides(on_pump()) == []
    (told,) = sides(pulling())
    assert told.ok is None
    assert "pushes ram" in told
