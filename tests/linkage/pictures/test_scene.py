"""What is drawn of a machine: plates and bell cranks, rails, telescopes, accumulators, marks of loads, names, and the colours of bodies."""

from itertools import combinations, pairwise

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.text import Text
from numpy.testing import assert_allclose

from hydraulics import Cylinder, FloatCircuit
from linkage import Crank, Force, ForceElement, Ground, Guide, Mechanism, OnGuide, OnLink, Stroke, Support, Weight
from linkage.loads import Glyph
from linkage.pictures import mechanism, style
from linkage.pictures.drawing import BodyPart, LabelPart, MarkPart
from linkage.pictures.layout import hatched
from linkage.pictures.page_data import body_data, mark_data
from linkage.pictures.poses import empty_page
from linkage.pictures.scene import Scene, rigid_together
from linkage.pictures.shapes import plate_form, rounded_outline
from mechanisms.classics.four_bar import FourBar
from mechanisms.classics.front_loader import FrontLoader
from mechanisms.classics.hart import Hart
from mechanisms.classics.inverted_slider_crank import InvertedSliderCrank
from mechanisms.classics.jansen import Jansen
from mechanisms.classics.klann import Klann
from mechanisms.classics.peaucellier import Peaucellier
from mechanisms.classics.roberts_cognates import RobertsCognates
from mechanisms.classics.scotch_yoke import ScotchYoke
from mechanisms.classics.slider_crank import SliderCrank
from mechanisms.crane import Crane
from mechanisms.grapple import Grapple
from mechanisms.header_balancer import HeaderBalancer
from mechanisms.mower_lift import MowerLift
from mechanisms.three_point_hitch import ThreePointHitch
from tests.for_all import for_all
from tests.linkage.pictures.colour_vision import SIGHT, ciede2000, contrast, lab


def one_motion(cls, count=5):
    machine = cls()
    first, *others = machine.strokes
    middles = {name: 0.5 * (machine.strokes[name].start + machine.strokes[name].end) for name in others}
    return machine.sweep(unreachable="nan", **{first: count}, **middles)


def drawn(cls, count=5):
    motion = one_motion(cls, count)
    return motion, mechanism(Figure(figsize=(7, 6)).add_subplot(), motion)


def parts(drawing, kind):
    return [part for part in drawing.parts if isinstance(part, kind)]


def local(points, P, Q):
    along = (Q - P) / np.hypot(*(Q - P))
    return (points - P) @ np.array([along, [-along[1], along[0]]]).T


# -- bodies ------------------------------------------------------------------------------------------------


def test_bars_that_close_a_triangle_are_one_plate():
    motion, drawing = drawn(Jansen)
    plates = [part for part in parts(drawing, BodyPart) if len(part.form.shares) > 2]
    assert {frozenset(part.points) for part in plates} == {frozenset("BCD"), frozenset("EFG")}
    for pose in range(5):
        drawing.update(pose)
        for part in plates:
            places = np.array([motion[name][:, pose] for name in part.points])
            assert part.face.get_path().contains_point(places.mean(axis=0))


def test_four_bars_in_a_ring_stay_four_bars():
    assert {frozenset(body) for body in Scene(one_motion(Peaucellier)).bodies} >= set(map(frozenset, ("AB", "AD", "BP", "DP")))
    assert all(len(plate.shares) == 2 for plate in Scene(one_motion(Hart)).plates)


def test_bodies_unite_by_two_points_and_by_triangles_only():
    assert rigid_together([("A", "B"), ("B", "C"), ("C", "A"), ("C", "D")]) == (("A", "B", "C"), ("C", "D"))
    assert rigid_together([("A", "B"), ("B", "C"), ("C", "D"), ("D", "A")]) == (("A", "B"), ("B", "C"), ("C", "D"), ("D", "A"))
    assert rigid_together([("A", "B"), ("A", "C"), ("A", "D")]) == (("A", "B"), ("A", "C"), ("A", "D"))  # three on one pin
    assert {frozenset(body) for body in rigid_together([("A", "B"), ("B", "C"), ("C", "A"), ("C", "D"), ("D", "B")])} == {frozenset("ABCD")}
    assert rigid_together([("A", "B", "C"), ("B", "C", "D")]) == (("A", "B", "C", "D"),)


