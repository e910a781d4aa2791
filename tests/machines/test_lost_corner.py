"""Lost places: every command goes on over a machine that does not reach a corner of its box, with gaps and one remark that says so."""

import csv
import re
from math import hypot

import numpy as np
import pytest

from linkage import most, pin_force, reachable
from linkage.cli import main
from linkage.cli.settings import overs_of, with_overs
from linkage.motion import Over
from tests.machines.lost_corner import Declared, TailLift

LIFT = "tests.machines.lost_corner:TailLift"
DECLARED = "tests.machines.lost_corner:Declared"
GAPS = r"hydrolinkage: remark: C = Dyad\(D, B\) cannot be assembled at {count} of {total} strokes, .* mm short of DB = .*left empty\."


@pytest.fixture
def said(monkeypatch, capsys, tmp_path):
    """Return a command's exit code, output and complaints; it runs in an empty folder."""
    monkeypatch.chdir(tmp_path)

    def run(text):
        code = main(text.split())
        found = capsys.readouterr()
        return code, found.out, found.err

    return run


def assembled(S1, S2):
    """Return whether the platform's dyad closes, by hand: F by two circles, B on the arm, then DC + BC against DB."""
    EF, AF = 0.620 + 2 * S1, 0.45
    EA = hypot(0.35, 0.55)
    along = (EF**2 - AF**2 + EA**2) / (2 * EA)
    off = (EF**2 - along**2) ** 0.5
    ux, uy = 0.35 / EA, 0.55 / EA
    F = -0.35 + along * ux + off * uy, along * uy - off * ux
    angle = np.arctan2(F[1] - 0.55, F[0]) + np.radians(6)
    B = 0.8 * np.cos(angle), 0.55 + 0.8 * np.sin(angle)
    DB, DC = hypot(B[0] - 0.02, B[1] - 0.85), 0.920 - S2
    return abs(DC - 0.3) <= DB <= DC + 0.3


def test_corner_is_lost_where_the_hand_calculation_says():
    axes = np.linspace(0.0, 0.225, 31), np.linspace(0.0, 0.340, 31)
    grids = dict(zip(("S1", "S2"), np.meshgrid(*axes, indexing="ij"), strict=True))
    by_hand = np.array([[assembled(one, two) for two in axes[1]] for one in axes[0]])
    assert np.array_equal(TailLift().at(unreachable="nan", **grids).reached, by_hand) and 0.05 < 1.0 - by_hand.mean() < 0.4


def rows(path):
    """Return the rows of a CSV file, without its heading."""
    with path.open(newline="", encoding="utf-8") as stream:
        return list(csv.reader(stream))[1:]


@pytest.mark.parametrize(
    ("command", "count", "total"),
    [("table {} --at S2=0.3 --count 5 --csv table.csv", 3, 5),
     pytest.param("export {} -o table.csv --count 5", 5, 25, marks=pytest.mark.slow),
     ("forces {} --at S2=0.3 --count 4 --csv table.csv", 2, 4)],
)
def test_table_has_gaps_where_the_corner_is(said, tmp_path, command, count, total):
    code, _, err = said(command.format(LIFT))
    assert code == 0 and len(err.splitlines()) == 1 and re.fullmatch(GAPS.format(count=count, total=total), err.strip())
    for row in rows(tmp_path / "table.csv"):
        one, two = map(float, row[:2])
        assert any(row[2:]) == assembled(one, two)  # where the load drives a reserve is empty, too


@pytest.mark.parametrize(
    "command",
    [
        'plot {} G_y -o out.png --at S2=0.3', "export {} -o out.svg --at S1=0,0.2 --at S2=0.3",
        *(pytest.param(each, marks=pytest.mark.slow) for each in (
            "plot {} -o out.png --at S1=0,0.2 --at S2=0.3", "export {} -o out.xlsx --at S2=0.3 --count 9",
            "page {} -o out.html --at S2=0.3", "export {} -o out.dxf --at S2=0.3 --poses 7", "animate {} -o out.gif --at S2=0.3 --count 4",
        )),
    ],
)  # fmt: skip
def test_picture_and_file_go_on_with_one_remark(said, tmp_path, command):
    code, out, err = said(command.format(LIFT))
    assert code == 0 and out.startswith("out.") and (tmp_path / out.split()[0].rstrip(":")).stat().st_size > 300
    assert len(err.splitlines()) == 1 and re.fullmatch(GAPS.format(count=r"\d+", total=r"\d+"), err.strip())


