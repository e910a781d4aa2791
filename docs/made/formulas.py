"""Formulas as MathML: a browser sets them itself, without a script, a font or a network."""

from __future__ import annotations

import re
from html import escape
from typing import Any

from docutils import nodes
from latex2mathml.converter import convert

PRIMED = re.compile(r"<msup>(<mi>[^<]*</mi>)<mi>(&#x0203[23];)</mi></msup>")
"""Letters with a prime: as an exponent it would be too small to be seen."""


def mathml(latex: str, *, block: bool = False) -> str:
    """Return a formula in LaTeX as a `math` element; on a line of its own as a block."""
    return PRIMED.sub(r'<mrow>\1<mo lspace="0" rspace="0">\2</mo></mrow>', convert(latex.strip(), display="block" if block else "inline"))


def inline(writer: Any, node: nodes.Element) -> None:
    """Write a formula in a line of text."""
    writer.body.append(mathml(node.astext()))
    raise nodes.SkipNode


def block(writer: Any, node: nodes.Element) -> None:
    """Write a formula on its own, with its number where it has one."""
    number = f"({node['number']})" if node.get("number") else ""
    writer.body.append(formula(node.astext(), number, " ".join(node.get("ids", []))))
    raise nodes.SkipNode


def formula(latex: str, number: str = "", name: str = "") -> str:
    """Return a formula as a block of a page, its number at the right."""
    place = f' id="{escape(name)}"' if name else ""
    said = f'<span class="number">{escape(number)}</span>' if number else ""
    return f'<div class="formula"{place}>{mathml(latex, block=True)}{said}</div>\n'
