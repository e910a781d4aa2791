"""The names that a file declares, each with its kind."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias
from unicodedata import normalize

from ..errors import DefinitionError, cited, ensure, is_listed, require, require_type, unknown
from ..quantities import Member, Quantity, Ref, is_name

if TYPE_CHECKING:
    from ..mechanism import Mechanism

FileTable: TypeAlias = Mapping[str, Any]
"""A table of a file: what stands under its keys."""
Keywords: TypeAlias = dict[str, Any]
"""Keywords of a function, or what is written under the keys of a table, by name."""

NAME_LENGTH = 60
DEEPEST_NAME = 12
"""So many names stand in a dotted one at most: those of parts in parts, of a member, of its number."""


@dataclass(frozen=True)
class Names:
    """The members of a file by name: the section each stands in, and its kind (`point`, `quantity`, `guide`, ...)."""

    sections: Mapping[str, str]
    kinds: dict[str, str]
    built: dict[str, Member] = field(default_factory=dict)
    """The members that are read already."""
    machines: Mapping[str, type[Mechanism]] = field(default_factory=dict)
    """The machines that the file holds for its parts."""
    load_beside: Callable[[str], type[Mechanism]] | None = None
    """What loads the machine of another file in the same folder; None of what is written."""
    folder: Path | None = None
    """Where other files stand that it names; None of a text."""
    of_parts: list[str] = field(default_factory=list)
    """The strokes that parts bring, `lower.S`."""

    @property
    def strokes(self) -> list[str]:
        """The names of the machine's strokes, those of its parts included."""
        return [*(name for name, section in self.sections.items() if section == "strokes"), *self.of_parts]

    def quantity(self, name: str) -> Quantity:
        """Return the quantity of a name as a class has it: itself where it stands above, else by its name."""
        found = self.built.get(self.checked(name, "quantity"))
        return found if isinstance(found, Quantity) else Ref(name)

    def checked(self, name: object, kind: str) -> str:
        """Return a name that stands for a member of a kind; DefinitionError, with those there are, for any other."""
        name = require_type("", name, str, f"stands where the name of a {kind} is expected")
        owner, _, own = name.rpartition(".")
        if name not in self.kinds and kind in ("quantity", "link", "point") and self.kinds.get(owner) == "load" and own:
            return name  # what a load holds by a name of its own, such as the length of a cylinder or its barrel
        if name not in self.kinds:
            known = [each for each, its_kind in self.kinds.items() if its_kind == kind]
            raise unknown(kind.capitalize(), name, known)
        ensure(self.kinds[name] == kind, f"{name} of [{self.sections.get(name, 'parts')}] is not a {kind}.")
        return name


def by_whole_names(given: Mapping[str, object], words: Sequence[str] = (), depth: int = 1) -> Iterator[tuple[str, Any]]:
    """Yield the entries of a table by whole names: `lift.bore = 1`, which TOML keeps as a table in a table, as "lift.bore".

    A table with one of some `words` is a value.
    """
    for name, value in given.items():
        if isinstance(value, Mapping) and value and not set(value) & set(words) and depth < DEEPEST_NAME:
            yield from ((f"{name}.{inner}", each) for inner, each in by_whole_names(value, words, depth + 1))
        else:
            yield name, value


NO_NAME = "is not a name: letters, digits and _, no digit first, no word of Python"


def member_name(name: object) -> str:
    """Return a name that a class could bind; DefinitionError for any other."""
    if isinstance(name, str) and not is_name(name) and is_name(normalize("NFKC", name)):
        raise DefinitionError(f"{name!r} is spelled with look-alike letters; write {normalize('NFKC', name)!r}.")
    found = require_type("", name, str, NO_NAME)
    require(is_name(found), "", found, NO_NAME)
    if found.startswith("__") or len(found) > NAME_LENGTH:
        raise DefinitionError(f"{cited(found)} cannot be a name here: up to {NAME_LENGTH} characters, no double _ at the start.")
    return found


def listed(given: object) -> Sequence[Any]:
    """Return the items of a list, or anything but a list as the only one."""
    return given if is_listed(given) else [given]
