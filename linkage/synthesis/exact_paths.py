"""Five points of a path with given fixed pivots: all four-bars that go through them, by continuation from a general task.

Source: Morgan, Wampler: Solving a planar four-bar design problem using continuation, J. Mech. Des. 112 (1990) 544-550.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from itertools import combinations, product
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

from ..errors import DefinitionError, StudyError, ensure, require
from ..frozen import record
from ..language import said
from ..numeric.descent import refined, without_repeats
from ..program import FloatArray
from ..units import require_measure
from .exact import ComplexArray, CouplerTask, ExactMachine, ExactSynthesis, Pivoted, exact_synthesis, is_without_links, judged_machine
from .tasks import table_of

POINTS = 5
GENERAL = 36
"""Solutions of a general task, complex ones among them."""
SEED = 1990
ROUTES = 4
"""Ways from the general task to the asked one that are tried until nothing is missing."""
FINITE = 1e-7
"""A homogeneous coordinate that is less is none: the solution is at infinity."""
REAL, SAME = 1e-6, 1e-7
BEGIN, LEAST_STEP, STEPS = 0.05, 1e-9, 1500
CLOSE, NEAR = 1e-9, 1e-3
"""Corrections of a path's place, as parts of it: the last one may be so large, and the first."""
TURNED = 1e-10
"""How far a turning of the coupler may be from one in size."""

System: TypeAlias = Callable[[ComplexArray, FloatArray], tuple[ComplexArray, ComplexArray]]
"""Values (m, 4) and derivatives (m, 4, 6) at places (m, 6) and times (m,) from 0 to 1."""


def five_point(pivots: object, points: object, *, in_order: bool = True) -> ExactSynthesis:
    """Return all four-bars on two fixed pivots whose coupler point goes through five points: `five_point([(0, 0), (0.1, 0)], points)`.

    `pivots` (2, 2) and `points` (5, 2) [m]. All real solutions are found, each with its machine: `solutions` go through the points in
    order on one branch, driven at one of the pivots, in any order with `in_order=False`; `misses` say why they do not.

    Raises DefinitionError for pivots or points that coincide or are not as many.

    Parameters
    ----------
    pivots : array_like
        The fixed pivots [m], shape (2, 2).
    points : array_like
        The points [m], shape (5, 2).
    in_order : bool
        Whether the machine passes the positions in order.

    Returns
    -------
    ExactSynthesis
        The machines.

    Raises
    ------
    DefinitionError
        Pivots or points coincide, or are not as many.
    """
    ends, targets = complex_rows("pivots", pivots, 2), complex_rows("points", points, POINTS)
    a, b = ends
    own = (targets - a) / (b - a)
    for k, far in enumerate((abs(own), abs(own - 1.0))):
        if np.ptp(far) < 1e-9 * far.max():
            where = f"({ends[k].real:g}, {ends[k].imag:g})"
            raise DefinitionError(f"five_point: the points lie on a circle about the pivot {where}: one crank does it; move one of them.")
    every = solutions_of(own, own.conj())
    found: list[ExactMachine] = []
    for exact in real_ones(every, own):
        turned = np.concatenate([[1.0], turnings(*exact, own)])
        turned = turned / abs(turned)
        one, other = (Pivoted((own + turned * z) * (b - a) + a, pivot) for z, pivot in zip(exact, ends, strict=True))
        if not is_without_links(one, other, abs(b - a)):
            found.append(judged_machine(one, other, CouplerTask(targets, in_order=bool(in_order))))
    title = said("Four-bars on two pivots through five points")
    return exact_synthesis(title, found, len(every))


def complex_rows(name: str, given: object, count: int) -> ComplexArray:
    """Return places (n, 2) as complex numbers (n,); DefinitionError for another number of them, or for two at one place."""
    require_measure(given, "length", f"five_point: {name}")
    rows = table_of("five_point", name, given, 2)
    require(len(rows) == count, f"five_point: {name}", given, f"{count} places (x, y) are expected, there are {len(rows)}")
    found = rows @ np.array([1.0, 1.0j])
    apart = min(abs(one - other) for one, other in combinations(found, 2))
    ensure(apart > 1e-9 * np.ptp(rows, axis=0).max(), f"five_point: two of the {name} are at one place; give {count} that differ.")
    return np.asarray(found)


