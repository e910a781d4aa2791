"""What every machine says of a motion: assembly, dead points, transmission, its members; of a batch how many designs fail."""

from collections import Counter
from types import SimpleNamespace

import numpy as np
import pytest

from hydraulics import Accumulator, AccumulatorBlock, Cylinder, FloatCircuit, LiftCircuit, isothermal, lift_verdicts
from linkage import RIGHT, Column, DefinitionError, Dimension, Dyad, Ground, Mechanism, OnLink, Over, Stroke, Verdict, Weight, most, y
from linkage.loads import FRICTIONLESS, PLAIN_CASE, ForceElement
from linkage.motion import HasVerdicts, Tabled
from linkage.motion.judge import Situation, situation_found
from linkage.motion.live import live_text
from linkage.motion.motion_verdicts import geometry_verdicts
from linkage.reports import results
from linkage.statics.law_requests import LawRequest
from linkage.units import bar, litre, mm
from mechanisms.at_work.excavator import HookExcavator


class Boom(Mechanism):
    """A cylinder turns a boom."""

    S = Stroke(0.0, 0.25)
    L0 = Dimension(0.5)
    A, O = Ground(0.20, 0.55), Ground(0.30, 1.15)
    B = Dyad(A, O, AB=L0 + S, OB=0.30, side=RIGHT)
    G = OnLink(O, B, OG=0.9)


class Lift(Boom):
    """The same with a load and a pump."""

    load = Weight("G", mass=800)
    lift = Cylinder("A", "B", bore=80 * mm, rod=45 * mm, closed=0.5, stroke=0.25)
    pump = LiftCircuit(lift, pressure=180 * bar)


def by_rule(verdicts):
    """Return verdicts by rule; each is there once."""
    found = {each.rule: each for each in verdicts if each.is_rule}
    assert len(found) == sum(each.is_rule for each in verdicts)
    return found


def test_a_machine_without_loads_is_told_where_it_is_assembled_and_how_far_its_dead_points_are():
    found = by_rule(Boom().verdicts(Boom().sweep(5)))
    assert set(found) == {"assembly", "dead points"} and all(found.values())
    assert "S = 0 to 250 mm" in found["assembly"]
    far, near = np.hypot(0.1, 0.6) + 0.3, np.hypot(0.1, 0.6) - 0.3  # A, O and B in line
    assert f"of B = Dyad(A, O) at S = {(near - 0.5) * 1e3:.1f} mm, {(0.5 - near) * 1e3:.3g} mm beyond it" in found["dead points"]
    assert f"of B = Dyad(A, O) at S = {(far - 0.5) * 1e3:.1f} mm, {(far - 0.75) * 1e3:.3g} mm beyond it" in found["dead points"]


def test_the_nearest_dead_points_of_all_strokes_and_places_are_one_row():
    """Of two boxes the nearer end counts on each side, of each stroke that runs."""
    judge = HookExcavator().judge([Over(lift=(0.1, 0.2), swing=0.2), Over(lift=(0.2, 0.38), swing=(0.1, 0.3))])
    (row,) = (each for each in geometry_verdicts(judge) if each.rule == "dead points")
    places = ("lift = -139.5 mm, 239 mm", "lift = 453.5 mm, 73.5 mm", "swing = -40.9 mm, 141 mm", "swing = 552.3 mm, 252 mm")
    assert row.ok and all(f"{place} beyond it" in row for place in places) and str(row).count("beyond it") == 4


def test_beside_a_stroke_that_ends_in_a_dead_point_the_other_strokes_are_named():
    machine = HookExcavator()
    end = max(value for value, _ in machine.at(lift=0.2, swing=0.2).limits()["lift"].dead_points)
    judge = machine.judge([Over(lift=(0.1, end), swing=0.2), Over(lift=0.2, swing=(0.1, 0.3))])
    kept, fault = (each for each in geometry_verdicts(judge) if each.rule == "dead points")
    assert kept.ok and str(kept).startswith("ok   dead points: none along swing; the nearest: ") and "lift" not in kept
    assert fault.ok is False and "lift = 453.5 mm, where the stroke ends" in fault


def test_a_motion_that_is_not_assembled_says_how_much_is_missing():
    far = np.hypot(0.1, 0.6) + 0.3
    long = Boom(L0=0.7)
    found = by_rule(long.verdicts(long.sweep(26, unreachable="nan")))
    assert not found["assembly"].ok and not found["dead points"].ok
    assert f"{(0.95 - far) * 1e3:.3g} mm" in found["assembly"] and f"S = {(far - 0.7) * 1e3:.1f} mm" in found["dead points"]
    none = Lift(L0=2.0)
    (only,) = none.verdicts(none.sweep(5, unreachable="nan"))
    assert only.rule == "assembly" and not only.ok


