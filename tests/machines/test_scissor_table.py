"""A scissor lift table: two cylinders between its arms, one foot on a roller, the deck on a rolling pin.

Arms AC and BD cross in M; B rolls on the floor, C under the deck DT. All figures are illustrative, of a 2 t table.
"""

from functools import cache

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Cylinder, LiftCircuit, lift_verdicts
from linkage import (
    LEFT,
    Dyad,
    Ground,
    Guide,
    GuideFriction,
    Link,
    LinkMass,
    Mechanism,
    OnGuide,
    OnLink,
    Pin,
    PinSlotDyad,
    Slide,
    Stroke,
    Weight,
    drawn,
    driving_force,
    pin_forces,
)
from linkage.units import bar, mm
from tests.for_all import for_all
from tests.machines import plane
from tests.machines.words import number
from tests.mechanisms.free_bodies import FreeBodies

ARM, AP, BQ, DT, DH = 2.0, 0.15, 1.10, 2.2, 1.3  # m
MASS, OWN, DECK = 2000.0, 120.0, 150.0  # kg
L0 = 0.760


class Table(Mechanism):
    """By the roller's place on the floor: the nearer to the foot, the higher. The cylinders hang beside it."""

    s = Stroke(1.15, 1.95)

    A = Ground(0.0, 0.0)
    floor = Guide((0.0, 0.0), angle=0.0)
    B = OnGuide(floor, at=s)
    M = Dyad(A, B, AM=ARM / 2, BM=ARM / 2, side=LEFT)
    C = OnLink(A, M, AC=ARM)
    D = OnLink(B, M, BD=ARM)
    T = PinSlotDyad(D, C, DT=DT)
    H = OnLink(D, T, DH=DH)
    P = OnLink(A, M, AP=AP)
    Q = OnLink(B, M, BQ=BQ)

    load = Weight(H, mass=MASS)
    rising = LinkMass("A C", mass=OWN)
    falling = LinkMass("B D", mass=OWN)
    deck = LinkMass("D T", mass=DECK)
    lift = Cylinder(P, Q, bore=100 * mm, rod=63 * mm, count=2, closed=0.755, stroke=0.110)
    line = LiftCircuit(lift, pressure=160 * bar, relief=175 * bar, back_pressure=3 * bar)


@cache
def table_of_links():
    """Return the table by the cylinders' length, as a parts list: one group."""

    class TableOfLinks(Mechanism):
        """By the cylinders' length, as a parts list: one group."""

        S = Stroke(0.0, 0.110)
        sketch = drawn(S=0.060)

        A = Ground(0.0, 0.0)
        floor = Guide((0.0, 0.0), angle=0.0)
        B, M, C, D = Pin(near=(1.60, 0.0)), Pin(near=(0.80, 0.60)), Pin(near=(1.60, 1.20)), Pin(near=(0.0, 1.20))
        P, Q, T, H = Pin(near=(0.12, 0.09)), Pin(near=(0.72, 0.66)), Pin(near=(2.2, 1.20)), Pin(near=(1.3, 1.20))
        first = Link("A P M C", AC=ARM, AM=ARM / 2, CAM=0.0, AP=AP, CAP=0.0)
        second = Link("B M Q D", BD=ARM, BM=ARM / 2, DBM=0.0, BQ=BQ, DBQ=0.0)
        plate = Link("D H T", DT=DT, DH=DH, TDH=0.0)
        top = Guide(D, T)
        ram = Link("P Q", PQ=L0 + S)
        wheel, roller = Slide(B, floor), Slide(C, top)

        load = Weight(H, mass=MASS)
        rising = LinkMass("A C", mass=OWN)
        falling = LinkMass("B D", mass=OWN)
        deck = LinkMass("D T", mass=DECK)
        lift = Cylinder(P, Q, bore=100 * mm, rod=63 * mm, count=2, closed=0.755, stroke=0.110)
        line = LiftCircuit(lift, pressure=160 * bar, relief=175 * bar, back_pressure=3 * bar)

    return TableOfLinks


# -- by hand -----------------------------------------------------------------------------------------------

PLACES = np.array([1.90, 1.70, 1.45, 1.25])
LOADS = [
    ("H", (0.0, -MASS * plane.G)),
    *((name, (0.0, -mass / 2 * plane.G)) for name, mass in (("A", OWN), ("C", OWN), ("B", OWN), ("D", OWN), ("D", DECK), ("T", DECK))),
]


