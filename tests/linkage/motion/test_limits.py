"""How far a mechanism goes: reachable intervals, dead points, change points, assembly modes, closed turns."""

import pickle
import re
import warnings
from contextlib import nullcontext

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Cylinder
from linkage import (
    LEFT,
    RIGHT,
    AssemblyError,
    Crank,
    DefinitionError,
    Dyad,
    Ground,
    Guide,
    Link,
    Mechanism,
    OnGuide,
    OnLink,
    Pin,
    SingularError,
    SingularWarning,
    SliderDyad,
    Spring,
    Stroke,
    angle,
    deg,
    distance,
    drawn,
    reachable,
)
from linkage.documents.outcome import limits_section
from linkage.documents.run import ReportSubject
from linkage.motion.limits import angle_text
from tests.for_all import for_all


class Lift(Mechanism):
    S = Stroke(0.0, 0.25)
    A = Ground(0.20, 0.55)
    O = Ground(0.30, 1.15)
    B = Dyad(A, O, AB=0.5 + S, OB=0.30, side=RIGHT)


class FourBar(Mechanism):
    phi = Stroke(0, 2 * np.pi)
    O = Ground(0, 0)
    C = Ground(4, 0)
    A = Crank(O, OA=1, angle=phi)
    B = Dyad(A, C, AB=3, CB=2.5, side=LEFT)
    rocker = angle(C, B)


class Triad(Mechanism):
    """A platform on three rods, one of them on a crank: a class III group."""

    phi = Stroke(0.0, 0.6)
    O = Ground(0, 0)
    P = Ground(3, 0)
    Q = Ground(1.5, 3)
    A = Crank(O, OA=0.5, angle=phi)
    body = Link("D E F", DE=1, DF=0.9, EF=0.8)
    r1 = Link("A D", AD=0.8)
    r2 = Link("P E", PE=1.0)
    r3 = Link("Q F", QF=1.9)
    D = Pin(near=(1.2, 0.5))
    E = Pin(near=(2.2, 0.5))
    F = Pin(near=(1.6, 1.3))


BASE = float(np.hypot(0.1, 0.6))


def test_the_ends_of_a_stroke_are_the_flat_triangles():
    limits = Lift().sweep(5).limits()["S"]
    (interval,) = limits.intervals
    assert_allclose([interval.low, interval.high], [BASE - 0.3 - 0.5, BASE + 0.3 - 0.5], atol=1e-9)
    assert [step for _, step in limits.dead_points] == ["B", "B"]
    assert 0.1 in interval
    assert 0.5 not in interval


def test_the_least_transmission_angle_is_found_between_the_samples():
    machine = FourBar()
    (extreme,) = machine.sweep(5).limits()["phi"].transmission
    flat = np.arccos((3**2 + 2.5**2 - np.array([5.0, 3.0]) ** 2) / (2 * 3 * 2.5))
    assert_allclose(extreme.angle, np.minimum(flat, np.pi - flat).min(), atol=1e-9)
    assert extreme.joint == "B"


def test_a_rocker_is_reachable_in_two_ranges_of_its_crank():
    limits = FourBar(OA=2.5).sweep(5, unreachable="nan").limits()["phi"]
    reach = np.arccos((2.5**2 + 4**2 - 5.5**2) / (2 * 2.5 * 4))
    assert_allclose([limits.intervals[0].high, limits.intervals[1].low], [reach, 2 * np.pi - reach], atol=1e-9)


def test_a_group_tells_where_it_stops():
    limits = Triad().sweep(5).limits()["phi"]
    (interval,) = limits.intervals
    for end, inside in ((interval.low, 1), (interval.high, -1)):
        assert Triad().at(phi=end + inside * 1e-8)["D"].shape == (2,)
        with pytest.raises(AssemblyError, match="D E F"):
            Triad().at(phi=end - inside * 1e-7)


class Chute(Mechanism):
    """A rod from a post to an inclined rail."""

    S = Stroke(0.0, 1.0)
    O = Ground(0, 0)
    post, rail = Guide(O, angle=90 * deg), Guide(O, angle=10 * deg)
    P = OnGuide(post, at=S)
    X = SliderDyad(P, rail, PX=0.8, side=RIGHT)


