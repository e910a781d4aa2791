"""What the drives do: thrusts and torques, read off the joint forces where each drive is cut."""

from __future__ import annotations

from collections.abc import Iterator

from ..errors import DefinitionError
from ..program import FloatArray
from ..quantities import Distance, Quantity, name_of
from .poses import Poses
from .structure import Structure
from .system import Form, System
from .turns import follows_points


def cut(system: System, drive: str) -> Form:
    """Return the generalised force of a stroke [N or Nm]: each drive's force times how it follows the stroke."""
    found = [(quantity, force) for quantity, force in driven(system) if follows(system.structure, quantity, drive)]
    if not found:
        raise DefinitionError(
            f"{system.structure.plan.title}: the joints know no drive of {drive}; "
            f"declare it by Dyad(..., AB=... + {drive}), Crank, OnGuide or OnLink."
        )
    forms = [force.times(ratio_of(system.poses, quantity, drive)) for quantity, force in found]
    return sum(forms[1:], forms[0])


def ratio_of(poses: Poses, quantity: Quantity, drive: str) -> FloatArray:
    """Return how a driven quantity follows a stroke, shape (n,); of a distance it is told by its points."""
    if isinstance(quantity, Distance):
        return poses.growth(name_of(quantity.P), name_of(quantity.Q), drive)
    return poses.ratio(quantity, drive)


def follows(structure: Structure, quantity: Quantity, drive: str) -> bool:
    """Return whether a driven quantity follows a stroke; DefinitionError where it follows moving points as well."""
    if isinstance(quantity, Distance):
        return True
    if follows_points(structure.plan, quantity):
        what = f"a drive follows {quantity.name or quantity}, which depends on moving points"
        raise DefinitionError(f"{structure.plan.title}: {what}; its force is not provided.")
    return drive == quantity.name or drive in structure.plan.reaches(quantity)


def driven(system: System) -> Iterator[tuple[Quantity, Form]]:
    """Yield every driven quantity with the force that drives it."""
    structure = system.structure
    for strut in structure.struts:
        if strut.drives:
            yield Distance(strut.P, strut.Q) if strut.quantity is None else strut.quantity, system.thrust(strut)
    for contact in structure.contacts:
        for quantity, letter, sign in structure.driven(contact):
            yield quantity, system.unknown(contact, letter, sign)
