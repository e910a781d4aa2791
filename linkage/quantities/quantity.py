"""Scalars of a mechanism: numbers, names, and sums, products and functions of them.

Each says its rule once, in plain arithmetic; a reading (arrays, traced nodes) supplies the values.
"""

from __future__ import annotations

import operator
from abc import ABC, abstractmethod
from collections.abc import Callable, Hashable, Iterator, Mapping
from dataclasses import replace
from types import MappingProxyType
from typing import Any, NoReturn, TypeAlias, cast

import numpy as np

from ..errors import DefinitionError, cited, ensure, is_number, is_whole
from ..frozen import immutable, unmasked
from ..units import UNITS, amount_or_float, display_unit, show
from ..vectors import FloatArray, Operators, Scalar, Vec
from .member import Member, Reference, Turning, Where, is_reference

TAKEN = (
    "add", "subtract", "multiply", "divide", "power", "negative", "absolute", "minimum", "maximum", "hypot", "sqrt", "sin", "cos", "tan",
    "arctan2", "exp", "log",
)  # fmt: skip
"""NumPy's functions that are taken of it, by name."""


class Arithmetic(Operators[Any, Any], ABC):
    """The base of values with arithmetic and NumPy's functions, beside numbers and quantities. A subclass defines `applied`."""

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *inputs: object, **options: object) -> Any:
        name = {"true_divide": "divide", "fabs": "absolute"}.get(ufunc.__name__, ufunc.__name__)
        if method != "__call__" or options or name not in TAKEN:
            raise DefinitionError(f"np.{ufunc.__name__} of {self} is not provided in this form; use one of: {', '.join(TAKEN)}.")
        return self.applied(name, *inputs)

    def _not_provided(self, *others: object) -> NoReturn:
        raise DefinitionError(f"{self}: what is asked for takes + - * / ** and NumPy's functions: {', '.join(TAKEN)}.")

    __mod__ = __rmod__ = __floordiv__ = __rfloordiv__ = __matmul__ = __rmatmul__ = __divmod__ = __rdivmod__ = __round__ = _not_provided

    def __bool__(self) -> NoReturn:
        raise DefinitionError(f"{self} has no value before it is asked of a motion, so that `if`, `and`, `or` cannot choose by it.")

    def __float__(self) -> NoReturn:
        raise DefinitionError(f"{self} has no value before it is asked of a motion; take NumPy's functions, np.sqrt(...), not math's.")


# The operators and functions that quantities know: what they compute, and how they are written.

FUNCTIONS: dict[str, Callable[..., Scalar]] = {
    name: getattr(np, name) for name in ("sqrt", "sin", "cos", "tan", "arctan2", "exp", "log", "absolute", "minimum", "maximum")
}
OPERATORS: Mapping[str, Callable[[Any, Any], Any]] = MappingProxyType(
    {"+": operator.add, "-": operator.sub, "*": operator.mul, "/": operator.truediv, "**": operator.pow}
)
"""What Python's operators compute."""
UFUNCS = {"add": "+", "subtract": "-", "multiply": "*", "true_divide": "/", "divide": "/", "power": "**"}
BINDS = {"*": (2, 2, 3), "/": (2, 2, 3), "**": (3, 4, 4)}
"""How strongly an operator binds, and how strongly its left and its right side must, to stand without brackets."""


# What counts as a number from outside: finite, real, not a truth value.

EXACT = 2**53
"""Up to this every whole number is a float."""


def plain(value: object) -> Any:
    """Return NumPy's number as Python's own, which prints as it is written in a class; a whole one that no float holds as a float."""
    if isinstance(value, int) and abs(value) > EXACT and is_number(value):
        return float(value)
    return value.item() if isinstance(value, np.generic) else value


