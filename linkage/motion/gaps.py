"""The gap between two bodies as they are drawn: bars by their centre lines, plates by the convex hull of their points, and points.

    A o-------o B     the gap is the least distance of any two places of the two bodies [m]: above zero where they are apart,
         | gap        below it by the least way that parts them where they cross
      o-----o

Two convex bodies are apart where some line across an edge of either has them on its two sides. The edges of all pairs of a body's points
are taken, those inside it too: they change nothing, and nobody has to know which points are outermost in which design. An outline is cut
into convex pieces as it is declared; the gap is then the least of those of all pairs of pieces.
Source: C. Ericson, Real-time collision detection (2005), 5.1 and 5.2.1 (separating axes).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from functools import reduce
from itertools import combinations, pairwise, product
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

from ..errors import DefinitionError, ensure, unknown
from ..frozen import immutable, record
from ..loads import TwoPoint
from ..numeric import Corners, convex_pieces, crosses_itself, signed_area
from ..plan import Plan, Reading
from ..program import Node
from ..quantities import Member, Reference, joined_names, name_of
from ..steps import Link
from ..surroundings import CircleOutline, Outline, numbers_at
from ..units import require_number
from ..vectors import Scalar, Vec, pick
from .requests import MotionLike, NodeRequest, Trait

Pick: TypeAlias = Callable[[Scalar, Scalar, Scalar, Scalar], Scalar]
"""What gives its third number where the first is at most the second, else the fourth."""
Triangle: TypeAlias = tuple[Vec, Vec, Vec]

ROUNDED = 1e-9
"""The part of an outline's area that rounding may take or give."""
FAR = 1e12
"""m2: more than any cut is long."""
SMALLEST = 1e-24
"""m2; the square of an edge that is no longer is taken as this, so that two points that coincide give no direction and no harm."""


def gap(a: Reference, b: Reference, *, width: float = 0.0) -> NodeRequest:
    """Return the request for the gap of two bodies as they are drawn [m]: `gap("EDF", "MK", width=0.06)`, `gap("G", "OBC")`.

    A body goes by its points (`"OBC"`), the name of its Link, that of a cylinder, a spring or another straight element, or of a point;
    `"frame"` is its fixed points, each for itself. Bars count by their centre lines and plates by the convex hull of their points, less
    the `width` [m], the sum of their half widths. Where two bodies cross it is negative: the least way that parts them. An outline
    goes by its name, with all its corners; two outlines may belong to bodies that share a pin. What steps draw of themselves does not
    count. DefinitionError for two bodies that share a pin, and for an outline that is open.

    Parameters
    ----------
    a : str or Member
        The first body.
    b : str or Member
        The second body.
    width : float
        The sum of the half widths [m].

    Returns
    -------
    Request
        The gap [m], negative where they cross.

    Raises
    ------
    DefinitionError
        The bodies share a pin, or an outline is open.
    """
    require_number("gap(width", width, "the sum of the half widths is expected [m], zero or more", least=0.0, kind="length")
    one, other = name_of(a), name_of(b)

    def nodes(plan: Plan) -> tuple[Node, ...]:
        found = gap_in(plan, plan.trace, plan.trace.graph.pick, one, other)
        return (plan.trace.graph.node(found - float(width)),)

    def names(plan: Plan) -> set[str]:
        return plan.reaches(*(name for shape in two_shapes(plan, one, other) for name in shape.parts_behind))

    return NodeRequest(
        text=f"gap({one}, {other}{f', width={width:g}' if width else ''})", sentence=f"the gap between {one} and {other}",
        key=("gap", one, other, float(width)), measures="length", traits=Trait.MAY_FAIL,
        nodes_of=nodes, names_of=names,
        refused_by=lambda motion: check_forms(motion, (one, other)),
    )  # fmt: skip


def check_forms(motion: MotionLike, names: Iterable[str]) -> None:
    """Raise DefinitionError for an outline that crosses itself in a motion's design; of a batch in one of its designs."""
    plan = motion.plan
    for name, outline in plan.of_kind(Outline).items():
        if name in names and follows_dimensions(outline):
            values = np.broadcast_arrays(*(motion.value(value) for corner in outline.points for value in corner))
            forms = np.unique(np.reshape(values, (len(values), -1)), axis=1).T.reshape(-1, len(outline.points), 2)
            for corners in forms:
                if crosses_itself(corners) or not convex_pieces(corners):
                    what = f"{plan.title}: {name} = {outline}: it crosses itself or encloses nothing in this design"
                    raise DefinitionError(f"{what}; correct the dimensions that its corners follow.", member=name)


