"""An expression cut into words: numbers with their units, names, signs."""

from __future__ import annotations

import re
from dataclasses import dataclass

from ..errors import DefinitionError
from ..units import UNITS, parse
from .limits import EXPRESSION_LENGTH, OPERATIONS

_UNIT = "|".join(re.escape(name) for name in sorted(UNITS, key=len, reverse=True))
_TOKEN = re.compile(
    rf"\s*(?:(?P<number>(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?(?:[ \t]*(?P<unit>{_UNIT})(?!\w))?)"
    r"|(?P<name>[^\W\d]\w*)|(?P<sign>\*\*|[-+*/(),=])|(?P<end>\Z))"
)


@dataclass(frozen=True, slots=True)
class Token:
    """A word of an expression: its kind (`number`, `name`, `sign`, `end`), its text, and a number's value [SI] and unit."""

    kind: str
    text: str
    value: float = 0.0
    unit: str = ""


def tokens(text: str) -> list[Token]:
    """Return an expression's words, the last one of kind `end`; DefinitionError for what is none."""
    if len(text) > EXPRESSION_LENGTH:
        raise DefinitionError(f"the expression has {len(text)} characters; up to {EXPRESSION_LENGTH} are read. Give a part of it a name.")
    found: list[Token] = []
    place = 0
    while not found or found[-1].kind != "end":
        match = _TOKEN.match(text, place)
        if match is None:
            raise DefinitionError(f"{text!r} cannot be read from {text[place:].strip()[:12]!r} on; {GRAMMAR}.")
        kind = str(match.lastgroup)
        word = match.group(kind)
        found.append(Token(kind, word, parse(word), match.group("unit") or "") if kind == "number" else Token(kind, word))
        place = match.end()
    if len(found) > 6 * OPERATIONS:
        raise DefinitionError(f"the expression has {len(found)} words; up to {6 * OPERATIONS} are read. Give a part of it a name.")
    return found


def one_unit(text: str) -> str:
    """Return the unit of a text that is one number with a unit, its sign apart; "" for any other. DefinitionError for no expression."""
    values = [word for word in tokens(text) if word.kind in ("number", "name")]
    return values[0].unit if len(values) == 1 else ""


GRAMMAR = "an expression is made of numbers with units, names, + - * / **, brackets and functions such as angle(P, Q)"
