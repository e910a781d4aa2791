"""What acts: which loads, in which load case, in which direction of motion, at which rates. One value wherever forces are asked for."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any, Self, final

from ..errors import DefinitionError, cited, known_name
from ..frozen import keep_own, refuses_changes
from ..quantities import name_of

FRICTIONLESS = "frictionless"
DIRECTIONS = (FRICTIONLESS, "extending", "retracting")
"""At rest, or without friction; while the stroke, or the cylinder that is asked for, grows; while it shrinks."""


@final
@refuses_changes
@dataclass(frozen=True)
class Acting:
    """The situation in which forces are asked for: `Acting(case="full", direction="extending", drive="S")`.

    `loads` are the machine's own where None, `case` a LoadCase or its name, `direction` one of DIRECTIONS, `rates` the speeds of strokes
    [1/s], `drive` the stroke that moves where several could. In a plain value None is no case and no friction; where something is judged,
    None of case or direction means all that occur.
    """

    loads: Any = None
    case: Any = None
    direction: str | None = None
    rates: Mapping[str, Any] | None = None
    drive: str | None = None

    def __post_init__(self) -> None:
        if self.direction is not None:
            known_name("Direction", self.direction, DIRECTIONS)
        if self.drive is not None:
            object.__setattr__(self, "drive", name_of(self.drive))
        if self.rates is not None and not isinstance(self.rates, Mapping):
            raise DefinitionError(f"Acting(rates={cited(self.rates)}): a speed for each stroke is expected, such as rates=dict(S=0.05).")
        keep_own(self)

    @property
    def movement(self) -> str:
        """The direction as a plain value takes it."""
        return self.direction or FRICTIONLESS

    def within(self, outer: Acting, what: str = "") -> Self:
        """Return this with what is not said here taken from `outer`; where `what` is said to be asked, DefinitionError for what differs."""
        said = {each.name: getattr(self, each.name) for each in fields(self)}
        for name, value in said.items():
            other = getattr(outer, name)
            if value is None:
                said[name] = other
            elif what and other is not None and other is not value and other != value:
                inside, outside = f"{name}={named_or_cited(value)}", f"{name}={named_or_cited(other)}"
                raise DefinitionError(f"{what}: {inside} stands in it, and acting= says {outside}; drop one of them.")
        if self.drive is None and said["direction"] == FRICTIONLESS:
            said["drive"] = None  # where there is no friction it is the same whichever stroke moves
        return type(self)(**said)


def named_or_cited(value: object) -> str:
    """Return what was given as text: a member by its name."""
    return str(getattr(value, "name", "") or cited(value))


PLAIN = Acting()
"""The machine's own loads, at rest."""
