"""Whatever writes a file writes it whole or leaves the old one, with nothing beside it; what cannot be is told in words."""

import errno
import os
import stat
import subprocess
import sys
import threading
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from linkage import FileError, LinkageError, page
from linkage.cli import main
from linkage.disk import check_place, read, replacing, replacing_text
from linkage.files import load, save
from linkage.pictures import animate, draw, plot
from linkage.pictures.film import write_gif, write_mp4
from linkage.pictures.strokes import playback
from mechanisms.classics.four_bar import FourBar
from mechanisms.header_balancer.measured import read_measured

posix = pytest.mark.skipif(sys.platform == "win32", reason="rights and links of POSIX")


@cache
def figures():
    """Return a figure of each kind."""
    return draw(FourBar(), count=5), plot(FourBar().sweep(5), ["P_x"])


def drawn(path):
    figures()[0].savefig(path, dpi=20)


def plotted(path):
    figures()[1].savefig(path, dpi=20)


def written_csv(path):
    if main(["table", "four_bar", "--csv", str(path), "--count", "3"]):
        raise FileError("the command failed")


FRAMES = [np.full((32, 32, 4), shade, np.uint8) for shade in (0, 90, 180)]


def moving(path):
    write_gif(path, FRAMES, [0, 1, 2, 1], np.concatenate(FRAMES), 0.04)


def filmed(path):
    pytest.importorskip("imageio_ffmpeg")
    write_mp4(path, FRAMES, (32, 32), 25.0)


@cache
def run():
    """Return a short run of a machine."""
    return playback(FourBar(), 4)


def paged(path):
    page(FourBar(), path, count=5)


WRITERS = [
    (lambda path: save(FourBar, path), "bars.toml"), (lambda path: save(FourBar, path), "bars.json"), (written_csv, "bars.csv"),
    (drawn, "bars.png"), (drawn, "bars.pdf"), (moving, "bars.gif"), (filmed, "bars.mp4"), (paged, "bars.html"),
    *(pytest.param(*each, marks=pytest.mark.slow) for each in ((drawn, "bars.svg"), (plotted, "curves.jpg"))),
]  # fmt: skip
EVERY_WRITER = pytest.mark.parametrize(("write", "name"), WRITERS, ids=lambda value: value if isinstance(value, str) else "")


class FullDisk:
    """A disk on which every file has room for so many bytes more, then none."""

    def __init__(self, monkeypatch, room):
        self.room, fdopen = room, os.fdopen

        def opened(handle, *args, **options):
            stream = fdopen(handle, *args, **options)
            return Narrow(stream, self) if "w" in args[0] else stream

        monkeypatch.setattr("linkage.disk.os.fdopen", opened)


class Narrow:
    """A stream on a full disk."""

    def __init__(self, stream, disk):
        self.stream, self.disk = stream, disk

    def write(self, content):
        taken = content[: max(self.disk.room, 0)]
        self.disk.room -= len(content)
        self.stream.write(taken)
        if self.disk.room < 0:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        return len(content)

    def __getattr__(self, name):
        return getattr(self.stream, name)


# -- whole or not at all -------------------------------------------------------------------------------------


@EVERY_WRITER
def test_a_full_disk_leaves_the_old_file_and_nothing_beside_it(write, name, tmp_path, monkeypatch, capsys):
    file = tmp_path / name
    file.write_bytes(b"a good one")
    for room in (0, 150):
        with monkeypatch.context() as patch:
            FullDisk(patch, room)
            with pytest.raises(FileError, match=r"disk is full|the command failed"):
                write(file)
        assert "disk is full" in capsys.readouterr().err or write is not written_csv
        assert file.read_bytes() == b"a good one"
        assert [each.name for each in tmp_path.iterdir()] == [name]


