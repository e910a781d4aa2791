"""The command as a user meets it: its output, one line for every mistake, its exit codes, what it loads."""

import csv
import io
import json
import os
import re
import signal
import subprocess
import sys
import textwrap
from argparse import Namespace
from functools import partial
from importlib.metadata import EntryPoint

import numpy as np
import pytest

from linkage import plugins
from linkage.cli import Command, listing, main, option
from linkage.cli import command as progress
from linkage.cli import entry as commands
from linkage.cli.machines import find
from linkage.cli.settings import judged_over
from linkage.errors import did_you_mean
from linkage.shown import text_columns
from tests.for_all import first_daily
from tests.members import unpacked

OWN = '''
    """A machine of a user."""
    from linkage import *

    class Lever(Mechanism):
        """A lever on a cylinder."""

        S = Stroke(0.5, 0.7)
        A = Ground(0.0, 0.0)
        O = Ground(0.6, 0.0)
        B = Dyad(A, O, AB=S, OB=0.2, side=RIGHT)
        turn = angle(O, B)
'''


@pytest.fixture
def own(tmp_path, monkeypatch):
    """Return a folder, made the current one, with a user's own file."""
    (tmp_path / "lever.py").write_text(textwrap.dedent(OWN), encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "path", [*sys.path])
    return tmp_path


@pytest.fixture
def said(capsys):
    """Return a function that runs the command and gives its exit code, output and complaints."""

    def run(*arguments):
        code = main(list(arguments))
        return code, *capsys.readouterr()

    return run


