"""A program made ready to run: plain floats for a handful of poses, NumPy blocks or a compiled loop for more."""

from __future__ import annotations

import math
from array import array
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from contextvars import ContextVar
from functools import cached_property
from typing import NamedTuple, Protocol, TypeAlias

import numpy as np

from .. import plugins
from ..errors import DefinitionError, quoted, require_whole
from ..frozen import FrozenDict, record
from ..plugins import Plugins
from ..vectors import FloatArray, Numbers
from .cache import compiled
from .elimination import expanded
from .node import Node
from .numba_backend import NumbaLoop
from .numpy_backend import NumpyBlocks, columns_part, is_array, is_table, rows_part, with_half_angles
from .operations import FLOATS, NO_VALUE, ON_FLOATS, QUICK
from .schedule import Schedule, schedule, values_by_node
from .text import GUARDED, PYTHON, Dialect, function_text


class PlainFloats:
    """A program as two functions of floats: the design part and the pose part."""

    def __init__(self, plan: Schedule) -> None:
        self.plan = plan
        self._latest: tuple[bytes, tuple[float, ...]] = b"none", ()
        self._latest_of: tuple[Mapping[str, float], tuple[float, ...]] = {}, ()
        self._runs = 0

    @cached_property
    def quick(self) -> Mapping[str, Callable[..., tuple[float, ...]]]:
        """The functions that raise where a division or a root has no value."""
        return compiled(self._text(PYTHON), QUICK)

    @cached_property
    def careful(self) -> Mapping[str, Callable[..., tuple[float, ...]]]:
        """The functions that return NaN and infinity there, as NumPy does."""
        return compiled(self._text(GUARDED), FLOATS)

    def _text(self, dialect: Dialect) -> str:
        plan = self.plan
        text = function_text("design", plan.design_inputs, plan.design, plan.passed, dialect)
        return text + function_text("pose", [*plan.passed, *plan.pose_inputs], plan.pose, (*plan.outputs, *plan.guards), dialect)

    def design_values(self, values: Sequence[float]) -> tuple[float, ...]:
        """Return the values that the pose part needs of a design; the latest design's are kept."""
        key, (known, passed) = array("d", values).tobytes(), self._latest  # bytes tell 0.0 from -0.0
        if key == known:
            return passed
        try:
            passed = self.quick["design"](*values)
        except NO_VALUE:
            passed = self.careful["design"](*values)
        self._latest = key, passed
        return passed

    def pose_values(self, design: FrozenDict[str, float], strokes: Mapping[str, FloatArray]) -> tuple[float, ...]:
        """Return outputs and guards of one design, floats by name, at one pose, arrays of one number by name.

        What the pose part needs of the latest design is kept by the dictionary itself, which does not change.
        """
        row = [strokes[name].item() for name in self.plan.input_names[1]]
        first = None if self._runs > 1 else self.first_poses([design[name] for name in self.plan.input_names[0]], [row])
        if first is not None:
            return first[0]
        known, passed = self._latest_of
        if known is not design:
            passed = self.design_values([design[name] for name in self.plan.input_names[0]])
            self._latest_of = design, passed
        try:
            return self.quick["pose"](*passed, *row)
        except NO_VALUE:
            return self.careful["pose"](*passed, *row)

    def first_poses(self, design: Sequence[float], rows: Sequence[Sequence[float]]) -> list[tuple[float, ...]] | None:
        """Return outputs and guards of a large program's first poses, read from its nodes: its text and code cost far more; else None."""
        plan, self._runs = self.plan, self._runs + 1
        if self._runs > 2 or len(rows) > READ or len(plan.design) + len(plan.pose) < LARGE:
            return None
        found = []
        for row in rows:
            known = dict(zip((*plan.design_inputs, *plan.pose_inputs), (*design, *row), strict=True))
            values = values_by_node((*plan.design, *plan.pose), known, ON_FLOATS)
            found.append(tuple([each.value if each.op == "constant" else values[each] for each in (*plan.outputs, *plan.guards)]))
        return found

    def poses(self, design: Sequence[float], columns: Sequence[Sequence[float]], n: int) -> list[tuple[float, ...]]:
        """Return outputs and guards pose by pose."""
        rows = list(zip(*columns, strict=True)) if columns else [()] * n
        first = self.first_poses(design, rows)
        if first is not None:
            return first
        found = []
        passed, quick = self.design_values(design), self.quick["pose"]
        for row in rows:
            try:
                found.append(quick(*passed, *row))
            except NO_VALUE:
                found.append(self.careful["pose"](*passed, *row))
        return found

    def turns(self, m: int, n: int) -> bool:
        """Return whether designs, not poses, are best contiguous in the result."""
        return False

    def run(self, design: Sequence[Numbers], poses: Sequence[Numbers], values: FloatArray, guards: FloatArray) -> None:
        """Fill values, shape (outputs, designs, poses), and the least value of each guard."""
        count, m, n = values.shape
        if m == n == 1:
            (row,) = self.poses(list(map(one_float, design)), [(one_float(value),) for value in poses], 1)
            values[:, 0, 0] = row[:count]
            guards[:] = row[count:]  # of one pose each is its own least
            return
        designs = [float_list(value, m) for value in design]
        for place in range(m):
            here = [value[place % len(value)] if is_table(value) else value for value in poses]
            rows = self.poses([each[place] for each in designs], [float_list(value, n) for value in here], n)
            values[:, place] = np.array([row[:count] for row in rows], float).T.reshape(count, n)
            for k in range(len(guards)):
                seen = [guards[k], *(row[count + k] for row in rows)]
                guards[k] = math.nan if any(map(math.isnan, seen)) else min(seen)  # no comparison sees NaN


