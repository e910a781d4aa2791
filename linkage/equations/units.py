"""What an expression measures: lengths, angles, and products of them."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from ..motion import stroke_unit
from ..plan import Plan
from ..quantities import Quantity, unnamed
from ..steps import CosineAngle, Turn
from ..units import UNITS, deg


@dataclass(frozen=True)
class Unit:
    """Powers of metre and radian; not `known` where a formula mixes what it cannot follow."""

    length: Fraction = Fraction(0)
    angle: Fraction = Fraction(0)
    known: bool = True
    named: str = ""

    def __mul__(self, other: Unit) -> Unit:
        return Unit(self.length + other.length, self.angle + other.angle, self.plain and other.plain)

    def __pow__(self, power: Fraction | int) -> Unit:
        return Unit(self.length * power, self.angle * power, self.plain)

    @property
    def plain(self) -> bool:
        """Whether it is made of metres and radians."""
        return self.known and not self.named

    @property
    def factor(self) -> float:
        """The unit it is shown in, in SI: degrees for an angle."""
        if self == ANGLE:
            return deg
        return UNITS[self.named][0] if self.named else 1.0

    @property
    def text(self) -> str:
        """The unit it is shown in: `m`, `deg`, `rad/m`, or nothing."""
        if self.named or not self.known:
            return self.named
        if self == ANGLE:
            return "deg"
        powers = [("rad", self.angle), ("m", self.length)]
        over = "*".join(_power(name, power) for name, power in powers if power > 0)
        under = "*".join(_power(name, -power) for name, power in powers if power < 0)
        return f"{over or '1'}/{under}" if under else over


def _power(name: str, power: Fraction) -> str:
    return name + (str(power) if power != 1 else "")


NUMBER = Unit()
LENGTH = Unit(Fraction(1))
ANGLE = Unit(angle=Fraction(1))
UNKNOWN = Unit(known=False)

KINDS = {"length": LENGTH, "coordinate": LENGTH, "angle": ANGLE}


def input_units(plan: Plan) -> dict[str, Unit]:
    """Return what each stroke and design variable measures; a `Dimension` by the place where it is used."""
    lengths = set().union(*map(plan.terms, used_as_lengths(plan)))
    units = {name: ANGLE if stroke_unit(plan, name) == "rad" else LENGTH for name in plan.strokes}
    for name, entry in plan.table.entries.items():
        used = ANGLE if name in plan.turning else LENGTH if name in lengths else NUMBER
        units[name] = Unit(known=True, named=entry.unit) if entry.unit and UNITS[entry.unit][0] != 1.0 else KINDS.get(entry.kind, used)
    return units


def used_as_lengths(plan: Plan) -> list[Quantity]:
    """Return the quantities that stand where a length is expected."""
    found = list(plan.table.lengths.values())
    for member in plan.members.values():
        for part in (member, *unnamed(member)):
            found += part.triangle if isinstance(part, CosineAngle) else ()
            found += [part.scaled_to] if isinstance(part, Turn) and part.scaled_to is not None else ()
    return found
