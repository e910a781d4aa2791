"""The gap between two bodies as they are drawn: bars by their centre lines, plates by the convex hull of their points, and points.

    A o-------o B     the gap is the least distance of any two places of the two bodies [m]: above zero where they are apart,
         | gap        below it by the least way that parts them where they cross
      o-----o

Two convex bodies are apart where some line across an edge of either has them on its two sides. The edges of all pairs of a body's points
are taken, those inside it too: they change nothing, and nobody has to know which points are outermost in which design.
Source: C. Ericson, Real-time collision detection (2005), 5.1 and 5.2.1 (separating axes).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import reduce
from itertools import combinations, product
from typing import TypeAlias

import numpy as np

from ..errors import DefinitionError, unknown
from ..loads import TwoPoint
from ..plan import Plan
from ..program import Node
from ..quantities import Reference, is_number, joined_names, name_of
from ..steps import Link
from ..vectors import Scalar, Vec
from .requests import NodeRequest

Pick: TypeAlias = Callable[[Scalar, Scalar, Scalar, Scalar], Scalar]
"""What gives its third number where the first is at most the second, else the fourth."""

SMALLEST = 1e-24
"""m2; the square of an edge that is no longer is taken as this, so that two points that coincide give no direction and no harm."""


def gap(a: Reference, b: Reference, *, width: float = 0.0) -> NodeRequest:
    """Return the request for the gap of two bodies as they are drawn [m]: `gap("EDF", "MK", width=0.06)`, `gap("G", "OBC")`.

    A body goes by its points (`"OBC"`), the name of its Link, that of a cylinder, a spring or another straight element, or of a point;
    `"frame"` is its fixed points, each for itself. Bars count by their centre lines and plates by the convex hull of their points, less
    the `width` [m], the sum of their half widths. Where two bodies cross it is negative: the least way that parts them. Outlines that
    steps draw of themselves do not count. DefinitionError for two bodies that share a pin.
    """
    if not is_number(width) or width < 0.0:
        raise DefinitionError(f"gap(width={width!r}): the sum of the half widths is expected [m], zero or more.")
    one, other = name_of(a), name_of(b)

    def nodes(plan: Plan) -> tuple[Node, ...]:
        where, frame = plan.trace, plan.links[0].name
        of_one, of_other = (
            [[each] for each in points] if name == frame else [points]  # the frame is its points, each for itself
            for name, points in zip((one, other), two_shapes(plan, one, other), strict=True)
        )
        gaps = [signed_gap([where.at(P) for P in p], [where.at(Q) for Q in q], where.graph.pick) for p, q in product(of_one, of_other)]
        return (where.graph.node(least_number(gaps) - float(width)),)

    return NodeRequest(
        text=f"gap({one}, {other}{f', width={width:g}' if width else ''})", sentence=f"the gap between {one} and {other}",
        key=("gap", one, other, float(width)), measures="length", may_fail=True,
        nodes_of=nodes, names_of=lambda plan: plan.reaches(*(name for points in two_shapes(plan, one, other) for name in points)),
    )  # fmt: skip


def two_shapes(plan: Plan, a: str, b: str) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return the points of two bodies or points by their names; DefinitionError where they share one."""
    of_a, of_b = shape_of(plan, a), shape_of(plan, b)
    shared = [name for name in of_a if name in of_b]
    if shared:
        what = f"{plan.title}: gap({a}, {b}): both have {', '.join(shared)}, so that there is no gap between them"
        first, body, rest = (b, a, of_b) if b == plan.links[0].name else (a, b, of_a)
        free = next((each for each in rest if each not in shared), first)
        raise DefinitionError(f"{what}; ask for that of a point, such as gap({free}, {body}).")
    return of_a, of_b


def shape_of(plan: Plan, name: str) -> tuple[str, ...]:
    """Return the points of a body, a straight element or a point by its name; DefinitionError for any other."""
    known: dict[str, tuple[str, ...]] = {body.name: body.points for body in plan.links}
    known |= {joined_names(bar.P, bar.Q): (bar.P, bar.Q) for bar in plan.cylinders}
    known |= {each: element.ends for each, element in plan.of_kind(TwoPoint).items()}
    for each, link in plan.of_kind(Link).items():
        known[each] = next((body.points for body in plan.links if set(link.point_names) <= set(body.points)), link.point_names)
    known |= {each: (each,) for each in plan.points}
    points = set(name.split())
    found = [body.points for body in plan.links if len(points) > 1 and points <= set(body.points)]
    if name not in known and len(found) == 1:
        return found[0]
    if name not in known:
        raise unknown("Body", name, known, where=plan.title)
    return known[name]


def signed_gap(a: Sequence[Vec], b: Sequence[Vec], pick: Pick) -> Scalar:
    """Return the least distance of the convex hulls of some points [m], below zero by the least way that parts them."""
    edges = [[(P, Q) for P, Q in combinations(points, 2)] for points in (a, b)]
    if not any(edges):
        return np.sqrt((a[0] - b[0]).square())
    squares = [square_to_edge(P, edge) for points, own in ((a, edges[1]), (b, edges[0])) for P in points for edge in own]
    ways = [(start - end).left() for own in edges for start, end in own]
    ways += [own[0][1] - own[0][0] for own in edges if own]  # bars in line are parted along it
    overlap = reduce(np.maximum, [separation(a, b, way) for way in ways])
    return pick(overlap, 0.0, overlap, np.sqrt(least_number(squares)))


def square_to_edge(P: Vec, edge: tuple[Vec, Vec]) -> Scalar:
    """Return the square of a point's distance from a straight edge [m2]."""
    start, along, arm = edge[0], edge[1] - edge[0], P - edge[0]
    share = np.minimum(np.maximum(arm.dot(along) / np.maximum(along.square(), SMALLEST), 0.0), 1.0)
    return (P - (start + along * share)).square()


def separation(a: Sequence[Vec], b: Sequence[Vec], way: Vec) -> Scalar:
    """Return how far two sets of points are apart along a direction [m], below zero where they overlap."""
    (low_a, high_a), (low_b, high_b) = (
        (least_number(found), reduce(np.maximum, found)) for found in ([way.dot(P - a[0]) for P in points] for points in (a, b))
    )
    return np.maximum(low_b - high_a, low_a - high_b) / np.sqrt(np.maximum(way.square(), SMALLEST))


def least_number(values: Sequence[Scalar]) -> Scalar:
    """Return the least of some numbers, pose by pose."""
    return reduce(np.minimum, values)
