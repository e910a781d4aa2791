"""A step of one's own in plain arithmetic: where its root has no value the point is out of reach, in every way of asking."""

import numpy as np
import pytest

from linkage import AssemblyError, Crank, DefinitionError, Dimension, Ground, Mechanism, Stroke, draw
from linkage.steps import Point
from tests.for_all import for_all


class Apex(Point):
    """The apex of a triangle with two sides r over A -> C, left of it."""

    expects = (("A", "point"), ("C", "point"))

    def __init__(self, A, C, r):
        self.A, self.C, self.r = A, C, r

    def parts(self):
        return self.A, self.C, self.r

    def place(self, where):
        a, c, r = where.at(self.A), where.at(self.C), where.value(self.r)
        d = c - a
        return a + d * 0.5 + d.left() * (np.sqrt(r * r - 0.25 * d.dot(d)) / d.length())


class Flap(Mechanism):
    phi = Stroke(-2.0, 4.0)
    r = Dimension(0.3)
    O, C = Ground(0, 0), Ground(0.7, 0)
    A = Crank(O, OA=0.2, angle=phi)
    B = Apex(A, C, r)


BORDER = np.arccos((0.53 - 0.36) / 0.28)  # AC = 2 r by the cosine rule
BEYOND = r"B = Apex\(A, C, r\) cannot be assembled at"


@for_all(
    "ask",
    [
        lambda: Flap().sweep(9),
        lambda: Flap().at(phi=1.0),
        lambda: Flap(r=0.2).sweep(3),
        lambda: Flap().evaluate(["B"], phi=1.0),
        lambda: Flap().function(["B"])(1.0),
        lambda: draw(Flap(r=0.1)),
    ],
)
def test_a_root_without_value_is_told_by_name(ask):
    with pytest.raises(AssemblyError, match=BEYOND):
        ask()


def test_its_reach_is_that_of_the_geometry():
    (interval,) = Flap().at(phi=0.0).limits()["phi"].intervals
    assert np.allclose([interval.low, interval.high], [-BORDER, BORDER], atol=1e-7)
    motion = Flap().sweep(97, unreachable="nan")
    assert np.array_equal(motion.reached, np.abs(motion.strokes["phi"]) <= BORDER)
    assert np.array_equal(motion.reached, np.isfinite(motion["B"]).all(axis=0))


def test_a_step_without_a_place_says_so():
    class Nowhere(Point):
        def parts(self):
            return ("A",)

    with pytest.raises(DefinitionError, match=r"P: Nowhere does not say where its point lies; give it place\(where\)"):

        class Lost(Mechanism):
            S = Stroke(0, 1)
            O = Ground(0, 0)
            A = Crank(O, OA=0.2, angle=S)
            P = Nowhere()

        Lost().at(S=0.5)


@pytest.mark.parametrize(
    "rule", [lambda x: x if x > 0 else -x, lambda x: np.where(x >= 0.0, x, -x), lambda x: max(x, 0.0), lambda x: min(1.0, x)]
)
def test_a_rule_that_compares_is_refused_in_words(rule):
    class Switch(Apex):
        def place(self, where):
            place = super().place(where)
            return place + (where.at(self.C) - place) * rule(place.x)

    with pytest.raises(DefinitionError, match=r"cannot be compared, in an `if` or in np\.where; np\.minimum, np\.maximum and abs choose"):

        class Other(Flap):
            B = Switch(Flap.A, Flap.C, Flap.r)

        Other().at(phi=0.1)


def test_a_motion_drawn_at_a_pose_says_which():
    figure = draw(Flap().at(phi=[0.1, -0.2]), pose=1)
    assert any("phi = \N{MINUS SIGN}11.46°" in text.get_text() for text in figure.texts)


@pytest.mark.parametrize("given", [{"path": ["B"]}, {"at": [0.1]}, {"count": 5}])
def test_what_only_a_machine_is_drawn_with_is_refused_with_a_motion(given):
    with pytest.raises(DefinitionError, match=r"Flap: a motion is drawn at one of its poses, .*; at=, path= and count="):
        draw(Flap().at(phi=0.1), **given)
