"""What pictures say is of the language and of the units that are chosen; small names, and marks of masses and moments."""

import re

import numpy as np
import pytest
from matplotlib.text import Text
from numpy.testing import assert_allclose

from linkage import (
    LEFT,
    Crank,
    Dyad,
    Force,
    Ground,
    LinkMass,
    Mechanism,
    Moment,
    OnLink,
    Stroke,
    Weight,
    deg,
    draw,
    least,
    mm,
    optimise,
    plot,
)
from linkage.language import language
from linkage.pictures import plot_bands, plot_tornado, plot_zone
from linkage.pictures.scene import Scene
from linkage.pictures.sheet import RoundValues
from linkage.pictures.strokes import unreached_words
from linkage.study import monte_carlo, tornado, zone
from linkage.units import unit_system
from mechanisms.mower_lift import MowerLift
from mechanisms.three_point_hitch import ThreePointHitch
from tests.for_all import for_all


class Loaded(Mechanism):
    phi = Stroke(20 * deg, 80 * deg)
    O, Q = Ground(0, 0), Ground(1, 0)
    A = Crank(O, OA=0.4, angle=phi)
    B = Dyad(A, Q, AB=0.9, QB=0.6, side=LEFT)
    C = OnLink(A, B, AC=0.45)
    D = OnLink(A, C, AD=0.2, CAD=30 * deg)
    P = OnLink(A, B, AP=0.7, BAP=40 * deg)
    own = LinkMass("A B", mass=12, at=(0.3, 0.05))
    arm = LinkMass("O A", mass=5)
    drag = Moment("Q B", M=-20)
    load = Weight(C, mass=100)
    push = Force(P, (10.0, 0.0))


def words(figure):
    """Return all that is written in a figure."""
    return [text.get_text() for text in figure.findobj(Text) if text.get_text()]


def searched():
    """Return a search of one design."""
    return optimise(ThreePointHitch(), maximise=least("tilt"), vary={"OB": (0.29, 0.31)}, starts=1, limit=20)


PICTURES = {
    "poses": lambda: draw(ThreePointHitch(), at=dict(S=[0.0, 0.2]), path=["F", "G"]),
    "forces": lambda: draw(ThreePointHitch(), forces=True),
    "free body": lambda: draw(ThreePointHitch().at(S=0.1), forces="EDF"),
    "velocities": lambda: draw(ThreePointHitch(), velocities=dict(S=0.05)),
    "pole": lambda: draw(ThreePointHitch().at(S=0.0), pole="CD"),
    "designs": lambda: draw([MowerLift(), MowerLift()]),
    "modes": lambda: draw(MowerLift().assemblies()),
    "curves": lambda: plot(MowerLift()),
    "bands": lambda: plot_bands(monte_carlo(ThreePointHitch(), ["tilt"], {"OB": 2 * mm}, count=16, S=[0.0, 0.1, 0.2])),
    "tornado": lambda: plot_tornado(tornado(ThreePointHitch(), "tilt", {"OB": 2 * mm, "CD": 1 * mm}, S=0.1)),
}
SLOW_PICTURES = {
    "before and after": lambda: draw(searched()),
    "courses": lambda: plot(searched()),
    "zone": lambda: plot_zone(ThreePointHitch(), zone(ThreePointHitch(), "tilt", {"MK": (0.86, 0.9)}, S=[0.0, 0.1])),
}
OF_MEMBERS = {"Three", "point", "hitch", "Mower", "lift", "bar", "load", "holder", "max", "kgf"}
"""Words that are names: of machines, members and columns."""


@for_all("name", PICTURES, slow=SLOW_PICTURES)
def test_pictures_speak_russian(name):
    with language("ru"):
        figure = (PICTURES | SLOW_PICTURES)[name]()
    code = {text.get_text() for text in figure.findobj(Text) if text.get_fontfamily() == ["monospace"]}
    said = " ".join(each for each in words(figure) if each not in code and "\N{MINUS SIGN}" not in each)
    english = set(re.findall(r"\b[A-Za-z]{3,}\b", said)) - OF_MEMBERS
    assert not {each for each in english if each != each.upper()}
    assert re.search("[\u0430-\u044f]", said)


