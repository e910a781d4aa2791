"""Laws of forces in time over random machines: rates and accelerations of strokes as inputs of programs, and the inertia of masses."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import FloatCircuit
from linkage import LinkMass, Spring, Weight, drive_force, driving_force, pin_force, pin_forces
from linkage.loads import Acting, ForceElement
from tests.for_all import for_all
from tests.laws.by_hand import FRAME, ByHand, full
from tests.laws.plane import PLAIN, cross, size
from tests.laws.random_machines import random_machine
from tests.laws.random_oil import random_oil

DAILY, MANY = 2, 60
EACH = for_all("seed", range(DAILY), slow=range(DAILY, MANY))


def moving(draft, order=1):
    """Return how fast each stroke moves at each pose, or how its rate changes, by smooth functions of the pose."""
    poses = np.linspace(0.0, 1.0, np.size(next(iter(draft.strokes().values()))))
    size = {name: (0.4 if draft.angular(name) else 0.1) * order for name in draft.spans}
    return {name: size[name] * np.cos(order + 2.0 * k + 3.0 * poses) for k, name in enumerate(draft.spans)}


def has_a_program(plan):
    """Return whether forces of a machine have programs: none where groups have to be solved for a sketch pose."""
    preloaded = [spring for spring in plan.of_kind(Spring).values() if spring.preload is not None]
    fed = [ram for line in plan.of_kind(FloatCircuit).values() for ram in line.members(plan.members)]
    return not any(plan.reaches(end) & set(plan.groups) for each in (*preloaded, *fed) for end in each.ends)


def asked(motion, found):
    """Return requests for the drives' forces and for some joint forces, with their values over a motion."""
    joints = [each for each in found.joints if each.has_force and len(found.at(each.point)) == 1][:3]
    drives = [drive_force(stroke) for stroke in motion.strokes]
    return [*drives, *(pin_force(each.point, each.on) for each in joints)], [np.hypot(*each.force) for each in joints]


@pytest.mark.slow
@EACH
def test_programs_take_rates_as_inputs(seed):
    draft = random_machine(seed)
    machine, strokes, rates = draft.drawn(), draft.strokes(), moving(draft)
    if not has_a_program(machine.plan):
        return
    motion = machine.at(**strokes)
    requests, sizes = asked(motion, pin_forces(motion, rates=rates))
    wanted = [*(driving_force(motion, drive=stroke, rates=rates) for stroke in motion.strokes), *sizes]
    scale = max(np.max(np.abs(each)) for each in wanted)
    found = machine.evaluate(requests, rates=rates, **strokes)
    assert_allclose(found, np.broadcast_arrays(*wanted), rtol=0, atol=1e-11 * scale)
    f, last = machine.function(requests, rates=True), [given[name][-1] for given in (strokes, rates) for name in motion.strokes]
    assert_allclose(f(*last), [each[-1] for each in found], rtol=0, atol=1e-11 * scale)
    dimension = next(name for name in machine.plan.table.entries if name.partition(".")[0] in machine.plan.of_kind(ForceElement))
    value, step = machine[dimension], 1e-4 * max(abs(machine[dimension]), 1.0)
    near = [machine.replaced(**{dimension: value + way * step}).evaluate(requests, rates=rates, **strokes) for way in (1, -1, 2, -2)]
    for request, more, less, far, back in zip(requests, *near, strict=True):
        (slope,) = motion.gradient(request, wrt=[dimension], rates=rates)
        assert_allclose(slope, (8.0 * (more - less) - (far - back)) / (12.0 * step), rtol=0, atol=1e-9 * scale / step, err_msg=str(request))


# -- inertia: along a path in time, against energy and momentum by differences of the eighth order ----------------------------------------

STEP, WEIGHTS = 4e-3, np.array([1 / 280, -4 / 105, 1 / 5, -4 / 5, 0.0, 4 / 5, -1 / 5, 4 / 105, -1 / 280])  # s, Fornberg 1988


