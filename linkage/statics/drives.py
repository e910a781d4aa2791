"""What the drives do: thrusts and torques, read off the joint forces where each drive is cut."""

from __future__ import annotations

from collections.abc import Iterator

from ..errors import DefinitionError, unknown
from ..plan import Plan
from ..quantities import Distance, Quantity
from ..steps import Crank, OnGuide, OnLink
from .bodies import Ram
from .contacts import Contact
from .structure import Structure
from .system import Form, System
from .turns import drives_of, follows_points


def drive_of(plan: Plan, drive: str | None) -> str:
    """Return the stroke that is meant: the only one, where none is named."""
    if drive is None and len(plan.strokes) == 1:
        return next(iter(plan.strokes))
    if drive is None:
        raise DefinitionError(f"{plan.title} has {len(plan.strokes)} strokes: say drive= one of {', '.join(plan.strokes)}.")
    if drive not in plan.strokes:
        raise unknown("Stroke", drive, plan.strokes, where=plan.title)
    return drive


def cut(system: System, drive: str) -> Form:
    """Return the generalised force of a stroke [N or Nm]: each drive's force times how it follows the stroke."""
    found = [(quantity, force) for quantity, force in driven(system) if follows(system.structure, quantity, drive)]
    if not found:
        raise DefinitionError(
            f"{system.structure.plan.title}: the joints know no drive of {drive}; "
            f"declare it by Dyad(..., AB=... + {drive}), Crank, OnGuide or OnLink."
        )
    forms = [force.times(system.poses.ratio(quantity, drive)) for quantity, force in found]
    return sum(forms[1:], forms[0])


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
    plan, structure = system.structure.plan, system.structure
    for ram in structure.rams:
        yield ram.quantity or Distance(ram.P, ram.Q), thrust(system, ram)
    for name, crank in plan.of_kind(Crank).items():
        if name not in structure.coordinates:
            for sign, term in drives_of(plan, crank):
                yield term, system.unknown("crank", name, 0, sign * system.scale)
    for name, point in plan.of_kind(OnGuide).items():
        if name not in structure.coordinates:
            yield point.along, system.unknown("driven", name, 1, 1.0)
    for name in plan.telescopes:
        step = plan.members[name]
        assert isinstance(step, OnLink)
        sense = 1.0 if step.side is None else float(step.side)
        yield step.PX, system.unknown("telescope", name, 1, 1.0)
        yield step.QPX, system.unknown("telescope", name, 2, sense * system.scale)


def thrust(system: System, ram: Ram) -> Form:
    """Return a cylinder's thrust: what pushes its far end against all that acts there."""
    structure = system.structure
    body = structure.carrier(ram.P, ram.Q, ram.name)
    points = structure.parts[body].points

    def far(contact: Contact) -> bool:
        at = contact.point if contact.point in points else contact.line[0]
        return at in ram.far

    return system.sum_along(body, far, ram.far.__contains__, system.poses.along(ram.P, ram.Q))
