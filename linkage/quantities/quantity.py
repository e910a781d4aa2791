"""Scalars of a mechanism: numbers, names, and sums, products and functions of them.

Each says its rule once, in plain arithmetic; a reading (arrays, traced nodes) supplies the values.
"""

from __future__ import annotations

import operator
from abc import abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np

from ..errors import DefinitionError
from ..vectors import Scalar
from .member import Member, Reference
from .numbers import is_number
from .where import Turning, Where


class Quantity(Member):
    """A scalar member or a part of one. Adds, multiplies and takes NumPy's functions."""

    kind = "quantity"

    @property
    def measures(self) -> str:
        """What it measures where that is plain from its rule: `angle`, `length`, or "" for a plain number."""
        return ""

    @abstractmethod
    def rule(self, where: Where) -> Scalar:
        """Return the value [SI] in a reading."""

    def turning(self, where: Where) -> Turning:
        """Return the cosine and sine of this angle; without trigonometry where a square root will do."""
        value = where.value(self)
        return np.cos(value), np.sin(value)

    @property
    def is_constant(self) -> bool:
        """Whether this is a plain number."""
        return False

    def __add__(self, other: Operand) -> Quantity:
        return Sum(self, quantity(other))

    def __radd__(self, other: Operand) -> Quantity:
        return Sum(quantity(other), self)

    def __sub__(self, other: Operand) -> Quantity:
        return Sum(self, Negative(quantity(other)))

    def __rsub__(self, other: Operand) -> Quantity:
        return Sum(quantity(other), Negative(self))

    def __mul__(self, other: Operand) -> Quantity:
        return Operation("*", self, quantity(other))

    def __rmul__(self, other: Operand) -> Quantity:
        return Operation("*", quantity(other), self)

    def __truediv__(self, other: Operand) -> Quantity:
        return Operation("/", self, quantity(other))

    def __rtruediv__(self, other: Operand) -> Quantity:
        return Operation("/", quantity(other), self)

    def __pow__(self, other: Operand) -> Quantity:
        return Operation("**", self, quantity(other))

    def __rpow__(self, other: Operand) -> Quantity:
        return Operation("**", quantity(other), self)

    def __neg__(self) -> Quantity:
        return Negative(self)

    def __pos__(self) -> Quantity:
        return self

    def __abs__(self) -> Quantity:
        return Function("absolute", self)

    # NumPy's numbers and functions meet a quantity here: np.sqrt(L), np.float64(2) * L

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **options: Any) -> Quantity:
        symbol = UFUNCS.get(ufunc.__name__)
        if method != "__call__" or options:
            raise DefinitionError(f"{ufunc.__name__} of a quantity is not provided in this form.")
        if symbol == "+":
            return Sum(quantity(inputs[0]), quantity(inputs[1]))
        if symbol == "-":
            return Sum(quantity(inputs[0]), Negative(quantity(inputs[1])))
        if symbol is not None:
            return Operation(symbol, quantity(inputs[0]), quantity(inputs[1]))
        if ufunc.__name__ not in FUNCTIONS:
            raise DefinitionError(f"{ufunc.__name__} of a quantity is not provided; use one of: {', '.join(FUNCTIONS)}.")
        return Function(ufunc.__name__, *(quantity(each) for each in inputs))


Operand: TypeAlias = "Quantity | float | str"

FUNCTIONS: dict[str, Callable[..., Any]] = {
    name: getattr(np, name) for name in ("sqrt", "sin", "cos", "tan", "arctan2", "exp", "log", "absolute", "minimum", "maximum")
}
OPERATORS: dict[str, Callable[[Any, Any], Any]] = {"*": operator.mul, "/": operator.truediv, "**": operator.pow}
UFUNCS = {"add": "+", "subtract": "-", "multiply": "*", "true_divide": "/", "divide": "/", "power": "**"}
BINDS = {"*": (2, 2, 3), "/": (2, 2, 3), "**": (3, 4, 4)}
"""How strongly an operator binds, and how strongly its left and its right side must, to stand without brackets."""


def quantity(value: Operand) -> Quantity:
    """Return a value as a quantity: a number, a quantity, or the name of one."""
    if isinstance(value, Quantity):
        return value
    if isinstance(value, str) and not value.isidentifier():
        raise DefinitionError(f"{value!r} stands where a number, a quantity or its name is expected; write a number without quotes.")
    if isinstance(value, str):
        return ref(value)
    if is_number(value):
        return Number(float(value))
    if isinstance(value, (float, int)) and not isinstance(value, bool):
        raise DefinitionError(f"{value!r} is not a finite number; give a value in SI.")
    raise DefinitionError(f"{value!r} stands where a number, a quantity or its name is expected.")


