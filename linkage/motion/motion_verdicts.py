"""Verdicts on any motion: whether it is assembled, how far it goes, its dead points, and its members' own verdicts."""

from __future__ import annotations

from abc import abstractmethod
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import field, replace
from typing import Any, ClassVar

import numpy as np

from ..assembly import sketch_words, width_words
from ..errors import DefinitionError, LinkageError, UnfitError, unwarned
from ..frozen import immutable
from ..language import heading_of, said
from ..loads import PLAIN, PLAIN_CASE, Case, LoadCase, TwoPoint, case_in_words, case_title, case_titles
from ..plan import Mask, name_or_pins, opening
from ..quantities import Member, name_of
from ..units import Amount, deg, display_unit, show, shown_number
from ..verdict import Remark, Verdict
from . import stroke_search
from .answer import NONE_LOST, Answer, share_text
from .judge import Domain, Judge, Question
from .limits import BoxLimits, Limits, LoopMargin, StrokeLimits, angle_text, place_text, places_text, span_text, stroke_unit, timed_texts
from .measures import Condition, Measure, least, reachable
from .motion import Motion, require_motion
from .over import Over
from .requests import transmission
from .search import least_margins
from .stroke_search import StrokeLine, out_of_reach
from .table import from_above, speakers

POOR = 40.0 * deg
"""A transmission angle below which textbooks advise against a loop that carries load [rad]."""
NEAR_END = 1e-5
"""Of a stroke: a dead point that is no farther from its end stands at it, as no cylinder is made or set any closer."""
IN_LINE = 1e-3
"""The sine of the angle between two links, or guides, below which they are in line."""
JUDGED = 200
"""Designs of a batch whose members are judged, each by itself."""


@immutable
class PageWords:
    """How a page says a rule: a sentence with {value}, {limit} and {place} where it is kept, in English as the catalogues have it.

    `fails` says it where it is not, by the sign of the condition that is missed; {force}, {much} or {missing} is by how much.

    `measure` is the value where it is not the condition's own, `share` how much of the limit is used where that is not value over limit.
    `is_followed` is False where a changed design may ask something else, so that the page keeps the delivered sentence and says so.
    """

    text: str
    measure: Measure | None = None
    share: Measure | None = None
    fails: Mapping[str, str] = field(default_factory=dict)
    is_followed: bool = True


class HasVerdicts(Member):
    """A member that has something to say of a machine, such as a cylinder: its base beside that of its kind."""

    headed: ClassVar[str] = "{name}"
    """What a page calls it above its verdicts, in English as the catalogues have it."""
    named_in_all: ClassVar[bool] = False
    """Whether all its rules bear its name where there are several of its kind, headed alike."""

    def questions(self, judge: Judge) -> list[Question]:
        """Return the questions of its verdicts, so that one pass over the machine answers those of all members.

        Parameters
        ----------
        judge : Judge
            The judge of the machine over its domains.

        Returns
        -------
        list of Question
            The questions.
        """
        return list(self.conditions(judge).values())

    def conditions(self, judge: Judge) -> Mapping[str, Condition]:
        """Return those of its rules that are plain conditions, by the rules' names; a live page evaluates them for a changed design.

        Parameters
        ----------
        judge : Judge
            The judge of the machine over its domains.

        Returns
        -------
        mapping of str to Condition
            The conditions by the rules' names.
        """
        return {}

    def page_words(self, judge: Judge) -> Mapping[str, PageWords]:
        """Return how a page says those conditions of a changed design, by their rules, where it is not with the condition's own number.

        Parameters
        ----------
        judge : Judge
            The judge of the machine over its domains.

        Returns
        -------
        mapping of str to PageWords
            The words by the rules' names.
        """
        return {}

    def load_limits(self, judge: Judge) -> Mapping[str, Condition]:
        """Return those conditions that limit a load in charts: all, except those that the bounds of forces contain already.

        Parameters
        ----------
        judge : Judge
            The judge of the machine over its domains.

        Returns
        -------
        mapping of str to Condition
            The conditions by the rules' names.
        """
        return self.conditions(judge)

    def load_remarks(self, judge: Judge) -> Mapping[str, Condition]:
        """Return those that limit no load, and of which a chart says in how many places they fail."""
        return {}

    def sections(self, judge: Judge) -> Sequence[Any]:
        """Return the sections that it adds to a report (`linkage.documents.content.Section`), over all that the machine runs."""
        return ()

    @abstractmethod
    def verdicts(self, judge: Judge) -> list[Verdict]:
        """Return its verdicts on one design, over all that the machine runs.

        Where several members follow the same rule the machine adds their names to it.
        """


