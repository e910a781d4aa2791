"""Friction in joints: which way it acts, and its size, found together with the joint forces that it comes from."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cached_property

import numpy as np

from ..errors import DefinitionError
from ..frozen import record
from ..loads import Friction, Rates
from ..plan import Mask
from ..program import FloatArray
from .joints import FRAME, Contact, Structure, UnitWrench, Wrench, force_direction
from .poses import FlatPoses, cross, quarter_turned

# Friction solved to consistency: the joint forces make it, and it makes the joint forces.
#
# Every joint with friction has a friction q = coefficient * |F|, with F = F0 + G q the force it comes from. Where the coefficients times
# the sizes of G add up to less than 1 in every row, that is a contraction: it has one solution, and plain iteration comes to it. Elsewhere
# the coefficients grow from zero to their value, and Newton's method follows the solution. Where the Jacobian's determinant comes to
# zero on the way the forces grow beyond all bounds: the mechanism jams, or locks itself.


STEPS = 16
ROUNDS = 40
CONTRACTS = 0.7
"""The row sum up to which plain iteration is quick: some 80 rounds to the last digit at the most, mostly 10."""
UNCHANGED = 4e-15
"""A friction that changes by less than this part of the largest stays."""
BLOCK = 1024
SLOWEST = 1e-10
"""Turning slower than this part of the fastest in the mechanism is none."""


def pressing_rows(parts: Sequence[int]) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return the first and the last row of the forces that press each joint with friction: a pin has two `parts`, a guide one.

    The third is what the hypotenuse of both rows counts (frictions, 1): of a single row, counted twice, the half of its square.
    """
    first, counts = np.cumsum([0, *parts[:-1]]), np.asarray(parts)
    return first, first + counts - 1, np.where(counts == 2, 1.0, np.sqrt(0.5))[:, None]


@record
class PressingForces:
    """The forces that make the frictions: without any (rows, n), and by each friction of one unit (rows, frictions, n).

    `parts` are the rows of each friction, one or two; `lever` (frictions, n) says how many units a friction of 1 N is, signed.
    """

    parts: tuple[int, ...]
    free: FloatArray
    by_unit: FloatArray
    lever: FloatArray

    def at(self, places: Mask | slice) -> PressingForces:
        """Return the same at some poses."""
        return PressingForces(self.parts, self.free[:, places], self.by_unit[:, :, places], self.lever[:, places])

    def forces(self, q: FloatArray) -> FloatArray:
        """Return the pressing forces (rows, n) at some frictions (frictions, n) [N]."""
        return np.asarray(np.einsum("rjn,jn->rn", self.by_unit, q * self.lever) + self.free)


def consistent_frictions(pressing: PressingForces, coefficient: FloatArray) -> tuple[FloatArray, Mask]:
    """Return the frictions (frictions, n) [N] for coefficients (frictions, n), and where they have no bounded solution (n,)."""
    q, locked = np.zeros(coefficient.shape), np.zeros(coefficient.shape[1], bool)
    first, last, share = pressing_rows(pressing.parts)
    for start in range(0, coefficient.shape[1], BLOCK):
        block = slice(start, start + BLOCK)
        here, mu = pressing.at(block), coefficient[:, block]
        size = np.hypot(here.by_unit[first], here.by_unit[last]) * share[:, :, None]
        hard = ~(np.max(mu * np.einsum("rjn,jn->rn", size, np.abs(here.lever)), axis=0, initial=0.0) < CONTRACTS)
        if not hard.all():
            with np.errstate(over="ignore", invalid="ignore"):  # of poses that do not contract
                q[:, block] = by_iteration(pressing.parts, mu, here.forces)
        if hard.any():
            q[:, block][:, hard], locked[block][hard] = continued(here.at(hard), mu[:, hard])
    return q, locked


def by_iteration(parts: Sequence[int], coefficient: FloatArray, forces: Callable[[FloatArray], FloatArray]) -> FloatArray:
    """Return the frictions (frictions, n) to which plain iteration comes, where it contracts, with the pressing forces at frictions."""
    first, last, share = pressing_rows(parts)
    q, factor = np.zeros(coefficient.shape), share * coefficient
    for _ in range(100):
        force = forces(q)
        x, y = force[first], force[last]
        new = np.sqrt(x * x + y * y) * factor  # np.hypot costs five times as much
        change, largest = np.abs(new - q), np.max(new, axis=0, initial=0.0)
        q = new
        if not np.any(change > UNCHANGED * largest):
            break
    return q


