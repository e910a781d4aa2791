"""Laws and formulas of a motion: read on arrays they give values, on the nodes of a program their derivatives as well."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from functools import cached_property, partial
from typing import Any, TypeAlias, TypeVar, cast
from weakref import ref

import numpy as np
from numpy.typing import ArrayLike

from ..errors import DefinitionError, LawError, UntracedError, ensure, is_listed, unwarned
from ..frozen import FrozenDict, immutable
from ..language import said
from ..loads import DIRECTIONS, PLAIN, Acting, ForceElement, LinkMass, Load, LoadCase, Push, Rate, Rates, StrokeRates, Weight
from ..motion import Judge, Motion, OnePose, Request, SmoothPiece, require_motion
from ..motion.dead_points import NOWHERE
from ..motion.grid import MotionLike
from ..motion.requests import NO_TRAIT, Combined, Trait, identity_of, situated, stroke_of
from ..motion.strokes import checked_name, order_of
from ..plan import TRACING, ArrayReading, Mask, Plan, Trace
from ..program import FloatArray, Node, Notes, SparseSystem, Traced, interpret, is_zero, node_of
from ..quantities import Angle, Distance, Member, Quantity, Reference, as_mapping, name_of
from ..steps import Arrow, Point
from ..vectors import Scalar
from ..verdict import Remark
from .applied import AppliedElement, AppliedLoads, Parts, element_parts, known_rates, motion_in_case, plan_in_case, refuse_direction
from .equilibrium import System
from .friction import JointFriction
from .holding import Levers, levers_of, nearness_of, settled, where_held
from .joints import Structure
from .poses import AnyMotion, FlatPoses
from .solution import Equilibrium, held_in_case, refuse_loose, structure_of

Made = TypeVar("Made")


Told: TypeAlias = tuple[set[str], dict[str, int], dict[Node, str], dict[Node, str], dict[Node, str]]
"""What a law has read, gone through, assumed, switched at and left open."""


class TracedMotion(OnePose):
    """One pose that stands for all of them. A number of it is Traced, a vector an array (2,) of such; both pass as arrays of floats.

    `read` are the members that have been asked for, `through` those that ratios were taken of, with the highest order, `notes` what has
    been assumed of them.
    """

    shape: tuple[int, ...] = ()
    tangent: None = None
    reached: Mask = np.array(True)
    unreachable = "raise"

    def __init__(self, plan: Plan, trace: Trace) -> None:
        self.plan, self._reading, self._placed = plan, trace, trace
        self.notes = Notes()
        self.read: set[str] = set()
        self.through: dict[str, int] = {}

    def _refused(self, what: Request, words: str) -> Mask:
        """Return that no pose is refused: a program's poses are examined where its values are asked for."""
        return NOWHERE

    # -- what several laws ask for ---------------------------------------------------------------------------

    def _once(self, key: Hashable, make: Callable[[], Made]) -> Made:
        """Return numbers that several laws of a program share, traced once; their readings and assumptions count for each of the laws."""
        kept, notes, key = self._reading.cache, self.notes, ("shared", self.plan, key)
        if key not in kept:
            before, owner = self._told, notes.owner
            self._told, notes.owner = (set(), {}, {}, {}, {}), ""
            try:
                made = make()
            finally:
                told, last = self._told, notes.owner
                self._told, notes.owner = before, owner
            kept[key] = made, told, last
        made, told, last = cast("tuple[Made, Told, str]", kept[key])
        self.read |= told[0]
        self._differentiated(told[1])
        for mine, more in zip(self._told[2:], told[2:], strict=True):
            mine.update({node: name or notes.owner for node, name in more.items()})
        notes.owner = last or notes.owner
        return cast(Made, self._own(made))

    def _differentiated(self, through: Mapping[str, int]) -> None:
        """Note members that ratios are taken of, with their orders."""
        self.through |= {name: max(order, self.through.get(name, 0)) for name, order in through.items()}

    @property
    def _told(self) -> Told:
        """The readings and notes so far."""
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

    # -- rates of strokes ------------------------------------------------------------------------------------

    @property
    def rates(self) -> dict[str, FloatArray]:
        """The rates of the strokes [1/s], inputs of the program."""
        return {name: self.number(self._reading.rate_input(name)) for name in self.plan.strokes}

    @property
    def accelerations(self) -> dict[str, FloatArray]:
        """The accelerations of the strokes [1/s2], inputs of the program."""
        return {name: self.number(self._reading.rate_input(name, 2)) for name in self.plan.strokes}

    def velocity(self, target: Reference, rates: Mapping[str, Rate]) -> FloatArray:
        """Return the velocity of a point or the rate of a quantity, at rates of strokes."""
        return self._by_time(target, rates, {}, 1)

    def acceleration(self, target: Reference, rates: Mapping[str, Rate], accelerations: Mapping[str, Rate]) -> FloatArray:
        """Return the acceleration of a point or a quantity, at rates and accelerations of strokes."""
        return self._by_time(target, rates, accelerations, 2)

    def _by_time(self, target: Reference, rates: Mapping[str, Rate], accelerations: Mapping[str, Rate], order: int) -> FloatArray:
        self._differentiated(dict.fromkeys(self.plan.reaches(name_of(target, is_needed=False) or target), order))
        moving, driven = ({name: self.node(each) for name, each in given.items()} for given in (rates, accelerations))
        places = nodes = [self.node(each) for each in self._nodes(target)]
        for _ in range(order):
            nodes = list(map(self._reading.by_time(moving, driven).derivative, nodes))
        beside = {name: each for name, each in driven.items() if name not in moving or moving[name].op != "input"}
        if beside:
            nodes = [a + self._reading.by_time(beside).derivative(b) for a, b in zip(nodes, places, strict=True)]
        return self._shaped(tuple(nodes))

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

    def parts_of(self, each: AppliedElement, rates: Rates) -> Parts:
        """Return the loads and the thrusts of one element, as nodes; at rest those of a member are traced once for all laws."""
        if not rates and each.in_case is self.plan.members.get(each.name):
            return self._once(("parts", each.name, each.factor), partial(self._parts_of, each, rates))
        return self._parts_of(each, rates)

    def _parts_of(self, each: AppliedElement, rates: Rates) -> Parts:
        """Return the same, its `loads` called on traced numbers."""
        self.notes.owner, self.notes.tests = each.name, 0
        try:
            return element_parts(self, self.fit, each, rates)
        except Exception as error:
            what = f"{self.plan.title}: the law of {each.name} cannot be traced: {str(error).rstrip('.')}"
            remedy = "Write it in plain arithmetic of numbers at one pose, or take finite differences of driving_force and pin_forces"
            raise LawError(f"{what}. {remedy}.") from error

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
        known = plan.valued_members
        member: Member = plan.members[checked_name("Name", target, known, plan.title)] if isinstance(target, str) else target
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
        """Return the value of a quantity at the sketch pose; DefinitionError where groups have to be solved for it."""
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
        self._differentiated(dict.fromkeys(self.plan.reaches(name_of(target, is_needed=False) or target), order_of(order)))
        nodes = tuple(self.node(each) for each in self._nodes(target))
        for _ in range(order_of(order)):
            nodes = tuple(self._reading.tangent(stroke).derivative(node) for node in nodes)
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
    along = np.linspace(0.0, 1.0, POSES)
    ranges = {name: each.start + along * (each.end - each.start) for name, each in plan.strokes.items()}
    with unwarned():  # the sketch and some poses over the strokes
        strokes = {name: np.append(plan.sketch_strokes[name], values) for name, values in ranges.items()}
        sampled = Motion(plan, plan.defaults, strokes, "nan")
    ensure(sampled.reached.any(), f"{plan.title}: the declared design cannot be assembled at any of {POSES} poses; declare one that can.")
    places = over_sampled([motion.node(part) for point in plan.points for part in motion._nodes(point)], sampled)
    size = max((float(np.ptp(rows)) for rows in (places[0::2], places[1::2]) if rows.size), default=0.0)
    # About half the extent [m], as a power of two, which divides without rounding: two designs have the same forces to the last bit.
    scale = float(2.0 ** np.round(np.log2(size / 2.0))) if size > 0.0 else 1.0
    system = System(structure, FlatPoses(motion, ""), applied.loads, frictions, scale)
    ways = [elimination(system, motion, sizes, way) for way in structure.holders.senses]
    found = ways[0]
    with np.errstate(invalid="ignore"):
        pivots = None if found is None else np.min(np.abs(over_sampled(found.pivots, sampled)), axis=0, initial=np.inf)
        is_regular = pivots is not None and bool(np.any(pivots > RANK))  # there is a solution at one of the poses
    if not is_regular:  # in words, where a body hangs loose or a link is redundant at all of them
        with unwarned():
            poses = FlatPoses(sampled, "The joint forces")
        thrusts = tuple(replace(each, thrust=np.zeros(sampled.shape)) for each in applied.thrusts)
        if poses.count:
            Equilibrium(System(structure_of(plan, applied.elements, thrusts), poses, ())).check()
    if found is None:
        raise DefinitionError(f"{plan.title}: the joints have more forces than equations, or less.")
    forces = [motion._array([each.unknowns()]) for each in ways if each is not None]
    holders = structure.holders
    if not holders.changes_shares:
        return system, forces[0]
    cond = nearness_of(holders, [levers_of(system.poses, holders, way) for way in holders.senses])
    pushes = [np.array([system.push(line, each, motion._array([sizes])) for line in holders.lines], object) for each in forces]
    return system, settled(holders, pushes, [where_held(cond, each[0]) for each in forces])[None]


