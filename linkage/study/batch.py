"""What a worker does: one batch of designs, piece by piece, each piece measured by itself."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from time import perf_counter, thread_time
from typing import Any, TypeAlias

import numpy as np

from ..errors import DefinitionError, StudyError
from ..mechanism import Mechanism
from ..program import pinned
from .designs import Array, Rows

Measure: TypeAlias = Callable[[Any], Mapping[str, Any]]
"""`measure(machine)`: a mechanism with some designs in arrays, measured: arrays (designs,) by name."""


@dataclass(frozen=True, eq=False)
class Task:
    """What all batches have in common. `measure` is called for `piece` designs at a time, on a back end that does not change."""

    machine: Mechanism
    measure: Measure
    piece: int
    backend: str


@dataclass(frozen=True, eq=False)
class Batch:
    """The results of the designs from start to before stop; what they took by the clock and of a processor [s]; whether from a folder."""

    start: int
    stop: int
    seconds: float = 0.0
    cpu: float = 0.0
    kept: bool = False
    values: Mapping[str, Array] | None = None

    @property
    def bare(self) -> Batch:
        """The same without results."""
        return replace(self, values=None)


def measured(task: Task, start: int, stop: int, rows: Rows, attempt: int) -> Batch:
    """Return a batch, measured; raises StudyError where `measure` fails, DefinitionError where it returns what it should not.

    `attempt` sets a second try apart from the first for executors that know a call by its arguments.
    """
    clock, processor = perf_counter(), thread_time()
    with pinned(task.backend):
        whole = task.machine.replaced(**rows)
        found = [piece(task, whole, start, first, min(first + task.piece, stop)) for first in range(start, stop, task.piece)]
    for first, each in zip(range(start, stop, task.piece), found, strict=True):
        check_same(task, found[0], each, f"designs {first} to {min(first + task.piece, stop) - 1}")
    values = {name: np.concatenate([each[name] for each in found]) for name in found[0]}
    return Batch(start, stop, perf_counter() - clock, thread_time() - processor, values=values)


def piece(task: Task, whole: Mechanism, start: int, first: int, stop: int) -> dict[str, Array]:
    """Return the results of the designs from first to before stop, out of a batch that begins at start."""
    where = f"designs {first} to {stop - 1}"
    machine = whole._part(first - start, stop - start)
    try:
        found = task.measure(machine)
    except Exception as error:
        text = f"{machine.plan.title}: measure failed at {where}: {type(error).__name__}: {error}"
        raise StudyError(text, designs=(first, stop - 1)) from error
    return checked(task, found, stop - first, where)


def checked(task: Task, found: Any, size: int, where: str) -> dict[str, Array]:
    """Return results as arrays of floats, or of truth values; DefinitionError for anything else."""
    title = task.machine.plan.title
    if not isinstance(found, Mapping) or not found or not all(isinstance(name, str) and name for name in found):
        text = f"measure returned {brief(found)} for {where}"
        raise DefinitionError(f'{title}: {text}; return a dictionary of names and arrays, {{"travel": travel}}.')
    arrays = {}
    for name, value in found.items():
        array = np.asarray(value)
        if array.shape != (size,) or array.dtype.kind not in "fiub":
            what = f"{array.dtype} of the shape {array.shape}" if array.dtype.kind != "O" else brief(value)
            text = f"measure returned {name} = {what} for {where}; a number for each design is expected, shape ({size},)."
            raise DefinitionError(f"{title}: {text}")
        arrays[name] = array if array.dtype.kind == "b" else np.asarray(array, float)
    return arrays


def brief(value: Any) -> str:
    """Return the beginning of a value as it prints, on one line."""
    text = " ".join(repr(value).split())
    return text if len(text) <= 60 else f"{text[:57]}..."


def check_same(task: Task, known: Mapping[str, Array], found: Mapping[str, Array], where: str) -> None:
    """Raise DefinitionError where results have not the names and kinds that others have."""
    here, there = (", ".join(f"{name} ({each[name].dtype})" for name in sorted(each)) for each in (found, known))
    if here != there:
        raise DefinitionError(f"{task.machine.plan.title}: measure returned {here} for {where}, elsewhere {there}; return the same.")
