"""The highest values of functions over a box of two strokes and more; many functions and many designs at once.

A grid with the borders on it gives the starts: of the points that no neighbour improves on, those that may still win, by half of what the
values bend there; the highest always. A part of the box that is higher than all else is found if it holds a box as wide as the grid's
steps: one of its points is then the highest of all.

From each start a quadratic is fitted on a stencil, which moves to the quadratic's top and contracts; all stencils of all functions are
one call a round, equal ones once. What is not smooth goes on by sampled gradients: the shortest vector in their hull leads along a ridge
in any direction. The border of what has a value is followed by bisection along a stroke, as a function of the others.
Sources: A. R. Conn, K. Scheinberg, L. N. Vicente, Introduction to Derivative-Free Optimization (2009), ch. 10; J. V. Burke, A. S. Lewis,
M. L. Overton, SIAM J. Optim. 15 (2005) 751-779.
"""

from __future__ import annotations

from itertools import combinations, product
from typing import NamedTuple, Protocol

import numpy as np

from ..vectors import FloatArray, Mask
from .line import CLOSE, LOWEST, Index, is_pole, last_holding, missing_lowest, shifted

SIDES = {2: 129, 3: 33, 4: 13, 5: 8, 6: 6}  # values a stroke, by the number of strokes
MORE, MOST_POSES = 5, 1 << 20  # values a stroke of more strokes; grid poses of all designs together
STARTS, ROUGH = 24, 3  # of each function and design; of these, how many go on where it is not smooth
ROUNDS, PATIENCE = 40, 3  # of stencils; rounds that gain nothing before a start counts as not smooth
NO_GAIN, ROUNDED = 1e-12, 16.0 * float(np.finfo(float).eps)  # of the range of the values, and of their size: what is no gain
TRUST = 1.5  # of a stencil's half: how far a quadratic is believed
NARROW = 1e-9  # of the box: how narrow a stencil gets
NONE = np.zeros(0, int)
SEEN, BORDER = 1e-7, 1e-8  # how near a value must keep growing to be unbounded, and how near its border is known; of the box


class SeenBox(Protocol):
    """Functions in the unit box: `seen` (K, D, side^k) on the grid, and values and reached poses anywhere else.

    `kept` (D, side^k) are the places of the grid that are asked for and reached.
    """

    k: int
    side: int
    seen: FloatArray
    kept: Mask
    count: int

    def at(self, design: Index, places: FloatArray) -> tuple[FloatArray, Mask]:
        """Return the values (K, u, n) at places (u, n, k) of a design each (u,), and which poses (u, n) are reached."""

    def one_function(self, function: int, design: Index, places: FloatArray) -> FloatArray:
        """Return the values (u, n) of one function, by its number, at places (u, n, k) of a design each (u,)."""

    def is_kept(self, design: Index, places: FloatArray) -> Mask:
        """Return which places (u, n, k) of a design each (u,) are asked for and reached, as `kept` says of the grid; it costs least."""


def values_a_stroke(k: int, designs: int) -> int:
    """Return how many values a stroke has on the grid: fewer only where the grids of all designs would be too large."""
    side = SIDES.get(k, MORE)
    while side > 3 and designs * side**k > max(MOST_POSES, SIDES[2] ** 2):
        side -= 1
    return side


# -- starts and what is known of them ------------------------------------------------------------------------


class Climbs(NamedTuple):
    """Searches, arrays (r, ...): their function and design, the best place and its value, the next stencil, the value it should show."""

    function: Index
    design: Index
    unit: FloatArray
    value: FloatArray
    centre: FloatArray
    half: FloatArray
    expected: FloatArray
    bound: FloatArray
    idle: Index
    axis: Index
    """The stroke along which a border is followed, -1 where the box is searched."""

    def subset(self, mask: Mask | Index) -> Climbs:
        """Return some of them."""
        return Climbs._make(each[mask] for each in self)

    @classmethod
    def concatenated(cls, parts: list[Climbs]) -> Climbs:
        """Return all of several."""
        return Climbs._make(map(np.concatenate, zip(*parts, strict=True)))

    def best(self, rows: int) -> FloatArray:
        """Return the best value known, for each the best of its function and design; `rows` is the number of designs."""
        row = self.function * rows + self.design
        found = np.full(int(row.max(initial=0)) + 1, -np.inf)
        np.maximum.at(found, row, self.value)
        return np.asarray(found[row])


def stencil_of(k: int) -> FloatArray:
    """Return the places (n, k) of a stencil from -1 to 1: its middle, the axes, the pairs of axes; of up to three strokes all 3^k."""
    axes = [sign * axis for axis in np.eye(k) for sign in (1.0, -1.0)]
    pairs = [a * i + b * j for i, j in combinations(np.eye(k), 2) for a, b in product((1.0, -1.0), repeat=2)]
    corners = [np.array(each) for each in product((1.0, -1.0), repeat=3)] if k == 3 else []
    return np.array([np.zeros(k), *axes, *pairs, *corners])


