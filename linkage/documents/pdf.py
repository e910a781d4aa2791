"""A document as PDF on A4 pages, set by Typst: letters that can be selected, lines as vectors, the same bytes every time."""

from __future__ import annotations

import json
from collections.abc import Sequence
from importlib.util import find_spec
from pathlib import Path
from textwrap import shorten

from matplotlib import get_data_path

from ..disk import replacing
from ..errors import DefinitionError
from ..formulas.typeset import SIGNS, boxes, rough_width
from ..formulas.typst import typst_math
from ..language import said
from .breaking import LONGEST, readable
from .content import Block, Cell, Document, Equality, Formula, Illustration, Mark, TableBlock, captions_of
from .pictures import picture_svg

JSON = dict[str, object]


def check_typst(path: Path) -> None:
    """Raise DefinitionError where Typst, which sets a PDF, is not installed."""
    if find_spec("typst") is None:
        raise DefinitionError(
            f'{path.name}: a PDF is set by Typst, which is not installed: pip install "hydrolinkage[pdf]" '
            "(from a checkout: pip install -e '.[pdf]'). A report as .html or .md is written without it."
        )


def write_pdf(document: Document, path: Path) -> None:
    """Write a document as PDF; an existing file is replaced whole."""
    content = pdf(document)
    with replacing(path) as stream:
        stream.write(content)


def pdf(document: Document) -> bytes:
    """Return a document as PDF."""
    import typst

    template, fonts = Path(__file__).with_name("report.typ"), Path(get_data_path(), "fonts", "ttf")
    data = json.dumps(document_data(document), ensure_ascii=False)
    return typst.compile(str(template), font_paths=[str(fonts)], ignore_system_fonts=True, sys_inputs={"document": data})


def document_data(document: Document) -> JSON:
    """Return a document as data for the template."""
    captions, mark = captions_of(document.sections), document.verdict
    return {
        "title": document.title,
        "subtitle": f"{said('Calculation report')}. {document.subtitle}",
        "language": document.language,
        "footer": shorten(document.footer, 100, placeholder=" …"),
        "pages": said("page {n} of {all}", n="{n}", all="{all}"),
        "entries": document.block.entries,
        "columns": document.block.columns,
        "signatures": document.block.signatures,
        "facts": [(name, cell_data(mark if value == mark.word else value)) for name, value in document.facts],
        "sections": [{"title": each.title, "blocks": [block_data(*row, captions) for row in each.rows]} for each in document.sections],
    }


def block_data(is_pair: bool, row: Sequence[Block], captions: dict[int, str]) -> JSON:
    """Return a block, or pictures or tables beside each other."""
    if is_pair and isinstance(row[0], TableBlock):
        return {"kind": "pair", "blocks": [block_data(False, [each], captions) for each in row]}
    match row[0]:
        case str(text):
            return {"kind": "text", "text": text}
        case tuple(texts):
            return {"kind": "list", "texts": texts}
        case TableBlock(_, headings, rows, columns) as table:
            cells = [[cell_data(value) for value in each] for each in rows]
            return {"kind": "table", "caption": captions.get(id(table), ""), "headings": headings, "columns": columns, "rows": cells}
        case Equality(number, steps):
            sides = readable(steps)
            longest = max(rough_width(piece) for pieces in sides for piece in pieces)
            math = " = ".join(breaking_math([*map(typst_math, pieces)]) for pieces in sides)
            return {"kind": "equation", "number": number, "math": math, "size": LONGEST / max(LONGEST, longest)}
    drawn = [
        {"svg": picture_svg(each), "width": each.size[0], "caption": captions.get(id(each), each.caption)}
        for each in row if isinstance(each, Illustration)
    ]  # fmt: skip
    return {"kind": "pictures", "columns": 2 if is_pair else 1, "pictures": drawn}


def breaking_math(pieces: Sequence[str]) -> str:
    """Return pieces of a formula in Typst's math, which breaks a line behind signs of operation alone: an empty one stands elsewhere."""
    found = pieces[0]
    for piece in pieces[1:]:
        found += f" {piece}" if piece[0] in SIGNS and found[-1] not in ",;" else f' class("relation", "") {piece}'
    return found


def cell_data(value: Cell) -> str | JSON:
    """Return a cell of a table."""
    match value:
        case Formula(latex):
            return {"math": typst_math(boxes(latex))}
        case Mark(ok, word):
            return {"mark": "silent" if ok is None else "kept" if ok else "broken", "word": word}
    return value
