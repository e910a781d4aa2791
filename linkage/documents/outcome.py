"""Results over the stroke: tables, curves, cylinders, the forces of the joints, the limits of motion, paths in time."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from ..errors import LinkageError, known_name, unwarned
from ..files.expression import REQUESTS
from ..language import heading_of, noted, said, translated
from ..loads import PLAIN_CASE, Acting, ForceElement
from ..mechanism import Mechanism
from ..motion import (
    Answer,
    Column,
    Measure,
    Motion,
    Request,
    Tabled,
    columns_of,
    judged_poses,
    least,
    most,
    places_text,
    speakers,
    stroke_search,
    transmission,
)
from ..motion.limits import StrokeLimits, angle_text, unstopped_words
from ..motion.measures import Least, Most
from ..motion.requests import is_of_force, may_be_unlimited
from ..pictures import mechanism
from ..pictures.curves import axis_range, panel, small_text
from ..pictures.scene import Scene
from ..pictures.shown_values import as_curve, limit_of
from ..pictures.style import ACCENT, INK, THIN, TITLE
from ..program import FloatArray
from ..reports import Run, dagger_words, friction_of_columns, rate_columns, request_in_case, run_words
from ..reports.values import NO_VALUE, ROUNDING, column_blocks, dagger_ends, flat
from ..reports.values import column_texts as text_cells
from ..units import UNITS, factor, show, unit_sign
from .content import Block, Cell, Illustration, Section, TableBlock
from .pictures import ROOM, WIDE, height_of, in_one_unit
from .run import CURVE, FIGURES, ReportSubject, same_curve

HALF = 3.25
"""The width of a curve [inch]; two stand beside each other."""
CURVE_ROOM = (0.72, 0.22, 0.46, 0.32)
"""The room beside a curve's axes [inch: left, right, bottom, top]."""
NO_LETTER = re.compile("[^0-9A-Za-z]")
"""What the name of a picture's file does not have."""
COUNTED = ("force", "moment", "pressure")
MOST_RESERVE = 100.0
"""Of a greater reserve no table tells more: next to where nothing is carried it is without bounds."""
MOST_TOLD, STILL_CELLS = 20, 6
"""Results that stay the same: as many as a sentence tells, and the cells of a row where a table does."""
LETTERS, TWO_LINES = 118, 7
"""Letters of a table's row, so that it fits across a page, and of a heading that stands in two lines."""


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
    """Draw a mechanism at both ends of its reach, and the paths of points."""
    reached = np.flatnonzero(motion.reached).tolist()
    mechanism(ax, motion, int(reached[0]), faint=True)
    mechanism(ax, motion, int(reached[-1]))
    for name in path:
        ax.plot(*motion[name], color=ACCENT, linewidth=1.6 * THIN, linestyle=(0, (5, 2)), zorder=9.0)
    in_one_unit(ax)


# -- tables and curves -------------------------------------------------------------------------------------


def coordinates_of(machine: Mechanism) -> set[str]:
    """Return the names of the columns of points' coordinates."""
    return {f"{point}_{axis}" for point in machine.plan.points for axis in "xy"}


