"""Which angles have to be followed from the sketch: those whose whole turns make a difference to a place or to a load.

The direction of P -> Q comes back after a turn, and so does what cosines and sines make of it, or of a whole multiple. Seven tenths
of it do not: where the arc tangent jumps from 180 to -180 deg, they would jump as well.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from ..errors import DefinitionError
from ..program import Level, Node, ancestors
from ..quantities import Angle, Function, Member, Quantity, unnamed
from .members import Members
from .trace import Trace

WHOLE = 1e-14
"""A multiple so near to a whole number, for its size, is one."""


def has_angles(plan: Members, asked: Iterable[str | Member]) -> bool:
    """Return whether some members are built from directions of points."""
    parts = [part for each in asked if isinstance(each, Quantity) for part in (each, *unnamed(each))]
    parts += [part for name in plan.reaches(*asked) for part in plan.with_parts(name)]
    return any(isinstance(part, Angle) or (isinstance(part, Function) and part.symbol == "arctan2") for part in parts)


def followed_angles(plan: Members, trace: Trace, loads: Sequence[Quantity]) -> tuple[str, ...]:
    """Return the angles of a trace, as yet not followed, whose whole turns change where points are or what loads are.

    DefinitionError where one of them changes the pins of a group.
    """
    ends = [node for place in trace.positions.values() for node in trace.components(place)]
    ends += [guard.node for guard in trace.guards] + [trace.graph.node(trace.value(each)) for each in loads]
    found = angles_that_count(trace, ends)
    places = [trace.at(pin) for group in plan.groups.values() for pin in group.pins]
    closures = dict.fromkeys(root.closure for place in places for root in trace.components(place))
    grouped = angles_that_count(trace, [residual for closure in closures if closure for residual in closure.residuals])
    if grouped:
        pins = ", ".join(pin for group in plan.groups.values() for pin in group.pins)
        raise DefinitionError(
            f"{plan.title}: {grouped[0]} is used in another way than by a whole multiple, its cosine or its sine, and the pins {pins} "
            "hang on it. Such an angle and pins that are found by iteration cannot both be followed from the sketch; use a whole multiple, "
            "or drive the angle by a Stroke.",
            member=grouped[0],
        )
    return found


def angles_that_count(trace: Trace, ends: Sequence[Node]) -> tuple[str, ...]:
    """Return the moving angles of a trace whose whole turns change some nodes, in the order in which they were worked out."""
    nodes = ancestors(ends)
    behind, wanted = set(nodes), {end.origin for end in ends}
    found = []
    for name, vector in trace.directions.items():
        angle = trace.graph.node(np.arctan2(vector.y, vector.x))
        if angle in behind and angle.level is Level.POSE:
            changes: dict[Node, float | None] = {}  # by how many turns each changes where the angle turns once; None: in another way
            for node in nodes:
                turns = [changes[each.origin] for each in node.args]
                known = [each for each in turns if each is not None]
                changes[node] = 1.0 if node is angle else None if len(known) < len(turns) else turns_of_operation(node, known)
            if any(changes[end] != 0.0 for end in wanted):
                found.append(name)
    return tuple(found)


def turns_of_operation(node: Node, turns: Sequence[float]) -> float | None:
    """Return by how many turns an operation changes where its arguments change by so many; None where it changes in another way."""
    if not any(turns):
        return 0.0
    if node.op in ("add", "subtract"):
        return turns[0] + turns[1] if node.op == "add" else turns[0] - turns[1]
    if node.op == "negative":
        return -turns[0]
    if node.op == "multiply":
        factor, other = (each.origin for each in node.args)
        return factor.value * turns[1] if factor.op == "constant" else turns[0] * other.value if other.op == "constant" else None
    if node.op in ("sin", "cos", "tan") and abs(turns[0] - round(turns[0])) <= WHOLE * abs(turns[0]):
        return 0.0
    return None
