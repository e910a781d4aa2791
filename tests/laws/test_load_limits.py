"""Members' own conditions in load charts and capacities: ropes that only pull, closed lines, holding valves, by hand and by statics."""

from itertools import product

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Cylinder, HoldingValve, LiftCircuit, OilLine, Pump, Relief, Tank, capacity, reserve, thrust
from linkage import (
    LEFT,
    RIGHT,
    Acting,
    Crank,
    DefinitionError,
    Dyad,
    Force,
    ForceElement,
    Ground,
    Link,
    Mechanism,
    OnLink,
    Over,
    PinFriction,
    Rope,
    Stroke,
    Weight,
    angle,
    distance,
    least,
    ramp,
    working_field,
)
from linkage.pictures.chart_text import ChartText
from linkage.statics.carried import greatest_kept
from linkage.units import bar, deg, g0, kN, mm
from tests.for_all import first_daily


def test_the_greatest_load_that_is_kept_spares_nothing_whatever_the_guess():
    alone, limit = np.array([5.0, 5e3, 1e5]), np.array([3e4, 2.0, 7e5])
    for power, guess in product((0.5, 1.0, 1.5, 3.0, 5.0), (np.nan, 10.0, 1e6)):
        found = greatest_kept(lambda load, power=power: alone * (1.0 - (load / limit) ** power), alone, np.full(3, guess))
        assert_allclose(found, limit, rtol=1e-10)
    alone = np.array([1.0, -1.0, np.nan])
    assert_allclose(greatest_kept(lambda load: alone + load, alone, np.ones(3)), [np.inf, 0.0, np.nan])


class Mast(Mechanism):
    """A telescope whose outer part hangs in a chain: along the boom the chain carries all that pulls inwards there."""

    a, t = Stroke(-50 * deg, 60 * deg), Stroke(0.0, 1.0)
    O, A = Ground(0.0, 2.0), Ground(0.1, 0.9)
    K = Crank(O, OK=2.0, angle=a)
    B, D, X = OnLink(O, K, OB=0.9), OnLink(O, K, OD=2.0 + t), OnLink(O, K, OX=1.5)
    chain = Rope(X, D, "Y", length=2.0)
    Y, T = OnLink(O, K, OY=2.0 + t - chain.last), OnLink(O, K, OT=3.6 + t - chain.last)
    outer = Link(Y, T)
    own = Weight(T, mass=50.0)
    lift, push = Cylinder(A, B, bore=100 * mm, rod=56 * mm, works="both"), Cylinder(O, D, bore=63 * mm, rod=40 * mm, works="both")
    lifts, pushes = LiftCircuit(lift, pressure=200 * bar), LiftCircuit(push, pressure=200 * bar)


RADII, HEIGHTS = np.array([2.2, 2.6, 2.9]), np.array([0.4, 1.2, 2.6, 3.4])


@pytest.mark.parametrize("along", [(0.0, 1.0), (0.0, -1.0), (1.0, 0.5), (-1.0, 0.0)])
def test_a_chain_by_hand(along):
    """The chain's pull is (m g (0, -1) - F along) along the boom, taken inwards."""
    field = working_field(Mast(), "T", RADII, HEIGHTS, along=along)
    unit = np.array(along) / np.hypot(*along)
    a = field.strokes["a"][field.reached]
    alone, share = 50.0 * g0 * np.sin(a), unit[0] * np.cos(a) + unit[1] * np.sin(a)
    found = field.of["tension chain"][field.reached]
    with np.errstate(divide="ignore"):
        wanted = np.where(alone < 0.0, 0.0, np.where(share < 0.0, -alone / share, np.inf))
    assert_allclose(found, wanted, rtol=1e-7)
    load, limiter = field.load[field.reached], field.limiter[field.reached]
    assert (load <= found).all() and (load[alone < 0.0] == 0.0).all()
    assert (limiter[(load == found) & (found > 0.0)] == "tension chain").all()
    taut = Mast.chain.tension(field.motion(), loads=["own", Force("T", (-unit[0] * load, -unit[1] * load))])
    assert (taut[alone > 0.0] > -1e-6 * (1.0 + load[alone > 0.0])).all()


def test_a_capacity_keeps_to_the_chain():
    mast = Mast()
    motion = mast.at(a=np.array([-0.4, 0.3, 0.9]), t=0.4)
    down, up = (Mast.lifts.capacity(motion, "T", along=(0.0, way)) for way in (1.0, -1.0))
    assert down[0] == 0.0 and (down[1:] > 1 * kN).all()
    assert_allclose(up, [0.0, 50.0 * g0, 50.0 * g0], rtol=1e-6)
    assert_allclose(motion[capacity("lift", "T", along=(0, -1))], up, rtol=1e-12)
    (answer,) = mast.answers([least(capacity("lift", "T", along=(0, -1)))])
    assert answer.value == 0.0


