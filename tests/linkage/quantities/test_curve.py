"""A table as a smooth function: the spline of SciPy in every reading, with its derivatives, and words for what lies outside."""

import json
import shutil
import subprocess

import numpy as np
import pytest
import sympy
from numpy.testing import assert_allclose
from scipy.interpolate import CubicSpline

from linkage import (
    AssemblyError,
    Between,
    Crank,
    Curve,
    DefinitionError,
    Ground,
    Guide,
    Mechanism,
    OnGuide,
    SingularError,
    Stroke,
    deg,
    driving_force,
    equations,
    pin_forces,
    ratio,
)
from linkage.program import RunOptions
from tests.for_all import for_all
from tests.linkage.program.sympy_program import program_expressions
from tests.linkage.program.test_backends import agree, as_loop, by_nodes, everything

XS = np.array([0.0, 0.07, 0.22, 0.3, 0.46, 0.6, 0.71, 0.8, 1.0])
YS = np.sin(5.0 * XS)
TURN = np.linspace(0.0, 2.0 * np.pi, 25)
WAVE = np.where(np.arange(25) == 24, 1.0, np.cos(TURN) ** 2 + 0.2 * np.sin(TURN))


class Lifted(Mechanism):
    """A point that a table and a turning drive move along a rail."""

    phi = Stroke(0.0, 2.0 * np.pi)
    O = Ground(0.0, 0.0)
    A = Crank(O, OA=0.1, angle=phi)
    rail = Guide((0.1, 0.0), angle=90 * deg)
    height = Curve(TURN, WAVE, period=2.0 * np.pi, name="wave")(phi)
    B = OnGuide(rail, at=0.3 + 0.1 * height)


class Short(Mechanism):
    """A stroke that is longer than its table."""

    S = Stroke(0.0, 1.2)
    rail = Guide((0.0, 0.0), angle=0.0)
    way = Curve(XS, YS, name="way")(S)
    A = OnGuide(rail, at=2.0 + way)
    B = OnGuide(rail, at=S)


@for_all("rows", [2, 3, 4, 9])
@for_all("order", [0, 1, 2])
def test_it_is_the_spline_of_scipy(rows, order):
    x = np.linspace(XS[0], XS[rows - 1], 301)
    assert_allclose(Curve(XS[:rows], YS[:rows])(x, order), CubicSpline(XS[:rows], YS[:rows])(x, order), atol=1e-11)


@for_all("order", [0, 1, 2, 3, 4])
def test_it_goes_on_for_ever_where_it_is_periodic(order):
    x = np.linspace(-20.0, 20.0, 777)
    assert_allclose(Curve(TURN, WAVE, period=2.0 * np.pi)(x, order), CubicSpline(TURN, WAVE, bc_type="periodic")(x, order), atol=1e-10)


def test_quantities_and_points_follow_it_with_exact_ratios():
    motion, spline = Lifted().sweep(73), CubicSpline(TURN, WAVE, bc_type="periodic")
    phi = motion.strokes["phi"]
    for order in (1, 2):
        assert_allclose(motion.ratio("height", order=order), spline(phi, order), atol=1e-13)
        assert_allclose(motion.ratio("B", order=order)[1], 0.1 * spline(phi, order), atol=1e-13)
    assert_allclose(motion.ratio("B", method="central"), motion.ratio("B"), atol=1e-12)


def test_every_way_to_run_a_program_agrees():
    kernel, inputs = everything(Lifted), Lifted().at(phi=np.linspace(-7.0, 14.0, 200))._grid.flat
    wanted = by_nodes(kernel, inputs)
    for way in ("numpy", "floats"):
        agree(kernel(inputs, way=RunOptions(way)).values[:, 0], wanted)
    agree(as_loop(kernel, inputs).values[:, 0], wanted)


@pytest.mark.skipif(shutil.which("node") is None, reason="no JavaScript")
def test_javascript_says_the_same():
    asked = ["B", ratio("B"), ratio("B", order=2)]
    text = Lifted().source(asked, language="javascript", name="lift")
    call = f"{text}console.log(JSON.stringify([0.3, 2.9, 6.0].map((phi) => lift([0.1, 0.0, {np.pi / 2}, 0.1], [phi]))))"
    said = json.loads(subprocess.run(["node", "-e", call], check=True, capture_output=True).stdout)
    assert_allclose(said, [Lifted().function(asked)(phi) for phi in (0.3, 2.9, 6.0)], rtol=1e-11, atol=1e-15)


