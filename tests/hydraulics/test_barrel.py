"""Barrel and rod as two bodies: the gland's force as shear and moment of a beam, free bodies, points that others hang on."""

import pickle

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Accumulator, AccumulatorBlock, Cylinder, LiftCircuit, OilLine, OnBarrel, OnRod, thrust
from linkage import (
    LEFT,
    RIGHT,
    DefinitionError,
    Dyad,
    Force,
    Ground,
    LinkMass,
    Mechanism,
    Moment,
    OnLink,
    Part,
    Stroke,
    Weight,
    max_table,
    pin_force,
    pin_forces,
)
from linkage.files import load, to_toml
from linkage.loads import LoadCase
from linkage.pictures.scene import Scene
from linkage.units import bar, deg, g0, litre
from mechanisms.classics.stephenson_three import StephensonThreeFar
from tests.for_all import first_daily

BLOCK = AccumulatorBlock([Accumulator(volume=4 * litre, charge=40 * bar)])


class Boom(Mechanism):
    """A boom on a cylinder that carries a pump on its barrel and a hose on its rod."""

    S = Stroke(0.0, 0.4)
    O, A = Ground(0.0, 0.0), Ground(0.4, -0.5)
    B = Dyad(A, O, AB=0.8 + S, OB=0.9, side=LEFT)
    T = OnLink(O, B, OT=2.0, BOT=0.1)
    lift = Cylinder(A, B, bore=0.1, rod=0.06, closed=0.75, stroke=0.5, barrel_mass=40.0, rod_mass=25.0)
    K = OnBarrel(lift, 0.3, 0.1)
    R = OnRod(lift, 0.1, -0.04)
    crate, pump, hose = Weight(T, mass=500.0), Weight(K, mass=30.0), Weight(R, mass=10.0)


class OneBody(Boom):
    """The same with one body along the cylinder and masses typed at points of it."""

    lift = Cylinder("A", "B", bore=0.1, rod=0.06, closed=0.75, stroke=0.5)
    K = OnLink("A", "B", AK=np.hypot(0.3, 0.1), BAK=np.arctan2(0.1, 0.3))
    R = OnLink("B", "A", BR=np.hypot(0.1, 0.04), ABR=-np.arctan2(0.04, 0.1))
    G, H = OnLink("A", "B", AG=0.375), OnLink("B", "A", BH=0.375)
    barrel, piston_rod = Weight(G, mass=40.0), Weight(H, mass=25.0)


SEEDS = first_daily(2, "seed", range(4))


def drawn_at_random(seed):
    """Return a boom with dimensions of its own, the same as one body, and what a gland at the end of its barrel bears."""
    some = np.random.default_rng(seed)
    place, size = some.uniform(0.9, 1.1, 6), some.uniform(0.5, 2.0, 5)
    along, across, behind, aside, closed = 0.3 * size[0], 0.2 * size[1] - 0.2, 0.3 * size[2], 0.1 - 0.1 * size[3], 0.72 * place[5]
    changes = dict(OB=0.9 * place[0], OT=2.0 * place[1], A=(0.4 * place[2], -0.5 * place[3]))
    masses = {"crate.mass": 500.0 * size[4], "pump.mass": 30.0 * size[0], "hose.mass": 10.0 * size[1]}
    own = {"lift.closed": closed, "lift.barrel_mass": 40.0 * size[2], "lift.rod_mass": 25.0 * size[3]}
    two = Boom(**changes, **masses, **own, **{"K.along": along, "K.across": across, "R.along": behind, "R.across": aside})
    polar = dict(AK=np.hypot(along, across), BAK=np.arctan2(across, along), BR=np.hypot(behind, aside), ABR=np.arctan2(aside, behind))
    one = OneBody(**changes, **masses, **polar, AG=closed / 2, BH=closed / 2,
                  **{"barrel.mass": 40.0 * size[2], "piston_rod.mass": 25.0 * size[3]})  # fmt: skip
    return two, one


@SEEDS
def test_two_bodies_carry_what_one_with_weights_at_points_does(seed):
    two, one = drawn_at_random(seed)
    forces, whole = pin_forces(two.sweep(7)), pin_forces(one.sweep(7))
    assert_allclose(forces.thrusts["lift"], whole.thrusts["lift"], rtol=1e-12)
    assert forces.residual < 1e-12 and forces.gap < 1e-9
    for point in "AB":
        assert_allclose(forces.force(point), whole.force(point), rtol=1e-12, atol=1e-9)
    barrel, rod = (np.sum([*forces.on_body(name).values()], axis=0) for name in ("lift barrel", "lift rod"))
    largest = np.abs(forces.thrusts["lift"]).max()
    assert_allclose(barrel, 0.0, atol=1e-9 * largest)
    assert_allclose(rod, 0.0, atol=1e-9 * largest)
    inner = sum(forces.force(point, on="lift rod") for point in ("lift.gland", "lift.piston"))
    assert_allclose(np.hypot(*inner), np.hypot(forces.thrusts["lift"], forces.gland("lift").lateral), rtol=1e-12)


