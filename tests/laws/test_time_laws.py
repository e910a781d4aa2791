"""Laws of forces in time over random machines: rates and accelerations of strokes as inputs of programs, and the inertia of masses."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import FloatCircuit
from linkage import Spring, drive_force, driving_force, pin_force, pin_forces
from linkage.loads import ForceElement
from tests.for_all import for_all
from tests.laws.random_machines import random_machine

DAILY, MANY = 8, 60
EACH = for_all("seed", [seed if seed < DAILY else pytest.param(seed, marks=pytest.mark.slow) for seed in range(MANY)])


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
    near = [machine.replaced(**{dimension: value + way * step}).evaluate(requests, rates=rates, **strokes) for way in (1, -1)]
    for request, more, less in zip(requests, *near, strict=True):
        (slope,) = motion.gradient(request, wrt=[dimension], rates=rates)
        assert_allclose(slope, (more - less) / (2.0 * step), rtol=0, atol=1e-9 * scale / step, err_msg=str(request))