def elimination(system: System, motion: TracedMotion, sizes: Sequence[Node], senses: Sequence[int]) -> SparseSystem | None:
    """Return the equations of a traced system under its loads and frictions, eliminated; None where they are more or less than unknowns.

    `senses` are 1 where the first cylinders of lines push, -1 where they pull.
    """
    zero = motion._reading.graph.constant(0.0)
    bound = system.known(senses)
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


def over_sampled(nodes: Sequence[Node], sampled: Motion) -> FloatArray:
    """Return numbers of a program at the sampled poses that are reached, shape (numbers, poses)."""
    rows = [np.broadcast_to(each, sampled._grid.size).ravel() for each in interpret(nodes, sampled._grid.flat)]
    return np.reshape(rows, (len(rows), int(np.prod(sampled._grid.size))))[:, sampled.reached.ravel()]


# Requests by a formula of a motion: read on arrays it gives values, on the nodes of a program their derivatives as well.


TracedLaw: TypeAlias = tuple[TracedMotion, Node]
"""A formula on a program: the traced motion that it asked, and its node."""


@immutable
class LawInPlan:
    """A formula in a plan: its key, the members that it reads, and those it is differentiated through, with the highest order.

    `trace` gives it on a traced motion of the plan, `traced_with` tells the formulas that are traced in one with it, None where it has been
    traced to know this, `sentence` what it is of there.
    """

    key: Hashable
    read: frozenset[str]
    through: Mapping[str, int]
    trace: Callable[[TracedMotion], TracedLaw]
    traced_with: Hashable = None
    sentence: str = ""


