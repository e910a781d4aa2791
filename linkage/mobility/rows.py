"""The constraints of a mechanism with all its points free: their Jacobian at a pose, from the rules of the steps."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..plan import Plan, Trace
from ..program import FloatArray, Level, Node, Tangent, interpret
from ..steps import Link, Slide
from ..vectors import Vec

Places = Mapping[str, tuple[float, float]]


@dataclass(frozen=True)
class Rows:
    """Constraint rows, each of length one, by the coordinates of the points and the strokes; `owner` names their source."""

    matrix: FloatArray
    owners: tuple[str, ...]
    unknowns: tuple[str, ...]

    def without(self, owner: str) -> FloatArray:
        """Return the rows that do not come from one source."""
        return self.matrix[[each != owner for each in self.owners]]

    def of(self, owner: str) -> FloatArray:
        """Return the rows of one source."""
        return self.matrix[[each == owner for each in self.owners]]


def loose_trace(plan: Plan, points: tuple[str, ...]) -> Trace:
    """Return a trace whose points are inputs: `@B.x`, `@B.y`."""
    levels = dict.fromkeys((*plan.strokes, *plan.solved), Level.POSE) | dict.fromkeys(plan.table.entries, Level.DESIGN)
    trace = Trace(plan.members, plan.table.lengths, levels)
    for name in points:
        trace.positions[name] = Vec(trace.graph.input(f"@{name}.x", Level.POSE), trace.graph.input(f"@{name}.y", Level.POSE))
    return trace


def step_rows(plan: Plan, places: Places, inputs: Mapping[str, Any]) -> Rows:
    """Return the rows of the steps' own constraints at a pose; points that no body holds are left out."""
    trace = loose_trace(plan, tuple(plan.points))
    residuals: dict[str, tuple[Any, ...]] = {}
    for name, point in plan.points.items():
        if point.companions and point.companions[0] != name:
            continue
        trace.placing.append(name)
        residuals[name] = point.constraints(trace)
        trace.placing.pop()
    for name, slide in plan.of_kind(Slide).items():
        trace.placing.append(name)
        residuals[name] = (slide.miss(trace),)
        trace.placing.pop()
    nodes = [(owner, trace.graph.node(each)) for owner, found in residuals.items() for each in found]
    held = held_points(plan, {owner for owner, _ in nodes if owner in plan.points})
    seeds: dict[str, Node] = {f"{name}.{axis}": getattr(trace.positions[name], axis) for name in held for axis in "xy"}
    seeds |= {name: trace.inputs[name] for name in plan.strokes}
    tangents = [Tangent(trace.graph, {seed: 1.0}) for seed in seeds.values()]
    entries = [tangent.of(node) for _, node in nodes for tangent in tangents]
    at = dict(inputs) | {f"@{name}.{axis}": places[name][k] for name in plan.points for k, axis in enumerate("xy")}
    matrix = np.array([float(value) for value in interpret(entries, at)]).reshape(len(nodes), len(seeds))
    return Rows(unit(matrix), tuple(owner for owner, _ in nodes), tuple(seeds))


def held_points(plan: Plan, constrained: set[str]) -> tuple[str, ...]:
    """Return the moving points that a body or a constraint holds; others are free constructions."""
    held = constrained | {point for body in plan.links for point in body.points}
    held |= {pin for group in plan.groups.values() for pin in group.pins}
    return tuple(name for name in plan.moving if name in held)


def link_rows(plan: Plan, places: Places, unknowns: tuple[str, ...]) -> Rows:
    """Return the rows of declared links at a pose: one length, and two for every further point, rigid with the first two."""
    found: list[FloatArray] = []
    owners: list[str] = []
    for name, link in plan.of_kind(Link).items():
        if len(link.point_names) == 2 and plan.is_cylinder(link):
            continue
        for row in rigid_rows(link.point_names, places, unknowns):
            found.append(row)
            owners.append(name)
    return Rows(unit(np.array(found).reshape(len(found), len(unknowns))), tuple(owners), unknowns)


def rigid_rows(points: tuple[str, ...], places: Places, unknowns: tuple[str, ...]) -> list[FloatArray]:
    """Return the first-order conditions that some points move as one body."""
    complex_at = {point: complex(*places[point]) for point in points}
    P = points[0]
    Q = max(points[1:], key=lambda point: abs(complex_at[point] - complex_at[P]))
    base = complex_at[Q] - complex_at[P]
    direction = base / abs(base)
    rows = [row({Q: direction, P: -direction}, unknowns)]
    for X in points[1:]:
        if X != Q:
            turn = (complex_at[X] - complex_at[P]) / base
            # dX - dP - turn (dQ - dP) = 0, its real and its imaginary part
            rows.append(row({X: 1, P: turn.conjugate() - 1, Q: -turn.conjugate()}, unknowns))
            rows.append(row({X: 1j, P: 1j * (turn.conjugate() - 1), Q: -1j * turn.conjugate()}, unknowns))
    return rows


def row(terms: Mapping[str, complex], unknowns: tuple[str, ...]) -> FloatArray:
    """Return a row from its part for each point: the scalar product with (x, y) written as a complex number."""
    found = np.zeros(len(unknowns))
    for point, part in terms.items():
        if f"{point}.x" in unknowns:
            found[unknowns.index(f"{point}.x")] += complex(part).real
            found[unknowns.index(f"{point}.y")] += complex(part).imag
    return found


def unit(matrix: FloatArray) -> FloatArray:
    """Return the rows scaled to length one; rows of zeros stay."""
    size = np.linalg.norm(matrix, axis=1, keepdims=True)
    return np.asarray(matrix / np.where(size > 0.0, size, 1.0))
