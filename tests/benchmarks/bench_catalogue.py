"""Closed curves: a million four-bars over 64 poses, a catalogue of a million curves, its nearest ones, and how many curves are found again.

Run by `python -m tests.benchmarks.bench_catalogue [--count N] [--curves N]`. Times are of one processor [s].
"""

import argparse
from math import pi
from time import process_time

import numpy as np

from linkage import PathTask, curve_catalogue, synthesise
from linkage.motion import Grid
from linkage.program import fixed_backend
from linkage.synthesis.curve_catalogue import curve_kernel
from mechanisms.classics.four_bar import FourBar
from mechanisms.classics.stephenson_one import StephensonOne
from tests.linkage.synthesis.test_closed_curves import known_bars, pairs

PIECE = 2048


def timed(call, *arguments, **options):
    """Return what a call gives and what it takes [s]."""
    begun = process_time()
    found = call(*arguments, **options)
    return found, process_time() - begun


def million(count=1_000_000, poses=64):
    """Return how many of some random four-bars are assembled at all poses of a turn, by the kernel of the catalogue."""
    bar, random = FourBar(), np.random.default_rng(0)
    phi, whole = np.arange(poses) * 2 * pi / poses, 0
    kernel = curve_kernel(bar.plan, "P")
    with fixed_backend("numpy"), np.errstate(all="ignore"):
        for first in range(0, count, PIECE):
            lengths = random.uniform(0.01, 0.2, (4, min(PIECE, count - first)))
            grid = Grid(bar.plan, dict(bar.dimensions) | dict(zip(("OA", "AB", "CB", "AP"), lengths, strict=True)), {"phi": phi})
            whole += int(np.isfinite(kernel(grid.flat, size=grid.size).values[:3]).all(axis=(0, 2)).sum())
    return whole


def found_again(catalogue, curves, seed=9):
    """Return the errors at which closed paths of random four-bars are met from a catalogue, parts of their size (curves,)."""
    vary = {"OA": (0.01, 0.08), "AB": (0.05, 0.2), "CB": (0.05, 0.2), "AP": (0.01, 0.15), "BAP": (-1.5, 1.5)}
    vary |= {f"{point}.{axis}": (-0.2, 0.2) for point in "OC" for axis in "xy"}
    errors = []
    for _, points in known_bars(curves, seed):
        found = synthesise(FourBar(), path=PathTask(points, of="P", closed=True), vary=vary, starts=catalogue)
        errors.append(np.sqrt(found.error / len(points)) / np.ptp(points, axis=0).max())
    return np.array(errors)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=1_000_000, help="curves of a catalogue")
    parser.add_argument("--curves", type=int, default=200, help="curves that are looked for")
    options = parser.parse_args()
    whole, seconds = timed(million)
    print(f"1,000,000 four-bars x 64 poses: {seconds:.2f} s; {whole} turn")
    for machine, of in ((StephensonOne(), "F"), (FourBar(), "P")):
        catalogue, seconds = timed(curve_catalogue, machine, of, count=options.count)
        points = pairs(catalogue.design(77).at(phi=np.arange(360) * 2 * pi / 360)[of].T @ [1.0, 1.0j])
        (first, *_), near = timed(catalogue.nearest, points)
        print(f"{catalogue}: made in {seconds:.1f} s, the nearest in {near:.2f} s, {first}")
    errors, seconds = timed(found_again, catalogue, options.curves)
    print(f"{int((errors <= 1e-9).sum())} of {len(errors)} closed curves found again to 1e-9, {seconds / len(errors):.2f} s each")


if __name__ == "__main__":
    main()