def real(value: object) -> FloatArray:
    """Return a value as a new array of floats, NaN where it is masked; raise ValueError for anything but real numbers."""
    if type(value) is float:
        return np.array(value)
    array = value if type(value) is np.ndarray else np.asarray(float(value) if is_whole(value) and is_number(value) else unmasked(value))
    if array.dtype.kind not in "fiu":
        raise ValueError(f"{value!r} is not a real number")
    return np.array(array, float)


def numbers_in(value: object) -> FloatArray:
    """Return a value as `real` does; an empty array for anything but real numbers."""
    try:
        return real(value)
    except (TypeError, ValueError, OverflowError):
        return np.empty(0)


# How quantities are written, so that the text gives the same value when it is pasted back.

DIGITS = 17  # tell any float from its neighbours
MORE = 2  # characters that degrees may be longer than radians


def source_text(part: Quantity, binding: int = 0, measures: str = "") -> str:
    """Return a part as text, in brackets where it binds more loosely than its surroundings.

    `measures` says what it stands for, where its place tells: the numbers of an `angle` are written in degrees.
    """
    text = part.name or part.text(measures)
    return f"({text})" if not part.name and getattr(part, "binds", 9) < binding else text


WRITTEN = {"angle": "deg", "length": "mm", "volume": "litre", "force": "N", "pressure": "Pa"}
"""The unit in which source writes a number of a kind."""


def with_unit(value: float, measures: str, longer: int = MORE) -> str:
    """Return a number [SI] as source writes it in the unit of a kind, `75 * deg`; plain where that is not the same to the last digit.

    It is plain too where the number in the unit would be `longer` by more characters.
    """
    plain, unit = repr(value), WRITTEN[measures]
    if not 0.0 < abs(value) < float("inf"):
        return plain
    for digits in range(1, DIGITS + 1):
        number = float(f"{value / UNITS[unit][0]:.{digits}g}")
        if number * UNITS[unit][0] == value:
            text = repr(number).removesuffix(".0")
            return f"{text} * {unit}" if len(text) <= len(plain) + longer else plain
    return plain


def in_degrees(value: float) -> str:
    """Return an angle [rad] as `75 * deg` where that is the same to the last digit; else, or where it is much shorter, in radians."""
    return with_unit(value, "angle")


def factor_text(part: Quantity, binding: int) -> str:
    """Return a factor of a product as text: a number that was given with its unit keeps it, since a product may measure anything."""
    kind = "" if part.name else getattr(part.constant, "measures", "")
    if kind not in WRITTEN:
        return source_text(part, binding)
    text = with_unit(cast(float, part.constant), kind, DIGITS)
    return f"({text})" if " " in text and binding > BINDS["*"][0] else text


Operand: TypeAlias = "Quantity | float | str"


COMPARED = "What holds over a stroke is said of one number of it: least(q) >= ..., most(q) <= ..., at(q, S=...) == ...."
CHOICE = "choose by np.maximum or np.minimum, or make two classes of it"


@immutable
class PoseCondition:
    """A comparison that holds at some poses and not at others: `x("T") <= 4`; for `Over(..., only=[...])`.

    A quantity or a request stands on its left or on its right, by their names too.
    """

    left: Any
    symbol: str
    right: Any

    __array_ufunc__ = None

    def __post_init__(self) -> None:
        if not is_number(self.right) and not isinstance(self.right, (str, Quantity, Arithmetic)):
            raise DefinitionError(f"{self}: a number in SI or a quantity is expected beside {self.symbol}.")

    @property
    def margin(self) -> Any:
        """A quantity or a request that is zero or above at the poses that keep it."""
        left, right = (quantity(each) if isinstance(each, str) else each for each in (self.left, self.right))
        return left - right if self.symbol == ">=" else right - left

    def __str__(self) -> str:
        left, right = (each.name or str(each) if isinstance(each, Quantity) else str(each) for each in (self.left, self.right))
        return f"{left} {self.symbol} {right}"

    def words(self) -> str:
        """Return the condition with its number in a unit that a reader knows, where its other side tells the kind."""
        unit = display_unit(getattr(self.left, "measures", ""), "mm")
        return str(replace(self, right=show(self.right, unit, 6))) if unit and is_number(self.right) else str(self)

    def __bool__(self) -> NoReturn:
        raise DefinitionError(f"{self}: it has a value at every pose, so that it cannot be compared once for all; {CHOICE}. {COMPARED}")

    def _no_number(self, *others: object) -> NoReturn:
        raise DefinitionError(f"{self} is a condition on poses and no number; {CHOICE}. {COMPARED}")

    __add__ = __radd__ = __sub__ = __rsub__ = __mul__ = __rmul__ = __truediv__ = __rtruediv__ = __neg__ = __float__ = _no_number
    __lt__ = __le__ = __gt__ = __ge__ = _no_number


