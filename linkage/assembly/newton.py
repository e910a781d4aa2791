"""The pins of groups, found by Newton's method with the exact Jacobian of the program, many poses at once."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from ..plan import Plan
from ..program import FloatArray, Kernel, Tangent, solve_arrays

Mask = npt.NDArray[np.bool_]
CONVERGED = 1e-10
#: A step so small, against the links' length, leaves an error of its square: 1e-14 and less.
QUADRATIC = 1e-7


class Newton:
    """The equations of all groups of a plan as one system in their pins' coordinates.

    Inputs are a float or (designs,) for a dimension, a float, (poses,) or (designs, poses) for a stroke;
    unknowns have the shape (coordinates, designs, poses) [m].
    """

    def __init__(self, plan: Plan) -> None:
        self.plan = plan
        self.names = [name for group in plan.groups.values() for name in group.inputs[:-1]]

    @property
    def _kernel(self) -> Kernel:
        return self.plan.made("newton", equations)

    def raw(self, inputs: Mapping[str, Any], u: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the residuals and the Jacobian by rows as the constraints state them, shape (n, ...) and (n, n, ...)."""
        n = len(self.names)
        values = self._kernel(dict(inputs) | dict(zip(self.names, u, strict=True))).values
        shape = np.broadcast_shapes(values.shape[1:], u.shape[1:])
        values = np.broadcast_to(values, (len(values), *shape))
        return values[:n], values[n:].reshape(n, n, *shape)

    def system(self, inputs: Mapping[str, Any], u: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return the residuals [m], the Jacobian with rows of length one, and the rows' own lengths [m]."""
        residual, rows = self.raw(inputs, u)
        size = np.sqrt((rows * rows).sum(axis=1))
        with np.errstate(all="ignore"):
            return residual / size, rows / size[:, None], size

    def correct(self, inputs: Mapping[str, Any], guess: FloatArray, iterations: int = 8) -> tuple[FloatArray, Mask]:
        """Return the solution next to a guess and the mask of the poses where it was found."""
        u, done, size = guess, np.zeros(guess.shape[1:], bool), None
        with np.errstate(all="ignore"):
            for _ in range(iterations):
                residual, rows = self.raw(inputs, u)
                size = np.sqrt((rows * rows).sum(axis=1).max(axis=0)) if size is None else size
                change = solve_arrays(*rows.reshape(-1, *rows.shape[2:]), *residual)
                u = u - change
                done = np.abs(change).max(axis=0) <= QUADRATIC * size
                if done.all() or np.isnan(change).all():
                    break
        return u, done

    def start(self, inputs: Mapping[str, Any], sketch: FloatArray, iterations: int = 100) -> tuple[FloatArray, bool, float]:
        """Return the solution nearest a rough sketch by damped steps, whether it was found, and what is missing [m]."""
        u = sketch
        with np.errstate(all="ignore"):
            residual, rows, size = self.system(inputs, u)
            for _ in range(iterations):
                change = solve_arrays(*rows.reshape(-1, 1, 1), *residual)
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

    def sense(self, inputs: Mapping[str, Any], u: FloatArray) -> FloatArray:
        """Return the determinant of the scaled Jacobian: its sign changes where branches cross."""
        _, rows, _ = self.system(inputs, u)
        finite = np.isfinite(rows).all(axis=(0, 1))
        safe = np.where(finite, rows, np.eye(len(rows))[:, :, None, None])
        return np.where(finite, np.linalg.det(np.moveaxis(safe, (0, 1), (-2, -1))), np.nan)

    def sine(self, inputs: Mapping[str, Any], u: FloatArray) -> FloatArray:
        """Return how near each pose is to a singular one: 2 over the condition of the scaled Jacobian, at most 1.

        The condition is bounded by the Frobenius norms of the Jacobian and its inverse.
        """
        _, rows, _ = self.system(inputs, u)
        n, entries = len(rows), rows.reshape(-1, *rows.shape[2:])
        with np.errstate(all="ignore"):
            inverse = [solve_arrays(*entries, *(np.full(rows.shape[2:], float(k == each)) for k in range(n))) for each in range(n)]
            size = np.sqrt(sum((column * column).sum(axis=0) for column in inverse))
            sine = np.minimum(1.0, 2.0 * np.sqrt(n) / size)
        return np.where(np.isfinite(u).all(axis=0), np.where(np.isnan(sine), 0.0, sine), np.nan)


def equations(plan: Plan) -> Kernel:
    """Return the kernel of the residuals of all groups and of their derivatives by the pins' coordinates."""
    pins = [plan.trace.at(pin) for group in plan.groups.values() for pin in group.pins]
    roots = [part for place in pins for part in (place.x, place.y)]
    closures = dict.fromkeys(root.closure for root in roots)
    residuals = [residual for closure in closures if closure for residual in closure.residuals]
    columns = [Tangent(plan.trace.graph, {each: float(each is root) for each in roots}) for root in roots]
    return Kernel([*residuals, *(column.of(residual) for residual in residuals for column in columns)])
