"""Checks at public doors: one number, one whole number, a value of a kind; each refused in one form of words."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, TypeGuard, TypeVar, cast

import numpy as np

from .errors import DefinitionError, cited, ensure
from .units import require_measure
from .vectors import FloatArray, Scalar

Kind = TypeVar("Kind")


def is_number(value: object) -> TypeGuard[float]:
    """Return whether a value is one finite real number."""
    if isinstance(value, bool) or not isinstance(value, (int, float, np.integer, np.floating)):
        return False
    try:
        return math.isfinite(value)
    except OverflowError:
        return False


def is_whole(value: object) -> TypeGuard[int]:
    """Return whether a value is one whole number, Python's or NumPy's."""
    return isinstance(value, (int, np.integer)) and not isinstance(value, bool)


def is_listed(given: object) -> TypeGuard[Sequence[Any]]:
    """Return whether a value is a list or a tuple."""
    return isinstance(given, (list, tuple))


def is_class_of(given: object, kind: type[Kind]) -> TypeGuard[type[Kind]]:
    """Return whether a value is a class of a kind."""
    return isinstance(given, type) and issubclass(given, kind)


def instance_of(given: object, kind: type[Kind]) -> Kind | None:
    """Return an object of a kind, of a class of it one that is made; None for anything else."""
    return given if isinstance(given, kind) else given() if is_class_of(given, kind) else None


def can_be_called(given: object) -> TypeGuard[Callable[..., object]]:
    """Return whether a value can be called as a function, which a class is not."""
    return callable(given) and not isinstance(given, type)


def two_of(given: object) -> tuple[Scalar, ...]:
    """Return both parts of a list, a tuple or an array of two, such as the coordinates of a place; nothing for anything else."""
    parts = tuple(given) if is_listed(given) or (isinstance(given, np.ndarray) and given.ndim) else ()
    return parts if len(parts) == 2 else ()


VERBS = ("is ", "has ", "stands ", "cannot ", "compares ", "does ")
"""What begins with one of these goes on from the value, as in `scale=0 is no size.`"""


def fits_shape(value: object, shape: tuple[int, ...]) -> bool:
    """Return whether a number or an array can be broadcast to a shape, that of some poses."""
    try:
        return np.broadcast_shapes(np.shape(cast(float, value)), shape) == shape
    except ValueError:
        return False


def of_one_shape(what: str, names: Iterable[str], arrays: Sequence[FloatArray]) -> list[FloatArray]:
    """Return named arrays broadcast against each other; DefinitionError, with all shapes, where they do not fit: `the strokes' shapes`."""
    try:
        return list(np.broadcast_arrays(*arrays))
    except ValueError:
        shapes = ", ".join(f"{name} {array.shape}" for name, array in zip(names, arrays, strict=True))
        raise DefinitionError(f"{what} do not fit each other: {shapes}.") from None


def unfit(what: str, value: object, expected: str) -> DefinitionError:
    """Return the error for a value: `count=0: a number is expected.`, `scale=0 is no size.`; `gap(width` is closed behind the value."""
    given = f"{what}={cited(value)}{')' * (what.count('(') - what.count(')'))}" if what else cited(value)
    return DefinitionError(f"{given}{' ' if expected.startswith(VERBS) else ': '}{expected}.")


def require(holds: object, what: str, value: object, expected: str) -> None:
    """Refuse a value of which something does not hold; in the words of `require_number`."""
    if not holds:
        raise unfit(what, value, expected)


def require_one_design(designs: Mapping[str, object], said: str) -> None:
    """Refuse a batch by its dimensions: `Crane: a figure shows one design, this is a batch, L has 3 values; choose one of them.`"""
    for name, value in designs.items():
        values = np.asarray(value)
        ensure(not values.ndim, f"{said}, this is a batch, {name} has {values.size} values; choose one of them.")


def require_number(
    what: str, value: object, expected: str, *, above: float = -math.inf, least: float = -math.inf,
    most: float = math.inf, below: float = math.inf, kind: str | None = "number",
) -> float:  # fmt: skip
    """Return one finite number within its limits; refuse anything else.

    Parameters
    ----------
    what : str
        What it is given for, as it is written: "efficiency", "gap(width".
    value : object
        What was given.
    expected : str
        What is expected, for the message, without the full stop: "a number is expected, zero or more".
    above, least, most, below : float
        The number is more than `above`, at least `least`, at most `most`, less than `below`.
    kind : str, optional
        What it measures, such as "length": an amount of another kind is refused; None where that is open.

    Raises
    ------
    DefinitionError
        It is no such number.
    """
    if not (is_number(value) and above < value < below and least <= value <= most):
        raise unfit(what, value, expected)
    if kind is not None:
        require_measure(value, kind, what if ")" in what else what.replace("(", ": "))
    return value


def require_whole(what: str, value: object, expected: str, *, least: float = -math.inf, most: float = math.inf) -> int:
    """Return one whole number from `least` to `most`; refuse anything else, as `require_number` does."""
    if not (is_whole(value) and least <= value <= most):
        raise unfit(what, value, expected)
    return int(value)


def require_type(
    what: str, value: object, kind: type[Kind] | tuple[type[Kind], ...], expected: str, of: type | tuple[type, ...] | None = None
) -> Kind:
    """Return a value of a kind, with its parts `of` a kind where that is given; refuse anything else, as `require_number` does."""
    if not isinstance(value, kind) or (of is not None and not all(isinstance(each, of) for each in cast(Iterable[object], value))):
        raise unfit(what, value, expected)
    return value
