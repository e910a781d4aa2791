"""Measured reactions beside the calculated ones: read from CSV, deviation in percent. The paper's own check is 7 %."""

from __future__ import annotations

import csv
from collections.abc import Iterator, Mapping, Sequence
from math import isfinite
from pathlib import Path

import numpy as np

from linkage import DefinitionError, FileError, Motion
from linkage.disk import read
from linkage.errors import cited
from linkage.frozen import immutable
from linkage.language import said, said_of
from linkage.program import FloatArray
from linkage.units import UNITS, show, units_of
from linkage.verdict import Verdict

from .following import HeaderState, stroke_of

ALLOWED = 7.0
"""Largest deviation of the paper's own measurement [%]."""

SMALL = 0.1
"""A calculated value below this part of its curve's largest is compared with that part: near hang-up percent says nothing."""

CURVES = {"F_R up": "force", "F_R down": "force", "P": "pressure"}
PLACES = {"R_y": "length", "h": "length"}


@immutable
class Deviation:
    """One measured curve against the calculation; `percent` is the deviation of each point.

    Attributes
    ----------
    curve : str
        The name of the curve.
    height : array (n,)
        The heights of the shoe [m].
    measured, calculated : array (n,)
        The values [SI].
    """

    curve: str
    height: FloatArray
    measured: FloatArray
    calculated: FloatArray

    @property
    def percent(self) -> FloatArray:
        """Measured less calculated, in percent of the calculated; of a tenth of the curve's largest where it is below that."""
        size = np.abs(self.calculated)
        return np.asarray(100.0 * (self.measured - self.calculated) / np.maximum(size, SMALL * size.max()))

    @property
    def verdict(self) -> Verdict:
        """Whether the deviation keeps the paper's 7 %."""
        worst = int(np.argmax(np.abs(self.percent)))
        largest = float(self.percent[worst])
        ok = abs(largest) <= ALLOWED
        says = said_of(
            len(self.percent),
            "{curve} deviates by up to {largest:+.1f} %, at R_y = {height}, of {n} points",
            "{curve} deviates by up to {largest:+.1f} %, at R_y = {height}, of {n} points",
            curve=self.curve, largest=largest, height=show(float(self.height[worst]), "mm", "+.0f"),
        )  # fmt: skip
        rule, named = f"measured {self.curve}", said("measured {curve}", curve=self.curve)
        if ok:
            return Verdict(rule, True, said("{says}; within the paper's {allowed:g} %.", says=says, allowed=ALLOWED), named)
        return Verdict(rule, False, said("{says}; above the paper's {allowed:g} %.", says=says, allowed=ALLOWED), named)


def read_measured(path: str | Path) -> Mapping[str, FloatArray]:
    """Return the columns of a CSV file [SI] by name: R_y or h, and F_R up, F_R down, P as far as they are there.

    A heading is a name and its unit: `"R_y, mm"` or `R_y [mm]`. Fields are parted by commas, or by semicolons (then a comma may be the
    decimal sign). An empty field is a value not measured.

    Parameters
    ----------
    path : str or Path
        The file.

    Returns
    -------
    mapping of str to array
        The columns.

    Raises
    ------
    FileError
        The file cannot be read; the line is named.
    """
    try:
        lines = read(path).decode("utf-8-sig").splitlines()
    except UnicodeDecodeError:
        raise FileError(f"{path}: the file is not UTF-8 text; save it in that encoding.") from None
    delimiter = ";" if lines and ";" in lines[0] else ","
    rows = [row for row in csv.reader(lines, delimiter=delimiter, skipinitialspace=True) if row]
    if len(rows) < 2:
        raise FileError(f"{path}: a line of headings and at least one of numbers are expected.")
    known = {index: column for index, heading in enumerate(rows[0]) if (column := _heading(heading, path)) is not None}
    names = [name for name, _ in known.values()]
    if not set(names) & set(PLACES) or not set(names) & set(CURVES):
        raise FileError(f"{path}, line 1: a column R_y or h and one of {', '.join(CURVES)} are needed; found: {', '.join(rows[0])}.")
    table: dict[str, list[float]] = {name: [] for name in names}
    for number, row in enumerate(rows[1:], 2):
        for index, (name, factor) in known.items():
            table[name].append(factor * _number(row, index, f"{path}, line {number}", delimiter))
    return {name: np.array(values) for name, values in table.items()}


def _heading(text: str, path: str | Path) -> tuple[str, float] | None:
    """Return a heading's name and the factor to SI of its unit; None for a column that means nothing here."""
    name, _, unit = text.replace("[", ",").replace("]", "").partition(",")
    name, unit = name.strip(), unit.strip()
    kind = {**CURVES, **PLACES}.get(name)
    if kind is None:
        return None
    if unit not in UNITS or UNITS[unit][1] != kind:
        fit = ", ".join(units_of(kind))
        raise FileError(f"{path}, line 1: {text!r}: the unit of {name} is one of {fit}.")
    return name, UNITS[unit][0]


def _number(row: Sequence[str], index: int, where: str, delimiter: str) -> float:
    text = row[index].strip() if index < len(row) else ""
    try:
        value = float(text.replace(",", ".") if delimiter == ";" else text) if text else np.nan
    except ValueError:
        raise FileError(f"{where}: {text!r} is not a number.") from None
    if text and not isfinite(value):
        raise FileError(f"{where}: {text!r} is not a finite number.")
    return value


def deviations(motion: Motion, measured: Mapping[str, FloatArray]) -> list[Deviation]:
    """Return every measured curve against the calculated one of a design, at the measured places.

    Parameters
    ----------
    motion : Motion
        The poses.
    measured : mapping of str to array
        The columns, as `read_measured` gives them.

    Returns
    -------
    list of Deviation
        One for each measured curve.
    """
    if not isinstance(measured, Mapping) or not set(measured) & set(PLACES):
        raise DefinitionError(f"{cited(measured)} holds no measured curves with their places, R_y or h; take read_measured(path).")
    return list(_each(motion, measured))


def _each(motion: Motion, measured: Mapping[str, FloatArray]) -> Iterator[Deviation]:
    place = measured["h"] if "h" in measured else measured["R_y"]
    for curve in CURVES:
        values = measured.get(curve)
        good = np.isfinite(values) & np.isfinite(place) if values is not None else np.zeros(0, bool)
        if values is None or not good.any():
            continue
        h = place[good] if "h" in measured else np.array([stroke_of(motion, float(height)) for height in place[good]])
        balance = HeaderState(motion.moved({"h": h}))
        calculated = {"F_R up": balance.up, "F_R down": balance.down, "P": balance.pressure}[curve]
        yield Deviation(curve, balance.height, values[good], calculated)
