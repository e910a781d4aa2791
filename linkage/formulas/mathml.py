"""Boxes as MathML Core, which browsers set themselves."""

from __future__ import annotations

from html import escape

from .typeset import Arrowed, Box, BoxRow, Fenced, Fraction, Lines, Rooted, Script, Sign

TAGS = {"variable": "mi", "word": "mi", "name": "mi", "number": "mn", "operator": "mo"}
NOT_SPACED = "(),|[]{}′"


def mathml(box: Box) -> str:
    """Return a box as an element of MathML, without the `math` around it."""
    if isinstance(box, Sign):
        return sign_mathml(box)
    if isinstance(box, BoxRow):
        return f"<mrow>{''.join(map(mathml, box.parts))}</mrow>"
    if isinstance(box, Fraction):
        return f"<mfrac>{mathml(box.over)}{mathml(box.under)}</mfrac>"
    if isinstance(box, Script):
        return script_mathml(box)
    if isinstance(box, Arrowed):
        return f'<mover accent="true">{mathml(box.base)}<mo stretchy="{str(box.long).lower()}">→</mo></mover>'
    if isinstance(box, Rooted):
        return f"<msqrt>{mathml(box.base)}</msqrt>"
    if isinstance(box, Fenced):
        left, right = (f'<mo stretchy="true">{escape(each)}</mo>' if each else "" for each in (box.left, box.right))
        return f"<mrow>{left}{mathml(box.body)}{right}</mrow>"
    return lines_mathml(box)


def sign_mathml(each: Sign) -> str:
    """Return one sign; a word of several letters has the class `w`, which a page sets in italics."""
    if each.kind == "space":
        return f'<mspace width="{each.text}em"/>'
    if each.kind == "name" and (" " in each.text or each.text == "°"):
        return f"<mtext>{escape(each.text)}</mtext>"
    tag, form = TAGS[each.kind], ""
    if each.kind == "operator" and each.text in NOT_SPACED:
        form = ' stretchy="false"'
    if each.kind == "name" and len(each.text) == 1:
        form = ' mathvariant="normal"'
    form = ' class="w"' if each.kind == "word" else form
    return f"<{tag}{form}>{escape(each.text)}</{tag}>"


def script_mathml(box: Script) -> str:
    """Return a box with its index and exponent."""
    base = mathml(box.base)
    if box.low is not None and box.high is not None:
        return f"<msubsup>{base}{mathml(box.low)}{mathml(box.high)}</msubsup>"
    if box.low is not None:
        return f"<msub>{base}{mathml(box.low)}</msub>"
    return f"<msup>{base}{mathml(box.high or BoxRow(()))}</msup>"


def lines_mathml(box: Lines) -> str:
    """Return rows below each other."""
    rows = ("".join(f"<mtd>{mathml(cell)}</mtd>" for cell in row) for row in box.rows)
    return f"<mtable>{''.join(f'<mtr>{row}</mtr>' for row in rows)}</mtable>"
