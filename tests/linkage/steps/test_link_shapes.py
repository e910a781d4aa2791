"""However the shape of a link is said, it is the same link: distances, angles, either spelling, any base, or a drawing."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import Crank, DefinitionError, Dimension, Ground, Link, Mechanism, Pin, Stroke, deg, drawn
from mechanisms.classics.stephenson_three import StephensonThreeFar
from tests.for_all import for_all
from tests.linkage.random_parts import dyad_sheet, group_sheet, minus, sine

LEAST = 0.35
"""A third side says where a point is while the triangle is no flatter than this; else an angle does."""


def angle(at, P, vertex, Q):
    """Return the angle PvQ of a sketch as labels mean it: counter-clockwise from vertex-P to vertex-Q [rad]."""
    (ux, uy), (wx, wy) = minus(at[P], at[vertex]), minus(at[Q], at[vertex])
    return math.atan2(ux * wy - uy * wx, ux * wx + uy * wy)


def spelled(random, at, *points):
    """Return one label, of a distance or an angle, spelled one way or the other."""
    way = points if random.random() < 0.5 else points[::-1]
    return "".join(way), math.dist(at[way[0]], at[way[1]]) if len(way) == 2 else angle(at, *way)


def is_open(at, P, Q, R):
    """Return whether three points make a triangle whose sides tell them apart."""
    return min(abs(sine(minus(at[b], at[a]), minus(at[c], at[a]))) for a, b, c in ((P, Q, R), (Q, R, P), (R, P, Q))) > LEAST


def said(random, at, points):
    """Return labels that fix a link's shape: each point from any two before it, by two distances or a distance and an angle."""
    known = list(random.permutation(points))
    labels = [spelled(random, at, known[0], known[1])]
    for k, X in enumerate(known[2:], 2):
        P, Q = random.permutation(known[:k])[:2]
        if is_open(at, P, Q, X) and random.random() < 0.4:
            labels += [spelled(random, at, P, X), spelled(random, at, Q, X)]
        else:
            labels += [spelled(random, at, P, X), spelled(random, at, Q, P, X)]
    random.shuffle(labels)
    return dict(labels)


def told_otherwise(sheet, seed):
    """Return the mechanism of a sheet with its links of three and more points said in other words, their points in another order."""
    random = np.random.default_rng(seed)
    members = dict(sheet.members)
    for name, member in sheet.members.items():
        if isinstance(member, Link) and len(member.point_names) > 2:
            points = [str(each) for each in random.permutation(member.point_names)]
            members[name] = Link(" ".join(points), **said(random, sheet.at, points))
    return type(f"Otherwise{seed}", (Mechanism,), members)


def check_kept(sheet, seed):
    """Assert that every point is where the sketch has it, and that every link keeps its distances elsewhere."""
    motion = told_otherwise(sheet, seed)().at(S=np.array([-0.002, 0.0, 0.003]))
    for point, place in sheet.at.items():
        assert_allclose(motion[point][:, 1], place, rtol=0, atol=1e-8, err_msg=f"{seed} {point}")
    for P, Q in sheet.pairs:
        assert_allclose(motion.distance(P, Q), sheet.length(P, Q), rtol=0, atol=1e-9, err_msg=f"{seed} {P}{Q}")


SEEDS = for_all("seed", range(2), slow=[2, 3, *range(1000, 1200)])


@SEEDS
def test_group_stands_as_sketched_however_its_links_are_said(seed):
    """Class III and IV groups: the shape is said of loose pins, so that Newton's method alone finds it."""
    check_kept(group_sheet(seed), seed)


@pytest.mark.slow
@SEEDS
def test_dyads_stand_as_sketched_however_their_links_are_said(seed):
    check_kept(dyad_sheet(seed), seed)


# -- the cosine rule, straight links, drawings ----------------------------------------------------------------


PLACES = {"A": (0.10, 0.25), "B": (0.42, 0.33), "C": (0.30, 0.52), "E": (0.55, 0.60)}
"""A crank's and a rocker's pins, and two further points of their coupler."""