def places(q):
    """Return every place by the roller's distance from the foot."""
    cos = q[0] / ARM
    sin = np.sqrt(1 - cos**2)
    up, down = plane.point(cos, sin), plane.point(-cos, sin)
    B, D = plane.point(q[0], 0 * q[0]), plane.point(0 * q[0], ARM * sin)
    return {
        "A": plane.point(0.0, 0.0), "B": B, "M": ARM / 2 * up, "C": ARM * up, "D": D, "P": AP * up, "Q": B + BQ * down,
        "T": D + plane.point(DT, 0.0), "H": D + plane.point(DH, 0.0),
    }  # fmt: skip


def long(s):
    """Return the cylinders' length."""
    p = places([s])
    return plane.length(p["P"], p["Q"])


def thrust(s):
    """Return both cylinders' thrust by virtual work."""
    return plane.balance(places, [s], LOADS, [("P", "Q")])[0]


def cut(s, rub=lambda guide: 0.0, sense=0):
    """Return the free bodies' forces; `sense` 1 where the table rises, the rollers then running inwards."""
    p, bodies = places([s]), FreeBodies()
    bodies.pin("A", "rising", "frame", p["A"])
    bodies.along("B", "falling", "frame", p["B"], (0.0, 1.0))
    bodies.pin("M", "falling", "rising", p["M"])
    bodies.pin("D", "deck", "falling", p["D"])
    bodies.along("C", "rising", "deck", p["C"], (0.0, 1.0))
    bodies.thrust("lift", "rising", p["P"], "falling", p["Q"])
    bodies.load("deck", p["H"], LOADS[0][1])
    for body, ends, mass in (("rising", "AC", OWN), ("falling", "BD", OWN), ("deck", "DT", DECK)):
        for end in ends:
            bodies.load(body, p[end], (0.0, -mass / 2 * plane.G))
    bodies.load("falling", p["B"], (sense * abs(rub("B")), 0.0))  # B runs towards -x
    bodies.load("rising", p["C"], (sense * abs(rub("C")), 0.0))  # C too, along the deck
    bodies.load("deck", p["C"], (-sense * abs(rub("C")), 0.0))
    return bodies.solve()


BY_ROLLER = {"s": PLACES}
BOTH = for_all(("machine", "at"), lambda: [(Table, BY_ROLLER), (table_of_links(), by_length())])


def by_length():
    """Return the cylinders' stroke at every place."""
    return {"S": np.array([long(s) - L0 for s in PLACES])}


@BOTH
def test_positions(machine, at):
    motion = machine().at(**at)
    for k, s in enumerate(PLACES):
        p = places([s])
        for name in "BMCDPQTH":
            assert_allclose(motion[name][:, k], p[name], atol=1e-10)
    assert machine().mobility == 1


@BOTH
def test_thrust_and_pressure(machine, at):
    motion = machine().at(**at)
    want = np.array([thrust(s) for s in PLACES])
    area, ring = 2 * plane.disc(0.100), 2 * plane.annulus(0.100, 0.063)
    assert np.all(want > 0)
    assert_allclose(machine.lift.thrust(motion), want, rtol=1e-9)
    assert_allclose(pin_forces(motion).thrusts["lift"], want, rtol=1e-9)
    assert_allclose(machine.lift.pressure(motion), (want + 3e5 * ring) / area, rtol=1e-9)
    assert_allclose(machine.line.reserve(motion), (160e5 * area - 3e5 * ring) / want, rtol=1e-9)
    assert_allclose(machine.line.holding(motion).working, want / area, rtol=1e-9)


def test_generalised_force_of_the_roller_runs_the_other_way():
    """Driving the roller outwards lowers the table: a negative force lifts, and it is not the cylinders' thrust."""
    found = driving_force(Table().at(s=PLACES))
    assert_allclose(found, [-plane.work(places, [s], LOADS) for s in PLACES], rtol=1e-11)
    assert np.all(found < 0)


