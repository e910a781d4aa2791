"""Parts lists: a thousand random ones, their lengths, ratios and printed plans; and sweeps that keep their branch."""

from itertools import pairwise

import numpy as np
import pytest
from numpy.testing import assert_allclose

import linkage
from linkage import (
    LEFT,
    Crank,
    DefinitionError,
    Dyad,
    Ground,
    Link,
    LoadCase,
    Mechanism,
    OnLink,
    Over,
    Pin,
    Stroke,
    Weight,
    deg,
    drawn,
)
from mechanisms.classics.four_bar import FourBar
from mechanisms.classics.klann import Klann
from mechanisms.classics.stephenson_three import StephensonThree, StephensonThreeFar
from mechanisms.classics.stephenson_two import StephensonTwo, StephensonTwoFar
from tests.for_all import for_all
from tests.linkage.random_parts import dyad_parts, group_parts, span_of

BLOCK = 25


def blocks(every, daily):
    """Return the seeds of each test: the first `daily` in each run of the suite, the others in the soak, up to 25 a test."""
    edges = sorted({0, daily, *range(0, every, BLOCK), every})
    marks = [pytest.mark.slow]
    return [pytest.param(range(a, b), marks=marks if a >= daily else [], id=str(a)) for a, b in pairwise(edges)]


def pasted(machine):
    """Return the class that a printed plan makes when it is pasted back."""
    body = "\n".join(f"    {line}" for line in str(machine.plan).splitlines())
    names = {name: getattr(linkage, name) for name in linkage.__all__}
    names |= {name: getattr(np, name) for name in ("sqrt", "cos", "sin", "tan", "arctan2")}
    exec(f"class Pasted(Mechanism):\n{body}", names)
    return names["Pasted"]


def check_lengths(sheet, motion, tolerance):
    """Assert that every rigid pair keeps its sketched distance and every slide its guide."""
    for P, Q in sheet.pairs:
        assert_allclose(np.hypot(*(motion[Q] - motion[P])), sheet.length(P, Q), rtol=0, atol=tolerance, err_msg=f"{P}{Q}")
    for slide in motion.plan.of_kind(linkage.Slide).values():
        P, Q = through(slide.guide, sheet, motion)
        shoe = motion[slide.point] - P
        away = (shoe[0] * (Q - P)[1] - shoe[1] * (Q - P)[0]) / np.hypot(*(Q - P))
        assert_allclose(away, 0.0, rtol=0, atol=tolerance)


def through(guide, sheet, motion):
    """Return two points of a guide over the motion, from the sheet alone."""
    origin, direction, points = sheet.guides[guide]
    if points:
        return motion[points[0]], motion[points[1]]
    return np.array(origin)[:, None], np.add(origin, direction)[:, None]


def check_ratios(machine, span, orders):
    """Assert that exact derivatives are the numerical ones, at poses inside the stroke."""
    motion = machine().at(S=span * np.array([-0.45, 0.1, 0.5]))
    for point in machine.plan.moving:
        for order, tolerance in zip(orders, (1e-6, 1e-4), strict=False):
            exact, central = motion.ratio(point, order=order), motion.ratio(point, order=order, method="central")
            assert_allclose(central, exact, rtol=tolerance, atol=tolerance * max(1.0, np.abs(exact).max()), err_msg=point)


def check(machine, sheet, tolerance, thoroughly):
    """Check one random mechanism; return False where its sketch stands too near a dead point to say anything."""
    span, motion = span_of(machine)
    if not span:
        return False
    for point, place in sheet.at.items():
        assert_allclose(motion[point][:, 4], place, rtol=0, atol=1e-9, err_msg=f"{point} at the sketch")
    check_lengths(sheet, motion, tolerance)
    check_ratios(machine, span, (1, 2) if thoroughly else (1,))
    other = pasted(machine)().at(S=motion.strokes["S"])
    for point in machine.plan.moving:
        assert_allclose(other[point], motion[point], rtol=0, atol=1e-13, err_msg=point)
    return True


@pytest.mark.parametrize("seeds", blocks(1000, daily=5))
def test_random_dyads(seeds):
    kept = 0
    for seed in seeds:
        machine, sheet = dyad_parts(seed)
        assert not machine.plan.groups, seed
        kept += check(machine, sheet, 1e-12, thoroughly=seed % 10 == 0)
    assert kept >= 0.9 * len(seeds)


