"""Strokes as a picture shows them: which one moves, in mm or degrees."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ..errors import DefinitionError
from ..mechanism import Mechanism
from ..motion import Motion, check_any, require_motion, stroke_unit
from ..plan import Plan
from ..report import Run
from ..units import UNITS


def unit(plan: Plan, name: str) -> str:
    """Return the unit a stroke is shown in: mm, or deg where it turns something."""
    return "deg" if stroke_unit(plan, name) == "rad" else "mm"


def shown(plan: Plan, name: str, value: Any) -> Any:
    """Return stroke values [SI] in the unit they are shown in."""
    return np.asarray(value) / UNITS[unit(plan, name)][0]


def words(plan: Plan, name: str, value: float, *, fixed: bool = False) -> str:
    """Return a stroke's value as text: `S = 550 mm`, `phi = 90°`; fixed, with whole units."""
    end = "°" if unit(plan, name) == "deg" else f" {unit(plan, name)}"
    return f"{name} = {float(shown(plan, name, value)):{'.0f' if fixed else '.4g'}}{end}".replace("-", "\N{MINUS SIGN}")


def driven(motion: Motion) -> str:
    """Return the stroke that a motion runs along; DefinitionError for a grid of strokes or a batch of designs."""
    require_motion(motion)
    check_any(motion.strokes, motion.plan)
    plan = motion.plan
    if motion.design_shape or len(motion.stroke_shape) != 1:
        raise DefinitionError(
            f"{plan.title}: curves over a stroke need one design and one row of poses, this motion has the shape {motion.shape}; "
            f"sweep one stroke and give every other a value: {', '.join(plan.strokes)}."
        )
    return max(motion.strokes, key=lambda name: float(np.ptp(motion.strokes[name])))


def is_turn(machine: Mechanism, run: Run) -> bool:
    """Return whether a run goes full turns, so that a crank ends where it began."""
    turns = abs(run.end - run.start) / (2 * np.pi)
    return unit(machine.plan, run.stroke) == "deg" and round(turns) >= 1 and abs(turns - round(turns)) < 1e-9


def unreached(motion: Motion, moving: str) -> str:
    """Return which parts of a stroke a motion along it does not reach, in words; empty where it reaches all."""
    values, reached = motion.strokes[moving].ravel(), motion.reached.ravel()
    if reached.all() or not reached.any():
        return ""
    edges = np.flatnonzero(reached[1:] != reached[:-1])
    said = []
    for edge in edges.tolist():
        inside, outside = (edge, edge + 1) if reached[edge] else (edge + 1, edge)
        beyond = "beyond" if outside > inside else "before"
        said.append(f"{beyond} {words(motion.plan, moving, _last(motion, moving, values[inside], values[outside]))}")
    return "not reached " + " and ".join(said)


def _last(motion: Motion, moving: str, inside: float, outside: float) -> float:
    """Return the last value of a stroke in reach between one that is and one that is not [SI]."""
    between = np.linspace(inside, outside, 501)
    held_at = {name: np.full(between.size, np.ravel(value)[0]) for name, value in motion.strokes.items()}
    near = Motion(motion.plan, motion.designs, held_at | {moving: between}, "nan").reached
    return float(between[max(int(np.argmin(near)) - 1, 0)])


def held(plan: Plan, strokes: Mapping[str, Any], moving: str) -> str:
    """Return the other strokes' values as text; empty where there is one stroke."""
    return ", ".join(words(plan, name, float(np.ravel(value)[0])) for name, value in strokes.items() if name != moving)