@record
class Piece:
    """A convex piece of a shape: its corners in order, or points of which the outermost count, and how far it is rounded out [m]."""

    places: tuple[Vec, ...]
    in_order: bool = False
    radius: Scalar = 0.0
    counts: Scalar | None = None
    """Zero or more where it is a piece in this design; None where it always is."""

    @property
    def is_one(self) -> bool:
        """Whether it is a piece at the one pose of a reading on numbers."""
        return self.counts is None or float(self.counts) >= 0.0

    @property
    def edges(self) -> list[tuple[Vec, Vec]]:
        """Its edges; of points that stand in no order those of all pairs."""
        if self.in_order and len(self.places) > 2:
            return list(pairwise((*self.places, self.places[0])))
        return list(combinations(self.places, 2))


@record
class BodyShape:
    """The shape of a body: its points, each for itself in the frame, or an outline."""

    points: tuple[str, ...]
    each_alone: bool = False
    outline: Outline | None = None

    @property
    def parts_behind(self) -> tuple[Member | str, ...]:
        """The members it is built from."""
        return self.points if self.outline is None else (self.outline, *self.points)

    def pieces(self, plan: Plan, where: Reading, pick: Pick) -> list[Piece]:
        """Return its convex pieces in a reading, such as the plan's trace."""
        if self.outline is not None:
            return outline_pieces(plan, self.outline, where, pick)
        if self.each_alone:
            return [Piece((where.at(P),)) for P in self.points]
        return [Piece(tuple(where.at(P) for P in self.points))]


def gap_in(plan: Plan, where: Reading, pick: Pick, a: str, b: str) -> Scalar:
    """Return the gap of two bodies or outlines in a reading [m], such as on arrays, where nothing is compiled."""
    shapes, gaps = two_shapes(plan, a, b), list[Scalar]()
    for one, other in product(*(each.pieces(plan, where, pick) for each in shapes)):
        p, q, edges, rounded = one.places, other.places, [one.edges, other.edges], one.radius + other.radius
        if any(edges):  # the least distance, below zero by the least way that parts them
            pairs = [(P, edge) for points, own in ((p, edges[1]), (q, edges[0])) for P in points for edge in own]
            squares = [(P - nearest_on(edge, P)).square() for P, edge in pairs]
            overlap = reduce(np.maximum, [separation(p, q, way) for own in edges for way in ways_across(own)])
            found = pick(overlap, 0.0, overlap, np.sqrt(least_number(squares))) - rounded
        else:
            found = np.sqrt((p[0] - q[0]).square()) - rounded
        counts = [each.counts for each in (one, other) if each.counts is not None]
        gaps.append(pick(0.0, least_number(counts), found, FAR) if counts else found)  # more than any gap where one is none in a design
    least = least_number(gaps)
    follow = any(each.outline is not None and follows_dimensions(each.outline) for each in shapes)
    return pick(FAR, least, np.nan, least) if follow else least  # no piece at all: an outline crosses itself


def follows_dimensions(outline: Outline) -> bool:
    """Return whether the form of an outline hangs on dimensions."""
    return hasattr(outline, "points") and any(not value.is_constant for corner in outline.points for value in corner)


