"""Out again: a sketch as the text of other programs' files."""

from __future__ import annotations

from collections.abc import Callable

from ..errors import ensure
from .board_json import board_json
from .linkage_xml import linkage_xml
from .machine_sketch import MachineSketch
from .pmks_text import pmks_text
from .points_csv import points_csv

WRITERS: dict[str, Callable[[MachineSketch], str]] = {
    ".toml": MachineSketch.to_toml,
    ".py": MachineSketch.to_python,
    ".json": board_json,
    ".csv": points_csv,
    ".linkage2": linkage_xml,
    ".txt": pmks_text,
}
"""What writes a sketch, by the end of the file's name."""


def sketch_text(sketch: MachineSketch, suffix: str) -> str:
    """Return a sketch as the text of a file.

    Parameters
    ----------
    sketch : MachineSketch
        The sketch.
    suffix : str
        .toml or .py for a machine, .json for the board, .csv for a table of points and links, .linkage2 for Linkage, .txt for PMKS.

    Returns
    -------
    str
        The text.

    Raises
    ------
    DefinitionError
        The ending is none of these, or the program has no word for what the sketch holds.
    """
    ensure(suffix in WRITERS, f"{suffix or 'no ending'} says no kind of file; a sketch is written as {', '.join(WRITERS)}.")
    return WRITERS[suffix](sketch)
