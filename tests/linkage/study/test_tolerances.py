"""Tolerances: against laws of SciPy, linear machines, a four-bar in closed form, corners one by one, and samples of one's own."""

from importlib import import_module
from itertools import product

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from hydraulics import Cylinder, LiftCircuit, fits, pressure, reserve
from linkage import (
    LEFT,
    RIGHT,
    Crank,
    DefinitionError,
    Dimension,
    Dyad,
    Ground,
    LoadCase,
    Mechanism,
    OnLink,
    Over,
    PinFriction,
    Stroke,
    Weight,
    angle,
    at,
    deg,
    distance,
    drive_force,
    integral,
    kN,
    least,
    mm,
    most,
    pin_force,
    ratio,
    worst,
    y,
)  # fmt: skip
from linkage.pictures import plot_bands, plot_tornado
from linkage.quantities import ref
from linkage.study import Tolerance, monte_carlo, sigma, sobol, tornado
from linkage.study.tolerances import tolerance_words, tolerances_of
from mechanisms.mower_lift import MowerLift
from mechanisms.three_point_hitch import ThreePointHitch
from tests.for_all import first_daily, for_all
from tests.linkage.study.test_study import Triad

HITCH = {"OB": 0.1 * mm, "CD": 0.1 * mm, "MK": Tolerance(0.1 * mm, "uniform"), "M": 0.1 * mm}
S = np.linspace(0.0, 0.25, 6)


class Sums(Mechanism):
    """A crank beside outputs that are linear, a product and a square of its dimensions."""

    S = Stroke(0.0, 1.0)
    a, b, c = Dimension(1.0), Dimension(2.0), Dimension(0.5)
    O = Ground(0.0, 0.0)
    A = Crank(O, OA=0.5, angle=S)
    linear = 2.0 * ref("a") - 3.0 * ref("b") + ref("S")
    product = ref("a") * ref("b")
    square = (ref("a") - 1.0) * (ref("a") - 1.0)


class FourBar(Mechanism):
    """A four-bar with a coupler point."""

    phi = Stroke(0.4, 1.4)
    O, Q = Ground(0.0, 0.0), Ground(0.30, 0.0)
    A = Crank(O, OA=0.10, angle=phi)
    B = Dyad(A, Q, AB=0.25, QB=0.20, side=LEFT)
    C = OnLink(A, B, AC=0.30, BAC=20 * deg, side=RIGHT)
    psi = angle(Q, B)


def rocker(OA, AB, QB, OQ, phi):
    """Return the rocker's angle by Freudenstein's equation, solved for the half angle's tangent."""
    p, q = OQ - OA * np.cos(phi), -OA * np.sin(phi)  # from A to Q
    half = (AB**2 - p**2 - q**2 - QB**2) / (2.0 * QB)  # p cos(psi) + q sin(psi) = half, from |AQ + QB| = AB
    return np.arctan2(q, p) + np.arccos(half / np.hypot(p, q))


# -- laws -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("law", "known"),
    [
        ("normal", lambda stats: stats.norm(0.1, 0.1)),
        ("uniform", lambda stats: stats.uniform(-0.2, 0.6)),
        ("truncated", lambda stats: stats.truncnorm(-3, 3, 0.1, 0.1)),
    ],
)
def test_laws_are_those_of_scipy(law, known):
    known = known(pytest.importorskip("scipy.stats"))
    tolerance, unit = Tolerance((-0.2, 0.4), law), np.linspace(0.001, 0.999, 201)
    assert_allclose(tolerance.deviations(unit), known.ppf(unit), rtol=1e-9, atol=1e-12)
    assert_allclose(tolerance.sigma, known.std(), rtol=1e-12)
    assert Tolerance(0.1).low == -0.1 and Tolerance(0.1).high == 0.1
    assert np.isfinite(tolerance.deviations(np.array([0.0, 1.0]))).all()


def test_tolerances_are_told_as_a_drawing_does():
    named = tolerances_of(ThreePointHitch.plan, {"M": 0.5 * mm, "MK": (-0.1 * mm, 0.3 * mm), "KFG": 0.1 * deg})
    said = [tolerance_words(ThreePointHitch.plan, name, each) for name, each in named.items()]
    assert said == ["M.x ±0.5 mm", "M.y ±0.5 mm", "MK +0.3/-0.1 mm", "KFG ±0.1 deg"]


