"""Boxes as MathML Core, which browsers set themselves."""

from __future__ import annotations

from html import escape

from .typeset import Arrowed, Box, BoxRow, Fenced, Fraction, Rooted, Script, Sign

TAGS = {"variable": "mi", "word": "mi", "name": "mi", "number": "mn", "operator": "mo"}
NOT_SPACED = "(),|[]{}′"


def mathml(box: Box) -> str:
    """Return a box as an element of MathML, without the `math` around it."""
    if isinstance(box, Sign):
        if box.kind == "space":
            return f'<mspace width="{box.text}em"/>'
        if box.kind == "name" and (" " in box.text or box.text == "°"):
            return f"<mtext>{escape(box.text)}</mtext>"
        tag, form = TAGS[box.kind], ""
        if box.kind == "operator" and box.text in NOT_SPACED:
            form = ' stretchy="false"'
        if box.kind == "name" and len(box.text) == 1:
            form = ' mathvariant="normal"'
        form = ' class="w"' if box.kind == "word" else form  # a page sets words of several letters in italics
        return f"<{tag}{form}>{escape(box.text)}</{tag}>"
    if isinstance(box, BoxRow):
        return f"<mrow>{''.join(map(mathml, box.parts))}</mrow>"
    if isinstance(box, Fraction):
        return f"<mfrac>{mathml(box.over)}{mathml(box.under)}</mfrac>"
    if isinstance(box, Script):
        base = mathml(box.base)
        if box.low is not None and box.high is not None:
            return f"<msubsup>{base}{mathml(box.low)}{mathml(box.high)}</msubsup>"
        if box.low is not None:
            return f"<msub>{base}{mathml(box.low)}</msub>"
        return f"<msup>{base}{mathml(box.high or BoxRow(()))}</msup>"
    if isinstance(box, Arrowed):
        return f'<mover accent="true">{mathml(box.base)}<mo stretchy="{str(box.long).lower()}">→</mo></mover>'
    if isinstance(box, Rooted):
        return f"<msqrt>{mathml(box.base)}</msqrt>"
    if isinstance(box, Fenced):
        left, right = (f'<mo stretchy="true">{escape(each)}</mo>' if each else "" for each in (box.left, box.right))
        return f"<mrow>{left}{mathml(box.body)}{right}</mrow>"
    rows = ("".join(f"<mtd>{mathml(cell)}</mtd>" for cell in row) for row in box.rows)
    return f"<mtable>{''.join(f'<mtr>{row}</mtr>' for row in rows)}</mtable>"
