"""One lifting arm, its cylinder declared in every way there is: what the cylinder carries is one and the same.

An arm OBG turns about O, with A above it and K below. All figures are illustrative.
"""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Cylinder, LiftCircuit, lift_verdicts
from linkage import (
    LEFT,
    RIGHT,
    Actuator,
    Between,
    Crank,
    Damper,
    DefinitionError,
    Dyad,
    Ground,
    Mechanism,
    OnLink,
    SingularError,
    Spring,
    Stroke,
    Weight,
    deg,
    driving_force,
    max_table,
    pin_forces,
)
from linkage.units import bar, mm
from tests.for_all import first_daily
from tests.machines import plane
from tests.machines.words import number

PLACE_A, PLACE_K = (-0.05, 0.72), (-0.60, -0.60)
OB, OG, BOG, OX, BOX = 0.36, 1.25, -20 * deg, 0.45, -40 * deg
MASS = 640.0
BORE, ROD = 90 * mm, 45 * mm


class Pulled(Mechanism):
    """The cylinder hangs above and lifts by drawing in: its stroke counts how far."""

    S = Stroke(0.0, 0.36)
    A = Ground(*PLACE_A)
    O = Ground(0.0, 0.0)
    B = Dyad(A, O, AB=1.00 - S, OB=OB, side=LEFT)
    G = OnLink(O, B, OG=OG, BOG=BOG)
    load = Weight(G, mass=MASS)
    lift = Cylinder(A, B, bore=BORE, rod=ROD, works="rod")
    line = LiftCircuit(lift, pressure=160 * bar, relief=180 * bar, mechanical_efficiency=0.92)


class Pushed(Mechanism):
    """The cylinder stands below and pushes; it is telescopic, so that its length grows twice as fast as the stroke."""

    S = Stroke(0.0, 0.23)
    K = Ground(*PLACE_K)
    O = Ground(0.0, 0.0)
    X = Dyad(K, O, KX=0.72 + 2 * S, OX=OX, side=RIGHT)
    B = OnLink(O, X, OB=OB, XOB=-BOX)
    G = OnLink(O, X, OG=OG, XOG=BOG - BOX)
    load = Weight(G, mass=MASS)
    push = Cylinder("K", "X", bore=BORE, rod=ROD)
    line = LiftCircuit(push, pressure=160 * bar, relief=180 * bar, mechanical_efficiency=0.92)


class Turned(Mechanism):
    """The arm's angle drives, both cylinders may hang beside it."""

    psi = Stroke(-40 * deg, 35 * deg)
    A = Ground(*PLACE_A)
    K = Ground(*PLACE_K)
    O = Ground(0.0, 0.0)
    B = Crank(O, OB=OB, angle=psi)
    G = OnLink(O, B, OG=OG, BOG=BOG)
    X = OnLink(O, B, OX=OX, BOX=BOX)
    load = Weight(G, mass=MASS)


# -- by hand -----------------------------------------------------------------------------------------------

ANGLES = np.array([-35.0, -20.0, 0.0, 15.0, 30.0]) * deg
DISC, RING = plane.disc(BORE), plane.annulus(BORE, ROD)
LOADS = [("G", (0.0, -MASS * plane.G))]


def places(q):
    """Return every place by the arm's angle."""
    arm = plane.point(np.cos(q[0]), np.sin(q[0]))
    found = {"A": plane.point(*PLACE_A), "K": plane.point(*PLACE_K), "O": plane.point(0.0, 0.0), "B": OB * arm}
    return found | {"G": OG * plane.turned(arm, BOG), "X": OX * plane.turned(arm, BOX)}


def long(psi, P, Q):
    """Return the distance of two places."""
    p = places([psi])
    return plane.length(p[P], p[Q])


def lever(psi, P, Q):
    """Return d|PQ| over the angle."""
    return plane.stretch(places, [psi], P, Q)


def moment(psi, loads=LOADS):
    """Return what turns the arm against its loads."""
    return -plane.work(places, [psi], loads)


