"""Strokes from places: what is put in gives the place, every pose is among the answers for its own place, paths lead back."""

from math import acos, atan2, cos, hypot, pi, sin

import numpy as np
import pytest

from linkage import LEFT, RIGHT, Crank, Dyad, Ground, Mechanism, OnLink, Stroke, Target, angle, strokes_for, x, y
from linkage.errors import AssemblyError, DefinitionError, LinkageError, SingularError, SingularWarning
from linkage.units import deg
from tests.for_all import for_all
from tests.laws.random_machines import random_machine

# -- random machines -----------------------------------------------------------------------------------------


def machine_of(seed):
    found = random_machine(seed).machine()
    return found() if isinstance(found, type) else found


def aims(machine, random):
    """Return coordinates of as many points as there are strokes, which tell them apart."""
    points, poses = [*machine.plan.moving], [random.uniform(0.0, 1.0, 3) for _ in machine.strokes]
    at = {name: each.start + part * (each.end - each.start) for (name, each), part in zip(machine.strokes.items(), poses, strict=True)}
    motion = machine.at(**at)
    for _ in range(20):
        chosen = [(x, y)[random.integers(2)](str(point)) for point in random.choice(points, len(machine.strokes))]
        slopes = np.array([[motion.ratio(each, wrt=name) for name in machine.strokes] for each in chosen]).transpose(2, 0, 1)
        if np.all(np.linalg.cond(slopes) < 1e3):
            return chosen
    raise AssertionError("no points were found that tell the strokes apart")


def size_of(motion):
    places = np.array([motion[name] for name in motion.plan.points])
    return float(np.ptp(places.reshape(-1, 2, motion.reached.size), axis=(0, 2)).max())


@for_all("seed", range(4), slow=range(4, 24))
def test_every_pose_is_among_the_answers_for_its_own_place(seed):
    machine, random = machine_of(seed), np.random.default_rng(seed)
    chosen = aims(machine, random)
    at = {name: random.uniform(*sorted((each.start, each.end)), 4) for name, each in machine.strokes.items()}
    motion = machine.at(**at)
    for pose in range(4):
        targets = [Target(each, float(motion.value(each)[pose])) for each in chosen]
        found = strokes_for(machine, targets)
        assert found.met and np.all(np.diff(found.strokes[:, 0]) >= 0.0)
        span = np.array([abs(each.end - each.start) for each in machine.strokes.values()])
        own = np.array([at[name][pose] for name in machine.strokes])
        assert np.abs((np.asarray(found.strokes) - own) / span).max(axis=1).min() < 1e-7
        again = machine.at(**found.strokes)
        for each, target in zip(chosen, targets, strict=True):
            assert np.abs(again.value(each) - target.value).max() <= 1e-10 * size_of(motion)


@for_all("seed", (1, 4), slow=[2, 5, *(seed for seed in range(6, 16) if seed % 3), 17])
def test_a_path_leads_forth_and_back_on_its_own_branch(seed):
    machine, random = machine_of(seed), np.random.default_rng([seed, 1])
    chosen = aims(machine, random)
    t, names = np.linspace(0.0, 1.0, 21), [*machine.strokes]
    way = {}
    for name, each in machine.strokes.items():
        first, last = random.uniform(0.45, 0.55, 2)
        way[name] = each.start + (each.end - each.start) * (first + (last - first) * t + 0.05 * np.sin(4.0 * t))
    motion = machine.at(unreachable="nan", **way)
    slopes = np.array([[motion.ratio(each, wrt=name) for name in names] for each in chosen]).transpose(2, 0, 1)
    signs = np.sign(np.linalg.det(slopes))
    assert motion.reached.all() and signs.min() == signs.max() and np.linalg.cond(slopes).max() <= 1e3  # one branch all the way
    there_and_back = [Target(each, np.concatenate([motion.value(each), motion.value(each)[::-1]])) for each in chosen]
    found = machine.follow(there_and_back, start={name: float(way[name][0]) for name in names})
    for name, each in machine.strokes.items():
        wanted = np.concatenate([way[name], way[name][::-1]])
        assert np.abs(found.strokes[name] - wanted).max() <= 1e-7 * abs(each.end - each.start)


