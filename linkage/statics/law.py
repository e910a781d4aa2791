"""The laws of the loads as nodes of a program: each element's own `loads`, called once on a traced motion."""

from __future__ import annotations

from dataclasses import replace
from threading import RLock
from typing import Any, final

import numpy as np

from ..errors import DefinitionError
from ..loads import Load, Push
from ..plan import Plan
from ..program import FloatArray, Notes
from .loaded import Acting, Case, Chosen, Loaded, Loads, Pushing, called, case_of, chosen, known_points, member_name
from .movement import AT_REST, Movement
from .poses import Poses
from .traced import TracedMotion

ONE = RLock()
"""Held while loads are traced on a program that is kept: threads in one graph would number its nodes twice."""


@final
class Law:
    """The loads of a mechanism, traced on a plan's program."""

    def __init__(self, motion: TracedMotion, loads: Loads, case: Case, movement: Movement) -> None:
        self.motion = motion
        rates = {name: motion.input(rate_name(name)) for name in movement.rates}
        self.loaded: Loaded = traced(motion, loads, case, replace(movement, rates=rates))
        self.poses = Poses(motion, "")

    @classmethod
    def of(cls, plan: Plan, loads: Loads, case: Case, movement: Movement = AT_REST) -> Law:
        """Return the loads traced on a program that is kept for this: equal loads have equal nodes there."""
        with ONE:
            kept = plan.made(("traced loads",), lambda twin: twin)
            return cls(TracedMotion(kept, kept.trace.view()), loads, case, movement)

    @classmethod
    def on(cls, plan: Plan, loads: Loads, case: Case, movement: Movement = AT_REST) -> Law:
        """Return the loads traced on a plan's own program."""
        return cls(TracedMotion(plan, plan.trace), loads, case, movement)

    @property
    def key(self) -> tuple[Any, ...]:
        """What tells these loads from others: the program, and where which nodes act."""
        acting = ((each.load.point, each.load.on, *(self.motion.node(part).number for part in each.force)) for each in self.loaded.acting)
        pushing = ((each.name, each.ends, self.motion.node(each.thrust).number) for each in self.loaded.pushing)
        return self.motion.reading.graph, *acting, *pushing, *self.notes.assumed, None, *self.notes.switches

    @property
    def notes(self) -> Notes:
        """What the laws are true under."""
        return self.motion.notes

    @property
    def carriers(self) -> set[str]:
        """The members that the loaded points are built from."""
        return set[str]().union(*map(self.motion.plan.reaches, self.loaded.points))

    @property
    def names(self) -> set[str]:
        """The members that the laws read and the loads act on."""
        return self.motion.read | self.carriers


def rate_name(stroke: str) -> str:
    """Return the name of a stroke's rate as an input of the program; no dimension can be called so."""
    return f"|rate {stroke}"


def traced(motion: TracedMotion, loads: Loads, case: Case, movement: Movement) -> Loaded:
    """Return the loads that act without friction, as nodes; DefinitionError, with the load's name, for a law that cannot be traced."""
    kept = chosen(motion.plan, loads, case)
    found = [traced_element(motion, each, movement) for each in kept]
    acting, pushing = (tuple(one for each in found for one in each[k]) for k in (0, 1))
    elements = tuple(each.element for each in kept)
    return Loaded(acting, pushing, (), elements, case_of(motion.plan, case).label, movement)  # type: ignore[arg-type]


def traced_element(motion: TracedMotion, element: Chosen, movement: Movement) -> tuple[list[Acting], list[Pushing]]:
    """Return the loads and the thrusts of one element as they act."""
    motion.notes.owner, motion.notes.tests = element.name, 0
    try:
        pushes = element.in_case.pushes(motion, movement.known)
        pushing = [
            Pushing(member_name(push.member, element.name), push.member, traced_thrust(motion, push) * element.factor) for push in pushes
        ]
        found = [] if pushes else called(element.in_case, motion, movement.known, element.name)
        acting = [Acting(load, traced_force(motion, load) * element.factor, element.name) for load in found]
    except Exception as error:
        raise DefinitionError(
            f"{motion.plan.title}: the law of {element.name} cannot be traced: {str(error).rstrip('.')}. "
            "Write it in plain arithmetic of numbers at one pose, or take finite differences of driving_force and pin_forces."
        ) from error
    for load in found:
        known_points(load, motion.plan, element.name)
    return acting, pushing


def traced_thrust(motion: TracedMotion, push: Push) -> FloatArray:
    """Return a member's thrust, one traced number."""
    motion[push.member.ends[0]], motion[push.member.ends[1]]
    shape = np.shape(np.asarray(push.thrust, object))
    if shape != ():
        raise DefinitionError(
            f"its thrust has the shape {shape}, where one number is expected; what varies over poses or designs comes from a point, "
            "a quantity or a parameter of an element declared in the class."
        )
    number: FloatArray = motion.number(np.asarray(push.thrust, object)[()])
    return number


def traced_force(motion: TracedMotion, load: Load) -> FloatArray:
    """Return a load's force, shape (2,)."""
    force = np.asarray(load.force)
    if force.shape != (2,):
        raise DefinitionError(
            f"its force at {load.point} has the shape {force.shape}, where (2,) is expected; what varies over poses or designs "
            "comes from a point, a quantity or a parameter of a load declared in the class."
        )
    return motion.array(force)
