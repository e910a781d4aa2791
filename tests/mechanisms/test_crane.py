"""The crane's skeleton: the source's example in both readings, masses, positions, the back-broken variant, and what a duty refuses."""

from functools import cache

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.optimize import minimize

from linkage import DefinitionError
from linkage.units import deg, kN, mm
from mechanisms.crane import BackBrokenSkeleton, CraneSkeleton, Duty
from tests.for_all import for_all

# Numbers of the source's example 1 (10 m, 100 kN m), worked out independently: multistart SLSQP = the vertices solved exactly.
AT_MOST = {  # (2.13) read as <= c
    "l_c": 4.454601406907623, "l_p": 3.165204914008807, "l_t": 2.532163931207046, "h_0": 1.85, "phi_0": 15 * deg,
}  # fmt: skip
AT_LEAST = {  # (2.13) read as >= c
    "l_c": 4.542413835813202, "l_p": 3.116420231283486, "l_t": 2.493136185026789, "h_0": 1.85, "phi_0": 20.526019274994923 * deg,
}  # fmt: skip
FOUND = {
    "<=": (AT_MOST, 3.694124881450423, (273.6588, 382.6715957639661, 301.8421, 208.4440773746961),
           (1971.4951718848563, 202.64064307718067, 682.3080350483496, 382.4080741557592, 211.26462663235276)),
    ">=": (AT_LEAST, 3.755721473767066, (273.6588, 393.7792533335193, 301.8421, 208.60374222598432),
           (1974.8449866993078, 199.6558522288168, 705.4080754003634, 370.9682375173292, 205.10157487797144)),
}  # fmt: skip
KEPT = [*CraneSkeleton.margins]

# Cranes from 23.5 to 185 kN m: L [mm], M [kN m], l_c, l_t, h_0 [mm]; b_0, b_c, b_p, b_t [mm] and W [kg].
FAMILY = [
    (5000, 23.5, 2400, 1000, 1200, (189.8803, 87.288648, 136.48372, 118.79595826972, 675.339435)),
    (6500, 40, 2900, 1400, 1500, (228.5473, 159.276455, 181.30585, 143.15865559835, 1024.547796)),
    (7200, 60, 3200, 1500, 1700, (254.3253, 204.937888, 211.34846, 160.17579557146, 1287.412425)),
    (8500, 80, 3600, 1800, 1800, (267.2143, 264.795055, 254.42325, 183.93405258575, 1632.405924)),
    (10000, 100, 4000, 2400, 1900, (280.1033, 325.1677, 301.8421, 208.9847679471, 1982.628776)),
    (10000, 150, 4100, 2500, 2100, (305.8813, 352.5904, 338.9381, 230.0932338431, 2369.390125)),
    (11000, 185, 4300, 2800, 2200, (318.7703, 390.80777, 386.6256, 256.5270979056, 2775.632434)),
]


@for_all("row", FAMILY, ids=lambda row: f"{row[1]} kN m")
def test_heights_and_mass_are_those_of_the_regressions(row):
    L, M, l_c, l_t, h_0, (*heights, W) = row
    crane = CraneSkeleton(L=L * mm, M=M * kN, l_c=l_c * mm, l_t=l_t * mm, h_0=h_0 * mm)
    found = crane.outputs("b_0", "b_c", "b_p", "b_t", "W")
    assert_allclose([found[name] / mm for name in ("b_0", "b_c", "b_p", "b_t")], heights, rtol=1e-12)
    assert_allclose(found["W"], W, rtol=1e-12)


@pytest.mark.parametrize("reading", FOUND)
def test_masses_of_the_example(reading):
    design, W_m, heights, masses = FOUND[reading]
    crane = CraneSkeleton(**design)
    assert_allclose(crane.output("W_m"), W_m, rtol=1e-12)
    assert_allclose([crane.output(name) / mm for name in ("b_0", "b_c", "b_p", "b_t")], heights, rtol=1e-12)
    parts = [crane.output(name) for name in ("W", "W_0", "W_c", "W_p", "W_t")]
    assert_allclose(parts, masses, rtol=1e-12)
    assert sum(parts[1:]) == pytest.approx(0.75 * parts[0], rel=1e-12)
    assert crane.output("phi_k") / deg == pytest.approx(99.9262455066517, rel=1e-12)


