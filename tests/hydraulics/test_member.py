"""A cylinder as a member of a machine: its design variables, its length, its standard sizes, buckling."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Buckling, Cylinder, LiftCircuit, lift_verdicts
from linkage import (
    RIGHT,
    Actuator,
    DefinitionError,
    Dimension,
    Dyad,
    Ground,
    Guide,
    LoadCase,
    Mechanism,
    OnGuide,
    PinFriction,
    Stroke,
    Weight,
    draw,
)
from linkage.statics import driving_force
from linkage.units import bar, deg, kN, mm
from tests.for_all import first_daily, for_all


class Arm(Mechanism):
    """A cylinder turns an arm."""

    S = Stroke(0.00, 0.25)
    A = Ground(0.20, 0.55)
    O = Ground(0.30, 1.15)
    B = Dyad(A, O, AB=0.50 + S, OB=0.30, side=RIGHT)
    lift = Cylinder(A, B, bore=110 * mm, rod=63 * mm, count=2, closed=0.48, stroke=0.27)


class Following(Arm):
    """Its bore is a dimension."""

    D = Dimension(0.09)
    lift = Cylinder("A", "B", bore=D, rod="D_rod")
    D_rod = Dimension(0.045)


def test_outside_a_class_it_is_its_size():
    ram = Cylinder("A", "B", bore=63 * mm, rod=40 * mm, count=2)
    assert_allclose(ram.size.thrust(100 * bar), 2 * np.pi / 4 * 0.063**2 * 1e7)
    assert_allclose(ram.size.pressure_for(ram.size.thrust(123 * bar)), 123 * bar)
    pulling = Cylinder("A", "B", bore=63 * mm, rod=40 * mm, works="rod")
    assert_allclose(pulling.size.thrust(100 * bar), -np.pi / 4 * (0.063**2 - 0.040**2) * 1e7)


def test_bore_and_rod_are_design_variables():
    batch = Arm(**{"lift.bore": np.array([0.10, 0.11, 0.125])}).sweep(5)
    assert_allclose(Arm.lift.sized(batch).area[:, 0], 2 * np.pi / 4 * np.array([0.10, 0.11, 0.125]) ** 2)
    assert Arm().dimensions["lift.rod"] == 0.063


def test_bore_and_rod_may_follow_dimensions():
    size = Following.lift.sized(Following(D=0.1).sweep(3))
    assert_allclose(np.unique([size.bore]), 0.1)
    assert_allclose(np.unique([size.rod]), 0.045)
    with pytest.raises(DefinitionError, match=r"sized\(motion\)"):
        _ = Following.lift.size


def test_it_puts_no_load_on_the_machine():
    assert_allclose(driving_force(Arm().sweep(3), ["lift"]), 0.0)


@for_all(
    ("closed", "stroke", "words"),
    [
        (0.52, 0.25, ["20.0 mm too long closed"]),
        (0.50, 0.20, ["50.0 mm are missing open"]),
        (0.51, 0.20, ["10.0 mm too long closed", "40.0 mm are missing open"]),
        (None, 0.20, ["50.0 mm are missing"]),
        (0.53, None, ["30.0 mm too long closed"]),
    ],
)
def test_a_cylinder_that_does_not_fit_says_how_many_millimetres(closed, stroke, words):
    (verdict,) = Cylinder("A", "B", bore=0.1, rod=0.05, closed=closed, stroke=stroke).fits(Arm().sweep(11))
    assert not verdict
    assert all(each in verdict.sentence for each in words)


@pytest.mark.parametrize(("closed", "stroke"), [(0.50, 0.25), (0.40, 0.40), (None, 0.25), (0.45, None)])
def test_a_cylinder_that_fits(closed, stroke):
    (verdict,) = Cylinder("A", "B", bore=0.1, rod=0.05, closed=closed, stroke=stroke).fits(Arm().sweep(11))
    assert verdict


@for_all(
    ("design", "missing"),
    [
        ({}, None), ({"lift.stroke": 0.26}, "10.0 mm are missing open"), ({"lift.closed": 0.53}, "30.0 mm too long closed"),
        ({"lift.stroke": 0.25, "lift.closed": 0.50}, None), ({"lift.closed": 0.47}, "10.0 mm are missing open"),
    ],
    ids=str,
)  # fmt: skip
def test_stroke_and_closed_length_are_design_variables(design, missing):
    motion = Arm(**design).sweep(5)
    (verdict,) = Arm.lift.fits(motion)
    assert bool(verdict) is (missing is None)
    assert missing is None or missing in verdict.sentence
    assert {"lift.stroke": 0.27, "lift.closed": 0.48} | design == {name: Arm(**design)[name] for name in ("lift.stroke", "lift.closed")}


@pytest.mark.parametrize("end", [0.3, 0.31, 0.5])
def test_pins_that_come_together_are_told_wherever_samples_fall(end):
    class Meet(Mechanism):
        S = Stroke(-0.3, end)
        rail, K = Guide((0.0, 0.0), angle=90 * deg), Ground(0.0, 0.1)
        P = OnGuide(rail, at=S)
        ram, load = Cylinder(K, P, bore=50 * mm, rod=28 * mm, works="both"), Weight(P, mass=100.0)

    assert len(draw(Meet()).findobj()) < 1000  # not a tube for each of very many stages
    told = next(each for each in Meet().verdicts() if each.rule == "length")
    assert told.ok is False and "shrinks to nothing, at S = 100.0 mm" in told.sentence


def test_lengths_of_a_batch():
    strokes = np.array([0.20, 0.25, 0.32])
    closed, stroke = Arm.lift.closed_and_stroke(Arm(**{"lift.stroke": strokes}).sweep(5))
    assert_allclose(np.ravel(stroke), strokes)
    assert float(closed) == 0.48
    assert Cylinder("A", "B", bore=0.1, rod=0.05, stroke=0.3).closed_and_stroke(Arm().sweep(3)) == (None, 0.3)


class Built(Arm):
    """Its closed length follows its stroke, and that a dimension."""

    out = Dimension(0.25)
    lift = Cylinder("A", "B", bore=0.1, rod=0.05, stroke="out", closed=out + 0.25)


@pytest.mark.parametrize(("out", "missing"), [(0.25, ""), (0.24, "20.0 mm are missing open"), (0.27, "20.0 mm too long closed")])
def test_lengths_follow_dimensions(out, missing):
    (verdict,) = Built(out=out).lift.fits(Built(out=out).sweep(5))
    assert ("lift.stroke" in Built().dimensions, "lift.closed" in Built().dimensions) == (False, False)
    assert bool(verdict) is (not missing)
    assert missing in verdict.sentence


@for_all(
    ("machine", "words"),
    [
        (lambda: Arm(**{"lift.stroke": 0.0}), "Stroke of the cylinder = 0 is not above zero; give a positive number"),
        (lambda: Arm(**{"lift.closed": 500.0}), r"Closed length of the cylinder = 500 m .* write 500 \* mm"),
        (lambda: Arm(**{"lift.stroke": -0.1}), r"lift\.stroke=-0\.1 is negative; give zero or more"),
        (lambda: Built(out=300), r"Closed length of the cylinder = 300\.25 m .* write 300\.25 \* mm"),
        (lambda: type("Moved", (Arm,), {"lift": Cylinder("A", "B", bore=0.1, rod=0.05, stroke="S")})(), "Stroke = S follows a stroke"),
        (lambda: Built(**{"lift.stroke": 0.2}), "lift.stroke"),
    ],
)  # fmt: skip
def test_lengths_of_a_design_that_cannot_be_are_refused(machine, words):
    with pytest.raises(DefinitionError, match=words):
        _ = machine().lift.fits(machine().sweep(3))


def test_without_lengths_there_is_nothing_to_say():
    assert Cylinder("A", "B", bore=0.1, rod=0.05).fits(Arm().sweep(3)) == []


def test_standard_sizes():
    assert Arm.lift.standard()
    verdict = Cylinder("A", "B", bore=61 * mm, rod=40.5 * mm).standard()
    assert verdict.ok is None and "50 and 63 mm" in verdict.sentence and "40 and 45 mm" in verdict.sentence
    assert "does not suit" in Cylinder("A", "B", bore=100 * mm, rod=8 * mm).standard().sentence


def test_offers_give_the_thrust_and_do_not_buckle():
    offers = Arm.lift.offers(200 * kN, 160 * bar)
    assert {offer.bore for offer in offers} == {0.09}
    assert all(offer.thrust(160 * bar) >= 200 * kN for offer in offers)
    long = Arm.lift.offers(200 * kN, 160 * bar, length=2.0)
    assert 0 < len(long) < len(offers)
    assert min(offer.rod for offer in long) > min(offer.rod for offer in offers)
    with pytest.raises(DefinitionError, match="use more cylinders"):
        Arm.lift.offers(1e9, 160 * bar)


@pytest.mark.slow
def test_buckling_is_of_one_of_the_cylinders_at_its_worst_pose():
    motion, load = Arm().sweep(11), [Actuator("A", "B", force=-100 * kN)]
    (verdict,) = Arm.lift.buckling(motion, load)
    assert verdict and "50 kN on a 63 mm rod 750 mm long" in verdict.sentence and "at S = 250.0 mm" in verdict.sentence
    assert not Cylinder("A", "B", bore=0.1, rod=0.016).buckling(motion, load)[0]
    assert [bool(each) for each in Arm.lift.checks(motion, load)] == [True, True, True]


@first_daily(2, "count", [2, 50, 5])
def test_buckling_looks_at_every_load_case_and_direction(count):
    class Loaded(Arm):
        load = Weight("B", mass=9000.0)
        pin = PinFriction("O", radius=0.05, coefficient=0.2)
        shock = LoadCase(scale={"load": 1.8})

    motion = Loaded().sweep(count)
    (verdict,) = Loaded.lift.buckling(motion)
    fine = Loaded().sweep(2001)
    use = [Loaded.lift.thrust(fine, case="shock", direction=way) / 2 for way in ("extending", "retracting", "frictionless")]
    rod = Buckling(rod=0.063)
    worst = max(float(np.max(each / rod.critical(fine.distance("A", "B")))) for each in use)
    assert float(verdict.sentence.split("safety ")[1].split(",")[0]) == pytest.approx(1.0 / worst, rel=2e-3)


@for_all(
    "given",
    [
        {"bore": -0.1}, {"bore": 0.05, "rod": 0.05}, {"rod": 0.0}, {"bore": float("nan")}, {"count": 0}, {"works": "all"},
        {"stroke": -0.1}, {"closed": 0.0}, {"mounting": "loose"}, {"safety": 0.5},
    ],
    ids=str,
)  # fmt: skip
def test_what_cannot_be_is_refused(given):
    with pytest.raises(DefinitionError):
        Cylinder("A", "B", **({"bore": 0.1, "rod": 0.05} | given))


def test_a_design_that_cannot_be_is_refused_when_asked():
    with pytest.raises(DefinitionError, match="not smaller than bore 100 mm"):
        Arm.lift.sized(Arm(**{"lift.rod": 0.11, "lift.bore": np.array([0.12, 0.10])}).sweep(3))


def test_it_is_written_as_it_can_be_pasted_back():
    assert str(Arm.lift) == "Cylinder(A, B, bore=0.11, rod=0.063, stroke=0.27, closed=0.48, count=2)"


def test_sizes_of_a_batch_are_not_judged():
    with pytest.raises(DefinitionError, match="one design at a time"):
        Arm.lift.standard(Arm(**{"lift.bore": np.array([0.10, 0.11])}).sweep(3))


@pytest.mark.parametrize(
    ("closed", "stroke", "remedy"),
    [
        (0.40, 0.20, "150.0 mm are missing open: take a longer stroke"),
        (0.375, 0.20, "175.0 mm are missing open: take a longer stroke"),
        (0.30, 0.20, "250.0 mm are missing open: no cylinder comes out by more than it is long closed: move its pins"),
        (0.30, 0.46, "it cannot come out by 460.0 mm, more than it is long closed: move its pins"),
    ],
)
def test_remedy_is_one_that_helps(closed, stroke, remedy):
    """The pins part to 750 mm: a cylinder with a single stage reaches them if half of that is enough for it closed."""
    (verdict,) = Cylinder("A", "B", bore=0.1, rod=0.05, closed=closed, stroke=stroke).fits(Arm().sweep(11))
    assert not verdict
    assert remedy in verdict.sentence


@pytest.mark.parametrize("strokes", [[3.0, 4.0], []])
def test_nothing_is_judged_where_no_pose_is_reached(strokes):
    lost = Arm().at(S=np.array(strokes), unreachable="nan")
    with pytest.raises(DefinitionError, match="no length to check"):
        Arm.lift.fits(lost)
    machine = type("Lifted", (Arm,), {"circuit": LiftCircuit("lift", pressure=160 * bar), "load": Weight("B", mass=500.0)})
    with pytest.raises(DefinitionError, match="nothing to judge"):
        lift_verdicts("circuit", machine().at(S=np.array(strokes), unreachable="nan"))
    for wrong in ("lift", "circus", None):
        with pytest.raises(DefinitionError, match="LiftCircuit"):
            lift_verdicts(wrong, machine().sweep(3))
