"""The working field: against a two-cylinder arm worked out by hand, brute force, and laws that hold for every field."""

import pickle
from functools import cache
from itertools import product
from math import acos, atan2, cos, hypot, pi, sin

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Cylinder, LiftCircuit
from linkage import (
    ISO_10567,
    ISO_14397_1,
    LEFT,
    OECD_2,
    Acting,
    Crank,
    DefinitionError,
    Dimension,
    Dyad,
    Force,
    Ground,
    LoadCase,
    LoadRule,
    Mechanism,
    OnLink,
    Outline,
    Over,
    Part,
    PinFriction,
    Planes,
    Stroke,
    Support,
    Target,
    Weight,
    angle,
    clearance,
    drive_force,
    standing,
    strokes_for,
    working_field,
    x,
    y,
)
from linkage.units import bar, deg, g0, kN, mm
from mechanisms.at_work.tipper import Tipper
from mechanisms.crane import Crane
from tests.for_all import first_daily, for_all
from tests.machines.test_excavator import Excavator

ALONE = {"hold": {"S3": 0.2}, "without": ["dig"]}
RADII, HEIGHTS = np.linspace(0.9, 3.0, 8), np.linspace(-1.7, 2.3, 9)


class Arm(Mechanism):
    """A boom OJ lifted by AB, an arm JK swung by CD; both cylinders are driven lengths."""

    lift, fold = Stroke(0.75, 1.15), Stroke(0.70, 1.10)
    O, A = Ground(0.0, 1.0), Ground(0.3, 0.4)
    B = Dyad(O, A, OB=0.8, AB=lift, side=LEFT)
    J = OnLink(O, B, OJ=2.0)
    C = OnLink(O, B, OC=1.2)
    D = Dyad(C, J, CD=fold, JD=0.35, side=LEFT)
    K = OnLink(J, D, JK=1.5, DJK=140 * deg)
    boom_mass, arm_mass = Weight(J, mass=80.0), Weight(K, mass=45.0)
    lifter = Cylinder(A, B, bore=70 * mm, rod=40 * mm, works="both")
    folder = Cylinder(C, D, bore=60 * mm, rod=35 * mm, works="both")
    lift_line = LiftCircuit(lifter, pressure=170 * bar, relief=200 * bar, mechanical_efficiency=0.94)
    fold_line = LiftCircuit(folder, pressure=160 * bar, back_pressure=5 * bar, hydraulic_efficiency=0.97)


def area(bore, rod=0.0):
    """Return the area of a piston or of an annulus."""
    return pi / 4.0 * (bore**2 - rod**2)


PUSH = 0.94 * 170e5 * area(0.07), 0.97 * 160e5 * area(0.06) - 5e5 * area(0.06, 0.035)
PULL = 0.94 * 170e5 * area(0.07, 0.04), 0.97 * 160e5 * area(0.06, 0.035) - 5e5 * area(0.06)


def by_hand(px, py):
    """Return the best load of the arm at a place with what limits it, by both elbows; None out of reach."""
    best = None
    across = hypot(px, py - 1.0)
    if not abs(2.0 - 1.5) < across < 3.5:
        return None
    for elbow in (1.0, -1.0):
        boom = atan2(py - 1.0, px) + elbow * acos((4.0 + across**2 - 2.25) / (4.0 * across))
        J = 2.0 * cos(boom), 1.0 + 2.0 * sin(boom)
        arm = atan2(py - J[1], px - J[0])
        B = 0.8 * cos(boom), 1.0 + 0.8 * sin(boom)
        C = 1.2 * cos(boom), 1.0 + 1.2 * sin(boom)
        lug = arm - 140.0 * pi / 180.0
        D = J[0] + 0.35 * cos(lug), J[1] + 0.35 * sin(lug)
        strokes = hypot(B[0] - 0.3, B[1] - 0.4), hypot(D[0] - C[0], D[1] - C[1])
        left = [(B[0] * (0.4 - 1.0) - (B[1] - 1.0) * 0.3), None]
        if not (0.75 <= strokes[0] <= 1.15 and 0.70 <= strokes[1] <= 1.10) or left[0] > 0.0:
            continue
        if (J[0] - C[0]) * (D[1] - C[1]) - (J[1] - C[1]) * (D[0] - C[0]) < 0.0:
            continue
        # moments about O and J: the thrust over its length times its lever, against weights and the load
        lever = (B[0] * (B[1] - 0.4) - (B[1] - 1.0) * (B[0] - 0.3)) / strokes[0]
        inner = ((D[0] - J[0]) * (D[1] - C[1]) - (D[1] - J[1]) * (D[0] - C[0])) / strokes[1]
        own = (80.0 * J[0] + 45.0 * px) * g0 / lever, 45.0 * (px - J[0]) * g0 / inner
        share = px / lever, (px - J[0]) / inner
        loads = []
        for k in (0, 1):
            end = PUSH[k] if share[k] > 0.0 else -PULL[k]
            loads.append(max((end - own[k]) / share[k], 0.0) if -PULL[k] <= own[k] <= PUSH[k] else 0.0)
        found = min(loads), ("lifter", "folder")[int(np.argmin(loads))], strokes, loads
        best = found if best is None or found[0] > best[0] else best
    return best