def minimum(machine, vary, equal, kept, starts=12, fixed=None):
    """Return W_m and the variables of the best of several SLSQP runs, all designs of a gradient in one call."""
    low, high = np.array([*vary.values()]).T
    names, fixed = [*equal, *kept], fixed or {}
    asked = ["W_m", *names]

    @cache
    def rows_at(*x):
        steps = np.vstack([x, x + 1e-6 * np.eye(len(x)), x - 1e-6 * np.eye(len(x))])
        there = machine().replaced(**dict(zip(vary, steps.T, strict=True)), **fixed).outputs(*asked)
        rows = np.array([np.broadcast_to(there[name], len(steps)) for name in asked])
        n = len(x)
        return rows[:, 0], (rows[:, 1 : n + 1] - rows[:, n + 1 :]) / 2e-6

    def table(x):
        return rows_at(*map(float, x))

    e = len(equal)
    rules = [
        {"type": "eq", "fun": lambda x: table(x)[0][1 : e + 1], "jac": lambda x: table(x)[1][1 : e + 1]},
        {"type": "ineq", "fun": lambda x: table(x)[0][e + 1 :], "jac": lambda x: table(x)[1][e + 1 :]},
    ]
    rng, best = np.random.default_rng(1), (np.inf, None)
    for _ in range(starts):
        start = low + rng.random(len(low)) * (high - low)
        found = minimize(
            lambda x: table(x)[0][0], start, jac=lambda x: table(x)[1][0], bounds=list(zip(low, high, strict=True)),
            constraints=rules, method="SLSQP", options={"ftol": 1e-14, "maxiter": 200},
        )  # fmt: skip
        values = table(found.x)[0]
        if found.fun < best[0] and np.abs(values[1 : e + 1]).max() < 1e-8 and values[e + 1 :].min() > -1e-8:
            best = found.fun, dict(zip(vary, found.x, strict=True))
    return best


VARY = {"l_c": (2.0, 6.0), "l_p": (1.9, 5.0), "l_t": (0.8, 4.0), "h_0": (1.0, 2.9), "phi_0": (15 * deg, 30 * deg)}


@pytest.mark.parametrize("reading", FOUND)
def test_skeleton_of_least_mass(reading):
    design, W_m, *_ = FOUND[reading]
    value, x = minimum(CraneSkeleton, VARY, [*CraneSkeleton.errors], [*CraneSkeleton.conditions(reading), "boom_turns"], 4)
    assert value == pytest.approx(W_m, rel=1e-6)
    assert_allclose([x[name] for name in design], [*design.values()], rtol=1e-4)


def test_default_skeleton_is_the_best_of_the_default_reading():
    crane = CraneSkeleton()
    for name, value in AT_LEAST.items():
        assert crane[name] == pytest.approx(value, rel=1e-10)
    kept = crane.outputs(*KEPT, "past_guard", "reach_error")
    assert min(kept[name] for name in (*KEPT, "past_guard")) > -1e-9
    assert abs(kept["reach_error"]) < 1e-9


def test_margins_are_what_the_machine_does_in_its_positions():
    """The closed formulas of the margins against the poses of the machine itself."""
    rng = np.random.default_rng(3)
    for _ in range(20):
        crane = CraneSkeleton(
            l_c=rng.uniform(3, 5), l_p=rng.uniform(2, 3), l_t=rng.uniform(1, 2), h_0=rng.uniform(1.2, 2.2),
            phi_0=rng.uniform(15, 30) * deg, psi_0=rng.uniform(0, 10) * deg,
        )  # fmt: skip
        at = crane.outputs("reach_error", "over_stakes", "past_guard", "above_cab", "phi_k")
        over, guard, still = crane.position(2), crane.position(3), crane.position(4)
        assert over.y("T") - crane["H_w"] - crane["h_s"] == pytest.approx(at["over_stakes"], abs=1e-12)
        assert guard.x("T") - crane["c"] == pytest.approx(at["past_guard"], abs=1e-12)
        assert still.y("J") - crane["H_k"] == pytest.approx(at["above_cab"], abs=1e-12)
        way = crane.position(1)["T"] - np.array([crane["L"], crane["H_w"]])
        assert np.hypot(*way) == pytest.approx(abs(at["reach_error"]), abs=1e-12)