def levelled(seed):
    """Return a boom with a fork that a closed line keeps level, of random sizes."""
    random = np.random.default_rng(seed)
    some = random.uniform

    class Level(Mechanism):
        lift, tele = Stroke(-30 * deg, 45 * deg), Stroke(0.0, 0.6)
        O, A, M = Ground(0, 1.0), Ground(some(0.3, 0.5), some(0.1, 0.3)), Ground(some(-0.6, -0.4), some(1.2, 1.4))
        K = Crank(O, OK=1.0, angle=lift)
        B, N = OnLink(O, K, OB=0.9), OnLink(O, K, ON=some(0.5, 0.7))
        J, C = OnLink(O, K, OJ=2.0 + tele), OnLink(O, K, OC=some(1.15, 1.25) + tele)
        inner = Link(C, J)
        master, slave = Cylinder(M, N, bore=63 * mm, rod=36 * mm), Cylinder(C, "D", bore=63 * mm, rod=36 * mm)
        line = OilLine(master.rod_side, slave.rod_side, "valve", filled={"slave": some(0.72, 0.78), "master": 1.0}, make_up=2 * bar)
        valve = Relief(some(100, 200) * bar)
        D = Dyad(C, J, CD=slave.length, JD=0.35, side=LEFT)
        P = OnLink(J, D, JP=0.8, DJP=-60 * deg)
        own = Weight(P, mass=some(60.0, 120.0))
        ram, out = Cylinder(A, B, bore=90 * mm, rod=50 * mm, works="both"), Cylinder(O, J, bore=63 * mm, rod=40 * mm, works="both")
        pump, other = LiftCircuit(ram, pressure=180 * bar), LiftCircuit(out, pressure=180 * bar)

    return Level


@first_daily(1, "seed", range(8))
def test_a_closed_line_stays_between_empty_and_its_relief(seed):
    kind, seen = levelled(seed), set()
    for along in ((0.0, 1.0), (0.0, -1.0), (0.6, -0.8)):
        field = working_field(kind(), "P", np.linspace(1.8, 3.3, 5), np.linspace(0.0, 2.4, 5), along=along)
        motion, load = field.motion(), field.load[field.reached]
        relief = float(kind().dimensions["valve.pressure"])

        def pressure(share, motion=motion, load=load, along=along):
            pull = Force("P", (-along[0] * load * share, -along[1] * load * share))
            return kind.line.pressure(motion, loads=["own", pull])

        alone, kept, beyond = map(pressure, (0.0, 1.0, 1.001))
        works = (alone >= 2e5) & (alone <= relief)
        assert (load[~works] == 0.0).all()
        assert (kept[works] >= 2e5 - 1.0).all() and (kept[works] <= relief + 1.0).all()
        limited = works & (field.limiter[field.reached] == "line line")
        assert ((beyond < 2e5) | (beyond > relief))[limited].all()
        seen |= set(field.limiters)
    assert "line line" in seen


def test_cylinders_in_series_share_the_pumps_pressure():
    """Oil of the first one's rod side lifts the second: the pump carries both, p A = T1 + (T2 / A2) a1."""

    class Series(Mechanism):
        a = Stroke(-30 * deg, 30 * deg)
        O, A, C, E = Ground(0, 0), Ground(0.3, -0.9), Ground(2.4, 0.0), Ground(2.1, -0.9)
        B = Crank(O, OB=0.8, angle=a)
        G = OnLink(O, B, OG=1.1)
        first, second = Cylinder(A, B, bore=80 * mm, rod=40 * mm), Cylinder(E, "F", bore=70 * mm, rod=36 * mm)
        series = OilLine(first.rod_side, second.piston_side, filled={"second": 0.95, "first": 0.95})
        F = Dyad(E, C, EF=second.length, CF=0.7, side=LEFT)
        one, two = Weight(G, mass=300.0), Weight(F, mass=400.0)
        supply = OilLine(first.piston_side, Pump(160 * bar))

    motion = Series().sweep(5)
    load = Series.supply.capacity(motion, "G")
    pull = Force("G", (np.zeros(5), -load))
    assert_allclose(Series.supply.reserve(motion, ["one", "two", pull]), 1.0, rtol=1e-9)
    assert_allclose(Series.supply.pressure(motion, ["one", "two", pull]), 160 * bar, rtol=1e-9)


