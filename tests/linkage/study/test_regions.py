"""Pivots in regions: polygons with corners that point inwards, forbidden shapes, circles. An own even-odd test says who is inside."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import (
    DefinitionError,
    FunctionTask,
    Ground,
    Outline,
    PathTask,
    around,
    at,
    distance,
    inside,
    least,
    mm,
    most,
    optimise,
    outside,
    synthesise,
    x,
    y,
)
from linkage.motion.measures import FixedNumber
from linkage.study.problem import Problem
from linkage.study.solver import Local
from linkage.study.space import Space
from mechanisms.classics.four_bar import FourBar
from tests.for_all import for_all

L_SHAPE = [(0.06, -0.03), (0.14, -0.03), (0.14, 0.05), (0.12, 0.05), (0.12, -0.01), (0.06, -0.01)]
STAR = [
    (0.1, 0.06), (0.088, 0.02), (0.05, 0.02), (0.08, 0.0), (0.07, -0.04), (0.1, -0.015), (0.13, -0.04), (0.12, 0.0), (0.15, 0.02),
    (0.112, 0.02),
]  # fmt: skip
CORNER = [(-0.05, -0.05), (0.05, -0.02), (0.0, 0.04)]
TURN = np.linspace(0.0, 2.0 * np.pi, 5001)


def winding(place, corners):
    """Return how often a closed line goes round a place, by the sum of the angles: an own way, not that of rays."""
    arms = np.array([complex(*corner) for corner in corners]) - complex(*place)
    return round(float(np.sum(np.angle(np.roll(arms, -1) / arms))) / (2.0 * np.pi))


def from_border(place, corners):
    """Return how far a place is from a closed line, by 20,001 places of each edge."""
    share = np.linspace(0.0, 1.0, 20_001)
    ends = zip(corners, [*corners[1:], corners[0]], strict=True)
    return min(np.abs(complex(*a) + share * (complex(*b) - complex(*a)) - complex(*place)).min() for a, b in ends)


class Wheeled(FourBar):
    """A four-bar on a plate, with a wheel beside it."""

    plate = Outline(L_SHAPE)
    wheel = Outline.circle(at=(0.11, 0.02), radius=0.03)
    cover = Outline([(0, 0), (0.1, 0), (0.05, 0.04)], on=("A", "B"))


class Spots(FourBar):
    """A four-bar with two places that hold nothing."""

    Q = Ground(0.1, 0.0)
    R = Ground(0.0, 0.0)


@pytest.mark.parametrize("corners", [L_SHAPE, STAR, STAR[::-1], [(0.0, 0.0), (0.1, 0.0), (0.03, 0.08)]])
def test_how_far_a_point_lies_inside_is_told_by_windings_and_borders(corners):
    random = np.random.default_rng(5)
    places = random.uniform([0.03, -0.05], [0.16, 0.07], (60, 2))
    values = Spots(**{"Q.x": places[:, 0], "Q.y": places[:, 1]}).answers([at(inside("Q", corners))])[0].value
    for place, value in zip(places, values, strict=True):
        sign = 1.0 if winding(place, corners) else -1.0
        assert_allclose(value, sign * from_border(place, corners), rtol=0, atol=5e-6 * 2)
    assert min(values) < 0.0 < max(values)


def test_several_shapes_and_forbidden_ones():
    square, wheel = [(0.0, 0.0), (0.1, 0.0), (0.1, 0.1), (0.0, 0.1)], Outline.circle(at=(0.1, 0.1), radius=0.05)
    asked = at(inside("Q", square, [(0.2, 0.0), (0.3, 0.0), (0.3, 0.1)], outside(wheel)))
    wanted = {
        (0.05, 0.05): 0.05 * np.sqrt(2) - 0.05, (0.29, 0.03): 0.01, (0.15, 0.05): -0.05, (0.09, 0.09): 0.01 * np.sqrt(2) - 0.05,
        (0.04, 0.03): 0.03,
    }  # fmt: skip
    for place, value in wanted.items():
        (answer,) = Spots(Q=place).answers([asked])
        assert_allclose(answer.value, value, atol=1e-12)


def test_the_derivative_is_that_of_differences():
    space = Space.of(Spots(), {"Q": around(60 * mm), "R": around(20 * mm)})
    goal = at(inside("Q", STAR, outside(L_SHAPE))) + at(inside("R", CORNER))
    problem = Problem(Spots(), [goal], [], space)
    random, step = np.random.default_rng(3), 1e-6
    for unit in random.uniform(0.1, 0.9, (6, 4)):
        local = Local(problem, (), unit)
        _, slopes = local.objective(local.first(unit))
        for place in range(4):
            moved = np.eye(4)[place] * step
            change = (local.objective(unit + moved)[0] - local.objective(unit - moved)[0]) / (2.0 * step)
            assert_allclose(slopes[place], change, rtol=1e-5, atol=1e-7)


def test_a_moving_point_stays_inside_over_the_whole_stroke():
    found = optimise(
        FourBar(), maximise=most(distance("O", "P")), vary={"AP": (0.01, 0.08), "BAP": (-1.0, 1.0)},
        regions={"P": [(-0.06, -0.04), (0.2, -0.04), (0.2, 0.11), (-0.06, 0.11)]},
    )  # fmt: skip
    path = found.machine.at(phi=TURN)["P"]
    assert path[0].min() >= -0.06 - 1e-9 and path[1].max() <= 0.11 + 1e-9 and path[1].min() >= -0.04 - 1e-9


@pytest.mark.parametrize("regions", [{"C": STAR}, {"C": ["plate", outside("wheel")]}])
def test_the_population_is_drawn_inside(regions):
    space = Space.of(Wheeled(), {"C": around(80 * mm), "OA": (0.02, 0.06)}, regions)
    unit = np.random.default_rng(0).random((500, 3))
    values = space.values(space.drawn(unit, "Wheeled", 1))
    corners = STAR if regions["C"] is STAR else L_SHAPE
    assert all(winding(place, corners) for place in values[:, :2])
    if corners is L_SHAPE:
        assert np.hypot(values[:, 0] - 0.11, values[:, 1] - 0.02).min() >= 0.03
    assert_allclose(values[:, 2], space.values(unit)[:, 2], rtol=1e-12)
    assert np.ptp(values[:, :2], axis=0).min() > 0.07
    assert np.array_equal(space.drawn(unit, "Wheeled", 1), space.drawn(unit, "Wheeled", 1))


@pytest.mark.slow
@pytest.mark.parametrize("regions", [{"C": ["plate", outside("wheel")]}, pytest.param({"C": L_SHAPE, "O": CORNER}, marks=pytest.mark.slow)])
def test_no_pivot_of_an_answer_is_outside(regions):
    """The known machine's own pivot stands outside, so that another one is to be found."""
    known = FourBar(OA=0.036, AB=0.11, CB=0.085, AP=0.05, C=(0.085, 0.02))
    assert not winding((0.085, 0.02), L_SHAPE)
    phi = np.linspace(0.3, 5.5, 10)
    vary = {
        "OA": (0.01, 0.08), "AB": (0.05, 0.2), "CB": (0.05, 0.2), "AP": (0.01, 0.12), "BAP": (-1.5, 1.5), "C": around(80 * mm),
        "O": around(30 * mm),
    }  # fmt: skip
    task = PathTask(known.at(phi=phi)["P"].T, of="P")
    found = synthesise(Wheeled(), path=task, vary=vary, regions=regions, starts=2)
    assert found.solutions and found.best.most < 2 * mm
    for each in found.solutions:
        C, O = ([each.machine[f"{point}.{axis}"] for axis in "xy"] for point in "CO")
        assert winding(C, L_SHAPE)
        if "O" in regions:
            assert winding(O, regions["O"])
        else:
            assert np.hypot(C[0] - 0.11, C[1] - 0.02) >= 0.03
        each.machine.at(phi=TURN)


