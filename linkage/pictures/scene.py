"""What there is to draw in a motion, without a drawing library: bodies, cylinders, pins, and where they are."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import cached_property, partial
from itertools import product
from typing import TypeAlias, final

import numpy as np

from ..errors import DefinitionError
from ..loads import TwoPoint
from ..motion import Motion, require_motion
from ..program import FloatArray
from ..quantities import Joint, Where
from ..steps import Guide
from ..vectors import Line
from .shapes import APART, HALF, OUTLINES, Outline, hull, turning_with, yokes

# What points slide along: fixed rails and slots on moving bodies, each as long as the travel asks.

MARGIN = 3.2
"""How far a track goes on beyond the travel, in sizes."""


@final
@dataclass(frozen=True, eq=False)
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

    def placed(self, travel: tuple[float, float], size: float) -> dict[str, FloatArray]:
        """Return the two ends at every pose, shape (2, n) each [m], for a travel and a margin of so many sizes [m]."""
        low, high = travel if travel[0] <= travel[1] else (0.0, 0.0)
        start, end = self.ends
        pad = MARGIN * size
        return {start: self.origin + (low - pad) * self.along, end: self.origin + (high + pad) * self.along}


def slide_tracks(motion: Motion) -> tuple[SlideTrack, ...]:
    """Return the tracks that something slides on."""
    return (*guides(motion), *slots(motion))


def guides(motion: Motion) -> Iterator[SlideTrack]:
    """Yield the guides that points slide on."""
    plan = motion.plan
    for name, guide in plan.of_kind(Guide).items():
        riders = tuple(dict.fromkeys(joint.point for joint in slide_joints(motion) if joint.track == (name,)))
        if riders:
            fixed = set(guide.points) <= set(plan.ground) and (guide.angle is None or not plan.moves(guide.angle))
            line = motion._reading.line(guide)
            origin, along = pose_rows(motion, line.origin.x, line.origin.y), pose_rows(motion, line.direction.x, line.direction.y)
            yield SlideTrack(name, origin, along, riders, fixed, partial(reading_line, guide))


def reading_line(guide: Guide, where: Where) -> Line:
    """Return a guide's line."""
    return where.line(guide)


def slots(motion: Motion) -> Iterator[SlideTrack]:
    """Yield the slots of bodies: each of a step of its own, with the pin in it."""
    guides = motion.plan.of_kind(Guide)
    for name, step in motion.plan.points.items():
        for joint in step.joints():
            if joint.track and joint.line is not None and joint.track[0] not in guides:
                line = joint.line(motion._reading)
                along = pose_rows(motion, line.direction.x, line.direction.y)
                yield SlideTrack(f"{name}|slot", pose_rows(motion, line.origin.x, line.origin.y), along, (joint.point,), False, joint.line)


def slide_joints(motion: Motion) -> Iterator[Joint]:
    """Yield all joints that points slide in, driven or not."""
    return (joint for member in motion.plan.holding.values() for joint in member.joints() if joint.track)


def pose_rows(motion: Motion, x: object, y: object) -> FloatArray:
    """Return two components over all poses, shape (2, n)."""
    return np.array([np.broadcast_to(np.asarray(each, float), motion.shape).ravel() for each in (x, y)])


Places: TypeAlias = dict[str, FloatArray]
Bounds: TypeAlias = tuple[float, float, float, float]


@final
@dataclass(frozen=True)
class Hung:
    """A two-force member from P to Q: what it is drawn as, and how far to the left of P -> Q, in sizes, where others share its points."""

    P: str
    Q: str
    drawn_as: str
    aside: float = 0.0

    @property
    def half(self) -> float:
        """Half the width of what it covers about P -> Q, in sizes."""
        return HALF[self.drawn_as] + abs(self.aside)


@final
@dataclass(frozen=True, eq=False)
class Straight:
    """Lines from P to Q that stretch with the distance."""

    P: str
    Q: str
    lines: tuple[Outline, ...]


@final
@dataclass(frozen=True)
class Ram:
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


