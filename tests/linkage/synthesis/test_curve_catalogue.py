"""The catalogue of closed curves: all in it runs, a curve finds itself however it is moved; and what a synthesis makes of it."""

from concurrent.futures import ThreadPoolExecutor
from math import pi

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from linkage import (
    LEFT,
    RIGHT,
    Crank,
    DefinitionError,
    Dyad,
    FunctionTask,
    Ground,
    Mechanism,
    OnLink,
    PathTask,
    Stroke,
    StudyError,
    curve_catalogue,
    deg,
    synthesise,
)
from linkage.synthesis.closed_curves import ClosedCurves, drawn_curve, laid_onto
from linkage.synthesis.curve_catalogue import CurveMeasure
from mechanisms.classics.four_bar import FourBar, TripleRocker
from mechanisms.classics.stephenson_one import StephensonOne
from tests.benchmarks import bench_catalogue
from tests.for_all import first_daily, for_all
from tests.linkage.synthesis.test_closed_curves import known_bars, pairs


class SixBar(Mechanism):
    """A class of a user's own: a rod from the coupler's point to a second rocker, whose end goes on."""

    phi = Stroke(0.0, 2 * pi)

    O = Ground(0.0, 0.0)
    C = Ground(0.30, 0.02)
    E = Ground(0.10, 0.40)

    A = Crank(O, OA=0.08, angle=phi)
    B = Dyad(A, C, AB=0.28, CB=0.20, side=LEFT)
    P = OnLink(A, B, AP=0.20, BAP=40 * deg)
    F = Dyad(P, E, PF=0.25, EF=0.22, side=RIGHT)
    Q = OnLink(P, F, PQ=0.15, FPQ=-30 * deg)


COUNT = 400


@pytest.fixture(scope="module")
def four_bars():
    """A catalogue of four-bars."""
    return curve_catalogue(FourBar(), "P", count=COUNT)


def turned(machine, of, count):
    """Return the closed curve of a point, complex (count,) [m]."""
    return machine.at(phi=np.arange(count) * 2 * pi / count)[of].T @ [1.0, 1.0j]


def test_all_that_is_in_it_runs_by_the_four_bars_own_rule(four_bars):
    """The crank passes both places where it lies along the frame: two triangles."""
    lengths = four_bars.kind.designs(four_bars.kind.values(four_bars.units))
    OA, AB, CB = (lengths[name] for name in ("OA", "AB", "CB"))
    assert len(four_bars) == COUNT
    assert np.all((1.0 + OA < AB + CB) & (np.abs(1.0 - OA) > np.abs(AB - CB)))


def test_what_runs_well_is_in_it():
    """Of random lengths all whose transmission angle stays above 4 degrees, and none that does not run."""
    random = np.random.default_rng(4)
    OA, AB, CB = random.uniform(0.1, 3.0, (3, 4000))
    bars = FourBar(OA=OA, AB=AB, CB=CB, C=(1.0, 0.0))
    runs = CurveMeasure("P", "phi", 0.0, 2 * pi)(bars)["runs"]
    ends = [(AB**2 + CB**2 - (1.0 + sign * OA) ** 2) / (2.0 * AB * CB) for sign in (-1.0, 1.0)]
    sine = np.sqrt(np.maximum(1.0 - np.maximum(*np.abs(ends)) ** 2, 0.0))
    assert not runs[sine == 0.0].any()
    assert runs[sine > np.sin(4 * deg)].all()
    assert 200 < runs.sum() < 3000


@first_daily(0, ("machine", "of"), [(StephensonOne(), "F"), (SixBar(), "Q")])
def test_six_bars_in_it_run_over_five_thousand_poses(machine, of):
    found = curve_catalogue(machine, of, count=60)
    for number in range(0, 60, 6):
        member = found.design(number)
        assert np.isfinite(member.at(phi=np.linspace(0.0, 2 * pi, 5001))[of]).all()


def test_a_curve_finds_itself_whatever_place_turn_size_start_and_sense(four_bars):
    random = np.random.default_rng(7)
    found = []
    for number in random.integers(len(four_bars), size=6):
        own = turned(four_bars.design(number), "P", 720)
        factor, by = random.uniform(0.02, 5.0) * np.exp(1j * random.uniform(0.0, 2 * pi)), complex(*random.normal(size=2))
        moved = np.roll(factor * own + by, random.integers(720))[:: random.choice([-1, 1])]
        first, second = four_bars.nearest(pairs(moved), 2)
        assert first.number == number and first.distance < second.distance
        found.append(first.distance)
        there = turned(first.machine, "P", 4000)
        assert np.abs(moved[::40, None] - there).min(axis=1).max() < 3e-3 * np.abs(moved - moved.mean()).max()
    assert np.median(found) < 1e-7 and max(found) < 1e-4


