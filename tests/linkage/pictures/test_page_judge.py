"""What a live page says of its questions is what Python's judge says of the same poses: numbers to 1e-9, and whether they are kept."""

import json
import re
import subprocess
from functools import partial
from typing import ClassVar

import numpy as np
import pytest

from hydraulics import Cylinder, LiftCircuit, OilLine, Pump, Tank, Telescope, pressure, thrust
from hydraulics.cylinders import AllOf
from linkage import (
    RIGHT,
    Dimension,
    Dyad,
    Force,
    Ground,
    Guide,
    LoadCase,
    Mechanism,
    OnGuide,
    OnLink,
    Over,
    Stroke,
    Verdict,
    Weight,
    at,
    least,
    most,
    y,
)
from linkage.cli.listing import registered
from linkage.cli.machines import find
from linkage.language import language
from linkage.motion import HasVerdicts, judged_poses, live_text, pose_sentence
from linkage.motion.motion_verdicts import rules_of
from linkage.pictures.page_data import PageRequests, fact_data, page_data
from linkage.pictures.page_file import page_part
from linkage.pictures.shown_values import typeset
from linkage.reports import is_column
from linkage.units import SYSTEMS, bar, deg, kN, mm, show, shown_number, unit_system
from mechanisms.crane import Crane
from mechanisms.grapple import Grapple
from mechanisms.mower_lift import MowerLift
from mechanisms.three_point_hitch import ThreePointHitch
from tests.for_all import first_daily, for_all
from tests.linkage.known_machines import GrabArms
from tests.linkage.motion.in_node import NEEDED, SHIPPED, designs_near, elsewhere, possible

SLOW = pytest.mark.slow
RUNNER = """
const fs=require('fs'),job=JSON.parse(fs.readFileSync(0,'utf8'));
const {engine,judging}=new Function(job.text+';return {engine,judging}')();
const judge=judging(engine,job.judge),shown=x=>typeof x==='number'&&!Number.isFinite(x)?String(x):x;
const here=(design,at)=>judge.here(at,engine.sweep(design,at.map(s=>[s])));
const found=job.asked.map(([design,n,refines])=>Array.isArray(n)?here(design,n):judge.ask(design,n,refines));
process.stdout.write(JSON.stringify(found,(_,x)=>shown(x)));
"""


class Grab(GrabArms):
    """A boom and a jib on cylinders: two strokes, two load cases, a stroke that is declared, two circuits."""

    shock = LoadCase("with shock", scale={"load": 1.8})
    lift = Cylinder("A", "B", bore=80 * mm, rod=45 * mm, closed=0.64, stroke=0.26)
    pump = LiftCircuit(lift, pressure=160 * bar, relief=180 * bar)
    jib = Cylinder("D", "H", bore=40 * mm, rod=22 * mm, works="both")
    aid = LiftCircuit(jib, pressure=120 * bar, mechanical_efficiency=0.9)


class Staged(Grab):
    """The same on a telescope, whose stages are pieces that have a law over a part of the stroke each."""

    lift = Telescope("A", "B", bores=[80 * mm, 60 * mm], strokes=[0.13, 0.13], closed=0.64)


class Compares(HasVerdicts):
    """What is compared of a cylinder that works both ways, whose pressure is that of the side that holds."""

    kind = "comparison"
    rules: ClassVar = {
        "highest": most(pressure("ram")) >= 20 * bar,
        "lowest": least(pressure("ram")) <= 0.1 * bar,
        "pose": at(pressure("ram"), S=0.3) >= 1 * bar,
        "pin": at(y("O")) <= 1 * mm,
        "half": least(0.5 * pressure("ram") + 1 * bar) >= 0.9 * bar,
        "below": most(90 * bar - pressure("ram")) <= 91 * bar,
        "apart": most(pressure("ram")) - most(abs(thrust("ram"))) / (100 * mm) ** 2 <= 60 * bar,
        "turned": least(-pressure("ram")) >= -99 * bar,
    }

    def parts(self):
        return ()

    def conditions(self, judge):
        return self.rules

    def questions(self, judge):
        return list(self.rules.values())

    def verdicts(self, judge):
        return [Verdict(rule, judge.answer(each).ok, rule) for rule, each in self.rules.items()]


