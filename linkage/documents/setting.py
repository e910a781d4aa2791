"""Formulas and words set in type by hand, in DejaVu Sans: how wide they are, and what is drawn where. Lengths in printer's points."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import TypeAlias, final

import numpy as np
from matplotlib.font_manager import FontProperties, fontManager, get_font
from matplotlib.ft2font import LoadFlags

from ..formulas.typeset import Arrowed, Box, BoxRow, Fenced, Fraction, Lines, Rooted, Script, Sign

FACES = {"regular": ("normal", "normal"), "italic": ("italic", "normal"), "bold": ("normal", "bold")}
EM = 1000


@lru_cache(maxsize=8)
def face(name: str) -> FontProperties:
    """Return a face of the font: regular, italic or bold."""
    slope, weight = FACES[name]
    return FontProperties(family="DejaVu Sans", style="oblique" if slope == "italic" else "normal", weight=weight)


@lru_cache(maxsize=8192)
def advance(letter: str, name: str) -> float:
    """Return the width of a letter in a face at the size 1; of one that the font does not have, a square."""
    font = get_font(fontManager.findfont(face(name)))
    if not font.get_char_index(ord(letter)):
        return 1.0
    font.set_size(EM, 72)
    return float(font.load_char(ord(letter), flags=LoadFlags.NO_HINTING).linearHoriAdvance) / 65536.0 / EM


def width(text: str, size: float, name: str = "regular") -> float:
    """Return the width of a text in a face and size."""
    return size * sum(advance(letter, name) for letter in text)


def filled_lines(text: str, room: float, size: float, name: str = "regular") -> list[str]:
    """Return a text in lines that fit a room; a word that is too long is cut."""
    lines = [""]
    for word in text.split():
        longer = f"{lines[-1]} {word}".lstrip()
        if width(longer, size, name) <= room:
            lines[-1] = longer
            continue
        if lines[-1]:
            lines.append("")
        while width(word, size, name) > room and len(word) > 1:
            count = max(1, next(k for k in range(1, len(word) + 1) if width(word[:k], size, name) > room) - 1)
            lines[-1:] = [word[:count], ""]
            word = word[count:]
        lines[-1] = word
    return lines


# What is drawn, from a corner: texts and lines.


@final
@dataclass(frozen=True)
class GlyphRun:
    """A text at a place."""

    x: float
    y: float
    text: str
    size: float
    face: str
    colour: str = "#000000"

    def moved(self, x: float, y: float) -> GlyphRun:
        """Return it at another place."""
        return GlyphRun(self.x + x, self.y + y, self.text, self.size, self.face, self.colour)


@final
@dataclass(frozen=True)
class InkLine:
    """A line through points, or an area that is filled."""

    points: tuple[tuple[float, float], ...]
    width: float = 0.5
    colour: str = "#000000"
    fill: bool = False

    def moved(self, x: float, y: float) -> InkLine:
        """Return it at another place."""
        return InkLine(tuple((px + x, py + y) for px, py in self.points), self.width, self.colour, self.fill)


Ink: TypeAlias = GlyphRun | InkLine


@final
@dataclass(frozen=True)
class SetFormula:
    """What is set: how wide it is, how far above and below the line it goes, and its ink from the line's start, y up."""

    width: float
    height: float
    depth: float
    ink: tuple[Ink, ...]

    def at(self, x: float, y: float) -> Iterator[Ink]:
        """Yield its ink at a place."""
        return (each.moved(x, y) for each in self.ink)


ITALIC = {"variable", "word"}
SPACED = "+−·×=<>≤≥≠∧\u2228"
DEGREE = Sign("name", "°")
AXIS = 0.3
"""How high fractions have their line, in sizes."""


def set_formula(box: Box, size: float) -> SetFormula:
    """Return a box of a formula, set in a size."""
    if isinstance(box, Sign):
        return set_sign(box, size)
    if isinstance(box, BoxRow):
        return boxes_in_row(box.parts, size)
    if isinstance(box, Fraction):
        return fraction(set_formula(box.over, 0.92 * size), set_formula(box.under, 0.92 * size), size)
    if isinstance(box, Script):
        return set_script(box, size)
    if isinstance(box, Arrowed):
        return arrowed(set_formula(box.base, size), size)
    if isinstance(box, Rooted):
        return rooted(set_formula(box.base, size), size)
    return fenced(box, size) if isinstance(box, Fenced) else set_lines(box, size)


