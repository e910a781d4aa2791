"""Laws of forces over random machines, against bodies and loads that the package did not see.

Every machine is drawn with its bodies, loads and cylinders in plain numbers (`random_machines`), and equilibrium, work and friction are
worked out from those (`by_hand`). Twenty machines are looked at daily, three hundred with `-m slow`.
"""

import math
from collections import Counter
from functools import lru_cache

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Cylinder, FloatCircuit, LiftCircuit
from linkage import Actuator, Crank, DefinitionError, LoadCase, Spring, Stroke, drive_force, driving_force, pin_force, pin_forces
from linkage.loads import ForceElement
from linkage.quantities import ref
from tests.for_all import first_daily, for_all
from tests.laws.by_hand import FRAME, ByHand, by_point, full
from tests.laws.plane import G0, PLAIN, Move, cross, facing, size, turned
from tests.laws.random_machines import TAGS, random_machine, wants

MANY, DAILY, BLOCK = 300, 6, 10
NOTHING = 1e-12  # of the largest force: what rounding leaves
FRICTION = 1e-10  # of the largest force: where friction and joint forces are found by iteration


EACH = for_all("seed", range(DAILY), slow=range(DAILY, MANY))
SIXTH = first_daily(1, "seed", range(0, MANY, 6))
WITH_FRICTION = [seed for seed in range(MANY) if "friction" in wants(seed)]
RUBBING = for_all("seed", WITH_FRICTION[:3], slow=WITH_FRICTION[3:])
BLOCKS = first_daily(1, "first", range(0, MANY, BLOCK))


def speeds(draft):
    """Return how fast each stroke moves [m/s, rad/s]."""
    return {name: 0.1 if draft.angular(name) else 0.05 for name in draft.spans}


@lru_cache(maxsize=64)
def seen(seed):
    """Return a machine as it was drawn, over its strokes, and all its joint forces while it moves without friction."""
    draft = random_machine(seed)
    motion = draft.drawn().at(**draft.strokes())
    return ByHand(draft, motion, speeds(draft)), pin_forces(motion, rates=speeds(draft))


@pytest.mark.slow
def test_of_every_kind_there_are_sixty():
    found = Counter(tag for seed in range(MANY) for tag in random_machine(seed).tags)
    assert set(found) == set(TAGS) and min(found.values()) >= 60, found


# -- equilibrium -------------------------------------------------------------------------------------------


@EACH
def test_every_body_balances(seed):
    """Joint forces and loads on each body add up to nothing, in forces and in moments."""
    hand, found = seen(seed)
    misses = hand.misses(found.joints)
    assert set(hand.bodies) <= set(misses)
    assert {each.name for each in hand.draft.holders} | set(hand.draft.elements) <= set(misses)
    misses.pop(FRAME)
    assert max(misses.values()) < NOTHING, misses
    assert found.residual < NOTHING


@EACH
def test_the_frame_takes_all_loads(seed):
    """What the joints put on the frame is the resultant of all loads from outside, in force and in moment."""
    hand, found = seen(seed)
    on_frame = hand.wrenches(found.joints)[FRAME]
    loads = [(full(hand.motion, act.force), cross(act.place, act.force) + act.couple) for act in hand.acting()]
    largest = hand.largest(found.joints)
    assert np.max(size(sum(force for force, _ in on_frame) - sum(force for force, _ in loads)) / largest) < NOTHING
    misses = sum(moment for _, moment in on_frame) - sum(moment for _, moment in loads)
    assert np.max(np.abs(misses) / largest) < NOTHING * hand.reach


@EACH
def test_the_forces_handed_over_by_body_balance(seed):
    """`on_body` of every body, the frame's are those of all loads."""
    hand, found = seen(seed)
    largest = hand.largest(found.joints)
    loads = sum((full(hand.motion, act.force) for act in hand.acting()), np.zeros((2, *hand.motion.shape)))
    for name in found.on_bodies:
        wanted = loads if name == FRAME else 0.0
        assert np.max(size(sum(found.on_body(name).values()) - wanted) / largest) < NOTHING, name


