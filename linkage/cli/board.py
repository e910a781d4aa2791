"""`hydrolinkage board`: a page on which a machine is drawn and moves, empty or with a machine on it."""

from __future__ import annotations

from argparse import Namespace

from ..disk import is_one_file
from ..errors import ensure
from .command import Command, option, say_remark
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
    from ..sketch import is_foreign, read_sketch, sketch_of
    from ..sketch.board_json import board_notes

    text, path = options.machine, options.output
    ensure(text is None or not is_one_file(path, text), f"{path} is the file that is opened; choose another name, -o FILE.")
    sketch = None if text is None else read_sketch(text) if is_foreign(text) else sketch_of(find(text))
    print(drawing_board(sketch, path, language=options.language))
    for note in board_notes(sketch) if sketch is not None else ():
        say_remark(note)
    return 0
