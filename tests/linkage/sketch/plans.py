"""Machines of our own as plain plans in mm, and an independent solver of their constraints.

No number of them is from another program's models.
"""

from dataclasses import dataclass, field
from functools import cache
from itertools import combinations, pairwise
from math import hypot

import numpy as np
from scipy.optimize import least_squares


@dataclass(frozen=True)
class Plan:
    """Points [mm], what is fixed, links, slides (a point, and two points, an angle [rad], or a link with one), and what drives."""

    name: str
    points: dict
    fixed: str
    links: list
    crank: str = ""
    cylinder: str = ""
    throw: float = 0.0
    slides: list = field(default_factory=list)
    rigid: str = ""
    """The points that slide whose link does not turn on its slide."""
    run: float = 1.0
    """The part of the stroke that is looked at."""

    @property
    def reach(self):
        return 2.0 * np.pi if self.crank else self.throw

    @property
    def size(self):
        return max(np.ptp([place[axis] for place in self.points.values()]) for axis in (0, 1))


PLANS = [
    Plan("Rocker", dict(O=(0, 0), A=(40, 15), B=(150, 110), C=(160, 0), T=(90, 140)), "OC", ["OA", "ABT", "BC"], "OA"),
    Plan("Pump", dict(O=(0, 0), A=(50, 20), C=(200, 30)), "O", ["OA", "AC"], "OA", slides=[("C", 0.0)]),
    Plan("Upright", dict(O=(10, 5), A=(55, 20), C=(40, 180)), "O", ["OA", "AC"], "OA", slides=[("C", np.pi / 2)]),
    Plan("Inclined", dict(O=(0, 0), A=(50, -20), C=(190, 90), T=(120, 100)), "O", ["OA", "ACT"], "OA", slides=[("C", 0.4)]),
    Plan("Shaper", dict(O=(0, 0), A=(30, 10), P=(0, -100), Q=(60, 120), R=(150, 130)), "OP", ["OA", "PQ", "QR"], "OA",
         slides=[("A", "PQ"), ("R", 0.0)]),
    Plan("Offset", dict(O=(0, 0), A=(30, 10), P=(0, -100), Q=(70, 140), R=(160, 130)), "OP", ["OA", "PQ", "QR"], "OA",
         slides=[("A", ("PQ", 1.1)), ("R", 0.0)]),
    Plan("Runner", dict(O=(300, 50), A=(300, 90), P=(0, 0), Q=(200, 0), M=(100, 45), H=(60, 0), I=(140, 0)), "OHI",
         ["OA", "PMQ", "AM"], "OA", slides=[("H", "PQ"), ("I", "PQ")]),
    Plan("Hatch", dict(G=(0, -40), N=(100, 0), S=(80, 10), E=(180, 40), O=(220, -60), T=(300, 60)), "GO", ["OET", "GN", "SE"], "OE",
         slides=[("S", ("GN", 0.1))], rigid="S", run=0.1),
    Plan("Boom", dict(O=(0, 0), A=(400, -100), B=(500, 300), T=(1500, 600)), "OA", ["OBT"], cylinder="AB", throw=150.0),
    Plan("Watt", dict(O=(0, 0), A=(40, 20), B=(160, 120), C=(170, 0), D=(240, 110), E=(330, 140), F=(320, 0)), "OCF",
         ["OA", "AB", "BCD", "DE", "EF"], "OA"),
    Plan("Platform", dict(O=(0, 0), A=(50, 0), D=(120, 50), E=(220, 50), F=(160, 130), P=(300, 0), Q=(150, 300)), "OPQ",
         ["OA", "AD", "DEF", "EP", "FQ"], "OA", run=0.15),
    Plan("Scissors", dict(O=(0, 0), R=(300, 0), M=(150, 80), K=(300, 160), T=(0, 160), G=(30, -60)), "OG", ["OMK", "RMT"],
         cylinder="GM", throw=40.0, slides=[("R", 0.0)]),
    Plan("Bucket", dict(O=(0, 0), A=(-200, 150), B=(120, 160), C=(60, 90), D=(210, 60), E=(260, -20), T=(420, -100)), "OAE",
         ["OBC", "CD", "DET"], cylinder="AB", throw=60.0),
    Plan("Hopper", dict(O=(0, 0), A=(250, -120), B=(310, 110), C=(180, 240), D=(420, 330), H=(520, 20)), "OAH",
         ["OBC", "CD", "DH"], cylinder="AB", throw=40.0),
    Plan("Jaw", dict(O=(0, 0), A=(25, 5), B=(140, -60), C=(60, -150), D=(230, -20)), "OC", ["OA", "ABD", "BC"], "OA"),
]  # fmt: skip
BY_NAME = {plan.name: plan for plan in PLANS}


