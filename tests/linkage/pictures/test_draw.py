"""Pictures: everything stands where the motion says, labels keep clear, and what cannot be drawn is said in words."""

import contextlib
from functools import cache
from itertools import product
from math import pi

import matplotlib.pyplot as plt
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.figure import Figure
from matplotlib.text import Text
from numpy.testing import assert_allclose

from linkage import (
    LEFT,
    RIGHT,
    AssemblyError,
    Column,
    CosineAngle,
    Crank,
    DefinitionError,
    Dimension,
    Dyad,
    Ground,
    Link,
    LinkageError,
    Mechanism,
    Offset,
    OnLink,
    Outline,
    Stroke,
    Turn,
    Vector,
    deg,
)
from linkage.pictures import draw, mechanism, plot, style
from linkage.pictures.curves import limit_crossings
from linkage.pictures.drawing import BodyPart, MarkPart
from linkage.pictures.layout import hatched
from linkage.pictures.scene import Scene
from linkage.pictures.shapes import hull, rounded_outline
from linkage.pictures.sheet import sheet
from linkage.pictures.strokes import stroke_words
from linkage.reports import results
from mechanisms.classics.inverted_slider_crank import InvertedSliderCrank
from mechanisms.classics.scotch_yoke import ScotchYoke
from mechanisms.classics.slider_crank import SliderCrank
from mechanisms.crane import ArmDrive
from mechanisms.crane import Crane as ShippedCrane
from mechanisms.header_balancer import HeaderBalancer
from mechanisms.mower_lift import MowerLift
from mechanisms.three_point_hitch import ThreePointHitch
from tests.for_all import for_all
from tests.linkage.pictures.test_texts import check_texts


class FourBar(Mechanism):
    phi = Stroke(0, 2 * pi)
    O = Ground(0, 0)
    Q = Ground(0.4, 0)
    A = Crank(O, OA=0.12, angle=phi)
    B = Dyad(A, Q, AB=0.38, QB=0.25, side=LEFT)
    C = OnLink(A, B, AC=0.30, BAC=35 * deg)


class Crane(Mechanism):
    S1 = Stroke(0.9, 1.5)
    S2 = Stroke(0.8, 1.3)
    A = Ground(0.35, 0.2)
    O = Ground(0, 1.2)
    B = Dyad(A, O, AB=S1, OB=0.9, side=RIGHT)
    J = OnLink(O, B, OJ=3.0, BOJ=8 * deg)
    H = OnLink(O, B, OH=2.2, BOH=20 * deg)
    N = OnLink(O, B, ON=1.0, BON=10 * deg)
    K = Dyad(H, J, HK=S2, JK=0.45, side=LEFT)
    T = OnLink(J, K, JT=2.5, KJT=160 * deg)


class Construction(Mechanism):
    """A lever on a cylinder in primitives."""

    S = Stroke(0.55, 0.80)
    LOB = Dimension(0.175)
    A = Ground(0.0, 0.242)
    O = Ground(0.652, 0.330)
    AO = Vector(A, O)
    OAB = CosineAngle(abs(AO), S, LOB)
    AB = Turn(AO, -OAB, length=S)
    B = Offset(A, AB)


class Constructed(Construction):
    lever = Link("O", "B")


class Pointing(Mechanism):
    """A point that is shown in a direction that no body has, and that nothing hangs on."""

    phi = Stroke(0.2, 1.0)
    O, A = Ground(0.0, 0.0), Ground(1.0, 0.0)
    B = Offset(O, Turn(Vector(O, A), phi, length=0.4))
    P = Offset(O, Turn(Vector(A, B), 0.5, length=0.3))


class TooLong(MowerLift):
    """A stroke that the lever cannot follow to its end."""

    S = Stroke(0.55, 0.90)


class Longest(MowerLift):
    S = Stroke(2.0, 3.0)


ALL = [MowerLift, ThreePointHitch, FourBar, Crane, Construction, Constructed, TooLong]
REACHED = [cls for cls in ALL if cls is not TooLong]


def axes():
    return Figure(figsize=(7, 6)).add_subplot()


def one_motion(cls, count=11):
    machine = cls()
    first, *others = machine.strokes
    middles = {name: 0.5 * (machine.strokes[name].start + machine.strokes[name].end) for name in others}
    return machine.sweep(unreachable="nan", **{first: count}, **middles)


# -- outlines ----------------------------------------------------------------------------------------------


