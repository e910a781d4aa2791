"""The side of a step as a choice of a synthesis: the same machine on its other branch, of groups, parts and parts lists too."""

import csv
import pickle
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import (
    LEFT,
    RIGHT,
    DefinitionError,
    Dyad,
    Ground,
    Mechanism,
    Part,
    PathTask,
    Stroke,
    least,
    mm,
    optimise,
    synthesise,
    transmission,
)
from linkage.steps import Step
from linkage.study.variants import on_sides
from mechanisms.at_work.tipper import Tipper
from mechanisms.classics.four_bar import FourBar
from mechanisms.classics.klann import Klann
from mechanisms.classics.stephenson_two import StephensonTwo
from mechanisms.three_point_hitch import ThreePointHitch
from tests.for_all import first_daily, for_all
from tests.linkage.synthesis import synthesis_tasks as papers
from tests.linkage.synthesis.synthesis_tasks import Bar, OtherBar, box, places


class Tailed(StephensonTwo):
    """A group of three pins, and a dyad that stands on it."""

    H = Ground(0.30, 0.05)
    T = Dyad("G", H, GT=0.10, HT=0.12, side=LEFT)


class Pair(Mechanism):
    """A four-bar and its mirror image as parts."""

    phi = Stroke(0.0, 2 * np.pi)

    one = Part(FourBar, phi=phi)
    two = Part(FourBar, phi=phi, at=(0.5, 0.0), mirrored=True)


class OtherFourBar(FourBar):
    """The same, written on its other branch."""

    B = Dyad("A", "C", AB=0.12, CB=0.08, side=RIGHT)


def sides_of(machine):
    """Return the sides of a machine's steps that have one."""
    return {name: step.side for name, step in machine.plan.of_kind(Step).items() if step.side is not None}


@for_all("kind", [FourBar, ThreePointHitch, Pair], slow=[Klann, Tailed])
def test_a_machine_on_other_sides_is_that_of_its_assembly(kind):
    machine = kind()
    strokes = {name: 0.3 * stroke.start + 0.7 * stroke.end for name, stroke in kind.plan.strokes.items()}
    known = [each for each in machine.assemblies(**strokes) if not each.is_declared and not each.pins]
    for each in known:
        other = on_sides(machine, each.sides)
        assert isinstance(other, kind) and dict(other.dimensions) == dict(machine.dimensions)
        assert {name: sides_of(other)[name] for name in each.sides} == dict(each.sides)
        pose = other.at(**strokes)
        for name, place in each.places.items():
            assert_allclose(pose[name].ravel(), place, rtol=0, atol=1e-9)
        back = on_sides(other, sides_of(machine))
        assert type(back) is kind
    assert known


@for_all(("kind", "name"), (), slow=[(FourBar, "B"), (Klann, "H"), (Tailed, "T"), (Pair, "two.B"), (Tipper, "G")])
def test_such_a_machine_goes_to_other_processes_and_is_one_class(kind, name):
    machine = kind()
    side = LEFT if sides_of(machine)[name] is RIGHT else RIGHT
    other = on_sides(machine, {name: side})
    again = pickle.loads(pickle.dumps(other))
    assert type(again) is type(other) is type(on_sides(machine, {name: side})) is not kind
    assert dict(again.dimensions) == dict(other.dimensions) and sides_of(again)[name] is side
    assert on_sides(other, {name: side}) is other
    changed = {each for each, value in sides_of(machine).items() if sides_of(other)[each] is not value}
    assert changed == {name}


@first_daily(0, "timed", [True, False])
def test_both_branches_of_a_bar_are_searched(timed):
    """The other branch has a better design for these points than the branch of the class."""
    known = OtherBar(OA=0.012, AB=0.036, CB=0.028, AP=0.022)
    at = np.linspace(0.2, 5.9, 10)
    vary = {"OA": (5 * mm, 20 * mm), "AB": (20 * mm, 60 * mm), "CB": (20 * mm, 60 * mm), "AP": (5 * mm, 40 * mm), "B.side": [LEFT, RIGHT]}
    task = PathTask(places(known, at).T, of="P", at=at)
    found = synthesise(Bar(), path=task, vary=vary, timed=timed, starts=8)
    assert found.best.most <= 1e-9 and sides_of(found.machine)["B"] is RIGHT
    assert "B.side = RIGHT" in found.best.sentence
    twin = OtherBar(**found.machine.dimensions)
    assert_allclose(places(twin, found.best.strokes), found.best.reached, rtol=0, atol=1e-12)
    assert found.machine.sweep(721).reached.all()