def shell(*arguments, **options):
    return subprocess.Popen([sys.executable, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, **options)


# -- what it prints ----------------------------------------------------------------------------------------


def test_list_names_the_installed_machines(said):
    code, out, err = said("list")
    assert (code, err) == (0, "")
    assert {line.split()[0] for line in out.splitlines() if line} >= {"mower_lift", "three_point_hitch"}
    assert "Cylinder AB turns the lift arm OBC" in out
    assert max(map(len, out.splitlines())) <= 100
    assert "Did you mean hitch_category_1 or hitch_category_2 or three_point_hitch?" in said("show", "hitchh")[2]


def test_show_says_what_an_engineer_asks(said):
    code, out, err = said("show", "mower_lift")
    assert (code, err) == (0, "")
    assert any(map(str.isdigit, "".join(out.splitlines()[:3])))  # numbers first, prose last
    assert max(map(len, out.partition("Verdict\n")[0].splitlines())) <= 100
    rules = out.partition("Verdict\n")[2].partition("\n\n")[0].splitlines()
    assert rules and all(re.match(r"  \S", each) for each in rules)  # where no terminal is, a rule a line
    assert out.index("Verdict") < out.index("About it") < out.index("The source contradicts itself")
    for words in (
        "The source contradicts itself", "S 550 to 800 mm", "OB 175 mm", "BOG 110.425 deg", "weight 900 kgf",
        "p_max 155 kgf/cm2", "lift.rod 45 mm", "frame A O", "O B G", "cylinder lift: A B", "Gruebler count 1",
        "B = Dyad(A, O, AB=S, OB=0.175, side=RIGHT)", "lift = Cylinder(A, B, bore=bore, rod=45 mm)",
        "too weak from S = 550.0 to 566.0 mm. It needs 161.1 kgf/cm2",
    ):  # fmt: skip
        assert words in " ".join(out.split())


def test_setting_changes_the_design_and_the_verdict(said):
    code, out, _ = said("show", "mower_lift", "--set", "p_max=200 kgf/cm2", "--set", "OB=18cm")
    assert code == 0
    assert "OB 180 mm" in " ".join(out.split())
    assert "ok   lifting: at 200 kgf/cm2 the least reserve is 1." in out


def test_show_prints_the_construction_as_it_is_set(said):
    _, out, _ = said("show", "three_point_hitch", "--set", "OB=320mm", "--set", "M=0.22,0.95", "--set", "KFG=70deg")
    assert "B = Dyad(A, O, AB=L0 + S, OB=0.32, side=RIGHT)" in out
    assert "M = Ground(0.22, 0.95)" in out
    assert "KFG=70 * deg" in out


def test_table_is_the_worksheets(said):
    code, out, err = said("table", "mower_lift", "--count", "6")
    heading, first, *others = out.splitlines()
    assert (code, err, len(others)) == (0, "", 5)
    assert heading.split()[:2] == ["S,", "m"]
    assert first.split()[0] == "0.5500" and first.split()[-1] == "0.963"


def test_table_of_chosen_columns_and_strokes(said):
    _, out, _ = said("table", "mower_lift", "kz", "I", "--at", "S=0.55,800mm")
    assert [" ".join(line.split()) for line in out.splitlines()] == ["S, m kz I", "0.5500 0.963 7.262", "0.8000 2.781 2.513"]


@pytest.mark.parametrize("arguments", [
    "mower_lift --at S=0.55,800mm kz I", "mower_lift kz --at S=0.55,800mm I", "--at S=0.55,800mm mower_lift kz I",
    "mower_lift --at S=0.55,800mm -- kz I",
])  # fmt: skip
def test_columns_stand_anywhere_between_options(said, arguments):
    expected = said("table", "mower_lift", "kz", "I", "--at", "S=0.55,800mm")
    assert expected[0] == 0 and said("table", *arguments.split()) == expected


@pytest.mark.slow
def test_a_plots_columns_stand_behind_options_too(said, tmp_path):
    file, drawn = str(tmp_path / "lift.svg"), []
    for arguments in (("kz", "-o", file, "--count", "11"), ("-o", file, "--count", "11", "kz"), ("-o", file, "--count", "11", "I")):
        assert said("plot", "mower_lift", *arguments)[0] == 0
        drawn.append(re.findall(r' d="([^"]*)"', (tmp_path / "lift.svg").read_text()))
    before, behind, other = drawn
    assert before == behind != other


def test_csv_has_full_precision(said, tmp_path):
    _, out, _ = said("table", "three_point_hitch", "I", "--csv", "-", "--count", "3")
    header, *rows = csv.reader(io.StringIO(out, newline=""))
    assert header == ["S, m", "I"]
    assert [float(row[0]) for row in rows] == [0.0, 0.125, 0.25]
    assert float(rows[0][1]) == pytest.approx(3.0389653, abs=5e-8)
    assert len(rows[0][1]) > 12
    code, out, _ = said("table", "three_point_hitch", "I", "--csv", str(tmp_path / "i.csv"), "--count", "3")
    assert (code, out) == (0, f"{tmp_path / 'i.csv'}: 3 rows\n")
    assert (tmp_path / "i.csv").read_bytes().startswith(b'"S, m",I\r\n0.0,3.03896')


def test_point_is_set_whole_or_by_coordinate(said):
    whole = said("table", "three_point_hitch", "tilt", "--at", "S=0", "--set", "M=0.22,950mm")
    part = said("table", "three_point_hitch", "tilt", "--at", "S=0", "--set", "M.y=0.95")
    assert whole == part
    assert whole[1].split()[-1] == "2.463"


@first_daily(2, "name", ["lever.py", "lever.py:Lever", "./lever.py", "lever:Lever"])
def test_machine_of_a_users_own(said, own, name):
    code, out, err = said("table", name, "turn", "--count", "2")
    assert (code, err) == (0, "")
    assert len(out.splitlines()) == 3


TWO = (
    "from linkage import *\nclass Crane(Mechanism):\n    a, b = Stroke(0.0, 1.0), Stroke(0.0, 2.0)\n    O = Ground(0, 0)\n"
    "    P = Crank(O, OP=1.0, angle=a)\n    Q = Crank(P, PQ=0.5, angle=b)\n"
)


def strokes_in(out):
    """Return the two strokes of each row of a table in CSV [deg]."""
    return [(round(float(a), 6), round(float(b), 6)) for a, b, *_ in list(csv.reader(io.StringIO(out)))[1:]]


@pytest.mark.parametrize(("options", "rows"), [
    ("--count 3", [(0.0, 57.29578), (28.64789, 57.29578), (57.29578, 57.29578)]),  # the first runs, the other in its middle
    ("--count 3 --at b=90deg", [(0.0, 90.0), (28.64789, 90.0), (57.29578, 90.0)]),
    ("--at b=90deg --every 20deg", [(0.0, 90.0), (20.0, 90.0), (40.0, 90.0), (57.29578, 90.0)]),
    ("--at a=30deg --count 2", [(30.0, 0.0), (30.0, 114.591559)]),
    ("--at a=1deg,b=3deg,4deg", [(1.0, 3.0), (1.0, 4.0)]),
    ("--at b=10deg,20deg", [(28.64789, 10.0), (28.64789, 20.0)]),
    ("--at a=1deg,2deg --at b=3deg,4deg", [(1.0, 3.0), (1.0, 4.0), (2.0, 3.0), (2.0, 4.0)]),
])  # fmt: skip
def test_a_table_of_two_strokes_runs_along_one(said, own, options, rows):
    (own / "crane.py").write_text(TWO)
    code, out, _ = said("table", "crane.py", "--csv", "-", *options.split())
    found = strokes_in(out)
    assert code == 0 and len(found) == len(rows)
    np.testing.assert_allclose(found, rows, atol=2e-6)


def test_a_table_runs_along_the_machines_path(said, own):
    path = "    way = Over.path(a=[0.2, 0.8, 0.8], b=[0.0, 0.0, 1.0])\n"
    (own / "crane.py").write_text(TWO + path)
    (own / "two.py").write_text(TWO + path + path.replace("way", "back"))
    _, out, _ = said("table", "crane.py", "--csv", "-", "--count", "5")
    expected = np.degrees([[0.2, 0.0], [0.5, 0.0], [0.8, 0.0], [0.8, 0.5], [0.8, 1.0]])
    np.testing.assert_allclose(strokes_in(out), expected, atol=2e-6)
    assert said("table", "two.py", "--csv", "-", "--count", "5", "--over", "back")[1] == out
    rows = list(csv.reader(io.StringIO(said("table", "two.py", "--csv", "-", "--count", "3")[1])))
    assert rows[0][:2] == ["run", "a, deg"] and [row[0] for row in rows[1:]] == ["over way"] * 3 + ["over back"] * 3
    printed = said("table", "two.py", "--count", "3")[1]
    assert printed.count("a, deg") == 2 and "over back: " in printed
    dagger = said("table", "crane.py", "--at", "a=0.2,0.5", "--at", "b=0.0,0.9")[1].splitlines()
    assert [line.endswith("†") for line in dagger[1:5]] == [False, True, False, True] and dagger[-1].startswith("† This pose")
    loads = "    load = Weight(Q, mass=5)\n    full = LoadCase(scale=dict(load=2.0))\n"
    (own / "full.py").write_text(TWO + loads + path.replace("])", "], cases=['full'])"))
    for case, ends in (([], True), (["--case", "full"], False)):  # judged in another load case than the one that is shown
        lines = said("table", "full.py", "--at", "a=0.2,0.5", "--at", "b=0.0", *case)[1].splitlines()
        assert [line.endswith("†") for line in lines if line.lstrip()[:1].isdigit()] == [ends, ends]
    assert strokes_in(said("table", "crane.py", "--csv", "-", "--at", "a=0.3")[1])[0] == (17.188734, 0.0)
    code, _, complaint = said("table", "mower_lift", "--every", "100")
    assert code == 2 and "this step is longer than the stroke S; write its unit" in complaint
    code, _, complaint = said("table", "crane.py", "--every", "1deg")
    assert code == 2 and "the rows run along a path; give --count, or run one stroke, such as --over a=0:1." in complaint
    rows = strokes_in(said("table", "crane.py", "--csv", "-", "--every", "0.5rad", "--over", "a=0:1")[1])
    assert [a for a, _ in rows] == [0.0, 28.64789, 57.29578]


def test_a_judgement_looks_at_all_that_is_left_open(own):
    """The table shows one run; what is judged is the box of all that --at does not hold."""
    (own / "crane.py").write_text(TWO)
    machine = find("crane.py")()
    for strokes, ends in (["a=0.5"], ([0.5, 0.5], [0.0, 2.0])), (["a=0.1,0.4"], ([0.1, 0.4], [0.0, 2.0])):
        (motion,) = judged_over(machine, Namespace(over=[], strokes=strokes, count=5))
        assert [[values.min(), values.max()] for values in motion.strokes.values()] == list(ends)
    assert judged_over(machine, Namespace(over=[], strokes=[], count=5)) is None


def test_columns_are_listed_behind_an_option(said):
    expected = said("table", "mower_lift", "kz", "I", "--at", "S=0.55,800mm")
    for options in (["--columns", "kz,I"], ["--columns=kz", "--columns", "I"], ["kz", "--columns", " I "]):
        assert said("table", "mower_lift", "--at", "S=0.55,800mm", *options) == expected
    assert "'least_of(kz,I)'" in said("table", "mower_lift", "--columns", "least_of(kz,I)")[2]  # no comma inside a call parts names


def test_rows_are_a_step_apart(said):
    _, out, _ = said("table", "three_point_hitch", "I", "--every", "60mm", "--csv", "-")
    assert [float(line.split(",")[0]) for line in out.splitlines()[1:]] == pytest.approx([0.0, 0.06, 0.12, 0.18, 0.24, 0.25])
    _, out, _ = said("table", "three_point_hitch", "I", "--every", "125mm", "--csv", "-")
    assert [float(line.split(",")[0]) for line in out.splitlines()[1:]] == pytest.approx([0.0, 0.125, 0.25])
    for wrong in ("0", "-5mm", "1e-12"):
        code, _, complaint = said("table", "three_point_hitch", f"--every={wrong}")
        assert code == 2 and "a step of S is expected" in complaint
    code, _, complaint = said("table", "three_point_hitch", "--every", "5mm", "--at", "S=0.1")
    assert code == 2 and "no stroke runs from end to end here" in complaint


def test_equations_are_printed_when_asked(said):
    code, out, _ = said("show", "mower_lift", "--equations")
    assert code == 0
    assert "Equations" in out and "(1)" in out


def test_equations_are_numbered_differentiated_and_filled_in(said):
    _, out, _ = said("show", "mower_lift", "--equations", "--start", "4", "--ratio", "FI3", "--ratio", "G", "--forces", "--at", "S=550mm")
    assert "  (4)  AO = O - A = " in out
    assert "dFI3/dS = dFIS/dS = 6.6806 rad/m" in out
    assert "pd = F/SS = 79370.9/0.00502655 = 1.57903e+07 Pa = 161.017 kgf/cm2" in out
    _, numbers, _ = said("show", "mower_lift", "--equations", "--numbers")
    assert "FI3 = FI0 + FIS + 180 deg = 7.68672 deg + 45.648 deg + 180 deg = 233.335 deg" in numbers and "Q_S" not in numbers


def test_equations_as_latex_stand_alone(said):
    code, out, _ = said("show", "three_point_hitch", "--equations", "--latex", "--start", "4", "--ratio", "G", "--wrt", "S")
    assert code == 0
    assert out.startswith(r"\begin{align*}") and out.endswith("\\end{align}\n")
    assert r"\tag{4}" in out and r"I_{G} &= \frac{dG_{y}}{dS}" in out


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--start", "4"], "--start says how equations are printed; say --equations too."),
        (["--latex"], "--latex says how equations are printed; say --equations too."),
        (["--equations", "--latex", "--numbers"], "--latex prints symbols, not numbers; leave out --numbers"),
        (["--equations", "--start", "x"], "argument --start: 'x' is not a count; give a whole number from 1 on"),
        (["--equations", "--ratio", "Z"], "Point or output 'Z' is unknown in MowerLift."),
        (["--equations", "--at", "S=0.6,0.7"], "--at S=0.6,0.7: numbers are filled in at one pose; give one value."),
        (["--equations", "--at", "T=0.6"], "Stroke 'T' is unknown in MowerLift. Known: S."),
        (["--equations", "--at", "S=6"], "B = Dyad"),
    ],
)  # fmt: skip
def test_equations_that_cannot_be_printed_are_refused(said, options, words):
    code, _, complaint = said("show", "mower_lift", *options)
    assert code == 2 and words in complaint


