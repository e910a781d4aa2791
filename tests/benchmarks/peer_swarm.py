"""pylinkage's particle swarm at its defaults on a path of equal crank steps, run in an environment of its own: one JSON line in, one out.

A line holds the points [mm] and the ends of the four-bar's numbers: O.x, O.y, C.x, C.y, OA, AB, CB, AP [mm], BAP, first crank angle [rad].
The answer holds the best numbers and the processor time [s]. A bar is moved as pylinkage's own `kinematic_minimization` moves it: a cycle
of at least 96 poses by `step`; `compiled` asks for its compiled path over the points alone. The frame is the unit of length.
"""

import json
import math
import sys
import time

import numpy as np


def objective(linkage, points, compiled):
    """Return the sum of squared distances from complex points (n,) as the swarm asks for it; large where a bar does not turn fully."""
    from pylinkage.exceptions import UnbuildableError  # not there where the tests collect this file

    step = 2.0 * math.pi / len(points)

    def error(bar, numbers, places):
        O, C = complex(numbers[0], numbers[1]), complex(numbers[2], numbers[3])
        frame, angle, first = C - O, numbers[8], numbers[9] - step
        a, b, c, p = (each / abs(frame) for each in numbers[4:8])
        A = a * complex(math.cos(first), math.sin(first))
        way = 1.0 - A
        part = (b**2 - c**2 + abs(way) ** 2) / (2.0 * abs(way))
        if abs(part) >= b:
            return 1e6
        B = A + way / abs(way) * complex(part, math.sqrt(b**2 - part**2))
        P = A + (B - A) / b * p * complex(math.cos(angle), math.sin(angle))
        linkage.set_constraints([a, b, c, p, angle])
        linkage.set_coords([(0.0, 0.0), (1.0, 0.0), (A.real, A.imag), (B.real, B.imag), (P.real, P.imag)])
        try:
            poses = linkage.step_fast(len(points)) if compiled else [*linkage.step(iterations=max(96, len(points)))][: len(points)]
        except UnbuildableError:
            return 1e6
        value = float(np.sum(np.abs(O + frame * (np.array([each[-1] for each in poses], float) @ [1.0, 1.0j]) - points) ** 2))
        return value if math.isfinite(value) else 1e6

    return error


def main():
    from peer_pylinkage import four_bar, pylinkage  # beside this file; not there where the tests collect it
    from pylinkage.optimization import particle_swarm_optimization

    for line in sys.stdin:
        asked = json.loads(line)
        points = np.array(asked["points"]) @ [1.0, 1.0j]
        design = {"O.x": 0.0, "O.y": 0.0, "C.x": 1.0, "C.y": 0.0, "OA": 0.3, "AB": 1.0, "CB": 0.9, "AP": 0.5, "BAP": 0.3}
        linkage = four_bar(pylinkage(), {**design, "at": {"B": (0.7, 0.8)}}, 0.0, 2.0 * math.pi / len(points))
        linkage.compile()
        value, ends = objective(linkage, points, asked["compiled"]), (asked["low"], asked["high"])
        value(linkage, [0.0, 0.0, 1.0, 0.0, 0.3, 1.0, 0.9, 0.5, 0.3, 0.0], [])
        begun = time.process_time()
        found = particle_swarm_optimization(
            value, linkage, dimensions=len(asked["low"]), bounds=ends, order_relation=min, verbose=False
        )  # fmt: skip
        best = np.asarray(found.dimensions).ravel().tolist()
        print(json.dumps({"numbers": best, "error": float(found.scores["score"][0]), "seconds": time.process_time() - begun}), flush=True)


if __name__ == "__main__":
    main()
