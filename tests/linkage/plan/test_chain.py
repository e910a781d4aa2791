"""The kinematic chain as a graph: what its nodes and edges say, and its picture."""

from itertools import combinations
from math import sqrt

import networkx as nx
import pytest
from numpy.testing import assert_allclose

from linkage import (
    LEFT,
    RIGHT,
    Crank,
    DefinitionError,
    Dyad,
    Ground,
    Guide,
    Link,
    Mechanism,
    OnGuide,
    OnLink,
    SliderDyad,
    Stroke,
    angle,
    draw,
)
from mechanisms.classics.scotch_yoke import ScotchYoke
from mechanisms.three_point_hitch import ThreePointHitch
from tests.shipped import over_machines


class Lever(Mechanism):
    """A cylinder AB turns the bell crank OBC."""

    S = Stroke(0.0, 0.2)
    A, O = Ground(0.0, 0.3), Ground(0.6, 0.3)
    B = Dyad(A, O, AB=0.5 + S, OB=0.3, side=RIGHT)
    C = OnLink(O, B, OC=0.4, BOC=1.5)
    lever = Link(O, B, C)


def edges(graph):
    """Return the edges by their bodies and names: kind and strokes."""
    return {(frozenset(pair), key): (data["kind"], data["strokes"]) for *pair, key, data in graph.edges(keys=True, data=True)}


def test_bodies_and_joints_of_a_lever():
    graph = Lever().graph
    assert isinstance(graph, nx.MultiGraph) and graph.name == "Lever"
    kinds = {name: (data["kind"], data["points"], data["link"]) for name, data in graph.nodes(data=True)}
    assert kinds == {
        "frame": ("frame", ("A", "O"), ""), "OBC": ("body", ("O", "B", "C"), "lever"), "AB barrel": ("barrel", ("A",), ""),
        "AB rod": ("rod", ("B",), ""),
    }  # fmt: skip
    assert edges(graph) == {
        (frozenset(("frame", "OBC")), "O"): ("pin", ()), (frozenset(("frame", "AB barrel")), "A"): ("pin", ()),
        (frozenset(("OBC", "AB rod")), "B"): ("pin", ()), (frozenset(("AB barrel", "AB rod")), "AB"): ("slide", ("S",)),
    }  # fmt: skip
    assert graph.edges["AB barrel", "AB rod", "AB"]["dimensions"] == {"AB": "0.5 + S"}


def test_dimensions_are_those_of_the_design():
    known = Lever(OB=0.35).graph.nodes["OBC"]["dimensions"]
    assert list(known) == ["OB", "OC", "BC"] and known["OB"] == 0.35
    assert_allclose([known["OC"], known["BC"]], [0.4, sqrt(0.35**2 + 0.4**2 - 2 * 0.35 * 0.4 * 0.0707372016677029)], rtol=1e-12)
    assert_allclose(Lever(OB=[0.3, 0.35]).graph.nodes["OBC"]["dimensions"]["OB"], [0.3, 0.35])
    assert Lever(OB=3.0).graph.nodes["OBC"]["dimensions"]["OB"] == 3.0  # out of reach, and a graph as any other


def test_a_pin_of_three_bodies_is_two_edges():
    class Fan(Mechanism):
        phi = Stroke(0.3, 1.0)
        O, C, D = Ground(0.0, 0.0), Ground(1.0, 0.0), Ground(1.2, 0.2)
        A = Crank(O, OA=0.3, angle=phi)
        B = Dyad(A, C, AB=0.9, CB=0.7, side=LEFT)
        E = Dyad(A, D, AE=0.9, DE=0.7, side=LEFT)

    graph = Fan().graph
    assert sorted(key for *_, key in graph.edges(keys=True)) == ["A", "A", "B", "C", "D", "E", "O"]
    assert graph.edges["frame", "OA", "O"]["strokes"] == ("phi",)
    assert 3 * (6 - 1) - 2 * 7 == Fan().gruebler == 1


def test_a_point_on_a_guide_is_a_block():
    class SliderCrank(Mechanism):
        phi, S = Stroke(0.2, 1.0), Stroke(0.0, 0.1)
        O = Ground(0.0, 0.0)
        rail, post = Guide((0.0, 0.0), angle=0.0), Guide((0.5, -0.5), angle=1.5)
        A = Crank(O, OA=0.1, angle=phi)
        C = SliderDyad(A, rail, AC=0.4, side=RIGHT)
        D = OnGuide(post, at=S)

    found = edges(SliderCrank().graph)
    assert found[frozenset(("AC", "C (block)")), "C"] == ("pin", ())
    assert found[frozenset(("frame", "C (block)")), "rail"] == ("slide", ())
    assert found[frozenset(("frame", "D (block)")), "post"] == ("slide", ("S",))
    assert SliderCrank().gruebler == SliderCrank().mobility == 2


