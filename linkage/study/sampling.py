"""Quantities at poses of designs, with exact derivatives by dimensions: what a search asks of the program, in one call for all."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, final

import numpy as np

from ..errors import AssemblyError, UntracedError, unwarned
from ..motion import BoundRequest, Grid, Motion, Request
from ..motion.evaluation import Evaluation
from ..motion.grid import Angles, JoinedTo, angles_of
from ..motion.measures import traced
from ..motion.requests import Combined, Slope
from ..plan import Mask, Plan
from ..program import QUICKEST, FloatArray, Kernel, Level
from ..quantities import Function, Negative, Number, Quantity, Ref, Sum
from ..quantities.quantity import Operation
from .checks import quantity_values

DIFFERENCE = 6e-6
"""Of a variable's span: the step of a central difference, where nothing better is to be had."""


@final
@dataclass(frozen=True, eq=False)
class Seen:
    """Quantities at poses: `values` (k, m, n), the `margins` of the loops (r, m, n), and whether a pose is `reached` (m, n).

    `lost` (k, m) are those without a value of a design: at a pose that is reached they have none, or a divisor in them changes its sign.
    """

    values: FloatArray
    margins: FloatArray
    reached: Mask
    lost: Mask


@final
@dataclass(frozen=True, eq=False)
class SampledSlopes:
    """Derivatives by p inputs: of k quantities (k, p, n) and of the margins (r, p, n), of one design."""

    values: FloatArray
    margins: FloatArray


