"""The plan of a mechanism: its members in order, and the program that works them out."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from functools import cached_property
from threading import RLock
from typing import TypeVar, cast
from uuid import uuid4
from weakref import WeakValueDictionary

import numpy as np

from ..errors import DefinitionError, unknown
from ..program import Kernel, Level, Node, ancestors
from ..quantities import Angle, Function, Member, Quantity, unnamed
from ..shown import Shown
from ..steps import Arrow, Point
from ..units import Amount, amounts_in, require_measure
from ..vectors import Scalar
from .chain import KinematicChain, chain_of
from .members import Members, named_by, plan_measure
from .reading import ArrayReading, Reading
from .trace import Trace

WHOLE = 1e-14
"""A multiple so near to a whole number, for its size, is one."""


def has_angles(plan: Members, asked: Iterable[str | Member]) -> bool:
    """Return whether some members are built from directions of points."""
    parts = [part for each in asked if isinstance(each, Quantity) for part in (each, *unnamed(each))]
    parts += [part for name in plan.reaches(*asked) for part in plan.with_parts(name)]
    return any(isinstance(part, Angle) or (isinstance(part, Function) and part.symbol == "arctan2") for part in parts)


def followed_angles(plan: Members, trace: Trace, loads: Sequence[Quantity]) -> tuple[str, ...]:
    """Return the angles of a trace, as yet not followed, whose whole turns change places or loads.

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


Made = TypeVar("Made")

TRACING = RLock()
"""Held while something is traced on a program that is kept: threads in one graph would number its nodes twice."""
MOST_KERNELS = 1024
"""The kernels of a plan that are kept: loads with numbers of their own make one for each number."""


