"""Study files: a text asks for what Python asks for; a mistake has its file, line and key; a search goes on where it stopped."""

import csv
import json
import os
import re
import signal
import subprocess
import sys
import textwrap
from pathlib import Path

import numpy as np
import pytest
from matplotlib.colors import to_hex

from linkage import (
    RIGHT,
    DefinitionError,
    Dimension,
    Dyad,
    Ground,
    LoadCase,
    Mechanism,
    OnLink,
    Stroke,
    Weight,
    angle,
    at,
    deg,
    draw,
    drive_force,
    integral,
    kN,
    least,
    mm,
    most,
    optimise,
    pin_force,
    plot,
    ratio,
    reachable,
    ref,
    transmission,
    worst,
    x,
    y,
)
from linkage.cli import main
from linkage.files import load, save
from linkage.files.expression import condition_said, measure_said, quantity_said
from linkage.files.study_file import range_said, tolerance_said
from linkage.files.study_tasks import TextMeasures
from linkage.pictures import style
from linkage.study import Target, Tolerance, monte_carlo, settings_for, tornado, zone
from linkage.study.space import Around
from tests.for_all import for_all

ROOT = Path(__file__).parents[3]


class Boom(Mechanism):
    """A boom that one cylinder lifts."""

    S = Stroke(0.0, 0.40)
    L0 = Dimension(0.95, unit="mm")
    O = Ground(0.0, 1.80)
    A = Ground(0.15, 0.90)
    B = Dyad(A, O, AB=L0 + S, OB=1.10, side=RIGHT)
    T = OnLink(O, B, OT=2.60, BOT=8 * deg)
    lift = angle(O, T)
    load = Weight(T, mass=800)
    bumpy = LoadCase("on the road", scale={"load": 2.0})


BOOM = Boom()

SEARCH = """
    machine = "boom.toml"
    minimise = "most(drive_force())"
    subject_to = ["at(T_y, S=400 mm) - at(T_y, S=0) >= 1.15 m", "most(pin_force(O)) <= 21 kN", "reachable"]
    starts = 2
    case = "plain"
    round = "1 mm"

    [vary]
    A = "within 60 mm"
    OB = "1.0 to 1.2 m"
"""


QUICK = """
    machine = "boom.toml"
    minimise = "most(lift)"
    subject_to = ["at(T_y, S=400 mm) - at(T_y, S=0) >= 1.15 m", "at(lift, S=0) >= -55 deg"]
    starts = 2

    [vary]
    A = "within 60 mm"
    OB = "1.0 to 1.2 m"
"""


@pytest.fixture
def here(tmp_path, monkeypatch):
    """Return a folder, made the current one, with a machine's file."""
    save(BOOM, tmp_path / "boom.toml")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "path", [*sys.path])
    return tmp_path


@pytest.fixture
def said(capsys):
    """Return a function that runs the command and gives its exit code, output and complaints."""

    def run(*arguments):
        code = main(list(map(str, arguments)))
        return code, *capsys.readouterr()

    return run


def written(folder, text, name="study.toml"):
    (folder / name).write_text(textwrap.dedent(text), encoding="utf-8")
    return folder / name


# -- texts -------------------------------------------------------------------------------------------------

MEASURES = [
    ("least(lift)", least("lift")),
    ("most(abs(lift - 0.5))", most(abs(ref("lift") - 0.5))),
    ("most(drive_force(case=bumpy)) / least(drive_force())", most(drive_force(case="bumpy")) / least(drive_force())),
    ("2 * most(pin_force(O)) - 3 kN", 2 * most(pin_force("O")) - 3 * kN),
    ("-least(transmission('B'))", -least(transmission("B"))),
    ("at(T_y, S=100 mm) + at(y(T), S=0.2)", at(y("T"), S=0.1) + at(y("T"), S=0.2)),
    ("integral(drive_force(), by=S)", integral(drive_force(), by="S")),
    ("least(min(lift, 0.2) ** 2)", least(np.minimum(ref("lift"), 0.2) ** 2)),
    ("OB", at("OB")),
    ("at(A.x)", at("A.x")),
]


@for_all(("text", "measure"), MEASURES, ids=[text for text, _ in MEASURES])
def test_a_text_measures_what_python_does(text, measure):
    said = measure_said(text, BOOM)
    assert str(said) == str(measure)
    found = TextMeasures({"it": text}, 401)(BOOM)["it"]
    motion = BOOM.sweep(401)
    truth = measure.from_leaves(lambda leaf: by_hand(motion, leaf))
    assert found == pytest.approx(truth, rel=1e-4)


def by_hand(motion, leaf):
    """Return what a leaf takes of a motion's poses, by NumPy alone."""
    if leaf.quantity in ("OB", "A.x"):
        return BOOM["OB"] if leaf.quantity == "OB" else BOOM["A"][0]
    if leaf.word == "at":
        return float(BOOM.at(**leaf.strokes)[leaf.quantity])
    values = motion[leaf.quantity]
    if leaf.word == "integral":
        return np.trapezoid(values, motion.strokes["S"]) if hasattr(np, "trapezoid") else np.trapz(values, motion.strokes["S"])
    return values.min() if leaf.word == "least" else values.max()