@pytest.mark.parametrize("seeds", blocks(1000, daily=2))
def test_random_groups(seeds):
    kept = 0
    for seed in seeds:
        machine, sheet = group_parts(seed)
        assert len(machine.plan.groups) == 1, seed
        kept += check(machine, sheet, 1e-10, thoroughly=seed % 5 == 0)
    assert kept >= 0.7 * len(seeds)


# -- drawings and sketches ------------------------------------------------------------------------------------


class ByHand(Mechanism):
    """A six-bar in steps."""

    S = Stroke(0.0, 0.2)
    A, O, E = Ground(0.2, 0.55), Ground(0.3, 1.15), Ground(0.25, 0.6)
    B = Dyad(A, O, AB=0.5 + S, OB=0.30, side=linkage.RIGHT)
    C = OnLink(O, B, OC=0.36, BC=0.16, side=LEFT)
    D = Dyad(E, C, ED=0.48, CD=0.62, side=linkage.RIGHT)
    F = OnLink(E, D, EF=0.95)


PLACES = {name: tuple(float(part) for part in ByHand().at(S=0.1)[name]) for name in "BCDF"}


def same_motion(machine):
    motion, by_hand = machine().sweep(41), ByHand().sweep(41)
    for name, place in PLACES.items():
        assert_allclose(motion[name], by_hand[name], rtol=0, atol=1e-12)
        assert_allclose(motion.ratio(name), by_hand.ratio(name), rtol=1e-9, atol=1e-10)
        assert np.hypot(*np.subtract(by_hand.plan.trace and ByHand().at(S=0.1)[name], place)) < 1e-15


def test_links_and_pins_are_the_steps():
    class Listed(Mechanism):
        S = Stroke(0.0, 0.2)
        A, O, E = Ground(0.2, 0.55), Ground(0.3, 1.15), Ground(0.25, 0.6)
        cylinder = Link("A B", AB=0.5 + S)
        arm = Link("O B C", OB=0.30, OC=0.36, BC=0.16)
        rod = Link("C D", CD=0.62)
        lower = Link("E D F", ED=0.48, EF=0.95, DEF=0.0)
        B, C, D, F = Pin(near=(0.5, 0.9)), Pin(near=(0.6, 1.0)), Pin(near=(0.7, 0.4)), Pin(near=(1.1, 0.2))

    same_motion(Listed)
    kinds = {name: type(Listed.plan.members[name]).__name__ for name in "BCDF"}
    assert kinds == {"B": "Dyad", "C": "OnLink", "D": "Dyad", "F": "OnLink"}


@pytest.mark.parametrize("labels", [dict(AC=0.5), dict(AB=0.5, BAC=0.1)])
def test_a_label_that_names_other_points_is_told_at_once(labels):
    with pytest.raises(DefinitionError, match=r"rod = Link\(.*the label '\w+' does not fit its points; valid labels: AB/BA\."):

        class Wrong(Mechanism):
            S = Stroke(0.0, 0.1)
            A, O = Ground(0.0, 0.0), Ground(0.4, 0.0)
            rod, arm = Link("A B", **labels), Link("O B", OB=0.3)
            B = Pin(near=(0.3, 0.3))


def test_a_drawing_gives_the_lengths():
    class Drawing(Mechanism):
        S = Stroke(0.0, 0.2)
        sketch = drawn(S=0.1)
        A, O, E = Ground(0.2, 0.55), Ground(0.3, 1.15), Ground(0.25, 0.6)
        cylinder, arm, rod, lower = Link("A B", AB=0.5 + S), Link("O B C"), Link("C D"), Link("E D F")
        B, C, D, F = (Pin(at=PLACES[name]) for name in "BCDF")

    same_motion(Drawing)
    design = Drawing()
    assert_allclose([design["OB"], design["OC"], design["CD"]], [0.30, 0.36, 0.62], rtol=1e-12)
    assert "0.62" in str(Drawing.plan)


def test_steps_drawn_at_a_stroke():
    class Drawing(Mechanism):
        S = Stroke(0.0, 0.2)
        sketch = drawn(S=0.1)
        A, O, E = Ground(0.2, 0.55), Ground(0.3, 1.15), Ground(0.25, 0.6)
        B = Dyad(A, O, AB=0.5 + S, at=PLACES["B"])
        C = OnLink(O, B, at=PLACES["C"])
        D = Dyad(E, C, at=PLACES["D"])
        F = OnLink(E, D, EF=0.95, at=PLACES["F"])

    same_motion(Drawing)


