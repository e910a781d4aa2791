"""Boom and arm drive of a forestry crane against the reconstructed source: its formulas, its examples, its optima."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.optimize import minimize

from linkage import deg, ratio
from linkage.motion import lowest
from mechanisms.crane.arm_drive import ArmDrive
from mechanisms.crane.boom_drive import BoomDrive
from mechanisms.crane.drive_report import OPENING

# Source: Syunyov et al., (2.19) to (2.66), as reconstructed; numbers of its examples 2, 3a and 3b, computed independently.

K_A, K_A1, K_B = 71905.17119002105, 39947.317327789475, 85260.01232735414
PHI_0, PHI_K = 15.0 * deg, 99.9262455066517 * deg
BOOMS = {  # example 2: rod, S, r_1 .. r_4, surplus (2.33), most M_g / M_l, h at phi_0, 90 deg, phi_k
    125: (70, 0.8850545905614509, 0.2618294, 1.6706883884436237, 0.5925163333637224, 0.31633579788198307, 23429.523301843783,
          1.1460746853955897, (0.41247373341726307, 0.6506409027399889, 0.6036008101330094)),
    140: (80, 0.8037405078703522, 0.2768294, 1.6298875560931196, 0.49700267292449635, 0.3313357978819831, 55017.15508730882,
          1.4164286711117156, (0.4137150677910758, 0.5453975811715456, 0.48118687032287066)),
}  # fmt: skip
ARMS = {  # example 3a: rod, r_1 .. r_5, S, alpha_20, volume, area, psi of tangency
    125: (70, 0.6927875564208, 0.6260722919074565, 0.24747421702558486, 0.15746382785087581, 2.046244512975232, 1.1422391570783725,
          -65.41746333417115, 11146377.376692418e-9, 26886.889042529452, 85.02022079969181),
    140: (80, 0.5634824610356947, 0.5056991910045654, 0.20803265972531704, 0.13215746111972135, 1.7535661783335663, 0.926744269401061,
          -66.73074343448614, 10823153.847283429e-9, 26721.89572263079, 84.73693294510497),
}  # fmt: skip


def boom_of(bore):
    rod, S, r_1, r_2, r_3, r_4, *_ = BOOMS[bore]
    return BoomDrive(D=bore / 1e3, d=rod / 1e3, S=S, r_1=r_1, r_2=r_2, r_3=r_3, r_4=r_4)


def arm_of(bore):
    rod, *r, S, alpha_20, _, _, _ = ARMS[bore]
    return ArmDrive(D=bore / 1e3, d=rod / 1e3, S=S, alpha_20=alpha_20 * deg, **{f"r_{i}": each for i, each in enumerate(r, 1)})


# -- the boom: geometry and moments ---------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("phi", "length", "lever"),
    [
        (15.0, 1.9111021380388928, 0.40289490672001926),
        (60.0, 1.465452676738976, 0.7140677409507485),
        (90.0, 1.0547511554864493, 0.8390604697577597),
        (110.0, 0.7580690014987745, 0.8443778704413747),
    ],
)
def test_length_and_lever_of_the_boom(phi, length, lever):
    motion = BoomDrive(r_1=0.25, r_2=1.2, r_3=0.8, r_4=0.3).at(phi=phi * deg)
    assert_allclose(motion["length"], length, rtol=1e-14)
    assert_allclose(-motion.ratio("length"), lever, rtol=1e-13)


def test_boom_by_the_closed_formulas():
    """(2.30) for many random drives at once."""
    rng = np.random.default_rng(2)
    r = {f"r_{i}": rng.uniform(*ends, 200) for i, ends in enumerate([(0.1, 0.4), (0.6, 1.8), (0.3, 1.5), (0.1, 0.5)], 1)}
    motion = BoomDrive(**r).at(phi=np.linspace(0.1, 2.0, 9))
    r_1, r_2, r_3, r_4 = (each[:, None] for each in r.values())
    phi = np.linspace(0.1, 2.0, 9)
    X, Y = r_3 * np.sin(phi) + r_4 * np.cos(phi), r_3 * np.cos(phi) - r_4 * np.sin(phi)
    length = np.hypot(X - r_1, Y + r_2)
    assert_allclose(motion["B"], np.stack([X, Y]), atol=1e-14)
    assert_allclose(motion["length"], length, rtol=1e-13)
    assert_allclose(-motion.ratio("length"), (r_1 * Y + r_2 * X) / length, rtol=1e-10, atol=1e-12)


# -- the reference optima: multipliers, and a search of its own ------------------------------------------------

ARM_NAMES = ["r_1", "r_2", "r_3", "r_4", "r_5", "S", "alpha_20"]


def arm_forces(bore):
    """Return what the piston side and the rod side give with the efficiency [N]."""
    rod = ARMS[bore][0]
    return np.pi / 4 * bore**2 * 1e-6 * 22e6 * 0.95, np.pi / 4 * (bore**2 - rod**2) * 1e-6 * 22e6 * 0.95


def arm_slack(machine, bore, psi):
    """Return all constraints of 3a at poses psi, equalities first, then those not below zero, each with its gradients as rows.

    Two lengths at the ends; M_g2 over M_l2 and M_g1 over M_l1, over K_A; above the cylinder, no fold-over, room on the boom.
    """
    push, pull = arm_forces(bore)
    motion, ends = machine.at(psi=psi), machine.at(psi=np.array([0.0, np.pi]))
    lever, d_lever = -motion.ratio("length"), -motion.gradient(ratio("length"), wrt=ARM_NAMES)
    is_S = np.array([name == "S" for name in ARM_NAMES], float)[:, None]
    equal = ends["length"] - machine.at(psi=0.0)["l"] - np.array([float(machine["S"]), 0.0])
    d_equal = ends.gradient("length", wrt=ARM_NAMES) - is_S * np.array([2.0, 1.0])
    moments = [(pull * lever - motion["M_l2"]) / K_A, (push * lever + motion["M_l1"]) / K_A]
    d_moments = [pull * d_lever / K_A, push * d_lever / K_A]
    r_1, r_2, r_3, r_4, r_5 = (float(machine[f"r_{i}"]) for i in range(1, 6))
    lug = float(machine["alpha_20"])
    others = [*(ends.y("L") - 0.15), ends.x("L")[0] + (r_2 - r_3) * np.cos(lug) - r_4, r_1 + r_3 - r_4 - r_2, 4.4546 - r_4 - r_5]
    d_L = ends.gradient("L", wrt=ARM_NAMES)
    fold = d_L[:, 0, 0] + np.array([0.0, np.cos(lug), -np.cos(lug), -1.0, 0.0, 0.0, -(r_2 - r_3) * np.sin(lug)])
    d_others = [d_L[:, 1, 0], d_L[:, 1, 1], fold, np.array([1.0, -1.0, 1.0, -1.0, 0.0, 0.0, 0.0]), np.array([0, 0, 0, -1.0, -1.0, 0, 0])]
    return equal, d_equal.T, np.concatenate([*moments, others]), np.vstack([np.hstack(d_moments).T, d_others])


@pytest.mark.parametrize("bore", ARMS)
def test_multipliers_of_the_arm(bore):
    """The gradient of the volume is made of those of the four conditions that bind, with multipliers above zero."""
    machine, tangency = arm_of(bore), ARMS[bore][10] * deg
    volume = machine.at(psi=0.0)
    assert_allclose(volume["steel"], ARMS[bore][8], rtol=1e-14)
    _, d_equal, slack, d_slack = arm_slack(machine, bore, np.array([0.0, tangency, np.pi]))
    binding = [1, 2, 3]  # M_g2 where it touches and at the end, M_g1 at the start
    assert_allclose(slack[binding], 0.0, atol=1e-12)
    assert np.all(np.delete(slack, binding) > 0.01)
    normals = np.vstack([d_equal, d_slack[binding]])
    target = volume.gradient("steel", wrt=ARM_NAMES) / ARMS[bore][8]
    found = np.linalg.lstsq(normals.T, target, rcond=None)[0]
    assert_allclose(normals.T @ found, target, atol=1e-7)
    assert np.all(found[2:] > 0.05)


def lightest(start, bore, psi):
    """Return the lightest arm drive near a start that keeps the conditions at poses psi: SLSQP on the machine's values and gradients."""

    def at(x):
        return start.replaced(**dict(zip(ARM_NAMES, x, strict=True)))

    def slack(part):
        return lambda x: arm_slack(at(x), bore, psi)[part]

    result = minimize(
        lambda x: float(at(x).at(psi=0.0)["steel"]) * 100,
        [float(start[name]) for name in ARM_NAMES],
        jac=lambda x: at(x).at(psi=0.0).gradient("steel", wrt=ARM_NAMES) * 100,
        method="SLSQP",
        bounds=[(0.15, 0.8), (0.15, 1.2), (0.12, 0.6), (0.1, 0.8), (0.5, 4.0), (0.3, bore / 100), (-np.pi, np.pi)],
        constraints=[{"type": "eq", "fun": slack(0), "jac": slack(1)}, {"type": "ineq", "fun": slack(2), "jac": slack(3)}],
        options={"maxiter": 100, "ftol": 1e-13},
    )
    return at(result.x)


def searched(machine, bore, rounds=7):
    """Return the lightest arm drive near a start, and the least of M_g2 - M_l2 [N m].

    The poses looked at grow by the one at which the last answer falls short most.
    """
    psi, low = np.linspace(0.0, np.pi, 19), None
    for _ in range(rounds):
        machine = lightest(machine, bore, psi)
        low = lowest(machine.sweep(61), OPENING.surplus)
        psi = np.append(psi, float(low.strokes["psi"]))
    return machine, float(low.value)


@pytest.mark.parametrize("bore", ARMS)
def test_a_search_through_the_machine_finds_the_reference(bore):
    shares = [1.05, 1.04, 0.97, 1.03, 0.96, 1.02, 1.01]
    away = arm_of(bore).replaced(**{name: share * float(arm_of(bore)[name]) for name, share in zip(ARM_NAMES, shares, strict=True)})
    found, short = searched(away, bore)
    assert short > -1e-3
    assert_allclose(found.at(psi=0.0)["steel"], ARMS[bore][8], rtol=1e-8)
    for name in ARM_NAMES:
        assert_allclose(found[name], arm_of(bore)[name], rtol=1e-5)
