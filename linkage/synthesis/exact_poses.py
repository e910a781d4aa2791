"""Burmester's theory: the links that guide a body through three, four or five poses, and the four-bars and slider-cranks of them.

Sources: Burmester, Lehrbuch der Kinematik, 1888; Sandor, Erdman, Advanced Mechanism Design 2, 1984, chapter 3 (the compatibility linkage).
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations
from math import pi

import numpy as np
import numpy.typing as npt

from ..errors import DefinitionError, StudyError, ensure, require
from ..frozen import immutable, read_only
from ..language import said
from ..motion.regions import Disc, Region, region_of
from ..numeric.descent import refined
from ..program import FloatArray
from ..shown import HasSentence, Shown
from ..units import show
from . import exact as algebra
from .exact import TURN, ComplexArray, CouplerTask, DrivenPiece, ExactMachine, ExactSynthesis, FoundMachines, Pivoted, is_without_links
from .tasks import PoseTask, check_radians, table_of

LOOP = 2880
"""Points of a loop of the curves of four poses."""
PICKED, GRID = 24, 7
"""Links that are picked along the curves in a region, and places of a region's side of three poses."""
AROUND = 2.0
"""Of the extent of the poses: so far about them links are picked where no region is said."""
STRAIGHT = 1e-12
"""Of their extent: places that are less off a line lie on it."""
FIVE = 1e-9
FARTHEST = 1e6
"""Of their extent: a link that is farther away is none."""
NO_MINOR = 1e-12
"""Of the greatest minor: one that is less is none."""
NOWHERE = complex(float("nan"), float("nan"))


def burmester(poses: object, region: object = None, *, in_order: bool = True) -> Burmester:
    """Return the links that guide a body through finite poses, and the four-bars of them: `burmester([(0, 0, 0), (0.1, 0.05, 0.3), ...])`.

    `poses` (n, 3) are x, y [m] and angle [rad] of the body, three to five of them, or a `PoseTask`. A link leads a point of the body, the
    circle point, about a fixed one, its centre point, or along a line. Of three poses each point has one: `found.link(point=)`,
    `found.link(centre=)`. Of four they lie on two cubics, `circle_curve` and `centre_curve`, which `draw(found)` shows; of five there are
    none, two or four. `region` is one for the fixed pivots, as in `synthesise`: `links` are picked in it, along the curves or on a grid.

    `solutions` are the machines of all pairs of links that run through the poses on one branch, in order unless `in_order=False`, the
    greatest least transmission angle first; `misses` say why they do not. P and theta of a machine are the body's x, y and angle.

    Raises DefinitionError for poses that coincide, do not turn, or are not as many.

    Parameters
    ----------
    poses : array_like or PoseTask
        x, y [m] and angle [rad], shape (n, 3), three to five poses.
    region : sequence, optional
        The allowed region of the fixed pivots, as in `synthesise`.
    in_order : bool
        Whether the machine passes the positions in order.

    Returns
    -------
    Burmester
        The links and the machines.

    Raises
    ------
    DefinitionError
        Poses coincide, do not turn, or are not as many.
    """
    rows = checked_poses(poses)
    border = None if region is None else region_of(region, "burmester(region=...)")
    body = PosedBody(rows)
    loops = body.loops() if len(rows) == 4 else ()
    curves = [loop.at(STEPS_OF_LOOP) for loop in loops]
    picked = links_picked(body, curves, border)
    halves = [tuple(read_only(as_points(curve[k])) for curve in curves) for k in (0, 1)]
    return Burmester(read_only(rows), border, halves[0], halves[1], tuple(picked), body, bool(in_order))