@for_all(
    ("text", "condition"),
    [
        ("most(lift) <= 40 deg", most("lift") <= 40 * deg),
        ("most(drive_force()) <= 35 kN", 35 * kN >= most(drive_force())),
        ("at(lift, S=0) == -1 * 3 deg", at("lift", S=0.0) == -3 * deg),
        ("OB <= 1100 mm", at("OB") <= 1.1),
        ("least(worst(lift, over=S, by=least)) >= -2", least(worst("lift", over="S", by=least)) >= -2.0),
    ],
)
def test_a_text_is_the_condition_that_python_writes(text, condition):
    assert str(condition_said(text, BOOM)) == str(condition)


def test_reachable_is_a_condition_and_a_request_a_quantity():
    assert condition_said("reachable", BOOM) is reachable
    assert str(quantity_said("drive_force(S)", BOOM)) == "drive_force(S)"


WRONG = [
    ("least(lft)", "Quantity 'lft' is unknown in Boom. Did you mean lift?"),
    ("leest(lift)", "Function 'leest' is unknown. Did you mean least?"),
    ("least(lift", "',' is expected where its end stands"),
    ("least(lift) deg", "an operator or the end is expected where 'deg' stands"),
    ("lift", "lift has a value at every pose: say which is meant, least(...)"),
    ("least(T)", "no number; write x(T) or y(T)"),
    ("least(load)", "no number"),
    ("least(transmission(Q))", "Point 'Q' is unknown"),
    ("most(pin_force(Z))", "Joint 'Z' is unknown"),
    ("at(lift, T=0.1)", "Stroke 'T' is unknown in Boom: at(lift, T=0.1). Known: S."),
    ("at(lift)", "say the pose, S=..."),
    ("integral(lift, by=T)", "say by which stroke, by= one of S"),
    ("least(worst(lift, over=psi))", "Stroke 'psi' is unknown"),
    ("most(drive_force(case=ful))", "Load case 'ful' is unknown"),
    ("least(drive_force(nix=3))", "unexpected keyword argument 'nix'; write drive_force(drive, loads, case, acting)"),
    ("pin_force()", "missing a required argument"),
    ("1 / 0", "has no finite value"),
    ("(-8) ** 0.5", "has no finite value"),
    ("abs(least(lift))", "takes quantities over poses"),
    ("least(min(lift))", "takes 2 arguments, not 1"),
    ("2 * OB", "cannot be calculated"),
    ("__import__('os')", "Function '__import__' is unknown"),
    ("least(lift).__class__", "cannot be read from '.__class__'"),
    ("least(lift, lift, lift, by=2, by=3)", "by= stands twice"),
    ("most(lift) <= 3 deg", "is a condition; a measure is expected"),
    (7, "no text in quotes"),
    ("", "no text in quotes"),
    ("(" * 60 + "1" + ")" * 60, "brackets deep"),
    ("least(lift) + " * 200 + "1", "read"),
]


@for_all(("text", "words"), WRONG, ids=[str(text)[:30] for text, _ in WRONG])
def test_what_is_no_measure_is_told(text, words):
    with pytest.raises(DefinitionError) as error:
        measure_said(text, BOOM)
    assert words in str(error.value)


@for_all(
    ("text", "words"),
    [
        ("most(lift) <= 8 mm", "an angle and a length neither add nor compare"),
        ("3 kN >= most(lift)", "a force and an angle neither add nor compare"),
        ("most(lift) <= 2 * mm", "an angle and a length neither add nor compare"),
        ("most(lift) <= 2 * 3 mm / 4", "an angle and a length neither add nor compare"),
        ("most(pin_force(O)) - least(pin_force(O)) <= 8 bar", "a force and a pressure neither add nor compare"),
        ("most(lift) < 8 deg", "write >=, <= or == for <"),
        ("1 <= most(lift) <= 2", "write two conditions"),
        ("3 <= 4", "two numbers are compared"),
        ("lift <= 8 deg", "say which is meant"),
        ("least(lift)", "says no limit"),
        ("tru", "is unknown"),
    ],
)
def test_what_is_no_condition_is_told(text, words):
    with pytest.raises(DefinitionError) as error:
        condition_said(text, BOOM)
    assert words in str(error.value)


