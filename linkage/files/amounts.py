"""What stands in the places of loads, checked by pydantic: amounts with units of the right kind, bodies, directions, words."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, Any, TypeAlias

from pydantic import PlainValidator, ValidationInfo

from ..errors import DefinitionError
from ..quantities import Number
from ..units import UNITS, parse
from .fields import names_of, number_of, two, value_of
from .names import shortened
from .tokens import one_unit


def amount_of(given: Any, info: ValidationInfo, kind: str) -> Any:
    """Return a number [SI], that of a text such as `1200 kg` whose unit measures `kind`, or an expression as a quantity."""
    if not isinstance(given, str):
        return number_of(given, info)
    check_unit(given, kind)
    found = value_of(given, info)
    return found.number if isinstance(found, Number) else found


def fixed_of(given: Any, info: ValidationInfo, kind: str) -> float:
    """Return a number [SI], or that of a text such as `250 mm` whose unit measures `kind`; it follows nothing."""
    if isinstance(given, str):
        check_unit(given, kind)
    return number_of(given, info)


def check_unit(text: str, kind: str) -> None:
    """Raise DefinitionError where a text is one number with a unit of another kind."""
    unit = one_unit(text)
    if kind and unit and UNITS[unit][1] != kind:
        parse(text.strip("+-() \t\n"), kind)


def pair_of(given: Any, info: ValidationInfo) -> tuple[float, float]:
    """Return two numbers [SI]."""
    x, y = two(given, "two numbers, such as [0, 1]")
    return number_of(x, info), number_of(y, info)


def gravity_of(given: Any, info: ValidationInfo) -> tuple[float, float]:
    """Return a gravity of two numbers [m/s2]."""
    x, y = two(given, "two numbers in m/s2, such as [0, -9.81]")
    return number_of(x, info), number_of(y, info)


def force_of(given: Any, info: ValidationInfo) -> tuple[Any, Any]:
    """Return the two parts of a force, numbers or expressions [N]."""
    x, y = two(given, 'a force of two parts in N, such as ["-5 kN", 0]')
    return amount_of(x, info, "force"), amount_of(y, info, "force")


def body_of(given: Any, info: ValidationInfo) -> str:
    """Return the name of a link, or the names of points of a body, in one text."""
    words = given.split() if isinstance(given, str) else given
    if not isinstance(words, Sequence) or not words or len(set(map(str, words))) < len(words):
        raise DefinitionError(f'{shortened(given)} is not a body; name a link, or two of its points such as "O B".')
    kind = "point" if len(words) > 1 else "link"
    return " ".join(names_of(info).checked(word, kind) for word in words)


def load_of(given: Any, info: ValidationInfo) -> str:
    """Return the name of a load."""
    return names_of(info).checked(given, "load")


def loads_of(given: Any, info: ValidationInfo) -> Any:
    """Return the name of a load, or a list of such."""
    if isinstance(given, str) or not isinstance(given, Sequence):
        return load_of(given, info)
    return [load_of(each, info) for each in given]


def word_of(given: Any) -> str:
    """Return a word that stands for itself."""
    if not isinstance(given, str) or not given.isprintable():
        raise DefinitionError(f"{shortened(given)} stands where a word in quotes is expected.")
    return given


def amount(kind: str) -> PlainValidator:
    """Return the check of an amount that measures `kind`; "" is anything."""
    return PlainValidator(lambda given, info: amount_of(given, info, kind))


def fixed(kind: str) -> PlainValidator:
    """Return the check of a number that measures `kind`; "" is anything."""
    return PlainValidator(lambda given, info: fixed_of(given, info, kind))


Amount: TypeAlias = Annotated[Any, amount("")]
Mass: TypeAlias = Annotated[Any, amount("mass")]
Newtons: TypeAlias = Annotated[Any, amount("force")]
NewtonMetres: TypeAlias = Annotated[Any, amount("moment")]
Metres: TypeAlias = Annotated[Any, amount("length")]
Pressure: TypeAlias = Annotated[Any, amount("pressure")]
Volume: TypeAlias = Annotated[Any, amount("volume")]
FixedNumber: TypeAlias = Annotated[Any, fixed("")]
FixedAngle: TypeAlias = Annotated[Any, fixed("angle")]
FixedMetres: TypeAlias = Annotated[Any, fixed("length")]
Pair: TypeAlias = Annotated[tuple[float, float], PlainValidator(pair_of)]
Gravity: TypeAlias = Annotated[tuple[float, float], PlainValidator(gravity_of)]
ForceVector: TypeAlias = Annotated[tuple[Any, Any], PlainValidator(force_of)]
BodyName: TypeAlias = Annotated[str, PlainValidator(body_of)]
LoadName: TypeAlias = Annotated[str, PlainValidator(load_of)]
LoadNames: TypeAlias = Annotated[Any, PlainValidator(loads_of)]
Word: TypeAlias = Annotated[str, PlainValidator(word_of)]
