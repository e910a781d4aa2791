"""From a mechanism to tables, and from tables to text."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Iterator, Mapping
from inspect import cleandoc
from pathlib import Path
from textwrap import fill
from typing import Any

from ..disk import replacing_text
from ..errors import DefinitionError, FileError, cited, is_class_of, require
from ..mechanism import Mechanism, declared, require_mechanism
from ..plan import Part
from .design import Design, changed, measured_labels, without_sketch
from .parts_file import dotted_kinds, machines_of
from .registry import registry
from .source import FileTable, Keywords, Names

Machine = type[Mechanism] | Mechanism
WIDTH = 120


def to_dict(machine: Machine) -> Keywords:
    """Return a mechanism as tables of plain values; an instance's changed dimensions are the new defaults.

    Parameters
    ----------
    machine : Mechanism or type of Mechanism
        The machine, a design or a class.

    Returns
    -------
    mapping of str to object
        The tables.

    Raises
    ------
    DefinitionError
        A file cannot hold it: several designs at once, members and functions of unknown kinds.
    """
    is_machine = isinstance(machine, Mechanism) or is_class_of(machine, Mechanism)
    require(is_machine, "", machine, "is no mechanism; give a class of Mechanism, or a design of one")
    members = declared(type(machine) if isinstance(machine, Mechanism) else machine)
    if isinstance(machine, Mechanism) and changed(machine):  # it has moved away from its sketch: sides are said, pins stand where they are
        members = {name: without_sketch(name, member, machine) for name, member in members.items()}
    entries = {name: registry().writing(member) for name, member in members.items()}
    sections = {name: entry.section for name, entry in entries.items()}
    kinds = {name: registry().kind(section) for name, section in sections.items()}
    machines = machines_of(members)
    for name, member in members.items():
        kinds |= dotted_kinds(name, member.machine) if isinstance(member, Part) else {}
    design = Design(machine, Names(sections, kinds, machines=machines))
    tables: dict[str, Keywords] = {section: {} for section in dict.fromkeys(sections.values())}
    for name, member in members.items():
        try:
            tables[sections[name]][name] = entries[name].write(member, design)
        except DefinitionError as error:
            raise DefinitionError(f"{design.plan.title}.{name} cannot be written into a file: {error}") from error
    if design.set:
        for name, labels in measured_labels(design, members).items():
            tables[sections[name]][name] |= labels
    names = [name for table in tables.values() for name in table]
    head = head_table(machine, [] if names == list(members) else list(members)) | tables
    held: Keywords = {}
    for title, part in machines.items():
        own = to_dict(part)
        held |= own.pop("machines", {})
        held[title] = own
    return head | ({"machines": held} if held else {})


def head_table(machine: Machine, order: list[str]) -> Keywords:
    """Return the head of a file, above the sections: name, docstring, the members' order where these do not keep it, features [SI]."""
    design = machine if isinstance(machine, Mechanism) else machine()
    cls = type(design)
    doc = cleandoc(cls.__doc__ or "")
    if not all(each.isprintable() or each in "\n\t" for each in doc):
        raise DefinitionError(f"{cls.__name__}: its docstring holds characters that cannot be printed; take them out.")
    about = design.featured()
    limits = {name: list(limit) for name, limit in about.limits.items()}
    featured: Keywords = {"column": about.column, "path": list(about.path), "limits": limits, "coupler": about.coupler}
    beside = {"doc": doc, "order": order, "featured": {name: value for name, value in featured.items() if value}}
    return {"name": cls.__name__} | {name: value for name, value in beside.items() if value}


def left_out(machine: Machine) -> tuple[str, ...]:
    """Return the names in a class that a file does not hold: functions, checks, values of its own.

    Parameters
    ----------
    machine : Mechanism or type of Mechanism
        The machine, a design or a class.

    Returns
    -------
    tuple of str
        The names.
    """
    cls: Any = type(machine) if isinstance(machine, Mechanism) else machine
    if not is_class_of(cls, Mechanism):
        require_mechanism(cls)
    own = [base for base in cls.__mro__ if issubclass(base, Mechanism) and base is not Mechanism]
    names = {name for base in own for name in vars(base) if name == "__init__" or not name.startswith(("__", "_abc_"))}
    return tuple(sorted(names - {"about", "featured", "plan", *declared(cls)}))


def to_toml(machine: Machine) -> str:
    """Return a mechanism as TOML text; numbers are exact.

    Parameters
    ----------
    machine : Mechanism or type of Mechanism
        The machine, a design or a class.

    Returns
    -------
    str
        The text.

    Raises
    ------
    DefinitionError
        A file cannot hold some of its values.
    """
    return "\n\n".join(toml_blocks(to_dict(machine), "")) + "\n"


