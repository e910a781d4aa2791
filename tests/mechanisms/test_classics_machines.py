"""Legs, the pantograph, the scissor lift and the front loader."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from mechanisms.classics.front_loader import FrontLoader
from mechanisms.classics.jansen import Jansen
from mechanisms.classics.klann import Klann
from mechanisms.classics.pantograph import Pantograph
from mechanisms.classics.scissor_lift import ScissorLift


def complex_of(place):
    return place[0] + 1j * place[1]


def meet(P, p, Q, q, left):
    """Return where the circles about P and Q meet, on the left or the right of P -> Q, by the cosine rule."""
    base = Q - P
    cos = (abs(base) ** 2 + p**2 - q**2) / (2 * abs(base) * p)
    return P + p * base / abs(base) * np.exp((1j if left else -1j) * np.arccos(cos))


# -- legs -----------------------------------------------------------------------------------------------------


def test_jansen_in_complex_numbers():
    """Jansen's letters in his units: j, b, k, c, d, e, f, g, h, i."""
    motion = Jansen().sweep(181)
    B, X = complex(-38.0, -7.8), 15.0 * np.exp(1j * motion.strokes["phi"])
    C = meet(X, 50.0, B, 41.5, left=False)
    E = meet(X, 61.9, B, 39.3, left=True)
    D = meet(C, 55.8, B, 40.1, left=False)
    G = meet(D, 39.4, E, 36.7, left=False)
    F = meet(G, 65.7, E, 49.0, left=False)
    assert_allclose(complex_of(motion["F"]), F / 100, rtol=0, atol=1e-13)


def test_jansens_foot_stands_flat():
    """Through a third of the turn and more the foot is on the ground, and its height changes by a fiftieth of the step."""
    motion = Jansen().sweep(721)
    x, y = motion["F"]
    assert_allclose(motion["F"][:, -1], motion["F"][:, 0], rtol=0, atol=1e-14)
    standing = y < y.min() + 0.02 * np.ptp(x)
    assert standing.mean() > 0.4
    assert np.ptp(x[standing]) > 0.6 * np.ptp(x)
    assert np.ptp(y) > 0.25 * np.ptp(x)


def test_klann_is_measured_from_the_patent():
    design = Klann()
    for label, printed in {"AB": 0.590, "MB": 0.321, "NH": 0.518}.items():
        assert design[label] == pytest.approx(printed, abs=5e-4)
    drawn = Klann().at(phi=np.pi)
    for point, place in {"B": (0.741, 0.750), "K": (0.232, 0.866), "H": (0.866, 1.500), "F": (0.0, 0.0)}.items():
        assert_allclose(drawn[point], place, rtol=0, atol=1e-12)


def test_klann_in_complex_numbers():
    O, M, N = complex(1.599, 0.750), complex(1.009, 0.574), complex(1.366, 1.366)
    B, K, H = complex(0.741, 0.750), complex(0.232, 0.866), complex(0.866, 1.500)
    A = O - 0.268
    AB, AK, KH, HF = B - A, K - A, H - K, -H
    motion = Klann().sweep(181)
    a = O + 0.268 * np.exp(1j * motion.strokes["phi"])
    b = meet(a, abs(AB), M, abs(B - M), left=((M - A).conjugate() * AB).imag > 0)
    k = a + (b - a) * AK / AB
    h = meet(k, abs(KH), N, abs(H - N), left=((N - K).conjugate() * KH).imag > 0)
    assert_allclose(complex_of(motion["F"]), h + (k - h) * HF / (K - H), rtol=0, atol=1e-12)


def test_klanns_foot_stands_during_half_a_turn():
    motion = Klann().sweep(721)
    x, y = motion["F"]
    assert_allclose(motion["F"][:, -1], motion["F"][:, 0], rtol=0, atol=1e-13)
    standing = Klann().at(phi=np.radians(np.linspace(0, 180, 181)))
    assert np.ptp(standing.x("F")) > 0.95 * np.ptp(x)
    assert np.ptp(standing.y("F")) < 0.06 * np.ptp(x)
    assert np.ptp(y) > 0.4


# -- pantograph -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("k", [1.5, 2.5, 4.0])
def test_pantograph_enlarges_exactly(k):
    motion = Pantograph(k=k).sweep(X=9, Y=7)
    assert motion["R"].shape == (2, 9, 7)
    assert_allclose(motion["R"], k * motion["Q"], rtol=0, atol=1e-14)
    assert_allclose(motion.ratio("R", wrt="X"), np.broadcast_to([[[k]], [[0.0]]], (2, 9, 7)), rtol=0, atol=1e-12)
    assert_allclose(motion.ratio("R", wrt="Y"), np.broadcast_to([[[0.0]], [[k]]], (2, 9, 7)), rtol=0, atol=1e-12)


