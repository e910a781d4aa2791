"""What is shown is what is judged: no value of a table, a curve or a report lies outside what the judge finds over all that is run."""

import csv
import io
import re
from functools import cache

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Cylinder, LiftCircuit, reserve, thrust
from linkage import LEFT, Acting, Dyad, Featured, Ground, LoadCase, Mechanism, OnLink, Over, Stroke, Support, Weight, least, most, plot
from linkage.cli.entry import main
from linkage.documents.content import TableBlock
from linkage.documents.outcome import limits_section
from linkage.documents.reporting import report_document
from linkage.documents.run import ReportSubject
from linkage.documents.worst_places import rule_row
from linkage.motion import Request
from linkage.pictures.page_forces import page_situations
from linkage.pictures.strokes import playback
from linkage.quantities import distance
from linkage.reports import results, run_of, runs_of
from linkage.units import UNITS, bar, deg, mm
from mechanisms.at_work.front_loader import LoadedFrontLoader
from tests.for_all import first_daily, for_all
from tests.shipped import AT_WORK, MACHINES


class Lift(Mechanism):
    """A boom OB on a cylinder AB, and on the boom's end an arm BD on a cylinder CD: two strokes, three load cases."""

    S, T = Stroke(0.0, 0.25), Stroke(0.0, 0.20)
    A, O = Ground(0.5, -0.3), Ground(0.0, 0.0)
    B = Dyad(O, A, OB=0.9, AB=0.6 + S, side=LEFT)
    C = OnLink(O, B, OC=0.5, BC=0.55, side=LEFT)
    D = Dyad(B, C, BD=0.3, CD=0.55 + T, side=LEFT)
    G = OnLink(B, D, BG=0.8, DBG=-120 * deg)
    boom, arm = Cylinder(A, B, bore=50 * mm, rod=30 * mm, closed=0.6, stroke=0.25), Cylinder(C, D, bore=40 * mm, rod=25 * mm, works="both")
    first, second = LiftCircuit(boom, pressure=180 * bar), LiftCircuit(arm, pressure=180 * bar)
    load = Weight(G, mass=150.0)
    heavy, empty = LoadCase("heavy", scale={"load": 1.6}), LoadCase("empty", scale={"load": 0.1})


class OfPaths(Lift):
    """Two paths, each with a load case of its own."""

    out = Over.path(S=[0.05, 0.15, 0.20], T=[0.05, 0.05, 0.12], cases=["heavy"])
    back = Over.path(S=[0.20, 0.05], T=0.08, cases=["empty"])
    about = Featured("reserve boom", ["G"], {"reserve boom": (1.0, "too heavy", "below")})


class OfABox(Lift):
    """A box in which both strokes run."""

    heavy = LoadCase("heavy load", scale={"load": 1.6})
    field = Over(S=(0.05, 0.20), T=(0.04, 0.15), cases=["heavy load"])
    about = Featured("reserve arm")


class OfCases(Lift):
    """A path and a box, each with two load cases and without the plain one."""

    out = Over.path(S=[0.05, 0.15, 0.20], T=[0.05, 0.05, 0.12], cases=["empty", "heavy"])
    field = Over(S=(0.05, 0.20), T=0.08, cases=["heavy", "empty"])
    about = Featured("reserve boom", ["G"], {"reserve boom": (1.0, "too heavy", "below")})


class OfPoses(Lift):
    """Poses with nothing between them, beside a path."""

    stops = Over.poses(S=[0.05, 0.10, 0.20], T=[0.10, 0.05, 0.15], cases=["empty", "plain"])
    going = Over.path(S=0.12, T=[0.05, 0.15], cases=["plain"])


class OfATurningBox(Lift):
    """A box of one stroke, and loads as they are declared."""

    raising = Over(S=(0.04, 0.2), T=0.08)


def declaring():
    """Return the shipped machines that declare where they run, by name; drives by their cylinders have no table along it."""
    found = {name: machine for name, machine in {**MACHINES, **AT_WORK}.items() if not name.endswith("_by_cylinder")}
    return {name: machine for name, machine in found.items() if machine.plan.of_kind(Over)}


@cache
def judged_ends(kind):
    """Return the least and the greatest value of what is asked of a machine of a class, by the names of its columns [SI]."""
    machine = kind()
    run = run_of(machine)
    found = results(machine, machine.at(unreachable="nan", **run.divided(3)), "plain")
    asked = {column.name: column.request for column in found if isinstance(column.request, Request)}
    judge = machine.judge().lost_allowed()
    lows, highs = judge.answers([*map(least, asked.values())]), judge.answers([*map(most, asked.values())])
    return {name: (float(low.value), float(high.value)) for name, low, high in zip(asked, lows, highs, strict=True)}