HELD, DRIVES, PACE = "linkage.statics:held_verdict", "linkage.statics:drive_remarks", "linkage.statics:pace_remarks"
"""What says of any machine whether it is held, what its drives give, where inertia is left out: in the room of forces, above."""

THRUST = "linkage.statics:member_thrust"
"""The thrust of a member, in the room of forces, above."""


def refused_forces(judge: Judge) -> Verdict | None:
    """Return the verdict that what members ask is refused, as by gas that is pressed to nothing; None where all of it has answers."""
    if not any(map(np.ndim, judge.designs.values())) and judge.is_reached:
        try:
            judge._once("verdict questions", lambda: judge.answers(verdict_questions(judge)))
        except UnfitError as error:
            return Verdict.refused("forces", error)
    return None


def judge_verdicts(judge: Judge, fault: str = "") -> list[Verdict]:
    """Return the verdicts on any machine over all that it runs, and differences from its drawing; of a batch, how many designs fail.

    Where there are no forces, for a `fault` of the machine, only what is said of places.
    """
    told = [*sketch_words(judge.plan, judge.designs), width_words(judge.plan, judge.designs)]
    if any(map(np.ndim, judge.designs.values())):
        found = batch_verdicts(judge, fault)
    elif not judge.is_reached:
        found = assembly_verdicts(judge)
    else:
        found, said_of = geometry_verdicts(judge), member_verdicts(judge.lost_allowed(), fault)
        is_whole = not fault and all(found)
        for each in said_of:  # what a dead point takes at the end of a stroke is told with it, a pose that stands in one by each rule
            is_lost = each.ok and each.answer is not None and (is_whole or not (fault or each.answer.width))
            lost = each.answer.lost if is_lost else NONE_LOST
            if lost and not lost.strokes:  # a kept rule is a fault where its quantity has no value at some assembled places
                words = {"lost": each.answer.lost_words, "sentence": each.sentence}
                text = said("{lost}; elsewhere: {sentence}", **words) if lost.share < 1.0 else f"{each.answer.lost_words}."
                each = Verdict(each.rule, False, text, each.heading, each.answer).said_by(each.member)
            found.append(each)
    return [*found, *map(Remark, filter(None, told)), *([] if fault else [*from_above(PACE)(judge), *from_above(DRIVES)(judge)])]


def verdict_questions(judge: Judge) -> list[Question]:
    """Return the questions of all verdicts on one design, so that one pass answers them."""
    members = speakers(judge.plan, HasVerdicts).values()
    return [reachable, *transmissions(judge).values(), *(each for member in members for each in member.questions(judge))]


def over_time(judge: Judge, asked: Condition) -> Answer | None:
    """Return the answer to a condition over the paths in time that a judge looks at; None where it looks at none."""
    timed = [place.over for place in judge.places if place.instants is not None]
    other = judge._once("over time", lambda: Judge(judge.plan, judge.designs, timed, judge.acting).lost_allowed())
    return other.answer(asked) if timed else None


# -- geometry ----------------------------------------------------------------------------------------------


def geometry_verdicts(judge: Judge) -> list[Verdict]:
    """Return whether one design is assembled over all that it runs, its dead points, and its least transmission angle where it is poor."""
    if not judge.plan.strokes or not judge.plan.moving:
        return []
    if not judge.is_reached:
        return assembly_verdicts(judge)
    asked, found = transmissions(judge), [*assembly_verdicts(judge), *dead_points_over(judge)]
    poor = {name: each for name, each in zip(asked, judge.answers([*asked.values()]), strict=True) if each.value < POOR}
    if poor:  # it is no fault as such, a toggle lives of it
        joint = min(poor, key=lambda name: float(poor[name].value))
        given = {"angle": angle_text(float(poor[joint].value), 3), "joint": joint, "place": poor[joint].place, "poor": angle_text(POOR, 3)}
        text = said("The least transmission angle is {angle}, of {joint} {place}: below {poor} pin forces and play grow.", **given)
        found.append(Remark(text))
    return found