LARGE, READ = 400, 8
"""A program of so many operations is read from its nodes the first two times, for so few poses."""


def one_float(value: Numbers) -> float:
    """Return a number, or an array of one, as a float."""
    return value if type(value) is float else value.item() if isinstance(value, np.ndarray) else float(value)


def float_list(value: Numbers, count: int) -> list[float]:
    """Return a number or an array as so many floats."""
    if type(value) is float:
        return [value] * count
    floats: list[float] = np.asarray(value, float).ravel().tolist()
    return floats * count if len(floats) == 1 else floats


FEW = 20
"""Up to so many poses of one design run in plain floats."""

BACKEND: ContextVar[str | None] = ContextVar("linkage_backend", default=None)
"""The back end of all work that names none and is more than a few poses; None: the quickest, by the work done before."""


@contextmanager
def fixed_backend(backend: str) -> Iterator[None]:
    """Fix the back end in this thread for kernels that would choose one; results then depend on their inputs alone."""
    token = BACKEND.set(backend)
    try:
        yield
    finally:
        BACKEND.reset(token)


class Result(NamedTuple):
    """The result of a kernel: values, shape (outputs, designs, poses), and one number a guard, above zero where it holds at all poses."""

    values: FloatArray
    guards: FloatArray

    @property
    def is_clear(self) -> bool:
        """Whether all guards are above zero at all poses."""
        return all([guard > 0.0 for guard in self.guards.tolist()])


@record
class RunOptions:
    """How a kernel is run: by the back end of a name or a class of one's own, by itself the quickest; and on how many threads."""

    backend: BackendName | None = None
    threads: int = 1

    def __post_init__(self) -> None:
        is_known = self.backend is None or (isinstance(self.backend, str) and (self.backend in OWN or self.backend in ADDED))
        if not is_known and ADDED.for_object(self.backend) is None:
            *others, last = map(quoted, [*OWN, *ADDED])
            raise DefinitionError(f"backend={self.backend!r}: say {', '.join(others)} or {last}, or nothing for the quickest.")
        require_whole("threads", self.threads, "a whole number of at least 1 is expected", least=1)


class Backend(Protocol):
    """A back end: it fills values, shape (outputs, designs, poses), and guards by a schedule of nodes.

    A package adds its own by an entry point of `hydrolinkage.backends`, which leads to a class or a function of the schedule.
    """

    plan: Schedule

    def turns(self, m: int, n: int) -> bool:
        """Return whether designs, not poses, are best contiguous in the result."""

    def run(self, design: Sequence[Numbers], poses: Sequence[Numbers], values: FloatArray, guards: FloatArray) -> None:
        """Fill values and guards from the schedule's inputs in their order, a float or an array each."""


BackendName: TypeAlias = str | Callable[[Schedule], Backend]
"""A back end by its name, or the class or function of a schedule that makes one."""
OWN = ("numpy", "numba", "floats")
ADDED = Plugins[Callable[[Schedule], Backend]](
    plugins.BACKENDS, "The back end", lambda found: found if callable(found) else None, "no function of a schedule", {}
)
"""The back ends that other packages bring."""
QUICKEST = RunOptions()


