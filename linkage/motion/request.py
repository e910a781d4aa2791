"""What is asked of a mechanism: a point, a vector or a quantity, or its derivative by strokes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

from ..errors import DefinitionError
from ..plan import Plan
from ..program import Node
from ..quantities import Member, Quantity
from ..steps import Arrow, Point
from .asked import named, order_of


@dataclass(frozen=True)
class Ratio:
    """The derivative of a point or a quantity by a stroke: the transfer ratio, as something to ask for."""

    target: str | Member
    wrt: str | None = None
    order: int = 1


Request: TypeAlias = str | Member | Ratio


def ratio(target: str | Member, wrt: str | None = None, order: int = 1) -> Ratio:
    """Return the request for the derivative of a point or a quantity by a stroke, in `evaluate` and `gradient`.

    `ratio("G")` is dG/dS, `ratio("G", order=2)` d2G/dS2; `wrt="S2"` where there are several strokes.
    """
    return Ratio(target, wrt, order_of(order))


@dataclass(frozen=True)
class Wanted:
    """A request settled: a member, and the strokes that it is differentiated by, one after the other."""

    member: Member
    along: tuple[str, ...]

    @property
    def key(self) -> tuple[Any, ...]:
        """What tells this request from others of the same plan."""
        return self.member.name or self.member, self.along

    @property
    def rows(self) -> int:
        """The number of its components."""
        return 2 if isinstance(self.member, (Point, Arrow)) else 1

    def nodes(self, plan: Plan) -> tuple[Node, ...]:
        """Return its nodes in a plan's program."""
        target: Any = self.member.name or self.member
        return plan.derived(plan.nodes(target), self.along)

    def names(self, plan: Plan) -> set[str]:
        """Return the members that it is built from."""
        return plan.reaches(self.member.name or self.member)

    def __str__(self) -> str:
        what = self.member.name or str(self.member)
        return f"the ratio of {what} by {self.along[0]}" if self.along else what


def wanted(plan: Plan, request: Request) -> Wanted:
    """Return a request settled; DefinitionError where there is nothing of that name, or no saying by which stroke."""
    asked = request if isinstance(request, Ratio) else Ratio(request, order=0)
    along = (stroke_of(plan, asked.wrt),) * asked.order if asked.order else ()
    target = asked.target
    if isinstance(target, Quantity) and not target.name:
        return Wanted(target, along)
    member = plan.members[named("Name", target, plan.named(), plan.title)]
    return Wanted(member, along)


def stroke_of(plan: Plan, name: str | None) -> str:
    """Return the stroke that is meant; DefinitionError where there are several and none is named."""
    if name is None and len(plan.strokes) == 1:
        return next(iter(plan.strokes))
    if name is None:
        raise DefinitionError(f"{plan.title} has {len(plan.strokes)} strokes: say wrt= one of {', '.join(plan.strokes)}.")
    return named("Stroke", name, plan.strokes, plan.title)


def dimensions_of(plan: Plan, names: Sequence[str]) -> list[tuple[str, int]]:
    """Return design variables by any of their spellings, with signs; DefinitionError for what is none of them."""
    if isinstance(names, str):
        raise DefinitionError(f'{plan.title}: wrt="{names}": a list of dimensions is expected, wrt=["{names}"].')
    for name in names:
        if f"{name}.x" in plan.table.spellings or f"{name}.y" in plan.table.spellings:
            raise DefinitionError(f'{plan.title}: wrt="{name}": a point has two coordinates; say "{name}.x" or "{name}.y".')
        if name in plan.table.following and name not in plan.table.spellings:
            raise DefinitionError(f"{plan.title}: {name} follows {plan.table.following[name]}; take the gradient by what it follows.")
    return [plan.table.spellings[named("Dimension", name, plan.table.spellings, plan.title)] for name in names]
