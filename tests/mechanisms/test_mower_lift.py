"""The mower lift against the worksheet's printed tables, in both spellings, and what it tells an engineer."""

import re

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import LiftCircuit
from linkage import (
    RIGHT,
    CosineAngle,
    DefinitionError,
    Dimension,
    Dyad,
    Link,
    Offset,
    PinFriction,
    Spring,
    Turn,
    Vector,
    Weight,
    kgf,
    kgf_cm2,
    mm,
    pin_forces,
)
from linkage.motion import below_zero
from linkage.units import litre, minute
from mechanisms.mower_lift import BELOW, DELFI_OF_INPUT, MowerLift
from tests.for_all import for_all
from tests.members import told_by

# Source: worksheet "Mathematical modelling of the lift of the left section of the KPR-6", as printed
PRINTED = {
    "FIS": "45.648 63.298 79.75 96.615 115.471 140.051",
    "FI3": "233.335 250.984 267.437 284.302 303.157 327.737",
    "FI": "13.151 15.103 lost 14.379 12.161 8.075",
    "FIS1": "5.464 7.417 7.676 6.692 4.474 0.388",
    "B_x": "0.548 0.595 0.644 0.695 0.748 0.800",
    "B_y": "0.190 0.165 0.155 0.160 0.183 0.237",
    "G_x": "1.739 1.784 1.730 1.583 1.324 0.884",
    "G_y": "0.013 0.358 0.677 0.975 1.241 1.438",
    "DFI3": "6.681 5.833 5.737 6.121 7.215 10.821",
    "I": "7.262 6.602 6.182 5.695 4.850 2.513",
    "F": "8094 7359 6890 6348 5405 2801",
    "pd": "161.017 146.397 137.081 126.282 107.534 55.727",
    "kz": "0.963 1.059 1.131 1.227 1.441 2.781",
}
STROKES = [0.55, 0.60, 0.65, 0.70, 0.75, 0.80]
OTHER_READING = DELFI_OF_INPUT + BELOW


class MowerLiftPrimitives(MowerLift):
    """The same lift in the vector method's primitives."""

    L3 = Dimension(0.175)
    LS3 = Dimension(float(np.hypot(1.07, 0.37)))
    FIS3 = Dimension(float(np.radians(129.5) + np.arctan2(-0.37, 1.07)))
    AO = Vector("A", "O")
    OAB = CosineAngle(abs(AO), MowerLift.S, L3)
    AB = Turn(AO, -OAB, length=MowerLift.S)
    B = Offset("A", AB)
    OB = Vector("O", B)
    OG = Turn(OB, FIS3, length=LS3)
    G = Offset("O", OG)
    lever = Link("O", B, G)


SPELLINGS = for_all("spelling", [MowerLift, MowerLiftPrimitives])


def area(motion):
    """Return SS [m2]."""
    return motion.plan.members["lift"].sized(motion).area


def rod_force(motion):
    """Return what the rod carries without friction, P I [N]."""
    return motion.plan.members["lift"].thrust(motion)


def lifting_force(motion):
    """Return P I / k_m [N]."""
    return motion.plan.members["circuit"].rod_force(motion)


def largest_force(motion):
    """Return F_max [N]."""
    return motion.plan.members["circuit"].largest(motion)


def pressure(motion):
    """Return pd [Pa]."""
    return motion.plan.members["circuit"].pressure_for(motion)


def reserve(motion):
    """Return kz."""
    return motion.plan.members["circuit"].reserve(motion)


def table(lift, motion):
    return {column.name: column for column in lift.columns(motion)}


@SPELLINGS
@for_all("name", PRINTED)
def test_printed_table(spelling, name):
    lift = spelling()
    shown = table(lift, lift.at(S=STROKES))[name].shown
    for value, text in zip(shown, PRINTED[name].split(), strict=True):
        if text != "lost":
            decimals = max(len(each.partition(".")[2]) for each in PRINTED[name].split() if each != "lost")
            assert f"{value:.{decimals}f}" == f"{float(text):.{decimals}f}"


def test_printed_constants():
    lift = MowerLift()
    motion = lift.at(S=0.55)
    assert f"{motion.distance('A', 'O'):.3f} {lift['OG']:.3f}" == "0.658 1.132"
    assert f"{np.degrees(motion['FI0']):.3f}" == "7.687"
    assert f"{np.degrees(lift['BOG']):.3f}" == "110.425"
    assert f"{area(motion) * 1e4:.3f}" == "50.265"
    assert f"{largest_force(motion) / kgf:.3e}" == "7.402e+03"