class Plan(Members, Shown):
    """The ordered members of a mechanism with their program: printable, traceable, the same for every design."""

    _first: Plan | None = None
    """The plan that this one is a fork of."""

    def __init__(self, members: Mapping[str, Member], title: str) -> None:
        super().__init__(members, title)
        self._kernels: dict[Hashable, object] = {}

    @cached_property
    def key(self) -> str:
        """A name that no other plan has, in any process."""
        return uuid4().hex

    def __reduce__(self) -> tuple[object, ...]:
        """Return the state for pickle: the members; everything derived from them is left out."""
        REGISTRY[self.key] = self
        found_later = {name for base in type(self).__mro__ for name, member in vars(base).items() if isinstance(member, cached_property)}
        kept = {name: value for name, value in vars(self).items() if name not in found_later | {"_kernels"}}
        return restored, (self.key, type(self), kept)

    @cached_property
    def chain(self) -> KinematicChain:
        """The bodies and the pairs between them, each of one freedom."""
        return chain_of(self)

    @property
    def gruebler(self) -> int:
        """The Gruebler count 3 (n - 1) - 2 j of the chain, less the constraints of closed lines and of ropes with a given length."""
        return self.chain.gruebler_count - len(self.cuts) + len(self.driven_cuts)

    @cached_property
    def trace(self) -> Trace:
        """The program's nodes, every point placed: a fork of those that all programs of the class begin with."""
        return (self._first or self)._placed.fork()

    @cached_property
    def _placed(self) -> Trace:
        """Every point placed, once a class; nothing is added here."""
        trace = self._traced(self.solved)
        with np.errstate(all="ignore"):  # what is divided by zero in a constant is told as the place that has no value
            self.work_out(trace)
        for name, length in self.following:
            trace.watch_length(name, length)
        return trace

    def _traced(self, solved: Sequence[str]) -> Trace:
        """Return an empty trace with the dimensions, the strokes and the unknowns `solved` as inputs."""
        levels = dict.fromkeys((*self.strokes, *solved), Level.POSE) | dict.fromkeys(self.table.entries, Level.DESIGN)
        return Trace(self.members, self.table.lengths, levels)

    def reading(self, inputs: Mapping[str, Scalar]) -> ArrayReading:
        """Return the eager reading on arrays, nothing worked out yet."""
        return ArrayReading(self.members, self.table.lengths, inputs)

    def read(self, inputs: Mapping[str, Scalar]) -> ArrayReading:
        """Return the eager reading on arrays, every point placed."""
        reading = self.reading(inputs)
        self.work_out(reading)
        return reading

    def work_out(self, reading: Reading) -> None:
        """Evaluate every point in a reading, and the loads' quantities where angles are followed."""
        for name in self.points:
            reading.at(name)
        for quantity in self.followers if self.followed else ():
            reading.value(quantity)

    def nodes(self, target: str | Quantity) -> tuple[Node, ...]:
        """Return the nodes of a point, a vector or a quantity."""
        if isinstance(target, str) and target not in self.members:
            raise unknown("Name", target, self.valued_members, where=self.title)
        member = self.members[target] if isinstance(target, str) else target
        match member:
            case Point():
                return self.trace.components(self.trace.at(member))
            case Arrow():
                return self.trace.components(self.trace.vector(member))
            case Quantity():
                return (self.trace.graph.node(self.trace.value(member)),)
        raise DefinitionError(f"{self.title}: {target} has no value over the stroke; name a point, a vector or an output.")

    def derived(self, nodes: Sequence[Node], along: Sequence[str]) -> tuple[Node, ...]:
        """Return the derivatives of nodes by strokes or dimensions, one after the other."""
        for name in along:
            nodes = list(map(self.trace.tangent(name).derivative, nodes))
        return tuple(nodes)

    def kernel(self, targets: tuple[str | Quantity, ...], along: tuple[str, ...] = (), guarded: bool = False) -> Kernel:
        """Return the kernel of some targets' values or derivatives, made once."""

        def make(plan: Plan) -> Kernel:
            nodes = [node for target in targets for node in plan.derived(plan.nodes(target), along)]
            return Kernel(nodes, plan.trace.watched(plan.members) if guarded else ())

        return self.made((targets, along, guarded), make)

    def made(self, key: Hashable, make: Callable[[Plan], Made]) -> Made:
        """Return a kernel, or an object with kernels, made once from a program of its own that earlier requests do not affect."""
        found = cast("Made | None", self._kernels.get(key))
        if found is None:
            self._kernels[key] = found = make(self._fork())
            for old in list(self._kernels)[:-MOST_KERNELS]:
                self._kernels.pop(old, None)
        return found

    def made_beside(self, key: Hashable, make: Callable[[Plan], Made]) -> Made:
        """Return the same from one shared program, in which common parts are traced once.

        What is made must not hang on what else was read there, but to err on the careful side.
        """
        with TRACING:
            return self.made(key, lambda _: make(self.beside))

    @property
    def beside(self) -> Plan:
        """The fork of that shared program, kept: what is equal has equal nodes there. Whoever traces on it holds `TRACING`."""
        return self.made(("beside",), lambda twin: twin)

    def _fork(self) -> Plan:
        """Return the same plan, not traced yet."""
        fork = object.__new__(type(self))
        vars(fork).update(vars(self), _first=self._first or self)
        vars(fork).pop("trace", None)
        return fork

    def exchanged(self, members: Mapping[str, Member]) -> Plan:
        """Return the same plan with some members in another state, in which they place nothing else: places and program stay."""
        fork = self._fork()
        vars(fork).update(members=named_by({**self.members, **members}, self.aliases), _kernels={})
        vars(fork).pop("key", None)
        return fork

    @cached_property
    def grouped(self) -> tuple[str, ...]:
        """The inputs that a group's solution supplies: its pins' coordinates and its distance from a singular pose."""
        return tuple(name for group in self.groups.values() for name in group.inputs)

    @cached_property
    def followers(self) -> tuple[Quantity, ...]:
        """The quantities that the loads of the class follow."""
        given = [part for member in self.members.values() if member.kind == "load" for part in member.parts()]
        found = (self.members.get(part) if isinstance(part, str) else part for part in given)
        return tuple(each for each in dict.fromkeys(found) if isinstance(each, Quantity))

    @cached_property
    def followed(self) -> tuple[str, ...]:
        """The angles that are followed from the sketch, as whole turns of them tell poses apart; each is an input, its reference [rad].

        In an order in which each hangs on none after it.
        """
        if not has_angles(self, (*self.points, *self.followers)):
            return ()
        trace = self._traced(self.grouped)
        for name in self.points:
            trace.at(name)
        for name, length in self.following:
            trace.watch_length(name, length)
        return followed_angles(self, trace, self.followers)

    @cached_property
    def solved(self) -> tuple[str, ...]:
        """The inputs that are found by iteration along the way from the sketch: those of groups, and references of angles."""
        return (*self.grouped, *self.followed)

    @cached_property
    def solved_names(self) -> frozenset[str]:
        """The same as a set."""
        return frozenset(self.solved)

    @cached_property
    def may_overflow(self) -> bool:
        """Whether a place may have no value where no guard tells: by arithmetic, or as an angle cannot be followed."""
        return super().may_overflow or bool(self.followed)

    def untracked(self, quantity: Quantity) -> tuple[str, ...]:
        """Return the angles that a quantity uses, other than by whole multiples, cosines and sines, and that are not followed."""

        def look(plan: Plan) -> tuple[str, ...]:
            if not has_angles(plan, (quantity,)):
                return ()
            trace = plan._traced(plan.solved)
            return angles_that_count(trace, [trace.graph.node(trace.value(quantity))])

        return self.made(("untracked", quantity.identity), look)


