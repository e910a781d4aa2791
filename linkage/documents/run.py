"""What a document looks at: one design, the stroke that moves, and the poses of its table and its curves."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import final

import numpy as np

from ..errors import AssemblyError, DefinitionError, LinkageError, SingularError, cited, unwarned
from ..language import said
from ..loads import ForceElement, LoadCase
from ..mechanism import Mechanism, require_mechanism
from ..motion import Motion, stroke_display_unit
from ..quantities import is_whole
from ..reports import At, Run, run_of
from ..statics import PinForces, pin_forces
from ..units import show

CURVE = 121
"""Poses of a curve."""
TRIED = 9
"""So many poses next to the middle are tried for one that has forces."""
MANY = 2001
"""Rows of a table that one would still print."""


@final
@dataclass(frozen=True, eq=False)
class Looked:
    """A design along one of its strokes, the others held."""

    machine: Mechanism
    run: Run
    count: int
    case: str = ""

    @classmethod
    def at(cls, machine: Mechanism, at: At, count: int, case: object) -> Looked:
        """Return what is looked at; DefinitionError for a batch, a count that is none, an unknown case; AssemblyError out of reach."""
        require_mechanism(machine)
        title = machine.plan.title
        batch = [name for name, value in machine.dimensions.items() if np.ndim(value)]
        if batch:
            raise DefinitionError(
                f"{title}: a report is of one design, and {batch[0]} has {np.size(machine[batch[0]])} values; choose one of them."
            )
        if not is_whole(count) or not 2 <= count <= MANY:
            raise DefinitionError(f"count={cited(count)}: the rows of the report's tables, 2 to {MANY}; give a whole number such as 11.")
        found = cls(machine, run_of(machine, at), count, case_name(machine, case))
        if not found.curve.reached.any():
            raise AssemblyError(f"{title}: no pose of this run can be assembled, so that there is nothing to report; see machine.at(...).")
        return found

    @cached_property
    def table(self) -> Motion:
        """The poses of the tables; NaN out of reach."""
        return self._over(self.count)

    @cached_property
    def curve(self) -> Motion:
        """The poses of the curves; NaN out of reach."""
        return self._over(CURVE)

    def _over(self, count: int) -> Motion:
        with unwarned():
            return self.machine.at(unreachable="nan", **self.run.over(np.linspace(0.0, 1.0, count)))

    @property
    def stroke(self) -> str:
        """The stroke that moves, the first of several that run together: the one that derivatives are by."""
        return next(iter(self.run.ways))

    @cached_property
    def pose(self) -> dict[str, float]:
        """The strokes of the pose whose numbers are filled in: the middle of the run, else the next that is reached and has forces."""
        reached = np.flatnonzero(self.curve.reached)
        nearest = [self.strokes_at(self.curve, int(place)) for place in reached[np.argsort(np.abs(reached - CURVE // 2), kind="stable")]]
        return next(filter(self.has_forces, nearest[:TRIED]), nearest[0])

    def has_forces(self, strokes: Mapping[str, float]) -> bool:
        """Return whether forces are not refused at a pose, as they are at a cylinder's dead centre."""
        if not self.machine.plan.of_kind(ForceElement):
            return True
        try:
            with unwarned():
                pin_forces(self.machine.at(unreachable="raise", **strokes))
        except SingularError:
            return False
        except LinkageError:  # it has no forces anywhere, and the report says why
            return True
        return True

    def strokes_at(self, motion: Motion, place: int) -> dict[str, float]:
        """Return the values of all strokes at one of the poses of a motion."""
        return {name: float(np.broadcast_to(values, motion.shape)[place]) for name, values in motion.strokes.items()}

    def moving_words(self, strokes: Mapping[str, float]) -> str:
        """Return the values of the strokes that move, as text."""
        return self.words({name: value for name, value in strokes.items() if name in self.run.ways})

    def words(self, strokes: Mapping[str, float]) -> str:
        """Return values of strokes as text: `S = 125 mm`."""
        units = {name: stroke_display_unit(self.machine.plan, name, "mm") for name in strokes}
        return ", ".join(f"{name} = {show(value, units[name], 6)}" for name, value in strokes.items())

    @property
    def cases(self) -> list[str]:
        """The load cases looked at: the one asked for, else the plain one, "", and all that are declared."""
        return [self.case] if self.case else ["", *self.machine.plan.of_kind(LoadCase)]

    @cached_property
    def forces(self) -> list[PinForces]:
        """The joint forces in every case and, where friction makes a difference, in both directions; raises LinkageError."""
        if len(self.machine.links) < 2:
            raise DefinitionError(f"{self.machine.plan.title}: its points form no bodies, so that no joint carries anything.")
        return [
            pin_forces(self.table, case=case or None, direction=direction, drive=self.drive if direction != "frictionless" else None)
            for case in self.cases for direction in self.directions
        ]  # fmt: skip

    @property
    def drive(self) -> str | None:
        """The drive that friction works against, where one stroke moves; along several at once they move as the run goes."""
        return self.stroke if len(self.run.ways) == 1 else None

    @property
    def directions(self) -> list[str]:
        """The directions of motion in which the forces differ."""
        elements = self.machine.plan.of_kind(ForceElement).values()
        try:
            rubs = any(each.frictions(self.table) for each in elements)
        except LinkageError:
            rubs = False
        return ["frictionless", "extending", "retracting"] if rubs else ["frictionless"]

    def case_words(self, case: str) -> str:
        """Return what a load case is called."""
        return self.machine.plan.of_kind(LoadCase)[case].label if case else said("own loads")


def case_name(machine: Mechanism, case: object) -> str:
    """Return a load case's name in the class; "" for none; DefinitionError for one that the class has not."""
    if case is None:
        return ""
    cases = machine.plan.of_kind(LoadCase)
    for name, each in cases.items():
        if case is each or case in (name, each.title):
            return name
    known = ", ".join(cases) or "none"
    raise DefinitionError(f"{machine.plan.title}: case={cited(case)}: a load case of the class is expected; those are: {known}.")
