"""Straight elements in pictures: springs, dampers, struts and cylinders hang on their pins, side by side where they share these."""

from dataclasses import dataclass
from itertools import pairwise
from typing import Any, ClassVar

import numpy as np
import pytest
from matplotlib.figure import Figure
from numpy.testing import assert_allclose

from hydraulics import Accumulator, AccumulatorBlock, Cylinder, FloatCircuit, LiftCircuit, isothermal
from linkage import (
    RIGHT,
    Actuator,
    Between,
    CosineAngle,
    Crank,
    Damper,
    DefinitionError,
    Dimension,
    Dyad,
    Ground,
    Link,
    Mechanism,
    Offset,
    OnLink,
    Spring,
    Stroke,
    Turn,
    Vector,
    Weight,
    deg,
)
from linkage.loads import TwoPoint
from linkage.pictures import mechanism, style
from linkage.pictures.drawing import BodyPart, MarkPart
from linkage.pictures.page_data import mark_data
from linkage.pictures.scene import Scene
from linkage.pictures.shapes import HALF
from linkage.units import bar, litre
from mechanisms.crane import ChainCrane
from mechanisms.header_balancer import HeaderBalancer
from mechanisms.three_point_hitch import ThreePointHitch


class Jib(Mechanism):
    """A jib given by its angle."""

    phi = Stroke(-30 * deg, 60 * deg)
    O, K, P = Ground(0.0, 1.0), Ground(0.3, -0.6), Ground(-0.4, 0.3)
    B = Crank(O, OB=0.8, angle=phi)
    T = OnLink(O, B, OT=2.0)
    load = Weight(T, mass=200)


class Hung(Jib):
    """All kinds, each between points of its own."""

    lift = Cylinder("K", "B", bore=0.08, rod=0.045)
    relief = Spring("P", "B", stiffness=2e3, free_length=0.5)
    calm = Damper("P", "T", coefficient=300.0)
    push = Actuator("K", "T", force=500.0)


class Shared(Jib):
    """Three on the same pins, one of them the other way round."""

    lift = Cylinder("K", "B", bore=0.08, rod=0.045)
    relief = Spring("B", "K", stiffness=2e3, free_length=0.5)
    calm = Damper("K", "B", coefficient=300.0)


class Helped(ThreePointHitch):
    """A spring on the driven cylinder's pins, and a cylinder of the same line elsewhere."""

    relief = Spring("A", "B", stiffness=2e4, free_length=0.4)
    aux = Cylinder("O", "D", bore=0.05, rod=0.03)
    circuit = LiftCircuit(["lift", "aux"], pressure=180 * bar)


class Floating(Jib):
    gas = Cylinder("K", "B", bore=0.06, rod=0.04)
    line = FloatCircuit(gas, AccumulatorBlock([Accumulator(2 * litre, 30 * bar)], isothermal), charge_pressure=60 * bar, at="phi0")
    phi0 = Dimension(0.0)


class Primitive(Mechanism):
    """A lever on a cylinder by the vector method."""

    S = Stroke(0.05, 0.30)
    L0, LOB = Dimension(0.5), Dimension(0.175)
    A, O = Ground(0.0, 0.242), Ground(0.652, 0.330)
    AO = Vector(A, O)
    OAB = CosineAngle(abs(AO), L0 + S, LOB)
    AB = Turn(AO, -OAB, length=L0 + S)
    B = Offset(A, AB)
    lever = Link("O B", OB=LOB)
    ram = Link("A B", AB=L0 + S)


class Composite(Mechanism):
    """The same by a dyad."""

    S = Stroke(0.05, 0.30)
    A, O = Ground(0.0, 0.242), Ground(0.652, 0.330)
    B = Dyad(A, O, AB=0.5 + S, OB=0.175, side=RIGHT)


@dataclass(frozen=True, eq=False)
class Chain(TwoPoint):
    """A user's own."""

    A: Any
    B: Any

    def push(self, motion, length, rate):
        return np.minimum(0.9 - length, 0.0) * 1e5


@dataclass(frozen=True, eq=False)
class GasStrut(Chain):
    drawn_as: ClassVar = "cylinder"


def axes():
    return Figure(figsize=(7, 6)).add_subplot()


def drawn(cls, count=5):
    motion = cls().sweep(count)
    return motion, mechanism(axes(), motion)


def parts(drawing, kind):
    return [part for part in drawing.parts if isinstance(part, kind)]


def elements(drawing):
    return [part for part in parts(drawing, MarkPart) if part.mark in drawing.scene.straights]


def cylinders(drawing):
    return [part for part in parts(drawing, MarkPart) if part.mark.cylinder is not None]


def circles(drawing):
    return {part.points[0]: part.circle for part in drawing.parts if hasattr(part, "circle")}


def local(points, P, Q):
    """Return points along P -> Q and to its left."""
    along = (Q - P) / np.hypot(*(Q - P))
    return (points - P) @ np.array([along, [-along[1], along[0]]]).T


