"""Whose curves a catalogue holds: a machine of one crank, a point of it, what varies, and the curves of many designs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, final

import numpy as np

from ..errors import DefinitionError, StudyError, cited, ensure, unwarned
from ..mechanism import Mechanism
from ..motion import Grid
from ..plan import Mask, Plan
from ..program import FloatArray, Kernel, Level, RunOptions
from ..quantities import x, y
from ..study.checks import check_one_design
from ..study.measured import traced_number
from ..study.sampling import all_placed
from ..study.survey import Executor, Progress, survey
from .closed_curves import ClosedCurves, ComplexArray
from .fit import TURN
from .tasks import check_point

HARMONICS, POSES, FIRST = 8, 64, 16
"""Descriptors to either sign that are kept, poses of a turn of which they are taken, and poses at which a design is looked at before."""
ROUND = 1 << 17
"""Designs of a round, at the most."""
PATIENCE = 256
"""Designs that are looked at for one curve, at the most."""
LENGTHS = (0.08, 4.0)
"""Lengths from and to, spread by their logarithms, where the first two fixed points stand 1 apart."""
ABOUT = 2.5
"""How far from the middle of these two further fixed points stand in x and in y, at the most."""
SEEDS, OFTEN, REACH = 256, 0.25, 0.1
"""So many designs that run have others about them, by so much of every range, where fewer than this part of all run."""
EDGE = 1e-3
"""The squared sine of the angle at which two links meet is greater all the way round: 1.8 degrees."""
SAME_PLACE = 1e-9
"""Of a path's greatest distance from the origin: what its ends may be apart."""
WAY = RunOptions("numpy")


@final
@dataclass(frozen=True)
class ShapeVariable:
    """A dimension that varies in a catalogue, from low to high [SI]: a length by its logarithm, an angle, or a coordinate."""

    owner: str
    kind: str
    low: float
    high: float

    @property
    def is_angle(self) -> bool:
        """Whether it goes round."""
        return self.kind == "angle"

    def values(self, unit: FloatArray) -> FloatArray:
        """Return values [SI] of parts of the range, from 0 to 1."""
        if self.kind == "length":
            return np.asarray(self.low * (self.high / self.low) ** unit)
        return np.asarray(self.low + (self.high - self.low) * unit)