def heavy(draft):
    """Return the class of a machine with masses that turn and stretch beside its own: two on a cylinder where it has one."""
    more = {}
    for each in draft.holders[:1]:
        more["tube"] = LinkMass(f"{each.A} {each.B}", mass=25.0, at=(0.1, 0.03), inertia=1.5, gravity=(0.0, 0.0))
        more["liner"] = LinkMass(f"{each.A} {each.B}", mass=12.0, gravity=(0.0, 0.0))
    body = max(draft.bodies(), key=len)
    more["wheel"] = LinkMass(" ".join(sorted(body)[:2]), mass=30.0, at=(-0.1, 0.2), inertia=4.0, gravity=(0.0, 0.0))
    if len(body) > 2:
        more["plate"] = LinkMass(" ".join(sorted(body)[:3]), mass=9.0, gravity=(0.0, 0.0))
    return draft.machine(PLAIN, "Heavy", **more)


def path_in_time(draft):
    """Return strokes over nine instants about the middle of their ranges, their rates and their accelerations."""
    time, random = STEP * np.arange(-4, 5), np.random.default_rng([5, draft.seed])
    strokes, rates, accelerations = {}, {}, {}
    for name, span in draft.spans.items():
        start, v, a = draft.factor * span * random.uniform(-0.5, 0.5), span * random.uniform(-1.0, 1.0), span * random.uniform(-4.0, 4.0)
        strokes[name], rates[name], accelerations[name] = start + v * time + 0.5 * a * time**2, v + a * time, a
    return strokes, rates, accelerations


def masses(motion, rates):
    """Yield every mass of a machine with its place and velocity (2, n), its inertia and how it turns: bars as their two Gauss points."""
    for each in motion.plan.of_kind(Weight).values():
        yield each.mass, motion[each.point], motion.velocity(each.point, rates), 0.0, 0.0
    for each in motion.plan.of_kind(LinkMass).values():
        points = each.points(motion.plan.members, "")
        at, rate = [motion[P] for P in points], [motion.velocity(P, rates) for P in points]
        if each.at is None and len(points) == 2:
            for share in (0.5 - 0.5 / np.sqrt(3.0), 0.5 + 0.5 / np.sqrt(3.0)):
                yield 0.5 * each.mass, at[0] + share * (at[1] - at[0]), rate[0] + share * (rate[1] - rate[0]), 0.0, 0.0
        elif each.at is None:
            yield from ((each.mass / len(points), *both, 0.0, 0.0) for both in zip(at, rate, strict=True))
        else:
            arm, spin = at[1] - at[0], cross(at[1] - at[0], rate[1] - rate[0]) / size(at[1] - at[0]) ** 2
            u = arm / size(arm)
            r = each.at[0] * u + each.at[1] * np.stack([-u[1], u[0]])
            yield each.mass, at[0] + r, rate[0] + spin * np.stack([-r[1], r[0]]), each.inertia or 0.0, spin


def changing(values):
    """Return the derivative by time at the middle instant."""
    return (np.broadcast_to(values, (*np.shape(values)[:-1], 9)) * WEIGHTS).sum(axis=-1) / STEP