def dead_points_over(judge: Judge) -> list[Verdict]:
    """Return the stops and turns of a motion along each stroke, or in a box, in every place; the nearest dead points beyond in one row."""
    found, nearest = dict[tuple[str, str], list[Verdict]](), dict[tuple[str, bool], tuple[float, str]]()
    for place in [place for place in judge.places if place.motion.reached.any()] or judge.places[:1]:
        spans = {name: (float(np.min(value)), float(np.max(value))) for name, value in place.motion.strokes.items()}
        together = in_line(place).get((), "") if len(place.running) > 1 else ""
        if together:
            text = said("{places}, among what runs: no drive passes or starts there. Shorten a stroke or change a length.", places=together)
            pushed = any(is_pushed(judge, name) for name in place.running)
            found.setdefault(("", "dead points"), []).append(Verdict("dead points", False if pushed else None, text))
        moved = [name for name, (low, high) in spans.items() if low < high or len(spans) == 1]
        for name, limits in stroke_search.limits(place.motion, moved).items():
            for is_behind, away, text in nearest_dead_points(place.motion, limits, spans[name]):
                nearest[name, is_behind] = min((away, text), nearest.get((name, is_behind), (away, text)))
            for each in dead_point_verdicts(place, limits, spans[name], is_pushed(judge, name)):
                if not (together and each.rule == "dead points"):
                    found.setdefault((name, each.rule), []).append(each)
    told = [each for known in found.values() for each in dict.fromkeys(known)]
    clear = [(name, text) for (name, _), (_, text) in nearest.items() if not {(name, "dead points"), ("", "dead points")} & found.keys()]
    if not clear:
        return told
    strokes, places = ", ".join(dict.fromkeys(name for name, _ in clear)), "; ".join(text for _, text in clear)
    text = said("none within the stroke; the nearest: {places}.", places=places)
    if any(place.over.only or place.over.shape == "poses" for place in judge.places):  # others may lie between what is asked
        text = said("none where it runs; the nearest beyond: {places}.", places=places)
    if any(rule == "dead points" for _, rule in found):  # along another stroke
        text = said("none along {strokes}; the nearest: {places}.", strokes=strokes, places=places)
    return [Verdict("dead points", True, text), *told]


def in_line(place: Domain) -> dict[tuple[int, ...], str]:
    """Return the loops that come into line at assembled places, in words, of each design that has such."""
    found: dict[tuple[int, ...], str] = {}
    for each in place.margins:
        flat = np.asarray((each.value <= IN_LINE**2) & ~np.asarray(each.is_hole)) & (each.kind in ("links", "guides"))
        for design in map(tuple, np.argwhere(flat).tolist()):
            strokes, time = {name: np.asarray(value)[design] for name, value in each.strokes.items()}, float(np.asarray(each.time)[design])
            at = places_text(strokes, each.units) if np.isnan(time) else "{} ({})".format(*timed_texts(strokes, each.units, time))
            text = said("{step} at {place}", step=name_or_pins(place.plan, each.step), place=at)
            found[design] = f"{found[design]}; {text}" if design in found else text
    return found


def is_pushed(judge: Judge, stroke: str) -> bool:
    """Return whether a cylinder moves with a stroke: one that is declared, or a length that follows a stroke."""
    bars = [(bar.P, bar.Q) for bar in judge.plan.cylinders]
    held = [each.ends for each in judge.plan.of_kind(TwoPoint).values() if each.holds]
    return any(stroke in judge.plan.reaches(end) for ends in (*bars, *held) for end in ends)


def domain_words(judge: Judge, among: Sequence[Domain] = ()) -> str:
    """Return all that a judge looks at in words, or some of it: the strokes of each `Over`, with its name where there are several."""
    named = [(place.over.name if len(judge.places) > 1 else "", place.over.words(place.motion)) for place in among or judge.places]
    return "; ".join(f"{name}: {words}" if name else words for name, words in named)


