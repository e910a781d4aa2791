"""Areas, thrust and pressure of cylinders, standard sizes, and what they refuse."""

from functools import partial
from math import pi

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from hydraulics import Cylinder, CylinderSize, next_bore, next_rod, standard_bores, standard_rods
from linkage import Crank, Ground, Guide, Mechanism, OnGuide, SingularWarning, Stroke, Weight
from linkage.errors import DefinitionError
from linkage.units import MPa, bar, kN, mm
from tests.for_all import for_all

PUSH = CylinderSize(bore=100 * mm, rod=60 * mm, count=2)
PULL = CylinderSize(bore=100 * mm, rod=60 * mm, count=2, works="rod")
pressures = st.floats(0, 50 * MPa)


def test_areas_by_hand():
    assert_allclose([PUSH.piston_area, PUSH.rod_area], [pi * 2500e-6, pi * 1600e-6])
    assert_allclose([PUSH.area, PUSH.back_area], [pi * 5000e-6, pi * 3200e-6])
    assert_allclose([PULL.area, PULL.back_area], [PUSH.back_area, PUSH.area])
    assert_allclose(PUSH.ratio, 25 / 16)


def test_catalogue_thrust():
    """Makers' tables: 31.2 kN for a bore of 63 mm at 100 bar, 125.7 kN for 100 mm at 160 bar."""
    assert_allclose(CylinderSize(63 * mm, 40 * mm).thrust(100 * bar) / kN, 31.2, atol=0.05)
    assert_allclose(CylinderSize(100 * mm, 56 * mm).thrust(160 * bar) / kN, 125.7, atol=0.05)


def test_a_rod_side_pulls():
    assert PULL.thrust(100 * bar) < 0 < PUSH.thrust(100 * bar)
    assert_allclose(PULL.pressure_for(-pi * 3200e-6 * 100 * bar), 100 * bar)
    assert (PUSH.sense, PULL.sense) == (1, -1)


@given(p=pressures, back=pressures, size=st.sampled_from([PUSH, PULL]))
def test_pressure_for_inverts_thrust(p, back, size):
    assert_allclose(size.pressure_for(size.thrust(p, back), back), p, atol=1e-6)


@given(p=pressures, back=pressures)
def test_the_sides_are_one_cylinder(p, back):
    assert_allclose(PUSH.thrust(p, back), PULL.thrust(back, p), atol=1e-6)


def test_both_sides_under_one_pressure_push_with_the_rod():
    assert_allclose(PUSH.thrust(100 * bar, back=100 * bar), 2 * pi * 900e-6 * 100 * bar)


def test_a_driving_load_needs_a_negative_pressure():
    assert PUSH.pressure_for(-10 * kN) < 0


def test_oil_and_speed():
    assert_allclose(PUSH.oil(0.25), 0.25 * PUSH.area)
    assert_allclose(PUSH.speed(PUSH.oil(0.25) / 5.0) * 5.0, 0.25)


def test_poses_at_once_and_unreached_ones():
    thrust = np.array([[10.0, np.nan], [30.0, -5.0]]) * kN
    pressure = PUSH.pressure_for(thrust)
    assert pressure.shape == (2, 2)
    assert np.array_equal(np.isnan(pressure), np.isnan(thrust))
    assert PUSH.thrust([10 * bar, 20 * bar], back=[[0.0], [1 * bar], [2 * bar]]).shape == (3, 2)