def law_in_plan(motion: TracedMotion, trace: Callable[[TracedMotion], TracedLaw], sentence: str = "") -> LawInPlan:
    """Return a formula in the plan of a traced motion, from its nodes, which are kept there; UntracedError where it has no program."""
    traced, node = trace(motion)
    notes = traced.notes
    key = "law", motion._reading.graph, node.number, *notes.assumed, None, *notes.switches, None, *notes.gaps
    motion._reading.cache.setdefault(key, (traced, node))
    return LawInPlan(key, frozenset(motion.read), FrozenDict(motion.through), trace, sentence=sentence)


@dataclass(frozen=True, eq=False, kw_only=True)
class LawRequest(Request):
    """A formula over a motion's poses as a request: `formula(motion, acting)`, plain arithmetic on a motion; [SI], shape (...).

    On a traced motion it gives one number of a program. Where `acting` is None it hangs on no situation, and is `formula(motion)`.
    `text` is what one writes, of the situation where it hangs on one; `known` tells the formula from others, whatever the situation:
    None where it may change. `mover` is the cylinder in whose directions it is judged, else these are the strokes'. `directions`, or
    `directions(plan)`, are those in which it is, None as without it: all where there is friction. `cases_in(plan, case)` whether it is in
    a load case.

    The rest is for requests that have something of their own to say. `examine(plan)` raises DefinitionError if a plan has nothing of the
    kind. `measured_in(plan)` says what it measures there, `pieces_in(request, plan)` its smooth pieces. `unlimited_in(motion, acting)` is
    the mask of poses where it has no bound. `look_up(request, motion)` is the request in the plan of a traced motion. `column` names the
    column of a table that it is, whose gaps alone it has.
    """

    formula: Callable[..., FloatArray]
    text: str | Callable[[Acting], str]
    known: Hashable = None
    acting: Acting | None = None
    measures: str = ""
    mover: Hashable = None
    directions: tuple[str, ...] | Callable[[Plan], tuple[str, ...] | None] | None = None
    cases_in: Callable[[Plan, str], bool] | None = None
    examine: Callable[[Plan], object] | None = None
    measured_in: Callable[[Plan], str] | None = None
    pieces_in: Callable[[LawRequest, Plan], tuple[SmoothPiece, ...]] | None = None
    unlimited_in: Callable[[Motion, Acting], Mask] | None = None
    look_up: Callable[[LawRequest, TracedMotion], LawInPlan] | None = None
    column: str = ""
    in_plan: LawInPlan | None = None
    """What it is in the plan that it is bound to."""

    def law(self, motion: AnyMotion) -> FloatArray:
        """Return the values over a motion's poses [SI], shape (...); one number of a program where the motion is traced."""
        if self.acting is None:
            return self.formula(motion)
        refuse_direction(motion, self.acting)
        return self.formula(held_in_case(motion, self.acting), self.acting)

    def of(self, motion: MotionLike) -> FloatArray:
        return self.law(require_motion(motion))

    def __str__(self) -> str:
        return self.text if isinstance(self.text, str) else self.text(self.situation)

    # -- in a situation ----------------------------------------------------------------------------------

    @property
    def situation(self) -> Acting:
        """The situation in which it is asked."""
        return PLAIN if self.acting is None else self.acting

    def identity(self, plan: Plan) -> Hashable:
        acting = self.situation
        loads = situation_identity(acting)
        return None if self.known is None or loads is None else ("law", self.known, loads, acting.direction, acting.drive)

    def under(self, acting: Acting, *, keep: bool = False) -> LawRequest:
        if self.acting is None:
            return self
        outer = acting if Trait.OF_STROKES in self.traits else replace(acting, drive=None)
        found = self.acting.within(outer, "" if keep else str(self))
        return self if found == self.acting else replace(self, acting=found)

    @property
    def traits(self) -> Trait:
        found = Trait.OF_LAWS | Trait.MAY_FAIL | Trait.FOLLOWS_ANGLES
        found |= Trait.OF_FORCES if self.acting is not None else NO_TRAIT
        found |= Trait.OF_STROKES if self.acting is not None and self.mover is None else NO_TRAIT
        return found if self.unlimited_in is None else found | Trait.MAY_BE_UNLIMITED

    def movements(self, plan: Plan, rubs: bool) -> tuple[str, ...]:
        own = () if self.acting is None else self.directions(plan) if callable(self.directions) else self.directions
        return own if own is not None else DIRECTIONS if rubs else DIRECTIONS[:1]

    def occurs_in(self, plan: Plan, case: str) -> bool:
        return self.cases_in is None or self.cases_in(plan, case)

    def measured(self, plan: Plan) -> str:
        return self.measures if self.measured_in is None else self.measured_in(plan)

    def pieces(self, plan: Plan) -> tuple[SmoothPiece, ...]:
        return super().pieces(plan) if self.pieces_in is None else self.pieces_in(self, plan)

    def unlimited(self, motion: MotionLike) -> Mask | None:
        return None if self.unlimited_in is None else self.unlimited_in(motion_in_case(require_motion(motion), self.acting), self.situation)

    # -- bound to a plan ---------------------------------------------------------------------------------

    def bound(self, plan: Plan) -> LawRequest:
        def made(_: Plan) -> LawRequest:
            if self.examine is not None:
                self.examine(plan)
            if self.acting is not None:
                refuse_loose(plan_in_case(plan, self.acting))
            with TRACING:
                motion = TracedMotion(plan.beside, plan.beside.trace)
                found = law_in_plan(motion, self.traced_law) if self.look_up is None else self.look_up(self, motion)
            return replace(self, in_plan=found)

        identity = identity_of(plan, self) if self.situation.loads is None else None  # what is kept must not keep loads alive
        return made(plan) if identity is None else plan.made(("bound", identity), made)

    def traced_law(self, motion: TracedMotion) -> TracedLaw:
        """Return the formula on the nodes of a program; UntracedError where it has none."""
        motion.notes.owner, motion.notes.tests = str(self), 0
        try:
            found = motion, motion.node(self.law(motion))
        except UntracedError as error:
            raise UntracedError(f"{self}: {error}") from error
        except Exception as error:
            what = f"{motion.plan.title}: {self} has values, and no program that gives derivatives: {str(error).rstrip('.')}"
            raise UntracedError(f"{what}. Take finite differences.") from error
        if self.column:
            claimed = motion.notes.claims.get(self.column, ())
            motion.notes.gaps = {node: owner for node, owner in motion.notes.gaps.items() if node in claimed}
        return found

    @property
    def key(self) -> Hashable:
        return self if self.in_plan is None else self.in_plan.key

    @property
    def sentence(self) -> str:
        return str(self) if self.in_plan is None else self.in_plan.sentence or str(self)

    @property
    def traced_with(self) -> Hashable:
        return self.key if self.in_plan is None else self.in_plan.traced_with

    def _in(self, plan: Plan) -> LawInPlan:
        """Return its law in the plan that it is bound to."""
        assert self.in_plan is not None, f"{self} is not bound to {plan.title}"
        return self.in_plan

    def _traced(self, plan: Plan) -> TracedLaw:
        """Return the formula on a plan's program, traced there once."""
        kept = cast(dict[Hashable, TracedLaw], plan.trace.cache)
        if self.key not in kept:
            kept[self.key] = self._in(plan).trace(TracedMotion(plan, plan.trace))
        return kept[self.key]

    def nodes(self, plan: Plan) -> tuple[Node, ...]:
        return (self._traced(plan)[1],)

    def notes(self, plan: Plan) -> Notes:
        return self._traced(plan)[0].notes

    def gaps(self, plan: Plan) -> tuple[Node, ...]:
        return tuple(self.notes(plan).gaps)

    def names(self, plan: Plan) -> set[str]:
        return set(self._in(plan).read)

    def differentiated(self, plan: Plan) -> set[str]:
        return set(self._in(plan).through)

    @property
    def order(self) -> int:
        return 0 if self.in_plan is None else max(self.in_plan.through.values(), default=0)

    def refuse(self, motion: MotionLike) -> None:
        self.of(motion)