def weights_of(k: int, side: int) -> Index:
    """Return by how much a step along each stroke (k,) is further on in the numbers of a grid's points."""
    return np.asarray(side ** np.arange(k - 1, -1, -1))


def steps_to_neighbours(k: int, side: int) -> tuple[Index, Index]:
    """Return the steps (n, k) to the neighbours of a grid point, and by how much these are further on in its numbers (n,)."""
    steps = np.array([each for each in product((-1, 0, 1), repeat=k) if any(each)])
    return steps, steps @ weights_of(k, side)


def widened(cube: FloatArray) -> FloatArray:
    """Return the highest of each point of a grid and its neighbours."""
    for axis in range(cube.ndim):
        found = cube.copy()
        into, here = np.moveaxis(found, axis, 0), np.moveaxis(cube, axis, 0)
        np.maximum(into[:-1], here[1:], out=into[:-1])
        np.maximum(into[1:], here[:-1], out=into[1:])
        cube = found
    return cube


def bends(cube: FloatArray, point: Index) -> FloatArray:
    """Return the sum of the absolute second differences along the strokes at points of a grid, by their numbers.

    They are taken to one side at borders and next to missing values, and none where that is not possible.
    """
    total, index = np.zeros(point.shape), np.unravel_index(point, cube.shape)
    for axis in range(cube.ndim):
        there = index[axis] + np.arange(-2, 3)[:, None]
        inside = np.clip(there, 0, cube.shape[axis] - 1)
        beside = np.where(inside == there, cube[*index[:axis], inside, *index[axis + 1 :]], np.nan)
        far_behind, behind, here, ahead, far_ahead = beside
        middle = np.abs(behind - 2.0 * here + ahead)
        sides = np.fmax(np.abs(here - 2.0 * behind + far_behind), np.abs(here - 2.0 * ahead + far_ahead))
        total += np.nan_to_num(np.where(np.isnan(middle), sides, middle), nan=0.0, posinf=-LOWEST)
    return total


def hopeful(seen: FloatArray, k: int, side: int) -> tuple[Index, FloatArray]:
    """Return the tops of a grid, values (side^k,), that may win, the highest first, and the most that each may come to."""
    values = missing_lowest(seen)
    cube = values.reshape([side] * k)
    tops = np.asarray((cube >= widened(cube)) & (cube > -np.inf))
    for axis in range(k):  # of a level part one point is enough
        here = np.moveaxis(cube, axis, 0)
        np.moveaxis(tops, axis, 0)[1:] &= here[1:] > here[:-1]
    point = np.flatnonzero(tops)
    if not point.size:
        return point, np.zeros(0)
    bound = np.minimum(values[point] + 0.5 * bends(seen.reshape([side] * k), point), -LOWEST)
    able = point[bound >= values.max()]  # to win; of these the first ones of level parts
    steps, by = steps_to_neighbours(k, side)
    steps, by = steps[by < 0], by[by < 0]
    index = np.stack(np.unravel_index(able, [side] * k), axis=-1)[:, None] + steps
    inside = ((index >= 0) & (index < side)).all(axis=-1)
    near = np.where(inside, values[np.where(inside, able[:, None] + by, 0)], -np.inf)
    kept = np.isin(point, able[(near < values[able][:, None]).all(axis=-1)])
    point, bound = point[kept], bound[kept]
    order = np.lexsort((-bound, values[point] < values.max()))[:STARTS]
    return point[order], bound[order]


def starts_of(box: SeenBox) -> tuple[Climbs, FloatArray]:
    """Return the searches from the grid, and the values on their first stencils, (r, n), which the grid has."""
    K, D, _ = box.seen.shape
    found = [hopeful(box.seen[row], box.k, box.side) for row in np.ndindex(K, D)]
    count = [len(point) for point, _ in found]
    function, design = (np.repeat(each.ravel(), count) for each in np.indices((K, D)))
    point, bound = (np.concatenate([each[part] for each in found]) for part in (0, 1))
    index = np.stack(np.unravel_index(point, [box.side] * box.k), axis=-1)
    steps = box.side - 1.0
    middle = np.clip(index, 1, box.side - 2)
    stencil = (middle[:, None, :] + stencil_of(box.k).astype(int)) @ weights_of(box.k, box.side)
    full, none = np.full(len(point), 1.0 / steps), np.full(len(point), np.nan)
    climbs = Climbs(
        function, design, index / steps, box.seen[function, design, point], middle / steps, full, none, bound,
        np.zeros(len(point), int), np.full(len(point), -1),
    )  # fmt: skip
    return climbs, box.seen[function[:, None], design[:, None], stencil]


# -- where it is smooth: a quadratic on a stencil ------------------------------------------------------------


