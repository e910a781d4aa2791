"""A program made ready to run: floats for a handful of poses, NumPy blocks or a compiled loop for more."""

from __future__ import annotations

import math
import threading
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Protocol

import numpy as np

from ..errors import DefinitionError
from ..vectors import FloatArray
from .elimination import expanded
from .float_backend import Floats
from .node import Level, Node
from .numba_backend import Fused
from .numpy_backend import LARGEST, Arrays, is_array, is_table
from .schedule import Schedule, rewritten, schedule

# Cosine and sine from the tangent of half the angle: NumPy takes that on vectors, eight times as fast as each of the two.
#
# With t = tan(a / 2) and w = 2 / (1 + t^2): cos a = w - 1, sin a = t w. An error e of t comes to e sin^2 a and e sin a cos a:
# nothing is magnified, not at 180 degrees either.

def halved(outputs: Sequence[Node]) -> list[Node]:
    """Return nodes of the same values as some outputs, without cosines and sines of what moves."""

    def by_tangent(node: Node, args: tuple[Node, ...]) -> Node | None:
        if node.op not in ("cos", "sin") or node.level is not Level.POSE:
            return None
        t = node.graph.apply("tan", 0.5 * args[0])
        w = 2.0 / (1.0 + t * t)
        return w - 1.0 if node.op == "cos" else t * w

    return rewritten(outputs, by_tangent)


# A back end held for some time, in one thread: what a result is then depends on its inputs alone.

PINNED: ContextVar[str | None] = ContextVar("linkage_backend", default=None)
"""The back end of all work that names none and is more than a few poses; None: the quickest, by the work done before."""


@contextmanager
def pinned(backend: str) -> Iterator[None]:
    """Run what would choose its back end by itself on this one, in this thread, while the context lasts."""
    token = PINNED.set(backend)
    try:
        yield
    finally:
        PINNED.reset(token)


FEW = 20
BLOCK = LARGEST


@dataclass(frozen=True)
class Result:
    """What a kernel returns: values, shape (outputs, designs, poses), and a number a guard, above zero where it is at all poses."""

    values: FloatArray
    guards: FloatArray


@dataclass(frozen=True)
class Way:
    """How a kernel is run: "floats", "numpy" or "numba", by itself the quickest for the work; and on how many threads."""

    backend: str | None = None
    threads: int = 1

    def __post_init__(self) -> None:
        if self.backend is not None and not (isinstance(self.backend, str) and self.backend in ("floats", "numpy", "numba")):
            raise DefinitionError(f'backend={self.backend!r}: say "numpy", "numba" or "floats", or nothing for the quickest.')
        if not isinstance(self.threads, int) or isinstance(self.threads, bool) or self.threads < 1:
            raise DefinitionError(f"threads={self.threads!r}: a whole number of at least 1 is expected.")


QUICKEST = Way()


class Backend(Protocol):
    """What fills values, shape (outputs, designs, poses), and guards."""

    plan: Schedule

    def turns(self, m: int, n: int) -> bool:
        """Return whether designs, not poses, are best contiguous in the result."""

    def run(self, design: Sequence[Any], poses: Sequence[Any], values: FloatArray, guards: FloatArray) -> None:
        """Fill values and guards."""


