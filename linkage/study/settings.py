"""The setting that gives a wanted value: all roots in a range, or why there is none; several settings are in `targets`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, final, overload

import numpy as np

from ..checks import require
from ..errors import DefinitionError, cited, known_name
from ..language import said
from ..mechanism import Mechanism
from ..motion import Target, last_holding
from ..motion.grid import recalled
from ..motion.measures import words_of
from ..motion.places import is_one
from ..motion.requests import identity_of
from ..numeric.line import Curve, highest_between, sign_changes
from ..plan import Mask, require_kind
from ..program import FloatArray
from ..units import show, unit_or_none
from .box import range_of
from .checks import check_one_design, unit_of, why_not_assembled
from .measured import QuantityLike, StudyPoses, quantity_values
from .poles import FAR, TINY
from .targets import Solutions, solutions_for

SAMPLES = 1025
TOUCH, USUAL, POLES = 1e-9, (5.0, 95.0), 10.0
"""Of the values' span: what comes so near to the target touches it. Beside a pole values are as large as numbers go: the span is at most so
many times that of the usual ones [%]."""


@final
@dataclass(frozen=True, eq=False)
class Settings:
    """All values [SI] of a dimension that give the target, ascending; `sentence` says so, or why there is none."""

    name: str
    values: tuple[float, ...]
    sentence: str

    def __str__(self) -> str:
        return self.sentence


@overload
def settings_for(
    machine: Mechanism,
    name: str,
    quantity: QuantityLike,
    target: float = ...,
    *,
    between: tuple[float, float],
    unit: str = ...,
    **strokes: float,
) -> Settings: ...
@overload
def settings_for(
    machine: Mechanism, name: Mapping[str, object], quantity: Sequence[Target], /, *, points: int | None = ...
) -> Solutions: ...
def settings_for(
    machine: Mechanism,
    name: str | Mapping[str, Any],
    quantity: Any,
    target: float = 0.0,
    *,
    between: tuple[float, float] | None = None,
    unit: str = "",
    points: Any = None,
    **strokes: float,
) -> Settings | Solutions:
    """Return every value of a dimension in a range at which a quantity has a target value [SI], at one pose of one design.

    `settings_for(hitch, "MK", "tilt", 0.0, between=(0.5, 1.3), S=0.1)`. Roots are found to rounding; two that lie closer than a
    thousandth of the range may be missed. Settings that cannot be assembled over the whole stroke are no answer. `unit` is the
    quantity's in the sentence.

    Several dimensions and targets: `settings_for(hitch, {"MK": (0.5, 1.3), "M": [(0.22, 1.05), (0.22, 0.95)]}, targets)` takes a list of
    targets such as `Target("tilt", 0.0, S=0.1)`. It returns all `Solutions` in the box that are found from `points` of it, for every
    choice. Without one it returns the nearest setting, with what is missing of each target. There are at least as many targets as ranges,
    DefinitionError for fewer. Ranges may be any number: the search goes on from the best of at most 16,384 points, by exact derivatives.
    For a path, a function or poses of a body `synthesise` is quicker, and finds their strokes too.
    """
    if isinstance(name, Mapping):
        single = [*(["between"] if between is not None else []), *(["unit"] if unit else []), *strokes]
        if single or target:
            given = ", ".join(f"{each}=..." for each in single) or f"target={cited(target)}"
            remedy = "of several settings every target says it itself, Target(quantity, value, S=0.1)"
            raise DefinitionError(f"settings_for(..., {given}): {remedy}.")
        return solutions_for(machine, name, quantity, points)
    require(points is None, "settings_for(..., points", points, "points are those of a box of several settings; leave it out")
    check_one_design(machine)
    known_name("Dimension", name, machine.plan.table.spellings, where=machine.plan.title)
    unit_or_none(unit, where="settings_for(unit=...)")
    low, high = range_of("between", between)
    if set(strokes) != set(machine.strokes):
        raise DefinitionError(f"{machine.plan.title}: say the pose, {', '.join(f'{each}=...' for each in machine.strokes)}.")
    if not is_one(target) or not all(map(is_one, strokes.values())):
        given = ", ".join(f"{each}={cited(value)}" for each, value in {"target": target, **strokes}.items())
        raise DefinitionError(f"{machine.plan.title}: {given}: one number is expected for each, in SI.")
    require_kind(machine.plan, name, between, f"{machine.plan.title}: between")
    Target(quantity, target).check(machine.plan)

    pose = StudyPoses(machine.at(unreachable="nan", **{each: [value] for each, value in strokes.items()}))

    def curve(at: FloatArray) -> FloatArray:
        return quantity_values(pose.of_each(machine.replaced(**{name: at}), np.zeros(at.shape, int)), quantity) - target if at.size else at

    identity = None if callable(quantity) else identity_of(machine.plan, quantity)
    known = ("settings", name, identity, target, low, high)
    at, off, unique = roots_of(curve, low, high) if identity is None else recalled(pose.base, known, lambda: roots_of(curve, low, high))
    lost = {root: why for root in unique if (why := why_not_assembled(machine.replaced(**{name: root})))}
    kept = [root for root in unique if root not in lost]
    words = SettingWords(name, unit_of(machine.plan, name), words_of(quantity), unit)
    if unique and not kept:
        return Settings(name, (), words.not_assembled(unique, target, lost[unique[0]]))
    return Settings(name, tuple(kept), words.roots(kept, target) if kept else words.none(at, off + target, target))


def roots_of(curve: Curve, low: float, high: float) -> tuple[FloatArray, FloatArray, list[float]]:
    """Return the samples of a curve between two values, what it is there, and where it is zero."""
    at = ends_of_reach(curve, np.linspace(low, high, SAMPLES))
    off = curve(at)
    found = np.sort(np.concatenate([at[off == 0.0], zeros_passed(curve, at, off), zeros_touched(curve, at, off)]))
    found = found[np.isfinite(found)]
    known = off[np.isfinite(off)]
    span, most = (float(np.ptp(each)) for each in (known, np.percentile(known, USUAL))) if known.size else (0.0, 0.0)
    span = min(span, POLES * most) or span
    found = found[np.abs(curve(found)) <= max(TOUCH * span, 1e-13)]  # where it does not jump over zero
    return at, off, found[np.diff(found, prepend=-np.inf) > 1e-9 * (high - low)].tolist()


def ends_of_reach(curve: Curve, at: FloatArray) -> FloatArray:
    """Return the samples with the ends of every reachable range added."""
    known = np.isfinite(curve(at))
    edges = np.flatnonzero(known[1:] != known[:-1])
    if not edges.size:
        return at

    def reached(places: FloatArray) -> Mask:
        return np.asarray(np.isfinite(curve(places.ravel())).reshape(places.shape))

    inside, outside = (at[np.where(known[edges] == is_inside, edges, edges + 1)] for is_inside in (True, False))
    return np.sort(np.concatenate([at, last_holding(reached, inside, outside)[0]]))


def zeros_passed(curve: Curve, at: FloatArray, off: FloatArray) -> FloatArray:
    """Return where the curve goes through zero between samples; NaN where it has a gap before it."""
    with np.errstate(invalid="ignore"):
        places = np.flatnonzero((np.sign(off[1:]) * np.sign(off[:-1])) < 0.0)
    near = np.array(sign_changes(curve, at[places], at[places + 1]))
    beside = np.abs(curve(near.ravel())).reshape(near.shape)
    return np.where(np.isfinite(beside).all(axis=0), np.where(beside[1] < beside[0], near[1], near[0]), np.nan)


def zeros_touched(curve: Curve, at: FloatArray, off: FloatArray) -> FloatArray:
    """Return where the curve comes nearest to zero without going through it, at least between its neighbours."""
    size = np.abs(off)
    with np.errstate(invalid="ignore"):
        dips = (size[1:-1] <= size[:-2]) & (size[1:-1] <= size[2:]) & (np.sign(off[2:]) == np.sign(off[:-2]))
        dips &= (size[1:-1] < size[:-2]) | (size[1:-1] < size[2:])  # along a level stretch it comes no nearer
    places = np.flatnonzero(dips)
    return highest_between(lambda places: -np.abs(curve(places)), at[places], at[places + 2])


@final
@dataclass(frozen=True)
class SettingWords:
    """How a dimension and a quantity stand in a sentence: names and units, "" for plain SI."""

    name: str
    unit: str
    what: str
    shown_in: str

    def roots(self, roots: Sequence[float], target: float) -> str:
        """Return the settings that give the target."""
        found, wanted = said(" or ").join(show(root, self.unit) for root in roots), show(target, self.shown_in)
        return said("{what} = {target} with {name} = {found}.", what=self.what, target=wanted, name=self.name, found=found)

    def not_assembled(self, roots: Sequence[float], target: float, why: str) -> str:
        """Return that the settings that give the target are no machines over the whole stroke, and why."""
        found, wanted = said(" or ").join(show(root, self.unit) for root in roots), show(target, self.shown_in)
        return said(
            "{what} = {target} with {name} = {found}, which cannot be assembled over the whole stroke: {why}",
            what=self.what, target=wanted, name=self.name, found=found, why=why,
        )  # fmt: skip

    def none(self, at: FloatArray, value: FloatArray, target: float) -> str:
        """Return why no setting gives the target."""
        known = np.isfinite(value)
        names = {"name": self.name, "low": show(at[0], self.unit), "high": show(at[-1], self.unit), "what": self.what}
        if not known.any():
            return said(
                "No {name} between {low} and {high} can be assembled there, so that {what} has no value. "
                "Look farther, or change the stroke.",
                **names,
            )
        ends, size = [float(value[known].min()), float(value[known].max())], np.where(known, np.abs(value), 0.0)
        top = int(np.argmax(size))
        if size[top] >= FAR * max(float(np.median(size[known])), TINY):  # a pole, with the signs that it has on either side
            beside = value[max(top - 1, 0) : top + 2]
            ends = [end if not np.any(beside * sign > 0.0) else sign * np.inf for end, sign in zip(ends, (-1.0, 1.0), strict=True)]
        least, most = (show(end, self.shown_in) for end in ends)
        first, last = (show(float(end), self.unit) for end in (at[known].min(), at[known].max()))
        return said(
            "No {name} between {low} and {high} gives {what} = {target}: it can be assembled from {first} to {last}, "
            "where {what} goes from {least} to {most}.",
            target=show(target, self.shown_in), first=first, last=last, least=least, most=most, **names,
        )  # fmt: skip