def test_amplitudes_apart_keep_curves_apart(four_bars):
    """No shift, turn, size and start brings two curves nearer than their amplitudes are."""
    curves = ClosedCurves(np.stack([turned(four_bars.design(number), "P", 128) for number in range(0, COUNT, COUNT // 50)]))
    for number in range(0, COUNT, COUNT // 5):
        onto, _ = drawn_curve(pairs(turned(four_bars.design(number), "P", 360)))
        laid = laid_onto(curves, onto, np.array([[1e-9], [1e9]]))
        a, b = (each.amplitudes.reshape(len(each.size), 2, -1) for each in (curves, onto))
        products = np.maximum((a * b).sum(axis=(1, 2)), (a * b[:, ::-1]).sum(axis=(1, 2)))
        least = np.sum(b**2) - products**2 / np.sum(a**2, axis=(1, 2))
        assert np.all(laid.error / onto.size**2 >= least - 1e-9)


def test_the_nearest_of_all_is_found(four_bars):
    """Against every curve of it laid on."""
    random = np.random.default_rng(2)
    u = np.arange(200) * 2 * pi / 200
    curves = ClosedCurves(np.stack([turned(four_bars.design(number), "P", 96) for number in range(len(four_bars))]))
    for _ in range(3):
        drawn = np.exp(1j * u) + sum(complex(*random.normal(size=2)) * 0.3 / k * np.exp(1j * k * u) for k in (-1, 2, -2, 3))
        onto, _ = drawn_curve(pairs(drawn))
        every = np.sqrt(laid_onto(curves, onto, np.array([[1e-9], [1e9]])).error) / onto.size
        found = four_bars.nearest(pairs(drawn))
        assert found[0].number == np.argmin(every)
        assert_allclose([each.distance for each in found], np.sort(every)[:8], rtol=1e-3)


def test_the_same_seed_gives_the_same_bits_whoever_does_the_work(four_bars):
    with ThreadPoolExecutor(2) as pool:
        again = curve_catalogue(FourBar(), "P", count=COUNT, executor=pool)
    assert_array_equal(again.units, four_bars.units)
    assert_array_equal(again.amplitudes, four_bars.amplitudes)
    other = curve_catalogue(FourBar(), "P", count=COUNT, seed=1)
    assert other.seed == 1 and not np.array_equal(other.units, four_bars.units)


def test_it_says_how_far_it_is_and_how_many_it_holds(monkeypatch):
    told = []
    first = curve_catalogue(FourBar(), "P", count=300, progress=lambda done, total: told.append((done, total)))
    assert told[0] == (0, 300) and told[-1] == (300, 300)
    assert len(first) == 300 and str(first) == f"FourBar, P: 300 closed curves of {first.looked} designs"
    monkeypatch.setattr("linkage.synthesis.curve_catalogue.CURVES", 200)
    assert len(curve_catalogue(FourBar(OA=0.05), "P")) == 200


def test_angles_that_are_held_stay():
    found = curve_catalogue(FourBar(BAP=0.2), "P", hold="BAP", count=300)
    assert [each.owner for each in found.kind.variables] == ["OA", "AB", "CB", "AP"]
    assert float(found.design(5)["BAP"]) == 0.2
    other = curve_catalogue(FourBar(BAP=0.3), "P", hold="BAP", count=300)
    assert float(other.design(5)["BAP"]) == 0.3


@for_all(("bar", "points"), lambda: known_bars(3, seed=29)[:1], slow=lambda: known_bars(3, seed=29)[1:])
def test_a_closed_curve_in_a_machine_out(four_bars, bar, points):
    vary = {"OA": (0.01, 0.08), "AB": (0.05, 0.2), "CB": (0.05, 0.2), "AP": (0.01, 0.15), "BAP": (-1.5, 1.5)}
    vary |= {f"{point}.{axis}": (-0.2, 0.2) for point in "OC" for axis in "xy"}
    found = synthesise(FourBar(), path=PathTask(points, of="P", closed=True), vary=vary, starts=four_bars)
    assert found.best.most <= 1e-9
    assert_allclose(found.machine.at(phi=found.best.strokes)["P"].T, points, rtol=0, atol=2e-9)
    found.machine.sweep(721)


@pytest.mark.slow
@pytest.mark.parametrize("limit", [999, pytest.param(None, marks=pytest.mark.slow)])
def test_the_word_makes_one(monkeypatch, limit):
    monkeypatch.setattr("linkage.synthesis.curve_catalogue.CURVES", 500)
    ((bar, points),) = known_bars(1, seed=3)
    vary = {"OA": (0.01, 0.08), "AB": (0.05, 0.2), "CB": (0.05, 0.2), "AP": (0.01, 0.15)}
    vary |= {f"{point}.{axis}": (-0.2, 0.2) for point in "OC" for axis in "xy"}
    task = PathTask(points, of="P", closed=True)
    one, two = (synthesise(FourBar(BAP=bar["BAP"]), path=task, vary=vary, starts="catalogue", limit=limit) for _ in range(2))
    assert [each.error for each in one.solutions] == [each.error for each in two.solutions]
    assert (limit or one.best.most <= 1e-9) and float(one.machine["BAP"]) == bar["BAP"]


POINTS = [(0.0, 0.0), (0.1, 0.0), (0.1, 0.1)]


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"path": PathTask(POINTS, of="P")}, "a catalogue holds closed curves"),
        ({"path": PathTask(POINTS, of="P", closed=True), "timed": "steps"}, "a catalogue holds closed curves"),
        ({"path": PathTask(POINTS, of="P", closed=True), "over": {"phi": (0.0, 2.0)}}, "a catalogue holds closed curves"),
        ({"function": FunctionTask([0.1], [0.2], of="psi")}, "a catalogue holds closed curves"),
        ({"path": PathTask(POINTS, of="B", closed=True)}, "a catalogue of FourBar, P, not of B"),
    ],
)
def test_what_a_catalogue_is_no_start_of(four_bars, given, words):
    with pytest.raises(DefinitionError, match=words):
        synthesise(FourBar(), vary={"OA": (0.03, 0.05)}, starts=four_bars, **given)


@pytest.mark.parametrize(
    ("make", "kind", "words"),
    [
        (lambda: curve_catalogue(TripleRocker(), "P"), DefinitionError, "one crank moves over a turn"),
        (lambda: curve_catalogue(FourBar(), "X"), DefinitionError, "a point that moves is expected"),
        (lambda: curve_catalogue(FourBar(), "P", hold="OA"), DefinitionError, "angles of the machine are expected; they are BAP"),
        (lambda: curve_catalogue(FourBar(), "P", count=0), DefinitionError, "a whole number of curves"),
        (lambda: curve_catalogue(FourBar(), "P", seed=-1), DefinitionError, "a whole number is expected"),
        (lambda: curve_catalogue(FourBar(), "P", progress=1), DefinitionError, "progress"),
        (lambda: curve_catalogue(FourBar(), "P", executor=3), DefinitionError, "submit"),
        (lambda: curve_catalogue(FourBar(OA=np.array([0.1, 0.2])), "P"), DefinitionError, "design"),
    ],
)
def test_what_cannot_be_a_catalogue_is_said(make, kind, words):
    with pytest.raises(kind, match=words):
        make()


@pytest.mark.parametrize(
    ("ask", "words"),
    [
        (lambda found: found.nearest([(0, 0), (1, 0)]), "three different points"),
        (lambda found: found.nearest([1.0, 2.0]), "pairs"),
        (lambda found: found.nearest(POINTS, 0), "from 1 on"),
        (lambda found: found.design(COUNT), f"numbers go from 0 to {COUNT - 1}"),
    ],
)
def test_what_a_catalogue_cannot_be_asked(four_bars, ask, words):
    with pytest.raises(DefinitionError, match=words):
        ask(four_bars)


def test_a_class_that_never_runs_says_so(monkeypatch):
    monkeypatch.setattr("linkage.synthesis.curve_catalogue.EDGE", 10.0)
    monkeypatch.setattr("linkage.synthesis.curve_catalogue.ROUND", 1 << 10)
    monkeypatch.setattr("linkage.synthesis.curve_catalogue.PATIENCE", 4)
    with pytest.raises(StudyError, match="of 448 designs none runs its whole turn"):
        curve_catalogue(FourBar(), "P", count=10)


@pytest.mark.slow
def test_two_hundred_closed_curves_are_found_again():
    errors = bench_catalogue.found_again(curve_catalogue(FourBar(), "P", count=1 << 16), 200)
    assert np.mean(errors <= 1e-9) >= 0.95


@pytest.mark.slow
def test_a_million_curves_are_made_and_each_finds_itself():
    found = curve_catalogue(FourBar(), "P", count=1_000_000)
    assert len(found) == 1_000_000
    for number in np.random.default_rng(3).integers(len(found), size=20):
        assert found.nearest(pairs(turned(found.design(number), "P", 720)), 1)[0].number == number
