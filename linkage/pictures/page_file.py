"""A page as one file without network access: its text, its style and its program, packed, under a content security policy."""

from __future__ import annotations

import json
import re
from base64 import b64encode
from collections.abc import Sequence
from functools import lru_cache
from hashlib import sha256
from html import escape
from importlib.resources import files
from os import PathLike
from pathlib import Path
from typing import Any, TypeAlias
from zlib import compressobj

import numpy as np

from ..disk import Place
from ..errors import known_name, require
from ..language import language as spoken_language
from ..language import translated
from . import style

PageData: TypeAlias = dict[str, Any]
"""What a page's script reads: numbers, texts, lists and further data by name."""
COLOURS = ("INK", "MUTED", "RULE", "GRID", "PAPER", "CURVE", "ACCENT", "BARREL", "ROD", "PISTON")
LANGUAGES = ("en", "ru")
MACHINE = ("machine.html", "page.css", "mechanism.js", "labels.js", "page.js", "verdicts.js", "hands.js", "copy.js", "leave.js")
"""The parts of a page with a machine that moves and changes; what a kind of page adds comes after them, and START last."""
START = "start.js"
EVENTS = ("events.css", "events.js")
"""What a page with events on its way in time has behind all others."""
SAID = re.compile(r'(?:\bsay(?:\(| = )|\bdata-(?:say|tip|name)=)"((?:[^"\\]|\\.)*)"')
"""Where the program and the text of a page have what is translated."""
INNER = r"`(?:[^`\\$]|\\.|\$(?!\{))*`"
TEMPLATE = rf"`(?:[^`\\$]|\\.|\$(?!\{{)|\$\{{(?:[^`{{}}]|\{{[^`{{}}]*\}}|{INNER})*\}})*`"
KEPT = re.compile(
    rf"""("(?:[^"\\]|\\.)*"|{TEMPLATE.replace(INNER, TEMPLATE)}|(?<![\w)\]])(?<![\w)\]] )/(?:[^/\\\[]|\\.|\[(?:[^\]\\]|\\.)*\])+/)"""
)
"""What stays as it is in a program: texts, templates with templates in them, patterns."""
NO_SPACE = re.compile(r" ?([{};,]) ?|(?<=:) ")
"""Signs of a style about which no spaces are needed."""
TIGHT = re.compile(r" ?([=<>&|?:,;(){}[\]*%!/]+) ?|(?<=[\w)\]]) ([-+]) (?=[\w(\[])|(?<=[;{,])\n")
"""Signs of a program about which no spaces are needed, and ends of lines after which none is."""


def page_text(title: str, data: PageData, parts: Sequence[str], *, language: str, most: int = 0, text: str = "") -> str:
    """Return the HTML of a page: its title, its data, and its parts, the files of its body (.html), styles and program.

    `text` is a program before them, `most` the highest place in the palette that is used, `language` the one it begins with.
    """
    known_name("Language", language, LANGUAGES, where="page(language=...)")
    body, css, own = ("\n".join(page_part(each) for each in parts if each.endswith(end)) for end in (".html", ".css", ".js"))
    sentences = said_in(body + own)
    words = dict[str, list[str]]()
    for name in LANGUAGES:
        with spoken_language(name):
            words[name] = [translated(each) for each in sentences]
    data = data | {"language": language, "words": words}
    body, own = (SAID.sub(lambda found: found[0].replace(f'"{found[1]}"', f'"{sentences.index(found[1])}"'), each) for each in (body, own))
    program, loader = f'"use strict";{text}\n(async () => {{\n{tight(own)}}})();\n', page_part("loader.js")
    fills = style.PALETTE[: max(len(style.BODIES), most + 1)]  # those of bodies up to a place in the palette, ten at least
    colours = {name.lower(): getattr(style, name) for name in COLOURS} | {f"body{k}": fill for k, fill in enumerate(fills)}
    styles = NO_SPACE.sub(r"\1", f":root {{ {''.join(f'--{name}:{value};' for name, value in colours.items())} }}\n{bare(css)}")
    filled_in = {
        "LANGUAGE": language,
        "TITLE": escape(title),
        "BODY": packed(fill_template(bare(body), {"TITLE": escape(title)})),
        "STYLE": packed(styles),
        "STYLE_HASH": source_hash(styles),
        "LOADER": loader,
        "LOADER_HASH": source_hash(loader),
        "PROGRAM": packed(program),
        "PROGRAM_HASH": source_hash(program),
        "DATA": packed(json.dumps(data, ensure_ascii=False, separators=(",", ":"), allow_nan=False)),
    }
    return fill_template(page_part("page.html"), filled_in)


def page_place(path: Place) -> Path:
    """Return the path of a page; DefinitionError for anything but a name that ends in .html."""
    is_page = isinstance(path, (str, PathLike)) and Path(path).suffix.lower() == ".html"
    require(is_page, "", path, "is no name of a page; give one that ends in .html")
    return Path(path)


def said_in(text: str) -> list[str]:
    """Return the English sentences in the program or the text of a page, each once. `{gap}` and the like are filled in there."""
    return list(dict.fromkeys(SAID.findall(text)))


def page_part(name: str) -> str:
    """Return a file of this room, or of another one, "board/board.html"."""
    room, _, file = name.rpartition("/")
    return files(f"linkage.{room or 'pictures'}").joinpath(file).read_text(encoding="utf-8")


def source_hash(text: str) -> str:
    """Return the hash by which a content security policy names an inline script or style."""
    return f"'sha256-{b64encode(sha256(text.encode()).digest()).decode()}'"


def bare(text: str) -> str:
    """Return a program or a style sheet without the comments that fill lines of their own, and without its indents."""
    return "\n".join(line.lstrip() for line in re.sub(r"(?m)^[ ]*/\*(?:[^*]|\*(?!/))*\*/[ ]*\n", "", text).splitlines() if line.strip())


@lru_cache(maxsize=8)  # the same parts of every page
def tight(program: str) -> str:
    """Return a program as `bare` does, and without the spaces about its signs."""
    parts = KEPT.split(bare(program))
    return "".join(part if k % 2 else TIGHT.sub(r"\1\2", part) for k, part in enumerate(parts))


def packed(text: str) -> str:
    """Return a text compressed by zlib and written in 94 letters, nine bytes in eleven: those of ASCII without the begin of an element."""
    tried = [compressobj(9, memLevel=level) for level in range(4, 10)]  # which one packs best hangs on the text
    found = min((each.compress(text.encode()) + each.flush() for each in tried), key=len)
    count = -(-len(found) // 9)
    parts = np.frombuffer(found.ljust(9 * count, b"\0"), np.uint8).reshape(count, 3, 3) @ np.array([1 << 16, 1 << 8, 1])  # of three bytes
    letters, rest = np.empty((count, 11), np.uint8), np.zeros(count, int)
    for place in range(10, -1, -1):  # the remainder of a division by 94, of all numbers at once
        rest[:] = 0
        for k in range(3):
            parts[:, k], rest = np.divmod(parts[:, k] + (rest << 24), 94)
        letters[:, place] = 32 + rest
    return letters.tobytes().decode()[: -(-11 * len(found) // 9)].replace("<", "~")


def fill_template(template: str, parts: dict[str, str]) -> str:
    """Return a template with each `{{NAME}}` replaced once; inserted text is not searched again."""
    pieces = template.split("{{")
    done = [pieces[0]]
    for piece in pieces[1:]:
        name, _, rest = piece.partition("}}")
        done += [parts[name], rest]
    return "".join(done)
