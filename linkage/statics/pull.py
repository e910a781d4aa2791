"""The direction against which a load pulls: two numbers, quantities that follow the pose, or arrays over the poses of a motion."""

from __future__ import annotations

from typing import Any, TypeAlias

import numpy as np

from ..errors import DefinitionError, SingularError, cited
from ..loads import Force
from ..motion import Motion
from ..motion.measures import words_of
from ..program import FloatArray
from ..quantities import Quantity, quantity, real
from .poses import AnyMotion

Direction: TypeAlias = "tuple[Any, Any]"
"""The parts of a direction of length one: numbers, quantities, or arrays."""


def pull_direction(along: object, title: str = "") -> Direction:
    """Return a direction of length one as numbers, quantities or arrays; DefinitionError for what is none."""
    parts = list(along) if isinstance(along, (list, tuple, np.ndarray)) else []
    try:
        if len(parts) == 2 and any(isinstance(each, (Quantity, str)) for each in parts):
            x, y = map(quantity, parts)
            length = np.sqrt(x**2 + y**2)
            return x / length, y / length
        given = np.stack(np.broadcast_arrays(*map(real, parts))) if len(parts) == 2 else np.zeros(2)
    except (DefinitionError, TypeError, ValueError, OverflowError):
        given = np.zeros(2)
    size = np.hypot(*given)
    if not (size.size and np.all(np.isfinite(size) & (size > 0.0))):
        what = f"{title}along={cited(along)} is no direction, it has no length"
        raise DefinitionError(f"{what}; write (x, y), such as (0, 1) for a load that hangs.")
    x, y = given / size
    return (float(x), float(y)) if given.ndim == 1 else (x, y)


def is_steady(along: Direction) -> bool:
    """Return whether a direction is the same at all poses."""
    return all(isinstance(each, float) for each in along)


def direction_words(along: Direction) -> str:
    """Return a direction in words."""
    if any(isinstance(each, np.ndarray) for each in along):
        remedy = "ask a circuit for them, circuit.capacity(motion, ...), or give quantities"
        raise DefinitionError(f"along= is an array, which is of the poses of one motion; {remedy}.")
    return f"({', '.join(f'{each:g}' if isinstance(each, float) else words_of(each) for each in along)})"


def direction_at(along: Direction, motion: AnyMotion) -> tuple[FloatArray, FloatArray]:
    """Return both parts of a direction over a motion's poses; DefinitionError where it does not fit them, or has no length."""
    lost = np.zeros((), bool)
    try:
        found = [motion.value(each) if isinstance(each, Quantity) else np.asarray(each) for each in along]
    except SingularError as error:
        lost = np.asarray(error.mask)
    if isinstance(motion, Motion) and not lost.any():
        try:
            lost = np.isnan(np.broadcast_to(found[0] + found[1], motion.shape)) & motion.reached
        except ValueError:
            what = f"along= has the shape {np.shape(found[0])}, which does not fit the poses {motion.shape}"
            raise DefinitionError(f"{motion.plan.title}: {what}; give one direction, or one for each pose.") from None
    if lost.any():
        words = direction_words(along) if not any(isinstance(each, np.ndarray) for each in along) else "an array"
        raise DefinitionError(f"{motion.plan.title}: along={words} has no length at {np.sum(lost)} poses.")
    return found[0], found[1]


def pulling(point: str, along: Direction, load: FloatArray | float, motion: AnyMotion) -> Force:
    """Return the force of a load [N] that pulls at a point against a direction, at a motion's poses or shaped as these."""
    if isinstance(load, np.ndarray) and not is_steady(along):
        along = direction_at(along, motion)
    return Force(point, (-1.0 * along[0] * load, -1.0 * along[1] * load))
