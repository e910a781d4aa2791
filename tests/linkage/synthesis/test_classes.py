"""Synthesis over several classes: the class that a path is of is found and ranked first, and each has its part of a limit."""

import csv
import os

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import (
    DefinitionError,
    Featured,
    FunctionTask,
    Mechanism,
    PathTask,
    PoseTask,
    Stroke,
    chains,
    deg,
    least,
    mm,
    synthesise,
    transmission,
)
from linkage.synthesis.synthesis import (
    default_box,
    laid_machine,
    search_of_class,
    shipped_machines,
    swept_size,
    synthesised_classes,
)
from linkage.synthesis.tasks import task_named_in
from mechanisms.classics.four_bar import DragLink, FourBar
from mechanisms.classics.slider_crank import SliderCrank
from mechanisms.classics.stephenson_three import StephensonThree

A, B, OFFSET, AP, BAP = 35 * mm, 100 * mm, -10 * mm, 50 * mm, 0.9
BAR = {"OA": (20 * mm, 60 * mm), "AB": (50 * mm, 200 * mm), "CB": (50 * mm, 200 * mm), "AP": (20 * mm, 150 * mm), "BAP": (0.0, 90 * deg)}
POINTS = [(0.03, 0.06), (0.015, 0.07), (0.0, 0.072), (-0.015, 0.066), (-0.022, 0.05)]


def rod_point(phi, a=A, b=B, offset=OFFSET, far=AP, angle=BAP):
    """Return where a point of a slider-crank's rod stands, complex [m], by its own formula; the slider's line is y = offset."""
    pin = a * np.exp(1j * phi)
    height = offset - pin.imag
    way = np.sqrt(b**2 - height**2) + 1j * height
    return pin + far * way / b * np.exp(1j * angle)


def rod_path(count=12):
    """Return points of such a path, shape (count, 2) [m]."""
    path = rod_point(np.linspace(0.2, 5.6, count))
    return np.stack([path.real, path.imag], axis=1)


@pytest.fixture(scope="module")
def found():
    return synthesise([FourBar, SliderCrank], path=PathTask(rod_path()), starts=8)


@pytest.mark.slow
def test_the_class_that_a_path_is_of_is_found_exactly_and_ranked_first(found):
    best = found.best
    assert type(best.machine) is SliderCrank
    assert best.error <= 1e-20
    for name, value in (("OA", A), ("AB", B), ("AP", AP)):
        assert_allclose(best.machine[name], value, rtol=0, atol=1e-9)
    own = rod_point(np.linspace(0.0, 2.0 * np.pi, 5001))
    where = best.machine.at(phi=best.strokes)["P"]
    assert np.abs(own[:, None] - (where[0] + 1j * where[1])).min(axis=0).max() <= 2.0 * np.pi * 0.1 / 5001
    assert [each.start.plan.title for each in found.classes] == ["SliderCrank", "FourBar"]
    bar = found.classes[1]
    assert bar.error > 1e-12 and found.own(bar.best) is bar
    assert [each.error for each in found.solutions[1:]] == sorted(each.error for each in found.solutions[1:])


