"""What is known of a random machine without the package: its bodies, what acts on them, how they turn and slide.

The places and ratios of points are taken from the motion; every force beside those of the joints comes from the draft's own numbers.
"""

from collections import defaultdict

import numpy as np

from tests.laws.plane import cross, size
from tests.laws.random_loads import Draft
from tests.laws.sketch import points_of

FRAME = "frame"


def full(motion, values):
    """Return numbers in the motion's shape, (2, n) or (n,)."""
    values = np.asarray(values, float)
    return np.broadcast_to(values, (2, *motion.shape) if values.ndim == 2 else motion.shape)


class ByHand:
    """One motion of a draft's machine, seen from outside."""

    def __init__(self, draft: Draft, motion, rates=None, rubs=False):
        self.draft, self.motion, self.rubs = draft, motion, rubs
        self.at = {name: full(motion, motion[name]) for name in draft.at}
        self.rates = rates or {}
        self.bodies = [frozenset(body) for body in draft.bodies()]
        self.reach = max(float(np.max(size(place))) for place in self.at.values())

    # -- bodies --------------------------------------------------------------------------------------------

    def body(self, name):
        """Return which body of the draft a name stands for: the frame, an element, points, a block; AssertionError for none."""
        if name == FRAME or name in self.draft.elements or name.startswith("Actuator "):
            return name
        if name in self.draft.links:
            return frozenset(self.draft.links[name])
        held = {name: each.name for each in self.draft.holders for name in (each.name, each.A + each.B, each.B + each.A)}
        held |= {A + B: A + B for A, B in self.draft.own.values()} | {B + A: A + B for A, B in self.draft.own.values()}
        if name in held:
            return held[name]
        points = frozenset(points_of(name.removesuffix(" (slider)").removeprefix("pin ")))
        assert points in self.bodies or len(points) == 1, f"no body has the name {name}"
        return points if points in self.bodies else name

    def ends(self, body):
        """Return two points that turn with a body; none where it is the frame or does not turn with a link."""
        if isinstance(body, frozenset):
            return self.widest(body)
        if body in self.draft.elements:
            return self.draft.elements[body].A, self.draft.elements[body].B
        straight = {each.name: (each.A, each.B) for each in self.draft.holders} | {A + B: (A, B) for A, B in self.draft.own.values()}
        if body in straight:
            return straight[body]
        return next((run.pair for run in self.draft.runs if body in (f"{run.point} (slider)", run.point)), self.draft.arms.get(body, ()))

    def widest(self, points):
        """Return the two points of a body that are farthest apart."""
        pairs = [(P, Q) for P in sorted(points) for Q in sorted(points) if P < Q]
        return max(pairs, key=lambda pair: self.draft.apart(*pair))

    # -- how things move -----------------------------------------------------------------------------------

    def rate(self, point, stroke):
        """Return a point's velocity by a stroke, shape (2, n)."""
        if not point or self.draft.is_fixed(point):
            return np.zeros((2, *self.motion.shape))
        return full(self.motion, self.motion.ratio(point, wrt=stroke))

    def stretch(self, A, B, stroke):
        """Return d|AB| by a stroke, shape (n,)."""
        u = (self.at[B] - self.at[A]) / size(self.at[B] - self.at[A])
        return ((self.rate(B, stroke) - self.rate(A, stroke)) * u).sum(axis=0)

    def spin(self, pair, stroke):
        """Return how two points turn by a stroke, shape (n,) [rad per unit]."""
        if not pair:
            return np.zeros(self.motion.shape)
        arm = self.at[pair[1]] - self.at[pair[0]]
        return cross(arm, self.rate(pair[1], stroke) - self.rate(pair[0], stroke)) / size(arm) ** 2

    def slip(self, run, stroke):
        """Return how fast a point runs along its line, shape (n,)."""
        u = full(self.motion, run.direction(self.at) / size(run.direction(self.at)))
        origin = self.at[run.origin] if run.origin else self.at[run.point]
        across = np.stack([-u[1], u[0]])
        rate = ((self.rate(run.point, stroke) - self.rate(run.origin, stroke)) * u).sum(axis=0)
        return rate + self.spin(run.pair, stroke) * ((self.at[run.point] - origin) * across).sum(axis=0)

    # -- what acts -----------------------------------------------------------------------------------------

    def acting(self):
        """Return every load from outside with its force (2, n), couple and place; elements are not among them."""
        return [act for load in self.draft.loads.values() for act in load.acts(self.at)]

    def thrust(self, name):
        """Return an element's thrust, shape (n,) [N]: at the strokes' rates, and against the friction of its seals where something rubs."""
        element = self.draft.elements[name]
        length = size(self.at[element.B] - self.at[element.A])
        rate = sum((self.stretch(element.A, element.B, each) * speed for each, speed in self.rates.items()), np.zeros_like(length))
        return full(self.motion, element.thrust(length, rate) - self.rubs * np.sign(rate) * element.losses)

    def energy(self):
        """Return the potential of all loads and elements, shape (n,) [J]."""
        found = np.zeros(self.motion.shape)
        for load in self.draft.loads.values():
            found = found + load.energy(self.at)
        for element in self.draft.elements.values():
            found = found + element.energy(size(self.at[element.B] - self.at[element.A]))
        return found

    # -- balance -------------------------------------------------------------------------------------------

    def carrier(self, act, joints):
        """Return the body a load acts on: the one that is named; else the frame, the one the others turn on, the only one."""
        if act.on:
            return next(body for body in self.bodies if set(act.on) <= body)
        if self.draft.is_fixed(act.point):
            return FRAME
        pins = [each for each in joints if each.point == act.point and each.kind == "pin"]
        if pins:
            return self.body(pins[0].by)
        there = [each for each in joints if each.point == act.point]
        return next((body for body in self.bodies if act.point in body), self.body(there[0].on) if there else None)

    def wrenches(self, joints):
        """Return what acts on each body by joints and loads: lists of force (2, n), moment about the origin (n,)."""
        found = defaultdict(list)
        for each in joints:
            force, place = full(self.motion, each.force), self.at[each.point]
            moment = cross(place, force) + each.couple
            found[self.body(each.on)].append((force, moment))
            found[self.body(each.by)].append((-force, -moment))
        for act in self.acting():
            force, place = full(self.motion, act.force), full(self.motion, act.place)
            found[self.carrier(act, joints)].append((force, cross(place, force) + act.couple))
        return found

    def largest(self, joints):
        """Return the largest force at each pose, of joints and loads, shape (n,) [N]."""
        found = [size(full(self.motion, each.force)) for each in (*joints, *self.acting())]
        found += [np.abs(full(self.motion, each.couple)) / self.reach for each in (*joints, *self.acting())]
        return np.max(found, axis=0)

    def misses(self, joints):
        """Return by body the largest sum of forces, and of moments over the reach, against the largest force."""
        largest = self.largest(joints)
        return {
            body: max(
                float(np.max(size(sum(force for force, _ in its)) / largest)),
                float(np.max(np.abs(sum(moment for _, moment in its)) / largest)) / self.reach,
            )
            for body, its in self.wrenches(joints).items()
        }


def by_point(hand, found):
    """Return what the joints of a result put on each body at each point: force (2, n), couple (n,)."""
    sums = defaultdict(lambda: [0.0, 0.0])
    for each in found.joints:
        for name, sign in ((each.on, 1.0), (each.by, -1.0)):
            key = each.point, hand.body(name)
            sums[key] = [sums[key][0] + sign * full(hand.motion, each.force), sums[key][1] + sign * full(hand.motion, each.couple)]
    return sums
