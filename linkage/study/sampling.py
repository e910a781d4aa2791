"""Quantities at poses of designs, with exact derivatives by dimensions: one call of the program for a whole search."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from ..errors import unwarned
from ..frozen import immutable
from ..motion import Grid, Motion, NodeRequest, Request
from ..motion.evaluation import BulkProgram, Evaluation
from ..motion.functions import evaluate_bound
from ..motion.grid import angles_of
from ..motion.measures import Leaf, constant_part, operation, traced, words_of
from ..motion.requests import Trait, slope
from ..plan import Mask, Plan
from ..program import FloatArray, Kernel, Level, Node
from ..quantities import Quantity
from ..quantities.quantity import stands_for
from ..vectors import Numbers
from .designs import DesignValues
from .measured import eager, motion_of, nothing_limits

DIFFERENCE = 6e-6
"""Of a variable's span: the step of a central difference, where nothing better is to be had."""


@immutable
class Samples:
    """Quantities at poses: `values` (k, m, n), the `margins` of the loops (r, m, n), and whether a pose is `reached` (m, n).

    `lost` (k, m) are those without a value of a design: at a pose that is reached they have none, or a divisor in them changes its sign.
    Of one design, where they are asked for, also the derivatives by p inputs: of the values (k, p, n), and of the margins (r, p, n).
    """

    values: FloatArray
    margins: FloatArray
    reached: Mask
    lost: Mask
    value_slopes: FloatArray | None = None
    margin_slopes: FloatArray | None = None


class SampleProgram:
    """Requests and derivatives of some of them as one kernel, so that a look at a design is one call.

    `angles` are those along which any of its numbers goes on from pose to pose. `slopes` are the derivatives alone with their own angles,
    for poses at which the requests have to be looked at closely; None where there are no derivatives. `may_fail` says whether a request may
    be without a value though no guard reports it.
    """

    def __init__(self, plan: Plan, requests: tuple[Request, ...], sloped: Sequence[Request], owners: tuple[str, ...]) -> None:
        bulk = BulkProgram.compiled_on(plan, requests)  # on a plan that is not traced yet
        own, self.requests, self.may_fail = bulk.kernel, requests, bulk.may_fail
        following = [node for each in requests if Trait.FOLLOWS_ANGLES in each.traits for node in each.nodes(plan)]
        shares = [node for each in sloped for node in slope(each, owners).nodes(plan)] if owners else []
        self.rows, self.kernel = len(own.outputs), Kernel([*own.outputs, *shares], own.guards)
        self.angles = angles_of(plan, [*following, *shares])
        self.slopes = (Kernel(shares), angles_of(plan, shares)) if shares else None

    def __call__(self, grid: Grid) -> tuple[FloatArray, FloatArray]:
        """Return the requests (rows, ...) over a grid, NaN where they have no value, and the derivatives (shares, ...) of one design."""
        found = self.kernel(grid.flat, size=grid.size)
        is_told = found.is_clear and not (self.may_fail and not np.isfinite(found.values[: self.rows]).all())
        if is_told and self.angles.angles:  # none goes on past half a turn
            angles = grid.full(self.angles.kernel(grid.flat, size=grid.size).values)
            is_told = bool(np.isfinite(angles).all()) and np.array_equal(grid.joining(grid, angles, self.angles.kernel), angles)
        if is_told:
            values = grid.full(found.values)
            return values[: self.rows], values[self.rows :]
        with unwarned(), np.errstate(all="ignore"):
            values = np.array([np.broadcast_to(each, grid.shape) for each in evaluate_bound(Evaluation(grid, self.requests), None, "nan")])
            if self.slopes is None:
                return values, np.zeros((0, *grid.shape))
            kernel, followed = self.slopes
            continued = followed.continued(grid)
            return values, grid.full(kernel(grid.flat, size=grid.size).values) if continued is None else continued


