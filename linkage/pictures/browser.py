"""A live page: a mechanism that moves and changes in a browser, in one file without network access."""

from __future__ import annotations

import json
import os
from base64 import b64encode
from hashlib import sha256
from html import escape
from importlib.resources import files
from pathlib import Path
from typing import Any
from zlib import compress

from ..disk import check_place, replacing_text
from ..errors import DefinitionError, cited, known_name
from ..mechanism import Mechanism, require_mechanism
from ..motion import live_text
from . import style
from .browser_data import PageRequests, page_data
from .browser_words import words_in
from .strokes import frame_count

COLOURS = ("INK", "MUTED", "RULE", "GRID", "PAPER", "CURVE", "ACCENT", "BARREL", "ROD", "PISTON")
LANGUAGES = ("en", "ru")
COUNT = 101
"""Poses of the curve."""


def page(machine: Mechanism, path: str | Path, **given: Any) -> Path:
    """Return the path of the live page it wrote; `given` are the other arguments of `linkage.page`."""
    require_mechanism(machine)
    if not isinstance(path, (str, os.PathLike)) or Path(path).suffix.lower() != ".html":
        raise DefinitionError(f"{cited(path)} is no name of a page; give one that ends in .html.")
    target = Path(path)
    text = page_html(machine, place=target, **given)
    with replacing_text(target) as stream:
        stream.write(text)
    return target


def page_html(machine: Mechanism, *, count: int = COUNT, language: str = "en", place: Path | None = None, **given: Any) -> str:
    """Return the HTML of a live page; `given` are the other arguments of `linkage.page`."""
    require_mechanism(machine)
    known_name("Language", language, LANGUAGES, where="page(language=...)")
    requests = PageRequests(machine, frame_count(count), **given)
    if place is not None:
        check_place(place)
    live = live_text(machine.plan, requests.by_name, name="engine")
    data = page_data(requests, live) | {"language": language, "words": {name: words_in(name) for name in LANGUAGES[1:]}}
    program, loader = f'"use strict";{live.text}\n{page_part("judge.js")}\n{page_part("page.js")}', page_part("loader.js")
    styles = f":root {{ {colours()} }}\n{page_part('page.css')}"
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


def colours() -> str:
    """Return the style's colours as properties of a style sheet."""
    named = {name.lower(): getattr(style, name) for name in COLOURS} | {f"body{k}": fill for k, fill in enumerate(style.BODIES)}
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
