"""What a request is, once it is settled on a plan: nodes of its program, and what is said where they have no value."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import DefinitionError
from ..plan import NEAR, ArrayReading, Plan
from ..program import FloatArray, Kernel, Node, Notes
from .grid import Grid
from .reach import Mask
from .singular import PLACES, Judged, Left, Rounding, judged

if TYPE_CHECKING:
    from .motion import Motion


SMALL = 1e-9
"""A result of no known size [SI] that is smaller counts as so large where its relative error is told."""


class Wanted(ABC):
    """A request settled on a plan. A subclass says of which nodes it consists, and by what key it is told from others."""

    @property
    @abstractmethod
    def key(self) -> Any:
        """What tells this request from others of the same plan."""

    @abstractmethod
    def nodes(self, plan: Plan) -> tuple[Node, ...]:
        """Return its nodes in a plan's program, one a component."""

    @abstractmethod
    def names(self, plan: Plan) -> set[str]:
        """Return the members that it is built from."""

    @abstractmethod
    def refuse(self, motion: Motion) -> None:
        """Raise the error of a motion's poses where it has no value; nothing where it has one at all of them."""

    @abstractmethod
    def __str__(self) -> str:
        """Return what it is, in words: `the ratio of G by S`."""

    def notes(self, plan: Plan) -> Notes:
        """Return what its nodes are true under."""
        return Notes()

    @property
    def rows(self) -> int:
        """The number of its components: 2 for a point."""
        return 1

    @property
    def order(self) -> int:
        """How often it is differentiated."""
        return 0

    def steep(self, plan: Plan) -> set[str]:
        """Return the members at whose singular poses it is refused: those it is differentiated through."""
        return self.names(plan) if self.order else set()

    def note(self, reading: ArrayReading) -> None:  # noqa: B027
        """Work out in an eager reading what is its own, so that its directions are noted; of most there is nothing."""

    @property
    def regular(self) -> float:
        """The product of squared parts (Trace.nearness) above which rounding leaves at least nine digits of it."""
        return NEAR**2 if self.order else PLACES

    def error(self, plan: Plan, left: Left) -> FloatArray:
        """Return the relative error to expect, shape (n,), from what rounding leaves of its nodes."""
        return left.over(SMALL)

    @property
    def may_fail(self) -> bool:
        """Whether it may have no value where all points it is built from have a place."""
        return False

    @property
    def turns(self) -> bool:
        """Whether it follows angles, which are continued along the stroke."""
        return False


class Asked(ABC):
    """Something to ask of a mechanism that is no member of it: a ratio, a thrust, a pin force."""

    @abstractmethod
    def settled(self, plan: Plan) -> Wanted:
        """Return the request settled on a plan; DefinitionError where there is no such thing."""


def watch_of(plan: Plan, what: Wanted) -> Kernel:
    """Return the kernel of what is above zero where a request is far from every singular pose."""
    return plan.made(("watch", what.key), lambda twin: Kernel(watched(twin, what)))


def watched(plan: Plan, what: Wanted) -> list[Node]:
    """Return the nodes that are above zero where a request is far from every singular pose."""
    what.nodes(plan)  # directions of its own are noted then
    return plan.trace.watched(what.names(plan), what.regular)


def near_of(grid: Grid, what: Wanted) -> Mask:
    """Return the mask of poses at which a request has to be looked at closely."""
    watch = watch_of(grid.plan, what)
    if not watch.plan.outputs:
        return np.zeros(grid.shape, bool)
    with np.errstate(invalid="ignore"):
        return np.asarray(~np.all(grid.full(watch(grid.flat).values) > 0.0, axis=0))


def examined(plan: Plan, what: Wanted, inputs: Mapping[str, Any], reading: ArrayReading) -> Judged:
    """Return how far poses are from singular ones for a request: inputs as floats or (n,), and the eager reading there."""
    what.note(reading)
    rounding = plan.made(("rounding", what.key), lambda twin: Rounding.of(twin, what.nodes(twin)))
    return judged(plan, reading, what.steep(plan), what.names(plan), what.error(plan, rounding.at(inputs)))


def astray(plan: Plan, what: Wanted) -> DefinitionError:
    """Return the error for poses where a law goes another way than the one that was traced."""
    laws = ", ".join(dict.fromkeys(what.notes(plan).assumed.values()))
    return DefinitionError(
        f"{plan.title}: {what}: at some of these poses {f'the law of {laws}' if laws else 'a law'} goes another way than the one traced, "
        "or has no finite value. Leave them out, choose by np.where in the law, or take finite differences of the forces."
    )
