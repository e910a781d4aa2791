"""`hydrolinkage report NAME`: a machine's calculation report, HTML, PDF or Markdown; `page NAME`: a live page that works offline."""

from __future__ import annotations

from argparse import Namespace
from pathlib import Path

from ..disk import check_place
from ..errors import ensure
from ..plan import plan_measure
from .command import (
    PATH,
    Command,
    group,
    machine_options,
    option,
    picture,
    pose_options,
    progress_bar,
    repeatable,
    run_options,
    whole_number,
)
from .settings import OVER, machine_of, motion_along, overs_of, pair, si_value, strokes_given, with_overs

KINDS = (".html", ".pdf", ".md")
TITLE = {
    "number": "R-104", "revision": "A", "date": "2026-05-01", "client": "NAME", "prepared": "NAME", "checked": "NAME", "approved": "NAME",
}  # fmt: skip
"""The fields of the title block, each with an example."""


@Command(
    "report",
    "a machine's calculation report: inputs, drawings, equations with numbers, forces, checks, verdicts",
    *machine_options(),
    option("columns", metavar="COLUMN", nargs="*", default=[], help="only these results (default: all)"),
    option("-o", "--output", metavar="FILE", help=f"{', '.join(KINDS)} (default: the machine's name with .html)"),
    *pose_options(11),
    PATH,
    OVER,
    option("--case", metavar="CASE", help="this load case alone, plain: the machine's own loads (default: all)"),
    option("--start", metavar="N", type=whole_number, default=1, help="the first equation's number (default 1)"),
    group(
        "title block",
        *(option(f"--{name}", metavar=example, default="") for name, example in TITLE.items()),
        repeatable("--row", "NAME=TEXT", "a row below the title block; repeatable", "rows"),
        about="what is left out is an empty line to write on",
    ),
)
def report_command(options: Namespace) -> int:
    """Write a report."""
    from ..documents import report

    machine = machine_of(options)
    path = Path(options.output or f"{type(machine).__name__}.html")
    ensure(path.suffix.lower() in KINDS, f"-o {path}: a report's name ends in one of {', '.join(KINDS)}, which chooses the format.")
    check_place(path)
    at = strokes_given(machine, options)
    rows = dict(pair(text, "--row", '"Order=4711"') for text in options.rows)
    with progress_bar(f"writing {path.name}"):
        written = report(
            machine, path, case=options.case, over=overs_of(machine, options.over), at=at, count=options.count,
            columns=options.columns or None, trace=options.path, title_block=rows, start=options.start,
            **{name: getattr(options, name) for name in TITLE},
        )  # fmt: skip
    print(written)
    return 0


@Command(
    "page",
    "a live page, .html: the machine moved and its dimensions changed in a browser, offline",
    *machine_options(),
    option("-o", "--output", metavar="FILE", help="the page, .html (default: NAME.html)"),
    repeatable(
        "--vary",
        "OB=280mm,340mm",
        "a dimension with a slider, and its range if it is given; a point has two; repeatable (default: the first lengths)",
    ),
    option("--column", metavar="I", help="the column of `table` that is shown first"),
    option("--path", metavar="G", action="append", help="draw this point's path; repeatable"),
    OVER,
    *run_options(101, "poses of the curve"),
)
def page_command(options: Namespace) -> int:
    """Write a live page into a file."""
    machine = machine_of(options)
    path = picture(options, machine, (".html",))
    machine = with_overs(machine, overs_of(machine, options.over))
    at = strokes_given(machine, options)
    motion_along(machine, options.count, at)
    vary: dict[str, tuple[float, float] | None] = {}
    for text in options.vary:  # `OB`, or `OB=280mm,340mm`
        name, equals, ends = (part.strip() for part in text.partition("="))
        owner = machine.plan.table.spellings.get(name, ("", 1))[0]
        measures = plan_measure(machine.plan, owner) if owner else ""
        values = [si_value(each, measures, f"--vary {name}") for each in ends.split(",")] if equals else []
        fits = not equals or len(values) == 2
        ensure(fits, f"--vary {text}: the least and the greatest value are expected, --vary {name or 'OB'}=280mm,340mm.")
        vary[name] = (values[0], values[1]) if equals else None
    from ..pictures import page

    with progress_bar(f"writing {path.name}"):
        page(
            machine, path, vary=vary or None, column=options.column, trace=options.path, at=at, count=options.count,
            language=options.language,
        )  # fmt: skip
    print(path)
    return 0
