"""Motions looked at along one stroke: the limits of a design, and change points between the poses of a sweep.

Every loop tells how far it is from its dead point: the squared sine of the angle between its links, which is negative where they do not
reach, or the sine of the angle between its guides. It is a function of the stroke, on a grid of its own that does not depend on the poses.
An interval is dismissed if the lower of its ends is above twice what the function bends there. Else it is divided by eight, down to 1e-9 of
the way.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Sequence
from functools import cached_property

import numpy as np

from ..errors import AssemblyError, SingularError, ensure, unwarned
from ..frozen import immutable, record
from ..loads import ForceElement, TwoPoint
from ..numeric.line import CLOSE, SAMPLES, Curve, Index, highest, last_holding, samples, sign_changes, stretches
from ..plan import Loop, Mask, Plan, failures, missing_words, name_or_pins, opening
from ..program import FloatArray, Kernel, Level, RunOptions
from ..quantities import Distance
from ..steps import Point
from ..units import deg
from .grid import Grid, MotionLike, recalled
from .limits import Extreme, Interval, Limits, Open, StrokeLimits, assembly_error, stroke_number, stroke_text, stroke_unit, where_words
from .requests import transmission
from .strokes import TURN, check_any

KEPT = 64
"""The designs of a plan whose clear stretches are kept."""
LOOKED_AT = 1441
"""Values of a stroke at which it is looked for reachable ranges."""
UNCHANGED = 1e-9
"""A transmission angle that changes by less [rad] does not follow the stroke."""
TURNS_AFTER = 6
"""Turns of a crank after which it is looked whether pins have returned."""
CLOSED = 1e-6
"""Pins that are so near to where they began, compared with the linkage, have returned."""
NEAR = 1e-8
"""How far beside a root it is looked whether the ratio really passes zero, and how far beyond a range's ends for roots on these, of the
range; at a pole the ratio grows instead."""
LOOKS = 65
"""Poses of each range at which it is looked whether a length follows the stroke."""
STILL = 1e-9
"""A length that changes by less than this part of its ends' way does not follow a stroke."""
SETTLED = 1e-12
"""How far before the end of a group's way its last pose is told, of the stroke: where it ends follows its steps by so much."""
AGAIN = 1e-6
"""Poses whose points are so near to each other, compared with the linkage, are one, as after a full turn."""


def limits(motion: MotionLike, along: Iterable[str] | None = None) -> Limits:
    """Return the limits along every stroke of one design, or `along` some; other strokes are held at the motion's first values."""
    title, shape = motion.plan.title, motion._design_shape
    ensure(not motion._design_shape, f"{title}: limits are worked out for one design at a time; this motion has {shape}.")
    check_any(motion.strokes, motion.plan)
    held = {name: float(np.ravel(value)[0]) for name, value in motion.strokes.items()}
    lines = {name: StrokeLine(motion, name, held) for name in (motion.strokes if along is None else along)}
    return Limits({name: recalled(motion, ("limits", name), line.stroke_limits, of_places=True) for name, line in lines.items()})


