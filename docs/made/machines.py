"""A page for each machine, from its code alone: what it is, drawings, its curve, its numbers, construction, equations and verdicts."""

from __future__ import annotations

import inspect
import re
import textwrap
import warnings
from collections.abc import Iterable, Iterator
from html import escape
from importlib.metadata import EntryPoint, entry_points
from pathlib import Path

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from linkage import LinkageError, Mechanism, Verdict, draw, equations, page, plot
from linkage.reports import design_rows, motion_over, run_of, stroke_rows

from .commands import block, printed
from .formulas import formula

WIDE = 100
"""The most characters in a line of code."""
NO_BREAK = "\N{NO-BREAK SPACE}"
MOST_EQUATIONS = 60
THUMB = (3.2, 2.4)  # inch

TOLD = {
    "three_point_hitch": ["three_point_hitch"],
    "header_balancer": ["header_balancer"],
    "crane": ["crane"],
    "arm_drive": ["crane_drives"],
    "boom_drive": ["crane_drives"],
    "grapple": ["grapple"],
    "mower_lift": ["redesigns"],
}
"""Pages written by hand that go on about a machine."""


def registered() -> dict[str, EntryPoint]:
    """Return the shipped machines by name."""
    found = {each.name: each for each in entry_points(group="hydrolinkage.machines") if each.value.startswith("mechanisms.")}
    return {name: found[name] for name in sorted(found)}


def title(machine: Mechanism) -> str:
    """Return a machine's title."""
    return str(machine.plan.heading)


def doc(machine: Mechanism) -> str:
    """Return what a machine's class says of itself."""
    return inspect.cleandoc(type(machine).__doc__ or "")


def make(name: str, folder: Path) -> tuple[str, str]:
    """Write a machine's page, its pictures and its live page into a folder; return its title and the first line of its page."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        machine = registered()[name].load()()
        draw(machine).savefig(folder / "machines" / f"{name}.png")
        plot(machine).savefig(folder / "machines" / f"{name}_curve.png")
        thumb(machine).savefig(folder / "extra" / "thumbs" / f"{name}.png")
        page(machine, folder / "extra" / "live" / f"{name}.html")
        (folder / "machines" / f"{name}.md").write_text(text(name, machine), encoding="utf-8")
        return title(machine), as_markdown(doc(machine).partition("\n")[0])


def thumb(machine: Mechanism) -> Figure:
    """Return a small picture of a machine in the middle of its motion, as `draw` shows it, without a frame and scales."""
    figure = Figure(figsize=THUMB, dpi=150, facecolor="white")
    FigureCanvasAgg(figure)
    ax = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    motion = motion_over(machine, run_of(machine), np.linspace(0.0, 1.0, 5))
    reached = np.flatnonzero(motion.reached.ravel())
    draw(motion, ax=ax, pose=int(reached[reached.size // 2]))
    ax.grid(False)
    ax.set_axis_off()
    for each in ax.texts:
        each.set_visible(False)
    return figure


def text(name: str, machine: Mechanism) -> str:
    """Return a machine's page."""
    return "\n".join(part for parts in (head(name, machine), numbers(machine), told(name, machine), source(machine)) for part in parts)


def head(name: str, machine: Mechanism) -> Iterator[str]:
    """Yield what a machine is and what it looks like."""
    yield f"# {title(machine)}\n"
    yield f"{as_markdown(doc(machine))}\n"
    if name in TOLD:
        yield "More: " + ", ".join(f"{{doc}}`/{each}`" for each in TOLD[name]) + ".\n"
    kind = type(machine)
    yield f"```python\nfrom {kind.__module__} import {kind.__name__}\n\nmachine = {kind.__name__}()\n```\n"
    yield f"On the command line its name is `{name}`: `hydrolinkage show {name}`.\n"
    yield f"![{title(machine)} at its ends, as `draw(machine)` shows it]({name}.png)\n"
    yield "## Live\n"
    yield f'Move it, change its dimensions, or open <a href="@live/{name}.html">the page alone</a>: `page(machine, "{name}.html")`.\n'
    yield f'<iframe class="live" loading="lazy" title="{title(machine)}, live" src="@live/{name}.html"></iframe>\n'
    yield "## What it is about\n"
    yield f"![The curve that `plot(machine)` shows unasked]({name}_curve.png)\n"