def checked_poses(poses: object) -> FloatArray:
    """Return poses (n, 3); DefinitionError for anything else."""
    given = np.stack([poses.x, poses.y, poses.angle], axis=1) if isinstance(poses, PoseTask) else poses
    rows = table_of("burmester", "poses", given, 3, "rows (x, y, angle)")
    check_radians("burmester", "angle", rows[:, 2])
    ensure(3 <= len(rows) <= 5, f"burmester: {len(rows)} poses; three to five of them decide the links, more go with synthesise(...).")
    places, turned = rows[:, :2] @ np.array([1.0, 1.0j]), np.exp(1j * rows[:, 2])
    size = max(float(np.ptp(rows[:, :2], axis=0).max()), 1e-300)
    for one, other in combinations(range(len(rows)), 2):
        if abs(places[one] - places[other]) < 1e-9 * size and abs(turned[one] - turned[other]) < 1e-9:
            raise DefinitionError(f"burmester: poses {one + 1} and {other + 1} are the same; give poses that differ.")
    if abs(turned - turned[0]).max() < 1e-9:
        raise DefinitionError("burmester: the poses do not turn, so that every point of the body moves alike; let the angles differ.")
    turned = turned / turned[0]
    far = int(np.argmax(abs(turned - 1.0)))
    pole = (places[far] - turned[far] * places[0]) / (1.0 - turned[far])
    off = abs(places - pole - turned * (places[0] - pole)).max()
    if off <= 1e-9 * max(abs(places[0] - pole), abs(places - places.mean()).max()):
        size = max(abs(places[0] - pole), abs(pole))
        x, y = (show(round(each / size, 9) * size if size else each, "mm", 4) for each in (pole.real, pole.imag))
        raise DefinitionError(f"burmester: the poses turn about one place, ({x}, {y}): a pin there guides the body; move one of them.")
    return rows


@dataclass(frozen=True, eq=False, repr=False)
class GuidingLink(HasSentence, Shown):
    """A link that can guide a body: its circle `point` (2,) in the first pose and its `centre` (2,) [m].

    One that slides has no centre, NaN, and a `direction` [rad] instead. `places` (n, 2) are those of the point in all poses, `length` is
    that of the link [m].
    """

    point: FloatArray
    centre: FloatArray
    direction: float
    places: FloatArray
    pivoted: Pivoted

    @classmethod
    def of(cls, places: ComplexArray, centre: complex, direction: float = float("nan")) -> GuidingLink:
        """Return the link of a point's places about a centre, or along a line."""
        rows = as_points(places).T
        middle = np.array([centre.real, centre.imag])
        return cls(read_only(rows[0]), read_only(middle), direction, read_only(rows), Pivoted(places, centre, direction))

    @property
    def slides(self) -> bool:
        """Whether it is a slider."""
        return self.pivoted.slides

    @property
    def length(self) -> float:
        """From centre to point [m]; infinite of a slider."""
        return self.pivoted.length

    @property
    def sentence(self) -> str:
        """The link in words."""
        x, y = (show(each, "mm", 4) for each in self.point)
        if self.slides:
            return said("circle point ({x}, {y}) slides at {angle}", x=x, y=y, angle=show(self.direction, "deg", 4))
        cx, cy = (show(each, "mm", 4) for each in self.centre)
        length = show(self.length, "mm", 4)
        return said("circle point ({x}, {y}) about centre point ({cx}, {cy}), {length} long", x=x, y=y, cx=cx, cy=cy, length=length)


