"""Questions of a live page for a changed design: the judge's, split into their pieces, as plain data for `judge.js`."""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Mapping, Sequence
from contextlib import suppress
from functools import cached_property, reduce
from typing import Any, TypeAlias

import numpy as np

from ..errors import LawError, LinkageError, UntracedError, ensure, unwarned
from ..language import heading_of, language, translated
from ..loads import FRICTIONLESS, PLAIN_CASE, Acting, case_titles
from ..mechanism import Mechanism
from ..motion import (
    Answer,
    Column,
    Condition,
    HasVerdicts,
    Instants,
    LiveText,
    Motion,
    PageWords,
    Request,
    RequestLike,
    least,
    most,
    speakers,
)
from ..motion.judge import Domain, Judge, SearchRow, is_worst_bound, leaf_key, measures_of
from ..motion.measures import At, Constraint, Integral, Leaf, Measure, conditions_of, dimension_value, measure_of, strokes_behind
from ..motion.motion_verdicts import NEAR, rules_of, verdict_questions
from ..motion.over import ALLOWED
from ..motion.requests import NodeRequest, bound, is_of_force, situated
from ..plan import Plan
from ..program import Node
from ..quantities import is_number, quantity
from ..reports import at_its_rates, is_column
from ..units import display_unit, factor, shown_in
from ..verdict import Verdict
from .page_file import PageData
from .shown_values import limit_of, typeset, unit_typeset

Piece: TypeAlias = tuple[int, SearchRow, str]
"""The place of an `Over` among those of the judge, what is sought over it, and the name of its row."""
PLAIN_WORDS = PageWords("")
"""Of a condition that is said by its own number."""
MOST = 5000
"""Poses that a page looks at for all its questions together."""
DeliveredRow: TypeAlias = tuple[float | None, ...]
"""What no program gives, at even instants of a path in time; None where it has no value."""
INSTANTS = 65
"""Instants of a path in time at which a page has what no program gives; from one to the next it goes straight."""
PHASES = 200
"""A course of more phases goes to a page as so many cubics through its values and rates."""
TRUTHS = {"gaps": "where it has a bound", "assumed": "where it is true"}


def where_true(request: Request, which: str) -> NodeRequest:
    """Return the least of the nodes above zero where a bound request has a bound ("gaps"), or its program is true ("assumed"); else one."""

    def nodes(plan: Plan) -> tuple[Node, ...]:
        request.nodes(plan)
        found = list(request.gaps(plan) if which == "gaps" else request.notes(plan).assumed)
        graph = plan.trace.graph
        return (reduce(lambda a, b: graph.apply("minimum", a, b), found) if found else graph.one,)

    text = f"{TRUTHS[which]} of {request.sentence}"
    return NodeRequest(text=text, key=("where", which, request.key), nodes_of=nodes, names_of=request.names)


