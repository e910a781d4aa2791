"""The joints that rub: which way, at what rate, and the unit wrench of their friction."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..errors import DefinitionError
from ..loads import Friction
from ..program import FloatArray
from .bodies import FRAME
from .contacts import Contact, Wrench, direction
from .poses import Poses, cross, left
from .structure import Structure
from .system import Column

PINS, GUIDES = ("pin",), ("guide", "driven", "slider", "slot")
STILL = 1e-10  # relative turning below this part of the largest in the mechanism is none


@dataclass(frozen=True)
class Rub:
    """A joint that rubs: the unit wrench of its friction, its coefficient (n,), its rate by the stroke (n,), >= 0."""

    column: Column
    coefficient: FloatArray
    rate: FloatArray


class Rates:
    """How bodies turn and points slide while one drive moves by one unit."""

    def __init__(self, structure: Structure, poses: Poses, drive: str) -> None:
        self.structure, self.poses, self.drive = structure, poses, drive

    def axis(self, body: int) -> tuple[str, str] | None:
        """Return the two points farthest apart that turn with a body; None where it does not turn."""
        if body == FRAME or body >= len(self.structure.parts):
            return None
        part = self.structure.parts[body]
        if part.slides:
            return next((self.axis(each.by) for each in self.structure.contacts if each.kind == "slider" and each.on == body), None)
        return part.axis

    def spin(self, body: int) -> FloatArray:
        """Return a body's turning, shape (n,) [rad per unit of the stroke]."""
        axis = self.axis(body)
        if axis is None:
            return np.zeros(self.poses.count)
        arm = self.poses.at(axis[1]) - self.poses.at(axis[0])
        rate = self.poses.rate(axis[1], self.drive) - self.poses.rate(axis[0], self.drive)
        return np.asarray(cross(arm, rate) / (arm[0] ** 2 + arm[1] ** 2))

    def moves(self, body: int, place: FloatArray) -> FloatArray:
        """Return the velocity of a body's material at a place, shape (2, n)."""
        if body == FRAME:
            return np.zeros((2, self.poses.count))
        bodies = len(self.structure.parts)
        start = self.structure.parts[body].points[0] if body < bodies else self.structure.lone[body - bodies]
        return self.poses.rate(start, self.drive) + left(place - self.poses.at(start)) * self.spin(body)


def rubs(structure: Structure, poses: Poses, frictions: tuple[Friction, ...], drive: str, sense: int) -> list[Rub]:
    """Return the rubbing joints while a drive goes on or back."""
    rates = Rates(structure, poses, drive)
    found: list[Rub] = []
    for friction in frictions:
        law, kinds = (turning, PINS) if friction.radius is not None else (sliding, GUIDES)
        there = [each for each in structure.contacts if each.kind in kinds and each.point == friction.point]
        chosen = [each for each in there if not friction.guide or friction.guide in (*each.line, each.step)]
        if not chosen:
            what = "no pin joint" if friction.radius is not None else f"nothing that slides on {friction.guide or 'a guide'}"
            text = f"{structure.plan.title}: there is {what} at {friction.point}: no friction arises; {remedy(structure, friction)}."
            raise DefinitionError(text)
        found += [law(contact, friction, rates, sense) for contact in chosen]
    return found


def remedy(structure: Structure, friction: Friction) -> str:
    """Return what to do about friction where nothing rubs."""
    if friction.radius is None or friction.point not in {point for point, _ in structure.running}:
        return "name another point"
    return f"declare the block that slides there as a body, Link of {friction.point} and a second point on the guide"


def turning(contact: Contact, friction: Friction, rates: Rates, sense: int) -> Rub:
    """Return the friction of a pin: a couple against the turning of its bodies."""
    poses = rates.poses
    rate = (rates.spin(contact.on) - rates.spin(contact.by)) * sense
    largest = max(float(np.max(np.abs(rates.spin(body)), initial=0.0)) for body in range(FRAME, len(rates.structure.parts)))
    sign = np.where(np.abs(rate) > STILL * largest, np.sign(rate), 0.0)
    radius = poses.flat(friction.radius)
    wrench = Wrench(poses.at(contact.point), np.zeros((2, poses.count)), -sign * radius)
    return Rub(Column(contact, wrench), poses.flat(friction.coefficient), radius * np.abs(rate))


def sliding(contact: Contact, friction: Friction, rates: Rates, sense: int) -> Rub:
    """Return the friction on a guide: a force along it against the sliding."""
    poses = rates.poses
    t, place = direction(contact, poses), poses.at(contact.point)
    point, by = poses.rate(contact.point, rates.drive), rates.moves(contact.by, place)
    if contact.kind == "slot":
        point, by = rates.moves(contact.on, place), point
    rate = ((point - by) * t).sum(axis=0) * sense
    size = np.abs(point).max(axis=0) + np.abs(by).max(axis=0)
    sign = np.where(np.abs(rate) > STILL * size, np.sign(rate), 0.0)
    return Rub(Column(contact, Wrench(place, -t * sign, np.zeros(poses.count))), poses.flat(friction.coefficient), np.abs(rate))
