"""Forces, limits, capacity, ratios and verdicts of any machine on the command line; what every command has; list and new."""

import csv
import io
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from linkage.cli import listing, main
from linkage.cli.machines import find
from linkage.statics import driving_force, max_table, pin_forces
from linkage.units import bar, inch, kN, lbf, mm, psi
from mechanisms.at_work.tail_lift import TailLift
from tests.for_all import first_daily

LOADER = '''
from hydraulics import Cylinder, LiftCircuit
from linkage import *

class Loader(Mechanism):
    """A lift arm on a cylinder."""

    S = Stroke(0.0, 0.25)
    A, O = Ground(0.20, 0.55), Ground(0.30, 1.15)
    B = Dyad(A, O, AB=0.5 + S, OB=0.30, side=RIGHT)
    G = OnLink(O, B, OG=0.90, BOG=0.35)
    rise = angle(O, G)
    load = Weight(G, mass=800)
    lift = Cylinder(A, B, bore=0.080, rod=0.045)
    pump = LiftCircuit(lift, pressure=180 * bar)
    transport = LoadCase("on the road", scale={"load": 2.0})
'''
RUBBING = (
    LOADER
    + """    rub = PinFriction(O, radius=0.03, coefficient=0.2)
"""
)


@pytest.fixture
def said(capsys, tmp_path, monkeypatch):
    """Return a function that runs the command in a folder with a loader's file, and gives its exit code, output and complaints."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "path", [*sys.path])
    (tmp_path / "loader.py").write_text(LOADER, encoding="utf-8")
    (tmp_path / "rubbing.py").write_text(RUBBING, encoding="utf-8")

    def run(*arguments):
        code = main(list(arguments))
        return code, *capsys.readouterr()

    return run


def test_the_columns_that_count_friction_are_named(said):
    """Thrusts stand without it beside pressures with it, unless a direction is asked for, or nothing rubs."""
    for arguments in (("table", "rubbing.py"), ("forces", "rubbing.py"), ("table", "rubbing.py:Loader", "--columns", "thrust")):
        assert ("pressure and the reserve of a cylinder are with it, while it extends." in said(*arguments)[1]) == (len(arguments) == 2)
    for arguments in (("table", "rubbing.py", "--direction", "frictionless"), ("table", "loader.py")):
        assert "without friction" not in said(*arguments)[1]


def numbers(text):
    """Return a CSV text by its headings."""
    heads, *rows = csv.reader(io.StringIO(text, newline=""))
    return dict(zip(heads, np.array([[float(cell or "nan") for cell in row] for row in rows]).T, strict=True))


def loader(file="loader.py"):
    return find(file)()


# -- tables ------------------------------------------------------------------------------------------------


def test_ratios_stand_beside_their_strokes(said):
    code, out, _ = said("table", "loader.py", "--ratio", "G", "--ratio", "rise", "--count", "4", "--csv", "-")
    found, motion = numbers(out), loader().sweep(4)
    assert code == 0 and list(found) == ["S, m", "dG_x/dS", "dG_y/dS", "drise/dS, rad/m"]
    np.testing.assert_allclose([found["dG_x/dS"], found["dG_y/dS"]], motion.ratio("G"), rtol=1e-12)
    np.testing.assert_allclose(found["drise/dS, rad/m"], motion.ratio("rise"), rtol=1e-12)


def test_ratios_of_several_strokes_are_by_each_or_by_the_one_named(said):
    _, out, _ = said("table", "front_loader", "--ratio", "boom", "--at", "tilt=0.1", "--count", "2", "--csv", "-")
    assert list(numbers(out)) == ["lift, m", "tilt, m", "dboom/dlift, rad/m", "dboom/dtilt, rad/m"]
    _, out, _ = said("table", "front_loader", "boom", "--ratio", "boom", "--wrt", "lift", "--at", "tilt=0.1", "--count", "2", "--csv", "-")
    assert list(numbers(out)) == ["lift, m", "tilt, m", "boom, deg", "dboom/dlift, rad/m"]


def test_columns_are_requests_in_words(said):
    asked = ["pressure(lift)", "ratio(G.y)", "thrust(lift, direction=extending)", "reserve(lift)", "pin_force(B, on=lift)", "y(G) - y(O)"]
    code, out, err = said("table", "loader.py", *asked, "--count", "3", "--csv", "-")
    assert (code, err) == (0, "")
    found, motion = numbers(out), loader().sweep(3)
    lift, pump = (loader().plan.members[name] for name in ("lift", "pump"))
    np.testing.assert_allclose(found["pressure(lift), bar"], lift.pressure(motion) / bar, rtol=1e-12)
    np.testing.assert_allclose(found["ratio(G.y)"], motion.ratio("G")[1], rtol=1e-12)
    np.testing.assert_allclose(found["thrust(lift, direction=extending), kN"], lift.thrust(motion, direction="extending") / kN, rtol=1e-12)
    np.testing.assert_allclose(found["reserve(lift)"], pump.reserve(motion), rtol=1e-12)
    np.testing.assert_allclose(found["y(G) - y(O), m"], motion.y("G") - 1.15, rtol=1e-12)


def test_a_machine_with_a_table_of_its_own_has_the_others_columns_by_name(said):
    _, out, _ = said("table", "mower_lift", "thrust", "pd", "G_y", "--count", "3", "--csv", "-")
    found = numbers(out)
    assert list(found) == ["S, m", "thrust, kN", "pd, kgf/cm2", "G_y, m"]
    motion = find("mower_lift")().sweep(3)
    np.testing.assert_allclose(found["thrust, kN"], find("mower_lift").plan.members["lift"].thrust(motion) / kN)


def test_a_load_case_and_a_direction_reach_every_force(said):
    motion = loader("rubbing.py").sweep(3)
    for options, keywords in (
        ([], {}),
        (["--case", "transport"], {"case": "transport"}),
        (["--case", "on the road"], {"case": "transport"}),
        (["--direction", "extending"], {"direction": "extending"}),
        (["--case", "transport", "--direction", "retracting"], {"case": "transport", "direction": "retracting"}),
    ):
        code, out, _ = said("table", "rubbing.py", "drive force", "thrust", "pressure", "--count", "3", "--csv", "-", *options)
        found, lift = numbers(out), loader("rubbing.py").plan.members["lift"]
        assert code == 0
        np.testing.assert_allclose(found["drive force, kN"], driving_force(motion, **keywords) / kN, rtol=1e-12)
        np.testing.assert_allclose(found["thrust, kN"], lift.thrust(motion, **keywords) / kN, rtol=1e-12)
        np.testing.assert_allclose(found["pressure, bar"], lift.pressure(motion, **keywords) / bar, rtol=1e-12)
    _, out, _ = said("table", "rubbing.py", "pressure(lift)", "--count", "3", "--csv", "-", "--case", "transport")
    np.testing.assert_allclose(numbers(out)["pressure(lift), bar"], lift.pressure(motion, case="transport") / bar, rtol=1e-12)


def test_what_is_divided_by_its_own_kind_is_a_plain_number(said):
    _, out, _ = said("table", "loader.py", "pressure(lift)/(180 bar)", "pressure(lift)/2", "--count", "3", "--csv", "-")
    found, motion = numbers(out), loader().sweep(3)
    pressure = loader().plan.members["lift"].pressure(motion)
    np.testing.assert_allclose(found["pressure(lift)/(180 bar)"], pressure / (180 * bar), rtol=1e-12)
    np.testing.assert_allclose(found["pressure(lift)/2, bar"], pressure / 2 / bar, rtol=1e-12)


def test_pins_and_limits_follow_the_table(said):
    code, out, _ = said("table", "loader.py", "rise", "--pins", "--limits", "--count", "3")
    assert code == 0 and str(loader().sweep(3).limits()) in out
    for row in max_table(loader()):  # in the worst load case, which a table of values leaves out
        assert re.search(rf"^{row.point} +pin +{row.on} .*{row.force / kN:.3f} .*{row.case}", out, re.MULTILINE)
    assert "at S = 250.0 mm" in " ".join(out.split()) or "S = 250.0 mm" in out


# -- forces, limits, capacity ------------------------------------------------------------------------------


def test_forces_of_every_pin_and_on_a_body(said):
    code, out, _ = said("forces", "loader.py", "--poses", "--count", "3", "--csv", "-", "--case", "transport")
    motion = loader().sweep(3)
    found, pins = numbers(out), pin_forces(motion, case="transport")
    assert code == 0
    np.testing.assert_allclose(found["O, kN"], np.hypot(*pins.force("O")) / kN, rtol=1e-12)
    _, out, _ = said("forces", "loader.py", "--count", "3", "--csv", "forces.csv", "--case", "transport")
    assert out.startswith("Loader, on the road, frictionless. Drive forces are positive") and "\nforces.csv: 3 rows\n" in out
    _, out, _ = said("forces", "loader.py", "--on", "OBG", "--count", "3", "--csv", "-")
    found = numbers(out)
    for axis in "xy":
        assert np.abs(sum(value for name, value in found.items() if f"_{axis}" in name)).max() < 1e-9  # they balance


@pytest.mark.slow
def test_forces_over_all_cases_and_directions_are_the_worst(said):
    code, out, _ = said("forces", "rubbing.py", "--count", "3")
    assert code == 0 and re.search(r"^O +pin .* on the road +(extending|retracting)$", out, re.MULTILINE)
    assert "residual of equilibrium" in out
    one = pin_forces(loader("rubbing.py").sweep(3), case="transport", direction="extending")
    other = pin_forces(loader("rubbing.py").sweep(3), case="transport", direction="retracting")
    (worst,) = (row.force for row in max_table([one, other]) if row.point == "O")
    assert f"{worst / kN:.3f}" in out


@pytest.mark.slow
def test_forces_along_several_paths_name_their_loads_once(said):
    code, out, _ = said("forces", "telehandler", "--count", "2")
    heads = [line for line in out.splitlines() if "Telehandler, " in line]
    assert code == 0 and [head.partition(" Drive")[0] for head in heads] == [
        "over stacking, under its own loads: Telehandler, frictionless.", "over reaching, in the case far: Telehandler, frictionless."
    ]  # fmt: skip


def test_a_direction_is_of_the_overs_that_are_not_in_time(said, tmp_path):
    timed = LOADER + "    box, going = Over(S=(0.0, 0.1)), Over.path(S=ramp(0.0, 0.2, speed=0.1))\n"
    (tmp_path / "timed.py").write_text(timed, encoding="utf-8")
    for command, pins in (("table", "--pins"), ("forces", "--poses")):
        code, out, err = said(command, "timed.py", "--direction", "extending", pins)
        assert code == 0 and "going is left out, as it runs in time" in err and "0.1000" in out and "0.2000" not in out
    code, _, err = said("plot", "timed.py", "pressure", "--direction", "extending", "-o", str(tmp_path / "curve.png"))
    assert code == 0 and "going is left out, as it runs in time" in err
    code, _, err = said("table", "timed.py", "--direction", "extending", "--over", "going")
    assert code and "in time the machine moves one way" in err


def test_limits_of_any_machine(said):
    code, out, _ = said("limits", "jansen")
    assert code == 0 and str(find("jansen")().sweep(21).limits()) in out and "mobility 1" in out
    assert said("limits", "mower_lift", "--check")[0] == 0
    code, out, _ = said("limits", "loader.py", "--set", "OB=100mm", "--check")
    assert code == 1 and "FAIL assembly" in out and "FAIL dead points" in out


@pytest.mark.slow
def test_limits_of_many_strokes_need_no_grid_of_all(said):
    """Six strokes: a grid of 21 poses each would be 86 million."""
    code, out, err = said("limits", "forwarder", "--at", "phi=40deg")
    assert (code, err) == (0, "") and "swing: declared -30 to 30 deg, with phi = 40 deg," in out and "mobility 6" in out


def test_capacity_of_any_machine(said):
    code, out, err = said("capacity", "loader.py", "--count", "3", "--csv", "-")
    motion, pump = loader().sweep(3), loader().plan.members["pump"]
    assert (code, err) == (0, "")
    np.testing.assert_allclose(numbers(out)["further load, kN"], pump.capacity(motion, "G") / kN, rtol=1e-12)
    options = "--at-point B --along 1,1 --share 0.9 --case transport --csv - --count 3"
    _, out, _ = said("capacity", "loader.py", *options.split())
    expected = pump.capacity(motion, "B", along=(1.0, 1.0), share=0.9, case="transport")
    np.testing.assert_allclose(numbers(out)["further load, kN"], expected / kN, rtol=1e-12, equal_nan=True)
    code, out, _ = said("capacity", "loader.py", "--count", "3")
    assert "ok   further load: " in out and "ok   lifting: " in out and "at 180 bar" in out
    options = "--cylinder lift --at-point G --count 3 --csv -"
    _, out, _ = said("capacity", "tail_lift", *options.split())  # its pump is on an OilLine
    expected = TailLift.plan.members["lifting"].capacity(TailLift().at(S=[0.0, 0.13, 0.26], tilt=0.01), "G")
    np.testing.assert_allclose(numbers(out)["further load, kN"], expected / kN, rtol=1e-12)
    code, out, _ = said("capacity", "loader.py", "--pressure", "20bar", "--count", "3", "--check")
    assert code == 1 and "FAIL further load: nothing more is lifted at G" in out and "FAIL lifting: at 20 bar" in out
    overs = "from linkage import Over\nfrom loader import Loader\n\n\nclass Reaching(Loader):\n"
    Path("reaching.py").write_text(f"{overs}    low, high = Over(S=(0.0, 0.1)), Over(S=(0.1, 0.2))\n", encoding="utf-8")
    code, out, _ = said("capacity", "reaching.py", "--count", "3", "--csv", "-")
    head, *rows = csv.reader(io.StringIO(out, newline=""))
    labels = [f"over {name}, under its own loads" for name in ("low", "high") for _ in range(3)]
    assert code == 0 and head[0] == "run" and [row[0] for row in rows] == labels
    further = [float(row[head.index("further load, kN")]) for row in rows]
    along = loader().at(S=[0.0, 0.05, 0.1, 0.1, 0.15, 0.2])
    np.testing.assert_allclose(further, pump.capacity(along, "G") / kN, rtol=1e-12)
    code, _, err = said("capacity", "loader.py", "--machine", "loader.py")
    assert code == 2 and "--machine loader.py: loader.py is no file of a design" in err


@pytest.mark.slow
def test_capacity_of_a_design_in_a_file_is_that_of_its_dimensions(said):
    Path("design.toml").write_text('machine = "loader.py"\n[set]\nOB = 0.25\n', encoding="utf-8")
    designed = said("capacity", "design.toml", "--machine", "loader.py", "--count", "3")
    assert designed == said("capacity", "loader.py", "--set", "OB=0.25", "--count", "3") and designed[0] == 0


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ("table loader.py --ratio Z", "Point or output 'Z' is unknown in Loader. Known: B, G, rise."),
        ("table loader.py --ratio G --wrt T", "Stroke 'T' is unknown in Loader. Known: S."),
        ("table loader.py thrust(lift", "'thrust(lift'"),
        ("table loader.py thrust(left)", "Did you mean lift?"),
        ("table loader.py thrus(lift)", "Did you mean thrust?"),
        ("table loader.py least(rise)", "has no value at every pose"),
        ("table loader.py --case road", "Load case 'road' is unknown in Loader. Known: plain, transport."),
        ("table four_bar --case road", "FourBar declares none; write road = LoadCase('road', scale=...)."),
        ("table loader.py --direction up", "--direction: invalid choice: 'up'"),
        ("table loader.py --drive T", "Stroke 'T' is unknown in Loader. Known: S."),
        ("table loader.py --pins --csv -", "--pins and --limits do not go into CSV"),
        ("table four_bar --pins", "FourBar declares no load, so that no pin carries anything"),
        ("forces four_bar", "FourBar declares no load, so that there is no force"),
        ("forces loader.py --on OBX", "Body 'OBX' is unknown in Loader."),
        ("limits loader.py --at T=3", "Stroke 'T' is unknown in Loader."),
        ("capacity four_bar", "FourBar has no cylinder that could lift; declare one"),
        ("capacity header_balancer", "HeaderBalancer has no cylinder but those that gas feeds"),
        ("capacity crane", "Crane has the cylinders extend, lift, fold; say --cylinder one of them."),
        ("capacity loader.py --cylinder left", "Cylinder 'left' is unknown in Loader. Did you mean lift?"),
        ("capacity loader.py --circuit pum", "LiftCircuit 'pum' is unknown in Loader. Did you mean pump?"),
        ("capacity loader.py --circuit pump --pressure 3bar", "--pressure and --circuit both say what feeds the cylinder"),
        ("capacity loader.py --pressure 3mm", "--pressure: '3mm' is a length"),
        ("capacity loader.py --at-point Q", "Point 'Q' is unknown in Loader."),
        ("capacity loader.py --along 0", "--along 0: two numbers are expected"),
        ("capacity loader.py --along 0,0", "has no length"),
        ("capacity loader.py --share 2", "share = 2 of the pressure is not in 0 to 1"),
        ("show loader.py --units imperial", "--units: invalid choice: 'imperial'"),
        ("show loader.py --language de", "--language: invalid choice: 'de'"),
        ("plot loader.py pressure --limit pressure=3 -o a.png", "--limit pressure=3: write a column, <= or >=, and a value"),
        ("plot loader.py pressure --limit thrust<=3kN -o a.png", "Column 'thrust' is unknown in --limit. Known: pressure."),
        ("plot loader.py pressure --limit pressure<=3mm -o a.png", "--limit pressure: '3mm' is a length"),
        ("plot loader.py --limit pressure<=3bar -o a.png", "--limit, --case and --direction go with curves"),
        ("animate loader.py --column thrust --limit pressure<=3bar -o a.gif", "the curve that runs along is of thrust"),
        ("show excavator --equations --ratio boom.E", "Excavator has 3 strokes: say wrt= one of"),
        ("show loader.toml:Loader", "a file of TOML or JSON holds one machine, and no class is named in it; say loader.toml."),
        ("new 3x", "'3x' gives no name of a class"),
        ("new boom -o boom.txt", "-o boom.txt: the file's name ends in one of .py, .toml"),
        ("new loader", "loader.py is there already and stays as it is"),
        ("new boom -o nowhere/boom.py", "the folder nowhere is not there"),
    ],
)  # fmt: skip
def test_mistakes_are_one_line(said, arguments, words):
    code, out, err = said(*arguments.split())
    assert (code, out) == (2, "")
    assert err.startswith("hydrolinkage: ") and err.count("\n") == 1
    assert words in err


# -- what every command has --------------------------------------------------------------------------------


def test_options_stand_in_any_order(said):
    expected = said("table", "loader.py", "rise", "thrust", "--count", "3", "--set", "OB=310mm", "--units", "us")
    assert expected[0] == 0
    for words in (
        "table --units us --count 3 loader.py rise --set OB=310mm thrust",
        "--units us table --set OB=310mm loader.py --count 3 rise thrust",
        "--units=us table loader.py rise --count 3 thrust --set OB=310mm",
        "table loader.py --set OB=310mm --count 3 --units us rise thrust",
    ):  # fmt: skip
        assert said(*words.split()) == expected


@pytest.mark.slow
def test_one_system_of_units_for_table_and_sentence(said):
    _, plain, _ = said("capacity", "loader.py", "--count", "2")
    code, out, _ = said("capacity", "loader.py", "--count", "2", "--units", "us")
    assert code == 0 and "thrust, lbf" in out and "pressure, psi" in out and f"at {180 * bar / psi:.0f} psi" in out
    cells = [line.split() for line in plain.splitlines()[2:5]], [line.split() for line in out.splitlines()[2:5]]
    (_, *of_plain), (_, *of_us) = cells
    for one, other in zip(of_plain, of_us, strict=True):
        assert float(other[1]) == pytest.approx(float(one[1]) / inch, abs=2e-3)
        assert float(other[3]) == pytest.approx(float(one[3]) * kN / lbf, rel=1e-4)
        assert float(other[4]) == pytest.approx(float(one[4]) * bar / psi, rel=1e-3)
    assert said("table", "loader.py", "pressure", "--set", f"OB={300 * mm / inch!r}in", "--count", "2")[0] == 0


@pytest.mark.slow
def test_russian_is_spoken_when_asked_and_no_longer(said):
    _, english, _ = said("show", "loader.py")
    code, out, _ = said("show", "loader.py", "--language", "ru")
    assert code == 0 and re.search("[\u0430-\u044f]{5}", out)
    assert said("show", "loader.py")[1] == english


@first_daily(0, "command", ["capacity", "show", "table", "forces"])
def test_check_turns_a_failing_verdict_into_an_exit_code(said, command):
    weak = ("--set", "pump.pressure=20bar")
    assert said(command, "loader.py", "--check")[0] == 0
    assert said(command, "loader.py", *weak)[0] == 0
    code, out, err = said(command, "loader.py", *weak, "--check")
    assert (code, err) == (1, "") and "FAIL lifting" in out


@pytest.mark.slow
def test_limits_are_drawn(said, tmp_path):
    drawn = said("plot", "loader.py", "pressure", "thrust", "--limit", "pressure<=50bar", "-o", "a.svg", "--count", "9")
    assert drawn[:2] == (0, "a.svg\n")
    assert "<!-- at most 50bar -->" in (tmp_path / "a.svg").read_text(encoding="utf-8")
    assert said("animate", "loader.py", "--limit", "reserve>=3", "-o", "a.gif", "--count", "3")[:2] == (0, "a.gif\n")


TALKS = """
import sys
from pathlib import Path
from linkage.cli import Command, entry, main, option