# -- two cranks ----------------------------------------------------------------------------------------------


def two_cranks(random, first=-pi):
    a, b = random.uniform(0.3, 2.0, 2)

    class Cranks(Mechanism):
        shoulder, elbow = Stroke(first, first + 2.0 * pi), Stroke(first, first + 2.0 * pi)
        O = Ground(0, 0)
        A = Crank(O, OA=a, angle=shoulder)
        B = Crank(A, AB=b, angle=shoulder + elbow)
        turned = angle("A", "B")

    return Cranks(), a, b


def aimed(radius, direction):
    return [Target(x("B"), radius * cos(direction)), Target(y("B"), radius * sin(direction))]


@for_all("first", [-pi, 0.0, 0.5])
@for_all("seed", range(1), slow=range(1, 5))
def test_two_cranks_have_two_branches_inside_the_ring_and_none_outside(seed, first):
    random = np.random.default_rng(seed)
    machine, a, b = two_cranks(random, first)
    for share in (1e-3, *random.uniform(0.0, 1.0, 3), 1.0 - 1e-3):
        radius, direction = abs(a - b) + share * (a + b - abs(a - b)), random.uniform(-pi, pi)
        found = strokes_for(machine, aimed(radius, direction))
        assert found.met and len(found) == 2
        bent = acos((radius**2 - a**2 - b**2) / (2.0 * a * b))
        folds = np.abs((found.strokes["elbow"] + pi) % (2.0 * pi) - pi)
        assert folds == pytest.approx([bent, bent], abs=1e-9)
        assert np.abs(found.misses).max() <= 1e-12
    for radius in (a + b + 1e-3, 2.0 * (a + b), abs(a - b) - 1e-3):
        outside = strokes_for(machine, aimed(radius, random.uniform(-pi, pi)))
        assert not outside.met and len(outside.strokes) == len(outside.condition) == 0
        assert outside.sentence.startswith("No strokes within their ends give x(B) = ")
        assert np.hypot(*outside.misses[0]) == pytest.approx(max(radius - a - b, abs(a - b) - radius), rel=1e-4)


@for_all("direction", [0.0, 0.3, -3.0, pi])
@for_all("first", [-pi, 0.0])
def test_on_the_border_of_the_ring_is_one_branch_with_a_warning(first, direction):
    machine, a, b = two_cranks(np.random.default_rng(7), first)
    for radius in (a + b, abs(a - b)):
        with pytest.warns(SingularWarning, match="at the border of what the strokes reach"):
            found = strokes_for(machine, aimed(radius, direction))
        assert found.met and len(found) == 1 and found.condition[0] > 1e6
        assert "at the border" in found.sentence


def test_angles_count_modulo_a_turn():
    machine, *_ = two_cranks(np.random.default_rng(3))
    places = [Target(x("A"), 0.2)]
    for turns in (-2, 0, 1, 5):
        found = strokes_for(machine, [*places, Target("turned", 0.4 + 2.0 * pi * turns)])
        assert len(found) == 2
        assert machine.at(**found.strokes)["turned"] % (2.0 * pi) == pytest.approx([0.4, 0.4])


def test_a_circle_about_the_first_crank_turns_it_as_far():
    machine, a, b = two_cranks(np.random.default_rng(4))
    t = np.linspace(0.0, 4.0 * pi, 101)
    motion = machine.follow([Target(x("B"), (a + 0.3 * b) * np.cos(t)), Target(y("B"), (a + 0.3 * b) * np.sin(t))])
    assert motion.strokes["shoulder"] - motion.strokes["shoulder"][0] == pytest.approx(t)
    assert np.ptp(motion.strokes["elbow"]) < 1e-9


# -- an excavator, checked by the geometry of triangles -------------------------------------------------------

A_, C_, D_, E_ = (2.05, 0.0), (0.135, -0.264), (1.025, 0.278), (0.977, 0.737)
F_, G_, J_, L_ = (-0.251, 0.158), (-0.134, 0.32), (0.88, 0.0), (1.05, 0.0)
K_, M_ = (-0.014, 0.164), (0.567, 0.0)