@pytest.mark.parametrize(("cls", "ends", "vertex"), [(MowerLift, "GB", "O"), (Klann, "HF", "K")])
def test_a_bell_crank_does_not_reach_to_its_chord(cls, ends, vertex):
    motion, drawing = drawn(cls)
    (part,) = [part for part in parts(drawing, BodyPart) if {*ends, vertex} <= set(part.points)]
    for pose in range(5):
        drawing.update(pose)
        path = part.face.get_path()
        first, last, middle = (motion[name][:, pose] for name in (*ends, vertex))
        assert not path.contains_point(0.5 * (first + last))
        for end in (first, last):  # both arms are there, as wide as a bar
            across = np.array([-(end - middle)[1], (end - middle)[0]]) / np.hypot(*(end - middle))
            assert path.contains_points([0.5 * (end + middle) + side * 0.95 * part.radius * across for side in (-1.0, 1.0)]).all()


def test_a_plate_with_a_wide_angle_at_no_joint_stays_a_plate():
    assert sorted(len(plate.shares) for plate in Scene(one_motion(FourBar)).plates) == [2, 2, 3]  # P is a point of the coupler


def test_the_line_around_a_hollow_form_keeps_its_distance():
    points = np.array([[0.0, 0.0], [1.0, 0.6], [2.0, 0.0]])
    shares = plate_form(points, 0.1, [True, True, True])
    corners = shares @ points
    assert len(corners) > 4
    assert_allclose(shares.sum(axis=1), 1.0)
    line = rounded_outline(corners, 0.1)
    ends = np.roll(corners, -1, axis=0) - corners
    share = np.einsum("okc,kc->ok", line[:, None] - corners, ends) / np.einsum("kc,kc->k", ends, ends)
    nearest = corners + np.clip(share, 0, 1)[..., None] * ends
    gaps = np.linalg.norm(line[:, None] - nearest, axis=-1).min(axis=1)
    assert gaps.min() > 0.095 and gaps.max() < 0.125  # farther at corners that turn inwards


# -- rails -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("cls", "below"), [(SliderCrank, True), (ScotchYoke, True), (InvertedSliderCrank, False)])
def test_a_rail_lies_where_nothing_hangs(cls, below):
    motion = one_motion(cls)
    scene = Scene(motion)
    (track,) = [track for track in scene.tracks if track.fixed]
    found = hatched(scene)
    for line, *hatches in found:
        level = float(motion.y(track.riders[0])[0])
        assert bool(line[0, 1] < level) == below
        assert all(bool(end[:, 1].min() < line[0, 1] - 1e-12) == below for end in hatches)


def test_a_rail_leaves_room_for_a_pin_on_its_way():
    scene = Scene(one_motion(ScotchYoke))
    assert len(hatched(scene)) == 2
    assert all(np.abs(line[0][:, 0]).min() > 2.0 * scene.size for line in hatched(scene))


# -- cylinders, telescopes, accumulators -------------------------------------------------------------------


class Ramp(Mechanism):
    """A driven length on a guide, and a cylinder that comes out to four times its length."""

    S = Stroke(0.0, 1.8)
    O = Ground(0.0, 0.0)
    rail = Guide((0.0, 0.0), angle=0.0)
    C = OnGuide(rail, at=0.6 + S)
    push = Cylinder(O, C, bore=0.1, rod=0.05)


def test_a_long_stroke_is_a_telescope_of_nested_tubes():
    motion, drawing = drawn(Ramp, 9)
    scene = drawing.scene
    assert scene.cylinders == ()
    (part,) = [part for part in parts(drawing, MarkPart) if part.mark in scene.straights]
    widths, tips = [], []
    for pose in range(9):
        drawing.update(pose)
        P, Q = motion["O"][:, pose], motion["C"][:, pose]
        tubes = [local(each.get_xy(), P, Q) for each in part.artists if np.ptp(each.get_xy()[:, 0]) > 2.0 * scene.size]
        tubes.sort(key=lambda each: -np.ptp(each[:, 1]))
        assert len(tubes) == 5  # the barrel and four stages: 1.8 m out of 0.6 m
        widths.append([np.ptp(each[:, 1]) for each in tubes])
        for outer, inner in pairwise(tubes):
            assert inner[:, 0].min() < outer[:, 0].max()  # it still stands in the outer one
            assert np.ptp(inner[:, 1]) < np.ptp(outer[:, 1])
            assert inner[:, 0].max() > outer[:, 0].max()
        tips.append([each[:, 0].max() for each in tubes])
        assert_allclose(max(each[:, 0].max() for each in tubes), np.hypot(*(Q - P)), atol=1e-9)
    assert_allclose(widths, np.broadcast_to(widths[0], np.shape(widths)), rtol=1e-9)
    out = np.diff([tips[0], tips[-1]], axis=0)[0]
    assert_allclose(out, 1.8 * np.arange(5) / 4, atol=1e-9)  # all stages go the same way


