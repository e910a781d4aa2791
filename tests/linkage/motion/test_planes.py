"""Outlines that stand for bodies, the planes that bodies lie in, and the clearance of what lies in one of them."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import (
    Crank,
    DefinitionError,
    Dimension,
    Ground,
    Guide,
    Link,
    Mechanism,
    OnGuide,
    OnLink,
    Outline,
    Planes,
    Stroke,
    around,
    clearance,
    deg,
    gap,
    least,
    mm,
    most,
    optimise,
    ref,
    x,
)
from linkage.files import load, to_toml
from linkage.motion.gaps import nearest_places, triangles
from linkage.motion.planes import gaps_at, nearest_gap, pairs_of, pairs_without_planes
from linkage.numeric import convex_pieces, crosses_itself
from linkage.vectors import Vec, pick
from mechanisms.at_work.forwarder import Forwarder
from mechanisms.classics.four_bar import FourBar
from mechanisms.three_point_hitch import ThreePointHitch
from tests.for_all import first_daily, for_all


def star(rng, corners):
    """Return a closed line without crossings, seen whole from its middle, shape (n, 2)."""
    ways = np.linspace(0, 2 * np.pi, corners, endpoint=False) + rng.uniform(0, 0.6 * 2 * np.pi / corners, corners)
    sizes = rng.uniform(0.08, 0.35, corners)
    return np.column_stack([sizes * np.cos(ways), sizes * np.sin(ways)])


def facing(one, other, first="A O", second="C B"):
    """Return a machine of two levers that turn against each other, an outline on each."""
    members = {
        "s": Stroke(0.0, 1.4),
        "O": Ground(0, 0),
        "C": Ground(1.1, 0.1),
        "back": 3.3 - 0.7 * ref("s"),
        "A": Crank("O", OA=0.5, angle="s"),
        "B": Crank("C", CB=0.5, angle="back"),
        "one": Outline([tuple(map(float, each)) for each in one], on=first),
        "other": Outline([tuple(map(float, each)) for each in other], on=second),
        "planes": Planes("OA CB", width=20 * mm),
    }
    return type("Facing", (Mechanism,), members)


def in_the_frame(corners, P, Q):
    """Return corners of a body where it stands, shape (n, 2)."""
    along = (Q - P) / np.hypot(*(Q - P))
    return P + corners[:, :1] * along + corners[:, 1:] * np.array([-along[1], along[0]])


def inside(points, corners):
    """Return which points lie inside a closed line, by counting crossings."""
    found = np.zeros(len(points), bool)
    for (ax, ay), (bx, by) in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        crosses = (ay > points[:, 1]) != (by > points[:, 1])
        with np.errstate(all="ignore"):
            at = ax + (points[:, 1] - ay) * (bx - ax) / (by - ay)
        found ^= crosses & (points[:, 0] < at)
    return found


def along_edges(corners, count=60):
    """Return places along a closed line."""
    shares = np.linspace(0, 1, count, endpoint=False)[:, None]
    return np.concatenate([a + shares * (b - a) for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True)])


@for_all("seed", range(1), slow=range(1, 12))
def test_the_gap_of_outlines_against_points_along_them(seed):
    rng = np.random.default_rng(seed)
    one, other = star(rng, int(rng.integers(4, 13))), star(rng, int(rng.integers(3, 9)))
    machine = facing(one, other)
    motion = machine().sweep(s=9)
    gaps = motion[gap("one", "other")]
    for k in range(9):
        first = in_the_frame(one, motion["A"][:, k], motion["O"][:, k])
        second = in_the_frame(other, motion["C"][:, k], motion["B"][:, k])
        cross = inside(along_edges(first), second).any() or inside(along_edges(second), first).any()
        apart = np.min(np.hypot(*(along_edges(first)[:, None] - along_edges(second)[None]).transpose(2, 0, 1)))
        if cross:
            assert gaps[k] < 0.0
        elif gaps[k] < 0.0:
            assert -gaps[k] <= 2e-2  # they cross between the places looked at
        else:
            assert gaps[k] <= apart + 1e-12
            assert apart - gaps[k] <= 0.02


def test_a_convex_outline_is_the_hull_of_its_points():
    class Hull(Mechanism):
        s = Stroke(0.0, 1.4)
        O, C, E = Ground(0, 0), Ground(1.2, 0.1), Ground(1.5, 0.4)
        A = Crank(O, OA=0.5, angle=s)
        F = OnLink(O, A, OF=0.3, AOF=0.5)
        plate = Link(O, A, F)
        drawn = Outline([(0, 0), (0.5, 0), (0.3 * np.cos(0.5), 0.3 * np.sin(0.5))], on="O A")
        block = Outline([(0.9, -0.3), (1.1, -0.3), (1.1, 0.2), (0.9, 0.2)])

    motion = Hull().sweep(s=15)
    for name in "CE":
        assert_allclose(motion[gap("drawn", name)], motion[gap("OAF", name)], rtol=1e-12)
    assert motion[gap("drawn", "block")].min() > 0.0
    for other, words in (("OAF", "the outline is fixed to that body"), ("drawn", "this is one outline")):
        with pytest.raises(DefinitionError, match=words):
            motion[gap("drawn", other)]


def test_circles_are_round():
    class Wheel(Mechanism):
        s = Stroke(0.0, 1.0)
        O, C = Ground(0, 0), Ground(2, 0)
        A = Crank(O, OA=1.0, angle=s)
        wheel = Outline.circle(at="C", radius=0.4)
        knob = Outline.circle(at="A", radius=0.1)

    motion = Wheel().sweep(s=9)
    expected = np.hypot(*(motion["A"] - np.array([[2.0], [0.0]]))) - 0.5
    assert_allclose(motion[gap("wheel", "knob")], expected, rtol=1e-13)


@first_daily(3, "corners", [3, 4, 8, 13])
def test_pieces_are_convex_and_make_up_the_whole(corners):
    rng = np.random.default_rng(corners)
    for _ in range(25):
        line = star(rng, corners)
        pieces = convex_pieces(line)
        total = sum(area(line[list(piece)]) for piece in pieces)
        assert_allclose(total, abs(area(line)), rtol=1e-12)
        for piece in pieces:
            sides = np.roll(line[list(piece)], -1, axis=0) - line[list(piece)]
            turns = sides[:, 0] * np.roll(sides, -1, axis=0)[:, 1] - sides[:, 1] * np.roll(sides, -1, axis=0)[:, 0]
            assert turns.min() >= -1e-12


def area(line):
    """Return a closed line's area, above zero counter-clockwise."""
    px, py = line.T
    return 0.5 * float(np.sum(px * np.roll(py, -1) - np.roll(px, -1) * py))