def test_a_users_machine_with_a_load_shows_the_force_of_its_drive(said, own):
    with (own / "lever.py").open("a", encoding="utf-8") as file:
        file.write("    load = Weight(B, mass=100)\n")
    _, out, _ = said("table", "lever.py", "--count", "2")
    assert out.splitlines()[0].endswith("  drive force, kN")
    assert said("plot", "lever.py", "drive force", "-o", "force.svg", "--count", "3") == (0, "force.svg\n", "")


def test_a_users_cylinder_shows_its_thrust_and_its_pressure(said, own):
    members = "    load = Weight(B, mass=100)\n    lift = Cylinder(A, B, bore=0.063, rod=0.040)\n"
    (own / "lever.py").write_text(f"from hydraulics import Cylinder\n{textwrap.dedent(OWN)}{members}", encoding="utf-8")
    _, out, _ = said("table", "lever.py", "thrust", "pressure", "--count", "2", "--csv", "-")
    (*_, thrust, pressure), *rows = csv.reader(io.StringIO(out))
    assert (thrust, pressure) == ("thrust, kN", "pressure, bar")
    assert len(rows) == 2
    for row in rows:
        pushed = max(float(row[-2]), 0.0) * 1e3 / (np.pi / 4 * 0.063**2)
        assert float(row[-1]) == pytest.approx(pushed / 1e5, rel=1e-12)


