"""A step and force elements from outside the package get all that the shipped ones get, and the shipped ones have no more."""

import inspect
import json
import shutil
import subprocess
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

import linkage.steps
from docs.extending.forces import GasStrut, Soil
from docs.extending.roller_cam import RollerCam
from linkage import (
    LEFT,
    RIGHT,
    Crank,
    DefinitionError,
    Dimension,
    Force,
    Ground,
    Guide,
    Mechanism,
    SliderDyad,
    Spring,
    Stroke,
    Weight,
    deg,
    draw,
    drive_force,
    driving_force,
    equations,
    page,
    pin_force,
    pin_forces,
    ratio,
)
from linkage.files import load, to_json, to_toml
from linkage.pictures.scene import Scene
from linkage.program import RunOptions
from tests.benchmarks.c_reference import POINTER, address, built, has_compiler
from tests.linkage.program.test_backends import agree, as_loop, by_nodes, everything
from tests.members import unpacked


def rise(share):
    """Return the 3-4-5 polynomial."""
    share = np.clip(share, 0.0, 1.0)
    return share**3 * (10.0 - 15.0 * share + 6.0 * share**2)


ANGLES = np.linspace(0.0, 2.0 * np.pi, 49)
LIFTS = 0.02 * (rise(ANGLES / (120 * deg)) - rise((ANGLES - 180 * deg) / (120 * deg)))


class Valve(Mechanism):
    """A cam lifts a loaded slide beside its axis against a spring."""

    phi = Stroke(0.0, 2.0 * np.pi)
    r0 = Dimension(0.04)
    O = Ground(0.0, 0.0)
    A = Crank(O, OA=0.03, angle=phi)
    rail = Guide((0.008, 0.0), angle=80 * deg)
    R = RollerCam(O, A, rail, base=r0, angles=ANGLES, lifts=LIFTS)
    T = Ground(0.03, 0.16)
    spring = Spring(R, T, stiffness=4e3, free_length=0.13)
    load = Weight(R, mass=5)


class Rod(Valve):
    """The follower is a rod that runs on its rail with two points, and is pushed aside."""

    B = SliderDyad("R", "rail", RB=0.08, side=RIGHT)
    aside = Force("B", (50.0, 0.0))


class Loose(Valve):
    """The spring pulls."""

    spring = Spring("R", "T", stiffness=2e3, free_length=0.09)


MOTION = Valve().sweep(73)


# -- a step ------------------------------------------------------------------------------------------------


def test_the_class_is_short():
    assert len(inspect.getsource(RollerCam).splitlines()) <= 70


def test_places_follow_the_table():
    way = MOTION["R"] - np.array([0.008, 0.0])[:, None]
    along = np.array([np.cos(80 * deg), np.sin(80 * deg)])
    assert_allclose(along[0] * way[1] - along[1] * way[0], 0.0, atol=1e-15)
    at_rows = Valve().at(phi=80 * deg + ANGLES)
    assert_allclose(np.hypot(*(at_rows["R"] - np.array([0.008, 0.0])[:, None])), 0.04 + LIFTS, atol=1e-14)


@pytest.mark.parametrize("order", [1, 2])
def test_ratios_are_exact(order):
    phi, step = np.linspace(0.01, 6.2, 60), 1e-5  # between the rows, where the third derivative jumps
    exact = Valve().at(phi=phi).ratio("R", order=order)
    sides = [Valve().at(phi=phi + k * step) for k in (-1, 1)]
    low, high = (each["R"] if order == 1 else each.ratio("R") for each in sides)
    assert_allclose((high - low) / (2.0 * step), exact, atol=1e-10)
    if order == 1:
        assert_allclose(MOTION.ratio("R", method="central"), MOTION.ratio("R"), atol=1e-12)


@pytest.mark.parametrize("variable", ["r0", "rail.x", "rail.angle", "OA"])
def test_gradients_are_exact(variable):
    asked, at, step = ["R", ratio("R"), drive_force(), pin_force("O")], {"phi": np.linspace(0.2, 6.0, 9)}, 1e-6
    value = Valve().dimensions[variable]
    low, high = (Valve(**{variable: value + k * step}).evaluate(asked, **at) for k in (-1, 1))
    for each, below, above in zip(asked, low, high, strict=True):
        (exact,) = Valve().at(**at).gradient(each, wrt=[variable])
        assert_allclose(exact, (above - below) / (2.0 * step), rtol=1e-6, atol=1e-5 * max(1.0, np.abs(above).max()))


