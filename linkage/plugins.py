"""Plugins of other packages, joined by entry points: `[project.entry-points."hydrolinkage.exporters"]` of their `pyproject.toml`.

No part of a package is loaded before it is asked for by its name; one that cannot be loaded is named, and hides no other.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Mapping
from functools import lru_cache
from importlib import import_module
from types import MappingProxyType
from typing import TYPE_CHECKING, Generic, TypeVar

from .errors import DefinitionError, LinkageError, culprit

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint, EntryPoints

MACHINES = "hydrolinkage.machines"
COMMANDS = "hydrolinkage.commands"
REQUESTS = "hydrolinkage.requests"
MEMBERS = "hydrolinkage.files"
EXPORTERS = "hydrolinkage.exporters"
LANGUAGES = "hydrolinkage.languages"
BACKENDS = "hydrolinkage.backends"
"""The groups of entry points."""

T = TypeVar("T")


def entry_points(group: str) -> Mapping[str, EntryPoint]:
    """Return the installed entry points of a group, by name, in the order of the names."""
    return entry_points_along(group, tuple(sys.path))


@lru_cache(maxsize=64)
def entry_points_along(group: str, folders: tuple[str, ...]) -> Mapping[str, EntryPoint]:
    """Return the same where modules are looked for in some folders: those of `sys.path`; read once for each such list."""
    found = {entry.name: entry for entry in installed_along(folders).select(group=group)}
    return MappingProxyType({name: found[name] for name in sorted(found)})


@lru_cache(maxsize=8)
def installed_along(folders: tuple[str, ...]) -> EntryPoints:
    """Return the entry points of all groups there: each reading opens a file for every installed package."""
    found: EntryPoints = import_module("importlib.metadata").entry_points()  # here: it takes longer to load than half of this package
    return found


def guarded(load: Callable[[], T], what: str) -> T:
    """Return a loaded object; any error in a user's module becomes a DefinitionError with its line."""
    try:
        return load()
    except KeyboardInterrupt:
        raise
    except BaseException as error:  # a script that leaves by sys.exit is one as well
        where, hint = culprit(error)
        match error:
            case SyntaxError():
                why = f"{error.filename}, line {error.lineno}: {error.msg}."
            case LinkageError():
                why = str(error)
            case _:
                why = f"{type(error).__name__}: {error}{'' if where.startswith('<') else f' ({where})'}.{hint}"
        raise DefinitionError(f"{what} cannot be loaded: {why}") from error


class Plugins(Generic[T]):
    """All entries of one kind, by name: those of this package, and those that others bring in a group of entry points.

    `what` begins the sentence on an entry that is not as it should be, "The exporter"; `made` returns what an entry's object stands for,
    None where it is none, and `expected` says then what it should be. Where a name is taken, such an object may be given as it is.
    """

    def __init__(self, group: str, what: str, made: Callable[[object], T | None], expected: str, own: Mapping[str, T]) -> None:
        self.group, self.what, self.made, self.expected, self.own = group, what, made, expected, own
        self._loaded: dict[EntryPoint, T] = {}

    def __contains__(self, name: object) -> bool:
        return isinstance(name, str) and (name in self.own or name in entry_points(self.group))

    def __iter__(self) -> Iterator[str]:
        """Yield the names, those of this package first; nothing is loaded."""
        return iter({**self.own, **entry_points(self.group)})

    def __len__(self) -> int:
        return len({**self.own, **entry_points(self.group)})

    def __getitem__(self, name: str) -> T:
        """Return the plugin of a name; DefinitionError where it cannot be loaded or has a wrong kind, KeyError where there is none."""
        if name in self.own:
            return self.own[name]
        entry = entry_points(self.group)[name]
        if entry not in self._loaded:
            title = f"{self.what} {name} ({entry.value})"
            found = self.made(guarded(entry.load, title))
            if found is None:
                raise DefinitionError(f"{title} is {self.expected}.")
            self._loaded[entry] = found
        return self._loaded[entry]

    def for_object(self, value: object) -> T | None:
        """Return the plugin for an object that is given instead of a name; None for a name, and for any other object."""
        return None if isinstance(value, str) else self.made(value)

    def loaded(self) -> tuple[dict[str, T], list[str]]:
        """Return all that there are by name; and of those that cannot be loaded, why not."""
        found, faults = dict(self.own), []
        for name in entry_points(self.group):
            try:
                found[name] = self[name]
            except DefinitionError as error:
                faults.append(str(error))
        return found, faults
