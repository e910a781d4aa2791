"""A point measured along a cylinder is on it: on the barrel from A, on the rod from B. By hand barrel and rod are two bodies."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Accumulator, AccumulatorBlock, Cylinder, FloatCircuit, LiftCircuit
from linkage import (
    LEFT,
    RIGHT,
    Actuator,
    Crank,
    Damper,
    DefinitionError,
    Dyad,
    Force,
    Ground,
    Guide,
    GuideFriction,
    Link,
    LinkMass,
    Mechanism,
    Moment,
    OnGuide,
    OnLink,
    Pin,
    PinFriction,
    SliderDyad,
    Spring,
    Stroke,
    Weight,
    bar,
    deg,
    distance,
    drive_force,
    driving_force,
    litre,
    mm,
    pin_force,
    pin_forces,
    ref,
)
from tests.for_all import for_all
from tests.laws.plane import cross
from tests.mechanisms.free_bodies import FreeBodies, places

SEEDS = range(24)


class Arm(Mechanism):
    """The cylinder AB lifts the arm O-B-T with a load at its end."""

    S = Stroke(0.0, 0.3)
    A = Ground(0.0, 0.0)
    O = Ground(0.8, 0.1)
    B = Dyad(A, O, AB=0.7 + S, OB=0.5, side=LEFT)
    T = OnLink(O, B, OT=1.2)
    load = Weight(T, mass=500)


class Bare(Arm):
    """The same with a cylinder that carries nothing."""

    lift = Cylinder("A", "B", bore=80 * mm, rod=40 * mm)


class Held(Bare):
    """The same with a point on the cylinder's barrel."""

    K = OnLink("A", "B", AK=0.3)


def variant(base, name="Variant", **members):
    """Return a subclass with members more, or others."""
    return type(name, (base,), {"__doc__": name, **members})


def by_hand(at, loads, hung=()):
    """Return the forces of Arm by free bodies, the cylinder as barrel and rod on a slide.

    `loads` are body, place and force; `hung` further cylinders: their name, the body and place of either end.
    """
    free, along = FreeBodies(), at["B"] - at["A"]
    free.pin("A", "barrel", "frame", at["A"])
    free.pin("O", "arm", "frame", at["O"])
    free.pin("B", "rod", "arm", at["B"])
    free.across("gland", "rod", "barrel", at["A"], along)
    free.torque("turn", "rod", "barrel")
    free.thrust("lift", "barrel", at["A"], "rod", at["B"])
    for name, first, P, second, Q in hung:
        free.thrust(name, first, P, second, Q)
    for load in loads:
        free.load(*load)
    found = free.solve()
    return found | {pin: np.array([found[pin + "x"], found[pin + "y"]]) for pin in "AOB"}


def assert_balanced(machine, motion, thrusts=("lift",)):
    """Assert that equilibrium, virtual work and the cylinders' own thrusts agree."""
    forces = pin_forces(motion)
    assert forces.gap < 1e-11
    assert forces.residual < 1e-11
    for name in thrusts:
        assert_allclose(forces.thrusts[name], machine.plan.members[name].thrust(motion), rtol=1e-10, atol=1e-6)
    return forces


# Points of every kind.


def drawn_points(rng):
    """Return members of random points on both sides of the cylinder with forces on them, and which side each is on."""
    members, sides = {}, {}
    for k in range(int(rng.integers(1, 6))):
        name, other = f"P{k}", f"P{k - 1}"
        start, end = ("A", "B") if rng.random() < 0.5 else ("B", "A")
        if k and rng.random() < 0.3:                           # measured from a point that is itself on the axis of that side
            members[other] = OnLink(start, end, **{start + other: float(rng.uniform(0.05, 0.3))})
            sides[other], start = start, other
        angle = {f"{end}{start}{name}": float(rng.uniform(-2, 2))} if rng.random() < 0.6 else {}
        members[name] = OnLink(start, end, **{start + name: float(rng.uniform(0.02, 0.4))}, **angle)
        sides[name] = sides.get(start, start)
        members[f"f{k}"] = Force(name, tuple(map(float, rng.uniform(-3e3, 3e3, 2))))
    return members, sides