class Dumper(Mechanism):
    """A body that tips over its pin, so that its cylinder pushes it up and then holds it back."""

    S = Stroke(0.0, 0.75)
    O, A = Ground(0.0, 0.0), Ground(0.9, -0.1)
    B = Dyad(A, O, AB=0.45 + S, OB=0.8, side=RIGHT)
    G = OnLink(O, B, OG=1.2, BOG=25 * deg)
    load = Weight(G, mass=2000.0)
    ram = Cylinder(A, B, bore=80 * mm, rod=45 * mm, works="both")
    pump = LiftCircuit(ram, pressure=160 * bar)
    compares = Compares()


@NEEDED
def test_a_page_rounds_as_python_does():
    """Halves, which languages round two ways, and values beside a limit that they miss, which are told from it."""
    random = np.random.default_rng(3)
    halves = [(random.integers(-9999, 9999) / 2.0**k, k - 1) for k in (1, 2, 3, 4) for _ in range(15)]
    parts = [1.0 + sign * 10.0**-k for k in range(2, 9) for sign in (-1, 1)]
    near = [(limit * part, limit) for part in parts for limit in random.uniform(1e5, 3e7, 5).tolist()]
    near += [(170.02 * bar, 170.0 * bar), (170.0 * bar, 170.0 * bar), (170.0 * bar, 165.0 * bar)]
    text = re.search(r"(?s)const minus.*?(?=const signed)", page_part("mechanism.js"))[0]
    text += "const shown=(value,{factor,unit},digits)=>`${short(value/factor,digits)} ${unit}`;"
    text += re.search(r"(?s)const size = .*?\n};", page_part("verdicts.js"))[0]
    said = "job[0].map(([v,d])=>fixed(v,d)).concat(job[1].map(([v,l])=>size(v,{factor:1e5,unit:'bar'},l)))"
    code = f"const {{abs,min,max,floor,ceil,log10,round}}=Math,isNumber=Number.isFinite;{text};const job={json.dumps([halves, near])}"
    run = subprocess.run(["node", "-e", f"{code};console.log(JSON.stringify({said}))"], capture_output=True, text=True, check=True)
    found = [each.replace("\u202f", "").replace("\u2212", "-") for each in json.loads(run.stdout)]
    expected = [f"{value:z.{digits}f}" for value, digits in halves] + [show(value, "bar", 4, limit) for value, limit in near]
    assert found == expected
    assert all(value == limit or show(limit, "bar", 4) != show(value, "bar", 4, limit) for value, limit in near)
    assert (shown_number(0.9999996, "", ".3f", 1.0), shown_number(1.0, "", ".3f", 1.0)) == ("0.9999996", "1.000")
    assert expected[-3:] == ["170.02 bar", "170 bar", "170 bar"]


@NEEDED
def test_a_measure_of_both_sides_of_a_cylinder_is_one_number_at_every_door():
    count, kept = check(Dumper(), [{}, {"load.mass": 4000.0}])
    assert count >= 14 and kept == {True, False}  # all but that at a pose of its own, which is as delivered
    machine = Dumper()
    motion = machine.sweep(101)
    table = motion[pressure("ram")]
    assert motion[thrust("ram")].min() < 0.0 < motion[thrust("ram")].max()
    over = Over.poses(**{name: value.tolist() for name, value in motion.strokes.items()})
    for formula in (partial(np.multiply, 1.0), partial(np.multiply, -0.5), partial(np.subtract, 90 * bar), partial(np.add, 1 * bar)):
        each, values = formula(pressure("ram")), formula(table)
        found = [answer.value for answer in machine.answers([least(each), most(each)], over=over)]
        assert found == pytest.approx([values.min(), values.max()], rel=1e-12)


class Backed(Mechanism):
    """A ram upright, whose rod side is on a tank: `holding` bounds a pressure and a force."""

    S = Stroke(0.0, 0.5)
    O = Ground(0.0, 0.0)
    rail = Guide(O, angle=90 * deg)
    P = OnGuide(rail, at=1.0 + S)
    ram = Cylinder(O, P, bore=120 * mm, rod=85 * mm)
    load = Force(P, (0.0, -40 * kN))
    line, back = OilLine(ram.piston_side, Pump(200 * bar)), OilLine(ram.rod_side, Tank(5 * bar))


