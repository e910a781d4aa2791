"""The designs of a study: some dimensions as arrays, with a value for each design."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Mapping
from hashlib import blake2b
from math import prod
from time import perf_counter, thread_time
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

from ..errors import DefinitionError, StudyError, cited, ensure, require_type
from ..frozen import immutable, unmasked
from ..mechanism import Mechanism
from ..program import fixed_backend

Array: TypeAlias = npt.NDArray[Any]
DesignValues: TypeAlias = dict[str, Any]
"""Values of dimensions by name, of one design or of several, as Mechanism.replaced takes them."""
LOOKED_AT = 1 << 17
"""Designs that are checked at a time."""


@immutable
class Designs:
    """Dimensions that vary, by name: one array (m,), of a point two, of which one may be a number; `count` is m.

    The arrays are read part by part, so that they may be files mapped into memory. What else a worker is to know of each design, arrays
    (m, ...), goes along.
    """

    columns: Mapping[str, tuple[Array, ...]]
    count: int

    @classmethod
    def of(cls, machine: Mechanism, vary: Mapping[str, object]) -> Designs:
        """Return the designs that arrays by name make of a machine; DefinitionError for a wrong name or value."""
        title = machine.plan.title
        expected = "a dictionary of names and arrays is expected; Box.sample(count) makes one"
        given = require_type(f"{title}: vary", vary, Mapping, expected)
        columns = {name: arrays_of(machine, name, value) for name, value in given.items()}
        sizes = {name: part.size for name, parts in columns.items() for part in parts if part.ndim}
        if not any(sizes.values()):
            example = next(iter(machine.dimensions), "OB")
            raise DefinitionError(f'{title}: there are no designs; give arrays with a value for each, vary={{"{example}": array}}.')
        if len(set(sizes.values())) > 1 or any(len({part.size for part in parts if part.ndim}) > 1 for parts in columns.values()):
            said = ", ".join(f"{name} {' '.join(str(part.size) for part in parts)}" for name, parts in columns.items())
            raise DefinitionError(f"{title}: all arrays are to have one length; theirs are {said}.")
        check_once(machine, columns)
        found = cls(columns, max(sizes.values()))
        for start, stop in found.ranges(LOOKED_AT):
            for name, part in ((name, part) for name, parts in columns.items() for part in parts):
                values = np.ravel(array_part(part, start, stop))
                bad = np.flatnonzero(~np.isfinite(values))
                if bad.size:
                    where = f"{name} of design {start + bad[0]} is {values[bad[0]]}"
                    raise DefinitionError(f"{title}: {where}; a finite number is expected.")
            try:
                machine.replaced(**found.dimensions(start, stop))
            except DefinitionError as error:
                raise DefinitionError(f"Designs {start} to {stop - 1}: {error}") from None
        return found

    def ranges(self, size: int) -> Iterator[tuple[int, int]]:
        """Yield ranges of at most so many designs, each from start to before stop."""
        for start in range(0, self.count, size):
            yield start, min(start + size, self.count)

    def dimensions(self, start: int, stop: int) -> DesignValues:
        """Return the dimensions of the designs from start to before stop."""
        found = {name: tuple(array_part(part, start, stop) for part in parts) for name, parts in self.columns.items()}
        return {name: parts if len(parts) > 1 else parts[0] for name, parts in found.items()}

    @property
    def numbers_each(self) -> int:
        """How many numbers a design has."""
        return sum(prod(part.shape[1:]) for parts in self.columns.values() for part in parts if part.ndim)

    def digests(self) -> dict[str, str]:
        """Return a word for the values of each dimension."""
        found = {}
        for name, parts in self.columns.items():
            word = blake2b(digest_size=16)
            for part in parts:
                for start, stop in self.ranges(LOOKED_AT):
                    word.update(array_part(part, start, stop).tobytes())
            found[name] = word.hexdigest()
        return found


def arrays_of(machine: Mechanism, name: str, value: Any) -> tuple[Array, ...]:
    """Return the array of a dimension, or the two of a point, of which one may be a number; NaN where they are masked."""
    _ = machine[name]  # raises for a name that is none
    title, is_point = machine.plan.title, name not in machine.plan.table.spellings
    try:
        x, y = value if is_point else (value, 0.0)
    except (TypeError, ValueError):
        raise DefinitionError(f"{title}: {name} is a point and takes a pair of arrays, {name}=(xs, ys) in m.") from None
    parts = []
    for part in (x, y) if is_point else (x,):
        try:
            found = np.asarray(unmasked(part))
        except ValueError:
            found = np.array(None)
        if found.dtype.kind not in "fiu" or not 1 - is_point <= found.ndim <= 1:
            given = f"shape {found.shape}, {found.dtype}" if isinstance(part, np.ndarray) else repr(part)[:60]
            raise DefinitionError(f"{title}: {name} is {given}; an array (m,) of numbers is expected, a value for each design.")
        parts.append(found)
    return tuple(parts)


def check_once(machine: Mechanism, names: Mapping[str, object]) -> None:
    """Raise DefinitionError where two names stand for one dimension."""
    seen, spellings = dict[str, str](), machine.plan.table.spellings
    for name in names:
        for owner in dict.fromkeys(spellings[each][0] for each in (name, f"{name}.x", f"{name}.y") if each in spellings):
            if owner in seen:
                raise DefinitionError(f"{machine.plan.title}: {seen[owner]} and {name} both set {owner}; leave one of them out.")
            seen[owner] = name


def array_part(part: Array, start: int, stop: int) -> npt.NDArray[np.float64]:
    """Return a part of an array; a number as it is."""
    return np.ascontiguousarray(part[start:stop], float) if part.ndim else np.asarray(part, float)


# What a worker does: one batch of designs, piece by piece, each piece measured by itself.

Measure: TypeAlias = Callable[..., Mapping[str, Any]]
"""`measure(machine)`: a mechanism with some designs in arrays, measured: arrays (designs,) by name."""


@immutable
class StudyWork(ABC):
    """The work common to all batches of a study: `measure` is called for `piece` designs of a machine at a time, on one back end.

    `what` are the data to send to a worker, in words.
    """

    machine: Mechanism
    measure: Measure
    piece: int
    backend: str
    what: str

    @abstractmethod
    def done(self, rows: DesignValues, start: int, stop: int) -> list[dict[str, Array]]:
        """Return the results of the designs from start to before stop, of each piece: arrays whose first axis is that of the designs."""


@immutable
class Task(StudyWork):
    """The work of a survey: `measure` gives arrays of a machine's designs."""

    def done(self, rows: DesignValues, start: int, stop: int) -> list[dict[str, Array]]:
        """Return the measures of the designs from start to before stop, of each piece."""
        whole, title, done = self.machine.replaced(**rows), self.machine.plan.title, []
        for first in range(start, stop, self.piece):
            last = min(first + self.piece, stop)
            where, machine = f"designs {first} to {last - 1}", whole._part(first - start, last - start)
            try:
                found = self.measure(machine)
            except Exception as error:
                text = f"{title}: measure failed at {where}: {type(error).__name__}: {error}"
                raise StudyError(text, designs=(first, last - 1)) from error
            done.append(result_arrays(title, found, last - first, where))
        return done


