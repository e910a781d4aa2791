"""The report of a calculation: inputs, drawings, equations with numbers, results, forces, limits, checks and verdicts."""

from __future__ import annotations

import hashlib
import inspect
import json
import os
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import replace
from datetime import UTC, datetime
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from ..disk import OF_FILE, check_name, check_place
from ..errors import DefinitionError, LinkageError, cited, known_name, require, require_type, unwarned
from ..language import ENGLISH, current_language, language, said, translated, with_decimals
from ..language import language as spoken
from ..loads import Acting, situation_of
from ..mechanism import Mechanism, played_along
from ..motion import HasVerdicts, Motion, speakers, stroke_display_unit, way_text
from ..motion.measures import least, most
from ..motion.motion_verdicts import domain_words, verdict_questions
from ..pictures.shown_values import limit_of, named_points, typeset
from ..plan import written_out
from ..quantities import Dimension
from ..reports import NOTHING, At, column_among
from ..units import current_system, unit_system
from .calculation import calculated, calculation_blocks, has_loads
from .checks import checks_section
from .content import Block, Cell, Document, Illustration, Mark, Section, TableBlock, TitleBlock
from .forces import drives_asked, forces_section
from .html import write_html
from .inputs import assumptions_section, definition_section, inputs_section, own_paragraphs, plain_words, standards_section
from .markdown import write_markdown
from .outcome import column_questions, in_time_section, limits_section, members_sections, results_blocks, sketch_section
from .pdf import check_typst, write_pdf
from .run import ReportSubject
from .worst_places import verdict_section

ADDRESS = re.compile(r" at 0x[0-9a-fA-F]+")


def fingerprint(machine: Mechanism, strokes: Mapping[str, Any]) -> str:
    """Return the SHA-256 of a design's inputs in hexadecimal: members, dimensions, loads, load cases, and the strokes looked at.

    It is the same in every process and language; a function among the members counts by its source.
    """
    with language(ENGLISH):
        members = written_out(machine.plan, machine.dimensions)
    functions: dict[str, list[str]] = {}
    for name, member in machine.plan.members.items():
        for _, value in sorted(vars(member).items()):
            if inspect.isfunction(value):
                try:
                    source = inspect.getsource(value)
                except (OSError, TypeError):  # it has none
                    source = value.__qualname__
                functions.setdefault(name, []).append(source)
    inputs = {
        "machine": machine.plan.title,
        "members": {name: ADDRESS.sub("", text) for name, text in members.items()},
        "functions": functions,
        "dimensions": {name: repr(float(value)) for name, value in machine.dimensions.items()},
        "strokes": {name: [repr(float(each)) for each in values] for name, values in strokes.items()},
    }
    return hashlib.sha256(json.dumps(inputs, sort_keys=True, ensure_ascii=True).encode()).hexdigest()


def own_version() -> str:
    """Return the version of this package; "" where it runs from a folder without being installed."""
    try:
        return version("hydrolinkage")
    except PackageNotFoundError:
        return ""


LIMITS = 'limits by the names of columns are expected, limits={"tilt": (0.1, "most")}'
WRITERS: Mapping[str, Callable[[Document, Path], None]] = {".html": write_html, ".pdf": write_pdf, ".md": write_markdown}


