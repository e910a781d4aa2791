"""How parts stand in a file: `lower = { machine = "Arm", S = "s1", OB = "450 mm", on = ["T", "O"] }`, and the machines that they are.

A machine stands in the file itself, `[machines.Arm.points]`, once for all parts of its class; it may also be a name that is installed or
another file in the same folder, `machine = "arm.toml"`.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from .. import plugins
from ..errors import DefinitionError, is_class_of, require, require_type, unknown
from ..mechanism import Mechanism
from ..plan import Part
from ..quantities import Member, is_member_or_name, is_nothing, label, quantity
from ..steps import Point
from .design import Design, degrees_text
from .entry import Read, coordinates_of, points_of, quantity_of, switch_of, written_names
from .source import Keywords, Names, by_whole_names

OWN_KEYS: Mapping[str, Read] = {"on": points_of, "at": coordinates_of, "angle": quantity_of, "mirrored": switch_of}
"""What a part has beside its machine and the members that it is given, each with what reads it."""
FILES = (".toml", ".json")


def machine_named(given: object, names: Names) -> type[Mechanism]:
    """Return the class that a part's `machine` names: one of the file, one that is installed, or that of a file beside this one."""
    given = require_type("", given, str, 'is no machine; write machine = "Arm", of [machines.Arm...] or an installed one')
    if given in names.machines:
        return names.machines[given]
    if given.endswith(FILES) and names.load_beside is not None:
        return names.load_beside(given)
    installed = plugins.entry_points(plugins.MACHINES)
    if given in installed:
        found = plugins.guarded(installed[given].load, f"the machine {given}")
        if is_class_of(found, Mechanism):
            return found
    raise unknown("Machine", given, [*names.machines, *installed])


def part_read(given: Any, names: Names) -> Part:
    """Return the part that an entry says."""
    require(isinstance(given, Mapping) and "machine" in given, "", given, 'is no part; write { machine = "Arm", S = "s1" }')
    machine = machine_named(given["machine"], names)
    plan = machine.plan
    options: Keywords = {key: read(given[key], names) for key, read in OWN_KEYS.items() if key in given}
    for name, value in by_whole_names(given):
        if name == "machine" or name in OWN_KEYS:
            continue
        if value is False:
            options[name] = None
        elif isinstance(plan.members.get(name), Point):
            options[name] = names.checked(value, "point") if isinstance(value, str) else coordinates_of(value, names)
        else:
            options[name] = quantity_of(value, names)
    return Part(machine, **options)


def part_written(member: Part, design: Design) -> Keywords:
    """Return a part as a file holds it; a member that is left out is false."""
    design.written |= {name for name in design.plan.table.entries if name.startswith(f"{member.name}.")}
    own = {name.removeprefix(f"{member.name}."): value for name, value in design.set.items() if name.startswith(f"{member.name}.")}
    found: Keywords = {"machine": member.plan.title}
    for name, value in {**member.given, **own}.items():
        owner, _ = member.plan.table.spellings.get(name, ("", 1))
        if value is None:
            found[name] = False
        elif isinstance(member.plan.members.get(name), Point):
            found[name] = label(value) if is_member_or_name(value) else [design.scalar(quantity(each)) for each in value]
        elif owner and member.plan.table.entries[owner].kind == "angle":
            found[name] = degrees_text(design.scalar(quantity(value)))
        else:
            found[name] = design.scalar(quantity(value))
    if member.on:
        found["on"] = written_names(member.on, design, "on")
    if not all(map(is_nothing, member.at)):
        found["at"] = [design.scalar(each) for each in member.at]
    if not is_nothing(member.angle):
        found["angle"] = degrees_text(design.scalar(member.angle))
    return found | ({"mirrored": True} if member.mirrored else {})


def dotted_kinds(name: str, machine: type[Mechanism]) -> dict[str, str]:
    """Return the kinds of the members of a part by their names in the whole."""
    plan = machine.plan
    found = {f"{name}.{each}": member.kind for each, member in plan.members.items()}
    return found | {f"{name}.{alias}": plan.members[alias].kind for alias in plan.aliases}


def machines_of(members: Mapping[str, Member]) -> dict[str, type[Mechanism]]:
    """Return the classes of the parts among some members, by title; DefinitionError for two of one title."""
    found: dict[str, type[Mechanism]] = {}
    for member in members.values():
        if isinstance(member, Part):
            known = found.setdefault(member.plan.title, member.machine)
            if known is not member.machine:
                raise DefinitionError(f"{member.plan.title}: two classes of parts have this name; a file holds each once, so rename one.")
    return found
