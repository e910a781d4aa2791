"""Four-bars and their Grashof class: which links can turn fully round."""

from __future__ import annotations

from collections.abc import Mapping

from ..frozen import record
from ..plan import Plan, Reading
from ..units import require_number
from ..vectors import Numbers

EQUAL = 1e-9


@record
class FourBar:
    """A four-bar of a mechanism: its pins frame, crank, coupler, follower end, and its lengths [m]."""

    pins: tuple[str, str, str, str]
    ground: float
    crank: float
    coupler: float
    follower: float

    @property
    def lengths(self) -> tuple[float, float, float, float]:
        """Its four lengths [m]."""
        return self.ground, self.crank, self.coupler, self.follower

    @property
    def margin(self) -> float:
        """By how much the shortest and the longest link are together shorter than the other two [m]; nothing at a change point."""
        return sum(self.lengths) - 2.0 * (min(self.lengths) + max(self.lengths))

    @property
    def kind(self) -> str:
        """The Grashof class in words."""
        return grashof(self.ground, self.crank, self.coupler, self.follower)

    def __str__(self) -> str:
        return f"four-bar {'-'.join(self.pins)}: {self.kind}"


def grashof(ground: float, crank: float, coupler: float, follower: float) -> str:
    """Return the kind of a four-bar by Grashof's rule, from the lengths of its links [m].

    Shortest plus longest less than the other two: a link turns fully; which one, tells the frame. Equal: a change
    point. More: a triple rocker. Source: Grashof 1883; Barker's names in brackets.

    Parameters
    ----------
    ground : float
        The frame's length [m].
    crank : float
        The crank's length [m].
    coupler : float
        The coupler's length [m].
    follower : float
        The follower's length [m].

    Returns
    -------
    str
        The kind in words.
    """
    lengths = {"ground": ground, "crank": crank, "coupler": coupler, "follower": follower}
    for name, length in lengths.items():
        require_number(f"grashof: {name}", length, "a positive number of metres is expected", above=0.0, kind="length")
    shortest, longest = min(lengths.values()), max(lengths.values())
    if 2.0 * longest >= sum(lengths.values()):
        return "cannot be assembled: the longest link is as long as the other three"
    excess = 2.0 * (shortest + longest) - sum(lengths.values())
    if abs(excess) <= EQUAL * longest:
        return "change point (Grashof, s + l = p + q)"
    if excess > 0.0:
        return "triple rocker (non-Grashof)"
    kinds = {
        "ground": "double crank (drag link, Grashof)",
        "crank": "crank rocker (Grashof)",
        "coupler": "double rocker (Grashof)",
        "follower": "rocker crank (Grashof)",
    }
    return kinds[min(lengths, key=lambda name: lengths[name])]


def four_bars(plan: Plan, inputs: Mapping[str, Numbers]) -> list[FourBar]:
    """Return the four-bars whose frame link is fixed: a dyad on a fixed point and on the end of a link that hangs on another."""
    reading = Reading(plan.members, plan.table.lengths, inputs)
    rigid = [(bar.P, bar.Q) for bar in plan.rods]
    found = []
    hung = {name: [bar.P for bar in point.bars()] for name, point in plan.points.items()}
    for name, ends in hung.items():
        for Q, P in (ends[::-1], ends) if len(ends) == 2 else ():
            frames = [a if b == P else b for a, b in rigid if P in (a, b) and ({a, b} - {P}) & (set(plan.ground) - {Q})]
            if Q in plan.ground and frames and {(P, name), (Q, name)} <= set(rigid):
                O = frames[0]
                sides = [float(reading.link_length(*pair)) for pair in ((O, Q), (O, P), (P, name), (Q, name))]
                found.append(FourBar((O, P, name, Q), *sides))
    return found
