"""The whole crane: bound of moments, what its cylinders give, the load map against brute force, pin forces."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import trapezoid

from hydraulics import reserve
from linkage import (
    DefinitionError,
    Force,
    ForceElement,
    Over,
    distance,
    driving_force,
    least,
    most,
    pin_force,
    pin_forces,
    reachable,
)
from linkage.units import deg, kN
from mechanisms.crane import (
    BellCrankCrane,
    ChainCrane,
    Crane,
    CraneSkeleton,
    arm_bound,
    arm_moment,
    boom_bound,
    boom_moment,
    drive_limits,
    load_map,
)
from mechanisms.crane.machine import DRIVEN
from tests.for_all import for_all
from tests.members import told_by

# The bound of moments of the source's examples 2 and 3: the closed formulas, for a crane of any dimensions.

K_B, K_A, K_A1 = 85260.01232735414, 71905.17119002105, 39947.317327789475  # N m, worked out from the source's formulas


def loads_of(crane):
    """Return the constants of (2.20) to (2.43) [N m] by hand."""
    l_c, l_p, l_t, Q = (float(crane[name]) for name in ("l_c", "l_p", "l_t", "Q"))
    G_c, G_g, G_m = 9.81 * crane.output("W_c"), 0.025 * 9.81 * crane.output("W"), 300.0
    G_p = 9.81 * (crane.output("W_p") + crane.output("W_t"))
    boom = G_c * 0.4 * l_c + G_g * 0.7 * l_c + (G_m + G_p + Q) * l_c
    return boom, G_p * 0.45 * (l_p + l_t) + Q * (l_p + l_t), Q * l_p + G_p * 0.45 * l_p


def boom_formula(crane, phi):
    """(2.20), and (2.21) as corrected."""
    boom, arm, _ = loads_of(crane)
    psi_k = float(crane["psi_k"])
    return boom * np.sin(phi) + arm * np.where(phi <= psi_k - np.pi / 2, 1.0, np.sin(psi_k - phi))


def arm_formula(crane, psi):
    """(2.39) to (2.43)."""
    _, arm, short = loads_of(crane)
    phi_0, phi_k = crane.limits_of()["phi"]
    first = np.where(psi <= phi_k - np.pi / 2, 1.0, np.where(psi <= phi_k, np.sin(phi_k - psi), 0.0))
    second = np.where(psi >= phi_0 + np.pi / 2, 1.0, np.where(psi >= phi_0, np.sin(psi - phi_0), 0.0))
    return -short * first, arm * second


def some_cranes():
    rng = np.random.default_rng(4)
    for _ in range(6):
        yield CraneSkeleton(
            l_c=rng.uniform(3, 5), l_p=rng.uniform(2, 3), l_t=rng.uniform(1, 2), h_0=rng.uniform(1.2, 2.2), Q=rng.uniform(2, 20) * kN,
            phi_0=rng.uniform(15, 30) * deg, psi_k=rng.uniform(150, 180) * deg,
        )  # fmt: skip


def test_constants_are_those_of_the_examples():
    assert_allclose(loads_of(Crane()), (K_B, K_A, K_A1), rtol=1e-12)


@for_all("crane", [Crane(), *some_cranes()])
def test_bounds_are_the_closed_formulas(crane):
    phi, psi = (np.linspace(*crane.limits_of()[name], 61) for name in ("phi", "psi"))
    assert_allclose(boom_bound(crane, phi), boom_formula(crane, phi), rtol=1e-9)
    for found, formula in zip(arm_bound(crane, psi), arm_formula(crane, psi), strict=True):
        assert_allclose(found, formula, rtol=1e-9, atol=1e-6)


def test_bounds_are_never_passed():
    """Brute force: driving forces at random poses stay within, and come near."""
    crane, rng = Crane(), np.random.default_rng(5)
    spans = crane.limits_of()
    phi, psi, t = (rng.uniform(*spans[name], 20_000) for name in ("phi", "psi", "t"))
    motion = crane.at(phi=phi, psi=psi, t=t)
    boom, arm = (driving_force(motion, drive=name, case="lifting") for name in ("phi", "psi"))
    assert np.max(-boom - boom_formula(crane, phi)) <= 1e-6
    assert np.max(-boom / boom_formula(crane, phi)) > 0.98
    assert np.max(arm - arm_formula(crane, psi)[1]) <= 1e-6
    short = driving_force(crane.at(phi=phi, psi=psi, t=0.0), drive="psi", case="lifting")
    assert np.min(short - arm_formula(crane, psi)[0]) >= -1e-6


def test_bounds_keep_the_shape_asked_for():
    crane = Crane()
    assert boom_bound(crane, 1.0).shape == ()
    assert boom_bound(crane, np.ones((2, 3))).shape == (2, 3)
    assert arm_bound(crane, np.ones((2, 3)))[1].shape == (2, 3)


# What the cylinders give, at the source's optimal drives.


def test_boom_cylinder_of_the_example():
    crane = Crane()
    phi_0, phi_k = crane.limits_of()["phi"]
    at = np.array([phi_0, 90 * deg, phi_k])
    assert_allclose(boom_moment(crane, at), (105791.91804562794, 166877.4117797472, 154812.49414073216), rtol=1e-9)
    motion = crane.at(phi=at, psi=1.0, t=0.0)
    assert_allclose(-motion.ratio(distance("A", "B"), wrt="phi"), (0.41247373341726307, 0.6506409027399889, 0.6036008101330094), rtol=1e-9)
    assert_allclose(motion.distance("A", "B")[[0, 2]], (1.285054590561451 + 0.8850545905614509, 1.285054590561451), rtol=1e-9)
    assert float(boom_moment(crane, phi_k)) == pytest.approx(float(boom_bound(crane, phi_k)), rel=1e-9)


PSI = np.array([0.0, 66.46794140235528, 108.50776217952658, 143.9691789583755, 180.0]) * deg


def test_arm_cylinder_of_the_example():
    crane = Crane()
    folds, unfolds = arm_moment(crane, PSI)
    assert_allclose(
        folds, (-39947.317327789475, -87861.51994781065, -113977.55714106318, -123949.28918532869, -106768.28449427367), rtol=1e-9
    )
    assert_allclose(unfolds, (26903.295343205158, 59172.04404648473, 76760.39562561398, 83476.05190032341, 71905.17119002105), rtol=1e-9)
    assert float(folds[0]) == pytest.approx(float(arm_bound(crane, 0.0)[0]), rel=1e-9)
    assert float(unfolds[-1]) == pytest.approx(float(arm_bound(crane, np.pi)[1]), rel=1e-9)
    length = crane.at(phi=1.0, psi=PSI, t=0.0).distance("C", "N")
    assert_allclose(length, 1.3507442694010612 + 0.926744269401061 * np.array([1.0, 0.75, 0.5, 0.25, 0.0]), rtol=1e-9)


def test_bell_crank_of_the_example():
    alpha = np.array([-82.2365727085356, -20.993789757481697, 20.172186845607765, 54.29869257167299, 88.69605686463125]) * deg
    crane = BellCrankCrane(
        arm_r1=0.5, arm_r2=0.5, arm_r3=0.23, arm_r4=0.15, arm_r5=1.75, arm_r6=0.2, arm_r7=0.22, arm_r8=0.56, bend=12 * deg,
        lug=np.pi + alpha[0],
    )  # fmt: skip
    psi = alpha - alpha[0]
    assert_allclose(
        arm_moment(crane, psi)[1], (33766.62803847461, 58563.26440242404, 76707.89727112453, 85016.65717478, 71790.04230332548), rtol=1e-8
    )
    assert_allclose(crane.at(phi=1.0, psi=psi, t=0.0).distance("C", "Z"), (2.224, 1.999, 1.774, 1.549, 1.324), rtol=1e-9)


def test_moment_of_a_cylinder_over_its_way_is_its_oil():
    """The integral of M_g is force times stroke, whatever the linkage."""
    crane = Crane()
    phi, psi = (np.linspace(*crane.limits_of()[name], 4001) for name in ("phi", "psi"))
    area = np.pi / 4 * 22e6 * 0.95
    assert trapezoid(boom_moment(crane, phi), phi) == pytest.approx(area * 0.125**2 * 0.8850545905614509, rel=1e-6)
    assert trapezoid(arm_moment(crane, psi)[1], psi) == pytest.approx(area * (0.14**2 - 0.08**2) * 0.926744269401061, rel=1e-6)


def test_a_cylinder_without_a_line_has_no_moment():
    class Bare(Crane):
        lift_line = None

    with pytest.raises(DefinitionError, match="Bare: nothing bounds the thrust of lift; declare its line"):
        boom_moment(Bare(), 0.5)


def test_chains_halve_the_way_and_double_the_force():
    """The cylinder goes half the telescope's way with twice its force; the chains carry what the telescope does, each where it pulls."""
    at = {"phi": 1.0, "psi": PSI, "t": 1.0}
    crane = ChainCrane()
    motion = crane.at(**at)
    carried = Crane.extend.thrust(Crane().at(**at), case="lifting")
    areas = np.pi / 4 * np.where(carried > 0, 0.09**2, 0.09**2 - 0.056**2)
    needs = np.abs(2.0 * carried) / areas
    assert_allclose(motion["T"], Crane().at(**at)["T"], rtol=1e-14)
    assert_allclose(ChainCrane.extend.thrust(motion, case="lifting"), 2.0 * carried, rtol=1e-12)
    assert_allclose(ChainCrane.extend.sized(motion).pressure_for(ChainCrane.extend.thrust(motion, case="lifting")), needs, rtol=1e-12)
    assert_allclose(motion.ratio(distance("R", "D"), wrt="t"), 0.5, rtol=1e-12)
    out, back = (chain.tension(motion, case="lifting") for chain in (ChainCrane.chain, ChainCrane.back))
    assert_allclose(out - back, carried, rtol=1e-12)
    assert np.all(np.minimum(out, back) == 0.0) and out.max() > 0.0 and back.max() > 0.0
    direct, chained = (pin_forces(each.at(**at), case="lifting") for each in (Crane(), crane))
    assert_allclose(chained.tensions["chain"], out, rtol=1e-9, atol=1e-6)
    assert_allclose(chained.tensions["back"], back, rtol=1e-9, atol=1e-6)
    assert chained.residual < 1e-12 and chained.gap < 1e-11
    for pin in ("O", "A", "V", "E"):
        assert_allclose(chained.force(pin), direct.force(pin), rtol=1e-9)


