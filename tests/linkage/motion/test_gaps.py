"""The gap of two bodies against the Minkowski difference of their points, and the transmission angle as a request."""

from itertools import product

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.spatial import ConvexHull, QhullError

from linkage import (
    LEFT,
    Crank,
    DefinitionError,
    Ground,
    Link,
    Mechanism,
    OnLink,
    Spring,
    Stroke,
    distance,
    drive_force,
    gap,
    transmission,
)
from mechanisms.classics.front_loader import FrontLoader
from mechanisms.classics.slider_crank import SliderCrank
from mechanisms.classics.stephenson_two import StephensonTwo
from mechanisms.three_point_hitch import ThreePointHitch
from tests.benchmarks.c_reference import POINTER, address, built, has_compiler
from tests.for_all import for_all
from tests.linkage.motion.test_source import arguments
from tests.linkage.motion.test_transmission import Sliders


class Arms(Mechanism):
    """Two cranks that swing through each other: a plate and a bar, a crank beside it, a spring and pins of the frame."""

    phi, psi = Stroke(0.0, 2.0 * np.pi), Stroke(0.0, 2.0 * np.pi)
    O, Q, N, M = Ground(0.0, 0.0), Ground(1.0, 0.1), Ground(0.4, 1.1), Ground(0.9, 1.4)
    A = Crank(O, OA=0.9, angle=phi)
    B = OnLink(O, A, OB=0.5, AOB=0.7, side=LEFT)
    C = OnLink(O, A, OC=0.3, AOC=0.2, side=LEFT)  # inside the plate
    D = Crank(Q, QD=0.8, angle=psi)
    E = OnLink(Q, D, QE=0.4)  # in line: a bar
    plate = Link(O, A, B, C)
    relief = Spring(N, M, stiffness=1e3, free_length=0.5)


def independent(a, b):
    """Return the signed gap of two convex hulls, points (n, 2) each, from the hull of all differences of their points."""
    differences = np.array([P - Q for P, Q in product(a, b)])
    try:
        shape = ConvexHull(differences)
        inside = float(np.max(shape.equations[:, 2]))
        corners = differences[shape.vertices]
    except (QhullError, ValueError):  # flat: a segment or a point
        along = np.linalg.svd(differences - differences.mean(axis=0))[2][0]
        inside, corners = 0.0, differences[[np.argmin(differences @ along), np.argmax(differences @ along)]]
    if inside < 0.0:
        return inside
    starts, ends = corners, np.roll(corners, -1, axis=0)
    ways = ends - starts
    square = np.maximum((ways**2).sum(axis=1), 1e-300)
    share = np.clip(-(starts * ways).sum(axis=1) / square, 0.0, 1.0)
    return float(np.min(np.hypot(*(starts + share[:, None] * ways).T)))


PAIRS = [("plate", "QDE"), ("D", "OABC"), ("QDE", "relief"), ("N", "plate"), ("relief", "O A"), ("A", "D"), ("M", "relief")]


@for_all(("a", "b"), PAIRS[:6], ids=map("-".join, PAIRS[:6]))
def test_the_gap_is_that_of_the_difference_of_the_shapes(a, b):
    rng, machine = np.random.default_rng(3), Arms()
    strokes = {"phi": rng.uniform(0.0, 6.28, 150), "psi": rng.uniform(0.0, 6.28, 150)}
    motion = machine.at(**strokes)
    points = {"plate": "OABC", "QDE": "QD", "relief": "NM", "OABC": "OABC", "O A": "OABC"}
    shapes = [np.stack([motion[point] for point in points.get(each, each)]) for each in (a, b)]
    expected = np.array([independent(shapes[0][:, :, k], shapes[1][:, :, k]) for k in range(150)])
    found = motion[gap(a, b)]
    assert_allclose(found, expected, atol=1e-9)
    if (a, b) in PAIRS[:2]:
        assert np.any(expected < -0.01) and np.any(expected > 0.05)
    assert_allclose(machine.evaluate([gap(a, b), gap(b, a, width=0.04)], **strokes), [found, found - 0.04], atol=1e-12)
    assert_allclose(machine.function([gap(a, b)])(**{name: float(value[7]) for name, value in strokes.items()}), found[7:8], atol=1e-12)