def test_hull_is_counter_clockwise_and_leaves_inner_points_out():
    points = np.array([[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.5, 0.4], [0.0, 1.0]])
    assert hull(points) == [0, 2, 1, 4]


@pytest.mark.parametrize("turn", [0.0, 0.3, pi / 2])
def test_hull_of_a_straight_body_is_its_ends(turn):
    along = np.array([0.3, 0.0, 1.0, 0.7])
    ends = hull(np.column_stack([along * np.cos(turn), along * np.sin(turn)]))
    assert sorted(ends) == [1, 2]


@given(st.lists(st.tuples(st.integers(-9, 9), st.integers(-9, 9)), min_size=2, max_size=7, unique=True), st.floats(0.01, 2.0))
def test_outline_keeps_its_distance(points, radius):
    places = np.array(points, float)
    corners = places[hull(places)]
    outline = rounded_outline(corners, radius)
    ends = np.roll(corners, -1, axis=0)
    along = ends - corners
    share = np.einsum("okc,kc->ok", outline[:, None] - corners, along) / np.einsum("kc,kc->k", along, along)
    nearest = corners + np.clip(share, 0, 1)[..., None] * along
    gaps = np.linalg.norm(outline[:, None] - nearest, axis=-1).min(axis=1)
    assert_allclose(gaps, radius, rtol=1e-9)
    assert_allclose(outline[0], outline[-1])


# -- a mechanism at a pose ---------------------------------------------------------------------------------


@for_all("cls", (), slow=ALL)
def test_circles_stand_on_the_points_at_every_pose(cls):
    motion = one_motion(cls)
    drawing = mechanism(axes(), motion)
    circles = {part.points[0]: part.circle for part in drawing.parts if hasattr(part, "circle")}
    assert set(circles) == set(motion.plan.points)
    for pose in range(11):
        drawing.update(pose)
        for name, circle in circles.items():
            place = motion[name][:, pose]
            if np.isfinite(place).all():
                assert circle.get_visible()
                assert_allclose(circle.get_center(), place)
            else:
                assert not circle.get_visible()


@for_all("cls", REACHED)
def test_bodies_keep_their_shape_and_hold_their_pins(cls):
    motion = one_motion(cls)
    drawing = mechanism(axes(), motion)
    bodies = [part for part in drawing.parts if isinstance(part, BodyPart)]
    perimeters = []
    for pose in range(11):
        drawing.update(pose)
        for body in bodies:
            path = body.face.get_path()
            assert path.contains_points([motion[name][:, pose] for name in body.points]).all()
        perimeters.append([np.hypot(*np.diff(body.face.get_xy(), axis=0).T).sum() for body in bodies])
    assert_allclose(perimeters, np.broadcast_to(perimeters[0], np.shape(perimeters)), rtol=1e-9)


def test_bodies_and_grounds_are_those_of_the_plan():
    scene = Scene(ThreePointHitch().sweep(5))
    assert {frozenset(points) for points in scene.bodies} == set(map(frozenset, ("OBC", "EDF", "CD", "MK", "FKG")))
    straight = next(hull for points, hull in zip(scene.bodies, scene.hulls, strict=True) if set(points) == set("EDF"))
    assert set(straight) == {"E", "F"}
    assert set(scene.grounds) == set("AOEM")
    assert scene.dots == ("G",)
    assert [(ram.P, ram.Q) for ram in scene.cylinders] == [("A", "B")]


def test_a_polygon_body_is_its_hull():
    scene = Scene(one_motion(Crane))
    boom = next(hull for points, hull in zip(scene.bodies, scene.hulls, strict=True) if "N" in points)
    assert set(boom) == set("OBJH")


def test_primitives_show_their_rods_and_cylinders():
    bare, declared = (Scene(one_motion(cls)) for cls in (Construction, Constructed))
    assert bare.bodies == declared.bodies == (("O", "B"),)
    assert [(ram.P, ram.Q) for ram in bare.cylinders] == [("A", "B")]
    assert (bare.stays, bare.pins, bare.dots) == ((), ("A", "O", "B"), ())


def test_bare_constructions_show_lines_and_no_bodies():
    scene = Scene(one_motion(Pointing))
    assert scene.bodies == (("O", "B"),)
    assert scene.stays == (("O", "P"),)
    assert scene.dots == ("A", "B", "P")