@for_all(("machine", "sketch"), [(Lift, 0.1), (FourBar, 1.0), (Chute, 0.1), (Triad, 0.0)])
def test_a_stroke_may_end_where_limits_say_it_ends(machine, sketch):
    """Of designs that come to a dead point, by a seed; the ends are as exact as those of the formulas above."""
    random, ends = np.random.default_rng(3), 0
    ((stroke, _),) = machine.plan.strokes.items()
    grown = 1.7 if machine is FourBar else 1.0
    for _ in range(3):
        design = {name: value * random.uniform(0.97, 1.03) for name, value in machine().dimensions.items() if "." not in name}
        design |= {"OA": design["OA"] * grown} if machine is FourBar else {}
        try:
            found = machine(**design).at(**{stroke: sketch}).limits()[stroke].intervals
        except AssemblyError:
            continue
        (interval,) = (each for each in found if sketch in each)
        low, high = (end if stop else sketch for end, stop in ((interval.low, interval.low_stop), (interval.high, interval.high_stop)))
        ended = type("Ended", (machine,), {stroke: Stroke(low, high), "sketch": drawn(**{stroke: sketch})})(**design)
        assert ended.sweep(5).reached.all()
        ends += bool(interval.low_stop) + bool(interval.high_stop)
    assert ends >= 3


def test_a_group_is_named_by_all_its_pins():
    (interval,) = Triad().sweep(3).limits()["phi"].intervals
    assert interval.high_stop == "the group D E F"
    with pytest.raises(AssemblyError, match=r'^group1 = Group\("D E F"\) cannot be assembled at 1 of 2 strokes'):
        Triad().at(phi=[0.0, interval.high + 0.1])
    with pytest.warns(SingularWarning, match="the group D E F is near a dead point"):
        Triad().at(phi=interval.high - 1e-9).ratio("D")


def test_a_crank_is_read_in_degrees_and_kept_in_radians():
    motion = FourBar(OA=2.5).sweep(5, unreachable="nan")
    limits = motion.limits()["phi"]
    first, reach = str(limits).splitlines()[:2]
    assert first == "phi: declared 0 to 360 deg"
    assert reach == f"  reachable from 0 (looked no farther) to {np.degrees(limits.intervals[0].high):.6g} deg"
    assert " rad" not in str(limits)
    assert limits.unit == "rad" and limits.end == 2 * np.pi


def test_a_stroke_that_is_an_angle_by_its_label_or_by_name_is_read_in_degrees():
    class Turned(Mechanism):
        phi, psi = Stroke(0.0, 1.0), Stroke(0.0, 0.5)
        lag = phi + 0.2
        O, C = Ground(0, 0), Ground(4, 0)
        A = Crank(O, OA=1, angle=lag)
        B = Dyad(A, C, AB=4, CB=2.5, side=LEFT)
        G = OnLink(A, B, AG=1.0, BAG=psi)

    limits = Turned().sweep(phi=3, psi=0.1).limits()
    assert str(limits["phi"]).startswith("phi: declared 0 to 57.2958 deg, with psi = 5.72958 deg held")
    assert str(limits["psi"]).startswith("psi: declared 0 to 28.6479 deg, with phi = 0 deg held")


def test_the_error_tells_how_far_the_stroke_goes():
    with pytest.raises(AssemblyError, match=r"192 mm short of AB.*It goes from S = 0 to 408\.276 mm") as caught:
        Lift().at(S=np.linspace(0, 0.6, 101))
    assert caught.value.point == "B"
    assert_allclose(caught.value.shortfall, 1.1 - 0.3 - BASE, rtol=1e-12)
    assert caught.value.mask.sum() == 32


def test_a_crank_that_cannot_turn_says_where_it_stops():
    with pytest.raises(AssemblyError, match=r"It goes from phi = 0 to 1\.98231 rad, and from phi = 4\.30087 to 6\.28319 rad"):
        FourBar(OA=2.5).sweep(36)


@pytest.mark.parametrize("count", [36, 37, 360, 361])
def test_a_crank_that_turns_ends_where_it_began(count):
    motion = FourBar().sweep(count)
    assert_allclose(motion["B"][:, -1], motion["B"][:, 0], atol=1e-14)
    back = FourBar().at(phi=np.linspace(2 * np.pi, 0, count))
    assert_allclose(back["B"][:, ::-1], motion["B"], atol=1e-15)


# -- change points: the 4-1-3-2 four-bar is flat at phi = pi, where its two branches cross ----------------


@for_all("count", [36, 37, 360, 361, 1001])
def test_a_sweep_over_a_change_point_is_refused_by_name(count):
    with pytest.raises(SingularError, match=r"change point at phi = 3\.14159 rad \(180 deg\): B = Dyad"):
        FourBar(CB=2.0).sweep(count)


@pytest.mark.parametrize("count", [36, 360])
def test_a_flat_parallelogram_is_refused_by_name(count):
    with pytest.raises(SingularError, match=r"change point at phi = 3\.14159"):
        FourBar(AB=4.0, CB=1.0).sweep(count)


