"""A document as PDF on A4 pages by matplotlib's own backend: letters that can be selected, lines as vectors, the same bytes every time."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from io import BytesIO
from itertools import zip_longest
from pathlib import Path
from typing import Any, final

from matplotlib import rc_context
from matplotlib.artist import Artist
from matplotlib.backend_bases import GraphicsContextBase
from matplotlib.backends.backend_pdf import FigureCanvasPdf, PdfPages
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.path import Path as Outline
from matplotlib.transforms import IdentityTransform

from ..disk import replacing
from ..formulas.typeset import Box, BoxRow, boxes
from ..language import said
from .breaking import LONGEST, MATH, line_pieces
from .content import Block, Cell, Document, Equality, Formula, Illustration, ListBlock, Mark, Paragraph, Section, TableBlock, captions_of
from .pictures import painted
from .setting import GlyphRun, Ink, InkLine, SetFormula, face, filled_lines, set_formula, width
from .title import TitleBlock

WIDE, HIGH = 595.276, 841.89
LEFT, RIGHT, TOP, BOTTOM = 57.0, 42.0, 48.0, 52.0
"""A4 and its margins: the left one has room for holes."""
ROOM = WIDE - LEFT - RIGHT
TEXT, SMALL, CELL = 8.8, 7.4, 7.2
INK, MUTED, RULE, HEAD, GOOD, BAD = "#1c2733", "#5d6975", "#b9c2ca", "#eef2f5", "#1d6b35", "#b3261e"
INCH = 72.0
SETTINGS: Any = {"pdf.fonttype": 42, "pdf.compression": 6, "font.family": ["DejaVu Sans"], "pdf.use14corefonts": False}


def write_pdf(document: Document, path: Path) -> None:
    """Write a document as PDF; an existing file is replaced whole."""
    content = pdf(document)
    with replacing(path) as stream:
        stream.write(content)


def pdf(document: Document) -> bytes:
    """Return a document as PDF."""
    pages = Flow(document).pages
    stream = BytesIO()
    made_by = dict.fromkeys(("Creator", "Producer"), "hydrolinkage")
    data = {"Title": document.title, "Subject": document.subtitle, **made_by, "CreationDate": None}
    with rc_context(SETTINGS), PdfPages(stream, metadata=data) as book:
        for number, page in enumerate(pages, 1):
            book.savefig(page.figure(document, number, len(pages)))
    return stream.getvalue()


@final
@dataclass
class Page:
    """What stands on a page: ink, its y down from the page's top, and pictures with the place of their upper left corner."""

    ink: list[Ink] = field(default_factory=list)
    pictures: list[tuple[Illustration, float, float]] = field(default_factory=list)

    def figure(self, document: Document, number: int, count: int) -> Figure:
        """Return the page as a figure, with its foot."""
        figure = Figure(figsize=(WIDE / INCH, HIGH / INCH))
        FigureCanvasPdf(figure)
        for picture, x, y in self.pictures:
            painted(figure, picture, (x / INCH, (HIGH - y) / INCH - picture.size[1]))
        foot, of = HIGH - 30.0, said("page {n} of {all}", n=number, all=count)
        line = InkLine(((LEFT, foot - 11.0), (WIDE - RIGHT, foot - 11.0)), 0.4, RULE)
        words = [filled_lines(f"{document.footer}", ROOM - 90.0, SMALL)[0], of]
        places = [LEFT, WIDE - RIGHT - width(of, SMALL)]
        feet = [GlyphRun(x, foot, text, SMALL, "regular", MUTED) for text, x in zip(words, places, strict=True)]
        figure.add_artist(InkArtist([*self.ink, line, *feet]))
        return figure


@final
class InkArtist(Artist):
    """Draws ink on a page, straight by the backend: its y goes down from the page's top [points]."""

    def __init__(self, ink: Sequence[Ink]) -> None:
        super().__init__()
        self.ink = ink

    def draw(self, renderer: Any) -> None:
        context = renderer.new_gc()
        for each in self.ink:
            if isinstance(each, GlyphRun):
                context.set_foreground(each.colour)
                properties = face(each.face).copy()
                properties.set_size(each.size)
                renderer.draw_text(context, each.x, HIGH - each.y, each.text, properties, 0.0)
            else:
                self.line(renderer, context, each)
        context.restore()

    def line(self, renderer: Any, context: GraphicsContextBase, each: InkLine) -> None:
        """Draw a line or an area."""
        outline = Outline([(x, HIGH - y) for x, y in each.points])
        context.set_foreground(each.colour)
        context.set_linewidth(0.0 if each.fill else each.width)
        context.set_capstyle("round")
        renderer.draw_path(context, outline, IdentityTransform(), to_rgb(each.colour) if each.fill else None)


