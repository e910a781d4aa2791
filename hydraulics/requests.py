"""Requests for cylinders: in `evaluate`, `function`, `gradient`, in studies and searches, and of a motion.

Each is the cylinder's or the circuit's own method, read pose by pose: `motion[pressure("lift")]` is `lift.pressure(motion)`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial, reduce
from operator import add
from types import MappingProxyType
from typing import Any, TypeAlias

import numpy as np

from linkage.errors import DefinitionError, ensure, known_name
from linkage.frozen import record
from linkage.loads import DIRECTIONS, FRICTIONLESS, SENSES, Acting, Case, situation_of
from linkage.mechanism import Mechanism
from linkage.motion import Condition, Constraint, SmoothPiece, at, least, most
from linkage.plan import Mask, Plan
from linkage.quantities import Reference, distance, name_of
from linkage.statics import AnyMotion, LawRequest, is_among, member_limits, member_thrust, own_rates, plan_in_case
from linkage.statics.carried import Direction, direction_words, pull_direction

from .cylinders import (
    PISTON,
    ROD,
    SIDES,
    Circuit,
    CylinderLaw,
    Options,
    Ram,
    buckling_request,
    chamber_area,
    circuit_having,
    circuits_among,
    cylinder_in,
    cylinder_request,
    formula_of_cylinder,
    found_in,
    in_stages,
    line_beside,
    line_thrust,
    lines_by_side,
    rate_request,
    refuse_gas,
    thrust_request,
)
from .inputs import Array, only_where, proper_share
from .lifting_line import LiftLine, Work, way_back
from .standing import members_in, moves_in

Circuits: TypeAlias = str | LiftLine
"""A circuit by its name, or itself; "" for the only one that has a cylinder."""


def thrust(cylinder: Reference, *, case: Case = None, direction: str | None = None, acting: Acting | None = None) -> LawRequest:
    """Return the request for a cylinder's thrust [N], positive where it pushes: `lift.thrust(motion, case=..., direction=...)`.

    `acting` says case and direction in one, with loads and rates too. With declared friction and a direction it has values and no
    derivatives.

    Parameters
    ----------
    cylinder : str or Ram
        The cylinder, or its name.
    case : LoadCase or str, optional
        A load case, or its name.
    direction : str, optional
        "extending" while the stroke grows, "retracting", or "frictionless".
    acting : Acting, optional
        Loads, load case, direction and rates in one.

    Returns
    -------
    Request
        The thrust [N].
    """
    return thrust_request(name_of(cylinder), situation_of("thrust", acting, case=case, direction=direction))


def circuit_with(plan: Plan, cylinder: str | Ram, circuit: Circuits, word: str) -> LiftLine:
    """Return the circuit that is meant; DefinitionError where none or several have the cylinder, or the one named has not.

    `word` is what is asked of it.
    """
    ram, circuits = cylinder_in(cylinder, plan), plan.of_kind(LiftLine)
    if not isinstance(circuit, str):
        return circuit
    if circuit:
        known_name("LiftCircuit", circuit, circuits, where=plan.title)
    feeding = {name: each for name, each in circuits.items() if is_among(ram, each.members(plan.members))}
    if circuit and circuit not in feeding:
        raise DefinitionError(f"{plan.title}: {circuit} does not feed {ram.name}; that is on {', '.join(feeding) or 'none'}.")
    pumped = {name: each for name, each in feeding.items() if each.kind_open(plan.members) == "held"}
    if word != "pressure" and feeding and not pumped:
        feeding[circuit or next(iter(feeding))].check_pump(plan)
    feeding = pumped if pumped and not circuit else feeding  # a tank or gas on the other side lifts nothing
    if circuit or len(feeding) == 1:
        return feeding[circuit or next(iter(feeding))]
    ensure(not feeding, f"{plan.title}: {ram.name} is on {len(feeding)} circuits; say which, circuit={' or '.join(map(repr, feeding))}.")
    remedy = f"declare one, circuit = LiftCircuit({ram.name}, pressure=...)"
    raise DefinitionError(f"{plan.title}: {word}({ram.name}): no LiftCircuit has it, whose pump and relief count; {remedy}.")


def cylinder_on(cylinder: str | Ram, circuit: Circuits, plan: Plan, word: str) -> Ram:
    """Return a cylinder as it works by the circuit that is meant."""
    ram = cylinder_in(cylinder, plan)
    return circuit_with(plan, ram, circuit, word).as_worked(ram, plan.members)


def circuit_shown(circuit: Circuits) -> str | Circuits | None:
    """Return a circuit as the text of a request has it; itself where it has no name, None for the only one."""
    name = name_of(circuit, is_needed=False)
    return f"circuit={name}" if name else circuit or None


def circuit_request(
    word: str, cylinder: str | Ram, acting: Acting, circuit: Circuits, formula: CylinderLaw, after: Options = (), measures: str = ""
) -> LawRequest:
    """Return the request for a formula of a cylinder and its circuit: the only one that feeds it, unless named."""
    found = cylinder_request(word, cylinder, acting, formula, (circuit_shown(circuit),), after, measures=measures)
    return replace(found, examine=partial(circuit_with, cylinder=cylinder, circuit=circuit, word=word))


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

    Parameters
    ----------
    cylinder : str or Ram
        The cylinder, or its name.
    case : LoadCase or str, optional
        A load case, or its name.
    circuit : str or circuit, optional
        The circuit that feeds the cylinder; by default its only one.
    direction : str, optional
        "extending" while the stroke grows, "retracting", or "frictionless".
    side : str
        "piston" or "rod".
    acting : Acting, optional
        Loads, load case, direction and rates in one.

    Returns
    -------
    Request
        The pressure [Pa gauge].
    """
    if side:
        known_name("Side", side, SIDES)
    given = situation_of("pressure", acting, case=case, direction=direction)
    return pressure_request(name_of(cylinder), given, "" if circuit is None else name_of(circuit), side)