# -- pictures ----------------------------------------------------------------------------------------------

MAGIC = {".png": b"\x89PNG", ".svg": b"<?xml", ".pdf": b"%PDF", ".gif": b"GIF89a"}


@first_daily(1, "suffix", [".pdf", ".png", ".svg"])
def test_plot_writes_the_format_of_the_name(said, tmp_path, suffix):
    file = tmp_path / f"curves{suffix}"
    assert said("plot", "mower_lift", "I", "kz", "-o", str(file), "--count", "5") == (0, f"{file}\n", "")
    assert file.read_bytes().startswith(MAGIC[suffix])


@pytest.mark.slow
def test_draw_draws_the_machine_under_its_name(said, own):
    assert said("draw", "lever.py") == (0, "Lever.png\n", "")
    assert said("draw", "mower_lift", "--at", "S=0.6,0.7", "--path", "B") == (0, "mower_lift.png\n", "")
    assert {file.name for file in own.glob("*.png")} == {"Lever.png", "mower_lift.png"}


@first_daily(0, "options", ["--forces --poles", "--on OB --path B --at S=0.7"])
def test_what_is_laid_over_a_drawing(said, own, options):
    """Options draw what the call draws: the same picture as `draw(...)` with its keyword."""
    from linkage import draw
    from mechanisms.mower_lift import MowerLift

    body = next(str(each).replace(" ", "") for each in MowerLift().links if "B" in str(each))
    both = {"forces": True, "pole": True, "path": ["G"]}, {"forces": body, "path": ["B"], "at": {"S": [0.7]}}
    draw(MowerLift(), **both["--on" in options]).savefig("call.svg")
    assert said("draw", "mower_lift", *options.replace("OB", body).split(), "-o", "command.svg") == (0, "command.svg\n", "")
    lines = [re.findall(r' d="([^"]*)"', (own / name).read_text()) for name in ("call.svg", "command.svg")]
    assert lines[0] == lines[1]


