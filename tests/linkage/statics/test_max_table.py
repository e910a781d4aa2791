"""The largest force of every joint of a machine, over all that it runs, in all that acts: against brute force over poses."""

from itertools import product

import numpy as np
import pytest

from linkage import (
    LEFT,
    RIGHT,
    Acting,
    Crank,
    DefinitionError,
    Dyad,
    Force,
    Ground,
    LoadCase,
    Mechanism,
    OnLink,
    Over,
    PinFriction,
    Stroke,
    Weight,
    deg,
    max_table,
    most,
    pin_force,
    pin_forces,
)
from linkage.statics.table import joint_key
from tests.linkage.known_machines import GrabArms


class Grab(GrabArms):
    """A boom and a jib on cylinders: two strokes, two load cases, friction in a pin."""

    wind = Force("P", vector=(900.0, 0.0))
    rub = PinFriction("O", radius=0.02, coefficient=0.1)
    calm = LoadCase("calm", scale={"wind": 0.0})


class Knot(Mechanism):
    """Three links on one pin: several joints at D."""

    phi = Stroke(20 * deg, 70 * deg)
    O, E, F = Ground(0.0, 0.0), Ground(1.6, 0.2), Ground(1.5, 1.4)
    D = Crank(O, OD=1.0, angle=phi)
    P = Dyad(D, E, DP=1.0, EP=0.8, side=LEFT)
    Q = Dyad(D, F, DQ=1.1, FQ=0.9, side=LEFT)
    load = Weight(P, mass=10.0)
    other = Weight(Q, mass=25.0)
    side = Force(D, vector=(0.0, -400.0))


def brute(machine, motion, cases, ways):
    """Return the largest force of every joint at some poses."""
    found = {}
    for case, (direction, drive) in product(cases, ways):
        for joint in pin_forces(motion, case=case, direction=direction, drive=drive).joints:
            if joint.has_force:
                found[joint_key(joint)] = max(found.get(joint_key(joint), 0.0), float(joint.size.max()))
    return found


WAYS = [("frictionless", None), *product(("extending", "retracting"), ("S", "T"))]


def test_a_machine_has_the_largest_of_all_cases_directions_and_places():
    machine = Grab()
    grid = np.meshgrid(np.linspace(0.0, 0.25, 21), np.linspace(0.0, 0.3, 21), indexing="ij")
    seen = brute(machine, machine.at(S=grid[0], T=grid[1]), [None, "calm"], WAYS)
    rows = {(row.point, row.on, row.by, row.kind): row for row in max_table(machine)}
    assert rows.keys() == seen.keys()
    for key, row in rows.items():
        assert row.force >= seen[key] * (1.0 - 1e-9)
        assert row.force <= seen[key] * 1.02
        there = pin_forces(
            machine.at(**row.strokes), case=None if row.answer.case in ("", "plain") else row.answer.case, direction=row.direction,
            drive=row.drive or None,
        )  # fmt: skip
        joint = next(each for each in there.joints if joint_key(each) == key)
        assert float(joint.size) == pytest.approx(row.force, rel=1e-9)
    assert {row.direction for row in rows.values()} - {"frictionless"}
    assert all(row.drive in row.movement and "S = " in row.place for row in rows.values())


@pytest.mark.slow
def test_fewer_cases_or_a_smaller_box_are_never_worse():
    machine = Grab()
    rows = max_table(machine)
    plain, own = (max_table(machine, acting=Acting(case=case)) for case in ("plain", "own loads"))  # the name that rows print
    assert [row.force for row in own] == [row.force for row in plain]
    for each in (plain, max_table(machine, acting=Acting(case="calm")), max_table(machine, over=Over(S=(0.05, 0.2), T=0.1))):
        assert all(row.force <= whole.force * (1.0 + 1e-9) for row, whole in zip(each, rows, strict=True))
    (held,) = {row.strokes["T"] for row in max_table(machine, over=Over(S=(0.05, 0.2), T=0.1))}
    assert held == 0.1