def test_a_poor_transmission_angle_is_told_and_fails_nothing():
    class Flat(Boom):
        S = Stroke(0.0, 0.40)

    words = [each for each in Flat().verdicts(Flat().sweep(9)) if not each.is_rule]
    assert len(words) == 1 and words[0].startswith("The least transmission angle is ")
    motion = Flat().at(S=0.4)
    assert f"{np.degrees(motion.transmission_angle('B')):.3g} deg" in words[0]


def test_cylinders_and_circuits_judge_themselves():
    machine = Lift()
    motion = machine.sweep(11)
    found = by_rule(machine.verdicts(motion))
    assert {"length", "standard size", "buckling", "lifting", "oil", "holding", "lowering"} <= set(found)
    lifted = [found[rule] for rule in ("lifting", "oil", "holding", "lowering")]
    assert lifted == lift_verdicts("pump", motion)
    weak = Lift(**{"pump.pressure": 20 * bar})
    assert not by_rule(weak.verdicts(weak.sweep(11)))["lifting"].ok


def test_the_rule_of_several_members_bears_their_names():
    class Two(Lift):
        aux = Cylinder("A", "B", bore=63 * mm, rod=36 * mm)
        pump = LiftCircuit(["lift", aux], pressure=180 * bar)

    found = by_rule(Two().verdicts(Two().sweep(5)))
    assert {"standard size lift", "standard size aux", "length lift"} <= set(found)


@pytest.mark.slow
def test_a_gas_line_tells_its_range_and_fails_where_it_runs_empty():
    class Floating(Lift):
        pump = None
        line = FloatCircuit("lift", AccumulatorBlock([Accumulator(4 * litre, 30 * bar)], isothermal), charge_pressure=60 * bar, at=0.0)

    motion = Floating().sweep(11)
    line = Floating.plan.members["line"]
    found = by_rule(Floating().verdicts(motion))["line"]
    low, high = (float(each) for each in (line.pressure(motion).min(), line.pressure(motion).max()))
    assert found.ok and f"{low / bar:.4g} bar" in found and f"{high / bar:.4g} bar" in found

    class Small(Floating):
        line = FloatCircuit("lift", AccumulatorBlock([Accumulator(0.2 * litre, 55 * bar)], isothermal), charge_pressure=60 * bar, at=0.0)

    empty = by_rule(Small().verdicts(Small().sweep(11)))["line"]
    assert not empty.ok and "empty" in empty


def test_a_grid_of_two_strokes_is_judged_over_its_box():
    class Rig(Lift):
        T = Stroke(0.0, 0.1)
        C = Dyad("O", "G", OC=0.8 + T, GC=0.5, side=RIGHT)
        load = Weight(C, mass=800)
        tilt = Cylinder("O", C, bore=50 * mm, rod=28 * mm)

    machine = Rig()
    found = by_rule(machine.verdicts(machine.sweep(S=5, T=4)))
    fine = machine.sweep(S=81, T=41)
    least = float(np.nanmin(Rig.plan.members["pump"].reserve(fine)))
    assert found["lifting"].ok and f"{least:.3f}" in found["lifting"]
    assert {"oil", "holding", "lowering"} <= set(found)


def test_a_batch_is_told_how_many_designs_fail():
    lengths = np.array([0.5, 0.7, 0.45])
    machine = Lift(L0=lengths, **{"load.mass": np.array([800.0, 800.0, 80000.0])})
    found = by_rule(machine.verdicts(machine.sweep(5, unreachable="nan")))
    assert not found["assembly"].ok and found["assembly"].sentence.startswith("1 of 3 designs cannot") and "design 2" in found["assembly"]
    assert found["lifting"].sentence.startswith("2 of 3 designs fail, of their worst values ")
    assert "; the first is design 2: at 180 bar the force needed grows" in found["lifting"].sentence
    assert found["length"].sentence.startswith("2 of 3 designs fail") and "; the first is design 2: " in found["length"].sentence
    assert found["oil"].ok
    many = Lift(**{"load.mass": np.linspace(1.0, 9.0, 201)})
    assert any("judged for up to 200 designs" in each for each in many.verdicts(many.sweep(2)))


