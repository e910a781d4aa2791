"""How cylinders and points move while a machine runs: speed, rate, power, flow, dynamic factor, and the speed that seals allow."""

import re
from dataclasses import dataclass

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Cylinder, LiftCircuit, OilLine, Pump, Tank, flow, power, rate, thrust
from linkage import (
    RIGHT,
    Crank,
    DefinitionError,
    Dimension,
    Dyad,
    Ground,
    LinkMass,
    Load,
    Mechanism,
    OnLink,
    Over,
    Stroke,
    Weight,
    acceleration,
    dynamic_factor,
    least,
    most,
    plot,
    ramp,
    speed,
)
from linkage.loads import Acting
from linkage.units import bar, litre, minute
from tests.members import told_by

UP = ramp(0.02, 0.28, speed=0.15, acceleration=0.5)


class Arm(Mechanism):
    S = Stroke(0.0, 0.3)
    O, A = Ground(0, 1), Ground(0.3, 0.2)
    B = Dyad(A, O, AB=0.75 + S, OB=0.6, side=RIGHT)
    G = OnLink(O, B, OG=1.5)
    w = Weight(G, mass=400.0)
    own = LinkMass("O B G", mass=60.0)
    lift = Cylinder(A, B, bore=0.08, rod=0.045, works="both", max_speed=0.1)
    line = LiftCircuit(lift, pressure=200 * bar, flow=40 * litre / minute)
    go = Over.path(S=UP.then(-UP + 0.3))


class Lined(Arm):
    lift = Cylinder("A", "B", bore=0.08, rod=0.045, max_speed=0.2)
    line = OilLine(lift.piston_side, Pump(200 * bar))
    back = OilLine(lift.rod_side, Tank())


@dataclass(frozen=True, eq=False)
class Dragged(Weight):
    """A weight that is dragged over ground: against the way it goes, whatever the speed."""

    def moving(self, motion, rates):
        against = -50.0 * np.sign(motion.velocity(self.point, rates))
        return [*super().moving(motion, rates), *([Load(self.point, against)] if rates else [])]


class Dragging(Arm):
    w = Dragged("G", mass=400.0)


ASKED = [speed("G"), acceleration("G"), rate("lift"), power("lift"), flow("line"), dynamic_factor(thrust("lift"))]
PISTON, ANNULUS = np.pi / 4 * 0.08**2, np.pi / 4 * (0.08**2 - 0.045**2)


def test_what_moves_is_told_by_its_formulas_at_every_door():
    arm, motion = Arm(), Arm().sweep(9, over="go")
    v = motion.rates["S"]
    force, still = (thrust("lift", acting=Acting(inertia=which)).of(motion) for which in (None, False))
    wanted = [
        np.hypot(*motion.velocity("G")), np.hypot(*motion.acceleration("G")), v, force * v,
        np.where(v > 0.0, PISTON, -ANNULUS) * v, force / still,
    ]  # fmt: skip
    for request, values in zip(ASKED, wanted, strict=True):
        assert_allclose(motion[request], values, rtol=1e-12, atol=1e-15, err_msg=str(request))
    given = {"rates": motion.rates, "accelerations": motion.accelerations}
    assert_allclose(arm.evaluate(ASKED, S=motion.strokes["S"], **given), wanted, rtol=1e-11, atol=1e-13)
    third = [float(each[2]) for each in (motion.strokes["S"], v, motion.accelerations["S"])]
    assert_allclose(arm.function(ASKED, rates=True, accelerations=True)(*third), np.transpose(wanted)[2], rtol=1e-11)
    assert "p: S, S.rate, S.acceleration;" in arm.source([speed("G"), acceleration("G")], rates=True, accelerations=True)


def test_a_direction_changes_a_thrust_where_a_law_heeds_it():
    still, *ways = (thrust("lift", acting=Acting(direction=way)) for way in ("frictionless", "extending", "retracting"))
    plain, dragging = Arm().sweep(5), Dragging().sweep(5)
    drag = 50.0 * np.abs(dragging.ratio("G", wrt="S")).sum(axis=0)
    for way, sense in zip(ways, (1.0, -1.0), strict=True):
        assert_allclose(plain[way], plain[still], rtol=1e-14)
        assert_allclose(dragging[way] - dragging[still], sense * drag, rtol=1e-9)
        assert_allclose(Dragging().evaluate([way], S=dragging.strokes["S"])[0], dragging[way], rtol=1e-11)


class Swing(Mechanism):
    """A cylinder whose fixed pin places nothing else."""

    phi = Stroke(0.0, 3.0)
    reach = Dimension(0.5)
    O, A = Ground(0, 0), Ground(reach, -0.4)
    B = Crank(O, OB=0.6, angle=phi)
    ram = Cylinder(A, B, bore=0.08, rod=0.045)


