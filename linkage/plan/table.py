"""The dimensions of a mechanism: one owner each, all spellings, and the check of their settings."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from math import isclose
from typing import NamedTuple, TypeAlias, cast

import numpy as np
import numpy.typing as npt

from ..errors import DefinitionError, is_listed, require, unknown
from ..frozen import read_only
from ..loads.element import NEGATIVE, ROUGHEST, TOO_ROUGH
from ..quantities import Number, Operand, Quantity, Variable, quantity, real, source_text
from ..steps import Slot
from ..steps.step import TURN
from ..units import UNITS, deg, require_measure
from ..vectors import Numbers

Label: TypeAlias = frozenset[str] | tuple[str, frozenset[str]]
"""What a label measures: the two ends of a length, or the corner of an angle and its two sides' ends."""


class DesignVariable(NamedTuple):
    """One design variable: its default [SI], kind of measure, owner, and display unit, if it has one."""

    name: str
    default: float
    kind: str
    where: str
    unit: str = ""

    @property
    def measures(self) -> str:
        """Its kind by its unit or its label: "length", "angle", "pressure"; "" where neither tells it."""
        kinds = {"length": "length", "coordinate": "length", "angle": "angle", **dict.fromkeys(SHARES, "number")}
        return UNITS[self.unit][1] if self.unit else kinds.get(self.kind, "")


class Table:
    """Which design variables there are, which labels follow others, and the spellings of both."""

    def __init__(self, title: str) -> None:
        self.title = title
        self.entries: dict[str, DesignVariable] = {}
        self.defaults: dict[str, float] = {}
        self.spellings: dict[str, tuple[str, int]] = {}
        self.following: dict[str, str] = {}
        self.lengths: dict[frozenset[str], Quantity] = {}
        self.angles: dict[tuple[str, frozenset[str]], Quantity] = {}
        self._labels: dict[Label, tuple[str, Quantity]] = {}

    def add_variable(self, name: str, default: float, kind: str, where: str, unit: str = "") -> None:
        """Enter a design variable; raise DefinitionError where its name is taken, its value cannot be, or its unit is unknown."""
        self.check_free(name, where)
        if unit and (not isinstance(unit, str) or unit not in UNITS):
            error = unknown("Unit", unit, UNITS, where=f"{self.title}: {where}, {name}")
            raise DefinitionError(f'{error} Write "" where none of them fits; the number is then shown in SI as it is.')
        entry = DesignVariable(name, default, kind, where, unit)
        if entry.measures:
            require_measure(default, entry.measures, f"{self.title}: {where}: {name}")
        value_in_range(entry, default)
        self.entries[name], self.defaults[name] = entry, float(default)
        self.spellings[name] = (name, 1)

    def check_free(self, name: str, where: str) -> None:
        """Raise DefinitionError where a name already stands for a design variable, forwards or backwards."""
        if name in self.spellings:
            owner = self.entries[self.spellings[name][0]]
            raise DefinitionError(f"{where}: the name {name} already belongs to {owner.name} of {owner.where}; rename one of them.")

    def dimension(self, slot: Slot, spelling: str, value: Operand, where: str) -> Quantity:
        """Return the quantity a label stands for; a number makes a design variable of that name."""
        given = quantity(value)
        key: Label = frozenset(slot.points) if slot.kind == "length" else (slot.points[1], frozenset((slot.points[0], slot.points[2])))
        if key in self._labels:
            first, owner = self._labels[key]
            sign = 1 if slot.spellings[first] == slot.spellings[spelling] else -1
            if isinstance(given, Number) and isinstance(owner, Number) and isclose(given.number, sign * owner.number, rel_tol=1e-9):
                return Variable(first) if sign > 0 else -Variable(first)
            if not isinstance(owner, Number) and sign > 0 and (given is owner or source_text(given) == source_text(owner)):
                return owner
            two = f"{spelling}={source_text(given)} contradicts {first}={source_text(owner)}"
            raise DefinitionError(f"{where}: {two}; a dimension has one value.")
        stands: Quantity = Variable(spelling) if isinstance(given, Number) else given
        if isinstance(given, Number):
            for each in slot.spellings:
                self.check_free(each, where)
            self.add_variable(spelling, given.number, slot.kind, where)
            self.spellings |= {each: (spelling, slot.spellings[each] * slot.spellings[spelling]) for each in slot.spellings}
        else:
            self.following |= dict.fromkeys(slot.spellings, source_text(given))
        self._labels[key] = (spelling, given)
        if isinstance(key, frozenset):
            self.lengths[key] = stands
        else:
            self.angles[key] = stands
        return stands

    def settings(self, given: Mapping[str, npt.ArrayLike]) -> dict[str, Numbers]:
        """Return the design variables with some of them set: floats, or arrays for a batch of designs.

        Raises DefinitionError for an unknown name, one that follows others, or a value that cannot be.
        """
        values: dict[str, Numbers] = dict(self.defaults)
        by: dict[str, str] = {}
        for name, value in given.items():
            for each, part in self._pairs(name, value):
                owner, sign = self.spellings[each]
                if by.setdefault(owner, name) != name:
                    raise DefinitionError(f"{self.title}: {by[owner]} and {name} both set {owner}; leave one of them out.")
                values[owner] = value_in_range(self.entries[owner], signed(part, sign, self.entries[owner]))
        return values

    def _pairs(self, name: str, value: npt.ArrayLike) -> list[tuple[str, npt.ArrayLike]]:
        """Return a setting as variables: a point's position is two of them."""
        if name in self.spellings:
            return [(name, value)]
        if f"{name}.x" in self.spellings or f"{name}.y" in self.spellings:
            pair = list(cast(Iterable[npt.ArrayLike], value)) if is_listed(value) or np.ndim(value) else []
            require(len(pair) == 2, f"{self.title}({name}", value, f"a point takes two coordinates, {name}=(x, y) in m")
            return [part for axis, each in zip("xy", pair, strict=True) for part in self._pairs(f"{name}.{axis}", each)]
        if name in self.following:
            raise DefinitionError(f"{self.title}({name}=...): {name} follows {self.following[name]}; set what it follows.")
        raise unknown("Dimension", name, self.names(), where=self.title)

    def names(self) -> list[str]:
        """Return the names that can be set; a fixed point by its own name."""
        return list(dict.fromkeys(name.removesuffix(".x").removesuffix(".y") for name in self.entries))


