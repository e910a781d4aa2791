"""What is read off the poses: positions, vectors, outputs, angles and distances."""

from __future__ import annotations

from functools import cached_property
from typing import Any, TypeAlias

import numpy as np

from ..errors import DefinitionError, SingularError
from ..plan import ArrayReading
from ..program import FloatArray
from ..quantities import Angle, Distance, Member, Quantity, needs
from ..steps import Arrow, Point
from ..vectors import Vec
from . import reach
from .asked import named
from .places import Places
from .reach import Mask
from .unwrap import unwrapped

Target: TypeAlias = str | Member


class Outputs(Places):
    """The poses, and everything that is read off them by name."""

    def __getitem__(self, name: str) -> FloatArray:
        """Return a point's position or a vector, shape (2, ...) [m], or a quantity, shape (...) [SI]."""
        member = self._known(name)
        name = member.name
        if isinstance(member, Point):
            return self._place(name)
        if isinstance(member, Arrow):
            vector = self._outputs.vector(member)
            return np.array([np.broadcast_to(part, self.shape) for part in (vector.x, vector.y)])
        if isinstance(member, Quantity):
            return self.value(member)
        raise DefinitionError(f"{self.plan.title}: {name} = {member} has no value over the stroke; name a point, a vector or an output.")

    def _place(self, name: str) -> FloatArray:
        if name in self.plan.ground:
            place = self._outputs.at(name)
            return np.array([np.broadcast_to(part, self.shape) for part in (place.x, place.y)], float)
        index = 2 * self.plan.moving.index(name)
        return self._places[index : index + 2]

    @cached_property
    def _outputs(self) -> OutputReading:
        return OutputReading(self)

    def value(self, quantity: Quantity) -> FloatArray:
        """Return a quantity over all poses [SI]; angles without jumps along the stroke."""
        member = self._member(quantity)
        if not isinstance(member, Quantity):
            raise DefinitionError(f'{self.plan.title}: {member.name} is no quantity; ask for motion["{member.name}"].')
        with np.errstate(all="ignore"):
            found = np.broadcast_to(np.asarray(self._outputs.value(member), float), self.shape)
        return self.finite(np.where(self.reached, found, np.nan), np.zeros((), bool), str(member.name or member))

    def finite(self, values: FloatArray, excused: Mask, what: str) -> FloatArray:
        """Return values that are finite at every pose reached; NaN where they are not and NaN was asked for."""
        finite = np.isfinite(values)
        if finite.all():
            return values
        good: Mask = np.asarray(finite if finite.ndim == len(self.shape) else finite.all(axis=0))
        missing = ~good & self.reached & ~excused
        if missing.any() and self.unreachable == "raise":
            where = reach.where_words(self.plan, missing, self.strokes)
            text = f'{what} has no finite value {where}. Leave these poses out, or ask with unreachable="nan".'
            raise SingularError(text, mask=missing, motion=self)
        return np.where(good, values, np.nan)

    def x(self, point: Target) -> FloatArray:
        """Return a point's x coordinate [m]."""
        return np.asarray(self._point(point)[0])

    def y(self, point: Target) -> FloatArray:
        """Return a point's y coordinate [m]."""
        return np.asarray(self._point(point)[1])

    def _point(self, name: Target) -> FloatArray:
        return self._place(named("Point", name, self.plan.points, self.plan.title))

    def _known(self, target: Target) -> Member:
        return self.plan.members[named("Name", target, self.plan.members, self.plan.title)]

    def angle(self, P: Target, Q: Target) -> FloatArray:
        """Return the direction of P -> Q [rad], without jumps along the stroke."""
        self._point(P), self._point(Q)
        return self.value(Angle(P, Q))

    def distance(self, P: Target, Q: Target) -> FloatArray:
        """Return the distance of two points [m]."""
        self._point(P), self._point(Q)
        return self.value(Distance(P, Q))

    def transmission_angle(self, point: Target) -> FloatArray:
        """Return the transmission angle of a dyad's joint [rad], shape (...), 0 to pi; best near pi / 2.

        Between the two links that meet in it (Dyad); between the link and the normal to its guide (SliderDyad: a
        slider-crank's connecting rod and the normal to the slide); between the line to the pin and the normal to the slot
        (PinSlotDyad); between the two guides (GuideCross); between slot and guide (YokeDyad). Its sine is the share of the
        force on the way from link to link that moves the second one. DefinitionError for a point that is no such joint.
        Sources: H. Alt, Werkstattstechnik 26 (1932); S. S. Balli, S. Chand, Mech. Mach. Theory 37 (2002) 175-195.
        """
        name = named("Point", point, self.plan.points, self.plan.title)
        directions = self._meeting(name)
        if not directions:
            raise reach.no_joint(self.plan, name, self.joints)
        u, w = directions
        with np.errstate(all="ignore"):
            angle = np.arctan2(np.abs(u.cross(w)), u.dot(w))
        return np.where(self.reached, np.broadcast_to(angle, self.shape), np.nan)

    @cached_property
    def joints(self) -> tuple[str, ...]:
        """The points that have a transmission angle: the joints of dyads."""
        return tuple(name for name in self.plan.points if self._meeting(name))

    def _meeting(self, name: str) -> tuple[Vec, ...]:
        with np.errstate(all="ignore"):
            return self.plan.points[name].meeting(self._outputs)

    def _member(self, target: Target) -> Member:
        if not isinstance(target, Quantity) or target.name:
            return self._known(target)
        for name in needs(target):
            named("Name", name, self.plan.members, self.plan.title)
        return target


class OutputReading(ArrayReading):
    """A reading of the outputs whose points are where the motion has them, and whose angles do not jump."""

    def __init__(self, motion: Outputs) -> None:
        super().__init__(motion.plan.members, motion.plan.table.lengths, motion.inputs)
        self.axes = [value for value in motion.strokes.values() if value.ndim]
        self.shape = motion.shape
        for name in motion.plan.moving:
            place = motion._place(name)
            self.positions[name] = Vec(place[0], place[1])

    def angle_of(self, vector: Vec) -> Any:
        angle = np.where((vector.x == 0.0) & (vector.y == 0.0), np.nan, np.broadcast_to(np.arctan2(vector.y, vector.x), self.shape))
        return unwrapped(angle, self.axes)
