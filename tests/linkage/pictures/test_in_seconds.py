"""Readers of a path in time go by seconds: curves, films in real time, pages, reports, tables, commands."""

import csv

import numpy as np
import pytest
from PIL import Image

from hydraulics import Cylinder, thrust
from linkage import (
    LEFT,
    DefinitionError,
    Dyad,
    Ground,
    LinkMass,
    LoadCase,
    Mechanism,
    OnLink,
    Over,
    PinFriction,
    Stroke,
    Weight,
    animate,
    draw,
    dynamic_factor,
    export,
    most,
    pin_forces,
    plot,
    ramp,
    report,
)
from linkage.cli import main
from linkage.files import load, save
from linkage.loads import Acting
from linkage.motion import live_text
from linkage.motion.motion_verdicts import over_pose
from linkage.pictures.force_arrows import one_pose
from linkage.pictures.page_data import PageRequests, page_data
from linkage.pictures.strokes import playback
from linkage.reports import results
from linkage.statics.table import largest_loads
from mechanisms.at_work.excavator import DiggingExcavator
from mechanisms.mower_lift import LoweredMowerLift
from tests.linkage.motion.test_in_time import DampedLever


class Timed(DampedLever):
    cycle = None
    quick = None


class Slow(Timed):
    up = Over.path(S=ramp(0.02, 0.18, speed=0.005))  # 32 s


class Jerky(Timed):
    up = Over.path(S=ramp(0.02, 0.18, speed=0.1).hold(1.0))


class LoadedLever(Mechanism):
    """A lever that runs in one load case alone, with friction in its pin."""

    S = Stroke(0.30, 0.50)
    O, A = Ground(0, 0), Ground(0.35, -0.1)
    B = Dyad(O, A, OB=0.3, AB=S, side=LEFT)
    T = OnLink(O, B, OT=0.8)
    load = Weight(T, mass=200.0)
    beam = LinkMass("O T", mass=60.0, at=(0.4, 0.0), inertia=4.0)
    lift = Cylinder("A", "B", bore=0.05, rod=0.03)
    rub = PinFriction(O, radius=0.04, coefficient=0.2)
    full = LoadCase("full", scale={"load": 2.5})
    rise = Over.path(S=ramp(0.32, 0.48, speed=0.1, acceleration=0.3), cases=["full"])


def test_curves_and_tables_stand_over_time():
    motion = Timed().sweep(11, over="up")
    headings = [each.heading for each in results(Timed(), motion)]
    assert headings[:2] == ["time, s", "S, m"] and "drive force, kN" in headings
    for figure in (plot(motion, ["G_y"]), plot(Timed())):
        assert {ax.get_xlabel() for ax in figure.axes if ax.get_xlabel()} == {"time, s"}
        assert figure.axes[0].lines[0].get_xdata()[[0, -1]] == pytest.approx([0.0, 1.8])


@pytest.mark.slow
def test_a_film_plays_in_real_time(tmp_path):
    animate(Timed(), tmp_path / "up.gif", count=5)
    with Image.open(tmp_path / "up.gif") as film:
        frames = []
        for number in range(film.n_frames):
            film.seek(number)
            frames.append(film.info["duration"])
    assert sum(frames[:-1]) == pytest.approx(1800, abs=30)
    slow = playback(Slow(), 60)
    assert len(slow.order) <= 301 and slow.seconds * (len(slow.order) - 1) == pytest.approx(32.0, abs=slow.seconds)


def test_a_page_slides_in_seconds():
    for along, name in ((None, "up"), (Timed().sweep(7, over="up"), "time")):
        requests = PageRequests(Timed(), 21, along=along)
        data = page_data(requests, live_text(Timed.plan, requests.by_name, name="engine"))
        slider = data["strokes"][-1]
        assert (slider["name"], slider["unit"], slider["start"], slider["turn"]) == (name, "s", 0.0, 1)
        assert slider["end"] == pytest.approx(1.8) and data["judge"]["overs"][0]["time"] == pytest.approx([0.0, 1.8])
        assert slider["courses"] == data["judge"]["overs"][0]["courses"] and slider["over"] == 0
        assert requests.motion.time[[0, -1]] == pytest.approx([0.0, 1.8])


