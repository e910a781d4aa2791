"""Requests over a grid of poses, by one program: poses that guards clear are taken as they are, the others are examined closely.

A close look places the poses at a dead point to rounding, and tells where a request cannot be built, has lost its digits near a singular
pose, has no value, or rests on another law than the one traced. What is said of that, and whether it is an error, is up to who asks.
"""

from __future__ import annotations

from collections.abc import Callable, Container, Iterable, Iterator, Mapping, Sequence
from functools import cached_property, reduce
from itertools import accumulate, chain, pairwise
from typing import Any, NamedTuple

import numpy as np

from ..errors import DefinitionError
from ..frozen import record
from ..plan import NEAR, ArrayReading, Mask, Plan, failures, negative
from ..program import LAST, QUICKEST, FloatArray, Kernel, Node, Result, RunOptions, Scatter, disturbed
from .dead_points import DOUBTFUL, ROUGH, Conditioning, PrecisionLeft, iterated, loop_conditions, moving_members
from .grid import Angles, Grid, Made, angles_behind, angles_of, to_rounding
from .over import Over
from .requests import Request, Trait

PIECE = 1 << 18
"""Poses that are looked at again at a time."""


class BulkProgram(NamedTuple):
    """The kernel of some requests: `parts`, the rows of each; `angles`: rows, and the angles that they follow.

    `may_fail`: there may be poses without a value that no guard reports.
    """

    kernel: Kernel
    parts: tuple[slice, ...]
    angles: tuple[tuple[list[int], Angles], ...]
    may_fail: bool

    @classmethod
    def for_requests(cls, plan: Plan, requests: Sequence[Request]) -> BulkProgram:
        """Return the program of requests that are bound to a plan, made once; guards watch the members they are built from."""
        return of_all("bulk", plan, requests, cls.compiled_on)

    @classmethod
    def compiled_on(cls, plan: Plan, requests: Sequence[Request]) -> BulkProgram:
        """Return the same on a plan, which traces them: one of its own, or that which all laws share."""
        nodes = [each.nodes(plan) for each in requests]
        noted = dict.fromkeys(chain(*(each.notes(plan).assumed for each in requests), *(each.gaps(plan) for each in requests)))
        watched = plan.trace.watched(members_behind(plan, requests), max((each.regular for each in requests), default=0.0))
        lengths = [each.rows for each in requests]
        parts = tuple(slice(end - rows, end) for end, rows in zip(accumulate(lengths), lengths, strict=True))
        followed: dict[tuple[Node, ...], list[int]] = {}
        for part, own, each in zip(parts, nodes, requests, strict=True):
            behind = angles_behind(plan, own) if Trait.FOLLOWS_ANGLES in each.traits else ()
            if behind:
                followed.setdefault(behind, []).extend(range(part.start, part.stop))
        flat = [node for each in nodes for node in each]
        angles = tuple((rows, angles_of(plan, [flat[row] for row in rows])) for rows in followed.values())
        may_fail = plan.may_overflow or any(Trait.MAY_FAIL in each.traits for each in requests)
        return cls(Kernel(flat, [*noted, *watched]), parts, angles, may_fail)

    def split(self, values: FloatArray) -> list[FloatArray]:
        """Return one array a request of values, shape (rows, ...): (...), of a point (2, ...)."""
        return [values[part] if part.stop - part.start > 1 else values[part.start] for part in self.parts]

    def is_clear(self, result: Result) -> bool:
        """Return whether no pose of a result has to be looked at closely."""
        return result.is_clear and not (self.may_fail and not np.isfinite(result.values).all())


def require_rates(plan: Plan, kernel: Kernel, known: Container[str]) -> None:
    """Raise DefinitionError where a kernel asks how fast strokes move, and nothing says it: inputs that are not `known`."""
    missing = [name for name in kernel.plan.input_names[1] if name not in known]
    if missing:
        what = f"{plan.title}: what is asked for follows {', '.join(missing)}, and nothing says how fast the strokes move"
        timed = next((f', over="{name}"' for name, over in plan.of_kind(Over).items() if over.time is not None), "")
        raise DefinitionError(f"{what}; give rates= and accelerations= to evaluate, or sweep over a path in time{timed}.")