@EACH
def test_joints_give_no_more_than_they_can(seed):
    """Without friction a pin has no couple, and nothing holds a point along its guide."""
    hand, found = seen(seed)
    largest = hand.largest(found.joints)
    for each in found.joints:
        if each.kind == "pin":
            assert np.max(np.abs(each.couple)) <= NOTHING * np.max(largest), each
    for run in hand.draft.runs:
        if not run.driven:
            there = list(slides(hand, found, run))
            assert there
            for each in there:
                u = full(hand.motion, run.direction(hand.at) / size(run.direction(hand.at)))
                assert np.max(np.abs((each.force * u).sum(axis=0)) / largest) < NOTHING, each


def slides(hand, found, run):
    """Return the joints in which a point runs on a line: those at it that are no pins, one body of which carries the line."""
    for each in found.joints:
        bodies = {hand.body(each.on), hand.body(each.by)}
        if run.block:
            carries = run.block in bodies
        else:
            carries = any(set(run.pair) <= body for body in bodies if isinstance(body, frozenset)) if run.pair else FRAME in bodies
        if carries and each.point == run.point and (each.kind == "driven") == run.driven and each.kind not in ("pin", "crank", "telescope"):
            yield each


@EACH
def test_two_point_elements_act_at_their_pins_by_their_law(seed):
    hand, found = seen(seed)
    largest, joints = np.max(hand.largest(found.joints)), by_point(hand, found)
    for name, element in hand.draft.elements.items():
        wanted, u = hand.thrust(name), (hand.at[element.B] - hand.at[element.A]) / size(hand.at[element.B] - hand.at[element.A])
        assert_allclose(found.thrusts[name], wanted, rtol=0, atol=NOTHING * largest, err_msg=name)
        assert_allclose(joints[element.A, name][0], wanted * u, rtol=0, atol=NOTHING * largest, err_msg=name)
        assert_allclose(joints[element.B, name][0], -wanted * u, rtol=0, atol=NOTHING * largest, err_msg=name)
        if sum(name in (each.on, each.by) for each in found.at(element.A)) == 1:
            assert_allclose(found.force(element.A, on=name), wanted * u, rtol=0, atol=NOTHING * largest, err_msg=name)


@EACH
def test_two_force_members_are_pulled_along(seed):
    """Ends of a cylinder, an element or a massless rod with nothing on it are equal, opposite and along it."""
    hand, found = seen(seed)
    largest, joints = hand.largest(found.joints), by_point(hand, found)
    loaded = {hand.carrier(act, found.joints) for act in hand.acting()}
    turned_by = {hand.body(name) for each in found.joints if each.kind != "pin" for name in (each.on, each.by)}
    straight = {each.name: (each.A, each.B) for each in hand.draft.holders} | {name: (e.A, e.B) for name, e in hand.draft.elements.items()}
    straight |= {body: tuple(sorted(body)) for body in hand.bodies if len(body) == 2 and body not in turned_by}
    for body, (A, B) in straight.items():
        if body in loaded:
            continue
        u = (hand.at[B] - hand.at[A]) / size(hand.at[B] - hand.at[A])
        a, b = (full(hand.motion, joints[P, body][0] + np.zeros((2, 1))) for P in (A, B))
        assert np.max(size(a + b) / largest) < NOTHING, body
        assert np.max(np.abs(cross(u, a)) / largest) < NOTHING, body
        if isinstance(body, str):
            assert np.max(np.abs((a * u).sum(axis=0) - found.thrusts[body]) / largest) < NOTHING, body


# -- work --------------------------------------------------------------------------------------------------


@EACH
def test_driving_force_is_the_work_of_all_loads(seed):
    """By virtual work, worked out by hand; and that of joints: the thrusts of the cylinders that hold the stroke times how they stretch."""
    hand, found = seen(seed)
    for stroke in hand.draft.spans:
        works = works_of(hand, stroke)
        wanted, size_of = -sum(works), 1.0 + np.max(sum(map(np.abs, works)))
        given = driving_force(hand.motion, drive=stroke, rates=hand.rates)
        assert_allclose(given, wanted, rtol=0, atol=NOTHING * size_of)
        holding = [each for each in hand.draft.holders if each.stroke == stroke]
        thrusts = sum(found.thrusts[each.name] * hand.stretch(each.A, each.B, stroke) for each in holding)
        held = thrusts if holding else found.drives[stroke]
        assert_allclose(held, wanted, rtol=0, atol=1e-11 * size_of)
        for each in holding[1:]:  # on one line
            ratio = each.area / holding[0].area
            assert_allclose(found.thrusts[each.name], ratio * found.thrusts[holding[0].name], rtol=0, atol=1e-11 * size_of)


