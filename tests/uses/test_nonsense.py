"""What makes no sense is refused where it is given, in words that name it and say what to write: public doors, each with nonsense."""

import re

import numpy as np

from hydraulics import Accumulator, Cylinder, HoldingValve, LiftCircuit, OilLine, Pump, Tank, Telescope
from linkage import (
    RIGHT,
    Actuator,
    Damper,
    Dyad,
    Force,
    Ground,
    GuideFriction,
    LinkageError,
    LinkMass,
    LoadCase,
    Mechanism,
    Moment,
    OnLink,
    PinFriction,
    Pulley,
    Rope,
    Spring,
    Stroke,
    Support,
    Weight,
    animate,
    around,
    bar,
    deg,
    draw,
    drive_force,
    equations,
    kN,
    mm,
    most,
    optimise,
    page,
    plot,
    report,
)
from linkage.cli import main
from linkage.files.criterion import measure_said
from linkage.study import Tolerance, monte_carlo, sobol, tornado


class Arm(Mechanism):
    """A lever lifted by a cylinder."""

    S = Stroke(0.0, 0.25)
    A, O = Ground(0.5, -0.5), Ground(0.0, 0.0)
    B = Dyad(A, O, AB=0.6 + S, OB=0.6, side=RIGHT)
    T = OnLink(O, B, OT=1.2)
    w = Weight(T, mass=200)
    ram = Cylinder(A, B, bore=60 * mm, rod=35 * mm)
    line = LiftCircuit(ram, pressure=200 * bar)


ARM = Arm()
FORCE = most(abs(drive_force()))
KINDS = {
    "Weight, force": (lambda: Weight("T", mass=12 * kN), "mass=12000 was given as a force"),
    "Weight, length": (lambda: Weight("T", mass=12 * mm), r"a length; expected is a value of mass, such as 250 \* kg"),
    "LinkMass": (lambda: LinkMass("O B", mass=3 * bar), "mass=300000 was given as a pressure"),
    "LoadCase, slope": (lambda: LoadCase(slope=100 * mm), r"slope=0.1 was given as a length; expected is a value of angle"),
    "LoadCase, scale": (lambda: LoadCase(scale={"w": 2 * mm}), "w=0.002 was given as a length; expected is a number"),
    "Force": (lambda: Force("T", (5 * bar, 0.0)), "x=500000 was given as a pressure"),
    "Moment": (lambda: Moment("O B", M=3 * deg), "an angle"),
    "Spring, length": (lambda: Spring("A", "B", stiffness=2e4, free_length=3 * kN), "free_length=3000 was given as a force"),
    "Spring, preload": (lambda: Spring("A", "B", stiffness=2e4, preload=3 * mm), "preload=0.003 was given as a length"),
    "Spring, stiffness": (lambda: Spring("A", "B", stiffness=3 * mm, free_length=0.3), "stiffness=0.003 was given as a length"),
    "Damper": (lambda: Damper("A", "B", coefficient=3 * mm), "coefficient=0.003 was given as a length"),
    "Actuator": (lambda: Actuator("A", "B", force=3 * bar), "force=300000 was given as a pressure"),
    "Support": (lambda: Support("T", (0, 1), force=3 * mm), "force=0.003 was given as a length"),
    "PinFriction, radius": (lambda: PinFriction("T", radius=3 * deg, coefficient=0.1), "radius=0.0523599 was given as an angle"),
    "PinFriction, coefficient": (lambda: PinFriction("T", radius=0.02, coefficient=3 * deg), "coefficient=0.0523599 was given as an angle"),
    "GuideFriction": (lambda: GuideFriction("T", 3 * mm), "coefficient=0.003 was given as a length"),
    "Pulley": (lambda: Pulley("T", 3 * kN, 1), "radius=3000 was given as a force"),
    "Rope": (lambda: Rope("A", "T", "B", length=3 * kN), "length=3000 was given as a force"),
    "Cylinder, bore": (lambda: Cylinder("A", "B", bore=60 * bar, rod=0.03), r"bore=6e\+06 was given as a pressure"),
    "Cylinder, stroke": (lambda: Cylinder("A", "B", bore=0.06, rod=0.03, stroke=10 * deg), "stroke=0.174533 was given as an angle"),
    "Telescope": (lambda: Telescope("A", "B", bores=[3 * bar], strokes=[0.5], closed=0.6), "bores=300000 was given as a pressure"),
    "Accumulator": (lambda: Accumulator(2e-3, 40 * kN), "charge=40000 was given as a force"),
    "OilLine": (lambda: OilLine("ram.rod_side", oil=3 * mm), "oil=0.003 was given as a length"),
    "Pump": (lambda: Pump(200 * kN), "pressure=200000 was given as a force"),
    "Tank": (lambda: Tank(200 * mm), "pressure=0.2 was given as a length"),
    "LiftCircuit": (lambda: LiftCircuit("ram", pressure=200 * kN), "pressure=200000 was given as a force"),
    "HoldingValve": (lambda: HoldingValve("line", "ram", setting=200 * kN, ratio=4.0), "setting=200000 was given as a force"),
}  # fmt: skip