@dataclass(frozen=True, eq=False, repr=False)
class Burmester(FoundMachines[ExactMachine]):
    """The links that guide a body through `poses` (n, 3), and the machines of all pairs of them.

    `circle_curve` and `centre_curve` are the branches of the two cubics of four poses, (2, m) each [m], points of the same place belong
    together; none for other numbers of poses. `links` are all of five poses, of fewer those picked in the `region` of the fixed pivots.
    """

    poses: FloatArray
    region: Region | None
    circle_curve: tuple[FloatArray, ...]
    centre_curve: tuple[FloatArray, ...]
    links: tuple[GuidingLink, ...]
    body: PosedBody
    in_order: bool

    @cached_property
    def synthesis(self) -> ExactSynthesis:
        """The machines of all pairs of links."""
        found = [
            machine_of_links(self.body, one, other, in_order=self.in_order)
            for one, other in combinations(self.links, 2)
            if not ((one.slides and other.slides) or is_without_links(one.pivoted, other.pivoted, self.body.size))
        ]
        title = said("Four-bars and slider-cranks through {count} poses", count=len(self.poses))
        return algebra.exact_synthesis(title, found, len(found))

    @property
    def solutions(self) -> tuple[ExactMachine, ...]:
        """The machines that run, the greatest least transmission angle first."""
        return self.synthesis.solutions

    @property
    def misses(self) -> tuple[ExactMachine, ...]:
        """The machines that do not run, each with `why`."""
        return self.synthesis.misses

    @property
    def sentence(self) -> str:
        """How many links and machines there are, in words."""
        if len(self.poses) == 3 and not self.links:
            return said("3 poses: each point of the body has a link, found.link(point=(x, y)); say region= for machines on pivots in it.")
        head = said("{count} poses, {links} links: ", count=len(self.poses), links=len(self.links))
        return head + str(self.synthesis)

    def link(self, *, point: object = None, centre: object = None) -> GuidingLink:
        """Return the link of a circle point in the first pose, or of a centre point (2,) [m]; of four poses, of the nearest on the curve.

        Raises DefinitionError where both or none are given, and StudyError of five poses where there is none.
        """
        if (point is None) == (centre is None):
            raise DefinitionError("link(...): say a circle point, link(point=(x, y)), or a centre point, link(centre=(x, y)).")
        name, given = ("point", point) if centre is None else ("centre", centre)
        row = table_of("burmester", name, given, 0)
        require(len(row) == 2, f"burmester: {name}", given, "x and y [m] are expected")
        place = complex(*row)
        if len(self.poses) == 3:
            if centre is not None:
                return self.body.link_about(place)
            there = self.body.places_of(place)
            middle = centre_through(there, self.body.size)
            return GuidingLink.of(there, middle) if np.isfinite(middle) else GuidingLink.of(there, NOWHERE, line_through(there))
        if len(self.poses) == 4:
            loops = self.body.loops()
            ends = [loop.closest(place, 0 if centre is None else 1) for loop in loops]
            k = int(np.argmin([far for far, _ in ends]))
            (on_circle,), (on_centre,) = loops[k].at(np.array([ends[k][1]]))
            return GuidingLink.of(self.body.places_of(complex(on_circle)), complex(on_centre))
        if not self.links:
            raise StudyError("burmester: these five poses have no link that guides the body through them.")
        places = [each.point if centre is None else each.centre for each in self.links]
        return self.links[int(np.argmin([abs(complex(*each) - place) for each in places]))]

    def four_bar(self, one: GuidingLink, other: GuidingLink) -> ExactMachine:
        """Return the machine of two links, judged; the one that takes it through all poses drives it, else the first."""
        ensure(not (one.slides and other.slides), "four_bar(...): two sliders have no link that could be driven; give one that turns.")
        if is_without_links(one.pivoted, other.pivoted, self.body.size):
            raise DefinitionError("four_bar(...): the two links share a pin; give two that differ.")
        return machine_of_links(self.body, one, other, in_order=self.in_order)


# -- the body and its poses -----------------------------------------------------------------------------------