def test_printed_rod_forces():
    motion = MowerLift().at(S=0.55)
    assert f"{rod_force(motion) / kgf:.0f} {lifting_force(motion) / kgf:.0f}" == "6536 7689"


def test_units_of_the_table():
    lift = MowerLift()
    headings = [column.heading for column in lift.columns(lift.sweep(3))]
    assert {"S, m", "FI3, deg", "B_x, m", "DFI3, rad/m", "I", "F, kgf", "pd, kgf/cm2", "kz"} < set(headings)


def test_loop_closes():
    """B from O along FI3 and B from A along FIS1 are one point (the worksheet's check)."""
    lift = MowerLift()
    motion = lift.sweep(101)
    O, A, S = lift["O"][:, None], lift["A"][:, None], motion.strokes["S"]
    from_O = O + lift["OB"] * np.array([np.cos(motion["FI3"]), np.sin(motion["FI3"])])
    from_A = A + S * np.array([np.cos(motion["FIS1"]), -np.sin(motion["FIS1"])])
    assert_allclose(from_O, motion["B"], rtol=0, atol=1e-12)
    assert_allclose(from_A, motion["B"], rtol=0, atol=1e-12)


def test_ratios_are_the_worksheets_formulas():
    lift = MowerLift()
    motion = lift.sweep(101)
    S, L0, L3 = motion.strokes["S"], motion.distance("A", "O"), lift["OB"]
    DFI3 = 2 * S / np.sqrt(4 * L0**2 * L3**2 - (S**2 - (L3**2 + L0**2)) ** 2)
    assert_allclose(motion.ratio("FI3"), DFI3, rtol=1e-12)
    assert_allclose(motion.ratio("G")[1], DFI3 * lift["OG"] * np.cos(motion["FI3"] + lift["BOG"]), rtol=1e-12)


def test_spellings_are_one_mechanism():
    motion, other = MowerLift().sweep(101), MowerLiftPrimitives().sweep(101)
    for point in "BG":
        assert_allclose(motion[point], other[point], rtol=0, atol=1e-12)
        assert_allclose(motion.ratio(point), other.ratio(point), rtol=1e-12, atol=1e-12)
    assert {body.points for body in MowerLift().links} == {body.points for body in MowerLiftPrimitives().links}


def test_hydraulic_efficiency_counts_once():
    motion = MowerLift(k_g=0.8).sweep(11)
    assert_allclose(reserve(motion), largest_force(motion) / lifting_force(motion), rtol=1e-12)
    assert_allclose(pressure(motion) * area(motion), lifting_force(motion) / 0.8, rtol=1e-12)
    assert_allclose(rod_force(motion), rod_force(MowerLift(k_g=0.95).sweep(11)), rtol=0)


# -- verdicts ----------------------------------------------------------------------------------------------


def verdict(count=11, **dimensions):
    lift = MowerLift(**dimensions)
    return " ".join(lift.verdicts(lift.sweep(count)))


def rules(lift, motion):
    """Return the verdicts by their rules."""
    return {each.rule: each for each in lift.verdicts(motion) if each.is_rule}


def of_circuit(lift, motion):
    """Return the verdicts of the circuit alone by their rules."""
    return {each.rule: each for each in told_by(lift, "circuit", over=motion)}


def test_verdict_as_printed():
    lift = MowerLift()
    found = rules(lift, lift.sweep(101))
    assert found["lifting"] == (
        "FAIL lifting: at 155 kgf/cm2 the least reserve is 0.963, at S = 550.0 mm; too weak from S = 550.0 to 566.0 mm. "
        "It needs 161.1 kgf/cm2, or a bore of 90 mm, with a reserve of 1.22."
    )
    assert found["oil"] == "ok   oil: 1.26 l from end to end; time follows from the pump's flow, which is not given."
    assert found["lifting"].answer.value == pytest.approx(reserve(lift.at(S=0.55)), rel=1e-12)
    assert [*found] == ["assembly", "dead points", "standard size", "buckling", "lifting", "oil", "holding", "lowering"]