# -- the gradient's sigma -------------------------------------------------------------------------------------


def spread(machine, designs, quantity, tolerances, strokes):
    """Return the standard deviation of a quantity at designs and strokes, NaN where it has no value."""
    return machine.replaced(**designs).evaluate([sigma(quantity, tolerances)], unreachable="nan", **strokes)[0]


def test_sigma_of_a_linear_output_is_exact():
    found = spread(Sums(), {"c": np.array([1.0, 2.0])}, "linear", {"a": 0.03, "b": Tolerance(0.06, "uniform")}, {"S": [0.0, 0.5, 1.0]})
    assert found.shape == (2, 3)
    assert_allclose(found, np.hypot(2 * 0.01, 3 * 0.06 / np.sqrt(3)), rtol=1e-14)


def test_sigma_of_a_four_bar_is_that_of_its_closed_form():
    phi, lengths = np.array([0.5, 0.9, 1.3]), {"OA": 0.10, "AB": 0.25, "QB": 0.20}
    machine = FourBar()
    values = rocker(*lengths.values(), 0.30, phi)
    assert_allclose(np.cos(machine.at(phi=phi)["psi"]), np.cos(values), rtol=1e-12)
    step, parts = 1e-5, []
    for name in lengths:
        up, down = ({**lengths, name: lengths[name] + sign * step} for sign in (1, -1))
        parts.append((rocker(*up.values(), 0.30, phi) - rocker(*down.values(), 0.30, phi)) / (2 * step))
    known = np.sqrt(np.sum((np.array(parts) * 0.1 * mm / 3) ** 2, axis=0))
    assert_allclose(spread(machine, {}, "psi", dict.fromkeys(lengths, 0.1 * mm), {"phi": phi}), known, rtol=1e-6)


@first_daily(2, "quantity", ["tilt", drive_force(), pin_force("O", component="x"), ratio("tilt")])
def test_sigma_is_made_of_the_gradient_of_the_motion(quantity):
    designs = {"OB": np.array([0.29, 0.30, 0.31])}
    names, sigmas = ["OB", "CD", "MK", "M.x", "M.y"], np.array([0.1, 0.1, 0.1 * np.sqrt(3), 0.1, 0.1]) * mm / 3
    slopes = ThreePointHitch(**designs).at(S=S).gradient(quantity, wrt=names)
    assert_allclose(
        spread(ThreePointHitch(), designs, quantity, HITCH, {"S": S}), np.sqrt(np.einsum("kms,k->ms", slopes**2, sigmas**2)), rtol=1e-11
    )


def test_sigma_has_a_gradient_of_its_own():
    machine, request, step = MowerLift(), sigma(drive_force(), {"OB": 0.1 * mm, "BOG": 0.1 * deg}), 1e-5
    S = [0.56, 0.60]
    ends = spread(
        machine, {"OB": 0.175 + step * np.array([[1.0], [-1.0]])[:, 0]}, drive_force(), {"OB": 0.1 * mm, "BOG": 0.1 * deg}, {"S": S}
    )
    assert_allclose(machine.at(S=S).gradient(request, wrt=["OB"])[0], (ends[0] - ends[1]) / (2 * step), rtol=1e-6)
    assert machine.function([request])(0.6) == pytest.approx(tuple(machine.evaluate([request], S=[0.6])[0]))


def test_sigma_through_a_group_and_out_of_reach():
    tolerances = {"AB": 0.1 * mm, "DF": 0.1 * mm}
    found = spread(Triad(), {}, y("G"), tolerances, {"phi": [0.0, 0.3]})
    slopes = Triad().at(phi=[0.0, 0.3]).gradient(y("G"), wrt=["AB", "DF"])
    assert_allclose(found, np.hypot(*slopes) * 0.1 * mm / 3, rtol=1e-9)
    lost = spread(ThreePointHitch(), {"MK": np.array([0.88, 0.1])}, "tilt", HITCH, {"S": S})
    assert np.isfinite(lost[0]).all() and np.isnan(lost[1]).all()


