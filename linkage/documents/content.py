"""The contents of a document in any format: sections of text, tables, equations, pictures, a title block."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import groupby
from typing import TYPE_CHECKING, TypeAlias

from ..frozen import record
from ..language import said

if TYPE_CHECKING:
    from matplotlib.axes import Axes
from dataclasses import fields

from ..errors import require


@record
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


@record
class Formula:
    """A formula in LaTeX, as part of a text or a table."""

    latex: str


@record
class Mark:
    """Whether a rule is kept: its word, and whether that is good; None where it is neither."""

    ok: bool | None
    word: str

    @classmethod
    def of(cls, ok: bool | None, silent: str) -> Mark:
        """Return the mark of a rule; `silent` is its word where it says nothing."""
        return cls(ok, silent if ok is None else said("kept") if ok else said("not kept"))


Cell: TypeAlias = str | Formula | Mark
HALF, BESIDE, FORMULA = 50, 3, 8
"""Letters that half a page has room for, that stand beside a cell, and that a formula or a mark takes at the most."""


@record
class TableBlock:
    """A table: headings, rows, and how each column stands, "l" to the left, "r" as numbers do, "m" for long text."""

    caption: str
    headings: tuple[str, ...]
    rows: tuple[tuple[Cell, ...], ...]
    columns: str

    @property
    def filled(self) -> TableBlock:
        """It without the columns that are empty in every row."""
        said_in = [k for k in range(len(self.headings)) if not self.rows or any(row[k] != "" for row in self.rows)]
        heads, rows = tuple(self.headings[k] for k in said_in), tuple(tuple(row[k] for k in said_in) for row in self.rows)
        return TableBlock(self.caption, heads, rows, "".join(self.columns[k] for k in said_in))

    @property
    def letters(self) -> int:
        """About how wide it is, in letters."""
        cells = zip(self.headings, *self.rows, strict=True)
        return sum(BESIDE + max(len(each) if isinstance(each, str) else FORMULA for each in column) for column in cells)


@record
class Equality:
    """An equation in LaTeX: its number, 0 for none, and the terms between its signs of equality."""

    number: int
    steps: tuple[str, ...]


@record
class Illustration:
    """A picture: its name, its size [inch], the room beside its axes [inch: left, right, bottom, top], and its paint function."""

    name: str
    caption: str
    size: tuple[float, float]
    room: tuple[float, float, float, float]
    paint: Callable[[Axes], None]


Block: TypeAlias = str | tuple[str, ...] | TableBlock | Equality | Illustration
"""A paragraph of some sentences; short texts below each other, each with a mark in front; a table, an equation, a picture."""


@record
class Section:
    """A numbered section."""

    title: str
    blocks: tuple[Block, ...]

    @property
    def rows(self) -> Iterator[tuple[bool, tuple[Block, ...]]]:
        """Its blocks one by one; small pictures that follow each other in one row, and so two small tables, which True marks."""
        for kind, group in groupby(self.blocks, small_kind):
            blocks = tuple(group)
            if kind is Illustration:
                yield True, blocks
            elif kind is TableBlock:
                yield from ((len(blocks[place : place + 2]) > 1, blocks[place : place + 2]) for place in range(0, len(blocks), 2))
            else:
                yield from ((False, (each,)) for each in blocks)


def small_kind(block: Block) -> type | None:
    """Return the kind of a block that half a page has room for, of which others may stand beside it; None for any other."""
    match block:
        case Illustration():
            return Illustration if block.size[0] < 4.0 else None
        case TableBlock():
            return TableBlock if block.letters <= HALF else None
    return None


@record
class Document:
    """A whole document: its title, its title block, its facts, and its sections."""

    title: str
    subtitle: str
    block: TitleBlock
    facts: tuple[tuple[str, str], ...]
    verdict: Mark
    sections: tuple[Section, ...]
    language: str

    @property
    def footer(self) -> str:
        """The foot of every page, beside its number."""
        return " · ".join(each for each in (self.block.short, self.title) if each)


def captions_of(sections: Sequence[Section]) -> dict[int, str]:
    """Return the captions of tables and pictures with their numbers, in the language that is spoken, by the identity of the block."""
    found: dict[int, str] = {}
    tables = figures = 0
    for block in (block for section in sections for block in section.blocks):
        if isinstance(block, TableBlock) and block.caption:
            tables += 1
            found[id(block)] = said("Table {n}. {text}", n=tables, text=block.caption)
        elif isinstance(block, Illustration):
            figures += 1
            found[id(block)] = said("Figure {n}. {text}", n=figures, text=block.caption)
    return found
