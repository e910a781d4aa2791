"""The force of a drive as something to ask for: in `evaluate` and `function` at a kernel's speed, in `gradient` with exact derivatives."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, final

from ..motion import Asked, Motion, Wanted
from ..plan import Plan
from ..program import Node, Notes
from .driving import driving_force
from .law import Law
from .loaded import Case, Loads
from .movement import drive_of
from .work import by_work


@final
@dataclass(frozen=True, eq=False)
class DriveForce(Asked):
    """The frictionless force of a drive, as something to ask for."""

    drive: str | None = None
    loads: Loads = None
    case: Case = None

    def settled(self, plan: Plan) -> DriveForceOf:
        drive = drive_of(plan, self.drive)
        law = Law.of(plan, self.loads, self.case)
        return DriveForceOf(self.loads, self.case, drive, law.key, frozenset(law.names), frozenset(law.carriers))


def drive_force(drive: str | None = None, loads: Loads = None, case: Case = None) -> DriveForce:
    """Return the request for the generalised force of a stroke, in `evaluate`, `function` and `gradient`: [N], a crank's torque [Nm].

    It is the frictionless `driving_force(motion, loads, drive, case=case)`: `motion.gradient(drive_force(), wrt=["OB", "load.mass"])`.
    A load's law must be plain arithmetic of numbers at one pose; DefinitionError, with the load's name, where it is not.
    """
    return DriveForce(drive, loads, case)


@dataclass(frozen=True, eq=False)
class ForceOf(Wanted):
    """A force settled: it goes through ratios and angles, and is true while the loads keep to the laws that were traced."""

    loads: Loads
    case: Case

    @property
    def order(self) -> int:
        return 1

    @property
    def may_fail(self) -> bool:
        return True

    @property
    def turns(self) -> bool:
        return True

    def notes(self, plan: Plan) -> Notes:
        return self.laws(plan).notes

    def laws(self, plan: Plan) -> Law:
        """Return the loads traced on a plan's program."""
        return Law.on(plan, self.loads, self.case)


@final
@dataclass(frozen=True, eq=False)
class DriveForceOf(ForceOf):
    """A drive's force settled: its drive, the key of its loads, the members it reads, and those it is differentiated through."""

    drive: str
    law: tuple[Any, ...]
    read: frozenset[str]
    carriers: frozenset[str]

    @property
    def key(self) -> Any:
        return "drive force", self.drive, self.law

    def nodes(self, plan: Plan) -> tuple[Node, ...]:
        law = self.laws(plan)
        (force,) = by_work(law.poses, law.loaded, self.drive)
        return (law.motion.node(force),)

    def names(self, plan: Plan) -> set[str]:
        return set(self.read)

    def steep(self, plan: Plan) -> set[str]:
        return set(self.carriers)

    def refuse(self, motion: Motion) -> None:
        driving_force(motion, self.loads, self.drive, case=self.case)

    def __str__(self) -> str:
        return f"the driving force of {self.drive}"
