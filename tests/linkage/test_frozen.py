"""Nothing that is handed out, given in or declared changes under the hand: read-only, a copy, or refused in words."""

import copy
import dataclasses
import pickle

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from hydraulics import Accumulator, AccumulatorBlock, Cylinder, CylinderSize
from linkage import DefinitionError, Mechanism, driving_force
from linkage.frozen import FrozenDict, frozen_copy, unmasked
from linkage.loads import Force, LinkMass, LoadCase, Spring, Support, Weight
from linkage.quantities import Member
from linkage.study import survey
from mechanisms.classics.four_bar import FourBar
from mechanisms.three_point_hitch import ThreePointHitch
from tests import shipped
from tests.for_all import for_all
from tests.linkage.files.file_machines import EveryStep, Hitch, Loaded, Parts
from tests.linkage.study.survey_measures import travel

ALL = shipped.over_machines(lambda: [EveryStep, Hitch, Loaded, Parts])


def arrays_in(value, depth=4):
    """Yield the arrays in a value: its attributes that are no functions, its entries and parts."""
    if isinstance(value, np.ndarray):
        yield value
    elif depth and isinstance(value, dict):
        for each in value.values():
            yield from arrays_in(each, depth - 1)
    elif depth and isinstance(value, (tuple, list)):
        for each in value:
            yield from arrays_in(each, depth - 1)


@ALL
def test_a_motion_hands_out_nothing_that_changes_it(machine):
    motion = machine().at(unreachable="nan", **{name: np.linspace(each.start, each.end, 5) for name, each in machine.plan.strokes.items()})
    names = [*machine.plan.points, *motion.strokes]
    before = {name: np.array(motion[name]) for name in names}
    for given in (motion.strokes, motion.designs, motion.inputs):
        for name in given:
            for refused in (lambda given=given, name=name: given.__setitem__(name, 0.77), lambda given=given, name=name: given.pop(name)):
                with pytest.raises(DefinitionError, match="do not change; take a copy"):
                    refused()
    for array in arrays_in([motion.strokes, motion.designs, motion.inputs, motion.reached, [motion[name] for name in machine.plan.moving]]):
        with pytest.raises(ValueError, match="read-only"):
            array[...] = 0
    for name in names:
        found = motion[name]
        if found.flags.writeable:
            found[...] = 0.77
        assert_array_equal(motion[name], before[name])


def test_ratios_and_places_follow_the_same_strokes():
    motion = FourBar().sweep(9)
    places, ratio = motion["P"].copy(), motion.ratio("P").copy()
    with pytest.raises(ValueError, match="read-only"):
        motion.strokes["phi"][:] = 0.77
    with pytest.raises(DefinitionError, match="do not change"):
        motion.strokes["phi"] = np.zeros(9)
    with pytest.raises(DefinitionError, match="do not change"):
        motion.limits()["phi"] = None
    assert_array_equal(motion["P"], places)
    assert_array_equal(motion.ratio("P"), ratio)


def test_what_was_given_in_is_copied():
    """Strokes, designs, rates, loads and the parameters of elements."""
    strokes, lengths = np.linspace(0.0, 1.0, 5), np.linspace(0.30, 0.31, 3)
    hitch = Hitch(OB=lengths)
    motion = hitch.at(S=0.2 * strokes)
    given = 0.2 * strokes
    same = hitch.at(S=given)
    again = motion.moved({"S": given})
    vector, mass, centre, at = np.array([3.0, 4.0]), np.array(100.0), [0.1, 0.0], np.array([0.0, 1.0])
    elements = [Force("F", vector), Weight("G", mass=mass), LinkMass("O B", mass=3.0, at=centre), Support("F", at)]
    scale, only = {"load": 2.0}, ["load"]
    case = LoadCase("a", scale=scale, only=only)
    words = [*map(str, elements), str(case)]
    forces = [driving_force(motion, [element]) for element in elements]
    lengths[:], given[:], vector[:], mass[...], centre[0], at[:] = 9.0, 0.0, 9.0, 9.0, 9.0, 9.0
    scale["load"] = 7.0
    only.append("other")
    assert [*map(str, elements), str(case)] == words
    for before, element in zip(forces, elements, strict=True):
        assert_array_equal(driving_force(motion, [element]), before)
    assert_array_equal(hitch.dimensions["OB"], np.linspace(0.30, 0.31, 3))
    for each in (same, again):
        assert_array_equal(each["G"], motion["G"])
        assert_array_equal(each.strokes["S"], motion.strokes["S"])
        assert_array_equal(each.ratio("G"), motion.ratio("G"))
    with pytest.raises(ValueError, match="read-only"):
        hitch.dimensions["OB"][0] = 1.0


def test_hydraulics_copies_what_it_is_given():
    bore, volume, charge = np.array([0.1, 0.11]), np.array([1e-3, 2e-3]), np.array([2e6, 3e6])
    size, block = CylinderSize(bore, 0.05), AccumulatorBlock([Accumulator(volume, charge)])
    area, pressure = size.area.copy(), block.pressure(5e6, 1e-4).copy()
    bore[:], volume[:], charge[:] = 0.3, 9e-3, 1e5
    assert_array_equal(size.area, area)
    assert_array_equal(block.pressure(5e6, 1e-4), pressure)


def test_a_survey_hands_out_nothing_that_changes_it():
    found = survey(ThreePointHitch(), {"OB": np.linspace(0.28, 0.32, 20)}, travel)
    name = next(iter(found))
    with pytest.raises(ValueError, match="read-only"):
        found[name][:] = 0.0
    with pytest.raises(DefinitionError, match="do not change"):
        found.results[name] = 0.0