def test_a_circle_about_where_a_pivot_stands():
    bar = FourBar()
    task = FunctionTask([0.4, 1.0, 2.0, 3.0], [1.9, 1.8, 1.9, 2.3], of="psi")
    vary = {"C": around(radius=15 * mm), "OA": (0.02, 0.06), "AB": (0.08, 0.2), "CB": (0.05, 0.15)}
    found = synthesise(bar, function=task, vary=vary, starts=1, limit=1500)
    assert found.solutions
    for each in found.solutions:
        assert np.hypot(each.machine["C.x"] - bar["C.x"], each.machine["C.y"] - bar["C.y"]) <= 15 * mm
    best = optimise(bar, maximise=at(x("C")) + at(y("C")), vary={"C": around(radius=15 * mm)}, starts=1)
    assert_allclose([best.machine["C.x"] - bar["C.x"], best.machine["C.y"] - bar["C.y"]], 15 * mm / np.sqrt(2), rtol=1e-4)


@for_all(
    ("regions", "words"),
    [
        ({"X": L_SHAPE}, "Point 'X' is unknown"),
        ({"C": []}, "is no region"),
        ({"C": [(0, 0), (1, 1)]}, "three corners at least"),
        ({"C": [(0, 0), (1, 1), (1, 0), (0, 1)]}, "does not cross itself"),
        ({"C": ["plat"]}, "Outline 'plat' is unknown .* Did you mean plate\\? Known: plate, wheel, cover"),
        ({"C": "cover"}, "is carried by A, B"),
        ({"C": [(5, 5), (6, 5), (6, 6)]}, "nothing of it lies in the ranges"),
        ([L_SHAPE], "a region for each point"),
        ({"C": [3.0]}, "is no shape"),
    ],
)
def test_what_is_no_region_is_refused(regions, words):
    with pytest.raises(DefinitionError, match=words):
        optimise(Wheeled(), minimise=least(distance("O", "C")), vary={"C": around(20 * mm)}, regions=regions)


@pytest.mark.parametrize("arguments", [{}, {"by": 1.0, "radius": 1.0}, {"radius": 0.1, "step": 0.01}, {"radius": -1.0}])
def test_a_circle_that_is_none_is_refused(arguments):
    with pytest.raises(DefinitionError, match="around"):
        around(**arguments)
    with pytest.raises(DefinitionError, match="no fixed point"):
        Space.of(FourBar(), {"OA": around(radius=10 * mm)})


def test_a_region_is_a_condition_of_the_problem():
    space = Space.of(Wheeled(), {"C": around(60 * mm)}, {"C": [L_SHAPE]})
    (condition,) = space.conditions
    assert str(condition).startswith("least(inside(C, [(0.06, -0.03)")
    assert isinstance(Problem(Wheeled(), [FixedNumber(0.0)], space.conditions, space).constraints[0].right, FixedNumber)