class Quadratic(NamedTuple):
    """Quadratics (r,) of places (r, k) in their stencils, from -1 to 1: value, gradient, second derivatives."""

    value: FloatArray
    slope: FloatArray
    bend: FloatArray

    @classmethod
    def through(cls, seen: FloatArray, k: int) -> Quadratic:
        """Return the quadratics through the values on stencils."""
        ahead, behind = seen[:, 1 : 2 * k + 1 : 2], seen[:, 2 : 2 * k + 1 : 2]
        bend = np.zeros((len(seen), k, k))
        bend[:, range(k), range(k)] = ahead - 2.0 * seen[:, :1] + behind
        for number, (i, j) in enumerate(combinations(range(k), 2)):
            a, b, c, d = seen[:, 2 * k + 1 + 4 * number : 2 * k + 5 + 4 * number].T
            bend[:, i, j] = bend[:, j, i] = 0.25 * (a - b - c + d)
        return cls(seen[:, 0], 0.5 * (ahead - behind), bend)

    def value_at(self, u: FloatArray) -> FloatArray:
        """Return the values (r,) at places (r, k)."""
        return np.asarray(self.value + (u * (self.slope + 0.5 * np.einsum("rij,rj->ri", self.bend, u))).sum(axis=-1))

    def on(self, stencil: FloatArray) -> FloatArray:
        """Return the values (r, n) at the places (n, k) of a stencil."""
        bent = np.einsum("ni,rij,nj->rn", stencil, self.bend, stencil)
        return np.asarray(self.value[:, None] + self.slope @ stencil.T + 0.5 * bent)

    def top(self, low: FloatArray, high: FloatArray, start: FloatArray) -> FloatArray:
        """Return a highest place (r, k) between bounds (r, k): stroke by stroke uphill, and a Newton step in those that are free."""
        k = self.slope.shape[1]
        u = np.clip(start, low, high)
        for _ in range(3):
            for axis in [*range(k)] * 3:
                slope = self.slope[:, axis] + np.einsum("rj,rj->r", self.bend[:, axis], u) - self.bend[:, axis, axis] * u[:, axis]
                bend, ends = self.bend[:, axis, axis], (low[:, axis], high[:, axis])
                gain = [end * (slope + 0.5 * bend * end) for end in ends]
                inner = np.clip(-slope / np.where(bend < 0.0, bend, -1.0), *ends)
                u[:, axis] = np.where(bend < 0.0, inner, np.where(gain[1] > gain[0], ends[1], ends[0]))
            free = (u > low) & (u < high)
            slope = self.slope + np.einsum("rij,rj->ri", self.bend, u)
            matrix = np.where(free[:, :, None] & free[:, None, :], self.bend, 0.0)
            size = np.abs(self.bend).max(axis=(1, 2))[:, None]
            matrix[:, range(k), range(k)] -= np.where(free, 1e-13 * size, 1.0) + 1e-300
            with np.errstate(all="ignore"):
                step = np.linalg.solve(matrix, np.where(free, -slope, 0.0)[..., None])[..., 0]
            new = np.where(np.isfinite(step), u + step, u)  # taken where it stays in and is no loss
            good = ((new >= low) & (new <= high)).all(axis=-1) & (self.value_at(new) >= self.value_at(u))
            u = np.where(good[:, None], new, u)
        return u

    def falls(self, u: FloatArray, by: FloatArray) -> Mask:
        """Return along which coordinates (r, k) a quadratic is steeper at places (r, k) than it bends, by so much (r,)."""
        slope = np.abs(self.slope + np.einsum("rij,rj->ri", self.bend, u))
        return np.asarray(slope > by[:, None] + 0.5 * np.abs(self.bend).sum(axis=-1))


def snapped(unit: FloatArray) -> FloatArray:
    """Return places in the unit box, those next to a border on it."""
    unit = np.where(unit < 1e-14, 0.0, np.minimum(unit, 1.0))
    return np.asarray(np.where(unit > 1.0 - 1e-14, 1.0, unit))


