"""Where a mechanism cannot be assembled, in words: the strokes, and what is missing there."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ..errors import AssemblyError, DefinitionError
from ..plan import ArrayReading, Plan
from ..plan import Mask as Mask
from ..plan import called as called
from ..plan import failures as failures
from ..plan import missing_words as missing_words
from ..plan import negative as negative
from ..plan import opening as opening
from .limits import READ_IN, as_read, number


@np.errstate(all="ignore")
def refusal(plan: Plan, reading: ArrayReading, mask: Mask, strokes: Mapping[str, Any], stop: str = "") -> AssemblyError:
    """Return the error for poses that cannot be assembled.

    `reading` holds the failing poses, `mask` all of them (designs first, strokes last), `strokes` their values.
    """
    name, lost = next(failures(plan, reading, (int(mask.sum()),)))
    words, shortfall = missing_words(plan, name, reading, lost)
    text = f"{opening(plan, name)} cannot be assembled {where_words(plan, mask, strokes)}:\n{words}{stop}"
    return AssemblyError(text, point=name, mask=mask, shortfall=shortfall)


def no_joint(plan: Plan, name: str, joints: Sequence[str]) -> DefinitionError:
    """Return the error for a point that has no transmission angle."""
    known = ", ".join(joints) or "none"
    why = f"has no transmission angle, {name} is not the joint of a dyad"
    return DefinitionError(f"{plan.title}: {opening(plan, name)} {why}; those are: {known}.")


def where_words(plan: Plan, mask: Mask, strokes: Mapping[str, Any]) -> str:
    """Return which poses are meant: `at 7 of 101 strokes, from S = 0.1598 to 0.1700 m`."""
    count, total = int(mask.sum()), mask.size
    poses = next(iter(strokes.values())).ndim if strokes else 0
    if mask.ndim > poses:
        designs = mask.reshape(*mask.shape[: mask.ndim - poses], -1)
        return f"at {count} of {total} poses, in {int(designs.any(axis=-1).sum())} of {designs[..., 0].size} designs"
    spans = [f"{name} = {span(value[mask], stroke_unit(plan, name))}" for name, value in strokes.items()]
    if total == 1:
        return f"at {', '.join(spans)}" if spans else "anywhere"
    return f"at {count} of {total} strokes, {'from ' if count > 1 else 'at '}{', '.join(spans)}"


def span(values: Any, unit: str) -> str:
    """Return the range of some stroke values as text."""
    low, high = float(np.min(values)), float(np.max(values))
    return f"{low:.4f} {unit}" if low == high else f"{low:.4f} to {high:.4f} {unit}"


def span_read(values: Any, unit: str) -> str:
    """Return the range of some stroke values as it is read: `0 to 0.25 m`, `90 deg`."""
    if not np.size(values):
        return "nothing"
    low, high = float(np.min(values)), float(np.max(values))
    return as_read(low, unit, 6) if low == high else f"{number(low, unit, 6)} to {as_read(high, unit, 6)}"


def place_read(value: Any, unit: str) -> str:
    """Return a stroke [m or rad], or the range of several, as a place of it is read: `0.1234 m`, `25.00 deg`, `0.1000 to 0.2000 m`."""
    digits, (factor, name) = 2 if unit == "rad" else 4, READ_IN[unit]
    ends = dict.fromkeys(f"{float(each) / factor + 0.0:.{digits}f}" for each in (np.min(value), np.max(value)))
    return f"{' to '.join(ends)} {name}"


def stroke_unit(plan: Plan, name: str) -> str:
    """Return the unit of a stroke: rad where it is an angle or a part of one, else m."""
    return "rad" if name in plan.turning else "m"
