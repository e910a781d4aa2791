"""Paths in time in files: what is saved reads back to the last bit, what a file says is what the class says, rows of a table, refusals."""

import re

import numpy as np
import pytest

from linkage import Course, Crank, Curve, DefinitionError, FileError, Ground, Mechanism, Over, Stroke, export, ramp
from linkage.files import load, to_toml
from tests.linkage.motion.test_in_time import Blocks, DampedLever
from tests.linkage.quantities.test_course import random_course


class Wheel(Mechanism):
    phi = Stroke(0.0, 6.283)
    O = Ground(0, 0)
    A = Crank(O, angle=phi, OA=0.1)
    spin = Over.path(phi=Curve([0, 1, 2, 3], [0.1, 0.5, 0.2, 0.1], period=3), time=(0, 6))
    turned = Over.path(phi=ramp(0.0, 1.5, speed=1.0, acceleration=2.0, jerk=7.0).hold(0.3).then(-ramp(-1.5, 0.2, speed=0.7)))
    table = Over.path(phi=Course([0, 1, 2], [0.1, 0.9, 0.2], kind="monotone"))


HEAD = """\
name = "Blocks"
[strokes]
a = [0.0, 1.0]
b = [0.0, 1.0]
[guides]
low = { from = [0.0, 0.0], angle = 0.0 }
high = { from = [0.0, 1.0], angle = 0.0 }
[points]
A = { OnGuide = "low", at = "a" }
B = { OnGuide = "high", at = "b" }
[over.go]
"""


def same(one, other, name):
    """Check that two motions over an `Over` are equal bit by bit."""
    first, second = (each.sweep(41, over=name) for each in (one, other))
    assert first.time.tolist() == second.time.tolist()
    for stroke in first.strokes:
        for kind in ("strokes", "rates", "accelerations"):
            assert getattr(first, kind)[stroke].tolist() == getattr(second, kind)[stroke].tolist(), (name, stroke, kind)


def test_what_is_saved_reads_back_to_the_last_bit():
    for machine in (Blocks, DampedLever, Wheel):
        again = load(to_toml(machine()))
        for name, over in machine.plan.of_kind(Over).items():
            if over.time is not None:
                same(machine(), again(), name)


def test_random_courses_are_saved_to_the_last_bit():
    for seed in range(4):
        one = type("Turned", (Wheel,), {"any": Over.path(phi=random_course(np.random.default_rng(seed)))})
        same(one(), load(to_toml(one()))(), "any")


def test_a_file_says_what_the_class_says():
    go = """
    a = [{ ramp = ["100 mm", "300 mm"], speed = "150 mm/s", acceleration = "0.8 m/s2" }, { hold = "0.5 s" }]
    b = { times = ["0 s", "1 s", "2 s"], values = [0.1, "200 mm", 0.15], kind = "monotone" }
    """
    motion = load(HEAD + go)().sweep(31, over="go")
    a, b = ramp(0.1, 0.3, speed=0.15, acceleration=0.8).hold(0.5), Course([0, 1, 2], [0.1, 0.2, 0.15], kind="monotone")
    assert motion.time[-1] == max(a.duration, b.duration)
    assert motion.strokes["a"].tolist() == a(motion.time).tolist() and motion.strokes["b"].tolist() == b(motion.time).tolist()
    legs = load(HEAD + 'time = ["0 s", "2 s"]\na = ["100 mm", "300 mm"]\nb = 0.2')().sweep(3, over="go")
    assert legs.rates["a"].tolist() == pytest.approx([0.1, 0.1, 0.1])


def test_a_table_of_rows_is_what_export_writes(tmp_path):
    motion = Blocks().sweep(21, over="legs")
    export(motion, tmp_path / "cycle.csv")
    first = (tmp_path / "cycle.csv").read_text().splitlines()[0]
    assert first.startswith('"time, s","a, m","b, m"')
    (tmp_path / "machine.toml").write_text(HEAD + 'csv = "cycle.csv"')
    again = load(tmp_path / "machine.toml")().sweep(21, over="go")
    assert again.time.tolist() == motion.time.tolist() and again.strokes["a"].tolist() == motion.strokes["a"].tolist()
    assert again.rates["b"][5:14] == pytest.approx(motion.rates["b"][5:14])