@pytest.mark.parametrize(("cls", "ram"), [(MowerLift, 0), (ThreePointHitch, 0), (Crane, 0), (Crane, 1)])
def test_the_piston_stays_in_the_barrel_and_travels_the_stroke(cls, ram):
    machine = cls()
    corners = machine.at(**{name: [stroke.start, stroke.end] for name, stroke in machine.strokes.items()})
    scene = Scene(corners)
    cylinder = scene.cylinders[ram]
    short, long = corners.distance(cylinder.P, cylinder.Q)
    pistons = []
    for length in (short, long):
        lines = cylinder.mark(scene.size).drawn({cylinder.P: np.zeros(2), cylinder.Q: np.array([length, 0.0])})
        _, barrel, rod, piston, cap = (line[:, 0] for line in lines)
        assert barrel.min() < piston.min() < piston.max() < cap.min() < length
        assert rod.max() == length
        pistons.append(piston.min())
    assert_allclose(pistons[1] - pistons[0], long - short)


def test_a_pose_may_be_counted_from_the_end_or_in_a_grid():
    motion = Crane().sweep(S1=3, S2=4)
    drawing = mechanism(axes(), motion, (2, 1))
    tip = next(part for part in drawing.parts if part.points == ("T",) and hasattr(part, "circle"))
    assert_allclose(tip.circle.get_center(), motion["T"][:, 2, 1])
    assert Scene(motion).index(-1) == 11
    with pytest.raises(DefinitionError, match=r"no pose 12 among \(3, 4\) poses"):
        mechanism(axes(), motion, 12)


def test_a_faint_mechanism_has_paler_colours_and_no_names():
    ax, strong = axes(), axes()
    mechanism(ax, one_motion(FourBar), faint=True)
    mechanism(strong, one_motion(FourBar))
    assert not ax.texts
    assert {text.get_text() for text in strong.texts} == set("OQABC")
    assert ax.patches[0].get_facecolor()[:3] > strong.patches[0].get_facecolor()[:3]


def test_a_batch_of_designs_is_refused():
    motion = ThreePointHitch(OB=[0.29, 0.30]).sweep(5)
    with pytest.raises(DefinitionError, match="holds 2 designs and a picture shows one"):
        mechanism(axes(), motion)
    with pytest.raises(DefinitionError, match="2 designs"):
        draw(ThreePointHitch(OB=[0.29, 0.30]), forces=True)
    with pytest.raises(DefinitionError, match="one design and one row"):
        plot(motion, [Column("tilt", motion["tilt"], "deg")])


# -- sliding ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("cls", [SliderCrank, ScotchYoke, InvertedSliderCrank])
def test_blocks_ride_on_their_points_and_tracks_hold_the_travel(cls):
    motion = cls().sweep(25)
    drawing = mechanism(axes(), motion)
    scene = drawing.scene
    blocks = [part for part in drawing.parts if isinstance(part, MarkPart) and part.mark in scene.blocks]
    assert blocks
    for pose in scene.reached:
        drawing.update(pose)
        for part in blocks:
            rider, start, end = (scene.at(pose)[name] for name in part.points)
            assert_allclose(part.lines[0].get_xy()[:4].mean(axis=0), rider, atol=1e-12)
            share = (rider - start) @ (end - start) / ((end - start) @ (end - start))
            assert 0.0 < share < 1.0
            assert_allclose(start + share * (end - start), rider, atol=1e-9)


def test_a_fixed_guide_is_a_rail_and_a_slot_moves():
    (rail,) = hatched(Scene(SliderCrank().sweep(25)))
    assert_allclose(rail[0][:, 1], rail[0][0, 1])
    assert rail[0][0, 1] < -0.020
    assert {track.fixed for track in Scene(ScotchYoke().sweep(25)).tracks} == {True, False}


def test_what_is_not_reached_is_said_on_the_picture():
    (remark,) = [text.get_text() for text in draw(TooLong()).texts if "reached" in text.get_text()]
    limit = float(remark.removeprefix("not reached beyond S = ").removesuffix(" mm")) / 1e3
    assert TooLong().at(unreachable="nan", S=[limit - 1e-3, limit + 1e-3]).reached.tolist() == [True, False]
    assert not [text for text in draw(MowerLift()).texts if "reached" in text.get_text()]


# -- labels ------------------------------------------------------------------------------------------------


@cache
def shown(cls):
    """Return the picture of a machine as it comes, which several tests read."""
    return draw(cls())


def boxes(figure):
    """Return the boxes of the points' names [pixels]."""
    figure.canvas.draw()
    return {text.get_text(): Text.get_window_extent(text) for text in figure.axes[0].texts if text.get_text()}


