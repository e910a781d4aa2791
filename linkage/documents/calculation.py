"""The equations with their numbers, as a calculation sheet has them, and their omissions."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from ..errors import LinkageError
from ..formulas import equations
from ..formulas.numbered import Equations, SheetLine
from ..frozen import record
from ..language import said
from ..loads import Case, ForceElement
from ..mechanism import Mechanism
from .content import Block, Equality

DIGITS = 30
"""The digits that the equations are worked out with, so that what they print is theirs and nothing of it is rounding."""


@record
class FilledEquations:
    """The equations of a design at a pose, their values there by name [SI], and why those of its forces are missing, if they are."""

    listing: Equations
    pose: Mapping[str, float]
    values: Mapping[str, Any]
    why_no_forces: str = ""

    @property
    def lines(self) -> Sequence[SheetLine]:
        """The equations with their numbers."""
        return self.listing.sheet(self.pose, {name: without_rounding(value) for name, value in self.values.items()})


def without_rounding(value: Any) -> object:
    """Return a value, one number or two, as floats; zero for the rounding of its last digits, of two beside the larger one."""
    if isinstance(value, tuple):
        least = 1e-15 * max(abs(float(part)) for part in value)  # a given angle is rounded too
        return tuple(without_rounding(part) if abs(part) > least else 0.0 for part in value)
    return 0.0 if abs(value) < 10.0**-DIGITS else float(value)


def calculated(machine: Mechanism, pose: Mapping[str, float], start: int, case: Case = None) -> FilledEquations:
    """Return the equations of a design in a load case; without those of its forces where these have none."""
    try:
        found = equations(machine, start=start, forces=has_loads(machine), case=case if has_loads(machine) else None)
        values = found.values(pose, DIGITS)
        lost = [name for name, value in values.items() if np.isnan(np.asarray(value, float)).any()]  # over a force that is zero
        return FilledEquations(found, pose, {**values, **{name: found.values(pose)[name] for name in lost}})
    except LinkageError as error:
        if not has_loads(machine):
            raise
        plain = equations(machine, start=start)
        return FilledEquations(plain, pose, plain.values(pose, DIGITS), str(error))


def has_loads(machine: Mechanism) -> bool:
    """Return whether anything acts on a machine."""
    return bool(machine.plan.of_kind(ForceElement))


def calculation_blocks(found: FilledEquations, pose_words: str, is_timed: bool) -> Iterator[Block]:
    """Yield the numbered equations with their numbers, and remarks on them; `is_timed` are those of a path in time."""
    listing = found.listing
    yield said(
        "The equations of the vector method in the order in which they are solved; the numbers are those of {pose}. "
        "Axes: x to the right, y up; angles are positive counter-clockwise. Lengths in m, forces in N, pressures in Pa (gauge).",
        pose=pose_words,
    )
    yield said(
        "An arrow over one letter is the position of a point, over two the vector between two points. L is a given length. "
        "TurnV turns a vector by an angle and, with an index L, scales it to a length. Tcos is the angle of a triangle by the "
        "cosine rule, arg the direction of a vector from the x axis."
    )
    yield from (Equality(0, tuple(each.split(" = ", 1))) for each in listing.definitions)
    if listing.iterated_pins:
        yield said(
            "The pins {pins} are found together, by iteration: they form a group that has no closed form. Their equations are "
            "the conditions that they keep.",
            pins=", ".join(listing.iterated_pins),
        )
    if found.why_no_forces:
        yield said("The forces of this machine have no equations that are written out: {why}", why=found.why_no_forces)
    elif has_loads(listing.machine):
        yield said(
            "Forces are without friction. P is a force downwards, F another one. Q is the force of a drive by virtual work, "
            "positive the way its stroke grows. T is what a member carries, positive where it pushes its ends apart."
        )
        if is_timed:
            yield said("They are those of slow motion: what masses do as they speed up stands in the tables and not in these equations.")
        about, given = listing.axles
        if about:
            yield said("R is what a support carries, by the moments about {support} and by the sum across the ground.", support=about)
        if given:
            names = ", ".join(f"R_{name}" for name in given)
            yield said("{names} hang on how the supports give way: they are given numbers.", names=names)
    told = not listing.left_out
    for each in found.lines:
        if each.heading:
            yield each.heading
        if not told and each.steps[0].startswith("Q"):  # the first that would have it
            yield said("Left out of the equations: the friction of {names}.", names=", ".join(listing.left_out))
            told = True
        yield Equality(each.number, each.steps)
