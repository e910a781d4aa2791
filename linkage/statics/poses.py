"""The poses at which forces can be worked out, one after the other: (2, n) for a point, (n,) for a number."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping
from copy import copy
from typing import Protocol, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from ..errors import DefinitionError, cited, unwarned
from ..loads import Poses, require_poses
from ..motion import Motion, Request
from ..motion.requests import point_ratios
from ..plan import Mask, Plan, Reading
from ..program import FloatArray
from ..quantities import Member, Reference
from ..vectors import Scalar

Made = TypeVar("Made")
Own = TypeVar("Own", bound=Member)


class FlatPoses:
    """The poses of a motion that are reached and not singular, flat; forces of the others are NaN.

    `names` are the members that the forces depend on, all where it is None. Raises SingularError at a singular pose unless the
    motion was asked for with `unreachable="nan"`; warns near one. The policy is that of the transfer ratios.
    """

    def __init__(self, motion: AnyMotion, what: str, names: set[str] | None = None) -> None:
        self.motion, self.plan = motion, motion.plan
        behind = frozenset(self.plan.members if names is None else names)
        self.good: Mask = motion.reached & ~motion._refused(point_ratios(behind), what)
        self.count = int(self.good.sum())
        self._kept: dict[tuple[str, ...], FloatArray] = {}

    def without(self, lost: Mask) -> FlatPoses:
        """Return the poses that a mask (n,) leaves."""
        left = copy(self)
        left.good = np.array(self.good)  # of a single pose a number, which takes no item
        left.good[self.good] = ~lost
        left.count = int(left.good.sum())
        left._kept = {}
        return left

    @property
    def is_whole(self) -> bool:
        """Whether these are all poses of the motion, of which there are some."""
        return self.count == self.good.size > 0

    def zeros(self, *shape: int) -> FloatArray:
        """Return zeros to write results into, shape (n, *shape)."""
        return self.motion._array(np.zeros((self.count, *shape)))

    def flattened(self, values: ArrayLike) -> FloatArray:
        """Return values over the motion, shape (..., *shape) or broadcast to it, as (..., n)."""
        array = self.motion._array(values)
        lead = array.shape[: max(0, array.ndim - len(self.motion.shape))]
        whole = np.broadcast_to(array, (*lead, *self.motion.shape))
        return whole.reshape((*lead, self.count)) if self.is_whole else np.asarray(whole[..., self.good])

    def full(self, values: FloatArray) -> FloatArray:
        """Return values (..., n) in the motion's shape, NaN at the other poses."""
        if self.is_whole:
            return np.broadcast_to(values, (*values.shape[:-1], self.count)).reshape((*values.shape[:-1], *self.motion.shape))
        result = np.full((*values.shape[:-1], *self.motion.shape), np.nan)
        result[..., self.good] = values
        return result

    def mask(self, where: Mask) -> Mask:
        """Return a mask (n,) in the motion's shape, false at the other poses."""
        return np.asarray(self.full(where.astype(float)) == 1.0)

    def at(self, point: str) -> FloatArray:
        """Return a point's position, shape (2, n) [m]."""
        if (point,) not in self._kept:
            place = self.motion._placed.at(point) if point in self.plan.ground else None
            self._kept[(point,)] = self.flattened(self.motion[point]) if place is None else self.stacked(place.x, place.y)
        return self._kept[(point,)]

    def ratio(self, target: Reference, drive: str) -> FloatArray:
        """Return the ratio of a point (2, n) or a quantity (n,); poses near singular ones have been reported already."""
        with unwarned():
            return self.flattened(self.motion.ratio(target, wrt=drive))

    def rate(self, point: str, drive: str) -> FloatArray:
        """Return a point's transfer ratio, shape (2, n), worked out once."""
        if (point, drive) not in self._kept:
            self._kept[point, drive] = self.ratio(point, drive)
        return self._kept[point, drive]

    def growth(self, P: str, Q: str, drive: str) -> FloatArray:
        """Return how the distance of two points grows with a stroke, shape (n,), worked out once; 0 where they coincide."""
        if (P, Q, drive) not in self._kept:
            arm = self.at(Q) - self.at(P)
            rate = self.rate(Q, drive) - self.rate(P, drive)
            self._kept[P, Q, drive] = np.asarray((arm * rate).sum(axis=0) / over_zero(np.hypot(arm[0], arm[1])))
        return self._kept[P, Q, drive]

    def stacked(self, x: Scalar, y: Scalar) -> FloatArray:
        """Return two parts of a vector as (2, n)."""
        return np.stack([self.flattened(x), self.flattened(y)])


class AnyMotion(Poses, Protocol):
    """A motion as statics reads it, beyond the readings of force elements: everything known at its poses."""

    @property
    def plan(self) -> Plan: ...

    @property
    def strokes(self) -> Mapping[str, FloatArray]:
        """The strokes by name."""

    @property
    def tangent(self) -> Mapping[str, FloatArray] | None:
        """How several strokes go on along a path of poses; None where the poses are no path."""

    @property
    def rates(self) -> Mapping[str, FloatArray]:
        """The rates of the strokes over a path in time, by name; empty of any other motion."""

    @property
    def accelerations(self) -> Mapping[str, FloatArray]:
        """The accelerations of the strokes over a path in time, by name; empty of any other motion."""

    @property
    def reached(self) -> Mask:
        """The mask of the poses that are reached."""

    @property
    def unreachable(self) -> str:
        """The treatment of other poses: "raise" or "nan"."""

    @property
    def _placed(self) -> Reading:
        """Every rule of the plan read at the poses, whose points are where the motion has them."""

    def _refused(self, what: Request, words: str) -> Mask:
        """Return the mask of poses where a result is refused; raise or warn as asked."""

    def _array(self, values: ArrayLike) -> FloatArray:
        """Return numbers as the arrays it works with."""

    def _once(self, key: Hashable, make: Callable[[], Made]) -> Made:
        """Return a shared result, made once."""


def plan_of(motion: Poses) -> Plan:
    """Return the plan of the motion that a law of force is asked for; DefinitionError for anything but a motion of a mechanism."""
    require_poses(motion)
    if not isinstance(motion.plan, Plan):
        raise DefinitionError(f"{cited(motion)} is no motion of a mechanism; give machine.sweep(...) or machine.at(...).")
    return motion.plan


def motion_of_whole(motion: AnyMotion, member: Own) -> tuple[Motion, Own] | None:
    """Return the motion of the whole and the member there, of a motion that is read as that of a part; None for any other."""
    return motion._of_the_whole(member) if isinstance(motion, Motion) else None


def over_zero(length: FloatArray) -> FloatArray:
    """Return lengths to divide by, 1 in the place of none; numbers of a program as they are."""
    return length if length.dtype == object else np.where(length == 0.0, 1.0, length)


def quarter_turned(vector: FloatArray) -> FloatArray:
    """Return a vector turned by +90 degrees, shape (2, n)."""
    return np.stack([-vector[1], vector[0]])


def cross(a: FloatArray, b: FloatArray) -> FloatArray:
    """Return the z component of the vector product, shape (n,)."""
    return np.asarray(a[0] * b[1] - a[1] * b[0])