@Command("talks", "says much, then writes a file", option("-o", "--output"))
def talks(options):
    for number in range(100_000):
        print("line", number)
    Path("said.txt").write_text("whole")
    return 0

entry.commands_for = lambda arguments: [talks]
sys.exit(main(["talks", *sys.argv[1:]]))
"""


@pytest.mark.parametrize("options", [("-o", "said.txt"), ()])
def test_a_file_that_is_named_is_written_though_nobody_reads_what_is_said(tmp_path, options):
    paths = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    with subprocess.Popen(
        [sys.executable, "-c", TALKS, *options], stdout=subprocess.PIPE, stderr=subprocess.PIPE, cwd=tmp_path, env=paths
    ) as running:
        assert running.stdout.readline() == b"line 0\n"
        running.stdout.close()
        assert (running.wait(), running.stderr.read()) == (141, b"")
    assert (tmp_path / "said.txt").exists() == bool(options)  # without a file there is nothing to go on for


# -- list, new ---------------------------------------------------------------------------------------------


def test_list_groups_by_kind_and_names_the_commands(said):
    _, out, _ = said("list")
    groups = dict(re.findall(r"^(\S[^\n]*)\n((?:  [^\n]*\n)+)", out, re.MULTILINE))
    shipped = {"A forestry crane", "A tractor's three-point hitch", "The grapple of a harvester head", "Shipped machines"}
    shipped |= {"Header balancing of a forage harvester with gas accumulators"}
    assert {*shipped, "Classic linkages", "Machines at work", "Commands"} == set(groups)
    assert "  scotch_yoke " in groups["Classic linkages"] and "  three_point_hitch " in groups["A tractor's three-point hitch"]
    assert re.search("^  capacity +the largest load", groups["Commands"], re.MULTILINE)
    named = [re.findall(r"^  (\S+)", text, re.MULTILINE) for title, text in groups.items() if title != "Commands"]
    assert sorted(name for names in named for name in names) == sorted(listing.registered())


def test_list_fits_the_terminal(monkeypatch):
    class Terminal(io.StringIO):
        def isatty(self):
            return True

    screen = Terminal()
    monkeypatch.setattr(sys, "stdout", screen)
    monkeypatch.setenv("COLUMNS", "60")
    assert main(["list"]) == 0
    assert max(map(len, screen.getvalue().splitlines())) <= 60


@pytest.mark.parametrize("file", ["tipping_arm.py", "tipping_arm.toml"])
def test_a_new_machine_runs_at_once(said, tmp_path, file):
    code, out, _ = said("new", "tipping_arm", "-o", file)
    assert code == 0 and f"hydrolinkage show {file}" in out
    text = (tmp_path / file).read_text(encoding="utf-8")
    assert "TippingArm" in text and text.count("#") > 8 and "$" not in text
    code, out, err = said("show", file, "--check")
    assert (code, err) == (0, "") and "FAIL" not in out and "ok   lifting" in out
    others = ["table", file], ["forces", file, "--case", "transport"], ["limits", file, "--check"], ["capacity", file, "--check"]
    for command in others if file.endswith(".py") else ():
        assert said(*command)[0] == 0


@pytest.mark.parametrize(("name", "cls"), [("loader.toml", "Loader"), ("deep_loader.py", "DeepLoader")])
def test_a_new_machine_takes_the_form_of_its_files_name(said, tmp_path, monkeypatch, name, cls):
    folder = tmp_path / "new"
    folder.mkdir()
    monkeypatch.chdir(folder)
    assert said("new", name)[0] == 0 and [each.name for each in folder.iterdir()] == [name]
    assert find(name).__name__ == cls and said("show", name, "--check")[0] == 0


def test_one_name_for_one_quantity(said):
    """What a hitch calls its capacity has its implement in it; what the command adds to the implement is another quantity."""
    heads = [said(command, "three_point_hitch", "--count", "2")[1] for command in ("table", "capacity")]
    assert "capacity, kN" in heads[0] and "further load" not in heads[0]
    assert "further load, kN" in heads[1] and "capacity, kN" not in heads[1] and "capacity:" not in heads[1]


@pytest.mark.slow
def test_a_verdict_of_capacity_is_over_every_stroke(said, tmp_path):
    """The table runs along the first stroke; what is judged is all strokes, unless --at or --over narrow it."""
    text = LOADER.replace("OG=0.90", "OG=0.90 + t").replace("    A, O =", "    t = Stroke(0.0, 0.5)\n    A, O =")
    (tmp_path / "reaching.py").write_text(text)
    machine = find("reaching.py")()
    pump = machine.plan.members["pump"]
    grid = machine.sweep(S=31, t=31)
    for options, of in (["--over", "S=0:0.25"], grid), ([], grid), (["--at", "t=0.1"], machine.sweep(S=31, t=0.1)):
        _, out, _ = said("capacity", "reaching.py", "--count", "3", *options)
        (found,) = re.findall(r"further load: ([\d.]+) kN", out)
        cases = [np.min(pump.capacity(of, "G", case=case)) for case in (None, "transport")]
        assert float(found) == pytest.approx(float(min(cases)) / kN, abs=0.01)


def test_both_templates_are_one_machine(said):
    assert said("new", "arm", "-o", "arm.toml")[0] == said("new", "arm")[0] == 0
    assert said("table", "arm.toml", "--csv", "-")[1] == said("table", "arm.py", "--csv", "-")[1]
