"""Steps: where they place their point, against what is known of each figure, and what they refuse."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import (
    LEFT,
    RIGHT,
    CosineAngle,
    Crank,
    DefinitionError,
    Dyad,
    Ground,
    Guide,
    GuideCross,
    Mechanism,
    Offset,
    OnGuide,
    OnLink,
    PinSlotDyad,
    SliderDyad,
    Stroke,
    Turn,
    Vector,
    YokeDyad,
    angle,
    deg,
)
from tests.for_all import for_all


class Triangle345(Mechanism):
    """Every way to reach the right angle of a 3-4-5 triangle over AO = 5."""

    S = Stroke(0.0, 0.5)
    A, O = Ground(0.0, 0.0), Ground(5.0, 0.0)
    far = Ground(9.0, 9.0)
    left = Dyad(A, O, Aleft=3.0 + 0 * S, Oleft=4.0, side=LEFT)
    right = Dyad(A, O, Aright=3.0 + 0 * S, Oright=4.0, side=RIGHT)
    third = OnLink(A, O, Athird=3.0, Othird=4.0, side=LEFT)
    turned = OnLink(A, O, Aturned=3.0, OAturned=np.arccos(0.6))
    mirrored = OnLink(A, O, Amirrored=3.0, OAmirrored=np.arccos(0.6), side=RIGHT)
    straight = OnLink(A, O, Astraight=7.0)
    AO = Vector(A, O)
    corner = CosineAngle(abs(AO), 3.0 + 0 * S, 4.0)
    primitive = Offset(A, Turn(AO, corner, length=3.0))
    kept = Offset(A, Turn(AO, 90 * deg))
    driven = Crank(O, Odriven=2.0, angle=S)


@for_all(
    ("point", "place"),
    [
        ("left", (1.8, 2.4)),
        ("right", (1.8, -2.4)),
        ("third", (1.8, 2.4)),
        ("turned", (1.8, 2.4)),
        ("mirrored", (1.8, -2.4)),
        ("straight", (7.0, 0.0)),
        ("primitive", (1.8, 2.4)),
        ("kept", (0.0, 5.0)),
        ("driven", (7.0, 0.0)),
    ],
)
def test_place(point, place):
    assert_allclose(Triangle345().at(S=0.0)[point], place, atol=1e-14)


def test_vector_and_angle_of_the_vector_method():
    motion = Triangle345().at(S=0.0)
    assert_allclose(motion["AO"], (5.0, 0.0))
    assert_allclose(motion["corner"], np.arccos(0.6), rtol=1e-14)


class SliderCrank(Mechanism):
    """The textbook slider-crank, crank r, connecting rod l, on the x axis: x = r cos(phi) + sqrt(l2 - r2 sin2(phi))."""

    phi = Stroke(0.0, 2 * np.pi)
    O = Ground(0.0, 0.0)
    rail = Guide(O, angle=0.0 * phi)
    A = Crank(O, OA=0.1, angle=phi)
    C = SliderDyad(A, rail, AC=0.3, side=RIGHT)
    back = SliderDyad(A, rail, Aback=0.3, side=LEFT)


def test_slider_crank():
    motion = SliderCrank().sweep(73)
    phi = motion.strokes["phi"]
    root = np.sqrt(0.3**2 - (0.1 * np.sin(phi)) ** 2)
    assert_allclose(motion.x("C"), 0.1 * np.cos(phi) + root, rtol=1e-13)
    assert_allclose(motion.x("back"), 0.1 * np.cos(phi) - root, rtol=1e-13)
    assert_allclose(motion.y("C"), 0.0, atol=1e-16)
    slope = -0.1 * np.sin(phi) * (1 + 0.1 * np.cos(phi) / root)
    assert_allclose(motion.ratio("C")[0], slope, atol=1e-13)


class Yoke(Mechanism):
    """A Scotch yoke and a Whitworth quick return on one crank; the yoke's slider moves as the pure cosine."""

    phi = Stroke(0.0, 2 * np.pi)
    O, Q = Ground(0.0, 0.0), Ground(0.0, -0.3)
    A = Crank(O, OA=0.1, angle=phi)
    rail = Guide((0.0, -0.2), angle=0)
    X = YokeDyad(A, rail)
    R = PinSlotDyad(Q, A, QR=0.5)
    ahead = OnGuide(rail, at=0.3)
    swing = angle(Q, R)


def test_scotch_yoke_is_the_pure_cosine():
    motion = Yoke().sweep(37)
    phi = motion.strokes["phi"]
    assert_allclose(motion["X"], [0.1 * np.cos(phi), np.full(37, -0.2)], atol=1e-14)
    assert_allclose(motion.ratio("X", order=2)[0], -0.1 * np.cos(phi), atol=1e-13)