def test_pantograph_draws_a_circle():
    turn = np.linspace(0.0, 2 * np.pi, 73)
    motion = Pantograph().at(X=0.2 + 0.08 * np.cos(turn), Y=0.08 * np.sin(turn))
    assert_allclose(np.hypot(motion.x("R") - 0.5, motion.y("R")), 0.2, rtol=1e-13)


# -- scissor lift ---------------------------------------------------------------------------------------------


def scissor(S):
    """Return the arm's angle from the cylinder's triangle by hand [rad], and its derivative by the stroke."""
    K, arm, length = complex(0.350, -0.050), 0.900, 0.575 + S
    gamma = np.arccos((arm**2 + abs(K) ** 2 - length**2) / (2 * arm * abs(K)))
    return np.angle(K) + gamma, length / (arm * abs(K) * np.sin(gamma))


def test_scissor_lift_is_its_formulas():
    motion = ScissorLift().sweep(101)
    alpha, slope = scissor(motion.strokes["S"])
    assert_allclose(motion["h"], 2 * 1.6 * np.sin(alpha), rtol=1e-12)
    assert_allclose(motion.ratio("h"), 2 * 1.6 * np.cos(alpha) * slope, rtol=1e-11)
    assert_allclose(motion.x("A"), 1.6 * np.cos(alpha), rtol=1e-12)


def test_platform_stays_level():
    motion = ScissorLift().sweep(101)
    assert_allclose(motion["level"], 0.0, atol=1e-12)
    assert_allclose(motion.ratio("level"), 0.0, atol=1e-11)
    assert_allclose(motion.x("D"), 0.0, atol=1e-12)
    assert np.ptp(motion["h"]) > 2.0


def test_the_lower_the_lift_the_greater_the_force():
    ratio = ScissorLift().sweep(101).ratio("h")
    assert (np.diff(ratio) < 0.0).all()


def test_the_lifts_cylinder_carries_table_and_load_by_the_height_it_raises_them():
    """2 (280 kg) g dh/dS of the closed formulas, which the pump holds all the way; pin and roller carry half each."""
    motion = ScissorLift().sweep(101)
    alpha, slope = scissor(motion.strokes["S"])
    thrust = 2 * 280.0 * 9.80665 * 2 * 1.6 * np.cos(alpha) * slope
    assert_allclose(ScissorLift.ram.thrust(motion), thrust, rtol=1e-10)
    least = next(each for each in ScissorLift().verdicts() if "lifting" in each)
    assert f"{160e5 * np.pi / 4 * 0.100**2 / thrust[0]:.3f}" in least
    assert [verdict for verdict in ScissorLift().verdicts() if verdict.startswith("FAIL")] == []


# -- front loader ---------------------------------------------------------------------------------------------


def loader(lift, tilt):
    """Return the directions of boom OL and of lever OT [rad], from the cylinders' triangles by hand."""
    O, K, M = 1.6j, complex(0.200, 0.700), complex(-0.750, 1.400)
    L = meet(K, 1.000 + lift, O, 1.200, left=False)
    T = meet(M, 0.700 + tilt, O, 0.350, left=True)
    return np.angle(L - O), np.angle(T - O)


def test_bucket_keeps_its_angle_while_lifted():
    motion = FrontLoader().sweep(lift=21, tilt=9)
    attitude = motion["attitude"]
    assert attitude.shape == (21, 9)
    assert_allclose(attitude, np.broadcast_to(attitude[:1], attitude.shape), rtol=0, atol=1e-12)
    assert_allclose(motion.ratio("attitude", wrt="lift"), 0.0, atol=1e-11)
    assert np.ptp(motion["boom"]) > np.radians(40) and np.ptp(motion.y("B")) > 1.5


def test_bucket_turns_with_the_lever():
    motion = FrontLoader().sweep(lift=5, tilt=21)
    boom, lever = loader(motion.strokes["lift"], motion.strokes["tilt"])
    assert_allclose(np.diff(motion["attitude"], axis=1), np.diff(np.unwrap(lever, axis=1), axis=1), rtol=0, atol=1e-12)
    assert_allclose(np.diff(motion["boom"], axis=0), np.diff(boom, axis=0), rtol=0, atol=1e-12)
    assert np.ptp(motion["attitude"][0]) > np.radians(60)


def test_parallelograms_are_parallelograms():
    motion = FrontLoader().sweep(lift=7, tilt=7)
    assert_allclose(motion["F"] - motion["E"], motion["H"] - motion["O"], rtol=0, atol=1e-12)
    assert_allclose(motion["J"] - motion["G"], motion["B"] - motion["H"], rtol=0, atol=1e-12)


def test_loader_is_found_by_pattern():
    steps = {name: type(FrontLoader.plan.members[name]).__name__ for name in "FGJN"}
    assert steps == {"F": "Dyad", "G": "OnLink", "J": "Dyad", "N": "OnLink"}
