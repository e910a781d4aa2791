"""What a document looks at: one design, the judge of all that it runs, and the stroke along which its tables and curves go."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from typing import final

import numpy as np

from ..checks import require_whole
from ..errors import AssemblyError, DefinitionError, LinkageError, SingularError, unwarned
from ..language import said
from ..loads import PLAIN_CASE, Acting, ForceElement, LoadCase
from ..mechanism import Mechanism, require_mechanism
from ..motion import Column, Judge, Motion, Request, Tabled, speakers, stroke_display_unit
from ..motion.measures import MeasuredQuantity
from ..quantities import Quantity
from ..reports import At, Run, column_requests, is_column, results, run_of
from ..reports.results import asked_by_name
from ..statics import PinForces, drive_force, pin_forces, pin_forces_under
from ..units import show
from .sources import notes_of

CURVE = 121
"""Poses of a curve."""
TRIED = 9
"""So many poses next to the middle are tried for one that has forces."""
MANY = 2001
"""Rows of a table that one would still print."""


@final
@dataclass(frozen=True, eq=False)
class ReportSubject:
    """A design, who answers questions over all that it runs, and one of its strokes along which it is shown, the others held."""

    machine: Mechanism
    run: Run
    count: int
    over: object
    judge: Judge

    @classmethod
    def at(cls, machine: Mechanism, at: At | Motion, count: int, over: object = None, acting: Acting | None = None) -> ReportSubject:
        """Return what is reported; DefinitionError for a batch, a count that is none, an unknown case; AssemblyError out of reach."""
        require_mechanism(machine)
        title = machine.plan.title
        batch = [name for name, value in machine.dimensions.items() if np.ndim(value)]
        if batch:
            raise DefinitionError(
                f"{title}: a report is of one design, and {batch[0]} has {np.size(machine[batch[0]])} values; choose one of them."
            )
        require_whole("count", count, f"the rows of the report's tables, 2 to {MANY}; give a whole number such as 11", least=2, most=MANY)
        found = cls(machine, run_of(machine, at), count, over, machine.judge(over, acting).lost_allowed())
        found.judge.cases  # noqa: B018  refuses a load case that is unknown
        if not found.curve.reached.any():
            raise AssemblyError(f"{title}: no pose of this run can be assembled, so that there is nothing to report; see machine.at(...).")
        return found

    @cached_property
    def notes(self) -> Mapping[str, str]:
        """The comments that stand beside the members in the machine's source, by name."""
        return notes_of(type(self.machine))

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

    def words(self, strokes: Mapping[str, float]) -> str:
        """Return values of strokes as text: `S = 125 mm`."""
        units = {name: stroke_display_unit(self.machine.plan, name, "mm") for name in strokes}
        return ", ".join(f"{name} = {show(value, units[name], 6)}" for name, value in strokes.items())

    @property
    def domain(self) -> str:
        """All that the judge looks at, in words: the strokes of each `Over`, with its name where there are several."""
        places = self.judge.places
        named = [(place.over.title if len(places) > 1 else "", place.over.words(place.motion)) for place in places]
        return "; ".join(f"{name}: {words}" if name else words for name, words in named)

    @cached_property
    def columns(self) -> list[Column]:
        """The results at the poses of the curves."""
        with unwarned():
            return results(self.machine, self.curve)

    @cached_property
    def member_columns(self) -> list[tuple[str, Column]]:
        """What members show of themselves at the poses of the curves, each with the member's name; nothing for one that is refused."""
        found: list[tuple[str, Column]] = []
        for name, member in speakers(self.machine.plan, Tabled).items():
            with unwarned(), suppress(LinkageError):
                found += [(name, asked_by_name(name, column)) for column in member.columns(self.curve)]
        return found

    @cached_property
    def quantities(self) -> dict[str, MeasuredQuantity]:
        """What asks for the columns of results and of members anywhere, by their names; nothing for one that only the table gives."""
        with unwarned():
            own = column_requests(self.machine, self.curve, self.columns).items()
            asked = {name: request for name, (_, request, why) in own if not (why and is_column(request))}
            kinds = str, Quantity, Request
            found: dict[str, MeasuredQuantity] = {name: request for name, request in asked.items() if isinstance(request, kinds)}
            for name, column in self.member_columns:
                if isinstance(column.request, (str, Quantity, Request)):
                    found.setdefault(f"{column.name} {name}", column.request)
        return found

    @cached_property
    def forces(self) -> list[PinForces]:
        """The joint forces at the poses of the tables in every situation that is judged; raises LinkageError."""
        if len(self.machine.links) < 2:
            raise DefinitionError(f"{self.machine.plan.title}: its points form no bodies, so that no joint carries anything.")
        with unwarned():
            return [pin_forces_under(self.table, each) for each in self.judge.actings(drive_force())]

    def case_words(self, name: str) -> str:
        """Return what a load case is called, with its name where sentences name it by another one."""
        known = self.machine.plan.of_kind(LoadCase).get(name, self.judge.acting.case)
        label = known.label if isinstance(known, LoadCase) else said("own loads") if name == PLAIN_CASE else name
        return label if label == name or len(self.judge.cases) == 1 else f"{label} ({name})"