def residuals(plan, drive):
    """Return the function of all coordinates that vanishes where a plan is assembled at a value of its drive."""
    names = list(plan.points)
    start = {name: np.array(place, float) for name, place in plan.points.items()}

    def rows(flat):
        at = dict(zip(names, flat.reshape(-1, 2), strict=True))
        found = [at[name] - start[name] for name in plan.fixed]
        for link in plan.links:
            found += [[(np.hypot(*(at[P] - at[Q])) - np.hypot(*(start[P] - start[Q])))] for P, Q in combinations(link, 2)]
            if len(link) > 2:  # three sides do not tell a plate from its mirror image
                P, Q, *others = link
                found += [
                    [(cross(at[Q] - at[P], at[X] - at[P]) - cross(start[Q] - start[P], start[X] - start[P])) / plan.size] for X in others
                ]
        for point, along in plan.slides:
            if isinstance(along, str):
                P, Q = (at[each] for each in along)
                found.append([cross(Q - P, at[point] - P) / plan.size])
            elif isinstance(along, tuple):  # a slot of a link, beside its pins: its distance from them and its direction stay
                (P, Q), (u, v) = along[0], (np.cos(along[1]), np.sin(along[1]))
                base, arm = start[Q] - start[P], start[point] - start[P]
                turn = (at[Q] - at[P]) @ np.array([base, [-base[1], base[0]]]).T / (base @ base)
                line = np.array([turn[0] * u - turn[1] * v, turn[1] * u + turn[0] * v])
                origin = at[P] + np.array([turn[0] * arm[0] - turn[1] * arm[1], turn[1] * arm[0] + turn[0] * arm[1]])
                found.append([cross(line, at[point] - origin)])
            else:
                found.append([cross(np.array([np.cos(along), np.sin(along)]), at[point] - start[point])])
        for point, along in plan.slides:
            if point in plan.rigid:
                (P, Q), rider = along[0], next(link for link in plan.links if point in link)
                turns = [cross(each[Q] - each[P], each[rider[1]] - each[rider[0]]) for each in (at, start)]
                found.append([(turns[0] - turns[1]) / plan.size])
        if plan.crank:
            O, A = plan.crank
            arm, (c, s) = start[A] - start[O], (np.cos(drive), np.sin(drive))
            found.append(at[A] - at[O] - np.array([c * arm[0] - s * arm[1], s * arm[0] + c * arm[1]]))
        else:
            P, Q = plan.cylinder
            found.append([np.hypot(*(at[P] - at[Q])) - hypot(*(start[P] - start[Q])) - drive])
        return np.concatenate(found)

    return rows


def cross(u, v):
    """Return the area of the parallelogram of two vectors."""
    return u[0] * v[1] - u[1] * v[0]


@cache
def solved(name, poses, steps=8):
    """Return the drive and the places of all points [mm] at poses of a plan, one after the other from the drawn one, up to a dead point."""
    plan = BY_NAME[name]
    flat, found = np.array([*plan.points.values()], float).ravel(), []
    values = np.linspace(0.0, plan.run * plan.reach, poses)
    for begin, value in pairwise(values):
        for part in np.linspace(begin, value, steps + 1)[1:]:
            answer = least_squares(residuals(plan, part), flat, method="lm", xtol=3e-16, ftol=3e-16, gtol=3e-16)
            flat = answer.x
        sizes = np.linalg.svd(answer.jac, compute_uv=False)
        if np.max(np.abs(answer.fun)) > 1e-9 * plan.size or sizes[-1] < 1e-2 * sizes[0]:
            break
        found.append((value, dict(zip(plan.points, flat.reshape(-1, 2), strict=True))))
    return found