def test_every_way_to_run_a_program_agrees():
    kernel, inputs = everything(Valve), Valve().at(phi=np.linspace(-7.0, 14.0, 300))._grid.flat
    wanted = by_nodes(kernel, inputs)
    agree(kernel(inputs, way=RunOptions("numpy")).values[:, 0], wanted)
    agree(kernel(inputs, way=RunOptions("floats")).values[:, 0], wanted)
    agree(as_loop(kernel, inputs).values[:, 0], wanted)


ASKED = ["R", ratio("R"), drive_force()]


@pytest.mark.skipif(not has_compiler(), reason="no C compiler")
def test_c_says_the_same(tmp_path):
    phi, out = np.linspace(0.0, 6.0, 40), np.empty((5, 40))
    text = Valve().source(ASKED)
    design = np.array(stated(text))
    rows = [(POINTER * len(each))(*map(address, each)) for each in ([phi], out)]
    built(text, "valve", tmp_path)(40, address(design), *rows)
    assert_allclose(out, np.vstack(Valve().evaluate(ASKED, phi=phi)), rtol=1e-10, atol=1e-13)


def stated(text):
    """Return the design that a text's comment states."""
    return [float(part.rpartition(" = ")[2]) for part in text[text.index("/* d: ") + 6 : text.index("; p: ")].split(", ")]


@pytest.mark.skipif(shutil.which("node") is None, reason="no JavaScript")
def test_javascript_says_the_same():
    text = Valve().source(ASKED, language="javascript", name="valve")
    call = f"{text}console.log(JSON.stringify(valve({stated(text)}, [1.3])))"
    said = subprocess.run(["node", "-e", call], check=True, capture_output=True)
    assert_allclose(json.loads(said.stdout), Valve().function(ASKED)(1.3), rtol=1e-10)


@pytest.mark.slow  # SymPy differentiates through the table; a curve's equations are looked at daily
def test_equations_call_the_table_by_its_name():
    written = equations(Valve, ratio="R")
    values = written.values({"phi": 1.9})
    assert "lift(atan2(cross(u_rail, OA), dot(u_rail, OA)))" in str(written["R"])
    assert_allclose(values["R"], Valve().at(phi=1.9)["R"], rtol=1e-13)
    assert_allclose(values["dR/dphi"], Valve().at(phi=1.9).ratio("R"), rtol=1e-12)
    assert r"\operatorname{lift}" in written.latex()


def test_mobility_and_limits():
    assert (Valve().mobility, Valve().gruebler, Rod().mobility) == (1, 1, 1)
    assert "reachable all the way from 0 to 360 deg" in str(MOTION.limits())


def test_the_drawn_profile_touches_the_drawn_roller():
    scene = Scene(MOTION)
    cam, roller = scene.contours
    corners = cam.lines[0].rows[:, 1:]
    for pose in range(0, 73, 6):
        at = scene.at(pose)
        along = (at["A"] - at["O"]) / 0.03
        profile = at["O"] + corners @ np.array([along, [-along[1], along[0]]])
        assert_allclose(np.hypot(*(profile - at["R"]).T).min(), 0.01, atol=2e-5)
    assert roller.on[0] == "R"
    assert scene.extent[0] < -0.03


@pytest.mark.slow
def test_pictures_and_pages_show_it(tmp_path):
    draw(Valve(), at={"phi": 1.0}).savefig(tmp_path / "valve.png")
    page(Valve(), path=tmp_path / "valve.html")
    data = json.loads(unpacked((tmp_path / "valve.html").read_text(encoding="utf-8"), "data"))
    assert [data["scene"]["names"][each["on"][0]] for each in data["scene"]["contours"]] == ["O", "R"]


@pytest.mark.parametrize("machine", [Valve, Loose, Rod])
def test_equilibrium_is_virtual_work(machine):
    motion = machine().sweep(73)
    forces = pin_forces(motion)
    assert forces.gap < 1e-12
    assert forces.residual < 1e-12
    assert_allclose(forces.drives["phi"], driving_force(motion), atol=1e-12)
    on_arrays = pin_forces(motion, split="least squares")  # not by the program
    assert_allclose(on_arrays.drives["phi"], forces.drives["phi"], atol=1e-12)


