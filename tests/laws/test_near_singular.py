"""Next to singular poses nothing is wrong in silence: positions and ratios against sixty digits, errors told against true ones."""

import warnings
from itertools import islice

import mpmath
import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Cylinder, LiftCircuit, pressure, thrust
from linkage import (
    LEFT,
    AssemblyError,
    Crank,
    Dyad,
    Ground,
    Guide,
    Link,
    Mechanism,
    OnGuide,
    OnLink,
    Over,
    Rope,
    SingularError,
    SingularWarning,
    Stroke,
    Weight,
    angle,
    bar,
    deg,
    least,
    mm,
    most,
    pin_forces,
    ratio,
    x,
    y,
)
from tests.for_all import first_daily, for_all

from .exactly import exactly, off, off_by_parts, pins_exactly
from .near_singular import KINDS, pose

SILENT = 1e-6
"""The largest relative error without a warning."""
DAILY, MOST = 1, 6
"""So many poses of each kind are looked at in each run of the suite, and of vectors among so many."""
BESIDE = 16
"""So many of a stroke's last digits on each side show the largest error next to a pose."""


def told(ask):
    """Return what is answered, None where it is refused, and the errors that were told of; nothing warns of a division."""
    with warnings.catch_warnings(record=True) as found, np.errstate(all="warn"):
        warnings.simplefilter("always")
        try:
            answer = ask()
        except AssemblyError:
            answer = None
    assert not any(each.category is RuntimeWarning for each in found), [str(each.message) for each in found]
    return answer, [] if answer is None else [each.message.estimate for each in found if isinstance(each.message, SingularWarning)]


class Truth:
    """A point of a machine and its derivatives by the stroke, in sixty digits."""

    def __init__(self, machine, target):
        self.machine, self.target = machine, target
        ((self.stroke, _),) = machine.plan.strokes.items()

    def inputs(self, value):
        """Return the inputs at a stroke, the pins of groups in sixty digits; None where there is no pose."""
        plan = self.machine.plan
        if not plan.groups:
            return plan.defaults | {self.stroke: value}
        motion, _ = told(lambda: self.machine().at(unreachable="nan", **{self.stroke: value}))
        found = {name: float(np.ravel(part)[0]) for name, part in motion.inputs.items()}
        return pins_exactly(plan, found) if np.isfinite(list(found.values())).all() else None

    def at(self, value, order):
        """Return the point (order 0) or its derivative at a stroke; None where it has none."""
        plan, inputs = self.machine.plan, self.inputs(value)
        nodes = plan.derived(plan.nodes(self.target), (self.stroke,) * order)
        return None if inputs is None else exactly(nodes, inputs)

    def size(self, order):
        """Return what a component of a derivative is compared with where it is smaller: a thousandth of the machine's size a stroke."""
        span = abs(self.machine.plan.strokes[self.stroke].end - self.machine.plan.strokes[self.stroke].start)
        plan = self.machine.plan
        (square,) = exactly([plan.trace.graph.node(plan.trace.extent)], plan.defaults)
        return 1e-3 * float(square) ** 0.5 / span**order

    def worst(self, value, order, size):
        """Return the largest error of a component of what is answered beside a stroke."""
        step, errors = np.spacing(value), []
        for place in range(-BESIDE, BESIDE + 1):
            at = value + place * step
            truth = self.at(at, order)
            found, _ = told(lambda at=at: self.machine().at(unreachable="nan", **{self.stroke: at}).ratio(self.target, order=order))
            if truth is not None and np.isfinite(found).all():
                errors.append(off_by_parts(found, truth, size))
        return max(errors, default=np.nan)


