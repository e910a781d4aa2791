"""What cylinders carry, as something to ask for: in `evaluate`, `function`, `gradient`, in studies and searches, and of a motion.

Each is the cylinder's or the circuit's own method, read pose by pose: `motion[pressure("lift")]` is `lift.pressure(motion)`.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable
from dataclasses import dataclass, replace
from functools import partial, reduce
from typing import Any, TypeAlias, final

import numpy as np

from linkage.errors import DefinitionError, known_name
from linkage.loads import DIRECTIONS, Acting, Case, situation_of
from linkage.mechanism import Mechanism
from linkage.motion import Condition, Constraint, SmoothPiece, at, least, most
from linkage.plan import Mask, Plan
from linkage.quantities import Reference, distance, name_of
from linkage.statics import (
    AnyMotion,
    Direction,
    LawRequest,
    direction_words,
    member_limits,
    member_thrust,
    plan_in_case,
    pull_direction,
    same,
)

from .inputs import Array, only_where, proper_share
from .line import LiftLine, WayBack, Work
from .member import (
    PISTON,
    ROD,
    SIDES,
    Circuit,
    Ram,
    buckling_request,
    by_other_lines,
    circuit_having,
    cylinder_in,
    cylinder_request,
    formula_of_cylinder,
    found_in,
    in_stages,
    line_thrust,
    thrust_request,
)
from .standing import moves_in, no_direction

Circuits: TypeAlias = str | LiftLine
"""A circuit by its name, or itself; "" for the only one that has a cylinder."""


def thrust(
    cylinder: Reference, *, case: Case = None, direction: str | None = None, acting: Acting | None = None
) -> LawRequest:
    """Return the request for what a cylinder carries [N], positive where it pushes: `lift.thrust(motion, case=..., direction=...)`.

    `acting` says case and direction in one, with loads and rates too. With declared friction and a direction it has values and no
    derivatives.
    """
    return thrust_request(name_of(cylinder), situation_of("thrust", acting, case=case, direction=direction))


def circuit_with(plan: Plan, ram: Ram, circuit: Circuits, word: str) -> LiftLine:
    """Return the circuit that is meant; DefinitionError where none or several have the cylinder, or the one named has not.

    `word` is what is asked of it.
    """
    circuits = plan.of_kind(LiftLine)
    if not isinstance(circuit, str):
        return circuit
    if circuit:
        known_name("LiftCircuit", circuit, circuits, where=plan.title)
    feeding = {name: each for name, each in circuits.items() if any(same(ram, one) for one in each.members(plan.members))}
    if circuit and circuit not in feeding:
        raise DefinitionError(f"{plan.title}: {circuit} does not feed {ram.name}; that is on {', '.join(feeding) or 'none'}.")
    pumped = {name: each for name, each in feeding.items() if each.kind_open(plan.members) == "held"}
    feeding = pumped if pumped and not circuit else feeding  # a tank or gas on the other side lifts nothing
    if circuit or len(feeding) == 1:
        return feeding[circuit or next(iter(feeding))]
    if feeding:
        raise DefinitionError(f"{plan.title}: {ram.name} is on {len(feeding)} circuits; say circuit= one of {', '.join(feeding)}.")
    remedy = f"declare one, circuit = LiftCircuit({ram.name}, pressure=...)"
    raise DefinitionError(f"{plan.title}: {word}({ram.name}): no LiftCircuit has it, whose pump and relief count; {remedy}.")


def circuit_request(
    word: str,
    cylinder: str | Ram,
    acting: Acting,
    circuit: Circuits,
    formula: Callable[[AnyMotion, Ram, Acting], Array],
    before: tuple[Hashable, ...] = (),
    after: tuple[Hashable, ...] = (),
    *,
    measures: str = "",
) -> LawRequest:
    """Return the request for what a formula gives of a cylinder on the circuit that feeds it: the only one that has it, unless named."""
    named = circuit if isinstance(circuit, str) else circuit.name or circuit
    shown = (f"circuit={named}" if isinstance(named, str) and named else named) or None
    found = cylinder_request(word, cylinder, acting, formula, (*before, shown), after, measures=measures)
    return replace(found, examine=partial(examine_circuit, cylinder, circuit, word))


def examine_circuit(cylinder: str | Ram, circuit: Circuits, word: str, plan: Plan) -> None:
    """Raise DefinitionError where a plan has no such cylinder on such a circuit."""
    circuit_with(plan, cylinder_in(cylinder, plan), circuit, word)


# The pressure.


def pressure(
    cylinder: Reference,
    *,
    case: Case = None,
    circuit: Reference | None = None,
    direction: str | None = None,
    side: str = "",
    acting: Acting | None = None,
) -> LawRequest:
    """Return the request for the pressure in a cylinder [Pa gauge]: `lift.pressure(motion, case=..., direction=...)`.

    It is that of the cylinder's one circuit, efficiencies and back pressure included; `circuit` names one of several LiftCircuits.
    Of the side that works; `side="piston"` or `side="rod"` asks for one side, 0 where the other one holds. Where it is judged both count.
    In the place of the cylinder an OilLine may be named, whose own pressure it is then, with the direction that of its first cylinder.
    """
    if side:
        known_name("Side", side, SIDES)
    given = situation_of("pressure", acting, case=case, direction=direction)
    return pressure_request(name_of(cylinder), given, circuit_name(circuit), side)


def pressure_request(
    cylinder: str | Ram, acting: Acting, circuit: Circuits = "", side: str = "", *, is_needed: bool = False, below: bool = False
) -> LawRequest:
    """Return the request for the pressure in a cylinder: on the side that works, or on one side.

    One that `is_needed` is that of the pump while it drives the cylinder, on the side that does. `below` zero it goes on where the other
    side holds.
    """
    kinds = " ".join(["needed"] * is_needed + ["below zero"] * below) or None
    formula = partial(pressure_over, circuit=circuit, side=side, below=below)
    options = (side and f"side={side}") or None, kinds
    return replace(
        circuit_request("pressure", cylinder, acting, circuit, formula, after=options, measures="pressure"),
        formula=partial(pressure_of_named, cylinder, formula, bool(circuit or side)),
        examine=partial(examine_pressure, cylinder, circuit), directions=partial(driven_or_both, cylinder, is_needed),
        pieces_in=partial(pressure_pieces, cylinder, circuit, side, is_needed),
    )  # fmt: skip


def line_in(named: str | Ram, plan: Plan) -> Circuit | None:
    """Return the line that a name stands for in a plan; None where it is a cylinder's."""
    found = plan.members.get(named) if isinstance(named, str) else None
    return found if isinstance(found, Circuit) else None


