"""Friction solved to consistency: the joint forces make it, and it makes the joint forces.

Every rubbing joint has a friction q = coefficient * |F|, with F = F0 + G q the force it comes from. Where the coefficients times the
sizes of G add up to less than 1 in every row, that is a contraction: it has one solution, and plain iteration comes to it. Elsewhere
the coefficients grow from zero to their value, and Newton's method follows the solution. Where the Jacobian's determinant comes to
zero on the way the forces grow beyond all bounds: the mechanism jams, or locks itself.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..errors import DefinitionError
from ..loads import Friction
from ..motion.limits import Mask
from ..program import FloatArray
from .acting import Movement
from .bodies import FRAME
from .equilibrium import Column
from .joints import Contact, Structure, Wrench, direction
from .poses import Poses, cross, left

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


# The joints that rub: which way, at what rate, and the unit wrench of their friction.

STILL = 1e-10  # relative turning below this part of the largest in the mechanism is none


@dataclass(frozen=True)
class Rub:
    """A joint that rubs: the wrench of a friction of 1 N, its coefficient (n,), its rate by the stroke (n,), >= 0.

    `lever` is the couple [m] on a pin's body, or the force along the guide [1], of that friction, signed (n,).
    """

    column: Column
    coefficient: FloatArray
    rate: FloatArray
    lever: FloatArray


class Rates:
    """How bodies turn and points slide while strokes move."""

    def __init__(self, structure: Structure, poses: Poses, movement: Movement) -> None:
        self.structure, self.poses = structure, poses
        self.rates = {name: poses.flat(rate) for name, rate in movement.rates.items()}
        self._points: dict[str, FloatArray] = {}
        self._spins: dict[int, FloatArray] = {}

    def rate(self, point: str) -> FloatArray:
        """Return a point's velocity, shape (2, n) [m/s, or per unit of what moves]."""
        if point not in self._points:
            parts = [self.poses.rate(point, name) * rate for name, rate in self.rates.items()]
            self._points[point] = sum(parts, np.zeros((2, self.poses.count)))
        return self._points[point]

    def axis(self, body: int) -> tuple[str, str] | None:
        """Return the two points farthest apart that turn with a body; None where it does not turn."""
        if body == FRAME or body >= len(self.structure.parts):
            return None
        part = self.structure.parts[body]
        if part.slides:
            return next((self.axis(each.by) for each in self.structure.contacts if each.kind == "slider" and each.on == body), None)
        return part.axis

    def spin(self, body: int) -> FloatArray:
        """Return a body's turning, shape (n,) [rad/s, or per unit of what moves]."""
        if body not in self._spins:
            self._spins[body] = self._spin(body)
        return self._spins[body]

    @cached_property
    def fastest(self) -> float:
        """The largest turning of any body at any pose."""
        return max(float(np.max(np.abs(self.spin(body)), initial=0.0)) for body in range(FRAME, len(self.structure.parts)))

    def _spin(self, body: int) -> FloatArray:
        axis = self.axis(body)
        if axis is None:
            return np.zeros(self.poses.count)
        arm = self.poses.at(axis[1]) - self.poses.at(axis[0])
        rate = self.rate(axis[1]) - self.rate(axis[0])
        return np.asarray(cross(arm, rate) / (arm[0] ** 2 + arm[1] ** 2))

    def moves(self, body: int, place: FloatArray) -> FloatArray:
        """Return the velocity of a body's material at a place, shape (2, n)."""
        if body == FRAME:
            return np.zeros((2, self.poses.count))
        bodies = len(self.structure.parts)
        start = self.structure.parts[body].points[0] if body < bodies else self.structure.lone[body - bodies]
        return self.rate(start) + left(place - self.poses.at(start)) * self.spin(body)


def rubs(structure: Structure, poses: Poses, frictions: tuple[Friction, ...], movement: Movement) -> list[Rub]:
    """Return the rubbing joints while strokes move."""
    rates = Rates(structure, poses, movement)
    found: list[Rub] = []
    for friction in frictions:
        turns = friction.radius is not None
        law = turning if turns else sliding
        there = [each for each in structure.contacts if each.point == friction.point and (each.kind == "pin" if turns else each.slides)]
        chosen = [each for each in there if not friction.guide or each.goes_by(friction.guide)]
        if not chosen:
            what = "no pin joint" if friction.radius is not None else f"nothing that slides on {friction.guide or 'a guide'}"
            text = f"{structure.plan.title}: there is {what} at {friction.point}: no friction arises; {remedy(structure, friction)}."
            raise DefinitionError(text)
        found += [law(contact, friction, rates) for contact in chosen]
    return found


def remedy(structure: Structure, friction: Friction) -> str:
    """Return what to do about friction where nothing rubs."""
    if friction.radius is None or friction.point not in {point for point, _ in structure.running}:
        return "name another point"
    return f"declare the block that slides there as a body, Link of {friction.point} and a second point on the guide"


def turning(contact: Contact, friction: Friction, rates: Rates) -> Rub:
    """Return the friction of a pin: a couple against the turning of its bodies."""
    poses = rates.poses
    rate = rates.spin(contact.on) - rates.spin(contact.by)
    sign = np.where(np.abs(rate) > STILL * rates.fastest, np.sign(rate), 0.0)
    radius = poses.flat(friction.radius)
    wrench = Wrench(poses.at(contact.point), np.zeros((2, poses.count)), -sign * radius)
    return Rub(Column(contact, wrench), poses.flat(friction.coefficient), radius * np.abs(rate), wrench.couple)


def sliding(contact: Contact, friction: Friction, rates: Rates) -> Rub:
    """Return the friction on a guide: a force along it against the sliding."""
    poses = rates.poses
    t, place = direction(contact, poses), poses.at(contact.point)
    point, by = rates.rate(contact.point), rates.moves(contact.by, place)
    if contact.kind == "slot":
        point, by = rates.moves(contact.on, place), point
    rate = ((point - by) * t).sum(axis=0)
    size = np.abs(point).max(axis=0) + np.abs(by).max(axis=0)
    sign = np.where(np.abs(rate) > STILL * size, np.sign(rate), 0.0)
    wrench = Wrench(place, -t * sign, np.zeros(poses.count))
    return Rub(Column(contact, wrench), poses.flat(friction.coefficient), np.abs(rate), -sign)


def unit_friction(contact: Contact, poses: Poses) -> Column:
    """Return a couple of 1 Nm at a pin, or a force of 1 N along a guide: the friction of a joint, of either sign."""
    none = np.zeros(poses.count)
    if contact.kind == "pin":
        return Column(contact, Wrench(poses.at(contact.point), np.zeros((2, poses.count)), none + 1.0))
    return Column(contact, Wrench(poses.at(contact.point), direction(contact, poses), none))
