"""What makes no sense is refused where it is given, in words that name it and say what to write: public doors, each with nonsense."""

import re

import numpy as np

from hydraulics import (
    Accumulator,
    AccumulatorBlock,
    Buckling,
    Cylinder,
    CylinderSize,
    FloatCircuit,
    HoldingValve,
    LiftCircuit,
    OilLine,
    Pump,
    Tank,
    Telescope,
    capacity,
    polytropic,
)
from linkage import (
    RIGHT,
    Actuator,
    Crank,
    Damper,
    Dimension,
    Dyad,
    Force,
    Ground,
    Guide,
    GuideFriction,
    LinkageError,
    LinkMass,
    LoadCase,
    Mechanism,
    Moment,
    OnGuide,
    OnLink,
    Outline,
    Over,
    Part,
    PinFriction,
    Planes,
    Pulley,
    Rope,
    Spring,
    Stroke,
    Support,
    Target,
    Weight,
    animate,
    around,
    at,
    bar,
    deg,
    draw,
    drawn,
    drive_force,
    driving_force,
    equations,
    gap,
    kN,
    mm,
    most,
    optimise,
    page,
    plot,
    ref,
    report,
    strokes_for,
    y,
)
from linkage import angle as angle_of
from linkage.cli import main
from linkage.files.expression import measure_said
from linkage.mobility import grashof
from linkage.study import Tolerance, monte_carlo, settings_for, sobol, tornado
from linkage.synthesis import PathTask, PoseTask
from linkage.units import litre


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
GAS = AccumulatorBlock([Accumulator(1e-3, 60 * bar)])
FORCE = most(abs(drive_force()))
KINDS = {
    "Weight, force": (lambda: Weight("T", mass=12 * kN), "mass=12000 was given as a force"),
    "Weight, length": (lambda: Weight("T", mass=12 * mm), r"a length; expected is a value of mass, such as 250 \* kg"),
    "LinkMass": (lambda: LinkMass("O B", mass=3 * bar), "mass=300000 was given as a pressure"),
    "LoadCase, slope": (lambda: LoadCase(slope=100 * mm), r"slope=0.1 was given as a length; expected is a value of angle"),
    "LoadCase, scale": (lambda: LoadCase(scale={"w": 2 * mm}), "w=0.002 was given as a length; expected is a number"),
    "Force": (lambda: Force("T", (5 * bar, 0.0)), "x=500000 was given as a pressure"),
    "Moment": (lambda: Moment("O B", M=3 * deg), "an angle"),
    "Spring, litres": (lambda: Spring("A", "B", stiffness=20 * litre, free_length=0.3), "stiffness=0.02 was given as a volume"),
    "Damper, volume": (lambda: Damper("A", "B", coefficient=20 * litre), "coefficient=0.02 was given as a volume"),
    "Spring, length": (lambda: Spring("A", "B", stiffness=2e4, free_length=3 * kN), "free_length=3000 was given as a force"),
    "Spring, preload": (lambda: Spring("A", "B", stiffness=2e4, preload=3 * mm), "preload=0.003 was given as a length"),
    "Spring, stiffness": (lambda: Spring("A", "B", stiffness=3 * mm, free_length=0.3), "stiffness=0.003 was given as a length"),
    "Damper": (lambda: Damper("A", "B", coefficient=3 * mm), "coefficient=0.003 was given as a length"),
    "Actuator": (lambda: Actuator("A", "B", force=3 * bar), "force=300000 was given as a pressure"),
    "Support": (lambda: Support("T", (0, 1), force=3 * mm), "force=0.003 was given as a length"),
    "PinFriction, radius": (lambda: PinFriction("T", radius=3 * deg, coefficient=0.1), "radius=0.0523599 was given as an angle"),
    "PinFriction, coefficient": (lambda: PinFriction("T", radius=0.02, coefficient=3 * deg), "coefficient=0.0523599 was given as an angle"),
    "GuideFriction": (lambda: GuideFriction("T", 3 * mm), "coefficient=0.003 was given as a length"),
    "Spring, volume": (lambda: Spring("A", "B", stiffness=2e4, free_length=3 * litre), "free_length=0.003 was given as a volume"),
    "PinFriction, volume": (lambda: PinFriction("T", radius=3 * litre, coefficient=0.1), "radius=0.003 was given as a volume"),
    "gap, volume": (lambda: gap("OB", "A", width=3 * litre), "was given as a volume; expected is a value of length"),
    "Pulley": (lambda: Pulley("T", 3 * kN, 1), "radius=3000 was given as a force"),
    "Rope": (lambda: Rope("A", "T", "B", length=3 * kN), "length=3000 was given as a force"),
    "Rope, weights": (lambda: Rope("A", "T", "B", length=3, weights=[2 * kN, 1]), "weights=2000 was given as a force"),
    "hours": (lambda: most(drive_force(), case={"full": 3 * mm, "empty": 2}), "full=0.003 was given as a length"),
    "capacity": (lambda: capacity("ram", "T", share=300 * mm), "share=0.3 was given as a length"),
    "CylinderSize": (lambda: CylinderSize(80 * deg, 0.04), "Bore=1.39626 was given as an angle"),
    "CylinderSize, thrust": (lambda: Arm.ram.size.thrust(180 * kN), "a force; expected is a value of pressure"),
    "CylinderSize, oil": (lambda: Arm.ram.size.oil(18 * deg), "an angle; expected is a value of length"),
    "Buckling": (lambda: Buckling(0.04, modulus=210 * kN), "Modulus=210000 was given as a force"),
    "polytropic": (lambda: polytropic(1.2 * mm), "a length; expected is a number in SI, without a unit"),
    "efficiency": (lambda: driving_force(ARM.sweep(2), direction="extending", efficiency=900 * mm), "efficiency=0.9 was given as a length"),
    "PinFriction, percent": (lambda: PinFriction("T", radius=0.02, coefficient=15), "coefficient=15 is more than any friction; write 0.15"),
    "PinFriction, of a design": (lambda: type("Worn", (Arm,), {"f": PinFriction("O", 0.03, 0.1)})(**{"f.coefficient": 15}), "write 0.15"),
    "LiftCircuit, of a design": (lambda: Arm(**{"line.mechanical_efficiency": 3}), "efficiency=3: an efficiency lies between 0 and 1"),
    "Support, percent": (lambda: Support("T", (0, 1), friction=60), "friction=60 is more than any friction"),
    "Cylinder, bore": (lambda: Cylinder("A", "B", bore=60 * bar, rod=0.03), r"bore=6e\+06 was given as a pressure"),
    "Cylinder, stroke": (lambda: Cylinder("A", "B", bore=0.06, rod=0.03, stroke=10 * deg), "stroke=0.174533 was given as an angle"),
    "Telescope": (lambda: Telescope("A", "B", bores=[3 * bar], strokes=[0.5], closed=0.6), "bores=300000 was given as a pressure"),
    "Accumulator": (lambda: Accumulator(2e-3, 40 * kN), "charge=40000 was given as a force"),
    "OilLine": (lambda: OilLine("ram.rod_side", oil=3 * mm), "oil=0.003 was given as a length"),
    "Pump": (lambda: Pump(200 * kN), "pressure=200000 was given as a force"),
    "Tank": (lambda: Tank(200 * mm), "pressure=0.2 was given as a length"),
    "LiftCircuit": (lambda: LiftCircuit("ram", pressure=200 * kN), "pressure=200000 was given as a force"),
    "HoldingValve, ratio": (lambda: HoldingValve("line", "ram", setting=200 * bar, ratio=4 * kN), "ratio=4000 was given as a force"),
    "Pump, power": (lambda: Pump(200 * bar, power=5 * kN), "power=5000 was given as a force"),
    "FloatCircuit, exponent": (lambda: FloatCircuit("ram", GAS, charge_pressure=80 * bar, exponent=1.4 * kN), "exponent=1400 was given as"),
    "OilLine, exponent": (lambda: OilLine("ram", GAS, charge_pressure=80 * bar, exponent=1.4 * kN), "exponent=1400 was given as a force"),
    "LiftCircuit, percent": (lambda: LiftCircuit("ram", pressure=2e7, mechanical_efficiency=85), "is above 1; .* write 0.85 for 85 %"),
    "efficiency of a design, percent": (lambda: Arm(**{"line.mechanical_efficiency": 92.5}), "write 0.925 for 92.5 %"),
    "HoldingValve": (lambda: HoldingValve("line", "ram", setting=200 * kN, ratio=4.0), "setting=200000 was given as a force"),
}  # fmt: skip


