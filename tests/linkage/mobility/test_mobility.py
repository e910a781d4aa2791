"""The mobility: by rank and by count, redundant links told apart from locking ones."""

import numpy as np
import pytest

from linkage import (
    LEFT,
    RIGHT,
    AssemblyError,
    Crank,
    DefinitionError,
    Dyad,
    Ground,
    Guide,
    Link,
    Mechanism,
    OnLink,
    Pin,
    Slide,
    SliderDyad,
    Stroke,
    deg,
    grashof,
)
from tests.for_all import for_all


class Parallelogram(Mechanism):
    phi = Stroke(0.3, 2.5)
    A = Ground(0, 0)
    D = Ground(4, 0)
    B = Crank(A, AB=1, angle=phi)
    C = Dyad(B, D, BC=4, CD=1, side=LEFT)


class ThirdCrank(Parallelogram):
    """An extra crank, parallel to the others: overconstrained, and it moves."""

    G = Ground(2, 0)
    H = OnLink("B", "C", BH=2)
    third = Link("G H", GH=1)


class SliderCrank(Mechanism):
    phi = Stroke(0, 2 * np.pi)
    O = Ground(0, 0)
    A = Crank(O, OA=0.1, angle=phi)
    rail = Guide((0, 0), angle=0)
    C = SliderDyad(A, rail, AC=0.3, near=(0.4, 0))


def test_a_four_bar_has_one_freedom_by_both_counts():
    assert (Parallelogram().mobility, Parallelogram().gruebler) == (1, 1)
    assert Parallelogram().freedom.redundant == ()


def test_a_redundant_link_is_named_and_the_motion_is_the_same():
    machine = ThirdCrank()
    assert (machine.mobility, machine.gruebler) == (1, 0)
    assert machine.freedom.redundant == ("third",)
    assert "the link third is redundant" in str(machine.freedom)
    motion = machine.sweep(7)
    np.testing.assert_allclose(motion["C"], Parallelogram().sweep(7)["C"], atol=1e-15)
    np.testing.assert_allclose(motion.distance("G", "H"), 1.0, rtol=1e-12)


def test_a_locking_link_is_refused_by_name():
    with pytest.raises(DefinitionError, match=r"mobility is 0, the strokes are 1 \(phi\).*link third locks"):

        class Locked(Parallelogram):
            G = Ground(2.3, 0)
            H = OnLink("B", "C", BH=2)
            third = Link("G H", GH=1)


def test_a_link_that_fits_only_at_the_sketch_is_refused_with_the_millimetres():
    with pytest.raises(DefinitionError, match=r"locks|changes by .* mm over the stroke"):

        class Fitting(Parallelogram):
            G = Ground(2.0, 0.5)
            H = OnLink("B", "C", BH=2)
            third = Link("G H", GH=float(np.hypot(np.cos(0.3), np.sin(0.3) - 0.5)))


def test_a_pin_left_free_is_named_with_the_count():
    with pytest.raises(DefinitionError, match=r"leave C free: 1 conditions for 2 coordinates"):

        class Free(Mechanism):
            phi = Stroke(0.3, 2.5)
            A = Ground(0, 0)
            B = Crank(A, AB=1, angle=phi)
            bc = Link("B C", BC=2)
            C = Pin(near=(3, 1))


def test_a_slide_counts_as_half_a_joint():
    assert (SliderCrank().mobility, SliderCrank().gruebler) == (1, 1)


def test_the_mobility_at_a_change_point_is_taken_in_the_middle_of_the_stroke():
    class Flat(Mechanism):
        """Its sketch, phi = 0, is the flat parallelogram, where a second motion begins."""

        phi = Stroke(0.0, 2.5)
        A = Ground(0, 0)
        D = Ground(4, 0)
        B = Crank(A, AB=1, angle=phi)
        C = Dyad(B, D, BC=4, CD=1, side=LEFT)
        bc = Link("B C")

    assert Flat().mobility == 1


def test_a_peaucellier_cell_with_an_extra_link_moves():
    class Cell(Mechanism):
        """B and C are mirror images in the line O A P."""

        phi = Stroke(-0.5, 0.5)
        O = Ground(0, 0)
        M = Ground(0.1, 0)
        A = Crank(M, MA=0.1, angle=phi)
        B = Dyad(O, A, OB=0.4, AB=0.25, side=LEFT)
        C = Dyad(O, A, OC=0.4, AC=0.25, side=RIGHT)
        P = Dyad(B, C, BP=0.25, CP=0.25, near=(0.5, 0.0))

    class Extra(Cell):
        """Q halves OC and T draws A at half its size, so the bar QT keeps its length."""

        Q = OnLink("O", "C", OQ=0.2)
        N = Ground(0.05, 0)
        T = Crank(N, NT=0.05, angle="phi")
        extra = Link("Q T", QT=0.125)

    foot = (0.4**2 - 0.25**2) / 0.2
    np.testing.assert_allclose(Cell().sweep(11).x("P"), foot, atol=1e-12)
    assert Extra().freedom.redundant == ("extra",)
    assert Extra().mobility == 1


@for_all(
    ("lengths", "kind"),
    [
        ((4.0, 1.0, 3.0, 2.5), "crank rocker"),
        ((1.0, 2.5, 3.0, 4.0), "double crank"),
        ((3.0, 2.5, 1.0, 4.0), "double rocker"),
        ((4.0, 2.5, 3.0, 1.0), "rocker crank"),
        ((4.0, 1.0, 3.0, 2.0), "change point"),
        ((4.0, 2.5, 3.0, 2.5), "triple rocker"),
        ((9.0, 1.0, 3.0, 2.0), "cannot be assembled"),
    ],
)
def test_grashof_names_the_kind(lengths, kind):
    assert grashof(*lengths).startswith(kind)


def test_the_four_bars_of_a_machine_are_found():
    (found,) = Parallelogram().four_bars
    assert found.pins == ("A", "B", "C", "D")
    assert found.kind.startswith("change point")


def test_grashof_refuses_a_length_that_is_none():
    with pytest.raises(DefinitionError, match=r"grashof: coupler=-1\.0: a positive number of metres"):
        grashof(1.0, 1.0, -1.0, 1.0)


def test_a_sketch_out_of_reach_is_said_in_words():
    class Short(Mechanism):
        phi = Stroke(60 * deg, 1.2)
        O, C = Ground(0, 0), Ground(4, 0)
        A = Crank(O, OA=1, angle=phi)
        B = Dyad(A, C, AB=1, CB=1, side=LEFT)

    with pytest.raises(AssemblyError, match=r"Short: B cannot be assembled at phi = 60 deg: AB \+ CB = 2 m is 1\.61 m short of AC"):
        _ = Short().mobility


def test_nothing_at_all_has_no_freedom():
    class Bare(Mechanism):
        pass

    assert Bare().mobility == 0


def test_a_slide_that_does_not_hold_is_refused():
    with pytest.raises(DefinitionError, match=r"stop = Slide\(C, post\): C is .* mm off the guide"):

        class Stuck(SliderCrank):
            post = Guide((0.2, 0.0), angle=1.2)
            stop = Slide("C", post)
            rod = Link("A C")