def continued(pressing: PressingForces, coefficient: FloatArray) -> tuple[FloatArray, Mask]:
    """Return the frictions (frictions, n) that grow from none with the coefficients, NaN where they jam on the way, and where (n,)."""
    free, by_unit = pressing.free.T, np.moveaxis(pressing.by_unit * pressing.lever, -1, 0)
    first, last, _ = pressing_rows(pressing.parts)
    forces = [(free[:, a : b + 1], by_unit[:, a : b + 1]) for a, b in zip(first, last, strict=True)]
    q, alive = np.zeros(coefficient.T.shape), np.ones(coefficient.shape[1], bool)
    for share in np.linspace(0.0, 1.0, STEPS + 1)[1:]:
        q[alive], good = newton(q[alive], share * coefficient.T[alive], [(F[alive], G[alive]) for F, G in forces])
        alive[alive] = good
    return np.where(alive[:, None], q, np.nan).T, ~alive


def newton(q: FloatArray, coefficient: FloatArray, pressing: list[tuple[FloatArray, FloatArray]]) -> tuple[FloatArray, Mask]:
    """Return the frictions for some coefficients, and where Newton's method came to them on the same side of jamming."""
    unit = np.eye(q.shape[1])

    def at(q: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return the sizes of the pressing forces (n, frictions), the residuals, and the Jacobian (n, frictions, frictions)."""
        forces = [F + (G * q[:, None]).sum(axis=2) for F, G in pressing]
        size = np.stack([np.sqrt((F * F).sum(axis=1)) for F in forces], axis=1)
        slopes = [(F[:, :, None] * G).sum(axis=1) for F, (_, G) in zip(forces, pressing, strict=True)]
        slope = np.stack(slopes, axis=1) / np.where(size > 0.0, size, 1.0)[:, :, None]
        return size, q - coefficient * size, unit - coefficient[:, :, None] * slope

    good: Mask = np.ones(len(q), bool)
    for _ in range(ROUNDS):
        _, miss, J = at(q)
        good = np.linalg.det(J) > 0.0
        step = np.linalg.solve(np.where(good[:, None, None], J, unit), -miss[:, :, None])[:, :, 0]
        q = q + np.where(good[:, None], step, 0.0)
        if np.all(np.abs(step[good]) <= 1e-13 * (1.0 + np.abs(q[good]).max(axis=1, keepdims=True))):
            break
    size, miss, J = at(q)
    close = np.abs(miss).max(axis=1) <= 1e-10 * (size.max(axis=1) + np.finfo(float).tiny)
    return q, good & close & (np.linalg.det(J) > 0.0)


# The joints with friction: which way, at what rate, and the unit wrench of their friction.


@record
class JointFriction:
    """A joint with friction: the wrench of a friction of 1 N, its coefficient (n,), its rate by the stroke (n,), >= 0.

    `lever` is the couple [m] on a pin's body, or the force along the guide [1], of that friction, signed (n,).
    """

    unit: UnitWrench
    coefficient: FloatArray
    rate: FloatArray
    lever: FloatArray

    @property
    def contact(self) -> Contact:
        """The joint."""
        return self.unit.contact

    @classmethod
    def of_unit(cls, contact: Contact, poses: FlatPoses) -> JointFriction:
        """Return that of a joint whose size and sense come later. It is a couple of 1 Nm at a pin, a force of 1 N along a guide."""
        none, turns = np.zeros((2, poses.count)), contact.kind == "pin"
        force = none if turns else force_direction(contact, "t", poses)
        return cls(UnitWrench(contact, Wrench(poses.at(contact.point), force, none[0] + float(turns))), none[0], none[0], none[0])


def joint_frictions(structure: Structure, poses: FlatPoses, frictions: tuple[Friction, ...], rates: Rates) -> list[JointFriction]:
    """Return the joints with friction while strokes move; DefinitionError for friction where nothing turns or slides."""
    speeds = Speeds(structure, poses, rates)
    found: list[JointFriction] = []
    for friction in frictions:
        at_point = [each for each in structure.contacts if each.point == friction.point]
        joints = [each for each in at_point if (each.track if friction.radius is None else each.kind == "pin")]
        names = {each: (each.owner, *each.track, *each.joint.track) for each in joints}  # what its line goes by
        joints = [each for each in joints if not friction.guide or friction.guide in names[each]]
        if not joints:
            what = "no pin joint" if friction.radius is not None else f"nothing that slides on {friction.guide or 'a guide'}"
            remedy = "name another point"
            if friction.radius is not None and friction.point in {point for point, _ in structure.running}:
                remedy = f"declare the block that slides there as a body, Link of {friction.point} and a second point on the guide"
            text = f"{structure.plan.title}: there is {what} at {friction.point}: no friction arises; {remedy}."
            raise DefinitionError(text)
        found += [friction_in(contact, friction, speeds) for contact in joints]
    return found


def friction_in(contact: Contact, friction: Friction, speeds: Speeds) -> JointFriction:
    """Return the friction of a joint: of a pin a couple against the turning of its bodies, of a guide a force against the sliding."""
    poses = speeds.poses
    place, none = poses.at(contact.point), np.zeros((2, poses.count))
    coefficient = poses.flattened(friction.coefficient)
    if friction.radius is not None:
        rate = speeds.spin(contact.on) - speeds.spin(contact.by)
        sign = np.where(np.abs(rate) > SLOWEST * speeds.fastest, np.sign(rate), 0.0)
        radius = poses.flattened(friction.radius)
        wrench = Wrench(place, none, -sign * radius)
        return JointFriction(UnitWrench(contact, wrench), coefficient, radius * np.abs(rate), wrench.couple)
    t = force_direction(contact, "t", poses)
    has_slot = contact.joint.on.role == "slider" and contact.point not in contact.joint.on.points  # of the body `on`, as a cross slot
    point, by = speeds.point(contact.point), speeds.material(contact.on if has_slot else contact.by, place, contact)
    if has_slot:
        point, by = by, point
    rate = ((point - by) * t).sum(axis=0)
    sign = np.where(np.abs(rate) > SLOWEST * (np.abs(point).max(axis=0) + np.abs(by).max(axis=0)), np.sign(rate), 0.0)
    return JointFriction(UnitWrench(contact, Wrench(place, -t * sign, none[0])), coefficient, np.abs(rate), -sign)


class Speeds:
    """How bodies turn and points slide while strokes move."""

    def __init__(self, structure: Structure, poses: FlatPoses, rates: Rates) -> None:
        self.structure, self.poses = structure, poses
        self.rates = {name: poses.flattened(rate) for name, rate in rates.items()}
        self._points: dict[str, FloatArray] = {}
        self._spins: dict[int, FloatArray] = {}

    def point(self, name: str) -> FloatArray:
        """Return a point's velocity, shape (2, n) [m/s, or per unit of the drive]."""
        if name not in self._points:
            parts = [self.poses.rate(name, stroke) * rate for stroke, rate in self.rates.items()]
            self._points[name] = sum(parts, np.zeros((2, self.poses.count)))
        return self._points[name]

    def material(self, body: int, place: FloatArray, contact: Contact) -> FloatArray:
        """Return the velocity of a body's material at a place, shape (2, n): of a cylinder on the side that a contact goes with."""
        if body == FRAME:
            return np.zeros((2, self.poses.count))
        bodies = len(self.structure.bodies)
        start = self.structure.bodies[body].points[0] if body < bodies else self.structure.lone[body - bodies]
        if any(each.host and self.structure.body_of(each) == body for each in self.structure.struts):
            start = self.structure.seat(contact, body)
        return self.point(start) + quarter_turned(place - self.poses.at(start)) * self.spin(body)

    def spin(self, body: int) -> FloatArray:
        """Return a body's angular velocity, shape (n,) [rad/s, or per unit of the drive]."""
        if body not in self._spins:
            axis, self._spins[body] = self.axis(body), np.zeros(self.poses.count)
            if axis is not None:
                arm, rate = (at(axis[1]) - at(axis[0]) for at in (self.poses.at, self.point))
                self._spins[body] = np.asarray(cross(arm, rate) / (arm[0] ** 2 + arm[1] ** 2))
        return self._spins[body]

    @cached_property
    def fastest(self) -> float:
        """The largest turning of any body at any pose."""
        return max(float(np.max(np.abs(self.spin(body)), initial=0.0)) for body in range(FRAME, len(self.structure.bodies)))

    def axis(self, body: int) -> tuple[str, str] | None:
        """Return two points that turn with a body, or with its track where it slides without turning; None if neither turns."""
        if body == FRAME or body >= len(self.structure.bodies):
            return None
        if self.structure.bodies[body].slides:
            return next((self.axis(each.by) for each in self.structure.contacts if "c" in each.holds and each.on == body), None)
        return self.structure.bodies[body].axis