@immutable
class StrokeLine:
    """One design along one stroke, the others held."""

    motion: MotionLike
    name: str
    held: dict[str, float]

    @property
    def plan(self) -> Plan:
        """The machine."""
        return self.motion.plan

    @property
    def unit(self) -> str:
        """The unit of the stroke."""
        return stroke_unit(self.plan, self.name)

    def motion_at(self, values: FloatArray) -> MotionLike:
        """Return the motion at values of the stroke, unreachable poses as NaN."""
        return self.motion.moved({**self.held, self.name: values})

    def stroke_limits(self) -> StrokeLimits:
        """Return the limits, looked for one span beyond the declared range, a crank over a full turn."""
        plan, name, unit = self.plan, self.name, self.unit
        stroke = plan.strokes[name]
        start, end = min(stroke.start, stroke.end), max(stroke.start, stroke.end)
        beyond = max(0.0, np.pi - 0.5 * (end - start)) if unit == "rad" else end - start
        low, high = start - beyond, end + beyond
        around = 0.0 if beyond else 0.01 * (end - start)  # a crank may begin its turn at a change point
        near = 1e-6 * (high - low)
        between = [each for each in self.interruptions(low - around, high + around) if each.high >= low - near and each.low <= high + near]
        gaps = [each.deepest for each in between if each.is_gap]  # they may lie between samples
        at = np.linspace(low, high, LOOKED_AT)
        reached = np.concatenate([self.motion_at(at).reached, np.zeros(len(gaps), bool)])
        at = np.concatenate([at, gaps])
        order = np.argsort(at, kind="stable")
        found = self.ranges_among(at[order], reached[order])
        crossings = tuple((each.deepest, name_or_pins(plan, each.step)) for each in between if not each.is_gap)
        others = tuple((each, value, stroke_unit(plan, each)) for each, value in self.held.items() if each != name)
        least, turns = self.least_transmission(found), self.open_turn(found) if unit == "rad" else None
        still = tuple(self.dead_points([(each.low, each.high) for each in found]))
        return StrokeLimits(name, unit, stroke.start, stroke.end, tuple(found), crossings, least, others, turns, still)

    # -- the ends of what is reached ----------------------------------------------------------------------

    def ranges_among(self, at: FloatArray, reached: Mask) -> list[Interval]:
        """Return the reachable ranges among samples, with their ends."""
        places = [(end, end + step) for first, last in stretches(reached) for end, step in ((first, -1), (last, 1))]
        within = [(inside, outside) for inside, outside in places if 0 <= outside < len(at)]
        ends = dict(zip(within, self.ends_of_reach([(float(at[inside]), float(at[outside])) for inside, outside in within]), strict=True))
        found = [ends.get(place, (float(at[place[0]]), "")) for place in places]
        return [Interval(low[0], high[0], low[1], high[1]) for low, high in zip(found[::2], found[1::2], strict=True)]

    def ends_of_reach(self, pairs: Sequence[tuple[float, float]]) -> list[tuple[float, str]]:
        """Return the last strokes reached between one inside and one outside each, and the steps that fail beyond them.

        Ends of groups are known already, found on the way. The others are looked for together.
        """
        found, stroke = np.array(pairs, float).reshape(-1, 2), self.plan.strokes[self.name]
        sought, before = np.full(len(found), not self.plan.groups), SETTLED * abs(stroke.end - stroke.start)
        for k, (inside, outside) in enumerate(pairs if self.plan.groups else ()):
            at = np.linspace(inside, outside, 65)
            seen = self.motion_at(at)
            known = [stop for stop in seen._grid.solved.stops if min(inside, outside) <= stop <= max(inside, outside)]
            sought[k] = not known and not np.all(seen.reached)
            last = float(np.clip(inside, known[0] - before, known[0] + before)) if known else inside
            found[k] = (last, at[int(np.argmin(seen.reached))]) if known else (inside, outside if sought[k] else np.nan)
        if sought.any():
            found[sought] = np.transpose(last_holding(self.is_reached, *found[sought].T))
        ends = list[tuple[float, str]]()
        for (inside, _), (last, beyond) in zip(pairs, found, strict=True):
            failing = list[str]()
            if not np.isnan(beyond):
                there = self.motion_at(beyond + np.array([0.0, before * np.sign(beyond - inside)]))  # to rounding several may end there
                failing = [name for name, _ in failures(self.plan, there._reading, there.shape)]
                failing = [name for name in failing if self.plan.reaches(name).isdisjoint({*failing} - {name})] or failing[:1]
            stops = dict.fromkeys(name_or_pins(self.plan, name) for name in failing)
            ends.append((self.clear_end(inside, float(last), failing), ", ".join(stops)))
        return ends

    def clear_end(self, inside: float, last: float, steps: Sequence[str]) -> float:
        """Return the last stroke at which the links of some steps meet by themselves, which rounding does up to `last`."""
        rows = [row for row, loop in enumerate(self.clearances.loops) if loop.step in steps and loop.kind == "links"]

        def is_clear(at: FloatArray) -> Mask:
            return np.reshape((self.seen(np.ravel(at))[rows] >= 0.0).all(axis=0), np.shape(at))

        if not rows or is_clear(np.array(last)) or not is_clear(np.array(inside)):
            return last
        return float(last_holding(is_clear, inside, last)[0])

    def is_in_line(self, value: float, steps: Collection[str]) -> bool:
        """Return whether each of some steps has come to its dead point at a value of the stroke."""
        seen = zip(self.clearances.loops, self.seen(np.array([value])), strict=True)
        return set(steps) <= {loop.step for loop, clear in seen if abs(clear.item()) <= TOUCH}

    def is_reached(self, at: FloatArray) -> Mask:
        """Return the mask of strokes that are reached, of any shape."""
        return np.reshape(self.motion_at(np.ravel(at)).reached, np.shape(at))

    # -- the least transmission angles: of every dyad whose angle changes with the stroke ------------------

    def least_transmission(self, found: Sequence[Interval]) -> tuple[Extreme, ...]:
        """Return the least transmission angle of every dyad that moves with the stroke, over its declared and reachable part."""
        declared = self.plan.strokes[self.name]
        start, end = sorted((declared.start, declared.end))
        parts = np.array([(max(each.low, start), min(each.high, end)) for each in found if each.low < end and each.high > start])
        if not parts.size:
            return ()
        low, high, long = parts[:, 0], parts[:, 1], np.ptp(parts, axis=1)
        counts = [max(int(np.ceil(SAMPLES * each)), 2) for each in long / (end - start)]

        def stroke(leg: Index, t: FloatArray) -> FloatArray:
            return np.where(t == 1.0, high[leg], low[leg] + long[leg] * t)

        def look(leg: Index, t: FloatArray) -> tuple[FloatArray, Mask]:
            wide = self.motion_at(stroke(leg, t).ravel())
            return -np.array([[transmission(joint).of(wide)] for joint in moving]), wide.reached[None]

        wide = self.motion_at(stroke(*samples(counts)))
        angles = {joint: wide.transmission_angle(joint) for joint in wide._joints}
        moving = [joint for joint, angle in angles.items() if np.nanmax(angle) - np.nanmin(angle) > UNCHANGED]
        if not moving:
            return ()
        least = highest(look, counts)
        strokes = stroke(least.leg, least.t)
        return tuple(Extreme(joint, -float(least.value[row, 0]), float(strokes[row, 0])) for row, joint in enumerate(moving))

    def open_turn(self, found: Sequence[Interval]) -> Open | None:
        """Return the pins that do not return after one turn of the stroke [rad], and how many turns they take; None where all do.

        A dyad returns with its parents, because its side holds. A group of class III has up to six poses for one pose of its drive, and a
        full turn may lead from one to another. Source: T. R. Chase, J. A. Mirth, Circuits and branches of single-degree-of-freedom planar
        linkages, J. Mech. Design 115 (1993) 223-230.
        """
        plan = self.plan
        pins = [pin for group in plan.groups.values() for pin in group.pins if self.name in plan.reaches(pin)]
        whole = next((each for each in found if each.high - each.low > TURN * (1.0 - 1e-9)), None)
        if not pins or whole is None:
            return None
        turned = self.motion_at(np.asarray(whole.low + TURN * np.arange(TURNS_AFTER + 1), float))
        every = np.array([turned[point][:, 0] for point in plan.points])
        gaps = {pin: np.hypot(*(turned[pin] - turned[pin][:, :1])) / np.ptp(every, axis=0).max() for pin in pins}
        away = tuple(pin for pin, gap in gaps.items() if gap[1] > CLOSED)
        back = np.all([gaps[pin] <= CLOSED for pin in pins], axis=0)
        return Open(away, int(np.argmax(back[1:])) + 1 if back[1:].any() else 0) if away else None

    # -- dead points of cylinders: where a length stands still, so that its thrust moves nothing -----------

    def dead_points(self, ranges: Sequence[tuple[float, float]]) -> list[tuple[float, str]]:
        """Return where in some ranges lengths of elements that hold stand still: the stroke and the element's name.

        Those whose two points a stroke drives apart never do, and what a closed line alone holds drives nothing. The others are held.
        """
        plan, wrt = self.plan, self.name
        ranges = [(low, high) for low, high in ranges if low < high]
        if not ranges:
            return []
        driven = {frozenset((bar.P, bar.Q)) for bar in plan.cylinders}
        ties = [tie for tie in (each.tie(plan.members) for each in plan.of_kind(ForceElement).values()) if tie is not None]
        shut, held = ({share.member.name for tie in ties if tie.held is way for share in tie.shares} for way in (False, True))
        known = {name: each for name, each in plan.of_kind(TwoPoint).items() if each.holds and name not in shut - held}
        moved = {name: each for name, each in known.items() if any(wrt in plan.reaches(end) for end in each.ends)}
        elements = {name: each for name, each in moved.items() if frozenset(each.ends) not in driven}
        if not elements:
            return []
        looked = self.motion_at(np.concatenate([np.linspace(low, high, LOOKS) for low, high in ranges]))
        found: list[tuple[float, str]] = []
        for name, element in elements.items():
            length = Distance(*element.ends)

            def rate(at: FloatArray, length: Distance = length) -> FloatArray:
                with unwarned(), np.errstate(all="ignore"):
                    return self.motion_at(at).ratio(length, wrt=wrt)

            with unwarned(), np.errstate(all="ignore"):
                way = sum(np.hypot(*looked.ratio(end, wrt=wrt)) for end in element.ends)
                follows = np.abs(looked.ratio(length, wrt=wrt)) > STILL * way  # that between two points of a body does not
            if np.any(follows):
                at = np.array(sorted(root for low, high in ranges for root in roots_between(rate, low, high)))
                if at.size > 1:  # those that give a pose which no one before gives
                    poses = self.motion_at(at)
                    places = np.array([poses[point] for point in plan.points]).reshape(-1, at.size)
                    apart = np.abs(places[:, :, None] - places[:, None, :]).max(axis=0)
                    size = float(np.ptp(places.reshape(-1, 2, at.size), axis=0).max(initial=0.0))
                    at = at[~np.tril(apart <= AGAIN * size, -1).any(axis=1)]
                found += [(float(each), name) for each in at]
        return sorted(found)

    # -- the way between poses: where a loop comes to its dead point, and where it cannot be assembled -------

    @cached_property
    def clearances(self) -> Clearances:
        """The loops that move, with how clear of their dead points they are."""
        return self.plan.made("clearances", Clearances.for_plan)

    def kernel_values(self, kernel: Kernel, x: FloatArray) -> FloatArray:
        """Return a kernel's values at values of the stroke, shape (outputs, n)."""
        strokes = {name: x if name == self.name else np.full(x.shape, self.held[name]) for name in self.plan.strokes}
        return Grid(self.plan, self.motion._grid.flat_designs, strokes).kernel_result(kernel, way=ON_ARRAYS).values[:, 0]

    def seen(self, x: FloatArray) -> FloatArray:
        """Return the clearance of every loop, shape (loops, n): squared sines of links, sines of guides without a sign, lengths [m]."""
        found = self.kernel_values(self.clearances.kernel, x)
        return np.where(self.clearances.is_signed, np.abs(found), found)

    def grid(self, low: float, high: float) -> FloatArray:
        """Return the values at which a way is looked at first."""
        turns = (high - low) / (2.0 * np.pi) if self.name in self.plan.turning else 1.0
        return np.asarray(low + (high - low) * np.linspace(0.0, 1.0, GRID * max(1, int(np.ceil(turns))) + 1))

    def interruptions(self, low: float, high: float) -> tuple[Interruption, ...]:
        """Return the interruptions between two values of the stroke, in their order."""
        if not (self.clearances.loops and high > low):
            return ()
        x = self.grid(low, high)
        seen = self.seen(x)
        with np.errstate(invalid="ignore"):
            bends = np.abs(seen[:, 2:] - 2.0 * seen[:, 1:-1] + seen[:, :-2])
        if seen.min() > BENDS * bends.max() + TOUCH or np.all(seen.min(axis=1) > BENDS * bends.max(axis=1) + TOUCH):
            return ()
        return self._narrowed(x, seen, bends)

    def _narrowed(self, x: FloatArray, seen: FloatArray, bends: FloatArray) -> tuple[Interruption, ...]:
        """Return the interruptions, narrowed down from the grid."""
        sizes = self.kernel_values(self.clearances.rounding, x)
        noise = ROUNDING * np.fmax.reduce(np.abs(sizes), axis=1, initial=1.0)[:, None]  # how far rounding moves a clearance at the most
        tops = np.fmax.reduce(seen, axis=1)
        tells = np.array([loop.kind != "length" for loop in self.clearances.loops])
        level = np.where([[loop.kind == "links"] for loop in self.clearances.loops], TOUCH**2, 2.0 * DEPTH * tops[:, None])
        level = np.where(tells[:, None], np.maximum(level, noise), 0.0)
        still = tops <= 4.0 * level[:, 0]
        if still.any():  # in line all the way, as a rod that is straight; or the way is so short
            stroke = self.plan.strokes[self.name]
            wide = self.seen(self.grid(min(stroke.start, stroke.end), max(stroke.start, stroke.end)))
            still &= ~(np.fmax.reduce(wide, axis=1) > 4.0 * level[:, 0])
        places, values = divided(self.seen, x, seen, bends, noise, ~still)
        found: list[Interruption] = []
        for row in np.flatnonzero(~still).tolist():
            found += self._of_loop(row, places, values[row], float(level[row, 0]), float(noise[row, 0]))
        return tuple(sorted(found, key=lambda each: each.low))

    def _of_loop(self, row: int, x: FloatArray, seen: FloatArray, level: float, noise: float) -> list[Interruption]:
        """Return where one loop interrupts the way: runs of values that have come to zero."""

        def is_under(at: FloatArray) -> Mask:
            return np.asarray(self.seen(at)[row] < -noise)

        found, loop = [], self.clearances.loops[row]
        low_end, high_end, known = x[0], x[-1], np.isfinite(seen)  # the ends of the way: where the loop has values it may begin within
        x, seen = x[known], seen[known]
        for first, last in stretches(seen <= level):
            run = slice(first, last + 1)
            deepest = float(x[run][seen[run] <= seen[run].min() + noise].mean())
            if seen[run].min() < -noise:
                under = first + np.flatnonzero(seen[run] < -noise)
                places = ((int(under[0]), -1), (int(under[-1]), 1))
                pairs = [(x[place], x[min(max(place + side, 0), len(x) - 1)]) for place, side in places]
                low, high = (float(last_holding(is_under, inside, outside)[1]) for inside, outside in pairs)
                found.append(Interruption(self.name, self.unit, loop.step, low, high, deepest, loop.kind))
            elif loop.kind != "length" and min(deepest - low_end, high_end - deepest) > END * (high_end - low_end):
                found.append(Interruption(self.name, self.unit, loop.step, deepest, deepest, deepest, loop.kind))
        return found