@for_all(
    ("given", "name", "meant"),
    [
        ("1.0 to 1.2 m", "OB", (1.0, 1.2)),
        ("1000 mm to 1.2 m", "OB", (1.0, 1.2)),
        ("1000 to 1200 mm in steps of 5 mm", "OB", (1.0, 1.2, 0.005)),
        ("1.0 to 1.2 by 0.005", "OB", (1.0, 1.2, 0.005)),
        ("-5 to 10 deg", "BOT", (-5 * deg, 10 * deg)),
        ({"from": "1 m", "to": 1.2, "step": "10 mm"}, "OB", (1.0, 1.2, 0.01)),
        ("within 60 mm", "A", Around(60 * mm)),
        ("+-60 mm in steps of 5 mm", "A", Around(60 * mm, 5 * mm)),
        ({"around": "60 mm"}, "OB", Around(60 * mm)),
        (["1 m", 1.1], "OB", [1.0, 1.1]),
        ({"choices": ["1 m", 1.1]}, "OB", [1.0, 1.1]),
        ([["150 mm", 0.9], [0.2, "0.9 m"]], "A", [(0.15, 0.9), (0.2, 0.9)]),
    ],
)
def test_a_range_is_what_it_says(given, name, meant):
    found = range_said(given, Boom.plan, name)
    if isinstance(meant, Around):
        assert (found.by, found.step) == pytest.approx((meant.by, meant.step))
    else:
        assert np.array(found) == pytest.approx(np.array(meant)) and type(found) is type(meant)


def test_a_tolerance_is_what_it_says():
    assert tolerance_said("+-0.1 mm", "length") == Tolerance(1e-4)
    assert tolerance_said({"limits": ["-0.1 mm", 2e-4], "law": "uniform"}, "length") == Tolerance((-1e-4, 2e-4), law="uniform")


# -- mistakes of a file ------------------------------------------------------------------------------------

CHANGES = [
    ('"boom.toml"', '"bom.toml"', "bom.toml: there is no such file"),
    ('"boom.toml"', '"bom"', "line 2, machine: Machine 'bom' is unknown"),
    ('"boom.toml"', '"mypackage.machines:Boom"', "line 2, machine: mypackage.machines is code, and a file runs none unasked; say --trust"),
    ('"boom.toml"', '"own.py"', "own.py is code, and a file runs none unasked; say --trust own.py"),
    ('"boom.toml"', "3", "line 2, machine: 3 is no name in quotes"),
    ('machine = "boom.toml"', "", "machine: the machine is missing; begin with machine ="),
    ("minimise", "minimize", "Key 'minimize' is unknown. Did you mean minimise?"),
    ('minimise = "most(drive_force())"', "", "say minimise or maximise, one measure"),
    ("most(drive_force())", "most(drive_forc())", "line 3, minimise: 'most(drive_forc())': Function 'drive_forc' is unknown"),
    ("21 kN", "21 bar", "line 4, subject_to.2:"),
    ("S=0)", "U=0)", "line 4, subject_to.1: Stroke 'U' is unknown in Boom: at(y(T), U=0)."),
    ("OB =", "BO2 =", "line 11, vary.BO2: Dimension 'BO2' is unknown in Boom."),
    ("OB =", "S =", "line 11, vary.S: Boom: S is a stroke and no dimension"),
    ("1.0 to 1.2 m", "1.0 to 1.2 kN", "line 11, vary.OB: '1.0 kN' is a force where a value of kind length is wanted"),
    ("1.0 to 1.2 m", "1.2 to 1.0 m", "line 11, vary.OB: Boom: OB=(1.2, 1.0) is no range"),
    ("1.0 to 1.2 m", "big", "line 11, vary.OB: 'big' is no range; write a range such as"),
    ("1.0 to 1.2 m", "1,0 to 1.2 m", "decimals are written with a point"),
    ('A = "within 60 mm"', 'A = "0 to 60 mm"', "line 10, vary.A: Boom: A=(0.0, 0.06): A is a point"),
    ("starts = 2", "starts = 0", "line 5, starts: 0: a whole number is expected, at least 1"),
    ("starts = 2", "method = 'best'", "line 5, method: it='best': say"),
    ('case = "plain"', "case = 'full'", "line 6, case: Load case 'full' is unknown in Boom. Known: plain, bumpy."),
        ('case = "plain"', 'case = { plain = 0.7, bumpi = 0.3 }', "line 6, case: Load case 'bumpi' is unknown in Boom"),
    ("starts = 2", "over = { U = '0 to 1 m' }", "line 5, over.U: Stroke 'U' is unknown in Boom. Known: S."),
    ("starts = 2", "over = { S = '0 to 1 deg' }", "line 5, over.S: '0 deg' is an angle"),
    ("starts = 2", "set = { OB = '1 bar' }", "line 5, set.OB: '1 bar' is a pressure"),
    ("starts = 2", "set = { O = '1 m' }", "line 5, set.O: '1 m': O is a point; write its two coordinates"),
    ("starts = 2", "outputs = { table = 'a.txt' }", "line 5, outputs.table: a.txt: the file's name ends in one of .csv"),
    ("starts = 2", "outputs = { tabel = 'a.csv' }", "line 5, outputs.tabel: Output 'tabel' is unknown. Did you mean table?"),
    ("starts = 2", "outputs = { table = 'no/a.csv' }", "no/a.csv: the folder"),
    ('"1 mm"', '"-1 mm"', "line 7, round: '-1 mm': a step above zero is expected"),
    ('"1 mm"', "{ toe = 1 }", "line 7, round: toe is no step"),
    ('"1 mm"', '"1 mm', "line 7:"),
    ("[vary]", "[varied]", "Key 'varied' is unknown. Did you mean vary?"),
    ("[vary]", "[strokes]", 'study.toml is a machine itself; name it in another file, machine = "study.toml", and what is asked of it'),
    ("[vary]", "regions = { T = [[0, 0], [1, 1]] }\n[vary]", "regions.T: Boom: regions={'T': ...}: [[0.0, 0.0], [1.0, 1.0]]: a region has"),
]