def test_sections_come_out_of_the_body_that_they_slide_in():
    motion = Crane().sweep(phi=0.9, psi=1.5, t=5)
    drawing = mechanism(Figure(figsize=(7, 6)).add_subplot(), motion)
    (section,) = drawing.scene.sections
    assert section.on == ("J", "T")
    (part,) = [part for part in parts(drawing, MarkPart) if part.mark is section]
    for pose in range(5):
        drawing.update(pose)
        J, K, T = (motion[name].reshape(2, -1)[:, pose] for name in "JKT")
        (tube,) = (local(each.get_xy(), J, K) for each in part.artists)
        assert_allclose(tube[:, 0].max(), np.hypot(*(T - J)), atol=1e-9)
        assert 0.0 < tube[:, 0].min() < np.hypot(*(K - J))  # it still stands in the arm


def test_a_cylinder_along_a_bar_hangs_beside_it():
    scene = drawn(Crane)[1].scene
    asides = {(ram.P, ram.Q): ram.aside for ram in scene.cylinders}
    assert asides.pop(("R", "T")) > 2.0 * scene.size
    assert set(asides.values()) == {0.0} and len(asides) == 2


def test_a_gas_fed_cylinder_carries_its_accumulators():
    motion, drawing = drawn(HeaderBalancer)
    (fed,) = drawing.scene.accumulators
    assert set(fed.on) == {"A", "B"}
    (part,) = [part for part in parts(drawing, MarkPart) if part.mark is fed]
    count = len(HeaderBalancer.plan.of_kind(FloatCircuit)["floating"].block.accumulators)
    shells = [each for each in part.artists if len(each.get_xy()) > 20]
    assert count == len(shells) == 2
    for pose in range(5):
        drawing.update(pose)
        places = [local(each.get_xy(), motion["A"][:, pose], motion["B"][:, pose]) for each in shells]
        sides = np.sign([place[:, 1].mean() for place in places])
        assert abs(sides.sum()) == 2  # on one side of the barrel, outside it, not over each other
        assert min(np.abs(place[:, 1]).min() for place in places) > 1.3 * drawing.scene.size
        assert places[0][:, 0].max() < places[1][:, 0].min()
        assert min(place[:, 0].min() for place in places) > 0.0
        box = drawing.scene.box()
        for each in shells:
            assert (each.get_xy() > np.array(box)[[0, 2]]).all() and (each.get_xy() < np.array(box)[[1, 3]]).all()


# -- loads -------------------------------------------------------------------------------------------------


class Loaded(Mechanism):
    phi = Stroke(0.0, 1.0)
    O = Ground(0.0, 0.0)
    B = Crank(O, OB=0.5, angle=phi)
    C = OnLink(O, B, OC=0.9)
    load, more = Weight(C, mass=10), Weight(C, mass=5)
    pull = Force(B, (100.0, 0.0))
    foot = Support(C, (0, 1))


def test_loads_are_marked_at_their_places_without_turning():
    motion, drawing = drawn(Loaded)
    marks = [part for part in parts(drawing, MarkPart) if part.mark in drawing.scene.load_marks]
    assert sorted((part.mark.name, len(part.lines)) for part in marks) == [("B", 1), ("C", 2), ("C", 4)]
    shapes = []
    for pose in range(5):
        drawing.update(pose)
        shapes.append([[line.get_xy()[:2] - motion[part.mark.name][:, pose] for line in part.lines] for part in marks])
    for later in shapes[1:]:
        for one, other in zip(shapes[0], later, strict=True):
            for first, second in zip(one, other, strict=True):
                assert_allclose(first, second, atol=1e-12)
    foot = next(lines for part, lines in zip(marks, shapes[0], strict=True) if len(part.lines) == 2)
    assert max(line[:, 1].max() for line in foot) == pytest.approx(0.0, abs=1e-9)  # it stands below what it pushes up


def test_an_element_of_ones_own_says_what_it_is_drawn_as():
    class Hopper(ForceElement):
        """Grain in a hopper."""

        places = ("point",)

        def __init__(self, point):
            self.point = point

        def loads(self, motion):
            return []

        def glyphs(self, members):
            return (Glyph("weight", (self.point.name,)),)

    own = type("Own", (Mechanism,), {"phi": Stroke(0.0, 1.0), "O": Ground(0.0, 0.0), "B": Crank("O", OB=0.5, angle="phi")})
    assert Scene(own().sweep(3)).load_marks == ()
    B = Crank("O", OB=0.5, angle="phi")
    own = type("Own", (Mechanism,), {"phi": Stroke(0.0, 1.0), "O": Ground(0.0, 0.0), "B": B, "hopper": Hopper(B)})
    assert [mark.name for mark in Scene(own().sweep(3)).load_marks] == ["B"]


