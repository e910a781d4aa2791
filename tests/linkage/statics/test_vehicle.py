"""A vehicle on its supports: axle loads against closed forms, lift-off, slopes, tipping, slipping, and what is refused."""

import math
import re
from itertools import combinations

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from linkage import (
    LEFT,
    DefinitionError,
    Dyad,
    Ground,
    Guide,
    Link,
    Mechanism,
    OnGuide,
    OnLink,
    Part,
    Stroke,
    axle_load,
    least,
    most,
    pin_forces,
    reaction,
    slipping,
    standing,
)
from linkage.formulas import equations
from linkage.loads import Force, LinkMass, LoadCase, Moment, PinFriction, Spring, Support, Weight
from linkage.pictures.page_judge import share_used
from linkage.reports import results
from linkage.statics import Standing
from linkage.statics.vehicle import load_sentence
from linkage.units import deg, g0, kN
from tests.for_all import first_daily, for_all


class Digger(Mechanism):
    """A boom with an arm on a frame with two axles."""

    S = Stroke(0.0, 0.35)
    s = Stroke(0.0, 0.25)
    F, R, G = Ground(1.5, 0.1), Ground(-1.2, -0.05), Ground(-0.3, 0.8)
    O, A = Ground(0.5, 1.0), Ground(0.9, 0.6)
    B = Dyad(A, O, AB=0.9 + S, OB=0.8, side=LEFT)
    C = OnLink(O, B, OC=2.2)
    D = Dyad(B, C, BD=1.2 + s, CD=0.5, side=LEFT)
    T = OnLink(C, D, CT=1.4)
    boom = Link(O, B, C)
    body = Weight(G, mass=3000)
    own = LinkMass(boom, mass=220, at=(1.0, 0.05))
    load = Weight(T, mass=150)
    wind = Force(T, (-200.0, 30.0))
    twist = Moment(boom, M=120.0)
    coil = Spring(A, B, stiffness=5000.0, free_length=0.8)
    front = Support(F, (0, 1), friction=0.5)
    rear = Support(R, (0, 1), friction=0.6)
    up, down = LoadCase(slope=10 * deg), LoadCase(slope=-12 * deg)
    heavy = LoadCase(scale={"load": 5.0})


class Truck(Digger):
    """The same on four supports that give way."""

    M, N = Ground(0.4, -0.02), Ground(-0.6, 0.0)
    front = Support("F", (0, 1), stiffness=0.8e6)
    middle = Support("M", (0, 1), stiffness=2.1e6)
    rear = Support("R", (0, 1), stiffness=1.2e6)
    leg = Support("N", (0.1, 1), stiffness=0.5e6)


def outside(motion, case=None):
    """Return the sum of the loads of a Digger and their moment about the origin, written out by hand."""
    slope = {"up": 10 * deg, "down": -12 * deg}.get(case, 0.0)
    down = np.array([-g0 * math.sin(slope), -g0 * math.cos(slope)])
    arm = motion["B"] - motion["O"]
    along = arm / np.hypot(*arm)
    centre = motion["O"] + 1.0 * along + 0.05 * np.stack([-along[1], along[0]])
    masses = [(motion["G"], 3000.0), (centre, 220.0), (motion["T"], 150.0 * (5.0 if case == "heavy" else 1.0))]
    wind = np.array([-200.0, 30.0])
    force = sum(mass for _, mass in masses) * down + wind
    moment = sum(mass * (place[0] * down[1] - place[1] * down[0]) for place, mass in masses)
    return force, moment + motion["T"][0] * wind[1] - motion["T"][1] * wind[0] + 120.0


def left_over(machine, found, motion, case):
    """Return what the supports leave of forces and of the moment about the origin, over the sizes of those."""
    force, moment = outside(motion, case)
    total = np.zeros((2, *motion.shape)) + force.reshape(2, *(1,) * len(motion.shape))
    turn, size = moment + np.zeros(motion.shape), np.abs(moment).max() + np.abs(force).max()
    supports = {name: getattr(machine, name) for name in found.reactions}
    pushes = [(name_of(each.point), each.unit, found.reactions[name]) for name, each in supports.items()]
    first = next(iter(supports.values()))
    pushes.append((name_of(first.point), np.array([first.unit[1], -first.unit[0]]), found.along))
    for point, unit, size_of in pushes:
        place, own = motion[point], unit.reshape(2, *(1,) * len(motion.shape)) * size_of
        total, turn = total + own, turn + place[0] * own[1] - place[1] * own[0]
    return max(np.abs(total).max(), np.abs(turn).max()) / size


