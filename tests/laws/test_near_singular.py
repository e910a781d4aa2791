"""Next to singular poses nothing is wrong in silence: positions and ratios against sixty digits, errors told against true ones."""

import warnings

import numpy as np
import pytest

from linkage import AssemblyError, SingularWarning, ratio

from .exactly import exactly, off, pins_exactly
from .near_singular import KINDS, pose

SILENT = 1e-6
"""The largest relative error without a warning."""
DAILY = 2
"""So many poses of each kind are looked at in each run of the suite."""
BESIDE = 16
"""So many of a stroke's last digits on each side show the largest error next to a pose."""


def told(ask):
    """Return what is answered, None where it is refused, and the errors that were told of."""
    with warnings.catch_warnings(record=True) as found:
        warnings.simplefilter("always")
        try:
            answer = ask()
        except AssemblyError:
            return None, []
    return answer, [each.message.estimate for each in found if isinstance(each.message, SingularWarning)]


class Truth:
    """A point of a machine and its derivatives by the stroke, in sixty digits."""

    def __init__(self, machine, target):
        self.machine, self.target = machine, target
        ((self.stroke, _),) = machine.plan.strokes.items()

    def inputs(self, value):
        """Return the inputs at a stroke, the pins of groups in sixty digits; None where there is no pose."""
        plan = self.machine.plan
        if not plan.groups:
            return plan.defaults | {self.stroke: value}
        motion, _ = told(lambda: self.machine().at(unreachable="nan", **{self.stroke: value}))
        found = {name: float(np.ravel(part)[0]) for name, part in motion.inputs.items()}
        return pins_exactly(plan, found) if np.isfinite(list(found.values())).all() else None

    def at(self, value, order):
        """Return the point (order 0) or its derivative at a stroke; None where it has none."""
        plan, inputs = self.machine.plan, self.inputs(value)
        nodes = plan.derived(plan.nodes(self.target), (self.stroke,) * order)
        return None if inputs is None else exactly(nodes, inputs)

    def worst(self, value, order, size):
        """Return the largest error of what is answered beside a stroke."""
        step, errors = np.spacing(value), []
        for place in range(-BESIDE, BESIDE + 1):
            at = value + place * step
            truth = self.at(at, order)
            found, _ = told(lambda at=at: self.machine().at(unreachable="nan", **{self.stroke: at}).ratio(self.target, order=order))
            if truth is not None and np.isfinite(found).all():
                errors.append(off(found, truth, size))
        return max(errors, default=np.nan)


def looked_at(seed, times=30.0):
    """Check one pose; return how each of its results came out: `silent`, `told`, `refused` or `beyond` (no pose there).

    The error told is at the most so many times the true one; where it is more than thirty times that, the outcome is `wide`.
    """
    made = pose(seed)
    if made is None:
        return ["beyond"]
    machine, strokes, target, draft = made
    truth = Truth(machine, target)
    value = strokes[truth.stroke]
    motion, warned = told(lambda: machine().at(**strokes))
    if motion is None:
        return ["refused"]
    place = truth.at(value, 0)
    if place is None:
        return ["beyond"]
    assert np.isfinite(motion[target]).all()
    assert warned or off(motion[target], place, draft.size) <= SILENT
    outcomes = []
    for order in (1, 2):
        exact = truth.at(value, order)
        found, warned = told(lambda order=order: motion.ratio(target, order=order))
        again, also = told(lambda order=order: machine().evaluate([ratio(target, order=order)], **strokes)[0])
        third, _ = told(lambda order=order: machine().function([ratio(target, order=order)])(**strokes))
        assert (found is None) == (again is None) == (third is None)
        if found is None:
            outcomes.append("refused")
            continue
        assert bool(warned) == bool(also)
        assert np.isfinite(found).all()
        size = 1e-9 * draft.size
        if not warned:
            assert exact is None or off(found, exact, size) <= SILENT
            outcomes.append("silent")
            continue
        worst = truth.worst(value, order, size)
        assert worst / 3.0 <= max(warned) <= times * worst, (order, max(warned), worst)
        outcomes.append("told" if max(warned) <= 30.0 * worst else "wide")
    return outcomes


@pytest.mark.parametrize("kind", range(len(KINDS)), ids=[each.__name__ for each in KINDS])
def test_nothing_is_wrong_in_silence_next_to_a_singular_pose(kind):
    outcomes = [each for seed in range(kind, DAILY * len(KINDS), len(KINDS)) for each in looked_at(seed)]
    assert {"refused", "told", "silent"} & set(outcomes)


@pytest.mark.slow
@pytest.mark.parametrize("part", range(30))
def test_nothing_is_wrong_in_silence_next_to_singular_poses(part):
    outcomes = [each for seed in range(1000 + 50 * part, 1050 + 50 * part) for each in looked_at(seed, 100.0)]
    assert {"refused", "told", "silent"} <= set(outcomes)
    assert outcomes.count("wide") <= 2