def pressure_request(
    cylinder: str | Ram, acting: Acting, circuit: Circuits = "", side: str = "", *, is_needed: bool = False, below: bool = False
) -> LawRequest:
    """Return the request for the pressure in a cylinder, on the side that works or on one side; or of a line by its name.

    One that `is_needed` is that of the pump while it drives the cylinder, on the side that does, and is judged in those directions.
    `below` zero it goes on where the other side holds: so each side that may hold is a smooth piece.
    """

    def in_cylinder(motion: AnyMotion, ram: Ram, acting: Acting) -> Array:
        line = circuit_with(motion.plan, ram, circuit, "pressure") if circuit else None
        if side:
            return ram.pressure_on(side, motion, acting, line, below=below)
        return ram.pressure(motion, acting=acting) if line is None else line.pressure_in(ram, motion, acting)

    def formula(motion: AnyMotion, acting: Acting) -> Array:
        line = line_in(cylinder, motion.plan)
        if line is None:
            return in_cylinder(motion, cylinder_in(cylinder, motion.plan), acting)
        if circuit or side:
            says = f"{motion.plan.title}: pressure({cylinder}): {cylinder} is a line, of one pressure"
            raise DefinitionError(f"{says}; leave circuit= and side= out.")
        return line.line_pressure(motion, acting) + np.zeros(motion.shape)

    def examine(plan: Plan) -> None:
        if line_in(cylinder, plan) is None and circuit:
            circuit_with(plan, cylinder, circuit, "pressure")
        elif line_in(cylinder, plan) is None and not lines_by_side(cylinder_in(cylinder, plan), plan):
            circuit_having(cylinder_in(cylinder, plan), plan)

    def directions(plan: Plan) -> tuple[str, ...]:
        is_driven = is_needed and line_in(cylinder, plan) is None
        return cylinder_on(cylinder, circuit, plan, "pressure").driven if is_driven else (*DIRECTIONS[1:], FRICTIONLESS)

    def pieces(request: LawRequest, plan: Plan) -> tuple[SmoothPiece, ...]:
        if line_in(cylinder, plan) is not None:
            return (SmoothPiece(request),)
        on_side = partial(pressure_request, cylinder, request.situation, circuit, is_needed=is_needed)
        ram = cylinder_in(cylinder, plan)
        own = cylinder_on(cylinder, circuit, plan, "pressure").side if circuit and ram.side == "both" else ""
        sides: Sequence[str] = [own] if own in SIDES else ram.own_sides
        sides = [side] if side else [DRIVING.get(request.situation.direction or "", "")] if is_needed else sides
        plan = plan_in_case(plan, request.situation)
        members = plan.members
        line = circuit_with(plan, ram, circuit, "pressure") if circuit else circuit_having(ram, plan, False)
        sides = sides if side or is_needed else [each for each in sides if line_beside(ram, each, line, members) is None]
        if not side and not is_needed and any(is_among(ram, each.feeds(members)) for each in circuits_among(members)):
            return in_stages(cylinder, plan, SmoothPiece(request, ram.side))
        if not (side or circuit) and line is not None and line.kind_in(members) == "closed":
            return in_stages(cylinder, plan, SmoothPiece(request))
        return in_stages(cylinder, plan, *(SmoothPiece(on_side(each), each, below=on_side(each, below=True), bound=1.0) for each in sides))

    kinds = " ".join(["needed"] * is_needed + ["below zero"] * below) or None
    options = (side and f"side={side}") or None, kinds
    found = circuit_request("pressure", cylinder, acting, circuit, in_cylinder, options, "pressure")

    def cases_in(plan: Plan, case: str) -> bool:
        if circuit and side:
            return is_free(cylinder, side, circuit, plan, case)
        return line_in(cylinder, plan) is not None or found.occurs_in(plan, case)

    return replace(found, formula=formula, examine=examine, directions=directions, pieces_in=pieces, cases_in=cases_in)


