"""A duty: load cases with their hours, over which the mean of a measure counts. Checked by virtual work on a lever, by hand."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import (
    RIGHT,
    Acting,
    DefinitionError,
    Dyad,
    FunctionTask,
    Ground,
    LoadCase,
    Mechanism,
    OnLink,
    Stroke,
    Weight,
    at,
    deg,
    distance,
    drive_force,
    integral,
    kN,
    least,
    mm,
    most,
    optimise,
    synthesise,
    y,
)
from linkage.motion.measures import as_measure
from linkage.study.problem import Problem
from linkage.study.solver import Local
from linkage.study.space import Space
from linkage.units import g0
from tests.for_all import for_all

DUTY = {"empty": 700.0, "full": 300.0}


class Lever(Mechanism):
    """A cylinder AB lifts the lever OBG; `empty` is the lever alone, `full` twice the plain load."""

    S = Stroke(0.0, 0.3)

    O = Ground(0.0, 0.0)
    A = Ground(0.9, -0.5)
    B = Dyad(A, O, AB=0.65 + S, OB=0.8, side=RIGHT)
    G = OnLink(O, B, OG=1.5, BOG=10 * deg)
    H = OnLink(O, B, OH=0.7)

    own = Weight(H, mass=120.0)
    load = Weight(G, mass=500.0)
    empty = LoadCase("empty", scale={"load": 0.0})
    full = LoadCase("full", scale={"load": 2.0})


MASSES = {"plain": 500.0, "empty": 0.0, "full": 1000.0}


def heights(lever, S):
    """Return how high B's lever stands: the heights of H and G [m] at strokes, by the cosine rule of the triangle AOB."""
    a, b, c = np.hypot(0.9, 0.5), lever["OB"], 0.65 + np.asarray(S)
    at_O = np.arccos((a**2 + b**2 - c**2) / (2 * a * b))
    turn = np.arctan2(-0.5, 0.9) + at_O
    return 0.7 * np.sin(turn), lever["OG"] * np.sin(turn + lever["BOG"])


def forces(lever, S, case):
    """Return the cylinder's force [N] by virtual work, by differences of the heights."""
    (low_H, low_G), (high_H, high_G) = heights(lever, S - 1e-6), heights(lever, S + 1e-6)
    return g0 * (120.0 * (high_H - low_H) + MASSES[case] * (high_G - low_G)) / 2e-6


def works(lever, case):
    """Return the work of the whole stroke [J]: what the weights rise."""
    (low_H, low_G), (high_H, high_G) = heights(lever, 0.0), heights(lever, 0.3)
    return g0 * (120.0 * (high_H - low_H) + MASSES[case] * (high_G - low_G))


def mean(of):
    return 0.7 * of("empty") + 0.3 * of("full")


def test_the_mean_work_of_a_duty_is_that_of_the_cases():
    lever = Lever(OB=0.83)
    values = [each.value for each in lever.answers([
        integral(drive_force(), case=DUTY), integral(drive_force(), case="full"), integral(drive_force(), case="plain"),
        most(drive_force(), case=DUTY), at(drive_force(), S=0.1, case=DUTY), least(drive_force(), case={"full": 2.0}),
    ])]  # fmt: skip
    along = np.linspace(0.0, 0.3, 5001)
    wanted = [
        mean(lambda case: works(lever, case)), works(lever, "full"), works(lever, "plain"),
        mean(lambda case: forces(lever, along, case).max()), mean(lambda case: forces(lever, 0.1, case)),
        forces(lever, along, "full").min(),
    ]  # fmt: skip
    assert_allclose(values, wanted, rtol=1e-7)


def test_hours_and_shares_are_the_same():
    texts = {str(most(drive_force(), case=each)) for each in (DUTY, {"empty": 0.7, "full": 0.3}, {"empty": 7, "full": 3})}
    assert texts == {"0.7 * most(drive_force(case=empty)) + 0.3 * most(drive_force(case=full))"}
    assert str(most("tilt", case=DUTY)) == "most(tilt)"
    own = most(drive_force(case="empty"), case=DUTY)
    assert str(own) == "most(drive_force(case=empty))"


