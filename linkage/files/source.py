"""Sources: from a file or a text to plain tables, TOML by the standard library, JSON without its loopholes; and their mistakes."""

from __future__ import annotations

import csv
import json
import os
import re
import tomllib
from codecs import BOM_UTF16_BE, BOM_UTF16_LE
from collections import Counter
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from io import StringIO
from math import isfinite, nan
from operator import itemgetter
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn, TypeAlias
from unicodedata import normalize

from ..disk import read
from ..errors import DefinitionError, FileError, cited, ensure, is_listed, known_name, require, require_type, unknown
from ..frozen import record
from ..quantities import Member, Quantity, Ref, is_name
from ..units import UNITS, Amount, units_of

if TYPE_CHECKING:
    from ..mechanism import Mechanism

FileTable: TypeAlias = Mapping[str, Any]
"""A table of a file: what stands under its keys."""
Keywords: TypeAlias = dict[str, Any]
"""Keywords of a function, or what is written under the keys of a table, by name."""

NAME_LENGTH = 60
DEEPEST_NAME = 12
"""So many names stand in a dotted one at most: those of parts in parts, of a member, of its number."""


@record
class Names:
    """The members of a file by name: the section each stands in, and its kind (`point`, `quantity`, `guide`, ...)."""

    sections: Mapping[str, str]
    kinds: dict[str, str]
    built: dict[str, Member] = field(default_factory=dict)
    """The members that are read already."""
    machines: Mapping[str, type[Mechanism]] = field(default_factory=dict)
    """The machines that the file holds for its parts."""
    load_beside: Callable[[str], type[Mechanism]] | None = None
    """What loads the machine of another file in the same folder; None of what is written."""
    folder: Path | None = None
    """Where other files stand that it names; None of a text."""
    of_parts: list[str] = field(default_factory=list)
    """The strokes that parts bring, `lower.S`."""

    @property
    def strokes(self) -> list[str]:
        """The names of the machine's strokes, those of its parts included."""
        return [*(name for name, section in self.sections.items() if section == "strokes"), *self.of_parts]

    def quantity(self, name: str) -> Quantity:
        """Return the quantity of a name as a class has it: itself where it stands above, else by its name."""
        found = self.built.get(self.checked(name, "quantity"))
        return found if isinstance(found, Quantity) else Ref(name)

    def checked(self, name: object, kind: str) -> str:
        """Return a name that stands for a member of a kind; DefinitionError, with those there are, for any other."""
        name = require_type("", name, str, f"stands where the name of a {kind} is expected")
        owner, _, own = name.rpartition(".")
        if name not in self.kinds and kind in ("quantity", "link", "point") and self.kinds.get(owner) == "load" and own:
            return name  # what a load holds by a name of its own, such as the length of a cylinder or its barrel
        if name not in self.kinds:
            known = [each for each, its_kind in self.kinds.items() if its_kind == kind]
            raise unknown(kind.capitalize(), name, known)
        ensure(self.kinds[name] == kind, f"{name} of [{self.sections.get(name, 'parts')}] is not a {kind}.")
        return name


def by_whole_names(given: Mapping[str, object], words: Sequence[str] = (), depth: int = 1) -> Iterator[tuple[str, Any]]:
    """Yield the entries of a table by whole names: `lift.bore = 1`, which TOML keeps as a table in a table, as "lift.bore".

    A table with one of some `words` is a value.
    """
    for name, value in given.items():
        if isinstance(value, Mapping) and value and not set(value) & set(words) and depth < DEEPEST_NAME:
            yield from ((f"{name}.{inner}", each) for inner, each in by_whole_names(value, words, depth + 1))
        else:
            yield name, value


NO_NAME = "is not a name: letters, digits and _, no digit first, no word of Python"


def member_name(name: object) -> str:
    """Return a name that a class could bind; DefinitionError for any other."""
    if isinstance(name, str) and not is_name(name) and is_name(normalize("NFKC", name)):
        raise DefinitionError(f"{name!r} is spelled with look-alike letters; write {normalize('NFKC', name)!r}.")
    found = require_type("", name, str, NO_NAME)
    require(is_name(found), "", found, NO_NAME)
    if found.startswith("__") or len(found) > NAME_LENGTH:
        raise DefinitionError(f"{cited(found)} cannot be a name here: up to {NAME_LENGTH} characters, no double _ at the start.")
    return found


def listed(given: object) -> Sequence[Any]:
    """Return the items of a list, or anything but a list as the only one."""
    return given if is_listed(given) else [given]


Key = tuple[str, ...]

TEXT = "the text"
FILE_BYTES = 1_000_000
TOML_LINE = 5_000  # characters: a dotted key as long as a file takes the parser's memory by its square
FAULTS_SHOWN = 20