def test_verdict_of_the_other_reading():
    text = verdict(BOG=OTHER_READING)
    assert "the least reserve is 0.978, at S = 550.0 mm" in text
    assert "too weak from S = 550.0 to 560.4 mm" in text


@pytest.mark.slow
@for_all(("dimensions", "printed"), [({}, "0.5660"), ({"BOG": OTHER_READING}, "0.5604")])
@for_all("count", [2, 5, 50, 500])
def test_end_of_the_short_range_is_a_root(dimensions, printed, count):
    """Not the grid of the table: where the range ends, kz = 1, whatever the number of poses."""
    lift = MowerLift(**dimensions)
    (short,) = below_zero(lift.sweep(count), lambda each: reserve(each) - 1.0)
    start, end = short.start["S"], short.end["S"]
    assert (start, f"{end:.4f}") == (0.55, printed)
    assert f"too weak from S = 550.0 to {float(printed) / mm:.1f} mm." in of_circuit(lift, lift.sweep(count))["lifting"]
    below, at, above = reserve(lift.at(S=[end - 1e-9, end, end + 1e-9]))
    assert below < 1.0 < above
    assert at == pytest.approx(1.0, abs=1e-10)


def test_verdict_stays_where_the_motion_starts_higher():
    lift = MowerLift()
    assert "too weak from S = 560.0 to 566.0 mm" in of_circuit(lift, lift.at(S=[0.56, 0.70]))["lifting"]
    assert of_circuit(lift, lift.at(S=0.70))["lifting"] == "ok   lifting: at 155 kgf/cm2 the least reserve is 1.227, at S = 700.0 mm."
    assert "; too weak at S = 550.0 mm." in of_circuit(lift, lift.at(S=0.55))["lifting"]
    assert not of_circuit(lift, lift.at(S=0.55))["lifting"]


def test_verdict_with_reserve():
    assert lifted(p_max=200 * kgf_cm2) == "ok   lifting: at 200 kgf/cm2 the least reserve is 1.242, at S = 550.0 mm."


def lifted(**dimensions):
    lift = MowerLift(**dimensions)
    return of_circuit(lift, lift.sweep(11))["lifting"]


def test_verdict_follows_its_own_remedies():
    assert lifted(bore=90 * mm) and "least reserve is 1.218" in lifted(bore=90 * mm)
    assert lifted(p_max=161.1 * kgf_cm2)
    assert lifted(p_max=160.9 * kgf_cm2).ok is False


def test_verdict_where_nothing_can_be_lifted():
    text = lifted(p_max=50 * kgf_cm2)
    assert "too weak from S = 550.0 to 800.0 mm" in text
    assert "or a bore of 160 mm, with a reserve of 1.24" in text
    assert "no standard bore is large enough" in lifted(weight=1e7)


def test_verdict_where_the_lift_stops_on_its_way():
    (start,) = re.findall(r"too weak from S = ([0-9.]+) to 800.0 mm", lifted(BOG=0.6))
    lift = MowerLift(BOG=0.6)
    below, above = reserve(lift.at(S=[float(start) * mm - 2e-4, float(start) * mm + 2e-4]))
    assert above < 1.0 and not below < 1.0


def test_verdict_where_the_weight_drives():
    text = lifted(BOG=3.5)
    (start,) = re.findall(r"the load drives from S = ([0-9.]+) to 800.0 mm, there it is not limited by this cylinder", text)
    lift = MowerLift(BOG=3.5)
    motion = lift.at(S=[float(start) * mm - 1e-4, float(start) * mm + 1e-4])
    resists, drives = motion.ratio("G")[1]
    assert resists > 0.0 > drives
    assert np.isnan(reserve(motion)).tolist() == [False, True]
    assert pressure(motion)[1] == 0.0
    assert_allclose(lifting_force(motion)[1], rod_force(motion)[1] * 0.85)
    assert f"does not sink by itself from S = {start} to 800.0 mm" in of_circuit(lift, lift.sweep(2))["lowering"]


def test_verdict_where_the_weight_drives_everywhere():
    found = lifted(BOG=4.5)
    assert found.ok is None and found.startswith("--   lifting: the load drives all the way: it is not limited by this cylinder")
    lift = MowerLift(BOG=4.5)
    assert of_circuit(lift, lift.sweep(11))["lowering"].ok is False  # nothing brings it back against the load


