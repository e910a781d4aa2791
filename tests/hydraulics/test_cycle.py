"""A working cycle as its users see it: programmes in files, the command, the chart, the table, the report's part, the live page."""

import csv
import pickle

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import LiftCircuit, Pump
from hydraulics.cli import programme_read
from linkage import Acting, Course, DefinitionError, Dimension, Over, ramp
from linkage.cli import main
from linkage.errors import FileError
from linkage.pictures.page_data import event_data
from linkage.units import bar, litre, minute, show
from tests.hydraulics.test_pump import AREA, FLOW, OneBlock, TwoBlocks, TwoLifts, pump_of
from tests.members import told_by

PROGRAMME = """
until = "3 s"
[start]
S = "50 mm"
[demands]
one.ram = [["0 s", "0.05 m/s"], ["1 s", "0 m/s"], ["2 s", "-30 mm/s"]]
two.ram = 0.05
"""


class CycledBlocks(TwoBlocks):
    going = Over.path(S=ramp(0.0, 0.2, speed=0.1, acceleration=0.5), T=ramp(0.0, 0.15, speed=0.05, acceleration=0.5))


class OpenCentreBlocks(CycledBlocks):
    supply = Pump(300 * bar, flow=FLOW, sharing="least pressure first")


class MeasuredBlocks(CycledBlocks):
    height = Dimension(0.4)


class BlockWithMargin(OneBlock):
    supply = Pump(300 * bar, flow=FLOW, margin=40 * bar)
    going = Over.path(S=ramp(0.1, 0.3, speed=0.1, acceleration=0.5))


@pytest.fixture
def file(tmp_path):
    place = tmp_path / "dig.toml"
    place.write_text(PROGRAMME)
    return place


def test_a_pump_says_that_it_leaves_inertia_out_at_a_constant_speed_too_and_refuses_it():
    machine = type("Steady", (TwoLifts,), {"going": Over.path(time=(0.0, 2.0), S=Course([0.0, 2.0], [0.1, 0.3], "straight"), T=0.1)})()
    motion, pump, insisting = machine.sweep(over="going"), machine.plan.members["supply"], Acting(inertia=True)
    assert pump.check(motion).verdict.endswith("; inertia is left out.")
    run = {"demands": {"one.ram": 0.05}, "until": 1.0, "start": {"S": 0.1, "T": 0.1}}
    assert pump.run(machine, **run).cycle.verdict.endswith("; inertia is left out.")
    for ask in (lambda: pump.check(motion, acting=insisting), lambda: pump.run(machine, **run, acting=insisting)):
        with pytest.raises(DefinitionError, match=r"supply\.(check|run): acting= has inertia=True, but a pump's demands leave inertia out"):
            ask()


def test_a_programme_says_in_steps_what_several_runs_say_one_after_the_other(file):
    machine = TwoBlocks()
    found = programme_read(machine, str(file))
    assert found.start == {"S": 0.05} and found.until == 3.0 and found.demands["two.ram"] == 0.05
    run = found.pump.run(machine, demands=found.demands, start=found.start, until=found.until)
    last, litres = {"S": 0.05}, 0.0
    for until, speed in ((1.0, 0.05), (2.0, 0.0), (3.0, -0.03)):
        last = found.pump.run(machine, demands={"one.ram": speed, "two.ram": 0.05}, start=last, until=until)
        litres += last.cycle.litres["supply"]
    for name in ("S", "T"):
        assert_allclose(run.strokes[name][-1], last.strokes[name][-1], atol=1e-11)
    assert_allclose(run.cycle.litres["supply"], litres, rtol=1e-10)
    assert [event.time for event in run.events if event.kind == "demand"] == [1.0, 2.0]


