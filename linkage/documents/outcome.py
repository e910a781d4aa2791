"""What comes out over the stroke: tables, curves, cylinders, the forces of the joints, the limits of motion."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from ..errors import LinkageError, known_name, unwarned
from ..language import heading_of, said, translated
from ..loads import PLAIN_CASE, Acting
from ..motion import Answer, Column, Measure, Motion, Request, Tabled, least, most, speakers
from ..motion.limits import StrokeLimits
from ..motion.measures import Least, Most
from ..motion.requests import Trait
from ..pictures import mechanism
from ..pictures.curves import limit_of, note, panel
from ..pictures.scene import Scene
from ..pictures.style import ACCENT, INK, THIN, TITLE
from ..program import FloatArray
from ..reports import results
from ..reports.table import column_blocks, flat
from ..reports.table import column_texts as text_cells
from ..units import UNITS, factor, show, unit_sign
from .content import Block, Cell, Illustration, Section, TableBlock
from .pictures import ROOM, WIDE, height_of, in_one_unit
from .run import ReportSubject

HALF = 3.25
"""The width of a curve [inch]; two stand beside each other."""
CURVE_ROOM = (0.72, 0.12, 0.46, 0.32)
"""The room beside a curve's axes [inch: left, right, bottom, top]."""
NO_LETTER = re.compile("[^0-9A-Za-z]")
"""What the name of a picture's file does not have."""
LETTERS = 100
"""Letters of a table's row, so that it fits across a page."""


# -- drawings ----------------------------------------------------------------------------------------------


def sketch_section(subject: ReportSubject, path: Sequence[str]) -> Section:
    """Return the section of the sketch: the machine with its pins by name, at both ends of the stroke, with the paths of points."""
    reached = np.flatnonzero(subject.curve.reached)
    poses = [subject.strokes_at(subject.curve, int(place)) for place in (reached[0], reached[-1])]
    ends = [subject.words({name: pose[name] for name in pose if name in subject.run.ways}) for pose in poses]
    paths = said(" Broken line: path of {points}.", points=", ".join(path)) if path else ""
    sketch = Illustration(
        "sketch", said("The machine with its pins, at {start} (faint) and at {end}.", start=ends[0], end=ends[1]) + paths,
        (WIDE, height_of(Scene(subject.curve))), ROOM, partial(positions, motion=subject.curve, path=path),
    )  # fmt: skip
    return Section(said("Sketch"), (sketch,))


def positions(ax: Axes, motion: Motion, path: Sequence[str]) -> None:
    """Draw a mechanism at both ends of what it reaches, and the paths of points."""
    reached = np.flatnonzero(motion.reached).tolist()
    mechanism(ax, motion, int(reached[0]), faint=True)
    mechanism(ax, motion, int(reached[-1]))
    for name in path:
        ax.plot(*motion[name], color=ACCENT, linewidth=1.6 * THIN, linestyle=(0, (5, 2)), zorder=9.0)
    in_one_unit(ax)


# -- tables and curves -------------------------------------------------------------------------------------


def reported_columns(subject: ReportSubject, names: Sequence[str] | None) -> list[Column]:
    """Return the columns of results at the poses of the tables: those named, else all; DefinitionError for an unknown name."""
    with unwarned():
        found = results(subject.machine, subject.table)
    if names is None:
        return found
    known = {column.name: column for column in found}
    for name in names:
        known_name("Column", name, known, where=f"the table of {subject.machine.plan.title}")
    return [known[name] for name in dict.fromkeys([*(each for each in subject.machine.strokes if each in known), *names])]


