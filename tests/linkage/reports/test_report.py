"""Results as text: decimals, blocks, CSV that reads back to the last bit, values in fitting units, stroke ranges."""

import csv
import io

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from linkage import Column, Crank, DefinitionError, Dimension, Dyad, Ground, Mechanism, Stroke, deg, kgf, kgf_cm2
from linkage.motion import below_zero
from linkage.plan import plan_measure
from linkage.reports import closely, design_rows, reached_span, results, stroke_rows, text_table, write_csv
from mechanisms.three_point_hitch import ThreePointHitch
from tests.for_all import for_all


class Lift(Mechanism):
    """One cylinder, one lever."""

    S = Stroke(0.55, 0.80)
    L0 = Dimension(0.0)
    load = Dimension(900 * kgf, unit="kgf")
    share = Dimension(0.5)
    A = Ground(0.0, 0.242)
    O = Ground(0.652, 0.330)
    B = Dyad(A, O, AB=L0 + S, OB=0.175, near=(0.6, 0.1))


class Turning(Mechanism):
    """A crank with an offset of its angle."""

    phi = Stroke(0.0, 2 * np.pi)
    offset = Dimension(10 * deg)
    O = Ground(0.0, 0.0)
    A = Crank(O, OA=0.1, angle=phi + offset)


COLUMNS = [
    Column("S", np.array([0.55, 0.80]), "m", 3),
    Column("pd", np.array([161.0166, 55.72]) * kgf_cm2, "kgf/cm2", 1),
    Column("kz", np.array([np.nan, -0.0004]), "", 3),
]


def test_text_table_has_units_decimals_and_right_edges():
    assert list(text_table(COLUMNS)) == [
        " S, m  pd, kgf/cm2     kz",
        "0.550        161.0      -",
        "0.800         55.7  0.000",
    ]  # fmt: skip


def test_narrow_table_repeats_the_stroke():
    S, pd, kz = COLUMNS
    assert list(text_table(COLUMNS, width=25)) == [*text_table([S, pd]), "", *text_table([S, kz])]


@given(st.integers(5, 60))
def test_no_line_is_wider_than_the_terminal(width):
    columns = [Column(f"c{index}", np.arange(3.0) * 10**index, "m", 2) for index in range(6)]
    widest_pair = len("0.00") + 2 * 2 + len("200000.00")
    assert all(len(line) <= max(width, widest_pair) for line in text_table(columns, width))


def test_daggers_keep_within_the_width():
    lines = list(text_table(COLUMNS, 22, [True, False]))
    assert sum(line.endswith("†") for line in lines) == 2
    assert max(map(len, lines)) <= 22


@given(arrays(float, (4,), elements=st.floats(allow_infinity=False)))
def test_csv_reads_back_exactly(values):
    stream = io.StringIO(newline="")
    write_csv([Column("S", np.arange(4.0), "m"), Column("x", values)], stream)
    text = stream.getvalue()
    header, *rows = csv.reader(io.StringIO(text, newline=""))
    assert header == ["S, m", "x"]
    assert text.count("\r\n") == text.count("\n") == 5
    np.testing.assert_array_equal([float(row[1]) if row[1] else np.nan for row in rows], values)


def test_csv_is_in_the_heading_unit():
    stream = io.StringIO(newline="")
    write_csv([Column("angle", np.array([np.pi]), "deg")], stream)
    assert stream.getvalue() == '"angle, deg"\r\n180.0\r\n'


def test_csv_of_a_batch_has_one_row_a_pose():
    stream = io.StringIO(newline="")
    write_csv([Column("S", np.array([1.0, 2.0])), Column("x", np.array([[3.0, 4.0], [5.0, 6.0]]))], stream)
    assert stream.getvalue().split() == ["S,x", "1.0,3.0", "2.0,4.0", "1.0,5.0", "2.0,6.0"]


def test_csv_reports_its_progress():
    calls = []
    write_csv([Column("S", np.arange(25_000.0))], io.StringIO(), lambda done, total: calls.append((done, total)))
    assert calls == [(10_000, 25_000), (20_000, 25_000), (25_000, 25_000)]


def test_design_variables_in_fitting_units():
    rows = {name: (value, step) for name, value, step in design_rows(Lift())}
    assert rows["OB"] == ("175 mm", "B = Dyad(A, O)")
    assert rows["A.y"] == ("242 mm", "")
    assert rows["load"] == ("900 kgf", "")
    assert rows["L0"] == ("0 mm", "")
    assert rows["share"] == ("0.5", "")
    assert {name: value for name, value, _ in design_rows(Turning())}["offset"] == "10 deg"