@SEEDS
def test_the_gland_bears_shear_and_moment_of_a_beam_on_two_pins(seed):
    machine, _ = drawn_at_random(seed)
    motion = machine.sweep(7)
    given, found = machine.dimensions, pin_forces(motion).gland("lift")
    A, B = motion["A"], motion["B"]
    length = np.hypot(*(B - A))
    along = (B - A) / length
    left = np.stack([-along[1], along[0]])
    closed = given["lift.closed"]
    loads = [  # mass, along from A, to the left of A -> B, whether on the barrel
        (given["lift.barrel_mass"], closed / 2 + 0 * length, 0.0, True),
        (given["lift.rod_mass"], length - closed / 2, 0.0, False),
        (given["pump.mass"], given["K.along"] + 0 * length, given["K.across"], True),
        (given["hose.mass"], length - given["R.along"], -given["R.across"], False),
    ]
    moments = sum(-mass * g0 * (at * left[1] - aside * along[1]) for mass, at, aside, _ in loads)
    at_B = -moments / length  # the lateral reaction at B, by moments about A
    on_rod = [(mass, at, aside) for mass, at, aside, is_barrel in loads if not is_barrel]
    lateral = -at_B - sum(-mass * g0 * left[1] for mass, _, _ in on_rod)
    moment = -at_B * (length - closed) - sum(-mass * g0 * ((at - closed) * left[1] - aside * along[1]) for mass, at, aside in on_rod)
    assert_allclose(found.lateral, lateral, rtol=1e-9, atol=1e-9 * abs(lateral).max())
    assert_allclose(found.moment, moment, rtol=1e-9, atol=1e-9 * abs(moment).max())
    assert_allclose(found.place, A + along * closed, rtol=1e-12)
    assert found.point == "lift.gland"


class Hung(Boom):
    """A second cylinder between the barrel of the first and a jib, both of two bodies."""

    S2 = Stroke(0.0, 0.2)
    N = Dyad(Boom.K, Boom.T, KN=0.5 + S2, TN=1.5, side=RIGHT)
    small = Cylinder(Boom.K, N, bore=0.06, rod=0.03, closed=0.45, count=2, barrel_mass=8.0, rod_mass=5.0)
    V = OnRod(small, 0.05, -0.03)
    tool, clamp = Weight(N, mass=100.0), Weight(V, mass=6.0)
    own = LinkMass(Boom.lift.barrel, mass=12.0, at=(0.2, 0.05))
    motor, hoses = Moment(Boom.lift.piston_rod, M=30.0), LinkMass("small.piston_rod", mass=3.0)
    pull = Force(Boom.R, (300.0, -200.0))


def place_on(motion, P, Q, along, across):
    """Return a place along P -> Q and to its left, from P."""
    way = (motion[Q] - motion[P]) / motion.distance(P, Q)
    return motion[P] + way * along + np.stack([-way[1], way[0]]) * across


def potential(motion):
    """Return what lies in the masses and forces of `Hung` by the places of the pins alone [J]."""
    parts = [
        (500.0, motion["T"]), (40.0, place_on(motion, "A", "B", 0.375, 0.0)), (25.0, place_on(motion, "B", "A", 0.375, 0.0)),
        (30.0, place_on(motion, "A", "B", 0.3, 0.1)), (10.0, place_on(motion, "B", "A", 0.1, -0.04)), (100.0, motion["N"]),
        (16.0, place_on(motion, "K", "N", 0.225, 0.0)), (10.0, place_on(motion, "N", "K", 0.225, 0.0)),
        (6.0, place_on(motion, "N", "K", 0.05, -0.03)), (12.0, place_on(motion, "A", "B", 0.2, 0.05)),
        (3.0, place_on(motion, "N", "K", 0.225, 0.0)),
    ]  # fmt: skip
    x, y = place_on(motion, "B", "A", 0.1, -0.04)
    return sum(mass * g0 * place[1] for mass, place in parts) - 300.0 * x + 200.0 * y - 30.0 * motion.angle("B", "A")