# -- the equations ------------------------------------------------------------------------------------------------
#
# In the pivots' own axes, 0 and 1, point j is p, its conjugate q, and both are numbers of their own. The pins A and B stand at x and y
# from the coupler's point in its first position, X and Y are their conjugates, T the coupler's turning. That A keeps its distance is
#     q x T + p X / T = q0 x + p0 X - (p q - p0 q0) = e,
# and that B does, the same of y about 1. Two equations linear in T and 1/T, of which T (1/T) = 1 is what is left: N U = D^2, of degree
# two in x, X and in y, Y. Both are homogeneous, with a first coordinate of their own.


def dyad_terms(z: ComplexArray, p: ComplexArray, q: ComplexArray) -> tuple[tuple[ComplexArray, ...], tuple[ComplexArray, ...]]:
    """Return one pivot's terms of the equations at places (m, 3), of points (m, 5).

    These are the values (m, 4) of e, of q x and of p X, and their derivatives by the homogeneous three (m, 4, 3).
    """
    constant = p[:, 1:] * q[:, 1:] - p[:, :1] * q[:, :1]
    one, none = np.ones_like(constant), np.zeros_like(constant)
    e = q[:, :1] * z[:, 1:2] + p[:, :1] * z[:, 2:] - constant * z[:, :1]
    by_e = np.stack([-constant, q[:, :1] * one, p[:, :1] * one], axis=2)
    by_turned, by_back = np.stack([none, q[:, 1:], none], axis=2), np.stack([none, none, p[:, 1:]], axis=2)
    return (e, q[:, 1:] * z[:, 1:2], p[:, 1:] * z[:, 2:]), (by_e, by_turned, by_back)


def equations_at(z: ComplexArray, p: ComplexArray, q: ComplexArray) -> tuple[ComplexArray, ComplexArray, ComplexArray]:
    """Return the values (m, 4) of the equations at places (m, 6), their derivatives (m, 4, 6), and D (m, 4)."""
    (e, t, b), (by_e, by_t, by_b) = dyad_terms(z[:, :3], p, q)
    (f, u, c), (by_f, by_u, by_c) = dyad_terms(z[:, 3:], p - 1.0, q - 1.0)
    D, N, U = t * c - b * u, e * c - f * b, t * f - u * e
    by_D = both(by_t * wide(c) - by_b * wide(u), wide(t) * by_c - wide(b) * by_u)
    by_N = both(by_e * wide(c) - wide(f) * by_b, wide(e) * by_c - by_f * wide(b))
    by_U = both(by_t * wide(f) - wide(u) * by_e, wide(t) * by_f - by_u * wide(e))
    return N * U - D * D, by_N * wide(U) + wide(N) * by_U - 2.0 * wide(D) * by_D, D


def wide(values: ComplexArray) -> ComplexArray:
    """Return values with one more axis."""
    return values[:, :, None]


def both(one: ComplexArray, other: ComplexArray) -> ComplexArray:
    """Return the derivatives by the first three coordinates and by the last three as one array."""
    return np.concatenate([one, other], axis=2)


# -- continuation -------------------------------------------------------------------------------------------------


@record
class Paths:
    """A system that changes with time from 0 to 1, on which all solutions are followed together; `patch` (2, 6) norms their coordinates."""

    system: System
    patch: ComplexArray

    def tracked(self, start: ComplexArray) -> tuple[ComplexArray, npt.NDArray[np.bool_]]:
        """Return where solutions (m, 6) come to, and which of them come to the end."""
        z, m = start.copy(), len(start)
        time, step, good = np.zeros(m), np.full(m, BEGIN), np.zeros(m, int)
        going = np.arange(m)
        for _ in range(STEPS):
            if not len(going):
                break
            h = np.minimum(step[going], 1.0 - time[going])
            new, taken = self.stepped(z[going], time[going], h)
            on, off = going[taken], going[~taken]
            z[on], time[on] = new[taken], time[on] + h[taken]
            good[on] += 1
            grown = on[good[on] >= 2]
            step[grown], good[grown] = 2.0 * step[grown], 0
            step[off], good[off] = 0.5 * step[off], 0
            going = going[(time[going] < 1.0 - 1e-14) & (step[going] > LEAST_STEP)]
        return z, time >= 1.0 - 1e-12

    def stepped(self, z: ComplexArray, time: FloatArray, h: FloatArray) -> tuple[ComplexArray, npt.NDArray[np.bool_]]:
        """Return where a step leads, by Runge and Kutta and then Newton, and which of them may be taken."""
        with np.errstate(all="ignore"):
            half, whole = 0.5 * h[:, None], h[:, None]
            first = self.slope(z, time)
            second = self.slope(z + half * first, time + 0.5 * h)
            third = self.slope(z + half * second, time + 0.5 * h)
            fourth = self.slope(z + whole * third, time + h)
            new = z + whole / 6.0 * (first + 2.0 * second + 2.0 * third + fourth)
            far = []
            for _ in range(3):
                values, slopes, _ = self.normed(new, time + h)
                change = solved_each(slopes, -values)
                new = new + change
                far.append(abs(change).max(axis=1) / abs(new).max(axis=1))
            return new, (far[0] < NEAR) & (far[-1] < CLOSE)

    def normed(self, z: ComplexArray, time: FloatArray) -> tuple[ComplexArray, ComplexArray, FloatArray]:
        """Return values (m, 6) with those of the patch, and derivatives (m, 6, 6), each row by its largest; and these (m, 4)."""
        values, slopes = self.system(z, time)
        size = abs(slopes).max(axis=2)
        patch = np.broadcast_to(self.patch, (len(z), 2, 6))
        values = np.concatenate([values / size, z @ self.patch.T - 1.0], axis=1)
        return values, np.concatenate([slopes / size[:, :, None], patch], axis=1), size

    def slope(self, z: ComplexArray, time: FloatArray) -> ComplexArray:
        """Return dz/dt (m, 6)."""
        _, slopes, size = self.normed(z, time)
        change = (self.system(z, time + 1e-6)[0] - self.system(z, time - 1e-6)[0]) / 2e-6 / size
        return solved_each(slopes, np.concatenate([-change, np.zeros((len(z), 2))], axis=1))