ROUNDING = 1e-9
"""What a force that is nought [N] may be off by rounding, and a length [m]."""


def check_within(name, values, ends, digits=0.0):
    """Check that values [SI] lie within what is judged, to rounding or to the digits that are printed."""
    low, high = ends
    finite = np.asarray(values, float)[np.isfinite(values)]
    near = 1e-6 * np.max(np.abs(finite), initial=0.0) + max(digits, ROUNDING)
    assert not finite.size or np.isnan(low) or finite.min() >= low - near, (name, finite.min(), low)
    assert not finite.size or np.isnan(high) or finite.max() <= high + near, (name, finite.max(), high)


def test_a_load_case_goes_by_its_title_wherever_it_is_named():
    machine = OfABox()
    found = [machine.answers([most(thrust("boom"))], over=Over(T=0.1, cases=[each]))[0].value for each in ("heavy", "heavy load")]
    asked = [machine.answers([most(thrust("boom"))], acting=Acting(case=each))[0] for each in ("heavy", "heavy load")]
    assert found[0] == found[1] and asked[0].value == asked[1].value and machine.overs[0].cases == ("heavy",)


@for_all("machine", [OfCases], slow=lambda: [OfPaths, OfPoses, OfABox, OfATurningBox, LoadedFrontLoader, *declaring().values()])
def test_every_column_of_every_run_lies_within_what_is_judged(machine):
    design = machine()
    ends, seen = judged_ends(machine), 0
    for run in runs_of(design):
        motion = design.at(unreachable="nan", **run.over(np.linspace(0.0, 1.0, 41)))
        columns = {column.name: column for column in results(design, motion, run.case)}
        for name, span in ends.items():
            if name in columns:
                check_within(f"{machine.__name__}, {run}: {name}", columns[name].values, span)
                seen += 1
    assert seen >= len(ends) * len(runs_of(design)) * 0.75  # a rope has columns under the machine's own loads alone


PRINTED = re.compile(r"[−-]?\d+(?:\.\d+)?")


@for_all("machine", (), slow=[OfCases, OfABox, OfPaths, OfPoses, LoadedFrontLoader])
def test_no_printed_value_of_a_report_lies_outside_what_is_judged(machine):
    """The tables of a report, cell by cell, in the units that stand in their headings."""
    ends, seen = judged_ends(machine), 0
    for block in (block for section in report_document(machine(), count=5).sections for block in section.blocks):
        if isinstance(block, TableBlock) and block.caption.startswith("Results"):
            for heading, cells in zip(block.headings, zip(*block.rows, strict=True), strict=True):
                name, _, unit = heading.partition(", ")
                if name in ends:
                    by = UNITS[unit][0] if unit else 1.0
                    values = np.array([float(cell.replace("−", "-")) if PRINTED.fullmatch(cell) else np.nan for cell in cells]) * by
                    digits = 0.6 * 10.0 ** -len(cells[0].partition(".")[2]) * by
                    check_within(f"{machine.__name__}, {block.caption}: {heading}", values, ends[name], digits)
                    seen += 1
    assert seen


@first_daily(1, "machine", [OfCases, OfPoses, OfATurningBox, OfPaths, OfABox])
def test_a_table_of_the_command_and_a_plot_show_the_same_runs(machine, capsys, monkeypatch):
    monkeypatch.setattr("linkage.cli.settings.find", lambda name: machine)
    design, ends = machine(), judged_ends(machine)
    assert main(["table", "ours", "--count", "5", "--csv", "-"]) == 0
    rows = list(csv.DictReader(io.StringIO(capsys.readouterr().out)))
    runs = runs_of(design)
    assert len({row.get("run", "") for row in rows}) == len(runs)
    for heading in rows[0]:
        name, _, unit = heading.partition(", ")
        if name in ends:
            values = np.array([float(row[heading] or "nan") for row in rows]) * (UNITS[unit][0] if unit else 1.0)
            check_within(f"{machine.__name__}: {heading}", values, ends[name])
    figure = plot(design, ["reserve boom", "thrust arm"], count=21)
    curves = [ax for ax in figure.axes if ax.lines]
    assert len(curves) == 2 * sum(run.is_curve for run in runs)
    for ax in curves:
        name, values = "thrust arm", 1e3 * np.asarray(ax.lines[0].get_ydata())
        if ax.get_title(loc="left").startswith("1/reserve boom, %"):
            name, values = "reserve boom", 1e5 / values
        check_within(name, values, ends[name])


