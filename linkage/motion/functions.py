"""Values and ratios of many poses in one pass, of one pose in floats, and as text: the calls under `evaluate`, `function` and `source`."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from math import isfinite, nan
from typing import Any, TypeAlias

import numpy as np

from ..errors import DefinitionError, SingularError, UntracedError, ensure, of_one_shape, one_word, require
from ..frozen import FrozenDict
from ..plan import Plan, rate_name, require_kinds
from ..program import LANGUAGES, NO_VALUE, QUICKEST, FloatArray, Kernel, RunOptions
from ..quantities import numbers_in, real
from ..units import Amount
from . import dead_points
from .evaluation import BulkProgram, Evaluation, keeps_digits, members_behind, other_law_error, require_rates
from .grid import Grid, varies
from .live import live_source, true_nodes
from .motion import Motion
from .requests import Request, RequestLike, all_bound, as_they_run, holds_given, identities_of
from .strokes import at_values, float_array, known_strokes, rate_values


def evaluate(
    plan: Plan,
    designs: FrozenDict[str, Any],
    strokes: Mapping[str, Any],
    requests: Sequence[RequestLike],
    out: FloatArray | None,
    way: RunOptions,
    unreachable: str,
    per_design: bool = False,
    rates: Mapping[str, Any] | None = None,
    accelerations: Mapping[str, Any] | None = None,
) -> list[FloatArray]:
    """Return the values of requests of designs at strokes; see Mechanism.evaluate."""
    require_kinds(plan, strokes)
    moving = {} if rates is None and accelerations is None else rate_values(plan, rates, accelerations)
    requests = as_they_run(requests, accelerations is not None) if moving else requests
    if out is None and unreachable in ("raise", "nan"):
        with suppress(UntracedError):
            found = at_one_pose(plan, designs, strokes, requests, moving) if way is QUICKEST else None
            if found is None:
                found = at_few_poses(plan, designs, strokes, requests, way, moving)
            if found is not None:
                return found
    at = at_values(strokes, plan, float_array)
    if moving:
        arrays = [*at.values(), *map(real, moving.values())]
        what, names = f"{plan.title}: the shapes of the strokes and of their rates", (*at, *moving)
        together = dict(zip(names, of_one_shape(what, names, arrays), strict=True))
        at, moving = {name: together[name] for name in at}, {name: together[name] for name in moving}
    return evaluate_grid(Grid(plan, designs, at, per_design=per_design, rate_inputs=moving), requests, out, way, unreachable)


def evaluate_grid(
    grid: Grid, requests: Sequence[RequestLike], out: FloatArray | None, way: RunOptions, unreachable: str
) -> list[FloatArray]:
    """Return the values of requests over a grid; see Mechanism.evaluate."""
    one_word("unreachable", unreachable, ("raise", "nan"))
    plan, identities = grid.plan, identities_of(grid.plan, requests)
    try:
        if identities is None or holds_given(identities):
            found = all_bound(plan, requests)
        else:
            found = plan.made(("all bound", identities), lambda _: all_bound(plan, requests))
    except UntracedError:
        return evaluate_apart(grid, requests, out, way, unreachable)
    return evaluate_bound(Evaluation(grid, found, way), out, unreachable)


def evaluate_bound(asked: Evaluation, out: FloatArray | None, unreachable: str) -> list[FloatArray]:
    """Return the values of requests that are bound; raise or warn as asked."""
    grid, rows = asked.grid, len(asked.program.kernel.plan.outputs)
    values, look = asked.evaluate(None if out is None else checked_out(grid, rows, out).reshape(rows, *grid.size))
    if look is None:
        return values
    if look.broken.any() or (unreachable == "raise" and look.missing.any()):  # refused in the words of a motion
        motion = Motion(grid.plan, grid.designs, grid.strokes, unreachable, per_design=grid.per_design, rate_inputs=grid.rate_inputs)
        for each in asked.counting.values():
            each.refuse(motion)
        for number, each in asked.counting.items():
            if look.refused[number].any():
                motion._refused_near(each, f"{grid.plan.title}: {each.sentence}")
        for each in asked.counting.values():
            if each.notes(grid.plan).assumed:
                raise other_law_error(grid.plan, each)
        names = ", ".join(each.sentence for each in asked.counting.values())
        text = f'{grid.plan.title}: {names} has no value at some of these poses. Leave them out, or ask with unreachable="nan".'
        raise SingularError(text, motion=motion)
    for number, worst in look.worst.items():
        dead_points.warn_near(worst, f"{grid.plan.title}: {asked.requests[number].sentence}", "comes")
    return values


def evaluate_apart(
    grid: Grid, requests: Sequence[RequestLike], out: FloatArray | None, way: RunOptions, unreachable: str
) -> list[FloatArray]:
    """Return the same of requests some of which have no program: these as a motion of the same poses gives them."""
    motion = Motion(grid.plan, grid.designs, grid.strokes, unreachable, per_design=grid.per_design, rate_inputs=grid.rate_inputs)
    found = []
    for each in requests:
        try:
            found += evaluate_bound(Evaluation(grid, all_bound(grid.plan, [each]), way), None, unreachable)
        except UntracedError:
            found.append(motion[each])
    rows = [each if each.ndim > len(grid.shape) else np.asarray(each)[None] for each in found]
    if out is not None:
        whole = checked_out(grid, sum(map(len, rows)), out)
        np.concatenate(rows, out=whole)
        rows = np.split(whole, np.cumsum([len(each) for each in rows])[:-1])
    return [part if each.ndim > len(grid.shape) else part[0] for part, each in zip(rows, found, strict=True)]


def at_one_pose(
    plan: Plan, designs: Mapping[str, object], strokes: Mapping[str, object], requests: Sequence[RequestLike], moving: Mapping[str, object]
) -> list[FloatArray] | None:
    """Return the values of requests at one pose within the declared strokes; None where it has to be looked at closely, or are several.

    `moving` are rates by the names of their inputs. The program of requests that are known from before is found by what they are; nothing
    is bound or traced again.
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
    for value in moving.values():
        if not (isinstance(value, float) or type(value) is int) or not isfinite(value):
            return None
        values.append(float(value))
    identities = identities_of(plan, requests)
    if identities is None:
        return None
    names = (*plan.strokes, *moving)
    program = plan.made(
        ("one pose", identities, names), lambda _: PoseProgram(plan, all_bound(plan, requests), names, not holds_given(identities))
    )
    pose = program.design_function(designs)
    found = None if pose is None else pose(values)
    return None if found is None else program.bulk.split(np.array(found))