def members_behind(plan: Plan, requests: Iterable[Request]) -> set[str]:
    """Return the members that requests are built from."""
    return set().union(*(each.names(plan) for each in requests))


class CloseLook(NamedTuple):
    """Where requests over a grid have trouble, masks (requests, m, n): `refused` near a singular pose, `doubtful` next to one.

    They are `missing` where they have no value, and `empty` where that is no error. `broken` (m, n): where a law is another than the one
    traced. `worst` says of each request that is doubtful somewhere, by its number, how near a singular pose it is where it is off by most.
    """

    refused: Mask
    doubtful: Mask
    missing: Mask
    empty: Mask
    broken: Mask
    worst: dict[int, Conditioning]

    def is_clear(self, request: int) -> bool:
        """Return whether a request, by its number, has values at all poses, none of them doubtful."""
        masks = (self.refused, self.doubtful, self.missing)
        return not (self.broken.any() or any(mask[request].any() for mask in masks))

    def in_block(self, band: slice, part: slice) -> CloseLook:
        """Return the same of a part of the grid, written into this one."""
        refused, doubtful, missing, empty = (mask[:, band, part] for mask in (self.refused, self.doubtful, self.missing, self.empty))
        return CloseLook(refused, doubtful, missing, empty, self.broken[band, part], self.worst)


