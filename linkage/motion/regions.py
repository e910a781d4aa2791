"""How far a point lies inside a region of the frame: in one of some polygons and circles, and in none of those that are forbidden.

    +------------+        inside: the distance to the region's border [m]
    |   o  +---  |        outside of it: less than zero, by how far it is to the nearest place of the border
    |      |     |
    +------+     +

Whether a point is in a polygon is decided by how often a ray from it crosses the border: corners of a polygon may point inwards.
Source: J. O'Rourke, Computational geometry in C (1998), 7.4.2.
"""

from __future__ import annotations

import operator
from functools import reduce
from itertools import pairwise
from typing import Any, TypeAlias

import numpy as np

from ..errors import DefinitionError, cited, ensure, known_name
from ..frozen import record
from ..numeric import convex_pieces, crosses_itself
from ..plan import Plan
from ..program import FloatArray, Node
from ..quantities import Reference, is_number, name_of
from ..quantities.quantity import plain
from ..surroundings import CircleOutline, Outline, numbers_at
from ..units import require_measure
from ..vectors import Scalar, Vec, pick
from .gaps import SMALLEST, Pick, nearest_on
from .requests import NodeRequest


@record
class Polygon:
    """A polygon by its corners [m]."""

    corners: tuple[tuple[float, float], ...]

    def depth(self, X: Vec, choose: Pick) -> Scalar:
        """Return how far a place lies inside [m], below zero outside."""
        corners = [Vec(x, y) for x, y in self.corners]
        edges = list(pairwise((*corners, corners[0])))
        squares = [(X - nearest_on(edge, X)).square() for edge in edges]
        distance = np.sqrt(np.maximum(reduce(np.minimum, squares), SMALLEST))
        signs = []
        for start, end in edges:  # -1 where a ray from the place to the right crosses the edge, else 1
            from_start, to_end = choose(start.y, X.y, 1.0, -1.0), choose(end.y, X.y, -1.0, 1.0)
            left = choose((X - start).cross(end - start), 0.0, 1.0, -1.0)
            signs.append(choose(2.5, np.abs(from_start + to_end + left), -1.0, 1.0))
        return reduce(operator.mul, signs) * -1.0 * distance

    def border(self, places: FloatArray) -> FloatArray:
        """Return the nearest places of its border to places (n, 2)."""
        corners = np.array(self.corners)
        start, along = corners, np.roll(corners, -1, axis=0) - corners
        share = np.clip(np.sum((places[:, None] - start) * along, axis=2) / np.sum(along**2, axis=1), 0.0, 1.0)
        found = start + share[..., None] * along
        near = np.argmin(np.sum((places[:, None] - found) ** 2, axis=2), axis=1)
        return np.asarray(found[np.arange(len(places)), near])

    @property
    def bounding_box(self) -> FloatArray:
        """Its least and its greatest coordinates, shape (2, 2)."""
        return np.array([np.min(self.corners, axis=0), np.max(self.corners, axis=0)])

    def __str__(self) -> str:
        return f"[{', '.join(f'({x:g}, {y:g})' for x, y in self.corners)}]"


@record
class Disc:
    """A circle by its centre and radius [m]."""

    x: float
    y: float
    radius: float

    def depth(self, X: Vec, choose: Pick) -> Scalar:
        """Return how far a place lies inside [m], below zero outside."""
        return self.radius - np.sqrt(np.maximum((X - Vec(self.x, self.y)).square(), SMALLEST))

    def border(self, places: FloatArray) -> FloatArray:
        """Return the nearest places of its border to places (n, 2)."""
        centre = np.array([self.x, self.y])
        way = places - centre
        far = np.linalg.norm(way, axis=1, keepdims=True)
        way = np.where(far > 0.0, way / np.where(far > 0.0, far, 1.0), [1.0, 0.0])
        return np.asarray(centre + self.radius * way)

    @property
    def bounding_box(self) -> FloatArray:
        """Its least and its greatest coordinates, shape (2, 2)."""
        return np.array([[self.x - self.radius, self.y - self.radius], [self.x + self.radius, self.y + self.radius]])

    def __str__(self) -> str:
        return f"circle(({self.x:g}, {self.y:g}), {self.radius:g})"


Shape: TypeAlias = Polygon | Disc
LISTS = (list, tuple, np.ndarray)


@record
class Forbidden:
    """A shape in which a point may not stand: corners, an outline or the name of one."""

    shape: Any


def outside(shape: object) -> Forbidden:
    """Return a shape as a forbidden one: `regions={"C": ["frame", outside("wheel")]}`.

    Parameters
    ----------
    shape : str, sequence or Outline
        The shape.

    Returns
    -------
    Forbidden
        The forbidden shape.
    """
    return Forbidden(shape)


