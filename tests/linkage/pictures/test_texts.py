"""No text of a picture covers another one, a tick, or the edge of the paper: of every shipped machine, with its forces and without.

Values stand beside the arrows of forces, the bar of their scale stands free, and bodies have short names there.
"""

from importlib.metadata import entry_points
from itertools import combinations

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Polygon
from matplotlib.text import Annotation, Text

from linkage import RIGHT, Crank, Dyad, Force, Ground, Mechanism, OnLink, Stroke, deg, draw, plot
from linkage.pictures.arrows import EDGE, ArrowLayer, VectorArrow, draw_arrows, place_wordings, wordings
from linkage.pictures.drawing import LabelPart
from linkage.pictures.force_arrows import PIN, ForceQuestion, forces_at_pose, short_name
from linkage.pictures.layout import offsets
from linkage.pictures.shapes import lines_cross
from linkage.pictures.sheet import empty_figure, points_a_metre, sheet
from linkage.pictures.style import STRONG
from tests.for_all import first_daily, for_all
from tests.linkage.motion.in_node import elsewhere

SHIPPED = {point.name: point for point in entry_points(group="hydrolinkage.machines")}
QUICK = ("three_point_hitch",)
TOUCH = 1.0
"""Pixels by which boxes of letters may touch: they are higher than the letters in them."""
BESIDE = 2.0
"""Pixels by which a value may be nearer to another arrow than to its own."""
INNER = 4.0
"""Pixels from the edge of a value's box to its letters."""
NAME = 16
"""The letters of a body's longest name."""


def boxes(figure):
    """Return the texts that a figure shows, tick labels and headings among them, with the boxes that they cover [pixels]."""
    renderer = FigureCanvasAgg(figure).get_renderer()
    figure.draw(renderer)
    texts = [*figure.texts]
    for ax in figure.axes:
        inside = [*(each for each in ax.get_children() if isinstance(each, Text)), ax.xaxis.label, ax.yaxis.label]
        spans = [(axis, sorted(axis.get_view_interval())) for axis in (ax.xaxis, ax.yaxis)]
        ticks = [tick.label1 for axis, (low, high) in spans for tick in axis.get_major_ticks() if low <= tick.get_loc() <= high]
        legend = ax.get_legend()
        texts += [*inside, *ticks, *(legend.get_texts() if legend else [])]
    shown = [each for each in texts if each.get_visible() and each.get_text().strip()]
    return [(each.get_text(), Text.get_window_extent(each, renderer).padded(-TOUCH)) for each in shown]


def check_texts(figure):
    """Assert that no text covers another one or hangs over the paper's edge."""
    found = boxes(figure)
    paper = figure.bbox.padded(TOUCH)
    for text, box in found:
        assert paper.x0 <= box.x0 and box.x1 <= paper.x1 and paper.y0 <= box.y0 and box.y1 <= paper.y1, f"{text} hangs over the edge"
    covered = [(a, b) for (a, one), (b, other) in combinations(found, 2) if one.overlaps(other)]
    assert covered == []


def named(figure, kind):
    """Return what a figure shows under a name that begins so, with the outline of each [pixels]."""
    shown = figure.axes[0].get_children()
    found = [each for each in shown if isinstance(each, (Patch, Line2D)) and (each.get_gid() or "").startswith(kind)]
    return [(each.get_gid(), each.get_path().transformed(each.get_transform())) for each in found]


def crossed(figure, kind):
    """Return the values that the arrows of one kind go through."""
    renderer = FigureCanvasAgg(figure).get_renderer()
    values = [each for each in figure.axes[0].texts if (each.get_gid() or "").endswith(" value")]
    boxes_of = [(each.get_text(), Text.get_window_extent(each, renderer).padded(-INNER)) for each in values]
    return [(text, name) for name, outline in named(figure, kind) for text, box in boxes_of if outline.intersects_bbox(box)]


def leaders_of(ax):
    """Return the thin lines that lead from values and from names to what they stand for, shape (2, 2) [pixels] each."""
    renderer = FigureCanvasAgg(ax.figure).get_renderer()
    found = [ax.transData.transform(line.get_xydata()) for line in ax.lines if (line.get_gid() or "").startswith("leader of ")]
    for text in ax.texts:
        if isinstance(text, Annotation) and text.arrow_patch is not None and text.get_visible():
            text.update_positions(renderer)
            text.update_bbox_position_size(renderer)
            found.append(text.arrow_patch.get_path().vertices[[0, -1]])
    return found


