"""Files on a disk: replaced whole or left as they were, read to a stated size, with errors in words."""

from __future__ import annotations

import codecs
import errno
import os
import secrets
import stat
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import BinaryIO, TextIO, TypeAlias, cast

from .errors import FileError, cited

Place: TypeAlias = str | os.PathLike[str]

OF_FILE = "_machine_file_"
"""How the module of a file of a user's own is called, before the file's name."""

FULL = "there is no room for it: the disk is full, or what you may use of it; make room or choose another folder"
CLOSED = "you have no right to it; change its rights or its folder's, or choose another place"
SAYINGS = {
    errno.ENOENT: "there is no such file; look at its name and its folder",
    errno.EEXIST: "something else has this name; choose another one",
    errno.EISDIR: "it is a folder; name a file",
    errno.ENOTDIR: "a part of its path is a file and no folder; choose another place",
    errno.EACCES: CLOSED,
    errno.EPERM: CLOSED,
    errno.EROFS: "the disk is read-only; choose another place",
    errno.ENAMETOOLONG: "the name is too long; choose a shorter one",
    errno.ELOOP: "its links lead in a circle; mend them or choose another place",
    errno.ENOSPC: FULL,
    errno.EDQUOT: FULL,
    errno.EFBIG: "it would be larger than a file may be here; choose another disk, or ask for less",
    errno.EPIPE: "who reads from it has gone; begin again",
    errno.EBUSY: "something else holds it; choose another place, or try again later",
}
LONGEST = 200
"""Characters of a path in a message, at most."""


def reason(error: OSError) -> str:
    """Return why something could not be read or written, and the remedy, in words."""
    return SAYINGS.get(error.errno or 0, f"{error.strerror or error}; look at the disk, or choose another place")


def spoken(path: Place) -> str:
    """Return a path for a message: in one line, nothing unprintable, not endless."""
    text = os.fspath(path)
    text = text if text.isprintable() else ascii(text)[1:-1]
    return text if len(text) <= LONGEST else f"{text[: LONGEST // 2]}...{text[-LONGEST // 2 :]}"


@contextmanager
def in_words(path: Place) -> Iterator[None]:
    """Turn the system's errors about a path into a FileError that names it."""
    try:
        yield
    except OSError as error:
        raise FileError(f"{spoken(path)}: {reason(error)}.") from error


def new_folder(path: Place) -> Path:
    """Make a folder with those around it, where it is not there yet, and return it; FileError, in words, where that cannot be."""
    with in_words(path):
        Path(path).mkdir(parents=True, exist_ok=True)
    return Path(path)


def check_name(path: Place) -> None:
    """Raise FileError for anything but a name, and for a name that no file can have."""
    if not isinstance(path, (str, os.PathLike)):
        raise FileError(f"{cited(path)} is no path of a file; give its name as text, or a pathlib.Path.")
    try:
        is_none = b"\0" in os.fsencode(path)
    except UnicodeEncodeError:
        is_none = True
    if is_none:
        raise FileError(f"{spoken(path)}: the name holds characters that no file's name can have; choose another one.")


def read(path: Place, most: int = -1) -> bytes:
    """Return a file's bytes, `most` of them where that is given; FileError, in words, where it cannot be read."""
    check_name(path)
    with in_words(path), open(path, "rb") as file:
        return file.read(most)


def check_place(path: Place) -> None:
    """Raise FileError where a file cannot be written at a path: to be asked before long work, of which nothing would be left."""
    target(path)


def is_one_file(path: Place, other: Place) -> bool:
    """Return whether two paths lead to one file that is there."""
    return os.path.exists(path) and os.path.exists(other) and os.path.samefile(path, other)