def set_sign(box: Sign, size: float) -> SetFormula:
    """Return one sign or word."""
    if box.kind == "space":
        return SetFormula(float(box.text) * size, 0.0, 0.0, ())
    name = "italic" if box.kind in ITALIC and box.text.isalpha() and box.text.isascii() else "regular"
    return SetFormula(width(box.text, size, name), 0.76 * size, 0.2 * size, (GlyphRun(0.0, 0.0, box.text, size, name),))


def boxes_in_row(parts: Sequence[Box], size: float) -> SetFormula:
    """Return boxes beside each other, with space about the signs of operations and behind names of functions."""
    ink: list[Ink] = []
    x, height, depth = 0.0, 0.6 * size, 0.15 * size
    parts = [inner for each in parts for inner in (each.parts or (each,) if isinstance(each, BoxRow) else (each,))]
    for place, part in enumerate(parts):
        each = set_formula(part, size)
        operates = isinstance(part, Sign) and part.kind == "operator" and part.text in SPACED
        binary = operates and place > 0
        x += 0.24 * size if binary else 0.0
        ink = run_together([*ink, *each.at(x, 0.0)])
        x += each.width + (0.24 * size if binary else 0.0)
        if isinstance(part, Sign) and part.text == ",":
            x += 0.3 * size
        elif is_spaced(part, parts[place + 1 : place + 2]):
            x += 0.17 * size
        height, depth = max(height, each.height), max(depth, each.depth)
    return SetFormula(x, height, depth, tuple(ink))


def run_together(ink: list[Ink]) -> list[Ink]:
    """Return ink whose last two texts, where one goes on with the other, are one: what is copied out of a page is whole words."""
    if len(ink) < 2:
        return ink
    first, last = ink[-2:]
    if not (isinstance(first, GlyphRun) and isinstance(last, GlyphRun)):
        return ink
    is_like = first.size == last.size and first.face == last.face and first.y == last.y
    if not is_like or abs(first.x + width(first.text, first.size, first.face) - last.x) > 1e-6 * first.size:
        return ink
    return [*ink[:-2], GlyphRun(first.x, first.y, first.text + last.text, first.size, first.face, first.colour)]


def is_spaced(part: Box, following: Sequence[Box]) -> bool:
    """Return whether a little space stands between a box and the next: between factors, not between letters of one name."""
    if not following or (isinstance(following[0], Sign) and following[0].kind in ("operator", "space")) or following[0] == DEGREE:
        return False
    if isinstance(part, Sign):
        after_name = part.kind == "name" and part != DEGREE and not isinstance(following[0], Fenced)
        return after_name or (part.kind == "number" and not isinstance(following[0], Sign))
    is_call = isinstance(part, Script) and isinstance(part.base, Sign) and part.base.kind == "name" and isinstance(following[0], Fenced)
    return not is_call


def fraction(over: SetFormula, under: SetFormula, size: float) -> SetFormula:
    """Return one over another."""
    wide, axis, gap = max(over.width, under.width) + 0.3 * size, AXIS * size, 0.14 * size
    up, down = axis + gap + over.depth, axis - gap - under.height
    line = InkLine(((0.06 * size, axis), (wide - 0.06 * size, axis)), 0.05 * size)
    ink = (*over.at(0.5 * (wide - over.width), up), *under.at(0.5 * (wide - under.width), down), line)
    return SetFormula(wide + 0.1 * size, up + over.height, under.depth - down, ink)


def set_script(box: Script, size: float) -> SetFormula:
    """Return a box with index and exponent."""
    base = set_formula(box.base, size)
    small, x = 0.7 * size, base.width + 0.03 * size
    ink, wide, height, depth = list(base.ink), x, base.height, base.depth
    if box.low is not None:
        low = set_formula(box.low, small)
        drop = max(0.16 * size, base.depth - 0.12 * size if base.depth > 0.3 * size else 0.0)
        ink += low.at(x, -drop)
        wide, depth = max(wide, x + low.width), max(depth, drop + low.depth)
    if box.high is not None:
        high = set_formula(box.high, small)
        rise = max(0.36 * size, base.height - 0.4 * size)
        ink += high.at(x, rise)
        wide, height = max(wide, x + high.width), max(height, rise + high.height)
    return SetFormula(wide, height, depth, tuple(ink))