def on(first, second, origin, along, name, at):
    """Return the step of a point of a body, from its own axes."""
    turn = atan2(at[1] - origin[1], at[0] - origin[0]) - atan2(along[1] - origin[1], along[0] - origin[0])
    length = hypot(at[0] - origin[0], at[1] - origin[1])
    return OnLink(first, second, **{first + name: length, second + first + name: (turn + pi) % (2.0 * pi) - pi})


class Excavator(Mechanism):
    """A published excavator: its three strokes are the lengths of its cylinders."""

    boom, arm, bucket = Stroke(0.905, 1.305), Stroke(1.046, 1.556), Stroke(0.84, 1.26)
    B, C = Ground(0, 0), Ground(*C_)
    D = Dyad(B, C, BD=hypot(*D_), CD=boom, side=LEFT)
    A = on("B", "D", (0, 0), D_, "A", A_)
    E = on("B", "D", (0, 0), D_, "E", E_)
    F = Dyad(A, E, AF=hypot(*F_), EF=arm, side=RIGHT)
    G = on("A", "F", (0, 0), F_, "G", G_)
    J = on("A", "F", (0, 0), F_, "J", J_)
    L = on("A", "F", (0, 0), F_, "L", L_)
    H = Dyad(G, J, GH=bucket, JH=0.24, side=LEFT)
    K = Dyad(H, L, HK=0.24, LK=hypot(*K_), side=LEFT)
    M = on("L", "K", (0, 0), K_, "M", M_)
    tilt = angle("L", "M")


def placed(origin, turn, at):
    """Return a point of a body in the frame's axes."""
    return origin[0] + cos(turn) * at[0] - sin(turn) * at[1], origin[1] + sin(turn) * at[0] + cos(turn) * at[1]


def away(P, Q):
    return hypot(Q[0] - P[0], Q[1] - P[1])


def corner(P, Q, p, q, side):
    """Return the third corner of a triangle, to the left of P -> Q for side 1.0."""
    d, turn = away(P, Q), atan2(Q[1] - P[1], Q[0] - P[0])
    return placed(P, turn + side * acos((p * p + d * d - q * q) / (2.0 * p * d)), (p, 0.0))


def cylinders(px, py, tilt):
    """Return the three lengths that bring the bucket's tip to a place with a tilt, from triangles alone, the arm's elbow up."""
    L = placed((px, py), tilt, (-M_[0], -M_[1]))
    A = corner((0.0, 0.0), L, A_[0], L_[0], 1.0)
    lift, fold = atan2(A[1], A[0]), atan2(L[1] - A[1], L[0] - A[0])
    D, E = placed((0.0, 0.0), lift, D_), placed((0.0, 0.0), lift, E_)
    F, G, J = (placed(A, fold, each) for each in (F_, G_, J_))
    K = placed(L, tilt, K_)
    H = corner(J, K, 0.24, 0.24, 1.0)
    return away(C_, D), away(E, F), away(G, H)


@for_all("seed", range(2), slow=range(2, 3))
def test_cylinders_of_a_place_are_those_of_its_triangles(seed):
    machine, random = Excavator(), np.random.default_rng(seed)
    for _ in range(5):
        place = random.uniform(1.9, 2.6), random.uniform(-0.9, 0.7), random.uniform(-80.0, -50.0) * deg
        found = strokes_for(machine, [Target(what, value) for what, value in zip((x("M"), y("M"), "tilt"), place, strict=True)])
        wanted = cylinders(*place)
        assert any(np.allclose(row, wanted, rtol=0.0, atol=1e-9) for row in np.asarray(found.strokes)), found