@pytest.mark.slow
def test_plot_without_columns_draws_what_the_machine_is_about(said, own):
    assert said("plot", "three_point_hitch", "-o", "own.svg", "--count", "11")[:2] == (0, "own.svg\n")
    assert said("plot", "three_point_hitch", "capacity", "-o", "named.svg", "--count", "11")[:2] == (0, "named.svg\n")
    own_lines, named = (re.findall(r' d="([^"]*)"', (own / name).read_text()) for name in ("own.svg", "named.svg"))
    assert own_lines == named


def test_animation_is_written_silently_in_a_pipe(said, own):
    assert said("animate", "lever.py", "-o", "lever.gif", "--count", "3", "--column", "turn") == (0, "lever.gif\n", "")
    assert (own / "lever.gif").read_bytes().startswith(MAGIC[".gif"])


@pytest.mark.slow
def test_an_animation_holds_a_stroke_or_runs_between_two_values(said, own):
    code, out, _ = said("animate", "pantograph", "-o", "drawn.html", "--count", "3", "--at", "Y=50mm", "--at", "X=0.15,250mm")
    assert (code, out) == (0, "drawn.html\n")
    text = (own / "drawn.html").read_text(encoding="utf-8")
    strokes = {each["name"]: each for each in json.loads(unpacked(text, "data"))["strokes"]}
    assert strokes["Y"]["at"] == 0.05 and (strokes["X"]["start"], strokes["X"]["end"]) == (0.15, 0.25)


@pytest.mark.slow
def test_a_curve_is_drawn_over_one_stroke_the_others_held(said, own):
    assert said("plot", "front_loader", "boom", "--at", "lift=0.1", "-o", "boom.svg")[:2] == (0, "boom.svg\n")
    assert "<!-- Front loader at lift = 100 mm -->" in (own / "boom.svg").read_text(encoding="utf-8")
    assert said("plot", "front_loader", "boom", "-o", "boom.svg")[0] == 0


