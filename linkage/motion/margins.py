"""How clear each loop stays of its dead point over all that a motion covers: below zero it cannot be assembled there.

A loop's margin is a smooth function of the strokes, whether it is assembled or not. So the search for extremes finds its least value, and
with it a part of the strokes out of reach that is far narrower than any grid.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, final

import numpy as np

from ..errors import AssemblyError
from ..plan import Mask
from ..program import FloatArray
from .grid import recalled
from .interruptions import ON_ARRAYS, ROUNDING, Clearances
from .motion import Motion
from .search import extremum_reached, places_text
from .stroke_search import out_of_reach


@final
@dataclass(frozen=True, eq=False)
class LeastMargin:
    """The least margin of one loop, and where: floats, or arrays over the designs.

    `value` is the squared sine of the angle between two links, or two guides, and the length where that follows others [m]; below zero
    the `step` cannot be assembled, by more than rounding where it `is_hole`. NaN where no pose tells. `strokes` [m or rad, which `units`
    say] are the place.
    """

    step: str
    kind: str
    value: Any
    is_hole: Any
    strokes: Mapping[str, Any]
    units: Mapping[str, str]

    def __str__(self) -> str:
        return f"{self.step}: {np.min(self.value):.3g} at {places_text(self.strokes, self.units)}"


def least_margins(motion: Motion, kept: Callable[[Motion], Mask] | None = None) -> list[LeastMargin]:
    """Return the least margin of every loop that moves, over the range, the path or the box that a motion covers.

    `kept` says which poses are asked for, all where it is None.

    A hole down to 1e-5 of the strokes is found. Groups, whose pins are looked for by iteration, have no such margin, and laws that give no
    value somewhere have none either.
    """
    known = motion.plan.made("clearances", Clearances.of)
    if not (known.loops and motion.strokes):
        return []

    def asked(each: Motion) -> FloatArray:
        found = margins(each, known)
        return found if kept is None else np.where(kept(each), found, np.nan)

    def found() -> list[LeastMargin]:
        least, each_of = extremum_reached(motion, asked, -1.0, everywhere=True), list[LeastMargin]()
        for row, loop in enumerate(known.loops):
            place = {name: value[row] for name, value in least.strokes.items()}
            hole = np.asarray(least.value[row] < -rounding_at(motion, known, place)[row].reshape(motion._design_shape))[()]
            each_of.append(LeastMargin(loop.step, loop.kind, least.value[row], hole, place, least.units))
        return each_of

    return recalled(motion, "margins", found) if kept is None else found()


def margins(motion: Motion, known: Clearances) -> FloatArray:
    """Return the margins of loops, shape (loops, ...), smooth: sines of guides are squared."""
    grid = motion._grid
    values = known.kernel(grid.flat, way=ON_ARRAYS, size=grid.size).values
    found = grid.full(values)
    is_signed = known.is_signed.reshape(-1, *(1,) * len(grid.shape))
    return np.where(is_signed, found * found, found)


def rounding_at(motion: Motion, known: Clearances, strokes: Mapping[str, Any]) -> FloatArray:
    """Return by how much rounding moves the margins of loops, shape (loops, ...), at a place of each design."""
    there = {name: np.reshape(value, (*motion._design_shape, 1)) for name, value in strokes.items()}
    grid = Motion(motion.plan, motion.designs, there, "nan", per_design=True)._grid
    sizes = known.rounding(grid.flat, way=ON_ARRAYS, size=grid.size).values
    return np.asarray(ROUNDING * np.fmax(np.abs(grid.full(sizes))[..., 0], 1.0))


def assembly_error_at(motion: Motion, strokes: Mapping[str, float]) -> AssemblyError | None:
    """Return why a motion's one design cannot be assembled at strokes [m or rad], as that pose says it; None where it can.

    Its text names the step, what is missing there and the remedy; `point` is the step, `shortfall` what is missing [m].
    """
    there = motion.moved({name: np.reshape(value, (1,)) for name, value in strokes.items()})
    return None if there.reached.all() else out_of_reach(there)