def after_round(climbs: Climbs, seen: FloatArray, k: int, least: FloatArray, places: FloatArray | None = None) -> tuple[Climbs, Mask, Mask]:
    """Return the searches after a round, which have come to their top, and which are not smooth. Less than `least` (r,) is no gain.

    What they have `seen` is at `places` (r, n, k), where these are not those of the stencil.
    """
    rows, stencil = np.arange(len(seen)), stencil_of(k)
    values = missing_lowest(seen)
    pick = np.argmax(values, axis=-1)
    gain = values[rows, pick] - climbs.value
    centre, half = climbs.centre, climbs.half[:, None]
    at = snapped(centre + half * stencil[pick]) if places is None else places[rows, pick]
    climbs = climbs._replace(unit=np.where((gain > 0.0)[:, None], at, climbs.unit), value=np.fmax(climbs.value, values[rows, pick]))
    smooth = np.asarray(np.isfinite(seen).all(axis=-1))
    seen = np.where(smooth[:, None], seen, 0.0)
    model = Quadratic.through(seen, k)
    fixed, walls = np.arange(k) == climbs.axis[:, None], (-centre / half, (1.0 - centre) / half)
    low, high = np.where(fixed, 0.0, np.maximum(-TRUST, walls[0])), np.where(fixed, 0.0, np.minimum(TRUST, walls[1]))
    u = model.top(low, high, stencil[pick])
    at_wall = fixed | (np.abs(u - walls[0]) < 1e-9) | (np.abs(u - walls[1]) < 1e-9)
    inside = np.asarray((at_wall | (np.abs(u) < TRUST)).all(axis=-1))
    error, misfit, spread = np.abs(model.value - climbs.expected), np.abs(model.on(stencil) - seen).max(axis=-1), np.ptp(seen, axis=-1)
    trusted = smooth & ~(error > 0.25 * spread + least) & (misfit <= 0.25 * spread + least)
    firm = (fixed | (at_wall & model.falls(u, 4.0 * np.fmax(error, misfit)))).all(axis=-1)
    hoped = model.value_at(u)
    done = trusted & (hoped - climbs.value <= least) & (misfit <= 0.05 * spread + least) & ((error <= 1e3 * least) | firm)
    bound = np.fmax(climbs.value, hoped) + 2.0 * np.abs(hoped - climbs.value) + 2.0 * np.fmax(error, misfit)
    idle = np.where(smooth & (gain > least), 0, climbs.idle + 1)
    climbs = climbs._replace(bound=np.where(smooth, bound, np.inf), idle=idle)
    climbs = moved_on(climbs, model, u, smooth & (hoped > climbs.value), smooth & inside, trusted, gain > 0.0)
    rough = (idle > PATIENCE) & ~(trusted & inside)
    return climbs, done, ~done & (rough | (climbs.half <= NARROW))


def moved_on(climbs: Climbs, model: Quadratic, u: FloatArray, good: Mask, inside: Mask, trusted: Mask, better: Mask) -> Climbs:
    """Return searches (r,) with their next stencils: about the quadratic's top `u` where that is `good`, else about the best place.

    They are a quarter as wide where the top is `inside` and the quadratic `trusted`, as wide as before where it leads on to what is
    `better`, else half as wide.
    """
    centre, half = climbs.centre, climbs.half[:, None]
    goal = np.where(good[:, None], np.clip(centre + half * u, 0.0, 1.0), climbs.unit)
    near = good | (np.abs(goal - (centre + half * u)) <= 0.5 * half).all(axis=-1)
    new = climbs.half * np.where(trusted & inside & near, 0.25, np.where(good & trusted & better, 1.0, 0.5))
    fixed = np.arange(u.shape[1]) == climbs.axis[:, None]
    middle = np.where(fixed, climbs.unit, np.clip(goal, new[:, None], 1.0 - new[:, None]))
    step = (middle - centre) / half
    known = (good | inside) & (np.abs(step) <= 2.0).all(axis=-1)
    return climbs._replace(centre=middle, half=new, expected=np.where(known, model.value_at(step), np.nan))


def climbed(box: SeenBox) -> tuple[Climbs, Climbs, FloatArray]:
    """Return the searches that came to a smooth top, those that did not, and the least gain (K, D)."""
    D = box.seen.shape[1]
    finite = np.where(np.abs(box.seen) < -LOWEST, box.seen, np.nan)
    size = np.fmax.reduce(np.abs(finite), axis=-1, initial=0.0)
    span = np.fmax.reduce(finite, axis=-1, initial=-np.inf) - np.fmin.reduce(finite, axis=-1, initial=np.inf)
    least = NO_GAIN * np.maximum(span, 0.0) + ROUNDED * size
    going, seen = starts_of(box)
    tops: list[Climbs] = [going.subset(NONE)]
    rough: list[Climbs] = [going.subset(NONE)]
    for _ in range(ROUNDS):
        going, done, stuck = after_round(going, seen, box.k, least[going.function, going.design])
        edge = ~np.isfinite(seen).all(axis=-1)  # next to what has no value: its border is followed on its own
        tops.append(going.subset(done | (stuck & edge)))
        rough.append(going.subset(stuck & ~done & ~edge))
        known = Climbs.concatenated([*tops, *rough, going])
        best = known.best(D)[-len(going.value) :] if len(going.value) else going.value
        going = going.subset(~done & ~stuck & ((going.bound >= best) | (going.value >= best)))
        if not len(going.value):
            break
        keys = np.column_stack([going.design, going.centre, going.half])  # equal stencils are looked at once
        _, first, inverse = np.unique(keys, axis=0, return_index=True, return_inverse=True)
        places = snapped(going.centre[first, None, :] + going.half[first, None, None] * stencil_of(box.k))
        seen = box.at(going.design[first], places)[0][going.function, inverse.reshape(-1)]
    rough.append(going)
    return Climbs.concatenated(tops), Climbs.concatenated(rough), least


# -- where it is not smooth: gradients that are sampled ------------------------------------------------------

SLOPES, FALLS = 4, 60  # samples beyond two a stroke; rounds
LENGTHS = np.ldexp(1.0, np.arange(-5, 6))  # of a search's half: how far it goes along a direction
MANY = 4096  # values from which on each function is asked by itself
FAR_ON = 8  # from which of these lengths on the half is doubled