class Boom(Mechanism):
    """A rack with a boom on its pinion: one stroke is a length, one an angle, one a length by a factor alone."""

    z, phi, turn = Stroke(0.0, 0.2), Stroke(0.2, 0.9), Stroke(0.0, 1.0)
    O = Ground(0.0, 0.0)
    rail, post = Guide(O, angle=90 * deg), Guide(O, angle=0)
    C = OnGuide(rail, at=0.4 + z)
    D = OnGuide(post, at=0.6 + 0.05 * turn)
    P = Crank(C, CP=0.5, angle=30 * deg + phi)


def amounts(folder):
    """Return calls of public doors with amounts of another kind than is expected, each with words of its refusal."""
    AT = dict(z=0.1, phi=0.5, turn=0.2)
    length, angle = "given as an angle; expected is a value of length", "given as a length; expected is a value of angle"
    one = dict(minimise=FORCE, starts=1)

    def made(**members):
        return type("Made", (Arm,), members)

    def boom(**members):
        return type("Made", (Boom,), members)

    return {
        "at": (lambda: ARM.at(S=5 * deg), length), "at, list": (lambda: ARM.at(S=[0.0, 5 * deg]), length),
        "at, angle": (lambda: Boom().at(**AT | dict(phi=20 * mm)), angle),
        "sweep": (lambda: Boom().sweep(z=5, phi=20 * mm, turn=0.0), angle),
        "assemblies": (lambda: ARM.assemblies(S=5 * deg), length),
        "Over": (lambda: ARM.answers([FORCE], over=Over(S=(0, 10 * deg))), length),
        "Over, held": (lambda: Boom().answers([most(y("P"))], over=Over(phi=2 * mm)), angle),
        "Over.path": (lambda: ARM.judge(Over.path(S=[0, 5 * deg, 0.1])), length),
        "over=": (lambda: ARM.judge({"S": (0, 3 * deg)}), length),
        "Over, only": (lambda: ARM.judge(Over(only=[y("T") <= 20 * deg])), length),
        "Over, only turned": (lambda: ARM.judge(Over(only=[3 * mm >= angle_of("O", "T")])), angle),
        "Over, of the class": (lambda: made(lifts=Over(S=(0, 5 * deg)))().verdicts(), length),
        "Target": (lambda: strokes_for(ARM, [Target(y("T"), 20 * deg)]), length),
        "Target, within": (lambda: strokes_for(ARM, [Target(y("T"), 0.2, within=1 * deg)]), length),
        "Target, path": (lambda: ARM.follow([Target(y("T"), [20 * deg, 30 * deg])]), length),
        "Target, pose": (lambda: settings_for(ARM, {"OB": (0.5, 0.7)}, [Target(y("T"), 0.2, S=2 * deg)]), length),
        "hold": (lambda: strokes_for(Boom(), [Target(y("P"), 0.7)], hold={"phi": 3 * mm, "turn": 0.0}), angle),
        "design": (lambda: Arm(OB=30 * deg), length), "design, batch": (lambda: Arm(OB=[30 * deg, 40 * deg]), length),
        "design, point": (lambda: Arm(A=(0.5, 3 * bar)), "given as a pressure; expected is a value of length"),
        "design, load": (lambda: Arm(**{"w.mass": 2 * kN}), "given as a force; expected is a value of mass"),
        "design, circuit": (lambda: ARM.replaced(**{"line.pressure": 20 * kN}), "given as a force; expected is a value of pressure"),
        "Stroke": (lambda: made(S=Stroke(0, 30 * bar)), "given as a pressure"), "Stroke, use": (lambda: made(S=Stroke(0, 9 * deg)), length),
        "Stroke, as both": (lambda: boom(P=Crank("C", CP=0.5, angle=ref("z"))), "z is an angle in P = Crank.*=z., and a length is"),
        "link, as both": (lambda: boom(Q=Dyad("C", "P", CQ=ref("phi"), PQ=0.4, side=RIGHT)), "write r . phi for the length, phi . r"),
        "OnGuide, angle": (lambda: boom(E=OnGuide("post", at=angle_of("C", "P"))), "angle.C, P. is an angle, and a length is expected"),
        "Crank, length": (lambda: boom(E=Crank("D", DE=0.1, angle=y("P"))), "is a length, and an angle is expected; on a radius r "),
        "Stroke, turning": (lambda: boom(phi=Stroke(0, 200 * mm)), angle), "drawn": (lambda: made(s=drawn(S=3 * deg)), length),
        "Dimension": (lambda: made(L=Dimension(30 * deg), B=Dyad("A", "O", AB=ref("L") + ref("S"), OB=0.6, side=RIGHT)), length),
        "Dimension, unit": (lambda: made(L=Dimension(30 * deg, unit="mm")), length),
        "Dimension, angle": (lambda: boom(L=Dimension(30 * mm), P=Crank("C", CP=0.5, angle=ref("L") + ref("phi"))), angle),
        "Ground": (lambda: made(O=Ground(10 * deg, 0)), length),
        "Ground, sum": (lambda: made(L=Dimension(0.1), O=Ground(0, ref("L") + 1 * deg)), length),
        "Dyad": (lambda: made(B=Dyad("A", "O", AB=0.6 + ref("S"), OB=30 * deg, side=RIGHT)), length),
        "Dyad, sum": (lambda: made(B=Dyad("A", "O", AB=30 * deg + ref("S"), OB=0.6, side=RIGHT)), length),
        "Dyad, near": (lambda: made(B=Dyad("A", "O", AB=0.6 + ref("S"), OB=0.6, near=(0.5, 3 * deg))), length),
        "Crank": (lambda: boom(P=Crank("C", CP=0.5, angle=30 * mm + ref("phi"))), angle),
        "OnLink": (lambda: made(T=OnLink("O", "B", OT=1.2, BOT=20 * mm)), angle),
        "OnLink, arm": (lambda: made(T=OnLink("O", "B", OT=1 * bar)), "given as a pressure"),
        "Guide": (lambda: boom(rail=Guide("O", angle=90 * mm)), angle),
        "Guide, origin": (lambda: boom(rail=Guide((0, 1 * deg), angle=0)), length),
        "Part": (lambda: type("Two", (Mechanism,), dict(a=Part(Arm, OB=30 * deg))), length),
        "Part, at": (lambda: Part(Arm, at=(0, 3 * deg)), length), "Part, angle": (lambda: Part(Arm, angle=3 * mm), angle),
        "Outline": (lambda: Outline([(0, 0), (1, 0), (1, 3 * deg)]), length),
        "Outline.circle": (lambda: Outline.circle((0, 0), 3 * deg), length),
        "gap": (lambda: gap("OB", "A", width=3 * deg), length), "Planes": (lambda: Planes("O B", width=3 * deg), length),
        "lowering": (lambda: Arm.line.lowering(ARM.sweep(3), resistance=3 * kN), "given as a force; expected is a value of pressure"),
        "gravity": (lambda: LoadCase(gravity=(0, -9.81 * mm)), "given as a length; expected is a number in SI"),
        "vary": (lambda: optimise(ARM, vary={"OB": (16 * deg, 40 * deg)}, **one), length),
        "vary, choices": (lambda: optimise(ARM, vary={"OB": [0.5, 40 * deg]}, **one), length),
        "around": (lambda: optimise(ARM, vary={"O": around(3 * deg)}, **one), length),
        "around, step": (lambda: optimise(ARM, vary={"OB": around(3 * mm, 1 * deg)}, **one), length),
        "over of a study": (lambda: optimise(ARM, vary={"OB": around(3 * mm)}, over={"S": (0, 3 * deg)}, **one), length),
        "page, vary": (lambda: page(ARM, folder / "a.html", vary={"OB": (5 * deg, 40 * deg)}), length),
        "plot, limits": (lambda: plot(ARM, ["T_y"], limits={"T_y": (20 * deg, "most")}), length),
        "report, limits": (lambda: report(ARM, folder / "a.md", limits={"T_y": (20 * deg, "most")}, count=3), length),
        "report, at": (lambda: report(ARM, folder / "a.md", at={"S": (0, 5 * deg)}, count=3), length),
        "evaluate": (lambda: ARM.evaluate(["T"], S=5 * deg), length), "function": (lambda: ARM.function(["T"])(5 * deg), length),
        "function, named": (lambda: ARM.function(["T"])(S=5 * deg), length),
        "moved": (lambda: ARM.at(S=0.1).moved(dict(S=3 * deg)), length),
        "draw": (lambda: draw(ARM, at={"S": 3 * deg}), length),
        "follow, start": (lambda: Boom().follow([Target(y("P"), [0.7])], hold={"phi": 0.5, "turn": 0.0}, start={"z": 3 * deg}), length),
        "settings_for": (lambda: settings_for(ARM, "OB", y("T"), 20 * deg, between=(0.5, 0.7), S=0.1), length),
        "settings_for, between": (lambda: settings_for(ARM, "OB", y("T"), 0.2, between=(0.5, 40 * deg), S=0.1), length),
        "FloatCircuit, at": (lambda: made(line=None, gas=FloatCircuit("ram", GAS, charge_pressure=8e6, at=3 * deg))().verdicts(), length),
        "LinkMass, at": (lambda: LinkMass("O B", mass=3, at=(0.1, 3 * deg)), length),
        "grashof": (lambda: grashof(0.1, 0.2, 0.3, 3 * deg), length),
        "PathTask": (lambda: PathTask([(0, 0), (1, 3 * deg)], of="T"), length),
        "PoseTask": (lambda: PoseTask([0, 1], [0, 1], [0.1, 3 * mm], of="O B"), angle),
        "regions": (lambda: optimise(ARM, vary={"O": around(3 * mm)}, regions={"O": [(0, 0), (1, 0), (1, 3 * deg)]}, **one), length),
        "OilLine, filled": (lambda: OilLine("ram.piston_side", filled=dict(ram=3 * deg)), length),
        "measure": (lambda: ARM.answers([at(y("T"), S=3 * deg)]), length),
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


def test_amounts_of_another_kind_are_refused_at_every_door(tmp_path):
    assert not failures(amounts(tmp_path))


def test_amounts_of_the_right_kind_and_plain_numbers_are_taken():
    assert ARM.at(S=[0 * mm, 50 * mm]).shape == (2,) and Boom().at(z=20 * mm, phi=20 * deg, turn=20 * deg).shape == ()
    turned = type("Turned", (Boom,), {"turn": Stroke(0.0, 90 * deg)})  # a factor alone makes a length of it: its own unit says what it is
    assert not failures({"turn": (lambda: turned().at(z=0.0, phi=0.5, turn=3 * mm), "given as a length; expected is a value of angle")})
    assert Arm(OB=[500 * mm, 0.6], A=(400 * mm, -0.5))["OB"].tolist() == [0.5, 0.6]
    assert ARM.replaced(OB=0.5 + 3 * deg)["OB"] == 0.5 + 3 * deg
    sums = type("Sums", (Arm,), {"L": Dimension(600 * mm), "B": Dyad("A", "O", AB=ref("L") + ref("S"), OB=0.6, side=RIGHT)})
    assert str(sums.plan.members["L"]) == "Dimension(0.6)" and (sums().at(S=0.1)["T"] == ARM.at(S=0.1)["T"]).all()
    assert strokes_for(ARM, [Target(y("T"), 600 * mm, within=1 * mm)]).strokes.shape == (1, 1)
    assert str(Over(S=(0, 50 * mm), only=[y("T") <= 2])) == "Over(S=(0.0, 0.05), only=[y(T) <= 2])"


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