def name_of(point):
    return point if isinstance(point, str) else point.name


@for_all("machine", [Digger, Truck])
@for_all("case", [None, "up", "down", "heavy"])
def test_the_supports_carry_all_weights_and_their_moment(machine, case):
    for motion in (machine().sweep(S=6, s=5), machine(**{"R.x": np.array([-2.0, -1.2, -0.9]), "load.mass": 150.0}).sweep(S=4, s=0.1)):
        found = standing(motion, case=case)
        assert left_over(machine, found, motion, case) <= 1e-12
        for name, force in found.reactions.items():
            assert_array_equal(reaction(motion, support=name, case=case), force)


def test_the_reactions_are_what_the_joints_put_on_the_frame():
    """By another way: all that the joints, springs and weights put on the frame itself is what the ground balances."""
    motion = Digger().sweep(S=5, s=4)
    for case in (None, "up"):
        forces = pin_forces(motion, case=case)
        found = standing(motion, case=case)
        ground = np.stack([found.along, found.reactions["front"] + found.reactions["rear"]])
        inside = sum(force for point, force in forces.on_body("frame").items() if point not in "FR")
        assert_allclose(np.asarray(inside) + ground, 0.0, atol=1e-9 * 4e4)
        assert_array_equal(forces.on_body("frame")["R"], [0.0 * found.along, found.reactions["rear"]])
        assert f"axle load rear: {found.reactions['rear'].min() / kN:.6g} to" in str(forces)


def test_a_declared_force_of_a_support_is_its_reaction_on_the_frame():
    class Declared(Digger):
        rear = Support("R", (0, 1), force=500.0)

    plain, declared = (pin_forces(kind().sweep(S=3, s=2)).on_body("frame") for kind in (Digger, Declared))
    assert_array_equal(declared["R"], plain["R"])


def test_tipping_is_remarked_where_it_happens():
    class Tipping(Digger):
        R, load = Ground(-0.7, 0.0), Weight("T", mass=9000)

    motion = Tipping().sweep(S=9, s=0.1)
    force = reaction(motion, support="front")
    assert (force < 0.0).any() and (force > 0.0).any()
    (remark,) = pin_forces(motion).remarks
    assert f"{np.count_nonzero(force < 0.0)} of 9 strokes" in remark
    assert f"front would have to be held down with {-force.min() / kN:.4g} kN" in remark
    assert pin_forces(Digger().sweep(S=3, s=2)).remarks == ()


def test_what_cannot_stand_has_pin_forces_all_the_same():
    for kind in (Weightless, Alone, Stiffless, Twice):
        forces = pin_forces(kind().sweep(S=3, s=0.1))
        assert forces.axle_loads == {} and forces.residual < 1e-12
        assert not any(force.any() for point, force in forces.on_body("frame").items() if point in "FR")


def test_two_supports_by_the_rule_of_levers():
    motion = Digger().sweep(S=4, s=4)
    force, moment = outside(motion)
    rear = (1.5 * force[1] - 0.1 * force[0] - moment + 0.0) / (1.5 + 1.2)  # about the front, which holds along the ground too
    assert_allclose(reaction(motion, support="rear"), -rear, rtol=1e-12)


def by_trying(positions, stiffness, force, moment):
    """Return the reactions of supports that push upwards, by trying every choice of those that carry: the one that is consistent."""
    many = len(positions)
    for count in range(2, many + 1):
        for those in combinations(range(many), count):
            k, x = stiffness[list(those)], positions[list(those)]
            matrix = np.array([[k.sum(), (k * x).sum()], [(k * x).sum(), (k * x * x).sum()]])
            sinks, turns = np.linalg.solve(matrix, [force, moment])
            sunk = sinks + turns * positions
            carries = np.isin(np.arange(many), those)
            if (sunk[carries] >= 0.0).all() and (sunk[~carries] <= 0.0).all():
                return np.where(carries, stiffness * sunk, 0.0)
    return None


