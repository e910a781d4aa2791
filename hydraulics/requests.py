"""What cylinders carry, as something to ask for: in `evaluate`, `function`, `gradient`, in studies and searches, and of a motion.

Each is the cylinder's or the circuit's own method, read pose by pose: `motion[pressure("lift")]` is `lift.pressure(motion)`.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Hashable
from dataclasses import dataclass, replace
from typing import Self, cast, final

from linkage.errors import DefinitionError, known_name, unknown
from linkage.plan import Plan
from linkage.quantities import Reference, name_of
from linkage.statics import AnyMotion, Case, LawRequest, case_words, loads_identity, same

from .inputs import Array
from .lift import LiftCircuit
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
