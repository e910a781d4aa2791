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
from collections.abc import Callable
from typing import Any

from ..errors import DefinitionError, unknown
from ..quantities import Member, Number, Quantity
from ..steps import Arrow
from ..units import UNITS
from .functions import CALLS, Call, number
from .limits import NESTING, OPERATIONS
from .names import Names
from .tokens import GRAMMAR, Token, tokens

CONSTANTS = {"pi": math.pi} | {name: factor for name, (factor, _) in UNITS.items()}
BINARY: dict[str, Callable[[Any, Any], Any]] = {
    "+": operator.add, "-": operator.sub, "*": operator.mul, "/": operator.truediv, "**": operator.pow,
}  # fmt: skip


def expression(text: str, names: Names) -> Quantity:
    """Return the quantity that a text says; DefinitionError where it says none.

    What holds no name is calculated at once, as Python does it in a class: `"2 * 0.3"` is the number 0.6.
    """
    found: Quantity = Parser(text, names).whole("quantity")
    return found


def arrow(text: str, names: Names) -> Arrow | str:
    """Return the vector that a text says, or the name of one; DefinitionError where it says none."""
    found: Arrow | str = Parser(text, names).whole("vector")
    return found


class Parser:
    """Reads one expression from left to right."""

    def __init__(self, text: str, names: Names) -> None:
        self.text, self.names = text, names
        self.tokens = tokens(text)
        self.place = self.depth = self.operations = 0

    def whole(self, kind: str) -> Any:
        """Return what the whole text says, of a kind."""
        found = self.argument(kind)
        if self.next.kind != "end":
            raise self.fault("an operator or the end")
        return found

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
        return DefinitionError(f"{self.text!r}: {wanted} is expected where {found} stands; {GRAMMAR}.")

    def deeper(self, step: int) -> None:
        """Count brackets and operations; DefinitionError for too many."""
        self.depth += step
        self.operations += step > 0
        if self.depth > NESTING or self.operations > OPERATIONS:
            raise DefinitionError(
                f"{self.text[:40]!r}... is more than {NESTING} brackets deep or longer than {OPERATIONS} operations; give a part a name."
            )

    # -- the grammar -----------------------------------------------------------------------------------

    def sum(self) -> Quantity:
        """Return a sum."""
        return self.chain(self.product, "+", "-")

    def product(self) -> Quantity:
        """Return a product or a quotient."""
        return self.chain(self.signed, "*", "/")

    def chain(self, part: Callable[[], Quantity], *signs: str) -> Quantity:
        """Return parts joined by signs, from left to right."""
        found = part()
        while sign := self.take(*signs):
            self.deeper(+1)
            found = self.joined(sign, found, part())
            self.depth -= 1
        return found

    def signed(self) -> Quantity:
        """Return a power with its sign; of a number it is a number."""
        sign = self.take("-", "+")
        if not sign:
            return self.power()
        self.deeper(+1)
        found = self.signed()
        self.depth -= 1
        if sign == "+":
            return found
        return Number(-found.number) if isinstance(found, Number) else -found

    def power(self) -> Quantity:
        """Return an atom, or a power of one."""
        base = self.atom()
        if not self.take("**"):
            return base
        self.deeper(+1)
        found = self.joined("**", base, self.signed())
        self.depth -= 1
        return found

    def joined(self, sign: str, a: Quantity, b: Quantity) -> Quantity:
        """Return two parts joined; of numbers alone it is a number."""
        if not (isinstance(a, Number) and isinstance(b, Number)):
            made: Quantity = BINARY[sign](a, b)
            return made
        text = f"{a.number!r} {sign} {b.number!r}"
        try:
            return number(BINARY[sign](a.number, b.number), text)
        except ArithmeticError:
            raise DefinitionError(f"{text} has no finite value.") from None

    def atom(self) -> Quantity:
        """Return a number, a name's quantity, what a function makes, or what stands in brackets."""
        token = self.next
        if self.take("("):
            self.deeper(+1)
            found = self.sum()
            self.depth -= 1
            self.want(")")
            return found
        if token.kind not in ("number", "name"):
            raise self.fault("a number, a name or a bracket")
        self.place += 1
        if token.kind == "number":
            return Number(token.value)
        if self.next.text == "(":
            made = self.called(token.text, "quantity")
            assert isinstance(made, Quantity)
            return made
        if token.text not in self.names.kinds and token.text in CONSTANTS:
            return Number(CONSTANTS[token.text])
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
