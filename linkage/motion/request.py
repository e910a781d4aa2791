"""What is asked of a mechanism: a point, a vector or a quantity, or its derivative by strokes."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence, Set
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeAlias, final

import numpy as np

from ..errors import DefinitionError, cited
from ..plan import ArrayReading, Plan
from ..program import FloatArray, Node
from ..quantities import Member, Quantity
from ..steps import Arrow, Point
from .asked import named, order_of
from .singular import LEAST, Left
from .wanted import SMALL, Asked, Wanted

if TYPE_CHECKING:
    from .motion import Motion


MINOR = 1e-3
"""Of the fastest point's ratio: what a slower one's error is compared with where both go into a force."""


@final
@dataclass(frozen=True)
class Ratio(Asked):
    """The derivative of a point or a quantity by a stroke: the transfer ratio, as something to ask for."""

    target: str | Member
    wrt: str | None = None
    order: int = 1

    def settled(self, plan: Plan) -> Value:
        along = (stroke_of(plan, self.wrt),) * self.order if self.order else ()
        if isinstance(self.target, Quantity) and not self.target.name:
            plan.reaches(self.target)  # raises for a name in it that there is not
            return Value(self.target, along)
        return Value(plan.members[named("Name", self.target, plan.named(), plan.title)], along)


Request: TypeAlias = str | Member | Asked


def ratio(target: str | Member, wrt: str | None = None, order: int = 1) -> Ratio:
    """Return the request for the derivative of a point or a quantity by a stroke, in `evaluate` and `gradient`.

    `ratio("G")` is dG/dS, `ratio("G", order=2)` d2G/dS2; `wrt="S2"` where there are several strokes.
    """
    return Ratio(target, wrt, order_of(order))


@final
@dataclass(frozen=True)
class Value(Wanted):
    """A member, and the strokes that it is differentiated by, one after the other."""

    member: Member
    along: tuple[str, ...]

    @property
    def target(self) -> Any:
        """The member by its name, or itself where it has none."""
        return self.member.name or self.member

    @property
    def key(self) -> Any:
        return self.target, self.along

    @property
    def rows(self) -> int:
        return 2 if isinstance(self.member, (Point, Arrow)) else 1

    @property
    def order(self) -> int:
        return len(self.along)

    def nodes(self, plan: Plan) -> tuple[Node, ...]:
        return plan.derived(plan.nodes(self.target), self.along)

    def names(self, plan: Plan) -> set[str]:
        return plan.reaches(self.target)

    def refuse(self, motion: Motion) -> None:
        if self.along:
            motion.ratio(self.target, wrt=self.along[0], order=self.order)

    @property
    def turns(self) -> bool:
        return isinstance(self.member, Quantity)

    def note(self, reading: ArrayReading) -> None:
        if isinstance(self.member, Quantity):
            with np.errstate(all="ignore"):
                reading.value(self.member)

    def error(self, plan: Plan, left: Left) -> FloatArray:
        scale = natural(self.member, left.size)
        if scale is None:
            return left.over(SMALL)
        for name in self.along:
            scale = scale / (abs(plan.strokes[name].end - plan.strokes[name].start) or 1.0)
        return left.over(LEAST * scale if self.along else scale)

    def __str__(self) -> str:
        what = self.member.name or str(self.member)
        return f"the ratio of {what} by {self.along[0]}" if self.along else what


def natural(member: Any, size: FloatArray) -> Any:
    """Return what a position, a length or an angle is compared with: the machine's size [m], or 1 rad; None for other quantities."""
    if isinstance(member, (Point, Arrow)) or member.measures == "length":
        return size
    return np.ones_like(size) if member.measures == "angle" else None