@immutable
class Batch:
    """The results of the designs from start to before stop; their wall-clock and processor time [s]; whether from a folder."""

    start: int
    stop: int
    seconds: float = 0.0
    cpu: float = 0.0
    kept: bool = False
    values: Mapping[str, Array] | None = None


def measure_batch(task: StudyWork, start: int, stop: int, rows: DesignValues, attempt: int) -> Batch:
    """Return a measured batch; StudyError where `measure` fails, DefinitionError where it returns a wrong value.

    `attempt` sets a second try apart from the first for executors that know a call by its arguments.
    """
    clock, processor = perf_counter(), thread_time()
    with fixed_backend(task.backend):
        found = task.done(rows, start, stop)
    for first, each in zip(range(start, stop, task.piece), found, strict=True):
        check_same_results(task, found[0], each, f"designs {first} to {min(first + task.piece, stop) - 1}")
    values = {name: np.concatenate([each[name] for each in found]) for name in found[0]}
    return Batch(start, stop, perf_counter() - clock, thread_time() - processor, values=values)


def result_arrays(title: str, found: object, size: int, where: str) -> dict[str, Array]:
    """Return results as arrays of floats, or of truth values; DefinitionError for anything else."""
    if not isinstance(found, Mapping) or not found or not all(isinstance(name, str) and name for name in found):
        text = f"measure returned {cited(found)} for {where}"
        raise DefinitionError(f'{title}: {text}; return a dictionary of names and arrays, {{"travel": travel}}.')
    arrays = {}
    for name, value in found.items():
        array = np.asarray(value)
        if array.shape != (size,) or array.dtype.kind not in "fiub":
            what = f"{array.dtype} of the shape {array.shape}" if array.dtype.kind != "O" else cited(value)
            text = f"measure returned {name} = {what} for {where}; a number for each design is expected, shape ({size},)."
            raise DefinitionError(f"{title}: {text}")
        arrays[name] = array if array.dtype.kind == "b" else np.asarray(array, float)
    return arrays


def check_same_results(task: StudyWork, known: Mapping[str, Array], found: Mapping[str, Array], where: str) -> None:
    """Raise DefinitionError where results have not the names and kinds that others have."""
    here, there = (", ".join(f"{name} ({each[name].dtype})" for name in sorted(each)) for each in (found, known))
    ensure(here == there, f"{task.machine.plan.title}: measure returned {here} for {where}, elsewhere {there}; return the same.")