@for_all("seed", SEEDS[:4], slow=SEEDS[4:])
def test_points_of_every_kind_by_hand(seed):
    members, sides = drawn_points(np.random.default_rng([710, seed]))
    machine = variant(Bare, **members)()
    motion = machine.sweep(5)
    forces = assert_balanced(machine, motion)
    assert machine.mobility == machine.gruebler == 1
    for k in range(5):
        at = places(motion, k)
        loads = [("arm", at["T"], (0.0, -500 * 9.80665))]
        pushes = [each for each in members.values() if isinstance(each, Force)]
        loads += [({"A": "barrel", "B": "rod"}[sides[each.point]], at[each.point], (each.x, each.y)) for each in pushes]
        own = by_hand(at, loads)
        assert_allclose(forces.thrusts["lift"][k], own["lift"], rtol=1e-9, atol=1e-6)
        assert_allclose(forces.force("A", on="lift")[:, k], own["A"], rtol=1e-9, atol=1e-6)
        assert_allclose(forces.force("B", on="lift")[:, k], own["B"], rtol=1e-9, atol=1e-6)
        assert_allclose(forces.force("O", on="O B T")[:, k], own["O"], rtol=1e-9, atol=1e-6)


def test_nothing_changes_for_a_point_without_a_load():
    bare, held = pin_forces(Bare().sweep(7)), pin_forces(Held().sweep(7))
    for point, on in (("A", "lift"), ("B", "lift"), ("O", "O B")):
        assert_allclose(held.force(point, on=on), bare.force(point, on=on), rtol=1e-12, atol=1e-9)
    assert_allclose(held.thrusts["lift"], bare.thrusts["lift"], rtol=1e-12, atol=1e-9)
    assert (Held().gruebler, Bare().gruebler) == (1, 1)
    shared = pin_forces(Held().sweep(7), split="least squares")
    assert_allclose(shared.thrusts["lift"], held.thrusts["lift"], rtol=1e-10, atol=1e-6)


def test_a_body_goes_by_the_cylinders_name_its_points_and_its_link():
    machine = variant(Held, barrel=Link("A", "K"), mass=Weight("K", mass=100))
    forces = pin_forces(machine().sweep(3))
    for on in ("lift", "AB", "ABK", "A K", "A B", "barrel"):
        assert_allclose(forces.force("A", on=on), forces.force("A", on="lift"))
    assert_allclose(sum(forces.on_body("lift").values()), 0.0, atol=1e-9)
    assert set(forces.on_body("lift")) == {"A", "B", "K"}
    assert pin_force("B", on="ABK").of(machine().sweep(3)) == pytest.approx(np.hypot(*forces.force("B", on="lift")))


def test_masses_and_moments_of_the_barrel_and_of_the_rod():
    machine = variant(
        Held, R=OnLink("B", "A", BR=0.1, ABR=-30 * deg), barrel=LinkMass("A K", mass=15, at=(0.2, 0.03)),
        rod=LinkMass("B R", mass=5), whole=LinkMass("A B", mass=7), twist=Moment("A B", M=120.0),
    )  # fmt: skip
    motion = machine().sweep(5)
    forces = assert_balanced(machine(), motion)
    for k in range(5):
        at = places(motion, k)
        u = (at["B"] - at["A"]) / np.hypot(*(at["B"] - at["A"]))
        centre = at["A"] + 0.2 * u + 0.03 * np.array([-u[1], u[0]])
        g = np.array([0.0, -9.80665])
        loads = [("arm", at["T"], 500 * g), ("barrel", centre, 15 * g), ("rod", (at["B"] + at["R"]) / 2, 5 * g)]
        ends = [("barrel", at["A"], 3.5 * g), ("rod", at["B"], 3.5 * g), ("barrel", at["A"], (0.0, 0.0), 120.0)]
        own = by_hand(at, [*loads, *ends])
        assert_allclose(forces.thrusts["lift"][k], own["lift"], rtol=1e-9)
        assert_allclose(forces.force("A", on="lift")[:, k], own["A"], rtol=1e-9, atol=1e-9)
        assert_allclose(forces.force("B", on="lift")[:, k], own["B"], rtol=1e-9, atol=1e-9)


