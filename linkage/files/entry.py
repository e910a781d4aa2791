"""An entry of a file: how a member is read from it and written into it, as the signature of its class says; the kinds of arguments.

Where a section holds several classes, the class's name is the key of what the member is built from, its other arguments stand under
their own names: `B = { Dyad = ["A", "O"], AB = "L0 + S", side = "RIGHT" }`. A class that is named by its import path has all arguments
under their names: `P = { kind = "mypackage.cams:CamFollower", O = "A", lift = "phi" }`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import MISSING, fields, is_dataclass, replace
from functools import partial
from inspect import Parameter, ismethod, signature
from math import inf
from types import MappingProxyType
from typing import Any, TypeAlias

import numpy as np

from ..errors import DefinitionError, cited, did_you_mean, ensure, errors_of, is_listed, known_name, require, require_type
from ..frozen import FrozenDict, immutable, record
from ..loads import ForceElement
from ..quantities import Member, Number, Quantity, is_number, label, name_of, quantity
from ..quantities.member import KEPT_AS, annotated_kind, kinds_said
from ..steps import Arrow, Point, Step
from ..units import SI, UNITS, Amount, parse
from ..vectors import Side
from .design import Design, degrees_text, option_said
from .expression import arrow_in, expression, one_unit
from .source import NAME_LENGTH, FileTable, Keywords, Mistakes, Names, by_whole_names, each_of, listed

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


@record
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


Make: TypeAlias = Callable[..., Member]
Keys: TypeAlias = Mapping[str, str]
NO_KEYS: Keys = FrozenDict()
LABELS = 100
VALUES = 100
"""Values in a list of them."""

PATH = "kind"
"""The key of the import path of a class that has no name of its own in files."""

EXAMPLES = {"point": ("A", "O"), "guide": ("rail", "post"), "vector": ("AB",), "load": ("lift",), "loads": ("lift",), "body": ("O B",)}


# -- the arguments of a class ------------------------------------------------------------------------------


@record
class Argument:
    """An argument of a class, its key in a file, and its default, Parameter.empty where it must be given.

    One as it is by default `may_go` unwritten: all of a frozen dataclass, which prints without; else what is nothing, or 1.
    """

    name: str
    key: str
    kind: Kind
    default: Any
    may_go: bool

    @property
    def needed(self) -> bool:
        """Whether it must be given."""
        return self.default is Parameter.empty

    def written(self, member: object, design: Design, owner: str) -> Any:
        """Return the argument that a member has as a file holds it; None where it need not be written. `owner` is the member's name."""
        value = argument_kept(member, self.name)
        counts = not isinstance(member, ForceElement) or self.name not in member.parameters or self.name in member.numbers
        if not self.needed and (value is None or not counts):
            return None
        found = self.kind.write(value, design, f"{owner}.{self.name}" if owner else "")
        return None if self.may_go and repr(found) == repr(self.kind.write(self.default, design, "")) else found


def argument_kept(member: object, argument: str) -> Any:
    """Return the argument that a member was made with; DefinitionError where it does not keep it."""
    values = [getattr(member, name) for name in (argument, *KEPT_AS.get(argument, ())) if hasattr(member, name)]
    ensure(values, f"it has no attribute {argument}; let its class keep each argument in the attribute of that name.")
    return next((each for each in values if each is not None and not ismethod(each)), None)


def parameters_of(cls: type[Any]) -> list[Parameter]:
    """Return the parameters of a class's `__init__`."""
    return list(signature(cls.__init__).parameters.values())[1:]


def arguments_of(cls: type[Any]) -> tuple[Argument, ...]:
    """Return the arguments that a class takes by name, in order."""
    said = kinds_said(cls, amount)
    if issubclass(cls, Step):
        parents = [each.name for each in parameters_of(cls) if each.kind is Parameter.POSITIONAL_OR_KEYWORD]
        said = {own: said.get(letter, "point") for own, letter in zip(parents, cls.parent_letters, strict=False)} | said
    factories = {each.name: each.default_factory for each in fields(cls)} if is_dataclass(cls) else {}
    found = []
    for each in parameters_of(cls):
        is_spread = each.kind is Parameter.VAR_POSITIONAL and each.name in said
        if is_spread or each.kind in (Parameter.POSITIONAL_OR_KEYWORD, Parameter.KEYWORD_ONLY):
            factory = factories.get(each.name, MISSING)
            default = each.default if factory is MISSING else factory()
            is_nothing = isinstance(default, (int, float, str, tuple)) and (not default or (default == 1.0 and default is not True))
            may_go = is_nothing or (is_dataclass(cls) and default is not None and default is not Parameter.empty)
            found.append(Argument(each.name, each.name, kind_of(cls, each, said), default, may_go))
    return tuple(found)


