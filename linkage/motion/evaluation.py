"""Values and ratios of many poses in one pass, of nothing but what is asked for: the call under studies."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from itertools import accumulate
from math import isfinite, nan
from typing import Any, TypeAlias, final

import numpy as np

from ..checks import require
from ..errors import DefinitionError, SingularError, UntracedError, one_word
from ..plan import Mask, Plan, failures, negative, require_kinds
from ..program import LANGUAGES, NO_VALUE, QUICKEST, FloatArray, Kernel, Node, Result, RunOptions
from ..quantities import numbers_in
from ..units import Amount
from . import conditions
from .conditions import Conditioning
from .grid import Angles, Grid, angles_of, to_rounding, varies
from .live import live_source, true_nodes
from .motion import Motion
from .requests import (
    Request,
    RequestLike,
    all_bound,
    examined,
    identities_of,
    keeps_digits,
    known_bound,
    nearness_of,
    of_all,
    other_law_error,
)
from .strokes import at_values, float_array, known_strokes

PIECE = 1 << 18
"""Poses that are looked at again at a time."""


def evaluate(
    plan: Plan,
    designs: Mapping[str, Any],
    strokes: Mapping[str, Any],
    requests: Sequence[RequestLike],
    out: FloatArray | None,
    way: RunOptions,
    unreachable: str,
    per_design: bool = False,
) -> list[FloatArray]:
    """Return the values of requests of designs at strokes; see Mechanism.evaluate."""
    require_kinds(plan, strokes)
    if out is None and unreachable in ("raise", "nan"):
        with suppress(UntracedError):
            found = at_one_pose(plan, designs, strokes, requests) if way == QUICKEST else None
            if found is None:
                found = at_few_poses(plan, designs, strokes, requests, way)
            if found is not None:
                return found
    return evaluate_grid(Grid(plan, designs, at_values(strokes, plan, float_array), per_design=per_design), requests, out, way, unreachable)


def evaluate_grid(
    grid: Grid, requests: Sequence[RequestLike], out: FloatArray | None, way: RunOptions, unreachable: str
) -> list[FloatArray]:
    """Return the values of requests over a grid; see Mechanism.evaluate."""
    one_word("unreachable", unreachable, ("raise", "nan"))
    try:
        found = known_bound(grid.plan, requests)
    except UntracedError:
        return evaluate_apart(grid, requests, out, way, unreachable)
    return Evaluation(grid, found, way, unreachable).run(out)


def evaluate_apart(
    grid: Grid, requests: Sequence[RequestLike], out: FloatArray | None, way: RunOptions, unreachable: str
) -> list[FloatArray]:
    """Return the same of requests some of which have no program: these as a motion of the same poses gives them."""
    motion = Motion(grid.plan, grid.designs, grid.strokes, unreachable, per_design=grid.per_design)
    found = []
    for each in requests:
        try:
            found += Evaluation(grid, all_bound(grid.plan, [each]), way, unreachable).run(None)
        except UntracedError:
            found.append(motion[each])
    rows = [np.reshape(each, (-1, *grid.shape)) for each in found]
    if out is not None:
        whole = checked_out(grid, sum(map(len, rows)), out)
        np.concatenate(rows, out=whole)
        rows = np.split(whole, np.cumsum([len(each) for each in rows])[:-1])
    return [part if each.ndim > len(grid.shape) else part[0] for part, each in zip(rows, found, strict=True)]


def at_one_pose(
    plan: Plan, designs: Mapping[str, object], strokes: Mapping[str, object], requests: Sequence[RequestLike]
) -> list[FloatArray] | None:
    """Return the values of requests at one pose within the declared strokes; None where it has to be looked at closely, or are several.

    The program of requests that are known from before is found by what they are; nothing is bound or traced again.
    """
    if len(strokes) != len(plan.strokes) or plan.solved:
        return None
    values = []
    for name, stroke in plan.strokes.items():
        value = strokes.get(name)
        if not (isinstance(value, float) or type(value) is int):
            return None
        if not (stroke.start <= value <= stroke.end or stroke.end <= value <= stroke.start):
            return None
        values.append(float(value))  # NumPy's own would not raise where it is divided by zero
    identities = identities_of(plan, requests)
    if identities is None:
        return None
    program = plan.made(("one pose", identities), lambda _: PoseProgram(plan, all_bound(plan, requests)))
    pose = program.of_design(designs)
    found = None if pose is None else pose(values)
    return None if found is None else program.bulk.split(np.array(found))


FEW = 8192
"""Poses of one design that are worked out at once before any of them is looked at closely."""


def at_few_poses(
    plan: Plan, designs: Mapping[str, Any], strokes: Mapping[str, Any], requests: Sequence[RequestLike], way: RunOptions
) -> list[FloatArray] | None:
    """Return the same of one design at arrays of strokes, shape (n,), within the declared ranges; None as `at_one_pose` does."""
    if plan.solved or len(strokes) != len(plan.strokes) or not {*map(type, designs.values())} <= {float}:
        return None
    sizes = set()
    for name, stroke in plan.strokes.items():
        value = strokes.get(name)
        if type(value) is not np.ndarray or value.dtype != np.float64 or value.ndim != 1 or not 0 < value.size <= FEW:
            return None
        low, high = (stroke.start, stroke.end) if stroke.start <= stroke.end else (stroke.end, stroke.start)
        if not (low <= value.min() and value.max() <= high):  # what is not finite neither
            return None
        sizes.add(value.size)
    identities = identities_of(plan, requests)
    if identities is None or len(sizes) != 1:
        return None
    program = plan.made(("few poses", identities), lambda _: BulkProgram.of(plan, all_bound(plan, requests)))
    if program.angles:
        return None
    result = program.kernel({**designs, **strokes}, None, way, (1, sizes.pop()))
    return program.split(result.values[:, 0]) if program.is_clear(result) else None


@dataclass(frozen=True)
class BulkProgram:
    """The kernel of some requests: `parts`, the first row and the rows of each; `angles` of those that follow them, by their place.

    `may_fail`: there may be poses without a value that no guard reports.
    """

    kernel: Kernel
    parts: tuple[tuple[int, int], ...]
    angles: Mapping[int, Angles]
    may_fail: bool

    @classmethod
    def of(cls, plan: Plan, requests: Sequence[Request]) -> BulkProgram:
        """Return the program of requests that are bound to a plan, made once; guards watch what they are built from."""
        return plan.made(("bulk", tuple([each.key for each in requests])), lambda fork: cls.compiled_on(fork, requests))

    @classmethod
    def compiled_on(cls, plan: Plan, requests: Sequence[Request]) -> BulkProgram:
        """Return the same, traced in a plan of its own."""
        nodes = [each.nodes(plan) for each in requests]
        guards = [*assumed_of(plan, requests), *(node for each in requests for node in each.gaps(plan))]
        guards += plan.trace.watched(members_behind(plan, requests), max((each.regular for each in requests), default=0.0))
        followed = {k: angles_of(plan, nodes[k]) for k, each in enumerate(requests) if each.follows_angles}
        angles = {k: found for k, found in followed.items() if found is not None and found.angles}
        lengths = [each.rows for each in requests]
        parts = tuple(zip(accumulate(lengths[:-1], initial=0), lengths, strict=True)) if lengths else ()
        may_fail = plan.may_overflow or any(each.may_fail for each in requests)
        return cls(Kernel([node for each in nodes for node in each], guards), parts, angles, may_fail)

    def split(self, values: FloatArray) -> list[FloatArray]:
        """Return one array a request of values, shape (rows, ...): (...), of a point (2, ...)."""
        return [values[first : first + rows] if rows > 1 else values[first] for first, rows in self.parts]

    def is_clear(self, result: Result) -> bool:
        """Return whether no pose of a result has to be looked at closely."""
        return bool((result.guards > 0.0).all()) and not (self.may_fail and not np.isfinite(result.values).all())

    @cached_property
    def rows(self) -> int:
        """The rows of all requests."""
        return sum(rows for _, rows in self.parts)


def members_behind(plan: Plan, requests: Sequence[Request]) -> set[str]:
    """Return the members that requests are built from."""
    return set().union(*(each.names(plan) for each in requests))


def assumed_of(plan: Plan, requests: Sequence[Request]) -> list[Node]:
    """Return what requests take to be above zero."""
    return [node for each in requests for node in each.notes(plan).assumed]


def watch_of(plan: Plan, requests: Sequence[Request]) -> tuple[int, list[int], Kernel]:
    """Return how many of its outputs are assumptions, and gaps of each request; and the kernel.

    Its outputs are the assumptions, what tells whether there is a place, how near each request is, and the gaps of each.
    """
    assumed = assumed_of(plan, requests)
    near = [nearness_of(plan, each) for each in requests]
    gaps = [each.gaps(plan) for each in requests]
    kernel = Kernel([*assumed, *plan.trace.placeable(members_behind(plan, requests)), *near, *(node for each in gaps for node in each)])
    return len(assumed), list(map(len, gaps)), kernel


@final
@dataclass(frozen=True)
class Evaluation:
    """Requests over a grid of poses, and how they are worked out."""

    grid: Grid
    requests: tuple[Request, ...]
    way: RunOptions
    unreachable: str = "raise"

    @cached_property
    def program(self) -> BulkProgram:
        """The kernel of the requests and what its rows are."""
        return BulkProgram.of(self.grid.plan, self.requests)

    def run(self, out: FloatArray | None) -> list[FloatArray]:
        """Return one array a request, in the usual shapes; rows of `out` where it is given."""
        grid, program = self.grid, self.program
        result = program.kernel(grid.flat, self._target(program.rows, out), self.way, grid.size)
        if not program.is_clear(result):
            self._settle(result.values)
        found = grid.full(result.values)
        if program.angles and grid.stroke_shape:
            self._unwrap(found)
        return program.split(found)

    def _starts(self) -> Iterator[tuple[int, Request]]:
        """Yield each request with its first row."""
        for (first, _), each in zip(self.program.parts, self.requests, strict=True):
            yield first, each

    def _target(self, rows: int, out: FloatArray | None) -> FloatArray | None:
        """Return where the caller wants the results, shape (rows, designs, poses)."""
        grid = self.grid
        if out is None:
            return None
        return checked_out(grid, rows, out).reshape(rows, *grid.size)

    # -- poses at a dead point or out of reach ---------------------------------------------------------

    def _settle(self, place: FloatArray) -> None:
        """Put right the poses where a guard tells: place them to rounding, refuse or mask those out of reach or singular."""
        plan = self.grid.plan
        assumed, gaps, kernel = of_all("guards", plan, self.requests, watch_of)
        worst: dict[int, Conditioning] = {}
        for band, part in grid_blocks(*self.grid.size):
            inputs = {name: part_of_input(value, band, part, name in plan.table.entries) for name, value in self.grid.flat.items()}
            block = place[:, band, part]
            least = np.broadcast_to(kernel(inputs, way=self.way).values, (len(kernel.plan.outputs), *block.shape[1:]))
            with np.errstate(invalid="ignore"):
                above, present = np.split(least > 0.0, [len(least) - sum(gaps)])
                empty = [np.asarray(~each.all(axis=0)) for each in np.split(present, np.cumsum(gaps)[:-1])]
                for (first, each), gap in zip(self._starts(), empty, strict=True):
                    block[first : first + each.rows, gap] = 0.0
                near, hard = ~above[len(above) - len(self.requests) :], above[: len(above) - len(self.requests)]
                near &= ~keeps_digits(plan, self.requests, inputs, near)
                bad = ~np.all(hard, axis=0) | near.any(axis=0) | ~np.isfinite(block).all(axis=0)
            if bad.any():
                shaped = {name: np.asarray(value, float) for name, value in inputs.items()}
                own = {name for name, value in shaped.items() if value.ndim == 1 and name in plan.table.entries}  # one a design
                at_bad = {name: np.broadcast_to(value[:, None] if name in own else value, bad.shape)[bad] for name, value in shaped.items()}
                self._put_right(block, bad, at_bad, worst, np.logical_not(hard[:assumed, bad].all(axis=0)), near[:, bad])
            for (first, each), gap in zip(self._starts(), empty, strict=True):
                block[first : first + each.rows, gap] = np.nan
        for k, found in worst.items():
            conditions.warn_near(found, f"{plan.title}: {self.requests[k].sentence}", "comes")

    def _put_right(
        self, block: FloatArray, bad: Mask, inputs: dict[str, FloatArray], worst: dict[int, Conditioning], broken: Mask, near: Mask
    ) -> None:
        """Fill the poses of a block that a mask names, from their paired inputs.

        `broken`: where an assumption does not hold; `near`: for each request, where it has to be looked at closely.
        """
        plan, shape = self.grid.plan, (int(bad.sum()),)
        with np.errstate(all="ignore"):
            lengths = plan.reading(inputs)
            lost = ~np.isfinite(block[:, bad]).all(axis=0) | negative(plan, lengths, shape)
            if lost.any():  # where something that the requests are built from cannot be placed
                names, failed = members_behind(plan, self.requests), np.zeros(int(lost.sum()), bool)
                for name, mask in failures(plan, plan.read({name: value[lost] for name, value in inputs.items()}), failed.shape):
                    if name in names:
                        failed |= mask
                lost[lost] = failed
        refused, looked = np.zeros((len(self.requests), *shape), bool), near & ~lost
        here, among = looked.any(axis=0), np.flatnonzero(looked.any(axis=1)).tolist()
        at = {name: value[here] for name, value in inputs.items()}
        for k, found in zip(among, examined(plan, self.requests, at, plan.read(at), among) if among else (), strict=True):
            asked = looked[k][here]
            refused[k][here] = found.refused & asked
            if (found.doubtful & asked).any():
                told = found.at(found.doubtful & asked)
                told = told.at(told.error == told.error.max())
                if k not in worst or told.error[0] > worst[k].error[0]:
                    worst[k] = told
        if (broken & ~lost & ~refused.any(axis=0)).any() or (self._raises and (lost.any() or refused.any())):
            self._refuse()
        self._fill(block, bad, inputs, lost | refused)

    def _fill(self, block: FloatArray, bad: Mask, inputs: Mapping[str, Any], without: Mask) -> None:
        """Fill the bad poses of a block: to rounding where they stand at a dead point, with NaN where a request has no value."""
        for (first, each), mask in zip(self._starts(), without, strict=True):
            rows = slice(first, first + each.rows)
            found = block[rows, bad]
            at_end = ~mask & ~np.isfinite(found).all(axis=0)
            if not each.order and at_end.any():
                at = {name: value[at_end] for name, value in inputs.items()}
                found = to_rounding(found, at_end, self.program.kernel.plan.outputs[rows], at)
            found = np.where(mask, np.nan, found)
            if self._raises and not np.isfinite(found).all():
                self._refuse()
            block[rows, bad] = np.where(np.isfinite(found).all(axis=0), found, np.nan)

    @property
    def _raises(self) -> bool:
        """Whether poses without a value are an error."""
        return self.unreachable == "raise"

    def _refuse(self) -> None:
        """Raise the error of these poses, in the words of a motion."""
        grid = self.grid
        motion = Motion(grid.plan, grid.designs, grid.strokes, self.unreachable, per_design=grid.per_design)
        for each in self.requests:
            each.refuse(motion)
        for each in self.requests:
            if each.notes(grid.plan).assumed:
                raise other_law_error(grid.plan, each)
        names = ", ".join(each.sentence for each in self.requests)
        text = f'{grid.plan.title}: {names} has no value at some of these poses. Leave them out, or ask with unreachable="nan".'
        raise SingularError(text, motion=motion)

    # -- angles ----------------------------------------------------------------------------------------

    def _unwrap(self, found: FloatArray) -> None:
        """Make the angles in requests continuous along the stroke, in place."""
        for k, angles in self.program.angles.items():
            first, rows = self.program.parts[k]
            values = found[first : first + rows]
            reached = np.isfinite(values).all(axis=0)
            continued = angles.continued(self.grid, np.asarray(reached), self.way)
            if continued is not None:
                values[...] = np.where(reached, continued, np.nan)


def checked_out(grid: Grid, rows: int, out: FloatArray) -> FloatArray:
    """Return the array that takes so many rows of results; DefinitionError for what cannot."""
    shape = (rows, *grid.shape)
    if not isinstance(out, np.ndarray) or out.dtype != np.float64 or out.shape != shape or not out.flags.c_contiguous:
        given = f"{out.dtype} {out.shape}" if isinstance(out, np.ndarray) else repr(out)
        raise DefinitionError(
            f"{grid.plan.title}: out= is {given}; expected is a contiguous float64 array of the shape {shape}: "
            "one row a component of what is asked for."
        )
    if not out.flags.writeable:
        raise DefinitionError(f"{grid.plan.title}: out= cannot be written into; give an array of your own, np.empty({shape}).")
    return out


def grid_blocks(m: int, n: int, most: int = PIECE) -> Iterator[tuple[slice, slice]]:
    """Yield parts of a grid of at most so many poses."""
    width = min(n, most)
    height = max(1, most // max(width, 1))
    for top in range(0, m, height):
        for left in range(0, n, width):
            yield slice(top, min(top + height, m)), slice(left, min(left + width, n))


def part_of_input(value: Any, band: slice, part: slice, of_design: bool) -> Any:
    """Return the part of a flat input that belongs to a part of the grid."""
    if np.ndim(value) == 2:
        return value[band if value.shape[0] > 1 else slice(None), part]
    return value if np.ndim(value) == 0 or np.size(value) == 1 else value[band] if of_design else value[part]


# Values and ratios of one design, pose by pose, in floats: for root finders and other loops.

Pose: TypeAlias = Callable[[Sequence[float]], tuple[float, ...] | None]
"""All components at the strokes of one pose, one after the other; None where it has to be looked at closely."""


@final
class PoseProgram:
    """Some requests in floats: `of_design(designs)` is a function of the strokes, the design worked out."""

    def __init__(self, plan: Plan, requests: tuple[Request, ...]) -> None:
        self.bulk, self._plan, self._requests = BulkProgram.of(plan, requests), plan, requests
        self._tells_nearness = plan.trace.nearness(members_behind(plan, requests)).op != "constant"
        self._order = [list(plan.strokes).index(node.value) for node in self.bulk.kernel.plan.pose_inputs]
        self._latest: tuple[Mapping[str, Any] | None, Pose | None] = None, None

    def of_design(self, designs: Mapping[str, object]) -> Pose | None:
        """Return the function of one design, that of the latest kept; None for several designs."""
        known, pose = self._latest
        if known is not designs:
            if any(map(varies, designs.values())):
                return None
            pose = self._pose(designs)
            self._latest = designs, pose
        return pose

    def _pose(self, designs: Mapping[str, Any]) -> Pose:
        kernel, order, may_fail, many = self.bulk.kernel, self._order, self.bulk.may_fail, len(self._plan.strokes)
        floats, count = kernel.floats, len(kernel.plan.outputs)
        passed = floats.design([float(designs[node.value]) for node in kernel.plan.design_inputs])
        pose, is_ordered = floats.quick["pose"], order == list(range(many))

        def at(strokes: Sequence[float]) -> tuple[float, ...] | None:
            if len(strokes) != many:
                return None
            try:
                found: tuple[float, ...] = pose(*passed, *(strokes if is_ordered else [strokes[place] for place in order]))
                if not isfinite(sum(strokes)):  # those that the requests do not follow included
                    return None
            except (*NO_VALUE, TypeError):
                return None
            for guard in found[count:]:
                if not guard > 0.0:
                    is_placed = self._tells_nearness and all([each > 0.0 for each in found[count:-1]])
                    if not (is_placed and self._keeps_digits(designs, strokes)):
                        return None
                    break  # the last guard tells how near singular poses are
            return None if may_fail and not all(map(isfinite, found)) else found[:count]

        return at

    def _keeps_digits(self, designs: Mapping[str, object], strokes: Sequence[float]) -> bool:
        """Return whether a coarse look shows that all requests keep their digits at a pose."""
        inputs = {**designs, **dict(zip(self._plan.strokes, strokes, strict=True))}
        every = np.ones((len(self._requests), 1, 1), bool)
        return not self._plan.solved and bool(keeps_digits(self._plan, self._requests, inputs, every).all())


@final
class PoseFunction:
    """Requests of one design as a function of the strokes, in floats; it can be sent to other processes."""

    def __init__(self, plan: Plan, designs: Mapping[str, Any], requests: Sequence[RequestLike]) -> None:
        if any(np.ndim(value) for value in designs.values()):
            raise DefinitionError(f"{plan.title}: a function of floats is of one design; use evaluate for several.")
        self._plan, self._designs, self._names = plan, dict(designs), tuple(plan.strokes)
        self._requests = tuple(requests) if isinstance(requests, Iterator) else requests
        try:
            found = all_bound(plan, self._requests)
            self._pose = None if plan.solved else PoseProgram(plan, found).of_design(self._designs)
        except UntracedError:
            self._pose = None

    def __call__(self, *strokes: float, **named: float) -> tuple[float, ...]:
        """Return all components one after the other at strokes [SI], in their order or by name."""
        if self._pose is None or (named and len(strokes) + len(named) != len(self._names)):
            return self._closely(strokes, named)
        at = strokes
        if named:
            at = (*strokes, *(named.get(name, nan) for name in self._names[len(strokes) :]))
        found = None if Amount in map(type, at) else self._pose(at)
        return self._closely(strokes, named) if found is None else found

    def _closely(self, strokes: Sequence[float], named: Mapping[str, float]) -> tuple[float, ...]:
        """Return the same where a guard or a failing operation tells, or the strokes are given in another way."""
        plan, names = self._plan, list(self._plan.strokes)
        known_strokes(named, {name: plan.strokes[name] for name in names[len(strokes) :]}, plan.title)
        values = [*strokes, *(named[name] for name in names[len(strokes) :])]
        if len(values) != len(names):
            raise DefinitionError(f"{plan.title}: one value for each stroke is expected: {', '.join(names)}.")
        at = dict(zip(names, values, strict=True))
        require_kinds(plan, at)
        given = {name: numbers_in(value) for name, value in at.items()}
        for name, found in given.items():
            if found.size != 1 or not np.isfinite(found).all():
                what = f"{plan.title}: the stroke {name}={at[name]!r:.60}"
                raise DefinitionError(f"{what}: one finite number is expected; evaluate takes arrays.")
        grid = Grid(plan, self._designs, {name: found.reshape(()) for name, found in given.items()})
        return tuple(float(part) for found in evaluate_grid(grid, self._requests, None, QUICKEST, "raise") for part in np.ravel(found))

    def __reduce__(self) -> tuple[Any, ...]:
        return PoseFunction, (self._plan, self._designs, self._requests)


# Values and ratios as the text of a function in another language: for a controller, or a page of one's own.


def source_of(plan: Plan, designs: Mapping[str, Any], requests: Sequence[RequestLike], language: object, name: str) -> str:
    """Return requests as text in a language; see Mechanism.source."""
    writer = LANGUAGES.given(language) or LANGUAGES[one_word("language", language, tuple(LANGUAGES))]
    require(isinstance(name, str) and name.isascii() and name.isidentifier(), "name", name, "a function's name is expected, such as poses")
    if name in writer.words.split():
        raise DefinitionError(f"name={name!r} has a meaning in {language} already; give the function another name, such as poses.")
    if any(np.ndim(value) for value in designs.values()):
        raise DefinitionError(f"{plan.title}: source() states one design; its dimensions are arguments of the text, which serves all.")
    bound = all_bound(plan, requests)
    design = {name: float(value) for name, value in designs.items()}
    nodes = plan.made(
        ("source", tuple(each.key for each in bound)), lambda twin: [node for each in bound for node in true_nodes(twin, each)]
    )
    read = {node.value for node in Kernel(nodes).plan.pose_inputs}
    if language == "javascript" and not read.isdisjoint(plan.solved):
        return live_source(plan, bound, name, design)
    for group in plan.groups.values():  # what hangs on pins that are found by iteration, or on a followed angle, has no closed form
        if not read.isdisjoint(group.inputs):
            what = f"{plan.title}: {group} is solved by iteration and has no closed form to write down"
            raise DefinitionError(f"{what}; ask for what does not hang on {', '.join(group.pins)}, or use function().")
    for angle in plan.followed:
        if angle in read:
            what = f"{plan.title}: {angle} is followed from the sketch, as its whole turns tell poses apart, and has no closed form"
            raise DefinitionError(f"{what} to write down; use a whole multiple of it, drive the angle by a Stroke, or use function().")
    return writer.text(nodes, name, design)
