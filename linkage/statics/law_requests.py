"""Requests by a formula of a motion: read on arrays it gives values, on the nodes of a program their derivatives as well."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import TypeAlias, cast, final
from weakref import ref

from ..errors import UntracedError
from ..loads import DIRECTIONS, PLAIN, Acting, Case, ForceElement, LoadCase
from ..motion import Motion, Request, SmoothPiece, require_motion
from ..motion.grid import MotionLike
from ..motion.requests import identity_of
from ..plan import Mask, Plan
from ..program import FloatArray, Node, Notes
from .applied import motion_in_case, plan_in_case
from .poses import AnyMotion
from .solution import held_in_case, refuse_loose
from .traced_loads import TracedMotion, traced_apart

TracedLaw: TypeAlias = tuple[TracedMotion, Node]
"""A formula on a program: the traced motion that it asked, and its node."""


@final
@dataclass(frozen=True, eq=False)
class LawInPlan:
    """What a formula is in a plan: what tells it from others, the members that it reads, and those it is differentiated through.

    `trace` gives it on a traced motion of the plan, `traced_with` tells the formulas that are traced in one with it, None where it has been
    traced to know this, `sentence` what it is of there.
    """

    key: Hashable
    read: frozenset[str]
    through: frozenset[str]
    trace: Callable[[TracedMotion], TracedLaw]
    traced_with: Hashable = None
    sentence: str = ""


def law_in_plan(motion: TracedMotion, trace: Callable[[TracedMotion], TracedLaw], sentence: str = "") -> LawInPlan:
    """Return what a formula is in the plan of a traced motion, from its nodes there; UntracedError where it has no program."""
    traced, node = trace(motion)
    notes = traced.notes
    key = "law", motion._reading.graph, node.number, *notes.assumed, None, *notes.switches, None, *notes.gaps
    return LawInPlan(key, frozenset(motion.read), frozenset(motion.through), trace, sentence=sentence)


@final
@dataclass(frozen=True, eq=False, kw_only=True)
class LawRequest(Request):
    """What a formula gives over a motion's poses: `formula(motion, acting)`, plain arithmetic on what a motion tells; [SI], shape (...).

    On a traced motion it gives one number of a program. Where `acting` is None it hangs on no situation, and is `formula(motion)`.
    `text` is what one writes, of the situation where it hangs on one; `known` tells the formula from others, whatever the situation:
    None where it may change. `mover` is the cylinder in whose directions it is judged, else these are the strokes'; `directions(plan)`
    are those in which it is, None as without it: all where there is friction; `cases_in(plan, case)` whether it is in a load case.

    The rest is for requests that have something of their own to say. `examine(plan)` raises DefinitionError if a plan has nothing of the
    kind. `measured_in(plan)` says what it measures there, `pieces_in(request, plan)` its smooth pieces. `unlimited_in(motion, acting)` is
    the mask of poses where it has no bound. `look_up(request, motion)` is the request in the plan of a traced motion. `column` names the
    column of a table that it is, whose gaps alone it has.
    """

    formula: Callable[..., FloatArray]
    text: str | Callable[[Acting], str]
    known: Hashable = None
    acting: Acting | None = None
    measures: str = ""
    mover: Hashable = None
    directions: Callable[[Plan], tuple[str, ...] | None] | None = None
    cases_in: Callable[[Plan, str], bool] | None = None
    examine: Callable[[Plan], object] | None = None
    measured_in: Callable[[Plan], str] | None = None
    pieces_in: Callable[[LawRequest, Plan], tuple[SmoothPiece, ...]] | None = None
    unlimited_in: Callable[[Motion, Acting], Mask] | None = None
    look_up: Callable[[LawRequest, TracedMotion], LawInPlan] | None = None
    column: str = ""
    in_plan: LawInPlan | None = None
    """What it is in the plan that it is bound to."""
    of_laws = True
    may_fail = True
    follows_angles = True

    def law(self, motion: AnyMotion) -> FloatArray:
        """Return the values over a motion's poses [SI], shape (...); one number of a program where the motion is traced."""
        return self.formula(motion) if self.acting is None else self.formula(held_in_case(motion, self.acting), self.acting)

    def of(self, motion: MotionLike) -> FloatArray:
        return self.law(require_motion(motion))

    def __str__(self) -> str:
        return self.text if isinstance(self.text, str) else self.text(self.situation)

    # -- in a situation ----------------------------------------------------------------------------------

    @property
    def situation(self) -> Acting:
        """The situation in which it is asked."""
        return PLAIN if self.acting is None else self.acting

    def identity(self, plan: Plan) -> Hashable:
        acting = self.situation
        loads = situation_identity(acting)
        return None if self.known is None or loads is None else ("law", self.known, loads, acting.direction, acting.drive)

    def under(self, acting: Acting, *, keep: bool = False) -> LawRequest:
        if self.acting is None:
            return self
        outer = acting if self.of_strokes else replace(acting, drive=None)
        found = self.acting.within(outer, "" if keep else str(self))
        return self if found == self.acting else replace(self, acting=found)

    @property
    def of_strokes(self) -> bool:
        return self.acting is not None and self.mover is None

    def movements(self, plan: Plan, rubs: bool) -> tuple[str, ...]:
        own = () if self.acting is None else None if self.directions is None else self.directions(plan)
        return own if own is not None else DIRECTIONS if rubs else DIRECTIONS[:1]

    def occurs_in(self, plan: Plan, case: str) -> bool:
        return self.cases_in is None or self.cases_in(plan, case)

    def measured(self, plan: Plan) -> str:
        return self.measures if self.measured_in is None else self.measured_in(plan)

    def pieces(self, plan: Plan) -> tuple[SmoothPiece, ...]:
        return super().pieces(plan) if self.pieces_in is None else self.pieces_in(self, plan)

    @property
    def may_be_unlimited(self) -> bool:
        return self.unlimited_in is not None

    def unlimited(self, motion: MotionLike) -> Mask | None:
        return None if self.unlimited_in is None else self.unlimited_in(motion_in_case(require_motion(motion), self.acting), self.situation)

    # -- bound to a plan ---------------------------------------------------------------------------------

    def bound(self, plan: Plan) -> LawRequest:
        def made(_: Plan) -> LawRequest:
            if self.examine is not None:
                self.examine(plan)
            if self.acting is not None:
                refuse_loose(plan_in_case(plan, self.acting))
            look_up = partial(law_in_plan, trace=self.traced_law) if self.look_up is None else partial(self.look_up, self)
            return replace(self, in_plan=traced_apart(plan, look_up))

        identity = identity_of(plan, self) if self.situation.loads is None else None  # what is kept must not keep loads alive
        return made(plan) if identity is None else plan.made(("bound", identity), made)

    def traced_law(self, motion: TracedMotion) -> TracedLaw:
        """Return the formula on the nodes of a program; UntracedError where it has none."""
        motion.notes.owner, motion.notes.tests = str(self), 0
        try:
            found = motion, motion.node(self.law(motion))
        except UntracedError as error:
            raise UntracedError(f"{self}: {error}") from error
        except Exception as error:
            what = f"{motion.plan.title}: {self} has values, and no program that gives derivatives: {str(error).rstrip('.')}"
            raise UntracedError(f"{what}. Take finite differences.") from error
        if self.column:
            claimed = motion.notes.claims.get(self.column, ())
            motion.notes.gaps = {node: owner for node, owner in motion.notes.gaps.items() if node in claimed}
        return found

    @property
    def key(self) -> Hashable:
        return self if self.in_plan is None else self.in_plan.key

    @property
    def sentence(self) -> str:
        return str(self) if self.in_plan is None else self.in_plan.sentence or str(self)

    @property
    def traced_with(self) -> Hashable:
        return self.key if self.in_plan is None else self.in_plan.traced_with

    def _traced(self, plan: Plan) -> TracedLaw:
        """Return the formula on a plan's program, traced there once."""
        assert self.in_plan is not None, f"{self} is not bound to {plan.title}"
        kept = cast(dict[Hashable, TracedLaw], plan.trace.kept)
        if self.key not in kept:
            kept[self.key] = self.in_plan.trace(TracedMotion(plan, plan.trace))
        return kept[self.key]

    def nodes(self, plan: Plan) -> tuple[Node, ...]:
        return (self._traced(plan)[1],)

    def notes(self, plan: Plan) -> Notes:
        return self._traced(plan)[0].notes

    def gaps(self, plan: Plan) -> tuple[Node, ...]:
        return tuple(self.notes(plan).gaps)

    def names(self, plan: Plan) -> set[str]:
        return set(() if self.in_plan is None else self.in_plan.read)

    def differentiated(self, plan: Plan) -> set[str]:
        return set(() if self.in_plan is None else self.in_plan.through)

    @property
    def order(self) -> int:
        return 1 if self.in_plan is not None and self.in_plan.through else 0

    def refuse(self, motion: MotionLike) -> None:
        self.of(motion)


