"""Groups that take two turns of their crank to return: told by the limits, true against the four-bar's closed form."""

from math import pi

import numpy as np
from numpy.testing import assert_allclose

from linkage import LEFT, Crank, Dyad, Ground, Link, Mechanism, OnLink, Pin, Stroke
from linkage.pictures.strokes import playback
from mechanisms.classics.stephenson_three import StephensonThree, StephensonThreeFar
from mechanisms.classics.stephenson_two import StephensonTwo, StephensonTwoFar
from tests.for_all import for_all


class TwoTurns(Mechanism):
    """A drag-link four-bar P E F Q whose coupler point D goes round O twice; D is driven by a crank on O through a rod."""

    phi = Stroke(0, 2 * pi)
    O, P, Q = Ground(0.61, -0.29), Ground(0, 0), Ground(1, 0)
    A = Crank(O, OA=1.0, angle=phi)
    plate = Link("D E F", DE=1.83, DF=1.82, EF=1.98)
    r1, r2, r3 = Link("A D", AD=1.0), Link("P E", PE=1.85), Link("Q F", QF=1.73)
    D, E, F = Pin(near=(0.686, -0.674)), Pin(near=(1.614, 0.904)), Pin(near=(2.496, -0.869))


class OneTurn(Mechanism):
    """A plate on three rods, one of them on a short crank: a group that returns."""

    phi = Stroke(0, 2 * pi)
    O, P, Q = Ground(0, 0), Ground(3, 0), Ground(1.5, 3)
    A = Crank(O, OA=0.1, angle=phi)
    plate = Link("D E F", DE=1, DF=0.9, EF=0.8)
    r1, r2, r3 = Link("A D", AD=0.9), Link("P E", PE=1.4), Link("Q F", QF=1.9)
    D, E, F = Pin(near=(0.8, 0.5)), Pin(near=(1.8, 0.6)), Pin(near=(1.4, 1.1))


class FourBar(Mechanism):
    phi = Stroke(0, 2 * pi)
    O, C = Ground(0, 0), Ground(4, 0)
    A = Crank(O, OA=1, angle=phi)
    B = Dyad(A, C, AB=3, CB=2.5, side=LEFT)
    G = OnLink(A, B, AG=1.0)


def drag_link(count=4001):
    """Return the crank angle that belongs to each pose of the four-bar, without jumps and 0 at the sketch, and D as complex numbers."""
    E = 1.85 * np.exp(1j * np.linspace(0.0, 2 * pi, count))
    d = abs(1.0 - E)
    along = (1.98**2 + d**2 - 1.73**2) / (2 * 1.98 * d)
    u = (1.0 - E) / d * (along + 1j * np.sqrt(1 - along**2))
    x = (1.83**2 - 1.82**2 + 1.98**2) / (2 * 1.98)
    D = E + u * (x - 1j * np.sqrt(1.83**2 - x**2))
    away = D - (0.61 - 0.29j)
    phi = np.unwrap(np.angle(away)) + np.arccos(0.5 * abs(away))
    return phi - 2 * pi * np.round(phi[np.argmin(abs(D - (0.686 - 0.674j)))] / (2 * pi)), D


def test_the_coupler_point_goes_round_twice():
    phi, D = drag_link()
    assert_allclose(abs(phi[-1] - phi[0]), 4 * pi, rtol=1e-12)
    assert (np.diff(phi) > 0.0).all()
    motion = TwoTurns().at(phi=phi)
    assert_allclose(motion.x("D") + 1j * motion.y("D"), D, atol=1e-9)


def test_limits_tell_of_a_motion_that_repeats_after_two_turns():
    limits = TwoTurns().sweep(5).limits()["phi"]
    assert limits.open_turn is not None
    assert (limits.open_turn.pins, limits.open_turn.turns) == (("D", "E", "F"), 2)
    told = "after one turn the pins D E F do not stand where they began; the motion repeats after 2 turns (720 deg)"
    assert str(limits).splitlines()[-1] == f"  {told}"
    motion = TwoTurns().at(phi=2 * pi * np.arange(5))
    assert_allclose(motion["D"][:, ::2], motion["D"][:, :1] + np.zeros(3), atol=1e-12)
    assert abs(motion["D"][:, 1] - motion["D"][:, 0]).max() > 0.05


@for_all("machine", [OneTurn, FourBar, StephensonTwoFar], slow=[StephensonTwo, StephensonThree, StephensonThreeFar])
def test_nothing_is_told_of_what_returns(machine):
    motion = machine().sweep(5)
    limits = motion.limits()[next(iter(motion.strokes))]
    assert limits.open_turn is None
    assert "turn" not in str(limits)


def test_a_group_on_a_full_turn_returns_where_nothing_is_told():
    motion = OneTurn().at(phi=[0.0, 2 * pi])
    assert_allclose(motion["D"][:, 1], motion["D"][:, 0], atol=1e-12)
    assert playback(OneTurn(), 9).is_turn
    assert not playback(TwoTurns(), 9).is_turn
    assert playback(TwoTurns(), 9, at=dict(phi=(0.0, 4 * pi))).is_turn
