"""How one pump's flow is shared among those who ask for it at one instant. Flows in m3/s, gauge pressures in Pa.

Each consumer asks for a flow at a pressure, its need, which is below zero where a load drives it. Those that are served together form a
group: all of a tier "by demand", those of equal need "least pressure first". Groups are served in their order, each with one share of
what it asks for; the first that gets less than all ends it. The pump's pressure is the highest need of those it feeds, with a margin.

What is decided on the way is written down, so that the same decisions can be taken again where numbers have changed a little: between two
events all that follows is smooth.
Source: the flow-sharing and load-sensing valves of mobile machines, as P. Chapple, Principles of Hydraulic Systems Design, has them.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Sequence
from math import inf
from operator import lt
from typing import Any, TypeVar

import numpy as np

from linkage.frozen import immutable

from .inputs import Array

Decided = TypeVar("Decided", bound=Hashable)
BY_DEMAND, LEAST_PRESSURE = "by demand", "least pressure first"
SHARINGS = (BY_DEMAND, LEAST_PRESSURE)
"""How a pump is shared."""
SAME_NEED = 1e-11
"""Of the cut-off: needs that differ by no more are one, to rounding."""


@immutable
class PumpLimits:
    """The limits of a pump: its greatest `flow` and `power` [W], the `margin` above the need and the `cut_off` [Pa].

    `least_first` says how it is shared.
    """

    flow: float
    power: float
    margin: float
    cut_off: float
    least_first: bool


@immutable
class FlowDemands:
    """The demands of consumers: flows and needs, those at their ends, and the tiers in which they are served.

    Flows and needs are numbers, or arrays over instants at which all is decided alike. Needs of `level` are one, as these consumers go on
    at one pressure; those that `creep` go on at the cut-off.
    """

    flows: Sequence[Array | float]
    needs: Sequence[Array | float]
    stopped: Sequence[bool]
    tiers: Sequence[int]
    level: frozenset[int] = frozenset()
    creep: frozenset[int] = frozenset()
    before: Array | float = 0.0
    """What those that creep take already."""


@immutable
class FlowSupply:
    """The supply of consumers: `shares` of their demands, 0 to 1, and the pump's `pressure`.

    `limit` is "flow" or "power" where they get less than all, `group` those that share the `rest` then. `blocked` are those that stand
    at their end, or need more than the cut-off.
    """

    shares: list[Array | float]
    pressure: Array | float
    limit: str
    group: tuple[int, ...]
    rest: Array | float
    blocked: tuple[int, ...]


class Choices:
    """Decisions of an algorithm, in order: made anew, or replayed as `made` before."""

    def __init__(self, made: Sequence[Hashable] | None = None) -> None:
        self._again = None if made is None else iter(made)
        self._found: list[Hashable] = []

    @property
    def made(self) -> tuple[Hashable, ...]:
        """The decisions so far."""
        return tuple(self._found)

    def __call__(self, decide: Callable[..., Decided], *given: Any) -> Decided:
        """Return a decision, made anew from the arguments or replayed."""
        found = decide(*given) if self._again is None else next(self._again)
        self._found.append(found)
        return found  # type: ignore[return-value]


def flow_shares(demands: FlowDemands, limits: PumpLimits, choose: Choices) -> FlowSupply:
    """Return each consumer's share of one pump."""
    count = len(demands.flows)
    same = SAME_NEED * limits.cut_off
    driven = choose(lambda: tuple(each <= same for each in demands.needs))
    needs: list[Any] = [0.0 if driven[i] else demands.needs[i] for i in range(count)]
    common = sum(needs[i] for i in demands.level) / max(len(demands.level), 1)
    needs = [common if i in demands.level else needs[i] for i in range(count)]
    most = limits.cut_off + same - limits.margin
    over = choose(lambda: tuple(i not in demands.creep and needs[i] > most for i in range(count)))
    blocked = tuple(i for i in range(count) if demands.stopped[i] or over[i] or i in demands.creep)
    groups = choose(serving_order, demands, needs, limits, blocked)
    shares: list[Array | float] = [0.0] * count
    given: Array | float = demands.before
    pressure: Array | float = limits.cut_off if blocked else limits.margin if groups else 0.0
    top = -1
    for group in groups:
        top = choose(leading, needs, [*group, *((top,) if top >= 0 else ())], same)
        level = limits.cut_off if blocked else needs[top] + limits.margin
        by_power = choose(lt, limits.power, limits.flow * level)
        total = sum(demands.flows[i] for i in group)
        whole = limits.power / level if by_power else limits.flow
        rest = whole - given
        outcome = choose(outcome_of, rest, total)
        if outcome == "none":  # the pump comes to the limit of its power before it comes to their need
            pressure = limits.power / given if by_power and not blocked else pressure
            return FlowSupply(shares, pressure, "power" if by_power else "flow", (), 0.0, blocked)
        pressure = level
        for i in group:
            shares[i] = 1.0 + 0.0 * total if outcome == "all" else rest / total
        if outcome == "part":
            return FlowSupply(shares, pressure, "power" if by_power else "flow", group, rest, blocked)
        given = given + total
    return FlowSupply(shares, pressure, "", (), 0.0, blocked)


def outcome_of(rest: float, total: float) -> str:
    """Return whether a group gets all that it asks for of a rest, part of it or none."""
    return "all" if rest >= total * (1.0 - SAME_NEED) else "part" if rest > 0.0 else "none"


def leading(needs: Sequence[Any], among: Sequence[int], same: float) -> int:
    """Return the first of those that need most, to rounding."""
    most = max(needs[i] for i in among)
    return min(i for i in among if needs[i] >= most - same)


def serving_order(demands: FlowDemands, needs: Sequence[Any], limits: PumpLimits, blocked: Sequence[int]) -> tuple[tuple[int, ...], ...]:
    """Return those that ask for something and are not blocked, in the groups and the order in which they are served."""
    found: list[tuple[int, ...]] = []
    for tier in sorted({*demands.tiers}):
        own = [i for i, each in enumerate(demands.tiers) if each == tier and i not in blocked and demands.flows[i] > 0.0]
        if not limits.least_first:
            found += [tuple(own)] if own else []
            continue
        last, first = -inf, len(found)
        for i in sorted(own, key=lambda i: (needs[i], i)):
            together = len(found) > first and needs[i] - last <= SAME_NEED * limits.cut_off
            found[-1:] = [(*found[-1], i)] if together else [*found[-1:], (i,)]
            last = needs[i]
    return tuple(tuple(sorted(each)) for each in found)


def level_shares(slopes: Array, own: Sequence[int], others: Array, flows: Array, rest: Array | float | None) -> Array | None:
    """Return the shares (c,) of some consumers by which their needs go on alike; None where nothing of it is settled.

    `slopes` (c, c) say how fast each need grows with each share, `others` (c,) how fast with all else. They take what is left, `rest`;
    without it their needs stay as they are, as at the cut-off.
    """
    ways = slopes[np.ix_(own, own)]
    if rest is None:
        system, right = ways, -others[list(own)]
    else:
        system = np.block([[ways, -np.ones((len(own), 1))], [flows[list(own)][None], np.zeros((1, 1))]])
        right = np.append(-others[list(own)], rest)
    scale = np.max(np.abs(system), axis=1, initial=0.0)
    if not np.all(scale > 0.0):
        return None
    try:
        return np.asarray(np.linalg.solve(system / scale[:, None], right / scale)[: len(own)])
    except np.linalg.LinAlgError:
        return None