@final
@dataclass(frozen=True)
class Ratios(Wanted):
    """The ratios of all moving points among some members by all strokes: what forces go through."""

    members: frozenset[str]

    @property
    def key(self) -> Any:
        return "ratios", self.members

    def points(self, plan: Plan) -> list[str]:
        """Return the points."""
        return [name for name in plan.moving if name in self.members]

    @property
    def order(self) -> int:
        return 1

    def nodes(self, plan: Plan) -> tuple[Node, ...]:
        places = [node for name in self.points(plan) for node in plan.nodes(name)]
        return tuple(node for stroke in plan.strokes for node in plan.derived(places, (stroke,)))

    def names(self, plan: Plan) -> set[str]:
        return set(self.members)

    def refuse(self, motion: Motion) -> None:
        """Ratios that stand for a force are refused with it."""

    def error(self, plan: Plan, left: Left) -> FloatArray:
        parts = [left.part(slice(row, row + 2)) for row in range(0, len(left.values), 2)]
        if not parts:
            return np.zeros(left.size.shape)
        with np.errstate(all="ignore"):
            largest = np.max([np.hypot(*part.values) for part in parts], axis=0)
        return np.asarray(np.max([part.over(MINOR * largest) for part in parts], axis=0))

    def __str__(self) -> str:
        return "the ratios of the points"


@final
@dataclass(frozen=True)
class Everywhere(Wanted):
    """The places of some points together: what a motion works out first."""

    points: tuple[str, ...]

    @property
    def key(self) -> Any:
        return "places", self.points

    def nodes(self, plan: Plan) -> tuple[Node, ...]:
        return tuple(node for name in self.points for node in plan.nodes(name))

    def names(self, plan: Plan) -> set[str]:
        return set[str]().union(*map(plan.reaches, self.points))

    def refuse(self, motion: Motion) -> None:
        """A motion refuses its places itself."""

    def error(self, plan: Plan, left: Left) -> FloatArray:
        with np.errstate(all="ignore"):
            found = left.errors.max(axis=0, initial=0.0) / left.size
        return np.where(np.isnan(found), np.inf, found)

    def __str__(self) -> str:
        return "the places"


def wanted(plan: Plan, request: Request) -> Wanted:
    """Return a request settled; DefinitionError where there is nothing of that name, or no saying by which stroke."""
    return (request if isinstance(request, Asked) else Ratio(request, order=0)).settled(plan)


def all_wanted(plan: Plan, requests: Sequence[Request]) -> tuple[Wanted, ...]:
    """Return a list of requests settled; DefinitionError for a lone one, whose letters would be taken for names."""
    if isinstance(requests, (str, Member, Asked)):
        raise DefinitionError(f"{plan.title}: {requests!r}: a list of what is asked for is expected, [{requests!r}].")
    if not isinstance(requests, Iterable) or isinstance(requests, (Mapping, Set, np.ndarray)):
        raise DefinitionError(f'{plan.title}: {cited(requests)}: a list of what is asked for is expected, such as ["G"].')
    return tuple(wanted(plan, request) for request in requests)


def stroke_of(plan: Plan, name: str | None) -> str:
    """Return the stroke that is meant; DefinitionError where there are several and none is named."""
    if name is None and len(plan.strokes) == 1:
        return next(iter(plan.strokes))
    if name is None:
        raise DefinitionError(f"{plan.title} has {len(plan.strokes)} strokes: say wrt= one of {', '.join(plan.strokes)}.")
    return named("Stroke", name, plan.strokes, plan.title)


def dimensions_of(plan: Plan, names: Any) -> list[tuple[str, int]]:
    """Return design variables by any of their spellings, with signs; DefinitionError for what is none of them."""
    if isinstance(names, str):
        raise DefinitionError(f'{plan.title}: wrt="{names}": a list of dimensions is expected, wrt=["{names}"].')
    if not isinstance(names, Iterable) or isinstance(names, np.ndarray):
        raise DefinitionError(f"{plan.title}: wrt={cited(names)}: a list of dimensions is expected.")
    names = [named("Dimension", name, (*plan.table.spellings, *plan.table.following, *plan.points), plan.title) for name in names]
    for name in names:
        if f"{name}.x" in plan.table.spellings or f"{name}.y" in plan.table.spellings:
            raise DefinitionError(f'{plan.title}: wrt="{name}": a point has two coordinates; say "{name}.x" or "{name}.y".')
        if name in plan.table.following and name not in plan.table.spellings:
            raise DefinitionError(f"{plan.title}: {name} follows {plan.table.following[name]}; take the gradient by what it follows.")
    return [plan.table.spellings[named("Dimension", name, plan.table.spellings, plan.title)] for name in names]