def test_the_size_for_a_thrust():
    assert PUSH.sized_for(250 * kN, 160 * bar).bore == 100 * mm  # 251.3 kN
    assert PUSH.sized_for(252 * kN, 160 * bar).bore == 110 * mm
    assert PUSH.sized_for(1.0, 160 * bar).bore == 63 * mm  # larger than the rod
    both, area = CylinderSize(100 * mm, 60 * mm, works="both"), pi / 4 * np.array([63 * mm, 100 * mm]) ** 2
    assert both.sized_for(0.5, 0.51 / area[0]).bore == 63 * mm < both.sized_for(-0.5, 0.51 / area[0]).bore  # half a newton pushes
    offers = Cylinder("A", "B", bore=100 * mm, rod=60 * mm, works="both").offers(0.5, 0.51 / area[1])
    assert tuple(each.rod for each in offers) == standard_rods(100 * mm)
    pulls = [Cylinder("A", "B", bore=0.1, rod=rod, works="both").offers(-50 * kN, 160 * bar) for rod in (0.012, 0.09)]
    assert pulls[0] == pulls[1] and {each.bore for each in pulls[0]} == {0.08}  # whatever rod it has
    found = PULL.sized_for(-250 * kN, 160 * bar)
    assert found.area * 160 * bar >= 250 * kN > CylinderSize(110 * mm, 60 * mm, 2, "rod").area * 160 * bar


def test_a_cylinder_says_what_it_is():
    assert str(PULL) == "2 cylinders 100/60 mm, rod side"
    assert str(CylinderSize(0.063, 0.04)) == "1 cylinder 63/40 mm, piston side"


def test_standard_sizes():
    bores = standard_bores()
    assert len(bores) == 27
    assert list(bores) == sorted(set(bores))
    assert_allclose([bores[0], bores[9], bores[-1]], [0.008, 0.063, 0.5])
    assert_allclose([next_bore(63 * mm), next_bore(62 * mm), next_bore(0.063), next_bore(110 * mm)], [0.08, 0.063, 0.08, 0.125])
    assert_allclose([next_rod(40 * mm), next_rod(41 * mm)], [0.045, 0.045])


def test_walking_the_series_meets_every_bore():
    walk = [standard_bores()[0]]
    while walk[-1] < 0.5:
        walk.append(next_bore(walk[-1]))
    assert tuple(walk) == standard_bores()


@for_all("bore", standard_bores())
def test_every_bore_has_rods(bore):
    rods = standard_rods(bore)
    assert rods
    assert all(1.06 <= CylinderSize(bore, rod).ratio <= 5.0 for rod in rods)


def test_rods_of_common_cylinders_are_offered():
    for bore, rod in [(40, 22), (40, 28), (50, 28), (50, 36), (63, 36), (63, 40), (63, 45), (80, 56), (100, 70), (125, 90)]:
        assert rod * mm in standard_rods(bore * mm)


@for_all(
    ("call", "message"),
    [
        (partial(CylinderSize, -63 * mm, 40 * mm), "Bore = -0.063 is not above zero"),
        (partial(CylinderSize, np.nan, 40 * mm), "Bore = nan is not finite"),
        (partial(CylinderSize, "63", 40 * mm), "Bore = '63' is not a number"),
        (partial(CylinderSize, 80, 45), r"Bore = 80 m is more than any cylinder has; write 80 \* mm if these are millimetres"),
        (partial(CylinderSize, np.array([0.08, 100.0]), 45 * mm), r"Bore = 100 m .* write 100 \* mm"),
        (partial(CylinderSize, 80 * mm, 45), r"Rod = 45 m .* write 45 \* mm"),
        (partial(CylinderSize, 63 * mm, 0.0), "Rod = 0 is not above zero"),
        (partial(CylinderSize, 40 * mm, 63 * mm), "Rod 63 mm is not smaller than bore 40 mm; exchange them"),
        (partial(CylinderSize, 40 * mm, 40 * mm), "Rod 40 mm is not smaller than bore 40 mm"),
        (partial(CylinderSize, 63 * mm, 40 * mm, 0), "Count of cylinders = 0; give a whole number from 1 on"),
        (partial(CylinderSize, 63 * mm, 40 * mm, 1.5), "Count of cylinders = 1.5; give a whole number"),
        (partial(CylinderSize, 63 * mm, 40 * mm, 1, "pistn"), "Side 'pistn' is unknown in works. Did you mean piston"),
        (partial(PUSH.thrust, np.nan), "Cylinder pressure = nan is not finite"),
        (partial(PUSH.thrust, [1e5, np.inf]), "Cylinder pressure = inf is not finite"),
        (partial(PUSH.pressure_for, np.nan), "Thrust = nan is not finite"),
        (partial(PUSH.sized_for, 1 * kN, 0.0), "Pressure = 0 is not above zero"),
        (partial(PUSH.sized_for, 1e9, 160 * bar), r"No standard bore of ISO 3320 gives 1000000 kN with 2 of"),
        (partial(next_bore, 500 * mm), "No standard bore of ISO 3320 is above 500 mm, the largest is 500 mm"),
        (partial(next_bore, -1.0), "Bore = -1 is not above zero"),
        (partial(next_rod, 360 * mm), "No standard rod of ISO 3320 is above 360 mm"),
        (partial(standard_rods, np.inf), "Bore = inf is not finite"),
    ],
)
def test_refusals(call, message):
    with pytest.raises(DefinitionError, match=message):
        call()


