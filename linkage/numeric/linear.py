"""Small systems of linear equations: one in plain floats, many at once."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..vectors import FloatArray, Mask


def solve_linear(matrix: Sequence[Sequence[float]], right: Sequence[float]) -> tuple[list[float], float] | None:
    """Return the solution of a small system of linear equations in floats, and its determinant; None for a singular one."""
    rows = [[*row, b] for row, b in zip(matrix, right, strict=True)]
    count, determinant = len(rows), 1.0
    for k in range(count):
        pivot = k
        for row in range(k + 1, count):
            if abs(rows[row][k]) > abs(rows[pivot][k]):
                pivot = row
        if not abs(rows[pivot][k]) > 0.0:
            return None
        if pivot != k:
            rows[k], rows[pivot], determinant = rows[pivot], rows[k], -determinant
        top = rows[k]
        determinant *= top[k]
        for below in rows[k + 1 :]:
            factor = below[k] / top[k]
            for column in range(k + 1, count + 1):
                below[column] -= factor * top[column]
    found = [0.0] * count
    for k in range(count - 1, -1, -1):
        found[k] = (rows[k][count] - sum(rows[k][j] * found[j] for j in range(k + 1, count))) / rows[k][k]
    return found, determinant


def solved_systems(matrix: FloatArray, right: FloatArray) -> FloatArray:
    """Return the solutions (n, k) of many small systems of equations; not finite of singular ones."""
    if right.shape[1] == 2:
        (a, b), (c, d) = matrix[:, 0].T, matrix[:, 1].T
        det = a * d - b * c
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.stack([(d * right[:, 0] - b * right[:, 1]) / det, (a * right[:, 1] - c * right[:, 0]) / det], axis=1)
    good: Mask = np.asarray(np.isfinite(matrix).all(axis=(1, 2)) & np.isfinite(right).all(axis=1))
    good[good] = np.abs(np.linalg.det(matrix[good])) > 0.0
    found = np.full(right.shape, np.nan)
    found[good] = np.linalg.solve(matrix[good], right[good][:, :, None])[:, :, 0]
    return found
