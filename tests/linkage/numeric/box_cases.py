"""Functions of the unit box for tests of the search in it: seeded, with a top whose place or height is known."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from linkage.numeric.box import SIDES
from linkage.program import FloatArray

Of = Callable[[FloatArray], FloatArray]
WIDTH = {1: 1.0 / 4096.0, 2: 1.0 / 128.0, 3: 1.0 / 32.0}


@dataclass(frozen=True)
class Case:
    """A function of places (..., k), its highest value, the range of its values, and how near the answer has to come, of the range."""

    kind: str
    f: Of
    top: float
    span: float
    close: float


class InUnitBox:
    """Functions (K) of the unit box as the search sees them; `count` is how many poses it asked."""

    def __init__(self, k: int, *functions: Of) -> None:
        self.k, self.side, self.functions = k, SIDES[k], functions
        self.grid = np.stack(np.meshgrid(*[np.linspace(0.0, 1.0, self.side)] * k, indexing="ij"), axis=-1)
        self.seen = np.array([f(self.grid) for f in functions]).reshape(len(functions), 1, -1)
        self.count, self.kept = self.side**k, np.ones(self.seen.shape[1:], bool)

    def one_function(self, function, design, places):
        return self.at(design, places)[0][function]

    def is_kept(self, design, places):
        self.count += places[..., 0].size
        return np.ones(places.shape[:-1], bool)

    def at(self, design, places):
        self.count += places[..., 0].size
        return np.array([f(places) for f in self.functions]), np.ones(places.shape[:-1], bool)


def waves(rng: np.random.Generator, k: int, most: float) -> Of:
    """Return a sum of waves, between -1 and 1, of at most so many turns over each stroke."""
    count = int(rng.integers(1, 6))
    turns, phase = rng.uniform(-most, most, (count, k)), rng.uniform(0.0, 2.0 * np.pi, count)
    size = rng.uniform(0.1, 1.0, count)
    return lambda x: np.sin(2.0 * np.pi * (x @ turns.T) + phase) @ size / size.sum()


def place(rng: np.random.Generator, k: int) -> FloatArray:
    """Return a place in the box, now and then with strokes on its border."""
    return np.where(rng.uniform(size=k) < 0.25, rng.integers(0, 2, k), rng.uniform(size=k))


def around(rng: np.random.Generator, k: int, width: float) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return a box (low, high) of a width, in the unit box, and a place in it: now and then on its border or in a corner."""
    low = np.where(rng.uniform(size=k) < 0.2, rng.integers(0, 2, k) * (1.0 - width), rng.uniform(0.0, 1.0 - width, k))
    inner = np.where(rng.uniform(size=k) < 0.15, rng.integers(0, 2, k), rng.uniform(0.0, 1.0, k))
    return low, low + width, low + width * inner


def stretched(rng: np.random.Generator, x: FloatArray, low: FloatArray, high: FloatArray, top: FloatArray, norm: float) -> FloatArray:
    """Return the distance of places from a top, 1 on the corners of the box about it and further out: a norm, skewed to both sides."""
    scale = np.where(x < top, np.maximum(top - low, 1e-3 * (high - low)), np.maximum(high - top, 1e-3 * (high - low)))
    away = np.abs(x - top) / scale
    return away.max(axis=-1) if np.isinf(norm) else ((away**norm).mean(axis=-1)) ** (1.0 / norm)


