"""Where a group of links is does not depend on what else is asked: many poses or few, any order, either side of the sketch, any start."""

import types

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from linkage import AssemblyError, Crank, Ground, Guide, Link, Mechanism, Pin, Slide, Stroke, drawn
from linkage.assembly import group_continuation, newton
from linkage.program import fixed_backend
from mechanisms.classics.stephenson_three import StephensonThree, StephensonThreeFar
from tests.for_all import first_daily, for_all
from tests.linkage.assembly.test_groups import Platform, platform
from tests.linkage.random_parts import group_parts

LOW, HIGH = np.radians(62.0), np.radians(88.0)


@pytest.mark.slow
def test_many_poses_in_any_order_are_the_few():
    """5000 poses on both sides of the sketch, shuffled, against some of them asked for one by one."""
    random = np.random.default_rng(4)
    values = random.uniform(LOW, HIGH, 5000)
    motion = StephensonThreeFar().at(psi=values)
    for place in random.integers(0, 5000, 8):
        alone = StephensonThreeFar().at(psi=float(values[place]))
        for point in "ABD":
            assert_allclose(motion[point][:, place], alone[point], rtol=0, atol=1e-13)
        assert_allclose(motion.ratio("A")[:, place], alone.ratio("A"), rtol=1e-9)


def test_lengths_hold_over_many_poses():
    """The closed loops themselves, at every one of 3000 poses: the crank is the inverse of the other drive's dyads."""
    phi = np.linspace(np.radians(30.0), np.radians(70.0), 3001)
    psi = StephensonThree().at(phi=phi)["psi"]
    far = StephensonThreeFar().at(psi=psi)
    assert_allclose(far["phi"], phi, rtol=0, atol=1e-11)
    for P, Q in ("OA", "AB", "CB", "AD", "BD", "DF"):
        length = far.distance(P, Q)
        assert_allclose(length, length[0], rtol=1e-12, err_msg=P + Q)


def test_one_pose_and_a_pose_given_twice():
    motion = StephensonThreeFar().at(psi=np.array([1.3, 1.3, 1.2, 1.3]))
    assert_array_equal(motion["B"][:, 0], motion["B"][:, 1])
    assert_array_equal(motion["B"][:, 0], motion["B"][:, 3])
    sketch = StephensonThreeFar.plan.sketch_strokes["psi"]
    at_sketch = StephensonThreeFar().at(psi=np.array([sketch]))
    assert_allclose(at_sketch["B"][:, 0], StephensonThreeFar().at(psi=sketch)["B"], rtol=0, atol=1e-14)


def test_a_path_to_several_strokes_and_designs_at_once():
    """A platform of three cylinders: designs along one axis, poses along the other, each as Newton on its own three coordinates."""
    L1 = np.array([0.49, 0.50, 0.52])
    S1, S2, S3 = np.array([[0.02, -0.03, 0.0], [0.01, 0.04, -0.02], [-0.04, 0.02, 0.03]])
    motion = Platform(L1=L1).at(S1=S1, S2=S2, S3=S3)
    _, middle = platform([0.50, 0.52, 0.48], [0.40, 0.30, 0.3])
    for row, length in enumerate(L1):
        for column, strokes in enumerate(zip(S1, S2, S3, strict=True)):
            u = middle
            for part in np.linspace(0.0, 1.0, 9):
                corners, u = platform(np.array([0.50, 0.52, 0.48]) + part * (np.array([length - 0.50, 0.0, 0.0]) + strokes), u)
            for name, corner in zip("BCD", corners, strict=True):
                assert_allclose(motion[name][:, row, column], [corner.real, corner.imag], rtol=0, atol=1e-11)


@for_all("seed", range(1), slow=range(1, 2))
def test_rough_sketch_leads_to_the_same_pose(seed):
    """Damped steps: pins drawn some centimetres beside their place find it."""
    random = np.random.default_rng(seed)
    places = {"B": (0.40, 0.30), "C": (0.68, 0.40), "D": (0.45, 0.55)}
    rough = {name: Pin(near=tuple(float(part) for part in place + random.uniform(-0.04, 0.04, 2))) for name, place in places.items()}
    machine = type("Rough", (Platform,), rough)
    at = {"S1": 0.02, "S2": -0.01, "S3": 0.03}
    for name in places:
        assert_allclose(machine().at(**at)[name], Platform().at(**at)[name], rtol=0, atol=1e-12)


def test_what_is_missing_at_the_sketch_is_said_as_it_is():
    """A crank of 0.5 m where 0.05 is drawn: the error's length is the message's, and of the mechanism's size."""
    with pytest.raises(AssemblyError, match="cannot be assembled from their sketch at psi = 75 deg") as caught:
        type("Far", (StephensonThreeFar,), {"crank": Link("O A", OA=0.5)})().sweep(3)
    assert 0.05 < caught.value.shortfall < 0.5
    assert f"{caught.value.shortfall * 1e3:.3g} mm are missing" in str(caught.value)


