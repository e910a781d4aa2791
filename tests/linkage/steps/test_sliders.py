"""The class II dyads RRR, RRP, RPR, PRP and RPP, found in parts lists and spelled as steps; guides on moving bodies; several strokes."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import (
    LEFT,
    RIGHT,
    AssemblyError,
    Crank,
    Dimension,
    Dyad,
    Ground,
    Guide,
    GuideCross,
    Link,
    Mechanism,
    OnGuide,
    OnLink,
    Pin,
    PinSlotDyad,
    Slide,
    SliderDyad,
    Stroke,
    YokeDyad,
    deg,
)


class Base(Mechanism):
    """Crank OA to hang dyads on."""

    phi = Stroke(10 * deg, 170 * deg)
    O, C = Ground(0.0, 0.0), Ground(0.30, -0.10)
    A = Crank(O, OA=0.10, angle=phi)
    rail = Guide((0.05, -0.05), angle=20 * deg)


def pair(listed, stepped, kind, *points):
    """Assert that a parts list and its step are one motion, and that the pattern found the step."""
    assert [type(listed.plan.members[point]).__name__ for point in points] == [kind] * len(points)
    first, second = listed().sweep(41), stepped().sweep(41)
    for point in points:
        assert_allclose(first[point], second[point], rtol=0, atol=1e-14)
        assert_allclose(first.ratio(point), second.ratio(point), rtol=1e-10, atol=1e-12)
        for order, tolerance in ((1, 1e-8), (2, 1e-5)):
            exact, central = second.ratio(point, order=order), second.ratio(point, order=order, method="central")
            assert_allclose(central, exact, rtol=tolerance, atol=tolerance * np.abs(exact).max())


def test_rrr():
    class Listed(Base):
        coupler, rocker = Link("A B", AB=0.30), Link("C B", CB=0.25)
        B = Pin(near=(0.35, 0.15))

    class Stepped(Base):
        B = Dyad("A", "C", AB=0.30, CB=0.25, side=LEFT)

    pair(Listed, Stepped, "Dyad", "B")


@pytest.mark.parametrize(("side", "near"), [(RIGHT, (0.35, 0.05)), (LEFT, (-0.15, -0.12))])
def test_rrp(side, near):
    class Listed(Base):
        rod = Link("A B", AB=0.30)
        shoe = Slide("B", Base.rail)
        B = Pin(near=near)

    class Stepped(Base):
        B = SliderDyad("A", "rail", AB=0.30, side=side)

    pair(Listed, Stepped, "SliderDyad", "B")


@pytest.mark.parametrize(("side", "near"), [(RIGHT, (-0.1, 0.2)), (LEFT, (0.7, -0.4))])
def test_rpr(side, near):
    class Listed(Base):
        lever = Link("C R", CR=0.45)
        slot = Guide("C", "R")
        block = Slide("A", slot)
        R = Pin(near=near)

    class Stepped(Base):
        R = PinSlotDyad("C", "A", CR=0.45, side=side)

    pair(Listed, Stepped, "PinSlotDyad", "R")


def test_prp_of_a_fixed_and_a_moving_guide():
    class Listed(Base):
        line = Guide("C", "A")
        shoe, block = Slide("X", Base.rail), Slide("X", line)
        X = Pin(near=(0.2, 0.0))

    class Stepped(Base):
        line = Guide("C", "A")
        X = GuideCross("rail", line)

    pair(Listed, Stepped, "GuideCross", "X")


def test_rpp():
    """A cross-head that slides along the rail, its slot under an angle to it over the crank's pin."""

    class Listed(Base):
        X, Y, Z = Pin(near=(0.1, -0.03)), Pin(near=(0.2, 0.0)), Pin(near=(0.05, 0.1))
        head = Link("X Y Z", XY=0.10, XZ=0.20, YXZ=70 * deg)
        slot = Guide("X", "Z")
        first, second, block = Slide("X", Base.rail), Slide("Y", Base.rail), Slide("A", slot)

    class Stepped(Base):
        X = YokeDyad("A", "rail", angle=70 * deg)

    assert type(Listed.plan.members["X"]).__name__ == "YokeDyad"
    pair(Listed, Stepped, "YokeDyad", "X")
    motion = Listed().sweep(41)
    along = np.array([np.cos(20 * deg), np.sin(20 * deg)])
    for point in "XY":
        shoe = motion[point] - [[0.05], [-0.05]]
        assert_allclose(along[0] * shoe[1] - along[1] * shoe[0], 0.0, atol=1e-14)
    assert_allclose(motion.distance("X", "Z"), 0.20, rtol=1e-12)


