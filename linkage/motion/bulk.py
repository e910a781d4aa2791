"""Values and ratios of many poses in one pass, of nothing but what is asked for: the call under studies."""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ..errors import DefinitionError, SingularWarning
from ..plan import ArrayReading, Plan
from ..program import FloatArray, Kernel, Level, Node, Way, ancestors, interpret
from ..quantities import Quantity
from ..steps import Arrow, Point
from . import reach, singular
from .grid import Grid
from .motion import Motion
from .reach import Mask
from .request import Request, Wanted, wanted
from .unwrap import unwrapped

PIECE = 1 << 18
"""Poses that are looked at again at a time."""


def evaluate(grid: Grid, requests: Sequence[Request], out: FloatArray | None, way: Way) -> list[FloatArray]:
    """Return the values of requests over a grid; see Mechanism.evaluate."""
    return Bulk(grid, tuple(wanted(grid.plan, request) for request in requests), way).run(out)


@dataclass(frozen=True)
class Bulk:
    """Requests over a grid of poses, and how they are worked out."""

    grid: Grid
    wanted: tuple[Wanted, ...]
    way: Way

    @property
    def names(self) -> set[str]:
        """The members that the requests are built from."""
        return set().union(*(each.names(self.grid.plan) for each in self.wanted))

    @property
    def kernel(self) -> Kernel:
        """The kernel of the requests, watched by the guards of what they are built from."""
        return self.grid.plan.made(("bulk", tuple(each.key for each in self.wanted)), self._make)

    def run(self, out: FloatArray | None) -> list[FloatArray]:
        """Return one array a request, in the usual shapes; rows of `out` where it is given."""
        grid, rows = self.grid, sum(each.rows for each in self.wanted)
        result = self.kernel(grid.flat, self._place(rows, out), self.way, grid.size)
        if grid.plan.may_overflow or not np.all(result.guards > 0.0):
            self._settle(result.values)
        found = grid.full(result.values)
        for first, each in self._starts():
            if isinstance(each.member, Quantity) and not each.along:
                self._unwrap(each, found[first])
        return [found[first : first + 2] if each.rows > 1 else found[first] for first, each in self._starts()]

    def _starts(self) -> Iterator[tuple[int, Wanted]]:
        """Yield each request with its first row."""
        first = 0
        for each in self.wanted:
            yield first, each
            first += each.rows

    def _make(self, plan: Plan) -> Kernel:
        nodes = [node for each in self.wanted for node in each.nodes(plan)]
        return Kernel(nodes, [guard.node for guard in plan.trace.guards if guard.step in self.names])

    def _guards(self, plan: Plan) -> Kernel:
        """Return the kernel of the guards themselves, pose by pose."""
        return Kernel([guard.node for guard in plan.trace.guards if guard.step in self.names])

    def _place(self, rows: int, out: FloatArray | None) -> FloatArray | None:
        """Return where the caller wants the results, shape (rows, designs, poses)."""
        grid = self.grid
        if out is None:
            return None
        shape = (rows, *grid.shape)
        if not isinstance(out, np.ndarray) or out.dtype != np.float64 or out.shape != shape or not out.flags.c_contiguous:
            given = f"{out.dtype} {out.shape}" if isinstance(out, np.ndarray) else repr(out)
            raise DefinitionError(
                f"{grid.plan.title}: out= is {given}; expected is a contiguous float64 array of the shape {shape}: "
                "one row a component of what is asked for."
            )
        return out.reshape(rows, *grid.size)

    # -- poses at a dead point or out of reach ---------------------------------------------------------

    def _settle(self, place: FloatArray) -> None:
        """Put right the poses where a guard tells: place them to rounding, refuse or mask those out of reach or singular."""
        plan, kernel = self.grid.plan, self.grid.plan.made(("guards", tuple(sorted(self.names))), self._guards)
        worst: dict[str, float] = {}
        for band, part in pieces(*self.grid.size):
            inputs = {name: cut(value, band, part, name in plan.table.entries) for name, value in self.grid.flat.items()}
            block = place[:, band, part]
            least = np.broadcast_to(kernel(inputs, way=self.way).values, (len(kernel.plan.outputs), *block.shape[1:]))
            with np.errstate(invalid="ignore"):
                bad = ~np.all(least > 0.0, axis=0) | ~np.isfinite(block).all(axis=0)
            if bad.any():
                paired = {name: spread(value, name in plan.table.entries, bad) for name, value in inputs.items()}
                self._put_right(block, bad, paired, worst)
        for name, condition in worst.items():
            warnings.warn(
                f"{plan.title}: {name} comes near a dead point (condition {condition:.1e}); expect ratios there to be off by "
                f"about {singular.loss(condition):.0e} of their size.",
                SingularWarning,
                stacklevel=5,
            )

    def _put_right(self, block: FloatArray, bad: Mask, inputs: dict[str, Any], worst: dict[str, float]) -> None:
        """Fill the poses of a block that a mask names, from their paired inputs."""
        plan, count = self.grid.plan, int(bad.sum())
        with np.errstate(all="ignore"):
            reading = plan.read(inputs)
            lost = np.zeros(count, bool)
            for name, mask in reach.failures(plan, reading, (count,)):
                if name in self.names:
                    lost |= mask
            conditions = {name: np.where(lost, np.nan, cond) for name, cond in singular.conditions(plan, reading, self.names).items()}
            refused = singular.refused(plan, conditions, (count,))
            if self.grid.unreachable == "raise" and (lost.any() or (refused.any() and any(each.along for each in self.wanted))):
                self._refuse()
            for first, each in self._starts():
                values = block[first : first + each.rows, bad] if each.along else components(reading, each, count)
                block[first : first + each.rows, bad] = np.where(lost | (refused & bool(each.along)), np.nan, values)
        for name, cond in conditions.items():
            near = cond[(cond > singular.WARN) & (cond <= singular.REFUSE)]
            if near.size and any(each.along for each in self.wanted):
                worst[name] = max(worst.get(name, 0.0), float(near.max()))

    def _refuse(self) -> None:
        """Raise the error of these poses, in the words of a motion."""
        grid = self.grid
        motion = Motion(grid.plan, grid.designs, grid.strokes)
        for each in self.wanted:
            target: Any = each.member.name or each.member
            if each.along:
                motion.ratio(target, wrt=each.along[0], order=len(each.along))

    # -- angles ----------------------------------------------------------------------------------------

    def _unwrap(self, each: Wanted, values: FloatArray) -> None:
        """Make the angles in a quantity continuous along the stroke, in place."""
        grid = self.grid
        axes = [value for value in grid.strokes.values() if value.ndim]
        (node,) = each.nodes(grid.plan)
        angles = angles_of(grid.plan, node)
        if not angles or not axes:
            return
        kernel = grid.plan.made(("angles", each.key), lambda _: Kernel(angles))
        raw = grid.full(kernel(grid.flat, way=self.way).values)
        joined = [unwrapped(angle, axes) for angle in raw]
        if any(np.any((after != before) & np.isfinite(after)) for before, after in zip(raw, joined, strict=True)):
            known: dict[Node, Any] = dict(zip(angles, joined, strict=True))
            values[...] = np.where(np.isnan(values), np.nan, interpret([node], grid.inputs, known)[0])


