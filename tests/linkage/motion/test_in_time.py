"""Motions in time: instants, rates, accelerations, friction as it runs, extremes on both sides of a break, readers, refusals."""

import pickle
import re
from functools import partial

import numpy as np
import pytest

from linkage import (
    AssemblyError,
    Course,
    Curve,
    DefinitionError,
    Force,
    Guide,
    GuideFriction,
    Mechanism,
    OnGuide,
    Over,
    PinFriction,
    Stroke,
    Weight,
    drive_force,
    least,
    most,
    pin_force,
    pin_forces,
    plot,
    ramp,
    x,
    y,
)
from linkage.loads import Acting, Damper
from linkage.motion import judged_poses
from linkage.units import deg
from tests.linkage.motion.test_swept import Lever


class Blocks(Mechanism):
    """Two blocks on guides, each pulled back by 1000 N and pressed down by 5000 N: friction of 500 N, the way it goes."""

    a, b = Stroke(0.0, 1.0), Stroke(0.0, 1.0)
    low, high = Guide((0, 0), angle=0.0), Guide((0, 1), angle=0.0)
    A, B = OnGuide(low, at=a), OnGuide(high, at=b)
    pull_a, pull_b = Force(A, (-1000.0, -5000.0)), Force(B, (-1000.0, -5000.0))
    rub_a, rub_b = GuideFriction(A, 0.1), GuideFriction(B, 0.1)
    there = Over.path(a=ramp(0.1, 0.6, speed=0.5, acceleration=1.0).hold(0.5).then(ramp(0.6, 0.2, speed=0.8)), b=0.3)
    twice = Over.path(a=ramp(0.1, 0.6, speed=1.0, acceleration=4.0).hold(0.25).then(ramp(0.6, 0.2, speed=1.6)), b=0.3)
    legs = Over.path(time=[0, 1, 3, 4], a=[0.1, 0.4, 0.4, 0.2], b=[0.2, 0.2, 0.6, 0.6])
    plain = Over.path(a=[0.1, 0.4, 0.4, 0.2], b=[0.2, 0.2, 0.6, 0.6])


class DampedLever(Lever):
    """The lever with a damper in its cylinder's place, one way of its own course as quick as it likes."""

    slow = Damper("A", "B", 2000.0)
    up = Over.path(S=ramp(0.02, 0.18, speed=0.1, acceleration=0.5))
    quick = Over.path(S=ramp(0.02, 0.18, speed=0.2, acceleration=2.0))


def test_a_motion_in_time_has_instants_and_exact_rates():
    motion = Blocks().sweep(401, over="there")
    course = Blocks.plan.members["there"].strokes["a"]
    assert motion.time == pytest.approx(np.linspace(0.0, course.duration, 401), abs=1e-15) and motion.over is Blocks.plan.members["there"]
    assert motion.strokes["a"].tolist() == course(motion.time).tolist() and set(motion.rates) == set(motion.accelerations) == {"a", "b"}
    assert motion.rates["a"][1:-1] == pytest.approx(course(motion.time, 1)[1:-1]) and not motion.rates["b"].any()
    assert motion.velocity("A")[0] == pytest.approx(motion.rates["a"]) and motion.acceleration("A")[0] == pytest.approx(
        motion.accelerations["a"]
    )
    assert motion.acceleration("A", rates=motion.rates).any() is np.False_  # given rates win, and without accelerations these are 0
    assert Blocks().sweep(11, over="plain").time is None and Blocks().sweep(11, over="plain").rates == {}
    with pytest.raises(DefinitionError, match=r"give rates=dict\(a=0.05\)"):
        Blocks().sweep(11, over="plain").velocity("A")


def test_a_pose_at_an_instant_is_that_of_its_strokes_bit_for_bit():
    lever, motion = DampedLever(), DampedLever().sweep(37, over="up")
    for k in (0, 5, 18, 36):
        pose = lever.at(S=motion.strokes["S"][[k]])
        assert pose["G"][:, 0].tolist() == motion["G"][:, k].tolist()


