"""Frozen values: read-only arrays and tables, copies of a user's values, masks that are not lost."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, fields
from functools import cached_property
from operator import attrgetter
from reprlib import recursive_repr
from typing import Any, ClassVar, NoReturn, TypeVar, cast, dataclass_transform

import numpy as np
import numpy.typing as npt

from .errors import DefinitionError

Key = TypeVar("Key")
Value = TypeVar("Value")
Kind = TypeVar("Kind", bound=type)


class FrozenDict(dict[Key, Value]):
    """A dict that does not change; `dict(...)` of it is a copy that does."""

    @cached_property
    def is_of_floats(self) -> bool:
        """Whether all values are plain floats, as the dimensions of one design are."""
        return {float}.issuperset(map(type, self.values()))

    @cached_property
    def as_floats(self) -> tuple[float, ...]:
        """All values as floats, in their order."""
        return tuple(map(float, cast(Iterable[float], self.values())))

    @cached_property
    def by_kind(self) -> dict[type, dict[Key, Value]]:
        """What has been looked up of it by the kind of its values."""
        return {}

    def _refuse(self, *given: object, **named: object) -> NoReturn:
        raise DefinitionError("These values are what was worked out or declared, and do not change; take a copy of them, dict(...).")

    __setitem__ = __delitem__ = pop = popitem = clear = update = setdefault = __ior__ = _refuse

    def __reduce__(self) -> tuple[type, tuple[dict[Key, Value]]]:
        return type(self), (dict(self),)


def read_only(array: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """Return a view of an array that cannot be written."""
    view = array.view()
    view.flags.writeable = False
    return view


def frozen(given: object) -> npt.NDArray[np.float64]:
    """Return a read-only copy of numbers as floats."""
    return read_only(np.array(given, float))


def unmasked(value: object) -> object:
    """Return a masked array of numbers as floats with NaN in the places that are masked; anything else as it is."""
    if isinstance(value, np.ma.MaskedArray) and value.dtype.kind in "fiu":
        return np.ma.filled(value.astype(float), np.nan)
    return value


def frozen_copy(value: Any) -> object:
    """Return a frozen copy of a user's value: arrays read-only, lists as tuples, dicts frozen."""
    if isinstance(value, np.ndarray) and type(value) in (np.ndarray, np.ma.MaskedArray):
        return read_only(np.array(unmasked(value)))
    if type(value) in (list, tuple):
        return tuple(map(frozen_copy, value))
    if isinstance(value, Mapping):
        return FrozenDict({name: frozen_copy(each) for name, each in value.items()})
    return value


UNCHANGING = (bool, int, float, str, type(None), np.float64)
"""Types of values that are their own frozen copies."""


def keep_own(holder: object) -> None:
    """Replace the values of a frozen dataclass by frozen copies."""
    for name, value in vars(holder).items():
        if type(value) not in UNCHANGING:
            object.__setattr__(holder, name, frozen_copy(value))


class Unchanging:
    """The methods that all classes of frozen values have: each is written here once, since compiling one takes a fifth of a millisecond."""

    _compared: ClassVar[Any]

    def __setattr__(self, name: str, *value: object) -> NoReturn:
        title = type(self).__name__
        remedy = f"make a new one, {title}(...), or dataclasses.replace of this one"
        raise DefinitionError(f"{title}.{name} = ...: it does not change; {remedy}.")

    def __delattr__(self, name: str) -> NoReturn:
        Unchanging.__setattr__(self, name)

    @recursive_repr()
    def __repr__(self: Any) -> str:
        return f"{type(self).__qualname__}({', '.join(f'{each.name}={getattr(self, each.name)!r}' for each in fields(self) if each.repr)})"

    def __eq__(self, other: object) -> bool:
        return self._compared(self) == self._compared(other) if type(other) is type(self) else NotImplemented

    def __hash__(self) -> int:
        return hash(self._compared(self))


def refuses_changes(kind: Kind, *methods: Callable[..., object]) -> Kind:
    """Let a class of frozen values refuse changes in words, and have further methods: a class decorator."""
    for each in (Unchanging.__setattr__, Unchanging.__delattr__, *methods):
        setattr(kind, each.__name__, each)
    return kind


@dataclass_transform(frozen_default=True, eq_default=False, field_specifiers=(field,))
def immutable(kind: Kind) -> Kind:
    """Make a class a frozen dataclass whose objects are told apart by identity, and which refuses changes in words: a class decorator."""
    own_repr = vars(kind).get("__repr__", Unchanging.__repr__)
    dataclass(frozen=True, eq=False, repr=False)(kind)
    return refuses_changes(kind, own_repr)


@dataclass_transform(frozen_default=True, eq_default=True, field_specifiers=(field,))
def record(kind: Kind) -> Kind:
    """Make a class a frozen dataclass whose objects are equal where their values are, and which refuses changes: a class decorator."""
    compared = attrgetter("__class__", *(each.name for each in fields(immutable(kind)) if each.compare))
    setattr(kind, "_compared", compared)  # noqa: B010
    return refuses_changes(kind, Unchanging.__eq__, Unchanging.__hash__)