@EACH
def test_a_cylinder_tells_the_thrust_that_it_has(seed):
    """`cylinder.thrust(motion)` by virtual work is what equilibrium gives, of one that holds and of one that gas feeds."""
    hand, found = seen(seed)
    largest = np.max(hand.largest(found.joints))
    for name, cylinder in hand.motion.plan.of_kind(Cylinder).items():
        assert_allclose(cylinder.thrust(hand.motion, rates=hand.rates), found.thrusts[name], rtol=0, atol=1e-11 * largest, err_msg=name)


def works_of(hand, stroke):
    """Return the work of every load and element on a unit of a stroke, shape (n,) each [N or N m]."""
    works = [(full(hand.motion, act.force) * moved(hand, act, stroke)).sum(axis=0) for act in hand.acting()]
    works += [act.couple * hand.spin(act.on, stroke) for act in hand.acting() if act.on]
    return works + [hand.thrust(name) * hand.stretch(e.A, e.B, stroke) for name, e in hand.draft.elements.items()]


def moved(hand, act, stroke):
    """Return the velocity of the place a load acts at, shape (2, n)."""
    arm = full(hand.motion, act.place) - hand.at[act.point]
    return hand.rate(act.point, stroke) + np.stack([-arm[1], arm[0]]) * hand.spin(act.on, stroke)


NODES, SHARES = np.polynomial.legendre.leggauss(16)


def along(draft, stroke):
    """Return the values of all strokes while one goes over its range, at Gauss's nodes and then at both ends; half the range."""
    path = {name: np.full(18, 0.3 * span * draft.factor) for name, span in draft.spans.items()}
    half = draft.spans[stroke] * draft.factor
    path[stroke] = half * np.array([*NODES, -1.0, 1.0])
    return path, half


@BLOCKS
def test_the_work_of_the_thrusts_is_the_change_of_energy(first):
    """At rest: what the cylinders or the drive do is what weights, springs, gas and given forces take up."""
    for seed in range(first, first + BLOCK):
        draft = random_machine(seed)
        for stroke in draft.spans:
            path, half = along(draft, stroke)
            hand = ByHand(draft, draft.drawn().at(**path))
            found, energy = pin_forces(hand.motion), hand.energy()
            work = driving_force(hand.motion, drive=stroke)[:16] * SHARES * half
            scale = 1.0 + np.sum(np.abs(work)) + np.ptp(energy)
            assert_allclose(work.sum(), energy[17] - energy[16], rtol=0, atol=1e-11 * scale, err_msg=f"seed {seed}, {stroke}")
            holding = [each for each in draft.holders if each.stroke == stroke]
            if holding:
                thrust = sum(found.thrusts[each.name] * hand.stretch(each.A, each.B, stroke) for each in holding)
                given = (thrust[:16] * SHARES * half).sum()
                assert_allclose(given, work.sum(), rtol=0, atol=1e-11 * scale, err_msg=f"seed {seed}, {stroke}")


@pytest.mark.slow
@BLOCKS
def test_the_work_of_the_oil_is_the_change_of_energy(first):
    """Pressure times the oil that goes in, on both sides of every cylinder that holds: a line without losses."""
    done = 0
    for seed in twinned(first):
        draft = random_machine(seed)
        for holder in draft.holders:
            name, bore, rod, stroke = holder.member or "lift", 0.08, 0.05, holder.stroke
            if len([each for each in draft.holders if each.stroke == stroke]) > 1:
                continue
            lift = Cylinder(holder.A, holder.B, bore=bore, rod=rod, works="both")
            supply = LiftCircuit(name, pressure=400e5, relief=450e5)
            path, half = along(draft, stroke)
            hand = ByHand(draft, draft.machine(**{name: lift, "supply": supply})().at(**path))
            pressure = hand.motion.plan.members[name].pressure(hand.motion, direction="frictionless")
            thrust = pin_forces(hand.motion).thrusts[name]
            oil = np.where(thrust >= 0.0, 1.0, -1.0) * np.pi / 4.0 * (bore**2 - np.where(thrust < 0.0, rod**2, 0.0))
            work = pressure * oil * hand.stretch(holder.A, holder.B, stroke)
            energy = hand.energy()
            scale = np.sum(np.abs(work[:16] * SHARES * half)) + np.ptp(energy)
            assert_allclose((work[:16] * SHARES * half).sum(), energy[17] - energy[16], rtol=0, atol=1e-11 * scale, err_msg=f"seed {seed}")
            done += 1
    assert done


