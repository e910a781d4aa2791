"""Boxes in the math of Typst, which sets reports as PDF."""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import pairwise

from ..language import with_decimals
from .typeset import Arrowed, Box, BoxRow, Fenced, Fraction, Rooted, Script, Sign, listed_apart

SPECIAL = re.compile(r"[!-/:-@\[-`{-~]")
"""Signs that have a meaning in Typst's math, or may get one."""
LITERAL = "+-=<>*.!"


def typst_math(box: Box) -> str:
    """Return a box as Typst writes it in math; every text of a user's stands in quotes or escaped.

    A name of several letters is `word("name")`, a function that the template defines.
    """
    match box:
        case Sign("space", text):
            return f"#h({text}em)"
        case Sign("word", text):
            return f"word({typst_string(text)})"
        case Sign("name", text) if text != "°":
            return f"op({typst_string(text)})"
        case Sign("number", text) if with_decimals(text) != text:
            return with_decimals(text).replace(",", 'class("normal", \\,)')
        case Sign(_, text):
            return text if text in LITERAL or text[:1].isdigit() else escaped(text)
        case BoxRow(parts):
            return row_math(parts)
        case Fraction(over, under):
            return f"frac({typst_math(over)}, {typst_math(under)})"
        case Script(base, low, high):
            below = "" if low is None else f", b: {typst_math(low)}"
            above = "" if high is None else f", t: {typst_math(high)}"
            return f"attach({typst_math(base)}{below}{above})"
        case Arrowed(base):
            return f"arrow({typst_math(base)})"
        case Rooted(base):
            return f"sqrt({typst_math(base)})"
        case Fenced(left, body, right):
            return f"lr({escaped(left)} {typst_math(body)} {escaped(right)})"
    rows = (", ".join(f"display({typst_math(cell)})" for cell in row) for row in box.rows)
    return f"mat(delim: #none, align: #left, row-gap: #0.5em, {'; '.join(rows)})"


def row_math(parts: Sequence[Box]) -> str:
    """Return boxes beside each other: a little space stands behind a number and before a name of several letters."""
    parts = listed_apart(parts)
    found = "".join(map(typst_math, parts[:1]))
    for before, part in pairwise(parts):
        match before, part:
            case (Sign("number"), Script() | Fraction() | Arrowed() | Rooted()) | (Sign("variable") | Script(), Script(Sign("word"))):
                gap = " thin "
            case Sign("word"), Fenced():
                gap = ""
            case _:
                gap = " "
        found += gap + typst_math(part)
    return found or '""'


def escaped(text: str) -> str:
    """Return signs that mean themselves."""
    return SPECIAL.sub(r"\\\g<0>", text)


def typst_string(text: str) -> str:
    """Return a text as a string of Typst's."""
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'