def own_values(box: SeenBox, climbs: Climbs, places: FloatArray) -> FloatArray:
    """Return the values (r, n) of each search's own function at its own places (r, n, k).

    Few values are asked of all functions at once, many of each function by itself.
    """
    if len(box.seen) * places[..., 0].size <= MANY:
        seen, _ = box.at(climbs.design, places)
        return np.asarray(seen[climbs.function, np.arange(len(places))])
    found = np.empty(places.shape[:2])
    for function in np.unique(climbs.function):
        own = climbs.function == function
        found[own] = box.one_function(function, climbs.design[own], places[own])
    return found


def shortest(slopes: FloatArray, known: Mask) -> FloatArray:
    """Return the shortest vectors (r, k) in the hulls of vectors (r, m, k), of those that are known (r, m)."""
    rows = np.arange(len(slopes))
    slopes = np.where(known[..., None], slopes, 0.0)
    weight = known / np.maximum(known.sum(axis=-1, keepdims=True), 1)
    found = np.einsum("rm,rmk->rk", weight, slopes)
    for _ in range(80):
        along = np.einsum("rmk,rk->rm", slopes, found)
        least = np.argmin(np.where(known, along, np.inf), axis=-1)
        most = np.argmax(np.where(weight > 0.0, along, -np.inf), axis=-1)
        step = slopes[rows, least] - slopes[rows, most]
        share = -(found * step).sum(axis=-1) / np.maximum((step * step).sum(axis=-1), 1e-300)
        share = np.clip(np.nan_to_num(share), 0.0, weight[rows, most])
        share = np.where(share > 1e-9, share, 0.0)
        weight[rows, least] += share
        weight[rows, most] -= share
        found = found + share[:, None] * step
        if not share.any():
            break
    return np.asarray(found)


def ridden(box: SeenBox, climbs: Climbs, least: FloatArray) -> Climbs:
    """Return searches (r,) after steps along the directions in which all slopes about them rise; less than `least` (r,) is no gain."""
    k = box.k
    m = 2 * k + SLOPES
    half = np.full(len(climbs.value), 0.5 / (box.side - 1))
    climbs, ended, root = climbs._replace(half=half), [], 2.0
    for _ in range(64):  # a sequence that fills the cube from -1 to 1 evenly. Source: H. Weyl, Math. Ann. 77 (1916)
        root = (1.0 + root) ** (1.0 / (k + 1))
    for number in range(FALLS):
        numbers = number * m + np.arange(m)[:, None]
        cube = 2.0 * ((0.5 + numbers * root ** -np.arange(1.0, k + 1)) % 1.0) - 1.0
        wanted = climbs.unit[:, None] + climbs.half[:, None, None] * cube
        places = np.clip(wanted, 0.0, 1.0)
        delta = (1e-4 * climbs.half[:, None, None] * np.where(places > 0.5, -1.0, 1.0))[..., None] * np.eye(k)  # (r, m, k, k)
        every = np.concatenate([places[:, :, None], places[:, :, None] + delta], axis=2)
        seen = own_values(box, climbs, every.reshape(len(places), -1, k)).reshape(*places.shape[:2], k + 1)
        slopes = (seen[..., 1:] - seen[..., :1]) / np.einsum("rmkk->rmk", delta)
        steep = 10.0 * np.where(np.isfinite(slopes), np.abs(slopes), 0.0).max(axis=(1, 2))[:, None, None]
        slopes = np.where(wanted == places, slopes, -np.sign(wanted - places) * steep)  # it falls ten times as steep beyond a border
        way = shortest(slopes, np.asarray(np.isfinite(slopes).all(axis=-1)))
        climbs = stepped(box, climbs, way, places, seen[..., 0], least)
        going = climbs.half >= NARROW
        ended.append(climbs.subset(~going))
        climbs, least = climbs.subset(going), least[going]
        if not len(least):
            break
    return Climbs.concatenated([*ended, climbs])


def stepped(box: SeenBox, climbs: Climbs, way: FloatArray, near: FloatArray, seen: FloatArray, least: FloatArray) -> Climbs:
    """Return searches at the best place along a way (r, k) or of those seen near them; nearer about it where that is little gain."""
    rows, half = np.arange(len(way)), climbs.half
    size = np.abs(way).max(axis=-1)
    ahead = way / np.where(size > 0.0, size, 1.0)[:, None]
    line = np.clip(climbs.unit[:, None] + (half[:, None] * LENGTHS)[..., None] * ahead[:, None], 0.0, 1.0)
    values = missing_lowest(np.concatenate([own_values(box, climbs, line), seen], axis=1))
    pick = np.argmax(values, axis=-1)
    gain = values[rows, pick] - climbs.value
    unit = np.where((gain > 0.0)[:, None], np.concatenate([line, near], axis=1)[rows, pick], climbs.unit)
    moved = (gain > 0.02 * half * np.sqrt((way * way).sum(axis=-1))) & (gain > least)
    far = moved & (pick >= FAR_ON) & (pick < len(LENGTHS))
    half = np.where(far, np.minimum(2.0 * half, 0.5), np.where(moved, half, 0.25 * half))
    return climbs._replace(unit=unit, value=np.fmax(climbs.value, values[rows, pick]), half=half)