def pulled(angles=ANGLES):
    """Return the stroke that draws in."""
    return {"S": np.array([1.00 - long(psi, "A", "B") for psi in angles])}


def pushed(angles=ANGLES):
    """Return the stroke of half the length."""
    return {"S": np.array([(long(psi, "K", "X") - 0.72) / 2 for psi in angles])}


def test_stroke_that_draws_in():
    """`AB = 1.00 - S`, `works="rod"`: a pull, a pressure on the annulus, a reserve; no load that drives."""
    motion = Pulled().at(**pulled())
    want = np.array([moment(psi) / lever(psi, "A", "B") for psi in ANGLES])
    assert np.all(want < -10e3)
    for k, psi in enumerate(ANGLES):
        assert_allclose(motion["G"][:, k], places([psi])["G"], atol=1e-13)
    assert_allclose(driving_force(motion), -want, rtol=1e-11)
    assert_allclose(Pulled.lift.thrust(motion), want, rtol=1e-11)
    assert_allclose(Pulled.lift.pressure(motion), -want / 0.92 / RING, rtol=1e-11)
    assert_allclose(Pulled.line.pressure_for(motion), -want / 0.92 / RING, rtol=1e-11)
    assert_allclose(Pulled.line.reserve(motion), 160e5 * RING / (-want / 0.92), rtol=1e-11)
    assert_allclose(Pulled.line.holding(motion).working, -want / RING, rtol=1e-11)
    assert_allclose(Pulled.line.lowering(motion).working, -want * 0.92 / RING, rtol=1e-11)
    assert Pulled.line.lowering(motion).by_itself.all()
    rise = np.array([plane.rate(places, [psi])["G"][1] / -lever(psi, "A", "B") for psi in ANGLES])
    capacity = Pulled.line.capacity(motion, "G", loads=[], along=(0, 1))
    assert_allclose(capacity, 160e5 * RING * 0.92 / rise, rtol=1e-10)
    forces = pin_forces(motion)
    for k, psi in enumerate(ANGLES):
        p = places([psi])
        assert_allclose(forces.force("A", on="lift")[:, k], want[k] * plane.toward(p["A"], p["B"]), rtol=1e-11)
        assert_allclose(forces.force("B", on="O B")[:, k], want[k] * plane.toward(p["A"], p["B"]), rtol=1e-11)


@pytest.mark.parametrize("count", [2, 50])
def test_verdicts_of_the_stroke_that_draws_in(count):
    low, high = ANGLES[0], ANGLES[-1]
    start, end = (float(each) for each in pulled(np.array([low, high]))["S"])
    motion = Pulled().at(S=np.linspace(start, end, count))
    most, _ = plane.peak(lambda psi: -moment(psi) / lever(psi, "A", "B"), low, high)
    lifting, oil, holding, lowering = lift_verdicts(Pulled.line, motion)
    assert bool(lifting) == (160e5 * RING / (most / 0.92) >= 1.0)
    assert_allclose(number("least reserve is", lifting), 160e5 * RING / (most / 0.92), rtol=1e-3)
    assert "drives" not in str(lifting)
    assert_allclose(number("", oil), (end - start) * RING / 1e-3, rtol=1e-2)
    assert_allclose(number("up to", holding), most / RING / bar, rtol=1e-3)
    assert lowering
    assert all("never pushed" in str(each) for each in Pulled.lift.checks(motion) if each.rule == "buckling")


