"""From tables to a class of mechanism: every entry checked by itself first, then the class as a whole."""

from __future__ import annotations

import os
from collections.abc import Collection, Mapping
from copy import copy
from functools import cache, partial
from graphlib import CycleError, TopologicalSorter
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np

from ..errors import AssemblyError, DefinitionError, FileError, about, cited, ensure, require
from ..mechanism import Mechanism
from ..motion import Featured
from ..plan import Table
from ..steps import Point
from .parts_file import dotted_kinds, machine_named
from .registry import registry
from .source import FileTable, Names, Source, by_whole_names, member_name, source

HEAD = ("name", "doc", "order", "featured", "machines")
MACHINES = 50
MEMBERS = 400
SKETCHED = 100  # members that stand in a sketch: assembling them takes time by the cube
LINKS = 200


def load(path_or_text: str | os.PathLike[str], trust: Collection[str] = ()) -> type[Mechanism]:
    """Return the class of mechanism that a TOML or JSON file says.

    A file is data and runs nothing. A class of steps or loads that it names by an import path, `kind = "mypackage.cams:CamFollower"`, must
    be imported already, or its package be trusted.

    Parameters
    ----------
    path_or_text : str or Path
        The file; a text is read as such where it has several lines or begins with `{`.
    trust : collection of str, optional
        Packages that may be imported, `trust=["mypackage"]`.

    Returns
    -------
    type of Mechanism
        The class.

    Raises
    ------
    FileError
        The file has mistakes; each is named with its key and, in TOML, its line.
    AssemblyError
        The mechanism cannot be assembled.
    """
    found = source(path_or_text)
    return built(found.data, found, trusted(trust), found.folder)


def from_dict(data: Mapping[str, object], trust: Collection[str] = ()) -> type[Mechanism]:
    """Return the class of mechanism that tables say, as `load` has them from a file.

    Parameters
    ----------
    data : mapping of str to object
        The tables.
    trust : collection of str, optional
        Packages that may be imported, as of `load`.

    Returns
    -------
    type of Mechanism
        The class.

    Raises
    ------
    FileError
        The tables have mistakes; each is named with its key.
    """
    return built(data, Source(name="the tables"), trusted(trust))


def trusted(given: object) -> tuple[str, ...]:
    """Return the packages that may be imported; DefinitionError for anything but a list of names."""
    if isinstance(given, str) or not isinstance(given, Collection) or not all(isinstance(each, str) and each for each in given):
        raise DefinitionError(f'trust={cited(given)} is no list of packages; write trust=["mypackage"].')
    return tuple(given)


DEEPEST = 8
"""Files of parts in files of parts, so deep."""


def built(
    data: FileTable, faults: Source, trust: Collection[str], folder: Path | None = None, depth: int = 0,
    machines: Mapping[str, type[Mechanism]] = MappingProxyType({}),
) -> type[Mechanism]:  # fmt: skip
    """Return the class that the tables say.

    `folder` is that of the file, where other files of parts may stand; `machines` are those that the file around holds for parts.
    """
    sections = sections_of(data, faults)
    title, doc, featured = head_read(data, faults)
    if depth > DEEPEST:
        raise FileError(f"{faults.name}: files of parts name each other more than {DEEPEST} deep, or in a circle.")

    found = names_of(sections, faults)
    kinds = {name: registry().kind(section) for name, section in found.items()}
    held = machines_read(data, faults, trust, folder, depth, machines)
    load_beside = cache(partial(machine_beside, folder, trust, depth + 1))
    names = Names(found, kinds, machines=held, load_beside=load_beside, folder=folder)
    for name, entry in sections.get("parts", {}).items():
        if isinstance(entry, Mapping) and "machine" in entry:
            with faults.at_key("parts", name, "machine"):
                machine = machine_named(entry["machine"], names)
                names.kinds.update(dotted_kinds(name, machine))
                said = dict(by_whole_names(entry))
                names.of_parts.extend(f"{name}.{each}" for each in machine.plan.strokes if each not in said)
    for name in ordered(data, names, faults):
        section = names.sections[name]
        with faults.at_key(section, name), np.errstate(all="ignore"):
            given = sections[section][name]
            names.built[name] = member = registry().reading(section, given, trust).read(given, names)
            member.__set_name__(Mechanism, name)  # what follows shows that it is sound by itself, whatever the others are
            table = Table(title)
            for variable, default, kind, unit in member.variables():
                table.add_variable(variable, default, kind, f"{name} = {member}", unit)
            member.enter(table)
            if isinstance(member, Point):
                member.bind(name, table)
    faults.check()
    return class_made(title, doc, featured, names, faults)


def machine_beside(folder: Path | None, trust: Collection[str], depth: int, name: str) -> type[Mechanism]:
    """Return the machine of another file in the folder of the current one; DefinitionError for one elsewhere."""
    if folder is None:
        raise DefinitionError(f"{cited(name)}: a text has no folder; put the machine in it, [machines.Name...].")
    require(Path(name).name == name, "", name, "the file of a part stands in the folder of the one that names it; give its name alone")
    found = source(folder / name)
    return built(found.data, found, trust, folder, depth)


# -- the tables --------------------------------------------------------------------------------------------


def sections_of(data: object, faults: Source) -> dict[str, FileTable]:
    """Return the sections with their entries; anything else is noted."""
    if not isinstance(data, Mapping):
        raise FileError(f"{faults.name}: a table of sections is expected, not {type(data).__name__}.")
    known = registry().sections
    found: dict[str, FileTable] = {}
    for key, value in data.items():
        if key in known and isinstance(value, Mapping):
            found[key] = value
        elif key not in HEAD:
            what = "must be a table of members." if key in known else f"is not a section; there are {', '.join([*HEAD, *known])}."
            faults.add((str(key),), f"{what}{'' if key in known else registry().absent()}")
    return found