def assembly_verdicts(judge: Judge) -> list[Verdict]:
    """Return whether it is assembled wherever it runs; if not, the lost share, the missing length in the deepest place, a remedy."""
    if not judge.plan.strokes or not judge.plan.moving:
        return []
    answer, empty = judge.answer(reachable), judge.empty
    spans = domain_words(judge, [place for place in judge.places if place not in empty])
    ok: bool | None = bool(answer.ok)
    if len(empty) == len(judge.places):
        ok, text = None, said("over {spans} no place is left to look at.", spans=spans)
    elif nowhere := [name for name in judge.plan.ground if not np.isfinite(judge.places[0].motion[name]).all()]:
        text = said("{point} has no place, as its coordinates have no value. Change a dimension.", point=opening(judge.plan, nowhere[0]))
        ok = False
    elif not answer.lost:
        ok, text = True, said("it is assembled over {spans}.", spans=spans)
    elif not judge.is_reached:
        ok, text = False, " ".join(str(out_of_reach(judge.places[0].motion)).split())
    else:
        share = share_text(answer.lost.share)
        share = said("{share} of {over}", share=share, over=answer.over) if "over" in answer.named and answer.over else share
        deepest = {"share": share, "place": answer.place, "why": answer.lost.sentence}
        text = said("over {spans} {share} cannot be assembled, deepest {place}: {why}", spans=spans, **deepest).rstrip(".")
        remedy = said('what follows holds for the rest. Shorten a stroke, or declare Over(..., lost="allowed").')
        text = said("{lost}; its Over allows that.", lost=text) if ok else f"{text}; {remedy}"
    beyond, scarcely = list[str](), list[str]()
    for name, stroke in judge.plan.strokes.items():
        low, high = sorted((stroke.start, stroke.end))
        run, room = np.concatenate([np.ravel(place.motion.strokes[name]) for place in judge.places]), 1e-3 * (high - low)
        declared = f"{name} = {span_text([low, high], stroke_unit(judge.plan, name))}"
        if np.any((run < low - room) | (run > high + room)):
            beyond.append(declared)
        elif 0.0 < np.ptp(run) < SCARCELY * (high - low):
            scarcely.append(declared)
    text = f"{text} {said('It runs beyond the declared {strokes}.', strokes=', '.join(beyond))}" if beyond else text
    if scarcely:
        text += " " + said("Of the declared {strokes} it runs less than 1 %: are lengths in m, angles in rad?", strokes=", ".join(scarcely))
    passed = [said("over {spans} no place is left to look at.", spans=domain_words(judge, empty))] if empty and ok is not None else []
    occurring = [place.over.cases for place in judge.places]
    if judge.acting.case is None and None not in occurring and all(place.over.name for place in judge.places):
        never = sorted({*judge.plan.of_kind(LoadCase)}.difference(*filter(None, occurring)))
        unjudged = (case_title(each, case_titles(judge.plan)) for each in never)
        passed += [said("The load case {case} occurs over no Over, so that nothing is judged in it.", case=each) for each in unjudged]
    for name, stroke in judge.plan.strokes.items():
        turns = abs(stroke.end - stroke.start) / (2.0 * np.pi)
        if name in judge.plan.turning and turns > MANY_TURNS and not any(isinstance(end, Amount) for end in (stroke.start, stroke.end)):
            by = {end: shown_number(getattr(stroke, end), "") for end in ("start", "end")}
            by |= {"stroke": f"{name} = {stroke}", "turns": shown_number(turns, "", 3)}
            told = said("the stroke {stroke} is {turns} turns, in radians; degrees are written Stroke({start} * deg, {end} * deg).", **by)
            passed.append(told)
    return [Verdict("assembly", ok, text, answer=answer), *(Remark(f"{each[0].upper()}{each[1:]}") for each in passed)]


MANY_TURNS = 2.0
"""Of a stroke in rad that is written without a unit: more turns may be degrees."""
SCARCELY = 0.01
"""Of a declared stroke: where no more of it runs, a unit may be missing there."""


def nearest_dead_points(motion: Motion, limits: StrokeLimits, span: tuple[float, float]) -> Iterator[tuple[bool, float, str]]:
    """Yield the nearest dead points before and behind the part of a stroke that runs: which of both, how far away, and that in words."""
    low, high = span
    before = max((each for each in limits.dead_points if each[0] <= low), default=None)
    behind = min((each for each in limits.dead_points if each[0] >= high), default=None)
    for is_behind, each in enumerate((before, behind)):
        if each is not None:
            value, stop = each
            away = max(low - value, value - high)
            step = said("of {step}", step=opening(motion.plan, stop) if stop in motion.plan.members else stop)
            distance = said("{distance} beyond it", distance=show(away, limits.shown_unit, 3))
            yield bool(is_behind), away, f"{place_of(motion, limits, value, stop, step)}, {distance}"