def results_blocks(
    subject: ReportSubject, names: Sequence[str] | None, first: str, limits: Mapping[str, Sequence[object]]
) -> Iterator[Block]:
    """Yield the tables over the runs and the curves, the one the machine is about first; of several runs the curves that it is about.

    A table has the columns named, else all: coordinates last, no force beside a thrust that it is, those that are the same at all
    poses as a sentence. DefinitionError for an unknown name.
    """
    places, told = coordinates_of(subject.machine), dict[str, str]()
    for (run, motion), found in zip(subject.tables, subject.table_columns, strict=True):
        held, words = subject.words(dict(run.held)), run_words(subject.machine, run)
        text = said("Along {stroke}, with {held} held.", stroke=", ".join(run.ways), held=held) if held and run.is_curve else ""
        text = text if run.is_curve else said("Poses, with nothing between them.")
        if text:
            yield f"{words[:1].upper()}{words[1:]}: {text[:1].lower()}{text[1:]}" if words else text
        if run.worst:
            yield said("Held where {column} is at its worst: {strokes}.", strokes=", ".join(run.held), column=heading_of(run.worst))
        missing = int(np.count_nonzero(~motion.reached))
        if missing:
            yield said("{n} of {count} poses of the table cannot be assembled; they have no values.", n=missing, count=motion.reached.size)
        known = {column.name: column for column in found}
        for name in names or ():
            known_name("Column", name, known, where=f"the table of {subject.machine.plan.title}")
        listed = sorted((column for column in found if column.name not in subject.doubles), key=lambda column: column.name in places)
        if names is not None:
            strokes = [name for name in subject.machine.strokes if name in known]
            listed = [known[name] for name in dict.fromkeys([*strokes, *names])]
        bare = [] if names else [column.name for column in listed if np.isnan(np.asarray(column.shown, float)).all()]
        shown = [column for column in listed if column.name not in {*run.held, *bare}]
        caption = said("Results {run}", run=words) if words else said("Results over the stroke")
        outside = np.ravel(motion.reached & ~judged_poses(subject.judge, motion, run.case or PLAIN_CASE)).tolist()
        moving = [column for column in shown if np.size(column.values) > 1 and column.name not in run.ways]
        texts = {} if names or subject.has_own_table else {column: still_text(subject, column) for column in moving}
        yield from column_grids(subject, caption, [column for column in shown if not texts.get(column)], outside)
        still = {heading_of(each.name): f"{text} {unit_sign(each.unit)}".strip() for each, text in texts.items() if text}
        yield from still_blocks(still, told)
        told = still
        if bare:
            yield said("Without a value at all these poses: {values}.", values=", ".join(map(heading_of, bare)))
        yield from filter(None, [dagger_words() if any(outside) else "", friction_of_columns(motion, shown)])
    if names is None and subject.doubles:
        pairs = (said("{drive} is {thrust}", drive=heading_of(one), thrust=heading_of(other)) for one, other in subject.doubles.items())
        text = "; ".join(pairs)
        yield f"{text[:1].upper()}{text[1:]}."
    for run, motion in subject.curves:
        yield from curve_blocks(subject, run, motion, names if len(subject.curves) == 1 else [first, *limits], first, limits)