def report(
    machine: Mechanism | Motion,
    path: str | Path,
    *,
    language: str | None = None,
    units: str | None = None,
    case: object = None,
    over: object = None,
    acting: Acting | None = None,
    at: Mapping[str, object] = NOTHING,
    count: int = 11,
    columns: Sequence[str] | None = None,
    trace: Sequence[str] | None = None,
    limits: Mapping[str, Sequence[object]] | None = None,
    title_block: Mapping[str, str] = NOTHING,
    start: int = 1,
    number: str = "",
    revision: str = "",
    date: str = "",
    client: str = "",
    prepared: str = "",
    checked: str = "",
    approved: str = "",
) -> Path:
    """Return the path of the calculation report it wrote: .html, in one file; .pdf, A4, by Typst; or .md with its pictures in FILE_files.

    It begins with a title block, a sketch, verdicts, tables and curves. Then stand the inputs with units and sources, assumptions, and the
    standards that are cited. The equations are numbered from `start` on, with numbers filled in. Pin forces stand in every load case and
    at the relief valve's pressure. Limits of motion, checks with their measured figures, the version and a hash of the inputs end it.
    The same inputs give the same bytes on the same day, or on that of SOURCE_DATE_EPOCH. What is judged is over all that the machine runs,
    its `overs` or those of `over`; of a motion over its path. Tables and curves run there too, each path by itself; along one stroke where
    nothing is declared or `at` says so.

    The title block shows `number`, `revision`, `date`, `client` and who `prepared`, `checked` and `approved` it; what is left out is an
    empty line to write on. `title_block` adds rows below it, `{"Order": "4711"}`. `language` is "en" or "ru", by default the current one.
    `units` are "si", "bar-mm", "kgf" or "us", by default the current ones, else the system of the machine's own numbers. Each kind of
    number has one unit. `case` names one load case, by default all count; `acting` says loads, case and direction in one. `at` holds
    strokes, or gives the values between which one runs [m or rad], as for `animate`. `count` is the number of rows of the tables, `columns`
    are the results shown, `trace` the points whose paths are drawn. `limits` are as for `plot`. An existing file is replaced whole. Raises
    DefinitionError for a batch of designs, another kind of file or an unknown name, AssemblyError where no pose is in reach.

    Parameters
    ----------
    machine : Mechanism or Motion
        The design, or a motion of one.
    path : str or Path
        The file: .html, .pdf or .md.
    language : str, optional
        "en" or "ru".
    units : str, optional
        "si", "bar-mm", "kgf" or "us".
    case : LoadCase or str, optional
        The only load case that counts.
    over : Over, str or mapping, optional
        The domain, or the name of a declared one; by default all that the machine runs.
    acting : Acting, optional
        Loads, load case, direction and rates in one.
    at : mapping
        Strokes to hold, or to run between values, by name [m or rad].
    count : int
        The number of rows of the tables.
    columns : sequence, optional
        The columns shown; by default the table of results.
    trace : sequence of str, optional
        The points whose paths are drawn.
    limits : mapping, optional
        Limits by the column's name: `(value [SI], text)` or `(value, text, "below")`.
    title_block : mapping of str to str
        Further rows of the title block.
    start : int
        The number of the first equation.
    number : str
        The document's number.
    revision : str
        The revision.
    date : str
        The date.
    client : str
        The client.
    prepared : str
        Who prepared it.
    checked : str
        Who checked it.
    approved : str
        Who approved it.

    Returns
    -------
    Path
        The file written.

    Raises
    ------
    DefinitionError
        A batch of designs, another kind of file, an unknown name.
    AssemblyError
        No pose is in reach.
    """
    check_name(path)
    place = Path(path)
    given: Mapping[str, object] | Motion = at
    if isinstance(machine, Motion):
        over = machine if over is None else over
        machine, given = played_along(machine, at)
    if place.suffix.lower() not in WRITERS:
        raise DefinitionError(f"{cited(str(path))}: a report's name ends in one of {', '.join(WRITERS)}, which chooses the format.")
    if place.suffix.lower() == ".pdf":
        check_typst(place)
    check_place(place)
    block = TitleBlock(number, revision, date, client, prepared, checked, approved)
    shown = units if units is not None or current_system() else own_system(machine)
    document = report_document(
        machine, language=language, units=shown, case=case, at=given, over=over, acting=acting, count=count, columns=columns, trace=trace,
        limits=limits, title_block=title_block, start=start, block=block,
    )  # fmt: skip
    with speaking(language, shown):
        WRITERS[place.suffix.lower()](document, place)
    return place