def distance(P, Q):
    return math.dist(PLACES[P], PLACES[Q])


def turn(P, vertex, Q):
    return angle(PLACES, P, vertex, Q)


SIDES_FROM_AB = {P + Q: distance(P, Q) for P, Q in ("AC", "BC", "AE", "BE")}
SIDES = {**SIDES_FROM_AB, "CE": distance("C", "E")}


class Coupler(Mechanism):
    """A crank O-A, a rocker Q-B, a coupler A B C E, its points in a sketch."""

    phi = Stroke(0.0, 0.4)
    sketch = drawn(phi=0.0)
    O, Q = Ground(0.0, 0.0), Ground(0.5, 0.0)
    A = Crank(O, OA=math.hypot(0.10, 0.25), angle=phi + math.atan2(0.25, 0.10))
    rocker = Link("Q B", QB=math.hypot(0.08, 0.33))
    coupler = Link("A B C E", AB=distance("A", "B"), **SIDES_FROM_AB)
    B, C, E = (Pin(near=PLACES[name]) for name in "BCE")


def coupled(**members):
    return type("Coupled", (Coupler,), members)


@for_all(
    "labels",
    [
        {"AB": distance("A", "B"), **SIDES_FROM_AB},
        {"AC": SIDES["AC"], "BC": SIDES["BC"], "ACB": turn("A", "C", "B"), "AE": SIDES["AE"], "CAE": turn("C", "A", "E")},
        {"CA": SIDES["AC"], "CB": SIDES["BC"], "BCA": turn("B", "C", "A"), "EC": SIDES["CE"], "EB": SIDES["BE"]},
        {"EA": SIDES["AE"], "EB": SIDES["BE"], "AEB": turn("A", "E", "B"), "CA": SIDES["AC"], "CE": SIDES["CE"]},
        {"AB": distance("A", "B"), "BE": SIDES["BE"], "EBA": turn("E", "B", "A"), "CE": SIDES["CE"], "CEB": turn("C", "E", "B")},
    ],
)
def test_coupler_said_in_five_ways(labels):
    """Two sides and their angle stand for the third: the rocker meets the coupler at a distance that is said nowhere."""
    motion = coupled(coupler=Link("A B C E", **labels))().sweep(7)
    for name, place in PLACES.items():
        assert_allclose(motion[name][:, 0], place, rtol=0, atol=1e-13)
    for P, Q in ("AB", *SIDES):
        assert_allclose(motion.distance(P, Q), distance(P, Q), rtol=1e-12)
    assert_allclose(motion.distance("Q", "B"), math.hypot(0.08, 0.33), rtol=1e-13)


@pytest.mark.parametrize("order", ["A B C E", "E C B A", "C A E B"])
def test_drawn_coupler_is_measured_once_and_keeps_its_shape(order):
    """Pins at=(x, y) and no label: every distance is the drawing's, at every pose."""
    drawn_pins = {name: Pin(at=PLACES[name]) for name in "BCE"}
    motion = coupled(coupler=Link(order), rocker=Link("Q B"), **drawn_pins)().sweep(7)
    for P, Q in ("AB", *SIDES):
        assert_allclose(motion.distance(P, Q), distance(P, Q), rtol=1e-12)
    for name, place in PLACES.items():
        assert_allclose(motion[name][:, 0], place, rtol=0, atol=1e-13)


def test_what_is_said_goes_before_the_drawing():
    """A length that is given moves the drawn pin; what is left is measured from the drawing."""
    pins = {"B": Pin(at=PLACES["B"]), "C": Pin(at=PLACES["C"]), "E": Pin(at=PLACES["E"])}
    motion = coupled(coupler=Link("A B C E", AC=0.4), rocker=Link("Q B"), **pins)().sweep(5)
    assert_allclose(motion.distance("A", "C"), 0.4, rtol=1e-12)
    for P, Q in ("AB", "AE", "BE"):
        assert_allclose(motion.distance(P, Q), distance(P, Q), rtol=1e-12)
    bac = motion.angle("A", "C") - motion.angle("A", "B")
    assert_allclose(np.cos(bac - turn("B", "A", "C")), 1.0, rtol=1e-12)


