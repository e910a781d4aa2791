"""The judge under attack: poles, NaN, infinities, lost places, compound measures and batches, against what brute force gives."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Cylinder, LiftCircuit, Telescope, buckling, capacity, pressure, reserve, thrust
from linkage import (
    RIGHT,
    Acting,
    Crank,
    Dyad,
    Ground,
    LoadCase,
    Mechanism,
    OnLink,
    Over,
    PinFriction,
    Stroke,
    Weight,
    at,
    drive_force,
    least,
    most,
    pin_force,
    reachable,
    y,
)
from linkage.loads import DIRECTIONS
from linkage.units import bar, deg, kN, mm
from tests.for_all import first_daily, for_all
from tests.linkage.test_judge import Loader, Rocker, Rubbing


class Plane(Mechanism):
    """Two free strokes, so that any function of them is one of the box."""

    u, v = Stroke(0.0, 1.0), Stroke(0.0, 1.0)
    O = Ground(0.0, 0.0)
    A = Crank(O, OA=0.5, angle=u)
    B = Crank(A, AB=0.4, angle=v)


# Functions with infinities, NaN and poles.


def drawn(rng):
    """Return a function of the strokes of which a part may be infinite, NaN, or a pole, and these parts' kinds."""
    middle, wide = rng.uniform(0.1, 0.9, 2), rng.uniform(0.05, 0.3)
    kind = str(rng.choice(["plain", "up", "down", "nan", "pole", "pit", "all up", "all down"]))
    a, b, c = rng.uniform(-3.0, 3.0, 3)

    def f(motion):
        u, v = motion.strokes["u"], motion.strokes["v"]
        away = np.hypot(u - middle[0], v - middle[1])
        smooth = np.sin(a * u + b * v + c)
        with np.errstate(all="ignore"):
            other = {"up": np.inf, "down": -np.inf, "nan": np.nan}.get(kind)
            if other is not None:
                return np.where(away < wide, other, smooth)
            if kind.startswith("all"):
                return np.full(smooth.shape, np.inf if kind == "all up" else -np.inf)
            pole = {"pole": 1.0, "pit": -1.0}.get(kind, 0.0)
            return smooth + (pole / np.abs(u - middle[0]) if pole else 0.0)

    return f, kind


def path_through(middle):
    return Over.path(u=[0.0, middle, 1.0], v=[1.0, middle, 0.0])


@for_all("seed", range(2), slow=range(2, 16))
def test_what_has_no_finite_value_is_never_kept(seed):
    rng = np.random.default_rng(seed)
    functions = [drawn(rng) for _ in range(3)]
    limits = rng.uniform(-2.0, 2.0, 2 * len(functions))
    overs = (None, Over(v=0.4), path_through(0.5), Over.poses(u=np.linspace(0, 1, 41), v=np.linspace(1, 0, 41)))
    for number, over in enumerate(overs):
        questions = [
            question
            for (f, _), low, high in zip(functions, limits[::2], limits[1::2], strict=True)
            for question in (least(f) >= low, most(f) <= high)
        ]
        answers = Plane().answers(questions, over=over)
        t = np.linspace(0.0, 1.0, 641)
        held, back = np.full(t.shape, 0.4), np.linspace(1.0, 0.0, 41)
        places = (None, {"u": t, "v": held}, {"u": t, "v": 1.0 - t}, {"u": 1.0 - back, "v": back})[number]
        poses = Plane().sweep(u=161, v=161) if places is None else Plane().at(**places)
        for k, ((f, kind), low, high) in enumerate(zip(functions, limits[::2], limits[1::2], strict=True)):
            seen = f(poses)
            over_pole = number != 3
            lawless = np.isnan(seen).any()
            below, above = (np.fmin.reduce(seen, axis=None), np.fmax.reduce(seen, axis=None))
            below = -np.inf if kind == "pit" and over_pole else below
            above = np.inf if kind == "pole" and over_pole else above
            of_least, of_most = answers[2 * k : 2 * k + 2]
            for answer, expected, limit, sense in ((of_least, below, low, 1.0), (of_most, above, high, -1.0)):
                where = f"{kind} seed {seed} over {number}: {answer!r}"
                if np.isinf(expected):
                    assert answer.value == expected, where
                elif not lawless or not np.isnan(expected):
                    assert sense * answer.value <= sense * expected + 1e-9, where
                    assert abs(answer.value - expected) <= 0.03, where
                kept = bool(not lawless and sense * (expected - limit) >= 0.0)
                if np.isinf(expected) or lawless or abs(expected - limit) > 0.03:
                    assert answer.ok is kept, where