@pytest.mark.parametrize("there", [np.linspace(2.3, 2.3, 101), np.linspace(2.6, 1.9, 101)])
def test_a_level_lift_and_a_grading_path_keep_the_bucket_level(there):
    lifts = there[0] == there[-1]
    heights, tilt = (np.linspace(-0.9, 0.8, 101) if lifts else np.full(101, -0.6)), -65.0 * deg
    motion = Excavator().follow([Target(x("M"), there), Target(y("M"), heights), Target("tilt", tilt)])
    assert motion["M"] == pytest.approx(np.array([there, heights]), abs=1e-10)
    assert motion["tilt"] == pytest.approx(np.full(101, tilt), abs=1e-10)
    wanted = np.array([cylinders(*place, tilt) for place in zip(there, heights, strict=True)]).T
    assert np.array([motion.strokes[name] for name in ("boom", "arm", "bucket")]) == pytest.approx(wanted, abs=1e-9)
    rates = motion.rates_for({"M": (0.0, 0.3) if lifts else (-0.3, 0.0), "tilt": 0.0})
    assert motion.velocity("M", rates) == pytest.approx(np.broadcast_to([[0.0], [0.3]] if lifts else [[-0.3], [0.0]], (2, 101)), abs=1e-12)
    assert motion.velocity("tilt", rates) == pytest.approx(np.zeros(101), abs=1e-12)
    change = {name: np.gradient(values, edge_order=2) for name, values in motion.strokes.items()}
    pace = 0.3 / (abs(heights[-1] - heights[0] if lifts else there[-1] - there[0]) / 100.0)
    for name, rate in rates.items():
        assert rate[1:-1] == pytest.approx(pace * change[name][1:-1], abs=2e-4)


# -- machines that cannot be assembled at many of their strokes -----------------------------------------------


class Rocking(Mechanism):
    """Its loop is closed at a half of the crank's turn; next to its dead points places change as roots do."""

    phi, psi = Stroke(0.0, 2.0 * pi), Stroke(-2.0, 2.0)
    O, C = Ground(0, 0), Ground(0.3, 0)
    A = Crank(O, OA=0.25, angle=phi)
    B = Dyad(A, C, AB=0.2, CB=0.2, side=LEFT)
    P = Crank(B, BP=0.15, angle=psi)


class Wide(Mechanism):
    """A loader's arm and tipping cylinder whose strokes go farther than they can."""

    lift, dump = Stroke(0.70, 1.50), Stroke(0.50, 1.50)
    O, A = Ground(0, 1.5), Ground(0.45, 0.75)
    B = Dyad(O, A, OB=1.1, AB=lift, side=LEFT)
    T = OnLink(O, B, OT=2.4)
    C = OnLink(O, B, OC=1.4, BOC=12 * deg)
    D = Dyad(T, C, TD=0.35, CD=dump, side=RIGHT)
    P = OnLink(T, D, TP=0.8, DTP=-120 * deg)


@pytest.mark.slow
@for_all("kind", [Rocking, Wide])
@for_all("seed", range(2), slow=range(2, 4))
def test_poses_next_to_dead_points_of_loops_are_found_too(kind, seed):
    machine, random = kind(), np.random.default_rng(seed)
    at = {name: random.uniform(each.start, each.end, 16) for name, each in machine.strokes.items()}
    motion = machine.at(unreachable="nan", **at)
    for pose in np.flatnonzero(motion.reached):
        place = motion["P"][:, pose]
        found = strokes_for(machine, [Target(x("P"), float(place[0])), Target(y("P"), float(place[1]))])
        own = np.array([at[name][pose] for name in machine.strokes])
        assert np.abs(np.asarray(found.strokes) - own).max(axis=1).min() < 1e-6, (own, found)
        assert np.abs(machine.at(**found.strokes)["P"] - place[:, None]).max() < 1e-10


# -- where a path ends ---------------------------------------------------------------------------------------


def test_a_path_ends_where_a_stroke_is_past_its_end():
    machine, heights = Excavator(), np.linspace(-1.0, 3.0, 101)
    targets = [Target(x("M"), 2.4), Target(y("M"), heights), Target("tilt", -60.0 * deg)]
    with pytest.raises(AssemblyError, match=r"place (\d+) of 101, [^:]*: arm = [\d.]+ mm is [\d.]+ mm past its end at 1046 mm\.") as told:
        machine.follow(targets)
    assert not isinstance(told.value, SingularError) and 0.0 < told.value.shortfall < 0.02
    first = int(np.argmax(told.value.mask))
    assert f"place {first + 1} of 101, x(M) = 2400 mm, y(M) = {1e3 * heights[first]:.6g} mm" in str(told.value)
    part = machine.follow(targets, unreachable="nan")
    assert np.array_equal(part.reached, ~told.value.mask)
    assert np.isnan(part.strokes["arm"][first]) and part.strokes["arm"][first - 1] > 1.046
    assert part.y("M")[:first] == pytest.approx(heights[:first], abs=1e-10)