def spelled(part: Quantity, binding: int = 0) -> str:
    """Return a part as text, in brackets where it binds more loosely than its surroundings."""
    text = part.name or str(part)
    return f"({text})" if not part.name and getattr(part, "binds", 9) < binding else text


@dataclass(frozen=True, eq=False)
class Number(Quantity):
    """A number, in SI."""

    number: float

    def rule(self, where: Where) -> Scalar:
        return self.number

    @property
    def is_constant(self) -> bool:
        return True

    @property
    def binds(self) -> int:
        """A number with a sign is bracketed under a power only."""
        return 3 if str(self).startswith("-") else 9

    def __str__(self) -> str:
        return repr(self.number)


@dataclass(frozen=True, eq=False)
class Variable(Quantity):
    """A design variable that a label or a coordinate made: `OB`, `M.x`."""

    variable: str

    def rule(self, where: Where) -> Scalar:
        return where.input(self.variable)

    def __str__(self) -> str:
        return self.variable


@dataclass(frozen=True, eq=False)
class Ref(Quantity):
    """A quantity by its name, for one that is not bound yet."""

    target: str
    expects = (("target", "quantity"),)

    def parts(self) -> tuple[Reference, ...]:
        return (self.target,)

    def rule(self, where: Where) -> Scalar:
        return where.value(self.target)

    def turning(self, where: Where) -> Turning:
        return where.turn(self.target)

    def __str__(self) -> str:
        return self.target


def ref(name: str) -> Quantity:
    """Return the quantity of that name, to be bound anywhere in the class: `ref("L0") + S`."""
    if not isinstance(name, str) or not name.isidentifier():
        raise DefinitionError(f"ref({name!r}): a name is expected, such as ref('L0').")
    return Ref(name)


@dataclass(frozen=True, eq=False)
class Sum(Quantity):
    """The sum of two quantities; of two angles it is carried as cosine and sine."""

    a: Quantity
    b: Quantity
    binds = 1

    @property
    def measures(self) -> str:
        return self.a.measures or self.b.measures

    def parts(self) -> tuple[Reference, ...]:
        return self.a, self.b

    def rule(self, where: Where) -> Scalar:
        return where.value(self.a) + where.value(self.b)

    def turning(self, where: Where) -> Turning:
        (c, s), (p, q) = where.turn(self.a), where.turn(self.b)
        return c * p - s * q, s * p + c * q

    def __str__(self) -> str:
        if isinstance(self.b, Negative) and not self.b.name:
            return f"{spelled(self.a, 1)} - {spelled(self.b.a, 2)}"
        return f"{spelled(self.a, 1)} + {spelled(self.b, 2)}"


@dataclass(frozen=True, eq=False)
class Negative(Quantity):
    """A quantity with its sign changed."""

    a: Quantity
    binds = 1

    @property
    def measures(self) -> str:
        return self.a.measures

    def parts(self) -> tuple[Reference, ...]:
        return (self.a,)

    def rule(self, where: Where) -> Scalar:
        return -where.value(self.a)

    def turning(self, where: Where) -> Turning:
        cos, sin = where.turn(self.a)
        return cos, -sin

    def __str__(self) -> str:
        return f"-{spelled(self.a, 3)}"


class Operation(Quantity):
    """The product, quotient or power of two quantities."""

    def __init__(self, symbol: str, a: Quantity, b: Quantity) -> None:
        self.symbol, self.a, self.b = symbol, a, b
        self.binds, self.left, self.right = BINDS[symbol]

    def parts(self) -> tuple[Reference, ...]:
        return self.a, self.b

    def rule(self, where: Where) -> Scalar:
        return OPERATORS[self.symbol](where.value(self.a), where.value(self.b))

    def __str__(self) -> str:
        return f"{spelled(self.a, self.left)} {self.symbol} {spelled(self.b, self.right)}"


class Function(Quantity):
    """A function of quantities: `np.sqrt(L1**2 + L2**2)`."""

    def __init__(self, function: str, *arguments: Quantity) -> None:
        self.function, self.arguments = function, arguments

    def parts(self) -> tuple[Reference, ...]:
        return self.arguments

    def rule(self, where: Where) -> Scalar:
        return FUNCTIONS[self.function](*(where.value(each) for each in self.arguments))

    def __str__(self) -> str:
        return f"{self.function}({', '.join(spelled(each) for each in self.arguments)})"
