"""The laws of the loads as nodes of a program: each element's own `loads`, called once on a motion whose numbers are nodes."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import fields, replace
from functools import cached_property
from typing import Any, TypeAlias, TypeVar, cast, final

import numpy as np
from numpy.typing import ArrayLike

from ..errors import DefinitionError, LawError, UntracedError, unwarned
from ..loads import Acting, Load, Push, Rates
from ..motion import Motion, OnePose, Request
from ..motion.requests import stroke_of
from ..motion.strokes import checked_name, order_of
from ..plan import TRACING, ArrayReading, Mask, Plan, Trace
from ..program import FloatArray, Node, Notes, SparseSystem, Traced, interpret, is_zero, node_of
from ..quantities import Angle, Distance, Member, Quantity, Reference
from ..steps import Arrow, Point
from ..vectors import Scalar
from .applied import AppliedElement, AppliedLoads, Parts, applied_loads, element_parts
from .equilibrium import JointFriction, System
from .holding import Levers
from .joints import Structure
from .poses import AnyMotion, FlatPoses
from .solution import Equilibrium

Read = TypeVar("Read")
Made = TypeVar("Made")


def traced_apart(plan: Plan, read: Callable[[TracedMotion], Read]) -> Read:
    """Return what is read of a pose on a program that is kept for this: what is equal has equal nodes there."""
    with TRACING:
        kept = plan.made(("traced loads",), lambda twin: twin)
        return read(TracedMotion(kept, kept.trace.view()))


def traced_loads(motion: TracedMotion, acting: Acting, rates: Rates) -> AppliedLoads:
    """Return what acts in a situation, as nodes; LawError, with the element's name, for a law that cannot be traced."""
    return applied_loads(motion, acting, rates, parts_of=traced_parts)


def traced_parts(each: AppliedElement, motion: AnyMotion, rates: Rates) -> Parts:
    """Return the loads and the thrusts of one element, as nodes; LawError, with its name, for a law that cannot be traced."""
    assert isinstance(motion, TracedMotion)
    motion.notes.owner, motion.notes.tests = each.name, 0
    try:
        return element_parts(each, motion, rates, motion.fit)
    except Exception as error:
        what = f"{motion.plan.title}: the law of {each.name} cannot be traced: {str(error).rstrip('.')}"
        remedy = "Write it in plain arithmetic of numbers at one pose, or take finite differences of driving_force and pin_forces"
        raise LawError(f"{what}. {remedy}.") from error


def refuse_friction(motion: AnyMotion, applied: AppliedLoads) -> None:
    """Raise UntracedError where a program is asked for what dry friction has a part in: it follows from the forces that it changes."""
    if isinstance(motion, TracedMotion) and applied.frictions:
        rubbing = [each.name or str(each) for each in applied.elements if each.frictions(motion)]
        what = f"{motion.plan.title}: the friction of {', '.join(rubbing)} follows from the forces that it changes and has no program"
        remedy = f'Ask while nothing rubs, direction="frictionless", or leave {rubbing[0]} out by a LoadCase'
        raise UntracedError(f"{what}: there are values, and no derivatives. {remedy}.")


Told: TypeAlias = tuple[set[str], set[str], dict[Node, str], dict[Node, str], dict[Node, str]]
"""What a law has read, gone through, assumed, switched at and left open."""