def test_a_line_that_crosses_itself_is_told():
    assert crosses_itself(np.array([(0, 0), (1, 1), (1, 0), (0, 1)], float))
    with pytest.raises(DefinitionError, match="it crosses itself or encloses nothing"):
        facing([(0, 0), (0.3, 0.3), (0.3, 0), (0, 0.3)], star(np.random.default_rng(1), 5))().sweep(s=3)[gap("one", "other")]


# -- outlines that follow dimensions -----------------------------------------------------------------------


class Dented(Mechanism):
    """A lever with a bucket, convex in the class's own design, whose dent is a dimension, and a lug that may stand in it."""

    s = Stroke(-0.6, 0.9)
    dent, tall = Dimension(-0.1), Dimension(0.3)
    O, E = Ground(0, 0), Ground(0.9, 0.0)
    A = Crank(O, OA=0.5, angle=s)
    bucket = Outline([(0, -0.2), (0.5, -0.2), (0.5 - dent, 0.05), (0.5, tall), (0, tall)], on="O A")
    lug = Outline([(0.42, 0.02), (0.75, 0.0), (0.75, 0.1)])
    planes = Planes("OA lug")


DENTS = [-0.1, 0.05, 0.2, 0.35, 0.45]


def bucket_of(dent, tall=0.3):
    """Return the corners of a dented bucket, shape (5, 2) [m]."""
    return np.array([(0, -0.2), (0.5, -0.2), (0.5 - dent, 0.05), (0.5, tall), (0, tall)])


