"""Random parts lists that assemble: pins, links and slides with lengths measured in a sketch, well away from dead points."""

import math
from itertools import count

import numpy as np

from linkage import Crank, Dimension, Ground, Guide, Link, Mechanism, Pin, Slide, Stroke, drawn
from linkage.quantities import ref

NAMES = [f"{letter}{digit}" for digit in ("", "1") for letter in "BCDEFGHIJKLM"]
APART = 0.25  # least distance of two joints of a sketch, m
OPEN = 0.5  # least sine of the angle between the two members of a dyad in the sketch


def sine(u, v):
    """Return the sine of the angle between two vectors, signed."""
    return (u[0] * v[1] - u[1] * v[0]) / (math.hypot(*u) * math.hypot(*v))


def minus(p, q):
    return p[0] - q[0], p[1] - q[1]


class Sheet:
    """A sketch that grows: where the points are, and the parts that hold them there."""

    def __init__(self, seed):
        self.random = np.random.default_rng(seed)
        self.members, self.at, self.pairs, self.guides = {}, {}, [], {}
        self.free = list(NAMES)
        self.links = 0
        for name in "AOPQ":
            self.at[name] = self.spot()
            self.members[name] = Ground(*self.at[name])
        self.members["S"] = Stroke(-0.05, 0.05)
        self.members["sketch"] = drawn(S=0.0)

    def spot(self):
        """Return a place clear of all points; the sheet grows where it is full."""
        for tries in count():
            size = 1.0 + tries / 100
            place = tuple(self.random.uniform(-size, size, 2))
            if all(math.dist(place, other) > APART for other in self.at.values()):
                return place

    def pick(self, count):
        """Return some points, the first of them one that moves."""
        moving = [name for name in self.at if name not in "AOPQ"]
        first = str(self.random.choice(moving))
        others = [name for name in self.at if name != first]
        return [first, *(str(each) for each in self.random.choice(others, count - 1, replace=False))]

    def pin(self, place, exact=False):
        """Draw a pin near its place."""
        X = self.free.pop(0)
        self.at[X] = place
        rough = place if exact else tuple(float(part) for part in np.add(place, self.random.uniform(-0.02, 0.02, 2)))
        self.members[X] = Pin(near=rough)
        return X

    def length(self, P, Q):
        return math.dist(self.at[P], self.at[Q])

    def link(self, *points):
        """Join points by a link: every distance from the first, and what else makes it rigid."""
        first, second, *more = points
        labels = {first + second: self.length(first, second)}
        for point in more:
            labels |= {first + point: self.length(first, point), second + point: self.length(second, point)}
        self.members["-".join(("link", *points)).replace("-", "_")] = Link(" ".join(points), **labels)
        self.pairs += [(P, Q) for k, P in enumerate(points) for Q in points[k + 1 :]]
        self.links += 1

    # -- what moves it ---------------------------------------------------------------------------------

    def drive(self):
        """A crank, or a cylinder with its arm."""
        if self.random.random() < 0.4:
            X, turn = self.free.pop(0), self.random.uniform(-3.0, 3.0)
            self.at[X] = tuple(np.add(self.at["O"], (0.4 * math.cos(turn), 0.4 * math.sin(turn))))
            self.members[X] = Crank("O", angle=ref("S") + turn, **{"O" + X: 0.4})
            self.pairs.append(("O", X))
        else:
            X = self.pin(self.open_spot("A", "O"))
            self.members["L0"] = Dimension(self.length("A", X))
            self.members["cylinder"] = Link(f"A {X}", **{"A" + X: ref("L0") + ref("S")})
            self.link("O", X)
        self.links += 1

    def open_spot(self, P, Q):
        """Return a place from which two points are seen under a good angle."""
        for tries in count():
            X = self.spot()
            if abs(sine(minus(X, self.at[P]), minus(X, self.at[Q]))) > OPEN / (1.0 + tries / 100):
                return X

    # -- dyads -----------------------------------------------------------------------------------------

    def rrr(self):
        P, Q = self.pick(2)
        X = self.pin(self.open_spot(P, Q))
        self.link(P, X)
        self.link(Q, X)

    def ternary(self):
        """A dyad one of whose links carries a further point."""
        P, Q = self.pick(2)
        X = self.pin(self.open_spot(P, Q))
        Y = self.pin(self.open_spot(P, X))
        self.link(P, X, Y)
        self.link(Q, X)

    def guide(self):
        """Return a guide through a place, of the frame or of a moving body, and its direction."""
        name = f"guide{len(self.guides)}"
        bodies = [pair for pair in self.pairs if pair[1] not in "AOPQ"]
        if bodies and self.random.random() < 0.5:
            P, Q = bodies[self.random.integers(len(bodies))]
            self.members[name] = Guide(P, Q)
            self.guides[name] = (self.at[P], minus(self.at[Q], self.at[P]), (P, Q))
        else:
            place, turn = self.spot(), self.random.uniform(-3.0, 3.0)
            self.members[name] = Guide(place, angle=turn)
            self.guides[name] = (place, (math.cos(turn), math.sin(turn)), ())
        return name

    def on(self, guide, along):
        """Return a place on a guide."""
        origin, direction, _ = self.guides[guide]
        size = math.hypot(*direction)
        return origin[0] + along * direction[0] / size, origin[1] + along * direction[1] / size

    def rrp(self):
        (P,), guide = self.pick(1), self.guide()
        for _ in range(200):
            place = self.on(guide, self.random.uniform(-1.0, 1.0))
            arm = minus(place, self.at[P])
            if math.hypot(*arm) > APART and abs(self.cosine(arm, guide)) > OPEN and self.clear(place):
                break
        else:
            return
        X = self.pin(place)
        self.members[f"shoe{X}"] = Slide(X, guide)
        self.link(P, X)

    def cosine(self, arm, guide):
        direction = self.guides[guide][1]
        return (arm[0] * direction[0] + arm[1] * direction[1]) / (math.hypot(*arm) * math.hypot(*direction))

    def clear(self, place):
        return all(math.dist(place, other) > 0.1 for other in self.at.values())

    def prp(self):
        """Two guides that cross; at least one of them moves, or nothing does."""
        first, second = self.guide(), self.guide()
        (a, u, _), (b, v, _) = self.guides[first], self.guides[second]
        if abs(sine(u, v)) < OPEN:
            return
        along = ((b[0] - a[0]) * v[1] - (b[1] - a[1]) * v[0]) / (u[0] * v[1] - u[1] * v[0])
        place = (a[0] + along * u[0], a[1] + along * u[1])
        if not self.clear(place) or max(map(abs, place)) > 2.0:
            return
        X = self.pin(place)
        self.members[f"shoe{X}"] = Slide(X, first)
        self.members[f"block{X}"] = Slide(X, second)

    def rpr(self):
        """A body on P whose slot glides over Q."""
        Q, P = self.pick(2)
        reach = self.random.uniform(0.3, 1.2) / self.length(P, Q)
        place = tuple(np.add(self.at[P], reach * np.subtract(self.at[Q], self.at[P])))
        if not self.clear(place):
            return
        X = self.pin(place)
        self.link(P, X)
        slot = f"guide{len(self.guides)}"
        self.members[slot] = Guide(P, X)
        self.guides[slot] = (self.at[P], minus(self.at[X], self.at[P]), (P, X))
        self.members[f"block{X}"] = Slide(Q, slot)

    # -- groups ----------------------------------------------------------------------------------------

    def triad(self):
        """A ternary link on three rods, one of which may be a slide (class III)."""
        for _ in range(2000):
            roots = self.pick(3)
            corners = [self.spot() for _ in roots]
            rods = [minus(corner, self.at[root]) for corner, root in zip(corners, roots, strict=True)]
            if min(math.hypot(*rod) for rod in rods) > APART and abs(triad_sense(corners, rods)) > 0.25 and abs(flat(corners)) > 0.3:
                break
        else:
            return
        pins = [self.pin(corner) for corner in corners]
        self.link(*pins)
        sliding = self.random.random() < 0.3
        for number, (root, pin) in enumerate(zip(roots, pins, strict=True)):
            if sliding and number == 2:
                turn = math.atan2(rods[2][1], rods[2][0]) + math.pi / 2
                self.members["rail"] = Guide(self.at[pin], angle=turn)
                self.guides["rail"] = (self.at[pin], (math.cos(turn), math.sin(turn)), ())
                self.members[f"shoe{pin}"] = Slide(pin, "rail")
            else:
                self.link(root, pin)

    def tetrad(self):
        """Two ternary links, each on a placed point, joined by two rods (class IV)."""
        for _ in range(4000):
            P, Q = self.pick(2)
            A, D, B, F = (self.spot() for _ in range(4))
            open_enough = abs(flat([self.at[P], A, D])) > 0.3 and abs(flat([self.at[Q], B, F])) > 0.3
            if open_enough and min(math.dist(A, B), math.dist(D, F)) > APART:
                rows = [[lever(self.at[P], X, Y), -lever(self.at[Q], Y, X)] for X, Y in ((A, B), (D, F))]
                if abs(np.linalg.det(rows)) > 0.3:
                    break
        else:
            return
        a, d, b, f = (self.pin(place) for place in (A, D, B, F))
        self.link(P, a, d)
        self.link(Q, b, f)
        self.link(a, b)
        self.link(d, f)


