"""The subject of a document: one design, the judge of all that it runs, its runs for tables and curves, the comments in its source."""

from __future__ import annotations

import ast
import inspect
import re
import tokenize
from collections.abc import Container, Mapping
from contextlib import suppress
from dataclasses import replace
from functools import cached_property
from io import StringIO
from textwrap import dedent

import numpy as np

from ..errors import AssemblyError, LinkageError, SingularError, ensure, require_one_design, require_whole, unwarned
from ..frozen import immutable
from ..language import translated
from ..loads import PLAIN_CASE, Acting, Case, ForceElement, LoadCase, case_title, case_titles
from ..mechanism import Mechanism, require_mechanism
from ..motion import Column, Judge, Motion, Request, Tabled, speakers, stroke_display_unit
from ..motion.measures import MeasuredQuantity
from ..plan import plan_measure
from ..quantities import Dimension, Quantity
from ..reports import At, Run, column_requests, is_column, motion_over, results, run_words, runs_of
from ..reports.results import asked_by_name
from ..statics import PinForces, drive_force, pin_forces, pin_forces_under
from ..units import UNITS, show


def notes_of(machine: type[Mechanism]) -> dict[str, str]:
    """Return the comments that stand beside the members in the source of a class and its bases, by name."""
    found: dict[str, str] = {}
    for cls in reversed(machine.__mro__):
        if issubclass(cls, Mechanism) and cls is not Mechanism:
            found |= comments_in(cls)
    plan, kept = machine.plan, {name: translated(text) for name, text in found.items() if name in machine.plan.members}
    for name, text in kept.items():
        member = plan.members[name]
        if not isinstance(member, Dimension) or member.unit or plan_measure(plan, name):  # else nothing but the note says what it measures
            kept[name] = without_unit(text)
    return kept


SHOWN = ("m", "mm", "cm", "rad", "deg", "kg")
"""The units of a source's numbers that a report shows in units of its own."""


def without_unit(note: str) -> str:
    """Return a note without a unit in front or at its end: `cylinder stroke, m`."""
    units = "|".join((*SHOWN, *map(translated, SHOWN)))
    return re.sub(rf"^(?:{units})(?:, |$)|, (?:{units})$", "", note)


def comments_in(cls: type) -> dict[str, str]:
    """Return the comments behind the assignments in a class's body, by the names assigned; none where it has no source."""
    try:
        source = dedent(inspect.getsource(cls))
        body = ast.parse(source).body[0]
        tokens = list(tokenize.generate_tokens(StringIO(source).readline))
    except (OSError, TypeError, SyntaxError, tokenize.TokenError, IndexError):
        return {}
    comments = {token.start[0]: token.string.lstrip("#: ").strip() for token in tokens if token.type == tokenize.COMMENT}
    found: dict[str, str] = {}
    for line in getattr(body, "body", []):
        if (
            isinstance(line, ast.Assign)
            and (text := comments.get(line.end_lineno or line.lineno))
            and not text.startswith(("fmt:", "type:", "noqa"))
        ):
            for target in line.targets:
                listed = target.elts if isinstance(target, ast.Tuple) else [target]
                names = [name.id for name in listed if isinstance(name, ast.Name)]
                named = [name for name in names if re.match(rf"{name}\b", text)]  # of several the one that it speaks of
                found |= dict.fromkeys(named or names, text)
    return found


CURVE = 121
"""Poses of a curve."""
TRIED = 9
"""So many poses next to the middle are tried for one that has forces."""
MANY = 2001
"""Rows of a table that one would still print."""
FIGURES = 4
CLOSE = 1e-9
"""Of a column's greatest value: columns that differ by no more are one curve, and a limit of which no more is missing is kept."""


def same_curve(one: Column, other: Column) -> bool:
    """Return whether two columns measure the same and have the same values."""
    kinds = {UNITS[each.unit][1] if each.unit else "" for each in (one, other)}
    first, second = (np.asarray(each.values, float) for each in (one, other))
    size = largest(first)
    return len(kinds) == 1 and size > 0.0 and bool(np.allclose(first, second, rtol=CLOSE, atol=CLOSE * size, equal_nan=True))


def largest(values: object) -> float:
    """Return the largest size of the finite ones of some values; 0 without any."""
    sizes = np.abs(np.asarray(values, float))
    return float(np.max(sizes, initial=0.0, where=np.isfinite(sizes)))