@final
class TracedMotion(OnePose):
    """One pose that stands for all of them. A number of it is Traced, a vector an array (2,) of such; both pass as arrays of floats.

    `read` are the members that have been asked for, `through` those that ratios were taken of, `notes` what has been assumed of them.
    """

    shape: tuple[int, ...] = ()
    tangent: None = None
    reached: Mask = np.array(True)
    unreachable = "raise"

    def __init__(self, plan: Plan, trace: Trace) -> None:
        self.plan, self._reading = plan, trace
        self.notes = Notes()
        self.read: set[str] = set()
        self.through: set[str] = set()

    def _refused(self, what: Request, words: str) -> Mask:
        """Return that no pose is refused: what is made of the program here is looked at where it is asked for."""
        return np.zeros((), bool)

    # -- what several laws ask for ---------------------------------------------------------------------------

    def _once(self, key: Hashable, make: Callable[[], Made]) -> Made:
        """Return numbers that several laws of a program ask for, traced once; what they read and assume counts for each of the laws."""
        kept, notes, key = self._reading.kept, self.notes, ("shared", self.plan, key)
        if key not in kept:
            before, owner = self._told, notes.owner
            self._told, notes.owner = (set(), set(), {}, {}, {}), ""
            try:
                made = make()
            finally:
                told, last = self._told, notes.owner
                self._told, notes.owner = before, owner
            kept[key] = made, told, last
        made, told, last = cast("tuple[Made, Told, str]", kept[key])
        self.read |= told[0]
        self.through |= told[1]
        for mine, more in zip(self._told[2:], told[2:], strict=True):
            mine.update({node: name or notes.owner for node, name in more.items()})
        notes.owner = last or notes.owner
        return cast(Made, self._own(made))

    @property
    def _told(self) -> Told:
        """What has been read and noted so far."""
        return self.read, self.through, self.notes.assumed, self.notes.switches, self.notes.gaps

    @_told.setter
    def _told(self, told: Told) -> None:
        self.read, self.through, self.notes.assumed, self.notes.switches, self.notes.gaps = told

    def _own(self, made: object) -> object:
        """Return numbers that were traced for another law as numbers of this one."""
        if isinstance(made, Traced):
            return self.number(cast(Scalar, made))
        if isinstance(made, np.ndarray):
            return self._array(made) if made.dtype == object else made
        if isinstance(made, (tuple, list)):
            return type(made)(map(self._own, made))
        if isinstance(made, Levers | AppliedLoads | Load | Push):
            own: dict[str, Any] = {each.name: self._own(getattr(made, each.name)) for each in fields(made)}
            return replace(made, **own)
        return made

    # -- numbers ---------------------------------------------------------------------------------------------

    def number(self, value: Scalar) -> FloatArray:
        """Return a number of the program as a traced one."""
        return cast(FloatArray, Traced(self._reading.graph.node(node_of(value)), self.notes))

    def _array(self, values: ArrayLike | Sequence[Node] | Sequence[Sequence[Node]]) -> FloatArray:
        """Return numbers of the program as an array of traced ones."""
        given = np.asarray(values, object)
        found = np.empty(given.shape, object)
        for place in np.ndindex(found.shape):
            found[place] = self.number(given[place])
        return cast(FloatArray, found)

    def node(self, number: Scalar) -> Node:
        """Return the node of a number."""
        return self._reading.graph.node(node_of(number))

    def fit(self, values: ArrayLike, vector: int, name: str, what: str) -> FloatArray:
        """Return a force as traced numbers, shape () or of a `vector` (2,); DefinitionError for another shape."""
        shape, array = (2,) * vector, np.asarray(values, object)
        if array.shape != shape:
            expected, owner = ("(2,)", "a load") if vector else ("one number", "an element")
            remedy = f"what varies over poses or designs comes from a point, a quantity or a parameter of {owner} declared in the class"
            raise DefinitionError(f"its {what} has the shape {array.shape}, where {expected} is expected; {remedy}.")
        return self._array(array) if vector else self.number(array[()])

    # -- what a motion tells ---------------------------------------------------------------------------------

    @cached_property
    def inputs(self) -> dict[str, FloatArray]:
        """Design variables and strokes by name."""
        return {name: self.number(node) for name, node in self._reading.inputs.items()}

    @property
    def strokes(self) -> Mapping[str, FloatArray]:
        """The strokes by name."""
        return {name: self.inputs[name] for name in self.plan.strokes}

    def __getitem__(self, name: str) -> FloatArray:
        return self._shaped(self._nodes(name))

    def _nodes(self, target: Reference) -> tuple[Scalar, ...]:
        """Return the nodes of a point, a vector or a quantity; the members behind it are noted."""
        plan = self.plan
        member: Member = plan.members[checked_name("Name", target, plan.named(), plan.title)] if isinstance(target, str) else target
        self.read |= plan.reaches(member.name or member)
        if isinstance(member, (Point, Arrow)):
            place = self._reading.at(member) if isinstance(member, Point) else self._reading.vector(member)
            return place.x, place.y
        return (self._reading.value(member),)

    def _shaped(self, nodes: tuple[Scalar, ...]) -> FloatArray:
        return self._array(nodes) if len(nodes) == 2 else self.number(nodes[0])

    def value(self, quantity: Quantity) -> FloatArray:
        """Return a quantity."""
        return self._shaped(self._nodes(quantity))

    def angle(self, P: Reference, Q: Reference) -> FloatArray:
        """Return the direction of P -> Q [rad]."""
        return self.value(Angle(P, Q))

    def distance(self, P: Reference, Q: Reference) -> FloatArray:
        """Return the distance of two points [m]."""
        return self.value(Distance(P, Q))

    def sketched(self, quantity: Quantity) -> FloatArray:
        """Return what a quantity is at the sketch pose; DefinitionError where groups have to be solved for it."""
        if self.plan.reaches(quantity) & set(self.plan.groups):
            raise DefinitionError("it asks for the sketch pose, which groups of links have no closed form for")
        inputs = {name: value for name, value in self.inputs.items() if name not in self.plan.followed}  # there they begin
        found = ArrayReading(self.plan.members, self.plan.table.lengths, {**inputs, **self.plan.sketch_strokes}).value(quantity)
        return cast(FloatArray, found)

    def x(self, point: str) -> FloatArray:
        """Return a point's x coordinate [m]."""
        return cast(FloatArray, self[point][0])

    def y(self, point: str) -> FloatArray:
        """Return a point's y coordinate [m]."""
        return cast(FloatArray, self[point][1])

    def ratio(self, target: Reference, *, wrt: str | None = None, order: int = 1) -> FloatArray:
        """Return the derivative of a point, a vector or a quantity by a stroke, of `order` 1 or 2."""
        stroke = stroke_of(self.plan, wrt)
        self.through |= self.plan.reaches(target if isinstance(target, str) else target.name or target)
        nodes = tuple(self.node(each) for each in self._nodes(target))
        for _ in range(order_of(order)):
            nodes = tuple(self._reading.tangent(stroke).of(node) for node in nodes)
        return self._shaped(nodes)