def test_stroke_of_half_the_length():
    """`KX = 0.72 + 2 * S`: the stroke's force is twice the thrust."""
    motion = Pushed().at(**pushed())
    want = np.array([moment(psi) / lever(psi, "K", "X") for psi in ANGLES])
    for k, psi in enumerate(ANGLES):
        assert_allclose(motion["G"][:, k], places([psi])["G"], atol=1e-13)
    assert np.all(want > 10e3)
    assert_allclose(driving_force(motion), 2 * want, rtol=1e-11)
    assert_allclose(Pushed.push.thrust(motion), want, rtol=1e-11)
    assert_allclose(Pushed.line.pressure_for(motion), want / 0.92 / DISC, rtol=1e-11)
    assert_allclose(Pushed.line.oil(motion), (long(ANGLES[-1], "K", "X") - long(ANGLES[0], "K", "X")) * DISC, rtol=1e-9)
    assert_allclose(pin_forces(motion).drives["S"], 2 * want, rtol=1e-11)
    assert_allclose(pin_forces(motion).thrusts["push"], want, rtol=1e-11)
    use, _ = plane.peak(lambda psi: moment(psi) / lever(psi, "K", "X") / plane.critical(ROD, long(psi, "K", "X")), ANGLES[0], ANGLES[-1])
    (buckling,) = [each for each in Pushed.push.checks(motion) if each.rule == "buckling"]
    assert_allclose(number("safety", buckling), 0.92 / use, rtol=6e-3)  # the rod carries T / k_m while the pump lifts


def test_beside_the_angle():
    both = {"lift": Cylinder("A", "B", bore=BORE, rod=ROD, works="rod")}
    machine = type("Beside", (Turned,), both)
    motion = machine().at(psi=ANGLES)
    want = np.array([moment(psi) / lever(psi, "A", "B") for psi in ANGLES])
    assert_allclose(both["lift"].thrust(motion), want, rtol=1e-11)
    assert_allclose(driving_force(motion), [moment(psi) for psi in ANGLES], rtol=1e-11)


# -- a second cylinder -------------------------------------------------------------------------------------


class SecondAlone(Pulled):
    """The driven length AB is only the coordinate: the declared cylinder KX holds in its place."""

    K = Ground(*PLACE_K)
    X = OnLink("O", "B", OX=OX, BOX=BOX)
    lift = Cylinder("K", "X", bore=BORE, rod=ROD)
    line = LiftCircuit("lift", pressure=160 * bar, mechanical_efficiency=0.92)


def test_cylinder_beside_a_driven_length():
    """It is judged by its own force; the drive AB carries nothing."""
    motion = SecondAlone().at(**pulled())
    want = np.array([moment(psi) / lever(psi, "K", "X") for psi in ANGLES])
    assert_allclose(SecondAlone.lift.thrust(motion), want, rtol=1e-11)
    assert_allclose(SecondAlone.line.pressure_for(motion), want / 0.92 / DISC, rtol=1e-11)
    forces = pin_forces(motion)
    assert_allclose(forces.thrusts["lift"], want, rtol=1e-11)
    for k, psi in enumerate(ANGLES):
        p = places([psi])
        push = want[k] * plane.toward(p["K"], p["X"])
        assert_allclose(forces.force("X", on="O B")[:, k], push, rtol=1e-10)
        assert_allclose(forces.force("O", on="O B")[:, k], [0.0, MASS * plane.G] - push, rtol=1e-10)

    def used(psi):
        return moment(psi) / 0.92 / lever(psi, "K", "X") / plane.critical(ROD, long(psi, "K", "X"))

    use, _ = plane.peak(used, ANGLES[0], ANGLES[-1])
    (buckling,) = [each for each in SecondAlone.lift.checks(motion) if each.rule == "buckling"]
    assert_allclose(number("safety", buckling), 1 / use, rtol=6e-3)


class OnePressure(Pulled):
    """The pulling cylinder above and two thin ones that push from below, on one line."""

    K = Ground(*PLACE_K)
    X = OnLink("O", "B", OX=OX, BOX=BOX)
    aux = Cylinder(K, X, bore=40 * mm, rod=22 * mm, count=2)
    line = LiftCircuit(["lift", aux], pressure=160 * bar, relief=180 * bar, mechanical_efficiency=0.92)


