"""Long chains of dyads: what is done for them grows as their length does, counted in calls and in nodes, not by a clock."""

import sys

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import LEFT, Crank, Dyad, Ground, Mechanism, Stroke


def chain(dyads):
    """Return a machine of so many dyads, each of which hangs from the one before and from the ground."""
    members = {"phi": Stroke(0.3, 0.8), "O": Ground(0.0, 0.0), "P0": Crank("O", OP0=0.3, angle="phi")}
    for k in range(1, dyads + 1):
        members[f"G{k}"] = Ground(1.0 * k, 0.0)
        members[f"P{k}"] = Dyad(f"P{k - 1}", f"G{k}", **{f"P{k - 1}P{k}": 1.0 + 0.002 * (-1) ** k, f"G{k}P{k}": 0.3}, side=LEFT)
    return type("Chain", (Mechanism,), members)


def calls(work):
    """Return how many calls some work makes, of Python's functions and of C's, and what it returns."""
    count = 0

    def counted(frame, event, argument):
        nonlocal count
        count += event in ("call", "c_call")

    sys.setprofile(counted)
    try:
        found = work()
    finally:
        sys.setprofile(None)
    return count, found


def last_ratio(dyads):
    """Return the calls for a class, for its first position, for the first ratio of its last point, and the nodes of its program."""
    making, kind = calls(lambda: chain(dyads))
    placing, motion = calls(lambda: kind().at(phi=0.5))
    deriving, ratio = calls(lambda: motion.ratio(f"P{dyads}"))
    nodes = kind.plan.made("a program of its own", lambda twin: len(twin.derived(twin.nodes(f"P{dyads}"), ("phi",))[0].graph.nodes))
    assert ratio.shape == (2,)
    return np.array([making, placing, deriving, nodes])


@pytest.mark.slow
def test_class_positions_and_ratios_grow_with_the_length():
    last_ratio(5)  # what is done once for all
    short, middle, long = (np.minimum(last_ratio(count), last_ratio(count)) for count in (8, 16, 32))  # caches fill in between
    growth = (long - middle) / (2.0 * (middle - short))
    assert np.all(growth < 1.05), growth


def test_a_ratio_at_the_end_is_the_central_difference():
    motion = chain(12)().at(phi=0.5)
    assert_allclose(motion.ratio("P12"), motion.ratio("P12", method="central"), rtol=1e-6)
