"""Laws of motions in time over random machines: poses, rates, accelerations, stretched time, split courses, friction as it runs."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import Course, Over, driving_force, most, pin_forces, ramp
from linkage.loads import Acting
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
    near = [instants.at(np.clip(motion.time + way * h, begin, end)) for way in (-1, 1)]
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


@EACH
def test_the_judge_asks_a_program_what_it_would_ask_instant_by_instant(seed):
    """With inertia, and where rates jump without; a plain function of a motion has no program."""
    draft = random_machine(seed)
    machine = heavy(draft)()
    pose = machine.at(**draft.strokes())
    requests, _ = asked(pose, pin_forces(pose))
    there = {name: (float(np.min(each)), float(np.max(each))) for name, each in draft.strokes().items()}
    smooth = {name: ramp(*ends, speed=np.ptp(ends), acceleration=4.0 * np.ptp(ends)) for name, ends in there.items()}
    pairs = [most(each) for request in (requests[0], requests[-1]) for each in (request, request.of)]
    for over in (Over.path(**smooth), Over.path(**courses(draft))):
        found = machine.answers(pairs, over=over)
        scale = max(abs(each.value) for each in found)
        for traced, plain in zip(found[::2], found[1::2], strict=True):
            assert traced.value == pytest.approx(plain.value, rel=0, abs=1e-9 * scale), (str(traced), str(plain))