# The situation that a request is asked in: what tells it from others, and how it is written.


def situation_identity(acting: Acting) -> Hashable:
    """Return a key of loads in a load case, which it does not keep alive; None where one of them may change.

    The direction and the drive are not in it. Members that were declared do not change, nor do frozen dataclasses. What their laws
    compute with is taken not to change either.
    """
    loads = acting.loads
    given = (acting.case, *(() if loads is None else loads if is_listed(loads) else (loads,)))
    parts: list[Hashable] = [each if each is None or isinstance(each, str) else ref(each) if is_unchanging(each) else ... for each in given]
    parts += [rates_identity(acting.rates), rates_identity(acting.accelerations), acting.inertia]
    return None if ... in parts else (loads is None, *parts)


def rates_identity(rates: StrokeRates) -> Hashable:
    """Return a key of rates of strokes; an ellipsis for arrays, which may change."""
    if rates is None or isinstance(rates, str):
        return rates
    plain = all(isinstance(each, float | int) for each in rates.values())
    return tuple((name_of(name), float(cast(float, each))) for name, each in rates.items()) if plain else ...


def once_in(motion: AnyMotion, acting: Acting, what: Hashable, make: Callable[[], Made]) -> Made:
    """Return a shared result of a motion in one situation, cached; made each time where its loads may change."""
    identity = situation_identity(acting)
    return make() if identity is None else motion._once((what, identity, acting.direction, acting.drive), make)


def is_unchanging(thing: object) -> bool:
    """Return whether loads or a load case cannot change: members of a class, and frozen dataclasses."""
    if not isinstance(thing, (ForceElement, LoadCase)):
        return False
    settings = vars(type(thing)).get("__dataclass_params__")
    return bool(thing._class) or (settings is not None and settings.frozen)


def request_text(word: str, arguments: Sequence[str], acting: Acting, *, moves: bool = False) -> str:
    """Return how a request is written in a situation: as a function of that name with some arguments and the load case.

    Behind them stand the direction and the drive, where it `moves` as these say.
    """
    given, case = [*arguments], acting.case
    given += [] if case is None else [f"case={case if isinstance(case, str) else case.name or case.label}"]
    given += [f"direction={acting.direction}"] if moves and acting.direction is not None else []
    given += [f"drive={acting.drive}"] if moves and acting.drive else []
    given += [] if acting.inertia is None else [f"inertia={acting.inertia}"]
    return f"{word}({', '.join(given)})"


# Of a running machine: the speed of its points, and the part of inertia in a force. Rates and accelerations of the strokes are those of a
# motion in time, or stand beside the strokes in `evaluate` and `function`.


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