# What measures make of one another, at poses, and of batches.


def test_measures_that_make_no_number_are_not_kept():
    f = least(lambda motion: motion.strokes["u"] - 10.0)
    root, ratio = Plane().answers([f**0.5 >= 1.0, (f - f) / (f - f) >= 1.0])
    assert (root.ok, root.status, ratio.ok, ratio.status) == (False, "lost", False, "lost")
    assert "what is calculated from them has none" in str(root)


@pytest.mark.slow
@pytest.mark.parametrize("machine", [pytest.param(Loader(), marks=pytest.mark.slow), Rubbing()])
def test_measures_of_a_cylinder_and_of_all_pins_combine(machine):
    over, two = Over.poses(S=[0.0, 0.1, 0.3], T=[0.1, 0.1, 0.1]), [most(pin_force("O", "OBC")), most(thrust("lift"))]
    parts = []
    for case in ("plain", "carry", "dig"):
        each_of = [machine.answers(two, over, Acting(case=case, direction=way)) for way in DIRECTIONS]
        rest, *moving = [[float(each.value) for each in found] for found in each_of]
        parts += [rest[0] - rest[1], max(pin for pin, _ in moving) - min(push for _, push in moving)]
    (answer,) = machine.answers([two[0] - two[1]], over)
    assert_allclose(answer.value, max(parts), rtol=1e-9)
    both = machine.answers([least(reserve("lift")) * 1 * kN - two[0] >= 0.0], Over(T=0.1))[0]
    assert both.ok is False and both.case and both.direction in ("extending", "retracting")


def test_a_pose_that_the_question_says_is_asked_there_and_in_all_cases():
    long = Rocker(L0=0.6)
    kept, lost, plain = long.answers([at(y("B"), S=0.1) <= 10.0, at(y("B"), S=0.39) <= 10.0, at("L0") <= 10.0])
    assert kept.ok and plain.ok and not kept.lost and lost.ok is False
    assert "S = 390.0 mm" in str(lost) and lost.status == "lost"
    here = at(thrust("lift"), S=0.1, T=0.1)
    alone, everywhere = (Loader().answers([here], over=over)[0] for over in (Over(cases=("dig",), S=(0.0, 0.05)), None))
    assert alone.value == everywhere.value and alone.case == everywhere.case == "carry"


@first_daily(1, "over", [Over(S=(0.0, 0.38)), Over(S=(0.0, 0.38), lost="allowed"), Over.poses(S=[0.0, 0.2, 0.37])])
def test_each_design_of_a_batch_is_judged_by_itself(over):
    lengths = np.array([0.5, 0.53, 0.6, 1.3])
    questions = [most(y("B")) <= 1.4, least(reserve("lift")) >= 1.0, reachable, most(y("B"))]
    together = Rocker(L0=lengths).answers(questions, over=over)
    for number, length in enumerate(lengths):
        for one, each in zip(Rocker(L0=length).answers(questions, over=over), together, strict=True):
            assert (one.ok, one.status) == (each.ok[number], each.status[number]), (length, each.question)
            assert_allclose(each.value[number], one.value, rtol=1e-9)


# Places.


def test_where_nothing_is_asked_nothing_is_said_to_be_kept_or_not():
    over = Over(only=[y("D") >= 50.0])
    (answer,) = Loader().answers([reachable], over=over)
    assert answer.ok is None and answer.status == "nothing left"
    verdicts = Loader().verdicts(over=over)
    assert [each.ok for each in verdicts] == [None] and verdicts[0].startswith("--   assembly: ")


@first_daily(0, "places", [dict(S=[0.1, 0.1], T=[0.05, 0.05]), dict(S=[0.1], T=[0.05]), dict(S=0.1, T=0.05)])
def test_a_path_that_stays_is_the_pose_where_it_stays(places):
    questions = [least(reserve("lift")) >= 1.0, most(pin_force("A")), most(thrust("tilt"))]
    stays, there = (Rubbing().answers(questions, over=over) for over in (Over.path(**places), Over.poses(S=[0.1], T=[0.05])))
    for one, other in zip(stays, there, strict=True):
        assert_allclose(one.value, other.value, rtol=1e-12)
        assert (one.ok, one.case, one.direction, one.drive) == (other.ok, other.case, other.direction, other.drive)


