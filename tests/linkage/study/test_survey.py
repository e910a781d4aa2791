"""Surveys in one process: what they return, what they refuse, what a folder keeps; against the mechanism's own batches."""

import functools
import os
import sys
import threading
import tracemalloc
from concurrent.futures import ThreadPoolExecutor
from importlib import import_module

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from linkage import AssemblyError, DefinitionError, FileError, StudyError
from linkage.program import fixed_backend
from linkage.program.numba_backend import NumbaLoop
from linkage.study import survey
from mechanisms.classics.four_bar import FourBar
from mechanisms.three_point_hitch import ThreePointHitch
from tests.for_all import first_daily, for_all
from tests.linkage.study.survey_measures import failing, far_points, group_designs, hitch_designs, logged, travel

BATCHES = import_module("linkage.study.survey")  # the module, whose function goes by its name


@pytest.fixture
def small(monkeypatch):
    """Batches of one piece: many of them from few designs."""
    monkeypatch.setattr(BATCHES, "AIM", 1e-9)
    monkeypatch.setattr(BATCHES, "LEAST", 1e-9)


def same(found, wanted):
    """Assert that two surveys agree to the last bit."""
    assert list(found) == list(wanted)
    for name in wanted:
        assert found[name].dtype == wanted[name].dtype
        assert_array_equal(found[name].view(np.uint8), wanted[name].view(np.uint8))


def read(log):
    """Return the designs, by their OB, at which the measured pieces began."""
    return [float(line) for line in log.read_text().splitlines()]


# -- what is returned --------------------------------------------------------------------------------------


def test_survey_is_what_the_mechanism_gives_as_one_batch():
    hitch, over = hitch_designs(700)
    found = survey(hitch, over, travel)
    whole = travel(hitch.replaced(**over))
    assert list(found) == ["travel", "ratio", "tilt", "whole"]
    for name, value in whole.items():
        assert_allclose(found[name], value, rtol=1e-12, atol=1e-13)
    assert found["whole"].dtype == bool and 0.5 < found["whole"].mean() < 0.8


def test_every_design_is_measured_once_and_in_its_place(small):
    hitch, over = hitch_designs(1000)
    found = survey(hitch, over, lambda machine: {"OB": machine["OB"], "M.y": machine["M"][1], "ones": np.ones(machine["OB"].shape, int)})
    assert_array_equal(found["OB"], over["OB"])
    assert_array_equal(found["M.y"], over["M"][1])
    assert found["ones"].dtype == float and found["ones"].sum() == 1000
    assert sorted((batch.start, batch.stop) for batch in found.batches) == [(k, min(k + 64, 1000)) for k in range(0, 1000, 64)]


@pytest.mark.slow
def test_results_do_not_depend_on_the_batches(small, monkeypatch):
    machine, over = group_designs(400)
    many = survey(machine, over, far_points)
    monkeypatch.setattr(BATCHES, "AIM", 1e9)
    monkeypatch.setattr(BATCHES, "LEAST", 1e9)
    few = survey(machine, over, far_points)
    assert len(many.batches) > len(few.batches) == 2
    same(many, few)


def test_design_is_the_machine_of_its_number():
    hitch, over = hitch_designs(100)
    found = survey(hitch, over, travel)
    best = found.design(int(np.nanargmax(found["travel"])))
    assert best["OB"] in over["OB"]
    assert_allclose(travel(best)["travel"], np.nanmax(found["travel"]), rtol=1e-13)
    with pytest.raises(DefinitionError, match="there is no design 100; numbers go from 0 to 99"):
        found.design(100)


def test_survey_says_what_it_holds():
    hitch, over = hitch_designs(100)
    found = survey(hitch, over, travel)
    assert len(found) == 4 and "travel" in found and "lift" not in found
    assert repr(found).startswith("ThreePointHitch: travel, ratio, tilt, whole of 100 designs, 2 batches of ")
    with pytest.raises(DefinitionError, match=r"Result 'travle' is unknown in the survey of ThreePointHitch\. Did you mean travel\?"):
        found["travle"]