def test_batch_shows_its_range():
    assert dict((name, value) for name, value, _ in design_rows(Lift(OB=[0.17, 0.18])))["OB"] == "170 mm to 180 mm"


def test_strokes_in_fitting_units():
    assert list(stroke_rows(Lift())) == [("S", "550 to 800 mm")]
    assert list(stroke_rows(Turning())) == [("phi", "0 to 360 deg")]


@for_all(
    ("machine", "name", "kind"),
    [
        (Lift, "OB", "length"),
        (Lift, "A.x", "length"),
        (Lift, "L0", "length"),
        (Lift, "load", "force"),
        (Lift, "share", ""),
        (Turning, "offset", "angle"),
    ],
)
def test_what_a_variable_measures(machine, name, kind):
    assert plan_measure(machine.plan, name) == kind


def test_unit_of_a_dimension_is_a_known_one():
    with pytest.raises(DefinitionError, match="Unit 'kgff' is unknown in Dimension"):
        Dimension(1.0, unit="kgff")
    assert str(Lift.load) == f'Dimension({900 * kgf!r}, unit="kgf")'


# -- stroke ranges -----------------------------------------------------------------------------------------


@given(st.floats(0.56, 0.67), st.floats(0.68, 0.79))
def test_ends_of_a_range_are_roots(low, high):
    motion = Lift().sweep(3)
    (span,) = below_zero(motion, lambda each: (each.strokes["S"] - low) * (each.strokes["S"] - high))
    assert (span.start["S"], span.end["S"]) == pytest.approx((low, high), abs=1e-11)
    above = below_zero(motion, lambda each: (each.strokes["S"] - low) * (high - each.strokes["S"]))
    assert [at["S"] for each in above for at in (each.start, each.end)] == pytest.approx([0.55, low, high, 0.80], abs=1e-11)


def test_range_ends_where_the_reach_does():
    lift = Lift()
    AO = np.hypot(0.652, 0.330 - 0.242)
    motion = lift.at(S=[0.6, 0.9], unreachable="nan")
    assert reached_span(motion) == pytest.approx((0.6, AO + 0.175), abs=1e-12)
    for S in ([0.4, 0.6, 0.8], [0.4, 0.8]):
        motion = lift.at(S=S, unreachable="nan")
        assert reached_span(motion) == pytest.approx((AO - 0.175, 0.8), abs=1e-12)
        (span,) = below_zero(motion, lambda each: -np.ones(each.shape))
        assert (span.start["S"], span.end["S"]) == reached_span(motion)
    assert not below_zero(motion, lambda each: np.ones(each.shape))


def test_closer_look_keeps_the_design():
    motion = closely(Lift(OB=0.18).sweep(2))
    assert motion.shape == (513,)
    np.testing.assert_allclose(motion.distance("O", "B"), 0.18, rtol=1e-12)


@for_all("case", [None, "plain", "far"])
def test_results_of_what_is_no_motion_or_no_machine_are_refused_in_every_case(case):
    with pytest.raises(DefinitionError, match="is no motion"):
        results(Lift(), "x", case)
    with pytest.raises(DefinitionError, match="is no mechanism"):
        results("x", Lift().sweep(2), case)


def test_a_small_column_has_three_figures_and_noise_has_none():
    columns = [Column("S", np.array([0.0, 5.4e-5, 1.2e-4]), "mm", 1), Column("F", np.full(3, 1e-14), "kN")]
    lines = [line.split() for line in text_table([*columns, Column("x", np.arange(3.0), "mm", 1)])]
    assert lines[1:] == [["0.000", "0.0000", "0.0"], ["0.054", "0.0000", "1000.0"], ["0.120", "0.0000", "2000.0"]]


def test_a_number_that_an_element_is_declared_without_is_not_given():
    noted = {name: note for name, _, note in design_rows(ThreePointHitch())}
    assert noted["circuit.back_pressure"] == noted["circuit.hydraulic_efficiency"] == "not given"
    assert noted["circuit.flow"] == noted["slope"] == ""
    assert {name: note for name, _, note in design_rows(ThreePointHitch(**{"circuit.back_pressure": 2e5}))}["circuit.back_pressure"] == ""