def pressure_of_named(
    named: str | Ram, formula: Callable[[AnyMotion, Ram, Acting], Array], is_told: bool, motion: AnyMotion, acting: Acting
) -> Array:
    """Return the pressure of a line or in a cylinder; DefinitionError for a line where a circuit or a side `is_told` beside it."""
    line = line_in(named, motion.plan)
    if line is None:
        return formula_of_cylinder(formula, named, motion, acting)
    if is_told:
        raise DefinitionError(f"{motion.plan.title}: pressure({named}): {named} is a line, of one pressure; leave circuit= and side= out.")
    return line.line_pressure(motion, acting) + np.zeros(motion.shape)


def pressure_over(motion: AnyMotion, ram: Ram, acting: Acting, *, circuit: Circuits, side: str, below: bool) -> Array:
    """Return the pressure in a cylinder over a motion's poses [Pa gauge]."""
    line = circuit_with(motion.plan, ram, circuit, "pressure") if circuit else None
    if side:
        return ram.pressure_on(side, motion, acting, line, below=below)
    return ram.pressure(motion, acting=acting) if line is None else line.pressure_in(ram, motion, acting)


def examine_pressure(cylinder: str | Ram, circuit: Circuits, plan: Plan) -> None:
    """Raise DefinitionError where it is not plain which circuit, if any, gives a cylinder its pressure."""
    if line_in(cylinder, plan) is not None:
        return
    ram = cylinder_in(cylinder, plan)
    if circuit:
        circuit_with(plan, ram, circuit, "pressure")
    else:
        circuit_having(ram, plan)


def driven_or_both(cylinder: str | Ram, is_needed: bool, plan: Plan) -> tuple[str, ...]:
    """Return the directions in which a pressure is judged: those in which the pump drives where it is what is needed, else all."""
    return cylinder_in(cylinder, plan).driven if is_needed and line_in(cylinder, plan) is None else DIRECTIONS


