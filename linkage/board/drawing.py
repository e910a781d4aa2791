"""Data of the board's page from Python: its first drawing, and the names that no member may have."""

from __future__ import annotations

from keyword import kwlist, softkwlist
from typing import Any

from ..sketch import MachineSketch
from ..sketch.board_json import board_tables
from ..sketch.found import WORDS


def drawing_data(sketch: MachineSketch | None = None) -> dict[str, Any]:
    """Return the data of a page on which a sketch is drawn, or nothing yet.

    Parameters
    ----------
    sketch : MachineSketch, optional
        What is drawn already.

    Returns
    -------
    dict
        `drawing`, the tables of the board's file or None, and `reserved`, the names that no member may have.
    """
    return {"drawing": None if sketch is None else board_tables(sketch), "reserved": sorted({*WORDS, *kwlist, *softkwlist})}
