"""Scenes: the drawing of a motion, without a drawing library: bodies, cylinders, pins, and their places."""

from __future__ import annotations

import warnings
from collections import Counter
from collections.abc import Callable
from dataclasses import field, replace
from functools import cached_property
from itertools import chain, combinations, pairwise, product
from operator import methodcaller
from typing import TypeAlias

import numpy as np

from ..errors import DefinitionError, ensure, require
from ..frozen import immutable, record
from ..loads import ForceElement, Glyph, Halves, TwoPoint
from ..motion import Motion, Over, require_motion
from ..motion.strokes import strokes_over_axes
from ..plan import WIDE, member_sides
from ..program import FloatArray
from ..quantities import Quantity, Where, is_whole, joined_names, needs
from ..steps import Arrow, Guide, Point
from ..surroundings import Outline
from ..vectors import Line
from . import shapes, style
from .shapes import HALF, DrawnLine

# What points slide along: fixed rails and slots on moving bodies, each as long as the travel asks.

MARGIN = 3.2
"""How far a track goes on beyond the travel, in sizes."""


@immutable
class SlideTrack:
    """A straight track: its origin [m] and its direction at every pose, shape (2, n), and the points that slide on it."""

    name: str
    origin: FloatArray
    along: FloatArray
    riders: tuple[str, ...]
    fixed: bool
    line: Callable[[Where], Line]
    """The same, of any reading."""

    @property
    def ends(self) -> tuple[str, str]:
        """The names under which its two ends stand among a pose's places; no point can be called so."""
        return f"{self.name}|start", f"{self.name}|end"

    def travel(self, places: dict[str, FloatArray]) -> tuple[float, float]:
        """Return the least and greatest distance of a rider from the origin [m], along the track."""
        away = np.concatenate([((places[name] - self.origin) * self.along).sum(axis=0) for name in self.riders])
        return float(np.nanmin(away, initial=np.inf)), float(np.nanmax(away, initial=-np.inf))


Places: TypeAlias = dict[str, FloatArray]
Pose: TypeAlias = int | tuple[int, ...]
Bounds: TypeAlias = tuple[float, float, float, float]


@record
class TwoForceMember:
    """A two-force member from P to Q: its form, its name, and how far to the left of P -> Q, in sizes, where others share its points.

    `ends` of a telescope are its closed length and the lengths at which its stages are out [m].
    """

    P: str
    Q: str
    drawn_as: str
    name: str
    aside: float = 0.0
    ends: tuple[float, ...] = ()

    @property
    def half(self) -> float:
        """Half the width of the area it covers about P -> Q, in sizes."""
        return HALF[self.drawn_as] + abs(self.aside)


@immutable
class Plate:
    """A body's form: in each corner the shares of its points, shape (k, n), counter-clockwise; two corners are a bar."""

    points: tuple[str, ...]
    shares: FloatArray

    def at(self, places: Places) -> FloatArray:
        """Return its corners, shape (k, 2) [m]."""
        return np.asarray(self.shares @ np.array([places[name] for name in self.points]))


@immutable
class DrawnMark:
    """Lines that some points carry, in axes at the first of them [m]: along the direction of the last two, and to its left.

    Of one point, or of none, the axes have the frame's directions. Lines stretch with the distance of the two points as their rows say, and
    move with the piston where there is a cylinder. `level` is the layer above that of plates, `width` a line's in outlines, `ink` a colour
    of the style. `hatched` are short lines, shape (m, 2, 2). `under` is the path of a picture, its corners from the lower left one, and how
    opaque it is. A writer of pictures draws marks and knows no kinds of members.
    """

    name: str
    on: tuple[str, ...]
    lines: tuple[DrawnLine, ...]
    level: float = 0.5
    width: float = 0.8
    ink: str = "INK"
    hatched: FloatArray = field(default_factory=lambda: np.empty((0, 2, 2)))
    under: tuple[str, FloatArray, float] | None = None
    cylinder: DrawnCylinder | None = None

    def axes(self, at: Places) -> tuple[FloatArray, FloatArray, float]:
        """Return the origin (2,) and the directions (2, 2) of its axes at a pose, and the distance of the points that it stretches with."""
        if len(self.on) < 2:
            return at[self.on[0]] if self.on else np.zeros(2), np.eye(2), 0.0
        along = at[self.on[-1]] - at[self.on[-2]]
        length = float(np.hypot(*along))
        along = along / (length or 1.0)
        return at[self.on[0]], np.array([along, shapes.left_of(along)]), length

    def placed(self, points: FloatArray, at: Places) -> FloatArray:
        """Return points of its axes in the plane, the same shape (..., 2) [m]."""
        origin, ways, _ = self.axes(at)
        return np.asarray(origin + points @ ways)

    def drawn(self, at: Places) -> list[FloatArray]:
        """Return its lines at a pose, shape (n, 2) each [m]."""
        origin, ways, length = self.axes(at)
        piston = 0.0 if self.cylinder is None else self.cylinder.piston(length)
        return [np.asarray(origin + line.at(length, piston) @ ways) for line in self.lines]

    @property
    def corners(self) -> FloatArray:
        """All its points where nothing stretches, shape (n, 2) [m]."""
        lines = [line.rows[:, 1:3] for line in self.lines]
        return np.concatenate([np.empty((0, 2)), *lines, *([self.under[1]] if self.under else [])])


