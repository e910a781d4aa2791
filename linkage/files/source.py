"""From a file or a text to plain tables: TOML by the standard library, JSON without its loopholes."""

from __future__ import annotations

import json
import os
import re
import tomllib
from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..disk import read
from ..errors import FileError
from .limits import FILE_BYTES, TOML_LINE
from .lines import line_of, lines
from .names import shortened

TEXT = "the text"


@dataclass(frozen=True)
class Source:
    """A file's tables, the name it is spoken of by, and where its keys stand."""

    name: str
    data: Any
    places: Mapping[tuple[str, ...], int]

    def line_of(self, key: tuple[str, ...]) -> int:
        """Return the line of a key, 0 where it is not known."""
        return line_of(self.places, key)


def source(path_or_text: str | os.PathLike[str]) -> Source:
    """Return what a file holds, or a text: one that has several lines or begins with `{`. FileError for what cannot be read."""
    if not isinstance(path_or_text, (str, os.PathLike)):
        raise FileError(f"a path or a text is expected, not {type(path_or_text).__name__}.")
    if isinstance(path_or_text, str) and ("\n" in path_or_text or path_or_text.lstrip().startswith("{")):
        encoded = path_or_text.encode("utf-8", "surrogatepass")
        return decoded(TEXT, encoded, path_or_text.lstrip().startswith("{"))
    path = Path(path_or_text)
    if path.suffix not in (".toml", ".json"):
        raise FileError(f"{shortened(os.fspath(path_or_text), quote=False)}: the name of a mechanism's file ends in .toml or .json.")
    return decoded(path.name, read(path, FILE_BYTES + 1), path.suffix == ".json")


def decoded(name: str, raw: bytes, is_json: bool) -> Source:
    """Return the tables that some bytes say; FileError, with the line, for what is neither TOML nor JSON."""
    if len(raw) > FILE_BYTES:
        raise FileError(f"{name}: the file is larger than {FILE_BYTES / 1e6:g} MB; a mechanism's file is a few kB.")
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = raw.count(b"\n", 0, error.start) + 1
        raise FileError(f"{name}, line {line}: the file is not UTF-8 text; save it in that encoding.") from None
    parse: Callable[[str], Any] = from_json if is_json else from_toml
    try:
        return Source(name, parse(text), {} if is_json else lines(text))
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
    return f"{name}, line {match.group(1)}: {(message[: match.start()] + message[match.end() :]).strip()}."


def from_toml(text: str) -> Any:
    """Return what a TOML text says; ValueError for lines that are too long."""
    for number, line in enumerate(text.split("\n"), 1):
        if len(line) > TOML_LINE:
            raise ValueError(f"the line has {len(line)} characters, up to {TOML_LINE} are read (at line {number}, column 1)")
    return tomllib.loads(text)


def from_json(text: str) -> Any:
    """Return what a JSON text says; ValueError for NaN, infinities and keys that stand twice."""
    return json.loads(text, parse_constant=refused, object_pairs_hook=unique)


def refused(word: str) -> Any:
    """Raise ValueError: it is no number of JSON."""
    raise ValueError(f"{word} is not a number")


def unique(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """Return a table; ValueError for a key that stands twice."""
    table = dict(pairs)
    if len(table) < len(pairs):
        [(key, _)] = Counter(key for key, _ in pairs).most_common(1)
        raise ValueError(f"the key {shortened(key)} stands twice")
    return table
