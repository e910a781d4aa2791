"""Velocities and accelerations of points at rates of strokes: of all points in one pass, by one derivative by time, taken twice."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ..plan import Plan, rate_name
from ..program import FloatArray, Kernel, Node
from .dead_points import NOWHERE
from .grid import MotionLike
from .strokes import rates_of


def point_by_time(
    motion: MotionLike, point: str, order: int, rates: Mapping[str, object], accelerations: Mapping[str, object]
) -> FloatArray:
    """Return the velocity of a point that moves, of `order` 2 its acceleration, shape (2, ...).

    Those of all points are kept for the latest rates: several loads ask at the same ones.
    """
    plan, what, gaps = motion.plan, "acceleration" if order > 1 else "velocity", motion.unreachable == "nan"
    given = (*rates, *rates.values(), None, *accelerations, *accelerations.values())
    known = motion._kept.get(what)
    if known is None or len(known[0]) != len(given) or not all(map(stays, known[0], given)):
        kernel, inputs = plan.made(("by time", order), lambda twin: Kernel(points_by_time(twin, order))), dict(motion._grid.flat)
        for place, (word, of_strokes) in enumerate((("rates", rates), ("accelerations", accelerations)), 1):
            checked = rates_of(word, of_strokes, motion, gaps=gaps)
            for name in plan.strokes:  # zero where none are given
                full = np.broadcast_to(checked.get(name, np.zeros(())), motion.shape)
                inputs[rate_name(name, place)] = full.reshape(motion._grid.size) if motion._design_shape else full.reshape(-1)
        known = motion._kept[what] = given, motion._grid.full(kernel(inputs, size=motion._grid.size).values)
    index = 2 * plan.moving.index(point)
    found = known[1][index : index + 2]
    found = found if motion.reached.all() else np.where(motion.reached, found, np.nan)
    return motion._finite(found, NOWHERE, f"The {what} of {point}")


def stays(known: object, given: object) -> bool:
    """Return whether an argument is the known object and cannot have changed: a number, a name, an array that is read-only."""
    fixed = not given.flags.writeable if isinstance(given, np.ndarray) else given is None or isinstance(given, str | float | int)
    return known is given and fixed


def points_by_time(plan: Plan, order: int) -> list[Node]:
    """Return the nodes of the velocities of all points that move, of `order` 2 of their accelerations."""
    trace, nodes = plan.trace, [node for name in plan.moving for node in plan.nodes(name)]
    rates, accelerations = ({name: trace.rate_input(name, place) for name in plan.strokes} for place in (1, 2))
    tangent = trace.by_time(rates, accelerations if order > 1 else {})
    for _ in range(order):
        nodes = list(map(tangent.derivative, nodes))
    return nodes