def away(box, outline):
    """Return how far a box is from the line around an arrow [pixels]."""
    corners = outline.vertices[:-1]
    ways, shares = np.roll(corners, -1, axis=0) - corners, np.linspace(0.0, 1.0, 40)[:, None, None]
    line = (corners + shares * ways).reshape(-1, 2)
    return float(np.hypot(*np.maximum(np.maximum(box.min - line, line - box.max), 0.0).T).min())


def strayed(ax):
    """Return the values without a leading line that stand nearer to another arrow than to their own, with that one."""
    led = {line.get_gid().removeprefix("leader of ") for line in ax.lines if (line.get_gid() or "").startswith("leader of ")}
    shown = [each for each in ax.patches if isinstance(each, Polygon) and each.get_gid()]
    outlines = {each.get_gid(): each.get_path().transformed(each.get_transform()) for each in shown}
    renderer, found = FigureCanvasAgg(ax.figure).get_renderer(), []
    for text in ax.texts:
        name = (text.get_gid() or "").removesuffix(" value")
        if name in outlines and text.get_gid() not in led:
            far = {other: away(Text.get_window_extent(text, renderer), outline) for other, outline in outlines.items()}
            found += [(name, other) for other, each in far.items() if each < far[name] - BESIDE]
    return found


def check_leaders(ax):
    """Assert that no two leading lines cross, and that a value without one stands nearest to its own arrow."""
    assert not [pair for pair in combinations(leaders_of(ax), 2) if lines_cross(*pair)]
    assert strayed(ax) == []


@for_all("seed", (7,), slow=range(7))
def test_values_of_drawn_arrows_keep_to_their_own_and_their_lines_do_not_cross(seed):
    """Twelve arrows about three pins, drawn anew for each seed: the pins stand closer and closer."""
    random = np.random.default_rng(seed)
    pins = random.uniform(0.35, 0.65, (3, 2)) + random.uniform(-0.3, 0.3, (3, 2)) / (1 + seed)
    forces = random.uniform(200.0, 1000.0, 12) * np.exp(2j * np.pi * random.uniform(size=12))
    vectors = np.column_stack([forces.real, forces.imag])
    drawn = [VectorArrow(f"force {n}", pins[n % 3], each, PIN, f"on body {n}") for n, each in enumerate(vectors)]
    layer = ArrowLayer(tuple(drawn), "N", ())
    figure = empty_figure(9.0, 7.0)
    ax = figure.add_axes((0.1, 0.1, 0.85, 0.85))
    sheet(ax, (0.0, 1.0, 0.0, 0.8))
    covered = draw_arrows(ax, layer, 2.5e-4, 0.012)
    place_wordings(ax, wordings(layer, 2.5e-4, 0.012), covered)
    check_leaders(ax)
    check_texts(figure)
    free = ax.get_window_extent().padded(-EDGE)
    assert all(free.min[0] <= box.x0 and free.min[1] <= box.y0 and box.x1 <= free.max[0] and box.y1 <= free.max[1]
               for text, box in boxes(figure) if " on body " in text)  # fmt: skip


def test_names_of_crowded_points_have_lines_that_do_not_cross():
    for seed in range(8):
        at = {f"part.{n}": place for n, place in enumerate(np.random.default_rng(seed).normal(0.5, 0.05, (14, 2)))}
        figure = empty_figure(9.0, 7.0)
        ax = figure.add_axes((0.1, 0.1, 0.85, 0.85))
        sheet(ax, (0.0, 1.0, 0.1, 0.9))
        for name, spot in offsets(list(at), [at], [np.array(list(at.values()))], points_a_metre(ax), 8.0).items():
            LabelPart(ax, name, spot, 8.0, STRONG).update(at)
        assert not [pair for pair in combinations(leaders_of(ax), 2) if lines_cross(*pair)]


def check_forces(figure):
    """Assert that values stand beside arrows and near to their own, that the scale's bar stands free, and that no body's name is long."""
    assert crossed(figure, "force ") == []
    check_leaders(figure.axes[0])
    (_, bar), *_ = named(figure, "scale ") or [("", None)]
    assert bar is None or not [text for text, box in boxes(figure) if bar.intersects_bbox(box)]
    texts = [each.get_text() for each in figure.axes[0].texts]
    assert max((len(each.partition(" on ")[2]) for each in texts), default=0) <= NAME


