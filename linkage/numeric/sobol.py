"""Points spread evenly over a box: a scrambled Sobol sequence, without loading SciPy's statistics for it, which takes half a second.

Source: S. Joe, F. Y. Kuo, Constructing Sobol sequences with better two-dimensional projections, SIAM J. Sci. Comput. 30 (2008) 2635-2654;
scrambled by J. Matousek, On the L2-discrepancy for anchored boxes, Journal of Complexity 14 (1998) 527-556.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..vectors import FloatArray

BITS = 30
JOE_KUO = """
1; 3 1; 7 1 3; 11 1 3 1; 13 1 1 1; 19 1 1 3 3; 25 1 3 5 13; 37 1 1 5 5 17; 41 1 1 5 5 5; 47 1 1 7 11 19; 55 1 1 5 1 1;
59 1 1 1 3 11; 61 1 3 5 5 31; 67 1 3 3 9 7 49; 91 1 1 1 15 21 21; 97 1 3 1 13 27 49; 103 1 1 1 15 7 5; 109 1 3 1 15 13 25;
115 1 1 5 5 19 61; 131 1 3 7 11 23 15 103; 137 1 3 7 13 13 15 69; 143 1 1 3 13 7 35 63; 145 1 3 5 9 1 25 53; 157 1 3 1 13 9 35 107;
167 1 3 1 5 27 61 31; 171 1 1 5 11 19 41 61; 185 1 3 5 3 3 13 69; 191 1 1 7 13 1 19 1; 193 1 3 7 5 13 19 59; 203 1 1 3 9 25 29 41;
211 1 3 5 13 23 1 55; 213 1 3 7 3 13 59 17
"""
"""Of each coordinate a primitive polynomial, as the number of its bits, and its first direction numbers."""


def sobol_points(count: int, k: int, random: np.random.Generator) -> FloatArray:
    """Return the first points (count, k) of a scrambled Sobol sequence in [0, 1), the same as `scipy.stats.qmc.Sobol` gives."""
    known = JOE_KUO.split(";")
    if k > len(known):
        from scipy.stats import qmc

        engine: Any = qmc.Sobol(k, seed=random)
        power = count.bit_length() - 1
        return np.concatenate([engine.random_base2(power), engine.random(count - (1 << power))])
    random = random.spawn(1)[0]
    weights = 2 ** np.arange(BITS)
    shift = random.integers(2, size=(k, BITS), dtype=np.uint32) @ weights
    scramble = np.tril(random.integers(2, size=(k, BITS, BITS), dtype=np.uint32), -1) + np.eye(BITS, dtype=np.uint32)
    directions = np.ones((k, BITS), int)
    for own, row in zip(directions, known, strict=False):
        polynomial, *first = map(int, row.split())
        own[: len(first)] = first
        for number in range(len(first), BITS) if first else ():
            back = [each for each in range(1, len(first)) if polynomial >> (len(first) - each) & 1]
            own[number] = own[number - len(first)] ^ np.bitwise_xor.reduce([own[number - each] << each for each in (*back, len(first))])
    directions <<= np.arange(BITS)[::-1]
    bits = directions[:, None, :] // weights[::-1, None] % 2  # the highest first
    directions = weights[::-1] @ (scramble @ bits % 2)
    place = np.arange(1, count)
    changed = np.log2(place & -place).astype(int)  # of the Gray code
    return np.bitwise_xor.accumulate(np.concatenate([shift[None], directions.T[changed]])) * 0.5**BITS