@for_all("cls", ALL[-3:], slow=ALL[:-3])
def test_names_keep_clear_of_each_other_of_pins_and_of_the_edge(cls):
    figure = shown(cls)
    names = boxes(figure)
    assert set(names) == set(cls.plan.points)
    ax = figure.axes[0]
    pins = [patch.get_window_extent() for patch in ax.patches if hasattr(patch, "get_center") and patch.get_zorder() > style.STRONG.level]
    assert len(pins) == len(names)
    for name, box in names.items():
        assert not any(box.overlaps(other) for each, other in names.items() if each != name)
        assert not any(box.overlaps(pin) for pin in pins)
        assert figure.bbox.x0 <= box.x0 and box.x1 <= figure.bbox.x1
        assert figure.bbox.y0 <= box.y0 and box.y1 <= figure.bbox.y1


# -- end positions -----------------------------------------------------------------------------------------


@for_all("cls", ALL)
def test_scales_are_equal_and_hold_every_pose(cls):
    ax = shown(cls).axes[0]
    sizes = np.diff(ax.transData.transform([(0, 0), (1, 1)]), axis=0)[0]
    assert_allclose(sizes[0], sizes[1], rtol=1e-6)
    motion = one_motion(cls)
    (left, right), (bottom, top) = ax.get_xlim(), ax.get_ylim()
    for name in motion.plan.points:
        x, y = motion[name][:, motion.reached]
        assert left < x.min() and x.max() < right and bottom < y.min() and y.max() < top


@pytest.mark.slow
def test_a_sheet_that_would_be_mostly_empty_holds_what_is_drawn():
    (low, high), (left, right) = draw(ArmDrive()).axes[0].get_ylim(), draw(ArmDrive()).axes[0].get_xlim()
    travel = ArmDrive().sweep(41)["T"][1]
    assert low > travel.min() + 1.0 and high - low < 0.4 * (right - left)
    assert draw(ArmDrive(), path=["T"]).axes[0].get_ylim()[0] < travel.min()


def test_a_place_from_which_numbers_alone_are_taken_is_not_drawn():
    scene = Scene(ShippedCrane().at(phi=[0.5, 1.0], psi=1.5, t=1.0))
    assert scene.idle == {"F"} and "F" not in {*scene.dots, *scene.pins} and scene.extent[1] < 9.9


def legend(figure):
    return [text.get_text() for text in figure.axes[0].get_legend().get_texts()]


def test_the_legend_says_which_pose_is_which():
    assert legend(draw(MowerLift(), path=["G"])) == ["S = 550 mm", "S = 800 mm", "path of G"]
    assert legend(draw(ThreePointHitch(), path=["F", "G"]))[2:] == ["paths of F, G"]
    assert legend(draw(ThreePointHitch(), at=[0.0, 0.1, 0.25])) == ["S = 0 mm", "S = 100 mm", "S = 250 mm"]
    assert legend(draw(FourBar())) == ["phi = 270°", "phi = 100°"]
    assert legend(draw(Crane(), at={"S2": [0.9, 1.2]})) == ["S2 = 900 mm", "S2 = 1200 mm"]
    assert legend(draw(TooLong())) == ["S = 550 mm"]


def test_strokes_held_are_named():
    figure = draw(Crane())
    assert [text.get_text() for text in figure.texts] == ["Crane", "at S2 = 1050 mm"]


def test_the_path_is_the_points():
    figure = draw(MowerLift(), path=["G"], count=21)
    (line,) = [line for line in figure.axes[0].lines if line.get_color() == style.ACCENT]
    assert_allclose(line.get_xydata().T, MowerLift().sweep(21)["G"])


def test_nothing_in_reach_is_said_in_words():
    with pytest.raises(AssemblyError, match="B = Dyad"):
        draw(Longest())


def test_unknown_names_are_said_in_words():
    with pytest.raises(DefinitionError, match="Known: A, O, B, G"):
        draw(MowerLift(), path=["H"])
    with pytest.raises(DefinitionError, match="'T' is unknown"):
        draw(MowerLift(), at={"T": [0.6]})


@pytest.mark.parametrize(("cls", "unit"), [(MowerLift, "m"), (FourBar, "mm")])
def test_lengths_are_in_the_unit_of_their_size(cls, unit):
    figure = draw(cls())
    figure.canvas.draw()
    ax = figure.axes[0]
    assert ax.get_xlabel() == f"x, {unit}"
    for tick, value in zip(ax.get_xticklabels(), ax.get_xticks(), strict=True):
        assert_allclose(float(tick.get_text().replace("\N{MINUS SIGN}", "-")), value * (1e3 if unit == "mm" else 1.0), atol=1e-9)