FARTHEST = 1e11
"""m; no mechanism is larger, and the squares of such lengths no longer add."""

LARGEST = float(np.finfo(float).max)
RANGES: Mapping[str, tuple[float, float]] = {
    "length": (float(np.nextafter(0.0, 1.0)), FARTHEST),
    "coordinate": (-FARTHEST, FARTHEST),
    "angle": (-TURN, TURN),
    "not negative": (0.0, LARGEST),
    "friction": (0.0, ROUGHEST),
    "efficiency": (float(np.nextafter(0.0, 1.0)), 1.0),
    "ratio": (0.0, LARGEST),
}
"""The least and the greatest value that is in order [SI], by what a variable measures."""
SHARES = ("friction", "efficiency", "ratio")


def efficiency_words(value: float) -> str:
    """Return the words for an efficiency that cannot be; of one in % what it is."""
    return "an efficiency lies between 0 and 1" + (f"; write {value / 100.0:.6g} for {value:.6g} %" if 2.0 <= value <= 100.0 else "")


def signed(value: float | npt.ArrayLike, sign: int, entry: DesignVariable) -> Numbers:
    """Return a setting with its owner's sign; raise DefinitionError for anything but a number."""
    if isinstance(value, float):
        return sign * float(value)
    try:
        array = real(value)
    except ValueError:
        raise DefinitionError(f"{entry.name}={value!r} is not a number; give it in SI, such as {entry.name}={entry.default!r}.") from None
    return float(sign * array) if array.ndim == 0 else read_only(sign * array)


def value_in_range(entry: DesignVariable, value: Numbers) -> Numbers:
    """Return a value within the variable's range; raise DefinitionError for NaN, infinity and values out of range."""
    low, high = RANGES.get(entry.kind, (-LARGEST, LARGEST))
    if low <= value <= high if type(value) is float else np.all((np.asarray(value) >= low) & (np.asarray(value) <= high)):
        return value
    values = np.ravel(value)
    require(np.all(np.isfinite(values)), f"{entry.where}: {entry.name}", value, "is not a finite number; give a value in SI")
    least, far = float(values.min()), float(values[np.argmax(np.abs(values))])
    if entry.kind == "efficiency":
        fault = f"{entry.name}={far:.6g}: {efficiency_words(far)}"
    elif entry.kind == "friction" and least >= 0.0:
        fault = f"{entry.name}={far:.6g} {TOO_ROUGH}"
    elif entry.kind in ("not negative", "friction", "ratio"):
        fault = f"{entry.name}={least:.6g} {NEGATIVE}"
    elif entry.kind == "angle":
        said = f"the angle {entry.name}={far:.6g} rad ({far / deg:.6g} deg) is more than a full turn"
        fault = f"{said}; write {far:.6g} * deg if these are degrees, or take whole turns off"
    elif abs(far) > FARTHEST:
        fault = f"{entry.name}={far:.6g} m is farther than the sun; give it in m"
    else:
        what = "has no length, its points stand at one place; use one pin for both, or" if least >= 0.0 else "is negative;"
        fault = f"the length {entry.name}={least:.6g} m {what} give a positive one"
    raise DefinitionError(f"{entry.where}: {fault}.")
