"""Text made into functions: in memory, or in a file of the user's cache, where Numba can keep what it compiled."""

from __future__ import annotations

import math
import os
import sys
import tempfile
from collections.abc import Callable, Mapping
from hashlib import sha256
from pathlib import Path
from types import ModuleType
from typing import Any


def compiled(text: str, names: Mapping[str, Any], where: str = "<linkage program>") -> dict[str, Any]:
    """Return the functions of a program's text."""
    space: dict[str, Any] = dict(names) | {"nan": math.nan, "inf": math.inf}
    exec(compile(text, where, "exec"), space)
    return space


def cache_folder() -> Path:
    """Return the user's folder for compiled programs; HYDROLINKAGE_CACHE names another."""
    if "HYDROLINKAGE_CACHE" in os.environ:
        return Path(os.environ["HYDROLINKAGE_CACHE"])
    if sys.platform == "win32":
        base = os.environ.get("LOCALAPPDATA") or Path.home() / "AppData" / "Local"
    elif sys.platform == "darwin":
        base = Path.home() / "Library" / "Caches"
    else:
        base = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(base) / "hydrolinkage" / "kernels"


def file_of(text: str) -> Path:
    """Return the file of a program: named by its text."""
    return cache_folder() / f"linkage_kernel_{sha256(text.encode()).hexdigest()[:32]}.py"


def is_kept(text: str) -> bool:
    """Return whether a program has been compiled before on this machine."""
    file = file_of(text)
    return any(file.parent.glob(f"__pycache__/{file.stem}*.nbc"))


def compiled_in_file(text: str, name: str, make: Callable[[Callable[..., None], bool], Callable[..., None]]) -> Callable[..., None]:
    """Return a function of a text, compiled by `make(function, cache)` and kept on disk; not kept where the folder cannot be written."""
    try:
        file = written(text)
    except OSError:
        return make(compiled(text, {})[name], False)
    module = sys.modules.setdefault(file.stem, ModuleType(file.stem))  # what is kept on disk looks its module up by name
    vars(module).update(compiled(text, {"__name__": file.stem, "__file__": str(file)}, str(file)))
    return make(getattr(module, name), True)


def written(text: str) -> Path:
    """Return the file that holds a text, written at once and only where it is missing: what is compiled goes by its date."""
    file = file_of(text)
    if not file.is_file() or file.read_text(encoding="utf-8") != text:
        file.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        handle, temporary = tempfile.mkstemp(dir=file.parent, suffix=".tmp")
        with os.fdopen(handle, "w", encoding="utf-8") as stream:
            stream.write(text)
        os.replace(temporary, file)
    return file