def test_files_mapped_into_memory_will_do(tmp_path):
    hitch, over = hitch_designs(200)
    np.save(tmp_path / "OB.npy", over["OB"])
    mapped = {**over, "OB": np.load(tmp_path / "OB.npy", mmap_mode="r")}
    same(survey(hitch, mapped, travel), survey(hitch, over, travel))


# -- one back end -------------------------------------------------------------------------------------------


def test_back_end_is_held_whatever_was_done_before(monkeypatch):
    monkeypatch.setattr(NumbaLoop, "is_worth", lambda *_: True)
    hitch, over = hitch_designs(256)
    kernel = ThreePointHitch.plan.kernel(ThreePointHitch.plan.moving)
    chosen = []

    def measure(machine):
        chosen.append(kernel._backend(machine_way, 64, 21))
        return {"OB": machine["OB"]}

    machine_way = kernel.__call__.__defaults__[1]
    survey(hitch, over, measure)
    assert chosen and all(each is kernel.arrays for each in chosen)
    assert kernel._backend(machine_way, 64, 21) is kernel.fused
    with fixed_backend("numpy"):
        elsewhere = []
        thread = threading.Thread(target=lambda: elsewhere.append(kernel._backend(machine_way, 64, 21)))
        thread.start()
        thread.join()
        assert elsewhere == [kernel.fused], "another thread is not held"


def cranks(count):
    """Return a four-bar, whose one step compiles soon, and cranks of it."""
    return FourBar(), {"OA": np.linspace(0.03, 0.04, count)}


@for_all(("designs", "measure"), [(cranks, far_points)], slow=[(hitch_designs, travel)])
def test_numba_on_request(designs, measure):
    pytest.importorskip("numba")
    machine, over = designs(300)
    numpy, numba = (survey(machine, over, measure, backend=name) for name in ("numpy", "numba"))
    for name in numpy:
        assert_allclose(numba[name], numpy[name], rtol=1e-9, atol=1e-11)
    with ThreadPoolExecutor(2) as pool:
        same(survey(machine, over, measure, backend="numba", executor=pool), numba)


@first_daily(0, ("designs", "measure"), [(group_designs, far_points), (hitch_designs, travel)])
def test_threads_that_trace_a_machine_at_the_same_time(designs, measure):
    machine, over = designs(64)

    def held(fresh, start):
        start.wait()
        with fixed_backend("numpy"):
            return measure(fresh)

    wanted, interval = held(machine.replaced(**over), threading.Barrier(1)), sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    try:
        for _ in range(2):
            fresh, start = type("Fresh", (type(machine),), {})().replaced(**over), threading.Barrier(4)
            with ThreadPoolExecutor(4) as pool:
                for found in pool.map(held, [fresh] * 4, [start] * 4):
                    same(found, wanted)
    finally:
        sys.setswitchinterval(interval)


# -- what is refused ----------------------------------------------------------------------------------------

ARRAY = np.linspace(0.29, 0.31, 5)


@for_all(
    ("over", "text"),
    [
        ({"OBB": ARRAY}, r"'OBB' is unknown in ThreePointHitch\. Did you mean OB\? Known: .*CD"),
        ({"AB": ARRAY}, "AB follows L0"),
        ({"OB": ARRAY, "CD": ARRAY[:4]}, "all arrays are to have one length; theirs are OB 5, CD 4"),
        ({"M": (ARRAY, ARRAY[:4])}, "theirs are M 5 4"),
        ({"OB": 0.3}, r"OB is 0\.3; an array \(m,\) of numbers is expected"),
        ({"OB": ARRAY.reshape(5, 1)}, r"OB is shape \(5, 1\), float64"),
        ({"OB": ["a", "b"]}, "OB is .'a', 'b'.; an array"),
        ({"OB": [[1.0], [1.0, 2.0]]}, "an array"),
        ({"M": ARRAY}, r"M is a point and takes a pair of arrays, M=\(xs, ys\) in m"),
        ({"M": 1.0}, "M is a point"),
        ({"OB": np.array([0.3, np.nan])}, "OB of design 1 is nan; a finite number is expected"),
        ({"M": (0.22, np.array([1.0, 1.1, np.inf]))}, "M of design 2 is inf"),
        ({"M": (np.nan, ARRAY)}, "M of design 0 is nan"),
        ({"OB": np.array([0.3, -0.1])}, r"Designs 0 to 1: .*OB=-0\.1 m is negative; give a positive one"),
        ({"M": (ARRAY, ARRAY), "M.y": ARRAY}, r"M and M\.y both set M\.y; leave one of them out"),
        ({"M.y": ARRAY, "M.x": ARRAY, "M": (ARRAY, ARRAY)}, r"M\.x and M both set M\.x; leave one of them out"),
        ({"OB": ARRAY, "BO": ARRAY}, "OB and BO both set OB"),
        ({"OB": np.array([])}, "there are no designs"),
        ({}, "there are no designs"),
        ([("OB", ARRAY)], "a dictionary of names and arrays is expected"),
        ({3: ARRAY}, "3 is unknown"),
    ],
)
def test_designs_that_cannot_be(over, text):
    with pytest.raises(DefinitionError, match=text):
        survey(ThreePointHitch(), over, travel)


