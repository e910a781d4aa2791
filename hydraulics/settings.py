"""Settings that may follow the design: a number, or a dimension, an expression of dimensions or its name in the place of one."""

from __future__ import annotations

from typing import Any

from linkage.errors import DefinitionError
from linkage.loads import ForceElement, Poses
from linkage.loads.element import value_text
from linkage.plan import ArrayReading
from linkage.quantities import Quantity, quantity

from .inputs import Array, finite


def follows(*values: Any) -> bool:
    """Return whether one of the values is no number: a quantity, or the name of one."""
    return any(isinstance(value, Quantity) or (isinstance(value, str) and value.isidentifier()) for value in values)


def following(*values: Any) -> tuple[Quantity, ...]:
    """Return those of the values that are no numbers, as quantities."""
    return tuple(quantity(value) for value in values if follows(value))


def setting(motion: Poses, given: Any, what: str) -> Any:
    """Return a setting as a motion's designs have it [SI], shaped to broadcast against the motion.

    DefinitionError for one that follows a stroke.
    """
    if not follows(given):
        return given
    if motion.plan.moves(quantity(given)):
        raise DefinitionError(f"{what} = {value_text(given)} follows a stroke, but is set before it moves; let it follow dimensions only.")
    return ArrayReading(motion.plan.members, motion.plan.table.lengths, motion.inputs).value(quantity(given))


def number_set(element: ForceElement, motion: Poses, name: str) -> Array:
    """Return a parameter of a force element as a motion's designs have it [SI], shaped to broadcast against the motion."""
    given = getattr(element, name)
    return finite(setting(motion, given, name.capitalize()), name.capitalize()) if follows(given) else element.number(motion, name)