# -- Monte Carlo ----------------------------------------------------------------------------------------------


def test_a_linear_output_has_the_moments_percentiles_and_yield_of_a_normal_law():
    """2 a - 3 b at S = 0.5: mean -3.5, sigma hypot(2 * 0.01, 3 * 0.02)."""
    known = pytest.importorskip("scipy.stats").norm(-3.5, np.hypot(0.02, 0.06))
    limit = known.ppf(0.9)
    found = monte_carlo(
        Sums(), ["linear"], {"a": 0.03, "b": 0.06}, subject_to=[most("linear") <= limit], count=1 << 14, percentiles=(1, 50, 99), S=0.5
    )
    band = found["linear"]
    assert_allclose([band.mean, band.sigma], [known.mean(), known.std()], rtol=3e-4)
    assert_allclose([*band.percentiles.values()], known.ppf([0.01, 0.5, 0.99]), rtol=0, atol=0.02 * known.std())
    assert_allclose([band.low, band.high], [-3.5 - 0.24, -3.5 + 0.24], rtol=1e-12)
    assert found.yield_rate == pytest.approx(0.9, abs=2e-3) and found.assembled == 1.0 == band.share
    assert [*found.kept.values()] == [found.yield_rate] and "90.0 % are good." in str(found)
    assert "at rest" not in str(found)


def test_bands_are_those_of_the_same_designs_one_motion():
    found = monte_carlo(ThreePointHitch(), ["tilt", drive_force(), y("G")], HITCH, count=500, percentiles=(5, 25, 95), method="random", S=S)
    motion = ThreePointHitch(**found.designs).at(S=S)
    forces = ThreePointHitch(**found.designs).evaluate([drive_force()], S=S)[0]
    for name, values in (("tilt", motion["tilt"]), (drive_force(), forces), (y("G"), motion.y("G"))):
        band = found[name]
        assert_allclose(band.mean, values.mean(axis=0), rtol=1e-12)
        assert_allclose(band.sigma, values.std(axis=0, ddof=1), rtol=1e-9)
        for percentage, cut in band.percentiles.items():
            assert_allclose(cut, np.percentile(values, percentage, axis=0), rtol=1e-12)
    assert_allclose(found["tilt"].nominal, ThreePointHitch().at(S=S)["tilt"], rtol=1e-14)
    assert found.design(7)["OB"] == found.designs["OB"][7]
    for wrong in (found.count, -1, 1.5, True):
        with pytest.raises(DefinitionError, match=r"there is no design .*; numbers go from 0 to"):
            found.design(wrong)


@first_daily(2, "quantity", ["tilt", drive_force(), pin_force("O")])
def test_the_sigma_of_samples_is_that_of_the_gradient(quantity):
    found = monte_carlo(ThreePointHitch(), [quantity], HITCH, count=1 << 13, S=S)
    assert_allclose(found[quantity].sigma, spread(ThreePointHitch(), {}, quantity, HITCH, {"S": S}), rtol=3e-3)


@pytest.mark.slow
@pytest.mark.parametrize("machine", [ThreePointHitch(), MowerLift()])
def test_a_million_samples_have_the_sigma_of_the_gradient(machine):
    """Pseudo-random numbers: 1e6 of them know a sigma to 0.07 %."""
    names = [name for name, each in machine.plan.table.entries.items() if each.kind in ("length", "coordinate")]
    tolerances = dict.fromkeys(names, 0.1 * mm)
    quantities = [drive_force(), pin_force("O"), y("G"), ratio(y("G"))]
    found = monte_carlo(machine, quantities, tolerances, count=1_000_000, method="random", threads=2)
    for quantity in quantities:
        known = spread(machine, {}, quantity, tolerances, dict(found.strokes))
        assert_allclose(found[quantity].sigma, known, rtol=0.02)