def numbers(machine: Mechanism) -> Iterator[str]:
    """Yield the strokes and the dimensions."""
    yield "## Strokes and dimensions\n"
    yield table(("stroke", "range"), stroke_rows(machine))
    yield table(("dimension", "value", "of the step"), design_rows(machine))
    yield f"{len(machine.links)} bodies, the frame included.\n"


def table(heads: Iterable[str], rows: Iterable[Iterable[str]]) -> str:
    """Return a table, empty where it has no rows; no cell breaks, also on a phone."""
    body = [f"| {' | '.join(cell.replace('|', chr(92) + '|').replace(' ', NO_BREAK) for cell in row)} |" for row in rows]
    names = list(heads)
    return "\n".join([f"| {' | '.join(names)} |", "|" + " --- |" * len(names), *body, ""]) if body else ""


def told(name: str, machine: Mechanism) -> Iterator[str]:
    """Yield the construction, the limits, the verdicts and the equations."""
    yield "## Construction\n"
    yield f"What `print(machine.plan)` says:\n\n```python\n{wrapped(str(machine.plan))}\n```\n"
    yield f"## Limits\n\nWhat `hydrolinkage limits {name}` says:\n\n{block(wrapped(printed('limits', name)))}"
    verdicts = machine.verdicts()
    if verdicts:
        yield f"## Verdicts\n\n{verdict_list(verdicts)}\n"
    yield from equation_lines(machine)


def verdict_list(verdicts: Iterable[Verdict]) -> str:
    """Return verdicts as a list, each rule marked as kept or not."""
    rows = ['<ul class="verdicts">']
    for each in verdicts:
        kind = "" if each.ok is None else ' class="ok"' if each.ok else ' class="fails"'
        said = escape(str(each), quote=False).replace("\n", "<br>")
        rows.append(f"<li{kind}>{said}</li>")
    return "\n".join([*rows, "</ul>"])


def equation_lines(machine: Mechanism) -> Iterator[str]:
    """Yield the numbered equations, where they are not too many."""
    try:
        written = equations(machine)
    except LinkageError as error:
        yield f"## Equations\n\n{as_markdown(str(error))}\n"
        return
    if len(written) > MOST_EQUATIONS:
        yield f"## Equations\n\nIt has {len(written)}; `print(equations(machine))` lists them.\n"
        return
    yield "## Equations\n\n`equations(machine)`, as a notebook shows them: in the order of working out, with the numbers of one pose.\n"
    yield from map(formula, written.definitions)
    yield f'<div class="shown">{written._repr_html_()}</div>\n'


def source(machine: Mechanism) -> Iterator[str]:
    """Yield the class as it is written."""
    kind = type(machine)
    yield f'## Source\n\n<details class="source"><summary>{kind.__module__}</summary>\n'
    yield f"```python\n{textwrap.dedent(inspect.getsource(kind)).rstrip()}\n```\n\n</details>\n"


def wrapped(text: str) -> str:
    """Return text whose lines have at most `WIDE` characters, the rest of a long one set in."""
    found = []
    for line in text.splitlines():
        indent = " " * (len(line) - len(line.lstrip()) + 4)
        parts = textwrap.wrap(line, WIDE, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False, drop_whitespace=True)
        found += parts or [""]
    return "\n".join(found)


def as_markdown(text: str) -> str:
    """Return a docstring as Markdown: what is not code stands for itself."""
    parts = re.split(r"(`[^`]*`)", text)
    return "".join(part if part.startswith("`") else re.sub(r"([*<>$\[\]])", r"\\\1", part) for part in parts)