def test_every_command_shows_a_path_in_the_load_case_that_occurs_there(capsys, monkeypatch, tmp_path):
    """A direction that is asked for, and a motion over the path in place of its machine, leave the case as it is."""
    monkeypatch.setattr("linkage.cli.settings.find", lambda name: OfPaths)
    motion, figures = OfPaths().sweep(5, over="back"), []
    wanted = motion[thrust("boom", case="empty")]
    monkeypatch.setattr("linkage.pictures.plot", lambda *given, **more: figures.append(plot(*given, **more)) or figures[-1])
    picture = ["-o", str(tmp_path / "back.png")]
    for more in ([], ["--direction", "frictionless"]):
        assert main(["table", "ours", "thrust boom", "--over", "back", "--count", "5", "--csv", "-", *more]) == 0
        found = [float(row["thrust boom, kN"]) for row in csv.DictReader(io.StringIO(capsys.readouterr().out))]
        assert main(["plot", "ours", "thrust boom", "--over", "back", "--count", "5", *picture, *more]) == 0
        capsys.readouterr()
        for each in (found, figures.pop().axes[0].lines[0].get_ydata()):
            assert_allclose(each, wanted / 1e3, rtol=1e-4)
    assert main(["plot", "ours", "thrust boom", "--over", "back", "--count", "5", "--case", "plain", *picture]) == 0
    assert_allclose(figures.pop().axes[0].lines[0].get_ydata(), motion[thrust("boom")] / 1e3, rtol=1e-9)
    assert main(["export", "ours", "-o", str(tmp_path / "back.csv"), "--over", "back", "--count", "5"]) == 0
    with (tmp_path / "back.csv").open() as stream:
        assert_allclose([float(row["thrust boom, kN"]) for row in csv.DictReader(stream)], wanted / 1e3, rtol=1e-9)
    played = playback(OfPaths(), 5, "thrust boom", at=motion, eased=False)
    assert_allclose(played.column.values, wanted, rtol=1e-9)
    assert main(["plot", "ours", "--over", "back", "--count", "5", *picture]) == 0
    assert figures.pop().axes[0].get_title(loc="left").startswith("1/reserve boom, %")
    assert main(["plot", "ours", "thrust boom", "--at", "S=0.05,0.1", *picture]) == 0


def test_a_table_of_several_boxes_says_where_other_strokes_are_held(capsys, monkeypatch):
    monkeypatch.setattr("linkage.cli.settings.find", lambda name: OfABox)
    overs = ["--over", "S=0.05:0.20,T=0.04:0.15", "--over", "S=0.05:0.10,T=0.04:0.15"]
    for case in ([], ["--case", "heavy"]):
        assert main(["table", "ours", "S", "--count", "3", *overs, *case]) == 0
        assert capsys.readouterr().out.count("; T where reserve arm is worst") == 2


class OfAThrust(Lift):
    """A box of both strokes, about a thrust that has no limit."""

    field = Over(S=(0.05, 0.20), T=(0.04, 0.15), cases=["heavy"])
    about = Featured("thrust arm")


def test_a_thrust_is_worst_where_it_is_greatest_in_size():
    machine, (run,) = OfAThrust(), runs_of(OfAThrust())
    S, asked = np.linspace(0.05, 0.20, 7), thrust("arm", case="heavy")
    pulls = machine.at(S=S[:, None], T=np.linspace(0.04, 0.15, 7))[asked]
    assert run.worst == "thrust arm" and run.case == "heavy" and pulls.max() < 0.0
    assert machine.at(S=S, **run.held)[asked].min() <= pulls.min() * (1.0 - 1e-9)


class OnWheels(OfPaths):
    """The same on a frame with two axles, which tips where its arm reaches far under the heavy load, and is not judged there."""

    M, front_axle, rear_axle = Ground(-0.6, 0.2), Ground(0.9, -0.5), Ground(-1.2, -0.5)
    front, rear = Support("front_axle", (0, 1), friction=0.6), Support("rear_axle", (0, 1), friction=0.6)
    body = Weight("M", mass=500.0)