def test_verdict_of_a_batch_counts_designs():
    lift = MowerLift(bore=np.array([70, 80, 90, 100]) * mm)
    text = rules(lift, lift.sweep(5))["lifting"]
    assert not text and text.startswith("FAIL lifting: 2 of 4 designs fail, of their worst values 0.737")
    assert "to 1.504" in text and "the first is design 1: at 155 kgf/cm2 the least reserve is 0.737, at S = 550.0 mm" in text


@pytest.mark.slow
def test_verdict_where_poses_are_out_of_reach():
    lift = MowerLift()
    found = rules(lift, lift.at(S=[0.3, 0.6, 0.7], unreachable="nan"))
    assert not found["assembly"] and "what follows holds for the rest" in found["assembly"]
    assert "183 mm short" in found["assembly"]
    (share,) = re.findall(r"([0-9.]+) % cannot be assembled", found["assembly"])
    assert float(share) == pytest.approx(100 * (0.48288 - 0.3) / 0.4, abs=0.1)  # up to the dead point at AO - OB
    assert "grows without bounds at S = 482.9 mm" in found["lifting"] and "keep away from that pose" in found["lifting"]
    assert "1.09 l" in found["oil"] and MowerLift.circuit.oil(lift.at(S=[0.48292, 0.7])) == pytest.approx(1.09e-3, rel=5e-3)
    (nowhere,) = lift.verdicts(lift.at(S=[0.1, 0.2], unreachable="nan"))
    assert nowhere.startswith("FAIL assembly: B = Dyad(A, O) cannot be assembled at 2 of 2 strokes") and not nowhere


def test_oil_is_area_times_travel():
    motion = MowerLift().sweep(3)
    assert MowerLift.circuit.oil(motion) == pytest.approx(np.pi / 4 * 0.08**2 * 0.25, rel=1e-12)


@for_all("dimensions", [{}, {"BOG": 0.6}], ids=str, slow=[{"BOG": 3.5}, {"p_max": 50 * kgf_cm2}, {"weight": 500 * kgf}])
def test_verdict_is_the_same_from_however_many_poses(dimensions):
    said = {verdict(count, **dimensions) for count in (2, 5, 500)}
    assert len(said) == 1


@pytest.mark.slow
def test_verdict_of_a_batch_is_the_same_from_however_many_poses():
    lift = MowerLift(BOG=np.array([0.5, 1.5, 2.5]))
    assert len({tuple(lift.verdicts(lift.sweep(count))) for count in (2, 50)}) == 1


# -- what a user adds --------------------------------------------------------------------------------------


class WithBallast(MowerLift):
    """500 kg more on the section."""

    ballast = Weight(MowerLift.G, mass=500)


class WithSpring(MowerLift):
    """A spring between frame and lever that helps to lift."""

    relief = Spring(MowerLift.A, MowerLift.B, stiffness=40e3, free_length=0.9)


class WithFriction(MowerLift):
    """Plain bearings at all three pins."""

    pin_A = PinFriction(MowerLift.A, radius=20 * mm, coefficient=0.15)
    pin_B = PinFriction(MowerLift.B, radius=20 * mm, coefficient=0.15)
    pin_O = PinFriction(MowerLift.O, radius=20 * mm, coefficient=0.15)


@pytest.mark.slow
def test_added_weight_counts_like_a_heavier_section():
    """500 kg of ballast at G are 500 kgf more of weight: table, verdict and pins say the same."""
    added, heavier = WithBallast(), MowerLift(weight=1400 * kgf)
    for one, other in zip(added.columns(added.sweep(7)), heavier.columns(heavier.sweep(7)), strict=True):
        assert_allclose(one.values, other.values, rtol=1e-12, err_msg=one.name)
    assert added.verdicts(added.sweep(7)) == heavier.verdicts(heavier.sweep(7))
    assert "the least reserve is 0.619" in rules(added, added.sweep(7))["lifting"]
    assert any(each.startswith("FAIL holding") for each in added.verdicts(added.sweep(7)))


def test_added_spring_takes_its_push_off_the_rod():
    lift = WithSpring()
    motion = lift.sweep(7)
    push = 40e3 * (0.9 - motion.distance("A", "B"))
    assert_allclose(rod_force(motion), rod_force(MowerLift().sweep(7)) - push, rtol=1e-12)
    shown = {column.name: column.shown for column in lift.columns(motion)}
    assert_allclose(shown["PI"] * kgf, rod_force(motion))
    assert rules(lift, motion)["lifting"]