def test_the_derivative_of_a_duty_is_that_of_differences():
    lever = Lever()
    space = Space.of(lever, {"OB": (0.75, 0.85), "A": [(0.9, -0.5)], "BOG": (0.0, 0.4), "OG": (1.2, 1.6)})
    goal = integral(drive_force() ** 2, case=DUTY) / 1e6 + at(drive_force(), S=0.12, case=DUTY)
    local = Local(Problem(lever, [goal], [], space), (0,), np.array([0.3, 0.6, 0.4]))
    unit, step = local.first(np.array([0.3, 0.6, 0.4])), 1e-5
    value, slopes = local.objective(unit)
    for place in range(3):
        moved = np.eye(len(unit))[place] * step
        change = (local.objective(unit + moved)[0] - local.objective(unit - moved)[0]) / (2 * step)
        assert_allclose(slopes[place], change, rtol=1e-6)
    assert value != 0.0


@pytest.mark.slow
@pytest.mark.parametrize("spread", [{"OB": (0.7, 0.9)}])
def test_the_least_mean_thrust_is_that_of_a_grid(spread):
    """The box in steps of 5 mm, by the triangle."""
    held = least(drive_force()) >= 0.5 * kN
    found = optimise(Lever(), minimise=most(drive_force()), vary=spread, subject_to=[held], case=DUTY)
    along, rows = np.linspace(0.0, 0.3, 401), []
    for OB in np.arange(0.7, 0.9001, 0.005):
        lever = Lever(OB=OB)
        if min(forces(lever, along, case).min() for case in ("empty", "full")) >= 0.5 * kN:
            rows.append((mean(lambda case, lever=lever: forces(lever, along, case).max()), OB))
    assert found.value <= min(rows)[0] * (1 + 1e-6)
    assert_allclose(found.value, mean(lambda case: forces(found.machine, np.linspace(0, 0.3, 5001), case).max()), rtol=1e-6)
    worst = optimise(Lever(), minimise=most(drive_force()), vary=spread, subject_to=[held], case=["empty", "full"])
    assert worst.value > found.value


@pytest.mark.slow
def test_a_front_of_two_goals_in_a_duty():
    front = optimise(
        Lever(), minimise=[most(drive_force()), as_measure(most(distance("A", "B")))], vary={"OB": (0.7, 0.9)}, case=DUTY, limit=300
    )
    for point in front.points:
        assert_allclose(point.values[0], mean(lambda case, m=point.machine: forces(m, np.linspace(0, 0.3, 3001), case).max()), rtol=1e-5)


@pytest.mark.slow
def test_a_synthesis_ranks_by_the_mean_and_keeps_its_conditions_in_every_case():
    """Two heights for three dimensions: many levers do the task."""
    S = np.array([0.0, 0.3])
    task = FunctionTask(S, heights(Lever(), S)[1], of=y("G"))
    found = synthesise(
        Lever(), function=task, vary={"OB": (0.75, 0.85), "BOG": (0.0, 0.4), "OG": (1.3, 1.7)}, starts=8,
        rank=integral(drive_force()), case=DUTY, subject_to=[most(drive_force()) <= 40 * kN],
    )  # fmt: skip
    best = found.best
    assert_allclose(best.ranked, mean(lambda case: works(best.machine, case)), rtol=1e-6)
    forced = np.max([forces(best.machine, np.linspace(0.0, 0.3, 5001), case).max() for case in DUTY])
    assert forced <= 40 * kN * (1 + 1e-7)
    answer = best.machine.answers([integral(drive_force(), case=DUTY)], acting=Acting())[0]
    assert_allclose(answer.value, best.ranked, rtol=1e-12)


@for_all(
    ("case", "words"),
    [
        ({"emty": 0.7, "full": 0.3}, "empty"),
        ({"empty": -1.0, "full": 2.0}, "zero or more"),
        ({"empty": 0.0}, "all hours are zero"),
        ({}, "names of load cases"),
        ({"empty": "long"}, "zero or more"),
        ({3: 1.0}, "names of load cases"),
        (7, "oad case"),
    ],
)
def test_a_duty_that_is_none_is_refused(case, words):
    vary = {"OB": (0.75, 0.85)}
    with pytest.raises(DefinitionError, match=words):
        optimise(Lever(), minimise=most(drive_force()), vary=vary, case=case)
    with pytest.raises(DefinitionError, match=words):
        Lever().answers([most(drive_force(), case=case)])


def test_a_function_of_a_motion_says_its_load_case_itself():
    with pytest.raises(DefinitionError, match="says its load case itself"):
        most(lambda motion: motion.y("G"), case=DUTY)
    assert str(at(drive_force(), S=100 * mm)) == "at(drive_force(), S=0.1)"