def test_two_cylinder_arm_by_hand():
    radii, heights = np.linspace(0.6, 3.5, 30), np.linspace(-1.2, 3.6, 29)
    field = working_field(Arm(), "K", radii, heights)
    reached = 0
    for k, height in enumerate(heights):
        for n, radius in enumerate(radii):
            hand = by_hand(radius, height)
            assert (hand is None) == np.isnan(field.load[k, n]), (radius, height)
            if hand is None:
                assert field.limiter[k, n] == "out of reach"
                continue
            reached += 1
            assert_allclose(field.load[k, n], hand[0], rtol=1e-9, atol=1e-6)
            assert_allclose([field.of["lifter"][k, n], field.of["folder"][k, n]], hand[3], rtol=1e-8, atol=1e-6)
            assert_allclose([field.strokes["lift"][k, n], field.strokes["fold"][k, n]], hand[2], atol=1e-10)
            assert field.limiter[k, n] == hand[1]
    assert reached > 80


def forces_and_bounds(field, motion, acting, lifting=lambda name: True, share=1.0):
    """Return of each bounded cylinder its thrust with its lowest and highest one."""
    plan = field.machine.plan
    for name, ram in plan.of_kind(Cylinder).items():
        low, high = ram.bounds(motion, lifting(name), share=share)
        yield name, ram.thrust(motion, acting=acting), low, high


def loaded(field, own):
    """Return the cells' motion, their loads, and what acts with the load of each."""
    load = field.load[field.reached]
    pull = Force(field.point, (-field.along[0] * load, -field.along[1] * load))
    return field.motion(), load, field.limiter[field.reached], Acting([*own, pull], field.case or None)


def own_loads(machine, without=()):
    """Return the names of a machine's loads."""
    return [name for name in machine.plan.members if name in {*machine.plan.of_kind(Weight)} and name not in without]


@for_all("along", [(0.0, 1.0), (0.6, 0.8), (-1.0, 0.0), (0.3, -1.0)])
@for_all("lifts", [None, ["boom"]])
def test_limiter_stands_at_its_bound_and_no_other_beyond(along, lifts):
    machine = Excavator()
    field = working_field(machine, "M", RADII, HEIGHTS, along=along, lifts=lifts, **ALONE)
    motion, load, limiter, acting = loaded(field, own_loads(machine))
    limited = np.isfinite(load) & (load > 0.0)
    assert limited.sum() > 15
    for name, thrust, low, high in forces_and_bounds(field, motion, acting, lambda name: lifts is None or name in lifts):
        size = max(float(np.max(np.abs(np.where(np.isfinite(end), end, 0.0)))) for end in (low, high))
        assert np.all((thrust >= low - 1e-9 * size) & (thrust <= high + 1e-9 * size) | ~limited)
        mine = limited & (limiter == name)
        away = np.minimum(np.abs(thrust - low), np.abs(thrust - high))
        assert np.all(away[mine] <= 1e-9 * size)


@cache
def plain_field():
    """Return the field of the excavator alone."""
    return working_field(Excavator(), "L", RADII, HEIGHTS, **ALONE)


class Rubbing(Excavator):
    """The same with friction in its pins."""

    friction = PinFriction("B", radius=0.04, coefficient=0.15)
    dig = None


@pytest.mark.slow
def test_friction_counts_with_the_direction_of_lifting():
    machine = Rubbing()
    field = working_field(machine, "L", RADII, HEIGHTS, hold={"S3": 0.2})
    plain = plain_field()
    assert np.all((field.load <= plain.load + 1e-6) | np.isnan(plain.load)) and np.nanmax(plain.load - field.load) > 10.0
    motion = field.motion()
    circuit = machine.plan.members["boom_line"]
    known = circuit.capacity(motion, "L")
    mine = (field.limiter[field.reached] == "boom") & (field.load[field.reached] > 0.0)
    assert mine.sum() > 10
    assert_allclose(field.load[field.reached][mine], known[mine], rtol=1e-9)


def test_what_alone_is_too_heavy_lifts_nothing():
    heavy = Excavator().replaced(**{"boom_mass.mass": 9000.0})
    field = working_field(heavy, "L", RADII, HEIGHTS, **ALONE)
    assert np.all(field.load[field.reached] == 0.0) and np.all(field.limiter[field.reached] == "boom")


