"""A catalogue of closed curves: where a point of a class goes in one turn of the crank, of many designs.

A curve is looked up by its Fourier descriptors, which no place, turn, size and start changes. Source: J. R. McGarva, Rapid search and
selection of path generating mechanisms from a library, Mech. Mach. Theory 29 (1994) 223-235.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import final

import numpy as np

from ..checks import require_whole
from ..errors import DefinitionError, cited
from ..language import said
from ..mechanism import Mechanism
from ..motion.measures import Given
from ..numeric.line import Index
from ..program import FloatArray
from ..quantities import is_whole
from ..shown import Shown
from ..study.checkpoint import digest
from ..study.problem import Problem
from ..study.space import Space, Varied
from ..study.survey import Executor, Progress, check_executor, check_progress, progress_told
from .closed_curves import ClosedCurves, drawn_curve, laid_onto
from .curve_class import HARMONICS, CurveClass
from .fit import WHOLE, Fit, Timing
from .starts import Likeness, as_complex
from .tasks import PathTask

CURVES, MOST_CURVES = 1 << 16, 1 << 24
"""Curves of a catalogue of which no number is said, and the most."""
NEIGHBOURS = 2048
"""Curves that are laid onto the one that is asked for: those whose amplitudes are nearest."""
CLOSEST, CLOSELY = 64, 512
"""The nearest of these, which are laid on once more, by so many poses."""
ANY_SIZE = np.array([[1e-9], [1e9]])


@final
@dataclass(frozen=True, eq=False)
class CurveMatch(Shown):
    """A machine of a catalogue, laid onto a curve, and how far its own curve is off.

    `distance` is the root mean square distance of points at the same part of the way, in parts of the curve's own from its middle.
    """

    machine: Mechanism
    distance: float
    number: int

    def __str__(self) -> str:
        return said("curve {number}: {distance} off", number=self.number, distance=f"{self.distance:.3g}")


@final
@dataclass(frozen=True, eq=False)
class CurveCatalogue(Shown):
    """Closed curves of a point, of designs that run their whole turn: `catalogue.nearest(points)`.

    `kind` says whose they are. `units` (m, k) are the designs, `amplitudes` (m, 2 h) the sizes of their descriptors, `looked` how many
    designs were looked at, `seed` that of their sequence.
    """

    kind: CurveClass
    units: FloatArray = field(repr=False)
    amplitudes: FloatArray = field(repr=False)
    looked: int
    seed: int

    def __len__(self) -> int:
        return len(self.units)

    def __str__(self) -> str:
        return said("{title}: {count} closed curves of {looked} designs", title=self.kind.title, count=len(self), looked=self.looked)

    __repr__ = __str__

    def design(self, number: int) -> Mechanism:
        """Return the machine of a curve, by its number; its first two fixed points stand 1 m apart."""
        if not is_whole(number) or not 0 <= number < len(self):
            raise DefinitionError(f"{self.kind.title}: there is no curve {cited(number)}; numbers go from 0 to {len(self) - 1}.")
        values = self.kind.values(self.units[int(number)][None])
        return self.kind.machine.replaced(**{name: float(value[0]) for name, value in self.kind.designs(values).items()})

    def nearest(self, points: object, count: int = 8) -> tuple[CurveMatch, ...]:
        """Return the machines whose curves are nearest to the closed curve through points (n, 2) [m], laid onto it, the nearest first.

        DefinitionError for anything but a closed curve.
        """
        require_whole(f"{self.kind.title}: count", count, "a whole number from 1 on is expected", least=1)
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
        """The dimensions of a design that is laid: what varies, and the first two fixed points."""
        owners = [*self.kind.fixed, *(each.owner for each in self.kind.variables)]
        return tuple(Varied(name, name, 1.0, 0.0, 1.0, None, "") for name in owners)

    def near(self, curve: ClosedCurves, many: int = NEIGHBOURS) -> Index:
        """Return the numbers of the curves whose amplitudes are nearest to a curve's, in whatever sense it is passed."""
        wanted = curve.amplitudes[0].reshape(2, -1)[:, :HARMONICS].astype(np.float32)
        own = np.einsum("ij,ij->i", self.amplitudes, self.amplitudes)
        products = self.amplitudes @ np.stack([wanted.ravel(), wanted[::-1].ravel()], axis=1)
        far = own - 2.0 * products.max(axis=1)
        return np.argpartition(far, many)[:many] if many < len(far) else np.arange(len(far))

    def laid(self, points: FloatArray) -> tuple[Index, FloatArray, FloatArray]:
        """Return the numbers (m,) of the nearest curves, their dimensions (m, k) laid onto points (n, 2), and the distances (m,)."""
        curve, _ = drawn_curve(points)
        numbers = self.near(curve)
        kind, space = self.kind, Space(self.variables, (), ())
        fixed = np.tile([*kind.fixed.values()], (len(numbers), 1))
        values = np.concatenate([fixed, kind.values(self.units[numbers])], axis=1)
        problem = Problem(kind.machine, [Given(0.0)], [], space)
        rows = PathTask(points, of=kind.of, closed=True).rows(kind.machine)
        fit = Fit(problem, rows, Timing.of(problem, kind.stroke, False, len(points)))
        likeness = Likeness.of(fit, values[:3], timed=False)
        free = {"shift": likeness.shift, "turn": likeness.turn, "scale": likeness.scale}
        factor, by, distance = np.ones(len(values), complex), np.zeros(len(values), complex), np.zeros(len(values))
        order = np.arange(len(values))
        for poses, many in ((WHOLE, len(values)), (CLOSELY, CLOSEST)):  # of the nearest once more, at more poses
            best = order[:many]
            paths, _ = fit.swept(values[best], poses)  # ranges from 0 to 1: values are parts of them
            laid = laid_onto(ClosedCurves.of(as_complex(paths)), curve, ANY_SIZE, **free)
            factor[best], by[best], distance[best] = laid.factor, laid.by, np.sqrt(laid.error) / curve.size
            order[:many] = best[np.argsort(distance[best], kind="stable")]
        return numbers[order], likeness.applied(fit, values, factor, by)[order], distance[order]

    def population(self, fit: Fit, many: int) -> FloatArray:
        """Return the designs nearest to a task's curve, laid onto it, as unit coordinates (m, n) of its search, beyond 0 and 1 too."""
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
    kind = CurveClass.for_point(machine, of, hold)
    if count is not None and not (is_whole(count) and 1 <= count <= MOST_CURVES):
        raise DefinitionError(f"{kind.title}: count={cited(count)}: a whole number of curves is expected, up to {MOST_CURVES}.")
    require_whole(f"{kind.title}: seed", seed, "a whole number is expected, at least 0", least=0)
    check_progress(progress)
    check_executor(executor)
    with progress_told(progress, kind.title) as tell:
        units, amplitudes, looked = kind.made(CURVES if count is None else count, seed, executor, tell)
    return CurveCatalogue(kind, units, amplitudes, looked, seed)
