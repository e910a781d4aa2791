"""The speed of the three-point hitch: values of G and exact dG_y/dS, in nanoseconds of processor time per pose.

`python -m tests.benchmarks.bench_kernel [ROUNDS]`. All cases of a workload run in turn, round after round, so that
the ratios come from one interleaved run; the median of the rounds is printed. A further case is one more row of CASES.
"""

from __future__ import annotations

import json
import os
import platform
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from linkage.program import Kernel, interpret
from mechanisms.three_point_hitch import ThreePointHitch

ROOT = Path(__file__).parents[2]
PLAN = ThreePointHitch.plan
DESIGN = dict(ThreePointHitch().dimensions)
ROUNDS = 9
STEP = 1e-5  # of the central difference, m


@dataclass(frozen=True)
class Work:
    """Some designs, shape (designs, 1) or a float, and the strokes, shape (poses,)."""

    title: str
    design: dict[str, Any]
    stroke: Any

    @property
    def poses(self) -> int:
        return max(np.size(value) for value in self.design.values()) * np.size(self.stroke)

    @property
    def flat(self) -> dict[str, Any]:
        return {name: np.ravel(value) if np.ndim(value) else value for name, value in self.design.items()} | {"S": self.stroke}


def one_design(poses: int) -> Work:
    return Work(f"1 design x {poses:.0e} poses", DESIGN, np.linspace(0.0, 0.25, poses))


def many_designs(designs: int, poses: int) -> Work:
    """Return designs that differ in four lengths, all of which assemble over the whole stroke."""
    random = np.random.default_rng(0)
    varied = {name: DESIGN[name] * random.uniform(0.995, 1.005, (designs, 1)) for name in ("OB", "CD", "MK", "FK")}
    return Work(f"{designs:.0e} designs x {poses} poses", DESIGN | varied, np.linspace(0.0, 0.25, poses))


# -- the cases: each returns G_x, G_y and dG_y/dS -------------------------------------------------------------


def nodes() -> tuple[Any, ...]:
    places = PLAN.nodes("G")
    return (*places, *PLAN.derived(places[1:], ("S",)))


def kernel_case(work: Work) -> Callable[[], Any]:
    kernel, inputs = Kernel(nodes()), work.flat
    return lambda: kernel(inputs).values


def motion_case(work: Work) -> Callable[[], Any]:
    design = ThreePointHitch(**{name: np.ravel(value) if np.ndim(value) else value for name, value in work.design.items()})

    def run() -> Any:
        motion = design.at(S=work.stroke)
        return [*motion["G"], motion.ratio("G")[1]]

    return run


def eager_case(work: Work) -> Callable[[], Any]:
    wanted, inputs = nodes(), work.design | {"S": work.stroke}
    return lambda: interpret(wanted, inputs)


def reading_case(work: Work) -> Callable[[], Any]:
    inputs = work.design | {"S": work.stroke}

    def run() -> Any:
        place = PLAN.read(inputs).at("G")
        return [place.x, place.y]

    return run


def cosine_angle(first: Any, second: Any, third: Any) -> Any:
    return np.arccos((first**2 + second**2 - third**2) / (2 * first * second))


def turned(vector: Any, angle: Any) -> Any:
    x, y = vector
    return x * np.cos(angle) - y * np.sin(angle), x * np.sin(angle) + y * np.cos(angle)


def scaled(vector: Any, angle: Any, length: Any) -> Any:
    x, y = turned(vector, angle)
    factor = length / np.hypot(*vector)
    return x * factor, y * factor


def plus(a: Any, b: Any) -> Any:
    return a[0] + b[0], a[1] + b[1]


def minus(a: Any, b: Any) -> Any:
    return a[0] - b[0], a[1] - b[1]


def textbook(d: dict[str, Any], S: Any) -> Any:
    """Return G as the paper writes it, equations (4) to (26), one array operation after the other."""
    A, O, E, M = ((d[f"{name}.x"], d[f"{name}.y"]) for name in "AOEM")
    AO, L = minus(O, A), d["L0"] + S
    B = plus(A, scaled(AO, -cosine_angle(np.hypot(*AO), L, d["OB"]), L))
    C = plus(O, scaled(minus(B, O), cosine_angle(d["OB"], d["OC"], d["BC"]), d["OC"]))
    EC = minus(C, E)
    ED = scaled(EC, -cosine_angle(np.hypot(*EC), d["ED"], d["CD"]), d["ED"])
    F = plus(E, scaled(ED, 0.0, d["EF"]))
    MF = minus(F, M)
    K = plus(M, scaled(MF, cosine_angle(np.hypot(*MF), d["MK"], d["FK"]), d["MK"]))
    return plus(F, scaled(minus(K, F), -d["KFG"], d["FG"]))


def textbook_case(work: Work) -> Callable[[], Any]:
    d, S = work.design, work.stroke

    def run() -> Any:
        return [*textbook(d, S), (textbook(d, S + STEP)[1] - textbook(d, S - STEP)[1]) / (2 * STEP)]

    return run


