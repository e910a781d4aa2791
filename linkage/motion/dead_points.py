"""Conditioning: how near a pose is to a singular one, the digits left in a result, and the words of errors and warnings.

Where two links that close a loop come into line, a velocity ratio is off by about 0.1-0.3 eps cond^2, with cond the condition of the
scaled constraint Jacobian: (1 + cos) / sin of the angle between the links. Where the loop's other side is longer than its links the
squares cancel more: cond^2 then grows by the reading's `rounding`. A direction between points that come close loses as much, and
what goes through several such places loses by their product. The kernel watches the product of all these parts; where it is small,
the request's own program tells what rounding leaves of it (`Scatter`).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import reduce
from typing import Any

import numpy as np

from ..errors import SingularError, SingularWarning, warn
from ..frozen import immutable, read_only
from ..plan import ArrayReading, Mask, Plan, name_or_pins, opening
from ..program import FloatArray, Iterated
from ..steps import Point
from ..vectors import Numbers
from .grid import MotionLike
from .limits import where_words

WARN = 1e4
REFUSE = 1e6
DOUBTFUL, LOST = 1e-7, 1e-3
"""The relative errors above which a result is warned of and refused, where they do not come from the condition of one loop."""
ROUGH = 1e-6
"""The error of a place, compared with the machine's size, above which it is warned of: at a dead point half the digits are left."""
PLACES = 1e-13
"""The product of squared parts (Trace.nearness) above which positions keep nine digits."""
FAR = 100.0
"""The condition below which no loop and no direction is to blame for digits that are lost."""
LEAST = 1e-3
"""Of a result's natural size: a value that is smaller counts as so large where its relative error is told."""
NOWHERE: Mask = read_only(np.zeros((), bool))
"""The mask of no pose, whatever the shape of the poses."""


def iterated(plan: Plan) -> tuple[Iterated, ...]:
    """Return the unknowns of a plan's groups, in the order of construction."""
    return tuple(map(Iterated.from_closure, [plan.trace.at(group.pins[0]).x.closure for group in plan.groups.values()]))


@immutable
class PrecisionLeft:
    """Values of a program, how far rounding scatters them, shape (rows, n), and the machine's size [m], shape (n,)."""

    values: FloatArray
    errors: FloatArray
    size: FloatArray

    def some_rows(self, rows: slice) -> PrecisionLeft:
        """Return those of some rows."""
        return PrecisionLeft(self.values[rows], self.errors[rows], self.size)

    def relative(self, scale: Numbers) -> FloatArray:
        """Return the largest error of a component, shape (n,), each relative to its own value or to a size that is larger.

        Infinite where one has no value. `scale` is one size for all, or one a component, shape (rows, n).
        """
        with np.errstate(all="ignore"):
            found = np.max(self.errors / np.maximum(np.abs(self.values), scale), axis=0)
        return np.where(np.isnan(found), np.inf, found)

    @property
    def norm(self) -> PrecisionLeft:
        """The length of the vector whose components are the rows, as one row."""
        return PrecisionLeft(np.hypot.reduce(self.values, axis=0)[None], np.hypot.reduce(self.errors, axis=0)[None], self.size)


@immutable
class Conditioning:
    """How far poses (n,) are from singular ones for a result.

    The conditions of the loops and the least spans of the directions it is built from, by member; the relative error to expect; and the
    members that it is differentiated through.
    """

    plan: Plan
    conditions: Mapping[str, FloatArray]
    spans: Mapping[str, FloatArray]
    error: FloatArray
    steep: frozenset[str] = frozenset()
    doubt: float = DOUBTFUL

    @property
    def refused(self) -> Mask:
        """The poses where the result is refused."""
        steep = [~(cond <= REFUSE) for name, cond in self.conditions.items() if name in self.steep]
        return np.asarray(reduce(np.logical_or, steep, ~(self.error <= LOST)))

    @property
    def doubtful(self) -> Mask:
        """The poses where the result holds, with an error that is reported."""
        steep = [cond > WARN for name, cond in self.conditions.items() if name in self.steep]
        return np.asarray(reduce(np.logical_or, steep, self.error > self.doubt) & ~self.refused)

    def masked(self, mask: Mask) -> Conditioning:
        """Return the same of some poses."""
        conditions, spans = (
            {name: np.broadcast_to(each, mask.shape)[mask] for name, each in given.items()} for given in (self.conditions, self.spans)
        )
        return replace(self, conditions=conditions, spans=spans, error=self.error[mask])

    def culprit(self) -> tuple[str, str, bool]:
        """Return the member nearest to a singular pose, its condition in words, and whether its loop is in line.

        Else it is by the least span of a direction that it takes, in parts of the machine's size. No name where what has none takes the
        direction, and no words where nothing comes near.
        """
        near = {name: float(np.max(np.where(np.isnan(cond), np.inf, cond), initial=0.0)) for name, cond in self.conditions.items()}
        close = {name: 1.0 / max(float(np.min(span, initial=np.inf)), 1e-300) for name, span in self.spans.items()}
        if max([*near.values(), *close.values()], default=0.0) < FAR:
            return "", "", False
        loop = max(near, key=near.__getitem__, default="")
        direction = max(close, key=close.__getitem__, default="")
        if near.get(loop, 0.0) >= close.get(direction, 0.0):
            return loop, "condition infinite" if np.isinf(near[loop]) else f"condition {near[loop]:.1e}", True
        span = 1.0 / close[direction]
        apart = f"are {span:.1e} of the machine's size apart" if span > 1e-299 else "coincide"
        return direction, f"takes a direction between points that {apart}", False


