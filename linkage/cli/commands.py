"""The commands there are: the built-in ones, and those of other packages by entry point."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Sequence
from importlib.metadata import EntryPoint, entry_points

from ..errors import DefinitionError, unknown
from .animate import Animate
from .command import Command
from .listing import List
from .plot import Plot
from .save import Save
from .show import Show
from .table import Table

GROUP = "hydrolinkage.commands"
BUILT_IN: tuple[Command, ...] = (List(), Show(), Table(), Plot(), Animate(), Save())


def chosen(arguments: Sequence[str]) -> tuple[Command, ...]:
    """Return the commands that the arguments may mean; other packages are loaded only where they are needed.

    Raises DefinitionError for an unknown command, naming the nearest.
    """
    word = arguments[0] if arguments and not arguments[0].startswith("-") else ""
    if word in {command.name for command in BUILT_IN}:
        return BUILT_IN
    added = {entry.name: entry for entry in entry_points(group=GROUP)}
    if word in added:
        return (loaded(added[word]),)
    if word:
        raise unknown("Command", word, [*(command.name for command in BUILT_IN), *added])
    return (*BUILT_IN, *working(added.values()))


def loaded(entry: EntryPoint) -> Command:
    """Return another package's command; DefinitionError where it cannot be loaded or is none."""
    try:
        found = entry.load()
    except Exception as error:
        raise DefinitionError(f"The command {entry.name} ({entry.value}) cannot be loaded: {type(error).__name__}: {error}") from error
    if not (isinstance(found, type) and issubclass(found, Command)):
        raise DefinitionError(f"The command {entry.name} ({entry.value}) is no subclass of linkage.cli.Command.")
    return found()


def working(entries: Iterable[EntryPoint]) -> list[Command]:
    """Return the commands that can be loaded; of the others say on stderr why not."""
    commands = []
    for entry in entries:
        try:
            commands.append(loaded(entry))
        except DefinitionError as error:
            print(f"hydrolinkage: warning: {error}", file=sys.stderr)
    return commands