@first_daily(1, "many", [4, 3, 5])
def test_supports_that_lift_off_drop_out(many):
    rng, lifted, tipped = np.random.default_rng(many), 0, 0
    for number in range(8):
        positions, stiffness = rng.uniform(-3.0, 3.0, many), 10.0 ** rng.uniform(5.0, 7.0, many)
        names = [f"P{k}" for k in range(many)]
        centre = float(positions.mean())
        body = {name: Ground(float(x), 0.0) for name, x in zip(names, positions, strict=True)}
        body |= {f"s{k}": Support(f"P{k}", (0, 1), stiffness=float(stiffness[k])) for k in range(many)}
        made = type("Plank", (Mechanism,), dict(
            S=Stroke(-5.0, 5.0), G=Ground(centre, 0.5), rail=guide(), W=runs(), body=Weight("G", mass=1000.0),
            load=Weight("W", mass=2000.0), **body,
        ))  # fmt: skip
        motion = made().sweep(31)
        found = standing(motion)
        if number < 2:  # the program orders the supports by itself, and lets them lift off
            values = made().evaluate([axle_load(name) for name in found.reactions], S=motion.strokes["S"])
            assert_allclose(values, [*found.reactions.values()], atol=1e-9 * 3000.0 * g0)
        ends = np.min(positions), np.max(positions)
        for k, S in enumerate(motion.strokes["S"]):
            own = np.array([found.reactions[f"s{j}"][k] for j in range(many)])
            force, moment = 3000.0 * g0, (1000.0 * centre + 2000.0 * S) * g0
            right = by_trying(positions, stiffness, force, moment)
            if ends[0] < moment / force < ends[1]:
                assert right is not None
                assert_allclose(own, right, atol=1e-9 * force)
                lifted += int((right == 0.0).any())
            else:
                assert own.min() < 0.0  # beyond the outermost support
                assert min(float(each[k]) for each in found.outermost.values() if np.isfinite(each[k])) < 0.0
                tipped += 1
            assert_allclose(own.sum(), force, rtol=0.0, atol=1e-12 * np.abs(own).max())
            assert_allclose((own * positions).sum(), moment, rtol=0.0, atol=1e-12 * np.abs(own).max() * 5.0)
    assert lifted > 20 and tipped > 20


def guide():
    return Guide((0.0, 1.0), angle=0.0)


def runs():
    return OnGuide("rail", at="S")


def test_three_equal_springs_by_their_closed_form():
    class Plank(Mechanism):
        S = Stroke(0.0, 0.95)
        rail = guide()
        W = runs()
        P, Q, T = Ground(-1.0, 0.0), Ground(0.0, 0.0), Ground(1.0, 0.0)
        body, load = Weight(Q, mass=1e-6), Weight(W, mass=100.0)
        a, b, c = (Support(each, (0, 1), stiffness=1e6) for each in (P, Q, T))

    Plank_ = Plank()
    weight = 100.0 * g0
    flat = standing(Plank_.at(S=0.5)).reactions
    assert_allclose([flat["a"], flat["b"], flat["c"]], weight * np.array([1 / 3 - 0.25, 1 / 3, 1 / 3 + 0.25]), rtol=1e-6)
    tilted = standing(Plank_.at(S=0.8)).reactions  # beyond two thirds the far one lifts off
    assert_allclose([tilted["a"], tilted["b"], tilted["c"]], weight * np.array([0.0, 0.2, 0.8]), atol=1e-6 * weight)


def test_a_slope_is_a_vehicle_turned_as_a_part_and_a_mirrored_one_has_the_same_loads():
    class Uphill(Mechanism):
        own = Part(Digger, angle=10 * deg, up=None, down=None, heavy=None, wind=None)

    class Mirrored(Mechanism):
        own = Part(Digger, mirrored=True, at=(3.0, 1.0), up=None, down=None, heavy=None, wind=None)

    class Calm(Digger):
        wind = None

    strokes = {"S": np.linspace(0.0, 0.35, 4), "s": np.linspace(0.0, 0.25, 4)}
    flat = Calm().at(**strokes)
    own = {f"own.{name}": values for name, values in strokes.items()}
    for machine, case in ((Uphill, "up"), (Mirrored, None)):
        motion = machine().at(**own)
        for support in ("front", "rear"):
            assert_allclose(reaction(motion, support=f"own.{support}"), reaction(flat, support=support, case=case), rtol=1e-11)
    sideways = standing(flat, case="up"), standing(Uphill().at(**own))
    assert_allclose(sideways[1].along, sideways[0].along, rtol=1e-11)
    assert_allclose(sideways[1].friction, sideways[0].friction, rtol=1e-11)