@BOTH
def test_pins_and_rollers(machine, at):
    forces = pin_forces(machine().at(**at))
    for k, s in enumerate(PLACES):
        want, p = cut(s), places([s])
        size = max(map(abs, want.values()))
        for name, body in (("A", "A C"), ("M", "B D"), ("D", "D T")):
            assert_allclose(forces.force(name, on=body)[:, k], [want[name + "x"], want[name + "y"]], atol=1e-9 * size)
        assert_allclose(forces.force("B", on="B D")[:, k], [0.0, want["B"]], atol=1e-9 * size)
        assert_allclose(forces.force("C", on="A C")[:, k], [0.0, want["C"]], atol=1e-9 * size)
        push = want["lift"] * plane.toward(p["P"], p["Q"])
        assert_allclose(forces.force("P", on="A C")[:, k], -push, atol=1e-9 * size)
        assert_allclose(forces.force("Q", on="B D")[:, k], push, atol=1e-9 * size)


def test_capacity_over_the_deck():
    """What both cylinders lift at H beside the table's own weight."""
    motion = Table().at(s=PLACES)
    own = LOADS[1:]
    most = 160e5 * 2 * plane.disc(0.100) - 3e5 * 2 * plane.annulus(0.100, 0.063)
    found = Table.line.capacity(motion, "H", loads=["rising", "falling", "deck"], along=(0, 1))
    for k, s in enumerate(PLACES):
        lever = plane.stretch(places, [s], "P", "Q")
        spare = most + plane.work(places, [s], own) / lever
        assert_allclose(found[k], spare / (plane.rate(places, [s])["H"][1] / lever), rtol=1e-9)


# -- friction of the rollers -------------------------------------------------------------------------------


class Stiff(Table):
    """Rollers on dry bushes."""

    foot = GuideFriction("B", coefficient=0.08)
    head = GuideFriction("C", coefficient=0.08)


@cache
def stiff_links():
    """Return the same in the parts list."""

    class StiffLinks(table_of_links()):
        """The same in the parts list."""

        foot = GuideFriction("B", coefficient=0.08)
        head = GuideFriction("C", coefficient=0.08)

    return StiffLinks


@pytest.mark.slow
@for_all(("machine", "at"), lambda: [(Stiff, BY_ROLLER), (stiff_links(), by_length())])
@pytest.mark.parametrize(("direction", "sense"), [("extending", 1), ("retracting", -1)])
def test_rollers_rub(machine, at, direction, sense):
    """In what is said of the cylinder, `extending` means that it grows: the table rises, and the stroke s falls."""
    motion = machine().at(**at)
    named = direction if machine is stiff_links() else {"extending": "retracting", "retracting": "extending"}[direction]
    forces, carried = pin_forces(motion, direction=named), machine.lift.thrust(motion, direction=direction)
    for k, s in enumerate(PLACES):
        want = plane.rubbed(lambda size, s=s: cut(s, lambda guide: 0.08 * size(guide), sense), "", "BC")
        size = max(map(abs, want.values()))
        assert_allclose(carried[k], want["lift"], rtol=1e-9)
        assert_allclose(forces.thrusts["lift"][k], want["lift"], rtol=1e-9)
        assert_allclose(forces.force("M", on="B D")[:, k], [want["Mx"], want["My"]], atol=1e-9 * size)
        assert (want["lift"] - thrust(s)) * sense > 0


# -- verdicts ----------------------------------------------------------------------------------------------


def test_verdicts():
    motion = Table().sweep(3)
    area, ring = 2 * plane.disc(0.100), 2 * plane.annulus(0.100, 0.063)
    most, _ = plane.peak(thrust, 1.15, 1.95)
    lifting, oil, holding, _ = lift_verdicts(Table.line, motion)
    reserve = (160e5 * area - 3e5 * ring) / most
    assert bool(lifting) == (reserve >= 1.0)
    assert_allclose(number("least reserve is", lifting), reserve, rtol=1e-3)
    assert_allclose(number("up to", holding), most / area / bar, rtol=1e-3)
    assert bool(holding) == (most / area <= 175e5)
    low, high = long(1.95), long(1.15)
    assert_allclose(number("", oil), (high - low) * area / 1e-3, rtol=1e-2)
    use, _ = plane.peak(lambda s: thrust(s) / 2 / plane.critical(0.063, long(s)), 1.15, 1.95)
    checks = {each.rule: each for each in Table.lift.checks(motion)}
    assert bool(checks["buckling"]) == (use * 3.5 <= 1.0)
    assert_allclose(number("safety", checks["buckling"]), 1 / use, rtol=6e-3)
    assert not checks["length"]
    assert f"{(high - 0.865) / mm:.1f} mm are missing open" in str(checks["length"])
