"""Assembly modes with the code that chooses them, as pictures and as a command; several designs over one another."""

from functools import cache

import numpy as np
import pytest
from numpy.testing import assert_allclose

import linkage
from linkage import LEFT, Crank, DefinitionError, Dyad, Ground, Link, Mechanism, OnLink, Pin, Stroke, deg, draw, drawn
from linkage.cli import main
from mechanisms.mower_lift import MowerLift
from mechanisms.three_point_hitch import ThreePointHitch
from tests import shipped
from tests.for_all import for_all
from tests.machines.test_gear_shift import GearShift
from tests.machines.test_plough import Plough

SHIPPED = shipped.MACHINES


class Listed(Mechanism):
    """A parts list: sketch positions choose the modes, of the coupler point too."""

    phi = Stroke(20 * deg, 100 * deg)
    O = Ground(0.0, 0.0)
    C = Ground(0.4, 0.0)
    E = Ground(0.8, 0.1)
    A = Crank(O, OA=0.12, angle=phi)
    coupler = Link("A B P", AB=0.38, AP=0.30, BP=0.20)
    rocker = Link("C B", CB=0.25)
    rod = Link("P Q", PQ=0.45)
    lever = Link("E Q", EQ=0.30)
    B = Pin(near=(0.45, 0.25))
    P = Pin(near=(0.35, 0.30))
    Q = Pin(near=(0.75, 0.40))


class Sketched(Mechanism):
    """Steps with sketch positions, one hanging from the other."""

    phi = Stroke(20 * deg, 100 * deg)
    O = Ground(0.0, 0.0)
    C = Ground(0.4, 0.0)
    E = Ground(0.8, 0.1)
    A = Crank(O, OA=0.12, angle=phi)
    B = Dyad(A, C, AB=0.38, CB=0.25, side=LEFT)
    P = OnLink(A, B, AP=0.30, BP=0.20, near=(0.35, 0.30))
    Q = Dyad(P, E, PQ=0.45, EQ=0.30, near=(0.75, 0.40))


@cache
def drawn_grab():
    """Return two jaws that a crossed rod keeps equal."""

    class DrawnGrab(Mechanism):
        """A cylinder between two jaws that a crossed rod keeps equal: a group whose lengths are measured from the drawing."""

        S = Stroke(0.0, 0.30)
        P, Q = Ground(-0.25, 0.0), Ground(0.25, 0.0)
        ram = Link("A B", AB=0.70 + S)
        left, right, sync = Link("P A U L"), Link("Q B V R"), Link("U V")
        A, B = Pin(at=(-0.35, 0.4)), Pin(at=(0.35, 0.4))
        U, V = Pin(at=(-0.25, 0.12)), Pin(at=(0.25, -0.12))
        L, R = Pin(at=(-0.75, -0.8)), Pin(at=(0.75, -0.8))
        sketch = drawn(S=0.0)

    return DrawnGrab


def strokes_inside(machine):
    """Return one value of each stroke inside its range."""
    return {name: each.start + 0.37 * (each.end - each.start) for name, each in machine.plan.strokes.items()}


def pasted(machine, code):
    """Return the class that lines of code make of a machine, its own names at hand as in its body."""
    names = {name: getattr(linkage, name) for name in linkage.__all__}
    names |= {name: getattr(machine, name) for name in machine.plan.members if hasattr(machine, name)} | {"Base": machine}
    exec("class Other(Base):\n" + "".join(f"    {line}\n" for line in code.splitlines()), names)
    return names["Other"]


FEW = ("inverted_slider_crank", "scotch_yoke", "three_point_hitch")


@pytest.mark.slow
@for_all(
    "machine",
    lambda: [*map(shipped.MACHINES.get, FEW), Listed, Sketched, GearShift, Plough, drawn_grab()],
    slow=lambda: [machine for name, machine in shipped.MACHINES.items() if name not in FEW],
)
def test_pasted_code_gives_the_mode(machine):
    at = strokes_inside(machine)
    modes = machine().assemblies(**at)
    assert [mode.is_declared for mode in modes] == [True] + [False] * (len(modes) - 1)
    own = machine().at(**at)
    assert_allclose([modes[0].places[name] for name in machine.plan.points], [own[name] for name in machine.plan.points], atol=1e-9)
    shown = modes[1:] if len(modes) < 9 else modes[1::4]
    found = []
    for mode in shown:
        motion = pasted(machine, mode.code)().at(unreachable="nan", **at)
        if motion.reached:
            found.append(mode)
            assert_allclose([motion[name] for name in mode.places], list(mode.places.values()), atol=1e-6)
    assert len(found) >= len(shown) - 2 * (machine.__name__ == "ScissorLift")  # two of its modes stand at a change point


def test_modes_are_all_there_are():
    """The hitch: every other mode by turning one dyad after the other by hand."""
    modes = ThreePointHitch().assemblies(S=0.1)
    assert len({tuple(np.round(np.ravel(list(mode.places.values())), 9)) for mode in modes}) == 8
    mirrored = next(mode for mode in modes if str(mode) == "B RIGHT, D RIGHT, K RIGHT")
    motion = ThreePointHitch().at(S=0.1)
    M, F, K = (motion[name] for name in "MFK")
    along = (F - M) / np.hypot(*(F - M))
    assert_allclose(mirrored.places["K"], M + 2.0 * ((K - M) @ along) * along - (K - M), atol=1e-12)
    assert mirrored.code == "K = Dyad(M, F, MK=0.88, FK=0.685, side=RIGHT)"


