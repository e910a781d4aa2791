"""The drawing board: one page on which a machine is drawn and moves, in a file without network access."""

from __future__ import annotations

from importlib import import_module
from keyword import kwlist, softkwlist
from pathlib import Path

from .. import plugins
from ..disk import check_place, replacing_text
from ..language import language as spoken_language
from ..language import said
from ..mechanism import Mechanism
from ..pictures.page_data import signs
from ..pictures.page_file import page_place, page_text
from ..sketch import MachineSketch, sketch_of
from ..sketch.board_json import board_tables
from ..sketch.found import WORDS

PARTS = (
    "board/board.html", "page.css", "board/board.css", "mechanism.js", "labels.js", "copy.js", "board/model.js", "board/solver.js",
    "board/writers.js", "board/sheet.js", "board/work.js", "board/panel.js", "board/tools.js", "board/exchange.js",
)  # fmt: skip
UNITS = ("mm", "m", "in")
"""The lengths that the board shows and reads."""
SCENE = ("names", "bodies", "tracks", "contours", "straights", "around", "loads", "stays", "pins", "dots", "grounds", "labels")
"""What a page draws; the board fills it as one draws."""


def drawing_board(
    machine: Mechanism | type[Mechanism] | MachineSketch | None = None, path: str | Path = "board.html", *, language: str = "en"
) -> Path:
    """Write a drawing board, a page on which machines are drawn, moved and exported. It needs no network.

    Parameters
    ----------
    machine : Mechanism, type of Mechanism or MachineSketch, optional
        What is on the sheet at first. By default it is empty.
    path : str or Path
        The file, .html.
    language : str
        The language in which it begins, "en" or "ru"; a button changes it.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    DefinitionError
        A sketch has no word for what the machine holds, or the name does not end in .html.
    FileError
        The file cannot be written.

    Examples
    --------
    >>> from linkage import drawing_board
    >>> drawing_board(None, "board.html").name  # doctest: +SKIP
    'board.html'
    """
    target = page_place(path)
    check_place(target)
    data = drawing_data(machine if machine is None or isinstance(machine, MachineSketch) else sketch_of(machine))
    with spoken_language(language):
        title = said("Drawing board")
    with replacing_text(target) as stream:
        stream.write(page_text(title, data, PARTS, language=language))
    return target


def drawing_data(sketch: MachineSketch | None = None) -> dict[str, object]:
    """Return the data of a page on which a sketch is drawn, or nothing yet.

    Parameters
    ----------
    sketch : MachineSketch, optional
        What is drawn already.

    Returns
    -------
    dict
        `drawing`, the tables of the board's file or None, and `reserved`, the names that no member may have. `sizes` are the pairs of bore
        and rod and the strokes of the catalogue [m], none where no package brings cylinders. The rest is filled as one draws.
    """
    entry, rows = plugins.entry_points(plugins.MEMBERS).get("cylinder"), []
    if entry is not None:
        rows = plugins.guarded(lambda: import_module(entry.module).catalogue(dead=1.0), f"The package {entry.module}")
    return {
        "drawing": None if sketch is None else board_tables(sketch),
        "reserved": sorted({*WORDS, *kwlist, *softkwlist}),
        "sizes": {"pairs": sorted({(each.bore, each.rod) for each in rows}), "strokes": sorted({each.stroke for each in rows})},
        "scene": {name: [] for name in SCENE},
        "rows": {"points": []},
        "cylinders": [],
        "signs": signs({*UNITS, "kg"}),
    }