def pressure_pieces(
    cylinder: str | Ram, circuit: Circuits, side: str, is_needed: bool, request: LawRequest, plan: Plan
) -> tuple[SmoothPiece, ...]:
    """Return the smooth pieces of a pressure: one a side that may hold, going on below zero where the other one does."""
    if line_in(cylinder, plan) is not None:
        return (SmoothPiece(request),)
    on_side = partial(pressure_request, cylinder, request.situation, circuit, is_needed=is_needed)
    ram = cylinder_in(cylinder, plan)
    sides = [side] if side else [driving_side(request.situation.direction)] if is_needed else ram.own_sides
    plan = plan_in_case(plan, request.situation)
    if not side and not is_needed and any(same(ram, one) for each in plan.of_kind(Circuit).values() for one in each.feeds(plan.members)):
        return in_stages((SmoothPiece(request, ram.side),), cylinder, plan)
    own = circuit_having(ram, plan, False)
    if not (side or circuit) and own is not None and own.kind_in(plan.members) == "closed":
        return in_stages((SmoothPiece(request),), cylinder, plan)
    return in_stages([SmoothPiece(on_side(each), each, below=on_side(each, below=True)) for each in sides], cylinder, plan)


def circuit_name(circuit: Reference | None) -> str:
    """Return the name of a circuit; "" where none is named."""
    return "" if circuit is None else name_of(circuit)


def driving_side(direction: str | None) -> str:
    """Return the side that drives a cylinder in a direction."""
    return {"extending": PISTON, "retracting": ROD}.get(direction or "", "")


# The reserve.


def reserve(
    cylinder: Reference, *, case: Case = None, circuit: Reference | None = None, direction: str | None = None, acting: Acting | None = None
) -> LawRequest:
    """Return the request for the greatest rod force over the needed one: `circuit.reserve(motion, cylinder=lift, case=..., direction=...)`.

    NaN where the load drives, which is not limited by this cylinder and counts in no least value. Where it is judged, of a cylinder that
    works with both sides each counts while it moves against the load.
    """
    given = situation_of("reserve", acting, case=case, direction=direction)
    return reserve_request(name_of(cylinder), given, circuit_name(circuit))


def reserve_request(
    cylinder: str | Ram, acting: Acting, circuit: Circuits = "", *, is_judged: bool = False
) -> LawRequest:
    """Return the request for the greatest rod force over the needed one; of one that is judged, while it moves against the load."""
    driving = Driving(circuit, is_judged)
    return replace(
        circuit_request("reserve", cylinder, acting, circuit, driving.reserve, after=("against the load" if is_judged else None,)),
        directions=partial(driven_or_both, cylinder, True), pieces_in=partial(reserve_pieces, cylinder, driving),
        cases_in=partial(moves_in, cylinder),
        unlimited_in=partial(formula_of_cylinder, driving.is_driven, cylinder),
    )  # fmt: skip


@final
@dataclass(frozen=True, eq=False)
class Driving:
    """On which circuit a reserve is asked for, and whether while it moves against the load."""

    circuit: Circuits
    is_judged: bool

    def reserve(self, motion: AnyMotion, ram: Ram, acting: Acting) -> Array:
        """Return the greatest rod force over the needed one at a motion's poses."""
        circuit = circuit_with(motion.plan, ram, self.circuit, "reserve")
        if not self.is_judged:
            return circuit.reserve(motion, cylinder=ram, acting=acting)
        work = self.work(motion, ram, acting)
        with np.errstate(invalid="ignore"):
            return np.asarray(circuit.most(motion, work) / only_where(self.against(work) > 0.0, work.force))[()]

    def against(self, work: Work) -> Array:
        """Return what is above zero where the cylinder has to drive [N]: the thrust in its direction where that is judged."""
        return work.thrust * work.sense if self.is_judged else work.force

    def work(self, motion: AnyMotion, ram: Ram, acting: Acting) -> Work:
        """Return what the cylinder has to do."""
        return circuit_with(motion.plan, ram, self.circuit, "reserve").work(motion, cylinder=ram, acting=acting)

    def is_driven(self, motion: AnyMotion, ram: Ram, acting: Acting) -> Mask:
        """Return the mask of poses at which the load drives, so that the reserve has no bound."""
        work = self.work(motion, ram, acting)
        return np.asarray(np.isfinite(work.thrust) & ~(self.against(work) > 0.0))

    def use(self, motion: AnyMotion, ram: Ram, acting: Acting) -> Array:
        """Return one over the reserve of the side that drives a cylinder in a direction; below zero where the load drives."""
        circuit, size = circuit_with(motion.plan, ram, self.circuit, "use"), ram.sized(motion, acting.direction)
        k_m, thrust = circuit.efficiency(motion, "mechanical"), line_thrust(ram, circuit, motion, acting, with_tanks=False)
        drained = by_other_lines(ram, circuit, motion, None, True)
        sense = 1.0 if acting.direction == "extending" else -1.0
        most = circuit.most(motion, Work(np.asarray(sense), np.asarray(sense), size, k_m, 0.0 if drained is None else drained))
        return np.asarray(sense * thrust / (k_m * most))[()]


