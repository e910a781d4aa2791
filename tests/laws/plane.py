"""The plane of random machines: how it may be moved, and what is drawn in it, in plain numbers."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from linkage import LEFT, RIGHT

G0 = 9.80665  # m/s2

# -- the plane ---------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Move:
    """A change of the plane: seen in a mirror at the y axis, then turned [rad], then with all lengths `scale` times as large.

    Where `case` says so, gravity turns in a load case and not in each weight.
    """

    mirror: bool = False
    turn: float = 0.0
    scale: float = 1.0
    case: bool = False

    @property
    def sense(self):
        """What counter-clockwise becomes."""
        return -1.0 if self.mirror else 1.0

    def vector(self, vector):
        """Return a direction or a force of the same size, shape as given."""
        x, y = self.sense * vector[0], vector[1]
        cos, sin = math.cos(self.turn), math.sin(self.turn)
        return x * cos - y * sin, x * sin + y * cos

    @property
    def gravity(self):
        """Where down is, for each weight."""
        return {} if self.case or self.turn == 0.0 else {"gravity": self.vector((0.0, -G0))}

    def place(self, place):
        return tuple(self.scale * float(part) for part in self.vector(place))

    def length(self, value):
        return self.scale * float(value)

    def angle(self, value):
        """Return a direction against the x axis [rad], a number or a quantity."""
        turned = (math.pi - value if self.mirror else value) + self.turn
        return math.remainder(turned, 2.0 * math.pi) if isinstance(turned, float) else turned

    def side(self, side):
        return (RIGHT if side is LEFT else LEFT) if self.mirror else side


PLAIN = Move()


def cross(u, v):
    return u[0] * v[1] - u[1] * v[0]


def minus(p, q):
    return np.asarray(p) - np.asarray(q)


def size(u):
    return np.hypot(u[0], u[1])


def sine(u, v):
    """Return the sine of the angle from one vector to another."""
    return cross(u, v) / (size(u) * size(v))


def polar(place, reach, turn):
    return place[0] + reach * math.cos(turn), place[1] + reach * math.sin(turn)


def facing(u):
    return math.atan2(u[1], u[0])


def turned(u, turn):
    """Return a vector turned by an angle [rad]."""
    cos, sin = math.cos(turn), math.sin(turn)
    return np.stack([u[0] * cos - u[1] * sin, u[0] * sin + u[1] * cos])


def triad_sense(corners, rods):
    """Return the determinant of three rods' unit wrenches on their link: 0 where their lines meet in a point."""
    middle = sum(corners) / 3.0
    reach = np.max([size(corner - middle) for corner in corners], axis=0)
    rows = [[*(rod / size(rod)), cross(corner - middle, rod / size(rod)) / reach] for corner, rod in zip(corners, rods, strict=True)]
    (a, b, c), (d, e, f), (g, h, i) = rows
    return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)


# -- what acts, in plain numbers ---------------------------------------------------------------------------


@dataclass(frozen=True)
class Act:
    """A force [N], shape (2, n), with a couple [Nm] at a place [m]; on the body of the two points `on`, else on the carrier of `point`."""

    point: str
    force: np.ndarray
    place: np.ndarray
    on: tuple[str, ...] = ()
    couple: float = 0.0


@dataclass(frozen=True)
class External:
    """A load from outside: `acts(at)` from the points' places, `energy(at)` its potential [J]."""

    acts: Callable
    energy: Callable


@dataclass(frozen=True)
class Element:
    """A straight two-point element: thrust(length, rate) [N], positive where it pushes its ends apart; its potential [J] by length."""

    A: str
    B: str
    thrust: Callable
    energy: Callable
    losses: float = 0.0  # N, of its seals


@dataclass(frozen=True)
class Run:
    """A point that runs on a line: its direction from the points' places, a point of it, two that it turns with (none: the frame)."""

    point: str
    direction: Callable
    origin: str = ""
    pair: tuple[str, ...] = ()
    driven: bool = False
    block: str = ""  # the body that carries the line, where it is a block of its own


@dataclass(frozen=True)
class Holder:
    """A cylinder that holds a stroke; `member` is its Cylinder in the class, "" where only a step declares it."""

    stroke: str
    A: str
    B: str
    member: str = ""
    area: float = 0.0  # m2, negative where it pulls; only with others on its line

    @property
    def name(self):
        return self.member or self.A + self.B


@dataclass(frozen=True)
class Swap:
    """A cylinder that may become a crank: X on the arm OX."""

    stroke: str
    A: str
    O: str
    X: str
    lift: str = ""