# What is hung on a cylinder.


@pytest.mark.parametrize(("K", "side"), [(OnLink("A", "B", AK=0.3), "barrel"), (OnLink("B", "A", BK=0.3, ABK=25 * deg), "rod")])
@pytest.mark.parametrize("thrust", [1e3, -4e3])
def test_an_actuator_hung_on_it(K, side, thrust):
    machine = variant(Bare, K=K, E=OnLink("O", "B", OE=0.3, BOE=20 * deg), aux=Actuator("K", "E", force=thrust))()
    motion = machine.sweep(5)
    forces = assert_balanced(machine, motion)
    for k in range(5):
        at = places(motion, k)
        push = thrust * (at["E"] - at["K"]) / np.hypot(*(at["E"] - at["K"]))
        own = by_hand(at, [("arm", at["T"], (0.0, -500 * 9.80665)), (side, at["K"], -push), ("arm", at["E"], push)])
        assert_allclose(forces.thrusts["lift"][k], own["lift"], rtol=1e-9)
        assert_allclose(forces.force("B", on="lift")[:, k], own["B"], rtol=1e-9)
        assert_allclose(forces.force("K", on="aux")[:, k], push, rtol=1e-9)


class Chain(Held):
    """A cylinder hangs on the lift's barrel, and a third one on that one's rod."""

    S2, S3 = Stroke(0.0, 0.2), Stroke(0.0, 0.2)
    D, G = Ground(0.0, 0.6), Ground(0.3, 0.9)
    E = Dyad(D, "K", DE=0.3, KE=0.4 + S2, side=RIGHT)
    M = OnLink(E, "K", EM=0.1)
    F = Dyad(G, M, GF=0.5, MF=0.4 + S3, side=RIGHT)
    N = OnLink(M, F, MN=0.1, FMN=10 * deg)
    aux = Cylinder("K", E, bore=50 * mm, rod=30 * mm)
    third = Cylinder(M, F, bore=50 * mm, rod=30 * mm)
    box = Weight(N, mass=30)
    end = Weight(F, mass=20)


def test_a_cylinder_hung_on_a_cylinder_hung_on_a_cylinder():
    """The third cylinder's work is the potential energy's slope, by differences; it goes through the second and the first."""
    machine, at = Chain(), {"S": [0.05, 0.12, 0.2], "S2": [0.02, 0.1, 0.15], "S3": [0.05, 0.15, 0.1]}
    assert (machine.mobility, machine.gruebler) == (3, 3)
    forces = assert_balanced(machine, machine.at(**at), ("lift", "aux", "third"))

    def energy(**strokes):
        motion = machine.at(**strokes)
        return 9.80665 * (500 * motion.y("T") + 30 * motion.y("N") + 20 * motion.y("F"))

    for stroke, name in (("S", "lift"), ("S2", "aux"), ("S3", "third")):
        step = 1e-5
        up, down = (energy(**at | {stroke: np.array(at[stroke]) + way * step}) for way in (1, -1))
        assert_allclose(forces.thrusts[name], (up - down) / (2 * step), rtol=1e-6)
    assert_allclose(forces.force("M", on="third"), -forces.force("M", on="aux"))
    assert set(forces.on_body("aux")) == {"K", "E", "M"}
    for body in ("lift", "aux", "third"):
        assert_allclose(sum(forces.on_body(body).values()), 0.0, atol=1e-8)


class TwoOnOne(Held):
    """Two cylinders hang on the barrel's K, each turns a lever; a spring from barrel to rod pulls beside the oil."""

    S2, S3 = Stroke(0.0, 0.1), Stroke(0.0, 0.1)
    D, G = Ground(0.0, -0.7), Ground(0.5, -0.7)
    E = Dyad(D, "K", DE=0.5, KE=0.5 + S2, side=RIGHT)
    F = Dyad(G, "K", GF=0.5, KF=0.5 + S3, side=RIGHT)
    R = OnLink("B", "A", BR=0.1)
    one = Cylinder("K", E, bore=50 * mm, rod=30 * mm)
    two = Cylinder("K", F, bore=50 * mm, rod=30 * mm)
    clamp = Spring("K", R, stiffness=1e4, free_length=0.2)
    e, f = Weight(E, mass=30), Weight(F, mass=20)


