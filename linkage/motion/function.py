"""Values and ratios of one design, pose by pose, as a plain function of floats: for root finders and other loops."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from math import isfinite
from typing import Any, TypeAlias, final

import numpy as np

from ..errors import DefinitionError
from ..plan import Plan
from ..program import NO_VALUE, QUICKEST, FloatArray, Kernel
from ..quantities import real
from .evaluation import Evaluation
from .grid import Grid
from .requests import RequestLike, all_bound
from .strokes import known_strokes

Poses: TypeAlias = Callable[..., tuple[float, ...]]


@final
class PoseFunction:
    """Requests of one design as a function of the strokes, in floats; it can be sent to other processes."""

    def __init__(self, plan: Plan, designs: Mapping[str, Any], requests: Sequence[RequestLike]) -> None:
        listed = tuple(requests) if isinstance(requests, Iterator) else requests
        self._made_of = plan, dict(designs), listed
        self._at = function_of(plan, designs, listed)

    def __call__(self, *strokes: float, **named: float) -> tuple[float, ...]:
        """Return all components one after the other at strokes [SI], in their order or by name."""
        return self._at(*strokes, **named)

    def __reduce__(self) -> tuple[Any, ...]:
        return PoseFunction, self._made_of


def function_of(plan: Plan, designs: Mapping[str, Any], requests: Sequence[RequestLike]) -> Poses:
    """Return requests as a function of the strokes; see Mechanism.function."""
    if any(np.ndim(value) for value in designs.values()):
        raise DefinitionError(f"{plan.title}: a function of floats is of one design; use evaluate for several.")
    asked = all_bound(plan, requests)

    def bulk(strokes: Sequence[float]) -> Evaluation:
        if len(strokes) != len(plan.strokes):
            raise DefinitionError(f"{plan.title}: one value for each stroke is expected: {', '.join(plan.strokes)}.")
        values = {name: lone(value, name, plan.title) for name, value in zip(plan.strokes, strokes, strict=True)}
        return Evaluation(Grid(plan, designs, values), asked, QUICKEST)

    def careful(*strokes: float, **named: float) -> tuple[float, ...]:
        return tuple(float(part) for values in bulk((*strokes, *rest(plan, len(strokes), named))).run(None) for part in np.ravel(values))

    if plan.solved:
        return careful
    first = bulk([stroke.start for stroke in plan.strokes.values()])
    return quick(plan, designs, first.kernel, careful, first.may_fail)


def lone(value: Any, name: str, title: str) -> FloatArray:
    """Return a stroke's one value, shape (); DefinitionError for several, and for what is no finite number."""
    try:
        found = real(value)
    except ValueError:
        found = np.empty(0)
    if found.size != 1 or not np.isfinite(found).all():
        raise DefinitionError(f"{title}: the stroke {name}={value!r:.60}: one finite number is expected; evaluate takes arrays.")
    return found.reshape(())


def rest(plan: Plan, count: int, named: Mapping[str, float]) -> list[float]:
    """Return the strokes given by name, which follow so many given in order."""
    known_strokes(named, dict(list(plan.strokes.items())[count:]), plan.title)
    return [named[name] for name in list(plan.strokes)[count:]]


def quick(plan: Plan, designs: Mapping[str, Any], kernel: Kernel, careful: Poses, watched: bool) -> Poses:
    """Return the pose part with its design worked out; a pose where a guard or a failing operation tells is taken carefully."""
    floats, count = kernel.floats, len(kernel.plan.outputs)
    passed = floats.design([float(designs[node.value]) for node in kernel.plan.design_inputs])
    pose = floats.quick["pose"]
    places = [list(plan.strokes).index(node.value) for node in kernel.plan.pose_inputs]
    many = len(plan.strokes)
    together = places == list(range(many))

    def at(*strokes: float, **named: float) -> tuple[float, ...]:
        if named or len(strokes) != many:
            return careful(*strokes, **named)
        try:
            found: tuple[float, ...] = pose(*passed, *(strokes if together else [strokes[place] for place in places]))
            finite = isfinite(sum(strokes))  # those that the requests do not follow included
        except (*NO_VALUE, TypeError):
            return careful(*strokes)
        if not finite:
            return careful(*strokes)
        for guard in found[count:]:
            if not guard > 0.0:
                return careful(*strokes)
        if watched and not all(map(isfinite, found)):
            return careful(*strokes)
        return found[:count]

    return at