def test_a_cylinder_hung_on_a_barrel_and_virtual_work():
    machine, h = Hung(), 1e-4
    S, S2 = np.linspace(0.01, 0.39, 5), np.linspace(0.01, 0.19, 5)
    forces = pin_forces(machine.at(S=S, S2=S2))
    assert forces.residual < 1e-12 and forces.gap < 1e-9

    def slope(stroke):
        steps = [machine.at(S=S + k * h * (stroke == "S"), S2=S2 + k * h * (stroke == "S2")) for k in (-2, -1, 1, 2)]
        a, b, c, d = map(potential, steps)
        return (a - 8.0 * b + 8.0 * c - d) / (12.0 * h)

    assert_allclose(forces.thrusts["lift"], slope("S"), rtol=1e-8)
    assert_allclose(forces.thrusts["small"], slope("S2"), rtol=1e-8)
    assert forces.joints and {each.kind for each in forces.joints} == {"pin", "gland", "oil"}


@pytest.mark.slow
def test_parts_mirrored_files_pickle_and_pasted_plans():
    class Whole(Mechanism):
        left = Part(Hung)
        right = Part(Hung, at=(-1.0, 0.2), mirrored=True, pull=None, motor=None)
        own = LinkMass(left.lift.barrel, mass=0.0)

    class Calm(Hung):
        pull = Force(Hung.R, (0.0, 0.0))
        motor = Moment(Hung.lift.piston_rod, M=0.0)

    S, S2 = np.linspace(0.0, 0.4, 3), np.linspace(0.0, 0.2, 3)
    alone, calm = (pin_forces(each.at(S=S, S2=S2)) for each in (Hung(), Calm()))
    both = pin_forces(Whole().at(**{"left.S": S, "right.S": S, "left.S2": S2, "right.S2": S2}))
    for name in ("lift", "small"):
        assert_allclose(both.thrusts[f"left.{name}"], alone.thrusts[name], rtol=1e-12)
        assert_allclose(both.gland(f"left.{name}").moment, alone.gland(name).moment, rtol=1e-9)
        assert_allclose(both.thrusts[f"right.{name}"], calm.thrusts[name], rtol=1e-12)
        assert_allclose(both.gland(f"right.{name}").lateral, -calm.gland(name).lateral, rtol=1e-9)
        assert_allclose(both.gland(f"right.{name}").moment, -calm.gland(name).moment, rtol=1e-9)

    scope = {each.__name__: each for each in (Cylinder, OnBarrel, OnRod, Stroke, Ground, Dyad, OnLink, Weight, LinkMass, Moment, Force)}
    lines = "\n".join(f"    {line}" for line in str(Hung.plan).splitlines())
    exec(f"class Pasted(Mechanism):\n{lines}", scope := {**scope, "Mechanism": Mechanism, "LEFT": LEFT, "RIGHT": RIGHT})
    for machine in (scope["Pasted"](), load(to_toml(Hung)), pickle.loads(pickle.dumps(Hung()))):
        again = pin_forces((machine() if isinstance(machine, type) else machine).at(S=S, S2=S2))
        assert_allclose(again.thrusts["small"], alone.thrusts["small"], rtol=1e-15)
        assert_allclose(again.gland("lift").lateral, alone.gland("lift").lateral, rtol=1e-12)


def test_gravity_tables_and_derivatives_go_along():
    class OnSlope(Boom):
        slope = LoadCase(slope=10 * deg)
        pump_line = LiftCircuit(Boom.lift, pressure=200 * bar)

    forces = pin_forces(OnSlope().sweep(3), case="slope")
    assert forces.residual < 1e-12 and forces.gap < 1e-9
    rows = {(each.point, each.kind): each for each in max_table(pin_forces(Boom().sweep(5)))}
    assert rows["lift.gland", "gland"].force == pytest.approx(np.abs(pin_forces(Boom().sweep(5)).gland("lift").lateral).max(), rel=1e-6)
    names = ["lift.barrel_mass", "lift.closed", "K.along", "K.across", "R.along", "OB"]
    for request in (push := thrust("lift"), pin_force("lift.gland", "lift rod", "y")):
        slopes = Boom().at(S=0.13).gradient(request, names)
        for name, slope in zip(names, slopes, strict=True):
            value, step = Boom().dimensions[name], 1e-5
            low, high = (pin_forces(Boom(**{name: value + each}).at(S=0.13)) for each in (-step, step))
            low, high = ((each.thrusts["lift"] if request is push else each.force("lift.gland", "lift rod")[1]) for each in (low, high))
            assert slope == pytest.approx((high - low) / (2.0 * step), rel=1e-6, abs=1e-6)