@pytest.mark.slow
def test_a_report_tells_instants(tmp_path):
    report(Timed(), tmp_path / "up.md", count=5)
    text = (tmp_path / "up.md").read_text(encoding="utf-8")
    assert " s (S = " in text and "S = 20 to 180 mm in 1.8 s" in text and "drive force, kN over time" in text
    assert "masses have their inertia" in text and "quasi-static" not in text and "accelerations, shocks" not in text
    assert "time, s over" not in text  # no curve of the time over itself
    report(Jerky(), tmp_path / "jerky.md", count=5)
    text = (tmp_path / "jerky.md").read_text(encoding="utf-8")
    assert "quasi-static" in text and "the rate of S jumps by 0.1 m/s at 1.6 s, so that inertia is left out" in text


def test_commands_run_along_a_path_in_time(tmp_path, capsys):
    save(Timed(), tmp_path / "lever.toml")
    machine = str(tmp_path / "lever.toml")
    for command in ("table", "forces"):
        assert main([command, machine, "--over", "up", "--count", "3"]) == 0
        assert "time, s" in capsys.readouterr().out
    for command in (["export", "-o", str(tmp_path / "up.csv")], ["plot", "G_y", "-o", str(tmp_path / "up.png")]):
        assert main([command[0], machine, *command[1:], "--over", "up", "--count", "9"]) == 0
    rows = (tmp_path / "up.csv").read_text().splitlines()
    assert rows[0].startswith('"time, s","S, m"') and len(rows) == 10
    assert main(["plot", machine, "--over", "down", "-o", str(tmp_path / "no.png")]) != 0
    assert "Known: up" in capsys.readouterr().err


def test_a_table_of_what_is_asked_keeps_the_instants(capsys):
    assert main(["table", "lowered_mower_lift", "--count", "3", "dynamic_factor(thrust(lift))"]) == 0
    rows = [line.split() for line in capsys.readouterr().out.splitlines()[-3:]]
    machine = LoweredMowerLift()
    motion = machine.sweep(3, over="lowering")
    assert [float(row[0]) for row in rows] == pytest.approx(motion.time, abs=1e-4)
    factor = motion[dynamic_factor(thrust("lift"))]
    assert [float(row[-1]) for row in rows] == pytest.approx(factor, abs=1e-4) and factor[0] < 0.8
    found = largest_loads(pin_forces(motion))
    ends = {joint.point: joint for joint in pin_forces(motion).joints}  # braked at the end, the cylinder's pins carry the most there
    assert max(each.force for each in found) == pytest.approx(max(joint.size[-1] for joint in ends.values()), rel=1e-6)


def test_a_motion_is_shown_in_the_load_case_of_its_over_by_every_reader(tmp_path, capsys):
    for machine, over, case, force in ((LoadedLever(), "rise", "full", "lift"), (DiggingExcavator(), "cycle", "carrying", "boom.ram")):
        motion = machine.sweep(5, over=over)
        wanted, plain = motion[thrust(force, case=case)] / 1e3, motion[thrust(force)] / 1e3
        assert np.max(np.abs(wanted - plain)) > 0.1 * np.max(np.abs(wanted))
        column = "thrust" if force == "lift" else f"thrust {force}"
        figure = plot(motion, [thrust(force)])
        assert figure.axes[0].lines[0].get_ydata() == pytest.approx(wanted, abs=1e-9)
        assert f"in the case {motion.plan.members[case].label}" in figure.get_suptitle().replace("\n", " ")
        export(motion, tmp_path / "own.csv")
        place = next(csv.reader((tmp_path / "own.csv").read_text().splitlines())).index(f"{column}, kN")
        assert np.loadtxt(tmp_path / "own.csv", delimiter=",", skiprows=1)[:, place] == pytest.approx(wanted, abs=1e-9)
        found = next(each for each in results(machine, motion) if each.name == column)
        assert found.drawn == pytest.approx(wanted, abs=1e-9)
        own = next(each for each in results(machine, motion, "plain") if each.name == column)
        assert own.drawn == pytest.approx(plain, abs=1e-9)
    assert playback(LoadedLever(), 9, "thrust", at=LoadedLever().sweep(5, over="rise")).column.drawn.max() > 10.0
    save(LoadedLever(), tmp_path / "lever.toml")
    assert main(["forces", str(tmp_path / "lever.toml"), "--over", "rise", "--count", "3"]) == 0
    assert "full, as it runs." in capsys.readouterr().out
    assert main(["forces", str(tmp_path / "lever.toml"), "--over", "rise", "--direction", "extending"]) != 0
    assert "as it runs" in capsys.readouterr().err


