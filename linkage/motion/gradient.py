"""Derivatives by dimensions: reverse mode through the program, all dimensions at once."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, final

import numpy as np

from ..errors import DefinitionError
from ..plan import Plan
from ..program import FloatArray, Kernel, Node, ancestors, gradient
from .grid import Angles, angles_of
from .limits import Mask
from .requests import BoundRequest, RequestLike, astray, bound, dimensions_of

if TYPE_CHECKING:
    from .motion import Motion


@dataclass(frozen=True, eq=False)
class Slopes:
    """The kernel of a request's derivatives by some dimensions, then of what it assumes, then of its switches by those dimensions."""

    kernel: Kernel
    angles: Angles
    assumed: int
    touched: tuple[str, ...]


@final
@dataclass(frozen=True)
class Slope(BoundRequest):
    """The derivatives of a request by some dimensions, as a request that is looked at near singular poses."""

    what: BoundRequest
    by: tuple[str, ...]

    @property
    def key(self) -> Any:
        return "slope", self.what.key, self.by

    @property
    def order(self) -> int:
        return 1 + self.what.order

    def nodes(self, plan: Plan) -> tuple[Node, ...]:
        inputs = [plan.trace.inputs[name] for name in self.by]
        return tuple(share for node in self.what.nodes(plan) for share in gradient(node, inputs))

    def names(self, plan: Plan) -> set[str]:
        return self.what.names(plan)

    def __str__(self) -> str:
        return f"the gradient of {self.what}"


def slopes_of(plan: Plan, what: BoundRequest, names: Sequence[str]) -> Slopes:
    """Return the derivatives of a request by dimensions, as a kernel."""
    inputs = [plan.trace.inputs[name] for name in names]
    shares, notes = Slope(what, tuple(names)).nodes(plan), what.notes(plan)
    touched = [
        (switch, f"{name}: the law of {owner} compares what follows {name} with a number")
        for switch, owner in notes.switches.items()
        for name, each in zip(names, inputs, strict=True)
        if each in ancestors([switch])
    ]
    kernel = Kernel([*shares, *notes.assumed, *(switch for switch, _ in touched)])
    return Slopes(kernel, angles_of(plan, shares), len(notes.assumed), tuple(words for _, words in touched))


def gradient_of(motion: Motion, of: RequestLike, wrt: Sequence[str]) -> FloatArray:
    """Return the derivatives of a request by dimensions, shape (len(wrt), ...), of a point (len(wrt), 2, ...); see Motion.gradient."""
    plan = motion.plan
    what, dimensions = bound(plan, of), dimensions_of(plan, wrt)
    names, title = tuple(name for name, _ in dimensions), f"The gradient of {what}"
    refused = motion._refused(Slope(what, names), title)
    good = motion.reached & ~refused
    slopes = plan.made(("gradient", what.key, names), lambda plan: slopes_of(plan, what, names))
    rest = what.rows * len(names)
    values, assumed, switches = np.split(motion._grid.full(slopes.kernel(motion._grid.flat).values), [rest, rest + slopes.assumed])
    check(motion, what, good, assumed, zip(slopes.touched, switches, strict=True))
    continued = slopes.angles.continued(motion._grid, motion.reached)
    signs = np.tile([float(sign) for _, sign in dimensions], what.rows).reshape(-1, *(1,) * len(motion.shape))
    found = values if continued is None else continued
    if not (good.all() and np.all(signs > 0.0) and found.flags.writeable):
        found = np.where(good, found * signs, np.nan)
    rows = motion._finite(found, refused, title)
    return np.stack(np.split(rows, what.rows), axis=1) if what.rows > 1 else rows


def check(motion: Motion, what: BoundRequest, good: Mask, assumed: FloatArray, switches: Iterable[tuple[str, FloatArray]]) -> None:
    """Raise the error of poses where a law is another than the one traced, or changes to another with a dimension."""
    if np.any(good & ~np.all(assumed > 0.0, axis=0)):
        what.refuse(motion)
        raise astray(motion.plan, what)
    for words, values in switches:
        if np.any(good & (values > 0.0)):
            raise DefinitionError(
                f"{motion.plan.title}: {what} has no derivative by {words} that it equals here, and is another law next to it. "
                "Leave that dimension out of wrt=, or set it beside that number."
            )
