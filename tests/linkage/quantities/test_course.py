"""Courses: values, rates and accelerations over time by hand and by differences; what is made of them; what is refused."""

import re

import numpy as np
import pytest

from linkage import Course, Curve, DefinitionError, ramp
from linkage.quantities import course_of
from linkage.units import bar, deg, mm


def samples(course, count=997):
    return np.linspace(*course.breaks[[0, -1]], count)


def random_course(random):
    """Return a course of some steps: tables of all kinds, ramps with and without a jerk, holds, parts, turned round and moved."""
    times = np.cumsum(random.uniform(0.2, 1.5, int(random.integers(2, 7))))
    course = Course(times, random.uniform(-1.0, 1.0, len(times)), kind=str(random.choice(["smooth", "straight", "monotone"])))
    for _ in range(int(random.integers(0, 4))):
        last, limits = course(course.breaks[-1]), random.uniform(0.1, 2.0, 3)
        given = dict(zip(("speed", "acceleration", "jerk")[: random.integers(1, 4)], limits, strict=False))
        course = course.hold(limits[0]) if random.random() < 0.4 else course.then(ramp(last, last + random.uniform(0.1, 1.0), **given))
    if random.random() < 0.3:
        begin, end = np.sort(random.uniform(*course.breaks[[0, -1]], 2))
        course = -course.part(begin, end) + 0.25
    return course


def test_a_trapezoid_is_the_one_reckoned_by_hand():
    """From 0.1 to 0.3 at 0.15 with 0.8: 0.1875 s of speeding up, 1.3333 s - 0.1875 s of going on, 0.1875 s of braking."""
    course = ramp(0.1, 0.3, speed=0.15, acceleration=0.8)
    assert course.breaks == pytest.approx([0.0, 0.1875, 4.0 / 3.0, 4.0 / 3.0 + 0.1875])
    assert course.duration == pytest.approx(0.2 / 0.15 + 0.15 / 0.8)
    assert course(course.breaks) == pytest.approx([0.1, 0.1140625, 0.2859375, 0.3])
    assert course(course.breaks, 1).tolist() == pytest.approx([0.0, 0.15, 0.15, 0.0], abs=0.0)
    assert course(course.breaks, 2) == pytest.approx([0.8, 0.0, -0.8, -0.8])  # at a break the phase that begins, at the end the last
    assert course.jumps(1) == () and course.jumps(2) == pytest.approx(course.breaks[1:3])
    short = ramp(0.3, 0.1, speed=9.0, acceleration=0.8)  # never at its speed: sqrt(0.2 * 0.8) = 0.4
    assert len(short.breaks) == 3 and short(short.breaks[1], 1) == pytest.approx(-0.4)


def test_seven_phases_keep_all_limits_and_fall_away_where_the_way_is_short():
    """The phases that are left by hand: no level acceleration, no level speed, neither; the quickest way reaches one limit at least."""
    for way, speed, most, jerk, phases in [
        (1.0, 0.4, 0.5, 2.0, 7),
        (1.0, 0.4, 0.5, 0.5, 5),
        (0.5, 5.0, 0.5, 4.0, 6),
        (0.01, 0.4, 0.5, 2.0, 4),
    ]:
        course = ramp(0.2, 0.2 - way, speed=speed, acceleration=most, jerk=jerk)
        peaks = [float(np.abs(course(samples(course, 20001), order)).max()) for order in (1, 2, 3)]
        assert len(course.breaks) - 1 == phases
        assert all(peak <= limit * (1.0 + 1e-9) for peak, limit in zip(peaks, (speed, most, jerk), strict=True))
        assert any(peak == pytest.approx(limit, rel=1e-6) for peak, limit in zip(peaks, (speed, most, jerk), strict=True))
        assert course.jumps(2) == () and course(course.duration) == 0.2 - way and course(course.duration, 1) == 0.0
        assert np.trapezoid(course(samples(course, 20001), 1), samples(course, 20001)) == pytest.approx(-way, rel=1e-6)