def looked_at(seed, times=30.0):
    """Check one pose; return how each of its results came out: `silent`, `told`, `refused` or `beyond` (no pose there).

    The error told is at the most so many times the true one; where it is more than thirty times that, the outcome is `wide`.
    """
    made = pose(seed)
    if made is None:
        return ["beyond"]
    machine, strokes, target, draft = made
    truth = Truth(machine, target)
    value = strokes[truth.stroke]
    motion, warned = told(lambda: machine().at(**strokes))
    if motion is None:
        return ["refused"]
    place = truth.at(value, 0)
    if place is None:
        return ["beyond"]
    assert np.isfinite(motion[target]).all()
    assert warned or off(motion[target], place, draft.size) <= SILENT
    outcomes = []
    for order in (1, 2):
        exact = truth.at(value, order)
        found, warned = told(lambda order=order: motion.ratio(target, order=order))
        again, also = told(lambda order=order: machine().evaluate([ratio(target, order=order)], **strokes)[0])
        third, _ = told(lambda order=order: machine().function([ratio(target, order=order)])(**strokes))
        assert (found is None) == (again is None) == (third is None)
        if found is None:
            outcomes.append("refused")
            continue
        assert bool(warned) == bool(also)
        assert np.isfinite(found).all()
        size = truth.size(order)
        if not warned:
            assert exact is None or max(off(found, exact, 1e-9 * draft.size), off_by_parts(found, exact, size)) <= SILENT
            outcomes.append("silent")
            continue
        worst = truth.worst(value, order, size)
        assert worst / 3.0 <= max(warned) <= times * worst, (order, max(warned), worst)
        outcomes.append("told" if max(warned) <= 30.0 * worst else "wide")
    return outcomes


@for_all("kind", range(len(KINDS)), ids=[each.__name__ for each in KINDS])
def test_nothing_is_wrong_in_silence_next_to_a_singular_pose(kind):
    outcomes = [each for seed in range(kind, DAILY * len(KINDS), len(KINDS)) for each in looked_at(seed)]
    assert {"refused", "told", "silent"} & set(outcomes)


@pytest.mark.slow
@pytest.mark.parametrize("part", range(30))
def test_nothing_is_wrong_in_silence_next_to_singular_poses(part):
    outcomes = [each for seed in range(1000 + 50 * part, 1050 + 50 * part) for each in looked_at(seed, 100.0)]
    assert {"refused", "told", "silent"} <= set(outcomes)
    assert outcomes.count("wide") <= 2


def verdict(ask):
    """Return whether something is refused, and the largest error that is told of."""
    answer, warned = told(ask)
    return answer is None, max(warned, default=0.0)


def alike(seed):
    """Check that a vector is judged as its worse component is, at one pose; return how it came out, for both orders."""
    made = pose(seed)
    motion = None if made is None else told(lambda: made[0]().at(**made[1]))[0]
    if made is None or motion is None:
        return []
    machine, strokes, target, _ = made
    outcomes = []
    for order in (1, 2):
        asked = [ratio(each, order=order) for each in (target, x(target), y(target))]
        whole, *parts = (verdict(lambda each=each: motion.ratio(each.target, order=each.order)) for each in asked)
        again, *others = (verdict(lambda each=each: machine().evaluate([each], **strokes)) for each in asked)
        for judged, components in ((whole, parts), (again, others)):
            assert judged[0] == any(refused for refused, _ in components), (seed, order, judged, components)
            if not judged[0]:
                assert max(error for _, error in components) / 3.0 <= judged[1] <= 3.0 * max(error for _, error in components)
        outcomes.append("refused" if whole[0] else "told" if whole[1] else "silent")
    return outcomes


@first_daily(1, "most", [1, MOST])
@pytest.mark.parametrize("kind", range(len(KINDS)), ids=[each.__name__ for each in KINDS])
def test_a_vector_is_judged_as_its_worse_component(kind, most):
    """At the first poses there are, at the most so many."""
    assert list(islice(filter(None, map(alike, range(kind, MOST * len(KINDS), len(KINDS)))), most))


@pytest.mark.slow
@pytest.mark.parametrize("part", range(10))
def test_vectors_are_judged_as_their_worse_components(part):
    outcomes = [each for seed in range(1000 + 50 * part, 1050 + 50 * part) for each in alike(seed)]
    assert {"refused", "told", "silent"} <= set(outcomes)