def test_the_cam_pushes_along_the_normal_of_its_profile():
    (cam,) = (each for each in pin_forces(MOTION).joints if each.kind == "cam")
    arm = MOTION["R"] - MOTION["O"]
    slide = MOTION.ratio("R") - np.stack([-arm[1], arm[0]])  # the roller's centre as the cam sees it
    assert_allclose((cam.force * slide).sum(axis=0), 0.0, atol=1e-12)
    assert np.all((cam.force * arm).sum(axis=0) > 0.0)
    assert (cam.by, pin_forces(MOTION).remarks) == ("OA", ())


def test_lift_off_is_told_by_name_and_pose():
    (remark,) = pin_forces(Loose().sweep(73)).remarks
    assert remark.startswith("R lifts off (cam, spring from OA) at ")
    assert "strokes, from phi = " in remark
    (cam,) = (each for each in pin_forces(Loose().sweep(73)).joints if each.kind == "cam")
    arm = MOTION["R"] - MOTION["O"]
    pulled = (cam.force * arm).sum(axis=0) < 0.0
    assert f"at {pulled.sum()} of 73 strokes" in remark
    assert 0 < pulled.sum() < 73


def test_a_wrong_parent_and_a_table_that_does_not_close_are_refused():
    with pytest.raises(DefinitionError, match="is not a point"):

        class Wrong(Valve):
            R = RollerCam("rail", "A", "rail", base=0.04, angles=ANGLES, lifts=LIFTS)

    with pytest.raises(DefinitionError, match="one period after the first"):
        RollerCam("O", "A", "rail", base=0.04, angles=ANGLES[:-1], lifts=LIFTS[:-1])
    with pytest.raises(DefinitionError, match="is not positive"):

        class Negative(Valve):
            R = RollerCam("O", "A", "rail", base=-0.04, angles=ANGLES, lifts=LIFTS)


# -- force elements ----------------------------------------------------------------------------------------


class Flap(Mechanism):
    """A flap that a gas strut holds up, and that may come down on soft ground."""

    phi = Stroke(20 * deg, 70 * deg)
    O, C = Ground(0.0, 0.0), Ground(0.1, -0.1)
    A = Crank(O, OA=0.4, angle=phi)
    strut = GasStrut(C, A, force=800, extended=0.5, column=0.4)
    soil = Soil(A, height=0.2, stiffness=2e4)


def test_force_elements_of_ones_own():
    motion = Flap().sweep(21)
    forces, length = pin_forces(motion), motion.distance("C", "A")
    assert_allclose(forces.thrusts["strut"], 800.0 * (0.4 / (length - 0.1)) ** 1.2, rtol=1e-13)
    assert forces.gap < 1e-12
    assert np.any(motion.y("A") < 0.2)
    assert [each.drawn_as for each in Scene(motion).two_force] == ["damper"]


@pytest.mark.parametrize("variable", ["strut.force", "strut.column", "soil.height", "soil.stiffness"])
def test_their_parameters_are_design_variables(variable):
    asked, phi = [drive_force(), pin_force("O")], np.linspace(0.4, 1.2, 7)
    value = Flap().dimensions[variable]
    low, high = (Flap(**{variable: value * (1.0 + k * 1e-6)}).evaluate(asked, phi=phi) for k in (-1, 1))
    for each, below, above in zip(asked, low, high, strict=True):
        (exact,) = Flap().at(phi=phi).gradient(each, wrt=[variable])
        assert_allclose(exact, (above - below) / (2e-6 * value), rtol=1e-6, atol=1e-6)


# -- files -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("machine", [Valve, Rod, Flap])
@pytest.mark.parametrize("write", [to_toml, to_json])
def test_a_file_goes_there_and_back(machine, write):
    text = write(machine(OA=0.035))
    back = load(text)
    assert write(back()) == text
    assert ("kind" in text) and ("docs.extending." in text)
    own, again = machine(OA=0.035).sweep(9), back().sweep(9)
    for name in own.plan.points:
        assert_array_equal(again[name], own[name])
    # of what a length is compared with a force in the equations the declared design decides, here another one
    assert_allclose(pin_forces(again).drives["phi"], pin_forces(own).drives["phi"], rtol=1e-14)
    assert type(back.plan.members["O"]) is Ground


# -- the shipped steps say no more ---------------------------------------------------------------------------


def twin(kind):
    """Return a class of the same source as a shipped step, which the framework has never seen."""
    path = Path(inspect.getfile(kind))
    spec = spec_from_file_location(f"linkage.steps._twin_{path.stem}", path)
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return getattr(module, kind.__name__)