def test_a_dead_point_beyond_the_end_of_a_stroke_is_told_as_the_end():
    targets = [Target(x("M"), 2.4), Target(y("M"), [0.0, 6.0]), Target("tilt", -60.0 * deg)]
    with pytest.raises(AssemblyError, match=r"place 2 of 2, .*: on the way there .* is [\d.]+ mm past its end at [\d.]+ mm") as told:
        Excavator().follow(targets)
    assert not isinstance(told.value, SingularError) and told.value.mask.tolist() == [False, True]


def test_a_branch_that_leaves_the_strokes_comes_back_to_them():
    machine, t = Excavator(), np.linspace(0.0, 2.0 * pi, 61)
    heights = 1.35 + 0.4 * np.sin(t)  # the arm's cylinder ends at about 1.68 m
    targets = [Target(x("M"), 2.4), Target(y("M"), heights), Target("tilt", -60.0 * deg)]
    motion = machine.follow(targets, unreachable="nan")
    assert motion.reached[0] and motion.reached[-1] and not motion.reached.all()
    for name, values in motion.strokes.items():
        assert values[0] == pytest.approx(values[-1], abs=1e-9), name


def test_a_path_that_begins_out_of_reach_is_followed_from_where_it_comes_in():
    machine, *_ = two_cranks(np.random.default_rng(3))
    reach = sum(machine.dimensions[name] for name in ("OA", "AB"))
    along = np.linspace(1.2, 0.8, 41) * reach
    path = [Target(x("B"), along), Target(y("B"), 0.1)]
    motion = machine.follow(path, unreachable="nan")
    assert np.array_equal(motion.reached, np.hypot(along, 0.1) <= reach)
    assert motion.x("B")[motion.reached] == pytest.approx(along[motion.reached], abs=1e-10)
    with pytest.raises(AssemblyError, match="place 1 of 41 is not reached: no strokes within their ends give"):
        machine.follow(path)
    nowhere = machine.follow([Target(x("B"), along + reach), Target(y("B"), 0.1)], unreachable="nan")
    assert not nowhere.reached.any()


class CrankRocker(Mechanism):
    """A four-bar driven by its crank."""

    phi = Stroke(0.0, 2.0 * pi)
    O, C = Ground(0, 0), Ground(0.3, 0)
    A = Crank(O, OA=0.1, angle=phi)
    B = Dyad(A, C, AB=0.28, CB=0.2, side=LEFT)
    rock = angle("C", "B")


class RockerCrank(Mechanism):
    """The same one driven by its rocker."""

    psi = Stroke(70 * deg, 110 * deg)
    O, C = Ground(0, 0), Ground(0.3, 0)
    B = Crank(C, CB=0.2, angle=psi)
    A = Dyad(O, B, OA=0.1, AB=0.28, side=LEFT)
    turn = angle("O", "A")


def test_a_path_ends_at_a_dead_point_of_the_drive():
    words = r"place 28 of 31, rock = .* the strokes stand at a dead point of the drive.* of rock short"
    with pytest.raises(SingularError, match=words) as told:
        CrankRocker().follow([Target("rock", np.linspace(1.7, 2.62, 31))])
    straight = acos((0.38**2 + 0.3**2 - 0.2**2) / (2.0 * 0.38 * 0.3)) + pi  # crank and coupler in line
    top = max(float(each) for each in CrankRocker().sweep(721)["rock"])
    assert "phi = 220." in str(told.value) and straight > 0.0 and top < 2.62
    assert told.value.motion.reached.sum() == 27