def angles_of(plan: Plan, node: Node) -> list[Node]:
    """Return the angles that a node is built from and that move."""
    behind = set(ancestors([node]))
    return [angle for angle in plan.trace.angles if angle in behind and angle.level is Level.POSE]


def components(reading: ArrayReading, each: Wanted, count: int) -> npt.NDArray[np.float64]:
    """Return a request's values in an eager reading, shape (rows, count)."""
    member = each.member
    if isinstance(member, (Point, Arrow)):
        place = reading.at(member) if isinstance(member, Point) else reading.vector(member)
        return np.array([np.broadcast_to(part, (count,)) for part in (place.x, place.y)], float)
    return np.array(np.broadcast_to(reading.value(member), (1, count)), float)


def pieces(m: int, n: int) -> Iterator[tuple[slice, slice]]:
    """Yield parts of a grid of at most some hundred thousand poses."""
    width = min(n, PIECE)
    height = max(1, PIECE // max(width, 1))
    for top in range(0, m, height):
        for left in range(0, n, width):
            yield slice(top, min(top + height, m)), slice(left, min(left + width, n))


def cut(value: Any, band: slice, part: slice, of_design: bool) -> Any:
    """Return the part of a flat input that belongs to a part of the grid."""
    if np.ndim(value) == 2:
        return value[band if value.shape[0] > 1 else slice(None), part]
    return value if np.ndim(value) == 0 or np.size(value) == 1 else value[band] if of_design else value[part]


def spread(value: Any, of_design: bool, mask: Mask) -> Any:
    """Return a flat input at the poses of a mask."""
    shaped = np.asarray(value, float)
    if shaped.ndim == 1 and of_design:
        shaped = shaped[:, None]
    return np.broadcast_to(shaped, mask.shape)[mask]
