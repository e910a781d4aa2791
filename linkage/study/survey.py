"""A survey: many designs, each measured by itself, by one process or by the workers of any executor."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, final

from ..errors import DefinitionError, cited, known_name, one_word
from ..frozen import FrozenDict, read_only, refuses_changes
from ..mechanism import Mechanism
from ..quantities import is_whole
from ..shown import Shown
from .batching import Executor, LocalExecutor, Progress, SurveyRun, check_progress, progress_told
from .checkpoint import Checkpoint
from .checks import check_one_design, check_vary
from .designs import Array, Batch, Designs, Measure, Task

SMALLEST, LARGEST, PARTS = 64, 2048, 64


@final
@refuses_changes
@dataclass(frozen=True, eq=False)
class Survey(Mapping[str, Array], Shown):
    """What was measured: `found["travel"]`, shape (m,), for each name that `measure` gave.

    `batches` are the batches in the order in which they came: start, stop, seconds, cpu, and kept for those from the folder.
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
        """Return the machine of one design, by its number: `found.design(found["travel"].argmax())`."""
        if not is_whole(number) or not 0 <= number < self.designs.count:
            last = self.designs.count - 1
            raise DefinitionError(f"{self.machine.plan.title}: there is no design {number!r}; numbers go from 0 to {last}.")
        rows = self.designs.rows(int(number), int(number) + 1)
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
    """Return what `measure` gives for many designs: `survey(hitch, {"OB": array, "M": (xs, ys)}, measure)["travel"]`, shape (m,).

    `vary` are dimensions by name [SI], each an array (m,); `over`, which elsewhere says where strokes run, is refused.

    `measure(machine)` is called with some designs at a time, in arrays, and
    returns numbers or truth values for each of them, arrays (designs,) by name; what it returns for a design must not depend on
    the others.

    `executor` is anything with `submit`: a pool of `concurrent.futures`, `distributed.Client(...).get_executor()`; without one
    this process does the work. Batches go out that take some tenths of a second, a few for each worker. A batch whose worker was lost
    is sent again. With `folder` finished batches are kept there, and the same call goes on where another one stopped.
    A folder knows `measure` by its source text, that of the functions of its module which it names, and the values they read;
    `version` is yours to count up when something changes that lies deeper, and is needed for a lambda.
    `progress=True` shows a bar on stderr; a function is called with (done, total) designs.

    The results are the same to the last bit whoever does the work, on processors of one kind with the same libraries and
    OMP_NUM_THREADS: designs are measured `piece` at a time (by default 64 to 2048, by their number alone), and all on one
    back end, "numpy" or "numba".

    Raises DefinitionError for designs or results that cannot be, or a folder of another study; StudyError where measure fails, naming
    the designs, and where the executor breaks.
    """
    check_one_design(machine)
    check_vary(machine, "survey", over)
    designs = Designs.of(machine, vary)
    task = Task(machine, measure, piece_size(machine, designs.count, piece), one_word("backend", backend, ("numpy", "numba")))
    check_options(machine, measure, executor, version, progress)
    checkpoint = None if folder is None else Checkpoint.of(folder, task, designs, version)
    with progress_told(progress, machine.plan.heading) as tell:
        run = SurveyRun(task, designs, executor or LocalExecutor(), checkpoint, tell)
        run.go()
    return Survey(machine, designs, run.values, tuple(run.batches))


def check_options(machine: Mechanism, measure: Measure, executor: Executor | None, version: str | int, progress: bool | Progress) -> None:
    """Raise DefinitionError for what is no function to measure with, no executor, no version or no progress."""
    if not callable(measure):
        raise DefinitionError(f"{machine.plan.title}: measure={measure!r:.60}: a function of a mechanism is expected.")
    if executor is not None and (isinstance(executor, type) or not callable(getattr(executor, "submit", None))):
        what = "is a class" if isinstance(executor, type) else "has no submit"
        raise DefinitionError(f"executor={executor!r:.60} {what}; give a pool of concurrent.futures or client.get_executor().")
    if isinstance(version, bool) or not isinstance(version, (str, int)):
        raise DefinitionError(f"version={cited(version)}: a text or a whole number is expected, such as version=2.")
    check_progress(progress)


def piece_size(machine: Mechanism, count: int, given: int | None) -> int:
    """Return how many designs are measured at a time: by their number alone, so that results do not depend on who does the work."""
    if given is None:
        return min(max(-(-count // PARTS), SMALLEST), LARGEST)
    if not is_whole(given) or given < 1:
        raise DefinitionError(f"{machine.plan.title}: piece={given!r}: a whole number of designs is expected, at least 1.")
    return int(given)