REGISTRY: WeakValueDictionary[str, Plan] = WeakValueDictionary()
"""The plans that came from another process or went to one, by their keys: what arrives twice is the same plan. Of the whole process, as
pickle calls `restored` with nothing but what was sent.
"""
RECENT: deque[Plan] = deque(maxlen=8)
"""Those that came last, kept with their kernels: a class that is sent by its text comes with every task anew."""


def restored(key: str, kind: type[Plan], parts: Mapping[str, object]) -> Plan:
    """Return the plan of a key: the one that is here already, or one of these parts."""
    plan = REGISTRY.get(key)
    if plan is None:
        plan = object.__new__(kind)
        plan.__dict__.update(parts, _kernels={}, key=key)
        plan = REGISTRY.setdefault(key, plan)
        RECENT.append(plan)
    return plan


def require_kinds(plan: Plan, given: Mapping[str, object], where: str = "") -> None:
    """Refuse amounts of another kind than the strokes and dimensions measure that they are given for, by name; see `require_kind`."""
    for name, value in given.items():
        if isinstance(value, (Amount, list, tuple)):  # arrays and plain numbers know nothing
            require_kind(plan, name, value, f"{where or plan.title}: {name}")


def require_kind(plan: Plan, name: str, value: object, what: str) -> None:
    """Refuse an amount of another kind than a dimension, a fixed point or a stroke of a machine measures.

    Parameters
    ----------
    plan : Plan
        What the machine is made of.
    name : str
        The name of a dimension, of a fixed point, whose coordinates are lengths, or of a stroke; any other one passes.
    value : object
        What was given for it, or several values in a list or a tuple.
    what : str
        What it was given for, for the message: `Arm: S`.

    Raises
    ------
    DefinitionError
        An amount measures something else. A plain number is SI, whatever was meant.
    """
    if next(amounts_in(value), None) is None:
        return
    if name in plan.strokes:
        kind = plan.known_stroke_kind(name)
    else:
        spelling = name if name in plan.table.spellings else f"{name}.x"
        kind = plan_measure(plan, plan.table.spellings[spelling][0]) if spelling in plan.table.spellings else ""
    if kind:
        require_measure(value, kind, what)