def test_the_ratios_beside_a_change_point_are_those_of_its_branches():
    machine = FourBar(CB=2.0)
    for away, warned in ((1e-2, False), (1e-3, False), (1e-4, True), (1e-5, True)):
        for sign, branch in ((-1, 0.689898), (1, -0.289898)):
            pose = machine.at(phi=np.pi + sign * away)
            with pytest.warns(SingularWarning, match="relative error of about") if warned else nullcontext():
                assert_allclose(pose.ratio("rocker"), branch, atol=away**2 * 10 + 2e-6)


@for_all("distance", [10.0**-power for power in range(8, 16)] + [0.0])
def test_at_a_change_point_ratios_are_refused_and_positions_hold(distance):
    pose = FourBar(CB=2.0).at(phi=np.pi - distance)
    assert_allclose(pose.distance("A", "B"), 3.0, rtol=1e-12)
    with pytest.raises(SingularError, match="change point"):
        pose.ratio("rocker")


def test_limits_name_the_change_point():
    limits = FourBar(CB=2.0).at(phi=[1.0, 2.0]).limits()["phi"]
    ((value, step),) = limits.change_points
    assert step == "B"
    assert_allclose(value, np.pi, atol=1e-6)


@pytest.mark.parametrize(
    ("ends", "told"),
    [((0.0, 2 * np.pi), (0.0, np.pi, 2 * np.pi)), ((0.0, 1.0), (0.0,)), ((-1.0, 0.0), (0.0,)), ((1.0, np.pi), (np.pi,)), ((0.1, 3.0), ())],
)
def test_a_stroke_that_begins_or_ends_at_a_change_point_says_so(ends, told):
    """A parallelogram is flat at every half turn."""
    turned = type("Turned", (FourBar,), {"phi": Stroke(*ends)})(AB=4.0, CB=1.0)
    found = [str(each) for each in turned.verdicts() if each.rule == "change points"]
    assert len(found) == bool(told)
    assert not told or re.findall(r"phi = (-?[\d.]+) deg", found[0]) == [f"{np.degrees(each):.2f}" for each in told]


def test_a_dead_point_at_the_end_of_a_sweep_is_no_crossing():
    motion = Lift().at(S=np.linspace(0.0, BASE + 0.3 - 0.5, 51))
    assert_allclose(motion.distance("O", "B"), 0.3, rtol=1e-12)


def test_a_change_point_at_which_another_loop_comes_apart_is_named_too():
    class Twice(Mechanism):
        S = Stroke(1.1, 1.5)
        A, B, F = Ground(-1, 0), Ground(1, 0), Ground(2, 0)
        C = Dyad(A, B, AC=S, BC=S, side=LEFT)
        D = Dyad(C, F, CD=3, FD=1, side=LEFT)  # CF^2 = 3 + S^2: its links are folded at S = 1, below which there is no C

    ((place, step),) = Twice().at(S=1.2).limits()["S"].change_points
    assert step == "D"
    assert_allclose(place, 1.0, atol=1e-9)


# -- assembly modes --------------------------------------------------------------------------------------


def test_all_modes_of_two_dyads_are_listed_the_declared_one_first():
    class Two(FourBar):
        D = OnLink("A", "B", AD=1.0, BAD=0.5)
        E = Ground(2, 4)
        F = Dyad("D", "E", DF=2.0, EF=2.5, side=RIGHT)

    modes = Two().assemblies(phi=1.0)
    assert dict(modes[0].sides) == {"B": LEFT, "F": RIGHT}
    assert len({tuple(mode.sides.items()) for mode in modes}) == len(modes) <= 4
    declared = Two().at(phi=1.0)
    assert_allclose(modes[0].places["F"], declared["F"], atol=1e-15)
    for mode in modes:
        assert_allclose(np.hypot(*np.subtract(mode.places["F"], mode.places["E"])), 2.5, rtol=1e-12)


def test_modes_out_of_reach_are_not_listed():
    assert FourBar(OA=2.5).assemblies(phi=3.0) == []


def test_limits_and_modes_are_of_one_design():
    batch = FourBar(CB=np.array([2.4, 2.5]))
    with pytest.raises(DefinitionError, match="one design"):
        batch.sweep(3).limits()
    with pytest.raises(DefinitionError, match="one design"):
        batch.assemblies()


# -- dead points of cylinders --------------------------------------------------------------------------------