def test_a_part_is_read_with_the_loads_of_the_whole():
    class Towing(Mechanism):
        own = Part(Digger, at=(1.0, 0.0), up=None, down=None, heavy=None)
        drawbar = Weight("own.R", mass=400.0)
        tool = Weight("own.T", mass=250.0)

    motion = Towing().sweep(**{"own.S": 4, "own.s": 3})
    part = motion.part("own")
    for support in ("front", "rear"):
        expected = reaction(motion, support=f"own.{support}")
        assert_array_equal(reaction(part, support=support), expected)
        assert_array_equal(axle_load(support).of(part), expected)
        assert (np.abs(expected - reaction(Digger().at(S=part.strokes["S"], s=part.strokes["s"]), support=support)) > 500.0).any()
    assert_array_equal(slipping().of(part), slipping().of(motion))


def test_along_the_ground_it_is_held_by_friction():
    motion = Digger().sweep(S=4, s=3)
    found = standing(motion, case="up")
    force, _ = outside(motion, "up")
    assert_allclose(found.along, -force[0], rtol=1e-12)
    assert_allclose(found.friction, 0.5 * found.reactions["front"] + 0.6 * found.reactions["rear"], rtol=1e-12)
    assert_allclose(slipping(case="up").of(motion), np.abs(found.along) / found.friction, rtol=1e-12)


@first_daily(
    1,
    ("kind", "each_of"),
    [
        (Digger, (axle_load("rear"), axle_load("front", case="heavy"), slipping(case="up"))),
        (Truck, (axle_load("rear"), axle_load("middle", case="heavy"), axle_load("leg", case="up"))),
    ],
)
def test_programs_give_the_same_and_exact_derivatives(kind, each_of):
    machine = kind()
    motion = machine.at(S=[0.05, 0.2], s=0.1)
    for asked in each_of:
        (values,) = machine.evaluate([asked], S=[0.05, 0.2], s=0.1)
        assert_allclose(np.ravel(values), np.ravel(asked.of(motion)), rtol=1e-12)
        names = ["G.x", "load.mass", "OB", "F.x", *(["leg.stiffness"] if kind is Truck else [])]
        gradient = motion.gradient(asked, wrt=names)
        for name, own in zip(names, gradient, strict=True):
            step = 1e-6 * max(1.0, abs(float(machine[name])))
            ahead, back = (asked.of(machine.replaced(**{name: machine[name] + way * step}).at(S=[0.05, 0.2], s=0.1)) for way in (1, -1))
            assert_allclose(np.ravel(own), np.ravel(ahead - back) / (2 * step), rtol=1e-6, atol=1e-5)


def test_the_judge_finds_the_least_load_over_strokes_and_cases():
    machine = Digger()
    found = machine.answers([least(axle_load("front")), most(slipping())])
    fine = machine.sweep(S=41, s=41)
    cases = (None, "up", "down", "heavy")
    assert_allclose(found[0].value, min(reaction(fine, support="front", case=case).min() for case in cases), rtol=1e-3)
    assert found[0].value <= min(reaction(fine, support="front", case=case).min() for case in cases)
    assert found[0].case == "up"
    assert_allclose(found[1].value, max(slipping(case=case).of(fine).max() for case in cases), rtol=1e-3)


def verdicts_of(machine):
    return {each.rule: each for each in machine.verdicts() if hasattr(each, "rule")}


def test_a_push_to_the_right_is_held_against_it():
    class Pushed(Digger):
        wind = Force("T", (9000.0, 0.0))

    pose = Pushed().at(S=0.1, s=0.1)
    assert_allclose(standing(pose).along, -9000.0, rtol=1e-12)


