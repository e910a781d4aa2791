"""Friction solved to consistency: the joint forces make it, and it makes the joint forces.

Every rubbing joint has a friction q = coefficient * |F|, with F = F0 + G q the force it comes from. The coefficients grow
from zero to their value, and Newton's method follows the solution. Where the Jacobian's determinant comes to zero
on the way the forces grow beyond all bounds: the mechanism jams, or locks itself.
"""

from __future__ import annotations

import numpy as np

from ..motion.reach import Mask
from ..program import FloatArray
from .balance import Balance
from .rub import Rub
from .system import System

STEPS = 16
ROUNDS = 40


def presses(system: System, balance: Balance, rub: Rub) -> tuple[FloatArray, FloatArray]:
    """Return the force that makes a friction: at none (n, parts), and by unit frictions (n, parts, frictions)."""
    start = system.first[rub.column.contact]
    parts = 2 if rub.column.contact.kind == "pin" else 1
    return balance.start[:, start : start + parts], balance.spread[:, start : start + parts]


def settled(system: System, balance: Balance, rubbing: list[Rub]) -> tuple[FloatArray, Mask]:
    """Return the frictions (n, frictions) [N] and the poses where they have no bounded solution (n,)."""
    n, count = system.poses.count, len(rubbing)
    q, alive = np.zeros((n, count)), np.ones(n, bool)
    if not count or not n:
        return q, ~alive
    pressed = [presses(system, balance, rub) for rub in rubbing]
    final = np.stack([rub.coefficient for rub in rubbing], axis=1)
    for share in np.linspace(0.0, 1.0, STEPS + 1)[1:]:
        q[alive], good = newton(q[alive], share * final[alive], [(F[alive], G[alive]) for F, G in pressed])
        alive[alive] = good
    return np.where(alive[:, None], q, np.nan), ~alive


def newton(q: FloatArray, coefficient: FloatArray, pressed: list[tuple[FloatArray, FloatArray]]) -> tuple[FloatArray, Mask]:
    """Return the frictions for some coefficients, and where Newton's method came to them on the same side of jamming."""
    count = q.shape[1]
    good: Mask = np.ones(len(q), bool)
    for _ in range(ROUNDS):
        size, slope = sizes(q, pressed)
        miss = q - coefficient * size
        J = np.eye(count) - coefficient[:, :, None] * slope
        good = np.linalg.det(J) > 0.0
        step = np.linalg.solve(np.where(good[:, None, None], J, np.eye(count)), -miss[:, :, None])[:, :, 0]
        q = q + np.where(good[:, None], step, 0.0)
        if np.all(np.abs(step[good]) <= 1e-13 * (1.0 + np.abs(q[good]).max(axis=1, keepdims=True))):
            break
    size, slope = sizes(q, pressed)
    close = np.abs(q - coefficient * size).max(axis=1) <= 1e-10 * (size.max(axis=1) + np.finfo(float).tiny)
    return q, good & close & (np.linalg.det(np.eye(count) - coefficient[:, :, None] * slope) > 0.0)


def sizes(q: FloatArray, pressed: list[tuple[FloatArray, FloatArray]]) -> tuple[FloatArray, FloatArray]:
    """Return the sizes of the pressing forces (n, frictions) and their derivatives by the frictions (n, frictions, frictions)."""
    forces = [F + (G * q[:, None]).sum(axis=2) for F, G in pressed]
    size = np.stack([np.sqrt((F * F).sum(axis=1)) for F in forces], axis=1)
    slopes = [(F[:, :, None] * G).sum(axis=1) for F, (_, G) in zip(forces, pressed, strict=True)]
    safe = np.where(size > 0.0, size, 1.0)
    return size, np.stack(slopes, axis=1) / safe[:, :, None]