def test_a_path_ends_at_a_dead_point_of_a_loop():
    begun = float(RockerCrank().at(psi=90 * deg)["turn"])
    words = r"psi = 83\.107\d* deg A = Dyad\(O, B\) stands at a dead point, .* of turn short of it"
    with pytest.raises(SingularError, match=words) as told:
        RockerCrank().follow([Target("turn", begun - np.linspace(0.0, 2.0, 41))], start={"psi": 90 * deg})
    assert told.value.point == "A" and told.value.mask.sum() == 29


def test_the_first_branch_that_goes_all_the_way_is_taken_unless_another_one_is_begun_near():
    machine = CrankRocker()
    both = strokes_for(machine, [Target("rock", 90 * deg)])
    assert len(both) == 2
    path = [Target("rock", np.linspace(90 * deg, 95 * deg, 11))]
    for row in both.strokes:
        assert machine.follow(path, start=row).strokes["phi"][0] == pytest.approx(row["phi"], abs=1e-9)
    assert machine.follow(path).reached.all()


def test_strokes_that_stand_still_are_held():
    machine = Excavator()
    found = strokes_for(machine, [Target(x("M"), 2.6), Target(y("M"), 0.2)], hold={"bucket": 1.0})
    assert found.strokes.keys() == ("boom", "arm", "bucket") and found.strokes["bucket"] == pytest.approx([1.0])
    also = strokes_for(machine, [Target(x("M"), 2.6), Target(y("M"), 0.2), Target("bucket", 1.0)])
    assert np.asarray(also.strokes) == pytest.approx(np.asarray(found.strokes), abs=1e-10)


def test_of_strokes_past_their_ends_the_least_far_is_named():
    class Arm(Mechanism):
        s = Stroke(0.30, 0.40)
        O, C = Ground(0, 0), Ground(0.1, -0.3)
        B = Dyad(O, C, OB=0.25, CB=s, side=RIGHT)
        T = OnLink(O, B, OT=1.0)

    found = strokes_for(Arm(), [Target(y("T"), 0.2)])
    past = Arm().at(s=float(found.sentence.split("s = ")[1].split(" mm")[0]) * 1e-3)
    assert past.y("T") == pytest.approx(0.2, abs=1e-5)
    assert not found.met and f"{1e3 * (float(past.strokes['s']) - 0.4):.4g} mm past its end at 400 mm" in found.sentence
    assert found.nearest["s"] == pytest.approx(0.4) and Arm().at(**found.nearest).y("T") - 0.2 == pytest.approx(found.misses[0, 0])


# -- bad input -----------------------------------------------------------------------------------------------

TIP = [Target(x("M"), 2.0), Target(y("M"), 0.0)]
LEVEL = Target("tilt", 0.0)
WRONG = {
    "one target too few": (dict(targets=TIP), 'hold one of them, hold={"bucket": 1.05}, or give'),
    "one too many": (dict(targets=[*TIP, LEVEL], hold={"arm": 1.2}), "leave out one target"),
    "a fixed point": (dict(targets=[Target(x("B"), 2.0), TIP[1], LEVEL]), "no stroke moves x(B)"),
    "what is held alone": (dict(targets=[Target(x("A"), 1.0), TIP[1]], hold={"boom": 1.1}), "x(A) follows boom alone, which is held"),
    "two of one stroke": (dict(targets=[Target(x("A"), 2.0), Target(y("A"), 0.0), LEVEL]), "x(A) and y(A) follow boom alone"),
    "strokes in a target": (dict(targets=[Target(x("M"), 2.0, boom=1.1), Target(y("M"), 0.0)]), 'held, hold={"boom": 1.1}'),
    "a point": (dict(targets=[Target("M", 2.0), Target("tilt", 0.0)], hold={"boom": 1.1}), 'say which, x("M") or y("M")'),
    "an unknown stroke": (dict(targets=[Target(x("M"), 2.0)], hold={"bom": 1.1}), "Did you mean boom?"),
    "no list": (dict(targets=Target(x("M"), 2.0)), "a list of targets is expected"),
    "no number": (dict(targets=[Target(x("M"), 2.0)], hold={"boom": "1"}), "one number is expected, in SI"),
    "millimetres": (dict(targets=[Target(x("M"), 2.0)], hold={"boom": 1100.0}), "write 1100 * mm if these are millimetres"),
}