@NEEDED
def test_what_bounds_a_pressure_and_a_force_is_told_in_the_unit_of_the_one_that_counts():
    rod = 5 * bar * np.pi / 4 * (0.12**2 - 0.085**2)
    _, data, found = asked_in_node(Backed(), [({"load.y": force}, 5, True) for force in (-40 * kN, 30 * kN)])
    q, question = next((q, each) for q, each in enumerate(data["questions"]) if each["rule"].startswith("holding"))
    held, pulled = (each["found"][q] for each in found)
    units = [question["constraints"][each["c"]].get("unit", question["unit"])["unit"] for each in (held, pulled)]
    assert (held["kept"], pulled["kept"], units) == (True, False, ["bar", "kN"])
    assert [held["value"], pulled["value"]] == pytest.approx([(40 * kN + rod) / (np.pi / 4 * 0.12**2), rod - 30 * kN], rel=1e-9)
    assert f"holding line {(rod - 30 * kN) / kN:.4g} kN" in pose_sentence(Backed(**{"load.y": 30 * kN}).at(S=0.2))
    judge = Backed(**{"load.y": -400 * kN}).judge()
    assert judge.answer(rules_of(judge)["holding line"][2]).measures == "pressure"  # of the two that which counts


class Strong(Compares):
    """What bounds a pressure, a force from both ends, and a length, as one rule."""

    kind = "strength"
    limits: ClassVar = (most(pressure("ram")) <= 120 * bar, least(-1.0 * thrust("ram")) >= -80 * kN)
    rules: ClassVar = {"strength": AllOf((*limits, least(y("P")) >= 0.7, most(thrust("ram")) >= 12 * kN, least(y("P")) >= 0.0))}


class Bounded(Backed):
    strong = Strong()


def test_what_is_on_the_wrong_side_of_its_limit_has_a_bar_and_stands_first():
    class Levels(Compares):
        rules: ClassVar = {"low": least(y("G")) >= 3.0, "behind": least(-y("G")) >= 0.1, "kept": least(y("G")) >= -1.0}

        def verdicts(self, judge):
            answers = {rule: judge.answer(each) for rule, each in self.rules.items()}
            return [Verdict(rule, each.ok, rule, answer=each) for rule, each in answers.items()]

    machine = type("Levelled", (Dumper,), {"compares": Levels()})()
    requests = PageRequests(machine, 5)
    shares = {each.rule: fact_data(requests, each)[3:] for each in machine.verdicts() if each.is_rule}
    assert shares["behind"] == [1e6] > shares["low"] > [1.0] and shares["lowering"] == []  # that is kept


@NEEDED
def test_of_unlike_kinds_that_one_counts_whose_limit_is_used_most():
    """A margin of 1 bar is 1e5 and one of 1 kN 1e3 of their units: what is left of each limit is compared in parts of it."""
    random = np.random.default_rng(8)
    designs = [{"load.y": -float(force)} for force in random.uniform(10 * kN, 140 * kN, 12)] + [{"load.y": 5 * kN}]
    designs += [{"load.y": -60 * kN, "ram.bore": bore} for bore in (0.09, 0.1, 0.16)]
    _, data, found = asked_in_node(Bounded(), [(design, 5, True) for design in designs])
    q = next(q for q, each in enumerate(data["questions"]) if each["rule"] == "strength")
    counted = set()
    for design, asked in zip(designs, found, strict=True):
        judge, live = Bounded(**design).judge(), asked["found"][q]
        single = [judge.answer(each) for each in Strong.rules["strength"].each]
        alone = [*map(share_by_hand, single)]
        whole = judge.answer(Strong.rules["strength"])
        chosen = alone.index(max(alone))
        assert live["c"] == chosen and whole.value == single[chosen].value and whole.measures == single[chosen].measures
        assert whole.used == pytest.approx(alone[chosen]) == number(live["used"])
        assert live["kept"] == whole.ok == all(each.ok for each in single)
        counted.add(chosen)
    assert counted >= {0, 1, 2, 3}


