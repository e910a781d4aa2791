"""A zone: the least and the greatest value of a quantity at every stroke, over a box of settings."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping
from itertools import product
from types import MappingProxyType
from typing import Any, TypeAlias

import numpy as np

from ..errors import SingularWarning, ensure
from ..frozen import immutable
from ..mechanism import Mechanism
from ..motion import Motion, at_values, highest, out_of_reach, places_text, stroke_unit
from ..motion.measures import words_of
from ..numeric.box import highest_in
from ..vectors import FloatArray, Index, Mask
from .measured import QuantityLike, StudyPoses, divisors_of, function_value, quantity_values
from .poles import FAR, TINY, boundless_error
from .space import Box, check_one_design, check_vary, setting_words

POSES = 51
MOST_RANGES = 8
"""Ranges of a zone: its grid has 3 points a side of so many, 6,561."""


@immutable
class Zone:
    """The band of a quantity over the strokes, over all settings that can be assembled.

    `complete` is the mask of the strokes where all settings have a value.

    Attributes
    ----------
    quantity : str
        The quantity.
    strokes : mapping of str to array
        The poses [m or rad].
    low, high : array
        The least and the greatest value [SI], of the shape (...) of the strokes.
    low_at, high_at : mapping of str to object
        The settings that give them.
    reached : array
        The share of the settings looked at that have a value.
    looked_at : int
        How many settings were looked at.
    remarks : tuple of str
        What was left out, in sentences.
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


def zone(machine: Mechanism, quantity: QuantityLike, vary: Any = None, *, over: None = None, **strokes: Any) -> Zone:
    """Return the true extremes of a quantity at every stroke, over a box of settings and not only its corners.

    The search is deterministic. Settings that cannot be assembled, or where the quantity has no value, are left out, counted and reported
    in `remarks`. Angles are taken within 180 deg of those of the machine as it is set.

    Parameters
    ----------
    machine : Mechanism
        The machine, one design.
    quantity : str or callable
        A named output, or a function of a motion that gives a number for each pose.
    vary : mapping of str to object
        Ranges and choices, as in `Box.of`.
    over : None, optional
        Refused: elsewhere it says where strokes run.
    **strokes : float or array
        As in `machine.at`, by default 51 poses over a single stroke.

    Returns
    -------
    Zone
        The band of the quantity.
    """
    check_one_design(machine)
    check_vary(machine, "zone", over)
    box = Box.of(machine, vary)
    what = f"{len(box.ranges)} ranges are too many for a zone"
    ensure(len(box.ranges) <= MOST_RANGES, f"{machine.plan.title}: {what}; hold some, {MOST_RANGES} are the most.")
    given = strokes or {name: np.linspace(each.start, each.end, POSES) for name, each in machine.strokes.items()}
    poses = at_values(given, machine.plan)
    shape = next(iter(poses.values())).shape
    ensure(0 not in shape, f"{machine.plan.title}: there are no strokes to look at; give at least one value of {', '.join(poses)}.")
    flat = {name: value.ravel() for name, value in poses.items()}
    looked_at = StudyPoses(machine.at(unreachable="nan", **flat))

    def f(task: Index, unit: FloatArray, choice: Index) -> FloatArray:
        return quantity_values(looked_at.of_each(machine.replaced(**box.settings(unit, choice)), task), quantity)

    tasks = int(np.prod(shape, dtype=int))
    (low, high), unit, choice, seen = extremes(f, tasks, len(box.ranges), len(box.choices))
    known = np.abs(seen[np.isfinite(seen)])
    if known.size and bool(np.any(np.abs([low, high]) > FAR * max(float(np.median(known)), TINY))):  # as large as next to a pole
        divisors, named = () if callable(quantity) else divisors_of(machine.plan, quantity), f"{machine.plan.title}: {words_of(quantity)}"
        raise boundless_error(named, divisors[0] if len(divisors) == 1 else None, "look at other strokes")
    ends: list[dict[str, Any]] = [{}, {}]
    for row, found in enumerate(ends):
        for name, value in box.settings(unit[row], choice[row]).items():
            found[name] = tuple(part.reshape(shape) for part in value) if isinstance(value, tuple) else value.reshape(shape)
    share = np.mean(np.isfinite(seen), axis=1)
    return Zone(
        words_of(quantity), poses, low.reshape(shape), high.reshape(shape), ends[0], ends[1],
        share.reshape(shape), seen.shape[1], tuple(remarks(machine, quantity, box, flat, seen)),
    )  # fmt: skip


def remarks(machine: Mechanism, quantity: QuantityLike, box: Box, strokes: Mapping[str, FloatArray], seen: FloatArray) -> list[str]:
    """Return the omissions of a zone, and its settings near a dead point, in words."""
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
    with warnings.catch_warnings(record=True) as heard:
        warnings.simplefilter("always", SingularWarning)
        if callable(quantity):
            function_value(quantity, motion)
    return said + list(dict.fromkeys(str(each.message) for each in heard if issubclass(each.category, SingularWarning)))


