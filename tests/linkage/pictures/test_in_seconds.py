"""Readers of a path in time go by seconds: curves, films in real time, pages, reports, tables, commands."""

import numpy as np
import pytest
from PIL import Image

from hydraulics import thrust
from linkage import Over, animate, dynamic_factor, pin_forces, plot, ramp, report
from linkage.cli import main
from linkage.files import save
from linkage.motion import live_text
from linkage.pictures.browser_data import PageRequests, page_data
from linkage.pictures.strokes import playback
from linkage.reports import results
from linkage.statics.table import largest_loads
from mechanisms.mower_lift import LoweredMowerLift
from tests.linkage.motion.test_in_time import DampedLever


class Timed(DampedLever):
    cycle = None
    quick = None


class Slow(Timed):
    up = Over.path(S=ramp(0.02, 0.18, speed=0.005))  # 32 s


class Jerky(Timed):
    up = Over.path(S=ramp(0.02, 0.18, speed=0.1).hold(1.0))


def test_curves_and_tables_stand_over_time():
    motion = Timed().sweep(11, over="up")
    headings = [each.heading for each in results(Timed(), motion)]
    assert headings[:2] == ["time, s", "S, m"] and "drive force, kN" in headings
    for figure in (plot(motion, ["G_y"]), plot(Timed())):
        assert {ax.get_xlabel() for ax in figure.axes if ax.get_xlabel()} == {"time, s"}
        assert figure.axes[0].lines[0].get_xdata()[[0, -1]] == pytest.approx([0.0, 1.8])


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
        course = Timed.plan.members["up"].strokes["S"]
        assert slider["path"][0] == pytest.approx(course(np.linspace(0.0, 1.8, len(slider["path"][0]))))
        assert requests.motion.time[[0, -1]] == pytest.approx([0.0, 1.8])


def test_a_report_tells_instants(tmp_path):
    report(Timed(), tmp_path / "up.md", count=5)
    text = (tmp_path / "up.md").read_text(encoding="utf-8")
    assert " s (S = " in text and "S = 20 to 180 mm in 1.8 s" in text and "drive force, kN along time" in text
    assert "masses have their inertia" in text and "quasi-static" not in text and "accelerations, shocks" not in text
    assert "time, s along" not in text  # no curve of the time over itself
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
