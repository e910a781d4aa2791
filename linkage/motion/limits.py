"""How far a mechanism can go: reachable intervals, dead points, change points, least transmission angles."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import floor, log10, nan, pi
from typing import Any

import numpy as np

from ..assembly import lost_at_sketch
from ..errors import AssemblyError, DefinitionError, SingularError
from ..frozen import FrozenDict, record
from ..language import ENGLISH, language, said, said_of, translated
from ..plan import ArrayReading, Mask, Plan, failures, missing_words, opening
from ..shown import Shown
from ..steps import Step
from ..units import SI, UNITS, deg, display_unit, mm, show, shown_number, unit_sign


@record
class StrokeLimits:
    """The limits along one stroke, the others held. Values in m or rad, as the stroke; printed, angles are in degrees."""

    stroke: str
    unit: str
    start: float
    end: float
    intervals: tuple[Interval, ...]
    change_points: tuple[tuple[float, str], ...]
    transmission: tuple[Extreme, ...] = ()
    held: tuple[tuple[str, float, str], ...] = ()
    """The other strokes, where each is held, and its unit."""
    open_turn: Open | None = None
    cylinder_dead_points: tuple[tuple[float, str], ...] = ()
    """Where the length of a cylinder that hangs beside the drive stands still, so that its thrust moves nothing: (stroke, cylinder)."""

    @property
    def shown_unit(self) -> str:
        """The unit in which the stroke is shown: mm, deg, or none for a share."""
        return shown_stroke_unit(self.unit)

    @property
    def dead_points(self) -> tuple[tuple[float, str], ...]:
        """Where a loop's two links come into line and the motion ends: (stroke, step)."""
        ends = [(value, stop) for each in self.intervals for value, stop in ((each.low, each.low_stop), (each.high, each.high_stop))]
        return tuple((value, stop) for value, stop in ends if stop)

    def __str__(self) -> str:
        others = ", ".join(f"{name} = {stroke_text(value, unit)}" for name, value, unit in self.held)
        held = said(", with {strokes} held", strokes=others) if others else ""
        start, end = stroke_number(self.start, self.unit), stroke_text(self.end, self.unit)
        lines = [f"{self.stroke}: {said('declared {low} to {high}', low=start, high=end)}{held}"]
        for each in self.intervals:
            ends = (each.low, each.low_stop), (each.high, each.high_stop)
            if each.low_stop or each.high_stop:
                low, high = (stroke_number(value, self.unit) + unstopped_words(self.unit, each, stop) for value, stop in ends)
                sign = unit_sign(self.shown_unit)
                lines.append(f"  {said('reachable from {low} to {high} {unit}', low=low, high=high, unit=sign).rstrip()}")
                stops = [(stroke_number(value, self.unit), said("dead point of {step}", step=stop)) for value, stop in ends if stop]
                lines += [f"    {value}: {text}" for value, text in stops]
            else:
                low, high = stroke_number(each.low, self.unit), stroke_text(each.high, self.unit)
                whole = said("reachable all the way from {low} to {high}", low=low, high=high)
                lines.append(f"  {whole}{unstopped_words(self.unit, each)}")
        for value, step in self.change_points:
            place = stroke_text(value, self.unit)
            lines.append("  " + said("change point at {place}: the branches of {step} cross", place=place, step=step))
        for value, name in self.cylinder_dead_points:
            at = {"stroke": self.stroke, "place": stroke_text(value, self.unit)}
            lines.append("  " + said("dead point of {name} at {stroke} = {place}: its length stands still", name=name, **at))
        for least in self.transmission:
            place = stroke_text(round(least.stroke, 7) + 0.0, self.unit)
            given = {"joint": least.joint, "angle": angle_text(least.angle, 4), "place": place}
            lines.append("  " + said("least transmission angle at {joint}: {angle} at {place}", **given))
        return "\n".join([*lines, *([f"  {self.open_turn}"] if self.open_turn else [])])


class Limits(FrozenDict[str, StrokeLimits], Shown):
    """The limits of every stroke by name, and of the `box` of all strokes, None where that is not looked at; printed as sentences.

    `remark` says where the machine is wider than machines are; it is empty else.
    """

    def __init__(self, strokes: Mapping[str, StrokeLimits], box: BoxLimits | None = None, remark: str = "") -> None:
        super().__init__(strokes)
        self.box, self.remark = box, remark

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (dict(self), self.box, self.remark)

    def __str__(self) -> str:
        box = [self.box] if self.box is not None and len(self) > 1 else []  # along a single stroke its own lines say it
        return "\n".join(map(str, [*self.values(), *box, *([self.remark] if self.remark else [])]))


