"""A survey: many designs, each measured by itself, by one process or by the workers of any executor.

Batches are sent out, taken in as they come back, and sent again where they are lost.
"""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import Future
from contextlib import contextmanager, suppress
from dataclasses import replace
from inspect import signature
from math import ceil
from pickle import PicklingError
from queue import SimpleQueue
from time import perf_counter
from typing import Any, Protocol, TypeAlias

import numpy as np

from ..errors import DefinitionError, LinkageError, StudyError, can_be_called, cited, known_name, one_word, require, require_whole
from ..frozen import FrozenDict, immutable, read_only
from ..mechanism import Mechanism
from ..shown import Shown
from .checkpoint import Checkpoint, facts_of, how_far
from .designs import Array, Batch, Designs, StudyWork, Task, check_same_results, measure_batch
from .space import check_in_count, check_one_design, check_vary

TRIES = 3
PICKLING_ERRORS = (PicklingError, AttributeError, TypeError, ImportError)
"""What goes wrong where a function or a class cannot be sent to another process."""
CANNOT_SEND = "cannot be sent to a worker: put both at the top of a module that workers can import"


class Executor(Protocol):
    """A pool that runs functions elsewhere and returns futures: any executor of `concurrent.futures`, or one with the same methods."""

    def submit(self, fn: Callable[..., Any], /, *args: Any) -> Any:
        """Return the future of a call."""


class LocalExecutor:
    """An executor that runs everything at once, in this thread."""

    def submit(self, fn: Callable[..., object], /, *args: object) -> Future[object]:
        """Return the future of a call that is done."""
        future: Future[Any] = Future()
        try:
            future.set_result(fn(*args))
        except Exception as error:
            future.set_exception(error)
        return future