class Jib(Mechanism):
    """A jib that a cylinder holds, which stands still at 122 degrees: in the second of its two places."""

    phi = Stroke(0.0, 150 * deg)
    O, K = Ground(0.0, 1.0), Ground(0.5, 0.2)
    B = Crank(O, OB=0.8, angle=phi)
    T = OnLink(O, B, OT=2.0)
    load = Weight(T, mass=200)
    lift = Cylinder(K, B, bore=80 * mm, rod=45 * mm)
    low, high = Over(phi=(0.0, 40 * deg)), Over(phi=(60 * deg, 150 * deg))


def test_dead_points_of_every_place_are_told_in_whatever_order():
    told = [sorted(each for each in Jib().verdicts(over=overs) if "stands still" in each) for overs in (None, [Jib.high, Jib.low])]
    assert told[0] == told[1] and len(told[0]) == 1 and "phi = 122.01 deg" in told[0][0]
    assert not any("stands still" in each for each in Jib().verdicts(over=Jib.low))
    ends = [Over(phi=(np.arctan2(0.8, -0.5) + off, 140 * deg)) for off in (0.0, 1e-9, -1e-9)]  # where the stroke begins
    assert all(sum("stands still" in each for each in Jib().verdicts(over=end)) == 1 for end in ends)


# Requests and what is calculated from them, in all situations.


class Tipped(Mechanism):
    """A body that tips over its rubbing pin, so that its cylinder pushes and pulls."""

    S = Stroke(0.0, 0.75)
    O, A = Ground(0.0, 0.0), Ground(0.9, -0.1)
    B = Dyad(A, O, AB=0.45 + S, OB=0.8, side=RIGHT)
    G = OnLink(O, B, OG=1.2, BOG=25 * deg)
    load = Weight(G, mass=2000.0)
    half = LoadCase(scale={"load": 0.4}, slope=12 * deg)
    rub = PinFriction(O, coefficient=0.25, radius=50 * mm)
    ram = Cylinder(A, B, bore=80 * mm, rod=45 * mm, works="both")
    pump = LiftCircuit(ram, pressure=160 * bar, back_pressure=4 * bar, mechanical_efficiency=0.92)


class Drawn(Tipped):
    """The same on a cylinder that works with its rod side alone."""

    ram = Cylinder("A", "B", bore=80 * mm, rod=45 * mm, works="rod")


class Staged(Tipped):
    """The same on a telescope."""

    ram = Telescope("A", "B", bores=[90 * mm, 70 * mm], strokes=[0.4, 0.4], closed=0.45)


def of_one_kind(machine, rng):
    """Return two random requests that measure one thing; of a cylinder that works with its rod side both sides count where it is judged."""
    kinds = (
        [thrust("ram"), pin_force("O"), pin_force("B"), drive_force(), capacity("ram", "G")],
        [pressure("ram", side="rod" if machine is Drawn else ""), pressure("ram", side="piston")],
        [buckling("ram"), 0.01 * buckling("ram") + 1.0],
    )
    own = kinds[int(rng.integers(len(kinds)))]
    return tuple(own[int(each)] for each in rng.integers(len(own), size=2))


@for_all(("machine", "seed"), [(Tipped, 0), (Drawn, 1)], slow=[(each, seed) for each in (Tipped, Drawn, Staged) for seed in range(2, 11)])
@pytest.mark.filterwarnings("ignore::linkage.SingularWarning")
def test_an_answer_is_the_worst_of_what_a_motion_gives_in_every_situation(machine, seed):
    rng, design = np.random.default_rng(seed), machine()
    strokes = rng.uniform(0.0, 0.75, 7).tolist()
    motion, judge = design.at(S=strokes), design.judge(over=Over.poses(S=strokes))
    formulas = (np.negative, np.add, np.subtract, np.maximum, np.minimum, np.multiply)
    for _ in range(2):
        formula, given = formulas[int(rng.integers(len(formulas)))], of_one_kind(machine, rng)
        asked = formula(*given[: formula.nin])
        found = [float(answer.value) for answer in judge.answers([least(asked), most(asked)])]
        values = [motion[asked.under(each)] for each in judge.actings(asked)]
        assert_allclose(found, [np.nanmin(values), np.nanmax(values)], rtol=1e-8, atol=1e-9, err_msg=f"{machine.__name__}, {asked}")