class Boom(Mechanism):
    """A boom on its cylinder, given by its angle."""

    phi = Stroke(-40 * deg, 60 * deg)
    O, A = Ground(0.0, 1.0), Ground(0.5, 0.2)
    B = Crank(O, OB=0.8, angle=phi)
    lift = Cylinder(A, B, bore=0.08, rod=0.045)


class Digger(Boom):
    """An arm on the boom, its angle measured from the boom's; a third cylinder hangs on two points of the boom's and moves nothing."""

    psi = Stroke(-150 * deg, -30 * deg)
    C = OnLink("O", "B", OC=3.0)
    D = OnLink("O", "B", OD=2.0, BOD=15 * deg)
    T = Crank(C, CT=2.0, angle=Boom.phi + psi)
    E = OnLink(C, T, CE=0.5, TCE=160 * deg)
    arm = Cylinder(D, E, bore=0.08, rod=0.045)


def in_line(O, A):
    """Return the two directions of OB in which O, A and B are in line [rad], from 0 to a turn."""
    away = np.arctan2(A[1] - O[1], A[0] - O[0])
    return np.sort(np.array([away, away + np.pi]) % (2.0 * np.pi))


@for_all("seed", range(1), slow=range(1, 8))
def test_a_cylinder_beside_a_crank_has_its_dead_points_where_three_pins_are_in_line(seed):
    rng = np.random.default_rng(seed)
    O, A = rng.uniform(-1.0, 1.0, (2, 2))
    boom = Boom(O=O, A=A, OB=rng.uniform(0.2, 2.0))
    limits = boom.at(phi=0.0).limits()["phi"]
    (interval,) = limits.intervals
    assert not (interval.low_stop or interval.high_stop)  # reach is whole
    values, names = zip(*limits.cylinder_dead_points, strict=True)
    assert names == ("lift", "lift")
    assert_allclose(np.sort(np.array(values) % (2.0 * np.pi)), in_line(O, A), atol=1e-9)
    motion = boom.at(phi=list(values))
    assert_allclose(motion.ratio(distance("A", "B")), 0.0, atol=1e-9)
    lines = str(limits).splitlines()
    assert lines[1].startswith("  reachable all the way")
    assert lines[2:4] == [f"  dead point of lift at phi = {value / deg:.6g} deg: its length stands still" for value in values]


@pytest.mark.parametrize(("start", "end"), [(0.0, 2.0), (0.0, 1.0), (-1.0, 1.0), (-0.25, 1.75)])
def test_a_dead_point_at_an_end_of_the_range_is_listed_once(start, end):
    cls = type("Level", (Boom,), {"phi": Stroke(start * np.pi, end * np.pi), "A": Ground(2.0, 1.0)})
    found = np.array([value for value, _ in cls().at(phi=0.5).limits()["phi"].cylinder_dead_points])
    assert_allclose(np.sort(found / np.pi % 2.0 % (2.0 - 1e-9)), [0.0, 1.0], atol=1e-9)


def test_along_several_strokes_each_cylinder_has_its_own():
    limits = Digger().at(phi=0.3, psi=-1.2).limits()
    assert {name for _, name in limits["phi"].cylinder_dead_points} == {"lift"}
    assert {name for _, name in limits["psi"].cylinder_dead_points} == {"arm"}
    motion = Digger().at(phi=0.3, psi=-1.2)
    for value, _ in limits["psi"].cylinder_dead_points:
        at = Digger().at(phi=0.3, psi=value)
        (cx, cy), (dx, dy), (ex, ey) = (at[name] for name in "CDE")
        assert abs((dx - cx) * (ey - cy) - (dy - cy) * (ex - cx)) < 1e-9
    assert len(limits["psi"].cylinder_dead_points) == 2
    assert np.isfinite(motion.ratio(distance("D", "E"), wrt="phi"))


def test_a_slider_that_turns_back_is_a_dead_point_of_its_cylinder():
    class Press(Mechanism):
        phi = Stroke(0.0, 2 * np.pi)
        O, K = Ground(0.0, 0.0), Ground(-0.5, 0.0)
        rail = Guide((0.0, 0.0), angle=0.0)
        A = Crank(O, OA=0.1, angle=phi)
        B = SliderDyad(A, rail, AB=0.4, side=RIGHT)
        lift = Cylinder(K, B, bore=0.08, rod=0.045)

    found = [value for value, _ in Press().at(phi=0.5).limits()["phi"].cylinder_dead_points]
    assert_allclose(found, [0.0, np.pi], atol=1e-9)


