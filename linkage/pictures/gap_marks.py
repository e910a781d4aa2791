"""Nearest bodies: a short dimension between the two nearest places of two bodies, with its length in words."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import TypeAlias

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from ..errors import require, require_type, unwarned
from ..frozen import immutable
from ..language import said, with_and
from ..motion import Motion, Planes, Request, clearance, gap, nearest_gap, nearest_places, pair_at, pairs_without_planes
from ..motion.grid import recalled
from ..motion.limits import NO_LENGTH
from ..motion.planes import depth_words
from ..motion.strokes import strokes_over_axes
from ..plan import Plan
from ..program import FloatArray
from ..units import show
from . import style
from .arrows import Wording
from .drawing import arrow_between
from .shapes import left_of

SHORT = 5.0
"""A gap that is shorter than so many sizes has its arrows outside."""
REACH, BARB = 2.4, 0.34
"""How far an outer arrow reaches, and half the width of a tick at a gap's end, in sizes."""
MOST_NAMED = 3
"""The pairs that a note names at the most."""
Pairs: TypeAlias = tuple[tuple[str, str], ...] | None
"""The bodies that are compared where no `Planes` are declared, pair by pair; None where these or two names say which."""


@immutable
class GapMark:
    """The gap of two bodies at a pose: its name, its two places, shape (2, 2) [m], and its text; another pose's is faint."""

    name: str
    ends: FloatArray
    words: str
    faint: bool = False

    def outer(self, size: float) -> FloatArray:
        """Return all places that its lines reach, shape (4, 2) [m]."""
        out = REACH * size * self.along
        return np.array([self.ends[0] - out, *self.ends, self.ends[1] + out])

    @property
    def along(self) -> FloatArray:
        """The direction from its first place to the second, of length one; to the right where both are one."""
        arm = self.ends[1] - self.ends[0]
        length = float(np.hypot(*arm))
        return arm / length if length > 0.0 else np.array([1.0, 0.0])


def body_pair(what: str, given: object, expected: str) -> tuple[str, str]:
    """Return two bodies by their names; DefinitionError, in the words of `require`, for anything but such a pair."""
    pair = require_type(what, given, (list, tuple), expected, of=str)
    require(len(pair) == 2, what, given, expected)
    return str(pair[0]), str(pair[1])


def own_bodies(plan: Plan) -> tuple[str, str]:
    """Return the names of two moving bodies of a machine for an example; of one that has a single one the frame beside it."""
    first, *others = [body.name for body in plan.bodies[1:]] or ["AB"]
    return first, next(iter(others), "frame")


def asked_pair(given: object, plan: Plan) -> tuple[str, str] | None:
    """Return the two bodies that `draw(clearance=...)` names, None for the nearest ones; DefinitionError for anything else."""
    if given is True:
        return None
    one, other = own_bodies(plan)
    expected = f'say clearance=True for what the machine\'s Planes keep apart, or two bodies, clearance=("{one}", "{other}")'
    return body_pair(f"{plan.title}: clearance", given, expected)


def gap_asked(given: object, plan: Plan, pairs: Pairs) -> Request | Callable[[Motion], FloatArray]:
    """Return the request, or the function of a motion, whose least value `draw(clearance=...)` is about."""
    pair = asked_pair(given, plan)
    if pair is None:
        return clearance() if pairs is None else partial(nearest_gap, pairs=pairs)
    return gap(*pair)


def assumed_pairs(motion: Motion) -> tuple[Pairs, str]:
    """Return the pairs to look at where no `Planes` are declared, else None, and a note on the pairs left out.

    Bodies that share a pin are left out. So are bodies that cross at the ends and in the middle of all strokes.
    """
    plan = motion.plan
    if plan.of_kind(Planes):
        return None, ""
    strokes = strokes_over_axes({name: np.linspace(each.start, each.end, 3) for name, each in plan.strokes.items()})
    corners = Motion(plan, motion.designs, strokes, "nan")
    apart, crossing = recalled(corners, "pairs without planes", lambda: pairs_without_planes(corners))
    one, other = own_bodies(plan)
    all_share = f'all bodies share a pin or lie over each other; name two that do not, clearance=("{one}", "{other}")'
    require(apart, f"{plan.title}: clearance", True, all_share)
    note = said("No Planes are declared: all bodies are taken in one plane, those that share a pin left out.")
    if crossing:
        names = [with_and(pair) for pair in crossing[:MOST_NAMED]] + ["..."] * (len(crossing) > MOST_NAMED)
        note += " " + said("Left out as well, since they cross at all ends of the strokes: {pairs}.", pairs=", ".join(names))
    return apart, note


def worst_pose(motion: Motion, given: object, pairs: Pairs, shown: int) -> int:
    """Return the pose of a motion, a flat index, at which the gap is least: the one shown, where it is no greater there."""
    asked = gap_asked(given, motion.plan, pairs)
    with unwarned():
        values = np.ravel(motion[asked] if isinstance(asked, Request) else asked(motion))
    values = np.where(np.isfinite(values), values, np.inf)
    worst = int(np.argmin(values))
    return worst if values[worst] < values[shown] else shown


def gap_mark(at: Motion, given: object, pairs: Pairs, place: str = "") -> GapMark:
    """Return the mark of the gap at a motion of one pose; faint with the `place` of another pose than the one shown."""
    asked = gap_asked(given, at.plan, pairs)
    if isinstance(asked, Request):
        asked.bound(at.plan)  # DefinitionError for two bodies that have no gap, and where no two are left
    pair, width = asked_pair(given, at.plan), 0.0
    if pair is None:
        pair, width = pair_at(at, pairs)
    found = nearest_places(at.plan, at._placed, *pair)
    size = found.gap - width if abs(found.gap - width) > NO_LENGTH else 0.0
    names = dict(one=pair[0], other=pair[1], gap=show(abs(size), "mm", 3))
    if size < 0.0:
        words = said("{one} and {other} cross by {gap}", **names | {"gap": depth_words(at.plan, *pair, names["gap"])})
    else:
        words = said("{gap} between {one} and {other}", **names)
    line = GapMark(f"gap {pair[0]} {pair[1]}", np.array([found.one, found.other]), f"{words}, {place}" if place else words, bool(place))
    half = (0.5 if found.gap > 0.0 else -0.5) * width * line.along
    return replace(line, ends=line.ends + np.array([half, -half]))


def draw_gap(ax: Axes, mark: GapMark, size: float) -> list[Wording]:
    """Draw a gap as a dimension, a short one with its arrows outside, and return its text."""
    colour = style.mixed(style.ACCENT, style.PAPER, 0.4) if mark.faint else style.ACCENT
    level, (start, end), way = 14.0 if mark.faint else 18.0, mark.ends, mark.along
    across = BARB * size * left_of(way)
    is_short = float(np.hypot(*(end - start))) < SHORT * size
    lines = [np.array([start, end]), *(np.array([place - across, place + across]) for place in (start, end))]
    for line in lines:
        ax.add_line(Line2D(*line.T, color=colour, linewidth=1.8, solid_capstyle="round", zorder=level, gid=mark.name))
    for tip, out in ((start, -way), (end, way)):
        tail = tip + (REACH * size * out if is_short else -min(REACH * size, 0.5 * float(np.hypot(*(end - start)))) * out)
        arrow_between(ax, tail, tip, colour, 11, level, clip=False)
    return [Wording(mark.words, mark.ends.mean(axis=0), left_of(way), colour, mark.name)]
