"""`hydrolinkage list`: the machines that are installed, and the first line of each, read without loading any."""

from __future__ import annotations

import ast
import sys
import traceback
from argparse import ArgumentParser, Namespace
from collections.abc import Callable
from importlib.machinery import PathFinder
from importlib.metadata import EntryPoint, entry_points
from importlib.util import find_spec, resolve_name
from inspect import cleandoc
from pathlib import Path
from typing import Any, final

from ..errors import DefinitionError, LinkageError
from .command import Command, lined_up

GROUP = "hydrolinkage.machines"
OWN = "A machine of your own is written package.module:Class, file.py, file.py:Class, file.toml or file.json."


def registered() -> dict[str, EntryPoint]:
    """Return the installed machines by name."""
    return {entry.name: entry for entry in sorted(entry_points(group=GROUP), key=lambda entry: entry.name)}


@final
class ListCommand(Command):
    """Prints every installed machine with its first line."""

    name = "list"
    help = "the machines there are"

    def add(self, parser: ArgumentParser) -> None:
        """Declare nothing."""

    def run(self, options: Namespace) -> int:
        rows = []
        for name, entry in registered().items():
            try:
                rows.append((name, first_line(entry)))
            except DefinitionError as error:
                print(f"hydrolinkage: warning: {error}", file=sys.stderr)
        if not rows:
            raise DefinitionError(f"No machine is installed; install the package (pip install -e .). {OWN}")
        for line in lined_up(rows):
            print(line)
        return 0


def first_line(entry: EntryPoint) -> str:
    """Return the first line of a machine's docstring, out of its source; a machine without source is loaded."""
    text = docstring(entry.module, entry.attr)
    if text is None:
        text = guarded(entry.load, f"The machine {entry.name} ({entry.value})").__doc__ or ""
    return text.strip().partition("\n")[0]


def docstring(module: str, name: str) -> str | None:
    """Return the docstring of a class, "" where it has none; None where no source says it, as of a class that is made by a call.

    A module that hands the class on (`from .machine import Hitch as Hitch`) is followed.
    """
    path = source_file(module)
    if path is None:
        return None
    package = module if path.name == "__init__.py" else module.rpartition(".")[0]
    try:
        lines = ast.parse(path.read_bytes()).body
    except (OSError, SyntaxError, ValueError):
        return None
    for line in reversed(lines):
        if isinstance(line, ast.ClassDef) and line.name == name:
            return cleandoc(ast.get_docstring(line) or "")
        if isinstance(line, ast.ImportFrom):
            for each in line.names:
                if (each.asname or each.name) == name:
                    return docstring(resolve_name("." * line.level + (line.module or ""), package), each.name)
    return None


def source_file(module: str) -> Path | None:
    """Return the file of a module, None where it has none; neither it nor the packages around it are loaded."""
    whole, *parts = module.split(".")
    try:
        spec = find_spec(whole)
        for part in parts:
            whole = f"{whole}.{part}"
            spec = PathFinder.find_spec(whole, spec.submodule_search_locations or []) if spec else None
    except (ImportError, ValueError):
        return None
    return Path(spec.origin) if spec and spec.origin and spec.origin.endswith(".py") else None


def guarded(load: Callable[[], Any], what: str) -> Any:
    """Return what is loaded; whatever goes wrong in a user's module becomes a DefinitionError with its line."""
    try:
        return load()
    except FileNotFoundError as error:
        raise DefinitionError(f"{what}: {error.strerror or error}.") from error
    except SyntaxError as error:
        raise DefinitionError(f"{what} cannot be loaded: {error.filename}, line {error.lineno}: {error.msg}.") from error
    except LinkageError as error:
        raise DefinitionError(f"{what} cannot be loaded: {error}") from error
    except KeyboardInterrupt:
        raise
    except BaseException as error:  # a script that leaves by sys.exit is one as well
        last = traceback.extract_tb(error.__traceback__)[-1]
        where = "" if last.filename.startswith("<") else f" ({last.filename}, line {last.lineno})"
        raise DefinitionError(f"{what} cannot be loaded: {type(error).__name__}: {error}{where}.") from error
