"""Machines that turn round are drawn where their pins stand apart and nothing turns back."""

from itertools import combinations

import numpy as np

from linkage.pictures.poses import motions
from linkage.pictures.scene import Scene
from linkage.pictures.strokes import is_turn
from linkage.reports import Run, first_stroke
from tests import shipped
from tests.for_all import for_all

SHIPPED = shipped.MACHINES
NEAR = 6.0
"""Sizes of a pin between two pins, where the machine allows it."""


def goes_round(cls):
    name = first_stroke(cls())
    stroke = cls().strokes[name]
    return is_turn(cls(), Run({name: (stroke.start, stroke.end)}, {}))


ROUND = {name: cls for name, cls in SHIPPED.items() if goes_round(cls)}


def least_distance(motion):
    """Return the distance of the two nearest pins at every pose, of those that do not lie on each other always, in sizes."""
    scene = Scene(motion)
    apart = np.array([np.hypot(*(motion[P] - motion[Q])).reshape(-1) for P, Q in combinations(motion.plan.points, 2)])
    return apart[apart.max(axis=1) > 1e-9].min(axis=0) / scene.size


def test_many_machines_go_round():
    assert len(ROUND) >= 11


@for_all("name", ROUND)
def test_no_two_pins_of_the_bold_pose_are_near(name):
    machine = ROUND[name]()
    (stroke,), shown, _ = motions(machine, None, 5)
    start = machine.strokes[stroke].start
    around = machine.at(**{stroke: np.append(start + np.radians(np.arange(0.0, 360.0, 10.0)), shown.strokes[stroke].ravel()[-1])})
    distances = least_distance(around)
    assert distances[-1] >= min(NEAR, 0.8 * distances[:-1].max()) * (1.0 - 1e-6)


@for_all("name", ROUND)
def test_the_bold_pose_keeps_from_dead_points(name):
    machine = ROUND[name]()
    (stroke,), shown, _ = motions(machine, None, 5)
    bold = shown.strokes[stroke].ravel()[-1]
    around = machine.at(**{stroke: bold + np.radians(np.linspace(-9.5, 9.5, 77))})
    for point in machine.plan.moving:
        if point in machine.plan.points:
            ratio = around.ratio(point)
            assert ((ratio[:, 1:] * ratio[:, :-1]).sum(axis=0) >= 0.0).all(), point


@for_all("name", ROUND)
def test_poses_stand_apart_and_are_the_same_again(name):
    machine = ROUND[name]()
    (stroke,), shown, _ = motions(machine, None, 5)
    angles = shown.strokes[stroke].ravel()
    assert 2 <= angles.size <= 3
    between = [abs((a - b + np.pi) % (2 * np.pi) - np.pi) for a, b in combinations(angles, 2)]
    assert min(between) >= np.radians(30.0) - 1e-9
    again = motions(ROUND[name](), None, 5)[1].strokes[stroke].ravel()
    np.testing.assert_array_equal(angles, again)
