"""The same work in C, compiled on the spot, and what the unit that divides and takes roots needs for it alone."""

from __future__ import annotations

import ctypes
import shutil
import subprocess
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from linkage.program import LANGUAGES, Kernel

FLAGS = ("-O3", "-march=native", "-fno-math-errno", "-fno-trapping-math")
POINTER = ctypes.POINTER(ctypes.c_double)

UNIT = """#include <math.h>
void poses(long n, const double *restrict x, double *restrict o) {
    for (long b = 0; b < n; b++) {
        const double s = x[b];
        o[b] = %s;
    }
}
"""


def has_compiler() -> bool:
    return shutil.which("gcc") is not None


def built(text: str, name: str, folder: Path) -> Any:
    """Return a C function, compiled."""
    source, library = folder / f"{name}.c", folder / f"{name}.so"
    source.write_text(text, encoding="utf-8")
    subprocess.run(["gcc", *FLAGS, "-shared", "-fPIC", "-o", library, source, "-lm"], check=True)
    return ctypes.CDLL(str(library)).poses


def address(array: Any) -> Any:
    return array.ctypes.data_as(POINTER)


def c_case(kernel: Kernel, inputs: Mapping[str, Any], out: Any, folder: Path) -> Callable[[], Any]:
    """Return a call of a kernel's program in C over the poses of one design, its results in `out`, shape (outputs, poses)."""
    plan = kernel.fused.plan
    function = built(LANGUAGES["c"].text(kernel.plan.outputs), "kernel", folder)
    design = np.array([inputs[node.value] for node in plan.design_inputs])
    strokes = [np.ascontiguousarray(inputs[node.value]) for node in plan.pose_inputs]
    given, taken = ((POINTER * len(rows))(*map(address, rows)) for rows in (strokes, out))

    def run() -> Any:
        function(ctypes.c_long(out.shape[1]), address(design), given, taken)
        return out

    return run


def unit_case(kernel: Kernel, poses: int, folder: Path) -> Callable[[], Any]:
    """Return a call that takes as many square roots and divisions a pose as a kernel's program, and little else."""
    ops = [node.op for node in kernel.plan.pose]
    roots, divisions = ops.count("sqrt"), ops.count("divide") + ops.count("reciprocal")
    terms = [f"sqrt(s + {k}.5)" for k in range(roots)] + [f"{k}.25 / (s + {k}.75)" for k in range(1, divisions + 1)]
    function = built(UNIT % " + ".join(terms), "unit", folder)
    x, o = np.linspace(0.1, 1.0, poses), np.empty(poses)

    def run() -> Any:
        function(ctypes.c_long(poses), address(x), address(o))
        return o

    return run
