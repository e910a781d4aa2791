"""The step of a damped least squares problem under linear inequalities, exact, by non-negative least squares."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..program import FloatArray

LEAST = 1e-12
"""Of the largest column: what a column without any effect is damped by."""
GIVING_WAY: Sequence[float] = (1.0, 0.5, 0.1, 0.0)
"""What part of what is missing of a line a step makes good: the first for which there is a step at all."""


def constrained_step(
    slopes: FloatArray, misses: FloatArray, line_slopes: FloatArray, lines: FloatArray, ends: tuple[FloatArray, FloatArray], damping: float
) -> FloatArray:
    """Return the step (n,) that makes |misses + slopes step|^2, damped, least, with lines + line_slopes step >= 0, between ends (n,) each.

    Where no step makes good all that is missing of the lines, it makes good a part of it. Source: C. L. Lawson, R. J. Hanson, Solving Least
    Squares Problems (1974), 23: a problem of least distance.
    """
    from scipy.optimize import nnls

    n = slopes.shape[1]
    sizes = np.sqrt(np.sum(slopes**2, axis=0))
    sizes = np.maximum(sizes, LEAST * (sizes.max(initial=0.0) or 1.0))
    sizes[sizes <= 2.0 * LEAST * sizes.max()] = 1.0
    orthogonal, triangle = np.linalg.qr(np.concatenate([slopes / sizes, np.sqrt(damping) * np.eye(n)]))
    inverse = np.linalg.inv(triangle) / sizes[:, None]
    free = orthogonal.T @ np.concatenate([-misses, np.zeros(n)])
    low, high = ends
    rows = np.concatenate([line_slopes, np.eye(n), -np.eye(n)])
    known = np.concatenate([lines, -low, high])
    kept = np.isfinite(known) & (rows != 0.0).any(axis=1)
    rows, known = rows[kept], known[kept]
    table = rows @ inverse
    size = np.linalg.norm(table, axis=1)
    size[size == 0.0] = 1.0
    for part in GIVING_WAY:
        short = -np.where(known < 0.0, part * known, known) - table @ free
        try:
            weights, _ = nnls(np.concatenate([(table / size[:, None]).T, (short / size)[None]]), np.append(np.zeros(n), 1.0))
        except RuntimeError:
            continue
        rest = np.append((table / size[:, None]).T @ weights, (short / size) @ weights - 1.0)
        if rest[-1] < -1e-12:
            return np.asarray(np.clip(inverse @ (free - rest[:-1] / rest[-1]), low, high))
    return np.zeros(n)