def test_added_friction_costs_lifting_force():
    """The pins' couples by hand: at A and B the cylinder's own, r mu T against the turning; at O that of the lever."""
    motion, plain = WithFriction().sweep(5), MowerLift().sweep(5)
    gain = lifting_force(motion) * 0.85 - rod_force(plain)
    assert np.all(gain > 0.0)
    forces = pin_forces(motion, direction="extending")
    turn_lever, turn_rod = motion.ratio("FI3"), -motion.ratio("FIS1")
    # by power: what is rubbed away at each pin, couple times relative turning, a unit of stroke
    rubbed = sum(
        20 * mm * 0.15 * np.hypot(*joint.force) * np.abs(turning)
        for pin, turning in (("A", turn_rod), ("B", turn_lever - turn_rod), ("O", turn_lever))
        for joint in forces.at(pin)
    )
    assert_allclose(gain, rubbed, rtol=1e-3)
    assert_allclose(reserve(motion), largest_force(motion) / lifting_force(motion), rtol=1e-12)


def test_the_machine_is_like_any_users():
    """Its pins, with the cylinder as a body of its own; the numbers of its circuit are its design variables."""
    motion = MowerLift().at(S=[0.55])
    forces = pin_forces(motion)
    assert_allclose(forces.thrusts["lift"], 7.261737 * 900 * kgf, rtol=1e-6)
    assert_allclose(np.hypot(*forces.force("B", on="lift")), forces.thrusts["lift"], rtol=1e-12)
    assert isinstance(MowerLift.circuit, LiftCircuit)
    timed = MowerLift(**{"circuit.flow": 10 * litre / minute})
    assert "1.26 l from end to end, 7.5 s at 10 l/min." in " ".join(timed.verdicts(timed.sweep(2)))
    assert timed.circuit.time(timed.sweep(2)) == pytest.approx(np.pi / 4 * 0.08**2 * 0.25 / (10 * litre / minute), rel=1e-12)


def test_geometry_that_a_subclass_changes_is_judged_by_what_the_rod_carries():
    """The stroke as half the cylinder's travel: twice the driving force, the same thrust, pressures and reserve."""

    class Doubled(MowerLift):
        B = Dyad("A", "O", AB=0.55 + 2.0 * (MowerLift.S - 0.55), OB=0.175, side=RIGHT)

    motion, same = Doubled().at(S=[0.55, 0.60, 0.65]), MowerLift().at(S=[0.55, 0.65, 0.75])
    assert_allclose(reserve(motion), reserve(same), rtol=1e-12)
    assert_allclose(Doubled.circuit.oil(motion), MowerLift.circuit.oil(same), rtol=1e-9)


def test_batch_of_designs_broadcasts():
    bores = np.array([70, 80, 90]) * mm
    batch = reserve(MowerLift(bore=bores).sweep(7))
    assert batch.shape == (3, 7)
    for row, bore in zip(batch, bores, strict=True):
        assert_allclose(row, reserve(MowerLift(bore=bore).sweep(7)), rtol=1e-12)


@for_all(
    ("dimensions", "words"),
    [
        ({"k_m": 1.2}, "k_m = 1.2 is above 1"),
        ({"k_g": 0.0}, "k_g = 0 is not above zero"),
        ({"bore": -0.08}, "bore = -0.08 is not above zero"),
        ({"weight": 0.0}, "weight = 0 is not above zero"),
        ({"p_max": -1.0}, "p_max = -1 is not above zero"),
        ({"p_max": 155.0}, "p_max = 155 Pa is next to nothing; write 155 * bar if these are bar, or 155 * kgf_cm2"),
        ({"bore": 80.0}, "Bore = 80 m is more than any cylinder has; write 80 * mm"),
        ({"bore": 40 * mm}, "Rod 45 mm is not smaller than bore 40 mm"),
        ({"diameter": 1.0}, "unknown"),
    ],
)
def test_impossible_design_is_refused(dimensions, words):
    with pytest.raises(DefinitionError, match=re.escape(words)):
        MowerLift(**dimensions)


def test_docstring_keeps_the_contradiction_visible():
    for fact in ("126.665", "129.5", "contradicts", "(1.739, 0.013)", "0.5604"):
        assert fact in MowerLift.__doc__