class Kernel:
    """Some nodes of a program as a function of designs and poses.

    `kernel(inputs)` takes a float or an array (designs,) for every dimension and a float or an array (poses,)
    or (designs, poses) for every stroke and solved coordinate, and returns values of shape (outputs, designs, poses);
    NaN where a pose cannot be assembled. `out` of that shape takes the values; `size` says how many designs and poses
    are meant where not all inputs are needed.
    A guard is a node that is watched: whether it is above zero at all poses. NaN, out of reach, is not.
    """

    def __init__(self, outputs: Sequence[Node], guards: Sequence[Node] = ()) -> None:
        self._wanted = (tuple(outputs), tuple(guards))
        self.plan = schedule(outputs, guards)
        self._unseen = np.full(len(self.plan.guards), math.inf)
        self._spent = 0

    def __call__(
        self, inputs: Mapping[str, Any], out: FloatArray | None = None, way: Way = QUICKEST, size: tuple[int, int] | None = None
    ) -> Result:
        m, n = size or (sized(*given(self.plan, inputs)) if out is None else out.shape[1:])
        backend = self._backend(way, m, n)
        design, poses = given(backend.plan, inputs)
        values = allocated(len(self.plan.outputs), m, n, backend.turns(m, n)) if out is None else out
        guards = self._unseen.copy()
        if m * n:
            with np.errstate(all="ignore"):
                run(backend, design, poses, values, guards, way.threads)
        return Result(values, guards)

    def _backend(self, way: Way, m: int, n: int) -> Backend:
        """Return what to run: the asked for, the pinned, or the quickest for so many designs and poses."""
        asked = way.backend or ("floats" if m == 1 and n <= FEW else PINNED.get())
        if asked == "floats":
            return self.floats
        if asked is not None:
            return self.arrays if asked == "numpy" else self.fused
        if self.fused.is_worth(m, n, self._spent):
            return self.fused
        self._spent += m * n
        return self.arrays

    @cached_property
    def floats(self) -> Floats:
        """The program in plain floats."""
        return Floats(self.plan)

    @cached_property
    def arrays(self) -> Arrays:
        """The program in NumPy blocks."""
        return Arrays(self._planned(halved))

    @cached_property
    def fused(self) -> Fused:
        """The program in one compiled loop."""
        plan = self._planned(expanded)
        return Fused(plan, Arrays(plan))

    def _planned(self, change: Callable[[Sequence[Node]], list[Node]]) -> Schedule:
        """Return the schedule after a change that leaves the values as they are."""
        outputs, guards = self._wanted
        nodes = change((*outputs, *guards))
        if nodes == [each.origin for each in (*outputs, *guards)]:
            return self.plan
        return schedule(nodes[: len(outputs)], nodes[len(outputs) :])


def given(plan: Schedule, inputs: Mapping[str, Any]) -> tuple[list[Any], list[Any]]:
    """Return the inputs that a schedule reads: of the design, and of the poses."""
    return [inputs[node.value] for node in plan.design_inputs], [inputs[node.value] for node in plan.pose_inputs]


def sized(design: Sequence[Any], poses: Sequence[Any]) -> tuple[int, int]:
    """Return how many designs and poses the inputs are for."""
    m = max((np.shape(value)[0] for value in (*design, *filter(is_table, poses)) if is_array(value)), default=1)
    return m, max((np.shape(value)[-1] for value in poses if is_array(value)), default=1)


def allocated(count: int, m: int, n: int, turned: bool) -> FloatArray:
    """Return an array for results, shape (count, m, n); designs contiguous where it is turned, else poses."""
    return np.empty((count, n, m)).transpose(0, 2, 1) if turned else np.empty((count, m, n))


def run(backend: Backend, design: Sequence[Any], poses: Sequence[Any], values: FloatArray, guards: FloatArray, threads: int) -> None:
    """Run a back end, on several threads if asked for, each with a part of the designs or of the poses."""
    m, n = values.shape[1:]
    count = min(threads, max(m, n))
    if count <= 1:
        backend.run(design, poses, values, guards)
        return
    edges = [max(m, n) * k // count for k in range(count + 1)]
    least = [np.full(len(guards), math.inf) for _ in range(count)]

    def part(k: int) -> None:
        here = slice(edges[k], edges[k + 1])
        with np.errstate(all="ignore"):
            if m >= n:
                rows = [value[here] if is_table(value) and len(value) > 1 else value for value in poses]
                backend.run([value if np.size(value) == 1 else value[here] for value in design], rows, values[:, here], least[k])
            else:
                backend.run(design, [value if np.size(value) == 1 else value[..., here] for value in poses], values[:, :, here], least[k])

    together(part, count)
    guards[:] = np.min(least, axis=0)


def together(part: Callable[[int], None], count: int) -> None:
    """Do some parts of a work, each on a thread of its own; raise the first error."""
    errors: list[Exception] = []

    def kept(k: int) -> None:
        try:
            part(k)
        except Exception as error:
            errors.append(error)

    threads = [threading.Thread(target=kept, args=(k,)) for k in range(count)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    if errors:
        raise errors[0]