def test_two_cylinders_on_one_pin_and_a_spring_from_barrel_to_rod():
    machine = TwoOnOne()
    motion = machine.at(S=[0.05, 0.1, 0.2], S2=[0.02, 0.1, 0.05], S3=[0.05, 0.0, 0.1])
    forces = assert_balanced(machine, motion, ("lift", "one", "two"))
    assert (machine.mobility, machine.gruebler) == (3, 3)
    for k in range(3):
        at = places(motion, k)
        gap = np.hypot(*(at["R"] - at["K"]))
        push = 1e4 * (0.2 - gap) * (at["R"] - at["K"]) / gap
        free = FreeBodies()
        free.pin("D", "e", "frame", at["D"])
        free.thrust("one", "frame", at["K"], "e", at["E"])
        free.load("e", at["E"], (0.0, -30 * 9.80665))
        free.pin("G", "f", "frame", at["G"])
        free.thrust("two", "frame", at["K"], "f", at["F"])
        free.load("f", at["F"], (0.0, -20 * 9.80665))
        hung = free.solve()
        loads = [("arm", at["T"], (0.0, -500 * 9.80665)), ("barrel", at["K"], -push), ("rod", at["R"], push)]
        for name, Q in (("one", "E"), ("two", "F")):
            assert_allclose(forces.thrusts[name][k], hung[name], rtol=1e-9)
            loads.append(("barrel", at["K"], -hung[name] * (at[Q] - at["K"]) / np.hypot(*(at[Q] - at["K"]))))
        own = by_hand(at, loads)
        assert_allclose(forces.thrusts["lift"][k], own["lift"], rtol=1e-9)
        assert_allclose(forces.force("A", on="lift")[:, k], own["A"], rtol=1e-9)


@pytest.mark.parametrize("ends", [("A", "B"), ("B", "A")])
def test_a_guide_on_it_rubs_on_the_side_it_is_measured_from(ends):
    """What the sliding takes is found twice: from the joint forces in equilibrium, and as the work of friction."""
    machine = variant(
        Held, rail=Guide(*ends), D=Ground(0.3, -0.2), C=SliderDyad("D", "rail", DC=0.5, side=RIGHT if ends[0] == "A" else LEFT),
        block=Weight("C", mass=40), rub=GuideFriction("C", coefficient=0.3),
    )()  # fmt: skip
    motion = machine.sweep(5)
    assert machine.mobility == machine.gruebler == 1
    assert_balanced(machine, motion)
    lost = {}
    for direction in ("extending", "retracting"):
        forces = pin_forces(motion, direction=direction)
        assert_allclose(forces.drives["S"], driving_force(motion, direction=direction), rtol=1e-10)
        assert_allclose(forces.thrusts["lift"], forces.drives["S"], rtol=1e-10)
        lost[direction] = np.abs(forces.drives["S"] - driving_force(motion))
        assert forces.residual < 1e-10
    assert lost["extending"].min() > 0.01


CARRIED = {
    "a carriage driven along the barrel": {"rail": Guide("A", "B"), "C": OnGuide("rail", at=0.1 + ref("S2"))},
    "a carriage driven along the rod": {"rail": Guide("B", "A"), "C": OnGuide("rail", at=0.1 + ref("S2"))},
    "an arm out of the barrel": {"C": OnLink("A", "B", AC=0.3 + ref("S2"), BAC=20 * deg), "small": Cylinder("A", "C", bore=0.05, rod=0.03)},
    "an arm out of the rod": {"C": OnLink("B", "A", BC=0.2 + ref("S2"), ABC=20 * deg)},
    "an arm that turns on the barrel": {"C": OnLink("K", "A", KC=0.2, AKC=0.3 + ref("S2"))},
    "a lever on a driven length": {"C": Dyad("K", "G", KC=0.3 + ref("S2"), GC=0.5, side=LEFT), "G": Ground(0.2, 0.9)},
}
LAST = list(CARRIED)[-2:]                                      # they hang on K