@record
class DrawnCylinder:
    """A cylinder from P to Q as it is drawn [m]: its barrel from bottom to mouth, its piston between least and most, moved aside."""

    P: str
    Q: str
    aside: float = 0.0
    bottom: float = 0.0
    mouth: float = 0.0
    rod: float = 0.0
    least: float = 0.0
    most: float = 0.0

    def piston(self, length: float) -> float:
        """Return where the piston stands at a length [m], from P; it stops where no cylinder could be that long."""
        return float(np.clip(length - self.rod, self.least, self.most))

    def mark(self, size: float) -> DrawnMark:
        """Return it drawn in a size [m]: the eye, the barrel cut open, the rod, its piston, and the cap at the barrel's mouth."""
        lines = tuple(line.moved(self.aside) for line in shapes.cylinder(self.bottom, self.mouth, size))
        return DrawnMark(joined_names(self.P, self.Q), (self.P, self.Q), lines, 0.4, cylinder=self)


CROWDED = 20
"""More dotted names than so many crowd a picture."""
PRIMES = 3
"""The points of so many parts are told apart by primes, those of further ones by raised numbers."""
RAISED = str.maketrans("0123456789", "\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079")


@immutable
class Scene:
    """The things to draw in a motion of one design. Raises DefinitionError for a batch of designs.

    `over` is a motion of the same machine whose travel the tracks allow for, where it goes further than this one.
    """

    motion: Motion
    over: Motion | None = None
    places: Places = field(init=False)

    def __post_init__(self) -> None:
        require_motion(self.motion)
        plan = self.motion.plan
        said = f"{plan.title}: this motion holds {np.prod(self.motion._design_shape)} designs and a picture shows one"
        ensure(not self.motion._design_shape, f"{said}; draw them one at a time, each dimension a single number.")
        flat = {name: self.motion[name].reshape(2, -1) for name in plan.points}
        object.__setattr__(self, "places", flat)

    # -- poses -----------------------------------------------------------------------------------------

    @cached_property
    def reached(self) -> list[int]:
        """The poses that can be assembled, as flat indices."""
        return [int(index) for index in np.flatnonzero(self.motion.reached.ravel())]

    def index(self, pose: Pose) -> int:
        """Return the flat index of a pose; DefinitionError where there is none such."""
        shape = self.motion._stroke_shape
        is_place = is_whole(pose) or (isinstance(pose, tuple) and len(pose) == len(shape) and all(map(is_whole, pose)))
        expected = f"a place among {shape or 1} poses is expected, a whole number, or of a grid one for each stroke, (2, 0)"
        require(is_place, f"{self.motion.plan.title}: pose", pose, expected)
        try:
            return int(range(int(np.prod(shape, dtype=int)))[pose] if not isinstance(pose, tuple) else np.ravel_multi_index(pose, shape))
        except (IndexError, ValueError):
            raise DefinitionError(f"{self.motion.plan.title}: there is no pose {pose!r} among {shape or 1} poses.") from None

    def at(self, pose: int) -> Places:
        """Return where every point is at a pose, each of shape (2,) [m]; NaN where it is not reached."""
        return {name: place[:, pose] for name, place in (self.places | self.rims).items()}

    def some(self, count: int) -> list[Places]:
        """Return up to so many poses, spread over those that are reached."""
        return [self.at(pose) for pose in self.picks(count)]

    def picks(self, count: int) -> list[int]:
        """Return the flat indices of up to so many poses, spread over those that are reached."""
        if not self.reached:
            return []
        picks = np.unique(np.linspace(0, len(self.reached) - 1, count).round().astype(int))
        return [self.reached[pick] for pick in picks.tolist()]

    # -- things ----------------------------------------------------------------------------------------

    @cached_property
    def bodies(self) -> tuple[tuple[str, ...], ...]:
        """The points of each moving body; bars that close a triangle are one."""
        found: list[tuple[str, ...]] = []
        for link in [body.points for body in self.motion.plan.bodies if not body.fixed and len(body.points) > 1]:
            member = next((member for member, halved in self._halves if {*member.ends, *halved.points} <= set(link)), None)
            if member is None:
                found.append(link)
            else:  # of a member of two bodies, what stands out of each: the member itself is drawn as it is
                sides = member_sides(self.motion.plan, member.ends, link)
                halves = (tuple(point for point in link if point in side and point not in self.inner) for side in sides)
                found += [points for points in halves if len(points) > 1]
        return rigid_together(found)

    @cached_property
    def _halves(self) -> tuple[tuple[TwoPoint, Halves], ...]:
        """The members of two bodies, with these."""
        plan = self.motion.plan
        found = ((member, member.halves(plan.members)) for member in plan.of_kind(TwoPoint).values())
        return tuple((member, halves) for member, halves in found if halves is not None)

    @cached_property
    def inner(self) -> frozenset[str]:
        """The points that are not drawn: those that members of two bodies hold for themselves, and idle ones."""
        return self.idle.union(point for _, halves in self._halves for point in halves.points)

    @cached_property
    def idle(self) -> frozenset[str]:
        """The fixed points from which numbers alone are taken, such as a place to be reached: nothing is joined to them."""
        plan = self.motion.plan
        numbers = [each for each in plan.members.values() if isinstance(each, (Quantity, Over))]
        joined = {name for each in plan.members.values() if each not in numbers for name in needs(each)}
        asked = {name for each in numbers for name in needs(each)} - joined
        return frozenset(name for name in plan.points if name in asked and name not in plan.moving)

    @cached_property
    def colours(self) -> list[int]:
        """The colour of each moving body, its place in the palette of the style: those of a part are of one family."""
        return style.body_colours([style.part_of_points(points) for points in self.bodies])

    @cached_property
    def letters(self) -> dict[str, str]:
        """The points of parts by their letters in the part with primes, `B'`, where so many dotted names would crowd; nothing else."""
        dotted = [name for name in self.places if "." in name]
        owners = list(dict.fromkeys(name.rpartition(".")[0] for name in dotted))
        signs = {owner: "'" * count if count <= PRIMES else str(count).translate(RAISED) for count, owner in enumerate(owners, 1)}
        short = {name: name.rpartition(".")[2] + signs[name.rpartition(".")[0]] for name in dotted}
        return short if len(dotted) > CROWDED else {}

    @property
    def letter_legend(self) -> list[str]:
        """The meaning of the letters, a part each, `lower: B'`, by the first of its points."""
        owners = {name.rpartition(".")[0]: letter for name, letter in reversed(self.letters.items())}
        return [f"{owner}: {letter}" for owner, letter in reversed(owners.items())]

    @cached_property
    def plates(self) -> tuple[Plate, ...]:
        """The form of each moving body."""
        found, pins = [], set(self.pins)
        for points, places in zip(self.bodies, self._body_places, strict=True):
            joints = [name in pins for name in points]
            shares = np.eye(len(points))[:2] if places is None else shapes.plate_form(places, self.size, joints)
            found.append(Plate(points, shares))
        return tuple(found)

    @cached_property
    def _body_places(self) -> list[FloatArray | None]:
        """Where the points of each moving body stand at one pose, shape (n, 2) [m]; None where no pose is reached."""
        shown = self.some(1)
        return [np.array([shown[0][name] for name in points]) if shown else None for points in self.bodies]

    @cached_property
    def hulls(self) -> tuple[tuple[str, ...], ...]:
        """The outermost points of each moving body, counter-clockwise; two for a straight one."""
        corners = ((0, 1) if places is None else shapes.hull(places) for places in self._body_places)
        return tuple(tuple(points[place] for place in each) for points, each in zip(self.bodies, corners, strict=True))

    @cached_property
    def glyphs(self) -> tuple[tuple[ForceElement, Glyph], ...]:
        """The glyphs of the force elements."""
        plan = self.motion.plan
        return tuple((element, glyph) for element in plan.of_kind(ForceElement).values() for glyph in element.glyphs(plan.members))

    @cached_property
    def two_force(self) -> tuple[TwoForceMember, ...]:
        """The driven lengths and the straight elements; those on the same two points stand side by side, those along a bar beside it.

        The cylinder that is declared on a driven length is that length; one that an element gives, such as a rope, is that element.
        """
        plan = self.motion.plan
        given = {name for name in plan.members if getattr(plan.members.get(name.rpartition(".")[0]), "kind", "") == "load"}
        driven_bars = [bar for bar in plan.cylinders if not given & plan.reaches(bar.length)]
        by_pair = {frozenset((bar.P, bar.Q)): [TwoForceMember(bar.P, bar.Q, "cylinder", joined_names(bar.P, bar.Q))] for bar in driven_bars}
        driven = set(by_pair)
        for element, glyph in self.glyphs:
            pair = frozenset(glyph.points)
            if glyph.drawn_as not in HALF or len(pair) != 2:
                continue
            P, Q = glyph.points
            ends = () if glyph.stages is None else tuple(float(np.ravel(each)[0]) for each in glyph.stages(self.motion))
            drawn = TwoForceMember(P, Q, glyph.drawn_as, element.name, ends=ends)
            if element.holds and pair in driven:
                driven.discard(pair)
                by_pair[pair][0] = drawn if ends else replace(by_pair[pair][0], name=element.name)
            else:
                by_pair.setdefault(pair, []).append(drawn)
        placed = []
        for members in by_pair.values():  # side by side about the line between their points; a single one stays on it
            for place, each in enumerate(members):
                sense = 1.0 if each.P == members[0].P else -1.0
                aside = sense * shapes.APART * (0.5 * (len(members) - 1) - place)
                if not aside and any(self._lies_along(each, points) for points in self.bodies):
                    aside = BESIDE
                placed.append(replace(each, aside=aside))
        return tuple(placed)

    @cached_property
    def _widest(self) -> Scene:
        """The scene of the motion that goes furthest, whose bounds hold for any poses shown."""
        return self if self.over is None else Scene(self.over)

    def _lies_along(self, member: TwoForceMember, points: tuple[str, ...]) -> bool:
        """Return whether two points of another body stand on a member's line at all poses, and a good part of it between them."""
        if {member.P, member.Q} <= set(points) or not self._widest.reached:
            return False
        for at in self._widest.some(5):
            P, along = at[member.P], at[member.Q] - at[member.P]
            length = float(np.hypot(*along))
            if not length > 0.0:
                return False
            rest = np.array([at[name] - P for name in points]) @ np.array([along, shapes.left_of(along)]).T / length
            on = rest[np.abs(rest[:, 1]) < self.size, 0]
            if len(on) < 2 or min(float(on.max()), length) - max(float(on.min()), 0.0) < 0.3 * length:
                return False
        return True

    @cached_property
    def cylinders(self) -> tuple[DrawnCylinder, ...]:
        """The cylinders, each with a piston that stays in its barrel over the stroke, as far as its lengths allow."""
        found = []
        glands = {frozenset(each.ends): halves.points[0] for each, halves in self._halves}  # where the first of two bodies ends
        for member in self.two_force:
            if member.drawn_as != "cylinder" or self._is_telescope(member):
                continue
            P, Q, aside, (short, long) = member.P, member.Q, member.aside * self.size, self._lengths(member.P, member.Q)
            if not long:
                found.append(DrawnCylinder(P, Q, aside))
                continue
            size = min(self.size, 0.12 * short)
            bottom, least = 1.4 * size, 2.0 * size
            outermost = max(0.68 * short, short - 1.2 * size)
            gland = glands.get(frozenset((P, Q)), P)
            ends_at = next((float(np.hypot(*(at[gland] - at[P]))) for at in self.some(1)), 0.0)
            mouth = min(ends_at, outermost) if ends_at else float(np.clip(least + long - short + 1.5 * size, 0.68 * short, outermost))
            found.append(DrawnCylinder(P, Q, aside, bottom, mouth, short - least, least, mouth - 0.9 * size))
        return tuple(found)

    def _is_telescope(self, member: TwoForceMember) -> bool:
        """Return whether a cylinder comes out farther than one stage can."""
        short, long = self._lengths(member.P, member.Q)
        return member.drawn_as == "cylinder" and bool(long) and (bool(member.ends) or shapes.stages(short, long) > 1)

    @cached_property
    def straights(self) -> tuple[DrawnMark, ...]:
        """Springs, dampers, struts and telescopes as lines, the yokes of all that stands beside its pins, and accumulators."""
        found = []
        for member in self.two_force:
            short, long = self._lengths(member.P, member.Q)
            shape = shapes.nested_tubes if self._is_telescope(member) else shapes.OUTLINES.get(member.drawn_as)
            aside, name, on = member.aside * self.size, joined_names(member.P, member.Q), (member.P, member.Q)
            if member.ends and long:  # a mark for each stage, the thinnest first, each moved as far as its stages are out
                shape, (closed, *outs) = None, member.ends
                tubes = shapes.staged_tubes(closed, len(outs), self.size)
                for tube, out in zip(tubes, [*reversed(outs), closed], strict=True):
                    moved = DrawnCylinder(member.P, member.Q, aside, rod=closed, most=out - closed)
                    found.append(DrawnMark(name, on, tuple(line.moved(aside) for line in tube), cylinder=moved))
            lines = [line.moved(aside) for line in shape(short, long, self.size)] if shape and long else []
            lines += shapes.yokes(aside, self.size) if aside else ()
            if lines:
                found.append(DrawnMark(name, on, tuple(lines)))
        return (*found, *self.accumulators, *self.pulleys, *self.ropes)

    @cached_property
    def pulleys(self) -> tuple[DrawnMark, ...]:
        """The pulleys that ropes run over, as circles; small ones where a rope is declared to run over a pin."""
        given = [(glyph.points[0], self._radii(glyph)[0]) for _, glyph in self.glyphs if glyph.drawn_as == "pulley"]
        ropes = [glyph for _, glyph in self.glyphs if glyph.drawn_as == "rope"]
        over = {point: radius for each in ropes for point, radius in zip(each.points[1:-1], self._rope_radii(each)[1:-1], strict=True)}
        given += [(point, ROLLER * self.size) for point, radius in over.items() if abs(radius) == ROLLER * self.size]
        return tuple(DrawnMark(point, (point,), (shapes.circle(radius),), 0.35) for point, radius in given if radius > 0.0)

    @cached_property
    def ropes(self) -> tuple[DrawnMark, ...]:
        """The straight parts of ropes, each a thin line that leaves its pulleys along their tangents."""
        found = []
        for _, glyph in self.glyphs:
            radii = self._rope_radii(glyph) if glyph.drawn_as == "rope" else []
            for (P, p), (Q, q) in pairwise(zip(glyph.points, radii, strict=False)):
                short, long = self._lengths(P, Q)
                if long:
                    found.append(DrawnMark(joined_names(P, Q), (P, Q), (shapes.tangent_line(p, q, 0.5 * (short + long)),), 0.45, 1.1))
        return tuple(found)

    def _rope_radii(self, glyph: Glyph) -> list[float]:
        """Return the signed radii at which a rope is drawn at its points [m]: over a pin that of a small roller on the side it turns to."""
        radii, shown = self._radii(glyph), self.some(1)
        for place in range(1, len(radii) - 1 if shown else 0):
            before, here, after = (shown[0][name] for name in glyph.points[place - 1 : place + 2])
            if radii[place] == 0.0:
                turn = float(shapes.left_of(here - before) @ (after - here))
                radii[place] = ROLLER * self.size * (-1.0 if turn < -1e-9 * self.size**2 else 1.0)
        return radii

    def _radii(self, glyph: Glyph) -> list[float]:
        """Return the signed radii of a glyph's pulleys [m], at the first pose."""
        return [float(np.ravel(np.asarray(each, float))[0]) for each in glyph.radii(self.motion)]

    @cached_property
    def accumulators(self) -> tuple[DrawnMark, ...]:
        """The accumulators of gas-fed lines, each on its cylinder's barrel, on the side where there is room."""
        found = []
        for _, glyph in self.glyphs:
            member = next((each for each in self.two_force if {each.P, each.Q} == set(glyph.points) and each.drawn_as == "cylinder"), None)
            if glyph.drawn_as == "accumulator" and member is not None:
                start = min(2.6 * self.size, 0.3 * self._lengths(member.P, member.Q)[0])
                left = right = 0  # the other points on either side of P -> Q
                for at in self.some(5):
                    along = at[member.Q] - at[member.P]
                    others = [place for name, place in at.items() if name not in (member.P, member.Q) and np.isfinite(place).all()]
                    sides = [float(along[0] * (place - at[member.P])[1] - along[1] * (place - at[member.P])[0]) for place in others]
                    left += sum(each > 0.0 for each in sides)
                    right += sum(each < 0.0 for each in sides)
                across = (member.aside + (1.0 if left < right else -1.0) * HALF["cylinder"] * 0.85) * self.size
                lines = shapes.accumulators(min(max(glyph.count, 1), MOST_SHOWN), start, across, self.size)
                found.append(DrawnMark(joined_names(member.P, member.Q), (member.P, member.Q), lines))
        return tuple(found)

    @cached_property
    def load_marks(self) -> tuple[DrawnMark, ...]:
        """The signs of weights, forces and supports at their points, each kind once a point; of masses and moments at places in bodies."""
        glyphs = [glyph for _, glyph in self.glyphs]
        kinds = dict.fromkeys((each.drawn_as, each.points, each.way) for each in glyphs if each.drawn_as in shapes.MARKS)
        found = [(points, shapes.MARKS[kind](self.size, way)) for kind, points, way in kinds]
        shown = self._widest.some(3)
        on_bodies = dict.fromkeys((each.drawn_as, each.points, each.away) for each in glyphs if each.drawn_as in shapes.ON_BODIES)
        for kind, points, away in on_bodies:
            frames = [(at, *DrawnMark(points[0], points[:2], ()).axes(at)[:2]) for at in shown] if len(points) > 1 else []
            ways = np.array([[axes @ (at[name] - origin) for name in points] for at, origin, axes in frames])
            if ways.size and np.isfinite(ways).all() and np.ptp(ways, axis=0).max() < 1e-6 * self.size:
                place = np.append(0.0, ways[0].mean(axis=0) if away is None else away)
                lines = shapes.ON_BODIES[kind](0.8 * self.size, 0.0)
                found.append((points[:2], tuple(replace(line, rows=line.rows + place) for line in lines)))
        # under the circle of a pin, and over a point's dot
        return tuple(DrawnMark(points[0], points, lines, 0.7 if points[0] in self.pins else 0.9, 0.9) for points, lines in found)

    @cached_property
    def surroundings(self) -> tuple[DrawnMark, ...]:
        """The outlines of the surroundings that the machine declares, with the design's dimensions."""

        def value(quantity: Quantity) -> float:
            return float(np.ravel(np.asarray(self.motion._reading.value(quantity), float))[0])

        found = []
        for name, given in self.motion.plan.of_kind(Outline).items():
            lines = given.lines(value)
            drawn = tuple(shapes.keeping(line, fill="GRID" if given.filled else "", closed=given.closed) for line in lines)
            ends = [np.concatenate([line, line[:1]]) if given.closed else line for line in lines] if given.hatched else []
            hatched = np.concatenate([np.empty((0, 2, 2)), *(shapes.hatches(line, 0.9 * self.size) for line in ends)])
            found.append(DrawnMark(name, given.carriers, drawn, -2.0, 0.9, "AROUND", hatched, given.under(value)))
        return tuple(found)

    @cached_property
    def sections(self) -> tuple[DrawnMark, ...]:
        """The sections of telescopes: each comes out of a body towards a point that a stroke moves along it."""
        found = []
        for point in self.motion.plan.telescopes:
            member = self.motion.plan.points[point]
            origin = member.hangs_from or next((joint.point for joint in member.joints() if joint.arm), "")
            body = next((points for points in self.bodies if origin in points and self._reach(origin, point, points) > 0.0), ())
            if origin and body:
                short, long = self._lengths(origin, point)
                lines = shapes.telescope_sections(short, long, self._reach(origin, point, body), self.size)
                found.append(DrawnMark(origin + point, (origin, point), lines, -0.1))
        return tuple(found)

    def _reach(self, origin: str, point: str, points: tuple[str, ...]) -> float:
        """Return how far a body goes from a point of its own towards one that moves along it [m]; 0 where it leads elsewhere."""
        shown = self.some(1)
        if not shown or point in points:
            return 0.0
        at = shown[0]
        along = (at[point] - at[origin]) / (np.hypot(*(at[point] - at[origin])) or 1.0)
        ways = np.array([at[name] - at[origin] for name in points])
        return max((float(way @ along) for way in ways if abs(way[0] * along[1] - way[1] * along[0]) < self.size), default=0.0)

    @cached_property
    def contours(self) -> tuple[DrawnMark, ...]:
        """The outlines that steps draw themselves, behind the bodies."""
        found = [each for step in self.motion.plan.points.values() for each in step.outline(self.motion._reading)]
        forms = [(each.P, each.Q, shapes.keeping(each.corners.T, fill="ROD", closed=True)) for each in found]
        return tuple(DrawnMark(joined_names(P, Q), (P, Q), (form,), -0.1) for P, Q, form in forms)

    def _lengths(self, P: str, Q: str) -> tuple[float, float]:
        """Return the least and the greatest distance of two points over the motions and the declared strokes' ends [m]; inf, 0 for none."""
        seen = [motion for motion in (self.motion, self.over, self._ends) if motion is not None]
        lengths = np.concatenate([np.hypot(*(motion[Q] - motion[P])).ravel() for motion in seen])
        return float(np.nanmin(lengths, initial=np.inf)), float(np.nanmax(lengths, initial=0.0))

    @cached_property
    def _ends(self) -> Motion:
        """The motion at the corners of the declared strokes."""
        plan = self.motion.plan
        ends = {name: np.array([stroke.start, stroke.end]) for name, stroke in plan.strokes.items()}
        return Motion(plan, self.motion.designs, strokes_over_axes(ends), "nan")

    @cached_property
    def tracks(self) -> tuple[SlideTrack, ...]:
        """The guides that something slides on, then the slots of bodies, each of a step of its own with the pin in it."""
        motion, plan = self.motion, self.motion.plan
        guides, found = plan.of_kind(Guide), list[tuple[str, tuple[str, ...], bool, Callable[[Where], Line]]]()
        for name, guide in guides.items():
            joints = (joint for member in plan.holding.values() for joint in member.joints())
            riders = tuple(dict.fromkeys(joint.point for joint in joints if joint.track == (name,)))
            fixed = set(guide.points) <= set(plan.ground) and (guide.angle is None or not plan.moves(guide.angle))
            found += [(name, riders, fixed, methodcaller("line", guide))] if riders else []
        for name, step in plan.points.items():
            for joint in step.joints():
                if joint.track and joint.line is not None and joint.track[0] not in guides:
                    found.append((f"{name}|slot", (joint.point,), False, joint.line))
        tracks = []
        for name, riders, fixed, line in found:
            there = line(motion._reading)
            origin, along = (
                np.array([np.broadcast_to(np.asarray(each, float), motion.shape).ravel() for each in (vector.x, vector.y)])
                for vector in (there.origin, there.direction)
            )
            tracks.append(SlideTrack(name, origin, along, riders, fixed, line))
        return tuple(tracks)

    @cached_property
    def blocks(self) -> tuple[DrawnMark, ...]:
        """The slider blocks: on a fixed rail above it, in a slot as wide as the slot."""
        found = []
        for track in self.tracks:
            level, half = (0.17, shapes.BLOCK) if track.fixed else (0.32, shapes.SLOT)
            lines = (shapes.tube(0.0, -shapes.LONG * self.size, 0.0, shapes.LONG * self.size, half * self.size, "RULE"),)
            found += [DrawnMark(rider, (rider, *track.ends), lines, level, 1.0) for rider in track.riders]
        return tuple(found)

    @cached_property
    def marks(self) -> tuple[DrawnMark, ...]:
        """All lines on points: surroundings, contours, blocks, cylinders, elements, the signs of loads."""
        cylinders = [cylinder.mark(self.size) for cylinder in self.cylinders]
        return (*self.surroundings, *self.contours, *self.sections, *self.blocks, *cylinders, *self.straights, *self.load_marks)

    @cached_property
    def rims(self) -> Places:
        """The two ends of every track at every pose, shape (2, n) each [m]."""
        found, pad = dict[str, FloatArray](), MARGIN * self.size
        for track, other in zip(self.tracks, self._widest.tracks, strict=True):
            lows, highs = zip(track.travel(self.places), other.travel(self._widest.places), strict=True)
            low, high = (min(lows), max(highs)) if min(lows) <= max(highs) else (0.0, 0.0)
            start, end = track.ends
            found |= {start: track.origin + (low - pad) * track.along, end: track.origin + (high + pad) * track.along}
        return found

    @cached_property
    def stays(self) -> tuple[tuple[str, str], ...]:
        """Pairs that a construction joins and no body does: drawn as thin lines."""
        bodies = [set(body.points) for body in self.motion.plan.links] + [{each.P, each.Q} for each in self.two_force]
        pairs = [(point.hangs_from, name) for name, point in self.motion.plan.points.items() if point.hangs_from]
        return tuple((P, X) for P, X in pairs if not any({P, X} <= body for body in bodies))

    @cached_property
    def _uses(self) -> Counter[str]:
        """How many bodies, cylinders and straight elements each point belongs to."""
        uses = Counter(point for points in self.bodies for point in points)
        uses.update(end for each in self.two_force for end in (each.P, each.Q))
        uses.update(rider for track in self.tracks for rider in track.riders)
        uses.update(point for _, glyph in self.glyphs if glyph.drawn_as == "rope" for point in glyph.points)
        return uses

    @cached_property
    def grounds(self) -> tuple[str, ...]:
        """The points of the frame that something is pinned to."""
        frame = self.motion.plan.links[0].points
        held = {P for P, _ in self.stays}
        return tuple(name for name in frame if self._uses[name] or name in held)

    @cached_property
    def pins(self) -> tuple[str, ...]:
        """The joints: points that two or more bodies, cylinders or straight elements share, or the frame holds."""
        return tuple(name for name in self.places if self._uses[name] > 1 or name in self.grounds)

    @cached_property
    def dots(self) -> tuple[str, ...]:
        """The other points."""
        return tuple(name for name in self.places if name not in self.pins and name not in self.inner)

    @cached_property
    def minor(self) -> frozenset[str]:
        """The points within a body that are only centres of mass or help to construct others: their names are small."""
        inner = {name for points in self.bodies for name in points} - {name for points in self.hulls for name in points}
        heavy = {glyph.points[0] for _, glyph in self.glyphs if glyph.drawn_as == "weight"}
        base = {name for each in self.motion.plan.members.values() if isinstance(each, (Point, Arrow, Quantity)) for name in needs(each)}
        return frozenset(name for name in self.dots if name in inner and name in heavy | base)

    # -- sizes -----------------------------------------------------------------------------------------

    @cached_property
    def extent(self) -> Bounds:
        """The least and greatest x and y of all points over all poses [m]."""
        places = [place for name, place in self.places.items() if name not in self.idle]
        for contour in self.contours:  # the box that it turns in about its first point
            reach = max(float(np.max(np.hypot(*line.rows.T[1:]), initial=0.0)) for line in contour.lines)
            places += [self.places[contour.on[0]] + reach * np.array([[x], [y]]) for x, y in product((-1.0, 1.0), repeat=2)]
        every = np.concatenate([np.empty((2, 0)), *places], axis=1)
        every = every[:, np.isfinite(every).all(axis=0)]
        ensure(every.size, f"{self.motion.plan.title}: there is nothing to draw, no point stands anywhere.")
        low, high = every.min(axis=1), every.max(axis=1)
        if float(np.max(high - low)) > WIDE:
            said = f"{self.motion.plan.title} is {float(np.max(high - low)):.4g} m across; lengths are in m"
            warnings.warn(f"{said}, write 500 * mm if these are millimetres.", stacklevel=2)
        return float(low[0]), float(high[0]), float(low[1]), float(high[1])

    @cached_property
    def size(self) -> float:
        """The radius of a bar's round end [m]: a small share of the whole, smaller where pins stand close."""
        left, right, bottom, top = self.extent
        whole = float(np.hypot(right - left, top - bottom)) or 1.0
        pairs = [(P, Q) for points in self.bodies for P in points for Q in points if P < Q]
        gaps = [float(np.hypot(*(self.places[P] - self.places[Q])[:, pose])) for pose in self.picks(3) for P, Q in pairs]
        return float(np.clip(0.3 * min((gap for gap in gaps if gap > 0), default=np.inf), 0.0055 * whole, 0.0125 * whole))

    def box(self, margin: float = 5.0) -> Bounds:
        """Return the extent with a margin around it, in sizes [m], and as much of the surroundings as leaves the mechanism large."""
        left, right, bottom, top = self.extent
        pad, near = margin * self.size, 2.5 * self.size
        ends = np.concatenate([np.empty((2, 0)), *self.rims.values()], axis=1)
        ends = ends[:, np.isfinite(ends).all(axis=0)]
        (x0, y0), (x1, y1) = np.min(ends - near, axis=1, initial=np.inf), np.max(ends + near, axis=1, initial=-np.inf)
        own = min(left - pad, float(x0)), max(right + pad, float(x1)), min(bottom - pad, float(y0)), max(top + pad, float(y1))
        outside = (*self.accumulators, *self.pulleys)  # these stand outside the points that carry them
        corners = np.concatenate([np.empty((0, 2)), *(each.placed(each.corners, at) for at in self.some(5) for each in outside)])
        return self._grown(self._grown(own, corners, 1.0), self._around(), SHARE)

    def _grown(self, box: Bounds, points: FloatArray, share: float) -> Bounds:
        """Return a box that holds some points as well, each side moved by a share of the box's larger side at most.

        What sticks out a little farther is not cut off: it may take half as much again.
        """
        if not points.size:
            return box
        left, right, bottom, top = box
        most, pad = share * max(right - left, top - bottom), 2.0 * self.size
        (x0, y0), (x1, y1) = points.min(axis=0) - pad, points.max(axis=0) + pad
        wanted = np.maximum([left - x0, x1 - right, bottom - y0, y1 - top], 0.0)
        out_left, out_right, down, up = np.where(wanted <= 1.5 * most, wanted, most).tolist()
        return left - out_left, right + out_right, bottom - down, top + up

    def _around(self) -> FloatArray:
        """Return the points of the surroundings that the sheet should show, shape (n, 2) [m]: of an open line the nearest ones alone."""
        left, right, bottom, top = self.extent
        found = [np.empty((0, 2))]
        for piece in self.surroundings:
            for at in self.some(5) if piece.on else self.some(1):
                if not np.isfinite([at[name] for name in piece.on]).all():
                    continue
                closed = [line.rows[:, 1:] for line in piece.lines if line.closed or piece.on]
                closed += [piece.under[1]] if piece.under else []
                found += [piece.placed(line, at) for line in closed]
                for line in (each.rows[:, 1:] for each in piece.lines if not each.closed and not piece.on):
                    dense = np.concatenate([np.linspace(start, end, 60) for start, end in pairwise(line)])
                    inside = dense[(dense[:, 0] >= left) & (dense[:, 0] <= right)]
                    away = np.hypot(*(dense - np.clip(dense, (left, bottom), (right, top))).T)
                    found.append(inside if len(inside) else dense[[int(np.argmin(away))]])
        return np.concatenate(found)


SHARE = 0.3
"""How far each side of the sheet moves outwards for what stands around, as a share of the mechanism's own larger side."""
BESIDE = 2.6
"""How far beside a bar an element stands that would cover it, in sizes."""
ROLLER = 1.6
"""The radius of the roller that is drawn where a rope runs over a pin, in sizes."""
MOST_SHOWN = 4
"""The accumulators of a line that are drawn."""


def rigid_together(bodies: list[tuple[str, ...]]) -> tuple[tuple[str, ...], ...]:
    """Return bodies with those united that hold each other: two that share two points, three that are pinned in a triangle."""
    found = list(bodies)
    while True:
        shared = {(one, other): set(one) & set(other) for one, other in combinations(found, 2)}
        pairs = (pair for pair, pins in shared.items() if len(pins) > 1)
        triangles = (
            each
            for each in combinations(found, 3)
            if all(pins := [shared[pair] for pair in combinations(each, 2)]) and len(set().union(*pins)) == 3
        )
        one = next(chain(pairs, triangles), None)
        if one is None:
            return tuple(found)
        place = found.index(one[0])
        together = tuple(dict.fromkeys(point for body in one for point in body))
        found = [*found[:place], together, *(body for body in found[place:] if body not in one)]