@record
class BoxLimits:
    """The limits of several strokes together, over the box of their ranges, which `title` says, or over the given `Over`s.

    `lost` is the share of it that cannot be assembled, `deepest` the place [m or rad] where most is missing, `why` what is missing there;
    a part narrower than the grid has the share 0 and a place. `margins` say how clear each loop stays of its dead point.
    """

    title: str
    lost: float
    deepest: Mapping[str, float]
    why: str
    margins: tuple[LoopMargin, ...]

    def __str__(self) -> str:
        gone = said("all of it can be assembled")
        if self.deepest:
            share = f"{100.0 * self.lost:.3g} %" if self.lost > 0.0 else said("a narrow part")
            gone = said("{share} cannot be assembled, most of all: {why}", share=share, why=self.why)
        return "\n".join([f"{said('together')}: {self.title}", f"  {gone}", *(f"  {each}" for each in self.margins if each.tells)])


@record
class LoopMargin:
    """The least margin of the loop of a step, and where: of one design numbers, of a batch arrays over its designs.

    `kind` is "links", "guides", "length" or "meeting", of two points that a direction is taken between. `value` is the squared sine of
    the angle between two links, or two guides, the length where that follows others [m], or the squared one between two points. Below
    zero the `step` cannot be assembled, by more than rounding where it `is_hole`. NaN where no pose tells. `strokes` [m or rad, which
    `units` say] are the place, `time` [s] its instant over a path in time, else NaN.
    """

    step: str
    kind: str
    value: Any
    is_hole: Any
    strokes: Mapping[str, Any]
    units: Mapping[str, str]
    time: Any = nan

    @property
    def clear(self) -> float:
        """How clear one design stays of it: an angle [rad] between links or guides, else a length [m]; 0 in a hole."""
        value = max(float(self.value), 0.0)
        if self.kind == "length":
            return value
        return float(np.arcsin(min(value**0.5, 1.0))) if self.kind in ("links", "guides") else value**0.5

    @property
    def place(self) -> str:
        """The strokes in words."""
        return places_text(self.strokes, self.units)

    @property
    def tells(self) -> bool:
        """Whether it is worth a line: a length is positive wherever its cylinder is."""
        return self.is_hole or self.kind != "length"

    def __str__(self) -> str:
        if self.is_hole:
            return said("{step} comes apart, most of all at {place}", step=self.step, place=self.place)
        clear = show(self.clear, "deg" if self.kind in ("links", "guides") else "mm", 4)
        given = {"clear": clear, "step": self.step, "place": self.place}
        return {
            "links": said("the links of {step} are at least {clear} out of line, at {place}", **given),
            "guides": said("the guides of {step} are at least {clear} from parallel, at {place}", **given),
            "meeting": said("the points that {step} takes a direction between are at least {clear} apart, at {place}", **given),
            "length": said("the length behind {step} is at least {clear}, at {place}", **given),
        }[self.kind]


@record
class Interval:
    """A reachable range of a stroke, and the step that stops it at either end ("" where the scan ends first) [m or rad]."""

    low: float
    high: float
    low_stop: str = ""
    high_stop: str = ""

    def __contains__(self, value: float) -> bool:
        return self.low <= value <= self.high


def unstopped_words(unit: str, part: Interval, stop: str = "") -> str:
    """Return the words behind an end of a range that nothing stops: no farther was looked, but of a whole turn."""
    return "" if stop or (unit == "rad" and part.high - part.low > 2.0 * pi - 1e-9) else said(" (looked no farther)")


def angle_text(angle: float, digits: int) -> str:
    """Return a transmission angle [rad] in words; zero at a dead point, which is found to half of the digits of its angle."""
    return show(0.0 if angle <= DEAD_ANGLE else angle, "deg", digits)


DEAD_ANGLE = 1e-6
"""Transmission angles below it are those of a dead point [rad]."""


@record
class Extreme:
    """The least transmission angle of a joint, folded to 0 ... pi/2 [rad], and the stroke where it stands."""

    joint: str
    angle: float
    stroke: float


