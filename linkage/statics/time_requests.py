"""Requests for a running machine: the speed of its points, and the part of inertia in a force.

Rates and accelerations of the strokes are those of a motion in time, or stand beside the strokes in `evaluate` and `function`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import cast

import numpy as np

from ..errors import DefinitionError, ensure
from ..language import said
from ..loads import Acting, ForceElement, LinkMass, Weight
from ..motion import Judge, Request, require_motion
from ..motion.requests import Combined, situated
from ..motion.strokes import checked_name
from ..plan import Plan
from ..program import FloatArray
from ..quantities import Reference, as_mapping, name_of
from ..verdict import Remark
from .applied import known_rates
from .law_requests import LawRequest
from .poses import AnyMotion


def own_rates(motion: AnyMotion, what: str, acting: Acting | None = None) -> Mapping[str, FloatArray]:
    """Return the rates of the strokes of a motion, or those of a situation. `what` is asked for.

    Raise DefinitionError where nothing says how fast they move.
    """
    found = require_motion(motion).rates if acting is None else known_rates(require_motion(motion), acting)
    remedy = f"sweep over a path in time, or give rates={as_mapping(dict.fromkeys(motion.strokes, 0.05))} to evaluate"
    ensure(found, f"{motion.plan.title}: {what}: nothing says how fast the strokes move; {remedy}.")
    return found


def point_request(word: str, point: Reference, measures: str, formula: Callable[[AnyMotion, str], FloatArray]) -> LawRequest:
    """Return the request for a formula of a point that moves."""
    name = name_of(point)

    def examine(plan: Plan) -> None:
        checked_name("Point", name, plan.points, plan.title)

    return LawRequest(
        formula=lambda motion: formula(motion, name), text=f"{word}({name})", known=(word, name), measures=measures, examine=examine
    )


def speed(point: Reference) -> LawRequest:
    """Return the request for the speed of a point of a machine that runs.

    Parameters
    ----------
    point : Reference
        A point, or its name.

    Returns
    -------
    LawRequest
        The size of the velocity [m/s], for `answers`, `evaluate(..., rates=)`, tables and curves.
    """

    def over(motion: AnyMotion, name: str) -> FloatArray:
        x, y = motion.velocity(name, own_rates(motion, f"speed({name})"))
        return cast(FloatArray, np.hypot(x, y))

    return point_request("speed", point, "speed", over)


def acceleration(point: Reference) -> LawRequest:
    """Return the request for the acceleration of a point of a machine that runs.

    Parameters
    ----------
    point : Reference
        A point, or its name.

    Returns
    -------
    LawRequest
        The size of the acceleration [m/s2], for `answers`, `evaluate(..., rates=, accelerations=)`, tables and curves.
    """

    def over(motion: AnyMotion, name: str) -> FloatArray:
        x, y = motion.acceleration(name, own_rates(motion, f"acceleration({name})"), require_motion(motion).accelerations)
        return cast(FloatArray, np.hypot(x, y))

    return point_request("acceleration", point, "acceleration", over)


def dynamic_factor(request: Request) -> Combined:
    """Return the request for a force with inertia over the same force without: `most(dynamic_factor(thrust("lift")))`.

    Parameters
    ----------
    request : Request
        A force or a pressure, such as `thrust("lift")` or `pin_force("B")`.

    Returns
    -------
    Combined
        A number: 1 where nothing is accelerated, below 0 where inertia turns the force round.

    Raises
    ------
    DefinitionError
        The request is of no force, so that inertia changes nothing in it.
    """
    without = situated(request, Acting(inertia=False))
    if without is request or not isinstance(request, Request):
        raise DefinitionError(f'dynamic_factor({request}): a force is expected, such as dynamic_factor(thrust("lift")).')
    return Combined("divide", (request, without), f"dynamic_factor({request})")


def has_masses(plan: Plan) -> bool:
    """Return whether a machine declares a mass, whose inertia counts over a path in time."""
    return any(isinstance(each, (Weight, LinkMass)) for each in plan.of_kind(ForceElement).values())


def pace_remarks(judge: Judge) -> list[Remark]:
    """Return over which paths in time the inertia of a machine's masses is left out, or a start or a stop that takes no time."""
    found = list[str]()
    for place in judge.places if has_masses(judge.plan) else []:
        name, jump = f"{place.over.name}: " if len(judge.places) > 1 else "", place.motion._rate_jump
        sudden = [] if place.instants is None else [stroke for stroke, each in place.instants.courses.items() if each.starts_at_once]
        if jump is not None:
            text = said("{jump}, so that inertia is left out: give its ramp an acceleration, or take a smooth course.", jump=jump[1])
            found.append(name + text)
        elif sudden:
            text = said(
                "{strokes} starts or stops at once, which is in no force: give its ramp an acceleration, or take a smooth course.",
                strokes=", ".join(sudden),
            )
            found.append(name + text)
    return [*map(Remark, found)]
