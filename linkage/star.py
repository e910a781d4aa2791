"""The names of `from package import *`: those of a package's door, and no module."""

from __future__ import annotations

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
