"""What cylinders carry, as something to ask for: in `evaluate`, `function`, `gradient`, in studies and searches, and of a motion.

Each is the cylinder's or the circuit's own method, read pose by pose: `motion[pressure("lift")]` is `lift.pressure(motion)`.
"""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass, replace
from typing import cast, final

import numpy as np

from linkage.errors import DefinitionError, known_name, unknown
from linkage.loads import DIRECTIONS, Acting, Case, situation_of
from linkage.mechanism import Mechanism
from linkage.motion import Condition, Constraint, SmoothPiece, at, least, most, require_motion
from linkage.motion.grid import MotionLike
from linkage.plan import Mask, Plan
from linkage.quantities import Quantity, Reference, distance, name_of, quantity
from linkage.statics import AnyMotion, member_thrust, same

from .cylinder import CylinderSize
from .inputs import Array, direction_of, follows, only_where, proper_share
from .line import LiftLine, WayBack, Work
from .member import PISTON, ROD, SIDES, BucklingUse, Circuit, CylinderRequest, Thrust, circuit_having, found_in


def thrust(cylinder: Reference, *, case: Case = None, direction: str | None = None, acting: Acting | None = None) -> Thrust:
    """Return the request for what a cylinder carries [N], positive where it pushes: `lift.thrust(motion, case=..., direction=...)`.

    `acting` says case and direction in one, with loads and rates too. With declared friction and a direction it has values and no
    derivatives.
    """
    return Thrust(name_of(cylinder), situation_of("thrust", acting, case=case, direction=direction))


@dataclass(frozen=True, eq=False)
class CircuitRequest(CylinderRequest):
    """The base of what is asked of a cylinder on the circuit that feeds it: the only one that has it, unless one is named."""

    circuit: str | LiftLine = ""

    @property
    def options(self) -> tuple[Hashable, ...]:
        named = self.circuit if isinstance(self.circuit, str) else self.circuit.name or self.circuit
        return (f"circuit={named}" if isinstance(named, str) and named else named or None), self.acting.direction

    def examine(self, plan: Plan) -> None:
        self.circuit_of(plan)

    def circuit_of(self, plan: Plan) -> LiftLine:
        """Return the circuit that is meant; DefinitionError where none or several have the cylinder, or the one named has not."""
        circuits, ram = plan.of_kind(LiftLine), self.ram(plan)
        if not isinstance(self.circuit, str):
            return self.circuit
        if self.circuit and self.circuit not in circuits:
            raise unknown("LiftCircuit", self.circuit, circuits, where=plan.title)
        having = {name: each for name, each in circuits.items() if any(same(ram, one) for one in each.members(plan.members))}
        if self.circuit and self.circuit not in having:
            raise DefinitionError(f"{plan.title}: {self.circuit} does not feed {ram.name}; that is on {', '.join(having) or 'none'}.")
        if self.circuit or len(having) == 1:
            return having[self.circuit or next(iter(having))]
        if having:
            raise DefinitionError(f"{plan.title}: {ram.name} is on {len(having)} circuits; say circuit= one of {', '.join(having)}.")
        remedy = f"declare one, circuit = LiftCircuit({ram.name}, pressure=...)"
        raise DefinitionError(f"{plan.title}: {self.word}({ram.name}): no LiftCircuit has it, whose pump and relief count; {remedy}.")


@final
@dataclass(frozen=True, eq=False)
class Pressure(CircuitRequest):
    """The pressure in a cylinder: on the side that works, or on one side.

    One that `is_needed` is that of the pump while it drives the cylinder, on the side that does.
    """

    side: str = ""
    is_needed: bool = False
    below: bool = False
    word = "pressure"
    measures = "pressure"

    @property
    def options(self) -> tuple[Hashable, ...]:
        kinds = ["needed"] * self.is_needed + ["below zero"] * self.below
        return *super().options, (self.side and f"side={self.side}") or None, " ".join(kinds) or None

    def examine(self, plan: Plan) -> None:
        if self.circuit:
            self.circuit_of(plan)
        else:
            circuit_having(self.ram(plan), plan)

    def movements(self, plan: Plan, rubs: bool) -> tuple[str, ...]:
        return self.ram(plan).driven if self.is_needed else DIRECTIONS

    def pieces(self, plan: Plan) -> tuple[SmoothPiece, ...]:
        if self.side:
            return (self.piece_on(self.side),)
        ram = self.ram(plan)
        if self.is_needed:
            return (self.piece_on(driving_side(self.acting.direction)),)
        if any(same(ram, one) for each in plan.of_kind(Circuit).values() for one in each.feeds(plan.members)):
            return (SmoothPiece(self, ram.works),)
        return tuple(self.piece_on(side) for side in SIDES)

    def piece_on(self, side: str) -> SmoothPiece:
        """Return the piece of one side."""
        return SmoothPiece(replace(self, side=side), side, below=replace(self, side=side, below=True))

    def law(self, motion: AnyMotion) -> Array:
        ram, given = self.ram(motion.plan), self.acting
        circuit = self.circuit_of(motion.plan) if self.circuit else None
        if not self.side:
            if circuit is not None:
                return circuit.pressure_in(ram, motion, given)
            return ram.pressure(motion, acting=given)
        return ram.pressure_on(self.side, motion, given, circuit, below=self.below)


