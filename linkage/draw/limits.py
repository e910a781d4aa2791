"""Limit lines: a value that a result may not pass, and on which side it fails."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from ..errors import DefinitionError, cited
from ..program import FloatArray
from ..quantities import is_number


class Limit(NamedTuple):
    """A value [SI] that a column may not pass, its words, and the side that fails: "above" or "below"."""

    value: float
    text: str = ""
    fails: str = "above"

    def failing(self, values: FloatArray) -> FloatArray:
        """Return the mask of the values [SI] that fail."""
        return np.asarray(values > self.value if self.fails == "above" else values < self.value)


def limit(given: Sequence[Any]) -> Limit:
    """Return a limit from a tuple of its parts; DefinitionError for a side that is neither above nor below."""
    parts = tuple(given) if isinstance(given, (list, tuple)) else ()
    if not 1 <= len(parts) <= 3 or not is_number(parts[0]) or not all(isinstance(each, str) for each in parts[1:]):
        raise DefinitionError(f'{cited(given)} is no limit; write (value [SI], text) or (value, text, "below").')
    found = Limit(*parts)
    if found.fails not in ("above", "below"):
        raise DefinitionError(f'the limit {found.text or found.value!r} fails {found.fails!r}: say "above" or "below".')
    return found


def crossings(along: FloatArray, values: FloatArray, at: float) -> list[float]:
    """Return where values cross a limit, by straight lines between the poses."""
    off = values - at
    places = np.flatnonzero(np.signbit(off[1:]) != np.signbit(off[:-1]))
    places = places[np.isfinite(off[places]) & np.isfinite(off[places + 1])]
    return [float(along[i] - off[i] * (along[i + 1] - along[i]) / (off[i + 1] - off[i])) for i in places]
