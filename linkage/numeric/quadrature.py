"""The integral of a function along a line: Gauss's rule in panels that are halved until they agree, fine where the function has kinks."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import NamedTuple

import numpy as np

from ..vectors import FloatArray

PANELS, NODES = 24, 5
"""Panels to begin with, and the Gauss points of each."""
BISECTIONS, WORK = 16, 1e-10
"""How often panels are halved at the most, and what part of an integral a panel may be wrong by."""
ENDLESS = 1e-2
"""Of the panels' sizes: panels that disagree by more however fine they are stand at a pole, and there is no integral."""


class Quadrature(NamedTuple):
    """An integral (...), infinite where there is none, the `error` that the panels leave (...), and their `edges` (n + 1,)."""

    value: FloatArray
    error: FloatArray
    edges: FloatArray


def quadrature(values: Callable[[FloatArray], FloatArray], edges: FloatArray | None = None) -> Quadrature:
    """Return the integral of `values(places)`, (..., n) at places (n,), over the panels between edges, by default from 0 to 1.

    Of several functions at once the panels are fine enough for all of them.
    """
    edges = np.linspace(0.0, 1.0, PANELS + 1) if edges is None else edges
    shares = by_panel(values(gauss(edges)[0]), edges)
    error = np.zeros(shares.shape[:-1])
    for _ in range(BISECTIONS):
        finer = np.sort(np.concatenate([edges, 0.5 * (edges[:-1] + edges[1:])]))
        seen = values(np.concatenate([gauss(finer)[0], finer]))
        inside, ends = seen[..., : -len(finer)], seen[..., -len(finer) :]
        pairs = by_panel(inside, finer).reshape(*shares.shape, 2)
        apart, size = np.abs(pairs.sum(axis=-1) - shares), np.abs(pairs).sum(axis=(-2, -1))
        error = apart.sum(axis=-1)
        coarse = apart > WORK * size[..., None]
        inside = inside.reshape(*inside.shape[:-1], -1, NODES)
        off = np.abs(inside @ gauss_rule()[2] - np.stack([ends[..., :-1], ends[..., 1:]], axis=-1)).max(axis=-1)
        bent = off > WORK**0.5 * np.abs(inside).max(axis=(-2, -1), initial=0.0)[..., None]  # a kink lies beside the end
        coarse |= bent.reshape(*shares.shape, 2).any(axis=-1)
        coarse = coarse.reshape(-1, coarse.shape[-1]).any(axis=0)
        if not coarse.any():
            return Quadrature(pairs.sum(axis=(-2, -1)), error, edges)
        keep = np.concatenate([[True], np.stack([coarse, np.ones_like(coarse)], axis=1).ravel()])
        parts = [pair if split else [pair.sum(axis=0)] for pair, split in zip(np.moveaxis(pairs, (-2, -1), (0, 1)), coarse, strict=True)]
        shares = np.moveaxis(np.concatenate(parts), 0, -1)
        edges = finer[keep]
    total = shares.sum(axis=-1)
    return Quadrature(np.where(error > ENDLESS * np.abs(shares).sum(axis=-1), np.inf, total), error, edges)


@cache
def gauss_rule() -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return places from -1 to 1 and weights of Gauss's rule, and what makes of values there those at -1 and 1 (nodes, 2)."""
    places, weights = np.polynomial.legendre.leggauss(NODES)
    return places, weights, np.asarray(np.linalg.solve(np.vander(places).T, np.vander([-1.0, 1.0], NODES).T), float)


def gauss(edges: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return places and weights of Gauss's rule in the panels between edges."""
    places, weights, _ = gauss_rule()
    widths = np.diff(edges)[:, None]
    return (edges[:-1, None] + 0.5 * (places + 1.0) * widths).ravel(), (0.5 * weights * widths).ravel()


def by_panel(values: FloatArray, edges: FloatArray) -> FloatArray:
    """Return the integrals (..., panels) over the panels between edges, of values (..., n) at Gauss's places."""
    return np.asarray((values * gauss(edges)[1]).reshape(*values.shape[:-1], len(edges) - 1, NODES).sum(axis=-1))