FLOAT = np.dtype(float)
FEW = 8192
"""Poses of one design that are worked out at once before any of them is looked at closely."""


def at_few_poses(
    plan: Plan, designs: FrozenDict[str, Any], strokes: Mapping[str, Any], requests: Sequence[RequestLike], way: RunOptions,
    moving: Mapping[str, Any],
) -> list[FloatArray] | None:  # fmt: skip
    """Return the same of one design at arrays of strokes, shape (n,), within the declared ranges; None as `at_one_pose` does."""
    if plan.solved or len(strokes) != len(plan.strokes) or not designs.is_of_floats:
        return None
    sizes = {each.size if type(each) is np.ndarray and each.ndim == 1 else 0 for each in moving.values() if type(each) is not float}
    for name, stroke in plan.strokes.items():
        value = strokes.get(name)
        if type(value) is not np.ndarray or value.dtype is not FLOAT or value.ndim != 1 or not 0 < value.size <= FEW:
            return None
        low, high = value.item(value.argmin()), value.item(value.argmax())
        if not (min(stroke.start, stroke.end) <= low and high <= max(stroke.start, stroke.end)):  # what is not finite neither
            return None
        sizes.add(value.size)
    identities = identities_of(plan, requests) if len(sizes) == 1 else None
    if identities is None:
        return None
    program = plan.made(("few poses", identities), lambda _: BulkProgram.for_requests(plan, all_bound(plan, requests)))
    if program.angles:
        return None
    inputs = {**designs, **strokes, **moving}
    require_rates(plan, program.kernel, inputs)
    result = program.kernel(inputs, None, way, (1, sizes.pop()))
    return program.split(result.values[:, 0]) if program.is_clear(result) else None


