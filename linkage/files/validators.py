"""Kinds of arguments: how each is read from a file and how it is written into one."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from math import inf
from types import MappingProxyType
from typing import Any, TypeAlias

import numpy as np

from ..errors import DefinitionError, cited, ensure, is_listed, known_name, require, require_type
from ..quantities import Number, Quantity, is_number, label, name_of, quantity
from ..steps import Arrow
from ..units import UNITS, Amount, parse
from ..vectors import Side
from .design import Design, degrees_text, option_said
from .expression import arrow_in, expression, one_unit
from .source import Names, by_whole_names, each_of, listed

Read: TypeAlias = Callable[[Any, Names], Any]
Write: TypeAlias = Callable[[Any, Design, str], Any]

CORNERS = 2000
"""Corners of an outline."""
DEEPEST = 3
"""How deep lists may stand in each other."""


def file_value(value: object, design: Design, name: str = "") -> object:
    """Return a value as data of a file: an expression, a name, a number, a word, lists and tables of them.

    `name` is that of its design variable, where it is one. DefinitionError for what a file cannot hold.
    """
    match value:
        case Quantity():
            return design.variable(name, value)
        case Arrow():
            return design.arrow(value)
        case Mapping():
            return {key: file_value(each, design) for key, each in value.items()}
        case list() | tuple() | np.ndarray() if np.ndim(value):
            return [file_value(each, design) for each in value]
        case Side():
            return str(value)
        case bool() | np.bool_():
            return bool(value)
        case str():
            return word_of(value)
    return option_said(value)


@dataclass(frozen=True)
class Kind:
    """How an argument of one kind is read, by the names of the file, and written, by the design and the name of its variable.

    DefinitionError for anything else. `refers` to other members: without a default such an argument says what a member is built
    from. `make` is what becomes of the argument once the whole entry is sound.
    """

    read: Read
    write: Write = file_value
    refers: bool = False
    make: Callable[[Any], Any] = lambda value: value


# -- numbers and expressions -------------------------------------------------------------------------------


def quantity_of(given: Any, names: Names) -> Quantity:
    """Return a number [SI], a text such as `500 mm`, or an expression as a quantity."""
    if isinstance(given, str):
        return expression(given, names)
    require(is_number(given), "", given, "is neither a finite number nor an expression in quotes")
    return Number(float(given))


def number_of(given: object, names: Names, measures: str = "") -> float:
    """Return a number, or that of a text without names and with a unit of the right kind [SI]."""
    found: float = amount_of(given, names, measures)
    require(not isinstance(found, Quantity), "", given, "a number is expected here, with no names in it")
    return found


def amount_of(given: object, names: Names, measures: str) -> Any:
    """Return a number [SI], that of a text such as `1200 kg` with a unit of the right kind, or an expression as a quantity.

    Where nothing says what it should measure, a number with a unit knows what it does.
    """
    if not isinstance(given, str):
        require(is_number(given), "", given, "is not a finite number")
        return given  # an int stays one: it prints as it was written
    unit = one_unit(given)
    if unit and measures and UNITS[unit][1] != measures:
        parse(given.strip("+-() \t\n"), measures)  # which tells the units that do
    found = expression(given, names)
    if found.constant is None:
        return found
    return Amount(found.constant, UNITS[unit][1]) if unit and not measures else found.constant


def two_items(what: str, one: Read, given: Any, names: Names) -> tuple[Any, Any]:
    """Return the items of a list of two, each read by itself."""
    require(is_listed(given) and len(given) == 2, "", given, f"is not {what}")
    return one(given[0], names), one(given[1], names)


def items_of(one: Read, wrong: str, most: float, given: object, names: Names) -> tuple[Any, ...]:
    """Return the items of a list, each read by itself; `wrong` is the message for anything else, {given}."""
    if not is_listed(given) or len(given) > most:
        raise DefinitionError(wrong.format(given=cited(given)))
    return tuple(each_of(enumerate(given), lambda place, each: one(each, names)))


def point_or(place: Read, given: object, names: Names) -> object:
    """Return a point's name, or a place by two coordinates."""
    return names.checked(given, "point") if isinstance(given, str) else place(given, names)


def lists_of(given: object, names: Names, depth: int = 0) -> object:
    """Return a number or a word, or a list of them, or lists of lists as tuples."""
    if not is_listed(given):
        return word_of(given) if isinstance(given, str) else number_of(given, names)
    require(depth != DEEPEST, "", given, f"lists stand in each other more than {DEEPEST} deep")
    return tuple(lists_of(each, names, depth + 1) for each in given)


