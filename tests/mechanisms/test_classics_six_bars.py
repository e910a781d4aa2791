"""The five six-bars: Watt's and Stephenson's chains, driven from either end, as dyads and as groups."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from mechanisms.classics.stephenson_one import StephensonOne
from mechanisms.classics.stephenson_three import StephensonThree, StephensonThreeFar
from mechanisms.classics.stephenson_two import StephensonTwo, StephensonTwoFar
from mechanisms.classics.watt_one import WattOne
from mechanisms.classics.watt_two import WattTwo
from tests.for_all import for_all

ALL = [WattOne, WattTwo, StephensonOne, StephensonTwo, StephensonTwoFar, StephensonThree, StephensonThreeFar]


def complex_of(place):
    return place[0] + 1j * place[1]


def meet(P, p, Q, q, left):
    """Return where the circles about P and Q meet, on the left or the right of P -> Q, by the cosine rule."""
    base = Q - P
    cos = (abs(base) ** 2 + p**2 - q**2) / (2 * abs(base) * p)
    return P + p * base / abs(base) * np.exp((1j if left else -1j) * np.arccos(cos))


@for_all("machine", ALL)
def test_one_degree_of_freedom(machine):
    assert machine().gruebler == 1
    assert len(machine().links) == 6


@for_all("machine", ALL)
def test_exact_ratio_is_the_central_difference(machine):
    stroke = next(iter(machine.plan.strokes.values()))
    values = np.linspace(stroke.start, stroke.end, 7)[1:-1]
    motion = machine().at(**{stroke.name: values})
    for point in machine.plan.moving:
        for order, tolerance in ((1, 1e-8), (2, 1e-6)):
            exact, central = motion.ratio(point, order=order), motion.ratio(point, order=order, method="central")
            assert_allclose(exact, central, rtol=tolerance, atol=tolerance * np.abs(exact).max())


@pytest.mark.parametrize(
    ("machine", "pins", "members"),
    [(StephensonTwo, "B F G", 6), (StephensonThreeFar, "A B D", 6), (StephensonTwoFar, "A D B F", 8)],
)
def test_what_no_dyads_place_is_one_group(machine, pins, members):
    (group,) = machine.plan.groups.values()
    assert set(group.pins) == set(pins.split())
    assert 2 * len(group.pins) == members


# -- Watt -----------------------------------------------------------------------------------------------------


def test_watt_two_is_two_four_bars_in_series():
    motion = WattTwo().sweep(181)
    A = 0.050 * np.exp(1j * motion.strokes["phi"])
    B = meet(A, 0.180, 0.200, 0.110, left=True)
    D = 0.200 + 0.120 * np.exp(1j * (np.angle(B - 0.200) - np.radians(30)))
    F = meet(D, 0.180, 0.400, 0.100, left=True)
    assert_allclose(complex_of(motion["F"]), F, rtol=0, atol=1e-13)


def test_watt_twos_ratio_is_a_product():
    motion = WattTwo().sweep(181)
    angles = {name: motion.angle(*name) for name in ("OA", "AB", "CB", "CD", "DF", "EF")}
    first = 0.050 * np.sin(angles["AB"] - angles["OA"]) / (0.110 * np.sin(angles["AB"] - angles["CB"]))
    second = 0.120 * np.sin(angles["DF"] - angles["CD"]) / (0.100 * np.sin(angles["DF"] - angles["EF"]))
    assert_allclose(motion.ratio("middle"), first, rtol=1e-10, atol=1e-13)
    assert_allclose(motion.ratio("psi"), first * second, rtol=1e-10, atol=1e-13)
    assert np.ptp(motion["psi"]) > 1.15 * np.ptp(motion["middle"])


# -- Stephenson -----------------------------------------------------------------------------------------------


def test_stephenson_one_in_complex_numbers():
    motion = StephensonOne().sweep(181)
    A = 0.040 * np.exp(1j * motion.strokes["phi"])
    B = meet(A, 0.120, 0.100, 0.080, left=True)
    E = meet(0.100 + 0j, 0.060, B, 0.050, left=False)
    F = meet(1j * A / 0.040 * 0.030, 0.140, E, 0.090, left=False)
    assert_allclose(complex_of(motion["F"]), F, rtol=0, atol=1e-13)
    assert_allclose(motion["F"][:, -1], motion["F"][:, 0], rtol=0, atol=1e-14)


def test_stephenson_two_closes_in_complex_numbers():
    """All links as vectors: A + AB = B, D + DF = F, E + EG = G, with BFG one triangle, on its side of BF."""
    motion = StephensonTwo().sweep(91)
    A = 0.050 * np.exp(1j * motion.strokes["phi"])
    D = A / 0.050 * 0.040 * np.exp(1j * np.radians(70))
    B, F, G = (complex_of(motion[name]) for name in "BFG")
    for length, vector in ((0.100, B - A), (0.120, F - D), (0.110, G - 0.200)):
        assert_allclose(abs(vector), length, rtol=1e-12)
    cos = (0.060**2 + 0.100**2 - 0.130**2) / (2 * 0.060 * 0.100)
    assert_allclose((G - B) / (F - B), 0.100 / 0.060 * np.exp(-1j * np.arccos(cos)), rtol=1e-12)


def test_stephenson_two_from_both_ends():
    """The class III group driven by the crank and the class IV group driven by the rocker are one linkage."""
    near = StephensonTwo().at(phi=np.radians(np.linspace(50, 150, 41)))
    far = StephensonTwoFar().at(psi=near["psi"])
    assert_allclose(far["phi"], near.strokes["phi"], rtol=1e-10)
    for point in "ADBFG":
        assert_allclose(far[point], near[point], rtol=0, atol=1e-11)
    assert_allclose(far.ratio("phi") * near.ratio("psi"), 1.0, rtol=1e-9)


def test_stephenson_three_in_complex_numbers():
    motion = StephensonThree().sweep(181)
    A = 0.050 * np.exp(1j * motion.strokes["phi"])
    B = meet(A, 0.200, 0.110, 0.152, left=True)
    D = A + (B - A) / 0.200 * 0.090 * np.exp(1j * np.radians(121.3))
    F = meet(D, 0.1006, complex(-0.038, -0.150), 0.160, left=StephensonThree.plan.members["F"].side > 0)
    assert_allclose(complex_of(motion["F"]), F, rtol=0, atol=1e-13)
    at_rest = np.argmin(abs(motion.strokes["phi"] - np.pi))
    assert abs(F[at_rest] - complex(-0.038, 0.010)) < 1e-3


def test_stephenson_three_dwells():
    dwell = StephensonThree().at(phi=np.radians(np.linspace(120, 240, 241)))
    turn = StephensonThree().sweep(721)
    assert np.ptp(turn["psi"]) > np.radians(36)
    assert np.ptp(dwell["psi"]) < np.ptp(turn["psi"]) / 70


def test_stephenson_three_from_its_far_end():
    """Driven at EF the pins A, B and D are a class III group; driven at OA all are dyads. One linkage."""
    near = StephensonThree().at(phi=np.radians(np.linspace(25, 75, 41)))
    far = StephensonThreeFar().at(psi=near["psi"])
    assert_allclose(far["phi"], near.strokes["phi"], rtol=1e-10)
    for point in "ABDF":
        assert_allclose(far[point], near[point], rtol=0, atol=1e-11)
    assert_allclose(far.ratio("phi"), 1.0 / near.ratio("psi"), rtol=1e-9)
    first, second = near.ratio("psi"), near.ratio("psi", order=2)
    assert_allclose(far.ratio("phi", order=2), -second / first**3, rtol=1e-8)
