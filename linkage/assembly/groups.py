"""The solution of a plan's groups for designs and strokes: from the sketch, along the stroke, on one branch."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..errors import AssemblyError
from ..plan import Plan, strokes_text
from ..program import FloatArray
from ..steps import Pin
from ..units import mm
from .newton import Mask, Newton
from .path import Path, follow, interpolated

SAMPLED = 1024
NEARBY = 0.05
BLOCK = 4096


@dataclass(frozen=True)
class Solved:
    """The inputs a group's solution supplies, shape (designs, poses), and where branches cross on the way."""

    inputs: Mapping[str, FloatArray]
    crossed: Mask
    stops: tuple[float, ...] = ()
    """Where the paths of a single design ended before the last value asked for, along its one stroke."""


def solve_groups(plan: Plan, designs: Mapping[str, Any], strokes: Mapping[str, FloatArray]) -> Solved:
    """Return the pins of all groups for designs (float or (m,)) and strokes (n,); NaN where they cannot be reached."""
    newton = Newton(plan)
    base = at_sketch(plan, newton)
    start = _designed(plan, newton, designs, base)
    sketch = plan.sketch_strokes
    if len(strokes) == 1:
        ((name, values),) = strokes.items()
        u, crossed, stops = _along_one(newton, designs, start, name, sketch[name], values)
    else:
        u, crossed = _along_many(newton, designs, start, sketch, strokes)
        stops = ()
    sine = sines(newton, designs, strokes, u)
    inputs = dict(zip(newton.names, u, strict=True)) | {group.inputs[-1]: sine for group in plan.groups.values()}
    return Solved(inputs, crossed, stops)


def at_sketch(plan: Plan, newton: Newton) -> FloatArray:
    """Return the pins at the sketch, default dimensions, shape (coordinates, 1, 1); AssemblyError where the sketch is out of reach."""
    inputs = plan.defaults | plan.sketch_strokes
    pins = [plan.of_kind(Pin)[pin] for group in plan.groups.values() for pin in group.pins]
    rough = np.array([part for pin in pins for part in pin.sketched]).reshape(-1, 1, 1)
    found, done, missing = newton.start(inputs, rough)
    if not done:
        names = " ".join(pin.name for pin in pins)
        strokes = strokes_text(plan, plan.sketch_strokes)
        gap = f"{missing / mm:.3g} mm are missing" if np.isfinite(missing) else "their equations have no value"
        raise AssemblyError(
            f"{plan.title}: the pins {names} cannot be assembled from their sketch at {strokes}: {gap} in the "
            "nearest pose. Move their near=(x, y) closer to the real pose, or change a length.",
            point=pins[0].name, mask=np.ones((), bool), shortfall=missing,
        )  # fmt: skip
    return found


def _designed(plan: Plan, newton: Newton, designs: Mapping[str, Any], base: FloatArray) -> FloatArray:
    """Return the pins at the sketch for all designs, continued from the default one, shape (coordinates, m, 1)."""
    changed = {name: np.asarray(value, float) for name, value in designs.items() if np.ndim(value) or value != plan.defaults[name]}
    m = max((value.size for value in changed.values() if value.ndim), default=1)
    start = np.repeat(base, m, axis=1)
    if not changed:
        return start

    def inputs(place: float) -> dict[str, Any]:
        moved = {name: plan.defaults[name] + place * (value - plan.defaults[name]) for name, value in changed.items()}
        return plan.defaults | plan.sketch_strokes | {name: value if value.ndim else float(value) for name, value in moved.items()}

    path = follow(newton, inputs, start)
    return np.where(path.ended == 1.0, path.solutions[-1], np.nan)


def _along_many(
    newton: Newton, designs: Mapping[str, Any], start: FloatArray, sketch: Mapping[str, float], strokes: Mapping[str, FloatArray]
) -> tuple[FloatArray, Mask]:
    """Return the pins at poses of several strokes: each along its own straight line from the sketch."""
    n = max((np.size(value) for value in strokes.values()), default=1)

    def inputs(place: float) -> dict[str, Any]:
        return {**designs, **{name: sketch[name] + place * (value - sketch[name]) for name, value in strokes.items()}}

    path = follow(newton, inputs, np.repeat(start, n, axis=2))
    return np.where(path.ended == 1.0, path.solutions[-1], np.nan), path.crossed


