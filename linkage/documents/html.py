"""A document as one HTML file that needs nothing else: MathML, pictures inside, no script, nothing from elsewhere."""

from __future__ import annotations

import hashlib
from base64 import b64encode
from collections.abc import Iterator
from html import escape
from importlib.resources import files
from pathlib import Path

from ..disk import replacing_text
from ..formulas.mathml import mathml
from ..formulas.typeset import boxes
from ..language import said
from .breaking import line_pieces
from .content import Block, Cell, Document, Equality, Formula, Illustration, Mark, Section, TableBlock, captions_of
from .pictures import picture_svg
from .title import TitleBlock


def write_html(document: Document, path: Path) -> None:
    """Write a document as HTML; an existing file is replaced whole."""
    with replacing_text(path) as stream:
        stream.write(html_text(document))


def html_text(document: Document) -> str:
    """Return a document as HTML, well-formed as XML too."""
    css = files(__package__).joinpath("style.css").read_text(encoding="utf-8").strip()
    allowed = b64encode(hashlib.sha256(css.encode()).digest()).decode()
    policy = f"default-src 'none'; style-src 'sha256-{allowed}'; img-src data:; base-uri 'none'; form-action 'none'"
    captions = captions_of(document.sections)
    title = escape(f"{document.title}: {said('calculation report')}")
    return "\n".join([
        "<!DOCTYPE html>",
        f'<html lang="{document.language}" xmlns="http://www.w3.org/1999/xhtml">',
        "<head>",
        '<meta charset="utf-8"/>',
        f'<meta http-equiv="Content-Security-Policy" content="{escape(policy)}"/>',
        '<meta name="viewport" content="width=device-width, initial-scale=1"/>',
        f"<title>{title}</title>",
        f"<style>{css}</style>",
        "</head>",
        "<body><main>",
        *head(document),
        *(line for number, section in enumerate(document.sections, 1) for line in section_lines(number, section, captions)),
        f"<footer>{escape(footer(document))}</footer>",
        "</main></body>",
        "</html>",
        "",
    ])  # fmt: skip


def footer(document: Document) -> str:
    """Return the last line: the version and the hash of the document."""
    return " · ".join(f"{name}: {value}" for name, value in document.facts[-2:])


def head(document: Document) -> Iterator[str]:
    """Yield the title, the title block and the contents."""
    yield f"<h1>{escape(document.title)}</h1>"
    yield f'<p class="sub">{escape(said("Calculation report"))}. {escape(document.subtitle)}</p>'
    yield from title_block(document.block)
    mark = document.verdict
    rows = (
        f"<dt>{escape(name)}</dt><dd{coloured(mark) if value == mark.word else ''}>{escape(value)}</dd>" for name, value in document.facts
    )
    yield f'<dl class="block">{"".join(rows)}</dl>'
    entries = (f'<li><a href="#s{number}">{escape(each.title)}</a></li>' for number, each in enumerate(document.sections, 1))
    yield f"<nav><ol>{''.join(entries)}</ol></nav>"


def title_block(block: TitleBlock) -> Iterator[str]:
    """Yield the title block: its fields, and a line for each who signs."""
    fields = "".join(f"<dt>{escape(name)}</dt><dd>{escape(value)}</dd>" for name, value in block.entries)
    yield f'<dl class="plate">{fields}</dl>'
    heads = "".join(f"<th>{escape(text)}</th>" for text in block.columns)
    rows = "".join(f"<tr><th>{escape(what)}</th><td>{escape(name)}</td><td></td><td></td></tr>" for what, name in block.signatures)
    yield f'<table class="sign"><thead><tr>{heads}</tr></thead><tbody>{rows}</tbody></table>'


def coloured(mark: Mark) -> str:
    """Return the class of a mark as an attribute."""
    return "" if mark.ok is None else f' class="{"ok" if mark.ok else "no"}"'


def section_lines(number: int, section: Section, captions: dict[int, str]) -> Iterator[str]:
    """Yield a section; small pictures that follow each other stand in pairs."""
    yield f'<section><h2 id="s{number}">{number}. {escape(section.title)}</h2>'
    for is_pair, row in section.rows:
        blocks = "".join(block_html(block, captions) for block in row)
        yield f'<div class="pair">{blocks}</div>' if is_pair else blocks
    yield "</section>"


def block_html(block: Block, captions: dict[int, str]) -> str:
    """Return a block."""
    match block:
        case str():
            return f"<p>{escape(block)}</p>"
        case TableBlock():
            return table_html(block, captions.get(id(block), ""))
        case Equality():
            return equality(block)
        case Illustration():
            caption = escape(captions.get(id(block), block.caption))
            data = b64encode(picture_svg(block).encode()).decode()
            return f'<figure><img alt="{caption}" src="data:image/svg+xml;base64,{data}"/><figcaption>{caption}</figcaption></figure>'
    return f"<ul>{''.join(f'<li>{escape(text)}</li>' for text in block)}</ul>"


def table_html(grid: TableBlock, caption: str) -> str:
    """Return a table; it scrolls by itself where it is wider than a screen."""
    heads = "".join(f'<th scope="col" class="{kind}">{escape(text)}</th>' for text, kind in zip(grid.headings, grid.columns, strict=True))
    rows = "\n".join(f"<tr>{''.join(map(cell, row, grid.columns))}</tr>" for row in grid.rows)
    title = f"<caption>{escape(caption)}</caption>" if caption else ""
    return f'<div class="wide"><table>{title}<thead><tr>{heads}</tr></thead>\n<tbody>\n{rows}\n</tbody></table></div>'


def cell(value: Cell, kind: str) -> str:
    """Return a cell."""
    match value:
        case Mark():
            return f"<td{coloured(value)}>{escape(value.word)}</td>"
        case Formula(latex):
            return f'<td class="{kind}">{math(latex)}</td>'
    return f'<td class="{kind}">{escape(value)}</td>'


def math(latex: str) -> str:
    """Return a formula as MathML."""
    return f'<math xmlns="http://www.w3.org/1998/Math/MathML">{mathml(boxes(latex))}</math>'


def equality(block: Equality) -> str:
    """Return an equation with its number: pieces between which a line may break."""
    parts: list[str] = []
    for place, step in enumerate(block.steps):
        for first, piece in enumerate(line_pieces(step)):
            sign = '<mo form="infix">=</mo>' if place and not first else ""
            set_in = mathml(piece).replace("<mo>", '<mo form="infix" lspace="0.22em" rspace="0.22em">', 1) if first else mathml(piece)
            parts.append(f'<math xmlns="http://www.w3.org/1998/Math/MathML" displaystyle="true">{sign}{set_in}</math>')
    number = f"({block.number})" if block.number else ""
    return f'<div class="eq"><span>{number}</span><div>{" ".join(parts)}</div></div>'