class Quantity(Operators["Quantity | float | str", "Quantity"], Member):
    """A scalar member or a part of one. Adds, multiplies and takes NumPy's functions."""

    kind = "quantity"

    @property
    def measures(self) -> str:
        """The kind of measure where the rule tells it: `angle`, `length`, or "" for a plain number."""
        return ""

    @abstractmethod
    def rule(self, where: Where) -> Scalar:
        """Return the value [SI] in a reading.

        Parameters
        ----------
        where : Where
            The reading: places of points and values of quantities.

        Returns
        -------
        float or array
            The value [SI].
        """

    def turning(self, where: Where) -> Turning:
        """Return the cosine and sine of this angle; without trigonometry where a square root will do.

        Parameters
        ----------
        where : Where
            The reading: places of points and values of quantities.

        Returns
        -------
        Turning
            The cosine and the sine.
        """
        value = where.value(self)
        return np.cos(value), np.sin(value)

    @property
    def identity(self) -> Hashable:
        """A hashable key among the quantities of one mechanism: its name, else itself."""
        return self.name or self

    @property
    def known_as(self) -> str:
        """The name of the member that it is, or stands for; "" where it has none."""
        return self.name

    @property
    def constant(self) -> float | None:
        """The number [SI] that this is; None for all else."""
        return None

    @property
    def is_constant(self) -> bool:
        """Whether this is a plain number."""
        return self.constant is not None

    def opposite(self) -> Quantity:
        """Return it with its sign changed; a number as a number."""
        return -self

    def text(self, measures: str = "") -> str:
        """Return this as it is written in source; with `measures` "angle", numbers are in degrees.

        Parameters
        ----------
        measures : str, optional
            With "angle", numbers are in degrees.

        Returns
        -------
        str
            The text.
        """
        return str(self)

    def applied(self, function: str, *operands: Operand) -> Quantity:
        """Apply NumPy's function of that name to quantities; NotImplemented beside other classes that calculate with quantities."""
        if any(isinstance(each, Arithmetic) for each in operands):
            return NotImplemented  # type: ignore[no-any-return]
        given = [quantity(each) for each in operands]
        if function == "negative":
            return Negative(*given)
        if function in ("add", "subtract"):
            return Sum(given[0], given[1] if function == "add" else Negative(given[1]))
        return Operation(UFUNCS[function], *given) if function in UFUNCS else Function(function, *given)

    def __bool__(self) -> NoReturn:
        raise DefinitionError(f"{self}: a quantity has no value in a class, so that `if`, `and`, `or` cannot choose by it; {CHOICE}.")

    def __ge__(self, other: object) -> PoseCondition:
        return PoseCondition(self, ">=", other)

    def __le__(self, other: object) -> PoseCondition:
        return PoseCondition(self, "<=", other)

    __gt__, __lt__ = __ge__, __le__

    def __float__(self) -> NoReturn:
        raise DefinitionError(f"{self}: a quantity has no value in a class; take NumPy's functions of it, np.sin(...), not math's.")

    def _not_provided(self, *others: object) -> NoReturn:
        raise DefinitionError(f"{self}: quantities take + - * / ** and NumPy's functions: {', '.join(FUNCTIONS)}.")

    __mod__ = __rmod__ = __floordiv__ = __rfloordiv__ = __matmul__ = __rmatmul__ = __divmod__ = __rdivmod__ = __round__ = _not_provided

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *inputs: Operand, **options: object) -> Quantity:
        """Apply NumPy's function to quantities: np.sqrt(L), np.float64(2) * L."""
        name = ufunc.__name__
        if any(isinstance(each, Arithmetic) for each in inputs):
            return NotImplemented  # type: ignore[no-any-return]
        is_call = method == "__call__" and not options
        if not is_call or (name not in UFUNCS and name not in FUNCTIONS):
            remedy = f"; use one of: {', '.join(FUNCTIONS)}" if is_call else " in this form"
            raise DefinitionError(f"{name} of a quantity is not provided{remedy}.")
        return self.applied(name, *inputs)