def test_rough_pins_do_not_say_lengths():
    """near=(x, y) is no drawing: a length that is said nowhere is missing, and the message says whose."""
    with pytest.raises(DefinitionError, match=r"shape of coupler = Link\(.* is not settled at B; give two"):
        coupled(coupler=Link("A B C E", AC=0.3, BC=0.3, AE=0.5, BE=0.3))


def straight(middle, near):
    """Return a coupler whose point C lies on the line A B, its distances from A and B given."""
    base = distance("A", "B")
    at = tuple(np.add(PLACES["A"], np.multiply(middle, np.subtract(PLACES["B"], PLACES["A"]))) + near)
    labels = {"AB": base, "AC": abs(middle) * base, "BC": abs(1.0 - middle) * base, "AE": SIDES["AE"], "BE": SIDES["BE"]}
    return coupled(coupler=Link("A B C E", **labels), C=Pin(near=at))


@for_all("middle", [0.4, 1.7, -0.6])
@for_all("near", [(0.0, 0.0), (0.01, -0.02), (-0.02, 0.01)])
def test_straight_link_has_no_sides(middle, near):
    """Three distances in one line: wherever the sketch stands, C is on the line AB, at its place."""
    motion = straight(middle, near)().sweep(5)
    expected = motion["A"] + middle * (motion["B"] - motion["A"])
    assert_allclose(motion["C"], expected, rtol=0, atol=1e-7)  # sqrt of the last digits of a flat triangle


def test_first_pose_is_at_the_sketched_side():
    """Two distances leave two poses: the sketch's side is kept, also mirrored."""
    for sense in (1.0, -1.0):
        places = {name: (x, sense * y) for name, (x, y) in PLACES.items()}
        members = {
            "A": Crank(Coupler.O, OA=math.hypot(0.10, 0.25), angle=Coupler.phi + sense * math.atan2(0.25, 0.10)),
            **{name: Pin(near=places[name]) for name in "BCE"},
        }
        motion = coupled(**members)().at(phi=0.0)
        for name, place in places.items():
            assert_allclose(motion[name], place, rtol=0, atol=1e-13)


def test_contrary_angle_is_the_mirrored_link():
    """ZYX = -XYZ: the other spelling with the same number turns the link over."""
    base = {"AB": distance("A", "B"), "AC": SIDES["AC"], "AE": SIDES["AE"], "BE": SIDES["BE"]}
    one = coupled(coupler=Link("A B C E", **base, BAC=40 * deg))().sweep(5)
    two = coupled(coupler=Link("A B C E", **base, CAB=40 * deg))().sweep(5)
    assert_allclose(two["B"], one["B"], rtol=0, atol=1e-13)
    away = [m["C"] - m["A"] for m in (one, two)]
    along = one["B"] - one["A"]
    cross = [along[0] * c[1] - along[1] * c[0] for c in away]
    assert np.all(cross[0] > 0.0)
    assert_allclose(cross[1], -cross[0], rtol=1e-12)


FLAT = {name: Pin(near=(place, 0.1)) for name, place in {"A": 0.0, "B": 0.1, "D": 0.2}.items()}


@pytest.mark.parametrize("lengths", [(0.2, 0.09, 0.25), (0.2, 0.09, 0.12), (0.2, 0.1, 0.11), (0.05, 0.09, 0.13)], ids=str)
def test_flat_sketch_of_a_group_has_no_side(lengths):
    """Three pins drawn in one line, their lengths a triangle or not known as numbers: no side is guessed."""
    AB, AD, BD = lengths
    with pytest.raises(DefinitionError, match="has no side; move a near"):
        type("Flat", (StephensonThreeFar,), {**FLAT, "L": Dimension(0.09), "coupler": Link("A B D", AB=AB, AD=AD, BD=BD)})