class LiveQuestions:
    """The questions of a page, and the rows that they ask the program for, by names of their own."""

    def __init__(
        self, machine: Mechanism, judge: Judge, limits: Mapping[str, Sequence[object]], columns: Mapping[str, tuple[Column, Any, str]]
    ) -> None:
        self.machine, self.judge = machine, judge
        self.by_name: dict[str, RequestLike] = {}
        self.only = [[self.new_row(each.margin, " only") for each in place.over.only] for place in self.judge.places]
        self.ends = [self.rows_of_ends(place.over.strokes if place.instants is None else {}) for place in self.judge.places]
        self.asked: list[tuple[str, list[Constraint], dict[Leaf, list[Piece]]]] = []
        self.said: dict[str, tuple[str, PageWords]] = {}
        self.units, self.untraced = dict[str, str](), False
        self.delivered = dict[str, list[DeliveredRow]]()
        with unwarned(), suppress(LinkageError):  # what verdicts ask is looked for in one pass
            judge.answers(verdict_questions(judge))
        with unwarned():
            for rule, (member, own, condition) in rules_of(judge).items():
                words = PLAIN_WORDS
                with suppress(LinkageError):
                    words = speakers(machine.plan, HasVerdicts)[member].page_words(judge).get(own, PLAIN_WORDS)
                if words.is_followed:
                    self.ask(rule, member, condition, words)
        for name, given in limits.items():
            column, request, why = columns[name]
            limit, self.units[name] = limit_of(given), column.unit
            at_rest = situated(request, Acting(direction=FRICTIONLESS))
            for each in () if why else dict.fromkeys((request, at_rest)):  # where no program gives it while it moves, that is at rest
                self.untraced, before = False, dict(self.by_name)
                self.ask(name, "", least(each) >= limit.value if limit.fails == "below" else most(each) <= limit.value)
                if not self.untraced or each is at_rest:
                    break
                self.asked, self.by_name = [one for one in self.asked if one[0] != name], before

    def ask(self, rule: str, member: str, condition: Condition, words: PageWords = PLAIN_WORDS) -> None:
        """Note a question and its pieces; nothing where it cannot be split, or plain words where these cannot."""
        constraints = conditions_of([condition], self.machine)
        measures = [side for each in constraints for side in (each.left, each.right)]
        measures += [each for each in (words.measure, words.share) if each is not None]
        known, pieces, count = dict[Hashable, list[Piece]](), dict[Leaf, list[Piece]](), len(self.by_name)
        try:
            for leaf in (leaf for each in measures for leaf in each.leaves):
                key = leaf_key(self.machine.plan, leaf)
                if key not in known:
                    known[key] = self.leaf_rows(leaf)
                pieces[leaf] = known[key]
        except LinkageError:
            for name in [*self.by_name][count:]:  # what is refused, as forces of a loose machine are, is not asked of the program
                del self.by_name[name]
                self.delivered.pop(name, None)
            if words.measure is not None:
                self.ask(rule, member, condition)
            return
        self.asked.append((rule, constraints, pieces))
        self.said[rule] = member, words

    def new_row(self, request: RequestLike, kind: str = "") -> str:
        """Return the name of a new row, of a kind, that a request asks for."""
        name = f"judge {len(self.by_name)}{kind}"
        self.by_name[name] = request
        return name

    def leaf_rows(self, leaf: Leaf) -> list[Piece]:
        """Return the pieces of a leaf with the names of their rows, over every `Over`; of a value at one pose the row alone."""
        is_fixed = isinstance(leaf, Integral) or (isinstance(leaf, At) and bool(strokes_behind(self.machine.plan, leaf.quantity)))
        ensure(not is_fixed, f"{leaf}: an integral, or a value at a pose of its own, is not followed in the page.")
        found = []
        for number, place in enumerate(self.judge.places[:1] if isinstance(leaf, At) else self.judge.places):
            is_timed = place.instants is not None and is_of_force(leaf.quantity)
            if is_column(leaf.quantity) and PLAIN_CASE not in place.cases(self.judge.acting):
                continue  # a table's own column is under the machine's own loads, which do not occur here
            for row in self.judge.search_rows(leaf, place):
                request = at_its_rates(place.motion, row.request) if is_timed else row.request
                name = self.new_row(request)
                try:
                    looked_up = bound(self.machine.plan, request)
                except (LawError, UntracedError):  # it is left out of the program then, and its question with it
                    self.untraced = True
                    if is_timed:
                        self.delivered[name] = delivered_over(place, row.request)
                else:
                    self.by_name |= {f"{name} {which}": where_true(looked_up, which) for which in TRUTHS}
                found.append((number, row, name))
        return found

    @property
    def broken(self) -> Iterator[tuple[Motion, list[Request]]]:
        """The questions that are not kept: the pose where each is worst, and what it asks there."""
        with unwarned():
            answers = iter(self.judge.answers([each for _, constraints, _ in self.asked for each in constraints]))
        for _, constraints, pieces in self.asked:
            for each, answer in zip(constraints, answers, strict=False):
                if answer.ok is False and answer.strokes:
                    yield self.judge.there(answer), [row.request for leaf in each.left.leaves for _, row, _ in pieces[leaf]]

    @cached_property
    def delivered_rows(self) -> list[DeliveredRow]:
        """The rows that are delivered, those that are equal once."""
        return list(dict.fromkeys(row for rows in self.delivered.values() for row in rows))

    def rows_of_ends(self, strokes: Mapping[str, object]) -> dict[tuple[str, int], str]:
        """Return the rows of the ends and places that follow the design, by their strokes and places among them."""
        spellings, names = self.machine.plan.table.spellings, {}
        for name, given in strokes.items():
            for k, each in enumerate(given if isinstance(given, tuple) else (given,)):
                if not is_number(each):
                    owned = isinstance(each, str) and each in spellings
                    names[name, k] = self.new_row(dimension_value(*spellings[each]) if owned else quantity(each), " end")
        return names

    # -- as data -----------------------------------------------------------------------------------------

    def data(self, live: LiveText) -> PageData:
        """Return the data for `judge.js`: the overs, the questions that the program can answer, and the greatest number of poses."""
        can_look = all(name in live.rows for names in (*self.only, *(ends.values() for ends in self.ends)) for name in names)
        asked = [self.question(live, *each) for each in self.asked] if can_look else []
        overs = [
            over_data(place, {key: live.rows[name][0] for key, name in ends.items() if name in live.rows})
            | {"only": [live.rows[name][0] for name in names if name in live.rows]}
            for place, names, ends in zip(self.judge.places, self.only, self.ends, strict=True)
        ]
        travel = [abs(each.end - each.start) for each in self.machine.plan.strokes.values()]
        found: PageData = {"overs": overs, "questions": [each for each in asked if each], "most": MOST, "travel": travel, "near": NEAR}
        return found | ({"delivered": self.delivered_rows} if self.delivered else {})

    def question(self, live: LiveText, rule: str, constraints: list[Constraint], pieces: Mapping[Leaf, list[Piece]]) -> PageData:
        """Return a question as data; nothing where the program does not give one of its pieces."""
        kinds = ("", *(f" {which}" for which in TRUTHS))
        followed = {
            leaf: all(name in self.delivered or all(f"{name}{kind}" in live.rows for kind in kinds) for _, _, name in own)
            for leaf, own in pieces.items()
        }
        if not all(followed[leaf] for each in constraints for side in (each.left, each.right) for leaf in side.leaves):
            return {}
        leaves = list({id(own): (leaf, own) for leaf, own in pieces.items() if followed[leaf]}.values())
        places = {leaf: next(k for k, (_, each) in enumerate(leaves) if each is own) for leaf, own in pieces.items() if followed[leaf]}
        found = [{"at": int(isinstance(leaf, At)), "pieces": [self.piece_data(live, *each) for each in own]} for leaf, own in leaves]
        measures = measures_of(self.machine.plan, constraints[0])
        unit = unit_data(self.units[rule]) if rule in self.units else live_unit(self.machine.plan, constraints[0])
        member, words = self.said[rule]
        if any(not followed[leaf] for each in (words.measure, words.share) if each is not None for leaf in each.leaves):
            words = PLAIN_WORDS
        with language("ru"):
            russian, text = heading_of(rule), translated(words.text)
            fails = {symbol: [typeset(each), typeset(translated(each))] for symbol, each in words.fails.items()}

        def placed(leaf: Leaf) -> PageData:
            return {"leaf": places[leaf]}

        told: PageData = ({"words": [typeset(words.text), typeset(text)]} if words.text else {}) | ({"fails": fails} if fails else {})
        if words.measure is not None:
            said = live_unit(self.machine.plan, words.measure)
            told |= {"says": words.measure.tree(placed), "saysUnit": said if said["unit"] else said | {"figures": 3}}
        if words.share is not None:
            told["share"] = words.share.tree(placed)
        return told | {
            "rule": typeset(rule),
            "ru": typeset(russian),
            "member": member,
            "key": rule_key(rule, member),
            "isLength": int(measures == "length"),
            "unit": unit,
            "leaves": found,
            "constraints": [
                dict(zip(("symbol", "left", "right"), each.tree(placed), strict=True))
                | {"whole": int(not is_worst_bound(each))}
                | own_unit(self.machine.plan, each, constraints[0])
                for each in constraints
            ],
        }

    def piece_data(self, live: LiveText, number: int, row: SearchRow, name: str) -> PageData:
        """Return a piece as data: its `Over`, its rows, behind those of the program the delivered ones, its situation."""
        situation, place = row.situation, self.judge.places[number]
        if name in self.delivered:
            behind = max(first + count for first, count in live.rows.values())
            rows = {what: behind + self.delivered_rows.index(own) for what, own in zip(("row", "gaps"), self.delivered[name], strict=True)}
        else:
            rows = {"row": live.rows[name][0], "gaps": live.rows[f"{name} gaps"][0], "assumed": live.rows[f"{name} assumed"][0]}
        is_timed = place.instants is not None and is_of_force(row.leaf.quantity)
        told = {"timed": int(is_timed), "reciprocal": int(row.is_reciprocal), "stays": int(row.stays_at_zero), "side": row.piece.side}
        case = case_titles(self.machine.plan).get(situation.case, situation.case)
        told |= {"case": case, "direction": situation.direction, "drive": situation.drive}
        return rows | {"over": number, "sense": row.search_sign} | {name: each for name, each in told.items() if each}