def test_a_table_says_what_each_class_can(found, tmp_path):
    lines = found.table.splitlines()
    assert len(lines) == 3 and lines[1].startswith("SliderCrank") and lines[2].startswith("FourBar")
    assert lines[1].split()[1] == lines[2].split()[1] == "4"
    for line, each in zip(lines[1:], found.classes, strict=True):
        _, _, error, rms, size, angle, count, searches = line.split()
        assert_allclose(float(error), each.error, rtol=1e-2)
        assert_allclose(float(rms) * mm, each.best.rms, rtol=1e-3)
        assert_allclose(float(angle) * deg, each.best.transmission, rtol=1e-2)
        turn = each.machine.sweep(97)
        box = np.concatenate([turn[name].reshape(2, -1) for name in each.machine.plan.points], axis=1)
        assert_allclose(float(size) * mm, np.ptp(box, axis=1).max(), rtol=1e-3)
        assert swept_size(each.fit_of(each.best), each.machine) == np.ptp(box, axis=1).max()
        assert (int(count), int(searches)) == (len(each.solutions), each.starts)
    assert found.table in str(found) and "2 classes: " in str(found) and "1. SliderCrank: exact, error" in str(found)
    found.csv(tmp_path / "answers.csv")
    with open(tmp_path / "answers.csv", newline="", encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    assert [row["class"] for row in rows] == [type(each.machine).__name__ for each in found.solutions]
    for row, each in zip(rows, found.solutions, strict=True):
        assert float(row["error"]) == each.error and float(row["OA, mm"]) == each.machine["OA"] / mm
        assert (row["CB, mm"] == "") == (type(each.machine) is SliderCrank)


def test_an_answer_is_of_its_class(found):
    place = next(place for place, each in enumerate(found.solutions) if type(each.machine) is FourBar)
    coarse = found.rounded(1 * mm, 1 * deg, place=place)
    assert type(coarse.machine) is FourBar and coarse.error >= found.solutions[place].error
    error = sum(found.machine.answers([each])[0].value for each in found.point_measures())
    assert error <= 1e-20


def test_every_class_has_an_equal_part_of_what_is_left_of_a_limit():
    asked = []

    def one(machine, *, starts, seed, limit, **options):
        asked.append((starts, seed, limit, options["folder"]))
        return synthesise(machine, path=options["path"], vary=BAR, starts=1, limit=min(limit, 300))

    by_class = {"vary": BAR, "subject_to": (), "rank": None, "over": None}
    task = [("path", PathTask(POINTS), PathTask), ("function", None, FunctionTask), ("motion", None, PoseTask)]
    options = {"starts": 16, "seed": 7, "limit": 4000, "folder": "kept"}
    found = synthesised_classes(one, [FourBar, DragLink], task, by_class, False, options)
    spent = found.classes[0].evaluations if found.classes[0].start.plan.title == "FourBar" else found.classes[1].evaluations
    assert asked == [(16, 7, 2000, os.path.join("kept", "FourBar-1")), (16, 7, 4000 - spent, os.path.join("kept", "DragLink-2"))]


# What is said class by class, and what is not said.


def test_the_default_box_follows_from_the_size_of_the_task():
    task = PathTask(np.array(POINTS) + np.array([[0.5, 0.0]]))
    bar, own = FourBar(), task_named_in(FourBar(), task)
    assert own.of == "P" and task.of is None
    laid = laid_machine(bar, own)
    path = laid.sweep(97)["P"]
    size, middle = 0.052, np.mean(task.points, axis=0)
    assert_allclose(np.ptp(path, axis=1).max(), size, rtol=1e-12)
    assert_allclose(path.mean(axis=1), middle, rtol=0, atol=1e-12)
    box = default_box(laid, own)
    assert set(box) == {"O.x", "O.y", "C.x", "C.y", "OA", "AB", "CB", "AP", "BAP"}
    assert_allclose(box["OA"], (0.05 * size, 5.0 * size))
    assert_allclose(box["BAP"], (-np.pi, np.pi))
    assert_allclose(box["C.x"], middle[0] + 5.0 * size * np.array([-1.0, 1.0]))
    slider = default_box(SliderCrank(), task_named_in(SliderCrank(), task))
    assert "rail.x" not in slider and {"rail.y", "rail.angle", "AP", "BAP"} <= set(slider)
    function = FunctionTask([0.1, 0.5], [0.2, 0.3], of="psi")
    assert set(default_box(bar, function)) == {"O.x", "O.y", "C.x", "C.y", "OA", "AB", "CB"}


def test_what_is_said_of_a_class_goes_to_it_alone():
    by_class = {
        "vary": {FourBar: BAR, SliderCrank: {"OA": (0.02, 0.05)}},
        "subject_to": {FourBar: [least(transmission("B")) >= 40 * deg]},
        "rank": None,
        "regions": {SliderCrank: {"O": None}},
        "over": {"phi": (0.0, 1.0)},
    }
    task = [("path", PathTask(POINTS, of={FourBar: "P", SliderCrank: "B"}), PathTask)]
    bar, slider, drag = (search_of_class(machine, task, by_class)[1] for machine in (FourBar(), SliderCrank(), DragLink()))
    assert bar["path"].of == drag["path"].of == "P" and slider["path"].of == "B"
    assert bar["vary"] is drag["vary"] is BAR and slider["vary"] == {"OA": (0.02, 0.05)}
    assert len(bar["subject_to"]) == 1 and slider["subject_to"] == ()
    assert bar["regions"] is None and slider["regions"] == {"O": None}
    assert bar["over"] == slider["over"] == {"phi": (0.0, 1.0)}


def test_machines_that_are_installed_are_the_list_where_none_is_given():
    kinds = [type(each).__name__ for each in shipped_machines()]
    assert {"FourBar", "SliderCrank", "InvertedSliderCrank", "WattOne", "WattTwo", "StephensonOne", "StephensonThree"} <= set(kinds)
    assert not {"StephensonTwo", "Crane", "DragLink", "Jansen"} & set(kinds)


@pytest.mark.slow
def test_machines_of_chains_are_classes_like_others():
    points = FourBar().at(phi=np.linspace(0.3, 5.5, 6))["P"].T
    bar = chains(4)[0].inversions[0].machine()
    found = synthesise([bar, chains(6)[0].inversions[1].machine()], path=PathTask(points), starts=3, timed="steps")
    assert [each.start.plan.title for each in found.classes if each.solutions]
    for each in found.solutions:
        each.machine.sweep(181)


def test_a_design_of_a_class_that_names_no_coupler_point_is_refused_with_its_points():
    class Crankless(Mechanism):
        phi = Stroke(0.0, 1.0)
        O, C, A, B = (FourBar.plan.members[name] for name in "OCAB")

    with pytest.raises(DefinitionError, match=r"Crankless: say what of this class the task is of.*one of A, B"):
        synthesise([Crankless], path=PathTask(POINTS))
    with pytest.raises(DefinitionError, match="of='Q': a point that moves is expected, one of A, B, P"):
        synthesise([FourBar], path=PathTask(POINTS, of="Q"))
    with pytest.raises(DefinitionError, match=r"a list of classes is expected"):
        synthesise([], path=PathTask(POINTS))
    with pytest.raises(DefinitionError, match="say one task"):
        synthesise([FourBar, SliderCrank])
    with pytest.raises(DefinitionError, match="the name of a point is expected"):
        Featured(coupler=3)


@pytest.mark.slow
def test_every_class_says_what_it_can_for_a_closed_curve():
    phi = np.linspace(0.0, 2.0 * np.pi, 17)[:-1]
    points = StephensonThree().at(phi=phi)["P"].T
    found = synthesise(path=PathTask(points, closed=True), starts=32)
    assert len(found.classes) == len(shipped_machines())
    assert all(each.solutions or each.misses for each in found.classes)
    errors = [each.error for each in found.classes]
    assert errors == sorted(errors) or found.classes[0].error <= found.classes[0].exact
    assert found.best.rms < 1 * mm
    for each in found.solutions:
        each.machine.sweep(721)