@final
@dataclass(frozen=True, eq=False)
class CurveClass:
    """A machine whose first two fixed points stand 1 m apart, and what of it varies: lengths, further fixed points, angles.

    What its places do not hang on stays as it is, and the angles that are held. `fixed` are the two points.
    """

    machine: Mechanism
    of: str
    stroke: str
    variables: tuple[ShapeVariable, ...]
    fixed: Mapping[str, float]

    @classmethod
    def for_point(cls, machine: Mechanism, of: Any, hold: Any = ()) -> CurveClass:
        """Return the class of a machine and a point; DefinitionError where no crank turns all of it."""
        check_one_design(machine)
        check_point(machine, of)
        title, plan, entries = machine.plan.title, machine.plan, machine.plan.table.entries
        ((stroke, one), *more) = plan.strokes.items()
        if more or abs(abs(one.end - one.start) - TURN) > 1e-9:
            raise DefinitionError(f"{title}: a catalogue is of machines that one crank moves over a turn, {stroke} = Stroke(0, 2 * pi).")
        used = {str(node.value) for node in curve_kernel(plan, of).plan.design_inputs}
        names = [*hold] if isinstance(hold, (tuple, list, set, frozenset)) else [hold]
        held = [plan.table.spellings[each][0] for each in names if isinstance(each, str) and each in plan.table.spellings]
        if len(held) < len(names) or any(entries[each].kind != "angle" for each in held):
            angles = ", ".join(name for name, entry in entries.items() if entry.kind == "angle") or "none"
            raise DefinitionError(f"{title}: hold={cited(hold)}: angles of the machine are expected; they are {angles}.")
        coordinates = {name for name, entry in entries.items() if entry.kind == "coordinate"}
        points = [name[:-2] for name in entries if name.endswith(".x") and {name, f"{name[:-2]}.y"} <= coordinates & used]
        fixed = {f"{point}.{axis}": at for point, place in zip(points, (0.0, 1.0), strict=False) for axis, at in (("x", place), ("y", 0.0))}
        variables: list[ShapeVariable] = []
        for name in entries:
            middle = 0.5 if name.endswith(".x") else 0.0
            ranges = {"length": LENGTHS, "angle": (-np.pi, np.pi), "coordinate": (middle - ABOUT, middle + ABOUT)}
            kind = entries[name].kind
            if name in used - {*fixed, *held} and kind in ranges and (kind != "coordinate" or name[:-2] in points):
                variables.append(ShapeVariable(name, kind, *ranges[kind]))
        ensure(variables, f"{title}: nothing that {of} hangs on can vary; give its links lengths as numbers.")
        return cls(machine.replaced(**fixed), of, stroke, tuple(variables), fixed)

    @property
    def title(self) -> str:
        """The machine's title and the point."""
        return f"{self.machine.plan.title}, {self.of}"

    def made(self, count: int, seed: int, executor: Executor | None, tell: Progress) -> tuple[FloatArray, FloatArray, int]:
        """Return values (count, k) and amplitudes (count, 2 h) of designs that run their whole turn, and how many were looked at.

        The first are spread over the box; where few of them run the others are spread about those that do. There are fewer where it would
        take long. The same seed gives the same, whoever does the work. StudyError where none runs.
        """
        from scipy.stats import qmc

        random = np.random.default_rng(seed)
        engine: Any = qmc.Sobol(len(self.variables), seed=random)
        size = min(ROUND, 1 << (4 * count).bit_length())
        measure = CurveMeasure(self.of, self.stroke, self.start, self.span)
        units: Any = np.zeros((0, len(self.variables)), np.float32)
        rows: Any = np.zeros((0, 2 * HARMONICS), np.float32)
        looked = 0
        tell(0, count)
        while len(rows) < count and looked < PATIENCE * max(count, ROUND >> 4):
            unit = engine.random(size)
            if len(units) >= SEEDS and len(units) < OFTEN * looked:
                unit = self.about(units[random.integers(len(units), size=size)], unit)
            unit = unit.astype(np.float32)
            found = survey(self.machine, self.designs(self.values(unit)), measure, executor=executor)
            runs = found["runs"]
            units = np.concatenate([units, unit[runs]])
            rows = np.concatenate([rows, np.stack([found[name] for name in amplitude_names()], axis=1)[runs].astype(np.float32)])
            looked, size = looked + size, min(ROUND, 2 * size)
            tell(min(len(rows), count), count)
        if not len(rows):
            raise StudyError(f"{self.title}: of {looked} designs none runs its whole turn; a catalogue of it would be empty.")
        return units[:count], rows[:count], looked

    def about(self, members: FloatArray, unit: FloatArray) -> FloatArray:
        """Return designs about others, parts of the ranges (m, k): by at most `REACH` away, angles going round."""
        found = members + REACH * (2.0 * unit - 1.0)
        turns = np.array([each.is_angle for each in self.variables])
        inside = 1.0 - np.abs(1.0 - np.abs(found))
        return np.asarray(np.where(turns, np.mod(found, 1.0), inside))

    def values(self, unit: FloatArray) -> FloatArray:
        """Return the values [SI] of parts of the ranges (m, k)."""
        return np.stack([each.values(np.asarray(unit[:, place], float)) for place, each in enumerate(self.variables)], axis=1)

    def designs(self, values: FloatArray) -> dict[str, Any]:
        """Return the dimensions that vary, of values (m, k), by owner."""
        return {each.owner: values[:, place] for place, each in enumerate(self.variables)}

    @property
    def start(self) -> float:
        """Where the turn begins [rad]."""
        return float(self.machine.plan.strokes[self.stroke].start)

    @property
    def span(self) -> float:
        """How far the turn goes [rad]."""
        return float(self.machine.plan.strokes[self.stroke].end) - self.start


