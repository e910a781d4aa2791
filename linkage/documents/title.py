"""The title block of a document: its number, for whom it is, and who signs it."""

from __future__ import annotations

from dataclasses import dataclass, fields

from ..errors import require
from ..language import said


@dataclass(frozen=True)
class TitleBlock:
    """The lines of a title block, each as text; "" leaves an empty line to write on. DefinitionError for anything but one line of text."""

    number: str = ""
    revision: str = ""
    date: str = ""
    client: str = ""
    prepared: str = ""
    checked: str = ""
    approved: str = ""

    def __post_init__(self) -> None:
        for each in fields(self):
            value = getattr(self, each.name)
            fits = isinstance(value, str) and value.isprintable()
            require(fits, each.name, value, f'a text in one line is expected, such as {each.name}="R-104"')

    @property
    def entries(self) -> tuple[tuple[str, str], ...]:
        """The fields above the signatures, each with its name."""
        return (
            (said("report No."), self.number), (said("revision"), self.revision), (said("date"), self.date), (said("client"), self.client)
        )  # fmt: skip

    @property
    def signatures(self) -> tuple[tuple[str, str], ...]:
        """The words for each signature, and the name."""
        return (said("prepared"), self.prepared), (said("checked"), self.checked), (said("approved"), self.approved)

    @property
    def columns(self) -> tuple[str, str, str, str]:
        """The headings of the lines to sign on."""
        return "", said("name"), said("date"), said("signature")

    @property
    def short(self) -> str:
        """Its number and revision in one line, for the foot of a page; "" without a number."""
        if not self.number:
            return ""
        return said("{number}, revision {revision}", number=self.number, revision=self.revision) if self.revision else self.number


FIELDS = tuple(each.name for each in fields(TitleBlock))
