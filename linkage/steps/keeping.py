"""Constraints that the vector method's primitives keep by construction: points that move as one, driven lengths and turns.

Nothing is measured here. A direction is a sum of angles, a length a sum of lengths, both by name. Points are one body where vectors join
them whose lengths follow no stroke and whose directions differ by angles that follow none. A turn by a cosine-rule angle closes a
triangle, whose third side is a member as well. Points that keep their distance in another way, as the pins of a parallelogram do, are
no body.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Mapping
from dataclasses import dataclass, field
from functools import reduce
from math import isclose, pi, remainder
from typing import NamedTuple, TypeAlias

from ..quantities import Angle, Axes, CurveValue, Distance, Jointed, Length, Member, Reference, Stroke, Variable, name_of, of_kind
from ..quantities.member import needed_behind, needs
from ..quantities.quantity import Negative, Number, Operation, Quantity, Ref, Sum
from .link import Link
from .primitives import Arrow, Axis, CosineAngle, Offset, OffsetLinks, Turn, Vector
from .step import Bar, Point

STROKE, POINTS = "stroke", "points"
"""What a quantity may follow: a stroke by itself, or points that move against each other."""
SAME = 1e-12
"""Numbers of a class that differ by less than this, relative or in rad, are one number."""


Terms: TypeAlias = frozenset[tuple[Hashable, float]]
"""Multiples of what is told apart by name."""


class Form(NamedTuple):
    """A linear sum: multiples of terms with a key each, and a number [SI]."""

    terms: Terms = frozenset()
    number: float = 0.0

    def plus(self, other: Form, factor: float = 1.0) -> Form:
        """Return this with a multiple of another one added."""
        found = dict(self.terms)
        for key, times in other.terms:
            found[key] = found.get(key, 0.0) + factor * times
        return Form(frozenset((key, times) for key, times in found.items() if times), self.number + factor * other.number)

    def is_length(self, other: Form) -> bool:
        """Return whether another length is this one."""
        return self.terms == other.terms and isclose(self.number, other.number, rel_tol=SAME)


@dataclass
class TurningBody:
    """Points that keep their places against each other. `turns` is the part of its directions that moves.

    `root` is the far end of a driven length: it tells how the body is turned, and is no point of it.
    """

    turns: Terms
    points: list[str] = field(default_factory=list)
    root: str = ""

    def pair(self, point: str) -> tuple[str, str] | None:
        """Return two points that tell how it is turned, one of them given if it can be; None where there is one alone."""
        ordered = sorted(filter(None, (*self.points, self.root)), key=lambda each: each != point)
        return (ordered[0], ordered[1]) if len(ordered) > 1 else None


def with_bodies(members: Mapping[str, Member], lengths: Mapping[frozenset[str], Quantity]) -> dict[str, Member]:
    """Return bound members, in order, whose offset points have their constraints; `lengths` are those that labels give."""
    if not any(isinstance(member, Offset) for member in members.values()):
        return dict(members)
    found = Construction(members, lengths)
    return {name: member.renewed(keeps=found.kept[name]) if isinstance(member, Offset) else member for name, member in members.items()}


class Construction:
    """The bodies, in the order in which the points are placed."""

    def __init__(self, members: Mapping[str, Member], lengths: Mapping[frozenset[str], Quantity]) -> None:
        self.members, self.lengths = members, dict(lengths)
        self.named: dict[str, Form] = {}
        self.forms: dict[frozenset[str], Form] = {}
        self.rays: dict[tuple[str, str], Form] = {}
        self.arrows: dict[tuple[str, str], Reference] = {}
        self.follows: dict[Hashable, frozenset[str]] = {}
        self.corners: dict[Hashable, CosineAngle] = {}
        self.strokes: set[Hashable] = set()
        self.turned: dict[Hashable, str] = {}
        self.frame = TurningBody(frozenset())
        self.bodies = [self.frame]
        self.placed: list[str] = []
        self.kept: dict[str, OffsetLinks] = {}
        self.used = self._points_behind(member for member in members.values() if isinstance(member, (Jointed, Link)))
        links = dict(of_kind(members, Link))
        for name, member in members.items():
            if isinstance(member, Point):
                self.placed.append(name)
                self._place(name, member)
                for each in [each for each, link in links.items() if set(link.point_names) <= set(self.placed)]:
                    link = links.pop(each)
                    length = self.lengths.get(frozenset(link.point_names))
                    self._join(link.point_names if length is None or not self.behind(self.form(length)) else ())

    def _points_behind(self, starts: Iterable[Member]) -> dict[str, Point]:
        """Return the points that some members hang on, at once or through vectors and quantities."""
        names = needed_behind((each for member in starts for each in needs(member)), self.members, barred=Point)
        return {name: member for name in names if isinstance(member := self.members[name], Point)}

    # -- points in turn --------------------------------------------------------------------------------------

    def _place(self, name: str, point: Point) -> None:
        """Take in a point: one of the frame, one that a step holds, or one that is offset."""
        if point.is_fixed:
            self.frame.points.append(name)
        elif isinstance(point, Offset):
            self.kept[name] = self._offset(name, name_of(point.P), point.by)
        else:
            for bar in point.bars():
                self._join((bar.P, bar.Q) if not self.behind(self.form(bar.length)) else ())
            moved = any(self.behind(self.form(drive.quantity)) for joint in point.joints() if joint.arm for drive in joint.drives)
            for body in () if moved else point.bodies():
                self._join(body)

    def _join(self, points: tuple[str, ...]) -> None:
        """Let points be one body; with any that shares two of them it is one."""
        if len(points) < 2:
            return
        shared = [body for body in self.bodies if len(set(body.points) & set(points)) > 1]
        body = shared[0] if shared else TurningBody(self.moving(self.direction_of(points[0], points[1])))
        for other in (*shared[1:], TurningBody(frozenset(), list(points))):
            body.points += [each for each in other.points if each not in body.points]
        self.bodies = [each for each in self.bodies if each not in shared[1:]] + ([] if shared else [body])

    def _offset(self, X: str, P: str, by: Reference) -> OffsetLinks:
        """Return the constraints that the point X = P + vector keeps."""
        arrow = self.arrow(by)
        way, length = self.direction_form(arrow), self.length_form(arrow)
        turns, behind = self.moving(way), self.behind(length)
        home = next((body for body in self.bodies if body.turns == turns and P in body.points and body.pair(P)), None)
        closing = None if home is not None else self._closing(P, way, length)
        self.rays[P, X], self.arrows[P, X] = way, by
        self.forms[frozenset((P, X))] = length
        if home is not None:
            return self._at_home(X, P, home, arrow)
        drive = None if closing is not None else self._drive(P, arrow)
        if drive is not None and behind:
            return self._telescope(X, P, turns, drive[1], arrow, drive[0]) if self.is_driven(length) else OffsetLinks()
        if closing is None and drive is None and (X not in self.used or (behind and not self.is_driven(length))):
            return OffsetLinks()  # a pointer, or a place that is worked out: nothing is held by it
        held = self._side(P, X, Length(arrow), self._known(arrow), length, turns)
        if closing is not None:  # the apex of a triangle keeps the third side, from the far end of its base, as well
            Q, third = closing[0], closing[1].triangle[2]
            form = self.forms[frozenset((Q, X))] = self.form(third)
            other = self._side(Q, X, third, self._plain(third), form, self.moving(self.direction_of(Q, X)))
            return OffsetLinks(held.groups + other.groups, held.sides + other.sides, held.rods + other.rods, apex=Q)
        return held if drive is None else OffsetLinks(held.groups, held.sides, held.rods, by=drive[1], angle=drive[0], settled=True)

    def _side(self, P: str, X: str, length: Quantity, known: Quantity | None, form: Form, turns: Terms) -> OffsetLinks:
        """Return a two-point member P X: a rod, or a drive's; nothing where its length follows points that move against each other."""
        behind = self.behind(form)
        if POINTS in behind:
            return OffsetLinks()
        self.bodies += [TurningBody(turns, [P], X), TurningBody(turns, [X], P)] if behind else [TurningBody(turns, [P, X])]
        sides = (Bar(P, X, length if known is None else known),)
        return OffsetLinks((), sides, sides) if behind or known is not None else OffsetLinks(((P, X),), sides)

    def _at_home(self, X: str, P: str, home: TurningBody, arrow: Arrow) -> OffsetLinks:
        """Return the constraints of a point offset in the direction of a body at P: it is part of the body, or slides along it."""
        length, by = self.length_form(arrow), home.pair(P)
        if self.is_driven(length) and by is not None:
            return self._telescope(X, P, home.turns, by, arrow, None)
        if self.behind(length) or by is None:
            return OffsetLinks()
        rays = [pair for pair in self.rays if P in pair and X not in pair and {*pair} <= {*home.points, home.root}]
        home.points.append(X)
        if not rays or home is self.frame:
            return OffsetLinks(((P, by[1], X),), settled=True)
        start, end = rays[0]
        Y, sign = (end, 1.0) if start == P else (start, -1.0)
        return OffsetLinks(((P, Y, X),), settled=True, beside=(Y, self.arrows[start, end], sign))

    def _telescope(self, X: str, P: str, turns: Terms, by: tuple[str, ...], arrow: Arrow, angle: Quantity | None) -> OffsetLinks:
        """Return the constraints of an arm that a stroke moves along its body."""
        self.bodies.append(TurningBody(turns, [X], root=P))
        known, ends = self._known(arrow), by or tuple(self.frame.points[:2])
        return OffsetLinks(by=ends, angle=angle, length=Length(arrow) if known is None else known, settled=True)

    def _closing(self, P: str, way: Form, length: Form) -> tuple[str, CosineAngle] | None:
        """Return the far end Q of the base P -> Q from which a vector is turned by the corner of a triangle, and that angle."""
        for key, times in way.terms:
            if key in self.corners and abs(times) == 1.0:
                base = way.plus(Form(frozenset({(key, 1.0)})), -times)
                first, second, _ = (self.form(side) for side in self.corners[key].triangle)
                for Q in self.placed[:-1]:
                    along = base if Q == P else self.direction_of(P, Q)
                    if Q != P and along.terms == base.terms and abs(remainder(along.number - base.number, 2.0 * pi)) < SAME:
                        beside = self.pair_length(P, Q)
                        for a, b in ((first, second), (second, first)):
                            if a.is_length(beside) and b.is_length(length):
                                return Q, self.corners[key]
        return None

    def _drive(self, P: str, arrow: Arrow) -> tuple[Quantity, tuple[str, ...]] | None:
        """Return the angle by which a stroke turns a vector, and two points of the body it is counted from; none for the frame.

        A vector that has turned one body turns no other: bodies that move parallel are not driven twice.
        """
        while isinstance(arrow, Turn) and not self.behind(self.form(arrow.angle)):
            arrow = self.arrow(arrow.base)
        if not isinstance(arrow, Turn) or self.turned.setdefault(arrow.name or id(arrow), P) != P:
            return None
        base, angle = self.moving(self.direction_form(self.arrow(arrow.base))), self.form(arrow.angle)
        if not base:
            counted_from = (body.turns for body in self.bodies if body.turns <= angle.terms)  # the frame, or a body
            return (arrow.angle, ()) if any(self.is_driven(Form(angle.terms - turns)) for turns in counted_from) else None
        bodies = sorted((body for body in self.bodies if body.turns == base and body.pair(P)), key=lambda body: P not in body.points)
        by = bodies[0].pair(P) if bodies else None
        return (arrow.angle, by) if by is not None and self.is_driven(angle) else None

    # -- directions and lengths as sums ------------------------------------------------------------------------

    def arrow(self, reference: Reference) -> Arrow:
        """Return a vector by its name or itself."""
        found = self.members[name_of(reference)] if isinstance(reference, str) or reference.name else reference
        assert isinstance(found, Arrow)
        return found

    def direction_form(self, arrow: Arrow) -> Form:
        """Return the direction of a vector as a sum of angles."""
        match arrow:
            case Vector():
                return self.direction_of(name_of(arrow.P), name_of(arrow.Q))
            case Turn():
                return self.direction_form(self.arrow(arrow.base)).plus(self.form(arrow.angle))
            case Axis():
                return self._base(arrow.axes).plus(Form(number=pi if arrow.axes.mirrored else 0.0))
        return self._atom(("direction of", arrow.name or id(arrow)), {STROKE, POINTS})

    def _base(self, axes: Axes) -> Form:
        """Return the direction of the x axis of axes, before they are mirrored."""
        return (self.direction_of(*axes.carrier) if axes.carrier else Form()).plus(self.form(axes.angle))

    def length_form(self, arrow: Arrow) -> Form:
        """Return the length of a vector as a sum of lengths."""
        match arrow:
            case Vector():
                return self.pair_length(name_of(arrow.P), name_of(arrow.Q))
            case Turn():
                return self.length_form(self.arrow(arrow.base)) if arrow.scaled_to is None else self.form(arrow.scaled_to)
            case Axis():
                return Form(number=1.0)
        return self._atom(("length of", arrow.name or id(arrow)), {STROKE, POINTS})

    def direction_of(self, P: str, Q: str) -> Form:
        """Return the direction from one point to another."""
        if (P, Q) in self.rays:
            return self.rays[P, Q]
        if (Q, P) in self.rays:
            return self.rays[Q, P].plus(Form(number=pi))
        first, second = sorted((P, Q))
        body = next((body for body in self.bodies if {P, Q} <= {*body.points}), None)
        if body is None or ("direction", first, second) in dict(body.turns):
            found = self._atom(("direction", first, second), {POINTS})
        else:
            found = Form(body.turns).plus(self._atom(("within a body", first, second), set()))
        return found if first == P else found.plus(Form(number=pi))

    def pair_length(self, P: str, Q: str) -> Form:
        """Return the distance of two points."""
        pair = frozenset((P, Q))
        if pair in self.forms:
            return self.forms[pair]
        if pair in self.lengths:
            return self.form(self.lengths[pair])
        rigid = any(pair <= set(body.points) for body in self.bodies)
        return self._atom(("distance", pair), set() if rigid else {POINTS})

    def form(self, given: Quantity) -> Form:
        """Return a quantity as a sum."""
        given = self._resolved(given)
        if given.name not in self.named:
            found = self._sum(given)
            if not given.name:
                return found
            self.named[given.name] = found
        return self.named[given.name]

    def _sum(self, given: Quantity) -> Form:
        """Return a quantity as a linear sum of its terms."""
        match given:
            case Number():
                return Form(number=given.number)
            case Sum():
                return self.form(given.a).plus(self.form(given.b))
            case Negative():
                return Form().plus(self.form(given.a), -1.0)
            case Angle():
                way, base = self.direction_of(name_of(given.P), name_of(given.Q)), self._base(given.axes)
                return base.plus(Form(number=pi)).plus(way, -1.0) if given.axes.mirrored else way.plus(base, -1.0)
            case Distance():
                return self.pair_length(name_of(given.P), name_of(given.Q))
            case Length():
                return self.length_form(self.arrow(given.vector))
            case CosineAngle():
                a, b, c = (self.form(side) for side in given.triangle)
                key = ("corner", frozenset((a, b)), c)
                self.corners[key] = given
                return self._atom(key, self.behind(a) | self.behind(b) | self.behind(c))
            case Operation():  # a multiple where one factor is a number
                a, b = self.form(given.a), self.form(given.b)
                if given.symbol == "*" and not (a.terms and b.terms):
                    return Form().plus(*((b, a.number) if not a.terms else (a, b.number)))
                if given.symbol == "/" and not b.terms and b.number:
                    return Form().plus(a, 1.0 / b.number)
                return self._atom((given.symbol, a, b), self.behind(a) | self.behind(b))
        return self._other(given)

    def _other(self, given: Quantity) -> Form:
        """Return a quantity without a simpler form as a term: a stroke, a dimension, a coordinate, a function."""
        if isinstance(given, (Stroke, CurveValue)):
            self.strokes.add(given.name or str(given))
        if isinstance(given, (Stroke, Variable)) or not given.parts():
            return self._atom(given.name or str(given), {STROKE} if isinstance(given, Stroke) else set())
        parts = [self.members[part] if isinstance(part, str) else part for part in given.parts()]
        behind: set[str] = set()
        for part in parts:
            if isinstance(part, Quantity):
                behind |= self.behind(self.form(part))
            elif not part.is_fixed:
                behind.add(POINTS)
        return self._atom(given.name or str(given), behind)

    def _resolved(self, given: Quantity) -> Quantity:
        """Return the quantity that a name stands for."""
        target = given.target if isinstance(given, Ref) else given.name
        found = self.members[target] if target else given
        assert isinstance(found, Quantity)
        return self._resolved(found) if isinstance(found, Ref) and found is not given else found

    def _atom(self, key: Hashable, follows: set[str] | frozenset[str]) -> Form:
        """Return a sum of one term."""
        self.follows[key] = frozenset(follows)
        return Form(frozenset({(key, 1.0)}))

    def behind(self, form: Form) -> frozenset[str]:
        """Return the strokes and moving points that a sum depends on; empty where it is constant."""
        return reduce(frozenset.union, (self.follows[key] for key, _ in form.terms), frozenset())

    def is_driven(self, form: Form) -> bool:
        """Return whether a sum follows strokes as a drive does, in proportion or by a table; other functions of strokes are no drives."""
        moving = [key for key, _ in form.terms if self.follows[key]]
        return bool(moving) and all(key in self.strokes and self.follows[key] == {STROKE} for key in moving)

    def moving(self, way: Form) -> Terms:
        """Return the part of a direction that is not constant: equal for all vectors of a body."""
        return frozenset((key, times) for key, times in way.terms if self.follows[key])

    # -- lengths as quantities that are built from no moving point --------------------------------------------

    def _known(self, arrow: Arrow) -> Quantity | None:
        """Return the length of a vector as a quantity of strokes and dimensions; None where it is not written as one."""
        match arrow:
            case Turn():
                return self._known(self.arrow(arrow.base)) if arrow.scaled_to is None else self._plain(arrow.scaled_to)
            case Vector():
                return self._plain(Distance(arrow.P, arrow.Q))
        return None

    def _plain(self, given: Quantity) -> Quantity | None:
        """Return a length as a quantity of strokes and dimensions."""
        found = self._resolved(given)
        match found:
            case Length():
                return self._known(self.arrow(found.vector))
            case Distance():
                P, Q = name_of(found.P), name_of(found.Q)
                ray = next((pair for pair in ((P, Q), (Q, P)) if pair in self.arrows), None)
                if ray is not None:
                    return self._known(self.arrow(self.arrows[ray]))
                return self.lengths.get(frozenset((P, Q)), found if {P, Q} <= set(self.frame.points) else None)
        return given if all(point.is_fixed for point in self._points_behind([found]).values()) else None
