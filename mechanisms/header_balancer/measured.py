"""Measured reactions beside the calculated ones: read from CSV, deviation in percent. The paper's own check is 7 %."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path

import numpy as np

from linkage import DefinitionError, FileError, Motion, Verdict
from linkage.disk import check_name
from linkage.errors import cited
from linkage.files.source import measured_columns
from linkage.frozen import immutable
from linkage.language import said, said_of
from linkage.program import FloatArray
from linkage.units import show

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
    check_name(path)
    path, kinds = Path(path), {**CURVES, **PLACES}
    try:
        found = measured_columns(path, str(path), lambda name: [kinds[name]] if name in kinds else (), gaps=True)
    except DefinitionError as error:
        raise FileError(str(error)) from None
    if not set(found) & set(PLACES) or not set(found) & set(CURVES):
        raise FileError(f"{path}, line 1: a column R_y or h and one of {', '.join(CURVES)} are needed; found: {', '.join(found)}.")
    return {name: np.array(values, float) for name, values in found.items()}


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