# The flow of blocks down the pages.


@final
class Flow:
    """Sets a document's blocks one below the other, and begins a new page where one is full."""

    def __init__(self, document: Document) -> None:
        self.pages: list[Page] = [Page()]
        self.y = TOP
        self.captions = captions_of(document.sections)
        self.head(document)
        for number, section in enumerate(document.sections, 1):
            self.section(number, section)

    def take(self, height: float) -> float:
        """Return where something of a height begins, on a new page if there is no room on this one."""
        if self.y + height > HIGH - BOTTOM and self.y > TOP:
            self.pages.append(Page())
            self.y = TOP
        start = self.y
        self.y += height
        return start

    def keep(self, height: float) -> None:
        """Begin a new page if something of a height does not fit on this one."""
        self.take(height)
        self.y -= height

    def put(self, *ink: Ink) -> None:
        """Draw on the page."""
        self.pages[-1].ink += ink

    def set(self, each: SetFormula, x: float, line: float, colour: str = "#000000") -> None:
        """Draw a formula with its line at a height."""
        for ink in each.ink:
            if isinstance(ink, GlyphRun):
                self.put(GlyphRun(x + ink.x, line - ink.y, ink.text, ink.size, ink.face, colour))
            else:
                self.put(InkLine(tuple((x + px, line - py) for px, py in ink.points), ink.width, colour, ink.fill))

    def words(
        self, text: str, size: float = TEXT, name: str = "regular", colour: str = INK, after: float = 4.0, mark: str = ""
    ) -> None:
        """Draw a paragraph, its lines behind a mark where there is one."""
        inset = 11.0 if mark else 0.0
        for place, line in enumerate(filled_lines(text, ROOM - inset, size, name)):
            y = self.take(1.38 * size)
            if mark and not place:
                self.put(GlyphRun(LEFT, y + size, mark, size, name, colour))
            self.put(GlyphRun(LEFT + inset, y + size, line, size, name, colour))
        self.y += after

    # -- blocks ----------------------------------------------------------------------------------------

    def head(self, document: Document) -> None:
        """Draw the title and the title block."""
        self.words(document.title, 17.0, "bold", after=0.0)
        self.words(f"{said('Calculation report')}. {document.subtitle}", TEXT, colour=MUTED, after=7.0)
        self.title_block(document.block)
        rows = tuple((name, document.verdict if value == document.verdict.word else value) for name, value in document.facts)
        self.draw_table(TableBlock("", ("", ""), rows, "lm"), "", headed=False)

    def title_block(self, block: TitleBlock) -> None:
        """Draw the title block across the page: a box for each field, and a line for each who signs."""
        top = self.y
        shares = (0.25, 0.15, 0.2, 0.4)
        edges = [LEFT + ROOM * sum(shares[:place]) for place in range(len(shares) + 1)]
        fields = [filled_lines(value, ROOM * share - 8.0, TEXT, "bold") for (_, value), share in zip(block.entries, shares, strict=True)]
        below = top + 13.0 + LINE * max(2, *map(len, fields))
        for (name, _), lines, left, right in zip(block.entries, fields, edges, edges[1:], strict=False):
            self.put(GlyphRun(left + 4.0, top + 8.5, name, SMALL, "regular", MUTED))
            for line, text in enumerate(lines):
                self.put(GlyphRun(left + 4.0, top + 20.0 + LINE * line, text, TEXT, "bold", INK))
            self.put(InkLine(((right, top), (right, below)), 0.4, RULE))
        y, names = below, (0.14, 0.36, 0.18, 0.32)
        starts = [LEFT + ROOM * sum(names[:place]) for place in range(len(names) + 1)]
        for x, text in zip(starts, block.columns, strict=False):
            self.put(GlyphRun(x + 4.0, y + 9.0, text, SMALL, "regular", MUTED))
        y += 12.0
        for what, name in block.signatures:
            self.put(InkLine(((LEFT, y), (LEFT + ROOM, y)), 0.4, RULE))
            self.put(GlyphRun(starts[0] + 4.0, y + 12.5, what, SMALL, "regular", MUTED))
            lines = filled_lines(name, ROOM * names[1] - 8.0, TEXT)
            for line, text in enumerate(lines):
                self.put(GlyphRun(starts[1] + 4.0, y + 12.5 + LINE * line, text, TEXT, "regular", INK))
            y += 7.5 + LINE * len(lines)
        for x in starts[1:-1]:
            self.put(InkLine(((x, below), (x, y)), 0.4, RULE))
        self.put(InkLine(((LEFT, below), (LEFT + ROOM, below)), 0.9, INK))
        self.put(InkLine(((LEFT, top), (LEFT + ROOM, top), (LEFT + ROOM, y), (LEFT, y), (LEFT, top)), 1.1, INK))
        self.y = y + 8.0

    def section(self, number: int, section: Section) -> None:
        """Draw a section; small pictures stand in pairs."""
        self.y += 10.0
        first = section.blocks[0] if section.blocks else None
        room = 30.0 + first.size[1] * INCH if isinstance(first, Illustration) else 70.0  # a title goes with what it is the title of
        if isinstance(first, Paragraph) and section.blocks[1:] and isinstance(section.blocks[1], TableBlock):
            room += 1.38 * TEXT * len(filled_lines(first.text, ROOM, TEXT)) + 20.0
        self.keep(room)
        y = self.take(22.0)
        self.put(GlyphRun(LEFT, y + 12.0, f"{number}. {section.title}", 11.5, "bold", INK))
        self.put(InkLine(((LEFT, y + 16.5), (WIDE - RIGHT, y + 16.5)), 0.9, INK))
        waiting: list[Illustration] = []
        for block, following in zip_longest(section.blocks, section.blocks[1:]):
            if isinstance(block, Paragraph) and isinstance(following, (ListBlock, TableBlock)):
                self.keep(1.38 * TEXT * len(filled_lines(block.text, ROOM, TEXT)) + FOLLOWING)
            if isinstance(block, Illustration) and block.size[0] * INCH < 0.55 * ROOM:
                waiting.append(block)
                if len(waiting) < 2:
                    continue
            if waiting:
                self.pictures(waiting)
            if not (waiting and block is waiting[-1]):
                self.block(block)
            waiting = []
        if waiting:
            self.pictures(waiting)

    def block(self, block: Block) -> None:
        """Draw a block."""
        if isinstance(block, Paragraph):
            self.words(block.text)
        elif isinstance(block, ListBlock):
            for text in block.texts:
                self.words(text, mark="–", after=1.5)
            self.y += 3.0
        elif isinstance(block, TableBlock):
            self.draw_table(block, self.captions.get(id(block), ""))
        elif isinstance(block, Equality):
            self.equality(block)
        elif isinstance(block, Illustration):
            self.pictures([block])

    def pictures(self, row: Sequence[Illustration]) -> None:
        """Draw one picture, or two beside each other, with their captions."""
        room = ROOM / len(row) if len(row) > 1 else min(ROOM, max(row[0].size[0] * INCH, 0.5 * ROOM))
        captions = [filled_lines(self.captions.get(id(each), each.caption), room - 6.0, SMALL) for each in row]
        high = max(each.size[1] for each in row) * INCH
        y = self.take(high + 1.4 * SMALL * max(map(len, captions)) + 8.0)
        for place, (each, lines) in enumerate(zip(row, captions, strict=True)):
            x = LEFT + place * room
            self.pages[-1].pictures.append((each, x, y))
            for line, text in enumerate(lines):
                self.put(GlyphRun(x, y + high + (1.2 + 1.35 * line) * SMALL, text, SMALL, "regular", MUTED))

    def equality(self, block: Equality) -> None:
        """Draw an equation with its number, broken where it is too long."""
        indent, room = INDENT, ROOM - INDENT
        lines: list[list[SetFormula]] = [[]]
        used = 0.0
        for each in equality_pieces(block):
            if lines[-1] and used + each.width > room:
                lines.append([])
                used = FURTHER
            lines[-1].append(each)
            used += each.width + 2.0
        for number, parts in enumerate(lines):
            up, down = max(each.height for each in parts), max(each.depth for each in parts)
            y = self.take(up + down + 3.6)
            if not number and block.number:
                self.put(GlyphRun(LEFT, y + up, f"({block.number})", TEXT, "regular", MUTED))
            x = LEFT + indent + (FURTHER if number else 0.0)
            for each in parts:
                self.set(each, x, y + up)
                x += each.width + 2.0
        self.y += 2.4

    # -- tables ----------------------------------------------------------------------------------------

    def draw_table(self, grid: TableBlock, caption: str, headed: bool = True) -> None:
        """Draw a table; its head is repeated on every page."""
        widths = column_widths(grid)
        body = [row_lines(row, widths, grid.columns) for row in grid.rows]
        head = [filled_lines(text, wide - 5.0, CELL, "bold") for text, wide in zip(grid.headings, widths, strict=True)]
        head_high = 1.32 * CELL * max(map(len, head)) + 4.0
        if caption:
            y = self.take(1.4 * SMALL + head_high + 30.0)
            self.y = y + 1.5 * SMALL
            self.put(GlyphRun(LEFT, y + SMALL, caption, SMALL, "regular", MUTED))
        if headed:
            self.table_head(head, widths, grid.columns, head_high)
        for row, cells in zip(grid.rows, body, strict=True):
            highs = [each.height + each.depth if isinstance(each, SetFormula) else 1.32 * CELL * len(each) for each in cells]
            high = max(1.32 * CELL, *highs) + 3.4
            pages = len(self.pages)
            y = self.take(high)
            if len(self.pages) > pages and headed:
                self.y = y
                self.table_head(head, widths, grid.columns, head_high)
                y = self.take(high)
            self.table_row(row, cells, widths, grid.columns, y, high)
        self.y += 7.0

    def table_head(self, head: Sequence[Sequence[str]], widths: Sequence[float], columns: str, high: float) -> None:
        """Draw the headings of a table."""
        y, x, end = self.take(high), LEFT, LEFT + sum(widths)
        self.put(InkLine(((x, y), (end, y), (end, y + high), (x, y + high), (x, y)), 0.0, HEAD, fill=True))
        for lines, wide, kind in zip(head, widths, columns, strict=True):
            for place, text in enumerate(lines):
                at = x + wide - 2.5 - width(text, CELL, "bold") if kind == "r" else x + 2.5
                self.put(GlyphRun(at, y + high - 2.6 - 1.32 * CELL * (len(lines) - 1 - place), text, CELL, "bold", INK))
            x += wide
        for level in (y, y + high):
            self.put(InkLine(((LEFT, level), (end, level)), 0.6, INK))

    def table_row(self, row: Sequence[Cell], cells: Sequence[Any], widths: Sequence[float], columns: str, y: float, high: float) -> None:
        """Draw a row of a table."""
        x = LEFT
        for value, lines, wide, kind in zip(row, cells, widths, columns, strict=True):
            if isinstance(lines, SetFormula):
                self.set(lines, x + 2.5, y + 1.7 + max(lines.height, CELL), INK)
            else:
                colour = INK if not isinstance(value, Mark) or value.ok is None else GOOD if value.ok else BAD
                name = "bold" if isinstance(value, Mark) else "regular"
                for place, text in enumerate(lines):
                    at = x + wide - 2.5 - width(text, CELL, name) if kind == "r" else x + 2.5
                    self.put(GlyphRun(at, y + 1.5 + CELL * (1.0 + 1.32 * place), text, CELL, name, colour))
            x += wide
        self.put(InkLine(((LEFT, y + high), (x, y + high)), 0.35, RULE))


