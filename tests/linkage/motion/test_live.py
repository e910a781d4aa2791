"""What a page computes in the browser is what Python says: places, ratios, forces, what is not reached and by how much."""

import json
import subprocess

import numpy as np
import pytest

from linkage import (
    LEFT,
    AssemblyError,
    Crank,
    Dyad,
    ForceElement,
    Ground,
    Load,
    Mechanism,
    Stroke,
    Weight,
    angle,
    drive_force,
    ratio,
)  # fmt: skip
from linkage.errors import unwarned
from linkage.motion import live_text
from linkage.reports.results import results
from mechanisms.three_point_hitch import ThreePointHitch
from tests.for_all import for_all
from tests.laws import near_singular
from tests.linkage.assembly.test_followed_angles import DragLink, Plane
from tests.linkage.assembly.test_groups import Platform
from tests.linkage.motion import in_node
from tests.linkage.motion.in_node import ELSEWHERE, NEEDED, SHIPPED, Job, asked_of, check, designs_near, possible, swept, ways

OTHERS = dict(in_node.elsewhere())


def job_of(machine, seed, count, poses, **options):
    """Return random designs of a machine along its strokes."""
    designs = possible(machine, designs_near(machine, seed, count))
    return Job(machine, asked_of(machine, **options), designs, ways(machine, poses))


#: One of each kind: dyads, groups, several strokes, gas, an angle that grows, loops that come into line.
SOME = ["header_balancer", "stephenson_two", "hart", "parallelogram", "mast_tilt"]


@NEEDED
def test_machines_say_the_same_in_javascript():
    jobs = [job_of(SHIPPED.get(name) or OTHERS[name], 1, 50, 5) for name in SOME]
    for job, found in zip(jobs, swept(jobs), strict=True):
        assert check(job, found) > 0


@pytest.mark.slow
@NEEDED
def test_a_thousand_hitches_say_the_same_in_javascript():
    hitch = ThreePointHitch
    asked = {"G": "G", "K": "K", "tilt": "tilt", "force": drive_force()}
    job = Job(hitch, asked, designs_near(hitch, 3, 1000), ways(hitch, 5))
    (found,) = swept([job])
    assert check(job, found) > 2000
    assert not found.reached.all()


@NEEDED
@pytest.mark.slow
@pytest.mark.parametrize("name", [*SHIPPED, *ELSEWHERE])
def test_a_thousand_designs_say_the_same_in_javascript(name):
    job = job_of(SHIPPED.get(name) or OTHERS[name], 2, 1000, 7)
    (found,) = swept([job])
    assert check(job, found) > 0


@NEEDED
def test_what_is_missing_is_told_as_in_python():
    hitch = ThreePointHitch
    job = Job(hitch, {"G": "G"}, {"CD": np.linspace(0.2, 1.1, 60)}, ways(hitch, 5))
    (found,) = swept([job])
    seen = set()
    for k, pose in np.argwhere(~found.reached):
        with pytest.raises(AssemblyError) as raised:
            hitch(CD=job.designs["CD"][k]).at(S=job.strokes["S"][pose])
        assert found.steps[int(found.reason[k, pose]) - 1] == raised.value.point
        np.testing.assert_allclose(found.missing[k, pose], raised.value.shortfall, rtol=1e-9)
        seen.add(raised.value.point)
    assert seen >= {"D"}
    assert (found.missing[found.reached] == 0.0).all()


@NEEDED
def test_ratios_and_forces_are_refused_next_to_a_dead_point():
    class Toggle(Mechanism):
        O, E = Ground(0.0, 0.0), Ground(1.0, 0.0)
        S = Stroke(0.5, 0.1)
        A = Crank(O, OA=0.5, angle=S)
        B = Dyad(A, E, AB=0.5, EB=0.4, side=LEFT)
        load = Weight(B, mass=10.0)

    dead = np.arccos((0.25 + 1.0 - 0.81) / 1.0)  # AB and EB in line
    offsets = np.array([-1e-3, -1e-9, -1e-14])
    asked = {"B": "B", "ratio": ratio("B"), "force": drive_force()}
    job = Job(Toggle, asked, {}, {"S": dead + offsets})
    (found,) = swept([job])
    assert found.reached.all()
    assert np.isfinite(found.values[0, :2]).all()
    with unwarned():
        wanted = Toggle().evaluate([ratio("B"), drive_force()], unreachable="nan", S=dead + offsets)
    np.testing.assert_array_equal(np.isfinite(found.values[0, 2:]), np.isfinite(np.vstack(wanted)))
    assert not np.isfinite(found.values[0, 2:, -1]).any()


