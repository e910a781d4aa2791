"""The verdicts of a report, and the worst place of each: its value, its share of the limit, and where it is."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ..errors import LinkageError, unwarned
from ..language import heading_of, said, said_of
from ..loads import PLAIN_CASE
from ..mechanism import verdicts_of
from ..motion import Answer, Column, MotionFunction, Request, places_text
from ..motion.measures import Constraint, least, measure_of, most
from ..pictures.page_judge import share_used
from ..pictures.shown_values import limit_of
from ..reports import is_column
from ..units import display_unit, show, shown_number
from ..verdict import Verdict
from .content import Mark, Section, TableBlock
from .run import CLOSE, ReportSubject, largest


def verdict_section(subject: ReportSubject, limits: Mapping[str, Sequence[object]]) -> tuple[Section, Mark, Sequence[Verdict], str]:
    """Return the section of a machine's verdicts over all that it runs, with its worst places, how many rules are kept, and all of them.

    The last is which rules and limits of columns are not kept.
    """
    title = said("Verdicts")
    try:
        with unwarned():
            found = verdicts_of(subject.machine, subject.verdict_judge)
            limited = limit_answers(subject, limits)
    except LinkageError as error:
        text = said("The machine cannot be judged over all that it runs: {why}", why=str(error))
        return Section(title, (text,)), Mark(False, said("not judged")), (), ""
    if not found:
        return Section(title, (said("This machine declares no rules of its own."),)), Mark(None, said("no rules declared")), (), ""
    judged = [each for each in found if each.is_rule]
    domain = said("Judged over all that the machine runs, in all load cases and directions of motion that occur there.")
    heads = (said("rule"), said("result"), said("what was found"))
    rows = tuple((each.heading, verdict_mark(each.ok) if each.is_rule else Mark(None, "–"), each.sentence) for each in found)
    table = TableBlock(said("Rules, over all that the machine runs"), heads, rows, "llm")
    places = [rule_row(subject, each, each.answer) for each in judged if isinstance(each.answer, Answer)]
    broken = [*(each.heading for each in judged if each.ok is False), *(each.rule for each in limited if each.ok is False)]
    shown = Section(title, (domain, table, *worst_places(subject, [*places, *limited])))
    kept, silent = (sum(each.ok is ok for each in judged) for ok in (True, None))
    word = said("{kept} of {all} rules kept", kept=kept, all=len(judged)) if judged else said("no rules declared")
    if silent:
        word = said_of(silent, "{rules}, {n} says nothing", "{rules}, {n} say nothing", rules=word)
    passed = sum(each.ok is False for each in limited)
    if passed:
        word = said_of(passed, "{rules}, {n} limit is exceeded", "{rules}, {n} limits are exceeded", rules=word)
    mark = Mark(False if broken else None if silent or not judged else True, word)
    return shown, mark, found, "; ".join(dict.fromkeys(broken))


def verdict_mark(ok: bool | None) -> Mark:
    """Return the mark of a verdict."""
    return Mark.of(ok, said("says nothing"))


# The worst places of all rules.

MOST_PLACES = 10
"""Rows of the table of the worst places."""


class JudgedRow(NamedTuple):
    """A rule by its name, whether it is kept, its answer, how far its limit is used, the column that it bounds, and the sign of a share."""

    rule: str
    ok: bool | None
    answer: Answer
    used: float
    column: Column | None = None
    sign: str = ""


def limit_answers(subject: ReportSubject, limits: Mapping[str, Sequence[object]]) -> list[JudgedRow]:
    """Return the judge's answers to the limits of columns, by their headings, where the columns have requests."""
    columns = subject.columns_along(replace(subject.run, case=None), subject.curve)
    asked, quantities = {}, subject.quantities(limits)
    for name, given in limits.items():
        quantity, limit = quantities.get(name), limit_of(given)
        if quantity is not None:
            asked[name] = least(quantity) >= limit.value if limit.fails == "below" else most(quantity) <= limit.value
    own = [name for name in asked if is_column(quantities[name])]
    plain = [place.over for place in subject.judge.places if PLAIN_CASE in place.cases(subject.judge.acting)]
    answers = dict(zip(asked, subject.judge.answers([*asked.values()]), strict=True))
    if own and plain and len(plain) < len(subject.judge.places):  # a table's own column is under the machine's own loads
        judge = subject.machine.judge(plain, subject.judge.acting).lost_allowed()
        answers |= zip(own, judge.answers([asked[name] for name in own]), strict=True)
    for name, each in answers.items():  # what is missed by the rounding of the column's own numbers is kept, as verdicts have it
        if each.ok is False and name in columns and abs(each.value - limit_of(limits[name]).value) <= CLOSE * largest(columns[name].values):
            answers[name] = replace(each, ok=True)
    return [JudgedRow(heading_of(name), each.ok, each, float(each.used), columns.get(name)) for name, each in answers.items()]


def worst_places(subject: ReportSubject, answers: Sequence[JudgedRow]) -> Iterator[TableBlock]:
    """Yield the table of the worst places of some rules, if there are any: those not kept first, then by how far the limit is used.

    What has no such share stands behind those that have one, as on a page.
    A rule that is kept and says of no limit how far it is used has no worst place.
    """
    known = (each for each in answers if each.answer.strokes and not np.isnan(each.answer.value))
    near = (each for each in known if each.ok is False or 0.0 < each.used < np.inf)
    rows, ranked = [], sorted(near, key=lambda each: (each.ok is not False, -each.used if each.used < np.inf else 0.0))
    for rule, ok, each, of_limit, column, sign in ranked[:MOST_PLACES]:
        share = f"{100.0 * of_limit:.0f} %" if 0.0 < of_limit < np.inf else "–"
        measure = each.question.left if isinstance(each.question, Constraint) else each.question
        kind, quantity = each.measures or measure_of(subject.machine.plan, measure), getattr(measure, "quantity", None)
        value = "–"  # of what kind it is, is unknown
        if each.unbounded:
            value = each.amount
        elif column is not None or kind or (isinstance(quantity, Request) and not isinstance(quantity, MotionFunction)):
            missed = float(each.limit) if ok is False else None
            value = f"{show(float(each.value), display_unit(kind, 'mm') if column is None else column.unit, 4, missed)}{sign}"
        rows.append((rule, verdict_mark(ok), value, share, each.situation, places_text(each.strokes, each.units)))
    heads = (said("rule"), said("result"), said("value"), said("limit used"), said("situation"), said("strokes"))
    if rows:
        yield TableBlock(said("The worst places"), heads, tuple(rows), "llrrmm")


def rule_row(subject: ReportSubject, verdict: Verdict, answer: Answer) -> JudgedRow:
    """Return the row of a rule, with the number that its sentence says, and how far its limit is used, as on a page."""
    words, kind, of_limit = share_used(subject.judge, verdict, answer)
    sign = " %" if kind == "number" and "{value} %" in words.text else ""
    if kind == "number" and words.measure is not None:
        told = float(subject.judge.answer(words.measure).value)
        answer = replace(answer, value=float(shown_number(told, "", 3)))  # as its sentence says it
    return JudgedRow(verdict.heading, verdict.ok, answer, of_limit, sign=sign)
