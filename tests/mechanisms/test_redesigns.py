"""The redesigns of docs/redesigns.md: what was found, built anew, against formulas and another method; the searches themselves."""

from itertools import combinations
from math import atan2, cos, hypot, pi

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import reserve
from linkage import DefinitionError, driving_force, gap, optimise, pin_forces
from linkage.units import deg, kgf_cm2, mm
from mechanisms.header_balancer import ThreeHeaders, largest_charge, over_following, relief, with_header
from mechanisms.header_balancer.criteria import FAST, PAPER, SLOW
from mechanisms.header_balancer.following import HeaderState
from mechanisms.mower_lift import BELOW, DELFI, MowerLift
from mechanisms.redesigns import (
    CLEAR,
    FLAT_HITCH,
    PINS,
    STEADY_REACTION,
    STRONG_LIFT,
    flat_hitch,
    steady_balancer,
    steady_reaction,
    strong_lift,
)
from mechanisms.three_point_hitch import ThreePointHitch
from mechanisms.three_point_hitch.capacity import capacity
from tests.for_all import first_daily, for_all

HEADERS = (1, 2, 3)


def kz_by_hand(S, A, O, OB, OG, BOG):
    """Return the worksheet's reserve by its closed formulas: the lever's angle from the cosine rule, dG_y/dS from its derivative."""
    OA = hypot(O[0] - A[0], O[1] - A[1])
    AOB = np.arccos((OA**2 + OB**2 - S**2) / (2 * OA * OB))
    turning = S / (OA * OB * np.sin(AOB))
    OG_way = pi + atan2(O[1] - A[1], O[0] - A[0]) + AOB + BOG
    lifted = OG * np.cos(OG_way) * turning
    area = pi / 4 * 8.0**2
    return 155.0 * area * 0.85 * 0.95 / (900.0 * lifted), O[1] + OG * np.sin(OG_way)


def test_the_lift_is_strong_enough_by_the_worksheets_own_formulas():
    design, S = STRONG_LIFT, np.linspace(0.55, 0.80, 1001)
    OG = hypot(1.07, 0.37)
    kz, height = kz_by_hand(S, design["A"], design["O"], design["OB"], OG, design["BOG"])
    before, was = kz_by_hand(S, (0.0, 0.242), (0.652, 0.330), 0.175, OG, DELFI + BELOW)
    motion = MowerLift(**design).at(S=S)
    assert_allclose(motion[reserve("lift")], kz, rtol=1e-10)
    assert_allclose(motion.y("G"), height, atol=1e-12)
    assert before.min() == pytest.approx(0.963, abs=5e-4)
    assert kz.min() > 1.24
    assert np.abs(height - was)[[0, -1]].max() <= 30 * mm


def test_no_pin_of_the_lift_moves_farther_than_it_may():
    moved = [np.subtract(STRONG_LIFT["A"], (0.0, 0.242)), np.subtract(STRONG_LIFT["O"], (0.652, 0.330))]
    new, old = (OB * np.array([cos(way), np.sin(way)]) for OB, way in ((STRONG_LIFT["OB"], STRONG_LIFT["BOG"]), (0.175, DELFI + BELOW)))
    assert max(float(np.hypot(*each)) for each in (*moved, new - old)) <= PINS + 1e-12


def test_the_hitch_lifts_the_same_everywhere():
    before, motion = ThreePointHitch().sweep(1001), ThreePointHitch(**FLAT_HITCH).sweep(1001)
    lifted, was = capacity(motion), capacity(before)
    assert was.max() / was.min() == pytest.approx(1.1927, abs=5e-5)
    assert lifted.max() / lifted.min() <= 1.0033
    assert motion[reserve("lift")].min() >= before[reserve("lift")].min()
    assert np.abs(motion.y("G") - before.y("G"))[[0, -1]].max() <= 50 * mm
    assert abs(np.ptp(motion.y("G")) - np.ptp(before.y("G"))) <= 50 * mm
    assert np.abs(motion["tilt"] - before["tilt"])[[0, -1]].max() <= 3.05 * deg
    design, now = motion.designs, before.designs
    assert max(abs(float(design[name]) - float(now[name])) for name in flat_hitch()["vary"] if name in now) <= PINS + 1e-12


def gaps_of(machine):
    """Return the least gap of each pair of moving bodies and cylinders that share no pin [m]."""
    plan, motion, found = machine.plan, machine.sweep(401), {}
    bodies = [each.name for each in plan.links[1:]] + ["".join((each.P, each.Q)) for each in plan.cylinders]
    for a, b in combinations(dict.fromkeys(bodies), 2):
        try:
            found[a, b] = float(motion[gap(a, b)].min())
        except DefinitionError:  # they share a pin
            continue
    return found


