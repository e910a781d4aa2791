"""Points spread evenly over a unit cube: by a Sobol sequence or a Latin hypercube."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..errors import DefinitionError, cited, one_word
from ..program import FloatArray
from ..quantities import is_whole

MOST = 1 << 30
"""Designs of one sample."""

METHODS = ("sobol", "latin")


def unit_points(count: int, k: int, method: str, seed: int) -> FloatArray:
    """Return points (count, k) of [0, 1); the same for the same seed. A Sobol sequence is evenest where count is a power of two."""
    if not is_whole(count) or count < 1:
        raise DefinitionError(f"count={cited(count)}: a whole number of designs is expected, at least 1.")
    if count > MOST:
        raise DefinitionError(f"count={cited(count)}: so many designs do not fit into memory; ask for fewer.")
    one_word("method", method, METHODS)
    if not is_whole(seed) or seed < 0:
        raise DefinitionError(f"seed={seed!r}: a whole number is expected, at least 0.")
    if not k:
        return np.empty((count, 0))
    return sobol(int(count), k, seed) if method == "sobol" else latin(count, k, seed)


def sobol(count: int, k: int, seed: int) -> FloatArray:
    """Return the first points (count, k) of a scrambled Sobol sequence."""
    from scipy.stats import qmc

    engine: Any = qmc.Sobol(k, seed=np.random.default_rng(seed))
    power = count.bit_length() - 1
    points = engine.random_base2(power)
    rest = count - (1 << power)
    found: FloatArray = np.concatenate([points, engine.random(rest)]) if rest else points
    return found


def latin(count: int, k: int, seed: int) -> FloatArray:
    """Return a Latin hypercube (count, k): every coordinate has one point in each of count equal intervals."""
    from scipy.stats import qmc

    found: FloatArray = qmc.LatinHypercube(k, seed=np.random.default_rng(seed)).random(count)
    return found
