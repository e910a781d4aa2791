"""The drawing board: one page on which a machine is drawn and moves, in a file without network access."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from typing import Any

from .. import plugins
from ..disk import check_place, replacing_text
from ..language import language as spoken_language
from ..language import said
from ..mechanism import Mechanism
from ..pictures.page_data import signs
from ..pictures.page_file import page_place, page_text
from ..sketch import MachineSketch, sketch_of
from .drawing import drawing_data

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
    sketch = machine if machine is None or isinstance(machine, MachineSketch) else sketch_of(machine)
    data = drawing_data(sketch) | {
        "sizes": cylinder_sizes(),
        "scene": {name: [] for name in SCENE},
        "rows": {"points": []},
        "cylinders": [],
        "signs": signs({*UNITS, "kg"}),
    }
    with spoken_language(language):
        title = said("Drawing board")
    with replacing_text(target) as stream:
        stream.write(page_text(title, data, PARTS, language=language))
    return target


def cylinder_sizes() -> dict[str, list[Any]]:
    """Return the pairs of bore and rod and the strokes of the catalogue [m], of the package that brings cylinders; empty without one."""
    entry = plugins.entry_points(plugins.MEMBERS).get("cylinder")
    if entry is None:
        return {"pairs": [], "strokes": []}
    rows = plugins.guarded(lambda: import_module(entry.module).catalogue(dead=1.0), f"The package {entry.module}")
    return {"pairs": sorted({(each.bore, each.rod) for each in rows}), "strokes": sorted({each.stroke for each in rows})}
