"""Requests by a formula of a motion: read on arrays it gives values, on the nodes of a program their derivatives as well."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Hashable
from dataclasses import dataclass
from typing import final

from ..errors import UntracedError
from ..motion import BoundRequest, Request, require_motion
from ..motion.grid import MotionLike
from ..plan import Plan
from ..program import FloatArray, Node, Notes
from .force_requests import bound_once
from .poses import AnyMotion
from .traced_loads import TRACING, TracedMotion


class LawRequest(Request):
    """The base of requests that a formula gives: a subclass says `law(motion)`, plain arithmetic on what a motion tells."""

    @abstractmethod
    def law(self, motion: AnyMotion) -> FloatArray:
        """Return the values over a motion's poses [SI], shape (...); one number of a program where the motion is traced."""

    @abstractmethod
    def examine(self, plan: Plan) -> None:
        """Raise DefinitionError where a plan has nothing of the kind."""

    def of(self, motion: MotionLike) -> FloatArray:
        return self.law(require_motion(motion))

    def bound(self, plan: Plan) -> LawOf:
        return bound_once(plan, self, self._bound)

    def _bound(self, plan: Plan) -> LawOf:
        self.examine(plan)
        with TRACING:
            kept = plan.made(("traced loads",), lambda twin: twin)
            traced = self.traced(TracedMotion(kept, kept.trace.view()))
        notes = traced.motion.notes
        key = traced.motion._reading.graph, traced.node.number, *notes.assumed, None, *notes.switches, None, *notes.gaps
        return LawOf(self, key, frozenset(traced.motion.read), frozenset(traced.motion.through))

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


@final
@dataclass(frozen=True, eq=False)
class TracedLaw:
    """A formula on a program: the traced motion that it asked, and its node."""

    motion: TracedMotion
    node: Node


@final
@dataclass(frozen=True, eq=False)
class LawOf(BoundRequest):
    """A formula bound to a plan: the request, its key, the members it reads, and those it is differentiated through."""

    request: LawRequest
    traced_key: tuple[Hashable, ...]
    read: frozenset[str]
    through: frozenset[str]

    @property
    def key(self) -> Hashable:
        return "law", self.traced_key

    def _traced(self, plan: Plan) -> TracedLaw:
        """Return the formula on a plan's program, traced there once."""
        found = plan.trace.kept.get(self)
        if not isinstance(found, TracedLaw):
            found = plan.trace.kept[self] = self.request.traced(TracedMotion(plan, plan.trace))
        return found

    def nodes(self, plan: Plan) -> tuple[Node, ...]:
        return (self._traced(plan).node,)

    def notes(self, plan: Plan) -> Notes:
        return self._traced(plan).motion.notes

    def gaps(self, plan: Plan) -> tuple[Node, ...]:
        return tuple(self._traced(plan).motion.notes.gaps)

    def names(self, plan: Plan) -> set[str]:
        return set(self.read)

    def differentiated(self, plan: Plan) -> set[str]:
        return set(self.through)

    @property
    def order(self) -> int:
        return 1 if self.through else 0

    @property
    def may_fail(self) -> bool:
        return True

    @property
    def follows_angles(self) -> bool:
        return True

    def refuse(self, motion: MotionLike) -> None:
        self.request.of(motion)

    def __str__(self) -> str:
        return str(self.request)