def test_quick_return_points_at_the_pin():
    motion = Yoke().sweep(37)
    assert_allclose(motion["swing"], motion.angle("Q", "A"), rtol=1e-13)
    assert_allclose(motion.distance("Q", "R"), 0.5, rtol=1e-13)


def test_guides_cross_where_lines_do():
    class Cross(Mechanism):
        """A fixed line and one that rises."""

        S = Stroke(0.0, 1.0)
        A = Ground(0.0, 0.0)
        post = Guide((2.0, 0.0), angle=90 * deg)
        ramp = Guide(A, angle=S)
        X = GuideCross(ramp, post)

    motion = Cross().sweep(5)
    assert_allclose(motion["X"], [np.full(5, 2.0), 2.0 * np.tan(motion.strokes["S"])], atol=1e-14)


MISSING = {
    "no length": lambda P, Q: Dyad(P, Q, AB=1.0, side=LEFT),
    "no side": lambda P, Q: Dyad(P, Q, AB=1.0, OB=1.0),
    "no distance": lambda P, Q: OnLink(P, Q, OB=1.0, side=LEFT),
    "angle and side": lambda P, Q: OnLink(P, Q, AB=1.0, OB=1.0, OAB=0.3, side=LEFT),
    "third side, no side": lambda P, Q: OnLink(P, Q, AB=1.0, OB=1.0),
    "one parent twice": lambda P, Q: Dyad(P, P, AB=1.0, side=LEFT),
    "itself": lambda P, Q: Dyad(P, "B", AB=1.0, BB=1.0, side=LEFT),
    "constant crank": lambda P, Q: Crank(P, AB=1.0, angle=0.3),
    "crank without length": lambda P, Q: Crank(P, angle="S"),
    "a stroke for a point": lambda P, Q: Dyad("S", Q, SB=1.0, OB=1.0, side=LEFT),
    "a point for an angle": lambda P, Q: Crank(P, AB=1.0, angle="O"),
    "a point for a length": lambda P, Q: Dyad(P, Q, AB="O", OB=1.0, side=LEFT),
    "a point for a vector": lambda P, Q: Offset(P, "O"),
    "a number for a vector": lambda P, Q: Offset(P, 3.0),
    "a number for a point": lambda P, Q: Dyad(3.0, Q, AB=1.0, OB=1.0, side=LEFT),
    "a point without a name": lambda P, Q: Dyad(Ground(0, 0), Q, AB=1.0, OB=1.0, side=LEFT),
    "side as a number": lambda P, Q: Dyad(P, Q, AB=1.0, OB=1.0, side=1),
    "side as a word": lambda P, Q: Dyad(P, Q, AB=1.0, OB=1.0, side="LEFT"),
    "half a sketch": lambda P, Q: Dyad(P, Q, AB=1.0, OB=1.0, near=(1.0,)),
    "no sketch": lambda P, Q: Dyad(P, Q, AB=1.0, OB=1.0, near=(1.0, float("nan"))),
    "negative length": lambda P, Q: Dyad(P, Q, AB=-1.0, OB=1.0, side=LEFT),
    "no length at all": lambda P, Q: Dyad(P, Q, AB=0.0, OB=1.0, side=LEFT),
    "not a number": lambda P, Q: Dyad(P, Q, AB=float("nan"), OB=1.0, side=LEFT),
    "not a number inside": lambda P, Q: Offset(P, Turn("AO", 0.1, length=-1.0)),
    "guide without direction": lambda P, Q: Guide(P),
    "guide with two directions": lambda P, Q: Guide(P, Q, angle=1.0),
    "guide without origin": lambda P, Q: Guide(None, angle=1.0),
    "ground that moves": lambda P, Q: Ground(0.0, "S"),
    "ground nowhere": lambda P, Q: Ground(0.0, float("inf")),
    "slider on a point": lambda P, Q: SliderDyad(P, Q, AB=1.0, side=LEFT),
    "impossible triangle side": lambda P, Q: CosineAngle(0.0, 1.0, 1.0),
}


@for_all("what", MISSING)
def test_step_that_cannot_be_is_refused_by_name(what):
    A, O = Ground(0.0, 0.0), Ground(1.0, 0.0)

    def declare():
        return type("Wrong", (Mechanism,), {"S": Stroke(0.0, 0.1), "A": A, "O": O, "AO": Vector(A, O), "B": MISSING[what](A, O)})

    with pytest.raises(DefinitionError):
        declare()