def test_results_do_not_depend_on_threads_blocks_and_memory(monkeypatch):
    conditions = [most("tilt") <= 25 * deg, least(drive_force()) >= 59.5 * kN, integral(drive_force()) <= 16140.0]
    one = monte_carlo(ThreePointHitch(), ["tilt", drive_force()], HITCH, subject_to=conditions, count=3000, S=S)
    room = import_module("linkage.study.monte_carlo")
    assert 0.0 < one.yield_rate < 1.0
    monkeypatch.setattr(room, "MEMORY", 8 * 3000 * 2 * 4)
    monkeypatch.setattr(room, "BLOCK", 1000)
    two = monte_carlo(ThreePointHitch(), ["tilt", drive_force()], HITCH, subject_to=conditions, count=3000, threads=2, S=S)
    assert_array_equal(one.good, two.good)
    for name in one.bands:
        assert_allclose(two.bands[name].mean, one.bands[name].mean, rtol=1e-14)
        assert_allclose(two.bands[name].percentiles[5.0], one.bands[name].percentiles[5.0], rtol=1e-13)
    other = monte_carlo(ThreePointHitch(), ["tilt"], HITCH, count=3000, seed=1, S=S)
    assert not np.array_equal(other["tilt"].mean, one["tilt"].mean)


def test_designs_that_cannot_be_assembled_are_lost():
    found = monte_carlo(ThreePointHitch(), ["tilt"], {"MK": 0.5, "OB": 30 * mm}, subject_to=[most("tilt") <= 1e3], count=1024, S=S)
    motion = ThreePointHitch(**found.designs).at(S=S, unreachable="nan")
    reached = motion.reached.all(axis=1)
    assert 0.5 < reached.mean() < 0.99
    assert_array_equal(found.good, reached)
    assert found.assembled == found.yield_rate == reached.mean()
    assert_allclose(found["tilt"].share, motion.reached.mean(axis=0))
    assert_allclose(found["tilt"].mean, np.nanmean(motion["tilt"], axis=0), rtol=1e-10)
    assert "cannot be assembled everywhere and count as lost" in str(found)


def swing(motion):
    return np.ptp(motion["tilt"], axis=-1)


def test_functions_of_a_motion_give_a_number_for_each_pose_or_design():
    found = monte_carlo(
        ThreePointHitch(), {"whole": swing, "pose": lambda motion: motion["tilt"], "tilt": "tilt"}, HITCH, count=400,
        subject_to=[most(swing) <= 13.73 * deg], S=S,
    )  # fmt: skip
    motion = ThreePointHitch(**found.designs).at(S=S)
    assert found["whole"].mean.shape == () and found["pose"].mean.shape == S.shape
    assert_allclose(found["whole"].mean, swing(motion).mean(), rtol=1e-12)
    assert_allclose(found["pose"].sigma, found["tilt"].sigma, rtol=1e-10)
    assert_allclose(found["pose"].high, found["tilt"].high, rtol=1e-12)
    assert found.yield_rate == np.mean(swing(motion) <= 13.73 * deg)


class Pointing(Mechanism):
    """A crank that points to the left, where an angle jumps from 180 to -180 deg."""

    S = Stroke(0.0, 0.2)
    lead = Dimension(np.pi)
    O = Ground(0.0, 0.0)
    A = Crank(O, OA=0.5, angle=ref("lead") + ref("S"))
    way = angle("O", "A")


def test_angles_do_not_jump_from_design_to_design():
    found = monte_carlo(Pointing(), ["way"], {"lead": 0.03}, count=256, S=0.0)
    assert_allclose(found["way"].sigma, 0.01, rtol=0.02)
    assert_allclose(found["way"].high - found["way"].low, 0.06, rtol=1e-9)


def test_dimensions_by_their_names_are_measured_as_by_the_judge():
    class Lever(Mechanism):
        S = Stroke(0.0, 0.25)
        A, O = Ground(0.2, 0.55), Ground(0.3, 1.15)
        B = Dyad(A, O, AB=0.5 + S, OB=0.3, side=RIGHT)
        ram = Cylinder(A, B, bore=80 * mm, rod=45 * mm, stroke=0.26, closed=0.49)

    found = monte_carlo(Lever(), [at("ram.bore")], {"ram.closed": 20 * mm}, subject_to=[fits("ram")], count=256, S=S)
    closed = np.ravel(found.designs["ram.closed"])
    assert found.good.tolist() == ((closed <= 0.5) & (closed >= 0.49)).tolist() and 20 < found.good.sum() < 236
    bars = tornado(Lever(), 2.0 * at("ram.bore") + most(distance("A", "B")), {"ram.bore": 3 * mm}, S=S)
    assert_allclose([(bar.low, bar.high) for bar in bars], [(-6 * mm, 6 * mm)], rtol=1e-9)


