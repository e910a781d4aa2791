"""Friction solved to consistency: the joint forces make it, and it makes the joint forces.

Every rubbing joint has a friction q = coefficient * |F|, with F = F0 + G q the force it comes from. Where the coefficients times the
sizes of G add up to less than 1 in every row, that is a contraction: it has one solution, and plain iteration comes to it. Elsewhere
the coefficients grow from zero to their value, and Newton's method follows the solution. Where the Jacobian's determinant comes to
zero on the way the forces grow beyond all bounds: the mechanism jams, or locks itself.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..motion.reach import Mask
from ..program import FloatArray

STEPS = 16
ROUNDS = 40
CONTRACTS = 0.7
"""The row sum up to which plain iteration is quick: some 80 rounds to the last digit at the most, mostly 10."""
SETTLED = 4e-15
"""A friction that changes by less than this part of the largest stays."""
BLOCK = 1024


@dataclass(frozen=True)
class Rows:
    """Where each friction's pressing forces stand: a pin has two rows, a guide one; `parts` says how many each."""

    parts: tuple[int, ...]

    @property
    def first(self) -> FloatArray:
        """The first row of each friction."""
        return np.asarray(np.cumsum([0, *self.parts[:-1]]))

    @property
    def last(self) -> FloatArray:
        """The last row of each friction: the first where it has one."""
        return np.asarray(self.first + np.asarray(self.parts) - 1)

    @property
    def share(self) -> FloatArray:
        """What the hypotenuse of first and last row counts (frictions, 1): of a single row, counted twice, the half of its square."""
        return np.asarray(np.where(np.asarray(self.parts) == 2, 1.0, np.sqrt(0.5))[:, None])


@dataclass(frozen=True)
class Pressed:
    """The forces that make the frictions: without any (rows, n), and by each friction of one unit (rows, frictions, n).

    `lever` (frictions, n) says how many units a friction of 1 N is, signed.
    """

    rows: Rows
    free: FloatArray
    by_unit: FloatArray
    lever: FloatArray

    def at(self, places: Mask | slice) -> Pressed:
        """Return the same at some poses."""
        return Pressed(self.rows, self.free[:, places], self.by_unit[:, :, places], self.lever[:, places])

    def forces(self, q: FloatArray) -> FloatArray:
        """Return the pressing forces (rows, n) at some frictions (frictions, n) [N]."""
        return np.asarray(np.einsum("rjn,jn->rn", self.by_unit, q * self.lever) + self.free)


def settled(pressed: Pressed, coefficient: FloatArray) -> tuple[FloatArray, Mask]:
    """Return the frictions (frictions, n) [N] for coefficients (frictions, n), and where they have no bounded solution (n,)."""
    count, n = coefficient.shape
    q, locked = np.zeros((count, n)), np.zeros(n, bool)
    for start in range(0, n, BLOCK):
        part = slice(start, min(start + BLOCK, n))
        q[:, part], locked[part] = settled_block(pressed.at(part), coefficient[:, part])
    return q, locked


def settled_block(pressed: Pressed, coefficient: FloatArray) -> tuple[FloatArray, Mask]:
    """Return the frictions and the locked poses of one block of poses."""
    rows, q = pressed.rows, np.zeros(coefficient.shape)
    size = np.hypot(pressed.by_unit[rows.first], pressed.by_unit[rows.last]) * rows.share[:, :, None]
    growth = coefficient * np.einsum("rjn,jn->rn", size, np.abs(pressed.lever))
    contracts = np.max(growth, axis=0, initial=0.0) < CONTRACTS
    if contracts.any():
        with np.errstate(over="ignore", invalid="ignore"):  # of poses that do not contract
            q = iterated(rows, coefficient, pressed.forces)
    hard = ~contracts
    locked = np.zeros(len(hard), bool)
    if hard.any():
        q[:, hard], locked[hard] = followed(pressed.at(hard), coefficient[:, hard])
    return q, locked


def iterated(rows: Rows, coefficient: FloatArray, forces: Callable[[FloatArray], FloatArray]) -> FloatArray:
    """Return the frictions (frictions, n) to which plain iteration comes, where it contracts, with the pressing forces at frictions."""
    first, last, share = rows.first, rows.last, rows.share * coefficient
    q = np.zeros(coefficient.shape)
    for _ in range(100):
        force = forces(q)
        x, y = force[first], force[last]
        new = np.sqrt(x * x + y * y) * share  # np.hypot costs five times as much
        change, largest = np.abs(new - q), np.max(new, axis=0, initial=0.0)
        q = new
        if not np.any(change > SETTLED * largest):
            break
    return q


def followed(pressed: Pressed, coefficient: FloatArray) -> tuple[FloatArray, Mask]:
    """Return the frictions (frictions, n) that grow from none with the coefficients, NaN where they jam on the way, and where (n,)."""
    free, by_unit = pressed.free.T, np.moveaxis(pressed.by_unit * pressed.lever, -1, 0)
    rows = [slice(first, last + 1) for first, last in zip(pressed.rows.first, pressed.rows.last, strict=True)]
    forces = [(free[:, each], by_unit[:, each]) for each in rows]
    final = coefficient.T
    q, alive = np.zeros(final.shape), np.ones(len(final), bool)
    for share in np.linspace(0.0, 1.0, STEPS + 1)[1:]:
        q[alive], good = newton(q[alive], share * final[alive], [(F[alive], G[alive]) for F, G in forces])
        alive[alive] = good
    return np.where(alive[:, None], q, np.nan).T, ~alive


def newton(q: FloatArray, coefficient: FloatArray, pressed: list[tuple[FloatArray, FloatArray]]) -> tuple[FloatArray, Mask]:
    """Return the frictions for some coefficients, and where Newton's method came to them on the same side of jamming."""
    count = q.shape[1]
    good: Mask = np.ones(len(q), bool)
    for _ in range(ROUNDS):
        size, slope = sloped(q, pressed)
        miss = q - coefficient * size
        J = np.eye(count) - coefficient[:, :, None] * slope
        good = np.linalg.det(J) > 0.0
        step = np.linalg.solve(np.where(good[:, None, None], J, np.eye(count)), -miss[:, :, None])[:, :, 0]
        q = q + np.where(good[:, None], step, 0.0)
        if np.all(np.abs(step[good]) <= 1e-13 * (1.0 + np.abs(q[good]).max(axis=1, keepdims=True))):
            break
    size, slope = sloped(q, pressed)
    close = np.abs(q - coefficient * size).max(axis=1) <= 1e-10 * (size.max(axis=1) + np.finfo(float).tiny)
    return q, good & close & (np.linalg.det(np.eye(count) - coefficient[:, :, None] * slope) > 0.0)


def sloped(q: FloatArray, pressed: list[tuple[FloatArray, FloatArray]]) -> tuple[FloatArray, FloatArray]:
    """Return the sizes of the pressing forces (n, frictions) and their derivatives by the frictions (n, frictions, frictions)."""
    forces = [F + (G * q[:, None]).sum(axis=2) for F, G in pressed]
    size = np.stack([np.sqrt((F * F).sum(axis=1)) for F in forces], axis=1)
    slopes = [(F[:, :, None] * G).sum(axis=1) for F, (_, G) in zip(forces, pressed, strict=True)]
    safe = np.where(size > 0.0, size, 1.0)
    return size, np.stack(slopes, axis=1) / safe[:, :, None]