def sines(newton: Newton, designs: Mapping[str, Any], strokes: Mapping[str, FloatArray], u: FloatArray) -> FloatArray:
    """Return how near every pose is to a singular one, shape (designs, poses).

    Of many poses along one stroke a sample is worked out and the rest read between its values, except near a singular pose.
    """
    n = u.shape[2]
    if n <= SAMPLED or len(strokes) != 1:
        return newton.sine({**designs, **strokes}, u)
    ((name, values),) = strokes.items()
    order = np.argsort(values, kind="stable")
    sample = order[np.unique(np.linspace(0, n - 1, SAMPLED).astype(int))]
    known = newton.sine({**designs, name: values[sample]}, u[:, :, sample])
    found = np.array([np.interp(values, values[sample], row) for row in known])
    close = ~(found > NEARBY).all(axis=0)
    if close.any():
        found[:, close] = newton.sine({**designs, name: values[close]}, u[:, :, close])
    return np.where(np.isfinite(u).all(axis=0), found, np.nan)


@dataclass(frozen=True)
class Leg:
    """One way along a stroke from the sketch: place 0 there, 1 at the last value asked for."""

    name: str
    sketch: float
    end: float

    def value(self, place: Any) -> Any:
        """Return the stroke at a place."""
        return self.sketch + place * (self.end - self.sketch)

    def place(self, value: FloatArray) -> FloatArray:
        """Return the places of stroke values."""
        return (value - self.sketch) / (self.end - self.sketch) if self.end != self.sketch else np.zeros_like(value)


def _along_one(
    newton: Newton, designs: Mapping[str, Any], start: FloatArray, name: str, sketch: float, values: FloatArray
) -> tuple[FloatArray, Mask, tuple[float, ...]]:
    """Return the pins over one stroke: a path each way, then all poses at once from guesses between its places."""
    u = np.full((len(start), start.shape[1], len(values)), np.nan)
    crossed = np.zeros(u.shape[1:], bool)
    stops: tuple[float, ...] = ()
    for side, last in ((values >= sketch, np.max), (values < sketch, np.min)):
        if side.any():
            leg = Leg(name, sketch, float(last(values[side])))
            path = follow(newton, lambda place, leg=leg: {**designs, name: leg.value(place)}, start)  # type: ignore[misc]
            parts = [_filled(newton, designs, leg, part, path) for part in np.array_split(values[side], -(-int(side.sum()) // BLOCK))]
            u[:, :, side] = np.concatenate(parts, axis=2)
            stops += tuple(float(leg.value(place)) for place in path.ended[:, 0] if place < 1.0)
            crossed[:, side] = path.crossed & (leg.place(values[side])[None, :] > path.ended)
    return u, crossed, stops


def _filled(newton: Newton, designs: Mapping[str, Any], leg: Leg, values: FloatArray, path: Path) -> FloatArray:
    """Return the pins between the places of a path; a pose whose guess was too rough is followed on its own."""
    at = leg.place(values)
    guess, spread = interpolated(path, at)
    within = at[None, :] <= path.ended
    found, done = newton.correct({**designs, leg.name: values}, np.where(within, guess, np.nan))
    with np.errstate(all="ignore"):
        close = done & (np.abs(found - guess).max(axis=0) <= 0.1 * spread + 1e-9)
    found = np.where(close & within, found, np.nan)
    for column in np.nonzero((within & ~close).any(axis=0))[0]:
        left = int(np.clip(np.searchsorted(path.places, at[column]) - 1, 0, len(path.places) - 1))
        step = Leg(leg.name, float(leg.value(path.places[left])), float(values[column]))
        retry = follow(newton, lambda place, step=step: {**designs, leg.name: step.value(place)}, path.solutions[left])  # type: ignore[misc]
        found[:, :, column] = np.where(within[:, column] & (retry.ended[:, 0] == 1.0), retry.solutions[-1][..., 0], np.nan)
    return found