def test_half_of_all_pressures_and_masses_is_half_of_all():
    machine = Excavator()
    names = [f"{name}.mass" for name in machine.plan.of_kind(Weight)]
    names += [f"{line}_line.{what}" for line in ("boom", "arm", "bucket") for what in ("pressure", "relief", "back_pressure")]
    half = machine.replaced(**{name: 0.5 * machine[name] for name in names})
    whole, found = plain_field(), working_field(half, "L", RADII, HEIGHTS, **ALONE)
    assert_allclose(found.load, 0.5 * whole.load, rtol=1e-12)
    assert np.array_equal(found.limiter, whole.limiter)


def test_factors_of_a_rule_are_factors():
    machine, whole = Excavator(), plain_field()
    ruled = working_field(machine, "L", RADII, HEIGHTS, rule=ISO_10567, **ALONE)
    assert_allclose(ruled.load, 0.87 * whole.load, rtol=1e-13)
    assert_allclose(working_field(machine, "L", RADII, HEIGHTS, rule="ISO 10567", **ALONE).load, ruled.load, rtol=0)
    assert (ISO_10567.hydraulic, ISO_10567.tipping, ISO_14397_1.tipping, OECD_2.pressure) == (0.87, 0.75, 0.5, 0.9)
    assert any("no supports" in each for each in ruled.remarks)


def test_pressure_of_a_rule_is_the_share_of_a_capacity():
    machine = Excavator()
    field = working_field(machine, "L", RADII, HEIGHTS, rule=OECD_2, **ALONE)
    motion = field.motion()
    own = own_loads(machine)
    known = {name: machine.plan.members[f"{name}_line"].capacity(motion, "L", own, share=0.9) for name in ("boom", "arm")}
    checked = 0
    for name, capacity in known.items():
        mine = (field.limiter[field.reached] == name) & np.isfinite(capacity)
        checked += int(mine.sum())
        assert_allclose(field.load[field.reached][mine], capacity[mine], rtol=1e-12)
    assert checked > 20


def poses_of_crane(crane, across, up, t):
    """Return boom and arm of a crane's tip by complex numbers, the joint above; NaN where the three lengths close no triangle."""
    boom, arm = float(crane["l_c"]), float(crane["l_p"]) + t
    tip = across + 1j * (up - float(crane["H_p"]) - float(crane["h_0"]))
    with np.errstate(invalid="ignore"):
        along = (boom**2 - arm**2 + abs(tip) ** 2) / (2.0 * abs(tip))
        joint = tip / abs(tip) * (along + 1j * np.sqrt(boom**2 - along**2))
        return {"phi": pi / 2 - np.angle(joint), "psi": np.mod(np.angle((tip - joint) / -joint), 2.0 * pi), "t": t}


@first_daily(2, "over", [None, {"phi": (30 * deg, 80 * deg), "psi": (40 * deg, 150 * deg), "t": (0.4, 2.0)}, {"t": (0.0, 3.1)}])
def test_strokes_to_spare_stand_where_most_is_carried(over):
    crane = Crane(Q=0.0)
    radii, heights = np.array([1.0, 2.4, 4.7, 7.7, 8.9, 9.9, 10.4]), np.array([-1.0, 1.6, 4.8, 8.0])
    field = working_field(crane, "T", radii, heights, case="lifting", over=over)
    ends = {name: (each.start, each.end) for name, each in crane.strokes.items()} | (over or {})
    for k, height in enumerate(heights):
        for n, radius in enumerate(radii):
            strokes = poses_of_crane(crane, radius, height, np.linspace(*ends["t"], 20001))
            fits = np.all([(values >= ends[name][0] - 1e-9) & (values <= ends[name][1] + 1e-9) for name, values in strokes.items()], axis=0)
            assert fits.any() == field.reached[k, n], (radius, height)
            if fits.any():
                best = field.search.loads.at({name: values[fits] for name, values in strokes.items()}).min(axis=0).max()
                assert field.load[k, n] >= best * (1.0 - 1e-9)
                assert field.load[k, n] <= best * (1.0 + 5e-3)
    motion = field.motion()
    across, up = np.meshgrid(radii, heights)
    assert_allclose(motion["T"], np.stack([across[field.reached], up[field.reached]]), atol=1e-9)
    assert any("strokes run" in each for each in field.remarks) == (over is not None)