def test_measures_are_taken_over_the_strokes_looked_at():
    tilt, force = ref("tilt"), drive_force()
    quantities = {
        "range": most(tilt) - least(tilt),
        "work": integral(force),
        "there": at(tilt, S=0.13),
        "of one": most(lambda m: m["tilt"]),
    }
    conditions = [quantities["range"] <= 13.73 * deg, at(tilt, S=0.13) >= 9.8 * deg, most(force) / least(force) <= 1.2]
    found = monte_carlo(ThreePointHitch(), quantities, HITCH, subject_to=conditions, count=300, S=S)
    motion = ThreePointHitch(**found.designs).at(S=S)
    forces = ThreePointHitch(**found.designs).evaluate([force], S=S)[0]
    way = np.linspace(S[0], S[-1], 2001)  # an integral looks between the strokes, too
    fine = ThreePointHitch(**found.designs).evaluate([force], S=way)[0]
    there = ThreePointHitch(**found.designs).at(S=0.13)["tilt"]
    known = {"range": swing(motion), "work": np.trapezoid(fine, way, axis=-1), "there": there, "of one": motion["tilt"].max(axis=-1)}
    for name, values in known.items():
        digits = 1e-5 if name == "work" else 1e-9
        assert_allclose([found[name].mean, found[name].sigma], [values.mean(), values.std(ddof=1)], rtol=digits)
    kept = [known["range"] <= 13.73 * deg, there >= 9.8 * deg, forces.max(axis=-1) / forces.min(axis=-1) <= 1.2]
    assert_array_equal(found.good, np.all(kept, axis=0))
    assert_allclose([*found.kept.values()], np.mean(kept, axis=1))
    assert "at rest, under the machine's own loads" in str(found) and f"keep at({tilt}, S=0.13) >= 9.8 deg" in str(found)
    bars = tornado(ThreePointHitch(), quantities["range"], {"M.y": 0.5 * mm, "OB": 0.1 * mm}, S=S)
    assert bars.bars[0].name == "M.y"
    assert_allclose(bars.nominal, swing(ThreePointHitch().at(S=S)), rtol=1e-12)


# -- the worst case -------------------------------------------------------------------------------------------


@first_daily(1, "quantity", ["tilt", drive_force()])
def test_no_corner_and_no_sample_is_worse_than_the_worst_case(quantity):
    limits = {"OB": 5 * mm, "CD": 5 * mm, "MK": 8 * mm, "KFG": 1 * deg}
    band = monte_carlo(ThreePointHitch(), [quantity], limits, count=64, S=S)[quantity]
    levels = [*product((-1.0, 0.0, 1.0), repeat=4), *np.random.default_rng(5).uniform(-1.0, 1.0, (4000, 4))]
    designs = {name: ThreePointHitch()[name] + each * np.array(levels)[:, place] for place, (name, each) in enumerate(limits.items())}
    values = ThreePointHitch(**designs).evaluate([quantity], S=S)[0]
    assert_allclose(band.low, values[:81].min(axis=0), rtol=1e-12)
    assert_allclose(band.high, values[:81].max(axis=0), rtol=1e-12)
    assert (values.min(axis=0) >= band.low - 1e-12).all() and (values.max(axis=0) <= band.high + 1e-12).all()


def test_the_worst_case_may_stand_in_the_middle():
    band = monte_carlo(Sums(), ["square"], {"a": 0.03, "b": 0.1}, count=64, S=0.5)["square"]
    assert_allclose([band.low, band.high], [0.0, 9e-4], rtol=1e-9, atol=1e-18)


# -- one at a time, and shares of the variance ----------------------------------------------------------------