# What is measured of a design.


def curve_kernel(plan: Plan, of: str) -> Kernel:
    """Return whether all has a place, where a point is, and the margins of the loops, as one kernel.

    A margin is above zero where the loop is assembled: the squared sine of the angle between two links, or a length [m].
    """

    def made(twin: Plan) -> Kernel:
        placed = [all_placed(), traced_number(twin, x(of)), traced_number(twin, y(of))]
        nodes = [node for each in placed for node in each.nodes(twin)]
        loops = [each for each in twin.trace.loops if each.kind in ("links", "length") and each.terms[0].level is not Level.CONSTANT]
        margins = [each.terms[0] / (each.terms[1] * each.terms[1]) if each.kind == "links" else each.terms[0] for each in loops]
        return Kernel([*nodes, *margins])

    return plan.made(("closed curve", of), made)


@final
@dataclass(frozen=True)
class CurveMeasure:
    """Measures designs: whether each runs its whole turn, and the amplitudes of its curve."""

    of: str
    stroke: str
    start: float
    span: float

    def __call__(self, machine: Mechanism) -> Mapping[str, Any]:
        """Return `runs` and the amplitudes by name, (m,) each; zero where a design does not run."""
        designs = dict(machine.dimensions)
        count = max(np.size(value) for value in designs.values())
        rows = np.arange(count)
        for poses in (FIRST, POSES):
            part = {name: value if np.ndim(value) == 0 else value[rows] for name, value in designs.items()}
            paths, runs = self.paths(machine.plan, part, poses, len(rows))
            rows, paths = rows[runs], paths[runs]
        table = np.zeros((count, 2 * HARMONICS))
        table[rows] = ClosedCurves.of(paths, HARMONICS).amplitudes
        return {"runs": table.any(axis=1)} | dict(zip(amplitude_names(), table.T, strict=True))

    def paths(self, plan: Plan, designs: Mapping[str, Any], poses: int, count: int) -> tuple[ComplexArray, Mask]:
        """Return the paths (m, poses), complex [m], and which designs run all the way round (m,).

        Between the poses a margin is taken to be lower by a sixth of its second differences about there; a parabola is by an eighth.
        """
        if not count:
            return np.zeros((0, poses), complex), np.zeros(0, bool)
        strokes = self.start + self.span * np.arange(poses + 1) / poses
        with unwarned(), np.errstate(all="ignore"):
            grid = Grid(plan, designs, {self.stroke: strokes})
            found = curve_kernel(plan, self.of)(grid.flat, way=WAY, size=grid.size).values
            found = np.broadcast_to(found, (len(found), count, poses + 1))
            runs = np.isfinite(found[:3]).all(axis=(0, 2))
            path = found[1] + 1j * found[2]
            size = np.abs(path).max(axis=1)
            runs &= np.abs(path[:, -1] - path[:, 0]) <= SAME_PLACE * size  # of groups that are followed, not of dyads
            for margin in found[3:, :, :-1]:
                bend = np.abs(np.roll(margin, 1, axis=1) - 2.0 * margin + np.roll(margin, -1, axis=1))
                bend = np.maximum(bend, np.maximum(np.roll(bend, 1, axis=1), np.roll(bend, -1, axis=1)))  # the greatest beside as well
                low = margin if poses == FIRST else margin - bend / 6.0
                runs &= low.min(axis=1) > EDGE
        return path[:, :-1], runs


def amplitude_names() -> list[str]:
    """Return the names of the amplitudes, in order."""
    return [f"c{sign}{k}" for sign in ("+", "-") for k in range(1, HARMONICS + 1)]
