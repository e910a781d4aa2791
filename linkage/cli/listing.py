"""`hydrolinkage list`: the machines that are installed, and the first line of each, read without loading any."""

from __future__ import annotations

import ast
import re
import sys
from argparse import Namespace
from collections import Counter
from collections.abc import Mapping
from functools import lru_cache
from importlib.machinery import PathFinder
from importlib.metadata import EntryPoint
from importlib.util import find_spec, resolve_name
from pathlib import Path
from shutil import get_terminal_size
from textwrap import wrap

from .. import plugins
from ..errors import DefinitionError, ensure
from ..plugins import guarded
from .command import Command
from .entry import BUILT_IN, PROGRAM

OWN = "A machine of your own is written package.module:Class, file.py, file.py:Class, file.toml or file.json."


def registered() -> Mapping[str, EntryPoint]:
    """Return the installed machines by name."""
    return plugins.entry_points(plugins.MACHINES)


@Command("list", "the machines and the commands there are")
def list_command(options: Namespace) -> int:
    """Print every installed machine with its first line, kind by kind, and the commands."""
    entries = registered()
    packages: dict[str, str] = {}
    for name, entry in entries.items():  # the package that a machine is in, of two words at most: `mechanisms.classics`, `mechanisms`
        two = ".".join(entry.module.split(".")[:2])
        path = source_file(two)
        packages[name] = two if path is not None and path.name == "__init__.py" else two.partition(".")[0]
    count = Counter(packages.values())
    groups: dict[str, list[tuple[str, str]]] = {}
    titles: dict[str, str] = {}
    for name, entry in entries.items():
        package = packages[name] if count[packages[name]] >= KIND else packages[name].partition(".")[0]
        try:
            row = name, first_line(entry)
        except DefinitionError as error:
            print(f"hydrolinkage: warning: {error}", file=sys.stderr)
        else:
            if package not in titles:  # by its docstring, and the distribution where it is not shipped
                node = syntax(package)
                says = (ast.get_docstring(node) or "").partition("\n")[0] if node is not None else ""
                title = re.split(r"[,:.]", says)[0].strip() or package
                whose = entry.dist.metadata["Name"] if entry.dist is not None else PROGRAM
                titles[package] = title if whose == PROGRAM else f"{title} ({whose})"
            groups.setdefault(titles[package], []).append(row)
    ensure(groups, f"No machine is installed; install the package (pip install -e .). {OWN}")
    commands = {**BUILT_IN, **plugins.entry_points(plugins.COMMANDS)}
    groups["Commands"] = []
    for name, entry in commands.items():  # none of them is loaded: a help stands in the source, `Command("name", "help", ...)`
        path = source_file(entry.module)
        text = path.read_text(encoding="utf-8") if path is not None else ""
        found = re.search(rf"""\bCommand\(\s*"{entry.name}",\s*("(?:[^"\\\n]|\\.)*")""", text)
        groups["Commands"].append((name, "" if found is None else str(ast.literal_eval(found[1]))))
    for title, rows in groups.items():
        size = max(len(name) for name, _ in rows)
        print(title, *(line for name, text in rows for line in wrapped(text, f"  {name.ljust(size)}  ")), "", sep="\n")
    print(*wrapped(OWN, ""), sep="\n")
    return 0


KIND = 3
"""Machines of a package that make a kind of their own; those of fewer are of the kind of the package around it."""


def wrapped(text: str, start: str, hanging: str = "") -> list[str]:
    """Return a text that begins with a start as lines no wider than the terminal; elsewhere than on one, than 100 columns.

    All but the first are indented as far as the start, and by what is `hanging` more.
    """
    width = max(get_terminal_size().columns if sys.stdout.isatty() else 100, len(start) + 20)
    return wrap(text, width, initial_indent=start, subsequent_indent=" " * len(start) + hanging) or [start.rstrip()]


def first_line(entry: EntryPoint) -> str:
    """Return the first line of a machine's docstring, out of its source; a machine without source is loaded."""
    node = class_node(entry.module, entry.attr)
    text = ast.get_docstring(node) if node is not None else guarded(entry.load, f"The machine {entry.name} ({entry.value})").__doc__
    return (text or "").strip().partition("\n")[0]


def class_node(module: str, name: str) -> ast.ClassDef | None:
    """Return a class as its source writes it; None where no source says it.

    A module that hands the class on (`from .machine import Hitch as Hitch`) is followed.
    """
    tree, path = syntax(module), source_file(module)
    package = module if path is not None and path.name == "__init__.py" else module.rpartition(".")[0]
    for line in reversed(tree.body) if tree is not None else ():
        if isinstance(line, ast.ClassDef) and line.name == name:
            return line
        if isinstance(line, ast.ImportFrom):
            for each in line.names:
                if (each.asname or each.name) == name:
                    return class_node(resolve_name("." * line.level + (line.module or ""), package), each.name)
    return None


@lru_cache(maxsize=64)
def syntax(module: str) -> ast.Module | None:
    """Return a module as its source writes it, with the names of its stub; None where there is none, or none that can be read."""
    path = source_file(module)
    try:
        found = None if path is None else ast.parse(path.read_bytes())
        if found is not None and path is not None and (stub := path.with_suffix(".pyi")).is_file():
            found.body += ast.parse(stub.read_bytes()).body
    except (OSError, SyntaxError, ValueError):
        return None
    return found


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
