"""What holds a body is declared or built: forces on one that is only placed are refused; the message names the loose ones alone."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import RIGHT, Crank, Dyad, Ground, Guide, Link, LinkageError, Mechanism, Offset, OnGuide, Stroke, Turn, Vector, Weight
from linkage.motion import columns_of
from linkage.statics import driving_force, pin_forces


class Placed(Mechanism):
    """An arm OB on a cylinder; P and R are placed by vectors that turn with no body at O and at K."""

    S = Stroke(0.00, 0.25)
    A, O, K = Ground(0.20, 0.55), Ground(0.30, 1.15), Ground(0.90, 1.00)
    B = Dyad(A, O, AB=0.50 + S, OB=0.30, side=RIGHT)
    OB = Vector(O, B)
    P = Offset(O, Turn(Vector(A, B), 0.4, length=0.5))
    R = Offset(K, Turn(OB, -0.2, length=0.4))
    load = Weight(P, mass=100.0)


def declared(*links):
    return type("Declared", (Placed,), {f"body{k}": Link(link) for k, link in enumerate(links)})


@pytest.mark.parametrize(
    ("links", "ways", "loose", "held"),
    [
        (("O P",), "1 way:", ["OP"], ["OB", "KR"]),
        (("O P", "K R"), "2 ways:", ["OP", "KR"], ["OB"]),
    ],
)
def test_loose_bodies_are_named_and_no_others(links, ways, loose, held):
    with pytest.raises(LinkageError, match=f"with its drives locked it can still move in {ways}") as told:
        pin_forces(declared(*links)().sweep(3))
    names = str(told.value).split(ways)[1].split("held by nothing")[0]
    assert all(name in names for name in loose)
    assert not any(name in names for name in held)


def test_body_that_is_built_is_held():
    """A point on the arm's own body, without a link: moments about O, by hand."""
    motion = type("Built", (Placed,), {"P": Offset("O", Turn("OB", 0.4, length=0.5))})().sweep(5)
    A, O, B, P = (motion[name] for name in "AOBP")
    u = (B - A) / np.hypot(*(B - A))
    arm = B - O
    lever = arm[0] * u[1] - arm[1] * u[0]
    force = 100.0 * 9.80665 * (P - O)[0] / lever
    assert_allclose(driving_force(motion), force, rtol=1e-12)
    assert_allclose(pin_forces(motion).thrusts["AB"], force, rtol=1e-12)


def test_pointer_that_nothing_hangs_on_is_no_body():
    assert "KR" not in {body.name for body in Placed().links}
    assert "KR" in {body.name for body in type("Loaded", (Placed,), {"more": Weight("R", mass=1.0)})().links}


class TwoKinds(Mechanism):
    """A stroke that is a length, and one that is an angle."""

    s, phi = Stroke(0.1, 0.3), Stroke(0.0, 1.0)
    rail = Guide((0.0, 0.0), angle=0.0)
    A = OnGuide(rail, at=s)
    B = Crank(A, AB=0.2, angle=phi)


def test_columns_of_strokes_are_read_in_their_units():
    columns = {each.name: each for each in columns_of(TwoKinds().sweep(s=3, phi=2))}
    assert [columns[name].heading for name in ("s", "phi", "A_x", "B_y")] == ["s, m", "phi, deg", "A_x, m", "B_y, m"]
    assert_allclose(columns["phi"].shown.max(), np.degrees(1.0))
    assert_allclose(columns["s"].shown.max(), 0.3)
