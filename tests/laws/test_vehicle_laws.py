"""Laws of vehicles on their supports, over random machines: the frame balances as every body does, and the equations say the same."""

import numpy as np
from numpy.testing import assert_allclose

from linkage import pin_forces, standing
from linkage.formulas import equations
from tests.for_all import for_all
from tests.laws.random_machines import random_machine
from tests.laws.random_vehicles import random_vehicle

MANY, DAILY = 120, 2
EACH = for_all("seed", range(DAILY), slow=range(DAILY, MANY))


def turning(place, force):
    """Return the moment of a force about the origin."""
    return place[0] * force[1] - place[1] * force[0]


@EACH
@for_all("case", [None, "up", "down"])
def test_the_frame_of_a_vehicle_balances(seed, case):
    """All that `on_body` tells of the frame, and the couples of its joints, add up to nothing: at rest and while friction acts."""
    draft, (kind, names) = random_machine(seed), random_vehicle(seed)
    motion = kind().at(**draft.strokes(3))
    for rates in (None, {name: 0.05 for name in draft.spans}):
        forces = pin_forces(motion, case=case, rates=rates)
        on_frame = forces.on_body("frame")
        elsewhere = {f"{joint.point} ({joint.kind})": joint.place for joint in forces.joints if joint.place is not None}
        places = {name: elsewhere[name] if name in elsewhere else motion[name] for name in on_frame}
        sides = [(joint, 1.0 if joint.on == "frame" else -1.0) for joint in forces.joints if "frame" in (joint.on, joint.by)]
        size = max(np.abs(force).max() for force in on_frame.values())
        moment = sum(turning(places[name], force) for name, force in on_frame.items()) + sum(sign * each.couple for each, sign in sides)
        assert np.abs(sum(on_frame.values())).max() <= 1e-12 * size
        assert np.abs(moment).max() <= 1e-12 * size * 10.0  # m, about how far the outermost points are apart
        assert forces.residual <= 1e-12
        assert set(forces.axle_loads) == set(names)


@EACH
def test_equations_of_axle_loads_are_the_engine(seed):
    """Two of the loads follow from the equations; those of more supports are told to be given."""
    draft, (kind, names) = random_machine(seed), random_vehicle(seed)
    strokes = draft.strokes(3)
    listed = equations(kind(), forces=True)
    values, found = listed.values(at=strokes), standing(kind().at(**strokes)).reactions
    written = [name for name in names if f"R_{name}" in values]
    size = max(np.abs(force).max() for force in found.values())
    assert len(written) == 2
    for name in written:
        assert_allclose(values[f"R_{name}"] * np.ones(3), found[name], rtol=1e-9, atol=1e-12 * size)
    about, given = listed.axles
    assert about == names[0] and set(given) == set(names) - set(written)
    assert ("they hang on how the supports give way" in str(listed)) == bool(given)