@pytest.mark.parametrize("works", ["piston", "rod", "both"])
def test_pressure_for_a_thrust_is_that_of_the_forces_on_the_piston(works):
    """By hand: what pushes less what pulls is the thrust, whichever side works and however many share it, against a back pressure."""
    size = CylinderSize(bore=80 * mm, rod=45 * mm, count=3, works=works)
    push, pull = 3 * np.pi / 4 * 0.080**2, 3 * np.pi / 4 * (0.080**2 - 0.045**2)
    for back in (0.0, 7 * bar):
        for force in (25e3, -25e3):
            pressure = size.pressure_for(force, back)
            working = {"piston": 1, "rod": -1, "both": 1 if force >= 0.0 else -1}[works]
            sides = (pressure, back) if working > 0 else (back, pressure)
            assert_allclose(sides[0] * push - sides[1] * pull, force, rtol=1e-13)
            if works != "both":
                assert_allclose(size.thrust(pressure, back), force, rtol=1e-13)
                assert size.sense == working


def test_standard_size_may_miss_by_a_rounded_digit():
    """Sizes out of a file or a sum of lengths: a tenth of a micrometre is no other rod."""
    for off, ok in ((0.0, True), (1e-10, True), (1e-6, False)):
        assert (Cylinder("A", "B", bore=80 * mm, rod=45 * mm + off).standard().ok is True) == ok


def test_a_thrust_asked_again_is_the_same_and_warns_again():
    class Arm(Mechanism):
        phi = Stroke(-1.0, 1.0)
        O, A = Ground(0.0, 0.0), Ground(-0.5, 0.0)
        B = Crank(O, OB=0.4, angle=phi)
        load = Weight(B, mass=100)
        ram = Cylinder(A, B, bore=50 * mm, rod=28 * mm)

    motion, found = Arm().at(phi=[2e-5, 0.5]), []
    for _ in range(2):
        with pytest.warns(SingularWarning, match="stands still against the drive"):
            thrust = Arm.ram.thrust(motion)
        found.append(thrust.tolist())
        thrust *= 2.0  # what was given is the asker's own
    assert found[0] == found[1]


def test_what_no_cylinder_of_one_stage_can_do_is_remarked_unless_its_lengths_are_given():
    rng = np.random.default_rng(7)
    for _ in range(6):
        closed, bore = rng.uniform(0.3, 0.9), rng.uniform(0.04, 0.12)
        for most, told in ((2.0 * closed - bore - 1e-3, 0), (2.0 * closed - bore + 1e-3, 1)):
            members = {"S": Stroke(closed, most), "O": Ground(0, 0), "rail": Guide((0.0, 0.0), angle=0.5), "P": OnGuide("rail", at="S")}
            ram = Cylinder("O", "P", bore=bore, rod=0.5 * bore)
            machine = type("Slide", (Mechanism,), members | {"ram": ram})()
            assert sum("of one stage" in each for each in machine.verdicts()) == told
            given = type("Given", (type(machine),), {"ram": ram.renewed(closed=closed)})()
            assert not any("of one stage" in each for each in given.verdicts())