def test_a_page_has_the_same_forms():
    scene = Scene(one_motion(MowerLift))
    names = list(scene.places)
    index = {name: place for place, name in enumerate(names)}
    for plate, points in zip(scene.plates, scene.bodies, strict=True):
        given = body_data(plate, points, index)
        assert [names[number] for number in given["points"]] == list(plate.points)
        if "shares" in given:
            assert_allclose(given["shares"], plate.shares, rtol=1e-3, atol=1e-3)
    assert [names[mark_data(mark, index)["on"][0]] for mark in scene.load_marks] == [mark.name for mark in scene.load_marks]


# -- names -------------------------------------------------------------------------------------------------


def to_box(box, place):
    return float(np.hypot(max(box.x0 - place[0], 0.0, place[0] - box.x1), max(box.y0 - place[1], 0.0, place[1] - box.y1)))


def check_names(cls, count):
    motion = one_motion(cls, count)
    scene = Scene(motion)
    for pose in scene.reached:
        figure, ax = empty_page(scene.box())
        drawing = mechanism(ax, motion, pose)
        renderer = figure.canvas.get_renderer()
        labels = {part.points[0]: part for part in parts(drawing, LabelPart)}
        places = {name: ax.transData.transform(motion[name].reshape(2, -1)[:, pose]) for name in labels}
        boxes = {}
        for name, part in labels.items():
            part.text.update_positions(renderer)
            boxes[name] = Text.get_window_extent(part.text, renderer)
        pin = float(np.hypot(*np.diff(ax.transData.transform([(0.0, 0.0), (scene.size, 0.0)]), axis=0)[0]))
        for one, other in combinations(boxes, 2):
            a, b = boxes[one], boxes[other]
            assert min(a.x1, b.x1) - max(a.x0, b.x0) < 1.0 or min(a.y1, b.y1) - max(a.y0, b.y0) < 1.0, (pose, one, other)
        for name, box in boxes.items():
            own = to_box(box, places[name])
            assert labels[name].is_led or own < 3.5 * pin + 12.0, (pose, name)  # what stands away is led to its pin
            for other, place in places.items():
                if not labels[name].is_led and np.hypot(*(place - places[name])) > 1.2 * pin + 1.0:
                    assert to_box(box, place) > own - 2.0, (pose, name, other)


@for_all("cls", [ThreePointHitch, RobertsCognates])
def test_names_belong_to_their_pins(cls):
    check_names(cls, 2)


@pytest.mark.slow
@pytest.mark.parametrize("cls", [ThreePointHitch, HeaderBalancer, Grapple, Crane, RobertsCognates, Jansen, FrontLoader, Klann, Hart])
def test_names_belong_to_their_pins_at_all_poses(cls):
    check_names(cls, 9)


# -- colours -----------------------------------------------------------------------------------------------


def test_the_measure_of_colours_is_the_published_one():
    # Sharma, Wu and Dalal (2005), table 1: pairs 1, 7, 15, 20, 25
    for one, other, expected in (
        ((50.0, 2.6772, -79.7751), (50.0, 0.0, -82.7485), 2.0425),
        ((50.0, 0.0, 0.0), (50.0, -1.0, 2.0), 2.3669),
        ((50.0, 2.5, 0.0), (50.0, 0.0, -2.5), 4.3065),
        ((50.0, 2.5, 0.0), (50.0, 3.2592, 0.3350), 1.0000),
        ((60.2574, -34.0099, 36.2677), (60.4626, -34.1751, 39.4387), 1.2644),
    ):
        assert ciede2000(one, other) == pytest.approx(expected, abs=6e-5)
        assert ciede2000(other, one) == pytest.approx(expected, abs=6e-5)
    assert_allclose(lab("#ffffff"), (100.0, 0.0, 0.0), atol=0.01)


@pytest.mark.parametrize("sight", SIGHT)
def test_body_colours_stay_apart(sight):
    assert len(set(style.BODIES)) >= 10
    seen = [lab(colour, sight) for colour in style.BODIES]
    assert min(ciede2000(one, other) for one, other in combinations(seen, 2)) > 10.4
    assert min(ciede2000(lab(style.PAPER, sight), each) for each in seen) > 12.0


def test_names_can_be_read_on_every_body():
    assert min(contrast(style.INK, colour) for colour in style.BODIES) > 4.5