@pytest.mark.slow
def test_end_of_a_group_is_where_the_three_rods_meet_in_a_point():
    """Kinematics by hand: at the end that `limits` tells, the wrenches of the rods on the plate have no inverse; before, they have."""
    (inside,) = (each for each in StephensonThreeFar().sweep(3).limits()["psi"].intervals if 1.3 in each)
    assert inside.low_stop or inside.high_stop

    def lost(psi):
        motion, rows = StephensonThreeFar().at(psi=psi), []
        for pivot, pin in (("O", "A"), ("C", "B"), ("F", "D")):
            u = (motion[pin] - motion[pivot]) / motion.distance(pivot, pin)
            r = motion[pin] - motion["A"]
            rows.append([u[0], u[1], (r[0] * u[1] - r[1] * u[0]) / 0.2])
        return abs(np.linalg.det(rows))

    for end, stop in ((inside.low, inside.low_stop), (inside.high, inside.high_stop)):
        if stop:
            assert lost(end + 1e-8 * (1.3 - end)) < 1e-2 * lost(end + 0.5 * (1.3 - end))
            with pytest.raises(AssemblyError):
                StephensonThreeFar().at(psi=end + 1e-5 * (end - 1.3))


class TwoDrives(StephensonThreeFar):
    """A second stroke: the rod DF is a cylinder."""

    s = Stroke(-0.001, 0.001)
    sketch = drawn(psi=np.radians(75.0), s=0.0)
    rod = Link("D F", DF=0.1006 + s)


def test_many_poses_of_two_strokes_are_the_few():
    """1100 poses, more than are sampled along one stroke: each as alone, its loops closed."""
    random = np.random.default_rng(8)
    psi, s = random.uniform(LOW + 0.05, HIGH - 0.05, 1100), random.uniform(-0.001, 0.001, 1100)
    motion = TwoDrives().at(psi=psi, s=s)
    assert_allclose(motion.distance("D", "F"), 0.1006 + s, rtol=1e-11)
    for place in (0, 511, 1099):
        assert_allclose(motion["B"][:, place], TwoDrives().at(psi=psi[place], s=s[place])["B"], rtol=0, atol=1e-13)
    assert_allclose(motion["B"][:, :1], StephensonThreeFar(DF=0.1006 + s[0]).at(psi=psi[:1])["B"], rtol=0, atol=1e-12)


class Slotted(Mechanism):
    """A slot between two pins of a group glides over a crank's pin: nothing else joins the group to its drive."""

    phi = Stroke(1.2, 1.9)
    sketch = drawn(phi=np.pi / 2)
    O, P, Q = Ground(0.4, 0.3), Ground(-0.5, 0.3), Ground(0.9, 0.0)
    A = Crank(O, OA=0.1, angle=phi)
    slot = Guide("E", "F")
    block = Slide(A, slot)
    plate, r1, r2 = Link("E F", EF=np.hypot(0.8, 0.2)), Link("P E", PE=0.5), Link("Q F", QF=np.hypot(0.1, 0.5))
    E, F = Pin(near=(0.0, 0.3)), Pin(near=(0.8, 0.5))


def test_group_hangs_on_what_slides_in_its_slot():
    assert "phi" in Slotted.plan.reaches("E") & Slotted.plan.reaches("F")
    motion = Slotted().sweep(9)
    along, away = motion["F"] - motion["E"], motion["A"] - motion["E"]
    assert_allclose(along[0] * away[1] - along[1] * away[0], 0.0, rtol=0, atol=1e-13)
    for P, Q, length in (("E", "F", np.hypot(0.8, 0.2)), ("P", "E", 0.5), ("Q", "F", np.hypot(0.1, 0.5))):
        assert_allclose(motion.distance(P, Q), length, rtol=1e-12)
    for point in "EF":
        assert np.hypot(*motion.ratio(point)).max() > 1e-3
        assert_allclose(motion.ratio(point), motion.ratio(point, method="central"), rtol=1e-7, atol=1e-9)


# -- one rule, three back ends ---------------------------------------------------------------------------


def solved(seed, **designs):
    """Return the pins of a random group's fresh class at random strokes, some out of reach, and what is told of them."""
    cls, _ = group_parts(seed)
    (stroke,) = cls.plan.strokes.values()
    values = np.random.default_rng(seed).uniform(2.0 * stroke.start - stroke.end, 2.0 * stroke.end - stroke.start, 40)
    motion = cls(**designs).at(S=values, unreachable="nan")
    pins = np.concatenate([motion[pin] for group in cls.plan.groups.values() for pin in group.pins])
    return pins, motion.reached, repr(motion)


def check_same(found, expected):
    assert_allclose(found[0], expected[0], rtol=0, atol=2e-12)
    assert_array_equal(found[1], expected[1])
    assert found[2] == expected[2]


@first_daily(1, "seed", range(3))
def test_lanes_in_floats_and_in_arrays_are_the_same(seed, monkeypatch):
    in_floats = solved(seed)
    monkeypatch.setattr(group_continuation, "FEW", 0)
    check_same(solved(seed), in_floats)


