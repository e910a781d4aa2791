"""The equations with their numbers, as a calculation sheet has them, and what they leave out."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import final

from ..errors import LinkageError
from ..formulas import equations
from ..formulas.numbered import Equations, SheetLine
from ..language import said
from ..loads import ForceElement
from ..mechanism import Mechanism
from .content import Block, Equality, Paragraph, Section


@final
@dataclass(frozen=True)
class FilledEquations:
    """The equations of a design at a pose, and why those of its forces are missing, if they are."""

    listing: Equations
    lines: Sequence[SheetLine]
    why_no_forces: str = ""


def calculated(machine: Mechanism, pose: Mapping[str, float], start: int) -> FilledEquations:
    """Return the equations of a design; without those of its forces where these have none."""
    try:
        found = equations(machine, start=start, forces=has_loads(machine))
        return FilledEquations(found, found.sheet(pose))
    except LinkageError as error:
        if not has_loads(machine):
            raise
        plain = equations(machine, start=start)
        return FilledEquations(plain, plain.sheet(pose), str(error))


def has_loads(machine: Mechanism) -> bool:
    """Return whether anything acts on a machine."""
    return bool(machine.plan.of_kind(ForceElement))


def calculation_section(found: FilledEquations, pose_words: str) -> Section:
    """Return the section of the numbered equations with their numbers."""
    listing, blocks = found.listing, []
    blocks += [
        Paragraph(
            said(
                "The equations of the vector method in the order in which they are solved; the numbers are those of {pose}. "
                "Axes: x to the right, y up; angles are positive counter-clockwise. Lengths in m, forces in N, pressures in Pa (gauge).",
                pose=pose_words,
            )
        ),
        Paragraph(
            said(
                "An arrow over one letter is the position of a point, over two the vector between two points. L is a given length, "
                "TurnV turns a vector by an angle and, with an index L, scales it to a length; Tcos is the angle of a triangle by the "
                "cosine rule; arg is the direction of a vector from the x axis."
            )
        ),
    ]
    body: list[Block] = [*blocks, *(Equality(0, tuple(each.split(" = ", 1))) for each in listing.definitions)]
    if listing.together:
        pins = ", ".join(listing.together)
        body.append(
            Paragraph(
                said(
                    "The pins {pins} are found together, by iteration: they form a group that has no closed form. The equations that they "
                    "stand in are the conditions which they keep.",
                    pins=pins,
                )
            )
        )
    if found.why_no_forces:
        body.append(Paragraph(said("The forces of this machine have no equations that are written out: {why}", why=found.why_no_forces)))
    elif has_loads(listing.machine):
        body.append(
            Paragraph(
                said(
                    "Forces are without friction. P is a force downwards, F another one, Q the force of a drive by virtual work, positive "
                    "the way its stroke grows, T what a member carries, positive where it pushes its ends apart."
                )
            )
        )
    if listing.left_out:
        body.append(Paragraph(said("Left out of the equations: the friction of {names}.", names=", ".join(listing.left_out))))
    body += [Equality(each.number, each.steps) for each in found.lines]
    return Section(said("Calculation"), tuple(body))