# The load map.

HEIGHTS, RADII = np.linspace(-2.0, 9.0, 15), np.linspace(0.5, 10.5, 14)


def poses_at(crane, x, y, t):
    """Return phi and psi of a tip by complex numbers, both elbows, shape (2, ...)."""
    l_c, arm = float(crane["l_c"]), float(crane["l_p"]) + t
    tip = x + 1j * (y - float(crane["H_p"]) - float(crane["h_0"]))
    with np.errstate(invalid="ignore"):
        along = (l_c**2 - arm**2 + abs(tip) ** 2) / (2 * abs(tip))
        joint = tip / abs(tip) * (along + 1j * np.sqrt(l_c**2 - along**2) * np.array([1.0, -1.0]).reshape(2, *(1,) * np.ndim(t)))
        phi = np.pi / 2 - np.angle(joint)
        return phi, np.mod(np.angle((tip - joint) / -joint), 2 * np.pi)


def capacities(crane, x, y, t):
    """Return the least of the three circuits' own capacities [N] at a tip, both elbows; NaN where it cannot stand."""
    own = [name for name in crane.plan.of_kind(ForceElement) if name != "load"]
    phi, psi = poses_at(crane, x, y, t)
    spans = crane.limits_of()
    ok = (phi >= spans["phi"][0]) & (phi <= spans["phi"][1]) & (psi >= spans["psi"][0]) & (psi <= spans["psi"][1])
    found = np.full(ok.shape, np.nan)
    if ok.any():
        motion = crane.at(phi=phi[ok], psi=psi[ok], t=np.broadcast_to(t, ok.shape)[ok])
        circuits = [motion.plan.members[f"{ram}_line"] for ram in DRIVEN.values()]
        loads = np.array([circuit.capacity(motion, "T", own, case="lifting") for circuit in circuits])
        found[ok] = np.min(np.where(np.isnan(loads), np.inf, loads), axis=0)
    return found.reshape(2, -1)