def test_a_yoke_slides_on_its_rail_and_carries_the_slot():
    assert edges(ScotchYoke().graph) == {
        (frozenset(("frame", "OA")), "O"): ("pin", ("phi",)), (frozenset(("OA", "A (block)")), "A"): ("pin", ()),
        (frozenset(("X (slider)", "A (block)")), "X"): ("slide", ()), (frozenset(("frame", "X (slider)")), "rail"): ("slide", ()),
    }  # fmt: skip


class Boom(Mechanism):
    """A boom turned by its drive."""

    phi = Stroke(0.2, 1.0)
    O = Ground(0.0, 0.0)
    J = Crank(O, OJ=2.0, angle=phi)


def test_arms_slide_turn_or_both():
    """A telescope slides; an arm at a driven angle turns; one that does both has a carriage. With a lug it is the same arm."""

    class Telescope(Boom):
        T = Stroke(0.0, 0.4)
        K = OnLink("O", "J", OK=2.2 + T)

    class Turned(Boom):
        psi = Stroke(1.5, 2.6)
        K = OnLink("J", "O", JK=1.4, OJK=psi)

    class Both(Boom):
        psi, T = Stroke(1.5, 2.6), Stroke(0.0, 0.4)
        K = OnLink("J", "O", JK=1.4 + T, OJK=psi)

    class Lugged(Both):
        N = OnLink("K", "J", KN=0.3, JKN=1.0)

    assert edges(Telescope().graph)[frozenset(("OJ", "K")), "K"] == ("slide", ("T",))
    assert edges(Turned().graph)[frozenset(("OJ", "K")), "J"] == ("pin", ("psi",))
    both = edges(Both().graph)
    assert both[frozenset(("OJ", "J (carriage)")), "J"] == ("pin", ("psi",))
    assert both[frozenset(("J (carriage)", "K")), "K"] == ("slide", ("T",))
    assert edges(Lugged().graph)[frozenset(("J (carriage)", "KN")), "K"] == ("slide", ("T",))
    for machine, freedoms in ((Telescope, 2), (Turned, 2), (Both, 3), (Lugged, 3)):
        assert machine().gruebler == machine().mobility == freedoms == len(machine.plan.strokes)


def test_a_relative_crank_is_driven_by_its_own_stroke():
    class Arm(Boom):
        psi = Stroke(1.5, 2.6)
        K = Crank("J", JK=1.4, angle=angle("J", "O") + psi)

    assert edges(Arm().graph)[frozenset(("OJ", "JK")), "J"] == ("pin", ("psi",))


# -- the picture ---------------------------------------------------------------------------------------------


@pytest.mark.slow
@over_machines()
def test_the_picture_has_every_body_and_joint_and_none_upon_another(machine):
    graph = machine().graph
    figure = draw(graph)
    figure.canvas.draw()
    (ax,) = figure.axes
    marks = [(text.get_gid(), text.get_bbox_patch().get_window_extent(figure.canvas.get_renderer())) for text in ax.texts]
    names = [f"joint {key}" for *_, key in graph.edges(keys=True)] + [f"body {name}" for name in graph]
    assert sorted(name for name, _ in marks) == sorted(names)
    assert [(one, other) for (one, a), (other, b) in combinations(marks, 2) if a.overlaps(b)] == []
    assert all(box.x0 > 0.0 and box.x1 < figure.bbox.width and box.y0 > 0.0 and box.y1 < figure.bbox.height for _, box in marks)


def test_the_picture_says_its_count_and_its_strokes():
    figure = draw(ThreePointHitch().graph)
    words = [text.get_text() for text in (*figure.texts, *figure.axes[0].texts)]
    assert "3 (8 − 1) − 2 · 10 = 1" in words and "lift\nS" in words


@pytest.mark.parametrize(("graph", "options"), [(nx.MultiGraph([(1, 2)]), {}), (nx.MultiGraph(), {}), (Lever().graph, {"at": 0.1})])
def test_what_is_no_graph_of_a_machine_is_refused(graph, options):
    with pytest.raises(DefinitionError, match=r"draw\((machine\.)?graph\)"):
        draw(graph, **options)