class PosedBody:
    """A body in its poses (n, 3), as complex numbers: z its places, `turned` its directions from those of the first pose.

    `size` is the extent of the places [m]; of poses about one place, 1.
    """

    def __init__(self, rows: FloatArray) -> None:
        self.rows, self.z = rows, np.asarray(rows[:, :2] @ np.array([1.0, 1.0j]))
        self.turned: ComplexArray = np.exp(1j * (rows[:, 2] - rows[0, 2]))
        self.size = float(abs(self.z - self.z.mean()).max()) or 1.0

    def places_of(self, point: complex | ComplexArray) -> ComplexArray:
        """Return the places (n,) of the body's point that is at a place in the first pose; (m, n) of places (m, 1)."""
        return np.asarray(self.z + self.turned * (point - self.z[0]))

    def link_about(self, centre: complex) -> GuidingLink:
        """Return the link of a centre point of three poses; StudyError where its circle point is at infinity."""
        seen = (centre - self.z) / self.turned  # from the body, which stands still
        point = centre_through(seen, self.size)
        if not np.isfinite(point):
            raise StudyError("burmester: the circle point of this centre is at infinity; choose another centre.")
        return GuidingLink.of(self.places_of(point + self.z[0]), centre)

    # -- four poses --

    def loops(self) -> tuple[CurveLoop, ...]:
        """Return the loops of circle and centre points, by the compatibility linkage.

        A link W + Z from the centre to the body goes with W (e^ib - 1) + Z (e^ia - 1) = d at every pose. So its three rows are dependent: a
        four-bar of the determinants' minors closes, D0 + D1 e^ib1 + D2 e^ib2 + D3 e^ib3 = 0.
        """
        minors = self.minors()
        sizes = abs(np.array([minors.sum(), *minors]))
        first, second, *_ = np.argsort(sizes, kind="stable")
        if sizes[second] < NO_MINOR * sizes.max() or not sizes.max() > 0.0:
            raise StudyError("burmester: three and three of these four poses share a pole, and a curve is none; move one of them.")
        if first and sizes[first] < NO_MINOR * sizes.max():  # the other three share a pole, or are parallel: the curves come apart
            return PosedBody(np.roll(self.rows, -first, axis=0)).own_loops(self)
        return self.own_loops(self)

    def own_loops(self, seen: PosedBody) -> tuple[CurveLoop, ...]:
        """Return the loops that guide the body, their points as in the first pose of the body as it is `seen`."""
        minors, _ = self.minors_in_order()
        one, two, three = abs(minors)
        fixed = -minors.sum()
        if abs(fixed) > NO_MINOR * one:
            low, high = ((far**2 - abs(fixed) ** 2 - one**2) / (2.0 * abs(fixed) * one) for far in (abs(two - three), two + three))
            ways = algebra.angles_of_reach(low, high, float(np.angle(fixed) - np.angle(minors[0])))
        else:
            ways = [DrivenPiece(0.0, TURN, True)]  # a triangle, in any direction
        every = [CurveLoop(self, seen, way, side) for way in ways for side in ((1.0, -1.0) if way.fully else (1.0,))]
        return tuple(each for each in every if each.guides)

    def minors_in_order(self) -> tuple[ComplexArray, npt.NDArray[np.intp]]:
        """Return the minors, the greatest first, and their order."""
        minors = self.minors()
        order = np.argsort(-abs(minors), kind="stable")
        return minors[order], order

    def minors(self) -> ComplexArray:
        """Return the minors D1, D2, D3 of the poses after the first."""
        a, d = self.turned[1:] - 1.0, self.z[1:] - self.z[0]
        return np.array([a[1] * d[2] - a[2] * d[1], a[2] * d[0] - a[0] * d[2], a[0] * d[1] - a[1] * d[0]])

    def dyads(self, beta: FloatArray) -> tuple[ComplexArray, ComplexArray]:
        """Return circle points and centre points (m,) of links that turn by angles (3, m) [rad]."""
        W, Z = self.least_squares(np.exp(1j * beta) - 1.0)
        known = np.isfinite(W) & np.isfinite(Z)
        point = self.z[0] - np.where(known, Z, NOWHERE)
        return point, point - np.where(known, W, NOWHERE)

    def least_squares(self, first: ComplexArray) -> tuple[ComplexArray, ComplexArray]:
        """Return W and Z (m,) of W first (3, m) + Z (e^ia - 1) = d."""
        second, right = (self.turned[1:] - 1.0)[:, None], (self.z[1:] - self.z[0])[:, None]
        aa, bb = (abs(first) ** 2).sum(axis=0), (abs(second) ** 2).sum(axis=0)
        ab = (first.conj() * second).sum(axis=0)
        ra, rb = (first.conj() * right).sum(axis=0), (second.conj() * right).sum(axis=0)
        with np.errstate(all="ignore"):
            determinant = aa * bb - abs(ab) ** 2
            return np.asarray((ra * bb - ab * rb) / determinant), np.asarray((aa * rb - ab.conj() * ra) / determinant)

    def slider(self) -> GuidingLink | None:
        """Return the link that slides, its centre at infinity; None where that has no place. Of five poses it is that of the first four.

        An endlessly long crank turns by endlessly small angles, in proportions that let the compatibility linkage close: D b = 0.
        """
        minors = self.minors()
        share = np.cross(minors.real, minors.imag)
        if not abs(share).max() > 0.0:
            return None
        _, Z = PosedBody(self.rows[:4]).least_squares((share / abs(share).max())[:, None] + 0j)
        places = self.places_of(complex(self.z[0] - Z[0]))
        if not np.isfinite(places).all() or abs(places - self.z.mean()).max() > FARTHEST * self.size:
            return None
        link = GuidingLink.of(places, NOWHERE, line_through(places))
        return link if link.pivoted.error < 1e-9 * max(abs(places - places.mean()).max(), self.size) else None

    # -- five poses --

    def burmester_points(self) -> list[GuidingLink]:
        """Return all real links of five poses: the meetings of two conics, made exact by Newton's method.

        With k = z + T w and the centre m, |k - m| is the same at all poses: four equations, linear in w, m, and w m*. What solves them is
        a plane of three directions, and there w m* is the product of w and m*: two conics.
        """
        z, T = (self.z - self.z.mean()) / self.size, self.turned
        factors = (2.0 * z.conj() * T, -2.0 * z.conj(), -2.0 * T)  # of a number's real and imaginary part in Re(factor * number)
        rows = np.stack([*(part for each in factors for part in (each.real, -each.imag)), abs(z) ** 2], axis=1)
        basis = np.linalg.svd(rows[1:] - rows[0])[2][-3:].T
        found: list[GuidingLink] = []
        w, m, product, one = basis[0:2], basis[2:4], basis[4:6], basis[6]
        real = np.outer(product[0], one) - np.outer(w[0], m[0]) - np.outer(w[1], m[1])
        imaginary = np.outer(product[1], one) - np.outer(w[1], m[0]) + np.outer(w[0], m[1])
        for share in conics_meet([0.5 * (each + each.T) for each in (real, imaginary)]):
            with np.errstate(all="ignore"):
                value = basis @ share
                state = value[:4] / value[6]
            exact = exact_link(state, z, T) if np.isfinite(state).all() else None
            if exact is not None:
                arm, centre = exact
                link = GuidingLink.of(self.z + T * arm * self.size, centre * self.size + self.z.mean())
                if all(abs(complex(*link.point) - complex(*each.point)) > 1e-7 * self.size for each in found):
                    found.append(link)
        return found


