"""The pins of a group, found by Newton's method with the exact Jacobian of the program, many poses at once."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from ..plan import Plan
from ..program import FloatArray, Kernel, jacobian, solve_arrays
from ..steps import Group

Mask = npt.NDArray[np.bool_]
CONVERGED = 1e-10
#: A step so small, against the group's size, leaves an error of its square: 1e-14 and less.
QUADRATIC = 1e-7


class Newton:
    """The equations of one group of a plan in its pins' coordinates; groups before it are inputs.

    Inputs are floats or arrays (n,), one value a pose, dimensions and strokes alike; unknowns have the shape (coordinates, n) [m].
    """

    def __init__(self, plan: Plan, group: Group) -> None:
        self.plan, self.group = plan, group
        self.names = group.inputs[:-1]

    @property
    def _kernel(self) -> Kernel:
        return self.plan.made(("newton", self.group.name), lambda plan: equations(plan, self.group))

    def raw(self, inputs: Mapping[str, Any], u: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the residuals and the Jacobian by rows as the constraints state them, shape (c, n) and (c, c, n)."""
        count, n = u.shape
        varied = any(np.ndim(inputs[name]) for name in self.plan.defaults)
        given = dict(inputs) | dict(zip(self.names, u, strict=True))
        if varied:  # poses as designs: each has dimensions of its own
            given |= {name: np.reshape(given[name], (-1, 1)) for name in given if name not in self.plan.defaults and np.ndim(given[name])}
        values = self._kernel(given, size=(n, 1) if varied else (1, n)).values
        values = values[:, :, 0] if varied else values[:, 0]
        return values[:count], values[count:].reshape(count, count, n)

    def extent(self, rows: FloatArray, u: FloatArray) -> FloatArray:
        """Return the size of the group at each pose [m]: its longest rod, or how far its pins lie apart."""
        rods = rows[: len(self.group.rods)]
        apart = np.ptp(u.reshape(-1, 2, u.shape[-1]), axis=0).max(axis=0)
        return np.asarray(np.sqrt(np.maximum((rods * rods).sum(axis=1).max(axis=0, initial=0.0), apart * apart)))

    def system(self, inputs: Mapping[str, Any], u: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return the residuals [m], the Jacobian with rows of length one, and the rows' own lengths [m]."""
        residual, rows = self.raw(inputs, u)
        size = np.sqrt((rows * rows).sum(axis=1))
        with np.errstate(all="ignore"):
            return residual / size, rows / size[:, None], size

    def correct(self, inputs: Mapping[str, Any], guess: FloatArray, iterations: int = 9) -> tuple[FloatArray, Mask]:
        """Return the solution next to a guess and the mask of the poses where it was found; each stands when its own steps have ended."""
        u, n = guess, guess.shape[1]
        settled, last = np.zeros(n, bool), np.full(n, np.inf)
        size, change = np.empty(0), np.full(n, np.inf)
        with np.errstate(all="ignore"):
            for _ in range(iterations):
                residual, rows = self.raw(inputs, u)
                size = size if size.size else self.extent(rows, u)
                step = solve_arrays(*rows.reshape(-1, n), *residual)
                change = np.where(settled, last, np.abs(step).max(axis=0))
                u = np.where(settled, u, u - step)
                # the steps' errors follow each other's squares, next to a singular pose by a large factor
                ahead = np.where(np.isinf(last), 1e4 * change, change * (change / last) ** 2)
                settled = settled | (change <= QUADRATIC * size) & (ahead <= QUADRATIC**2 * size) | np.isnan(change)
                last = change
                if settled.all():
                    break
            return u, np.asarray(change <= QUADRATIC * size)

    def start(self, inputs: Mapping[str, Any], sketch: FloatArray, iterations: int = 100) -> tuple[FloatArray, bool, float]:
        """Return the solution nearest a rough sketch by damped steps, whether it was found, and what is missing [m]."""
        u = sketch
        with np.errstate(all="ignore"):
            residual, rows, size = self.system(inputs, u)
            for _ in range(iterations):
                change = solve_arrays(*rows.reshape(-1, 1), *residual)
                if not np.isfinite(change).all():
                    break
                factor = min(1.0, 0.5 * float(size.max()) / max(float(np.abs(change).max()), 1e-300))
                before = float(np.abs(residual * size).max())
                while factor > 1e-6:
                    residual, rows, size = self.system(inputs, u - factor * change)
                    small = factor * float(np.abs(change).max()) < CONVERGED * float(size.max())
                    if small or float(np.abs(residual * size).max()) <= before:
                        break
                    factor *= 0.5
                u = u - factor * change
                if float(np.abs(change).max()) <= CONVERGED * float(size.max()):
                    return u, True, 0.0
        return u, False, float(np.abs(residual).max())

    def sense(self, inputs: Mapping[str, Any], u: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return how near each pose is to a singular one, and the group's size [m].

        The sign is that of the determinant, which changes where branches cross. The nearness is 2 over the condition of the Jacobian
        with rows of length one, at most 1; the condition is bounded by the Frobenius norms of the Jacobian and its inverse.
        """
        _, rows = self.raw(inputs, u)
        with np.errstate(all="ignore"):
            scaled = np.moveaxis(rows / np.sqrt((rows * rows).sum(axis=1))[:, None], (0, 1), (-2, -1))
            finite = np.isfinite(scaled).all(axis=(1, 2))
            safe = np.where(finite[:, None, None], scaled, np.eye(len(rows)))
            sign = np.linalg.slogdet(safe)[0]
            safe = np.where((sign != 0.0)[:, None, None], safe, np.eye(len(rows)))
            size = np.sqrt((np.linalg.inv(safe) ** 2).sum(axis=(1, 2)))
            nearness = np.minimum(1.0, 2.0 * np.sqrt(len(rows)) / size)
            return np.where(finite, sign * nearness, np.nan), self.extent(rows, u)

    def sine(self, inputs: Mapping[str, Any], u: FloatArray) -> FloatArray:
        """Return how near each pose is to a singular one, without a sign."""
        _, rows, _ = self.system(inputs, u)
        count, entries = len(rows), rows.reshape(-1, rows.shape[2])
        with np.errstate(all="ignore"):
            inverse = [solve_arrays(*entries, *(np.full(rows.shape[2], float(k == each)) for k in range(count))) for each in range(count)]
            size = np.sqrt(sum((column * column).sum(axis=0) for column in inverse))
            sine = np.minimum(1.0, 2.0 * np.sqrt(count) / size)
        return np.where(np.isfinite(u).all(axis=0), np.where(np.isnan(sine), 0.0, sine), np.nan)


def equations(plan: Plan, group: Group) -> Kernel:
    """Return the kernel of the residuals of a group and of their derivatives by its pins' coordinates, groups before it held."""
    pins = [plan.trace.at(pin) for pin in group.pins]
    roots = [part for place in pins for part in (place.x, place.y)]
    (closure,) = dict.fromkeys(root.closure for root in roots)
    assert closure is not None
    return Kernel([*closure.residuals, *(entry for row in jacobian(plan.trace.graph, closure) for entry in row)])