# -- names and words ---------------------------------------------------------------------------------------


def arrow_of(given: object, names: Names) -> Arrow | str:
    """Return a vector, or the name of one."""
    given = require_type("", given, str, 'is not a vector, such as "Vector(A, O)"')
    return arrow_in(given, names)


def words_in(given: Any, what: str) -> Sequence[object]:
    """Return the words of a text such as `O B C`, or of a list; DefinitionError where there is none."""
    words: Sequence[Any] = given.split() if isinstance(given, str) else given
    require(is_listed(words) and words, "", given, f"is not {what}")
    return words


def points_of(given: object, names: Names) -> tuple[str, ...]:
    """Return the names of points, from a text such as `O B C` or a list."""
    return tuple(names.checked(word, "point") for word in words_in(given, 'a list of points, such as "O B C"'))


def body_of(given: object, names: Names) -> str:
    """Return the name of a link, or the names of points of a body, in one text."""
    what = 'a body; name a link, or two of its points such as "O B"'
    words = words_in(given, what)
    require(len(set(map(str, words))) == len(words), "", given, f"is not {what}")
    kind = "point" if len(words) > 1 else "link"
    return " ".join(names.checked(word, kind) for word in words)


def loads_of(given: object, names: Names) -> object:
    """Return the name of a load, or a list of such."""
    return [names.checked(each, "load") for each in given] if is_listed(given) else names.checked(given, "load")


def factors_of(given: Any, names: Names) -> dict[str, float]:
    """Return numbers by the names of loads."""
    ensure(isinstance(given, Mapping), "is not a table { key = value }.")
    return dict(each_of(given.items(), lambda name, value: (names.checked(name, "load"), number_of(value, names))))


def strokes_of(given: object, names: Names) -> dict[str, float]:
    """Return values of strokes by name [SI]."""
    said = dict(by_whole_names(require_type("", given, Mapping, "is not a table of strokes, such as { S = 0.0 }")))
    for name in said:
        known_name("Stroke", name, names.strokes)
    return {name: number_of(value, names) for name, value in said.items()}


def member_of(given: object, names: Names) -> str:
    """Return the name of any member."""
    return known_name("Name", given, names.kinds)


def rope_points_of(given: object, names: Names) -> tuple[str, ...]:
    """Return the names of points and pulleys, from a text such as `A sheave D` or a list."""
    return tuple(member_of(word, names) for word in words_in(given, 'what a rope runs over, such as ["A", "sheave", "D"]'))


def side_named(given: object, names: Names) -> Side | None:
    """Return the side that a word says."""
    found = Side.parse(given) if isinstance(given, str) else None
    require(found is not None, "", given, 'is not a side; write "LEFT" or "RIGHT"')
    return found


def word_of(given: object, names: Names | None = None) -> str:
    """Return a word that stands for itself."""
    require(isinstance(given, str) and given.isprintable(), "", given, "stands where a word in quotes is expected")
    return str(given)


def switch_of(given: object, names: Names) -> bool:
    """Return true or false."""
    return bool(require_type("", given, (bool, np.bool_), "is neither true nor false"))


# -- as they are written -----------------------------------------------------------------------------------


def written_origin(value: Any, design: Design, name: str) -> object:
    """Return where a guide starts: a point's name, or two coordinates."""
    if not isinstance(value, tuple):
        return label(value)
    owner = name.rpartition(".")[0]
    return [design.variable(f"{owner}.{axis}", Number(part)) for axis, part in zip("xy", value, strict=True)]


def written_force(value: Any, design: Design, name: str) -> object:
    """Return the two parts of a force, each a design variable of its own."""
    owner = name.rpartition(".")[0]
    return [design.amount(part, "N", f"{owner}.{axis}") for axis, part in zip("xy", value, strict=True)]


def written_lengths(value: Any, design: Design, name: str) -> list[object]:
    """Return a list of lengths, each a design variable of its own: `hoist.bore_1` is the first of `hoist.bores`."""
    return [design.amount(each, "mm", f"{name.removesuffix('s')}_{number}") for number, each in enumerate(value, 1)]