def dead_point_verdicts(place: Domain, limits: StrokeLimits, span: tuple[float, float], pushed: bool) -> Iterator[Verdict]:
    """Yield the stops and turns along one stroke, within the part that runs and at places that are asked for.

    At an end it is a fault where it is `pushed` by a cylinder, which cannot start from there.
    """
    motion, (low, high) = place.motion, span
    near = NEAR_END * (high - low or abs(limits.end - limits.start))
    points = {each: max(low - each[0], each[0] - high) for each in limits.dead_points if is_asked(place, limits, each[0], near)}
    inside = "; ".join(place_of(motion, limits, *each) for each, away in points.items() if away < -near)
    at_end = "; ".join(place_of(motion, limits, *each) for each, away in points.items() if abs(away) <= near)
    passed = said("{places}, within the stroke: no drive passes there. Shorten the stroke or change a length.", places=inside)
    begun = said("{places}, where the stroke ends: no cylinder starts from there. Shorten the stroke or change a length.", places=at_end)
    if inside or (at_end and pushed):
        yield Verdict("dead points", False, " ".join([passed] * bool(inside) + [begun] * bool(at_end and pushed)))
    elif at_end:
        yield Verdict("dead points", None, said("{places}, where the stroke ends: no ratio and no force has a value there.", places=at_end))
    crossing, still = (
        [each for each in known if low - near <= each[0] <= high + near and is_asked(place, limits, each[0], near)]
        for known in (limits.change_points, limits.cylinder_dead_points)
    )
    if crossing:
        places = "; ".join(place_of(motion, limits, *each) for each in crossing)
        text = said("branches cross: {places}; there the motion may go on either way. Change a length, or guide it.", places=places)
        yield Verdict("change points", False, text)
    still = [each for each in still if not is_carried(motion, limits, *each)]
    if still:
        text = said(
            "its length stands still: {places}; there its thrust moves nothing. Move its pins, or keep away from there.",
            places="; ".join(place_of(motion, limits, *each) for each in still),
        )
        yield Verdict("cylinder's dead point", False, text)


def is_asked(place: Domain, limits: StrokeLimits, value: float, near: float) -> bool:
    """Return whether a machine runs at a value of a stroke, the others held: at poses to what is `near`, else where conditions hold."""
    if place.over.shape != "poses" and not place.over.only:
        return True
    there = motion_there(place.motion, limits, value)
    if place.over.shape == "poses":
        return bool(np.all([abs(given - there.strokes[name]) <= near for name, given in place.motion.strokes.items()], axis=0).any())
    with unwarned():
        return bool(place.over.condition_mask(there).all())


def is_carried(motion: Motion, limits: StrokeLimits, value: float, cylinder: str) -> bool:
    """Return whether a cylinder whose length stands still along one of several strokes has a thrust there: it holds another stroke."""
    if len(motion.plan.strokes) < 2:
        return False
    with suppress(DefinitionError), unwarned():
        thrust = from_above(THRUST)(motion_there(motion, limits, value), motion.plan.members[cylinder], PLAIN)
        return bool(np.isfinite(thrust).all())
    return False


def motion_there(motion: Motion, limits: StrokeLimits, value: float) -> Motion:
    """Return the pose at a value of a stroke, with the others where they are held."""
    return motion.moved({name: np.array([at]) for name, at, _ in limits.held} | {limits.stroke: np.array([value])})


def place_of(motion: Motion, limits: StrokeLimits, value: float, name: str, words: str = "") -> str:
    """Return a place along a stroke [m or rad] in words: `B at S = 123.4 mm`, with those of the other strokes that change it."""
    plan, held, others = motion.plan, {each: at for each, at, _ in limits.held}, list[str]()
    steps = {*name.split(", ")} & plan.members.keys() or {*plan.points}
    for other, at, unit in limits.held:
        ends = (plan.strokes[other].start, plan.strokes[other].end) if other in plan.reaches(*steps) else ()
        if not all(StrokeLine(motion, limits.stroke, {**held, other: end}).is_in_line(value, steps) for end in ends):
            others.append(f"{other} = {place_text(at, unit)}")
    place = said("{what} at {stroke} = {value}", what=words or name, stroke=limits.stroke, value=place_text(value, limits.unit))
    return place + (said(", with {strokes} held", strokes=", ".join(others)) if others else "")