@pytest.mark.parametrize("command", ["plot {} -o out.png --at S2=0", "export {} -o out.csv --at S2=0 --count 5", "table {} --at S2=0"])
def test_no_remark_where_nothing_is_lost(said, command):
    code, _, err = said(command.format(LIFT))
    assert code == 0 and not err


@pytest.mark.parametrize(
    "command", ["table {} --at S1=0 --at S2=0.34", "export {} -o out.csv --at S1=0 --at S2=0.34", "draw {} --at S1=0 --at S2=0.3"]
)
def test_nothing_but_lost_places_ends_with_exit_code_2(said, command):
    code, _, err = said(command.format(LIFT))
    assert code == 2 and "cannot be assembled at S1 = 0.0 mm, S2 = 3" in err


@pytest.mark.parametrize("over", [" --over S1=0", pytest.param("", marks=pytest.mark.slow)])
def test_show_says_what_is_lost_and_judges_the_rest(said, over):
    code, out, err = said(f"show {LIFT} --check{over}")
    (line,) = (each.strip() for each in out.splitlines() if each.strip().startswith("FAIL assembly"))
    assert code == 1 and not err and "C = Dyad(D, B)" in line and "161 mm short" in line and "what follows holds for the rest" in line
    assert "at S1 = 0.0 mm, S2 = 340.0 mm" in line and "ok   length lift: " in out


def test_rule_that_says_nothing_does_not_fail_and_is_named(said):
    code, out, err = said("show tests.machines.lost_corner:Silent --check")
    assert code == 0 and "FAIL" not in out and "  --   noise: nobody measured it." in out and "  ok   colour: red." in out
    silent = len(re.findall(r"^  --   ", out, re.MULTILINE))
    assert silent >= 2 and err.startswith(f"hydrolinkage: remark: {silent} rules say nothing. ") and "noise: nobody measured it." in err


@pytest.mark.slow
def test_report_goes_on_and_says_what_is_lost(said, tmp_path):
    code, _, _ = said(f"report {LIFT} -o out.md --at S2=0.3")
    assert code == 0 and "161 mm short" in (tmp_path / "out.md").read_text(encoding="utf-8")


@pytest.mark.slow
def test_limits_tell_the_box_beside_the_strokes(said):
    code, out, err = said(f"limits {LIFT} --check")
    assert code == 1 and not err and "S1: declared 0 to 225 mm" in out and "together: S1 = 0 to 225 mm, S2 = 0 to 340 mm" in out
    assert "16.7 % cannot be assembled, most of all: C = Dyad(D, B) cannot be assembled at S1 = 0.0 mm, S2 = 340.0 mm" in out
    assert "C comes apart, most of all at S1 = 0.0 mm, S2 = 340.0 mm" in out
    assert "the links of F are at least 16.7 deg out of line, at S1 = 225.0 mm, S2 = 0.0 mm" in out


def test_margin_of_a_loop_is_the_angle_between_its_links():
    box = TailLift().at(S1=0.0, S2=0.0).limits().box
    (margin,) = (each for each in box.margins if each.step == "F" and each.kind == "links")
    EF, AF, EA = 0.620 + 2 * 0.225, 0.45, hypot(0.35, 0.55)
    assert margin.clear == pytest.approx(np.pi - np.arccos((EF**2 + AF**2 - EA**2) / (2 * EF * AF)) if EF < AF else
                                         np.arccos((EF**2 + AF**2 - EA**2) / (2 * EF * AF)), rel=1e-9)  # fmt: skip
    assert margin.strokes["S1"] == 0.225 and not margin.is_hole
    assert box.lost == pytest.approx(0.167, abs=0.002) and box.deepest == {"S1": 0.0, "S2": 0.34}


# -- where commands look -----------------------------------------------------------------------------------


