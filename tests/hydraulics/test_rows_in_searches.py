"""A cylinder of a catalogue in a search: its row sets sizes, the linkage's closed length and its stroke. By triangles, by hand."""

import pickle

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Cylinder, LiftCircuit, catalogue, reserve
from linkage import (
    RIGHT,
    DefinitionError,
    Dimension,
    Dyad,
    FunctionTask,
    Ground,
    Mechanism,
    OnLink,
    Stroke,
    Weight,
    angle,
    at,
    bar,
    deg,
    least,
    mm,
    most,
    optimise,
    synthesise,
)
from linkage.units import g0
from tests.for_all import first_daily

MASS = 3000.0
ROWS = catalogue(bores=[63 * mm, 80 * mm], rods=[40 * mm], strokes=[250 * mm, 320 * mm], dead=(200 * mm, 1.0))


class Named(Mechanism):
    """A lever OBG on a cylinder AB whose shortest length is a dimension."""

    S = Stroke(0.0, 0.28)
    L0 = Dimension(0.60)
    O = Ground(0.0, 0.0)
    A = Ground(0.7, -0.45)
    B = Dyad(A, O, AB=L0 + S, OB=0.5, side=RIGHT)
    G = OnLink(O, B, OG=0.9, BOG=10 * deg)
    lean = angle(O, B)
    load = Weight(G, mass=MASS)
    lift = Cylinder(A, B, bore=80 * mm, rod=45 * mm)
    line = LiftCircuit(lift, pressure=180 * bar)


class Plain(Named):
    """The same with a number in the place of the dimension, and a cylinder that says its lengths."""

    B = Dyad("A", "O", AB=0.60 + Named.S, OB=0.5, side=RIGHT)
    lift = Cylinder("A", "B", bore=80 * mm, rod=45 * mm, closed=0.60, stroke=0.28)
    line = LiftCircuit(lift, pressure=180 * bar)


class Following(Named):
    """The same whose cylinder follows the dimension."""

    lift = Cylinder("A", "B", bore=80 * mm, rod=45 * mm, closed="L0", stroke=0.28)
    line = LiftCircuit(lift, pressure=180 * bar)


def lean(machine, length):
    """Return the angle of OB [rad] at lengths of the cylinder, by the cosine rule."""
    a, b = np.hypot(machine["A.x"], machine["A.y"]), machine["OB"]
    return np.arctan2(machine["A.y"], machine["A.x"]) + np.arccos((a**2 + b**2 - np.asarray(length) ** 2) / (2.0 * a * b))


def least_reserve(machine, closed, stroke):
    """Return the least reserve over a cylinder's way, by virtual work."""
    long = np.linspace(closed, closed + stroke, 5001)[1:-1]

    def height(length):
        return machine["OG"] * np.sin(lean(machine, length) + machine["BOG"])

    force = MASS * g0 * (height(long + 1e-6) - height(long - 1e-6)) / 2e-6
    return float(np.min(180 * bar * np.pi / 4 * machine["lift.bore"] ** 2 / force))


@first_daily(1, "kind", [Named, Plain, Following])
def test_the_best_row_is_that_of_all_rows_looked_at_one_by_one(kind):
    """The lever is to turn as far as it can, with a reserve of 1.2: every row by its own triangle."""
    found = optimise(kind(), maximise=most("lean") - least("lean"), vary={"lift": ROWS}, subject_to=[least(reserve("lift")) >= 1.2])
    able = {}
    for row in ROWS:
        machine = kind(**{"lift.bore": row.bore})
        ends = lean(machine, [row.closed, row.closed + row.stroke])
        if np.isfinite(ends).all() and least_reserve(machine, row.closed, row.stroke) >= 1.2:
            able[row] = float(ends[1] - ends[0])
    assert 0 < len(able) < len(ROWS)
    row = max(able, key=lambda each: able[each])
    assert_allclose(found.value, able[row], rtol=1e-9)
    machine = found.machine
    assert (machine["lift.bore"], machine["lift.rod"]) == (row.bore, row.rod)
    motion = machine.sweep(5)
    assert_allclose(motion.distance("A", "B")[[0, -1]], [row.closed, row.closed + row.stroke], rtol=1e-12)
    assert_allclose(motion["lean"], lean(machine, np.linspace(row.closed, row.closed + row.stroke, 5)), rtol=1e-12)
    assert next(each for each in machine.verdicts() if each.rule == "length").ok
    if kind is Named:
        assert_allclose([machine["L0"], machine.strokes["S"].start, machine.strokes["S"].end], [row.closed, 0.0, row.stroke], atol=1e-12)
    again = pickle.loads(pickle.dumps(machine))
    assert again.strokes["S"].end == machine.strokes["S"].end and dict(again.dimensions) == dict(machine.dimensions)