def kind_of(cls: type[Any], parameter: Parameter, said: FileTable) -> Kind:
    """Return the kind of an argument: as the class says it, else by its annotation; else a quantity of a point, an option of a load."""
    kind, annotation = said.get(parameter.name), parameter.annotation
    if kind is None:
        kind = annotated_kind(annotation) or ("quantity" if issubclass(cls, Point) else "option")
    if kind == "quantity" and parameter.name.endswith("angle"):
        kind = "direction"
    match kind:
        case type():
            return Within.of(kind)
        case (part,):
            return list_of(part)
        case str():
            return KINDS[kind] if kind in KINDS or kind not in SI else fixed_number(kind)  # what a unit measures is a kind too, "mass"
        case Kind():
            return kind
    made: Kind = kind()  # a function that returns it, as what it loads is loaded with a file
    return made


# -- their table -------------------------------------------------------------------------------------------


def read_table(given: Mapping[Any, object], names: Names, arguments: Iterable[Argument], mistakes: Mistakes) -> Keywords:
    """Return the arguments of a table, by name; wrong or missing ones are noted under their keys."""
    found: Keywords = {}
    for each in arguments:
        if isinstance(each.kind, Within):
            found[each.name] = read_table(given, names, each.kind.arguments, mistakes)
        elif each.key in given:
            with mistakes.at_key(each.key):
                is_nothing = given[each.key] is None and each.default is None
                found[each.name] = None if is_nothing else each.kind.read(given[each.key], names)
        elif each.needed:
            mistakes.add((each.key,), "is missing.")
    return found


def check_keys(given: Iterable[Any], known: Iterable[str], mistakes: Mistakes) -> None:
    """Note the keys that are none."""
    for key in given:
        if key not in known:
            mistakes.add((str(key),), f"is not a key of it.{did_you_mean(key, [*known])}")


def made_of(found: FileTable, arguments: Iterable[Argument]) -> Keywords:
    """Return arguments as their class takes them, once all of them are sound."""
    return {each.name: each.kind.make(found[each.name]) for each in arguments if each.name in found}


def written_table(member: object, design: Design, arguments: Iterable[Argument], owner: str = "") -> Keywords:
    """Return the arguments of a member by their keys; those of a value within it come last."""
    found: Keywords = {}
    inner: Keywords = {}
    for each in arguments:
        written = each.written(member, design, owner)
        if isinstance(each.kind, Within):
            inner |= written or {}
        elif written is not None:
            found[each.key] = written
    return found | inner


@immutable
class Within(Kind):
    """The kind of an argument that is a value of a class: the arguments of that class stand among those of the member."""

    arguments: tuple[Argument, ...] = ()

    @classmethod
    def of(cls, part: type[Any]) -> Within:
        """Return the kind of a value of a class."""
        arguments = arguments_of(part)

        def write(value: object, design: Design, name: str) -> Keywords:
            if not isinstance(value, part):
                what = f"its {name.rpartition('.')[2]} is a Python function" if callable(value) else repr(value)
                raise DefinitionError(f"{what}, which a file cannot hold; write {part.__name__}(...), whose numbers may follow dimensions.")
            return written_table(value, design, arguments)

        return cls(lambda given, names: given, write, make=lambda found: part(**made_of(found, arguments)), arguments=arguments)


def list_of(part: type[Any]) -> Kind:
    """Return the kind of a list of values of a class: a table with the arguments of that class for each."""
    arguments = arguments_of(part)

    def read(given: object, names: Names) -> list[Keywords]:
        given = require_type("", given, (list, tuple), "is not a list [...]")
        ensure(len(given) <= VALUES, f"{len(given)} are too many; at most {VALUES} items are read.")

        found, mistakes = list[Keywords](), Mistakes()
        for place, each in enumerate(given):
            with mistakes.at_key(str(place)):
                ensure(isinstance(each, Mapping), "is not a table { key = value }.")
                inside = Mistakes()
                found.append(read_table(each, names, arguments, inside))
                check_keys(each, [argument.key for argument in arguments], inside)
                inside.check()
        mistakes.check()
        return found

    return Kind(
        read,
        lambda value, design, name: [written_table(each, design, arguments) for each in value],
        make=lambda tables: [part(**made_of(table, arguments)) for table in tables],
    )


# -- an entry ----------------------------------------------------------------------------------------------


def worded(cls: type[Any]) -> bool:
    """Return whether the members of a class share their section with those of others, told apart by a word."""
    return issubclass(cls, (Point, ForceElement))