def outline_pieces(plan: Plan, outline: Outline, where: Reading, pick: Pick) -> list[Piece]:
    """Return the convex pieces of an outline in a reading: as in the class's own design, and anew where these do not hold in another."""
    carriers = outline.carriers

    def place(x: Scalar, y: Scalar) -> Vec:
        if len(carriers) < 2:
            own = Vec(x, y)
            return where.at(carriers[0]) + own if carriers else own
        P, Q = carriers
        along = (where.at(Q) - where.at(P)) * (1.0 / where.link_length(P, Q))
        found: Vec = where.at(P) + (along * x + along.left() * y)
        return found

    if isinstance(outline, CircleOutline):
        centre = tuple(where.value(each) for each in outline.centre) or (0.0, 0.0)
        return [Piece((place(*centre),), radius=where.value(outline.radius))]
    own = [Vec(where.value(x), where.value(y)) for x, y in outline.points]
    corners, numbers = [place(each.x, each.y) for each in own], corner_pieces(plan, outline)
    if not follows_dimensions(outline):
        return [Piece(tuple(corners[each] for each in piece), in_order=True) for piece in numbers]
    sound = how_sound(own, numbers, 1.0 if signed_area(class_corners(plan, outline)) > 0.0 else -1.0, pick)
    anew, can_be_cut = triangles(own, pick)
    instead = pick(0.0, sound, -1.0, can_be_cut)
    return [
        *(Piece(tuple(corners[each] for each in piece), in_order=True, counts=sound) for piece in numbers),
        *(Piece(tuple(place(each.x, each.y) for each in piece), in_order=True, counts=instead) for piece in anew),
    ]


def class_corners(plan: Plan, outline: Outline) -> Corners:
    """Return the corners of an outline in the class's own design, shape (n, 2) [m]."""
    reading = Reading(plan.members, plan.table.lengths, plan.defaults)
    return numbers_at(outline.points, lambda each: float(reading.value(each)))


def corner_pieces(plan: Plan, outline: Outline) -> tuple[tuple[int, ...], ...]:
    """Return the convex pieces of an outline by the numbers of its corners; DefinitionError for one that has no inside."""
    if not outline.closed or not hasattr(outline, "points"):
        what = f"{plan.title}: {outline.name} = {outline}: it is open, or lines of a file, and has no inside"
        raise DefinitionError(f"{what}; give the corners of a closed one, Outline([(0, 0), (0.9, 0), (0.5, 0.6)], on=...).")
    corners = class_corners(plan, outline)
    pieces = () if crosses_itself(corners) else convex_pieces(corners)
    ensure(pieces, f"{plan.title}: {outline.name} = {outline}: it crosses itself or encloses nothing; correct its corners.")
    return pieces


def two_shapes(plan: Plan, a: str, b: str) -> tuple[BodyShape, BodyShape]:
    """Return the shapes of two bodies, points or outlines by their names; DefinitionError for bodies that share a point."""
    one, other = shape_named(plan, a), shape_named(plan, b)
    if one.outline is None and other.outline is None:
        shared = [name for name in one.points if name in other.points]
        if shared:
            what = f"{plan.title}: gap({a}, {b}): both have {', '.join(shared)}, so that there is no gap between them"
            first, second, rest = (b, a, other.points) if b == plan.bodies[0].name else (a, b, one.points)
            free = next((each for each in rest if each not in shared), first)
            raise DefinitionError(f"{what}; ask for that of a point, such as gap({free}, {second}), or of outlines on both.")
    elif one == other:
        raise DefinitionError(f"{plan.title}: gap({a}, {b}): this is one outline; name two.")
    elif one.outline is None or other.outline is None:
        outline, body = (one, other) if other.outline is None else (other, one)
        pair, home = set(outline.points), body_points_of(plan, outline)
        if len(pair) and set(body.points) <= home and not body.each_alone:
            raise DefinitionError(f"{plan.title}: gap({a}, {b}): the outline is fixed to that body; name another one.")
    return one, other


def body_points_of(plan: Plan, shape: BodyShape) -> set[str]:
    """Return the points of the body that carries an outline."""
    carriers = set(shape.points)
    return next((set(body.points) for body in plan.bodies if carriers and carriers <= set(body.points)), carriers)


def shape_named(plan: Plan, name: str) -> BodyShape:
    """Return the shape of a body, a straight element, a point or an outline by its name; DefinitionError for any other."""
    outline = plan.of_kind(Outline).get(name)
    if outline is not None:
        return BodyShape(outline.carriers, outline=outline)
    known: dict[str, tuple[str, ...]] = {body.name: body.points for body in plan.bodies}
    known |= {joined_names(bar.P, bar.Q): (bar.P, bar.Q) for bar in plan.cylinders}
    known |= {each: element.ends for each, element in plan.of_kind(TwoPoint).items()}
    for each, link in plan.of_kind(Link).items():
        known[each] = next((body.points for body in plan.bodies if set(link.point_names) <= set(body.points)), link.point_names)
    known |= {each: (each,) for each in plan.points}
    points = set(name.split())
    found = [body.points for body in plan.bodies if len(points) > 1 and points <= set(body.points)]
    if name not in known and len(found) != 1:
        raise unknown("Body", name, [*known, *plan.of_kind(Outline)], where=plan.title)
    return BodyShape(known.get(name, found[0] if found else ()), each_alone=name == plan.bodies[0].name)


