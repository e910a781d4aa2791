"""A sewing machine: the main shaft's crank drives the needle bar, the thread take-up and a feed lever; every link has its mass."""

import numpy as np
from numpy.testing import assert_allclose

from linkage import (
    LEFT,
    RIGHT,
    Crank,
    Dyad,
    Force,
    Ground,
    Guide,
    LinkMass,
    Mechanism,
    Moment,
    OnLink,
    SliderDyad,
    Spring,
    Stroke,
    Weight,
    deg,
    driving_force,
    mm,
    pin_forces,
)
from tests.machines.machines_b_truth import beside, meet, on_pin, over, polar, power, size, slopes, stretch, unit, weight
from tests.mechanisms.free_bodies import FreeBodies


class SewingMachine(Mechanism):
    """Crank OAC on the main shaft; rod AN moves the needle bar; coupler CKE carries the take-up's eye E, KP is its rocker, KLM feeds."""

    phi = Stroke(0.0, 360 * deg)

    O = Ground(0.0, 0.0)
    P = Ground(38 * mm, 28 * mm)                                # take-up rocker's pivot
    L = Ground(105 * mm, -22 * mm)                              # feed lever's pivot
    J = Ground(-60 * mm, 95 * mm)                               # where the thread's check spring hangs
    bar = Guide((0.0, 0.0), angle=-90 * deg)

    A = Crank(O, OA=14.5 * mm, angle=phi)
    C = OnLink(O, A, OC=12 * mm, AOC=-42 * deg)
    N = SliderDyad(A, bar, AN=44 * mm, side=RIGHT)              # needle bar
    K = Dyad(C, P, CK=36 * mm, PK=30 * mm, side=LEFT)
    E = OnLink(C, K, CE=70 * mm, KCE=14 * deg)                  # eye of the take-up
    M = Dyad(K, L, KM=92 * mm, LM=33 * mm, side=RIGHT)          # feed lever's pin
    Z = OnLink(L, M, LZ=50 * mm, MLZ=-75 * deg)                 # its other end

    crank = LinkMass("O A C", mass=0.16, at=(4 * mm, -2 * mm))
    rod = LinkMass("A N", mass=0.045)
    needle = Weight(N, mass=0.12)
    coupler = LinkMass("C K E", mass=0.06)
    rocker = LinkMass("P K", mass=0.03)
    drag_link = LinkMass("K M", mass=0.035)
    feed = LinkMass("L M Z", mass=0.09, at=(12 * mm, 5 * mm))
    fabric = Force(N, (0.0, 18.0))                              # the needle in the cloth
    thread = Spring(E, J, stiffness=120.0, free_length=30 * mm)
    cloth = Force(Z, (-6.0, 2.5))
    hook = Moment("O A", M=-0.08)                               # what the hook's shaft takes


def place(phi):
    O, P, L, J = (np.array(each) * 1e-3 for each in ([0.0, 0.0], [38.0, 28.0], [105.0, -22.0], [-60.0, 95.0]))
    A, C = polar(14.5e-3, phi), polar(12e-3, phi - 42 * deg)
    N = np.array([0.0 * A[0], A[1] - np.sqrt(44e-3**2 - A[0] ** 2)])
    K = meet(C, 36e-3, P, 30e-3, left=True)
    M = meet(K, 92e-3, L, 33e-3, left=False)
    E, Z = beside(C, K, 70e-3, 14 * deg), beside(L, M, 50e-3, -75 * deg)
    feed = L + 12e-3 * unit(L, M) + 5e-3 * np.array([-unit(L, M)[1], unit(L, M)[0]])
    return {
        "O": O, "P": P, "L": L, "J": J, "A": A, "C": C, "N": N, "K": K, "M": M, "E": E, "Z": Z,
        "rod": (A + N) / 2, "coupler": (C + K + E) / 3,
        "crank": polar(4e-3, phi) + polar(2e-3, phi - np.pi / 2), "rocker": (P + K) / 2, "drag_link": (K + M) / 2, "feed": feed,
    }  # fmt: skip


LOADS = {
    "crank": [("crank", weight(0.16))], "rod": [("rod", weight(0.045)), ("N", weight(0.12)), ("N", np.array([0.0, 18.0]))],
    "coupler": [("coupler", weight(0.06))], "rocker": [("rocker", weight(0.03))], "drag_link": [("drag_link", weight(0.035))],
    "feed": [("feed", weight(0.09)), ("Z", np.array([-6.0, 2.5]))],
}  # fmt: skip


def torque(phi):
    """Return the main shaft's torque [Nm] by virtual work."""
    at, slope = place(phi), slopes(place, "phi", phi=phi)
    pull = 120.0 * (30e-3 - size(at["J"] - at["E"]))
    return {"M": 0.08 - sum(power(slope, loads) for loads in LOADS.values()) - pull * stretch(at, slope, "E", "J")}


