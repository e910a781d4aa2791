"""A peer in an environment of its own: made once, asked over pipes, so that its runs stand between ours."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np

from linkage import Motion

WORKER = Path(__file__).with_name("peer_pylinkage.py")


def environment(folder: Path) -> Path:
    """Return the Python of an environment with pylinkage, made in a folder if it is not there."""
    python = folder / ("Scripts" if sys.platform == "win32" else "bin") / "python"
    if not python.exists():
        subprocess.run([sys.executable, "-m", "venv", folder], check=True)
        subprocess.run([python, "-m", "pip", "install", "--quiet", "pylinkage>=1.3,<2", "numba"], check=True)
    return python


class Peer:
    """pylinkage, waiting for work."""

    def __init__(self, python: Path) -> None:
        self.process = subprocess.Popen([python, WORKER], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.points: dict[str, Any] = {}

    def ask(self, **asked: Any) -> dict[str, Any]:
        assert self.process.stdin is not None
        assert self.process.stdout is not None
        self.process.stdin.write(json.dumps(asked) + "\n")
        self.process.stdin.flush()
        answer: dict[str, Any] = json.loads(self.process.stdout.readline())
        return answer

    def make(self, name: str, machine: str, motion: Motion, crank: str, points: str, **more: Any) -> None:
        """Prepare a case: a motion whose crank, two points, turns at an even pace; the points it is compared in."""
        direction = np.atleast_1d(motion.angle(*crank))
        design = {key: float(value) for key, value in motion.designs.items()}
        design["at"] = {point: motion[point][:, 0].tolist() for point in points}
        self.points[name] = np.array([motion[point] for point in points])
        pace = float(direction[-1] - direction[0]) / (direction.size - 1)
        self.ask(do="make", name=name, machine=machine, design=design, start=float(direction[0]), rate=pace, **more)

    def run(self, name: str, repeat: int) -> float:
        """Return the processor time of one run of some [ns]; the first and the last pose must be the motion's."""
        answer = self.ask(do="run", name=name, repeat=repeat)
        for place, known in (("first", 0), ("last", -1)):
            np.testing.assert_allclose(answer[place], self.points[name][..., known], atol=1e-8)
        return float(answer["ns"])

    def close(self) -> None:
        self.process.communicate()
