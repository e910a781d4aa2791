"""Designs to write: a class as it is declared, or an instance with its dimensions as the new defaults."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from copy import copy
from itertools import chain, permutations
from math import isfinite
from typing import Any

from ..errors import DefinitionError, ensure, require_one_design
from ..mechanism import Mechanism
from ..plan import Part
from ..quantities import InnerQuantity, Member, Number, Quantity, Ref, is_number, joined_names, label, name_of, quantity, source_text
from ..quantities.quantity import plain
from ..steps import Link, Pin, Step
from ..units import factor, parse
from .expression import arrow_in, expression
from .source import FileTable, Names


class Design:
    """The values that a mechanism's members have, as a file holds them: numbers, and expressions as text."""

    def __init__(self, machine: type[Mechanism] | Mechanism, names: Names) -> None:
        self.plan, self.names = machine.plan, names
        self.set: FileTable = changed(machine) if isinstance(machine, Mechanism) else {}
        self.written: set[str] = set()

    def variable(self, name: str, given: Quantity) -> float | str:
        """Return the value of a design variable, or the expression given for it."""
        if not isinstance(given, Number):
            return self.scalar(given)
        self.written.add(name)
        return float(self.set.get(name, given.number))

    def amount(self, given: object, unit: str = "", name: str = "") -> object:
        """Return a number of a load as it is given, in its unit where that is exact, or the expression in its place.

        `name` is that of its design variable, where it is one.
        """
        value = plain(given)
        if not is_number(value):
            value = quantity(value)
            if not isinstance(value, Number):
                return self.scalar(value)
            value = value.number
        self.written.add(name)
        return in_unit(self.set.get(name, value), unit)

    def label(self, spelling: str, given: Any) -> float | str:
        """Return the value of a label [SI], or the expression that stands for it."""
        value = quantity(given)
        if not isinstance(value, Number) or spelling not in self.plan.table.spellings:
            return self.scalar(value)
        owner, sign = self.plan.table.spellings[spelling]
        self.written.add(owner)
        found = sign * float(self.set[owner]) if owner in self.set else value.number
        return degrees_text(found) if self.plan.table.entries[owner].kind == "angle" else found

    def scalar(self, given: Quantity) -> float | str:
        """Return a quantity as a number or as text that reads back as the same; DefinitionError where there is none."""
        if isinstance(given, Number):
            return given.number
        return self.read_back(source_text(given), form(given), expression)

    def arrow(self, given: Member | str) -> str:
        """Return a vector as text, or its name; DefinitionError unless it reads back as the same."""
        return self.read_back(label(given), form(given), arrow_in)

    def own(self, given: Member) -> str:
        """Return the text of a quantity's or a vector's own rule, whatever its name; DefinitionError unless it reads back as the same."""
        return self.read_back(str(given), own_form(given), expression if isinstance(given, Quantity) else arrow_in)

    def read_back(self, text: str, says: object, read: Callable[[str, Names], object]) -> str:
        """Return a text; DefinitionError unless reading it gives the original again."""
        ensure(own_form(read(text, self.names)) == says, f"{text} does not read back as it is; give its parts names of their own.")
        return text


def degrees_text(value: float | str) -> float | str:
    """Return an angle [rad] as text in degrees where that is short and reads back as the same, else as it is."""
    return in_unit(value, "deg") if isinstance(value, float) and abs(value) < 1e9 else value


def in_unit(value: float, unit: str) -> float | str:
    """Return a value [SI] as text in a unit where that is short and reads back as the same, else as it is."""
    size = factor(unit)
    if size == 1.0 or not isinstance(value, float) or value == 0.0 or not isfinite(value / size):
        return value
    text = f"{value / size:.9g} {unit}"
    return text if parse(text) == value else value


def option_said(value: object) -> object:
    """Return an option of a load as a file holds it: a number, a word or a member's name; DefinitionError for anything else."""
    value = name_of(value) if isinstance(value, Member) else plain(value)
    if is_number(value) or isinstance(value, str):
        return value
    raise DefinitionError(f"{value!r} is neither a number nor a word; a file cannot hold it.")


def changed(machine: Mechanism) -> dict[str, float]:
    """Return the dimensions of an instance that are not its class's [SI]; DefinitionError for a batch of designs."""
    require_one_design(machine.dimensions, f"{machine.plan.title}: a file holds one design")
    return {name: value for name, value in machine.dimensions.items() if value != machine.plan.defaults[name]}


def without_sketch(name: str, member: Member, machine: Mechanism) -> Member:
    """Return a member that no longer needs the sketch of its class."""
    match member:
        case Part():
            return member.having({each: value for each, value in changed(machine).items() if each.startswith(f"{name}.")})
        case Step() if member.near or member.drawn_at:
            found: Any = copy(machine.plan.members[name])
            found.near = found.drawn_at = None
            return found  # type: ignore[no-any-return]
        case Pin():
            strokes: dict[str, Any] = dict(machine.plan.sketch_strokes)
            x, y = machine.at(**strokes)[name]
            return Pin(near=(float(x), float(y)))
    return member


def measured_labels(design: Design, members: Mapping[str, Member]) -> dict[str, dict[str, float]]:
    """Return the labels that the class measured from its drawing, by the link that they belong to [m, rad]."""
    owners: dict[str, str] = {}
    for name, member in members.items():
        if isinstance(member, Link):
            points = [name_of(point) for point in member.points]
            for several in chain(permutations(points, 2), permutations(points, 3)):
                owners.setdefault(joined_names(*several), name)
    found: dict[str, dict[str, float]] = {}
    for each, entry in design.plan.table.entries.items():
        if each not in design.written and entry.kind in ("length", "angle"):
            ensure(each in owners, f"{each} was measured from the drawing and belongs to no link; give it in the class.")
            found.setdefault(owners[each], {})[each] = float(design.set.get(each, entry.default))
    return found


# -- what a quantity or a vector says, apart from how it is written: whether a text reads back as the same --


def own_form(member: object) -> object:
    """Return a member as nested tuples that compare; its own name does not count."""
    match member:
        case Ref():
            return member.target
        case InnerQuantity():
            return member.called
        case Member():
            return type(member), *(form(value) for name, value in vars(member).items() if name not in ("_name", "_class"))
    return member


def form(part: object) -> object:
    """Return a part of a member as a comparable value: its name where it has one."""
    match part:
        case tuple():
            return tuple(map(form, part))
        case Member() if part.name:
            return part.name
    return own_form(part)
