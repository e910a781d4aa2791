"""Text made into functions."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any


def compiled(text: str, names: Mapping[str, Any]) -> dict[str, Any]:
    """Return the functions of a program's text."""
    space: dict[str, Any] = dict(names) | {"nan": math.nan, "inf": math.inf}
    exec(compile(text, "<linkage program>", "exec"), space)
    return space