@pytest.mark.parametrize("cls", [Hung, Shared, Helped, Floating])
def test_every_element_reaches_from_pin_to_pin_at_every_pose(cls):
    motion, drawing = drawn(cls)
    scene = drawing.scene
    hung = {frozenset(each.ends) for each in motion.plan.of_kind(TwoPoint).values()}
    assert hung <= {frozenset((each.P, each.Q)) for each in scene.two_force}
    for pose in range(5):
        drawing.update(pose)
        for part in elements(drawing):
            if part.mark in scene.accumulators:
                continue  # accumulators stand beside a barrel
            P, Q = (motion[name][:, pose] for name in part.points)
            places = local(np.concatenate([each.get_xy() for each in part.artists]), P, Q)
            length = np.hypot(*(Q - P))
            assert_allclose([places[:, 0].min(), places[:, 0].max()], [0.0, length], atol=0.5 * scene.size)
        for part in cylinders(drawing):
            P, Q = (motion[name][:, pose] for name in part.points)
            places = local(np.concatenate([each.get_xy() for each in part.artists]), P, Q)
            assert_allclose([places[:, 0].min(), places[:, 0].max()], [0.0, np.hypot(*(Q - P))], atol=1e-9)
            assert_allclose(0.5 * (places[:, 1].min() + places[:, 1].max()), part.mark.cylinder.aside, atol=1e-12)


def test_a_spring_is_a_zigzag_about_its_line_that_stretches():
    motion, drawing = drawn(Hung)
    (part,) = [each for each in elements(drawing) if each.points == ("P", "B")]
    (line,) = part.artists
    assert not line.get_closed() and not line.get_fill()
    counts = set()
    for pose in range(5):
        drawing.update(pose)
        along, across = local(line.get_xy(), motion["P"][:, pose], motion["B"][:, pose]).T
        assert (np.diff(along) > 0.0).all()  # no coil is folded over
        assert_allclose(across.max(), HALF["spring"] * drawing.scene.size)
        counts.add(int((np.diff(np.sign(across[np.abs(across) > 1e-9])) != 0.0).sum()))
    assert len(counts) == 1 and counts.pop() >= 7


def test_a_dampers_plate_stays_in_its_pot():
    motion, drawing = drawn(Hung, 31)
    (part,) = [each for each in elements(drawing) if each.points == ("P", "T")]
    pot, *_, plate = part.artists
    places = []
    for pose in range(31):
        drawing.update(pose)
        (bottom, mouth), (disc, _) = (
            (lambda along: (along.min(), along.max()))(local(each.get_xy(), motion["P"][:, pose], motion["T"][:, pose])[:, 0])
            for each in (pot, plate)
        )
        assert 0.0 < bottom < disc < mouth < np.hypot(*(motion["T"] - motion["P"])[:, pose])
        places.append(disc)
    assert_allclose(np.corrcoef(places, motion.distance("P", "T"))[0, 1], 1.0)  # it goes with the length


def test_elements_on_the_same_pins_stand_side_by_side():
    motion, drawing = drawn(Shared)
    scene = drawing.scene
    aside = {each.drawn_as: each.aside * (1.0 if each.P == "K" else -1.0) for each in scene.two_force}
    assert sorted(aside) == ["cylinder", "damper", "spring"]
    (low, one), (_, two), (high, three) = sorted((place, HALF[kind]) for kind, place in aside.items())
    assert_allclose(low + high, 0.0)
    assert high - low > one + 2.0 * two + three  # none covers another
    (ram,) = scene.cylinders
    assert_allclose(ram.aside, aside["cylinder"] * scene.size)
    drawing.update(2)
    K, B = motion["K"][:, 2], motion["B"][:, 2]
    spans = {}
    for part in (*elements(drawing), *cylinders(drawing)):
        inner = [local(each.get_xy(), K, B) for each in part.artists]
        body = np.concatenate([each[(each[:, 0] > 0.2) & (each[:, 0] < np.hypot(*(B - K)) - 0.2)] for each in inner])
        if body.size:
            spans[part] = body[:, 1].min(), body[:, 1].max()
    ordered = sorted(spans.values())
    assert len(ordered) == 3 and all(left[1] < right[0] for left, right in pairwise(ordered))


def test_a_spring_beside_the_driven_cylinder_and_a_cylinder_of_its_own():
    scene = Scene(Helped().sweep(5))
    assert [({ram.P, ram.Q}, ram.aside != 0.0) for ram in scene.cylinders] == [({"A", "B"}, True), ({"O", "D"}, False)]
    assert [each.drawn_as for each in scene.two_force if {each.P, each.Q} == {"A", "B"}] == ["cylinder", "spring"]


