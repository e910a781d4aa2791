"""Notebooks: machines, motions and results as HTML, drawings inside as SVG, a live page in a frame of its own.

>>> from linkage.notebook import live
>>> from mechanisms.classics.four_bar import FourBar
>>> live(FourBar(), height=500)._repr_html_()[:50]
'<iframe sandbox="allow-scripts" style="width:100%;'
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import singledispatch
from html import escape
from io import BytesIO
from itertools import count
from typing import Any

import numpy as np
from matplotlib import rc_context
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from .assembly import Assembly
from .errors import LinkageError
from .formulas import Equations
from .formulas.typeset import boxes, breakable, mathml
from .frozen import record
from .language import said
from .mechanism import Mechanism
from .mobility import ChainTables
from .motion import Motion, columns_of, pose_sentence
from .pictures import draw, page_html
from .pictures.dimensioned import dimensioned
from .pictures.sheet import Picture
from .plan import Plan, printed
from .reports import NOTHING, design_rows, stroke_middles, stroke_rows
from .reports.values import column_texts, flat
from .shown import Shown, ShownList
from .statics import PinForces, max_table
from .statics.table import max_headings
from .study import Front, Optimum, Survey
from .synthesis import Synthesis
from .units import show
from .verdict import Remark, Verdict

MOST_ROWS, MOST_COLUMNS = 11, 12
"""The most poses and columns of a motion that are listed; of more, these many spread over it, and the first columns."""
WIDTH, HEIGHT = 8.0, 6.0  # of a drawing, inch


@record
class LivePage(Shown):
    """A live page in a notebook: its HTML, and how high its frame is [pixels]."""

    html: str
    height: int = 660


def live(machine: Mechanism | Synthesis, height: int = 660, **options: Any) -> LivePage:
    """Return the live page of a machine, or of a synthesis, for a notebook, in a frame that has no access to it.

    `options` are those of `linkage.page`.
    """
    return LivePage(page_html(machine, **({"at": NOTHING} | options)), height)


@singledispatch
def html_of(what: object) -> str:
    """Return an object as HTML for a notebook; of an unknown kind its text."""
    return html_text_block(str(what))


# -- what HTML is made of ----------------------------------------------------------------------------------


def html_text_block(text: str) -> str:
    """Return text as it stands."""
    return f'<pre style="white-space:pre-wrap">{escape(text)}</pre>'


def html_table(heads: Sequence[str], rows: Iterable[Sequence[str]], caption: str = "") -> str:
    """Return a table of texts; empty where it has no rows."""
    body = "".join(f"<tr>{''.join(f'<td>{escape(cell)}</td>' for cell in row)}</tr>" for row in rows)
    if not body:
        return ""
    title = f"<caption>{escape(caption)}</caption>" if caption else ""
    return f"<table>{title}<thead><tr>{''.join(f'<th>{escape(each)}</th>' for each in heads)}</tr></thead><tbody>{body}</tbody></table>"


def html_titled(title: str, *parts: str) -> str:
    """Return parts under a title."""
    return f"<div><strong>{escape(title)}</strong>{''.join(parts)}</div>"


PLACES = count(1)
"""Numbers of pictures: two of them in one notebook name nothing alike."""


def inline_svg(figure: Figure) -> str:
    """Return a figure as an SVG element that is as wide as its place at most; its letters are letters."""
    stream = BytesIO()
    with rc_context({"svg.fonttype": "none", "svg.hashsalt": f"linkage {next(PLACES)}"}):
        figure.savefig(stream, format="svg", metadata={"Date": None, "Creator": None})
    text = stream.getvalue().decode()
    head, _, rest = text[text.index("<svg") :].partition(">")
    kept = " ".join(part for part in head.split() if not part.startswith(("width=", "height=")))
    svg = f'{kept} style="width:100%;height:auto">{rest}'
    return f'<div style="max-width:{figure.get_figwidth() * 96:.0f}px;background:#fff">{svg}</div>'


# -- machines and motions ----------------------------------------------------------------------------------


@html_of.register
def _(machine: Mechanism) -> str:
    figure = Picture(figsize=(WIDTH, HEIGHT), facecolor="white")
    FigureCanvasAgg(figure)
    if any(map(np.ndim, machine.dimensions.values())):
        shown = html_text_block(repr(machine))
    else:
        middles: dict[str, Any] = stroke_middles(machine)
        try:  # with its dimensions, its strokes in their middle; where that is out of reach, why
            dimensioned(figure.add_axes((0.08, 0.08, 0.9, 0.9)), machine.at(**middles))
            shown = inline_svg(figure)
        except LinkageError as error:
            shown = html_text_block(str(error))
    strokes = html_table((said("stroke"), "range"), stroke_rows(machine))
    dimensions = html_table((said("dimension"), said("value")), (row[:2] for row in design_rows(machine)))
    return html_titled(machine.plan.heading, shown, strokes, dimensions)


@html_of.register
def _(plan: Plan) -> str:
    return html_titled(plan.heading, html_table((said("name"), said("declared as")), printed(plan).items()))


@html_of.register
def _(chain: ChainTables) -> str:
    bodies = html_table((said("name"), said("kind"), said("points")), chain.bodies)
    joints = html_table((said("joint"), said("kind"), said("on body"), said("from body"), said("stroke")), chain.joints)
    return html_titled(chain.title, bodies, joints)


@html_of.register
def _(motion: Motion) -> str:
    if motion._design_shape:
        return html_text_block(repr(motion))
    there = columns_of(motion)
    columns, caption = there[:MOST_COLUMNS], f"{MOST_COLUMNS} / {len(there)}" if len(there) > MOST_COLUMNS else ""
    texts = [column_texts(column, values) for column, values in zip(columns, flat(columns), strict=True)]
    poses = np.unique(np.linspace(0, len(texts[0]) - 1, MOST_ROWS).round().astype(int)).tolist() if texts[0] else []
    rows = ([text[pose] for text in texts] for pose in poses)
    pose = pose_sentence(motion) if motion.reached.size == 1 and motion.reached.all() else ""
    told = html_text_block("\n".join(filter(None, [repr(motion), pose])))
    return told + html_table([column.heading for column in columns], rows, caption)


@html_of.register
def _(equations: Equations) -> str:
    form = '<math xmlns="http://www.w3.org/1998/Math/MathML" displaystyle="true">'
    lines = []
    for each in equations.sheet():  # as MathML that may break between its terms
        parts = []
        for place, step in enumerate(each.steps):
            for first, piece in enumerate(breakable(boxes(step))):
                sign = "<mo>=</mo>" if place and not first else ""
                parts.append(f"{form}{sign}{mathml(piece)}</math>")
        lines += [f"<p><b>{escape(each.heading)}</b></p>"] if each.heading else []
        written = f"<span>({each.number})</span><div>{' '.join(parts)}</div>"
        lines.append(f'<div style="display:flex;gap:1em;margin:.3em 0">{written}</div>')
    return "".join(lines)


@html_of.register
def _(frame: LivePage) -> str:
    style = f"width:100%;box-sizing:border-box;height:{frame.height}px;border:1px solid #ccc"
    return f'<iframe sandbox="allow-scripts" style="{style}" srcdoc="{escape(frame.html)}"></iframe>'


# -- results -----------------------------------------------------------------------------------------------


@html_of.register
def _(forces: PinForces) -> str:
    head = f"{forces.motion.plan.heading}, {forces.case}, {forces.direction}"
    try:
        worst = html_table(max_headings(), (row.cells for row in max_table(forces)))
    except LinkageError as error:
        worst = html_text_block(str(error))
    gap = "" if np.isnan(forces.gap) else f"; {forces.gap:.0e}"
    return html_titled(head, worst, html_text_block("\n".join([f"{forces.residual:.0e}{gap}", *map(str, forces.remarks)])))


@html_of.register
def _(verdict: Verdict) -> str:
    colour = "#1a7f37" if verdict.ok else "#c62828"
    return f'<div style="border-left:4px solid {colour};padding:.2em .6em;margin:.3em 0">{escape(str(verdict))}</div>'


@html_of.register
def _(remark: Remark) -> str:
    return f"<div>{escape(remark)}</div>"


@html_of.register
def _(several: ShownList) -> str:  # type: ignore[type-arg]
    if several and all(isinstance(each, Assembly) for each in several):
        return inline_svg(draw(several)) + html_table(("code",), ([each.code] for each in several if each.code))
    return "".join(html_of(each) if isinstance(each, Shown) else f"<div>{escape(str(each))}</div>" for each in several)


@html_of.register
def _(mode: Assembly) -> str:
    return inline_svg(draw([mode])) if mode.plan is not None else html_text_block(str(mode))


@html_of.register
def _(found: Survey) -> str:
    def row(name: str) -> list[str]:
        values = np.asarray(found[name], float)
        if not np.isfinite(values).any():
            return [name, "-", "-", "-", "0"]
        low, high = int(np.nanargmin(values)), int(np.nanargmax(values))
        numbers = [f"{np.nanmean(values):.6g}", f"{values[low]:.6g} ({low})", f"{values[high]:.6g} ({high})"]
        return [name, *numbers, str(int(np.isfinite(values).sum()))]

    return html_text_block(repr(found)) + html_table(("result", "mean", "least (design)", "greatest (design)", "designs"), map(row, found))


@html_of.register
def _(best: Optimum) -> str:
    return html_text_block(str(best)) + inline_svg(draw(best))


@html_of.register
def _(found: Synthesis) -> str:
    return html_text_block(str(found)) + (inline_svg(draw(found)) if found.solutions else "")


@html_of.register
def _(front: Front) -> str:
    rows = ([show(value, unit) for value, unit in zip(each.values, front.units, strict=True)] for each in front.points)
    return html_titled(front.title, html_table([str(each) for each in front.objectives], rows))
