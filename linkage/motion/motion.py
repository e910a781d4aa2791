"""Motions: the places of all points over designs and strokes, and the quantities derived from them."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from contextlib import suppress
from copy import copy
from dataclasses import replace
from functools import cached_property, reduce
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, ClassVar, NoReturn, Self, TypeVar, cast

import numpy as np

from ..assembly import ambiguous_angle
from ..errors import DefinitionError, SingularError, SingularWarning, cited, one_word, require, require_type, unknown, unwarned, warn
from ..frozen import FrozenDict, read_only
from ..numeric import differences
from ..plan import ArrayReading, Mask, Part, Plan, failures, rate_name, require_kinds
from ..program import FloatArray, Kernel
from ..quantities import FRAME_AXES, Angle, Axes, Coordinate, Distance, Number, Quantity, is_number, quantity
from ..quantities.member import Member, Reference, as_mapping, name_of, needs
from ..shown import Shown
from ..steps import Arrow, Point
from ..vectors import Numbers, Vec
from . import dead_points, stroke_search
from .dead_points import NOWHERE, Conditioning
from .evaluation import BulkProgram, Evaluation, examined, guard_masks, other_law_error
from .grid import Grid, JoinedTo, Joining, MotionLike, joined_in_order, not_joined, to_rounding
from .instants import Instants
from .limits import Limits, no_joint, refuse_at, span_text, stroke_unit, where_words
from .over import Over, with_strokes
from .poles import body_rates, point_by_time, pole_of, whole_body
from .requests import (
    Request,
    RequestLike,
    Trait,
    Value,
    as_they_run,
    bound,
    dimensions_of,
    natural_size,
    places_of,
    slope,
    stroke_of,
    switches_of,
)
from .stroke_search import Interruption
from .strokes import check_any, checked_name, checked_rate, order_of, rate_values, rates_of

Made = TypeVar("Made")
Kind = TypeVar("Kind", bound=Member)


class Motion(Shown):
    """The poses of a mechanism: all positions, worked out at once; ratios and outputs when asked.

    `machine.sweep` and `machine.at` make it. Arrays are component-first, designs before strokes: a position has the shape
    (2, *designs, *strokes).

    Parameters
    ----------
    plan : Plan
        The bound members of the class.
    designs : mapping of str to float or array
        Dimensions by name [SI].
    strokes : mapping of str to array
        Strokes by name [m or rad].
    unreachable : {"raise", "nan"}, optional
        What is done about poses that cannot be assembled.
    per_design : bool, optional
        Whether the arrays of strokes begin with the shape of the designs, each of which has strokes of its own.
    joining : Joining, optional
        How angles are made continuous.
    tangent : mapping of str to array, optional
        How several strokes go on along a path.
    over : Over, optional
        The declared `Over` that a sweep keeps.
    rate_inputs : mapping of str to array, optional
        Rates and accelerations, as a Grid takes them.
    instants : Instants, optional
        When the poses of a path in time are passed.

    Raises
    ------
    AssemblyError
        A pose cannot be assembled, unless `unreachable="nan"`.
    """

    _limits_of: ClassVar[Callable[[Any], Limits]] = stroke_search.limits
    """What looks for its limits: along the strokes alone, until the room of the judge gives more."""

    def __init__(
        self,
        plan: Plan,
        designs: Mapping[str, Any],
        strokes: Mapping[str, FloatArray],
        unreachable: str = "raise",
        *,
        per_design: bool = False,
        joining: Joining | None = None,
        tangent: Mapping[str, FloatArray] | None = None,
        over: Over | None = None,
        rate_inputs: Mapping[str, FloatArray] = MappingProxyType({}),
        instants: Instants | None = None,
    ) -> None:
        is_made = isinstance(plan, Plan) and isinstance(designs, Mapping) and isinstance(strokes, Mapping)
        if not is_made or designs.keys() != plan.table.entries.keys() or strokes.keys() != plan.strokes.keys():
            raise DefinitionError("Motion(...) is made by a design: machine.sweep(...) or machine.at(...).")
        one_word("unreachable", unreachable, ("raise", "nan"))
        if instants is not None:
            ways = (instants.rates, instants.accelerations)
            rate_inputs = {rate_name(name, order): each for order, known in enumerate(ways, 1) for name, each in known.items()}
        self._grid = Grid(plan, designs, strokes, per_design=per_design, joining=joining, rate_inputs=rate_inputs)
        self.plan, self.unreachable = plan, unreachable
        self.shape, self._design_shape, self._stroke_shape = self._grid.shape, self._grid.design_shape, self._grid.stroke_shape
        self._tangent, self._over, self._instants = tangent if instants is None else instants.rates, over, instants
        self._held: tuple[Motion, str] | None = None
        self._values: dict[Hashable, FloatArray] = {}
        self._kept: dict[Hashable, Any] = {}
        self._watched: dict[Hashable, bool] = {}
        self._places, is_clear = self._grid.run(plan.kernel(plan.moving, guarded=True))
        self._is_near_singular, self._is_reached = not is_clear, True
        has_gaps = unreachable == "nan" and any([np.isnan(value).any() for value in self._grid.strokes.values()])
        if self._is_near_singular or plan.may_overflow or has_gaps:  # a place of a path that is not reached has no strokes
            self._settle_unreached()
        if self._is_near_singular:  # refuse or mask the poses of which rounding leaves nothing, as where two points come together
            lost = self._refused_near(places_of(plan.moving), f"The places of {plan.title}", are_places=True)
            if lost.any():
                self._places = np.where(lost, np.nan, self._places)
                self.reached = read_only(np.asarray(self.reached & ~lost))
                self._is_reached = False
        self._places.flags.writeable = False
        if unreachable == "raise" and stroke_search.is_watched(self):
            stroke_search.refuse_interrupted(self)
        if unreachable == "raise" and plan.followed and len(self.strokes) > 1:
            self._refuse_parted()

    @cached_property
    def reached(self) -> Mask:
        """The mask of the poses that are reached, shape (...)."""
        return read_only(np.ones(self.shape, bool))

    @property
    def designs(self) -> FrozenDict[str, Any]:
        """The design variables by name [SI]."""
        return self._grid.designs

    @property
    def strokes(self) -> dict[str, FloatArray]:
        """The strokes by name [m or rad], arrays of one shape."""
        return self._grid.strokes

    @property
    def rates(self) -> dict[str, FloatArray]:
        """The rates of the strokes by name [1/s], shaped as these, exact; empty where the motion has no time.

        At a break, where two phases of a course meet, they are those of the phase that begins there.
        """
        return self._rates_of_order(1)

    @property
    def accelerations(self) -> dict[str, FloatArray]:
        """The accelerations of the strokes by name [1/s2], shaped as these; empty where they are not known."""
        return self._rates_of_order(2)

    def _rates_of_order(self, order: int) -> dict[str, FloatArray]:
        names = {name: rate_name(name, order) for name in self.plan.strokes}
        return {name: self._grid.rate_inputs[each] for name, each in names.items() if each in self._grid.rate_inputs}

    @property
    def _rate_jump(self) -> tuple[str, str] | None:
        """The first stroke whose rate jumps over a path in time, with the jump in words; None where none does."""
        found = None if self._instants is None else self._instants.rate_jump
        if found is None:
            return None
        time, name, size = found
        return name, f"the rate of {name} jumps by {size:.4g} {stroke_unit(self.plan, name) or 1}/s at {time:.4g} s"

    @property
    def over(self) -> Over:
        """Its domain: the `Over` it was swept over, else one stroke's range, the path of several in one axis, the box of a grid.

        DefinitionError where each design of a batch has strokes of its own: there is no one place to look at.
        """
        self._refuse_part("what is judged")
        if self._over is not None:
            return self._over
        if self._grid.per_design and self._design_shape:
            what = "in this motion each design has strokes of its own, and what is looked for between poses is looked for over the same"
            raise DefinitionError(f"{self.plan.title}: {what} strokes of all designs; take the designs one by one, or give one Over.")
        check_any(self.strokes, self.plan)
        strokes = with_strokes(self.strokes)
        several = sum(float(np.ptp(value)) > 0.0 for value in strokes.values()) > 1
        if several and not self._grid.per_design and all(value.ndim == 1 for value in strokes.values()):
            return Over.path(**{name: value.tolist() for name, value in strokes.items()})
        ends = {name: (float(np.min(value)), float(np.max(value))) for name, value in strokes.items()}
        given: dict[str, Any] = {name: (low, high) if low < high else low for name, (low, high) in ends.items()}
        return Over(**given)

    @property
    def is_swept(self) -> bool:
        """Whether it was swept over an `Over`, which it keeps."""
        return self._over is not None

    @property
    def time(self) -> FloatArray | None:
        """The instants of its poses [s], shape (poses,), where it runs over a path in time; None of any other motion."""
        return None if self._instants is None else read_only(self._instants.time)

    @property
    def inputs(self) -> dict[str, Any]:
        """Design variables and strokes by name, shaped to broadcast against results."""
        return self._grid.inputs

    def __repr__(self) -> str:
        spans = [f"{name} = {span_text(values, stroke_unit(self.plan, name))}" for name, values in self.strokes.items()]
        if self._instants is not None:
            spans.insert(0, f"time = {span_text(self._instants.time, 's')}")
        poses = f"{', '.join(spans) or 'no stroke'}; shape {self.shape}"
        reached = "all reached" if self.reached.all() else f"{int(self.reached.sum())} of {self.reached.size} reached"
        if self.interruptions is None:
            reached += ", not looked at between the poses"
        return f"<Motion of {self.plan.title}: {poses}, {reached}{''.join(f', interrupted: {each}' for each in self.interruptions or ())}>"

    def __contains__(self, name: object) -> bool:
        """Whether `motion[name]` gives a value: a name of a point, a vector or a quantity."""
        return isinstance(name, str) and isinstance(self.plan.members.get(name), (Point, Arrow, Quantity))

    def __iter__(self) -> NoReturn:
        """Raise DefinitionError: poses are the last axes of its arrays, so it is not iterated."""
        text = f"{self.plan.title}: a motion is not gone through pose by pose"
        raise DefinitionError(f'{text}; its poses are the last axis of what it gives, such as motion["G"].')

    if not TYPE_CHECKING:  # a name that is not there shall be found before it runs

        def __getattr__(self, name: str) -> Any:
            """Raise AttributeError with a suggestion: a point, a vector or an output is read by `motion["G"]`."""
            is_member = "plan" in vars(self) and name in self.plan.members
            remedy = f'what the class calls {name} is motion["{name}"]' if is_member else "a point or an output goes by motion[name]"
            raise AttributeError(f"A motion has no attribute {name!r}; {remedy}.", name=name, obj=self)

    # -- what is read off --------------------------------------------------------------------------------

    def __getitem__(self, name: RequestLike) -> FloatArray:
        """Return a point's position or a vector, shape (2, ...) [m], or a quantity, shape (...) [SI]; or a request, by its own function.

        `motion[drive_force() * ratio("tilt")]` is what `driving_force(motion)` and `motion.ratio("tilt")` give, multiplied.
        """
        if type(name) is str and name in self.plan.moving:
            return self._place(name)
        if isinstance(name, Request):
            return name.of(self)
        member = self._member(name)
        if isinstance(member, Point):
            return self._place(member.name)
        if isinstance(member, Quantity):
            return self.value(member)
        if isinstance(member, Arrow):
            return self._evaluated(Value(member))
        raise DefinitionError(f"{self.plan.title}: {name} = {member} has no value over the stroke; name a point, a vector or an output.")

    def part(self, name: str) -> Motion:
        """Return this motion as one of the machine's parts has it, in the part's own names and axes: `motion.part("lower")["T"]`.

        Places and ratios are those of the part alone, thrusts, pressures and joint forces those of the whole; its `columns` and `rules`
        take it. Strokes and dimensions have the values that the whole gives them. DefinitionError for a dimension that follows a stroke.

        Parameters
        ----------
        name : str
            The part's name.

        Returns
        -------
        Motion
            The part's motion.

        Raises
        ------
        DefinitionError
            A dimension of the part follows a stroke.
        """
        part = self.plan.members.get(name) if isinstance(name, str) else None
        if not isinstance(part, Part):
            raise unknown("Part", name, self.plan.of_kind(Part), where=self.plan.title)
        axes = part.axes(self.plan.members)
        strokes = {each: np.array(np.broadcast_to(self[f"{name}.{each}"], self.shape)) for each in part.plan.strokes}
        designs = {each: steady_dimension(self, part, each, axes) for each in part.plan.table.entries}
        instants = self._instants
        if instants is not None:  # the part's strokes follow those of the whole
            names = {each: f"{name}.{each}" for each in part.plan.strokes}
            rates = {each: self.velocity(of_whole) for each, of_whole in names.items()}
            accelerations = {each: self.acceleration(of_whole) for each, of_whole in names.items()}
            instants = replace(instants, courses={}, rates=rates, accelerations=accelerations)
        motion = Motion(part.plan, designs, strokes, "nan", per_design=bool(self._design_shape), instants=instants)
        motion._held = (self, name)
        return motion

    def _of_the_whole(self, member: Kind) -> tuple[Motion, Kind] | None:
        """Return the motion of the whole and the member there, where this one is read as that of a part; None for any other motion."""
        if self._held is None:
            return None
        whole, part = self._held
        found = whole.plan.members.get(f"{part}.{member.name}")
        if not isinstance(found, type(member)):
            what = "was left out" if found is None else f"is {found}"
            raise DefinitionError(f"{whole.plan.title}: {part}.{member.name} {what}, so that there is no force of it.")
        return whole, found

    def _refuse_part(self, what: str) -> None:
        """Raise DefinitionError where this motion is read as that of a part: what hangs on forces is asked of the whole."""
        if self._held is not None:
            whole, part = self._held
            remedy = f"ask the whole's motion, with names such as {part}.{next(iter(self.plan.points))}"
            raise DefinitionError(f"{whole.plan.title}: {what} of the part {part} hangs on forces, which are those of the whole; {remedy}.")

    @property
    def _machine_motion(self) -> Motion:
        """The motion whose forces these are: that of the whole, where this one is read as a part has it, else itself."""
        return self if self._held is None else self._held[0]._machine_motion

    def x(self, point: Reference) -> FloatArray:
        """Return a point's x coordinate [m].

        Parameters
        ----------
        point : str or Point
            The point, or its name.

        Returns
        -------
        ndarray
            The coordinate [m], shape (...).
        """
        return np.asarray(self._point(point)[0])

    def y(self, point: Reference) -> FloatArray:
        """Return a point's y coordinate [m].

        Parameters
        ----------
        point : str or Point
            The point, or its name.

        Returns
        -------
        ndarray
            The coordinate [m], shape (...).
        """
        return np.asarray(self._point(point)[1])

    def angle(self, P: Reference, Q: Reference) -> FloatArray:
        """Return the direction of P -> Q [rad], without jumps along the stroke.

        Parameters
        ----------
        P : str or Point
            The first point, or its name.
        Q : str or Point
            The second point, or its name.

        Returns
        -------
        ndarray
            The angle [rad], shape (...), counter-clockwise from the x axis.
        """
        self._point(P), self._point(Q)
        return self.value(Angle(P, Q))

    def distance(self, P: Reference, Q: Reference) -> FloatArray:
        """Return the distance of two points [m].

        Parameters
        ----------
        P : str or Point
            The first point, or its name.
        Q : str or Point
            The second point, or its name.

        Returns
        -------
        ndarray
            The distance [m], shape (...).
        """
        self._point(P), self._point(Q)
        return self.value(Distance(P, Q))

    def transmission_angle(self, point: Reference) -> FloatArray:
        """Return the transmission angle of a dyad's joint [rad], shape (...), 0 to pi; best near pi / 2.

        Of a Dyad it is between the two links that meet in it. Of a SliderDyad it is between the link and the normal to its
        guide: a slider-crank's connecting rod and the normal to the slide. Of a PinSlotDyad it is between the line to the pin
        and the normal to the slot, of a GuideCross between the two guides, of a YokeDyad between slot and guide. Its sine is
        the share of the force on the way from link to link that moves the second one. DefinitionError for a point that is no such joint.
        Sources: H. Alt, Werkstattstechnik 26 (1932); S. S. Balli, S. Chand, Mech. Mach. Theory 37 (2002) 175-195.

        Parameters
        ----------
        point : str or Point
            The point, or its name.

        Returns
        -------
        ndarray
            The angle [rad], shape (...), 0 to pi.

        Raises
        ------
        DefinitionError
            The point is no such joint.
        """
        name = checked_name("Point", point, self.plan.points, self.plan.title)
        directions = self._meeting(name)
        if not directions:
            raise no_joint(self.plan, name, self._joints)
        u, w = directions
        with np.errstate(all="ignore"):
            angle = np.arctan2(np.abs(u.cross(w)), u.dot(w))
        return np.where(self.reached, np.broadcast_to(angle, self.shape), np.nan)

    def value(self, quantity: Quantity | Request) -> FloatArray:
        """Return a quantity or a request over all poses [SI]; angles without jumps along the stroke.

        Parameters
        ----------
        quantity : Quantity or Request
            The value asked for.

        Returns
        -------
        ndarray
            The values [SI], shape (...).
        """
        if isinstance(quantity, Request):
            return quantity.of(self)
        member = self._member(quantity)
        if not isinstance(member, Quantity):
            raise DefinitionError(f'{self.plan.title}: {member.name} is no quantity; ask for motion["{member.name}"].')
        words = str(member.name or member)
        what = Value(member)
        refused = self._refused(what, words)
        return self._finite(np.where(self.reached & ~refused, self._evaluated(what), np.nan), refused, words)

    def sketched(self, quantity: Quantity) -> FloatArray:
        """Return the value of a quantity at the sketch pose of each design [SI], shaped to broadcast against results.

        Parameters
        ----------
        quantity : Quantity
            The quantity.

        Returns
        -------
        ndarray
            The values [SI], to broadcast against results.
        """
        strokes = {name: np.asarray(value) for name, value in self.plan.sketch_strokes.items()}
        found = Motion(self.plan, self.designs, strokes, "nan").value(quantity)
        return found.reshape((*self._design_shape, *(1,) * len(self._stroke_shape)))

    @property
    def is_path(self) -> bool:
        """Whether the poses go along a path: a declared one, or one on which several strokes move together."""
        if self._instants is not None:
            return True
        moving = sum(bool(np.any(value[..., 1:] != value[..., :-1])) for value in self.strokes.values() if value.ndim)
        return moving > 1 and len(self._stroke_shape) == 1 if self._over is None else moving > 0 and self._over.shape == "path"

    @property
    def tangent(self) -> Mapping[str, FloatArray] | None:
        """How the strokes go on along a path of poses, by name, shape (poses,) or (*designs, poses); None where the poses are no path.

        The way from a pose to the next that differs from it, at the end from the one before [SI]: its signs and ratios mean something, its
        length does not. It is one-sided, so that rounding never decides which way a stroke goes.
        """
        if self._tangent is not None or not self._grid.joins_itself:
            return self._tangent
        if not self.is_path or self._stroke_shape[0] < 2:
            return None
        steps = {name: np.diff(value, axis=-1) for name, value in self.strokes.items()}
        moves = np.array([step.reshape(-1, step.shape[-1]) for step in steps.values()])
        going = np.flatnonzero((np.isfinite(moves).all(axis=0) & moves.any(axis=0)).any(axis=0))
        if not going.size:
            return steps | dict.fromkeys(steps, np.zeros(self.shape))
        ahead = going[np.minimum(np.searchsorted(going, np.arange(self._stroke_shape[0])), len(going) - 1)]
        return {name: step[..., ahead] for name, step in steps.items()}

    # -- ratios, velocities, gradients -------------------------------------------------------------------

    def ratio(
        self, target: Reference, *, wrt: str | None = None, order: int = 1, method: str = "exact", step: float | None = None
    ) -> FloatArray:
        """Return the derivative of a point or an output by a stroke: the transfer ratio (velocity analogue).

        `order=2` gives the second derivative. `method="central"` differentiates numerically, with the step chosen
        at every pose, or given as `step` [unit of the stroke]. Shape (2, ...) for a point, (...) for an output.
        Raises SingularError at a dead point; warns near one.

        Parameters
        ----------
        target : str, Point or Quantity
            The point or the quantity.
        wrt : str, optional
            The stroke, where there are several.
        order : int
            1 or 2.
        method : str
            "exact" or "central".
        step : float, optional
            The step of central differences [unit of the stroke].

        Returns
        -------
        ndarray
            The derivative, shape (2, ...) for a point, (...) for a quantity.

        Raises
        ------
        SingularError
            A dead point.
        """
        stroke, order = stroke_of(self.plan, wrt), order_of(order)
        one_word("method", method, ("exact", "central"))
        if step is not None and not (is_number(step) and step > 0.0 and method == "central"):
            fault = f"step={step!r}: a positive number in the unit of the stroke"
            raise DefinitionError(f'{fault}, together with method="central", is expected.')
        what = Value(self._member(target), (stroke,) * order)
        words = f"The ratio of {what.name}"
        refused = self._refused(what, words)
        found = self._evaluated(what) if method == "exact" else self._numeric(what, None if step is None else float(step))
        found = found if refused is NOWHERE else np.where(refused, np.nan, found)
        return self._finite(found, refused, f"{words} by {stroke}")

    def velocity(self, target: Reference, rates: Mapping[str, object] | None = None) -> FloatArray:
        """Return the velocity of a point [m/s], shape (2, ...), or the rate of an output, from stroke rates [1/s].

        A motion in time has rates of its own; others are given.

        Parameters
        ----------
        target : str, Point or Quantity
            The point or the quantity.
        rates : mapping, optional
            Rates of the strokes by name [1/s], for dampers and inertia.

        Returns
        -------
        ndarray
            The velocity, shape (2, ...) for a point, (...) for a quantity.
        """
        own = self.rates if rates is None else rates
        if self._is_in_pass(target, own, {}):
            return point_by_time(self, name_of(target), 1, own, {})
        return self._along(target, self._rates_or_own("velocity", rates))

    def _is_in_pass(self, target: object, *rates: object) -> bool:
        """Return whether a target is a point that moves at such rates, at poses that are all far from singular ones."""
        is_point = isinstance(target, str | Point) and name_of(target) in self.plan.moving
        return is_point and not self._is_near_singular and all(isinstance(each, Mapping) for each in rates) and bool(rates[0])

    def _rates_or_own(self, what: str, rates: Mapping[str, object] | None) -> dict[str, FloatArray]:
        """Return the rates that are given, else the motion's own; DefinitionError where there are neither."""
        if rates is None and self._instants is None:
            example = as_mapping({next(iter(self.strokes), "S"): 0.05})
            remedy = f"give rates={example}, or sweep over a path in time"
            raise DefinitionError(f"{self.plan.title}: {what}: nothing says how quickly the strokes move; {remedy}.")
        return rates_of("rates", self.rates if rates is None else rates, self, gaps=self.unreachable == "nan")

    def _along(self, target: Reference, rates: Mapping[str, FloatArray]) -> FloatArray:
        """Return the sum of the ratios by the strokes, each times its rate; NaN where the pose is not reached."""
        parts = (2,) if isinstance(self._member(target), (Point, Arrow)) else ()
        still = np.where(self.reached, np.zeros((*parts, *self.shape)), np.nan)
        return sum((self.ratio(target, wrt=name) * rate for name, rate in rates.items()), still)

    def acceleration(
        self, target: Reference, rates: Mapping[str, object] | None = None, accelerations: Mapping[str, object] | None = None
    ) -> FloatArray:
        """Return the acceleration of a point [m/s2], shape (2, ...), from stroke rates and accelerations.

        A motion in time has its own. Where rates are given, accelerations that are not are 0.

        Parameters
        ----------
        target : str, Point or Quantity
            The point or the quantity.
        rates : mapping, optional
            Rates of the strokes by name [1/s], for dampers and inertia.
        accelerations : mapping, optional
            Accelerations of the strokes by name [1/s2], for inertia.

        Returns
        -------
        ndarray
            The acceleration, shape (2, ...) for a point, (...) for a quantity.
        """
        asked = accelerations if accelerations is not None else self.accelerations if rates is None else {}
        own = self.rates if rates is None else rates
        if self._is_in_pass(target, own, asked):
            return point_by_time(self, name_of(target), 2, own, asked)
        given = self._rates_or_own("acceleration", rates)
        driven = rates_of("accelerations", asked, self, gaps=self.unreachable == "nan")
        member = self._member(target)
        along = [tuple(sorted((first, second))) for first in given for second in given]
        masks = [self._refused(Value(member, each), f"The acceleration of {member.name or member}") for each in dict.fromkeys(along)]
        refused = reduce(np.logical_or, masks, NOWHERE)
        total = self._along(target, driven)
        for first, u in given.items():
            for second, v in given.items():
                total = total + self._evaluated(Value(member, tuple(sorted((first, second))))) * u * v
        return np.where(refused, np.nan, total)

    def rates_for(self, velocities: Mapping[RequestLike, object]) -> dict[str, FloatArray]:
        """Return the stroke rates [1/s] that give outputs their rates and points their velocities: `rates_for({"px": 0.2, "py": 0.0})`.

        As many as there are strokes, by name or quantity, a number or an array over the poses each; of a point the two parts, (0.2, 0.0); a
        stroke that stands still is one of them, `{"S": 0.0}`. Raises SingularError where the strokes cannot give them, at a dead point of
        the drive, unless the motion has `unreachable="nan"`.

        Parameters
        ----------
        velocities : mapping
            Velocities of points, two parts each, and rates of outputs [SI/s], by name or quantity.

        Returns
        -------
        dict of str to ndarray
            The rates of the strokes [1/s].

        Raises
        ------
        SingularError
            The strokes cannot give these velocities.
        """
        plan, title = self.plan, f"{self.plan.title}.rates_for"
        expected = 'rates by name are expected, such as {"px": 0.2, "py": 0.0}'
        require(isinstance(velocities, Mapping) and velocities, f"{title}: velocities", velocities, expected)
        extent = plan.made(("extent",), lambda fork: Kernel([fork.trace.graph.node(fork.trace.extent)]))
        size = np.asarray(np.sqrt(self._grid.kernel_values(extent)[0]))  # the machine's [m]
        names, slopes, wanted, sizes = list[str](), list[FloatArray](), list[FloatArray](), list[FloatArray]()
        for target, rate in dict[Any, object](velocities).items():
            what = bound(plan, target)
            parts: Sequence[object] = [rate]
            if what.rows > 1:
                if not isinstance(rate, (tuple, list, np.ndarray)) or len(rate) != what.rows:
                    two = "is a point or a vector: its two parts are expected, (0.2, 0.0)"
                    raise DefinitionError(f"{title}: {what} {two}, not {cited(rate)}.")
                parts = [*rate]
            names += [str(what)] * what.rows
            wanted += [np.broadcast_to(checked_rate(f"rates_for: {what}", part, self.shape, plan.title), self.shape) for part in parts]
            along = [np.broadcast_to(self.ratio(target, wrt=stroke), (what.rows, *self.shape)) for stroke in self.strokes]
            slopes += list(np.stack(along, axis=1))
            is_length = not isinstance(what, Value) and what.measured(plan) == "length"
            own = natural_size(what.member, size) if isinstance(what, Value) else size if is_length else None
            sizes += [np.broadcast_to(np.ones_like(size) if own is None else own, self.shape)] * what.rows
        if len(wanted) != len(self.strokes):
            counted = f"{len(wanted)} rate{'s' * (len(wanted) != 1)} for {' and '.join(self.strokes)}"
            still = f'one that stands still is a rate too, "{[*self.strokes][-1]}": 0.0'
            remedy = still if len(wanted) < len(self.strokes) else "leave out some"
            raise DefinitionError(f"{title}: {counted}: give as many as there are strokes; {remedy}.")
        return self._rates(title, names, np.array(slopes), np.array(wanted), np.array(sizes))

    def _rates(self, title: str, names: Sequence[str], slopes: FloatArray, wanted: FloatArray, sizes: FloatArray) -> dict[str, FloatArray]:
        """Return the rates from slopes (n, n, ...) of n values by the strokes, the wanted rates and their sizes (n, ...)."""
        matrix, right = np.moveaxis(slopes, (0, 1), (-2, -1)), np.moveaxis(wanted, 0, -1)[..., None]
        spans = np.array([abs(stroke.end - stroke.start) for stroke in self.plan.strokes.values()])
        sizes, known = np.moveaxis(sizes, 0, -1), np.asarray(np.isfinite(matrix).all(axis=(-2, -1)))
        scaled = np.where(known[..., None, None], matrix, np.eye(len(wanted))) * spans / np.where(sizes > 0.0, sizes, 1.0)[..., None]
        found = np.linalg.svd(scaled, compute_uv=False)
        dead: Mask = np.asarray(known & ~(found[..., -1] * dead_points.REFUSE > np.maximum(found[..., 0], 1.0)))
        what = f"{title}: no stroke rates give {', '.join(dict.fromkeys(names))}"
        refuse_at(self, dead, what, ', at a dead point of the drive. Leave these poses out, or ask with unreachable="nan".')
        solvable = (known & ~dead)[..., None, None]
        found = np.linalg.solve(np.where(solvable, matrix, np.eye(len(wanted))), right)[..., 0]
        found = np.asarray(np.where(solvable[..., 0], found, np.nan), float)
        return {stroke: np.asarray(found[..., place], float) for place, stroke in enumerate(self.strokes)}

    def pole(
        self, body: Reference, other: Reference = "frame", *, wrt: str | None = None, rates: Mapping[str, object] | None = None
    ) -> FloatArray:
        """Return the pole of a body, its instant centre, against the frame or another body, shape (2, ...) [m]; over a sweep, its path.

        A body goes by its name ("EDF"), its link's, or two of its points ("E D"). Several strokes go as one, `wrt=`, or at `rates` as
        in `velocity`. A motion in time has rates of its own. Both coordinates are infinite where the body only translates. They are NaN
        where it stands still against the other one, and out of reach. Raises SingularError at a dead point, where the ratios are refused,
        unless the motion has `unreachable="nan"`.

        Parameters
        ----------
        body : str
            The body: its name, its link's, or two of its points.
        other : str
            The other body.
        wrt : str, optional
            The stroke, where there are several.
        rates : mapping, optional
            Rates of the strokes by name [1/s], for dampers and inertia.

        Returns
        -------
        ndarray
            The pole [m], shape (2, ...).

        Raises
        ------
        SingularError
            A dead point.
        """
        own = self.rates if wrt is None else {}
        given = rates if rates is not None else own or {stroke_of(self.plan, wrt): np.ones(())}
        if rates is not None and wrt is not None:
            raise DefinitionError(f"{self.plan.title}: pole(wrt=..., rates=...): rates say already which strokes move; leave out wrt=.")
        of_body, of_other = whole_body(self.plan, body), whole_body(self.plan, other)
        if of_body == of_other:
            raise DefinitionError(f"{self.plan.title}: pole({cited(body)}, {cited(other)}): these are one body; name two.")
        moving = {name: self.velocity(name, given) for name in self.plan.points}
        speeds = [np.hypot(rate[0], rate[1]) for rate in moving.values()]
        first, second = (body_rates(points, self.__getitem__, moving.__getitem__, self.shape) for points in (of_body, of_other))
        return pole_of(first, second, np.max(np.broadcast_arrays(*speeds), axis=0))

    def gradient(self, of: RequestLike, wrt: Sequence[str], *, rates: object = None, accelerations: object = None) -> FloatArray:
        """Return the exact derivatives of a position, an output, a ratio or a force by dimensions, all in one reverse pass.

        `gradient("tilt", wrt=["OB", "CD", "M.x"])` has the shape (3, ...), that of a point (3, 2, ...); `gradient(ratio("G"), ...)` is
        how the transfer ratio follows the dimensions, `gradient(thrust(), wrt=["OB", "load.mass"])` how the drive's force does. Forces
        follow `rates` [1/s] and `accelerations` [1/s2] of strokes by name. Without these they follow those of the motion.
        Raises SingularError at a dead point, DefinitionError for the law of a load that cannot be traced.

        Parameters
        ----------
        of : str, Quantity or Request
            The value.
        wrt : sequence of str
            The dimensions.
        rates : mapping, optional
            Rates of the strokes by name [1/s], for dampers and inertia.
        accelerations : mapping, optional
            Accelerations of the strokes by name [1/s2], for inertia.

        Returns
        -------
        ndarray
            The derivatives, shape (dimensions, ...), of a point (dimensions, 2, ...).

        Raises
        ------
        SingularError
            A dead point.
        DefinitionError
            A load's law cannot be traced.
        """
        plan, grid = self.plan, self._grid
        if rates is not None or accelerations is not None:  # of the same poses at these rates
            shape = np.shape(next(iter(self.strokes.values()), 0.0))
            given = rate_values(plan, rates, accelerations)
            moving = {name: checked_rate(name, value, shape, plan.title) for name, value in given.items()}
            joining, at_rates = None if grid.joins_itself else grid.joining, copy(self)
            own = Grid(plan, grid.designs, grid.strokes, per_design=grid.per_design, joining=joining, rate_inputs=moving)
            vars(at_rates).update(_grid=own, _kept={}, _instants=None)
            return at_rates.gradient(of, wrt)
        (of,) = as_they_run([of], bool(self.accelerations), self.time is not None) if self.rates else [of]
        what, dimensions = bound(plan, of), dimensions_of(plan, wrt)
        if Trait.OF_FORCES in what.traits:
            self._refuse_part(f"the gradient of {of}")
        names, signs = tuple(name for name, _ in dimensions), np.tile([float(sign) for _, sign in dimensions], what.rows)
        made = plan.made_beside if Trait.OF_LAWS in what.traits else plan.made
        kernel, touched = made(("switches", what.key, names), lambda plan: switches_of(plan, what, names))
        switches = grid.kernel_values(kernel) if touched else ()
        found = self._looked_at(slope(what, names), f"The gradient of {what.sentence}", what, zip(touched, switches, strict=True))
        rows = found.reshape(len(signs), *self.shape) * signs.reshape(-1, *(1,) * len(self.shape))
        return np.stack(np.split(rows, what.rows), axis=1) if what.rows > 1 else rows

    def _requested(self, request: Request) -> FloatArray:
        """Return a request's values over all poses [SI], by its program; see `Request.of`."""
        what = bound(self.plan, request)
        return self._looked_at(what, what.sentence, what)

    def _looked_at(self, looked: Request, words: str, what: Request, switches: Iterable[tuple[str, FloatArray]] = ()) -> FloatArray:
        """Return the values of a request that is made of `what`, NaN where it is refused; `words` begin a sentence about it.

        Raise the error of poses where a law is another than the one traced, or changes to another with a dimension: where one of its
        `switches`, numbers with words for them, is above zero.
        """
        (values,), look = Evaluation(self._grid, (looked,)).evaluate(among=self.reached.reshape(self._grid.size))
        excused, broken = NOWHERE, False
        if look is not None:
            refused, doubtful, empty = (mask.reshape(self.shape) for mask in (look.refused, look.doubtful, look.empty))
            self._report(words, refused, doubtful, lambda mask: self._near(looked, mask))
            excused, broken = refused | empty, bool((look.broken & ~look.empty[0]).any())
        good = self.reached & ~excused
        if broken:
            what.refuse(self)
            raise other_law_error(self.plan, what)
        for owner, number in switches:
            if np.any(good & (number > 0.0)):
                why = f"{what.sentence} has no derivative by {owner} that it equals here, and is another law next to it"
                remedy = "Leave that dimension out of wrt=, or set it beside that number."
                raise DefinitionError(f"{self.plan.title}: {why}. {remedy}")
        if self.unreachable == "raise" and not np.isfinite(values[..., good]).all():
            looked.refuse(self)
        return self._finite(np.where(good, values, np.nan), excused, words)

    # -- how far it goes, and other strokes --------------------------------------------------------------

    def limits(self) -> Limits:
        """Return, for every stroke, how far it can go and where it stops; printed as sentences.

        These are reachable intervals, dead points and the steps that stop there, change points, and least transmission angles. For the
        `box` of all declared strokes they say what is lost in it, and how clear each loop stays of its dead point, with the place. One
        design at a time; other strokes are held at this motion's first values.

        Returns
        -------
        Limits
            The limits of each stroke.
        """
        return type(self)._limits_of(self)

    @cached_property
    def interruptions(self) -> tuple[Interruption, ...] | None:
        """The interruptions between the least and the greatest stroke, in order: stretches out of reach and change points.

        Empty where nothing does; it then leads from every pose to every other. None where it is not looked for: of batches and
        of several strokes. Asked with unreachable="raise", a motion that is interrupted is refused.
        """
        if self._grid.size[1] < 2:
            return ()
        if not stroke_search.is_watched(self):
            return None
        return stroke_search.interruptions(self) if self.unreachable == "nan" else ()

    def moved(self, strokes: Mapping[str, object]) -> Self:
        """Return the same designs at other strokes [SI], each at its own where the arrays begin with the designs; NaN out of reach.

        It has no time.

        Parameters
        ----------
        strokes : mapping
            Values of the strokes by name [m or rad].

        Returns
        -------
        Motion
            The motion at these strokes.
        """
        given = strokes if isinstance(strokes, Mapping) else {}
        if given.keys() != self.strokes.keys():
            known = as_mapping(dict.fromkeys(self.strokes, "..."))
            raise DefinitionError(f"{self.plan.title}: moved({cited(strokes)}): a value for each stroke is expected, {known}.")
        require_kinds(self.plan, given)
        try:
            arrays = np.broadcast_arrays(*(np.array(given[name], float) for name in self.strokes))
        except (TypeError, ValueError, OverflowError):
            said = "numbers or arrays that fit each other are expected"
            raise DefinitionError(f"{self.plan.title}: moved({cited(strokes)}): {said}.") from None
        if self._held is not None:
            whole, part = self._held
            renamed = {whole.plan.members[f"{part}.{name}"].name: value for name, value in given.items()}
            return cast(Self, whole.moved({**whole.strokes, **renamed}).part(part))
        own = self._grid.per_design and arrays[0].shape[: len(self._design_shape)] == self._design_shape
        joining = joined_in_order if self._grid.per_design or not self._grid.joins_itself else None
        with unwarned():
            return type(self)(self.plan, self.designs, dict(zip(self.strokes, arrays, strict=True)), "nan", per_design=own, joining=joining)

    def _with_gaps(self) -> Motion:
        """Return the same poses, NaN in the place of errors."""
        if self._instants is None:
            return self.moved(self.strokes)
        with unwarned():
            return Motion(self.plan, self.designs, self.strokes, "nan", over=self._over, instants=self._instants)

    def _there(self, strokes: Mapping[str, object], time: object = np.nan) -> Motion:
        """Return the poses of some strokes, over a path in time at its instants [s], shaped as these; NaN where there are none."""
        at = np.asarray(time, float)
        if self._instants is None or np.isnan(at).any():
            return self.moved(strokes)
        there = self._instants.at_times(at)
        return Motion(self.plan, self.designs, there.strokes, "nan", instants=there)

    # -- reach -------------------------------------------------------------------------------------------

    def _settle_unreached(self) -> None:
        """Place the poses at a dead point, to rounding; refuse or mask those out of reach."""
        failed: Mask = np.asarray(~np.isfinite(self._places).all(axis=0)) if len(self._places) else np.ones(self.shape, bool)
        if self.plan.following:
            failed |= (self._grid.kernel_values(self.plan.made("following", following_lengths)) < 0.0).any(axis=0)
        if not failed.any():
            return
        reading = self._grid.read_at(failed)
        lost = np.zeros(int(failed.sum()), bool)
        for _, mask in failures(self.plan, reading, lost.shape):
            lost |= mask
        self._places = np.array(self._places)
        for index, name in enumerate(self.plan.moving):
            place = reading.at(name)
            for axis, part in enumerate((place.x, place.y)):
                self._places[2 * index + axis, ...][failed] = np.where(lost, np.nan, part)
        reached = np.ones(self.shape, bool)
        reached[failed] = ~lost
        self.reached = read_only(reached)
        self._is_reached = not lost.any()
        if self.unreachable == "raise" and lost.any():
            raise stroke_search.out_of_reach(self)

    def _refuse_parted(self) -> None:
        """Raise SingularError where an angle that is followed from the sketch changes by a turn from one pose to the next."""
        m, shape = self._grid.size[0], self._stroke_shape
        solved = self._grid.solved.inputs
        references = {name: np.broadcast_to(solved[name], self._grid.size).reshape(m, *shape) for name in self.plan.followed}
        designs = {name: np.broadcast_to(value, self._design_shape) if np.ndim(value) else value for name, value in self.designs.items()}
        strokes = {name: np.broadcast_to(value, self.shape).reshape(m, *shape) for name, value in self.strokes.items()}
        name = ambiguous_angle(self.plan, designs, strokes, references)
        if name:
            what = f"{self.plan.title}: {name}, whose whole turns count here, is followed from the sketch, and the straight ways to two"
            why = "neighbours of these poses pass a pose where its ends meet on either side, so that a turn lies between them"
            remedy = "Stay on one side of it, take a whole multiple of the angle, or drive it by a Stroke."
            raise SingularError(f"{what} {why}. {remedy}", mask=np.ones(self.shape, bool), motion=self)

    # -- values through the program ----------------------------------------------------------------------

    def _place(self, name: str) -> FloatArray:
        if name in self.plan.ground:
            return self._evaluated(Value(self.plan.members[name]))
        index = 2 * self.plan.moving.index(name)
        return self._places[index : index + 2]

    def _point(self, name: Reference) -> FloatArray:
        return self._place(checked_name("Point", name, self.plan.points, self.plan.title))

    def _member(self, target: Reference) -> Member:
        if not isinstance(target, Quantity) or target.name:
            return self.plan.members[checked_name("Name", target, self.plan.members, self.plan.title)]
        for name in needs(target):
            checked_name("Name", name, self.plan.members, self.plan.title)
        return target

    def _evaluated(self, what: Value) -> FloatArray:
        """Return a value or a derivative through the program; the derivatives of all points come in one pass, kept."""
        member, along = what.member, what.strokes
        pass_of_all = bool(along) and isinstance(member, Point)
        if pass_of_all and member.name in self.plan.ground:
            return np.zeros((2, *self.shape))
        key = (self.plan.moving, along) if pass_of_all else what.key
        if key not in self._values:
            program = None if pass_of_all else BulkProgram.for_requests(self.plan, (what,))
            kernel = self.plan.kernel(self.plan.moving, along) if program is None else program.kernel
            found, is_clear = self._grid.run(kernel)
            if program is not None:
                self._watched[what.key] = not is_clear
            if self._is_near_singular and not along:
                at_end = self.reached & ~np.isfinite(found).all(axis=0)
                found = to_rounding(found, at_end, kernel.plan.outputs, self._grid.inputs_at(at_end)) if at_end.any() else found
            if program is not None and program.angles:  # angles in it are continued along the stroke
                continued = program.angles[0][1].continued(self._grid, self.reached)
                found = found if continued is None else continued
            self._values[key] = found
            self._values[key].flags.writeable = False
        values = self._values[key]
        if not self._is_reached and member.name not in self.plan.ground:
            values = np.where(self.reached, values, np.nan)
        if pass_of_all:
            index = 2 * self.plan.moving.index(member.name)
            return values[index : index + 2]
        return values if isinstance(member, (Arrow, Point)) else values[0]

    def _work_out(self, quantities: Iterable[Reference]) -> None:
        """Work out quantities in one pass, kept; each by itself where it is refused or looked at closely."""
        requests = tuple(Value(self._member(each)) for each in quantities)
        with suppress(DefinitionError, SingularError):
            values, look = Evaluation(self._grid, requests).evaluate(among=self.reached.reshape(self._grid.size))
            for place, (what, own) in enumerate(zip(requests, values, strict=True) if self._stroke_shape else ()):
                if look is None or look.is_clear(place):
                    self._values[what.key], self._watched[what.key] = read_only(own[None]), False

    def _numeric(self, what: Value, step: float | None) -> FloatArray:
        member, stroke, order = what.member, what.strokes[0], what.order

        def values(offsets: FloatArray) -> FloatArray:
            shifted = {name: value[..., None] + (offsets if name == stroke else 0.0 * offsets) for name, value in self.strokes.items()}
            near = self.moved(shifted)
            return near[member.name] if member.name else near.value(member)  # type: ignore[arg-type]

        declared = self.plan.strokes[stroke]
        least = 1.0 if isinstance(member, Quantity) else 0.0  # an output may be a difference of what is much larger: rad
        found, error, still = differences.derivative(values, abs(declared.end - declared.start), order, step, least)
        most = differences.USELESS if step is None else differences.COARSE
        useless, lost = differences.losses(found, np.where(self.reached, error, 0.0), still, len(self.shape), most)
        title = f"The numerical ratio of {what.name}{'' if step is None else f' with step={step:.6g}'}"
        if step is not None:
            useless |= self.reached & ~np.isfinite(found).all(axis=tuple(range(found.ndim - len(self.shape))))
        why = "differences do not settle so near a dead point. Ask"
        if step is not None:
            why = "the difference is rounding, or goes too far or out of reach, or stands too near a dead point. "
            why += "Leave the step out, which is then chosen at every pose, or ask"
        refuse_at(self, useless, f"{title} is refused", f': {why} for method="exact".')
        if lost > differences.WARN[order]:
            other = "the exact one is not" if step is None else "without a step it is chosen at every pose"
            text = f"{title} is off by up to about {lost:.0e} of its greatest value; {other}."
            warn(SingularWarning(text, estimate=lost))
        return np.where(useless, np.nan, found)

    def _finite(self, values: FloatArray, excused: Mask, what: str) -> FloatArray:
        """Return values that are finite at every pose reached; NaN where they are not and NaN was asked for."""
        finite = np.isfinite(values)
        if np.count_nonzero(finite) == finite.size:
            return values
        good: Mask = np.asarray(finite if finite.ndim == len(self.shape) else finite.all(axis=0))
        refuse_at(
            self, ~good & self.reached & ~excused, f"{what} has no finite value", '. Leave these poses out, or ask with unreachable="nan".'
        )
        return np.where(good, values, np.nan)

    # -- near singular poses -----------------------------------------------------------------------------

    def _refused(self, what: Request, words: str) -> Mask:
        """Return the mask of poses where a result is refused; raise or warn as asked. `words` begin a sentence about it."""
        near = self._is_near_singular
        if isinstance(what, Value) and not isinstance(what.member, Point):  # of points it is known, of other values told with these
            self._evaluated(what)
            near = self._watched[what.key]
        return self._refused_near(what, words) if near else NOWHERE

    def _refused_near(self, what: Request, words: str, are_places: bool = False) -> Mask:
        """Return the mask of poses where a result is refused, all that are near singular ones looked at; raise or warn as asked."""
        refused, doubtful = np.zeros(self.shape, bool), np.zeros(self.shape, bool)
        # The mask (m, n) of poses where a request is looked at closely; ratios of all points come in one pass, kept.
        plan, place, asked = self.plan, 0, tuple[Request, ...]((what,))
        if isinstance(what, Value) and what.along and what.member.name in plan.moving:
            asked = tuple(Value(plan.points[name], what.along) for name in plan.moving)
            place = plan.moving.index(what.member.name)
        key, every = ("guards", *(each.key for each in asked)), range(len(asked))
        unplaced, _, close, _ = self._once(key, lambda: guard_masks(plan, asked, self._grid.flat, self._grid.size, every))
        near = np.asarray(unplaced | close[place]).reshape(self.shape) & self.reached
        if near.any():
            found = self._near(what, near)
            refused[near], doubtful[near] = found.refused, found.doubtful
            self._report(words, refused, doubtful, lambda mask: found.masked(mask[near]), are_places)
        return refused

    def _near(self, what: Request, mask: Mask) -> Conditioning:
        """Return how far some poses are from singular ones for a result."""
        return examined(self.plan, (what,), self._grid.inputs_at(mask), self._grid.read_at(mask), [0])[0]

    def _report(self, words: str, refused: Mask, doubtful: Mask, near: Callable[[Mask], Conditioning], are_places: bool = False) -> None:
        """Raise or warn, as asked, where a result is refused or doubtful; `near` tells how near such poses are to singular ones."""
        if refused.any() and self.unreachable == "raise":
            there = near(refused), refused, self.strokes
            raise dead_points.lost_places(*there) if are_places else dead_points.singular_error(*there, words, self)
        if doubtful.any():
            dead_points.warn_near(near(doubtful), f"{words} {where_words(self.plan, doubtful, self.strokes)}")

    def _once(self, key: Hashable, make: Callable[[], Made]) -> Made:
        """Return a result that several callers share, such as all joint forces in one situation, made once and cached."""
        if key not in self._kept:
            self._kept[key] = make()
        return cast(Made, self._kept[key])

    def __getstate__(self) -> dict[str, Any]:
        """Return the state for pickle, without cached results."""
        return vars(self) | {"_kept": {}}

    # -- read on arrays ----------------------------------------------------------------------------------

    @cached_property
    def _reading(self) -> ArrayReading:
        """The eager reading of all poses."""
        with np.errstate(all="ignore"):
            return self.plan.read(self.inputs)

    @cached_property
    def _placed(self) -> ArrayReading:
        """The eager reading whose points are where the motion has them."""
        reading = ArrayReading(self.plan.members, self.plan.table.lengths, self.inputs)
        for name in self.plan.moving:
            reading.positions[name] = Vec(*self._place(name))
        return reading

    @cached_property
    def _loop_sines(self) -> dict[str, Any]:
        """The sine of the angle between the two links of every moving loop; zero at a dead point."""
        return dead_points.loops(self.plan, self._reading)

    @cached_property
    def _joints(self) -> tuple[str, ...]:
        """The points that have a transmission angle: the joints of dyads."""
        return tuple(name for name in self.plan.points if self._meeting(name))

    def _meeting(self, name: str) -> tuple[Vec, ...]:
        with np.errstate(all="ignore"):
            return self.plan.points[name].meeting(self._placed)

    def _array(self, values: object) -> FloatArray:
        """Return numbers as arrays of floats."""
        return np.asarray(values, float)