def test_paths_and_what_is_not_reached_are_told_in_russian():
    motion = MowerLift().sweep(31).moved({"S": np.linspace(0.55, 0.95, 41)})
    with language("ru"):
        figure = draw(MowerLift(), path=["G"])
        assert unreached_words(motion, "S").startswith("недостижимо после S = ")
    assert "траектория G" in words(figure)


def number_before(unit, figure):
    return [float(found) for text in words(figure) for found in re.findall(rf"([\d.]+) {unit}\b", text)]


def test_forces_and_lengths_are_in_the_system_that_is_chosen():
    plain = draw(ThreePointHitch().at(S=0.1), forces=True)
    with unit_system("us"):
        figure = draw(ThreePointHitch().at(S=0.1), forces=True)
    assert figure.axes[0].get_xlabel() == "x, in"
    own, other = max(number_before("kN", plain)), max(number_before("lbf", figure))
    assert_allclose(other, own * 1e3 / (0.45359237 * 9.80665), rtol=6e-3)
    assert not number_before("kN", figure)


@pytest.mark.slow
def test_moments_and_velocities_are_in_the_system_that_is_chosen():
    with unit_system("us"):
        figure = draw(Loaded().at(phi=0.9), forces=True, velocities=dict(phi=1.0))
    assert 14.8 in number_before("lbf ft", figure)  # 20 N m
    speed = np.hypot(*Loaded().at(phi=0.9).velocity("A", dict(phi=1.0)))
    assert any(abs(each - speed / 0.0254) < 0.06 for each in number_before("in/s", figure))


def test_ticks_stand_at_round_values_of_the_unit():
    ticks = np.asarray(RoundValues(0.0254).tick_values(0.0, 1.0)) / 0.0254
    step = np.diff(ticks)
    assert_allclose(step, step[0], rtol=1e-9)
    assert step[0] == pytest.approx(5.0)


@pytest.mark.parametrize(("wide", "most"), [(2.2, 6), (10.0, 11)])
def test_ticks_have_room_along_their_axis(wide, most):
    figure = draw(MowerLift().sweep(3))
    figure.set_figwidth(wide)
    ax = figure.axes[0]
    figure.canvas.draw()
    low, high = ax.get_xlim()
    assert 2 <= sum(low <= each <= high for each in ax.get_xticks()) <= most


def test_points_of_a_construction_have_small_names():
    motion = Loaded().sweep(3)
    scene = Scene(motion)
    assert scene.minor == {"C"}
    figure = draw(motion)
    sizes = {text.get_text(): text.get_fontsize() for text in figure.axes[0].texts}
    assert sizes["C"] < sizes["P"] == sizes["A"]
    assert Scene(MowerLift().sweep(3)).minor == frozenset()


def test_masses_and_moments_of_bodies_are_marked_at_their_places():
    motion = Loaded().sweep(5)
    scene = Scene(motion)
    marks = {each.on: each for each in scene.load_marks if len(each.on) == 2}
    assert set(marks) == {("A", "B"), ("O", "A"), ("Q", "B")}
    for pose in range(5):
        at = scene.at(pose)
        along = (at["B"] - at["A"]) / np.hypot(*(at["B"] - at["A"]))
        centre = at["A"] + 0.3 * along + 0.05 * np.array([-along[1], along[0]])
        seen = marks["A", "B"].placed(marks["A", "B"].corners, at)
        assert_allclose(seen.min(axis=0) + seen.max(axis=0), 2.0 * centre, atol=0.5 * scene.size)
        assert np.hypot(*(seen - centre).T).max() < 1.1 * scene.size
        bar = marks["O", "A"].placed(marks["O", "A"].corners, at)
        assert np.hypot(*(bar - 0.5 * (at["O"] + at["A"])).T).max() < 1.1 * scene.size


@pytest.mark.slow
def test_a_long_legend_is_written_so_small_that_it_fits():
    with language("ru"):
        figure = draw(ThreePointHitch(), forces=True, path=["G"])
    legend = figure.axes[0].get_legend()
    extent = legend.get_window_extent(figure.canvas.get_renderer())
    assert extent.x1 <= figure.bbox.width
    assert legend.get_texts()[0].get_fontsize() < 10.0
    plain = draw(ThreePointHitch(), path=["G"]).axes[0].get_legend()
    assert plain.get_texts()[0].get_fontsize() == 10.0