def solved_each(matrix: ComplexArray, right: ComplexArray) -> ComplexArray:
    """Return the solutions (m, k) of linear equations; where they have none, NaN."""
    try:
        return np.asarray(np.linalg.solve(matrix, right[:, :, None])[:, :, 0])
    except np.linalg.LinAlgError:
        bad = ~(abs(np.linalg.det(matrix)) > 0.0)
        eye = np.where(bad[:, None, None], np.eye(matrix.shape[1]), matrix)
        return np.where(bad[:, None], np.nan, np.linalg.solve(eye, right[:, :, None])[:, :, 0])


@lru_cache(maxsize=1)
def general_task() -> tuple[ComplexArray, ComplexArray, ComplexArray, ComplexArray]:
    """Return the solutions (36, 6) of a general task, complex points p and q (5,), and the patch; worked out once.

    It is continued from 96 solutions of products of linear forms; those that end where T has no value are none.
    """
    random = np.random.default_rng(SEED)
    p, q = gaussian(random, POINTS), gaussian(random, POINTS)
    forms = gaussian(random, 4, 2, 3), gaussian(random, 4, 2, 3)
    patch = np.zeros((2, 6), complex)
    patch[0, :3], patch[1, 3:] = gaussian(random, 3), gaussian(random, 3)
    turned = np.exp(2j * np.pi * random.random())

    def system(z: ComplexArray, time: FloatArray) -> tuple[ComplexArray, ComplexArray]:
        values, slopes, _ = equations_at(z, p[None], q[None])
        one, other = (np.einsum("jkc,mc->mjk", form, part) for form, part in zip(forms, (z[:, :3], z[:, 3:]), strict=True))
        begun, with_one, with_other = one.prod(2) * other.prod(2), one[:, :, ::-1], other[:, :, ::-1]
        by_one = np.einsum("mjk,jkc->mjc", with_one, forms[0]) * wide(other.prod(2))
        by_other = np.einsum("mjk,jkc->mjc", with_other, forms[1]) * wide(one.prod(2))
        left: ComplexArray = np.asarray(turned * (1.0 - time), complex)[:, None]
        right: ComplexArray = np.asarray(time, complex)[:, None]
        slope: ComplexArray = wide(left) * both(by_one, by_other)
        return np.asarray(left * begun + right * values), np.asarray(slope + wide(right) * slopes)

    start = []
    for zeros in combinations(range(4), 2):
        others = [j for j in range(4) if j not in zeros]
        for k in product((0, 1), repeat=4):
            x = np.cross(forms[0][zeros[0], k[0]], forms[0][zeros[1], k[1]])
            y = np.cross(forms[1][others[0], k[2]], forms[1][others[1], k[3]])
            start.append(np.concatenate([x / (patch[0, :3] @ x), y / (patch[1, 3:] @ y)]))
    z, ended = Paths(system, patch).tracked(np.array(start))
    kept = z[ended & (abs(equations_at(z, p[None], q[None])[2]).min(axis=1) > FINITE)]
    found = distinct(kept[is_finite(kept)])
    if len(found) != GENERAL:
        raise StudyError(f"five_point: the general task has {len(found)} solutions instead of {GENERAL}.")
    return found, p, q, patch


