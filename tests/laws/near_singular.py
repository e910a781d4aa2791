"""Poses built near singular ones: every kind of loop and direction, any size, any distance from the origin, any distance from the pose."""

import numpy as np

from linkage import (
    LEFT,
    RIGHT,
    Crank,
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
    SliderDyad,
    Stroke,
    YokeDyad,
)


class Draft:
    """A random place, size and turn for a machine, and the distance from its singular pose."""

    def __init__(self, rng):
        self.rng = rng
        self.size = 10.0 ** rng.uniform(-9, 6) if rng.random() < 0.5 else 1.0
        away = min(10.0 ** rng.uniform(-2, 6) * self.size, 1e10) if rng.random() < 0.3 else self.size
        self.origin = away * rng.normal(size=2)
        self.turn = rng.uniform(-np.pi, np.pi)
        self.near = 10.0 ** rng.uniform(-15, -1)
        self.side = (LEFT, RIGHT)[rng.integers(2)]

    def length(self, low=0.3, high=1.5):
        """Return a random length [m]."""
        return float(self.size * self.rng.uniform(low, high))

    def place(self, x, y):
        """Return a fixed point, given in a frame of its own [m]."""
        c, s = np.cos(self.turn), np.sin(self.turn)
        return float(self.origin[0] + c * x - s * y), float(self.origin[1] + s * x + c * y)

    def stroke(self):
        """Return a stroke in metres as long as the machine."""
        return Stroke(0.0, self.size)


def dyad(d):
    """A cylinder that comes into line with its lever."""
    base, q = d.length(1.0, 1.5), d.length(0.2, 0.8)
    A, O = d.place(0, 0), d.place(base, 0)
    members = dict(S=d.stroke(), A=Ground(*A), O=Ground(*O), B=Dyad("A", "O", AB="S", OB=q, side=d.side))
    dead = float(np.hypot(O[0] - A[0], O[1] - A[1]))
    return members, dict(S=dead - q + d.near * d.size if d.rng.random() < 0.5 else dead + q - d.near * d.size), "B"


def slider(d):
    """A rod that stands square to its guide."""
    p = d.length()
    members = dict(S=d.stroke(), rail=Guide(d.place(0, 0), angle=d.turn), post=Guide(d.place(0.2 * p, 0), angle=d.turn + np.pi / 2))
    members["P"] = OnGuide("post", at="S")
    members["X"] = SliderDyad("P", "rail", PX=p, side=d.side)
    return members, dict(S=p - d.near * d.size), "X"


def slot(d):
    """A slotted lever whose pin comes near its pivot."""
    r = d.length()
    members = dict(phi=Stroke(0.0, 1.0), M=Ground(*d.place(r, 0)), O=Ground(*d.place(0, 0)))
    members["A"] = Crank("M", MA=r, angle="phi")
    members["X"] = PinSlotDyad("O", "A", OX=d.length(), side=d.side)
    return members, dict(phi=d.turn + np.pi + d.near), "X"


def offset_slot(d):
    """A slot beside its pivot, whose pin comes to the dead point."""
    r, e = d.length(), d.length(0.1, 0.3)
    members = dict(S=d.stroke(), O=Ground(*d.place(0, 0)), rail=Guide(d.place(0, 0), angle=d.turn))
    members["A"] = OnGuide("rail", at="S")
    members["X"] = PinSlotDyad("O", "A", OX=r, offset=e, side=d.side)
    return members, dict(S=e + d.near * d.size), "X"


def on_link(d):
    """A lever along two points that come together."""
    r = d.length()
    members = dict(phi=Stroke(0.0, 1.0), M=Ground(*d.place(r, 0)), O=Ground(*d.place(0, 0)))
    members["A"] = Crank("M", MA=r, angle="phi")
    members["X"] = OnLink("O", "A", OX=d.length(), AOX=float(d.rng.uniform(-3, 3)))
    return members, dict(phi=d.turn + np.pi + d.near), "X"