def is_free(cylinder: str | Ram, side: str | None, circuit: Circuits, plan: Plan, case: str) -> bool:
    """Return whether no line beside a circuit keeps a side of a cylinder at its own pressure in a load case: it holds what it must."""
    ram = cylinder_in(cylinder, plan)
    return line_beside(ram, side, circuit_with(plan, ram, circuit, "pressure"), members_in(plan, case)) is None


def left_request(cylinder: str | Ram, acting: Acting, circuit: Circuits, behind: str | None) -> LawRequest:
    """Return the request for the thrust that the side that works has to hold alone [N], where another line keeps the side `behind`.

    Below zero nothing holds it. It is judged in the load cases in which that line is open.
    """

    def left(motion: AnyMotion, ram: Ram, acting: Acting) -> Array:
        line = circuit_with(motion.plan, ram, circuit, "holding")
        return np.asarray(ram.sized(motion).sense * line_thrust(ram, line, motion, acting))[()]

    found = circuit_request("holding", cylinder, acting, circuit, left, (), "force")
    return replace(found, cases_in=lambda plan, case: not is_free(cylinder, behind, circuit, plan, case))


def line_in(named: str | Ram, plan: Plan) -> Circuit | None:
    """Return the line that a name stands for in a plan; None where it is a cylinder's."""
    found = plan.members.get(named) if isinstance(named, str) else None
    return found if isinstance(found, Circuit) else None


DRIVING: Mapping[str, str] = MappingProxyType({"extending": PISTON, "retracting": ROD})
"""The side that drives a cylinder in a direction."""


# The reserve.


def reserve(
    cylinder: Reference, *, case: Case = None, circuit: Reference | None = None, direction: str | None = None, acting: Acting | None = None
) -> LawRequest:
    """Return the request for the greatest rod force over the needed one: `circuit.reserve(motion, cylinder=lift, case=..., direction=...)`.

    NaN where the load drives, which is not limited by this cylinder and counts in no least value. Where it is judged, of a cylinder that
    works with both sides each counts while it moves against the load.

    Parameters
    ----------
    cylinder : str or Ram
        The cylinder, or its name.
    case : LoadCase or str, optional
        A load case, or its name.
    circuit : str or circuit, optional
        The circuit that feeds the cylinder; by default its only one.
    direction : str, optional
        "extending" while the stroke grows, "retracting", or "frictionless".
    acting : Acting, optional
        Loads, load case, direction and rates in one.

    Returns
    -------
    Request
        The ratio of the forces.
    """
    given = situation_of("reserve", acting, case=case, direction=direction)
    return reserve_request(name_of(cylinder), given, "" if circuit is None else name_of(circuit))


