"""Where everything is, over designs and strokes; and what follows from it."""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Any

import numpy as np

from ..errors import AssemblyError, DefinitionError, SingularError, SingularWarning
from ..plan import Plan
from ..program import FloatArray
from ..quantities import Member, Quantity
from ..steps import Arrow, Point
from . import numeric, reach, scan, singular
from .angles import angles_of
from .asked import method_of, named, order_of, rates_of
from .gradient import gradient_of
from .outputs import Outputs
from .outputs import Target as Target
from .reach import Mask
from .request import Request


class Motion(Outputs):
    """The poses of a mechanism: all positions, worked out at once; ratios and outputs when asked.

    Arrays are component-first, designs before strokes: a position has the shape (2, *designs, *strokes).
    Raises AssemblyError where a pose cannot be assembled, unless `unreachable="nan"`.
    """

    def __init__(self, plan: Plan, designs: Mapping[str, Any], strokes: Mapping[str, FloatArray], unreachable: str = "raise") -> None:
        super().__init__(plan, designs, strokes, unreachable)
        self._ratios: dict[Any, FloatArray] = {}
        if unreachable == "raise" and scan.is_watched(self):
            scan.refuse_crossing(self)

    def __repr__(self) -> str:
        spans = [f"{name} = {reach.span_read(values, reach.stroke_unit(self.plan, name))}" for name, values in self.strokes.items()]
        poses = f"{', '.join(spans) or 'no stroke'}; shape {self.shape}"
        reached = "all reached" if self.reached.all() else f"{int(self.reached.sum())} of {self.reached.size} reached"
        return f"<Motion of {self.plan.title}: {poses}, {reached}{scan.between_words(self)}>"

    @cached_property
    def interruptions(self) -> tuple[scan.Interruption, ...] | None:
        """What interrupts the way between the least and the greatest stroke, in order: stretches out of reach and change points.

        Empty where nothing does; it then leads from every pose to every other. None where it is not looked for: of batches and
        of several strokes. Asked with unreachable="raise", a motion that is interrupted is refused.
        """
        if self.size[1] < 2:
            return ()
        if not scan.is_watched(self):
            return None
        return scan.interruptions(self) if self.unreachable == "nan" else ()

    def refusal(self) -> AssemblyError:
        """Return the error for the poses that are not reached: out of reach, or behind a change point."""
        if self.crossed.any():
            return scan.group_crossing(self, self.crossed)
        return reach.refusal(self.plan, self.read_at(~self.reached), ~self.reached, self.strokes, scan.stop_words(self))

    def limits(self) -> scan.Limits:
        """Return, for every stroke, how far it can go and what stops it; printed as sentences.

        Reachable intervals, dead points and the steps that stop there, change points, least transmission angles.
        One design at a time; other strokes are held at this motion's first values.
        """
        return scan.limits(self)

    @property
    def tangent(self) -> Mapping[str, FloatArray] | None:
        """How several strokes go on along a path of poses, by name, shape (poses,); None where the poses are no path.

        Half the way from the pose before to the pose after [SI]: its signs and ratios mean something, its length does not.
        """
        if len(self.strokes) < 2 or len(self.stroke_shape) != 1 or self.stroke_shape[0] < 2:
            return None
        if self.stroke_shape[0] == 2:
            return {name: np.gradient(value) for name, value in self.strokes.items()}
        # of second order at the ends too; a stroke that is held stays exactly so
        return {name: np.gradient(value, edge_order=2) * float(np.ptp(value) > 0.0) for name, value in self.strokes.items()}

    def sketched(self, quantity: Quantity) -> FloatArray:
        """Return what a quantity is at the sketch pose of each design [SI], shaped to broadcast against results."""
        strokes = {name: np.asarray(value) for name, value in self.plan.sketch_strokes.items()}
        found = Motion(self.plan, self.designs, strokes, "nan").value(quantity)
        return found.reshape((*self.design_shape, *(1,) * len(self.stroke_shape)))

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
        refused = self.refused(member, f"The ratio of {member.name or member}", order)
        found = self._exact(member, (stroke,) * order) if method == "exact" else self._numeric(member, stroke, order, step)
        found = np.where(refused, np.nan, found) if refused.any() else found
        return self.finite(found, refused, f"The ratio of {member.name or member} by {stroke}")

    def _stroke(self, wrt: str | None) -> str:
        if wrt is None and len(self.strokes) == 1:
            return next(iter(self.strokes))
        if wrt is None:
            raise DefinitionError(f"{self.plan.title} has {len(self.strokes)} strokes: say wrt= one of {', '.join(self.strokes)}.")
        return named("Stroke", wrt, self.strokes, self.plan.title)

    def _exact(self, member: Member, along: tuple[str, ...]) -> FloatArray:
        """Return a derivative through the program; the first derivatives of all points come in one pass, kept."""
        if isinstance(member, Point) and member.name in self.plan.ground:
            return np.zeros((2, *self.shape))
        pass_of_all = isinstance(member, Point)
        targets: tuple[Any, ...] = self.plan.moving if pass_of_all else (member.name or member,)
        key = (targets, along)
        if key not in self._ratios:
            found = self.full(self.plan.kernel(targets, along)(self.flat).values)
            continued = self._continued(targets[0], along) if isinstance(member, Quantity) else None
            self._ratios[key] = found if continued is None else continued
            self._ratios[key].flags.writeable = False
        values = self._ratios[key]
        if not self.reached.all():
            values = np.where(self.reached, values, np.nan)
        if pass_of_all:
            index = 2 * self.plan.moving.index(member.name)
            return values[index : index + 2]
        return values if isinstance(member, Arrow) else values[0]

    def _continued(self, target: Any, along: tuple[str, ...]) -> FloatArray | None:
        """Return the derivative of a quantity that holds angles, which are continued along the stroke; None where they need not be."""
        key = ("angles", target, along)
        return self.plan.made(key, lambda plan: angles_of(plan, plan.derived(plan.nodes(target), along))).continued(self)

    def _numeric(self, member: Member, stroke: str, order: int, step: float | None) -> FloatArray:
        def values(offsets: FloatArray) -> FloatArray:
            shifted = {name: value[..., None] + (offsets if name == stroke else 0.0 * offsets) for name, value in self.strokes.items()}
            near = self.moved(shifted)
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
        if lost > numeric.WARN[order]:
            text = f"{what} is off by up to about {lost:.0e} of its greatest value; the exact one is not."
            warnings.warn(text, SingularWarning, stacklevel=3)
        return np.where(useless, np.nan, found)

    def refused(self, member: Member, what: str, order: int = 1) -> Mask:
        """Return the mask of poses where a ratio is refused; raise or warn as asked."""
        names = self.plan.reaches(member.name or member) if self.is_near_singular else set[str]()
        return self.refused_of(names, what, order)

    def refused_of(self, names: set[str], what: str, order: int = 1) -> Mask:
        """Return the mask of poses where ratios of what is built from some members are refused; raise or warn as asked."""
        if not self.is_near_singular:
            return np.zeros(self.shape, bool)
        found = {name: np.where(self.reached, cond, np.nan) for name, cond in singular.conditions(self.plan, self.reading, names).items()}
        refused = singular.refused(self.plan, found, self.shape)
        if refused.any() and self.unreachable == "raise":
            raise singular.refusal(self.plan, found, refused, self.strokes, what, self)
        singular.warn(self.plan, found, self.strokes, what, order)
        return refused

    def gradient(self, of: Request, wrt: Sequence[str]) -> FloatArray:
        """Return the exact derivatives of a position, an output, a ratio or a force by dimensions, all in one reverse pass.

        `gradient("tilt", wrt=["OB", "CD", "M.x"])` has the shape (3, ...), that of a point (3, 2, ...); `gradient(ratio("G"), ...)` is
        how the transfer ratio follows the dimensions, `gradient(thrust(), wrt=["OB", "load.mass"])` how the drive's force does.
        Raises SingularError at a dead point, DefinitionError for the law of a load that cannot be traced.
        """
        return gradient_of(self, of, wrt)

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
        refused = self.refused(member, f"The acceleration of {member.name or member}", 2)
        total = sum((self.ratio(target, wrt=name) * value for name, value in driven.items()), self._still(target))
        for first, u in given.items():
            for second, v in given.items():
                total = total + self._exact(member, tuple(sorted((first, second)))) * u * v
        return np.where(refused, np.nan, total)

    def _still(self, target: Target) -> FloatArray:
        """Return zeros in the shape of a ratio, NaN where the pose is not reached."""
        parts = (2,) if isinstance(self._member(target), (Point, Arrow)) else ()
        return np.where(self.reached, np.zeros((*parts, *self.shape)), np.nan)


def require_motion(given: Any) -> None:
    """Raise DefinitionError for what is no motion."""
    if not isinstance(given, Motion):
        raise DefinitionError(f"{given!r:.60} is no motion; give machine.sweep(...) or machine.at(...).")
