"""Derivatives by dimensions: reverse mode through the program, all dimensions at once."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from ..plan import Plan
from ..program import FloatArray, Kernel, gradient
from .request import Request, dimensions_of, wanted

if TYPE_CHECKING:
    from .motion import Motion


def gradient_of(motion: Motion, of: Request, wrt: Sequence[str]) -> FloatArray:
    """Return the derivatives of a request by dimensions, shape (len(wrt), ...), of a point (len(wrt), 2, ...); see Motion.gradient."""
    plan = motion.plan
    what, dimensions = wanted(plan, of), dimensions_of(plan, wrt)
    names = tuple(name for name, _ in dimensions)

    def make(plan: Plan) -> Kernel:
        inputs = [plan.trace.inputs[name] for name in names]
        return Kernel([share for node in what.nodes(plan) for share in gradient(node, inputs)])

    title = f"The gradient of {what}"
    refused = motion.refused(what.member, title, 1 + len(what.along))
    values = motion.full(plan.made(("gradient", what.key, names), make)(motion.flat).values)
    signs = np.array([sign for _, sign in dimensions], float).reshape(-1, *(1,) * len(motion.shape))
    parts = [signs * each for each in np.split(values, what.rows)]
    found = np.stack(parts, axis=1) if what.rows > 1 else parts[0]
    rows = np.where(motion.reached & ~refused, found, np.nan).reshape(-1, *motion.shape)
    return motion.finite(rows, refused, title).reshape(found.shape)
