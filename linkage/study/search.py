"""The least and the greatest value of functions over boxes, all of them at once.

A grid of the box gives the starts: every grid point that no neighbour betters. From each a compass search goes on, with a
stencil that reaches along edges and diagonals and is halved where it finds nothing better; points outside are put back on
the box. It needs no derivatives, so that the function may be anything, with gaps (NaN), and where the function is
smooth its limit is a stationary point of the box. Source: Kolda, Lewis, Torczon, SIAM Review 45 (2003), 385-482.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import product
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

from ..program import FloatArray

Index = npt.NDArray[np.intp]
Function: TypeAlias = Callable[[Index, FloatArray, Index], FloatArray]
"""`f(task, unit, choice)`: the value of task (m,) at unit coordinates (m, k), choice (m,)."""

STARTS = 4  # of each task and sense
CLOSE = 2e-8  # of a side of the box: a smooth value is then found to 1e-15 of its change over the box
WHOLE = 4  # dimensions up to which the stencil has all 3**k points


@dataclass(frozen=True, eq=False)
class Extremes:
    """Of every task the least and the greatest value, shape (2, t), where: unit (2, t, k) and choice (2, t); NaN where it has none.

    `seen` are the values on the grid, shape (t, grid points).
    """

    value: FloatArray
    unit: FloatArray
    choice: Index
    seen: FloatArray


def points_a_side(k: int) -> int:
    """Return how many points a side of the grid has, for a box of k dimensions."""
    return {0: 1, 1: 33, 2: 13, 3: 7, 4: 5}.get(k, 3)


def grid_of(k: int) -> FloatArray:
    """Return the grid of a box of k dimensions, shape (points, k): corners, edges, faces and inside."""
    side = points_a_side(k)
    axis = np.linspace(0.0, 1.0, side)
    return np.array(list(product(axis, repeat=k))).reshape(side**k, k)


def extremes(f: Function, tasks: int, k: int, choices: int) -> Extremes:
    """Return the extremes of f over a unit box of k dimensions and some choices, for every task."""
    grid = grid_of(k)
    task, choice, at = (part.ravel() for part in np.meshgrid(np.arange(tasks), np.arange(choices), np.arange(len(grid)), indexing="ij"))
    seen = f(task, grid[at], choice).reshape(tasks, choices, len(grid))
    parts = [starts(sense * seen, k) for sense in (1.0, -1.0)]
    sense = np.repeat([1.0, -1.0], [len(part[0]) for part in parts])
    task, choice, at = (np.concatenate([part[axis] for part in parts]) for axis in range(3))
    unit, value = compass(f, task, choice, sense, grid[at], sense * seen[task, choice, at], 0.5 / max(points_a_side(k) - 1, 1))
    return best(tasks, k, task, choice, sense, unit, value, seen.reshape(tasks, -1))


def starts(value: FloatArray, k: int) -> tuple[Index, Index, Index]:
    """Return where to start (task, choice, grid point): of each task the best grid points that no neighbour betters."""
    tasks, choices, _ = value.shape
    side = points_a_side(k)
    filled = np.where(np.isnan(value), np.inf, value)
    cube = filled.reshape(tasks, choices, *(side,) * k)
    padded = np.pad(cube, [(0, 0), (0, 0), *((1, 1),) * k], constant_values=np.inf)
    lowest = np.isfinite(cube)
    for offset in product((0, 1, 2), repeat=k):
        lowest &= cube <= padded[(slice(None), slice(None), *(slice(each, each + side) for each in offset))]
    ranked = np.where(lowest.reshape(tasks, -1), filled.reshape(tasks, -1), np.inf)
    order = np.argsort(ranked, axis=1, kind="stable")[:, :STARTS]
    row, column = np.nonzero(np.isfinite(np.take_along_axis(ranked, order, axis=1)))
    return row, *np.divmod(order[row, column], value.shape[2])


def stencil(k: int) -> FloatArray:
    """Return the directions looked into, shape (n, k)."""
    if k <= WHOLE:
        return np.array([each for each in product((-1.0, 0.0, 1.0), repeat=k) if any(each)]).reshape(-1, k)
    return np.concatenate([np.eye(k), -np.eye(k)])


def compass(
    f: Function, task: Index, choice: Index, sense: FloatArray, unit: FloatArray, value: FloatArray, step: float
) -> tuple[FloatArray, FloatArray]:
    """Return where sense * f is least near each start, shape (b, k), and that value, shape (b,)."""
    k = unit.shape[1]
    if not k:
        return unit, value
    ways, unit, value, size = stencil(k), unit.copy(), value.copy(), np.full(len(unit), step)
    going = np.arange(len(unit))
    while len(going):
        near = np.clip(unit[going, None, :] + size[going, None, None] * ways, 0.0, 1.0)
        many = len(ways)
        found = f(np.repeat(task[going], many), near.reshape(-1, k), np.repeat(choice[going], many)).reshape(-1, many)
        found = np.where(np.isnan(found), np.inf, sense[going, None] * found)
        place = np.argmin(found, axis=1)
        least = found[np.arange(len(going)), place]
        better = least < value[going]
        moved = going[better]
        unit[moved], value[moved] = near[better, place[better]], least[better]
        size[going[~better]] *= 0.5
        going = going[size[going] > CLOSE]
    return unit, value


def best(
    tasks: int, k: int, task: Index, choice: Index, sense: FloatArray, unit: FloatArray, value: FloatArray, seen: FloatArray
) -> Extremes:
    """Return the best end of every task and sense."""
    values, units, choices = np.full((2, tasks), np.nan), np.full((2, tasks, k), np.nan), np.zeros((2, tasks), int)
    for end in np.argsort(-value, kind="stable"):
        row: Any = (0 if sense[end] > 0.0 else 1, task[end])
        values[row], units[row], choices[row] = sense[end] * value[end], unit[end], choice[end]
    return Extremes(values, units, choices, seen)