def test_a_table_of_rows_is_read_as_a_spreadsheet_writes_it(tmp_path):
    (tmp_path / "cycle.csv").write_text('# of the log\n"time, s";"a, mm";note\n0;100,5;x\n\n1,5;300;\n')
    (tmp_path / "machine.toml").write_text(f'{HEAD}csv = "cycle.csv"\nb = 0.2')
    legs = load(tmp_path / "machine.toml")().sweep(3, over="go")
    assert legs.time.tolist() == [0.0, 0.75, 1.5] and legs.strokes["a"].tolist() == pytest.approx([0.1005, 0.20025, 0.3])
    (tmp_path / "cycle.csv").write_text('# of the log\n"time, s";"a, mm"\n0;100,5\n\n1,5;inf\n')
    with pytest.raises(FileError, match="line 5 'inf' is no number"):
        load(tmp_path / "machine.toml")
    (tmp_path / "cycle.csv").write_text('"time, s","a, mm","on; off"\n0,100,1\n1.5,300,0\n')
    assert load(tmp_path / "machine.toml")().sweep(2, over="go").strokes["a"].tolist() == pytest.approx([0.1, 0.3])


def test_a_table_that_is_none_is_refused_in_words(tmp_path):
    for name, rows, words in [
        ("cycle.csv", '"time, s","a, mm"\n0,100\n' + "1" * 140_000, "cycle.csv, line 3: it cannot be read as a table of rows"),
        (r"cy\u0000cle.csv", "", "the name holds characters that no file's name can have"),
    ]:
        (tmp_path / "cycle.csv").write_text(rows)
        (tmp_path / "machine.toml").write_text(f'{HEAD}csv = "{name}"\nb = 0.2')
        with pytest.raises(FileError, match=re.escape(words)):
            load(tmp_path / "machine.toml")


def test_what_a_file_gets_wrong_is_refused_in_words(tmp_path):
    for go, words in [
        ("a = { hold = 0.5 }\nb = 0.1", "begin with a ramp"),
        ("a = [{ ramp = [0.1, 0.2], speed = 0.1 }, { hold = [1, 2] }]\nb = 0.1", "[1, 2] is not a number of seconds"),
        ("a = { ramp = [0.1, 0.2] }\nb = 0.1", "a ramp has two ends and a speed"),
        ('a = { ramp = [0.1, 0.2], speed = "3 kg" }\nb = 0.1', "use one of m/s"),
        ("a = { ramp = [0.1, 0.2], sped = 0.1 }\nb = 0.1", "sped"),
        ("a = { times = [0, 1] }\nb = 0.1", "times and values stand beside each other"),
        ("a = [{ ramp = [0.1, 0.2], speed = 0.1 }, { ramp = [0.3, 0.2], speed = 0.1 }]\nb = 0.1", "100 mm apart"),
        ("time = [0, 1, 1]\na = [0.1, 0.2, 0.3]\nb = 0.1", "must rise"),
        ('csv = "none.csv"', "folder"),
    ]:
        with pytest.raises(FileError, match=re.escape(words)):
            load(HEAD + go)
    for go in (
        'a = ["10 deg", "20 deg"]', 'a = "10 deg"', 'csv = "rows.csv"',
        'time = ["0 s", "1 s"]\na = ["10 deg", "20 deg"]', 'path = true\na = ["1 deg", "2 deg"]',
        'a = { ramp = ["10 deg", "11 deg"], speed = "1 deg/s" }', 'a = { times = [0, 1], values = ["0.1 rad", "0.2 rad"] }',
        'a = { times = [0, 1, 2], values = ["9 deg", "8 deg", "9 deg"], period = 2 }',
        'a = [{ ramp = ["10 deg", "11 deg"], speed = 0.1 }, { hold = "1 s" }]',
    ):  # fmt: skip
        (tmp_path / "machine.toml").write_text(f"{HEAD}{go}\nb = 0.1")
        (tmp_path / "rows.csv").write_text('"time, s","a, deg"\n0,10\n1,20\n')
        with pytest.raises(DefinitionError, match=r"a=0\.\d+ was given as an angle; expected is a value of length"):
            load(tmp_path / "machine.toml")().sweep(over="go")
    for step in ('speed = "1 deg/s"', 'speed = "150 mm/s", acceleration = "1 rad/s2"'):
        with pytest.raises(FileError, match=r"is a length and (speed|acceleration) is an angle"):
            load(f'{HEAD}a = {{ ramp = ["100 mm", "110 mm"], {step} }}\nb = 0.1')
    (tmp_path / "machine.toml").write_text(HEAD + 'csv = "rows.csv"\nb = 0.1')
    for headings, last, words in [
        ('"time, s","a, m"', "oops", "in line 3 'oops' is no number"),
        ('"time, mm","a, m"', "0.2", "time, mm: mm measures length; use one of s, min"),
        ('"time, s","a, bar"', "0.2", "a, bar: bar measures pressure; use one of m, mm"),
        ('"time, s","a, mn"', "0.2", "Unit 'mn' is unknown in csv = rows.csv: a, mn"),
    ]:
        (tmp_path / "rows.csv").write_text(f"{headings}\n0,0.1\n1,{last}\n")
        with pytest.raises(FileError, match=re.escape(words)):
            load(tmp_path / "machine.toml")