@SIXTH
def test_requests_are_the_same_forces(seed):
    """Asked of the machine by values of its strokes, at rest: the drives' forces, and joint forces by pin and body."""
    hand, _ = seen(seed)
    plan, found = hand.motion.plan, pin_forces(hand.motion)
    preloaded = [spring for spring in plan.of_kind(Spring).values() if spring.preload is not None]
    fed = [ram for line in plan.of_kind(FloatCircuit).values() for ram in line.members(plan.members)]
    if any(plan.reaches(end) & set(plan.groups) for each in (*preloaded, *fed) for end in each.ends):
        with pytest.raises(DefinitionError, match="no closed form"):
            hand.draft.drawn().evaluate([drive_force(next(iter(plan.strokes)))], **hand.draft.strokes())
        return
    joints = [each for each in found.joints if each.has_force and len(found.at(each.point)) == 1][:4]
    requests = [*(drive_force(stroke) for stroke in hand.draft.spans), *(pin_force(each.point, each.on) for each in joints)]
    given = hand.draft.drawn().evaluate(requests, **hand.draft.strokes())
    wanted = [*(driving_force(hand.motion, drive=stroke) for stroke in hand.draft.spans), *(size(each.force) for each in joints)]
    for request, one, other in zip(requests, given, wanted, strict=True):
        assert_allclose(one, other, rtol=0, atol=1e-11 * np.max(hand.largest(found.joints)), err_msg=str(request))


# -- one thing in the place of another ---------------------------------------------------------------------


@pytest.mark.slow
@BLOCKS
def test_a_cylinder_may_be_replaced_by_its_thrust(first):
    """Its arm becomes a crank, if it is none, the cylinder an actuator: the same pin forces, and the crank has nothing left to do."""
    done = 0
    for seed in twinned(first):
        hand, found = seen(seed)
        for stroke, machine, values, rate in cranked(hand):
            held = [each for each in hand.draft.holders if each.stroke == stroke]
            twin, there = pushed(hand, found, held, machine, values, rate)
            works = [found.thrusts[each.name] * twin.stretch(each.A, each.B, stroke) for each in held] + works_of(twin, stroke)
            assert np.max(np.abs(there.drives[stroke])) <= 1e-11 * max(np.max(np.abs(work)) for work in works), seed
            same_forces(hand, found, twin, there, {each.name for each in held}, seed)
            done += 1
    assert done


def cranked(hand):
    """Yield the strokes that cylinders hold, the machine that a crank drives instead, the stroke's values in the same poses, its rate."""
    draft = hand.draft
    for stroke in dict.fromkeys(each.stroke for each in draft.holders if draft.angular(each.stroke)):
        yield stroke, draft.machine(PLAIN, "Bare", **without(draft, stroke)), draft.strokes()[stroke], hand.rates[stroke]
    for swap in draft.swaps:
        stroke, start, arm = swap.stroke, facing(draft.at[swap.X] - draft.at[swap.O]), draft.apart(swap.O, swap.X)
        if stroke in draft.own:
            continue
        crank = Crank(swap.O, angle=ref(stroke) + start, **{swap.O + swap.X: arm})
        others = {stroke: Stroke(-1.0, 1.0), swap.X: crank, f"L{stroke}": None, **without(draft, stroke)}
        along = turned(hand.at[swap.X] - hand.at[swap.O], -start)
        rate = sum(hand.spin((swap.O, swap.X), name) * rate for name, rate in hand.rates.items())
        yield stroke, draft.machine(PLAIN, "Cranked", **others), np.arctan2(along[1], along[0]), rate