def ways_across(edges: Sequence[tuple[Vec, Vec]]) -> list[Vec]:
    """Return the directions along which two pieces may be parted for the edges of one of them: bars in line are parted along it."""
    return [*((start - end).left() for start, end in edges), *(end - start for start, end in edges[:1])]


def nearest_on(edge: tuple[Vec, Vec], P: Vec) -> Vec:
    """Return the place of a straight edge that is nearest to a point."""
    start, along, arm = edge[0], edge[1] - edge[0], P - edge[0]
    found: Vec = start + along * np.minimum(np.maximum(arm.dot(along) / np.maximum(along.square(), SMALLEST), 0.0), 1.0)
    return found


def separation(a: Sequence[Vec], b: Sequence[Vec], way: Vec) -> Scalar:
    """Return how far two sets of points are apart along a direction [m], below zero where they overlap."""
    (low_a, high_a), (low_b, high_b) = (
        (least_number(found), reduce(np.maximum, found)) for found in ([way.dot(P - a[0]) for P in points] for points in (a, b))
    )
    return np.maximum(low_b - high_a, low_a - high_b) / np.sqrt(np.maximum(way.square(), SMALLEST))


def least_number(values: Sequence[Scalar]) -> Scalar:
    """Return the least of some numbers, pose by pose."""
    return reduce(np.minimum, values)


# An outline whose corners follow dimensions, cut into convex pieces in the program: as its class is where that holds, else anew.
#
# Which corners make up a piece hangs on the design. Where the pieces of the class's own design stay convex and still make up the whole,
# they count; elsewhere the triangles do that ears leave which are cut off one after the other, that with the shortest cut first.


def doubled_turn(a: Vec, b: Vec, c: Vec) -> Scalar:
    """Return twice the area of three corners, above zero where they go round counter-clockwise [m2]."""
    return (b - a).cross(c - a)


def doubled_area(corners: Sequence[Vec]) -> Scalar:
    """Return twice the area of a closed line, above zero where it goes round counter-clockwise [m2]."""
    start = corners[0]
    return sum(((b - start).cross(c - start) for b, c in pairwise(corners[1:])), 0.0 * start.x)


def how_sound(corners: Sequence[Vec], pieces: Sequence[Sequence[int]], class_sense: float, pick: Pick) -> Scalar:
    """Return a number that is zero or more where pieces, by the numbers of their corners, are convex and make up the whole of a line."""
    whole = doubled_area(corners)
    sense = pick(0.0, whole, class_sense, -class_sense)
    size = np.abs(whole)
    turns, areas = [], []
    for piece in pieces:
        places = [corners[each] for each in piece]
        around = [*places, *places[:2]]
        turns += [doubled_turn(a, b, c) for a, b, c in zip(around, around[1:], around[2:], strict=False)]
        turns += [doubled_turn(places[0], b, c) for b, c in pairwise(places[1:])]
        areas.append(doubled_area(places))
    least_turn = reduce(np.minimum, [each * sense for each in turns])
    missed = np.abs(sum(areas[1:], areas[0]) * sense - size)
    return np.minimum(least_turn + ROUNDED * size, ROUNDED * size - missed)


