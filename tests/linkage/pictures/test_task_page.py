"""The live page of a synthesis in headless Chromium: its task, what is missed, and its answers, against Python."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import DefinitionError, deg, mm, page
from tests.for_all import first_daily
from tests.linkage.pictures.test_draw_synthesis import found_for
from tests.linkage.pictures.test_page import PHONE, Shown, data_of
from tests.linkage.synthesis.test_task_error import nearest


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """Return a function that writes the page of a synthesis once."""
    folder = tmp_path_factory.mktemp("tasks")
    return lambda kind: page(found_for(kind), folder / f"{kind}.html")


def told(shown):
    """Return what a page says of its task."""
    (line,) = (each for each in shown.told if each.startswith("task: "))
    return line


def numbers(line):
    """Return the root mean square and the greatest miss in a sentence, in the unit that is shown."""
    words = line.replace("\u2009", " ").replace("\u00b0", " ").replace(",", " ").split()
    return float(words[2]), float(words[words.index("most") + 1])


@first_daily(1, "kind", ["path", "function", "poses"])
def test_it_shows_the_task_and_what_every_answer_misses(chromium, written, kind):
    found, unit = found_for(kind), deg if kind == "function" else mm
    with Shown(chromium, written(kind)) as shown:
        assert shown.said == []
        for place, answer in enumerate(found.solutions[:3]):
            chosen = "(k) => { const each = document.querySelector('#answer'); each.value = k; each.dispatchEvent(new Event('change')); }"
            shown(chosen, str(place))
            shown.settle()
            design = shown.state["design"]
            assert {name: answer.machine[name] for name in design} == design
            assert_allclose(numbers(told(shown)), [answer.rms / unit, answer.most / unit], rtol=6e-4)
            assert told(shown).endswith(f"at point {answer.worst}")
        rings = shown("document.querySelectorAll('#mechanism text.wanted').length")
        assert rings == (0 if kind == "function" else len(found.best.strokes))
        drawn = shown("document.querySelectorAll('#curve circle').length")
        assert drawn == 2 + (len(found.best.strokes) if kind == "function" else 0)
        assert shown.said == []


def test_what_is_missed_follows_the_dimensions(chromium, written):
    found = found_for("path")
    best = found.machine
    with Shown(chromium, written("path"), PHONE) as shown:
        for change in ({"OA": best["OA"] + 2 * mm}, {"BAP": best["BAP"] - 3 * deg, "AB": best["AB"] + 1 * mm}):
            shown("(design) => hydrolinkage.set({ design })", change)
            shown.settle()
            machine = best.replaced(**change)
            far = np.sqrt([nearest(machine, point) for point in found.task.points])
            assert_allclose(numbers(told(shown)), [np.sqrt(np.mean(far**2)) / mm, far.max() / mm], rtol=6e-4)
            assert shown("document.querySelector('#answer').value") == "-1"
            shown("() => document.querySelector('#reset').click()")
            shown.settle()
            assert shown("document.querySelector('#answer').value") == "0"
        shown("() => document.querySelector('#language').click()")
        shown.settle()
        assert any(each.startswith("задание: ") for each in shown.told) and shown.said == []


def test_its_sliders_are_what_was_searched(written):
    data, found = data_of(written("path").read_text(encoding="utf-8")), found_for("path")
    names = [data["dims"][place][0] for place in data["shown"]]
    assert names == [each.name for each in found.problem.space.variables]
    ranges = {each[0]: each[2] for each in data["dims"]}
    assert_allclose(
        [ranges[each.name] for each in found.problem.space.variables], [(0.02, 0.06), (0.05, 0.2), (0.02, 0.15), (0, np.pi / 2)]
    )
    left, right, bottom, top = data["scene"]["box"]
    assert left <= found.task.points[:, 0].min() and top >= found.task.points[:, 1].max() and right > left and top > bottom


def test_what_has_no_page_is_said(tmp_path):
    with pytest.raises(DefinitionError, match="leave out at="):
        page(found_for("path"), tmp_path / "a.html", at={"phi": 0.1})
    with pytest.raises(DefinitionError, match=r"ends in \.html"):
        page(found_for("path"), tmp_path / "a.htm")
    with pytest.raises(DefinitionError, match="Column"):
        page(found_for("path"), tmp_path / "a.html", column="nothing")
    assert not [*tmp_path.iterdir()]
