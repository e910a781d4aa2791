"""Links in one line given by distances alone, and links whose points settle one after the other."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import LEFT, Crank, DefinitionError, Dyad, Ground, Link, Mechanism, OnLink, Pin, Stroke, deg, drawn
from tests.for_all import for_all


class Lever(Mechanism):
    """A straight lever, its pin drawn exactly in line at the sketch."""

    phi = Stroke(0, 90 * deg)
    O = Ground(0, 0)
    A = Crank(O, OA=1, angle=phi)
    C = Pin(near=(2, 0))
    lever = Link("O A C", OA=1, OC=2, AC=1)


def test_straight_lever_has_no_sides():
    motion = Lever().sweep(5)
    assert_allclose(motion["C"], 2 * motion["A"], rtol=0, atol=1e-15)
    assert_allclose(motion.ratio("C"), 2 * motion.ratio("A"), rtol=0, atol=1e-14)


def test_bent_lever_still_needs_a_side():
    with pytest.raises(DefinitionError, match="does not choose an assembly mode"):

        class Bent(Lever):
            lever = Link("O A C", OA=1, OC=2, AC=1.2)


def test_dyad_on_its_dead_line_still_needs_a_side():
    with pytest.raises(DefinitionError, match="does not choose an assembly mode"):

        class Knee(Mechanism):
            S = Stroke(1.0, 1.5)
            O, Q = Ground(0, 0), Ground(2, 0)
            B = Pin(near=(1, 0))
            rod, ram = Link("O B", OB=1.2), Link("Q B", QB=S)


def plate(link):
    """Return a class III group whose plate carries a fourth pin, given from the plate's second and third."""

    class Plate(Mechanism):
        phi = Stroke(0, 0.6)
        sketch = drawn(phi=0.0)
        O, P, Q = Ground(0, 0), Ground(3, 0), Ground(1.5, 3)
        A = Crank(O, OA=0.5, angle=phi)
        D, E, F, T = Pin(near=(1.2, 0.5)), Pin(near=(2.2, 0.5)), Pin(near=(1.6, 1.3)), Pin(near=(2.4, 1.2))
        body = link
        r1, r2, r3 = Link("A D", AD=0.8), Link("P E", PE=1.0), Link("Q T", QT=2.0)

    return Plate


@pytest.mark.parametrize("order", ["T F E D", "D T F E"])
def test_plate_in_a_group_settles_point_after_point(order):
    """T hangs on E and F, and these with D: whatever the order in which the link names them."""
    found = plate(Link(order, DE=1, DF=0.9, EF=0.8, ET=0.7, FT=0.75))().sweep(9)
    named = plate(Link("D E F T", DE=1, DF=0.9, EF=0.8, ET=0.7, FT=0.75))().sweep(9)
    for P, Q, length in (("D", "E", 1.0), ("D", "F", 0.9), ("E", "F", 0.8), ("E", "T", 0.7), ("F", "T", 0.75), ("Q", "T", 2.0)):
        assert_allclose(found.distance(P, Q), length, rtol=1e-12)
    assert_allclose(found["T"], named["T"], rtol=0, atol=1e-12)


def test_plate_that_is_not_settled_names_the_point():
    with pytest.raises(DefinitionError, match=r"the shape of body = .* is not settled at T; give two distances"):
        plate(Link("D E F T", DE=1, DF=0.9, EF=0.8, ET=0.7))


def test_straight_rod_in_a_group():
    """A rod D M E with its middle pin on a third link: the sketch has all three in line."""

    class Rod(Mechanism):
        phi = Stroke(-0.1, 0.4)
        sketch = drawn(phi=0.0)
        O, P, Q = Ground(0, 0), Ground(3, 0), Ground(1.5, -1.2)
        A = Crank(O, OA=0.5, angle=phi)
        D, M, E = Pin(near=(0.9, 0.6)), Pin(near=(1.5, 0.6)), Pin(near=(2.1, 0.6))
        rod = Link("D M E", DM=0.6, ME=0.6, DE=1.2)
        r1, r2, r3 = Link("A D", AD=0.75), Link("P E", PE=1.1), Link("Q M", QM=1.8)

    motion = Rod().sweep(7)
    assert_allclose(motion["M"], (motion["D"] + motion["E"]) / 2, rtol=0, atol=1e-7)
    assert_allclose(motion.distance("D", "E"), 1.2, rtol=1e-12)


def test_dyad_hangs_on_a_straight_lever():
    class Hung(Lever):
        G = Ground(3, 1)
        H = Dyad("C", "G", CH=2.0, GH=2.5, side=None, near=(2.5, -1.0))

    motion = Hung().sweep(3)
    assert_allclose(np.hypot(*(motion["H"] - motion["C"])), 2.0, rtol=1e-14)


@for_all("seed", range(2), slow=range(2, 20))
def test_a_straight_link_stays_straight_whatever_its_lengths_round_to(seed):
    """Lengths that add up but for their last digit: a height of 1e-8 that only rounding makes is none, and nothing is warned of."""
    rng = np.random.default_rng(seed)
    part, whole = rng.uniform(0.1, 0.9), rng.uniform(1.0, 2.0)

    class Straight(Mechanism):
        phi = Stroke(0, 90 * deg)
        O = Ground(0.3, -0.2)
        A = Crank(O, OA=whole, angle=phi)
        C = OnLink(O, A, OC=part * whole, AC=whole - part * whole, side=LEFT)

    motion = Straight().sweep(7)
    straight = motion["O"] + part * (motion["A"] - motion["O"])
    assert_allclose(motion["C"], straight, rtol=0, atol=1e-15)
    assert_allclose(motion.ratio("C"), part * motion.ratio("A"), rtol=0, atol=1e-15)
    assert_allclose(Straight().evaluate(["C"], phi=motion.strokes["phi"], backend="floats")[0], straight, rtol=0, atol=1e-15)