def test_a_sheet_fills_its_axes():
    ax = axes()
    sheet(ax, (0.0, 1.0, 0.0, 0.1))
    before = ax.get_position(original=True).bounds
    ax.apply_aspect()
    assert_allclose(ax.get_position().bounds, before)
    assert ax.get_xlim() == (0.0, 1.0)
    assert np.diff(ax.get_ylim()) > 0.5


# -- curves ------------------------------------------------------------------------------------------------


def columns_of(motion):
    return {column.name: column for column in motion_machine.columns(motion)}


motion_machine = MowerLift()


def test_curves_are_the_columns_over_the_stroke_in_their_units():
    motion = motion_machine.sweep(41)
    columns = [columns_of(motion)[name] for name in ("S", "I", "F", "pd", "kz")]
    figure = plot(motion, columns)
    assert [ax.get_title(loc="left") for ax in figure.axes] == ["I", "F, kgf", "pd, kgf/cm²", "kz"]
    assert {ax.get_xlabel() for ax in figure.axes} == {"S, mm"}
    for ax, column in zip(figure.axes, columns[1:], strict=True):
        assert_allclose(ax.lines[0].get_xdata(), np.linspace(550, 800, 41))
        assert_allclose(ax.lines[0].get_ydata(), column.shown)
    assert len({ax.get_position().x0 for ax in figure.axes}) == 2
    assert len({ax.get_position().y0 for ax in figure.axes}) == 2


def test_a_limit_shades_the_side_that_fails_and_marks_the_crossing():
    motion = motion_machine.sweep(101)
    columns = [columns_of(motion)[name] for name in ("pd", "kz")]
    figure = plot(motion, columns, limits={"kz": (1.0, "kz = 1", "below"), "pd": (motion_machine["p_max"], "p_max")})
    pressure, reserve = figure.axes
    for ax, value, low in ((pressure, 155.0, False), (reserve, 1.0, True)):
        _, line, short, mark = ax.lines
        assert_allclose(line.get_ydata(), value)
        assert np.isfinite(short.get_ydata()).sum() == 8  # S = 550 ... 565 mm, short up to 566.0 mm as printed
        assert_allclose((short.get_xdata()[7], short.get_ydata()[7]), (*mark.get_xdata(), value))
        assert_allclose(mark.get_xdata(), 566.0, atol=0.05)
        shaded = ax.patches[0].get_extents().transformed(ax.transData.inverted())
        assert_allclose((shaded.y1 if low else shaded.y0), value)
        assert ax.get_ylim()[0 if low else 1] == pytest.approx(shaded.y0 if low else shaded.y1)
        assert "566 mm" in [text.get_text() for text in ax.texts]


def test_no_words_of_a_limit_and_its_crossings_meet():
    motion, along = FourBar().sweep(201), np.linspace(-1.0, 1.0, 201)
    for sign, middle, wide in product((1.0, -1.0), (-0.6, 0.3), (0.02, 2.0)):
        curve = Column("hump", sign * np.exp(-(((along - middle) / wide) ** 2)))
        check_texts(plot(motion, [curve], limits={"hump": (0.8 * sign, "all that the pump can carry", "above" if sign > 0.0 else "below")}))
        plt.close()


def test_crossings_lie_between_poses_in_reach():
    along = np.arange(5.0)
    assert limit_crossings(along, np.array([1.0, -1.0, np.nan, 3.0, 4.0]), 0.0) == [0.5]
    assert limit_crossings(along, np.array([1.0, 2.0, 3.0, 4.0, 3.0]), 3.5) == [2.5, 3.5]


def test_a_stroke_that_turns_is_shown_in_degrees():
    motion = FourBar().sweep(13)
    ax = plot(motion, [Column("B_x", motion.x("B"), "m")]).axes[0]
    assert ax.get_xlabel() == "phi, deg"
    assert ax.get_xlim() == (0.0, 360.0)
    assert stroke_words(motion.plan, "phi", -pi / 2) == "phi = \N{MINUS SIGN}90°"


