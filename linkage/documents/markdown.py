"""A document as Markdown with LaTeX formulas, its pictures beside it in the folder FILE_files."""

from __future__ import annotations

import re
import shutil
from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from pathlib import Path
from secrets import token_hex

from ..disk import check_place, in_words, replacing_text
from ..errors import FileError
from ..language import said, with_decimals
from .content import Cell, Document, Equality, Formula, Illustration, Mark, Section, TableBlock, captions_of
from .html import footer
from .pictures import picture_svg

SPECIAL = re.compile(r"([\\`*_{}\[\]<>#|$~])")
MARKER = "hydrolinkage"
"""The name of the file that says whose a folder of pictures is."""


def write_markdown(document: Document, path: Path) -> None:
    """Write a document as Markdown and its pictures into the folder beside it, both replaced whole."""
    folder = path.with_name(f"{path.stem}_files")
    drawn = [block for section in document.sections for block in section.blocks if isinstance(block, Illustration)]
    pictures = {f"{number:02d}_{each.name}.svg": each for number, each in enumerate(drawn, 1)}
    names = {id(each): f"{folder.name}/{name}" for name, each in pictures.items()}
    text = markdown(document, names)
    replace_folder(folder, {name: picture_svg(each) for name, each in pictures.items()})
    with replacing_text(path) as stream:
        stream.write(text)


def replace_folder(folder: Path, contents: dict[str, str]) -> None:
    """Put files into a folder that takes the place of the one before; FileError where something else has its name."""
    if folder.exists() and not (folder / MARKER).is_file():
        raise FileError(f"{folder}: something else has this name, and a report's pictures go there; move it, or choose another name.")
    check_place(folder.with_name(f".{token_hex(8)}.tmp"))
    fresh = folder.with_name(f".{token_hex(8)}.tmp")
    with in_words(folder):
        fresh.mkdir()
        try:
            for name, text in {**contents, MARKER: "pictures of a report\n"}.items():
                (fresh / name).write_text(text, encoding="utf-8")
            if folder.exists():
                shutil.rmtree(folder)
            fresh.rename(folder)
        except BaseException:
            with suppress(OSError):
                shutil.rmtree(fresh)
            raise


def markdown(document: Document, names: dict[int, str]) -> str:
    """Return a document as Markdown; `names` are the pictures' places by their identity."""
    captions, block = captions_of(document.sections), document.block
    lines = [f"# {escaped_markdown(document.title)}", ""]
    lines += [f"{escaped_markdown(said('Calculation report'))}. {escaped_markdown(document.subtitle)}", ""]
    names_of_fields, values = zip(*block.entries, strict=True)
    signed = [(what, name, "", "") for what, name in block.signatures]
    lines += [*pipe_table(names_of_fields, [values]), "", *pipe_table(block.columns, signed), "", "", "| | |", "| --- | --- |"]
    lines += [f"| {escaped_markdown(name)} | {escaped_markdown(value)} |" for name, value in document.facts]
    for number, section in enumerate(document.sections, 1):
        lines += section_text(number, section, captions, names)
    return "\n".join([*lines, "", "---", "", escaped_markdown(footer(document)), ""])


def pipe_table(headings: Sequence[str], rows: Iterable[Sequence[Cell]], columns: str = "") -> Iterator[str]:
    """Yield the lines of a table; a column of kind "r" stands to the right."""
    yield f"| {' | '.join(map(escaped_markdown, headings))} |"
    yield f"| {' | '.join('---:' if kind == 'r' else '---' for kind in columns or ' ' * len(headings))} |"
    for row in rows:
        yield f"| {' | '.join(map(cell_text, row))} |"


def section_text(number: int, section: Section, captions: dict[int, str], names: dict[int, str]) -> Iterator[str]:
    """Yield the lines of a section."""
    yield from ("", f"## {number}. {escaped_markdown(section.title)}")
    for block in section.blocks:
        yield ""
        match block:
            case str():
                yield escaped_markdown(block)
            case TableBlock(_, headings, rows, columns):
                caption = captions.get(id(block), "")
                yield from (f"*{escaped_markdown(caption)}*", "") if caption else ()
                yield from pipe_table(headings, rows, columns)
            case Equality(place, steps):  # aligned at its signs of equality
                first, *others = map(latex_decimals, steps)
                lines = " \\\\\n".join(f"&= {each}" for each in others)
                body = f"\\begin{{aligned}}\n{first} {lines}\n\\end{{aligned}}" if others else first
                yield from ("$$", body + (rf" \tag{{{place}}}" if place else ""), "$$")
            case Illustration():
                caption = escaped_markdown(captions.get(id(block), block.caption))
                yield from (f"![{caption}]({names[id(block)]})", "", f"*{caption}*")
            case _:
                yield from (f"- {escaped_markdown(text)}" for text in block)


def cell_text(value: Cell) -> str:
    """Return a cell in one line."""
    match value:
        case Formula(latex):
            return f"${latex_decimals(latex).replace('|', chr(92) + 'vert ')}$"
        case Mark(_, word):
            return f"**{escaped_markdown(word)}**"
    return escaped_markdown(value)


def latex_decimals(latex: str) -> str:
    """Return a formula with the decimal sign of the language that is spoken, in braces where a comma would part a list."""
    return latex if with_decimals("0.5") == "0.5" else re.sub(r"(\d)\.(\d)", r"\1{,}\2", latex)


def escaped_markdown(text: str) -> str:
    """Return a text whose signs mean nothing in Markdown, in one line."""
    return SPECIAL.sub(r"\\\1", " ".join(text.split()))