# -- the border of what has a value --------------------------------------------------------------------------

FINE = 2e-7  # of the box: how narrow a stencil on a border gets
EDGES, BORDERS, CUTS = 4, 4, 16  # borders of each function and design, along each stroke and in all; parts of a bisection
ALL_BORDERS = 128  # searches along borders of all functions and designs together
BUDGET = 400_000  # poses that they look at: where they are more, each stands where it has come to
ACROSS = np.linspace(-6.0, 6.0, 13)  # where a border is looked for, in halves of the stencil


def border_starts(box: SeenBox) -> Climbs:
    """Return searches at the grid points whose next along a stroke has no value, the best ones."""
    K, D, _ = box.seen.shape
    rows: list[tuple[int, int, int, int]] = []
    for row, number in np.ndindex(K, D):
        cube = missing_lowest(box.seen[row, number]).reshape([box.side] * box.k)
        if not np.isneginf(cube).any():
            continue
        for axis, by in product(range(box.k), (-1, 1)):
            beyond, behind = shifted(cube, by, axis=axis), shifted(cube, -by, axis=axis)
            edge = (cube > -np.inf) & np.isneginf(beyond)
            score = np.where(edge, cube + np.where(behind > LOWEST, np.maximum(cube - behind, 0.0), 0.0), -np.inf).ravel()
            tops = np.flatnonzero(edge.ravel() & (score >= widened(score.reshape(cube.shape)).ravel()))
            rows += [(row, number, int(top), axis) for top in tops[np.argsort(-score[tops])][:EDGES]]
    function, design, point, along = np.array(rows, int).reshape(-1, 4).T
    unit = np.stack(np.unravel_index(point, [box.side] * box.k), axis=-1) / (box.side - 1.0)
    steps, _ = steps_to_neighbours(box.k, box.side)
    near = np.clip(np.rint(unit * (box.side - 1)).astype(int)[:, None] + steps, 0, box.side - 1) @ weights_of(box.k, box.side)
    value = box.seen[function, design, point]
    rise = np.fmax.reduce(np.abs(box.seen[function[:, None], design[:, None], near] - value[:, None]), axis=-1, initial=0.0)
    half, none = np.full(len(point), 1.0 / (box.side - 1)), np.full(len(point), np.nan)
    return Climbs(function, design, unit, value, unit, half, none, 2.0 * rise, np.zeros(len(point), int), along)