def bump(rng: np.random.Generator, k: int) -> Case:
    """Return a bump on a ground of waves: flat, smooth, a cone, a cusp, or a pyramid; it is higher than all else in a box."""
    width, ground = WIDTH[k], waves(rng, k, 2.0)
    low, high, top = around(rng, k, width)
    kind = str(rng.choice(["flat", "round", "cone", "cusp", "skew", "bell"]))
    share = float(rng.uniform(0.0, 0.2))
    if kind in ("skew", "cusp"):
        norm = float(rng.choice([1.0, 2.0, np.inf]))
        away = lambda x: stretched(rng, x, low, high, top, norm)  # noqa: E731
    else:
        norm = float(rng.choice([2.0, np.inf])) if kind == "cone" else 2.0
        middle = 0.5 * (low + high)
        top = middle
        away = lambda x: (  # noqa: E731
            np.abs(x - middle).max(axis=-1) if np.isinf(norm) else np.sqrt(((x - middle) ** 2).mean(axis=-1))
        ) / (0.5 * width)
    shape = {
        "flat": lambda d: np.where(d <= 1.0 + 1e-9, 1.0, 0.0),
        "round": lambda d: np.maximum(0.0, 1.0 - d * d * (1.0 - 0.3)),
        "bell": lambda d: np.exp(-d * d),
        "cone": lambda d: np.maximum(0.0, 1.0 - 0.7 * d),
        "cusp": lambda d: np.maximum(0.0, 1.0 - 0.7 * np.sqrt(d)),
        "skew": lambda d: np.maximum(0.0, 1.0 - 0.7 * d),
    }[kind]
    floor = {"bell": 0.2}.get(kind, 0.15)  # what the bump still has on the corners of the box is more than the ground's range

    def f(x: FloatArray) -> FloatArray:
        return shape(away(x)) + floor * share * (ground(x) - 1.0)

    best = float(shape(np.zeros(()))) + 0.0
    close = 1e-3
    return Case(f"bump {kind}", lambda x: f(x) - floor * share * (ground(top) - 1.0), best, 1.0, close)


def smooth(rng: np.random.Generator, k: int) -> Case:
    """Return a bell or a paraboloid that is skewed across the strokes, alone: its top is right to 1e-9."""
    top = place(rng, k)
    turn = np.linalg.qr(rng.normal(size=(k, k)))[0]
    sizes = np.exp(rng.uniform(np.log(1.0), np.log(20.0), k))
    matrix = turn @ np.diag(sizes) @ turn.T
    if rng.uniform() < 0.5:
        f = lambda x: np.exp(-np.einsum("...i,ij,...j", x - top, matrix, x - top))  # noqa: E731
        return Case("bell", f, 1.0, 1.0, 1e-9)
    f = lambda x: -np.einsum("...i,ij,...j", x - top, matrix, x - top)  # noqa: E731
    return Case("paraboloid", f, 0.0, 1.0, 1e-9)


def ridge(rng: np.random.Generator, k: int) -> Case:
    """Return a roof oblique to the strokes: as steep across it as along it slow, with its top at a known place."""
    top = place(rng, k)
    turn = np.linalg.qr(rng.normal(size=(k, k)))[0]
    slopes = np.exp(rng.uniform(np.log(0.3), np.log(30.0), k))
    norm = rng.choice([1.0, np.inf])

    def f(x: FloatArray) -> FloatArray:
        away = np.abs((x - top) @ turn) * slopes
        return -(away.sum(axis=-1) if norm == 1.0 else away.max(axis=-1))

    corners = np.stack(np.meshgrid(*[[0.0, 1.0]] * k, indexing="ij"), axis=-1)
    return Case("ridge", f, 0.0, float(-f(corners).min()), 1e-3)


def missing(rng: np.random.Generator, k: int) -> Case:
    """Return a plane or a paraboloid that has a value on one side of a ball or a plane only: the top on that border is known."""
    slope = rng.normal(size=k)
    slope /= np.linalg.norm(slope)
    middle, radius = rng.uniform(0.3, 0.7, k), float(rng.uniform(0.15, 0.3))
    top = middle + radius * slope

    def f(x: FloatArray) -> FloatArray:
        inside = ((x - middle) ** 2).sum(axis=-1) <= radius**2
        return np.where(inside, (x - middle) @ slope, np.nan)

    assert np.all((top >= 0.0) & (top <= 1.0))
    return Case("missing", f, radius, 2.0 * radius, 1e-6)


def dead_point(rng: np.random.Generator, k: int) -> Case:
    """Return a root that ends in a point on a border that is curved: as steep there as places at a dead point."""
    slope = rng.normal(size=k)
    slope /= np.linalg.norm(slope)
    middle, radius = rng.uniform(0.3, 0.7, k), float(rng.uniform(0.15, 0.3))

    def f(x: FloatArray) -> FloatArray:
        under = radius**2 - ((x - middle) ** 2).sum(axis=-1)
        return np.where(under >= 0.0, (x - middle) @ slope - np.sqrt(np.maximum(under, 0.0)), np.nan)

    return Case("dead point", f, radius, 2.5 * radius, 1e-6)


KINDS = (bump, bump, smooth, ridge, missing, dead_point)


def case(seed: int, k: int) -> Case:
    """Return one of all kinds."""
    rng = np.random.default_rng([seed, k])
    return KINDS[int(rng.integers(len(KINDS)))](rng, k)
