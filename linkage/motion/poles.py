"""Velocities of points and bodies: poles, and velocities and accelerations of all points in one pass, by one derivative by time."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TypeAlias

import numpy as np

from ..errors import DefinitionError, unknown
from ..plan import Plan, rate_name
from ..program import FloatArray, Kernel, Node
from ..steps import Link
from .dead_points import NOWHERE
from .grid import MotionLike
from .strokes import rates_of

ENDLESS = 1e9
"""A pole further away than so many lengths of its body is at infinity: its distance is rounding."""
STILL = 1e-12
"""A body whose points are slower than this part of the machine's fastest stands still."""

OfPoint = Callable[[str], FloatArray]


BodyRates: TypeAlias = tuple[FloatArray, FloatArray, FloatArray, FloatArray]
"""How a body moves: a point of it and its velocity, shape (2, ...), its angular velocity and its length, shape (...)."""


def whole_body(plan: Plan, body: object) -> tuple[str, ...]:
    """Return all points of a body by its name, its link's, or two or more of its points (`E D`); none for the frame.

    Raises DefinitionError, with the bodies there are, for any other; a driven length changes and is none.
    """
    name = str(getattr(body, "name", body))
    fixed, *moving = plan.bodies or (None,)
    links = {each: link.point_names for each, link in plan.of_kind(Link).items()}
    given = links.get(name, tuple(name.split()))
    for each in moving:
        if name == each.name or (len(set(given)) > 1 and set(given) <= set(each.points)):
            return each.points
    if name == "frame" or (len(set(given)) > 1 and fixed is not None and set(given) <= set(fixed.points)):
        return ()
    known = ["frame", *(each.name for each in moving), *(each for each in links if len(links[each]) > 1)]
    raise unknown("Body", name, dict.fromkeys(known), where=plan.title)


def body_rates(points: tuple[str, ...], place: OfPoint, rate: OfPoint, shape: tuple[int, ...]) -> BodyRates:
    """Return how a body moves, by its two points that are furthest apart; the frame, without points, stands still."""
    if not points:
        return np.zeros((2, *shape)), np.zeros((2, *shape)), np.zeros(shape), np.zeros(shape)
    pairs = [(P, Q) for place_of, P in enumerate(points) for Q in points[place_of + 1 :]]
    P, Q = max(pairs, key=lambda pair: float(np.nanmax(np.hypot(*(place(pair[1]) - place(pair[0]))), initial=0.0)))
    arm, turning = place(Q) - place(P), rate(Q) - rate(P)
    square = arm[0] ** 2 + arm[1] ** 2
    if not np.all((square > 0.0) | np.isnan(square)):
        raise DefinitionError(f"the points {P} and {Q} of a body coincide and do not tell how it turns; name two others.")
    return place(P), rate(P), (arm[0] * turning[1] - arm[1] * turning[0]) / square, np.sqrt(square)


@np.errstate(all="ignore")
def pole_of(body: BodyRates, other: BodyRates, fastest: FloatArray) -> FloatArray:
    """Return the point at which two bodies have one velocity, shape (2, ...) [m].

    Infinite where the one only translates against the other, NaN where it stands still against it: each of its points is a pole then.
    Source: Artobolevsky, Theory of Mechanisms and Machines, instant centres of velocities.
    """
    X = body[0] if np.any(body[3]) else other[0]
    speed, against = (p + spin * np.stack([P[1] - X[1], X[0] - P[0]]) for P, p, spin, _ in (body, other))
    speed, spin, length = speed - against, body[2] - other[2], np.maximum(body[3], other[3])
    found = X + np.stack([-speed[1], speed[0]]) / spin
    size = np.hypot(speed[0], speed[1])
    found = np.where(np.abs(spin) * length * ENDLESS <= size, np.inf, found)
    still = np.maximum(size, np.abs(spin) * length) <= STILL * fastest
    return np.asarray(np.where(still, np.nan, found))


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
