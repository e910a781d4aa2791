"""A spreader's tailgate: the ram that lifts it carries its valve block and, on the barrel, the small ram of the latch."""

import numpy as np
from numpy.testing import assert_allclose

from hydraulics import Cylinder, LiftCircuit
from linkage import LEFT, Dyad, Force, Ground, LinkMass, Mechanism, OnLink, Stroke, Weight, bar, deg, driving_force, mm, pin_forces
from tests.machines.machines_b_truth import beside, meet, over, power, slopes, stretch, unit, weight
from tests.mechanisms.free_bodies import FreeBodies


class Tailgate(Mechanism):
    """The gate O-B-G swings up about O; the latch H-L-N turns about H, pulled by a small ram from K on the lifting ram's barrel."""

    S = Stroke(0.0, 0.42)                               # the lifting ram
    t = Stroke(0.0, 0.06)                               # the latch's ram

    A, O, H = Ground(0.0, 0.0), Ground(0.20, 1.55), Ground(0.42, 0.10)
    B = Dyad(A, O, AB=0.80 + S, OB=0.90, side=LEFT)
    G = OnLink(O, B, OG=0.75, BOG=-12 * deg)            # the gate's centre of gravity

    K = OnLink(A, B, AK=0.25, BAK=-20 * deg)            # an eye welded to the barrel
    V = OnLink(A, B, AV=0.45, BAV=12 * deg)             # its valve block
    R = OnLink(B, A, BR=0.12, ABR=25 * deg)             # a position sensor on the rod's eye
    L = Dyad(K, H, KL=0.36 + t, HL=0.16, side=LEFT)     # the latch's lever
    N = OnLink(H, L, HN=0.20, LHN=-95 * deg)            # its nose

    gate = Weight(G, mass=240)
    block = Weight(V, mass=14)
    sensor = Weight(R, mass=2.5)
    barrel = LinkMass("A K", mass=18, at=(0.30, 0.09))
    nose = Force(N, (-900.0, 350.0))                    # what the gate's hook leaves on it

    ram = Cylinder(A, B, bore=70 * mm, rod=40 * mm)
    latch = Cylinder(K, L, bore=32 * mm, rod=20 * mm, works="both")
    pump = LiftCircuit(ram, pressure=180 * bar)


def place(S, t):
    A, O, H = np.array([0.0, 0.0]), np.array([0.20, 1.55]), np.array([0.42, 0.10])
    B = meet(A, 0.80 + S, O, 0.90, left=True)
    K = beside(A, B, 0.25, np.deg2rad(-20))
    L = meet(K, 0.36 + t, H, 0.16, left=True)
    u, v = unit(A, K), unit(A, K)[::-1] * np.array([-1.0, 1.0])
    return {
        "A": A, "O": O, "H": H, "B": B, "G": beside(O, B, 0.75, np.deg2rad(-12)), "K": K, "V": beside(A, B, 0.45, np.deg2rad(12)),
        "R": beside(B, A, 0.12, np.deg2rad(25)), "L": L, "N": beside(H, L, 0.20, np.deg2rad(-95)), "barrel": A + 0.30 * u + 0.09 * v,
    }  # fmt: skip


LOADS = [("G", weight(240)), ("V", weight(14)), ("R", weight(2.5)), ("barrel", weight(18)), ("N", np.array([-900.0, 350.0]))]
ON = {"G": "gate", "V": "barrel", "R": "rod", "barrel": "barrel", "N": "lever"}


def work(S, t):
    """Return the rams' thrusts by virtual work: of S moves all, the latch's ram held at its length."""
    at = place(S, t)
    lift, latch = slopes(place, "S", S=S, t=t), slopes(place, "t", S=S, t=t)
    assert abs(stretch(at, lift, "K", "L")) < 1e-12 and abs(stretch(at, lift, "A", "B") - 1) < 1e-12
    return {"ram": -power(lift, LOADS), "latch": -power(latch, LOADS)}


def cut(S, t):
    """Return the forces by free bodies: gate, barrel, rod in the barrel's gland, latch lever."""
    at, free = place(S, t), FreeBodies()
    free.pin("A", "barrel", "frame", at["A"])
    free.across("gland", "rod", "barrel", at["V"], at["B"] - at["A"])
    free.torque("turn", "rod", "barrel")
    free.thrust("ram", "barrel", at["A"], "rod", at["B"])
    free.pin("B", "rod", "gate", at["B"])
    free.pin("O", "gate", "frame", at["O"])
    free.thrust("latch", "barrel", at["K"], "lever", at["L"])
    free.pin("H", "lever", "frame", at["H"])
    for point, force in LOADS:
        free.load(ON[point], at[point], force)
    found = free.solve()
    return {"ram": found["ram"], "latch": found["latch"]} | {pin: np.array([found[pin + "x"], found[pin + "y"]]) for pin in "ABOH"}


POSES = {"S": np.array([0.0, 0.1, 0.2, 0.3, 0.4]), "t": np.array([0.0, 0.03, 0.06, 0.02, 0.05])}


def test_where_everything_is():
    machine = Tailgate()
    motion, own = machine.at(**POSES), over(POSES, place)
    for name in "BGKVRLN":
        assert_allclose(motion[name], own[name], rtol=0, atol=1e-13)
    assert (machine.mobility, machine.gruebler) == (2, 2)


def test_thrusts_by_work_and_by_free_bodies():
    motion = Tailgate().at(**POSES)
    worked, own, forces = over(POSES, work), over(POSES, cut), pin_forces(motion)
    for name, drive in (("ram", "S"), ("latch", "t")):
        assert_allclose(own[name], worked[name], rtol=1e-11)
        assert_allclose(forces.thrusts[name], own[name], rtol=1e-10)
        assert_allclose(getattr(Tailgate, name).thrust(motion), own[name], rtol=1e-10)
        assert_allclose(driving_force(motion, drive=drive), worked[name], rtol=1e-10)
    assert forces.gap < 1e-12
    assert_allclose(Tailgate.ram.pressure(motion), np.maximum(own["ram"], 0) / (np.pi / 4 * 0.07**2), rtol=1e-9, atol=1)


def test_every_pin():
    motion = Tailgate().at(**POSES)
    own, forces = over(POSES, cut), pin_forces(motion)
    for pin, on in (("A", "ram"), ("B", "ram"), ("O", "O B"), ("H", "H L")):
        assert_allclose(forces.force(pin, on=on), own[pin], rtol=1e-10, atol=1e-7)
    latch = own["latch"] * over(POSES, lambda S, t: {"u": unit(place(S, t)["K"], place(S, t)["L"])})["u"]
    assert_allclose(forces.force("K", on="ram"), -latch, rtol=1e-10, atol=1e-7)
    assert set(forces.on_body("ram")) == {"A", "B", "K", "V", "R"}
    assert forces.residual < 1e-12