# -- mistakes ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ("table mower_lif", "Did you mean mower_lift?"),
        ("tabel mower_lift", "Did you mean table?"),
        ("table mower_lift --set OBB=1", "Did you mean OB?"),
        ("export mower_lift -o lift.xlsx --over S=0.6:0.7", "a workbook follows its dimensions; hold strokes by --at, S=0.1,0.6"),
        ("table mower_lift --set OB=300", "--set OB=300: without a unit this is 300000 mm in SI, where MowerLift has 175"),
        ("table mower_lift --set OB=18deg", "--set OB: '18deg' is"),
        ("table mower_lift --set weight=3mm", "value of kind force is wanted"),
        ("table three_point_hitch --set L0=3bar", "value of kind length is wanted"),
        ("table three_point_hitch --set AB=3", "AB follows L0 + S"),
        ("table three_point_hitch --set M=0.22", "a point takes two coordinates"),
        ("table three_point_hitch --set M.z=0.22", "'M.z' is unknown"),
        ("table mower_lift --set OB=0,18", "'0,18': decimals are written with a point, '0.18'"),
        ("table mower_lift --set OB=18,5mm", "'18.5mm'"),
        ("table three_point_hitch --set M=0,22,0,95", "a point takes two coordinates, such as M=0.22,950mm; decimals are"),
        ("table mower_lift --set OB=long", "'long' is not a value"),
        ("table mower_lift --set OB=18furlong", "Unit 'furlong' is unknown"),
        ("table mower_lift --set OB=-18mm", "is negative"),
        ("table mower_lift --set OB", "write a name and a value"),
        ("table mower_lift --set S=0.6", "S is a stroke of MowerLift"),
        ("table mower_lift --set k_m=1.5", "above 1"),
        ("table mower_lift --set OB=2m", "cannot be assembled at 11 of 11 strokes"),
        ("plot mower_lift --set OB=2m", "cannot be assembled"),
        ("draw mower_lift --at S=3", "cannot be assembled at S = 3"),
        ("animate mower_lift -o x.gif --set OB=2m", "cannot be assembled"),
        ("table mower_lift --at S=0.83293", "cannot be assembled"),
        ("table mower_lift --at T=0.6", "Stroke 'T' is unknown"),
        ("table mower_lift --at S=3deg", "--at S: '3deg' is"),
        ("table mower_lift kzz", "Did you mean kz?"),
        ("plot mower_lift kzz", "Did you mean kz?"),
        ("plot mower_lift G", "G is a point; `draw --path G` draws its path"),
        ("plot mower_lift S", "there is no column to draw over S; name a result"),
        ("draw mower_lift --path W", "Point 'W' is unknown"),
        ("plot mower_lift -o lift.jpg", ".png, .svg, .pdf"),
        ("draw mower_lift -o lift.jpg", ".png, .svg, .pdf"),
        ("draw mower_lift --case full", "--case and --direction are of forces"),
        ("draw mower_lift --forces --on OB", "give one of them"),
        ("plot mower_lift -o nowhere/lift.png", "folder nowhere is not there"),
        ("animate mower_lift -o lift.avi", ".gif, .mp4, .html"),
        ("animate mower_lift -o lift.gif --column kzz", "Did you mean kz?"),
        ("animate mower_lift", "required: -o"),
        ("animate mower_lift -o x.gif --at S=0.6", "every stroke is held, so that nothing moves"),
        ("animate mower_lift -o x.gif --at T=0.6", "Stroke 'T' is unknown"),
        ("show bare.py", "Bare declares no points"),
        ("table mower_lift --csv nowhere/lift.csv", "nowhere/lift.csv: the folder nowhere is not there; make it first"),
        ("table mower_lift --count 0", "'0' is not a count"),
        ("table mower_lift --count many", "'many' is not a count"),
        ("table mower_lift --cuont 3", "unrecognized arguments: --cuont"),
        ("table mower_lift kz --count 3 --cuont 3 Fi", "unrecognized arguments: --cuont 3 Fi"),
        ("table mower_lift --count 3 kzz", "Did you mean kz?"),
        ("show mower_lift --case full", "unrecognized arguments: --case full; --case is of"),
        ("show mower_lift --set OB=180mm kz", "unrecognized arguments: kz"),
        ("save mower_lift --set OB=180mm lift.toml kz", "unrecognized arguments: kz"),
        ("table", "required: NAME"),
        ("table nothing.py", "nothing.py: there is no such file"),
        ("table lever.py:Levver", "Did you mean Lever?"),
        ("table lever:angle", "is not a class of Mechanism"),
        ("table no_module_here:Class", "No module named 'no_module_here'"),
        ("table empty.py", "holds no machine"),
        ("table two.py", "say two.py:Class, one of One, Two"),
        ("table broken.py", "broken.py, line 2: "),
        ("table failing.py", "ZeroDivisionError: division by zero"),
        ("table slip.py", "NameError: name 'Grond' is not defined (slip.py, line 3). Did you mean Ground?"),
        ("table other.py", "module 'linkage' has no attribute 'Mechanisms' (other.py, line 2). Did you mean Mechanism?"),
        ("table inner.py", "Inner.columns(motion) raises NameError: name 'motoin' is not defined (inner.py, line 4); mend it there. Did"),
        ("table wrong.py", "wrong.py cannot be loaded: Name 'A' is unknown in Wrong.B. Known: O. (wrong.py, line 4)"),
    ],
)
def test_mistake_is_one_line_and_exit_code_2(said, own, arguments, words):
    (own / "empty.py").write_text("")
    (own / "two.py").write_text("from linkage import *\nclass One(Mechanism): pass\nclass Two(Mechanism): pass\n")
    (own / "bare.py").write_text("from linkage import *\nclass Bare(Mechanism): pass\n")
    (own / "broken.py").write_text("from linkage import *\nclass Lever(\n")
    (own / "failing.py").write_text("1 / 0\n")
    (own / "slip.py").write_text("from linkage import *\nclass Slip(Mechanism):\n    O = Grond(0, 0)\n")
    (own / "other.py").write_text("import linkage\nclass Other(linkage.Mechanisms): pass\n")
    inner = "from lever import *\nclass Inner(Lever):\n    def columns(self, motion):\n        return motoin\n"
    (own / "inner.py").write_text(inner)
    wrong = 'from linkage import *\nclass Wrong(Mechanism):\n    O = Ground(0, 0)\n    B = Dyad("A", "O", AB=1.0, OB=1.0, side=LEFT)\n'
    (own / "wrong.py").write_text(wrong)
    code, _, err = said(*arguments.split())
    assert code == 2
    assert err.startswith("hydrolinkage: ") and err.count("\n") == 1
    assert words in err.replace(f"{own}/", "")


def test_a_heading_of_several_members_is_told_with_each_of_them():
    names = ["S", "thrust lift", "pressure lift", "pressure tilt", "drive force S"]
    for given in ("pressure", "presure"):
        assert did_you_mean(given, names) == " Did you mean pressure lift or pressure tilt?"
    assert did_you_mean("pressure tlt", names) == " Did you mean pressure tilt?"