@NEEDED
def test_what_python_refuses_next_to_singular_poses_has_no_value_here():
    """The ratio of a point and the force of its weight, next to poses of slots, levers and guides whose points come together."""
    jobs = []
    for seed in (2, 164, 172, 174, 175, 182, 184, 195):
        machine, strokes, target, _ = near_singular.pose(seed)
        loaded = type(machine.__name__, (machine,), {"load": Weight(target, mass=10.0)})
        asked = {"ratio": ratio(target), "force": drive_force()}
        jobs.append(Job(loaded, asked, {}, {name: np.array([value]) for name, value in strokes.items()}))
    for job, found in zip(jobs, swept(jobs), strict=True):
        with unwarned():
            wanted = np.vstack(job.machine().evaluate([*job.asked.values()], unreachable="nan", **job.strokes))
        assert not np.isfinite(wanted).any(), job.machine.__name__
        assert not np.isfinite(found.values[0]).any(), job.machine.__name__


@NEEDED
def test_angles_go_on_past_half_a_turn():
    machine = SHIPPED["four_bar"]
    name = next(name for name in asked_of(machine) if name == "theta" or name in machine.plan.members)
    job = Job(machine, {"turn": angle("O", "A"), name: name}, {}, {"phi": np.linspace(0.0, 4.0 * np.pi, 50)})
    (found,) = swept([job])
    np.testing.assert_allclose(found.values[0, 0], machine().at(**job.strokes).value(angle("O", "A")), atol=1e-12)


class Branching(ForceElement):
    """A force whose law asks for a number's value."""

    places = ("point",)

    def __init__(self, point):
        self.point = point

    def loads(self, motion):
        if float(np.max(motion[self.point][1])) > 0.9:
            return []
        return [Load(self.point, (0.0, -1.0))]


def test_laws_that_cannot_be_traced_are_left_out_by_name():
    live = live_text(ThreePointHitch.plan, {"G": "G", "odd": drive_force(loads=[Branching("G")])})
    assert set(live.rows) == {"G"}
    assert "cannot be traced" in live.left_out["odd"]


@pytest.mark.slow
@NEEDED
def test_angles_and_pins_are_followed_by_a_function_of_one_pose():
    for machine, asked, at in (
        (DragLink, ["E", "turn", ratio("E")], np.array([[0.3, 5.0, 12.0, 7.0]])),
        (Plane, ["E"], np.array([[0.2, 0.9, -0.4], [0.1, -0.3, 0.5]])),
        (Platform, ["C", ratio("C", Platform.plan.moving and next(iter(Platform.plan.strokes)))], None),
    ):
        strokes = machine.plan.strokes
        if at is None:
            random = np.random.default_rng(4)
            at = np.array([each.start + (each.end - each.start) * random.uniform(0.0, 1.0, 5) for each in strokes.values()])
        text = machine().source(asked, language="javascript")
        design = [machine().dimensions[name] for name in live_text(machine.plan, {}).dimensions]
        call = f"{text}console.log(JSON.stringify({at.T.tolist()}.map(p=>poses({design},p))))"
        said = np.array(json.loads(subprocess.run(["node", "-e", call], check=True, capture_output=True).stdout), float)
        with unwarned():
            wanted = np.array([machine().function(asked)(*pose) for pose in at.T])
        np.testing.assert_allclose(said[:, :2], wanted[:, :2], rtol=0.0, atol=1e-12)


@for_all(
    "name", ["three_point_hitch", "mower_lift", "header_balancer", "boom_drive", "grapple", "slider_crank", "wheel_loader"]
)
def test_columns_say_what_they_are_asked_by(name):
    machine = (SHIPPED.get(name) or OTHERS[name])()
    plan = machine.plan
    motion = machine.at(**{each: np.linspace(stroke.start, stroke.end, 5) for each, stroke in plan.strokes.items()})
    known = [column for column in results(machine, motion) if column.request is not None]
    assert known
    for column in known:
        np.testing.assert_allclose(motion[column.request], column.values, rtol=1e-12, atol=1e-12, err_msg=column.name)