def written_names(value: object, design: Design, name: str) -> str | list[str]:
    """Return the name of one member, or a list of names."""
    found = [name_of(each) for each in listed(value)]
    return found[0] if len(found) == 1 else found


def written_body(value: object, design: Design, name: str) -> str:
    """Return the names of a link or of points of a body in one text."""
    return " ".join(map(name_of, value.split() if isinstance(value, str) else value if isinstance(value, tuple) else (value,)))


def written_carrier(value: Any, design: Design, name: str) -> str | None:
    """Return the names of the points that carry something in one text; None where nothing does."""
    return written_body(value, design, name) if value else None


def written_pair(value: Any, design: Design, name: str) -> list[object]:
    """Return the numbers of a pair; DefinitionError for lists in it."""
    return [option_said(each) for each in value]


# -- the kinds ---------------------------------------------------------------------------------------------


def reference(kind: str) -> Kind:
    """Return the kind of an argument that names a member of a kind."""
    return Kind(lambda given, names: names.checked(given, kind), refers=True)


def fixed_number(measures: str) -> Kind:
    """Return the kind of a number that follows nothing, with the unit that it may have."""
    return Kind(lambda given, names: number_of(given, names, measures))


def amount(unit: str) -> Kind:
    """Return the kind of a number that may be a design variable or follow one, written in a unit where that is exact."""
    measures = UNITS[unit][1] if unit in UNITS else ""
    return Kind(lambda given, names: amount_of(given, names, measures), lambda value, design, name: design.amount(value, unit, name))


place_of = partial(two_items, "a position in m, such as [0.51, 0.94]", lambda given, names: float(number_of(given, names)))
pair_of = partial(two_items, "two numbers, such as [0, 1]", number_of)
gravity_of = partial(two_items, "two numbers in m/s2, such as [0, -9.81]", number_of)
force_of = partial(two_items, 'a force of two parts in N, such as ["-5 kN", 0]', lambda given, names: amount_of(given, names, "force"))
stroke_ends = partial(two_items, "two numbers, such as [0.0, 0.25]", number_of)
coordinates_of = partial(two_items, "two coordinates in m, such as [0.20, 0.55]", quantity_of)


corners_of = partial(items_of, coordinates_of, f"{{given}} is no list of up to {CORNERS} places in m, such as [[0, 0], [0.4, 0]].", CORNERS)
lengths_of = partial(items_of, amount("m").read, '{given} is no list of lengths, such as ["145 mm", "125 mm"].', inf)
loads_listed = partial(items_of, reference("load").read, "is not a list [...].", inf)
word_list_of = partial(items_of, word_of, "{given} is no list of words.", inf)


KINDS: Mapping[str, Kind] = MappingProxyType(
    {kind: reference(kind) for kind in ("point", "guide", "load", "link")}
    | {
        "number": fixed_number(""),
        "angle": Kind(lambda given, names: number_of(given, names, "angle"), lambda value, design, name: degrees_text(float(value))),
        "quantity": Kind(quantity_of, lambda value, design, name: design.variable(name, quantity(value))),
        "direction": Kind(quantity_of, lambda value, design, name: degrees_text(design.variable(name, quantity(value)))),
        "vector": Kind(arrow_of, refers=True),
        "points": Kind(points_of, written_body, refers=True),
        "body": Kind(body_of, written_body, refers=True),
        "loads": Kind(loads_of, written_names, refers=True),
        "member": Kind(member_of, refers=True),
        "run": Kind(rope_points_of, refers=True),
        "load list": Kind(loads_listed),
        "load factors": Kind(factors_of),
        "origin": Kind(partial(point_or, place_of), written_origin),
        "place": Kind(place_of, written_pair),
        "pair": Kind(pair_of, written_pair),
        "gravity": Kind(gravity_of, written_pair),
        "force vector": Kind(force_of, written_force),
        "corner": Kind(coordinates_of),
        "corners": Kind(corners_of, refers=True),
        "centre": Kind(partial(point_or, coordinates_of), refers=True),
        "carrier": Kind(points_of, written_carrier),
        "path": Kind(word_of, refers=True),
        "lengths": Kind(lengths_of, written_lengths),
        "words": Kind(word_list_of),
        "side": Kind(side_named),
        "word": Kind(word_of),
        "switch": Kind(switch_of),
        "numbers": Kind(lists_of),
        "option": Kind(lists_of),
    }
)
"""The kinds by name: what a class may say in `argument_kinds`, `expects` and `places`."""