@for_all(("start", "end", "side"), [("A", "B", "barrel"), ("B", "A", "rod")])
def test_a_point_that_bars_hold_on_a_side_goes_with_it(start, end, side):
    members = {"K": OnLink(start, end, **{f"{start}K": 0.1}), "H": OnLink(start, end, **{f"{start}H": 0.2, f"{end}{start}H": 0.6})}
    members |= {"X": Dyad("K", "H", KX=0.2, HX=0.15, side=LEFT), "body": Link("A B K H X"), "f": Force("X", (300.0, -2000.0))}
    machine = variant(Bare, **members)()
    motion = machine.sweep(5)
    forces = assert_balanced(machine, motion)
    assert machine.mobility == machine.gruebler == 1
    for k in range(5):
        at = places(motion, k)
        own = by_hand(at, [("arm", at["T"], (0.0, -500 * 9.80665)), (side, at["X"], (300.0, -2000.0))])
        assert_allclose(forces.thrusts["lift"][k], own["lift"], rtol=1e-9, atol=1e-6)
        assert_allclose(forces.force("A", on="lift")[:, k], own["A"], rtol=1e-9, atol=1e-6)


@for_all(("base", "name"), [(base, name) for name in CARRIED for base in (Bare, Held)[name in LAST :]])
def test_what_a_second_stroke_moves_on_it(base, name):
    """The thrust is the potential energy's slope, by differences."""
    members, at = CARRIED[name], {"S": [0.05, 0.1, 0.2], "S2": [0.02, 0.1, 0.15]}
    machine = variant(base, S2=Stroke(0.0, 0.2), box=Weight("C", mass=50), **members)()
    forces = assert_balanced(machine, machine.at(**at), ("lift", "small")[: 1 + ("small" in members)])
    assert machine.mobility == machine.gruebler == 2

    def energy(step):
        motion = machine.at(S=np.array(at["S"]) + step, S2=at["S2"])
        return 9.80665 * (500 * motion.y("T") + 50 * motion.y("C"))

    assert_allclose(forces.thrusts["lift"], (energy(1e-5) - energy(-1e-5)) / 2e-5, rtol=1e-6)


def test_a_cylinder_that_is_given_with_the_loads_carries_as_well():
    machine = variant(Arm, K=OnLink("A", "B", AK=0.3, BAK=20 * deg), box=Weight("K", mass=50))()
    motion = machine.sweep(3)
    driven, given = pin_forces(motion), pin_forces(motion, ["load", "box", Cylinder("A", "B", bore=80 * mm, rod=40 * mm)])
    assert_allclose(given.force("A", on="Cylinder AB"), driven.force("A", on="ABK"), rtol=1e-12)
    assert_allclose(given.thrusts["Cylinder AB"], driven.thrusts["AB"], rtol=1e-12)


def test_friction_in_its_pins_where_something_hangs_on_it():
    machine = variant(
        Held, E=OnLink("O", "B", OE=0.3, BOE=20 * deg), aux=Spring("K", "E", stiffness=8e3, free_length=0.2),
        mass=Weight("K", mass=80), a=PinFriction("A", radius=0.03, coefficient=0.2), k=PinFriction("K", radius=0.02, coefficient=0.2),
    )()  # fmt: skip
    motion = machine.sweep(5)
    for direction in ("extending", "retracting"):
        forces = pin_forces(motion, direction=direction)
        assert_allclose(forces.drives["S"], driving_force(motion, direction=direction), rtol=1e-10)
        assert forces.residual < 1e-10


# Members that are no cylinder, cylinders that do not hold.


