"""Random sweeps whose margin is known exactly: how much a loop has left where it comes nearest to its dead point, as a fraction."""

from dataclasses import dataclass
from fractions import Fraction
from math import pi

import numpy as np

from linkage import (
    LEFT,
    RIGHT,
    Crank,
    Dimension,
    Dyad,
    Ground,
    Guide,
    GuideCross,
    Mechanism,
    OnGuide,
    OnLink,
    PinSlotDyad,
    SliderDyad,
    Stroke,
)

COUNTS = (2, 3, 5, 36, 101)


@dataclass
class Sweep:
    """A machine with its stroke; where on it, of its length, the loop `step` comes nearest to its dead point; what it has left there."""

    machine: Mechanism
    values: np.ndarray
    step: str
    place: float
    margin: float
    """What is left at that place, of the loop's size, from fractions: negative in a gap, 0 at a change point."""
    width: float
    """The width of the gap, of the stroke; 0 where there is none."""


class FourBar(Mechanism):
    """A crank and a rocker; the coupler's point T hangs on them."""

    phi = Stroke(0.0, 2 * pi)
    O, C = Ground(0.0, 0.0), Ground(4.0, 0.0)
    A = Crank(O, OA=1.0, angle=phi)
    B = Dyad(A, C, AB=3.0, CB=2.5, side=LEFT)
    T = OnLink(A, B, AT=0.5, BAT=0.7)


class SliderCrank(Mechanism):
    """A crank and a slider on a rail beside its centre."""

    phi = Stroke(0.0, 2 * pi)
    O, rail = Ground(0.0, 0.0), Guide((0.0, 0.0), angle=0.0)
    A = Crank(O, OA=1.0, angle=phi)
    B = SliderDyad(A, rail, AB=3.0, side=RIGHT)


class Trolley(Mechanism):
    """A dyad between a trolley and a fixed point above its rail."""

    S = Stroke(-1.0, 1.0)
    floor, Q = Guide((0.0, 0.0), angle=0.0), Ground(0.0, 1.0)
    P = OnGuide(floor, at=S)
    B = Dyad(P, Q, PB=1.5, QB=1.0, side=LEFT)


class Slotted(Mechanism):
    """A slot beside a trolley that glides over a fixed pin."""

    S = Stroke(-1.0, 1.0)
    floor, Q = Guide((0.0, 0.0), angle=0.0), Ground(0.0, 1.0)
    e = Dimension(0.5)
    P = OnGuide(floor, at=S)
    X = PinSlotDyad(P, Q, PX=0.5, offset=e)


class Ram(Mechanism):
    """A cylinder that comes out and goes in again."""

    phi = Stroke(0.0, 2 * pi)
    A, O = Ground(0.0, 0.0), Ground(2.0, 0.0)
    L0 = Dimension(1.0)
    B = Dyad(A, O, AB=L0 + 0.25 * np.cos(phi), OB=1.5, side=LEFT)


class Crossed(Mechanism):
    """Two rails, one of them turning: parallel at one angle."""

    S = Stroke(-1.0, 1.0)
    low, high = Guide((0.0, 1.0), angle=0.0), Guide((0.25, 0.0), angle=S)
    X = GuideCross(low, high)


def dyadic(rng, low, high):
    """Return a random number with few binary digits, so that sums of such are exact."""
    return float(rng.integers(int(low * 1024), int(high * 1024)) / 1024)


def total(*parts):
    """Return the exact sum of floats."""
    return sum(map(Fraction, parts))


def ends(rng, centre, reach, width):
    """Return the ends of a stroke around a place, which lies anywhere in it, also next to an end; its place is a share of the stroke."""
    span = reach * rng.uniform(0.3, 1.0)
    edge = float(rng.choice([0.5, 10.0 ** rng.uniform(-4.0, -0.4)]))
    share = max(min(edge, 0.5), 3.0 * width) * rng.uniform(0.5, 1.0)
    share = share if rng.random() < 0.5 else 1.0 - share
    return centre - share * span, centre + (1.0 - share) * span, share


