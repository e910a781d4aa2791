"""Requests by a formula of a motion: read on arrays it gives values, on the nodes of a program their derivatives as well."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Hashable
from copy import copy
from dataclasses import dataclass
from typing import Self, final

from ..errors import UntracedError
from ..motion import Request, require_motion
from ..motion.grid import MotionLike
from ..motion.requests import identity_of
from ..plan import Plan
from ..program import FloatArray, Node, Notes
from .poses import AnyMotion
from .traced_loads import TracedMotion, traced_apart


@final
@dataclass(frozen=True, eq=False)
class TracedLaw:
    """A formula on a program: the traced motion that it asked, and its node."""

    motion: TracedMotion
    node: Node


@final
@dataclass(frozen=True, eq=False)
class LawInPlan:
    """What a formula is in a plan: what tells it from others, the members that it reads, and those it is differentiated through.

    `traced_with` tells the formulas that are traced in one with it, `words` what it is of there.
    """

    key: Hashable
    read: frozenset[str]
    through: frozenset[str]
    traced_with: Hashable = None
    words: str = ""


class LawRequest(Request):
    """The base of requests that a formula gives: a subclass says `law(motion)`, plain arithmetic on what a motion tells."""

    _in_plan: LawInPlan | None = None
    """What it is in the plan that it is bound to."""

    @abstractmethod
    def law(self, motion: AnyMotion) -> FloatArray:
        """Return the values over a motion's poses [SI], shape (...); one number of a program where the motion is traced."""

    @abstractmethod
    def examine(self, plan: Plan) -> None:
        """Raise DefinitionError where a plan has nothing of the kind, UntracedError where it has values alone."""

    def of(self, motion: MotionLike) -> FloatArray:
        return self.law(require_motion(motion))

    # -- bound to a plan ---------------------------------------------------------------------------------

    def bound(self, plan: Plan) -> Self:
        identity = identity_of(plan, self)
        return self._bound(plan) if identity is None else plan.made(("bound", identity), lambda _: self._bound(plan))

    def _bound(self, plan: Plan) -> Self:
        self.examine(plan)
        return self.told(traced_apart(plan, self.looked_up))

    def told(self, found: LawInPlan) -> Self:
        """Return the same, bound to the plan in which it is that."""
        same = copy(self)
        object.__setattr__(same, "_in_plan", found)  # of a frozen dataclass that nobody has seen yet
        return same

    def looked_up(self, motion: TracedMotion) -> LawInPlan:
        """Return what it is in the plan of a traced motion; UntracedError where it has no program."""
        traced = self.traced(motion)
        notes = traced.motion.notes
        key = "law", motion._reading.graph, traced.node.number, *notes.assumed, None, *notes.switches, None, *notes.gaps
        return LawInPlan(key, frozenset(motion.read), frozenset(motion.through))

    def traced(self, motion: TracedMotion) -> TracedLaw:
        """Return the formula on the nodes of a program; UntracedError where it has none."""
        motion.notes.owner, motion.notes.tests = str(self), 0
        try:
            return TracedLaw(motion, motion.node(self.law(motion)))
        except UntracedError as error:
            raise UntracedError(f"{self}: {error}") from error
        except Exception as error:
            said = str(error).rstrip(".")
            raise UntracedError(
                f"{motion.plan.title}: {self} has values, and no program that gives derivatives: {said}. Take finite differences."
            ) from error

    @property
    def in_plan(self) -> LawInPlan:
        """What it is in the plan that it is bound to."""
        assert self._in_plan is not None, f"{self} is not bound to a plan"
        return self._in_plan

    @property
    def key(self) -> Hashable:
        return self if self._in_plan is None else self._in_plan.key

    @property
    def traced_with(self) -> Hashable:
        return self.key if self._in_plan is None else self._in_plan.traced_with or self.key

    def _traced(self, plan: Plan) -> TracedLaw:
        """Return the formula on a plan's program, traced there once."""
        found = plan.trace.kept.get(self.key)
        if not isinstance(found, TracedLaw):
            found = plan.trace.kept[self.key] = self.traced(TracedMotion(plan, plan.trace))
        return found

    def nodes(self, plan: Plan) -> tuple[Node, ...]:
        return (self._traced(plan).node,)

    def notes(self, plan: Plan) -> Notes:
        return self._traced(plan).motion.notes

    def gaps(self, plan: Plan) -> tuple[Node, ...]:
        return tuple(self.notes(plan).gaps)

    def names(self, plan: Plan) -> set[str]:
        return set(self.in_plan.read)

    def differentiated(self, plan: Plan) -> set[str]:
        return set(self.in_plan.through)

    @property
    def order(self) -> int:
        return 1 if self._in_plan is not None and self._in_plan.through else 0

    @property
    def may_fail(self) -> bool:
        return True

    @property
    def follows_angles(self) -> bool:
        return True

    def refuse(self, motion: MotionLike) -> None:
        self.of(motion)
