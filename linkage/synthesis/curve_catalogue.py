"""A catalogue of closed curves: where a point of a class goes in one turn of the crank, of many designs.

A curve is looked up by its Fourier descriptors, which no place, turn, size and start changes. Source: J. R. McGarva, Rapid search and
selection of path generating mechanisms from a library, Mech. Mach. Theory 29 (1994) 223-235.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field
from typing import Any

import numpy as np

from ..errors import DefinitionError, StudyError, cited, ensure, require_whole, unwarned
from ..frozen import immutable, record
from ..language import said
from ..mechanism import Mechanism
from ..motion import Grid
from ..motion.measures import FixedNumber
from ..numeric.line import Index
from ..plan import Mask, Plan
from ..program import FloatArray, Kernel, Level, RunOptions
from ..quantities import is_whole, x, y
from ..shown import Shown
from ..study.checkpoint import digest
from ..study.designs import DesignValues
from ..study.measured import all_placed, traced_number
from ..study.problem import Problem
from ..study.space import Space, Varied, check_in_count, check_one_design
from ..study.survey import Executor, Progress, check_executor, check_progress, progress_told, survey
from .closed_curves import ClosedCurves, ComplexArray, drawn_curve, laid_onto
from .fit import TURN, WHOLE, Fit, Timing
from .starts import Likeness, as_complex
from .tasks import PathTask, check_point

CURVES, MOST_CURVES = 1 << 16, 1 << 24
"""Curves of a catalogue of which no number is said, and the most."""
NEIGHBOURS = 2048
"""Curves that are laid onto the one that is asked for: those whose amplitudes are nearest."""
CLOSEST, CLOSELY = 64, 512
"""The nearest of these, which are laid on once more, by so many poses."""
ANY_SIZE = np.array([[1e-9], [1e9]])


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


class CurveClass:
    """A machine whose first two fixed points stand 1 m apart, with its variables: lengths, further fixed points, angles.

    What its places do not hang on stays as it is, and the angles that are held. `fixed` are the two points. DefinitionError where no crank
    turns all of it.
    """

    def __init__(self, machine: Mechanism, of: Any, hold: object = ()) -> None:
        check_one_design(machine)
        check_point(machine, of)
        title, plan, entries = machine.plan.title, machine.plan, machine.plan.table.entries
        ((stroke, one), *more) = plan.strokes.items()
        if more or abs(abs(one.end - one.start) - TURN) > 1e-9:
            raise DefinitionError(f"{title}: a catalogue is of machines that one crank moves over a turn, {stroke} = Stroke(0, 2 * pi).")
        used = {*curve_kernel(plan, of).plan.input_names[0]}
        names = [*hold] if isinstance(hold, (tuple, list, set, frozenset)) else [hold]
        held = [plan.table.spellings[each][0] for each in names if isinstance(each, str) and each in plan.table.spellings]
        if len(held) < len(names) or any(entries[each].kind != "angle" for each in held):
            angles = ", ".join(name for name, entry in entries.items() if entry.kind == "angle") or "none"
            raise DefinitionError(f"{title}: hold={cited(hold)}: angles of the machine are expected; they are {angles}.")
        coordinates = {name for name, entry in entries.items() if entry.kind == "coordinate"}
        points = [name[:-2] for name in entries if name.endswith(".x") and {name, f"{name[:-2]}.y"} <= coordinates & used]
        fixed = {f"{point}.{axis}": at for point, place in zip(points, (0.0, 1.0), strict=False) for axis, at in (("x", place), ("y", 0.0))}
        variables: list[Varied] = []
        for name in entries:
            middle = 0.5 if name.endswith(".x") else 0.0
            ranges = {"length": LENGTHS, "angle": (-np.pi, np.pi), "coordinate": (middle - ABOUT, middle + ABOUT)}
            kind = entries[name].kind
            if name in used - {*fixed, *held} and kind in ranges and (kind != "coordinate" or name[:-2] in points):
                variables.append(Varied(name, name, 1.0, *ranges[kind], None, ""))
        ensure(variables, f"{title}: nothing that {of} hangs on can vary; give its links lengths as numbers.")
        self.machine, self.of, self.stroke, self.fixed = machine.replaced(**fixed), of, stroke, fixed
        self.variables, self.class_title = tuple(variables), f"{title}, {of}"

    def running_designs(self, count: int, seed: int, executor: Executor | None, tell: Progress) -> tuple[FloatArray, FloatArray, int]:
        """Return values (count, k) and amplitudes (count, 2 h) of designs that run their whole turn, and how many were looked at.

        The first are spread over the box; where few of them run the others are spread about those that do. There are fewer where it would
        take long. The same seed gives the same, whoever does the work. StudyError where none runs.
        """
        from scipy.stats import qmc

        random = np.random.default_rng(seed)
        engine: Any = qmc.Sobol(len(self.variables), seed=random)
        size = min(ROUND, 1 << (4 * count).bit_length())
        turn = self.machine.plan.strokes[self.stroke]
        measure = CurveMeasure(self.of, self.stroke, float(turn.start), float(turn.end) - float(turn.start))
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
            raise StudyError(f"{self.class_title}: of {looked} designs none runs its whole turn; a catalogue of it would be empty.")
        return units[:count], rows[:count], looked

    def about(self, members: FloatArray, unit: FloatArray) -> FloatArray:
        """Return designs about others, parts of the ranges (m, k): by at most `REACH` away, angles going round."""
        found = members + REACH * (2.0 * unit - 1.0)
        turns = np.array([self.kind_of(each) == "angle" for each in self.variables])
        inside = 1.0 - np.abs(1.0 - np.abs(found))
        return np.asarray(np.where(turns, np.mod(found, 1.0), inside))

    def values(self, unit: FloatArray) -> FloatArray:
        """Return the values [SI] of parts of the ranges (m, k): lengths by their logarithms."""
        columns = [
            each.low * (each.high / each.low) ** part if self.kind_of(each) == "length" else each.low + each.span * part
            for each, part in zip(self.variables, np.ascontiguousarray(unit.T, float), strict=True)
        ]
        return np.stack(columns, axis=1)

    def kind_of(self, variable: Varied) -> str:
        """Return whether a variable is a length, an angle or a coordinate."""
        return self.machine.plan.table.entries[variable.owner].kind

    def designs(self, values: FloatArray) -> DesignValues:
        """Return the dimensions that vary, of values (m, k), by owner."""
        return {each.owner: values[:, place] for place, each in enumerate(self.variables)}


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


@record
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
        table[rows] = ClosedCurves(paths, HARMONICS).amplitudes
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
            found = grid.kernel_result(curve_kernel(plan, self.of), way=WAY).values
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


@immutable
class CurveMatch(Shown):
    """A machine of a catalogue, laid onto a curve, and how far its own curve is off.

    Attributes
    ----------
    machine : Mechanism
        The machine.
    distance : float
        The root mean square distance of points at the same part of the curve, in parts of the curve's own from its middle.
    number : int
        Its number in the catalogue.
    """

    machine: Mechanism
    distance: float
    number: int

    def __str__(self) -> str:
        return said("curve {number}: {distance} off", number=self.number, distance=f"{self.distance:.3g}")


@immutable
class CurveCatalogue(Shown):
    """Closed curves of a point, of designs that run their whole turn: `catalogue.nearest(points)`.

    Attributes
    ----------
    kind : CurveClass
        The class of machine and the point.
    units : array (m, k)
        The designs, in parts of their ranges.
    amplitudes : array (m, 2 h)
        The sizes of the descriptors of their curves.
    looked : int
        How many designs were looked at.
    seed : int
        That of their sequence.
    """

    kind: CurveClass
    units: FloatArray = field(repr=False)
    amplitudes: FloatArray = field(repr=False)
    looked: int
    seed: int

    def __len__(self) -> int:
        return len(self.units)

    def __str__(self) -> str:
        return said("{title}: {count} closed curves of {looked} designs", title=self.kind.class_title, count=len(self), looked=self.looked)

    __repr__ = __str__

    def design(self, number: int) -> Mechanism:
        """Return the machine of a curve, by its number; its first two fixed points stand 1 m apart.

        Parameters
        ----------
        number : int
            The number of the curve.

        Returns
        -------
        Mechanism
            The machine.
        """
        check_in_count(self.kind.class_title, "curve", number, len(self))
        values = self.kind.values(self.units[int(number)][None])
        return self.kind.machine.replaced(**{name: float(value[0]) for name, value in self.kind.designs(values).items()})

    def nearest(self, points: object, count: int = 8) -> tuple[CurveMatch, ...]:
        """Return the machines whose curves are nearest to a closed curve, laid onto it, the nearest first.

        Parameters
        ----------
        points : array (n, 2)
            The points of the curve [m].
        count : int, optional
            How many machines, 8 by default.

        Returns
        -------
        tuple of CurveMatch
            The machines.

        Raises
        ------
        DefinitionError
            The curve is not closed.
        """
        require_whole(f"{self.kind.class_title}: count", count, "a whole number from 1 on is expected", least=1)
        task = PathTask(points, of=self.kind.of, closed=True)
        numbers, values, distance = self.laid(task.points)
        rows = [{each.owner: float(value) for each, value in zip(self.variables, row, strict=True)} for row in values[:count]]
        machines = [self.kind.machine.replaced(**row) for row in rows]
        return tuple(CurveMatch(*each) for each in zip(machines, distance[:count].tolist(), numbers[:count].tolist(), strict=True))

    @property
    def digest(self) -> str:
        """A text that stands for its curves."""
        return f"catalogue {digest(self.units.tobytes())}"

    # -- how it looks ------------------------------------------------------------------------------------

    @property
    def variables(self) -> tuple[Varied, ...]:
        """The dimensions of a design that is laid: the variables, and the first two fixed points."""
        owners = [*self.kind.fixed, *(each.owner for each in self.kind.variables)]
        return tuple(Varied(name, name, 1.0, 0.0, 1.0, None, "") for name in owners)

    def near(self, curve: ClosedCurves, many: int = NEIGHBOURS) -> Index:
        """Return the numbers of the curves whose amplitudes are nearest to a curve's, in whatever sense it is passed.

        Parameters
        ----------
        curve : ClosedCurves
            The curve.
        many : int, optional
            How many, 2048 by default.

        Returns
        -------
        array of int
            The numbers.
        """
        wanted = curve.amplitudes[0].reshape(2, -1)[:, :HARMONICS].astype(np.float32)
        own = np.einsum("ij,ij->i", self.amplitudes, self.amplitudes)
        products = self.amplitudes @ np.stack([wanted.ravel(), wanted[::-1].ravel()], axis=1)
        far = own - 2.0 * products.max(axis=1)
        return np.argpartition(far, many)[:many] if many < len(far) else np.arange(len(far))

    def laid(self, points: FloatArray) -> tuple[Index, FloatArray, FloatArray]:
        """Return the numbers of the nearest curves, their dimensions laid onto points, and the distances.

        Parameters
        ----------
        points : array (n, 2)
            The points of the curve [m].

        Returns
        -------
        tuple of array
            Numbers (m,), dimensions (m, k) [SI], distances (m,).
        """
        curve, _ = drawn_curve(points)
        numbers = self.near(curve)
        kind, space = self.kind, Space(self.variables, (), ())
        fixed = np.tile([*kind.fixed.values()], (len(numbers), 1))
        values = np.concatenate([fixed, kind.values(self.units[numbers])], axis=1)
        problem = Problem(kind.machine, [FixedNumber(0.0)], [], space)
        rows = PathTask(points, of=kind.of, closed=True).rows(kind.machine)
        fit = Fit(problem, rows, Timing.of(problem, kind.stroke, False, len(points)))
        likeness = Likeness.of(fit, values[:3], timed=False)
        free = {"shift": likeness.shift, "turn": likeness.turn, "scale": likeness.scale}
        factor, by, distance = np.ones(len(values), complex), np.zeros(len(values), complex), np.zeros(len(values))
        order = np.arange(len(values))
        for poses, many in ((WHOLE, len(values)), (CLOSELY, CLOSEST)):  # of the nearest once more, at more poses
            best = order[:many]
            paths, _ = fit.swept(values[best], poses)  # ranges from 0 to 1: values are parts of them
            laid = laid_onto(ClosedCurves(as_complex(paths)), curve, ANY_SIZE, **free)
            factor[best], by[best], distance[best] = laid.factor, laid.by, np.sqrt(laid.error) / curve.size
            order[:many] = best[np.argsort(distance[best], kind="stable")]
        return numbers[order], likeness.applied(fit, values, factor, by)[order], distance[order]

    def population(self, fit: Fit, many: int) -> FloatArray:
        """Return the designs nearest to a task's curve, laid onto it, as unit coordinates (m, n) of its search, beyond 0 and 1 too.

        Parameters
        ----------
        fit : Fit
            The task's fit.
        many : int
            How many designs.

        Returns
        -------
        array (m, n)
            The coordinates.
        """
        values = self.laid(fit.rows.wanted[:2].T)[1][:many]
        known = {each.owner: values[:, place] for place, each in enumerate(self.variables)}
        present = fit.space.present(fit.problem.machine)
        columns = [
            (each.sign * known[each.owner] if each.owner in known else np.full(len(values), present[place]), each.low, each.span)
            for place, each in enumerate(fit.space.variables)
        ]
        return np.stack([(value - low) / span for value, low, span in columns], axis=1)


def curve_catalogue(
    machine: Mechanism,
    of: str,
    *,
    hold: object = (),
    count: int | None = None,
    seed: int = 0,
    executor: Executor | None = None,
    progress: bool | Progress = False,
) -> CurveCatalogue:
    """Make a catalogue of the closed curves of a point: `curve_catalogue(FourBar(), "P")`.

    It holds curves of designs whose crank turns its whole turn. The place, turn and size of the whole machine do not matter.

    Parameters
    ----------
    machine : Mechanism
        A design of the class. All its lengths and fixed points vary, and all angles but those of `hold`.
    of : str
        The point.
    hold : str or list of str, optional
        Angles that stay as the design has them.
    count : int, optional
        How many curves, by default 65,536, which takes some seconds.
    seed : int, optional
        That of the sequence of designs; the same seed gives the same curves.
    executor : Executor, optional
        That of `survey`.
    progress : bool or function, optional
        True shows a bar.

    Returns
    -------
    CurveCatalogue
        Give it to as many searches as you like, `synthesise(..., starts=catalogue)`.

    Raises
    ------
    DefinitionError
        No crank turns the machine, or an argument is none.
    StudyError
        No design runs its whole turn.
    """
    kind = CurveClass(machine, of, hold)
    if count is not None and not (is_whole(count) and 1 <= count <= MOST_CURVES):
        raise DefinitionError(f"{kind.class_title}: count={cited(count)}: a whole number of curves is expected, up to {MOST_CURVES}.")
    require_whole(f"{kind.class_title}: seed", seed, "a whole number is expected, at least 0", least=0)
    check_progress(progress)
    check_executor(executor)
    with progress_told(progress, kind.class_title) as tell:
        units, amplitudes, looked = kind.running_designs(CURVES if count is None else count, seed, executor, tell)
    return CurveCatalogue(kind, units, amplitudes, looked, seed)