class OnePressureTurned(Turned):
    """The same beside the angle."""

    lift = Cylinder("A", "B", bore=BORE, rod=ROD, works="rod")
    aux = Cylinder("K", "X", bore=40 * mm, rod=22 * mm, count=2)
    line = LiftCircuit([lift, aux], pressure=160 * bar, relief=180 * bar, mechanical_efficiency=0.92)


def shared(psi):
    """Return the pressure without losses that a pulling and two pushing cylinders share."""
    return moment(psi) / (-RING * lever(psi, "A", "B") + 2 * plane.disc(0.040) * lever(psi, "K", "X"))


@pytest.mark.parametrize(("machine", "at"), [(OnePressure, pulled), (OnePressureTurned, lambda: {"psi": ANGLES})])
def test_two_cylinders_on_one_line(machine, at):
    motion = machine().at(**at())
    want = np.array([shared(psi) for psi in ANGLES])
    assert_allclose(machine.lift.thrust(motion), -want * RING, rtol=1e-10)
    assert_allclose(machine.aux.thrust(motion), want * 2 * plane.disc(0.040), rtol=1e-10)
    assert_allclose(machine.line.pressure_for(motion), want / 0.92, rtol=1e-10)
    assert_allclose(machine.lift.pressure(motion), want / 0.92, rtol=1e-10)
    assert_allclose(machine.aux.pressure(motion), want / 0.92, rtol=1e-10)
    assert_allclose(machine.line.reserve(motion), 160e5 * 0.92 / want, rtol=1e-10)
    assert_allclose(machine.line.holding(motion).working, want, rtol=1e-10)
    forces = pin_forces(motion)
    assert forces.residual < 1e-12
    for k, psi in enumerate(ANGLES):
        p = places([psi])
        assert_allclose(forces.force("A", on="lift")[:, k], -want[k] * RING * plane.toward(p["A"], p["B"]), rtol=1e-9)
        assert_allclose(forces.force("K", on="aux")[:, k], want[k] * 2 * plane.disc(0.040) * plane.toward(p["K"], p["X"]), rtol=1e-9)


def test_oil_of_both():
    low, high = ANGLES[0], ANGLES[-1]
    motion = OnePressureTurned().at(psi=np.array([low, high]))
    want = RING * abs(long(high, "A", "B") - long(low, "A", "B")) + 2 * plane.disc(0.040) * abs(long(high, "K", "X") - long(low, "K", "X"))
    assert_allclose(OnePressureTurned.line.oil(motion), want, rtol=1e-9)


def test_one_cylinder_too_many_is_told_of_the_line():
    machine = type("TooMany", (Turned,), {
        "lift": Cylinder("A", "B", bore=BORE, rod=ROD, works="rod"), "aux": Cylinder("K", "X", bore=40 * mm, rod=22 * mm),
    })  # fmt: skip
    with pytest.raises(DefinitionError, match="LiftCircuit"):
        pin_forces(machine().at(psi=0.0))


def test_cylinder_that_holds_nothing_is_refused_by_name():
    """Its ends are on one body: no load of this machine reaches it."""
    idle = Cylinder("O", "X", bore=40 * mm, rod=22 * mm)
    machine = type("Idle", (Turned,), {"idle": idle})
    with pytest.raises((DefinitionError, SingularError), match="idle"):
        idle.thrust(machine().at(psi=0.1))


# -- elements on the cylinder's own pins -------------------------------------------------------------------


def rope(length, rate):
    """Return the thrust of a chain that only pulls."""
    return -np.maximum(60e3 * (length - 0.80), 0.0)


class Crowded(Pulled):
    """A spring, a damper, a chain and a given force, all between A and B."""

    relief = Spring("A", "B", stiffness=12e3, free_length=0.40)
    slow = Damper("A", "B", coefficient=25e3)
    chain = Between("A", "B", rope)
    hoist = Actuator("A", "B", force=-1500.0)


