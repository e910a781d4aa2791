"""An entry of a file: how one kind of member is read from it and written into it."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping
from inspect import signature
from typing import Any, ClassVar

from pydantic import BaseModel, ConfigDict, model_validator

from ..errors import DefinitionError
from ..plan import Table
from ..quantities import Member
from .design import Design
from .fields import Value
from .limits import LABELS, NAME_LENGTH
from .names import shortened


class Entry(BaseModel):
    """One kind of member in a file: a pydantic model of its keys. A package adds its own kind by a subclass.

    `section` is the table it stands in and `describes` its class. Where a section holds several kinds, the key named as
    the class tells them apart: `B = { Dyad = ["A", "O"], ... }`; `word` is that key, else "". An entry that is no table of
    keys, such as `A = [0.2, 0.55]`, has the one field `bare`. `family`: subclasses of the class are written in the same way.
    """

    model_config = ConfigDict(extra="forbid", frozen=True, arbitrary_types_allowed=True)

    section: ClassVar[str]
    describes: ClassVar[type[Member]]
    word: ClassVar[str] = ""
    family: ClassVar[bool] = False

    @model_validator(mode="before")
    @classmethod
    def _tabled(cls, given: Any) -> Any:
        return cls.tabled(given)

    @classmethod
    def tabled(cls, given: Any) -> Any:
        """Return what is given as a table of fields."""
        if "bare" in cls.model_fields:
            return {"bare": given}
        if not isinstance(given, Mapping):
            raise DefinitionError(f"{shortened(given)} is not a table {{ key = value }} with the keys {', '.join(cls.own_keys())}.")
        return given

    @classmethod
    def own_keys(cls) -> list[str]:
        """Return the keys that an entry may have."""
        return [field.alias or name for name, field in cls.model_fields.items() if name != "labels"]

    @abstractmethod
    def member(self) -> Member:
        """Return the member that this entry says; DefinitionError for what cannot be."""

    @classmethod
    @abstractmethod
    def written(cls, member: Any, design: Design) -> Any:
        """Return a member as what a file holds: numbers, texts, lists, tables of them."""

    @classmethod
    def checked(cls, name: str, member: Member, title: str) -> None:
        """Raise DefinitionError for what is wrong with a member by itself, whatever the others are."""
        table = Table(title)
        for variable, default, kind, unit in member.variables():
            table.add(variable, default, kind, f"{name} = {member}", unit)
        member.enter(table)


class Worded(Entry):
    """An entry that is told apart by its class's name, under which stands what it is built from: `{ Dyad = ["A", "O"], ... }`.

    A subclass says the field `parents`, with that name as its alias, and one for each keyword of its class.
    What a file leaves out is left to the class.
    """

    parents: Any

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        if "describes" in vars(cls):
            cls.word = cls.describes.__name__

    def given(self) -> dict[str, Any]:
        """Return the keywords that the file gives."""
        return {name: getattr(self, name) for name in type(self).model_fields if name in self.model_fields_set - {"parents", "labels"}}

    def member(self) -> Member:
        parents = self.parents if isinstance(self.parents, tuple) else (self.parents,)
        made: Member = self.describes(*parents, **self.given())
        return made


class Labelled(Entry):
    """An entry with labels: every key that is not its own is a length or an angle of its points."""

    labels: dict[str, Value] = {}

    @classmethod
    def tabled(cls, given: Any) -> Any:
        table = super().tabled(given)
        own = cls.own_keys()
        labels = {key: value for key, value in table.items() if key not in own}
        if len(labels) > LABELS:
            raise DefinitionError(f"{len(labels)} labels are too many; up to {LABELS} are read.")
        for key in labels:
            is_label = isinstance(key, str) and key.isidentifier() and len(key) <= 3 * NAME_LENGTH
            if not is_label or key in ("self", *signature(cls.describes).parameters):
                raise DefinitionError(f"{shortened(key)} is not a label; write the points' names joined, such as AB or BOC.")
        return {key: value for key, value in table.items() if key in own} | {"labels": labels}

    @classmethod
    def written_labels(cls, labels: Mapping[str, Any], design: Design) -> dict[str, Any]:
        """Return labels with the values they have in a design; DefinitionError for one that a file would read as something else."""
        for label in labels:
            if label in cls.own_keys():
                raise DefinitionError(f"the label {label} is a word of the file; give one of its points another name.")
        return {label: design.label(label, value) for label, value in labels.items()}