def test_friction_goes_as_it_runs_and_stands_where_nothing_moves():
    motion = Blocks().sweep(4001, over="there")
    rate, force = motion.rates["a"], drive_force("a").of(motion)
    assert force == pytest.approx(1000.0 + 500.0 * np.sign(rate)) and 0.0 in np.sign(rate)
    forces = pin_forces(motion)
    assert forces.direction == "as it runs" and forces.drives["a"] == pytest.approx(force)
    assert drive_force("a", acting=Acting(direction="frictionless")).of(motion) == pytest.approx(1000.0 + 0.0 * rate)
    for ask in (
        lambda: pin_forces(motion, direction="extending"),
        lambda: drive_force("a", acting=Acting(direction="retracting")).of(motion),
    ):
        with pytest.raises(DefinitionError, match="moves one way, as it runs; leave the direction out"):
            ask()
    with pytest.raises(DefinitionError, match="as it runs"):
        Blocks().answers([most(drive_force("a"))], over="there", acting=Acting(direction="extending"))


def test_what_runs_and_what_is_frictionless_are_told_apart_whichever_is_asked_first():
    machine = type("Rubbing", (Lever,), {"pins": PinFriction("O", radius=0.05, coefficient=0.3), "load": Weight("G", mass=100.0)})()
    up = Over.path(S=ramp(0.02, 0.18, speed=0.1, acceleration=0.5))
    asks = partial(pin_force, "O"), drive_force
    asked = {each: [ask(acting=Acting(direction=each)) for ask in asks] for each in (None, "frictionless")}
    fresh = {each: [request.of(machine.sweep(9, over=up)) for request in requests] for each, requests in asked.items()}
    assert all(np.all(np.abs(a - b)[1:-1] > 1e-3 * np.abs(b)[1:-1]) for a, b in zip(*fresh.values(), strict=True))
    for order in ((None, "frictionless"), ("frictionless", None)):
        motion = machine.sweep(9, over=up)
        for each in order:
            assert np.array([request.of(motion) for request in asked[each]]) == pytest.approx(np.array(fresh[each]), rel=1e-12)


def test_both_sides_of_a_break_are_judged():
    """It goes on at 0.5 m/s and holds; at the break the hold counts for one, what comes before it for the other."""
    high, low = Blocks().answers([most(drive_force("a")), least(drive_force("a"))], over="there")
    assert (high.value, low.value) == pytest.approx((1500.0, 500.0)) and high.direction == ""
    assert str(low).startswith("0.5 kN at 2 s (a = 600.0 mm, b = 300.0 mm)")
    straight = Blocks().answers([most(drive_force("b")), least(drive_force("a"))], over="legs")
    assert [each.value for each in straight] == pytest.approx([1500.0, 500.0])
    assert [each.time for each in straight] == pytest.approx([1.0, 3.0])


def test_the_same_strokes_twice_as_fast_have_other_extremes_in_one_process():
    lever, damped_force = DampedLever(), drive_force("S", acting=Acting(inertia=False))
    force = [lever.answers([most(damped_force)], over=each)[0] for each in ("up", "quick", "up")]
    damped = [each.sweep(2001, over=name) for each, name in ((lever, "up"), (lever, "quick"))]
    direct = [float(np.max(damped_force.of(each))) for each in damped]
    assert [each.value for each in force[:2]] == pytest.approx(direct, rel=1e-6) and force[2].value == force[0].value
    assert direct[1] > direct[0] + 100.0


def test_answers_do_not_depend_on_the_number_of_instants():
    for name in ("there", "legs"):
        found = [Blocks().sweep(count, over=name) for count in (2, 7, 401)]
        each_of = [Blocks().judge(motion).answers([most(x("A")), most(drive_force("a"))]) for motion in found]
        assert len({tuple((one.value, one.time) for one in answers) for answers in each_of}) == 1


