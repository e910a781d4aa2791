"""Lengths that follow where a point is: a cam, a rope's end, a stop that goes along. Everything that reads a machine reads these."""

import warnings
from functools import cache

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import (
    LEFT,
    Crank,
    DefinitionError,
    Dyad,
    Ground,
    Guide,
    Link,
    Mechanism,
    OnGuide,
    OnLink,
    Pin,
    SingularWarning,
    SliderDyad,
    Stroke,
    angle,
    distance,
    ratio,
    x,
    y,
)
from linkage.files import load, to_json, to_toml
from linkage.loads import Weight
from linkage.statics import driving_force, pin_forces
from tests.for_all import for_all

G = 9.80665


class Lever(Mechanism):
    """A lever OB on a driven length AB."""

    S = Stroke(0.0, 0.2)
    A, O, P = Ground(0.0, 0.0), Ground(0.1, 0.6), Ground(0.4, 0.5)
    B = Dyad(A, O, AB=0.45 + S, OB=0.3, side=LEFT)
    E = OnLink(O, B, OE=0.5)
    rail = Guide((0.0, -0.4), angle=0.2)


FOLLOWED = {
    "angle": 0.55 + 0.1 * angle("O", "B"),
    "distance": 0.4 + 0.3 * distance("E", "P"),
    "place": 0.5 + 0.1 * x("B") - 0.2 * y("E"),
    "product": 0.3 + distance("A", "E") * np.sin(angle("B", "P")) * 0.1 + 0.2,
    "fixed": 0.9 * distance("A", "O"),
}
STEPS = {
    "body": lambda length: OnLink("O", "B", OX=length, BOX=0.3),
    "dyad": lambda length: Dyad("P", "B", PX=length, BX=0.5, side=LEFT),
    "slider": lambda length: SliderDyad("B", "rail", BX=0.9 + length, side=LEFT),
    "guide": lambda length: OnGuide("rail", at=length),
}
CASES = [pytest.param(step, name, id=f"{step}-{name}") for step in STEPS for name in FOLLOWED]


@cache
def machine_of(step, name):
    """Return a lever with a weight on a point X whose length follows something."""
    return type("Following", (Lever,), {"X": STEPS[step](FOLLOWED[name]), "load": Weight("X", mass=10.0)})


def height(machine, S):
    """Return the height of the weight [m]."""
    return machine.at(S=S).y("X")


@for_all(("step", "name"), CASES[::2], slow=CASES)
def test_values_ratios_and_forces(step, name):
    machine, S, h = machine_of(step, name)(), np.linspace(0.02, 0.18, 5), 1e-5
    motion = machine.at(S=S)
    length = {"body": ("O", "X"), "dyad": ("P", "X"), "slider": ("B", "X")}.get(step)
    if length:  # the length that was asked for is the one that is there
        assert_allclose(motion.distance(*length), motion.value(FOLLOWED[name]) + 0.9 * (step == "slider"), rtol=1e-12)
    places, later, earlier = (machine.at(S=S + way) for way in (0.0, h, -h))
    assert_allclose(motion.ratio("X"), (later["X"] - earlier["X"]) / (2 * h), rtol=1e-6, atol=1e-8)
    assert_allclose(motion.ratio("X", order=2), (later.ratio("X") - earlier.ratio("X")) / (2 * h), rtol=1e-5, atol=1e-6)
    assert_allclose(driving_force(places), 10.0 * G * (later.y("X") - earlier.y("X")) / (2 * h), rtol=1e-6, atol=1e-6)


@for_all(("step", "name"), (), slow=CASES)
def test_gradients_and_kernels(step, name):
    kind = machine_of(step, name)
    machine, S, h = kind(), np.linspace(0.02, 0.18, 5), 1e-6
    motion = machine.at(S=S)
    for of, wrt in (("X", "OB"), (ratio("X"), "A.x")):
        more, less = (kind(**{wrt: machine[wrt] + way}) for way in (h, -h))
        central = (more.evaluate([of], S=S)[0] - less.evaluate([of], S=S)[0]) / (2 * h)
        assert_allclose(np.squeeze(motion.gradient(of, wrt=[wrt])), central, rtol=1e-5, atol=1e-6)
    expected = motion.ratio("X")
    for backend in ("numpy", "floats"):
        assert_allclose(machine.evaluate([ratio("X")], S=S, backend=backend)[0], expected, rtol=1e-12, atol=1e-14)
    pose = machine.function(["X", ratio("X")])
    assert_allclose([pose(each)[2:] for each in S], expected.T, rtol=1e-12, atol=1e-14)