def gaussian(random: np.random.Generator, *shape: int) -> ComplexArray:
    """Return complex numbers at random."""
    return np.asarray(random.normal(size=shape) + 1j * random.normal(size=shape))


def is_finite(z: ComplexArray) -> npt.NDArray[np.bool_]:
    """Return which solutions (m, 6) are not at infinity."""
    return np.asarray(abs(z[:, [0, 3]]).min(axis=1) > FINITE * abs(z).max(axis=1))


def distinct(z: ComplexArray) -> ComplexArray:
    """Return solutions (m, k), each once."""

    def is_same(known: int, place: int) -> bool:
        return bool(abs(z[place] - z[known]).max() <= SAME * abs(z[place]).max())

    return z[without_repeats(np.arange(len(z)), is_same, len(z))]


def solutions_of(p: ComplexArray, q: ComplexArray) -> ComplexArray:
    """Return all solutions (n, 4) of a task that are not at infinity: x, X, y, Y in the pivots' axes.

    Where two paths come to one place, or a solution's conjugate is missing, another way is taken and what it gives is added.
    """
    start, first_p, first_q, patch = general_task()
    random = np.random.default_rng(SEED)
    found = np.zeros((0, 4), complex)
    for route in range(ROUTES):
        bent_p, bent_q = (0.0 * p, 0.0 * q) if not route else (gaussian(random, POINTS), gaussian(random, POINTS))

        def system(z: ComplexArray, time: FloatArray, way: Any = (bent_p, bent_q)) -> tuple[ComplexArray, ComplexArray]:
            t = time[:, None]
            between = t * (1.0 - t)
            values, slopes, _ = equations_at(
                z, (1.0 - t) * first_p + t * p + between * way[0], (1.0 - t) * first_q + t * q + between * way[1]
            )
            return values, slopes

        z, ended = Paths(system, patch).tracked(start)
        kept = z[ended & is_finite(z)]
        new = np.stack([kept[:, 1] / kept[:, 0], kept[:, 2] / kept[:, 0], kept[:, 4] / kept[:, 3], kept[:, 5] / kept[:, 3]], axis=1)
        found = distinct(np.concatenate([found, new]))
        if len(distinct(new)) == len(new) and is_closed(found):
            break
    return found


def is_closed(z: ComplexArray) -> bool:
    """Return whether the conjugate of each solution is one as well."""
    other = z[:, [1, 0, 3, 2]].conj()
    near = abs(z[:, None] - other[None]).max(axis=2)
    return bool((near.min(axis=1, initial=np.inf) < REAL * np.maximum(abs(z).max(axis=1, initial=0.0), 1.0)).all())


# -- real solutions -----------------------------------------------------------------------------------------------


def real_ones(z: ComplexArray, own: ComplexArray) -> list[tuple[complex, complex]]:
    """Return the real ones of solutions (n, 4), x and y, made exact by Newton's method, with which the coupler only turns."""

    def step(state: FloatArray) -> FloatArray:
        x, y = complex(*state[:2]), complex(*state[2:])
        values, slopes, _ = equations_at(np.array([[1.0, x, x.conjugate(), 1.0, y, y.conjugate()]]), own[None], own.conj()[None])
        return np.asarray(np.linalg.solve(slopes[0][:, [1, 2, 4, 5]], -values[0])[[0, 2]].view(float))

    found = []
    for x, X, y, Y in z:
        if abs(X - np.conj(x)) + abs(Y - np.conj(y)) <= REAL * max(abs(x), abs(y), 1.0):
            state = refined(np.array([x.real, x.imag, y.real, y.imag]), step)
            exact = None if state is None else (complex(*state[:2]), complex(*state[2:]))
            if exact and abs(abs(turnings(*exact, own)) - 1.0).max() < TURNED:
                found.append(exact)
    return found


def turnings(x: complex, y: complex, own: ComplexArray) -> ComplexArray:
    """Return the coupler's turning at the points after the first, (4,)."""
    one, other = own, own - 1.0
    e, f = (2.0 * (each[0].conj() * z).real - abs(each[1:]) ** 2 + abs(each[0]) ** 2 for each, z in ((one, x), (other, y)))
    with np.errstate(all="ignore"):
        D = one[1:].conj() * x * other[1:] * np.conj(y) - one[1:] * np.conj(x) * other[1:].conj() * y
        return np.asarray((e * other[1:] * np.conj(y) - f * one[1:] * np.conj(x)) / D)