def test_time_stretched_by_k_scales_rates_and_accelerations():
    fast, slow = (Blocks().sweep(101, over=name) for name in ("twice", "there"))
    assert fast.time == pytest.approx(slow.time / 2.0) and fast.strokes["a"] == pytest.approx(slow.strokes["a"])
    near = np.abs(slow.time[:, None] - Blocks.plan.members["there"].strokes["a"].breaks).min(axis=1) > 1e-9
    assert fast.velocity("A")[:, near] == pytest.approx(2.0 * slow.velocity("A")[:, near], abs=1e-12)
    assert fast.acceleration("A")[:, near] == pytest.approx(4.0 * slow.acceleration("A")[:, near], abs=1e-12)


def test_a_course_put_together_of_its_parts_changes_no_answer():
    course = Course([0.0, 1.0, 2.5, 4.0], [0.02, 0.15, 0.05, 0.18])
    questions = [most(y("G")), least(y("G")), most(drive_force("S")), least(drive_force("S"))]
    whole = DampedLever().answers(questions, over=Over.path(S=course))
    for cut in (0.3, 1.0, 3.3):
        split = DampedLever().answers(questions, over=Over.path(S=course.part(0.0, cut).then(course.part(cut, 4.0))))
        assert [each.value for each in split] == pytest.approx([each.value for each in whole], rel=1e-12)


def test_a_course_that_ends_before_the_others_holds_its_last_value():
    motion = Blocks().sweep(41, over=Over.path(a=ramp(0.1, 0.3, speed=0.1), b=ramp(0.1, 0.5, speed=0.1)))
    assert (
        motion.time[-1] == 4.0
        and motion.strokes["a"][30] == 0.3
        and motion.rates["a"][30] == 0.0
        and motion.rates["b"][30] == pytest.approx(0.1)
    )


def test_strokes_are_curves_over_time():
    drawn = [ax for ax in plot(Blocks().sweep(401, over="there"), ["a", "A_x"]).axes if ax.get_visible()]
    assert [ax.get_title(loc="left") for ax in drawn] == ["a, m", "A_x, m"]
    times, values = drawn[0].lines[0].get_data()
    assert values == pytest.approx(Blocks.plan.members["there"].strokes["a"](np.asarray(times)))


def test_a_motion_in_time_is_pickled_and_moved():
    motion = Blocks().sweep(21, over="legs")
    again = pickle.loads(pickle.dumps(motion))
    assert again.time.tolist() == motion.time.tolist() and again.rates["b"].tolist() == motion.rates["b"].tolist()
    assert motion.moved(motion.strokes).time is None and "time = 0 to 4 s" in repr(motion)


def test_rates_that_change_in_place_are_read_anew():
    """Arrays and lists are the caller's: those of the call count, not those of the one before."""
    motion, rates, listed = Blocks().at(a=[0.1, 0.2, 0.3], b=0.1), np.full(3, 0.1), [0.1, 0.1, 0.1]

    def found():
        given = ({"a": rates}, {"a": listed})
        return np.array([*(motion.velocity("A", each) for each in given), *(motion.acceleration("A", each, each) for each in given)])

    before = found().copy()
    rates *= 2.0
    listed[:] = [0.2, 0.2, 0.2]
    assert before[:, 0].all() and found()[:, 0] == pytest.approx(2.0 * before[:, 0])