def share_by_hand(answer):
    """Return how far a limit is used: a bound from above by value over limit, from below the other way."""
    value, limit = float(answer.value), float(answer.question.right.from_leaves({}))
    if answer.question.symbol == ">=" and limit > 0.0:
        return limit / value if value > 0.0 else np.inf
    return value / limit if limit else 0.0 if answer.ok else np.inf


class Cornered(Grab):
    """The same with a longer jib cylinder, which leaves a part of the box, over a path and a box with a condition."""

    T = Stroke(0.0, 0.75)
    work = Over(T=(0.0, 0.7), cases=("shock",), lost="allowed")
    way = Over.path(S=[0.0, 0.1, 0.25], T=[0.0, 0.2, 0.1])


class Lost(Cornered):
    """The same, which nobody allows to be lost: nothing is kept."""

    work = None
    way = Over(T=(0.0, 0.7))


class CorneredOnce(Cornered):
    """The same with the boom's cylinder alone: fewer rules."""

    jib = aid = None


class OnPath(CorneredOnce):
    """The same, judged along its path alone."""

    work = None


class LostOnce(Lost):
    """The same, lost."""

    jib = aid = None


def asked_in_node(machine, jobs):
    """Return the page's questions of a machine, and what JavaScript says of some designs: (dimensions, values a stroke, refined)."""
    requests = PageRequests(machine, 11, at={})
    live = live_text(machine.plan, requests.by_name, name="engine")
    data = requests.questions.data(live)
    asked = [([float({**machine.dimensions, **design}[name]) for name in live.dimensions], n, refines) for design, n, refines in jobs]
    given = json.dumps({"text": f"{live.text}\n{page_part('judge.js')}", "judge": data, "asked": asked})
    run = subprocess.run(["node", "-e", RUNNER], input=given, capture_output=True, text=True)
    assert not run.returncode, run.stderr[-2000:]
    return requests.questions, data, json.loads(run.stdout)


def poses_of(over, motion, n):
    """Return the grid of an `Over` that the page looks at, as poses."""
    if over.shape == "box":
        axes = [np.linspace(np.min(each), np.max(each), n if np.ptp(each) else 1) for each in motion.strokes.values()]
        grid = [each.ravel() for each in np.meshgrid(*axes, indexing="ij")]
    else:
        legs = [np.ravel(each) for each in motion.strokes.values()]
        along = np.linspace(0.0, len(legs[0]) - 1.0, (len(legs[0]) - 1) * (n - 1) + 1)
        grid = [np.interp(along, np.arange(len(each)), each) for each in legs]
    values = {name: each.tolist() for name, each in zip(motion.strokes, grid, strict=True)}
    return Over.poses(only=over.only, cases=over.cases, lost=over.lost, **values)


def number(value):
    return {"Infinity": np.inf, "-Infinity": -np.inf, "NaN": np.nan}.get(value, value)


def check(machine, designs, n=9):
    """Compare the page's answers with Python's over the same poses; return how many were compared, and what was kept."""
    questions, data, found = asked_in_node(machine, [(design, n, False) for design in designs])
    known = {rule: constraints for rule, constraints, _ in questions.asked}
    count, kept = 0, set()
    for design, said in zip(designs, found, strict=True):
        other = machine.replaced(**design)
        judge = other.judge()
        overs = [poses_of(place.over, place.motion, said["n"]) for place in judge.places]
        for asked, live in zip(data["questions"], said["found"], strict=True):
            if live.get("unknown"):
                continue
            own = any(is_column(leaf.quantity) for each in known[asked["rule"]] for leaf in each.margin.leaves)
            where = [each for each in overs if not own or each.cases is None or "plain" in each.cases]
            if not where:  # a table's own column, in cases that do not occur
                continue
            answers = other.answers(known[asked["rule"]], over=where)
            if any(each.ok is False for each in answers):
                assert live["ok"] is False, (asked["rule"], live, list(map(str, answers)))
            else:
                assert live["ok"] is (None if all(each.ok is None for each in answers) else True), (asked["rule"], live)
            chosen = answers[live.get("c", 0)]
            assert number(live["value"]) == pytest.approx(float(chosen.value), rel=1e-9, abs=1e-9, nan_ok=True), asked["rule"]
            count += 1
            kept.add(live["ok"])
    return count, kept