def settings_counted(mask: Mask, motion: Motion, settings: Mapping[str, object]) -> str:
    """Return which settings (m) are meant at which strokes (n), mask (m, n), with an example."""
    some, when = mask.any(axis=1), mask.any(axis=0)
    units = {name: stroke_unit(motion.plan, name) for name in motion.strokes}
    spans = places_text({name: value[when] for name, value in motion.strokes.items()}, units)
    example = setting_words(motion.plan, settings, int(np.argmax(some)))
    return f"{int(some.sum())} of {some.size} settings looked at ({spans}), such as {example},"


# The least and the greatest value of functions over boxes, all of them at once: as strokes are searched, from a coarser grid.

Function: TypeAlias = Callable[[Index, FloatArray, Index], FloatArray]
"""`f(task, unit, choice)`: the value of task (m,) at unit coordinates (m, k), choice (m,)."""


SIDE: Mapping[int, int] = MappingProxyType({0: 1, 1: 33, 2: 13, 3: 7, 4: 5, 5: 3, 6: 3, 7: 3, 8: 3})
"""How many points a side of the grid has, for a box of so many dimensions."""


def grid_of(k: int) -> FloatArray:
    """Return the grid of a box of k dimensions, shape (points, k): corners, edges, faces and inside."""
    return np.array(list(product(np.linspace(0.0, 1.0, SIDE[k]), repeat=k))).reshape(SIDE[k] ** k, k)


class SettingsBox:
    """A function of settings in the unit box, as a search in boxes asks: less the function and the function, of each task and choice."""

    def __init__(self, f: Function, tasks: int, k: int, choices: int) -> None:
        self.f, self.k, self.side, self.choices, self.count = f, k, SIDE[k], choices, 0
        every, grid = np.arange(tasks * choices), grid_of(k)
        self.seen, self.kept = self.at(every, np.broadcast_to(grid, (len(every), *grid.shape)))

    def values(self, design: Index, places: FloatArray) -> FloatArray:
        """Return the function (u, n) at places (u, n, k) of a task and choice each (u,)."""
        task, choice = np.divmod(np.repeat(design, places.shape[1]), self.choices)
        self.count += task.size
        return self.f(task, places.reshape(task.size, self.k), choice).reshape(places.shape[:2])

    def at(self, design: Index, places: FloatArray) -> tuple[FloatArray, Mask]:
        """Return both (2, u, n), and which settings have a value (u, n)."""
        values = self.values(design, places)
        return np.stack([-values, values]), np.isfinite(values)

    def one_function(self, function: int, design: Index, places: FloatArray) -> FloatArray:
        """Return one of both (u, n), by its number."""
        return np.asarray((-1.0, 1.0)[function] * self.values(design, places))

    def is_kept(self, design: Index, places: FloatArray) -> Mask:
        """Return which settings have a value (u, n)."""
        return np.isfinite(self.values(design, places))

    def look(self, _: Index, t: FloatArray) -> tuple[FloatArray, Mask]:
        """Return both along the one dimension of a box, at the grid (n,) or places (tasks and choices, n)."""
        return (self.seen, self.kept) if t.ndim == 1 else self.at(np.arange(len(t)), t[..., None])

    def highest(self) -> tuple[FloatArray, FloatArray]:
        """Return the highest values (2, tasks and choices), NaN where there is none, and where (2, tasks and choices, k)."""
        if self.k == 1:
            found = highest(self.look, [self.side - 1])
            return found.value, found.t[..., None]
        if self.k:
            value, unit, _ = highest_in(self)
            return value, unit
        return self.seen[..., 0], np.zeros((*self.seen.shape[:2], 0))


def extremes(f: Function, tasks: int, k: int, choices: int) -> tuple[FloatArray, FloatArray, Index, FloatArray]:
    """Return the extremes of f over a unit box of k dimensions and some choices, for every task.

    The least and the greatest value, shape (2, t), where they are, at unit (2, t, k) and choice (2, t), NaN where there is none, and the
    values on the grid, shape (t, grid points).
    """
    box = SettingsBox(f, tasks, k, choices)
    value, unit = (each.reshape(2, tasks, choices, *each.shape[2:]) for each in box.highest())
    choice = np.argmax(np.where(np.isnan(value), -np.inf, value), axis=-1)
    best = np.take_along_axis(unit, choice[..., None, None], axis=2)[:, :, 0]
    found = f(np.tile(np.arange(tasks), 2), best.reshape(2 * tasks, k), choice.ravel()).reshape(2, tasks)
    return found, np.where(np.isnan(found)[..., None], np.nan, best), choice, box.seen[1].reshape(tasks, -1)