def truth(phi):
    """Return torque and pin forces by free bodies."""
    at, free = place(phi), FreeBodies()
    free.pin("O", "crank", "frame", at["O"])
    free.torque("M", "crank", "frame")
    free.pin("A", "rod", "crank", at["A"])
    free.across("N", "rod", "frame", at["N"], (0, -1))
    free.pin("C", "coupler", "crank", at["C"])
    free.pin("K", "rocker", "coupler", at["K"])                 # the pin of three bodies sits in the coupler here
    free.pin("drag", "drag_link", "coupler", at["K"])
    free.pin("P", "rocker", "frame", at["P"])
    free.pin("feed", "feed", "drag_link", at["M"])
    free.pin("L", "feed", "frame", at["L"])
    for body, loads in LOADS.items():
        for point, force in loads:
            free.load(body, at[point], force)
    push = 120.0 * (30e-3 - size(at["J"] - at["E"]))
    free.load("coupler", at["E"], push * unit(at["J"], at["E"]))
    free.load("crank", at["O"], (0, 0), -0.08)
    found = free.solve()
    pins = {name: np.array([found[f"{name}x"], found[f"{name}y"]]) for name in ("O", "A", "C", "K", "drag", "P", "feed", "L")}
    return {**pins, "M": found["M"], "N": found["N"], "thread": push, "EJ": unit(at["E"], at["J"])}


def test_where_everything_is():
    motion = SewingMachine().sweep(25)
    own = over(motion.strokes, place)
    for name in "ACNKEMZ":
        assert_allclose(motion[name], own[name], rtol=0, atol=1e-15)
    assert SewingMachine().mobility == 1
    assert len(SewingMachine().links) == 7                      # the frame and six that move


def test_the_shafts_torque_by_work_by_pins_and_by_hand():
    motion = SewingMachine().sweep(25)
    work, own = over(motion.strokes, torque)["M"], over(motion.strokes, truth)["M"]
    assert_allclose(own, work, rtol=0, atol=1e-13)
    assert_allclose(driving_force(motion), own, rtol=0, atol=1e-13)
    assert_allclose(pin_forces(motion).drives["phi"], own, rtol=0, atol=1e-13)
    assert own.min() < 0 < own.max()


def test_every_pin():
    motion = SewingMachine().sweep(25)
    own, forces = over(motion.strokes, truth), pin_forces(motion)
    for pin, on, name in (
        ("O", "OAC", "O"), ("A", "AN", "A"), ("C", "CKE", "C"), ("P", "PK", "P"), ("L", "LMZ", "L"), ("M", "LMZ", "feed"),
    ):  # fmt: skip
        assert_allclose(forces.force(pin, on=on), own[name], rtol=0, atol=1e-11)
    for on, force in (("PK", own["K"]), ("KM", own["drag"]), ("CKE", -own["K"] - own["drag"])):
        assert_allclose(on_pin(forces, "K", on), force, rtol=0, atol=1e-11)
    assert_allclose(forces.force("N", on="AN"), [own["N"], 0 * own["N"]], rtol=0, atol=1e-11)
    assert_allclose(forces.thrusts["thread"], own["thread"], rtol=1e-12)
    assert_allclose(forces.force("E", on="CKE"), -own["thread"] * own["EJ"], rtol=0, atol=1e-12)     # the thread pulls the eye towards J
    assert_allclose(forces.force("J", on="frame"), own["thread"] * own["EJ"], rtol=0, atol=1e-12)
    assert forces.residual < 1e-12


def test_a_turn_gives_back_all_that_is_stored():
    """Weights, the thread's spring and forces that never change are conservative: over a whole turn only the hook is paid for."""
    turn = np.arange(96) * 2 * np.pi / 96                       # equally spaced: the mean of a periodic function is exact to rounding
    mean = driving_force(SewingMachine().at(phi=turn)).mean()
    assert_allclose(mean, 0.08, rtol=1e-9)


def test_masses_one_by_one():
    """What each mass asks of the shaft adds up to what all of them ask."""
    motion = SewingMachine().sweep(13)
    names = ["crank", "rod", "needle", "coupler", "rocker", "drag_link", "feed"]
    total = driving_force(motion, names)
    apart = sum(driving_force(motion, [name]) for name in names)
    weights = [(point, force) for loads in LOADS.values() for point, force in loads if force[0] == 0.0 and force[1] < 0.0]
    own = over(motion.strokes, lambda phi: {"M": -power(slopes(place, "phi", phi=phi), weights)})["M"]
    assert len(weights) == len(names)
    assert_allclose(total, apart, rtol=0, atol=1e-14)
    assert_allclose(total, own, rtol=0, atol=1e-14)