def transmissions(judge: Judge) -> dict[str, Measure]:
    """Return the least transmission angle of every joint that has one and moves, as a question."""
    joints = (name for name in judge.motion._joints if not judge.plan.reaches(name).isdisjoint(judge.plan.strokes))
    return {name: least(transmission(name)) for name in joints}


# -- members -----------------------------------------------------------------------------------------------


def member_verdicts(judge: Judge, fault: str = "") -> list[Verdict]:
    """Return the verdicts of members that judge themselves; with their names where they share a rule with others.

    Those that ask for forces where these are refused for a `fault` say nothing.
    """
    members, found = speakers(judge.plan, HasVerdicts), list[tuple[str, Verdict]]()
    for name, member in members.items():
        try:
            found += [(name, verdict) for verdict in member.verdicts(judge) if not (fault and fault in verdict.sentence)]
        except DefinitionError:
            if not fault:
                raise
    named = told_apart(((name, verdict.rule) for name, verdict in found if verdict.is_rule), members)
    return [(verdict.named(name) if (name, verdict.rule) in named else verdict).said_by(name) for name, verdict in found]


def told_apart(rules: Iterable[tuple[str, str]], members: Mapping[str, HasVerdicts]) -> set[tuple[str, str]]:
    """Return those of the rules of members that bear their names: those that several follow, and all of one of several, such as lines."""
    followed = {(name, rule) for name, rule in rules if not rule.endswith(f" {name}")}
    count = Counter(rule for _, rule in followed)
    alike = Counter(each.headed for each in members.values() if each.named_in_all)
    return {(name, rule) for name, rule in followed if count[rule] > 1 or (members[name].named_in_all and alike[members[name].headed] > 1)}


def batch_verdicts(judge: Judge, fault: str = "") -> list[Verdict]:
    """Return, rule by rule, how many designs of a batch fail, with the verdict on the first of these."""
    reached = [place.motion.reached.reshape(-1, int(np.prod(place.motion._stroke_shape))) for place in judge.places]
    whole, total = np.all([each.all(axis=1) for each in reached], axis=0), len(reached[0])
    lost = np.flatnonzero(~whole)
    text = said("{n} of {total} designs cannot be assembled over the whole motion", n=lost.size, total=total)
    text += said("; the first is design {number}.", number=lost[0] + 1) if lost.size else "."
    found = [Verdict("assembly", not lost.size, text)]
    shape = judge.motion._design_shape
    numbered = [(int(np.ravel_multi_index(design, shape)), text) for place in judge.places for design, text in in_line(place).items()]
    if numbered:
        number, place = min(numbered)
        text = said("{n} of {total} designs come to one", n=len(dict(numbered)), total=total)
        text += said("; the first is design {number}: {sentence}", number=number + 1, sentence=f"{place}.")
        pushed = any(is_pushed(judge, name) for name in judge.plan.strokes)
        found.append(Verdict("dead points", False if pushed else None, text))
    if fault or not speakers(judge.plan, HasVerdicts):
        return found
    if total > JUDGED:
        text = said(
            "Members are judged for up to {most} designs, this batch has {total}: take a part of it, or survey.", most=JUDGED, total=total
        )
        return [*found, Remark(text)]
    failed: dict[str, list[tuple[int, str]]] = {}
    answers: dict[str, list[Answer]] = {}
    for number in np.flatnonzero(np.any([each.any(axis=1) for each in reached], axis=0)).tolist():
        for verdict in (each for each in member_verdicts(judge.for_design(number).lost_allowed()) if each.is_rule):
            failed.setdefault(verdict.rule, [])
            if verdict.answer is not None and np.isfinite(verdict.answer.value):
                answers.setdefault(verdict.rule, []).append(verdict.answer)
            if verdict.ok is False:
                failed[verdict.rule].append((number + 1, verdict.sentence))
    for rule, each_of in failed.items():
        text, known = said("{n} of {total} designs fail", n=len(each_of), total=total), answers.get(rule, []) if each_of else []
        low, high = (pick(known, key=lambda each: each.value, default=None) for pick in (min, max))
        if low is not None and high is not None and low.amount != high.amount:
            text += said(", of their worst values {low} to {high}", low=low.amount, high=high.amount)
        text += said("; the first is design {number}: {sentence}", number=each_of[0][0], sentence=each_of[0][1]) if each_of else "."
        found.append(Verdict(rule, not each_of, text))
    return found