def source(path_or_text: str | os.PathLike[str]) -> Source:
    """Return the text of a file, or a text with several lines or a leading `{`. FileError for a file that cannot be read."""
    if not isinstance(path_or_text, (str, os.PathLike)):
        raise FileError(f"a path or a text is expected, not {type(path_or_text).__name__}.")
    if isinstance(path_or_text, str) and ("\n" in path_or_text or path_or_text.lstrip().startswith("{")):
        encoded = path_or_text.encode("utf-8", "surrogatepass")
        return decoded(TEXT, encoded, path_or_text.lstrip().startswith("{"))
    path = Path(path_or_text)
    if path.suffix not in (".toml", ".json"):
        raise FileError(f"{cited(os.fspath(path_or_text), quote=False)}: the name of a mechanism's file ends in .toml or .json.")
    return replace(decoded(path.name, read(path, FILE_BYTES + 1), path.suffix == ".json"), folder=path.parent)


def decoded(name: str, raw: bytes, is_json: bool) -> Source:
    """Return the tables in some bytes; FileError, with the line, for text that is neither TOML nor JSON."""
    if len(raw) > FILE_BYTES:
        raise FileError(f"{name}: the file is larger than {FILE_BYTES / 1e6:g} MB; a mechanism's file is a few kB.")
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = raw.count(b"\n", 0, error.start) + 1
        raise FileError(f"{name}, line {line}: the file is not UTF-8 text; save it in that encoding.") from None
    try:
        if is_json:
            return Source(name=name, data=json.loads(text, parse_constant=refused, object_pairs_hook=unique))
        for number, each in enumerate(text.split("\n"), 1):
            if len(each) > TOML_LINE:
                raise ValueError(f"the line has {len(each)} characters, up to {TOML_LINE} are read (at line {number}, column 1)")
        return Source(name=name, data=tomllib.loads(text), places=dict(reversed([*lines_of_keys(text)])))  # the first line of each
    except RecursionError:
        raise FileError(f"{name}: lists or tables are nested too deeply; a mechanism's file needs three levels.") from None
    except ValueError as error:
        raise FileError(located(name, str(error), text)) from None


def located(name: str, message: str, text: str) -> str:
    """Return a parser's message about a text with its line in front."""
    if message.startswith("Exceeds the limit"):
        longest = max(re.finditer(r"[\d_]+", text), key=lambda found: len(found[0]))
        message = f"a number has too many digits (at line {text.count(chr(10), 0, longest.start()) + 1}, column 1)"
    if message.endswith("(at end of document)"):
        message = message.replace("(at end of document)", f"at the end of the file (at line {text.rstrip().count(chr(10)) + 1}, column 1)")
    if message.endswith("is not a number"):
        bare = re.sub(r'"(?:\\.|[^"\\])*"', lambda found: re.sub(r"[^\n]", " ", found[0]), text)
        message += f" (at line {bare.count(chr(10), 0, max(bare.find(message.split()[0]), 0)) + 1}, column 1)"
    match = re.search(r"\s*\(?:?\s*\(?(?:at )?line (\d+)[,:]? column \d+(?: \(char \d+\))?\)?", message)
    if match is None:
        return f"{name}: {message}."
    keys = [found for found in lines_of_keys(text) if found[1] <= int(match.group(1))] or [((), 0)]
    path, line = keys.pop()
    first = next((at for each, at in keys if each[: len(path)] == path), 0)
    if first and message.startswith(("Cannot overwrite", "Cannot declare")):
        *table, key = path
        of = f" of [{'.'.join(table)}]" if table else ""
        return f"{name}, line {line}: {cited(key)}{of} stands twice, in line {first} first; give one of them another name, or take one out."
    return f"{name}, line {match.group(1)}: {(message[: match.start()] + message[match.end() :]).strip()}."


def refused(word: str) -> NoReturn:
    """Raise ValueError: it is no number of JSON."""
    raise ValueError(f"{word} is not a number")


def unique(pairs: list[tuple[str, object]]) -> Keywords:
    """Return a table; ValueError for a key that stands twice."""
    table = dict(pairs)
    if len(table) < len(pairs):
        [(key, _)] = Counter(key for key, _ in pairs).most_common(1)
        raise ValueError(f"the key {cited(key)} stands twice")
    return table


# -- the lines of a TOML file on which its keys stand ------------------------------------------------------

_PART = r"""[A-Za-z0-9_-]+|"[^"\n]*"|'[^'\n]*'"""
_PATH = re.compile(rf"\s*(\[)?\s*((?:{_PART})(?:\s*\.\s*(?:{_PART}))*)\s*(?(1)\]|=)")
_SPLIT = re.compile(_PART)
_LONG = re.compile(r'"""|' + r"'''")