@EVERY_WRITER
def test_a_new_file_takes_the_place_of_the_old_one_with_its_permissions(write, name, tmp_path, capsys):
    file = tmp_path / name
    file.write_bytes(b"x" * 1_000_000)
    file.chmod(0o640)
    write(file)
    found = file.read_bytes()
    assert 50 < len(found) < 1_000_000 and not found.endswith(b"xxx")
    assert [each.name for each in tmp_path.iterdir()] == [name]
    if sys.platform != "win32":
        assert stat.S_IMODE(file.stat().st_mode) == 0o640


@posix
def test_a_new_file_has_the_permissions_that_the_user_gives_new_files(tmp_path):
    before = os.umask(0o027)
    try:
        save(FourBar, tmp_path / "bars.toml")
    finally:
        os.umask(before)
    assert stat.S_IMODE((tmp_path / "bars.toml").stat().st_mode) == 0o640


@posix
@pytest.mark.parametrize(("write", "name"), WRITERS[:4])
def test_a_link_is_followed_to_its_file(write, name, tmp_path, capsys):
    there = tmp_path / "there"
    there.mkdir()
    link, second = tmp_path / name, tmp_path / f"second_{name}"
    link.symlink_to(Path("there") / name)
    second.symlink_to(link)
    write(link)
    first = (there / name).read_bytes()
    (there / name).write_bytes(b"old")
    write(second)
    assert link.is_symlink() and second.is_symlink() and len((there / name).read_bytes()) == pytest.approx(len(first), abs=40)
    assert [each.name for each in there.iterdir()] == [name]


@pytest.mark.parametrize("error", [KeyboardInterrupt, ValueError, LinkageError, MemoryError])
def test_what_stops_the_writing_leaves_the_old_file(error, tmp_path):
    file = tmp_path / "a"
    file.write_bytes(b"old")
    with pytest.raises(error), replacing(file) as stream:
        stream.write(b"new" * 100_000)
        raise error
    assert file.read_bytes() == b"old" and len([*tmp_path.iterdir()]) == 1


@pytest.mark.parametrize("step", ["fsync", "replace", "chmod"])
def test_a_disk_that_fails_at_the_last_step_leaves_the_old_file(step, tmp_path, monkeypatch):
    def failing(*given, **options):
        raise OSError(errno.EIO, os.strerror(errno.EIO))

    file = tmp_path / "a"
    file.write_bytes(b"old")
    with monkeypatch.context() as patch:
        patch.setattr(f"linkage.disk.os.{step}", failing)
        with pytest.raises(FileError, match=f"^{file}: "), replacing_text(file) as stream:
            stream.write("new")
    assert file.read_bytes() == b"old" and len([*tmp_path.iterdir()]) == 1


def test_the_name_never_stands_for_less_than_a_whole_file(tmp_path):
    file, contents = tmp_path / "a", [bytes([letter]) * 200_000 for letter in b"abcd"]
    file.write_bytes(contents[0])
    done = threading.Event()

    def writing():
        for _ in range(8):
            for content in contents:
                with replacing(file) as stream:
                    stream.write(content)
        done.set()

    writer = threading.Thread(target=writing)
    writer.start()
    seen = 0
    while not done.is_set():
        assert file.read_bytes() in contents
        seen += 1
    writer.join()
    assert seen > 0


def test_text_is_written_as_it_is(tmp_path):
    with replacing_text(tmp_path / "a") as stream:
        stream.write("é\r\nü\n")
    assert (tmp_path / "a").read_bytes() == "é\r\nü\n".encode()


@pytest.mark.slow
@pytest.mark.skipif(not sys.platform.startswith("linux") or not hasattr(os, "geteuid") or os.geteuid() != 0, reason="mounts a small disk")
@EVERY_WRITER
def test_a_disk_that_is_really_full(write, name, tmp_path, capsys):
    disk = tmp_path / "disk"
    disk.mkdir()
    if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=64k", "tmpfs", str(disk)], capture_output=True, check=False).returncode:
        pytest.skip("no right to mount")
    try:
        (disk / name).write_bytes(b"a good one")
        (disk / "ballast").write_bytes(b"x" * (64 * 1024 - 4096 - 4096))  # one page is left for what is new
        for _ in range(2):
            try:
                write(disk / name)
            except FileError as error:
                assert (disk / name).read_bytes() == b"a good one"
                assert "disk is full" in f"{error}{capsys.readouterr().err}"
            else:
                assert 50 < len((disk / name).read_bytes()) <= 4096
            (disk / "more").write_bytes(b"x" * 4096) if (disk / name).read_bytes() == b"a good one" else None
            assert {each.name for each in disk.iterdir()} <= {name, "ballast", "more"}
            (disk / "more").unlink(missing_ok=True)
    finally:
        subprocess.run(["umount", str(disk)], check=True)


