"""Compiled kernels in a folder of the user's cache. They are code: only a folder that nobody else can write is used, and of it only
what is byte for byte what was put there.
"""

from __future__ import annotations

import json
import math
import os
import sys
import warnings
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from functools import lru_cache
from hashlib import sha256
from pathlib import Path
from types import CodeType, ModuleType
from typing import Any

from ..disk import in_words, read, replacing
from ..errors import FileError

FOLDER = "HYDROLINKAGE_CACHE"


def cache_folder() -> Path:
    """Return the user's folder for compiled programs; HYDROLINKAGE_CACHE names another.

    RuntimeError where the user has no home.
    """
    if os.environ.get(FOLDER):
        return Path(os.environ[FOLDER]).absolute()
    if sys.platform == "win32":
        base = os.environ.get("LOCALAPPDATA") or Path.home() / "AppData" / "Local"
    elif sys.platform == "darwin":
        base = Path.home() / "Library" / "Caches"
    else:
        base = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(base) / "hydrolinkage" / "kernels"


def is_own(folder: Path) -> bool:
    """Return whether a folder is the user's and nobody else can write into it; where the system knows no owners it is."""
    if not hasattr(os, "getuid"):
        return True
    found, above = folder.stat(), folder.parent.stat()
    is_hidden = above.st_uid == os.getuid() and not above.st_mode & 0o011  # nobody else gets there
    return found.st_uid == os.getuid() and (is_hidden or not found.st_mode & 0o022)


def is_trusted(folder: Path) -> bool:
    """Return whether compiled code is taken from a folder and kept in it; warn where it is not, for it may be another's."""
    if is_own(folder):
        return True
    remedy = f"take it over (chown, chmod 700) or name another folder in {FOLDER}"
    text = f"{folder}: compiled kernels are code, and others than you can write there; they are neither read nor kept: {remedy}."
    warnings.warn(text, UserWarning, stacklevel=2)
    return False


@dataclass
class CompiledFile:
    """The text of one program in its file, and its compiled code: beside the file, in folders that `take` is given."""

    file: Path
    folders: list[Path] = field(default_factory=list)

    @classmethod
    def for_text(cls, text: str) -> CompiledFile | None:
        """Return the file of a program, written if it is missing or altered; None where nothing can be kept, or is safe there."""
        try:
            file = file_of(text)
            with in_words(file.parent):
                for folder in (file.parent, file.parent / "__pycache__"):
                    folder.mkdir(mode=0o700, parents=True, exist_ok=True)
                    if not is_trusted(folder):
                        return None
            if not (file.is_file() and read(file) == text.encode()):
                with replacing(file) as stream:
                    stream.write(text.encode())
        except (FileError, OSError, RuntimeError):
            return None
        return cls(file)

    def take(self, folder: Path) -> bool:
        """Return whether a folder may hold compiled code; unsound files in it are deleted."""
        if not is_trusted(folder):
            return False
        self.folders.append(folder)
        if self._sums(folder) != self._noted(folder):
            self.drop()
        return True

    def note(self) -> None:
        """Store the checksums of the compiled code where they changed; without them it is compiled again the next time."""
        for folder in self.folders:
            sums = self._sums(folder)
            if sums != self._noted(folder):
                with replacing(self._note(folder)) as stream:
                    stream.write(json.dumps(sums, indent=1).encode())

    def drop(self) -> None:
        """Delete the compiled code."""
        for folder in self.folders:
            for path in (self._note(folder), *folder.glob(f"{self.file.stem}*.nb[ci]*")):
                path.unlink(missing_ok=True)

    def _note(self, folder: Path) -> Path:
        return folder / f"{self.file.stem}.sha256.json"

    def _sums(self, folder: Path) -> Mapping[str, str]:
        return {path.name: sha256(read(path)).hexdigest() for path in sorted(folder.glob(f"{self.file.stem}*.nb[ci]"))}

    def _noted(self, folder: Path) -> object:
        """Return the sums that were noted; none where the note is missing or torn."""
        try:
            return json.loads(read(self._note(folder)))
        except (FileError, ValueError, RecursionError):
            return {}


def file_of(text: str) -> Path:
    """Return the file of a program: named by its text."""
    return cache_folder() / f"linkage_kernel_{sha256(text.encode()).hexdigest()[:32]}.py"


def is_cached(text: str) -> bool:
    """Return whether a program has been compiled before on this machine, and its code may be used."""
    try:
        file = file_of(text)
        return any(file.parent.glob(f"__pycache__/{file.stem}*.nbc")) and is_own(file.parent)
    except (OSError, RuntimeError):
        return False


Make = Callable[[Callable[..., None], CompiledFile | None], Callable[..., None]]
"""What compiles a function and keeps what came of it where it is told."""


def compiled(text: str, names: Mapping[str, object], where: str = "<linkage program>") -> dict[str, Any]:
    """Return the functions of a program's text."""
    space: dict[str, Any] = dict(names) | {"nan": math.nan, "inf": math.inf}
    exec(code_from(text, where), space)
    return space


@lru_cache(maxsize=512)
def code_from(text: str, where: str) -> CodeType:
    """Return a text as code: machines of one build, and variants of one class, have programs of one text."""
    return compile(text, where, "exec")


def compiled_in_file(text: str, name: str, make: Make) -> Callable[..., None]:
    """Return a function compiled from a text by `make(function, file)`; in memory where the disk cannot keep or read it."""
    cached = CompiledFile.for_text(text)
    if cached is not None:
        file = cached.file
        module = sys.modules.setdefault(file.stem, ModuleType(file.stem))  # what is kept on disk looks its module up by name
        vars(module).update(compiled(text, {"__name__": file.stem, "__file__": str(file)}, str(file)))
        try:
            return make(getattr(module, name), cached)
        except Exception:  # whatever a cache does, the numbers do not depend on it; an error of the program's own comes again below
            with suppress(OSError):
                cached.drop()
    return make(compiled(text, {})[name], None)