@record
class Open:
    """The pins of groups that do not stand where they began after one turn, and after how many they do; 0 where not after six."""

    pins: tuple[str, ...]
    turns: int

    def __str__(self) -> str:
        apart = said("after one turn the pins {pins} do not stand where they began", pins=" ".join(self.pins))
        again, turned = said("nor after a few more"), show(360 * self.turns * deg, "deg")
        if self.turns:
            again = said_of(
                self.turns, "the motion repeats after {n} turn ({angle})", "the motion repeats after {n} turns ({angle})", angle=turned
            )
        return f"{apart}; {again}"


# Where a mechanism cannot be assembled, in words: the strokes, and what is missing there.


@np.errstate(all="ignore")
def assembly_error(plan: Plan, reading: ArrayReading, mask: Mask, strokes: Mapping[str, object], stop: str = "") -> AssemblyError:
    """Return the error for poses that cannot be assembled.

    `reading` holds the failing poses, `mask` all of them (designs first, strokes last), `strokes` their values.
    """
    name, lost = next(failures(plan, reading, (int(mask.sum()),)), ("", None))
    if lost is None:  # the kernel refuses what the reading places by luck
        closing = [each for each, step in plan.of_kind(Step).items() if step.closes and each in reading.sines]
        name = min(closing, key=lambda each: float(np.min(np.abs(reading.sines[each]))), default=[*plan.points][-1])
        words, shortfall = "rounding leaves no digit of its place, so near is it to a dead point. Change a length.", float("nan")
    else:
        words, shortfall = missing_words(plan, name, reading, lost)
        never = lost_at_sketch(plan)
        if never is not None and never.point in plan.reaches(name):
            words, shortfall = str(never), never.shortfall
    text = f"{opening(plan, name)} cannot be assembled {where_words(plan, mask, strokes)}:\n{words}{stop}"
    return AssemblyError(text, point=name, mask=mask, shortfall=shortfall)


def no_joint(plan: Plan, name: str, joints: Sequence[str]) -> DefinitionError:
    """Return the error for a point that has no transmission angle."""
    known = ", ".join(joints) or "none"
    why = f"has no transmission angle, {name} is not the joint of a dyad"
    return DefinitionError(f"{plan.title}: {opening(plan, name)} {why}; those are: {known}.")


def where_words(plan: Plan, mask: Mask, strokes: Mapping[str, object]) -> str:
    """Return which poses are meant as errors and warnings say it, in English: `at 7 of 101 strokes, from S = 159.8 to 170.0 mm`."""
    with language(ENGLISH):
        return where_said(plan, mask, strokes)


def refuse_at(motion: Any, mask: Mask, before: str, after: str) -> None:
    """Raise SingularError at the poses of a mask, unless NaN was asked for; where they are stands between the words before and after."""
    if mask.any() and motion.unreachable == "raise":
        text = f"{before} {where_words(motion.plan, mask, motion.strokes)}{after}"
        raise SingularError(text, mask=mask, motion=motion)


def where_said(plan: Plan, mask: Mask, strokes: Mapping[str, Any]) -> str:
    """Return the same in the language that is spoken, for verdicts and remarks; the `time` of poses may stand before their strokes [s]."""
    count, total = int(mask.sum()), mask.size
    poses = next(iter(strokes.values())).ndim if strokes else 0
    if mask.ndim > poses:
        designs = mask.reshape(*mask.shape[: mask.ndim - poses], -1)
        some, every = int(designs.any(axis=-1).sum()), designs[..., 0].size
        return said("at {count} of {total} poses, in {some} of {every} designs", count=count, total=total, some=some, every=every)
    ends = {name: (float(np.min(value[mask])), float(np.max(value[mask]))) for name, value in strokes.items()}
    spans = []
    for name, (low, high) in ends.items():  # angles in radians, as calls take them
        unit = "s" if name == "time" else stroke_unit(plan, name)
        text = f"{low:.4f}" if low == high else said("{low} to {high}", low=f"{low:.4f}", high=f"{high:.4f}")
        spans.append(f"{name} = {text} {translated(unit)}" if unit in ("rad", "s") else f"{name} = {place_text((low, high), unit)}")
    place = ", ".join(spans)
    if total == 1:
        return said("at {place}", place=place) if spans else said("anywhere")
    if count > 1:
        return said("at {count} of {total} strokes, from {place}", count=count, total=total, place=place)
    return said("at {count} of {total} strokes, at {place}", count=count, total=total, place=place)


# Strokes as they are read.


STILL = 1e-9
"""A stroke that moves by no more than the rounding of a search stands still [m or rad]."""


