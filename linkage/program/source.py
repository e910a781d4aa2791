"""Text made into functions: in memory, or in a file of the user's cache, where Numba can keep what it compiled."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Mapping
from contextlib import suppress
from types import ModuleType
from typing import Any

from .kept import Kept

Make = Callable[[Callable[..., None], Kept | None], Callable[..., None]]
"""What compiles a function and keeps what came of it where it is told."""


def compiled(text: str, names: Mapping[str, Any], where: str = "<linkage program>") -> dict[str, Any]:
    """Return the functions of a program's text."""
    space: dict[str, Any] = dict(names) | {"nan": math.nan, "inf": math.inf}
    exec(compile(text, where, "exec"), space)
    return space


def compiled_in_file(text: str, name: str, make: Make) -> Callable[..., None]:
    """Return a function of a text, compiled by `make(function, kept)`; what cannot be kept on disk, or not read, is made in memory."""
    kept = Kept.of(text)
    if kept is not None:
        file = kept.file
        module = sys.modules.setdefault(file.stem, ModuleType(file.stem))  # what is kept on disk looks its module up by name
        vars(module).update(compiled(text, {"__name__": file.stem, "__file__": str(file)}, str(file)))
        try:
            return make(getattr(module, name), kept)
        except Exception:  # whatever a cache does, the numbers do not depend on it; an error of the program's own comes again below
            with suppress(OSError):
                kept.drop()
    return make(compiled(text, {})[name], None)