def brute_force(crane, heights, radii, count):
    """Return the greatest load over a grid of telescope positions and finer ones about its best, shape (heights, radii) [N]."""
    found = np.full((len(heights), len(radii)), np.nan)
    l_t = float(crane["l_t"])
    for k, y in enumerate(heights):
        for n, x in enumerate(radii):
            t = np.linspace(0.0, l_t, count)
            for _ in range(3):
                loads = capacities(crane, x, y, t)
                if np.isfinite(loads).any():
                    best = np.nanargmax(loads) % count
                    found[k, n] = np.nanmax(loads)
                    t = np.linspace(t[max(best - 1, 0)], t[min(best + 1, count - 1)], count)
    return found


@pytest.mark.slow
@pytest.mark.parametrize("machine", [Crane, pytest.param(ChainCrane, marks=pytest.mark.slow)])
def test_load_map_is_brute_force(machine):
    crane, heights, radii = machine(), HEIGHTS[1::6], RADII[::4]
    found, slow = load_map(crane, heights, radii).load, brute_force(crane, heights, radii, 61)
    both = np.isfinite(slow)
    assert both.sum() >= 6
    assert np.isfinite(found[both]).all()
    assert np.all(found[both] >= slow[both] * (1.0 - 1e-6))
    assert_allclose(found[both], slow[both], rtol=1e-3)


