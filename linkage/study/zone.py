"""A zone: the least and the greatest value of a quantity at every stroke, over a box of settings."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ..errors import DefinitionError, SingularWarning
from ..frozen import refuses_changes
from ..mechanism import Mechanism
from ..motion import Motion, at_values
from ..program import FloatArray
from .asked import Asked, called, one_design, poses_of, title_of, values
from .box import Box, setting_words
from .search import Index, extremes, grid_of

Mask = npt.NDArray[np.bool_]
POSES = 51


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


def zone(machine: Mechanism, quantity: Asked, over: Mapping[str, Any], **strokes: Any) -> Zone:
    """Return the true extremes of a quantity at every stroke, over a box of settings and not only its corners.

    `over` are ranges and choices as in `Box.of`. The quantity is a named output, or a function of a motion that gives a number
    for each pose. Strokes as in `machine.at`, by default 51 poses over a single one. The search is deterministic. Settings
    that cannot be assembled, or where the quantity has no value, are left out, counted and told in `remarks`. Angles are taken
    within 180 deg of those of the machine as it is set.
    """
    one_design(machine)
    box = Box.of(machine, over)
    given = strokes or {name: np.linspace(each.start, each.end, POSES) for name, each in machine.strokes.items()}
    poses = at_values(given, machine.plan)
    shape = next(iter(poses.values())).shape
    if 0 in shape:
        raise DefinitionError(f"{machine.plan.title}: there are no strokes to look at; give at least one value of {', '.join(poses)}.")
    flat = {name: value.ravel() for name, value in poses.items()}
    base = machine.at(unreachable="nan", **flat)

    def f(task: Index, unit: FloatArray, choice: Index) -> FloatArray:
        return values(poses_of(machine, box.settings(unit, choice), base, task), quantity)

    tasks = int(np.prod(shape, dtype=int))
    found = extremes(f, tasks, len(box.ranges), len(box.choices))
    ends = [{name: shaped(value, shape) for name, value in box.settings(found.unit[row], found.choice[row]).items()} for row in (0, 1)]
    share = np.mean(np.isfinite(found.seen), axis=1)
    return Zone(
        title_of(quantity), poses, found.value[0].reshape(shape), found.value[1].reshape(shape), ends[0], ends[1],
        share.reshape(shape), found.seen.shape[1], tuple(remarks(machine, quantity, box, flat, found.seen)),
    )  # fmt: skip


def shaped(value: Any, shape: tuple[int, ...]) -> Any:
    """Return a setting at every stroke, shape (...); a point's is a pair."""
    return tuple(part.reshape(shape) for part in value) if isinstance(value, tuple) else value.reshape(shape)


def remarks(machine: Mechanism, quantity: Asked, box: Box, strokes: Mapping[str, FloatArray], seen: FloatArray) -> list[str]:
    """Return what a zone leaves out, and what stands near a dead point, in words."""
    grid = grid_of(len(box.ranges))
    count = len(box.choices)
    settings = box.settings(np.tile(grid, (count, 1)), np.repeat(np.arange(count), len(grid)))
    motion = machine.replaced(**settings).at(unreachable="nan", **strokes)
    lost = ~motion.reached
    said = []
    if lost.any():
        said.append(f"{left_out(lost, motion, settings)} cannot be assembled and are left out of the zone. {motion.refusal()}")
    empty = np.isnan(seen.T) & motion.reached
    if empty.any():
        said.append(f"{left_out(empty, motion, settings)} have no value of {title_of(quantity)} and are left out of the zone.")
    return said + near_dead_points(motion, quantity)


def left_out(mask: Mask, motion: Motion, settings: Mapping[str, Any]) -> str:
    """Return which settings (m) are meant at which strokes (n), mask (m, n), with an example."""
    some, when = mask.any(axis=1), mask.any(axis=0)
    spans = ", ".join(f"{name} = {value[when].min():.4f} to {value[when].max():.4f}" for name, value in motion.strokes.items())
    example = setting_words(motion.plan, settings, int(np.argmax(some)))
    return f"{int(some.sum())} of {some.size} settings looked at ({spans}), such as {example},"


def near_dead_points(motion: Motion, quantity: Asked) -> list[str]:
    """Return the warnings that the quantity gives on the settings looked at."""
    with warnings.catch_warnings(record=True) as heard:
        warnings.simplefilter("always", SingularWarning)
        if callable(quantity):
            called(quantity, motion)
    return list(dict.fromkeys(str(each.message) for each in heard if issubclass(each.category, SingularWarning)))