@pytest.mark.slow
def test_a_report_looks_at_forces_and_limits_where_the_machine_is_judged():
    subject = ReportSubject.of(OnWheels(), {}, 5)
    assert {(one.case, round(float(np.max(one.motion.strokes["T"])), 3)) for one in subject.forces} == {("heavy", 0.12), ("empty", 0.08)}
    verdicts = {verdict.heading: verdict for verdict in OnWheels().verdicts()}
    nearest = PLACED.findall(next(verdict.sentence for verdict in verdicts.values() if verdict.rule == "dead points"))
    assert nearest and {*nearest} <= {row[2] for row in limits_section(subject).blocks[0].rows}
    kept = float(re.search(r": ([\d.]+) % of the", verdicts["axle load rear"].sentence)[1])
    shares = {name: rule_row(subject, each, each.answer).used for name, each in verdicts.items() if each.answer is not None}
    assert_allclose(shares["axle load rear"], 1.0 - kept / 100.0, atol=0.006)
    rows = {name: (rule_row(subject, each, each.answer), each.sentence) for name, each in verdicts.items() if each.answer is not None}
    in_percent = {name for name, (row, sentence) in rows.items() if f"{row.answer.value:.3g} %" in sentence}
    assert in_percent == {name for name, (row, _) in rows.items() if row.sign == " %"} == {"slipping"}
    assert shares["length"] == 0.0
    (safety,) = re.findall(r"safety ([\d.]+), at least", verdicts["buckling boom"].sentence)
    assert_allclose(rule_row(subject, verdicts["buckling boom"], verdicts["buckling boom"].answer).answer.value, float(safety), rtol=5e-3)


def test_what_is_worked_out_from_one_worst_value_is_of_the_same_place():
    """The greatest of all runs stands in the quotient, not the one of the run that gives the greatest quotient."""
    highest, share, below = OfPaths().answers([most(thrust("boom")), 3.5 / most(thrust("boom")), -1.0 * most(thrust("boom"))])
    assert_allclose((float(share.value), float(below.value)), (3.5 / highest.value, -highest.value), rtol=1e-12)
    assert share.where == below.where == highest.where and share.over == highest.over


def test_a_stroke_that_changes_nothing_is_told_at_its_start():
    """The boom's stroke turns O and G alike: their distance follows the arm's alone, to rounding."""
    for found in OfABox().answers([most(distance("O", "G")), least(distance("O", "G")), most(distance("O", "B"))]):
        assert found.strokes["S"] == 0.05
    assert found.strokes == {"S": 0.05, "T": 0.04}


PLACED = re.compile(r"at (\w+ = -?[\d.]+ mm)")


def test_a_run_is_asked_for_by_its_strokes_as_before():
    assert [run.title for run in runs_of(OfPaths())] == ["out", "back"]
    (asked,) = runs_of(OfPaths(), dict(S=(0.0, 0.25)))
    assert (asked.ways, asked.held, asked.title, asked.case) == ({"S": (0.0, 0.25)}, {"T": 0.1}, "", "heavy")  # plain in no Over
    (undeclared,) = runs_of(Lift())
    assert (undeclared.ways, undeclared.held, undeclared.title) == ({"S": (0.0, 0.25)}, {"T": 0.1}, "")


def test_a_box_of_several_strokes_is_shown_at_its_worst_place():
    """The others are held where the least reserve of all stands, found here on a grid."""
    (run,) = runs_of(OfABox())
    assert (list(run.ways), run.case, run.worst) == (["S"], "heavy", "reserve arm")
    S, T = np.meshgrid(np.linspace(0.05, 0.20, 41), np.linspace(0.04, 0.15, 41), indexing="ij")
    found = OfABox().at(S=S, T=T)[reserve("arm", case="heavy")]
    assert_allclose(run.held["T"], T.ravel()[np.argmin(found)], atol=0.004)


def test_of_several_load_cases_the_worst_is_shown_on_paper_and_on_pages():
    """The boom has the least reserve under the heavy load, wherever that stands among the cases."""
    design = OfCases()
    assert [run.case for run in runs_of(design)] == ["heavy", "heavy"]
    situations, numbers = page_situations(design, design.judge(), run_of(design))
    assert [situations[k].case for k in numbers] == ["heavy", "heavy"]
    assert [run.case for run in runs_of(design, acting=Acting(case="empty"))] == ["empty", "empty"]


def test_an_animation_plays_the_first_run_and_poses_have_no_curve():
    played = playback(OfPoses(), 11)
    assert_allclose(played.motion.strokes["S"], 0.12)
    stops, going = runs_of(OfPoses())
    assert (stops.is_curve, going.is_curve) == (False, True)
    assert_allclose(stops.over(np.linspace(0.0, 1.0, 50))["T"], [0.10, 0.05, 0.15])


def test_a_load_case_that_is_asked_for_leaves_the_runs_in_which_it_occurs():
    assert [run.title for run in runs_of(OfPaths(), acting=Acting(case="empty"))] == ["back"]
    assert {run.case for run in runs_of(OfPaths(), acting=Acting(case="plain"))} == {None}
