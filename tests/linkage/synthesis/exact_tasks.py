"""Four-bars at random and their places by two circles of their own, for the tests of exact methods."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class RandomBar:
    """A four-bar on 0 and 1: its lengths, the side of its follower, and where its coupler's point is, in complex numbers."""

    a: float
    b: float
    c: float
    side: int
    point: complex

    @classmethod
    def of(cls, random):
        """Return one at random."""
        a, b, c = random.uniform(0.3, 2.0, 3)
        return cls(a, b, c, int(random.choice([-1, 1])), complex(*random.normal(size=2)))

    def places(self, phi):
        """Return A, B and the coupler's point at angles of the crank, NaN where the circles miss."""
        A = self.a * np.exp(1j * np.asarray(phi))
        way = 1.0 - A
        with np.errstate(invalid="ignore"):
            turned = np.arccos((self.b**2 + abs(way) ** 2 - self.c**2) / (2.0 * self.b * abs(way)))
        B = A + self.b * way / abs(way) * np.exp(1j * self.side * turned)
        return A, B, A + self.point * (B - A)


def bar_at(seed, count, width=2 * np.pi):
    """Return a bar and angles of its crank, in order, at which it is well assembled: less than 0.99 for the cosine at B."""
    random = np.random.default_rng(seed)
    while True:
        bar = RandomBar.of(random)
        phi = np.sort(random.uniform(0.0, width, count)) + random.uniform(0.0, 6.0)
        A, B, _ = bar.places(phi)
        if np.isfinite(B).all() and (abs(np.cos(np.angle((B - A) / (B - 1.0)))) < 0.99).all():
            return bar, phi


def as_rows(places):
    """Return complex places (n,) as rows (n, 2)."""
    return np.stack([places.real, places.imag], axis=1)


def lengths(machine):
    """Return the lengths of crank, coupler and follower of a machine of the shipped class [m]."""
    return [float(machine[name]) for name in ("OA", "AB", "CB")]