def test_derivatives_are_those_of_the_values_whatever_a_course_is_made_of():
    for seed in range(40):
        course = random_course(np.random.default_rng(seed))
        for order in (0, 1):
            inner = np.concatenate([np.linspace(a, b, 9)[2:-2] for a, b in zip(course.breaks[:-1], course.breaks[1:], strict=True)])
            step = 1e-5 * np.min(np.diff(course.breaks))
            moved = (course(inner + step, order) - course(inner - step, order)) / (2.0 * step)
            size = np.abs(course(samples(course), order + 1)).max() + np.abs(course(inner, order)).max()
            assert moved == pytest.approx(course(inner, order + 1), abs=1e-5 * max(size, 1.0)), (seed, order)


@pytest.mark.slow
def test_a_course_split_anywhere_and_put_together_is_the_same_to_the_last_bits():
    for seed in range(40):
        random = np.random.default_rng([seed, 1])
        course = random_course(random)
        first, last = course.breaks[[0, -1]]
        cut = float(random.uniform(first, last))
        again, x = course.part(first, cut).then(course.part(cut, last)), samples(course)
        for order in (0, 1, 2):
            size = np.abs(course(x, order)).max() + np.abs(course(x)).max()
            near = np.abs(x[:, None] - course.breaks).min(axis=1) > 1e-9  # at a break the later phase counts on both
            assert again(x[near], order) == pytest.approx(course(x[near], order), abs=1e-12 * max(size, 1.0)), (seed, order)


def test_what_is_written_is_the_same_course_to_the_last_bit():
    for seed in range(40):
        course = random_course(np.random.default_rng([seed, 2]))
        again = eval(str(course), {"Course": Course, "ramp": ramp})
        assert again.content_key == course.content_key and again(99.0) == course(99.0), seed
        assert course.then(course.part(*course.breaks[[0, -1]]) + (course(99.0) - course(-99.0))).duration == pytest.approx(
            2 * course.duration
        )


def test_numbers_are_added_and_taken_away_on_both_sides():
    good, at = ramp(20 * mm, 80 * mm, speed=0.1), np.linspace(0.0, 0.6, 7)
    for made, wanted in [
        (good + 5 * mm, good(at) + 0.005), (0.1 + good, good(at) + 0.1), (good - 0.1, good(at) - 0.1), (0.1 - good, 0.1 - good(at)),
    ]:  # fmt: skip
        assert made(at) == pytest.approx(wanted, abs=1e-16) and made.measures == "length"


def test_beyond_its_ends_a_course_stands_still():
    course = Course([1.0, 2.0, 4.0], [0.1, 0.5, 0.2])
    assert course([0.0, 1.0, 4.0, 9.0]).tolist() == [0.1, 0.1, 0.2, 0.2]
    assert course([0.0, 9.0], 1).tolist() == [0.0, 0.0]
    assert course(4.0, 1) == pytest.approx(course(4.0 - 1e-9, 1))


def test_tables_go_as_their_kind_says():
    times, values = [0.0, 1.0, 2.0, 4.0, 5.0], [0.0, 0.0, 1.0, 1.0, 0.0]
    smooth, straight, monotone = (Course(times, values, kind) for kind in ("smooth", "straight", "monotone"))
    assert smooth(samples(smooth)) == pytest.approx(Curve(times, values)(samples(smooth)), abs=1e-15)
    assert straight(1.25) == 0.25 and straight(1.25, 1) == 1.0 and straight.jumps(1) == (1.0, 2.0, 4.0)
    assert monotone(samples(monotone)).min() >= 0.0 and monotone(samples(monotone)).max() <= 1.0 < smooth(samples(smooth)).max()