def doors(folder):
    """Return calls of public doors with nonsense, each with words of its refusal."""
    study = dict(vary={"OB": around(30 * mm)}, starts=1)
    negative = {
        f"{door.__name__} count={count}": (lambda door=door, count=count: door(ARM, folder / "a.html", count=count), "count=")
        for door in (page, animate) for count in (-3, 0, 1.5)
    }  # fmt: skip
    return negative | {
        "report, start": (lambda: report(ARM, folder / "a.md", start=-1), "start=-1: .* from 1 on"),
        "equations, start": (lambda: equations(ARM, start=0), "start=0: .* from 1 on"),
        "equations, wrt": (lambda: equations(ARM, wrt="zz"), "Stroke 'zz' is unknown in Arm. Known: S"),
        "equations, ratio": (lambda: equations(ARM, ratio="zz"), "zz"),
        "page, out of reach": (lambda: page(ARM, folder / "a.html", vary={"OB": (5, 6)}), r"leaves out the design's own value, 0.6"),
        "page, unknown": (lambda: page(ARM, folder / "a.html", vary={"zz": (5, 6)}), "Dimension 'zz' is unknown"),
        "plot, unknown": (lambda: plot(ARM, "zz"), "zz"),
        "draw, unknown": (lambda: draw(ARM, path=["zz"]), "zz"),
        "sweep": (lambda: ARM.sweep(-3), "-3"),
        "at": (lambda: ARM.at(zz=3), "zz"),
        "robust, too large": (lambda: optimise(ARM, minimise=FORCE, robust={"OB": 1.0}, **study), "OB: a tolerance of 1 m is too large"),
        "robust, coordinate": (lambda: optimise(ARM, minimise=FORCE, robust={"O": 5.0}, **study), "O.x: a tolerance of 5 m is too large"),
        "robust, kind": (lambda: optimise(ARM, minimise=FORCE, robust={"OB": 1 * deg}, **study), "OB=0.0174533 was given as an angle"),
        "robust, negative": (lambda: optimise(ARM, minimise=FORCE, robust={"OB": -0.001}, **study), "is no tolerance"),
        "robust, unknown": (lambda: optimise(ARM, minimise=FORCE, robust={"zz": 0.001}, **study), "Dimension 'zz' is unknown"),
        "monte_carlo": (lambda: monte_carlo(ARM, FORCE, {"OB": 1.0}), "OB: a tolerance of 1 m is too large"),
        "sobol": (lambda: sobol(ARM, FORCE, {"OB": (-1.0, 0.0)}), "OB: a tolerance of 1 m is too large"),
        "tornado": (lambda: tornado(ARM, FORCE, {"OB": Tolerance(1.0)}), "OB: a tolerance of 1 m is too large"),
        "minimise": (lambda: optimise(ARM, minimise="1", **study), "Name '1' is unknown"),
        "starts": (lambda: optimise(ARM, minimise=FORCE, vary={"OB": around(30 * mm)}, starts=-1), "starts"),
        **{
            f"vary {name} {ends}": (lambda name=name, ends=ends: optimise(ARM, minimise=FORCE, vary={name: ends}, starts=1), "is no range")
            for name, ends in {
                "OB": (0.6, np.nextafter(0.6, 1.0)), "O.x": (0.0, 1e-300), "A": around(1e-300), "w.mass": (1e-300, 2e-300),
            }.items()
        },
    }  # fmt: skip


def failures(calls):
    """Return what was not refused, or not in the words that are expected."""
    found = []
    for name, (call, words) in calls.items():
        try:
            call()
            found.append(f"{name}: accepted")
        except LinkageError as error:
            found += [] if re.search(words, " ".join(str(error).split())) else [f"{name}: {error}"]
        except Exception as error:
            found.append(f"{name}: raw {type(error).__name__}: {error}")
    return found


def test_amounts_of_another_kind_are_refused_by_every_element():
    assert not failures(KINDS)
    assert Moment("O B", M=5 * kN).M == 5000.0 and Weight("T", mass=250).mass == 250  # kN m; SI without a unit


def test_doors_refuse_what_makes_no_sense(tmp_path):
    assert not failures(doors(tmp_path))


def test_a_study_in_a_file_does_not_minimise_a_number():
    calls = {text: (lambda text=text: measure_said(text, ARM), "the same for every design") for text in ("1", "2 * 3", "1.5 m")}
    assert not failures(calls)


def test_a_class_with_arguments_of_its_own_is_refused_in_words_by_a_command(tmp_path, capsys):
    text = "    def __init__(self, size): super().__init__()\n"
    (tmp_path / "own.py").write_text(f"from tests.uses.test_nonsense import Arm\nclass Own(Arm):\n{text}", encoding="utf-8")
    for command in ("show", "table", "limits"):
        assert main([command, f"{tmp_path / 'own.py'}:Own"]) == 2
        assert "Own.__init__: missing a required argument: 'size'; a command gives only what --set says" in capsys.readouterr().err