def roots_between(rate: Curve, low: float, high: float) -> list[float]:
    """Return where a function passes zero between two strokes, or at one of them, to 1e-13 of the range between them."""
    ends, beyond = (low, high), 2.0 * NEAR * (high - low)
    low, span = low - beyond, high - low + 2.0 * beyond
    at = low + span * np.linspace(0.0, 1.0, SAMPLES + 1)
    values = rate(at)
    known = np.flatnonzero(np.isfinite(values) & (values != 0.0))  # a sample on a root lies between its neighbours
    crossed = np.flatnonzero((values[known[:-1]] < 0.0) != (values[known[1:]] < 0.0))
    if not crossed.size:
        return []
    before, after = known[crossed], known[crossed + 1]
    roots, _ = sign_changes(rate, at[before], at[after], CLOSE * span)
    found = []
    for root, sense in zip(roots, np.sign(values[before]), strict=True):
        first, here, last = (sense * rate(root + NEAR * span * np.array([-1.0, 0.0, 1.0]))).tolist()
        if first > 0.0 > last and abs(here) < 0.5 * min(first, -last):
            found.append(float(np.clip(root, *ends)))
    return found


# What lies between the poses of a sweep, and what is said of it.


def is_watched(motion: MotionLike) -> bool:
    """Return whether it is looked at between the poses: of one design along one stroke, from two poses on."""
    return len(motion.strokes) == 1 and not motion._design_shape and motion.shape != () and motion._grid.size[1] > 1


