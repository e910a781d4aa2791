"""Names of cells: what a spreadsheet takes as one, each once."""

from __future__ import annotations

import re
from collections.abc import Iterable

LIKE_A_CELL = re.compile(r"[a-z]{1,3}\d+|[rc]\d*|r\d*c\d*|true|false", re.IGNORECASE)
"""A1, XFD7, R, C, R1C1: what a spreadsheet reads as a place, and its two words for truth."""
LONGEST_NAME = 200


def cell_names(texts: Iterable[str]) -> dict[str, str]:
    """Return the name of a cell for each text: `L_OB` for itself, `A_x` for `A.x`, `_L0` for `L0`, which is a place in a sheet.

    Names that differ in small and capital letters alone are one to a spreadsheet: the second gets a number.
    """
    names: dict[str, str] = {}
    taken: set[str] = set()
    for text in texts:
        plain = re.sub(r"\W", "_", text)[:LONGEST_NAME] or "_"
        name = wanted = f"_{plain}" if plain[0].isdigit() or LIKE_A_CELL.fullmatch(plain) else plain
        count = 1
        while name.lower() in taken:
            count += 1
            name = f"{wanted}_{count}"
        taken.add(name.lower())
        names[text] = name
    return names