def report_document(
    machine: Mechanism,
    *,
    language: str | None = None,
    units: str | None = None,
    case: object = None,
    at: At | Motion = NOTHING,
    over: object = None,
    acting: Acting | None = None,
    count: int = 11,
    columns: Sequence[str] | None = None,
    trace: Sequence[str] | None = None,
    limits: Mapping[str, Sequence[object]] | None = None,
    title_block: Mapping[str, str] = NOTHING,
    start: int = 1,
    block: TitleBlock | None = None,
) -> Document:
    """Return the contents of a report, before it is written as a file; each number in its own unit unless a system of units is named."""
    subject = ReportSubject.of(machine, at, count, over, situation_of("report", acting, case=case))
    fits = isinstance(title_block, Mapping) and all(isinstance(each, str) for pair in title_block.items() for each in pair)
    require(fits, "title_block", title_block, 'rows of text are expected, title_block={"Checked by": "N. N."}')
    with speaking(language, units):
        return composed(subject, columns, trace, limits, title_block, start, block or TitleBlock())


@contextmanager
def speaking(name: str | None, units: str | None) -> Iterator[None]:
    """Speak a language and show a system of units; those that hold already where none is named."""
    with spoken(current_language() if name is None else name), unit_system((current_system() or None) if units is None else units):
        yield


def composed(
    subject: ReportSubject,
    columns: Sequence[str] | None,
    trace: Sequence[str] | None,
    limits: Mapping[str, Sequence[object]] | None,
    title_block: Mapping[str, str],
    start: int,
    block: TitleBlock,
) -> Document:
    """Return the document, in the language and the units that hold."""
    machine, featured = subject.machine, subject.machine.featured()
    first = column_among(machine, subject.columns, None).name
    names = subject.columns_along(replace(subject.run, case=None), subject.curve)
    own = {name: given for name, given in featured.limits.items() if name in names}
    bounds = require_type("limits", own if limits is None else limits, Mapping, LIMITS)
    for name, given in bounds.items():
        known_name("Column", name, names, where=f"limits of {machine.plan.title}")
        limit_of(given, names[name].unit)
    path = named_points(machine, trace, "trace") if trace is not None else tuple(featured.path) or machine.plan.moving[-1:]
    # Answer the questions of verdicts, members and drives in one pass for their sections, which report refusals themselves.
    with unwarned(), suppress(LinkageError):
        members = [question for name, column in subject.member_columns for question in column_questions(subject, name, column)]
        drives = [end(request) for _, request, _ in drives_asked(subject) for end in (least, most)] if has_loads(subject.machine) else []
        subject.judge.answers([*verdict_questions(subject.verdict_judge), *members, *drives])
    found = calculated(machine, subject.pose, start, subject.run.case)
    verdicts, mark, judged, broken = verdict_section(subject, bounds)
    sections = (
        sketch_section(subject, path),
        with_texts(verdicts, cited_numbers),
        Section(said("Results"), tuple(results_blocks(subject, columns, first, bounds))),
        in_time_section(subject),
        *(each for one in speakers(machine.plan, HasVerdicts).values() for each in one.sections(subject.verdict_judge)),
        *members_sections(subject),
        with_texts(inputs_section(subject, found.listing), cited_numbers),
        assumptions_section(subject),
        standards_section(subject, judged),
        Section(said("Calculation"), tuple(calculation_blocks(found, subject.pose_words, subject.run.instants is not None))),
        forces_section(subject),
        limits_section(subject),
        checks_section(subject, found.values),
        definition_section(machine),
    )
    whole = tuple(with_texts(each, set_in_type) for each in sections if each is not None)
    words = cited_numbers(plain_words(translated(own_paragraphs(type(machine))[0])))
    facts = tuple((name, set_in_type(text)) for name, text in title_rows(subject, title_block, mark, broken))
    return Document(machine.plan.heading, words, block, facts, mark, whole, current_language())


def own_system(machine: object) -> str | None:
    """Return the system of units that a machine's own numbers are nearest to; None for anything but a machine."""
    if not isinstance(machine, Mechanism):
        return None
    given = {entry.unit for entry in machine.plan.table.entries.values()} | {each.unit for each in machine.plan.of_kind(Dimension).values()}
    return next((name for name, signs in OWN_UNITS.items() if given & signs), "bar-mm")


