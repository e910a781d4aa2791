"""Pictures of a synthesis: the task's points, the path and the misses stand where the machines say."""

from functools import cache

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import DefinitionError, FunctionTask, PathTask, PoseTask, StudyError, deg, draw, synthesise
from linkage.language import language
from linkage.pictures import style
from mechanisms.classics.four_bar import FourBar

POINTS = np.array([(0.03, 0.06), (0.015, 0.07), (0.0, 0.072), (-0.015, 0.066), (-0.022, 0.05)])
BOX = {"OA": (0.02, 0.06), "CB": (0.05, 0.2), "AP": (0.02, 0.15), "BAP": (0.0, 90 * deg)}
STROKES = np.radians([30.0, 60.0, 90.0, 120.0])


@cache
def found_for(kind):
    """Return what a synthesis found for a small task of a kind."""
    over = {"phi": (30 * deg, 120 * deg)}
    if kind == "path":
        return synthesise(FourBar(), path=PathTask(POINTS, of="P"), vary=BOX, starts=4)
    if kind == "function":
        task = FunctionTask(STROKES, [2.0, 2.2, 2.4 + 2 * np.pi, 2.9], of="psi")
        return synthesise(FourBar(), function=task, vary={"OA": (0.01, 0.08), "AB": (0.03, 0.2), "CB": (0.03, 0.2)}, over=over, starts=8)
    pose = FourBar().at(phi=STROKES)
    task = PoseTask(pose["A"][0] + 0.002, pose["A"][1], pose.angle("A", "B"), of="A B", at=STROKES)
    return synthesise(FourBar(), motion=task, vary={"OA": (0.03, 0.05), "CB": (0.07, 0.09)}, over=over, starts=4)


def lines(ax, colour):
    """Return the lines of a colour on axes, their points (n, 2) [SI]."""
    return [line.get_xydata() for line in ax.lines if line.get_color() == colour]


def written(figure):
    """Return all that is written about a figure's axes."""
    return [text.get_text() for text in figure.texts]


@pytest.mark.parametrize("kind", ["path", "poses"])
def test_points_and_misses_stand_where_they_are(kind):
    found = found_for(kind)
    figure = draw(found)
    assert len(figure.axes) == min(3, len(found.solutions))
    best, ax = found.best, figure.axes[0]
    wanted = found.task.points if kind == "path" else np.stack([found.task.x, found.task.y], axis=1)
    marks = [line for line in ax.lines if line.get_marker() == "o" and line.get_linestyle() == "None"]
    assert_allclose(marks[0].get_xydata(), wanted)
    point = "P" if kind == "path" else "A"
    met = best.machine.at(phi=best.strokes)[point].T
    drawn = lines(ax, style.INK)
    off = met - wanted
    times = np.hypot(*(drawn[0][1] - drawn[0][0])) / np.hypot(*off[0])
    legend = figure.legends[0].get_texts()[-1].get_text()
    assert legend == f"missed, {round(times)} times as long" and times == pytest.approx(round(times))
    for each in drawn:
        place = int(np.argmin(np.hypot(*(wanted - each[0]).T)))
        assert_allclose(each, [wanted[place], wanted[place] + times * off[place]], atol=1e-12)
    # the largest is drawn at some hundredths of the sheet
    assert 0.02 < times * np.hypot(*off.T).max() / np.ptp(ax.get_xlim()) <= 0.07
    path = next(each for each in lines(ax, style.ACCENT) if len(each) == 101)
    assert_allclose(path, best.machine.at(phi=np.linspace(*(0, 2 * np.pi) if kind == "path" else (STROKES[0], STROKES[-1]), 101))[point].T)
    numbers = {text.get_text() for text in ax.texts}
    assert {str(n + 1) for n in range(len(wanted))} <= numbers and "C" in numbers


@pytest.mark.slow
def test_a_function_is_drawn_as_its_curve_with_the_wanted_values_on_it():
    found = found_for("function")
    figure = draw(found, answers=1)
    curve, sheet = figure.axes
    assert curve.get_ylabel() == "psi, deg" and curve.get_xlabel() == "phi, deg"
    marks = next(line for line in curve.lines if line.get_marker() == "o")
    assert_allclose(marks.get_xydata(), np.degrees([STROKES, np.array([2.0, 2.2, 2.4, 2.9])]).T)
    drawn = lines(curve, style.INK)
    assert_allclose([each[1][1] - each[0][1] for each in drawn], np.degrees(found.best.reached[0] - [2.0, 2.2, 2.4, 2.9]), atol=1e-9)
    assert "phi = 30°" in sheet.get_title("right")


def test_answers_stand_side_by_side_with_what_they_miss():
    found = found_for("function")
    assert len(found.solutions) >= 2
    figure = draw(found, answers=2)
    texts = written(figure)
    for place, each in enumerate(found.solutions[:2], 1):
        assert f"{place}.  rms {each.rms / deg:.4g} deg, at most {each.most / deg:.4g} deg at point {each.worst}" in texts
    assert "psi at 4 strokes" in texts
    sheets = [ax for ax in figure.axes if ax.get_ylabel() == "y, mm"]
    one, two = (ax.get_position().height * figure.get_figheight() / np.ptp(ax.get_ylim()) for ax in sheets)
    assert one == pytest.approx(two)  # to one scale


def test_an_exact_answer_is_called_that_and_misses_nothing():
    task = PathTask(FourBar().at(phi=STROKES)["P"].T, of="P", at=STROKES)
    figure = draw(synthesise(FourBar(), path=task, vary={"OA": (0.03, 0.05), "CB": (0.07, 0.09)}, starts=4), answers=1)
    assert "1.  exact" in written(figure)
    assert not lines(figure.axes[0], style.INK) and len(figure.legends[0].get_texts()) == 2


def test_russian():
    with language("ru"):
        figure = draw(found_for("path"))
    assert any("траектория точки P через 5 точек" in each for each in written(figure))


def test_what_cannot_be_drawn_is_said():
    found = found_for("path")
    words = {"answers": "a whole number from 1 to 12", "at": "drawn beside its task", "count": "at least 2"}
    for given, said in (({"answers": 0}, words["answers"]), ({"at": 0.1}, words["at"]), ({"count": 1}, words["count"])):
        with pytest.raises(DefinitionError, match=said):
            draw(found, **given)
    with pytest.raises(DefinitionError, match="answers are those of a synthesis"):
        draw(FourBar(), answers=2)
    none = synthesise(FourBar(), path=PathTask([(3.0, 3.0), (3.1, 3.0)], of="P"), vary={"OA": (0.11, 0.12)}, starts=4)
    with pytest.raises(StudyError, match="no machine that runs"):
        draw(none)
