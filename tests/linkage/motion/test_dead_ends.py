"""Strokes that end or begin in a dead point: it is told, and no verdict's mark contradicts its own numbers. Poles are never values."""

import re

import numpy as np
import pytest

from hydraulics import Cylinder, LiftCircuit, reserve, thrust
from linkage import (
    LEFT,
    RIGHT,
    Crank,
    Dyad,
    Force,
    Ground,
    Guide,
    Mechanism,
    OnGuide,
    OnLink,
    Over,
    SingularError,
    SliderDyad,
    Stroke,
    Weight,
    angle,
    distance,
    least,
    most,
    pin_force,
    reachable,
    ref,
    x,
    y,
)
from linkage.units import bar, deg, mm
from tests.for_all import first_daily, for_all


def lever(start, end, frame, arm, bent, sense=1.0):
    """Return a lever on a cylinder whose length goes from `start` to `end`, or back where the sense is -1."""

    class Lever(Mechanism):
        S = Stroke(0.0, end - start)
        O, A = Ground(0, 0), Ground(0, -frame)
        B = Dyad(A, O, AB=(start if sense > 0 else end) + sense * S, OB=arm, side=RIGHT)
        G = OnLink(O, B, OG=1.2 * arm, BOG=bent)
        lid = Weight(G, mass=40)
        act = Cylinder(A, B, bore=25 * mm, rod=12 * mm)
        pump = LiftCircuit(act, pressure=30 * bar, relief=40 * bar)

    return Lever


def contradictions(verdicts):
    """Return the verdicts whose words say the contrary of their mark."""
    found = []
    for each in verdicts:
        text = str(each)
        low = re.search(r"least reserve is (-?[\d.]+)", text)
        held = [float(one) for one in re.findall(r"holds up to (-?[\d.e+]+) bar", text)]
        limit = re.search(r"above the [^\d]*([\d.]+) bar", text)
        push = re.search(r"push with up to (-?[\d.]+)", text)
        if each.rule == "lifting" and low and each.ok is not (float(low[1]) >= 1.0):
            found.append(text)
        if each.rule == "holding" and held and limit and each.ok is not (max(held) <= float(limit[1])):
            found.append(text)
        if push and float(push[1]) < 0.0:
            found.append(text)
    return found


def told(machine):
    """Return the verdicts of a rule on dead points, and that no verdict contradicts itself."""
    verdicts = machine.verdicts()
    assert contradictions(verdicts) == []
    return [each for each in verdicts if each.rule == "dead points"]


@first_daily(1, "seed", range(40))
def test_a_dead_point_at_an_end_is_told_and_no_mark_contradicts_its_words(seed):
    rng = np.random.default_rng(seed)
    frame, arm, bent = rng.uniform(0.3, 0.9), rng.uniform(0.2, 0.9), rng.choice([0.0, rng.uniform(-0.6, 0.6)])
    short, long = abs(frame - arm), frame + arm
    middle = rng.uniform(0.3, 0.7) * (long - short) + short
    start, end = ((middle, long), (short, middle), (short, long))[seed % 3]
    off = rng.choice([0.0, 1e-13, 1e-12, 1e-10, 1e-8, 1e-7])
    machine = lever(start + off * (start == short), end - off * (end == long), frame, arm, bent, rng.choice([-1.0, 1.0]))()
    (verdict,) = told(machine)
    assert verdict.ok is False and "where the stroke ends: no cylinder starts from there" in verdict
    assert verdict.count("B at") == 1 + (seed % 3 == 2)


@first_daily(0, "off", [1e-9, 1e-3, 1e-6])
def test_one_that_ends_beyond_its_dead_point_is_told_as_before(off):
    verdicts = lever(0.5, 0.8 + off, 0.4, 0.4, 0.0)().verdicts()
    assert not verdicts[0].ok and verdicts[0].rule == "assembly" and contradictions(verdicts) == []
    assert any(each.rule == "dead points" and each.ok is False for each in verdicts)


def test_one_that_ends_well_before_its_dead_point_is_told_as_before():
    (verdict,) = told(lever(0.5, 0.79, 0.4, 0.4, 0.0)())
    assert verdict.ok and "none within the stroke; the nearest: of B = Dyad(A, O) at S = 300.0 mm, 10 mm beyond it" in verdict


def test_all_that_ends_at_a_dead_point_is_named_with_the_strokes_that_move_it():
    class Levers(lever(0.5, 0.75, 0.4, 0.4, 0.0)):  # the same triangle again, and one on a base that a crank moves
        psi, E, K = Stroke(0.0, 1.0), Ground(2, 0), Ground(2, -0.4)
        C = Dyad(K, E, KC=0.5 + ref("S"), EC=0.4, side=RIGHT)
        D = Crank("O", OD=0.5, angle=psi)
        F = Dyad("D", "A", DF=0.66 + ref("S"), AF=0.3, side=RIGHT)
        T = OnLink("B", "C", BT=0.1)

    (verdict,) = told(Levers())
    assert "of F = Dyad(D, A) at S = " in verdict and ", with psi = 0.00 deg held" in verdict
    limits = Levers().at(S=0.1, psi=1.0).limits()["S"]
    assert limits.dead_points[-1] == (pytest.approx(0.3), "B, C")
    (verdict,) = told(type("Own", (Levers,), {"D": None, "F": None, "psi": None})())
    assert "of B, C at S = 300.0 mm, 50 mm beyond it" in verdict and "held" not in verdict