@pytest.mark.parametrize(("old", "new", "words"), CHANGES, ids=[f"{new[:34]}" for _, new, _ in CHANGES])
def test_a_mistake_has_its_place(here, said, old, new, words):
    assert SEARCH.count(old) == 1
    code, out, err = said("optimise", written(here, SEARCH.replace(old, new)))
    assert (code, out) == (2, "")
    assert words in " ".join(err.split())
    assert "Traceback" not in err


def test_several_mistakes_are_told_at_once(here, said):
    text = SEARCH.replace("1.0 to 1.2 m", "big").replace("21 kN", "21 bar").replace("starts = 2", "starts = 0")
    code, _, err = said("optimise", written(here, text))
    assert code == 2
    assert err.splitlines()[0] == "hydrolinkage: study.toml: 3 mistakes:"
    assert [line.split(",")[0].strip() for line in err.splitlines()[1:]] == ["line 4", "line 5", "line 11"]


def test_a_wrong_value_of_a_setting_hides_no_unknown_name(here, said):
    code, _, err = said("optimise", written(here, 'machine = "boom.toml"\nset = { OB = "big", OX = "1 m" }\n'))
    assert code == 2
    assert "'big' is not a value" in err and "Dimension 'OX' is unknown" in err


def test_a_file_that_is_not_there(here, said):
    assert said("optimise", "nowhere.toml")[0] == 2
    assert said("study", "nowhere.toml")[0] == 2
    assert said("optimise", "lever.txt")[0] == 2
    assert said("optimise")[0] == 2


def test_trusted_code_is_run(here, said):
    written(here, "from tests.linkage.files.test_study_files import Boom\nclass Own(Boom):\n    pass\n", "own.py")
    file = written(here, QUICK.replace("boom.toml", "own.py:Own").replace("starts = 2", "method = 'local'"))
    assert said("optimise", file)[0] == 2
    code, out, _ = said("optimise", file, "--trust", "own.py")
    assert code == 0 and out.startswith("Own: the least most(lift) found is")


# -- a search ----------------------------------------------------------------------------------------------


def asked_in_python(**more):
    return optimise(
        BOOM, minimise=most(drive_force()), vary={"A": Around(60 * mm), "OB": (1.0, 1.2)},
        subject_to=[at(y("T"), S=0.4) - at(y("T"), S=0.0) >= 1.15, most(pin_force("O")) <= 21 * kN], case="plain", starts=2, **more,
    )  # fmt: skip


@pytest.fixture(scope="module")
def best():
    return asked_in_python()


def test_load_cases_with_their_hours_stand_in_the_file(here, said):
    text = 'machine = "boom.toml"\nminimise = "most(drive_force())"\ncase = { plain = 3, bumpy = 1 }\nmethod = "local"\n'
    code, out, _ = said("optimise", written(here, f'{text}[vary]\nOB = "1.0 to 1.2 m"\n'))
    hours = {"plain": 3, "bumpy": 1}
    wanted = optimise(BOOM, minimise=most(drive_force()), vary={"OB": (1.0, 1.2)}, case=hours, method="local")
    assert code == 0
    assert f"{wanted.value / kN:.6g} kN" in out


OUTPUTS = """
    [outputs]
    table = "table.csv"
    designs = ["designs.csv", "designs.jsonl"]
    drawing = "drawing.png"
    curves = "curves.svg"
    machine = "best.toml"
"""


def table_rows(path):
    with path.open(newline="") as stream:
        return [*csv.DictReader(stream)]


def test_a_file_asks_for_what_python_asks(here, said, best):
    code, out, err = said("optimise", written(here, SEARCH + OUTPUTS))
    assert (code, err) == (0, "")
    assert out.startswith(str(best)) and "Rounded: A.x = " in out
    rounded = best.rounded(1 * mm)
    rows = {(row["what"], row["name"]): row for row in table_rows(here / "table.csv")}
    assert [name for what, name in rows if what == "variable"] == ["A.x", "A.y", "OB"]
    assert float(rows["variable", "OB"]["after"]) == best.variables["OB"] / mm
    assert float(rows["objective", "most(drive_force())"]["rounded"]) == rounded.value / kN
    assert len([what for what, _ in rows if what == "condition"]) == 2
    designs = table_rows(here / "designs.csv")
    lines = [json.loads(line) for line in (here / "designs.jsonl").read_text().splitlines()]
    assert len(designs) == len(lines) == sum(len(each.unit) for each in best.tried)
    ends = [line for line in lines if line["stage"] == "searched"]
    assert len(ends) == best.tries and min(line["value"] for line in ends if line["missing"] < 1e-7) == pytest.approx(best.value)
    assert float(designs[5]["OB, mm"]) == pytest.approx(lines[5]["OB"] / mm)
    assert float(designs[5]["most(drive_force()), kN"]) == pytest.approx(lines[5]["value"] / kN)
    again = load(here / "best.toml")()
    assert again.dimensions == rounded.machine.dimensions
    assert (here / "drawing.png").read_bytes().startswith(b"\x89PNG") and "</svg>" in (here / "curves.svg").read_text()