def test_a_table_of_speeds_goes_straight_between_its_rows(tmp_path):
    place = tmp_path / "dig.csv"
    place.write_text('"time, s","one.ram, mm/s"\n0,0\n1,40\n2,0\n')
    found = programme_read(TwoBlocks(), str(place))
    run = found.pump.run(TwoBlocks(), demands=found.demands, until=found.until)
    assert_allclose(run.strokes["S"][-1], 0.04, atol=1e-12)
    assert isinstance(found.demands["one.ram"], Course)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ('until = "3 s"', "nothing is asked for; write"),
        ("[demands]\none.ram = 0.1", "until"),
        ('until = "3 mm"\n[demands]\none.ram = 0.1', "until"),
        ('until = "3 s"\n[demands]\none.ram = "0.1 bar"', "line 3, demands.one.ram"),
        ('until = "3 s"\n[demands]\none.ram = [["4 s", 0.1]]', "the programme ends at 3 s; give a later `until`"),
        ('until = "3 s"\n[demands]\none.ram = [["0 s"]]', "an instant and a speed"),
        ('until = "3 s"\n[start]\nX = 0.1\n[demands]\none.ram = 0.1', "Stroke 'X'"),
        ('until = "3 s"\npumps = "supply"\n[demands]\none.ram = 0.1', "Key 'pumps'"),
        ('until = "3 s"\ndemands = 3', "stands where a table is expected"),
        ('until = "3 s"\ncase = "heavy"\n[demands]\none.ram = 0.1', "Load case 'heavy'"),
    ],
)
def test_a_programme_that_says_something_else_is_refused_with_its_line(tmp_path, text, words):
    place = tmp_path / "dig.toml"
    place.write_text(text + "\n")
    with pytest.raises((FileError, DefinitionError)) as error:
        programme_read(TwoBlocks(), str(place))
    assert words in str(error.value) and "dig.toml" in str(error.value)


def test_a_table_without_time_or_with_another_unit_is_refused(tmp_path):
    place = tmp_path / "dig.csv"
    for text, words in (
        ("one.ram, m/s\n1\n", "in quotes"), ('"one.ram, m/s"\n1\n', '"time, s"'), ('"time, s";"one.ram, mm"\n0;1\n1;1\n', "one.ram, mm"),
        ('"time, s";"one.ram, m/s"\n0;1\n1;fast\n', "line 3"),
    ):  # fmt: skip
        place.write_text(text)
        with pytest.raises(DefinitionError, match=r"dig\.csv") as error:
            programme_read(TwoBlocks(), str(place))
        assert words in str(error.value)


def test_the_command_tells_who_waits_and_writes_a_chart_and_a_table(file, tmp_path, capsys):
    machine, chart, table = f"{__file__}:CycledBlocks", tmp_path / "c.png", tmp_path / "c.csv"
    assert main(["cycle", machine, "--program", str(file), "-o", str(chart), "--csv", str(table)]) == 0
    told = capsys.readouterr().out
    assert "one.ram and two.ram must wait" in told and "kWh" in told and chart.stat().st_size > 20_000
    heads, *rows = csv.reader(table.read_text().splitlines())
    run = programme_read(TwoBlocks(), str(file))
    cycle = run.pump.run(TwoBlocks(), demands=run.demands, start=run.start, until=3.0).cycle
    column = [float(row[heads.index("flow supply, l/min")]) for row in rows]
    assert_allclose(np.array(column) * (litre / minute), cycle.flow["supply"], rtol=1e-12, atol=1e-18)
    assert max(column) * (litre / minute) <= FLOW * (1 + 1e-12)


def test_without_a_programme_the_command_checks_the_paths_in_time_of_the_machine(capsys):
    assert main(["cycle", f"{__file__}:CycledBlocks", "--check"]) == 1
    assert "it can be done in" in capsys.readouterr().out
    assert main(["cycle", f"{__file__}:TwoBlocks"]) == 2
    assert "Over.path(" in capsys.readouterr().err


def test_the_margin_is_there_from_the_first_instant_and_adds_nothing_to_the_peak(capsys):
    machine = BlockWithMargin()
    cycle = pump_of(machine).check(machine.sweep(11, over="going"))
    fed = cycle.flow["supply"] > 0.0
    assert_allclose((cycle.pressure["supply"] - cycle.pressure["line"])[fed], 40 * bar, rtol=1e-12)
    assert_allclose(cycle.pressure["supply"][[0, -1]], cycle.pressure["line"][[0, -1]] + 40 * bar, rtol=1e-12)
    assert_allclose(cycle.peak(cycle.pressure["supply"])[0], cycle.peak(cycle.pressure["line"])[0] + 40 * bar, rtol=1e-9)
    assert pump_of(machine).sections(machine.judge()) == [] and not told_by(machine, "supply")
    assert main(["cycle", f"{__file__}:BlockWithMargin"]) == 0 and "of 30 l/min" in capsys.readouterr().out  # of a pump on one line too