def test_five_elements_on_two_points():
    """Each has its own thrust and ends; the cylinder carries the rest, and the arm's bearing notices nothing."""
    motion = Crowded().at(**pulled())
    forces = pin_forces(motion, rates={"S": 0.04})
    bare = pin_forces(Pulled().at(**pulled()))
    for k, psi in enumerate(ANGLES):
        AB, p = long(psi, "A", "B"), places([psi])
        want = {"relief": -12e3 * (AB - 0.40), "slow": 25e3 * 0.04, "chain": -60e3 * max(AB - 0.80, 0.0), "hoist": -1500.0}
        want["lift"] = moment(psi) / lever(psi, "A", "B") - sum(want.values())
        away = plane.toward(p["A"], p["B"])
        for name, push in want.items():
            assert_allclose(forces.thrusts[name][k], push, rtol=1e-10, atol=1e-9)
            assert_allclose(forces.force("A", on=name)[:, k], push * away, rtol=1e-9, atol=1e-8)
            assert_allclose(forces.force("B", on=name)[:, k], -push * away, rtol=1e-9, atol=1e-8)
        assert_allclose(forces.force("O", on="O B")[:, k], bare.force("O", on="O B")[:, k], rtol=1e-11)
    assert_allclose(driving_force(motion, rates={"S": 0.04}), -forces.thrusts["lift"], rtol=1e-10)


def test_spring_for_its_force():
    """A spring replaced by an actuator of its force: the same joints."""
    psi = ANGLES[1:2]
    sprung = type("Sprung", (Pulled,), {"relief": Spring("A", "G", stiffness=9e3, free_length=0.50)})
    push = -9e3 * (long(psi[0], "A", "G") - 0.50)
    given = type("Given", (Pulled,), {"relief": Actuator("A", "G", force=push)})
    first, second = (pin_forces(machine().at(**pulled(psi))) for machine in (sprung, given))
    for name, body in (("O", "O B"), ("A", "lift"), ("A", "relief"), ("G", "relief"), ("B", "O B")):
        assert_allclose(first.force(name, on=body), second.force(name, on=body), rtol=1e-12)
    want = (moment(psi[0]) - push * lever(psi[0], "A", "G")) / lever(psi[0], "A", "B")
    assert_allclose(first.thrusts["lift"], want, rtol=1e-11)


@first_daily(2, "count", [2, 50, 5])
def test_largest_force_lies_between_the_poses(count):
    """The bearing carries most in the middle of the stroke, the cylinder at neither end."""
    table = {(each.point, each.on): each for each in max_table(pin_forces(Pulled().sweep(count)))}

    def bearing(psi):
        p = places([psi])
        pull = moment(psi) / lever(psi, "A", "B") * plane.toward(p["A"], p["B"])
        return np.hypot(*(-pull - LOADS[0][1]))

    ends = [angle_at(1.00), angle_at(0.64)]
    for name, on, force in (("O", "OBG", bearing), ("A", "lift", lambda psi: -moment(psi) / lever(psi, "A", "B"))):
        most, where = plane.peak(force, *ends)
        assert_allclose(table[name, on].force, most, rtol=1e-6)
        assert_allclose(table[name, on].strokes["S"], 1.00 - long(where, "A", "B"), atol=1e-4 * 0.36)


def angle_at(AB):
    """Return the arm's angle where AB has a length: the cosine rule at O."""
    far = np.hypot(*PLACE_A)
    return np.arctan2(PLACE_A[1], PLACE_A[0]) - np.arccos((far**2 + OB**2 - AB**2) / (2 * far * OB))


class Heavier(Pulled):
    """A user's own: a bucket on the arm's end."""

    bucket = Weight("G", mass=75.0)


def test_subclass_adds_a_load():
    motion = Heavier().at(**pulled())
    want = np.array([moment(psi, [("G", (0.0, -(MASS + 75.0) * plane.G))]) / lever(psi, "A", "B") for psi in ANGLES])
    assert_allclose(Heavier.lift.thrust(motion), want, rtol=1e-11)
    assert_allclose(Heavier.line.holding(motion).working, -want / RING, rtol=1e-11)