@pytest.mark.parametrize(
    ("member", "thrust"),
    [
        (Spring("A", "B", stiffness=2e3, free_length=0.5), lambda length, rate: 2e3 * (0.5 - length)),
        (Actuator("A", "B", force=1500.0), lambda length, rate: 1500.0 + 0 * length),
        (Damper("A", "B", coefficient=4e3), lambda length, rate: -4e3 * rate),
    ],
)
def test_a_spring_an_actuator_and_a_damper_carry_points_as_well(member, thrust):
    """Beside a crank the member alone holds its points: it is one body with them, its thrust that of its law at the rod end."""
    machine = variant(
        Arm, S=None, phi=Stroke(20 * deg, 80 * deg), A=Ground(0.0, -0.2), B=Crank("O", OB=0.5, angle="phi"), law=member,
        K=OnLink("A", "B", AK=0.3, BAK=15 * deg), R=OnLink("B", "A", BR=0.2), box=Weight("K", mass=60), bag=Weight("R", mass=25),
    )()  # fmt: skip
    motion = machine.sweep(5)
    forces = pin_forces(motion, rates={"phi": 0.4})
    assert forces.gap < 1e-11
    assert machine.mobility == machine.gruebler == 1
    length = motion.distance("A", "B")
    assert_allclose(forces.thrusts["law"], thrust(length, 0.4 * motion.ratio(distance("A", "B"))), rtol=1e-10)
    for k in range(5):
        at = places(motion, k)
        u = (at["B"] - at["A"]) / length[k]
        n, g = np.array([-u[1], u[0]]), np.array([0.0, -9.80665])
        loads = ((at["K"], 60 * g), (at["R"], 25 * g))
        across = -sum(cross(place - at["A"], force) for place, force in loads) / length[k]
        B = across * n - (forces.thrusts["law"][k] + 25 * g @ u) * u
        assert_allclose(forces.force("B", on="law")[:, k], B, rtol=1e-9)
        assert_allclose(forces.force("A", on="law")[:, k], -B - 85 * g, rtol=1e-9)


def test_a_spring_across_a_link_leaves_the_points_to_the_link():
    """T is on the arm, not on the spring that lies along it; the forces are those of the spring's pins as ever."""
    machine = variant(Bare, strap=Spring("O", "B", stiffness=1e4, free_length=0.45))
    forces = assert_balanced(machine(), machine().sweep(5))
    assert_allclose(forces.force("O", on="strap"), -forces.force("B", on="strap"))
    assert set(forces.on_body("strap")) == {"O", "B"}
    assert "T" in forces.on_body("O B T")


class Charged(Held):
    """The cylinder's thrust is the gas's; what the stroke still needs goes through the same pins."""

    block = AccumulatorBlock([Accumulator(volume=4 * litre, charge=50 * bar)])
    line = FloatCircuit("lift", AccumulatorBlock([Accumulator(volume=4 * litre, charge=50 * bar)]), charge_pressure=80 * bar, at=0.1)
    box = Weight("K", mass=100)


def test_a_gas_fed_cylinder_carries_its_points():
    machine = Charged()
    motion = machine.sweep(5)
    forces = assert_balanced(machine, motion)
    assert set(forces.on_body("lift")) == {"A", "B", "K"}
    assert set(forces.on_body("AB")) == {"A", "B"}
    for k in range(5):
        at = places(motion, k)
        own = by_hand(at, [("arm", at["T"], (0.0, -500 * 9.80665)), ("barrel", at["K"], (0.0, -100 * 9.80665))])
        assert_allclose(forces.thrusts["lift"][k] + forces.thrusts["AB"][k], own["lift"], rtol=1e-9, atol=1e-6)
        assert_allclose(forces.force("A", on="lift")[:, k] + forces.force("A", on="AB")[:, k], own["A"], rtol=1e-9, atol=1e-6)


def test_two_cylinders_side_by_side_share_by_area_and_the_first_carries():
    machine = variant(
        Held, second=Cylinder("A", "B", bore=63 * mm, rod=40 * mm), pump=LiftCircuit(["lift", "second"], pressure=200 * bar),
        box=Weight("K", mass=100),
    )()  # fmt: skip
    forces = assert_balanced(machine, machine.sweep(5), ("lift", "second"))
    assert_allclose(forces.thrusts["second"] * 80**2, forces.thrusts["lift"] * 63**2, rtol=1e-10)
    assert set(forces.on_body("lift")) == {"A", "B", "K"}
    assert set(forces.on_body("second")) == {"A", "B"}


# The other spellings, and what is refused.


class Parts(Mechanism):
    """Held from a list of parts."""

    S = Stroke(0.0, 0.3)
    A, O = Ground(0.0, 0.0), Ground(0.8, 0.1)
    ram = Link("A B", AB=0.7 + S)
    arm = Link("O B T", OB=0.5, OT=1.2, BOT=0)
    B, T = Pin(near=(0.65, 0.48)), Pin(near=(0.4, 1.0))
    K = OnLink("A", "B", AK=0.3)
    lift = Cylinder("A", "B", bore=80 * mm, rod=40 * mm)
    load = Weight("T", mass=500)
    box = Weight("K", mass=100)