def test_a_tornado_of_a_linear_output():
    found = tornado(Sums(), "linear", {"a": 0.03, "b": (-0.01, 0.05), "c": 1.0}, S=0.0)
    assert [bar.name for bar in found] == ["b", "a", "c"]
    assert_allclose([(bar.low, bar.high) for bar in found], [(0.03, -0.15), (-0.06, 0.06), (0.0, 0.0)], rtol=0, atol=1e-14)
    assert_allclose([(bar.linear_low, bar.linear_high) for bar in found], [(bar.low, bar.high) for bar in found], rtol=0, atol=1e-14)
    assert_allclose(found.sigma, np.hypot(2 * 0.01, 3 * 0.01), rtol=1e-12)
    assert_allclose([bar.share for bar in found], [9 / 13, 4 / 13, 0.0], rtol=1e-12)
    assert found["a"].gradient == 2.0 and str(found).startswith("linear = -4 at S = 0 deg; sigma 0.0361 of all together.")


def test_a_tornado_of_the_hitch_is_its_gradient_and_its_changes():
    found = tornado(ThreePointHitch(), "tilt", {"CD": 5 * mm, "MK": 5 * mm}, unit="deg", S=0.1)
    at = ThreePointHitch().at(S=0.1)
    for bar in found:
        assert bar.gradient == at.gradient("tilt", wrt=[bar.name])[0]
        changed = [ThreePointHitch(**{bar.name: at.designs[bar.name] + step}).at(S=0.1)["tilt"] - at["tilt"] for step in (-5 * mm, 5 * mm)]
        assert_allclose([bar.low, bar.high], changed, rtol=1e-10)
    by_function = tornado(ThreePointHitch(), lambda motion: motion["tilt"], {"CD": 5 * mm, "MK": 5 * mm}, S=0.1)
    assert_allclose([bar.gradient for bar in by_function], [bar.gradient for bar in found], rtol=1e-6)


def test_sobol_indices_of_a_sum_and_of_a_product():
    tolerances = {"a": Tolerance(0.3, "uniform"), "b": Tolerance(0.9, "uniform"), "c": 0.1}
    found = sobol(Sums(), "linear", tolerances, count=4096, S=[0.0, 0.7])
    parts = np.array([4 * 0.09 / 3, 9 * 0.81 / 3, 0.0])
    for indices in (found.first, found.total):
        assert_allclose([*indices.values()], np.tile(parts / parts.sum(), (2, 1)).T, rtol=0, atol=0.01)
    assert_allclose(found.sigma, np.sqrt(parts.sum()), rtol=2e-3)
    both = sobol(Sums(), "product", tolerances, count=4096, S=0.0)  # a b: 4 Va, Vb and Va Vb together
    Va, Vb = 0.03, 0.27
    whole = 4 * Va + Vb + Va * Vb
    assert_allclose([both.first["a"], both.first["b"]], [4 * Va / whole, Vb / whole], rtol=0, atol=0.01)
    assert_allclose([both.total["a"], both.total["b"]], [(4 * Va + Va * Vb) / whole, (Vb + Va * Vb) / whole], rtol=0, atol=0.01)
    assert both.total["c"] == pytest.approx(0.0, abs=1e-12) and str(both).startswith("Variance of product, first order (total): b 0.6")


def test_sobol_indices_of_one_dimension_and_of_a_number_over_the_stroke():
    alone = sobol(Sums(), "linear", {"a": 0.03}, count=1024, S=0.0)
    assert_allclose([alone.first["a"], alone.total["a"]], 1.0, rtol=0, atol=0.02)
    over = sobol(ThreePointHitch(), swing, {"OB": 5 * mm, "M.y": 5 * mm}, count=256, S=S)
    assert over.first["OB"].shape == () and 0.9 < sum(over.first.values()) < 1.1


# -- what cannot be -------------------------------------------------------------------------------------------

ONE = {"OB": 0.1 * mm}


