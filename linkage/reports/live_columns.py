"""A machine's own columns as something to ask for: its table, read on the numbers of a program."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from functools import partial

import numpy as np

from ..errors import LinkageError, UntracedError
from ..mechanism import Mechanism
from ..motion import Column, Motion, Request, RequestLike, require_motion
from ..plan import Plan
from ..program import FloatArray
from ..quantities import Dimension, Quantity, Stroke, x, y
from ..statics import AnyMotion, LawRequest, TracedMotion
from .results import columns_by, results

CLOSE = 1e-6
"""How far a column may lie from the table's own values, compared with its greatest, to count as the same."""


def column_request(machine: Mechanism, place: int, name: str) -> LawRequest:
    """Return the request for a column of a machine's table of results, by its place and its name."""
    formula = partial(column_over, machine, place, name)
    return LawRequest(formula=formula, text=f"the column {name}", known=("column", machine, place, name), column=name)


def is_column(request: object) -> bool:
    """Return whether a request is for a column of the table alone: what no other request asks for."""
    return isinstance(request, LawRequest) and bool(request.column)


def column_over(machine: Mechanism, place: int, name: str, motion: AnyMotion) -> FloatArray:
    """Return a column's values over a motion's poses, from the machine's table of results."""
    given = require_motion(motion)
    found = columns_by(machine, given)
    if place >= len(found):
        if isinstance(motion, TracedMotion):
            raise UntracedError(f"{given.plan.title}: the column {name} is a member's, and the member does not say what asks for it.")
        found = results(machine, given)
    return np.asarray(np.asarray(found[place].values)[()])[()]


def column_requests(
    machine: Mechanism, motion: Motion, columns: Sequence[Column] | None = None
) -> dict[str, tuple[Column, RequestLike, str]]:
    """Return the columns of a motion of one design by their names: each, what asks for it, and why that does not give it, or "".

    `columns` are its results, where they are known already.
    """
    plain, names = plain_requests(machine.plan), Counter[str]()
    found: dict[str, tuple[Column, RequestLike, str]] = {}
    for place, column in enumerate(results(machine, motion) if columns is None else columns):
        names[column.name] += 1
        name = column.name if names[column.name] == 1 else f"{column.name} ({names[column.name]})"
        own = column_request(machine, place, column.name)
        for request in (plain.get(name), column.request, own):
            if request is not None:
                reason = not_followed(motion, request, column)
                found[name] = column, request, reason
                if not reason:
                    break
    return found


def plain_requests(plan: Plan) -> dict[str, RequestLike]:
    """Return what the columns ask for that every machine has: its strokes, the coordinates of its points, its outputs."""
    points: dict[str, RequestLike] = {f"{name}_{axis}": each(name) for name in plan.moving for axis, each in (("x", x), ("y", y))}
    outputs = {name: name for name, each in plan.of_kind(Quantity).items() if not isinstance(each, (Stroke, Dimension))}
    return points | outputs | {name: name for name in plan.strokes}


def not_followed(motion: Motion, request: RequestLike, column: Column) -> str:
    """Return why a program does not give a column, in words; empty where it does."""
    try:
        return "" if column_agrees(motion, request, column) else "what its program gives is not what the table says"
    except LinkageError as error:
        return str(error)


def column_agrees(motion: Motion, request: RequestLike, column: Column) -> bool:
    """Return whether a request's program gives what a column holds, NaN at the same poses."""
    own = np.broadcast_to(np.asarray(column.values, float), motion.shape)
    found = motion._requested(request) if isinstance(request, Request) else motion[request]
    size = float(np.nanmax(np.abs(own), initial=0.0))
    return bool(np.allclose(found, own, rtol=CLOSE, atol=CLOSE * size, equal_nan=True))