@pytest.mark.parametrize("over", ["level", "S2=0:100mm", "S2=0:0.1,S1=0:225mm"])
def test_over_is_named_or_said_by_its_strokes(said, over):
    code, out, _ = said(f"show {DECLARED} --over {over}")
    assert code == 0 and "ok   assembly: it is assembled over S1 = 0 to 225 mm, S2 = 0 to 100 mm." in out


def test_overs_stand_one_after_the_other(said):
    _, out, _ = said(f"show {DECLARED} --over level --over S2=0.05")
    assert "S2 = 0 to 100 mm" in out and "S2 = 50 mm" in out


def test_limits_are_those_of_an_over(said):
    code, out, _ = said(f"limits {DECLARED} --over level")
    assert code == 0 and "together: S1 = 0 to 225 mm, S2 = 0 to 100 mm\n  all of it can be assembled" in out


def test_page_is_of_the_same_design_over_what_is_said():
    design = Declared(BZ=1.5)
    for texts, overs in ((["level"], ["level"]), (["level", "S2=0.05"], ["level", "over_1"]), (["S2=0:0.1"], ["over_1"])):
        found = with_overs(design, overs_of(design, texts))
        assert [each.name for each in found.overs] == overs and found.dimensions == design.dimensions
        assert found.plan.heading == design.plan.heading
    assert with_overs(design, None) is design


@pytest.mark.parametrize("command", ["show", "limits", "forces", "table"])
@pytest.mark.parametrize(
    ("over", "words"),
    [
        ("lifting", "--over lifting: Over 'lifting' is unknown in Declared. Known: level, whole."),
        ("S3=0", "Stroke 'S3' is unknown in --over S3=0. Did you mean S2? Known: S1, S2."),
        ("S1=0,S1=0.1", "S1 stands twice; give it two ends, S1=LOW:HIGH."),
        ("S1=0:0.1:0.2", "one value or two ends are expected"),
        ("S1=", "write a name and a value"),
        ("S1=3parsec", "--over S1: "),
        ("S1=0:300", "S1 = 300 m, and the stroke is 0 to 0.225 m; write 300 * mm"),
        ("S1=5deg", "--over S1: "),
    ],
)
def test_wrong_over_is_refused_in_one_line(said, command, over, words):
    code, _, err = said(f"{command} {DECLARED} --over {over} {'--check' * (command != 'forces')}".rstrip())
    assert code == 2 and words in err.splitlines()[-1] and len(err.splitlines()) <= 2


@pytest.mark.slow
def test_worst_pins_are_those_of_the_judge_with_case_and_place(said):
    _, out, _ = said(f"forces {DECLARED} --over level --count 2")
    (answer,) = Declared().answers([most(pin_force("A"))], over=Declared.level)
    line = next(each for each in out.splitlines() if each.startswith("A "))
    assert f"{answer.value / 1e3:.3f}" in line and "own loads" in line and answer.where.removeprefix("at ") in line
    _, out, _ = said(f"forces {LIFT} --over S2=0:0.1 --count 2")  # the full platform counts where it occurs
    (full,) = TailLift().answers([most(pin_force("A"))], over=Over(S2=(0.0, 0.1)))
    assert full.value == pytest.approx(1.2 * answer.value, rel=1e-9)
    assert f"{full.value / 1e3:.3f}" in next(each for each in out.splitlines() if each.startswith("A ") and "full" in each)
    _, out, _ = said(f"forces {LIFT} --over S2=0:0.1 --count 2 --case plain")
    assert f"{answer.value / 1e3:.3f}" in next(each for each in out.splitlines() if each.startswith("A "))


def test_case_that_does_not_occur_is_refused(said):
    code, _, err = said(f"forces {DECLARED} --over level --case full --count 2")
    assert code == 2 and "the load case full does not occur over level, where there are plain." in err


def test_lost_corner_that_is_part_of_the_machine_is_told_and_kept():
    (answer,) = Declared().answers([reachable])
    assert answer.ok is True and answer.lost.share == pytest.approx(0.167, abs=0.002)
    (answer,) = TailLift().answers([reachable])
    assert answer.ok is False
