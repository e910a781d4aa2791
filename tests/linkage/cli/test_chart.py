"""`hydrolinkage chart`: printed, as a picture, as files; what it refuses."""

import csv

import pytest

from linkage import export, plot, working_field
from linkage.cli.entry import main
from linkage.pictures.chart_text import ChartText
from linkage.units import g0, unit_system
from tests.laws.test_working_field import Arm, Digger
from tests.members import unpacked

MACHINE = "tests/laws/test_working_field.py:Arm"
AXES = ["--point", "K", "--x", "0.6:2.2m:0.4m", "--y", "-0.4 to 0.8 m by 0.4 m"]


def field(machine=Arm, **options):
    return working_field(machine(), "K", [0.6, 1.0, 1.4, 1.8, 2.2], [-0.4, 0.0, 0.4, 0.8], **options)


def test_chart_is_printed(capsys):
    assert main(["chart", MACHINE, *AXES, "--rule", "ISO 10567"]) == 0
    said = capsys.readouterr().out
    known = field(rule="ISO 10567")
    assert f"{known.load[2, 3] / g0 / 1e3:.2f} A" in said and "87 % of what the cylinders carry" in said
    assert "lift_line 170 bar (relief 200 bar)" in said and "arm_mass hangs at K beside the load" in said
    assert main(["chart", MACHINE, *AXES, "--units", "us"]) == 0
    assert "lb" in capsys.readouterr().out
    assert main(["chart", MACHINE, *AXES, "--language", "ru"]) == 0
    assert "ограничивает" in capsys.readouterr().out


def test_heights_below_the_ground_are_no_options(capsys):
    axes = ["--point", "K", "--x", "0.6:2.2m:0.4m", "--y", "-0.4:0.8m:0.4m"]
    assert main(["chart", MACHINE, *axes]) == 0
    said = capsys.readouterr().out
    assert main(["chart", MACHINE, *AXES]) == 0
    assert capsys.readouterr().out == said


def test_options_say_what_the_function_takes(capsys):
    both = ["--lift", "lifter", "--without", "arm_mass", "--limit", "rated load=4kN", "--along", "1,0", "--hold", "fold=0.9m"]
    assert main(["chart", MACHINE, *AXES, *both]) == 2  # one free stroke cannot give two targets
    assert "take 2 strokes, and lift may move" in capsys.readouterr().err
    assert main(["chart", MACHINE, *AXES, *both[:-2]]) == 0
    assert "without arm_mass" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--x", "0:6m:-1m"], "no step"),
        (["--x", "0:1:2:3"], "from, to and step"),
        (["--x", "six"], "not a value"),
        (["--x", "0:6m:1um"], "Unit"),
        (["--rule", "ISO 1"], "ISO 1"),
        (["--keep", "tilt"], "--keep"),
        (["-o", "chart.doc"], "ends in one of"),
        (["--limit", "rated load=4m"], "force"),
    ],
)
def test_what_the_command_refuses(arguments, words, capsys):
    assert main(["chart", MACHINE, *AXES, *arguments]) == 2
    assert words in capsys.readouterr().err


def test_files_hold_the_numbers(tmp_path):
    found = field(Digger)
    path = export(found, tmp_path / "chart.csv")
    with open(path, encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert len(rows) == found.load.size and float(rows[0]["y [m]"]) == 0.8
    row = next(row for row in rows if row["x [m]"] == "1.8" and row["y [m]"] == "0.4")
    assert float(row["load [t]"]) == pytest.approx(found.load[2, 3] / g0 / 1e3, rel=1e-12)
    assert row["limiter"] == found.limiter[2, 3] and float(row["lift [mm]"]) == pytest.approx(1e3 * found.strokes["lift"][2, 3], rel=1e-12)
    lost = next(row for row in rows if row["limiter"] == "out of reach")
    assert lost["load [t]"] == "" and lost["why"]
    with unit_system("us"):
        assert "load [lb]" in export(found, tmp_path / "us.csv").read_text(encoding="utf-8").splitlines()[0]


def test_workbook_has_the_chart(tmp_path):
    openpyxl = pytest.importorskip("openpyxl")
    found = field(Digger)
    book = openpyxl.load_workbook(export(found, tmp_path / "chart.xlsx"))
    assert book.sheetnames == ["Chart", "Limiters", "Cells"]
    assert book["Chart"].cell(4, 5).value == pytest.approx(found.load[2, 3] / g0 / 1e3, rel=1e-12)
    assert book["Limiters"].cell(4, 5).value == ChartText(found).letters[found.limiter[2, 3]]
    assert book["Cells"].max_row == 1 + found.load.size


@pytest.mark.slow
def test_a_page_is_written_in_the_language_it_begins_with(tmp_path, capsys):
    file = tmp_path / "chart.html"
    assert main(["chart", MACHINE, *AXES, "--language", "ru", "-o", str(file)]) == 0
    assert capsys.readouterr().out == f"{file}\n"
    text = file.read_text(encoding="utf-8")
    assert '<html lang="ru">' in text and '<h1 id="title">Arm: грузо' in unpacked(text, "body")


def test_picture_has_every_load_and_letter():
    found = field(Digger, rule="ISO 14397-1")
    texts = [each.get_text() for each in plot(found).axes[0].texts]
    text = ChartText(found)
    for load, limiter in zip(found.load.ravel(), found.limiter.ravel(), strict=True):
        assert text.load_text(load) in texts and text.letters.get(limiter, "") in texts
    assert any("50 % of what tips it" in each for each in texts) and any("not planar" in each for each in texts)
    assert not any("no supports" in each for each in texts)