class Expression(Quantity):
    """A quantity made of its parts joined by a `symbol`: equal parts and an equal symbol make an equal quantity."""

    symbol: str

    @property
    def identity(self) -> Hashable:
        """Its name, else that of its parts; itself where one of them has no other."""
        if self.name:
            return self.name
        identities = [(part, part.identity) for part in self.parts() if isinstance(part, Quantity)]
        is_itself = any(part is identity for part, identity in identities)
        return self if is_itself else (self.symbol, *(identity for _, identity in identities))

    def __str__(self) -> str:
        return self.text()


def quantity(value: Operand) -> Quantity:
    """Return a value as a quantity: a number, a quantity, or the name of one."""
    if isinstance(value, Quantity):
        return value
    if is_number(value):
        return Number(amount_or_float(value))
    if is_reference(value):
        return Ref(value)
    fault = "stands where a number, a quantity or its name is expected"
    ensure(not isinstance(value, str), f"{value!r} {fault}; write a number without quotes.")
    is_endless = isinstance(value, (float, int)) and not isinstance(value, bool)
    raise DefinitionError(f"{cited(value)} {'is not a finite number; give a value in SI' if is_endless else fault}.")


@immutable
class Number(Quantity):
    """A number, in SI; one that was given with its unit is an `Amount` still."""

    number: float

    @property
    def constant(self) -> float:
        return self.number

    @property
    def identity(self) -> Hashable:
        return self.name or repr(self.number)

    def rule(self, where: Where) -> Scalar:
        return float(self.number)

    @property
    def binds(self) -> int:
        """A number with a sign is bracketed under a power only."""
        return 3 if str(self).startswith("-") else 9

    def opposite(self) -> Quantity:
        return -self if self.name else Number(-self.number if self.number else 0.0)

    def text(self, measures: str = "") -> str:
        return in_degrees(self.number) if measures == "angle" else repr(self.number)

    def __str__(self) -> str:
        return repr(self.number)


@immutable
class Ref(Quantity):
    """A quantity by its name, for one that is not bound yet."""

    target: str
    expects = (("target", "quantity"),)

    @property
    def known_as(self) -> str:
        return self.name or self.target

    identity = known_as

    def rule(self, where: Where) -> Scalar:
        return where.value(self.target)

    def turning(self, where: Where) -> Turning:
        return where.turn(self.target)

    def __str__(self) -> str:
        return self.target


def stands_for(members: Mapping[str, object], given: object) -> Any:
    """Resolve a name or a reference among some members to its final member; an unknown name is returned unchanged."""
    while isinstance(given, (str, Ref)):
        name = given.target if isinstance(given, Ref) else given
        if name not in members:
            return name
        given = members[name]
    return given


def ref(name: str) -> Quantity:
    """Return the quantity of that name, to be bound anywhere in the class: `ref("L0") + S`.

    Parameters
    ----------
    name : str
        The quantity's name.

    Returns
    -------
    Quantity
        The reference.
    """
    ensure(is_reference(name), f"ref({name!r}): a name is expected, such as ref('L0').")
    return Ref(name)