@record
class Evaluation:
    """Requests over a grid of poses, and how they are worked out. `among` are the places of those that count, by default all.

    So some requests are asked by the program of many that is there already; the values of the others may be anything.
    """

    grid: Grid
    requests: tuple[Request, ...]
    options: RunOptions = QUICKEST
    among: tuple[int, ...] | None = None

    @cached_property
    def program(self) -> BulkProgram:
        """The kernel of the requests and the meaning of its rows."""
        return BulkProgram.for_requests(self.grid.plan, self.requests)

    @cached_property
    def counting(self) -> dict[int, Request]:
        """The requests that count, by their places."""
        return {place: self.requests[place] for place in (range(len(self.requests)) if self.among is None else self.among)}

    @cached_property
    def rows(self) -> list[int]:
        """The rows of the requests that count."""
        return [row for place in self.counting for row in range(len(self.program.kernel.plan.outputs))[self.program.parts[place]]]

    def evaluate(self, out: FloatArray | None = None, among: Mask | None = None) -> tuple[list[FloatArray], CloseLook | None]:
        """Return one array a request, NaN without a value, and the close look; None where all guards are clear.

        The arrays are rows of `out` (rows, m, n) where it is given. `among` (m, n) are the poses that are looked at closely.
        """
        grid, program = self.grid, self.program
        require_rates(grid.plan, program.kernel, {*grid.unsolved, *grid.plan.solved})
        result = grid.kernel_result(program.kernel, out, self.options)
        look = None if program.is_clear(result) else self._settle(result.values, among)
        found = grid.full(result.values)
        if program.angles and (grid.stroke_shape or not grid.joins_itself):
            # angles go on along the stroke
            for rows, angles in self.program.angles:
                reached = np.isfinite(found[rows])
                continued = angles.continued(self.grid, np.asarray(reached.any(axis=0)), self.options)
                if continued is not None:
                    found[rows] = np.where(reached, continued, np.nan)
        return program.split(found), look

    def _settle(self, place: FloatArray, among: Mask | None) -> CloseLook:
        """Put right the values (rows, m, n) where a guard tells: place poses to rounding, NaN where a request has none."""
        plan, size = self.grid.plan, self.grid.size
        refused, doubtful, missing, empty = np.zeros((4, len(self.requests), *size), bool)
        look = CloseLook(refused, doubtful, missing, empty, np.zeros(size, bool), {})
        for band, part in grid_blocks(*size):
            inputs = {name: part_of_input(value, band, part, name in plan.table.entries) for name, value in self.grid.flat.items()}
            block, here = place[:, band, part], look.in_block(band, part)
            _, height, width = block.shape
            masks = guard_masks(plan, self.requests, inputs, (height, width), [*self.counting], self.options)
            unplaced, unlike, near, here.empty[...] = masks
            for number in self.counting:
                block[self.program.parts[number], here.empty[number]] = 0.0
            broken = np.asarray(unlike.any(axis=0))
            bad = broken | unplaced | near.any(axis=0) | ~np.isfinite(block[self.rows]).all(axis=0)
            bad &= True if among is None else among[band, part]
            if bad.any():
                shaped = {name: np.asarray(value, float) for name, value in inputs.items()}
                own = {name for name, value in shaped.items() if value.ndim == 1 and name in plan.table.entries}  # one a design
                full = {name: value[:, None] if name in own else value for name, value in shaped.items()}
                at_bad = {name: np.broadcast_to(value, bad.shape)[bad] if value.ndim else value for name, value in full.items()}
                here.broken[...] = broken & bad
                self._put_right(block, bad, at_bad, near[:, bad], here)
            for number in self.counting:
                block[self.program.parts[number], here.empty[number]] = np.nan
        return look

    @np.errstate(all="ignore")
    def _put_right(self, block: FloatArray, bad: Mask, inputs: dict[str, FloatArray], near: Mask, look: CloseLook) -> None:
        """Fill the `bad` poses of a block, from their inputs, (n,) or one for all; `near`: where each request is looked at closely."""
        plan, lost = self.grid.plan, ~np.isfinite(block[self.rows][:, bad]).all(axis=0)
        lost |= negative(plan, plan.reading(inputs), lost.shape)
        if lost.any():  # where something that the requests are built from cannot be placed
            names, failed = members_behind(plan, self.counting.values()), np.zeros(int(lost.sum()), bool)
            for name, mask in failures(plan, plan.read(some_inputs(inputs, lost)), failed.shape):
                if name in names:
                    failed |= mask
            lost[lost] = failed
        refused, doubtful = near & ~lost, np.zeros(near.shape, bool)
        here, among = np.asarray(refused.any(axis=0)), np.flatnonzero(refused.any(axis=1)).tolist()
        at = some_inputs(inputs, here)
        for k, found in zip(among, examined(plan, self.requests, at, plan.read(at), among) if among else (), strict=True):
            doubtful[k, here], refused[k, here] = refused[k, here] & found.doubtful, refused[k, here] & found.refused
            if doubtful[k].any():
                told = found.masked(doubtful[k, here])
                told = told.masked(told.error == told.error.max())
                if k not in look.worst or told.error[0] > look.worst[k].error[0]:
                    look.worst[k] = told
        look.refused[:, bad], look.doubtful[:, bad] = refused, doubtful
        look.broken[bad] &= ~lost & ~refused.any(axis=0)
        for number, request in self.counting.items():  # to rounding where they stand at a dead point, NaN where one has no value
            rows = self.program.parts[number]
            values, without = block[rows, bad], lost | refused[number]
            at_end = ~without & ~np.isfinite(values).all(axis=0)
            if not request.order and at_end.any():
                values = to_rounding(values, at_end, self.program.kernel.plan.outputs[rows], some_inputs(inputs, at_end))
            look.missing[number, bad] = without = without | ~np.isfinite(values).all(axis=0)
            block[rows, bad] = np.where(without, np.nan, values)


def watch_of(plan: Plan, requests: Sequence[Request]) -> tuple[Kernel, list[list[int]], list[list[int]], list[int]]:
    """Return the kernel of how near each request is to a singular pose, and behind that of conditions, each once.

    With it its rows of each request's assumptions, of each request's gaps, and of what tells whether there is a place.
    """
    near = list[Node]()
    for each in requests:
        each.nodes(plan)  # directions of its own are noted then
        near.append(plan.trace.least_nearness(each.names(plan)) - each.regular)
    every = [*(each.notes(plan).assumed for each in requests), *(each.gaps(plan) for each in requests)]
    every.append(plan.trace.placeable(members_behind(plan, requests)))
    place = {node: row for row, node in enumerate(dict.fromkeys(chain(*every)), len(near))}
    rows = [[place[node] for node in nodes] for nodes in every]
    return Kernel([*near, *place]), rows[: len(near)], rows[len(near) : -1], rows[-1]


