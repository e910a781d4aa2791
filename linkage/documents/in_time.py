"""How a machine runs over its paths in time: strokes, rates and accelerations, forces with and without inertia, power and flow."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np
from matplotlib.axes import Axes

from ..errors import LinkageError, unwarned
from ..files.criterion import REQUESTS
from ..language import heading_of, noted, said
from ..loads import Acting, ForceElement
from ..motion import Column, Motion, Request, columns_of, least, most
from ..motion.requests import is_of_force
from ..pictures.curves import axis_range
from ..pictures.style import ACCENT
from ..reports import Run, rate_columns, request_in_case, run_words
from ..units import show
from .content import Block, Illustration, Section, TableBlock
from .outcome import CURVE_ROOM, HALF, NO_LETTER, column_grids, draw_column, still_text
from .run import CURVE, FIGURES, ReportSubject

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
        for k, (name, (_, unit)) in enumerate(forces.items()):
            worst = max(answers[2 * k : 2 * k + 2], key=lambda each: abs(np.nan_to_num(float(each.value))))
            if not np.isfinite(float(worst.value)):
                continue
            without = float(np.ravel(judge.there(worst)[slow[name]])[0])
            factor = f"{float(worst.value) / without:.3g}" if without else ""
            values = (show(float(worst.value), unit, FIGURES), worst.place, show(without, unit, FIGURES), factor)
            rows.append((heading_of(name), *values))
        heads = said("force"), said("greatest"), said("where"), said("without inertia there"), said("dynamic factor")
        yield TableBlock(said("Greatest forces with inertia") + beside, heads, tuple(rows), "lrmrr")
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