class Linked(Parts):
    """The cylinder as one link with its points: K on the barrel, R on the rod."""

    ram = Link("A B K R", AB=0.7 + ref("S"), AK=0.3, BAK=0, BR=0.1, ABR=-30 * deg)
    K, R = Pin(near=(0.2, 0.2)), Pin(near=(0.6, 0.4))
    bag = Weight("R", mass=20)


ROD = {"R": OnLink("B", "A", BR=0.1, ABR=-30 * deg), "bag": Weight("R", mass=20)}


@pytest.mark.parametrize(("parts", "more"), [(Parts, {}), (variant(Parts, barrel=Link("A K", AK=0.3)), {}), (Linked, ROD)])
def test_the_spelling_by_parts_says_the_same(parts, more):
    parts, steps = parts(), variant(Held, box=Weight("K", mass=100), **more)()
    assert parts.gruebler == steps.gruebler == parts.mobility == 1
    ours, theirs = assert_balanced(parts, parts.sweep(5)), pin_forces(steps.sweep(5))
    for point in "AB":
        assert_allclose(ours.force(point, on="lift"), theirs.force(point, on="lift"), rtol=1e-9, atol=1e-6)


def test_a_link_that_would_stretch_is_refused_as_ever():
    """T is no point along the cylinder; a link of both its ends and T would have to be as long as it and rigid."""
    with pytest.raises(DefinitionError, match="mobility is 0"):
        variant(Bare, plate=Link("A", "B", "T"))
    with pytest.raises(DefinitionError, match="mobility is 0"):
        variant(Held, plate=Link("K", "B"))


@pytest.mark.parametrize(
    "members",
    [
        {"K": OnLink("A", "B", AK=0.6, BK=0.6, side=LEFT)},
        {"K": OnLink("A", "B", AK=0.3, BAK=30 * deg), "M": OnLink("K", "B", KM=0.1)},
    ],
)
def test_a_point_that_is_on_neither_side_is_refused_with_the_remedy(members):
    machine, point = variant(Bare, **members)(), list(members)[-1]
    with pytest.raises(DefinitionError, match=f"{point} = OnLink.* is measured along lift, .* them, {point} = OnLink"):
        pin_forces(machine.sweep(3))
    with pytest.raises(DefinitionError, match="keeps its place neither at A nor at B"):
        machine.evaluate([pin_force("O")], S=[0.1])


# In bulk, as requests, with derivatives.


def test_the_program_the_requests_and_their_gradients():
    machine = variant(Chain, twist=Force("N", (300.0, -200.0)), held=Weight("K", mass=100))
    one = machine()
    strokes = {"S": np.linspace(0.02, 0.25, 240), "S2": np.linspace(0.01, 0.15, 240), "S3": np.linspace(0.05, 0.15, 240)}
    many = pin_forces(one.at(**strokes))
    few = pin_forces(one.at(**{name: each[::60] for name, each in strokes.items()}))
    for ours, theirs in zip(many.joints, few.joints, strict=True):
        assert_allclose(ours.force[:, ::60], theirs.force, rtol=1e-9, atol=1e-6)
    request = pin_force("A", on="lift")
    (found,) = one.evaluate([request], **strokes)
    assert_allclose(found, np.hypot(*many.force("A", on="lift")), rtol=1e-10)
    point, wrt = {"S": 0.1, "S2": 0.1, "S3": 0.1}, {"AK": 0.3, "held.mass": 100.0, "OB": 0.5}
    for what in (request, drive_force("S2")):
        slopes = one.at(**point).gradient(what, wrt=list(wrt))
        for (name, value), slope in zip(wrt.items(), slopes, strict=True):
            step = 1e-5 * value
            up, down = (machine(**{name: value + way * step}).evaluate([what], **point)[0] for way in (1, -1))
            assert_allclose(slope, (up - down) / (2 * step), rtol=1e-5, atol=1e-4)