@immutable
class Sum(Expression):
    """The sum of two quantities; of two angles it is carried as cosine and sine."""

    a: Quantity
    b: Quantity
    expects = (("a", "quantity"), ("b", "quantity"))
    symbol = "+"
    binds = 1

    @property
    def measures(self) -> str:
        return self.a.measures or self.b.measures

    def rule(self, where: Where) -> Scalar:
        return where.value(self.a) + where.value(self.b)

    def turning(self, where: Where) -> Turning:
        (c, s), (p, q) = where.turn(self.a), where.turn(self.b)
        return c * p - s * q, s * p + c * q

    def text(self, measures: str = "") -> str:
        kind = measures or self.measures
        if isinstance(self.b, Negative) and not self.b.name:
            return f"{source_text(self.a, 1, kind)} - {source_text(self.b.a, 2, kind)}"
        return f"{source_text(self.a, 1, kind)} + {source_text(self.b, 2, kind)}"


@immutable
class Negative(Expression):
    """A quantity with its sign changed."""

    a: Quantity
    expects = (("a", "quantity"),)
    symbol = "-"
    binds = 1

    @property
    def measures(self) -> str:
        return self.a.measures

    def rule(self, where: Where) -> Scalar:
        return -where.value(self.a)

    def turning(self, where: Where) -> Turning:
        cos, sin = where.turn(self.a)
        return cos, -sin

    def text(self, measures: str = "") -> str:
        return f"-{source_text(self.a, 3, measures or self.measures)}"


def signed_terms(given: Quantity, members: Mapping[str, Member], sign: float = 1.0) -> Iterator[tuple[float, Quantity]]:
    """Yield the terms of a sum with their signs, of its multiples too; names are looked up among the members of a class."""
    match given:
        case Ref():
            yield from signed_terms(cast(Quantity, members[given.target]), members, sign)
        case Sum():
            yield from signed_terms(given.a, members, sign)
            yield from signed_terms(given.b, members, sign)
        case Negative():
            yield from signed_terms(given.a, members, -sign)
        case Operation(symbol="*" | "/") if len(terms := [*signed_terms(given.a, members, sign)]) > 1:
            yield from ((own, Operation(given.symbol, term, given.b)) for own, term in terms)
        case Operation(symbol="*") if len(terms := [*signed_terms(given.b, members, sign)]) > 1:
            yield from ((own, Operation("*", given.a, term)) for own, term in terms)
        case _:
            yield sign, given


class Operation(Expression):
    """The product, quotient or power of two quantities."""

    expects = (("a", "quantity"), ("b", "quantity"))

    def __init__(self, symbol: str, a: Quantity, b: Quantity) -> None:
        self.symbol, self.a, self.b = symbol, a, b
        self.binds, self.left, self.right = BINDS[symbol]

    def rule(self, where: Where) -> Scalar:
        made: Scalar = OPERATORS[self.symbol](where.value(self.a), where.value(self.b))
        return made

    def text(self, measures: str = "") -> str:
        return f"{factor_text(self.a, self.left)} {self.symbol} {factor_text(self.b, self.right)}"


class Function(Expression):
    """A function of quantities: `np.sqrt(L1**2 + L2**2)`."""

    def __init__(self, function: str, *arguments: Quantity) -> None:
        self.symbol, self.arguments = function, arguments

    @property
    def measures(self) -> str:
        kinds = {each.measures for each in self.arguments}
        return kinds.pop() if self.symbol in ("absolute", "minimum", "maximum") and len(kinds) == 1 else ""

    def parts(self) -> tuple[Reference, ...]:
        return self.arguments

    def rule(self, where: Where) -> Scalar:
        values = [where.value(each) for each in self.arguments]
        if self.symbol == "arctan2" and (found := where.followed(str(self), Vec(*values[::-1]))) is not None:
            return found
        return FUNCTIONS[self.symbol](*values)

    def text(self, measures: str = "") -> str:
        return f"{self.symbol}({', '.join(source_text(each) for each in self.arguments)})"