def test_verdicts_say_what_is_left_and_when_it_tips_or_slips():
    said = verdicts_of(Digger())
    assert said["axle load rear"].ok and said["slipping"].ok
    bare = reaction(Digger().at(S=0, s=0), ["body"], "front")
    kept = 100.0 * said["axle load front"].answer.value / float(bare)
    load = said["axle load front"].answer.value
    assert said["axle load front"].sentence.startswith(f"least load {load / kN:.4g} kN in the case up")
    assert f": {kept:.3g} % of the {float(bare) / kN:.4g} kN that the vehicle alone puts on it" in said["axle load front"].sentence
    assert f" {1e5 * load:.0f} % of" in load_sentence(said["axle load front"].answer, 1e-3)  # never as a power of ten

    class Tipping(Digger):
        load = Weight("T", mass=3000)
        up = LoadCase(slope=35 * deg)

    said = verdicts_of(Tipping())
    tips = next(each for name, each in said.items() if name.startswith("axle load") and not each.ok)
    assert "tipping" in tips.sentence and "held down with" in tips.sentence
    assert not said["slipping"].ok and "slipping in the case up" in said["slipping"].sentence


def test_axle_loads_are_columns():
    motion = Digger().sweep(S=4, s=0.1)
    columns = {each.name: each for each in results(Digger(), motion)}
    for name in ("front", "rear"):
        assert_allclose(columns[f"axle load {name}"].values, reaction(motion, support=name))
    more = {each.name: each for each in results(Truck(), Truck().sweep(S=4, s=0.1))}
    assert {f"axle load {name}" for name in ("front", "middle", "rear", "leg")} <= set(more)


def test_what_rubs_inside_puts_nothing_on_the_supports():
    class Rubbing(Digger):
        pins = PinFriction("O", radius=0.05, coefficient=0.3)

    for drive in ("S", "s"):
        moving = reaction(Rubbing().sweep(S=3, s=0.1), support="rear", direction="extending", drive=drive, case="up")
        assert_allclose(moving, reaction(Digger().sweep(S=3, s=0.1), support="rear", case="up"), rtol=1e-14)


class Weightless(Digger):
    body = None


class Alone(Digger):
    front = None


class Stiffless(Truck):
    leg = Support("N", (0, 1))


class Outside(Digger):
    G = Ground(-2.0, 0.8)


class Twice(Digger):
    R = Ground(1.5, 0.1)


class Downwards(Digger):
    front = Support("F", (0, -1))


@for_all(
    ("machine", "words"),
    [
        (Weightless, "its frame weighs nothing: declare the vehicle, body = Weight"),
        (Alone, "stands on rear alone and would turn over about it; declare a second support"),
        (Stiffless, "stands on 4 supports, .*say stiffness= of leg, in N/m"),
        (Outside, "stands on nothing: the weight of its frame lies 800 mm beyond rear before any load.*move body between the supports"),
        (Twice, "stand at one place"),
        (Downwards, "not to the side of front"),
    ],
)
def test_what_cannot_stand_is_refused_and_judged(machine, words):
    with pytest.raises(DefinitionError, match=words):
        reaction(machine().sweep(S=3, s=0.1), support="rear")
    said = next(each for each in machine().verdicts(machine().at(S=0.1, s=0.1)) if getattr(each, "rule", "").startswith("axle load"))
    assert said.ok is False


def test_other_mistakes_are_named():
    motion = Digger().sweep(S=3, s=0.1)
    with pytest.raises(DefinitionError, match="has 2 supports: say which one"):
        reaction(motion)
    with pytest.raises(DefinitionError, match="rea is no support under its frame; these are front, rear"):
        Digger().answers([least(axle_load("rea"))])
    with pytest.raises(DefinitionError, match="an axle load does not hang on it; leave drive_force= out"):
        reaction(motion, support="rear", drive_force=100.0)
    with pytest.raises(DefinitionError, match=r"stands on 3 supports, .*say stiffness="):
        reaction(motion, support=Support("G", (0, 1)))
    assert_array_equal(reaction(motion, support=Support("R", (0, 2))), reaction(motion, support="rear"))
    with pytest.raises(DefinitionError, match=r"says friction=, but stands under T, which moves; .*Leave it out"):
        reaction(motion, support=Support("T", (0, 1), friction=0.3), drive="S")
    with pytest.raises(DefinitionError, match="no support says friction="):
        slipping().of(Truck().sweep(S=3, s=0.1))
    with pytest.raises(DefinitionError, match="stiffness=0 carries nothing"):
        Support("R", (0, 1), stiffness=0.0)
    with pytest.raises(DefinitionError, match=r"friction=-0\.1 is negative"):
        Support("R", (0, 1), friction=-0.1)

    class Bare(Mechanism):
        S = Stroke(0.0, 0.1)
        rail = guide()
        W = runs()
        load = Weight(W, mass=10.0)

    with pytest.raises(DefinitionError, match="has no support under a point of its frame"):
        standing(Bare().sweep(3))
    assert isinstance(standing(motion), Standing)