def test_two_pins_in_one_text_are_two():
    plain, quoted = ["import", "a.dxf", "--cylinder", "A", "B=300mm"], ["import", "a.dxf", "--cylinder", "A B=300mm"]
    assert commands.rearranged(quoted) == commands.rearranged(plain) == plain


def test_ratio_at_a_dead_point_is_refused_in_one_line(said):
    reach = float(np.hypot(0.652, 0.088)) + 0.175
    code, _, err = said("table", "mower_lift", "--at", f"S={reach!r}")
    assert code == 2
    assert "dead point" in err and err.count("\n") == 1


def test_ratio_near_a_dead_point_is_warned_of_in_one_line(said):
    reach = float(np.hypot(0.652, 0.088)) + 0.175
    code, out, err = said("table", "mower_lift", "--at", f"S={reach - 1e-10!r}")
    assert code == 0
    assert all(line.startswith("hydrolinkage: warning: ") and "near a dead point" in line for line in err.splitlines())
    assert err and out


def test_nothing_asked_shows_the_help(said):
    code, out, err = said()
    assert (code, out) == (2, "")
    assert all(name in err for name in ("list", "show", "table", "draw", "plot", "animate"))


def test_help_and_version_are_no_mistakes(said):
    assert said("table", "--help")[0] == 0
    code, out, _ = said("--version")
    assert code == 0 and out.startswith("hydrolinkage ")


def test_more_poses_than_a_command_runs_are_refused(said):
    code, _, err = said("table", "mower_lift", "--count", str(10**6 + 1))
    assert code == 2
    assert "lower --count" in err


# -- other packages ----------------------------------------------------------------------------------------


@Command("weigh", "the weight of a machine", option("machine"))
def weigh(options):
    print(f"{options.machine} weighs")
    return 3


@pytest.fixture
def plugged(monkeypatch):
    """Let commands and machines be installed, one of each broken."""
    installed = {
        plugins.COMMANDS: {"weigh": f"{__name__}:weigh", "burn": "no_package:Burn", "old": "linkage.cli.command:Command"},
        plugins.MACHINES: {"good": "mechanisms.mower_lift:MowerLift", "bad": "no_package:Bad"},
    }
    entries = {group: {name: EntryPoint(name, value, group) for name, value in each.items()} for group, each in installed.items()}
    monkeypatch.setitem(sys.modules, __name__, sys.modules.get(__name__) or sys.modules[weigh.run.__module__])
    monkeypatch.setattr(plugins, "entry_points", lambda group: entries[group])


def test_command_of_another_package(said, plugged):
    assert said("weigh", "it") == (3, "it weighs\n", "")
    code, out, err = said("old", "it")
    assert (code, out) == (2, "") and "The command old" in err and "write a function under @Command" in err
    code, _, err = said("burn")
    assert code == 2 and "The command burn (no_package:Burn) cannot be loaded" in err
    code, out, err = said("--help")
    assert code == 0 and "the weight of a machine" in out
    assert err.startswith("hydrolinkage: warning: The command burn") or "\nhydrolinkage: warning: The command burn" in err


def test_broken_machine_of_another_package_does_not_hide_the_others(said, plugged):
    code, out, err = said("list")
    assert code == 0 and "\n  good  " in out
    assert err.startswith("hydrolinkage: warning: The machine bad") and err.count("\n") == 1
    assert said("show", "bad")[0] == 2


def test_nothing_installed_is_said(said, monkeypatch):
    monkeypatch.setattr(listing, "registered", dict)
    code, _, err = said("list")
    assert code == 2 and "install the package" in err


def test_rows_are_lined_up():
    assert text_columns([("a", "1", ""), ("bcd", "20", "x")]) == "a    1\nbcd  20  x" and text_columns([]) == ""


# -- as a process ------------------------------------------------------------------------------------------


def test_numbers_load_nothing_heavy():
    program = (
        "import sys; from linkage.cli import main; main(['show', 'mower_lift']); main(['table', 'three_point_hitch', '--csv', '-']);"
        "print('loaded', *sorted({name.partition('.')[0] for name in sys.modules}))"
    )
    done = shell("-c", program, text=True)
    out, err = done.communicate()
    loaded = set(out[out.rindex("loaded") :].split())
    assert (done.returncode, err) == (0, "")
    assert "numpy" in loaded
    assert not loaded & {"matplotlib", "sympy", "scipy", "networkx", "rich", "pydantic", "PIL", "numba"}