class Toggles(Mechanism):
    """A parallelogram of four hinges next to its flat pose, in which both its loops are in line."""

    phi = Stroke(0.0, 1.0)
    O, C = Ground(0, 0), Ground(2, 0)
    A = Crank(O, OA=1, angle=phi)
    B = Dyad(A, C, AB=2, CB=1, side=LEFT)


@for_all("phi", 10.0 ** -np.arange(1.0, 7.0, 0.25))
def test_a_part_that_is_small_beside_the_other_is_told_by_its_own_error(phi):
    """By hand: B goes round C as A round O, so that B = C + (cos phi, sin phi); its y part is phi times smaller at the second order."""
    for order, truth in ((1, (-np.sin(phi), np.cos(phi))), (2, (-np.cos(phi), -np.sin(phi)))):
        found, warned = told(lambda order=order: Toggles().at(phi=phi).ratio("B", order=order))
        if found is None:
            assert phi < 9e-4
            continue
        error = max(abs(a - b) / max(abs(b), 2e-3) for a, b in zip(found, truth, strict=True))
        assert error <= 3.0 * max(warned, default=1e-6)


def test_the_double_toggle_is_refused_as_its_output_is():
    motion = Toggles().at(phi=1e-4)
    for asked in (lambda: motion.ratio("B", order=2), lambda: motion.ratio(y("B"), order=2), lambda: motion[ratio("B", order=2) * 2.0]):
        with pytest.raises(SingularError, match="refused"):
            asked()
    found, warned = told(lambda: motion.ratio(x("B"), order=2))  # it is exact, and asked for by itself
    assert_allclose(found, -np.cos(1e-4), rtol=1e-12)
    assert max(warned) < 1e-12


class Folded(Mechanism):
    """A cylinder that closes to nothing between its pins, whose lever is as long as the way to the lever's pivot."""

    S = Stroke(0.1, 2.0)
    O, K = Ground(0, 0), Ground(1, 0)
    B = Dyad(K, O, KB=S, OB=1, side=LEFT)


class Propped(Mechanism):
    """Two bars between fixed pins, which one design puts in one place."""

    S = Stroke(0.0, 0.5)
    O, C, D = Ground(0, 0), Ground(2, 0), Ground(3, 1)
    A = Dyad(O, C, OA=1.6 + S, CA=1, side=LEFT)
    B = Dyad(C, D, CB=2, DB=2, side=LEFT)


@for_all("S", [0.0, 1e-300, 1e-12, 1e-6])
def test_a_length_of_nothing_is_a_place_at_every_door(S):
    """By hand: B goes round O, clockwise, by twice the arc sine of half the length."""
    machine, turned = Folded(), -2.0 * np.arcsin(0.5 * S)
    doors = (
        lambda: machine.at(S=S)["B"],
        lambda: machine.evaluate(["B"], S=S)[0],
        lambda: machine.function(["B"])(S),
        lambda: machine.evaluate(["B"], S=[S, 0.5])[0][:, 0],
    )
    for door in doors:
        assert_allclose(told(door)[0], [np.cos(turned), np.sin(turned)], rtol=0, atol=1e-15)


class Railed(Propped):
    """The same points give a guide its direction."""

    rail = Guide("C", "D")
    B = OnGuide(rail, at=0.5)


@for_all("kind", [Propped, Railed])
def test_two_fixed_points_in_one_place_fail_in_words(kind):
    machine = kind(D=(2.0, 0.0))
    (verdict,) = machine.verdicts()
    assert not verdict.ok
    assert "C and D coincide there" in str(verdict)
    assert not machine.at(S=0.1, unreachable="nan").limits()["S"].intervals


class Turned(Mechanism):
    """A crank whose weight a cylinder beside it holds, which stands still where A, O and B are in line."""

    phi = Stroke(0.0, 1.0)
    O, A = Ground(0.0, 0.0), Ground(1.5, 0.1)
    B = Crank(O, OB=0.3, angle=phi)
    load = Weight(B, mass=50)
    ram = Cylinder(A, B, bore=50 * mm, rod=28 * mm, works="both")