@for_all(("step", "name"), CASES[::3], slow=CASES)
def test_files_mobility_and_limits(step, name):
    kind = machine_of(step, name)
    motion = kind().sweep(5)
    back = load(to_toml(kind))
    assert to_json(back) == to_json(kind)
    assert np.array_equal(back().sweep(5)["X"], motion["X"])
    assert kind().mobility == 1
    dead = np.sqrt(0.1**2 + 0.6**2) - 0.3 - 0.45  # A, B and O in line: AO - OB = AB
    assert motion.limits()["S"].intervals[0].low == pytest.approx(dead, abs=1e-9)


@for_all("name", FOLLOWED)
def test_next_to_a_dead_point_it_is_told(name):
    """The poses next to a dead point are read eagerly, which asks for the machine's size: the longest length that follows nothing."""
    kind = machine_of("body", name)
    dead = np.sqrt(0.1**2 + 0.6**2) - 0.3 - 0.45
    with pytest.warns(SingularWarning, match="near a dead point"):
        found = kind().at(S=dead + 1e-8).ratio("X")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SingularWarning)
        later, earlier = (kind().at(S=dead + 1e-8 + way)["X"] for way in (1e-12, -1e-12))
    assert_allclose(found, (later - earlier) / 2e-12, rtol=1e-2)


def test_the_force_of_a_drive_that_follows_a_point_is_that_of_a_rack_or_refused_in_words():
    assert pin_forces(machine_of("body", "angle")().sweep(3)).gap < 1e-12
    for name, words in (("place", r"is geared to bodies, such as at=0\.3"), ("product", "follows .*, which depends on moving points")):
        with pytest.raises(DefinitionError, match=words):
            pin_forces(machine_of("body", name)().sweep(3))


def test_links_of_a_parts_list_may_follow_a_point():
    class Listed(Lever):
        X = Pin(near=(-0.1, 0.2))
        one, two = Link("P X", PX=FOLLOWED["distance"] + 0.2), Link("B X", BX=0.5)

    class Written(Lever):
        X = Dyad("P", "B", PX=FOLLOWED["distance"] + 0.2, BX=0.5, side=LEFT)

    listed, written = Listed().sweep(5), Written().sweep(5)
    assert_allclose(listed["X"], written["X"], rtol=0, atol=1e-14)
    assert_allclose(listed.ratio("X"), written.ratio("X"), rtol=0, atol=1e-13)


def test_a_group_may_have_lengths_that_follow_a_point():
    class Plate(Mechanism):
        phi = Stroke(0.0, 0.3)
        O, P, Q = Ground(0, 0), Ground(3, 0), Ground(1.5, 3)
        A = Crank(O, OA=0.5, angle=phi)
        plate = Link("D E F", DE=1, DF=0.9, EF=0.8)
        r1 = Link("A D", AD=0.7 + 0.2 * distance("A", "O"))
        r2 = Link("P E", PE=1.0 + 0.1 * (x("A") - 0.5))
        r3 = Link("Q F", QF=1.9)
        D, E, F = Pin(near=(1.2, 0.5)), Pin(near=(2.2, 0.5)), Pin(near=(1.6, 1.3))

    motion = Plate().sweep(5)
    assert_allclose(motion.distance("P", "E"), 1.0 + 0.1 * (motion.x("A") - 0.5), rtol=1e-13)
    assert_allclose(motion.ratio("D"), motion.ratio("D", method="central"), rtol=0, atol=1e-8)
    assert Plate().mobility == 1


def test_lengths_may_follow_points_that_follow_lengths():
    class Chain(Lever):
        X = OnLink("O", "B", OX=0.3 + 0.1 * distance("B", "P"))
        Y = OnLink("O", "X", OY=0.1 + 0.5 * distance("X", "P"))
        Z = Dyad("Y", "P", YZ=0.5 + 0.1 * angle("O", "Y"), PZ=0.7, side=LEFT)

    motion = Chain().sweep(5)
    assert_allclose(motion.distance("O", "Y"), 0.1 + 0.5 * motion.distance("X", "P"), rtol=1e-13)
    assert_allclose(motion.ratio("Z"), motion.ratio("Z", method="central"), rtol=0, atol=1e-8)