def test_list_loads_no_machine():
    """NumPy comes after the number of its threads is set: what users set counts, else one."""
    program = (
        "import os, sys; os.environ.pop('OMP_NUM_THREADS', None); from linkage.cli import main; sys.argv = ['hydrolinkage', 'list'];"
        "main(); assert os.environ['OMP_NUM_THREADS'] == '1'; print('loaded', *sys.modules)"
    )
    done = shell("-c", program, text=True)
    out, err = done.communicate()
    assert (done.returncode, err) == (0, "") and "three_point_hitch" in out
    loaded = set(out[out.rindex("loaded") :].split())
    assert not [name for name in loaded if name.startswith(("mechanisms.", "hydraulics"))]
    assert not loaded & {"linkage.mechanism", "numpy", "matplotlib", "sympy", "scipy", "networkx", "rich", "pydantic", "PIL", "numba"}


@pytest.mark.parametrize("source", ['"""It."""\nHitch = type("Hitch", (), {"__doc__": "Made by a call."})\n', "Hitch = 1 +\n", None])
def test_first_line_that_no_source_says_is_none(tmp_path, monkeypatch, source):
    if source is not None:
        (tmp_path / "strange.py").write_text(source, encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    assert listing.class_node("strange", "Hitch") is None
    assert "strange" not in sys.modules


def test_first_line_follows_a_class_that_is_handed_on(tmp_path, monkeypatch):
    (tmp_path / "handing").mkdir()
    (tmp_path / "handing" / "__init__.py").write_text("from .inner import Far as Near\nraise SystemExit\n", encoding="utf-8")
    (tmp_path / "handing" / "inner.py").write_text('class Far:\n    """What it is.\n\n    More."""\n', encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    assert listing.first_line(EntryPoint("near", "handing:Near", plugins.MACHINES)) == "What it is."


def test_module_is_the_command():
    done = shell("-m", "linkage", "tabel", text=True)
    out, err = done.communicate()
    assert (done.returncode, out) == (2, "")
    assert err.startswith("hydrolinkage: Command 'tabel' is unknown.") and err.count("\n") == 1


@first_daily(0, "form", [["--csv", "-"], []])
def test_closed_pipe_is_silent(form):
    running = shell("-m", "linkage", "table", "mower_lift", "I", "--count", "20000", *form)
    assert running.stdout.readline()
    running.stdout.close()
    assert running.wait() == 141
    assert running.stderr.read() == b""
    running.stderr.close()


def test_interrupt_is_130(own):
    (own / "slow.py").write_text(
        "import time\nfrom linkage import *\nprint('ready', flush=True)\ntime.sleep(60)\nclass Slow(Mechanism): pass\n", encoding="utf-8"
    )
    paths = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    hearing = partial(signal.signal, signal.SIGINT, signal.SIG_DFL)  # ignored where the tests were started in the background
    running = shell("-m", "linkage", "show", "slow.py", env=paths, preexec_fn=hearing)
    assert running.stdout.readline() == b"ready\n"
    running.send_signal(signal.SIGINT)
    _, err = running.communicate()
    assert running.returncode == 130
    assert b"Traceback" not in err


class Terminal(io.StringIO):
    """A stream that is a terminal."""

    def isatty(self):
        return True


def test_progress_is_drawn_on_a_terminal_only(monkeypatch):
    with progress.progress_bar("working") as report:
        assert report is None
    monkeypatch.setattr(sys, "stderr", Terminal())
    with progress.progress_bar("working") as report:
        report(1, 2)
    assert "working" in sys.stderr.getvalue()


def test_table_on_a_terminal_fits_it(monkeypatch):
    screen = Terminal()
    monkeypatch.setattr(sys, "stdout", screen)
    monkeypatch.setenv("COLUMNS", "60")
    assert main(["table", "mower_lift"]) == 0
    text = re.sub(r"\x1b\[[0-9;]*m", "", screen.getvalue())
    assert max(map(len, text.splitlines())) <= 60
    assert text.count("S, m") > 1 and "0.963" in text and "…" not in text
    screen.seek(screen.truncate(0))
    assert main(["table", "mower_lift", "--count", "501"]) == 0
    assert max(map(len, screen.getvalue().splitlines())) <= 60


def test_every_command_can_be_asked_for_its_options(said):
    """No two options of a command have one name; those of every command stand before and after it."""
    for name in commands.BUILT_IN:
        code, out, error = said(name, "--help")
        assert (code, error) == (0, "") and out.startswith(f"usage: hydrolinkage {name}")


def test_a_page_is_written_in_the_language_asked_for(said, tmp_path):
    for place, options in enumerate((("--language", "ru", "page"), ("page", "--language", "ru"))):
        file = tmp_path / f"{place}.html"
        code, out, _ = said(*options, "four_bar", "--count", "5", "--vary", "OA", "-o", str(file))
        assert code == 0 and out == f"{file}\n"
        assert '<html lang="ru"' in file.read_text(encoding="utf-8")
    code, _, error = said("page", "four_bar", "--vary", "OX", "-o", str(file))
    assert code != 0 and "Dimension 'OX' is unknown" in error
    assert '<html lang="ru"' in file.read_text(encoding="utf-8")