def test_yoke_by_its_formula():
    class Yoke(Base):
        X = YokeDyad("A", "rail", angle=70 * deg)

    motion = Yoke().sweep(41)
    along, origin = np.exp(1j * 20 * deg), complex(0.05, -0.05)
    away = (motion.x("A") + 1j * motion.y("A") - origin) / along
    X = origin + along * (away.real - away.imag / np.tan(70 * deg))
    assert_allclose(motion.x("X") + 1j * motion.y("X"), X, rtol=0, atol=1e-15)


# -- guides on moving bodies ----------------------------------------------------------------------------------


class Carried(Base):
    """A shoe on the crank's own line, held from the frame: an inverted slider."""

    beam = Guide("O", "A")
    rod = Link("C B", CB=0.36)
    shoe = Slide("B", beam)
    B = Pin(near=(0.60, 0.10))


def test_a_guide_on_a_moving_body():
    motion = Carried().at(phi=np.radians(np.linspace(30, 120, 31)))
    phi = motion.strokes["phi"]
    c = np.hypot(0.30, 0.10)
    gamma = phi - np.arctan2(-0.10, 0.30)
    along = c * np.cos(gamma) + np.sqrt(0.36**2 - (c * np.sin(gamma)) ** 2)
    assert_allclose(motion.x("B") * np.cos(phi) + motion.y("B") * np.sin(phi), along, rtol=1e-12)
    assert_allclose(motion.x("B") * np.sin(phi) - motion.y("B") * np.cos(phi), 0.0, atol=1e-15)
    assert_allclose(motion.ratio("B"), motion.ratio("B", method="central"), rtol=1e-8, atol=1e-10)


def test_a_driven_shoe_on_a_moving_body():
    """A telescope: the boom turns with phi, the extension slides out along it by T."""

    class Crane(Mechanism):
        phi, T = Stroke(0.0, 80 * deg), Stroke(0.0, 2.0)
        O = Ground(0.0, 1.0)
        A = Crank(O, OA=3.0, angle=phi)
        boom = Guide(O, A)
        B = OnGuide(boom, at=3.0 + T)

    motion = Crane().sweep(phi=7, T=5)
    r, phi = 3.0 + motion.strokes["T"], motion.strokes["phi"]
    assert_allclose(motion["B"], [r * np.cos(phi), 1.0 + r * np.sin(phi)], rtol=1e-14)
    assert_allclose(motion.ratio("B", wrt="T"), [np.cos(phi), np.sin(phi)], rtol=0, atol=1e-14)
    assert_allclose(motion.ratio("B", wrt="phi"), [-r * np.sin(phi), r * np.cos(phi)], rtol=0, atol=1e-13)