def lines_of_keys(text: str) -> Iterator[tuple[Key, int]]:
    """Yield every table and key that stands at the start of a line, with the line; one that stands twice comes twice."""
    table: Key = ()
    inside = ""  # the mark of a text of several lines that goes on
    for number, line in enumerate(text.splitlines(), 1):
        match = None if inside else _PATH.match(line)
        if match is not None:
            path = tuple(part.strip("\"'") for part in _SPLIT.findall(match.group(2)))
            if match.group(1):
                table = path
            yield table if match.group(1) else (*table, *path), number
        for mark in _LONG.findall(line):
            inside = "" if inside == mark else inside or mark


# -- tables of rows ------------------------------------------------------------------------------------------

MOST_BYTES = 10_000_000
DELIMITERS = (";", "\t", ",")


def csv_rows(path: Path) -> Iterator[tuple[int, list[str]]]:
    """Yield the rows of a CSV file with their lines, as `text_rows` does those of its text."""
    try:
        raw = read(path, MOST_BYTES + 1)
    except FileError as error:
        raise DefinitionError(str(error)) from None
    ensure(len(raw) <= MOST_BYTES, f"{path.name} is larger than {MOST_BYTES // 1_000_000} MB; give fewer points.")
    yield from text_rows(path.name, text_of(raw))


def text_of(raw: bytes) -> str:
    """Return the text in some bytes: in UTF-16 where its mark begins them, else in UTF-8, else in the letters of Windows."""
    try:
        return raw.decode("utf-16" if raw[:2] in (BOM_UTF16_LE, BOM_UTF16_BE) else "utf-8-sig")
    except UnicodeDecodeError:
        return raw.decode("cp1252", "replace")


def delimiter_of(text: str) -> str:
    """Return the delimiter of a table's cells, by its first row, or as a first line "sep=;" says it."""
    first = next((line for line in text.splitlines() if line.strip() and not line.startswith("#")), "")
    said = re.fullmatch(r"sep=(.)\s*", first)
    unquoted = said[1] if said else re.sub(r'"[^"]*"', "", first)
    return next((each for each in DELIMITERS if each in unquoted), ",")


def text_rows(name: str, text: str) -> Iterator[tuple[int, list[str]]]:
    """Yield the rows of a table with their lines, without empty ones and those that begin with # or sep=; decimal commas as points.

    Empty cells beyond the first row's last are none; DefinitionError for others.
    """
    delimiter, width = delimiter_of(text), 0
    reader = csv.reader(StringIO(text.replace("\u2212", "-")), delimiter=delimiter, skipinitialspace=True)
    try:
        for row in reader:
            cells = [cell.strip() for cell in row]
            if not any(cells) or cells[0].startswith(("#", "sep=")):
                continue
            width = width or max(place for place, cell in enumerate(cells, 1) if cell)
            while len(cells) > width and not cells[-1]:
                cells.pop()
            many = f"{name}, line {reader.line_num}: {len(cells)} cells stand under {width} headings"
            ensure(len(cells) <= width, f"{many}; texts with a comma stand in quotes, and beside numbers as 1,5 a semicolon parts cells.")
            yield reader.line_num, [re.sub(r"^([-+]?\d*),(\d+)$", r"\1.\2", cell) for cell in cells] if delimiter != "," else cells
    except csv.Error as error:
        raise DefinitionError(f"{name}, line {reader.line_num}: it cannot be read as a table of rows: {error}.") from None


HEADING = re.compile(r"(?P<name>.+?)(?:(?P<mark>\s\(|\s*[\[,/])\s*(?P<unit>[^\[\](),]+?)\s*[\])]?)?")


def heading_read(heading: str) -> tuple[str, str]:
    """Return the name and the unit of a column's heading: `x(M) [mm]`, `M_x, mm`, `phi (deg)`, `x/mm`; "" where it says no unit."""
    text = heading.strip().lstrip("'")
    found = HEADING.fullmatch(text)
    if found is None or found["unit"] is None:
        return text, ""
    unit = {"°": "deg"}.get(found["unit"], found["unit"])
    is_said = found["mark"].strip() in ("[", ",") or unit in UNITS  # x(M) and a/b are names
    return (found["name"], unit) if is_said else (text, "")


def unit_factor(unit: str, measures: Collection[str], where: str) -> float:
    """Return the factor of a heading's unit to SI; DefinitionError for one that is unknown or measures something else ("": anything)."""
    known_name("Unit", unit, UNITS, where=where)
    fits = UNITS[unit][1] in measures or "" in measures
    ensure(fits, f"{where}: {unit} measures {UNITS[unit][1]}; use one of {', '.join(units_of(*measures))}.")
    return float(UNITS[unit][0])