def guide(d):
    """A guide through two points that come together, with something on it."""
    r = d.length()
    members = dict(phi=Stroke(0.0, 1.0), M=Ground(*d.place(r, 0)), O=Ground(*d.place(0, 0)))
    members["A"] = Crank("M", MA=r, angle="phi")
    members["bar"] = Guide("O", "A")
    kind = d.rng.integers(3)
    if kind == 0:
        members["X"] = OnGuide("bar", at=d.length())
    elif kind == 1:
        members["wall"] = Guide(d.place(0.4 * r, 0.5 * r), angle=d.turn + 0.3)
        members["X"] = GuideCross("bar", "wall")
    else:
        members["P"] = Ground(*d.place(0.3 * r, 0.1 * r))
        members["X"] = SliderDyad("P", "bar", PX=d.length(1.0, 2.0), side=d.side)
    return members, dict(phi=d.turn + np.pi + d.near), "X"


def cross(d):
    """Two guides that become parallel."""
    members = dict(phi=Stroke(-1.0, 1.0), rail=Guide(d.place(0, 0), angle="phi"), wall=Guide(d.place(0, d.length()), angle=d.turn))
    members["X"] = GuideCross("rail", "wall")
    return members, dict(phi=d.turn + d.near), "X"


def yoke(d):
    """A slot that comes into line with its guide."""
    members = dict(phi=Stroke(-1.0, 1.0), P=Ground(*d.place(0, d.length())), rail=Guide(d.place(0, 0), angle=d.turn))
    members["X"] = YokeDyad("P", "rail", angle="phi")
    return members, dict(phi=d.near), "X"


def toggles(d):
    """A toggle that drives a toggle: both near their dead points."""
    base, q = d.length(1.0, 1.5), d.length(0.2, 0.8)
    S = base + q - d.near * d.size
    members = dict(S=d.stroke(), A=Ground(*d.place(0, 0)), O=Ground(*d.place(base, 0)))
    members["B"] = Dyad("A", "O", AB="S", OB=q, side=d.side)
    d.near = 10.0 ** d.rng.uniform(-8, -1)
    x, y = d.length(0.5, 1.5), d.length(0.5, 1.5)
    members["C"] = Ground(*d.place(base + x, y))
    machine = type("Toggle", (Mechanism,), dict(members))
    reach = float(machine().at(S=S, unreachable="nan").distance("B", "C"))
    long = d.rng.uniform(0.3, 0.7) * reach
    other = reach - long + d.near * d.size
    if not np.isfinite(reach):
        return None
    members["D"] = Dyad("B", "C", BD=float(long), CD=float(other), side=d.side)
    return members, dict(S=S), "D"


def rods(d):
    """A plate on three rods, near the pose where their lines meet in a point: found along its stroke."""
    k = d.size
    phi = Stroke(0.0, 0.6)
    members = dict(phi=phi, O=Ground(*d.place(0, 0)), P=Ground(*d.place(3 * k, 0)), Q=Ground(*d.place(1.5 * k, 3 * k)))
    members["A"] = Crank("O", OA=0.5 * k, angle=phi + d.turn)
    members |= dict(plate=Link("D E F", DE=k, DF=0.9 * k, EF=0.8 * k))
    members |= dict(r1=Link("A D", AD=0.8 * k), r2=Link("P E", PE=k), r3=Link("Q F", QF=1.9 * k))
    for name, place in (("D", (1.2, 0.5)), ("E", (2.2, 0.5)), ("F", (1.6, 1.3))):
        members[name] = Pin(near=d.place(k * place[0], k * place[1]))
    machine = type("Plate", (Mechanism,), dict(members))
    last = machine().at(phi=0.3).limits()["phi"].intervals[-1].high
    return members, dict(phi=last - d.near), "DEF"[d.rng.integers(3)]


KINDS = (dyad, slider, slot, offset_slot, on_link, guide, cross, yoke, toggles, rods)


def pose(seed):
    """Return a machine, a pose of it near a singular one as keywords, and the point that hangs on it; None where it cannot be built."""
    rng = np.random.default_rng(seed)
    draft = Draft(rng)
    kind = KINDS[seed % len(KINDS)]
    made = kind(draft)
    if made is None:
        return None
    members, strokes, target = made
    return type(kind.__name__.title().replace("_", ""), (Mechanism,), members), strokes, target, draft