class TwinWheels(Digger):
    """Two wheels at one place in front, where the vehicle tips over them."""

    G, load = Ground(0.9, 0.8), Weight("T", mass=100)
    front = Support("F", (0, 1), stiffness=1.0e6)
    twin = Support("F", (0, 1), stiffness=3.0e6)
    rear = Support("R", (0, 1), stiffness=1.0e6)
    pull = Force("G", (9000.0, 0.0))


def test_supports_at_one_place_share_by_their_stiffness_and_tip_as_one():
    for machine in (TwinWheels(), TwinWheels(**{"pull.x": 52e3})):
        motion = machine.at(S=[0.05, 0.2, 0.3], s=0.1)
        found = standing(motion)
        assert_allclose(found.reactions["twin"], 3.0 * found.reactions["front"], rtol=1e-12)
        assert_allclose(pin_forces(motion).residual, 0.0, atol=1e-14)
        (values,) = machine.evaluate([axle_load("rear")], S=[0.05, 0.2, 0.3], s=0.1)
        assert_allclose(np.ravel(values), found.reactions["rear"], rtol=1e-12)
        assert np.isfinite(motion.gradient(axle_load("rear"), wrt=["G.x", "twin.stiffness"])).all()
    assert (found.reactions["rear"] < 0.0).all()


def test_a_support_that_is_given_takes_the_place_of_that_at_its_point():
    motion = Digger().sweep(S=3, s=2)
    given = [*Digger.plan.of_kind(Weight).values(), Support("R", (0, 1)), Support("F", (0, 1))]
    forces, plain = pin_forces(motion, given), standing(motion, ["body", "load"])
    assert len(forces.axle_loads) == 2 and forces.residual < 1e-14
    assert_allclose([*forces.axle_loads.values()], [plain.reactions["rear"], plain.reactions["front"]], rtol=1e-12)


class UnderAPart(Mechanism):
    """A part in the whole's own supports, on a hill; mirrored with those of its own."""

    own = Part(Digger, up=None, down=None, heavy=None, front=None, rear=None, angle=0.1)
    front, rear = Support("own.F", (0, 1)), Support("own.R", (0, 1))
    hill = LoadCase(slope=0.1)


class MirroredPart(Mechanism):
    own = Part(Truck, up=None, down=None, heavy=None, mirrored=True, angle=-0.2, at=(1.0, 2.0))
    hill = LoadCase(slope=0.1)


@first_daily(0, "machine", [MirroredPart, UnderAPart])
def test_the_frame_of_parts_balances_and_has_equations(machine):
    at = {"own.S": 0.1, "own.s": 0.2}
    for case in (None, "hill"):
        forces = pin_forces(machine().at(**at), case=case)
        assert forces.residual < 1e-14 and len(forces.axle_loads) >= 2
    values, found = equations(machine, forces=True).values(at=at), standing(machine().at(**at)).reactions
    written = {name: force for name, force in found.items() if f"R_{name}" in values}
    assert len(written) == 2
    for name, force in written.items():
        assert_allclose(values[f"R_{name}"], force, rtol=1e-9)


def test_an_axle_keeps_one_share_of_its_load_on_page_and_in_words():
    """What the vehicle alone puts on it is that on level ground, also where the least load occurs on a slope."""
    judge = Digger().judge()
    told = [each for each in Digger().verdicts() if each.rule.startswith("axle load")]
    assert len(told) == 2 and all("in the case" in each.sentence for each in told)
    for each in told:
        (share,) = re.findall(r"([\d.]+) % of the", each.sentence)
        assert_allclose(share_used(judge, each, each.answer)[2], 1.0 - float(share) / 100.0, atol=6e-4 * float(share) / 100.0 + 5e-4)
