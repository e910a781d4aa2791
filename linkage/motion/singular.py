"""How near a pose is to a singular one, and what is said about it.

Where two links that close a loop come into line, a velocity ratio is off by about 0.1-0.3 eps cond^2, with
cond the condition of the scaled constraint Jacobian: (1 + cos) / sin of the angle between the links. Where the
loop's other side is longer than its links the squares cancel more: cond^2 then grows by the reading's `rounding`.
"""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from typing import Any

import numpy as np

from ..errors import SingularError, SingularWarning
from ..plan import ArrayReading, Plan
from ..program import FloatArray
from ..quantities import Member
from ..steps import Point
from .reach import Mask, called, opening, where_words

WARN = 1e4
REFUSE = 1e6


def conditions(plan: Plan, reading: ArrayReading, names: set[str]) -> dict[str, FloatArray]:
    """Return the condition of every loop among some members, at every pose of a reading."""
    return {
        name: condition(np.asarray(sine, float)) * np.sqrt(np.maximum(reading.rounding.get(name, 1.0), 1.0))
        for name, sine in loops(plan, reading).items()
        if name in names
    }


def loops(plan: Plan, reading: ArrayReading) -> dict[str, Any]:
    """Return the sines of the loops that move; a triangle rigid in itself is none."""
    return {name: sine for name, sine in reading.sines.items() if plan.moves(member := plan.members[name]) and closes(member)}


def closes(member: Member) -> bool:
    """Return whether a member closes a loop."""
    return member.closes if isinstance(member, Point) else True


def condition(sine: FloatArray) -> FloatArray:
    """Return the condition of two unit rows that meet under an angle of that sine; infinite in line."""
    with np.errstate(divide="ignore", invalid="ignore"):
        size = np.minimum(np.abs(sine), 1.0)
        worst: FloatArray = (1.0 + np.sqrt(1.0 - size * size)) / size
        return worst


def loss(cond: float, order: int = 1) -> float:
    """Return the relative error to expect of a ratio: 0.3 eps cond^2, three times that of its derivative."""
    return float(0.3 * (2 * order - 1) * np.finfo(float).eps * cond * cond)


def refused(plan: Plan, found: Mapping[str, FloatArray], shape: tuple[int, ...]) -> Mask:
    """Return the mask of the poses where ratios and forces are refused."""
    mask = np.zeros(shape, bool)
    for cond in found.values():
        mask |= cond > REFUSE
    return mask


def refusal(plan: Plan, found: Mapping[str, FloatArray], mask: Mask, strokes: Mapping[str, Any], what: str, motion: Any) -> SingularError:
    """Return the error for ratios asked at singular poses."""
    name = max((each for each in found if np.any(found[each] > REFUSE)), key=lambda each: float(np.nanmax(found[each])))
    crossing = ", where its two branches cross" if crosses(motion, name) else ""
    kind = f"{'change' if crossing else 'dead'} point{crossing}: its links are in line"
    worst = float(np.nanmax(found[name]))
    size = "infinite" if np.isinf(worst) else f"{worst:.1e}"
    return SingularError(
        f"{what} {be(what)} refused {where_words(plan, mask, strokes)}: {opening(plan, name)} stands at a {kind} "
        f"(condition {size}, refused above {REFUSE:.0e}). The positions hold; shorten the stroke, or ask with "
        f'unreachable="nan" for the other poses.',
        point=name, mask=mask, motion=motion,
    )  # fmt: skip


def be(what: str) -> str:
    """Return "is" or "are" for what opens a sentence: `The joint forces`, `The ratio of BS`."""
    return "are" if what.split(" of ")[0].endswith("s") else "is"


def crosses(motion: Any, name: str) -> bool:
    """Return whether a loop in line can be assembled on both sides of the pose, so that two branches cross there."""
    if len(motion.strokes) != 1 or motion.design_shape:
        return False
    ((stroke, values),) = motion.strokes.items()
    place = int(np.nanargmin(np.abs(np.broadcast_to(motion.loop_sines[name], motion.shape))))
    step = 1e-4 * abs(motion.plan.strokes[stroke].end - motion.plan.strokes[stroke].start)
    return bool(motion.moved({stroke: np.ravel(values)[place] + np.array([-step, step])}).reached.all())


def warn(plan: Plan, found: Mapping[str, FloatArray], strokes: Mapping[str, Any], what: str, order: int = 1) -> None:
    """Warn of poses next to a singular one, with the estimate of what is lost."""
    for name, cond in found.items():
        near = (cond > WARN) & (cond <= REFUSE)
        if np.any(near):
            worst = float(np.nanmax(np.where(near, cond, np.nan)))
            warnings.warn(
                f"{what} {where_words(plan, near, strokes)}: {called(plan, name)} is near a dead point (condition {worst:.1e}); "
                f"expect a relative error of about {loss(worst, order):.0e}.",
                SingularWarning,
                stacklevel=4,
            )