def triangles(corners: Sequence[Vec], pick: Pick) -> tuple[list[Triangle], Scalar]:
    """Return the triangles that a closed line is cut into, and a number above zero where it can be cut: where it does not cross itself."""
    order, found = list(corners), list[Triangle]()
    whole = doubled_area(corners)
    sense, sound = pick(0.0, whole, 1.0, -1.0), np.abs(whole)
    least_room = ROUNDED * sound
    while len(order) > 3:
        count = len(order)
        around = [(order[place - 1], order[place], order[(place + 1) % count]) for place in range(count)]
        rooms = [ear_room(order, place, sense) for place in range(count)]
        costs = [pick(room, least_room, FAR, (c - a).square()) for room, (a, _, c) in zip(rooms, around, strict=True)]
        best, which, ear = costs[0], 0.0 * costs[0], around[0]
        for place in range(1, count):
            which = pick(best, costs[place], which, float(place))
            ear = tuple(chosen(best, costs[place], one, other, pick) for one, other in zip(ear, around[place], strict=True))  # type: ignore[assignment]
            best = np.minimum(best, costs[place])
        found.append(ear)
        sound = np.minimum(sound, 0.5 * FAR - best)
        order = [chosen(which, float(place), order[place + 1], order[place], pick) for place in range(count - 1)]
    last = (order[0], order[1], order[2])
    return [*found, last], np.minimum(sound, doubled_turn(*last) * sense + least_room)


def chosen(a: Scalar, b: Scalar, one: Vec, other: Vec, pick: Pick) -> Vec:
    """Return one place where a is at most b, else the other."""
    return Vec(pick(a, b, one.x, other.x), pick(a, b, one.y, other.y))


def ear_room(order: Sequence[Vec], place: int, sense: Scalar) -> Scalar:
    """Return a number above zero where a corner can be cut off: it turns to the inside, and nothing else lies in its triangle."""
    count = len(order)
    a, b, c = order[place - 1], order[place], order[(place + 1) % count]
    room = doubled_turn(a, b, c) * sense
    for step in range(2, count - 1):
        P = order[(place + step) % count]
        inside = reduce(np.minimum, [doubled_turn(start, end, P) * sense for start, end in ((a, b), (b, c), (c, a))])
        room = np.minimum(room, 0.0 - inside)
    return room


# Where two bodies come nearest.


@immutable
class NearestPlaces:
    """The places of two bodies that are nearest to each other, shape (2,) each [m], and their gap [m].

    Where the bodies cross it is below zero: the first place lies in the other body, the second where the first one would leave it.
    """

    gap: float
    one: npt.NDArray[np.float64]
    other: npt.NDArray[np.float64]


def nearest_places(plan: Plan, where: Reading, a: str, b: str) -> NearestPlaces:
    """Return where two bodies, points or outlines come nearest at the pose of a reading."""
    one, other = two_shapes(plan, a, b)
    every = ([piece for piece in shape.pieces(plan, where, pick) if piece.is_one] for shape in (one, other))
    return min((between(p, q) for p, q in product(*every)), key=lambda each: each.gap)


def between(one: Piece, other: Piece) -> NearestPlaces:
    """Return where two convex pieces come nearest: the same numbers as `gap_in`, with their places."""
    a, b, edges = one.places, other.places, (one.edges, other.edges)
    found = [(separation(a, b, way), way, k) for k, own in enumerate(edges) for way in ways_across(own)]
    deepest = max(found, key=lambda each: float(each[0]), default=None)
    if deepest is not None and deepest[0] <= 0.0:
        size, way, owner = deepest
        unit = way * (1.0 / float(np.sqrt(max(way.square(), SMALLEST))))
        if max(P.dot(unit) for P in a) - min(P.dot(unit) for P in b) > max(P.dot(unit) for P in b) - min(P.dot(unit) for P in a):
            unit = -unit
        start, end = (min(b, key=unit.dot),) * 2 if owner == 0 else (max(a, key=unit.dot),) * 2
        start, end = (start - unit * size, end) if owner == 0 else (start, end + unit * size)
    else:
        ends = [(P, nearest_on(edge, P)) for P in a for edge in edges[1]] + [(nearest_on(edge, Q), Q) for Q in b for edge in edges[0]]
        start, end = min([*ends, *([] if ends else [(a[0], b[0])])], key=lambda pair: float((pair[1] - pair[0]).square()))
        size = float(np.sqrt((end - start).square()))
        unit = (end - start) * (1.0 / max(size, SMALLEST))
    places = start + unit * one.radius, end - unit * other.radius
    first, second = (np.array([float(place.x), float(place.y)]) for place in places)
    return NearestPlaces(float(size - one.radius - other.radius), first, second)