def test_settings_of_the_command_stand_above_the_file(here, said):
    text = QUICK.replace("most(lift)", "most(drive_force())").replace("starts = 2", "method = 'local'\nset = { 'load.mass' = '0.4 t' }")
    file = written(here, text)
    code, out, err = said("optimise", file, "--set", "load.mass=1600", "--progress")
    quarter = said("optimise", file)[1]
    assert (code, err) == (0, "0 of 1\n1 of 1\n")
    assert 4 * number_in(quarter) == pytest.approx(number_in(out), rel=1e-4)


def number_in(text):
    return float(re.search(r" found is ([\d.]+)", text)[1])


def test_no_feasible_design_is_told_with_the_relaxation(here, said):
    code, out, err = said("optimise", written(here, QUICK.replace("1.15 m", "2.6 m")))
    assert (code, out) == (1, "")
    assert "no design found in the box keeps all conditions" in err and "short" in err and len(err.splitlines()) == 1
    code, _, err = said("optimise", written(here, QUICK.replace("1.0 to 1.2 m", "0.2 to 0.3 m")))
    assert code == 1 and "can be assembled over the whole stroke" in err


@pytest.mark.slow
def test_a_killed_search_goes_on_to_the_same_bits(here, said):
    file = written(here, QUICK.replace("starts = 2", "starts = 3\nfolder = 'run'") + OUTPUTS)
    program = """if True:
        import os, signal, sys
        from functools import partial

        from linkage.cli.optimise import machine_of_study
        from linkage.files.synthesis_file import read_search
        search = read_search("study.toml", partial(machine_of_study, []))
        search.run(None, lambda done, total: done == 2 and os.kill(os.getpid(), signal.SIGKILL))
    """
    killed = subprocess.run([sys.executable, "-c", program], cwd=here, capture_output=True, env=os.environ | {"PYTHONPATH": str(ROOT)})
    assert killed.returncode == -signal.SIGKILL
    first, second = sorted((here / "run").glob("designs-*.npy"))
    (here / "run" / second.name.replace("designs-000000001-000000002", "designs-000000002-000000003")).write_bytes(b"torn")
    code, resumed, _ = said("optimise", file)
    tables = [(here / name).read_bytes() for name in ("table.csv", "designs.csv", "designs.jsonl", "best.toml")]
    whole = said("optimise", file, "--folder", here / "other")[1]
    assert code == 0 and resumed == whole
    assert tables == [(here / name).read_bytes() for name in ("table.csv", "designs.csv", "designs.jsonl", "best.toml")]
    resumed, whole = ({path.name for path in (here / name).iterdir()} for name in ("run", "other"))
    assert {first.name, second.name} <= whole <= resumed


def test_what_a_folder_holds_is_checked(here, said):
    text = QUICK.replace("starts = 2", "starts = 1\nfolder = 'run'")
    first = said("optimise", written(here, text))[1]
    for change in (("1.15 m", "1.16 m"), ("60 mm", "61 mm"), ("starts = 1", "starts = 2"), ("-55 deg", "-55.0000001 deg")):
        code, _, err = said("optimise", written(here, text.replace(*change)))
        assert code == 2 and "holds another search" in err
    (kept,) = (here / "run").glob("designs-*.npy")
    content = kept.read_bytes()
    for spoiled in (b"", b"\0\0", content[:-1], content[:-1] + b"\xff", content + b"\0"):
        kept.write_bytes(spoiled)
        assert said("optimise", written(here, text))[1] == first
        assert kept.read_bytes() == content  # searched for anew, and kept again


@pytest.mark.slow
def test_a_front_is_written(here, said):
    pytest.importorskip("pymoo")
    text = QUICK.replace('minimise = "most(lift)"', 'minimise = ["most(lift)", "OB"]')
    code, out, _ = said("optimise", written(here, text + '[outputs]\ndesigns = "front.csv"\n'))
    rows = table_rows(here / "front.csv")
    assert code == 0 and f"{len(rows)} designs of which none is better" in out
    assert all(float(row["at(OB), mm"]) == pytest.approx(float(row["OB, mm"])) for row in rows)
    assert said("optimise", written(here, text + OUTPUTS))[0] == 2