def interruptions(motion: MotionLike) -> tuple[Interruption, ...]:
    """Return the interruptions of one design along its one stroke, between the least and the greatest of its poses.

    A stretch where nothing does is kept, of the last designs that were asked for, so that poses in it are not looked at again.
    """
    ((name, values),) = motion.strokes.items()
    low, high = values.item(values.argmin()), values.item(values.argmax())
    clear: dict[tuple[float, ...], tuple[float, float]] = motion.plan.made("clear", lambda _: {})
    key = motion.designs.as_floats
    known = clear.get(key)
    if known is not None and known[0] <= low and high <= known[1]:
        return ()
    found = StrokeLine(motion, name, {}).interruptions(low, high)
    if not found and (known is None or (low <= known[0] and known[1] <= high)):
        clear[key] = low, high
        for old in list(clear)[:-KEPT]:
            clear.pop(old, None)
    return found


def refuse_interrupted(motion: MotionLike) -> None:
    """Raise the error of an interruption between the poses of a sweep: a stretch out of reach, or a change point.

    A loop that a declared side keeps on one branch would turn back at a change point, which no machine does.
    """
    found = interruptions(motion)
    if not found:
        return
    ((name, values),) = motion.strokes.items()
    plan, unit, start = motion.plan, stroke_unit(motion.plan, name), float(np.ravel(values)[0])
    first = min(found, key=lambda each: min(abs(each.low - start), abs(each.high - start)))
    if not first.is_gap:
        raise change_point_error(motion, first)
    there = motion.moved({name: np.array([first.deepest])})
    step = next((each for each, mask in failures(plan, there._reading, (1,)) if mask.any()), first.step)
    words, shortfall = missing_words(plan, step, there._reading, np.ones(1, bool))
    far = np.asarray(values > first.low if start <= first.low else values < first.high)
    edges = [float(values.min()), *(edge for each in found if each.is_gap for edge in (each.low, each.high)), float(values.max())]
    goes = spans_words(name, unit, list(zip(edges[::2], edges[1::2], strict=True)))
    where = f"cannot be assembled between two poses, {stretch_words(name, unit, first.low, first.high, 9)}"
    raise AssemblyError(f"{opening(plan, step)} {where}:\n{words}{goes}", point=step, mask=far, shortfall=shortfall)


