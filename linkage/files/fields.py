"""What stands in the places of an entry, checked by pydantic: numbers, expressions, names, positions, sides."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, Any, TypeAlias

from pydantic import PlainValidator, ValidationInfo

from ..errors import DefinitionError
from ..quantities import Number, Quantity, is_number
from ..steps import Arrow
from ..vectors import Side
from .expression import arrow, expression
from .names import Names, shortened


def names_of(info: ValidationInfo) -> Names:
    """Return the names of the file that is read."""
    names = info.context
    assert isinstance(names, Names)
    return names


def value_of(given: Any, info: ValidationInfo) -> Quantity:
    """Return a number [SI], a text such as `500 mm`, or an expression as a quantity."""
    if isinstance(given, str):
        return expression(given, names_of(info))
    if not is_number(given):
        raise DefinitionError(f"{shortened(given)} is neither a finite number nor an expression in quotes.")
    return Number(float(given))


def number_of(given: Any, info: ValidationInfo) -> float:
    """Return a number as it is given, or that of a text without names [SI]."""
    if isinstance(given, str):
        found = expression(given, names_of(info))
        if not isinstance(found, Number):
            raise DefinitionError(f"{shortened(given)}: a number is expected here, with no names in it.")
        return found.number
    if not is_number(given):
        raise DefinitionError(f"{shortened(given)} is not a finite number.")
    return given  # an int stays one: it prints as it was written


def numbers_of(given: Any, info: ValidationInfo) -> tuple[float, float]:
    """Return two numbers [SI]."""
    first, second = two(given, "two numbers, such as [0.0, 0.25]")
    return number_of(first, info), number_of(second, info)


def place_of(given: Any, info: ValidationInfo) -> tuple[float, float]:
    """Return a position of two numbers [m]."""
    x, y = two(given, "a position in m, such as [0.51, 0.94]")
    return float(number_of(x, info)), float(number_of(y, info))


def coordinates_of(given: Any, info: ValidationInfo) -> tuple[Quantity, Quantity]:
    """Return two coordinates, numbers or expressions [m]."""
    x, y = two(given, "two coordinates in m, such as [0.20, 0.55]")
    return value_of(x, info), value_of(y, info)


def two(given: Any, what: str) -> tuple[Any, Any]:
    """Return the two parts of a list; DefinitionError for anything else."""
    if not isinstance(given, Sequence) or isinstance(given, str) or len(given) != 2:
        raise DefinitionError(f"{shortened(given)} is not {what}.")
    return given[0], given[1]


def point_of(given: Any, info: ValidationInfo) -> str:
    """Return the name of a point."""
    return names_of(info).checked(given, "point")


def guide_of(given: Any, info: ValidationInfo) -> str:
    """Return the name of a guide."""
    return names_of(info).checked(given, "guide")


def points_of(given: Any, info: ValidationInfo) -> tuple[str, str]:
    """Return the names of two points."""
    P, Q = two(given, 'two points, such as ["A", "O"]')
    return point_of(P, info), point_of(Q, info)


def point_and_guide_of(given: Any, info: ValidationInfo) -> tuple[str, str]:
    """Return the names of a point and a guide."""
    P, guide = two(given, 'a point and a guide, such as ["A", "rail"]')
    return point_of(P, info), guide_of(guide, info)


def guides_of(given: Any, info: ValidationInfo) -> tuple[str, str]:
    """Return the names of two guides."""
    first, second = two(given, 'two guides, such as ["rail", "post"]')
    return guide_of(first, info), guide_of(second, info)


def arrow_of(given: Any, info: ValidationInfo) -> Arrow | str:
    """Return a vector, or the name of one."""
    if not isinstance(given, str):
        raise DefinitionError(f"{shortened(given)} is not a vector, such as \"Vector(A, O)\".")
    return arrow(given, names_of(info))


def point_and_arrow_of(given: Any, info: ValidationInfo) -> tuple[str, Arrow | str]:
    """Return the name of a point, and a vector."""
    P, by = two(given, 'a point and a vector, such as ["A", "AB"]')
    return point_of(P, info), arrow_of(by, info)


def origin_of(given: Any, info: ValidationInfo) -> str | tuple[float, float]:
    """Return the name of a point, or a position [m]."""
    return point_of(given, info) if isinstance(given, str) else place_of(given, info)


def side_of(given: Any) -> Side:
    """Return the side that a word says."""
    found = Side.said(given) if isinstance(given, str) else None
    if found is None:
        raise DefinitionError(f"{shortened(given)} is not a side; write \"LEFT\" or \"RIGHT\".")
    return found


def words_of(given: Any, info: ValidationInfo) -> tuple[str, ...]:
    """Return the names of points, from a text such as `O B C` or a list."""
    words = given.split() if isinstance(given, str) else given
    if not isinstance(words, Sequence) or not words:
        raise DefinitionError(f"{shortened(given)} is not a list of points, such as \"O B C\".")
    return tuple(point_of(word, info) for word in words)


Value: TypeAlias = Annotated[Quantity, PlainValidator(value_of)]
Plain: TypeAlias = Annotated[float, PlainValidator(number_of)]
Ends: TypeAlias = Annotated[tuple[float, float], PlainValidator(numbers_of)]
Place: TypeAlias = Annotated[tuple[float, float], PlainValidator(place_of)]
Coordinates: TypeAlias = Annotated[tuple[Quantity, Quantity], PlainValidator(coordinates_of)]
PointName: TypeAlias = Annotated[str, PlainValidator(point_of)]
GuideName: TypeAlias = Annotated[str, PlainValidator(guide_of)]
TwoPoints: TypeAlias = Annotated[tuple[str, str], PlainValidator(points_of)]
PointAndGuide: TypeAlias = Annotated[tuple[str, str], PlainValidator(point_and_guide_of)]
TwoGuides: TypeAlias = Annotated[tuple[str, str], PlainValidator(guides_of)]
AnArrow: TypeAlias = Annotated[Any, PlainValidator(arrow_of)]
PointAndArrow: TypeAlias = Annotated[tuple[str, Any], PlainValidator(point_and_arrow_of)]
Origin: TypeAlias = Annotated[Any, PlainValidator(origin_of)]
SideWord: TypeAlias = Annotated[Side, PlainValidator(side_of)]
Points: TypeAlias = Annotated[tuple[str, ...], PlainValidator(words_of)]