@pytest.mark.slow
def test_sympy_reads_the_program_and_the_equations():
    motion = Lifted().at(phi=0.7)
    (closed,) = program_expressions(Lifted.plan, "height")
    assert_allclose(float(closed.subs(sympy.Symbol("phi", real=True), 0.7)), motion["height"], rtol=1e-14)
    written = equations(Lifted, ratio="height")
    assert "phi" in Lifted.plan.turning
    assert str(written["height"]) == "height(phi) = wave(phi)"
    assert str(written["dheight/dphi"]) == "dheight/dphi = wave'(phi)"
    assert_allclose(written.values(dict(phi=0.7))["dheight/dphi"], motion.ratio("height"), rtol=1e-13)


def test_a_place_outside_the_table_is_out_of_reach():
    said = r"A = OnGuide.*from S = 1100.0 to 1200.0 mm:\nway is asked for 1.2, and its table goes from 0 to 1\."
    with pytest.raises(AssemblyError, match=said):
        Short().sweep(13)
    motion = Short().sweep(13, unreachable="nan")
    (reach,) = motion.limits()["S"].intervals
    assert motion.reached.sum() == 11
    assert_allclose([reach.low, reach.high], [0.0, 1.0], atol=1e-11)


def test_an_output_outside_the_table_is_refused_and_the_places_hold():
    class Told(Mechanism):
        S = Stroke(0.0, 1.2)
        rail = Guide((0.0, 0.0), angle=0.0)
        A = OnGuide(rail, at=S)
        way = Curve(XS, YS)(S)

    motion = Told().sweep(13)
    with pytest.raises(SingularError, match="way has no finite value at 2 of 13 strokes"):
        motion["way"]


def test_the_law_of_a_force_may_be_a_table():
    strut = Curve([0.2, 0.25, 0.3, 0.35, 0.4], [900.0, 700.0, 600.0, 540.0, 500.0], name="strut")

    class Flap(Mechanism):
        phi = Stroke(20 * deg, 70 * deg)
        O = Ground(0.0, 0.0)
        C = Ground(0.1, -0.1)
        A = Crank(O, OA=0.22, angle=phi)
        push = Between(C, A, law=lambda length, rate: strut(length))

    motion = Flap().sweep(21)
    assert_allclose(pin_forces(motion).drives["phi"], driving_force(motion), rtol=1e-12)
    long = Flap(OA=0.35).sweep(5)
    with pytest.raises(DefinitionError, match=r"strut, a table from 0\.2 to 0\.4, is asked for a value outside"):
        driving_force(long)


def test_it_is_printed_as_it_is_written():
    text = str(Lifted.plan.members["height"])
    again = eval(text, {"Curve": Curve, "phi": Stroke(0.0, 1.0)})
    assert (again.curve.ys == Curve(TURN, WAVE).ys).all() and again.curve.name == "wave"


@pytest.mark.parametrize(
    ("given", "said"),
    [
        (([0.0, 1.0], [0.0]), "2 values of x and 1 of y"),
        (([0.0], [0.0]), "two rows or more"),
        (([0.0, 0.2, 0.2], [0.0, 1.0, 2.0]), "x must grow from row to row; 0.2 follows 0.2"),
        (([0.0, "b"], [0.0, 1.0]), "xs=.*a list of numbers|xs=.*finite numbers"),
        (([0.0, np.nan], [0.0, 1.0]), "finite numbers"),
    ],
)
def test_what_is_no_table_is_refused(given, said):
    with pytest.raises(DefinitionError, match=said):
        Curve(*given)


def test_a_table_that_does_not_close_is_not_periodic():
    with pytest.raises(DefinitionError, match=r"one period after the first.*from \(0, 0\) to \(1, -0.958924\)"):
        Curve(XS, YS, period=1.0)
    with pytest.raises(DefinitionError, match="a positive number is expected"):
        Curve(XS, YS, period=-1.0)


def test_it_does_not_change():
    with pytest.raises(DefinitionError, match="does not change"):
        Curve(XS, YS).period = 1.0
