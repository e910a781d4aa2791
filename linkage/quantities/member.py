"""What a mechanism's class may bind to a name, and how members refer to each other: by that name."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, ClassVar, Self, TypeAlias

from ..errors import DefinitionError
from ..frozen import FrozenDict


class Member:
    """Anything that a mechanism's class declares.

    Its name is the first one it is bound to. Members refer to each other by name, so that a subclass
    which replaces a member replaces it for everybody.
    """

    kind: ClassVar[str] = "member"
    """What it is where a reference asks for it: `point`, `vector`, `quantity`, `guide`, ..."""

    expects: ClassVar[tuple[tuple[str, str], ...]] = ()
    """Its attributes that refer to others, with the kind each must be."""

    _name: str = ""
    _class: str = ""
    """The class that it was declared in, once that is complete: from then on it does not change."""

    def __setattr__(self, name: str, value: Any) -> None:
        if self._class:
            raise self._unchanging(name)
        object.__setattr__(self, name, value)

    def __delattr__(self, name: str) -> None:
        if self._class:
            raise self._unchanging(name)
        object.__delattr__(self, name)

    def _unchanging(self, name: str) -> DefinitionError:
        """Return the error for a change of what a class was made of."""
        what = f"{self._class}.{self.name}.{name} = ..."
        remedy = f"write a subclass, class Other({self._class}): {self.name} = ..."
        return DefinitionError(f"{what}: {self._class} is worked out already and would not follow; {remedy}, or set a dimension.")

    def settle(self, title: str) -> None:
        """Let nothing of this member change any more: the class `title` is made of it."""
        for name, value in vars(self).items():
            if type(value) is dict:
                object.__setattr__(self, name, FrozenDict(value))
        if not self._class:
            object.__setattr__(self, "_class", title)

    def __copy__(self) -> Self:
        return self.renewed()

    def __set_name__(self, owner: type, name: str) -> None:
        if not self._name:
            object.__setattr__(self, "_name", name)

    @property
    def name(self) -> str:
        """The name in the class; empty for a part of an expression."""
        return self._name

    def parts(self) -> tuple[Reference, ...]:
        """Return what this member is built from: names or members."""
        return ()

    def variables(self) -> tuple[tuple[str, float, str, str], ...]:
        """Return the design variables this member brings: name, default [SI], what it measures, display unit or ""."""
        return ()

    def having(self, values: Mapping[str, float]) -> Self:
        """Return this member with the design variables among its numbers at other values [SI], by their name or label."""
        return self

    def renewed(self, **changes: Any) -> Self:
        """Return this member with attributes changed, under its own name."""
        changed = object.__new__(type(self))
        for name, value in {**vars(self), **changes}.items():
            if name != "_class":  # it is free to change until a class is made of it
                object.__setattr__(changed, name, value)
        return changed

    def enter(self, claims: Any) -> None:
        """Enter the labels of this member in the mechanism's table of dimensions."""

    def lengths(self) -> tuple[Any, ...]:
        """Return the quantities that stand for lengths in this member, beside its labels: none may be negative."""
        return ()

    def examine(self, members: Any, title: str) -> None:
        """Raise DefinitionError for what only the whole class tells to be wrong: its members by name, its title."""

    def sides(self, where: Any) -> tuple[tuple[str, Any], ...]:
        """Return the triangle this member closes, as labelled lengths [m]; empty where it closes none."""
        return ()


Reference: TypeAlias = str | Member


def name_of(reference: Reference) -> str:
    """Return the name a reference stands for; raise DefinitionError for a member without one."""
    if isinstance(reference, str):
        return reference
    if not isinstance(reference, Member):
        raise DefinitionError(f"{reference!r} stands where a point or its name is expected.")
    if not reference.name:
        said = f"{reference} is used before it has a name, or its name is bound twice"
        raise DefinitionError(f"{said}: bind it to a name of its own in the class, or write the name as a string.")
    return reference.name


def needs(member: Member) -> Iterator[str]:
    """Yield the names that a member needs, through its unnamed parts."""
    for part in member.parts():
        if isinstance(part, Member) and not part.name:
            yield from needs(part)
        else:
            yield name_of(part)


def unnamed(member: Member) -> Iterator[Member]:
    """Yield the parts of a member that have no name of their own, through all depths."""
    for part in member.parts():
        if isinstance(part, Member) and not part.name:
            yield part
            yield from unnamed(part)