def pressure(
    cylinder: Reference,
    *,
    case: Case = None,
    circuit: Reference | None = None,
    direction: str | None = None,
    side: str = "",
    acting: Acting | None = None,
) -> Pressure:
    """Return the request for the pressure in a cylinder [Pa gauge]: `lift.pressure(motion, case=..., direction=...)`.

    It is that of the cylinder's one circuit, efficiencies and back pressure included; `circuit` names one of several LiftCircuits.
    Of the side that works; `side="piston"` or `side="rod"` asks for one side, 0 where the other one holds. Where it is judged both count.
    """
    if side:
        known_name("Side", side, SIDES)
    return Pressure(name_of(cylinder), situation_of("pressure", acting, case=case, direction=direction), circuit_name(circuit), side)


def circuit_name(circuit: Reference | None) -> str:
    """Return the name of a circuit; "" where none is named."""
    return "" if circuit is None else name_of(circuit)


@final
@dataclass(frozen=True, eq=False)
class Reserve(CircuitRequest):
    """The greatest rod force over the needed one; of one that is judged, while it moves against the load.

    `bore` [m] is another one tried in the place of the cylinder's own.
    """

    is_judged: bool = False
    bore: float = 0.0
    word = "reserve"

    @property
    def options(self) -> tuple[Hashable, ...]:
        tried = f"bore={self.bore:g}" if self.bore else None
        return *super().options, "against the load" if self.is_judged else None, tried

    def movements(self, plan: Plan, rubs: bool) -> tuple[str, ...]:
        return self.ram(plan).driven

    def pieces(self, plan: Plan) -> tuple[SmoothPiece, ...]:
        if self.acting.direction not in self.ram(plan).driven:
            return (SmoothPiece(self),)
        use = Use(self.cylinder, self.acting, self.circuit, self.bore)
        return (SmoothPiece(replace(self, is_judged=True), driving_side(self.acting.direction), use),)

    def law(self, motion: AnyMotion) -> Array:
        circuit, given = self.circuit_of(motion.plan), self.acting
        if not (self.is_judged or self.bore):
            return circuit.reserve(motion, cylinder=self.ram(motion.plan), acting=given)
        work = self.work(motion)
        with np.errstate(invalid="ignore"):
            return np.asarray(circuit.most(motion, work) / only_where(self.against(work) > 0.0, work.force))[()]

    def against(self, work: Work) -> Array:
        """Return what is above zero where the cylinder has to drive [N]: the thrust in its direction where that is judged."""
        return work.thrust * work.sense if self.is_judged else work.force

    def work(self, motion: AnyMotion) -> Work:
        """Return what the cylinder has to do, with another bore where one is tried."""
        found = self.circuit_of(motion.plan).work(motion, cylinder=self.ram(motion.plan), acting=self.acting)
        return replace(found, size=CylinderSize(self.bore, found.size.rod, found.size.count, found.size.works)) if self.bore else found

    def unlimited(self, motion: MotionLike) -> Mask:
        work = self.work(require_motion(motion))
        return np.asarray(np.isfinite(work.thrust) & ~(self.against(work) > 0.0))


@final
@dataclass(frozen=True, eq=False)
class Use(CircuitRequest):
    """One over the reserve of the side that drives a cylinder in a direction; below zero where the load drives."""

    bore: float = 0.0
    word = "use"

    @property
    def options(self) -> tuple[Hashable, ...]:
        return *super().options, self.bore

    def law(self, motion: AnyMotion) -> Array:
        circuit, given, ram = self.circuit_of(motion.plan), self.acting, self.ram(motion.plan)
        size, k_m = ram.sized(motion), circuit.efficiency(motion, "mechanical")
        size = CylinderSize(self.bore, size.rod, size.count, size.works) if self.bore else size
        thrust = member_thrust(motion, ram, given)
        sense = 1.0 if given.direction == "extending" else -1.0
        most = circuit.most(motion, Work(np.asarray(sense), np.asarray(sense), size, k_m))
        return np.asarray(sense * thrust / (k_m * most))[()]


def reserve(
    cylinder: Reference, *, case: Case = None, circuit: Reference | None = None, direction: str | None = None, acting: Acting | None = None
) -> Reserve:
    """Return the request for the greatest rod force over the needed one: `circuit.reserve(motion, cylinder=lift, case=..., direction=...)`.

    NaN where the load drives, which is not limited by this cylinder and counts in no least value. Where it is judged, of a cylinder that
    works with both sides each counts while it moves against the load.
    """
    return Reserve(name_of(cylinder), situation_of("reserve", acting, case=case, direction=direction), circuit_name(circuit))