def spans_words(name: str, unit: str, spans: Sequence[tuple[float, float]]) -> str:
    """Return how far a sweep of one design goes, in words: ` It goes from S = 0 to 408.276 mm.`"""
    return f" It goes {', and '.join(stretch_words(name, unit, low, high) for low, high in spans)}."


def stretch_words(name: str, unit: str, low: float, high: float, digits: int = 6) -> str:
    """Return a stretch of a stroke [m or rad] as errors say it: `from S = 0 to 408.276 mm`; angles in radians, as calls take them."""
    by, unit = (1.0, unit) if unit == "rad" else (1e3, "mm")
    return f"from {name} = {by * low:.{digits}g} to {by * high:.{digits}g} {unit}"


def change_point_error(motion: MotionLike, found: Interruption) -> SingularError:
    """Return the error that names a change point, or where guides are parallel."""
    loop, name, value = found.step, found.stroke, found.deepest
    unit = stroke_unit(motion.plan, name)
    where = f"{name} = {value:.6g} {unit}" + (f" ({value / deg:.4g} deg)" if unit == "rad" else "")
    member = motion.plan.members[loop]
    named = f"{loop} = {member}" if isinstance(member, Point) else loop
    if found.kind == "guides":
        what, why = f"parallel guides at {where}", f"{named} runs to infinity there and comes back from the other side"
    elif found.kind == "meeting":
        what = f"a pose without a direction at {where}"
        why = f"{named} takes a direction between two points that come together there"
    else:
        what = f"a change point at {where}"
        line = f"{named} has its links in line there and its two branches cross"
        why = f"{line}, so which way the mechanism goes on is not settled by its geometry"
    remedy = 'Stop the sweep before it, take the poses on each side in sweeps of their own, or ask with unreachable="nan".'
    mask = np.asarray(motion.strokes[name] >= value)
    return SingularError(f"{motion.plan.title} passes {what}: {why}. {remedy}", point=loop, mask=mask, motion=motion)