def still_blocks(still: Mapping[str, str], before: Mapping[str, str]) -> Iterator[Block]:
    """Yield what stays the same over a run: a few results as a sentence, many as a table, without those that are as in the run before."""
    cells = [cell for name, text in still.items() if before.get(name) != text for cell in (name, text)]
    if 0 < len(still) <= MOST_TOLD:
        yield said("The same at all these poses: {values}.", values=", ".join(f"{name} {text}" for name, text in still.items()))
    elif cells:
        cells += [""] * (-len(cells) % STILL_CELLS)
        rows = tuple(tuple(cells[at : at + STILL_CELLS]) for at in range(0, len(cells), STILL_CELLS))
        title = said("The same at all these poses; what is as in the run before is not listed again")
        heads = (said("quantity"), said("value")) * (STILL_CELLS // 2)
        yield TableBlock(title if before else said("The same at all these poses"), heads, rows, "lr" * (STILL_CELLS // 2))


def curve_blocks(
    subject: ReportSubject, run: Run, motion: Motion, names: Sequence[str] | None, first: str, limits: Mapping[str, Sequence[object]]
) -> Iterator[Block]:
    """Yield the curves along a run, the one the machine is about first."""
    along, held, words = ", ".join(run.ways), subject.words(dict(run.held)), run_words(subject.machine, run)
    whole = {name: column for name, column in subject.columns_along(run, motion).items() if np.isfinite(column.values).any()}
    left = coordinates_of(subject.machine) | {*subject.doubles} if names is None else {*whole} - {*names}
    drawn = [name for name in whole if name != first and name not in left]
    drawn = [first, *drawn] if first in whole else drawn
    if not drawn:
        return
    first, same = drawn[0], one_curve(drawn, whole, limits)
    first = next(name for name in same if first in (name, *same[name]))
    still = [name for name in same if name not in (first, *limits) and still_text(subject, whole[name])]
    if still and (names is not None or subject.has_own_table):
        yield said("The same all along this run, and not drawn: {names}.", names=", ".join(map(heading_of, still)))
    drawn = [first, *(name for name in same if name not in (first, *still))]
    beyond = wider_answers(subject, {name: whole[name] for name in drawn}, limits)
    for name in drawn:
        column, bound = as_curve(whole[name], limits.get(name))
        called, further = column.heading, beyond.get(name, []) if column is whole[name] else []
        others = [each for each in same[name] if not any(each.startswith(f"{one} ") for one in (name, *same[name]))]
        if motion.time is not None:
            caption = said("{column} over time{beside}.", column=called, beside=held and f"; {said('held: {held}', held=held)}")
        elif held:
            caption = said("{column} along {stroke}; {held} held.", column=called, stroke=along, held=held)
        else:
            caption = said("{column} along {stroke}.", column=called, stroke=along)
        caption = f"{caption.removesuffix('.')}, {words}." if words else caption
        caption += said(" The same curve: {names}.", names=", ".join(map(heading_of, others))) if others else ""
        caption += said(" Shaded: what its limit excludes.") if bound is not None else ""
        marks = [(each, amount_text(subject, each, column)) for each in further]
        parts = [
            said("{side} {value}, {place}", side=said("least") if isinstance(each.question, Least) else said("greatest"),
                 value=f"{amount} {unit_sign(column.unit)}".strip(), place=each.place)
            for each, amount in marks
        ]  # fmt: skip
        caption += said(" Over all that the machine runs: {answers}.", answers="; ".join(parts)) if parts else ""
        paint = partial(draw_column, motion=motion, column=column, bound=bound, beyond=marks)
        room = (*CURVE_ROOM[:3], CURVE_ROOM[3] if bound is None else 0.48)
        called = "_".join(NO_LETTER.sub("_", each) for each in (name, run.title if len(subject.curves) > 1 else "") if each)
        is_wide = name == first and len(subject.curves) == 1
        yield Illustration(f"curve_{called}", caption, (WIDE, 2.6) if is_wide else (HALF, 2.15), room, paint)


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


def still_text(subject: ReportSubject, column: Column) -> str:
    """Return a column's value as it is shown, if it is the same all along; else ""."""
    values = np.asarray(column.shown, float).ravel()
    texts = {*cell_texts(subject, column, values[~np.isnan(values)])}
    return texts.pop() if len(texts) == 1 else ""


# Beside each curve, what the judge finds over all that the machine runs: a line where that lies beyond the curve.

BEYOND = 1e-6
"""Of a curve's range: what lies no further beyond it is not marked."""


def wider_answers(subject: ReportSubject, columns: Mapping[str, Column], limits: Mapping[str, Sequence[object]]) -> dict[str, list[Answer]]:
    """Return, by column, the least and the greatest over all that the machine runs, those beyond the curve; of a limit its side.

    They are asked for of what has a limit, of forces and what hangs on them, and of the first column.
    """
    asked: list[tuple[str, Measure]] = []
    quantities = subject.quantities(columns)
    for name in columns:
        quantity = quantities.get(name)
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
        values, value = np.asarray(columns[name].values, float), float(answer.value)
        finite = values[np.isfinite(values)]
        if finite.size and not np.isnan(value):
            low, high = float(finite.min()), float(finite.max())
            near = BEYOND * max(high - low, abs(high), abs(low))
            if value < low - near if isinstance(question, Least) else value > high + near:
                found.setdefault(name, []).append(answer)
    return found


def draw_column(ax: Axes, motion: Motion, column: Column, bound: Sequence[object] | None, beyond: Sequence[tuple[Answer, str]]) -> None:
    """Draw a column over the stroke with its limit, and lines with their values for extremes beyond it elsewhere."""
    panel(ax, motion, column, bound)
    pad = 9.0 if bound is None else 19.0  # a limit's words stand above the curve, under the heading
    heading = ax.set_title(ax.get_title(loc="left"), loc="left", fontsize=TITLE, fontweight="bold", color=INK, pad=pad)
    marks = [(float(each.value) / factor(column.shown_unit), isinstance(each.question, Least), text) for each, text in beyond]
    marks = [mark for mark in marks if np.isfinite(mark[0])]
    low, high = (end([*ax.get_ylim(), *(value for value, *_ in marks)]) for end in (min, max))
    air = 0.2 * (high - low)  # room for a number
    ax.set_ylim(min([low, *(value - air for value, *_ in marks)]), max([high, *(value + air for value, *_ in marks)]))
    for value, is_least, text in marks:
        ax.axhline(value, color=INK, linewidth=1.1, linestyle=(0, (1.5, 1.5)), zorder=4.0)
        small_text(ax, text, (1.0, value), (-4, -3 if is_least else 3), INK, ("axes fraction", "data"))
    for words in (heading, *ax.texts):
        words.set_fontsize(float(words.get_fontsize()) * min(1.0, WIDEST * ax.bbox.width / words.get_window_extent().width))


WIDEST = 0.97
"""Of the width of a curve's axes: what a line of words takes at the most, as letters on a screen are wider than printed ones."""


def column_grids(subject: ReportSubject, caption: str, columns: Sequence[Column], outside: Sequence[bool]) -> Iterator[TableBlock]:
    """Yield columns of results as tables as wide as a page. Rows outside the judged places end with a dagger.

    The first column leads. Where it stands still between rows, a number does.
    """
    ends = dagger_ends(outside)
    if len({*columns[0].shown.ravel().tolist()}) < len(ends):
        columns = [Column(said("No."), np.arange(1.0, len(ends) + 1.0), "", 0), *columns]
    texts = [cell_texts(subject, column, values) for column, values in zip(columns, flat(columns), strict=True)]
    blocks = [*column_blocks([in_two_lines(column.heading) for column in columns], texts, LETTERS)]
    if len(blocks) > 1 and len(blocks[-1]) == 2 < len(blocks[-2]) - 1:  # no table of one column
        blocks[-1].insert(1, blocks[-2].pop())
    for number, block in enumerate(blocks):
        last = [f"{text}{end}" for text, end in zip(texts[block[-1]], ends, strict=True)]
        rows = tuple(zip(*(texts[place] for place in block[:-1]), last, strict=True))
        title = caption if not number else said("{caption}, continued", caption=caption)
        yield TableBlock(title, tuple(columns[place].heading for place in block), rows, "r" * len(block))


def in_two_lines(heading: str) -> int:
    """Return how many letters a heading is wide in a report: a long one stands in two lines."""
    words = heading.split(" ")
    cuts = [max(len(" ".join(words[:at])), len(" ".join(words[at:]))) for at in range(1, len(words))]
    return min(cuts, default=len(heading)) if len(heading) >= TWO_LINES else len(heading)


def cell_texts(subject: ReportSubject, column: Column, values: FloatArray) -> list[str]:
    """Return a column's numbers as text: forces, moments, pressures and reserves with FIGURES digits.

    Others, and those of the machine's own table, have the column's decimals.
    """
    own = subject.has_own_table and any(each.name == column.name for each in subject.columns)
    if own or not (column.name.startswith("reserve") if not column.unit else UNITS[column.unit][1] in COUNTED):
        return text_cells(column, values)
    most = MOST_RESERVE if not column.unit else np.inf
    return [NO_VALUE if np.isnan(value) else f"> {most:.0f}" if value > most else figures(value) for value in values.tolist()]


def figures(value: float) -> str:
    """Return a number with FIGURES digits, whole from there on; "0" for one so small that it is rounding."""
    text = f"{value:z#.{FIGURES}g}" if abs(value) > ROUNDING else "0"
    return f"{value:z.0f}" if "e+" in text else text.removesuffix(".")


# -- cylinders and springs ---------------------------------------------------------------------------------


def members_sections(subject: ReportSubject) -> list[Section]:
    """Return the sections of the members' own results, such as the thrust and pressure of cylinders."""
    members = speakers(subject.machine.plan, Tabled)
    titles = dict.fromkeys(member.section for member in members.values())
    return [members_section(subject, {name: each for name, each in members.items() if each.section == one}) for one in titles]


def members_section(subject: ReportSubject, members: Mapping[str, Tabled]) -> Section:
    """Return the section of some members' own results, which have one title."""
    first = next(iter(members.values()))
    title, caption = translated(first.section), translated(first.caption)
    with unwarned():
        columns = [(name, column) for name, column in subject.member_columns if name in members]
        questions = [column_questions(subject, name, column) for name, column in columns]
        try:
            answers = iter(subject.judge.answers([question for each in questions for question in each]))
        except LinkageError as error:
            return Section(title, (str(error),))
    found = [[next(answers) for _ in each] for each in questions]
    pairs = zip(columns, found, strict=True)
    ends = [[*end_cells(subject, each, Least, column), *end_cells(subject, each, Most, column)] for (_, column), each in pairs]
    rows = tuple((name, column.heading, *each) for (name, column), each in zip(columns, ends, strict=True) if {*each} - {"–", ""})
    shown = dict.fromkeys(name for name, _ in columns)
    refused = []
    for name in members:
        if name not in shown:
            try:
                with unwarned():
                    members[name].columns(subject.curve)
            except LinkageError as error:
                refused.append(str(error))
    heads = (said("component"), said("quantity"), said("least"), said("situation and place"), said("greatest"), said("situation and place"))
    table = [TableBlock(caption, heads, rows, "llrmrm")] if rows else []
    return Section(title, (*table, *refused))


def end_cells(subject: ReportSubject, answers: Sequence[Answer], end: type[Measure], column: Column) -> tuple[str, str]:
    """Return the least or the greatest as cells, its value and its place; dashes where it was not asked for."""
    return next(((amount_text(subject, each, column), each.place) for each in answers if isinstance(each.question, end)), ("–", ""))


def sides_asked(quantity: object) -> tuple[Callable[[Any], Measure], ...]:
    """Return the measures of a quantity: its least and its greatest; of one that is unlimited in places, such as a reserve, the least.

    Of a pressure the greatest: the least is nought, on the side that does not hold.
    """
    return (least,) if may_be_unlimited(quantity) else (most,) if getattr(quantity, "measures", "") == "pressure" else (least, most)


def column_questions(subject: ReportSubject, member: str, column: Column) -> list[Measure]:
    """Return the questions of a column of a member; one that nothing asks for is a function of a motion."""

    def values(motion: Motion) -> FloatArray:
        found = speakers(subject.machine.plan, Tabled)[member].columns(motion)
        return np.asarray(next(each.values for each in found if each.name == column.name), float)

    quantity = column.request if column.request is not None else values
    return [side(quantity) for side in sides_asked(quantity)]


def amount_text(subject: ReportSubject, answer: Answer, column: Column) -> str:
    """Return an answer's value in a column's unit, as its cells have it; a dash without one."""
    value = float(answer.value)
    if np.isinf(value):
        return "∞" if value > 0.0 else "−∞"
    (cell,) = cell_texts(subject, column, Column(column.name, np.array([value]), column.unit, column.digits).shown)
    return "–" if np.isnan(value) else cell


# -- limits ------------------------------------------------------------------------------------------------


def limits_section(subject: ReportSubject) -> Section:
    """Return the section of how far every stroke reaches, its limits, and the least transmission angles.

    It looks where the verdicts do. The other strokes are held where the first `Over` begins.
    """
    title, strokes = said("Limits of motion"), subject.machine.strokes
    reached = [place for place in subject.judge.places if place.motion.reached.any()] or subject.judge.places[:1]
    places = {name: next((each for each in reached if name in each.running), reached[0]) for name in strokes}
    try:
        with unwarned():
            limits = [stroke_search.limits(place.motion, [name])[name] for name, place in places.items()]
    except LinkageError as error:
        return Section(title, (str(error),))
    joints = dict.fromkeys(least.joint for each in limits for least in each.transmission)
    with unwarned():
        angles = subject.judge.answers([least(transmission(joint)) for joint in joints])
    rows = tuple(
        (*row, places_text({name: value for name, value, _ in each.held}, {name: unit for name, _, unit in each.held}))
        for each in limits for row in limit_rows(each)
    )  # fmt: skip
    for joint, answer in zip(joints, angles, strict=True):
        if np.isfinite(answer.value):
            angle = said("least transmission angle at {joint}: {angle}", joint=joint, angle=angle_text(float(answer.value), 4))
            rows += ((", ".join(answer.strokes), angle, places_text(answer.strokes, answer.units), ""),)
    heads = (said("stroke"), said("limit"), said("at stroke"), said("the others held at"))
    wide = 4 if len(strokes) > 1 else 3
    table = TableBlock(said("Reach, dead points, transmission"), heads[:wide], tuple(row[:wide] for row in rows), "lmmm"[:wide])
    return Section(title, (table,))


def limit_rows(limits: StrokeLimits) -> Iterator[tuple[Cell, ...]]:
    """Yield the limits of a stroke."""
    name = limits.stroke

    def place(value: float) -> str:
        return places_text({name: value}, {name: limits.unit})

    for part in limits.intervals:
        ends = (part.low, part.low_stop), (part.high, part.high_stop)
        start, end = (place(value) + unstopped_words(limits.unit, part, stop) for value, stop in ends)
        yield name, said("reachable"), said("from {start} to {end}", start=start, end=end)
    for value, step in limits.dead_points:
        yield name, said("dead point of {step}, the motion ends", step=step), place(value)
    for value, step in limits.change_points:
        yield name, said("change point: the branches of {step} cross", step=step), place(value)
    for value, cylinder in limits.cylinder_dead_points:
        yield name, said("dead point of the cylinder {cylinder}: its length stands still", cylinder=cylinder), place(value)
    if limits.open_turn is not None:
        pins, turns = " ".join(limits.open_turn.pins), limits.open_turn.turns
        text = said(
            "after one turn {pins} do not stand where they began; turns until they do (0: not after six): {turns}", pins=pins, turns=turns
        )
        yield name, text, ""


PACES = {noted("rate"): 1, noted("power"): 3, noted("flow"): 2}
"""What members say of a machine that runs, by the words of requests, and the decimals with which it is shown."""
FORCES = ("force", "moment")
SEEN = 0.005
"""Of a force: curves with and without inertia that differ by less everywhere are one."""


def in_time_section(subject: ReportSubject) -> Section | None:
    """Return the section of how the machine runs; None where no run is a path in time."""
    blocks: list[Block] = []
    for run, motion in subject.tables:
        if motion.time is None:
            continue
        words, along = run_words(subject.machine, run), subject.along(run, CURVE)
        beside = f", {words}" if words else ""
        strokes = [column for column in columns_of(motion) if column.name in ("time", *motion.strokes)]
        outside = [False] * motion.reached.size
        shown = [*strokes, *(column for column in rate_columns(motion) if np.any(column.values))]
        blocks += column_grids(subject, said("Strokes, their rates and accelerations") + beside, shown, outside)
        blocks += inertia_blocks(subject, run, along, beside)
        paces = pace_columns(subject, motion, run)
        if paces:
            blocks += column_grids(subject, said("Rates, power and flow") + beside, [strokes[0], *paces], outside)
            blocks += (curve_picture(run, along, column, beside) for column in pace_columns(subject, along, run))
    return Section(said("As it runs"), tuple(blocks)) if blocks else None


def pace_columns(subject: ReportSubject, motion: Motion, run: Run) -> list[Column]:
    """Return the speeds of moving cylinders, their power and the oil of lines, over a motion in time."""
    found = list[Column]()
    words = {word: digits for word, digits in PACES.items() if word in REQUESTS}
    for name in subject.machine.plan.of_kind(ForceElement):
        for word, digits in words.items():
            try:
                with unwarned():
                    asked = request_in_case(REQUESTS[word](name), run.case)
                    column = Column.of(motion, asked, name=f"{word} {name}", digits=digits)
            except LinkageError:  # it has no such thing
                continue
            found += [column] if np.any(column.drawn) else []
    return found


def inertia_blocks(subject: ReportSubject, run: Run, along: Motion, beside: str) -> Iterator[Block]:
    """Yield the greatest forces with and without inertia, and their curves; why there is none where a rate jumps."""
    forces = {
        column.name: (request_in_case(column.request, run.case), column.unit) for column in subject.columns
        if is_of_force(column.request) and column.name not in subject.doubles and isinstance(column.request, Request)
        and still_text(subject, column) != "0"
        and column.request.measured(subject.machine.plan) in FORCES
    }  # fmt: skip
    if not forces or run.declared is None:
        return
    if along._rate_jump is not None:
        yield said("No inertia is counted{beside}: {jump}.", beside=beside, jump=along._rate_jump[1])
        return
    yield said(
        "Masses have their inertia{beside}. Where the centre of a mass m has the acceleration a, the force −m a acts beside "
        "its weight. A body with the angular acceleration α takes the couple −J α with its moment of inertia J. The "
        "numbered equations are without these terms.",
        beside=beside,
    )
    judge = subject.machine.judge([run.declared], Acting(case=run.case)).lost_allowed()
    slow = {name: request.under(Acting(inertia=False), keep=True) for name, (request, _) in forces.items()}
    rows = list[tuple[str, ...]]()
    with unwarned():
        answers = judge.answers([side(request) for request, _ in forces.values() for side in (most, least)])
        for k, (name, (request, unit)) in enumerate(forces.items()):
            worst = max(answers[2 * k : 2 * k + 2], key=lambda each: abs(np.nan_to_num(float(each.value))))
            if not np.isfinite(float(worst.value)):
                continue
            there = request.under(Acting(case=judge.situation(worst).case, inertia=False), keep=True)
            without = float(np.ravel(judge.there(worst)[there])[0])
            factor = f"{float(worst.value) / without:.3g}" if without else ""
            values = (show(float(worst.value), unit, FIGURES), worst.place, show(without, unit, FIGURES), factor)
            rows.append((heading_of(name), *values))
        heads = said("force"), said("greatest"), said("where"), said("without inertia there"), said("dynamic factor")
        title = said("Greatest forces with inertia")  # of all load cases that occur, unless one is asked for
        titled = title + beside if run.case is not None else f"{title}, {said('over {over}', over=run.title)}" if run.title else title
        yield TableBlock(titled, heads, tuple(rows), "lrmrr")
        for name, (request, unit) in forces.items():
            column = Column(name, along[request], unit)
            other = Column(name, along[slow[name]], unit)
            if not np.allclose(column.drawn, other.drawn, rtol=SEEN, atol=0.0, equal_nan=True):
                yield curve_picture(run, along, column, beside, other)


def curve_picture(run: Run, along: Motion, column: Column, beside: str, slow: Column | None = None) -> Illustration:
    """Return a column over time as a picture; dashed without inertia."""
    caption = said("{column} over time{beside}.", column=column.heading, beside=beside)
    caption += said(" Dashed: without inertia.") if slow is not None else ""
    name = "_".join(NO_LETTER.sub("_", each) for each in ("as_it_runs", column.name, run.title) if each)
    return Illustration(name, caption, (HALF, 2.15), CURVE_ROOM, partial(two_curves, motion=along, column=column, slow=slow))


def two_curves(ax: Axes, motion: Motion, column: Column, slow: Column | None) -> None:
    """Draw a column over time, and dashed without inertia."""
    draw_column(ax, motion, column, None, [])
    if slow is not None and motion.time is not None:
        ax.plot(motion.time, slow.drawn, color=ACCENT, linewidth=1.2, linestyle=(0, (4, 2)), zorder=4.5)
        ends = [axis_range(each) for each in (column, slow)]
        ax.set_ylim(min(low for low, _ in ends), max(high for _, high in ends))
