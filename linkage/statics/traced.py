"""A motion of one pose whose numbers are nodes of the program: what the laws of forces are traced on."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import Any, final

import numpy as np

from ..errors import DefinitionError
from ..motion.checks import named
from ..motion.requests import stroke_of
from ..plan import ArrayReading, Plan, Trace
from ..program import FloatArray, Level, Node, Notes, Tangent, Traced, node_of
from ..quantities import Angle, Distance, Quantity, Reference
from ..steps import Arrow, Point


@final
class TracedMotion:
    """One pose that stands for all of them. A number of it is Traced, a vector an array (2,) of such.

    `read` are the members that have been asked for, `notes` what has been assumed of them.
    """

    shape: tuple[int, ...] = ()
    reached = np.array(True)
    unreachable = "raise"

    def __init__(self, plan: Plan, trace: Trace) -> None:
        self.plan, self.reading = plan, trace
        self.notes = Notes()
        self.read: set[str] = set()
        self._tangents: dict[str, Tangent] = {}

    def refused(self, what: Any, words: str) -> Any:
        """Return that no pose is refused: what is made of the program here is looked at where it is asked for."""
        return np.zeros((), bool)

    # -- numbers ---------------------------------------------------------------------------------------------

    def number(self, value: Any) -> Any:
        """Return a number of the program as a traced one."""
        return Traced(self.reading.graph.node(node_of(value)), self.notes)

    def input(self, name: str) -> Any:
        """Return an input of the program at the poses, besides those of the plan, as a traced number."""
        return self.number(self.reading.graph.input(name, Level.POSE))

    def array(self, values: Any) -> FloatArray:
        """Return numbers of the program as an array of traced ones."""
        found = np.empty(np.shape(given := np.asarray(values, object)), object)
        for place in np.ndindex(found.shape):
            found[place] = self.number(given[place])
        return found

    def node(self, number: Any) -> Node:
        """Return the node of a number."""
        return self.reading.graph.node(node_of(number))

    # -- what a motion tells ---------------------------------------------------------------------------------

    @cached_property
    def inputs(self) -> dict[str, Any]:
        """Design variables and strokes by name."""
        return {name: self.number(node) for name, node in self.reading.inputs.items()}

    @property
    def strokes(self) -> Mapping[str, Any]:
        """The strokes by name."""
        return {name: self.inputs[name] for name in self.plan.strokes}

    def __getitem__(self, name: str) -> Any:
        return self._shaped(self._nodes(name))

    def _nodes(self, target: str | Quantity) -> tuple[Any, ...]:
        """Return the nodes of a point, a vector or a quantity; the members behind it are noted."""
        member = self.plan.members[named("Name", target, self.plan.named(), self.plan.title)] if isinstance(target, str) else target
        self.read |= self.plan.reaches(member.name or member)
        if isinstance(member, (Point, Arrow)):
            place = self.reading.at(member) if isinstance(member, Point) else self.reading.vector(member)
            return place.x, place.y
        return (self.reading.value(member),)

    def _shaped(self, nodes: tuple[Any, ...]) -> Any:
        return self.array(nodes) if len(nodes) == 2 else self.number(nodes[0])

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
        if stroke not in self._tangents:
            self._tangents[stroke] = Tangent(self.reading.graph, {self.reading.inputs[stroke]: 1.0})
        return self._shaped(tuple(self._tangents[stroke].of(self.node(each)) for each in self._nodes(target)))
