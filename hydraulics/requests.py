"""What cylinders carry, as something to ask for: in `evaluate`, `function`, `gradient`, in studies and searches, and of a motion.

Each is the cylinder's or the circuit's own method, read pose by pose: `motion[pressure("lift")]` is `lift.pressure(motion)`.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Hashable
from dataclasses import dataclass, replace
from typing import Self, cast, final

import numpy as np

from linkage.errors import DefinitionError, known_name, unknown
from linkage.mechanism import Mechanism
from linkage.motion import require_motion
from linkage.motion.grid import MotionLike
from linkage.plan import Mask, Plan
from linkage.quantities import Quantity, Reference, distance, name_of, quantity
from linkage.statics import AnyMotion, Case, LawRequest, case_words, loads_identity, same
from linkage.study import at, least, most
from linkage.study.measures import Condition, Constraint

from .inputs import Array, follows
from .lift import LiftCircuit, direction_of, proper_share
from .member import DIRECTIONS, Cylinder, circuit_having, found_in


@dataclass(frozen=True, eq=False)
class CylinderRequest(LawRequest):
    """The base of what is asked of one cylinder of a class, by its name, in a load case."""

    cylinder: str
    case: Case = None

    def identity(self, plan: Plan) -> Hashable:
        loads = loads_identity(None, self.case)
        return None if loads is None else (type(self).__name__, self.cylinder, *self.options, loads)

    @property
    def options(self) -> tuple[Hashable, ...]:
        """What it is asked with, beside the load case."""
        return ()

    def in_case(self, case: object) -> Self:
        return self if self.case is not None else replace(self, case=cast(Case, case))

    def examine(self, plan: Plan) -> None:
        self.ram(plan)

    def ram(self, plan: Plan) -> Cylinder:
        """Return the cylinder that is meant, as a plan has it."""
        return found_in(plan.members, self.cylinder, plan.title)

    def __str__(self) -> str:
        given = [str(each) for each in self.options if each is not None]
        return f"{self.word}({', '.join([self.cylinder, *given, *case_words(self.case)])})"

    @property
    @abstractmethod
    def word(self) -> str:
        """The function that makes it."""


@final
@dataclass(frozen=True, eq=False)
class Thrust(CylinderRequest):
    """What a cylinder carries."""

    direction: str = "frictionless"
    word = "thrust"
    measures = "force"

    @property
    def options(self) -> tuple[Hashable, ...]:
        return (None if self.direction == "frictionless" else self.direction,)

    def law(self, motion: AnyMotion) -> Array:
        return self.ram(motion.plan).thrust(motion, case=self.case, direction=self.direction)


def thrust(cylinder: Reference, *, case: Case = None, direction: str = "frictionless") -> Thrust:
    """Return the request for what a cylinder carries [N], positive where it pushes: `lift.thrust(motion, case=..., direction=...)`.

    With declared friction and a direction it has values and no derivatives.
    """
    return Thrust(name_of(cylinder), case, known_name("Direction", direction, DIRECTIONS))


@dataclass(frozen=True, eq=False)
class CircuitRequest(CylinderRequest):
    """The base of what is asked of a cylinder on the circuit that feeds it: the only one that has it, unless one is named."""

    circuit: str = ""

    @property
    def options(self) -> tuple[Hashable, ...]:
        return ((self.circuit and f"circuit={self.circuit}") or None,)

    def examine(self, plan: Plan) -> None:
        self.circuit_of(plan)

    def circuit_of(self, plan: Plan) -> LiftCircuit:
        """Return the circuit that is meant; DefinitionError where none or several have the cylinder, or the one named has not."""
        circuits, ram = plan.of_kind(LiftCircuit), self.ram(plan)
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
    """The pressure on a cylinder's working side."""

    direction: str | None = None
    word = "pressure"
    measures = "pressure"

    @property
    def options(self) -> tuple[Hashable, ...]:
        return *super().options, self.direction

    def examine(self, plan: Plan) -> None:
        if self.circuit:
            self.circuit_of(plan)
        else:
            circuit_having(self.ram(plan), plan)

    def law(self, motion: AnyMotion) -> Array:
        ram = self.ram(motion.plan)
        if self.circuit:
            return self.circuit_of(motion.plan).pressure_in(ram, motion, None, self.case, self.direction)
        return ram.pressure(motion, case=self.case, direction=self.direction)


