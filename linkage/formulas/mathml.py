"""Boxes as MathML Core, which browsers set themselves."""

from __future__ import annotations

from html import escape

from ..language import with_decimals
from .typeset import Arrowed, Box, BoxRow, Fenced, Fraction, Rooted, Script, Sign, listed_apart

NOT_SPACED = "(),;|[]{}′"


def mathml(box: Box) -> str:
    """Return a box as an element of MathML, without the `math` around it."""
    match box:
        case Sign("space", text):
            return f'<mspace width="{text}em"/>'
        case Sign("name", text) if " " in text or text == "°":
            return f"<mtext>{escape(text)}</mtext>"
        case Sign("operator", text):
            form = ' stretchy="false"' if text in NOT_SPACED else ""
            return f"<mo{form}>{escape(text)}</mo>"
        case Sign("number", text):
            return f"<mn>{escape(with_decimals(text))}</mn>"
        case Sign(kind, text):  # a page sets words of several letters in italics
            form = ' class="w"' if kind == "word" else ' mathvariant="normal"' if kind == "name" and len(text) == 1 else ""
            return f"<mi{form}>{escape(text)}</mi>"
        case BoxRow(parts):
            return f"<mrow>{''.join(map(mathml, listed_apart(parts)))}</mrow>"
        case Fraction(over, under):
            return f"<mfrac>{mathml(over)}{mathml(under)}</mfrac>"
        case Script(base, low, high):
            tag = "msup" if low is None else "msub" if high is None else "msubsup"
            return f"<{tag}>{''.join(mathml(each) for each in (base, low, high) if each is not None)}</{tag}>"
        case Arrowed(base, is_long):
            return f'<mover accent="true">{mathml(base)}<mo stretchy="{str(is_long).lower()}">→</mo></mover>'
        case Rooted(base):
            return f"<msqrt>{mathml(base)}</msqrt>"
        case Fenced(first, body, last):
            left, right = (f'<mo stretchy="true">{escape(each)}</mo>' if each else "" for each in (first, last))
            return f"<mrow>{left}{mathml(body)}{right}</mrow>"
    rows = ("".join(f"<mtd>{mathml(cell)}</mtd>" for cell in row) for row in box.rows)
    return f"<mtable>{''.join(f'<mtr>{row}</mtr>' for row in rows)}</mtable>"