@immutable
class ReportSubject:
    """A design, who answers questions over all that it runs, and the runs along which it is shown."""

    machine: Mechanism
    runs: tuple[Run, ...]
    count: int
    verdict_judge: Judge
    """The judge of verdicts, for whom a place that is lost is a fault."""
    judge: Judge

    @classmethod
    def of(cls, machine: Mechanism, at: At | Motion, count: int, over: object = None, acting: Acting | None = None) -> ReportSubject:
        """Return the subject of a report; DefinitionError for a batch, a wrong count, an unknown case; AssemblyError out of reach."""
        require_mechanism(machine)
        title = machine.plan.title
        require_one_design(machine.dimensions, f"{title}: a report is of one design")
        require_whole("count", count, f"the rows of the report's tables, 2 to {MANY}; give a whole number such as 11", least=2, most=MANY)
        judge = machine.judge(over, acting)
        found = cls(machine, runs_of(machine, at, over, judge.acting), count, judge, judge.lost_allowed())
        found.judge.cases  # noqa: B018  refuses a load case that is unknown
        if not found.curve.reached.any():
            raise AssemblyError(f"{title}: no pose of this run can be assembled, so that there is nothing to report; see machine.at(...).")
        return found

    @cached_property
    def notes(self) -> Mapping[str, str]:
        """The comments that stand beside the members in the machine's source, by name."""
        return notes_of(type(self.machine))

    @cached_property
    def run(self) -> Run:
        """The run of the drawings: the first along which something moves, else the first."""
        return next((run for run in self.runs if run.is_curve), self.runs[0])

    @cached_property
    def tables(self) -> list[tuple[Run, Motion]]:
        """Each run with the poses of its table; NaN out of reach."""
        return [(run, self.along(run, self.count)) for run in self.runs]

    @cached_property
    def table(self) -> Motion:
        """The poses of all tables; NaN out of reach."""
        if len(self.runs) == 1:
            return self.tables[0][1]
        poses = [{name: np.broadcast_to(each, motion.shape) for name, each in motion.strokes.items()} for _, motion in self.tables]
        with unwarned():
            return self.machine.at(unreachable="nan", **{name: np.concatenate([each[name] for each in poses]) for name in poses[0]})

    @cached_property
    def curves(self) -> list[tuple[Run, Motion]]:
        """Each run along which something moves with the poses of its curves; NaN out of reach."""
        return [(run, self.curve if run is self.run else self.along(run, CURVE)) for run in self.runs if run.is_curve]

    @cached_property
    def curve(self) -> Motion:
        """The poses of the drawings, those of the curves of the first run; NaN out of reach."""
        return self.along(self.run, CURVE)

    def along(self, run: Run, count: int) -> Motion:
        """Return a run at so many poses, those apart as they are; NaN out of reach."""
        with unwarned():
            return motion_over(self.machine, run, np.linspace(0.0, 1.0, count))

    @property
    def stroke(self) -> str:
        """The stroke that moves, the first of several that run together: the one that derivatives are by."""
        return self.run.stroke or next(iter(self.machine.strokes))

    @cached_property
    def pose(self) -> dict[str, float]:
        """The strokes of the pose whose numbers are filled in: the middle of the run, else the next that is reached and has forces."""
        reached = np.flatnonzero(self.curve.reached)
        middle = self.curve.reached.size // 2
        nearest = [self.strokes_at(self.curve, int(place)) for place in reached[np.argsort(np.abs(reached - middle), kind="stable")]]
        return next(filter(self.has_forces, nearest[:TRIED]), nearest[0])

    def has_forces(self, strokes: Mapping[str, float]) -> bool:
        """Return whether forces are not refused at a pose, as they are at a cylinder's dead centre."""
        if not self.machine.plan.of_kind(ForceElement):
            return True
        try:
            with unwarned():
                pin_forces(self.machine.at(unreachable="raise", **strokes), case=self.run.case)
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
    def pose_words(self) -> str:
        """The pose whose numbers are filled in, with the run that it is of and its load case, as text."""
        return ", ".join(filter(None, (self.words(self.pose), run_words(self.machine, self.run))))

    @cached_property
    def columns(self) -> list[Column]:
        """The results at the poses of the drawings, under the machine's own loads."""
        with unwarned():
            return results(self.machine, self.curve, PLAIN_CASE)

    def columns_along(self, run: Run, motion: Motion) -> dict[str, Column]:
        """Return the columns of results and of members over a run, in its load case, by name."""
        if motion is self.curve and run.case is None:
            found, own = self.columns, self.member_columns
        else:
            with unwarned():
                found = results(self.machine, motion, run.case or PLAIN_CASE)
            own = self.columns_of_members(motion, run.case)
        named = {column.name: column for column in found}
        for name, column in own:
            named.setdefault(f"{column.name} {name}", replace(column, name=f"{column.name} {name}"))
        along = {*self.machine.strokes, *(["time"] if motion.time is not None else [])}
        return {name: column for name, column in named.items() if name not in along}

    @property
    def has_own_table(self) -> bool:
        """Whether the machine makes its table itself, in its own order and digits."""
        return type(self.machine)._owner("columns") is not Mechanism

    @cached_property
    def table_columns(self) -> list[list[Column]]:
        """The results at the poses of each table, in the load case of its run."""
        with unwarned():
            return [results(self.machine, motion, run.case or PLAIN_CASE) for run, motion in self.tables]

    @cached_property
    def doubles(self) -> dict[str, str]:
        """The drive forces and thrusts that are another cylinder's thrust over all runs; none where a machine makes its table itself."""
        found: dict[str, str] | None = {} if self.has_own_table else None
        for table in self.table_columns:
            columns = {column.name: column for column in table}
            thrusts = [name for name in columns if name.startswith("thrust")]
            names = [*thrusts, *(name for name in columns if name.startswith(("drive force", "torque")))]
            before = {name: thrusts[:k] for k, name in enumerate(names)}
            same = {name: [each for each in among if same_curve(columns[name], columns[each])][:1] for name, among in before.items()}
            known = {drive: thrust for drive, each in same.items() for thrust in each}
            found = known if found is None else {drive: thrust for drive, thrust in found.items() if known.get(drive) == thrust}
        return found or {}

    @cached_property
    def member_columns(self) -> list[tuple[str, Column]]:
        """The members' columns at the poses of the curves, each with the member's name; none for a member that is refused."""
        return [(name, asked_by_name(name, column)) for name, column in self.columns_of_members(self.curve)]

    def columns_of_members(self, motion: Motion, case: Case = None) -> list[tuple[str, Column]]:
        """Return the members' columns in a load case, each with the member's name; none for a member that is refused."""
        found: list[tuple[str, Column]] = []
        for name, member in speakers(self.machine.plan, Tabled).items():
            with unwarned(), suppress(LinkageError):
                found += [(name, column) for column in member.columns_in(motion, case)]
        return found

    def quantities(self, names: Container[str]) -> dict[str, MeasuredQuantity]:
        """Return the requests of some columns of results and of members, by name; none for one that only the table gives."""
        with unwarned():
            own = column_requests(self.machine, self.curve, self.columns, names).items()
            asked = {name: request for name, (_, request, why) in own if not (why and is_column(request))}
            kinds = str, Quantity, Request
            found: dict[str, MeasuredQuantity] = {name: request for name, request in asked.items() if isinstance(request, kinds)}
            for name, column in self.member_columns:
                if f"{column.name} {name}" in names and isinstance(column.request, (str, Quantity, Request)):
                    found.setdefault(f"{column.name} {name}", column.request)
        return found

    @cached_property
    def forces(self) -> list[PinForces]:
        """The joint forces at the poses of each table in every situation that is judged there; raises LinkageError."""
        ensure(len(self.machine.links) >= 2, f"{self.machine.plan.title}: its points form no bodies, so that no joint carries anything.")
        with unwarned():
            situations = [(motion, self.judge.actings(drive_force(), run.title)) for run, motion in self.tables]
            return [pin_forces_under(motion, each) for motion, there in situations for each in there]

    def case_words(self, name: str) -> str:
        """Return how a load case is called; the plain one is that of the situation, where this is of no class."""
        plan, given = self.machine.plan, self.judge.acting.case
        return given.label if name not in plan.of_kind(LoadCase) and isinstance(given, LoadCase) else case_title(name, case_titles(plan))
