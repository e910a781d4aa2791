"""Joints that a step, a guide or a force element brings, beside the pins of bodies that share a point.

Statics, mobility and drawing read these and know no kind of member by its name. Bodies that share a point are pinned to each
other there without a word; a joint says what else is transmitted: across a guide, along a driven length, a drive's couple.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal, TypeAlias

from ..frozen import immutable, record
from ..vectors import Line, Scalar
from .member import Member, Where
from .quantity import Quantity

Role: TypeAlias = Literal["body", "runner", "slider", "guide", "own"]


@record
class JointSide:
    """One of the two bodies of a joint, by the points or the guide that belong to it.

    The "body" is that of its points; for a single point the one that carries the pin, without points the frame. The "runner" is the one
    that runs on the joint's track at the point. The "slider" is one of its own at the point, which moves without turning. The "guide" is
    the one that carries a guide. The word "own" is the member itself, such as a spring.
    """

    points: tuple[str, ...] = ()
    role: Role = "body"


FRAME_SIDE = JointSide()


@record
class Driven:
    """A quantity that a joint drives: the force along `along` (a letter of its directions) is conjugate to `sign` times it."""

    quantity: Quantity
    along: str
    sign: float = 1.0


@immutable
class Joint:
    """A joint at a point, by which the body `by` holds the body `on` in the directions `holds`.

    `holds` are letters: x, y (a pin), n across the joint's line, t along it, c a couple. `line` gives the line in a reading. The force acts
    at the line's origin, such as the mesh of two gears, whatever point names the joint; without a line, and where the point runs on the
    line ("runner"), at the point. `track` tells equal lines: a guide's name, or the two points of a slot's body, sorted. A joint with
    `drives` is there while one of them follows a stroke; an `arm` then leaves the body it is measured on. `still` must not follow a
    stroke, in words. A contact `pushes`: the force across its line acts to the left of it alone, and where it would have to pull the
    bodies come apart.
    """

    kind: str
    point: str
    on: JointSide
    by: JointSide
    holds: str
    line: Callable[[Where], Line] | None = None
    track: tuple[str, ...] = ()
    drives: tuple[Driven, ...] = ()
    arm: bool = False
    still: tuple[tuple[Quantity, str], ...] = ()
    pushes: bool = False

    @property
    def is_half(self) -> bool:
        """Whether it takes one freedom of two bodies, or of a point: a guide, a slot, a contact."""
        return "n" in self.holds and not self.arm


class Jointed(Member):
    """A member that may hold others: a step, a guide, a force element."""

    def joints(self) -> tuple[Joint, ...]:
        """Return the joints it brings, beside the pins of bodies that share a point.

        Returns
        -------
        tuple of Joint
            The joints.
        """
        return ()

    def constraints(self, where: Where) -> tuple[Scalar, ...]:
        """Return the residuals that vanish where the joint holds, in every reading; empty for a free construction."""
        return ()


def pinned(point: str) -> Joint:
    """Return the pin by which a member that is a body of its own hangs on a point."""
    return Joint("pin", point, JointSide((point,), "own"), JointSide((point,)), "xy")


def guided(point: str, guide: str) -> Joint:
    """Return the joint of a point that slides on a guide."""
    on, by = JointSide((point,), "runner"), JointSide((guide,), "guide")
    return Joint("guide", point, on, by, "n", lambda where: where.line(guide), (guide,))
