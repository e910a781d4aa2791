"""The fused loop in pieces: whatever the blocks, the order and the memory of the result, every pose gets its own numbers."""

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from linkage import Crank, Dyad, Ground, Mechanism, Stroke
from linkage.program import Kernel, RunOptions
from linkage.program import numba_backend as fused
from tests.linkage.program.test_backends import uncompiled


class FourBar(Mechanism):
    """A drag link on a crank, and a second stroke that shifts its length."""

    phi, s = Stroke(0.3, 2.5), Stroke(-0.02, 0.02)
    O, C = Ground(0.0, 0.0), Ground(0.4, 0.0)
    A = Crank(O, OA=0.1, angle=phi)
    X = Dyad(A, C, AX=0.35 + s, CX=0.30, side="left")


@pytest.fixture
def kernel(monkeypatch):
    """The kernel of a dyad with its guards, its loop as plain Python, cut into blocks of 3 designs and 5 poses."""
    monkeypatch.setattr(fused, "PART", 3)
    monkeypatch.setattr(fused, "WIDE", 5)
    plan = FourBar.plan
    made = Kernel([*plan.nodes("X"), *plan.nodes("A")], plan.trace.watched(plan.members))
    made.fused._ready.update({turned: uncompiled(made.fused.plan, turned) for turned in (False, True)})
    return made


def inputs(m, n, table, seed=1):
    """Return inputs of m designs and n poses; a single one as a float; the first stroke as a table (m, n) if wanted."""
    random = np.random.default_rng(seed)
    given = dict(FourBar.plan.defaults)
    for name in ("OA", "CX", "C.x"):
        given[name] = given[name] * random.uniform(0.97, 1.03, m) if m > 1 else given[name] * random.uniform(0.97, 1.03)
    given["phi"] = random.uniform(0.4, 2.4, (m, n) if table else n) if n > 1 or table else 0.9
    given["s"] = random.uniform(-0.01, 0.01, n) if n > 1 else 0.004
    return given


SHAPES = [(1, 1), (1, 13), (4, 13), (7, 1), (8, 17), (17, 2), (20, 1), (18, 16), (17, 15), (16, 15), (3, 5), (6, 10)]


@pytest.mark.parametrize("table", [False, True])
@pytest.mark.parametrize(("m", "n"), SHAPES)
def test_blocks_do_not_show(kernel, m, n, table):
    given = inputs(m, n, table)
    wanted = kernel(given, way=RunOptions("numpy"), size=(m, n))
    found = kernel(given, way=RunOptions("numba"), size=(m, n))
    assert found.values.shape == (4, m, n)
    assert_allclose(found.values, wanted.values, rtol=0, atol=1e-14)
    assert_array_equal(found.guards > 0.0, wanted.guards > 0.0)


@pytest.mark.parametrize(("m", "n"), [(4, 13), (18, 6)])
@pytest.mark.parametrize("order", ["C", "F", "strided"])
def test_results_go_where_they_are_wanted(kernel, m, n, order):
    """Into memory of any layout, and beside it nothing is touched."""
    room = np.full((8, 2 * m, 2 * n), 7.0, order="F" if order == "F" else "C")
    out = room[::2, ::2, ::2] if order == "strided" else room[:4, :m, :n]
    given = inputs(m, n, table=False)
    found = kernel(given, out, RunOptions("numba"))
    assert np.shares_memory(found.values, room)
    assert_allclose(out, kernel(given, way=RunOptions("numpy")).values, rtol=0, atol=1e-14)
    assert np.count_nonzero(room != 7.0) == out.size


def test_each_single_design_has_its_own_constants(kernel):
    """The design part is kept for the next call only where all numbers are the same."""
    for seed in (1, 2, 1, 3, 3):
        given = inputs(1, 9, table=False, seed=seed)
        assert_allclose(kernel(given, way=RunOptions("numba")).values, kernel(given, way=RunOptions("numpy")).values, rtol=0, atol=1e-14)


@pytest.mark.parametrize(("m", "n"), [(1, 40), (40, 1), (7, 11)])
@pytest.mark.parametrize("place", [0, 3, -1])
def test_one_bad_pose_in_any_block_is_told(kernel, m, n, place):
    given = inputs(m, n, table=False)
    if n > 1:
        given["s"][place] = 1.0
    else:
        given["OA"] = np.array(given["OA"])
        given["OA"][place] = 3.0
    found, wanted = (kernel(given, way=RunOptions(way)) for way in ("numba", "numpy"))
    assert_array_equal(found.guards > 0.0, wanted.guards > 0.0)
    assert not np.all(found.guards > 0.0)
    assert_array_equal(np.isnan(found.values), np.isnan(wanted.values))
    assert np.isnan(found.values).any() and np.isfinite(found.values).any()


def test_compiling_has_to_pay(kernel, monkeypatch):
    """Work is poses times operations; what is kept on disk pays sooner, what is ready at once, and nothing without Numba."""
    plan = kernel.fused.plan
    least = int(fused.COMPILE / len(plan.pose)) + 1
    few = int(fused.LOAD / len(plan.pose)) + 1

    def is_worth(poses, *, kept, there=True, spent=0):
        monkeypatch.setattr(fused, "is_cached", lambda text: kept)
        monkeypatch.setattr(fused, "is_there", lambda: there)
        return fused.NumbaLoop(plan, kernel.arrays).is_worth(1, poses, spent)

    assert is_worth(least, kept=False) and not is_worth(least - 2, kept=False)
    assert is_worth(few, kept=True) and not is_worth(few - 2, kept=True)
    assert is_worth(10, kept=False, spent=least) and not is_worth(10, kept=False, spent=least - 20)
    assert not is_worth(least, kept=True, there=False)
    assert kernel.fused.is_worth(1, 1, 0), "it is ready"