def complex_textbook(d: dict[str, Any], S: Any) -> Any:
    """Return G = x + iy: the same equations on complex numbers."""
    A, O, E, M = (d[f"{name}.x"] + 1j * d[f"{name}.y"] for name in "AOEM")

    def turn(vector: Any, angle: Any, length: Any) -> Any:
        return vector * np.exp(1j * angle) * (length / abs(vector))

    L = d["L0"] + S
    B = A + turn(O - A, -cosine_angle(abs(O - A), L, d["OB"]), L)
    C = O + turn(B - O, cosine_angle(d["OB"], d["OC"], d["BC"]), d["OC"])
    F = E + turn(turn(C - E, -cosine_angle(abs(C - E), d["ED"], d["CD"]), d["ED"]), 0.0, d["EF"])
    K = M + turn(F - M, cosine_angle(abs(F - M), d["MK"], d["FK"]), d["MK"])
    return F + turn(K - F, -d["KFG"], d["FG"])


def complex_case(work: Work) -> Callable[[], Any]:
    d, S = work.design, work.stroke

    def run() -> Any:
        G = complex_textbook(d, S)
        return [G.real, G.imag, (complex_textbook(d, S + STEP) - complex_textbook(d, S - STEP)).imag / (2 * STEP)]

    return run


CASES: dict[str, Callable[[Work], Callable[[], Any]]] = {
    "kernel: G, exact dG_y/dS": kernel_case,
    "at(), ratio(): all points, exact": motion_case,
    "eager, node by node: G, exact dG_y/dS": eager_case,
    "eager, steps on arrays: all points, values only": reading_case,
    "textbook NumPy, arccos sin cos: G, central dG_y/dS": textbook_case,
    "textbook NumPy, complex numbers: G, central dG_y/dS": complex_case,
}
BASE = "textbook NumPy, arccos sin cos: G, central dG_y/dS"


def measure(work: Work, rounds: int) -> dict[str, float]:
    """Return the median processor time of each case [ns per pose], from one interleaved run."""
    runs = {name: case(work) for name, case in CASES.items()}
    times: dict[str, list[float]] = {name: [] for name in runs}
    for run in runs.values():
        run()
    for _ in range(rounds):
        for name, run in runs.items():
            start = time.process_time_ns()
            run()
            times[name].append((time.process_time_ns() - start) / work.poses)
    return {name: statistics.median(each) for name, each in times.items()}


def table(work: Work, times: dict[str, float]) -> str:
    """Return the results of a workload as text: time per pose, and how many times faster than the textbook form."""
    rows = [f"{work.title}: ns per pose, speed against the textbook form"]
    rows += [f"  {name:52s} {each:8.1f}  {times[BASE] / each:6.1f} x" for name, each in times.items()]
    return "\n".join(rows)


# -- the first result, in a fresh process ---------------------------------------------------------------------

FIRST = """
import json, sys, time
t0 = time.process_time(); import numpy
t1 = time.process_time(); import linkage
t2 = time.process_time(); heavy = {"matplotlib", "sympy", "scipy", "networkx", "pydantic", "rich"}
loaded = sorted({name.partition(".")[0] for name in sys.modules} & heavy)
from mechanisms.three_point_hitch import ThreePointHitch
t3 = time.process_time(); motion = ThreePointHitch().sweep(101); motion["G"]
t4 = time.process_time(); motion.ratio("G")
t5 = time.process_time()
print(json.dumps([[1e3 * (b - a) for a, b in ((t0, t1), (t1, t2), (t2, t3), (t3, t4), (t4, t5))], loaded]))
"""
STAGES = ("import numpy", "import linkage", "import the machine", "first positions, 101 poses", "first exact ratios")


def first_result(runs: int) -> tuple[dict[str, float], list[str]]:
    """Return the processor time of each stage in a fresh process [ms], medians, and the heavy modules `import linkage` loads.

    The bytecode of all modules is on disk, as after any first run of an installed package.
    """
    with tempfile.TemporaryDirectory() as folder:
        variables = os.environ | {"PYTHONPYCACHEPREFIX": folder}
        variables.pop("PYTHONDONTWRITEBYTECODE", None)
        texts = [
            subprocess.run([sys.executable, "-c", FIRST], cwd=ROOT, check=True, capture_output=True, text=True, env=variables).stdout
            for _ in range(runs + 1)
        ]
    found = [json.loads(text) for text in texts[1:]]
    return dict(zip(STAGES, map(statistics.median, zip(*(times for times, _ in found), strict=True)), strict=True)), found[-1][1]


def machine() -> str:
    """Return what this runs on: processor, Python, NumPy."""
    info = Path("/proc/cpuinfo")
    models = (
        [line.partition(":")[2].strip() for line in info.read_text().splitlines() if line.startswith("model name")] if info.exists() else []
    )
    return (
        f"{models[0] if models else platform.processor() or platform.machine()}, Python {platform.python_version()}, NumPy {np.__version__}"
    )


def main(rounds: int = ROUNDS) -> None:
    print(machine())
    for work in (one_design(10**6), many_designs(10**4, 100)):
        print(table(work, measure(work, rounds)))
    stages, heavy = first_result(5)
    print("fresh process, ms: " + ", ".join(f"{name} {each:.0f}" for name, each in stages.items()))
    print(f"heavy modules loaded by import linkage: {', '.join(heavy) or 'none'}")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:2]))