def test_a_course_is_followed_on_where_another_line_leads():
    class CrossedBlocks(TwoBlocks):
        going = Over.path(S=ramp(0.0, 0.2, speed=0.1, acceleration=0.5), T=ramp(0.1, 0.15, speed=0.02, acceleration=0.5))

    cycle = pump_of(CrossedBlocks()).check(CrossedBlocks().sweep(11, over="going"))
    assert_allclose([cycle.litres["first_line"], cycle.litres["second_line"]], 1e3 * AREA * np.array([0.2, 0.05]), rtol=1e-12)
    assert_allclose(cycle.pressure["supply"], np.maximum(cycle.pressure["first_line"], cycle.pressure["second_line"]), rtol=1e-12)


def test_a_report_says_what_the_pump_gives_and_where_its_energy_goes():
    machine = CycledBlocks()
    (section,) = pump_of(machine).sections(machine.judge())
    cycle = pump_of(machine).check(machine.sweep(11, over="going"))
    words, left_out, lines, energy, *pictures = section.blocks
    assert section.title == "One pump, supply" and words == f"supply {cycle.verdict.sentence}" and len(pictures) == 3
    assert "does not follow inertia" in left_out
    assert [row[0] for row in lines.rows] == ["supply", "first_line", "second_line"]
    assert energy.rows[0][1:] == (show(cycle.energy.pump, "kJ", 4), show(cycle.energy.pump, "kWh", 3))
    assert pump_of(TwoBlocks()).sections(TwoBlocks().judge()) == []


def test_a_run_keeps_what_its_pump_gave_wherever_it_is_judged():
    machine = CycledBlocks()
    supply = machine.plan.members["supply"]
    run = supply.run(machine, demands={"one.ram": 0.05, "two.ram": 0.05}, until=8.0)
    told = run.cycle.verdict.sentence
    assert told.startswith("gives ")  # a motion by itself has no pump: of it is said what it needs
    for motion in (run, pickle.loads(pickle.dumps(run)), machine.sweep(31, over=run.over)):
        assert supply.check(motion).verdict.sentence == told
        assert told in [each.sentence for each in told_by(machine, "supply", over=motion)]
    other = machine.replaced(**{"one.ram.bore": 1.1 * machine["one.ram.bore"]})
    assert supply.check(other.sweep(31, over=run.over)).verdict.sentence != told  # a path is given to another design
    for kind in (OpenCentreBlocks, MeasuredBlocks):  # and to another machine, which has a pump of that name
        (said,) = [each.sentence for each in told_by(kind(), "supply", over=run.over) if each.heading == "pump"]
        assert said.startswith("needs ")

    class Fed(OneBlock):
        feed = Pump(300 * bar, flow=FLOW)
        line = LiftCircuit("one.ram", feed, relief=200 * bar)

    assert Fed.plan.members["feed"].run(Fed(), demands={"one.ram": 0.05}, until=1.0).cycle.pump == "feed"


def test_a_chart_shades_who_waits_and_numbers_the_events():
    machine = TwoBlocks()
    cycle = pump_of(machine).run(machine, demands={"one.ram": 0.1, "two.ram": 0.2}, until=1.0).cycle
    flow, pressure, power, waits = cycle.plot().axes
    assert [ax.get_title("left").split(",")[0] for ax in (flow, pressure, power)] == ["flow", "pressure", "power"]
    assert [tick.get_text() for tick in waits.get_yticklabels()] == ["one.ram", "two.ram"] and waits.collections
    free = pump_of(machine).run(machine, demands={"one.ram": 0.01}, until=1.0).cycle
    assert len(free.plot().axes) == 3


def test_a_live_page_tells_all_that_happens_at_an_instant_in_one_line():
    machine = TwoBlocks()
    steps = Course.of_phases([0.0, 0.5, 1.0], [[0.1, 0.02]])
    run = pump_of(machine).run(machine, demands={"one.ram": steps, "two.ram": 0.2}, until=1.0)
    times, words = zip(*event_data(run.events), strict=True)
    assert [*times] == sorted({event.time for event in run.events}) and 0.5 in times
    assert "what is asked for changes" in words[times.index(0.5)]
