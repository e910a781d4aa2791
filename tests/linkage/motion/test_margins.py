"""The least margins of loops: holes far narrower than any grid are found, and none where there is none."""


import numpy as np
import pytest

from linkage import LEFT, AssemblyError, Crank, Dimension, Dyad, Ground, Mechanism, Stroke, distance, reachable
from linkage.motion.search import assembly_error_at, least_margins
from mechanisms.classics.stephenson_one import StephensonOne
from tests import shipped
from tests.for_all import for_all


class One(Mechanism):
    """A crank and a fixed pin, joined by two links."""

    u = Stroke(0.0, 1.0)
    a, p = Dimension(0.0), Dimension(1.0)
    O, Q = Ground(0.0, 0.0), Ground(3.0, 0.0)
    A = Crank(O, OA=1.0, angle=a + p * u)
    D = Dyad(A, Q, AD=2.0, QD=2.5, side=LEFT)


class Two(Mechanism):
    """Two cranks whose ends are joined by two links."""

    u, v = Stroke(0.0, 1.0), Stroke(0.0, 1.0)
    a, b, p, q = Dimension(0.0), Dimension(0.0), Dimension(1.0), Dimension(1.0)
    O, Q = Ground(0.0, 0.0), Ground(3.0, 0.0)
    A, B = Crank(O, OA=1.0, angle=a + p * u), Crank(Q, QB=0.7, angle=b + q * v)
    D = Dyad(A, B, AD=2.0, BD=2.5, side=LEFT)


class Three(Mechanism):
    """Two cranks, and a third on one of them, whose ends are joined by two links; another crank rides on their pin."""

    u, v, w = Stroke(0.0, 1.0), Stroke(0.0, 1.0), Stroke(0.0, 1.0)
    a, b, c, p, q, r = Dimension(0.0), Dimension(0.0), Dimension(0.0), Dimension(1.0), Dimension(1.0), Dimension(1.0)
    O, Q = Ground(0.0, 0.0), Ground(3.0, 0.0)
    A, B = Crank(O, OA=1.0, angle=a + p * u), Crank(Q, QB=0.7, angle=b + q * v)
    C = Crank(B, BC=0.5, angle=c + r * w)
    D = Dyad(A, C, AD=2.0, CD=2.5, side=LEFT)
    E = Dyad(D, O, DE=4.0, OE=4.0, side=LEFT)


MACHINES = {1: One, 2: Two, 3: Three}


def hole(seed, k, depth=1.0):
    """Return a machine whose ends are too far apart in a hole at a known place, of 1e-5 to 1e-2 of the strokes, and that place.

    Its points are in line there: it is the place where the ends are farthest from each other. With `depth` below zero there is no hole.
    """
    rng = np.random.default_rng([seed, k])
    at, turns = rng.uniform(0.02, 0.98, k), rng.uniform(0.5, 4.0, k)
    straight = np.array([np.pi, 0.0, 0.0])[:k]
    arms = np.array([1.0, 0.7, 0.5])[:k]
    total = 3.0 + arms.sum()
    bend = arms * (total - arms) / total * turns**2  # of one stroke alone, the others in line: the second derivative of the distance
    width = np.exp(rng.uniform(np.log(1e-5), np.log(1e-2)))
    short = depth * 0.125 * bend.min() * width**2
    share = rng.uniform(0.35, 0.65)
    end = "QBC"[k - 1]
    angles = {"abc"[row]: straight[row] - turns[row] * at[row] for row in range(k)} | {"pqr"[row]: turns[row] for row in range(k)}
    strokes = dict(zip("uvw"[:k], np.meshgrid(*[np.linspace(0.0, 1.0, 9)] * k), strict=True))
    (apart,) = MACHINES[k](**angles).evaluate([distance("A", end)], **strokes)
    reach = 0.4 * apart.min() / total  # links of nearly one length where the ends come close, so that nothing folds elsewhere
    share = float(np.clip(share, 0.5 - reach, 0.5 + reach))
    machine = MACHINES[k](AD=share * (total - short), **{f"{end}D": (1.0 - share) * (total - short)}, **angles)
    return machine.sweep(**dict.fromkeys("uvw"[:k], 2), unreachable="nan"), at, short


def of(found, step="D"):
    """Return the margin of a step's links."""
    return next(each for each in found if each.step == step)


