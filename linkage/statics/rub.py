"""The joints that rub: which way, at what rate, and the unit wrench of their friction."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..errors import DefinitionError
from ..loads import Friction
from ..program import FloatArray
from .bodies import FRAME
from .contacts import Contact, Wrench, direction
from .movement import Movement
from .poses import Poses, cross, left
from .structure import Structure
from .system import Column

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