# -- what is no file -----------------------------------------------------------------------------------------


@posix
def test_a_full_device_is_told(capsys):
    for place in ("/dev/full", Path("/dev/full")):
        if not Path(place).exists():
            pytest.skip("no /dev/full")
        with pytest.raises(FileError, match=r"^/dev/full: there is no room for it: the disk is full"), replacing(place) as stream:
            stream.write(b"x" * 100_000)
    assert main(["table", "four_bar", "--csv", "/dev/full"]) == 2
    assert "/dev/full: there is no room" in capsys.readouterr().err
    assert Path("/dev/full").is_char_device()


@posix
def test_a_pipe_is_written_straight(tmp_path):
    os.mkfifo(tmp_path / "pipe.toml")
    found = []
    reader = threading.Thread(target=lambda: found.append((tmp_path / "pipe.toml").read_text()))
    reader.start()
    save(FourBar, tmp_path / "pipe.toml")
    reader.join()
    assert found[0].startswith('name = "FourBar"') and (tmp_path / "pipe.toml").is_fifo()


def command(*words, **options):
    """Return a run of the command in a process of its own."""
    return [sys.executable, "-m", "linkage", *words], {"cwd": Path(__file__).parents[2], **options}


@pytest.mark.slow
@posix
def test_standard_output_by_its_name(tmp_path):
    args, options = command("table", "four_bar", "--csv", "/dev/stdout", "--count", "3")
    with (tmp_path / "out.csv").open("wb") as out:
        subprocess.run(args, stdout=out, check=True, **options)
    written = (tmp_path / "out.csv").read_bytes()
    assert written.startswith(b'"phi, deg"') and written.endswith(b"/dev/stdout: 3 rows\n") and written.count(b"\n") == 5
    assert [each.name for each in tmp_path.iterdir()] == ["out.csv"]


@pytest.mark.slow
@posix
def test_a_reader_that_has_gone_is_no_mistake():
    args, options = command("table", "four_bar", "--csv", "/dev/stdout", "--count", "20000")
    running = subprocess.Popen(args, stdout=subprocess.PIPE, stderr=subprocess.PIPE, **options)
    running.stdout.read(10)
    running.stdout.close()
    said = running.stderr.read()
    running.stderr.close()
    assert (running.wait(), said) == (141, b"")


# -- in words ------------------------------------------------------------------------------------------------

BAD_NAMES = [
    (lambda folder, name: folder / "nowhere" / name, r"the folder .*nowhere is not there; make it first or choose another"),
    (lambda folder, name: folder / "file" / name, r"a part of its path is a file and no folder"),
    (lambda folder, name: folder / f"folder{Path(name).suffix}", r"it is a folder; name a file"),
    (lambda folder, name: folder / f"{'x' * 300}{Path(name).suffix}", r"the name is too long; choose a shorter one"),
    (lambda folder, name: folder / ("x" * 300) / name, r"the name is too long; choose a shorter one"),
    (lambda folder, name: folder / f"a\0b{Path(name).suffix}", r"a\\x00b.*: the name holds characters that no file's name can have"),
    (lambda folder, name: folder / f"loop{Path(name).suffix}", r"its links lead in a circle"),
]
SURROGATE = (
    lambda folder, name: folder / f"\ud800{Path(name).suffix}",
    r"\\ud800.*: the name holds characters that no file's name can have",
)


