"""Many small linear systems at once, and one in floats."""

from __future__ import annotations

import math

import numpy as np

from ..vectors import FloatArray, Numbers

#: Up to so many systems LAPACK, called once, is cheaper than one elimination in array steps.
FEW = 64


def unknowns(count: int) -> int:
    """Return how many unknowns a system of n * n + n entries has."""
    return (math.isqrt(4 * count + 1) - 1) // 2


def solve_arrays(*entries: Numbers) -> FloatArray:
    """Return the unknowns of many systems at once, shape (n, ...): n * n matrix entries by rows, then n right sides.

    One elimination for all, each pivot the row that is large in every system; where no row is, LAPACK pivots each.
    """
    n = unknowns(len(entries))
    size = max(np.size(each) for each in entries)
    if size <= FEW:
        return _pivoted_each(n, entries)
    arrays = [np.array(each, float) for each in np.broadcast_arrays(*entries)]
    rows = [[*arrays[k * n : k * n + n], arrays[n * n + k]] for k in range(n)]
    found = _eliminated(rows)
    return _pivoted_each(n, entries) if found is None else np.stack(found)


def _eliminated(rows: list[list[FloatArray]]) -> list[FloatArray] | None:
    """Return the unknowns by one elimination over all systems; None where no row is a safe pivot for all."""
    n = len(rows)
    left = list(rows)
    order: list[list[FloatArray]] = []
    for k in range(n):
        sizes = [np.abs(row[k]) for row in left]
        worth = [float(np.min(size / np.max(sizes, axis=0), initial=np.inf)) for size in sizes]
        best = int(np.argmax(worth))
        if not worth[best] > 1e-2:
            return None
        pivot = left.pop(best)
        order.append(pivot)
        inverse = 1.0 / pivot[k]
        for row in left:
            factor = row[k] * inverse
            for j in range(k + 1, n + 1):
                row[j] = row[j] - factor * pivot[j]
    found: list[FloatArray] = list(order[0][:n])
    for k in reversed(range(n)):
        total = order[k][n]
        for j in range(k + 1, n):
            total = total - order[k][j] * found[j]
        found[k] = total / order[k][k]
    return found


def _pivoted_each(n: int, entries: tuple[Numbers, ...]) -> FloatArray:
    """Return the unknowns with pivots of their own for each system; NaN where a matrix is singular or not finite."""
    stacked = np.stack(np.broadcast_arrays(*entries), axis=-1).astype(float)
    matrix, right = stacked[..., : n * n].reshape(*stacked.shape[:-1], n, n), stacked[..., n * n :, None]
    with np.errstate(all="ignore"):
        if np.isfinite(stacked).all():
            try:
                return np.moveaxis(np.linalg.solve(matrix, right)[..., 0], -1, 0)
            except np.linalg.LinAlgError:
                pass
        regular = np.isfinite(stacked).all(axis=-1)
        safe = np.where(regular[..., None, None], matrix, np.eye(n))
        regular &= np.abs(np.linalg.det(safe)) > 0.0
        safe = np.where(regular[..., None, None], matrix, np.eye(n))
        found = np.where(regular[..., None], np.linalg.solve(safe, right)[..., 0], np.nan)
    return np.moveaxis(found, -1, 0)


def solve_floats(*entries: float) -> tuple[float, ...]:
    """Return the unknowns of one system by elimination with row pivots; NaN where it is singular."""
    n = unknowns(len(entries))
    rows = [[*entries[k * n : k * n + n], entries[n * n + k]] for k in range(n)]
    for k in range(n):
        pivot = max(range(k, n), key=lambda row: abs(rows[row][k]))
        rows[k], rows[pivot] = rows[pivot], rows[k]
        if not abs(rows[k][k]) > 0.0:
            return (math.nan,) * n
        for row in rows[k + 1 :]:
            factor = row[k] / rows[k][k]
            row[k:] = [a - factor * b for a, b in zip(row[k:], rows[k][k:], strict=True)]
    found = [0.0] * n
    for k in reversed(range(n)):
        found[k] = (rows[k][n] - sum(rows[k][j] * found[j] for j in range(k + 1, n))) / rows[k][k]
    return tuple(found)
