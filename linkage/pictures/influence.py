"""Influence of dimensions on results: the greatest of their exact slopes over some poses, times each slider's step."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from ..errors import LinkageError, unwarned
from ..motion import Motion, RequestLike

NOTHING = 1e-9
"""Of the greatest influence: a dimension that has no more moves nothing."""


def influences(motions: Sequence[Motion], requests: Sequence[RequestLike], ranges: Mapping[str, float]) -> dict[str, float]:
    """Return how far each dimension moves results at most over its slider [SI], the greatest first, those that move nothing left out.

    `ranges` is how far each slider goes [SI]. Nothing where a result has no derivatives.
    """
    names, found = list(ranges), np.zeros(len(ranges))
    for motion, request in ((motion, request) for motion in motions for request in requests):
        try:
            with unwarned():
                slopes = motion.gradient(request, names)
        except LinkageError:
            return {}
        found = np.maximum(found, np.abs(np.nan_to_num(slopes, posinf=0.0, neginf=0.0)).reshape(len(names), -1).max(axis=1))
    moved = found * np.array([*ranges.values()])
    order = np.argsort(-moved, kind="stable")
    return {names[k]: float(moved[k]) for k in order if moved[k] > NOTHING * moved.max(initial=0.0)}
