"""Targets: what a quantity is to be at a pose, of dimensions that are looked for or of strokes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NoReturn, final

import numpy as np

from ..checks import require_number
from ..errors import DefinitionError, cited
from ..frozen import FrozenDict, read_only
from ..plan import Plan, require_kind
from ..program import FloatArray
from ..quantities import Quantity, is_number, numbers_in
from ..units import amount_or_float, deg, display_unit, mm, require_measure, unit_or_none
from .kinds import measure_of
from .requests import Request, RequestLike


@final
class Target:
    """A value [SI] that a quantity is to have at a pose: `Target(y("F"), 0.45, S=0.05)`, `Target("tilt", 0.0, unit="deg", S=0.05)`.

    The quantity is an output, a quantity or a request. `within` says how far off it may be [SI], by default 1 mm, 0.1 deg, or a
    thousandth: where nothing gives all targets, misses are weighed by it. `unit` is that of the words. Where strokes are looked for,
    in `strokes_for` and `follow`, it says none; there angles count modulo a turn. In `follow` the value may be an array (places,).
    """

    def __init__(
        self, quantity: RequestLike, value: float | FloatArray, *, within: float | None = None, unit: str = "", **strokes: float
    ) -> None:
        what = f"Target({quantity_cited(quantity)}, {cited(value)})"
        if within is not None:
            require_number(f"{what}: within", within, "how far off it may be [SI], a number above zero, is expected", above=0.0)
        if not all(map(is_one, strokes.values())):
            raise DefinitionError(f"{what}: one number is expected for each stroke, in SI.")
        known: float | FloatArray
        if is_one(value):
            known = float(value)
        else:  # the values of a path, shape (places,)
            known = read_only(numbers_in(value))
            if known.ndim != 1 or not known.size or not np.isfinite(known).all():
                said = "one number is expected for the value, in SI. Along a path it is an array, a number a place"
                raise DefinitionError(f"{what}: {said}.")
        pose = FrozenDict({name: amount_or_float(each) for name, each in strokes.items()})
        parts = {"quantity": quantity, "value": known, "within": within, "strokes": pose}
        vars(self).update(parts, unit=unit_or_none(unit, where="Target(unit=...)"), given=value)

    quantity: RequestLike
    value: float | FloatArray
    within: float | None
    unit: str
    strokes: Mapping[str, float]
    given: object
    """Its value as it was given, with the unit where that was said."""

    def __setattr__(self, name: str, value: object) -> NoReturn:
        raise DefinitionError(f"Target.{name} = ...: it does not change; make a new one, Target(...).")

    def __repr__(self) -> str:
        value = cited(self.value.tolist()) if isinstance(self.value, np.ndarray) else repr(self.value)
        return f"Target({', '.join([quantity_cited(self.quantity), value, *(f'{k}={v!r}' for k, v in self.strokes.items())])})"

    @property
    def is_path(self) -> bool:
        """Whether its value is an array, one value a place along a path."""
        return isinstance(self.value, np.ndarray)

    def check(self, plan: Plan) -> None:
        """Raise DefinitionError for a value, `within` or a stroke in a unit of another kind than what they are of."""
        kind = measure_of(plan, self.quantity)
        for what, value in (("", self.given), (": within", self.within)):
            if kind:
                require_measure(value, kind, f"{plan.title}: Target({quantity_cited(self.quantity)}, ...){what}")
        for name, value in self.strokes.items():
            require_kind(plan, name, value, f"{plan.title}: Target({quantity_cited(self.quantity)}, ...): {name}")

    def miss(self, plan: Plan, value: float) -> float:
        """Return how far off it may be where it is to have a value [SI]: `within`, or what is usual of what it measures."""
        kind = measure_of(plan, self.quantity)
        return self.within or {"length": 1.0 * mm, "angle": 0.1 * deg}.get(kind, 1e-3 * abs(value) or 1e-3)

    def shown_in(self, plan: Plan) -> str:
        """Return the unit that it is shown in."""
        return self.unit or display_unit(measure_of(plan, self.quantity), "mm")


def quantity_cited(quantity: object) -> str:
    """Return what a target is of as it is written in a message: `'tilt'`, `x(M)`."""
    return str(quantity) if isinstance(quantity, (Quantity, Request)) else cited(quantity)


def targets_given(given: object, title: str, example: str) -> Sequence[Target]:
    """Return what is a list of targets, one at least; DefinitionError for anything else."""
    if not isinstance(given, (list, tuple)) or not given or not all(isinstance(each, Target) for each in given):
        raise DefinitionError(f"{title}: {cited(given)}: a list of targets is expected, {example}.")
    return given


def is_one(value: object) -> bool:
    """Return whether a value is one finite number."""
    return is_number(value.item() if isinstance(value, np.ndarray) and value.ndim == 0 and not np.ma.is_masked(value) else value)