@for_all(
    ("before", "after"),
    [
        (ThreePointHitch(), ThreePointHitch(**FLAT_HITCH)),
        (MowerLift(), MowerLift(**STRONG_LIFT)),
        *[(with_header(number), steady_balancer(number)) for number in HEADERS],
    ],
)
def test_bodies_that_are_clear_of_one_another_stay_so(before, after):
    """What lies in one plane today has a clear gap; what crosses today lies beside the other and may go on doing so."""
    now, was = gaps_of(after), gaps_of(before)
    assert [pair for pair, gap in was.items() if gap >= CLEAR and now[pair] < CLEAR] == []


def test_the_gap_of_cylinder_and_lift_rod_is_that_of_two_segments():
    """By hand: the least distance of points of one rod from the other, sampled."""
    motion, share = ThreePointHitch(**FLAT_HITCH).sweep(101), np.linspace(0.0, 1.0, 401)
    on_rod = motion["C"][:, :, None] + (motion["D"] - motion["C"])[:, :, None] * share
    along = motion["B"] - motion["A"]
    place = np.clip(((on_rod - motion["A"][:, :, None]) * along[:, :, None]).sum(0) / (along**2).sum(0)[:, None], 0.0, 1.0)
    away = np.hypot(*(on_rod - motion["A"][:, :, None] - along[:, :, None] * place)).min()
    assert away == pytest.approx(motion[gap("AB", "CD")].min(), abs=1e-4)
    assert away >= CLEAR


def test_the_flat_hitch_by_equilibrium_and_by_virtual_work():
    """The cylinder's thrust from every pin's balance is that of the work; the capacity is the pump's force over dG_y/dS."""
    motion = ThreePointHitch(**FLAT_HITCH).sweep(101)
    along = motion["B"] - motion["A"]
    thrust = (pin_forces(motion).force("B", on="lift") * along / np.hypot(*along)).sum(axis=0)
    assert_allclose(np.abs(thrust), driving_force(motion), rtol=1e-9)
    rise = np.gradient(motion.y("G"), motion.strokes["S"], edge_order=2)
    assert_allclose(capacity(motion)[1:-1], (18e6 * 2 * pi / 4 * 0.110**2 * 0.85 / rise)[1:-1], rtol=1e-4)


@first_daily(0, "number", HEADERS)
def test_the_reaction_is_steady_with_every_header(number):
    machine, before = steady_balancer(number), with_header(number)
    now, was = (HeaderState(over_following(each.at(h=0.0), 1001)) for each in (machine, before))
    assert np.ptp(now.free) <= 0.5 * np.ptp(was.free)
    assert np.ptp(now.up) <= 0.5 * np.ptp(was.up)
    assert np.ptp(now.down) <= 0.5 * np.ptp(was.down)
    assert now.hysteresis.max() < was.hysteresis.min()
    assert now.down.min() > 0.0
    motion = machine.at(h=0.0)
    assert float(machine["charge"]) < min(largest_charge(motion, way) for way in (SLOW, FAST, PAPER))
    assert relief(motion).value < 160 * kgf_cm2 / 1.1
    assert machine.at(h=0.45).y("R") == pytest.approx(float(before.at(h=0.45).y("R")), abs=10 * mm)


@first_daily(1, "number", HEADERS)
def test_three_headers_side_by_side_are_the_three_machines(number):
    case = ("first", "second", "third")[number - 1]
    state = HeaderState(over_following(with_header(number).at(h=0.0), 41))
    motion = ThreeHeaders().at(height=state.height)
    assert_allclose(driving_force(motion, case=case), state.free, rtol=1e-9)
    assert_allclose(motion[f"length{number}"], state.motion.distance("A", "B"), rtol=1e-12)


@pytest.mark.slow
def test_the_search_finds_the_strong_lift():
    found = optimise(**strong_lift(), method="local")
    assert found.value == pytest.approx(1.24689, abs=2e-5)
    assert found.start_value == pytest.approx(0.96263, abs=1e-5)


@pytest.mark.slow
def test_the_search_finds_the_steady_reaction():
    found = optimise(**steady_reaction(), method="local")
    assert found.value <= 1530.0
    assert_allclose(found.machine["A"], STEADY_REACTION["A"], atol=1 * mm)
    assert found.machine["L_OB"] == pytest.approx(STEADY_REACTION["L_OB"], abs=1 * mm)


@pytest.mark.slow
def test_the_search_finds_the_flat_hitch():
    found = optimise(**flat_hitch(), method="local")
    assert found.value == pytest.approx(1.0032, abs=5e-5)
    assert [kept.units for kept in found.conditions if "gap" in str(kept)] == ["mm"]