@first_daily(1, "seed", [3, 0, 1, 2])
def test_border_with_a_stroke_to_spare_parts_what_is_reached(seed):
    """A little to either side of the border one place is reached and the other is not, by the cosine rule; the area is that of a grid."""
    rng, crane = np.random.default_rng(seed), Crane()
    ends = {name: tuple(np.sort(rng.uniform(each.start, each.end, 2))) for name, each in crane.strokes.items()} if seed else {}
    field = working_field(crane, "T", [5.0], [2.0], case="lifting", over=ends or None)
    ends = {name: (each.start, each.end) for name, each in crane.strokes.items()} | ends

    def is_reached(across, up):
        away = np.hypot(across, up - float(crane["H_p"]) - float(crane["h_0"]))
        boom, arm = float(crane["l_c"]), float(crane["l_p"])
        ends_of_angles = [away - boom - arm + 1e-9, boom - away - arm + 1e-9, boom + away - arm - 1e-9]  # straight and folded
        strokes = poses_of_crane(crane, across, up, np.append(np.linspace(*ends["t"], 401), ends_of_angles))
        fits = [(values >= ends[name][0] - 1e-4) & (values <= ends[name][1] + 1e-4) for name, values in strokes.items()]
        return np.all(fits, axis=0).any()

    border = field.border
    ends_of_pieces = border.reshape(-1, 2)
    gaps = np.hypot(*(ends_of_pieces[:, None] - ends_of_pieces).transpose(2, 0, 1)) + 1e9 * np.eye(len(ends_of_pieces))
    assert np.quantile(gaps.min(axis=1), 0.99) < 1e-9  # every end of a piece is the end of another one
    size = np.hypot(*(border[:, 1] - border[:, 0]).T)
    for piece in border[rng.choice(len(border), 24, p=size / size.sum())]:
        along = piece[1] - piece[0]
        aside = 0.01 * np.array([-along[1], along[0]]) / np.hypot(*along)
        middle = 0.5 * (piece[0] + piece[1])
        assert is_reached(*(middle + aside)) != is_reached(*(middle - aside))
    (left, low), (right, high) = border.min(axis=(0, 1)), border.max(axis=(0, 1))
    share = (np.arange(31) + 0.5) / 31
    inside = [[is_reached(left + a * (right - left), low + b * (high - low)) for a in share] for b in share]
    assert field.area == pytest.approx(np.mean(inside) * (right - left) * (high - low), rel=0.05)


def test_a_stroke_with_one_place_to_run_is_held():
    given = {"hold": {"S3": 0.2}}, {"over": Over(S3=0.2)}
    held, over = (working_field(Excavator(), "L", RADII, HEIGHTS, without=["dig"], **each) for each in given)
    assert_allclose(over.load, held.load, rtol=1e-13)
    assert any("held: S3" in each for each in over.remarks)


class Telehandler(Mechanism):
    """A crane with a telescope and a tool that tilts: two strokes to spare."""

    phi, psi = Stroke(-20 * deg, 75 * deg), Stroke(20 * deg, 175 * deg)
    t, tilt = Stroke(0.0, 1.2), Stroke(-70 * deg, 60 * deg)
    JK = Dimension(2.0)
    O, A = Ground(0.0, 1.6), Ground(0.35, 0.6)
    J = Crank(O, OJ=3.0, angle=phi)
    B = OnLink(O, J, OB=1.1, JOB=-10 * deg)
    K = Crank(J, JK=JK, angle=angle(J, O) + psi)
    C = OnLink(O, J, OC=1.7, JOC=12 * deg)
    D = OnLink(J, K, JD=0.4, KJD=130 * deg)
    S = OnLink(J, K, JS=JK + t)
    T = Crank(S, ST=0.7, angle=angle(J, K) + tilt)
    E = OnLink(J, K, JE=1.2, KJE=12 * deg)
    G = OnLink(S, T, SG=0.3, TSG=80 * deg)
    R = OnLink(J, K, JR=0.3)
    boom_mass, arm_mass, tool = Weight(B, mass=150.0), Weight(K, mass=90.0), Weight(T, mass=60.0)
    lift = Cylinder(A, B, bore=100 * mm, rod=60 * mm, works="both")
    fold = Cylinder(C, D, bore=80 * mm, rod=50 * mm, works="both")
    extend = Cylinder(R, S, bore=50 * mm, rod=32 * mm, works="both")
    turn = Cylinder(E, G, bore=63 * mm, rod=36 * mm, works="both")
    lift_line, fold_line = LiftCircuit(lift, pressure=200 * bar), LiftCircuit(fold, pressure=200 * bar)
    extend_line, turn_line = LiftCircuit(extend, pressure=200 * bar), LiftCircuit(turn, pressure=200 * bar)


VARIED = [
    "OJ", "OB", "JK", "OC", "JD", "ST", "JE", "SG", "lift.bore", "fold.bore", "extend.bore", "turn.bore", "boom_mass.mass", "arm_mass.mass",
    "tool.mass",
]  # fmt: skip