@pytest.mark.slow
def test_a_variants_further_members_are_judged_and_shown_beside_the_machines_own():
    class Owned(Boom):
        load = Weight("G", mass=800)
        lift = Cylinder("A", "B", bore=80 * mm, rod=45 * mm)

        def columns(self, motion):
            return [Column("S", motion.strokes["S"], "m")]

        def rules(self, motion):
            return ["This is mine."]

    class Pumped(Owned):
        pump = LiftCircuit("lift", pressure=180 * bar)

    class Again(Pumped):
        def rules(self, motion):
            return [*super().rules(motion), "And this."]

    *general, last = Owned().verdicts(Owned().sweep(3))
    assert last == "This is mine." == last.sentence and last.rule == "remark" and all([last])
    assert {"assembly", "standard size", "buckling"} <= set(by_rule(general))
    assert {"lifting", "oil", "holding", "lowering"} <= set(by_rule(Pumped().verdicts(Pumped().sweep(3))[:-1]))
    assert Again().verdicts(Again().sweep(3))[-2:] == ["This is mine.", "And this."]
    with pytest.raises(DefinitionError, match=r"Silent.verdicts replaces what is said of every machine; name it rules\(self, motion\)"):
        type("Silent", (Owned,), {"verdicts": lambda self, motion: []})

    class Second(Owned):
        other = Cylinder("A", "B", bore=63 * mm, rod=36 * mm)
        lines = LiftCircuit(["lift", other], pressure=180 * bar)

    names = [column.name for column in results(Second(), Second().sweep(3))]
    assert names == ["S", "thrust", "pressure", "reserve"]  # of the cylinder that is new


def test_a_member_of_ones_own_judges_itself():
    class Fuse(Weight, HasVerdicts):  # type: ignore[misc]
        def verdicts(self, judge):
            answer = judge.answer(most(y(self.point)) <= 1.0)
            return [Verdict("fuse", answer.ok, f"it goes up to {answer.value:.3f} m {answer.place}.", answer=answer)]

    class Fused(Boom):
        fuse = Fuse("G", mass=10)

    assert not by_rule(Fused().verdicts(Fused().sweep(5)))["fuse"].ok


def test_columns_in_a_load_case_are_asked_of_members_that_know_them():
    class Marked(Weight, Tabled):  # type: ignore[misc]
        def columns(self, motion):
            return [Column("height", motion.y(self.point), "m")]

    class Own(Boom):
        load = Marked("G", mass=100)

    motion = Own().sweep(3)
    assert [each.name for each in Own.plan.members["load"].columns_in(motion)] == ["height"]
    assert Own.plan.members["load"].columns_in(motion, "transport") == []


@pytest.mark.parametrize("kind", [Cylinder, LiftCircuit, FloatCircuit])
def test_what_hydraulics_brings_judges_itself(kind):
    assert issubclass(kind, HasVerdicts) and issubclass(kind, ForceElement)


@pytest.mark.parametrize(
    ("pieces", "found"),
    [
        ([Situation("shock"), Situation("shock", FRICTIONLESS)], Situation("shock", FRICTIONLESS)),
        ([Situation("shock", FRICTIONLESS), Situation("shock", "extending", "S")], Situation("shock", "extending", "S")),
        ([Situation(), Situation(PLAIN_CASE)], Situation(PLAIN_CASE)),
        ([Situation("", "retracting", "T"), Situation("dig")], Situation("dig", "retracting", "T")),
    ],
)
def test_a_movement_goes_before_one_without_friction_and_that_before_none(pieces, found):
    assert situation_found([SimpleNamespace(situation=each) for each in pieces]) == found


def test_a_fixed_point_without_a_place_is_told():
    class Pointed(Mechanism):
        a = Dimension(0.5)
        S = Stroke(0.5, 0.8)
        O = Ground(0, 0)
        A = Ground(1, 0)
        B = Dyad(O, A, OB=0.7, AB=S, side=RIGHT)
        E = Ground(a, np.sqrt(1 - a * a))  # nothing that moves hangs on it

    (assembly,) = [each for each in Pointed(a=1.5).verdicts() if each.rule == "assembly"]
    assert assembly.ok is False
    assert assembly.sentence.startswith("E = Ground(a, sqrt(1.0 - a * a)) has no place, as its coordinates have no value. Change")
    assert all(Pointed().verdicts())
    assert np.isnan(Pointed(a=1.5).evaluate(["E"], S=[0.6], unreachable="nan")[0]).any()  # a search reads that


def test_a_law_is_traced_once_for_verdicts_a_page_and_gradients(monkeypatch):
    """Not once more for its values, its guards, its slopes and the page's program."""
    traced, own = [], LawRequest.traced_law
    monkeypatch.setattr(LawRequest, "traced_law", lambda self, motion: (traced.append(self), own(self, motion))[1])

    class Fresh(Lift):  # of which nothing has been traced
        """The same."""

    machine = Fresh()
    machine.verdicts()
    asked = dict.fromkeys(traced)
    live_text(Fresh.plan, {str(each): each for each in asked})
    for each in asked:
        machine.at(S=0.1).gradient(each, ["OB", "load.mass"])
    counts = Counter(map(str, traced))
    assert len(counts) > 5 and set(counts.values()) == {1}, counts
