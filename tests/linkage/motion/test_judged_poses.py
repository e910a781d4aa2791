"""Which poses a judge looks at: in boxes, near legs and poses, where conditions hold; against many places on each leg."""

import numpy as np
from numpy.testing import assert_array_equal

from linkage import Crank, Ground, LoadCase, Mechanism, Over, Stroke, Support, Weight, deg, x
from linkage.motion import judged_poses, pose_sentence
from tests.for_all import for_all


class Reach(Mechanism):
    """Two cranks, one on the other, and a mast that slides."""

    alpha, beta, slide = Stroke(0.0, 90 * deg), Stroke(-60 * deg, 60 * deg), Stroke(0.0, 2.0)
    O = Ground(0, 0)
    P = Crank(O, OP=1.0 + 0.1 * slide, angle=alpha)
    T = Crank(P, PT=0.9, angle=alpha + beta)


class Tipping(Mechanism):
    """A frame on two wheels 2 m apart, with a load on a boom that goes down before the front one at the origin."""

    phi = Stroke(0.0, 90 * deg)
    front_axle, rear_axle, M = Ground(0.0, 0.0), Ground(-2.0, 0.0), Ground(-1.0, 0.5)
    O = Ground(0.0, 1.0)
    G = Crank(O, OG=2.5, angle=phi)
    body, load = Weight(M, mass=1000.0), Weight(G, mass=600.0)
    front, rear = Support(front_axle, direction=(0, 1)), Support(rear_axle, direction=(0, 1))
    near = Over(phi=(60 * deg, 90 * deg))


class Loading(Tipping):
    """The same frame: lowered without its load alone."""

    empty = LoadCase("empty", scale={"load": 0.0})
    low = Over(phi=(0.0, 50 * deg), cases=["empty"])


TRAVEL = np.array([90 * deg, 120 * deg, 2.0])
LEGS = {"alpha": [0.1, 1.2, 1.2, 1.2, 0.3], "beta": [0.0, 0.5, 0.5, -0.4, -0.4], "slide": [0.0, 1.0, 1.7, 1.7, 0.2]}


def poses(seed, count=400):
    """Return random strokes, half of them near the legs."""
    random = np.random.default_rng(seed)
    share = random.uniform(0.0, 4.0, count)
    on = np.array([np.interp(share, np.arange(5), each) for each in LEGS.values()])
    off = random.uniform(-0.03, 0.03, on.shape) * TRAVEL[:, None]
    wide = random.uniform([[0.0], [-60 * deg], [0.0]], [[90 * deg], [60 * deg], [2.0]], on.shape)
    return np.where(np.arange(count) % 2, on + off, wide)


def nearest(values, legs, fine=4001):
    """Return how far poses are from the nearest of many places on the legs, the farthest stroke's way as a part of its travel."""
    along = np.array([np.interp(np.linspace(0, 4, fine), np.arange(5), each) for each in legs.values()])
    apart = np.abs(values[:, :, None] - along[:, None, :]) / TRAVEL[:, None, None]
    return apart.max(axis=0).min(axis=-1)


@for_all("seed", range(1), slow=range(1, 3))
def test_near_a_leg_is_within_two_percent_of_every_strokes_travel(seed):
    machine, values = Reach(), poses(seed)
    motion = machine.at(**dict(zip(LEGS, values, strict=True)))
    found, far = judged_poses(machine.judge(Over.path(**LEGS)), motion), nearest(values, LEGS)
    clear = np.abs(far - 0.02) > 2e-3  # the places on the legs are apart
    assert_array_equal(found[clear], (far < 0.02)[clear])
    assert found[clear].any() and not found[clear].all()


def test_poses_boxes_and_conditions():
    machine = Reach()
    grid = machine.at(alpha=np.linspace(0.0, 1.5, 7)[:, None, None], beta=np.linspace(-1.0, 1.0, 9)[:, None], slide=[0.0, 0.03, 0.05, 1.0])
    alpha, _, slide = np.broadcast_arrays(*grid.strokes.values())
    assert judged_poses(machine.judge(), grid).all()
    box = judged_poses(machine.judge(Over(alpha=(0.5, 1.0), slide=0.0)), grid)
    assert_array_equal(box, (alpha >= 0.5) & (alpha <= 1.0) & (slide <= 0.04))
    low = judged_poses(machine.judge(Over(only=[x("T") <= 1.0])), grid)
    assert_array_equal(low, grid["T"][0] <= 1.0)
    some = judged_poses(machine.judge(Over.poses(alpha=[0.0, 1.5], beta=[-1.0, 1.0], slide=0.0)), grid)
    assert some.sum() == 4 and some[0, 0, :2].all() and some[-1, -1, :2].all()
    several = judged_poses(machine.judge([Over(alpha=(0.5, 1.0), slide=0.0), Over(slide=(0.9, 1.1))]), grid)
    assert_array_equal(several, box | (slide == 1.0))


def test_what_is_out_of_bounds_at_a_pose_is_told_with_its_number():
    """A mast on two wheels: what its load puts on the rear one is worked out by hand."""
    machine = Tipping()
    near, far = (9.80665 * (1000.0 - 600.0 * 2.5 * np.cos(phi * deg)) / 2.0 for phi in (60.0, 20.0))
    assert near > 0.0 > far
    assert pose_sentence(machine.at(phi=60 * deg)) == "At this pose: all kept."
    beyond = "At this pose: outside what is judged; if it were judged:"
    assert pose_sentence(machine.at(phi=20 * deg)) == f"{beyond} axle load rear {far / 1e3:.4g} kN."
    assert pose_sentence(Reach().at(alpha=0.5, beta=0.1, slide=0.0)) == ""
    load = Loading()  # of all cases in one place, of one in the other
    kept = [pose_sentence(load.at(phi=phi * deg)) for phi in (60.0, 20.0)]
    assert kept == ["At this pose: all kept.", "At this pose: all kept in the case empty."]


def test_designs_of_a_batch_have_the_same_poses_judged():
    machine = Reach(PT=[0.9, 1.1])
    motion = machine.at(alpha=np.linspace(0.0, 1.5, 7), beta=0.0, slide=0.0)
    only = judged_poses(machine.judge(Over(only=[x("T") <= 1.5])), motion)
    assert only.shape == (2, 7)
    assert_array_equal(only, motion["T"][0] <= 1.5)


def test_what_runs_beyond_its_stroke_says_so():
    class Far(Reach):
        far = Over(alpha=(0.0, 120 * deg), beta=0.0, slide=(0.0, 2.001))

    class Near(Reach):
        near = Over(alpha=(90 * deg, 0.0), beta=0.0, slide=1.0)

    assert Far().verdicts()[0].sentence.endswith("slide = 0 to 2001 mm. It runs beyond the declared alpha = 0 to 90 deg.")
    assert "beyond" not in Near().verdicts()[0].sentence


def test_what_runs_next_to_nothing_of_a_declared_stroke_says_so():
    class Metres(Reach):
        slide = Stroke(0.0, 500)  # in mm, as it was meant
        near = Over(alpha=(0.0, 90 * deg), beta=0.0, slide=(0.0, 0.4))

    told = "Of the declared slide = 0 to 500000 mm it runs less than 1 %: are lengths in m, angles in rad?"
    assert Metres().verdicts()[0].sentence.endswith(told)
    assert "declared" not in Reach().verdicts()[0].sentence