@record
class Region:
    """Where a point may stand: in one of the shapes `within`, where there are any, and in none of those that are `without`."""

    within: tuple[Shape, ...]
    without: tuple[Shape, ...]

    def depth(self, X: Vec, choose: Pick = pick) -> Scalar:
        """Return how far a place lies inside [m], below zero outside."""
        parts = [reduce(np.maximum, [each.depth(X, choose) for each in self.within])] if self.within else []
        return reduce(np.minimum, [*parts, *(-each.depth(X, choose) for each in self.without)])

    def depths(self, places: FloatArray) -> FloatArray:
        """Return how far places (n, 2) lie inside [m], below zero outside, (n,)."""
        return np.asarray(self.depth(Vec(places[:, 0], places[:, 1])), float)

    def nearest(self, places: FloatArray) -> FloatArray:
        """Return places (n, 2), those outside at the nearest place of a border that is inside; as they are where there is none."""
        found, best = np.array(places, float), np.where(self.depths(places) >= 0.0, 0.0, np.inf)
        for each in (*self.within, *self.without):
            tried = each.border(places)
            far = np.where(self.depths(tried) >= -1e-9, np.linalg.norm(tried - places, axis=1), np.inf)
            better = far < best
            found[better], best[better] = tried[better], far[better]
        return found

    @property
    def bounding_box(self) -> FloatArray:
        """The least and the greatest coordinates of the allowed region, infinite where only shapes are forbidden, shape (2, 2)."""
        if not self.within:
            return np.array([[-np.inf, -np.inf], [np.inf, np.inf]])
        boxes = np.array([each.bounding_box for each in self.within])
        return np.array([boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)])

    def __str__(self) -> str:
        return ", ".join([*map(str, self.within), *(f"outside({each})" for each in self.without)])


def inside(point: Reference, *shapes: object) -> NodeRequest:
    """Return the request for how far a point lies inside a region [m], below zero outside: `inside("C", [(0, 0), (1, 0), (1, 0.5)])`.

    Each shape is a polygon by its corners [m], an `Outline` of the frame or `Outline.circle(...)`. The point is to be in one of them, and
    in none that is given as `outside(...)`. `least(inside("C", ...)) >= 0` keeps a moving point inside over the whole stroke.

    Parameters
    ----------
    point : str or Point
        The point, or its name.
    *shapes : sequence or Outline
        Polygons by their corners [m], outlines of the frame, circles, `outside(...)`.

    Returns
    -------
    Request
        The distance inside [m], below zero outside.
    """
    return inside_region(name_of(point), region_of([*shapes], f"inside({name_of(point)})"))


def inside_region(point: str, region: Region) -> NodeRequest:
    """Return the same of a region."""

    def nodes(plan: Plan) -> tuple[Node, ...]:
        return (plan.trace.graph.node(region.depth(plan.trace.at(point), plan.trace.graph.pick)),)

    def names(plan: Plan) -> set[str]:
        known_name("Point", point, plan.points, where=f"{plan.title}: inside({point}, ...)")
        return plan.reaches(point)

    return NodeRequest(
        text=f"inside({point}, {region})", sentence=f"how far {point} lies inside its region", key=("inside", point, region),
        measures="length", nodes_of=nodes, names_of=names,
    )  # fmt: skip


# What a user writes.


def region_of(given: object, where: str, outlines: object = None, value: object = None) -> Region:
    """Return the region of a shape or a list of shapes; DefinitionError for anything else.

    `outlines` are those of a machine by name, whose coordinates `value` gives as numbers.
    """
    listed = [given] if is_shape(given) else list(given) if isinstance(given, LISTS) else []
    example = "corners [(0, 0), (1, 0), (1, 0.5)] in m, an outline, outside(...) of one, or a list of these"
    ensure(listed, f"{where}: {cited(given)} is no region; {example} is expected.")
    within: list[Shape] = []
    without: list[Shape] = []
    for each in listed:
        shape = region_shape(each.shape if isinstance(each, Forbidden) else each, where, outlines or {}, value)
        (without if isinstance(each, Forbidden) else within).append(shape)
    return Region(tuple(within), tuple(without))


def is_shape(given: object) -> bool:
    """Return whether this is one shape and no list of several: an outline, its name, or corners."""
    if isinstance(given, (str, Outline, Forbidden, Polygon, Disc)):
        return True
    corners = list(given) if isinstance(given, LISTS) else []
    return len(corners) > 0 and all(isinstance(each, LISTS) and len(each) == 2 and all(map(is_number, each)) for each in corners)


def region_shape(given: Any, where: str, outlines: Any, value: Any) -> Shape:
    """Return one shape; DefinitionError for anything else, for an outline that moves, and for one that encloses nothing."""
    if isinstance(given, (Polygon, Disc)):
        return given
    if isinstance(given, str):
        given = outlines[known_name("Outline", given, outlines, where=where)]
    ensure(is_shape(given), f"{where}: {cited(given)} is no shape; corners are expected, [(0, 0), (1, 0), (1, 0.5)] in m.")
    if not isinstance(given, Outline):
        require_measure(given, "length", where)
        return polygon_of(np.array(given, float), where)
    outline = given
    carried = f"{outline} is carried by {', '.join(outline.carriers)}"
    ensure(not outline.carriers, f"{where}: {carried}, and a region stands in the frame; ask gap(...) of it.")
    try:
        number = value or (lambda each: float(each.number))
        if isinstance(outline, CircleOutline):
            x, y = outline.centre
            return Disc(number(x), number(y), number(outline.radius))
        if not outline.closed or not hasattr(outline, "points"):
            raise DefinitionError(f"{where}: {outline} is open, or lines of a file, and has no inside; give the corners of a closed one.")
        return polygon_of(numbers_at(outline.points, number), where)
    except AttributeError:
        raise DefinitionError(f"{where}: {outline} follows dimensions; declare it in the class and give its name.") from None


def polygon_of(corners: FloatArray, where: str) -> Polygon:
    """Return a polygon; DefinitionError for corners that are too few, cross or enclose nothing."""
    if len(corners) < 3 or not np.isfinite(corners).all() or crosses_itself(corners) or not convex_pieces(corners):
        raise DefinitionError(f"{where}: {cited(corners.tolist())}: a region has three corners at least and does not cross itself.")
    return Polygon(tuple((float(plain(x)), float(plain(y))) for x, y in corners))