NAMES = ("Ground", "Crank", "Dyad", "OnLink", "SliderDyad", "PinSlotDyad", "GuideCross", "YokeDyad", "OnGuide")
SHIPPED = {name: getattr(linkage.steps, name) for name in NAMES}
TWINS = {name: twin(kind) for name, kind in SHIPPED.items()}


def machine_of(kinds):
    """Return a machine with every kind of step, moved by three strokes."""
    Ground, Crank, Dyad, OnLink, SliderDyad, PinSlotDyad, GuideCross, YokeDyad, OnGuide = (kinds[name] for name in NAMES)

    class Everything(Mechanism):
        phi, S, T = Stroke(0.3, 1.2), Stroke(0.0, 0.1), Stroke(0.0, 0.05)
        O, C = Ground(0.0, 0.0), Ground(0.5, 0.0)
        A = Crank(O, OA=0.15, angle=phi)
        B = Dyad(A, C, AB=0.45, CB=0.3, side=LEFT)
        D = OnLink(A, B, AD=0.2 + T, DAB=20 * deg)
        rail = Guide((0.0, -0.3), angle=0)
        E = SliderDyad(D, rail, DE=0.7, side=RIGHT)
        F = OnGuide(rail, at=-0.5 + S)
        J = Ground(-0.6, 0.2)
        post = Guide(F, J)
        beam = Guide((0.0, 0.1), angle=0.2)
        H = GuideCross(beam, post)
        P = PinSlotDyad(C, H, CP=0.2)
        low = Guide((0.0, -0.5), angle=0)
        Y = YokeDyad(B, low)
        arm = linkage.Vector(O, A)
        N = linkage.Offset(C, linkage.Turn(arm, 30 * deg, length=0.2))
        load = Weight(E, mass=10)
        push = Weight(Y, mass=20)

    return Everything


@pytest.fixture(scope="module")
def pair():
    return machine_of(SHIPPED), machine_of(TWINS)


def test_twins_are_other_classes(pair):
    own, foreign = pair
    for name, point in own.plan.points.items():
        assert name == "N" or not isinstance(foreign.plan.points[name], type(point))


def test_steps_from_outside_give_what_the_shipped_ones_give(pair):
    strokes = {"phi": np.linspace(0.3, 1.2, 5), "S": np.linspace(0.0, 0.1, 5), "T": np.linspace(0.0, 0.05, 5)}
    own, foreign = (each().at(**strokes) for each in pair)
    for name in own.plan.moving:
        assert_array_equal(foreign[name], own[name])
        assert_array_equal(foreign.ratio(name, wrt="phi"), own.ratio(name, wrt="phi"))
    assert str(foreign.limits()) == str(own.limits())
    assert str(pair[1].plan) == str(pair[0].plan)
    assert (pair[1]().mobility, pair[1]().gruebler) == (pair[0]().mobility, pair[0]().gruebler)
    assert str(pair[1]().links) == str(pair[0]().links)


def test_their_equations_and_pictures_are_the_same(pair):
    own, foreign = pair
    assert str(equations(foreign)) == str(equations(own))
    strokes = {"phi": 0.7, "S": 0.05, "T": 0.02}
    scenes = [Scene(each().at(**strokes)) for each in pair]
    for what in ("bodies", "stays", "grounds", "pins", "dots"):
        assert getattr(scenes[1], what) == getattr(scenes[0], what)
    assert [each.name for each in scenes[1].tracks] == [each.name for each in scenes[0].tracks]


def test_their_forces_are_the_same():
    def machine(kinds):
        class Press(Mechanism):
            phi = Stroke(0.3, 2.5)
            O, C = kinds["Ground"](0.0, 0.0), kinds["Ground"](0.5, 0.0)
            A = kinds["Crank"](O, OA=0.15, angle=phi)
            B = kinds["Dyad"](A, C, AB=0.45, CB=0.3, side=LEFT)
            D = kinds["OnLink"](A, B, AD=0.2, DAB=20 * deg)
            rail = Guide((0.0, -0.3), angle=0)
            E = kinds["SliderDyad"](D, rail, DE=0.7, side=RIGHT)
            low = Guide((0.0, -0.5), angle=0)
            Y = kinds["YokeDyad"](B, low)
            P = kinds["PinSlotDyad"](C, A, CP=0.2)
            load = Weight(E, mass=10)
            side = linkage.Force(Y, (100.0, 0.0))
            top = Weight(P, mass=3)

        return Press

    own, foreign = (pin_forces(machine(kinds)().sweep(9)) for kinds in (SHIPPED, TWINS))
    assert str(foreign) == str(own)
    assert own.gap < 1e-12