class Kernel:
    """Some nodes of a program as a function of designs and poses.

    `kernel(inputs)` takes a float or an array (designs,) for every dimension, and a float or an array (poses,) or (designs, poses) for
    every stroke and solved coordinate. It returns values of shape (outputs, designs, poses); NaN where a pose cannot be assembled. `out` of
    that shape takes the values. `size` says how many designs and poses are meant where not all inputs are needed. A guard is a node that is
    watched: whether it is above zero at all poses. NaN, out of reach, is not.
    """

    def __init__(self, outputs: Sequence[Node], guards: Sequence[Node] = ()) -> None:
        self.outputs, self.guards = tuple(outputs), tuple(guards)
        self.plan = schedule(outputs, guards)
        self._unseen = np.full(len(self.plan.guards), math.inf)
        self._spent = 0
        self._added: dict[BackendName, Backend] = {}

    def __call__(
        self, inputs: Mapping[str, Numbers], out: FloatArray | None = None, way: RunOptions = QUICKEST, size: tuple[int, int] | None = None
    ) -> Result:
        m, n = size or (sized(*split_inputs(self.plan, inputs)) if out is None else out.shape[1:])
        backend = self._backend(way, m, n)
        design, poses = split_inputs(backend.plan, inputs)
        values, count = out, len(self.plan.outputs)
        if values is None:  # designs contiguous where it is turned, else poses
            values = np.empty((count, n, m)).transpose(0, 2, 1) if backend.turns(m, n) else np.empty((count, m, n))
        guards = self._unseen.copy()
        if m == n == 1 and isinstance(backend, PlainFloats):
            backend.run(design, poses, values, guards)
        elif m * n:
            with np.errstate(all="ignore"):
                if way.threads > 1:
                    run_threads(backend, design, poses, values, guards, way.threads)
                else:
                    backend.run(design, poses, values, guards)
        return Result(values, guards)

    def _backend(self, way: RunOptions, m: int, n: int) -> Backend:
        """Return the back end to run: the one that is named, the fixed one, or the quickest for so many designs and poses."""
        name = way.backend or ("floats" if m == 1 and n <= FEW else BACKEND.get())
        if name == "floats":
            return self.floats
        if name == "numba" or (name is None and self.fused.is_worth(m, n, self._spent)):
            return self.fused
        if name is None:
            self._spent += m * n
        elif not isinstance(name, str) or name not in OWN:
            if name not in self._added:
                self._added[name] = (ADDED[name] if isinstance(name, str) else name)(self.plan)
            return self._added[name]
        return self.arrays

    @cached_property
    def floats(self) -> PlainFloats:
        """The program in plain floats."""
        return PlainFloats(self.plan)

    @cached_property
    def arrays(self) -> NumpyBlocks:
        """The program in NumPy blocks."""
        return NumpyBlocks(self._planned(with_half_angles, "cos", "sin"))

    @cached_property
    def fused(self) -> NumbaLoop:
        """The program in one compiled loop."""
        plan = self._planned(expanded, "solve")
        return NumbaLoop(plan, NumpyBlocks(plan))

    def _planned(self, change: Callable[[Sequence[Node]], list[Node]], *operations: str) -> Schedule:
        """Return the schedule after a change of some operations that leaves the values as they are."""
        if not any(node.op in operations for node in (*self.plan.design, *self.plan.pose)):
            return self.plan
        before, count = (*self.outputs, *self.guards), len(self.outputs)
        nodes = change(before)
        return self.plan if nodes == [each.origin for each in before] else schedule(nodes[:count], nodes[count:])


def split_inputs(plan: Schedule, inputs: Mapping[str, Numbers]) -> tuple[list[Numbers], list[Numbers]]:
    """Return the inputs that a schedule reads: of the design, and of the poses."""
    design, poses = plan.input_names
    return [inputs[name] for name in design], [inputs[name] for name in poses]


def sized(design: Sequence[Numbers], poses: Sequence[Numbers]) -> tuple[int, int]:
    """Return how many designs and poses the inputs are for."""
    m = max((value.shape[0] for value in (*design, *filter(is_table, poses)) if is_array(value)), default=1)
    return m, max((value.shape[-1] for value in poses if is_array(value)), default=1)


def run_threads(
    backend: Backend, design: Sequence[Numbers], poses: Sequence[Numbers], values: FloatArray, guards: FloatArray, threads: int
) -> None:
    """Run a back end on several threads, each with a part of the designs or of the poses; raise the first error."""
    m, n = values.shape[1:]
    count = min(threads, max(m, n))
    edges = [max(m, n) * k // count for k in range(count + 1)]
    least = [np.full(len(guards), math.inf) for _ in range(count)]

    def work(k: int) -> None:
        here = slice(edges[k], edges[k + 1])
        with np.errstate(all="ignore"):
            if m >= n:
                tables = [rows_part(value, here) for value in poses]
                backend.run([columns_part(value, here) for value in design], tables, values[:, here], least[k])
            else:
                backend.run(design, [columns_part(value, here) for value in poses], values[:, :, here], least[k])

    with ThreadPoolExecutor(count) as pool:
        list(pool.map(work, range(count)))
    guards[:] = np.min(least, axis=0)
