"""Laws of motions in time over random machines: poses, rates, accelerations, stretched time, split courses, friction as it runs."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import Course, Over, driving_force, most, pin_forces, ramp
from linkage.cli.listing import registered
from linkage.cli.machines import find
from linkage.loads import Acting
from linkage.motion.judge import RowFunction, leaves_of
from linkage.motion.measures import At
from linkage.motion.motion_verdicts import HasVerdicts, speakers
from tests.for_all import for_all
from tests.laws.random_machines import random_machine
from tests.laws.test_time_laws import asked, heavy

DAILY, MANY = 2, 40
EACH = for_all("seed", range(DAILY), slow=range(DAILY, MANY))


def courses(draft, stretched=1.0, kind="monotone"):
    """Return a course of every stroke within what the draft is driven over: a table and a ramp back, in other times each."""
    random, found = np.random.default_rng([7, draft.seed]), {}
    for name, values in draft.strokes().items():
        low, high = float(np.min(values)), float(np.max(values))
        rows = low + (high - low) * random.uniform(0.1, 0.9, 5)
        times = np.cumsum(random.uniform(0.3, 1.0, 5)) * stretched
        speed = (high - low) / stretched
        course = Course(times - times[0], rows, kind=kind)
        found[name] = course.then(ramp(rows[-1], 0.5 * (low + high), speed=speed, acceleration=4.0 * speed / stretched))
    return found


@EACH
def test_poses_are_those_of_their_strokes_and_rates_their_derivatives(seed):
    """Bit for bit; velocities and accelerations against differences of poses and velocities at instants beside."""
    draft = random_machine(seed)
    machine, over = draft.drawn(), Over.path(**courses(draft))
    motion = machine.sweep(23, over=over)
    poses = machine.at(**motion.strokes)
    h, (begin, end) = 1e-5, motion.time[[0, -1]]
    breaks = np.unique(np.concatenate([each.breaks for each in over.strokes.values()]))
    inner = np.abs(motion.time[:, None] - breaks).min(axis=1) > 2.0 * h
    instants = motion._instants
    near = [instants.at_times(np.clip(motion.time + way * h, begin, end)) for way in (-1, 1)]
    beside = [machine.at(**each.strokes) for each in near]
    for name in machine.plan.moving:
        assert motion[name].tolist() == poses[name].tolist()
        velocity, acceleration = motion.velocity(name)[:, inner], motion.acceleration(name)[:, inner]
        less, more = (each[name][:, inner] for each in beside)
        slower, faster = (each.velocity(name, at.rates)[:, inner] for each, at in zip(beside, near, strict=True))
        size = np.abs(velocity).max() + np.abs(acceleration).max()
        assert_allclose(velocity, (more - less) / (2.0 * h), rtol=0, atol=1e-6 * max(size, 1e-6))
        assert_allclose(acceleration, (faster - slower) / (2.0 * h), rtol=0, atol=1e-6 * max(size, 1e-6))


@EACH
def test_time_stretched_by_k_is_slower_by_k(seed):
    draft = random_machine(seed)
    machine = draft.drawn()
    quick, slow = (machine.sweep(31, over=Over.path(**courses(draft, stretched))) for stretched in (1.0, 2.0))
    assert_allclose(slow.time, 2.0 * quick.time, rtol=1e-12)
    for name in machine.plan.moving:
        assert_allclose(slow[name], quick[name], rtol=0, atol=1e-9)
        for kind, power in (("velocity", 2.0), ("acceleration", 4.0)):
            fast, late = getattr(quick, kind)(name), getattr(slow, kind)(name)
            near = np.isclose(power * late, fast, rtol=0, atol=1e-6 * max(np.abs(fast).max(), 1e-6)).all(axis=0)
            assert np.mean(near) > 0.8, (seed, name, kind)  # at breaks rounding may tell another phase


@EACH
def test_a_split_course_and_other_counts_of_instants_change_no_answer(seed):
    draft = random_machine(seed)
    machine, whole = draft.drawn(), courses(draft)
    name = machine.plan.moving[-1]
    split = {stroke: each.part(0.0, 0.4).then(each.part(0.4, each.duration)) for stroke, each in whole.items()}
    questions = [most(lambda motion: motion.x(name)), most(lambda motion: motion.y(name))]
    found = [machine.answers(questions, over=Over.path(**each)) for each in (whole, split)]
    for one, other in zip(*found, strict=True):
        assert one.value == pytest.approx(other.value, rel=1e-12, abs=1e-12)
    motions = [machine.sweep(count, over=Over.path(**whole)) for count in (3, 50)]
    again = [[each.value for each in machine.judge(motion).answers(questions)] for motion in motions]
    assert again[0] == again[1] == [each.value for each in found[0]]


@EACH
def test_forces_as_it_runs_are_those_at_its_rates(seed):
    """Without inertia and friction they are those of the rates that are given; frictionless stays what it is."""
    draft = random_machine(seed)
    machine = draft.drawn()
    motion = machine.sweep(9, over=Over.path(**courses(draft, kind="straight")))
    plain = machine.at(**motion.strokes)
    for stroke in motion.strokes:
        own = driving_force(motion, drive=stroke, acting=Acting(direction="frictionless", inertia=False))
        given = driving_force(plain, drive=stroke, rates=motion.rates)
        assert_allclose(own, given, rtol=0, atol=1e-9 * max(np.abs(given).max(), 1.0))


# -- the judge asks programs ------------------------------------------------------------------------------------------------------------


def check_programs(machine, over, questions):
    """Check that what the judge asks a program over a path in time is what the motion gives instant by instant; return how many it asks."""
    judge = machine.judge(machine.sweep(5, over=over, unreachable="nan")).lost_allowed()
    (place,) = judge.places
    listed = questions or [each for member in speakers(machine.plan, HasVerdicts).values() for each in member.questions(judge)]
    leaves = [leaf for leaf in dict.fromkeys(leaf for each in listed for leaf in leaves_of(each)) if not isinstance(leaf, At)]
    rows = [row for leaf in leaves for row in judge.search_rows(leaf, place)]
    motion = place.timed(place.instants.shares(np.linspace(0.0, 1.0, 41)), "nan")
    traced, plain = (RowFunction(place, rows) for _ in range(2))
    count = len(traced._bound)
    plain._bound.clear()
    for row, *own in zip(rows, *traced.row_values(motion), *plain.row_values(motion), strict=True):
        values, unlimited, wanted, without = own
        scale = np.max(np.abs(np.nan_to_num(wanted)))
        assert_allclose(values, wanted, rtol=0, atol=1e-9 * scale, err_msg=f"{machine.plan.title}: {row.request}")
        assert np.array_equal(unlimited, without), f"{machine.plan.title}: {row.request}"
    return count


def there_and_back(spans, seed=1):
    """Return a path in time that goes through the middle of what strokes are driven over, holds and comes back; rates jump nowhere."""
    random, found = np.random.default_rng(seed), {}
    for name, (low, high) in spans.items():
        span, (a, b) = abs(high - low), random.permutation([low + 0.3 * (high - low), low + 0.65 * (high - low)])
        back = ramp(b, a, speed=0.4 * span, acceleration=2.0 * span)
        found[name] = ramp(a, b, speed=0.5 * span, acceleration=random.uniform(1.0, 3.0) * span).hold(0.1).then(back)
    return Over.path(**found)


@EACH
def test_programs_of_the_judge_give_what_the_motion_gives(seed):
    """With inertia, and where rates jump without."""
    draft = random_machine(seed)
    machine = heavy(draft)()
    pose = machine.at(**draft.strokes())
    requests, _ = asked(pose, pin_forces(pose))
    spans = {name: (float(np.min(each)), float(np.max(each))) for name, each in draft.strokes().items()}
    for over in (there_and_back(spans), Over.path(**courses(draft))):
        check_programs(machine, over, [most(request) for request in requests])


DAILY_MACHINES = ("axle", "hoist_tipper", "grapple")


@pytest.mark.slow
@for_all("name", DAILY_MACHINES, slow=[name for name in registered() if name not in DAILY_MACHINES])
def test_programs_of_verdicts_give_what_the_motion_gives(name):
    """Cylinders that work one way and both, telescopes, closed lines, gas, ropes, supports, parts: whatever is judged."""
    machine = find(name)
    if machine.plan.strokes:
        over = there_and_back({stroke: (each.start, each.end) for stroke, each in machine.plan.strokes.items()})
        count = check_programs(machine(), over, [])
        assert count or name not in DAILY_MACHINES