class Held(Mechanism):
    """A boom whose line has a holding valve; a crank on its tip has a cylinder of its own."""

    a, b = Stroke(0.0, 50 * deg), Stroke(-80 * deg, -20 * deg)
    O, A = Ground(0, 1.0), Ground(0.4, 0.2)
    B = Crank(O, OB=0.9, angle=a)
    J = OnLink(O, B, OJ=2.0)
    C = Crank(J, JC=0.4, angle=b)
    P = OnLink(J, C, JP=1.5)
    own = Weight(P, mass=60.0)
    ram, dip = Cylinder(A, B, bore=100 * mm, rod=50 * mm), Cylinder(O, C, bore=125 * mm, rod=60 * mm, works="both")
    supply, tank = Pump(200 * bar), Tank(5 * bar)
    lifts, back = OilLine(ram.piston_side, supply), OilLine(ram.rod_side, tank)
    dips = LiftCircuit(dip, pressure=250 * bar)
    valve = HoldingValve(lifts, pilot=back, setting=90 * bar, ratio=4)


def test_a_holding_valve_limits_by_its_setting():
    field = working_field(Held(), "P", [2.0, 2.4, 2.8], [0.2, 0.8, 1.4])
    motion, load = field.motion(), field.of["setting valve"][field.reached]
    pull = Force("P", (0.0 * load, -load))
    assert_allclose(Held.valve.load_pressure(motion, ["own", pull]), 90 * bar, rtol=1e-9)
    assert "setting valve" in field.limiters
    assert_allclose(Held.lifts.capacity(motion, "P"), np.minimum(field.of["ram"][field.reached], load), rtol=1e-9)


def test_rods_that_buckle_are_told_and_limit_nothing():
    thin = Held(**{"dip.rod": 20 * mm})
    field = working_field(thin, "P", [2.0, 2.4], [0.8, 1.4])
    use = Held.dip.buckling_use(field.motion(), ["own", Force("P", (0.0 * field.load[field.reached], -field.load[field.reached]))])
    told = [each for each in field.remarks if "buckling" in each]
    assert told == ([f"buckling dip fails in {np.sum(use > 1.0)} of the cells"] if (use > 1.0).any() else [])


# The direction of a load.


class Bucket(Mechanism):
    """A crank QT that a cylinder turns through a rod; a tooth T."""

    S = Stroke(-0.03, 0.03)
    V, Q, K = Ground(0, 0), Ground(0.3, -0.401), Ground(-0.6, 0.257)
    R = Dyad(K, V, KR=0.6 + S, VR=0.257, side=LEFT)
    L = OnLink(V, R, VL=0.22, RVL=180 * deg)
    N = Dyad(L, Q, LN=0.3, QN=0.181, side=LEFT)
    T = OnLink(Q, N, QT=0.547, NQT=180 * deg)
    ram = Cylinder(K, R, bore=40 * mm, rod=25 * mm)
    pump = LiftCircuit(ram, pressure=157 * bar)


def test_what_is_too_heavy_alone_lifts_no_load_that_relieves_it():
    """By hand: a ram that pushes under a beam; a load on its tail relieves the ram, which may then pull with its rod side."""

    class Beam(Mechanism):
        S = Stroke(0.0, 0.2)
        O, A = Ground(0.0, 1.0), Ground(1.0, 0.0)
        B = Dyad(O, A, OB=1.0, AB=0.9 + S, side=LEFT)
        T, U = OnLink(O, B, OT=3.0), OnLink(O, B, OU=1.0, BOU=180 * deg)
        load = Weight(T, mass=1696.0)
        ram = Cylinder(A, B, bore=63 * mm, rod=36 * mm, works="both")
        pump = LiftCircuit(ram, pressure=160 * bar)

    motion, push = Beam().sweep(5), 160e5 * np.pi / 4 * 0.063**2
    alone = motion[thrust("ram")]
    assert alone.min() < push < alone.max()
    found = Beam.pump.capacity(motion, "U")
    pull = 160e5 * np.pi / 4 * (0.063**2 - 0.036**2)
    by_hand = (alone + pull) / (-motion.ratio("U")[1] / motion.ratio(distance("A", "B")))
    assert_allclose(found, np.where(alone > push, 0.0, by_hand), rtol=1e-9)
    lighter = Beam(**{"load.mass": 200.0}).sweep(5)
    assert np.all(Beam.pump.capacity(lighter, "U") > 1e3)


