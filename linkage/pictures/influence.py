"""Influence of dimensions on a result: the greatest of its exact slopes over the judged poses, times each slider's step."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ..errors import LinkageError, unwarned
from ..motion import Judge, RequestLike

NOTHING = 1e-9
"""Of the greatest influence: a dimension that has no more moves nothing."""


def influences(judge: Judge, request: RequestLike, ranges: Mapping[str, float]) -> dict[str, float]:
    """Return how far each dimension moves a result at most over its slider [SI], the greatest first, those that move nothing left out.

    `ranges` is how far each slider goes [SI]. Nothing where a result has no derivatives.
    """
    names, found = list(ranges), np.zeros(len(ranges))
    for place in judge.places:
        try:
            with unwarned():
                slopes = place.sampled.gradient(request, names)
        except LinkageError:
            return {}
        found = np.maximum(found, np.abs(np.nan_to_num(slopes, posinf=0.0, neginf=0.0)).reshape(len(names), -1).max(axis=1))
    moved = found * np.array([*ranges.values()])
    order = np.argsort(-moved, kind="stable")
    return {names[k]: float(moved[k]) for k in order if moved[k] > NOTHING * moved.max(initial=0.0)}