def each_at_its_stroke(
    plan: Plan, designs: Mapping[str, Any], strokes: Mapping[str, Any], like: Motion | None = None, at: Any = slice(None)
) -> Motion:
    """Return the poses of m designs, each at a stroke of its own; a position has the shape (2, m), poses out of reach are NaN.

    `designs` and `strokes` are floats or arrays (m,) [SI]. There is no stroke along which angles could be followed: they lie
    within 180 deg of those of the poses `at` (m,) of another motion, `like`, or of zero.
    """
    size = np.broadcast_shapes((1,), *(np.shape(value) for value in (*designs.values(), *strokes.values())))
    of_each = {name: np.broadcast_to(np.asarray(value, float), size) for name, value in designs.items()}
    at_each = {name: np.broadcast_to(np.asarray(value, float), size) for name, value in strokes.items()}
    joining = not_joined if like is None else JoinedTo(like._grid, at)
    return Motion(plan, of_each, at_each, "nan", per_design=True, joining=joining)


def following_lengths(plan: Plan) -> Kernel:
    """Return the program of the lengths that follow others [m]."""
    return Kernel([plan.trace.graph.node(plan.trace.value(length)) for _, length in plan.following])


class OnePose:
    """The base of traced motions, which replace all poses while a program is made; their numbers have no value yet."""

    def _work_out(self, quantities: Iterable[Reference]) -> None:
        """Do nothing: a program is read value by value."""