# Poses worked out by hand's formulas: l_c, arm, phi, psi [deg], height of O; joint and tip.
POSES = [
    (4.0, 5.5, 20, 0, 3.0, (1.3680805733026749, 6.758770483143634), (-0.5130302149885031, 1.5904610688211376)),
    (4.0, 5.5, 20, 20, 3.0, (1.3680805733026749, 6.758770483143634), (1.368080573302675, 1.2587704831436337)),
    (4.0, 5.5, 60, 150, 3.0, (3.4641016151377544, 5.0), (8.964101615137753, 5.0)),
    (4.0, 5.5, 100, 180, 3.0, (3.939231012048832, 2.305407289332279), (9.355673653615977, 1.3503423121641616)),
]


@pytest.mark.parametrize("row", POSES)
def test_poses(row):
    l_c, arm, phi, psi, z, joint, tip = row
    motion = CraneSkeleton(l_c=l_c, l_p=arm - 2.0, h_0=z - 1.1).at(phi=phi * deg, psi=psi * deg, t=2.0)
    assert_allclose(motion["J"], joint, atol=1e-12)
    assert_allclose(motion["T"], tip, atol=1e-12)


def test_it_turns_three_ways():
    assert CraneSkeleton().mobility == CraneSkeleton().gruebler == 3


# The back-broken variant.


def test_transport_pose_of_the_back_broken_crane():
    """A design by hand's formulas: Delta, H_w and the cab's distance that l_c, l_p, phi_k and psi_k need."""
    crane = BackBrokenSkeleton(
        l_c=3.5, l_p=2.6, h_0=1.9, phi_k=112 * deg, psi_k=215 * deg,
        Delta=0.5888769230443076, H_w=1.1737496643383567, A_k=5.778505659425368,
    )  # fmt: skip
    assert_allclose([*crane.outputs("joint_error", "tool_error", "before_cab").values()], 0.0, atol=1e-12)
    there = crane.at(phi=112 * deg, psi=215 * deg, t=0.0)
    assert_allclose(there["T"], (crane["A_k"], crane["H_p"] + crane["H_w"]), atol=1e-12)
    assert there.y("J") == pytest.approx(crane["H_p"] + crane["Delta"], abs=1e-12)


BACK = {**VARY, "phi_k": (91 * deg, 180 * deg), "psi_k": (180 * deg, 270 * deg), "Delta": (0.0, 2.0)}
BROKEN = [*BackBrokenSkeleton.errors]


def brute_force(A_k):
    """Return the least W_m over random h_0, l_p and l_t / l_p, drawn ever closer to the best; phi_0 is the least that passes the guard.

    Delta goes by a grid of its own: phi_k and psi_k follow from it in closed form.
    """
    base = BackBrokenSkeleton()
    L, M, H_p, H_w, H_k, H_max, h_s, c = (float(base[name]) for name in ("L", "M", "H_p", "H_w", "H_k", "H_max", "h_s", "c"))
    span = np.array([[H_k - H_p, H_max - H_p], [1.9, 5.0], [0.3, 0.8]])
    box, best, Delta, rng = span, np.inf, np.linspace(0.0, 2.0, 401), np.random.default_rng(0)
    b_p = 0.0104471 + 0.0217203 * L + 0.74192e-6 * M
    for _ in range(120):
        h_0, l_p, share = rng.uniform(box[:, 0], box[:, 1], (20_000, 3)).T
        l_t = share * l_p
        l_c = np.hypot(L, H_p + h_0 - H_w) - l_p - l_t
        with np.errstate(invalid="ignore", divide="ignore"):
            phi_0 = np.maximum(np.arcsin(np.where(l_c > l_p, c / (l_c - l_p), np.nan)), 15 * deg)
        ok = (l_p >= h_0) & (phi_0 <= 30 * deg) & (H_p + h_0 >= h_s) & (H_p + h_0 + l_c * np.cos(phi_0) - l_p - H_w >= h_s)
        h_0, l_p, l_t, l_c = (each[ok] for each in (h_0, l_p, l_t, l_c))
        b_c = -0.236125 + 0.00257739 * L + 0.126493 * l_c + 0.295468e-6 * M
        W_m = (0.0352123 + 0.12889 * h_0) * h_0 + b_c * l_c + b_p * l_p + (0.0437195 - 0.00409106 * l_t + 0.580051 * b_p) * l_t
        for k in np.argsort(W_m):
            with np.errstate(invalid="ignore"):
                phi_k = np.arccos((Delta - h_0[k]) / l_c[k])
                psi_k = phi_k + np.arccos((Delta - H_w) / l_p[k])
            tip = l_c[k] * np.sin(phi_k) - l_p[k] * np.sin(phi_k - psi_k)
            if ((psi_k >= np.pi) & (psi_k <= 1.5 * np.pi) & (tip <= A_k)).any():
                if W_m[k] < best:
                    best, centre = W_m[k], np.array([h_0[k], l_p[k], l_t[k] / l_p[k]])
                half = 0.47 * (box[:, 1] - box[:, 0])
                box = np.clip(np.column_stack([centre - half, centre + half]), span[:, :1], span[:, 1:])
                break
    return best


