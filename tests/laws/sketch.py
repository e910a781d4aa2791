"""A sketch that grows into a machine: where its points are, which of them are rigid with each other, what must stay open."""

import math
import re

import numpy as np

from linkage import Ground, Mechanism, drawn
from tests.laws.plane import PLAIN, minus, size

APART = 0.25  # least distance of two points of a sketch, m
OPEN = 0.55  # least sine in the sketch of what a step closes
LEAST = math.sin(math.radians(20.0))  # least sine over the strokes
FREE = [*"BCDEFGHIJMN", *(f"{letter}1" for letter in "BCDEFGHIJMN")]
FIXED = ["A", "O", "P", "Q", *(f"K{k}" for k in range(12))]


class DeadEndError(Exception):
    """This draft cannot be finished; another is drawn."""


class Sketch:
    """A machine that grows in a sketch, where all strokes are 0: its parts, its bodies, its loads."""

    def __init__(self, seed, attempt=0):
        self.seed = seed
        self.random = np.random.default_rng([9, seed, attempt])
        self.parts, self.at = {}, {}
        self.rigid, self.links, self.rails = [], {}, {}
        self.quality, self.spans, self.factor = [], {}, 1.0
        self.loads, self.elements, self.frictions = {}, {}, {}
        self.holders, self.swaps, self.own = [], [], {}
        self.runs, self.arms = [], {}
        self.tags = set()
        self.free, self.ground = list(FREE), list(FIXED)

    def chance(self, share):
        return bool(self.random.random() < share)

    def some(self, given):
        return given[int(self.random.integers(len(given)))]

    def uniform(self, low, high):
        return float(self.random.uniform(low, high))

    # -- places --------------------------------------------------------------------------------------------

    def spot(self, good=lambda place: True):
        """Return a place clear of all points that is good for something; the sheet grows where it is full."""
        for tries in range(600):
            wide = 0.9 + tries / 300
            place = np.array([self.uniform(-wide, wide), self.uniform(-wide, wide)])
            if self.clear(place) and good(place):
                return place
        raise DeadEndError

    def clear(self, place):
        return all(size(minus(place, other)) > APART for other in self.at.values())

    def fix(self, place=None):
        """Return a new point of the frame."""
        name = self.ground.pop(0)
        self.at[name] = place = self.spot() if place is None else np.asarray(place)
        self.parts[name] = lambda to: Ground(*to.place(place))
        return name

    def new(self, place):
        """Return the name of a new moving point."""
        if not self.free:
            raise DeadEndError
        name = self.free.pop(0)
        self.at[name] = np.asarray(place, float)
        return name

    def apart(self, P, Q):
        return float(size(self.at[P] - self.at[Q]))

    def watch(self, measure):
        """Keep a sine that must stay well away from zero."""
        self.quality.append(measure)

    # -- bodies --------------------------------------------------------------------------------------------

    def is_fixed(self, name):
        return name in FIXED

    @property
    def moving(self):
        return [name for name in self.at if not self.is_fixed(name)]

    def bodies(self):
        """Return the moving rigid bodies of this draft: sets of points; those that share two are one."""
        found = []
        for group in self.rigid:
            body = set(group)
            while (other := next((each for each in found if len(each & body) > 1), None)) is not None:
                found.remove(other)
                body |= other
            found.append(body)
        return [body for body in found if sum(map(self.is_fixed, body)) < 2]

    def together(self, P, Q):
        """Return whether two points are rigid with each other."""
        return (self.is_fixed(P) and self.is_fixed(Q)) or any({P, Q} <= body for body in self.bodies())

    def pick(self, number, *, apart=True):
        """Return some points, the first of them one that moves, no two of one body."""
        for _ in range(100):
            first = self.some(self.moving)
            others = [name for name in self.at if name != first]
            found = [first, *(str(each) for each in self.random.choice(others, number - 1, replace=False))]
            pairs = [(P, Q) for k, P in enumerate(found) for Q in found[k + 1 :]]
            if not apart or not any(self.together(P, Q) for P, Q in pairs):
                return found
        raise DeadEndError

    def pair(self):
        """Return two points of a body that moves."""
        found = [(P, Q) for body in self.bodies() for P in sorted(body) for Q in sorted(body) if P != Q and self.apart(P, Q) > 0.2]
        if not found:
            raise DeadEndError
        return self.some(found)

    # -- the class -----------------------------------------------------------------------------------------

    def machine(self, to=PLAIN, name="Drawn", **other):
        """Return the machine's class, moved, with other parts in the place of some (None: without it)."""
        members = {each: make(to) for each, make in self.parts.items() if each not in other}
        members |= {each: member for each, member in other.items() if member is not None}
        members["sketch"] = members.get("sketch") or drawn(**dict.fromkeys(self.spans, 0.0))
        order = [*self.parts, "sketch"]
        np.random.default_rng([9, self.seed]).shuffle(order)
        order += [each for each in members if each not in order]
        return type(f"{name}{self.seed}", (Mechanism,), {each: members[each] for each in order if each in members})

    def strokes(self, number=6):
        """Return strokes of one shape all over the ranges, by name: a path where there are several."""
        random, found = np.random.default_rng([90, self.seed]), {}
        for name, span in self.spans.items():
            values = np.linspace(-span, span, number) * self.factor
            found[name] = values if not found else random.permutation(values)
        return found

    def is_open(self):
        """Return whether everything stays well away from dead points over the strokes."""
        grids = np.meshgrid(*(span * self.factor * np.linspace(-1.0, 1.0, 5) for span in self.spans.values()))
        self.drawn = self.machine()
        motion = self.drawn().at(**{name: grid.ravel() for name, grid in zip(self.spans, grids, strict=True)}, unreachable="nan")
        at = {name: motion[name] for name in self.at}
        return bool(motion.reached.all()) and all(np.min(np.abs(measure(at))) > LEAST for measure in self.quality)


def points_of(name):
    """Return the points in a body's name: `OBC1` is O, B, C1."""
    return set(re.findall(r"[A-Z]\d*", name))
