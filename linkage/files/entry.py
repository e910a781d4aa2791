"""An entry of a file: how a member is read from it and written into it, as the signature of its class says.

Where a section holds several classes, the class's name is the key of what the member is built from, its other arguments stand under
their own names: `B = { Dyad = ["A", "O"], AB = "L0 + S", side = "RIGHT" }`. A class that is named by its import path has all arguments
under their names: `P = { kind = "mypackage.cams:CamFollower", O = "A", lift = "phi" }`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import MISSING, dataclass, fields, is_dataclass, replace
from inspect import Parameter, ismethod, signature
from typing import Any, TypeAlias

from ..errors import DefinitionError, cited, did_you_mean, ensure, errors_of, is_listed, require, require_type
from ..frozen import FrozenDict, immutable
from ..loads import ForceElement
from ..quantities import Member
from ..quantities.member import KEPT_AS, annotated_kind, kinds_said
from ..steps import Point, Step
from ..units import SI
from .design import Design
from .source import NAME_LENGTH, FileTable, Keywords, Mistakes, Names
from .validators import KINDS, Kind, amount, fixed_number, quantity_of

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


@dataclass(frozen=True)
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
        for label in labels:
            with mistakes.at_key(label):
                labels[label] = quantity_of(given[label], names)
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
        for label in labels:
            ensure(label not in self.keys, f"the label {label} is a word of the file; give one of its points another name.")
        found |= {label: design.label(label, value) for label, value in labels.items()}
        return found | written_table(member, design, self.arguments, member.name)
