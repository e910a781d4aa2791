"""What an expression may call, and nothing else: each function with the kinds of its arguments."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import isfinite
from types import MappingProxyType
from typing import Any

import numpy as np

from ..errors import DefinitionError
from ..quantities import Function, Length, Member, Number, Quantity, angle, distance, x, y
from ..quantities.quantity import FUNCTIONS
from ..steps import Arrow, CosineAngle, Turn, Vector


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
            return number(float(FUNCTIONS[function](*values)), f"{function}({', '.join(map(repr, values))})")

    return make


def number(value: Any, text: str) -> Number:
    """Return a number; DefinitionError where a calculation has no finite one."""
    if not isinstance(value, (int, float)) or not isfinite(value):
        raise DefinitionError(f"{text} has no finite value.")
    return Number(float(value))


def absolute(argument: Arrow | str | Quantity) -> Quantity:
    """Return the length of a vector or of the one with that name, the absolute value of a quantity."""
    return applied("absolute")(argument) if isinstance(argument, Quantity) else Length(argument)


PAIR = ("point", "point")
ONE, TWO = ("quantity",), ("quantity", "quantity")

CALLS: Mapping[str, Call] = MappingProxyType(
    {"angle": Call(PAIR, angle), "distance": Call(PAIR, distance), "x": Call(("point",), x), "y": Call(("point",), y)}
    | {"CosineAngle": Call(("quantity",) * 3, CosineAngle), "abs": Call(("any",), absolute), "absolute": Call(("any",), absolute)}
    | {"Vector": Call(PAIR, Vector), "Turn": Call(("vector", "quantity"), Turn, ("length",))}
    | {name: Call(ONE, applied(name)) for name in ("sqrt", "sin", "cos", "tan", "exp", "log")}
    | {name: Call(TWO, applied(name)) for name in ("arctan2", "minimum", "maximum")}
    | {"atan2": Call(TWO, applied("arctan2")), "min": Call(TWO, applied("minimum")), "max": Call(TWO, applied("maximum"))}
)