def out_of_reach(motion: MotionLike) -> AssemblyError:
    """Return the error for the poses of a motion that are not reached: out of reach, or behind a change point."""
    plan, missing, crossed = motion.plan, ~motion.reached, np.asarray(motion._grid.crossed > 0.0)
    if crossed.any():
        numbers = np.unique(motion._grid.crossed[crossed])
        named = list(plan.groups.items())
        groups = ", ".join(f"{name} = {group}" for name, group in (named[int(number) - 1] for number in numbers))
        what = f"{plan.title} passes a change point before the poses {where_words(plan, crossed, motion.strokes)}"
        why = f"the branches of {groups} cross on the way from the sketch"
        remedy = 'Stop before it, start from a sketch on the other side, or ask with unreachable="nan".'
        return SingularError(f"{what}: {why}. {remedy}", point=named[int(numbers[0]) - 1][0], mask=crossed, motion=motion)
    stop, strokes = "", dict[str, FloatArray](motion.strokes)
    if motion._instants is not None:  # no stroke is called so
        strokes = {"time": np.broadcast_to(motion._instants.time, motion._grid.stroke_shape), **strokes}
    if len(motion.strokes) == 1 and not motion._design_shape and motion.reached.any() and motion.reached.ndim == 1:
        ((name, values),) = motion.strokes.items()
        order = np.argsort(values, kind="stable")
        found = StrokeLine(motion, name, {}).ranges_among(values[order], motion.reached[order])
        stop = spans_words(name, stroke_unit(plan, name), [(each.low, each.high) for each in found])
    return assembly_error(plan, motion._grid.read_at(missing), missing, strokes, stop)


