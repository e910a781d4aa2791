"""The gap between two bodies as they are drawn: bars by their centre lines, plates by the convex hull of their points, and points.

    A o-------o B     the gap is the least distance of any two places of the two bodies [m]: above zero where they are apart,
         | gap        below it by the least way that parts them where they cross
      o-----o

Two convex bodies are apart where some line across an edge of either has them on its two sides. The edges of all pairs of a body's points
are taken, those inside it too: they change nothing, and nobody has to know which points are outermost in which design.
Source: C. Ericson, Real-time collision detection (2005), 5.1 and 5.2.1 (separating axes).
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass
from functools import reduce
from itertools import combinations, product
from typing import TypeAlias, final

import numpy as np

from ..errors import DefinitionError, unknown
from ..loads import TwoPoint
from ..plan import Plan
from ..program import FloatArray, Node
from ..quantities import Reference, is_number, name_of
from ..steps import Link
from ..vectors import Scalar, Vec
from .conditions import Left
from .requests import BoundRequest, Request

Pick: TypeAlias = Callable[[Scalar, Scalar, Scalar, Scalar], Scalar]
"""What gives its third number where the first is at most the second, else the fourth."""

SMALLEST = 1e-24
"""m2; the square of an edge that is no longer is taken as this, so that two points that coincide give no direction and no harm."""


@final
@dataclass(frozen=True)
class Gap(Request):
    """The gap of two bodies or points, less a width [m]."""

    a: str
    b: str
    width: float = 0.0

    def identity(self, plan: Plan) -> Hashable:
        return "gap", self.a, self.b, self.width

    @property
    def measures(self) -> str:
        return "length"

    def bound(self, plan: Plan) -> GapOf:
        a, b = (shape_of(plan, each) for each in (self.a, self.b))
        shared = [name for name in a if name in b]
        if shared:
            what = f"{plan.title}: gap({self.a}, {self.b}): both have {', '.join(shared)}, so that there is no gap between them"
            first, body, rest = (self.b, self.a, b) if self.b == plan.links[0].name else (self.a, self.b, a)
            free = next((each for each in rest if each not in shared), first)
            raise DefinitionError(f"{what}; ask for that of a point, such as gap({free}, {body}).")
        return GapOf(self.a, self.b, a, b, self.width, self.b == plan.links[0].name, self.a == plan.links[0].name)

    def __str__(self) -> str:
        return f"gap({self.a}, {self.b}{f', width={self.width:g}' if self.width else ''})"


def gap(a: Reference, b: Reference, *, width: float = 0.0) -> Gap:
    """Return the request for the gap of two bodies as they are drawn [m]: `gap("EDF", "MK", width=0.06)`, `gap("G", "OBC")`.

    A body goes by its points (`"OBC"`), the name of its Link, that of a cylinder, a spring or another straight element, or of a point;
    `"frame"` is its fixed points, each for itself. Bars count by their centre lines and plates by the convex hull of their points, less
    the `width` [m], the sum of their half widths. Where two bodies cross it is negative: the least way that parts them. Outlines that
    steps draw of themselves do not count. DefinitionError for two bodies that share a pin.
    """
    if not is_number(width) or width < 0.0:
        raise DefinitionError(f"gap(width={width!r}): the sum of the half widths is expected [m], zero or more.")
    return Gap(name_of(a), name_of(b), float(width))


def shape_of(plan: Plan, name: str) -> tuple[str, ...]:
    """Return the points of a body, a straight element or a point by its name; DefinitionError for any other."""
    known: dict[str, tuple[str, ...]] = {body.name: body.points for body in plan.links}
    known |= {"".join((bar.P, bar.Q)): (bar.P, bar.Q) for bar in plan.cylinders}
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


@final
@dataclass(frozen=True)
class GapOf(BoundRequest):
    """The gap of two bodies of a plan, by their names and points; a body that is `apart` is its points, each for itself."""

    a: str
    b: str
    points_a: tuple[str, ...]
    points_b: tuple[str, ...]
    width: float
    b_apart: bool = False
    a_apart: bool = False

    @property
    def key(self) -> Hashable:
        return "gap", self.points_a, self.points_b, self.a_apart, self.b_apart, self.width

    def nodes(self, plan: Plan) -> tuple[Node, ...]:
        where = plan.trace
        pieces_a, pieces_b = (
            [[name] for name in points] if apart else [points]
            for points, apart in ((self.points_a, self.a_apart), (self.points_b, self.b_apart))
        )
        gaps = [signed_gap([where.at(P) for P in a], [where.at(Q) for Q in b], where.graph.pick) for a, b in product(pieces_a, pieces_b)]
        return (where.graph.node(least_number(gaps) - self.width),)

    def names(self, plan: Plan) -> set[str]:
        return plan.reaches(*self.points_a, *self.points_b)

    @property
    def may_fail(self) -> bool:
        return True

    def scale(self, plan: Plan, left: Left) -> FloatArray:
        return left.size

    def __str__(self) -> str:
        return f"the gap between {self.a} and {self.b}"


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