# -- pictures of an optimum --------------------------------------------------------------------------------


def test_the_drawing_tells_how_far_pins_moved(best):
    figure = draw(best)
    texts = {text.get_text() for ax in figure.axes for text in ax.texts}
    for ax, S in zip(figure.axes, (0.0, 0.4), strict=True):
        shown = {text.get_text() for text in ax.texts}
        moved = np.hypot(*(best.machine.at(S=S)["B"] - BOOM.at(S=S)["B"])) / mm
        assert f"{moved:.{0 if moved >= 9.95 else 1}f}" in shown
        assert {"A", "B", "O", "T"} <= shown
    assert [ax.get_title(loc="right") for ax in figure.axes] == ["S = 0 mm", "S = 400 mm"]
    assert f"{np.hypot(*(best.machine['A'] - BOOM['A'])) / mm:.0f}" in texts
    with pytest.raises(DefinitionError, match="drawn at the ends of its stroke"):
        draw(best, [0.1])
    with pytest.raises(DefinitionError, match="count=1"):
        draw(best, count=1)


def test_the_curves_are_those_of_both_machines(best):
    figure = plot(best)
    assert [ax.get_title(loc="left") for ax in figure.axes] == ["drive_force(), kN", "y(T), mm", "pin_force(O), kN"]
    for ax, quantity, unit in zip(figure.axes, (drive_force(), y("T"), pin_force("O")), (kN, mm, kN), strict=True):
        before, after = ax.lines[:2]
        for line, machine in ((before, BOOM), (after, best.machine)):
            truth = machine.at(S=line.get_xdata() * mm)[quantity]
            assert line.get_ydata() * unit == pytest.approx(truth, rel=1e-9)
    spans = [patch for patch in figure.axes[2].patches if to_hex(patch.get_facecolor()) == style.ACCENT]
    assert len(spans) == 1 and spans[0].get_y() == pytest.approx(21.0)
    with pytest.raises(DefinitionError, match="its own curves"):
        plot(best, ["lift"])


def test_the_table_holds_what_it_says(best):
    rows = best.rows(best.rounded(1 * mm))
    assert [row.what for row in rows] == ["variable"] * 3 + ["objective"] + ["condition"] * 2
    held = rows[-2]
    assert held.before == pytest.approx(np.ptp(BOOM.at(S=[0.0, 0.4]).y("T")))
    assert held.after - held.limit == pytest.approx(held.spare, abs=1e-12)
    text = best.table()
    assert "rounded" not in text and text.splitlines()[0].split()[:2] == ["what", "name"]


# -- studies -----------------------------------------------------------------------------------------------

STUDY = """
    machine = "boom.toml"
    folder = "run"

    [survey]
    count = 64
    piece = 16
    vary = { OB = "1.0 to 1.2 m", A = "within 20 mm" }
    measure = { travel = "at(T_y, S=400 mm) - at(T_y, S=0)", force = "most(drive_force())", light = "most(drive_force()) <= 27 kN" }

    [zone]
    quantity = "lift"
    vary = { OB = "1.0 to 1.2 m", A = [["150 mm", "900 mm"], ["170 mm", "900 mm"]] }
    poses = 5

    [tolerance]
    of = ["lift", "drive_force()"]
    tolerances = { OB = "0.1 mm", A = ["-0.1 mm", "0.2 mm"] }
    subject_to = ["most(drive_force()) <= 54.16 kN"]
    count = 512
    poses = 5
    case = "bumpy"

    [tornado]
    quantity = "lift"
    tolerances = { OB = "0.1 mm", BOT = "0.1 deg" }
    strokes = { S = "100 mm" }

    [settings]
    vary = { OB = "0.9 to 1.3 m" }
    targets = ["at(lift, S=100 mm) == -10 deg"]

    [outputs]
    survey = ["survey.csv", "survey.jsonl"]
    zone = ["zone.csv", "zone.png"]
    tolerance = ["tolerance.csv", "tolerance.png"]
    tornado = ["tornado.csv", "tornado.png"]
    settings = "settings.csv"
"""


def table(path):
    with path.open(newline="") as stream:
        heads, *rows = csv.reader(stream)
    return {head: [row[place] for row in rows] for place, head in enumerate(heads)}


def numbers(path):
    return {head: np.array(column, float) for head, column in table(path).items() if head != "name"}