def reserve_request(cylinder: str | Ram, acting: Acting, circuit: Circuits = "", *, is_judged: bool = False) -> LawRequest:
    """Return the request for the greatest rod force over the needed one; of one that is judged, while it moves against the load.

    Its smooth piece is that of the side that drives, whose inverse goes on smoothly where the load drives.
    """

    def lifting(line: LiftLine, motion: AnyMotion, ram: Ram, acting: Acting) -> Acting:
        """Return a situation in which a cylinder of several goes its working way: past its dead point the line drives it the other way."""
        is_working = ram.side != "both" and acting.direction == ram.driven[0] and len(line.rams(motion)) > 1
        return replace(acting, direction=None) if is_working else acting

    def work_of(line: LiftLine, motion: AnyMotion, ram: Ram, acting: Acting) -> tuple[Work, Array]:
        """Return the cylinder's work, and a value above zero where it drives [N]: the thrust in its direction if that is judged."""
        work = line.work_of_all(line.one(motion, ram), motion, lifting(line, motion, ram, acting))
        return work, work.along * np.where(work.supplied, 1.0, -1.0) if is_judged else work.force

    def over_needed(motion: AnyMotion, ram: Ram, acting: Acting) -> Array:
        line = circuit_with(motion.plan, ram, circuit, "reserve")
        work, against = work_of(line, motion, ram, acting)
        with np.errstate(invalid="ignore"):
            return np.asarray(line.most(motion, work) / only_where(against > 0.0, work.force))[()]

    def is_driven(motion: AnyMotion, ram: Ram, acting: Acting) -> Mask:
        work, against = work_of(circuit_with(motion.plan, ram, circuit, "reserve"), motion, ram, acting)
        return np.asarray(np.isfinite(work.thrust) & ~(against > 0.0))

    def use(motion: AnyMotion, ram: Ram, acting: Acting) -> Array:
        """Return one over the reserve of the side that drives a cylinder in a direction; below zero where the load drives."""
        line, sense = circuit_with(motion.plan, ram, circuit, "reserve"), 1.0 if acting.direction == "extending" else -1.0
        work = work_of(line, motion, ram, acting)[0]
        driving = line.driving(line.one(motion, ram), motion, sense, acting.direction)
        return np.asarray(sense * work.leads * work.turn * work.along / (work.k_m * line.most(motion, driving)) * driving.leads)[()]

    def directions(plan: Plan) -> tuple[str, ...]:
        return cylinder_on(cylinder, circuit, plan, "reserve").driven

    def pieces(request: LawRequest, plan: Plan) -> tuple[SmoothPiece, ...]:
        acting = request.situation
        if acting.direction not in directions(plan):
            return in_stages(cylinder, plan, SmoothPiece(request))
        inverse = circuit_request("reserve", cylinder, acting, circuit, use, ("its inverse",))
        inverse = replace(inverse, cases_in=partial(moves_in, cylinder))
        judged = reserve_request(cylinder, acting, circuit, is_judged=True)
        return in_stages(cylinder, plan, SmoothPiece(judged, DRIVING.get(acting.direction or "", ""), inverse))

    against = "against the load" if is_judged else None
    return replace(
        circuit_request("reserve", cylinder, acting, circuit, over_needed, (against,), "number"),
        directions=directions, pieces_in=pieces, cases_in=partial(moves_in, cylinder),
        unlimited_in=partial(formula_of_cylinder, is_driven, cylinder),
    )  # fmt: skip


# Going back.