def test_group_has_the_modes_that_its_equations_have():
    """Every solution keeps the links' lengths, and they are different ones."""
    machine = SHIPPED["stephenson_three_far"]
    modes = machine().assemblies(**strokes_inside(machine))
    assert len(modes) == 4
    lengths = {"OA": 0.050, "CB": 0.152, "AB": 0.200, "AD": 0.090, "DF": 0.1006}
    for mode in modes:
        for (P, Q), length in lengths.items():
            assert_allclose(np.hypot(*np.subtract(mode.places[P], mode.places[Q])), length, rtol=1e-9)
    assert str(modes[1]).startswith("A near (")


def written(figure):
    """Return the code below the panels of a page, line breaks undone."""
    texts = [text for text in figure.texts if str(text.get_gid()).startswith("code ")]
    return [text.get_text().replace("\n    ", " ") for text in texts]


@pytest.mark.slow
def test_page_of_modes_shows_each_with_its_code():
    modes = ThreePointHitch().assemblies(S=0.1)
    figure = draw(modes)
    assert len(figure.axes) == 8
    assert written(figure) == ["as declared\n# B RIGHT, D RIGHT, K LEFT", *(mode.code for mode in modes[1:])]
    widths = [ax.spines["left"].get_linewidth() for ax in figure.axes]
    assert widths[0] > 2.0 * max(widths[1:])
    for ax, mode in zip(figure.axes, modes, strict=True):
        (left, right), (bottom, top) = ax.get_xlim(), ax.get_ylim()
        assert all(left < x < right and bottom < y < top for x, y in mode.places.values())
        names = {text.get_text(): text.xy for text in ax.texts}
        assert_allclose(names["G"], mode.places["G"], atol=1e-12)


@pytest.mark.slow
def test_page_of_modes_has_an_end():
    machine = SHIPPED["jansen"]
    modes = machine().assemblies(**strokes_inside(machine))
    figure = draw(modes)
    assert (len(modes), len(figure.axes)) == (32, 24)
    assert any(text.get_text() == "Jansen: 24 of 32 assembly modes" for text in figure.texts)


def test_command_shows_the_modes(capsys, tmp_path):
    path = tmp_path / "modes.svg"
    assert main(["show", "mower_lift", "--modes", "--at", "S=600mm", "-o", str(path)]) == 0
    out = capsys.readouterr().out
    code = next(mode.code for mode in MowerLift().assemblies(S=0.6) if not mode.is_declared)
    assert f"1. B RIGHT, as declared\n  (no line changes)\n\n2. B LEFT\n  {code}\n" in out
    assert out.endswith("modes.svg: 2 assembly modes.\n")
    assert path.read_text().startswith("<?xml")


WRONG = {
    "a picture of nothing": (["-o", "hitch.png"], "the picture is of the assembly modes; say --modes too"),
    "another format": (["--modes", "-o", "hitch.doc"], "the file's name ends in one of .png, .svg, .pdf"),
    "out of reach": (["--modes", "--at", "S=9.5m"], "S = 9500 mm"),
}


@pytest.mark.parametrize("options, words", WRONG.values(), ids=WRONG)
def test_wrong_commands_are_refused(capsys, options, words):
    assert main(["show", "three_point_hitch", *options]) == 2
    assert words in capsys.readouterr().err


# -- several designs ---------------------------------------------------------------------------------------


def legend_of(figure):
    return [text.get_text() for text in figure.axes[0].get_legend().get_texts()]


def names_of(figure):
    return {text.get_text(): text.xy for text in figure.axes[0].texts if hasattr(text, "xy")}


@pytest.mark.slow
def test_two_designs_the_first_faint():
    hitch = ThreePointHitch()
    other = hitch.replaced(OB=0.32)
    figure = draw([hitch, other], at=0.1, path=["G"])
    assert legend_of(figure) == ["OB = 300 mm", "OB = 320 mm"]
    assert_allclose(names_of(figure)["G"], other.at(S=0.1)["G"], atol=1e-12)
    paths = [np.array(line.get_data()) for line in figure.axes[0].lines if len(line.get_xdata()) == 101]
    assert len(paths) == 2
    for path, machine in zip(paths, (hitch, other), strict=True):
        assert_allclose(path[:, [0, -1]], machine.at(S=[0.0, 0.25])["G"], atol=1e-12)
    faint, strong = (key.get_color() for key in figure.axes[0].get_legend().get_lines())
    assert faint != strong


@pytest.mark.slow
def test_designs_in_colours_name_what_differs():
    hitch = ThreePointHitch()
    figure = draw([hitch, hitch.replaced(OB=0.32), hitch.replaced(OB=0.34, M=(0.22, 0.95), CD=0.63, ED=0.5)])
    assert legend_of(figure)[0].endswith("and 1 more")
    assert len({key.get_color() for key in figure.axes[0].get_legend().get_lines()}) == 3


def test_a_batch_is_its_designs():
    figure = draw(ThreePointHitch(OB=np.linspace(0.28, 0.34, 4)), at=0.1)
    assert legend_of(figure) == ["OB = 280 mm", "OB = 300 mm", "OB = 320 mm", "OB = 340 mm"]
    assert_allclose(names_of(figure)["G"], ThreePointHitch(OB=0.34).at(S=0.1)["G"], atol=1e-12)


def test_what_cannot_be_laid_over_one_another_is_refused():
    with pytest.raises(DefinitionError, match="13 designs do not fit into one picture, 12 do"):
        draw(ThreePointHitch(OB=np.linspace(0.28, 0.34, 13)))
    with pytest.raises(DefinitionError, match="has the strokes"):
        draw([ThreePointHitch(), SHIPPED["four_bar"]()])
    with pytest.raises(DefinitionError, match="one or more designs"):
        draw([])
    with pytest.raises(DefinitionError, match="one or more designs"):
        draw([ThreePointHitch(), *ThreePointHitch().assemblies()])
    with pytest.raises(DefinitionError, match="is no mechanism"):
        draw([ThreePointHitch(), 3])