def furnished(folder, name):
    """Return a folder with a file, a folder and a link to itself in it."""
    (folder / "file").write_text("")
    (folder / f"folder{Path(name).suffix}").mkdir()
    (folder / f"loop{Path(name).suffix}").symlink_to(f"loop{Path(name).suffix}")
    return folder


@posix
@pytest.mark.parametrize(("place", "words"), [*BAD_NAMES, SURROGATE])
@EVERY_WRITER
def test_a_place_that_cannot_be_written_is_told_in_words(write, name, place, words, tmp_path, capsys):
    before = sorted(furnished(tmp_path, name).iterdir())
    path = place(tmp_path, name)
    with pytest.raises(FileError, match=f"{words}|the command failed"):
        write(path)
    said = capsys.readouterr().err
    assert write is not written_csv or (__import__("re").search(words, said) and len(said.splitlines()) == 1)
    assert sorted(tmp_path.iterdir()) == before


@posix
@pytest.mark.parametrize("name", ["bars.toml", "bars.json", "bars.csv"])
@pytest.mark.parametrize(
    ("place", "words"), [*((place, words if "not there" not in words else "no such file") for place, words in BAD_NAMES), SURROGATE]
)
def test_a_file_that_cannot_be_read_is_told_in_words(name, place, words, tmp_path):
    path = place(furnished(tmp_path, name), name)
    with pytest.raises(FileError, match=words):
        (read_measured if name.endswith(".csv") else load)(path)


@posix
def test_places_without_rights_are_told_in_words(tmp_path):
    """Asked by another user than root, who may do everything."""
    (tmp_path / "closed").mkdir()
    (tmp_path / "closed" / "there.toml").write_text('name = "Four"')
    (tmp_path / "mine.toml").write_text("old")
    (tmp_path / "mine.toml").chmod(0o444)
    (tmp_path / "secret.toml").write_text("old")
    (tmp_path / "secret.toml").chmod(0)
    (tmp_path / "closed").chmod(0o500)
    tmp_path.chmod(0o777)
    if os.geteuid() == 0:
        child = os.fork()
        if child == 0:
            code = 1
            try:
                for above in tmp_path.parents:
                    if above.stat().st_uid == 0 and not above.stat().st_mode & 0o001:
                        above.chmod(above.stat().st_mode | 0o011)
                os.chown(tmp_path / "closed", 65534, 65534)
                os.setgid(65534)
                os.setuid(65534)
                refuses(tmp_path)
                code = 0
            finally:
                os._exit(code)
        assert os.waitpid(child, 0)[1] == 0
    else:
        refuses(tmp_path)
    (tmp_path / "closed").chmod(0o700)
    assert sorted(each.name for each in tmp_path.iterdir()) == ["closed", "mine.toml", "secret.toml"]
    assert (tmp_path / "mine.toml").read_text() == "old"


def refuses(folder):
    """Assert that what may not be written or read is refused in words."""
    for path in (folder / "closed" / "new.toml", folder / "closed" / "there.toml", folder / "mine.toml"):
        with pytest.raises(FileError, match=r"\.toml: you have no right to it; change its rights"):
            save(FourBar, path)
        with pytest.raises(FileError, match="you have no right to it"):
            check_place(path)
    with pytest.raises(FileError, match=r"secret\.toml: you have no right to it"):
        load(folder / "secret.toml")
    with pytest.raises(FileError, match=r"secret\.toml: you have no right to it"):
        read(folder / "secret.toml")


def test_the_place_is_looked_at_before_the_work(tmp_path, monkeypatch):
    def worked(*given, **options):
        raise AssertionError("worked for nothing")

    monkeypatch.setattr("linkage.pictures.film.playback", worked)
    with pytest.raises(FileError, match="is not there"):
        animate(FourBar(), tmp_path / "nowhere" / "bars.gif")


def test_errors_of_other_kinds_are_not_taken_for_the_files(tmp_path):
    with pytest.raises(ValueError, match="not supported"):
        drawn(tmp_path / "bars.xyz")
    assert not [*tmp_path.iterdir()]