FOLLOWING = 60.0
"""The room that a list or a table needs under the words before it."""
LINE = 10.5
"""From line to line in the title block."""
INDENT, FURTHER = 30.0, 14.0
"""How far in an equation begins, and how much further its next lines."""


def fitting(piece: Box) -> SetFormula:
    """Return a piece, set; smaller where it is wider than a line and cannot be broken."""
    found = set_formula(piece, MATH)
    return found if found.width <= LONGEST else set_formula(piece, MATH * LONGEST / found.width)


LEAST = 0.65
"""A side of numbers that would be set smaller than this share is left out: what it comes to follows."""


def readable(steps: Sequence[str]) -> list[str]:
    """Return the sides of an equation without numbers that would be too small to read: neither the first two nor the last."""
    return [
        step for place, step in enumerate(steps)
        if place < 2 or place == len(steps) - 1
        or all(set_formula(each, MATH).width <= LONGEST / LEAST for each in line_pieces(step))
    ]  # fmt: skip


def equality_pieces(block: Equality) -> Iterator[SetFormula]:
    """Yield the pieces of an equation, set; all but the first of a step's that follow another begin with its sign of equality."""
    equals = set_formula(boxes("= "), MATH)
    for place, step in enumerate(readable(block.steps)):
        for first, piece in enumerate(line_pieces(step)):
            each = fitting(BoxRow((BoxRow(()), piece)) if first else piece)  # so that a sign in front has room on both sides
            if not place or first:
                yield each
            else:
                lead = 0.35 * MATH + equals.width + 0.35 * MATH
                ink = (*equals.at(0.35 * MATH, 0.0), *each.at(lead, 0.0))
                yield SetFormula(lead + each.width, max(each.height, equals.height), max(each.depth, equals.depth), ink)