# The way between poses: where a loop comes to its dead point there, and where it cannot be assembled.

GRID = 128
"""Intervals of the grid; an angle has so many for each turn of it."""
PARTS = 8
DEPTH = 1e-9
"""The width, of the way, down to which it is divided."""
BENDS = 2.0
TOUCH = 1e-6
"""A sine of links that comes so low has come to zero: a clearance of 1e-12 of their lengths is not told from none."""
END = 1e-7
"""A dead point so near to an end of the way, compared with the way, is its end and not passed."""
ROUNDING = 8 * np.finfo(float).eps
MOST_INTERVALS = 4096

ON_ARRAYS = RunOptions("numpy")
INNER = np.arange(1, PARTS) / PARTS


@record
class Interruption:
    """An interruption along a stroke: from `low` to `high` [m or rad] a step cannot be assembled; equal at a change point."""

    stroke: str
    unit: str
    step: str
    low: float
    high: float
    deepest: float
    """Where it is farthest from being assembled, or in line."""
    kind: str = "links"

    @property
    def is_gap(self) -> bool:
        """Whether a stretch of the way is out of reach; else two branches meet in a point of it, or guides are parallel."""
        return self.high > self.low

    def __str__(self) -> str:
        if self.is_gap:
            span = f"{stroke_number(self.low, self.unit)} to {stroke_text(self.high, self.unit)}"
            return f"{self.step} out of reach from {self.stroke} = {span}"
        what = {"guides": "parallel guides", "meeting": "no direction"}.get(self.kind, "a change point")
        return f"{what} of {self.step} at {self.stroke} = {stroke_text(self.low, self.unit)}"


