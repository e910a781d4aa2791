"""The engine against C, against pylinkage's compiled path, and against itself: processor time, one thread, one interleaved run.

`python -m tests.benchmarks.bench_speed [--peers FOLDER] [--rounds N]`. With `--peers` pylinkage is installed into an
environment of its own in FOLDER. Each case is timed in turn, round after round; medians are printed, and the ratios that
docs/performance.md states.
"""

from __future__ import annotations

import argparse
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from linkage import LEFT, Crank, Dyad, Ground, Mechanism, OnLink, Stroke, deg, ratio
from linkage.program import Kernel, RunOptions, gradient
from linkage.program.numba_backend import is_there
from mechanisms.three_point_hitch import ThreePointHitch
from tests.benchmarks.bench_kernel import ROOT, first_result, machine
from tests.benchmarks.c_reference import c_case, has_compiler, unit_case
from tests.benchmarks.peer import Peer, environment

LENGTHS = ("OB", "OC", "BC", "ED", "CD", "EF", "MK", "FK", "FG", "L0")
SHORT = 50_000  # poses that a timing takes at least
Run = Callable[[], Any]


class FourBar(Mechanism):
    """A four-bar with a point on its coupler."""

    phi = Stroke(0.0, 360 * deg)
    O, C = Ground(0.0, 0.0), Ground(0.10, 0.0)
    A = Crank(O, OA=0.04, angle=phi)
    B = Dyad(A, C, AB=0.12, CB=0.08, side=LEFT)
    P = OnLink(A, B, AP=0.07, BAP=30 * deg)