def to_json(machine: Machine) -> str:
    """Return a mechanism as JSON text; numbers are exact.

    Parameters
    ----------
    machine : Mechanism or type of Mechanism
        The machine, a design or a class.

    Returns
    -------
    str
        The text.

    Raises
    ------
    DefinitionError
        A file cannot hold some of its values.
    """
    sections = []
    for name, value in to_dict(machine).items():
        text = json_inline(value)
        if isinstance(value, Mapping):  # a line for each member
            text = "{\n" + ",\n".join(f"    {json_inline(each)}: {json_inline(inner)}" for each, inner in value.items()) + "\n  }"
        sections.append(f"  {json_inline(name)}: {text}")
    return "{\n" + ",\n".join(sections) + "\n}\n"


def save(machine: Machine, path: str | os.PathLike[str]) -> None:
    """Write a mechanism into a file, TOML or JSON by its ending; an existing file is replaced whole.

    Parameters
    ----------
    machine : Mechanism or type of Mechanism
        The machine, a design or a class.
    path : str or Path
        The file.

    Raises
    ------
    FileError
        The file cannot be written: an existing one is then left as it was.
    """
    writers = {".toml": to_toml, ".json": to_json}
    if not isinstance(path, (str, os.PathLike)):
        raise FileError(f"a path is expected, not {type(path).__name__}.")
    place = Path(path)
    if place.suffix not in writers:
        raise FileError(f"{cited(os.fspath(path), quote=False)}: the name of a mechanism's file ends in .toml or .json.")
    text = writers[place.suffix](machine)
    with replacing_text(place) as stream:
        stream.write(text)


def json_inline(value: object) -> str:
    """Return a value in one line."""
    return json.dumps(value, ensure_ascii=False, allow_nan=False)


# -- TOML: a line for each member where it fits, a table of its own where it does not -----------------------


def toml_blocks(data: FileTable, path: str) -> Iterator[str]:
    """Yield the head of a machine, plain values, then a table for each section; `path` is that of one that the file holds for its parts."""
    head = [f"{toml_key(name)} = {long_text(value)}" for name, value in data.items() if not isinstance(value, Mapping)]
    yield "\n".join([*([f"[{path}]"] if path else []), *head])
    for name, table in data.items():
        if name == "machines" and not path:
            for title, machine in table.items():
                yield from toml_blocks(machine, f"machines.{toml_key(title)}")
        elif isinstance(table, Mapping):
            yield "\n".join(toml_section(f"{path}.{toml_key(name)}" if path else toml_key(name), table))


def toml_section(name: str, table: FileTable) -> Iterator[str]:
    """Yield a section's lines."""
    lines = [f"{toml_key(each)} = {toml_inline(value)}" for each, value in table.items()]
    if not all(isinstance(value, Mapping) for value in table.values()) or all(len(line) <= WIDTH for line in lines):
        yield f"[{name}]"
        yield from lines
        return
    for place, (each, value) in enumerate(table.items()):
        yield from ["", f"[{name}.{toml_key(each)}]"][place == 0 :]
        yield from (f"{toml_key(part)} = {toml_inline(inner)}" for part, inner in value.items())


def toml_key(name: str) -> str:
    """Return a key, in quotes where its letters are not all plain."""
    return name if re.fullmatch(r"[A-Za-z0-9_-]+", name) else toml_inline(name)


def toml_inline(value: object) -> str:
    """Return a value in one line."""
    match value:
        case Mapping():
            return f"{{ {', '.join(f'{toml_key(name)} = {toml_inline(each)}' for name, each in value.items())} }}"
        case list():
            return f"[{', '.join(map(toml_inline, value))}]"
        case str() | bool():
            return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    return repr(value)


def long_text(value: object) -> str:
    """Return a value of the head; a text of several lines as such, a list of names filled into lines."""
    if isinstance(value, list):
        names = " ".join(f"{toml_inline(each)}," for each in value)
        return "[\n" + fill(names, WIDTH, initial_indent="    ", subsequent_indent="    ") + "\n]"
    if not isinstance(value, str) or "\n" not in value:
        return toml_inline(value)
    escaped = value.replace("\\", "\\\\").replace('"""', '""\\"')
    if escaped.endswith('"'):
        escaped = escaped[:-1] + '\\"'
    return f'"""\n{escaped}"""'