def guard_masks(
    plan: Plan, what: Sequence[Request], inputs: Mapping[str, Any], size: tuple[int, int], among: Sequence[int], way: RunOptions = QUICKEST
) -> tuple[Mask, Mask, Mask, Mask]:
    """Return the mask (m, n) of poses where there is no place, and masks (requests, m, n), of some `among` the requests.

    They tell where an assumption of each request does not hold, where it has to be looked at closely, and where it has no value, which
    is no error.
    """
    kernel, *rows, placeable = of_all("guards", plan, what, watch_of)
    with np.errstate(invalid="ignore"):
        values = np.broadcast_to(kernel(inputs, size=size, way=way).values, (len(kernel.plan.outputs), *size))
        above = values > 0.0
    unlike, near, empty = np.zeros((3, len(what), *size), bool)
    near[among] = ~above[among]
    none = np.array([-each.regular for each in what])[:, None, None]  # a product of nothing: no look clears what has no place
    near &= ~keeps_digits(plan, what, inputs, near & (values[: len(what)] > none))
    for mask, own in zip((unlike, empty), rows, strict=True):
        for number in among:
            if own[number]:
                mask[number] = ~above[own[number]].all(axis=0)
    return np.asarray(~above[placeable].all(axis=0)), unlike, near, empty