@pytest.mark.slow
def test_whole_load_map_is_brute_force():
    crane = Crane()
    found, slow = load_map(crane, HEIGHTS, RADII).load, brute_force(crane, HEIGHTS, RADII, 401)
    both = np.isfinite(slow)
    assert_allclose(found[both], slow[both], rtol=1e-3)


def test_the_pose_of_a_cell_is_at_its_limit():
    """At every cell's pose the tip is there, and the limiting cylinder, with the load by its own thrust, is at what it gives."""
    crane, found = Crane(), load_map(Crane(), HEIGHTS, RADII)
    own = [name for name in crane.plan.of_kind(ForceElement) if name != "load"]
    strokes = {ram: stroke for stroke, ram in DRIVEN.items()}
    assert set(np.unique(found.limiter)) == {*strokes, "out of reach"}
    for k, n in np.argwhere(np.isfinite(found.load))[::4]:
        motion = crane.at(**{name: values[k, n] for name, values in found.strokes.items()})
        assert_allclose(motion["T"], (RADII[n], HEIGHTS[k]), atol=1e-7)
        uses = {}
        for limiter, stroke in strokes.items():
            cylinder, size = motion.plan.members[DRIVEN[stroke]], motion.plan.members[DRIVEN[stroke]].size
            thrust = float(cylinder.thrust(motion, [*own, Force("T", (0.0, -found.load[k, n]))], case="lifting"))
            uses[limiter] = thrust / (22e6 * 0.95 * (size.push_area if thrust > 0.0 else -size.pull_area))
        assert uses[found.limiter[k, n]] == pytest.approx(1.0, rel=1e-9)
        assert max(uses.values()) <= 1.0 + 1e-9
    assert np.array_equal(np.isnan(found.load), found.limiter == "out of reach")


def test_stability_and_a_rated_load_limit_too():
    crane = Crane()
    free, held = load_map(crane, HEIGHTS, RADII), load_map(crane, HEIGHTS, RADII, stability=120 * kN, rated=18 * kN)
    assert {"stability", "rated load"} <= set(np.unique(held.limiter))
    there = np.isfinite(free.load)
    assert np.all(held.load[there] <= np.minimum(free.load[there], 18 * kN) * (1 + 1e-9))
    for k, n in np.argwhere(held.limiter == "stability"):
        motion = crane.replaced(Q=held.load[k, n]).at(**{name: values[k, n] for name, values in held.strokes.items()})
        moment = -float(driving_force(motion, drive="phi", case="lifting"))
        assert moment == pytest.approx(120 * kN, rel=1e-9)


def test_the_very_end_of_the_reach_is_within_it():
    crane = Crane()
    found = load_map(crane, [1.2], [10.0, 10.001])
    assert found.load[0, 0] > 0.0 and found.strokes["t"][0, 0] == pytest.approx(crane.limits_of()["t"][1])
    assert found.limiter[0, 1] == "out of reach"


def test_a_cylinder_that_is_too_short_bounds_the_reach():
    class Short(Crane):
        extend = type(Crane.extend)("R", "T", bore=0.063, rod=0.04, works="both", closed=2.915, stroke=1.0)

    crane = Short()
    assert drive_limits(crane)["t"] == pytest.approx((0.0, 2.915 + 1.0 + 0.25 - float(crane["l_p"])), abs=2e-6)
    assert load_map(crane, [1.2], [9.5]).limiter[0, 0] == "out of reach"


def test_a_cylinder_that_never_fits_is_refused():
    class Wrong(Crane):
        lift = type(Crane.lift)("A", "B", bore=0.125, rod=0.07, works="both", closed=3.0, stroke=1.0)

    with pytest.raises(DefinitionError, match="lift is never as long as phi needs"):
        load_map(Wrong(), [1.2], [9.5])