def conics_meet(conics: Sequence[FloatArray]) -> list[FloatArray]:
    """Return the real points (3,) in which two conics (3, 3) meet, in coordinates that are turned so that none is special."""
    turn = np.linalg.qr(np.random.default_rng(1888).normal(size=(3, 3)))[0]
    poly = np.polynomial.polynomial
    parts = []
    for conic in conics:
        Q = turn.T @ conic @ turn  # of (x, y, 1): a y^2 + b y + c
        Q = Q / abs(Q).max()
        parts.append((np.array([Q[1, 1]]), np.array([2.0 * Q[1, 2], 2.0 * Q[0, 1]]), np.array([Q[2, 2], 2.0 * Q[0, 2], Q[0, 0]])))
    (a, b, c), (d, e, f) = parts
    ac, ab = poly.polysub(poly.polymul(a, f), poly.polymul(d, c)), poly.polysub(poly.polymul(a, e), poly.polymul(d, b))
    bc = poly.polysub(poly.polymul(b, f), poly.polymul(e, c))
    found = []
    for x in algebra.real_roots(poly.polysub(poly.polymul(ac, ac), poly.polymul(ab, bc))):
        y = -poly.polyval(x, ac) / poly.polyval(x, ab)
        found.append(turn @ np.array([x, y, 1.0]))
    return found