def head_read(data: FileTable, faults: Source) -> tuple[str, str | None, Featured]:
    """Return the class's name, its docstring and its features; anything else is noted."""
    title, doc, featured, given = data.get("name"), data.get("doc"), Featured(), data.get("featured", {})
    with faults.at_key("name"):
        ensure(title is not None, 'the name of the mechanism is missing; begin with name = "ThreePointHitch".')
        member_name(title)
    if doc is not None and not (isinstance(doc, str) and all(each.isprintable() or each in "\n\t" for each in doc)):
        faults.add(("doc",), f"{cited(doc)} is not a text of printable characters.")
    with faults.at_key("featured"):
        if not isinstance(given, Mapping) or not {"column", "path", "limits", "coupler"} >= given.keys():
            raise DefinitionError('a table is expected, column = "tilt", path = ["G"], limits = { tilt = [0.1, "most"] }.')
        featured = Featured(**given)
    return str(title), doc, featured


def machines_read(
    data: FileTable, faults: Source, trust: Collection[str], folder: Path | None, depth: int, around: Mapping[str, type[Mechanism]]
) -> dict[str, type[Mechanism]]:
    """Return the machines that a file holds for its parts, by name, beside those `around`; one may have parts that are others of them."""
    given = data.get("machines", {})
    found = dict(around)
    if not isinstance(given, Mapping) or not all(isinstance(each, Mapping) for each in given.values()) or len(given) > MACHINES:
        faults.add(("machines",), f"a table of up to {MACHINES} machines is expected, each with its sections.")
        return found
    inner: dict[str, set[str]] = {}
    for name, tables in given.items():
        parts = tables.get("parts", {})
        entries = parts.values() if isinstance(parts, Mapping) else ()
        inner[name] = {str(each["machine"]) for each in entries if isinstance(each, Mapping) and "machine" in each} & given.keys()
    try:
        order = [*TopologicalSorter(inner).static_order()]
    except CycleError as error:
        faults.add(("machines", error.args[1][0]), "holds itself as a part; a machine in a circle has no end.")
        return found
    for name in order:
        tables = {"name": name, **{key: value for key, value in given[name].items() if key != "machines"}}
        own = Source(name=f"{faults.name}, machines.{name}")
        with faults.at_key("machines", name):
            found[name] = built(tables, own, trust, folder, depth + 1, found)
    return found


def names_of(sections: Mapping[str, Mapping[str, object]], faults: Source) -> dict[str, str]:
    """Return all names with their sections; bad and double ones are noted. FileError for more members than any machine has."""
    members = [entry for table in sections.values() for entry in table.values()]
    sketched = sum(isinstance(entry, Mapping) and not {"near", "at"}.isdisjoint(entry) for entry in members)
    counts = {"members": (len(members), MEMBERS), "sketch positions": (sketched, SKETCHED)}
    counts["links"] = len(sections.get("links", {})), LINKS
    for what, (count, limit) in counts.items():
        if count > limit:
            raise FileError(f"{faults.name}: {count} {what} are too many; up to {limit} are read.")
    found: dict[str, str] = {}
    for section, entries in sections.items():
        for name in entries:
            with faults.at_key(section, str(name)):
                member_name(name)
                taken = f"stands in [{found[name]}] too" if name in found else "is a word of the framework"
                ensure(name not in found and name not in vars(Mechanism), f"{name} {taken}; give it another name.")
                found[name] = section
    return found


def ordered(data: FileTable, names: Names, faults: Source) -> list[str]:
    """Return the names in the order that the file says; those it does not mention stand behind."""
    order = data.get("order", [])
    given: list[Any] = order if isinstance(order, list) and all(isinstance(each, str) for each in order) else [None]
    anywhere = {name for table in data.values() if isinstance(table, Mapping) for name in table}
    unknown = [cited(each) for each in given if each not in anywhere]
    if unknown or len(set(given)) < len(given):
        faults.add(("order",), f"a list of names is expected, each once; {', '.join(unknown[:3]) or 'one'} is not such a name.")
    return list(dict.fromkeys([*(each for each in given if each in names.sections), *names.sections]))


# -- the class ---------------------------------------------------------------------------------------------


def class_made(title: str, doc: str | None, featured: Featured, names: Names, faults: Source) -> type[Mechanism]:
    """Return the class with the members that are built; faults of the whole class come with the file's name and key."""
    try:
        with np.errstate(all="ignore"):
            own = {"__module__": __name__, "__doc__": doc, "about": featured}
            machine: type[Mechanism] = type(title, (Mechanism,), {**own, **names.built})
            for name in machine.plan.valued_members:
                with about(name):
                    machine.plan.nodes(name)
        return machine
    except DefinitionError as error:
        faults.add((names.sections[error.member], error.member) if error.member in names.sections else (), str(error))
        raise FileError(faults.text()) from error
    except AssemblyError as error:
        faults.add((names.sections[error.point], error.point) if error.point in names.sections else (), str(error))
        located = copy(error)
        located.args = (faults.text(),)
        raise located from error
    except RecursionError:
        raise FileError(f"{faults.name}: expressions hang on each other in too long a chain; shorten it.") from None
    except ArithmeticError as error:
        raise FileError(f"{faults.name}: a value overflows or is divided by zero ({error}); look for extreme numbers.") from error