def checked_out(grid: Grid, rows: int, out: FloatArray) -> FloatArray:
    """Return the array for so many rows of results; DefinitionError for an array of another type or shape."""
    shape = (rows, *grid.shape)
    if not isinstance(out, np.ndarray) or out.dtype != np.float64 or out.shape != shape or not out.flags.c_contiguous:
        given = f"{out.dtype} {out.shape}" if isinstance(out, np.ndarray) else repr(out)
        raise DefinitionError(
            f"{grid.plan.title}: out= is {given}; expected is a contiguous float64 array of the shape {shape}: "
            "one row a component of what is asked for."
        )
    ensure(out.flags.writeable, f"{grid.plan.title}: out= cannot be written into; give an array of your own, np.empty({shape}).")
    return out


# Values and ratios of one design, pose by pose, in floats: for root finders and other loops.

Pose: TypeAlias = Callable[[Sequence[float]], tuple[float, ...] | None]
"""All components at the strokes of one pose, one after the other; None where it has to be looked at closely."""


class PoseProgram:
    """Some requests in floats. `design_function(designs)` is a function of strokes and rates, in the order of `names`.

    Near a singular pose it looks at the requests again, unless they are not to be `kept`, and their loads with them.
    """

    def __init__(self, plan: Plan, requests: tuple[Request, ...], names: Sequence[str], kept: bool = True) -> None:
        self.bulk, self._plan, self._names = BulkProgram.for_requests(plan, requests), plan, names
        self._requests = requests if kept else ()
        require_rates(plan, self.bulk.kernel, names)
        self._tells_nearness = kept and plan.trace.nearness(members_behind(plan, requests)).op != "constant"
        self._order = [names.index(name) for name in self.bulk.kernel.plan.input_names[1]]
        self._latest: tuple[Mapping[str, Any] | None, Pose | None] = None, None

    def design_function(self, designs: Mapping[str, object]) -> Pose | None:
        """Return the function of one design, that of the latest kept; None for several designs."""
        known, pose = self._latest
        if known is not designs:
            if any(map(varies, designs.values())):
                return None
            pose = self._pose(designs)
            self._latest = designs, pose
        return pose

    def _pose(self, designs: Mapping[str, Any]) -> Pose:
        kernel, order, may_fail, many = self.bulk.kernel, self._order, self.bulk.may_fail, len(self._names)
        floats, count = kernel.floats, len(kernel.plan.outputs)
        passed = floats.design_values([float(designs[name]) for name in kernel.plan.input_names[0]])
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
        inputs = {**designs, **dict(zip(self._names, strokes, strict=True))}
        every = np.ones((len(self._requests), 1, 1), bool)
        return not self._plan.solved and bool(keeps_digits(self._plan, self._requests, inputs, every).all())