def going_back_request(
    cylinder: str | Ram, acting: Acting, circuit: Circuits, way: str, resistance: float = 0.0, tells: str = "push"
) -> LawRequest:
    """Return the request for the pressure on the other side while a cylinder goes back against a resistance [Pa].

    `way` is "extending" or "retracting"; `tells="load"` asks for what the load alone makes in the side that empties, "whole push" for what
    the other side must give with what a tank has there.
    """

    def over(motion: AnyMotion, ram: Ram, acting: Acting) -> Array:
        line = circuit_with(motion.plan, ram, circuit, "going back")
        working, push, tank = way_back(ram, line, motion, acting, way, resistance, line.efficiency(motion, "mechanical"))
        return working if tells == "load" else push + tank if tells == "whole push" else push

    def goes_another_way(motion: AnyMotion, ram: Ram, acting: Acting) -> Mask:
        goes = ram.goes(motion, replace(acting, direction=None))
        return np.zeros(motion.shape, bool) if goes is None else np.asarray(goes != SENSES[way])

    def pieces(request: LawRequest, plan: Plan) -> tuple[SmoothPiece, ...]:
        return in_stages(cylinder, plan, SmoothPiece(request))

    found = circuit_request("going back", cylinder, acting, circuit, over, (way, resistance, tells), "pressure")
    return replace(
        found, directions=(way,), pieces_in=pieces, cases_in=partial(moves_in, cylinder),
        unlimited_in=partial(formula_of_cylinder, goes_another_way, cylinder),
    )  # fmt: skip


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

    Parameters
    ----------
    cylinder : str or Ram
        The cylinder, or its name.
    point : str or Point
        The point, or its name.
    along : tuple
        The direction against which the load pulls, two numbers or quantities.
    share : float
        The part of the drive's force that counts, 0 to 1.
    case : LoadCase or str, optional
        A load case, or its name.
    circuit : str or circuit, optional
        The circuit that feeds the cylinder; by default its only one.
    acting : Acting, optional
        Loads, load case, direction and rates in one.

    Returns
    -------
    Request
        The load [N].
    """
    proper_share(share)
    given, unit = situation_of("capacity", acting, case=case), pull_direction(along)
    return capacity_request(name_of(cylinder), given, "" if circuit is None else name_of(circuit), name_of(point), unit, float(share))


def capacity_request(
    cylinder: str | Ram, acting: Acting, circuit: Circuits, point: str, along: Direction, share: float, limit: int | None = None
) -> LawRequest:
    """Return the request for the largest load at a point that the pump lifts, along a direction of length one.

    `limit` is the number of the one thing that limits it: of members' conditions in their order, else the pump; None for all of them.
    What the pump lifts, and what each member's condition leaves, are smooth pieces.
    """

    def lifted(motion: AnyMotion, ram: Ram, acting: Acting) -> Array:
        line = circuit_with(motion.plan, ram, circuit, "capacity")
        return line.lifted(motion, point, along=along, share=share, cylinder=ram, acting=acting, limit=limit)

    def is_driven(motion: AnyMotion, ram: Ram, acting: Acting) -> Mask:
        """Return the mask of poses at which the load drives or does nothing, so that the capacity has no bound."""
        thrust = member_thrust(motion, ram, Acting(acting.loads, acting.case))
        return np.asarray(np.isfinite(thrust) & np.isnan(lifted(motion, ram, acting)))

    def examine(plan: Plan) -> None:
        circuit_with(plan, cylinder, circuit, "capacity")
        known_name("Point", point, plan.points, where=plan.title)

    def pieces(request: LawRequest, plan: Plan) -> tuple[SmoothPiece, ...]:
        count = len(member_limits(plan, request.situation.case))
        if not count:
            return in_stages(cylinder, plan, SmoothPiece(request))
        alone = [capacity_request(cylinder, request.situation, circuit, point, along, share, number) for number in range(count + 1)]
        of_pump = in_stages(cylinder, plan, SmoothPiece(alone[count], bound=-1.0))
        return (*of_pump, *(SmoothPiece(each, bound=-1.0) for each in alone[:count]))

    words = direction_words(along)
    options = None if words == "(0, 1)" else f"along={words}", None if share == 1.0 else f"share={share:g}"
    found = cylinder_request("capacity", cylinder, acting, lifted, (point, circuit_shown(circuit)), options, measures="force")
    return replace(
        found, known=found.known if limit is None else (found.known, limit), directions=(), examine=examine,
        pieces_in=pieces if limit is None else None, unlimited_in=partial(formula_of_cylinder, is_driven, cylinder),
    )  # fmt: skip


# The use of a rod.


def buckling(cylinder: Reference, *, case: Case = None, direction: str | None = None, acting: Acting | None = None) -> LawRequest:
    """Return the request for the utilisation of a rod: `lift.buckling_use(motion, case=..., direction=...)`, at most 1 where it holds.

    Parameters
    ----------
    cylinder : str or Ram
        The cylinder, or its name.
    case : LoadCase or str, optional
        A load case, or its name.
    direction : str, optional
        "extending" while the stroke grows, "retracting", or "frictionless".
    acting : Acting, optional
        Loads, load case, direction and rates in one.

    Returns
    -------
    Request
        The utilisation.
    """
    return buckling_request(name_of(cylinder), situation_of("buckling", acting, case=case, direction=direction))


# A condition of a search.


@record
class Fits(Condition):
    """A cylinder's closed and open length serve the whole stroke, and it comes out by no more than it is long closed."""

    cylinder: str

    def constraints(self, machine: Mechanism) -> tuple[Constraint, ...]:
        plan = machine.plan
        ram = found_in(plan.members, self.cylinder, plan.title)
        length, name = distance(ram.A, ram.B), ram.name
        strokes, closed = ([at(each) for each in ram.lengths_named(said)] for said in ("stroke", "closed"))
        ensure(strokes, f"{plan.title}: fits({name}): {name} says no stroke; declare it, Cylinder(..., closed=0.5, stroke=0.25).")
        if not closed:
            return (most(length) - least(length) <= strokes[0],)
        opened = reduce(add, [closed[0], *strokes])
        return least(length) >= closed[0], most(length) <= opened, *(stroke <= closed[0] for stroke in strokes)

    def __str__(self) -> str:
        return f"fits({self.cylinder})"


