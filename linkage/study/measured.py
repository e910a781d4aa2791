"""Quantities of many designs at the poses of one motion: outputs and requests in one kernel, functions of a motion beside them."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import prod
from typing import Any, TypeAlias, final

import numpy as np

from ..errors import DefinitionError, cited, unwarned
from ..mechanism import Mechanism
from ..motion import BoundRequest, Motion, Request, evaluate_grid, stroke_display_unit
from ..motion.grid import Grid, JoinedTo
from ..motion.requests import Value, bound
from ..plan import Plan
from ..program import FloatArray, Way
from ..quantities import Quantity
from ..units import show
from .checks import check_one_design, function_value

Measured: TypeAlias = str | Quantity | Request | Callable[[Motion], Any]
"""An output by its name, a quantity, a request such as `drive_force()`, or a function of a motion of many designs.

The function returns a number for each pose, or one for each design: `lambda motion: np.ptp(motion["tilt"], axis=-1)`.
"""


def number_bound(plan: Plan, quantity: Any) -> BoundRequest:
    """Return a quantity that is traced, bound to a plan; DefinitionError for what is none, and for a point, which has two coordinates."""
    if not isinstance(quantity, (str, Quantity, Request)):
        what = f"{plan.title}: {cited(quantity)} is no output, quantity, request or function of a motion"
        raise DefinitionError(f"{what}; give one, such as 'tilt' or drive_force().")
    found = bound(plan, quantity)
    if found.rows > 1:
        raise DefinitionError(f"{plan.title}: {found} has two coordinates; ask for a number, such as y({cited(quantity)}).")
    return found


def is_traced(quantity: Any) -> bool:
    """Return whether a quantity is part of the program, not a function of a motion."""
    return not callable(quantity) or isinstance(quantity, (Quantity, Request))


def measure_of(request: BoundRequest) -> str:
    """Return what a request measures: "length", "angle", or "" where that is not known."""
    member = request.member if isinstance(request, Value) and not request.along else None
    return str(member.measures or "") if isinstance(member, Quantity) else ""


def measured_title(plan: Plan, quantity: Any) -> str:
    """Return a quantity in words."""
    if is_traced(quantity):
        return str(number_bound(plan, quantity))
    name = str(getattr(quantity, "__name__", ""))
    return name.replace("_", " ") if name.isidentifier() else "the quantity"


@final
@dataclass(frozen=True, eq=False)
class Poses:
    """The poses that a study looks at: the motion of the machine as it is set, which can be assembled at all of them.

    Angles of other designs lie within 180 deg of those of this one.
    """

    base: Motion

    @classmethod
    def of(cls, machine: Mechanism, strokes: Mapping[str, Any], count: int) -> Poses:
        """Return the poses at strokes [SI], by default `count` of them over a single stroke.

        Raises DefinitionError for no poses, AssemblyError where the machine as it is set cannot be assembled.
        """
        check_one_design(machine)
        every = {name: np.linspace(each.start, each.end, count) for name, each in machine.strokes.items()}
        base = machine.at(**(strokes or (every if len(every) == 1 else {})))
        if not base.reached.size:
            raise DefinitionError(f"{machine.plan.title}: there are no strokes to look at; give at least one value of each.")
        return cls(base)

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape of the strokes."""
        return self.base.shape

    @property
    def count(self) -> int:
        """The number of poses."""
        return self.base.reached.size

    @cached_property
    def flat(self) -> dict[str, FloatArray]:
        """The strokes (n,)."""
        return {name: value.ravel() for name, value in self.base.strokes.items()}

    def words(self) -> str:
        """Return where the poses are: `S = 50 mm`, `S = 0 mm to 250 mm, 21 poses`."""
        said = []
        for name, value in self.flat.items():
            unit = stroke_display_unit(self.base.plan, name, "mm")
            ends = [show(float(end), unit) for end in (value.min(), value.max())]
            said.append(f"{name} = {' to '.join(dict.fromkeys(ends))}")
        return ", ".join(said) + (f", {self.count} poses" if self.count > 1 else "")

    def traced(self, machine: Mechanism, requests: Sequence[Any], way: Way, poses: slice = slice(None)) -> list[FloatArray]:
        """Return requests of m designs at n of the poses, an array (m, n) each, NaN where they have no value."""
        found = evaluate_grid(self._grid(machine, poses), requests, None, way, "nan")
        return [each.reshape(-1, each.shape[-1]) for each in found]

    def motion(self, machine: Mechanism) -> Motion:
        """Return the motion of m designs at all poses, NaN out of reach."""
        base = self.base
        joining = JoinedTo(base._grid, np.arange(self.count).reshape(self.shape))
        return Motion(base.plan, machine.dimensions, base.strokes, "nan", joining=joining)

    def of_function(self, machine: Mechanism, function: Callable[[Motion], Any]) -> FloatArray:
        """Return what a function of a motion gives of m designs, shape (m, n), or (m, 1) of one number for each design."""
        return function_array(function, self.motion(machine))

    def values(self, machine: Mechanism, quantity: Any, way: Way) -> FloatArray:
        """Return a quantity of m designs at the poses, shape (m, n), or (m, 1) of one number for each design."""
        with unwarned(), np.errstate(all="ignore"):
            if is_traced(quantity):
                return self.traced(machine, [quantity], way)[0]
            return self.of_function(machine, quantity)

    def shaped(self, values: FloatArray) -> FloatArray:
        """Return values (..., n) in the shape of the strokes; numbers for each design, (..., 1), without it."""
        return values.reshape((*values.shape[:-1], *(self.shape if values.shape[-1] == self.count else ())))

    def _grid(self, machine: Mechanism, poses: slice) -> Grid:
        places = np.arange(self.count)[poses]
        strokes = {name: value[poses] for name, value in self.flat.items()}
        return Grid(self.base.plan, machine.dimensions, strokes, joining=JoinedTo(self.base._grid, places))


def function_array(function: Callable[[Motion], Any], motion: Motion) -> FloatArray:
    """Return what a function of a motion of m designs gives, shape (m, n) or (m, 1); DefinitionError for anything else."""
    found, designs = function_value(function, motion), motion._design_shape
    title, what, m = motion.plan.title, measured_title(motion.plan, function), prod(motion._design_shape)
    try:
        result = np.asarray(found, float)
    except (TypeError, ValueError):
        raise DefinitionError(f"{title}: {what} gives {cited(found)}; a number for each pose or each design is expected.") from None
    if result.shape == motion.shape:
        return np.where(motion.reached & np.isfinite(result), result, np.nan).reshape(m, -1)
    if result.shape != designs:
        text = f"{title}: {what} has the shape {result.shape} where {motion.shape} or {designs} is expected"
        raise DefinitionError(f"{text}; return a number for each pose, or one for each design.")
    lost = ~motion.reached.reshape(m, -1).all(axis=1)
    return np.where(lost | ~np.isfinite(result.ravel()), np.nan, result.ravel())[:, None]