def most_of_a_grid(machine, field, count):
    """Return the most that is carried at each place with telescope and tilt on a grid, boom and arm by the cosine rule; -1 out of reach."""
    ends = {name: (each.start, each.end) for name, each in machine.strokes.items()}
    t, tilt = (each.ravel() for each in np.meshgrid(*(np.linspace(*ends[name], count) for name in ("t", "tilt"))))
    OJ, JK, ST = (float(machine[name]) for name in ("OJ", "JK", "ST"))
    far, off = np.hypot(JK + t + ST * np.cos(tilt), ST * np.sin(tilt)), np.arctan2(ST * np.sin(tilt), JK + t + ST * np.cos(tilt))
    found = np.full(field.load.shape, -1.0)
    for (k, n), side in product(np.ndindex(found.shape), (1.0, -1.0)):
        across, up = field.x[n], field.y[k] - 1.6
        away = np.hypot(across, up)
        with np.errstate(invalid="ignore"):
            phi = np.arctan2(up, across) + side * np.arccos((OJ**2 + away**2 - far**2) / (2.0 * OJ * away))
        psi = np.arctan2(up - OJ * np.sin(phi), across - OJ * np.cos(phi)) - off - phi - pi
        psi = np.mod(psi + pi / 2, 2.0 * pi) - pi / 2
        strokes = {"phi": phi, "psi": psi, "t": t, "tilt": tilt}
        fits = np.all([(values >= ends[name][0]) & (values <= ends[name][1]) for name, values in strokes.items()], axis=0)
        if fits.any():
            load = field.search.loads.at({name: values[fits] for name, values in strokes.items()}).min(axis=0)
            found[k, n] = max(found[k, n], np.nanmax(load))
    return found


@first_daily(0, "seed", [0, 1, 2, 3, 4, 5, 6, 9, 18])
def test_two_strokes_to_spare_are_no_worse_than_a_grid(seed):
    rng, base = np.random.default_rng(seed), Telehandler()
    machine = base.replaced(**{name: base[name] * rng.uniform(0.85, 1.15) for name in VARIED})
    field = working_field(machine, "T", np.sort(rng.uniform(0.8, 6.5, 6)), np.sort(rng.uniform(-1.0, 5.5, 5)))
    known = most_of_a_grid(machine, field, 31)
    assert np.all(field.reached[known >= 0.0]) and np.sum(known > 0.0) > 12
    assert np.all(field.load[known >= 0.0] >= known[known >= 0.0] * (1.0 - 1e-3))


def test_what_is_kept_is_kept_and_branches_are_all_seen():
    machine = Excavator()
    tilt = angle("L", "M")
    field = working_field(machine, "L", RADII, HEIGHTS, keep=[Target(tilt, -90 * deg)], without=["dig"])
    motion = field.motion()
    assert_allclose(np.cos(motion.value(tilt)), 0.0, atol=1e-9)
    for k, height in enumerate(HEIGHTS[::3]):
        for n, radius in enumerate(RADII[::2]):
            found = strokes_for(machine, [Target(x("L"), radius), Target(y("L"), height), Target(tilt, -90 * deg)])
            assert found.met == field.reached[3 * k, 2 * n]


@pytest.mark.slow
def test_random_places_are_rightly_called_reached():
    rng = np.random.default_rng(5)
    machine = Excavator()
    for _ in range(2):
        radii, heights = np.sort(rng.uniform(0.3, 3.3, 4)), np.sort(rng.uniform(-2.5, 2.8, 4))
        field = working_field(machine, "M", radii, heights, **ALONE)
        known = [[strokes_for(machine, [Target(x("M"), a), Target(y("M"), b)], hold={"S3": 0.2}).met for a in radii] for b in heights]
        assert np.array_equal(field.reached, known)


def test_why_a_cell_is_out_of_reach():
    field = working_field(Excavator(), "L", [1.3, 2.0, 9.0], [0.5, 2.3], **ALONE)
    assert field.why[0, 1] == "" and field.reached[0, 1]
    assert "past its end at" in field.why[1, 0] and "S1" in field.why[1, 0]
    assert field.why[0, 2].startswith("the nearest pose is") and field.why[0, 2].endswith("away")
    assert field.limiter[0, 2] == "out of reach"


@pytest.mark.slow
def test_a_field_is_pickled():
    field = working_field(Excavator(), "L", RADII, HEIGHTS, rule=ISO_10567, **ALONE)
    found = pickle.loads(pickle.dumps(field))
    assert np.array_equal(found.load, field.load, equal_nan=True) and found.rule == ISO_10567
    assert found.area == field.area and np.array_equal(found.why, field.why)