OWN_UNITS = {
    "kgf": {"kgf", "kgf/cm2", "kgf_cm2", "kgf m", "kgf/mm"}, "us": {"in", "inch", "ft", "lb", "lbf", "psi", "lbf ft", "lbf/in", "gal"},
    "si": {"MPa"},
}  # fmt: skip
"""The units by which a system is told."""


def set_in_type(text: str) -> str:
    """Return a text with the decimal sign of the language that is spoken, and the squares and cubes of its units raised."""
    return typeset(with_decimals(text))


def with_texts(section: Section, changed: Callable[[str], str]) -> Section:
    """Return a section whose texts are changed by a function; declarations stay as they are written.

    Columns that are empty in every row go.
    """

    def cell_of(heading: str, cell: Cell) -> Cell:
        return changed(cell) if isinstance(cell, str) and heading != said("declared as") else cell

    def of(block: Block) -> Block:
        match block:
            case str():
                return changed(block)
            case tuple():
                return tuple(map(changed, block))
            case TableBlock(filled=table):
                rows = tuple(tuple(map(cell_of, table.headings, row)) for row in table.rows)
                return replace(table, headings=tuple(map(changed, table.headings)), rows=rows)
            case Illustration():
                return replace(block, caption=changed(block.caption))
        return block

    return replace(section, blocks=tuple(map(of, section.blocks)))


# The numbers of a source's equations are not the report's: where a machine's own words cite one, they say whose it is.

NUMBER = re.compile(r"(?<![\w)\]])\((\d{1,3}(?:\.\d{1,3})?[a-z]?)\)")


def cited_numbers(text: str) -> str:
    """Return a text in which the number of an equation in parentheses is said to be the source's."""
    return NUMBER.sub(lambda found: said("[source, eq. {number}]", number=found[1]), text)


def title_rows(subject: ReportSubject, title_block: Mapping[str, str], mark: Mark, broken: str) -> tuple[tuple[str, str], ...]:
    """Return the rows of the title block: the machine, its inputs, the date, the version, and the rules that are not kept."""
    machine, cls = subject.machine, type(subject.machine)
    seen: dict[str, tuple[float, ...]] = {}
    texts = []  # `stacking: lift = 0 to 700 mm, 11 poses in tables; held: extend = 0 mm`
    for run in subject.runs:
        for name, way in [*run.ways.items(), *((name, (value,)) for name, value in run.held.items())]:
            seen[name] = (*seen.get(name, ()), *way)
        ways = (f"{name} = {way_text(way, stroke_display_unit(machine.plan, name, 'mm'))}" for name, way in run.ways.items())
        moves, held = ", ".join(ways), subject.words(dict(run.held))
        if run.is_curve:
            moves = said("{stroke}, {poses} poses in tables", stroke=moves, poses=subject.count)
        parts = "; ".join(filter(None, (moves, held and said("held: {held}", held=held))))
        texts.append(f"{run.title}: {parts}" if run.title else parts)
    epoch = os.environ.get("SOURCE_DATE_EPOCH", "")  # as for builds that can be repeated
    day = (datetime.fromtimestamp(int(epoch), UTC) if epoch.isdecimal() else datetime.now()).date()
    return (
        (said("Machine"), f"{machine.plan.heading} ({cls.__module__.removeprefix(OF_FILE)}:{cls.__qualname__})"),
        (said("Run"), ". ".join(texts)),
        (said("Judged over"), domain_words(subject.judge)),
        (said("Load cases"), ", ".join(map(subject.case_words, subject.judge.cases)) if has_loads(machine) else said("no loads")),
        (said("Verdicts"), mark.word),
        *([(said("Not kept"), broken)] if broken else []),
        *title_block.items(),
        (said("Calculated on"), day.isoformat()),
        (said("Inputs, SHA-256"), fingerprint(machine, seen)),
        (said("Calculated with"), f"hydrolinkage {own_version()}".strip()),
    )
