"""The three-point hitch, in both spellings, against its independent reference."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import CosineAngle, Dimension, Ground, Link, Mechanism, Offset, Stroke, Turn, Vector, angle, deg
from mechanisms.three_point_hitch import ThreePointHitch
from tests.for_all import for_all
from tests.mechanisms.hitch_reference import REFERENCE


class HitchPrimitives(Mechanism):
    """The same hitch in the paper's own primitives, equations (4) to (26) in their order."""

    S = Stroke(0.00, 0.25)
    L0, LOB, LOC, LBC = Dimension(0.50), Dimension(0.30), Dimension(0.36), Dimension(0.16)
    LED, LCD, LEF = Dimension(0.48), Dimension(0.62), Dimension(0.95)
    LMK, LKF, LFG, KFG = Dimension(0.88), Dimension(0.685), Dimension(0.90), Dimension(75 * deg)

    A, O, E, M = Ground(0.20, 0.55), Ground(0.30, 1.15), Ground(0.25, 0.60), Ground(0.22, 1.05)

    AO = Vector(A, O)                                     # (5)
    OAB = CosineAngle(abs(AO), L0 + S, LOB)               # (6)
    AB = Turn(AO, -OAB, length=L0 + S)                    # (7)
    B = Offset(A, AB)                                     # (8)
    OB = Vector(O, B)                                     # (9)
    COB = CosineAngle(LOB, LOC, LBC)                      # (10)
    OC = Turn(OB, COB, length=LOC)                        # (11)
    C = Offset(O, OC)                                     # (12)
    EC = Vector(E, C)                                     # (14)
    CED = CosineAngle(abs(EC), LED, LCD)                  # (15)
    ED = Turn(EC, -CED, length=LED)                       # (16)
    D = Offset(E, ED)                                     # (17)
    EF = Turn(ED, 0.0, length=LEF)                        # (18)
    F = Offset(E, EF)                                     # (19)
    MF = Vector(M, F)                                     # (20)
    FMK = CosineAngle(abs(MF), LMK, LKF)                  # (21)
    MK = Turn(MF, FMK, length=LMK)                        # (22)
    K = Offset(M, MK)                                     # (23)
    FK = Vector(F, K)                                     # (24)
    FG = Turn(FK, -KFG, length=LFG)                       # (25)
    G = Offset(F, FG)                                     # (26)
    tilt = angle(F, K) - 90 * deg
    arm, lower, rod, upper, implement = Link(O, B, C), Link(E, D, F), Link(C, D), Link(M, K), Link(F, K, G)


SPELLINGS = pytest.mark.parametrize("spelling", [ThreePointHitch, HitchPrimitives])


def printed(values, digits):
    """Return values rounded to significant digits, as they would be printed."""
    return [float(f"{value:.{digits}g}") for value in values]


@SPELLINGS
@for_all("column", [name for name in REFERENCE if name[1:] in ("_x", "_y")])
def test_position_has_the_digits_of_the_reference(spelling, column):
    point, axis = column.split("_")
    motion = spelling().at(S=REFERENCE["S"])
    assert printed(getattr(motion, axis)(point), 9) == list(REFERENCE[column])


@SPELLINGS
def test_tilt_has_the_digits_of_the_reference(spelling):
    motion = spelling().at(S=REFERENCE["S"])
    assert printed(np.degrees(motion["tilt"]), 9) == list(REFERENCE["tilt"])


@SPELLINGS
@pytest.mark.parametrize("method", ["exact", "central"])
def test_transfer_ratio_has_the_digits_of_the_reference(spelling, method):
    motion = spelling().at(S=REFERENCE["S"])
    assert printed(motion.ratio("G", method=method)[1], 8) == list(REFERENCE["I"])


def test_spellings_are_one_mechanism():
    motion, other = ThreePointHitch().sweep(101), HitchPrimitives().sweep(101)
    for point in "BCDFKG":
        assert_allclose(motion[point], other[point], rtol=0, atol=1e-12)
        assert_allclose(motion.ratio(point), other.ratio(point), rtol=1e-12, atol=1e-12)
    assert_allclose(motion["tilt"], other["tilt"], rtol=0, atol=1e-12)


def test_spellings_have_the_same_bodies():
    assert {frozenset(body.points) for body in ThreePointHitch().links} == {frozenset(body.points) for body in HitchPrimitives().links}


def test_count_of_freedoms_is_one():
    assert ThreePointHitch().gruebler == 1


def test_columns_are_the_reference():
    hitch = ThreePointHitch()
    columns = {column.name: column for column in hitch.columns(hitch.at(S=REFERENCE["S"]))}
    assert list(columns) == list(REFERENCE)
    for name, values in REFERENCE.items():
        assert_allclose(columns[name].shown, values, rtol=2e-8)
    assert (columns["S"].unit, columns["G_y"].unit, columns["I"].unit, columns["tilt"].unit) == ("m", "m", "", "deg")


def test_second_hole_of_the_upper_link_tilts_the_mast():
    upper, lower = (ThreePointHitch(M=hole).at(S=0.0) for hole in ((0.22, 1.05), (0.22, 0.95)))
    assert np.degrees(float(upper["tilt"] - lower["tilt"])) == pytest.approx(3.19365591 - 2.46255593, abs=1e-7)