def held_by(phi):
    """Return the thrust of the cylinder of `Turned`, in sixty digits."""
    with mpmath.workdps(60):
        u, v = 0.3 * mpmath.cos(phi), 0.3 * mpmath.sin(phi)
        x, y = u - 1.5, v - mpmath.mpf(0.1)
        return float(50 * mpmath.mpf(9.80665) * u * mpmath.hypot(x, y) / (y * u - x * v))


def test_a_cylinder_next_to_its_dead_point_is_right_told_or_refused():
    """The thrust by every door; the error to expect is a number, for programs too."""
    machine, count = Turned(), 0
    doors = (
        lambda motion: motion[thrust("ram")],
        lambda motion: machine.ram.thrust(motion),
        lambda motion: pin_forces(motion).thrusts["ram"],
        lambda motion: machine.evaluate([thrust("ram")], **motion.strokes)[0],
        lambda motion: machine.function([thrust("ram")])(float(motion.strokes["phi"][0])),
    )
    for away in 10.0 ** -np.arange(1.0, 13.0):
        phi = float(np.arctan2(0.1, 1.5)) + away
        for door in doors:
            found, warned = told(lambda door=door, phi=phi: float(np.ravel(door(machine.at(phi=[phi])))[0]))
            count += len(warned)
            if away < 3e-6:
                assert found is None, away
            else:
                assert found == pytest.approx(held_by(phi), rel=max([1e-10, *warned])), away
    assert count >= 6


class Hung(Mechanism):
    """A boom whose arm hangs plumb where it is folded, so that nothing pushes; its load stands along YK, which a chain draws out."""

    lift, psi, t = Stroke(15 * deg, 90 * deg), Stroke(0.0, 180 * deg), Stroke(0.0, 0.6)
    C = Ground(0.0, 2.95)
    J = Crank(C, CJ=4.5, angle=90 * deg - lift)
    K = Crank(J, JK=3.1, angle=angle(J, C) + psi)
    D = OnLink(J, K, JD=3.0 + t)
    X = OnLink(J, K, JX=1.0)
    chain = Rope(X, D, "Y", length=3.0)
    Y = OnLink(J, K, JY=3.0 + t - chain.last)
    T = OnLink(Y, K, YT=2.5)
    outer = Link(Y, T)
    A, B = OnLink(C, J, CA=4.0), OnLink(J, K, JB=0.4)
    load = Weight(T, mass=10000)
    push = Cylinder(X, D, bore=80 * mm, rod=50 * mm, works="both")
    fold = Cylinder(A, B, bore=90 * mm, rod=50 * mm, works="both")
    line = LiftCircuit(fold, pressure=200 * bar)


def test_loads_that_cancel_are_zero_at_every_door_however_short_a_direction_is():
    machine = Hung()

    def folded(short):
        return {"lift": 15 * deg, "psi": 15 * deg, "t": 0.55 - 0.5 * short}

    with warnings.catch_warnings(action="ignore"):
        for asked in (thrust("fold"), pressure("fold")):
            (bulk,) = machine.evaluate([asked], **{name: np.full(3, value) for name, value in folded(1e-4).items()})
            one = [machine.at(**folded(1e-4))[asked], machine.evaluate([asked], **folded(1e-4))[0]]
            assert_allclose([*bulk, *one], 0.0, atol=1e-6 if asked.measures == "force" else 1e-3)
        poses = Over.poses(**{name: [value, value] for name, value in folded(1e-4).items()})
        for found in machine.answers([most(pressure("fold")) <= 1 * bar, least(thrust("fold")) >= -1.0], over=poses):
            assert found.ok and not found.lost
        for asked in (thrust("fold"), pressure("fold")):
            with pytest.raises(SingularError, match=r"fold.* is refused at .*: T = .* takes a direction"):
                machine.evaluate([asked], **folded(1e-9))