def test_the_gradient_of_a_gap_is_the_central_difference():
    rng, wrt = np.random.default_rng(5), ["OA", "QD", "Q.x", "Q.y", "OB"]
    strokes = {"phi": rng.uniform(0.0, 6.28, 12), "psi": rng.uniform(0.0, 6.28, 12)}
    request = gap("plate", "QDE")
    exact = Arms().at(**strokes).gradient(request, wrt)
    step = 1e-6
    moved = {"OA": lambda h: {"OA": 0.9 + h}, "QD": lambda h: {"QD": 0.8 + h}, "OB": lambda h: {"OB": 0.5 + h}}
    moved |= {"Q.x": lambda h: {"Q": (1.0 + h, 0.1)}, "Q.y": lambda h: {"Q": (1.0, 0.1 + h)}}
    for row, name in zip(exact, wrt, strict=True):
        up, down = (Arms(**moved[name](way)).at(**strokes)[request] for way in (step, -step))
        assert_allclose(row, (up - down) / (2.0 * step), atol=1e-8, err_msg=name)


def test_bars_in_line_and_points_are_apart_by_their_distance():
    class Row(Mechanism):
        S = Stroke(0.0, 1.0)
        O, P = Ground(0.0, 0.0), Ground(1.0, 0.0)
        A = Crank(O, OA=0.6, angle=S * 0.0)
        B = OnLink(O, A, OB=0.2)
        C, D = Ground(0.5 + 0.9, 0.0), Ground(0.7, 0.2)
        E = Crank(C, CE=0.3 + S, angle=S * 0.0)

    motion = Row().at(S=[0.0, 0.5])
    assert_allclose(motion[gap("OAB", "CE")], 0.8, atol=1e-15)
    assert_allclose(motion[gap("P", "OAB")], 0.4, atol=1e-15)
    assert_allclose(motion[gap("E", "D")], motion[distance("E", "D")], rtol=1e-15)


def test_bodies_are_named_and_refused_in_words():
    motion = ThreePointHitch().at(S=[0.0, 0.1])
    assert_allclose(motion[gap("AB", "CD")], motion[gap("lift", "CD")], rtol=0)
    assert str(gap("OBC", "FKG", width=0.06)) == "gap(OBC, FKG, width=0.06)"
    for request, words in (
        (gap("OBC", "CD"), r"both have C, .* gap\(O, CD\)"),
        (gap("OBC", "frame"), r"both have O, .* gap\(A, OBC\)"),
        (gap("G", "FKG"), "both have G"),
        (gap("Z", "OBC"), "Body 'Z' is unknown.*frame, .*OBC.*lift"),
    ):
        for ask in (lambda: motion[request], lambda: motion.gradient(request, ["OB"])):  # noqa: B023
            with pytest.raises(DefinitionError, match=words):
                ask()
    fixed = [motion[gap(name, "FKG")] for name in ("A", "O", "E", "M")]
    assert_allclose(motion[gap("FKG", "frame")], np.min(fixed, axis=0), rtol=1e-12)
    with pytest.raises(DefinitionError, match="half widths"):
        gap("OBC", "FKG", width=-1.0)


@for_all("structure", [Sliders, SliderCrank, FrontLoader, ThreePointHitch, StephensonTwo])
def test_a_transmission_angle_is_asked_of_every_kind_of_joint(structure):
    machine = structure()
    strokes = {name: np.linspace(each.start, each.end, 13) for name, each in machine.strokes.items()}
    motion = machine.at(**strokes)
    for joint in motion._joints:
        angle = motion.transmission_angle(joint)
        assert_allclose(motion[transmission(joint)], np.minimum(angle, np.pi - angle), rtol=0)
        (found,) = machine.evaluate([transmission(joint)], **strokes)
        assert_allclose(found, np.minimum(angle, np.pi - angle), atol=1e-9)
    others = [name for name in machine.plan.points if name not in motion._joints]
    with pytest.raises(DefinitionError, match="is not the joint of a dyad"):
        machine.evaluate([transmission(others[0])], **strokes)


def test_the_gradient_of_a_transmission_angle_is_the_central_difference():
    S, step = np.linspace(0.01, 0.24, 9), 1e-6
    for joint in "BDK":
        exact = ThreePointHitch().at(S=S).gradient(transmission(joint), ["OB"])[0]
        up, down = (ThreePointHitch(OB=0.3 + way).at(S=S)[transmission(joint)] for way in (step, -step))
        assert_allclose(exact, (up - down) / (2.0 * step), atol=1e-7)


@pytest.mark.slow
@pytest.mark.skipif(not has_compiler(), reason="no C compiler")
def test_combinations_in_c_say_what_evaluate_says(tmp_path):
    hitch, S = ThreePointHitch(), np.linspace(0.0, 0.25, 30)
    asked = [abs(drive_force()) / 1e4 - transmission("K"), gap("OBC", "FKG") * 2.0]
    text = hitch.source(asked, name="poses")
    out, design = np.empty((2, 30)), np.array(arguments(text))
    rows = [(POINTER * len(each))(*map(address, each)) for each in ([S], out)]
    built(text, "combined", tmp_path)(30, address(design), *rows)
    assert_allclose(out, np.vstack(hitch.evaluate(asked, S=S)), rtol=1e-10)
