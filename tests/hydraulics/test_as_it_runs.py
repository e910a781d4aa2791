"""Cylinders over a path in time: each instant is that of the direction in which the cylinder goes there."""

from dataclasses import replace
from functools import partial
from itertools import product

import numpy as np
import pytest

from hydraulics import Cylinder, LiftCircuit, capacity, pressure, reserve, thrust
from linkage import RIGHT, Damper, DefinitionError, Dyad, Ground, Mechanism, OnLink, Over, PinFriction, Stroke, Weight, least, ramp
from linkage.loads import Acting
from linkage.units import bar, kN, mm
from mechanisms.mower_lift import LoweredMowerLift
from tests.members import told_by


class Boom(Mechanism):
    """A boom with friction in its foot, raised, held and let down again."""

    S = Stroke(0.0, 0.2)
    O, A = Ground(0, 0), Ground(0.5, -0.5)
    B = Dyad(A, O, AB=0.6 + S, OB=0.6, side=RIGHT)
    G = OnLink(O, B, OG=1.2)
    load = Weight(G, mass=400)
    foot = PinFriction(O, 40 * mm, 0.2)
    ram = Cylinder(A, B, bore=63 * mm, rod=40 * mm)
    line = LiftCircuit(ram, pressure=180 * bar, mechanical_efficiency=0.9)
    work = Over.path(S=ramp(0.02, 0.18, speed=0.1).hold(0.4).then(ramp(0.18, 0.02, speed=0.2)))
    back = Over.path(S=[0.02, 0.18, 0.02])


class BothWays(Boom):
    ram = Cylinder("A", "B", bore=63 * mm, rod=40 * mm, works="both")


@pytest.mark.parametrize("machine", [Boom(), BothWays()])
def test_each_instant_is_that_of_the_direction_in_which_it_goes(machine):
    motion = machine.sweep(41, over="work")
    going = np.sign(motion.rates["S"])
    for request in (thrust, pressure, reserve):
        found = motion[request("ram")]
        for way, sense in (("extending", 1.0), ("retracting", -1.0), ("frictionless", 0.0)):
            there = going == sense
            still = machine.at(S=motion.strokes["S"][there])
            plain = still[request("ram", direction=way)]
            if request is pressure and not sense:  # no efficiency counts where it stands
                plain = np.max([still[pressure("ram", side=side, direction=way)] for side in ("piston", "rod")], axis=0)
                assert plain == pytest.approx(still[thrust("ram")] / (np.pi / 4 * 0.063**2), rel=1e-12)
            assert there.any() and found[there] == pytest.approx(plain, rel=1e-9, nan_ok=True), (request, way)
    sides = [motion[pressure("ram", side=side)] for side in ("piston", "rod")]
    assert np.max(sides, axis=0) == pytest.approx(motion[pressure("ram")], rel=1e-9)  # also where it stands


def test_the_worst_over_a_path_in_time_is_that_of_its_directions():
    timed, both = (Boom().answers([least(reserve("ram"))], over=name)[0] for name in ("work", "back"))
    assert timed.value == pytest.approx(both.value, rel=1e-9) and both.direction == "extending" and timed.direction == ""
    verdicts = Boom().verdicts(Boom().sweep(11, over="work"))
    assert any(" s (S = " in each for each in verdicts)


def test_what_more_it_lifts_over_a_path_in_time_is_what_the_pump_has_to_spare():
    machine = Boom().replaced(**{"foot.coefficient": 0.0})
    motion = machine.sweep(201, over="work")
    spare = 0.9 * 180 * bar * np.pi / 4 * 0.063**2 - motion[thrust("ram")]
    found = motion[capacity("ram", "G")]
    assert found == pytest.approx(spare / motion.ratio("G")[1], rel=1e-9)
    (answer,) = machine.answers([least(capacity("ram", "G"))], over="work")
    assert answer.value == pytest.approx(found.min(), rel=1e-3) and answer.value <= found.min() * (1.0 + 1e-9)


def test_a_direction_of_ones_own_is_refused():
    with pytest.raises(DefinitionError, match="as it runs; leave the direction out"):
        Boom().sweep(11, over="work")[thrust("ram", direction="retracting")]


class Hasty(Boom):
    """It starts so fast that inertia counts, and a damper works."""

    foot = back = None
    brake = Damper("A", "B", coefficient=20 * kN)
    work = Over.path(S=ramp(0.02, 0.18, speed=0.4, acceleration=8.0))


def test_what_holds_with_the_pump_off_is_the_load_at_rest():
    machine = Hasty()
    motion = machine.sweep(41, over="work")
    still = machine.at(S=motion.strokes["S"])
    for name in ("working", "other"):
        assert getattr(Hasty.line.holding(motion), name) == pytest.approx(getattr(Hasty.line.holding(still), name), rel=1e-12)
    assert np.max(motion[thrust("ram")]) > 1.2 * np.max(still[thrust("ram")])
    box = type("Box", (Hasty,), {"work": Over(S=(0.02, 0.18))})
    timed, plain = (next(each for each in kind().verdicts() if each.rule == "holding") for kind in (Hasty, box))
    assert timed.answer.value == pytest.approx(plain.answer.value, rel=1e-9) and " s (S = " in timed.sentence


class Raised(Boom):
    work = Over.path(S=ramp(0.02, 0.18, speed=0.1))
    back = None


def test_going_back_is_asked_where_it_goes_back():
    timed, plain = (
        next(each.answer for each in told_by(Boom(), "line", over=name) if each.rule == "lowering") for name in ("work", "back")
    )
    assert timed.ok and timed.value == pytest.approx(plain.value, rel=1e-9)
    (nowhere,) = (each for each in told_by(Raised(), "line") if each.rule == "lowering")
    assert nowhere.ok is None and str(nowhere) == "--   lowering: it goes back nowhere over what it runs."


def test_rates_and_a_direction_agree_or_are_refused_at_every_door():
    """Friction acts in the direction that is said, also where rates are given; a direction that they contradict is refused."""
    boom = Boom()
    for request, way, rate in product((thrust, pressure, reserve), ("extending", "retracting"), (0.1, -0.1)):
        asked = request("ram", direction=way)
        given = replace(asked, acting=Acting(direction=way, rates={"S": rate}))
        doors = [
            partial(boom.at(S=0.1).__getitem__, given),
            partial(boom.evaluate, [asked], S=0.1, rates={"S": rate}),
            partial(boom.function([asked], rates=True), 0.1, rate),
        ]
        if (rate > 0.0) is (way == "extending"):
            plain = float(boom.at(S=0.1)[asked])
            assert [float(np.ravel(door())[0]) for door in doors] == pytest.approx([plain] * 3, rel=1e-12)
            continue
        for door in doors:
            with pytest.raises(DefinitionError, match="at these rates it goes the other way"):
                door()


def test_what_is_needed_over_a_path_in_time_goes_with_the_reserve():
    (found,) = [each for each in LoweredMowerLift().verdicts() if each.rule == "lifting"]
    needed = float(found.sentence.partition("It needs ")[2].partition(" kgf/cm2")[0])
    assert needed * float(found.answer.value) == pytest.approx(155.0, rel=1e-3)