@contextmanager
def replacing(path: Place) -> Iterator[BinaryIO]:
    """Yield a stream whose bytes take the place of a file when all of them are written; until then, and if not, the old one stays.

    They go into a new file beside it, which is brought to the disk and then renamed, with the permissions of what was there. A link is
    followed to what it stands for; anything but a file (a terminal, a pipe, `/dev/stdout`) is written straight. FileError, in words, where
    that cannot be.
    """
    file = target(path)
    if file is None:
        with in_words(path), straight(path) as stream:
            yield stream
        return
    fresh = file.with_name(f".{secrets.token_hex(8)}.tmp")
    with in_words(path):
        mode = 0o600 if file.exists() else 0o666  # what nobody else may read is not shown meanwhile
        stream = os.fdopen(os.open(fresh, os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0), mode), "wb")
        try:
            try:
                yield stream
                stream.flush()
                os.fsync(stream.fileno())
            except BaseException:
                with suppress(OSError):  # what is left in its buffer finds no room either
                    stream.close()
                raise
            stream.close()
            if file.exists():  # what replaces it has its permissions, and its owner as far as that is allowed
                was = os.stat(file)
                if hasattr(os, "chown"):
                    with suppress(PermissionError):
                        os.chown(fresh, was.st_uid, was.st_gid)
                os.chmod(fresh, stat.S_IMODE(was.st_mode))
            os.replace(fresh, file)
        except BaseException:
            with suppress(OSError):
                fresh.unlink()
            raise
    with suppress(OSError):  # the folder's new name goes to the disk, where the system can bring it there
        handle = os.open(file.parent, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)


@contextmanager
def replacing_text(path: Place) -> Iterator[TextIO]:
    """Yield a stream of text, UTF-8 with line ends as they are written, that replaces a file as `replacing` does."""
    with replacing(path) as stream:
        yield cast(TextIO, codecs.getwriter("utf-8")(stream))


def target(path: Place) -> Path | None:
    """Return the file that a path stands for, all links followed; None for anything but a file. FileError where it cannot be written."""
    check_name(path)
    with in_words(path):
        try:
            found = os.stat(path)
        except FileNotFoundError:
            found = None
        file, fault = Path(os.path.realpath(path)), 0
        if found is not None and stat.S_ISDIR(found.st_mode):
            fault = errno.EISDIR
        elif found is not None and (not stat.S_ISREG(found.st_mode) or own_stream(found) is not None or is_stream(Path(path))):
            return None
        elif not os.path.lexists(file.parent):
            folder = spoken(file.parent if os.path.islink(path) else Path(path).parent)
            raise FileError(f"{spoken(path)}: the folder {folder} is not there; make it first or choose another.")
        elif not os.path.isdir(file.parent):
            fault = errno.ENOTDIR
        elif found is not None and not os.access(file, os.W_OK):
            fault = errno.EACCES
        elif not os.access(file.parent, os.W_OK | os.X_OK):
            fault = errno.EROFS if hasattr(os, "statvfs") and os.statvfs(file.parent).f_flag & os.ST_RDONLY else errno.EACCES
        if fault:
            raise OSError(fault, "")
        return file


def is_stream(path: Path) -> bool:
    """Return whether a path, through its links, is the name of an open stream: a link in /dev or /proc."""
    for _ in range(40):
        if not path.is_symlink():
            return False
        if path.absolute().parts[1:2] in (("dev",), ("proc",)):
            return True
        path = path.parent / path.readlink()
    return False


def own_stream(found: os.stat_result) -> int | None:
    """Return the standard stream of this process, 1 or 2, that a file is; None where it is none."""
    for stream in (1, 2):
        with suppress(OSError):
            if os.path.samestat(found, os.fstat(stream)):
                return stream
    return None


def straight(path: Place) -> BinaryIO:
    """Return a stream into something that is not a file; a standard stream goes on where it stands."""
    own = own_stream(os.stat(path))
    if own is None:
        return open(path, "wb")
    for said in (sys.stdout, sys.stderr):
        if said is not None:
            said.flush()
    return open(os.dup(own), "wb")