def check_machine(machine):
    for make, check in ((lambda: draw(machine), None), (lambda: draw(machine, forces=True), check_forces), (lambda: plot(machine), None)):
        figure = make()
        check_texts(figure)
        if check is not None:
            check(figure)
        plt.close(figure)


@for_all("seed", (), slow=range(20))
def test_values_keep_clear_at_any_pose(seed):
    """Poses that nobody chose, outside what is judged, where arrows crowd about few pins; one each of machines of several strokes."""
    for name in ("levelled_telehandler", "grapple"):
        machine, random = SHIPPED[name].load()(), np.random.default_rng(seed)
        strokes = {stroke: each.start + random.uniform() * (each.end - each.start) for stroke, each in machine.strokes.items()}
        motion = machine.at(unreachable="nan", **strokes)
        if motion.reached.all():
            figure = draw(motion, forces=True)
            check_texts(figure)
            check_forces(figure)
            assert crossed(figure, "load ") == [] and crossed(figure, "couple ") == []
            plt.close(figure)


@first_daily(1, "name", sorted(SHIPPED, key=lambda name: name not in QUICK))
def test_no_text_of_a_shipped_machine_covers_another(name):
    check_machine(SHIPPED[name].load()())


@pytest.mark.slow
@pytest.mark.parametrize("name", [name for name, _ in elsewhere()])
def test_no_text_of_a_machine_that_is_not_shipped_covers_another(name):
    check_machine(dict(elsewhere())[name]())


class LongThin(Mechanism):
    """A boom of 12 m, half a metre high."""

    s = Stroke(0.0, 0.05)
    O, A = Ground(0.0, 0.0), Ground(0.6, -0.4)
    B = Dyad(A, O, AB=1.45 + s, OB=2.0, side=RIGHT)
    C, D, T = OnLink(O, B, OC=5.0), OnLink(O, B, OD=8.0), OnLink(O, B, OT=12.0)


class FarAway(Mechanism):
    """A crank 5 km away, with nine forces on its pin."""

    phi = Stroke(20 * deg, 70 * deg)
    O = Ground(5000.0, -3000.0)
    A = Crank(O, OA=1.0, angle=phi)
    a, b, c = Force(A, (0.8e3, 0.1e3)), Force(A, (0.7e3, 0.3e3)), Force(A, (0.7e3, 0.4e3))
    d, e, f = Force(A, (0.6e3, 0.5e3)), Force(A, (0.5e3, 0.6e3)), Force(A, (0.4e3, 0.7e3))
    g, h, i = Force(A, (0.3e3, 0.7e3)), Force(A, (0.1e3, 0.8e3)), Force(A, (0.0, 0.8e3))


@pytest.mark.slow
def test_nine_forces_at_a_pin_far_from_the_origin():
    figure = draw(FarAway().at(phi=0.6), forces=True)
    check_texts(figure)
    check_forces(figure)
    assert sum((each.get_gid() or "").startswith("load ") for each in figure.axes[0].texts) == 9


def test_a_long_thin_machine_fills_its_sheet():
    figure = draw(LongThin())
    check_texts(figure)
    assert figure.get_figheight() < figure.get_figwidth() / 2.5
    assert np.ptp(figure.axes[0].get_ylim()) < 3.5  # m, of 1.4 from the lowest pin to the highest


def test_a_body_goes_by_its_link_in_pictures():
    forces = forces_at_pose(SHIPPED["crane"].load()().at(phi=1.0, psi=1.5, t=1.0), 0, ForceQuestion())
    names = {each.name: short_name(forces.found, each.name) for each in forces.found._structure.bodies}
    assert names["OJOCOGHVBUC"] == "main_boom"
    assert names["JKER"] == "arm"
    assert names["lift"] == "lift"


def test_a_colour_without_an_arrow_has_no_key():
    figure = draw(LongThin(), forces=True)
    assert [each.get_text() for each in figure.axes[0].get_legend().get_texts()] == ["s = 0 mm", "s = 50 mm"]


@pytest.mark.slow
def test_a_heading_is_parted_between_strokes():
    telehandler = SHIPPED["levelled_telehandler"].load()()
    figure = plot(telehandler, at=dict(lift=(0.0, 0.7)))
    assert figure.get_suptitle().splitlines()[1:] == ["extend = 1500 mm, tilt = 0 mm"]
    paths = plot(telehandler)  # two: what is held stands along each
    assert [ax.get_xlabel() for ax in paths.axes] == ["lift, mm; extend = 0 mm, tilt = 0 mm", "extend, mm; lift = 300 mm, tilt = 0 mm"]
    check_texts(paths)