def span_text(values: Any, unit: str) -> str:
    """Return the range of some stroke values as it is read: `0 to 250 mm`, `90 deg`."""
    values = np.asarray(values, float)
    values = values[np.isfinite(values)]  # along a path a place that is not reached has no stroke
    if not values.size:
        return "nothing"
    low, high = float(values.min()), float(values.max())
    if high - low <= STILL:
        return stroke_text(low, unit)
    return said("{low} to {high}", low=stroke_number(low, unit), high=stroke_text(high, unit))


MOST_TURNS = 4
"""Of more turns of a stroke along a path its range alone is told."""


def way_text(values: object, unit: str) -> str:
    """Return where a stroke begins, turns back and ends, one after the other: `0, 300 to 100 mm`; of many values their range."""
    values = np.asarray(values, float)
    steps = np.diff(values)
    moving = np.flatnonzero(np.abs(steps) > STILL)
    turns = moving[1:][steps[moving[1:]] * steps[moving[:-1]] < 0.0]
    if not moving.size or len(turns) >= MOST_TURNS or not np.isfinite(values).all():
        return span_text(values, unit)
    low = ", ".join(stroke_number(float(values[place]), unit) for place in (0, *turns))
    return said("{low} to {high}", low=low, high=stroke_text(float(values[-1]), unit))


NO_LENGTH = 1e-7
"""A length [m] that is smaller is none as a place is read."""


def place_text(value: Any, unit: str) -> str:
    """Return a stroke [m or rad], or the range of several, as a place of it is read: `123.4 mm`, `25.00 deg`, `100.0 to 200.0 mm`.

    Lengths below 1 mm have three figures: `0.340 mm`. Of a batch those without a value are left out.
    """
    value = np.ravel(value)
    digits, shown, most = {"rad": 2, "": 4, "m3": 3}.get(unit, 1), shown_stroke_unit(unit), float(np.fmax.reduce(np.abs(value)))
    if unit == "m" and NO_LENGTH < most < mm:
        digits = 2 - floor(log10(most / mm))
    low, high = (shown_number(float(each), shown, f"z.{digits}f") for each in (np.fmin.reduce(value), np.fmax.reduce(value)))
    return f"{low if low == high else said('{low} to {high}', low=low, high=high)} {unit_sign(shown)}".rstrip()


def places_text(strokes: Mapping[str, object], units: Mapping[str, str]) -> str:
    """Return values of strokes as a place is read: `S1 = 100.0 mm, phi = 25.00 deg`; of several, the ranges."""
    return ", ".join(f"{name} = {place_text(value, units[name])}" for name, value in strokes.items())


def timed_texts(strokes: Mapping[str, object], units: Mapping[str, str], time: float) -> tuple[str, str]:
    """Return an instant [s] and the strokes there as they are read: `0.1875 s`, `lift = 114.1 mm, phi = 25.00 deg`."""
    return show(round(time, 6), "s", 4), places_text(strokes, units)


def stroke_text(value: float, unit: str) -> str:
    """Return a value of a stroke [m or rad] as it is read: `250 mm`, `90 deg`."""
    return show(value, shown_stroke_unit(unit))


def stroke_number(value: float, unit: str) -> str:
    """Return a value of a stroke [m or rad] as it is read, without its unit: lengths in millimetres, angles in degrees."""
    return shown_number(value, shown_stroke_unit(unit))


def shown_stroke_unit(unit: str, length: str = "mm") -> str:
    """Return the unit that a stroke [m, rad, m3 or a number] is shown in."""
    return display_unit(UNITS[unit][1], length) if unit else ""


def stroke_measure(plan: Plan, name: str) -> str:
    """Return the kind of a stroke: "angle", "length", "volume" or, for a share, "number"."""
    return plan.stroke_kinds[name] or "length"


def stroke_display_unit(plan: Plan, name: str, length: str = "m") -> str:
    """Return the unit that a stroke is shown in: deg for an angle, none for a share, else that of a length."""
    return shown_stroke_unit(stroke_unit(plan, name), length)


def drive_kind(plan: Plan, name: str) -> tuple[str, str]:
    """Return the kind of what drives a stroke, a force, a pressure or a moment, and the unit in which it is shown."""
    return {"m": ("force", "kN"), "m3": ("pressure", "bar")}.get(stroke_unit(plan, name), ("moment", "Nm"))


def stroke_unit(plan: Plan, name: str) -> str:
    """Return the unit of a stroke: rad, m, m3, or none for a share."""
    return SI.get(stroke_measure(plan, name), "")
