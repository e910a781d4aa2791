"""All assembly modes of a mechanism at a pose: every choice of sides that can be assembled."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from copy import copy
from dataclasses import dataclass
from typing import Any, final

import numpy as np

from ..errors import DefinitionError
from ..plan import ArrayReading, Plan
from ..quantities import Member
from ..steps import Step
from ..vectors import Side

MOST = 16


@final
@dataclass(frozen=True)
class Assembly:
    """One way to put the dyads together: the side of each, and where the points are then [m]."""

    sides: Mapping[str, Side]
    places: Mapping[str, tuple[float, float]]

    def __str__(self) -> str:
        return ", ".join(f"{name} {side}" for name, side in self.sides.items())


def assemblies(plan: Plan, inputs: Mapping[str, Any]) -> list[Assembly]:
    """Return the assembly modes of the dyads that exist for given inputs [SI], the declared one first where it exists.

    Raises DefinitionError beyond 16 dyads, which have more than 65,536 modes.
    """
    dyads = {name: step for name, step in plan.of_kind(Step).items() if step.closes and step.modes()}
    if len(dyads) > MOST:
        raise DefinitionError(f"{plan.title} has {len(dyads)} dyads: assembly modes are listed for up to {MOST}.")
    return list(_modes(plan, inputs, dict(plan.members), list(dyads)))


def _modes(plan: Plan, inputs: Mapping[str, Any], members: dict[str, Member], left: list[str]) -> Iterator[Assembly]:
    """Yield the assemblies with the sides of the remaining dyads chosen, the declared side first; a mode out of reach is cut off."""
    reading = ArrayReading(members, plan.table.lengths, inputs)
    done = [name for name in plan.points if not plan.reaches(name) & set(left)]
    with np.errstate(all="ignore"):
        places = {name: (float(reading.at(name).x), float(reading.at(name).y)) for name in done}
    if not np.isfinite(list(places.values())).all():
        return
    if not left:
        yield Assembly({name: _side(members[name]) for name in plan.points if _has_modes(members[name])}, places)
        return
    declared = members[left[0]]
    assert isinstance(declared, Step)
    for side in sorted(declared.modes(), key=lambda each: each is not declared.side):
        chosen = copy(declared)
        chosen.side = side
        yield from _modes(plan, inputs, {**members, left[0]: chosen}, left[1:])


def _has_modes(member: Member) -> bool:
    return isinstance(member, Step) and member.closes and bool(member.modes())


def _side(member: Member) -> Side:
    assert isinstance(member, Step)
    return member.settled_side