def test_driven_lengths_have_none_and_springs_neither():
    class Driven(Lift):
        ram = Cylinder("A", "B", bore=0.08, rod=0.045)

    class Sprung(Boom):
        lift = Spring("A", "B", stiffness=1e3, free_length=0.5)

    assert Driven().sweep(3).limits()["S"].cylinder_dead_points == ()
    assert Sprung().sweep(3).limits()["phi"].cylinder_dead_points == ()


def test_a_cylinder_beside_the_driven_one_may_stand_still():
    class Beside(Lift):
        G = OnLink("O", "B", OG=1.2, BOG=70 * deg)
        ram = Cylinder("A", "G", bore=0.08, rod=0.045)

    class Never(Lift):
        G = OnLink("O", "B", OG=1.2)
        ram = Cylinder("A", "G", bore=0.08, rod=0.045)

    assert Never().sweep(3).limits()["S"].cylinder_dead_points == ()  # O, A and G are in line where the driven one ends
    ((value, name),) = Beside().sweep(3).limits()["S"].cylinder_dead_points
    at = Beside().at(S=value)
    (ax, ay), (ox, oy), (gx, gy) = (at[point] for point in "AOG")
    assert name == "ram" and abs((ax - ox) * (gy - oy) - (ay - oy) * (gx - ox)) < 1e-9


def test_where_nothing_is_reached_there_is_no_dead_point():
    class Far(Lift):
        phi = Stroke(0.0, 1.0)
        C = Crank("A", AC=0.5, angle=phi)
        ram = Cylinder("O", "C", bore=0.08, rod=0.045)

    limits = Far().at(S=5.0, phi=0.5, unreachable="nan").limits()
    assert limits["phi"].intervals == () and limits["phi"].cylinder_dead_points == ()


@pytest.mark.slow
def test_a_machine_of_hundreds_of_metres_is_told_wherever_it_is_asked():
    """Millimetres that were typed as metres; not so a point far away that only gives a guide its direction."""

    def boom(k, far=0.0):
        class Boom(Mechanism):
            S = Stroke(0.0, 0.2 * k)
            O, A, F = Ground(0.0, 0.0), Ground(0.0, -0.4 * k), Ground(0.0, -(k + far))
            rail = Guide(O, F)
            B = Dyad(A, O, AB=0.5 * k + S, OB=0.4 * k, side=RIGHT)
            C = SliderDyad(B, rail, BC=0.7 * k, side=RIGHT)

        return Boom()

    # by hand, B is at y = -87.5 and x = 390.3; C, 700 from it, on x = 0 at y = -87.5 - 581.1
    words = "At the pose of its sketch it is {} m wide: a plain number is in metres. Write millimetres with their unit, such as 300 * mm."
    for design, told in ((boom(1.0), ""), (boom(1.0, far=1e4), ""), (boom(1000.0), words.format("668.6"))):
        said = [each.sentence for each in design.verdicts() if "wide:" in each.sentence]
        assert said == ([told] if told else [])
        limits = design.sweep(3).limits()
        assert limits.remark == told
        assert told in str(limits)
        assert pickle.loads(pickle.dumps(limits)).remark == told
        with warnings.catch_warnings(record=True) as heard:
            warnings.simplefilter("always")
            design.answers([reachable])
        assert [str(each.message) for each in heard] == ([f"Boom: {told}"] if told else [])


def test_a_machine_whose_sketch_cannot_be_assembled_is_not_called_wide():
    class Short(Mechanism):
        S = Stroke(0.0, 0.4)
        O, A = Ground(0.0, 0.0), Ground(0.0, -0.4)
        B = Dyad(A, O, AB=0.05 + S, OB=0.3, side=RIGHT)

    limits = Short().sweep(5, unreachable="nan").limits()
    assert limits.remark == ""
    assert "wide" not in str(limits)
    assert not [each for each in Short().verdicts() if "wide" in each.sentence]


def test_a_dead_point_has_no_transmission_angle_in_every_text():
    """Where the stroke ends there, and where it lies within; its angle is found to rounding."""
    dead = np.hypot(0.1, 0.6) + 0.30 - 0.5
    for end in (dead, dead + 1e-3):

        class Ends(Lift):
            S = Stroke(0.1, end)

        assert "least transmission angle at B: 0 deg" in str(Ends().sweep(2, unreachable="nan").limits())
        assert any(str(each).startswith("The least transmission angle is 0 deg, of B") for each in Ends().verdicts())
        assert "least transmission angle at B: 0 deg" in str(limits_section(ReportSubject.of(Ends(), {}, 5)).blocks)
    assert [angle_text(each, 4) for each in (1.0 * deg, np.nan)] == ["1 deg", "nan deg"]
