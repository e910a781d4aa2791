"""Stroke values as they are asked for: counts, values, grids."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from math import isfinite
from typing import Any

import numpy as np

from ..errors import DefinitionError, unknown
from ..program import FloatArray
from ..quantities import Stroke, real


def known_strokes(given: Mapping[str, Any], strokes: Mapping[str, Stroke], title: str) -> None:
    """Raise DefinitionError for a stroke that is not there or not given."""
    for name in given:
        if name not in strokes:
            raise unknown("Stroke", name, strokes, where=title)
    missing = [name for name in strokes if name not in given]
    if missing:
        raise DefinitionError(f"{title}: the stroke {', '.join(missing)} is not given; say {', '.join(f'{name}=...' for name in missing)}.")


def at_values(
    given: Mapping[str, Any], strokes: Mapping[str, Stroke], title: str, take: Callable[[Any], FloatArray] = real
) -> dict[str, FloatArray]:
    """Return chosen stroke values, broadcast against each other; `take` makes arrays of them."""
    known_strokes(given, strokes, title)
    try:
        arrays = [take(given[name]) for name in strokes]
    except ValueError:
        raise DefinitionError(f"{title}: strokes are numbers or arrays of numbers (SI); given {dict(given)!r}.") from None
    for name, array in zip(strokes, arrays, strict=True):
        if array.size and not (isfinite(array.min()) and isfinite(array.max())):
            raise DefinitionError(f"{title}: the stroke {name} holds a value that is not finite.")
    try:
        return dict(zip(strokes, np.broadcast_arrays(*arrays), strict=True))
    except ValueError:
        shapes = ", ".join(f"{name} {array.shape}" for name, array in zip(strokes, arrays, strict=True))
        raise DefinitionError(f"{title}: the strokes' shapes do not fit each other: {shapes}.") from None


def as_given(value: Any) -> FloatArray:
    """Return an array of floats as it is, not copied; anything else as `real` does."""
    return value if type(value) is np.ndarray and value.dtype == np.float64 else real(value)


def sweep_values(count: int | None, given: Mapping[str, Any], strokes: Mapping[str, Stroke], title: str) -> dict[str, FloatArray]:
    """Return strokes over their ranges: an int is a count, a float a value; two counts give a grid."""
    if count is not None:
        if not strokes:
            raise DefinitionError(f"{title} has no stroke, so there is nothing to sweep; declare one, S = Stroke(0, 0.25), or ask at().")
        if len(strokes) != 1 or given:
            each = ", ".join(f"{name}=..." for name in strokes)
            raise DefinitionError(f"{title} has {len(strokes)} strokes: say sweep({each}), an int for a count and a float for a value.")
        if not isinstance(count, (int, np.integer)) or isinstance(count, bool):
            remedy = f"for a value write at({next(iter(strokes))}={count!r})"
            raise DefinitionError(f"{title}: sweep({count!r}): a whole number of poses is expected; {remedy}.")
        given = {next(iter(strokes)): count}
    known_strokes(given, strokes, title)
    axes = [_axis(name, given[name], strokes[name], title) for name in strokes]
    counted = [axis for axis in axes if axis.ndim]
    grids = iter(np.meshgrid(*counted, indexing="ij")) if counted else iter(())
    full = [next(grids) if axis.ndim else axis for axis in axes]
    return dict(zip(strokes, np.broadcast_arrays(*full), strict=True))


def _axis(name: str, asked: Any, stroke: Stroke, title: str) -> FloatArray:
    if isinstance(asked, (int, np.integer)) and not isinstance(asked, bool):
        if asked < 1:
            raise DefinitionError(f"{title}: sweep({name}={asked}): a count of at least 1 is expected; for a value write {float(asked)}.")
        try:
            return np.linspace(stroke.start, stroke.end, int(asked))
        except (MemoryError, OverflowError, ValueError):
            raise DefinitionError(f"{title}: sweep({name}={asked}): so many poses do not fit into memory; ask for fewer.") from None
    if isinstance(asked, (float, np.floating)) and np.isfinite(asked):
        return np.asarray(asked, float)
    raise DefinitionError(f"{title}: sweep({name}={asked!r}): an int is a count, a float a value; for chosen values use at({name}=...).")
