"""The arithmetic of a file: text to quantities, by a grammar that knows nothing but these words.

    sum     = product {("+" | "-") product}
    product = signed {("*" | "/") signed}
    signed  = ("-" | "+") signed | power
    power   = atom ["**" signed]
    atom    = number [unit] | name | function "(" arguments ")" | "(" sum ")"
"""

from __future__ import annotations

import math
import operator
import re
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from types import MappingProxyType
from typing import Any, ClassVar, final

import numpy as np

from ..errors import DefinitionError, unknown
from ..quantities import Function, Length, Member, Number, Quantity, angle, distance, x, y
from ..quantities.quantity import FUNCTIONS
from ..steps import Arrow, CosineAngle, Turn, Vector
from ..units import DIGITS, UNITS, parse
from .names import Names

EXPRESSION_LENGTH = 1_000
OPERATIONS = 100
NESTING = 40
GRAMMAR = "an expression is made of numbers with units, names, + - * / **, brackets and functions such as angle(P, Q)"

# -- words -------------------------------------------------------------------------------------------------

OWN_WORDS = r"(?P<name>[^\W\d]\w*(?:\.[^\W\d]\w*)*)|(?P<sign>\*\*|[-+*/(),=])"


@lru_cache(maxsize=16)
def words_with_numbers(others: str, units: tuple[str, ...]) -> re.Pattern[str]:
    """Return the pattern of one word: a number with a unit, what else a grammar knows, or the end."""
    unit = "|".join(re.escape(name) for name in sorted(units, key=len, reverse=True))
    number = rf"(?P<number>{DIGITS}(?:[ \t]*(?P<unit>{unit})(?!\w))?)"
    return re.compile(rf"\s*(?:{number}|{others}|(?P<end>\Z))")


@final
@dataclass(frozen=True, slots=True)
class Token:
    """A word of an expression: its kind (`number`, `name`, `sign`, `end`), its text, and a number's value [SI] and unit."""

    kind: str
    text: str
    value: float = 0.0
    unit: str = ""


def tokens(text: str, others: str = OWN_WORDS, grammar: str = GRAMMAR) -> list[Token]:
    """Return an expression's words, the last one of kind `end`; DefinitionError for anything else."""
    if len(text) > EXPRESSION_LENGTH:
        raise DefinitionError(f"the expression has {len(text)} characters; up to {EXPRESSION_LENGTH} are read. Give a part of it a name.")
    found: list[Token] = []
    pattern, place = words_with_numbers(others, tuple(UNITS)), 0
    while not found or found[-1].kind != "end":
        match = pattern.match(text, place)
        if match is None:
            raise DefinitionError(f"{text!r} cannot be read from {text[place:].strip()[:12]!r} on; {grammar}.")
        kind = str(match.lastgroup)
        word = match.group(kind)
        found.append(Token(kind, word, parse(word), match.group("unit") or "") if kind == "number" else Token(kind, word))
        place = match.end()
    if len(found) > 6 * OPERATIONS:
        raise DefinitionError(f"the expression has {len(found)} words; up to {6 * OPERATIONS} are read. Give a part of it a name.")
    return found


def one_unit(text: str) -> str:
    """Return the unit of a text that is one number with a unit, its sign apart; "" for any other. DefinitionError if it cannot be read."""
    values = [word for word in tokens(text) if word.kind in ("number", "name")]
    return values[0].unit if len(values) == 1 else ""


# -- what an expression may call, and nothing else ----------------------------------------------------------


@final
@dataclass(frozen=True)
class Call:
    """A function of the class form: the kinds of its arguments, and what it makes of them."""

    kinds: tuple[str, ...]
    make: Callable[..., Member]
    keywords: tuple[str, ...] = ()

    @property
    def makes_vector(self) -> bool:
        """Whether it makes a vector, not a quantity."""
        return self.make in (Vector, Turn)


def applied(function: str) -> Callable[..., Quantity]:
    """Return NumPy's function of quantities; of numbers alone it is a number, as it is in a class."""

    def make(*arguments: Quantity) -> Quantity:
        values = [each.number for each in arguments if isinstance(each, Number)]
        if len(values) < len(arguments):
            return Function(function, *arguments)
        with np.errstate(all="ignore"):
            return finite_number(float(FUNCTIONS[function](*values)), f"{function}({', '.join(map(repr, values))})")

    return make


def finite_number(value: object, text: str) -> Number:
    """Return a number; DefinitionError where a calculation has no finite one."""
    if not isinstance(value, (int, float)) or not math.isfinite(value):
        raise DefinitionError(f"{text} has no finite value.")
    return Number(float(value))