@pytest.mark.slow
def test_a_motion_is_drawn_at_an_instant_as_it_runs_there():
    motion = LoadedLever().sweep(4, over="rise")
    for forces in (True, "OBT"):
        figure = draw(motion, time=0.2, forces=forces)
        there = LoadedLever().sweep(30, over="rise")  # 1.9333 s in 29 steps of a fifteenth: 0.2 s is among them
        pose = int(np.argmin(np.abs(there.time - 0.2)))
        texts = {text.get_text() for text in figure.findobj(lambda each: hasattr(each, "get_text")) if "kN" in text.get_text()}
        size = abs(there[thrust("lift", case="full")][pose]) / 1e3
        assert any(f"{size:.3g} kN" in text for text in texts), (size, texts)
        said = " ".join(text.get_text() for text in figure.texts)
        assert "time = 0.2 s" in said and "in the case full" in said
    for wrong in ({"time": 2.5}, {"time": "a"}, {"time": 0.2, "pose": 1}):
        with pytest.raises(DefinitionError, match=r"from 0 to 1\.93333 s|leave one of them out"):
            draw(motion, **wrong)
    with pytest.raises(DefinitionError, match="no courses over time"):
        draw(LoadedLever().sweep(3), time=0.1)
    with pytest.raises(DefinitionError, match="an instant of a motion"):
        draw(LoadedLever(), time=0.1)


def test_a_pose_in_time_is_judged_as_it_runs_there():
    motion, asked = LoadedLever().sweep(9, over="rise"), thrust("lift")
    for pose in range(1, 9):  # at the first instant nothing turns yet, just behind it something does
        (answer,) = LoadedLever().answers([most(asked)], over=over_pose(one_pose(motion, pose), ["full"]))
        beside = motion[asked.under(Acting(case="full"), keep=True)][pose]
        assert float(answer.value) == pytest.approx(beside, rel=1e-7) or pose == 8


def test_a_table_of_a_motion_in_time_has_rates_and_is_read_back(tmp_path):
    machine = LoadedLever()
    motion = machine.sweep(9, over="rise")
    export(motion, tmp_path / "rise.csv")
    lines = (tmp_path / "rise.csv").read_text().splitlines()
    assert lines[0].startswith('"time, s","S, m","rate S, m/s","acceleration S, m/s2"')
    rows = np.loadtxt(tmp_path / "rise.csv", delimiter=",", skiprows=1)
    assert np.array_equal(rows[:, :4].T, [motion.time, motion.strokes["S"], motion.rates["S"], motion.accelerations["S"]])
    save(machine, tmp_path / "lever.toml")
    text = (tmp_path / "lever.toml").read_text()
    (tmp_path / "lever.toml").write_text(text + '\n[over.again]\ncsv = "rise.csv"\n')
    again = load(tmp_path / "lever.toml")().sweep(9, over="again")
    assert np.array_equal(again.strokes["S"], motion.strokes["S"]) and np.array_equal(again.time, motion.time)
