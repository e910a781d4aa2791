"""Compiled kernels on disk are code: only a folder that nobody else can write is used, and only what is as it was put there."""

import json
import os
import random
import stat
import sys
import warnings
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from linkage.program import cache as kept
from linkage.program.cache import CompiledFile, cache_folder, compiled_in_file, is_cached, is_own
from tests.for_all import first_daily

numba = pytest.importorskip("numba")
posix = pytest.mark.skipif(sys.platform == "win32", reason="rights of POSIX")

TEXT = "def poses(x):\n    for k in range(x.size):\n        x[k] = 2.0 * x[k] + 1.0\n"
SIGNATURE = (numba.types.float64[::1],)


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.setenv("HYDROLINKAGE_CACHE", str(tmp_path / "kernels"))
    return tmp_path / "kernels"


class Making:
    """Compiles as the kernel does, and counts what came from the disk."""

    def __init__(self):
        self.compiled = self.loaded = 0

    def __call__(self, function, where):
        done = numba.njit(cache=where is not None)(function)
        if where is not None and not where.take(Path(done.stats.cache_path)):
            done, where = numba.njit(function), None
        done.compile(SIGNATURE)
        if where is not None:
            where.note()
            self.loaded += sum(done.stats.cache_hits.values())
            self.compiled += sum(done.stats.cache_misses.values())
        return done


def used(text=TEXT):
    """Return how often a kernel was compiled and loaded to answer, once the answer is right."""
    making = Making()
    loop = compiled_in_file(text, "poses", making)
    found = np.arange(4.0)
    loop(found)
    assert_array_equal(found, [1.0, 3.0, 5.0, 7.0])
    return making.compiled, making.loaded


def test_a_kernel_is_loaded_when_it_is_as_it_was_put_there(folder):
    assert used() == (1, 0)
    assert used() == (0, 1)
    assert is_cached(TEXT) and not is_cached("def poses(x):\n    pass\n")
    (note,) = folder.rglob("*.sha256.json")
    assert {name.rpartition(".")[2] for name in json.loads(note.read_text())} == {"nbi", "nbc"}


def torn(draw, raw):
    """Return bytes that are not those they were."""
    place = draw.randrange(len(raw))
    kind = draw.randrange(5)
    changed = [
        raw[:place],
        b"",
        raw + b"\0",
        raw[:place] + bytes([raw[place] ^ 1 << draw.randrange(8)]) + raw[place + 1 :],
        draw.randbytes(200),
    ]
    return changed[kind]


@first_daily(1, "suffix", ["nbi", "nbc", "json"])
def test_a_torn_or_altered_kernel_is_thrown_away_and_made_again(folder, suffix):
    draw = random.Random(11)
    used()
    for _ in range(2):
        (file,) = folder.rglob(f"*.{suffix}")
        file.write_bytes(torn(draw, file.read_bytes()))
        assert used() == (1, 0)
        assert used() == (0, 1)
        assert not [*folder.rglob("*.tmp*")]


def test_a_kernel_of_another_hand_is_not_loaded(folder):
    """One that nobody noted, put there beside a note of its own program, or in the place of another program's."""
    used()
    (note,) = folder.rglob("*.sha256.json")
    note.unlink()
    assert used() == (1, 0)
    (file,) = folder.rglob("*.nbc")
    (file.parent / file.name.replace(".1.nbc", ".2.nbc")).write_bytes(b"cos\nsystem\n(S'touch run'\ntR.")
    assert used() == (1, 0)
    assert used() == (0, 1)
    assert not (folder / "run").exists()


def test_a_disk_that_keeps_nothing_changes_no_number(folder, monkeypatch):
    def full(self):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(CompiledFile, "note", full)
    assert used() == (0, 0)
    assert not [*folder.rglob("*.nb?")]


@posix
@first_daily(1, "place", ["__pycache__", ""])
@first_daily(2, "mode", [0o775, 0o757, 0o777])
def test_a_folder_that_others_can_write_is_not_used(folder, place, mode):
    used()
    os.chmod(folder.parent, 0o755)
    os.chmod(folder, 0o755)
    os.chmod(folder / place, mode)
    for _ in range(2):
        with pytest.warns(UserWarning, match=r"compiled kernels are code, and others than you can write there; .* chmod 700"):
            assert used() == (0, 0)
    assert is_cached(TEXT) is bool(place)
    os.chmod(folder / place, 0o700)
    assert used() == (0, 1)


@posix
def test_a_folder_of_another_user_is_not_used(folder, monkeypatch):
    used()
    monkeypatch.setattr(kept.os, "getuid", lambda: os.stat(folder).st_uid + 1)
    assert not is_own(folder)
    with pytest.warns(UserWarning, match="others than you can write there"):
        assert used() == (0, 0)
    assert not is_cached(TEXT)


@posix
def test_a_folder_of_ones_own_is_made_for_nobody_else(folder):
    before = os.umask(0)
    try:
        used()
    finally:
        os.umask(before)
    assert [stat.S_IMODE(each.stat().st_mode) for each in (folder, folder / "__pycache__")] == [0o700, 0o700]


@posix
def test_where_numba_is_told_another_folder_its_rights_count(folder, tmp_path, monkeypatch):
    monkeypatch.setattr(numba.config, "CACHE_DIR", str(tmp_path / "numba"))
    assert [used(), used()] == [(1, 0), (0, 1)]
    (inner,) = (tmp_path / "numba").iterdir()
    (file,) = inner.glob("*.nbc")
    file.write_bytes(file.read_bytes()[:-10])
    assert [used(), used()] == [(1, 0), (0, 1)]
    os.chmod(tmp_path / "numba", 0o777)
    os.chmod(inner, 0o777)
    with pytest.warns(UserWarning, match="others than you can write there"):
        assert used() == (0, 0)


def test_a_folder_that_cannot_be_there_is_done_without(tmp_path, monkeypatch):
    (tmp_path / "file").write_text("")
    for place in (tmp_path / "file", tmp_path / "file" / "in", tmp_path / ("x" * 300)):
        monkeypatch.setenv("HYDROLINKAGE_CACHE", str(place))
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            assert used() == (0, 0)
            assert not is_cached(TEXT)


def test_an_empty_name_is_no_name(monkeypatch):
    monkeypatch.setenv("HYDROLINKAGE_CACHE", "")
    monkeypatch.setenv("XDG_CACHE_HOME", "/x")
    assert cache_folder().name == "kernels" and cache_folder().is_absolute()
