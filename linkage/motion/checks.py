"""What a motion is asked for, checked: names, rates, orders and steps."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from ..errors import DefinitionError, known_name
from ..program import FloatArray
from ..quantities import Member, is_number, is_whole, real


def named(kind: str, target: Any, known: Iterable[str], title: str) -> str:
    """Return the name of a member or the name as given; raise DefinitionError where it is not a known one."""
    return known_name(kind, target.name if isinstance(target, Member) else target, known, where=title)


def rates_of(what: str, given: Any, strokes: Mapping[str, FloatArray], shape: tuple[int, ...], title: str) -> dict[str, FloatArray]:
    """Return the stroke rates by name, a float or an array over the poses; DefinitionError for anything else."""
    if not isinstance(given, Mapping):
        example = f"{what}=dict({next(iter(strokes), 'S')}=0.05)"
        raise DefinitionError(f"{title}: {what}={given!r}: a value for each stroke is expected, such as {example}.")
    return {named("Stroke", name, strokes, title): rate_of(f"{what}: {name}", value, shape, title) for name, value in given.items()}


def rate_of(what: str, value: Any, shape: tuple[int, ...], title: str) -> FloatArray:
    """Return one rate; DefinitionError unless it is finite and fits the poses."""
    try:
        rate = real(value)
        fits = np.broadcast_shapes(rate.shape, shape) == shape
    except ValueError:
        fits = False
    if not fits or not np.all(np.isfinite(rate)):
        raise DefinitionError(f"{title}: {what}={value!r}: a finite number or an array that fits the poses {shape} is expected.")
    return rate


def order_of(order: Any) -> int:
    """Return the order of a derivative; DefinitionError unless it is 1 or 2."""
    if not is_whole(order) or order not in (1, 2):
        raise DefinitionError(f"order={order!r}: derivatives of order 1 and 2 are provided.")
    return int(order)


def method_of(method: Any, step: Any) -> str:
    """Return how to differentiate; DefinitionError for an unknown word or a step that is not a positive number."""
    if not isinstance(method, str) or method not in ("exact", "central"):
        raise DefinitionError(f'method={method!r}: say "exact" or "central".')
    if step is not None and not (is_number(step) and step > 0.0 and method == "central"):
        raise DefinitionError(f'step={step!r}: a positive number in the unit of the stroke, together with method="central", is expected.')
    return method