def test_groups_gas_points_measured_along_and_trunnions():
    class Grouped(StephensonThreeFar):
        ram = Cylinder("C", "D", bore=0.05, rod=0.03, closed=0.06, barrel_mass=3.0, rod_mass=2.0)
        own = LinkMass(ram.barrel, mass=1.0)
        K, V = OnBarrel(ram, -0.02, 0.03), OnLink("D", "C", DV=0.02)
        valve, hose = Weight(K, mass=1.5), Weight(V, mass=0.5)

    class OnGas(Boom):
        line = OilLine(Boom.lift, BLOCK, charge_pressure=80 * bar, at=dict(S=0.1))

    class Sketched(Boom):
        B = Dyad("A", "O", AB=0.8 + Boom.S, OB=0.9, near=(-0.3, -0.8))
        T = OnLink("O", B, OT=2.0, BOT=0.1)
        N = Dyad("K", T, KN=0.5, TN=1.5, near=(-0.4, -0.4))

    assert_allclose(pin_forces(Sketched().sweep(3), ["crate", "lift"]).gland("lift").moment,
                    pin_forces(Boom().sweep(3), ["crate", "lift"]).gland("lift").moment, rtol=1e-12)  # fmt: skip
    grouped, on_gas = pin_forces(Grouped().sweep(7)), pin_forces(OnGas().sweep(3))
    for forces, body in ((grouped, "ram"), (on_gas, "lift")):
        assert forces.residual < 1e-12 and forces.gap < 1e-9
        for half in (f"{body} barrel", f"{body} rod"):
            assert_allclose(np.sum([*forces.on_body(half).values()], axis=0), 0.0, atol=1e-9 * np.abs(forces.thrusts[body]).max())
    assert "V" in grouped.on_body("ram rod") and "K" in grouped.on_body("ram barrel")
    assert_allclose(on_gas.gland("lift").lateral, pin_forces(Boom().sweep(3)).gland("lift").lateral, rtol=1e-9)
    (buckles,) = Boom.lift.buckling(Boom().sweep(3))
    assert "1200 mm long" in str(buckles)  # from the trunnions at A to the eye, whatever lies behind them


def test_pictures_show_both_bodies_where_they_are():
    scene = Scene(Hung().at(S=0.2, S2=0.1))
    assert ("A", "K") in scene.bodies and ("B", "R") in scene.bodies and ("N", "V") in scene.bodies
    assert not [name for name in (*scene.dots, *scene.pins) if "." in name] and "K" in scene.pins
    assert {(each.P, each.Q) for each in scene.cylinders} == {("A", "B"), ("K", "N")}
    assert next(each.mouth for each in scene.cylinders if each.P == "A") == pytest.approx(0.75)
    assert pin_forces(Boom().sweep(2)).members == {"lift barrel": "lift", "lift rod": "lift", "lift": "lift"}


def refused(**members):
    with pytest.raises(DefinitionError) as caught:
        pin_forces(type("Wrong", (Boom,), members)().sweep(3))
    return str(caught.value)


def test_what_cannot_be_is_said_with_the_remedy():
    ram = dict(bore=0.1, rod=0.06)
    with pytest.raises(DefinitionError, match=r"barrel_mass=-3\.0 is negative; give zero or more"):
        Cylinder("A", "B", **ram, barrel_mass=-3.0)
    assert "closed length is not given; add closed=" in refused(lift=Cylinder("A", "B", **ram))
    assert "is beyond its end, 750 mm from there" in refused(K=OnBarrel("lift", 0.8))
    assert "is beyond its pin" in refused(R=OnRod("lift", -0.05))
    assert "has no barrel and no rod; name a Cylinder" in refused(K=OnBarrel("crate", 0.3))
    assert "Cylinder 'left' is unknown in K. Did you mean lift?" in refused(K=OnBarrel("left", 0.3))
    beside = Cylinder("A", "B", **ram, closed=0.7, rod_mass=3.0)
    assert "Declare one with count=2" in refused(beside=beside, line=LiftCircuit(["lift", "beside"], pressure=200 * bar))
    with pytest.raises(DefinitionError, match="crate is no member of two bodies; those are lift"):
        pin_forces(Boom().sweep(3)).gland("crate")
    with pytest.raises(DefinitionError, match="declare this cylinder in OneBody"):
        pin_forces(OneBody().sweep(3), ["crate", Cylinder("A", "T", **ram, rod_mass=3.0)])