def measured_columns(
    path: Path, what: str, measures_of: Callable[[str], Collection[str]], *, gaps: bool = False
) -> dict[str, list[Amount]]:
    """Return the columns of a table by name, whose headings are names with units, "boom.ram, m/s" or `R_y [mm]`.

    `measures_of` says what a column of a name may measure; one that may measure nothing is passed over. `what` begins what is refused.
    With `gaps` an empty cell is NaN. DefinitionError for a file that cannot be read, a name that stands twice, a unit that is missing or
    measures something else, and for anything but a number.
    """
    (_, headings), *rows = [*csv_rows(path)] or [(0, list[str]())]
    ensure(rows, f"{what}: a line of headings and at least one of numbers are expected.")
    found: dict[str, list[Amount]] = {}
    for place, heading in enumerate(headings):
        name, unit = heading_read(heading)
        measures = measures_of(name)
        if not measures:
            continue
        where = f"{what}: {heading}"
        wanted = "a heading with its unit is expected, in quotes where commas part the columns"
        ensure(unit, f'{where}: {wanted}: "{name}, {units_of(*measures)[0]}".')
        by = unit_factor(unit, measures, where)
        ensure(name not in found, f"{where}: {name} stands twice; keep one column.")
        found[name] = []
        for line, row in rows:
            text = row[place] if place < len(row) else ""
            ensure(is_numeral(text) or (gaps and not text), f"{where}: in line {line} {cited(text)} is no number.")
            found[name].append(Amount(float(text or nan) * by, UNITS[unit][1]))
    return found


def is_numeral(cell: str) -> bool:
    """Return whether a text is a finite number."""
    try:
        return isfinite(float(cell))
    except ValueError:
        return False


# -- what is wrong -----------------------------------------------------------------------------------------


class SeveralError(DefinitionError):
    """Several mistakes in one part of a file, each with its key inside that part."""

    def __init__(self, found: list[tuple[Key, str]]) -> None:
        super().__init__(" ".join(message for _, message in found))
        self.found = found


@dataclass
class Mistakes:
    """The mistakes of a part of a file that were found so far, each with its key inside it."""

    found: list[tuple[Key, str]] = field(default_factory=list)

    def add(self, key: Key, message: str) -> None:
        """Note a mistake."""
        self.found.append((key, message))

    @contextmanager
    def at_key(self, *key: str) -> Iterator[None]:
        """Note errors inside under a key, and continue behind."""
        try:
            yield
        except SeveralError as error:
            self.found += [((*key, *where), message) for where, message in error.found]
        except DefinitionError as error:
            self.add(key, str(error))

    def check(self) -> None:
        """Raise SeveralError where there are mistakes."""
        if self.found:
            raise SeveralError(self.found)


def each_of(given: Iterable[tuple[object, object]], read: Callable[[Any, Any], Any]) -> list[Any]:
    """Return the results of reading each key and value; SeveralError with all mistakes, each under its key."""
    found, mistakes = [], Mistakes()
    for key, value in given:
        with mistakes.at_key(str(key)):
            found.append(read(key, value))
    mistakes.check()
    return found


@dataclass
class Source(Mistakes):
    """A file as it is read: the name it is spoken of by, its tables, where its keys stand, and the mistakes in it."""

    name: str = TEXT
    data: Any = None
    places: Mapping[Key, int] = field(default_factory=dict)
    folder: Path | None = None
    """The folder of the file; None of a text."""

    def line_of(self, key: Key) -> int:
        """Return the line of a key, else the first one inside it, else that of the nearest table around it; 0 where none is known."""
        if key in self.places:
            return self.places[key]
        inside = [line for path, line in self.places.items() if key and path[: len(key)] == key]
        around = (self.places[key[:end]] for end in range(len(key), 0, -1) if key[:end] in self.places)
        return min(inside, default=next(around, 0))

    def check(self) -> None:
        """Raise FileError where there are mistakes."""
        if self.found:
            raise FileError(self.text())

    def text(self) -> str:
        """Return all mistakes, one a line."""
        lines = []
        for line, key, message in sorted(((self.line_of(key), key, message) for key, message in self.found), key=itemgetter(0)):
            parts = [part if len(part) <= NAME_LENGTH and (part.isidentifier() or part.isdecimal()) else cited(part) for part in key]
            places = [*([f"line {line}"] if line else []), *([".".join(parts)] if parts else [])]
            lines.append(f"{', '.join(places)}: {message}" if places else message)
        if len(lines) == 1:
            return f"{self.name}: {lines[0]}"
        rest = len(lines) - FAULTS_SHOWN
        more = [f"and {rest} more"] if rest > 0 else []
        return "\n  ".join([f"{self.name}: {len(lines)} mistakes:", *lines[:FAULTS_SHOWN], *more])
