"""Sums, products and functions of what is asked: the same as NumPy's arithmetic of the arrays, by every way of asking."""

import operator

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import DefinitionError, SingularError, drive_force, pin_force, ratio, ref, transmission, x, y
from mechanisms.three_point_hitch.machine import ThreePointHitch
from tests.for_all import for_all

STROKE = np.linspace(0.01, 0.24, 7)
LEAVES = [
    ref("tilt"), y("G"), x("K"), ratio("tilt"), ratio(y("G")), ratio("G"), ratio("tilt", order=2), drive_force(), pin_force("O"),
    pin_force("F", component="x"), transmission("K"), 2.5, -0.75,
]  # fmt: skip
BINARY = [operator.add, operator.sub, operator.mul, np.minimum, np.maximum, np.arctan2]
UNARY = [operator.neg, operator.pos, abs, np.sin, np.cos, lambda q: q**2, lambda q: 1.0 / (2.0 + q**2), lambda q: np.sqrt(1.0 + abs(q))]


def expression(rng, motion, depth):
    """Return a random expression, and the same of the arrays."""
    if depth == 0 or rng.random() < 0.15:
        leaf = LEAVES[rng.integers(len(LEAVES))]
        size = 1.0 if isinstance(leaf, float) else float(np.max(np.abs(motion[leaf])))
        return (leaf, leaf) if isinstance(leaf, float) else (leaf / size, motion[leaf] / size)
    if rng.random() < 0.35:
        rule = UNARY[rng.integers(len(UNARY))]
        asked, values = expression(rng, motion, depth - 1)
        return rule(asked), rule(values)
    rule = BINARY[rng.integers(len(BINARY))]
    (a, left), (b, right) = expression(rng, motion, depth - 1), expression(rng, motion, depth - 1)
    return rule(a, b), rule(left, right)


@for_all("seed", range(2), slow=range(2, 24))
def test_expressions_are_numpys_of_the_arrays_by_every_way(seed):
    rng, hitch = np.random.default_rng(seed), ThreePointHitch()
    motion = hitch.at(S=STROKE)
    asked, values = expression(rng, motion, 3)
    asked = asked + 0.0 * drive_force()  # a request in every case
    found = motion[asked]
    values = np.broadcast_to(values, found.shape)
    assert_allclose(found, values, rtol=1e-13, atol=1e-13)
    assert_allclose(motion.value(asked), found, rtol=0)
    (evaluated,) = hitch.evaluate([asked], S=STROKE)
    assert_allclose(evaluated, found, rtol=1e-9, atol=1e-9)
    at_one = hitch.function([asked])(float(STROKE[2]))
    assert_allclose(at_one, np.atleast_1d(found[..., 2]), rtol=1e-9, atol=1e-9)


def test_the_size_of_a_ratio():
    motion = ThreePointHitch().at(S=STROKE)
    assert_allclose(motion[np.hypot(ratio(x("G")), ratio(y("G")))], np.hypot(*motion.ratio("G")), rtol=1e-15)


@pytest.mark.parametrize("rule", [operator.lt, operator.le, operator.gt, operator.ge])
def test_a_comparison_is_a_condition_on_poses_and_refused_once_for_all(rule):
    for asked in (drive_force(), drive_force() / 2.0, ref("tilt"), transmission("K")):
        with pytest.raises(DefinitionError, match=r"cannot be compared.*least\(q\) >= "):
            bool(rule(asked, 3.0))
        with pytest.raises(DefinitionError, match="is a condition on poses and no number"):
            rule(asked, 3.0) * 2.0


def test_text_is_what_was_written():
    force = drive_force()
    assert str(abs(ref("tilt")) * force / ratio("G_y", wrt="S") - 3) == "absolute(tilt) * drive_force() / ratio(G_y, wrt=S) - 3.0"
    assert str(-(force + 1) ** 2) == "-(drive_force() + 1.0) ** 2.0"
    assert str(2 - (force - pin_force("O", case="full"))) == "2.0 - (drive_force() - pin_force(O, case=full))"
    assert str(np.minimum(abs(force), ref("tilt") + 1)) == "minimum(abs(drive_force()), tilt + 1.0)"


def test_what_cannot_be_is_refused_in_words():
    motion = ThreePointHitch().at(S=STROKE)
    with pytest.raises(DefinitionError, match="no value before it is asked"):
        bool(drive_force())
    with pytest.raises(DefinitionError, match="takes"):
        drive_force() // 2
    with pytest.raises(DefinitionError, match=r"np\.floor .* use one of: add"):
        np.floor(drive_force())
    with pytest.raises(DefinitionError, match="stands where a number"):
        drive_force() * [1.0, 2.0]
    with pytest.raises(DefinitionError, match="A is not the joint of a dyad; those are: B, D, K"):
        motion[transmission("A")]
    with pytest.raises(DefinitionError, match="those are: B, D, K"):
        ThreePointHitch().evaluate([transmission("A") * 2], S=0.1)
    nothing = drive_force() / (ratio("tilt") - ratio("tilt"))
    for ask in (lambda: motion[nothing], lambda: ThreePointHitch().evaluate([nothing], S=STROKE)):
        with pytest.raises(SingularError, match=r"drive_force\(\) / \(ratio\(tilt\) - ratio\(tilt\)\) has no finite value"):
            ask()
    assert np.isnan(ThreePointHitch().evaluate([nothing], S=STROKE, unreachable="nan")).all()