class SurveyRun:
    """The progress of a study: the batches done, under way, and left."""

    def __init__(self, task: StudyWork, designs: Designs, executor: Executor, checkpoint: Checkpoint | None, tell: Progress) -> None:
        self.task, self.designs, self.executor, self.checkpoint, self.tell = task, designs, executor, checkpoint, tell
        self.left = OpenRanges(designs.count, task.piece)
        self.sizes = BatchSizes(max(1, MOST // (task.piece * designs.numbers_each)))
        self.values: dict[str, Array] = {}
        self.batches: list[Batch] = []
        self._under_way: dict[Any, tuple[int, int, int, float]] = {}
        """Of a future the range of its designs, which try it is, and when it left [s]."""
        self._back: SimpleQueue[tuple[Any, float]] = SimpleQueue()
        self._tries: dict[int, int] = {}

    def go(self) -> None:
        """Do all batches left, as many at a time as the executor can use; finished ones are kept even after an error."""
        for batch in self.checkpoint.batches() if self.checkpoint else ():
            if self.left.remove(batch.start, batch.stop):
                self._keep(batch)
        self.tell(self.designs_done, self.designs.count)
        try:
            while self.left.ranges or self._under_way:
                while self.left.ranges and len(self._under_way) < self.sizes.ahead:
                    self._send()
                    while not self._back.empty():
                        self._take(*self._back.get())
                if self._under_way:
                    self._take(*self._back.get())
        except KeyboardInterrupt as stopped:
            self._stop()
            stopped.add_note(self.state)
            raise
        finally:
            self._stop()

    @property
    def designs_done(self) -> int:
        """How many designs are done."""
        return sum(batch.stop - batch.start for batch in self.batches)

    @property
    def state(self) -> str:
        """How much of the study is done, and where it is kept."""
        return how_far(self.designs_done, self.designs.count, "designs", self.checkpoint.folder if self.checkpoint else None)

    def _send(self) -> None:
        """Send the next batch."""
        start, stop = self.left.take(self.sizes.next_pieces(self.left.pieces_left))
        attempt, left = self._tries.get(start, 0), perf_counter()
        try:
            dimensions = self.designs.dimensions(start, stop)
            future = self.executor.submit(measure_batch, self.task, start, stop, dimensions, attempt)
        except PICKLING_ERRORS as error:
            raise self._error(f"{self.task.what} {CANNOT_SEND}", error) from error
        except Exception as error:
            raise self._error("The executor takes no more work and has to be made anew", error) from error
        self._under_way[future] = start, stop, attempt, left
        future.add_done_callback(lambda done: self._back.put((done, perf_counter())))

    def _take(self, future: Any, at: float) -> None:
        """Take a batch in; give it out again, a few times, where it was lost on the way."""
        is_full = len(self._under_way) >= self.sizes.ahead
        start, stop, attempt, left = self._under_way.pop(future)
        try:
            batch: Batch = future.result()
        except LinkageError as error:
            self._stop()
            error.add_note(self.state)
            raise
        except PICKLING_ERRORS as error:
            raise self._error(f"{self.task.what} {CANNOT_SEND}", error) from error
        except Exception as error:
            self._tries[start] = attempt + 1
            if attempt + 1 >= TRIES:
                what = f"Designs {start} to {stop - 1} were lost {TRIES} times, by want of memory if not by measure itself"
                raise self._error(what, error, (start, stop - 1)) from error
            self.left.ranges.insert(0, (start, stop))
        else:
            waited = at - left - batch.seconds if is_full else float("inf")
            self.sizes.learn(-(-(stop - start) // self.task.piece), batch.seconds, waited)
            self._keep(batch)
            self.tell(self.designs_done, self.designs.count)

    def _error(self, what: str, error: Exception, designs: tuple[int, int] | None = None) -> StudyError:
        """Return the error for an interruption of the study, after keeping the results so far."""
        self._stop()
        said = f"{type(error).__name__}: {error}".rstrip(": .\n")
        return StudyError(f"{self.task.machine.plan.title}: {self.state} {what} ({said}).", designs=designs)

    def _keep(self, batch: Batch) -> None:
        """Keep the results of a batch, in the folder too unless they come from there."""
        values = batch.values or {}
        if not self.batches:
            self.values = {name: np.empty((self.designs.count, *array.shape[1:]), array.dtype) for name, array in values.items()}
        check_same_results(self.task, self.values, values, f"designs {batch.start} to {batch.stop - 1}")
        for name, array in values.items():
            self.values[name][batch.start : batch.stop] = array
        self.batches.append(replace(batch, values=None))
        if self.checkpoint is not None and not batch.kept:
            self.checkpoint.keep(batch)

    def _stop(self) -> None:
        """Cancel the batches that have not begun yet, and keep those finished meanwhile."""
        for future in [*self._under_way]:
            future.cancel()
        while not self._back.empty():
            future, _ = self._back.get()
            if self._under_way.pop(future, None) is not None:
                with suppress(Exception):
                    self._keep(future.result())


# How the designs of a study are dealt out: which are left, how many in a batch, how many batches at a time.

AIM, LEAST = 0.4, 0.2
"""The time that a batch is to take, and the least of it, where enough designs are left [s]."""
LATE = 0.5
"""A batch that waited for less than this part of its own time found an idle worker."""
MOST = 1 << 20
"""The numbers that the inputs of a batch are at most: 8 MB."""


class OpenRanges:
    """The designs that are still to be given out: ranges from start to before stop, on the borders of pieces."""

    def __init__(self, count: int, piece: int) -> None:
        self.piece = piece
        self.ranges = [(0, count)]

    @property
    def pieces_left(self) -> int:
        """How many pieces are left."""
        return sum(-(-(stop - start) // self.piece) for start, stop in self.ranges)

    def take(self, pieces: int) -> tuple[int, int]:
        """Return the next range of at most so many pieces."""
        start, end = self.ranges[0]
        stop = min(start + pieces * self.piece, end)
        self.ranges[:1] = [(stop, end)] if stop < end else []
        return start, stop

    def remove(self, start: int, stop: int) -> bool:
        """Take a range out; return whether it was there, whole."""
        for place, (first, last) in enumerate(self.ranges):
            if first <= start < stop <= last:
                self.ranges[place : place + 1] = [(a, b) for a, b in ((first, start), (stop, last)) if a < b]
                return True
        return False


class BatchSizes:
    """The executor's measured speed: how long a piece takes it, and how many batches keep all of its workers busy."""

    def __init__(self, most: int) -> None:
        self.most = most
        self.ahead = 1
        self._each: deque[float] = deque(maxlen=8)

    def next_pieces(self, left: int) -> int:
        """Return how many pieces the next batch has when so many are left: one to begin with, then equal parts of the rest.

        Towards the end they are smaller than usual, so that all workers finish together.
        """
        if not self._each:
            return 1
        each = min(self._each)
        wanted = min(ceil(AIM / each), max(ceil(LEAST / each), left // self.ahead), self.most)
        return ceil(left / max(left // wanted, ceil(left / self.most)))

    def learn(self, pieces: int, seconds: float, waited: float) -> None:
        """Learn from a batch: how long it was at work and how long under way besides [s]; a worker was idle that took it at once."""
        self._each.append(max(seconds, 1e-9) / pieces)
        if waited < LATE * seconds or self.ahead < 2:
            self.ahead += 1


# How far a study is, on stderr.

Progress: TypeAlias = Callable[[int, int], object]
"""Called with (done, total) designs, once at the start and after every batch."""


def check_progress(progress: object) -> None:
    """Raise DefinitionError for anything but True, False or a function."""
    is_function = can_be_called(progress)
    expected = "say True for a bar, or give a function of (done, total) designs"
    require(isinstance(progress, bool) or is_function, "progress", progress, expected)
    if callable(progress):
        try:
            signature(progress).bind(0, 1)
        except TypeError:
            what = f"progress={cited(progress)} takes other arguments"
            raise DefinitionError(f"{what}; it is called with two numbers, def progress(done, total).") from None
        except ValueError:  # one whose arguments Python does not know
            return


@contextmanager
def progress_told(progress: bool | Progress, title: str) -> Iterator[Progress]:
    """Yield the function that reports how far a study is: the function given, a bar where it is True, nothing where it is False."""
    if callable(progress):
        yield progress
    elif not progress:
        yield lambda done, total: None
    else:
        from rich.console import Console
        from rich.progress import BarColumn, MofNCompleteColumn, TaskProgressColumn, TextColumn, TimeRemainingColumn
        from rich.progress import Progress as Bar

        columns = (TextColumn("{task.description}"), BarColumn(), TaskProgressColumn(), MofNCompleteColumn(), TimeRemainingColumn())
        with Bar(*columns, console=Console(stderr=True)) as bar:
            task = bar.add_task(title, total=None)
            yield lambda done, total: bar.update(task, completed=done, total=total)


SMALLEST, LARGEST, PARTS = 64, 2048, 64


@immutable
class Survey(Mapping[str, Array], Shown):
    """The measured values of many designs: `found["travel"]`, shape (m,), for each name that `measure` gave.

    Attributes
    ----------
    machine : Mechanism
        The machine that was varied.
    designs : Designs
        The values of each dimension, (m,) [SI].
    results : mapping of str to array (m,)
        The measured values, by name.
    batches : tuple of Batch
        The batches in the order in which they came: start, stop, seconds, cpu, and whether they were read from the folder.
    """

    machine: Mechanism
    designs: Designs
    results: Mapping[str, Array]
    batches: tuple[Batch, ...]

    def __post_init__(self) -> None:
        object.__setattr__(self, "results", FrozenDict({name: read_only(array) for name, array in self.results.items()}))

    def __getitem__(self, name: str) -> Array:
        return self.results[known_name("Result", name, self.results, where=f"the survey of {self.machine.plan.title}")]

    def __contains__(self, name: object) -> bool:
        return isinstance(name, str) and name in self.results

    def __iter__(self) -> Iterator[str]:
        return iter(self.results)

    def __len__(self) -> int:
        return len(self.results)

    def design(self, number: int) -> Mechanism:
        """Return the machine of one design, by its number: `found.design(found["travel"].argmax())`.

        Parameters
        ----------
        number : int
            The number of the design.

        Returns
        -------
        Mechanism
            The machine.
        """
        check_in_count(self.machine.plan.title, "design", number, self.designs.count)
        rows = self.designs.dimensions(int(number), int(number) + 1)
        one = {name: tuple(float(part.flat[0]) for part in value) if isinstance(value, tuple) else value[0] for name, value in rows.items()}
        return self.machine.replaced(**one)

    def __repr__(self) -> str:
        new = [batch for batch in self.batches if not batch.kept]
        kept = sum(batch.stop - batch.start for batch in self.batches if batch.kept)
        said = f"{self.machine.plan.title}: {', '.join(self.results)} of {self.designs.count} designs, "
        said += "1 batch" if len(new) == 1 else f"{len(new)} batches"
        times = dict.fromkeys(f"{end(batch.seconds for batch in new):.2g}" for end in (min, max) if new)
        said += f" of {' to '.join(times)} s" if new else ""
        return said + (f", {kept} designs from the folder" if kept else "")


def survey(
    machine: Mechanism,
    vary: Any = None,
    measure: Any = None,
    *,
    over: None = None,
    executor: Executor | None = None,
    folder: str | os.PathLike[str] | None = None,
    progress: bool | Progress = False,
    backend: str = "numpy",
    piece: int | None = None,
    version: str | int = "",
) -> Survey:
    """Return the values of a function for many designs: `survey(hitch, {"OB": array, "M": (xs, ys)}, measure)["travel"]`, shape (m,).

    The results are the same to the last bit whoever does the work, on processors of one kind with the same libraries and OMP_NUM_THREADS.

    Parameters
    ----------
    machine : Mechanism
        The machine that is varied.
    vary : mapping of str to array (m,)
        Dimensions by name [SI].
    measure : callable
        `measure(machine)` is called with some designs at a time, in arrays. It returns numbers or truth values for each of them, arrays
        (designs,) by name. What it returns for a design must not depend on the others.
    over : None, optional
        Refused: elsewhere it says where strokes run.
    executor : Executor, optional
        Anything with `submit`: a pool of `concurrent.futures`, `distributed.Client(...).get_executor()`; by default this process. Batches
        take some tenths of a second, a few for each worker. A batch whose worker was lost is sent again.
    folder : str or Path, optional
        Where finished batches are written, so that the same call goes on where another one stopped. A folder knows `measure` by its source
        text, by that of the functions of its module which it names, and by the values they read.
    progress : bool or callable, optional
        True shows a bar on stderr; a function is called with (done, total) designs.
    backend : {"numpy", "numba"}, optional
        The one back end of all batches.
    piece : int, optional
        How many designs are measured at a time, by default 64 to 2048, by their number alone.
    version : str or int, optional
        Counted up where something changes that `measure` does not show; a lambda needs it.

    Returns
    -------
    Survey
        The values by name.

    Raises
    ------
    DefinitionError
        Designs or results cannot be, or the folder is that of another study.
    StudyError
        `measure` fails, naming the designs, or the executor breaks.
    """
    check_one_design(machine)
    check_vary(machine, "survey", over)
    designs = Designs.of(machine, vary)
    if piece is None:  # by their number alone, so that results do not depend on who does the work
        piece = min(max(-(-designs.count // PARTS), SMALLEST), LARGEST)
    piece = require_whole(f"{machine.plan.title}: piece", piece, "a whole number of designs is expected, at least 1", least=1)
    task = Task(machine, measure, piece, one_word("backend", backend, ("numpy", "numba")), "measure or the mechanism's class")
    require(callable(measure), f"{machine.plan.title}: measure", measure, "a function of a mechanism is expected")
    check_executor(executor)
    is_version = isinstance(version, (str, int)) and not isinstance(version, bool)
    require(is_version, "version", version, "a text or a whole number is expected, such as version=2")
    check_progress(progress)
    checkpoint = None if folder is None else Checkpoint.of(folder, facts_of(task, designs, version))
    with progress_told(progress, machine.plan.heading) as tell:
        run = SurveyRun(task, designs, executor or LocalExecutor(), checkpoint, tell)
        run.go()
    return Survey(machine, designs, run.values, tuple(run.batches))


def check_executor(executor: object) -> None:
    """Raise DefinitionError for anything but an executor."""
    if executor is not None and (isinstance(executor, type) or not callable(getattr(executor, "submit", None))):
        what = "is a class" if isinstance(executor, type) else "has no submit"
        raise DefinitionError(f"executor={executor!r:.60} {what}; give a pool of concurrent.futures or client.get_executor().")