@pytest.mark.parametrize("side", [LEFT, linkage.RIGHT])
def test_near_in_place_of_side(side):
    class Bar(FourBar):
        B = Dyad("A", "C", AB=0.12, CB=0.08, side=side)

    place = tuple(float(part) for part in Bar().at(phi=1.0)["B"] + 0.01)

    class Near(FourBar):
        sketch = drawn(phi=1.0)
        B = Dyad("A", "C", AB=0.12, CB=0.08, near=place)

    assert_allclose(Near().sweep(37)["B"], Bar().sweep(37)["B"], rtol=0, atol=0)


def test_parts_and_steps_mix():
    class Mixed(Mechanism):
        S = Stroke(0.0, 0.2)
        A, O, E = Ground(0.2, 0.55), Ground(0.3, 1.15), Ground(0.25, 0.6)
        B = Dyad(A, O, AB=0.5 + S, OB=0.30, side=linkage.RIGHT)
        C = OnLink(O, B, OC=0.36, BC=0.16, side=LEFT)
        rod, lower = Link("C D", CD=0.62), Link("E D", ED=0.48)
        D = Pin(near=(0.7, 0.4))
        F = OnLink(E, D, EF=0.95)

    same_motion(Mixed)


def test_ternary_side_is_the_sketchs():
    """The third pin of a link given by three lengths lies where the sketch has it, mirrored with it."""

    class Upper(FourBar):
        bar = Link("A B P", AB=0.12, AP=0.07, BP=0.08)
        rocker = Link("C B", CB=0.08)
        sketch = drawn(phi=40 * deg)
        B, P = Pin(near=(0.143, 0.067)), Pin(near=(0.07, 0.09))

    class Lower(Upper):
        P = Pin(near=(0.10, 0.01))

    upper, lower = Upper().sweep(37), Lower().sweep(37)
    assert_allclose(upper["B"], lower["B"], rtol=0, atol=0)
    base = upper["B"] - upper["A"]
    for motion, sign in ((upper, 1), (lower, -1)):
        arm = motion["P"] - motion["A"]
        assert (sign * (base[0] * arm[1] - base[1] * arm[0]) > 1e-4).all()


# -- sweeps keep their branch ---------------------------------------------------------------------------------

CLOSED = [FourBar, Klann, StephensonThree]
SWEPT = [*CLOSED, StephensonThreeFar, StephensonTwo, pytest.param(StephensonTwoFar, marks=pytest.mark.slow)]


@for_all("count", [36, 360])
@for_all("machine", SWEPT)
def test_forward_and_back_returns_to_the_start(machine, count):
    (stroke,) = machine.plan.strokes.values()
    there = np.linspace(stroke.start, stroke.end, count)
    forward, both = machine().at(**{stroke.name: there}), machine().at(**{stroke.name: np.concatenate([there, there[::-1]])})
    for point in machine.plan.moving:
        assert_allclose(both[point], both[point][:, ::-1], rtol=0, atol=1e-13)
        assert_allclose(both[point][:, :count], forward[point], rtol=0, atol=1e-13)
        steps = np.hypot(*np.diff(forward[point], axis=1))
        speed = np.hypot(*forward.ratio(point)) * (there[1] - there[0])
        assert (steps <= 2.0 * np.maximum(speed[1:], speed[:-1]) + 1e-9 + 3.0 * speed.max() / count).all()


@for_all("machine", SWEPT)
def test_coarse_and_fine_sweeps_agree(machine):
    (stroke,) = machine.plan.strokes.values()
    values = np.linspace(stroke.start, stroke.end, 351)
    fine, coarse = machine().at(**{stroke.name: values}), machine().at(**{stroke.name: values[::10]})
    for point in machine.plan.moving:
        assert_allclose(coarse[point], fine[point][:, ::10], rtol=0, atol=1e-12)