def flat(corners):
    """Return the sine of a triangle's angle at its first corner."""
    return sine(minus(corners[1], corners[0]), minus(corners[2], corners[0]))


def triad_sense(corners, rods):
    """Return the determinant of the three rods' unit wrenches on the ternary link: 0 where their lines meet in a point."""
    middle = np.mean(corners, axis=0)
    size = max(math.dist(corner, middle) for corner in corners)
    rows = []
    for corner, rod in zip(corners, rods, strict=True):
        u = np.array(rod) / math.hypot(*rod)
        r = np.subtract(corner, middle) / size
        rows.append([u[0], u[1], r[0] * u[1] - r[1] * u[0]])
    return float(np.linalg.det(rows))


def lever(pivot, X, other):
    """Return the lever arm of the rod X-other about a pivot, signed [m]."""
    return sine(minus(X, pivot), minus(X, other)) * math.dist(X, pivot)


DYADS = ("rrr", "ternary", "rrp", "prp", "rpr")


def made(sheet, name):
    """Return the class of a sheet, its members in any order."""
    order = list(sheet.members)
    sheet.random.shuffle(order)
    return type(name, (Mechanism,), {each: sheet.members[each] for each in order})


def dyad_sheet(seed):
    """Return a sheet of pins, links and slides that dyads place, with up to 12 links."""
    sheet = Sheet(seed)
    sheet.drive()
    most = int(sheet.random.integers(4, 13))
    for _ in range(20):
        if sheet.links + 2 > most:
            break
        getattr(sheet, str(sheet.random.choice(DYADS, p=(0.4, 0.2, 0.2, 0.08, 0.12))))()
    return sheet


def dyad_parts(seed):
    """Return the mechanism of a sheet that dyads place, and the sheet."""
    sheet = dyad_sheet(seed)
    return made(sheet, f"Dyads{seed}"), sheet


def group_sheet(seed):
    """Return a sheet with a group of class III or IV."""
    sheet = Sheet(10_000 + seed)
    sheet.drive()
    if sheet.random.random() < 0.5:
        sheet.rrr()
    if sheet.random.random() < 0.7:
        sheet.triad()
    else:
        sheet.tetrad()
    return sheet


def group_parts(seed):
    """Return the mechanism of a sheet with a group of class III or IV, and the sheet."""
    sheet = group_sheet(seed)
    return made(sheet, f"Group{seed}"), sheet


def span_of(machine, least=0.15):
    """Return a half stroke over which a machine stays well away from dead points, and the motion over it."""
    span = 0.05
    for _ in range(12):
        motion = machine().at(S=span * np.linspace(-1.0, 1.0, 9), unreachable="nan")
        with np.errstate(all="ignore"):
            sines = machine.plan.read(motion.inputs).sines
        if motion.reached.all() and all(np.all(np.abs(value) > least) for value in sines.values()):
            return span, motion
        span /= 2
    return 0.0, motion