@final
@dataclass(frozen=True, eq=False)
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
        if self.motion._design_shape:
            raise DefinitionError(
                f"{plan.title}: this motion holds {np.prod(self.motion._design_shape)} designs and a picture shows one; "
                "draw them one at a time, each dimension a single number."
            )
        flat = {name: self.motion[name].reshape(2, -1) for name in plan.points}
        object.__setattr__(self, "places", flat)

    # -- poses -----------------------------------------------------------------------------------------

    @cached_property
    def reached(self) -> list[int]:
        """The poses that can be assembled, as flat indices."""
        return [int(index) for index in np.flatnonzero(self.motion.reached.ravel())]

    def index(self, pose: int | tuple[int, ...]) -> int:
        """Return the flat index of a pose; DefinitionError where there is none such."""
        shape = self.motion._stroke_shape
        try:
            return int(range(int(np.prod(shape, dtype=int)))[pose] if isinstance(pose, int) else np.ravel_multi_index(pose, shape))
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
        """The points of each moving body."""
        return tuple(body.points for body in self.motion.plan.links if not body.fixed and len(body.points) > 1)

    @cached_property
    def hulls(self) -> tuple[tuple[str, ...], ...]:
        """The outermost points of each moving body, counter-clockwise; two for a straight one."""
        shown = self.some(1)
        if not shown:
            return tuple(points[:2] for points in self.bodies)
        return tuple(tuple(points[i] for i in hull(np.array([shown[0][name] for name in points]))) for points in self.bodies)

    @cached_property
    def hung(self) -> tuple[Hung, ...]:
        """The driven lengths and the straight elements; those on the same two points stand side by side.

        The cylinder that is declared on a driven length is that length.
        """
        plan = self.motion.plan
        by_pair = {frozenset((bar.P, bar.Q)): [Hung(bar.P, bar.Q, "cylinder")] for bar in plan.cylinders}
        driven = set(by_pair)
        for element in plan.of_kind(TwoPoint).values():
            pair = frozenset(element.ends)
            if element.holds and pair in driven:
                driven.discard(pair)
            else:
                by_pair.setdefault(pair, []).append(Hung(*element.ends, element.drawn_as))
        return tuple(each for members in by_pair.values() for each in side_by_side(members))

    @cached_property
    def rams(self) -> tuple[Ram, ...]:
        """The cylinders."""
        return tuple(self._ram(each) for each in self.hung if each.drawn_as == "cylinder")

    def _ram(self, hung: Hung) -> Ram:
        """Return a cylinder whose piston stays in its barrel over the stroke, as far as its lengths allow."""
        aside, (short, long) = hung.aside * self.size, self._lengths(hung)
        if not long:
            return Ram(hung.P, hung.Q, aside)
        size = min(self.size, 0.12 * short)
        bottom, least = 1.4 * size, 2.0 * size
        mouth = float(np.clip(least + long - short + 1.5 * size, 0.68 * short, max(0.68 * short, short - 1.2 * size)))
        return Ram(hung.P, hung.Q, aside, bottom, mouth, short - least, least, mouth - 0.9 * size)

    @cached_property
    def straights(self) -> tuple[Straight, ...]:
        """Springs, dampers and struts as lines, and the yokes of all that stands beside its pins."""
        found = []
        for hung in self.hung:
            short, long = self._lengths(hung)
            shape = OUTLINES.get(hung.drawn_as)
            aside = hung.aside * self.size
            lines = [line.moved(aside) for line in shape(short, long, self.size)] if shape and long else []
            lines += yokes(aside, self.size) if aside else ()
            if lines:
                found.append(Straight(hung.P, hung.Q, tuple(lines)))
        return tuple(found)

    @cached_property
    def contours(self) -> tuple[Straight, ...]:
        """What steps draw of themselves, behind the bodies."""
        found = [each for step in self.motion.plan.points.values() for each in step.outline(self.motion._reading)]
        return tuple(Straight(each.P, each.Q, (turning_with(each),)) for each in found)

    def _lengths(self, hung: Hung) -> tuple[float, float]:
        """Return the least and the greatest distance of two points over the motions and the declared strokes' ends [m]; inf, 0 for none."""
        seen = [motion for motion in (self.motion, self.over, self._ends) if motion is not None]
        lengths = np.concatenate([np.hypot(*(motion[hung.Q] - motion[hung.P])).ravel() for motion in seen])
        return float(np.nanmin(lengths, initial=np.inf)), float(np.nanmax(lengths, initial=0.0))

    @cached_property
    def _ends(self) -> Motion:
        """The motion at the corners of the declared strokes."""
        plan = self.motion.plan
        corners = np.array(list(product(*((stroke.start, stroke.end) for stroke in plan.strokes.values()))))
        values = {name: corners[:, column] for column, name in enumerate(plan.strokes)}
        return Motion(plan, self.motion.designs, values, "nan")

    @cached_property
    def tracks(self) -> tuple[SlideTrack, ...]:
        """The guides and slots that something slides on."""
        return slide_tracks(self.motion)

    @cached_property
    def rims(self) -> Places:
        """The two ends of every track at every pose, shape (2, n) each [m]."""
        wide = [] if self.over is None else list(zip(slide_tracks(self.over), self.tracks, strict=True))
        reach = {track.name: track.travel(self.places) for track in self.tracks}
        for other, track in wide:
            low, high = other.travel(Scene(self.over).places) if self.over is not None else reach[track.name]
            reach[track.name] = min(low, reach[track.name][0]), max(high, reach[track.name][1])
        placed = [track.placed(reach[track.name], self.size) for track in self.tracks]
        return {name: place for each in placed for name, place in each.items()}

    @cached_property
    def stays(self) -> tuple[tuple[str, str], ...]:
        """Pairs that a construction joins and no body does: drawn as thin lines."""
        bodies = [set(body.points) for body in self.motion.plan.links] + [{each.P, each.Q} for each in self.hung]
        pairs = [(point.hangs_from, name) for name, point in self.motion.plan.points.items() if point.hangs_from]
        return tuple((P, X) for P, X in pairs if not any({P, X} <= body for body in bodies))

    @cached_property
    def _uses(self) -> Counter[str]:
        """How many bodies, cylinders and straight elements each point belongs to."""
        uses = Counter(point for points in self.bodies for point in points)
        uses.update(end for each in self.hung for end in (each.P, each.Q))
        uses.update(rider for track in self.tracks for rider in track.riders)
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
        return tuple(name for name in self.places if name not in self.pins)

    # -- sizes -----------------------------------------------------------------------------------------

    @cached_property
    def extent(self) -> Bounds:
        """The least and greatest x and y of all points over all poses [m]."""
        every = np.concatenate([np.empty((2, 0)), *self.places.values(), *map(self._swept, self.contours)], axis=1)
        every = every[:, np.isfinite(every).all(axis=0)]
        if not every.size:
            raise DefinitionError(f"{self.motion.plan.title}: there is nothing to draw, no point stands anywhere.")
        low, high = every.min(axis=1), every.max(axis=1)
        return float(low[0]), float(high[0]), float(low[1]), float(high[1])

    def _swept(self, contour: Straight) -> FloatArray:
        """Return the box that a contour turns in about its first point, its corners at every pose, shape (2, n) [m]."""
        reach = max(float(np.max(np.hypot(*line.rows.T[1:]), initial=0.0)) for line in contour.lines)
        return np.concatenate([self.places[contour.P] + reach * np.array([[x], [y]]) for x, y in product((-1.0, 1.0), repeat=2)], axis=1)

    @cached_property
    def size(self) -> float:
        """The radius of a bar's round end [m]: a small share of the whole, smaller where pins stand close."""
        left, right, bottom, top = self.extent
        whole = float(np.hypot(right - left, top - bottom)) or 1.0
        return float(np.clip(0.3 * self._nearest, 0.0055 * whole, 0.0125 * whole))

    @cached_property
    def _nearest(self) -> float:
        """The least distance of two joined points [m]."""
        pairs = [(P, Q) for points in self.bodies for P in points for Q in points if P < Q]
        gaps = [float(np.hypot(*(self.places[P] - self.places[Q])[:, pose])) for pose in self.picks(3) for P, Q in pairs]
        return min((gap for gap in gaps if gap > 0), default=np.inf)

    def box(self, margin: float = 5.0) -> Bounds:
        """Return the extent with a margin around it, in sizes [m]."""
        left, right, bottom, top = self.extent
        pad, near = margin * self.size, 2.5 * self.size
        ends = np.concatenate([np.empty((2, 0)), *self.rims.values()], axis=1)
        ends = ends[:, np.isfinite(ends).all(axis=0)]
        (x0, y0), (x1, y1) = np.min(ends - near, axis=1, initial=np.inf), np.max(ends + near, axis=1, initial=-np.inf)
        return min(left - pad, float(x0)), max(right + pad, float(x1)), min(bottom - pad, float(y0)), max(top + pad, float(y1))


def side_by_side(members: list[Hung]) -> list[Hung]:
    """Return members on the same two points side by side about the line between these; a single one stays on it."""
    middle = 0.5 * (len(members) - 1)
    placed = []
    for place, each in enumerate(members):
        sense = 1.0 if each.P == members[0].P else -1.0
        placed.append(Hung(each.P, each.Q, each.drawn_as, sense * APART * (middle - place)))
    return placed
