"""What stands around a mechanism: declared, drawn with what carries it, kept in files, and without any effect on what is computed."""

import math
import struct
import warnings
import zlib
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from matplotlib import image
from matplotlib.figure import Figure
from numpy.testing import assert_allclose
from PIL import Image

from linkage import LEFT, Crank, DefinitionError, Dimension, FileError, Ground, Link, Mechanism, OnLink, Outline, Stroke, Weight, deg, draw
from linkage.files import from_dict, load, to_dict, to_toml
from linkage.pictures import mechanism
from linkage.pictures.drawing import MarkPart, read_picture
from linkage.pictures.page_data import mark_data
from linkage.pictures.scene import Scene
from linkage.statics import driving_force
from linkage.surroundings import outline
from linkage.surroundings.outline import dxf_lines
from mechanisms.classics.front_loader import FrontLoader
from mechanisms.classics.scissor_lift import ScissorLift
from mechanisms.crane import Crane
from mechanisms.grapple import Grapple
from mechanisms.header_balancer import HeaderBalancer
from mechanisms.mower_lift import MowerLift
from mechanisms.three_point_hitch import ThreePointHitch
from tests.for_all import for_all


class Lever(Mechanism):
    phi = Stroke(0.0, 1.0)
    R = Dimension(0.3)
    O = Ground(0.0, 0.0)
    B = Crank(O, OB=0.5, angle=phi)
    C = OnLink(O, B, OC=0.9, BOC=20 * deg)
    load = Weight(C, mass=10)


class Placed(Lever):
    """All forms but those of files."""

    wheel = Outline.circle(at=(0.1, "R"), radius="R")
    hub = Outline.circle(at="C", radius=0.05, filled=False)
    ground = Outline.line((-1.0, 0.0), (0.5, 0.0), (2.0, 0.1))
    bucket = Outline([(0, 0), (0.2, 0), (0.1, 0.15)], on="B C")
    hanging = Outline([(0.0, 0.0), (0.1, -0.2), (-0.1, -0.2)], on="C", hatched=True)
    rope = Outline([(0.0, 0.0), (0.0, -0.2)], on="C", closed=False)


def drawn(cls, count=5):
    motion = cls().sweep(count)
    return motion, mechanism(Figure(figsize=(7, 6)).add_subplot(), motion)


def piece(drawing, name):
    around = [part for part in drawing.parts if isinstance(part, MarkPart) and part.mark in drawing.scene.surroundings]
    (found,) = [part for part in around if part.mark.name == name]
    return found


# -- as a member -------------------------------------------------------------------------------------------


def test_nothing_that_is_computed_knows_them():
    bare, placed = Lever(), Placed()
    assert placed.mobility == bare.mobility and placed.gruebler == bare.gruebler
    assert dict(placed.dimensions) == dict(bare.dimensions)
    assert [body.points for body in placed.links] == [body.points for body in bare.links]
    one, other = bare.sweep(7), placed.sweep(7)
    assert_allclose(other["C"], one["C"], rtol=0.0, atol=0.0)
    assert_allclose(driving_force(other), driving_force(one), rtol=0.0, atol=0.0)
    texts = [machine.plan.kernel(("B", "C")).arrays._code[0] for machine in (bare, placed)]
    assert texts[0] == texts[1]  # what compiled kernels are kept by


def test_a_printed_plan_pastes_back():
    lines = [f"    {line}" for line in str(Placed.plan).splitlines()]
    space = {}
    exec("from linkage import *\nclass Again(Mechanism):\n" + "\n".join(lines), space)
    assert str(space["Again"].plan) == str(Placed.plan)
    for one, other in zip(Scene(Placed().sweep(3)).surroundings, Scene(space["Again"]().sweep(3)).surroundings, strict=True):
        assert one.name == other.name and one.on == other.on
        assert_allclose(one.corners, other.corners, rtol=0.0, atol=0.0)