@pytest.mark.slow
def test_studies_of_a_file_are_those_of_python(here, said):
    code, out, err = said("study", written(here, STUDY))
    assert (code, err) == (0, "")
    assert out.startswith("Boom: 64 designs.")
    survey = numbers(here / "survey.csv")
    for row in (0, 17, 63):
        machine = Boom(OB=survey["OB, mm"][row] * mm, A=(survey["A.x, mm"][row] * mm, survey["A.y, mm"][row] * mm))
        motion = machine.sweep(101)
        assert survey["travel, mm"][row] * mm == pytest.approx(float(np.ptp(motion.y("T"))), rel=1e-9)
        assert survey["force, kN"][row] * kN == pytest.approx(motion[drive_force()].max(), rel=1e-9)
        assert survey["light"][row] == (motion[drive_force()].max() <= 27 * kN)
    assert 0 < survey["light"].sum() < 64
    assert json.loads((here / "survey.jsonl").read_text().splitlines()[17])["OB"] == survey["OB, mm"][17] * mm
    truth = zone(BOOM, "lift", {"OB": (1.0, 1.2), "A": [(0.15, 0.9), (0.17, 0.9)]}, S=np.linspace(0.0, 0.4, 5))
    assert numbers(here / "zone.csv")["lift greatest, deg"] * deg == pytest.approx(truth.high, rel=1e-12)
    tolerances = {"OB": 1e-4, "A": (-1e-4, 2e-4)}
    twice = drive_force(case="bumpy")
    many = monte_carlo(BOOM, [twice], tolerances, subject_to=[most(twice) <= 54.16 * kN], count=512, S=np.linspace(0, 0.4, 5))
    found = numbers(here / "tolerance.csv")
    assert found["drive_force() sigma, kN"] * kN == pytest.approx(many[twice].sigma, rel=1e-9)
    assert f"{100 * many.yield_rate:.1f} % are good" in out
    bars = tornado(BOOM, "lift", {"OB": 1e-4, "BOT": 0.1 * deg}, S=0.1)
    assert table(here / "tornado.csv")["name"] == [bar.name for bar in bars]
    assert numbers(here / "tornado.csv")["share of the variance"] == pytest.approx([bar.share for bar in bars])
    wanted = settings_for(BOOM, {"OB": (0.9, 1.3)}, [Target("lift", -10 * deg, S=0.1)])
    assert numbers(here / "settings.csv")["OB, mm"] * mm == pytest.approx([each["OB"] for each in wanted.settings])
    assert all((here / f"{name}.png").read_bytes().startswith(b"\x89PNG") for name in ("zone", "tolerance", "tornado"))


SURVEY = STUDY[: STUDY.index("    [zone]")]


def test_a_survey_goes_on_from_its_folder(here, said):
    first = said("study", written(here, SURVEY))
    batches = sorted((here / "run").glob("designs-*"))
    assert first[0] == 0 and batches
    batches[0].write_bytes(batches[0].read_bytes()[:-9])
    assert said("study", written(here, SURVEY)) == first
    code, _, err = said("study", written(here, SURVEY.replace("<= 27 kN", "<= 26 kN")))
    assert code == 2 and "holds another study" in err


def test_settings_that_are_nowhere_end_with_one(here, said):
    text = """
    machine = "boom.toml"
    [settings]
    vary = { OB = "1.0 to 1.1 m" }
    targets = ["at(lift, S=100 mm) == 80 deg"]
    """
    assert said("study", written(here, text))[0] == 1
    lost = text.replace('OB = "1.0 to 1.1 m"', 'OB = "10 to 20 mm", A = [["150 mm", "900 mm"], ["160 mm", "900 mm"]]')
    code, out, err = said("study", written(here, f'{lost}\n[outputs]\nsettings = "settings.csv"\n'))
    assert (code, err) == (1, "") and out.startswith("No setting of OB, A that was looked at can be assembled at S = 100 mm.")
    assert (here / "settings.csv").read_text().splitlines() == ['"OB, mm","A.x, mm","A.y, mm"']


def test_a_zone_goes_down_a_stroke_in_steps_and_says_where_it_is_nowhere(here, said):
    text = """
    machine = "boom.toml"
    [zone]
    quantity = "lift"
    vary = { OB = "1.0 to 1.1 m" }
    strokes = { S = "100 to 0 mm in steps of 40 mm" }
    [outputs]
    zone = "zone.csv"
    """
    assert said("study", written(here, text))[0] == 0
    assert numbers(here / "zone.csv")["S, mm"] == pytest.approx([100.0, 60.0, 20.0])
    code, out, _ = said("study", written(here, text.replace("1.0 to 1.1 m", "10 to 20 mm")))
    assert code == 0 and out.startswith("Boom: lift has no value over the box.\n  33 of 33 settings looked at")


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("[zone]", "[zones]", "Key 'zones' is unknown. Did you mean zone?"),
        ("count = 64", "cuont = 64", "line 6, survey.cuont: Key 'cuont' is unknown. Did you mean count?"),
        ("count = 64", "count = 0", "line 6, survey.count: 0: a whole number is expected"),
        ("count = 64", "method = 'best'", "survey.method: it='best'"),
        ("most(drive_force())\",", "most(drive_forc())\",", "survey.measure.force:"),
        ('OB = "1.0 to 1.2 m", A = "w', 'OB = "1 to 1.2 m by 5 mm", A = "w', "survey.vary.OB: a study looks between the steps"),
        ('OB = "1.0 to 1.2 m", A = "w', 'OC = "1 to 1.2 m", A = "w', "survey.vary.OC: Dimension 'OC' is unknown"),
        ('quantity = "lift"\n    vary', 'quantity = "least(lift)"\n    vary', "zone.quantity: 'least(lift)' has no value at every pose"),
        ("<= 54.16 kN", "== 54.16 kN", "tolerance.subject_to.1: Boom: most(drive_force(case=bumpy)) == 54.16 kN: no machine keeps"),
        ('OB = "0.1 mm", A', 'OB = "0.1 deg", A', "tolerance.tolerances.OB: '0.1 deg' is an angle"),
        ('"0.1 mm", BOT', '"-0.1 mm", BOT', "tornado.tolerances.OB:"),
        ('strokes = { S = "100 mm" }', "", "tornado.strokes: say the pose, strokes = { S = ... }"),
        ('{ S = "100 mm" }', '{ S = "0 to 9 mm by 0 mm" }', "tornado.strokes.S: '0 to 9 mm by 0 mm': give a longer step."),
        ("at(lift, S=100 mm) == -10 deg", "at(lift, S=100 mm) >= 0 deg", "settings.targets.1:"),
        ('tornado = ["tornado.csv"', 'tornado = ["tornado.txt"', "outputs.tornado: tornado.txt: the file's name ends in"),
    ],
)  # fmt: skip
def test_a_mistake_of_a_study_has_its_place(here, said, old, new, words):
    assert STUDY.count(old) == 1
    code, out, err = said("study", written(here, STUDY.replace(old, new)))
    assert (code, out) == (2, "")
    assert words in " ".join(err.split())


