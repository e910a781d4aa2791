"""Where a mechanism cannot be assembled, in words: the point, its triangle, the strokes, the missing millimetres."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from ..errors import AssemblyError
from ..plan import ArrayReading, Plan
from ..quantities import Negative, Quantity, Ref, Sum, quantity
from ..steps import Step
from ..units import mm

Mask = npt.NDArray[np.bool_]


def first_failure(plan: Plan, reading: ArrayReading) -> str:
    """Return the first member, in the order of construction, that cannot be placed at some pose of a reading."""
    return next(name for name in plan.members if name in reading.sines and np.any(np.isnan(reading.sines[name])))


def refusal(plan: Plan, reading: ArrayReading, mask: Mask, strokes: Mapping[str, Any]) -> AssemblyError:
    """Return the error for poses that cannot be assembled.

    `reading` holds the failing poses, `mask` all of them (designs first, strokes last), `strokes` their values.
    """
    name = first_failure(plan, reading)
    member = plan.members[name]
    opening = member.sentence() if isinstance(member, Step) else f"{name} = {member}"
    words, shortfall = triangle_words(plan, name, reading)
    text = f"{opening} cannot be assembled {where_words(plan, mask, strokes)}:\n{words}"
    return AssemblyError(text, point=name, mask=mask, shortfall=shortfall)


def triangle_words(plan: Plan, name: str, reading: ArrayReading) -> tuple[str, float]:
    """Return how a triangle misses, at its worst pose, and by how much [m]."""
    sides = plan.members[name].sides(reading)
    if not sides:
        return "its point lies nowhere. Shorten the stroke or change a dimension.", float("nan")
    labels = [label for label, _ in sides]
    values = np.array(np.broadcast_arrays(*(value for _, value in sides)), float).reshape(len(sides), -1)
    missing = 2 * values.max(axis=0) - values.sum(axis=0)
    worst = int(np.nanargmax(missing))
    longest = int(values[:, worst].argmax())
    others = [index for index in range(3) if index != longest]
    gap = float(missing[worst])
    return (
        f"{' + '.join(labels[index] for index in others)} = {values[others, worst].sum():.4g} m is {gap / mm:.3g} mm short of "
        f"{labels[longest]} = {values[longest, worst]:.4g} m. Shorten the stroke or {remedy(plan, labels, longest)}.",
        gap,
    )


def remedy(plan: Plan, labels: Sequence[str], longest: int) -> str:
    """Return what to change: a dimension that closes the gap."""
    free = [label for index, label in enumerate(labels) if index != longest and label in plan.table.spellings]
    if free:
        return f"lengthen {free[-1]}"
    return f"shorten {labels[longest]}" if labels[longest] in plan.table.spellings else "move its points closer"


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


def stroke_unit(plan: Plan, name: str) -> str:
    """Return the unit of a stroke: rad where it turns a crank or a vector, else m."""
    turning = [getattr(member, "angle", None) for member in plan.members.values()]
    return "rad" if any(angle is not None and name in terms(angle) for angle in turning) else "m"


def terms(angle: Quantity) -> set[str]:
    """Return the names an angle is a sum of."""
    if angle.name:
        return {angle.name}
    parts = (quantity(part) for part in angle.parts() if isinstance(part, (str, Quantity)))
    return {str(angle)} if isinstance(angle, Ref) else set().union(*map(terms, parts)) if isinstance(angle, (Sum, Negative)) else set()