@for_all(
    ("call", "words"),
    [
        (lambda: Tolerance(-0.1), "is no tolerance"),
        (lambda: Tolerance((0.2, 0.1)), "is no tolerance"),
        (lambda: Tolerance(0.1, "gauss"), 'law=\'gauss\': say "normal" or "uniform" or "truncated"'),
        (lambda: spread(ThreePointHitch(), {}, "tilt", {}, {"S": 0.1}), "tolerances by the names of dimensions are expected"),
        (lambda: spread(ThreePointHitch(), {}, "tilt", {"OBX": 1.0}, {"S": 0.1}), "Did you mean OB?"),
        (lambda: spread(ThreePointHitch(), {}, "tilt", {"AB": 1.0}, {"S": 0.1}), "AB follows L0 + S; give what it follows a tolerance"),
        (lambda: spread(ThreePointHitch(), {}, "tilt", {"M": 0.1, "M.x": 0.1}, {"S": 0.1}), "are one dimension"),
        (lambda: spread(ThreePointHitch(), {}, "G", ONE, {"S": 0.1}), "G has two components"),
        (lambda: spread(ThreePointHitch(), {}, swing, ONE, {"S": 0.1}), "its gradient is not known"),
        (lambda: tornado(ThreePointHitch(), "tilt", ONE, S=[0.0, 0.1]), "at 2 poses; say one pose"),
        (lambda: tornado(ThreePointHitch(), "tilt", ONE, S=0.1)["CD"], "has no bar"),
        (lambda: sobol(ThreePointHitch(), "tilt", ONE, count=100), "a power of two"),
        (lambda: sobol(ThreePointHitch(), "tilt", {"lift.bore": 1 * mm}, count=64, S=0.1), "does not vary with lift.bore"),
        (lambda: sobol(ThreePointHitch(), "tilt", {"MK": 0.5, "OB": 30 * mm}, count=512), "so that its variance is not known"),
        (lambda: monte_carlo(ThreePointHitch(), "tilt", ONE), "a list of quantities is expected"),
        (lambda: monte_carlo(ThreePointHitch(), ["tilt", "tilt"], ONE), "two of them go by one name"),
        (lambda: monte_carlo(ThreePointHitch(), ["tilt"], ONE, subject_to=["tilt"]), "is no condition"),
        (lambda: monte_carlo(ThreePointHitch(), ["tilt"], ONE, subject_to=[at("tilt", S=0.1) == 0.0]), "no machine keeps an equation"),
        (lambda: monte_carlo(ThreePointHitch(), ["tilt"], ONE, subject_to=[at("tilt") >= 0.0]), "say the pose, S=..."),
        (lambda: monte_carlo(ThreePointHitch(), [most(worst("tilt", over="S"))], ONE), "looks at the strokes it is given"),
        (lambda: tornado(ThreePointHitch(), integral("tilt", by="T"), ONE), "by= one of S"),
        (lambda: monte_carlo(ThreePointHitch(), ["tilt"], ONE, percentiles=(5, 101)), "percentages from 0 to 100"),
        (lambda: monte_carlo(ThreePointHitch(), ["tilt"], ONE, method="halton"), "method='halton': say \"sobol\""),
        (lambda: monte_carlo(ThreePointHitch(), ["tilt"], ONE, backend="c"), 'say "numpy" or "numba"'),
        (lambda: monte_carlo(ThreePointHitch(), ["tilt"], ONE, S=[]), "there are no strokes to look at"),
        (lambda: monte_carlo(ThreePointHitch(), [lambda motion: "x"], ONE, count=4), "a number for each pose or each design is expected"),
        (lambda: monte_carlo(ThreePointHitch(), [lambda motion: np.ones(3)], ONE, count=4), "has the shape (3,)"),
        (lambda: monte_carlo(ThreePointHitch(), ["tilt"], ONE, count=4)["psi"], "Quantity 'psi' is unknown"),
        (lambda: monte_carlo(ThreePointHitch(OB=np.array([0.29, 0.3])), ["tilt"], ONE), "a study starts from one design"),
        (lambda: plot_bands(3), "has no bands"),
        (lambda: plot_tornado(3), "has no bars"),
        (lambda: plot_bands(monte_carlo(ThreePointHitch(), [swing], ONE, count=4)), "there is no curve to draw over S"),
    ],
)
def test_what_cannot_be_is_refused_in_words(call, words):
    with pytest.raises(DefinitionError) as refused:
        call()
    assert words in str(refused.value)


# -- pictures -------------------------------------------------------------------------------------------------