# -- limits ------------------------------------------------------------------------------------------------


def limits_over(motion: Motion, overs: Sequence[Over | Motion] = (Over(),)) -> Limits:
    """Return the limits along every stroke of one design, and the lost share over the given places, by default the box of all."""
    strokes = stroke_search.limits(motion)
    if not strokes:
        return strokes
    judge = Judge(motion.plan, motion.designs, overs)
    lost, title = judge.answer(reachable).lost, "; ".join(place.over.words(place.motion) for place in judge.places)
    with unwarned():
        found = [each for place in judge.places if place.over.shape != "poses" for each in least_margins(place.motion)]
    least = dict[tuple[str, str], LoopMargin]()
    for each in found:
        best = least.get((each.step, each.kind))
        if not np.isnan(each.value) and (best is None or each.value < best.value):
            at = {name: float(value) for name, value in each.strokes.items()}
            least[each.step, each.kind] = replace(each, value=float(each.value), is_hole=bool(each.is_hole), strokes=at)
    margins = tuple(replace(each, step=name_or_pins(motion.plan, each.step)) for each in least.values())
    box = BoxLimits(title, lost.share, dict(lost.strokes), lost.sentence, margins)
    return Limits(strokes, box, width_words(motion.plan, motion.designs))


# Which poses are among those that a judge looks at: in a box, or near a leg or a pose, and where its conditions hold.

NEAR = 0.02
"""Of a stroke's travel: a pose that is no farther from a leg, a pose or a held value, in every stroke, is looked at with it."""
ROUNDING = 1e-9
"""Of a stroke's travel: a pose that is no farther outside a box stands at its border."""
PLACES = 257
"""Places of a path in time, which goes near enough straight from one to the next."""


def judged_poses(judge: Judge, motion: Motion, case: Case = None) -> Mask:
    """Return which poses of a motion a judge looks at.

    Parameters
    ----------
    judge : Judge
        Who looks, over its `Over`s: `machine.judge()`.
    motion : Motion
        Poses of the same machine.
    case : LoadCase or str, optional
        The load case that acts: what an `Over` looks at in others only is not looked at. By default any.

    Returns
    -------
    array of bool
        Of the motion's shape. It is True in a box of strokes, or where no stroke is farther than 2 % of its travel from a leg of a path, a
        pose or the value at which a box holds it. The conditions of that `Over` (`only`) are kept there as well.
    """
    found = np.zeros(require_motion(motion).shape, bool)
    for place in judge.places:
        if case is None or not place.over.cases or name_of(case) in place.over.cases:
            found |= covered(place, motion) & place.over.condition_mask(motion)
    return found


def covered(place: Domain, motion: Motion) -> Mask:
    """Return which poses lie in the box, or near a leg or a pose, of an `Over`."""
    way = place.motion if place.instants is None else place.timed(place.instants.shares(np.linspace(0.0, 1.0, PLACES)), "nan")
    values, spans = (np.broadcast_arrays(*each.strokes.values()) for each in (motion, way))
    inside, low, high = np.ones((1,), bool), np.zeros(1), np.ones(1)
    for stroke, of_poses, span in zip(motion.plan.strokes.values(), values, spans, strict=True):
        travel, value, ends = abs(stroke.end - stroke.start), of_poses[..., None], np.ravel(span)
        if place.over.shape == "box":
            near = (ROUNDING if np.ptp(ends) > 0.0 else NEAR) * travel
            inside = inside & (value >= ends.min() - near) & (value <= ends.max() + near)
            continue
        is_path = place.over.shape == "path" and ends.size > 1
        start, step = (ends[:-1], np.diff(ends)) if is_path else (ends, np.zeros(ends.size))
        # the shares of each leg at which this stroke is near enough: all strokes must be so at one of them
        with np.errstate(divide="ignore", invalid="ignore"):
            first, last = ((value - start + sign * NEAR * travel * np.sign(step)) / step for sign in (-1.0, 1.0))
        moves = step != 0.0
        inside = inside & (moves | (np.abs(value - start) <= NEAR * travel))
        low = np.maximum(low, np.where(moves, first, 0.0))
        high = np.minimum(high, np.where(moves, last, 1.0))
    return np.broadcast_to((inside & (low <= high)).any(axis=-1), motion.shape)