def require_motion(given: object) -> Motion:
    """Return a motion, or a traced one; DefinitionError for anything else."""
    return cast(Motion, require_type("", given, (Motion, OnePose), "is no motion; give machine.sweep(...) or machine.at(...)"))


# What a part of a machine has in a motion of the whole: its design and its strokes.

SAME = 1e-9
"""A dimension of a part changes over the poses where it does by more than this, over its size or 1."""


def steady_dimension(whole: MotionLike, part: Part, name: str, axes: Axes | None) -> Numbers:
    """Return a design variable of a part as the whole has it [SI], one value a design; DefinitionError for one that changes."""
    dotted, table = f"{part.name}.{name}", whole.plan.table
    point, _, axis = name.rpartition(".")
    fused, given = whole.plan.aliases.get(f"{part.name}.{point}", ""), part.given.get(name, Number(part.plan.defaults[name]))
    if dotted in table.spellings:
        owner, sign = table.spellings[dotted]
        array = np.asarray(sign * whole.inputs[owner], float)
    elif fused and axis in ("x", "y"):
        array = whole.value(Coordinate(fused, axis, axes or FRAME_AXES))
    else:
        array = np.asarray(part.plan.defaults[name] if given is None else whole.value(quantity(given)), float)
    if array.size == 1:
        return float(array.reshape(()))
    rows = np.broadcast_to(array, whole.shape).reshape(*whole._design_shape, -1)
    first = rows[..., 0]
    if np.any(np.abs(rows - first[..., None]) > SAME * np.maximum(1.0, np.abs(first[..., None]))):
        what = f"{whole.plan.title}.{part.name}: {name} changes over the poses, so that the part alone has no such design"
        raise DefinitionError(f'{what}; ask the whole for its points, such as motion["{part.name}.{next(iter(part.plan.moving), "")}"].')
    return first if whole._design_shape else float(first)