def reserve_pieces(cylinder: str | Ram, driving: Driving, request: LawRequest, plan: Plan) -> tuple[SmoothPiece, ...]:
    """Return the smooth piece of a reserve: of the side that drives, whose inverse goes on smoothly where the load drives."""
    acting = request.situation
    if acting.direction not in cylinder_in(cylinder, plan).driven:
        return in_stages((SmoothPiece(request),), cylinder, plan)
    use = circuit_request("use", cylinder, acting, driving.circuit, driving.use)
    use = replace(use, cases_in=partial(moves_in, cylinder))
    judged = reserve_request(cylinder, acting, driving.circuit, is_judged=True)
    return in_stages((SmoothPiece(judged, driving_side(acting.direction), use),), cylinder, plan)


# Going back.


def going_back_request(
    cylinder: str | Ram, acting: Acting, circuit: Circuits, way: str, resistance: float = 0.0, tells: str = "push"
) -> LawRequest:
    """Return the request for what the other side must give while a cylinder goes back against a resistance [Pa].

    `way` is "extending" or "retracting"; `tells="load"` asks for what the load alone makes in the side that empties, "whole push" for what
    the other side must give with what a tank has there.
    """
    formula = partial(going_back_over, circuit=circuit, way=way, resistance=resistance, tells=tells)
    options = way, resistance, tells
    found = circuit_request("going back", cylinder, acting, circuit, formula, after=options, measures="pressure")
    given = partial(one_direction, way), partial(whole_in_stages, cylinder), partial(moves_in, cylinder)
    return replace(found, directions=given[0], pieces_in=given[1], cases_in=given[2])


def whole_in_stages(cylinder: str | Ram, request: LawRequest, plan: Plan) -> tuple[SmoothPiece, ...]:
    """Return a request that is smooth, as long as one stage of its cylinder moves, as its pieces."""
    return in_stages((SmoothPiece(request),), cylinder, plan)


def one_direction(way: str, plan: Plan) -> tuple[str, ...]:
    """Return the direction alone in which a cylinder goes back."""
    return (way,)


def going_back_over(
    motion: AnyMotion, ram: Ram, acting: Acting, *, circuit: Circuits, way: str, resistance: float, tells: str
) -> Array:
    """Return what the other side must give, or the load alone makes, at a motion's poses [Pa]."""
    line = circuit_with(motion.plan, ram, circuit, "going back")
    found = WayBack.of(ram, line, motion, acting, way, resistance, line.efficiency(motion, "mechanical"))
    return found.working if tells == "load" else found.push + found.tank if tells == "whole push" else found.push


# The capacity.


def capacity(
    cylinder: Reference,
    point: Reference,
    *,
    along: tuple[Any, Any] = (0.0, 1.0),
    share: float = 1.0,
    case: Case = None,
    circuit: Reference | None = None,
    acting: Acting | None = None,
) -> LawRequest:
    """Return the request for the largest load [N] at a point that the pump lifts beside the machine's own: `circuit.capacity(motion, "G")`.

    `along` is a direction of two numbers or quantities. NaN where the load drives or does nothing, which is not limited by this cylinder
    and counts in no least value.
    """
    proper_share(share)
    given, unit = situation_of("capacity", acting, case=case), pull_direction(along)
    return capacity_request(name_of(cylinder), given, circuit_name(circuit), name_of(point), unit, float(share))


def capacity_request(
    cylinder: str | Ram, acting: Acting, circuit: Circuits, point: str, along: Direction, share: float
) -> LawRequest:
    """Return the request for the largest load at a point that the pump lifts, along a direction of length one."""
    lifted, words = Lifted(circuit, point, along, share), direction_words(along)
    options = None if words == "(0, 1)" else f"along={words}", None if share == 1.0 else f"share={share:g}"
    return replace(
        circuit_request("capacity", cylinder, acting, circuit, lifted.capacity, (point,), options, measures="force"),
        directions=no_direction, examine=partial(lifted.examine, cylinder), pieces_in=partial(lifted.pieces, cylinder),
        unlimited_in=partial(formula_of_cylinder, lifted.is_driven, cylinder),
    )  # fmt: skip