@NEEDED
@pytest.mark.parametrize(
    ("machine", "lengths"),
    [
        *((each, 1) for each in (ThreePointHitch, MowerLift)),
        *(pytest.param(each, 0, marks=SLOW) for each in (Staged, Grab, CorneredOnce)),  # two strokes: Python looks at many poses
        *(pytest.param(each, 3, marks=SLOW) for each in (ThreePointHitch, Grapple, Grab, CorneredOnce, LostOnce, Cornered, Lost)),
    ],
)
def test_a_page_says_of_its_poses_what_python_says(machine, lengths):
    names = [name for name, entry in machine.plan.table.entries.items() if entry.kind == "length"][:lengths]
    designs = [{}, *({name: machine().dimensions[name] * factor} for name in names for factor in (0.98, 1.03))]
    count, kept = check(machine(), designs)
    assert count >= len(designs)
    assert (True in kept) is (not issubclass(machine, Lost))


MACHINES = {name: each for name, each in {**SHIPPED, **dict(elsewhere())}.items() if each.plan.of_kind(HasVerdicts)}
AT_REST = [name for name, each in MACHINES.items() if all(over.time is None for over in each.plan.of_kind(Over).values())]
QUICK = ("axle", "lifting_arm", "plough", "toggle_press")


def near(machine, seed, count, spread=0.03):
    """Return random designs of a machine that it takes, one by one."""
    found = possible(machine, designs_near(machine, seed, count, spread))
    return [{name: float(value[k]) for name, value in found.items()} for k in range(max(map(len, found.values())))]


def test_every_shipped_machine_that_judges_itself_is_among_them():
    known = {find(name) for name in registered()}
    assert {each for each in known if each.plan.of_kind(HasVerdicts)} <= set(MACHINES.values())


@NEEDED
@for_all("name", QUICK[:2], slow=QUICK[2:])
def test_a_page_says_of_random_designs_what_python_says(name):
    count, kept = check(MACHINES[name](), near(MACHINES[name], 31, 2))
    assert count >= 2 and kept & {True, False}


@NEEDED
@SLOW
@pytest.mark.parametrize("name", AT_REST)  # what is asked along a path in time: test_page_in_time.py
def test_a_page_says_of_a_hundred_random_designs_what_python_says(name):
    spread = 0.01 if name == "scissor_lift" else 0.03  # by 3 % it begins below the floor, where its thrust is nothing but rounding
    for lot in range(10):
        check(MACHINES[name](), near(MACHINES[name], lot, 10, spread))


class Follows(Grab):
    """The same, which runs along a path and over a box whose ends follow dimensions."""

    far, deep = Dimension(0.24), Dimension(0.02)
    way = Over.path(S=["deep", 0.1, far], T=[0.0, far * 0.5, "deep"])
    box = Over(S=(far, 0.05), T=("deep", 0.2))


@pytest.mark.slow
@NEEDED
def test_ends_that_follow_the_design_are_those_of_the_changed_one():
    count, kept = check(Follows(), [{}, {"far": 0.2, "deep": 0.05}, {"far": 0.11}])
    assert count > 3 and kept >= {True}


@NEEDED
@SLOW
def test_the_cranes_page_says_of_its_poses_what_python_says():
    count, kept = check(Crane(), [{}])
    assert count >= 9 and kept == {True, False}


@NEEDED
def test_it_looks_at_five_thousand_poses_at_most_and_finer_where_it_is_worst():
    _, _, (coarse, fine, refined) = asked_in_node(Grab(), [({}, 9, False), ({}, 17, False), ({}, 17, True)])
    assert (coarse["n"], fine["n"], refined["n"]) == (9, 17, 17)
    assert coarse["count"] == 81 and fine["count"] == 289 and refined["count"] <= 5000
    for a, b, c in zip(coarse["found"], fine["found"], refined["found"], strict=True):
        if None not in (a["ok"], b["ok"], c["ok"]) and a["c"] == b["c"] == c["c"]:
            assert c["margin"] <= b["margin"] <= a["margin"] + 1e-9


@NEEDED
@SLOW
def test_it_looks_at_five_thousand_poses_of_the_crane_at_most():
    _, _, (crane,) = asked_in_node(Crane(), [({}, 17, True)])
    assert crane["n"] == 17 and crane["count"] <= 5000