def test_places_come_back_in_the_order_they_were_given():
    one = plain_field()
    other = working_field(Excavator(), "L", RADII[::-1], HEIGHTS[[3, 1, 2]], **ALONE)
    assert np.array_equal(other.load, one.load[[3, 1, 2]][:, ::-1], equal_nan=True)
    assert np.array_equal(other.why, one.why[[3, 1, 2]][:, ::-1])


AROUND, UP = np.linspace(0.6, 2.2, 9), np.linspace(-0.4, 0.9, 6)


class CarriedArm(Mechanism):
    """The arm as a part, mirrored and moved aside."""

    lift, fold = Stroke(0.75, 1.15), Stroke(0.70, 1.10)
    crane = Part(Arm, lift=lift, fold=fold, mirrored=True, at=(0.4, 0.2))


@pytest.mark.slow
def test_a_mirrored_part_lifts_the_same_at_the_mirrored_place():
    alone = working_field(Arm(), "K", AROUND, UP)
    part = working_field(CarriedArm(), "crane.K", 0.4 - AROUND, UP + 0.2)
    assert_allclose(part.load, alone.load, rtol=1e-10)
    assert_allclose(part.of["crane.folder"], alone.of["folder"], rtol=1e-10)
    assert_allclose(part.strokes["fold"], alone.strokes["fold"], atol=1e-12)
    assert_allclose(part.area, alone.area, rtol=1e-12)


@for_all("seed", range(2), slow=range(2, 4))
def test_law_of_the_limiter_on_random_designs(seed):
    rng = np.random.default_rng(seed)
    names = ["OB", "OJ", "OC", "JD", "JK", "boom_mass.mass", "arm_mass.mass", "lifter.bore", "folder.bore"]
    machine = Arm().replaced(**{name: Arm()[name] * rng.uniform(0.96, 1.04) for name in names})
    turn = rng.uniform(0.0, 2.0 * pi)
    field = working_field(machine, "K", AROUND, UP, along=(cos(turn), sin(turn)), lifts=[["lifter"], ["folder"]][seed % 2])
    motion, load, limiter, acting = loaded(field, own_loads(machine))
    kept = load > 0.0
    assert kept.sum() > 5
    for name, thrust, low, high in forces_and_bounds(field, motion, acting, lambda name: name == ("lifter", "folder")[seed % 2]):
        size = float(np.maximum(abs(low), abs(high)))
        assert np.all(((thrust >= low - 1e-9 * size) & (thrust <= high + 1e-9 * size))[kept & np.isfinite(load)])
        mine = kept & (limiter == name)
        assert np.all(np.minimum(abs(thrust - low), abs(thrust - high))[mine] <= 1e-9 * size)


@cache
def sliding():
    """Return a tipper with a slide, which takes long to define."""

    class Sliding(Tipper):
        """The scissor hoist, a class III group, lifts a body along which a slide is pushed out by a cylinder of its own."""

        way = Stroke(0.2, 1.2)
        H = OnLink("O", "C", OH=0.4)
        M = OnLink("O", "C", OM=1.8 + way)
        push = Cylinder(H, M, bore=50 * mm, rod=30 * mm, works="both")
        push_line = LiftCircuit(push, pressure=180 * bar, relief=200 * bar)

    return Sliding


@for_all("seed", range(1), slow=range(1, 2))
def test_law_of_the_limiter_with_a_group_inside(seed):
    rng = np.random.default_rng(seed)
    names = ["load.mass", "lift.bore", "push.bore", "D.x", "A.y"]
    machine = sliding()().replaced(**{name: sliding()()[name] * rng.uniform(0.99, 1.01) for name in names})
    field = working_field(machine, "M", np.linspace(1.6, 2.9, 5), np.linspace(0.0, 1.6, 5), lifts=[["lift"], ["push"]][seed])
    motion, load, limiter, acting = loaded(field, own_loads(machine))
    assert np.sum(load > 0.0) > 4
    for name, thrust, low, high in forces_and_bounds(field, motion, acting, lambda name: name == ("lift", "push")[seed]):
        size = float(np.max(np.maximum(np.abs(low), np.abs(high))))
        assert np.all(((thrust >= low - 1e-9 * size) & (thrust <= high + 1e-9 * size))[load > 0.0])
        mine = (load > 0.0) & (limiter == name)
        assert np.all(np.minimum(abs(thrust - low), abs(thrust - high))[mine] <= 1e-9 * size)


class Digger(Arm):
    """The arm on a vehicle of two axles."""

    body_place, front_axle, rear_axle = Ground(-0.4, 0.6), Ground(0.5, 0.0), Ground(-1.1, 0.0)
    body = Weight(body_place, mass=700.0)
    front = Support(front_axle, (0, 1), friction=0.5)
    rear = Support(rear_axle, (0, 1), friction=0.5)