class Cases:
    """Runs by name, each with its number of poses, and what they took."""

    def __init__(self) -> None:
        self.runs: dict[str, tuple[Run, int]] = {}
        self.asked: dict[str, tuple[Callable[[int], float], int]] = {}
        self.times: dict[str, float] = {}

    def add(self, name: str, poses: int, run: Run) -> None:
        self.runs[name] = run, poses

    def measure(self, rounds: int) -> None:
        """Keep the median processor time of each case [ns per pose]; the first round warms up."""
        found: dict[str, list[float]] = {name: [] for name in (*self.runs, *self.asked)}
        for turn in range(rounds + 1):
            for name, (run, poses) in self.runs.items():
                repeat = max(1, SHORT // poses) if poses >= 1000 else 1
                start = time.process_time_ns()
                for _ in range(repeat):
                    run()
                found[name] += [(time.process_time_ns() - start) / (poses * repeat)] * (turn > 0)
            for name, (ask, poses) in self.asked.items():
                found[name] += [ask(max(1, SHORT // poses)) / poses] * (turn > 0)
        self.times = {name: statistics.median(each) for name, each in found.items()}

    def over(self, name: str, other: str) -> float:
        """Return one case's time over another's; NaN where one of them was not run."""
        return self.times.get(name, float("nan")) / self.times.get(other, float("nan"))


def prepared(kernel: Kernel, inputs: dict[str, Any], way: RunOptions) -> Run:
    """Return a call that fills the same array each time."""
    out = kernel(inputs, way=way).values
    return lambda: kernel(inputs, out, way)


def public(design: Mechanism, strokes: dict[str, Any], points: str, way: RunOptions) -> Run:
    """Return the public call of the same points, its results included."""
    names = list(points)
    return lambda: design.evaluate(names, backend=way.backend, **strokes)


def ways() -> dict[str, RunOptions]:
    return {"NumPy": RunOptions("numpy")} | ({"Numba": RunOptions("numba")} if is_there() else {})


def add_hitch(cases: Cases, folder: Path, poses: int) -> None:
    """Add the hitch: G alone, with its ratio, in C, and the gradient of the ratio."""
    plan, inputs = ThreePointHitch.plan, dict(ThreePointHitch().dimensions) | {"S": np.linspace(0.0, 0.25, poses)}

    def slope(twin: Any) -> Any:
        return twin.derived(twin.nodes("G")[1:], ("S",))

    makers: dict[str, Callable[[Any], list[Any]]] = {
        "G": lambda twin: [*twin.nodes("G")],
        "G, dG_y/dS": lambda twin: [*twin.nodes("G"), *slope(twin)],
        "dG_y/dS": lambda twin: [*slope(twin)],
        "gradient of dG_y/dS by 10 lengths": lambda twin: gradient(slope(twin)[0], [twin.trace.inputs[name] for name in LENGTHS]),
    }
    kernels = {name: plan.made(("speed", name), lambda twin, make=make: Kernel(make(twin))) for name, make in makers.items()}
    for name, kernel in kernels.items():
        for word, way in ways().items():
            cases.add(f"{word}: {name}", poses, prepared(kernel, inputs, way))
    if has_compiler():
        kernel = kernels["G, dG_y/dS"]
        run = c_case(kernel, inputs, np.empty((3, poses)), folder)
        np.testing.assert_allclose(run(), kernel(inputs).values[:, 0], rtol=1e-11, atol=1e-12)
        cases.add("C: G, dG_y/dS", poses, run)
        cases.add("C: its square roots and divisions alone", poses, unit_case(kernel, poses, folder))


def add_points(cases: Cases, peer: Peer | None, poses: int, designs: int) -> None:
    """Add all points of the hitch and of the four-bar, at the poses of an even crank, and batches of designs."""
    arm = np.linspace(-0.75, 0.1, poses)
    hitch = ThreePointHitch()
    pin = hitch["O"][:, None] + hitch["OB"] * np.array([np.cos(arm), np.sin(arm)])
    stroke = np.hypot(*(pin - hitch["A"][:, None])) - hitch["L0"]
    every = poses // 100
    add_machine(cases, peer, "hitch", hitch, {"S": stroke}, "OB", "BCDFKG")
    random = np.random.default_rng(0)
    varied = {name: hitch[name] * random.uniform(0.995, 1.005, designs) for name in ("OB", "CD", "MK", "FK")}
    flat = dict(hitch.dimensions) | varied | {"S": stroke[::every]}
    kernel = ThreePointHitch.plan.kernel(ThreePointHitch.plan.moving)
    for word, way in ways().items():
        cases.add(f"{word}: {designs} designs of the hitch", designs * 100, prepared(kernel, flat, way))
        run = public(ThreePointHitch(**varied), {"S": stroke[::every]}, "BCDFKG", way)
        cases.add(f"{word}: evaluate, {designs} designs of the hitch", designs * 100, run)
    if peer is not None:
        peer.make("ensemble", "hitch", hitch.at(S=stroke[::every]), "OB", "BCDFKG", poses=100, count=6, designs=designs)
        cases.asked[f"pylinkage: {designs} designs of the hitch"] = (lambda repeat: peer.run("ensemble", repeat)), designs * 100
    for count in (1000, poses):
        add_machine(cases, peer, f"four_bar {count}", FourBar(), {"phi": np.linspace(0.0, 2 * np.pi, count)}, "OA", "ABP")


def add_machine(cases: Cases, peer: Peer | None, title: str, design: Mechanism, strokes: dict[str, Any], crank: str, points: str) -> None:
    """Add all moving points of one design."""
    poses = len(next(iter(strokes.values())))
    kernel = design.plan.kernel(tuple(points))
    for word, way in ways().items():
        cases.add(f"{word}: {title}", poses, prepared(kernel, dict(design.dimensions) | strokes, way))
        cases.add(f"{word}: evaluate, {title}", poses, public(design, strokes, points, way))
    cases.add(f"at(), {title}", poses, lambda: list(map(design.at(**strokes).__getitem__, points)))
    if peer is not None:
        peer.make(title, title.split()[0], design.at(**strokes), crank, points, poses=poses, count=len(points))
        cases.asked[f"pylinkage: {title}"] = (lambda repeat: peer.run(title, repeat)), poses


def add_calls(cases: Cases, poses: int) -> None:
    """Add a single pose through the public calls, and many through the bulk call."""
    hitch, many = ThreePointHitch(), np.linspace(0.0, 0.25, poses)
    asked = ["G", ratio("G")]
    function, out = hitch.function(asked), np.empty((4, many.size))
    cases.add("one pose: function(G, ratio)", SHORT, lambda: [function(0.1) for _ in range(SHORT)])
    cases.add("one pose: evaluate(G, ratio)", SHORT // 100, lambda: [hitch.evaluate(asked, S=0.1) for _ in range(SHORT // 100)])
    cases.add("one pose: at(), ratio()", SHORT // 100, lambda: [hitch.at(S=0.1).ratio("G") for _ in range(SHORT // 100)])
    for word, way in ways().items():
        cases.add(f"{word}: evaluate(G, ratio)", many.size, lambda way=way: hitch.evaluate(asked, S=many, out=out, backend=way.backend))


MEMORY = """
import numpy as np
from pathlib import Path
from linkage import ratio
from mechanisms.three_point_hitch import ThreePointHitch

def status(word):
    return next(int(line.split()[1]) for line in Path("/proc/self/status").read_text().splitlines() if line.startswith(word))

hitch, S, out = ThreePointHitch(), np.empty({n}), np.empty((4, {n}))
for k in range(0, {n}, 100_000):
    S[k : k + 100_000] = np.linspace(0.0, 0.25, 100_000)
    out[:, k : k + 100_000] = 0.0
hitch.evaluate(["G", ratio("G")], S=S[:100_000], backend="{backend}")
Path("/proc/self/clear_refs").write_text("5")
before = status("VmRSS")
hitch.evaluate(["G", ratio("G")], S=S, out=out, backend="{backend}")
print((status("VmHWM") - before) / 1024)
"""


def memory(backend: str, poses: int = 10**7) -> float:
    """Return how much the memory of a fresh process grows over its inputs and results in one bulk call [MiB]; Linux only."""
    program = MEMORY.format(n=poses, backend=backend)
    found = subprocess.run([sys.executable, "-c", program], cwd=ROOT, check=True, capture_output=True, text=True).stdout
    return float(found)


def statements(cases: Cases, designs: int, poses: int) -> list[tuple[str, str, float]]:
    """Return what is claimed: the case, the expectation, and the ratio found."""
    over = cases.over
    found = [
        ("G, dG_y/dS: Numba over C", "<= 1.3", over("Numba: G, dG_y/dS", "C: G, dG_y/dS")),
        ("G, dG_y/dS: NumPy over C", "<= 7", over("NumPy: G, dG_y/dS", "C: G, dG_y/dS")),
        ("C over its roots and divisions alone", "", over("C: G, dG_y/dS", "C: its square roots and divisions alone")),
    ]
    for word, least in (("NumPy", (9, 8, 5, 9)), ("Numba", (40, 40, None, None))):
        titles = ("hitch", f"{designs} designs of the hitch", "four_bar 1000", f"four_bar {poses}")
        for title, bound in zip(titles, least, strict=True):
            times = over(f"pylinkage: {title}", f"{word}: {title}")
            found.append((f"{title}: pylinkage over {word}", f">= {bound}" if bound else "", times))
            found.append((f"{title}: pylinkage over evaluate, {word}", ">= 5", over(f"pylinkage: {title}", f"{word}: evaluate, {title}")))
    for title in ("hitch", "four_bar 1000", f"four_bar {poses}"):
        found.append((f"{title}: pylinkage over at()", "", over(f"pylinkage: {title}", f"at(), {title}")))
    for word in ("NumPy", "Numba"):
        found.append((f"{word}: G, dG_y/dS over G", "<= 1.6" if word == "NumPy" else "", over(f"{word}: G, dG_y/dS", f"{word}: G")))
        found.append((f"{word}: gradient over dG_y/dS", "<= 3.3", over(f"{word}: gradient of dG_y/dS by 10 lengths", f"{word}: dG_y/dS")))
    return found


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--peers", type=Path, metavar="FOLDER", help="install pylinkage there and run it too")
    parser.add_argument("--rounds", type=int, default=9)
    parser.add_argument("--poses", type=int, default=10**6)
    parser.add_argument("--designs", type=int, default=10**4)
    asked = parser.parse_args()
    cases, peer = Cases(), Peer(environment(asked.peers)) if asked.peers else None
    with tempfile.TemporaryDirectory() as folder:
        add_hitch(cases, Path(folder), asked.poses)
        add_points(cases, peer, asked.poses, asked.designs)
        add_calls(cases, asked.poses)
        cases.measure(asked.rounds)
    if peer is not None:
        peer.close()
    print(machine())
    print(*(f"  {name:52s} {each:10.2f} ns" for name, each in cases.times.items()), sep="\n")
    print(*(f"  {what:52s} {found:8.2f}  {bound}" for what, bound, found in statements(cases, asked.designs, asked.poses)), sep="\n")
    for backend in (way.backend or "" for way in ways().values()):
        print(f"  memory over inputs and results, 1e7 poses, {backend}: {memory(backend):.1f} MiB, <= 64")
    stages, _ = first_result(5)
    print("  first result in a fresh process, ms: " + ", ".join(f"{name} {each:.0f}" for name, each in stages.items()))


if __name__ == "__main__":
    main()
