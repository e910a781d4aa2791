"""Where everything is, over designs and strokes; and what follows from it."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from functools import cached_property
from typing import Any, TypeAlias

import numpy as np

from ..assembly import Solved, solve_groups
from ..errors import DefinitionError, SingularError, SingularWarning
from ..plan import ArrayReading, Plan
from ..program import FloatArray
from ..quantities import Angle, Distance, Member, Quantity
from ..steps import Arrow, Dyad, Point
from ..vectors import Vec
from . import numeric, reach, scan, singular
from .asked import method_of, named, order_of, rates_of
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
        self.is_near_singular = not np.all(result.guards > 0.0)
        if self.is_near_singular or plan.may_overflow:
            self._settle_unreached()
        if unreachable == "raise" and scan.is_watched(self):
            scan.refuse_crossing(self)

    # -- inputs ----------------------------------------------------------------------------------------

    @cached_property
    def _flat(self) -> dict[str, Any]:
        """The inputs as a kernel takes them: designs (m,), poses (n,)."""
        flat: dict[str, Any] = {}
        for name, value in self.designs.items():
            flat[name] = np.broadcast_to(value, self.design_shape).ravel() if np.ndim(value) else float(value)
        flat |= {name: value.ravel() for name, value in self.strokes.items()}
        return flat | dict(self._solved.inputs)

    @cached_property
    def _solved(self) -> Solved:
        """The pins of groups, shape (m, n)."""
        if not self.plan.groups:
            return Solved({}, np.zeros((1, 1), bool))
        designs = {name: np.broadcast_to(value, self.design_shape).ravel() if np.ndim(value) else value for name, value in self.designs.items()}
        return solve_groups(self.plan, designs, {name: value.ravel() for name, value in self.strokes.items()})

    @cached_property
    def inputs(self) -> dict[str, Any]:
        """The inputs shaped to broadcast against results: designs first, strokes last."""
        tail = (1,) * len(self.stroke_shape)
        shaped = {name: np.reshape(value, np.shape(value) + tail) if np.ndim(value) else value for name, value in self.designs.items()}
        solved = {name: self._full(value[None])[0] for name, value in self._solved.inputs.items()}
        shaped = {name: np.float64(value) if np.ndim(value) == 0 else value for name, value in shaped.items()}
        return shaped | dict(self.strokes) | solved

    def _full(self, values: FloatArray) -> FloatArray:
        """Return a kernel's values in the motion's shape."""
        m, n = int(np.prod(self.design_shape, dtype=int)), int(np.prod(self.stroke_shape, dtype=int))
        if values.shape[1:] != (m, n):
            values = np.broadcast_to(values, (len(values), m, n))
        return values.reshape(len(values), *self.shape)

    # -- reach -----------------------------------------------------------------------------------------

    def _settle_unreached(self) -> None:
        """Place the poses at a dead point, to rounding; refuse or mask those out of reach."""
        failed: Mask = np.asarray(~np.isfinite(self._places).all(axis=0)) if len(self._places) else np.ones(self.shape, bool)
        with np.errstate(all="ignore"):
            failed |= reach.negative(self.plan, ArrayReading(self.plan.members, self.plan.table.lengths, self.inputs), self.shape)
        if not failed.any():
            return
        reading = self._read_at(failed)
        lost = np.zeros(int(failed.sum()), bool)
        for _, mask in reach.failures(self.plan, reading, lost.shape):
            lost |= mask
        self._places = np.array(self._places)
        for index, name in enumerate(self.plan.moving):
            place = reading.at(name)
            for axis, part in enumerate((place.x, place.y)):
                self._places[2 * index + axis, ...][failed] = np.where(lost, np.nan, part)
        self.reached[failed] = ~lost
        if self.unreachable == "raise" and self._solved.crossed.any():
            raise scan.group_crossing(self, self._solved.crossed.reshape(self.shape))
        if self.unreachable == "raise" and lost.any():
            raise reach.refusal(self.plan, self._read_at(~self.reached), ~self.reached, self.strokes, scan.stop_words(self))

    def _read_at(self, mask: Mask) -> ArrayReading:
        """Return the eager reading of some poses."""
        with np.errstate(all="ignore"):
            return self.plan.read({name: np.broadcast_to(value, self.shape)[mask] for name, value in self.inputs.items()})

    # -- positions and outputs -------------------------------------------------------------------------

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
    def _outputs(self) -> _Outputs:
        return _Outputs(self)

    def value(self, quantity: Quantity) -> FloatArray:
        """Return a quantity over all poses [SI]; angles without jumps along the stroke."""
        with np.errstate(all="ignore"):
            found = np.broadcast_to(np.asarray(self._outputs.value(quantity), float), self.shape)
        return self._finite(np.where(self.reached, found, np.nan), np.zeros((), bool), str(quantity.name or quantity))

    def _finite(self, values: FloatArray, excused: Mask, what: str) -> FloatArray:
        """Return values that are finite at every pose reached; NaN where they are not and NaN was asked for."""
        finite = np.isfinite(values)
        if finite.all():
            return values
        good: Mask = np.asarray(finite if finite.ndim == len(self.shape) else finite.all(axis=0))
        missing = ~good & self.reached & ~excused
        if missing.any() and self.unreachable == "raise":
            where = reach.where_words(self.plan, missing, self.strokes)
            raise SingularError(f'{what} has no finite value {where}. Leave these poses out, or ask with unreachable="nan".', mask=missing, motion=self)
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
        """Return the angle between the two links that meet in a dyad's joint [rad], 0 to pi; best near pi / 2."""
        step = self.plan.members[named("Point", point, self.plan.points, self.plan.title)]
        if not isinstance(step, Dyad):
            joints = [name for name, each in self.plan.points.items() if isinstance(each, Dyad)]
            raise DefinitionError(f"{self.plan.title}: {point} is not the joint of a dyad; those are: {', '.join(joints) or 'none'}.")
        (ux, uy), (wx, wy) = self._place(step.P) - self._place(step.X), self._place(step.Q) - self._place(step.X)
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
        order, method = order_of(order), method_of(method, step)
        member = self._member(target)
        refused = self._singular(member, f"The ratio of {member.name or member}", order)
        found = self._exact(member, (stroke,) * order) if method == "exact" else self._numeric(member, stroke, order, step)
        found = np.where(refused, np.nan, found) if refused.any() else found
        return self._finite(found, refused, f"The ratio of {member.name or member} by {stroke}")

    def _stroke(self, wrt: str | None) -> str:
        if wrt is None and len(self.strokes) == 1:
            return next(iter(self.strokes))
        if wrt is None:
            raise DefinitionError(f"{self.plan.title} has {len(self.strokes)} strokes: say wrt= one of {', '.join(self.strokes)}.")
        return named("Stroke", wrt, self.strokes, self.plan.title)

    def _member(self, target: Target) -> Member:
        return target if isinstance(target, Quantity) and not target.name else self._known(target)

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
        least = 1.0 if isinstance(member, Quantity) else 0.0  # an output may be a difference of what is much larger: rad
        found, error, still = numeric.derivative(values, abs(declared.end - declared.start), order, step, least)
        useless, lost = numeric.losses(found, np.where(self.reached, error, 0.0), still, len(self.shape))
        what = f"The numerical ratio of {member.name or member}"
        if useless.any() and self.unreachable == "raise":
            where = reach.where_words(self.plan, useless, self.strokes)
            text = f'{what} is refused {where}: differences do not settle so near a dead point. Ask for method="exact".'
            raise SingularError(text, mask=useless, motion=self)
        if lost > numeric.WARN:
            warnings.warn(f"{what} is off by up to about {lost:.0e} of its greatest value; the exact one is not.", SingularWarning, stacklevel=3)
        return np.where(useless, np.nan, found)

    def _singular(self, member: Member, what: str, order: int = 1) -> Mask:
        """Return the mask of poses where a ratio is refused; raise or warn as asked."""
        nothing = np.zeros(self.shape, bool)
        if not self.is_near_singular:
            return nothing
        names = self.plan.reaches(member.name) if member.name else self.plan.reaches(member)
        found = {name: np.where(self.reached, cond, np.nan) for name, cond in singular.conditions(self.plan, self._reading, names).items()}
        refused = singular.refused(self.plan, found, self.shape)
        if refused.any() and self.unreachable == "raise":
            raise singular.refusal(self.plan, found, refused, self.strokes, what, self)
        singular.warn(self.plan, found, self.strokes, what, order)
        return refused

    @cached_property
    def _reading(self) -> ArrayReading:
        with np.errstate(all="ignore"):
            return self.plan.read(self.inputs)

    @property
    def group_stops(self) -> tuple[float, ...]:
        """The strokes at which a group's pins could not be followed farther from the sketch."""
        return self._solved.stops

    @property
    def reading(self) -> ArrayReading:
        """The eager reading of all poses."""
        return self._reading

    @cached_property
    def loop_sines(self) -> dict[str, Any]:
        """The sine of the angle between the two links of every moving loop; zero at a dead point."""
        return singular.loops(self.plan, self._reading)

    def moved(self, strokes: Mapping[str, Any]) -> Motion:
        """Return the same design at other strokes [SI], unreachable poses as NaN."""
        arrays = np.broadcast_arrays(*(np.asarray(strokes[name], float) for name in self.strokes))
        return Motion(self.plan, self.designs, dict(zip(self.strokes, arrays, strict=True)), "nan")

    def limits(self) -> scan.Limits:
        """Return, for every stroke, how far it can go and what stops it; printed as sentences.

        Reachable intervals, dead points and the steps that stop there, change points, least transmission angles.
        One design at a time; other strokes are held at this motion's first values.
        """
        return scan.limits(self)

    # -- velocity --------------------------------------------------------------------------------------

    def velocity(self, target: Target, rates: Mapping[str, Any]) -> FloatArray:
        """Return the velocity of a point [m/s], shape (2, ...), or the rate of an output, from stroke rates [1/s]."""
        given = rates_of("rates", rates, self.strokes, self.shape, self.plan.title)
        return sum((self.ratio(target, wrt=name) * rate for name, rate in given.items()), self._still(target))

    def acceleration(self, target: Target, rates: Mapping[str, Any], accelerations: Mapping[str, Any] | None = None) -> FloatArray:
        """Return the acceleration of a point [m/s2], shape (2, ...), from stroke rates and accelerations."""
        given = rates_of("rates", rates, self.strokes, self.shape, self.plan.title)
        driven = rates_of("accelerations", accelerations or {}, self.strokes, self.shape, self.plan.title)
        member = self._member(target)
        refused = self._singular(member, f"The acceleration of {member.name or member}", 2)
        total = sum((self.ratio(target, wrt=name) * value for name, value in driven.items()), self._still(target))
        for first, u in given.items():
            for second, v in given.items():
                total = total + self._exact(member, tuple(sorted((first, second)))) * u * v
        return np.where(refused, np.nan, total)

    def _still(self, target: Target) -> FloatArray:
        """Return zeros in the shape of a ratio, NaN where the pose is not reached."""
        parts = (2,) if isinstance(self._member(target), (Point, Arrow)) else ()
        return np.where(self.reached, np.zeros((*parts, *self.shape)), np.nan)


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
        angle = np.where((vector.x == 0.0) & (vector.y == 0.0), np.nan, np.broadcast_to(np.arctan2(vector.y, vector.x), self.shape))
        return unwrapped(angle, self.axes)