@pytest.mark.parametrize("cls", [ThreePointHitch, HeaderBalancer])
def test_the_cylinder_declared_on_a_driven_length_is_drawn_once(cls):
    scene = Scene(cls().sweep(5))
    assert [(ram.P, ram.Q, ram.aside) for ram in scene.cylinders] == [("A", "B", 0.0)]
    assert scene.straights == scene.accumulators
    assert len(scene.accumulators) == (cls is HeaderBalancer)


def test_a_gas_fed_cylinder_beside_a_crank_is_a_cylinder():
    scene = Scene(Floating().sweep(5))
    assert [(ram.P, ram.Q) for ram in scene.cylinders] == [("K", "B")]


def test_the_ends_of_elements_are_pins_and_stand_on_the_ground():
    _, bare = drawn(Jib)
    assert bare.scene.pins == ("O",) and set(bare.scene.dots) == {"K", "P", "B", "T"}
    _, hung = drawn(Hung)
    assert set(hung.scene.pins) == {"O", "K", "P", "B", "T"}
    assert set(hung.scene.grounds) == {"O", "K", "P"}
    colours = {name: circle.get_facecolor()[:3] for name, circle in circles(hung).items()}
    assert len(set(colours.values())) == 1  # all are drawn as pins


def test_a_users_own_is_a_strut_unless_it_says_otherwise():
    own = type("Own", (Jib,), {"chain": Chain("K", "T"), "gas": GasStrut("P", "T"), "law": Between("P", "B", lambda length, rate: -length)})
    scene = Scene(own().sweep(3))
    assert {each.P + each.Q: each.drawn_as for each in scene.two_force} == {"KT": "strut", "PT": "cylinder", "PB": "strut"}
    with pytest.raises(DefinitionError, match=r"Wrong: drawn_as='zigzag' is none of strut, spring, damper, cylinder"):
        type("Wrong", (Chain,), {"drawn_as": "zigzag"})


def test_primitives_with_links_look_like_the_composite_spelling():
    one, other = (drawn(cls) for cls in (Primitive, Composite))
    for kind in (lambda drawing: parts(drawing, BodyPart), cylinders):
        for pose in range(5):
            outlines = []
            for _, drawing in (one, other):
                drawing.update(pose)
                outlines.append([artist.get_xy() for part in kind(drawing) for artist in part.artists])
            assert len(outlines[0]) == len(outlines[1]) > 0
            for first, second in zip(*outlines, strict=True):
                assert_allclose(sorted(first.tolist()), sorted(second.tolist()), atol=1e-9)
    assert one[1].scene.stays == () and one[1].scene.pins == other[1].scene.pins


def test_a_faint_element_is_paler():
    motion = Hung().sweep(3)
    strong, faint = (elements(mechanism(axes(), motion, faint=each))[0].artists[0].get_edgecolor() for each in (False, True))
    assert sum(faint[:3]) > sum(strong[:3])


def test_a_page_stretches_the_same_lines():
    drawing = drawn(Shared)[1]
    scene = drawing.scene
    names = list(scene.places)
    data = [mark_data(each, {name: place for place, name in enumerate(names)}) for each in scene.straights]
    assert {line.get("fill", "") for each in data for line in each["lines"]} <= {"", "piston", "rod", "barrel"}
    assert all(hasattr(style, line["fill"].upper()) for each in data for line in each["lines"] if "fill" in line)
    pose = 3
    drawing.update(pose)
    for part, each in zip(elements(drawing), data, strict=True):
        P, Q = (scene.at(pose)[names[number]] for number in each["on"])
        along = (Q - P) / np.hypot(*(Q - P))
        turned = np.array([along, [-along[1], along[0]]])
        for artist, line in zip(part.artists, each["lines"], strict=True):
            way, across, share = (*np.array(line["rows"]).T, 0.0)[:3]
            seen = P + np.column_stack([share * np.hypot(*(Q - P)) + way, across]) @ turned
            assert_allclose(seen, artist.get_xy()[: len(seen)], atol=2e-4)


def test_a_rope_runs_over_rollers_at_its_pins_on_the_side_it_turns_to():
    """At a pin the rope's straight parts touch a drawn roller, which stands on the inner side of the turn; at its ends it has none."""
    crane = ChainCrane()
    scene = Scene(crane.at(phi=1.0, psi=2.0, t=1.0))
    at = scene.at(0)
    assert sorted(mark.on[0] for mark in scene.pulleys) == ["D", "Z"]
    for mark in scene.pulleys:
        (radius,) = {round(float(np.hypot(*point)), 9) for point in mark.corners}
        assert radius > scene.size
        lines = [rope.drawn(at)[0] for rope in scene.ropes if mark.on[0] in rope.on]
        ends = [line[int(np.argmin(np.hypot(*(line - at[mark.on[0]]).T)))] for line in lines]
        assert_allclose([np.hypot(*(end - at[mark.on[0]])) for end in ends], radius, rtol=1e-2)  # drawn to the first order
        assert np.hypot(*(ends[0] - ends[1])) > 1.5 * radius  # one part above, one below: the chain turns back
