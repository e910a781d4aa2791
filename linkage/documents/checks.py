"""Checks of the numbers: each with its measured figure and its bound, by another way than the calculation's."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from itertools import pairwise
from typing import Any

import numpy as np

from ..errors import LinkageError, unwarned
from ..frozen import record
from ..language import said
from ..motion import Motion
from ..quantities import Dimension, Quantity, Stroke, angle, distance
from .content import Mark, Section, TableBlock
from .run import ReportSubject, largest

EXACT = 1e-9
"""The bound of what rounding alone may leave, relative."""
NUMERIC = 1e-6
"""The bound of a comparison with numerical derivatives, relative."""


@record
class Check:
    """A check: its name, its comparison, the largest relative difference found, its bound; NaN where it could not be made."""

    name: str
    what: str
    measured: float
    bound: float

    @property
    def ok(self) -> bool | None:
        """Whether the bound is kept; None where nothing was measured."""
        return None if np.isnan(self.measured) else self.measured <= self.bound


def checks_section(subject: ReportSubject, values: Mapping[str, object]) -> Section:
    """Return the section of checks."""
    found = checks(subject, values)
    silent = said("not made")
    rows = ((each.name, each.what, figure_text(each.measured), figure_text(each.bound), Mark.of(each.ok, silent)) for each in found)
    heads = (said("check"), said("what is compared"), said("measured"), said("bound"), said("result"))
    table = TableBlock(said("Largest relative differences over the poses of the table"), heads, tuple(rows), "lmrrl")
    return Section(said("Checks of the calculation"), (table,))


def figure_text(value: float) -> str:
    """Return a relative difference as text."""
    return "–" if np.isnan(value) else f"{value:.1e}" if value else "0"


def checks(subject: ReportSubject, values: Mapping[str, Any]) -> list[Check]:
    """Return all checks of a design along its run; `values` are those of its equations, by name."""
    with unwarned():
        found = [*positions_kept(subject.table)]
        pose = subject.machine.at(unreachable="nan", **subject.pose)
        worst, size = 0.0, max((float(np.abs(pose[name]).max()) for name in pose.plan.points), default=1.0) or 1.0
        points = [name for name in pose.plan.moving if name in values and name in pose.plan.points]
        for name in points:
            worst = max(worst, float(np.abs(np.array([float(each) for each in values[name]]) - pose[name]).max()) / size)
        for name, member in pose.plan.of_kind(Quantity).items():
            if name in values and not isinstance(member, (Stroke, Dimension)):
                own = float(pose[name])
                worst = max(worst, abs(float(values[name]) - own) / max(abs(own), 1.0))
        what = said("the equations above with 30 digits, against the positions and outputs of the program")
        found.append(Check(said("equations evaluated again"), what, worst if points else np.nan, EXACT))
        found.append(derivatives(subject))
        try:
            forces = subject.forces
        except LinkageError:
            return found
    if any(one.joints for one in forces):
        what = said("forces and moments on every body, over the largest force")
        found.append(Check(said("equilibrium"), what, max(one.residual for one in forces), EXACT))
        gaps = [one.gap for one in forces if not np.isnan(one.gap)]
        what = said("driving forces by equilibrium of the bodies, against those by virtual work")
        found.append(Check(said("virtual work"), what, max(gaps, default=np.nan), EXACT))
    return found


# -- positions ---------------------------------------------------------------------------------------------


def positions_kept(motion: Motion) -> Iterator[Check]:
    """Yield how well the distances of the placed pins are the lengths that were given, and how well these close their loops."""
    lengths = motion.plan.table.lengths
    # each link as its given length in the direction that it has
    given: dict[frozenset[str], Quantity] = dict(lengths)
    given |= {frozenset(pair): distance(*pair) for pair in pairwise(motion.plan.ground) if frozenset(pair) not in given}
    loops = [[*pairwise([*loop, loop[0]])] for loop in closed_walks((P, Q) for P, Q in (sorted(pair) for pair in given if len(pair) == 2))]
    motion._work_out([*given.values(), *(distance(*sorted(pair)) for pair in lengths), *(angle(*side) for loop in loops for side in loop)])
    worst, longest = 0.0 if lengths else np.nan, 0.0
    for pair, quantity in lengths.items():
        length = np.broadcast_to(motion.value(quantity), motion.shape)
        worst = max(worst, largest(motion.distance(*sorted(pair)) - length))
        longest = max(longest, largest(length))
    what = said("distances of the pins as placed, against the given lengths: {n} of them", n=len(lengths))
    yield Check(said("lengths kept"), what, worst / (longest or 1.0), EXACT)

    worst, longest = 0.0, 0.0
    for loop in loops:
        vectors = []
        for side in loop:
            way = motion.angle(*side)
            vectors.append(np.asarray(motion.value(given[frozenset(side)]) * np.array([np.cos(way), np.sin(way)])))
        worst = max(worst, largest(np.hypot(*np.sum(vectors, axis=0))))
        longest = max(longest, *(largest(np.hypot(*each)) for each in vectors))
    if loops:
        what = said("given lengths in the directions of the links, summed round the closed loops: {n} of them", n=len(loops))
        yield Check(said("loops closed"), what, worst / (longest or 1.0), EXACT)


def closed_walks(pairs: Iterable[tuple[str, str]]) -> Iterator[list[str]]:
    """Yield the points of a loop for each pair that pairs before it join already."""
    tree: dict[str, list[str]] = {}
    for P, Q in pairs:
        before, ahead = {P: P}, [P]
        while ahead and Q not in before:
            here = ahead.pop()
            further = [each for each in tree.get(here, ()) if each != before[here]]
            before |= dict.fromkeys(further, here)
            ahead += further
        if Q in before:
            walk = [Q]
            while walk[-1] != P:
                walk.append(before[walk[-1]])
            yield walk
        else:
            tree.setdefault(P, []).append(Q)
            tree.setdefault(Q, []).append(P)


def derivatives(subject: ReportSubject) -> Check:
    """Return how far exact transfer ratios are from central differences, over their largest value."""
    motion, stroke = subject.table, subject.stroke
    outputs = [name for name, each in motion.plan.of_kind(Quantity).items() if not isinstance(each, (Stroke, Dimension))]
    found: list[tuple[float, float]] = []
    for name in (*motion.plan.moving, *outputs):
        try:
            exact, central = (motion.ratio(name, wrt=stroke, method=way) for way in ("exact", "central"))
        except LinkageError:
            continue
        found.append((largest(exact - central), largest(exact)))
    far = max((size for _, size in found), default=0.0) or 1.0  # what does not move at all is compared with what does
    worst, targets = max((miss / (size if size > 1e-6 * far else far) for miss, size in found), default=0.0), len(found)
    what = said(
        "exact transfer ratios of points and outputs by {stroke}, against central differences: {n} of them", stroke=stroke, n=targets
    )
    return Check(said("transfer ratios"), what, worst if targets else np.nan, NUMERIC)