def without(draft, stroke):
    """Return that a machine goes without the cylinders that hold a stroke, and without their line."""
    names = [each.member for each in draft.holders if each.stroke == stroke and each.member]
    return dict.fromkeys([*names, *([f"line{stroke}"] if f"line{stroke}" in draft.parts else [])])


def pushed(hand, found, held, machine, values, rate):
    """Return a machine with actuators in the place of the cylinders that hold a stroke, in the same poses, and its joint forces."""
    draft, stroke = hand.draft, held[0].stroke
    motion = machine().at(**{**draft.strokes(), stroke: values})
    loads = [*motion.plan.of_kind(ForceElement), *(Actuator(each.A, each.B, force=found.thrusts[each.name]) for each in held)]
    rates = {**hand.rates, stroke: rate}
    return ByHand(draft, motion, rates), pin_forces(motion, loads, rates=rates)


def twinned(first):
    """Return the seeds of a block whose twins are made; daily not all that have a group, whose classes take long to check."""
    return [seed for seed in range(first, first + BLOCK) if first >= DAILY or seed % 4 == 0 or "group" not in wants(seed)]


def same_forces(hand, found, twin, there, gone, seed):
    """Assert that two results have the same forces and couples at each point on each body, but for some bodies of the first."""
    here, other, largest = by_point(hand, found), by_point(twin, there), np.max(hand.largest(found.joints))
    for (point, body), (force, couple) in here.items():
        if body in gone:
            continue
        same = other[point, body]
        assert_allclose(same[0] + 0.0 * force, force, rtol=0, atol=1e-11 * largest, err_msg=f"seed {seed}: {point} on {body}")
        assert_allclose(same[1] + 0.0 * couple, couple, rtol=0, atol=1e-11 * largest, err_msg=f"seed {seed}: {point} on {body}")


@EACH
def test_an_element_may_be_replaced_by_its_force(seed):
    hand, found = seen(seed)
    largest = np.max(hand.largest(found.joints))
    for name, element in hand.draft.elements.items():
        if name.startswith("element"):
            push = Actuator(element.A, element.B, force=hand.thrust(name))
            loads = [*(each for each in hand.motion.plan.of_kind(ForceElement) if each != name), push]
            there = pin_forces(hand.motion, loads, rates=hand.rates)
            assert_allclose(there.thrusts[f"Actuator {element.A}{element.B}"], found.thrusts[name], rtol=0, atol=NOTHING * largest)
            for stroke, drive in found.drives.items():
                assert_allclose(there.drives[stroke], drive, rtol=0, atol=1e-11 * largest)
            return


# -- seen elsewhere ----------------------------------------------------------------------------------------

MOVES = [
    Move(mirror=True),
    Move(turn=0.7),
    Move(scale=2.5),
    Move(mirror=True, turn=-1.9, scale=0.4),
    Move(turn=-0.4, case=True),
    Move(mirror=True, turn=1.1, case=True),
]


def in_gravity(move):
    """Return the load case in which gravity turns with a machine; None where the machine's weights say so themselves."""
    if not move.case:
        return None
    return LoadCase(gravity=move.vector((0.0, -G0))) if move.mirror else LoadCase(slope=-move.turn)


