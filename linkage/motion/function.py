"""Values and ratios of one design, pose by pose, as a plain function of floats: for root finders and other loops."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from math import isfinite
from typing import Any, TypeAlias

import numpy as np

from ..errors import DefinitionError
from ..plan import Plan
from ..program import NO_VALUE, QUICKEST, Kernel
from .bulk import Bulk
from .grid import Grid
from .request import Request, wanted

PoseFunction: TypeAlias = Callable[..., tuple[float, ...]]


def function_of(plan: Plan, designs: Mapping[str, Any], requests: Sequence[Request]) -> PoseFunction:
    """Return requests as a function of the strokes; see Mechanism.function."""
    if any(np.ndim(value) for value in designs.values()):
        raise DefinitionError(f"{plan.title}: a function of floats is of one design; use evaluate for several.")
    asked = tuple(wanted(plan, request) for request in requests)

    def bulk(strokes: Sequence[float]) -> Bulk:
        if len(strokes) != len(plan.strokes):
            raise DefinitionError(f"{plan.title}: one value for each stroke is expected: {', '.join(plan.strokes)}.")
        values = {name: np.asarray(value, float) for name, value in zip(plan.strokes, strokes, strict=True)}
        return Bulk(Grid(plan, designs, values), asked, QUICKEST)

    def careful(*strokes: float) -> tuple[float, ...]:
        return tuple(float(part) for values in bulk(strokes).run(None) for part in np.ravel(values))

    if plan.groups:
        return careful
    return quick(plan, designs, bulk([stroke.start for stroke in plan.strokes.values()]).kernel, careful)


def quick(plan: Plan, designs: Mapping[str, Any], kernel: Kernel, careful: PoseFunction) -> PoseFunction:
    """Return the pose part with its design worked out; a pose where a guard or a failing operation tells is taken carefully."""
    floats, count = kernel.floats, len(kernel.plan.outputs)
    passed = floats.design([float(designs[node.value]) for node in kernel.plan.design_inputs])
    pose, watched = floats.quick["pose"], plan.may_overflow
    places = [list(plan.strokes).index(node.value) for node in kernel.plan.pose_inputs]
    together = places == list(range(len(plan.strokes)))

    def at(*strokes: float) -> tuple[float, ...]:
        try:
            found: tuple[float, ...] = pose(*passed, *(strokes if together else [strokes[place] for place in places]))
        except (*NO_VALUE, TypeError, IndexError):
            return careful(*strokes)
        for guard in found[count:]:
            if not guard > 0.0:
                return careful(*strokes)
        if watched and not all(map(isfinite, found)):
            return careful(*strokes)
        return found[:count]

    return at
