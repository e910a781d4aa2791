"""The laws of the loads as nodes of a program: each element's own `loads`, called once on a traced motion."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from threading import RLock
from typing import Any, final

import numpy as np

from ..errors import DefinitionError, unwarned
from ..loads import Load, Push
from ..motion import Motion
from ..motion.requests import stroke_of
from ..motion.strokes import checked_name
from ..plan import ArrayReading, Plan, Trace
from ..program import FloatArray, Level, Node, Notes, Traced, eliminated, node_of
from ..quantities import Angle, Distance, Quantity, Reference
from ..steps import Arrow, Point
from .acting import AT_REST, Acting, Case, Chosen, Loaded, Loads, Movement, Pushing, called, case_of, chosen, known_points, member_name
from .equilibrium import System
from .joints import Structure
from .poses import Poses
from .solution import Equations

# A motion of one pose whose numbers are nodes of the program: what the laws of forces are traced on.

@final
class TracedMotion:
    """One pose that stands for all of them. A number of it is Traced, a vector an array (2,) of such.

    `read` are the members that have been asked for, `notes` what has been assumed of them.
    """

    shape: tuple[int, ...] = ()
    reached = np.array(True)
    unreachable = "raise"

    def __init__(self, plan: Plan, trace: Trace) -> None:
        self.plan, self._reading = plan, trace
        self.notes = Notes()
        self.read: set[str] = set()

    def _refused(self, what: Any, words: str) -> Any:
        """Return that no pose is refused: what is made of the program here is looked at where it is asked for."""
        return np.zeros((), bool)

    # -- numbers ---------------------------------------------------------------------------------------------

    def number(self, value: Any) -> Any:
        """Return a number of the program as a traced one."""
        return Traced(self._reading.graph.node(node_of(value)), self.notes)

    def input(self, name: str) -> Any:
        """Return an input of the program at the poses, besides those of the plan, as a traced number."""
        return self.number(self._reading.graph.input(name, Level.POSE))

    def _array(self, values: Any) -> FloatArray:
        """Return numbers of the program as an array of traced ones."""
        found = np.empty(np.shape(given := np.asarray(values, object)), object)
        for place in np.ndindex(found.shape):
            found[place] = self.number(given[place])
        return found

    def node(self, number: Any) -> Node:
        """Return the node of a number."""
        return self._reading.graph.node(node_of(number))

    # -- what a motion tells ---------------------------------------------------------------------------------

    @cached_property
    def inputs(self) -> dict[str, Any]:
        """Design variables and strokes by name."""
        return {name: self.number(node) for name, node in self._reading.inputs.items()}

    @property
    def strokes(self) -> Mapping[str, Any]:
        """The strokes by name."""
        return {name: self.inputs[name] for name in self.plan.strokes}

    def __getitem__(self, name: str) -> Any:
        return self._shaped(self._nodes(name))

    def _nodes(self, target: str | Quantity) -> tuple[Any, ...]:
        """Return the nodes of a point, a vector or a quantity; the members behind it are noted."""
        member = self.plan.members[checked_name("Name", target, self.plan.named(), self.plan.title)] if isinstance(target, str) else target
        self.read |= self.plan.reaches(member.name or member)
        if isinstance(member, (Point, Arrow)):
            place = self._reading.at(member) if isinstance(member, Point) else self._reading.vector(member)
            return place.x, place.y
        return (self._reading.value(member),)

    def _shaped(self, nodes: tuple[Any, ...]) -> Any:
        return self._array(nodes) if len(nodes) == 2 else self.number(nodes[0])

    def value(self, quantity: Quantity) -> Any:
        """Return a quantity."""
        return self._shaped(self._nodes(quantity))

    def angle(self, P: Reference, Q: Reference) -> Any:
        """Return the direction of P -> Q [rad]."""
        return self.value(Angle(P, Q))

    def distance(self, P: Reference, Q: Reference) -> Any:
        """Return the distance of two points [m]."""
        return self.value(Distance(P, Q))

    def sketched(self, quantity: Quantity) -> Any:
        """Return what a quantity is at the sketch pose; DefinitionError where groups have to be solved for it."""
        if self.plan.reaches(quantity) & set(self.plan.groups):
            raise DefinitionError("it asks for the sketch pose, which groups of links have no closed form for")
        inputs = {name: value for name, value in self.inputs.items() if name not in self.plan.followed}  # there they begin
        return ArrayReading(self.plan.members, self.plan.table.lengths, {**inputs, **self.plan.sketch_strokes}).value(quantity)

    def x(self, point: str) -> Any:
        """Return a point's x coordinate [m]."""
        return self[point][0]

    def y(self, point: str) -> Any:
        """Return a point's y coordinate [m]."""
        return self[point][1]

    def ratio(self, target: Any, *, wrt: str | None = None) -> Any:
        """Return the derivative of a point, a vector or a quantity by a stroke."""
        stroke = stroke_of(self.plan, wrt)
        return self._shaped(tuple(self._reading.tangent(stroke).of(self.node(each)) for each in self._nodes(target)))


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
        return self.motion._reading.graph, *acting, *pushing, *self.notes.assumed, None, *self.notes.switches

    @property
    def notes(self) -> Notes:
        """What the laws are true under."""
        return self.motion.notes

    @property
    def carriers(self) -> set[str]:
        """The members that the loaded points are built from."""
        return self.motion.plan.reaches(*self.loaded.points)

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
    return motion._array(force)


# The equations of equilibrium on the nodes of a program, eliminated symbolically.

SAMPLE = 5
"""Poses over the strokes at which it is tried whether the joints can be solved for."""


def eliminated_system(system: System, motion: TracedMotion, friction: Sequence[Node] = ()) -> FloatArray:
    """Return the joint forces of a traced system under its loads and frictions, eliminated symbolically, shape (1, columns)."""
    equations = Equations(system, bound=tuple(system.known()))
    A, right = equations.A[0], equations.right[0]
    sides = [motion.node(row[0]) for row in right]
    for place, each in enumerate(friction):
        sides = [side + motion.node(row[1 + place]) * each for side, row in zip(sides, right, strict=True)]
    return motion._array([eliminated([[motion.node(each) for each in row] for row in A], sides)])


def held(plan: Plan, loaded: Loaded) -> float:
    """Return a length of the mechanism [m]; DefinitionError where a body hangs loose or a link is redundant."""
    along = np.linspace(0.0, 1.0, SAMPLE)
    ranges = {name: each.start + along * (each.end - each.start) for name, each in plan.strokes.items()}
    strokes = {name: np.append(plan.sketch_strokes[name], values) for name, values in ranges.items()}
    with unwarned():
        poses = Poses(Motion(plan, plan.defaults, strokes, "nan"), "The joint forces")
    still = tuple(replace(each, thrust=np.zeros(poses.motion.shape)) for each in loaded.pushing)
    system = System(Structure(plan, loaded.elements, still), poses, ())
    if not poses.count:
        raise DefinitionError(f"{plan.title}: the declared design cannot be assembled at any of {SAMPLE} poses; declare one that can.")
    equations = Equations(system, bound=tuple(system.known()))
    equations.check(*equations.A.shape[1:])
    return system.scale