def length_or_size(argument: Arrow | str | Quantity) -> Quantity:
    """Return the length of a vector or of the one with that name, the absolute value of a quantity."""
    return applied("absolute")(argument) if isinstance(argument, Quantity) else Length(argument)


PAIR = ("point", "point")
ONE, TWO = ("quantity",), ("quantity", "quantity")

CALLS: Mapping[str, Call] = MappingProxyType(
    {"angle": Call(PAIR, angle), "distance": Call(PAIR, distance), "x": Call(("point",), x), "y": Call(("point",), y)}
    | {"CosineAngle": Call(("quantity",) * 3, CosineAngle)}
    | dict.fromkeys(("abs", "absolute"), Call(("any",), length_or_size))
    | {"Vector": Call(PAIR, Vector), "Turn": Call(("vector", "quantity"), Turn, ("length",))}
    | {name: Call(ONE, applied(name)) for name in ("sqrt", "sin", "cos", "tan", "exp", "log")}
    | {name: Call(TWO, applied(name)) for name in ("arctan2", "minimum", "maximum")}
    | {"atan2": Call(TWO, applied("arctan2")), "min": Call(TWO, applied("minimum")), "max": Call(TWO, applied("maximum"))}
)

# -- reading -----------------------------------------------------------------------------------------------

BINARY: dict[str, Callable[[Any, Any], Any]] = {
    "+": operator.add, "-": operator.sub, "*": operator.mul, "/": operator.truediv, "**": operator.pow,
}  # fmt: skip


def constant(name: str) -> float | None:
    """Return what a name that stands for a number is: "pi", or a unit, `2 * mm`; None for any other."""
    return math.pi if name == "pi" else UNITS[name][0] if name in UNITS else None


def expression(text: str, names: Names) -> Quantity:
    """Return the quantity that a text says; DefinitionError where it says none.

    What holds no name is calculated at once, as Python does it in a class: `"2 * 0.3"` is the number 0.6.
    """
    found: Quantity = Parser(text, names).whole("quantity")
    return found


def arrow_in(text: str, names: Names) -> Arrow | str:
    """Return the vector that a text says, or the name of one; DefinitionError where it says none."""
    found: Arrow | str = Parser(text, names).whole("vector")
    return found


class Grammar(ABC):
    """Reads one expression from left to right: sums, products, powers and brackets. A subclass says what its atoms are."""

    grammar: ClassVar[str] = GRAMMAR

    def __init__(self, text: str, words: list[Token]) -> None:
        self.text, self.tokens = text, words
        self.place = self.depth = self.operations = 0

    @abstractmethod
    def atom(self) -> Any:
        """Return a number, what a name stands for, or what a function makes."""

    @abstractmethod
    def joined(self, sign: str, a: Any, b: Any) -> Any:
        """Return two parts joined; of numbers alone it is a number."""

    def negative(self, part: Any) -> Any:
        """Return a part with the other sign."""
        return -part

    # -- words -----------------------------------------------------------------------------------------

    @property
    def next(self) -> Token:
        """The word that comes next."""
        return self.tokens[self.place]

    def take(self, *signs: str) -> str:
        """Return the next word if it is one of the signs, and go on; else ""."""
        if self.next.kind != "sign" or self.next.text not in signs:
            return ""
        self.place += 1
        return self.tokens[self.place - 1].text

    def want(self, sign: str) -> None:
        """Go on behind a sign; DefinitionError where it is missing."""
        if not self.take(sign):
            raise self.fault(repr(sign))

    def fault(self, wanted: str) -> DefinitionError:
        """Return the error for a word that does not fit."""
        found = repr(self.next.text) if self.next.text else "its end"
        return DefinitionError(f"{self.text!r}: {wanted} is expected where {found} stands; {self.grammar}.")

    def deeper(self, step: int) -> None:
        """Count brackets and operations; DefinitionError for too many."""
        self.depth += step
        self.operations += step > 0
        if self.depth > NESTING or self.operations > OPERATIONS:
            raise DefinitionError(
                f"{self.text[:40]!r}... is more than {NESTING} brackets deep or longer than {OPERATIONS} operations; give a part a name."
            )

    # -- the grammar -----------------------------------------------------------------------------------

    def sum(self) -> Any:
        """Return a sum."""
        return self.chain(self.product, "+", "-")

    def product(self) -> Any:
        """Return a product or a quotient."""
        return self.chain(self.signed, "*", "/")

    def chain(self, part: Callable[[], Any], *signs: str) -> Any:
        """Return parts joined by signs, from left to right."""
        found = part()
        while sign := self.take(*signs):
            self.deeper(+1)
            found = self.joined(sign, found, part())
            self.depth -= 1
        return found

    def signed(self) -> Any:
        """Return a power with its sign; of a number it is a number."""
        sign = self.take("-", "+")
        if not sign:
            return self.power()
        self.deeper(+1)
        found = self.signed()
        self.depth -= 1
        return found if sign == "+" else self.negative(found)

    def power(self) -> Any:
        """Return an atom or what stands in brackets, or a power of it."""
        base = self.bracket() if self.next.kind == "sign" and self.next.text == "(" else self.atom()
        if not self.take("**"):
            return base
        self.deeper(+1)
        found = self.joined("**", base, self.signed())
        self.depth -= 1
        return found

    def bracket(self) -> Any:
        """Return what stands in brackets."""
        self.want("(")
        self.deeper(+1)
        found = self.sum()
        self.depth -= 1
        self.want(")")
        return found