def sweep(rng, width):
    """Return a random sweep with a gap of some width of the stroke; 0 for a change point, negative for a clearance so large instead."""
    return KINDS[int(rng.integers(len(KINDS)))](rng, width)


def values_of(rng, low, high):
    """Return strokes from one end to the other: evenly, or not; from the greater on as well."""
    count = int(rng.choice(COUNTS))
    values = np.linspace(low, high, count)
    if count > 2 and rng.random() < 0.3:
        values[1:-1] = np.sort(rng.uniform(low, high, count - 2))
    return values[::-1] if rng.random() < 0.3 else values


def bent(rng, width, span, curve, size):
    """Return by how much a loop is to be short: a gap of a width of the stroke where its side bends by `curve` [m per stroke^2]."""
    if width < 0.0:
        return width * size
    return 0.5 * curve * (0.5 * width * span) ** 2


def four_bar(rng, width):
    a, g = dyadic(rng, 0.5, 1.5), dyadic(rng, 2.0, 4.0)
    b = dyadic(rng, 1.2, g)
    low, high, share = ends(rng, pi, 2.4, max(width, 0.0))
    outer = rng.random() < 0.5  # stretched at pi, or folded at 0
    if outer:
        c = g + a - b - bent(rng, width, high - low, a * g / (g + a), g)
        margin = total(b, c, -g, -a)
    else:
        low, high = low - pi, high - pi
        b = max(b, a)  # so that it reaches stretched wherever the crank stands
        c = b + (g - a) + bent(rng, width, high - low, a * g / (g - a), g)
        margin = total(g, -a, b, -c)
    values = values_of(rng, low, high)
    return Sweep(FourBar(OA=a, C=(g, 0.0), AB=b, CB=c), values, "B", share, float(margin / Fraction(g)), max(width, 0.0))


def slider_crank(rng, width):
    a, e = dyadic(rng, 0.5, 1.5), dyadic(rng, 0.125, 0.5)
    low, high, share = ends(rng, -0.5 * pi, 2.4, max(width, 0.0))
    b = a + e - bent(rng, width, high - low, a, a + e)
    machine = SliderCrank(OA=a, AB=b, **{"rail.y": e})
    return Sweep(machine, values_of(rng, low, high), "B", share, float(total(b, -a, -e) / total(a, e)), max(width, 0.0))


def trolley(rng, width):
    h, q = dyadic(rng, 0.5, 1.5), dyadic(rng, 0.75, 1.5)
    low, high, share = ends(rng, 0.0, 0.9 * h, max(width, 0.0))
    p = q + h + bent(rng, width, high - low, 1.0 / h, h)
    machine = Trolley(Q=(0.0, h), PB=p, QB=q)
    return Sweep(machine, values_of(rng, low, high), "B", share, float(total(h, q, -p) / Fraction(h)), max(width, 0.0))


def slotted(rng, width):
    h = dyadic(rng, 0.5, 1.5)
    low, high, share = ends(rng, 0.0, 0.9 * h, max(width, 0.0))
    e = h + bent(rng, width, high - low, 1.0 / h, h)
    return Sweep(Slotted(Q=(0.0, h), e=e), values_of(rng, low, high), "X", share, float(total(h, -e) / Fraction(h)), max(width, 0.0))


def ram(rng, width):
    o, r = dyadic(rng, 1.5, 2.5), dyadic(rng, 0.75, 1.25)
    low, high, share = ends(rng, 0.0, 2.4, max(width, 0.0))
    length = o + r - 0.25 + bent(rng, width, high - low, 0.25, o)
    machine = Ram(O=(o, 0.0), OB=r, L0=length)
    return Sweep(machine, values_of(rng, low, high), "B", share, float(total(o, r, -0.25, -length) / Fraction(o)), max(width, 0.0))


KINDS = (four_bar, slider_crank, trolley, slotted, ram)


def parallel(rng):
    """Return a sweep over which two guides come parallel."""
    low, high, share = ends(rng, 0.0, 1.2, 1e-6)
    return Sweep(Crossed(), values_of(rng, low, high), "X", share, 0.0, 0.0)