@for_all("dent", DENTS)
def test_a_form_that_follows_a_dimension_is_cut_as_the_design_has_it(dent):
    """Convex and concave: the sign by brute force of points, the gap that of the same corners typed as numbers."""
    strokes = np.linspace(-0.6, 0.9, 16)
    motion = Dented(dent=dent).at(s=strokes)
    gaps, lug = motion[gap("bucket", "lug")], np.array([(0.42, 0.02), (0.75, 0.0), (0.75, 0.1)])
    typed = type("Typed", (Dented,), {"bucket": Outline([tuple(map(float, each)) for each in bucket_of(dent)], on="O A")})
    plain = typed().at(s=strokes)[gap("bucket", "lug")]
    apart = gaps > 0.0
    assert np.array_equal(apart, plain > 0.0)
    assert_allclose(gaps[apart], plain[apart], rtol=1e-12)
    if dent < 0.0:
        assert_allclose(gaps, plain, rtol=1e-12)  # the class's own form, with the depth of its own pieces
    for k in range(len(strokes)):
        body = in_the_frame(bucket_of(dent), motion["O"][:, k], motion["A"][:, k])
        assert (gaps[k] < 0.0) == bool(inside(along_edges(body, 200), lug).any() or inside(along_edges(lug, 200), body).any())
    assert apart.sum() == {-0.1: 4, 0.05: 4, 0.2: 10}.get(dent, apart.sum())


def test_designs_of_different_forms_stand_in_one_batch():
    strokes, dents = np.linspace(-0.6, 0.9, 16), np.array(DENTS)
    batch = Dented(dent=dents).at(s=strokes)[gap("bucket", "lug")]
    (again,) = Dented(dent=dents).evaluate([gap("bucket", "lug")], s=strokes)
    alone = [Dented(dent=dent).at(s=strokes)[gap("bucket", "lug")] for dent in DENTS]
    assert_allclose(batch, alone, rtol=1e-12, atol=1e-15)
    assert_allclose(again, alone, rtol=1e-12, atol=1e-15)


def test_the_gap_of_another_form_has_exact_derivatives_and_places():
    motion, step = Dented(dent=0.35).at(s=[-0.2, 0.1, 0.3]), 1e-6
    slope = motion.gradient(gap("bucket", "lug"), wrt=["dent"])[0]
    ahead, back = (Dented(dent=0.35 + way * step).at(s=[-0.2, 0.1, 0.3])[gap("bucket", "lug")] for way in (1, -1))
    assert_allclose(slope, (ahead - back) / (2 * step), rtol=1e-6, atol=1e-9)
    at = Dented(dent=0.35).at(s=0.1)
    assert_allclose(nearest_places(at.plan, at._placed, "bucket", "lug").gap, at[gap("bucket", "lug")], rtol=1e-12)


@pytest.mark.slow
def test_a_form_that_crosses_itself_in_a_design_is_refused():
    machine = Dented(dent=0.8)
    for asked in (lambda: machine.at(s=[0.0, 0.1])[gap("bucket", "lug")], lambda: machine.evaluate([clearance()], s=[0.0, 0.1])):
        with pytest.raises(DefinitionError, match="it crosses itself or encloses nothing in this design; correct the dimensions"):
            asked()
    assert np.isnan(machine.at(s=[0.0, 0.1], unreachable="nan")[gap("bucket", "lug")]).all()
    (told,) = [each for each in machine.verdicts() if getattr(each, "rule", "") == "clearance"]
    assert told.ok is False and "crosses itself" in told


@pytest.mark.parametrize("corners", [4, 5, 6, 7])
def test_triangles_make_up_a_line_that_does_not_cross_itself(corners):
    rng = np.random.default_rng(corners)
    for _ in range(40):
        line = star(rng, corners)[:: int(rng.choice([-1, 1]))]
        found, sound = triangles([Vec(*map(float, each)) for each in line], pick)
        areas = [area(np.array([(float(each.x), float(each.y)) for each in piece])) for piece in found]
        assert sound >= 0.0 and min(areas) * max(areas) > 0.0
        assert_allclose(sum(areas), area(line), rtol=1e-12)
    mixed = np.array([(0, 0), (1, 1), (1, 0), (0, 1), (-0.5, 0.5), (-0.5, 0.2), (-0.2, 0.1)][:corners], float)
    assert triangles([Vec(*map(float, each)) for each in mixed], pick)[1] < 0.0


