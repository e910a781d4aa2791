"""The points of a search and a survey: the scrambled Sobol sequence of SciPy, to the last bit."""

import numpy as np
from scipy.stats import qmc

from linkage.numeric.sobol import JOE_KUO, sobol_points


def test_points_are_those_of_scipy_in_few_and_many_coordinates():
    for k in (1, 2, 7, 20, len(JOE_KUO.split(";")), 40):
        for count, seed in ((1, 0), (16, 1), (100, 2), (256, 3)):
            engine = qmc.Sobol(k, seed=np.random.default_rng(seed))
            power = count.bit_length() - 1
            expected = np.concatenate([engine.random_base2(power), engine.random(count - (1 << power))])
            found = sobol_points(count, k, np.random.default_rng(seed))
            assert np.array_equal(found, expected)