def driving_side(direction: str | None) -> str:
    """Return the side that drives a cylinder in a direction."""
    return {"extending": PISTON, "retracting": ROD}.get(direction or "", "")


@final
@dataclass(frozen=True, eq=False)
class GoingBack(CircuitRequest):
    """What the other side must give while a cylinder goes back against a resistance [Pa]; `tells="load"` what the load alone makes."""

    way: str = "retracting"
    resistance: float = 0.0
    tells: str = "push"
    word = "going back"
    measures = "pressure"

    @property
    def options(self) -> tuple[Hashable, ...]:
        return *super().options, self.way, self.resistance, self.tells

    def movements(self, plan: Plan, rubs: bool) -> tuple[str, ...]:
        return (self.way,)

    def law(self, motion: AnyMotion) -> Array:
        ram, given, k_m = self.ram(motion.plan), self.acting, self.circuit_of(motion.plan).efficiency(motion, "mechanical")
        found = WayBack.of(ram, motion, given, self.way, self.resistance, k_m)
        return found.working if self.tells == "load" else found.push


@final
@dataclass(frozen=True, eq=False)
class Capacity(CircuitRequest):
    """The largest load at a point that the pump lifts."""

    point: str = ""
    along: tuple[float, float] = (0.0, 1.0)
    share: float = 1.0
    word = "capacity"
    measures = "force"

    @property
    def options(self) -> tuple[Hashable, ...]:
        along = None if self.along == (0.0, 1.0) else f"along=({self.along[0]:g}, {self.along[1]:g})"
        return self.point, *super().options, along, None if self.share == 1.0 else f"share={self.share:g}"

    def movements(self, plan: Plan, rubs: bool) -> tuple[str, ...]:
        return ()

    def examine(self, plan: Plan) -> None:
        super().examine(plan)
        known_name("Point", self.point, plan.points, where=plan.title)

    def law(self, motion: AnyMotion) -> Array:
        circuit, ram = self.circuit_of(motion.plan), self.ram(motion.plan)
        return circuit.capacity(motion, self.point, along=self.along, share=self.share, cylinder=ram, acting=self.acting)

    def unlimited(self, motion: MotionLike) -> Mask:
        thrust = member_thrust(require_motion(motion), self.ram(motion.plan), Acting(self.acting.loads, self.acting.case))
        return np.asarray(np.isfinite(thrust) & np.isnan(self.of(motion)))


def capacity(
    cylinder: Reference,
    point: Reference,
    *,
    along: tuple[float, float] = (0.0, 1.0),
    share: float = 1.0,
    case: Case = None,
    circuit: Reference | None = None,
    acting: Acting | None = None,
) -> Capacity:
    """Return the request for the largest load [N] at a point that the pump lifts beside the machine's own: `circuit.capacity(motion, "G")`.

    NaN where the load drives or does nothing, which is not limited by this cylinder and counts in no least value.
    """
    proper_share(share)
    x, y = direction_of(along)
    given, unit = situation_of("capacity", acting, case=case), (float(x) + 0.0, float(y) + 0.0)
    return Capacity(name_of(cylinder), given, circuit_name(circuit), name_of(point), unit, float(share))


def buckling(
    cylinder: Reference, *, case: Case = None, direction: str | None = None, acting: Acting | None = None
) -> BucklingUse:
    """Return the request for the utilisation of a rod: `lift.buckling_use(motion, case=..., direction=...)`, at most 1 where it holds."""
    return BucklingUse(name_of(cylinder), situation_of("buckling", acting, case=case, direction=direction))


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
        if ram.stroke is None:
            raise DefinitionError(f"{plan.title}: fits({name}): {name} says no stroke; declare it, Cylinder(..., closed=0.5, stroke=0.25).")
        stroke = at(quantity(cast("Quantity | str", ram.stroke)) if follows(ram.stroke) else f"{name}.stroke")
        if ram.closed is None:
            return (most(length) - least(length) <= stroke,)
        closed = at(quantity(cast("Quantity | str", ram.closed)) if follows(ram.closed) else f"{name}.closed")
        return least(length) >= closed, most(length) <= closed + stroke, stroke <= closed

    def __str__(self) -> str:
        return f"fits({self.cylinder})"


def fits(cylinder: Reference) -> Fits:
    """Return the condition that a cylinder's closed and open length serve the whole stroke of a machine; `Cylinder.fits` tells by how much.

    With its stroke alone declared that is compared with the travel. Its `closed` and `stroke` may be varied: `"lift.closed"`.
    """
    return Fits(name_of(cylinder))