def results_blocks(
    subject: ReportSubject, names: Sequence[str] | None, first: str, limits: Mapping[str, Sequence[object]]
) -> Iterator[Block]:
    """Yield the table over the stroke and the curves, the one the machine is about first."""
    columns = reported_columns(subject, names)
    along, held = ", ".join(subject.run.ways), subject.words(dict(subject.run.held))
    if held:
        yield said("Along {stroke}, with {held} held.", stroke=along, held=held)
    missing = int(np.count_nonzero(~subject.table.reached))
    if missing:
        yield said("{n} of {count} poses of the table cannot be assembled; they have no values.", n=missing, count=subject.count)
    yield from column_grids(said("Results over the stroke"), [column for column in columns if column.name not in subject.run.held])
    whole = curve_columns(subject)
    coordinates = {f"{point}_{axis}" for point in subject.machine.plan.points for axis in "xy"}
    drawn = [name for name in whole if name != first and (name in names if names is not None else name not in coordinates)]
    same = one_curve([first, *drawn], whole, limits)
    first = next(name for name in same if first in (name, *same[name]))
    still = [name for name in same if name not in (first, *limits) and is_constant(whole[name])] if held else []
    if still:
        yield said("The same all along this run, and not drawn: {names}.", names=", ".join(map(heading_of, still)))
    drawn = [first, *(name for name in same if name not in (first, *still))]
    beyond = wider_answers(subject, {name: whole[name] for name in drawn}, limits)
    for name in drawn:
        bound, further = limits.get(name), beyond.get(name, [])
        called = whole[name].heading
        others = [each for each in same[name] if not any(each.startswith(f"{one} ") for one in (name, *same[name]))]
        caption = said("{column} along {stroke}.", column=called, stroke=along)
        caption = said("{column} along {stroke}; {held} held.", column=called, stroke=along, held=held) if held else caption
        caption += said(" The same curve: {names}.", names=", ".join(map(heading_of, others))) if others else ""
        caption += said(" Shaded: what its limit excludes.") if bound is not None else ""
        caption += beyond_words(further, whole[name]) if further else ""
        paint = partial(draw_column, motion=subject.curve, column=whole[name], bound=bound, beyond=further)
        room = (*CURVE_ROOM[:3], CURVE_ROOM[3] if bound is None else 0.48)
        yield Illustration(f"curve_{NO_LETTER.sub('_', name)}", caption, (WIDE, 2.6) if name == first else (HALF, 2.15), room, paint)


def one_curve(names: Sequence[str], columns: Mapping[str, Column], limits: Mapping[str, Sequence[object]]) -> dict[str, list[str]]:
    """Return the columns that are drawn, each with the others that are the same curve; of these the one with a limit, else the first."""
    groups: list[list[str]] = []
    for name in dict.fromkeys(names):
        group = next((each for each in groups if same_curve(columns[each[0]], columns[name])), None)
        if group is None:
            groups.append(group := [])
        group.append(name)
    led = [sorted(group, key=lambda name: name not in limits) for group in groups]
    return {group[0]: group[1:] for group in led}


def same_curve(one: Column, other: Column) -> bool:
    """Return whether two columns measure the same and have the same values."""
    kinds = {UNITS[each.unit][1] if each.unit else "" for each in (one, other)}
    first, second = (np.asarray(each.values, float) for each in (one, other))
    size = float(np.max(np.abs(first[np.isfinite(first)]), initial=0.0))
    return len(kinds) == 1 and size > 0.0 and bool(np.allclose(first, second, rtol=CLOSE, atol=CLOSE * size, equal_nan=True))


CLOSE = 1e-9
"""Of the greatest value: columns that differ by no more are one curve."""


def is_constant(column: Column) -> bool:
    """Return whether a column has one value all along."""
    values = np.asarray(column.values, float)
    finite = values[np.isfinite(values)]
    return bool(finite.size) and float(np.ptp(finite)) <= CLOSE * float(np.max(np.abs(finite)))


def curve_columns(subject: ReportSubject) -> dict[str, Column]:
    """Return the columns of results and of members at the poses of the curves, by name."""
    found = {column.name: column for column in subject.columns}
    for name, column in subject.member_columns:
        found.setdefault(f"{column.name} {name}", replace(column, name=f"{column.name} {name}"))
    return {name: column for name, column in found.items() if name not in subject.machine.strokes}


# Beside each curve, what the judge finds over all that the machine runs: a line where that lies beyond the curve.

BEYOND = 1e-6
"""Of a curve's range: what lies no further beyond it is not marked."""


def wider_answers(subject: ReportSubject, columns: Mapping[str, Column], limits: Mapping[str, Sequence[object]]) -> dict[str, list[Answer]]:
    """Return, by column, the least and the greatest over all that the machine runs, those beyond the curve; of a limit its side.

    They are asked for of what has a limit, of forces and what hangs on them, and of the first column.
    """
    asked: list[tuple[str, Measure]] = []
    for name in columns:
        quantity = subject.quantities.get(name)
        of_forces = isinstance(quantity, Request) and quantity.under(Acting(case=PLAIN_CASE), keep=True) is not quantity
        if quantity is not None and (of_forces or name in limits or name == next(iter(columns))):
            fails = {"below": (least,), "above": (most,)}.get(limit_of(limits[name]).fails, ()) if name in limits else sides_asked(quantity)
            asked += [(name, side(quantity)) for side in fails]
    try:
        with unwarned():
            answers = subject.judge.answers([question for _, question in asked])
    except LinkageError:
        return {}
    found: dict[str, list[Answer]] = {}
    for (name, question), answer in zip(asked, answers, strict=True):
        if lies_beyond(np.asarray(columns[name].values, float), answer, isinstance(question, Least)):
            found.setdefault(name, []).append(answer)
    return found