# -- planes ------------------------------------------------------------------------------------------------


class Crossing(ThreePointHitch):
    """The hitch with all its bars in one plane, which cross."""

    planes = Planes("OBC AB EDF MK", width=60 * mm)


class Sideways(ThreePointHitch):
    """The same in three planes."""

    planes = Planes("OBC lift", "EDF MK", "CD", width=60 * mm)


def test_bodies_that_cross_are_told_with_their_place():
    (told,) = [each for each in Crossing().verdicts() if getattr(each, "rule", "") == "clearance"]
    assert told.ok is False
    assert "cross by 135 mm" in told
    (answer,) = Crossing().answers([least(clearance())])
    at_worst = Crossing().at(S=float(answer.strokes["S"]))
    assert_allclose(at_worst[gap("MK", "OBC", width=0.06)], answer.value, rtol=1e-9)
    every = [at_worst[gap(a, b, width=0.06)] for a, b in pairs_of(Crossing.plan)]
    assert_allclose(min(map(float, every)), answer.value, rtol=1e-9)


def test_planes_keep_bodies_apart_and_pins_pass_through_them():
    pairs = set(map(frozenset, pairs_of(Sideways.plan)))
    assert frozenset(("MK", "OBC")) not in pairs
    assert frozenset(("C", "MK")) in pairs  # the pin from the first plane to the third passes the second
    assert not any({"OBC", "CD"} == each for each in pairs)  # they share a pin


def test_no_planes_no_verdict():
    assert not any("clearance" in each for each in FourBar().verdicts())
    with pytest.raises(DefinitionError, match=r"clearance\(\): it does not say which bodies lie in one plane; declare one"):
        FourBar().answers([least(clearance())])


def test_bodies_that_share_a_pin_by_their_outlines():
    class Bucket(Mechanism):
        s = Stroke(-1.2, 0.6)
        O, E = Ground(0, 0), Ground(-1, 0)
        D = Crank(O, OD=0.5, angle=s)
        shell = Outline([(0, 0), (0.5, 0), (0.5, 0.2), (0.1, 0.2)], on="O D")
        skin = Outline([(-1, 0), (-0.05, 0.05), (-0.05, 0.3), (-1, 0.3)])
        planes = Planes("OD skin")

    assert set(pairs_of(Bucket.plan)) == {("shell", "skin")} or set(pairs_of(Bucket.plan)) == {("skin", "shell")}
    (answer,) = Bucket().answers([least(clearance())])
    dense = Bucket().sweep(s=2001)[gap("shell", "skin")]
    assert answer.value <= dense.min() + 1e-9
    assert_allclose(answer.value, dense.min(), atol=2e-4)


@pytest.mark.slow
def test_a_design_is_looked_for_that_keeps_clear():
    rng = np.random.default_rng(3)
    machine = facing(star(rng, 6), star(rng, 6))
    before = machine().answers([least(clearance())])[0].value
    found = optimise(machine(), vary={"C.x": around(0.5)}, minimise=most(x("B")), subject_to=[least(clearance()) >= before + 0.05])
    (after,) = found.machine.answers([least(clearance())])
    assert after.value >= before + 0.05 - 1e-6


def test_planes_stand_in_files():
    again = load(to_toml(Sideways))
    assert pairs_of(again.plan) == pairs_of(Sideways.plan)
    assert again()["planes.width"] == 0.06


def test_a_machine_of_planes_is_drawn_and_printed():
    assert str(Sideways.plan.members["planes"]) == "Planes('OBC lift', 'EDF MK', 'CD', width=0.06)"
    narrow = Crossing(**{"planes.width": 0.0}).answers([least(clearance())])[0].value
    assert_allclose(narrow - Crossing().answers([least(clearance())])[0].value, 0.06, rtol=1e-9)


