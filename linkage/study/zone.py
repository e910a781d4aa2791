"""A zone: the least and the greatest value of a quantity at every stroke, over a box of settings."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from itertools import product
from typing import Any, TypeAlias, final

import numpy as np
import numpy.typing as npt

from ..errors import DefinitionError, SingularWarning
from ..frozen import refuses_changes
from ..mechanism import Mechanism
from ..motion import Motion, at_values, out_of_reach
from ..motion.measures import words_of
from ..program import FloatArray
from .box import Box, setting_words
from .checks import QuantityLike, check_one_design, check_vary, function_value, poses_of, quantity_values

Mask: TypeAlias = npt.NDArray[np.bool_]
Index: TypeAlias = npt.NDArray[np.intp]
POSES = 51


@final
@refuses_changes
@dataclass(frozen=True, eq=False)
class Zone:
    """The band of a quantity over the strokes: `low` and `high`, shape (...), over all settings that can be assembled.

    `low_at` and `high_at` are the settings that give them. `reached` is the share of the settings looked at that have a value,
    `complete` the mask of the strokes where all of them have; `remarks` say in words what was left out.
    """

    quantity: str
    strokes: Mapping[str, FloatArray]
    low: FloatArray
    high: FloatArray
    low_at: Mapping[str, Any]
    high_at: Mapping[str, Any]
    reached: FloatArray
    looked_at: int
    remarks: tuple[str, ...] = ()

    @property
    def complete(self) -> Mask:
        """The strokes at which every setting looked at has a value."""
        return np.asarray(self.reached == 1.0)


def zone(
    machine: Mechanism, quantity: QuantityLike, vary: Any = None, *, over: None = None, **strokes: Any
) -> Zone:
    """Return the true extremes of a quantity at every stroke, over a box of settings and not only its corners.

    `vary` are ranges and choices as in `Box.of`; `over`, which elsewhere says where strokes run, is refused.

    The quantity is a named output, or a function of a motion that gives a number
    for each pose. Strokes as in `machine.at`, by default 51 poses over a single one. The search is deterministic. Settings
    that cannot be assembled, or where the quantity has no value, are left out, counted and told in `remarks`. Angles are taken
    within 180 deg of those of the machine as it is set.
    """
    check_one_design(machine)
    check_vary(machine, "zone", over)
    box = Box.of(machine, vary)
    given = strokes or {name: np.linspace(each.start, each.end, POSES) for name, each in machine.strokes.items()}
    poses = at_values(given, machine.plan)
    shape = next(iter(poses.values())).shape
    if 0 in shape:
        raise DefinitionError(f"{machine.plan.title}: there are no strokes to look at; give at least one value of {', '.join(poses)}.")
    flat = {name: value.ravel() for name, value in poses.items()}
    base = machine.at(unreachable="nan", **flat)

    def f(task: Index, unit: FloatArray, choice: Index) -> FloatArray:
        return quantity_values(poses_of(machine, box.settings(unit, choice), base, task), quantity)

    tasks = int(np.prod(shape, dtype=int))
    found = extremes(f, tasks, len(box.ranges), len(box.choices))
    ends = [{name: shaped(value, shape) for name, value in box.settings(found.unit[row], found.choice[row]).items()} for row in (0, 1)]
    share = np.mean(np.isfinite(found.seen), axis=1)
    return Zone(
        words_of(quantity), poses, found.value[0].reshape(shape), found.value[1].reshape(shape), ends[0], ends[1],
        share.reshape(shape), found.seen.shape[1], tuple(remarks(machine, quantity, box, flat, found.seen)),
    )  # fmt: skip


def shaped(value: Any, shape: tuple[int, ...]) -> Any:
    """Return a setting at every stroke, shape (...); a point's is a pair."""
    return tuple(part.reshape(shape) for part in value) if isinstance(value, tuple) else value.reshape(shape)