class FileEntry:
    """How the members of a class stand in a file: the table of their section, and the `word` that tells them apart there, if any.

    `path` is the import path of a class without a word; `keys` are those that differ from the names of the arguments, `make`
    makes the member where it is not the class itself.
    """

    family = False
    """Whether members of subclasses are written in the same way."""

    def __init__(
        self, describes: type[Any], section: str, word: str = "", *, path: str = "", keys: Keys = NO_KEYS, make: Make | None = None
    ) -> None:
        self.describes, self.section, self.word, self.path, self.make = describes, section, word, path, make or describes
        given = [replace(each, key=keys.get(each.name, each.name)) for each in arguments_of(describes)]
        self.built_from = tuple(each for each in given if each.kind.refers and each.needed)
        first = ("near", "at", "side") if issubclass(describes, Step) else ()
        others = [each for each in given if each not in self.built_from]
        self.arguments = tuple(sorted(others, key=lambda each: first.index(each.name) if each.name in first else len(first)))
        kinds = {each.kind: each.name for each in parameters_of(describes)}
        self.has_labels, self.spread = Parameter.VAR_KEYWORD in kinds, kinds.get(Parameter.VAR_POSITIONAL, "")

    @property
    def keys(self) -> list[str]:
        """The keys that it may have, labels apart."""
        above = [self.word] if self.word else [PATH] * bool(self.path) + [each.key for each in self.built_from]
        inner = [part.key for each in self.arguments if isinstance(each.kind, Within) for part in each.kind.arguments]
        return [*above, *(each.key for each in self.arguments if not isinstance(each.kind, Within)), *inner]

    @property
    def example(self) -> str:
        """An entry as it may be written."""
        needed = "".join(f", {each.key} = ..." for each in self.arguments if each.needed and not isinstance(each.kind, Within))
        return f"`{self.word.lower()} = {{ {self.word} = {self._parents()}{needed} }}`"

    def _kind_words(self) -> list[str]:
        return [next(word for word, kind in KINDS.items() if kind is each.kind) for each in self.built_from]

    def _parents(self) -> str:
        """Return an example of the members that this one is built from, as it is written."""
        words = self._kind_words()
        names = [[*EXAMPLES.get(word, ()), *"PQRSTUVW"][words[:place].count(word)] for place, word in enumerate(words)]
        listed = ", ".join(f'"{each}"' for each in names)
        return listed if len(names) == 1 else f"[{listed}]"

    # -- reading ---------------------------------------------------------------------------------------

    def read(self, given: object, names: Names) -> Member:
        """Return the member of an entry; DefinitionError, with all mistakes by their keys, for a wrong entry."""
        given = require_type("", given, Mapping, f"is not a table {{ key = value }} with the keys {', '.join(self.keys)}")
        mistakes = Mistakes()
        unknown = [key for key in given if key not in self.keys] if self.has_labels else []  # labels: lengths and angles of points
        ensure(len(unknown) <= LABELS, f"{len(unknown)} labels are too many; up to {LABELS} are read.")
        taken = {"self", *(each.name for each in parameters_of(self.describes))}
        for key in unknown:
            if not (isinstance(key, str) and key.isidentifier() and len(key) <= 3 * NAME_LENGTH) or key in taken:
                raise DefinitionError(f"{cited(key)} is not a label; write the points' names joined, such as AB or BOC.")
        labels: Keywords = dict.fromkeys(unknown)
        parents: Iterable[Any] = ()
        if self.word:
            with mistakes.at_key(self.word):
                if len(self.built_from) == 1:
                    parents = self.built_from[0].kind.read(given[self.word], names)
                    parents = parents if self.built_from[0].name == self.spread else (parents,)
                else:
                    words, several = self._kind_words(), given[self.word]
                    what = f"two {words[0]}s" if words in (["point"] * 2, ["guide"] * 2) else " and ".join(f"a {word}" for word in words)
                    fits = is_listed(several) and len(several) == len(self.built_from)
                    what = f"is not {what}, such as {self._parents()}" if words else "is not []; it is built from no other member"
                    require(fits, "", several, what)
                    parents = [argument.kind.read(each, names) for argument, each in zip(self.built_from, several, strict=True)]
        else:
            under_keys = read_table(given, names, self.built_from, mistakes)
            parents = under_keys.pop(self.spread, under_keys.values())
        for spelling in labels:
            with mistakes.at_key(spelling):
                labels[spelling] = quantity_of(given[spelling], names)
        found = read_table(given, names, self.arguments, mistakes)
        check_keys(given, [*self.keys, *labels], mistakes)
        mistakes.check()
        options = made_of(found, self.arguments) | labels
        if not self.path:
            return self.make(*parents, **options)
        with errors_of(f"{self.describes.__name__}(...)"):
            return self.make(*parents, **options)

    # -- writing ---------------------------------------------------------------------------------------

    def write(self, member: Any, design: Design) -> Any:
        """Return a member as data of a file: numbers, texts, lists, tables of them; DefinitionError for other values."""
        values = member.parents if isinstance(member, Step) else [argument_kept(member, each.name) for each in self.built_from]
        parents = [each.kind.write(value, design, "") for each, value in zip(self.built_from, values, strict=True)]
        if self.word:
            found: Keywords = {self.word: parents[0] if len(parents) == 1 else parents}
        else:
            found = ({PATH: self.path} if self.path else {}) | dict(zip((each.key for each in self.built_from), parents, strict=True))
        labels = member.labels if self.has_labels else {}
        for spelling in labels:
            ensure(spelling not in self.keys, f"the label {spelling} is a word of the file; give one of its points another name.")
        found |= {spelling: design.label(spelling, value) for spelling, value in labels.items()}
        return found | written_table(member, design, self.arguments, member.name)