def test_a_picture_of_bands_shows_what_was_found():
    found = monte_carlo(
        ThreePointHitch(),
        ["tilt", drive_force()],
        {"OB": 2 * mm, "load.mass": 50.0},
        count=64,
        subject_to=[most(drive_force()) <= 65 * kN],
        S=S,
    )
    tilt, force = plot_bands(found, units={"the driving force of S": "kN"}).axes
    assert (
        tilt.get_title("left").replace("\n", " ") == "tilt, deviation from nominal, deg"
        and force.get_title("left") == "the driving force of S, kN"
    )
    lines = {line.get_label(): line.get_ydata() for line in force.lines}
    band = found[drive_force()]
    assert_allclose(lines["median"], band.percentiles[50.0] / kN)
    assert_allclose(lines["nominal"], band.nominal / kN)
    assert any(np.allclose(line.get_ydata(), 65.0) for line in force.lines)
    assert_allclose({line.get_label(): line.get_ydata() for line in tilt.lines}["nominal"], 0.0)
    plain = monte_carlo(ThreePointHitch(), [drive_force()], {"OB": 2 * mm}, count=16, S=S)
    far = monte_carlo(ThreePointHitch(), [drive_force()], {"OB": 2 * mm}, count=16, subject_to=[most(drive_force()) <= 900 * kN], S=S)
    assert plot_bands(far).axes[0].get_ylim() == plot_bands(plain).axes[0].get_ylim()  # a limit that is not in the panel takes no room


def test_a_picture_of_a_tornado_has_the_longest_bar_at_the_top():
    found = tornado(ThreePointHitch(), "tilt", {"CD": 5 * mm, "MK": 5 * mm, "KFG": 1 * deg}, unit="deg", S=0.1)
    (ax,) = plot_tornado(found).axes
    assert [text.get_text() for text in ax.get_yticklabels()] == ["MK ±5 mm", "CD ±5 mm"]  # KFG has no effect
    widths = [patch.get_width() for patch in ax.patches if patch.get_height() > 0.5]
    assert_allclose(sorted(widths[:4]), sorted(change / deg for bar in found.bars[:2] for change in (bar.low, bar.high)))


class InCases(Mechanism):
    """A lever on a cylinder, with load cases of which one does not occur."""

    S = Stroke(0.0, 0.25)
    A, O = Ground(0.20, 0.55), Ground(0.30, 1.15)
    B = Dyad(A, O, AB=0.50 + S, OB=0.30, side=RIGHT)
    G = OnLink(O, B, OG=0.90, BOG=-40 * deg)
    load = Weight(G, mass=1400)
    heavy, light, never = (LoadCase(name, scale={"load": scale}) for name, scale in (("heavy", 1.2), ("light", 0.5), ("never", 3.0)))
    ram = Cylinder(A, B, bore=80 * mm, rod=45 * mm)
    pump = LiftCircuit(ram, pressure=18e6, mechanical_efficiency=0.9)
    runs = Over(cases=["plain", "heavy", "light"])


class Rubbing(InCases):
    rub = PinFriction("O", radius=30 * mm, coefficient=0.15)


@pytest.mark.parametrize("structure", [InCases, pytest.param(Rubbing, marks=pytest.mark.slow)])
def test_a_measure_and_a_condition_count_the_cases_and_directions_that_answers_count(structure):
    machine, strokes = structure(), {"S": np.array([0.0, 0.25])}
    over = Over.poses(cases=["plain", "heavy", "light"], **strokes)
    asked = [most(drive_force()), least(drive_force()), least(reserve("ram")), most(pressure("ram")), most(pin_force("O"))]
    told = machine.answers(asked, over=over)
    limits = [each <= share * one.value for each, one in zip(asked, told, strict=True) if each.sense > 0.0 for share in (0.99, 1.01)]
    found = monte_carlo(machine, asked, {"OB": (0.0, 1e-9)}, subject_to=limits, count=2, **strokes)
    for each, one in zip(asked, told, strict=True):
        band = found[each]
        assert_allclose([band.nominal, band.mean, band.low, band.high], one.value, rtol=1e-6)
    assert [*found.kept.values()] == [0.0, 1.0] * 3 and "at rest" not in str(found)
