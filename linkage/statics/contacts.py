"""Where bodies touch, and what each joint can transmit: the columns of the equations of equilibrium."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from ..program import FloatArray
from ..steps import OnLink, YokeDyad
from .poses import Poses, left


@dataclass(frozen=True)
class Contact:
    """A joint: its force acts on the body `on` from the body `by` (indices, -1 the frame), at a point.

    `line` gives its direction: a guide's name, or two points; `step` is the member that declares it.
    """

    kind: str
    point: str
    on: int
    by: int
    line: tuple[str, ...] = ()
    step: str = ""

    @property
    def columns(self) -> int:
        """How many unknowns it brings."""
        return len(CARRIES[self.kind])

    @property
    def has_force(self) -> bool:
        """Whether it transmits a force; a crank's drive has only a couple."""
        return CARRIES[self.kind] != "c"


@dataclass(frozen=True)
class Wrench:
    """A force [N] at a place [m] with a couple [Nm]: shapes (2, n), (2, n), (n,)."""

    at: FloatArray
    force: FloatArray
    couple: FloatArray


#: What a joint carries: forces along x and y, across its line, along its line; a couple.
CARRIES: Mapping[str, str] = MappingProxyType(
    {"pin": "xy", "guide": "n", "slot": "n", "driven": "nt", "crank": "c", "slider": "nc", "telescope": "ntc", "upright": "c"}
)


def wrenches(contact: Contact, poses: Poses, scale: float) -> list[Wrench]:
    """Return the unit wrenches of a contact's unknowns; all unknowns are in N, a couple is `scale` [m] times its own."""
    t = direction(contact, poses)
    right, none = rightwards(poses), np.zeros((2, poses.count))
    forces = {"x": right, "y": left(right), "t": t, "n": left(t), "c": none}
    place = poses.at(contact.point)
    return [Wrench(place, forces[each], none[0] + (scale if each == "c" else 0.0)) for each in CARRIES[contact.kind]]


def rightwards(poses: Poses) -> FloatArray:
    """Return the direction of the x axis, shape (2, n)."""
    return np.stack([np.ones(poses.count), np.zeros(poses.count)])


def direction(contact: Contact, poses: Poses) -> FloatArray:
    """Return the direction of a contact's line, shape (2, n); that of the x axis where it has none."""
    return DIRECTIONS.get(contact.kind, of_line)(contact, poses)


def of_line(contact: Contact, poses: Poses) -> FloatArray:
    """Return the direction of a guide, or from one point to another."""
    if not contact.line:
        return rightwards(poses)
    return poses.along(*contact.line) if len(contact.line) == 2 else poses.line(contact.line[0])[1]


def of_yoke(contact: Contact, poses: Poses) -> FloatArray:
    """Return the direction of a yoke's slot: its guide's, turned."""
    step = poses.plan.members[contact.step]
    assert isinstance(step, YokeDyad)
    return turned(poses.line(step.guide)[1], poses.pair(*poses.reading.turn(step.angle)))


def of_telescope(contact: Contact, poses: Poses) -> FloatArray:
    """Return the direction in which a telescope goes out: that of its body, turned."""
    step = poses.plan.members[contact.step]
    assert isinstance(step, OnLink)
    return turned(poses.along(step.P, step.Q), poses.pair(*step.turn(poses.reading, 1.0)))


def turned(vector: FloatArray, turn: FloatArray) -> FloatArray:
    """Return a vector turned by an angle given as its cosine and sine, shape (2, n)."""
    return np.stack([vector[0] * turn[0] - vector[1] * turn[1], vector[0] * turn[1] + vector[1] * turn[0]])


DIRECTIONS: Mapping[str, Callable[[Contact, Poses], FloatArray]] = MappingProxyType({"slot": of_yoke, "telescope": of_telescope})