@for_all(
    ("make", "words"),
    [
        (lambda: Planes(), "the names of the bodies of each plane are expected"),
        (lambda: Planes("", "OB"), "the names of the bodies of each plane are expected"),
        (lambda: Planes("OB", width=-1.0), "zero or more"),
        (lambda: type("X", (ThreePointHitch,), {"planes": Planes("OQ")})().verdicts(), "Body 'OQ' is unknown"),
        (lambda: type("X", (ThreePointHitch,), {"o": Outline.line((0, 0), (1, 0))})().at(S=0.1)[gap("o", "MK")], "it is open"),
    ],
)
def test_what_is_no_plane_is_refused_in_words(make, words):
    with pytest.raises(DefinitionError, match=words):
        make()


@for_all("seed", (), slow=range(3))
def test_the_least_gap_of_many_pairs_is_that_of_all_of_them(seed):
    """Bodies whose widths keep them apart are not looked at, and none of them is the nearest; at one pose and at twenty."""
    rng, machine = np.random.default_rng(seed), Forwarder()
    strokes = {name: each.start + rng.uniform(size=20) * (each.end - each.start) for name, each in machine.strokes.items()}
    for motion in (machine.at(unreachable="nan", **strokes), machine.at(unreachable="nan", **{name: v[0] for name, v in strokes.items()})):
        pairs = pairs_without_planes(motion)[0][seed::2]
        every = np.array([gaps_at(motion, pair) for pair in pairs]).min(axis=0).reshape(motion.shape)
        assert len(pairs) > 20 and np.array_equal(nearest_gap(motion, pairs), every, equal_nan=True)


# -- where they come nearest -------------------------------------------------------------------------------


@for_all("seed", (), slow=range(6))
def test_the_nearest_places_are_as_far_apart_as_the_gap(seed):
    """The same number as the program's, between a place of the one and a place of the other; moved by it they just touch."""
    rng = np.random.default_rng(40 + seed)
    one, other = star(rng, int(rng.integers(4, 11))), star(rng, int(rng.integers(3, 9)))
    motion = facing(one, other)().sweep(s=9)
    gaps = motion[gap("one", "other")]
    for k in range(9):
        at = motion.moved({"s": motion.strokes["s"][k]})
        found = nearest_places(at.plan, at._placed, "one", "other")
        assert_allclose(found.gap, gaps[k], rtol=1e-9, atol=1e-13)
        assert_allclose(np.hypot(*(found.other - found.one)), abs(found.gap), rtol=1e-9, atol=1e-13)
        if found.gap > 0.0:
            bodies = in_the_frame(one, at["A"], at["O"]), in_the_frame(other, at["C"], at["B"])
            for place, corners in zip((found.one, found.other), bodies, strict=True):
                ends = zip(corners, np.roll(corners, -1, axis=0), strict=True)
                assert min(from_edge(place, a, b) for a, b in ends) < 1e-12


def from_edge(place, a, b):
    """Return how far a place is from a straight edge."""
    share = np.clip((place - a) @ (b - a) / ((b - a) @ (b - a)), 0.0, 1.0)
    return np.hypot(*(place - a - share * (b - a)))


def test_crossing_of_what_is_in_pieces_is_said_to_be_at_least_so_deep():
    """An L against a box in it: the least way out of the whole L is more than that out of one of its pieces. A convex plate is exact."""

    def crossing(corners):
        class Slide(Mechanism):
            S = Stroke(0.0, 1.0)
            rail = Guide((0.2, 0.2), angle=45 * deg)
            P = OnGuide(rail, at=S)
            plate, box = Outline(corners), Outline([(-0.1, -0.1), (0.1, -0.1), (0.1, 0.1), (-0.1, 0.1)], on="P")
            planes = Planes("plate box")

        (said,) = [each.sentence for each in Slide().verdicts() if each.rule == "clearance"]
        return said

    assert "plate and box cross by at least" in crossing([(0, 0), (4, 0), (4, 2), (2, 2), (2, 4), (0, 4)])
    assert "at least" not in crossing([(0, 0), (4, 0), (4, 4), (0, 4)])
