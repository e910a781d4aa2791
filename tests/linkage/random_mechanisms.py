"""Random mechanisms that assemble: built point by point from a sketch, so that every length is measured."""

import math

import numpy as np

from linkage import LEFT, RIGHT, Crank, Dimension, Dyad, Ground, Mechanism, OnLink, Stroke, angle, distance
from linkage.quantities import ref

NAMES = "BCDEFGHIJKLM"
APART = 0.25  # least distance of two joints of a sketch, m
OPEN = 0.45  # least sine of the angle between two links of a sketch


def far(place, others):
    """Return whether a sketch point stands clear of others."""
    return all(math.dist(place, other) > APART for other in others)


class Sketch:
    """Points placed at random, and the steps that hold them there."""

    def __init__(self, seed):
        self.random = np.random.default_rng(seed)
        self.members = {}
        self.at = {}
        self.bodies = []  # pairs of points at a fixed distance
        self.free = list(NAMES)

    def ground(self, name, x, y):
        self.members[name] = Ground(x, y)
        self.at[name] = (x, y)

    def spot(self):
        return tuple(self.random.uniform(-1.0, 1.0, 2))

    def dyad(self, P, Q, drive=None):
        """Hang a new joint from two points; with `drive` the first length is a cylinder."""
        p, q = self.at[P], self.at[Q]
        for _ in range(1000):
            x = self.spot()
            cross = (q[0] - p[0]) * (x[1] - p[1]) - (q[1] - p[1]) * (x[0] - p[0])
            px, qx = math.dist(p, x), math.dist(q, x)
            if far(x, self.at.values()) and abs((p[0] - x[0]) * (q[1] - x[1]) - (p[1] - x[1]) * (q[0] - x[0])) > OPEN * px * qx:
                break
        else:
            return
        X = self.free.pop(0)
        first = px if drive is None else ref("L" + drive) + ref(drive)
        if drive:
            self.members["L" + drive] = Dimension(px)
        self.members[X] = Dyad(P, Q, side=LEFT if cross > 0 else RIGHT, **{P + X: first, Q + X: qx})
        self.at[X] = x
        self.bodies += [(Q, X)] if drive else [(P, X), (Q, X)]

    def on_link(self, P, Q):
        """Fix a new point to a body, in one of the four ways."""
        X, p, q = self.free.pop(0), self.at[P], self.at[Q]
        reach, turn = self.random.uniform(0.3, 0.8), self.random.uniform(0.4, 2.5)
        side = LEFT if self.random.random() < 0.5 else RIGHT
        way = self.random.integers(4)
        turn = 0.0 if way == 0 else turn * (1.0 if way == 1 else side)
        base = math.atan2(q[1] - p[1], q[0] - p[0]) + turn
        self.at[X] = (p[0] + reach * math.cos(base), p[1] + reach * math.sin(base))
        if way == 3:
            given, side_given = {Q + X: math.dist(q, self.at[X])}, {"side": side}
        elif way:
            given, side_given = {Q + P + X: abs(turn)}, ({"side": side} if way == 2 else {})
        else:
            given, side_given = {}, {}
        self.members[X] = OnLink(P, Q, **{P + X: reach}, **given, **side_given)
        self.bodies += [(P, X)]


def random_mechanism(seed, strokes=1, joints=6):
    """Return a mechanism class with some strokes and up to `joints` points that move (two links a dyad)."""
    sketch = Sketch(seed)
    for name in "AOPQ":
        place = sketch.spot()
        while not far(place, sketch.at.values()):
            place = sketch.spot()
        sketch.ground(name, *place)
    drives = ["S", "T", "U"][:strokes]
    for number, drive in enumerate(drives):
        sketch.members[drive] = Stroke(-0.03, 0.03)
        if sketch.random.random() < 0.3:
            P, X = "AOPQ"[number], sketch.free.pop(0)
            turn = sketch.random.uniform(-3.0, 3.0)
            sketch.at[X] = tuple(np.add(sketch.at[P], (0.4 * math.cos(turn), 0.4 * math.sin(turn))))
            sketch.members[X] = Crank(P, angle=ref(drive) + turn, **{P + X: 0.4})
            sketch.bodies.append((P, X))
        else:
            sketch.dyad(*sketch.random.choice(list("AOPQ"), 2, replace=False), drive=drive)
    while len(sketch.at) < 4 + joints and len(sketch.free) > 1:
        moving = [name for name in sketch.at if name not in "AOPQ"]
        if not moving:
            break
        first = sketch.random.choice(moving)
        if sketch.random.random() < 0.4:
            sketch.on_link(*sketch.bodies[sketch.random.integers(len(sketch.bodies))])
        else:
            sketch.dyad(first, sketch.random.choice([name for name in sketch.at if name != first]))
    last = list(sketch.at)[-1]
    sketch.members["u"] = angle("A", last) + distance("O", last)
    return kept(seed, sketch.members, drives)


def kept(seed, members, drives):
    """Return the class with its strokes halved until it can be driven everywhere, well away from dead points."""
    for halvings in range(12):
        span = 0.03 / 2**halvings
        shown = {name: Stroke(-span, span) if name in drives else member for name, member in members.items()}
        made = type(f"Random{seed}", (Mechanism,), {**shown, "__doc__": "A random mechanism."})
        motion = made().sweep(**dict.fromkeys(drives, 5), unreachable="nan")
        with np.errstate(invalid="ignore"):
            sines = made.plan.read(motion.inputs).sines
        if motion.reached.all() and all(np.all(np.abs(sine) > 0.2) for name, sine in sines.items() if isinstance(members[name], Dyad)):
            break
    return made
