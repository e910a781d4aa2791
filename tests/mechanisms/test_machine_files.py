"""Every shipped machine as a file: the same plan, positions, forces and pressures to the last bit; the commands take such files."""


import numpy as np
import pytest

from hydraulics import FloatCircuit, LiftCircuit
from linkage import ForceElement, driving_force, pin_forces
from linkage.cli import main
from linkage.files import left_out, load, save, to_json, to_toml
from linkage.units import kgf_cm2
from mechanisms.header_balancer import HEADERS, HeaderBalancer, with_header
from mechanisms.mower_lift import MowerLift
from mechanisms.three_point_hitch import HitchCategory1, HitchCategory2, ThreePointHitch
from tests import shipped
from tests.for_all import first_daily, for_all

SHIPPED = shipped.MACHINES
CLASSES = {**SHIPPED, "hitch 1": HitchCategory1, "hitch 2": HitchCategory2}
DESIGNS = {f"header {number}": with_header(number, n=1.4) for number in HEADERS} | {
    "hitch": ThreePointHitch(**{"OB": 0.32, "M": (0.22, 0.95), "KFG": 1.2, "load.mass": 1500.0, "lift.bore": 0.1, "circuit.flow": 0.002}),
    "mower": MowerLift(BOG=1.88, weight=8000.0, bore=0.09, p_max=200 * kgf_cm2),
    "no atmosphere": HeaderBalancer(**{"atmosphere": 0.0, "pin_O.coefficient": 0.15, "P_I": 40 * kgf_cm2}),
}


def loaded(names):
    """Return the names of machines with loads of their own."""
    return [name for name in names if CLASSES[name].plan.of_kind(ForceElement)]


FEW = (*shipped.DAILY, "hitch 1", "hitch 2")


def positions(design):
    """Return every named value over the strokes, 5 poses of each."""
    axes = {name: np.linspace(stroke.start, stroke.end, 5) for name, stroke in design.strokes.items()}
    motion = design.at(unreachable="nan", **axes)
    return [motion[name] for name in design.plan.valued_members]


def forces(design):
    """Return drive forces, joint forces and pressures over the strokes, along the box's diagonal of several, in each direction."""
    motion = design.at(**{name: np.linspace(stroke.start, stroke.end, 7) for name, stroke in design.strokes.items()})
    ways = [(name, direction) for name in design.strokes for direction in ("frictionless", "extending", "retracting")]
    found = [driving_force(motion, drive=name, direction=direction) for name, direction in ways]
    found += [part for each in pin_forces(motion, direction="extending").joints for part in (each.force, each.couple)]
    found += [each.pressure(motion) for each in design.plan.of_kind(FloatCircuit).values()]
    found += [each.pressure_for(motion) for each in design.plan.of_kind(LiftCircuit).values()]
    return found


def same(first, second):
    """Return whether two lists of arrays are the same to the last bit."""
    return all(np.array_equal(one, two, equal_nan=True) for one, two in zip(first, second, strict=True))


def test_machines_with_loads_are_among_them():
    assert {"three_point_hitch", "mower_lift", "header_balancer", "hitch 1", "hitch 2"} <= set(loaded(FEW))


@for_all("write", [to_toml], slow=[to_json])
@for_all("name", ["hitch 1", "hitch 2"], slow=shipped.MACHINES)  # the others of every day: `tests/linkage/files`
def test_class_comes_back(name, write):
    machine = CLASSES[name]
    back = load(write(machine))
    assert str(back.plan) == str(machine.plan)
    assert back.plan.defaults == machine.plan.defaults
    assert same(positions(back()), positions(machine()))
    assert write(back) == write(machine)


@for_all("write", [to_toml], slow=[to_json])
@for_all("name", lambda: loaded(FEW)[::3], slow=lambda: loaded(CLASSES))
def test_forces_and_pressures_come_back(name, write):
    machine = CLASSES[name]
    assert same(forces(load(write(machine))()), forces(machine()))


@pytest.mark.slow
@for_all("write", [to_toml], slow=[to_json])
@for_all("name", DESIGNS)
def test_design_comes_back(name, write):
    design = DESIGNS[name]
    back = load(write(design))()
    assert back.dimensions == design.dimensions
    assert same(positions(back), positions(design))
    found = forces(back)
    assert same(found, forces(design))
    assert not same(found, forces(type(design)()))
    assert write(type(back)) == write(design)


