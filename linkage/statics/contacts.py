"""Where bodies touch, and what each joint can transmit: the columns of the equations of equilibrium."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..program import FloatArray
from ..quantities import Joint
from .poses import Poses, left


@dataclass(frozen=True, eq=False)
class Contact:
    """A joint between two bodies: its force acts on the body `on` from the body `by` (indices, -1 the frame), at a point.

    `holds` are the letters of what it transmits: x, y, n across its line, t along it, c a couple. `owner` is the member that
    declares it, `joint` what that says; `track` the points or the guide of the line it slides on.
    """

    kind: str
    point: str
    on: int
    by: int
    holds: str = "xy"
    owner: str = ""
    joint: Joint | None = None
    track: tuple[str, ...] = ()

    @property
    def columns(self) -> int:
        """How many unknowns it brings."""
        return len(self.holds)

    @property
    def presses(self) -> int:
        """How many of its unknowns make its friction: both components of a pin, the normal one of a guide."""
        return 2 if self.kind == "pin" else 1

    @property
    def has_force(self) -> bool:
        """Whether it transmits a force; a crank's drive has only a couple."""
        return self.holds != "c"

    @property
    def slides(self) -> bool:
        """Whether its point slides along its line."""
        return bool(self.track)

    def goes_by(self, name: str) -> bool:
        """Return whether it is meant by the name of a guide, a step or a point of its line."""
        given = self.joint.track if self.joint is not None else ()
        return name in (self.owner, *self.track, *given)


@dataclass(frozen=True)
class Wrench:
    """A force [N] at a place [m] with a couple [Nm]: shapes (2, n), (2, n), (n,)."""

    at: FloatArray
    force: FloatArray
    couple: FloatArray


def wrenches(contact: Contact, poses: Poses, scale: float) -> list[Wrench]:
    """Return the unit wrenches of a contact's unknowns; all unknowns are in N, a couple is `scale` [m] times its own."""
    right, none = rightwards(poses), np.zeros((2, poses.count))
    forces = {"x": right, "y": left(right), "c": none}
    if set("nt") & set(contact.holds):
        t = direction(contact, poses)
        forces |= {"t": t, "n": left(t)}
    place = poses.at(contact.point)
    return [Wrench(place, forces[each], none[0] + (scale if each == "c" else 0.0)) for each in contact.holds]


def rightwards(poses: Poses) -> FloatArray:
    """Return the direction of the x axis, shape (2, n)."""
    return np.stack([np.ones(poses.count), np.zeros(poses.count)])


def direction(contact: Contact, poses: Poses) -> FloatArray:
    """Return the direction of a contact's line, of length one, shape (2, n)."""
    if contact.joint is None or contact.joint.line is None:
        return rightwards(poses)
    with np.errstate(all="ignore"):
        along = contact.joint.line(poses.reading).direction
    vector = poses.pair(along.x, along.y)
    return np.asarray(vector / np.hypot(vector[0], vector[1]))