def pose_sentence(motion: Motion) -> str:
    """Return the rules that a pose breaks, in words.

    Parameters
    ----------
    motion : Motion
        One design at one pose, which is reached.

    Returns
    -------
    str
        The rules of its members that are not kept there, with their numbers, or that all are; whether the pose is outside what is judged,
        and which rules have no value there. "" for a machine that no member judges. Load cases are those that occur where the pose
        lies, all of them where it lies outside.
    """
    plan, designs = require_motion(motion).plan, motion.designs
    judge = Judge(plan, designs, [*plan.of_kind(Over).values()] or [Over()])
    near = [place for place in judge.places if (covered(place, motion) & place.over.condition_mask(motion)).all()]
    occurring = dict.fromkeys(place.over.cases for place in near or judge.places)
    at_pose = Judge(plan, designs, [over_pose(motion, cases) for cases in occurring])
    found, unknown, faults = dict[str, Answer](), list[str](), list[str]()
    with unwarned():
        for rule, (*_, condition) in rules_of(at_pose).items():
            heading = heading_of(rule)
            try:
                found[heading] = at_pose.answer(condition)
            except LinkageError:
                unknown.append(heading)
    if not found and not unknown:
        return ""
    for rule, each in found.items():
        if each.ok is False:
            told = show(float(each.value), display_unit(each.measures, "mm"), 4, float(each.limit))
            value = told if np.isfinite(each.value) else said("no value")
            case = case_title(each.case, each.titles)
            faults.append(f"{rule} {value} ({case})" if each.case and "case" in each.named else f"{rule} {value}")
    if near and not faults and not unknown:
        cases = () if None in occurring else dict.fromkeys(case for each in occurring for case in each or ())
        is_part = cases and {*cases} != {PLAIN_CASE, *plan.of_kind(LoadCase)}
        return all_kept_here(", ".join(case_in_words(each, case_titles(plan)) for each in cases) if is_part else "")
    kept = said("all kept") if not unknown else said("{n} kept", n=len(found)) if found else ""
    here = ", ".join(faults) or kept
    parts = [] if near else [said("outside what is judged")]
    parts += [here if near else f"{said('if it were judged:')} {here}"] if here else []
    parts += [said("{n} not followed here: {rules}", n=len(unknown), rules=", ".join(unknown))] if unknown else []
    return f"{said('At this pose:')} {'; '.join(parts)}."


def all_kept_here(cases: str = "") -> str:
    """Return the sentence of a pose where every rule is followed and kept, in load cases in words where only some occur there."""
    return f"{said('At this pose:')} {said('all kept')} {cases}".rstrip() + "."


INSTANT = 1e-9
"""Of the time of a path: so long is what is judged at one of its instants, as it runs there."""


def over_pose(motion: Motion, cases: Sequence[str] | None) -> Over:
    """Return where a pose is judged: it alone, in time the shortest way from it on, at the end up to it."""
    instants = motion._instants
    if instants is None or not instants.courses:
        places: dict[str, Any] = {name: [float(np.ravel(value)[0])] for name, value in motion.strokes.items()}
        return Over.poses(cases=cases, **places)
    (first, last), time = instants.breaks[[0, -1]].tolist(), float(np.ravel(instants.time)[0])
    begin = min(max(time, first), last - INSTANT * (last - first))
    courses: dict[str, Any] = dict(instants.courses)
    return Over.path(cases=cases, time=(begin, begin + INSTANT * (last - first)), **courses)


def rules_of(judge: Judge) -> dict[str, tuple[str, str, Condition]]:
    """Return the conditions of all members by their rules, each with its member and the rule alone.

    A rule has the member's name where that shares one with another.
    """
    members, found = speakers(judge.plan, HasVerdicts), list[tuple[str, str, Condition]]()
    for name, member in members.items():
        with suppress(LinkageError):
            found += [(name, rule, each) for rule, each in member.conditions(judge).items()]
    named = told_apart(((name, rule) for name, rule, _ in found), members)
    return {f"{each[1]} {each[0]}" if each[:2] in named else each[1]: each for each in found}


Motion._limits_of = limits_over  # a motion's limits ask the judge, who is made with motions
