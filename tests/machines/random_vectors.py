"""Machines of random vectors, turns, corners and offsets, each with its composite spelling, drawn by a seed."""

from cmath import phase, rect
from math import pi

import numpy as np

from linkage import (
    LEFT,
    RIGHT,
    CosineAngle,
    Crank,
    Dyad,
    Ground,
    Mechanism,
    Offset,
    OnLink,
    Stroke,
    Turn,
    Vector,
    Weight,
    angle,
    distance,
    ref,
)


class Drawing:
    """A machine that grows by one point after the other; both spellings, and where the points are at the start."""

    def __init__(self, seed):
        self.rng = np.random.default_rng(seed)
        self.at = {"O": 0j, "X": 1 + 0j}
        self.vectors = {"O": Ground(0.0, 0.0), "X": Ground(1.0, 0.0)}
        self.steps = dict(self.vectors)
        self.bodies = [["O", "X"]]
        self.strokes = 0

    def stroke(self, size):
        name = f"S{self.strokes}"
        self.strokes += 1
        self.vectors[name], self.steps[name] = Stroke(0.0, size), Stroke(0.0, size)
        return ref(name)

    def either(self, *choices):
        return choices[self.rng.integers(len(choices))]

    def enter(self, X, place, vector, step):
        self.at[X], self.vectors[X], self.steps[X] = place, vector, step

    def base(self, P, Q):
        """Return the vector PQ in one of its spellings, and the number to add to an angle from it."""
        if self.rng.random() < 0.25:
            return Vector(Q, P), pi
        turn = self.rng.uniform(-1.0, 1.0)
        return (Turn(Vector(P, Q), turn), -turn) if self.rng.random() < 0.25 else (Vector(P, Q), 0.0)

    def crank(self, X):
        P, Q = self.rng.permutation(self.either(*self.bodies))[:2].tolist()
        r, first = self.rng.uniform(0.3, 0.8), self.rng.uniform(-3.0, 3.0)
        psi = self.stroke(0.05)
        base, more = self.base(P, Q)
        way = angle(P, Q) + (first + psi)
        place = self.at[P] + rect(r, phase(self.at[Q] - self.at[P]) + first)
        self.enter(X, place, Offset(P, Turn(base, psi + (more + first), length=r)), Crank(P, **{P + X: r}, angle=way))
        self.bodies.append([P, X])

    def on_body(self, X):
        body = self.either(*self.bodies)
        P, Q = self.rng.permutation(body)[:2].tolist()
        r, turn = self.rng.uniform(0.2, 0.9), self.rng.uniform(-3.0, 3.0)
        base, more = self.base(P, Q)
        place = self.at[P] + rect(r, phase(self.at[Q] - self.at[P]) + turn)
        self.enter(X, place, Offset(P, Turn(base, turn + more, length=r)), OnLink(P, Q, **{P + X: r, Q + P + X: turn}))
        body.append(X)

    def dyad(self, X):
        if not self.pairs():
            self.on_body(X)
            return
        P, Q = self.either(*self.pairs())
        place = 0.5 * (self.at[P] + self.at[Q]) + rect(self.rng.uniform(0.5, 0.8), self.rng.uniform(-3.0, 3.0))
        p, q = abs(place - self.at[P]), abs(place - self.at[Q])
        left = ((self.at[Q] - self.at[P]).conjugate() * (place - self.at[P])).imag > 0.0
        driven = self.rng.random() < 0.4 and self.strokes < 3
        near = self.stroke(0.01) + p if driven else p
        base, more = self.base(P, Q)
        long = self.either(abs(Vector(P, Q)), distance(P, Q), distance(Q, P))
        corner = CosineAngle(long, near, q) if self.rng.random() < 0.5 else CosineAngle(near, long, q)
        by = corner if left else -corner
        step = Dyad(P, Q, **{P + X: near, Q + X: q}, side=LEFT if left else RIGHT)
        self.enter(X, place, Offset(P, Turn(base, by + more if more else by, length=near)), step)
        self.bodies += [[Q, X]] if driven else [[P, X], [Q, X]]

    def pairs(self):
        """Return pairs of points that no body holds both, apart enough for a triangle that is not flat."""
        names = list(self.at)
        pairs = [(P, Q) for P in names for Q in names if P != Q and not any({P, Q} <= set(body) for body in self.bodies)]
        return [(P, Q) for P, Q in pairs if 0.3 < abs(self.at[P] - self.at[Q]) < 2.5]


def machines(seed, points=6):
    """Return both spellings of a machine with at least one stroke: (vectors, steps)."""
    made = Drawing(seed)
    made.crank("A")
    for X in "BCDEFGHIJ"[: points - 1]:
        made.either(made.on_body, made.dyad, made.dyad, made.crank if made.strokes < 3 else made.on_body)(X)
    loads = {f"load{X}": Weight(X, mass=10.0) for X in list(made.at)[-1:]}
    name = f"Random{seed}"
    other = {name: load.renewed() for name, load in loads.items()}
    return type(name, (Mechanism,), made.vectors | loads), type(name, (Mechanism,), made.steps | other)

