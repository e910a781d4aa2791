"""The page of the command: what each command says of itself when it is asked for help."""

from __future__ import annotations

import contextlib
import io
import os
import re
from pathlib import Path

from linkage.cli import main

WIDTH = 98
HEAD = """# Commands

`hydrolinkage COMMAND ...`, the same as `python -m linkage`. These are the words of `hydrolinkage COMMAND --help`.

"""


def make(path: Path) -> None:
    """Write the page."""
    overview = printed("--help")
    parts = [HEAD, block(overview)]
    for name in names_in(overview):
        parts.append(f"\n## {name}\n\n{block(printed(name, '--help'))}")
    path.write_text("".join(parts), encoding="utf-8")


def printed(*words: str) -> str:
    """Return what a command prints, in lines of some width."""
    said = io.StringIO()
    before = {name: os.environ.get(name) for name in ("COLUMNS", "NO_COLOR")}
    os.environ |= {"COLUMNS": str(WIDTH + 2), "NO_COLOR": "1"}
    try:
        with contextlib.redirect_stdout(said):
            code = main(words)
    finally:
        for name, value in before.items():
            os.environ.pop(name) if value is None else os.environ.__setitem__(name, value)
    if code:
        raise RuntimeError(f"{' '.join(words)}: {said.getvalue()}")
    return said.getvalue().rstrip()


def names_in(overview: str) -> list[str]:
    """Return the commands that the overview lists, in its order."""
    return list(dict.fromkeys(re.findall(r"^    (\w+)(?: {2,}\S|$)", overview, re.MULTILINE)))


def block(text: str) -> str:
    """Return text as a block of code."""
    return f"```text\n{text}\n```\n"
