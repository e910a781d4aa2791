"""What a study measures: an output by name, a quantity, or any function of a motion; and of which machines."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, TypeAlias

import numpy as np

from ..errors import AssemblyError, DefinitionError, UntracedError, cited, told, unwarned
from ..mechanism import Mechanism
from ..motion import Motion, Request
from ..motion.measures import words_of
from ..plan import Plan
from ..program import FloatArray
from ..quantities import Quantity, is_number

QuantityLike: TypeAlias = str | Quantity | Request | Callable[[Motion], FloatArray]
"""A named output, a quantity, a request, or a function of a motion that returns a number for each pose, NaN where it has none."""


def unit_of(plan: Plan, name: str) -> str:
    """Return the unit a dimension is shown in: its own, mm for lengths, deg for angles, "" where nothing says."""
    found = plan.table.entries[plan.table.spellings[name][0]]
    return found.unit or {"length": "mm", "coordinate": "mm", "angle": "deg"}.get(found.kind, "")


def is_one(value: Any) -> bool:
    """Return whether a value is one finite number."""
    return is_number(value.item() if isinstance(value, np.ndarray) and value.ndim == 0 and not np.ma.is_masked(value) else value)


def check_mechanism(machine: Any) -> None:
    """Raise DefinitionError for anything but an instance of a mechanism."""
    if not isinstance(machine, Mechanism):
        name = machine.__name__ if isinstance(machine, type) else ""
        remedy = f"{name} is a class; give a design of it, {name}()" if name else f"{machine!r:.60} is none"
        raise DefinitionError(f"A study is of a mechanism: {remedy}.")


def check_one_design(machine: Mechanism) -> None:
    """Raise DefinitionError for a batch of designs, and for what is no mechanism."""
    check_mechanism(machine)
    if any(np.ndim(value) for value in machine.dimensions.values()):
        raise DefinitionError(f"{type(machine).__name__}: a study starts from one design, this is a batch; choose one of them.")


def check_vary(machine: Mechanism, what: str, over: Any) -> None:
    """Raise DefinitionError where the designs of a study, or strokes, are given as `over`."""
    if over is None:
        return
    title = machine.plan.title
    if isinstance(over, Mapping) and any(name in machine for name in over):
        raise DefinitionError(f"{title}: {what}(over={cited(over)}): dimensions are varied by vary=, strokes run by over=; write vary=.")
    remedy = "name its strokes, such as S=[0.0, 0.1]" if what == "zone" else "let measure(machine) say at which strokes it looks"
    raise DefinitionError(f"{title}: {what}(over={cited(over)}): a {what} varies designs, vary=, and has no over=; {remedy}.")


WHOLE_POSES = {1: 101, 2: 25, 3: 13, 4: 8, 5: 6, 6: 5}
"""Poses of each stroke at which a machine is looked at that is to be assembled over all of them."""


def why_not_assembled(machine: Mechanism) -> str:
    """Return why a machine cannot be assembled over the box of its whole strokes, in one line; "" of one that can."""
    count = WHOLE_POSES.get(len(machine.strokes), 3)
    axes = [np.linspace(each.start, each.end, count) for each in machine.strokes.values()]
    try:
        at: dict[str, Any] = dict(zip(machine.strokes, np.meshgrid(*axes, indexing="ij"), strict=True))
        machine.at(**at)
    except AssemblyError as error:
        return " ".join(str(error).split())
    return ""


def function_value(quantity: Callable[[Motion], Any], motion: Motion) -> Any:
    """Return what a function of a motion gives; DefinitionError, with the line, for whatever goes wrong in it."""
    name = getattr(quantity, "__name__", cited(quantity))
    with told(f"{motion.plan.title}: the function {name} of a motion of many settings"):
        return quantity(motion)


def real_numbers(found: Any) -> FloatArray:
    """Return what a function gives as an array of floats; TypeError for complex numbers, of which a part would be lost."""
    if np.iscomplexobj(found):
        raise TypeError("complex numbers")
    return np.asarray(found, float)


def quantity_values(motion: Motion, quantity: QuantityLike, *, endless: bool = False) -> FloatArray:
    """Return a quantity at every pose of a motion, NaN where it has no value; nearness to a dead point is told by the study.

    An infinite one is none, unless it may be `endless`.
    """
    title = motion.plan.title
    if isinstance(quantity, type) or not (callable(quantity) or isinstance(quantity, (str, Quantity, Request))):
        raise DefinitionError(f"{title}: {cited(quantity)} is no output, quantity or function of a motion; give one, such as 'tilt'.")
    with unwarned(), np.errstate(all="ignore"):
        if callable(quantity):
            found = function_value(quantity, motion)
        elif isinstance(quantity, Request):
            try:  # by its program where it has one
                found = motion._requested(quantity)
            except UntracedError:
                found = motion[quantity]
        else:
            found = motion[quantity]
    try:
        result = real_numbers(found)
    except (TypeError, ValueError):
        raise DefinitionError(f"{title}: {words_of(quantity)} gives {cited(found)}; a number for each pose is expected.") from None
    if result.shape != motion.shape:
        what = f"{words_of(quantity)} has the shape {result.shape} where {motion.shape} is expected"
        raise DefinitionError(f"{motion.plan.title}: {what}; ask for a number such as an output, or lambda motion: motion.y('G').")
    return np.where((~np.isnan(result) if endless else np.isfinite(result)) & motion.reached, result, np.nan)