def column_widths(grid: TableBlock) -> list[float]:
    """Return the widths of a table's columns: as its texts ask, long ones in what is left."""
    natural = []
    for place in range(len(grid.columns)):
        whole, words = grid.headings[place], [width(word, CELL, "bold") for word in grid.headings[place].split()] or [0.0]
        body = max((cell_width(row[place]) for row in grid.rows), default=0.0)
        in_one_line = width(whole, CELL, "bold")
        natural.append(6.0 + (in_one_line if in_one_line < 1.5 * body + 8.0 else max(body, *words)))
        natural[-1] = max(natural[-1], 6.0 + body)
    over = sum(natural) - ROOM
    words = [
        6.0 + max([30.0, *(width(word, CELL, "bold") for word in head.split()), *(longest_word(row[place]) for row in grid.rows)])
        for place, head in enumerate(grid.headings)
    ]
    for kinds, least in (("l", 0.24 * ROOM), ("m", 0.42 * ROOM), ("l", 0.0), ("m", 0.0), ("lrm", 0.0)):
        floors = [max(least, word) if kinds != "lrm" else 30.0 for word in words]
        soft = [place for place, kind in enumerate(grid.columns) if kind in kinds and natural[place] > floors[place]]
        total = sum(natural[place] - floors[place] for place in soft)
        if over > 0.0 and total > 0.0:
            share = min(1.0, over / total)
            cut = {place: share * (natural[place] - floors[place]) for place in soft}
            natural = [wide - cut.get(place, 0.0) for place, wide in enumerate(natural)]
            over -= sum(cut.values())
    return natural


def longest_word(value: Cell) -> float:
    """Return the width of a cell's longest word, of a formula its own."""
    if isinstance(value, Formula):
        return cell_width(value)
    text = value.word if isinstance(value, Mark) else value
    return max((width(word, CELL, "bold" if isinstance(value, Mark) else "regular") for word in text.split()), default=0.0)


def cell_width(value: Cell) -> float:
    """Return how wide a cell would be in one line."""
    if isinstance(value, Formula):
        return set_formula(boxes(value.latex), CELL).width
    return width(value.word, CELL, "bold") if isinstance(value, Mark) else width(value, CELL)


def row_lines(row: Sequence[Cell], widths: Sequence[float], columns: str) -> list[Any]:
    """Return the cells of a row: lines of text, or a formula that is set."""
    found: list[Any] = []
    for value, wide in zip(row, widths, strict=True):
        if isinstance(value, Formula):
            found.append(set_formula(boxes(value.latex), CELL))
        else:
            name = "bold" if isinstance(value, Mark) else "regular"
            found.append(filled_lines(value.word if isinstance(value, Mark) else value, wide - 4.9, CELL, name))
    return found