@final
class Parser(Grammar):
    """Reads one expression of a file."""

    def __init__(self, text: str, names: Names) -> None:
        super().__init__(text, tokens(text))
        self.names = names

    def whole(self, kind: str) -> Any:
        """Return what the whole text says, of a kind."""
        found = self.argument(kind)
        if self.next.kind != "end":
            raise self.fault("an operator or the end")
        return found

    def negative(self, part: Quantity) -> Quantity:
        return Number(-part.number) if isinstance(part, Number) else -part

    def joined(self, sign: str, a: Quantity, b: Quantity) -> Quantity:
        if not (isinstance(a, Number) and isinstance(b, Number)):
            made: Quantity = BINARY[sign](a, b)
            return made
        text = f"{a.number!r} {sign} {b.number!r}"
        try:
            return finite_number(BINARY[sign](a.number, b.number), text)
        except ArithmeticError:
            raise DefinitionError(f"{text} has no finite value.") from None

    def atom(self) -> Quantity:
        token = self.next
        if token.kind not in ("number", "name"):
            raise self.fault("a number, a name or a bracket")
        self.place += 1
        if token.kind == "number":
            return Number(token.value)
        if self.next.text == "(":
            made = self.called(token.text, "quantity")
            assert isinstance(made, Quantity)
            return made
        if token.text not in self.names.kinds and (value := constant(token.text)) is not None:
            return Number(value)
        return self.names.quantity(self.checked(token.text, "quantity"))

    # -- functions -------------------------------------------------------------------------------------

    def called(self, name: str, kind: str) -> Member:
        """Return what a function makes of its arguments; it must be of a kind."""
        if name not in CALLS:
            raise DefinitionError(f"{self.text!r}: {unknown('Function', name, CALLS)}")
        call = CALLS[name]
        if call.makes_vector != (kind == "vector"):
            raise DefinitionError(f"{self.text!r}: {name}(...) is not a {kind}.")
        self.want("(")
        self.deeper(+1)
        found = call.make(*self.arguments(call), **self.keywords(call))
        self.depth -= 1
        self.want(")")
        return found

    def arguments(self, call: Call) -> list[Any]:
        """Return a function's arguments, each of its kind."""
        found = []
        for place, kind in enumerate(call.kinds):
            if place:
                self.want(",")
            found.append(self.argument(kind))
        return found

    def keywords(self, call: Call) -> dict[str, Any]:
        """Return the arguments that are given by name."""
        found: dict[str, Any] = {}
        while call.keywords and self.take(","):
            name = self.next.text
            if name not in call.keywords or name in found:
                raise self.fault(" or ".join(f"{each}=" for each in call.keywords))
            self.place += 1
            self.want("=")
            found[name] = self.sum()
        return found

    def argument(self, kind: str) -> Any:
        """Return one argument: a point's name, a vector or its name, or a quantity."""
        name, follows = self.next.text, self.tokens[min(self.place + 1, len(self.tokens) - 1)].text
        is_name = self.next.kind == "name"
        called_vector = is_name and follows == "(" and name in CALLS and CALLS[name].makes_vector
        if kind == "any":
            is_vector = called_vector or (is_name and follows != "(" and self.names.kinds.get(name) == "vector")
            kind = "vector" if is_vector else "quantity"
        if kind == "quantity":
            return self.sum()
        if not is_name:
            raise self.fault(f"the name of a {kind}")
        self.place += 1
        return self.called(name, kind) if kind == "vector" and follows == "(" else self.checked(name, kind)

    def checked(self, name: str, kind: str) -> str:
        """Return a name of a kind; DefinitionError, with the expression, for any other."""
        try:
            return self.names.checked(name, kind)
        except DefinitionError as error:
            raise DefinitionError(f"{self.text!r}: {error}") from None