def test_a_file_without_a_study_is_told(here, said):
    code, _, err = said("study", written(here, 'machine = "boom.toml"\n[outputs]\nzone = "zone.csv"\n'))
    assert code == 2 and "there is no study; begin one with [survey]" in err and "the file has no [zone]" in err


ORDERS = """
    machine = "boom.toml"

    [zone]
    quantity = "ratio(lift, order=2)"
    vary = { OB = "1.0 to 1.2 m", A = [["150 mm", "900 mm"], ["170 mm", "900 mm"]] }
    poses = 5

    [tolerance]
    of = ["ratio(T.y, order=2)", "ratio(T_x, S, 2)", "ratio(lift, wrt=S, order=1)"]
    tolerances = { OB = "0.1 mm" }
    subject_to = ["most(abs(ratio(lift, order=2))) <= 1e6"]
    count = 64
    poses = 3

    [tornado]
    quantity = "ratio(y(T), order=2)"
    tolerances = { OB = "0.1 mm" }
    strokes = { S = "100 mm" }

    [outputs]
    zone = "zone.csv"
    tolerance = "tolerance.csv"
    tornado = "tornado.csv"
"""


def test_a_second_derivative_is_a_quantity_of_a_study(here, said):
    """`order=2` of a text is the whole number 2: the studies are those of Python."""
    code, out, err = said("study", written(here, ORDERS))
    assert (code, err) == (0, "")
    wanted = zone(BOOM, ratio("lift", order=2), {"OB": (1.0, 1.2), "A": [(0.15, 0.9), (0.17, 0.9)]}, S=np.linspace(0.0, 0.4, 5))
    columns = numbers(here / "zone.csv")
    assert next(column for name, column in columns.items() if "greatest" in name) == pytest.approx(wanted.high, rel=1e-12)
    asked = [ratio(y("T"), order=2), ratio(x("T"), "S", 2), ratio("lift")]
    many = monte_carlo(BOOM, asked, {"OB": 1e-4}, count=64, S=np.linspace(0.0, 0.4, 3))
    sigmas = [column for name, column in numbers(here / "tolerance.csv").items() if "sigma" in name]
    for column, each in zip(sigmas, asked, strict=True):
        assert np.ptp(column - many[each].sigma) == pytest.approx(0.0, abs=1e-9)
    (bar,) = tornado(BOOM, ratio(y("T"), order=2), {"OB": 1e-4}, S=0.1)
    assert bar.share == 1.0
    assert "the second derivative of lift by S from" in out


@pytest.mark.parametrize(
    ("order", "words"),
    [("2.5", "order=2.5: derivatives of order 1 and 2"), ("3", "order=3: derivatives"), ("2 mm", "order=0.002: derivatives"),
     ("true", "order=True: derivatives"), ("'2'", "order='2': derivatives")],
)  # fmt: skip
def test_an_order_that_is_none(here, said, order, words):
    text = ORDERS.replace('"ratio(lift, order=2)"', f'"ratio(lift, order={order})"')
    code, out, err = said("study", written(here, text))
    assert (code, out) == (2, "")
    assert words in " ".join(err.split())


def test_the_ratio_of_a_point_has_two_components(here, said):
    code, out, err = said("study", written(here, ORDERS.replace('"ratio(lift, order=2)"', '"ratio(T, order=2)"')))
    assert (code, out) == (2, "")
    assert "has two components; say which, ratio(x(T), order=2) or ratio(y(T), order=2)." in " ".join(err.split())