# The situation that a request is asked in: what tells it from others, and how it is written.


def situation_identity(acting: Acting) -> Hashable:
    """Return what tells loads in a load case from others, which it does not keep alive; None where one of them may change.

    The direction and the drive are not in it. Members that were declared do not change, nor do frozen dataclasses. What their laws
    compute with is taken not to change either.
    """
    loads = acting.loads
    listed = () if loads is None else loads if isinstance(loads, (list, tuple)) else (loads,)
    given = (acting.case, *listed)
    parts = [each if each is None or isinstance(each, str) else ref(each) if is_unchanging(each) else ... for each in given]
    return None if acting.rates is not None or ... in parts else (loads is None, *parts)


def is_unchanging(thing: object) -> bool:
    """Return whether loads or a load case cannot change: members of a class, and frozen dataclasses."""
    if not isinstance(thing, (ForceElement, LoadCase)):
        return False
    settings = vars(type(thing)).get("__dataclass_params__")
    return bool(thing._class) or (settings is not None and settings.frozen)


def case_words(case: Case) -> list[str]:
    """Return a load case as an argument in words; nothing of none."""
    return [] if case is None else [f"case={case if isinstance(case, str) else case.name or case.label}"]


def request_text(word: str, arguments: Sequence[str], acting: Acting) -> str:
    """Return how a request is written that hangs on the load case of a situation: as a function of that name with some arguments."""
    return f"{word}({', '.join([*arguments, *case_words(acting.case)])})"
