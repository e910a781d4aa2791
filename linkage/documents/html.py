"""A document as one HTML file that needs nothing else: MathML, pictures inside, no script, nothing from elsewhere."""

from __future__ import annotations

import hashlib
from base64 import b64encode
from collections.abc import Iterator
from html import escape
from importlib.resources import files
from pathlib import Path

from ..disk import replacing_text
from ..formulas.typeset import boxes, mathml
from ..language import said
from .breaking import line_pieces
from .content import Block, Cell, Document, Equality, Formula, Illustration, Mark, TableBlock, captions_of
from .pictures import picture_svg


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
    sections = list[str]()
    for number, section in enumerate(document.sections, 1):
        sections.append(f'<section><h2 id="s{number}">{number}. {escape(section.title)}</h2>')
        for is_pair, row in section.rows:
            blocks = "".join(block_html(block, captions) for block in row)
            sections.append(f'<div class="pair">{blocks}</div>' if is_pair else blocks)
        sections.append("</section>")
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
        *sections,
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
    block, mark = document.block, document.verdict
    fields = "".join(f"<dt>{escape(name)}</dt><dd>{escape(value)}</dd>" for name, value in block.entries)
    yield f'<dl class="plate">{fields}</dl>'
    heads = "".join(f"<th>{escape(text)}</th>" for text in block.columns)
    signed = "".join(f"<tr><th>{escape(what)}</th><td>{escape(name)}</td><td></td><td></td></tr>" for what, name in block.signatures)
    yield f'<table class="sign"><thead><tr>{heads}</tr></thead><tbody>{signed}</tbody></table>'
    rows = (
        f"<dt>{escape(name)}</dt><dd{coloured(mark) if value == mark.word else ''}>{escape(value)}</dd>" for name, value in document.facts
    )
    yield f'<dl class="block">{"".join(rows)}</dl>'
    entries = (f'<li><a href="#s{number}">{escape(each.title)}</a></li>' for number, each in enumerate(document.sections, 1))
    yield f"<nav><ol>{''.join(entries)}</ol></nav>"


def coloured(mark: Mark) -> str:
    """Return the class of a mark as an attribute."""
    return "" if mark.ok is None else f' class="{"ok" if mark.ok else "no"}"'


def block_html(block: Block, captions: dict[int, str]) -> str:
    """Return a block."""
    match block:
        case str():
            return f"<p>{escape(block)}</p>"
        case TableBlock(_, headings, lines, columns):
            caption = escape(captions.get(id(block), ""))
            heads = "".join(f'<th scope="col" class="{kind}">{escape(text)}</th>' for text, kind in zip(headings, columns, strict=True))
            rows = "\n".join(f"<tr>{''.join(map(cell, row, columns))}</tr>" for row in lines)
            title = f"<caption>{caption}</caption>" if caption else ""
            return f'<div class="wide"><table>{title}<thead><tr>{heads}</tr></thead>\n<tbody>\n{rows}\n</tbody></table></div>'
        case Equality(place, steps):  # in pieces between which a line may break
            parts: list[str] = []
            for behind, step in enumerate(steps):
                for first, piece in enumerate(line_pieces(step)):
                    sign, set_in = '<mo form="infix">=</mo>' if behind and not first else "", mathml(piece)
                    set_in = set_in.replace("<mo>", '<mo form="infix" lspace="0.22em" rspace="0.22em">', 1) if first else set_in
                    parts.append(f'<math xmlns="http://www.w3.org/1998/Math/MathML" displaystyle="true">{sign}{set_in}</math>')
            return f'<div class="eq"><span>{f"({place})" if place else ""}</span><div>{" ".join(parts)}</div></div>'
        case Illustration():
            caption = escape(captions.get(id(block), block.caption))
            data = b64encode(picture_svg(block).encode()).decode()
            return f'<figure><img alt="{caption}" src="data:image/svg+xml;base64,{data}"/><figcaption>{caption}</figcaption></figure>'
    return f"<ul>{''.join(f'<li>{escape(text)}</li>' for text in block)}</ul>"


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