@for_all("seed", range(1), slow=range(1, 568))
@for_all("k", [1, 2, 3])
def test_holes_are_found(seed, k):
    """Each where it is; its machine with the links longer by as much has none."""
    motion, at, short = hole(seed, k)
    found = of(least_margins(motion))
    assert found.is_hole and found.value < 0.0
    assert [found.strokes[name] for name in "uvw"[:k]] == pytest.approx(at, abs=1e-4)
    error = assembly_error_at(motion, found.strokes)
    assert error is not None and error.point == "D" and error.shortfall == pytest.approx(short, rel=0.02, abs=1e-13)
    longer, _, _ = hole(seed, k, depth=-1.0)
    found = of(least_margins(longer))
    assert not found.is_hole and found.value > 0.0


@shipped.over_machines()
def test_no_false_alarm(machine):
    """The shipped machines are assembled over the whole of their strokes, some of them up to a dead point."""
    motion = machine().sweep(**dict.fromkeys(machine.plan.strokes, 5))
    found = least_margins(motion)
    assert not any(each.is_hole for each in found) and not any(each.value < -1e-12 for each in found)
    assert {each.step for each in found} <= set(machine.plan.members)


def test_a_margin_by_hand():
    """The squared sine between the links is least where the ends are farthest from each other, or nearest."""
    motion = One(AD=2.0, QD=2.5, a=0.0, p=3.0).sweep(5)
    (found,) = least_margins(motion)
    turn = np.linspace(0.0, 3.0, 100_001)
    square = 1.0 + 9.0 - 6.0 * np.cos(turn)
    cosine = (4.0 + 6.25 - square) / 10.0
    assert found.value == pytest.approx((1.0 - cosine**2).min(), rel=1e-6) and not found.is_hole
    assert str(found).startswith("the links of D are at least ") and found.units == {"u": "rad"}


def test_margins_of_a_batch_and_of_a_path():
    lengths = np.array([1.6, 2.0, 2.4])
    batch = least_margins(Two(AD=lengths, p=3.0, q=3.0).sweep(u=3, v=3, unreachable="nan"))
    for row, AD in enumerate(lengths):
        (alone,) = least_margins(Two(AD=AD, p=3.0, q=3.0).sweep(u=3, v=3, unreachable="nan"))
        assert batch[0].value[row] == pytest.approx(alone.value, abs=1e-12) and batch[0].is_hole[row] == alone.is_hole
    machine = Two(AD=1.9, QB=0.7, p=np.pi, q=1.0)
    over_box, along_path = (
        least_margins(machine.at(**strokes, unreachable="nan"))[0]
        for strokes in ({"u": [[0.0], [1.0]], "v": [[0.0, 1.0]]}, {"u": [0.0, 1.0], "v": [1.0, 0.0]})
    )  # fmt: skip
    assert over_box.value <= along_path.value


def test_what_is_missing_is_told():
    motion, at, short = hole(5, 2, depth=2000.0)
    (found,) = least_margins(motion)
    error = assembly_error_at(motion, found.strokes)
    assert "D = Dyad(A, B) cannot be assembled at u = " in str(error) and "mm short of AB" in str(error)
    assert assembly_error_at(motion, {"u": 0.0, "v": 0.0}) is None
    assert found.strokes["u"] == pytest.approx(at[0], abs=1e-6) and error.shortfall == pytest.approx(short, rel=1e-3)


@pytest.mark.filterwarnings("ignore::linkage.SingularWarning")
def test_a_place_of_which_rounding_leaves_nothing_is_refused_in_words():
    """Two pins, D and E, some 1e-9 of a length apart carry the dyad F: the kernel refuses what single poses may place by luck."""
    pins = {"O.x": -0.07040283471334927, "O.y": 0.052643158764272904, "C.x": -0.07040283504851487, "C.y": 0.052643158229778095}
    arms = {"OA": 0.08, "OD": 0.030000000123835906, "AOD": -0.807292749188036, "AB": 0.06, "CB": 0.07143855315087186}
    rest = {"CE": 0.03, "BE": 0.04143855315087196, "DF": 0.079727390759203, "EF": 0.07972739073512683, "DP": 0.07}
    machine = StephensonOne(**pins, **arms, **rest, FDP=0.5235987755982988)
    (answer,) = machine.answers([reachable])
    assert answer.ok is False and "F = Dyad(D, E) cannot be assembled" in answer.lost.sentence
    with pytest.raises(AssemblyError, match=r"at a change point at 2000 of 2000 strokes.*lost in rounding"):
        machine.at(phi=np.linspace(3.1431, 3.14315, 2000))
