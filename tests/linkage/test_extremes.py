"""Extremes between the poses: their value, their place and their bounds, from however few poses and however narrow."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from linkage import LEFT, RIGHT, Crank, Dyad, Ground, Mechanism, Stroke, angle
from linkage.motion import greatest, lowest

WIDTH = 1.0 / 2000.0


class Lift(Mechanism):
    """One cylinder, one lever: AB from 0.4 m, where it is out of reach, to 0.8 m."""

    S = Stroke(0.50, 0.75)
    A = Ground(0.0, 0.0)
    O = Ground(0.60, 0.0)
    B = Dyad(A, O, AB=S, OB=0.20, side=RIGHT)
    psi = angle(O, B)


class Crane(Mechanism):
    """A boom and an arm, a cylinder each."""

    S1, S2 = Stroke(0.0, 0.60), Stroke(0.0, 0.30)
    O, A = Ground(0.0, 1.80), Ground(0.15, 0.90)
    B = Dyad(A, O, AB=0.95 + S1, OB=1.10, side=RIGHT)
    C = Dyad(O, B, OC=1.60, CB=0.62, side=LEFT)
    D = Dyad(C, O, CD=0.70 + S2, OD=1.35, side=LEFT)


class Arm(Mechanism):
    """A crank."""

    phi = Stroke(0.0, 2 * np.pi)
    O = Ground(0.0, 0.0)
    A = Crank(O, OA=0.1, angle=phi)


def of_stroke(f, name="S"):
    """Return a function of a motion that looks at the share of its stroke only."""

    def at(motion):
        stroke = motion.plan.strokes[name]
        share = (motion.strokes[name] - stroke.start) / (stroke.end - stroke.start)
        return np.broadcast_to(f(share), motion.shape)

    return at


def share(found, machine=Lift, name="S"):
    """Return the place of an extreme as a share of the stroke."""
    stroke = machine.plan.strokes[name]
    return (found.strokes[name] - stroke.start) / (stroke.end - stroke.start)


SHAPES = {
    "smooth": lambda u, p: -((u - p) ** 2),
    "kink": lambda u, p: -np.abs(u - p),
    "cusp": lambda u, p: -np.sqrt(np.abs(u - p)),
    "jump": lambda u, p: np.where(u < p, u - p, -1.0 - u),
    "triangle": lambda u, p: np.maximum(0.0, 1.0 - np.abs(u - p) / (0.5 * WIDTH)) - 1.0,
    "parabola": lambda u, p: np.maximum(0.0, 1.0 - ((u - p) / (0.5 * WIDTH)) ** 2) - 1.0,
    "triangle on a slope": lambda u, p: np.maximum(0.0, 1.0 - np.abs(u - p) / (0.5 * WIDTH)) - 1.0 + 0.5 * (u - p),
}


@pytest.mark.parametrize("shape", SHAPES)
@given(place=st.floats(0.02, 0.98))
def test_a_single_top_anywhere(shape, place):
    found = greatest(Lift().sweep(2), of_stroke(lambda u: SHAPES[shape](u, place)))
    assert found.value == pytest.approx(0.0, abs=1e-6)
    assert share(found) == pytest.approx(place, abs=1e-4)
    assert not found.unbounded


@pytest.mark.parametrize("count", [2, 3, 5, 50, 500, 4097, 6000])
def test_however_many_poses_say_the_same(count):
    first, other = (greatest(Lift().sweep(each), lambda motion: motion.ratio("psi")) for each in (2, count))
    assert (first.value, first.strokes) == (other.value, other.strokes)


def test_a_lever_is_shortest_where_the_circle_says():
    found = lowest(Lift().sweep(2), lambda motion: motion.ratio("psi"))  # AB / (AO OB sin AOB), least where AB2 = AO2 - OB2
    S = np.sqrt(0.60**2 - 0.20**2)
    assert found.strokes["S"] == pytest.approx(S, abs=1e-4 * 0.25)
    assert found.value == pytest.approx(1.0 / 0.20, rel=1e-12)
