"""The lines of a TOML file on which its keys stand."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

_PART = r"""[A-Za-z0-9_-]+|"[^"\n]*"|'[^'\n]*'"""
_PATH = re.compile(rf"\s*(\[)?\s*((?:{_PART})(?:\s*\.\s*(?:{_PART}))*)\s*(?:=|\])")
_SPLIT = re.compile(_PART)
_LONG = re.compile(r'"""|' + r"'''")


def lines(text: str) -> Mapping[tuple[str, ...], int]:
    """Return the line, counted from 1, of every table and key that stands at the start of one."""
    found: dict[tuple[str, ...], int] = {}
    table: tuple[str, ...] = ()
    for number, line in outside(text):
        match = _PATH.match(line)
        if match is None:
            continue
        path = tuple(part.strip("\"'") for part in _SPLIT.findall(match.group(2)))
        if match.group(1):
            table = path
        found.setdefault(table if match.group(1) else (*table, *path), number)
    return found


def outside(text: str) -> Iterator[tuple[int, str]]:
    """Yield the lines, with their numbers, that do not start inside a text of several lines."""
    inside = ""
    for number, line in enumerate(text.splitlines(), 1):
        if not inside:
            yield number, line
        for mark in _LONG.findall(line):
            inside = "" if inside == mark else inside or mark


def line_of(found: Mapping[tuple[str, ...], int], key: tuple[str, ...]) -> int:
    """Return the line of a key, else the first one inside it, else that of the nearest table around it; 0 where none is known."""
    inside = [line for path, line in found.items() if key and path[: len(key)] == key]
    around = (found[key[:end]] for end in range(len(key), 0, -1) if key[:end] in found)
    return found[key] if key in found else min(inside, default=next(around, 0))