@pytest.mark.slow
def test_sliders_cranks_and_batches_end_in_dead_points_too():
    class Slider(Mechanism):
        S = Stroke(0.0, 0.2)
        A = Ground(0, 0.3)
        rail = Guide((0.0, 0.0), angle=0)
        B = SliderDyad(A, rail, AB=0.3 + S, side=RIGHT)

    class Turned(Mechanism):  # a crank that comes to rest where coupler and rocker are in line
        phi = Stroke(20 * deg, float(np.arccos((0.4**2 + 0.5**2 - 0.7**2) / (2 * 0.4 * 0.5))))
        A, D = Ground(0, 0), Ground(0.5, 0)
        B = Crank(A, AB=0.4, angle=phi)
        C = Dyad(B, D, BC=0.4, CD=0.3, side=RIGHT)

    assert told(Slider())[0].ok is False and told(Turned())[0].ok is None
    batch = lever(0.5, 0.8, 0.4, 0.4, 0.3)(OB=np.array([0.42, 0.4, 0.41]))
    (verdict,) = told(batch)
    assert verdict.ok is False and "1 of 3 designs" in verdict and "design 2: B at S = 300.0 mm" in verdict


@for_all(("over", "place"), [(Over.path(S=[0.0, 0.3], T=[0.0, 0.1]), "T = 100.0 mm")], slow=[(Over(), "T =")])
def test_a_box_and_a_path_end_in_dead_points_too(over, place):
    class Boxed(lever(0.5, 0.8, 0.4, 0.4, 0.3)):
        T = Stroke(0.0, 0.1)
        C = Dyad("A", "G", AC=0.7 + T, CG=0.6, side=RIGHT)
        way = over

    (verdict,) = told(Boxed())
    assert verdict.ok is False and f"B at S = 300.0 mm, {place}" in verdict


def test_a_law_without_a_value_at_some_places_fails_in_its_own_words():
    class Gusty(lever(0.5, 0.7, 0.4, 0.4, 0.0)):
        S = Stroke(0.0, 0.2)
        wind = Force("G", (((S - 0.1) ** 2 - 0.02**2) ** 0.5, 0.0))

    verdicts = {each.rule: each for each in Gusty().verdicts()}
    assert not verdicts["lifting"].ok and "it has no value at places that were looked at; elsewhere: at 30 bar" in verdicts["lifting"]
    (answer,) = Gusty().answers([least(reserve("act")) >= 1.0])
    assert answer.ok is False and answer.status == "lost" and "has no value" in str(answer)


def jib(arm, foot, runs):
    """Return a jib on a ram, whose foot a screw sets along an upright rail."""

    class Jib(Mechanism):
        phi, t = Stroke(-80 * deg, 60 * deg), Stroke(0.0, 0.3)
        O, rail = Ground(0, 1.0), Guide(foot, angle=90 * deg)
        K = OnGuide(rail, at=t)
        B = Crank(O, OB=arm, angle=phi)
        T = OnLink(O, B, OT=2.0)
        load = Weight(T, mass=200)
        lift = Cylinder(K, B, bore=80 * mm, rod=45 * mm, works="both")
        pump = LiftCircuit(lift, pressure=180 * bar)
        way = runs

    return Jib()


def fails(machine):
    return {each.rule for each in machine.verdicts() if each.ok is False}


RULES = {"buckling", "holding", "lifting"}


@first_daily(2, "seed", range(12))
def test_a_dead_point_counts_where_the_machine_runs_and_for_the_stroke_that_the_cylinder_holds(seed):
    random = np.random.default_rng(seed)
    arm, foot = random.uniform(0.6, 1.0), (random.uniform(0.4, 0.6), random.uniform(0.1, 0.3))
    dead = float(np.arctan2(foot[1] - 1.0, foot[0]))  # with the foot at t = 0
    held, beyond = {"t": 0.0}, dead + 15 * deg
    assert fails(jib(arm, foot, Over(phi=(dead - 0.1, 0.5), **held))) >= RULES | {"cylinder's dead point"}
    assert not fails(jib(arm, foot, Over(phi=(beyond, 0.5), **held)))
    assert not fails(jib(arm, foot, Over(only=[angle("O", "B") >= beyond, angle("O", "B") <= 0.5], **held)))
    assert not fails(jib(arm, foot, Over.poses(phi=[dead - 0.1, beyond, 0.5], **held)))
    assert not fails(jib(arm, foot, Over(phi=(beyond, 0.5), t=(0.0, 0.05))))
    # a pose that stands in it has no force: no rule over it is kept, and no value is told
    for poses in ([dead], [dead, 0.3]):
        machine = jib(arm, foot, Over.poses(phi=poses, **held))
        assert fails(machine) >= RULES
        forces = machine.evaluate([pin_force("O"), thrust("lift")], phi=np.array([dead, 0.3]), t=0.0, unreachable="nan")
        assert [np.isnan(each).tolist() for each in forces] == [[True, False]] * 2
        with pytest.raises(SingularError):
            machine.evaluate([pin_force("O")], phi=dead, t=0.0)


