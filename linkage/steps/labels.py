"""The labels of a step: `AB=0.5` names a link, its dimension and the design variable at once.

A label is the points' names joined, matched against the step's own points and never tokenised:
`AB` and `BA` are one length; `XYZ` is the angle counter-clockwise from YX to YZ, and `ZYX = -XYZ`.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cached_property
from typing import Protocol

from ..errors import ensure
from ..frozen import immutable, record
from ..quantities import Operand, Quantity, joined_names, quantity, source_text


@immutable
class Spoken:
    """How the labels of a member of a part are spoken: by the points' names in the part, with the part's name in front."""

    owner: str
    letters: Mapping[str, str]

    def word(self, *points: str) -> str:
        """Return the label of points by their names in the whole."""
        own = joined_names(*(self.letters.get(point, point) for point in points))
        return f"{self.owner}.{own}"


@record
class Slot:
    """A place of a step that a label fills: a length of two points or an angle of three."""

    attribute: str
    points: tuple[str, ...]
    spoken: Spoken | None = None

    @property
    def kind(self) -> str:
        """`length` or `angle`."""
        return "length" if len(self.points) == 2 else "angle"

    @cached_property
    def spellings(self) -> dict[str, int]:
        """The valid spellings with their sign: reversed, an angle changes it."""
        words = joined_names if self.spoken is None else self.spoken.word
        forward, back = words(*self.points), words(*reversed(self.points))
        return {forward: 1, back: 1 if self.kind == "length" else -1} if forward != back else {forward: 1}


class DimensionTable(Protocol):
    """The table of a mechanism's dimensions: it gives each label its one quantity."""

    def dimension(self, slot: Slot, spelling: str, value: Operand, where: str) -> Quantity:
        """Return the quantity a label stands for; a number makes a design variable of that name."""


def written_labels(labels: Mapping[str, Operand], slots: Iterable[Slot]) -> list[str]:
    """Return labels as they are written, `OB=0.3`: the numbers of those that are angles in degrees."""
    angles = {spelling for slot in slots if slot.kind == "angle" for spelling in slot.spellings}
    return [f"{label}={source_text(quantity(value), 0, 'angle' if label in angles else '')}" for label, value in labels.items()]


def relabelled(labels: Mapping[str, Operand], values: Mapping[str, float]) -> dict[str, Operand]:
    """Return labels whose numbers have other values; a label that follows something keeps it."""
    return {label: values[label] if label in values and quantity(value).is_constant else value for label, value in labels.items()}


def match(labels: Mapping[str, Operand], slots: Iterable[Slot], what: str) -> dict[str, tuple[Slot, str, int, Operand]]:
    """Return, for each slot filled, its slot, spelling, sign and value.

    Raises DefinitionError for a label that fits no slot or a slot filled twice.
    """
    places = list(slots)
    found: dict[str, tuple[Slot, str, int, Operand]] = {}
    for spelling, value in labels.items():
        fitting, fault = [slot for slot in places if spelling in slot.spellings], ""
        if not fitting:
            valid = ", ".join("/".join(slot.spellings) for slot in places)
            fault = f"the label {spelling!r} does not fit its points; valid labels: {valid}"
        elif len(fitting) > 1:
            fault = f"the label {spelling!r} can be read two ways; rename a point"
        elif fitting[0].attribute in found:
            fault = f"{found[fitting[0].attribute][1]} and {spelling} are the same dimension; give it once"
        ensure(not fault, f"{what}: {fault}.")
        slot = fitting[0]
        found[slot.attribute] = (slot, spelling, slot.spellings[spelling], value)
    return found