def test_a_curve_over_time_is_that_curve_again_and_again():
    curve = Curve([0.5, 1.0, 2.0, 4.5], [0.0, 0.4, 0.1, 0.0], period=4.0)
    course, x = course_of(curve, 0.0, 8.0), np.linspace(0.0, 8.0, 401)
    for order in (0, 1, 2):
        assert course(x, order) == pytest.approx(curve(x, order), abs=1e-12)
    assert curve.breaks.tolist() == [0.5, 1.0, 2.0, 4.5] and curve.duration == 4.0
    table = Curve([0.0, 1.0], [0.2, 0.4])
    assert course_of(table, 0.0, 3.0)(2.0) == 0.4  # a table holds its last value, where as a curve it has none


def test_what_is_no_course_is_refused_in_words():
    good = ramp(0.0, 0.3, speed=0.1)
    for make, words in [
        (lambda: good.then(ramp(0.31, 0.0, speed=0.1)), "ends at 0.300 m, goes on at 0.310 m: 10 mm apart"),
        (lambda: ramp(0.0, 10 * deg, speed=0.1).then(ramp(20 * deg, 0.0, speed=0.1)), "10 deg apart"),
        (lambda: Course([0.0, 1.0, 1.0], [0.0, 1.0, 2.0]), "in row 3 1 s follows 1 s"),
        (lambda: Course([0.0, 1.0], [0.0, 1.0, 2.0]), "one for each of 2 instants"),
        (lambda: Course([0.0], [0.0]), "two at least"),
        (lambda: Course([0.0, np.nan], [0.0, 1.0]), "finite numbers"),
        (lambda: Course([0.0, 10 * mm], [0.0, 1.0]), "was given as a length"),
        (lambda: Course([0.0, 1.0], [0.0, 1.0], "cubic"), "smooth"),
        (lambda: ramp(np.float64(0.1), 0.1, speed=1.0), "ramp(0.1, 0.1): nothing moves"),
        (lambda: ramp(0.1, 0.2, speed=0.0), "above zero"),
        (lambda: ramp(0.1, 0.2, speed=1.0, jerk=1.0), "give acceleration="),
        (lambda: ramp("a", 0.2, speed=1.0), "finite number"),
        (lambda: ramp(0.1, 0.2, speed=80 * mm, acceleration=9 * deg), "speed is a length and acceleration is an angle"),
        (lambda: ramp(0.1, 20 * deg, speed=80 * mm), "b is an angle and speed is a length; give ends and limits as one kind"),
        (lambda: good.hold(0.0), "seconds above zero"),
        (lambda: good.hold(2 * mm), "given as a length"),
        (lambda: Course([0.0, 1.0], [10 * deg, 20 * mm]), "given as a length"),
        (lambda: ramp(0.1, 0.3, speed=150, acceleration=0.8), "allows 0.4 on this way; write speed=150 * mm for"),
        (lambda: ramp(0.0, 20 * deg, speed=40, acceleration=1, jerk=9), "write speed=40 * deg for 40 deg/s"),
        (lambda: ramp(0.1, 0.2, speed=5 * bar), "ends and limits=500000 was given as a pressure"),
        (lambda: ramp(0.1, 20 * mm, speed=0.1).then(ramp(20 * deg, 0.0, speed=0.1)), "given as an angle"),
        (lambda: ramp(0.0, 20 * mm, speed=0.1) + 3 * deg, "given as an angle"),
        (lambda: good.part(1 * mm, 2 * mm), "given as a length"),
        (lambda: good(5 * mm), "given as a length"),
        (lambda: good.part(1.0, 4.0), "from 0 to 3 s"),
        (lambda: good.then(0.3), "a course is expected"),
        (lambda: good + "x", "a number is expected"),
        (lambda: good - good, "a number is expected"),
        (lambda: good("soon"), "instants in seconds are expected"),
        (lambda: good(0.5, -1), "a whole number is expected"),
    ]:
        with pytest.raises(DefinitionError, match=re.escape(words)):
            make()