def test_another_design_in_one_process_has_dead_points_of_its_own():
    for given in ({}, {"ram.bore": 0.1}, {"A.y": 0.3}, {"reach": 0.2}, {"OB": 0.7}, {}):
        swing = Swing(**given)
        pin = np.arctan2(swing.dimensions["A.y"], swing.dimensions["reach"])
        found = sorted(value for value, _ in swing.at(phi=1.0).limits()["phi"].cylinder_dead_points)
        wanted = sorted(turn for turn in (pin + np.pi * np.arange(-2, 3)) if found[0] - 1e-6 < turn < found[-1] + 1e-6)
        assert_allclose(found, wanted, atol=1e-9, err_msg=str(given))


def test_oil_goes_in_and_comes_back_on_a_line_of_one_side():
    motion = Lined().sweep(9, over="go")
    assert_allclose(motion[flow("line")], PISTON * motion.rates["S"], atol=1e-15)
    assert_allclose(motion[flow("back")], -ANNULUS * motion.rates["S"], atol=1e-15)


def test_answers_and_curves_have_their_units_and_instants():
    texts = [str(each) for each in Arm().answers([most(each) for each in ASKED] + [least(ASKED[-1])], over="go")]
    for text, wanted in zip(texts, ("443.4 mm/s at 1.733 s", "1.508 m/s2", "150 mm/s", " kW at", "45.24 l/min", "1.1", "0.8"), strict=True):
        number, _, rest = wanted.partition(" ")
        assert rest in text and text.startswith(number[:3]), text
    figure = plot(Arm().sweep(9, over="go"), [ASKED[0], ASKED[4]])
    assert [axes.get_title(loc="left") for axes in figure.axes] == ["speed(G), mm/s", "flow(line), l/min"]


def test_seals_that_are_too_slow_are_told_over_paths_in_time_alone():
    def told(machine, **over):
        found = told_by(machine, *machine.plan.of_kind(Cylinder), **over)
        return {verdict.rule: (verdict.ok, str(verdict)) for verdict in found}.get("speed")

    ok, text = told(Arm())
    assert not ok and "lift moves with 150 mm/s" in text and "its seals allow 100 mm/s" in text
    assert told(Lined())[0] and told(Arm(), over=Over()) is None
    # beside an arm that turns, a cylinder that stands still on it moves by rounding alone

    class Folded(Arm):
        U = Stroke(0.0, 0.2)
        E = OnLink("O", "B", OE=0.9, BOE=0.3)
        L = Dyad(E, "G", EL=0.5 + U, GL=0.4, side=RIGHT)
        lift = Cylinder("A", "B", bore=0.08, rod=0.045, works="both")
        fold = Cylinder(E, L, bore=0.05, rod=0.028, max_speed=0.1)
        go = Over.path(S=UP, U=0.1)

    assert told(Folded()) == (True, "ok   speed: fold stands still over the paths in time.")


@pytest.mark.slow
def test_a_pump_that_is_too_small_is_told_over_paths_in_time_alone():
    class Both(Arm):
        line = LiftCircuit("lift", pressure=200 * bar, flow=46 * litre / minute)

    class Quick(Both):
        go = Over.path(S=ramp(0.28, 0.02, speed=0.25, acceleration=0.5))

    def told(machine, **over):
        return {verdict.rule: (verdict.ok, str(verdict)) for verdict in told_by(machine, "line", **over)}["oil"]

    ok, text = told(Arm())
    assert ok is False and "the cylinders take 45.24 l/min, at 0.3 s" in text and "the pump gives 40 l/min." in text
    assert told(Both())[0] and told(Arm(), over=Over())[0] and "s at 40 l/min" in told(Arm(), over=Over())[1]
    taken = ANNULUS * 0.25 / (litre / minute)  # it pulls back: the annulus takes less
    ok, text = told(Quick())
    assert ok is False and f"{taken:.4g} l/min" in text


def test_what_does_not_move_is_refused_in_words():
    arm = Arm()
    for ask, words in [
        (lambda: arm.evaluate([speed("G")], S=0.1), "nothing says how fast the strokes move; give rates="),
        (lambda: arm.evaluate([speed("G")], S=np.array([0.1, 0.2])), "nothing says how fast the strokes move"),
        (lambda: arm.function([rate("lift")]), "nothing says how fast the strokes move"),
        (lambda: arm.at(S=0.1)[power("lift")], "power(lift): nothing says how fast the strokes move; sweep over a path in time"),
        (lambda: arm.evaluate([acceleration("G")], S=0.1, rates={"S": 1.0}), "follows S.acceleration"),
        (lambda: dynamic_factor(speed("G")), "dynamic_factor(speed(G)): a force is expected"),
        (lambda: arm.at(S=0.1)[flow("lift")], "flow(lift): the name of a line is expected: line"),
        (lambda: arm.evaluate([rate("B")], S=0.1, rates={"S": 1.0}), "is no Cylinder"),
        (lambda: arm.evaluate([speed("Q")], S=0.1, rates={"S": 1.0}), "Point 'Q' is unknown"),
    ]:
        with pytest.raises(DefinitionError, match=re.escape(words)):
            ask()