def lies_beyond(values: FloatArray, answer: Answer, is_least: bool) -> bool:
    """Return whether an answer lies beyond all values of a curve."""
    finite, value = values[np.isfinite(values)], float(answer.value)
    if not finite.size or np.isnan(value):
        return False
    low, high = float(finite.min()), float(finite.max())
    near = BEYOND * max(high - low, abs(high), abs(low))
    return value < low - near if is_least else value > high + near


def beyond_words(answers: Sequence[Answer], column: Column) -> str:
    """Return what the lines beside a curve are."""
    parts = [
        said("{side} {value}, {place}", side=said("least") if isinstance(each.question, Least) else said("greatest"),
             value=f"{amount_text(each, column)} {unit_sign(column.unit)}".strip(), place=each.place)
        for each in answers
    ]  # fmt: skip
    return said(" Over all that the machine runs: {answers}.", answers="; ".join(parts))


def draw_column(ax: Axes, motion: Motion, column: Column, bound: Sequence[object] | None, beyond: Sequence[Answer]) -> None:
    """Draw a column over the stroke with its limit, and lines for what lies beyond it elsewhere."""
    panel(ax, motion, column, bound)
    pad = 9.0 if bound is None else 19.0  # a limit's words stand above the curve, under the heading
    heading = ax.set_title(ax.get_title(loc="left"), loc="left", fontsize=TITLE, fontweight="bold", color=INK, pad=pad)
    heading.set_fontsize(TITLE * min(1.0, HEADING_SHARE * ax.bbox.width / heading.get_window_extent().width))
    for each in beyond:
        value, is_least = float(each.value) / factor(column.shown_unit), isinstance(each.question, Least)
        if np.isfinite(value):
            low, high = ax.get_ylim()
            air = 0.2 * (max(high, value) - min(low, value))  # room for the number
            ax.set_ylim(min(low, value - air), max(high, value + air))
            ax.axhline(value, color=INK, linewidth=1.1, linestyle=(0, (1.5, 1.5)), zorder=4.0)
            note(ax, amount_text(each, column), (1.0, value), (-4, -3 if is_least else 3), INK, ("axes fraction", "data"))


HEADING_SHARE = 0.97
"""Of the width of a curve's axes: what its heading takes at the most, as letters on a screen are wider than printed ones."""


def column_grids(caption: str, columns: Sequence[Column]) -> Iterator[TableBlock]:
    """Yield columns of results as tables as wide as a page; the first column leads each."""
    texts = [text_cells(column, values) for column, values in zip(columns, flat(columns), strict=True)]
    for number, block in enumerate(column_blocks(columns, texts, LETTERS, 2)):
        rows = tuple(zip(*(texts[place] for place in block), strict=True))
        title = caption if not number else said("{caption}, continued", caption=caption)
        yield TableBlock(title, tuple(columns[place].heading for place in block), rows, "r" * len(block))


# -- cylinders and springs ---------------------------------------------------------------------------------


def members_sections(subject: ReportSubject) -> list[Section]:
    """Return the sections of what members show of themselves, such as cylinders their thrust and pressure."""
    members = speakers(subject.machine.plan, Tabled)
    titles = dict.fromkeys(member.section for member in members.values())
    return [members_section(subject, {name: each for name, each in members.items() if each.section == one}) for one in titles]


def members_section(subject: ReportSubject, members: Mapping[str, Tabled]) -> Section:
    """Return the section of what some members show of themselves, which have one title."""
    first = next(iter(members.values()))
    title, caption = translated(first.section), translated(first.caption)
    with unwarned():
        columns = [(name, column) for name, column in subject.member_columns if name in members]
        asked = [column.request if column.request is not None else values_in_rows(subject, name, column) for name, column in columns]
        questions = [[side(quantity) for side in sides_asked(quantity)] for quantity in asked]
        try:
            answers = iter(subject.judge.answers([question for each in questions for question in each]))
        except LinkageError as error:
            return Section(title, (str(error),))
    found = [[next(answers) for _ in each] for each in questions]
    rows = tuple(
        (name, column.heading, *end_cells(each, Least, column), *end_cells(each, Most, column))
        for (name, column), each in zip(columns, found, strict=True)
    )
    shown = dict.fromkeys(name for name, _ in columns)
    refused = [why for name in members if name not in shown and (why := refusal_words(subject, name))]
    heads = (said("member"), said("quantity"), said("least"), said("situation and place"), said("greatest"), said("situation and place"))
    table = [TableBlock(caption, heads, rows, "llrmrm")] if rows else []
    return Section(title, (*table, *refused))


