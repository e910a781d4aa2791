"""The names of `from package import *`: those of a package's door, and no module."""

from __future__ import annotations

import re
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from types import FunctionType, ModuleType


def declare_public(door: dict[str, object]) -> None:
    """Set `__all__` in the `globals()` of a module: its public names but modules, and classes and functions of other packages.

    Type checkers do not run it: they find the names by themselves.
    """
    root = str(door["__name__"]).partition(".")[0]
    hidden = ("annotations", "TYPE_CHECKING", declare_public.__name__)
    named = {name: each for name, each in door.items() if name[0] != "_" and name not in hidden and not isinstance(each, ModuleType)}
    owners = {name: each.__module__ if isinstance(each, (type, FunctionType)) else root for name, each in named.items()}
    door["__all__"] = [name for name, owner in owners.items() if owner.partition(".")[0] == root]


def late_names(
    door: dict[str, object], load: Callable[[str, str], object] | None = None
) -> tuple[Callable[[str], object], Callable[[], list[str]]]:
    """Return `__getattr__` and `__dir__` of a package whose rooms are loaded when a name of theirs is first needed; set its `__all__`.

    The names and the rooms they come from are the lines of its `__init__.pyi`. `load(room, name)` is what a name stands for, by default
    the room's own.
    """
    title, text = str(door["__name__"]), Path(str(door["__file__"])).with_suffix(".pyi").read_text(encoding="utf-8")
    rooms = {name: room for room, name in re.findall(r"^from ([\w.]+) import (\w+)", text, re.MULTILINE)}
    door["__all__"] = [*rooms]

    def late_name(name: str) -> object:
        """Return a name of the door, from then on there; AttributeError for any other."""
        if name not in rooms:
            raise AttributeError(f"module {title!r} has no attribute {name!r}")
        room = rooms[name]
        door[name] = getattr(import_module(room, title), name) if load is None else load(room, name)
        return door[name]

    def every_name() -> list[str]:
        """Return the names of the door, those not loaded yet included."""
        return sorted({*door, *rooms})

    return late_name, every_name
