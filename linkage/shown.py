"""The base of classes that show themselves in a notebook. Their HTML is written on the top floor, which the front door names."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from typing import TYPE_CHECKING, TypeVar

Item = TypeVar("Item")


def text_columns(rows: Sequence[Sequence[str]], left: Collection[int] | None = None) -> str:
    """Return rows of cells as text in columns: those whose numbers are in `left`, by default all, begin below each other, others end so."""
    sizes = [max(map(len, column)) for column in zip(*rows, strict=True)]
    sides = ["<" if left is None or number in left else ">" for number in range(len(sizes))]
    lines = ("  ".join(f"{cell:{side}{size}}" for cell, side, size in zip(row, sides, sizes, strict=True)) for row in rows)
    return "\n".join(line.rstrip() for line in lines)


load_writer: Callable[[], Callable[[object], str]] | None = None
"""Loads the function that returns anything that is `Shown` as HTML, when it is first needed; set by the front door."""


class Shown:
    """The base of objects that a notebook shows as HTML: drawings, tables, sentences."""

    __slots__ = ()

    def _repr_html_(self) -> str | None:
        """Return it as HTML for a notebook."""
        return None if load_writer is None else load_writer()(self)


class HasSentence:
    """The base of objects that print as their `sentence`; a dataclass with `repr=False` is shown as that too."""

    __slots__ = ()

    if TYPE_CHECKING:

        @property
        def sentence(self) -> str:
            """Its description in words."""

    def __str__(self) -> str:
        return self.sentence

    __repr__ = __str__


class ShownList(list[Item], Shown):
    """A list that a notebook shows as HTML."""

    __slots__ = ()
