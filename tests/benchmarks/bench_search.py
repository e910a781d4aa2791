"""A search's designs against pylinkage with SciPy: the least of a ratio's reciprocal over 100 strokes, what a lifting capacity is.

`python -m tests.benchmarks.bench_search [--peers FOLDER] [--rounds N]`. Ours: generations of designs in one kernel call, as a search
looks at them, with their reach judged. Theirs: what a user of pylinkage writes for SciPy, a function of one design that sets the lengths,
runs the compiled solver over 100 positions of the crank, and takes NumPy's differences for the ratio. Interleaved, medians.
"""

from __future__ import annotations

import argparse
import json
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np

from hydraulics import capacity
from linkage import least, mm
from linkage.program import fixed_backend
from linkage.program.numba_backend import is_there
from linkage.study.problem import Problem
from linkage.study.space import Space, around
from mechanisms.three_point_hitch import ThreePointHitch
from tests.benchmarks.peer import environment

WORKER = Path(__file__).with_name("peer_search.py")
STROKES = 100
DESIGNS = 4096
VARIED = ("OB", "OC", "ED", "CD", "EF", "MK", "FK")


def problem() -> Problem:
    """Return the hitch's least capacity at G over 100 strokes, its lengths within 20 mm."""
    machine = ThreePointHitch()
    space = Space.of(machine, {name: around(20 * mm) for name in VARIED})
    return Problem(machine, [least(capacity("lift", "G"))], [], space, -1.0, counts={1: STROKES})


def asked(machine: ThreePointHitch) -> dict[str, Any]:
    """Return the same machine for pylinkage: its arm as a crank, which has to turn through the angles of its motion."""
    motion = machine.sweep(STROKES)
    angle = motion.angle("O", "B")
    design = {name: float(value) for name, value in motion.designs.items()}
    design["at"] = {point: motion[point][:, 0].tolist() for point in "BCDFKG"}
    rate = float(angle[-1] - angle[0]) / (STROKES - 1)
    return {"design": design, "start": float(angle[0]), "rate": rate, "poses": STROKES, "varied": VARIED}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--peers", type=Path)
    parser.add_argument("--rounds", type=int, default=7)
    given = parser.parse_args()
    one = problem()
    unit = np.random.default_rng(0).random((DESIGNS, len(VARIED)))
    backends = ["numpy", *(["numba"] if is_there() else [])]
    with tempfile.TemporaryDirectory() as folder:
        python = environment(given.peers or Path(folder) / "peers")
        peer = subprocess.Popen([python, WORKER], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        assert peer.stdin is not None
        assert peer.stdout is not None
        peer.stdin.write(json.dumps(asked(ThreePointHitch())) + "\n")
        peer.stdin.flush()
        peer.stdout.readline()
        times: dict[str, list[float]] = {name: [] for name in (*backends, "peer")}
        for turn in range(given.rounds + 1):
            for name in backends:
                with fixed_backend(name):
                    start = time.process_time()
                    one.merits((), unit)
                    times[name] += [(time.process_time() - start) / DESIGNS] * (turn > 0)
            peer.stdin.write("100\n")
            peer.stdin.flush()
            times["peer"] += [json.loads(peer.stdout.readline())] * (turn > 0)
        peer.communicate()
    theirs = statistics.median(times["peer"])
    for name in backends:
        ours = statistics.median(times[name])
        print(f"{name}: {1.0 / ours:,.0f} designs a second, pylinkage with SciPy {1.0 / theirs:,.0f}: {theirs / ours:.0f} times")
    sys.stdout.flush()


if __name__ == "__main__":
    main()