@pytest.mark.slow
@pytest.mark.parametrize("A_k", [6.9, 6.5])
def test_back_broken_skeleton_of_least_mass(A_k):
    value, x = minimum(BackBrokenSkeleton, BACK, BROKEN, [*BackBrokenSkeleton.conditions(">=")], 2, {"A_k": A_k})
    assert x is not None
    assert value * (1.0 - 1e-9) <= brute_force(A_k) <= value * (1.0 + 1e-4)


@pytest.mark.slow
def test_default_back_broken_skeleton_is_the_best_of_its_cab():
    crane = BackBrokenSkeleton()
    kept = [*BackBrokenSkeleton.conditions(">=")]
    value, _ = minimum(BackBrokenSkeleton, BACK, BROKEN, kept, 5, {"A_k": float(crane["A_k"])})
    assert crane.output("W_m") == pytest.approx(value, rel=1e-9)
    assert min(crane.outputs(*kept).values()) > -1e-9
    assert_allclose([*crane.outputs(*BROKEN).values()], 0.0, atol=1e-9)


# What a duty refuses, in words.


@for_all(
    ("given", "words"),
    [
        ({"M": 20 * kN}, "M = 20 kN m lies outside the 23.5 to 185 kN m"),
        ({"M": 190 * kN}, "M = 190 kN m lies outside"),
        ({"M": 100.0}, "M = 0.1 kN m lies outside"),
        ({"payload": 22000.0}, "The stacked load alone, h_s = 4377 mm (2.12), is higher than the legal height, 4000 mm"),
        ({"k_d": 0.45}, "k_d = 0.45"),
        ({"k_d": 0.81}, "k_d = 0.81"),
        ({"H_k": 4.1}, "The cab, H_k = 4100 mm, is higher than the legal height"),
        ({"L": 10000}, "L = 10000 m; no crane is so large, write 10000 * mm"),
        ({"psi_0": 10}, "psi_0 = 573 deg"),
        ({"payload": -1.0}, "payload = -1 is below zero"),
        ({"rho_w": 0.0}, "rho_w = 0 is not above zero"),
        ({"c": float("nan")}, "c = nan is not finite"),
        ({"A": "4.5"}, "A = '4.5'"),
    ],
)
def test_bad_duty_is_refused_in_words(given, words):
    with pytest.raises(DefinitionError) as refused:
        Duty(**given)
    assert words in str(refused.value)


def test_stakes_and_load_of_the_example():
    duty = Duty()
    assert duty.h_s / mm == pytest.approx(2887.609630746885, rel=1e-12)
    assert pytest.approx(10 * kN) == duty.Q
    assert CraneSkeleton(**duty.dimensions()).output("over_stakes") == pytest.approx(0.0, abs=1e-9)


def test_a_boom_outside_the_regression_is_refused():
    with pytest.raises(DefinitionError, match="outside the regression"):
        CraneSkeleton(l_c=1.2, M=23.5 * kN, L=5.0)


def test_positions_are_four():
    with pytest.raises(DefinitionError, match="Position 5 is unknown"):
        CraneSkeleton().position(5)


def test_verdicts_say_what_is_kept_and_what_is_missing():
    lines = CraneSkeleton(h_0=1.80, H_k=3.0).verdicts(CraneSkeleton().position(1))
    assert "FAIL above_cab: the boom lies above the cab in transport (2.15): 100.0 mm are missing." in lines
    assert any(line.startswith("FAIL reach_error") for line in lines)
    assert all(line.startswith("ok ") for line in CraneSkeleton().verdicts(CraneSkeleton().position(1)))
    with pytest.raises(DefinitionError, match=r"\(2.13\) is read as"):
        CraneSkeleton.conditions("=")