def grid_blocks(m: int, n: int, most: int = PIECE) -> Iterator[tuple[slice, slice]]:
    """Yield parts of a grid of at most so many poses."""
    width = max(1, min(n, most))
    height = max(1, most // width)
    for top in range(0, m, height):
        for left in range(0, n, width):
            yield slice(top, min(top + height, m)), slice(left, min(left + width, n))


def part_of_input(value: Any, band: slice, part: slice, of_design: bool) -> Any:
    """Return the part of a flat input that belongs to a part of the grid."""
    if type(value) is float or np.size(value) == 1:
        return value
    if np.ndim(value) == 2:
        return value[band if value.shape[0] > 1 else slice(None), part]
    return value[band] if of_design else value[part]


def some_inputs(inputs: Mapping[str, FloatArray], mask: Mask) -> dict[str, FloatArray]:
    """Return the inputs (n,) of some poses; one number that all have stays."""
    return {name: value[mask] if value.ndim else value for name, value in inputs.items()}


# Near singular poses.


DIGITS = 1e-10
"""The relative error that a coarse look finds, below which a result is not doubtful: such a look errs by less than 1000."""
MANY = 1.0 / 64
"""Of so many poses at least, all are looked at coarsely by a compiled program; of fewer each is looked at closely."""


def keeps_digits(plan: Plan, requests: Sequence[Request], inputs: Mapping[str, Any], near: Mask) -> Mask:
    """Return the mask (requests, designs, poses) of which a coarse look shows that a request keeps its digits; none where few are `near`.

    The product of all parts that come near says what is lost where each multiplies what the others lose, as hardly any machine does.
    """
    many = near.sum(axis=(1, 2)) >= MANY * near[0].size
    clear = np.zeros(near.shape, bool)
    if not near[many].any():
        return clear
    kernel, counts = of_all("coarse", plan, requests, coarse_look)
    is_one = near.shape[1] == 1
    asked = near[many].any(axis=0) | (not is_one)  # of one design these poses alone
    size = len(asked), int(asked.sum()) // len(asked)
    given = {name: np.ravel(value)[asked[0]] if is_one and np.size(value) > 1 else value for name, value in inputs.items()}
    values = np.broadcast_to(kernel(given, size=size).values, (len(kernel.plan.outputs), *size)).reshape(len(kernel.plan.outputs), -1)
    extent, (own, shaken), least = np.sqrt(values[0]), np.split(values[1 : 1 + 2 * sum(counts)], 2), values[1 + 2 * sum(counts) :]
    with np.errstate(all="ignore"):
        left = PrecisionLeft(own, LAST * np.abs(shaken - own), extent)
        for k, (what, count, last) in enumerate(zip(requests, counts, accumulate(counts), strict=True)):
            if many[k]:
                error = what.error(plan, left.some_rows(slice(last - count, last)))
                clear[k, asked] = (error <= DIGITS) & (least[k] > NEAR**2)
    return clear & near


def coarse_look(plan: Plan, requests: Sequence[Request]) -> tuple[Kernel, list[int]]:
    """Return the kernel of the size, the requests' error nodes, the same disturbed and the least parts; and the number of nodes of each."""
    own = [each.rounding_nodes(plan) for each in requests]
    flat = [node for each in own for node in each]
    least = [plan.trace.least_part(each.names(plan)) for each in requests]
    return Kernel([plan.trace.graph.node(plan.trace.extent), *flat, *disturbed(flat, iterated(plan)), *least]), list(map(len, own))


def of_all(name: str, plan: Plan, requests: Sequence[Request], make: Callable[[Plan, Sequence[Request]], Made]) -> Made:
    """Return an object made once of requests together; laws take long to trace, so their program is shared by all looks."""
    made = plan.made_beside if any(Trait.OF_LAWS in each.traits for each in requests) else plan.made
    return made((name, *(each.key for each in requests)), lambda twin: make(twin, requests))


def examined(
    plan: Plan, requests: Sequence[Request], inputs: Mapping[str, Any], reading: ArrayReading, among: Sequence[int]
) -> list[Conditioning]:
    """Return how far poses are from singular ones for some `among` the requests: inputs as floats or (n,), and the eager reading there."""
    nodes, pins, extent, scatters = of_all(
        "rounding",
        plan,
        requests,
        lambda twin, these: (
            [each.rounding_nodes(twin) for each in these],
            iterated(twin),
            twin.trace.graph.node(twin.trace.extent),
            dict[tuple[int, ...], Scatter](),
        ),
    )
    chosen, key = [nodes[k] for k in among], tuple(among)
    if key not in scatters:
        scatters[key] = Scatter([*(node for each in chosen for node in each), extent], pins)
    values, errors = scatters[key].at(inputs)
    found, size, moves = list[Conditioning](), np.sqrt(values[-1]), moving_members(plan)
    for k, (first, last) in zip(among, pairwise(accumulate(map(len, chosen), initial=0)), strict=True):
        what, own, left = requests[k], reading.copied(), PrecisionLeft(values[first:last], errors[first:last], size)
        what.read_own(own)  # its own notes in the reading count for no other
        names, error = what.names(plan), what.error(plan, left)
        moving = {name: each for name, each in own.closest.items() if not name or (name in names and name in moves)}
        with np.errstate(all="ignore"):  # over the machine's size
            spans = {name: np.sqrt(square / values[-1]) for name, square in moving.items()}
        conditions = loop_conditions(plan, own, names)
        if Trait.STANDS_FOR_OTHERS in what.traits:  # what the loops alone lose
            error = reduce(np.maximum, (0.3 * np.finfo(float).eps * cond * cond for cond in conditions.values()), error)
        steep = frozenset(what.differentiated(plan))
        found.append(Conditioning(plan, conditions, spans, error, steep, DOUBTFUL if what.order else ROUGH))
    return found


def other_law_error(plan: Plan, what: Request) -> DefinitionError:
    """Return the error for poses where a law goes another way than the one that was traced."""
    laws = ", ".join(dict.fromkeys(what.notes(plan).assumed.values()))
    law = f"the law of {laws}" if laws else "a law"
    return DefinitionError(
        f"{plan.title}: {what.sentence}: at some of these poses {law} goes another way than the one traced, "
        "or has no finite value. Leave them out, choose by np.where in the law, or take finite differences of the forces."
    )
