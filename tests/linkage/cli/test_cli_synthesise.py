"""`hydrolinkage synthesise`: what it prints, the files that it writes, and its exit codes."""

import csv

import pytest
from matplotlib.image import imread
from numpy.testing import assert_allclose

from linkage import deg, mm
from linkage.cli import main
from linkage.files import load

TASK = """machine = "four_bar"

[synthesis]
path = { of = "P", points = "points.csv" }
vary = { OA = "20 to 60 mm", CB = "50 to 200 mm", AP = "20 to 150 mm", BAP = "0 to 90 deg" }
starts = 2
round = "1 mm"

[outputs]
machine = "best.toml"
"""


@pytest.fixture
def task(tmp_path, monkeypatch):
    """Return a task's file in a folder of its own."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "task.toml").write_text(TASK, encoding="utf-8")
    (tmp_path / "points.csv").write_text("x [mm],y [mm]\n30,60\n15,70\n0,72\n-15,66\n-22,50\n", encoding="utf-8")
    return tmp_path


def test_it_writes_what_is_asked_for(task, capsys):
    assert (
        main(["synthesise", "task.toml", "--csv", "answers.csv", "--pictures", "seen/here", "--page", "found.html", "--answers", "1"]) == 0
    )
    said = capsys.readouterr().out
    assert "all 5 points in order" in said and "Rounded: OA = " in said
    for name in ("best.toml", "answers.csv", "found.html", "seen/here/task.png"):
        assert (task / name).stat().st_size > 100 and name in said.splitlines()
    first = next(csv.DictReader((task / "answers.csv").read_text(encoding="utf-8").splitlines()))
    assert_allclose(load(task / "best.toml")().dimensions["OA"], round(float(first["OA, mm"])) * mm, atol=1.01 * mm)
    assert 15 * deg < float(first["transmission, deg"]) * deg < 60 * deg
    assert imread(task / "seen/here/task.png").shape[1] > 1000


@pytest.mark.slow
def test_where_nothing_runs_the_exit_code_says_so(task, capsys):
    text = TASK.replace('OA = "20 to 60 mm"', 'OA = "300 to 310 mm"').replace('BAP = "0 to 90 deg"', 'BAP = "0 to 10 deg"')
    (task / "task.toml").write_text(text, encoding="utf-8")
    assert main(["synthesise", "task.toml", "--csv", "answers.csv"]) == 1
    assert "no machine that runs was found" in capsys.readouterr().out
    assert not (task / "answers.csv").exists()


def test_mistakes_are_one_line_each(task, capsys):
    (task / "task.toml").write_text(TASK.replace('of = "P"', 'of = "Q"'), encoding="utf-8")
    assert main(["synthesise", "task.toml"]) == 2
    assert "task.toml: line 4, synthesis.path.of: Point 'Q' is unknown in FourBar" in capsys.readouterr().err
    assert main(["synthesise", "task.toml", "--page", "found.htm"]) == 2
    assert main(["synthesise", "none.toml"]) == 2