class Excavator(Mechanism):
    """Three strokes: boom, arm and bucket cylinders, all swinging."""

    S1, S2, S3 = Stroke(0.0, 0.8), Stroke(0.0, 0.9), Stroke(0.0, 0.6)
    L1, L2, L3 = Dimension(1.6), Dimension(1.9), Dimension(1.5)
    O, K = Ground(0.0, 1.8), Ground(0.4, 1.2)
    boom_cylinder, boom = Link("K L", KL=L1 + S1), Link("O L B M", OL=2.2, OB=4.8, LOB=10 * deg, OM=2.6, LOM=25 * deg)
    arm_cylinder, arm = Link("M N", MN=L2 + S2), Link("B N T U", BN=0.7, BT=2.4, NBT=-150 * deg, BU=0.8, NBU=-110 * deg)
    bucket_cylinder, bucket = Link("U V", UV=L3 + S3), Link("T V W", TV=0.5, TW=1.2, VTW=100 * deg)
    L, B, M = Pin(near=(2.0, 2.6)), Pin(near=(4.0, 4.0)), Pin(near=(1.8, 3.6))
    N, T, U = Pin(near=(4.2, 4.6)), Pin(near=(3.6, 1.8)), Pin(near=(3.6, 3.4))
    V, W = Pin(near=(3.2, 2.0)), Pin(near=(3.0, 1.0))


def test_three_strokes():
    strokes = dict(S1=0.3, S2=0.4, S3=0.3)
    motion = Excavator().at(**strokes)
    assert Excavator().gruebler == 3
    for P, Q, length in (("K", "L", 1.9), ("M", "N", 2.3), ("U", "V", 1.8), ("B", "T", 2.4), ("T", "W", 1.2)):
        assert_allclose(motion.distance(P, Q), length, rtol=1e-12)
    assert_allclose(motion.ratio("B", wrt="S2"), 0.0, atol=0)
    assert_allclose(motion.ratio("T", wrt="S3"), 0.0, atol=0)
    for name in strokes:
        assert_allclose(motion.ratio("W", wrt=name), motion.ratio("W", wrt=name, method="central"), rtol=1e-9)
        assert_allclose(motion.ratio("W", wrt=name, order=2), motion.ratio("W", wrt=name, order=2, method="central"), rtol=1e-6)


def test_velocities_of_three_strokes_add():
    rates = dict(S1=0.1, S2=-0.2, S3=0.05)
    time = np.array([-1e-3, 0.0, 1e-3])
    motion = Excavator().at(**{name: 0.35 + rate * time for name, rate in rates.items()})
    velocity = motion.velocity("W", rates)[:, 1]
    acceleration = motion.acceleration("W", rates)[:, 1]
    assert_allclose((motion["W"][:, 2] - motion["W"][:, 0]) / 2e-3, velocity, rtol=1e-6)
    assert_allclose((motion["W"][:, 2] - 2 * motion["W"][:, 1] + motion["W"][:, 0]) / 1e-6, acceleration, rtol=1e-4)


def test_a_shoe_whose_rod_does_not_reach():
    class Short(Base):
        B = SliderDyad("A", "rail", AB=0.12, side=RIGHT)

    with pytest.raises(AssemblyError, match="AB does not reach from A to rail") as caught:
        Short().sweep(41)
    phi = Short().sweep(41, unreachable="nan").strokes["phi"]
    away = np.array([0.10 * np.cos(phi) - 0.05, 0.10 * np.sin(phi) + 0.05])
    distance = np.cos(20 * deg) * away[1] - np.sin(20 * deg) * away[0]
    assert caught.value.mask.tolist() == (distance > 0.12).tolist()
    assert caught.value.shortfall == pytest.approx(distance.max() - 0.12, rel=1e-9)


def test_a_point_on_the_coupler_of_a_slider():
    class Coupler(Base):
        rod = Link("A B D", AB=0.30, AD=0.12, BD=0.22)
        shoe = Slide("B", Base.rail)
        B, D = Pin(near=(0.35, 0.05)), Pin(near=(0.12, 0.15))

    motion = Coupler().sweep(31)
    assert type(Coupler.plan.members["D"]) is OnLink
    cos = (0.30**2 + 0.12**2 - 0.22**2) / (2 * 0.30 * 0.12)
    A, B, D = (motion.x(name) + 1j * motion.y(name) for name in "ABD")
    assert_allclose((D - A) / (B - A), 0.12 / 0.30 * np.exp(1j * np.arccos(cos)), rtol=1e-12)