@for_all(
    ("call", "words"),
    [
        (lambda: load_map(Crane(Q=np.array([1.0, 2.0])), [1.0], [5.0]), "this is a batch"),
        (lambda: load_map(Crane(), [[1.0]], [5.0]), "numbers in a row"),
        (lambda: load_map(Crane(), [np.nan], [5.0]), "numbers in a row"),
        (lambda: load_map(Crane(), [1.0], [5.0], stability=-1.0), "stability = -1 is not above zero"),
        (lambda: load_map(Crane(), [1.0], [5.0], case="heavy"), "heavy"),
    ],
)
def test_what_a_load_map_refuses(call, words):
    with pytest.raises(DefinitionError, match=words):
        call()


# Where it runs.

BOX = Over(phi=("phi_0", "phi_k"), t=(0.0, "l_t"))


def places(crane, name):
    """Return the places of one of the crane's paths, phi and psi in degrees, t in metres."""
    motion = crane.judge(crane.plan.members[name]).motion
    return np.array([np.degrees(motion.strokes["phi"]), np.degrees(motion.strokes["psi"]), motion.strokes["t"]]).T


def test_it_runs_from_position_to_position():
    """Both paths begin and end in the positions that the skeleton is laid out by, of this design."""
    crane = Crane(phi_0=20 * deg, h_0=1.9)
    limits = crane.limits_of()
    phi_0, phi_k = np.degrees(limits["phi"])
    l_t = limits["t"][1]
    loading, transport = places(crane, "loading"), places(crane, "transport")
    assert_allclose(loading, [(phi_k, 180, l_t), (phi_0, 180, l_t), (phi_0, phi_0, l_t), (phi_0, phi_0, 0), (phi_0, 0, 0)], atol=1e-9)
    assert_allclose(transport, [(phi_0, 0, 0), (90, 0, 0)], atol=1e-9)
    for number, place in ((1, loading[0]), (2, loading[3]), (3, loading[4]), (4, transport[1])):
        at = crane.position(number).strokes
        assert_allclose(place, [np.degrees(at["phi"]), np.degrees(at["psi"]), at["t"]], atol=1e-9)


@pytest.mark.slow
def test_its_way_shows_what_its_drives_are_designed_for():
    """The arm's drive is the source's optimum, so its reserve is 1 on the way; in the whole box it is not."""
    crane = Crane()
    lift, fold, reached = crane.answers([least(reserve("lift")), least(reserve("fold")), reachable])
    (in_box,) = crane.answers([least(reserve("fold"))], over=BOX)
    asked_of, given = arm_bound(crane, np.array([0.0])), arm_moment(crane, np.array([0.0]))
    assert given[0][0] / asked_of[0][0] == pytest.approx(1.0, rel=1e-6)
    assert fold.value == pytest.approx(1.0, rel=1e-6)
    assert lift.value == pytest.approx(0.980, abs=5e-4) and lift.case == "side_slope"
    assert in_box.value == pytest.approx(0.556, abs=5e-4)
    assert reached.ok


@pytest.mark.slow
def test_in_the_whole_box_nothing_is_better_than_on_its_way():
    asked = [least(reserve(name)) for name in ("lift", "fold", "extend")] + [most(pin_force("A"))]
    on_way, in_box = Crane().answers(asked), Crane().answers(asked, over=BOX)
    assert all(way.value >= box.value * (1 - 1e-9) for way, box in zip(on_way[:3], in_box[:3], strict=True))
    assert on_way[3].value <= in_box[3].value * (1 + 1e-9)


@pytest.mark.slow
def test_what_fails_of_its_boom_on_its_way_is_told():
    for name, rules in (("lift", ["buckling"]), ("lift_line", ["lifting"])):
        assert [each.rule for each in told_by(Crane(), name) if each.ok is False] == rules


@pytest.mark.slow
@pytest.mark.parametrize("crane", [Crane, BellCrankCrane])
def test_what_fails_on_its_way_is_told(crane):
    failed = [each.rule for each in crane().verdicts() if each.ok is False]
    assert failed == ["buckling extend", "buckling lift", "lifting lift_line", "buckling fold"]


def test_a_batch_whose_ways_differ_is_refused_with_the_remedy():
    assert Crane(**{"lift.bore": [0.125, 0.14]}).answers([reachable])[0].ok.all()
    with pytest.raises(DefinitionError, match="the same for all designs: take one design, or give over="):
        Crane(phi_0=[0.3, 0.4]).verdicts()
    assert Crane(phi_0=[0.3, 0.4]).answers([reachable], over=Over())[0].ok.all()