@for_all(
    ("measure", "text"),
    [
        (lambda machine: np.ones(64), "measure returned array.* for designs 0 to 63; return a dictionary of names and arrays"),
        (lambda machine: {}, "return a dictionary"),
        (lambda machine: {1: machine["OB"]}, "return a dictionary"),
        (lambda machine: {"a": 1.0}, r"a = float64 of the shape \(\) for designs 0 to 63; .*shape \(64,\)"),
        (lambda machine: {"a": machine["OB"][:-1]}, r"a = float64 of the shape \(63,\) for designs 0 to 63"),
        (lambda machine: {"a": [None] * len(machine["OB"])}, r"a = \[None"),
        (lambda machine: {"a": 1j * machine["OB"]}, "a = complex128"),
        (lambda machine: {f"a{len(machine['OB'])}": machine["OB"]}, r"a36 \(float64\) for designs 64 to 99, elsewhere a64 \(float64\)"),
        (lambda machine: {"a": np.ones(len(machine["OB"]), [int, bool][len(machine["OB"]) // 64])}, r"a \(float64\) .* elsewhere a \(bool"),
    ],
)
def test_results_that_cannot_be(measure, text):
    hitch, over = hitch_designs(100)
    with pytest.raises(DefinitionError, match=text):
        survey(hitch, over, measure)


@for_all(
    ("options", "text"),
    [
        ({"piece": 0}, "piece=0: a whole number of designs is expected, at least 1"),
        ({"piece": 2.5}, "piece=2.5"),
        ({"piece": True}, "piece=True"),
        ({"backend": "floats"}, 'backend=.floats.: say "numpy" or "numba"'),
        ({"executor": 4}, "executor=4 has no submit"),
        ({"executor": ThreadPoolExecutor}, "ThreadPoolExecutor'> is a class; give a pool"),
        ({"folder": ""}, "folder='': the path of a folder is expected"),
        ({"folder": 3}, "folder=3: the path of a folder"),
    ],
)
def test_options_that_cannot_be(options, text):
    with pytest.raises(DefinitionError, match=text):
        survey(ThreePointHitch(), {"OB": ARRAY}, travel, **options)


def test_measure_and_machine_that_cannot_be():
    with pytest.raises(DefinitionError, match=r"measure='travel': a function of a mechanism is expected"):
        survey(ThreePointHitch(), {"OB": ARRAY}, "travel")
    with pytest.raises(DefinitionError, match="a study starts from one design, this is a batch"):
        survey(ThreePointHitch(OB=ARRAY), {"CD": ARRAY}, travel)
    with pytest.raises(DefinitionError, match=r"ThreePointHitch is a class, the structure; give a design of it, ThreePointHitch\(\)"):
        survey(ThreePointHitch, {"OB": ARRAY}, travel)
    with pytest.raises(DefinitionError, match="'hitch' is no mechanism"):
        survey("hitch", {"OB": ARRAY}, travel)


@for_all("number", [100, -1, "3", 2.0, [1, 2], None, True])
def test_design_that_is_none(number):
    found = survey(*hitch_designs(100), travel)
    with pytest.raises(DefinitionError, match=r"there is no design .*; numbers go from 0 to 99"):
        found.design(number)


def test_failure_in_measure_names_its_designs(small, tmp_path):
    hitch, over = hitch_designs(400)
    with pytest.raises(StudyError, match=r"measure failed at designs 192 to 255: AssemblyError: .*cannot be assembled") as caught:
        survey(hitch, over, functools.partial(failing, victim=over["OB"][200]), folder=tmp_path)
    assert caught.value.designs == (192, 255)
    assert isinstance(caught.value.__cause__, AssemblyError) and caught.value.__cause__.mask.all()
    assert caught.value.__notes__ == [f"192 of 400 designs are done and kept in {tmp_path}; the same call goes on from there."]
    assert len(list(tmp_path.glob("designs-*.npy"))) == 3


# -- a folder -----------------------------------------------------------------------------------------------


def test_finished_batches_are_not_done_again(small, tmp_path):
    hitch, over = hitch_designs(500)
    log = tmp_path / "log"
    measure = functools.partial(logged, log=log)
    first = survey(hitch, over, measure, folder=tmp_path / "run")
    assert len(read(log)) == 8
    again = survey(hitch, over, measure, folder=tmp_path / "run")
    assert len(read(log)) == 8 and all(batch.kept for batch in again.batches)
    assert "0 batches, 500 designs from the folder" in repr(again)
    same(again, first)
    same(again, survey(hitch, over, travel))


@pytest.mark.parametrize("harm", ["flipped", "torn", "empty", "renamed", "gone"])
def test_harmed_file_is_done_again(small, tmp_path, harm):
    hitch, over = hitch_designs(500)
    log, run = tmp_path / "log", tmp_path / "run"
    measure = functools.partial(logged, log=log)
    wanted = survey(hitch, over, measure, folder=run)
    victim = sorted(run.glob("designs-*.npy"))[3]
    content = bytearray(victim.read_bytes())
    content[-100] ^= 1
    harmed = {"flipped": bytes(content), "torn": victim.read_bytes()[:-64], "empty": b"", "renamed": victim.read_bytes()}
    if harm in ("gone", "renamed"):
        victim.unlink()
    if harm in harmed:
        name = victim.name.replace("000000192-000000256", "000000193-000000257") if harm == "renamed" else victim.name
        (run / name).write_bytes(harmed[harm])
    (run / "designs-000000192-000000256.tmp").write_bytes(b"half")
    log.unlink()
    same(survey(hitch, over, measure, folder=run), wanted)
    assert read(log) == [over["OB"][192]]


def changed_travel(hitch):
    return {name: value if value.dtype == bool else 2.0 * value for name, value in travel(hitch).items()}


@pytest.mark.parametrize(
    ("change", "text"),
    [
        (lambda hitch, over: (hitch.replaced(OC=0.35), over, travel, {}), r"dimension OC \(0\.36 there, 0\.35 here\)"),
        (lambda hitch, over: (hitch, {**over, "OB": over["OB"][::-1]}, travel, {}), r"array OB \([0-9a-f]{8} there, [0-9a-f]{8} here\)"),
        (lambda hitch, over: (hitch, {**over, "OC": over["OB"]}, travel, {}), r"array OC \(none there, "),
        (lambda hitch, over: (hitch, over, changed_travel, {}), r"measure \(.*\.travel there, .*\.changed_travel here\), its code \("),
        (lambda hitch, over: (hitch, over, travel, {"piece": 32}), r"differs in piece \(64 there, 32 here\)\. Take another folder"),
        (lambda hitch, over: (hitch, over, travel, {"backend": "numba"}), "backend"),
        (lambda hitch, over: (type("Other", (ThreePointHitch,), {})(), over, travel, {}), "machine"),
        (lambda hitch, over: (hitch, hitch_designs(600)[1], travel, {}), r"designs \(500 there, 600 here\), array OB .* and 2 more\."),
    ],
)
def test_folder_of_another_study_is_refused(tmp_path, change, text):
    hitch, over = hitch_designs(500)
    survey(hitch, over, travel, folder=tmp_path)
    machine, other, measure, options = change(hitch, over)
    with pytest.raises(DefinitionError, match=text):
        survey(machine, other, measure, folder=tmp_path, **options)


def test_batches_without_their_note_are_not_taken_for_another_study(tmp_path):
    hitch, over = hitch_designs(300)
    survey(hitch, over, travel, folder=tmp_path)
    (tmp_path / "study.json").unlink()
    same(survey(hitch, over, changed_travel, folder=tmp_path), survey(hitch, over, changed_travel))


@pytest.mark.parametrize("content", [b"", b"[]", b"{", b"\xff"])
def test_note_that_cannot_be_read(tmp_path, content):
    (tmp_path / "study.json").write_bytes(content)
    with pytest.raises(FileError, match=r"study\.json: it does not say which study is kept here"):
        survey(*hitch_designs(10), travel, folder=tmp_path)


def test_folder_that_cannot_be_written(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(FileError, match=r"file: something else has this name.* Finished batches cannot be kept here"):
        survey(*hitch_designs(10), travel, folder=tmp_path / "file")


def test_full_disk_stops_a_study_and_the_same_call_goes_on(small, tmp_path, monkeypatch):
    (hitch, over), sync, written = hitch_designs(400), os.fsync, []

    def full(handle):
        if len(list(tmp_path.glob("designs-*.npy"))) == 2:
            half = [*tmp_path.glob(".*.tmp")]
            written.append(half)
            for each in half:
                os.truncate(each, 100)
            raise OSError(28, "No space left on device")
        sync(handle)

    with monkeypatch.context() as patch:
        patch.setattr("linkage.disk.os.fsync", full)
        with pytest.raises(FileError, match=r"the disk is full.* Designs 128 to 191 cannot be kept.*the same call goes on"):
            survey(hitch, over, travel, folder=tmp_path)
    assert written and not [*tmp_path.glob(".*.tmp")], "half a file is left behind"
    found = survey(hitch, over, travel, folder=tmp_path)
    assert sum(batch.kept for batch in found.batches) == 2
    same(found, survey(hitch, over, travel))


@pytest.mark.parametrize("workers", [0, 2])
def test_interrupt_leaves_a_folder_to_go_on_from(small, tmp_path, workers):
    hitch, over = hitch_designs(640)
    log, run = tmp_path / "log", tmp_path / "run"
    measure = functools.partial(logged, log=log)

    def stop(done, total):
        if done >= 256:
            raise KeyboardInterrupt

    with ThreadPoolExecutor(max(workers, 1)) as pool, pytest.raises(KeyboardInterrupt) as caught:
        survey(hitch, over, measure, executor=pool if workers else None, folder=run, progress=stop)
    kept = len(list(run.glob("designs-*.npy")))
    assert f"{64 * kept} of 640 designs are done and kept in {run}; the same call goes on" in caught.value.__notes__[0]
    assert 4 <= kept <= len(read(log)) < 10, "what was queued is called back"
    log.unlink()
    told = []
    found = survey(hitch, over, measure, folder=run, progress=lambda done, total: told.append((done, total)))
    assert len(read(log)) == 10 - kept
    assert told == [(64 * k, 640) for k in range(kept, 11)]
    same(found, survey(hitch, over, travel))


def test_bar_on_stderr(capsys):
    survey(*hitch_designs(300), travel, progress=True)
    printed = capsys.readouterr()
    assert printed.out == ""
    assert "Three point hitch" in printed.err and "100%" in printed.err and "300/300" in printed.err
    survey(*hitch_designs(300), travel)
    assert capsys.readouterr().err == ""


# -- memory -------------------------------------------------------------------------------------------------


def beside_results(count):
    """Return how much memory a survey of so many designs takes beside its inputs and results [bytes]."""
    hitch, over = ThreePointHitch(), {"OB": np.linspace(0.29, 0.31, count)}
    tracemalloc.start()
    try:
        survey(hitch, over, lambda machine: {"twice": 2.0 * machine["OB"]}, piece=512)
        return tracemalloc.get_traced_memory()[1] - 8 * count
    finally:
        tracemalloc.stop()


@pytest.mark.slow
def test_memory_is_bounded_by_the_batch(monkeypatch):
    monkeypatch.setattr(BATCHES, "AIM", 1e-3)
    monkeypatch.setattr(BATCHES, "LEAST", 5e-4)
    few, many = (min(beside_results(count) for _ in range(2)) for count in (50_000, 200_000))
    assert many < few + 1_000_000, "four times as many designs: their inputs alone are 1.2 MB more"
