"""A survey of a million designs of the three-point hitch over 21 strokes: by one process, by a pool, by a cluster of dask.

`python -m tests.benchmarks.bench_survey [--designs N] [--workers N]`. Processor time: what the batches took, and what the process
that deals them out took besides. The wall clock is printed too; it depends on what else the machine does.
"""

from __future__ import annotations

import argparse
import statistics
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass
from importlib.util import find_spec
from typing import Any

import numpy as np

from linkage.program import fixed_backend
from linkage.study import Box, Survey, survey
from mechanisms.three_point_hitch import ThreePointHitch
from tests.benchmarks.bench_kernel import machine

S = np.linspace(0.0, 0.25, 21)
OVER = {"OB": (0.29, 0.31), "OC": (0.35, 0.37), "CD": (0.60, 0.64), "MK": (0.86, 0.90), "FK": (0.67, 0.70), "M.y": (1.04, 1.06)}
ROOMY = {f"distributed.nanny.pre-spawn-environ.MALLOC_{name}_THRESHOLD_": 1 << 30 for name in ("TRIM", "MMAP")}
"""Settings of dask by which a worker keeps the memory of its arrays."""


def measure(hitch: Any) -> dict[str, Any]:
    """Return how far G rises and how far out it comes."""
    (G,) = hitch.evaluate(["G"], S=S)
    return {"travel": np.ptp(G[1], axis=-1), "reach": G[0].max(axis=-1)}


@dataclass(frozen=True)
class Took:
    """What a survey took [s]: its batches, the process that deals them out besides, the clock."""

    found: Survey
    batches: float
    besides: float
    clock: float

    def __str__(self) -> str:
        poses = len(self.found["travel"]) * S.size
        cpu = sorted(batch.cpu for batch in self.found.batches)[1:] or [0.0]  # but the first, a single piece
        said = f"{self.batches / poses * 1e9:6.1f} ns a pose, {self.besides / (self.batches + self.besides):6.1%} of all besides"
        said += f", {poses / S.size / self.clock / 1e6:5.2f} million designs a second by the clock"
        return f"{said}; {len(cpu) + 1} batches, {cpu[0]:.2f} to {cpu[-1]:.2f} s, median {statistics.median(cpu):.2f} s"


def timed(over: dict[str, Any], executor: Any, here: bool, **options: Any) -> Took:
    """Return a survey and what it took; `here`: its batches run in this process."""
    clock, processor = time.perf_counter(), time.process_time()
    found = survey(ThreePointHitch(), over, measure, executor=executor, **options)
    processor, batches = time.process_time() - processor, sum(batch.cpu for batch in found.batches)
    return Took(found, batches, processor - batches if here else processor, time.perf_counter() - clock)


def bare(over: dict[str, Any], piece: int = 2048) -> float:
    """Return what the same work takes in a plain loop, one mechanism of 2048 designs after the other [s]."""
    hitch, count, start = ThreePointHitch(), len(over["OB"]), time.process_time()
    with fixed_backend("numpy"):
        for first in range(0, count, piece):
            measure(hitch.replaced(**{name: value[first : first + piece] for name, value in over.items()}))
    return time.process_time() - start


@contextmanager
def dask_workers(count: int, settings: dict[str, Any]) -> Iterator[Any]:
    """Yield an executor of a cluster of dask on this machine."""
    import dask
    from distributed import Client, LocalCluster

    options = {"n_workers": count, "threads_per_worker": 1, "processes": True, "dashboard_address": None}
    with dask.config.set(settings), LocalCluster(**options) as cluster, Client(cluster) as client:
        yield client.get_executor()


def executors(workers: int) -> dict[str, Callable[[], Any]]:
    """Return what does the work, by name."""
    found: dict[str, Callable[[], Any]] = {"one process": nullcontext, f"{workers} processes": lambda: ProcessPoolExecutor(workers)}
    if find_spec("distributed"):
        found[f"dask, {workers} workers"] = lambda: dask_workers(workers, {})
        found[f"dask, {workers} workers that keep their memory"] = lambda: dask_workers(workers, ROOMY)
    return found


def results(designs: int, workers: int, rounds: int) -> dict[str, Took]:
    """Return the quickest of some surveys by each executor, after one to warm up; their results agree to the last bit."""
    over = Box.of(ThreePointHitch(), OVER).sample(designs)
    found: dict[str, Took] = {}
    for name, make in executors(workers).items():
        with make() as executor:
            several = [timed(over, executor, executor is None) for _ in range(rounds + 1)]
        found[name] = min(several[1:], key=lambda each: each.batches)
    first = next(iter(found.values())).found
    for took in found.values():
        for name in first:
            np.testing.assert_array_equal(took.found[name], first[name])
    return found


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--designs", type=int, default=10**6)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--rounds", type=int, default=3)
    asked = parser.parse_args()
    print(machine())
    over = Box.of(ThreePointHitch(), OVER).sample(asked.designs)
    loop = min(bare(over) for _ in range(asked.rounds)) / (asked.designs * S.size)
    print(f"  {'a plain loop over 2048 designs at a time':44s} {loop * 1e9:6.1f} ns a pose")
    for name, took in results(asked.designs, asked.workers, asked.rounds).items():
        print(f"  {name:44s} {took}")


if __name__ == "__main__":
    main()