@ALL
def test_a_class_is_what_it_is_made_of(machine):
    before, names = str(machine.plan), list(machine.plan.members)
    for name in names:
        member = getattr(machine, name, None)
        if not isinstance(member, Member):
            continue
        for refused in (lambda name=name: setattr(machine, name, 3), lambda name=name: delattr(machine, name)):
            with pytest.raises(DefinitionError, match=rf"{machine.__name__}\.{name} .*write a subclass, class Other\({machine.__name__}\)"):
                refused()
        for each in (member, machine.plan.members[name]):
            for attribute in [*(key for key in vars(each) if key != "_class"), "anything"]:
                for refused in (
                    lambda each=each, key=attribute: setattr(each, key, 3),
                    lambda each=each, key=attribute: delattr(each, key),
                ):
                    with pytest.raises(DefinitionError, match=r"write a subclass|make a new one"):
                        refused()
            for table in (value for value in vars(each).values() if isinstance(value, dict)):
                with pytest.raises(DefinitionError, match="do not change"):
                    table["OB"] = 3.0
    for refused in (lambda: setattr(machine, "plan", None), lambda: setattr(machine, "other", next(iter(machine.plan.members.values())))):
        with pytest.raises(DefinitionError, match="write a subclass"):
            refused()
    with pytest.raises(DefinitionError, match="do not change"):
        machine.plan.members["B"] = 3
    assert str(type("Other", (machine,), {"__module__": __name__}).plan) == before


def test_what_is_not_part_of_the_linkage_may_be_set_on_a_class():
    class Other(FourBar):
        pass

    Other.note = "3"
    Other.verdicts = lambda self, motion: ["fine"]
    assert Other().verdicts(None) == ["fine"] and Other.note == "3"
    del Other.note
    with pytest.raises(DefinitionError, match="write a subclass"):
        Mechanism.plan = None


def test_an_accumulator_a_cylinder_and_a_case_say_how_to_make_a_new_one():
    for made, name in (
        (Cylinder("A", "B", bore=0.1, rod=0.05), "bore"), (CylinderSize(0.1, 0.05), "bore"), (Accumulator(1e-3, 2e6), "charge"),
        (AccumulatorBlock([Accumulator(1e-3, 2e6)]), "gas"), (LoadCase("a"), "slope"),
        (Spring("A", "B", stiffness=1.0, preload=1.0), "stiffness"),
        (FourBar().sweep(3).limits()["phi"], "start"),
    ):  # fmt: skip
        before = str(made)
        for refused in (lambda made=made, name=name: setattr(made, name, 3), lambda made=made, name=name: delattr(made, name)):
            with pytest.raises(DefinitionError, match=rf"{type(made).__name__}\.{name} = \.\.\.: it does not change; make a new one"):
                refused()
        assert str(made) == before
    assert dataclasses.replace(CylinderSize(0.1, 0.05), bore=0.2).bore == 0.2


def test_frozen_things_travel():
    motion = Loaded().sweep(3)
    for copied in (pickle.loads(pickle.dumps(motion)), copy.deepcopy(motion)):
        assert_array_equal(copied["G"], motion["G"])
        assert type(copied.strokes) is FrozenDict
    assert pickle.loads(pickle.dumps(FrozenDict(a=1))) == {"a": 1}
    free = copy.copy(FourBar.plan.members["A"])
    free.note = 3
    assert free.note == 3


# -- masks ---------------------------------------------------------------------------------------------------


def masked(*values):
    return np.ma.masked_array(values, [place == 1 for place in range(len(values))])


def test_a_masked_value_is_no_number():
    assert np.isnan(unmasked(masked(1, 2, 3))[1]) and np.isnan(unmasked(np.ma.masked))
    assert_array_equal(frozen_copy(masked(1.0, 2.0, 3.0)), [1.0, np.nan, 3.0])


MASKED = [
    lambda values: Hitch().at(S=values), lambda values: Hitch(OB=values), lambda values: Hitch().evaluate(["G"], S=values),
    lambda values: Hitch().sweep(3).velocity("G", {"S": values}), lambda values: Weight("G", mass=values),
    lambda values: Force("G", values[:2]), lambda values: Support("G", values[:2]), lambda values: LinkMass("O B", mass=1.0, at=values[:2]),
    lambda values: Weight("G", mass=1.0, gravity=values[:2]), lambda values: CylinderSize(values, 0.05),
    lambda values: Accumulator(values, 2e6),
    lambda values: Cylinder("A", "B", bore=values, rod=0.05), lambda values: survey(ThreePointHitch(), {"OB": values}, travel),
    lambda values: Hitch(A=(values, 0.55)), lambda values: CylinderSize(0.1, 0.05).thrust(values[1]),
]  # fmt: skip


@for_all("use", MASKED)
def test_a_mask_is_never_dropped(use):
    with pytest.raises(DefinitionError):
        use(masked(0.10, 0.11, 0.12))


def test_a_mask_over_poses_stays_a_pose_that_is_not_there():
    found = CylinderSize(0.1, 0.05).thrust(masked(1e6, 2e6, 3e6))
    assert np.isfinite(found[[0, 2]]).all() and np.isnan(found[1])


def test_a_mask_that_hides_nothing_has_many():
    plain = np.array([0.10, 0.11, 0.12])
    assert_array_equal(Hitch().at(S=np.ma.masked_array(plain))["G"], Hitch().at(S=plain)["G"])