@for_all("seed", [*range(DAILY), MANY, MANY + 1], slow=[*range(DAILY, MANY), *range(MANY + 2, MANY + 14)])  # the last on closed oil lines
def test_energy_and_momentum_change_as_the_forces_say(seed):
    """The drives' power is what energy takes up and dampers lose; the frame bears all loads less the change of momentum."""
    draft = random_machine(seed) if seed < MANY else random_oil(seed - MANY)
    strokes, rates, accelerations = path_in_time(draft)
    motion = heavy(draft)().at(**strokes)
    hand = ByHand(draft, motion, rates)
    found = pin_forces(motion, acting=Acting(rates=rates, accelerations=accelerations))
    kinetic, momentum, spin = np.zeros(9), np.zeros((2, 9)), np.zeros(9)
    for mass, place, rate, inertia, turning in masses(motion, rates):
        kinetic = kinetic + 0.5 * mass * (rate**2).sum(axis=0) + 0.5 * inertia * turning**2
        momentum, spin = momentum + mass * rate, spin + mass * cross(place, rate) + inertia * turning
    still = ByHand(draft, motion)
    lost = [(hand.thrust(name) - still.thrust(name)) * (hand.stretch(e.A, e.B, stroke) * rate)
            for name, e in draft.elements.items() for stroke, rate in rates.items()]
    power = sum(found.drives[name] * rate for name, rate in rates.items()) + sum(lost)
    scale = sum(np.abs(found.drives[name] * rate) for name, rate in rates.items()) + np.abs(changing(kinetic))
    assert abs(power[4] - changing(kinetic + hand.energy())) < 1e-9 * np.max(scale), "energy"
    on_frame, largest = hand.wrenches(found.joints)[FRAME], np.max(hand.largest(found.joints))
    loads = [(full(motion, act.force), cross(full(motion, act.place), full(motion, act.force)) + act.couple) for act in hand.acting()]
    misses = sum(force for force, _ in on_frame)[:, 4] - sum(force for force, _ in loads)[:, 4] + changing(momentum)
    assert np.max(np.abs(misses)) < 1e-9 * largest, "momentum"
    turned = sum(moment for _, moment in on_frame)[4] - sum(moment for _, moment in loads)[4] + changing(spin)
    assert abs(turned) < 1e-9 * largest * hand.reach, "angular momentum"


@EACH
def test_at_rest_inertia_changes_no_bit_and_slower_it_goes_with_the_square(seed):
    draft = random_machine(seed)
    machine, (strokes, rates, accelerations) = heavy(draft)(), path_in_time(draft)
    motion, nothing = machine.at(**strokes), dict.fromkeys(rates, 0.0)
    still = pin_forces(motion)
    at_rest = pin_forces(motion, acting=Acting(rates=nothing, accelerations=nothing))
    assert all(np.array_equal(a.force, b.force) for a, b in zip(still.joints, at_rest.joints, strict=True))
    part = {}
    for slower in (1.0, 3.0):
        given = {name: rate / slower for name, rate in rates.items()}, {name: each / slower**2 for name, each in accelerations.items()}
        acting = [Acting(rates=given[0], accelerations=given[1], inertia=which) for which in (None, False)]
        with_it, without = (pin_forces(motion, acting=each) for each in acting)
        part[slower] = [a.force - b.force for a, b in zip(with_it.joints, without.joints, strict=True)]
    largest = max(np.max(size(each)) for each in part[1.0])
    for fast, slow in zip(part[1.0], part[3.0], strict=True):
        assert_allclose(slow * 9.0, fast, rtol=0, atol=1e-9 * largest)


@EACH
def test_programs_take_accelerations_as_inputs(seed):
    draft = random_machine(seed)
    machine, (strokes, rates, accelerations) = heavy(draft)(), path_in_time(draft)
    if not has_a_program(machine.plan):
        return
    motion, given = machine.at(**strokes), {"rates": rates, "accelerations": accelerations}
    acting = Acting(**given)
    requests, sizes = asked(motion, pin_forces(motion, acting=acting))
    wanted = np.broadcast_arrays(*(driving_force(motion, drive=stroke, acting=acting) for stroke in motion.strokes), *sizes)
    scale = np.max(np.abs(wanted))
    assert_allclose(machine.evaluate(requests, **given, **strokes), wanted, rtol=0, atol=1e-11 * scale)
    last = [*(each[-1] for part in (strokes, rates) for each in map(part.get, motion.strokes)), *map(accelerations.get, motion.strokes)]
    assert_allclose(machine.function(requests, rates=True, accelerations=True)(*last), np.transpose(wanted)[-1], rtol=0, atol=1e-11 * scale)
    for name in ("wheel.inertia", "wheel.mass"):
        near = [machine.replaced(**{name: machine[name] + way}).evaluate(requests, **given, **strokes) for way in (0.5, -0.5)]
        for request, more, less in zip(requests[: len(rates)], *near, strict=False):  # forces of drives are linear in masses
            assert_allclose(motion.gradient(request, wrt=[name], **given)[0], more - less, rtol=0, atol=1e-9 * scale, err_msg=name)