@first_daily(1, "few", [4, 0])
def test_small_pivots_change_nothing(few, monkeypatch):
    """No pivot is large enough: every step and every clearance falls back on pivots of its own."""
    expected = solved(1)
    monkeypatch.setattr(group_continuation, "FEW", few)
    for name in ("PIVOT", "SURE_PIVOT"):
        monkeypatch.setattr(newton, name, 1e9)
    check_same(solved(1), expected)


def test_all_steps_count_towards_a_compiled_loop(monkeypatch):
    """Short ways to a dead point take many steps, and a step of few lanes costs as much as one of many."""
    steps, work = [0], []
    taken = group_continuation.GroupPath._step

    def counted(path, lanes):
        steps[0] += 1
        taken(path, lanes)

    monkeypatch.setattr(group_continuation.GroupPath, "_step", counted)
    monkeypatch.setattr(group_continuation, "pays_compiled", lambda done, *_: work.append(done))
    machine = StephensonThreeFar(DF=0.1006 + np.linspace(-1e-3, 1e-3, 12))
    for end in (170.0, 171.0):
        machine.at(psi=np.linspace(LOW, np.radians(end), 40), unreachable="nan")
    program = machine.plan.made(("lanes", "group1"), lambda _: None)
    assert steps[0] > 20 and work[-1] > 0.4 * steps[0] * group_continuation.LEAST_LANES * program.work


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(3))
def test_compiled_paths_are_the_same(seed):
    pytest.importorskip("numba")
    expected = solved(seed)
    with fixed_backend("numba"):
        check_same(solved(seed), expected)


@pytest.mark.slow
def test_compiled_paths_of_many_designs_are_the_same():
    pytest.importorskip("numba")
    rods = 0.1006 + np.random.default_rng(1).uniform(-3e-3, 3e-3, 100)
    psi = np.radians(np.linspace(40.0, 110.0, 30))
    expected = StephensonThreeFar(DF=rods).at(psi=psi, unreachable="nan")
    with fixed_backend("numba"):
        found = StephensonThreeFar(DF=rods).at(psi=psi, unreachable="nan")
    assert not expected.reached.all()
    assert_array_equal(found.reached, expected.reached)
    for pin in "ABD":
        assert_allclose(found[pin], expected[pin], rtol=0, atol=2e-12)


def chained_groups(count):
    """Return a class of plates one above the other, each held by three legs on the one below: every plate is a group of its own."""

    def place(letter, k):
        x, y = {"P": (0.3 * (k % 2), 0.0), "Q": (1.0, 0.2), "R": (2.0 - 0.2 * (k % 2), -0.1)}[letter]
        return (x, k + y) if k else ({"P": 0.0, "Q": 1.0, "R": 2.0}[letter], 0.0)

    S = Stroke(0.0, 0.05)
    body = {"S": S} | {f"{letter}0": Ground(*place(letter, 0)) for letter in "PQR"}
    for k in range(1, count + 1):
        body |= {f"{letter}{k}": Pin(near=place(letter, k)) for letter in "PQR"}
        sides = {f"{a}{k}{b}{k}": float(np.hypot(*np.subtract(place(a, k), place(b, k)))) for a, b in ("PQ", "QR", "PR")}
        body[f"plate{k}"] = Link(f"P{k} Q{k} R{k}", **sides)
        for letter in "PQR":
            length = float(np.hypot(*np.subtract(place(letter, k), place(letter, k - 1))))
            given = {f"{letter}{k - 1}{letter}{k}": length + S if (letter, k) == ("P", 1) else length}
            body[f"leg{letter}{k}"] = Link(f"{letter}{k - 1} {letter}{k}", **given)
    return types.new_class(f"Chained{count}", (Mechanism,), {}, lambda space: [space.__setitem__(*each) for each in body.items()])


@pytest.mark.slow
def test_groups_in_a_chain_cost_as_many_solutions_as_there_are_groups(monkeypatch):
    solved, correct = [], newton.Newton.correct
    monkeypatch.setattr(newton.Newton, "correct", lambda *given: solved.append(given[0].group.name) or correct(*given))
    counts = []
    for count in (1, 2, 3):
        solved.clear()
        kind = chained_groups(count)
        assert len(kind.plan.groups) == count
        kind().at(S=[0.01, 0.04])
        counts.append(len(solved))
    assert counts[2] - counts[1] < 1.5 * (counts[1] - counts[0])


def test_groups_in_a_chain_keep_their_lengths():
    kind = chained_groups(3)
    motion = kind().at(S=np.linspace(0.0, 0.05, 9))
    for k in range(1, 4):
        for letter in "PQR":
            length = motion.distance(f"{letter}{k - 1}", f"{letter}{k}") - (motion.strokes["S"] if (letter, k) == ("P", 1) else 0.0)
            assert_allclose(length, length[0], rtol=1e-12)
    alone = np.array([kind().at(S=S)["Q3"] for S in np.linspace(0.0, 0.05, 9)]).T
    assert_allclose(motion["Q3"], alone, rtol=0, atol=1e-12)