@record
class Clearances:
    """The loops of a plan that move, and the kernels of how clear of their dead points they are, and of the size of rounding there."""

    loops: tuple[Loop, ...]
    kernel: Kernel
    rounding: Kernel

    @property
    def is_signed(self) -> Mask:
        """Of which loops, shape (loops, 1), the sign says on which side they are assembled: of guides, and of points that meet."""
        return np.array([loop.kind in ("guides", "meeting") for loop in self.loops])[:, None]

    @classmethod
    def for_plan(cls, plan: Plan) -> Clearances:
        """Return those of a plan; pins of groups are followed on their own."""
        trace = plan.trace
        moving = dict.fromkeys(loop for loop in trace.loops if loop.terms[0].level is Level.POSE)
        grouped = {pin for group in plan.groups.values() for pin in group.pins}
        own = [loop for loop in moving if loop.step not in grouped]
        # a root's scale that is a root itself is the distance of two points, along which a slot's line is taken; it may vanish
        sides = [Loop(loop.step, "meeting", loop.terms[1:2]) for loop in own if loop.kind == "links" and loop.terms[1].op == "sqrt"]
        own += [loop for loop in sides if loop.terms[0].level is Level.POSE]
        clear = [loop.terms[0] / (loop.terms[1] * loop.terms[1]) if loop.kind == "links" else loop.terms[0] for loop in own]
        size = [loop.terms[2] / (loop.terms[1] * loop.terms[1]) if loop.kind == "links" else trace.graph.constant(1.0) for loop in own]
        return cls(tuple(own), Kernel(clear), Kernel(size))


def divided(
    look: Callable[[FloatArray], FloatArray], x: FloatArray, seen: FloatArray, bends: FloatArray, noise: FloatArray, rows: Mask
) -> tuple[FloatArray, FloatArray]:
    """Return all strokes looked at, in order, and the values there, shape (loops, n): intervals divided where a loop may reach zero."""
    wide = np.pad(np.where(np.isfinite(bends), bends, 0.0), ((0, 0), (2, 2)), mode="edge")
    bend = np.maximum.reduce([wide[:, k : k + x.size - 1] for k in range(4)])
    left, right, first, last = x[:-1], x[1:], seen[:, :-1], seen[:, 1:]
    places, values = [x], [seen]
    least = DEPTH * float(x[-1] - x[0])
    while left.size:
        low = (np.minimum(first, last) <= BENDS * bend + noise) & (np.maximum(first, last) >= -noise) & rows[:, None]
        pick = np.flatnonzero(low.any(axis=0) & (right - left > least))[:MOST_INTERVALS]
        if not pick.size:
            break
        left, right, first, last = left[pick], right[pick], first[:, pick], last[:, pick]
        inner = left[:, None] + (right - left)[:, None] * INNER
        found = look(inner.ravel()).reshape(len(seen), *inner.shape)
        places.append(inner.ravel())
        values.append(found.reshape(len(seen), -1))
        f = np.concatenate([first[..., None], found, last[..., None]], axis=2)
        at = np.concatenate([left[:, None], inner, right[:, None]], axis=1)
        with np.errstate(invalid="ignore"):
            curved = np.abs(f[..., 2:] - 2.0 * f[..., 1:-1] + f[..., :-2])
        bend = np.repeat(np.fmax.reduce(curved, axis=2, initial=0.0), PARTS, axis=1)
        left, right = at[:, :-1].ravel(), at[:, 1:].ravel()
        first, last = f[..., :-1].reshape(len(seen), -1), f[..., 1:].reshape(len(seen), -1)
    at = np.concatenate(places)
    order = np.argsort(at, kind="stable")
    return at[order], np.concatenate(values, axis=1)[:, order]
