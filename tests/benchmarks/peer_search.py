"""A design's least capacity as a user of pylinkage writes it for SciPy, run in an environment of its own."""

import json
import sys
import time

import numpy as np


def objective(linkage, first, start, poses, order):
    """Return the function of a design's lengths that SciPy is given: the least lifting force for a unit of the crank's moment."""

    def value(lengths):
        values = list(first)
        for place, length in zip(order, lengths, strict=True):
            values[place] = length
        linkage.set_constraints(values)
        linkage.set_coords(start)
        path = linkage.step_fast(poses)
        ratio = np.gradient(path[:, -1, 1])
        return -np.min(1.0 / ratio) if np.isfinite(ratio).all() else 1e9

    return value


def main():
    from peer_pylinkage import hitch, pylinkage  # beside this file; not there where the tests collect it

    asked = json.loads(sys.stdin.readline())
    linkage = hitch(pylinkage(), asked["design"], asked["start"] - asked["rate"], asked["rate"])
    linkage.compile()
    first = linkage.get_constraints()
    start = [component.position for component in linkage.components]
    known = {round(value, 12): place for place, value in enumerate(first)}
    order = [known[round(asked["design"][name], 12)] for name in asked["varied"] if round(asked["design"][name], 12) in known]
    value = objective(linkage, first, start, asked["poses"], order)
    lengths = np.array([first[place] for place in order])
    value(lengths)
    print(json.dumps(len(order)), flush=True)
    random = np.random.default_rng(0)
    for line in sys.stdin:
        count = int(line)
        begin = time.process_time()
        for _ in range(count):
            value(lengths + random.uniform(-0.02, 0.02, len(lengths)))
        print(json.dumps((time.process_time() - begin) / count), flush=True)


if __name__ == "__main__":
    main()
