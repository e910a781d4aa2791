"""Numerical differentiation: how much a step of any length is off is told, or the derivative is refused."""

import re
import warnings

import mpmath
import numpy as np
import pytest

from linkage import LEFT, Dyad, Ground, Mechanism, SingularError, SingularWarning, Stroke
from linkage.numeric import differences as numeric
from mechanisms.three_point_hitch import ThreePointHitch
from tests.for_all import for_all
from tests.linkage.random_mechanisms import random_mechanism

FACTOR = 2.0
"""How many times the error that is told a derivative may be off."""
STEPS = np.concatenate([[1e-300, 1e-160, 1e-40, 10.0], np.geomspace(1e-17, 3.0, 21)])


class Lever(Mechanism):
    """A cylinder AB on a lever OB; dead points at AB = 0.7 and 1.3 m."""

    S, A, O = Stroke(0.1, 3.0), Ground(0, 0), Ground(1.0, 0)
    B = Dyad(A, O, AB=S, OB=0.3, side=LEFT)


def exact(AB, order):
    """Return dB/dS or d2B/dS2 of the lever by 50 digits, shape (2,)."""
    with mpmath.workdps(50):
        p, q = mpmath.mpf(float(AB)), mpmath.mpf("0.3")
        along = (1 + p * p - q * q) / 2
        height = mpmath.sqrt(p * p - along * along)
        rise = (p - along * p) / height
        bend = (1 - p * p - along - rise * rise) / height
        return np.array([float(p), float(rise)] if order == 1 else [1.0, float(bend)])


def told(motion, name, **options):
    """Return a motion's numerical ratio, and the error told: the threshold of warnings where nothing is, infinite where it is refused."""
    with warnings.catch_warnings(record=True) as heard:
        warnings.simplefilter("always")
        try:
            found = motion.ratio(name, method="central", **options)
        except SingularError as error:
            assert "with step=" in str(error)
            return None, np.inf
    texts = [str(each.message) for each in heard if "The numerical ratio" in str(each.message)]
    return found, float(re.search(r"about (\S+) of", texts[0])[1]) if texts else 0.0


def off(found, wanted):
    """Return how much a derivative is off, against the greatest value; NaN counts as refused."""
    return float(np.nanmax(np.abs(found - wanted), initial=0.0)) / float(np.abs(wanted).max())


@pytest.mark.slow
@for_all("order", [1, 2])
@for_all("S", [0.7 + 1e-9, 1.3 - 1e-6], slow=[0.75, 0.7 + 1e-5, 1.0])
def test_any_step_next_to_a_dead_point_tells_what_it_loses(order, S):
    wanted = exact(S, order)
    for step in STEPS:
        options = dict(order=order, step=float(step))
        found, error = told(Lever().at(S=S), "B", **options)
        if found is not None:
            assert off(found, wanted) <= FACTOR * max(error, numeric.WARN[order]), step
        masked, error = told(Lever().at(S=[S, 1.1], unreachable="nan"), "B", **options)
        both = np.stack([wanted, exact(1.1, order)], axis=1)
        assert off(masked, both) <= FACTOR * max(error, numeric.WARN[order]), step
        assert found is not None or np.isnan(masked[:, 0]).all()


def checked(machine, strokes, names, steps):
    """Assert of many steps that a machine's derivatives are off by what is told; return how many were tried and how many refused."""
    motion, tried, refused = machine.at(**strokes), 0, 0
    for order in (1, 2):
        for name in names:
            wanted = motion.ratio(name, wrt=next(iter(strokes)), order=order)
            for step in steps:
                found, error = told(motion, name, wrt=next(iter(strokes)), order=order, step=float(step))
                tried, refused = tried + 1, refused + (found is None)
                if found is not None:
                    size = max(float(np.abs(wanted).max()), 1e-9)
                    wrong = float(np.abs(found - wanted).max()) / size
                    least = numeric.STILL[order] * still_size(motion, name, strokes, order) / size
                    assert wrong <= FACTOR * max(error, numeric.WARN[order]) * max(1.0, least), (name, order, step)
    return tried, refused


def still_size(motion, name, strokes, order):
    """Return the size of a derivative that changes a point or an output by itself over a stroke's range."""
    declared = motion.plan.strokes[next(iter(strokes))]
    least = 0.0 if name in motion.plan.points else 1.0
    return max(least, float(np.abs(motion[name]).max())) / abs(declared.end - declared.start) ** order


def random_steps(random, machine, count):
    """Return step lengths from 1e-300 to ten times a stroke's range."""
    declared = next(iter(machine.plan.strokes.values()))
    span = abs(declared.end - declared.start)
    return np.concatenate([span * 10.0 ** random.uniform(-17.0, 1.0, count), [10.0 ** random.uniform(-300.0, -20.0)]])


def tried_at_random(seeds, count):
    """Check random mechanisms from steps; return how many derivatives were tried and how many refused."""
    tried = np.zeros(2, int)
    for seed in seeds:
        random = np.random.default_rng(seed)
        machine = random_mechanism(seed)()
        ((name, stroke),) = machine.strokes.items()
        values = stroke.start + (stroke.end - stroke.start) * np.sort(random.uniform(0.0, 1.0, 3))
        points = [random.choice(machine.plan.moving), "u"]
        tried += checked(machine, {name: values}, points, random_steps(random, machine, count))
    return tried


def test_any_step_of_random_mechanisms_tells_what_it_loses():
    tried, refused = tried_at_random(range(2), 5)
    assert 0.1 * tried < refused < 0.9 * tried


@pytest.mark.slow
def test_any_step_of_many_random_mechanisms_tells_what_it_loses():
    tried, refused = tried_at_random([2, 3, *range(1000, 1100)], 20)
    assert 0.2 * tried < refused < 0.8 * tried


def test_a_step_of_no_use_is_refused_by_name():
    motion = ThreePointHitch().sweep(11)
    for step in (1e-300, 1e-12, 5.0):
        with pytest.raises(SingularError, match=r"The numerical ratio of G with step=\S+ is refused at 11 of 11 strokes") as caught:
            motion.ratio("G", order=2, method="central", step=step)
        assert caught.value.mask.all()
        assert "Leave the step out" in str(caught.value)
    masked = ThreePointHitch().sweep(11, unreachable="nan")
    assert np.isnan(masked.ratio("G", method="central", step=1e-300)).all()
    with pytest.warns(SingularWarning, match=r"The numerical ratio of G with step=0.01 is off by up to about \S+ of its greatest value"):
        motion.ratio("G", method="central", step=0.01)


def test_a_good_step_says_nothing():
    motion = ThreePointHitch().sweep(11)
    found, wanted = motion.ratio("G", method="central", step=1e-5), motion.ratio("G")
    assert off(found, wanted) < numeric.WARN[1]
