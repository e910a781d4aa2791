"""The base of entries of force elements: what they act on under the class's name, their numbers under names of their own."""

from __future__ import annotations

from dataclasses import MISSING, fields, is_dataclass
from typing import Any, ClassVar

from ..errors import DefinitionError
from ..loads import ForceElement
from ..quantities import name_of
from .design import Design, option
from .entry import Worded


class ElementEntry(Worded):
    """The base of entries of force elements, whose numbers and options stand under their own names.

        class DragEntry(ElementEntry):
            describes = Drag
            parents: PointName = Field(alias="Drag")
            area: Amount
            density: Amount = None
    """

    section: ClassVar[str] = "loads"

    @classmethod
    def written(cls, member: Any, design: Design) -> Any:
        return {cls.word: cls.written_parents(member)} | cls.written_numbers(member, design)

    @classmethod
    def written_parents(cls, member: Any) -> Any:
        """Return its points by name: one, or a list."""
        names = [name_of(getattr(member, place)) for place in member.places]
        return names[0] if len(names) == 1 else names

    @classmethod
    def written_numbers(cls, member: ForceElement, design: Design) -> dict[str, Any]:
        """Return its parameters and options, without those that are as they usually are."""
        given = {name: design.amount(getattr(member, name), unit, f"{member.name}.{name}") for name, unit in member.numbers.items()}
        usual: dict[str, Any] = {each.name: each.default for each in fields(member)} if is_dataclass(member) else {}
        said = {name: value for name, value in given.items() if repr(value) != repr(usual.get(name, MISSING))}
        return said | {name: option(value) for name, value in cls.kept(member).items()}

    @classmethod
    def kept(cls, member: ForceElement) -> dict[str, Any]:
        """Return the options that the file has keys for; DefinitionError for one without."""
        for name in member.options():
            if name not in cls.model_fields:
                raise DefinitionError(f"a file has no key for {name} of a {cls.word}; leave it as it usually is.")
        return member.options()