class PoseFunction:
    """Requests of one design as a function of the strokes, in floats; it can be sent to other processes.

    Of a function with `orders` the rates of all strokes follow these, and with 2 then their accelerations.
    """

    def __init__(self, plan: Plan, designs: Mapping[str, Any], requests: Sequence[RequestLike], orders: int = 0) -> None:
        is_one = not any(map(np.ndim, designs.values()))
        ensure(is_one, f"{plan.title}: a function of floats is of one design; use evaluate for several.")
        self._plan, self._designs, self._orders = plan, dict(designs), orders
        self._names = (*plan.strokes, *(rate_name(name, order + 1) for order in range(orders) for name in plan.strokes))
        requests = tuple(requests) if isinstance(requests, Iterator) else requests
        self._requests = as_they_run(requests, orders > 1) if orders else requests
        try:
            found = all_bound(plan, self._requests)
            self._pose = None if plan.solved else PoseProgram(plan, found, self._names).design_function(self._designs)
        except UntracedError:
            self._pose = None

    @property
    def is_quick(self) -> bool:
        """Whether one program gives all of it, pose by pose; else poses are better taken together."""
        return self._pose is not None

    def __call__(self, *strokes: float, **named: float) -> tuple[float, ...]:
        """Return all components one after the other at strokes [SI], in their order or by name; rates follow in their order."""
        if self._pose is None or (named and len(strokes) + len(named) != len(self._names)):
            return self._closely(strokes, named)
        at = strokes
        if named:
            at = (*strokes, *(named.get(name, nan) for name in self._names[len(strokes) :]))
        found = None if Amount in map(type, at) else self._pose(at)
        return self._closely(strokes, named) if found is None else found

    def _closely(self, strokes: Sequence[float], named: Mapping[str, float]) -> tuple[float, ...]:
        """Return the same where a guard or a failing operation tells, or the strokes are given in another way."""
        plan, names = self._plan, self._names
        if not self._orders or named:
            known_strokes(named, {name: plan.strokes[name] for name in [*plan.strokes][len(strokes) :]}, plan.title)
        values = [*strokes, *(named[name] for name in names[len(strokes) :] if name in named)]
        what = "each stroke" if not self._orders else "each stroke and then for each of their rates"
        ensure(len(values) == len(names), f"{plan.title}: one value for {what} is expected: {', '.join(names)}.")
        at = dict(zip(names, values, strict=True))
        require_kinds(plan, at)
        given = {name: numbers_in(value) for name, value in at.items()}
        for name, found in given.items():
            if found.size != 1 or not np.isfinite(found).all():
                what = f"{plan.title}: the {'stroke ' if name in plan.strokes else ''}{name}={at[name]!r:.60}"
                raise DefinitionError(f"{what}: one finite number is expected; evaluate takes arrays.")
        shaped = {name: found.reshape(()) for name, found in given.items()}
        rates = {name: shaped.pop(name) for name in names[len(plan.strokes) :]}
        grid = Grid(plan, self._designs, shaped, rate_inputs=rates)
        return tuple(float(part) for found in evaluate_grid(grid, self._requests, None, QUICKEST, "raise") for part in np.ravel(found))

    def __reduce__(self) -> tuple[Any, ...]:
        return PoseFunction, (self._plan, self._designs, self._requests, self._orders)


# Values and ratios as the text of a function in another language: for a controller, or a page of one's own.


def source_of(plan: Plan, designs: Mapping[str, Any], requests: Sequence[RequestLike], language: object, name: str, orders: int = 0) -> str:
    """Return requests as text in a language; see Mechanism.source."""
    writer = LANGUAGES.for_object(language) or LANGUAGES[one_word("language", language, tuple(LANGUAGES))]
    require(isinstance(name, str) and name.isascii() and name.isidentifier(), "name", name, "a function's name is expected, such as poses")
    taken = f"name={name!r} has a meaning in {language} already; give the function another name, such as poses."
    ensure(name not in writer.words.split(), taken)
    several = f"{plan.title}: source() states one design; its dimensions are arguments of the text, which serves all."
    ensure(not any(map(np.ndim, designs.values())), several)
    bound = all_bound(plan, as_they_run(requests, orders > 1) if orders else requests)
    design = {name: float(value) for name, value in designs.items()}
    nodes = plan.made(
        ("source", tuple(each.key for each in bound)), lambda twin: [node for each in bound for node in true_nodes(twin, each)]
    )
    read = {*Kernel(nodes).plan.input_names[1]}
    if language == "javascript" and not read.isdisjoint(plan.solved) and read <= {*plan.strokes, *plan.solved}:
        return live_source(plan, bound, name, design)
    for group in plan.groups.values():  # what hangs on pins that are found by iteration, or on a followed angle, has no closed form
        what = f"{plan.title}: {group} is solved by iteration and has no closed form to write down"
        ensure(read.isdisjoint(group.inputs), f"{what}; ask for what does not hang on {', '.join(group.pins)}, or use function().")
    for angle in plan.followed:
        what = f"{plan.title}: {angle} is followed from the sketch, as its whole turns tell poses apart, and has no closed form"
        ensure(angle not in read, f"{what} to write down; use a whole multiple of it, drive the angle by a Stroke, or use function().")
    return writer.text(nodes, name, design)