@pytest.mark.slow
@NEEDED
def test_a_live_reserve_is_near_that_of_the_delivered_verdict():
    _, data, (said,) = asked_in_node(Grab(), [({}, 17, True)])
    place = next(k for k, each in enumerate(data["questions"]) if each["rule"] == "lifting pump")
    verdict = next(each for each in Grab().verdicts() if getattr(each, "rule", "") == "lifting pump")
    assert said["found"][place]["value"] == pytest.approx(verdict.answer.value, rel=1e-3)
    assert said["found"][place]["case"] == verdict.answer.titles[verdict.answer.case] == "with shock"


@pytest.mark.slow
@NEEDED
def test_of_one_pose_it_says_what_python_says_and_whether_it_is_judged():
    machine, random = OnPath(**{"load.mass": 900.0}), np.random.default_rng(4)
    every = {name: random.uniform(each.start, each.end, 24) for name, each in machine.strokes.items()}
    share = random.uniform(0.0, 2.0, 24)  # half of them near the path
    for name, places in {"S": [0.0, 0.1, 0.25], "T": [0.0, 0.2, 0.1]}.items():
        every[name][::2] = np.interp(share, range(3), places)[::2]
    motion = machine.at(unreachable="nan", **every)
    at = np.array([*every.values()]).T[motion.reached]
    _, data, found = asked_in_node(machine, [({}, each.tolist(), False) for each in at])
    judged = judged_poses(machine.judge(), motion)[motion.reached]
    assert [each["covered"] for each in found] == judged.tolist() and {*judged.tolist()} == {True, False}
    seen = set()
    for strokes, said in zip(at, found, strict=True):
        text = pose_sentence(machine.at(**dict(zip(machine.strokes, strokes, strict=True))))
        assert ("outside what is judged" in text) is not said["covered"]
        for question, each in zip(data["questions"], said["found"], strict=True):
            assert (re.search(rf"\b{question['rule']} [-\d]", text) is not None) is (each["ok"] is False), (text, question["rule"], each)
            seen.add(each["ok"])
    assert seen == {True, False}


def test_a_rule_whose_question_hangs_on_the_design_is_the_delivered_sentence():
    """Which way the load drives a cylinder of two sides back is of the design: a page that kept the way judged another rule than Python."""
    requests = PageRequests(Grab(), 11, at={})
    rules = [rule for rule, *_ in requests.questions.asked]
    assert "lowering pump" in rules and "lowering aid" not in rules and {"lifting aid", "holding aid"} <= {*rules}
    data = page_data(requests, live_text(requests.machine.plan, requests.by_name, name="engine"))
    assert [heading for heading, _ in delivered(data, "en", "")].count("lowering aid") == 1


def delivered(data, name, system):
    """Return the lines of delivered verdicts that a page shows in a language and a system of units, "" for the delivered one."""
    said = []
    for k, (_, heading, sentence, *russian) in enumerate(data["verdicts"]):
        others = data["verdictsIn"][system][k] if system else 0
        english, in_russian = (sentence, russian[1:]) if others == 0 else (others[0], others[1:])
        if name == "ru":
            heading, english = (russian or [heading])[0], (in_russian or [english])[0]
        said.append((heading, english))
    return said


def told(machine, name, system):
    """Return the headings and sentences of a machine's verdicts, the powers of units raised as a page has them."""
    with language(name), unit_system(system or None):
        return [(getattr(each, "heading", ""), typeset(getattr(each, "sentence", str(each)))) for each in machine.verdicts()]


def check_delivered(machine):
    """Assert that a page has a machine's verdicts word for word, in both languages and all systems of units."""
    requests = PageRequests(machine, 11, at={})
    data = page_data(requests, live_text(machine.plan, requests.by_name, name="engine"))
    for name in ("en", "ru"):
        for system in ("", *SYSTEMS):
            assert delivered(data, name, system) == told(machine, name, system)


@first_daily(1, "name", sorted(MACHINES, key=lambda name: name != "lifting_arm"))
def test_delivered_verdicts_are_pythons_word_for_word(name):
    for design in near(MACHINES[name], 17, 4):
        check_delivered(MACHINES[name](**design))
