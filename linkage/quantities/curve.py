"""Tabulated functions: a smooth curve through the rows of a table, with exact derivatives in every reading."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from math import pi
from typing import Any

import numpy as np
import numpy.typing as npt

from ..errors import DefinitionError, ensure, require
from ..frozen import immutable, read_only, refuses_changes
from ..units import amounts_in, require_number
from ..vectors import FloatArray, Scalar, pick
from .member import Pick, Reference, Where
from .quantity import Quantity, quantity, real, source_text

ROUNDING = 1e-12
"""So far beyond its ends, as a share of its length, a table still has a value."""


def wrap(angle: Scalar) -> Scalar:
    """Return an angle [rad] within half a turn."""
    return np.arctan2(np.sin(angle), np.cos(angle))


@refuses_changes
class Curve:
    """The cubic spline through the rows of a table: `lift = Curve([0.0, 0.1, 0.2], [0.0, 0.02, 0.05])`.

    It passes through all rows, and its slope and curvature are continuous. The first two pieces are one polynomial, and the last two ("not
    a knot"), unless it is periodic. `lift(S)` of a quantity is a quantity of the class; of numbers it is the value, as the law of a force
    element asks for it.

    Parameters
    ----------
    xs, ys : array (rows,)
        The table [SI], ascending by `xs`.
    period : float, optional
        Makes it periodic: the last row lies one period after the first and has the same value.
    name : str, optional
        What equations call it, "curve" by default.

    Raises
    ------
    DefinitionError
        There are too few rows, they do not ascend, or a value is not finite.

    Notes
    -----
    Source: de Boor, "A Practical Guide to Splines", chapter IV.
    """

    xs: FloatArray
    ys: FloatArray
    period: float | None
    name: str
    measures: str
    """What its values measure, where amounts were given: "length" or "angle"; else ""."""

    def __init__(self, xs: npt.ArrayLike, ys: npt.ArrayLike, *, period: float | None = None, name: str = "curve") -> None:
        self.__dict__.update(xs=column("xs", xs, "Curve"), ys=column("ys", ys, "Curve"), period=period, name=name)
        self.__dict__["measures"] = next((each.measures for each in amounts_in(ys)), "")
        fault = ""
        if len(self.xs) != len(self.ys) or len(self.xs) < 2:
            fault = f"{len(self.xs)} values of x and {len(self.ys)} of y; a table has two rows or more"
        elif np.any(np.diff(self.xs) <= 0.0):
            row = int(np.argmax(np.diff(self.xs) <= 0.0)) + 1
            fault = f"x must grow from row to row; {self.xs[row]:.6g} follows {self.xs[row - 1]:.6g}"
        elif self.period is not None:
            period = require_number("Curve: period", self.period, "a positive number is expected, such as 2 * pi", above=0.0, kind=None)
            if abs(self.xs[-1] - self.xs[0] - period) > 1e-9 * period or abs(self.ys[-1] - self.ys[0]) > 1e-9 * np.ptp(self.ys):
                ends = f"from ({self.xs[0]:.6g}, {self.ys[0]:.6g}) to ({self.xs[-1]:.6g}, {self.ys[-1]:.6g})"
                fault = f"the last row must lie one period after the first, with the same value; the table goes {ends}"
        ensure(not fault, f"Curve: {fault}.")

    def __call__(self, x: Any, order: int = 0) -> Any:
        """Return the curve of a quantity as a quantity, of numbers as numbers; or its derivative of that order.

        DefinitionError for numbers outside the table.
        """
        if isinstance(x, (Quantity, str)):
            return CurveValue(self, quantity(x), order)
        if self.ends is not None and np.any((x < self.ends[0]) | (x > self.ends[1])):
            raise DefinitionError(f"{self.title} is asked for a value outside its table; give it more rows.")
        return self.value(x, order)

    @property
    def ends(self) -> tuple[float, float] | None:
        """The least and greatest x that it has a value for; None where it is periodic."""
        low, high = float(self.xs[0]), float(self.xs[-1])
        return None if self.period is not None else (low - ROUNDING * (high - low), high + ROUNDING * (high - low))

    @property
    def breaks(self) -> FloatArray:
        """The values of x of its rows, where one polynomial follows another; instants [s] where it is a course."""
        return self.xs

    @property
    def duration(self) -> float:
        """From its first row to its last one [s], where it is a course."""
        return float(self.xs[-1] - self.xs[0])

    @property
    def title(self) -> str:
        """Its name in a message, with its range."""
        return f"{self.name}, a table from {self.xs[0]:.6g} to {self.xs[-1]:.6g},"

    # -- the spline ------------------------------------------------------------------------------------------

    def value(self, x: Scalar, order: int = 0, pick: Pick = pick, wrap: Callable[[Scalar], Scalar] = wrap) -> Scalar:
        """Return the value at x, or a derivative of that order; NaN outside the table.

        Plain arithmetic, `pick(a, b, x, y)`, which is x where a <= b, else y, and `wrap(angle)`, the angle [rad] within half a turn: so it
        can be read on anything that calculates.

        Parameters
        ----------
        x : float or scalar
            The place in the table.
        order : int
            The order of the derivative.
        pick : callable
            `pick(a, b, x, y)` is x where a <= b, else y.
        wrap : callable
            The angle [rad] within half a turn.

        Returns
        -------
        float or scalar
            The value.
        """
        if self.period is not None:
            turn, middle = 2.0 * pi / self.period, 0.5 * float(self.xs[0] + self.xs[-1])
            x = wrap((x - middle) * turn) * (1.0 / turn) + middle
        start, *powers = (self._chosen(x, row, pick) for row in (self.xs[:-1], *derived(self.pieces, order)))
        away, total = x - start, powers[-1]
        for factor in powers[-2::-1]:
            total = total * away + factor
        if self.ends is None:
            return total
        low, high = self.ends
        return pick(low, x, pick(x, high, total, np.nan), np.nan)

    def _chosen(self, x: Scalar, row: FloatArray, pick: Pick) -> Scalar:
        """Return the entry of a row of coefficients that belongs to x, by halving."""

        def between(first: int, last: int) -> Scalar:
            if last - first == 1:
                return float(row[first])
            middle = (first + last) // 2
            return pick(x, float(self.xs[middle]), between(first, middle), between(middle, last))

        return between(0, len(row))

    @cached_property
    def pieces(self) -> FloatArray:
        """The polynomials between the rows, by powers of the distance from the row: shape (4, rows - 1)."""
        from scipy.interpolate import CubicSpline  # here: it takes longer to load than this package

        if self.period is None:
            return np.array(CubicSpline(self.xs, self.ys).c[::-1])
        return np.array(CubicSpline(self.xs, [*self.ys[:-1], self.ys[0]], bc_type="periodic").c[::-1])

    def __str__(self) -> str:
        period = "" if self.period is None else f", period={self.period!r}"
        name = "" if self.name == "curve" else f", name={self.name!r}"
        return f"Curve({self.xs.tolist()}, {self.ys.tolist()}{period}{name})"

    __repr__ = __str__


def derived(rows: FloatArray, order: int) -> FloatArray:
    """Return polynomials by powers, shape (k, n), as derivatives of an order."""
    for _ in range(order):
        rows = rows[1:] * np.arange(1, len(rows))[:, None] if len(rows) > 1 else np.zeros_like(rows)
    return rows


def column(what: str, given: npt.ArrayLike, owner: str) -> FloatArray:
    """Return one column of a table, read-only; DefinitionError for anything but finite numbers."""
    try:
        found = read_only(real(given))
    except (ValueError, TypeError):
        found = np.zeros(())
    require(found.ndim == 1 and np.isfinite(found).all(), f"{owner}: {what}", given, "a list of finite numbers is expected")
    return found


@immutable
class CurveValue(Quantity):
    """The value, or a derivative, of a curve at a quantity."""

    curve: Curve
    x: Quantity
    order: int = 0

    def parts(self) -> tuple[Reference, ...]:
        return (self.x,)

    def in_radians(self) -> tuple[Quantity, ...]:
        return (self.x,) if self.curve.period is not None and abs(self.curve.period - 2.0 * pi) < 1e-9 else ()

    def rule(self, where: Where) -> Scalar:
        return where.curve(self.curve, where.value(self.x), self.order)

    def __str__(self) -> str:
        return f"{self.curve}({source_text(self.x)}{f', {self.order}' if self.order else ''})"