def loop_conditions(plan: Plan, reading: ArrayReading, names: set[str]) -> dict[str, FloatArray]:
    """Return the condition of every loop among some members, at every pose of a reading."""
    return {
        name: condition_of_sine(np.asarray(sine, float)) * np.sqrt(np.maximum(reading.rounding.get(name, 1.0), 1.0))
        for name, sine in loops(plan, reading).items()
        if name in names
    }


def loops(plan: Plan, reading: ArrayReading) -> dict[str, Any]:
    """Return the sines of the loops that move; a triangle rigid in itself is none."""
    moving = {name: plan.members[name] for name in reading.sines if name in moving_members(plan)}
    return {name: reading.sines[name] for name, member in moving.items() if not isinstance(member, Point) or member.closes}


def moving_members(plan: Plan) -> frozenset[str]:
    """Return the members of a plan that follow a stroke, by name, found once."""
    return plan.made(("moving members",), lambda _: frozenset(name for name, member in plan.members.items() if plan.moves(member)))


def condition_of_sine(sine: FloatArray) -> FloatArray:
    """Return the condition of two unit rows that meet under an angle of that sine; infinite in line."""
    with np.errstate(divide="ignore", invalid="ignore"):
        size = np.minimum(np.abs(sine), 1.0)
        worst: FloatArray = (1.0 + np.sqrt(1.0 - size * size)) / size
        return worst


def singular_error(found: Conditioning, mask: Mask, strokes: Mapping[str, object], what: str, motion: MotionLike) -> SingularError:
    """Return the error for a result asked at singular poses; `found` is of these alone, `mask` in the motion's shape."""
    plan = found.plan
    name, near, in_line = found.culprit()
    if in_line:
        crossing = ""
        if len(motion.strokes) == 1 and not motion._design_shape and name in motion._loop_sines:
            ((stroke, values),) = motion.strokes.items()
            place = int(np.argmin(np.nan_to_num(np.abs(np.broadcast_to(motion._loop_sines[name], motion.shape)))))
            step = 1e-4 * abs(motion.plan.strokes[stroke].end - motion.plan.strokes[stroke].start)
            if motion.moved({stroke: np.ravel(values)[place] + np.array([-step, step])}).reached.all():  # assembled on both sides
                crossing = ", where its two branches cross"
        where = f"{'change' if crossing else 'dead'} point{crossing}"
        why = f"{opening(plan, name)} stands at a {where}: its links are in line ({near}, refused above {REFUSE:.0e})"
    else:
        why = f"{opening(plan, name) if name else 'it'} {near}"
        if not near:
            why = "its parts nearly cancel, as far from the origin or where several loops lose digits"
        most = float(np.max(found.error))
        why += f", and rounding leaves {f'an error of about {most:.0e}' if most < 1.0 else 'nothing'} of it"
    refused = f"{what} {is_or_are(what)} refused {where_words(plan, mask, strokes)}: {why}"
    remedy = 'The positions hold; shorten the stroke, or ask with unreachable="nan" for the other poses.'
    return SingularError(f"{refused}. {remedy}", point=name, mask=mask, motion=motion)


def lost_places(found: Conditioning, mask: Mask, strokes: Mapping[str, object]) -> SingularError:
    """Return the error for poses of which rounding leaves nothing; `found` is of these alone, `mask` in the motion's shape."""
    plan = found.plan
    name, near, in_line = found.culprit()
    why = f"has its links in line ({near})" if in_line else near
    where = f"stands at a change point {where_words(plan, mask, strokes)}: {opening(plan, name) if name else 'it'}"
    remedy = 'Stop before it, move a point, or ask with unreachable="nan" for the other poses.'
    lost = "so that its place is not settled by its geometry and lost in rounding"
    return SingularError(f"{plan.title} {where} {why}, {lost}. {remedy}", point=name, mask=mask)


def is_or_are(what: str) -> str:
    """Return "is" or "are" for the subject of a sentence: `The joint forces`, `The ratio of BS`."""
    return "are" if what.split(" of ")[0].endswith("s") else "is"


def warn_near(found: Conditioning, what: str, be: str = "is") -> None:
    """Warn of poses next to a singular one, with the estimate of the lost precision; `found` is of these alone."""
    plan, (name, near, in_line), estimate = found.plan, found.culprit(), float(np.max(found.error))
    how = f"{be} near a dead point ({near})" if in_line else near
    who = f"{name_or_pins(plan, name) if name else 'it'} {how}" if how else ""
    text = f"{what}: {who or 'its parts nearly cancel'}; expect a relative error of about {estimate:.0e}."
    warn(SingularWarning(text, estimate=estimate))