@first_daily(2, "seed", range(12))
def test_of_a_stroke_that_is_held_only_its_place_counts(seed):
    arm = float(np.random.default_rng(seed).uniform(0.6, 1.0))
    dead = float(np.arctan2(-0.8, 0.5))  # O, K and B in line
    fixed = type(jib(arm, (0.5, 0.2), None))
    alone = type("Alone", (fixed,), {"t": None, "rail": None, "K": Ground(0.5, 0.2)})
    for at in (dead - 0.2, dead + 0.2, 0.3):
        assert not fails(type("Held", (alone,), {"way": Over(phi=at)})())
    assert fails(type("Held", (alone,), {"way": Over(phi=dead)})()) >= {"cylinder's dead point", "holding", "lifting"}


@first_daily(2, "seed", range(12))
def test_a_length_that_stands_still_along_a_screw_is_no_dead_point_of_what_the_cylinder_holds(seed):
    random = np.random.default_rng(seed)
    arm, foot = random.uniform(0.7, 0.9), (random.uniform(0.3, 0.38), 0.2)
    start = -float(np.arcsin((1.0 - foot[1] - 0.26) / arm))  # there the ram lies level where t = 0.26, and does not follow the screw
    machine = jib(arm, foot, Over(phi=(start, 60 * deg)))
    limits = machine.sweep(phi=start, t=5).limits()["t"]
    assert limits.cylinder_dead_points and not fails(machine)
    there = machine.at(phi=start, t=limits.cylinder_dead_points[0][0])
    assert abs(there.ratio(distance("K", "B"), wrt="t")) < 1e-9 and np.isfinite(there[thrust("lift")])


class Rocker(Mechanism):
    S = Stroke(0.0, 1.0)
    O, C = Ground(0, 0), Ground(0.7, 0.1)
    A = Crank(O, OA=0.3, angle=S)
    D = Dyad(A, C, AD=0.6, CD=0.5, side=LEFT)


class Arms(Mechanism):
    u, v = Stroke(-1.0, 1.0), Stroke(-1.0, 1.0)
    O = Ground(0, 0)
    A = Crank(O, OA=0.6, angle=u)
    D = Crank(A, AD=0.4, angle=u + v)


@first_daily(1, "seed", range(30))
def test_a_pole_is_never_told_as_a_value(seed):
    rng = np.random.default_rng(seed)
    machine = (Rocker, Rocker, Rocker, Arms)[seed % 4]()
    wide = 10.0 ** rng.uniform(-5, -0.5)
    over = Over() if isinstance(machine, Arms) else Over(S=(0.1, 0.1 + wide))
    place = {"u": rng.uniform(-0.7, 0.7), "v": rng.uniform(-0.7, 0.7)} if isinstance(machine, Arms) else {"S": 0.1 + wide * rng.random()}
    c = float(machine.at(**place).y("D"))
    asked = [1 / (y("D") - c), abs(x("D") / (y("D") - c)), 1 / (y("D") - c) ** 2, x("D") - 3.0 / (y("D") - c)]
    for question in [*map(most, asked), least(asked[0]), least(asked[3])]:
        (answer,) = machine.answers([question], over=over)
        assert answer.status == "unbounded" and np.isinf(answer.value), (seed, str(question), str(answer))


def test_where_a_pole_is_touched_and_where_a_peak_is_only_steep():
    (top,) = Rocker().answers([most(y("D"))])
    (answer,) = Rocker().answers([most(1 / (float(top.value) - y("D")))])
    assert answer.unbounded
    for soft in (1e-3, 1e-5, 1e-6):
        (answer,) = Rocker().answers([most(lambda at, soft=soft: 1.0 / (np.abs(at.strokes["S"] - 0.4) + soft))])
        assert not answer.unbounded and answer.value == pytest.approx(1.0 / soft, rel=1e-4)
    batch = Rocker(OA=np.array([0.3, 0.31]))
    (answer,) = batch.answers([most(1 / (y("D") - float(Rocker().at(S=0.5).y("D"))))])
    assert answer.unbounded.all() and "without bounds" in str(answer)


def test_a_leg_of_a_path_weighs_by_the_stroke_that_moves_most_on_it():
    class Reaching(Mechanism):
        u, S = Stroke(0.0, 1.0), Stroke(0.0, 0.4)
        O, A = Ground(0, 0), Ground(0, -0.4)
        B = Dyad(A, O, AB=0.5 + S, OB=0.4, side=RIGHT)  # out of reach beyond S = 0.3
        C = Crank(B, BC=0.2, angle=u)
        way = Over.path(u=[0.0, 1.0, 1.0, 0.5], S=[0.0, 0.0, 0.4, 0.4])  # legs of 1, 1 and 1/2: lost are 1/4 and 1/2

    (answer,) = Reaching().answers([reachable])
    assert answer.lost.share == pytest.approx(0.75 / 2.5, abs=1e-3)