def end_cells(answers: Sequence[Answer], end: type[Measure], column: Column) -> tuple[str, str]:
    """Return the least or the greatest as cells, its value and its place; dashes where it was not asked for."""
    return next(((amount_text(each, column), each.place) for each in answers if isinstance(each.question, end)), ("–", ""))


def sides_asked(quantity: object) -> tuple[Callable[[Any], Measure], ...]:
    """Return what is asked of a quantity: its least and its greatest; of one that is unlimited in places, such as a reserve, the least.

    Of a pressure the greatest: the least is nought, on the side that does not hold.
    """
    is_open = isinstance(quantity, Request) and Trait.MAY_BE_UNLIMITED in quantity.traits
    return (least,) if is_open else (most,) if getattr(quantity, "measures", "") == "pressure" else (least, most)


def values_in_rows(subject: ReportSubject, member: str, column: Column) -> Callable[[Motion], FloatArray]:
    """Return a member's column as a function of a motion, for one that nothing else asks for."""

    def values(motion: Motion) -> FloatArray:
        found = speakers(subject.machine.plan, Tabled)[member].columns(motion)
        return np.asarray(next(each.values for each in found if each.name == column.name), float)

    return values


def refusal_words(subject: ReportSubject, member: str) -> str:
    """Return why a member shows nothing of itself; "" where it has nothing to show."""
    try:
        with unwarned():
            speakers(subject.machine.plan, Tabled)[member].columns(subject.curve)
    except LinkageError as error:
        return str(error)
    return ""


def amount_text(answer: Answer, column: Column) -> str:
    """Return an answer's value in a column's unit and decimals; a dash without one."""
    value = float(answer.value)
    if np.isinf(value):
        return "∞" if value > 0.0 else "−∞"
    (cell,) = text_cells(column, Column(column.name, np.array([value]), column.unit, column.digits).shown)
    return "–" if np.isnan(value) else cell


# -- limits ------------------------------------------------------------------------------------------------


def limits_section(subject: ReportSubject) -> Section:
    """Return the section of how far every stroke reaches, what stops it, and the least transmission angles."""
    title = said("Limits of motion")
    try:
        with unwarned():
            found = subject.machine.at(unreachable="nan", **subject.pose).limits()
    except LinkageError as error:
        return Section(title, (str(error),))
    heads = (said("stroke"), said("limit"), said("at stroke"))
    rows = tuple(row for each in found.values() for row in limit_rows(subject, each))
    table = TableBlock(said("Reach, dead points, transmission"), heads, rows, "lmm")
    held = said("Each stroke by itself, the others held at {pose}.", pose=subject.words(subject.pose))
    return Section(title, (held, table) if len(found) > 1 else (table,))


def limit_rows(subject: ReportSubject, limits: StrokeLimits) -> Iterator[tuple[Cell, ...]]:
    """Yield what limits a stroke."""
    name = limits.stroke

    def place(value: float) -> str:
        return subject.words({name: value})

    for part in limits.intervals:
        yield name, said("reachable"), said("from {start} to {end}", start=place(part.low), end=place(part.high))
    for value, step in limits.dead_points:
        yield name, said("dead point of {step}, the motion ends", step=step), place(value)
    for value, step in limits.change_points:
        yield name, said("change point: the branches of {step} cross", step=step), place(value)
    for value, cylinder in limits.cylinder_dead_points:
        yield name, said("dead point of the cylinder {cylinder}: its length stands still", cylinder=cylinder), place(value)
    for each in limits.transmission:
        angle = said("least transmission angle at {joint}: {angle}", joint=each.joint, angle=show(each.angle, "deg", 4))
        yield name, angle, place(each.stroke)
    if limits.open_turn is not None:
        pins, turns = " ".join(limits.open_turn.pins), limits.open_turn.turns
        text = said(
            "after one turn {pins} do not stand where they began; turns until they do (0: not after six): {turns}", pins=pins, turns=turns
        )
        yield name, text, ""