class Sampling:
    """Some quantities of a plan, together, at poses of designs.

    `owners` are the inputs they are differentiated by: design variables, and strokes.
    """

    def __init__(self, plan: Plan, quantities: Sequence[object], owners: Sequence[str]) -> None:
        self.plan, self.quantities, self.owners = plan, tuple(quantities), tuple(owners)
        bound = [(place, traced(plan, quantity)) for place, quantity in enumerate(self.quantities)]
        self._traced = {place: request for place, request in bound if request is not None}
        self._eager = [place for place, request in bound if request is None]
        self._divisors: list[tuple[int, Request]] = []
        for place in self._traced:
            found = [traced(plan, each) for each in divisors_of(plan, self.quantities[place])]
            self._divisors += [(place, each) for each in found if each is not None]
        self._programs: dict[tuple[bool, bool], SampleProgram] = {}

    def at(self, grid: Grid, *, margins: bool = False, slopes: bool = False) -> Samples:
        """Return the quantities over a grid, NaN where they have no value; with the margins, and of one design the derivatives."""
        (m, n), k, p = grid.size, len(self.quantities), len(self.owners)
        loops = loop_margins(self.plan) if margins else []  # before anything else is read, which may have triangles of its own
        first = len(loops) + 1
        found, shares = self._program(loops, slopes=slopes)(grid)
        found = found.reshape(len(found), m, n)
        values = np.full((k, m, n), np.nan)
        values[[*self._traced]] = found[first : first + len(self._traced)]
        if self._eager:
            with unwarned(), np.errstate(all="ignore"):
                motion = motion_of(grid)
                values[self._eager] = [eager(motion, self.quantities[place]).reshape(m, n) for place in self._eager]
        reached = np.isfinite(found[len(loops)])
        whole = values if reached.all() else np.where(reached, values, np.nan)
        empty: Mask = np.asarray(np.isnan(whole) & reached)  # no value where there is a pose, though something limits it there
        lost: Mask = np.asarray(empty.any(axis=2))
        for place in np.flatnonzero(lost.any(axis=1)).tolist():
            lost[place] = (empty[place] & ~nothing_limits(motion_of(grid), self.quantities[place]).reshape(m, n)).any(axis=1)
        for (place, _), each in zip(self._divisors, found[first + len(self._traced) :], strict=True):  # both signs, or zero somewhere
            low, high = (np.where(reached, each, end) for end in (np.inf, -np.inf))
            lost[place] |= (np.fmin.reduce(low, axis=-1, initial=np.inf) <= 0.0) & (np.fmax.reduce(high, axis=-1, initial=-np.inf) >= 0.0)
        samples = Samples(whole, found[: len(loops)], reached, lost)
        if not slopes:
            return samples
        by_owner = shares.reshape(len(loops) + len(self._traced), p, n)
        value_slopes = np.zeros((k, p, n))
        value_slopes[[*self._traced]] = by_owner[: len(self._traced)]
        for place in self._eager:
            with unwarned(), np.errstate(all="ignore"):
                value_slopes[place] = self._differences(grid, self.quantities[place])
        return replace(samples, value_slopes=value_slopes, margin_slopes=by_owner[len(self._traced) :])

    def _program(self, loops: Sequence[Request], *, slopes: bool) -> SampleProgram:
        """Return the program of the margins, of whether all has a place, of the quantities and of their divisors."""
        asked = bool(loops), slopes
        if asked not in self._programs:
            requests = (*loops, all_placed(), *self._traced.values(), *(each for _, each in self._divisors))
            sloped = [*self._traced.values(), *loops] if slopes else []
            key = "samples", tuple(each.key for each in requests), len(sloped), self.owners
            self._programs[asked] = self.plan.made(key, lambda plan: SampleProgram(plan, requests, sloped, self.owners))
        return self._programs[asked]

    def _differences(self, grid: Grid, quantity: object) -> FloatArray:
        """Return the central differences of a quantity that is not traced, shape (p, n)."""
        found = np.zeros((len(self.owners), grid.size[1]))
        for row, owner in enumerate(self.owners):
            given = grid.strokes if owner in grid.strokes else grid.designs
            step = DIFFERENCE * max(float(np.max(np.abs(given[owner]))), 0.01)
            ends = []
            for sign in (1.0, -1.0):
                moved = {owner: np.asarray(given[owner]) + sign * step}
                designs = dict(grid.designs) | (moved if given is grid.designs else {})
                strokes = dict(grid.strokes) | (moved if given is grid.strokes else {})
                near = Grid(grid.plan, designs, strokes, per_design=grid.per_design)
                ends.append(eager(motion_of(near), quantity).reshape(-1))
            found[row] = (ends[0] - ends[1]) / (2.0 * step)
        return found