def test_files_hold_them(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name in ("arm.dxf", "photo.png"):
        Path(name).touch()

    class Files(Placed):
        part = Outline.dxf("arm.dxf", on="B C", at=(0.1, 0.0), angle=30 * deg, layers=["0"])
        photo = Outline.image("photo.png", width="R", at=(-1.0, 0.0))

    text = to_toml(Files)
    again = load(text)
    assert to_toml(again) == text and to_dict(from_dict(to_dict(again))) == to_dict(again)
    assert sorted(map(str, again.plan.of_kind(Outline).values())) == sorted(map(str, Files.plan.of_kind(Outline).values()))
    assert 'wheel = { circle = [0.1, "R"], radius = "R", filled = true }' in text
    assert [again.plan.members[name].carriers for name in ("wheel", "hub", "bucket")] == [(), ("C",), ("B", "C")]


@for_all("cls", [ThreePointHitch, MowerLift, HeaderBalancer, ScissorLift, FrontLoader, Grapple, Crane])
def test_shipped_machines_stand_in_theirs(cls):
    found = cls.plan.of_kind(Outline)
    assert found
    assert any(not each.carriers for each in found.values())


@for_all(
    ("make", "words"),
    [
        (lambda: Outline([(0, 0)]), "a line has 2 corners at least, here are 1"),
        (lambda: Outline("AB"), "is no list of corners"),
        (lambda: Outline([(0, 0), (1, float("nan"))]), r"is not a place; write \(x, y\) in m"),
        (lambda: Outline([(0, 0), (1, 1)], on=("A", "B", "C")), "is no carrier; name two points of a body"),
        (lambda: Outline.circle(at=(0, 0), radius=-1.0), "is no size; give a length above zero"),
        (lambda: Outline.circle(at="C", radius=1.0, on="B C"), "leave on= out"),
        (lambda: Outline.dxf("a.dxf", scale=0), "scale=0 is no size"),
        (lambda: Outline.dxf("a.dxf", layers="0"), "is no list of layers"),
        (lambda: Outline.dxf(" "), "the path of the file is missing"),
        (lambda: Outline.image("a.png", width=1.0, opacity=2), "opacity=2 is not above 0 and at most 1"),
    ],
)
def test_what_cannot_be_drawn_is_refused_in_words(make, words):
    with pytest.raises(DefinitionError, match=words):
        make()


@pytest.mark.parametrize(
    ("outline", "words"),
    [
        (lambda: Outline.circle(at=("phi", 0.0), radius=1.0), "follows the stroke phi; give a fixed size, and carry it with on="),
        (lambda: Outline([(0, 0), (1, 0)], on=("B", "R")), "R is not a point"),
        (lambda: Outline([(0, 0), (1, 0)], on="B B"), "B carries it twice"),
        (lambda: Outline([(0, 0), (1, 0)], on="X"), "X"),
    ],
)
def test_what_does_not_fit_the_class_is_refused_in_words(outline, words):
    with pytest.raises(DefinitionError, match=words):
        type("Wrong", (Lever,), {"bad": outline()}).plan  # noqa: B018


# -- as it is drawn ----------------------------------------------------------------------------------------


def test_outlines_move_with_what_carries_them():
    motion, drawing = drawn(Placed)
    for pose in range(5):
        drawing.update(pose)
        B, C = motion["B"][:, pose], motion["C"][:, pose]
        along = (C - B) / np.hypot(*(C - B))
        left = np.array([-along[1], along[0]])
        (line,) = piece(drawing, "bucket").lines
        assert line.get_closed() and line.get_fill()
        assert_allclose(line.get_xy()[:3], [B, B + 0.2 * along, B + 0.1 * along + 0.15 * left], atol=1e-12)
        (line,) = piece(drawing, "hanging").lines
        assert_allclose(line.get_xy()[:3], [C, C + np.array([0.1, -0.2]), C + np.array([-0.1, -0.2])], atol=1e-12)
        (line,) = piece(drawing, "rope").lines
        assert not line.get_closed() and not line.get_fill()
        (line,) = piece(drawing, "hub").lines
        assert not line.get_fill()
        assert_allclose(np.hypot(*(line.get_xy() - C).T), 0.05, rtol=1e-9)


def test_sizes_follow_dimensions():
    for radius in (0.3, 0.45):
        scene = Scene(Placed(R=radius).sweep(3))
        (wheel,) = [each for each in scene.surroundings if each.name == "wheel"]
        assert_allclose(np.hypot(*(wheel.corners - (0.1, radius)).T), radius, rtol=1e-12)


def test_a_ground_line_is_hatched_below():
    scene = Scene(Placed().sweep(3))
    (ground,) = [each for each in scene.surroundings if each.name == "ground"]
    hatches = ground.hatched
    assert len(hatches) > 20
    level = np.interp(hatches[..., 0], [-1.0, 0.5, 2.0], [0.0, 0.0, 0.1])
    heights = hatches[..., 1] - level
    assert heights.max() < 1e-9 and heights.min() > -1.2 * scene.size


def test_a_body_given_as_a_link_carries_one():
    class Own(Mechanism):
        phi = Stroke(0.0, 1.0)
        O = Ground(0.0, 0.0)
        B = Crank(O, OB=0.5, angle=phi)
        C = OnLink(O, B, OC=0.9, BC=0.5, side=LEFT)
        arm = Link("O B C")
        plate = Outline([(0.0, 0.0), (0.2, 0.1)], on=arm, closed=False)

    assert Own.plan.members["plate"].carriers == ("O", "B")


def test_a_large_wheel_is_clipped_rather_than_the_linkage_shrunk():
    class Huge(Lever):
        moon = Outline.circle(at=(0.0, -40.0), radius=30.0)
        ground = Outline.line((-100.0, 0.0), (100.0, 0.0))

    class Modest(Lever):
        wheel = Outline.circle(at=(0.0, 0.0), radius=0.3)
        ground = Outline.line((-100.0, -0.3), (100.0, -0.3))

    own = Scene(Lever().sweep(5)).box()
    side = max(own[1] - own[0], own[3] - own[2])
    for cls in (Huge, Modest):
        left, right, bottom, top = Scene(cls().sweep(5)).box()
        assert max(right - left, top - bottom) < 1.65 * side
    left, _, bottom, _ = Scene(Modest().sweep(5)).box()
    assert left < -0.3 and bottom < -0.3  # the wheel is seen whole, and the ground below


def test_a_page_has_the_same_lines():
    scene = Scene(Placed().sweep(5))
    names = list(scene.places)
    for each in scene.surroundings:
        data = mark_data(each, {name: place for place, name in enumerate(names)}, 0.05 * scene.size)
        assert tuple(names[number] for number in data["on"]) == each.on
        for line, own in zip(data["lines"], each.lines, strict=True):
            seen, corners = np.array(line["rows"]), own.rows[:, 1:]
            assert_allclose(seen[[0, -1]], corners[[0, -1]], atol=1e-4)
            away = np.min([distances_to_segment(corners, P, Q) for P, Q in pairwise(seen)], axis=0)
            assert away.max() <= 0.1 * scene.size


def distances_to_segment(points, P, Q):
    share = np.clip((points - P) @ (Q - P) / max((Q - P) @ (Q - P), 1e-30), 0.0, 1.0)
    return np.hypot(*(points - P - share[:, None] * (Q - P)).T)


# -- from files --------------------------------------------------------------------------------------------


def test_a_dxf_drawing_is_drawn_in_its_scale(tmp_path):
    ezdxf = pytest.importorskip("ezdxf", reason="drawings are read with ezdxf")
    drawing = ezdxf.new()
    space = drawing.modelspace()
    space.add_lwpolyline([(0, 0), (200, 0), (100, 150)], close=True)
    space.add_circle((100, 50), radius=20)
    space.add_line((0, 0), (999, 999), dxfattribs={"layer": "dimensions"})
    space.add_text("not a line")
    path = tmp_path / "bucket.dxf"
    drawing.saveas(path)
    cls = type("Own", (Lever,), {"bucket": Outline.dxf(path, on="B C", layers=["0"], angle=90 * deg, at=(0.1, 0.0))})
    motion, artists = drawn(cls)
    triangle, circle = piece(artists, "bucket").lines
    artists.update(3)
    B, C = motion["B"][:, 3], motion["C"][:, 3]
    along = (C - B) / np.hypot(*(C - B))
    left = np.array([-along[1], along[0]])

    def place(x, y):
        return B + (0.1 - y) * along + x * left

    assert_allclose(triangle.get_xy()[:3], [place(0, 0), place(0.2, 0), place(0.1, 0.15)], atol=1e-9)
    assert_allclose(np.hypot(*(circle.get_xy() - place(0.1, 0.05)).T), 0.02, rtol=0.02)
    for wrong, error, words in (
        (Outline.dxf(path, layers=["walls"]), DefinitionError, "there is no line on walls; its layers: 0, dimensions"),
    ):
        with pytest.raises(error, match=words):
            Scene(type("Wrong", (Lever,), {"bad": wrong})().sweep(3)).box()
    with pytest.raises(FileError, match=r"Wrong: bad = .* there is no such file as .*none.dxf"):  # as soon as it is declared
        type("Wrong", (Lever,), {"bad": Outline.dxf(tmp_path / "none.dxf")})
    (tmp_path / "broken.dxf").write_text("this is no drawing")
    with pytest.raises(FileError, match="is no DXF drawing"):
        Scene(type("Wrong", (Lever,), {"bad": Outline.dxf(tmp_path / "broken.dxf")})().sweep(3)).box()


def test_a_picture_lies_under_the_mechanism_in_its_place(tmp_path):
    path = tmp_path / "photo.png"
    pixels = np.zeros((30, 60, 3))
    pixels[:, :30] = (1.0, 0.0, 0.0)
    image.imsave(path, pixels)
    cls = type("Own", (Lever,), {"photo": Outline.image(path, width=0.8, at=(0.2, 0.1), opacity=1.0)})
    figure = draw(cls().sweep(3))
    (ax,) = figure.axes
    (under,) = ax.images
    assert under.get_zorder() < 3.0
    figure.canvas.draw()
    seen = np.asarray(figure.canvas.buffer_rgba())
    height = seen.shape[0]

    def colour(x, y):
        column, row = ax.transData.transform((x, y))
        return seen[height - 1 - int(row), int(column), :3].tolist()

    assert colour(0.25, 0.15) == [255, 0, 0] and colour(0.95, 0.12) == [0, 0, 0]  # 0.8 m wide, half as high
    assert colour(0.25, 0.48) == [255, 0, 0] and colour(0.25, 0.52) != [255, 0, 0]
    with pytest.raises(FileError, match=r"there is no such file as .*no.png"):
        type("Wrong", (Lever,), {"bad": Outline.image(tmp_path / "no.png", width=1.0)})
    own = cls()
    path.unlink()
    with pytest.raises(FileError, match="there is no such picture"):
        draw(own)


def test_a_picture_of_too_many_pixels_is_refused_before_it_is_read(tmp_path):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    for side, words in ((13_000, "13000 x 13000 pixels take 0.68 GB"), (60_000, "more pixels than can be drawn")):
        head = struct.pack(">IIBBBBB", side, side, 8, 2, 0, 0, 0)
        path = tmp_path / f"wide{side}.png"
        path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", b"") + chunk(b"IEND", b""))
        machine = type("Own", (Lever,), {"photo": Outline.image(path, width=0.8)})()
        with pytest.raises(FileError, match=words), warnings.catch_warnings():
            warnings.simplefilter("ignore")
            draw(machine)


@pytest.mark.slow
def test_blocks_that_stand_in_themselves_or_too_deep_are_refused(tmp_path):
    ezdxf = pytest.importorskip("ezdxf", reason="drawings are read with ezdxf")

    def drawn_from(inserts):
        drawing, path = ezdxf.new(), tmp_path / "blocks.dxf"
        for name, inside in inserts.items():
            block = drawing.blocks.new(name)
            block.add_line((0, 0), (10, 5))
            for each in inside:
                block.add_blockref(each, (1, 1))
        drawing.modelspace().add_blockref(next(iter(inserts)), (0, 0))
        drawing.saveas(path)
        return Scene(type("Own", (Lever,), {"part": Outline.dxf(path)})().sweep(3)).surroundings

    assert len(drawn_from({"A": ["B", "B"], "B": []})[0].lines) == 3
    with pytest.raises(FileError, match=r"the block A inserts itself \(A > B > A\)"):
        drawn_from({"A": ["B"], "B": ["A"]})
    chain = {f"B{k}": [f"B{k + 1}"] for k in range(20)} | {"B20": []}
    with pytest.raises(FileError, match="blocks stand in blocks more than 16 deep, B0 > B1 > B2"):
        drawn_from(chain)
    bushy = {f"B{k}": [f"B{k + 1}"] * 4 for k in range(10)} | {"B10": []}
    with pytest.raises(DefinitionError, match="more than 20000 lines"):
        drawn_from(bushy)


def test_sizes_of_a_drawing_are_bounded_before_it_is_drawn(tmp_path, monkeypatch):
    ezdxf = pytest.importorskip("ezdxf", reason="drawings are read with ezdxf")

    def lines(add):
        drawing, path = ezdxf.new(), tmp_path / "sizes.dxf"
        add(drawing.modelspace(), drawing)
        drawing.saveas(path)
        return dxf_lines(str(path))

    def blocks(space, drawing):
        for k in range(12):
            block = drawing.blocks.new(f"B{k}")
            for _ in range(10 * (k > 0)):
                block.add_blockref(f"B{k - 1}", (0, 0))
        space.add_blockref("B11", (0, 0))

    refused = {
        "a coordinate of it": [
            lambda space, _: space.add_circle((0, 0), 1e300), lambda space, _: space.add_line((0, 0), (math.nan, 1)),
            lambda space, _: space.add_ellipse((0, 0), (1e250, 0), 0.5),
        ],
        "cannot be drawn": [lambda space, _: space.add_circle((0, 0), math.inf)],
        "leaves no digits": [lambda space, _: space.add_circle((1e11, 0), 1.0)],
        "more than 1000 lines": [blocks],
    }  # fmt: skip
    monkeypatch.setattr(outline, "MOST", 1000)  # 20,000 take seconds to insert
    for words, each_of in refused.items():
        for add in each_of:
            with pytest.raises(DefinitionError, match=words):
                lines(add)
    for radius in (1e-6, 1e9):
        (circle,) = lines(lambda space, _, radius=radius: space.add_circle((radius, 0), radius))
        assert_allclose(np.hypot(circle[:, 0] - radius, circle[:, 1]), radius, rtol=2e-3)
        assert len(circle) < 200


def test_a_fine_photo_takes_little_memory(tmp_path):
    """Of 9000 pixels in a row three are one; where they lie stays."""
    path = tmp_path / "fine.png"
    photo = Image.new("L", (9000, 900), 255)
    photo.paste(0, (0, 0, 4500, 900))
    photo.save(path)
    pixels = read_picture(str(path))
    assert pixels.shape == (300, 3000, 4)
    assert_allclose([pixels[150, 100, 0], pixels[150, 2900, 0]], [0, 255])
