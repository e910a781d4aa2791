"""Tables as TOML text: a line for each member where it fits, a table of its own where it does not."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from textwrap import fill
from typing import Any

WIDTH = 120


def toml_text(data: Mapping[str, Any]) -> str:
    """Return the text of a file's tables: plain values first, then a table for each section."""
    head = [f"{key(name)} = {long_text(value)}" for name, value in data.items() if not isinstance(value, Mapping)]
    sections = ["\n".join(section(name, table)) for name, table in data.items() if isinstance(table, Mapping)]
    return "\n\n".join(["\n".join(head), *sections]) + "\n"


def section(name: str, table: Mapping[str, Any]) -> Iterator[str]:
    """Yield a section's lines."""
    lines = [f"{key(each)} = {inline(value)}" for each, value in table.items()]
    if all(len(line) <= WIDTH or not isinstance(value, Mapping) for line, value in zip(lines, table.values(), strict=True)):
        yield f"[{key(name)}]"
        yield from lines
        return
    for place, (each, value) in enumerate(table.items()):
        yield from ["", f"[{key(name)}.{key(each)}]"][place == 0 :]
        yield from (f"{key(part)} = {inline(inner)}" for part, inner in value.items())


def key(name: str) -> str:
    """Return a key, in quotes where its letters are not all plain."""
    return name if re.fullmatch(r"[A-Za-z0-9_-]+", name) else inline(name)


def inline(value: Any) -> str:
    """Return a value in one line."""
    if isinstance(value, Mapping):
        return f"{{ {', '.join(f'{key(name)} = {inline(each)}' for name, each in value.items())} }}"
    if isinstance(value, list):
        return f"[{', '.join(map(inline, value))}]"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    return repr(value)


def long_text(value: Any) -> str:
    """Return a value of the head; a text of several lines as such, a list of names filled into lines."""
    if isinstance(value, list):
        return "[\n" + fill(" ".join(f"{inline(each)}," for each in value), WIDTH, initial_indent="    ", subsequent_indent="    ") + "\n]"
    if not isinstance(value, str) or "\n" not in value:
        return inline(value)
    escaped = value.replace("\\", "\\\\").replace('"""', '""\\"')
    if escaped.endswith('"'):
        escaped = escaped[:-1] + '\\"'
    return f'"""\n{escaped}"""'