def on_border(box: SeenBox, alike: Index, climbs: Climbs, places: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the places (r, n, k) on the border next to places (r, n, k), along each search's stroke, and the values (r, n) there.

    The border is looked for within six halves of the stencil; where there is none the value is NaN. Functions that are `alike`
    (K,) have the same border.
    """
    keys = np.column_stack([alike[climbs.function], climbs.design, climbs.axis, climbs.half, places.reshape(len(places), -1)])
    _, first, inverse = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    inverse = inverse.reshape(-1)
    own, asked = climbs.subset(first), places[first]
    shared = (np.isnan(box.seen) == ~box.kept).all(axis=(1, 2))[own.function]
    found, there = np.array(asked), np.zeros(asked.shape[:2], bool)
    for is_shared in (True, False):
        group = shared == is_shared
        if group.any():
            found[group], there[group] = border_crossings(box, own.subset(group), asked[group], is_shared)
    if len(box.seen) * found[..., 0].size > MANY:
        return found[inverse], np.where(there[inverse], own_values(box, climbs, found[inverse]), np.nan)
    seen, _ = box.at(own.design, found)
    return found[inverse], np.where(there[inverse], seen[climbs.function, inverse], np.nan)


def border_crossings(box: SeenBox, climbs: Climbs, places: FloatArray, shared: bool) -> tuple[FloatArray, Mask]:
    """Return the last places (r, n, k) with a value along each search's stroke, and whether there is a border (r, n).

    A border that is `shared`, of all places that are kept, is found by these; then how near to it there is a value.
    """
    k = places.shape[2]
    middle = np.take_along_axis(places, climbs.axis[:, None, None], axis=-1)[..., 0]
    every = np.arange(len(places))

    def on(along: FloatArray, of: Index) -> FloatArray:
        fixed = (np.arange(k) == climbs.axis[of, None])[:, None, None, :]
        return np.where(fixed, along[..., None], places[of, :, None, :]).reshape(len(along), -1, k)

    def kept(along: FloatArray) -> Mask:
        return box.is_kept(climbs.design, on(along, every)).reshape(along.shape)

    def known(along: FloatArray, of: Index = every) -> Mask:
        return ~np.isnan(own_values(box, climbs.subset(of), on(along, of)).reshape(along.shape))

    holds = kept if shared else known
    along = np.clip(middle[..., None] + climbs.half[:, None, None] * ACROSS, 0.0, 1.0)
    has = holds(along)
    change = has[..., :-1] != has[..., 1:]
    there = np.asarray(change.any(axis=-1))
    away = np.where(change, np.abs(np.arange(ACROSS.size - 1) - ACROSS.size // 2 + 0.5), np.inf)
    pick = np.argmin(away, axis=-1)[..., None]
    first, last = (np.take_along_axis(along, pick + step, axis=-1)[..., 0] for step in (0, 1))
    forth = np.take_along_axis(has, pick, axis=-1)[..., 0]
    start, outside = np.where(forth, first, last), np.where(forth, last, first)
    inside, _ = last_holding(holds, start, np.where(there, outside, start), CLOSE, CUTS)
    if shared:
        leg = start - inside
        steps = np.minimum(np.abs(leg)[..., None], np.append(0.0, CLOSE * np.ldexp(1.0, np.arange(0, 44, 4))))
        behind = inside[..., None] + np.sign(leg)[..., None] * steps
        seen = known(behind)
        there &= seen.any(axis=-1)
        pick = np.where(there, np.argmax(seen, axis=-1), 0)
        inside = np.take_along_axis(behind, pick[..., None], axis=-1)[..., 0]
        of = np.flatnonzero((pick > 0).any(axis=-1))
        if of.size:
            beyond = np.take_along_axis(behind, np.maximum(pick - 1, 0)[..., None], axis=-1)[..., 0]
            inside[of], _ = last_holding(lambda along: known(along, of), inside[of], beyond[of], CLOSE, CUTS)
    return on(inside[..., None], every).reshape(places.shape), there


def hopeful_borders(box: SeenBox, alike: Index, known: FloatArray) -> Climbs:
    """Return the searches on borders that may improve the known values (K, D)."""
    starts = border_starts(box)
    if not len(starts.value):
        return starts
    places, values = on_border(box, alike, starts, starts.unit[:, None])
    found, D = missing_lowest(values[:, 0]), box.seen.shape[1]
    keys = np.column_stack([starts.function, starts.design, starts.unit])
    _, point = np.unique(keys, axis=0, return_inverse=True)
    away = np.where(np.isfinite(found), np.abs(places[:, 0] - starts.unit).sum(axis=-1), np.inf)
    order = np.lexsort((away, point.reshape(-1)))
    nearest = np.zeros(len(found), bool)
    nearest[order[np.flatnonzero(np.diff(point.reshape(-1)[order], prepend=-1))]] = True
    hope = found + np.abs(found - starts.value) + starts.bound
    nearest &= (found > -np.inf) & (hope > known[starts.function, starts.design])  # what is the same everywhere gains nothing there
    going = starts._replace(unit=places[:, 0], centre=places[:, 0], value=found, half=0.5 * starts.half)
    order = np.flatnonzero(nearest)
    row = (going.function * D + going.design)[order]
    order = order[np.lexsort((-found[order], row))]
    row = np.sort(row)
    few = min(BORDERS, max(1, ALL_BORDERS // (len(box.seen) * D)))
    order = order[np.arange(len(row)) - np.searchsorted(row, row) < few]
    return going.subset(order)


def along_borders(box: SeenBox, known: FloatArray, least: FloatArray) -> tuple[Climbs, Climbs, Climbs]:
    """Return the searches along borders that came to a smooth top, the others, and places next to which a function is unbounded.

    Those are searched from that may better what is known (K, D); nothing improves on what is unbounded.
    """
    first: dict[bytes, int] = {}
    alike = np.array([first.setdefault(np.isnan(row).tobytes(), number) for number, row in enumerate(box.seen)])
    going = hopeful_borders(box, alike, known)
    K, D, _ = box.seen.shape
    poles = best_of(going, D, 1)
    poles = poles.subset(grows_in_box(box, poles))
    endless = np.zeros((K, D), bool)
    endless[poles.function, poles.design] = True
    going = going.subset(~endless[going.function, going.design])
    tops, ended = [going.subset(NONE)], [going.subset(NONE)]
    begun = box.count
    # the different places of stencils that stand still along each stroke (k, m, k), and which of them (k, n) each place is
    still = [np.unique(np.where(np.arange(box.k) == each, 0.0, stencil_of(box.k)), axis=0, return_inverse=True) for each in range(box.k)]
    flat, number = np.array([offsets for offsets, _ in still]), np.array([index.reshape(-1) for _, index in still])
    for _ in range(ROUNDS):
        if not len(going.value) or box.count - begun > BUDGET:
            break
        offsets, index = flat[going.axis], number[going.axis]
        places, values = on_border(box, alike, going, snapped(going.centre[:, None] + going.half[:, None, None] * offsets))
        places, values = np.take_along_axis(places, index[..., None], axis=1), np.take_along_axis(values, index, axis=1)
        half = going.half
        going, done, stuck = after_round(going, values, box.k, least[going.function, going.design], places)
        beaten = going.value <= (known + least)[going.function, going.design]
        stuck = (going.half < FINE) | (beaten & (going.idle > 2 * PATIENCE))
        lost = ~np.isfinite(values).all(axis=-1)  # where the border is lost it is followed along the next stroke, each as wide as before
        axis = np.where(lost, (going.axis + 1) % box.k, going.axis)
        width = np.where(lost & (axis > 0), half, going.half)
        going = going._replace(axis=axis, half=width, expected=np.where(lost, np.nan, going.expected))
        tops.append(going.subset(done))
        ended.append(going.subset(stuck & ~done))
        best = Climbs.concatenated([*tops, *ended, going]).best(box.seen.shape[1])[-len(going.value) :]
        best = np.maximum(best, known[going.function, going.design])
        stay = ~(done | stuck) & ((going.bound >= best) | (going.value >= best))
        going = going.subset(stay)
    return Climbs.concatenated(tops), Climbs.concatenated([*ended, going]), poles


# -- the search ----------------------------------------------------------------------------------------------


@np.errstate(all="ignore")
def highest_in(box: SeenBox) -> tuple[FloatArray, FloatArray, Mask]:
    """Return the highest values (K, D) of K functions of D designs, NaN where there is none; where (K, D, k); which have no bound."""
    K, D, _ = box.seen.shape
    tops, rough, least = climbed(box)
    best = best_of(Climbs.concatenated([tops, rough]), D, 1)
    rough = best_of(rough, D, ROUGH)
    rough = rough.subset((rough.value > -np.inf) & (rough.bound >= value_of(best, K, D)[rough.function, rough.design]))
    if len(rough.value):
        rough = ridden(box, rough, least[rough.function, rough.design])
    found = [tops, rough, best]
    missing = np.isnan(box.seen)
    if missing.any() and not missing.all():
        found += along_borders(box, value_of(best_of(Climbs.concatenated(found), D, 1), K, D), least)
    doubtful = best_of(Climbs.concatenated([rough, *found[4:]]), D, 1)
    best = best_of(Climbs.concatenated(found), D, 1)
    value, unit = value_of(best, K, D), np.zeros((K, D, box.k))
    doubtful = doubtful.subset(doubtful.value >= value[doubtful.function, doubtful.design])
    grows = grows_in_box(box, doubtful)
    place = best.unit
    for axis in range(box.k if len(place) else 0):  # a stroke that changes the value by no more than rounding stands at its start
        there = np.where(np.arange(box.k) == axis, 0.0, place)
        is_tie = own_values(box, best, there[:, None, :])[:, 0] >= best.value - least[best.function, best.design]
        place = np.where(is_tie[:, None], there, place)
    unit[best.function, best.design] = place
    unbounded = np.isposinf(value)
    poles = Climbs.concatenated([doubtful.subset(grows), *found[5:]])
    unbounded[poles.function, poles.design] = True
    unit[poles.function, poles.design] = poles.unit
    endless = np.equal(box.seen, np.inf)  # where the grid itself is infinite no search starts
    unbounded |= endless.any(axis=-1)
    first = np.stack(np.unravel_index(np.argmax(endless, axis=-1), [box.side] * box.k), axis=-1) / (box.side - 1.0)
    unit = np.where(endless.any(axis=-1, keepdims=True), first, unit)
    lost = missing.all(axis=-1)
    value = np.where(lost, np.nan, np.where(unbounded, np.inf, np.where(value <= LOWEST, -np.inf, value)))
    return value, unit, unbounded


def best_of(climbs: Climbs, D: int, count: int) -> Climbs:
    """Return the best of the searches of each function and design, so many."""
    row = climbs.function * D + climbs.design
    order = np.lexsort((-climbs.value, row))
    row = row[order]
    rank = np.arange(len(row)) - np.searchsorted(row, row)
    return climbs.subset(order[rank < count])


def value_of(best: Climbs, K: int, D: int) -> FloatArray:
    """Return the values (K, D) of the best searches, one each."""
    value = np.full((K, D), -np.inf)
    value[best.function, best.design] = best.value
    return value


def grows_in_box(box: SeenBox, climbs: Climbs) -> Mask:
    """Return at which places (r,) a value grows beyond bounds along a stroke; see `line.is_pole`."""
    if not len(climbs.value):
        return np.zeros(0, bool)
    far = np.ldexp(1.0, -np.arange(1, 41))
    ways = np.array([-1.0, 1.0])[:, None, None] * far[:, None] * np.eye(box.k)[:, None, None, :]  # (k, 2, n, k)
    at = climbs.unit[:, None, None, None, :] + ways
    on = ((at >= 0.0) & (at <= 1.0)).all(axis=-1)
    places = np.clip(at, 0.0, 1.0).reshape(len(at), -1, box.k)
    seen, reached = own_values(box, climbs, places), box.is_kept(climbs.design, places)
    seen, reached = np.where(on, seen.reshape(on.shape), np.nan), reached.reshape(on.shape) & on
    poles = is_pole(np.broadcast_to(climbs.value[:, None], on.shape[:-2]), seen, reached, far, BORDER, SEEN)
    return np.asarray(np.isposinf(climbs.value) | poles.any(axis=(-2, -1)))