def fits(cylinder: Reference) -> Fits:
    """Return the condition that a cylinder's closed and open length serve the whole stroke of a machine; `Cylinder.fits` tells by how much.

    With its stroke alone declared that is compared with the travel. Its `closed` and `stroke` may be varied: `"lift.closed"`.

    Parameters
    ----------
    cylinder : str or Ram
        The cylinder, or its name.

    Returns
    -------
    Fits
        The condition.
    """
    return Fits(name_of(cylinder))


# While a machine runs: how cylinders move, the power that they give and the oil that they take.


def rate(cylinder: Reference) -> LawRequest:
    """Return the request for how fast a cylinder extends while a machine runs.

    Parameters
    ----------
    cylinder : Reference
        A cylinder, or its name.

    Returns
    -------
    LawRequest
        The rate of its length [m/s], below zero while it retracts.
    """
    return rate_request(name_of(cylinder))


def power(cylinder: Reference, *, case: Case = None, acting: Acting | None = None) -> LawRequest:
    """Return the request for the power that a cylinder gives while a machine runs.

    Parameters
    ----------
    cylinder : Reference
        A cylinder, or its name.
    case : LoadCase or str, optional
        The load case.
    acting : Acting, optional
        Loads, case and what else acts, in one.

    Returns
    -------
    LawRequest
        Its thrust times its rate [W], below zero where the load drives it.
    """

    def over(motion: AnyMotion, ram: Ram, acting: Acting) -> Array:
        return member_thrust(motion, ram, acting) * ram.growth(motion, own_rates(motion, f"power({ram.name})", acting))

    return cylinder_request("power", name_of(cylinder), situation_of("power", acting, case=case), over, measures="power")


def flow(line: Reference) -> LawRequest:
    """Return the request for the oil that a line gives to its cylinders while a machine runs.

    Parameters
    ----------
    line : Reference
        A LiftCircuit, an OilLine or another line, or its name.

    Returns
    -------
    LawRequest
        The flow [m3/s], below zero where oil comes back. A circuit whose cylinder works with both sides gives oil either way.
    """
    name = name_of(line)

    def found(plan: Plan) -> Circuit:
        known = plan.members.get(name)
        if not isinstance(known, Circuit):
            lines = ", ".join(plan.of_kind(Circuit)) or "none is declared"
            raise DefinitionError(f"{plan.title}: flow({name}): the name of a line is expected: {lines}.")
        refuse_gas(known, plan)
        return known

    def over(motion: AnyMotion) -> Array:
        filled, rates = found(motion.plan).filling(motion.plan.members), own_rates(motion, f"flow({name})")
        taken = [chamber_area(chamber, ram, motion) * ram.growth(motion, rates) for ram, chamber in filled]
        both = [ram.name for ram, _ in filled if ram.works_both]  # where a spool has both sides the pump is on those that grow
        return reduce(np.add, [np.maximum(each, 0.0) for each in taken] if len({*both}) < len(both) else taken)

    return LawRequest(formula=over, text=f"flow({name})", known=("flow", name), measures="flow", examine=found)