def test_of_one_stroke_it_is_the_table_of_the_results():
    machine = Knot()
    alone, results = max_table(machine), max_table(pin_forces(machine.sweep(5)))
    assert [joint_key(row) for row in alone] == [joint_key(row) for row in results]
    for mine, other in zip(alone, results, strict=True):
        assert mine.force == pytest.approx(other.force, rel=1e-9)
        assert mine.angle == pytest.approx(other.angle, abs=1e-6)


def test_a_joint_among_several_is_named_by_both_bodies():
    motion = Knot().at(phi=0.8)
    found = pin_forces(motion)
    assert len([joint for joint in found.at("D") if joint.has_force]) > 1
    for joint in found.joints:
        if joint.has_force:
            assert np.allclose(found.force(joint.point, joint.on, joint.by), joint.force)
            assert np.allclose(found.force(joint.point, joint.by, joint.on), -joint.force)
            value = motion[pin_force(joint.point, joint.on, "x", by=joint.by)]
            assert float(value) == pytest.approx(float(joint.force[0]), abs=1e-6)
    with pytest.raises(DefinitionError, match="Body"):
        found.force("D", by="nobody")


def test_of_a_batch_it_is_the_worst_design():
    rows = max_table(Knot(**{"load.mass": [10.0, 40.0, 20.0]}))
    single = max_table(Knot(**{"load.mass": 40.0}))
    for row, one in zip(rows, single, strict=True):
        assert row.force >= one.force * (1.0 - 1e-9)
    assert (1,) in {row.design for row in rows}


def test_results_say_themselves_where_and_what():
    with pytest.raises(DefinitionError, match=r"over= and acting= are for a machine"):
        max_table(pin_forces(Knot().sweep(3)), over=Over())
    with pytest.raises(DefinitionError, match="is no result of pin_forces"):
        max_table(3)


def test_the_table_of_a_path_goes_on_as_the_path_does():
    """With friction, along a path of two strokes with a corner: each row is the greatest of the forces along the path, from its one way."""

    class Boom(Mechanism):
        lift = Stroke(0.0, 0.3)
        tilt = Stroke(0.0, 0.2)
        O = Ground(0, 0)
        A = Ground(0.2, -0.6)
        B = Dyad(A, O, AB=0.75 + lift, OB=0.6, side=RIGHT)
        T = OnLink(O, B, OT=1.5, BOT=10 * deg)
        C = OnLink(O, B, OC=0.8, BOC=25 * deg)
        D = Dyad(C, T, CD=0.7 + tilt, TD=0.4, side=LEFT)
        L = OnLink(T, D, TL=0.5, DTL=-100 * deg)
        load = Weight(L, mass=300)
        rub_T = PinFriction(T, radius=0.04, coefficient=0.2)
        rub_O = PinFriction(O, radius=0.04, coefficient=0.2)
        path = Over.path(lift=[0.0, 0.15, 0.15, 0.3], tilt=[0.2, 0.2, 0.05, 0.0])

    machine = Boom()
    rows = {(row.point, row.on): row for row in max_table(machine)}
    assert {row.direction for row in rows.values()} - {"frictionless"}
    for number in (301, 302):
        for direction in ("extending", "retracting", "frictionless"):
            seen = pin_forces(machine.sweep(number, over="path"), direction=direction)
            for joint in (each for each in seen.joints if each.has_force):
                assert np.max(joint.size) <= rows[joint.point, joint.on].force * (1.0 + 1e-9)
    for row in rows.values():
        judge = machine.judge()
        answer = judge.answer(most(pin_force(row.point, row.on, by=row.by)))
        there = pin_forces(judge.there(answer), direction=answer.direction)  # which goes on as the leg does that the answer is of
        joint = next(each for each in there.joints if (each.point, each.on, each.by) == (row.point, row.on, row.by))
        assert row.force == pytest.approx(answer.value, rel=1e-12) == pytest.approx(float(joint.size), rel=1e-9)