WEIGHT = {"body": (700.0, -0.4), "boom_mass": (80.0, "J"), "arm_mass": (45.0, "K")}


def test_tipping_over_the_front_axle_by_hand():
    field = working_field(Digger(), "K", AROUND, UP, rule=LoadRule("own", tipping=0.75, hydraulic=0.9))
    motion, reached = field.motion(), field.reached
    at = {name: motion.x(place) if isinstance(place, str) else place for name, (_, place) in WEIGHT.items()}
    holds = sum(mass * g0 * (0.5 - at[name]) for name, (mass, _) in WEIGHT.items())
    out = motion.x("K") - 0.5
    tips = 0.75 * np.where(out > 0.0, holds / np.where(out > 0.0, out, 1.0), np.inf)
    front = np.isfinite(tips)
    assert_allclose(field.of["tipping"][reached][front], tips[front], rtol=1e-10)
    plain = working_field(Arm(), "K", AROUND, UP)
    assert_allclose(field.of["lifter"][reached], 0.9 * plain.of["lifter"][reached], rtol=1e-10)
    assert "tipping" in field.limiters and np.sum(field.limiter == "tipping") > 5


def test_axle_at_the_limit_bears_nothing_and_supports_bear_all():
    machine = Digger()
    field = working_field(machine, "K", AROUND, UP)
    load = field.load[field.reached]
    own = own_loads(machine)
    found = standing(field.motion(), [*own, Force("K", (0.0, -load))])
    total = sum(mass for mass, _ in WEIGHT.values()) * g0 + load
    assert_allclose(found.reactions["front"] + found.reactions["rear"], total, rtol=1e-12)
    tips = field.limiter[field.reached] == "tipping"
    assert tips.sum() > 5
    assert_allclose(found.reactions["rear"][tips], 0.0, atol=1e-8)
    assert np.all(found.reactions["rear"] > -1e-8)


def test_a_pull_along_the_ground_slips():
    machine = Digger().replaced(**{"lift_line.pressure": 900 * bar, "fold_line.pressure": 900 * bar, "body.mass": 300.0})
    field = working_field(machine, "K", AROUND, [-0.3, 0.0], along=(-1.0, 0.0))
    slips = field.limiter == "slipping"
    assert slips.sum() > 3
    assert_allclose(field.load[slips], 0.5 * (300.0 + 125.0) * g0, rtol=1e-10)
    with_less = working_field(machine, "K", AROUND, [-0.3, 0.0], along=(-1.0, 0.0), rule=LoadRule("own", slipping=0.5))
    assert_allclose(with_less.of["slipping"], 0.5 * field.of["slipping"], rtol=1e-13)


class Outrigged(Digger):
    """On three supports that give way."""

    middle_axle = Ground(-0.2, 0.0)
    front = Support("front_axle", (0, 1), stiffness=4e6)
    rear = Support("rear_axle", (0, 1), stiffness=2e6)
    middle = Support(middle_axle, (0, 1), stiffness=3e6)


def test_three_supports_tip_over_the_outermost():
    two, three = (working_field(each, "K", AROUND, UP) for each in (Digger(), Outrigged()))
    assert_allclose(three.of["tipping"], two.of["tipping"], rtol=1e-10)


def test_what_stands_on_nothing_has_no_field():
    class Floating(Digger):
        body = None

    with pytest.raises(DefinitionError, match="its frame weighs nothing"):
        working_field(Floating(), "K", AROUND, UP)
    with pytest.raises(DefinitionError, match="stands on nothing"):
        working_field(Digger(body_place=(1.5, 0.6)), "K", AROUND, UP)


class Touching(Arm):
    """A post stands in the way of the arm."""

    post = Outline([(1.55, -1.0), (1.65, -1.0), (1.65, 0.3), (1.55, 0.3)])
    planes = Planes("JDK post")


def test_what_touches_lifts_nothing():
    free, found = (working_field(each, "K", AROUND, UP) for each in (Arm(), Touching()))
    motion = Touching().at(**{name: values[found.reached] for name, values in found.strokes.items()})
    touches = motion[clearance()] < 0.0
    assert 3 < touches.sum() < touches.size - 3
    assert np.all(found.load[found.reached][touches] == 0.0) and np.all(found.limiter[found.reached][touches] == "clearance")
    assert_allclose(found.load[found.reached][~touches], free.load[found.reached][~touches], rtol=1e-12)


class Robot(Mechanism):
    """Two cranks, the second one geared to the frame, so that the tip covers a part of a ring."""

    shoulder, elbow = Stroke(10 * deg, 70 * deg), Stroke(20 * deg, 110 * deg)
    O = Ground(0, 0)
    A = Crank(O, OA=1.0, angle=shoulder)
    B = Crank(A, AB=0.8, angle=shoulder + elbow)
    load = Weight(B, mass=10.0)