def test_what_is_no_path_in_time_is_refused_in_words():
    for make, words in [
        (lambda: Over.path(time=(0, 2), a=[0.1, 0.2, 0.3], b=0.1), "3 values beside the begin and the end of a path"),
        (lambda: Over.path(time=[0, 2, 2], a=[0.1, 0.2, 0.3], b=0.1), "in row 3 2 s follows 2 s"),
        (lambda: Over.path(time=[0, 2, 3, 4], a=[0.1, 0.2, 0.3], b=0.1), "time has 4 instants and a 3 values"),
        (lambda: Over.path(a=ramp(0.1, 0.2, speed=0.1), b=[0.1, 0.2]), "each value has an instant"),
        (lambda: Over.path(time=3.0, a=0.1, b=0.1), "instants in seconds are expected"),
        (lambda: Over.path(time=[0, 10 * deg], a=0.1, b=0.1), "was given as an angle"),
        (lambda: Over.path(time=(0, 10), a=Curve([0, 2, 4], [0.1, 0.2, 0.1], period=4), b=0.1), "a period of 4 s, and the path lasts 10 s"),
        (lambda: Over(time=(0, 2), a=(0.1, 0.2)), "time is that of a path"),
        (lambda: Over.poses(time=[0, 2], a=[0.1, 0.2], b=0.1), "time is that of a path"),
        (lambda: Over(a=ramp(0.1, 0.2, speed=0.1)), "Over(a="),
        (lambda: Blocks().sweep(over=Over.path(a=ramp(0.0, 20 * deg, speed=0.1), b=0.1)), "given as an angle"),
        (lambda: Blocks().sweep(over=Over.path(a=ramp(0.0, 0.2, speed=0.1))), "where b stand"),
        (lambda: Blocks().sweep(5, time=(0, 2)), "time=(0, 2): time is no stroke, it is that of a path; write sweep(over=Over.path(time="),
        (lambda: Blocks().at(a=0.1, b=0.1, time=2.0), "time is no stroke"),
        (lambda: Blocks().at(a=0.1, b=0.1).velocity("A", {"a": 5 * deg}), "rates: a=0.0872665 was given as an angle"),
        (lambda: type("Timed", (Mechanism,), {"time": Stroke(0.0, 1.0)}), "cannot be named time"),
    ]:
        with pytest.raises(DefinitionError, match=re.escape(words)):
            make()


def test_a_course_out_of_reach_is_refused_with_its_instant():
    """B is out of reach from S = 0.2 + ... on: the error names the instants, the strokes, the step and what is missing."""
    far = Over.path(S=ramp(0.05, 1.2, speed=0.5))
    with pytest.raises(AssemblyError, match=r"(?s)B = Dyad.*cannot be assembled .*from time = 1\.\d+ to 2\.3000 s, S = .* m.*mm"):
        Lever().sweep(101, over=far)
    motion = Lever().sweep(101, over=far, unreachable="nan")
    assert not motion.reached.all() and np.isfinite(motion.time).all()


def test_what_is_lost_over_a_path_in_time_is_told_with_its_instant():
    """The verdict, an answer and what it lost name the instant of the deepest place; so where a hole is shorter than any sample."""
    narrow = Course([0.0, 1.0, 1.0005, 1.001, 2.0], [0.1, 0.2, 1.1, 0.2, 0.1], kind="straight")
    for over, time in [(Over.path(S=ramp(0.05, 1.2, speed=0.5)), 2.3), (Over.path(S=narrow), 1.0005)]:
        machine = type("Far", (Lever,), {"go": over})()
        assembly, answer = machine.verdicts()[0], machine.answers([most(y("B"))])[0]
        assert answer.lost.time == pytest.approx(time, abs=2e-4) and f"at time = {answer.lost.time:.4f} s, S = " in answer.lost.sentence
        assert f"deepest over go, at {answer.lost.time:.4g} s (S = " in assembly.sentence and assembly.answer.time == answer.lost.time


def test_poses_near_a_path_in_time_are_looked_at():
    course = Course([0.0, 1.0, 2.0], [0.1, 0.9, 0.1])  # it bends: between its rows it is far from straight
    over = Over.path(a=course, b=Course([0.0, 2.0], [0.0, 1.0]))
    inside = judged_poses(Blocks().judge(over), Blocks().at(a=[course(0.4), course(0.4)], b=[0.2, 0.5]))
    assert inside.tolist() == [True, False]