def remarks(machine: Mechanism, quantity: QuantityLike, box: Box, strokes: Mapping[str, FloatArray], seen: FloatArray) -> list[str]:
    """Return what a zone leaves out, and what stands near a dead point, in words."""
    grid = grid_of(len(box.ranges))
    count = len(box.choices)
    settings = box.settings(np.tile(grid, (count, 1)), np.repeat(np.arange(count), len(grid)))
    motion = machine.replaced(**settings).at(unreachable="nan", **strokes)
    lost = ~motion.reached
    said = []
    if lost.any():
        said.append(f"{settings_counted(lost, motion, settings)} cannot be assembled and are left out of the zone. {out_of_reach(motion)}")
    empty = np.isnan(seen.T) & motion.reached
    if empty.any():
        said.append(f"{settings_counted(empty, motion, settings)} have no value of {words_of(quantity)} and are left out of the zone.")
    return said + near_dead_points(motion, quantity)


def settings_counted(mask: Mask, motion: Motion, settings: Mapping[str, Any]) -> str:
    """Return which settings (m) are meant at which strokes (n), mask (m, n), with an example."""
    some, when = mask.any(axis=1), mask.any(axis=0)
    spans = ", ".join(f"{name} = {value[when].min():.4f} to {value[when].max():.4f}" for name, value in motion.strokes.items())
    example = setting_words(motion.plan, settings, int(np.argmax(some)))
    return f"{int(some.sum())} of {some.size} settings looked at ({spans}), such as {example},"


def near_dead_points(motion: Motion, quantity: QuantityLike) -> list[str]:
    """Return the warnings that the quantity gives on the settings looked at."""
    with warnings.catch_warnings(record=True) as heard:
        warnings.simplefilter("always", SingularWarning)
        if callable(quantity):
            function_value(quantity, motion)
    return list(dict.fromkeys(str(each.message) for each in heard if issubclass(each.category, SingularWarning)))


# The least and the greatest value of functions over boxes, all of them at once.
#
# A grid of the box gives the starts: every grid point that no neighbour betters. From each a compass search goes on, with a
# stencil that reaches along edges and diagonals and is halved where it finds nothing better; points outside are put back on
# the box. It needs no derivatives, so that the function may be anything, with gaps (NaN), and where the function is
# smooth its limit is a stationary point of the box. Source: Kolda, Lewis, Torczon, SIAM Review 45 (2003), 385-482.

Function: TypeAlias = Callable[[Index, FloatArray, Index], FloatArray]
"""`f(task, unit, choice)`: the value of task (m,) at unit coordinates (m, k), choice (m,)."""

STARTS = 4  # of each task and sense
CLOSE = 2e-8  # of a side of the box: a smooth value is then found to 1e-15 of its change over the box
WHOLE = 4  # dimensions up to which the stencil has all 3**k points


@final
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
    parts = [best_of_grid(sense * seen, k) for sense in (1.0, -1.0)]
    sense = np.repeat([1.0, -1.0], [len(part[0]) for part in parts])
    task, choice, at = (np.concatenate([part[axis] for part in parts]) for axis in range(3))
    unit, value = compass(f, task, choice, sense, grid[at], sense * seen[task, choice, at], 0.5 / max(points_a_side(k) - 1, 1))
    return best_ends(tasks, k, task, choice, sense, unit, value, seen.reshape(tasks, -1))


def best_of_grid(value: FloatArray, k: int) -> tuple[Index, Index, Index]:
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


def best_ends(
    tasks: int, k: int, task: Index, choice: Index, sense: FloatArray, unit: FloatArray, value: FloatArray, seen: FloatArray
) -> Extremes:
    """Return the best end of every task and sense."""
    values, units, choices = np.full((2, tasks), np.nan), np.full((2, tasks, k), np.nan), np.zeros((2, tasks), int)
    for end in np.argsort(-value, kind="stable"):
        row: Any = (0 if sense[end] > 0.0 else 1, task[end])
        values[row], units[row], choices[row] = sense[end] * value[end], unit[end], choice[end]
    return Extremes(values, units, choices, seen)
