"""What is wrong with a file: every mistake with its key and its line, in one error."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

from pydantic import ValidationError

from ..errors import DefinitionError, FileError
from .limits import FAULTS_SHOWN, NAME_LENGTH
from .names import shortened

Key = tuple[str, ...]

WORDS = {
    "missing": "is missing.", "extra_forbidden": "is not a key of it.", "tuple_type": "is not a list [...].",
    "dict_type": "is not a table { key = value }.", "model_type": "is not a table { key = value }.",
}  # fmt: skip
HIDDEN = ("labels", "bare")


@dataclass
class Faults:
    """The mistakes found so far. `source` is the file's name, `line_of` tells the line of a key, 0 where it is not known."""

    source: str
    line_of: Callable[[Key], int]
    found: list[tuple[Key, str]] = field(default_factory=list)

    def add(self, key: Key, message: str) -> None:
        """Note a mistake."""
        self.found.append((key, message))

    @contextmanager
    def at(self, *key: str) -> Iterator[None]:
        """Note what goes wrong inside under a key, and go on behind."""
        try:
            yield
        except ValidationError as error:
            self.found += [((*key, *where), message) for where, message in described(error)]
        except DefinitionError as error:
            self.add(key, str(error))

    def check(self) -> None:
        """Raise FileError where there are mistakes."""
        if self.found:
            raise FileError(self.text())

    def text(self) -> str:
        """Return all mistakes, one a line."""
        lines = [self.line(key, message) for key, message in sorted(self.found, key=lambda fault: self.line_of(fault[0]))]
        if len(lines) == 1:
            return f"{self.source}: {lines[0]}"
        rest = len(lines) - FAULTS_SHOWN
        more = [f"and {rest} more"] if rest > 0 else []
        return "\n  ".join([f"{self.source}: {len(lines)} mistakes:", *lines[:FAULTS_SHOWN], *more])

    def line(self, key: Key, message: str) -> str:
        """Return one mistake with its place."""
        line = self.line_of(key)
        places = [*([f"line {line}"] if line else []), *([".".join(shown(each) for each in key)] if key else [])]
        return f"{', '.join(places)}: {message}" if places else message


def described(error: ValidationError) -> Iterator[tuple[Key, str]]:
    """Yield pydantic's findings: where, and what in words."""
    for each in error.errors(include_url=False, include_input=False):
        where = tuple(str(part) for part in each["loc"] if part not in HIDDEN)
        context: Mapping[str, Any] = each.get("ctx", {})
        yield where, str(context["error"]) if "error" in context else WORDS.get(each["type"], f"{each['msg']}.")


def shown(part: str) -> str:
    """Return a part of a key for a message."""
    return part if len(part) <= NAME_LENGTH and (part.isidentifier() or part.isdecimal()) else shortened(part)