def test_a_direction_turns_with_a_body():
    """Square to the arm QT the load is the thrust over |QT dangle/dS|, whichever way the direction is said."""
    bucket = Bucket()
    motion = bucket.sweep(7)
    a, seen = angle("Q", "T"), motion.angle("Q", "T")
    rate = motion.ratio(a) * 0.547
    way = np.sign(rate[0])
    wanted = 157e5 * np.pi / 4 * 0.04**2 / np.abs(rate)
    numbers = -way * np.sin(seen), way * np.cos(seen)
    spelled = [(-way * np.sin(a), way * np.cos(a)), numbers, np.stack(numbers)]
    for along in [*spelled, (-3 * way * np.sin(a), 3 * way * np.cos(a))]:
        assert_allclose(Bucket.pump.capacity(motion, "T", along=along), wanted, rtol=1e-9)
    for each in spelled[:1]:
        assert_allclose(bucket.evaluate([capacity("ram", "T", along=each)], S=motion.strokes["S"])[0], wanted, rtol=1e-9)
        (answer,) = bucket.answers([least(capacity("ram", "T", along=each))])
        assert answer.value == pytest.approx(wanted.min(), rel=1e-3) and answer.value <= wanted.min() * (1.0 + 1e-12)
    for wrong in ((way * np.sin(a), -way * np.cos(a)), (way * np.sin(seen), -way * np.cos(seen))):
        with pytest.raises(DefinitionError, match="turn it round"):
            Bucket.pump.capacity(motion, "T", along=wrong)


def test_what_is_no_direction_is_said():
    motion = Bucket().sweep(3)
    for along, words in (
        ((0.0, 0.0), "no direction"), ("up", "no direction"), ((1.0,), "no direction"), ((np.nan, 1.0), "no direction"),
        ((np.ones(4), np.ones(4)), "does not fit the poses"), ((angle("Q", "T") * 0.0, 0.0), "has no length at 3 poses"),
    ):  # fmt: skip
        with pytest.raises(DefinitionError, match=words):
            Bucket.pump.capacity(motion, "T", along=along)
    with pytest.raises(DefinitionError, match="an array, which is of the poses of one motion"):
        capacity("ram", "T", along=(np.ones(3), np.zeros(3)))


def test_a_field_against_a_direction_that_turns():
    """Square to the boom of a mast the load is that of the same direction as numbers, cell by cell."""
    a = angle("O", "K")
    field = working_field(Mast(), "T", [2.6], [2.6, 3.2], along=(-np.sin(a), np.cos(a)))
    assert "sin(angle(O, K))" in ChartText(field).title
    for k, height in enumerate(field.y):
        turned = float(field.strokes["a"][k, 0])
        single = working_field(Mast(), "T", [2.6], [height], along=(-np.sin(turned), np.cos(turned)))
        assert_allclose(field.load[k, 0], single.load[0, 0], rtol=1e-9)


def test_friction_counts_in_a_members_condition():
    """With friction in its sheave's pin a boom lifts no more than the chain stays taut under, whichever way strokes move."""

    class Rough(Mast):
        rubs = PinFriction("O", radius=30 * mm, coefficient=0.2)

    field = working_field(Rough(), "T", [2.4], [2.9], along=(0.0, -1.0))
    load = float(field.load[0, 0])
    pull = Force("T", (0.0, load))
    motion = field.motion()
    ways = [Acting(["own", "rubs", pull], direction=way, drive=drive) for way in ("extending", "retracting") for drive in ("a", "t")]
    assert min(float(Rough.chain.tension(motion, acting=each)[0]) for each in ways) > -1e-3
    assert 0.0 < load < 50.0 * g0 * (1.0 + 1e-7)


def test_over_a_path_in_time_a_capacity_beside_a_rope_is_that_as_it_runs():
    """The load that it names uses up the pump beside the machine's own, with friction and a rope."""

    class Hoist(Mechanism):
        """A boom whose tip draws a rope."""

        u = Stroke(0.0, 0.6)
        O, A, R, Q = Ground(0, 1.8), Ground(0.15, 0.9), Ground(2.0, 5.0), Ground(4.0, 5.0)
        B = Dyad(A, O, AB=0.95 + u, OB=1.1, side=RIGHT)
        T = OnLink(O, B, OT=2.6, BOT=8 * deg)
        rope = Rope(T, R, "D", length=4.6)
        D = Dyad(R, Q, RD=rope.last, QD=2.0, side=RIGHT)
        rubs, hang, load = PinFriction(O, radius=40 * mm, coefficient=0.2), Weight(D, mass=50), Weight(T, mass=600)
        boom = Cylinder(A, B, bore=80 * mm, rod=45 * mm)
        lift = LiftCircuit(boom, pressure=180 * bar)
        run = Over.path(u=ramp(0.05, 0.5, speed=0.2, acceleration=0.5))

    motion = Hoist().sweep(5, over="run")
    beside = [*Hoist.plan.of_kind(ForceElement), Force("T", (0.0, -1.0 * motion[capacity("boom", "T")]))]
    assert_allclose(motion[reserve("boom", acting=Acting(beside))], 1.0, rtol=1e-9)