@final
class Sampling:
    """Some quantities of a plan, together: `seen` and `slopes` of designs at poses.

    `owners` are the inputs they are differentiated by: design variables, and strokes.
    """

    def __init__(self, plan: Plan, quantities: Sequence[Any], owners: Sequence[str]) -> None:
        self.plan, self.quantities, self.owners = plan, tuple(quantities), tuple(owners)
        self._traced: dict[int, BoundRequest] = {}
        self._eager: list[int] = []
        for place, quantity in enumerate(self.quantities):
            request = traced(plan, quantity)
            if request is None:
                self._eager.append(place)
            else:
                self._traced[place] = request
        self._divisors: list[tuple[int, BoundRequest]] = []
        for place in self._traced:
            found = [traced(plan, each) for each in divisors_of(plan, self.quantities[place])]
            self._divisors += [(place, each) for each in found if each is not None]

    # -- values ------------------------------------------------------------------------------------------

    def seen(self, grid: Grid, *, margins: bool = False) -> Seen:
        """Return the quantities over a grid, NaN where they have no value; with the margins where they are asked for."""
        m, n = grid.size
        values = np.full((len(self.quantities), m, n), np.nan)
        loops = Margin.each_of(self.plan) if margins else []  # before anything else is read, which may have triangles of its own
        requests = (*loops, Placed(), *self._traced.values(), *(each for _, each in self._divisors))
        with unwarned(), np.errstate(all="ignore"):
            found = [np.broadcast_to(each, grid.shape).reshape(m, n) for each in Evaluation(grid, requests, QUICKEST, "nan").run(None)]
            first = len(loops) + 1
            for place, each in zip(self._traced, found[first:], strict=False):
                values[place] = each
            if self._eager:
                motion = motion_of(grid)
                for place in self._eager:
                    values[place] = eager(motion, self.quantities[place]).reshape(m, n)
        reached = np.isfinite(found[len(loops)])
        whole = values if reached.all() else np.where(reached, values, np.nan)
        lost = self._lost(grid, whole, reached)
        for (place, _), each in zip(self._divisors, found[first + len(self._traced) :], strict=True):
            lost[place] |= changes_sign(each, reached)
        return Seen(whole, np.array(found[: len(loops)]).reshape(len(loops), m, n), reached, lost)

    def _lost(self, grid: Grid, values: FloatArray, reached: Mask) -> Mask:
        """Return which quantities (k, m) have no value at a pose that is reached, though nothing leaves them unlimited there."""
        empty: Mask = np.asarray(np.isnan(values) & reached)
        lost: Mask = np.asarray(empty.any(axis=2))
        for place in np.flatnonzero(lost.any(axis=1)):
            free = unlimited(motion_of(grid), self.quantities[place])
            if free is not None:
                lost[place] = (empty[place] & ~free.reshape(reached.shape)).any(axis=1)
        return lost

    # -- derivatives -------------------------------------------------------------------------------------

    def slopes(self, grid: Grid, *, margins: bool = True) -> SampledSlopes:
        """Return the derivatives over a grid of one design, those of the margins where they are asked for."""
        n, p = grid.size[1], len(self.owners)
        values = np.zeros((len(self.quantities), p, n))
        if not p:
            return SampledSlopes(values, np.zeros((len(Margin.each_of(self.plan)) if margins else 0, 0, n)))
        with unwarned(), np.errstate(all="ignore"):
            kernel, angles = self._program(margins)
            found = grid.full(kernel(grid.flat).values)
            found = np.broadcast_to(found, (len(kernel.plan.outputs), *grid.shape)).reshape(-1, p, n)
            rows = p * len(self._traced)
            continued = angles.continued(grid)
            if continued is not None:
                found = np.concatenate([continued.reshape(-1, p, n), found[rows // p :]])
            for row, place in enumerate(self._traced):
                values[place] = found[row]
            for place in self._eager:
                values[place] = self._differences(grid, self.quantities[place])
        return SampledSlopes(values, found[len(self._traced) :])

    def _program(self, margins: bool) -> tuple[Kernel, Angles]:
        """Return the kernel of all derivatives, then those of the margins; and the angles behind the first."""
        keys = tuple(each.key for each in self._traced.values())

        def make(plan: Plan) -> tuple[Kernel, Angles]:
            loops = Margin.each_of(plan) if margins else []  # before anything else is read, which may have triangles of its own
            shares = [node for each in self._traced.values() for node in Slope(each, self.owners).nodes(plan)]
            return Kernel([*shares, *(node for each in loops for node in Slope(each, self.owners).nodes(plan))]), angles_of(plan, shares)

        return self.plan.made(("search slopes", keys, self.owners, margins), make)

    def _differences(self, grid: Grid, quantity: Any) -> FloatArray:
        """Return the central differences of a quantity that is not traced, shape (p, n)."""
        found = []
        for owner in self.owners:
            given = grid.strokes if owner in grid.strokes else grid.designs
            step = DIFFERENCE * max(float(np.max(np.abs(given[owner]))), 0.01)
            ends = []
            for sign in (1.0, -1.0):
                moved = {owner: np.asarray(given[owner]) + sign * step}
                designs = dict(grid.designs) | (moved if given is grid.designs else {})
                strokes = dict(grid.strokes) | (moved if given is grid.strokes else {})
                near = Grid(grid.plan, designs, strokes, per_design=grid.per_design)
                ends.append(eager(motion_of(near), quantity).reshape(-1))
            found.append((ends[0] - ends[1]) / (2.0 * step))
        return np.array(found)


def motion_of(grid: Grid) -> Motion:
    """Return the motion over a grid, NaN out of reach."""
    joining = grid._joining if isinstance(grid._joining, JoinedTo) else None
    return Motion(grid.plan, grid.designs, grid.strokes, "nan", per_design=grid.per_design, joining=joining)


def eager(motion: Motion, quantity: Any) -> FloatArray:
    """Return a quantity at every pose of a motion, NaN where it has no value."""
    if isinstance(quantity, str) and quantity not in motion.plan.members and quantity in motion.plan.table.spellings:
        owner, sign = motion.plan.table.spellings[quantity]
        return np.asarray(np.broadcast_to(sign * motion.inputs[owner], motion.shape))
    found = quantity.of(motion) if isinstance(quantity, Request) else quantity_values(motion, quantity, endless=True)
    return np.asarray(np.broadcast_to(found, motion.shape))


def value_on(quantity: Any) -> Callable[[Motion], FloatArray]:
    """Return a quantity as a function of a motion, as the search for extremes between poses takes it."""

    def value(motion: Motion) -> FloatArray:
        return eager(motion, quantity)

    return value


def quickly_on(plan: Plan, quantity: Any) -> Callable[[Motion], FloatArray]:
    """Return a quantity as `value_on`, by the plan's program where it is part of it: some times as quick."""
    request = traced(plan, quantity)
    if request is None:
        return value_on(quantity)

    def value(motion: Motion) -> FloatArray:
        with unwarned(), np.errstate(all="ignore"):
            (found,) = Evaluation(motion._grid, (request,), QUICKEST, "nan").run(None)
        return np.asarray(np.broadcast_to(np.where(motion.reached, found, np.nan), motion.shape))

    return value


# Where there is no value.


def unlimited(motion: Motion, quantity: Any) -> Mask | None:
    """Return the mask of poses at which nothing limits a quantity, so that it has no value there; None of one that always has."""
    if not isinstance(quantity, Request):
        return None
    try:
        with unwarned(), np.errstate(all="ignore"):
            found = quantity.unlimited(motion)
    except (AssemblyError, UntracedError):  # what it would say is refused there, or depends on more than the pose
        return None
    return None if found is None else np.asarray(np.broadcast_to(found, motion.shape))


def changes_sign(values: FloatArray, reached: Mask) -> Mask:
    """Return of which designs values (m, n) have both signs, or are zero somewhere."""
    low, high = (np.where(reached, values, end) for end in (np.inf, -np.inf))
    return np.asarray((np.nanmin(low, axis=-1, initial=np.inf) <= 0.0) & (np.nanmax(high, axis=-1, initial=-np.inf) >= 0.0))


GOES_THROUGH = ("add", "subtract", "multiply", "divide", "negative", "absolute", "power", "sqrt", "hypot")
"""The functions that grow without bounds where a part of them does."""


def divisors_of(plan: Plan, quantity: Any) -> tuple[Any, ...]:
    """Return what a quantity is divided by, directly or in its parts: where one of these passes zero it has no bounds."""
    known = plan.members.get(quantity) if isinstance(quantity, str) else quantity
    if isinstance(known, Ref):
        return divisors_of(plan, known.target)
    sign, parts = operation(known)
    if sign not in GOES_THROUGH:
        return ()
    found = [each for part in (parts if sign != "power" else parts[:1]) for each in divisors_of(plan, part)]
    if sign == "divide":
        found += zero_factors(plan, parts[1])
    if sign == "power" and isinstance(power := constant_part(parts[1]), float) and power < 0.0:
        found += zero_factors(plan, parts[0])
    return tuple(found)


def zero_factors(plan: Plan, divisor: Any) -> list[Any]:
    """Return the factors of a divisor, each of which makes it zero, without the sizes and powers about them."""
    known = plan.members.get(divisor) if isinstance(divisor, str) else divisor
    if isinstance(known, Ref):
        return zero_factors(plan, known.target)
    sign, parts = operation(known)
    if sign in ("absolute", "power", "sqrt", "negative"):
        return zero_factors(plan, parts[0])
    if sign == "multiply":
        return [each for part in parts for each in zero_factors(plan, part)]
    return [divisor] if isinstance(divisor, (str, Quantity, Request)) and constant_part(divisor) is None else []


def constant_part(part: Any) -> float | None:
    """Return a number that stands in a quantity; None of anything else."""
    return part.number if isinstance(part, Number) else part if isinstance(part, float) else None


def operation(quantity: Any) -> tuple[str, tuple[Any, ...]]:
    """Return by which of NumPy's functions a quantity is made, and of what; "" for one that is no such thing."""
    if isinstance(quantity, Combined):
        return quantity.function, quantity.parts
    if isinstance(quantity, Operation):
        return {"*": "multiply", "/": "divide", "**": "power"}[quantity.symbol], quantity.parts()
    if isinstance(quantity, Function):
        return quantity.function, quantity.parts()
    named = {Sum: "add", Negative: "negative"}.get(type(quantity), "")
    return named, quantity.parts() if named else ()


# How far the links are from being too short or too long to meet.

@final
@dataclass(frozen=True)
class Margin(BoundRequest):
    """What is above zero where one loop of links is assembled: a squared sine, or a length [m]; by the loop's number."""

    place: int

    @classmethod
    def each_of(cls, plan: Plan) -> list[Margin]:
        """Return those of a plan, of what moves."""
        loops = [place for place, loop in enumerate(plan.trace.loops) if loop.kind in ("links", "length")]
        return [cls(place) for place in loops if plan.trace.loops[place].terms[0].level is not Level.CONSTANT]

    @property
    def key(self) -> Any:
        return "margin", self.place

    def nodes(self, plan: Plan) -> tuple[Any, ...]:
        loop = plan.trace.loops[self.place]
        return (loop.terms[0] / loop.terms[2] if loop.kind == "links" else loop.terms[0],)

    def names(self, plan: Plan) -> set[str]:
        return plan.reaches(plan.trace.loops[self.place].step)

    def __str__(self) -> str:
        return f"margin {self.place}"


@final
@dataclass(frozen=True)
class Placed(BoundRequest):
    """A number that is finite where every point has a place."""

    @property
    def key(self) -> Any:
        return "placed"

    def nodes(self, plan: Plan) -> tuple[Any, ...]:
        whole = plan.trace.graph.constant(0.0)
        for name in plan.moving:
            for node in plan.nodes(name):
                whole = whole + node
        return (whole,)

    def names(self, plan: Plan) -> set[str]:
        return plan.reaches(*plan.moving)

    def __str__(self) -> str:
        return "all places"


def with_values(designs: Mapping[str, Any], changed: Mapping[str, Any]) -> dict[str, Any]:
    """Return dimensions with some of them changed; numbers as floats, and arrays of one number as such."""
    return dict(designs) | {name: float(value) if np.ndim(value) == 0 else np.asarray(value, float) for name, value in changed.items()}