def test_what_a_file_leaves_out_is_known():
    assert left_out(ThreePointHitch) == ("__init__", "admissible", "columns", "formulas", "rules")
    assert left_out(HeaderBalancer) == ("__init__", "columns", "formulas", "rules")
    assert left_out(MowerLift) == ("__init__", "columns", "formulas")
    assert not any(left_out(machine) for name, machine in SHIPPED.items() if not machine.plan.of_kind(ForceElement))


# -- commands on files -------------------------------------------------------------------------------------


@pytest.fixture
def run(tmp_path, monkeypatch, capsys):
    """Return a function that runs a command in a folder with a file of each machine, and what it says."""
    monkeypatch.chdir(tmp_path)
    for name, machine in {"hitch.toml": ThreePointHitch, "small.json": HitchCategory1, "balancer.toml": HeaderBalancer}.items():
        save(machine, name)

    def runs(*arguments):
        code = main(list(arguments))
        out, err = capsys.readouterr()
        return code, out, err

    return runs


@pytest.mark.slow
def test_plain_commands_take_the_files(run):
    code, out, err = run("show", "balancer.toml")
    assert (code, err) == (0, "")
    assert "lift = Cylinder(A, B, bore=" in out
    code, out, err = run("table", "small.json", "--count", "3")
    assert (code, err, len(out.splitlines())) == (0, "", 4)
    assert run("plot", "balancer.toml", "-o", "picture.png", "--count", "11")[0] == 0
    assert run("animate", "small.json", "-o", "page.html", "--count", "5")[0] == 0


@for_all(("command", "file", "what"), [("hitch", "small.json", "three-point hitch"), ("balance", "balancer.toml", "balanced header")])
def test_a_papers_command_asks_for_the_class(run, command, file, what):
    code, out, err = run(command, file)
    assert (code, out) == (2, "")
    assert f"{file} is no {what}; take a " in err and "with `machine` and `[set]`" in err


def test_save_says_what_is_left_out(run):
    code, out, err = run("save", "three_point_hitch", "own.toml", "--set", "OB=320mm", "--set", "load.mass=1t")
    assert (code, err) == (0, "")
    assert out == (
        "own.toml: the linkage with 25 members.\n"
        "Not in it, since a file holds no functions of a class: __init__, admissible, columns, formulas, rules.\n"
    )
    assert load("own.toml")().dimensions == ThreePointHitch(**{"OB": 0.32, "load.mass": 1000.0}).dimensions
    assert run("save", "klann", "klann.json") == (0, f"klann.json: the linkage with {len(SHIPPED['klann'].plan.members)} members.\n", "")
    assert "ends in .toml or .json" in run("save", "klann", "klann.xml")[2]


@first_daily(0, ("command", "machine", "setting"), [
    ("grapple", "grapple", ("bore", "63mm")), ("hitch", "three_point_hitch", ("OB", "320mm")),
    ("balance", "header_balancer", ("charge", "40kgf_cm2")),
])  # fmt: skip
def test_commands_of_a_kind_take_a_file_of_a_design(command, machine, setting, tmp_path, capsys):
    """What a page copies, `machine` and `[set]`: as the command with the same `--set`, and the class of `--machine`."""
    file, (name, value) = tmp_path / "design.toml", setting
    file.write_text(f'machine = "{machine}"\n[set]\n{name} = "{value}"\n', encoding="utf-8")
    wanted = main([command, machine, "--set", f"{name}={value}", "--count", "3"]), capsys.readouterr().out
    given = main([command, str(file), "--count", "3"]), capsys.readouterr().out
    assert given == wanted
    assert main([command, machine, "--machine", machine]) == 2
    assert "is no file of a design" in capsys.readouterr().err


def test_a_file_of_a_design_and_options_that_contradict_it_are_refused(tmp_path, capsys):
    file = tmp_path / "design.toml"
    file.write_text('machine = "three_point_hitch"\n[set]\nOB = "320mm"\n', encoding="utf-8")
    assert main(["hitch", str(file), "--category", "1"]) == 2 and "has dimensions of its own" in capsys.readouterr().err
    file.write_text('machine = "header_balancer"\n[set]\nm1 = 1600.0\n', encoding="utf-8")
    assert main(["balance", str(file), "--table"]) == 2 and "has dimensions of its own" in capsys.readouterr().err
    assert main(["show", str(file), "--set", "m1=-3"]) == 2 and "m1 = -3 is not above zero" in capsys.readouterr().err
    assert main(["grapple", "--design", "--machine", "grapple"]) == 2 and "holds a design" in capsys.readouterr().err
