"""The limits of a design: of every stroke by itself, and what is lost where all of them run together."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..assembly import width_words
from ..errors import unwarned
from ..plan import Plan, name_or_pins
from . import stroke_search
from .answer import places_text
from .judge import Judge
from .limits import BoxLimits, Limits, LoopMargin
from .margins import LeastMargin, least_margins
from .measures import reachable
from .motion import Motion
from .over import Over


def limits_over(motion: Motion, overs: Sequence[Over | Motion] = (Over(),)) -> Limits:
    """Return the limits along every stroke of one design, and what is lost over the box of all, or over what is given."""
    strokes = stroke_search.limits(motion)
    if not strokes:
        return strokes
    return Limits(strokes, box_limits(Judge(motion.plan, motion.designs, overs)), width_words(motion.plan, motion.designs))


def box_limits(judge: Judge) -> BoxLimits:
    """Return what cannot be assembled where a judge looks, and how clear each loop stays of its dead point there."""
    lost = judge.answer(reachable).lost
    title = "; ".join(place.over.words(place.motion) for place in judge.places)
    least: dict[tuple[str, str], LeastMargin] = {}
    with unwarned():
        found = [each for place in judge.places if place.over.shape != "poses" for each in least_margins(place.motion)]
    for each in found:
        known = least.get((each.step, each.kind))
        if not np.isnan(each.value) and (known is None or each.value < known.value):
            least[each.step, each.kind] = each
    return BoxLimits(title, lost.share, dict(lost.strokes), lost.sentence, tuple(loop_margin(judge.plan, each) for each in least.values()))


def loop_margin(plan: Plan, least: LeastMargin) -> LoopMargin:
    """Return the least margin of a loop as it is read: squares as their roots, sines as angles."""
    value = max(float(least.value), 0.0)
    clear = value if least.kind == "length" else value**0.5
    if least.kind in ("links", "guides"):
        clear = float(np.arcsin(min(clear, 1.0)))
    strokes = {name: float(each) for name, each in least.strokes.items()}
    return LoopMargin(name_or_pins(plan, least.step), least.kind, clear, bool(least.is_hole), strokes, places_text(strokes, least.units))


Motion._limits_of = limits_over  # a motion's limits ask the judge, who is made with motions