# The equations of equilibrium on the nodes of a program, eliminated symbolically.

POSES = 5
"""Poses over the strokes at which it is tried whether the joints can be solved for."""
RANK = 1e-9
"""A pivot below this, in equations whose entries are about 1, says that the joints cannot be solved for."""


def eliminated_forces(
    structure: Structure, motion: TracedMotion, applied: AppliedLoads, frictions: Sequence[JointFriction] = (), sizes: Sequence[Node] = ()
) -> tuple[System, FloatArray]:
    """Return the equations of a traced pose with the joint forces that solve them, shape (1, columns).

    `sizes` are those of the frictions. DefinitionError where a body hangs loose or a link is redundant.
    """
    plan = motion.plan
    for name, run in structure.holders.reeved.items():
        if run.back:
            what = f"the forces between bodies hang on which of {name} and {run.back} pulls, pose by pose"
            raise UntracedError(f"{plan.title}: {what}: there are values, and no program that gives derivatives.")
    sampled = sampled_poses(plan)
    places = [motion.node(part) for point in plan.points for part in motion._nodes(point)]
    system = System(structure, FlatPoses(motion, ""), applied.loads, frictions, half_extent(over_sampled(places, sampled)))
    found = elimination(system, motion, sizes)
    with np.errstate(invalid="ignore"):
        pivots = None if found is None else np.min(np.abs(over_sampled(found.pivots, sampled)), axis=0, initial=np.inf)
        is_regular = pivots is not None and bool(np.any(pivots > RANK))  # there is a solution at one of the poses
    if not is_regular:  # in words, where a body hangs loose or a link is redundant at all of them
        with unwarned():
            poses = FlatPoses(sampled, "The joint forces")
        thrusts = tuple(replace(each, thrust=np.zeros(sampled.shape)) for each in applied.thrusts)
        if poses.count:
            Equilibrium(System(Structure(plan, applied.elements, thrusts), poses, ())).check()
    if found is None:
        raise DefinitionError(f"{plan.title}: the joints have more forces than equations, or less.")
    return system, motion._array([found.unknowns()])


def elimination(system: System, motion: TracedMotion, sizes: Sequence[Node]) -> SparseSystem | None:
    """Return the equations of a traced system under its loads and frictions, eliminated; None where they are more or less than unknowns."""
    zero = motion._reading.graph.constant(0.0)
    bound = system.known()
    rows: list[dict[int, Node]] = [{} for _ in range(system.starts[-1] + len(bound))]
    if len(rows) != system.width:
        return None
    joints = ((place, row, value) for place, column in enumerate(system.unknowns) for row, value in system.entries(column))
    for place, row, value in (*joints, *system.run_entries()):
        rows[row][place] = rows[row].get(place, zero) + motion.node(value[0])
    right = [-motion.node(each) for each in system.load_rows[0]]
    for friction, size in zip(system.frictions, sizes, strict=True):
        for row, value in system.entries(friction.unit):
            right[row] = right[row] - motion.node(value[0]) * size
    for number, (form, value) in enumerate(bound, system.starts[-1]):
        rows[number] = {place: motion.node(each) for place, each in enumerate(form.row[0])}
        rest = [motion.node(each) * size for each, size in zip(form.friction[0], sizes, strict=True)]
        right.append(sum((-each for each in rest), motion.node((value - form.rest)[0])))
    return SparseSystem([{place: each for place, each in row.items() if not is_zero(each)} for row in rows], right, scaled=True)


def sampled_poses(plan: Plan) -> Motion:
    """Return the sketch and some poses over the strokes; DefinitionError where none of them can be assembled."""
    along = np.linspace(0.0, 1.0, POSES)
    ranges = {name: each.start + along * (each.end - each.start) for name, each in plan.strokes.items()}
    with unwarned():
        found = Motion(plan, plan.defaults, {name: np.append(plan.sketch_strokes[name], values) for name, values in ranges.items()}, "nan")
    if not found.reached.any():
        raise DefinitionError(f"{plan.title}: the declared design cannot be assembled at any of {POSES} poses; declare one that can.")
    return found


def over_sampled(nodes: Sequence[Node], sampled: Motion) -> FloatArray:
    """Return numbers of a program at the sampled poses that are reached, shape (numbers, poses)."""
    rows = [np.broadcast_to(each, sampled._grid.size).ravel() for each in interpret(nodes, sampled._grid.flat)]
    return np.reshape(rows, (len(rows), int(np.prod(sampled._grid.size))))[:, sampled.reached.ravel()]


def half_extent(places: FloatArray) -> float:
    """Return about half the extent of a mechanism [m], from the coordinates of its points at some poses: x and y of each in turn.

    It is a power of two, which divides without rounding: two designs of a machine have the same forces to the last bit.
    """
    size = max((float(np.ptp(rows)) for rows in (places[0::2], places[1::2]) if rows.size), default=0.0)
    return float(2.0 ** np.round(np.log2(size / 2.0))) if size > 0.0 else 1.0