def exact_link(state: FloatArray, z: ComplexArray, T: ComplexArray) -> tuple[complex, complex] | None:
    """Return w and m from the four real parts, made exact by Newton's method; None where they are no solution."""

    def step(state: FloatArray) -> FloatArray:
        arm = z + T * complex(*state[:2]) - complex(*state[2:])
        values = 0.5 * abs(arm) ** 2
        by = np.stack([(arm.conj() * T).real, (arm.conj() * 1j * T).real, -arm.real, -arm.imag], axis=1)
        return np.asarray(np.linalg.solve(by[1:] - by[0], values[0] - values[1:]))

    found = refined(state, step)
    if found is None:
        return None
    state = found
    w, m = complex(*state[:2]), complex(*state[2:])
    far: FloatArray = np.abs(z + T * w - m)
    return (w, m) if abs(state).max() < FARTHEST and np.ptp(far) < FIVE * 1e-3 * max(far.max(), 1.0) else None


@immutable
class CurveLoop:
    """A loop of the curves of four poses: the compatibility linkage driven along its `piece`, on one `side` where it turns fully.

    Its points are those of the first pose of the body as it is `seen`, whose poses may stand in another order.
    """

    body: PosedBody
    seen: PosedBody
    piece: DrivenPiece
    side: float

    def at(self, s: FloatArray) -> tuple[ComplexArray, ComplexArray]:
        """Return circle and centre points (m,) at places s [rad] of the loop, which closes after a turn."""
        minors, order = self.body.minors_in_order()
        if self.piece.fully:
            driven, side = s, np.full(np.shape(s), self.side)
        else:
            middle, half = 0.5 * (self.piece.start + self.piece.end), 0.5 * (self.piece.end - self.piece.start)
            driven, side = middle - half * np.cos(s), np.where(np.sin(s) < 0.0, -1.0, 1.0)
        left = minors.sum() - minors[0] * np.exp(1j * driven)
        two, three, far = abs(minors[1]), abs(minors[2]), abs(left)
        with np.errstate(all="ignore"):
            inner = np.arccos(np.clip((far**2 + two**2 - three**2) / (2.0 * far * two), -1.0, 1.0))
            second = np.angle(left) - np.angle(minors[1]) + side * inner
            third = np.angle(left - minors[1] * np.exp(1j * second)) - np.angle(minors[2])
        beta = np.empty((3, *np.shape(s)))
        beta[order] = driven, second, third
        point, centre = self.body.dyads(beta)
        turned = np.exp(1j * (self.seen.rows[0, 2] - self.body.rows[0, 2]))
        return self.seen.z[0] + (point - self.body.z[0]) * turned, centre

    @property
    def guides(self) -> bool:
        """Whether its links guide the body; of parallel poses one loop is at infinity."""
        point, centre = (each[:: LOOP // 48] for each in self.at(STEPS_OF_LOOP))
        with np.errstate(invalid="ignore"):
            far = abs(self.seen.places_of(point[:, None]) - centre[:, None])
            near = far.max(axis=1) < FARTHEST * self.seen.size
        return bool(near.any() and np.median(np.ptp(far[near], axis=1)) < 1e-6 * self.seen.size)

    def closest(self, place: complex, which: int) -> tuple[float, float]:
        """Return how far the loop's circle point (0) or centre point (1) is off a place, where it comes nearest, and s there [rad]."""
        s, width = STEPS_OF_LOOP, TURN / LOOP
        for _ in range(12):
            far = abs(self.at(s)[which] - place)
            k = int(np.argmin(np.where(np.isfinite(far), far, np.inf)))
            best = float(far[k]), float(s[k])
            s, width = s[k] + width * np.linspace(-1.0, 1.0, 33), width / 12.0
        return best


STEPS_OF_LOOP = TURN * (np.arange(LOOP) + 0.5) / LOOP


def centre_through(places: ComplexArray, size: float) -> complex:
    """Return the centre of the circle through three places [m]; NaN where they lie on a line."""
    one, other = places[1] - places[0], places[2] - places[0]
    area = 2.0 * (one.conjugate() * other).imag
    if abs(area) < STRAIGHT * max(abs(one) * abs(other), (STRAIGHT * size) ** 2):
        return NOWHERE
    return complex(places[0] + 1j * (one * abs(other) ** 2 - other * abs(one) ** 2) / area)


def line_through(places: ComplexArray) -> float:
    """Return the direction of the line through places [rad], as the first and the last of them go."""
    far = places - places.mean()
    direction = 0.5 * np.angle((far**2).sum())
    return float(direction + (pi if ((places[-1] - places[0]) * np.exp(-1j * direction)).real < 0.0 else 0.0))


def as_points(places: ComplexArray) -> FloatArray:
    """Return complex places (m,) as points (2, m)."""
    return np.stack([places.real, places.imag])


# -- what is picked, and the machines of it --------------------------------------------------------------------


def links_picked(body: PosedBody, curves: Sequence[tuple[ComplexArray, ComplexArray]], region: Region | None) -> list[GuidingLink]:
    """Return the links: of five poses all, of four along the curves, of three on a grid, those with their centre in the region."""
    count = len(body.rows)
    slider = None if count == 3 else body.slider()
    sliding = [] if slider is None else [slider]
    if count == 5:
        every = body.burmester_points()
        every = [each for each in every if region is None or lies_within(np.array([each.pivoted.centre]), region)[0]]
        return [*every, *sliding]
    middle = body.z.mean()
    about = Region((Disc(middle.real, middle.imag, AROUND * body.size),), ())
    if count == 3:
        if region is None:
            return []
        # a grid, about the poses where the region has no end
        low, high = np.where(np.isfinite(region.bounding_box), region.bounding_box, about.bounding_box)
        x, y = (low[k] + (high[k] - low[k]) * (np.arange(GRID) + 0.5) / GRID for k in (0, 1))
        grid, found = (x[:, None] + 1j * y[None, :]).ravel(), []
        for each in grid[lies_within(grid, region)].tolist():
            with suppress(StudyError):  # a circle point at infinity
                found.append(body.link_about(each))
        return found
    points, centres = (np.concatenate([curve[k] for curve in curves]) if curves else np.zeros(0, complex) for k in (0, 1))
    steps = np.concatenate([np.append(abs(np.diff(curve[1])), 0.0) for curve in curves]) if curves else np.zeros(0)
    with np.errstate(invalid="ignore"):
        inside = lies_within(centres, about if region is None else region) & (abs(points - centres) < 1e3 * body.size) & np.isfinite(points)
    length = np.cumsum(np.where(inside, np.minimum(np.nan_to_num(steps), body.size), 0.0))
    if not inside.any() or not length[-1] > 0.0:
        return sliding
    wanted = (np.arange(PICKED) + 0.5) / PICKED * length[-1]  # equal steps along the parts of the centre-point curve in the region
    places = np.flatnonzero(inside)[np.minimum(np.searchsorted(length[inside], wanted), inside.sum() - 1)]
    picked = dict.fromkeys(places.tolist())
    return [*(GuidingLink.of(body.places_of(complex(points[k])), complex(centres[k])) for k in picked), *sliding]


def lies_within(places: ComplexArray, region: Region) -> npt.NDArray[np.bool_]:
    """Return whether complex places (m,) lie in a region."""
    return np.asarray(region.depths(as_points(places).T) >= 0.0)


def machine_of_links(body: PosedBody, one: GuidingLink, other: GuidingLink, *, in_order: bool) -> ExactMachine:
    """Return the machine of two links, judged."""
    return algebra.judged_machine(one.pivoted, other.pivoted, CouplerTask(body.z, body=body.rows[:, 2], in_order=in_order))