def rows_of_motion(plan: Plan, quantities: Sequence[object]) -> Callable[[Motion], FloatArray]:
    """Return quantities as one function of a motion (k, ...): by the plan's program, those that are no part of it as the motion gives them.

    Poses out of reach have no value.
    """
    found = [(place, traced(plan, each)) for place, each in enumerate(quantities)]
    requests = tuple(request for _, request in found if request is not None)

    def values(motion: Motion) -> FloatArray:
        rows = np.empty((len(quantities), *motion.shape))
        with unwarned(), np.errstate(all="ignore"):
            known = iter(evaluate_bound(Evaluation(motion._grid, requests), None, "nan")) if requests else iter(())
        for place, request in found:
            rows[place] = eager(motion, quantities[place]) if request is None else np.where(motion.reached, next(known), np.nan)
        return rows

    return values


# Where there is no value.


GOES_THROUGH = ("add", "subtract", "multiply", "divide", "negative", "absolute", "power", "sqrt", "hypot")
"""The functions that grow without bounds where a part of them does."""


def divisors_of(plan: Plan, quantity: object) -> tuple[Any, ...]:
    """Return the divisors of a quantity and of its parts; where one passes zero the quantity has no bounds."""
    sign, parts = operation(stands_for(plan.members, quantity))
    if sign not in GOES_THROUGH:
        return ()
    found = [each for part in (parts if sign != "power" else parts[:1]) for each in divisors_of(plan, part)]
    if sign == "divide":
        found += zero_factors(plan, parts[1])
    if sign == "power" and isinstance(power := constant_part(parts[1]), float) and power < 0.0:
        found += zero_factors(plan, parts[0])
    return tuple(found)


def zero_factors(plan: Plan, divisor: object) -> list[object]:
    """Return the factors of a divisor, each of which makes it zero, without the sizes and powers about them."""
    sign, parts = operation(stands_for(plan.members, divisor))
    if sign in ("absolute", "power", "sqrt", "negative"):
        return zero_factors(plan, parts[0])
    if sign == "multiply":
        return [each for part in parts for each in zero_factors(plan, part)]
    return [divisor] if isinstance(divisor, (str, Quantity, Request)) and constant_part(divisor) is None else []


def no_value(plan: Plan, leaf: Leaf) -> str:
    """Return in words that a leaf has no value of some design, and why."""
    divisors = () if leaf.worst_over else divisors_of(plan, leaf.quantity)
    if not divisors:
        return f"{leaf} has no value at some poses"
    why = f"it is divided by {', '.join(map(words_of, divisors))}, and where it passes zero within the stroke, it grows without bounds"
    return f"{leaf} has no value: {why}"


# How far the links are from being too short or too long to meet.


def loop_margins(plan: Plan) -> list[NodeRequest]:
    """Return requests above zero where each loop of moving links is assembled: a squared sine, or a length [m]."""

    def margin(place: int) -> NodeRequest:
        def nodes(plan: Plan) -> tuple[Node, ...]:
            loop = plan.trace.loops[place]
            return (loop.terms[0] / loop.terms[2] if loop.kind == "links" else loop.terms[0],)

        return NodeRequest(
            text=f"margin {place}", key=("margin", place), nodes_of=nodes, names_of=lambda plan: plan.reaches(plan.trace.loops[place].step)
        )

    loops = [place for place, loop in enumerate(plan.trace.loops) if loop.kind in ("links", "length")]
    return [margin(place) for place in loops if plan.trace.loops[place].terms[0].level is not Level.CONSTANT]


def all_placed() -> NodeRequest:
    """Return a number that is finite where every point has a place."""

    def nodes(plan: Plan) -> tuple[Node, ...]:
        whole = plan.trace.graph.constant(0.0)
        for name in plan.moving:
            for node in plan.nodes(name):
                whole = whole + node
        return (whole,)

    return NodeRequest(text="all places", key="placed", nodes_of=nodes, names_of=lambda plan: plan.reaches(*plan.moving))


def with_values(designs: Mapping[str, Numbers], changed: Mapping[str, Any]) -> DesignValues:
    """Return dimensions with some of them changed; numbers as floats, and arrays of one number as such."""
    return dict(designs) | {name: float(value) if np.ndim(value) == 0 else np.asarray(value, float) for name, value in changed.items()}
