"""The catalogue of cylinders: standard pairs and strokes, closed lengths by the user's rule, rows that designs take."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import (
    CatalogueRow,
    Cylinder,
    LiftCircuit,
    catalogue,
    fits,
    pressure,
    standard_bores,
    standard_rods,
    standard_strokes,
)  # fmt: skip
from linkage import RIGHT, DefinitionError, Dimension, Dyad, Ground, Mechanism, OnLink, Stroke, Weight, at, most, optimise
from linkage.units import bar, deg, mm
from tests.for_all import for_all

NAMES = ("lift.bore", "lift.rod", "lift.stroke", "lift.closed")


class Arm(Mechanism):
    """A cylinder turns an arm; its pins are 500 to 750 mm apart."""

    S = Stroke(0.00, 0.25)
    A, O = Ground(0.20, 0.55), Ground(0.30, 1.15)
    B = Dyad(A, O, AB=0.50 + S, OB=0.30, side=RIGHT)
    lift = Cylinder(A, B, bore=110 * mm, rod=63 * mm, closed=0.48, stroke=0.27)


def test_it_has_the_standard_pairs_in_the_standard_strokes():
    rows = catalogue(dead=0.2)
    assert {(row.bore, row.rod) for row in rows} == {(bore, rod) for bore in standard_bores() for rod in standard_rods(bore)}
    assert len(rows) == len(set(rows)) == len({(row.bore, row.rod) for row in rows}) * 12
    assert rows == sorted(rows)
    assert sorted({row.stroke for row in rows}) == list(standard_strokes())
    assert_allclose(standard_strokes(longer=True)[-7:], [0.5, 0.63, 0.8, 1.0, 1.25, 1.6, 2.0])


def test_strokes_follow_the_preferred_numbers():
    """But for 40 mm, each is the last times 10^(1/10), or twice that, to the rounding of the series R10."""
    steps = np.log10(np.array(standard_strokes(longer=True))) * 10.0
    assert np.max(np.abs(steps - np.round(steps))) < 0.06


@pytest.mark.parametrize(("dead", "extra"), [(0.2, 0.2), ((0.12, 1.5), 0.12 + 1.5 * 0.08), ((0.0, 2.0), 0.16)])
def test_closed_is_the_stroke_and_a_dead_length(dead, extra):
    rows = catalogue([80 * mm], [45 * mm], [250 * mm, 0.2, 0.2], dead=dead)
    assert [row.stroke for row in rows] == [0.2, 0.25]
    assert_allclose([row.closed - row.stroke for row in rows], extra)


def test_a_design_takes_a_row_and_says_whether_it_fits():
    rows = catalogue([80 * mm, 90 * mm], [50 * mm], strokes=[0.2, 0.253, 0.32], dead=(0.15, 1.2))
    for row in rows:
        design = Arm(**dict(zip(NAMES, row, strict=True)))
        (verdict,) = design.lift.fits(design.sweep(5))
        assert bool(verdict) is (row.closed <= 0.5 and row.closed + row.stroke >= 0.75 and row.stroke <= row.closed)
        assert design.lift.standard(design.sweep(3))
    assert len([row for row in rows if row.closed <= 0.5 <= 0.75 <= row.closed + row.stroke]) == 1


def test_all_rows_are_one_batch():
    rows = np.array(catalogue([80 * mm, 90 * mm], [50 * mm], strokes=[0.2, 0.25], dead=0.2))
    batch = Arm(**dict(zip(NAMES, rows.T, strict=True))).sweep(3)
    closed, stroke = Arm.lift.closed_and_stroke(batch)
    assert_allclose(np.ravel(closed), rows[:, 3])
    assert_allclose(np.ravel(stroke), rows[:, 2])


class Loaded(Arm):
    """It lifts a load; in `Followed` the closed length follows the stroke."""

    G = OnLink("O", "B", OG=0.9, BOG=-40 * deg)
    load = Weight(G, mass=1200)
    pump = LiftCircuit("lift", pressure=180 * bar)


class Followed(Loaded):
    out = Dimension(0.27)
    lift = Cylinder("A", "B", bore=110 * mm, rod=63 * mm, stroke=out, closed=out + 0.2)


@pytest.mark.slow
def test_a_search_takes_the_row_that_is_best_among_those_that_fit():
    rows = catalogue([63 * mm, 80 * mm, 90 * mm], [45 * mm, 50 * mm], strokes=[0.2, 0.255, 0.32], dead=(0.145, 1.2))
    found = optimise(Loaded(), minimise=most(pressure("lift")), vary={NAMES: rows}, subject_to=[fits("lift")])

    def judged(row):
        design = Loaded(**dict(zip(NAMES, row, strict=True)))
        return np.max(design.lift.pressure(design.sweep(101))) if all(design.lift.fits(design.sweep(5))) else np.inf

    assert tuple(found.machine[name] for name in NAMES) == min(rows, key=judged)


@pytest.mark.slow
def test_a_search_varies_what_stroke_and_closed_length_follow():
    found = optimise(Followed(), maximise=at("out"), vary={"out": (0.1, 0.4)}, subject_to=[fits("lift")])
    assert found.machine["out"] == pytest.approx(0.3, abs=1e-6)  # closed 500 mm, the least distance of its pins


def test_a_row_says_what_it_is():
    assert str(CatalogueRow(0.08, 0.045, 0.25, 0.49)) == "cylinder 80/45 x 250 mm, 490 mm closed"


@for_all(
    ("ask", "words"),
    [
        (lambda: catalogue([80 * mm], [6 * mm], dead=0.2), "no row: no rod suits a bore"),
        (lambda: catalogue([0.05], [0.08], dead=0.2), "no row"),
        (lambda: catalogue([80], dead=0.2), r"Bore = 80 m .* write 80 \* mm"),
        (lambda: catalogue([0.08], strokes=[250], dead=0.2), r"Stroke = 250 m .* write 250 \* mm"),
        (lambda: catalogue([0.05], [0.028], strokes=[20], dead=0.2), r"Stroke = 20 m .* write 20 \* mm"),
        (lambda: catalogue(0.08, dead=0.2), r"Bore = 0\.08: a list is expected"),
        (lambda: catalogue([], dead=0.2), "Bore = .* holds no number"),
        (lambda: catalogue(["a"], dead=0.2), "is not a number"),
        (lambda: catalogue([0.0], dead=0.2), "not above zero"),
        (lambda: catalogue(dead=0.0), "Dead length = 0 is not above zero"),
        (lambda: catalogue(dead=-0.1), "Dead length = -0.1 is below zero"),
        (lambda: catalogue(dead=120), r"Dead length = 120 m .* write 120 \* mm"),
        (lambda: catalogue(dead=(0.1, -1.0)), "Factor of the bore = -1 is below zero"),
        (lambda: catalogue(dead=(0.1, 1.0, 2.0)), "give a length"),
        (lambda: catalogue(dead=(0.1, 200.0)), "Factor of the bore"),
        (lambda: catalogue(strokes=np.linspace(0.1, 0.9, 5000), dead=0.2), "more than 1000000 rows"),
    ],
)  # fmt: skip
def test_what_cannot_be_is_refused(ask, words):
    with pytest.raises(DefinitionError, match=words):
        ask()