@for_all("machine", CLOSED)
@for_all("count", [36, 360])
def test_a_turn_of_the_crank_ends_where_it_began(machine, count):
    motion = machine().at(phi=np.linspace(0.3, 0.3 + 2 * np.pi, count))
    for point in machine.plan.moving:
        assert_allclose(motion[point][:, -1], motion[point][:, 0], rtol=0, atol=1e-13)
    twice = machine().at(phi=np.linspace(-2 * np.pi, 2 * np.pi, 49))
    assert_allclose(twice["B"][:, :25], twice["B"][:, 24:], rtol=0, atol=1e-13)


@for_all("machine", SWEPT)
def test_any_order_and_far_apart(machine):
    """A pose does not know what was asked before it: shuffled, alone, in a matrix, or across the whole stroke."""
    (stroke,) = machine.plan.strokes.values()
    values = np.linspace(stroke.start, stroke.end, 24)
    swept = machine().at(**{stroke.name: values})
    order = np.random.default_rng(1).permutation(24)
    shuffled, matrix = machine().at(**{stroke.name: values[order]}), machine().at(**{stroke.name: values.reshape(4, 6)})
    ends = machine().at(**{stroke.name: values[[23, 0, 23, 11]]})
    for point in machine.plan.moving:
        assert_allclose(shuffled[point], swept[point][:, order], rtol=0, atol=1e-12)
        assert_allclose(matrix[point].reshape(2, -1), swept[point], rtol=0, atol=1e-12)
        assert_allclose(ends[point], swept[point][:, [23, 0, 23, 11]], rtol=0, atol=1e-12)
        assert_allclose(machine().at(**{stroke.name: values[17]})[point], swept[point][:, 17], rtol=0, atol=1e-12)


# -- what cannot be -------------------------------------------------------------------------------------------


def test_a_pin_that_nothing_holds():
    with pytest.raises(DefinitionError, match="nothing holds the pin Z"):
        type("Loose", (FourBar,), {"Z": Pin(near=(0.0, 0.0))})


def test_a_pin_held_too_little():
    with pytest.raises(DefinitionError, match="leave Z free"):
        type("Loose", (FourBar,), {"Z": Pin(near=(0.0, 0.0)), "rod": Link("B Z", BZ=0.1)})


def test_a_sketch_on_the_dead_line():
    line = FourBar().at(phi=0.0)["A"] * 0.0 + [0.12, 0.0]
    with pytest.raises(DefinitionError, match="both poses are equally near"):
        type("Flat", (FourBar,), {"B": Dyad("A", "C", AB=0.12, CB=0.08, near=tuple(float(part) for part in line))})


def test_a_sketch_out_of_reach():
    short = {"B": Pin(near=(0.1, 0.1)), "rod": Link("A B", AB=0.05), "rocker": Link("C B", CB=0.05)}
    with pytest.raises(linkage.AssemblyError, match="cannot be assembled"):
        type("Far", (FourBar,), {"A": Crank("O", OA=0.3, angle=FourBar.phi), **short})


def test_a_drawn_machine_says_where_it_runs_in_its_cases():
    """What runs in a load case waits for it while the sketch is settled, and the case for its loads."""

    class Drawn(Mechanism):
        S = Stroke(0.0, 0.3)
        sketch = drawn(S=0.1)
        O, A = Ground(0.0, 0.0), Ground(0.3, -0.4)
        B, T = Pin(at=(0.5, 0.3)), Pin(at=(1.2, 0.2))
        lever = Link("O B T")
        ram = Link("A B", AB=0.6 + S)
        load = Weight(T, mass=100.0)
        empty = LoadCase("empty", scale={"load": 0.0})
        returning = Over(cases=["empty"])

    assert [each.cases for each in Drawn().overs] == [("empty",)]


def test_links_of_one_body_say_its_lengths_together():
    class Head(Mechanism):
        tilt = Stroke(0.0, 0.30)
        E, B = Ground(1.0, 0.75), Ground(2.0, 0.9)
        K, H = Pin(near=(2.4, 1.3)), Pin(near=(2.15, 0.5))
        head = Link("B H", BH=0.42)
        lug = Link("B K H", BK=0.45, HK=0.80)
        ram = Link("E K", EK=1.05 + tilt)

    motion = Head(BH=0.5).sweep(11)
    for label, length in (("BH", 0.5), ("BK", 0.45), ("HK", 0.8)):
        assert_allclose(motion.distance(*label), length, rtol=1e-12)
    assert Head().mobility == 1 and len(Head().links) == 2