@BLOCKS
def test_a_moved_machine_has_moved_forces(first):
    """In a mirror, turned, or larger with the same loads: forces turn, couples grow as lengths do."""
    for seed in twinned(first)[:: 2 if first < DAILY else 1]:
        hand, found = seen(seed)
        move = MOVES[(first // BLOCK + seed) % len(MOVES)]
        draft, scale = hand.draft, {name: 1.0 if hand.draft.angular(name) else move.scale for name in hand.draft.spans}
        motion = draft.machine(move, "Moved")().at(**{name: values * scale[name] for name, values in draft.strokes().items()})
        for name, place in hand.at.items():
            wanted = move.scale * np.stack(move.vector(place))
            assert_allclose(full(motion, motion[name]), wanted, rtol=0, atol=1e-11 * hand.reach * move.scale)
        there = pin_forces(motion, case=in_gravity(move), rates={name: rate * scale[name] for name, rate in hand.rates.items()})
        largest = np.max(hand.largest(found.joints))
        for a, b in zip(found.joints, there.joints, strict=True):
            assert (a.point, a.on, a.by, a.kind) == (b.point, b.on, b.by, b.kind)
            assert_allclose(b.force, np.stack(move.vector(a.force)), rtol=0, atol=1e-10 * largest, err_msg=f"seed {seed}, {a}")
            wanted = move.sense * move.scale * a.couple
            assert_allclose(b.couple, wanted, rtol=0, atol=1e-10 * largest * move.scale * hand.reach, err_msg=f"seed {seed}, {a}")
        for name, thrust in found.thrusts.items():
            assert_allclose(there.thrusts[name], thrust, rtol=0, atol=1e-10 * largest, err_msg=f"seed {seed}, {name}")


# -- friction ----------------------------------------------------------------------------------------------


@lru_cache(maxsize=64)
def rubbed(seed, stroke, direction):
    """Return a machine in which one stroke moves against friction, and its joint forces."""
    hand, _ = seen(seed)
    rates = {stroke: hand.rates[stroke] * (1.0 if direction == "extending" else -1.0)}
    found = pin_forces(hand.motion, drive=stroke, direction=direction, rates=rates)
    return ByHand(hand.draft, hand.motion, rates, rubs=True), found


def ways(seed):
    """Yield every way in which one stroke moves: its name, the machine, the joint forces."""
    for stroke in random_machine(seed).spans:
        yield from ((stroke, *rubbed(seed, stroke, direction)) for direction in ("extending", "retracting"))


@RUBBING
def test_every_body_balances_with_friction(seed):
    for stroke, hand, found in ways(seed):
        misses = hand.misses(found.joints)
        misses.pop(FRAME)
        assert max(misses.values()) < FRICTION, (stroke, found.direction, misses)


@RUBBING
def test_pins_rub_by_their_law(seed):
    """The couple in a rubbing pin is coefficient x radius x force, against the turning; no other pin has one."""
    for stroke, hand, found in ways(seed):
        pins = {name: (radius, coefficient) for name, radius, coefficient in hand.draft.frictions.values() if radius is not None}
        largest = np.max(hand.largest(found.joints))
        assert set(pins) <= {each.point for each in found.joints if each.kind == "pin"}
        for each in found.joints:
            if each.kind == "pin":
                radius, coefficient = pins.get(each.point, (0.0, 0.0))
                turning = turning_of(hand, each, stroke) * np.sign(hand.rates[stroke])
                wanted = -np.where(np.abs(turning) > 1e-9, np.sign(turning), 0.0) * coefficient * radius * size(each.force)
                assert_allclose(each.couple, wanted, rtol=0, atol=FRICTION * largest * 0.01, err_msg=f"{each} {stroke} {found.direction}")


def turning_of(hand, joint, stroke):
    """Return how a joint's body turns against the other by a stroke, shape (n,) [rad per unit]."""
    on, by = (hand.spin(hand.ends(hand.body(name)), stroke) for name in (joint.on, joint.by))
    return on - by


@RUBBING
def test_elements_act_at_their_pins_while_they_rub(seed):
    """The part along an element of its end's force is its thrust, friction at its pins or not."""
    for stroke, hand, found in ways(seed):
        largest, joints = np.max(hand.largest(found.joints)), by_point(hand, found)
        for name, element in hand.draft.elements.items():
            u = (hand.at[element.B] - hand.at[element.A]) / size(hand.at[element.B] - hand.at[element.A])
            wanted = hand.thrust(name)
            assert_allclose(found.thrusts[name], wanted, rtol=0, atol=NOTHING * largest, err_msg=f"{name} {stroke}")
            along = (-joints[element.B, name][0] * u).sum(axis=0)
            assert_allclose(along, wanted, rtol=0, atol=FRICTION * largest, err_msg=f"{name} {stroke}")


@RUBBING
def test_a_cylinder_tells_the_thrust_that_it_has_with_friction(seed):
    """Its direction is its own: where its length falls with the stroke it extends as the stroke goes back."""
    for stroke, hand, found in ways(seed):
        largest = np.max(hand.largest(found.joints))
        for holder in hand.draft.holders:
            growth = np.sign(hand.stretch(holder.A, holder.B, stroke) * hand.rates[stroke])
            if holder.member and abs(np.sum(growth)) == growth.size:
                cylinder = hand.motion.plan.members[holder.member]
                own = "extending" if growth[0] > 0.0 else "retracting"
                given = cylinder.thrust(hand.motion, direction=own, rates=hand.rates)
                assert_allclose(given, found.thrusts[holder.name], rtol=0, atol=FRICTION * largest, err_msg=f"{holder} {stroke} {own}")


@RUBBING
def test_along_a_path_friction_goes_by_its_tangent(seed):
    """Without a drive named, several strokes move as the path does, forwards or back: as at rates of that sense."""
    draft = random_machine(seed)
    if len(draft.spans) == 1:
        return
    u = np.linspace(-1.0, 1.0, 6)
    ways_of = [(u, 0.0 * u + 1.0), (0.5 - u**2 / 2.0, -u), (-0.8 * u, 0.0 * u - 0.8)]
    path = {
        name: (values * span * draft.factor, slope * span)
        for (name, span), (values, slope) in zip(draft.spans.items(), ways_of, strict=False)
    }
    motion = draft.drawn().at(**{name: values for name, (values, _) in path.items()})
    for direction, sense in (("extending", 1.0), ("retracting", -1.0)):
        rates = {name: sense * slope for name, (_, slope) in path.items()}
        hand, found = ByHand(draft, motion, rates, rubs=True), pin_forces(motion, direction=direction)
        misses = hand.misses(found.joints)
        misses.pop(FRAME)
        assert max(misses.values()) < FRICTION, (direction, misses)
        pins = {name: (radius, coefficient) for name, radius, coefficient in draft.frictions.values() if radius is not None}
        for each in found.joints:
            if each.kind == "pin" and each.point in pins:
                turning = sum(turning_of(hand, each, name) * rate for name, rate in rates.items())
                sure = np.abs(turning) > max(1e-9, 0.02 * np.max(np.abs(turning)))
                sure[[0, -1]] = False  # where a path ends its tangent is known from one side alone
                wanted = -np.sign(turning) * math.prod(pins[each.point]) * size(each.force)
                assert_allclose(each.couple[sure], wanted[sure], rtol=1e-7, atol=1e-9, err_msg=f"{each} {direction}")


@RUBBING
def test_what_goes_up_and_does_not_come_down_has_rubbed_away(seed):
    """Force out less force back is what pins, guides, seals and dampers take both ways, per unit of the stroke; never less than nothing."""
    most = 0.0
    for stroke in random_machine(seed).spans:
        (out, up), (back, down) = (rubbed(seed, stroke, way) for way in ("extending", "retracting"))
        lost = dissipated(out, up, stroke) + dissipated(back, down, stroke)
        for name, element in out.draft.elements.items():
            lost = lost - (out.thrust(name) - back.thrust(name)) * out.stretch(element.A, element.B, stroke)
        force = [
            driving_force(found.motion, drive=stroke, direction=found.direction, rates=hand.rates)
            for hand, found in ((out, up), (back, down))
        ]
        size_of = np.max(np.abs(force))
        assert np.all(lost >= -NOTHING * size_of)
        assert_allclose(force[0] - force[1], lost, rtol=0, atol=1e-9 * size_of)
        most = max(most, np.max(lost))
    assert most > 0.0


def dissipated(hand, found, stroke):
    """Return what pins and guides take on a unit of a stroke, shape (n,) [N or N m], from the joint forces."""
    lost = np.zeros(hand.motion.shape)
    for name, radius, coefficient in hand.draft.frictions.values():
        if radius is not None:
            pins = [each for each in found.joints if each.point == name and each.kind == "pin"]
            lost = lost + sum(coefficient * radius * size(each.force) * np.abs(turning_of(hand, each, stroke)) for each in pins)
            continue
        for run in hand.draft.runs:
            if run.point == name:
                u = full(hand.motion, run.direction(hand.at) / size(run.direction(hand.at)))
                normal = sum(np.abs(cross(u, each.force)) for each in slides(hand, found, run))
                lost = lost + coefficient * normal * np.abs(hand.slip(run, stroke))
    return lost