def delivered_over(place: Domain, request: Request) -> list[DeliveredRow]:
    """Return values without a program over a path in time, at even instants, and values above zero where they have a bound."""
    assert place.instants is not None
    motion = place.timed(place.instants.shares(np.linspace(0.0, 1.0, INSTANTS)), "nan")
    with unwarned():
        values, free = motion[request], request.unlimited(motion)
    bounded = np.ones(motion.shape) if free is None else np.where(free, -1.0, 1.0)
    return [tuple(float(f"{each:.7g}") if np.isfinite(each) else None for each in row.tolist()) for row in (values, bounded)]


def course_data(instants: Instants) -> PageData:
    """Return the courses of the strokes over a path in time, from its begin to its end [s]: breaks, and powers of the time since each."""
    begin, end = instants.breaks[[0, -1]].tolist()
    found = list[list[Any]]()
    for course in instants.courses.values():
        breaks, rows = course.breaks, course._phases
        if len(breaks) > PHASES:
            breaks = np.linspace(begin, end, PHASES + 1)
            value, rate = (np.asarray(course(breaks, order)) for order in (0, 1))
            step = (end - begin) / PHASES
            slope, last = np.diff(value) / step, rate[1:]
            bend = (3.0 * slope - 2.0 * rate[:-1] - last) / step
            rows = np.array([value[:-1], rate[:-1], bend, (rate[:-1] + last - 2.0 * slope) / step**2])
        found.append([breaks.tolist(), rows.T.tolist(), course._last])
    return {"time": [begin, end], "courses": found}


