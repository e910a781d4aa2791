"""Line breaks of a long formula: in front of its operators, behind its commas, and inside terms longer than a line."""

from __future__ import annotations

from collections.abc import Sequence

from ..formulas.typeset import Box, BoxRow, Fenced, Fraction, Rooted, Script, Sign, boxes, breakable, rough_width

LONGEST = 44.0
"""The widest piece of an equation, in sizes of its letters: a line of an A4 page, without the equation's number."""
LEAST = 0.65
"""A side of numbers that would have to be set smaller than this share to fit is left out: what it comes to follows."""
DEEPEST = 12
"""How often a formula is opened, part in part; what is too wide even then is set smaller."""


def line_pieces(step: str) -> list[Box]:
    """Return a side of an equation in LaTeX in pieces between which a line may break, none wider than a line."""
    return [piece for each in breakable(boxes(step)) for piece in formula_pieces(each, LONGEST)]


def readable(steps: Sequence[str]) -> list[list[Box]]:
    """Return the sides of an equation in pieces, without numbers that would be too small to read: neither the first two nor the last."""
    sides = [line_pieces(step) for step in steps]
    fits = [max(map(rough_width, pieces)) <= LONGEST / LEAST for pieces in sides]
    return [pieces for place, pieces in enumerate(sides) if place < 2 or place == len(sides) - 1 or fits[place]]


def formula_pieces(box: Box, room: float, depth: int = 0) -> list[Box]:
    """Return a formula in pieces that are no wider than a room [sizes of its letters] where it can be broken; a short one whole.

    What is longer than a line is opened: parentheses stay at the ends of their pieces, and a fraction becomes a quotient in one line.
    """
    if depth > DEEPEST or rough_width(box) <= room:
        return [box]
    cut = cuts(box)
    if len(cut) == 1:
        cut = opened(cut[0])
    if len(cut) == 1:
        return cut
    found: list[Box] = []
    for part in (piece for each in cut for piece in formula_pieces(each, room, depth + 1)):
        longer = row_of(found[-1], part) if found else part
        if found and rough_width(longer) <= room:
            found[-1] = longer
        else:
            found.append(part)
    return found


def cuts(box: Box) -> list[Box]:
    """Return a row cut in front of its outermost signs of operation, else behind its commas; anything else whole."""
    if not isinstance(box, BoxRow):
        return [box]
    box = row_of(box)
    found = breakable(box)
    if len(found) > 1:
        return found
    parts: list[list[Box]] = [[]]
    for part in box.parts:
        parts[-1].append(part)
        if part == Sign("operator", ","):
            parts.append([])
    return [BoxRow(tuple(each)) for each in parts if each]


def opened(box: Box) -> list[Box]:
    """Return the parts of a box, so that a line may break in it; a box that cannot be opened as a whole."""
    match box:
        case Fraction(over, under):
            return [in_parentheses(over), row_of(Sign("operator", "/"), in_parentheses(under))]
        case Fenced(left, body, right):
            inner = cuts(body)
            inner = opened(inner[0]) if len(inner) == 1 else inner
            return put_around(Sign("operator", left), inner, Sign("operator", right)) if len(inner) > 1 else [box]
        case Script(Fenced() as base):
            *inner, last = opened(base)
            *before, end = row_of(last).parts or (last,)  # the closing parenthesis has the index and the exponent
            return [*inner, row_of(*before, box._replace(base=end))] if inner else [box]
        case Rooted(base):
            return opened(Script(Fenced("(", base, ")"), None, Fraction(Sign("number", "1"), Sign("number", "2"))))
        case BoxRow():
            parts = row_of(box).parts
            for place in sorted(range(len(parts)), key=lambda k: -rough_width(parts[k])):
                inner = opened(parts[place])
                if len(inner) > 1:
                    return put_around(BoxRow(parts[:place]), inner, BoxRow(parts[place + 1 :]))
            return [row_of(box)]
    return [box]


def put_around(first: Box, inner: Sequence[Box], last: Box) -> list[Box]:
    """Return pieces with something in front of the first and something behind the last."""
    found = list(inner)
    found[0] = row_of(first, found[0])
    found[-1] = row_of(found[-1], last)
    return found


def row_of(*parts: Box) -> BoxRow:
    """Return boxes in one row, rows among them part by part."""
    return BoxRow(tuple(inner for each in parts for inner in (row_of(*each.parts).parts if isinstance(each, BoxRow) else (each,))))


def in_parentheses(box: Box) -> Box:
    """Return a box in parentheses; one sign as it is."""
    return box if not isinstance(box, BoxRow) or len(box.parts) < 2 else Fenced("(", box, ")")