@final
@dataclass(frozen=True, eq=False)
class Lifted:
    """On which circuit, at which point, along which direction and at which share of the pressure a load is lifted.

    `limit` is the number of the one thing that limits it: of members' conditions in their order, else the pump; None for all of them.
    """

    circuit: Circuits
    point: str
    along: Direction
    share: float
    limit: int | None = None

    def examine(self, cylinder: str | Ram, plan: Plan) -> None:
        """Raise DefinitionError where a plan has no such cylinder, circuit or point."""
        circuit_with(plan, cylinder_in(cylinder, plan), self.circuit, "capacity")
        known_name("Point", self.point, plan.points, where=plan.title)

    def capacity(self, motion: AnyMotion, ram: Ram, acting: Acting) -> Array:
        """Return the largest load that is lifted at a motion's poses [N]."""
        circuit = circuit_with(motion.plan, ram, self.circuit, "capacity")
        return circuit.lifted(motion, self.point, along=self.along, share=self.share, cylinder=ram, acting=acting, limit=self.limit)

    def pieces(self, cylinder: str | Ram, request: LawRequest, plan: Plan) -> tuple[SmoothPiece, ...]:
        """Return its smooth pieces: what the pump lifts, and what each member's condition leaves."""
        count = len(member_limits(plan, request.situation.case))
        if not count:
            return whole_in_stages(cylinder, request, plan)

        def alone(number: int) -> LawRequest:
            one = replace(self, limit=number)
            formula = partial(formula_of_cylinder, one.capacity, cylinder)
            driven = partial(formula_of_cylinder, one.is_driven, cylinder)
            return replace(request, known=(request.known, number), pieces_in=None, formula=formula, unlimited_in=driven)

        return (*whole_in_stages(cylinder, alone(count), plan), *(SmoothPiece(alone(number)) for number in range(count)))

    def is_driven(self, motion: AnyMotion, ram: Ram, acting: Acting) -> Mask:
        """Return the mask of poses at which the load drives or does nothing, so that the capacity has no bound."""
        thrust = member_thrust(motion, ram, Acting(acting.loads, acting.case))
        return np.asarray(np.isfinite(thrust) & np.isnan(self.capacity(motion, ram, acting)))


# The use of a rod.


def buckling(
    cylinder: Reference, *, case: Case = None, direction: str | None = None, acting: Acting | None = None
) -> LawRequest:
    """Return the request for the utilisation of a rod: `lift.buckling_use(motion, case=..., direction=...)`, at most 1 where it holds."""
    return buckling_request(name_of(cylinder), situation_of("buckling", acting, case=case, direction=direction))


# A condition of a search.

@final
@dataclass(frozen=True)
class Fits(Condition):
    """A cylinder's closed and open length serve the whole stroke, and it comes out by no more than it is long closed."""

    cylinder: str

    def constraints(self, machine: Mechanism) -> tuple[Constraint, ...]:
        plan = machine.plan
        ram = found_in(plan.members, self.cylinder, plan.title)
        length, name = distance(ram.A, ram.B), ram.name
        strokes, closed = ([at(each) for each in ram.lengths_named(said)] for said in ("stroke", "closed"))
        if not strokes:
            raise DefinitionError(f"{plan.title}: fits({name}): {name} says no stroke; declare it, Cylinder(..., closed=0.5, stroke=0.25).")
        if not closed:
            return (most(length) - least(length) <= strokes[0],)
        opened = reduce(lambda a, b: a + b, [closed[0], *strokes])
        return least(length) >= closed[0], most(length) <= opened, *(stroke <= closed[0] for stroke in strokes)

    def __str__(self) -> str:
        return f"fits({self.cylinder})"


def fits(cylinder: Reference) -> Fits:
    """Return the condition that a cylinder's closed and open length serve the whole stroke of a machine; `Cylinder.fits` tells by how much.

    With its stroke alone declared that is compared with the travel. Its `closed` and `stroke` may be varied: `"lift.closed"`.
    """
    return Fits(name_of(cylinder))