def test_a_constant_column_a_single_pose_and_gaps_can_be_drawn():
    machine = MowerLift()
    for motion, values in (
        (machine.sweep(3), np.full(3, 7.0)),
        (machine.at(S=[0.6]), np.array([1.0])),
        (machine.at(S=[0.6, 2.0], unreachable="nan"), np.full(2, np.nan)),
    ):
        figure = plot(motion, [Column("p", values)])
        figure.canvas.draw()
        assert any(np.array_equal(line.get_ydata(), values, equal_nan=True) for line in figure.axes[0].lines)


def test_names_that_the_table_of_a_machine_leaves_out_are_plotted_too():
    machine = HeaderBalancer()
    assert not {"B_x", "h_horizon"} & {column.name for column in results(machine, machine.sweep(2))}
    figure = plot(machine, ["B_x", "R_y", "h_horizon"], count=5)
    assert [ax.get_title(loc="left").partition(",")[0] for ax in figure.axes] == ["B_x", "R_y", "h_horizon"]
    with pytest.raises(DefinitionError, match=r"'B_z' is unknown in HeaderBalancer.*B_x.*P_req"):
        plot(machine, ["B_z"])


def test_what_cannot_be_plotted_is_said_in_words():
    motion = motion_machine.sweep(5)
    column = columns_of(motion)["kz"]
    with pytest.raises(DefinitionError, match=r"'kx' is unknown in limits. Did you mean kz"):
        plot(motion, [column], limits={"kx": (1.0, "")})
    with pytest.raises(DefinitionError, match='say "above" or "below"'):
        plot(motion, [column], limits={"kz": (1.0, "kz = 1", "under")})
    with pytest.raises(DefinitionError, match="no column to draw over S"):
        plot(motion, [Column("S", motion.strokes["S"], "m")])
    grid = Crane().sweep(S1=3, S2=3)
    with pytest.raises(DefinitionError, match="sweep one stroke and give every other a value"):
        plot(grid, [Column("T_x", grid.x("T"), "m")])


def test_a_file_of_more_pixels_than_can_be_drawn_is_refused_in_words(tmp_path):
    figure = draw(one_motion(FourBar))
    words = r"a.png: 90000 x \d+ pixels take .* GB to draw; save it with dpi=1\d\d\d at most, or as .svg or .pdf"
    with pytest.raises(DefinitionError, match=words):
        figure.savefig(tmp_path / "a.png", dpi=10_000)
    assert not list(tmp_path.iterdir())


def test_a_machine_in_millimetres_for_metres_is_asked_about():
    class Wide(Mechanism):
        phi = Stroke(0.0, 1.0)
        O = Ground(0.0, 0.0)
        B = Crank(O, OB=500.0, angle=phi)

    with pytest.warns(UserWarning, match=r"Wide is 500 m across; lengths are in m, write 500 \* mm if these are millimetres"):
        draw(Wide())


ODD = (
    None, 3, -1, 2.5, float("nan"), "x", "", b"a", [], [3], ["x"], {}, {"phi": None}, {"phi": "a"}, {3: 3}, (), (1, 2, 3), object(), int,
    True, 10**30, np.array([]), np.ones((2, 2)), np.array(["a"]), {"phi": [0.1, "a"]}, (1, "a"), {"B": 3}, 1 + 2j,
)  # fmt: skip
"""What nobody means, and somebody writes."""
ASKED = {
    "draw": ("at", "path", "count", "pose", "faint", "ax", "forces", "loads", "case", "direction", "drive", "velocities", "pole"),
    "Outline": ("on", "closed", "filled", "hatched"),
    "Outline.circle": ("on", "filled"),
    "Outline.dxf": ("on", "at", "angle", "scale", "layers", "filled"),
    "Outline.image": ("on", "at", "angle", "opacity"),
}


@for_all("seed", range(1), slow=range(1, 3))
def test_what_nobody_means_is_refused_in_words_or_taken(seed):
    rng, motion = np.random.default_rng(seed), one_motion(FourBar, 3)
    calls = {
        "draw": lambda given: draw(motion, **given),
        "Outline": lambda given: Outline([(0, 0), (1, 0)], **given),
        "Outline.circle": lambda given: Outline.circle((0, 0), 1.0, **given),
        "Outline.dxf": lambda given: Outline.dxf("a.dxf", **given),
        "Outline.image": lambda given: Outline.image("a.png", width=1.0, **given),
    }
    for _ in range(60):
        name = str(rng.choice(list(ASKED)))
        with contextlib.suppress(LinkageError):
            calls[name]({str(rng.choice(ASKED[name])): ODD[rng.integers(len(ODD))]})