def arrowed(base: SetFormula, size: float) -> SetFormula:
    """Return a box under an arrow."""
    y, tip = base.height + 0.06 * size, 0.16 * size
    end = max(base.width, 0.5 * size)
    line = InkLine(((0.04 * size, y), (end, y)), 0.045 * size)
    head = InkLine(((end - tip, y + 0.6 * tip), (end, y), (end - tip, y - 0.6 * tip)), 0.045 * size)
    return SetFormula(max(base.width, end) + 0.04 * size, y + 0.14 * size, base.depth, (*base.ink, line, head))


def rooted(base: SetFormula, size: float) -> SetFormula:
    """Return the square root of a box."""
    x, top, low = 0.55 * size, base.height + 0.14 * size, -base.depth
    hook = ((0.0, 0.3 * top), (0.15 * size, 0.36 * top), (0.32 * size, low), (0.5 * size, top), (x + base.width + 0.1 * size, top))
    return SetFormula(x + base.width + 0.15 * size, top + 0.08 * size, base.depth, (InkLine(hook, 0.05 * size), *base.at(x, 0.0)))


def fenced(box: Fenced, size: float) -> SetFormula:
    """Return a box between signs as high as it is."""
    body = set_formula(box.body, size)
    left, right = (fence(each, body, size) for each in (box.left, box.right))
    ink = (*left.ink, *body.at(left.width, 0.0), *right.at(left.width + body.width, 0.0))
    return SetFormula(left.width + body.width + right.width, max(body.height, left.height), max(body.depth, left.depth), ink)


def fence(text: str, body: SetFormula, size: float) -> SetFormula:
    """Return a parenthesis or bar: a letter beside what is low, drawn beside what is high."""
    if not text:
        return SetFormula(0.0, 0.0, 0.0, ())
    low = body.height <= 0.95 * size and body.depth <= 0.35 * size
    if low and text != "|":
        return set_sign(Sign("operator", text), size)
    top, bottom = body.height + 0.05 * size, -body.depth - 0.03 * size
    if text in "|‖":
        return SetFormula(0.26 * size, top, -bottom, (InkLine(((0.13 * size, top), (0.13 * size, bottom)), 0.05 * size),))
    wide, middle, half = 0.2 * size, 0.5 * (top + bottom), 0.5 * (top - bottom)
    ways = np.linspace(-1.0, 1.0, 13)
    bend = wide * (1.0 - np.sqrt(np.maximum(0.0, 1.0 - 0.96 * ways**2)))
    bend = wide * np.abs(ways) ** 0.25 if text in "{}" else bend
    xs = 0.12 * size + (bend if text in "({[" else wide - bend)
    points = tuple((float(x), float(middle + half * way)) for x, way in zip(xs, ways, strict=True))
    return SetFormula(wide + 0.2 * size, top, -bottom, (InkLine(points, 0.055 * size),))


def set_lines(box: Lines, size: float) -> SetFormula:
    """Return rows below each other, their middle at the height of fractions."""
    rows = [[set_formula(cell, size) for cell in each] for each in box.rows]
    columns = max(map(len, rows))
    wide = [max((each[k].width for each in rows if k < len(each)), default=0.0) + 0.8 * size for k in range(columns)]
    heights = [(max(each.height for each in cells), max(each.depth for each in cells)) for cells in rows]
    total = sum(up + down for up, down in heights) + 0.3 * size * (len(rows) - 1)
    y, ink = AXIS * size + 0.5 * total, list[Ink]()
    for cells, (up, down) in zip(rows, heights, strict=True):
        y -= up
        for k, each in enumerate(cells):
            ink += each.at(sum(wide[:k]), y)
        y -= down + 0.3 * size
    return SetFormula(sum(wide) - 0.8 * size, AXIS * size + 0.5 * total, 0.5 * total - AXIS * size, tuple(ink))