@for_all("case", WRONG)
def test_what_cannot_be_is_told_with_its_remedy(case):
    given, words = WRONG[case]
    for ask in (lambda: strokes_for(Excavator(), **given), lambda: Excavator().follow(**given)):
        with pytest.raises(DefinitionError) as told:
            ask()
        assert words in str(told.value)


def test_a_path_is_told_from_a_place():
    machine = Excavator()
    with pytest.raises(DefinitionError, match="one number is expected; a path is followed"):
        strokes_for(machine, [Target(x("M"), [2.0, 2.1]), Target(y("M"), 0.0), Target("tilt", 0.0)])
    with pytest.raises(DefinitionError, match="values of different lengths"):
        machine.follow([Target(x("M"), [2.0, 2.1]), Target(y("M"), np.zeros(3)), Target("tilt", 0.0)])
    with pytest.raises(DefinitionError, match="Along a path it is an array, a number a place"):
        Target(x("M"), [[2.0, 2.1]])
    with pytest.raises(DefinitionError, match=r"start= does not say bucket"):
        machine.follow([Target(x("M"), 2.0), Target(y("M"), 0.0), Target("tilt", 0.0)], start={"boom": 1.1, "arm": 1.2})
    with pytest.raises(DefinitionError, match="give a design of it"):
        strokes_for(Excavator, [])
    with pytest.raises(DefinitionError, match="of one design"):
        strokes_for(CrankRocker(OA=[0.1, 0.11]), [Target("rock", 1.6)])


def test_targets_that_hang_together_do_not_tell_strokes_apart():
    class Twin(Mechanism):
        a, b = Stroke(-1, 1), Stroke(-1, 1)
        O = Ground(0, 0)
        A = Crank(O, OA=1.0, angle=a + b)

    with pytest.raises(DefinitionError, match=r"x\(A\) and y\(A\) hang together at every pose"):
        strokes_for(Twin(), [Target(x("A"), cos(0.3)), Target(y("A"), sin(0.3))])


def test_rates_for_says_what_is_missing():
    motion = Excavator().at(boom=1.1, arm=1.3, bucket=1.0)
    with pytest.raises(DefinitionError, match=r'2 rates for boom and arm and bucket: .* "bucket": 0\.0'):
        motion.rates_for({"M": (0.1, 0.0)})
    with pytest.raises(DefinitionError, match="its two parts are expected"):
        motion.rates_for({"M": 0.1, "tilt": 0.0})
    with pytest.raises(DefinitionError, match="rates by name are expected"):
        motion.rates_for([0.1])
    machine, *_ = two_cranks(np.random.default_rng(1))
    stretched = machine.at(shoulder=0.2, elbow=[0.0, 0.5])
    with pytest.raises(SingularError, match=r"no stroke rates give B .* at a dead point of the drive"):
        stretched.rates_for({"B": (0.1, 0.0)})
    known = machine.at(shoulder=0.2, elbow=[0.0, 0.5], unreachable="nan").rates_for({"B": (0.1, 0.0)})
    assert np.isnan(known["elbow"][0]) and np.isfinite(known["elbow"][1])


def test_rows_of_strokes_go_by_name_and_number():
    found = strokes_for(CrankRocker(), [Target("rock", 90 * deg)])
    rows = found.strokes
    assert rows.shape == (2, 1) and rows[0]["phi"] == rows["phi"][0] == rows[0, 0] and dict(rows[1]) == {"phi": rows[1, 0]}
    assert "phi" in rows and "psi" not in rows and [*rows[0].values()] == [rows[0, 0]] and len(rows[:1]) == 1
    with pytest.raises(DefinitionError, match="Known: phi"):
        rows["psi"]
    assert CrankRocker().at(**rows)["rock"] == pytest.approx([90 * deg, 90 * deg])
    with pytest.raises((ValueError, LinkageError)):
        rows[0, 0] = 1.0
