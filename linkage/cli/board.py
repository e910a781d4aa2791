"""`hydrolinkage board`: a page on which a machine is drawn and moves, empty or with a machine on it."""

from __future__ import annotations

import os
from argparse import Namespace
from pathlib import Path

from ..errors import ensure
from .command import Command, option
from .machines import find


@Command(
    "board",
    "a drawing board, .html: draw a machine, move it, take it as Python or TOML, offline",
    option("machine", metavar="MACHINE", nargs="?", help="a machine of `list`, or a file that `show` or `import` reads (default: empty)"),
    option("-o", "--output", metavar="FILE", default="board.html", help="the page, .html (default: board.html)"),
)
def board_command(options: Namespace) -> int:
    """Write a board into a file."""
    from ..board import drawing_board
    from ..sketch import is_foreign, read_sketch

    path = Path(options.output)
    is_source = options.machine is not None and os.path.exists(options.machine) and path.exists()
    ensure(not (is_source and os.path.samefile(path, options.machine)), f"{path} is the file that is opened; choose another name, -o FILE.")
    text = options.machine
    found = None if text is None else read_sketch(text) if is_foreign(text) else find(text)
    print(drawing_board(found, path, language=options.language))
    return 0