@pytest.mark.slow
def test_pivots_are_searched_with_the_rows():
    vary = {"lift": ROWS, "A": (0.6, 0.8)} | {"A.x": (0.6, 0.8), "A.y": (-0.6, -0.4)}
    del vary["A"]
    found = optimise(Named(), maximise=most("lean") - least("lean"), vary=vary, subject_to=[least(reserve("lift")) >= 1.2], starts=2)
    machine = found.machine
    closed, stroke = machine["lift.closed"], machine["lift.stroke"]
    assert (machine["lift.bore"], machine["lift.rod"], stroke, closed) in [tuple(row) for row in ROWS]
    assert least_reserve(machine, closed, stroke) >= 1.2 * (1 - 1e-6)
    turned = np.ptp(lean(machine, [closed, closed + stroke]))
    assert_allclose(found.value, turned, rtol=1e-9)
    by_hand = 0.0
    for row in ROWS:
        for x in np.linspace(0.6, 0.8, 9):
            for y in np.linspace(-0.6, -0.4, 9):
                one = Named(A=(x, y), **{"lift.bore": row.bore})
                with np.errstate(invalid="ignore"):
                    ends = lean(one, [row.closed, row.closed + row.stroke])
                if np.isfinite(ends).all() and least_reserve(one, row.closed, row.stroke) >= 1.2:
                    by_hand = max(by_hand, float(ends[1] - ends[0]))
    assert found.value >= by_hand - 1e-9


@first_daily(1, "kind", [Named, Plain])
def test_a_synthesis_chooses_a_row_that_reaches_all_points(kind):
    """Angles over 300 mm of stroke: rows of 250 mm do not reach the last, and say so."""
    known = kind(OB=0.52)
    row = ROWS[1]
    assert row.stroke == 0.32
    S = np.linspace(0.0, 0.30, 4) + (0.0 if kind is Named else row.closed - 0.60)
    task = FunctionTask(S, lean(known, row.closed + np.linspace(0.0, 0.30, 4)), of="lean")
    vary = {"lift": ROWS, "OB": (0.4, 0.6), "A.x": (0.6, 0.8)}
    found = synthesise(kind(), function=task, vary=vary, starts=16)
    assert found.best.most < 1e-9
    machine = found.machine
    assert_allclose([machine["OB"], machine["A.x"]], [0.52, 0.7], atol=1e-8)
    assert machine["lift.stroke"] == 0.32
    assert_allclose(machine.sweep(3).distance("A", "B"), machine["lift.closed"] + np.array([0.0, 0.16, 0.32]), rtol=1e-12)
    for each in found.solutions:
        own, low = each.machine, each.machine["lift.closed"]
        with np.errstate(invalid="raise"):
            lean(own, np.linspace(low, low + own["lift.stroke"], 5001))
    assert any("and the cylinder goes from" in str(miss) for miss in found.misses)


def test_rows_that_say_only_sizes_leave_the_stroke():
    rows = [(0.08, 0.045), (0.1, 0.056)]
    with pytest.raises(DefinitionError, match="rows of a catalogue are expected"):
        optimise(Named(), minimise=at("L0"), vary={"lift": rows})


class Pulled(Named):
    """A cylinder whose length falls with the stroke."""

    B = Dyad("A", "O", AB=0.9 - Named.S, OB=0.5, side=RIGHT)


@pytest.mark.parametrize(
    ("machine", "rows", "words"),
    [
        (Named(), [], "rows of a catalogue are expected"),
        (Named(), 3.0, "rows of a catalogue are expected"),
        (Pulled(), ROWS, "a length and a stroke"),
    ],
)
def test_what_cannot_be_set_is_said(machine, rows, words):
    with pytest.raises(DefinitionError, match=words):
        optimise(machine, minimise=most("lean"), vary={"lift": rows})
