"""Where everything is, over designs and strokes; and what follows from it."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from functools import cached_property
from typing import Any, TypeAlias

import numpy as np

from ..errors import DefinitionError, SingularWarning, unknown
from ..plan import ArrayReading, Plan
from ..program import FloatArray
from ..quantities import Angle, Distance, Member, Quantity
from ..steps import Arrow, Dyad, Point
from ..vectors import Vec
from . import numeric, reach, singular
from .reach import Mask
from .unwrap import unwrapped

Target: TypeAlias = str | Member


class Motion:
    """The poses of a mechanism: all positions, worked out at once; ratios and outputs when asked.

    Arrays are component-first, designs before strokes: a position has the shape (2, *designs, *strokes).
    Raises AssemblyError where a pose cannot be assembled, unless `unreachable="nan"`.
    """

    def __init__(self, plan: Plan, designs: Mapping[str, Any], strokes: Mapping[str, FloatArray], unreachable: str = "raise") -> None:
        if unreachable not in ("raise", "nan"):
            raise DefinitionError(f'unreachable={unreachable!r}: say "raise" or "nan".')
        self.plan, self.designs, self.strokes, self.unreachable = plan, dict(designs), dict(strokes), unreachable
        arrays = [np.shape(value) for value in self.designs.values() if np.ndim(value)]
        try:
            self.design_shape = np.broadcast_shapes(*arrays)
        except ValueError:
            shapes = ", ".join(map(str, arrays))
            raise DefinitionError(f"{plan.title}: the shapes of the design arrays do not fit each other: {shapes}.") from None
        self.stroke_shape = next((value.shape for value in self.strokes.values()), ())
        self.shape = (*self.design_shape, *self.stroke_shape)
        self.reached: Mask = np.ones(self.shape, bool)
        self._ratios: dict[Any, FloatArray] = {}
        result = plan.kernel(plan.moving, guarded=True)(self._flat)
        self._places = self._full(result.values)
        self.is_near_singular = bool(np.any(result.guards < 0.0)) or bool(np.isnan(result.guards).any())
        if np.isnan(result.guards).any():
            self._settle_unreached()

    # -- inputs ----------------------------------------------------------------------------------------

    @cached_property
    def _flat(self) -> dict[str, Any]:
        """The inputs as a kernel takes them: designs (m,), poses (n,)."""
        flat: dict[str, Any] = {}
        for name, value in self.designs.items():
            flat[name] = np.broadcast_to(value, self.design_shape).ravel() if np.ndim(value) else float(value)
        return flat | {name: value.ravel() for name, value in self.strokes.items()}

    @cached_property
    def inputs(self) -> dict[str, Any]:
        """The inputs shaped to broadcast against results: designs first, strokes last."""
        tail = (1,) * len(self.stroke_shape)
        shaped = {name: np.reshape(value, np.shape(value) + tail) if np.ndim(value) else value for name, value in self.designs.items()}
        return shaped | dict(self.strokes)

    def _full(self, values: FloatArray) -> FloatArray:
        """Return a kernel's values in the motion's shape."""
        m, n = int(np.prod(self.design_shape, dtype=int)), int(np.prod(self.stroke_shape, dtype=int))
        if values.shape[1:] != (m, n):
            values = np.broadcast_to(values, (len(values), m, n))
        return values.reshape(len(values), *self.shape)

    # -- reach -----------------------------------------------------------------------------------------

    def _settle_unreached(self) -> None:
        """Place the poses at a dead point, to rounding; refuse or mask those out of reach."""
        failed: Mask = np.asarray(np.isnan(self._places).any(axis=0)) if len(self._places) else np.ones(self.shape, bool)
        reading = self._read_at(failed)
        lost = np.zeros(int(failed.sum()), bool)
        for sine in reading.sines.values():
            lost |= np.isnan(sine)
        self._places = np.array(self._places)
        for index, name in enumerate(self.plan.moving):
            place = reading.at(name)
            for axis, part in enumerate((place.x, place.y)):
                self._places[2 * index + axis, ...][failed] = np.where(lost, np.nan, part)
        self.reached[failed] = ~lost
        if self.unreachable == "raise" and lost.any():
            raise reach.refusal(self.plan, self._read_at(~self.reached), ~self.reached, self.strokes)

    def _read_at(self, mask: Mask) -> ArrayReading:
        """Return the eager reading of some poses."""
        with np.errstate(all="ignore"):
            return self.plan.read({name: np.broadcast_to(value, self.shape)[mask] for name, value in self.inputs.items()})

    # -- positions and outputs -------------------------------------------------------------------------

    def __getitem__(self, name: str) -> FloatArray:
        """Return a point's position or a vector, shape (2, ...) [m], or a quantity, shape (...) [SI]."""
        if name not in self.plan.members:
            raise unknown("Name", str(name), self.plan.named(), where=self.plan.title)
        member = self.plan.members[name]
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
    def _outputs(self) -> _Outputs:
        return _Outputs(self)

    def value(self, quantity: Quantity) -> FloatArray:
        """Return a quantity over all poses [SI]; angles without jumps along the stroke."""
        with np.errstate(all="ignore"):
            found = np.broadcast_to(np.asarray(self._outputs.value(quantity), float), self.shape)
        return np.where(self.reached, found, np.nan)

    def x(self, point: str) -> FloatArray:
        """Return a point's x coordinate [m]."""
        return np.asarray(self._point(point)[0])

    def y(self, point: str) -> FloatArray:
        """Return a point's y coordinate [m]."""
        return np.asarray(self._point(point)[1])

    def _point(self, name: str) -> FloatArray:
        if name not in self.plan.points:
            raise unknown("Point", name, self.plan.points, where=self.plan.title)
        return self._place(name)

    def angle(self, P: str, Q: str) -> FloatArray:
        """Return the direction of P -> Q [rad], without jumps along the stroke."""
        self._point(P), self._point(Q)
        return self.value(Angle(P, Q))

    def distance(self, P: str, Q: str) -> FloatArray:
        """Return the distance of two points [m]."""
        self._point(P), self._point(Q)
        return self.value(Distance(P, Q))

    def transmission_angle(self, point: str) -> FloatArray:
        """Return the angle between the two links that meet in a dyad's joint [rad], 0 to pi; best near pi / 2."""
        self._point(point)
        step = self.plan.points[point]
        if not isinstance(step, Dyad):
            joints = [name for name, each in self.plan.points.items() if isinstance(each, Dyad)]
            raise DefinitionError(f"{self.plan.title}: {point} is not the joint of a dyad; those are: {', '.join(joints) or 'none'}.")
        (ux, uy), (wx, wy) = self._place(step.P) - self._place(point), self._place(step.Q) - self._place(point)
        return np.asarray(np.arctan2(np.abs(ux * wy - uy * wx), ux * wx + uy * wy))

    # -- ratios ----------------------------------------------------------------------------------------

    def ratio(
        self, target: Target, *, wrt: str | None = None, order: int = 1, method: str = "exact", step: float | None = None
    ) -> FloatArray:
        """Return the derivative of a point or an output by a stroke: the transfer ratio (velocity analogue).

        `order=2` gives the second derivative. `method="central"` differentiates numerically, with the step chosen
        at every pose, or given as `step` [unit of the stroke]. Shape (2, ...) for a point, (...) for an output.
        Raises SingularError at a dead point; warns near one.
        """
        stroke = self._stroke(wrt)
        if order not in (1, 2):
            raise DefinitionError(f"order={order!r}: derivatives of order 1 and 2 are provided.")
        if method not in ("exact", "central"):
            raise DefinitionError(f'method={method!r}: say "exact" or "central".')
        member = self._member(target)
        refused = self._singular(member, f"The ratio of {member.name or member}")
        found = self._exact(member, (stroke,) * order) if method == "exact" else self._numeric(member, stroke, order, step)
        return np.where(refused, np.nan, found) if refused.any() else found

    def _stroke(self, wrt: str | None) -> str:
        if wrt is None and len(self.strokes) == 1:
            return next(iter(self.strokes))
        if wrt is None:
            raise DefinitionError(f"{self.plan.title} has {len(self.strokes)} strokes: say wrt= one of {', '.join(self.strokes)}.")
        if wrt not in self.strokes:
            raise unknown("Stroke", wrt, self.strokes, where=self.plan.title)
        return wrt

    def _member(self, target: Target) -> Member:
        if isinstance(target, str) or target.name in self.plan.members:
            name = target if isinstance(target, str) else target.name
            if name not in self.plan.members:
                raise unknown("Name", name, self.plan.named(), where=self.plan.title)
            return self.plan.members[name]
        return target

    def _exact(self, member: Member, along: tuple[str, ...]) -> FloatArray:
        """Return a derivative through the program; the first derivatives of all points come in one pass, kept."""
        if isinstance(member, Point) and member.name in self.plan.ground:
            return np.zeros((2, *self.shape))
        pass_of_all = isinstance(member, Point)
        targets: tuple[Any, ...] = self.plan.moving if pass_of_all else (member.name or member,)
        key = (targets, along)
        if key not in self._ratios:
            self._ratios[key] = self._full(self.plan.kernel(targets, along)(self._flat).values)
        values = self._ratios[key]
        if not self.reached.all():
            values = np.where(self.reached, values, np.nan)
        if pass_of_all:
            index = 2 * self.plan.moving.index(member.name)
            return values[index : index + 2]
        return values if isinstance(member, Arrow) else values[0]

    def _numeric(self, member: Member, stroke: str, order: int, step: float | None) -> FloatArray:
        def values(offsets: FloatArray) -> FloatArray:
            shifted = {name: value[..., None] + (offsets if name == stroke else 0.0 * offsets) for name, value in self.strokes.items()}
            near = Motion(self.plan, self.designs, shifted, "nan")
            return near[member.name] if member.name else near.value(member)  # type: ignore[arg-type]

        declared = self.plan.strokes[stroke]
        found, error = numeric.derivative(values, abs(declared.end - declared.start), order, step)
        size = float(np.nanmax(np.abs(found), initial=0.0))
        lost = float(np.nanmax(np.where(np.isfinite(error), error, 0.0), initial=0.0))
        if size and lost > 1e-6 * size:
            what = f"The numerical ratio of {member.name or member} is off by up to about {lost:.0e}; the exact one is not."
            warnings.warn(what, SingularWarning, stacklevel=3)
        return found

    def _singular(self, member: Member, what: str) -> Mask:
        """Return the mask of poses where a ratio is refused; raise or warn as asked."""
        nothing = np.zeros(self.shape, bool)
        if not self.is_near_singular:
            return nothing
        names = self.plan.reaches(member.name) if member.name else self.plan.reaches(member)
        found = {name: np.where(self.reached, cond, np.nan) for name, cond in singular.conditions(self.plan, self._reading, names).items()}
        refused = singular.refused(self.plan, found, self.shape)
        if refused.any() and self.unreachable == "raise":
            raise singular.refusal(self.plan, found, refused, self.strokes, what, self)
        singular.warn(self.plan, found, self.strokes, what)
        return refused

    @cached_property
    def _reading(self) -> ArrayReading:
        with np.errstate(all="ignore"):
            return self.plan.read(self.inputs)

    # -- velocity --------------------------------------------------------------------------------------

    def velocity(self, target: Target, rates: Mapping[str, Any]) -> FloatArray:
        """Return the velocity of a point [m/s], shape (2, ...), or the rate of an output, from stroke rates [1/s]."""
        self._rates(rates)
        return sum((self.ratio(target, wrt=name) * rate for name, rate in rates.items()), np.zeros(self.shape))

    def acceleration(self, target: Target, rates: Mapping[str, Any], accelerations: Mapping[str, Any] | None = None) -> FloatArray:
        """Return the acceleration of a point [m/s2], shape (2, ...), from stroke rates and accelerations."""
        driven = dict(accelerations or {})
        self._rates(rates)
        self._rates(driven)
        member = self._member(target)
        refused = self._singular(member, f"The acceleration of {member.name or member}")
        total = sum((self.ratio(target, wrt=name) * value for name, value in driven.items()), np.zeros(self.shape))
        for first, u in rates.items():
            for second, v in rates.items():
                total = total + self._exact(member, tuple(sorted((first, second)))) * u * v
        return np.where(refused, np.nan, total)

    def _rates(self, rates: Mapping[str, Any]) -> None:
        for name in rates:
            self._stroke(name)


class _Outputs(ArrayReading):
    """A reading of the outputs whose points are where the motion has them, and whose angles do not jump."""

    def __init__(self, motion: Motion) -> None:
        super().__init__(motion.plan.members, motion.plan.table.lengths, motion.inputs)
        self.axes = [value for value in motion.strokes.values() if value.ndim]
        self.shape = motion.shape
        for name in motion.plan.moving:
            place = motion._place(name)
            self.positions[name] = Vec(place[0], place[1])

    def angle_of(self, vector: Vec) -> Any:
        angle = np.broadcast_to(np.arctan2(vector.y, vector.x), self.shape)
        return unwrapped(angle, self.axes)
