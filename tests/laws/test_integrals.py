"""One integral: a work is the same number at every door that gives it, and that of the energy which it leaves."""

import re
from random import Random

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Cylinder, OilLine, Pump, pressure, reserve, thrust
from linkage import (
    LEFT,
    Crank,
    DefinitionError,
    Dyad,
    Force,
    Ground,
    Mechanism,
    Over,
    Stroke,
    Weight,
    angle,
    distance,
    drive_force,
    integral,
    kN,
    most,
    optimise,
    ref,
    y,
)
from linkage.files.study_tasks import TextMeasures
from linkage.study import monte_carlo, tornado
from mechanisms.three_point_hitch import ThreePointHitch
from tests.for_all import for_all
from tests.laws.test_runs import Lift
from tests.linkage.study.test_search_ends import Boom, Scissor


class Kinked(Mechanism):
    """A rocker with an output that has a kink, a jump in its slope and a narrow hump."""

    S = Stroke(0.1, 1.0)
    O, C = Ground(0.0, 0.0), Ground(0.7, 0.1)
    A = Crank(O, OA=0.3, angle=S)
    D = Dyad(A, C, AD=0.6, CD=0.5, side=LEFT)
    load = Weight(D, mass=40)
    kink = np.absolute(y("D") - 0.58) + 0.3 * np.exp(-(((S - 0.4895) / 0.01) ** 2))


CASES = {
    "hitch": (ThreePointHitch, drive_force(), "OB"),
    "hitch's pressure": (ThreePointHitch, pressure("lift"), "OB"),
    "boom": (Boom, drive_force(), "OB"),
    "scissor": (Scissor, drive_force(), "OT"),
    "rocker": (Kinked, drive_force(), "OA"),
    "kinks": (Kinked, ref("kink"), "OA"),
}


def at_every_door(machine, measure, name):
    """Return the number by the judge, by an `Over`, by a search, by a Monte Carlo and by a tornado at a few and at many poses."""
    (stroke,) = machine.strokes.values()
    ends = stroke.start, stroke.end
    box, tolerance = {name: (machine[name] * (1.0 - 1e-6), machine[name])}, {name: 1e-4}
    yield machine.answers([measure])[0].value
    yield machine.answers([measure], over=Over(**{stroke.name: ends}))[0].value
    yield machine.answers([measure <= 1e99])[0].value
    yield optimise(machine, minimise=measure, vary=box, method="local", limit=20).start_value
    for count in (2, 21, 200):
        way = {stroke.name: np.linspace(*ends, count)}
        yield float(monte_carlo(machine, {"it": measure}, tolerance, count=16, **way)["it"].nominal)
    yield float(tornado(machine, measure, tolerance, **way).nominal)
    yield from TextMeasures({"it": str(measure)}, 21)(machine.replaced(**{name: np.full(3, machine[name])}))["it"]


@pytest.mark.parametrize("name", CASES)
def test_an_integral_is_one_number_at_every_door(name):
    kind, quantity, dimension = CASES[name]
    machine = kind()
    measure = integral(quantity)
    values = list(at_every_door(machine, measure, dimension))
    assert_allclose(values, values[0], rtol=1e-9)
    motion = machine.sweep(20001)
    (strokes,) = motion.strokes.values()
    assert_allclose(values[0], np.trapezoid(motion[quantity], strokes), rtol=1e-6)


def test_an_integral_where_one_of_several_strokes_runs_has_its_unit():
    over = Over(S=(0.0, 0.2), T=0.1)
    asked = [integral(drive_force("S")), integral(drive_force("S"), by=Lift.S), integral(y("G")), integral(drive_force("S")) <= 3 * kN]
    assert [str(each).split()[1] for each in Lift().answers(asked, over=over)] == ["Nm", "Nm", "cm2", "Nm"]
    with pytest.raises(DefinitionError, match=r"'Q' is unknown .*Known: S, T"):
        Lift().answers([integral(drive_force("S"), by="Q")], over=over)


@for_all("seed", range(3))
def test_an_integral_over_an_angle_ends_in_rad_and_a_pressure_is_told_of_the_movement_it_was_worked_out_for(seed):
    draw = Random(seed)
    losses = dict(mechanical_efficiency=draw.uniform(0.8, 0.95), hydraulic_efficiency=draw.uniform(0.8, 1.0))
    works, force = (("piston", -1.0), ("rod", 1.0))[seed % 2]

    class Turning(Mechanism):
        phi = Stroke(-0.5, 0.5)
        O, A = Ground(0.0, 0.0), Ground(draw.uniform(0.2, 0.4), -0.5)
        B = Crank(O, OB=0.5, angle=phi)
        ram = Cylinder(A, B, bore=0.08, rod=0.045)
        load = Force(B, (0.0, force * draw.uniform(5e3, 20e3)))
        line = OilLine(f"ram.{works}_side", Pump(200e5, **losses))

    machine, lifting = Turning(), "extending" if works == "piston" else "retracting"
    for asked, unit in ((pressure("ram"), "bar rad"), (pressure("line"), "bar rad"), (thrust("ram"), "kN rad"), (drive_force(), "Nm"),
                        (angle("O", "B"), "rad2"), (distance("A", "B"), "mm rad"), (reserve("ram"), "deg")):  # fmt: skip
        (found,) = machine.answers([integral(asked)])
        assert re.fullmatch(rf"[-\d.e]+ {unit}( {lifting})?", str(found)), str(found)
    for asked in (pressure("ram"), pressure("line"), pressure("ram", side=works)):
        (found,) = machine.answers([most(asked)])
        assert found.direction == lifting and lifting in found.place and "at rest" not in found.place


def test_a_way_there_and_back_leaves_no_work_and_a_work_is_the_height_gained():
    boom = Boom()
    there, back = np.linspace(0.0, 0.25, 7), np.linspace(0.25, 0.0, 5)
    for way, part in ((there, 1.0), (back, -1.0), (np.concatenate([there, back]), 0.0), (np.concatenate([there, back, there]), 1.0)):
        found = monte_carlo(boom, {"work": integral(drive_force())}, {"OB": 1e-4}, count=16, S=way)["work"]
        gained = 500 * 9.80665 * float(boom.at(S=0.25).y("G") - boom.at(S=0.0).y("G"))
        assert float(found.nominal) == pytest.approx(part * gained, rel=1e-9, abs=1e-6)
        assert np.isfinite([found.low, found.high]).all()


def test_an_integral_over_a_pole_is_none():
    gap = y("D") - float(Kinked().at(S=0.4).y("D"))
    for quantity in (1 / gap, 1 / gap**2):
        answer = Kinked().answers([integral(quantity)])[0]
        assert answer.status != "value"
        assert np.isnan(float(monte_carlo(Kinked(), {"it": integral(quantity)}, {"OA": 1e-6}, count=4, S=[0.1, 1.0])["it"].nominal))
    for text in ("most(1 / (y(D) - GAP m))", "integral(1 / (y(D) - GAP m))"):
        text = text.replace("GAP", repr(float(Kinked().at(S=0.4).y("D"))))
        assert np.isnan(TextMeasures({"it": text}, 21)(Kinked(OA=np.array([0.3, 0.3])))["it"]).all()


def test_an_integral_over_a_part_that_only_leaves_is_refused():
    machine = Boom()
    cut = Over(S=(machine.strokes["S"].start, machine.strokes["S"].end), only=[drive_force() >= 0.0])
    with pytest.raises(DefinitionError, match=r"only= leaves out a part of it; give the ends of that part, over=Over\(S="):
        machine.answers([integral(drive_force())], over=cut)
