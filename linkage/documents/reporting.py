"""The report of a calculation: inputs, drawings, equations with numbers, results, forces, limits, checks and verdicts."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from ..disk import check_place
from ..errors import DefinitionError, LinkageError, cited, unknown, unwarned
from ..language import current_language, said, translated
from ..language import language as spoken
from ..mechanism import Mechanism
from ..motion import stroke_display_unit
from ..pictures.curves import limit_of
from ..pictures.poses import named_points
from ..pictures.strokes import column_shown
from ..reports import NOTHING, At
from ..units import current_system, show, shown_number, unit_system
from ..verdict import Verdict
from .calculation import calculated, calculation_section, has_loads
from .checks import checks_section, kept_mark
from .content import Cell, Document, Mark, Paragraph, Section, TableBlock
from .fingerprint import DIGITS, fingerprint, own_version
from .html import write_html
from .inputs import definition_section, inputs_section
from .markdown import write_markdown
from .outcome import curve_columns, drawing_section, forces_section, limits_section, members_section, results_section
from .pdf import write_pdf
from .run import Looked

WRITERS: Mapping[str, Callable[[Document, Path], None]] = {".html": write_html, ".pdf": write_pdf, ".md": write_markdown}
POSES = {1: 101, 2: 21}
MANY_STROKES = 7


def report(machine: Mechanism, path: str | Path, *, language: str | None = None, units: str | None = None, **given: Any) -> Path:
    """Return the path of the report it wrote, .html, .pdf or .md; `given` are the other arguments of `linkage.report`."""
    place = Path(path)
    if place.suffix.lower() not in WRITERS:
        raise DefinitionError(f"{cited(str(path))}: a report's name ends in one of {', '.join(WRITERS)}, which chooses the format.")
    check_place(place)
    document = report_document(machine, language=language, units=units, **given)
    with speaking(language, units):
        WRITERS[place.suffix.lower()](document, place)
    return place


def report_document(
    machine: Mechanism,
    *,
    language: str | None = None,
    units: str | None = None,
    case: Any = None,
    at: At = NOTHING,
    count: int = 11,
    columns: Sequence[str] | None = None,
    trace: Sequence[str] | None = None,
    limits: Mapping[str, Sequence[Any]] | None = None,
    title_block: Mapping[str, str] = NOTHING,
    start: int = 1,
) -> Document:
    """Return what a report says, before it is written as a file."""
    looked = Looked.at(machine, at, count, case)
    if not isinstance(title_block, Mapping) or not all(isinstance(each, str) for pair in title_block.items() for each in pair):
        raise DefinitionError(f'title_block={cited(title_block)}: rows of text are expected, title_block={{"Checked by": "N. N."}}.')
    with speaking(language, units):
        return composed(looked, columns, trace, limits, title_block, start)


@contextmanager
def speaking(name: str | None, units: str | None) -> Iterator[None]:
    """Speak a language and show a system of units; those that hold already where none is named."""
    with spoken(name or current_language()), unit_system(units or current_system() or None):
        yield


def composed(
    looked: Looked,
    columns: Sequence[str] | None,
    trace: Sequence[str] | None,
    limits: Mapping[str, Sequence[Any]] | None,
    title_block: Mapping[str, str],
    start: int,
) -> Document:
    """Return the document, in the language and the units that hold."""
    machine, featured = looked.machine, looked.machine.featured()
    with unwarned():
        first = column_shown(machine, looked.curve, None).name
    names = list(curve_columns(looked))
    own = {name: given for name, given in featured.limits.items() if name in names}
    bounds = checked_limits(own if limits is None else limits, names, machine.plan.title)
    path = named_points(machine, trace, "trace") if trace is not None else tuple(featured.path) or machine.plan.moving[-1:]
    found = calculated(machine, looked.pose, start)
    verdicts, mark = verdict_section(machine)
    sections = (
        inputs_section(machine, found.listing, looked.run.held),
        drawing_section(looked, path),
        calculation_section(found, looked.words(looked.pose)),
        results_section(looked, columns, first, bounds),
        members_section(looked),
        forces_section(looked),
        limits_section(looked),
        checks_section(looked, found.listing),
        verdicts,
        definition_section(machine),
    )
    whole = tuple(each for each in sections if each is not None)
    words = inspect.cleandoc(type(machine).__doc__ or "").partition("\n")[0]
    return Document(machine.plan.heading, words, facts(looked, title_block, mark), mark, whole, current_language())


def facts(looked: Looked, title_block: Mapping[str, str], mark: Mark) -> tuple[tuple[str, str], ...]:
    """Return the rows of the title block: what was calculated, of what inputs, by which version; nothing that another run would change."""
    machine, run, cls = looked.machine, looked.run, type(looked.machine)
    seen = {**run.ways, **{name: (value,) for name, value in run.held.items()}}
    moves = said("{stroke}, {poses} poses in tables", stroke=span_words(looked), poses=looked.count)
    held = looked.words(dict(run.held))
    return (
        (said("Machine"), f"{machine.plan.heading} ({cls.__module__}:{cls.__qualname__})"),
        (said("Run"), f"{moves}; {said('held: {held}', held=held)}" if held else moves),
        (said("Load cases"), ", ".join(map(looked.case_words, looked.cases)) if has_loads(machine) else said("no loads")),
        (said("Verdicts"), mark.word),
        *title_block.items(),
        (said("Inputs, SHA-256"), fingerprint(machine, seen)[:DIGITS]),
        (said("Calculated with"), f"hydrolinkage {own_version()}".strip()),
    )


def span_words(looked: Looked) -> str:
    """Return the run of the strokes that move as text: `S = 0 to 250 mm`."""
    words = []
    for name, way in looked.run.ways.items():
        unit = stroke_display_unit(looked.machine.plan, name, "mm")
        low = ", ".join(shown_number(value, unit) for value in way[:-1])
        words.append(said("{name} = {low} to {high}", name=name, low=low, high=show(way[-1], unit)))
    return ", ".join(words)


def checked_limits(limits: Mapping[str, Sequence[Any]], columns: Sequence[str], title: str) -> Mapping[str, Sequence[Any]]:
    """Return limits by column; DefinitionError for one of no column, or that is none."""
    for name, given in limits.items():
        if name not in columns:
            raise unknown("Column", name, columns, where=f"limits of {title}")
        limit_of(given)
    return limits


# What the machine itself judges.


def verdict_section(machine: Mechanism) -> tuple[Section, Mark]:
    """Return the section of a machine's own verdicts over its whole strokes, and how many are kept."""
    title = said("Verdicts")
    poses = POSES.get(len(machine.strokes), MANY_STROKES)
    axes = [np.linspace(stroke.start, stroke.end, poses) for stroke in machine.strokes.values()]
    grid: dict[str, Any] = dict(zip(machine.strokes, np.meshgrid(*axes, indexing="ij"), strict=True))
    try:
        with unwarned():
            found = machine.verdicts(machine.at(**grid))
    except LinkageError as error:
        why = Paragraph(said("The machine cannot be judged over its whole strokes: {why}", why=str(error)))
        return Section(title, (why,)), Mark(False, said("not judged"))
    if not found:
        return Section(title, (Paragraph(said("This machine declares no rules of its own.")),)), Mark(None, said("no rules declared"))
    rows = tuple(verdict_row(each) for each in found)
    judged = [each for each in found if isinstance(each, Verdict)]
    count = sum(each.ok is True for each in judged)
    grid_of = TableBlock(said("Rules, over the whole strokes"), (said("rule"), said("result"), said("what was found")), rows, "llm")
    word = said("{kept} of {all} rules kept", kept=count, all=len(judged)) if judged else said("no rules declared")
    return Section(title, (grid_of,)), Mark(count == len(judged) if judged else None, word)


def verdict_row(verdict: str) -> tuple[Cell, ...]:
    """Return a verdict as cells: its rule, whether it is kept, its sentence; of a plain sentence only that."""
    if isinstance(verdict, Verdict):
        return translated(verdict.rule), kept_mark(verdict.ok), verdict.sentence
    return "", Mark(None, "–"), verdict