def rule_key(rule: str, member: str) -> str:
    """Return the key of a member's rule, with or without the member's name, which it bears where several have it."""
    return f"{member} {rule.removesuffix(f' {member}')}"


def share_used(judge: Judge, verdict: Verdict, answer: Answer) -> tuple[PageWords, str, float]:
    """Return the words of a rule, what it measures, and how far its limit is used; a length that fits uses nothing."""
    member, key = speakers(judge.plan, HasVerdicts).get(verdict.member), rule_key(verdict.rule, verdict.member)
    rules = {} if member is None else member.page_words(judge)
    words = next((each for rule, each in rules.items() if rule_key(rule, verdict.member) == key), PLAIN_WORDS)
    question = answer.question.left if isinstance(answer.question, Constraint) else answer.question
    kind = answer.measures or measure_of(judge.plan, question)
    if words.share is not None:
        return words, kind, float(judge.answer(words.share).value)
    return words, kind, 0.0 if verdict.ok and kind == "length" else float(answer.used)


def live_unit(plan: Plan, asked: Measure | Constraint) -> PageData:
    """Return the unit that the value of a measure or a question is shown in, and its factor."""
    return unit_data(display_unit(measures_of(plan, asked), "mm"))


def own_unit(plan: Plan, constraint: Constraint, first: Constraint) -> PageData:
    """Return the unit of a constraint that bounds another kind than the first of its question, as a force beside a pressure."""
    found = live_unit(plan, constraint)
    return {} if found == live_unit(plan, first) else {"unit": found}


def unit_data(unit: str) -> PageData:
    """Return the unit that values of a unit are shown in, and its factor."""
    return {"unit": unit_typeset(shown_in(unit)), "factor": factor(shown_in(unit))}


def over_data(place: Domain, rows: Mapping[tuple[str, int], int]) -> PageData:
    """Return an `Over` as data: the ends of a box, or the places of a path or of poses, stroke by stroke [m or rad].

    What follows the design is a row of the program, with the value of the delivered one: [row, value]. Of a path in time these are the
    courses of its strokes.
    """
    over, motion = place.over, place.motion
    found: PageData = {"name": over.name, "shape": over.shape, "lost": int(over.lost == ALLOWED)}
    if place.instants is not None:
        return found | course_data(place.instants)
    values = {name: np.broadcast_to(np.asarray(value, float), motion._stroke_shape).ravel() for name, value in motion.strokes.items()}
    listed = []
    for name, value in values.items():
        given = over.strokes.get(name)
        held = not isinstance(given, tuple)
        if over.shape == "box":  # the two ends, in the order in which they are given where one of them is a number
            value = np.array([value.min(), value.max()])
            numbers = [float(each) if is_number(each) else None for each in given] if isinstance(given, tuple) else []
            value = value[::-1] if numbers and (numbers[0] == value[1] or numbers[1] == value[0]) else value
        keys = [(name, 0 if held else k) for k in range(len(value))]
        listed.append([[rows[key], number] if key in rows else number for key, number in zip(keys, value.tolist(), strict=True)])
    return found | {"ends" if over.shape == "box" else "places": listed}
