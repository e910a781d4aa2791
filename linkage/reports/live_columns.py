"""A machine's own columns as something to ask for: its table, read on the numbers of a program."""

from __future__ import annotations

from collections import Counter
from collections.abc import Container, Hashable, Iterable, Mapping, Sequence
from contextlib import suppress
from functools import partial
from typing import TypeAlias

import numpy as np

from ..errors import LinkageError, UntracedError
from ..loads import PLAIN_CASE, Case
from ..mechanism import Mechanism
from ..motion import Column, Motion, Request, RequestLike, require_motion
from ..motion.evaluation import Evaluation
from ..motion.requests import as_they_run, bound
from ..program import FloatArray
from ..quantities import Dimension, Quantity, Stroke, x, y
from ..statics import AnyMotion, LawRequest, TracedMotion
from .results import columns_by, request_in_case, results

LiveColumn: TypeAlias = tuple[Column, RequestLike, str]
"""A column, what asks for it, and why its program does not give it, or ""."""
CLOSE = 1e-6
"""How far a column may lie from the table's own values, compared with its greatest, to count as the same."""


def is_column(request: object) -> bool:
    """Return whether a request is for a column of the table alone, which no other request gives."""
    return isinstance(request, LawRequest) and bool(request.column)


def column_over(machine: Mechanism, place: int, name: str, motion: AnyMotion) -> FloatArray:
    """Return a column's values over a motion's poses, from the machine's table of results."""
    given = require_motion(motion)
    found = columns_by(machine, given)
    if place >= len(found):
        if isinstance(motion, TracedMotion):
            raise UntracedError(f"{given.plan.title}: the column {name} is a member's, and the member does not say what asks for it.")
        found = results(machine, given, PLAIN_CASE)
    return np.asarray(np.asarray(found[place].values)[()])[()]


def column_requests(
    machine: Mechanism, motion: Motion, columns: Sequence[Column] | None = None, only: Container[str] | None = None, case: Case = None
) -> dict[str, LiveColumn]:
    """Return the columns of a motion of one design by their names: each, its request, and why that gives other values, or "".

    `columns` are its results, where they are known already; `only` are the names of those that are wanted, by default all. They are of a
    load case, what asks for them of any.
    """
    plan, names = machine.plan, Counter[str]()
    points: dict[str, RequestLike] = {f"{name}_{axis}": each(name) for name in plan.moving for axis, each in (("x", x), ("y", y))}
    outputs = {name: name for name, each in plan.of_kind(Quantity).items() if not isinstance(each, (Stroke, Dimension))}
    plain = points | outputs | {name: name for name in plan.strokes}  # what the columns ask for that every machine has
    found: dict[str, LiveColumn] = {}
    acting = {} if case in (None, PLAIN_CASE) else {column.name: column for column in results(machine, motion, case)}
    shown = results(machine, motion, PLAIN_CASE) if columns is None else columns
    left: dict[str, list[RequestLike]] = {}
    for place, plainly in enumerate(shown):
        column = acting.get(plainly.name, plainly)
        names[column.name] += 1
        name = column.name if names[column.name] == 1 else f"{column.name} ({names[column.name]})"
        if only is None or name in only:
            formula, known = partial(column_over, machine, place, column.name), ("column", machine, place, column.name)
            own = LawRequest(formula=formula, text=f"the column {column.name}", known=known, column=column.name)
            left[name] = [each for each in (plain.get(name), plainly.request, own) if each is not None]
            found[name] = column, own, ""
    reasons: dict[str, str] = {}
    while left:  # the first of what may ask for each, those without success the next
        asked = {name: each.pop(0) for name, each in left.items()}
        values = values_together(motion, [request_in_case(each, case) for each in asked.values()])
        for name, request in asked.items():
            column, *_ = found[name]
            why = not_followed(motion, request_in_case(request, case), column, values)
            found[name] = column, request, why and reasons.setdefault(name, why)
        left = {name: each for name, each in left.items() if each and found[name][2]}
    return found


def at_its_rates(motion: Motion, request: RequestLike) -> RequestLike:
    """Return a request for a program that takes the rates of a motion in time, and accelerations where no rate jumps; else as it is."""
    return request if motion.time is None else as_they_run([request], motion._rate_jump is None, True)[0]


def values_together(motion: Motion, requests: Iterable[RequestLike]) -> dict[Hashable, FloatArray]:
    """Return the values of requests by their keys, from one program; those are left out that are refused or looked at closely."""
    found, asked = dict[Hashable, FloatArray](), list[Request]()
    for each in requests:
        with suppress(LinkageError):
            asked.append(bound(motion.plan, at_its_rates(motion, each)))
    with suppress(LinkageError):
        values, look = Evaluation(motion._grid, tuple(asked)).evaluate(among=motion.reached.reshape(motion._grid.size))
        for k, (each, own) in enumerate(zip(asked, values, strict=True)):
            if look is None or look.is_clear(k):
                found[each.key] = np.where(motion.reached, own, np.nan)
    return found


def not_followed(motion: Motion, request: RequestLike, column: Column, known: Mapping[Hashable, FloatArray]) -> str:
    """Return why a program's values differ from a column's, NaN at the same poses, in words; empty where they agree."""
    own, request = np.broadcast_to(np.asarray(column.values, float), motion.shape), at_its_rates(motion, request)
    try:
        found = known.get(bound(motion.plan, request).key)
        if found is None:
            found = motion._requested(request) if isinstance(request, Request) else motion[request]
    except LinkageError as error:
        return str(error)
    close = CLOSE * float(np.nanmax(np.abs(own), initial=0.0))
    is_same = np.allclose(found, own, rtol=CLOSE, atol=close, equal_nan=True)
    return "" if is_same else "what its program gives is not what the table says"