@pytest.mark.slow
def test_sides_stand_in_tables_rows_of_catalogues_and_rounded_machines(tmp_path):
    task = PathTask(np.array(papers.FIVE) * mm, of="P", at=papers.FIVE_AT)
    vary = box(50 * mm, held=True) | {("B.side", "AP"): [(LEFT, 2.4 * mm), ("right", 2.4 * mm), (RIGHT, 2 * mm)]}
    del vary["AP"]
    found = synthesise(Bar(), path=task, vary=vary, starts=6)
    with ThreadPoolExecutor(2) as pool:
        other = synthesise(Bar(), path=task, vary=vary, starts=6, executor=pool)
    assert str(other) == str(found) and {sides_of(each.machine)["B"] for each in found.solutions} == {LEFT, RIGHT}
    found.csv(tmp_path / "answers.csv")
    with open(tmp_path / "answers.csv", newline="", encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    assert [row["B.side"] for row in rows] == [str(sides_of(each.machine)["B"]) for each in found.solutions]
    for place, each in enumerate(found.solutions[:3]):
        assert sides_of(found.rounded(0.1 * mm, place=place).machine) == sides_of(each.machine)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("kind", "point", "name", "vary"),
    [
        (Pair, "two.P", "two.B.side", {"two.AB": (0.1, 0.14), "two.AP": (0.04, 0.09)}),
        pytest.param(Tailed, "T", "T.side", {"GT": (0.09, 0.12), "HT": (0.1, 0.14)}, marks=pytest.mark.slow),
        pytest.param(Tipper, "G", "G.side", {"OG": (1.5, 2.0), "CG": (0.5, 0.8)}, marks=pytest.mark.slow),
    ],
)
@pytest.mark.parametrize("timed", [True, pytest.param(False, marks=pytest.mark.slow)])
def test_groups_and_parts_have_branches(kind, point, name, vary, timed):
    step = name.removesuffix(".side")
    middle = {each: 0.4 * low + 0.6 * high for each, (low, high) in vary.items()}
    side = LEFT if sides_of(kind())[step] is RIGHT else RIGHT
    known = on_sides(kind(**middle), {step: side})
    (stroke,) = kind.plan.strokes.items()
    at = np.linspace(stroke[1].start, stroke[1].end, 9)[1:-1]
    task = PathTask(known.at(**{stroke[0]: at})[point].T, of=point, at=at)
    found = synthesise(kind(), path=task, vary=vary | {name: [LEFT, RIGHT]}, timed=timed, starts=16)
    assert found.best.most <= 1e-8 and sides_of(found.machine)[step] is side


def test_a_side_alone_may_vary():
    known = OtherFourBar()
    at = np.linspace(0.2, 5.9, 7)
    task = PathTask(known.at(phi=at)["P"].T, of="P", at=at)
    found = synthesise(FourBar(), path=task, vary={"B.side": [LEFT, RIGHT]})
    assert found.best.most <= 1e-12 and sides_of(found.machine)["B"] is RIGHT and found.starts == 2


@for_all(
    ("kind", "vary", "words"),
    [
        (FourBar, {"B.side": LEFT}, "a list of choices"),
        (FourBar, {"B.side": [LEFT, 0.3]}, "0.3 is no side; write a list of them"),
        (FourBar, {"P.side": [LEFT, RIGHT]}, "P has no side to choose; its sides are B.side"),
        (FourBar, {"X.side": [LEFT, RIGHT]}, "X has no side to choose"),
        (Tailed, {"F.side": [LEFT, RIGHT]}, "F is found together with B F G, whose mode is that of their places in the sketch"),
        (StephensonTwo, {"B.side": [LEFT, RIGHT]}, "write a class for each mode"),
    ],
)
def test_where_there_is_no_side_it_is_said(kind, vary, words):
    point = "P" if "P" in kind.plan.points else "F"
    with pytest.raises(DefinitionError, match=words):
        synthesise(kind(), path=PathTask([(0.0, 0.1)], of=point), vary=vary)


def test_a_side_that_a_group_stands_on_is_refused():
    class OnDyad(StephensonTwo):
        """The group's frame pin is a dyad's."""

        U, V = Ground(0.16, -0.04), Ground(0.24, -0.04)
        E = Dyad(U, V, UE=0.0566, VE=0.0566, side=LEFT)

    with pytest.raises(DefinitionError, match="the pins B F G stand on E"):
        synthesise(OnDyad(), path=PathTask([(0.0, 0.1)], of="F"), vary={"E.side": [LEFT, RIGHT]})


def test_optimise_refuses_a_side():
    with pytest.raises(DefinitionError, match="the side of B is varied by synthesise alone"):
        optimise(FourBar(), maximise=least(transmission("B")), vary={"OA": (0.03, 0.05), "B.side": [LEFT, RIGHT]})
