"""A live page: a mechanism that moves and changes in a browser, in one file without network access."""

from __future__ import annotations

import json
import os
from base64 import b64encode
from collections.abc import Mapping, Sequence
from hashlib import sha256
from html import escape
from importlib.resources import files
from pathlib import Path
from typing import Any
from zlib import compress

from ..disk import check_place, replacing_text
from ..errors import DefinitionError, cited, known_name
from ..mechanism import Mechanism, require_mechanism
from ..motion import Column, RequestLike, live_text
from ..reports import NOTHING
from . import style
from .browser_data import PageRequests, page_data
from .browser_words import words_in
from .strokes import frame_count

COLOURS = ("INK", "MUTED", "RULE", "GRID", "PAPER", "CURVE", "ACCENT", "BARREL", "ROD", "PISTON")
LANGUAGES = ("en", "ru")
COUNT = 101
"""Poses of the curve."""


def page(
    machine: Mechanism,
    path: str | Path,
    *,
    vary: Sequence[str] | Mapping[str, Sequence[float] | None] | None = None,
    columns: Sequence[Column | RequestLike] | None = None,
    column: str | None = None,
    trace: Sequence[str] | None = None,
    limit: Sequence[Any] | Mapping[str, Sequence[Any]] | None = None,
    at: Mapping[str, Any] = NOTHING,
    count: int = 101,
    language: str = "en",
) -> Path:
    """Return the path of the live page it wrote, .html: one file without network access, in which the mechanism moves and changes.

    Every stroke has a slider, and so have the dimensions of `vary`, `["OB", "CD"]` or with their ranges [SI], `{"OB": (0.28, 0.34)}`, of a
    point "M" both coordinates; without it the first lengths, a mass and a bore. All others can be added in the page, and pins on the
    ground can be dragged. Everything is worked out anew in the browser by the machine's own program; a value goes only as far as the
    mechanism can be assembled, and the page says which step is how much short.

    `columns` are what its chooser offers, names of columns or requests such as `capacity("lift", "G")`, by default the table of
    results; `column` is shown first, else what the machine is about. A column that no program gives is shown for the delivered design
    alone, with the reason. `limit` is the limit of that column, `(value [SI], text, "above" or "below")`, or limits by column. `trace`
    names points whose paths are drawn, `at=dict(tilt=0.1)` holds another stroke, `at=dict(S=(0.1, 0.2))` says where one runs [m or rad],
    `count` is the number of poses of the curve. The page speaks English and Russian, `language` is the one it begins with.

    Raises DefinitionError for a batch of designs, an unknown name, or a file that does not end in .html, FileError for a path that cannot
    be written.
    """
    require_mechanism(machine)
    if not isinstance(path, (str, os.PathLike)) or Path(path).suffix.lower() != ".html":
        raise DefinitionError(f"{cited(path)} is no name of a page; give one that ends in .html.")
    target = Path(path)
    text = page_html(
        machine, place=target, vary=vary, columns=columns, column=column, trace=trace, limit=limit, at=at, count=count, language=language
    )  # fmt: skip
    with replacing_text(target) as stream:
        stream.write(text)
    return target


def page_html(machine: Mechanism, *, count: int = COUNT, language: str = "en", place: Path | None = None, **given: Any) -> str:
    """Return the HTML of a live page; `given` are the other arguments of `page`."""
    require_mechanism(machine)
    known_name("Language", language, LANGUAGES, where="page(language=...)")
    requests = PageRequests(machine, frame_count(count), **given)
    if place is not None:
        check_place(place)
    live = live_text(machine.plan, requests.by_name, name="engine")
    data = page_data(requests, live) | {"language": language, "words": {name: words_in(name) for name in LANGUAGES[1:]}}
    program, loader = f'"use strict";{live.text}\n{page_part("judge.js")}\n{page_part("page.js")}', page_part("loader.js")
    styles = f":root {{ {colours(max(requests.scene.colours, default=0))} }}\n{page_part('page.css')}"
    parts = {
        "LANGUAGE": language,
        "TITLE": escape(machine.plan.heading),
        "STYLE": styles,
        "STYLE_HASH": source_hash(styles),
        "LOADER": loader,
        "LOADER_HASH": source_hash(loader),
        "PROGRAM": packed(program),
        "PROGRAM_HASH": source_hash(program),
        "DATA": packed(json.dumps(data, ensure_ascii=False, separators=(",", ":"), allow_nan=False)),
    }
    return filled(page_part("page.html"), parts)


def colours(most: int = 0) -> str:
    """Return the style's colours as properties of a style sheet, those of bodies up to a place in the palette, ten at least."""
    fills = style.PALETTE[: max(len(style.BODIES), most + 1)]
    named = {name.lower(): getattr(style, name) for name in COLOURS} | {f"body{k}": fill for k, fill in enumerate(fills)}
    return "".join(f"--{name}:{value};" for name, value in named.items())


def page_part(name: str) -> str:
    """Return a file of this room."""
    return files(__package__).joinpath(name).read_text(encoding="utf-8")


def source_hash(text: str) -> str:
    """Return what a content security policy names an inline script or style by."""
    return f"'sha256-{b64encode(sha256(text.encode()).digest()).decode()}'"


def packed(text: str) -> str:
    """Return a text compressed by zlib and written in base64: half of what it is or less, and nothing in it can end an element."""
    return b64encode(compress(text.encode(), 9)).decode()


def filled(template: str, parts: dict[str, str]) -> str:
    """Return a template with each `{{NAME}}` replaced once; what is put in is not looked at again."""
    pieces = template.split("{{")
    done = [pieces[0]]
    for piece in pieces[1:]:
        name, _, rest = piece.partition("}}")
        done += [parts[name], rest]
    return "".join(done)