def test_area_of_all_that_is_reached():
    field = working_field(Robot(), "B", [0.5, 1.0], [1.0, 1.4], limits={"rated load": 2 * kN})
    inner, outer = (1.0 + 0.64 + 1.6 * cos(each * pi / 180.0) for each in (110.0, 20.0))
    # every radius is swept over the same angle of the shoulder
    assert_allclose(field.area, 0.5 * (60.0 * pi / 180.0) * (outer - inner), rtol=1e-12)
    assert_allclose(field.search.reach.area, field.area, rtol=5e-4)
    radius = np.hypot(*field.border.reshape(-1, 2).T)
    assert radius.min() >= inner**0.5 - 1e-6 and radius.max() <= outer**0.5 + 1e-6


def test_further_limits():
    limits = {"rated load": 2 * kN, "moment": drive_force("shoulder") <= 1.5 * kN}
    field = working_field(Robot(), "B", [0.5, 1.0], [1.0, 1.4], limits=limits)
    own = 10.0 * g0 * field.x
    known = np.minimum(2e3, (1.5e3 - own) / field.x)
    assert_allclose(field.load[field.reached], np.broadcast_to(known, field.load.shape)[field.reached], rtol=1e-9)
    assert set(field.limiters) <= {"rated load", "moment", "out of reach"}


def test_slope_of_a_load_case_turns_the_own_weights_alone():
    class Sloping(Excavator):
        dig = None
        uphill = LoadCase("uphill", slope=10 * deg)

    level, steep = (working_field(Sloping(), "L", RADII, HEIGHTS, hold={"S3": 0.2}, case=case) for case in (None, "uphill"))
    assert steep.case == "uphill" and np.nanmax(np.abs(level.load - steep.load)) > 10.0


@for_all(
    ("given", "words"),
    [
        ({"x": []}, "it has no number"),
        ({"x": "far"}, "numbers in a row"),
        ({"y": [1.0, np.nan]}, "numbers in a row"),
        ({"y": [1.0, 1.0]}, "twice"),
        ({"x": np.linspace(0, 1, 10**4), "y": np.linspace(0, 1, 10**3)}, "10000000 cells"),
        ({"point": "B"}, "stands still"),
        ({"point": "Q"}, "Q"),
        ({"along": (0, 0)}, "is no direction"),
        ({"hold": {"S4": 1.0}}, "S4"),
        ({"hold": {"S1": 0.1, "S3": 0.1}}, "x, y take 2 strokes, and S2 may move; hold less"),
        ({"keep": [Target("S3", 0.1)]}, "x, y and 1 kept value take 3 strokes, and S1, S2 may move"),
        ({"rule": "ISO 1"}, "ISO 1"),
        ({"rule": 0.9}, "a LoadRule is expected"),
        ({"lifts": ["wheel"]}, "wheel"),
        ({"lifts": ["boom_mass"]}, "no pressure to lift with"),
        ({"without": ["wheel"]}, "wheel"),
        ({"limits": {"rated load": [1.0]}}, "a load or a comparison"),
        ({"limits": {"rated load": -1.0}}, "below zero"),
        ({"limits": {"boom": 1.0}}, "limiter already"),
        ({"keep": "tilt"}, "a list of targets"),
        ({"case": "uphill"}, "uphill"),
        ({"over": "loading"}, "ranges of strokes are expected"),
        ({"over": {"S4": (0.0, 1.0)}}, "S4"),
        ({"over": Over.path(S1=[0.1, 0.2])}, "ranges of strokes are expected"),
        ({"over": Over(only=[x("L") <= 2.0])}, "limits="),
        ({"over": Over(cases=["plain"])}, "case="),
    ],
)
def test_what_a_field_refuses(given, words):
    usual = {"point": "L", "x": RADII, "y": HEIGHTS, **ALONE}
    with pytest.raises(DefinitionError, match=words):
        working_field(Excavator(), **{**usual, **given})


@pytest.mark.parametrize("given", [{"hydraulic": 1.2}, {"tipping": 0.0}, {"pressure": -0.1}, {"slipping": "half"}, {"tipping": 75}])
def test_what_a_rule_refuses(given):
    with pytest.raises(DefinitionError, match="above 0 and not above 1"):
        LoadRule("own", **given)


def test_what_has_no_bounds_has_no_field():
    with pytest.raises(DefinitionError, match="nothing says what the machine carries"):
        working_field(Robot(), "B", [1.0], [1.0])
    with pytest.raises(DefinitionError, match="batch"):
        working_field(Excavator().replaced(**{"boom_mass.mass": np.array([1.0, 2.0])}), "L", [1.0], [1.0])
