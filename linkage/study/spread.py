"""The standard deviation that tolerances give a quantity, from its exact gradient: a request, so that a search can follow it."""

from __future__ import annotations

from collections.abc import Hashable, Mapping
from dataclasses import dataclass
from typing import Any, final

import numpy as np

from ..errors import DefinitionError, cited, unwarned
from ..mechanism import Mechanism
from ..motion import BoundRequest, Request, RequestLike, require_motion
from ..motion.grid import MotionLike
from ..motion.measures import words_of
from ..motion.requests import dimensions_of, identity_of
from ..plan import Plan
from ..program import FloatArray, Node, Notes, gradient
from .checks import check_mechanism
from .measured import number_bound
from .tolerances import ToleranceLike, tolerances_of


@final
@dataclass(frozen=True, eq=False)
class Sigma(Request):
    """The standard deviation of a quantity, to the first order in the tolerances of some dimensions, as something to ask for."""

    quantity: RequestLike
    tolerances: Mapping[str, ToleranceLike]

    def identity(self, plan: Plan) -> Hashable:
        of = identity_of(plan, self.quantity)
        return None if of is None else ("sigma", of, deviations_of(plan, self.tolerances))

    def bound(self, plan: Plan) -> SigmaOf:
        return SigmaOf(traced_number(plan, self.quantity), self.quantity, deviations_of(plan, self.tolerances))

    def __str__(self) -> str:
        return f"sigma({words_of(self.quantity)})"


def sigma(quantity: RequestLike, tolerances: Mapping[str, ToleranceLike]) -> Sigma:
    """Return the request for the standard deviation of a quantity, sqrt(sum (g_i sigma_i)^2) with its exact gradient g.

    `sigma("tilt", {"OB": 0.1 * mm, "M": 0.5 * mm})` in the quantity's unit, in `evaluate`, `function`, `gradient` and searches. Dimensions
    are independent of each other. Source: the law of propagation of uncertainty, ISO/IEC Guide 98-3 (GUM), 5.1.2.
    """
    return Sigma(quantity, tolerances)


def traced_number(plan: Plan, quantity: Any) -> BoundRequest:
    """Return a quantity bound to a plan; DefinitionError for what has no gradient in the program."""
    found = number_bound(plan, quantity)
    if found is None:
        what = f"{plan.title}: {words_of(quantity)} is no part of the program, so that its gradient is not known"
        raise DefinitionError(f"{what}; give an output, a quantity or a request.")
    return found


def deviations_of(plan: Plan, tolerances: Any) -> tuple[tuple[str, float], ...]:
    """Return dimensions by name with their standard deviations [SI]."""
    return tuple((name, each.sigma) for name, each in tolerances_of(plan, tolerances).items())


@final
@dataclass(frozen=True, eq=False)
class SigmaOf(BoundRequest):
    """The standard deviation of a quantity, bound to a plan: the quantity, and dimensions with their standard deviations [SI]."""

    what: BoundRequest
    quantity: RequestLike
    deviations: tuple[tuple[str, float], ...]

    @property
    def key(self) -> Hashable:
        return "sigma", self.what.key, self.deviations

    @property
    def order(self) -> int:
        return 1 + self.what.order

    def nodes(self, plan: Plan) -> tuple[Node, ...]:
        (node,) = self.what.nodes(plan)
        owners = [owner for owner, _ in dimensions_of(plan, [name for name, _ in self.deviations])]
        graph, total = node.graph, node.graph.constant(0.0)
        for share, (_, each) in zip(gradient(node, [plan.trace.inputs[owner] for owner in owners]), self.deviations, strict=True):
            total = total + (each * share) * (each * share)
        return (graph.apply("sqrt", total),)

    def names(self, plan: Plan) -> set[str]:
        return self.what.names(plan)

    def notes(self, plan: Plan) -> Notes:
        return self.what.notes(plan)

    def refuse(self, motion: MotionLike) -> None:
        self.what.refuse(motion)
        require_motion(motion).gradient(self.quantity, wrt=[name for name, _ in self.deviations])

    @property
    def may_fail(self) -> bool:
        return True

    @property
    def follows_angles(self) -> bool:
        return self.what.follows_angles

    def __str__(self) -> str:
        return f"the sigma of {self.what.sentence}"


def spread(
    machine: Mechanism,
    designs: Mapping[str, Any],
    quantity: RequestLike,
    tolerances: Mapping[str, ToleranceLike],
    strokes: Mapping[str, Any],
) -> FloatArray:
    """Return the standard deviation of a quantity at designs and strokes, shape (*designs, *strokes), from exact gradients.

    `spread(hitch, {"OB": array}, "tilt", {"OB": 0.1 * mm, "CD": 0.2 * mm}, {"S": array})` is one kernel call; NaN where the quantity or
    its gradient has no value. It is `evaluate([sigma(...)])` of these designs.
    """
    check_mechanism(machine)
    traced_number(machine.plan, quantity)
    for what, given in (("designs", designs), ("strokes", strokes)):
        if not isinstance(given, Mapping):
            raise DefinitionError(
                f"{machine.plan.title}: {what}={cited(given)}: a dictionary of {what} by name is expected, such as {{...: 0.1}}."
            )
    with unwarned(), np.errstate(all="ignore"):
        return machine.replaced(**designs).evaluate([sigma(quantity, tolerances)], unreachable="nan", **strokes)[0]