def pressure(cylinder: Reference, *, case: Case = None, circuit: Reference | None = None, direction: str | None = None) -> Pressure:
    """Return the request for the pressure on the side that works [Pa gauge]: `lift.pressure(motion, case=..., direction=...)`.

    It is that of the cylinder's one circuit, efficiencies and back pressure included; `circuit` names one of several LiftCircuits.
    """
    return Pressure(name_of(cylinder), case, circuit_name(circuit), known_direction(direction))


def known_direction(direction: str | None) -> str | None:
    """Return a direction or none; DefinitionError for any other word."""
    return direction if direction is None else known_name("Direction", direction, DIRECTIONS)


def circuit_name(circuit: Reference | None) -> str:
    """Return the name of a circuit; "" where none is named."""
    return "" if circuit is None else name_of(circuit)


def without_limit(request: CircuitRequest, motion: MotionLike) -> Mask:
    """Return the mask of poses at which a cylinder carries something and what is asked of it has no value: the load drives there."""
    carried, value = (require_motion(motion)._requested(each) for each in (Thrust(request.cylinder, request.case), request))
    return np.asarray(np.isfinite(carried) & np.isnan(value))


@final
@dataclass(frozen=True, eq=False)
class Reserve(CircuitRequest):
    """The greatest rod force over the needed one."""

    direction: str | None = None
    word = "reserve"

    @property
    def options(self) -> tuple[Hashable, ...]:
        return *super().options, self.direction

    def law(self, motion: AnyMotion) -> Array:
        circuit, ram = self.circuit_of(motion.plan), self.ram(motion.plan)
        return circuit.reserve(motion, cylinder=ram, case=self.case, direction=self.direction)

    def unlimited(self, motion: MotionLike) -> Mask:
        return without_limit(self, motion)


def reserve(cylinder: Reference, *, case: Case = None, circuit: Reference | None = None, direction: str | None = None) -> Reserve:
    """Return the request for the greatest rod force over the needed one: `circuit.reserve(motion, cylinder=lift, case=..., direction=...)`.

    NaN where the load drives, which is not limited by this cylinder and counts in no least value.
    """
    return Reserve(name_of(cylinder), case, circuit_name(circuit), known_direction(direction))


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

    def examine(self, plan: Plan) -> None:
        super().examine(plan)
        known_name("Point", self.point, plan.points, where=plan.title)

    def law(self, motion: AnyMotion) -> Array:
        circuit, ram = self.circuit_of(motion.plan), self.ram(motion.plan)
        return circuit.capacity(motion, self.point, along=self.along, share=self.share, cylinder=ram, case=self.case)

    def unlimited(self, motion: MotionLike) -> Mask:
        return without_limit(self, motion)


def capacity(
    cylinder: Reference,
    point: Reference,
    *,
    along: tuple[float, float] = (0.0, 1.0),
    share: float = 1.0,
    case: Case = None,
    circuit: Reference | None = None,
) -> Capacity:
    """Return the request for the largest load [N] at a point that the pump lifts beside the machine's own: `circuit.capacity(motion, "G")`.

    NaN where the load drives or does nothing, which is not limited by this cylinder and counts in no least value.
    """
    proper_share(share)
    x, y = direction_of(along)
    return Capacity(name_of(cylinder), case, circuit_name(circuit), name_of(point), (float(x) + 0.0, float(y) + 0.0), float(share))


@final
@dataclass(frozen=True, eq=False)
class BucklingUse(CylinderRequest):
    """How far a cylinder's rod is used against buckling."""

    direction: str | None = None
    word = "buckling"

    @property
    def options(self) -> tuple[Hashable, ...]:
        return (self.direction,)

    def law(self, motion: AnyMotion) -> Array:
        return self.ram(motion.plan).buckling_use(motion, case=self.case, direction=self.direction)


def buckling(cylinder: Reference, *, case: Case = None, direction: str | None = None) -> BucklingUse:
    """Return the request for the utilisation of a rod: `lift.buckling_use(motion, case=..., direction=...)`, at most 1 where it holds."""
    return BucklingUse(name_of(cylinder), case, known_direction(direction))


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
