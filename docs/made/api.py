"""The reference: the public names of the three packages, room by room, with what their docstrings say."""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterator, Sequence
from importlib import import_module
from pathlib import Path
from typing import Any

from linkage.quantities import Member

ROOMS = {
    ".mechanism": "The mechanism",
    ".steps": "Points, links and guides",
    ".quantities": "Strokes, dimensions and outputs",
    ".pictures": "Pictures and pages",
    ".documents": "Reports",
    ".exports": "Files for other programs",
    ".formulas": "Equations",
    ".motion": "Motions and what is asked of them",
    ".loads": "Loads and force elements",
    ".statics": "Forces",
    ".study": "What a search asks for",
    ".synthesis": "Machines for a task",
    ".mobility": "Mobility",
    ".surroundings": "Surroundings",
    ".verdict": "Verdicts",
    ".language": "Language",
    ".units": "Units",
    ".vectors": "Sides",
    ".errors": "Errors",
}
"""The rooms behind the front door, in the order of the page."""
OTHERS = {
    "linkage.study": "Studies",
    "linkage.synthesis": "Synthesis",
    "linkage.files": "Files",
    "linkage.reports": "Tables and results as text",
    "hydraulics": "Hydraulics",
    "mechanisms.three_point_hitch": "The three-point hitch",
    "mechanisms.header_balancer": "The header's balance",
    "mechanisms.crane": "The crane",
    "mechanisms.grapple": "The grapple",
}
"""Packages with a door of their own."""
NO_MEMBERS = ("Enum", "Exception", "Warning")


def make(folder: Path) -> None:
    """Write a page for the front door, one for each other door, and the list of them."""
    front = front_door()
    rooms = [*(room for room in ROOMS if room in front), *(room for room in front if room not in ROOMS)]
    parts = ["# linkage\n", "What `from linkage import *` gives, by the room it comes from.\n"]
    for room in rooms:
        parts += [f"\n## {ROOMS.get(room, room.strip('.').capitalize())}\n", *entries("linkage", front[room])]
    (folder / "linkage.md").write_text("\n".join(parts), encoding="utf-8")
    taken = {name for names in front.values() for name in names}
    pages = ["linkage"]
    for module, title in OTHERS.items():
        names = [name for name in door_names(module) if not (module.startswith("linkage.") and name in taken)]
        text = [f"# {title}\n", f"`from {module} import ...`\n", *entries(module, names)]
        pages.append(module.replace(".", "_"))
        (folder / f"{pages[-1]}.md").write_text("\n".join(text), encoding="utf-8")
    listed = "\n".join(pages)
    more = "Two of them, a design and a motion, are also described on {doc}`/reference`."
    head = f"# Reference of all names\n\nThe public names with what their docstrings say. {more}"
    (folder / "index.md").write_text(f"{head}\n\n```{{toctree}}\n:maxdepth: 2\n\n{listed}\n```\n", encoding="utf-8")


def front_door() -> dict[str, list[str]]:
    """Return the names of the front door by the room that they come from."""
    lines = Path(str(import_module("linkage").__file__)).with_suffix(".pyi").read_text(encoding="utf-8")
    found: dict[str, list[str]] = {}
    for room, name in re.findall(r"^from (\.\w+)[\w.]* import (\w+)", lines, re.MULTILINE):
        found.setdefault(room, []).append(name)
    return found


def door_names(module: str) -> list[str]:
    """Return the public classes, functions and values of a package's door."""
    door = import_module(module)
    plain_values = (str, int, float, dict, type(Path()))
    return sorted(name for name in door.__all__ if not isinstance(getattr(door, name), plain_values))


def entries(module: str, names: Sequence[str]) -> Iterator[str]:
    """Yield the entry of each name: classes and functions by autodoc, values in one table."""
    door = import_module(module)
    values = [name for name in names if not (inspect.isclass(getattr(door, name)) or callable(getattr(door, name)))]
    for name in names:
        thing = getattr(door, name)
        if inspect.isclass(thing):
            shown = "" if issubclass(thing, (Member, BaseException)) else "\n   :members:"
            yield f"```{{eval-rst}}\n.. autoclass:: {module}.{name}{written_arguments(thing)}{shown}\n```\n"
        elif name not in values:
            yield f"```{{eval-rst}}\n.. autofunction:: {module}.{name}{written_arguments(thing)}\n```\n"
    numbers = [name for name in values if isinstance(getattr(door, name), float)]
    if numbers:
        yield "\n".join(["| name | in SI |", "| --- | --- |", *(f"| `{name}` | {getattr(door, name):.10g} |" for name in numbers), ""])
    for name in (name for name in values if name not in numbers):
        yield f"`{name}`\n: {inspect.cleandoc(type(getattr(door, name)).__doc__ or '').partition(chr(10))[0]}\n"


def written_arguments(function: Any) -> str:
    """Return the arguments of a function whose signature names more than its source does, and of a member; "" for any other one."""
    if inspect.isfunction(function):
        given, code = inspect.signature(function), inspect.unwrap(function).__code__
        variable = bool(code.co_flags & inspect.CO_VARARGS) + bool(code.co_flags & inspect.CO_VARKEYWORDS)
        is_written = len(given.parameters) > code.co_argcount + code.co_kwonlyargcount + variable
    else:
        is_written = inspect.isclass(function) and issubclass(function, Member)
    if not is_written:
        return ""
    given = inspect.signature(function)
    plain_ones = [each.replace(annotation=inspect.Parameter.empty) for each in given.parameters.values()]
    return str(inspect.Signature(plain_ones))


INLINE = re.compile(r"(``[^`]*``|`[^`]*`)")


def as_restructured(app: Any, what: str, name: str, thing: Any, options: Any, lines: list[str]) -> None:
    """Let a docstring, which is plain text with `code`, be read as what it says: signs of markup stand for themselves.

    Of an attribute napoleon takes what stands before a colon in the first line for a type; so that line ends behind its first word.
    """
    text = "\n".join(lines)
    text = text.replace(" ", "\n", 1) if what in ("attribute", "property") else text
    parts = INLINE.split(text)
    parts = [part if part.startswith("`") else plain(part) for part in parts]
    joints = ["\\ " if part.startswith("`") and re.match(r"\w", after) else "" for part, after in zip(parts, [*parts[1:], ""], strict=True)]
    lines[:] = "".join(part + joint for part, joint in zip(parts, joints, strict=True)).splitlines()


def plain(text: str) -> str:
    """Return text whose signs of markup stand for themselves; bullets at the start of a line stay what they are."""
    text = re.sub(r"(?m)(?<!^)(?<!^ )\*|\*(?=\S)", r"\\*", text)
    text = re.sub(r"\|", r"\\|", text)
    return re.sub(r"(?<=\w)_(?=[\s.,;:)\]]|$)", r"\\_", text)
